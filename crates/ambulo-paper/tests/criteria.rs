//! Every criterion of a claim of the paper that could fail has a case that passes and one that fails.

use ambulo_paper::Numbers;
use ambulo_paper::internals::statement;

type Case = &'static [(&'static str, f64)];

fn numbers(case: Case) -> Numbers {
    case.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect()
}

fn holds(id: &str, case: Case, corrected: Option<Case>) -> bool {
    (statement(id).unwrap().judge)(&numbers(case), corrected.map(numbers).as_ref()).0
}

const CASES: [(&str, Case, Case); 13] = [
    ("c1", &[("speed_least_m_s", 0.1), ("speed_mean_m_s", 1.0)], &[("speed_least_m_s", 0.3), ("speed_mean_m_s", 1.0)]),
    (
        "c2",
        &[("hip_torque_amplitude_nm", 800.0), ("line_torque_nm", 600.0)],
        &[("hip_torque_amplitude_nm", 800.0), ("line_torque_nm", 300.0)],
    ),
    ("c3", &[("dimensionless_speed", 0.35)], &[("dimensionless_speed", 0.37)]),
    (
        "c4",
        &[
            ("standard_progress_share", 1.0),
            ("long_progress_share", 0.9),
            ("short_progress_share", 1.1),
            ("goose_progress_share", 1.0),
        ],
        // Short steps on the spot.
        &[
            ("standard_progress_share", 1.0),
            ("long_progress_share", 0.9),
            ("short_progress_share", 0.02),
            ("goose_progress_share", 1.0),
        ],
    ),
    ("d1", &[("slip_on_one_foot_mm_a_step", 2.0)], &[("slip_on_one_foot_mm_a_step", 0.5)]),
    (
        "e1",
        &[("humps", 2.0), ("correlation_with_measured", 0.75)],
        &[("humps", 3.0), ("correlation_with_measured", 0.75)],
    ),
    ("e2", &[("flight_percent", 2.0)], &[("flight_percent", 0.5)]),
    ("e3", &[("landings_a_step", 2.0)], &[("landings_a_step", 1.0)]),
    (
        "f2",
        &[("dense_60_kg_swing_difference_percent", 5.0), ("dense_100_kg_swing_difference_percent", 6.0)],
        &[("dense_60_kg_swing_difference_percent", 0.0), ("dense_100_kg_swing_difference_percent", 0.0)],
    ),
    ("g1", &[("r_a_b", 0.9), ("least_r", 0.85)], &[("r_a_b", 0.9), ("least_r", 0.75)]),
    ("h2", &[("r_hip_knee", 0.9)], &[("r_hip_knee", 0.7)]),
    (
        "h3",
        &[("hip_jumps_a_cycle", 4.0), ("knee_jumps_a_cycle", 0.0), ("ankle_jumps_a_cycle", 1.0)],
        &[("hip_jumps_a_cycle", 4.0), ("knee_jumps_a_cycle", 5.0), ("ankle_jumps_a_cycle", 1.0)],
    ),
    (
        "h4",
        &[
            ("hip_mean_early_support_nm", -5.0),
            ("hip_mean_late_support_nm", 5.0),
            ("hip_mean_swing_nm", 1.0),
            ("hip_mean_where_positive_in_support_nm", 6.0),
        ],
        &[
            ("hip_mean_early_support_nm", -5.0),
            ("hip_mean_late_support_nm", -5.0),
            ("hip_mean_swing_nm", 1.0),
            ("hip_mean_where_positive_in_support_nm", 6.0),
        ],
    ),
];

