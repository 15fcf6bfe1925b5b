//! The recordings with plates, and what becomes of them before anything is predicted.

use ambulo::analysis::feasibility::Person;
use ambulo::analysis::{Body, BodyInMotion, LaboratoryRecording, body_in_motion, body_mass};
use ambulo::findings::Findings;
use ambulo::kinematics::calibration;
use ambulo::kinematics::marker_fit::FitSettings;
use ambulo::model::anthropometry::SegmentTable;
use ambulo::model::{Model, from_osim_bytes};
use ambulo::motion::force_plate::{PlateSettings, plates_from_c3d, standing_weight_n};
use ambulo::motion::{
    ForceRecording, Motion, coordinates_from_table, force_recordings, markers_from_c3d, markers_from_trc,
};
use ambulo_formats::c3d::C3d;
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use ambulo_formats::table::Table;
use ambulo_formats::trc::Trc;
use std::fs;
use std::path::Path;

/// Weight to mass [m/s²].
const STANDARD_GRAVITY: f64 = 9.806_65;

/// How a recording counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Group {
    /// Straight walking: these make the means.
    Walking,
    /// Straight walking without markers on the trunk.
    NoTrunk,
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
            Group::Turning => "turning",
            Group::Running => "running",
        }
    }
}

/// What the motion is recorded as; files below the recording's folder.
#[derive(Debug, Clone, Copy)]
enum Source {
    /// Coordinates of a model.
    Coordinates { motion: &'static str, model: &'static str },
    /// Markers on a model.
    ModelMarkers { markers: &'static str, model: &'static str },
    /// Markers on the built-in body, with a standing trial on plates or not; `mass` is what is stated.
    Markers { markers: &'static str, standing: &'static str, mass: f64, height: f64 },
}

/// Where measured forces stand; `None` is in the C3D itself.
type Grf = Option<(&'static str, [&'static str; 2])>;

/// A recording.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Recording {
    pub(crate) label: &'static str,
    pub(crate) subject: &'static str,
    pub(crate) group: Group,
    folder: &'static str,
    source: Source,
    grf: Grf,
}

/// A recording as the analysis takes it.
pub(crate) struct Loaded {
    pub(crate) model: Model,
    pub(crate) motion: Motion,
    pub(crate) plates: Vec<ForceRecording>,
    pub(crate) person: Person,
    /// Of markers: the body that follows them, for which foot stood on which plate.
    pub(crate) body: Option<BodyInMotion>,
    pub(crate) standing_kg: Option<f64>,
}

/// All recordings with plates.
pub(crate) fn all() -> Vec<Recording> {
    let c3d = |label, subject, group, folder, markers, standing, mass, height| Recording {
        label,
        subject,
        group,
        folder,
        source: Source::Markers { markers, standing, mass, height },
        grf: None,
    };
    let (gait, walk, run) = ("opensim-gait2392-subject01", "opensim-rajagopal-walk", "opensim-rajagopal-run");
    let (woman, child, man) = ("biomechzoo-HC032A", "biomechzoo-HC002D", "btkdata-pig-adult3plates");
    let model = "subject01_simbody.osim";
    vec![
        Recording {
            label: "gait2392, markers",
            subject: "gait2392",
            group: Group::Walking,
            folder: gait,
            source: Source::ModelMarkers { markers: "subject01_walk1.trc", model },
            grf: Some(("subject01_walk1_grf.mot", ["ground_force_", "1_ground_force_"])),
        },
        Recording {
            label: "gait2392, given angles",
            subject: "gait2392",
            group: Group::Walking,
            folder: gait,
            source: Source::Coordinates { motion: "subject01_walk1_ik.mot", model },
            grf: Some(("core-id-test/subject01_walk1_grf.mot", ["ground_force_", "l_ground_force_"])),
        },
        Recording {
            label: "rajagopal-walk, markers",
            subject: "rajagopal-walk",
            group: Group::Walking,
            folder: walk,
            source: Source::ModelMarkers { markers: "markers_walk.trc", model: "subject_walk_scaled.osim" },
            grf: Some(("grf_walk.mot", ["ground_force_r_", "ground_force_l_"])),
        },
        c3d("HC032A03", "HC032A", Group::Walking, woman, "HC032A03.c3d", "HC032A01.c3d", 60.3, 1.58),
        c3d("HC002D06", "HC002D", Group::Walking, child, "HC002D06.c3d", "HC002D02.c3d", 32.1, 1.45),
        c3d("PiG_Motion3", "PiG", Group::NoTrunk, man, "PiG_Motion3_FF.c3d", "PiG_Calibration3_FF.c3d", 74.0, 1.76),
        c3d("HC032A18", "HC032A", Group::Turning, woman, "HC032A18.c3d", "HC032A01.c3d", 60.3, 1.58),
        c3d("HC002D25", "HC002D", Group::Turning, child, "HC002D25.c3d", "HC002D02.c3d", 32.1, 1.45),
        Recording {
            label: "rajagopal-run",
            subject: "rajagopal-run",
            group: Group::Running,
            folder: run,
            source: Source::Markers {
                markers: "motion_capture_run.trc",
                standing: "static_run.trc",
                mass: 72.84,
                height: 1.80,
            },
            grf: Some(("grf_run.mot", ["R_ground_force_", "L_ground_force_"])),
        },
    ]
}

