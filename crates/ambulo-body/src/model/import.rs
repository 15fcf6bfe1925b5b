//! Reads a [`Model`] from an OpenSim document.

use super::osim_frame::pose;
use super::osim_function;
use super::scapulothoracic;
use super::{
    Body, BodyId, Bushing, BushingEnd, Coordinate, CoordinateId, CoordinateKind, Displacement, Drive, Function, Joint,
    JointAxis, JointSpeeds, Marker, Model, ModelError, Resistance,
};
use crate::findings::{Code, Finding, Findings};
use crate::numerics::counted;
use crate::spatial::{Inertia, InertiaError, Mat3, Vec3};
use ambulo_formats::osim::{
    OsimAxis, OsimBody, OsimBushing, OsimConstraint, OsimCoordinate, OsimFrame, OsimFunction, OsimJoint, OsimJointKind,
    OsimModel,
};
use std::collections::{BTreeMap, BTreeSet};

/// Why a file or a document does not describe a model that can be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ImportError {
    /// The file is not an OpenSim document.
    #[error(transparent)]
    File(#[from] ambulo_formats::Error),
    /// A body that is not connected to ground.
    #[error(
        "body `{body}` (line {line}) is not connected to ground; expected a joint with this body as its child. hint: a \
         FreeJoint to ground lets it move freely"
    )]
    Unjoined {
        /// The body.
        body: String,
        /// Its line.
        line: usize,
    },
    /// A joint whose child is ground.
    #[error(
        "joint `{joint}` (line {line}) has ground as its child; expected a body. hint: swap its parent and child frames"
    )]
    ChildIsGround {
        /// The joint.
        joint: String,
        /// Its line.
        line: usize,
    },
    /// A parent that the model does not have.
    #[error("joint `{joint}` (line {line}) has the parent body `{parent}`; expected `ground` or one of {known}")]
    UnknownParent {
        /// The joint.
        joint: String,
        /// Its line.
        line: usize,
        /// Its parent.
        parent: String,
        /// The bodies of the model.
        known: String,
    },
    /// Two coordinates with the same name.
    #[error("coordinate `{coordinate}` (line {line}) has the name of another one; expected different names")]
    DuplicateCoordinate {
        /// The coordinate.
        coordinate: String,
        /// Its line.
        line: usize,
    },
    /// A mass or an inertia that is not possible.
    #[error("body `{body}` (line {line})")]
    Inertia {
        /// The body.
        body: String,
        /// Its line.
        line: usize,
        /// Why.
        source: InertiaError,
    },
    /// A body that is the child of two joints.
    #[error(
        "body `{body}` is the child of two joints, `{first}` and `{second}` (line {line}); expected a tree. hint: \
         closed loops are not supported; remove one of the two joints"
    )]
    Loop {
        /// The body.
        body: String,
        /// The first joint.
        first: String,
        /// The second joint.
        second: String,
        /// Line of the second joint.
        line: usize,
    },
    /// A function that is not valid.
    #[error("joint `{joint}` (line {line}): {reason}")]
    Function {
        /// The joint or constraint.
        joint: String,
        /// Its line.
        line: usize,
        /// The reason.
        reason: String,
    },
    /// A coupler with an unknown coordinate.
    #[error(
        "constraint `{constraint}` (line {line}) names the coordinate `{coordinate}`; expected one of the model's \
         coordinates"
    )]
    UnknownCoordinate {
        /// The constraint.
        constraint: String,
        /// Its line.
        line: usize,
        /// The coordinate.
        coordinate: String,
    },
    /// Parts that do not fit together.
    #[error(transparent)]
    Model(#[from] ModelError),
}

impl Model {
    /// Reads an OpenSim model (`.osim`).
    ///
    /// # Errors
    /// Bytes that are not an OpenSim document, or a model that cannot be computed.
    ///
    /// ```
    /// use ambulo_body::findings::Findings;
    /// use ambulo_body::model::anthropometry::{Build, SegmentTable};
    /// use ambulo_body::model::{Model, to_osim};
    ///
    /// let build = Build { table: SegmentTable::DeLevaMale, mass: 72.6, height: 1.80, toe_joint: false };
    /// let bytes = to_osim(&build.human()?.model)?.write()?; // otherwise std::fs::read("subject.osim")?
    /// let model = Model::from_osim(&bytes, &mut Findings::default())?;
    /// assert!((model.mass() - 72.6).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn from_osim(bytes: &[u8], findings: &mut Findings) -> Result<Model, ImportError> {
        from_osim(&OsimModel::read(bytes)?, findings)
    }
}

