//! The header: who, how fast, what was done, where the forces come from.

use super::feet;
use super::results::Results;
use super::size::{BodySize, Known};
use super::strides::Stride;
use super::way::Way;
use crate::page::contract::{Fact, PageSource};
use serde_json::Value;

/// Below this speed a body does not walk anywhere [m/s].
const STANDING_M_S: f64 = 0.1;

/// Masses that differ by a smaller share are one.
const SAME_MASS: f64 = 0.005;

/// All lines, in the order to be shown.
pub(super) fn header(results: &Results, size: &BodySize, strides: &[Stride]) -> Vec<Fact> {
    let metres = |known: &Option<Known>, label: &str| match known {
        Some(known) => fact(label, format!("{:.2} m", known.metres), Some(known.source.clone())),
        None => fact(label, "not known", None),
    };
    let lines = [
        recording(results),
        subject(results),
        Some(mass(results)),
        Some(metres(&size.stature, "Stature")),
        Some(metres(&size.leg, "Leg length")),
        Some(speed(results, size)),
        cadence(strides),
        direction(results),
        window(results),
        Some(fact("Filter", filters(results), None)),
        changed(results),
        Some(forces(results)),
        results.text("/subject/axes").map(|axes| fact("Axes", axes.replace("->", "→"), None)),
        Some(fact("Program", format!("Ambulo {}", results.text("/version").unwrap_or("of unknown version")), None)),
    ];
    lines.into_iter().flatten().collect()
}

/// What the page is called: the recording, the gait.
pub(super) fn recording_name(results: &Results) -> Option<String> {
    results.text("/input/motion").map(|motion| file_name(motion).to_owned())
}

/// The last part of a path of any system.
pub(super) fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

/// A line.
pub(super) fn fact(label: &str, value: impl Into<String>, note: Option<String>) -> Fact {
    Fact { label: label.to_owned(), value: value.into(), note }
}

fn recording(results: &Results) -> Option<Fact> {
    if let Some(gait) = results.text("/walk/gait") {
        let style = results.text("/walk/style").unwrap_or_default();
        let mode = results.text("/walk/mode").unwrap_or_default();
        return Some(fact("Synthetic walk", gait, Some(format!("style {style}, mode {mode}"))));
    }
    let standing = results.text("/input/static").map(|file| format!("standing trial: {}", file_name(file)));
    Some(fact("Recording", file_name(results.text("/input/motion")?), standing))
}

fn subject(results: &Results) -> Option<Fact> {
    let input = results.text("/input/model").map(|input| match input {
        "built-in" => "the built-in body, sized by the recording".to_owned(),
        figure if figure.starts_with("figure ") => "a figure of a table of segments".to_owned(),
        file => format!("from {}", file_name(file)),
    });
    Some(fact("Subject and model", results.text("/model")?, input))
}

fn mass(results: &Results) -> Fact {
    let source = match results.text("/mass_source") {
        Some("plates") => "weighed by the plates over whole gait cycles",
        Some("standing") => "weighed by the plates in the standing trial",
        Some("model") => "that of the model",
        _ => "of unknown origin",
    };
    let known = match results.text("/mass") {
        Some("verified") if results.text("/mass_source") == Some("model") => ", as stated",
        Some("unverified") => "; nobody weighed or stated it",
        Some("contradicted") => "; the plates carry another mass",
        _ => "",
    };
    let value = match results.number("/mass_model_kg") {
        Some(model) if (model / results.mass_kg - 1.0).abs() > SAME_MASS => {
            format!(
                "{:.1} kg (divides moments and powers); {model:.1} kg (of the model, used by dynamics)",
                results.mass_kg
            )
        }
        _ => format!("{:.1} kg", results.mass_kg),
    };
    fact("Body mass", value, Some(format!("{source}{known}")))
}

fn speed(results: &Results, size: &BodySize) -> Fact {
    let Some(speed) = results.number("/speed_m_s") else {
        let why = match results.source {
            PageSource::None => "without ground forces no file tells which foot stands",
            _ => "no foot was seen to carry the body",
        };
        return fact("Speed", "not known", Some(why.to_owned()));
    };
    let scaled = match size.speed_dimensionless {
        Some(scaled) => format!("V* = V / sqrt(g L) = {scaled:.2}"),
        None => "no dimensionless speed, since the leg length is not known".to_owned(),
    };
    let value = match Way::of(results).and_then(|way| way.longer_speed()) {
        Some(along) => format!("{speed:.2} m/s straight, {along:.2} m/s along the path"),
        None => format!("{speed:.2} m/s"),
    };
    fact("Speed", value, Some(scaled))
}

