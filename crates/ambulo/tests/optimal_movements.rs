//! Movements that do not repeat: a squat, a jump, and standing up from a chair. Their code is that of docs/OPTIMAL.md.

use ambulo::dynamics::{Workspace, inverse_with_residual};
use ambulo::findings::Findings;
use ambulo::ground::predict::{PredictSettings, predict};
use ambulo::kinematics::{Posture, Trajectory, body_motion};
use ambulo::model::Movement::{self, AnkleDorsiflexion, HipFlexion, KneeFlexion, PelvisUp};
use ambulo::model::anthropometry::{Build, ContactSphere, Human, SegmentTable, SpherePart};
use ambulo::model::full_body::full_body;
use ambulo::model::{BySide, Side};
use ambulo::motion::TimeGrid;
use ambulo::numerics::correlation;
use ambulo::optimal::{Bound, EffortCosts, Key, MovementError, MovementProblem, MovementSettings, Quantity};
use ambulo::optimal::{Sample, Solution};
use ambulo::spatial::Vec3;
use std::error::Error;
use std::sync::LazyLock;

const STANDING: [(Movement, f64); 0] = [];
const DEEP: [(Movement, f64); 3] = [(HipFlexion, 95.0), (KneeFlexion, 100.0), (AnkleDorsiflexion, 25.0)];
/// Root residual that counts as none, as for walks.
const NO_ROOT_FORCE: f64 = 1e-4;
const G: f64 = 9.80665;

fn man() -> Human {
    Build::usual(SegmentTable::DeLevaMale).human().unwrap()
}

/// Down to a height of the pelvis, as a share of leg length, and up again.
fn squat(human: &Human, depth: f64, lowest_s: f64) -> Result<Solution, Box<dyn Error>> {
    let keys = [Key::new(0.0, &STANDING), Key::new(lowest_s, &DEEP), Key::new(2.0 * lowest_s, &STANDING)];
    let mut squat = MovementProblem::new(human, &keys, &MovementSettings::default())?;
    let (height, _) = squat.coordinate(PelvisUp).ok_or("a figure without a pelvis")?;
    let low = depth * human.dimensions.leg_length;
    squat.require([lowest_s, lowest_s], Quantity::Position(vec![(height, 1.0)]), Bound::AtMost, low, 1e-3);
    Ok(squat.solve()?)
}

static SQUAT: LazyLock<Solution> = LazyLock::new(|| squat(&man(), 0.65, 1.0).unwrap());

/// Up from standing until the pelvis is `rise_m` higher than in standing.
fn jump(human: &Human, rise_m: f64) -> Result<Solution, Box<dyn Error>> {
    let pushing = [(HipFlexion, 20.0), (KneeFlexion, 25.0), (AnkleDorsiflexion, -15.0)];
    let on_toes = [(AnkleDorsiflexion, -35.0)];
    let keys = [
        Key::new(0.0, &STANDING),
        Key::new(0.5, &DEEP),
        Key::new(0.85, &pushing),
        Key::new(1.0, &on_toes),
        Key::new(1.2, &on_toes),
        Key::new(1.35, &pushing),
        Key::new(1.7, &DEEP),
        Key::new(2.5, &STANDING),
    ];
    // A jump is not economical, and the pelvis accelerates.
    let costs = EffortCosts { power: 3.0, pelvis: 10.0, ..EffortCosts::default() };
    let settings =
        MovementSettings { costs, flights_s: vec![[0.9, 1.3]], knots_per_s: 50.0, ..MovementSettings::default() };
    let mut jump = MovementProblem::new(human, &keys, &settings)?;
    let (height, _) = jump.coordinate(PelvisUp).ok_or("a figure without a pelvis")?;
    let high = human.dimensions.leg_length + rise_m;
    jump.require([1.1, 1.1], Quantity::Position(vec![(height, 1.0)]), Bound::AtLeast, high, 1e-3);
    Ok(jump.solve()?)
}

