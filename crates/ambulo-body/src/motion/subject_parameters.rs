//! Reads the data of the person from a C3D file.
//!
//! Their names are not standardised. Vicon's programs write `PROCESSING:Bodymass` [kg], `PROCESSING:Height` [mm] and
//! the measurements of Plug-in-Gait [mm]; the samples of c3d.org have `SUBJECT:WEIGHT` [kg] and `SUBJECT:HEIGHT`, whose
//! unit field contradicts its value. The unit of a stature is therefore inferred from its size: persons are 0.3 to 3 m
//! tall.

use ambulo_formats::c3d::C3d;

/// Plausible statures [m].
const STATURES: [f64; 2] = [0.3, 3.0];
/// Plausible masses [kg].
const MASSES: [f64; 2] = [1.0, 400.0];
/// Parameters with a body mass, in kg: group and name.
const MASS_NAMES: [(&str, &str); 6] = [
    ("PROCESSING", "Bodymass"),
    ("PROCESSING", "BodyMass"),
    ("SUBJECT", "WEIGHT"),
    ("SUBJECT", "MASS"),
    ("SUBJECTS", "WEIGHT"),
    ("SUBJECTS", "MASS"),
];
/// Parameters with a stature: group and name.
const HEIGHT_NAMES: [(&str, &str); 3] = [("PROCESSING", "Height"), ("SUBJECT", "HEIGHT"), ("SUBJECTS", "HEIGHT")];

/// Data of a person in a file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SubjectParameters {
    /// Name or number of the person: `SUBJECTS:NAMES`.
    pub name: Option<String>,
    /// Day of the recording, as YYYY-MM-DD: `TRIAL:DATE` (year, month, day).
    pub recorded_on: Option<String>,
    /// Body mass [kg].
    pub mass_kg: Option<f64>,
    /// Stature [m].
    pub height_m: Option<f64>,
    /// Every number of the group PROCESSING with its name, unchanged; lengths in mm.
    pub processing: Vec<(String, f64)>,
}

impl SubjectParameters {
    /// The number with this name in the group PROCESSING, ignoring case.
    #[must_use]
    pub fn processing(&self, name: &str) -> Option<f64> {
        self.processing.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|(_, value)| *value)
    }
}

/// Reads the data of the person. Implausible values are left out.
#[must_use]
pub fn subject_from_c3d(c3d: &C3d) -> SubjectParameters {
    let stated = |names: &[(&str, &str)]| names.iter().find_map(|(group, name)| c3d.parameters.number(group, name));
    let within = |value: f64, [least, most]: [f64; 2]| (least..=most).contains(&value).then_some(value);
    let height = |value: f64| [1.0, 1e-2, 1e-3].into_iter().find_map(|unit| within(unit * value, STATURES));
    let processing = c3d.parameters.group("PROCESSING").map(|group| {
        let number = |p: &ambulo_formats::c3d::Parameter| Some((p.name.clone(), *p.numbers()?.first()?));
        group.parameters.iter().filter_map(number).collect()
    });
    let names = c3d.parameters.texts("SUBJECTS", "NAMES");
    let names: Vec<&str> = names.into_iter().map(str::trim).filter(|name| !name.is_empty()).collect();
    SubjectParameters {
        name: (!names.is_empty()).then(|| names.join(", ")),
        recorded_on: day(c3d),
        mass_kg: stated(&MASS_NAMES).and_then(|mass| within(mass, MASSES)),
        height_m: stated(&HEIGHT_NAMES).and_then(height),
        processing: processing.unwrap_or_default(),
    }
}

fn day(c3d: &C3d) -> Option<String> {
    let [year, month, day] = c3d.parameters.get("TRIAL", "DATE")?.counts()?.try_into().ok()?;
    let is_day = (1900..=2200).contains(&year) && (1..=12).contains(&month) && (1..=31).contains(&day);
    is_day.then(|| format!("{year:04}-{month:02}-{day:02}"))
}