fn cadence(strides: &[Stride]) -> Option<Fact> {
    let mean = strides.iter().map(|stride| stride.cycle_s).sum::<f64>() / strides.len() as f64;
    let note = match strides.len() {
        1 => "of one stride".to_owned(),
        several => format!("mean of {several} strides"),
    };
    (mean > 0.0).then(|| fact("Cadence", format!("{:.0} steps/min", 120.0 / mean), Some(note)))
}

fn direction(results: &Results) -> Option<Fact> {
    let way = feet::pelvis_velocity(results)?;
    let belt = feet::floor_velocity(results).norm();
    let value = match () {
        () if belt > 0.0 => format!("in place, on a belt that runs at {belt:.2} m/s"),
        () if way.norm() < STANDING_M_S => "none: the body stays where it is".to_owned(),
        () => along(way.z.atan2(way.x).to_degrees()),
    };
    Some(fact("Walking direction", value, Some("world: x forward, y up, z to the right".to_owned())))
}

/// An angle from world x towards z, in words; less is sway of the pelvis.
fn along(angle_deg: f64) -> String {
    let side = if angle_deg > 0.0 { "right" } else { "left" };
    match angle_deg.abs() {
        small if small < 1.5 => "along world x".to_owned(),
        angle => format!("{angle:.0} deg to the {side} of world x"),
    }
}

fn window(results: &Results) -> Option<Fact> {
    let (from, to) = (results.number("/window_s/0")?, results.number("/window_s/1")?);
    let frames = results.grid.frames;
    let rate = results.grid.rate_hz();
    let by_markers = results.has_finding("markers.window");
    let asked = ["/window_asked_s/0", "/window_asked_s/1"].iter().any(|path| results.number(path).is_some());
    let cut = match () {
        () if by_markers => ", cut to the longest time in which the markers tell the motion",
        () if asked => ", cut as asked",
        () => "",
    };
    let note = format!("{frames} frames at {rate:.0} Hz{cut}");
    Some(fact("Time", format!("{from:.2} to {to:.2} s"), Some(note)))
}

fn filters(results: &Results) -> String {
    let words = |filter: &Value| match filter["kind"].as_str() {
        Some("butterworth") => {
            let cutoff = filter["cutoff_hz"].as_f64().unwrap_or(f64::NAN);
            let order = filter["order"].as_u64().unwrap_or_default();
            format!("Butterworth, {cutoff} Hz, order {order}, both ways")
        }
        Some("spline") => "smoothing spline".to_owned(),
        _ => "none".to_owned(),
    };
    let filter = &results.summary["filter"];
    let motion = format!("motion: {}", words(&filter["motion"]));
    match results.source {
        PageSource::None => motion,
        _ => format!("{motion}; forces: {}", words(&filter["force"])),
    }
}

/// That the motion is not the recorded one, and where it differs most.
fn changed(results: &Results) -> Option<Fact> {
    let changes = results.summary.pointer("/consistency/changes")?.as_object()?;
    let largest = |unit: &str| {
        let sizes = changes.iter().filter(|(_, size)| size["unit"].as_str() == Some(unit));
        let sizes = sizes.filter_map(|(name, size)| Some((name, size["max"].as_f64()?)));
        let (name, size) = sizes.max_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(format!("{} by {size:.1} {unit}", name.replace('_', " ")))
    };
    let most: Vec<String> = ["deg", "mm"].into_iter().filter_map(largest).collect();
    let note = (!most.is_empty()).then(|| format!("at most {}", most.join(" and ")));
    Some(fact("Motion", "changed so that it agrees with the ground forces", note))
}

fn forces(results: &Results) -> Fact {
    let rule = results.text("/ground/rule");
    let split = rule.map(|rule| format!("double support by the rule: {rule}"));
    let (value, note) = match results.source {
        PageSource::Measured => {
            ("measured by plates", Some("each foot by itself, so that no rule is needed".to_owned()))
        }
        PageSource::Predicted => ("predicted from the motion", split),
        PageSource::Simulated => ("simulated", rule.map(|rule| format!("feet on the ground: {rule}"))),
        PageSource::None => ("none", Some("the motion was computed without ground forces, as asked".to_owned())),
    };
    fact("Ground forces", value, note)
}
