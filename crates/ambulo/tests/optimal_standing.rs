//! Stopping from a walk and walking off: without outside forces, joined to the walk, as people do, and not from a fast
//! walk.

use ambulo::findings::Findings;
use ambulo::gait::{Gait, Speed, Walk};
use ambulo::kinematics::{Posture, PostureSweep};
use ambulo::model::anthropometry::{Build, Human, SegmentTable, SpherePart};
use ambulo::model::full_body::full_body;
use ambulo::model::{Movement, Side};
use ambulo::optimal::{NO_ROOT_FORCE, Observer, OptimalWalk, STAGES, Sample, Solution, StandingMovements};
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
    let human = full_body(&Build::usual(SegmentTable::DeLevaMale)).unwrap();
    let walk = walk(&human, StandingMovements::speed(&human));
    let StandingMovements { stop, start, steps } =
        StandingMovements::find(&human, &walk).and_then(|found| found.with_steps(&human, &walk)).unwrap();
    let (forward, weight_n) = (human.model.coordinate("pelvis_tx").unwrap().index(), human.model.mass() * G);
    let [stops, joins] = StandingMovements::JOINS.map(|share| state_at(&walk, share * walk.cycle_s()));
    let rest = state_at(&stop, stop.problem().duration_s);
    let steps = steps.expect("steps in three dimensions");
    for (name, movement, begins, ends) in
        [("stop", &stop, &stops, &rest), ("start", &start, &rest, &joins), ("steps", &steps, &rest, &rest)]
    {
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
    feet_are_side_by_side(&stop);
    leans_as_people_do(&human, &rest[0]);
    starts_as_people_do(&human, &start, &walk);
    lifts_one_foot_after_the_other(&steps, weight_n);
}

/// Places of the heels forward [m], right and left.
fn heels(motion: &Solution, sample: &Sample) -> [f64; 2] {
    let soles = &motion.problem().soles;
    Side::BOTH.map(|side| {
        let heel = soles.iter().position(|sole| sole.side == side && sole.part == SpherePart::Heel).unwrap();
        sample.contacts[heel].place.x
    })
}

fn feet_are_side_by_side(stop: &Solution) {
    let [right, left] = heels(stop, samples(stop).last().unwrap());
    println!("heels {:.1} mm apart after the stop", 1e3 * (right - left));
    assert!((right - left).abs() < 0.02, "{right} {left}");
}

/// The hip joints are 62 mm ahead of the ankles in the mean of fifteen people, with a standard deviation of 13 mm
/// (Woodhull, Maltrud, Mello 1985, abstract read); knees are not locked. The figure is within two of them.
fn leans_as_people_do(human: &Human, rest: &[f64]) {
    let still = vec![0.0; rest.len()];
    let mut sweep = PostureSweep::new(&human.model);
    sweep.update(Posture { q: rest, qd: &still, qdd: &still });
    let anatomy = human.model.anatomy();
    for side in Side::BOTH {
        let x = |movement: Movement| {
            let coordinate = anatomy.coordinate(movement, Some(side)).unwrap().0;
            let moved = human.model.bodies().iter().position(|body| body.joint.coordinates().contains(&coordinate));
            sweep.joint_centers()[moved.unwrap()].x
        };
        let ahead = x(Movement::HipFlexion) - x(Movement::AnkleDorsiflexion);
        let (knee, sign) = anatomy.coordinate(Movement::KneeFlexion, Some(side)).unwrap();
        let flexed_deg = (sign * rest[knee.index()]).to_degrees();
        println!("{side:?} hip {:.0} mm ahead of the ankle, knee flexed by {flexed_deg:.1} deg", 1e3 * ahead);
        assert!(
            (ahead - 0.062).abs() < 2.0 * 0.013 && (1.0..10.0).contains(&flexed_deg),
            "{side:?}: {ahead} {flexed_deg}"
        );
    }
}

/// Vertical force on a foot, a share of the weight.
fn load(motion: &Solution, sample: &Sample, side: Side, weight_n: f64) -> f64 {
    let of_side = motion.problem().soles.iter().zip(&sample.contacts).filter(|(sole, _)| sole.side == side);
    of_side.map(|(_, contact)| contact.force.y).sum::<f64>() / weight_n
}

