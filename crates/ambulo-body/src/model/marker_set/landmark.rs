//! Anatomical landmarks of markers.

use super::Segment;
use super::segment::{FOLLOWING_WEIGHT, LOOSE_WEIGHT};
use crate::spatial::Vec3;

/// An anatomical landmark, or a joint centre computed by a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[expect(missing_docs, reason = "each landmark is described in the table below, which docs/MARKERS.md repeats")]
pub enum Landmark {
    Asis,
    Psis,
    Sacrum,
    IliacCrest,
    HipCentre,
    MidHip,
    GreaterTrochanter,
    ThighWand,
    LateralEpicondyle,
    MedialEpicondyle,
    KneeCentre,
    ShankWand,
    FibulaHead,
    TibialTuberosity,
    LateralMalleolus,
    MedialMalleolus,
    AnkleCentre,
    Heel,
    SecondToe,
    FirstMetatarsal,
    FifthMetatarsal,
    FifthBase,
    FirstBase,
    LateralCalcaneus,
    MedialCalcaneus,
    Navicular,
    Hallux,
    SmallToe,
    C7,
    T2,
    T8,
    T10,
    T12,
    Jugular,
    Xiphoid,
    Acromion,
    ShoulderCentre,
    Neck,
    FrontHead,
    BackHead,
    Ear,
    Nose,
    Vertex,
    LateralElbow,
    MedialElbow,
    ElbowCentre,
    RadialStyloid,
    UlnarStyloid,
    WristCentre,
    Knuckle,
}

/// A row of the table: the word in files, the segment, the position on the right side as shares of the segment length,
/// and the meaning.
pub(super) struct Row {
    pub(super) landmark: Landmark,
    pub(super) word: &'static str,
    pub(super) segment: Segment,
    pub(super) place: [f64; 3],
    pub(super) meaning: &'static str,
}

const fn row(landmark: Landmark, word: &'static str, segment: Segment, place: [f64; 3], meaning: &'static str) -> Row {
    Row { landmark, word, segment, place, meaning }
}

