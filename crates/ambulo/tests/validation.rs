//! Means and tables of judged trials.
//!
//! | claim                                                            | tolerance and its reason |
//! |------------------------------------------------------------------|--------------------------|
//! | a person with several trials of a kind counts once               | rounding                 |
//! | the order of trials changes no mean                              | rounding of sums         |
//! | figures of a stance and its fifths are those of its samples      | rounding                 |
//! | what was not measured is a dash, and in no mean                  | exact                    |

use ambulo::analysis::{
    CenterAgreement, ComparedSample, ComparedStance, EventAgreement, EventKind, GroundAgreement, Mass, MassSource,
};
use ambulo::ground::predict::TRAITS;
use ambulo::model::Side;
use ambulo::study::QualityState;
use ambulo::study::validation::{
    Component, Figure, JudgedTrial, Method, TextTable, kind_means, method_means, over_kind, person_means, phase_errors,
    share_by_fifth, stance_rows,
};

/// The weight of the person [N].
const WEIGHT_N: f64 = 700.0;

/// A stance whose vertical prediction is off by a share of the weight in each fifth.
fn stance(off: [f64; 5]) -> ComparedStance {
    let sample = |i: u32| {
        let phase = (f64::from(i) + 0.5) / 100.0;
        let measured = [WEIGHT_N * (1.0 + 0.1 * (9.0 * phase).sin()), WEIGHT_N * 0.1 * phase, 10.0];
        let error = off[(5.0 * phase) as usize] * WEIGHT_N;
        ComparedSample {
            phase,
            detected_phase: phase,
            predicted: [measured[0] + error, measured[1], measured[2]],
            measured,
            deviation: [0.02 * WEIGHT_N; 3],
            center_off: [0.01, f64::NAN],
            center_deviation: [0.01; 2],
            free_moment_off: 0.0,
            free_moment_deviation: 1.0,
        }
    };
    ComparedStance {
        side: Side::Right,
        span_s: [0.0, 0.7],
        traits: [0.0; TRAITS],
        samples: (0..100).map(sample).collect(),
    }
}

fn trial(person: &str, kind: &str, off: [f64; 5]) -> JudgedTrial {
    let stance = stance(off);
    let foot = stance.agreement(WEIGHT_N).unwrap();
    let none =
        |kind| EventAgreement { kind, pairs: 0, missed: 0, extra: 0, mean_absolute_ms: f64::NAN, bias_ms: f64::NAN };
    let mass = Mass { kg: 71.0, source: MassSource::Standing };
    let agreement = GroundAgreement {
        mass_kg: mass.kg,
        window_s: None,
        feet: vec![foot],
        moments: Vec::new(),
        events: [none(EventKind::Strike), none(EventKind::Off)],
    };
    JudgedTrial {
        name: format!("{person} {kind}"),
        person: person.to_owned(),
        kind: kind.to_owned(),
        speed_m_s: None,
        mass,
        weight_n: WEIGHT_N,
        quality: QualityState::Good,
        rule: "none",
        agreement,
        stances: vec![stance],
        others: Vec::new(),
    }
}

fn vertical(trial: &JudgedTrial) -> f64 {
    Figure::Rmse(Component::Vertical).of(&trial.agreement)
}

#[test]
fn a_person_with_several_trials_of_a_kind_counts_once() {
    let trials = [
        trial("ann", "walk", [0.1; 5]),
        trial("ben", "walk", [0.02; 5]),
        trial("ann", "walk", [0.3; 5]),
        trial("ann", "turn", [0.9; 5]),
    ];
    let all: Vec<&JudgedTrial> = trials.iter().collect();
    // Ann's walks are off by 10 and 30, Ben's by 2 % of the weight.
    let mean = over_kind(&all, "walk", vertical);
    assert!((mean - 11.0).abs() < 1e-9, "{mean}");
    assert!(over_kind(&all, "run", vertical).is_nan());
    let section = kind_means(&all);
    assert_eq!(section.table.rows().len(), 6, "three components of two kinds");
    assert_eq!(section.table.rows()[0][..5], ["walk", "2", "3", "vertical", "11.00"]);
    assert_eq!(person_means(&all).table.rows().len(), 3, "ann walks and turns, ben walks");
    let mut turned: Vec<&JudgedTrial> = all.clone();
    turned.reverse();
    assert!((over_kind(&turned, "walk", vertical) - mean).abs() < 1e-12, "the order of the trials");
}

