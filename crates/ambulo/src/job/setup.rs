//! Set-ups of OpenSim's tools: their files and settings in place of fields that were left open.

use super::error::{At, Field, JobError};
use super::files::{ending, read as read_file, read_table as read_table_of};
use super::laboratory::read_standing_trial;
use super::setup_values::{fill, replaced};
use super::values::{Cutoff, EarthTurn, ForceCutoff, HeadingAxis, ModelChoice};
use super::{Job, Reading};
use crate::findings::{Code, Findings};
use crate::model::Model;
use crate::study::{
    GroundSettings, LaboratoryFile, ModelProtocol, TrackedTasks, exclude_bushings, report_forces_of_model,
    scaling_of_setup,
};
use ambulo_formats::osim::OsimModel;
use ambulo_formats::setup::{
    InverseDynamicsSetup, InverseKinematicsSetup, ScaleSetup, SensorKinematicsSetup, SensorPlacerSetup, Setup,
};
use ambulo_formats::table::Table;
use std::path::{Path, PathBuf};

/// A set-up and its file.
#[derive(Debug, Clone)]
struct Stated<S> {
    path: PathBuf,
    setup: S,
}

/// The set-ups of a run, at most one of each tool.
#[derive(Debug, Clone, Default)]
pub(super) struct Setups {
    scale: Option<Stated<ScaleSetup>>,
    kinematics: Option<Stated<InverseKinematicsSetup>>,
    dynamics: Option<Stated<InverseDynamicsSetup>>,
    placer: Option<Stated<SensorPlacerSetup>>,
    sensors: Option<Stated<SensorKinematicsSetup>>,
}

impl<S> Stated<S> {
    /// A path of the set-up, from the folder of its file.
    fn file(&self, named: Option<&String>) -> Option<PathBuf> {
        let folder = self.path.parent().unwrap_or(Path::new(""));
        named.map(|named| plain(&folder.join(named)))
    }
}

/// A path without `.` and without `folder/..`.
fn plain(path: &Path) -> PathBuf {
    use std::path::Component::{CurDir, Normal, ParentDir};
    let mut parts = Vec::new();
    for part in path.components() {
        match (part, parts.last()) {
            (CurDir, _) => {}
            (ParentDir, Some(Normal(_))) => drop(parts.pop()),
            _ => parts.push(part),
        }
    }
    parts.into_iter().collect()
}

/// The job with what the set-ups state in place of fields that were open; findings name what was replaced or not used.
pub(super) fn resolved(job: &Job, reading: &mut Reading<'_>) -> Result<Job, JobError> {
    if job.setups.is_empty() {
        return Ok(job.clone());
    }
    let setups = Setups::read(&job.setups, reading)?;
    let mut resolved = job.clone();
    setups.check(job)?;
    setups.fill_model(&mut resolved, reading.findings)?;
    setups.fill_recording(&mut resolved, reading.findings)?;
    setups.fill_scaling(&mut resolved, reading.findings);
    setups.fill_sensors(&mut resolved, reading.findings);
    setups.fill_dynamics(&mut resolved, reading.findings);
    reading.setups = setups;
    Ok(resolved)
}

impl Setups {
    fn read(paths: &[PathBuf], reading: &mut Reading<'_>) -> Result<Setups, JobError> {
        let mut setups = Setups::default();
        for path in paths {
            let shown = path.display().to_string();
            let bytes = read_file(reading.files, path)?;
            let (setup, remarks) = Setup::read_with(&bytes, &mut |set| read_set(path, set, reading)).in_file(path)?;
            for remark in &remarks {
                reading.findings.report(Code::SetupUnused, format!("{shown}: {remark}"));
            }
            reading.read.push(path.clone());
            let (tool, path) = (setup.tool(), path.clone());
            let before = match setup {
                Setup::Scale(setup) => setups.scale.replace(Stated { path, setup }).map(|s| s.path),
                Setup::InverseKinematics(setup) => setups.kinematics.replace(Stated { path, setup }).map(|s| s.path),
                Setup::InverseDynamics(setup) => setups.dynamics.replace(Stated { path, setup }).map(|s| s.path),
                Setup::SensorPlacer(setup) => setups.placer.replace(Stated { path, setup }).map(|s| s.path),
                Setup::SensorKinematics(setup) => setups.sensors.replace(Stated { path, setup }).map(|s| s.path),
            };
            if let Some(before) = before {
                let what = format!("a second set-up of {tool}, after {}; expected one of each tool", before.display());
                return Err(JobError::new(&[], what).within(shown));
            }
        }
        Ok(setups)
    }

    /// Whether markers are fitted as a set-up states.
    pub(super) fn has_markers(&self) -> bool {
        self.scale.is_some() || self.kinematics.is_some()
    }

