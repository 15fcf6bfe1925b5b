//! Set-ups of OpenSim's tools: their files and settings in place of options that were not given.

use super::Reading;
use crate::args::{Cutoff, ForceCutoff, ForcesArgs};
use crate::files;
use ambulo::findings::{Code, Findings};
use ambulo::model::Model;
use ambulo::study::{LaboratoryFile, ModelProtocol, TrackedTasks, report_forces_of_model, scaling_of_setup};
use ambulo_formats::setup::{InverseDynamicsSetup, InverseKinematicsSetup, ScaleSetup, Setup};
use ambulo_formats::table::Table;
use anyhow::{Context, Result, bail};
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

/// The options with what the set-ups state in place of those that were not given; findings name what was replaced or not used.
pub(super) fn resolved(args: &ForcesArgs, reading: &mut Reading) -> Result<ForcesArgs> {
    if args.setup.is_empty() {
        return Ok(args.clone());
    }
    let setups = Setups::read(&args.setup, reading)?;
    let mut resolved = args.clone();
    setups.check(args)?;
    setups.fill_model(&mut resolved, &mut reading.findings)?;
    setups.fill_recording(&mut resolved, &mut reading.findings)?;
    setups.fill_scaling(&mut resolved, &mut reading.findings);
    setups.fill_dynamics(&mut resolved, &mut reading.findings);
    reading.setups = setups;
    Ok(resolved)
}

impl Setups {
    fn read(paths: &[PathBuf], reading: &mut Reading) -> Result<Setups> {
        let mut setups = Setups::default();
        for path in paths {
            let shown = path.display().to_string();
            let (setup, remarks) =
                Setup::read(&files::read_input(&reading.caller, path)?).with_context(|| shown.clone())?;
            for remark in &remarks {
                reading.findings.report(Code::SetupUnused, format!("{shown}: {remark}"));
            }
            reading.read.push(path.clone());
            let (tool, path) = (setup.tool(), path.clone());
            let before = match setup {
                Setup::Scale(setup) => setups.scale.replace(Stated { path, setup }).map(|s| s.path),
                Setup::InverseKinematics(setup) => setups.kinematics.replace(Stated { path, setup }).map(|s| s.path),
                Setup::InverseDynamics(setup) => setups.dynamics.replace(Stated { path, setup }).map(|s| s.path),
            };
            if let Some(before) = before {
                bail!("{shown}: a second set-up of {tool}, after {}; expected one of each tool", before.display());
            }
        }
        Ok(setups)
    }

    /// Whether markers are fitted as a set-up says.
    pub(super) fn has_markers(&self) -> bool {
        self.scale.is_some() || self.kinematics.is_some()
    }

    /// Rejects options that contradict the set-ups.
    fn check(&self, args: &ForcesArgs) -> Result<()> {
        if let (Some(scale), true) = (&self.scale, args.subject.height.is_some()) {
            bail!(
                "--height contradicts {}, which states how the model is scaled; expected one of both",
                scale.path.display()
            );
        }
        if self.scale.is_none() && args.subject.still.is_some() && self.kinematics.is_some() {
            bail!(
                "--static would scale the model, which a set-up of InverseKinematicsTool uses as it is; expected a set-up of ScaleTool as well, or none"
            );
        }
        if let (Some(scale), None, Some(dynamics), None) = (&self.scale, &self.kinematics, &self.dynamics, &args.input)
        {
            bail!(
                "{} names coordinates, and {} scales a model by markers; expected a set-up of InverseKinematicsTool, or the recorded markers, as well",
                dynamics.path.display(),
                scale.path.display()
            );
        }
        Ok(())
    }

