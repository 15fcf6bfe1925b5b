//! The header: subject, speed, processing, and source of the ground forces.

use super::results::Results;
use super::size::{BodySize, SourcedLength};
use crate::page::contract::{Fact, PageSource};
use ambulo::analysis::{MassSource, StrideQuantity};
use ambulo::numerics::elementary::{atan2, hypot};
use ambulo::study::MassState;
use ambulo_results::{ChangeUnit, Convention, FilterKind, FilterSummary};

/// Below this speed a body stays in place [m/s].
const STANDING_M_S: f64 = 0.1;

/// Masses that differ by a smaller share count as equal.
const SAME_MASS: f64 = 0.005;

/// All lines, in display order.
pub(super) fn header(results: &Results, size: &BodySize) -> Vec<Fact> {
    let metres = |length: &Option<SourcedLength>, label: &str| match length {
        Some(length) => fact(label, format!("{:.2} m", length.metres), Some(length.source.clone())),
        None => fact(label, "not known", None),
    };
    let lines = [
        Some(recording(results)),
        conditions(results),
        Some(subject(results)),
        Some(mass(results)),
        Some(metres(&size.stature, "Stature")),
        Some(metres(&size.leg, "Leg length")),
        Some(speed(results, size)),
        cadence(results),
        direction(results),
        Some(window(results)),
        Some(fact("Filter", filters(results), None)),
        changed(results),
        Some(forces(results)),
        Some(convention(results)),
        results.summary.subject.as_ref().map(|subject| fact("Axes", subject.axes.replace("->", "→"), None)),
        Some(fact("Program", format!("Ambulo {}", results.summary.version), None)),
    ];
    lines.into_iter().flatten().collect()
}

/// The name of the session: the recording or the gait.
pub(super) fn recording_name(results: &Results) -> String {
    if let Some(walk) = &results.summary.walk {
        return format!("Computed walk: {}", walk.gait);
    }
    file_name(&results.summary.input.motion).to_owned()
}

/// The last part of a path of any operating system.
pub(super) fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

/// A line of the header.
pub(super) fn fact(label: &str, value: impl Into<String>, note: Option<String>) -> Fact {
    Fact { label: label.to_owned(), value: value.into(), note }
}

/// How a walk was computed, from the name of the mode.
fn way(mode: &str) -> &'static str {
    match mode {
        "predict" => "predicted: least muscle effort, follows no recorded curves",
        "corrected" => "nearest to the curves of the gait, without outside forces",
        "physical" => "simulated by its own torques",
        "paper" => "exactly the curves of the gait, as in the paper of 1997",
        _ => "near mean curves of healthy people, without outside forces",
    }
}

/// The recording or computed walk.
pub(super) fn recording(results: &Results) -> Fact {
    if let Some(walk) = &results.summary.walk {
        return fact("Computed walk", &*walk.gait, Some(way(&walk.mode).to_owned()));
    }
    let input = &results.summary.input;
    let standing = input.standing.as_ref().map(|file| format!("standing trial: {}", file_name(file)));
    fact("Recording", file_name(&input.motion), standing)
}

/// Conditions and cost of a predicted walk.
fn conditions(results: &Results) -> Option<Fact> {
    let made = results.summary.walk.as_ref()?.prediction.as_ref()?;
    let conditions = match made.conditions() {
        none if none.is_empty() => "level ground, no load, full strength".to_owned(),
        some => some.join("; "),
    };
    let cost = format!(
        "metabolic power {:.1} W/kg, cost of transport {:.1} J/kg/m by a simple formula",
        made.metabolic_power_w_kg, made.cost_of_transport_j_kg_m
    );
    let sloped = made.slope_percent.abs() > 0.0;
    let axes = if sloped { "; all curves and the 3-D view are in axes of the slope, so it looks level" } else { "" };
    Some(fact("Conditions", conditions, Some(format!("{cost}{axes}"))))
}

/// Metabolic power of a predicted walk with devices and without them; their work and that of the body at their joints.
pub(super) fn devices(results: &Results) -> Option<Fact> {
    let made = results.summary.walk.as_ref()?.prediction.as_ref()?;
    Some(fact("Device", made.without_devices()?, Some(made.device_words().join("; "))))
}

fn subject(results: &Results) -> Fact {
    let input = match results.summary.input.model.as_str() {
        "built-in" => "built-in body, scaled to the recording".to_owned(),
        figure if figure.starts_with("figure ") => "figure from a table of segments".to_owned(),
        file => format!("from {}", file_name(file)),
    };
    fact("Subject and model", &*results.summary.model, Some(input))
}

fn mass(results: &Results) -> Fact {
    let summary = &results.summary;
    let source = match summary.mass.normalised_by {
        MassSource::Plates => "measured by the force plates over whole gait cycles",
        MassSource::Standing => "measured by the force plates in the standing trial",
        MassSource::Model => "from the model",
    };
    let by_plates = || match (summary.mass.plates_kg, summary.mass.plates_error_kg) {
        (Some(kg), Some(error)) => format!("; the force plates carry {kg:.1} kg (standard error {error:.1} kg)"),
        _ => String::new(),
    };
    let known = match summary.mass.state {
        MassState::Weighed => by_plates(),
        MassState::Stated => ", as given".to_owned(),
        MassState::Unknown => "; neither given nor measured".to_owned(),
        MassState::Contradicted => format!("; contradicted{}", by_plates()),
    };
    let (mass, model) = (results.mass_kg, summary.mass.kg);
    let value = match (model / mass - 1.0).abs() > SAME_MASS {
        true => format!("{mass:.1} kg (normalises moments and powers); {model:.1} kg (model, used for the dynamics)"),
        false => format!("{mass:.1} kg"),
    };
    fact("Body mass", value, Some(format!("{source}{known}")))
}

