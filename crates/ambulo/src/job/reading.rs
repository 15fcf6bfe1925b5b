//! Reads the files of a job.

use super::error::{Field, JobError};
use super::files::{Files, read_table};
use super::kind::RecordingKind;
use super::setup::Setups;
use super::{
    Job, Reading, Shared, coordinates, markers, muscle_reading, sensors, settings, setup, size, skeleton, study_error,
    subject,
};
use crate::analysis::Stage;
use crate::findings::Findings;
use crate::study::{self, MarkerBody, Outcome, Recording, Settings, Source};
use std::ops::ControlFlow;
use std::path::PathBuf;

/// A job whose files were read: all that [`study::run`] needs.
#[derive(Debug, Clone)]
pub struct ReadJob {
    /// The job, with what the set-ups state in place of fields that were open.
    pub job: Job,
    /// The recording.
    pub source: Source,
    /// How the recording is processed.
    pub settings: Settings,
    /// Every file that was read, in this order.
    pub files: Vec<PathBuf>,
    /// The table of ground forces, if one was read.
    pub ground: Option<PathBuf>,
}

/// Access to the files of a job, and where its findings go.
pub struct Reader<'a> {
    /// The files.
    pub files: &'a mut dyn Files,
    /// Data that other jobs of the person have read.
    pub shared: &'a Shared,
    /// Findings about the files.
    pub findings: &'a mut Findings,
    /// Called with a word when a part of the files has been read.
    pub progress: &'a mut dyn FnMut(&'static str),
}

impl Job {
    /// Reads all files.
    ///
    /// # Errors
    /// A file that cannot be read or used; fields that contradict each other or have no effect on the recording.
    pub fn read(&self, files: &mut dyn Files, findings: &mut Findings) -> Result<ReadJob, JobError> {
        self.read_with(Reader { files, shared: &Shared::default(), findings, progress: &mut |_| {} })
    }

    /// As [`Job::read`], with what other jobs share.
    ///
    /// # Errors
    /// As [`Job::read`].
    pub fn read_with(&self, reader: Reader<'_>) -> Result<ReadJob, JobError> {
        let Reader { files, shared, findings, progress } = reader;
        let mut reading = Reading {
            files,
            standing_trials: shared.standing_trials.clone(),
            models: shared.models.clone(),
            findings,
            progress,
            read: Vec::new(),
            ground: None,
            setups: Setups::default(),
            own_model: None,
            tracked: None,
        };
        let job = setup::resolved(self, &mut reading)?;
        let source = job.source(&mut reading, shared)?;
        let Reading { files, read, ground, tracked, .. } = reading;
        let settings = settings::read(&job, tracked, files)?;
        Ok(ReadJob { job, source, settings, files: read, ground })
    }

    fn source(&self, reading: &mut Reading<'_>, shared: &Shared) -> Result<Source, JobError> {
        self.check_range()?;
        size::check(self.size).map_err(|error| error.within(self.shown()))?;
        reading.read.push(self.recording().to_owned());
        let kind = RecordingKind::of(self.recording(), reading.files)?;
        self.check_kind(kind, &reading.setups)?;
        let source = match kind {
            RecordingKind::Coordinates => coordinates::read(self, reading)?,
            RecordingKind::Markers => markers::read(self, reading)?,
            RecordingKind::Skeleton => skeleton::read(self, reading)?,
            RecordingKind::Smpl => skeleton::read_smpl(self, reading)?,
            RecordingKind::Subject => subject::read(self, reading)?,
            RecordingKind::Sensors => sensors::read(self, reading)?,
        };
        let device =
            self.device.as_deref().map(|path| read_table(reading.files, path, reading.findings)).transpose()?;
        let muscles = muscle_reading::read(self, reading)?;
        let mut source = Source { device, muscles, ..source };
        if let (Recording::Markers(markers), Some(body)) = (&mut source.recording, &shared.body) {
            markers.body = MarkerBody::Calibrated(Box::new(body.clone()));
        }
        reading.read.extend(self.device.iter().chain(&self.thresholds).chain(&self.person).cloned());
        Ok(source)
    }

    /// Rejects statements about another kind of recording.
    fn check_kind(&self, kind: RecordingKind, setups: &Setups) -> Result<(), JobError> {
        let refused = |field: Field, what: String| Err(JobError::new(&[field], what).within(self.shown()));
        if self.trial.is_some() && kind != RecordingKind::Subject {
            return refused(Field::Trial, "a trial is chosen in a .b3d; this file has one recording".into());
        }
        if kind != RecordingKind::Sensors {
            if let Some(setup) = setups.of_sensors() {
                let needed = "needs orientations of sensors (.sto with quaternions) as the recording";
                return refused(Field::Recording, format!("{} {needed}; this is another recording", setup.display()));
            }
            let given =
                [(Field::Heading, self.sensors.heading.is_some()), (Field::Earth, self.sensors.earth.is_some())];
            if let Some((field, _)) = given.into_iter().find(|(_, is_given)| *is_given) {
                let what = "is for orientations of sensors (.sto with quaternions); this is another recording";
                return refused(field, format!("the {} {what}", field.name()));
            }
        }
        if self.smpl.is_some() && kind != RecordingKind::Smpl {
            let what = "an SMPL model gives a motion of the SMPL family (.npz) its lengths; this file has its own";
            return refused(Field::Smpl, what.into());
        }
        Ok(())
    }
}

impl ReadJob {
    /// Computes the forces.
    ///
    /// # Errors
    /// A recording that gives no forces, with the file or field concerned.
    pub fn run(self, findings: &mut Findings) -> Result<Outcome, JobError> {
        self.run_observed(findings, &mut |_| ControlFlow::Continue(()))
    }

    /// As [`ReadJob::run`]; reports the end of each stage to the caller, who may stop the computation.
    ///
    /// # Errors
    /// As [`ReadJob::run`].
    pub fn run_observed(
        self,
        findings: &mut Findings,
        watch: &mut dyn FnMut(Stage) -> ControlFlow<()>,
    ) -> Result<Outcome, JobError> {
        let ReadJob { job, source, settings, ground, .. } = self;
        study::run_observed(source, &settings, findings, watch)
            .map_err(|error| study_error::located(error, &job, ground.as_deref()))
    }
}
