//! Cycles of a session: means, scores, representative cycles, exclusions.
//!
//! | claim                                                                                     | tolerance |
//! |-------------------------------------------------------------------------------------------|-----------|
//! | mean and standard deviation are those of three curves by hand                             | rounding  |
//! | measured and predicted forces are never in one mean; angles are                           | exact     |
//! | a constant offset is its own score; the profile score is the root mean square of nine     | rounding  |
//! | people drawn from a reference group have the expected score on average                    | 3 % of 400 people |
//! | the representative cycle is the one in the middle; one that is far away is marked         | exact     |
//! | a turned knee axis, an offset of the hip and noise are no clear change; another shape is  | exact     |
//! | the gait deviation index of the mean is 100, a standard deviation away 90                 | rounding  |
//! | cycles of other activities, of bad data, of turns and with a missed strike have reasons   | exact     |

use ambulo::analysis::activity::ActivityKind;
use ambulo::model::Side;
use ambulo::numerics::Random;
use ambulo::study::session::{
    Certainty, CurveStatistics, CycleFacts, CycleForces, NormalCurve, PROFILE, PooledCurve, SessionCycle, TrialFacts,
    curve_change, deviation, deviation_index, exclusions, pooled, profile, representative, side_difference,
};

/// Angle over the cycle [deg]: a wave about a mean.
fn wave(offset: f64) -> Vec<f64> {
    (0..=100).map(|i| 20.0 * (std::f64::consts::TAU * f64::from(i) / 100.0).sin() + offset).collect()
}

/// A cycle whose angles of the profile are all the same wave, and whose hip moment is the offset.
fn cycle(trial: usize, side: Side, forces: CycleForces, offset: f64) -> SessionCycle {
    let angles = PROFILE.iter().map(|quantity| ((*quantity).to_owned(), wave(offset)));
    let moment = ("hip_flexion_moment".to_owned(), vec![offset; 101]);
    SessionCycle {
        trial,
        side,
        number: 1,
        span_s: [0.0, 1.1],
        foot_off_percent: Some(60.0),
        forces,
        excluded: None,
        curves: angles.chain([moment]).collect(),
    }
}

/// The mean of [`wave`] without offset, with a standard deviation of 4 degrees.
fn norm() -> NormalCurve {
    NormalCurve { mean: wave(0.0).into_iter().step_by(2).collect(), sd: vec![4.0; 51] }
}

#[test]
fn mean_and_standard_deviation_are_those_of_the_curves() {
    let curves: [&[f64]; 3] = [&[1.0, 5.0], &[2.0, 5.0], &[6.0, 5.0]];
    let found = CurveStatistics::of(&curves).unwrap();
    assert_eq!((found.mean[0], found.mean[1], found.count), (3.0, 5.0, 3));
    let sd = found.sd.as_ref().unwrap();
    assert!((sd[0] - 7.0_f64.sqrt()).abs() < 1e-12 && sd[1] == 0.0, "{sd:?}");
    assert!((found.spread().unwrap() - 3.5_f64.sqrt()).abs() < 1e-12, "over both samples");
    assert_eq!(CurveStatistics::of(&curves[..1]).unwrap().sd, None, "one curve has no deviation");
    assert!(CurveStatistics::of(&[]).is_none() && CurveStatistics::of(&[&[1.0], &[1.0, 2.0]]).is_none());
}

#[test]
fn measured_and_predicted_forces_are_never_in_one_mean() {
    let (right, left) = (Side::Right, Side::Left);
    let mut cycles = vec![
        cycle(0, right, CycleForces::Predicted, 1.0),
        cycle(0, right, CycleForces::Measured, 3.0),
        cycle(1, right, CycleForces::Measured, 5.0),
        cycle(1, left, CycleForces::Predicted, 7.0),
        cycle(1, left, CycleForces::None, 100.0),
    ];
    let moment = pooled(&cycles, "hip_flexion_moment", right).unwrap();
    assert_eq!((moment.statistics.mean[0], moment.forces), (4.0, Some(CycleForces::Measured)));
    let angle = pooled(&cycles, "hip_flexion_angle", right).unwrap();
    assert_eq!((angle.statistics.mean[0], angle.forces, angle.statistics.count), (3.0, None, 3));
    let other = pooled(&cycles, "hip_flexion_moment", left).unwrap();
    assert_eq!((other.statistics.count, other.forces), (1, Some(CycleForces::Predicted)), "no forces are in no mean");
    assert_eq!(side_difference(Some(&moment), Some(&other)), None, "measured is not compared with predicted");
    let left_angle = pooled(&cycles, "hip_flexion_angle", left).unwrap();
    assert!((side_difference(Some(&angle), Some(&left_angle)).unwrap() - 50.5).abs() < 1e-9);
    cycles[2].excluded = Some("turn".to_owned());
    assert!((pooled(&cycles, "hip_flexion_moment", right).unwrap().statistics.mean[0] - 3.0).abs() < 1e-12);
    assert!(pooled(&cycles, "subtalar_angle", right).is_none());
}