/// Reads a model from an OpenSim document. Parts without effect on the dynamics are reported in one note, with counts;
/// impossible inertias, massless bodies and constraints that close loops give warnings.
///
/// # Errors
/// Bodies outside the tree, negative masses, unknown names: see [`ImportError`].
pub fn from_osim(document: &OsimModel, findings: &mut Findings) -> Result<Model, ImportError> {
    for remark in &document.remarks {
        findings.report(Code::ModelDocument, remark.to_string());
    }
    note_ignored(document, findings);
    note_muscles(document, findings);
    let (document, added) = scapulothoracic::divided(document);
    let document = document.as_ref();
    check_joints(document)?;
    let order = tree_order(document)?;
    let body_ids: BTreeMap<&str, BodyId> =
        order.iter().enumerate().map(|(i, (body, _))| (body.name.as_str(), BodyId(i))).collect();

    let mut coordinates = Vec::new();
    let mut bodies = Vec::new();
    for (body, joint) in &order {
        let joint = import_joint(joint, &body_ids, &mut coordinates)?;
        let is_added = added.contains(&body.name);
        let ignored = &mut Findings::default();
        let inertia = import_inertia(body, if is_added { ignored } else { findings })?;
        bodies.push(Body { name: body.name.clone(), inertia, joint });
    }
    for constraint in &document.constraints {
        couple(constraint, &mut coordinates, findings)?;
    }
    let markers = document.markers.iter().map(|m| Marker {
        name: m.name.clone(),
        body: body_ids.get(m.body.as_str()).copied(),
        location: Vec3::from(m.location_m),
        fixed: m.fixed,
    });
    let gravity = Vec3::from(document.gravity);
    let model = Model::new(document.name.clone(), gravity, bodies, coordinates, markers.collect())?;
    note_bushings(document, findings);
    Ok(model.with_bushings(document.bushings.iter().map(|b| import_bushing(b, &body_ids)).collect())?)
}

fn note_bushings(document: &OsimModel, findings: &mut Findings) {
    for OsimBushing { name, frames: [first, second], .. } in &document.bushings {
        let message = format!(
            "the bushing `{name}` between `{}` and `{}` is applied: the forces of the coordinates are those that act \
             besides it",
            first.body, second.body
        );
        findings.report(Code::ModelBushing, message);
    }
}

fn import_bushing(bushing: &OsimBushing, bodies: &BTreeMap<&str, BodyId>) -> Bushing {
    let resistance =
        |angular: [f64; 3], linear: [f64; 3]| Resistance { angular: angular.into(), linear: linear.into() };
    let end = |frame: &OsimFrame| BushingEnd { body: bodies.get(frame.body.as_str()).copied(), frame: pose(frame) };
    Bushing {
        name: bushing.name.clone(),
        ends: bushing.frames.each_ref().map(end),
        stiffness: resistance(bushing.rotational_stiffness, bushing.translational_stiffness),
        damping: resistance(bushing.rotational_damping, bushing.translational_damping),
        groups: bushing.groups.clone(),
    }
}

/// Notes that muscle forces can be had.
fn note_muscles(document: &OsimModel, findings: &mut Findings) {
    let count = document.muscles.as_ref().map_or(0, |found| found.muscles.len());
    if count > 0 {
        let message = format!("the model has {}; their forces are computed on request", counted(count, "muscle"));
        findings.report(Code::MusclesAvailable, message);
    }
}

fn note_ignored(document: &OsimModel, findings: &mut Findings) {
    if document.ignored.is_empty() {
        return;
    }
    let kinds: Vec<_> = document.ignored.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
    findings.add(Finding {
        code: Code::ModelIgnored,
        message: format!("forces and geometry of the model are not used by inverse dynamics: {}", kinds.join(", ")),
        count: 1,
    });
}

fn check_joints(document: &OsimModel) -> Result<(), ImportError> {
    let mut names = BTreeSet::new();
    for joint in &document.joints {
        let (name, line) = (joint.name.clone(), joint.line);
        if joint.child.body == "ground" {
            return Err(ImportError::ChildIsGround { joint: name, line });
        }
        let parent = &joint.parent.body;
        if parent != "ground" && !document.bodies.iter().any(|b| b.name == *parent) {
            let known: Vec<_> = document.bodies.iter().map(|b| b.name.as_str()).collect();
            let (parent, known) = (parent.clone(), known.join(", "));
            return Err(ImportError::UnknownParent { joint: name, line, parent, known });
        }
        if let Some(double) = joint.coordinates.iter().find(|c| !names.insert(c.name.as_str())) {
            return Err(ImportError::DuplicateCoordinate { coordinate: double.name.clone(), line: double.line });
        }
    }
    Ok(())
}

