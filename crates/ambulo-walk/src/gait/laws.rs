//! The laws of walking against speed: joint curves, waves of the trunk, duration of stance.
//!
//! The numbers are data, not code: `crates/ambulo-walk/data/gait/*.toml`, written by `cargo xtask fit-gait` from the
//! mean curves of Schwartz, Rozumalski, Trost 2008 (five speeds). The header of each file gives source, licence, fit
//! and errors.

use super::curve_table::{law_of, read_curve};
use super::cyclic_curve::CyclicCurve;
use super::gait_settings::Style;
use super::joint::LegJoint;
use super::speed_law::SpeedRange;
use super::wave::{Harmonic, Wave};
use crate::toml_reader::{Source, Table, TomlError};
use std::sync::LazyLock;

/// Knots of the default style, trunk and stance.
const KNOTS: &str = include_str!("../../data/gait/knots.toml");
/// Sub-cycles of style 1997.
const SUB_CYCLES: &str = include_str!("../../data/gait/sub_cycles_1997.toml");
/// The document that describes such files.
pub(super) const DOCUMENT: &str = "docs/GAITS.md";
/// Speeds at which curves are checked, as shares of the range from the slowest to the fastest.
const CHECKED: [f64; 7] = [0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0];
const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// The curves of a leg.
#[derive(Debug, Clone, PartialEq)]
pub struct LegCurves {
    /// Hip flexion relative to the pelvis.
    pub hip: CyclicCurve,
    /// Knee flexion.
    pub knee: CyclicCurve,
    /// Ankle dorsiflexion.
    pub ankle: CyclicCurve,
}

impl LegCurves {
    /// The curve of a joint.
    #[must_use]
    pub fn of(&self, joint: LegJoint) -> &CyclicCurve {
        match joint {
            LegJoint::Hip => &self.hip,
            LegJoint::Knee => &self.knee,
            LegJoint::Ankle => &self.ankle,
        }
    }

    pub(super) fn of_mut(&mut self, joint: LegJoint) -> &mut CyclicCurve {
        match joint {
            LegJoint::Hip => &mut self.hip,
            LegJoint::Knee => &mut self.knee,
            LegJoint::Ankle => &mut self.ankle,
        }
    }
}

/// Duration of stance against duration of the cycle, both in leg times √(L/g): linear, as found by Nilsson,
/// Thorstensson, Halbertsma 1985 (abstract).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SupportLaw {
    /// Increase of stance per increase of the cycle.
    pub slope: f64,
    /// Stance extrapolated to a cycle of zero duration, negative [leg times].
    pub offset: f64,
}

impl SupportLaw {
    /// Foot off as a share of the cycle, limited to 0.52 (a walk has double support) and 0.8.
    #[must_use]
    pub(crate) fn share(&self, cycle_in_leg_times: f64) -> f64 {
        (self.slope + self.offset / cycle_in_leg_times).clamp(0.52, 0.8)
    }
}

/// All laws of a style.
#[derive(Debug, Clone, PartialEq)]
pub struct Laws {
    /// Dimensionless speeds of the data.
    pub range: SpeedRange,
    /// The curves of a leg.
    pub legs: LegCurves,
    /// Anterior tilt of the pelvis.
    pub pelvis_tilt: Wave,
    /// Forward lean of the trunk.
    pub trunk_lean: Wave,
    /// Duration of stance.
    pub(crate) support: SupportLaw,
}

impl Laws {
    /// Laws of the default style from a file in the format of `cargo xtask fit-gait`.
    ///
    /// # Errors
    /// Anything that differs from docs/GAITS.md, with line and key.
    pub fn from_toml(text: &str) -> Result<Laws, TomlError> {
        let source = Source::new(text, DOCUMENT);
        let parsed = source.parse()?;
        let root = Table::root(&source, &parsed);
        root.only(&[&["range", "support", "hip", "knee", "ankle", "pelvis_tilt", "trunk_lean"]])?;
        let range = read_range(&root)?;
        Ok(Laws {
            range,
            legs: read_legs(&root, Style::Knots, &checked_speeds(&range))?,
            pelvis_tilt: read_wave(&root, "pelvis_tilt", &ANGLE)?,
            trunk_lean: read_wave(&root, "trunk_lean", &ANGLE)?,
            support: read_support(&root)?,
        })
    }

    /// The built-in laws; styles differ only in the joint curves.
    ///
    /// # Errors
    /// None; a test reads both files.
    pub fn built_in(style: Style) -> Result<Laws, TomlError> {
        static KNOT_LAWS: LazyLock<Result<Laws, TomlError>> = LazyLock::new(|| Laws::from_toml(KNOTS));
        static SUB_CYCLE_LAWS: LazyLock<Result<Laws, TomlError>> =
            LazyLock::new(|| Laws::from_toml(KNOTS)?.with_sub_cycles(SUB_CYCLES));
        match style {
            Style::Knots => KNOT_LAWS.clone(),
            Style::Paper1997 => SUB_CYCLE_LAWS.clone(),
        }
    }

