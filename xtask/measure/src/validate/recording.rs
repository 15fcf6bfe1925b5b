//! The recordings with plates, and how they are read.

use super::{further_people, people};
use ambulo::findings::Findings;
use ambulo::ground::predict::{FittedParameters, PersonalErrors, PredictSettings, Prescribed};
use ambulo::job::{FileError, FootColumns, ForceFiles, Job, ModelChoice};
use ambulo::model::{BodyId, Marker};
use ambulo::study::{
    self, GroundSettings, LaboratoryFile, Outcome, Recording as Recorded, Settings, Source, StandingTrial, StatedSize,
};
use std::fs;
use std::path::Path;
use std::sync::Arc;

/// The kinds of trial.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Group {
    /// Straight walking, which determines the means.
    Walking,
    /// Straight walking without markers on the trunk.
    NoTrunk,
    /// Straight walking at 1.6 m/s and more.
    FastWalking,
    /// Walking round a corner.
    Turning,
    /// Running.
    Running,
    /// Drop jumps with a two-legged landing.
    Jumping,
}

impl Group {
    pub(crate) fn word(self) -> &'static str {
        match self {
            Group::Walking => "walking",
            Group::NoTrunk => "walking, no trunk markers",
            Group::FastWalking => "fast walking",
            Group::Turning => "turning",
            Group::Running => "running",
            Group::Jumping => "drop jumps",
        }
    }
}

/// The kinds of people, which are judged apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Population {
    Adult,
    /// Children and adolescents; in a laboratory with both, those below 45 kg.
    Child,
    Patient,
    Runner,
}

impl Population {
    pub(crate) const ALL: [Population; 4] =
        [Population::Adult, Population::Child, Population::Patient, Population::Runner];

    pub(crate) fn word(self) -> &'static str {
        match self {
            Population::Adult => "adults",
            Population::Child => "children",
            Population::Patient => "patients",
            Population::Runner => "runners",
        }
    }
}

/// The kind of recording; paths are relative to the recording's folder, the set of markers to that of the data. Body
/// mass and stature are those of data/README.md; without a mass, the file or the plates have it.
#[derive(Debug, Clone, Copy)]
pub(super) enum Kind {
    /// Coordinates of a model, which has another mass than the person if one is stated.
    Coordinates { motion: &'static str, model: &'static str, mass: Option<f64> },
    /// Markers on a model.
    ModelMarkers { markers: &'static str, model: &'static str },
    /// Markers on the built-in body, possibly with a standing trial.
    Markers {
        markers: &'static str,
        standing: Option<&'static str>,
        set: Option<&'static str>,
        mass: Option<f64>,
        height: Option<f64>,
    },
}

/// The source of measured forces; `None` is the C3D itself.
pub(super) type Grf = Option<(&'static str, [&'static str; 2])>;

/// A recording.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Recording {
    pub(crate) label: &'static str,
    pub(crate) subject: &'static str,
    pub(crate) laboratory: &'static str,
    pub(crate) population: Population,
    pub(crate) group: Group,
    pub(super) folder: &'static str,
    pub(super) kind: Kind,
    pub(super) grf: Grf,
}

/// Straight walks of the eight people with a standing trial in the laboratories with C3D files, one each.
const STRAIGHT: [&str; 8] =
    ["HC032A03", "HC002D06", "PiG_Motion3", "HC030A05", "HC031A06", "HC033A10", "HC036A10", "HC055A09"];

/// The recordings of [`STRAIGHT`].
pub(crate) fn straight() -> Vec<Recording> {
    labelled(&STRAIGHT)
}

/// Angles that other programs fitted, with plates.
pub(crate) fn given_angles() -> Vec<Recording> {
    let of_markers = labelled(&["rajagopal-walk, markers"]).into_iter().map(|recording| Recording {
        label: "rajagopal-walk, angles of OpenSim",
        kind: Kind::Coordinates { motion: "ik_uniform_weights.mot", model: "subject_walk_scaled.osim", mass: None },
        ..recording
    });
    labelled(&["gait2392, given angles"]).into_iter().chain(of_markers).collect()
}

/// Recordings by their labels.
pub(crate) fn labelled(labels: &[&str]) -> Vec<Recording> {
    let all = all();
    labels.iter().filter_map(|label| all.iter().find(|recording| recording.label == *label).copied()).collect()
}

/// The recordings of VALIDATION.md with plates, person by person.
pub(crate) fn all() -> Vec<Recording> {
    people::on_models().into_iter().chain(people::trials(&people::PEOPLE)).collect()
}

/// The recordings of further laboratories, person by person: of the fit and of its tables by laboratory.
pub(crate) fn further() -> Vec<Recording> {
    further_people::on_models().into_iter().chain(people::trials(&further_people::PEOPLE)).collect()
}

