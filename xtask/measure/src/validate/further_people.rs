//! People of further laboratories, who have no part in the numbers of the fit. Facts, masses and traps: README.md of
//! the data. The plates of the runners have a scale fault, so the plates' mass is used there; their centre of pressure
//! is wrong sideways.

use super::people::Person;
use super::recording::{Group, Kind, Population, Recording};

/// Trials of a person: label, file, group.
type Trials = &'static [(&'static str, &'static str, Group)];

/// Publishers low-passed the markers at about 6 Hz.
const fn rehazenter(
    subject: &'static str,
    folder: &'static str,
    standing: &'static str,
    size: [f64; 2],
    trials: Trials,
) -> Person {
    let (laboratory, population) = ("Rehazenter", Population::Adult);
    let (standing, mass, height) = (Some(standing), Some(size[0]), Some(size[1]));
    Person { subject, laboratory, population, folder, standing, mass, height, trials, set: None, grf: None }
}

/// Mass and stature are in the files.
const fn basel(subject: &'static str, population: Population, folder: &'static str, trials: Trials) -> Person {
    let laboratory = "Basel";
    let none = None;
    Person {
        subject,
        laboratory,
        population,
        folder,
        standing: none,
        mass: None,
        height: None,
        trials,
        set: none,
        grf: None,
    }
}

/// Lower body only. The plates carry 96.4 % of the stated masses; `size` is the mean mass that they carry at 2.5 and
/// 3.5 m/s [kg], and the stature [m].
const fn ufabc(
    subject: &'static str,
    folder: &'static str,
    standing: &'static str,
    size: [f64; 2],
    trials: Trials,
) -> Person {
    Person {
        subject,
        laboratory: "UFABC",
        population: Population::Runner,
        folder,
        standing: Some(standing),
        mass: Some(size[0]),
        height: Some(size[1]),
        trials,
        set: Some("runners-ufabc/markers.toml"),
        grf: None,
    }
}

