//! Neck and wrists of the built-in body, where markers show how head and hands move.
//!
//! The full body has the head on its trunk and the hands on its forearms. A joint here sets a part apart: trunk and
//! head together, forearm and hand together have the mass, mass centre and inertia of before. All coordinates zero is
//! the posture of the full body: head upright, hands straight, thumbs forward.
//!
//! | body     | coordinates, in the order of the rotations                       | axes (right side) |
//! |----------|------------------------------------------------------------------|-------------------|
//! | `head`   | `neck_extension`, `neck_bending`, `neck_rotation`, signed like the lumbar joint | z, x, y |
//! | `hand_s` | `wrist_flex_s` (+ towards the palm), `wrist_dev_s` (+ towards the little finger) | x, -z   |
//!
//! The wrist has the names of Rajagopal's model. The neck turns about the seventh cervical vertebra;
//! that the skull also turns on the uppermost one moves its markers by millimetres in walking.

use super::anthropometry::{BuildError, Human};
use super::{
    Body, BodyId, BySide, Coordinate, CoordinateId, CoordinateKind, Displacement, Drive, Function, Joint, JointAxis,
    JointSpeeds, Model, Side,
};
use crate::spatial::{Inertia, Pose, Vec3};

/// Name of the body of the head.
pub const HEAD: &str = "head";

/// Ranges [deg]: neck flexion 60, extension 75, bending 45, rotation 80; wrist flexion 80, extension 70, towards the
/// little finger 35, the thumb 25. Tables of normal ranges of motion (American Medical Association and Academy of
/// Orthopaedic Surgeons; the larger value is used, unverified).
const NECK: [(&str, [f64; 2]); 3] =
    [("neck_extension", [-60.0, 75.0]), ("neck_bending", [-45.0, 45.0]), ("neck_rotation", [-80.0, 80.0])];
const WRIST: [(&str, [f64; 2]); 2] = [("wrist_flex", [-70.0, 80.0]), ("wrist_dev", [-25.0, 35.0])];

/// The parts that move on the body that carries them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FreeParts {
    /// The head.
    pub head: bool,
    /// The hands.
    pub hands: BySide<bool>,
}

/// Name of the body of a hand.
#[must_use]
pub fn hand(side: Side) -> String {
    format!("hand_{}", side.letter())
}

/// The body with joints at neck and wrists. Bodies and coordinates are added at the end.
///
/// # Errors
/// None for the full body; the errors of its parts.
pub fn with_neck_and_wrists(human: Human, free: FreeParts) -> Result<Human, BuildError> {
    let model = &human.model;
    let parts = human.build.extremities()?;
    let mut grown = Grown { bodies: model.bodies().to_vec(), coordinates: model.coordinates().to_vec() };
    if let (true, Some(torso)) = (free.head, model.body("torso")) {
        let axes = [Vec3::z(), Vec3::x(), Vec3::y()];
        grown.set_apart(torso, (HEAD, parts.head), parts.neck, NECK.into_iter().zip(axes), None)?;
    }
    for side in Side::BOTH.into_iter().filter(|side| free.hands[*side]) {
        let Some(forearm) = model.body(&format!("forearm_{}", side.letter())) else { continue };
        let outward = if side == Side::Right { Vec3::x() } else { -Vec3::x() };
        let wrist = Vec3::y() * -human.dimensions.forearm;
        let axes = WRIST.into_iter().zip([outward, -Vec3::z()]);
        grown.set_apart(forearm, (&hand(side), parts.hand), wrist, axes, Some(side))?;
    }
    let markers = model.markers().to_vec();
    let model = Model::new(model.name(), model.gravity(), grown.bodies, grown.coordinates, markers)?;
    Ok(Human { model, ..human })
}

/// A model with further bodies.
struct Grown {
    bodies: Vec<Body>,
    coordinates: Vec<Coordinate>,
}

impl Grown {
    /// Makes a part of a body a body of its own, with a joint at `place` of the first [m].
    fn set_apart(
        &mut self,
        parent: BodyId,
        (name, inertia): (&str, Inertia),
        place: Vec3,
        axes: impl Iterator<Item = ((&'static str, [f64; 2]), Vec3)>,
        side: Option<Side>,
    ) -> Result<(), BuildError> {
        let carrier = &mut self.bodies[parent.index()].inertia;
        *carrier = carrier.without(&inertia.seen_from(&Pose::at(place)))?;
        let rotations = axes.map(|((stem, range), direction)| self.rotation(stem, side, range, direction)).collect();
        let joint = Joint {
            name: name.to_owned(),
            parent: Some(parent),
            parent_from_joint: Pose::at(place),
            child_from_joint: Pose::IDENTITY,
            rotations,
            translations: Vec::new(),
            speeds: JointSpeeds::Rates,
        };
        self.bodies.push(Body { name: name.to_owned(), inertia, joint });
        Ok(())
    }

    fn rotation(&mut self, stem: &str, side: Option<Side>, range: [f64; 2], direction: Vec3) -> JointAxis {
        self.coordinates.push(Coordinate {
            name: side.map_or(stem.to_owned(), |side| format!("{stem}_{}", side.letter())),
            kind: CoordinateKind::Rotation,
            default_value: 0.0,
            range: Some(range.map(f64::to_radians)),
            clamped: false,
            drive: Drive::Free,
        });
        let id = CoordinateId(self.coordinates.len() - 1);
        let displacement = Displacement::Follows(id, Function::Linear { slope: 1.0, intercept: 0.0 });
        JointAxis { direction, displacement }
    }
}
