//! Regions of the body: pelvis and legs, trunk with head, arms.

use crate::model::{BodyId, CoordinateId, Model};
use serde::{Deserialize, Serialize};

/// A region of the body. Its markers are judged together, and apart from those of the other regions: joint moments of
/// the legs follow from the motion of the legs and from measured ground forces, whatever the arms do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Region {
    /// Pelvis, legs and feet.
    Legs,
    /// Trunk and head.
    Trunk,
    /// Arms and hands, with bodies of the shoulder girdle.
    Arms,
}

impl Region {
    /// All regions, the most important for walking first.
    pub const ALL: [Region; 3] = [Region::Legs, Region::Trunk, Region::Arms];

    /// The region of a body: the pelvis and what a hip carries are legs, other bodies of a side arms, the rest is
    /// trunk.
    #[must_use]
    pub fn of(model: &Model, body: BodyId) -> Region {
        let anatomy = model.anatomy();
        let is_hip = |own: BodyId| anatomy.legs().values().flatten().any(|leg| leg.hip == own);
        let mut chain = std::iter::successors(Some(body), |own| model.bodies()[own.index()].joint.parent);
        if anatomy.pelvis() == Some(body) || chain.any(is_hip) {
            return Region::Legs;
        }
        anatomy.body_side(body).map_or(Region::Trunk, |_| Region::Arms)
    }

    /// The region of the body that the joint of a coordinate carries; `None` if no joint has it.
    #[must_use]
    pub fn of_coordinate(model: &Model, id: CoordinateId) -> Option<Region> {
        let is_moved = |body: &BodyId| model.bodies()[body.index()].joint.coordinates().contains(&id);
        model.body_ids().find(is_moved).map(|body| Region::of(model, body))
    }

    /// The region in messages.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Region::Legs => "pelvis and legs",
            Region::Trunk => "trunk and head",
            Region::Arms => "arms",
        }
    }
}
