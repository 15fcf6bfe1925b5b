//! Predicted forces against those that the simulator applied to the same motion.
//!
//! | claim                                                     | tolerance and its reason                                    |
//! |-----------------------------------------------------------|-------------------------------------------------------------|
//! | the total force is the sum of the feet's                  | 2 N: what the simulated walk's root lacks (synthetic_walk.rs) |
//! | the forces of the feet add to the total in stance         | rounding                                                    |
//! | what no foot explains widens the deviations it concerns   | by 15 %, others by at most 6 %: half and twice what was found   |
//! | with everything prescribed the forces are the simulator's | 25 N: the total's 2 N, and 20 N below which no foot is loaded |

use crate::walks;
use ambulo::analysis::feasibility::Person;
use ambulo::findings::Findings;
use ambulo::ground::footfalls::{Footfall, Footfalls};
use ambulo::ground::phases::contacts_from_force;
use ambulo::ground::predict::{PredictError, PredictSettings, Prediction, Prescribed, predict, total_wrench};
use ambulo::ground::{GroundForces, feet, measured};
use ambulo::model::{BySide, Model, Side};
use ambulo::simulation::synthetic::SyntheticWalk;
use ambulo::spatial::{Vec3, Wrench};
use std::f64::consts::TAU;

fn walk() -> &'static SyntheticWalk {
    walks::corrected(walks::WITHOUT_TOES, 2)
}

/// Ground forces that the simulator applied, one entry per foot.
fn applied(walk: &SyntheticWalk) -> GroundForces {
    let mut findings = Findings::default();
    let ground = measured(&walk.human.model, &walk.trajectory, &walk.loads, None, &mut findings).unwrap();
    let bodies = feet(&walk.human.model, &ground).into_iter().map(|(_, forces)| forces.into_owned()).collect();
    GroundForces { bodies }
}

fn predicted(walk: &SyntheticWalk, prescribed: Prescribed) -> Prediction {
    let soles = Person::of_human(&walk.human).soles;
    let settings = PredictSettings { prescribed, ..PredictSettings::default() };
    predict(&walk.human.model, &walk.trajectory, &soles, &settings, &mut Findings::default()).unwrap()
}

/// Stances from the forces of the simulator.
fn true_footfalls(walk: &SyntheticWalk, applied: &GroundForces) -> Footfalls {
    let times = walk.trajectory.grid().times();
    let mut falls = Vec::new();
    for (side, foot) in Side::BOTH.into_iter().zip(applied.bodies.iter()) {
        let vertical: Vec<f64> = foot.force.iter().map(|f| f.y).collect();
        falls.extend(contacts_from_force(&times, &vertical).into_iter().map(|contact| Footfall {
            side,
            strike_s: contact.strike_s,
            off_s: contact.off_s,
            floor_height_m: 0.0,
            floor_velocity: Vec3::zeros(),
        }));
    }
    falls.sort_by(|a, b| a.strike_s.partial_cmp(&b.strike_s).unwrap());
    Footfalls { falls, floor_velocity: Vec3::zeros() }
}

fn largest_difference(a: &[Vec3], b: &[Vec3]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}

#[test]
fn the_total_force_is_what_the_simulator_applied() {
    let walk = walk();
    let total: Vec<Vec3> = total_wrench(&walk.human.model, &walk.trajectory).iter().map(|w| w.force).collect();
    let [right, left] = &applied(walk).bodies[..] else { panic!("two feet") };
    let sum: Vec<Vec3> = right.force.iter().zip(&left.force).map(|(a, b)| a + b).collect();
    let worst = largest_difference(&total, &sum);
    println!("the total force differs by {worst:.3} N at most");
    assert!(worst < 2.0, "{worst} N");
    // One foot alone is not the total.
    assert!(largest_difference(&total, &right.force) > 500.0);
}

#[test]
fn both_feet_together_give_the_total() {
    let walk = walk();
    let prediction = predicted(walk, Prescribed::default());
    let [right, left] = &prediction.ground.bodies[..] else { panic!("two feet") };
    let weight = walk.human.model.mass() * walk.human.model.gravity().norm();
    let missing: Vec<Vec3> =
        (0..right.force.len()).map(|i| right.force[i] + left.force[i] - prediction.total[i].force).collect();
    // After a low-pass filter: sharper features come from the prior.
    let window = 25;
    let means = missing.windows(window).map(|w| w.iter().sum::<Vec3>() / window as f64);
    let worst = means.map(|mean| mean.norm() / weight).fold(0.0, f64::max);
    println!(
        "averaged over a quarter of a second the feet deviate from the total by {:.2} % of the weight at most",
        100.0 * worst
    );
    assert!(worst < 0.05, "{worst} of the weight");
    assert!(prediction.footfalls.events().len() >= 8, "{:?}", prediction.footfalls.events());
    let mut swings = 0;
    for (foot, deviation) in prediction.ground.bodies.iter().zip(&prediction.deviations) {
        for i in 0..foot.force.len() {
            let is_loaded = !foot.center_of_pressure[i].x.is_nan();
            let deviates = deviation.force[i].y > 0.0;
            assert!(deviates || !is_loaded, "a deviation where there is a force, frame {i}");
            swings += usize::from(!deviates);
        }
    }
    assert!(swings > 3 * right.force.len() / 5, "each foot swings for about 40 % of a walk: {swings}");
}

