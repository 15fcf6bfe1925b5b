//! The people of VALIDATION.md, each with a laboratory and trials.

use super::recording::{Grf, Group, Kind, Population, Recording};

/// A person and the laboratory in which the person was recorded.
#[derive(Debug, Clone, Copy)]
pub(super) struct Person {
    pub(super) subject: &'static str,
    pub(super) laboratory: &'static str,
    pub(super) population: Population,
    pub(super) folder: &'static str,
    pub(super) standing: Option<&'static str>,
    /// [kg]; `None` if the recording or the plates have it.
    pub(super) mass: Option<f64>,
    /// [m]
    pub(super) height: Option<f64>,
    pub(super) trials: &'static [(&'static str, &'static str, Group)],
    /// The set of the markers, in the folder of the data; by default it is recognised.
    pub(super) set: Option<&'static str>,
    /// Forces of the trials in a table.
    pub(super) grf: Grf,
}

/// The trials of people on the built-in body.
pub(super) fn trials(people: &'static [Person]) -> impl Iterator<Item = Recording> {
    let trials = |person: &'static Person| {
        let Person { subject, laboratory, population, folder, standing, mass, height, trials, set, grf } = *person;
        trials.iter().map(move |&(label, markers, group)| {
            let kind = Kind::Markers { markers, standing, set, mass, height };
            Recording { label, subject, laboratory, population, group, folder, kind, grf }
        })
    };
    people.iter().flat_map(trials)
}

const fn child(
    subject: &'static str,
    folder: &'static str,
    standing: Option<&'static str>,
    size: [f64; 2],
    trials: &'static [(&'static str, &'static str, Group)],
) -> Person {
    let (laboratory, population) = ("McGill", Population::Child);
    Person {
        subject,
        laboratory,
        population,
        folder,
        standing,
        mass: Some(size[0]),
        height: Some(size[1]),
        trials,
        set: None,
        grf: None,
    }
}

/// Everybody with markers on the built-in body: label, file and kind of each trial. Left out are the turn of HC034A, in
/// which the plates carry clearly less than the weight, and hamner-subject04-run3, which has no marker on knees and
/// ankles (data/README.md).
pub(super) const PEOPLE: [Person; 14] = [
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
        population: Population::Adult,
        folder: "motonms-unipd",
        standing: Some("Static1.c3d"),
        mass: Some(82.6),
        height: None,
        trials: &[
            ("UNIPD 1", "Walking1.c3d", Group::Walking),
            ("UNIPD 2", "Walking2.c3d", Group::Walking),
            ("UNIPD 3", "Walking3.c3d", Group::Walking),
            ("UNIPD 4", "Walking4.c3d", Group::Walking),
            ("UNIPD 5", "Walking5.c3d", Group::Walking),
        ],
        set: None,
        grf: None,
    },
    Person {
        subject: "flat foot",
        laboratory: "BTK",
        population: Population::Adult,
        folder: "btkdata-flatfoot-full",
        standing: Some("PiG_Calibration-FlatFoot-Full.c3d"),
        mass: Some(47.5),
        height: Some(1.505),
        trials: &[("flat foot", "PiG_Motion-FlatFoot-Full.c3d", Group::Walking)],
        set: None,
        grf: None,
    },
    Person {
        subject: "PiG",
        laboratory: "BTK",
        population: Population::Adult,
        folder: "btkdata-pig-adult3plates",
        standing: Some("PiG_Calibration3_FF.c3d"),
        mass: Some(74.0),
        height: Some(1.76),
        trials: &[("PiG_Motion3", "PiG_Motion3_FF.c3d", Group::NoTrunk)],
        set: None,
        grf: None,
    },
    Person {
        subject: "fast walker",
        laboratory: "OpenSim, C3D",
        population: Population::Adult,
        folder: "opensim-core-fast-walk",
        standing: None,
        mass: Some(66.4),
        height: None,
        trials: &[
            ("fast 2", "walking2.c3d", Group::FastWalking),
            ("fast 5", "walking5.c3d", Group::FastWalking),
            ("fast test", "test_walking.c3d", Group::FastWalking),
        ],
        set: None,
        grf: None,
    },
    Person {
        subject: "rajagopal-run",
        laboratory: "OpenSim, run",
        population: Population::Runner,
        folder: "opensim-rajagopal-run",
        standing: Some("static_run.trc"),
        mass: Some(72.84),
        height: Some(1.80),
        trials: &[("rajagopal-run", "motion_capture_run.trc", Group::Running)],
        set: None,
        grf: Some(("grf_run.mot", ["R_ground_force_", "L_ground_force_"])),
    },
];

/// The recordings of OpenSim's own models.
pub(super) fn on_models() -> [Recording; 3] {
    let (gait, walk) = ("opensim-gait2392-subject01", "opensim-rajagopal-walk");
    let model = "subject01_simbody.osim";
    let recording = |label, subject, folder, kind, grf| Recording {
        label,
        subject,
        laboratory: subject,
        population: Population::Adult,
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
            Kind::Coordinates { motion: "subject01_walk1_ik.mot", model, mass: None },
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
