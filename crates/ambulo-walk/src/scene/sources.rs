//! Files that a scene names, which the caller reads, and functions of time from them.

use super::built_entry::WalkEntry;
use super::error_chain::chain;
use super::function::TimeFunction;
use super::{Place, SceneError};
use crate::control::{ControlSettings, WalkController};
use crate::engine::signal::Signal;
use crate::engine::workspace::StepSettings;
use crate::findings::{Code, Findings};
use crate::model::Model;
use crate::model::anthropometry::{Build, Human};
use crate::motion::RecordedTable;
use crate::numerics::{Smoothing, SplineDegree, SplineFitter};
use crate::optimal::{Observer, Solution};
use std::collections::BTreeMap;

/// Reads a file: takes its path as written in the scene, returns its bytes or an error message.
pub type ReadFile<'a> = dyn FnMut(&str) -> Result<Vec<u8>, String> + 'a;

/// A walk without external forces, and its source.
pub(super) struct PlannedWalk {
    pub(super) build: Build,
    pub(super) entry: WalkEntry,
    /// The figure with the soles of the plan.
    pub(super) human: Human,
    pub(super) solution: Solution,
    /// Settings and controller, once there is one.
    pub(super) controller: Option<(ControlSettings, WalkController)>,
}

impl PlannedWalk {
    /// Whether it is the walk of a figure at some speed [m/s]; `None`: the gait's own.
    pub(super) fn is_of(&self, build: &Build, entry: &WalkEntry, speed: Option<f64>) -> bool {
        let own = &self.entry;
        self.build == *build
            && (&own.gait, own.speed, own.mode) == (&entry.gait, speed, entry.mode)
            && own.lift.total_cmp(&entry.lift).is_eq()
    }
}

/// The files of a scene, read when needed; each table is read once.
pub(super) struct InputFiles<'a, 'f> {
    load: &'a mut ReadFile<'f>,
    tables: BTreeMap<String, RecordedTable>,
    /// Walks of this scene without outside forces, shared by figures of the same build.
    pub(super) planned: Vec<PlannedWalk>,
    pub(super) findings: &'a mut Findings,
    /// Duration of the scene [s].
    pub(super) duration_s: f64,
    /// Settings of its steps.
    pub(super) steps: StepSettings,
    /// Names of the joints of the scene, which machines of gaits read.
    pub(super) signals: Vec<String>,
    /// Follows the solver that plans walks.
    pub(super) observer: Observer,
}

impl<'a, 'f> InputFiles<'a, 'f> {
    pub(super) fn new(
        load: &'a mut ReadFile<'f>,
        findings: &'a mut Findings,
        duration_s: f64,
        steps: StepSettings,
    ) -> InputFiles<'a, 'f> {
        let (tables, planned, signals) = (BTreeMap::new(), Vec::new(), Vec::new());
        InputFiles { load, tables, planned, findings, duration_s, steps, signals, observer: Observer::default() }
    }

    pub(super) fn model(&mut self, place: &Place, path: &str) -> Result<Model, SceneError> {
        let bytes = (self.load)(path).map_err(|message| place.error(message))?;
        Model::from_osim(&bytes, self.findings).map_err(|e| place.error(format!("{path}: {}", chain(&e))))
    }

    pub(super) fn table(&mut self, place: &Place, path: &str) -> Result<RecordedTable, SceneError> {
        if let Some(table) = self.tables.get(path) {
            return Ok(table.clone());
        }
        let bytes = (self.load)(path).map_err(|message| place.error(message))?;
        let table = RecordedTable::read(&bytes, path, self.findings)
            .map_err(|e| place.error(format!("{path}: {}", chain(&e))))?;
        self.tables.insert(path.to_owned(), table.clone());
        Ok(table)
    }

    /// A file as text.
    pub(super) fn text(&mut self, place: &Place, path: &str) -> Result<String, SceneError> {
        let bytes = (self.load)(path).map_err(|message| place.error(message))?;
        String::from_utf8(bytes).map_err(|e| {
            let at = e.utf8_error().valid_up_to();
            place.error(format!("{path}: byte {at} is not UTF-8; expected text"))
        })
    }

    /// Converts a function of the part at `of` to a signal; `turns` states that it is an angle.
    pub(super) fn signal(&mut self, of: &Place, function: &TimeFunction, turns: bool) -> Result<Signal, SceneError> {
        Ok(match function {
            TimeFunction::Constant(value) => Signal::Constant(*value),
            TimeFunction::Sine { amplitude, frequency_hz, phase, offset } => {
                Signal::Sine { amplitude: *amplitude, frequency_hz: *frequency_hz, phase: *phase, offset: *offset }
            }
            TimeFunction::Stops(stops) => Signal::Stops(stops.clone()),
            TimeFunction::Points(points) => {
                let (times, values): (Vec<f64>, Vec<f64>) = four_or_more(points).into_iter().unzip();
                let fitter = SplineFitter::new(SplineDegree::Cubic, &times);
                let spline = fitter.and_then(|fitter| fitter.fit(&values, Smoothing::Interpolate));
                Signal::Spline(spline.map_err(|e| of.error(e.to_string()))?, 0.0)
            }
            TimeFunction::Motion { place, file, column, from_s } => {
                let table = self.table(place, file)?;
                let (spline, span) = table
                    .column(column, turns, self.findings)
                    .map_err(|e| place.error(format!("{file}: {}", chain(&e))))?;
                Signal::Spline(spline, self.start(place, file, span, *from_s)?)
            }
        })
    }

    /// The time of a recording at which the scene begins; a recording that ends before the scene gives a finding.
    pub(super) fn start(
        &mut self,
        place: &Place,
        file: &str,
        [first, last]: [f64; 2],
        from_s: Option<f64>,
    ) -> Result<f64, SceneError> {
        let start = from_s.unwrap_or(first);
        if !(first..=last).contains(&start) {
            let message =
                format!("{file}: found `from` = {start} s; expected a time of the recording, {first} s to {last} s");
            return Err(place.error(message));
        }
        // Rounding of times with four decimals.
        const ROUNDED_CLOCK_S: f64 = 1e-4;
        if start + self.duration_s > last + ROUNDED_CLOCK_S {
            let message = format!(
                "{file} ends {:.3} s after the scene begins; its last values are used from then on, so the motion \
                 stops within \
                 one step",
                last - start
            );
            self.findings.report(Code::MotionShorterThanScene, message);
        }
        Ok(start)
    }
}

/// Adds points on the natural cubic spline, because its fit requires at least four.
fn four_or_more(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    match *points {
        // A straight line.
        [(t0, y0), (t1, y1)] => {
            [0.0, 1.0, 2.0, 3.0].map(|k| (t0 + (t1 - t0) * k / 3.0, y0 + (y1 - y0) * k / 3.0)).to_vec()
        }
        // 2 (h₁ + h₂) y₁'' = 6 ((y₂ - y₁)/h₂ - (y₁ - y₀)/h₁); in the middle of the first piece (y₀ + y₁)/2 - y₁''
        // h₁²/16.
        [first @ (t0, y0), second @ (t1, y1), third @ (t2, y2)] => {
            let (h1, h2) = (t1 - t0, t2 - t1);
            let bend = 3.0 * ((y2 - y1) / h2 - (y1 - y0) / h1) / (h1 + h2);
            vec![first, (t0 + 0.5 * h1, 0.5 * (y0 + y1) - bend * h1 * h1 / 16.0), second, third]
        }
        _ => points.to_vec(),
    }
}
