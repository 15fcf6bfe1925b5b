//! Recordings with force plates as motions of bodies, with the foot events from the plates.
//!
//! Plate events are crossings of 20 N: of the forces in the files if a table has them (the forces of the three OpenSim
//! sets were low-pass filtered by their authors: they rise from 20 to 140 N in 20 to 30 ms, those of the C3D files in 3
//! to 5 ms), otherwise from the README of the data.

use crate::gait_files::{self, File, Subject};
use ambulo::analysis::{BodySource, LaboratoryRecording, MarkerTrial, body_in_motion};
use ambulo::findings::Findings;
use ambulo::ground::phases::contacts_from_force;
use ambulo::kinematics::Trajectory;
use ambulo::kinematics::calibration::{BodyMeasurements, PersonMeasurements};
use ambulo::kinematics::marker_fit::FitSettings;
use ambulo::model::anatomy::Sole;
use ambulo::model::anthropometry::SegmentTable;
use ambulo::model::{BySide, Model, Side};
use ambulo::motion::filter::LowPass;
use ambulo::motion::{
    Event, EventKind, ForceRecording, Motion, PlateSettings, SmoothSettings, Smoother, Window, coordinates_from_table,
    force_recordings, markers_from_c3d, markers_from_trc, plates_from_c3d, smooth,
};
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use ambulo_formats::table::Table;
use ambulo_formats::trc::Trc;
use std::path::Path;
use std::sync::OnceLock;

const R: Side = Side::Right;
const L: Side = Side::Left;

/// A motion and the plate events.
#[derive(Clone)]
pub(crate) struct Recorded {
    pub(crate) name: &'static str,
    pub(crate) subject: &'static str,
    pub(crate) model: Model,
    pub(crate) motion: Motion,
    pub(crate) soles: BySide<Option<Sole>>,
    pub(crate) plates: Vec<Event>,
    /// Plate forces in the world axes of the motion.
    pub(crate) forces: Vec<ForceRecording>,
    /// Whether plates measured every step between their first and last event.
    pub(crate) all_seen: bool,
}

impl Recorded {
    pub(crate) fn trajectory(&self, cutoff_hz: f64) -> Trajectory {
        let smoother = Smoother::Butterworth(LowPass { order: 3, cutoff_hz });
        let settings = SmoothSettings { smoother, window: Window::default(), rate_hz: None };
        let mut findings = Findings::default();
        let smooth = smooth(&self.model, &self.motion, settings, &mut findings).unwrap();
        Trajectory::complete(&self.model, smooth, &mut findings).unwrap()
    }
}

/// All trials, computed once; empty without data.
pub(crate) fn everything() -> &'static [Recorded] {
    static ALL: OnceLock<Vec<Recorded>> = OnceLock::new();
    ALL.get_or_init(read)
}

fn read() -> Vec<Recorded> {
    let Some(data) = gait_files::folder() else { return Vec::new() };
    let mut all = opensim(&data);
    let told: [&[(Side, f64, f64)]; 3] = [
        &[(R, 1.667, 2.282), (L, 2.191, 2.819)],
        &[(R, 1.830, 2.350), (L, 2.284, 2.807)],
        &[(L, 7.853, 8.511), (R, 8.382, 9.045), (L, 8.93, 9.60)],
    ];
    let names = ["HC032A03", "HC002D06", "PiG_Motion3"];
    let straight = gait_files::everyone().into_iter().zip(names).zip(told);
    all.extend(straight.map(|((subject, name), told)| of_c3d(&subject, name, told)));
    // The left foot leaves its plate early in the first turn: its off is not known.
    let told: [&[(Side, f64, f64)]; 2] =
        [&[(R, 1.765, 2.418), (L, 2.335, f64::NAN)], &[(L, 1.582, 2.124), (R, 2.057, 2.584)]];
    let turns = gait_files::turning().into_iter().zip(["HC032A18 turn", "HC002D25 turn"]).zip(told);
    all.extend(turns.map(|((subject, name), told)| of_c3d(&subject, name, told)));
    all
}

fn of_c3d(subject: &Subject, name: &'static str, told: &[(Side, f64, f64)]) -> Recorded {
    let body = BodySource::BuiltIn { person: &subject.person, set: None };
    let event = |side, kind, time_s| Event { side, kind, time_s };
    let both = |t: &(Side, f64, f64)| [event(t.0, EventKind::Strike, t.1), event(t.0, EventKind::Off, t.2)];
    let plates = told.iter().flat_map(both).filter(|e| e.time_s.is_finite()).collect();
    fitted(
        name,
        subject.name,
        &recording(&subject.walk),
        Some(&recording(&subject.standing)),
        &body,
        Plates { events: plates, forces: None, all_seen: false },
    )
}

/// Plate events of a recording.
struct Plates<'a> {
    events: Vec<Event>,
    /// `None` if the forces are in the recording.
    forces: Option<&'a TableForces>,
    all_seen: bool,
}