/// Everybody with markers on the built-in body. Left out is the squat of KU Leuven, which has no whole stance.
pub(super) const PEOPLE: [Person; 36] = [
    rehazenter(
        "2014001",
        "adults-rehazenter/2014001",
        "2014001_ST.c3d",
        [67.0, 1.66],
        &[
            ("2014001_C1_01", "2014001_C1_01.c3d", Group::Walking),
            ("2014001_C4_05", "2014001_C4_05.c3d", Group::Walking),
            ("2014001_C5_01", "2014001_C5_01.c3d", Group::FastWalking),
        ],
    ),
    rehazenter(
        "2014007",
        "adults-rehazenter/2014007",
        "2014007_ST.c3d",
        [65.0, 1.69],
        &[
            ("2014007_C4_04", "2014007_C4_04.c3d", Group::Walking),
            ("2014007_C5_04", "2014007_C5_04.c3d", Group::FastWalking),
        ],
    ),
    rehazenter(
        "2014014",
        "adults-rehazenter/2014014",
        "2014014_ST.c3d",
        [92.0, 1.8],
        &[
            ("2014014_C4_05", "2014014_C4_05.c3d", Group::Walking),
            ("2014014_C5_04", "2014014_C5_04.c3d", Group::FastWalking),
        ],
    ),
    rehazenter(
        "2014019",
        "adults-rehazenter/2014019",
        "2014019_ST.c3d",
        [73.8, 1.76],
        &[
            ("2014019_C4_05", "2014019_C4_05.c3d", Group::Walking),
            ("2014019_C5_03", "2014019_C5_03.c3d", Group::FastWalking),
        ],
    ),
    rehazenter(
        "2014025",
        "adults-rehazenter/2014025",
        "2014025_ST.c3d",
        [80.5, 1.66],
        &[
            ("2014025_C4_04", "2014025_C4_04.c3d", Group::Walking),
            ("2014025_C5_02", "2014025_C5_02.c3d", Group::FastWalking),
        ],
    ),
    rehazenter(
        "2014030",
        "adults-rehazenter/2014030",
        "2014030_ST.c3d",
        [60.7, 1.7],
        &[
            ("2014030_C4_03", "2014030_C4_03.c3d", Group::Walking),
            ("2014030_C5_02", "2014030_C5_02.c3d", Group::FastWalking),
        ],
    ),
    rehazenter(
        "2014048",
        "adults-rehazenter/2014048",
        "2014048_ST.c3d",
        [61.5, 1.64],
        &[
            ("2014048_C4_01", "2014048_C4_01.c3d", Group::Walking),
            ("2014048_C5_02", "2014048_C5_02.c3d", Group::FastWalking),
        ],
    ),
    rehazenter(
        "2015007",
        "adults-rehazenter/2015007",
        "2015007_ST.c3d",
        [60.2, 1.66],
        &[
            ("2015007_C4_03", "2015007_C4_03.c3d", Group::Walking),
            ("2015007_C5_03", "2015007_C5_03.c3d", Group::FastWalking),
        ],
    ),
    rehazenter(
        "2015032",
        "adults-rehazenter/2015032",
        "2015032_ST.c3d",
        [50.8, 1.72],
        &[
            ("2015032_C4_03", "2015032_C4_03.c3d", Group::Walking),
            ("2015032_C5_01", "2015032_C5_01.c3d", Group::FastWalking),
        ],
    ),
    rehazenter(
        "2015043",
        "adults-rehazenter/2015043",
        "2015043_ST.c3d",
        [74.0, 1.78],
        &[
            ("2015043_C4_04", "2015043_C4_04.c3d", Group::Walking),
            ("2015043_C5_05", "2015043_C5_05.c3d", Group::FastWalking),
        ],
    ),
    basel(
        "NP1003",
        Population::Adult,
        "basel-three-plates/NP1003",
        &[
            ("NP1003a09", "walkNorm_NP1003a09.c3d", Group::Walking),
            ("NP1003a20", "walkNorm_NP1003a20.c3d", Group::Walking),
        ],
    ),
    basel(
        "NP1004",
        Population::Child,
        "basel-three-plates/NP1004",
        &[
            ("NP1004a05", "walkNorm_NP1004a05.c3d", Group::Walking),
            ("NP1004a06", "walkNorm_NP1004a06.c3d", Group::Walking),
        ],
    ),
    basel(
        "NP1005",
        Population::Child,
        "basel-three-plates/NP1005",
        &[("NP1005a05", "walkNorm_NP1005a05.c3d", Group::Walking)],
    ),
    basel(
        "NP1008",
        Population::Adult,
        "basel-three-plates/NP1008",
        &[
            ("NP1008a11", "walkNorm_NP1008a11.c3d", Group::Walking),
            ("NP1008a12", "walkNorm_NP1008a12.c3d", Group::Walking),
        ],
    ),
    basel(
        "NP1009",
        Population::Child,
        "basel-three-plates/NP1009",
        &[
            ("NP1009a20", "walkNorm_NP1009a20.c3d", Group::Walking),
            ("NP1009a21", "walkNorm_NP1009a21.c3d", Group::Walking),
        ],
    ),
    basel(
        "NP1011",
        Population::Adult,
        "basel-three-plates/NP1011",
        &[("NP1011a17", "walkNorm_NP1011a17.c3d", Group::Walking)],
    ),
    basel(
        "NP1012",
        Population::Adult,
        "basel-three-plates/NP1012",
        &[("NP1012a07", "walkNorm_NP1012a07.c3d", Group::Walking)],
    ),
    basel(
        "NP1014",
        Population::Adult,
        "basel-three-plates/NP1014",
        &[
            ("NP1014a05", "walkNorm_NP1014a05.c3d", Group::Walking),
            ("NP1014a13", "walkNorm_NP1014a13.c3d", Group::Walking),
        ],
    ),
    basel(
        "NP1023",
        Population::Adult,
        "basel-three-plates/NP1023",
        &[
            ("NP1023a03", "walkNorm_NP1023a03.c3d", Group::Walking),
            ("NP1023a04", "walkNorm_NP1023a04.c3d", Group::Walking),
        ],
    ),
    basel(
        "NP1025",
        Population::Adult,
        "basel-three-plates/NP1025",
        &[("NP1025a16", "walkNorm_NP1025a16.c3d", Group::Walking)],
    ),
    basel(
        "NP1026",
        Population::Adult,
        "basel-three-plates/NP1026",
        &[("NP1026a11", "walkNorm_NP1026a11.c3d", Group::Walking)],
    ),
    Person {
        subject: "arthritis",
        laboratory: "arthritis",
        population: Population::Patient,
        folder: "arthritis-p3m6",
        standing: Some("Static.c3d"),
        mass: None,
        height: None,
        trials: &[
            ("arthritis 1", "Walking01.c3d", Group::Walking),
            ("arthritis 2", "Walking02.c3d", Group::Walking),
            ("arthritis 4", "Walking04.c3d", Group::Walking),
            ("arthritis 5", "Walking05.c3d", Group::Walking),
            ("arthritis 6", "Walking06.c3d", Group::Walking),
            ("arthritis 7", "Walking07.c3d", Group::Walking),
        ],
        set: None,
        grf: None,
    },
    Person {
        subject: "KU Leuven",
        laboratory: "KU Leuven",
        population: Population::Adult,
        folder: "kuleuven-walk-squat",
        standing: None,
        mass: Some(64.6),
        height: None,
        trials: &[("KU Leuven", "markers.trc", Group::Walking)],
        set: None,
        grf: Some(("grf.mot", ["1_ground_force_", "ground_force_"])),
    },
    ufabc(
        "RBDS001",
        "runners-ufabc/RBDS001",
        "RBDS001static.trc",
        [60.1, 1.81],
        &[
            ("RBDS001 2.5", "RBDS001runT25.c3d", Group::Running),
            ("RBDS001 3.5", "RBDS001runT35.c3d", Group::Running),
            ("RBDS001 4.5", "RBDS001runT45.c3d", Group::Running),
        ],
    ),
    ufabc(
        "RBDS010",
        "runners-ufabc/RBDS010",
        "RBDS010static.trc",
        [63.7, 1.69],
        &[
            ("RBDS010 2.5", "RBDS010runT25.c3d", Group::Running),
            ("RBDS010 3.5", "RBDS010runT35.c3d", Group::Running),
            ("RBDS010 4.5", "RBDS010runT45.c3d", Group::Running),
        ],
    ),
    ufabc(
        "RBDS012",
        "runners-ufabc/RBDS012",
        "RBDS012static.trc",
        [73.7, 1.786],
        &[
            ("RBDS012 2.5", "RBDS012runT25.c3d", Group::Running),
            ("RBDS012 3.5", "RBDS012runT35.c3d", Group::Running),
            ("RBDS012 4.5", "RBDS012runT45.c3d", Group::Running),
        ],
    ),
    ufabc(
        "RBDS014",
        "runners-ufabc/RBDS014",
        "RBDS014static.trc",
        [74.1, 1.872],
        &[
            ("RBDS014 2.5", "RBDS014runT25.c3d", Group::Running),
            ("RBDS014 3.5", "RBDS014runT35.c3d", Group::Running),
            ("RBDS014 4.5", "RBDS014runT45.c3d", Group::Running),
        ],
    ),
    ufabc(
        "RBDS016",
        "runners-ufabc/RBDS016",
        "RBDS016static.trc",
        [69.7, 1.675],
        &[
            ("RBDS016 2.5", "RBDS016runT25.c3d", Group::Running),
            ("RBDS016 3.5", "RBDS016runT35.c3d", Group::Running),
            ("RBDS016 4.5", "RBDS016runT45.c3d", Group::Running),
        ],
    ),
    ufabc(
        "RBDS018",
        "runners-ufabc/RBDS018",
        "RBDS018static.trc",
        [74.0, 1.845],
        &[
            ("RBDS018 2.5", "RBDS018runT25.c3d", Group::Running),
            ("RBDS018 3.5", "RBDS018runT35.c3d", Group::Running),
            ("RBDS018 4.5", "RBDS018runT45.c3d", Group::Running),
        ],
    ),
    ufabc(
        "RBDS020",
        "runners-ufabc/RBDS020",
        "RBDS020static.trc",
        [66.3, 1.745],
        &[
            ("RBDS020 2.5", "RBDS020runT25.c3d", Group::Running),
            ("RBDS020 3.5", "RBDS020runT35.c3d", Group::Running),
            ("RBDS020 4.5", "RBDS020runT45.c3d", Group::Running),
        ],
    ),
    ufabc(
        "RBDS022",
        "runners-ufabc/RBDS022",
        "RBDS022static.trc",
        [68.8, 1.75],
        &[
            ("RBDS022 2.5", "RBDS022runT25.c3d", Group::Running),
            ("RBDS022 3.5", "RBDS022runT35.c3d", Group::Running),
            ("RBDS022 4.5", "RBDS022runT45.c3d", Group::Running),
        ],
    ),
    ufabc(
        "RBDS024",
        "runners-ufabc/RBDS024",
        "RBDS024static.trc",
        [79.4, 1.819],
        &[
            ("RBDS024 2.5", "RBDS024runT25.c3d", Group::Running),
            ("RBDS024 3.5", "RBDS024runT35.c3d", Group::Running),
            ("RBDS024 4.5", "RBDS024runT45.c3d", Group::Running),
        ],
    ),
    ufabc(
        "RBDS026",
        "runners-ufabc/RBDS026",
        "RBDS026static.trc",
        [75.7, 1.819],
        &[
            ("RBDS026 2.5", "RBDS026runT25.c3d", Group::Running),
            ("RBDS026 3.5", "RBDS026runT35.c3d", Group::Running),
            ("RBDS026 4.5", "RBDS026runT45.c3d", Group::Running),
        ],
    ),
    ufabc(
        "RBDS028",
        "runners-ufabc/RBDS028",
        "RBDS028static.trc",
        [57.7, 1.627],
        &[
            ("RBDS028 2.5", "RBDS028runT25.c3d", Group::Running),
            ("RBDS028 3.5", "RBDS028runT35.c3d", Group::Running),
            ("RBDS028 4.5", "RBDS028runT45.c3d", Group::Running),
        ],
    ),
    ufabc(
        "RBDS04",
        "runners-ufabc/RBDS04",
        "RBDS04static.trc",
        [55.7, 1.68],
        &[
            ("RBDS04 2.5", "RBDS04runT25.c3d", Group::Running),
            ("RBDS04 3.5", "RBDS04runT35.c3d", Group::Running),
            ("RBDS04 4.5", "RBDS04runT45.c3d", Group::Running),
        ],
    ),
    ufabc(
        "RBDS08",
        "runners-ufabc/RBDS08",
        "RBDS08static.trc",
        [67.6, 1.8],
        &[
            ("RBDS08 2.5", "RBDS08runT25.c3d", Group::Running),
            ("RBDS08 3.5", "RBDS08runT35.c3d", Group::Running),
            ("RBDS08 4.5", "RBDS08runT45.c3d", Group::Running),
        ],
    ),
];

