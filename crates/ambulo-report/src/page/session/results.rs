//! Reads the files of a recording or walk once.

use super::{cycles, sides};
use crate::clinical::{ClinicalNames, ClinicalQuantity};
use crate::page::contract::{PageCycle, PageEvent, PageSource, TimeAxis};
use ambulo::analysis::feasibility::Check;
use ambulo::analysis::{Event, EventKind};
use ambulo::model::{Model, Side};
use ambulo::motion::TimeGrid;
use ambulo_formats::table::Table;
use ambulo_results::{
    CLINICAL, CONTACT_REACTIONS, Convention, CycleRow, EMG, Folder, GROUND, GROUND_MEASURED, GROUND_SD, GroundOrigin,
    KINEMATICS, MOMENTS, MUSCLES, POWERS, ResultsError, Summary,
};

/// Most instants of time series that a page draws: more take memory and time in the browser, and no screen shows them.
const MOST_INSTANTS: usize = 4_000;

/// Values that are computed from all rows of the motion.
pub(super) struct AllRows {
    /// Rows per drawn instant.
    step: usize,
    events: Vec<PageEvent>,
    curves: Vec<CycleRow>,
    cycles: Vec<PageCycle>,
}

impl AllRows {
    /// Reads a folder whose `kinematics.mot` has all rows.
    pub(super) fn read(folder: &Folder<'_>, kinematics: &Table) -> Result<AllRows, ResultsError> {
        let events = folder.events()?.iter().map(page_event).collect::<Vec<_>>();
        let curves = folder.cycles()?;
        let times = kinematics.times().unwrap_or_default();
        let cycles = cycles::cycles(&events, &curves, kinematics, times);
        Ok(AllRows { step: step(kinematics), events, curves, cycles })
    }
}

/// Step between the drawn rows of a table of time series.
pub(super) fn step(table: &Table) -> usize {
    table.rows().div_ceil(MOST_INSTANTS).max(1)
}

/// The contents of the files of a recording or walk.
pub(super) struct Results {
    pub(super) summary: Summary,
    pub(super) grid: TimeGrid,
    pub(super) times: Vec<f64>,
    pub(super) kinematics: Table,
    pub(super) moments: Option<Table>,
    pub(super) powers: Option<Table>,
    pub(super) ground: Option<Table>,
    pub(super) deviations: Option<Table>,
    pub(super) measured: Option<Table>,
    /// `clinical.csv`.
    pub(super) clinical: Option<Table>,
    /// `muscles.sto`.
    pub(super) muscles: Option<Table>,
    /// `reactions_contact.sto`.
    pub(super) contact: Option<Table>,
    /// `emg.sto`.
    pub(super) emg: Option<Table>,
    pub(super) events: Vec<PageEvent>,
    pub(super) curves: Vec<CycleRow>,
    pub(super) cycles: Vec<PageCycle>,
    /// Step between the drawn rows of the files.
    pub(super) step: usize,
    /// The name of the model file, and the model.
    pub(super) body: Option<(&'static str, Model)>,
    pub(super) source: PageSource,
    /// Body mass that normalises results [kg].
    pub(super) mass_kg: f64,
    /// Body mass times gravity [N].
    pub(super) weight_n: f64,
}

impl Results {
    /// Reads the files. The cycles belong to all rows of the motion; the time series have the rows of `folder`.
    pub(super) fn read(folder: &Folder<'_>, summary: Summary, all: Option<AllRows>) -> Result<Results, ResultsError> {
        let missing = || ResultsError::Missing { folder: folder.name.clone(), file: KINEMATICS };
        let kinematics = folder.table(KINEMATICS)?.ok_or_else(missing)?;
        let all = all.ok_or_else(missing)?;
        let times = kinematics.times().unwrap_or_default().to_vec();
        let uneven = || "the time column is not evenly spaced; expected two or more rows at even steps".to_owned();
        let grid = TimeGrid::through(&times).ok_or_else(|| folder.unreadable(KINEMATICS, uneven()))?;
        let table = |file: &str| same_instants(folder, file, &grid);
        let body = folder.body()?;
        let mass_kg = mass(folder, &summary)?;
        Ok(Results {
            moments: table(MOMENTS)?,
            powers: table(POWERS)?,
            ground: table(GROUND)?,
            deviations: table(GROUND_SD)?,
            measured: table(GROUND_MEASURED)?,
            muscles: table(MUSCLES)?,
            contact: table(CONTACT_REACTIONS)?,
            emg: table(EMG)?,
            clinical: on_instants(folder, CLINICAL, folder.csv_table(CLINICAL)?, &grid)?,
            weight_n: mass_kg * summary.gravity_m_s2,
            source: source(&summary),
            summary,
            grid,
            times,
            kinematics,
            events: all.events,
            curves: all.curves,
            cycles: all.cycles,
            step: all.step,
            body,
            mass_kg,
        })
    }