/// Centre of pressure of both feet [m], forward and to the right.
fn center(sample: &Sample) -> [f64; 2] {
    let load: f64 = sample.contacts.iter().map(|contact| contact.force.y).sum();
    let of = |axis: usize| sample.contacts.iter().map(|c| c.force.y * c.place[axis]).sum::<f64>() / load;
    [of(0), of(2)]
}

/// Times of the strikes of a foot after a swing, with its heel there.
fn strikes(motion: &Solution, samples: &[Sample], side: Side, weight_n: f64) -> Vec<(f64, f64)> {
    let loaded = |sample: &Sample| load(motion, sample, side, weight_n) > 0.05;
    let pairs = samples.windows(2).filter(|pair| !loaded(&pair[0]) && loaded(&pair[1]));
    // The heel slides a little while the foot comes down.
    let settled = |time_s: f64| samples.iter().find(|sample| sample.time_s >= time_s + 0.15);
    let own = usize::from(side == Side::Left);
    pairs.filter_map(|pair| Some((pair[1].time_s, heels(motion, settled(pair[1].time_s)?)[own]))).collect()
}

/// The load first moves to the foot that is then lifted, as before a step forward; each foot comes down where it stood.
fn lifts_one_foot_after_the_other(steps: &Solution, weight_n: f64) {
    let samples = samples(steps);
    let off = |side: Side| samples.iter().position(|sample| load(steps, sample, side, weight_n) < 0.002).unwrap();
    let strikes = Side::BOTH.map(|side| strikes(steps, &samples, side, weight_n));
    let [right, left] = strikes.each_ref().map(|strikes| strikes[0]);
    let most = samples[..off(Side::Left)].iter().map(|sample| load(steps, sample, Side::Left, weight_n));
    let most = most.fold(0.0, f64::max);
    let standing = heels(steps, &samples[0]);
    println!(
        "steps: up to {most:.2} of the weight on the left foot, off at {:.2} s, down at {:.2} s {:.0} mm further; \
         right \
         foot off at {:.2} s, down at {:.2} s {:.0} mm further",
        samples[off(Side::Left)].time_s,
        left.0,
        1e3 * (left.1 - standing[1]),
        samples[off(Side::Right)].time_s,
        right.0,
        1e3 * (right.1 - standing[0]),
    );
    assert!(most > 0.6 && strikes.iter().all(|strikes| strikes.len() == 1));
    assert!(left.0 < samples[off(Side::Right)].time_s && left.0 < 0.5 * steps.problem().duration_s + 0.1);
    assert!((left.1 - standing[1]).abs() < 0.02 && (right.1 - standing[0]).abs() < 0.02);
}

/// As people do: the centre of pressure first moves back and towards the foot that will swing, the pelvis hardly moves
/// back, no foot swings higher than in the walk, and the first step is shorter than a step of the walk.
fn starts_as_people_do(human: &Human, start: &Solution, walk: &Solution) {
    let (samples, weight_n) = (samples(start), human.model.mass() * G);
    let off = samples.iter().position(|sample| load(start, sample, Side::Left, weight_n) < 0.002).unwrap();
    let [from, right] = center(&samples[0]);
    let before = &samples[..off];
    let back = from - before.iter().map(|sample| center(sample)[0]).fold(f64::INFINITY, f64::min);
    let shift = before.iter().map(|sample| right - center(sample)[1]);
    let (farthest, left) = shift.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    let steady = 0.5 * walk.speed() * walk.cycle_s();
    let (first_s, first_x) = strikes(start, &samples, Side::Left, weight_n)[0];
    let (second_s, second_x) = strikes(start, &samples, Side::Right, weight_n)[0];
    let standing = heels(start, &samples[0])[0];
    let steps = [first_x - standing, second_x - first_x].map(|length| length / steady);
    let forward = human.model.anatomy().coordinate(Movement::PelvisForward, None).unwrap().0.index();
    let place = |sample: &Sample| sample.posture[0][forward];
    let rocked = place(&samples[0]) - samples.iter().map(place).fold(f64::INFINITY, f64::min);
    let highest = |samples: &[Sample]| {
        let heights = samples.iter().flat_map(|sample| sample.contacts.iter().map(|contact| 2.0 * contact.place.y));
        heights.fold(0.0, f64::max)
    };
    let higher = highest(&samples) - highest(&self::samples(walk));
    println!(
        "start: centre of pressure {:.0} mm back and {:.0} mm to the left, farthest at {:.2} s; left foot off at {:.2} \
         s, down at {first_s:.2} s; right foot down at {second_s:.2} s; steps {:.0} % and {:.0} % of {steady:.2} m; \
         pelvis {:.0} mm back; soles {:.0} mm higher than in the walk",
        1e3 * back,
        1e3 * left,
        samples[farthest].time_s,
        samples[off].time_s,
        100.0 * steps[0],
        100.0 * steps[1],
        1e3 * rocked,
        1e3 * higher
    );
    assert!(back > 0.01 && left > 0.01 && samples[farthest].time_s < 0.6 * samples[off].time_s);
    assert!((0.6..0.9).contains(&steps[0]) && (0.6..1.1).contains(&steps[1]), "{steps:?}");
    assert!(rocked < 0.03 && higher < 0.03, "{rocked} {higher}");
}

