//! Calibration of the estimate for one person by trials on force plates, for the person's other trials.
//!
//! Errors of the estimate are personal and repeat: segments with other masses than in the table, an own way to strike.
//! The mean error of a few stances on plates, weighted by their reliability ([`super::stance_errors`]), is taken
//! off the estimate of the same foot; with stances of one foot only, the other foot gets its mirror image. The standard
//! deviations shrink to what remains.

use super::stance_errors::{KNOTS, REPEATS, StanceCurve, StanceErrors, trusted};
use crate::model::{BySide, Model, Side};
use crate::toml_reader::{Source, Table, TomlError, Value};
use std::fmt::Write as _;

/// Largest difference of mass, stature and leg length of the same person, as a share: clothes, and errors of a
/// calibration.
const SAME_PERSON: f64 = 0.05;
const DOCUMENT: &str = "docs/GROUND_FORCES.md";
/// Keys of the curves of a foot, in the order of [`StanceErrors`].
const KEYS: [&str; 5] = ["forward", "up", "outwards", "center_along", "center_outwards"];

/// Mean errors of the estimate for a person.
#[derive(Debug, Clone, PartialEq)]
pub struct PersonalErrors {
    /// Body mass [kg].
    pub mass_kg: f64,
    /// Stature [m].
    pub stature_m: f64,
    /// Length of a leg [m].
    pub leg_length_m: f64,
    /// Number of stances on plates.
    pub stances: BySide<usize>,
    /// Measured minus estimated, mean over these stances.
    pub errors: BySide<StanceErrors>,
    /// Of which estimate: [`FittedParameters::fingerprint`](super::FittedParameters::fingerprint).
    pub estimator: u64,
    /// Checksum of the name of the person in the files of the trials, if they have one: [`checksum`](super::checksum).
    pub subject: Option<u64>,
    /// The largest mean error of a force, as a multiple of its standard deviation; both root mean squares over a
    /// stance. For recorded subjects it is within about three.
    pub excess: f64,
}

/// Mean errors beyond this number of standard deviations of the estimate come from one person in 300, or from plates,
/// markers or a mass that do not belong together.
const USUAL_EXCESS: f64 = 3.0;

/// A person that is not the calibrated one.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "the person has a {what} of {found:.3} {unit}, the calibrated person {expected:.3} {unit}; expected a difference \
     of at most 5 %"
)]
pub struct OtherPerson {
    /// Mass, stature or leg length.
    pub what: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Value of the person in the motion.
    pub found: f64,
    /// Value of the calibrated person.
    pub expected: f64,
}

impl PersonalErrors {
    /// Whether a model has the size of the person.
    ///
    /// # Errors
    /// Mass, stature or leg length differs by more than 5 %.
    pub fn check(&self, model: &Model) -> Result<(), OtherPerson> {
        let stature = model.stature();
        let sizes = [
            ("mass", "kg", model.mass(), self.mass_kg),
            ("stature", "m", stature.height_m, self.stature_m),
            ("leg length", "m", stature.leg_length_m, self.leg_length_m),
        ];
        for (what, unit, found, expected) in sizes {
            let is_same = (found / expected - 1.0).abs() <= SAME_PERSON;
            if !is_same {
                return Err(OtherPerson { what, unit, found, expected });
            }
        }
        Ok(())
    }

    /// Whether the mean errors are larger than for nearly all persons.
    #[must_use]
    pub fn is_unusual(&self) -> bool {
        self.excess > USUAL_EXCESS
    }

    /// Whether the files name another person, by the checksum of the name.
    #[must_use]
    pub fn is_named_otherwise(&self, subject: Option<u64>) -> bool {
        self.subject.zip(subject).is_some_and(|(calibrated, found)| calibrated != found)
    }

    /// The errors of a foot, and their weight (0 to 1).
    fn of(&self, side: Side) -> (&StanceErrors, f64) {
        let other = if side == Side::Right { Side::Left } else { Side::Right };
        let from = if self.stances[side] > 0 { side } else { other };
        (&self.errors[from], trusted(self.stances[from]))
    }

    /// Force forward, up, to the right [body weights] that is added to the estimate.
    #[doc(hidden)] // for tests
    pub fn force(&self, side: Side, phase: f64) -> [f64; 3] {
        let (errors, trust) = self.of(side);
        errors.force(side, phase).map(|error| trust * error)
    }

