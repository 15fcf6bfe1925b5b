//! Spellings of the names of muscles, with the recordings and models in which they were seen.
//!
//! A row is a name in small letters without side, without digits, without the words that say nothing
//! ([`super::AnatomicalMuscle::of_name`]). The full names of anatomy need no row.
//!
//! Not in the table, because its meaning is not stated where it was seen: `Spare`, `Pin 1`, `EMG1`.

use super::anatomical::AnatomicalMuscle as M;
use ambulo_body::model::Side;

/// One way to write the name of a muscle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Spelling {
    /// Name in small letters.
    pub name: &'static str,
    /// The muscle.
    pub muscle: M,
    /// The side, where name and side are one word.
    pub side: Option<Side>,
    /// Where it was seen: folder of recordings, or model.
    pub seen: &'static str,
}

const fn seen(name: &'static str, muscle: M, seen: &'static str) -> Spelling {
    Spelling { name, muscle, side: None, seen }
}

const fn sided(name: &'static str, muscle: M, side: Side) -> Spelling {
    Spelling { name, muscle, side: Some(side), seen: C3D_VARIANTS }
}

const PADUA: &str = "C3D motonms-unipd, `Right Biceps femoris caput longu` (32 letters)";
const ARTHRITIS: &str = "C3D arthritis-p3m6, `Left Biceps femoris caput longus`";
const ZOO: &str = "C3D biomechzoo-HC*, `Voltage.R Rect`, `R Tib Ant`";
// The file does not explain GL. It rises at 40 % of the cycle of its own foot and is silent in early stance: a calf
// muscle, not gluteus medius.
const FLAT_FOOT: &str = "C3D btkdata-flatfoot-full, `R_RF`";
const C3D_VARIANTS: &str = "C3D c3d-format-variants type-*, `RTTI` with the description `Rt tibialis`";
const OLD_C3D: &str = "C3D c3d-format-variants Eb015*, description `QUADRICEPS VL EMG - ELE#4`";
const GAIT2392: &str = "OpenSim model Gait2392";
const RAJAGOPAL: &str = "OpenSim model Rajagopal 2016";
const GAIT10DOF: &str = "OpenSim model Gait10dof18musc";
const CEINMS: &str = "OpenSim model Gait2392; EMG of CEINMS-RT LowerLimbModel, `emgFilt.sto`";
const STANFORD: &str = "OpenSim model Rajagopal 2016; EMG of MatlabStaticOptimization, `EMG_allMuscles.sto`";