impl Recording {
    /// Reads it and brings it to a body in motion.
    pub(crate) fn load(&self, data: &Path) -> Result<Loaded, String> {
        let folder = data.join(self.folder);
        let file = |name: &str| {
            let path = folder.join(name);
            fs::read(&path).map_err(|e| format!("{}: {e}", path.display()))
        };
        let findings = &mut Findings::default();
        let (mut loaded, turn) = match self.source {
            Source::Coordinates { motion, model } => (coordinates(&file(model)?, &file(motion)?, findings)?, None),
            Source::ModelMarkers { markers, model } => {
                let model = from_osim_bytes(&file(model)?, findings).map_err(said)?;
                let walk = trc(&file(markers)?, findings)?;
                let loaded = followed(&walk, None, &Body::Model { model: &model, mass: None }, findings)?;
                let turn = loaded.body.as_ref().map(|body| body.laboratory.world_from_lab);
                (loaded, turn)
            }
            Source::Markers { markers, standing, mass, height } => {
                let read = |name: &str, findings: &mut Findings| match name.ends_with(".c3d") {
                    true => c3d(&file(name)?, findings),
                    false => trc(&file(name)?, findings),
                };
                let (walk, still) = (read(markers, findings)?, read(standing, findings)?);
                let mass = body_mass(Some(mass), standing_kg(&still), findings);
                let person = calibration::Person {
                    table: SegmentTable::DeLevaMale,
                    mass: mass.ok_or("no body mass")?,
                    height: Some(height),
                    measures: calibration::Measures::default(),
                };
                let loaded = followed(&walk, Some(&still), &Body::BuiltIn { person: &person, set: None }, findings)?;
                let turn = loaded.body.as_ref().map(|body| body.laboratory.world_from_lab);
                (loaded, turn)
            }
        };
        if let Some((name, prefixes)) = self.grf {
            loaded.plates = table_forces(&loaded.model, &file(name)?, prefixes, findings)?;
            if let Some(turn) = turn {
                loaded.plates.iter_mut().for_each(|plate| plate.turn(&turn));
            }
        }
        Ok(loaded)
    }
}

fn said(error: impl ToString) -> String {
    error.to_string()
}

fn coordinates(model: &[u8], motion: &[u8], findings: &mut Findings) -> Result<Loaded, String> {
    let model = from_osim_bytes(model, findings).map_err(said)?;
    let (table, _) = Table::read_storage(motion).map_err(said)?;
    let motion = coordinates_from_table(&model, &table, "the recording", findings).map_err(said)?;
    let person = Person::of_model(&model);
    Ok(Loaded { model, motion, plates: Vec::new(), person, body: None, standing_kg: None })
}

fn followed(
    walk: &LaboratoryRecording,
    still: Option<&LaboratoryRecording>,
    body: &Body<'_>,
    findings: &mut Findings,
) -> Result<Loaded, String> {
    let settings = FitSettings { longest_gap_s: 0.35, ..FitSettings::default() };
    let body = body_in_motion(walk, still, body, &settings, &[], findings, &mut |_| ()).map_err(said)?;
    Ok(Loaded {
        model: body.subject.model.clone(),
        motion: body.fit.motion.clone(),
        plates: body.plate_forces(),
        person: body.subject.person.clone(),
        standing_kg: still.and_then(standing_kg),
        body: Some(body),
    })
}

fn standing_kg(still: &LaboratoryRecording) -> Option<f64> {
    standing_weight_n(&still.plates).map(|newtons| newtons / STANDARD_GRAVITY)
}

fn trc(bytes: &[u8], findings: &mut Findings) -> Result<LaboratoryRecording, String> {
    let (trc, _) = Trc::read(bytes).map_err(said)?;
    let markers = markers_from_trc(&trc, findings).map_err(said)?;
    Ok(LaboratoryRecording { markers, plates: Vec::new(), unit: trc.unit.symbol().to_owned() })
}

fn c3d(bytes: &[u8], findings: &mut Findings) -> Result<LaboratoryRecording, String> {
    let (c3d, _) = C3d::read(bytes).map_err(said)?;
    Ok(LaboratoryRecording {
        markers: markers_from_c3d(&c3d, findings).map_err(said)?,
        plates: plates_from_c3d(&c3d, PlateSettings::default(), findings).map_err(said)?,
        unit: c3d.point_unit.clone(),
    })
}

/// Forces of a table on the usual feet.
fn table_forces(
    model: &Model,
    bytes: &[u8],
    [right, left]: [&str; 2],
    findings: &mut Findings,
) -> Result<Vec<ForceRecording>, String> {
    let (table, _) = Table::read_storage(bytes).map_err(said)?;
    let loads = ExternalLoads {
        name: "feet".into(),
        datafile: None,
        forces: vec![
            ExternalForce::with_prefix("right", "calcn_r", right),
            ExternalForce::with_prefix("left", "calcn_l", left),
        ],
    };
    force_recordings(model, &loads, &table, findings).map_err(said)
}