    /// The set-up that needs orientations of sensors as the recording.
    pub(super) fn of_sensors(&self) -> Option<&Path> {
        let placer = self.placer.as_ref().map(|s| s.path.as_path());
        self.sensors.as_ref().map(|s| s.path.as_path()).or(placer)
    }

    /// Whether the sensors are those that the model has: inverse kinematics without a placement.
    pub(super) fn uses_placed_sensors(&self) -> bool {
        self.sensors.is_some() && self.placer.is_none()
    }

    /// Weights of sensors; `None` without a set-up that states some.
    pub(super) fn sensor_weights(&self) -> Option<TrackedTasks> {
        let weights = &self.sensors.as_ref()?.setup.weights;
        let tracked = || TrackedTasks { weights: weights.iter().cloned().collect(), tasks: Vec::new() };
        (!weights.is_empty()).then(tracked)
    }

    /// Names of forces of the model that a set-up excludes.
    pub(super) fn excluded_forces(&self) -> &[String] {
        self.dynamics.as_ref().map_or(&[], |dynamics| &dynamics.setup.forces_to_exclude)
    }

    /// Removes forces of the model that a set-up excludes.
    pub(super) fn exclude_forces(&self, document: &mut OsimModel) {
        if let Some(dynamics) = &self.dynamics {
            exclude_bushings(document, &dynamics.setup);
        }
    }

    /// Rejects options that contradict the set-ups.
    fn check(&self, job: &Job) -> Result<(), JobError> {
        let refused = |fields: &[Field], what: String| Err(JobError::new(fields, what));
        if let (Some(sensors), true) = (self.of_sensors(), self.has_markers()) {
            return refused(
                &[],
                format!(
                    "{} is for sensors, and another set-up is for markers; expected one of both. hint: scale the model \
                     first, and place the sensors on the subject.osim of that run",
                    sensors.display()
                ),
            );
        }
        if let (Some(scale), true) = (&self.scale, job.size.height_m.is_some()) {
            let what = format!("the height contradicts {}, which states how the model is scaled", scale.path.display());
            return refused(&[Field::Height], format!("{what}; expected one of both"));
        }
        if self.scale.is_none() && job.standing.is_some() && self.kinematics.is_some() {
            let what = "the standing trial would scale the model, which a set-up of InverseKinematicsTool uses as it \
                is; expected a set-up of ScaleTool as well, or none";
            return refused(&[Field::Standing], what.to_owned());
        }
        if let (Some(scale), None, Some(dynamics), None) =
            (&self.scale, &self.kinematics, &self.dynamics, &job.recording)
        {
            return refused(
                &[Field::Recording],
                format!(
                    "{} names coordinates, and {} scales a model by markers; expected a set-up of \
                     InverseKinematicsTool, or the recorded markers, as well",
                    dynamics.path.display(),
                    scale.path.display()
                ),
            );
        }
        Ok(())
    }

    /// The model before scaling or without sensors, or else the model of the later tools.
    fn fill_model(&self, job: &mut Job, findings: &mut Findings) -> Result<(), JobError> {
        let of_kinematics = self.kinematics.as_ref().and_then(|s| s.file(s.setup.model_file.as_ref()));
        let of_sensors = self.sensors.as_ref().and_then(|s| s.file(s.setup.model_file.as_ref()));
        let of_dynamics = self.dynamics.as_ref().and_then(|s| s.file(s.setup.model_file.as_ref()));
        let later: Vec<&PathBuf> = of_kinematics.iter().chain(&of_sensors).chain(&of_dynamics).collect();
        let stated = match self.first_model() {
            Some((file, use_of_it)) => {
                for model in &later {
                    let message = format!("{} was not read; the model {use_of_it} was used", model.display());
                    findings.report(Code::SetupUnused, message);
                }
                file
            }
            None => {
                if let ([a, b], None) = (&later[..], &job.model)
                    && a != b
                {
                    let what = format!(
                        "the set-ups name two models, {} and {}; expected one, or a choice for the whole run",
                        a.display(),
                        b.display()
                    );
                    return Err(JobError::new(&[Field::Model], what));
                }
                later.first().map(|file| (*file).clone())
            }
        };
        fill(&mut job.model, stated.map(ModelChoice::from), Field::Model, findings);
        if job.model.is_none() {
            let what = "the set-up names no <model_file>; expected one, or an .osim as the model";
            return Err(JobError::new(&[Field::Model], what));
        }
        Ok(())
    }

    /// The model of the tool that makes the model of the later ones, and what is done with it.
    fn first_model(&self) -> Option<(Option<PathBuf>, String)> {
        let scale = self.scale.as_ref();
        let scaled = scale.map(|s| (s.file(s.setup.model_file.as_ref()), format!("that {} scales", s.path.display())));
        let placer = self.placer.as_ref();
        let placed = placer
            .map(|s| (s.file(s.setup.model_file.as_ref()), format!("on which {} places sensors", s.path.display())));
        scaled.or(placed)
    }