/// Up from a chair.
fn stand_up(human: &Human, seat_m: f64) -> Result<Solution, Box<dyn Error>> {
    let sitting = [(HipFlexion, 85.0), (KneeFlexion, 95.0), (AnkleDorsiflexion, 10.0)];
    let leaning = [(HipFlexion, 115.0), (KneeFlexion, 95.0), (AnkleDorsiflexion, 15.0)];
    let keys = [Key::new(0.0, &sitting), Key::new(0.7, &leaning), Key::new(2.0, &STANDING)];
    let pelvis = human.model.body("pelvis").ok_or("a figure without a pelvis")?;
    let center = Vec3::new(0.0, -0.03, 0.0);
    let (name, part) = ("seat".to_owned(), SpherePart::Other);
    let seat = ContactSphere { name, part, side: Side::Right, body: pelvis, center, radius: 0.06 };
    let settings = MovementSettings { surfaces: vec![(seat, seat_m)], ..MovementSettings::default() };
    Ok(MovementProblem::new(human, &keys, &settings)?.solve()?)
}

/// Samples every 2 ms.
fn samples(solution: &Solution) -> Vec<Sample> {
    let count = (500.0 * solution.problem().duration_s) as usize;
    let times: Vec<f64> = (0..=count).map(|k| solution.problem().duration_s * k as f64 / count as f64).collect();
    solution.samples(&times).unwrap()
}

/// Integral over time of a quantity of the samples.
fn integral(samples: &[Sample], of: impl Fn(&Sample) -> f64) -> f64 {
    samples.windows(2).map(|pair| 0.5 * (of(&pair[0]) + of(&pair[1])) * (pair[1].time_s - pair[0].time_s)).sum()
}

fn weight(solution: &Solution) -> f64 {
    solution.problem().model.mass() * G
}

fn ground(solution: &Solution, sample: &Sample) -> Vec3 {
    sample.ground_force(&(0..solution.problem().soles.len()).collect::<Vec<_>>())
}

fn largest(solution: &Solution, coordinate: &str) -> f64 {
    let id = solution.problem().model.coordinate(coordinate).unwrap().index();
    solution.forces().map(|forces| forces[id].abs()).fold(0.0, f64::max)
}

/// Height and vertical velocity of the mass centre.
fn mass_center(solution: &Solution, sample: &Sample) -> [f64; 2] {
    let model = &solution.problem().model;
    let [q, qd, qdd] = &sample.posture;
    let bodies = body_motion(model, Posture { q, qd, qdd });
    let sum = |of: &dyn Fn(usize) -> f64| {
        (0..bodies.len()).map(|k| model.bodies()[k].inertia.mass() * of(k)).sum::<f64>() / model.mass()
    };
    [sum(&|k| bodies[k].center.y), sum(&|k| bodies[k].twist.linear.y)]
}

fn assert_solved(solution: &Solution) {
    println!("{:?}", solution.progress.last().unwrap());
    println!("between the instants {:?}", solution.root_forces(10).unwrap());
    assert_eq!(solution.unbalanced(NO_ROOT_FORCE), None);
    assert_eq!(solution.overload(0.05), None);
    // A figure that begins and ends at rest gets the impulse of its weight from the ground, and no other.
    let samples = samples(solution);
    let [along, up] = [0, 1].map(|axis| integral(&samples, |s| ground(solution, s)[axis]));
    let expected = weight(solution) * solution.problem().duration_s;
    println!("impulse {:.4} of weight times duration, {:.4} forward", up / expected, along / expected);
    assert!((up / expected - 1.0).abs() < 2e-3, "{up} N.s, expected {expected}");
    assert!((along / expected).abs() < 2e-3, "{along} N.s");
}

#[test]
fn a_squat_goes_down_and_up_without_outside_forces() {
    let (human, solution) = (man(), &*SQUAT);
    assert_solved(solution);
    let height = human.model.coordinate("pelvis_ty").unwrap().index();
    let lowest = samples(solution).iter().map(|s| s.posture[0][height]).fold(f64::INFINITY, f64::min);
    assert!((lowest / human.dimensions.leg_length - 0.65).abs() < 0.02, "{lowest} m");
    for sample in samples(solution) {
        // The centre of pressure stays under the feet.
        let (mut moment, mut load, mut ends) = (0.0, 0.0, [f64::INFINITY, f64::NEG_INFINITY]);
        for (contact, sole) in sample.contacts.iter().zip(&solution.problem().soles) {
            moment += contact.place.x * contact.force.y;
            load += contact.force.y;
            ends = [ends[0].min(contact.place.x - sole.radius), ends[1].max(contact.place.x + sole.radius)];
        }
        assert!(load > 0.3 * weight(solution), "{load} N at {} s", sample.time_s);
        assert!((ends[0]..ends[1]).contains(&(moment / load)), "{} m at {} s", moment / load, sample.time_s);
    }
}