    /// Centre of pressure forward and to the right [stature] that is added.
    pub(super) fn center(&self, side: Side, phase: f64) -> [f64; 2] {
        let (errors, trust) = self.of(side);
        errors.center(side, phase).map(|error| trust * error)
    }

    /// Share of the variance of an error that remains.
    #[doc(hidden)] // for tests
    pub fn remaining(&self, side: Side) -> f64 {
        1.0 - REPEATS * self.of(side).1
    }

    /// As a file.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let mut text = format!(
            "# What force plates have shown about the ground forces that are predicted for a person: \
             docs/GROUND_FORCES.md.\n\
             # Measured minus predicted over the stance: forces in body weights, centre of pressure in statures.\n\
             mass_kg = {:.4}\nstature_m = {:.4}\nleg_length_m = {:.4}\nstances = [{}, {}] # right, left\nestimator = \
             \"{:016x}\"\n",
            self.mass_kg, self.stature_m, self.leg_length_m, self.stances.right, self.stances.left, self.estimator
        );
        if let Some(subject) = self.subject {
            let _ = writeln!(text, "subject = \"{subject:016x}\" # checksum of the name in the files");
        }
        let _ =
            writeln!(text, "excess = {:.4} # largest mean error, in standard deviations of the estimate", self.excess);
        for (side, errors) in self.errors.iter() {
            let _ = write!(text, "\n[{side}]\n");
            let curves = errors.force.iter().chain(&errors.center);
            for (key, curve) in KEYS.iter().zip(curves) {
                let numbers: Vec<String> = curve.0.iter().map(|x| format!("{x:.6}")).collect();
                let _ = writeln!(text, "{key} = [{}]", numbers.join(", "));
            }
        }
        text
    }

    /// From the text of a file.
    ///
    /// # Errors
    /// Keys that are unknown or missing, numbers out of range.
    pub fn from_toml(text: &str) -> Result<PersonalErrors, TomlError> {
        let source = Source::new(text, DOCUMENT);
        let parsed = source.parse()?;
        let root = Table::root(&source, &parsed);
        root.only(&[&[
            "mass_kg",
            "stature_m",
            "leg_length_m",
            "stances",
            "estimator",
            "subject",
            "excess",
            "right",
            "left",
        ]])?;
        let size = |key: &str, what: &str| root.need(key, what)?.above_zero();
        let count = "stances of the right and the left foot";
        let stances = root.need("stances", count)?;
        let [right, left] = stances.numbers::<2>("two counts")?;
        if ![right, left].iter().all(|n| (0.0..1e6).contains(n) && n.fract() == 0.0) || right + left < 1.0 {
            return Err(stances.wrong("two whole numbers, one of them at least 1"));
        }
        let of_estimator = root.need("estimator", "the estimate whose errors these are, 16 hexadecimal digits")?;
        let hexadecimal =
            |value: Value<'_>| u64::from_str_radix(value.text()?, 16).map_err(|_| value.wrong("16 hexadecimal digits"));
        let subject = root.get("subject").map(hexadecimal).transpose()?;
        let foot = |side: &str| -> Result<StanceErrors, TomlError> {
            let table = root.need(side, "the curves of this foot")?.table("the curves of this foot")?;
            table.only(&[&KEYS])?;
            let curve = |key: &str| {
                let value = table.need(key, "a curve over the stance")?;
                value.numbers::<{ KNOTS.len() }>("15 numbers").map(StanceCurve)
            };
            Ok(StanceErrors {
                force: [curve(KEYS[0])?, curve(KEYS[1])?, curve(KEYS[2])?],
                center: [curve(KEYS[3])?, curve(KEYS[4])?],
            })
        };
        Ok(PersonalErrors {
            mass_kg: size("mass_kg", "the body mass [kg]")?,
            stature_m: size("stature_m", "the stature [m]")?,
            leg_length_m: size("leg_length_m", "the length of a leg [m]")?,
            stances: BySide { right: right as usize, left: left as usize },
            errors: BySide { right: foot("right")?, left: foot("left")? },
            estimator: hexadecimal(of_estimator)?,
            subject,
            // Files of earlier versions do not state it.
            excess: root.number_or("excess", 0.0)?,
        })
    }
}
