//! Muscles, motors at coordinates and other actuators of a set of forces.
//!
//! Properties that a document leaves out have OpenSim's defaults (Muscle.cpp, Thelen2003Muscle.cpp,
//! Millard2012EquilibriumMuscle.cpp and the files of its curves, read). Muscles of other types are kept by name and
//! type.

use super::frame::{Frames, socket};
use super::path::{self, OsimPath, OsimWrapObject};
use super::{last_part, members, name_of};
use crate::error::Error;
use crate::xml::{self, LineCounter};
use roxmltree::Node;

/// The muscles of a model, the surfaces over which they wrap, and motors at coordinates.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OsimMuscles {
    /// Muscles in document order, those that are switched off as well.
    pub muscles: Vec<OsimMuscle>,
    /// Wrap objects in document order.
    pub wrap_objects: Vec<OsimWrapObject>,
    /// Motors at coordinates that are switched on, in document order.
    pub actuators: Vec<OsimCoordinateActuator>,
}

/// A muscle.
#[derive(Debug, Clone, PartialEq)]
pub struct OsimMuscle {
    /// Name of the muscle.
    pub name: String,
    /// Line of the element, counted from 1.
    pub line: usize,
    /// Whether the force of the muscle acts.
    pub applies_force: bool,
    /// Type and parameters.
    pub kind: OsimMuscleKind,
}

/// Type of a muscle.
#[derive(Debug, Clone, PartialEq)]
pub enum OsimMuscleKind {
    /// A `Thelen2003Muscle` or a `Millard2012EquilibriumMuscle`.
    Known(Box<OsimMuscleParameters>),
    /// Any other type, by its tag; neither its path nor its parameters are read.
    Other(String),
}

/// Path and parameters of a muscle.
#[derive(Debug, Clone, PartialEq)]
pub struct OsimMuscleParameters {
    /// The path from origin to insertion.
    pub path: OsimPath,
    /// Least and greatest control.
    pub control_range: [f64; 2],
    /// Greatest isometric force [N].
    pub max_isometric_force: f64,
    /// Optimal fibre length [m].
    pub optimal_fiber_length: f64,
    /// Slack length of the tendon [m].
    pub tendon_slack_length: f64,
    /// Pennation angle at the optimal fibre length [rad].
    pub pennation_angle_at_optimal: f64,
    /// Greatest velocity of shortening [optimal fibre lengths a second].
    pub max_contraction_velocity: f64,
    /// Greatest pennation angle [rad].
    pub maximum_pennation_angle: f64,
    /// Whether the tendon is rigid.
    pub ignore_tendon_compliance: bool,
    /// Parameters of the curves.
    pub curves: OsimMuscleCurves,
}

/// Parameters of the curves of a muscle, in the order of the properties of OpenSim.
#[derive(Debug, Clone, PartialEq)]
pub enum OsimMuscleCurves {
    /// `FmaxTendonStrain`, `FmaxMuscleStrain`, `KshapeActive`, `KshapePassive`, `Af`, `Flen`,
    /// `fv_linear_extrap_threshold`.
    Thelen2003([f64; 7]),
    /// The four curves of a `Millard2012EquilibriumMuscle` and its damping.
    Millard2012 {
        /// `ActiveForceLengthCurve`.
        active_force_length: [f64; 5],
        /// `ForceVelocityCurve`.
        force_velocity: [f64; 8],
        /// `FiberForceLengthCurve`; `None` where a property is computed from others.
        fiber_force_length: [Option<f64>; 5],
        /// `TendonForceLengthCurve`; `None` where a property is computed from others.
        tendon_force_length: [Option<f64>; 4],
        /// `fiber_damping`.
        fiber_damping: f64,
    },
}

/// A `CoordinateActuator`: a motor at one coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct OsimCoordinateActuator {
    /// Name of the actuator.
    pub name: String,
    /// Line of the element, counted from 1.
    pub line: usize,
    /// Name of the coordinate.
    pub coordinate: String,
    /// Generalised force at control 1 [N.m or N].
    pub optimal_force: f64,
    /// Least and greatest control; infinite if the document states none.
    pub control_range: [f64; 2],
}

pub(super) const THELEN: &str = "Thelen2003Muscle";
pub(super) const MILLARD: &str = "Millard2012EquilibriumMuscle";
pub(super) const ACTUATOR: &str = "CoordinateActuator";