/// Marker positions on an average body in standing. The pelvis follows from Harrington's regression for a pelvis 238 mm
/// wide and 155 mm deep, tilted forwards by 11.7°; trunk and head from de Leva's lengths and the heights of cervicale
/// and acromion; knee, ankle and elbow from mean widths between the condyles and malleoli plus the radius of a marker;
/// the others are rounded positions of the markers of subject01 of OpenSim's Gait2392 and of the Rajagopal example.
/// Recorded positions replace these.
pub(super) const TABLE: [Row; 50] = {
    use Landmark as L;
    use Segment as S;
    [
        row(L::Asis, "asis", S::Pelvis, [0.41, 0.42, 0.72], "anterior superior iliac spine"),
        row(L::Psis, "psis", S::Pelvis, [-0.58, 0.62, 0.27], "posterior superior iliac spine"),
        row(L::Sacrum, "sacrum", S::Pelvis, [-0.58, 0.62, 0.0], "midway between the posterior superior iliac spines"),
        row(L::IliacCrest, "iliac_crest", S::Pelvis, [0.0, 0.95, 0.85], "highest point of the iliac crest"),
        row(
            L::HipCentre,
            "hip_centre",
            S::Pelvis,
            [0.0, 0.0, 0.5],
            "centre of the hip joint, as computed by a program",
        ),
        row(L::MidHip, "mid_hip", S::Pelvis, [0.0, 0.0, 0.0], "midway between the hip centres"),
        row(L::GreaterTrochanter, "greater_trochanter", S::Femur, [-0.03, 0.0, 0.2], "greater trochanter"),
        row(
            L::ThighWand,
            "thigh_wand",
            S::Femur,
            [0.0, -0.55, 0.22],
            "side of the thigh, in the plane of hip centre and knee axis",
        ),
        row(
            L::LateralEpicondyle,
            "lateral_epicondyle",
            S::Femur,
            [0.0, -1.0, 0.14],
            "lateral epicondyle of the femur, on the knee axis",
        ),
        row(L::MedialEpicondyle, "medial_epicondyle", S::Femur, [0.0, -1.0, -0.14], "medial epicondyle of the femur"),
        row(L::KneeCentre, "knee_centre", S::Femur, [0.0, -1.0, 0.0], "centre of the knee, as computed by a program"),
        row(
            L::ShankWand,
            "shank_wand",
            S::Tibia,
            [0.0, -0.5, 0.15],
            "side of the shank, in the plane of knee centre and ankle axis",
        ),
        row(L::FibulaHead, "fibula_head", S::Tibia, [-0.03, -0.06, 0.13], "head of the fibula"),
        row(L::TibialTuberosity, "tibial_tuberosity", S::Tibia, [0.11, -0.11, 0.0], "tuberosity of the tibia"),
        row(L::LateralMalleolus, "lateral_malleolus", S::Tibia, [-0.02, -1.0, 0.1], "lateral malleolus"),
        row(L::MedialMalleolus, "medial_malleolus", S::Tibia, [0.02, -0.97, -0.09], "medial malleolus"),
        row(
            L::AnkleCentre,
            "ankle_centre",
            S::Tibia,
            [0.0, -1.0, 0.0],
            "centre of the ankle, as computed by a program",
        ),
        row(L::Heel, "heel", S::Foot, [-0.28, -0.15, 0.0], "rear of the heel, as high as the toe marker"),
        row(L::SecondToe, "second_toe", S::Foot, [0.47, -0.12, 0.0], "head of the second metatarsal, from above"),
        row(L::FirstMetatarsal, "first_metatarsal", S::Foot, [0.48, -0.16, -0.16], "head of the first metatarsal"),
        row(L::FifthMetatarsal, "fifth_metatarsal", S::Foot, [0.38, -0.19, 0.19], "head of the fifth metatarsal"),
        row(L::FifthBase, "fifth_base", S::Foot, [0.14, -0.19, 0.16], "base of the fifth metatarsal"),
        row(L::FirstBase, "first_base", S::Foot, [0.25, -0.06, -0.12], "base of the first metatarsal"),
        row(L::LateralCalcaneus, "lateral_calcaneus", S::Foot, [-0.1, -0.15, 0.13], "lateral side of the calcaneus"),
        row(L::MedialCalcaneus, "medial_calcaneus", S::Foot, [-0.02, -0.13, -0.13], "sustentaculum tali"),
        row(L::Navicular, "navicular", S::Foot, [0.13, -0.05, -0.13], "tuberosity of the navicular"),
        row(L::Hallux, "hallux", S::Toes, [0.2, 0.02, -0.1], "great toe"),
        row(L::SmallToe, "small_toe", S::Toes, [0.08, 0.0, 0.15], "small toe"),
        row(L::C7, "c7", S::Torso, [-0.24, 1.36, 0.0], "spinous process of the seventh cervical vertebra"),
        row(L::T2, "t2", S::Torso, [-0.33, 1.26, 0.0], "spinous process of the second thoracic vertebra"),
        row(L::T8, "t8", S::Torso, [-0.43, 0.8, 0.0], "spinous process of the eighth thoracic vertebra"),
        row(L::T10, "t10", S::Torso, [-0.43, 0.56, 0.0], "spinous process of the tenth thoracic vertebra"),
        row(L::T12, "t12", S::Torso, [-0.38, 0.37, 0.0], "spinous process of the twelfth thoracic vertebra"),
        row(L::Jugular, "jugular", S::Torso, [0.16, 1.08, 0.0], "jugular notch, where the clavicles meet the sternum"),
        row(L::Xiphoid, "xiphoid", S::Torso, [0.3, 0.55, 0.0], "xiphoid process of the sternum"),
        row(L::Acromion, "acromion", S::Torso, [-0.02, 1.15, 0.55], "acromion"),
        row(
            L::ShoulderCentre,
            "shoulder_centre",
            S::Torso,
            [0.0, 1.0, 0.55],
            "centre of the shoulder, as computed by a program",
        ),
        row(L::Neck, "neck", S::Torso, [0.0, 1.2, 0.0], "midway between the shoulders, at the neck"),
        row(L::FrontHead, "front_head", S::Torso, [0.3, 1.75, 0.22], "side of the forehead"),
        row(L::BackHead, "back_head", S::Torso, [-0.2, 1.78, 0.22], "side of the back of the head"),
        row(L::Ear, "ear", S::Torso, [0.05, 1.62, 0.22], "ear or temple"),
        row(L::Nose, "nose", S::Torso, [0.38, 1.55, 0.0], "nose"),
        row(L::Vertex, "vertex", S::Torso, [0.0, 1.95, 0.0], "top of the head"),
        row(L::LateralElbow, "lateral_elbow", S::Humerus, [0.0, -1.0, 0.15], "lateral epicondyle of the humerus"),
        row(L::MedialElbow, "medial_elbow", S::Humerus, [0.0, -1.0, -0.15], "medial epicondyle of the humerus"),
        row(
            L::ElbowCentre,
            "elbow_centre",
            S::Humerus,
            [0.0, -1.0, 0.0],
            "centre of the elbow, as computed by a program",
        ),
        row(L::RadialStyloid, "radial_styloid", S::Forearm, [0.13, -1.0, 0.0], "wrist, on the thumb's side"),
        row(L::UlnarStyloid, "ulnar_styloid", S::Forearm, [-0.13, -1.0, 0.0], "wrist, on the little finger's side"),
        row(
            L::WristCentre,
            "wrist_centre",
            S::Forearm,
            [0.0, -1.0, 0.0],
            "centre of the wrist, as computed by a program",
        ),
        row(L::Knuckle, "knuckle", S::Forearm, [0.0, -1.3, 0.07], "head of the third metacarpal, back of the hand"),
    ]
};

