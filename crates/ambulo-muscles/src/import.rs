//! The muscles of an OpenSim document as a [`MuscleSet`] of the model made from it.
//!
//! Left out, each with a finding that names the muscles: types other than Thelen2003Muscle and
//! Millard2012EquilibriumMuscle, muscles that wrap over ellipsoids or tori, muscles that are switched off, muscles
//! without strength, and muscles that cross no joint with coordinates.

use crate::path::PathWorkspace;
use crate::set::{
    CoordinateActuator, MillardCurves, Muscle, MuscleCurves, MuscleParameters, MusclePath, MuscleSet, PathPoint,
    PathWrap, PointPlace, Quadrant, ThelenCurves, WrapMethod, WrapObject, WrapShape,
};
use crate::wrap::{Contact, WrapRule};
use ambulo_body::findings::{Code, Findings};
use ambulo_body::kinematics::Posture;
use ambulo_body::model::osim_frame::pose;
use ambulo_body::model::{BodyId, CoordinateId, Drive, Model, osim_function};
use ambulo_body::spatial::Vec3;
use ambulo_formats::osim::{
    OsimCoordinateActuator, OsimModel, OsimMuscle, OsimMuscleCurves, OsimMuscleKind, OsimMuscleParameters, OsimMuscles,
    OsimPath, OsimPathPoint, OsimPathWrap, OsimPointPlace, OsimWrapObject, OsimWrapShape,
};
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

/// Why the muscles of a document cannot be used with a model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MuscleError {
    /// Elements of the document that are not valid.
    #[error(transparent)]
    File(#[from] ambulo_formats::Error),
    /// A document without a muscle that can be used.
    #[error(
        "the model `{model}` has {found}; expected at least one Thelen2003Muscle or Millard2012EquilibriumMuscle that \
         is switched on. hint: export the model with its ForceSet"
    )]
    NoMuscles {
        /// The model.
        model: String,
        /// What the document has.
        found: String,
    },
    /// A body, a coordinate or a wrap object that the model does not have.
    #[error("{owner} (line {line}) names the {what} `{name}`, which the model does not have")]
    Unknown {
        /// The muscle or motor.
        owner: String,
        /// Its line.
        line: usize,
        /// `body`, `coordinate` or `wrap object`.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// A function that is not valid.
    #[error("muscle `{muscle}` (line {line}), point `{point}`: {reason}")]
    Function {
        /// The muscle.
        muscle: String,
        /// Its line.
        line: usize,
        /// The point.
        point: String,
        /// The reason.
        reason: String,
    },
    /// A parameter outside its possible values.
    #[error("muscle `{muscle}` (line {line}) has {parameter} {found}; expected {expected}")]
    Parameter {
        /// The muscle.
        muscle: String,
        /// Its line.
        line: usize,
        /// The parameter, as in the document.
        parameter: &'static str,
        /// Found value.
        found: f64,
        /// Possible values.
        expected: &'static str,
    },
    /// Factors that do not fit the model.
    #[error("found factors for {found} bodies; expected {expected}, one per body of the model")]
    Factors {
        /// Number of factors.
        found: usize,
        /// Number of bodies.
        expected: usize,
    },
}

/// OpenSim treats a smaller damping of a Millard muscle as none (`MIN_NONZERO_DAMPING_COEFFICIENT`).
const LEAST_DAMPING: f64 = 0.001;
/// Least value of the active curve of a muscle without damping.
const LEAST_ACTIVE_VALUE: f64 = 0.1;