/// Properties of a Thelen muscle with their defaults.
pub(super) const THELEN_SHAPE: [(&str, f64); 7] = [
    ("FmaxTendonStrain", 0.04),
    ("FmaxMuscleStrain", 0.6),
    ("KshapeActive", 0.45),
    ("KshapePassive", 5.0),
    ("Af", 0.25),
    ("Flen", 1.4),
    ("fv_linear_extrap_threshold", 0.95),
];
pub(super) const ACTIVE_CURVE: &str = "ActiveForceLengthCurve";
/// Properties of the active curve with their defaults; the first is the length at which the force begins, less the
/// width of its corner.
pub(super) const ACTIVE_FORCE_LENGTH: [(&str, f64); 5] = [
    ("min_norm_active_fiber_length", 0.47 - 0.0259),
    ("transition_norm_fiber_length", 0.73),
    ("max_norm_active_fiber_length", 1.8123),
    ("shallow_ascending_slope", 0.8616),
    ("minimum_value", 0.1),
];
pub(super) const VELOCITY_CURVE: &str = "ForceVelocityCurve";
pub(super) const FORCE_VELOCITY: [(&str, f64); 8] = [
    ("concentric_slope_at_vmax", 0.0),
    ("concentric_slope_near_vmax", 0.25),
    ("isometric_slope", 5.0),
    ("eccentric_slope_at_vmax", 0.0),
    ("eccentric_slope_near_vmax", 0.15),
    ("max_eccentric_velocity_force_multiplier", 1.4),
    ("concentric_curviness", 0.6),
    ("eccentric_curviness", 0.9),
];
pub(super) const FIBER_CURVE: &str = "FiberForceLengthCurve";
pub(super) const FIBER_FORCE_LENGTH: [(&str, Option<f64>); 5] = [
    ("strain_at_zero_force", Some(0.0)),
    ("strain_at_one_norm_force", Some(0.7)),
    ("stiffness_at_low_force", None),
    ("stiffness_at_one_norm_force", None),
    ("curviness", None),
];
pub(super) const TENDON_CURVE: &str = "TendonForceLengthCurve";
pub(super) const TENDON_FORCE_LENGTH: [(&str, Option<f64>); 4] = [
    ("strain_at_one_norm_force", Some(0.049)),
    ("stiffness_at_one_norm_force", None),
    ("norm_force_at_toe_end", None),
    ("curviness", None),
];
/// Default of `maximum_pennation_angle` [rad]: its cosine is 0.1.
const STEEPEST_PENNATION: f64 = 1.470_628_905_633_336_8;
/// Default least control of both types: the default of `minimum_activation`.
const LEAST_CONTROL: f64 = 0.01;

/// The muscles of a model with all that belongs to them.
pub(super) fn of_model(model: Node<'_, '_>, frames: &Frames<'_>) -> Result<OsimMuscles, Error> {
    let lines = &mut LineCounter::new(model.document().input_text());
    let forces = || ["ForceSet", "ComponentSet"].into_iter().flat_map(|set| members(model, set));
    let muscles = forces().filter(|node| is_muscle(node.tag_name().name()));
    Ok(OsimMuscles {
        wrap_objects: path::wrap_objects(model, frames, lines)?,
        muscles: muscles.map(|node| read(node, frames, lines)).collect::<Result<_, _>>()?,
        actuators: actuators(forces(), lines)?,
    })
}

/// The motors at coordinates that are switched on.
pub(super) fn actuators<'a, 'i: 'a>(
    forces: impl Iterator<Item = Node<'a, 'i>>,
    lines: &mut LineCounter<'_>,
) -> Result<Vec<OsimCoordinateActuator>, Error> {
    let mut actuators = Vec::new();
    for node in forces.filter(|node| node.has_tag_name(ACTUATOR)) {
        if applies_force(node)? {
            actuators.push(read_actuator(node, lines.line_of(node))?);
        }
    }
    Ok(actuators)
}

/// Whether this is the tag of a muscle whose path and parameters are read, or of a motor at a coordinate.
pub(super) fn is_read(tag: &str) -> bool {
    matches!(tag, THELEN | MILLARD | ACTUATOR)
}

fn is_muscle(tag: &str) -> bool {
    tag.contains("Muscle")
}

fn applies_force(node: Node<'_, '_>) -> Result<bool, Error> {
    let is_disabled = xml::boolean(node, "isDisabled")?.unwrap_or(false);
    Ok(!is_disabled && xml::boolean(node, "appliesForce")?.unwrap_or(true))
}

fn read(node: Node<'_, '_>, frames: &Frames<'_>, lines: &mut LineCounter<'_>) -> Result<OsimMuscle, Error> {
    let kind = match node.tag_name().name() {
        THELEN | MILLARD => OsimMuscleKind::Known(Box::new(parameters(node, frames)?)),
        other => OsimMuscleKind::Other(other.to_owned()),
    };
    Ok(OsimMuscle {
        name: name_of(node).to_owned(),
        line: lines.line_of(node),
        applies_force: applies_force(node)?,
        kind,
    })
}

