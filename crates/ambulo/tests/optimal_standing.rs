//! Stopping from a walk and walking off: without outside forces, joined to the walk, and not from a fast walk.

use ambulo::findings::Findings;
use ambulo::gait::{Gait, Speed, Walk};
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::optimal::{NO_ROOT_FORCE, Sample, Solution, StandingMovements};
use ambulo::simulation::consistent_walk::{ConsistentWalkSettings, make_consistent_walk};

const G: f64 = 9.80665;

fn walk(human: &Human, speed: f64) -> Solution {
    let mut gait = Gait::named("free").unwrap();
    gait.pace.speed = Some(Speed::MetersPerSecond(speed));
    let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).unwrap();
    make_consistent_walk(human, &walk, &ConsistentWalkSettings::default()).unwrap().solution().clone()
}

/// Samples every 2 ms.
fn samples(movement: &Solution) -> Vec<Sample> {
    let count = (500.0 * movement.problem().duration_s) as usize;
    let times: Vec<f64> = (0..=count).map(|k| movement.problem().duration_s * k as f64 / count as f64).collect();
    movement.samples(&times).unwrap()
}

fn state_at(motion: &Solution, time_s: f64) -> [Vec<f64>; 3] {
    motion.samples(&[time_s]).unwrap().remove(0).posture
}

/// Largest difference of coordinates, without the place forward, and of rates.
fn apart(a: &[Vec<f64>; 3], b: &[Vec<f64>; 3], forward: usize) -> [f64; 2] {
    let largest = |part: usize| {
        let differences = a[part].iter().zip(&b[part]).enumerate().filter(|(c, _)| part > 0 || *c != forward);
        differences.map(|(_, (a, b))| (a - b).abs()).fold(0.0, f64::max)
    };
    [largest(0), largest(1)]
}

#[test]
fn a_slow_walk_is_stopped_and_begun_without_outside_forces() {
    let human = Build::usual(SegmentTable::DeLevaMale).human().unwrap();
    let walk = walk(&human, StandingMovements::speed(&human));
    let StandingMovements { stop, start } = StandingMovements::find(&human, &walk).unwrap();
    let (forward, weight_n) = (human.model.coordinate("pelvis_tx").unwrap().index(), human.model.mass() * G);
    let [stops, joins] = StandingMovements::JOINS.map(|share| state_at(&walk, share * walk.cycle_s()));
    let rest = state_at(&stop, stop.problem().duration_s);
    for (name, movement, begins, ends) in [("stop", &stop, &stops, &rest), ("start", &start, &rest, &joins)] {
        assert_eq!(movement.unbalanced(NO_ROOT_FORCE), None, "{name}");
        assert_eq!(movement.overload(0.05), None, "{name}");
        let samples = samples(movement);
        let spheres: Vec<usize> = (0..movement.problem().soles.len()).collect();
        let loads: Vec<f64> = samples.iter().map(|sample| sample.ground_force(&spheres).y / weight_n).collect();
        let least = loads.iter().copied().fold(f64::INFINITY, f64::min);
        let [first, last] = [&samples[0].posture, &samples[samples.len() - 1].posture];
        let [begin, end] = [apart(first, begins, forward), apart(last, ends, forward)];
        println!("{name}: load at least {least:.2} of the weight, ends differ by {begin:.4?} and {end:.4?}");
        assert!(least > 0.3, "{name} hops: {least}");
        // [rad, m] and [rad/s, m/s]; toes differ most.
        assert!(begin[0].max(end[0]) < 0.01 && begin[1].max(end[1]) < 0.2, "{name}: {begin:?} {end:?}");
        let step_s = samples[1].time_s;
        let impulse: f64 = loads.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]) * step_s).sum();
        assert!((impulse / movement.problem().duration_s - 1.0).abs() < 0.03, "{name}: {impulse}");
    }
    assert!(rest[1].iter().all(|rate| rate.abs() < 0.05), "{:?}", rest[1]);
}

#[test]
fn a_fast_walk_is_not_stopped_within_a_step() {
    let human = Build::usual(SegmentTable::DeLevaMale).human().unwrap();
    let error = StandingMovements::find(&human, &walk(&human, 1.7)).err().unwrap();
    println!("{error}");
    assert!(error.to_string().contains("for a walk at 1.70 m/s"), "{error}");
}