    /// The recording: markers or sensors of inverse kinematics, coordinates of inverse dynamics, or the standing trial
    /// of scaling or placing alone.
    fn fill_recording(&self, job: &mut Job, findings: &mut Findings) -> Result<(), JobError> {
        let markers = self.kinematics.as_ref().and_then(|s| s.file(s.setup.marker_file.as_ref()));
        let coordinates = self.dynamics.as_ref().and_then(|s| s.file(s.setup.coordinates_file.as_ref()));
        let standing = self.scale.as_ref().and_then(|s| s.file(self.standing_file().as_ref()));
        let others = [(self.has_markers(), "markers"), (self.of_sensors().is_some(), "sensors")];
        if let (Some(coordinates), Some((_, what))) = (&coordinates, others.iter().find(|(is_used, _)| *is_used)) {
            let message = format!("{} was not read; the coordinates are those of the {what}", coordinates.display());
            findings.report(Code::SetupUnused, message);
        }
        let sensors = self.sensors.as_ref().and_then(|s| s.file(s.setup.orientations_file.as_ref()));
        let stated = match others {
            [(true, _), _] => markers.or(standing),
            [_, (true, _)] => sensors.or(self.standing_sensors()),
            _ => coordinates,
        };
        fill(&mut job.recording, stated, Field::Recording, findings);
        match &job.recording {
            Some(_) => Ok(()),
            None => {
                let what = "the set-up names no recording (<marker_file>, <orientations_file> or <coordinates_file>); \
                    expected one";
                Err(JobError::new(&[Field::Recording], what))
            }
        }
    }

    /// The trial in which markers are placed, or else distances are measured.
    fn standing_file(&self) -> Option<String> {
        let setup = &self.scale.as_ref()?.setup;
        let of_placer = setup.placer.as_ref().and_then(|placer| placer.marker_file.clone());
        of_placer.or_else(|| setup.scaler.as_ref()?.marker_file.clone())
    }

    fn fill_scaling(&self, job: &mut Job, findings: &mut Findings) {
        let Some(scale) = &self.scale else { return };
        let set = scale.file(scale.setup.marker_set_file.as_ref());
        match set {
            Some(file) if ending(&file) != "xml" && ending(&file) != "osim" => {
                let message = format!(
                    "{} is no file of a marker set, and OpenSim adds no marker from it either; the markers are those \
                     of the model",
                    file.display()
                );
                findings.report(Code::SetupUnused, message);
            }
            set => fill(&mut job.marker_set, set, Field::MarkerSet, findings),
        }
        if scale.setup.placer.is_some() {
            fill(&mut job.standing, scale.file(self.standing_file().as_ref()), Field::Standing, findings);
        }
        replaced(job.size.mass_kg, scale.setup.mass_kg, Field::Mass, findings);
    }

    /// Orientations of the sensors while the person stands.
    fn standing_sensors(&self) -> Option<PathBuf> {
        self.placer.as_ref().and_then(|s| s.file(s.setup.orientations_file.as_ref()))
    }

    /// Standing posture, heading and earth of sensors.
    fn fill_sensors(&self, job: &mut Job, findings: &mut Findings) {
        let of_placer = self.placer.as_ref().map(|s| s.setup.earth_rad);
        let of_kinematics = self.sensors.as_ref().map(|s| s.setup.earth_rad);
        if let (Some(used), Some(other)) = (of_placer, of_kinematics)
            && EarthTurn(used) != EarthTurn(other)
        {
            let message = format!(
                "sensor_to_opensim_rotations {other:?} of IMUInverseKinematicsTool were not used: those of IMUPlacer, \
                 {used:?}, apply to both"
            );
            findings.report(Code::SetupUnused, message);
        }
        fill(&mut job.sensors.earth, of_placer.or(of_kinematics).map(EarthTurn), Field::Earth, findings);
        let heading = self.placer.as_ref().and_then(|s| s.setup.heading.as_ref());
        let heading = heading.map(|stated| HeadingAxis::of(&stated.sensor, stated.axis, stated.is_negative));
        fill(&mut job.sensors.heading, heading, Field::Heading, findings);
        fill(&mut job.standing, self.standing_sensors(), Field::Standing, findings);
    }