    /// Which coordinates measure which movements: from the model, or the usual names without a model.
    pub(super) fn clinical_names(&self) -> ClinicalNames {
        self.body.as_ref().map_or_else(ClinicalNames::without_model, |(_, model)| ClinicalNames::of_model(model))
    }

    /// The convention for the angles of pelvis and hips.
    pub(super) fn convention(&self) -> Convention {
        let of_file = self.summary.convention.as_ref().filter(|_| self.clinical.is_some());
        of_file.map_or(Convention::Opensim, |convention| convention.used)
    }

    /// A quantity over time in clinical signs and units, by its column in `clinical.csv`.
    pub(super) fn clinical_column(&self, quantity: &ClinicalQuantity, side: Side) -> Option<(String, &[f64])> {
        let column = quantity.clinical_column(side);
        let values = self.clinical.as_ref()?.column(&column)?;
        Some((column, values))
    }

    /// The instants in the form of the page.
    pub(super) fn time(&self) -> TimeAxis {
        TimeAxis { start_s: self.grid.start_s, step_s: self.grid.step_s, frames: self.grid.frames }
    }

    /// Gravity [m/s²].
    pub(super) fn gravity(&self) -> f64 {
        self.summary.gravity_m_s2
    }

    /// Whether force plates measured the ground forces, or most of them.
    pub(super) fn is_measured(&self) -> bool {
        matches!(self.source, PageSource::Measured | PageSource::Mixed)
    }

    /// The times in which the load of a foot was not measured, while others were [s].
    pub(super) fn predicted_times(&self, side: Side) -> Vec<[f64; 2]> {
        let column = format!("ground_source_{}", side.letter());
        let tables = [&self.moments, &self.powers, &self.ground, &self.clinical];
        let marks = tables.into_iter().flatten().find_map(|table| table.column(&column)).unwrap_or_default();
        let rows: Vec<usize> = (0..marks.len().min(self.times.len())).collect();
        let is_marked = |row: &usize| marks[*row] > 0.0;
        let runs = rows.chunk_by(|a, b| is_marked(a) == is_marked(b)).filter(|run| is_marked(&run[0]));
        runs.map(|run| [run[0], run[run.len() - 1]].map(|row| self.times[row])).collect()
    }

    /// The limit of a check of the verdict.
    pub(super) fn limit(&self, check: Check) -> Option<f64> {
        let judged = self.summary.verdict.as_ref()?.closest.iter().find(|entry| entry.check == check)?;
        Some(judged.limit).filter(|limit| limit.is_finite())
    }

    /// Cycles of one foot.
    pub(super) fn cycles_of(&self, side: Side) -> impl Iterator<Item = &PageCycle> {
        let side = sides::page(side);
        self.cycles.iter().filter(move |cycle| cycle.side == side)
    }
}

fn same_instants(folder: &Folder<'_>, file: &str, grid: &TimeGrid) -> Result<Option<Table>, ResultsError> {
    on_instants(folder, file, folder.table(file)?, grid)
}

/// A table whose rows are at the instants of the motion.
fn on_instants(
    folder: &Folder<'_>,
    file: &str,
    table: Option<Table>,
    grid: &TimeGrid,
) -> Result<Option<Table>, ResultsError> {
    let Some(table) = table else { return Ok(None) };
    let times = table.times().unwrap_or_default();
    let near = |(i, t): (usize, &f64)| (t - grid.time(i)).abs() < 0.5 * grid.step_s;
    if times.len() == grid.frames && times.iter().enumerate().all(near) {
        return Ok(Some(table));
    }
    let expected = format!("{} at the instants of {KINEMATICS}", grid.frames);
    Err(folder.unreadable(file, format!("found {} rows; expected {expected}", times.len())))
}

fn page_event(event: &Event) -> PageEvent {
    PageEvent { side: sides::page(event.side), strike: event.kind == EventKind::Strike, time_s: event.time_s }
}

fn mass(folder: &Folder<'_>, summary: &Summary) -> Result<f64, ResultsError> {
    let found = summary.mass_kg;
    let wrong =
        || folder.unreadable(ambulo_results::SUMMARY, format!("`mass_kg` is {found}; expected a positive number"));
    Some(found).filter(|mass| *mass > 0.0).ok_or_else(wrong)
}

fn source(summary: &Summary) -> PageSource {
    match summary.ground.source {
        GroundOrigin::Measured => PageSource::Measured,
        GroundOrigin::Mixed => PageSource::Mixed,
        GroundOrigin::Predicted => PageSource::Predicted,
        GroundOrigin::Simulated => PageSource::Simulated,
        GroundOrigin::None => PageSource::None,
    }
}