/// The table.
pub const SPELLINGS: &[Spelling] = &[
    // Recordings.
    seen("biceps femoris caput longus", M::BicepsFemorisLongHead, ARTHRITIS),
    seen("biceps femoris caput longu", M::BicepsFemorisLongHead, PADUA),
    seen("rect", M::RectusFemoris, ZOO),
    seen("hams", M::Hamstrings, ZOO),
    seen("gast", M::Gastrocnemius, ZOO),
    seen("tib ant", M::TibialisAnterior, CEINMS),
    seen("tib post", M::TibialisPosterior, GAIT2392),
    seen("rf", M::RectusFemoris, FLAT_FOOT),
    seen("st", M::Semitendinosus, FLAT_FOOT),
    seen("ta", M::TibialisAnterior, FLAT_FOOT),
    seen("gl", M::GastrocnemiusLateralis, FLAT_FOOT),
    seen("pe", M::Peroneus, FLAT_FOOT),
    sided("rtti", M::TibialisAnterior, Side::Right),
    sided("ltti", M::TibialisAnterior, Side::Left),
    sided("rtga", M::Gastrocnemius, Side::Right),
    sided("ltga", M::Gastrocnemius, Side::Left),
    seen("quadriceps vl", M::VastusLateralis, OLD_C3D),
    seen("quadriceps vm", M::VastusMedialis, OLD_C3D),
    seen("rectus abdominius", M::RectusAbdominis, OLD_C3D),
    // Models of OpenSim, and EMG in storage files with their names.
    seen("glut max", M::GluteusMaximus, GAIT2392),
    seen("glut med", M::GluteusMedius, GAIT2392),
    seen("glut min", M::GluteusMinimus, GAIT2392),
    seen("semimem", M::Semimembranosus, CEINMS),
    seen("semiten", M::Semitendinosus, GAIT2392),
    seen("bifemlh", M::BicepsFemorisLongHead, CEINMS),
    seen("bifemsh", M::BicepsFemorisShortHead, GAIT2392),
    seen("sar", M::Sartorius, GAIT2392),
    seen("add long", M::AdductorLongus, GAIT2392),
    seen("add brev", M::AdductorBrevis, GAIT2392),
    seen("add mag", M::AdductorMagnus, GAIT2392),
    seen("tfl", M::TensorFasciaeLatae, GAIT2392),
    seen("pect", M::Pectineus, GAIT2392),
    seen("grac", M::Gracilis, GAIT2392),
    seen("quad fem", M::QuadratusFemoris, GAIT2392),
    seen("gem", M::Gemelli, GAIT2392),
    seen("peri", M::Piriformis, GAIT2392),
    seen("rect fem", M::RectusFemoris, CEINMS),
    seen("vas med", M::VastusMedialis, CEINMS),
    seen("vas int", M::VastusIntermedius, GAIT2392),
    seen("vas lat", M::VastusLateralis, CEINMS),
    seen("med gas", M::GastrocnemiusMedialis, CEINMS),
    seen("lat gas", M::GastrocnemiusLateralis, CEINMS),
    seen("flex dig", M::FlexorDigitorumLongus, GAIT2392),
    seen("flex hal", M::FlexorHallucisLongus, GAIT2392),
    seen("per brev", M::PeroneusBrevis, GAIT2392),
    seen("per long", M::PeroneusLongus, GAIT2392),
    seen("per tert", M::PeroneusTertius, GAIT2392),
    seen("ext dig", M::ExtensorDigitorumLongus, GAIT2392),
    seen("ext hal", M::ExtensorHallucisLongus, GAIT2392),
    seen("ercspn", M::ErectorSpinae, GAIT2392),
    seen("intobl", M::InternalOblique, GAIT2392),
    seen("extobl", M::ExternalOblique, GAIT2392),
    seen("glmax", M::GluteusMaximus, RAJAGOPAL),
    seen("glmed", M::GluteusMedius, RAJAGOPAL),
    seen("glmin", M::GluteusMinimus, RAJAGOPAL),
    seen("bflh", M::BicepsFemorisLongHead, RAJAGOPAL),
    seen("bfsh", M::BicepsFemorisShortHead, RAJAGOPAL),
    seen("sart", M::Sartorius, RAJAGOPAL),
    seen("addlong", M::AdductorLongus, RAJAGOPAL),
    seen("addbrev", M::AdductorBrevis, RAJAGOPAL),
    seen("addmagdist", M::AdductorMagnus, RAJAGOPAL),
    seen("addmagisch", M::AdductorMagnus, RAJAGOPAL),
    seen("addmagmid", M::AdductorMagnus, RAJAGOPAL),
    seen("addmagprox", M::AdductorMagnus, RAJAGOPAL),
    seen("piri", M::Piriformis, RAJAGOPAL),
    seen("recfem", M::RectusFemoris, STANFORD),
    seen("vasmed", M::VastusMedialis, STANFORD),
    seen("vasint", M::VastusIntermedius, STANFORD),
    seen("vaslat", M::VastusLateralis, STANFORD),
    seen("gasmed", M::GastrocnemiusMedialis, STANFORD),
    seen("gaslat", M::GastrocnemiusLateralis, STANFORD),
    seen("tibant", M::TibialisAnterior, RAJAGOPAL),
    seen("tibpost", M::TibialisPosterior, RAJAGOPAL),
    seen("perlong", M::PeroneusLongus, RAJAGOPAL),
    seen("perbrev", M::PeroneusBrevis, RAJAGOPAL),
    seen("edl", M::ExtensorDigitorumLongus, RAJAGOPAL),
    seen("ehl", M::ExtensorHallucisLongus, RAJAGOPAL),
    seen("fdl", M::FlexorDigitorumLongus, RAJAGOPAL),
    seen("fhl", M::FlexorHallucisLongus, RAJAGOPAL),
    seen("vasti", M::Vasti, GAIT10DOF),
    seen("gastroc", M::Gastrocnemius, GAIT10DOF),
];