impl MuscleSet {
    /// The muscles, wrap objects and motors of a document for the model made from it. Muscles that are left out are
    /// reported.
    ///
    /// # Errors
    /// A document without a muscle that can be used, elements that are not valid, names that the model does not have,
    /// parameters that no muscle can have: see [`MuscleError`].
    pub fn of_document(document: &OsimModel, model: &Model, findings: &mut Findings) -> Result<MuscleSet, MuscleError> {
        let muscles = document.muscles.as_ref().map_err(Clone::clone)?;
        let names = Names::new(model, muscles);
        let mut left_out = LeftOut::default();
        let mut set = MuscleSet { wraps: wraps(muscles, &names)?, ..MuscleSet::default() };
        for muscle in &muscles.muscles {
            if let Some(read) = names.muscle(muscle, &mut left_out)? {
                set.muscles.push(read);
            }
        }
        set.actuators = muscles.actuators.iter().map(|a| names.actuator(a)).collect::<Result<_, _>>()?;
        let paths = PathWorkspace::new(model, &set, WrapRule::Exact);
        let moves: Vec<bool> = (0..set.muscles.len()).map(|i| !paths.coordinates(i).is_empty()).collect();
        for (muscle, _) in set.muscles.iter().zip(&moves).filter(|(_, moves)| !**moves) {
            left_out.add(Code::MusclesNoJoint, "path crosses no joint that moves", &muscle.name);
        }
        let mut keep = moves.into_iter();
        set.muscles.retain(|_| keep.next().unwrap_or(true));
        left_out.report(findings);
        if set.muscles.is_empty() {
            let found = match muscles.muscles.len() {
                0 => "no muscles".to_owned(),
                count => format!("{count} muscles, none of which can be used"),
            };
            return Err(MuscleError::NoMuscles { model: document.name.clone(), found });
        }
        report_points_inside(model, &set, findings);
        Ok(set)
    }

    /// Motors at coordinates from a separate document, such as reserve actuators.
    ///
    /// # Errors
    /// A coordinate that the model does not have.
    pub fn actuators_of(
        actuators: &[OsimCoordinateActuator],
        model: &Model,
    ) -> Result<Vec<CoordinateActuator>, MuscleError> {
        let nothing = OsimMuscles::default();
        let names = Names::new(model, &nothing);
        actuators.iter().map(|actuator| names.actuator(actuator)).collect()
    }
}

/// The values of all coordinates in the default posture; couplers are obeyed.
pub(crate) fn default_coordinates(model: &Model) -> Vec<f64> {
    let mut q: Vec<f64> = model.coordinates().iter().map(|c| c.default_value).collect();
    for (i, coordinate) in model.coordinates().iter().enumerate() {
        if let Drive::Coupled(leader, function) = &coordinate.drive {
            q[i] = function.at(q[leader.index()])[0];
        }
    }
    q
}

fn report_points_inside(model: &Model, set: &MuscleSet, findings: &mut Findings) {
    let mut paths = PathWorkspace::new(model, set, WrapRule::Exact);
    let q = default_coordinates(model);
    let rest = vec![0.0; q.len()];
    paths.update(Posture { q: &q, qd: &rest, qdd: &rest });
    for (i, muscle) in set.muscles.iter().enumerate() {
        for (wrap, contact) in muscle.path.wraps.iter().zip(paths.contacts(i)) {
            if *contact == Contact::EndInside {
                let message = format!(
                    "in the default posture of the model the path of `{}` has an end inside the surface `{}`; it runs \
                     straight there",
                    muscle.name, set.wraps[wrap.object].name
                );
                findings.report(Code::MusclesInsideWrap, message);
            }
        }
    }
}

/// Names of muscles that are left out, by the reason.
#[derive(Debug, Default)]
struct LeftOut {
    names: BTreeMap<(Code, String), Vec<String>>,
}

impl LeftOut {
    fn add(&mut self, code: Code, reason: impl Into<String>, name: &str) {
        self.names.entry((code, reason.into())).or_default().push(name.to_owned());
    }

    fn report(self, findings: &mut Findings) {
        for ((code, reason), names) in self.names {
            let message = match &names[..] {
                [one] => format!("1 muscle is left out ({reason}): {one}"),
                many => format!("{} muscles are left out ({reason}): {}", many.len(), many.join(", ")),
            };
            findings.report(code, message);
        }
    }
}