#[test]
fn figures_of_a_stance_and_its_fifths_are_those_of_its_samples() {
    let trial = trial("ann", "walk", [0.01, 0.02, 0.03, 0.04, 0.05]);
    let rows = stance_rows(&[&trial]);
    assert_eq!(rows.len(), 3);
    assert_eq!(rows[0].whole, trial.agreement.feet[0].vertical, "the only stance of the foot");
    let found = rows[0].fifths.map(|fifth| fifth.unwrap());
    for (k, fifth) in found.iter().enumerate() {
        assert!((fifth.rmse_bw - 0.01 * (k + 1) as f64).abs() < 1e-12, "{k} {fifth:?}");
        // The band is 1.645 times 2 % of the weight.
        assert_eq!(fifth.band.holds > 0.5, k < 3, "{k} {fifth:?}");
    }
    let shares = share_by_fifth(&[&trial]);
    assert_eq!(shares.table.rows()[0], ["walk", "vertical", "100", "100", "100", "0", "0"]);
    assert!(rows[1].fifths.iter().flatten().all(|fifth| fifth.rmse_bw < 1e-15), "fore-aft has no error");
    let errors = phase_errors(&[&trial], "walk", Component::Vertical);
    assert!((errors[0].rmse - 1.0).abs() < 1e-9 && (errors[errors.len() - 1].bias - 5.0).abs() < 1e-9);
    assert!(errors.iter().all(|error| (error.deviation - 2.0).abs() < 1e-9));
}

#[test]
fn what_was_not_measured_is_a_dash_and_in_no_mean() {
    let mut first = trial("ann", "walk", [0.1; 5]);
    let second = trial("ben", "walk", [0.3; 5]);
    first.agreement.feet[0].center_of_pressure =
        CenterAgreement { fore_aft_weighted_mm: f64::NAN, ..first.agreement.feet[0].center_of_pressure };
    let center = over_kind(&[&first, &second], "walk", |trial| Figure::CenterAlong.of(&trial.agreement));
    assert!((center - 10.0).abs() < 1e-9, "the other person's alone: {center}");
    let text = person_means(&[&first, &second]).markdown();
    let line = text.lines().find(|line| line.contains("ann")).unwrap();
    let cells: Vec<&str> = line.split('|').map(str::trim).collect();
    assert_eq!((cells[4], cells[10], cells[12]), ("10.00", "-", "-"), "{line}");
}

#[test]
fn methods_that_were_not_judged_have_no_row() {
    let mut tracked = trial("ann", "walk", [0.1; 5]);
    let other = trial("ben", "walk", [0.3; 5]);
    tracked.others.push((Method::Tracking, other.agreement.clone()));
    let rows = method_means(&[&tracked, &other]).table.rows().to_vec();
    assert_eq!(rows.len(), 2);
    assert_eq!(rows[0][..4], ["walk", "tracking", "1", "30.00"]);
    assert_eq!(rows[1][..4], ["walk", "prediction", "2", "20.00"]);
}

#[test]
fn a_table_has_a_cell_for_every_column() {
    let trial = trial("a|b", "walk", [0.1; 5]);
    let text = kind_means(&[&trial]).markdown() + &person_means(&[&trial]).markdown();
    let bars = |line: &str| line.replace("\\|", "").matches('|').count();
    for table in text.split("## ").filter(|table| !table.is_empty()) {
        let counts: Vec<usize> = table.lines().filter(|line| line.starts_with('|')).map(bars).collect();
        assert!(counts.len() > 2 && counts.iter().all(|count| *count == counts[0]), "{table}");
    }
    assert_eq!(TextTable::new(&["a"]).text(), "| a   |\n|:----|\n", "a table without rows");
}
