//! The built-in full body in three dimensions: the planar figure of [`anthropometry`](super::anthropometry) with
//! spatial joints.
//!
//! Bodies, masses, mass centres, inertias and soles equal the planar figure with a toe joint for the same [`Build`];
//! only the joints differ. All coordinates zero is upright standing, thumbs forward. Names and signs follow Gait2392
//! and docs/CONVENTIONS.md; s is r or l, and axes on the left are mirrored so that both sides have the same signs.
//!
//! | body              | coordinates, in the order of the rotations                                     | axes (right side) |
//! |-------------------|--------------------------------------------------------------------------------|-------------------|
//! | `pelvis`          | `pelvis_tilt`, `pelvis_list`, `pelvis_rotation`, `pelvis_tx`, `_ty`, `_tz`       | z, x, y; x, y, z  |
//! | `torso` (+ head)  | `lumbar_extension`, `lumbar_bending`, `lumbar_rotation`                         | z, x, y           |
//! | `femur_s`         | `hip_flexion_s`, `hip_adduction_s`, `hip_rotation_s`                            | z, x, y           |
//! | `tibia_s`         | `knee_angle_s` (+ extension)                                                   | z                 |
//! | `calcn_s`         | `ankle_angle_s` (+ dorsiflexion), `subtalar_angle_s` (+ inversion)               | z, then oblique   |
//! | `toes_s`          | `mtp_angle_s` (+ toes up)                                                      | z                 |
//! | `humerus_s`       | `arm_flex_s`, `arm_add_s`, `arm_rot_s` (+ inwards)                               | z, x, y           |
//! | `forearm_s` (+ hand) | `elbow_flex_s`, `pro_sup_s` (+ pronation)                                    | z, y              |
//!
//! There is no talus: ankle and subtalar axes intersect in the ankle centre, and the calcaneus rotates about both. The
//! subtalar axis is the axis of Gait2392's `subtalar_r`, (0.787, 0.605, -0.121): 37° up and 9° inwards. Head and
//! hands are rigid with trunk and forearm (`neck_and_wrists` adds their joints). With tables that do not split the
//! trunk there is no lumbar joint; the root is `torso`.

use super::anthropometry::{Build, BuildError, Human};
use super::{
    Body, BodyId, Coordinate, CoordinateId, CoordinateKind, Displacement, Drive, Function, Joint, JointAxis,
    JointSpeeds, Marker, Model, Side,
};
use crate::spatial::Vec3;

/// Axis of `subtalar_r` in Gait2392 (`subject01_simbody.osim`), in the foot.
const SUBTALAR: [f64; 3] = [0.787_179_61, 0.604_747_46, -0.120_949_49];

/// Anterior tilt of the pelvis in standing [rad]: 11.7°, mean of the walking speeds slow to fast of Schwartz,
/// Rozumalski, Trost 2008 (10.97° to 13.13°). Hip angles are relative to the tilted pelvis, so a standing hip is flexed
/// by the same angle.
pub const STANDING_TILT: f64 = 11.7 * std::f64::consts::PI / 180.0;

/// Ranges [deg]. Hip abduction 45 to 50, adduction 20 to 30, rotation inwards 45, outwards 45 to 60; lumbar bending 35,
/// rotation of the trunk 30 to 45; foot inversion 35, eversion 20; shoulder adduction 50, abduction 180, rotation 90
/// both ways; pronation and supination 90: tables of normal ranges of motion such as the Merck manual's; the larger
/// value is used (unverified). Rotations of the trunk are allowed to both sides.
const RANGES: [(&str, [f64; 2]); 8] = [
    ("hip_adduction", [-50.0, 30.0]),
    ("hip_rotation", [-60.0, 45.0]),
    ("lumbar_bending", [-35.0, 35.0]),
    ("lumbar_rotation", [-45.0, 45.0]),
    ("subtalar_angle", [-20.0, 35.0]),
    ("arm_add", [-180.0, 50.0]),
    ("arm_rot", [-90.0, 90.0]),
    ("pro_sup", [-90.0, 90.0]),
];

/// Builds the full body with spatial joints for a mass and a stature. The toes always have a joint.
///
/// # Errors
/// An implausible mass, stature or combination of both.
pub fn full_body(build: &Build) -> Result<Human, BuildError> {
    let planar = Build { toe_joint: true, ..*build }.human()?;
    let mut builder = FullBodyBuilder { planar: &planar.model, bodies: Vec::new(), coordinates: Vec::new() };
    for body in planar.model.bodies() {
        builder.take(body);
    }
    let FullBodyBuilder { bodies, coordinates, .. } = builder;
    let mut markers = planar.model.markers().to_vec();
    markers.extend(Side::BOTH.map(|side| hip_side(&planar, side)));
    let model = Model::new(planar.model.name(), planar.model.gravity(), bodies, coordinates, markers)?;
    Ok(Human { model, ..planar })
}

