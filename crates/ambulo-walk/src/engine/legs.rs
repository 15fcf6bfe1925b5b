//! Solid legs: what is below one knee of a figure in three dimensions does not pass through what is below the other.
//!
//! Of the body that pictures show ([`FigureShape`]), one capsule per part is solid: from knee to ankle, from heel to
//! ball, and from the ball to the tip of the toes. It touches those of the other leg of the same figure and nothing
//! else: soles touch the ground. Thighs are not solid, since those of people touch as well.

use super::fallen::contact_shape;
use super::figure_tree::{FigureTree, center_from};
use super::{Owner, Surface, World};
use crate::contact::ShapeError;
use crate::figure_shape::FigureShape;
use crate::model::{BodyId, Movement, Side};
use crate::spatial::Pose;

impl FigureTree {
    /// Makes the legs of a figure in three dimensions solid. A planar figure has its legs side by side: nothing to do.
    ///
    /// # Errors
    /// Solids without size.
    pub(crate) fn add_solid_legs(&self, world: &mut World) -> Result<(), ShapeError> {
        if self.model.coordinate("pelvis_tz").is_none() {
            return Ok(());
        }
        let material = world.materials.len();
        world.materials.push(self.flesh());
        let shapes = FigureShape::new(&self.model, None, [0.0; 2]).solids;
        let mut legs = [Vec::new(), Vec::new()];
        for (id, solids) in self.model.body_ids().zip(shapes) {
            let Some(side) = self.leg_of(id) else { continue };
            if let Some((shape, place)) = solids.iter().find_map(contact_shape) {
                legs[usize::from(side == Side::Left)].push(world.surfaces.len());
                let owner = Owner::Body(self.first_body + id.index());
                let owner_from_shape = center_from(&self.model, id) * Pose::at(place);
                world.surfaces.push(Surface { owner, shape: shape?, owner_from_shape, material });
            }
        }
        let [right, left] = legs;
        let pairs = right.iter().flat_map(|one| left.iter().map(|other| (*one.min(other), *one.max(other))));
        world.limbs.extend(pairs);
        Ok(())
    }

    /// The leg below whose knee a body is.
    fn leg_of(&self, id: BodyId) -> Option<Side> {
        let bodies = self.model.bodies();
        let has_knee = |side: Side| {
            let knee = self.model.anatomy().coordinate(Movement::KneeFlexion, Some(side)).map(|(knee, _)| knee);
            let turns =
                |body: BodyId| knee.is_some_and(|knee| bodies[body.index()].joint.coordinates().contains(&knee));
            std::iter::successors(Some(id), |body| bodies[body.index()].joint.parent).any(turns)
        };
        Side::BOTH.into_iter().find(|side| has_knee(*side))
    }
}