/// Each body with its joint, parents first, otherwise in the order of the joints in the document.
fn tree_order(document: &OsimModel) -> Result<Vec<(&OsimBody, &OsimJoint)>, ImportError> {
    let mut joint_of: BTreeMap<&str, &OsimJoint> = BTreeMap::new();
    for joint in &document.joints {
        if let Some(first) = joint_of.insert(&joint.child.body, joint) {
            return Err(ImportError::Loop {
                body: joint.child.body.clone(),
                first: first.name.clone(),
                second: joint.name.clone(),
                line: joint.line,
            });
        }
    }
    let mut children: BTreeMap<&str, Vec<&OsimJoint>> = BTreeMap::new();
    for joint in &document.joints {
        children.entry(&joint.parent.body).or_default().push(joint);
    }
    let body_of = |name: &str| document.bodies.iter().find(|b| b.name == name);
    let mut order = Vec::new();
    let mut waiting: Vec<&OsimJoint> = children.get("ground").cloned().unwrap_or_default();
    waiting.reverse();
    while let Some(joint) = waiting.pop() {
        if let Some(body) = body_of(&joint.child.body) {
            order.push((body, joint));
        }
        waiting.extend(children.get(joint.child.body.as_str()).into_iter().flatten().rev());
    }
    let reached: BTreeSet<&str> = order.iter().map(|(body, _)| body.name.as_str()).collect();
    match document.bodies.iter().find(|b| !reached.contains(b.name.as_str())) {
        Some(body) => Err(ImportError::Unjoined { body: body.name.clone(), line: body.line }),
        None => Ok(order),
    }
}

fn import_inertia(body: &OsimBody, findings: &mut Findings) -> Result<Inertia, ImportError> {
    let [xx, yy, zz, xy, xz, yz] = body.inertia;
    let about_center = Mat3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let inertia = Inertia::new(body.mass_kg, Vec3::from(body.mass_center_m), about_center)
        .map_err(|source| ImportError::Inertia { body: body.name.clone(), line: body.line, source })?;
    if body.mass_kg < f64::MIN_POSITIVE {
        findings.report(Code::ModelMassless, format!("body `{}` (line {}) has no mass", body.name, body.line));
    }
    if let Some(defect) = inertia.defect() {
        let message = format!(
            "body `{}` (line {}) has an inertia that is impossible for a rigid body: {defect}",
            body.name, body.line
        );
        findings.report(Code::ModelInertia, message);
    }
    Ok(inertia)
}

/// Reads a joint and appends its coordinates to `coordinates`.
fn import_joint(
    joint: &OsimJoint,
    bodies: &BTreeMap<&str, BodyId>,
    coordinates: &mut Vec<Coordinate>,
) -> Result<Joint, ImportError> {
    let first = coordinates.len();
    let (rotations, translations, speeds) = import_axes(joint, first)?;
    let imported = Joint {
        name: joint.name.clone(),
        parent: bodies.get(joint.parent.body.as_str()).copied(),
        parent_from_joint: pose(&joint.parent),
        child_from_joint: pose(&joint.child),
        rotations,
        translations,
        speeds,
    };
    for (i, coordinate) in joint.coordinates.iter().enumerate() {
        let kind = coordinate_kind(&imported, CoordinateId(first + i));
        coordinates.push(import_coordinate(joint, coordinate, kind)?);
    }
    Ok(imported)
}

type Axes = (Vec<JointAxis>, Vec<JointAxis>, JointSpeeds);

fn import_axes(joint: &OsimJoint, first: usize) -> Result<Axes, ImportError> {
    let axis = |direction: Vec3, i: usize| JointAxis {
        direction,
        displacement: Displacement::Follows(CoordinateId(first + i), Function::Linear { slope: 1.0, intercept: 0.0 }),
    };
    let (x, y, z) = (Vec3::x(), Vec3::y(), Vec3::z());
    let xyz = |from: usize| vec![axis(x, from), axis(y, from + 1), axis(z, from + 2)];
    let none = Vec::new;
    Ok(match &joint.kind {
        OsimJointKind::Weld => (none(), none(), JointSpeeds::Rates),
        OsimJointKind::Pin => (vec![axis(z, 0)], none(), JointSpeeds::Rates),
        OsimJointKind::Slider => (none(), vec![axis(x, 0)], JointSpeeds::Rates),
        OsimJointKind::Universal => (vec![axis(x, 0), axis(y, 1)], none(), JointSpeeds::Rates),
        OsimJointKind::Gimbal => (xyz(0), none(), JointSpeeds::Rates),
        OsimJointKind::Planar => (vec![axis(z, 0)], vec![axis(x, 1), axis(y, 2)], JointSpeeds::Rates),
        OsimJointKind::Ball => (xyz(0), none(), JointSpeeds::AngularVelocity),
        OsimJointKind::Free => (xyz(0), xyz(3), JointSpeeds::AngularVelocity),
        OsimJointKind::Ellipsoid { radii_m } => (xyz(0), none(), JointSpeeds::Ellipsoid(Vec3::from(*radii_m))),
        OsimJointKind::ConstantCurvature { neutral_angle_rad: [a, b, c], length_m } => {
            let bent = |direction: Vec3, i: usize, intercept: f64| JointAxis {
                direction,
                displacement: Displacement::Follows(
                    CoordinateId(first + i),
                    Function::Linear { slope: 1.0, intercept },
                ),
            };
            (vec![bent(x, 0, *a), bent(z, 1, *b), bent(y, 2, *c)], none(), JointSpeeds::Arc(*length_m))
        }
        // Divided before.
        OsimJointKind::Scapulothoracic { .. } => (none(), none(), JointSpeeds::Rates),
        OsimJointKind::Custom(axes) => {
            let import = |a: &OsimAxis| import_axis(joint, a, first);
            let rotations = axes[..3].iter().map(import).collect::<Result<_, _>>()?;
            let translations = axes[3..].iter().map(import).collect::<Result<_, _>>()?;
            (rotations, translations, JointSpeeds::Rates)
        }
    })
}