/// What a name in the document means in the model.
struct Names<'a> {
    bodies: BTreeMap<&'a str, BodyId>,
    coordinates: BTreeMap<&'a str, CoordinateId>,
    /// Index in [`MuscleSet::wraps`], or the tag of a shape that is not supported. Of surfaces with the same name the
    /// first counts, as in OpenSim.
    wraps: BTreeMap<&'a str, Result<usize, &'a str>>,
}

/// Which muscle is read, for messages.
#[derive(Clone, Copy)]
struct Owner<'a> {
    name: &'a str,
    line: usize,
}

impl Owner<'_> {
    fn unknown(self, what: &'static str, name: &str) -> MuscleError {
        let owner = format!("muscle `{}`", self.name);
        MuscleError::Unknown { owner, line: self.line, what, name: name.to_owned() }
    }
}

impl<'a> Names<'a> {
    fn new(model: &'a Model, muscles: &'a OsimMuscles) -> Names<'a> {
        let mut wraps = BTreeMap::new();
        let mut supported = 0;
        for object in &muscles.wrap_objects {
            let meaning = match &object.shape {
                OsimWrapShape::Other(kind) => Err(kind.as_str()),
                _ => {
                    supported += 1;
                    Ok(supported - 1)
                }
            };
            wraps.entry(object.name.as_str()).or_insert(meaning);
        }
        Names {
            bodies: model.body_ids().map(|id| (model.bodies()[id.index()].name.as_str(), id)).collect(),
            coordinates: model.coordinate_ids().map(|id| (model.coordinates()[id.index()].name.as_str(), id)).collect(),
            wraps,
        }
    }

    fn body(&self, name: &str) -> Option<Option<BodyId>> {
        if name == "ground" { Some(None) } else { self.bodies.get(name).copied().map(Some) }
    }

    /// The muscle, or `None` if it is left out.
    fn muscle(&self, muscle: &OsimMuscle, left_out: &mut LeftOut) -> Result<Option<Muscle>, MuscleError> {
        let OsimMuscle { name, line, .. } = muscle;
        if !muscle.applies_force {
            left_out.add(Code::MusclesOff, "switched off in the model", name);
            return Ok(None);
        }
        let parameters = match &muscle.kind {
            OsimMuscleKind::Known(parameters) => parameters,
            OsimMuscleKind::Other(kind) => {
                left_out.add(Code::MusclesUnsupported, format!("the type {kind} is not supported"), name);
                return Ok(None);
            }
        };
        let owner = Owner { name, line: *line };
        for wrap in &parameters.path.wraps {
            if let Err(kind) =
                self.wraps.get(wrap.object.as_str()).ok_or_else(|| owner.unknown("wrap object", &wrap.object))?
            {
                let reason = format!("path over the {kind} `{}`, which is not supported", wrap.object);
                left_out.add(Code::MusclesUnsupported, reason, name);
                return Ok(None);
            }
        }
        check(owner, parameters)?;
        if parameters.max_isometric_force < f64::MIN_POSITIVE {
            left_out.add(Code::MusclesNoStrength, "greatest isometric force of zero", name);
            return Ok(None);
        }
        let path = self.path(owner, &parameters.path)?;
        Ok(Some(Muscle { name: name.clone(), path, parameters: import_parameters(parameters) }))
    }

    fn path(&self, owner: Owner<'_>, path: &OsimPath) -> Result<MusclePath, MuscleError> {
        Ok(MusclePath {
            points: path.points.iter().filter_map(|p| self.point(owner, p).transpose()).collect::<Result<_, _>>()?,
            wraps: path.wraps.iter().filter_map(|wrap| self.path_wrap(wrap)).collect(),
        })
    }

    fn path_wrap(&self, wrap: &OsimPathWrap) -> Option<PathWrap> {
        let index = |place: i32| usize::try_from(place - 1).ok();
        Some(PathWrap {
            object: self.wraps.get(wrap.object.as_str()).copied()?.ok()?,
            first: index(wrap.range[0]),
            last: index(wrap.range[1]),
            method: match wrap.method.as_str() {
                "midpoint" => WrapMethod::Midpoint,
                "axial" => WrapMethod::Axial,
                _ => WrapMethod::Hybrid,
            },
        })
    }

    /// A point of a path; `None` if it is never part of it.
    fn point(&self, owner: Owner<'_>, point: &OsimPathPoint) -> Result<Option<PathPoint>, MuscleError> {
        let coordinate = |name: &String| {
            self.coordinates.get(name.as_str()).copied().ok_or_else(|| owner.unknown("coordinate", name))
        };
        let frame = pose(&point.frame);
        let place = match &point.place {
            OsimPointPlace::Fixed(location) => PointPlace::Fixed(frame.place(Vec3::from(*location))),
            OsimPointPlace::Conditional { coordinate: None, .. } => return Ok(None),
            OsimPointPlace::Conditional { location_m, coordinate: Some(name), range } => PointPlace::Conditional {
                place: frame.place(Vec3::from(*location_m)),
                coordinate: coordinate(name)?,
                range: *range,
            },
            OsimPointPlace::Moving(axes) => {
                let invalid = |reason: String| MuscleError::Function {
                    muscle: owner.name.to_owned(),
                    line: owner.line,
                    point: point.name.clone(),
                    reason,
                };
                let [x, y, z] = axes.each_ref().map(|(name, function)| {
                    let function = osim_function::read(function).map_err(invalid)?;
                    Ok::<_, MuscleError>((name.as_ref().map(coordinate).transpose()?, function))
                });
                PointPlace::Moving { frame, axes: Box::new([x?, y?, z?]) }
            }
        };
        let body = self.body(&point.frame.body).ok_or_else(|| owner.unknown("body", &point.frame.body))?;
        Ok(Some(PathPoint { name: point.name.clone(), body, place }))
    }

    fn actuator(&self, actuator: &OsimCoordinateActuator) -> Result<CoordinateActuator, MuscleError> {
        let coordinate = self.coordinates.get(actuator.coordinate.as_str()).copied();
        Ok(CoordinateActuator {
            name: actuator.name.clone(),
            coordinate: coordinate.ok_or_else(|| MuscleError::Unknown {
                owner: format!("the actuator `{}`", actuator.name),
                line: actuator.line,
                what: "coordinate",
                name: actuator.coordinate.clone(),
            })?,
            optimal_force: actuator.optimal_force,
            control_range: actuator.control_range,
        })
    }
}

