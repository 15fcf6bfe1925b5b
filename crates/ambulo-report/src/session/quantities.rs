//! The quantities of a session, and the scales of their panels, which are the same for every session.

use crate::clinical::{Wording, wording};

/// The name of foot progression, which no coordinate of a body measures.
pub(super) const FOOT_PROGRESSION: &str = "foot_progression_angle";

/// A quantity with the range of its ordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SessionQuantity {
    /// As in `clinical.csv`, without the side: `hip_flexion_moment`.
    pub id: &'static str,
    /// Lowest and highest number of the ordinate.
    pub scale: [f64; 2],
}

impl SessionQuantity {
    pub(crate) fn wording(self) -> Wording {
        const PROGRESSION: Wording =
            Wording { title: "Foot progression", unit: "deg", directions: ["internal", "external"] };
        const UNKNOWN: Wording = Wording { title: "", unit: "", directions: [""; 2] };
        match self.id {
            FOOT_PROGRESSION => PROGRESSION,
            "hip_contact_force" => load("Hip contact force", ["", ""]),
            "knee_contact_force" => load("Knee contact force", ["", ""]),
            "ankle_contact_force" => load("Ankle contact force", ["", ""]),
            "knee_medial_force" => load("Knee force, medial", PRESSED),
            "knee_lateral_force" => load("Knee force, lateral", PRESSED),
            // The words stand along the ordinate of a small panel.
            "hip_rotation_moment" | "knee_rotation_moment" | "ankle_rotation_moment" => {
                Wording { directions: ["external", "internal"], ..wording(self.id).unwrap_or(UNKNOWN) }
            }
            id => wording(id).unwrap_or(UNKNOWN),
        }
    }

    /// The title, for tables.
    #[must_use]
    pub fn label(self) -> String {
        self.wording().title.to_owned()
    }
}

/// Signs of the force on a condyle.
const PRESSED: [&str; 2] = ["compression", "lift-off"];

const fn load(title: &'static str, directions: [&'static str; 2]) -> Wording {
    Wording { title, unit: "BW", directions }
}

const fn of(id: &'static str, low: f64, high: f64) -> SessionQuantity {
    SessionQuantity { id, scale: [low, high] }
}

/// Angles [deg], three in a row: pelvis, hip, then knee, ankle and foot; then the trunk, and what few bodies have.
pub const ANGLES: [SessionQuantity; 15] = [
    of("pelvis_tilt_angle", -20.0, 40.0),
    of("pelvis_obliquity_angle", -30.0, 30.0),
    of("pelvis_rotation_angle", -30.0, 30.0),
    of("hip_flexion_angle", -20.0, 70.0),
    of("hip_adduction_angle", -30.0, 30.0),
    of("hip_rotation_angle", -40.0, 40.0),
    of("knee_flexion_angle", -15.0, 75.0),
    of("ankle_dorsiflexion_angle", -40.0, 30.0),
    of(FOOT_PROGRESSION, -50.0, 30.0),
    of("trunk_lean_angle", -30.0, 30.0),
    of("trunk_obliquity_angle", -30.0, 30.0),
    of("trunk_rotation_angle", -30.0, 30.0),
    of("knee_adduction_angle", -30.0, 30.0),
    of("knee_rotation_angle", -40.0, 40.0),
    of("subtalar_angle", -30.0, 30.0),
];

/// Moments [N.m/kg], powers [W/kg] and ground forces [body weights], three in a row.
pub(crate) const KINETICS: [SessionQuantity; 15] = [
    of("hip_flexion_moment", -2.0, 2.0),
    of("knee_flexion_moment", -1.5, 1.5),
    of("ankle_dorsiflexion_moment", -1.0, 2.5),
    of("hip_flexion_power", -3.0, 3.0),
    of("knee_flexion_power", -3.0, 3.0),
    of("ankle_dorsiflexion_power", -2.0, 5.0),
    of("hip_adduction_moment", -1.0, 1.5),
    of("knee_adduction_moment", -1.0, 1.0),
    of("ankle_inversion_moment", -0.5, 0.5),
    of("hip_rotation_moment", -0.5, 0.5),
    of("knee_rotation_moment", -0.5, 0.5),
    of("ankle_rotation_moment", -0.5, 0.5),
    of("ground_force_vertical", 0.0, 1.5),
    of("ground_force_fore_aft", -0.4, 0.4),
    of("ground_force_lateral", -0.2, 0.2),
];

/// Loads of joints with the forces of the muscles [body weights], three in a row.
pub(crate) const CONTACT: [SessionQuantity; 5] = [
    of("hip_contact_force", 0.0, 8.0),
    of("knee_contact_force", 0.0, 8.0),
    of("ankle_contact_force", 0.0, 8.0),
    of("knee_medial_force", -1.0, 5.0),
    of("knee_lateral_force", -1.0, 5.0),
];

/// All quantities, in the order of files and tables.
pub fn all() -> impl Iterator<Item = SessionQuantity> {
    ANGLES.into_iter().chain(KINETICS).chain(CONTACT)
}

/// The quantity with this name.
pub(crate) fn named(id: &str) -> Option<SessionQuantity> {
    all().find(|quantity| quantity.id == id)
}
