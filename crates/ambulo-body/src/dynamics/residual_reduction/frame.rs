//! One frame: the residual at the root, the poses of the feet, and the derivatives of both by the coordinates.

use super::splines::{CorrectionSplines, Instant};
use crate::dynamics::{BodyLoad, FrameForces, Roots, Workspace, inverse_frame};
use crate::model::BodyId;
use crate::spatial::{Mat3, Vec3, Wrench};

/// Steps of the finite differences: values [rad or m], rates [1/s of that]. The relative truncation error is of their
/// size; accelerations enter linearly, so any step is exact.
const STEPS: [f64; 3] = [1e-6, 1e-4, 1.0];

/// Pose of a body: its mass centre and the axes of its frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FootPose {
    pub(super) center: Vec3,
    pub(super) rotation: Mat3,
}

/// Derivatives of what [`FrameEvaluator::evaluate`] gives by the free coordinates.
#[derive(Debug, Clone, Default)]
pub(super) struct FrameSlopes {
    /// Derivatives of the residual force and moment by value, rate and acceleration, one entry per coordinate.
    pub(super) root: [Vec<[f64; 6]>; 3],
    /// Derivatives of each foot's displacement and rotation vector by value, one entry per coordinate.
    pub(super) feet: Vec<Vec<[f64; 6]>>,
}

/// Computes the state of frames: which joints are roots, which bodies carry loads.
#[derive(Debug, Clone)]
pub(super) struct FrameEvaluator {
    pub(super) roots: Roots,
    pub(super) feet: Vec<BodyId>,
}

impl FrameEvaluator {
    /// Residual wrench at the root of a frame under its loads, and the pose of each body that carries a load.
    pub(super) fn evaluate(
        &self,
        workspace: &mut Workspace,
        instant: &Instant,
        loads: &[BodyLoad],
    ) -> (Wrench, Vec<FootPose>) {
        let forces: FrameForces<'_> = inverse_frame(workspace, instant.posture(), loads);
        let place = |body: &BodyId| {
            let motion = forces.body_motion(*body);
            FootPose { center: motion.center, rotation: motion.pose.rotation }
        };
        (self.roots.residual(|body| forces.reaction(body)), self.feet.iter().map(place).collect())
    }

    /// Derivatives by forward differences. Only the first `derivatives` of value, rate and acceleration
    /// are varied: one outside the window, where the residual does not count.
    pub(super) fn slopes(
        &self,
        workspace: &mut Workspace,
        splines: &CorrectionSplines,
        instant: &mut Instant,
        loads: &[BodyLoad],
        derivatives: usize,
        slopes: &mut FrameSlopes,
    ) {
        let (still_root, still_feet) = self.evaluate(workspace, instant, loads);
        slopes.feet.iter_mut().for_each(Vec::clear);
        slopes.feet.resize(self.feet.len(), Vec::new());
        for derivative in 0..derivatives {
            slopes.root[derivative].clear();
            for &c in &splines.coordinates {
                let old = nudge(instant, derivative, c, STEPS[derivative]);
                splines.follow(instant);
                let (moved_root, moved_feet) = self.evaluate(workspace, instant, loads);
                slopes.root[derivative].push(root_slope(&still_root, &moved_root, STEPS[derivative]));
                if derivative == 0 {
                    for (foot, (a, b)) in slopes.feet.iter_mut().zip(still_feet.iter().zip(&moved_feet)) {
                        foot.push(b.displacement_from(a).map(|x| x / STEPS[0]));
                    }
                }
                *entry(instant, derivative, c) = old;
            }
        }
        splines.follow(instant);
    }
}

/// Increases a number; returns its old value.
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

/// Derivative of force and moment by a quantity that was increased by `step`.
pub(super) fn root_slope(still: &Wrench, moved: &Wrench, step: f64) -> [f64; 6] {
    let (a, b) = (six(still), six(moved));
    std::array::from_fn(|k| (b[k] - a[k]) / step)
}

/// Force, then moment.
pub(super) fn six(wrench: &Wrench) -> [f64; 6] {
    let (f, m) = (wrench.force, wrench.moment);
    [f.x, f.y, f.z, m.x, m.y, m.z]
}

impl FootPose {
    /// Displacement of the mass centre and small rotation from another pose.
    pub(super) fn displacement_from(&self, other: &FootPose) -> [f64; 6] {
        let d = self.center - other.center;
        let turn = self.rotation * other.rotation.transpose();
        // The antisymmetric part is sin(angle) times the axis.
        let half = |i: usize, j: usize| 0.5 * (turn[(i, j)] - turn[(j, i)]);
        [d.x, d.y, d.z, half(2, 1), half(0, 2), half(1, 0)]
    }
}
