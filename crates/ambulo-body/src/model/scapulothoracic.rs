//! The joint between shoulder blade and thorax, as two joints around a body without mass.
//!
//! OpenSim's ScapulothoracicJoint is a chain: an ellipsoid joint from the thorax to a massless body, whose frames are
//! both turned by 90 degrees about z so that abduction and elevation are positive, and a pin from there to the shoulder
//! blade, about the winging axis (-sin w, cos w, 0) through (x, y, 0) of the joint frame.
//!
//! Source: OpenSim, ScapulothoracicJoint.cpp (`extendAddToSystem`), read.
//! Pinned by: tests/opensim_joints.rs, against OpenSim 4.6

use super::osim_frame::{frame, pose};
use crate::numerics::elementary::{cos, sin};
use crate::spatial::{Mat3, Pose, Vec3, rotation_about};
use ambulo_formats::osim::{OsimBody, OsimFrame, OsimJoint, OsimJointKind, OsimModel};
use std::borrow::Cow;
use std::f64::consts::FRAC_PI_2;

/// End of the name of the massless body of a joint.
const ON_ELLIPSOID: &str = "_on_ellipsoid";

/// The document without such joints, and the names of the massless bodies that were added.
pub(super) fn divided(document: &OsimModel) -> (Cow<'_, OsimModel>, Vec<String>) {
    let is_one = |joint: &OsimJoint| matches!(joint.kind, OsimJointKind::Scapulothoracic { .. });
    if !document.joints.iter().any(is_one) {
        return (Cow::Borrowed(document), Vec::new());
    }
    let mut divided = OsimModel { joints: Vec::new(), ..document.clone() };
    let mut added = Vec::new();
    for joint in &document.joints {
        let OsimJointKind::Scapulothoracic { radii_m: [x, y, z], winging_origin_m, winging_direction_rad } = joint.kind
        else {
            divided.joints.push(joint.clone());
            continue;
        };
        let name = format!("{}{ON_ELLIPSOID}", joint.name);
        let quarter = Pose { rotation: about_z(FRAC_PI_2), translation: Vec3::zeros() };
        let winging = winging(winging_origin_m, winging_direction_rad);
        let (sliding, turning) = joint.coordinates.split_at(joint.coordinates.len().min(3));
        divided.joints.push(OsimJoint {
            name: format!("{}_ellipsoid", joint.name),
            // Along x and y of the turned frame are y and x of the frame on the thorax.
            kind: OsimJointKind::Ellipsoid { radii_m: [y, x, z] },
            parent: moved(&joint.parent, quarter),
            child: frame(name.clone(), &quarter),
            coordinates: sliding.to_vec(),
            ..joint.clone()
        });
        divided.joints.push(OsimJoint {
            kind: OsimJointKind::Pin,
            parent: frame(name.clone(), &winging),
            child: moved(&joint.child, winging),
            coordinates: turning.to_vec(),
            ..joint.clone()
        });
        divided.bodies.push(massless(&name, joint.line));
        added.push(name);
    }
    (Cow::Owned(divided), added)
}

/// The frame of the winging pin in the joint frame: z along the winging axis.
fn winging([x, y]: [f64; 2], direction_rad: f64) -> Pose {
    let axis = Vec3::new(-sin(direction_rad), cos(direction_rad), 0.0);
    let across = axis.cross(&Vec3::z());
    Pose { rotation: Mat3::from_columns(&[Vec3::z(), across, axis]), translation: Vec3::new(x, y, 0.0) }
}

fn about_z(angle: f64) -> Mat3 {
    rotation_about(Vec3::z(), angle)
}

fn moved(stated: &OsimFrame, by: Pose) -> OsimFrame {
    frame(stated.body.clone(), &(pose(stated) * by))
}

fn massless(name: &str, line: usize) -> OsimBody {
    OsimBody { name: name.to_owned(), line, mass_kg: 0.0, mass_center_m: [0.0; 3], inertia: [0.0; 6] }
}
