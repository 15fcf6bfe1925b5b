//! What the files of a recording's folder say, read once.

use super::cycles_file::{self, CycleValues};
use super::{cycles, events};
use crate::clinical::ClinicalNames;
use crate::page::contract::{PageCycle, PageEvent, PageSource, TimeAxis};
use crate::page::folder::{Folder, PageError};
use ambulo::findings::Findings;
use ambulo::model::{Model, Side};
use ambulo::motion::TimeGrid;
use ambulo_formats::table::Table;
use serde_json::Value;

/// Standard gravity [m/s²] (CGPM 1901, unverified), which OpenSim's models have unless they say otherwise.
const STANDARD_GRAVITY: f64 = 9.806_65;
/// A body in files: of recordings, of synthetic walks.
const BODIES: [&str; 2] = ["subject.osim", "figure.osim"];

/// A recording's or a walk's files.
pub(super) struct Results {
    pub(super) summary: Value,
    pub(super) grid: TimeGrid,
    pub(super) times: Vec<f64>,
    pub(super) kinematics: Table,
    pub(super) moments: Option<Table>,
    pub(super) powers: Option<Table>,
    pub(super) ground: Option<Table>,
    pub(super) deviations: Option<Table>,
    pub(super) measured: Option<Table>,
    pub(super) events: Vec<PageEvent>,
    pub(super) curves: Vec<CycleValues>,
    pub(super) cycles: Vec<PageCycle>,
    /// The body, with the name of its file.
    pub(super) body: Option<(&'static str, Model)>,
    pub(super) source: PageSource,
    /// Of the body, by which results are divided [kg].
    pub(super) mass_kg: f64,
    /// The same times gravity [N].
    pub(super) weight_n: f64,
}

impl Results {
    /// Reads the files.
    pub(super) fn read(folder: &Folder<'_>, summary: Value) -> Result<Results, PageError> {
        let missing = || PageError::Missing { folder: folder.name.clone(), file: KINEMATICS };
        let kinematics = folder.table(KINEMATICS)?.ok_or_else(missing)?;
        let times = kinematics.times().unwrap_or_default().to_vec();
        let uneven = || "the time column is not even; expected two or more rows at even steps".to_owned();
        let grid = TimeGrid::through(&times).ok_or_else(|| folder.unreadable(KINEMATICS, uneven()))?;
        let table = |file: &str| same_instants(folder, file, &grid);
        let body = body(folder)?;
        let mass_kg = mass(folder, &summary)?;
        let (events, curves) = (events::events(folder)?, cycles_file::read(folder)?);
        Ok(Results {
            cycles: cycles::cycles(&events, &curves, &kinematics, &times),
            moments: table(MOMENTS)?,
            powers: table(POWERS)?,
            ground: table(GROUND)?,
            deviations: table(DEVIATIONS)?,
            measured: table(MEASURED)?,
            weight_n: mass_kg * gravity(body.as_ref().map(|(_, model)| model), &summary),
            source: source(&summary),
            summary,
            grid,
            times,
            kinematics,
            events,
            curves,
            body,
            mass_kg,
        })
    }

    /// Which coordinates measure which movements: the body's, or the usual ones without a body.
    pub(super) fn clinical_names(&self) -> ClinicalNames {
        self.body.as_ref().map_or_else(ClinicalNames::without_model, |(_, model)| ClinicalNames::of_model(model))
    }

    /// The instants as the page has them.
    pub(super) fn time(&self) -> TimeAxis {
        TimeAxis { start_s: self.grid.start_s, step_s: self.grid.step_s, frames: self.grid.frames }
    }

    /// Gravity [m/s²].
    pub(super) fn gravity(&self) -> f64 {
        self.weight_n / self.mass_kg
    }

    /// A number of the summary, by its path: `/ground/threshold_n`.
    pub(super) fn number(&self, path: &str) -> Option<f64> {
        self.summary.pointer(path)?.as_f64()
    }

