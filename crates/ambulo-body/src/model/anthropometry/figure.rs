//! Builds the model of a figure from shares of mass and stature.

use super::dimensions::Dimensions;
use super::foot;
use super::proportions::{Proportions, RigidPart};
use super::ranges::{self, Range};
use super::{Build, BuildError, Extremities};
use crate::model::{
    Body, BodyId, Coordinate, CoordinateId, CoordinateKind, Displacement, Drive, Function, Joint, JointAxis,
    JointSpeeds, Marker, Model, Side,
};
use crate::spatial::{Inertia, InertiaError, Mat3, Pose, STANDARD_GRAVITY, Vec3};

/// A model under construction.
struct FigureBuilder<'a> {
    build: &'a Build,
    /// Body mass divided by the sum of the shares in the table [kg].
    mass: f64,
    dimensions: &'a Dimensions,
    bodies: Vec<Body>,
    coordinates: Vec<Coordinate>,
    markers: Vec<Marker>,
}

pub(super) fn model(build: &Build, p: &Proportions, d: &Dimensions) -> Result<Model, BuildError> {
    let mut builder = FigureBuilder::new(build, p, d);
    let (root, torso) = builder.trunk(p)?;
    for side in Side::BOTH {
        builder.leg(root, side, p)?;
    }
    for side in Side::BOTH {
        builder.arm(torso, side, p)?;
    }
    let FigureBuilder { bodies, coordinates, markers, .. } = builder;
    let rounded = |x: f64| (1e3 * x).round() / 1e3;
    let name = format!("{} {} kg {} m", build.table, rounded(build.mass), rounded(build.height));
    Ok(Model::new(name, Vec3::new(0.0, -STANDARD_GRAVITY, 0.0), bodies, coordinates, markers)?)
}

/// Head with neck, and a hand, as parts of their own.
pub(super) fn extremities(build: &Build, p: &Proportions, d: &Dimensions) -> Result<Extremities, BuildError> {
    let builder = FigureBuilder::new(build, p, d);
    let joint = d.vertex() - p.lengths.head_and_neck * build.height;
    let head = builder.rigid_parts(&p.torso[p.torso.len() - 1..], Vec3::y() * -joint)?;
    let hand = builder.rigid_parts(&[p.hand], Vec3::zeros())?;
    Ok(Extremities { neck: Vec3::y() * (joint - d.lumbar_height.unwrap_or(0.0)), head, hand })
}