#[test]
fn scores_are_distances_from_the_mean_of_the_reference_group() {
    let cycles = [
        cycle(0, Side::Right, CycleForces::None, 3.0),
        cycle(0, Side::Right, CycleForces::None, 5.0),
        cycle(0, Side::Left, CycleForces::None, -2.0),
    ];
    let found = profile(&cycles, |_| Some(norm()));
    let knee = PROFILE.iter().position(|quantity| *quantity == "knee_flexion_angle").unwrap();
    let right = found.variables[knee].right.unwrap();
    assert!((right.mean - 4.0).abs() < 1e-9 && (right.sd.unwrap() - 2.0_f64.sqrt()).abs() < 1e-9, "{right:?}");
    assert!((found.sides.right.unwrap().mean - 4.0).abs() < 1e-9);
    assert!((found.sides.left.unwrap().mean - 2.0).abs() < 1e-9 && found.sides.left.unwrap().sd.is_none());
    // Nine angles of the left side, six of the right one.
    let overall = ((9.0 * 4.0 + 6.0 * 16.0) / 15.0_f64).sqrt();
    assert!((found.overall.unwrap() - overall).abs() < 1e-9);
    assert!((found.expected_overall.unwrap() - 4.0).abs() < 1e-9);
    // Without one of the angles there is no profile score, but the scores of the others.
    let lacking = profile(&cycles, |quantity| (quantity != "foot_progression_angle").then(norm));
    assert!(lacking.overall.is_none() && lacking.sides.right.is_none() && lacking.variables[knee].right.is_some());
}

/// Flexion of a knee over the cycle [deg].
fn flexion() -> Vec<f64> {
    (0..=100).map(|i| 30.0 - 30.0 * (std::f64::consts::TAU * f64::from(i) / 100.0).cos()).collect()
}

/// A mean over cycles that vary by a degree.
fn mean_curve(mean: Vec<f64>, count: usize, forces: Option<CycleForces>) -> PooledCurve {
    let sd = (count > 1).then(|| vec![1.0; mean.len()]);
    PooledCurve { statistics: CurveStatistics { mean, sd, count }, forces }
}

#[test]
fn a_calibration_explains_an_offset_and_a_turned_knee_axis_but_no_other_shape() {
    let certainty = |quantity: &str, change: fn(f64) -> f64| {
        let after: Vec<f64> = flexion().into_iter().map(change).collect();
        let [before, after] = [vec![0.0; 101], after].map(|mean| mean_curve(mean, 9, None));
        curve_change(quantity, &before, &after, Some(&flexion())).unwrap().certainty
    };
    use Certainty::{Calibration, Clear, Variation};
    assert_eq!(certainty("hip_rotation_angle", |_| -21.0), Calibration, "a wand");
    assert_eq!(certainty("subtalar_angle", |_| 22.0), Calibration);
    assert_eq!(certainty("knee_adduction_angle", |f| 2.0 + 0.2 * f), Calibration, "an axis turned by 12 degrees");
    assert_eq!(certainty("ankle_inversion_moment", |f| 0.2 * f), Calibration, "a share of the dorsiflexion moment");
    assert_eq!(certainty("ankle_inversion_moment", |f| 0.2 * f + 3.0), Clear, "a constant moment");
    // The same changes where no placement of markers explains them.
    assert_eq!(certainty("hip_rotation_angle", |f| 0.2 * f), Clear);
    assert_eq!(certainty("knee_flexion_angle", |_| -21.0), Clear);
    assert_eq!(certainty("knee_adduction_angle", |f| 0.6 * f), Clear, "an axis turned by 37 degrees");
    assert_eq!(certainty("knee_flexion_angle", |_| 4.0), Calibration);
    assert_eq!(certainty("knee_flexion_angle", |_| 1.5), Variation);
}

#[test]
fn changes_of_predicted_forces_and_of_single_cycles_are_not_sure() {
    let of = |count: usize, forces: [CycleForces; 2]| {
        let [before, after] = [0.0, 0.8].map(|x| vec![x; 101]);
        let before = mean_curve(before, 9, Some(forces[0]));
        curve_change("hip_flexion_moment", &before, &mean_curve(after, count, Some(forces[1])), None)
    };
    use CycleForces::{Measured, Predicted};
    assert_eq!(of(1, [Measured; 2]).unwrap().certainty, Certainty::SingleCycle);
    assert_eq!(of(9, [Predicted; 2]).unwrap().certainty, Certainty::Predicted);
    assert!(of(9, [Measured, Predicted]).is_none(), "different sources are not compared");
}

#[test]
fn the_gait_deviation_index_counts_standard_deviations_of_the_logarithm_of_the_score() {
    let (mean, sd) = (5.5_f64.ln(), 0.25);
    assert!((deviation_index(5.5, [mean, sd]) - 100.0).abs() < 1e-9);
    assert!((deviation_index(5.5 * sd.exp(), [mean, sd]) - 90.0).abs() < 1e-9);
}