fn speed(results: &Results, size: &BodySize) -> Fact {
    let Some(speed) = results.summary.speed_m_s else {
        let why = match results.source {
            PageSource::None => "without ground forces the stance phases are not known",
            _ => "no stance phase was detected",
        };
        return fact("Speed", "not known", Some(why.to_owned()));
    };
    let scaled = match size.speed_dimensionless {
        Some(scaled) => format!("V* = V / sqrt(g L) = {scaled:.2}"),
        None => "no dimensionless speed, because the leg length is not known".to_owned(),
    };
    fact("Speed", speed_in_words(results, speed), Some(scaled))
}

/// A speed [m/s], and that along the path if it is not straight.
pub(super) fn speed_in_words(results: &Results, speed: f64) -> String {
    match results.summary.times_and_distances.path_speed_m_s {
        Some(along) => format!("{along:.2} m/s along the path, {speed:.2} m/s straight"),
        None => format!("{speed:.2} m/s"),
    }
}

fn cadence(results: &Results) -> Option<Fact> {
    let cadence = results.summary.times_and_distances.quantity(StrideQuantity::Cadence)?.both?;
    let note = match cadence.strides {
        1 => "one stride".to_owned(),
        several => format!("mean of {several} strides"),
    };
    Some(fact("Cadence", format!("{:.0} steps/min", cadence.mean), Some(note)))
}

fn direction(results: &Results) -> Option<Fact> {
    let walking = &results.summary.times_and_distances;
    let [forward, right] = walking.pelvis_velocity_m_s?;
    let value = match walking.belt_speed_m_s {
        Some(belt) => format!("in place, on a treadmill at {belt:.2} m/s"),
        None if hypot(forward, right) < STANDING_M_S => "none: the body stays in place".to_owned(),
        None => along(atan2(right, forward).to_degrees()),
    };
    Some(fact("Walking direction", value, Some("world: x forward, y up, z to the right".to_owned())))
}

/// An angle from world x towards z, in words; smaller angles are pelvic sway.
fn along(angle_deg: f64) -> String {
    let side = if angle_deg > 0.0 { "right" } else { "left" };
    match angle_deg.abs() {
        small if small < 1.5 => "along world x".to_owned(),
        angle => format!("{angle:.0} deg to the {side} of world x"),
    }
}

fn window(results: &Results) -> Fact {
    let [from, to] = results.summary.window_s;
    let (frames, rate) = (results.grid.frames, results.grid.rate_hz());
    let cut = match results.summary.requested_window_s.iter().any(Option::is_some) {
        true => ", part of the recording",
        false => "",
    };
    fact("Time", format!("{from:.2} to {to:.2} s"), Some(format!("{frames} frames at {rate:.0} Hz{cut}")))
}

fn filters(results: &Results) -> String {
    let words = |filter: &FilterSummary| match (filter.kind, filter.cutoff_hz, filter.order) {
        (FilterKind::Butterworth, Some(cutoff), Some(order)) => {
            format!("Butterworth, {cutoff} Hz, order {order}, forwards and backwards")
        }
        (FilterKind::Butterworth, ..) => "Butterworth".to_owned(),
        (FilterKind::Spline, ..) => "smoothing spline".to_owned(),
        (FilterKind::Off, ..) => "none".to_owned(),
    };
    let filter = &results.summary.filter;
    let motion = format!("motion: {}", words(&filter.motion));
    match results.source {
        PageSource::None => motion,
        _ => format!("{motion}; forces: {}", words(&filter.force)),
    }
}

/// Whether the recorded motion was changed, and where it differs most.
fn changed(results: &Results) -> Option<Fact> {
    let changes = &results.summary.consistency.as_ref()?.changes;
    let largest = |unit: ChangeUnit| {
        let sizes = changes.iter().filter(|(_, size)| size.unit == unit);
        let (name, size) = sizes.max_by(|a, b| a.1.max.total_cmp(&b.1.max))?;
        Some(format!("{} by {:.1} {unit}", name.replace('_', " "), size.max))
    };
    let most: Vec<String> = [ChangeUnit::Degree, ChangeUnit::Millimetre].into_iter().filter_map(largest).collect();
    let note = (!most.is_empty()).then(|| format!("at most {}", most.join(" and ")));
    Some(fact("Motion", "changed by residual reduction", note))
}

/// The convention of pelvis and hip angles.
fn convention(results: &Results) -> Fact {
    let value = match results.convention() {
        Convention::Clinical => {
            "clinical: pelvic tilt is the tilt of the line through the iliac spines; hip angles are relative to that \
             pelvis"
        }
        Convention::Opensim => "OpenSim: coordinates of the model, zero in upright standing",
    };
    fact("Pelvis and hip angles", value, results.summary.convention.as_ref().and_then(|used| used.reason.clone()))
}

/// Where the ground forces come from.
pub(super) fn forces(results: &Results) -> Fact {
    let rule = results.summary.ground.rule.as_ref();
    let split = rule.map(|rule| format!("method for double support: {rule}"));
    let (value, note) = match results.source {
        PageSource::Mixed => {
            ("measured by force plates, predicted where a loaded foot was not on them", results.summary.ground.shares())
        }
        PageSource::Measured => {
            ("measured by force plates", results.summary.ground.shares().or(Some("each foot separately".to_owned())))
        }
        PageSource::Predicted => ("predicted from the motion", split),
        PageSource::Simulated => ("simulated", rule.map(|rule| format!("foot contacts: {rule}"))),
        PageSource::None => ("none", Some("the motion was computed without ground forces, as requested".to_owned())),
    };
    fact("Ground forces", value, note)
}