fn wraps(muscles: &OsimMuscles, names: &Names<'_>) -> Result<Vec<WrapObject>, MuscleError> {
    let mut wraps = Vec::new();
    for object in &muscles.wrap_objects {
        let shape = match object.shape {
            OsimWrapShape::Cylinder { radius, length } => WrapShape::Cylinder { radius, length },
            OsimWrapShape::Sphere { radius } => WrapShape::Sphere { radius },
            OsimWrapShape::Other(_) => continue,
        };
        let body = names.body(&object.frame.body).ok_or_else(|| MuscleError::Unknown {
            owner: format!("the wrap object `{}`", object.name),
            line: object.line,
            what: "body",
            name: object.frame.body.clone(),
        })?;
        let OsimWrapObject { name, active, .. } = object.clone();
        wraps.push(WrapObject { name, body, pose: pose(&object.frame), shape, quadrant: quadrant(object), active });
    }
    Ok(wraps)
}

fn quadrant(object: &OsimWrapObject) -> Option<Quadrant> {
    let axis = ["x", "y", "z"].into_iter().position(|axis| object.quadrant.ends_with(axis))?;
    Some(Quadrant { axis, positive: !object.quadrant.starts_with('-') })
}

/// Checks that the parameters are possible.
fn check(owner: Owner<'_>, muscle: &OsimMuscleParameters) -> Result<(), MuscleError> {
    let positive = "a number above zero";
    let force = muscle.max_isometric_force;
    let listed = [
        ("max_isometric_force", force, force >= 0.0, "zero or more, in newtons"),
        ("optimal_fiber_length", muscle.optimal_fiber_length, muscle.optimal_fiber_length > 0.0, "a length above zero"),
        ("tendon_slack_length", muscle.tendon_slack_length, muscle.tendon_slack_length >= 0.0, "zero or more"),
        ("max_contraction_velocity", muscle.max_contraction_velocity, muscle.max_contraction_velocity > 0.0, positive),
        (
            "pennation_angle_at_optimal",
            muscle.pennation_angle_at_optimal,
            (0.0..FRAC_PI_2).contains(&muscle.pennation_angle_at_optimal),
            "an angle from 0 to below pi/2, in radians",
        ),
        (
            "maximum_pennation_angle",
            muscle.maximum_pennation_angle,
            (0.0..FRAC_PI_2).contains(&muscle.maximum_pennation_angle),
            "an angle from 0 to below pi/2, in radians",
        ),
    ];
    match listed.into_iter().find(|(_, _, is_possible, _)| !is_possible) {
        None => Ok(()),
        Some((parameter, found, _, expected)) => {
            Err(MuscleError::Parameter { muscle: owner.name.to_owned(), line: owner.line, parameter, found, expected })
        }
    }
}

