//! The set-up of scaling.

use super::elements::{Known, applies, members, path, remark_on_others, time_range};
use super::tasks::{self, FitTasks};
use crate::error::{Error, Remark, quoted};
use crate::xml;
use roxmltree::Node;

pub(super) const TOOL: &str = "ScaleTool";

/// Scaling of a model to a person.
#[derive(Debug, Clone, PartialEq)]
pub struct ScaleSetup {
    /// Body mass [kg]; `None` if it is not stated.
    pub mass_kg: Option<f64>,
    /// The model before scaling.
    pub model_file: Option<String>,
    /// Markers for the model.
    pub marker_set_file: Option<String>,
    /// How bodies are scaled; `None` if that is switched off.
    pub scaler: Option<ScalerSetup>,
    /// How markers are moved; `None` if that is switched off.
    pub placer: Option<PlacerSetup>,
}

/// How bodies are scaled.
#[derive(Debug, Clone, PartialEq)]
pub struct ScalerSetup {
    /// The methods in their order; a later one replaces the factors of an earlier one.
    pub order: Vec<ScalingMethod>,
    /// Measurements that are switched on.
    pub measurements: Vec<Measurement>,
    /// Stated factors that are switched on.
    pub manual: Vec<ManualScale>,
    /// Recorded markers in which distances are measured.
    pub marker_file: Option<String>,
    /// Start and end of the frames whose distances are averaged [s].
    pub time_range: Option<[f64; 2]>,
    /// Whether every body keeps its share of the body mass; otherwise its mass grows with its volume.
    pub preserve_mass_distribution: bool,
}

/// A method of scaling.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScalingMethod {
    /// Distances between markers.
    Measurements,
    /// Stated factors.
    Manual,
}

/// A factor from distances between markers.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// Name of the measurement.
    pub name: String,
    /// Pairs of markers.
    pub pairs: Vec<[String; 2]>,
    /// The bodies that are scaled.
    pub bodies: Vec<MeasuredSegment>,
}

/// The axes of a body that a measurement scales.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredSegment {
    /// Name of the body.
    pub body: String,
    /// Whether x, y and z of its frame are scaled.
    pub axes: [bool; 3],
}

/// Stated factors of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct ManualScale {
    /// Name of the body.
    pub body: String,
    /// Factors along x, y and z of its frame.
    pub factors: [f64; 3],
}

/// How markers are moved to their places on the person.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacerSetup {
    /// Weights of the fit of the standing posture.
    pub tasks: FitTasks,
    /// The standing trial.
    pub marker_file: Option<String>,
    /// Coordinates that tasks follow.
    pub coordinate_file: Option<String>,
    /// Start and end of the frames whose positions are averaged [s].
    pub time_range: Option<[f64; 2]>,
}

const KNOWN: Known<'_> = Known {
    read: &["mass", "GenericModelMaker", "ModelScaler", "MarkerPlacer"],
    unused: &["height", "age", "notes", "defaults"],
};
const KNOWN_TO_MAKER: Known<'_> = Known { read: &["model_file", "marker_set_file"], unused: &[] };
const KNOWN_TO_SCALER: Known<'_> = Known {
    read: &[
        "apply",
        "scaling_order",
        "MeasurementSet",
        "ScaleSet",
        "marker_file",
        "time_range",
        "preserve_mass_distribution",
    ],
    unused: &["output_model_file", "output_scale_file", "output_joint_file", "output_muscle_file"],
};
const KNOWN_TO_PLACER: Known<'_> = Known {
    read: &["apply", "IKTaskSet", "marker_file", "coordinate_file", "time_range"],
    unused: &[
        "output_model_file",
        "output_motion_file",
        "output_marker_file",
        "output_joint_file",
        "output_muscle_file",
        "max_marker_movement",
        "optimizer_algorithm",
    ],
};

pub(super) fn read(node: Node<'_, '_>, remarks: &mut Vec<Remark>) -> Result<ScaleSetup, Error> {
    remark_on_others(node, &KNOWN, remarks);
    let maker = xml::child(node, "GenericModelMaker");
    if let Some(maker) = maker {
        remark_on_others(maker, &KNOWN_TO_MAKER, remarks);
    }
    let part = |tag: &str| match xml::child(node, tag) {
        Some(part) if applies(part)? => Ok::<_, Error>(Some(part)),
        _ => Ok(None),
    };
    Ok(ScaleSetup {
        mass_kg: xml::number(node, "mass")?.filter(|kg| *kg > 0.0),
        model_file: maker.and_then(|maker| path(maker, "model_file")),
        marker_set_file: maker.and_then(|maker| path(maker, "marker_set_file")),
        scaler: part("ModelScaler")?.map(|part| read_scaler(part, remarks)).transpose()?,
        placer: part("MarkerPlacer")?.map(|part| read_placer(part, remarks)).transpose()?,
    })
}