impl Recording {
    /// The prediction from its motion and its comparison with the plates, as `ambulo forces --predict` computes them.
    /// `prescribed` replaces estimates by truths.
    pub(crate) fn predict(&self, source: &Source, prescribed: Prescribed) -> Result<Outcome, String> {
        predicted(source, PredictSettings { prescribed, ..PredictSettings::default() })
    }

    /// The prediction with parameters that were fitted to others.
    pub(crate) fn predict_with(&self, source: &Source, parameters: FittedParameters) -> Result<Outcome, String> {
        predicted(source, PredictSettings { parameters, ..PredictSettings::default() })
    }

    /// The prediction with the calibration of a person.
    pub(crate) fn predict_person(&self, source: &Source, person: Option<PersonalErrors>) -> Result<Outcome, String> {
        predicted(source, PredictSettings { person, ..PredictSettings::default() })
    }

    /// Whether the files are trials of a person on the built-in body, each a separate recording.
    pub(crate) fn is_of_a_person(&self) -> bool {
        matches!(self.kind, Kind::Markers { .. })
    }

    /// Whether its motion comes from markers.
    pub(crate) fn has_markers(&self) -> bool {
        !matches!(self.kind, Kind::Coordinates { .. })
    }

    /// Its files, read.
    pub(crate) fn read(&self, data: &Path) -> Result<Source, String> {
        self.read_with(data, &|_| true)
    }

    /// Its files without the markers above the pelvis: those that the body of `whole` carries on trunk, head and arms.
    pub(crate) fn read_without_trunk(&self, data: &Path, whole: &Outcome) -> Result<Source, String> {
        let body = &whole.body;
        let trunk = body.anatomy().trunk().ok_or("a body without a trunk")?;
        let is_above = |mut id: BodyId| loop {
            match body.bodies()[id.index()].joint.parent {
                _ if id == trunk => break true,
                Some(parent) => id = parent,
                None => break false,
            }
        };
        let above = |marker: &&Marker| marker.body.is_some_and(is_above);
        let dropped = body.markers().iter().filter(above).map(|marker| marker.name.as_str()).collect::<Vec<_>>();
        self.read_with(data, &|name| !dropped.contains(&name))
    }

    fn read_with(&self, data: &Path, stays: &dyn Fn(&str) -> bool) -> Result<Source, String> {
        let mut files = |path: &Path| fs::read(path).map_err(|e| FileError::from(format!("{}: {e}", path.display())));
        let read = self.job(data).read(&mut files, &mut Findings::default()).map_err(|error| error.text())?;
        let mut source = read.source;
        if let Recorded::Markers(markers) = &mut source.recording {
            let keep = |file: &mut LaboratoryFile| file.recording.markers.markers.retain(|marker| stays(&marker.name));
            keep(&mut markers.trial);
            let standing = markers.standing.take().map(|standing| {
                let mut file = LaboratoryFile::clone(&standing);
                keep(&mut file);
                Arc::new(StandingTrial::new(file))
            });
            markers.standing = standing;
        }
        Ok(source)
    }

    /// Its files, with what the laboratory states.
    fn job(&self, data: &Path) -> Job {
        let folder = data.join(self.folder);
        let of_model = |recording: &str, model: &str, mass_kg: Option<f64>| Job {
            model: Some(ModelChoice::File(folder.join(model))),
            size: StatedSize { mass_kg, height_m: None },
            ..Job::of(folder.join(recording))
        };
        let job = match self.kind {
            Kind::Coordinates { motion, model, mass } => of_model(motion, model, mass),
            Kind::ModelMarkers { markers, model } => of_model(markers, model, None),
            Kind::Markers { markers, standing, set, mass, height } => Job {
                standing: standing.map(|name| folder.join(name)),
                markers: set.map(|name| data.join(name).display().to_string()),
                size: StatedSize { mass_kg: mass, height_m: height },
                ..Job::of(folder.join(markers))
            },
        };
        let foot = |body: &str, prefix: &str| Some(FootColumns { body: body.to_owned(), prefix: prefix.to_owned() });
        let forces = self.grf.map_or_else(ForceFiles::default, |(name, [right, left])| ForceFiles {
            table: Some(folder.join(name)),
            right: foot("calcn_r", right),
            left: foot("calcn_l", left),
            loads: None,
        });
        Job { forces, ..job }
    }
}

fn predicted(source: &Source, prediction: PredictSettings) -> Result<Outcome, String> {
    let settings = Settings { ground: GroundSettings::Predicted, prediction, ..Settings::default() };
    study::run(source.clone(), &settings, &mut Findings::default()).map_err(|e| e.to_string())
}