    /// Loads, filters and times; inverse dynamics of OpenSim leaves loads unfiltered.
    fn fill_dynamics(&self, job: &mut Job, findings: &mut Findings) {
        let of_sensors = self.sensors.as_ref().and_then(|s| s.setup.time_range);
        let of_kinematics = self.kinematics.as_ref().and_then(|s| s.setup.time_range).or(of_sensors);
        let of_dynamics = self.dynamics.as_ref().and_then(|s| s.setup.time_range);
        if let (Some(used), Some([from, to])) = (of_dynamics, of_kinematics.filter(|range| of_dynamics != Some(*range)))
        {
            let message = format!(
                "the time range {from} to {to} s of inverse kinematics was not used: all is computed in that of \
                 InverseDynamicsTool, {} to {} s",
                used[0], used[1]
            );
            findings.report(Code::SetupUnused, message);
        }
        if let Some([from, to]) = of_dynamics.or(of_kinematics) {
            let end = |s: f64| s.is_finite().then_some(s);
            fill(&mut job.settings.window.from_s, end(from), Field::From, findings);
            fill(&mut job.settings.window.to_s, end(to), Field::To, findings);
        }
        let Some(dynamics) = &self.dynamics else { return };
        report_forces_of_model(&dynamics.setup, findings);
        fill(&mut job.settings.cutoff, Some(Cutoff(dynamics.setup.cutoff_hz)), Field::Cutoff, findings);
        job.settings.force_cutoff.get_or_insert(ForceCutoff::Off);
        let loads = dynamics.file(dynamics.setup.external_loads_file.as_ref());
        // Predicted forces are compared with the measured ones.
        let ground = job.settings.ground;
        let chooses_other_forces = job.forces.table.is_some() || ground == GroundSettings::NoContact;
        let needs_no_forces =
            chooses_other_forces || matches!(ground, GroundSettings::Predicted | GroundSettings::Tracked);
        match loads {
            Some(loads) if chooses_other_forces && job.forces.loads.is_none() => {
                let message = format!("{} was not read: an option chooses other ground forces", loads.display());
                findings.report(Code::SetupReplaced, message);
            }
            None if job.forces.loads.is_none() && !needs_no_forces => {
                job.settings.ground = GroundSettings::NoContact;
                let message = format!(
                    "{} names no external loads: nothing but gravity acts on the model",
                    dynamics.path.display()
                );
                findings.report(Code::SetupUnused, message);
            }
            loads => fill(&mut job.forces.loads, loads, Field::Loads, findings),
        }
    }

    /// The protocol of a model whose markers are fitted as the set-ups state; `None` without such set-ups.
    pub(super) fn protocol(
        &self,
        model: &Model,
        reading: &mut Reading<'_>,
    ) -> Result<Option<Box<ModelProtocol>>, JobError> {
        if !self.has_markers() {
            return Ok(None);
        }
        let Some(scale) = &self.scale else { return Ok(Some(Box::default())) };
        let placer = scale.setup.placer.as_ref();
        let following = placer.filter(|placer| placer.tasks.follow_file());
        let coordinates = scale.file(following.and_then(|placer| placer.coordinate_file.as_ref()));
        let coordinates = coordinates.map(|path| read_table(&path, reading)).transpose()?;
        let scaling =
            scaling_of_setup(&scale.setup, model, coordinates.as_ref(), reading.findings).in_file(&scale.path)?;
        let scaler = scale.setup.scaler.as_ref().filter(|scaler| !scaler.measurements.is_empty());
        let measured = scale.file(scaler.and_then(|scaler| scaler.marker_file.as_ref()));
        let measured = measured.map(|path| read_standing_trial(&path, reading)).transpose()?;
        let measured = measured.map(|LaboratoryFile { recording, .. }| recording);
        Ok(Some(Box::new(ModelProtocol { scaling: Some(scaling), measured })))
    }

    /// The weights of the fit of the recording.
    pub(super) fn tasks(&self, model: &Model, reading: &mut Reading<'_>) -> Result<Option<TrackedTasks>, JobError> {
        let Some(kinematics) = &self.kinematics else { return Ok(None) };
        let file = kinematics.setup.coordinate_file.as_ref().filter(|_| kinematics.setup.tasks.follow_file());
        let coordinates = kinematics.file(file);
        let coordinates = coordinates.map(|path| read_table(&path, reading)).transpose()?;
        TrackedTasks::of_setup(&kinematics.setup.tasks, model, coordinates.as_ref(), reading.findings)
            .map(Some)
            .in_file(&kinematics.path)
    }
}

/// The file of a set that a set-up names, from the folder of the set-up.
fn read_set(setup: &Path, named: &str, reading: &mut Reading<'_>) -> Result<Vec<u8>, String> {
    let file = plain(&setup.parent().unwrap_or(Path::new("")).join(named));
    let bytes = reading.files.read(&file).map_err(|error| error.to_string())?;
    reading.read.push(file);
    Ok(bytes)
}

fn read_table(path: &Path, reading: &mut Reading<'_>) -> Result<Table, JobError> {
    let table = read_table_of(reading.files, path, reading.findings)?;
    reading.read.push(path.to_owned());
    Ok(table)
}