impl<'a> FigureBuilder<'a> {
    fn new(build: &'a Build, p: &Proportions, dimensions: &'a Dimensions) -> FigureBuilder<'a> {
        let mass = build.mass / p.mass();
        FigureBuilder { build, mass, dimensions, bodies: Vec::new(), coordinates: Vec::new(), markers: Vec::new() }
    }

    /// The root and the body with the shoulders, which may be the same.
    fn trunk(&mut self, p: &Proportions) -> Result<(BodyId, BodyId), BuildError> {
        let d = *self.dimensions;
        let upper = self.rigid_parts(&p.torso, Vec3::zeros())?;
        let (root, torso, lumbar) = if let Some(height) = d.lumbar_height {
            let lumbar = Vec3::new(0.0, height, 0.0);
            let lower = self.rigid_parts(&p.pelvis, Vec3::zeros())?;
            let root = self.root("pelvis", lower);
            let upper = upper.seen_from(&Pose::at(-lumbar));
            let torso = self.hinge("torso", upper, root, lumbar, "lumbar_extension", ranges::LUMBAR_EXTENSION);
            (root, torso, height)
        } else {
            let root = self.root("torso", upper);
            (root, root, 0.0)
        };
        self.marker("sacrum", root, Vec3::zeros());
        self.marker("pelvis_front", root, Vec3::new(0.5 * d.hip_width, 0.0, 0.0));
        self.marker("neck", torso, Vec3::new(0.0, d.vertex() - d.head - lumbar, 0.0));
        self.marker("vertex", torso, Vec3::new(0.0, d.vertex() - lumbar, 0.0));
        Ok((root, torso))
    }

    fn leg(&mut self, root: BodyId, side: Side, p: &Proportions) -> Result<(), BuildError> {
        let d = *self.dimensions;
        let at = |name: &str| format!("{name}_{}", side.letter());
        let (hip, knee, ankle) =
            (outward(side, 0.5 * d.hip_width), Vec3::new(0.0, -d.thigh, 0.0), Vec3::new(0.0, -d.shank, 0.0));
        let [thigh, shank, whole_foot] =
            [&p.thigh, &p.shank, &p.foot].map(|part| self.rigid_parts(std::slice::from_ref(part), Vec3::zeros()));
        let femur = self.hinge(&at("femur"), thigh?, root, hip, &at("hip_flexion"), ranges::HIP_FLEXION);
        let tibia = self.hinge(&at("tibia"), shank?, femur, knee, &at("knee_angle"), ranges::KNEE);
        let whole_foot = whole_foot?;
        let (rear, toes) = foot::split(&whole_foot, &d)?;
        let rear = if self.build.toe_joint { rear } else { whole_foot };
        let calcn = self.hinge(&at("calcn"), rear, tibia, ankle, &at("ankle_angle"), ranges::ANKLE);
        let ball = foot::ball(&d);
        let tip = Vec3::new(d.ankle_to_ball + d.ball_to_toe, d.toe_radius - d.ankle_height, 0.0);
        self.marker(&at("hip"), root, hip);
        self.marker(&at("knee"), femur, knee);
        self.marker(&at("ankle"), tibia, ankle);
        self.marker(&at("heel"), calcn, Vec3::new(-d.heel_to_ankle, d.heel_radius - d.ankle_height, 0.0));
        self.marker(&at("ball"), calcn, ball);
        if self.build.toe_joint {
            let toes = self.hinge(&at("toes"), toes, calcn, ball, &at("mtp_angle"), ranges::TOES);
            self.marker(&at("toe"), toes, tip - ball);
        } else {
            self.marker(&at("toe"), calcn, tip);
        }
        Ok(())
    }

    fn arm(&mut self, torso: BodyId, side: Side, p: &Proportions) -> Result<(), BuildError> {
        let d = *self.dimensions;
        let at = |name: &str| format!("{name}_{}", side.letter());
        let up = d.shoulder_height - d.lumbar_height.unwrap_or(0.0);
        let shoulder = outward(side, 0.5 * d.shoulder_width) + Vec3::new(0.0, up, 0.0);
        let (elbow, wrist) = (Vec3::new(0.0, -d.upper_arm, 0.0), Vec3::new(0.0, -d.forearm, 0.0));
        let upper = self.rigid_parts(&[p.upper_arm], Vec3::zeros())?;
        let lower = self.rigid_parts(&[p.forearm], Vec3::zeros())?.joined(&self.rigid_parts(&[p.hand], wrist)?);
        let humerus = self.hinge(&at("humerus"), upper, torso, shoulder, &at("arm_flex"), ranges::SHOULDER_FLEXION);
        let forearm = self.hinge(&at("forearm"), lower, humerus, elbow, &at("elbow_flex"), ranges::ELBOW_FLEXION);
        self.marker(&at("shoulder"), torso, shoulder);
        self.marker(&at("elbow"), humerus, elbow);
        self.marker(&at("wrist"), forearm, wrist);
        Ok(())
    }

    /// Inertia of several rigid parts; `origin` is their origin in the body [m].
    fn rigid_parts(&self, rigid_parts: &[RigidPart], origin: Vec3) -> Result<Inertia, InertiaError> {
        let height = self.build.height;
        let mut whole = Inertia::new(0.0, origin, Mat3::zeros())?;
        for part in rigid_parts {
            let mass = part.mass * self.mass;
            let moments = part.radii.map(|r| mass * (r * height).powi(2));
            let center = origin + Vec3::new(part.center[0], part.center[1], 0.0) * height;
            whole = whole.joined(&Inertia::new(mass, center, Mat3::from_diagonal(&Vec3::from(moments)))?);
        }
        Ok(whole)
    }

    fn root(&mut self, name: &str, inertia: Inertia) -> BodyId {
        let tilt = self.coordinate("pelvis_tilt", CoordinateKind::Rotation, 0.0, None);
        let forward = self.coordinate("pelvis_tx", CoordinateKind::Translation, 0.0, None);
        let up = self.coordinate("pelvis_ty", CoordinateKind::Translation, self.dimensions.leg_length, None);
        let joint = Joint {
            name: "ground_pelvis".to_owned(),
            parent: None,
            parent_from_joint: Pose::IDENTITY,
            child_from_joint: Pose::IDENTITY,
            rotations: vec![axis(Vec3::z(), tilt)],
            translations: vec![axis(Vec3::x(), forward), axis(Vec3::y(), up)],
            speeds: JointSpeeds::Rates,
        };
        self.body(name, inertia, joint)
    }

    /// A body with a hinge about z at `place` in its parent [m].
    fn hinge(
        &mut self,
        name: &str,
        inertia: Inertia,
        parent: BodyId,
        place: Vec3,
        coordinate: &str,
        range: Range,
    ) -> BodyId {
        let range = range.map(f64::to_radians);
        let id = self.coordinate(coordinate, CoordinateKind::Rotation, 0.0, Some(range));
        let joint = Joint {
            name: coordinate.to_owned(),
            parent: Some(parent),
            parent_from_joint: Pose::at(place),
            child_from_joint: Pose::IDENTITY,
            rotations: vec![axis(Vec3::z(), id)],
            translations: Vec::new(),
            speeds: JointSpeeds::Rates,
        };
        self.body(name, inertia, joint)
    }

    fn body(&mut self, name: &str, inertia: Inertia, joint: Joint) -> BodyId {
        self.bodies.push(Body { name: name.to_owned(), inertia, joint });
        BodyId(self.bodies.len() - 1)
    }

    fn coordinate(
        &mut self,
        name: &str,
        kind: CoordinateKind,
        default_value: f64,
        range: Option<[f64; 2]>,
    ) -> CoordinateId {
        self.coordinates.push(Coordinate {
            name: name.to_owned(),
            kind,
            default_value,
            range,
            clamped: false,
            drive: Drive::Free,
        });
        CoordinateId(self.coordinates.len() - 1)
    }

    fn marker(&mut self, name: &str, body: BodyId, location: Vec3) {
        self.markers.push(Marker { name: name.to_owned(), body: Some(body), location, fixed: false });
    }
}

/// A distance [m] towards the given side.
fn outward(side: Side, distance: f64) -> Vec3 {
    match side {
        Side::Right => Vec3::z() * distance,
        Side::Left => Vec3::z() * -distance,
    }
}

fn axis(direction: Vec3, coordinate: CoordinateId) -> JointAxis {
    let follows = Displacement::Follows(coordinate, Function::Linear { slope: 1.0, intercept: 0.0 });
    JointAxis { direction, displacement: follows }
}
