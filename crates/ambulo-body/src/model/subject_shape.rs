//! The shape of one person: the tree of the built-in body with other lengths.

use super::anthropometry::{BuildError, ContactSphere, Dimensions, Human, SpherePart};
use super::{Body, Drive, Marker, Model, Movement, Side};
use crate::spatial::{Inertia, Pose, Vec3};

/// Size and joint frames of a segment of a person.
#[derive(Debug, Clone, PartialEq)]
pub struct SegmentShape {
    /// Length divided by the length in the segment table; mass centre and radii of gyration scale with it, the mass
    /// does not.
    pub factor: f64,
    /// The joint frame on the parent.
    pub parent_from_joint: Pose,
    /// The joint frame on the segment.
    pub child_from_joint: Pose,
}

impl SegmentShape {
    /// The unchanged shape of every segment.
    #[must_use]
    pub fn of(human: &Human) -> Vec<SegmentShape> {
        let unchanged = |body: &Body| SegmentShape {
            factor: 1.0,
            parent_from_joint: body.joint.parent_from_joint,
            child_from_joint: body.joint.child_from_joint,
        };
        human.model.bodies().iter().map(unchanged).collect()
    }
}

/// Position of the sole of a flat foot relative to the ankle centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolePlacement {
    /// Height of the ankle centre above the ground [m].
    pub ankle_height: f64,
    /// Forward shift relative to the foot of the segment table at this size [m].
    pub forward: f64,
    /// Shift of the middle of the sole to the right of the ankle centre [m].
    pub right: f64,
}

impl SolePlacement {
    /// The foot of the segment table.
    #[must_use]
    pub fn of(dimensions: &Dimensions) -> SolePlacement {
        SolePlacement { ankle_height: dimensions.ankle_height, forward: 0.0, right: 0.0 }
    }

    /// Position of a point of the scaled foot of the segment table in this foot: `above` the ground, `forward` of the
    /// ankle [m].
    #[must_use]
    pub fn place(&self, forward: f64, above: f64) -> Vec3 {
        Vec3::new(forward + self.forward, above - self.ankle_height, self.right)
    }
}

/// Shape of the body of one person.
#[derive(Debug, Clone, PartialEq)]
pub struct SubjectShape {
    /// Shape of each segment, in the order of the model's bodies.
    pub segments: Vec<SegmentShape>,
    /// Markers, which replace the figure's markers.
    pub markers: Vec<Marker>,
    /// Right and left foot.
    pub feet: [SolePlacement; 2],
    /// Lengths; the leg length is the height of the pelvis in standing.
    pub dimensions: Dimensions,
    /// Coordinates that are locked at zero.
    pub locked: Vec<String>,
}

/// Gives a body the shape of one person; the masses do not change.
///
/// # Errors
/// A factor that is not positive, markers or joints that do not fit the model.
pub fn reshaped(human: &Human, shape: &SubjectShape) -> Result<Human, BuildError> {
    let model = &human.model;
    let mut bodies = model.bodies().to_vec();
    for (body, segment) in bodies.iter_mut().zip(&shape.segments) {
        let old = body.inertia;
        let about_center = old.about_center() * segment.factor.powi(2);
        body.inertia = Inertia::new(old.mass(), old.center() * segment.factor, about_center)?;
        body.joint.parent_from_joint = segment.parent_from_joint;
        body.joint.child_from_joint = segment.child_from_joint;
    }
    let mut coordinates = model.coordinates().to_vec();
    if let Some((height, _)) = model.anatomy().coordinate(Movement::PelvisUp, None) {
        coordinates[height.index()].default_value = shape.dimensions.leg_length;
    }
    for coordinate in &mut coordinates {
        if shape.locked.contains(&coordinate.name) {
            coordinate.drive = Drive::Locked;
        }
    }
    let model = Model::new(model.name(), model.gravity(), bodies, coordinates, shape.markers.clone())?;
    let soles = human.soles.iter().map(|sphere| resoled(&model, shape, human, sphere)).collect();
    Ok(Human { model, soles, dimensions: shape.dimensions, build: human.build })
}

/// Scales a sphere with its foot, and places it so that it touches the ground under a flat foot.
fn resoled(model: &Model, shape: &SubjectShape, human: &Human, sphere: &ContactSphere) -> ContactSphere {
    let foot = shape.feet[usize::from(sphere.side == Side::Left)];
    let index = sphere.body.index();
    let factor = shape.segments.get(index).map_or(1.0, |segment| segment.factor);
    let radius = sphere.radius * factor;
    let body = &model.bodies()[index];
    let is_heel = |other: &&ContactSphere| other.part == SpherePart::Heel && other.side == sphere.side;
    let on_toes = human.soles.iter().find(is_heel).is_some_and(|heel| heel.body != sphere.body);
    let center = if on_toes {
        // Relative to the ball of the foot, which is one ball radius above the ground.
        let above = body.joint.parent_from_joint.translation.y + foot.ankle_height;
        Vec3::new(sphere.center.x * factor, radius - above, 0.0)
    } else {
        foot.place(sphere.center.x * factor, radius)
    };
    ContactSphere { center, radius, ..sphere.clone() }
}
