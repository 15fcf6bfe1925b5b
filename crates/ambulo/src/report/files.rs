//! The files of a run, as names and bytes.

use super::cycle_table::{self, cycle_rows};
use super::figures::{CycleFigures, FigureError, Mark, residual_figure};
use super::normative::dimensionless_speed;
use super::tables;
use crate::analysis::feasibility::{Check, Person, Reason};
use crate::analysis::{Analysis, Cycle};
use crate::model::{Model, Side};
use ambulo_formats::Error;

/// A file to be written.
#[derive(Debug, Clone, PartialEq)]
pub struct OutputFile {
    /// Name, relative to the output folder.
    pub name: String,
    /// Content.
    pub bytes: Vec<u8>,
}

/// Why a file could not be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OutputError {
    /// A table with columns that no file can hold.
    #[error(transparent)]
    Table(#[from] Error),
    /// A figure that could not be drawn.
    #[error(transparent)]
    Figure(#[from] FigureError),
}

/// Every file but `summary.json`. `device`, if worn, is its generalised forces: one column a coordinate [N.m or N], one
/// entry a frame; what remains for the body is written beside the total.
///
/// # Errors
/// Column names that no table can hold, a figure that could not be drawn.
pub fn output_files(
    model: &Model,
    analysis: &Analysis,
    device: Option<&[Vec<f64>]>,
) -> Result<Vec<OutputFile>, OutputError> {
    let file = |name: &str, bytes: Vec<u8>| OutputFile { name: name.to_owned(), bytes };
    let rows = cycle_rows(model, analysis);
    let mut files = vec![
        file("kinematics.mot", tables::kinematics(model, analysis)?.write_storage()),
        file("moments.sto", tables::moments(model, analysis, None)?.write_storage()),
        file("powers.sto", tables::powers(model, analysis)?.write_storage()),
        file("reactions.sto", tables::reactions(model, analysis)?.write_storage()),
    ];
    if let Some(device) = device {
        let biological = tables::moments(model, analysis, Some(device))?;
        files.push(file("moments_biological.sto", biological.write_storage()));
    }
    if !analysis.ground.bodies.is_empty() {
        files.push(file("grf.mot", tables::ground(model, analysis)?.write_storage()));
        files.push(file("external_loads.xml", tables::external_loads(model, analysis).write()));
        files.push(file("events.csv", tables::events_csv(analysis).into_bytes()));
    }
    let caption = caption(model, analysis);
    if let Some(svg) = residual_figure(model, analysis, &caption)? {
        files.push(file("figures/quality.svg", svg.into_bytes()));
    }
    if !rows.is_empty() {
        files.push(file("cycles.csv", cycle_table::csv(&rows).into_bytes()));
        let figures = CycleFigures {
            rows: &rows,
            mass_kg: analysis.mass.kg,
            caption: &caption,
            marks: &marks(analysis),
            speed_dimensionless: speed_dimensionless(model, analysis),
        };
        files.extend(figures.files()?);
    }
    Ok(files)
}

/// V / sqrt(g L), where the speed is known and the model has legs.
fn speed_dimensionless(model: &Model, analysis: &Analysis) -> Option<f64> {
    dimensionless_speed(analysis.speed_m_s?, model.gravity().norm(), Person::of_model(model).leg_length_m)
}

/// Whose walk a figure shows: `subject01, 72.8 kg, 1.12 m/s (V* 0.37)`.
pub(super) fn caption(model: &Model, analysis: &Analysis) -> String {
    let speed = analysis.speed_m_s.map(|v| format!(", {v:.2} m/s")).unwrap_or_default();
    let scaled = speed_dimensionless(model, analysis).map(|v| format!(" (V* = {v:.2})")).unwrap_or_default();
    format!("{}, {:.1} kg{speed}{scaled}", model.name(), analysis.mass.kg)
}

/// What stands against the motion, by gait cycle. What has no side stands in the cycles of both feet.
fn marks(analysis: &Analysis) -> Vec<Mark> {
    let reasons = analysis.verdict.iter().flat_map(|verdict| &verdict.reasons);
    let pairs = reasons.flat_map(|reason| analysis.cycles.iter().map(move |cycle| (reason, cycle)));
    let of_side = pairs.filter(|(reason, cycle)| reason.side.is_none_or(|side| side == cycle.side));
    let mark = |(reason, cycle): (&Reason, &Cycle)| {
        let [from, to] = reason.time_s.map(|t| (t - cycle.start_s) / (cycle.end_s - cycle.start_s));
        (to >= 0.0 && from <= 1.0).then(|| Mark {
            quantity: quantity(reason),
            side: cycle.side,
            cycle: cycle.number,
            percent: [from, to].map(|share| 100.0 * share.clamp(0.0, 1.0)),
        })
    };
    of_side.filter_map(mark).collect()
}

/// The quantity of `cycles.csv` that a reason is about; `None` for those of feet and body.
fn quantity(reason: &Reason) -> Option<String> {
    let suffix = match reason.check {
        Check::Strength | Check::Power => "",
        Check::Range => "_angle",
        _ => return None,
    };
    let stem = Side::split_name(&reason.quantity).map_or_else(|| reason.quantity.clone(), |(_, stem)| stem);
    Some(stem + suffix)
}