#[test]
fn a_deeper_squat_needs_more_of_the_knees() {
    let shallow = squat(&man(), 0.8, 1.0).unwrap();
    let [shallow, deep] = [&shallow, &*SQUAT].map(|solution| largest(solution, "knee_angle_r"));
    println!("largest knee moment {shallow:.1} N.m and {deep:.1} N.m");
    assert!(deep > 1.15 * shallow);
}

#[test]
fn both_legs_do_nearly_the_same_in_a_squat_in_three_dimensions() {
    let human = full_body(&Build::usual(SegmentTable::DeLevaMale)).unwrap();
    let solution = squat(&human, 0.75, 0.6).unwrap();
    assert_solved(&solution);
    for joint in ["hip_flexion", "knee_angle", "ankle_angle"] {
        let [right, left] = ["r", "l"].map(|side| largest(&solution, &format!("{joint}_{side}")));
        assert!((right / left - 1.0).abs() < 0.05, "{joint}: {right} and {left} N.m");
    }
}

#[test]
fn a_jumper_flies_as_a_thrown_body_does() {
    let human = man();
    let solution = jump(&human, 0.2).unwrap();
    assert_solved(&solution);
    let samples = samples(&solution);
    let up = |s: &Sample| ground(&solution, s).y;
    let flight: Vec<&Sample> = samples.iter().filter(|s| up(s) <= 0.0).collect();
    let (first, last) = (flight[0], flight[flight.len() - 1]);
    println!("flight from {:.3} to {:.3} s", first.time_s, last.time_s);
    assert!(last.time_s - first.time_s > 0.25 && flight.len() as f64 > 490.0 * (last.time_s - first.time_s));
    // Impulse gives the velocity at take-off, and gravity the height from there.
    let before: Vec<Sample> = samples.iter().filter(|s| s.time_s <= first.time_s).cloned().collect();
    let thrown = integral(&before, |s| up(s) / human.model.mass() - G);
    let [start, velocity] = mass_center(&solution, first);
    let top = flight.iter().map(|s| mass_center(&solution, s)[0]).fold(0.0, f64::max);
    println!(
        "take-off at {velocity:.3} m/s, by impulse {thrown:.3} m/s; rise {:.4} m, by gravity {:.4} m",
        top - start,
        velocity * velocity / (2.0 * G)
    );
    assert!((thrown - velocity).abs() < 0.02 * velocity);
    assert!((top - start - velocity * velocity / (2.0 * G)).abs() < 0.003);
}

#[test]
fn a_jump_that_no_muscle_can_do_is_seen() {
    let high = jump(&man(), 0.9).unwrap();
    let found = (high.overload(0.05), high.unbalanced(NO_ROOT_FORCE));
    println!("{found:?}");
    assert!(found.0.is_some() || found.1.is_some());
}

#[test]
fn who_stands_up_leaves_the_seat_and_needs_the_knees_most_just_then() {
    let human = man();
    let solution = stand_up(&human, 0.437).unwrap();
    assert_solved(&solution);
    let samples = samples(&solution);
    let seat = solution.problem().soles.len() - 1;
    let load = |s: &Sample| s.contacts[seat].force.y / weight(&solution);
    let off = samples.iter().rposition(|s| load(s) > 0.0).unwrap();
    println!("seat carries {:.2} of the weight at first, leaves at {:.2} s", load(&samples[0]), samples[off].time_s);
    assert!((0.6..0.95).contains(&load(&samples[0])), "{}", load(&samples[0]));
    assert!((0.3..1.2).contains(&samples[off].time_s));
    let knee = human.model.coordinate("knee_angle_r").unwrap().index();
    let moment = |s: &&Sample| s.forces[knee] / human.model.mass();
    let strongest = samples.iter().max_by(|a, b| moment(a).total_cmp(&moment(b))).unwrap();
    println!("knee {:.2} N.m/kg at {:.2} s", moment(&strongest), strongest.time_s);
    assert!((strongest.time_s - samples[off].time_s).abs() < 0.25 && moment(&strongest) > 0.5);
}

