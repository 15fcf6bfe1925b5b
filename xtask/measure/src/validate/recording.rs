//! The recordings with plates, and how they are read.

use ambulo::findings::Findings;
use ambulo::ground::predict::{PersonalErrors, PredictSettings, Prescribed};
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
}

impl Group {
    pub(crate) fn word(self) -> &'static str {
        match self {
            Group::Walking => "walking",
            Group::NoTrunk => "walking, no trunk markers",
            Group::FastWalking => "fast walking",
            Group::Turning => "turning",
            Group::Running => "running",
        }
    }
}

/// The kind of recording; paths are relative to the recording's folder.
#[derive(Debug, Clone, Copy)]
enum Kind {
    /// Coordinates of a model.
    Coordinates { motion: &'static str, model: &'static str },
    /// Markers on a model.
    ModelMarkers { markers: &'static str, model: &'static str },
    /// Markers on the built-in body, possibly with a standing trial; body mass and stature as stated in data/README.md.
    Markers { markers: &'static str, standing: Option<&'static str>, mass: f64, height: Option<f64> },
}

/// The source of measured forces; `None` is the C3D itself.
type Grf = Option<(&'static str, [&'static str; 2])>;

/// A person and the laboratory in which the person was recorded.
#[derive(Debug, Clone, Copy)]
struct Person {
    subject: &'static str,
    laboratory: &'static str,
    folder: &'static str,
    standing: Option<&'static str>,
    /// [kg]
    mass: f64,
    /// [m]
    height: Option<f64>,
    trials: &'static [(&'static str, &'static str, Group)],
    /// Forces of the trials in a table.
    grf: Grf,
}

/// A recording.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Recording {
    pub(crate) label: &'static str,
    pub(crate) subject: &'static str,
    pub(crate) laboratory: &'static str,
    pub(crate) group: Group,
    folder: &'static str,
    kind: Kind,
    grf: Grf,
}

const fn child(
    subject: &'static str,
    folder: &'static str,
    standing: Option<&'static str>,
    size: [f64; 2],
    trials: &'static [(&'static str, &'static str, Group)],
) -> Person {
    let laboratory = "McGill";
    Person { subject, laboratory, folder, standing, mass: size[0], height: Some(size[1]), trials, grf: None }
}

/// Everybody with markers on the built-in body: label, file and kind of each trial. Left out are the turn of HC034A, in
/// which the plates carry clearly less than the weight, and hamner-subject04-run3, which has no marker on knees and
/// ankles (data/README.md).
const PEOPLE: [Person; 14] = [
    child(
        "HC032A",
        "biomechzoo-HC032A",
        Some("HC032A01.c3d"),
        [60.3, 1.58],
        &[("HC032A03", "HC032A03.c3d", Group::Walking), ("HC032A18", "HC032A18.c3d", Group::Turning)],
    ),
    child(
        "HC002D",
        "biomechzoo-HC002D",
        Some("HC002D02.c3d"),
        [32.1, 1.45],
        &[("HC002D06", "HC002D06.c3d", Group::Walking), ("HC002D25", "HC002D25.c3d", Group::Turning)],
    ),
    child(
        "HC030A",
        "biomechzoo-HC030A",
        Some("HC030A01.c3d"),
        [45.8, 1.48],
        &[("HC030A05", "HC030A05.c3d", Group::Walking), ("HC030A22", "HC030A22.c3d", Group::Turning)],
    ),
    child(
        "HC031A",
        "biomechzoo-HC031A",
        Some("HC031A01.c3d"),
        [27.7, 1.33],
        &[("HC031A06", "HC031A06.c3d", Group::Walking), ("HC031A23", "HC031A23.c3d", Group::Turning)],
    ),
    child(
        "HC033A",
        "biomechzoo-HC033A",
        Some("HC033A01.c3d"),
        [51.5, 1.605],
        &[("HC033A10", "HC033A10.c3d", Group::Walking), ("HC033A22", "HC033A22.c3d", Group::Turning)],
    ),
    child(
        "HC036A",
        "biomechzoo-HC036A",
        Some("HC036A01.c3d"),
        [33.0, 1.34],
        &[("HC036A10", "HC036A10.c3d", Group::Walking), ("HC036A23", "HC036A23.c3d", Group::Turning)],
    ),
    child(
        "HC055A",
        "biomechzoo-HC055A",
        Some("HC055A01.c3d"),
        [32.0, 1.44],
        &[("HC055A09", "HC055A09.c3d", Group::Walking), ("HC055A34", "HC055A34.c3d", Group::Turning)],
    ),
    child(
        "HC003B",
        "biomechzoo-HC003B",
        None,
        [38.5, 1.525],
        &[("HC003B08", "HC003B08.c3d", Group::Walking), ("HC003B21", "HC003B21.c3d", Group::Turning)],
    ),
    child("HC034A", "biomechzoo-HC034A", None, [45.3, 1.54], &[("HC034A07", "HC034A07.c3d", Group::Walking)]),
    Person {
        subject: "UNIPD",
        laboratory: "Padua",
        folder: "motonms-unipd",
        standing: Some("Static1.c3d"),
        mass: 82.6,
        height: None,
        trials: &[
            ("UNIPD 1", "Walking1.c3d", Group::Walking),
            ("UNIPD 2", "Walking2.c3d", Group::Walking),
            ("UNIPD 3", "Walking3.c3d", Group::Walking),
            ("UNIPD 4", "Walking4.c3d", Group::Walking),
            ("UNIPD 5", "Walking5.c3d", Group::Walking),
        ],
        grf: None,
    },
    Person {
        subject: "flat foot",
        laboratory: "BTK",
        folder: "btkdata-flatfoot-full",
        standing: Some("PiG_Calibration-FlatFoot-Full.c3d"),
        mass: 47.5,
        height: Some(1.505),
        trials: &[("flat foot", "PiG_Motion-FlatFoot-Full.c3d", Group::Walking)],
        grf: None,
    },
    Person {
        subject: "PiG",
        laboratory: "BTK",
        folder: "btkdata-pig-adult3plates",
        standing: Some("PiG_Calibration3_FF.c3d"),
        mass: 74.0,
        height: Some(1.76),
        trials: &[("PiG_Motion3", "PiG_Motion3_FF.c3d", Group::NoTrunk)],
        grf: None,
    },
    Person {
        subject: "fast walker",
        laboratory: "OpenSim, C3D",
        folder: "opensim-core-fast-walk",
        standing: None,
        mass: 66.4,
        height: None,
        trials: &[
            ("fast 2", "walking2.c3d", Group::FastWalking),
            ("fast 5", "walking5.c3d", Group::FastWalking),
            ("fast test", "test_walking.c3d", Group::FastWalking),
        ],
        grf: None,
    },
    Person {
        subject: "rajagopal-run",
        laboratory: "OpenSim, run",
        folder: "opensim-rajagopal-run",
        standing: Some("static_run.trc"),
        mass: 72.84,
        height: Some(1.80),
        trials: &[("rajagopal-run", "motion_capture_run.trc", Group::Running)],
        grf: Some(("grf_run.mot", ["R_ground_force_", "L_ground_force_"])),
    },
];

