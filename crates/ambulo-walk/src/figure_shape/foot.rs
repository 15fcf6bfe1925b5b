//! Soles and shapes of the feet.
//!
//! A foot is a triangle of capsules between heel, ankle and ball, as thick as the spheres of heel and ball in published
//! foot models, with the toes in front. Soles of built-in figures are placed by their markers `heel_s`, `ball_s`,
//! `toe_s`; soles of other models by the proportions of a person of this stature ([`Sole`]), moved up or down so that
//! they touch the floor while ground forces load the foot: the height of the ankle differs by a few centimetres between
//! models.

use super::BodySolid;
use super::joint_places::JointPlaces;
use super::part::Part;
use crate::model::anatomy::{Sole, SolePoint};
use crate::model::anthropometry::{ContactSphere, Dimensions, SpherePart};
use crate::model::{BodyId, Side};
use crate::spatial::Vec3;

/// A foot with its sole.
pub(super) struct Foot {
    pub(super) side: Side,
    pub(super) sole: Sole,
    /// The body that heel and ball belong to.
    pub(super) rear: BodyId,
    /// The body of the toes, in front of the ball.
    pub(super) toes: Option<BodyId>,
}

/// Both feet, if the model has them; estimated soles are lowered by `sunk` [m] on the right and the left.
pub(super) fn feet(places: &JointPlaces<'_>, stature: f64, size: &Dimensions, sunk: [f64; 2]) -> Vec<Foot> {
    let sides = Side::BOTH.into_iter().zip(sunk);
    sides.filter_map(|(side, sunk)| Foot::new(places, side, stature, size, sunk)).collect()
}

impl Foot {
    fn new(places: &JointPlaces<'_>, side: Side, stature: f64, size: &Dimensions, sunk: f64) -> Option<Foot> {
        let half_width = 0.5 * size.foot_width;
        let sole = Sole::of_spheres(&spheres(places, side, size), side, half_width)
            .or_else(|| Some(lowered(places, places.model.anatomy().soles(stature)[side]?, sunk)))?;
        let rear = sole.points[0].body;
        let toes = places.children(rear).find(|id| places.part(*id) == Part::Toes);
        let points = sole.points.map(|point| match toes {
            Some(toes) if point.body == rear => before_the_ball(places, point, rear, toes),
            _ => point,
        });
        Some(Foot { side, sole: Sole { points, ..sole }, rear, toes })
    }

    /// Shapes of the rear foot: from heel, ankle and ball.
    pub(super) fn rear_shapes(&self, places: &JointPlaces<'_>, size: &Dimensions) -> Vec<BodySolid> {
        let up = places.up(self.rear);
        let [heel, ball, _] = self.sole.points.map(|point| self.in_rear(places, point));
        let (heel, ball) = (heel + up * size.heel_radius, ball + up * size.ball_radius);
        let ankle = self.ankle(places).unwrap_or(heel);
        let mut shapes = vec![
            BodySolid::capsule(heel, ball, size.ball_radius),
            BodySolid::capsule(heel, ankle, size.heel_radius),
            BodySolid::capsule(ankle, ball, size.ball_radius),
        ];
        if let Some(across) = up.cross(&(heel - ball)).try_normalize(1e-6) {
            let aside = across * (0.5 * size.foot_width - size.ball_radius).max(0.0);
            shapes.push(BodySolid::capsule(ball - aside, ball + aside, size.ball_radius));
        }
        if self.toes.is_none() {
            shapes.extend(self.front(places, self.rear, size));
        }
        shapes
    }

    /// Shapes of the toes.
    pub(super) fn toe_shapes(&self, places: &JointPlaces<'_>, size: &Dimensions) -> Vec<BodySolid> {
        self.toes.map(|toes| self.front(places, toes, size)).unwrap_or_default()
    }

    /// Capsules from the ball to the tip, three side by side, in the frame of a body.
    fn front(&self, places: &JointPlaces<'_>, body: BodyId, size: &Dimensions) -> Vec<BodySolid> {
        let up = places.up(body);
        let [_, ball, tip] = self.sole.points.map(|point| places.seen_from(body, world(places, point)));
        // The sole ends half a width before the tip.
        let ahead = (tip - ball).try_normalize(1e-6).unwrap_or_else(Vec3::x);
        let tip = tip + ahead * (0.5 * size.foot_width - size.toe_radius).max(0.0);
        let (ball, tip) = (ball + up * size.toe_radius, tip + up * size.toe_radius);
        let aside = up.cross(&ahead) * (0.5 * size.foot_width - size.ball_radius).max(0.0);
        let shorter = tip - (tip - ball) * 0.12;
        let outer = |sign: f64| BodySolid::capsule(ball + aside * sign, shorter + aside * sign * 0.7, size.toe_radius);
        vec![BodySolid::capsule(ball, tip, size.toe_radius), outer(1.0), outer(-1.0)]
    }

    fn in_rear(&self, places: &JointPlaces<'_>, point: SolePoint) -> Vec3 {
        places.seen_from(self.rear, world(places, point))
    }

    /// The end of the shank, above a talus if there is one.
    fn ankle(&self, places: &JointPlaces<'_>) -> Option<Vec3> {
        let shank = places.find(Part::Shank, Some(self.side))?;
        let below =
            places.children(shank).find(|id| *id == self.rear || places.children(*id).any(|c| c == self.rear))?;
        Some(places.joint_of(below, self.rear))
    }
}

/// The sole, lowered along the vertical axis of the foot.
fn lowered(places: &JointPlaces<'_>, sole: Sole, by: f64) -> Sole {
    let lower = |point: SolePoint| SolePoint { place: point.place - places.up(point.body) * by, ..point };
    Sole { points: sole.points.map(lower), ..sole }
}

fn world(places: &JointPlaces<'_>, point: SolePoint) -> Vec3 {
    places.rest[point.body.index()].pose.place(point.place)
}

/// Assigns points in front of the toe joint to the toes.
fn before_the_ball(places: &JointPlaces<'_>, point: SolePoint, rear: BodyId, toes: BodyId) -> SolePoint {
    let joint = places.joint_of(toes, rear);
    let forward = (joint - places.own(rear)).try_normalize(1e-6).unwrap_or_else(Vec3::x);
    const SLACK_M: f64 = 0.02;
    if (point.place - joint).dot(&forward) <= SLACK_M {
        return point;
    }
    SolePoint { body: toes, place: places.seen_from(toes, world(places, point)) }
}

/// The contact spheres of a built-in figure from its markers: the heel marker is at the rear of its sphere, the others
/// at the centres.
fn spheres(places: &JointPlaces<'_>, side: Side, size: &Dimensions) -> Vec<ContactSphere> {
    let radii = [size.heel_radius, size.ball_radius, size.toe_radius];
    let sphere = |((part, stem), radius): ((SpherePart, &str), f64)| {
        let name = format!("{stem}_{}", side.letter());
        let marker = places.model.markers().iter().find(|marker| marker.name == name)?;
        let forward = if part == SpherePart::Heel { radius } else { 0.0 };
        let center = marker.location + Vec3::new(forward, 0.0, 0.0);
        Some(ContactSphere { name, part, side, body: marker.body?, center, radius })
    };
    SpherePart::OF_FOOT.into_iter().zip(radii).filter_map(sphere).collect()
}