#[test]
fn each_criterion_can_hold_and_can_fail() {
    for (id, good, bad) in CASES {
        assert!(holds(id, good, None), "{id} does not hold");
        assert!(!holds(id, bad, None), "{id} cannot fail");
        assert!(!holds(id, &[], None), "{id} holds without numbers");
    }
    let order = |knee| holds_order(knee);
    assert!(order(200.0) && !order(400.0));
    let distances = |at_1000: f64| {
        let names = ["hip", "knee", "ankle"];
        let at = |rate: &str, value: f64| names.map(|joint| (format!("{joint}_torque_{rate}hz_percent"), value));
        let all = [at("30", 4.0), at("60", 3.0), at("120", 2.0), at("1000", at_1000)].concat();
        (statement("a1").unwrap().judge)(&all, None).0
    };
    assert!(distances(1.0) && !distances(3.0));
}

fn holds_order(knee: f64) -> bool {
    let largest = [("hip", 300.0), ("knee", knee), ("ankle", 100.0)];
    let numbers = largest.map(|(joint, torque)| (format!("{joint}_largest_nm"), torque)).to_vec();
    (statement("h1").unwrap().judge)(&numbers, None).0
}

/// Numbers of the four gaits under one name.
fn of_gaits(what: &str, [standard, long, short, goose]: [f64; 4]) -> Numbers {
    let gaits = [("standard", standard), ("long", long), ("short", short), ("goose", goose)];
    gaits.map(|(gait, value)| (format!("{gait}_{what}"), value)).to_vec()
}

#[test]
fn short_steps_must_be_the_lowest_and_the_most_regular() {
    let judge = |id: &str, list: &[Numbers]| (statement(id).unwrap().judge)(&list.concat(), None).0;
    let torque = |short| of_gaits("largest_torque_nm", [900.0, 1000.0, short, 950.0]);
    assert!(judge("g2", &[torque(800.0)]) && !judge("g2", &[torque(920.0)]));
    let range = |short| of_gaits("speed_range_over_mean", [1.5, 1.6, short, 1.4]);
    assert!(judge("g3", &[range(1.3)]) && !judge("g3", &[range(1.45)]) && !judge("g3", &[range(f64::INFINITY)]));
    let relative = |short| of_gaits("largest_torque_nm_kg", [12.0, 13.0, short, 14.0]);
    assert!(judge("j", &[range(1.3), relative(11.0)]));
    assert!(!judge("j", &[range(1.45), relative(11.0)]) && !judge("j", &[range(1.3), relative(12.5)]));
}

#[test]
fn soft_shoes_must_lessen_flight_and_landings_and_the_better_motion_too() {
    let rigid: Case = &[
        ("rigid_flight_percent", 4.0),
        ("rigid_landings_a_step", 2.0),
        ("soft_flight_percent", 1.0),
        ("soft_landings_a_step", 1.0),
        ("soft_largest_force_bw", 9.0),
    ];
    let calm: Case = &[
        ("rigid_flight_percent", 1.0),
        ("rigid_landings_a_step", 1.0),
        ("soft_flight_percent", 0.0),
        ("soft_landings_a_step", 0.5),
    ];
    assert!(holds("i", rigid, None) && holds("i", rigid, Some(calm)));
    // The same motion does not bounce less, and soft shoes that land as often do not help.
    assert!(!holds("i", rigid, Some(rigid)) && !holds("i", &rigid[..3], None));
    let former = statement("i").unwrap();
    assert!(former.formerly(&numbers(rigid), None) == Some(false), "the largest force was judged before");
}

#[test]
fn a_warning_must_not_be_given_to_feasible_walks() {
    let of = |shares| of_gaits("share_of_strength", shares);
    let judge = |paper: [f64; 4], corrected: Option<[f64; 4]>| {
        (statement("m2").unwrap().judge)(&of(paper), corrected.map(of).as_ref()).0
    };
    assert!(judge([2.0, 2.1, 1.5, 2.0], Some([0.5, 0.6, 0.4, 0.9])));
    assert!(!judge([2.0, 2.1, 0.9, 2.0], None), "one gait causes no warning");
    assert!(!judge([2.0, 2.1, 1.5, 2.0], Some([0.5, 0.6, 0.4, 1.1])), "a feasible walk causes one");
}
