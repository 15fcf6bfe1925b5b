//! Speeds of a walk over time, at constant rates between constant speeds.

use ambulo_walk::control::SpeedSchedule;

#[test]
fn speeds_change_at_a_constant_rate_and_plans_cover_them() {
    let mut schedule = SpeedSchedule::from(1.2, 0.7);
    assert!(schedule.is_empty() && schedule.plans() == [1.2]);
    schedule.change(2.0, 4.0, 1.6);
    schedule.change(10.0, 0.0, 1.0);
    for (time_s, speed) in [(0.0, 1.2), (2.0, 1.2), (4.0, 1.4), (6.0, 1.6), (9.9, 1.6), (10.0, 1.0), (99.0, 1.0)] {
        assert!((schedule.at(time_s) - speed).abs() < 1e-12, "at {time_s} s");
    }
    let plans = schedule.plans();
    let ends = [plans[0], plans[plans.len() - 1]];
    assert!((ends[0] - 1.0).abs() < 1e-12 && (ends[1] - 1.6).abs() < 1e-12, "{plans:?}");
    assert!(plans.len() == 7 && plans.windows(2).all(|two| two[1] > two[0]), "{plans:?}");
    assert!(plans.windows(2).all(|two| two[1] - two[0] < 0.1 + 1e-9), "{plans:?}");
}

#[test]
fn a_figure_slows_down_before_it_stops_and_walks_off_slowly() {
    let mut schedule = SpeedSchedule::from(1.2, 0.7);
    assert!(!schedule.has_standing());
    schedule.change(2.0, 1.0, 0.0);
    schedule.change(6.0, 2.0, 0.9);
    assert!(schedule.has_standing() && !schedule.begins_standing());
    for (time_s, speed) in [(1.9, 1.2), (2.5, 0.95), (3.0, 0.0), (5.9, 0.0), (6.0, 0.7), (7.0, 0.8), (8.5, 0.9)] {
        assert!((schedule.at(time_s) - speed).abs() < 1e-12, "at {time_s} s: {}", schedule.at(time_s));
    }
    let plans = schedule.plans();
    assert!((plans[0] - 0.7).abs() < 1e-12 && (plans[plans.len() - 1] - 1.2).abs() < 1e-12, "{plans:?}");
    // Who walks more slowly than needed stops from there.
    let mut slow = SpeedSchedule::from(0.0, 0.7);
    slow.change(1.0, 0.0, 0.5);
    assert!(slow.begins_standing() && slow.plans() == [0.5] && slow.at(0.5) <= 0.0, "{slow:?}");
}
