//! Detects inputs that do not belong together: model, motion and forces that give finite but wrong results.

use super::feasibility::LARGE_RESIDUAL_BW;
use super::residual::Residual;
use crate::findings::{Code, Findings};
use crate::ground::{BodyForces, CENTER_OF_PRESSURE_LOAD_N, GroundForces};
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::{CoordinateKind, Model};
use crate::numerics::median;
use crate::spatial::Vec3;

/// Allowed excess over a coordinate's range before a warning [rad]; ranges of models are often narrow.
const RANGE_SLACK_RAD: f64 = 0.35;

/// Reports a residual force that is too large for reliable results.
pub(super) fn report_residual(weight_n: f64, residual: Option<Residual>, findings: &mut Findings) {
    let Some(residual) = residual.filter(|_| weight_n > 0.0) else { return };
    let share = residual.force_rms_n / weight_n;
    if share > LARGE_RESIDUAL_BW {
        let message = format!(
            "the residual force at the root is {:.0} % of body weight (about 10 % in walking data with every foot on a \
             plate): forces, motion and model do not belong together, a foot was outside the plates, or the motion is \
             not filtered; the joint moments are not reliable. hint: check files, sides and time origin; choose the \
             time in which every loaded foot is on a plate",
            100.0 * share
        );
        findings.report(Code::ResidualLarge, message);
    }
}

/// Reports ground forces with the wrong sign or under the wrong foot.
pub(super) fn report_loads(model: &Model, trajectory: &Trajectory, ground: &GroundForces, findings: &mut Findings) {
    report_downward(model, ground, model.up(), findings);
    report_far_feet(model, trajectory, ground, findings);
}

/// Reports forces that pull a foot down: forces on the plate instead of on the foot.
fn report_downward(model: &Model, ground: &GroundForces, up: Vec3, findings: &mut Findings) {
    for body in ground.bodies.iter() {
        let name = &model.bodies()[body.body.index()].name;
        if let Some(message) = pulls_down(&format!("`{name}`"), &body.force, up) {
            findings.report(Code::LoadsDownward, message);
        }
    }
}

/// The message about a ground force that pulls down what it acts on; `None` if its mean points up.
pub(crate) fn pulls_down(what: &str, force: &[Vec3], up: Vec3) -> Option<String> {
    let known = force.iter().map(|f| f.dot(&up)).filter(|vertical| vertical.is_finite());
    let mean = known.sum::<f64>() / force.len().max(1) as f64;
    (mean < -CENTER_OF_PRESSURE_LOAD_N).then(|| {
        format!(
            "the ground force pulls {what} down (mean vertical force {mean:.0} N); it is probably the force on the \
             plate. hint: reverse the sign of forces and torques"
        )
    })
}

/// Reports centres of pressure that are nearer to the other foot: right and left exchanged.
fn report_far_feet(model: &Model, trajectory: &Trajectory, ground: &GroundForces, findings: &mut Findings) {
    let side_of = |b: &BodyForces| model.anatomy().body_side(b.body);
    let feet: Vec<_> = ground.bodies.iter().filter(|b| side_of(b).is_some()).collect();
    let mut own: Vec<Vec<f64>> = vec![Vec::new(); feet.len()];
    let mut other = own.clone();
    each_body_motion(model, trajectory, |frame, bodies| {
        for (k, foot) in feet.iter().enumerate() {
            let center = foot.center_of_pressure[frame];
            let distance = |b: usize| (bodies[b].center - center).norm();
            if center.x.is_nan() {
                continue;
            }
            let opposite = feet.iter().filter(|f| side_of(f) != side_of(foot));
            if let Some(nearest) = opposite.map(|f| distance(f.body.index())).min_by(f64::total_cmp) {
                own[k].push(distance(foot.body.index()));
                other[k].push(nearest);
            }
        }
    });
    for ((foot, own), other) in feet.iter().zip(own).zip(other) {
        if let (Some(own), Some(other)) = (median(own), median(other))
            && other < own
        {
            let name = &model.bodies()[foot.body.index()].name;
            let message = format!(
                "the force on `{name}` acts {own:.2} m from it and {other:.2} m from the other foot (medians); right \
                 and left may be exchanged. hint: exchange the bodies on which the loads act"
            );
            findings.report(Code::LoadsFarFromFoot, message);
        }
    }
}

/// Reports rotations far outside the range of the model: the motion of another model.
pub(super) fn report_ranges(model: &Model, trajectory: &Trajectory, findings: &mut Findings) {
    for id in model.coordinate_ids() {
        let coordinate = &model.coordinates()[id.index()];
        let (Some([low, high]), CoordinateKind::Rotation) = (coordinate.range, coordinate.kind) else { continue };
        let values = trajectory.values(id);
        let smallest = values.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if largest > high + RANGE_SLACK_RAD || smallest < low - RANGE_SLACK_RAD {
            let [smallest, largest, low, high] = [smallest, largest, low, high].map(f64::to_degrees);
            let message = format!(
                "`{}` ranges from {smallest:.0} to {largest:.0} deg; the model allows {low:.0} to {high:.0} deg. hint: \
                 is this the motion of another model? Knee flexion is positive in some models and negative in others",
                coordinate.name
            );
            findings.report(Code::MotionOutOfRange, message);
        }
    }
}
