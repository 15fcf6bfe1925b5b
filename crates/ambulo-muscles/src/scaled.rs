//! Scales muscles with the bodies of their model, as OpenSim does.
//!
//! With S = diag(factors of the body):
//! - points of paths and origins of surfaces on the body: position S p; functions of moving points: each component by
//!   its factor;
//! - radius of a cylinder with the axes x, y, z: by (|S x| + |S y|)/2, its length by |S z|; radius of a sphere: by the
//!   mean of the factors;
//! - optimal fibre length and slack length of the tendon: by the ratio of the lengths of the path in the default
//!   posture, after and before.
//!
//! Strength is kept, as in OpenSim.
//!
//! Source: OpenSim 4, WrapCylinder.cpp and WrapSphere.cpp (`extendScale`), MovingPathPoint.cpp (`scale`),
//! GeometryPath.cpp (`extendPreScale`), the muscles' `extendPostScale`, read. Difference: lengths of paths over
//! surfaces are exact.
//! Pinned by: tests/scaling.rs

use crate::import::{MuscleError, default_coordinates};
use crate::path::PathWorkspace;
use crate::set::{MuscleSet, PathPoint, PointPlace, WrapObject, WrapShape};
use crate::wrap::WrapRule;
use ambulo_body::kinematics::Posture;
use ambulo_body::model::{BodyId, Function, Model};
use ambulo_body::spatial::{Pose, Vec3};

impl MuscleSet {
    /// The muscles of `model` for `scaled`, the same model scaled by these factors of each body along its axes, in the
    /// order of the model.
    ///
    /// # Errors
    /// A number of factors that differs from the number of bodies.
    pub fn scaled(&self, model: &Model, scaled: &Model, factors: &[Vec3]) -> Result<MuscleSet, MuscleError> {
        let (found, expected) = (factors.len(), model.bodies().len());
        if found != expected || scaled.bodies().len() != expected {
            return Err(MuscleError::Factors { found, expected });
        }
        let of = |body: Option<BodyId>| body.map_or(Vec3::repeat(1.0), |id| factors[id.index()]);
        let mut set = self.clone();
        for wrap in &mut set.wraps {
            scale_surface(wrap, &of(wrap.body));
        }
        for point in set.muscles.iter_mut().flat_map(|muscle| &mut muscle.path.points) {
            scale_point(point, &of(point.body));
        }
        let (before, after) = (default_lengths(model, self), default_lengths(scaled, &set));
        for ((muscle, before), after) in set.muscles.iter_mut().zip(before).zip(after) {
            let ratio = if before > 0.0 { after / before } else { 1.0 };
            muscle.parameters.optimal_fiber_length *= ratio;
            muscle.parameters.tendon_slack_length *= ratio;
        }
        Ok(set)
    }
}

/// Lengths of all paths in the default posture [m].
fn default_lengths(model: &Model, set: &MuscleSet) -> Vec<f64> {
    let mut paths = PathWorkspace::new(model, set, WrapRule::Exact);
    let q = default_coordinates(model);
    let rest = vec![0.0; q.len()];
    paths.update(Posture { q: &q, qd: &rest, qdd: &rest });
    paths.lengths().to_vec()
}

fn scaled_pose(pose: &Pose, factors: &Vec3) -> Pose {
    Pose { translation: factors.component_mul(&pose.translation), ..*pose }
}

fn scale_point(point: &mut PathPoint, factors: &Vec3) {
    match &mut point.place {
        PointPlace::Fixed(place) | PointPlace::Conditional { place, .. } => *place = factors.component_mul(place),
        PointPlace::Moving { frame, axes } => {
            *frame = scaled_pose(frame, factors);
            for ((_, function), factor) in axes.iter_mut().zip(factors) {
                *function = match &*function {
                    Function::Scaled(scale, inner) => Function::Scaled(scale * factor, inner.clone()),
                    other => Function::Scaled(*factor, Box::new(other.clone())),
                };
            }
        }
    }
}

fn scale_surface(wrap: &mut WrapObject, factors: &Vec3) {
    let along = |axis: usize| factors.component_mul(&wrap.pose.rotation.column(axis)).norm();
    wrap.shape = match wrap.shape {
        WrapShape::Cylinder { radius, length } => {
            WrapShape::Cylinder { radius: radius * 0.5 * (along(0) + along(1)), length: length * along(2) }
        }
        WrapShape::Sphere { radius } => WrapShape::Sphere { radius: radius * factors.sum() / 3.0 },
    };
    wrap.pose = scaled_pose(&wrap.pose, factors);
}
