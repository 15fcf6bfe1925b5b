//! Pushes at the trunk, drawn from a seed.

use ambulo_walk::spatial::Vec3;
use ambulo_walk::tuning::{Push, PushSettings, PushUse};
use std::f64::consts::TAU;

#[test]
fn pushes_of_different_uses_differ_and_cover_the_cycle() {
    let settings = PushSettings { seed: 5, force_n: 100.0, count: 12, all_around: false };
    let uses = [PushUse::Search { generation: 0 }, PushUse::Search { generation: 1 }, PushUse::Choice, PushUse::Report];
    let sets = uses.map(|of| settings.pushes(of));
    for (set, of) in sets.iter().zip(uses) {
        assert_eq!(set, &settings.pushes(of));
        assert!(set.windows(2).all(|two| two[0].phase < two[1].phase) && set.len() == 12 * of.times());
        let forces: Vec<f64> = set.iter().map(|push| push.force(75.0).x).collect();
        assert_eq!(2 * forces.iter().filter(|force| **force > 0.0).count(), set.len());
        assert!(forces.iter().all(|force| (40.0..=100.0).contains(&force.abs())), "{forces:?}");
        let mean = forces.iter().map(|force| force.abs()).sum::<f64>() / set.len() as f64;
        assert!((mean - 70.0).abs() < 4.0, "{mean}");
    }
    let phases = sets.iter().flatten().map(|push| push.phase.to_bits());
    let mut different: Vec<u64> = phases.collect();
    let all = different.len();
    different.sort_unstable();
    different.dedup();
    assert_eq!(different.len(), all);
    assert!(settings.pushes(PushUse::Choice) != PushSettings { seed: 6, ..settings }.pushes(PushUse::Choice));
}

#[test]
fn pushes_all_around_fill_the_circle() {
    let settings = PushSettings { seed: 1, force_n: 60.0, count: 12, all_around: true };
    let mut turns: Vec<f64> = settings.pushes(PushUse::Choice).iter().map(|push| push.direction / TAU).collect();
    turns.sort_by(f64::total_cmp);
    let widest = turns.windows(2).map(|two| two[1] - two[0]).fold(1.0 - turns[35] + turns[0], f64::max);
    assert!(widest < 4.0 / 36.0, "{widest}");
    let right = Push { phase: 0.0, direction: 0.25 * TAU, force_n: 100.0 }.force(150.0);
    assert!((right - Vec3::z() * 200.0).norm() < 1e-9, "{right}");
}
