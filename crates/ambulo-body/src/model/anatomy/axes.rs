//! Determines the forward direction and the side of each leg.
//!
//! Feet point forward from the ankle. Seen from behind, the hip on the right belongs to the right leg. Names are used
//! only if the geometry is not sufficient: feet without length, or hips at one position, as in planar models.

use super::legs::{LegChain, Legs, LowerBody, Tree, level};
use crate::model::{BodyId, BySide, Side};
use crate::spatial::{Mat3, Vec3};

/// Distances below this share of the leg length do not define a direction.
const CLEAR: f64 = 0.02;
/// Smallest distance of a body of one side from the midline, as a share of the leg length.
const BESIDE: f64 = 0.04;
/// Largest distance of its counterpart from its mirror image, as a share of the leg length.
const MIRRORED: f64 = 0.15;

/// Legs by side, and the axes of the body: columns forward, up and right in the world.
pub(super) struct Oriented {
    pub(super) axes: Mat3,
    pub(super) legs: Legs,
}

impl Tree<'_> {
    fn side_by_name(&self, leg: &LegChain) -> Option<Side> {
        leg.bodies[1..].iter().find_map(|body| Side::of_name(&self.bodies[body.index()].name))
    }

    pub(super) fn oriented(&self, lower: LowerBody) -> Option<Oriented> {
        let feet: Vec3 = lower.legs.iter().map(|leg| self.ahead(leg)).sum();
        let clear = CLEAR * lower.legs[0].length;
        let mut legs = lower.legs.into_iter();
        let (first, second) = (legs.next()?, legs.next());
        let (axes, first_side) = match &second {
            Some(second) => self.of_two(&first, second, feet, clear)?,
            None => self.of_one(&first, lower.pelvis, feet, clear)?,
        };
        let legs = match first_side {
            Side::Right => BySide { right: Some(first), left: second },
            Side::Left => BySide { right: second, left: Some(first) },
        };
        Some(Oriented { axes, legs })
    }

    /// Axes, and the side of the first leg.
    fn of_two(&self, first: &LegChain, second: &LegChain, feet: Vec3, clear: f64) -> Option<(Mat3, Side)> {
        let across = level(self.hip(first) - self.hip(second), self.up);
        let named = self.side_by_name(first).or_else(|| self.side_by_name(second).map(Side::other));
        if across.norm() <= clear {
            let axes = self.axes(if feet.norm() > clear { feet } else { Vec3::x() })?;
            return Some((axes, named?));
        }
        // Forward if the first leg is the right one: up × right.
        let ahead = self.up.cross(&across.normalize());
        let first_side = match (feet.dot(&ahead), named) {
            (agreement, _) if agreement.abs() > clear => right_if(agreement > 0.0),
            (_, Some(named)) => named,
            _ => right_if(ahead.x >= 0.0),
        };
        Some((self.axes(if first_side == Side::Right { ahead } else { -ahead })?, first_side))
    }

    /// The side of the only leg is the side of the pelvis on which its hip lies.
    fn of_one(&self, leg: &LegChain, pelvis: BodyId, feet: Vec3, clear: f64) -> Option<(Mat3, Side)> {
        if feet.norm() <= clear {
            return None;
        }
        let axes = self.axes(feet)?;
        let right: Vec3 = axes.column(2).into();
        let offset = (self.hip(leg) - self.posture.mass_center(pelvis)).dot(&right);
        let by_place = (offset.abs() > clear).then(|| right_if(offset > 0.0));
        Some((axes, by_place.or_else(|| self.side_by_name(leg))?))
    }

    fn axes(&self, ahead: Vec3) -> Option<Mat3> {
        let forward = level(ahead, self.up).try_normalize(f64::MIN_POSITIVE)?;
        Some(Mat3::from_columns(&[forward, self.up, forward.cross(&self.up)]))
    }

    /// Side of every body: for bodies of a leg, the side of the leg; for others by their position, if there is a
    /// counterpart on the other side; otherwise the side in their name.
    pub(super) fn sides(&self, pelvis: BodyId, oriented: &Oriented) -> Vec<Option<Side>> {
        let mut sides: Vec<Option<Side>> = vec![None; self.bodies.len()];
        let hips: Vec<Vec3> = oriented.legs.values().flatten().map(|leg| self.hip(leg)).collect();
        let length = oriented.legs.values().flatten().map(|leg| leg.length).fold(0.0, f64::max);
        let middle = if hips.len() == 2 { (hips[0] + hips[1]) * 0.5 } else { self.posture.mass_center(pelvis) };
        let of_legs: Vec<(Side, Vec<BodyId>)> = oriented
            .legs
            .iter()
            .filter_map(|(side, leg)| Some((side, self.beyond(pelvis, leg.as_ref()?.bodies[1]))))
            .collect();
        let places: Vec<Vec3> = (0..self.bodies.len())
            .map(|i| oriented.axes.transpose() * (self.posture.mass_center(BodyId(i)) - middle))
            .collect();
        for (i, body) in self.bodies.iter().enumerate() {
            let leg = of_legs.iter().find(|(_, bodies)| bodies.contains(&BodyId(i))).map(|(side, _)| *side);
            let mirrored = Vec3::new(places[i].x, places[i].y, -places[i].z);
            let has_counterpart = || places.iter().any(|place| (place - mirrored).norm() < MIRRORED * length);
            let is_beside = places[i].z.abs() > BESIDE * length && has_counterpart();
            let by_place = is_beside.then(|| right_if(places[i].z > 0.0));
            sides[i] = leg.or(by_place).or_else(|| Side::of_name(&body.name));
        }
        sides
    }
}

fn right_if(condition: bool) -> Side {
    if condition { Side::Right } else { Side::Left }
}
