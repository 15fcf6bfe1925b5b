//! A figure that has fallen lies on the solids of its body, the same that pictures show ([`FigureShape`]).
//!
//! Flesh is a spring with a damper at every contact point. A part that is already below the ground when the figure
//! falls is therefore pushed out slowly, within about damping over stiffness.

use super::figure_tree::{FigureTree, center_from};
use super::{ContactLaw, Material, Owner, Surface, World};
use crate::contact::{Shape, ShapeError};
use crate::figure_shape::{BodySolid, FigureShape};
use crate::spatial::{Pose, Vec3};

/// Stiffness [N/m] and damping [N.s/m] of a contact point over the mass of the person [kg]: 75 kg on ten points sink
/// by 3 mm, and come to rest in 0.1 s.
const STIFFNESS: f64 = 333.0;
const DAMPING: f64 = 33.3;
/// Coefficient of friction of a body on the ground.
const FRICTION: f64 = 0.6;

impl FigureTree {
    /// The figure lies on the ground from now on: its joints turn no further than their ranges, and its solids touch
    /// everything but each other. `now` has value and rate of each coordinate.
    ///
    /// # Errors
    /// Solids without size.
    pub(crate) fn lie_down(&self, world: &mut World, now: &[[f64; 2]]) -> Result<(), ShapeError> {
        self.stop_at_ranges(world, now);
        let material = world.materials.len();
        world.materials.push(self.flesh());
        for (id, solids) in self.model.body_ids().zip(FigureShape::new(&self.model, None, [0.0; 2]).solids) {
            let owner = Owner::Body(self.first_body + id.index());
            for (shape, place) in solids.iter().filter_map(contact_shape) {
                let owner_from_shape = center_from(&self.model, id) * Pose::at(place);
                world.surfaces.push(Surface { owner, shape: shape?, owner_from_shape, material });
            }
        }
        self.ignore_itself(world);
        Ok(())
    }

    /// The material of the solids.
    pub(super) fn flesh(&self) -> Material {
        let mass = self.model.mass();
        let law = ContactLaw::Regularised { stiffness: STIFFNESS * mass, damping: DAMPING * mass };
        Material { friction: FRICTION, restitution: 0.0, law }
    }

    /// Joints turn no further than their ranges, or than now if they are beyond them.
    fn stop_at_ranges(&self, world: &mut World, now: &[[f64; 2]]) {
        let joint_of = world.joint_of_body();
        for ((place, coordinate), [value, _]) in self.places.iter().zip(self.model.coordinates()).zip(now) {
            if let (Some((joint, k)), Some([low, high])) = (place.joint(&joint_of), coordinate.range) {
                world.joints[joint].coordinates[k].limits = (Some(low.min(*value)), Some(high.max(*value)));
            }
        }
    }

    /// Bodies of the figure pass through each other.
    fn ignore_itself(&self, world: &mut World) {
        let own = self.first_body..self.first_body + self.model.bodies().len();
        for body in own.clone() {
            world.ignored.extend((body + 1..own.end).map(|other| (Owner::Body(body), Owner::Body(other))));
        }
        world.ignored.sort_unstable();
        world.ignored.dedup();
    }
}

/// The shape of a solid that touches others, and its place in the body [m]; faces lie between capsules, which touch.
pub(super) fn contact_shape(solid: &BodySolid) -> Option<(Result<Shape, ShapeError>, Vec3)> {
    match solid {
        BodySolid::Capsule { from, to, radius } if from == to => Some((Shape::sphere(*radius), *from)),
        BodySolid::Capsule { from, to, radius } => Some((Shape::capsule(Vec3::zeros(), to - from, *radius), *from)),
        BodySolid::Faces { .. } => None,
    }
}