fn import_parameters(muscle: &OsimMuscleParameters) -> MuscleParameters {
    let curves = match &muscle.curves {
        OsimMuscleCurves::Thelen2003([tendon, fiber, active, passive, velocity, lengthening, straight_from]) => {
            MuscleCurves::Thelen2003(ThelenCurves {
                tendon_strain_at_max: *tendon,
                fiber_strain_at_max: *fiber,
                active_shape: *active,
                passive_shape: *passive,
                velocity_shape: *velocity,
                lengthening_force: *lengthening,
                straight_from: *straight_from,
            })
        }
        OsimMuscleCurves::Millard2012 {
            active_force_length,
            force_velocity,
            fiber_force_length,
            tendon_force_length,
            fiber_damping,
        } => {
            let curves = MillardCurves {
                active: *active_force_length,
                velocity: *force_velocity,
                passive: *fiber_force_length,
                tendon: *tendon_force_length,
                fiber_damping: *fiber_damping,
            };
            MuscleCurves::Millard2012(in_use(curves, muscle.ignore_tendon_compliance))
        }
    };
    MuscleParameters {
        max_isometric_force: muscle.max_isometric_force,
        optimal_fiber_length: muscle.optimal_fiber_length,
        tendon_slack_length: muscle.tendon_slack_length,
        pennation_at_optimal: muscle.pennation_angle_at_optimal,
        max_contraction_velocity: muscle.max_contraction_velocity,
        max_pennation: muscle.maximum_pennation_angle,
        rigid_tendon: muscle.ignore_tendon_compliance,
        activation_range: muscle.control_range,
        curves,
    }
}

/// The curves that OpenSim uses for the stated ones (Millard2012EquilibriumMuscle.cpp, `extendFinalizeFromProperties`,
/// read): an elastic tendon without damping needs forces above zero and slopes that can be inverted.
fn in_use(mut curves: MillardCurves, rigid_tendon: bool) -> MillardCurves {
    let [at_shortening, near_shortening, _, at_lengthening, near_lengthening, ..] = curves.velocity;
    if curves.fiber_damping < LEAST_DAMPING {
        curves.fiber_damping = 0.0;
    }
    if curves.fiber_damping > 0.0 || rigid_tendon {
        curves.active[4] = curves.active[4].min(0.0);
        curves.velocity[0] = at_shortening.min(0.0);
        curves.velocity[3] = at_lengthening.min(0.0);
    } else {
        curves.active[4] = curves.active[4].max(LEAST_ACTIVE_VALUE);
        curves.velocity[0] = at_shortening.max(near_shortening * 0.5);
        curves.velocity[3] = at_lengthening.max(near_lengthening * 0.5);
    }
    curves
}