fn import_axis(joint: &OsimJoint, axis: &OsimAxis, first: usize) -> Result<JointAxis, ImportError> {
    let direction = Vec3::from(axis.axis);
    let function = import_function(&joint.name, joint.line, &axis.function)?;
    let leader = axis.coordinate.as_ref().and_then(|name| joint.coordinates.iter().position(|c| c.name == *name));
    let displacement = match (function.as_constant(), leader) {
        (Some(value), _) => Displacement::Fixed(value),
        (None, Some(i)) => Displacement::Follows(CoordinateId(first + i), function),
        (None, None) => Displacement::Fixed(function.at(0.0)[0]),
    };
    Ok(JointAxis { direction: direction / direction.norm(), displacement })
}

fn import_function(joint: &str, line: usize, function: &OsimFunction) -> Result<Function, ImportError> {
    let error = |reason: String| ImportError::Function { joint: joint.to_owned(), line, reason };
    osim_function::read(function).map_err(error)
}

/// Rotation or translation if an axis follows the coordinate with slope one, otherwise coupled (OpenSim's rule,
/// `CustomJoint.cpp`); the last such axis decides.
fn coordinate_kind(joint: &Joint, id: CoordinateId) -> CoordinateKind {
    const SLOPE_TOLERANCE: f64 = 1e-12;
    let follows = |axis: &&JointAxis| match &axis.displacement {
        Displacement::Follows(c, f) if *c == id => {
            f.as_linear().is_some_and(|(slope, _)| (slope.abs() - 1.0).abs() < SLOPE_TOLERANCE)
        }
        _ => false,
    };
    if joint.translations.iter().any(|a| follows(&a)) {
        CoordinateKind::Translation
    } else if joint.rotations.iter().any(|a| follows(&a)) {
        CoordinateKind::Rotation
    } else {
        CoordinateKind::Coupled
    }
}

fn import_coordinate(
    joint: &OsimJoint,
    coordinate: &OsimCoordinate,
    kind: CoordinateKind,
) -> Result<Coordinate, ImportError> {
    let drive = match &coordinate.prescribed {
        _ if coordinate.locked => Drive::Locked,
        Some(function) => Drive::Prescribed(import_function(&joint.name, coordinate.line, function)?),
        None => Drive::Free,
    };
    Ok(Coordinate {
        name: coordinate.name.clone(),
        kind,
        default_value: coordinate.default_value,
        range: coordinate.range,
        clamped: coordinate.clamped,
        drive,
    })
}

fn couple(
    constraint: &OsimConstraint,
    coordinates: &mut [Coordinate],
    findings: &mut Findings,
) -> Result<(), ImportError> {
    match constraint {
        OsimConstraint::Off { .. } => Ok(()),
        OsimConstraint::Other { kind, name, line } => {
            let message = format!(
                "the {kind} `{name}` (line {line}) is not enforced: forces through it are reported at the joints of \
                 the tree"
            );
            findings.report(Code::ModelConstraint, message);
            Ok(())
        }
        OsimConstraint::CoordinateCoupler { name, line, independent, dependent, function } => {
            let find = |wanted: &String| {
                coordinates.iter().position(|c| c.name == *wanted).ok_or_else(|| ImportError::UnknownCoordinate {
                    constraint: name.clone(),
                    line: *line,
                    coordinate: wanted.clone(),
                })
            };
            let (leader, follower) = (find(independent)?, find(dependent)?);
            let function = import_function(name, *line, function)?;
            coordinates[follower].drive = Drive::Coupled(CoordinateId(leader), function);
            Ok(())
        }
    }
}