fn read_scaler(node: Node<'_, '_>, remarks: &mut Vec<Remark>) -> Result<ScalerSetup, Error> {
    remark_on_others(node, &KNOWN_TO_SCALER, remarks);
    let mut measurements = Vec::new();
    for member in members(node, "MeasurementSet")? {
        if applies(member)? {
            measurements.push(read_measurement(member)?);
        }
    }
    let mut manual = Vec::new();
    for member in members(node, "ScaleSet")? {
        if applies(member)? {
            manual.push(read_manual(member)?);
        }
    }
    Ok(ScalerSetup {
        order: read_order(node)?,
        measurements,
        manual,
        marker_file: path(node, "marker_file"),
        time_range: time_range(node)?,
        preserve_mass_distribution: xml::boolean(node, "preserve_mass_distribution")?.unwrap_or(false),
    })
}

fn read_order(node: Node<'_, '_>) -> Result<Vec<ScalingMethod>, Error> {
    let words = xml::text(node, "scaling_order").unwrap_or_default().split_whitespace();
    words
        .map(|word| match word {
            "measurements" => Ok(ScalingMethod::Measurements),
            "manualScale" => Ok(ScalingMethod::Manual),
            other => {
                let at = xml::child(node, "scaling_order").unwrap_or(node);
                Err(xml::error_at(at, quoted(other), "`measurements`, `manualScale` or both"))
            }
        })
        .collect()
}

fn read_measurement(node: Node<'_, '_>) -> Result<Measurement, Error> {
    let mut pairs = Vec::new();
    for pair in members(node, "MarkerPairSet")? {
        let names: Vec<&str> = xml::text(pair, "markers").unwrap_or_default().split_whitespace().collect();
        let [a, b] = names[..] else {
            let found = format!("{} names in <markers>", names.len());
            return Err(xml::error_at(pair, found, "the names of two markers, without spaces in them"));
        };
        pairs.push([a.to_owned(), b.to_owned()]);
    }
    let mut bodies = Vec::new();
    for body in members(node, "BodyScaleSet")? {
        bodies.push(MeasuredSegment { body: name_of(body), axes: read_axes(body)? });
    }
    Ok(Measurement { name: name_of(node), pairs, bodies })
}

fn read_axes(body: Node<'_, '_>) -> Result<[bool; 3], Error> {
    let mut axes = [false; 3];
    for word in xml::text(body, "axes").unwrap_or_default().split_whitespace() {
        match ["x", "y", "z"].iter().position(|axis| axis.eq_ignore_ascii_case(word)) {
            Some(axis) => axes[axis] = true,
            None => return Err(xml::error_at(body, quoted(word), "the axes X, Y and Z, with spaces between them")),
        }
    }
    Ok(axes)
}

fn read_manual(node: Node<'_, '_>) -> Result<ManualScale, Error> {
    let factors = xml::triple(node, "scales")?;
    let factors = factors.ok_or_else(|| xml::error_at(node, "no <scales>".into(), "factors along x, y and z"))?;
    if let Some(factor) = factors.iter().find(|factor| **factor <= 0.0) {
        return Err(xml::error_at(node, format!("the factor {factor}"), "factors above zero"));
    }
    let body = xml::text(node, "segment").map_or_else(|| name_of(node), str::to_owned);
    Ok(ManualScale { body, factors })
}

fn read_placer(node: Node<'_, '_>, remarks: &mut Vec<Remark>) -> Result<PlacerSetup, Error> {
    remark_on_others(node, &KNOWN_TO_PLACER, remarks);
    Ok(PlacerSetup {
        tasks: tasks::read(node)?,
        marker_file: path(node, "marker_file"),
        coordinate_file: path(node, "coordinate_file"),
        time_range: time_range(node)?,
    })
}

fn name_of(node: Node<'_, '_>) -> String {
    node.attribute("name").unwrap_or_default().trim().to_owned()
}