    /// The same laws with the joint curves of style 1997, from a file in the format of `cargo xtask fit-gait`.
    ///
    /// # Errors
    /// Anything that differs from docs/GAITS.md, with line and key.
    pub fn with_sub_cycles(self, text: &str) -> Result<Laws, TomlError> {
        let source = Source::new(text, DOCUMENT);
        let parsed = source.parse()?;
        let root = Table::root(&source, &parsed);
        root.only(&[&["range", "hip", "knee", "ankle"]])?;
        let range = read_range(&root)?;
        Ok(Laws { range, legs: read_legs(&root, Style::Paper1997, &checked_speeds(&range))?, ..self })
    }
}

/// Dimensionless speeds at which curves are checked.
pub(super) fn checked_speeds(range: &SpeedRange) -> [f64; 7] {
    let [low, high] = range.ends();
    CHECKED.map(|share| low + share * (high - low))
}

fn read_range(root: &Table<'_>) -> Result<SpeedRange, TomlError> {
    let table = root.need("range", "the table [range]")?.table("a table")?;
    table.only(&[&["slowest", "fastest", "below", "above"]])?;
    let number = |key: &str| table.need(key, "a dimensionless speed")?.above_zero();
    Ok(SpeedRange {
        low: number("slowest")?,
        high: number("fastest")?,
        below: number("below")?,
        above: number("above")?,
    })
}

fn read_legs(root: &Table<'_>, style: Style, speeds: &[f64]) -> Result<LegCurves, TomlError> {
    let curve = |joint: LegJoint| {
        read_curve(root, joint, style, speeds)?.ok_or_else(|| root.missing(joint.name(), "the curve of this joint"))
    };
    Ok(LegCurves { hip: curve(LegJoint::Hip)?, knee: curve(LegJoint::Knee)?, ankle: curve(LegJoint::Ankle)? })
}

/// Keys of mean, cosine and sine of a wave in a file, and the unit of their numbers.
pub(super) struct WaveKeys {
    pub(super) mean: &'static str,
    pub(super) cos: &'static str,
    pub(super) sin: &'static str,
    pub(super) unit: f64,
}

pub(super) const ANGLE: WaveKeys = WaveKeys { mean: "mean_deg", cos: "cos_deg", sin: "sin_deg", unit: DEGREE };
/// Forces and moments without units.
pub(super) const RATIO: WaveKeys = WaveKeys { mean: "mean", cos: "cos", sin: "sin", unit: 1.0 };

/// Reads laws from a file whose only keys are `keys`, each a wave; `make` takes the wave of each key.
pub(super) fn read_waves<T>(
    text: &str,
    keys: &[&str],
    units: &WaveKeys,
    make: impl FnOnce(&dyn Fn(&str) -> Result<Wave, TomlError>) -> Result<T, TomlError>,
) -> Result<T, TomlError> {
    let source = Source::new(text, DOCUMENT);
    let parsed = source.parse()?;
    let root = Table::root(&source, &parsed);
    root.only(&[keys])?;
    make(&|key| read_wave(&root, key, units))
}

pub(super) fn read_wave(root: &Table<'_>, key: &str, keys: &WaveKeys) -> Result<Wave, TomlError> {
    let table = root.need(key, "mean and harmonics")?.table("a table with mean and harmonics")?;
    table.only(&[&[keys.mean, "harmonic"]])?;
    let mean = law_of(&table.need(keys.mean, "the mean over the cycle")?)?.scaled(keys.unit);
    let harmonic = |entry: &Table<'_>| {
        entry.only(&[&["order", keys.cos, keys.sin]])?;
        Ok(Harmonic {
            order: entry.need("order", "periods per cycle")?.count()?,
            cos: law_of(&entry.need(keys.cos, "factor of the cosine")?)?.scaled(keys.unit),
            sin: law_of(&entry.need(keys.sin, "factor of the sine")?)?.scaled(keys.unit),
        })
    };
    Ok(Wave { mean, harmonics: table.tables("harmonic")?.iter().map(harmonic).collect::<Result<_, TomlError>>()? })
}

fn read_support(root: &Table<'_>) -> Result<SupportLaw, TomlError> {
    let table = root.need("support", "the duration of stance")?.table("a table with slope and offset")?;
    table.only(&[&["slope", "offset"]])?;
    Ok(SupportLaw {
        slope: table.need("slope", "increase of stance per increase of the cycle")?.number()?,
        offset: table.need("offset", "stance of a cycle of zero duration")?.number()?,
    })
}