fn parameters(node: Node<'_, '_>, frames: &Frames<'_>) -> Result<OsimMuscleParameters, Error> {
    let number = |tag: &str, default: f64| Ok::<f64, Error>(xml::number(node, tag)?.unwrap_or(default));
    let curves = match node.has_tag_name(THELEN) {
        true => OsimMuscleCurves::Thelen2003(stated(Some(node), &THELEN_SHAPE)?),
        false => millard_curves(node)?,
    };
    Ok(OsimMuscleParameters {
        path: path::read(node, frames)?,
        control_range: control_range(node, [LEAST_CONTROL, 1.0])?,
        max_isometric_force: number("max_isometric_force", 1000.0)?,
        optimal_fiber_length: number("optimal_fiber_length", 0.1)?,
        tendon_slack_length: number("tendon_slack_length", 0.2)?,
        pennation_angle_at_optimal: number("pennation_angle_at_optimal", 0.0)?,
        max_contraction_velocity: number("max_contraction_velocity", 10.0)?,
        maximum_pennation_angle: number("maximum_pennation_angle", STEEPEST_PENNATION)?,
        ignore_tendon_compliance: xml::boolean(node, "ignore_tendon_compliance")?.unwrap_or(false),
        curves,
    })
}

fn millard_curves(node: Node<'_, '_>) -> Result<OsimMuscleCurves, Error> {
    let curve = |tag: &str| xml::child(node, tag);
    Ok(OsimMuscleCurves::Millard2012 {
        active_force_length: stated(curve(ACTIVE_CURVE), &ACTIVE_FORCE_LENGTH)?,
        force_velocity: stated(curve(VELOCITY_CURVE), &FORCE_VELOCITY)?,
        fiber_force_length: stated_or_computed(curve(FIBER_CURVE), &FIBER_FORCE_LENGTH)?,
        tendon_force_length: stated_or_computed(curve(TENDON_CURVE), &TENDON_FORCE_LENGTH)?,
        fiber_damping: xml::number(node, "fiber_damping")?.unwrap_or(0.1),
    })
}

/// The values of properties, or their defaults.
fn stated<const N: usize>(node: Option<Node<'_, '_>>, properties: &[(&str, f64); N]) -> Result<[f64; N], Error> {
    let mut values = properties.map(|(_, default)| default);
    for (value, (tag, _)) in values.iter_mut().zip(properties) {
        *value = node.map_or(Ok(None), |node| xml::number(node, tag))?.unwrap_or(*value);
    }
    Ok(values)
}

fn stated_or_computed<const N: usize>(
    node: Option<Node<'_, '_>>,
    properties: &[(&str, Option<f64>); N],
) -> Result<[Option<f64>; N], Error> {
    let mut values = properties.map(|(_, default)| default);
    for (value, (tag, _)) in values.iter_mut().zip(properties) {
        *value = node.map_or(Ok(None), |node| xml::number(node, tag))?.or(*value);
    }
    Ok(values)
}

fn read_actuator(node: Node<'_, '_>, line: usize) -> Result<OsimCoordinateActuator, Error> {
    let coordinate = xml::text(node, "coordinate").or_else(|| socket(node, "coordinate")).ok_or_else(|| {
        xml::error_at(node, "no <coordinate>".into(), "the name of the coordinate that the actuator drives")
    })?;
    Ok(OsimCoordinateActuator {
        name: name_of(node).to_owned(),
        line,
        coordinate: last_part(coordinate).to_owned(),
        optimal_force: xml::number(node, "optimal_force")?.unwrap_or(1.0),
        control_range: control_range(node, [f64::NEG_INFINITY, f64::INFINITY])?,
    })
}

/// `<min_control>` and `<max_control>`, which OpenSim also writes as `-Inf` and `Inf`.
fn control_range(node: Node<'_, '_>, default: [f64; 2]) -> Result<[f64; 2], Error> {
    let bound = |tag: &str, default: f64| match xml::text(node, tag) {
        Some(text) if text.eq_ignore_ascii_case("-inf") => Ok(f64::NEG_INFINITY),
        Some(text) if text.eq_ignore_ascii_case("inf") => Ok(f64::INFINITY),
        _ => Ok::<f64, Error>(xml::number(node, tag)?.unwrap_or(default)),
    };
    let range = [bound("min_control", default[0])?, bound("max_control", default[1])?];
    if range[0] > range[1] {
        let found = format!("controls from {} to {}", range[0], range[1]);
        return Err(xml::error_at(node, found, "a <min_control> that is not above <max_control>"));
    }
    Ok(range)
}