    /// The model before scaling, or the model of the later tools.
    fn fill_model(&self, args: &mut ForcesArgs, findings: &mut Findings) -> Result<()> {
        let of_kinematics = self.kinematics.as_ref().and_then(|s| s.file(s.setup.model_file.as_ref()));
        let of_dynamics = self.dynamics.as_ref().and_then(|s| s.file(s.setup.model_file.as_ref()));
        let of_scale = self.scale.as_ref().and_then(|s| s.file(s.setup.model_file.as_ref()));
        let later: Vec<&PathBuf> = of_kinematics.iter().chain(&of_dynamics).collect();
        if let Some(scale) = &self.scale {
            for model in &later {
                let message = format!(
                    "{} was not read; the model that {} scales was used",
                    model.display(),
                    scale.path.display()
                );
                findings.report(Code::SetupUnused, message);
            }
        } else if let ([a, b], None) = (&later[..], &args.model)
            && a != b
        {
            bail!(
                "the set-ups name two models, {} and {}; expected one. hint: --model FILE chooses one for the whole run",
                a.display(),
                b.display()
            );
        }
        let stated = if self.scale.is_some() { of_scale } else { of_kinematics.or(of_dynamics) };
        fill(&mut args.model, stated, "--model", findings);
        if args.model.is_none() {
            bail!("the set-up names no <model_file>; expected one, or --model FILE.osim");
        }
        Ok(())
    }

    /// The recording: markers of inverse kinematics, coordinates of inverse dynamics, or the standing trial of scaling alone.
    fn fill_recording(&self, args: &mut ForcesArgs, findings: &mut Findings) -> Result<()> {
        let markers = self.kinematics.as_ref().and_then(|s| s.file(s.setup.marker_file.as_ref()));
        let coordinates = self.dynamics.as_ref().and_then(|s| s.file(s.setup.coordinates_file.as_ref()));
        let standing = self.scale.as_ref().and_then(|s| s.file(self.standing_file().as_ref()));
        if let (Some(coordinates), true) = (&coordinates, self.has_markers()) {
            let message = format!("{} was not read; the coordinates are those of the markers", coordinates.display());
            findings.report(Code::SetupUnused, message);
        }
        let stated = if self.has_markers() { markers.or(standing) } else { coordinates };
        fill(&mut args.input, stated, "the recording", findings);
        match &args.input {
            Some(_) => Ok(()),
            None => bail!(
                "the set-up names no recording (<marker_file> or <coordinates_file>); expected one, or the recording before the options"
            ),
        }
    }

    /// The trial in which markers are placed, or else distances are measured.
    fn standing_file(&self) -> Option<String> {
        let setup = &self.scale.as_ref()?.setup;
        let of_placer = setup.placer.as_ref().and_then(|placer| placer.marker_file.clone());
        of_placer.or_else(|| setup.scaler.as_ref()?.marker_file.clone())
    }

    fn fill_scaling(&self, args: &mut ForcesArgs, findings: &mut Findings) {
        let Some(scale) = &self.scale else { return };
        let set = scale.file(scale.setup.marker_set_file.as_ref());
        match set {
            Some(file) if files::ending(&file) != "xml" && files::ending(&file) != "osim" => {
                let message = format!(
                    "{} is no file of a marker set, and OpenSim adds no marker from it either; the markers are those of the model",
                    file.display()
                );
                findings.report(Code::SetupUnused, message);
            }
            set => fill(&mut args.subject.marker_set, set, "--marker-set", findings),
        }
        if scale.setup.placer.is_some() {
            fill(&mut args.subject.still, scale.file(self.standing_file().as_ref()), "--static", findings);
        }
        replaced(args.subject.mass, scale.setup.mass_kg, "--mass", findings);
    }

    /// Loads, filters and times; inverse dynamics of OpenSim leaves loads unfiltered.
    fn fill_dynamics(&self, args: &mut ForcesArgs, findings: &mut Findings) {
        let of_kinematics = self.kinematics.as_ref().and_then(|s| s.setup.time_range);
        let of_dynamics = self.dynamics.as_ref().and_then(|s| s.setup.time_range);
        if let (Some(used), Some([from, to])) = (of_dynamics, of_kinematics.filter(|range| of_dynamics != Some(*range)))
        {
            let message = format!(
                "the time range {from} to {to} s of InverseKinematicsTool was not used: all is computed in that of InverseDynamicsTool, {} to {} s",
                used[0], used[1]
            );
            findings.report(Code::SetupUnused, message);
        }
        if let Some([from, to]) = of_dynamics.or(of_kinematics) {
            let end = |s: f64| s.is_finite().then_some(s);
            fill(&mut args.from, end(from), "--from", findings);
            fill(&mut args.to, end(to), "--to", findings);
        }
        let Some(dynamics) = &self.dynamics else { return };
        report_forces_of_model(&dynamics.setup, findings);
        fill(&mut args.cutoff, Some(Cutoff(dynamics.setup.cutoff_hz)), "--cutoff", findings);
        args.force_cutoff.get_or_insert(ForceCutoff::Off);
        let loads = dynamics.file(dynamics.setup.external_loads_file.as_ref());
        // Predicted forces are compared with the measured ones.
        let chooses_other_forces = args.grf.is_some() || args.no_ground;
        let needs_no_forces = chooses_other_forces || args.predict || args.track;
        match loads {
            Some(loads) if chooses_other_forces && args.loads.is_none() => {
                let message = format!("{} was not read: an option chooses other ground forces", loads.display());
                findings.report(Code::SetupReplaced, message);
            }
            None if args.loads.is_none() && !needs_no_forces => {
                args.no_ground = true;
                let message = format!(
                    "{} names no external loads: nothing but gravity acts on the model",
                    dynamics.path.display()
                );
                findings.report(Code::SetupUnused, message);
            }
            loads => fill(&mut args.loads, loads, "--loads", findings),
        }
    }

