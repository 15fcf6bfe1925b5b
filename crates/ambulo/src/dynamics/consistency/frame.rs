//! One frame: what it lacks at the root, where its feet are, and how both follow the coordinates.

use super::curves::{Curves, Instant};
use crate::dynamics::{BodyLoad, FrameForces, Roots, Workspace, inverse_frame};
use crate::model::BodyId;
use crate::spatial::{Mat3, Vec3, Wrench};

/// Steps of the differences: values [rad or m], rates [1/s of that]. Truncation is of their size relative to the slopes; accelerations
/// enter linearly, so any step is exact.
const STEPS: [f64; 3] = [1e-6, 1e-4, 1.0];

/// What a frame shows.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sight {
    /// At the root: what nothing supplies.
    pub(super) root: Wrench,
    /// Place and direction of each body that carries a load.
    pub(super) feet: Vec<Place>,
}

/// Where a body is: its mass centre, and the axes of its frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub(super) center: Vec3,
    pub(super) rotation: Mat3,
}

/// How what a frame shows follows the coordinates that may change.
#[derive(Debug, Clone, Default)]
pub(super) struct Slopes {
    /// Of the root's force and moment: by value, rate and acceleration, one entry a coordinate.
    pub(super) root: [Vec<[f64; 6]>; 3],
    /// Of each foot's displacement and rotation vector by value, one entry a coordinate.
    pub(super) feet: Vec<Vec<[f64; 6]>>,
}

/// Which bodies are looked at.
#[derive(Debug, Clone)]
pub(super) struct Eyes {
    pub(super) roots: Roots,
    pub(super) feet: Vec<BodyId>,
}

impl Eyes {
    /// What a frame shows under its loads.
    pub(super) fn see(&self, workspace: &mut Workspace, instant: &Instant, loads: &[BodyLoad]) -> Sight {
        let forces: FrameForces<'_> = inverse_frame(workspace, instant.posture(), loads);
        let place = |body: &BodyId| {
            let motion = forces.body_motion(*body);
            Place { center: motion.center, rotation: motion.pose.rotation }
        };
        Sight { root: self.roots.residual(|body| forces.reaction(body)), feet: self.feet.iter().map(place).collect() }
    }

    /// By differences: what a frame shows when one number is a little larger. Without laws to obey, rates and accelerations
    /// are of no interest.
    pub(super) fn slopes(
        &self,
        workspace: &mut Workspace,
        curves: &Curves,
        instant: &mut Instant,
        loads: &[BodyLoad],
        with_laws: bool,
        slopes: &mut Slopes,
    ) {
        let still = self.see(workspace, instant, loads);
        slopes.feet.iter_mut().for_each(Vec::clear);
        slopes.feet.resize(self.feet.len(), Vec::new());
        for derivative in 0..if with_laws { 3 } else { 1 } {
            slopes.root[derivative].clear();
            for &c in &curves.coordinates {
                let old = nudge(instant, derivative, c, STEPS[derivative]);
                curves.follow(instant);
                let moved = self.see(workspace, instant, loads);
                slopes.root[derivative].push(root_slope(&still.root, &moved.root, STEPS[derivative]));
                if derivative == 0 {
                    for (foot, (a, b)) in slopes.feet.iter_mut().zip(still.feet.iter().zip(&moved.feet)) {
                        foot.push(b.away_from(a).map(|x| x / STEPS[0]));
                    }
                }
                *entry(instant, derivative, c) = old;
            }
        }
        curves.follow(instant);
    }
}

/// Makes a number larger; what it was.
fn nudge(instant: &mut Instant, derivative: usize, c: usize, step: f64) -> f64 {
    let entry = entry(instant, derivative, c);
    std::mem::replace(entry, *entry + step)
}

fn entry(instant: &mut Instant, derivative: usize, c: usize) -> &mut f64 {
    match derivative {
        0 => &mut instant.q[c],
        1 => &mut instant.qd[c],
        _ => &mut instant.qdd[c],
    }
}

/// How force and moment change by one unit of what was changed by `step`.
pub(super) fn root_slope(still: &Wrench, moved: &Wrench, step: f64) -> [f64; 6] {
    let (a, b) = (six(still), six(moved));
    std::array::from_fn(|k| (b[k] - a[k]) / step)
}

/// Force, then moment.
pub(super) fn six(wrench: &Wrench) -> [f64; 6] {
    let (f, m) = (wrench.force, wrench.moment);
    [f.x, f.y, f.z, m.x, m.y, m.z]
}

impl Place {
    /// Displacement of the mass centre and small rotation from another place.
    pub(super) fn away_from(&self, other: &Place) -> [f64; 6] {
        let d = self.center - other.center;
        let turn = self.rotation * other.rotation.transpose();
        // The antisymmetric part is sin(angle) times the axis.
        let half = |i: usize, j: usize| 0.5 * (turn[(i, j)] - turn[(j, i)]);
        [d.x, d.y, d.z, half(2, 1), half(0, 2), half(1, 0)]
    }
}