impl Landmark {
    /// All landmarks, from the pelvis down to the toes and then from the trunk up.
    pub fn all() -> impl Iterator<Item = Landmark> {
        TABLE.iter().map(|row| row.landmark)
    }

    fn row(self) -> &'static Row {
        &TABLE[self as usize]
    }

    /// The word in files of marker sets.
    #[must_use]
    pub fn word(self) -> &'static str {
        self.row().word
    }

    /// Anatomical description.
    #[must_use]
    pub fn meaning(self) -> &'static str {
        self.row().meaning
    }

    /// The segment that it is fixed to.
    #[must_use]
    pub fn segment(self) -> Segment {
        self.row().segment
    }

    /// Default weight of a marker on it in a fit: 1 if it defines a joint centre; less on wands, on the skin along
    /// thigh and shank, and on a trunk that bends; little on arms and shoulders, which move relative to the trunk, and
    /// on the head. Joint centres therefore follow the landmarks that define them, as in Plug-in-Gait.
    #[must_use]
    pub fn weight(self) -> f64 {
        use Landmark as L;
        match (self, self.segment()) {
            (_, Segment::Humerus | Segment::Forearm)
            | (L::Acromion | L::ShoulderCentre | L::FrontHead | L::BackHead | L::Ear | L::Nose | L::Vertex, _) => {
                LOOSE_WEIGHT
            }
            (L::ThighWand | L::ShankWand | L::FibulaHead | L::TibialTuberosity | L::GreaterTrochanter, _)
            | (_, Segment::Torso) => FOLLOWING_WEIGHT,
            _ => 1.0,
        }
    }

    /// Position of a marker on it on an average body, on the right side, as shares of the segment length.
    #[must_use]
    pub fn place(self) -> Vec3 {
        Vec3::from(self.row().place)
    }
}
