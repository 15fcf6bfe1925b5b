//! Ground forces of people against speed: mean curves of one foot over its cycle.
//!
//! What walks are drawn towards when they are made consistent ([`crate::simulation::consistent_walk`]). The laws are quadratics through
//! three of the five speeds of Schwartz, Rozumalski, Trost 2008 (very slow, free, very fast); the two others judge them. Made by
//! `cargo xtask fit-gait`; the file's header tells source, licence and errors.

use super::curve_table::law_of;
use super::jet::Jet;
use super::laws::DOCUMENT;
use super::wave::{Harmonic, Wave};
use crate::toml_reader::{Source, Table, TomlError};
use std::sync::LazyLock;

const FORCES: &str = include_str!("../../data/gait/ground_forces.toml");

/// Mean ground force of a foot.
#[derive(Debug, Clone, PartialEq)]
pub struct GroundForceLaws {
    /// Upward force [body weights].
    pub vertical: Wave,
    /// Forward force [body weights].
    pub fore_aft: Wave,
}

impl GroundForceLaws {
    /// Laws from a file as `cargo xtask fit-gait` writes it.
    ///
    /// # Errors
    /// Whatever is not as docs/GAITS.md has it, with line and key.
    pub fn from_toml(text: &str) -> Result<GroundForceLaws, TomlError> {
        let source = Source::new(text, DOCUMENT);
        let parsed = source.parse()?;
        let root = Table::root(&source, &parsed);
        root.only(&[&["vertical", "fore_aft"]])?;
        Ok(GroundForceLaws { vertical: read(&root, "vertical")?, fore_aft: read(&root, "fore_aft")? })
    }

    /// The laws of the crate.
    ///
    /// # Errors
    /// None; a test reads the file.
    pub fn built_in() -> Result<GroundForceLaws, TomlError> {
        static LAWS: LazyLock<Result<GroundForceLaws, TomlError>> =
            LazyLock::new(|| GroundForceLaws::from_toml(FORCES));
        LAWS.clone()
    }

    /// Upward and forward force on the foot [body weights] at a phase since its contact and a dimensionless speed.
    #[must_use]
    pub fn at(&self, phase: f64, speed: f64) -> [f64; 2] {
        let (phase, speed) = (Jet::constant(phase), Jet::constant(speed));
        [self.vertical.at(phase, speed).value, self.fore_aft.at(phase, speed).value]
    }
}

fn read(root: &Table<'_>, key: &str) -> Result<Wave, TomlError> {
    let table = root.need(key, "mean and harmonics of the force")?.table("a table with mean and harmonics")?;
    table.only(&[&["mean", "harmonic"]])?;
    let harmonic = |entry: &Table<'_>| {
        entry.only(&[&["order", "cos", "sin"]])?;
        Ok(Harmonic {
            order: entry.need("order", "periods in a cycle")?.count()?,
            cos: law_of(&entry.need("cos", "factor of the cosine [body weights]")?)?,
            sin: law_of(&entry.need("sin", "factor of the sine [body weights]")?)?,
        })
    };
    Ok(Wave {
        mean: law_of(&table.need("mean", "the mean over the cycle [body weights]")?)?,
        harmonics: table.tables("harmonic")?.iter().map(harmonic).collect::<Result<_, TomlError>>()?,
    })
}
