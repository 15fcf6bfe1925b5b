//! Recognises the part of a person that a body is, from its name.

use crate::model::Side;

/// A part of a person.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    Pelvis,
    Trunk,
    Head,
    Thigh,
    Shank,
    /// A small body between shank and foot, or on the knee.
    Small,
    Foot,
    Toes,
    UpperArm,
    Forearm,
    /// One of the two bones of a forearm.
    Ulna,
    Hand,
    /// Anything else.
    Other,
}

/// Names of bodies without their side, in lower case.
const NAMES: [(&str, Part); 26] = [
    ("pelvis", Part::Pelvis),
    ("hips", Part::Pelvis),
    ("torso", Part::Trunk),
    ("trunk", Part::Trunk),
    ("thorax", Part::Trunk),
    ("head", Part::Head),
    ("skull", Part::Head),
    ("head_neck", Part::Head),
    ("femur", Part::Thigh),
    ("thigh", Part::Thigh),
    ("tibia", Part::Shank),
    ("shank", Part::Shank),
    ("talus", Part::Small),
    ("patella", Part::Small),
    ("calcn", Part::Foot),
    ("foot", Part::Foot),
    ("toes", Part::Toes),
    ("humerus", Part::UpperArm),
    ("upperarm", Part::UpperArm),
    ("upper_arm", Part::UpperArm),
    ("ulna", Part::Ulna),
    ("radius", Part::Forearm),
    ("forearm", Part::Forearm),
    ("lowerarm", Part::Forearm),
    ("hand", Part::Hand),
    ("lumbar5", Part::Trunk),
];

impl Part {
    pub(super) fn of(name: &str) -> Part {
        let stem = Side::split_name(name).map_or_else(|| name.to_owned(), |(_, stem)| stem).to_lowercase();
        NAMES.iter().find(|(known, _)| *known == stem).map_or(Part::Other, |(_, part)| *part)
    }
}