#[test]
fn the_guide_has_this_code() {
    let (guide, here) = (include_str!("../../../docs/OPTIMAL.md"), include_str!("optimal_movements.rs"));
    for name in ["squat", "jump", "stand_up"] {
        let (_, code) = here.split_once(&format!("\nfn {name}(")).unwrap();
        let (code, _) = code.split_once("\n}\n").unwrap();
        assert!(guide.contains(code), "docs/OPTIMAL.md does not have `{name}`");
    }
}

#[test]
fn keys_out_of_order_are_refused() {
    let human = man();
    let build = |times: &[f64]| {
        let keys: Vec<Key> = times.iter().map(|time_s| Key::new(*time_s, &STANDING)).collect();
        MovementProblem::new(&human, &keys, &MovementSettings::default()).err()
    };
    assert_eq!(build(&[0.0]), Some(MovementError::Keys { count: 1 }));
    for (times, expected) in [
        (vec![0.1, 1.0], "key posture 1 is at 0.1 s; expected 0 s"),
        (vec![0.0, 1.0, 1.0], "key posture 3 is at 1 s; expected later than 1 s"),
        (vec![0.0, f64::NAN], "key posture 2 is at NaN s; expected later than 0 s"),
        (vec![0.0, f64::INFINITY], "key posture 2 is at inf s; expected later than 0 s"),
    ] {
        assert_eq!(build(&times).unwrap().to_string(), expected);
    }
}

/// The motion of a solution at 100 Hz, its exact centre of pressure along the way [m] and the torques of both ankles
/// [N.m].
fn motion_with_truth(solution: &Solution) -> (Trajectory, Vec<f64>, [Vec<f64>; 2]) {
    let problem = solution.problem();
    let step_s = 0.01;
    let grid = TimeGrid { start_s: 0.0, step_s, frames: (problem.duration_s / step_s) as usize + 1 };
    let samples = solution.samples(&(0..grid.frames).map(|i| grid.time(i)).collect::<Vec<_>>()).unwrap();
    let column = |k: usize| std::array::from_fn(|part| samples.iter().map(|s| s.posture[part][k]).collect());
    let columns = (0..problem.model.coordinates().len()).map(column).collect();
    let center = |sample: &Sample| {
        let moment: f64 = sample.contacts.iter().map(|contact| contact.place.x * contact.force.y).sum();
        moment / ground(solution, sample).y
    };
    let ankles = ["ankle_angle_r", "ankle_angle_l"].map(|name| {
        let id = problem.model.coordinate(name).unwrap().index();
        samples.iter().map(|s| s.forces[id]).collect()
    });
    (Trajectory::new(&problem.model, grid, columns).unwrap(), samples.iter().map(center).collect(), ankles)
}

#[test]
fn predicted_forces_of_a_squat_have_its_centre_of_pressure_and_its_ankle_moment() {
    let human = man();
    for (depth, lowest_s) in [(0.65, 1.0), (0.8, 1.2)] {
        let solution = squat(&human, depth, lowest_s).unwrap();
        let (trajectory, truth, ankles) = motion_with_truth(&solution);
        let model = &solution.problem().model;
        let soles = BySide::from_fn(|side| human.sole(side));
        let settings = PredictSettings::default();
        let predicted = predict(model, &trajectory, &soles, &settings, &mut Findings::default()).unwrap();
        let loads = predicted.ground.loads();
        let found = inverse_with_residual(&mut Workspace::new(model), &trajectory, &loads);
        // The first and the last 0.2 s are within the filter's length of the ends.
        let judged = 20..truth.len() - 20;
        let off: Vec<f64> = judged
            .clone()
            .map(|i| {
                let feet = &predicted.ground.bodies;
                let load: f64 = feet.iter().map(|foot| foot.force[i].y).sum();
                let center: f64 = feet.iter().map(|foot| foot.force[i].y * foot.center_of_pressure[i].x).sum();
                center / load - truth[i]
            })
            .collect();
        let rms_mm = 1e3 * (off.iter().map(|x| x * x).sum::<f64>() / off.len() as f64).sqrt();
        let id = model.coordinate("ankle_angle_r").unwrap().index();
        let own: Vec<f64> = judged.clone().map(|i| found.generalized[id][i]).collect();
        let r = correlation(&own, &ankles[0][judged]);
        println!("squat to {depth} of leg length: centre of pressure {rms_mm:.1} mm, ankle moment r {r:.3}");
        assert!(rms_mm < 25.0 && r > 0.9, "{rms_mm} mm, r {r}");
    }
}
