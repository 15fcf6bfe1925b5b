//! Files that a scene names: models, recordings and gait files, read by the caller.

use crate::findings::{Code, Findings};
use crate::model::Model;
use crate::motion::RecordedTable;
use crate::simulation::scene::SceneError;
use crate::simulation::scene::file::{CoordinateEntry, CoordinateMotion, TimeFunction};
use crate::simulation::{JointCoordinate, JointDrive, Motor, Signal};
use crate::toml_reader::{Place, with_causes};
use std::collections::BTreeMap;

/// A callback that reads a file: takes the path as in the scene file, returns the bytes or an error message.
pub type ReadFile<'a> = dyn FnMut(&str) -> Result<Vec<u8>, String> + 'a;

/// The files of a scene; each table is read once.
pub(super) struct InputFiles<'a, 'f> {
    load: &'a mut ReadFile<'f>,
    tables: BTreeMap<String, RecordedTable>,
    pub(super) findings: &'a mut Findings,
    /// Duration of the scene [s].
    pub(super) duration_s: f64,
}

impl<'a, 'f> InputFiles<'a, 'f> {
    pub(super) fn new(load: &'a mut ReadFile<'f>, findings: &'a mut Findings, duration_s: f64) -> InputFiles<'a, 'f> {
        InputFiles { load, tables: BTreeMap::new(), findings, duration_s }
    }

    pub(super) fn model(&mut self, place: &Place, path: &str) -> Result<Model, SceneError> {
        let bytes = (self.load)(path).map_err(|message| place.error(message))?;
        Model::from_osim(&bytes, self.findings).map_err(|e| place.error(format!("{path}: {}", with_causes(&e))))
    }

    pub(super) fn table(&mut self, place: &Place, path: &str) -> Result<RecordedTable, SceneError> {
        if let Some(table) = self.tables.get(path) {
            return Ok(table.clone());
        }
        let bytes = (self.load)(path).map_err(|message| place.error(message))?;
        let table = RecordedTable::read(&bytes, path, self.findings)
            .map_err(|e| place.error(format!("{path}: {}", with_causes(&e))))?;
        self.tables.insert(path.to_owned(), table.clone());
        Ok(table)
    }

    /// Reads a file as text.
    pub(super) fn text(&mut self, place: &Place, path: &str) -> Result<String, SceneError> {
        let bytes = (self.load)(path).map_err(|message| place.error(message))?;
        String::from_utf8(bytes).map_err(|e| {
            let at = e.utf8_error().valid_up_to();
            place.error(format!("{path}: byte {at} is not UTF-8; expected a text file"))
        })
    }

    /// A function of the scene as a signal; `turns` is true for angles.
    pub(super) fn signal(&mut self, function: &TimeFunction, turns: bool) -> Result<Signal, SceneError> {
        Ok(match function {
            TimeFunction::Given(signal) => signal.clone(),
            TimeFunction::Recorded { place, file, column, from_s } => {
                let table = self.table(place, file)?;
                let (spline, span) = table
                    .column(column, turns, self.findings)
                    .map_err(|e| place.error(format!("{file}: {}", with_causes(&e))))?;
                Signal::Spline(spline, self.start(place, file, span, *from_s)?)
            }
        })
    }

    /// What acts on a coordinate of the scene file.
    pub(super) fn actuation(&mut self, entry: &CoordinateEntry) -> Result<JointCoordinate, SceneError> {
        let turns = entry.kind == CoordinateMotion::Rotation;
        let drive = entry.drive.as_ref().map(|drive| -> Result<JointDrive, SceneError> {
            Ok(JointDrive { signal: self.signal(&drive.function, turns)?, max: drive.max })
        });
        let drive = drive.transpose()?;
        let motor = entry.motor.as_ref().map(|motor| -> Result<Motor, SceneError> {
            let target = self.signal(&motor.target, turns)?;
            Ok(Motor { target, kp: motor.stiffness, kd: motor.damping, max: motor.max })
        });
        Ok(JointCoordinate {
            drive,
            spring: entry.spring,
            motor: motor.transpose()?,
            limits: entry.limits,
            friction: entry.friction,
            ..JointCoordinate::default()
        })
    }

    /// The time of a recording at which the scene begins; warns if the scene lasts longer than the recording.
    pub(super) fn start(
        &mut self,
        place: &Place,
        file: &str,
        [first, last]: [f64; 2],
        from_s: Option<f64>,
    ) -> Result<f64, SceneError> {
        let start = from_s.unwrap_or(first);
        if !(first..=last).contains(&start) {
            let message = format!(
                "{file}: found `from` = {start} s; expected a time of the recording, from {first} s to {last} s"
            );
            return Err(place.error(message));
        }
        // Rounding of times printed with four digits.
        const ROUNDED_CLOCK_S: f64 = 1e-4;
        if start + self.duration_s > last + ROUNDED_CLOCK_S {
            let message = format!(
                "{file} ends {:.3} s after the scene begins; its last values are used from then on, and what follows them \
                 stops within one step",
                last - start
            );
            self.findings.report(Code::MotionShorterThanScene, message);
        }
        Ok(start)
    }
}