/// A point of the pelvis lateral to the hip, named as in docs/CONVENTIONS.md.
fn hip_side(human: &Human, side: Side) -> Marker {
    let location = Vec3::new(0.0, 0.0, mirrored(side) * human.dimensions.hip_width);
    Marker { name: format!("hip_{}_side", side.letter()), body: Some(BodyId(0)), location, fixed: false }
}

/// Sign of mirrored axes: +1 on the right, -1 on the left.
fn mirrored(side: Side) -> f64 {
    match side {
        Side::Right => 1.0,
        Side::Left => -1.0,
    }
}

/// A model under construction.
struct FullBodyBuilder<'a> {
    planar: &'a Model,
    bodies: Vec<Body>,
    coordinates: Vec<Coordinate>,
}

impl FullBodyBuilder<'_> {
    /// Adds a body of the planar figure with its spatial joint.
    fn take(&mut self, body: &Body) {
        let (side, stem) = match Side::split_name(&body.name) {
            Some((side, stem)) => (Some(side), stem),
            None => (None, body.name.clone()),
        };
        let sign = side.map_or(1.0, mirrored);
        let [x, y, z] = [Vec3::x() * sign, Vec3::y() * sign, Vec3::z()];
        let subtalar = Vec3::new(SUBTALAR[0] * sign, SUBTALAR[1] * sign, SUBTALAR[2]).normalize();
        let rotations: Vec<(&str, Vec3)> = match stem.as_str() {
            _ if body.joint.parent.is_none() => vec![("pelvis_tilt", z), ("pelvis_list", x), ("pelvis_rotation", y)],
            "torso" => vec![("lumbar_extension", z), ("lumbar_bending", x), ("lumbar_rotation", y)],
            "femur" => vec![("hip_flexion", z), ("hip_adduction", x), ("hip_rotation", y)],
            "calcn" => vec![("ankle_angle", z), ("subtalar_angle", subtalar)],
            "humerus" => vec![("arm_flex", z), ("arm_add", x), ("arm_rot", y)],
            "forearm" => vec![("elbow_flex", z), ("pro_sup", y)],
            "toes" => vec![("mtp_angle", z)],
            _ => vec![("knee_angle", z)],
        };
        let rotations = rotations.into_iter().map(|(name, axis)| self.rotation(name, side, axis)).collect();
        let translations = match body.joint.parent {
            None => [("pelvis_tx", Vec3::x()), ("pelvis_ty", Vec3::y()), ("pelvis_tz", Vec3::z())]
                .map(|(name, axis)| self.translation(name, axis))
                .to_vec(),
            Some(_) => Vec::new(),
        };
        let joint = Joint { rotations, translations, speeds: JointSpeeds::Rates, ..body.joint.clone() };
        self.bodies.push(Body { name: body.name.clone(), inertia: body.inertia, joint });
    }

    fn rotation(&mut self, stem: &str, side: Option<Side>, direction: Vec3) -> JointAxis {
        let name = side.map_or(stem.to_owned(), |side| format!("{stem}_{}", side.letter()));
        let own = RANGES.iter().find(|(known, _)| *known == stem).map(|(_, range)| range.map(f64::to_radians));
        let range = own.or_else(|| self.in_plane(&name).and_then(|c| c.range));
        self.axis(
            Coordinate {
                name,
                kind: CoordinateKind::Rotation,
                default_value: 0.0,
                range,
                clamped: false,
                drive: Drive::Free,
            },
            direction,
        )
    }

    fn translation(&mut self, name: &str, direction: Vec3) -> JointAxis {
        let default_value = self.in_plane(name).map_or(0.0, |c| c.default_value);
        let (kind, drive) = (CoordinateKind::Translation, Drive::Free);
        self.axis(
            Coordinate { name: name.to_owned(), kind, default_value, range: None, clamped: false, drive },
            direction,
        )
    }

    /// The coordinate of this name in the planar figure.
    fn in_plane(&self, name: &str) -> Option<&Coordinate> {
        self.planar.coordinates().iter().find(|c| c.name == name)
    }

    fn axis(&mut self, coordinate: Coordinate, direction: Vec3) -> JointAxis {
        self.coordinates.push(coordinate);
        let id = CoordinateId(self.coordinates.len() - 1);
        let follows = Displacement::Follows(id, Function::Linear { slope: 1.0, intercept: 0.0 });
        JointAxis { direction, displacement: follows }
    }
}
