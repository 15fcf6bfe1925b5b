//! What a C3D states of the person who was recorded.
//!
//! No standard names them. Vicon's programs write `PROCESSING:Bodymass` [kg], `PROCESSING:Height` [mm] and the measures of
//! Plug-in-Gait [mm]; c3d.org's samples have `SUBJECT:WEIGHT` [kg] and `SUBJECT:HEIGHT`, whose unit field contradicts its value.
//! So lengths are believed by size: no person is taller than 3 m, and none who is recorded is smaller than 0.3 m.

use ambulo_formats::c3d::C3d;

/// Statures that are believed [m].
const STATURES: [f64; 2] = [0.3, 3.0];
/// Masses that are believed [kg].
const MASSES: [f64; 2] = [1.0, 400.0];
/// Names under which programs store a mass, in kg; groups before names.
const MASS_NAMES: [(&str, &str); 6] = [
    ("PROCESSING", "Bodymass"),
    ("PROCESSING", "BodyMass"),
    ("SUBJECT", "WEIGHT"),
    ("SUBJECT", "MASS"),
    ("SUBJECTS", "WEIGHT"),
    ("SUBJECTS", "MASS"),
];
/// Names under which programs store a stature.
const HEIGHT_NAMES: [(&str, &str); 3] = [("PROCESSING", "Height"), ("SUBJECT", "HEIGHT"), ("SUBJECTS", "HEIGHT")];

/// A person as a file describes them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SubjectParameters {
    /// Body mass [kg].
    pub mass_kg: Option<f64>,
    /// Stature [m].
    pub height_m: Option<f64>,
    /// Every number of the group PROCESSING by its name, as it stands there; lengths in mm.
    pub processing: Vec<(String, f64)>,
}

impl SubjectParameters {
    /// The number with this name in the group PROCESSING; upper and lower case are one.
    #[must_use]
    pub fn processing(&self, name: &str) -> Option<f64> {
        self.processing.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|(_, value)| *value)
    }
}

/// What the file states of the person. Values that no person has are left out.
#[must_use]
pub fn subject_from_c3d(c3d: &C3d) -> SubjectParameters {
    let stated = |names: &[(&str, &str)]| names.iter().find_map(|(group, name)| c3d.parameters.number(group, name));
    let within = |value: f64, [least, most]: [f64; 2]| (least..=most).contains(&value).then_some(value);
    let height = |value: f64| [1.0, 1e-2, 1e-3].into_iter().find_map(|unit| within(unit * value, STATURES));
    let processing = c3d.parameters.group("PROCESSING").map(|group| {
        let number = |p: &ambulo_formats::c3d::Parameter| Some((p.name.clone(), *p.numbers()?.first()?));
        group.parameters.iter().filter_map(number).collect()
    });
    SubjectParameters {
        mass_kg: stated(&MASS_NAMES).and_then(|mass| within(mass, MASSES)),
        height_m: stated(&HEIGHT_NAMES).and_then(height),
        processing: processing.unwrap_or_default(),
    }
}
