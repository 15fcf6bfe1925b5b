//! Saves and resumes the state of a scene bit for bit.

use super::build::Scene;
use super::checks::SceneChecks;
use super::event::{EventAction, EventEntry};
use super::recorder::Recorder;
use super::run::RunError;
use crate::engine::state::RowKey;
use crate::spatial::{Mat3, Pose, Twist, Vec3};
use serde::{Deserialize, Serialize};

/// The state of a scene. Written as JSON with all digits, it resumes the same scene file bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SavedState {
    /// Version of the program that wrote it.
    pub version: String,
    /// Names of the bodies, to check that the state belongs to a scene.
    pub bodies: Vec<String>,
    /// Time step [s].
    pub step_s: f64,
    /// Steps made.
    pub steps: usize,
    /// Time [s].
    pub time_s: f64,
    /// Events that have happened.
    pub events: usize,
    /// Position [m], then the rotation matrix row by row, of each body.
    poses: Vec<[f64; 12]>,
    /// Angular velocity [rad/s], then velocity [m/s], of each body.
    twists: Vec<[f64; 6]>,
    /// Coordinates of each remaining joint [rad, m].
    coordinates: Vec<Vec<f64>>,
    /// Whether each closure is active, and its frames on its two bodies.
    closures: Vec<(bool, [f64; 12], [f64; 12])>,
    /// Impulses of the last step.
    impulses: Vec<(RowKey, [f64; 6])>,
}

impl Scene {
    /// Saves everything that changes in a run.
    #[must_use]
    pub fn save(&self) -> SavedState {
        let state = &self.state;
        SavedState {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            bodies: self.world.bodies.iter().map(|body| body.name.clone()).collect(),
            step_s: self.settings.step_s,
            steps: self.steps,
            time_s: state.time_s,
            events: self.fired,
            poses: state.poses.iter().map(twelve).collect(),
            twists: state.twists.iter().map(six).collect(),
            coordinates: state.coordinates.clone(),
            closures: self
                .world
                .closures
                .iter()
                .map(|c| (c.active, twelve(&c.first_from_joint), twelve(&c.second_from_joint)))
                .collect(),
            impulses: state.guess.iter().map(|(key, rows)| (*key, *rows)).collect(),
        }
    }

    /// Restores a saved state in a scene that was built from the same file.
    ///
    /// # Errors
    /// A state of another scene, or with another time step.
    pub fn resume(&mut self, saved: &SavedState) -> Result<(), RunError> {
        if self.recorders.iter().any(Recorder::is_live) {
            return Err(RunError::Machines);
        }
        let names: Vec<&str> = self.world.bodies.iter().map(|body| body.name.as_str()).collect();
        agree("the bodies", &saved.bodies.join(", "), &names.join(", "))?;
        agree("the step is", &saved.step_s, &self.settings.step_s)?;
        agree("the number of events that have happened is", &saved.events.min(self.events.len()), &saved.events)?;
        agree("the number of closures is", &saved.closures.len(), &self.world.closures.len())?;
        agree("the number of poses is", &saved.poses.len(), &names.len())?;
        agree("the number of twists is", &saved.twists.len(), &names.len())?;
        let gone = |event: &EventEntry| match event.change {
            EventAction::RemoveJoint(joint) => Some(joint),
            _ => None,
        };
        let gone: Vec<usize> = self.events[..saved.events].iter().filter_map(gone).collect();
        gone.into_iter().for_each(|joint| self.remove_joint(joint));
        let counts = |list: &[Vec<f64>]| format!("{:?}", list.iter().map(Vec::len).collect::<Vec<_>>());
        agree("the joints' numbers of coordinates are", &counts(&saved.coordinates), &counts(&self.state.coordinates))?;
        (self.steps, self.fired) = (saved.steps, saved.events);
        self.resumed = saved.steps;
        for (closure, (active, first, second)) in self.world.closures.iter_mut().zip(&saved.closures) {
            closure.active = *active;
            (closure.first_from_joint, closure.second_from_joint) = (pose(first), pose(second));
        }
        self.state.time_s = saved.time_s;
        self.state.poses = saved.poses.iter().map(pose).collect();
        self.state.twists = saved.twists.iter().map(twist).collect();
        self.state.coordinates.clone_from(&saved.coordinates);
        self.state.guess = saved.impulses.iter().copied().collect();
        if self.fired > 0 {
            self.checks = SceneChecks::new(&self.world, &self.state);
        }
        Ok(())
    }
}

fn agree<T: PartialEq + ToString>(what: &'static str, found: &T, expected: &T) -> Result<(), RunError> {
    if found == expected {
        return Ok(());
    }
    Err(RunError::OtherScene { what, found: found.to_string(), expected: expected.to_string() })
}

fn twelve(pose: &Pose) -> [f64; 12] {
    let (t, r) = (&pose.translation, &pose.rotation);
    let mut numbers = [0.0; 12];
    numbers[..3].copy_from_slice(t.as_slice());
    numbers[3..].copy_from_slice(r.transpose().as_slice());
    numbers
}

fn pose(numbers: &[f64; 12]) -> Pose {
    Pose { rotation: Mat3::from_row_slice(&numbers[3..]), translation: Vec3::new(numbers[0], numbers[1], numbers[2]) }
}

fn six(twist: &Twist) -> [f64; 6] {
    let (w, v) = (&twist.angular, &twist.linear);
    [w.x, w.y, w.z, v.x, v.y, v.z]
}

fn twist(numbers: &[f64; 6]) -> Twist {
    let [a, b, c, x, y, z] = *numbers;
    Twist { angular: Vec3::new(a, b, c), linear: Vec3::new(x, y, z) }
}