    /// A text of the summary.
    pub(super) fn text(&self, path: &str) -> Option<&str> {
        self.summary.pointer(path)?.as_str()
    }

    /// Whether something odd of this kind was found.
    pub(super) fn has_finding(&self, code: &str) -> bool {
        self.list("/findings").iter().any(|finding| finding["code"].as_str() == Some(code))
    }

    /// A list of the summary, empty where there is none.
    pub(super) fn list(&self, path: &str) -> &[Value] {
        self.summary.pointer(path).and_then(Value::as_array).map_or(&[], Vec::as_slice)
    }

    /// The limit that a check of the verdict judged by.
    pub(super) fn limit(&self, check: &str) -> Option<f64> {
        let judged = self.list("/verdict/closest").iter().find(|entry| entry["check"].as_str() == Some(check))?;
        judged["limit"].as_f64().filter(|limit| limit.is_finite())
    }

    /// Cycles of one foot.
    pub(super) fn cycles_of(&self, side: Side) -> impl Iterator<Item = &PageCycle> {
        let side = super::sides::page(side);
        self.cycles.iter().filter(move |cycle| cycle.side == side)
    }
}

/// Names of the files.
pub(super) const KINEMATICS: &str = "kinematics.mot";
pub(super) const MOMENTS: &str = "moments.sto";
pub(super) const POWERS: &str = "powers.sto";
pub(super) const GROUND: &str = "grf.mot";
pub(super) const DEVIATIONS: &str = "grf_sd.mot";
pub(super) const MEASURED: &str = "grf_measured.mot";

fn same_instants(folder: &Folder<'_>, file: &str, grid: &TimeGrid) -> Result<Option<Table>, PageError> {
    let Some(table) = folder.table(file)? else { return Ok(None) };
    let times = table.times().unwrap_or_default();
    let near = |(i, t): (usize, &f64)| (t - grid.time(i)).abs() < 0.5 * grid.step_s;
    if times.len() == grid.frames && times.iter().enumerate().all(near) {
        return Ok(Some(table));
    }
    let expected = format!("{} at the instants of {KINEMATICS}", grid.frames);
    Err(folder.unreadable(file, format!("found {} rows; expected {expected}", times.len())))
}

fn body(folder: &Folder<'_>) -> Result<Option<(&'static str, Model)>, PageError> {
    for file in BODIES {
        if let Some(bytes) = (folder.file)(file) {
            let model = Model::from_osim(&bytes, &mut Findings::default());
            return match model {
                Ok(model) => Ok(Some((file, model))),
                Err(error) => Err(folder.unreadable(file, error.to_string())),
            };
        }
    }
    Ok(None)
}

fn mass(folder: &Folder<'_>, summary: &Value) -> Result<f64, PageError> {
    let found = &summary["mass_kg"];
    let positive = found.as_f64().filter(|mass| mass.is_finite() && *mass > 0.0);
    positive
        .ok_or_else(|| folder.unreadable("summary.json", format!("`mass_kg` is {found}; expected a positive number")))
}

/// From the body, or from two numbers of the summary that differ by the weight.
fn gravity(model: Option<&Model>, summary: &Value) -> f64 {
    let residual = &summary["residual"];
    let of_residual = || {
        let weight = residual["force_rms_n"].as_f64()? / residual["force_rms_bw"].as_f64()?;
        Some(weight / summary["mass_kg"].as_f64()?)
    };
    let known = model.map(|model| model.gravity().norm()).or_else(of_residual);
    known.filter(|g| g.is_finite() && *g > 0.0).unwrap_or(STANDARD_GRAVITY)
}

fn source(summary: &Value) -> PageSource {
    match summary["ground"]["source"].as_str() {
        Some("measured") => PageSource::Measured,
        Some("predicted") => PageSource::Predicted,
        Some("simulated") => PageSource::Simulated,
        _ => PageSource::None,
    }
}