#[test]
fn with_everything_prescribed_the_forces_are_those_that_were_applied() {
    let walk = walk();
    let applied = applied(walk);
    let [right, left] = &applied.bodies[..] else { panic!("two feet") };
    let share = right.force.iter().zip(&left.force).map(|(r, l)| r.y / (r.y + l.y)).collect();
    let prescribed = Prescribed {
        footfalls: Some(true_footfalls(walk, &applied)),
        total: Some(total_wrench(&walk.human.model, &walk.trajectory)),
        right_share: Some(share),
        centers: Some(BySide { right: right.center_of_pressure.clone(), left: left.center_of_pressure.clone() }),
    };
    let vertical = |prescribed: Prescribed| {
        let prediction = predicted(walk, prescribed);
        let feet = prediction.ground.bodies.iter().zip(applied.bodies.iter());
        feet.flat_map(|(found, truth)| found.force.iter().zip(&truth.force).map(|(a, b)| (a.y - b.y).abs()))
            .fold(0.0, f64::max)
    };
    let (informed, alone) = (vertical(prescribed), vertical(Prescribed::default()));
    println!("vertical forces differ by {informed:.1} N with everything prescribed, by {alone:.1} N without");
    assert!(informed < 25.0, "{informed} N");
    assert!(alone > 2.0 * informed, "{alone} N without, {informed} N with");
}

/// Deviations of a walk whose required wrench has something added, over those without it, rms over the stances of both
/// feet: force forward and up, centre of pressure along and across.
fn widened(walk: &SyntheticWalk, added: impl Fn(f64) -> Wrench) -> [f64; 4] {
    let rms = |total: Vec<Wrench>| {
        let found = predicted(walk, Prescribed { total: Some(total), ..Prescribed::default() });
        let deviations = || found.deviations.iter().flat_map(|foot| foot.force.iter().zip(&foot.center));
        let of = |value: fn(&Vec3, &Vec3) -> f64| deviations().map(|(f, c)| value(f, c).powi(2)).sum::<f64>().sqrt();
        [of(|force, _| force.x), of(|force, _| force.y), of(|_, center| center.x), of(|_, center| center.z)]
    };
    let plain = total_wrench(&walk.human.model, &walk.trajectory);
    let changed = plain.iter().zip(walk.trajectory.grid().times()).map(|(total, time)| {
        let added = added(time);
        Wrench { force: total.force + added.force, moment: total.moment + added.moment }
    });
    let (changed, plain) = (rms(changed.collect()), rms(plain.clone()));
    std::array::from_fn(|k| changed[k] / plain[k])
}

#[test]
fn a_motion_that_contradicts_itself_has_wider_deviations() {
    let walk = walk();
    let wave = |time: f64| (TAU * 5.0 * time).sin();
    let nothing = widened(walk, |_| Wrench::ZERO);
    assert!(nothing.iter().all(|ratio| (ratio - 1.0).abs() < 1e-12), "{nothing:?}");
    let [forward, up, ..] = widened(walk, |time| Wrench { force: Vec3::x() * (100.0 * wave(time)), ..Wrench::ZERO });
    println!("a force forward that no foot explains: deviations forward x {forward:.2}, up x {up:.2}");
    assert!(forward > 1.15 && up < 1.05, "{forward}, {up}");
    let tilting = |axis: Vec3| move |time| Wrench { moment: axis * (60.0 * wave(time)), ..Wrench::ZERO };
    let [_, up, along, across] = widened(walk, tilting(Vec3::z()));
    println!("a moment about the axis to the right: centre along x {along:.2}, across x {across:.2}, up x {up:.2}");
    assert!(along > 1.15 && across < 1.05 && up < 1.05, "{along}, {across}, {up}");
    let [.., along, across] = widened(walk, tilting(Vec3::x()));
    println!("a moment about forward: centre along x {along:.2}, across x {across:.2}");
    assert!(across > 1.15 && along < 1.06, "{along}, {across}");
}

#[test]
fn a_model_without_feet_and_prescribed_series_of_another_length_are_rejected() {
    let walk = walk();
    let soles = Person::of_human(&walk.human).soles;
    let model = &walk.human.model;
    let refused = |model: &Model, soles: &_, settings: &PredictSettings| {
        predict(model, &walk.trajectory, soles, settings, &mut Findings::default()).unwrap_err()
    };
    let error = refused(model, &BySide { left: None, ..soles }, &PredictSettings::default());
    assert_eq!(error, PredictError::NoSole { model: model.name().to_owned(), side: Side::Left });
    assert!(error.to_string().contains("left sole") && error.to_string().contains("expected"), "{error}");
    let prescribed = Prescribed { right_share: Some(vec![0.5; 3]), ..Prescribed::default() };
    let error = refused(model, &soles, &PredictSettings { prescribed, ..PredictSettings::default() });
    assert!(error.to_string().contains("3 frames"), "{error}");
    let mut bodies = model.bodies().to_vec();
    for body in &mut bodies {
        body.name = body.name.replace("calcn", "hoof").replace("talus", "pastern");
    }
    let horse = Model::new("horse", model.gravity(), bodies, model.coordinates().to_vec(), Vec::new()).unwrap();
    assert_eq!(horse.anatomy().feet(), model.anatomy().feet(), "feet are recognised under any name");
    let error = refused(&horse, &BySide::default(), &PredictSettings::default());
    assert!(error.to_string().contains("horse") && error.to_string().contains("expected both legs"), "{error}");
}

