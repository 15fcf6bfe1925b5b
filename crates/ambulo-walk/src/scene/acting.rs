//! Drive, spring, motor, limits and friction of a coordinate of a joint.

use super::coordinate::CoordinateEntry;
use super::joint_axes::MotionKind;
use super::sources::InputFiles;
use super::{Place, SceneError};
use crate::engine::world::{JointCoordinate, JointDrive, Motor};

/// Drive, spring, motor, limits and friction of a coordinate.
pub(super) fn acting(
    entry: &CoordinateEntry,
    place: &Place,
    sources: &mut InputFiles<'_, '_>,
) -> Result<JointCoordinate, SceneError> {
    let turns = entry.kind == MotionKind::Rotation;
    let drive = entry.drive.as_ref().map(|drive| -> Result<JointDrive, SceneError> {
        let signal = sources.signal(place, &drive.function, turns)?;
        Ok(JointDrive { signal, max: drive.max.is_finite().then_some(drive.max) })
    });
    let drive = drive.transpose()?;
    let motor = entry.motor.as_ref().map(|motor| -> Result<Motor, SceneError> {
        let target = sources.signal(place, &motor.target, turns)?;
        Ok(Motor { target, kp: motor.stiffness, kd: motor.damping, max: motor.max })
    });
    let limit = |value: f64| value.is_finite().then_some(value);
    Ok(JointCoordinate {
        drive,
        spring: entry.spring,
        motor: motor.transpose()?,
        limits: entry.limits.map_or((None, None), |limits| (limit(limits.lower), limit(limits.upper))),
        friction: entry.friction,
        rotor: 0.0,
        effort: 0.0,
    })
}
