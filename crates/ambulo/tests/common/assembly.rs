//! Models put together in code, body by body.

use ambulo::model::{
    Body, BodyId, Coordinate, CoordinateId, CoordinateKind, Displacement, Drive, Function, Joint, JointAxis,
    JointSpeeds, Model,
};
use ambulo::spatial::{Inertia, Mat3, Pose, Vec3};

/// A model in the making.
pub(crate) struct Assembly {
    bodies: Vec<Body>,
    coordinates: usize,
    body_ids: Vec<BodyId>,
    coordinate_ids: Vec<CoordinateId>,
}

/// The moving part of a joint.
#[derive(Debug, Clone)]
pub(crate) struct Axes {
    pub(crate) rotations: Vec<JointAxis>,
    pub(crate) translations: Vec<JointAxis>,
    pub(crate) speeds: JointSpeeds,
}

/// A joint's frames: F on the parent, M on the child.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frames {
    pub(crate) parent_from_joint: Pose,
    pub(crate) child_from_joint: Pose,
}

impl Frames {
    /// The child's frame is M, at this place in the parent, with the parent's axes.
    pub(crate) fn at(x: f64, y: f64, z: f64) -> Frames {
        Frames { parent_from_joint: Pose::at(Vec3::new(x, y, z)), child_from_joint: Pose::IDENTITY }
    }
}

impl Assembly {
    const MOST_BODIES: usize = 16;
    const MOST_COORDINATES: usize = 100;

    /// Ids are handed out by models alone, so a blank model is made first.
    pub(crate) fn new() -> Assembly {
        let blank = |i: usize| Body {
            name: format!("blank{i}"),
            inertia: Inertia::new(0.0, Vec3::zeros(), Mat3::zeros()).unwrap(),
            joint: joint(format!("blank{i}"), None, Frames::at(0.0, 0.0, 0.0), Axes::weld()),
        };
        let bodies = (0..Self::MOST_BODIES).map(blank).collect();
        let coordinates = (0..Self::MOST_COORDINATES).map(coordinate).collect();
        let source = Model::new("blank", Vec3::zeros(), bodies, coordinates, Vec::new()).unwrap();
        Assembly {
            bodies: Vec::new(),
            coordinates: 0,
            body_ids: source.body_ids().collect(),
            coordinate_ids: source.coordinate_ids().collect(),
        }
    }

    /// The next coordinate.
    pub(crate) fn coordinate(&mut self) -> CoordinateId {
        self.coordinates += 1;
        self.coordinate_ids[self.coordinates - 1]
    }

    /// An axis that a new coordinate follows with slope one.
    pub(crate) fn axis(&mut self, direction: Vec3) -> JointAxis {
        follow(direction, self.coordinate(), Function::Linear { slope: 1.0, intercept: 0.0 })
    }

    /// A new body on a parent, or on ground.
    pub(crate) fn attach(&mut self, parent: Option<BodyId>, frames: Frames, axes: Axes, inertia: Inertia) -> BodyId {
        let name = format!("body{}", self.bodies.len());
        let joint = joint(name.clone(), parent, frames, axes);
        self.bodies.push(Body { name, inertia, joint });
        self.body_ids[self.bodies.len() - 1]
    }

    /// Attaches by a pin about z.
    pub(crate) fn pin(&mut self, parent: Option<BodyId>, frames: Frames, inertia: Inertia) -> BodyId {
        let axes = Axes { rotations: vec![self.axis(Vec3::z())], ..Axes::weld() };
        self.attach(parent, frames, axes, inertia)
    }

    /// Ball or free joint: X, Y, Z rotations measured by the angular velocity, then these translations.
    pub(crate) fn ball(&mut self, translations: &[Vec3]) -> Axes {
        let rotations = [Vec3::x(), Vec3::y(), Vec3::z()].map(|d| self.axis(d)).to_vec();
        let translations = translations.iter().map(|d| self.axis(*d)).collect();
        Axes { rotations, translations, speeds: JointSpeeds::AngularVelocity }
    }

    /// A free joint.
    pub(crate) fn free(&mut self) -> Axes {
        self.ball(&[Vec3::x(), Vec3::y(), Vec3::z()])
    }

    pub(crate) fn model(self, gravity: Vec3) -> Model {
        let coordinates = (0..self.coordinates).map(coordinate).collect();
        Model::new("assembled", gravity, self.bodies, coordinates, Vec::new()).unwrap()
    }
}

impl Axes {
    /// No motion at all.
    pub(crate) fn weld() -> Axes {
        Axes { rotations: Vec::new(), translations: Vec::new(), speeds: JointSpeeds::Rates }
    }
}

/// An axis that follows a coordinate by a function.
pub(crate) fn follow(direction: Vec3, id: CoordinateId, function: Function) -> JointAxis {
    JointAxis { direction, displacement: Displacement::Follows(id, function) }
}

/// A body with mass [kg], mass centre [m] and principal moments [kg.m²].
pub(crate) fn inertia(mass: f64, center: [f64; 3], principal: [f64; 3]) -> Inertia {
    Inertia::new(mass, Vec3::from(center), Mat3::from_diagonal(&Vec3::from(principal))).unwrap()
}

fn joint(name: String, parent: Option<BodyId>, frames: Frames, axes: Axes) -> Joint {
    let Frames { parent_from_joint, child_from_joint } = frames;
    let Axes { rotations, translations, speeds } = axes;
    Joint { name, parent, parent_from_joint, child_from_joint, rotations, translations, speeds }
}

fn coordinate(i: usize) -> Coordinate {
    Coordinate {
        name: format!("q{i}"),
        kind: CoordinateKind::Rotation,
        default_value: 0.0,
        range: None,
        clamped: false,
        drive: Drive::Free,
    }
}
