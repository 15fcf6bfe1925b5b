//! Forces without plates, against those that a simulator applied to the same motion.
//!
//! | claim                                                     | tolerance and its reason                                    |
//! |-----------------------------------------------------------|-------------------------------------------------------------|
//! | the total force is the sum of the feet's                  | 2 N: what the simulated walk's root lacks (synthetic_walk.rs) |
//! | the feet's forces add to the total while somebody stands  | rounding                                                    |
//! | with everything known the forces are the simulator's      | 25 N: the total's 2 N, and 20 N below which no foot is loaded |

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]
#![allow(clippy::print_stdout, reason = "the figures are shown with --nocapture")]

use ambulo::analysis::feasibility::Person;
use ambulo::findings::Findings;
use ambulo::gait::Gait;
use ambulo::ground::footfalls::{Footfall, Footfalls};
use ambulo::ground::phases::contacts;
use ambulo::ground::predict::{Known, PredictError, PredictSettings, Prediction, predict, total_wrench};
use ambulo::ground::{GroundForces, feet, measured};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::{Model, Side};
use ambulo::simulation::synthetic::{Mode, SyntheticWalk, WalkOrder, synthesise};
use ambulo::spatial::Vec3;

fn walk() -> SyntheticWalk {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: false };
    let gait = Gait::named("free").unwrap();
    let order = WalkOrder { gait: &gait, build, mode: Mode::Corrected, cycles: 2, rate_hz: 100.0 };
    synthesise(&order, &mut Findings::default()).unwrap()
}

/// What the simulator applied, one entry a foot.
fn applied(walk: &SyntheticWalk) -> GroundForces {
    let mut findings = Findings::default();
    let ground = measured(&walk.human.model, &walk.trajectory, &walk.loads, None, &mut findings).unwrap();
    let bodies = feet(&walk.human.model, &ground).into_iter().map(|(_, forces)| forces).collect();
    GroundForces { bodies }
}

fn predicted(walk: &SyntheticWalk, known: Known) -> Prediction {
    let soles = Person::of_human(&walk.human).soles;
    let settings = PredictSettings { known, ..PredictSettings::default() };
    predict(&walk.human.model, &walk.trajectory, &soles, &settings, &mut Findings::default()).unwrap()
}

/// Stances by the simulator's own forces.
fn true_footfalls(walk: &SyntheticWalk, applied: &GroundForces) -> Footfalls {
    let times = walk.trajectory.grid().times();
    let mut falls = Vec::new();
    for (side, foot) in Side::BOTH.into_iter().zip(&applied.bodies) {
        let vertical: Vec<f64> = foot.force.iter().map(|f| f.y).collect();
        falls.extend(contacts(&times, &vertical).into_iter().map(|contact| Footfall {
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
    let [right, left] = &applied(&walk).bodies[..] else { panic!("two feet") };
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
    let prediction = predicted(&walk, Known::default());
    let [right, left] = &prediction.ground.bodies[..] else { panic!("two feet") };
    let weight = walk.human.model.mass() * walk.human.model.gravity().norm();
    let missing: Vec<Vec3> =
        (0..right.force.len()).map(|i| right.force[i] + left.force[i] - prediction.total[i].force).collect();
    // Behind a low-pass: what is sharper than markers show comes from what is expected of a foot.
    let window = 25;
    let means = missing.windows(window).map(|w| w.iter().sum::<Vec3>() / window as f64);
    let worst = means.map(|mean| mean.norm() / weight).fold(0.0, f64::max);
    println!("over a quarter of a second the feet miss {:.2} % of the weight at most", 100.0 * worst);
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
    assert!(swings > 2 * right.force.len() / 5, "a foot swings for about 40 % of a walk: {swings}");
}

#[test]
fn with_everything_known_the_forces_are_those_that_were_applied() {
    let walk = walk();
    let applied = applied(&walk);
    let [right, left] = &applied.bodies[..] else { panic!("two feet") };
    let share = right.force.iter().zip(&left.force).map(|(r, l)| r.y / (r.y + l.y)).collect();
    let known = Known {
        footfalls: Some(true_footfalls(&walk, &applied)),
        total: Some(total_wrench(&walk.human.model, &walk.trajectory)),
        right_share: Some(share),
        centers: Some([right.center_of_pressure.clone(), left.center_of_pressure.clone()]),
    };
    let vertical = |known: Known| {
        let prediction = predicted(&walk, known);
        let feet = prediction.ground.bodies.iter().zip(&applied.bodies);
        feet.flat_map(|(found, truth)| found.force.iter().zip(&truth.force).map(|(a, b)| (a.y - b.y).abs()))
            .fold(0.0, f64::max)
    };
    let (informed, alone) = (vertical(known), vertical(Known::default()));
    println!("vertical forces differ by {informed:.1} N with everything known, by {alone:.1} N without");
    assert!(informed < 25.0, "{informed} N");
    assert!(alone > 2.0 * informed, "{alone} N without, {informed} N with");
}

#[test]
fn a_model_without_feet_and_known_numbers_of_another_length_are_refused() {
    let walk = walk();
    let soles = Person::of_human(&walk.human).soles;
    let model = &walk.human.model;
    let refused = |model: &Model, soles: &_, settings: &PredictSettings| {
        predict(model, &walk.trajectory, soles, settings, &mut Findings::default()).unwrap_err()
    };
    let error = refused(model, &[soles[0], None], &PredictSettings::default());
    assert_eq!(error, PredictError::NoSole { model: model.name().to_owned(), side: Side::Left });
    assert!(error.to_string().contains("calcn_l") && error.to_string().contains("hint:"), "{error}");
    let known = Known { right_share: Some(vec![0.5; 3]), ..Known::default() };
    let error = refused(model, &soles, &PredictSettings { known, ..PredictSettings::default() });
    assert!(error.to_string().contains("3 frames"), "{error}");
    let mut bodies = model.bodies().to_vec();
    for body in &mut bodies {
        body.name = body.name.replace("calcn", "hoof").replace("talus", "pastern");
    }
    let footless = Model::new("horse", model.gravity(), bodies, model.coordinates().to_vec(), Vec::new()).unwrap();
    let error = refused(&footless, &soles, &PredictSettings::default());
    assert!(error.to_string().contains("horse") && error.to_string().contains("--no-ground"), "{error}");
}
