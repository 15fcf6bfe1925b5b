//! Panels of the residual force and moment at the root over time.

use super::{RESIDUAL_FORCE, RESIDUAL_MOMENT, group, over_time};
use crate::page::block::Block;
use crate::page::contract::{Group, Origin, PageSource, Panel, Role, Trace};
use crate::page::session::results::Results;
use ambulo::analysis::feasibility::Check;
use ambulo::model::Movement;
use ambulo_results::MOMENTS;

/// A coordinate of the root and its panel: id, heading, unit, directions.
type Component = (Movement, [&'static str; 3], [&'static str; 2]);

const FORCES: [Component; 3] = [
    (Movement::PelvisForward, ["residual_force_x", "Residual force, fore-aft", "N"], ["forward", "backward"]),
    (Movement::PelvisUp, ["residual_force_y", "Residual force, vertical", "N"], ["up", "down"]),
    (Movement::PelvisRight, ["residual_force_z", "Residual force, sideways", "N"], ["right", "left"]),
];
const MOMENTS_OF_ROOT: [Component; 3] = [
    (Movement::PelvicTilt, [RESIDUAL_MOMENT, "Residual moment, tilt", "N.m"], ["", ""]),
    (Movement::PelvicObliquity, ["residual_moment_list", "Residual moment, list", "N.m"], ["", ""]),
    (Movement::PelvicRotation, ["residual_moment_rotation", "Residual moment, rotation", "N.m"], ["", ""]),
];

/// The column of `moments.sto` for a coordinate of the root.
fn column(results: &Results, movement: Movement) -> Option<String> {
    let suffix = if FORCES.iter().any(|(force, ..)| *force == movement) { "force" } else { "moment" };
    Some(format!("{}_{suffix}", results.clinical_names().central(movement)?))
}

/// Components of force and moment, and the magnitude of the force in per cent of body weight; `None` without moments of
/// a root.
pub(super) fn residual(results: &Results, block: &mut Block) -> Option<Group> {
    let mut panels: Vec<Panel> =
        FORCES.iter().chain(&MOMENTS_OF_ROOT).filter_map(|component| panel(results, component, block)).collect();
    if panels.is_empty() {
        return None;
    }
    panels.extend(size(results, block));
    Some(group("residual", "Residual at the pelvis", note(results), 3, panels))
}

fn trace(name: &str, role: Role, values: &[f64], origin: Option<Origin>, block: &mut Block) -> Trace {
    Trace {
        name: name.to_owned(),
        side: None,
        role,
        values: block.add(values),
        sd: None,
        predicted: Vec::new(),
        origin,
    }
}

fn panel(results: &Results, (movement, head, directions): &Component, block: &mut Block) -> Option<Panel> {
    let column = column(results, *movement)?;
    let values = results.moments.as_ref()?.column(&column)?;
    let origin = Origin { file: MOMENTS.to_owned(), column, factor: 1.0 };
    Some(over_time(*head, *directions, vec![trace("residual", Role::Main, values, Some(origin), block)]))
}

/// Magnitude of the force, with its limit.
fn size(results: &Results, block: &mut Block) -> Option<Panel> {
    let table = results.moments.as_ref()?;
    let axes: Vec<&[f64]> =
        FORCES.iter().filter_map(|(movement, ..)| table.column(&column(results, *movement)?)).collect();
    let percent = 100.0 / results.weight_n;
    let length = |frame: usize| percent * axes.iter().map(|axis| axis[frame].powi(2)).sum::<f64>().sqrt();
    if axes.is_empty() {
        return None;
    }
    let lengths: Vec<f64> = (0..results.grid.frames).map(length).collect();
    let mut traces = vec![trace("residual", Role::Main, &lengths, None, block)];
    if let Some(limit) = results.limit(Check::Support).filter(|_| results.source != PageSource::None) {
        traces.push(trace("limit", Role::Limit, &vec![100.0 * limit; lengths.len()], None, block));
    }
    Some(over_time([RESIDUAL_FORCE, "Residual force, magnitude", "%BW"], ["", ""], traces))
}

fn note(results: &Results) -> String {
    let about = "Force and moment at the pelvis that the motion requires but neither joints nor ground supply: zero if \
        motion, forces and body were consistent.";
    match results.source {
        PageSource::None => {
            format!(
                "{about} Here no ground forces are applied, so the residual is what the ground would have to supply."
            )
        }
        _ => format!("{about}{}", windows(results)),
    }
}

/// Names the times in which the residual is meaningful.
fn windows(results: &Results) -> String {
    let windows = results.summary.subject.iter().flat_map(|subject| &subject.instrumented_windows_s);
    let spans: Vec<String> = windows.map(|[from, to]| format!("{from:.2} to {to:.2} s")).collect();
    match spans.is_empty() || !results.is_measured() {
        true => String::new(),
        false => {
            format!(" It is meaningful only while every loaded foot is wholly on a force plate: {}.", spans.join(", "))
        }
    }
}
