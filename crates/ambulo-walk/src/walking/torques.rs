//! Torques of the gait cycle as harmonics. `ambulo reproduce` replays them in a walker without feedback; a walk by own
//! torques replays them in a controller.
//!
//!   τ(t) = mean + Σ_k (cosine_k cos(2π k t/T) + sine_k sin(2π k t/T))     t from the nominal strike of the right foot

use crate::numerics::Harmonics;
use crate::toml_reader::{Source, Table, TomlError};
use std::fmt::Write;

/// Number of harmonics.
pub const HARMONICS: usize = 6;
/// Largest torque that is read [N.m]: more would be a typing error.
const LARGEST_NM: f64 = 1e5;
const DOCUMENT: &str = "docs/REPRODUCTION.md";

/// The torque of one coordinate over a cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct TorqueSeries {
    /// The coordinate of the model, which also gives the sign.
    pub coordinate: String,
    /// Duration of the cycle [s].
    pub cycle_s: f64,
    /// Mass of the figure that needed these torques [kg].
    pub body_kg: f64,
    /// [N.m].
    pub mean: f64,
    /// First to last harmonic [N.m].
    pub cosine: [f64; HARMONICS],
    /// First to last harmonic [N.m].
    pub sine: [f64; HARMONICS],
    /// Share of the variance that mean and harmonics represent.
    pub r_squared: f64,
}

impl TorqueSeries {
    /// The harmonics of torques [N.m] at phases [cycles] that divide one or more cycles evenly.
    #[must_use]
    pub fn of(coordinate: &str, [cycle_s, body_kg]: [f64; 2], phases: &[f64], torques: &[f64]) -> TorqueSeries {
        let found = Harmonics::of(phases, torques, HARMONICS);
        let r_squared = found.r_squared(phases, torques);
        let [cosine, sine] = [found.cosine, found.sine].map(|parts| std::array::from_fn(|k| parts[k]));
        TorqueSeries { coordinate: coordinate.to_owned(), cycle_s, body_kg, mean: found.mean, cosine, sine, r_squared }
    }

    /// The torque at a share of the cycle [N.m].
    #[must_use]
    pub fn at(&self, phase: f64) -> f64 {
        Harmonics { mean: self.mean, cosine: self.cosine.to_vec(), sine: self.sine.to_vec() }.at(phase)
    }

    /// The torques of gaits as the text of a `torques.toml`: mode, gait and torques.
    #[must_use]
    pub fn text<'a>(gaits: impl IntoIterator<Item = (&'a str, &'a str, Vec<TorqueSeries>)>) -> String {
        let mut text = String::from(
            "# Torques as harmonics of the gait cycle, N.m, with the sign of the model's coordinate:\n\
             # torque(t) = mean + sum over k of cosine[k-1] cos(2 pi k t / cycle_s) + sine[k-1] sin(2 pi k t / \
             cycle_s),\n\
             # t from the right foot's nominal contact. Impacts are not included.\n",
        );
        for (mode, gait, torques) in gaits {
            for series in torques {
                let list = |values: &[f64]| values.iter().map(|x| format!("{x:.6}")).collect::<Vec<_>>().join(", ");
                let _ = write!(
                    text,
                    "\n[[torque]]\nmode = \"{mode}\"\ngait = \"{gait}\"\ncoordinate = \"{}\"\ncycle_s = {:?}\nbody_kg \
                     = {:.3}\nmean = {:.6}\n\
                     cosine = [{}]\nsine = [{}]\nr_squared = {:.6}\n",
                    series.coordinate,
                    series.cycle_s,
                    series.body_kg,
                    series.mean,
                    list(&series.cosine),
                    list(&series.sine),
                    series.r_squared
                );
            }
        }
        text
    }

    /// The torques of a gait in a mode (`paper` or `physical`) from the text of a `torques.toml`.
    ///
    /// # Errors
    /// Text that is no such file, with line and key; a gait that it does not have.
    pub fn read(text: &str, mode: &str, gait: &str) -> Result<Vec<TorqueSeries>, TomlError> {
        let source = Source::new(text, DOCUMENT);
        let parsed = source.parse()?;
        let root = Table::root(&source, &parsed);
        root.only(&[&["torque"]])?;
        let (mut series, mut gaits) = (Vec::<TorqueSeries>::new(), Vec::<String>::new());
        for table in root.tables("torque")? {
            table.only(&[&[
                "mode",
                "gait",
                "coordinate",
                "cycle_s",
                "body_kg",
                "mean",
                "cosine",
                "sine",
                "r_squared",
            ]])?;
            let own_mode = table.need("mode", "the mode in which the torques were computed")?.filled_text()?;
            let own = table.need("gait", "the gait whose torques they are")?.filled_text()?;
            let found = read_series(&table)?;
            if own_mode != mode {
                continue;
            }
            if own == gait {
                if series.iter().any(|other| other.coordinate == found.coordinate) {
                    return Err(table
                        .wrong(format!("found `{}` twice in the gait `{gait}`; expected it once", found.coordinate)));
                }
                series.push(found);
            } else if !gaits.contains(&own) {
                gaits.push(own);
            }
        }
        if series.is_empty() {
            let known = if gaits.is_empty() { "none".to_owned() } else { gaits.join(", ") };
            return Err(root.wrong(format!(
                "found no torques of the gait `{gait}` in the mode `{mode}`; in that mode the file has {known}"
            )));
        }
        Ok(series)
    }
}

fn read_series(table: &Table<'_>) -> Result<TorqueSeries, TomlError> {
    let torque = |key: &str| {
        let value = table.need(key, "a torque [N.m]")?;
        let number = value.number()?;
        if number.abs() <= LARGEST_NM { Ok(number) } else { Err(value.wrong("a torque of at most 100000 N.m")) }
    };
    let harmonics = |key: &str| {
        const EXPECTED: &str = "six torques [N.m] of at most 100000 N.m, one per harmonic";
        let value = table.need(key, EXPECTED)?;
        let numbers: [f64; HARMONICS] = value.numbers(EXPECTED)?;
        if numbers.iter().all(|x| x.abs() <= LARGEST_NM) { Ok(numbers) } else { Err(value.wrong(EXPECTED)) }
    };
    let value = table.need("cycle_s", "the duration of the cycle [s]")?;
    let cycle_s = value.above_zero()?;
    if !(0.1..=60.0).contains(&cycle_s) {
        return Err(value.wrong("a duration of 0.1 to 60 s"));
    }
    Ok(TorqueSeries {
        coordinate: table.need("coordinate", "a coordinate of the model")?.filled_text()?,
        cycle_s,
        body_kg: table.need("body_kg", "the mass of the figure [kg]")?.above_zero()?,
        mean: torque("mean")?,
        cosine: harmonics("cosine")?,
        sine: harmonics("sine")?,
        r_squared: table.number_or("r_squared", 1.0)?,
    })
}