/// A slow walk from which a figure in three dimensions stops.
fn slow(build: &Build, lift_m: f64) -> OptimalWalk {
    let planar = build.human().unwrap();
    let mut gait = Gait::named("free").unwrap();
    gait.pace.speed = Some(Speed::MetersPerSecond(StandingMovements::speed(&planar)));
    let walk = Walk::new(&gait, planar.dimensions.leg_length, &mut Findings::default()).unwrap();
    OptimalWalk::find_lifted(build, &walk, lift_m, &Observer::default()).unwrap()
}

fn cost(movement: &Solution) -> f64 {
    movement.progress.last().unwrap().cost
}

fn steps_of_solver(movement: &Solution) -> usize {
    movement.progress.iter().map(|stage| stage.steps).sum()
}

/// The built-in movements belong to the present problem, and the last stage of the solver gains nothing on them.
#[test]
fn built_in_movements_solve_the_present_problem() {
    let found = slow(&Build::usual(SegmentTable::DeLevaMale), 0.0);
    let (human, walk) = (found.figure(), &found.solution);
    let movements = StandingMovements::find(&human, walk).and_then(|found| found.with_steps(&human, walk)).unwrap();
    let steps = movements.steps.as_ref().unwrap();
    for (name, movement) in [("stop", &movements.stop), ("start", &movements.start), ("steps", steps)] {
        assert_eq!((steps_of_solver(movement), movement.unbalanced(NO_ROOT_FORCE)), (0, None), "{name}");
        let again = movement.problem().solve(movement.unknowns(), &STAGES[STAGES.len() - 1..]).unwrap();
        println!("{name}: cost {:.3}, solved on {:.3}", cost(movement), cost(&again));
        assert!(cost(&again) > 0.98 * cost(movement), "{name}");
    }
}

/// Feet that are lifted higher walk at the same speed and cadence, but otherwise where the movements join the walk.
#[test]
fn a_built_in_movement_is_not_taken_for_another_walk_or_figure() {
    let usual = Build::usual(SegmentTable::DeLevaMale);
    for (build, lift_m) in
        [(usual, 0.03), (Build { mass: 60.0, height: 1.65, ..Build::usual(SegmentTable::DeLevaFemale) }, 0.0)]
    {
        let found = slow(&build, lift_m);
        let movements = StandingMovements::find(&found.figure(), &found.solution).unwrap();
        for (name, movement) in [("stop", &movements.stop), ("start", &movements.start)] {
            println!(
                "{name} of {} kg, lifted {lift_m} m: {} steps, cost {:.2}",
                build.mass,
                steps_of_solver(movement),
                cost(movement)
            );
            assert!(steps_of_solver(movement) > 0, "{name}");
            assert_eq!(movement.unbalanced(NO_ROOT_FORCE), None, "{name}");
        }
        assert!(movements.join(&found.solution));
    }
}

#[test]
fn a_fast_walk_has_no_stop_and_start() {
    let human = Build::usual(SegmentTable::DeLevaMale).human().unwrap();
    let error = StandingMovements::find(&human, &walk(&human, 1.7)).err().unwrap();
    println!("{error}");
    assert!(error.to_string().contains("for a walk at 1.70 m/s"), "{error}");
}