/// The recordings on models: the treadmill walkers have angles that other programs fitted, the first one without arms.
/// The model of the second one weighs 75.2 kg, the plates 58.0 kg.
pub(super) fn on_models() -> [Recording; 6] {
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
    let open_cap = |label, group, markers, table| {
        let model = "LaiArnoldModified2017_poly_withArms_weldHand_scaled.osim";
        let grf = (table, ["R_ground_force_", "L_ground_force_"]);
        let kind = Kind::ModelMarkers { markers, model };
        Recording { group, ..recording(label, "OpenCap", "opencap-adult-83kg", kind, grf) }
    };
    let ceinms = |label, motion, table| {
        let kind = Kind::Coordinates { motion, model: "gait2392.osim", mass: Some(58.03) };
        recording(label, "CEINMS", "muscles/B-ceinms-lowerlimb", kind, (table, ["ground_force_", "l_ground_force_"]))
    };
    [
        open_cap("OpenCap", Group::Walking, "walking2.trc", "walking2_forces.mot"),
        open_cap("OpenCap jump 1", Group::Jumping, "DJ1.trc", "DJ1_forces.mot"),
        open_cap("OpenCap jump 2", Group::Jumping, "DJ2.trc", "DJ2_forces.mot"),
        recording(
            "retraining",
            "retraining",
            "muscles/A-stanford-matlabso",
            Kind::Coordinates { motion: "results_ik.sto", model: "Rajagopal_scaled_Sub1_gasAvoid.osim", mass: None },
            ("walking_baseline1_forces.mot", ["ground_force_", "1_ground_force_"]),
        ),
        ceinms("CEINMS 1.0", "walk36/ik.sto", "walk36/XLD.mot"),
        ceinms("CEINMS 1.25", "walk45/ik.sto", "walk45/XLD.mot"),
    ]
}