/// A table of forces and the prefixes of its columns: right and left foot.
struct TableForces {
    table: Table,
    prefixes: [&'static str; 2],
}

fn forces_of(model: &Model, forces: &TableForces) -> Vec<ForceRecording> {
    let [right, left] = forces.prefixes;
    let of_feet = vec![
        ExternalForce::with_prefix("right", "calcn_r", right),
        ExternalForce::with_prefix("left", "calcn_l", left),
    ];
    let loads = ExternalLoads { name: "feet".into(), datafile: None, forces: of_feet };
    force_recordings(model, &loads, &forces.table, &mut Findings::default()).unwrap()
}

fn recording(file: &File) -> LaboratoryRecording {
    let mut findings = Findings::default();
    LaboratoryRecording {
        poses: None,
        markers: markers_from_c3d(&file.c3d, &mut findings).unwrap(),
        plates: plates_from_c3d(&file.c3d, PlateSettings::default(), &mut findings).unwrap_or_default(),
        unit: file.c3d.point_unit.clone(),
    }
}

fn fitted(
    name: &'static str,
    subject: &'static str,
    walk: &LaboratoryRecording,
    still: Option<&LaboratoryRecording>,
    body: &BodySource<'_>,
    Plates { events: plates, forces, all_seen }: Plates<'_>,
) -> Recorded {
    let settings = FitSettings::default();
    let trial = MarkerTrial {
        trial: walk,
        standing: still,
        bodies: None,
        body: body.clone(),
        plate_feet: &[],
        window: Window::default(),
    };
    let body = body_in_motion(&trial, &settings, &mut Findings::default()).unwrap();
    let forces = forces.map_or_else(
        || body.plate_forces(),
        |table| {
            let mut forces = forces_of(&body.subject.model, table);
            forces.iter_mut().for_each(|force| force.rotate(&body.laboratory.world_from_lab));
            forces
        },
    );
    let (model, soles) = (body.subject.model, body.subject.person.soles);
    Recorded { name, subject, model, motion: body.fit.motion, soles, plates, forces, all_seen }
}

fn opensim(data: &Path) -> Vec<Recorded> {
    let (gait, walk, run) = ("opensim-gait2392-subject01", "opensim-rajagopal-walk", "opensim-rajagopal-run");
    let model =
        |file: &str| Model::from_osim(&std::fs::read(data.join(file)).unwrap(), &mut Findings::default()).unwrap();
    let trc = |folder: &str, file: &str| {
        let trc = Trc::read(&std::fs::read(data.join(folder).join(file)).unwrap()).unwrap().0;
        let markers = markers_from_trc(&trc, &mut Findings::default()).unwrap();
        LaboratoryRecording { markers, poses: None, plates: Vec::new(), unit: trc.unit.symbol().to_owned() }
    };
    let read = |file: String, prefixes: [&'static str; 2]| {
        let (table, _) = Table::read_storage(&std::fs::read(data.join(file)).unwrap()).unwrap();
        TableForces { table, prefixes }
    };
    let events = |forces: &TableForces, window: [f64; 2]| {
        let table = &forces.table;
        let mut out = Vec::new();
        for (side, prefix) in [R, L].into_iter().zip(forces.prefixes) {
            let column = table.column(&format!("{prefix}vy")).unwrap();
            for contact in contacts_from_force(table.times().unwrap(), column) {
                let event = |kind, time_s| Event { side, kind, time_s };
                out.extend(contact.strike_s.map(|t| event(EventKind::Strike, t)));
                out.extend(contact.off_s.map(|t| event(EventKind::Off, t)));
            }
        }
        out.retain(|e| (window[0]..window[1]).contains(&e.time_s));
        out
    };
    let [small, large] = [format!("{gait}/subject01_simbody.osim"), format!("{walk}/subject_walk_scaled.osim")];
    let [small, large] = [model(&small), model(&large)];
    let by_markers = read(format!("{gait}/subject01_walk1_grf.mot"), ["ground_force_", "1_ground_force_"]);
    let by_angles = read(format!("{gait}/core-id-test/subject01_walk1_grf.mot"), ["ground_force_", "l_ground_force_"]);
    let by_walk = read(format!("{walk}/grf_walk.mot"), ["ground_force_r_", "ground_force_l_"]);
    let by_run = read(format!("{run}/grf_run.mot"), ["R_ground_force_", "L_ground_force_"]);
    let of_markers = events(&by_markers, [0.05, 2.4]);
    let of_angles = events(&by_angles, [0.55, 3.95]);
    let of_walk = events(&by_walk, [0.1, 2.3]);
    let of_run = events(&by_run, [0.3, 5.25]);
    let body = |model| BodySource::Model { model, mass: None, protocol: None };
    let table = Table::read_storage(&std::fs::read(data.join(gait).join("subject01_walk1_ik.mot")).unwrap()).unwrap().0;
    let angles = Recorded {
        name: "gait2392 angles",
        subject: "gait2392",
        motion: coordinates_from_table(&small, &table, "ik", &mut Findings::default()).unwrap(),
        soles: ambulo::analysis::feasibility::Person::of_model(&small).soles,
        model: small.clone(),
        plates: of_angles,
        forces: forces_of(&small, &by_angles),
        all_seen: true,
    };
    let person = PersonMeasurements {
        table: SegmentTable::DeLevaMale,
        mass: 72.84,
        height: Some(1.80),
        measurements: BodyMeasurements::default(),
    };
    let runner = BodySource::BuiltIn { person: &person, set: None };
    let (markers, still) = (trc(run, "motion_capture_run.trc"), trc(run, "static_run.trc"));
    vec![
        fitted(
            "gait2392 markers",
            "gait2392",
            &trc(gait, "subject01_walk1.trc"),
            None,
            &body(&small),
            Plates { events: of_markers, forces: Some(&by_markers), all_seen: true },
        ),
        angles,
        fitted(
            "rajagopal-walk",
            "rajagopal-walk",
            &trc(walk, "markers_walk.trc"),
            None,
            &body(&large),
            Plates { events: of_walk, forces: Some(&by_walk), all_seen: false },
        ),
        fitted(
            "rajagopal-run",
            "rajagopal-run",
            &markers,
            Some(&still),
            &runner,
            Plates { events: of_run, forces: Some(&by_run), all_seen: true },
        ),
    ]
}
