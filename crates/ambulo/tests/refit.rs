//! Loaded feet that slide are held still.
//!
//! | claim                                                       | tolerance and its reason                                          |
//! |-------------------------------------------------------------|-------------------------------------------------------------------|
//! | feet that slide for slow errors of the hips slide less      | half the speed; a third was found                                  |
//! | feet that hardly slide are changed less                     | half of that change                                                |
//! | a treadmill's belt carries the feet along                   | 2 mrad: the belt's velocity is estimated; 0.2 mrad was found       |
//! | the change makes no forces                                  | 1.4 rad/s² and 0.4 m/s² rms: the errors times ω² of the law        |

use crate::walks;
use ambulo::analysis::feasibility::Person;
use ambulo::findings::Findings;
use ambulo::ground::footfalls::{Footfalls, footfalls};
use ambulo::internals::{Refit, hold_loaded_feet};
use ambulo::kinematics::Trajectory;
use ambulo::model::anatomy::Sole;
use ambulo::model::{BySide, Model};
use ambulo::motion::filter::LowPass;
use ambulo::motion::{Motion, SmoothSettings, Smoother, Window, smooth};
use std::f64::consts::TAU;

struct Walk {
    model: Model,
    soles: BySide<Option<Sole>>,
    motion: Motion,
}

fn walk() -> Walk {
    let made = walks::corrected(walks::WITHOUT_TOES, 2);
    let columns = made.human.model.coordinate_ids().map(|id| Some(made.trajectory.values(id).to_vec())).collect();
    let motion = Motion { origin: "walk".to_owned(), times: made.trajectory.grid().times(), columns };
    let soles = Person::of_human(&made.human).soles;
    Walk { model: made.human.model.clone(), soles, motion }
}

impl Walk {
    /// With something added to the columns of some coordinates.
    fn with(&self, names: &[&str], added: impl Fn(f64) -> f64) -> Motion {
        let mut motion = self.motion.clone();
        for name in names {
            let id = self.model.coordinate(name).unwrap();
            let column = motion.columns[id.index()].iter_mut().flatten();
            column.zip(&self.motion.times).for_each(|(value, time)| *value += added(*time));
        }
        motion
    }

    fn smoothed(&self, motion: &Motion) -> (Trajectory, Footfalls) {
        let findings = &mut Findings::default();
        let smoother = Smoother::Butterworth(LowPass::MOTION);
        let settings = SmoothSettings { smoother, window: Window::default(), rate_hz: None };
        let smoothed = smooth(&self.model, motion, settings, findings).unwrap();
        let trajectory = Trajectory::complete(&self.model, smoothed, findings).unwrap();
        let falls = footfalls(&self.model, &trajectory, &self.soles, findings);
        (trajectory, falls)
    }

    fn refitted(&self, motion: &Motion) -> Option<Refit> {
        let (trajectory, falls) = self.smoothed(motion);
        hold_loaded_feet(&self.model, motion, &trajectory, &falls, &self.soles)
    }

    /// Root mean square of the difference of a coordinate of two motions.
    fn apart(&self, name: &str, a: &Motion, b: &Motion) -> f64 {
        let id = self.model.coordinate(name).unwrap().index();
        let [a, b] = [a, b].map(|motion| motion.columns[id].as_ref().unwrap());
        let mean = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / a.len() as f64;
        mean.sqrt()
    }
}

const HIPS: [&str; 2] = ["hip_flexion_r", "hip_flexion_l"];

#[test]
fn feet_that_slide_for_slow_errors_of_the_hips_slide_less() {
    let walk = walk();
    let wrong = walk.with(&HIPS, |time| 0.04 * (TAU * 0.7 * time + 0.5).sin());
    let refit = walk.refitted(&wrong).unwrap();
    let own = walk.refitted(&walk.motion).unwrap();
    let [before, after] = refit.sliding_m_s;
    let [own_before, own_after] = own.sliding_m_s;
    println!("sliding {before:.3} to {after:.3} m/s; the walk itself {own_before:.3} to {own_after:.3}");
    assert!(after < before / 2.0, "{before}, {after}");
    assert!(own_after <= own_before, "{own_before}, {own_after}");
    // The walk itself, whose feet hardly slide, is changed less.
    assert!(own.largest_turn_rad < 0.5 * refit.largest_turn_rad, "{own:?}");
}

#[test]
fn a_belt_carries_the_feet_along() {
    let walk = walk();
    let wrong = walk.with(&HIPS, |time| 0.04 * (TAU * 0.7 * time + 0.5).sin());
    let Walk { model, soles, .. } = &walk;
    let wrong_walk = Walk { model: model.clone(), soles: *soles, motion: wrong.clone() };
    let on_belt = wrong_walk.with(&["pelvis_tx"], |time| -1.2 * time);
    let (overground, on_belt) = (walk.refitted(&wrong).unwrap(), walk.refitted(&on_belt).unwrap());
    for hip in HIPS {
        let apart = walk.apart(hip, &overground.motion, &on_belt.motion);
        println!("{hip}: {apart:.5} rad apart");
        assert!(apart < 2e-3, "{hip}: {apart}");
    }
}

#[test]
fn changes_are_slow() {
    let walk = walk();
    let wrong = walk.with(&HIPS, |time| 0.04 * (TAU * 0.7 * time).sin());
    let refit = walk.refitted(&wrong).unwrap();
    for (name, most) in [("hip_flexion_r", 1.4), ("knee_angle_r", 1.4), ("pelvis_tx", 0.4)] {
        let id = walk.model.coordinate(name).unwrap().index();
        let [new, old] = [&refit.motion, &wrong].map(|motion| motion.columns[id].as_ref().unwrap());
        let change: Vec<f64> = new.iter().zip(old).map(|(a, b)| a - b).collect();
        let second = change.windows(3).map(|w| (w[0] - 2.0 * w[1] + w[2]) / 1e-4);
        let rms = (second.map(|x| x * x).sum::<f64>() / change.len() as f64).sqrt();
        println!("{name}: second derivative of the change {rms:.3} rms");
        assert!(rms > 0.0 && rms < most, "{name}: {rms}");
    }
}

#[test]
fn a_body_in_the_air_and_a_motion_without_leg_angles_are_left_alone() {
    let walk = walk();
    let in_the_air = walk.with(&["pelvis_ty"], |time| 4.0 * time - 4.9 * time * time);
    assert!(walk.refitted(&in_the_air).is_none_or(|refit| refit.motion == in_the_air), "nothing to stand on");
    let (trajectory, falls) = walk.smoothed(&walk.motion);
    let nothing_recorded = Motion { columns: vec![None; walk.motion.columns.len()], ..walk.motion.clone() };
    assert!(hold_loaded_feet(&walk.model, &nothing_recorded, &trajectory, &falls, &walk.soles).is_none());
}