#[test]
fn people_of_the_reference_group_have_the_expected_score() {
    let mut random = Random::new(7, 0);
    let people = 400;
    let squares: f64 = (0..people)
        .map(|_| {
            let offset = 4.0 * random.normal();
            norm().score(&wave(offset)).powi(2)
        })
        .sum();
    let found = (squares / f64::from(people)).sqrt();
    // The relative error of a standard deviation of 400 numbers is 1 / √800.
    assert!((found / norm().expected_score() - 1.0).abs() < 3.0 / 800.0_f64.sqrt(), "{found}");
    assert!(norm().score(&wave(0.0).iter().rev().copied().collect::<Vec<_>>()) > 20.0, "the wrong sign is far away");
}

#[test]
fn a_deviation_says_how_much_where_and_in_which_direction() {
    let mut mean = wave(0.0);
    // A dip of 12 degrees about 50 %.
    mean[46..=54].iter_mut().for_each(|x| *x -= 12.0);
    let found = deviation(&mean, &norm()).unwrap();
    assert!((found.largest + 12.0).abs() < 1e-9 && (found.largest_sd + 3.0).abs() < 1e-9, "{found:?}");
    assert!((46.0..=54.0).contains(&found.at_percent));
    assert!((found.outside - 5.0 / 51.0).abs() < 1e-9, "46, 48, ... 54 %: {found:?}");
    let constant = NormalCurve { mean: vec![0.0; 51], sd: vec![0.0; 51] };
    assert_eq!(deviation(&mean, &constant), None);
}

#[test]
fn the_representative_cycle_is_in_the_middle_and_a_far_one_is_marked() {
    let of = |trial: usize, side: Side, offset: f64| cycle(trial, side, CycleForces::None, offset);
    let mut cycles = vec![
        of(0, Side::Right, 0.0),
        of(1, Side::Right, 2.2),
        of(2, Side::Right, 4.0),
        of(3, Side::Right, 30.0),
        of(0, Side::Left, 1.0),
        of(1, Side::Left, 2.0),
        of(2, Side::Left, 3.0),
    ];
    let found = representative(&cycles);
    assert_eq!((found.trial, found.cycles.right, found.cycles.left), (Some(1), Some(1), Some(5)));
    assert!(found.is_far(3) && !found.is_far(0) && !found.is_far(6), "{:?}", found.distances);
    // An excluded cycle is not chosen and moves no median.
    cycles[1].excluded = Some("turn".to_owned());
    let found = representative(&cycles);
    assert!(found.cycles.right != Some(1) && found.trial == Some(2) && found.distances[1].is_none(), "{found:?}");
    // The order of the trials changes nothing.
    let mut turned = cycles.clone();
    turned.reverse();
    assert_eq!(representative(&turned).trial, Some(2));
    assert_eq!(representative(&cycles[..1]).cycles.right, Some(0), "a single cycle");
    assert_eq!(representative(&[]).cycles.right, None);
}

#[test]
fn cycles_that_belong_to_no_mean_have_a_reason() {
    let of = |bad: Option<&str>, activity: ActivityKind, turn_deg: Option<f64>| TrialFacts {
        bad_data: bad.map(str::to_owned),
        activity,
        turn: turn_deg.map(f64::to_radians),
    };
    let trials = [
        of(None, ActivityKind::Walk, Some(3.0)),
        of(None, ActivityKind::Walk, None),
        of(None, ActivityKind::Turn, Some(50.0)),
        of(Some("markers are missing"), ActivityKind::Walk, None),
        of(None, ActivityKind::Walk, Some(25.0)),
    ];
    let cycles = [
        (0, 1.1, 0.62),
        (0, 1.12, 0.6),
        (1, 2.2, 0.6),
        (1, 1.08, 0.61),
        (2, 1.1, 0.6),
        (3, 1.1, 0.6),
        (4, 1.1, 0.6),
        // A strike detected 0.3 s late; a slow stride; a limp.
        (0, 0.8, 0.46),
        (0, 1.4, 0.66),
        (1, 1.1, 0.45),
    ];
    let cycles = cycles.map(|(trial, duration_s, stance)| CycleFacts { trial, duration_s, stance: Some(stance) });
    let reasons = exclusions(&trials, &cycles).into_iter().map(|reason| reason.map(|reason| reason.to_string()));
    let reasons: Vec<String> = reasons.map(Option::unwrap_or_default).collect();
    let expected = [
        "",
        "",
        "a foot strike was missed",
        "",
        "activity: turn; most trials: walk",
        "markers are missing",
        "25",
        "at the wrong time",
        "",
        "",
    ];
    assert_eq!(reasons.len(), expected.len());
    for (found, expected) in reasons.iter().zip(expected) {
        assert!(found.contains(expected) && found.is_empty() == expected.is_empty(), "`{found}`, `{expected}`");
    }
    assert!(exclusions(&[], &[]).is_empty());
}