#[test]
fn fore_aft_and_vertical_forces_follow_those_of_the_simulator() {
    let walk = walk();
    let (prediction, applied) = (predicted(walk, Prescribed::default()), applied(walk));
    let weight = walk.human.model.mass() * walk.human.model.gravity().norm();
    for (found, truth) in prediction.ground.bodies.iter().zip(applied.bodies.iter()) {
        for (axis, most) in [(0, 0.05), (1, 0.15)] {
            let pairs: Vec<(f64, f64)> =
                found.force.iter().zip(&truth.force).map(|(a, b)| (a[axis], b[axis])).collect();
            let rms = |of: &dyn Fn(&(f64, f64)) -> f64| {
                (pairs.iter().map(|pair| of(pair).powi(2)).sum::<f64>() / pairs.len() as f64).sqrt() / weight
            };
            let (apart, size) = (rms(&|(a, b)| a - b), rms(&|(_, b)| *b));
            println!(
                "axis {axis}: {:.2} % of body weight from the truth, which has {:.2} %",
                100.0 * apart,
                100.0 * size
            );
            // A wrong sign would be an error of twice the size.
            assert!(apart < most && apart < 0.5 * size, "axis {axis}: {apart} of {size}");
        }
    }
}

#[test]
fn twice_the_mass_needs_twice_the_force() {
    let walk = walk();
    let soles = Person::of_human(&walk.human).soles;
    let model = &walk.human.model;
    let heavier = model.scaled(&vec![Vec3::repeat(1.0); model.bodies().len()], Some(2.0 * model.mass())).unwrap();
    let one = predicted(walk, Prescribed::default());
    let two =
        predict(&heavier, &walk.trajectory, &soles, &PredictSettings::default(), &mut Findings::default()).unwrap();
    for (a, b) in one.ground.bodies.iter().zip(two.ground.bodies.iter()) {
        for (a, b) in a.force.iter().zip(&b.force) {
            assert!((a * 2.0 - b).norm() < 1e-6 * (1.0 + b.norm()), "{a} {b}");
        }
    }
}

#[test]
fn a_prescribed_stance_before_the_recording_changes_nothing_and_a_reversed_one_is_rejected() {
    let walk = walk();
    let footfalls = true_footfalls(walk, &applied(walk));
    let fall = |strike_s, off_s| Footfall { strike_s: Some(strike_s), off_s: Some(off_s), ..footfalls.falls[0] };
    let with = |fall: Footfall| {
        let mut more = footfalls.clone();
        more.falls.insert(0, fall);
        Prescribed { footfalls: Some(more), ..Prescribed::default() }
    };
    let plain = predicted(walk, Prescribed { footfalls: Some(footfalls.clone()), ..Prescribed::default() });
    // As long as the others, so that the usual duration does not change.
    let mut usual: Vec<f64> = footfalls.falls.iter().filter_map(|fall| Some(fall.off_s? - fall.strike_s?)).collect();
    usual.sort_by(f64::total_cmp);
    let earlier = predicted(walk, with(fall(-60.0, -60.0 + usual[usual.len() / 2])));
    for (a, b) in plain.ground.bodies.iter().zip(earlier.ground.bodies.iter()) {
        let worst = largest_difference(&a.force, &b.force);
        assert!(worst < 0.1, "{worst} N");
    }
    let soles = Person::of_human(&walk.human).soles;
    let settings = PredictSettings { prescribed: with(fall(-59.4, -60.0)), ..PredictSettings::default() };
    let error = predict(&walk.human.model, &walk.trajectory, &soles, &settings, &mut Findings::default()).unwrap_err();
    assert!(matches!(error, PredictError::Footfalls { .. }), "{error}");
}

#[test]
fn too_little_gravity_is_rejected() {
    let walk = walk();
    let model = &walk.human.model;
    let bodies = model.bodies().to_vec();
    let afloat =
        Model::new("afloat", model.gravity() * 1e-3, bodies, model.coordinates().to_vec(), Vec::new()).unwrap();
    let soles = Person::of_human(&walk.human).soles;
    let settings = PredictSettings::default();
    let error = predict(&afloat, &walk.trajectory, &soles, &settings, &mut Findings::default()).unwrap_err();
    assert!(matches!(error, PredictError::NoGravity { .. }) && error.to_string().contains("afloat"), "{error}");
}
