//! The recordings with plates, and how they are read.

use ambulo::findings::Findings;
use ambulo::ground::predict::{PredictSettings, Prescribed};
use ambulo::model::Model;
use ambulo::model::anthropometry::SegmentTable;
use ambulo::motion::coordinates_from_table;
use ambulo::study::{
    self, ForceTable, GroundSettings, LaboratoryFile, MarkerBody, MarkerSource, MeasuredForces, Outcome, Settings,
    Source,
};
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use ambulo_formats::table::Table;
use std::fs;
use std::path::Path;

/// The kinds of trial.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Group {
    /// Straight walking, which determines the means.
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

/// The kind of recording; paths are relative to the recording's folder.
#[derive(Debug, Clone, Copy)]
enum Kind {
    /// Coordinates of a model.
    Coordinates { motion: &'static str, model: &'static str },
    /// Markers on a model.
    ModelMarkers { markers: &'static str, model: &'static str },
    /// Markers on the built-in body, possibly with a standing trial on plates; `mass` is the stated body mass.
    Markers { markers: &'static str, standing: &'static str, mass: f64, height: f64 },
}

/// The source of measured forces; `None` is the C3D itself.
type Grf = Option<(&'static str, [&'static str; 2])>;

/// A recording.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Recording {
    pub(crate) label: &'static str,
    pub(crate) subject: &'static str,
    pub(crate) group: Group,
    folder: &'static str,
    kind: Kind,
    grf: Grf,
}

/// All recordings with plates.
pub(crate) fn all() -> Vec<Recording> {
    let c3d = |label, subject, group, folder, markers, standing, mass, height| Recording {
        label,
        subject,
        group,
        folder,
        kind: Kind::Markers { markers, standing, mass, height },
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
            kind: Kind::ModelMarkers { markers: "subject01_walk1.trc", model },
            grf: Some(("subject01_walk1_grf.mot", ["ground_force_", "1_ground_force_"])),
        },
        Recording {
            label: "gait2392, given angles",
            subject: "gait2392",
            group: Group::Walking,
            folder: gait,
            kind: Kind::Coordinates { motion: "subject01_walk1_ik.mot", model },
            grf: Some(("core-id-test/subject01_walk1_grf.mot", ["ground_force_", "l_ground_force_"])),
        },
        Recording {
            label: "rajagopal-walk, markers",
            subject: "rajagopal-walk",
            group: Group::Walking,
            folder: walk,
            kind: Kind::ModelMarkers { markers: "markers_walk.trc", model: "subject_walk_scaled.osim" },
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
            kind: Kind::Markers {
                markers: "motion_capture_run.trc",
                standing: "static_run.trc",
                mass: 72.84,
                height: 1.80,
            },
            grf: Some(("grf_run.mot", ["R_ground_force_", "L_ground_force_"])),
        },
    ]
}

/// Straight walking of eight people with plates, one trial each.
pub(crate) fn straight() -> Vec<Recording> {
    let child = |label, folder, markers, standing, mass, height| Recording {
        label,
        subject: label,
        group: Group::Walking,
        folder,
        kind: Kind::Markers { markers, standing, mass, height },
        grf: None,
    };
    let known = all().into_iter().filter(|r| ["HC032A03", "HC002D06", "PiG_Motion3"].contains(&r.label));
    known
        .chain([
            child("HC030A05", "biomechzoo-HC030A", "HC030A05.c3d", "HC030A01.c3d", 45.8, 1.48),
            child("HC031A06", "biomechzoo-HC031A", "HC031A06.c3d", "HC031A01.c3d", 27.7, 1.33),
            child("HC033A10", "biomechzoo-HC033A", "HC033A10.c3d", "HC033A01.c3d", 51.5, 1.605),
            child("HC036A10", "biomechzoo-HC036A", "HC036A10.c3d", "HC036A01.c3d", 33.0, 1.34),
            child("HC055A09", "biomechzoo-HC055A", "HC055A09.c3d", "HC055A01.c3d", 32.0, 1.44),
        ])
        .collect()
}

impl Recording {
    /// The prediction from its motion and its comparison with the plates, as `ambulo forces --predict` computes them. `prescribed` replaces
    /// estimates by truths.
    pub(crate) fn predict(&self, source: &Source, prescribed: Prescribed) -> Result<Outcome, String> {
        let settings = Settings {
            ground: GroundSettings::Predicted,
            prediction: PredictSettings { prescribed, ..PredictSettings::default() },
            ..Settings::default()
        };
        study::run(source.clone(), &settings, &mut Findings::default()).map_err(|e| e.to_string())
    }

    /// Its files, read.
    pub(crate) fn read(&self, data: &Path) -> Result<Source, String> {
        let folder = data.join(self.folder);
        let file = |name: &str| {
            let path = folder.join(name);
            fs::read(&path).map_err(|e| format!("{}: {e}", path.display()))
        };
        let findings = &mut Findings::default();
        let source = match self.kind {
            Kind::Coordinates { motion, model } => coordinates(&file(model)?, &file(motion)?, findings)?,
            Kind::ModelMarkers { markers, model } => {
                let model = Model::from_osim(&file(model)?, findings).map_err(|e| e.to_string())?;
                let trial = laboratory_file(markers, &file(markers)?, findings)?;
                let body = MarkerBody::Model { model, mass_kg: None, protocol: None };
                Source::markers(MarkerSource { trial, standing: None, body, plates: Vec::new() })
            }
            Kind::Markers { markers, standing, mass, height } => {
                let trial = laboratory_file(markers, &file(markers)?, findings)?;
                let standing = Some(laboratory_file(standing, &file(standing)?, findings)?);
                let table = SegmentTable::DeLevaMale;
                let body = MarkerBody::BuiltIn { table, mass_kg: Some(mass), height_m: Some(height), set: None };
                Source::markers(MarkerSource { trial, standing, body, plates: Vec::new() })
            }
        };
        Ok(match self.grf {
            Some((name, prefixes)) => source.with_forces(force_table(&file(name)?, prefixes)?),
            None => source,
        })
    }
}

fn coordinates(model: &[u8], motion: &[u8], findings: &mut Findings) -> Result<Source, String> {
    let model = Model::from_osim(model, findings).map_err(|e| e.to_string())?;
    let (table, _) = Table::read_storage(motion).map_err(|e| e.to_string())?;
    let motion = coordinates_from_table(&model, &table, "the recording", findings).map_err(|e| e.to_string())?;
    Ok(Source::coordinates(model, motion))
}

fn laboratory_file(name: &str, bytes: &[u8], findings: &mut Findings) -> Result<LaboratoryFile, String> {
    let read = if name.ends_with(".c3d") { LaboratoryFile::from_c3d } else { LaboratoryFile::from_trc };
    read(bytes, name, findings).map_err(|e| format!("{name}: {e}"))
}

/// Forces of a table on the usual feet.
fn force_table(bytes: &[u8], [right, left]: [&str; 2]) -> Result<MeasuredForces, String> {
    let (table, _) = Table::read_storage(bytes).map_err(|e| e.to_string())?;
    let forces = vec![
        ExternalForce::with_prefix("right", "calcn_r", right),
        ExternalForce::with_prefix("left", "calcn_l", left),
    ];
    let loads = Some(ExternalLoads { name: "feet".into(), datafile: None, forces });
    Ok(MeasuredForces::Table(ForceTable { table, loads }))
}
