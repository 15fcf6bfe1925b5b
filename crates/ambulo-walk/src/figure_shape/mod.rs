//! The solids of a person: what the bodies of a model look like, and where they touch other things.
//!
//! Every body of a model is a few capsules, and faces between them, as thick as follows from its mass or from the
//! stature. The pictures of reports draw them, and a figure that has fallen lies on them.

mod foot;
mod hand;
mod joint_places;
mod limb;
mod part;
mod trunk;

use crate::model::anatomy::SolePoint;
use crate::model::anthropometry::{Build, Dimensions, SegmentTable};
use crate::model::{BodyId, Model, Side};
use crate::spatial::Vec3;
use joint_places::JointPlaces;
use part::Part;

/// Statures that the tables of segments allow [m].
const HEIGHTS: [f64; 2] = [0.4, 2.5];
/// Mass over stature cubed of 73 kg and 1.74 m; lengths do not depend on it [kg/m³].
const PONDERAL: f64 = 13.9;

/// A solid, or a part of its surface, in the axes of its body [m].
#[derive(Debug, Clone, PartialEq)]
pub enum BodySolid {
    /// A cylinder with round ends; a sphere if both ends are the same.
    Capsule {
        /// One end [m].
        from: Vec3,
        /// The other [m].
        to: Vec3,
        /// Radius [m].
        radius: f64,
    },
    /// Triangles between capsules.
    Faces {
        /// Corners [m].
        points: Vec<Vec3>,
        /// Numbers of the corners.
        triangles: Vec<[u32; 3]>,
    },
}

impl BodySolid {
    /// A cylinder with round ends.
    fn capsule(from: Vec3, to: Vec3, radius: f64) -> BodySolid {
        BodySolid::Capsule { from, to, radius }
    }
}

/// The solids of all bodies of a model, and its soles.
#[derive(Debug, Clone, PartialEq)]
pub struct FigureShape {
    /// Solids of each body, in the order of the model.
    pub solids: Vec<Vec<BodySolid>>,
    /// Points of the soles: heel, ball and tip of each foot that the model has.
    pub soles: Vec<(Side, SolePoint)>,
}

impl FigureShape {
    /// The solids of a model. The stature [m], unless it is known, follows from the legs, or from the mass. Soles that
    /// are estimated are lowered by `sunk_m` [m] on the right and the left.
    #[must_use]
    pub fn new(model: &Model, stature_m: Option<f64>, sunk_m: [f64; 2]) -> FigureShape {
        let places = JointPlaces::new(model);
        let known = stature_m.filter(|height| height.is_finite() && *height > 0.0);
        let stature = known.unwrap_or_else(|| model.stature().height_m);
        let nothing = || FigureShape { solids: vec![Vec::new(); model.bodies().len()], soles: Vec::new() };
        lengths(stature).map_or_else(nothing, |size| FigureShape::of(&places, stature, &size, sunk_m))
    }

    fn of(places: &JointPlaces<'_>, stature: f64, size: &Dimensions, sunk_m: [f64; 2]) -> FigureShape {
        let feet = foot::feet(places, stature, size, sunk_m);
        let of = |body: BodyId| match places.part(body) {
            _ if let Some(foot) = feet.iter().find(|foot| foot.rear == body) => foot.rear_shapes(places, size),
            _ if let Some(foot) = feet.iter().find(|foot| foot.toes == Some(body)) => foot.toe_shapes(places, size),
            Part::Pelvis => trunk::pelvis(places, body, size),
            Part::Trunk => trunk::trunk(places, body, size),
            Part::Head => trunk::head(places, body, size),
            Part::Small => vec![limb::dot(places.mass_center(body), stature)],
            Part::Hand => hand::hand(places, body, size),
            Part::Forearm if places.children(body).next().is_none() => hand::forearm(places, body, stature, size),
            _ => limb::limb(places, body, stature),
        };
        let points = |foot: &foot::Foot| foot.sole.points.map(|point| (foot.side, point));
        FigureShape { solids: places.model.body_ids().map(of).collect(), soles: feet.iter().flat_map(points).collect() }
    }
}

/// Lengths of a person of this stature [m] from de Leva's table, for parts that a model lacks.
fn lengths(stature: f64) -> Option<Dimensions> {
    let height = stature.clamp(HEIGHTS[0], HEIGHTS[1]);
    let build = Build { table: SegmentTable::DeLevaMale, mass: PONDERAL * height.powi(3), height, toe_joint: true };
    build.human().ok().map(|human| human.dimensions)
}