/// The recordings of OpenSim's own models.
fn on_models() -> [Recording; 3] {
    let (gait, walk) = ("opensim-gait2392-subject01", "opensim-rajagopal-walk");
    let model = "subject01_simbody.osim";
    let recording = |label, subject, folder, kind, grf| Recording {
        label,
        subject,
        laboratory: subject,
        group: Group::Walking,
        folder,
        kind,
        grf: Some(grf),
    };
    [
        recording(
            "gait2392, markers",
            "gait2392",
            gait,
            Kind::ModelMarkers { markers: "subject01_walk1.trc", model },
            ("subject01_walk1_grf.mot", ["ground_force_", "1_ground_force_"]),
        ),
        recording(
            "gait2392, given angles",
            "gait2392",
            gait,
            Kind::Coordinates { motion: "subject01_walk1_ik.mot", model },
            ("core-id-test/subject01_walk1_grf.mot", ["ground_force_", "l_ground_force_"]),
        ),
        recording(
            "rajagopal-walk, markers",
            "rajagopal-walk",
            walk,
            Kind::ModelMarkers { markers: "markers_walk.trc", model: "subject_walk_scaled.osim" },
            ("grf_walk.mot", ["ground_force_r_", "ground_force_l_"]),
        ),
    ]
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
        kind: Kind::Coordinates { motion: "ik_uniform_weights.mot", model: "subject_walk_scaled.osim" },
        ..recording
    });
    labelled(&["gait2392, given angles"]).into_iter().chain(of_markers).collect()
}

/// Recordings by their labels.
pub(crate) fn labelled(labels: &[&str]) -> Vec<Recording> {
    let all = all();
    labels.iter().filter_map(|label| all.iter().find(|recording| recording.label == *label).copied()).collect()
}

/// All recordings with plates, person by person.
pub(crate) fn all() -> Vec<Recording> {
    let trials = |person: &'static Person| {
        let Person { subject, laboratory, folder, standing, mass, height, trials, grf } = *person;
        trials.iter().map(move |&(label, markers, group)| {
            let kind = Kind::Markers { markers, standing, mass, height };
            Recording { label, subject, laboratory, group, folder, kind, grf }
        })
    };
    on_models().into_iter().chain(PEOPLE.iter().flat_map(trials)).collect()
}

impl Recording {
    /// The prediction from its motion and its comparison with the plates, as `ambulo forces --predict` computes them.
    /// `prescribed` replaces estimates by truths.
    pub(crate) fn predict(&self, source: &Source, prescribed: Prescribed) -> Result<Outcome, String> {
        predicted(source, PredictSettings { prescribed, ..PredictSettings::default() })
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
        let of_model = |recording: &str, model: &str| Job {
            model: Some(ModelChoice::File(folder.join(model))),
            ..Job::of(folder.join(recording))
        };
        let job = match self.kind {
            Kind::Coordinates { motion, model } => of_model(motion, model),
            Kind::ModelMarkers { markers, model } => of_model(markers, model),
            Kind::Markers { markers, standing, mass, height } => Job {
                standing: standing.map(|name| folder.join(name)),
                size: StatedSize { mass_kg: Some(mass), height_m: height },
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