    /// The protocol of a model whose markers are fitted as the set-ups say; `None` without such set-ups.
    pub(super) fn protocol(&self, model: &Model, reading: &mut Reading) -> Result<Option<Box<ModelProtocol>>> {
        if !self.has_markers() {
            return Ok(None);
        }
        let Some(scale) = &self.scale else { return Ok(Some(Box::default())) };
        let placer = scale.setup.placer.as_ref();
        let coordinates = scale.file(placer.and_then(|placer| placer.coordinate_file.as_ref()));
        let coordinates = coordinates.map(|path| read_table(&path, reading)).transpose()?;
        let scaling = scaling_of_setup(&scale.setup, model, coordinates.as_ref(), &mut reading.findings)
            .with_context(|| scale.path.display().to_string())?;
        let scaler = scale.setup.scaler.as_ref().filter(|scaler| !scaler.measurements.is_empty());
        let measured = scale.file(scaler.and_then(|scaler| scaler.marker_file.as_ref()));
        let measured = measured.map(|path| super::markers::read_standing_trial(&path, reading)).transpose()?;
        let measured = measured.map(|LaboratoryFile { recording, .. }| recording);
        Ok(Some(Box::new(ModelProtocol { scaling: Some(scaling), measured })))
    }

    /// The weights of the fit of the recording.
    pub(super) fn tasks(&self, model: &Model, reading: &mut Reading) -> Result<Option<TrackedTasks>> {
        let Some(kinematics) = &self.kinematics else { return Ok(None) };
        let coordinates = kinematics.file(kinematics.setup.coordinate_file.as_ref());
        let coordinates = coordinates.map(|path| read_table(&path, reading)).transpose()?;
        TrackedTasks::of_setup(&kinematics.setup.tasks, model, coordinates.as_ref(), &mut reading.findings)
            .map(Some)
            .with_context(|| kinematics.path.display().to_string())
    }
}

fn read_table(path: &Path, reading: &mut Reading) -> Result<Table> {
    let (table, remarks) = files::read_table(&reading.caller, path)?;
    files::note_remarks(&path.display().to_string(), &remarks, &mut reading.findings);
    reading.read.push(path.to_owned());
    Ok(table)
}

/// The value of an option, or what a set-up states in its place.
fn fill<T: Clone + PartialEq + Shown>(option: &mut Option<T>, stated: Option<T>, name: &str, findings: &mut Findings) {
    replaced(option.clone(), stated.clone(), name, findings);
    if option.is_none() {
        *option = stated;
    }
}

/// Reports a value that replaces another one of a set-up.
fn replaced<T: PartialEq + Shown>(given: Option<T>, stated: Option<T>, name: &str, findings: &mut Findings) {
    if let (Some(given), Some(stated)) = (given, stated)
        && given != stated
    {
        let message = format!("{name} {} replaces {} of the set-up", given.shown(), stated.shown());
        findings.report(Code::SetupReplaced, message);
    }
}

/// A value in a message.
trait Shown {
    fn shown(&self) -> String;
}

impl Shown for PathBuf {
    fn shown(&self) -> String {
        self.display().to_string()
    }
}

impl Shown for f64 {
    fn shown(&self) -> String {
        self.to_string()
    }
}

impl Shown for Cutoff {
    fn shown(&self) -> String {
        self.to_string()
    }
}
