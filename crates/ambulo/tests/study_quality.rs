//! Quality of the data.

use ambulo::study::{Measure, Quality, QualityLimits, QualityState};

#[test]
fn both_limits_of_every_measure_decide() {
    for measure in Measure::ALL {
        let (QualityLimits::AtMost(doubtful, bad) | QualityLimits::AtLeast(doubtful, bad)) = measure.limits();
        let beyond = if doubtful < bad { 1e-9 } else { -1e-9 };
        let state = |value: f64| measure.reason(value, |_| String::new()).map(|reason| reason.state);
        assert_eq!(state(doubtful), None, "{measure:?}");
        assert_eq!(state(doubtful + beyond), Some(QualityState::Doubtful), "{measure:?}");
        assert_eq!(state(bad), Some(QualityState::Doubtful), "{measure:?}");
        assert_eq!(state(bad + beyond), Some(QualityState::Bad), "{measure:?}");
        assert_eq!(state(f64::NAN), Some(QualityState::Bad), "{measure:?}");
    }
}

#[test]
fn the_worst_reason_comes_first() {
    let reason = |measure: Measure, value: f64| measure.reason(value, |_| String::new());
    let list = [
        reason(Measure::ResidualForce, 0.21),
        reason(Measure::Gaps, 0.4),
        reason(Measure::Sliding, 0.14),
        reason(Measure::LowCutoff, 6.0),
    ];
    let quality = Quality::of(list.into_iter().flatten());
    let order: Vec<Measure> = quality.reasons.iter().map(|reason| reason.measure).collect();
    assert_eq!(order, [Measure::Gaps, Measure::Sliding, Measure::ResidualForce]);
    assert_eq!(quality.state, QualityState::Bad);
    assert_eq!(Quality::of([]).state, QualityState::Good);
}
