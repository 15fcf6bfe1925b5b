//! Normative curves of the ground force over a stance, by walking speed: the prior of a prediction.
//!
//! Mean and standard deviation of Schwartz, Rozumalski, Trost 2008 at five speeds, between foot strike and foot off;
//! the header of the data file has source, licence and form (`cargo xtask fit-ground` writes it). Values are
//! interpolated linearly between the speeds; beyond them the nearest speed is used.

use crate::toml_reader::{Source, Table, TomlError, Value};
use std::sync::LazyLock;

const CURVES: &str = include_str!("../../../data/ground/stance_curves.toml");
const DOCUMENT: &str = "docs/GROUND_FORCES.md";
const SPEEDS: usize = 5;
const SAMPLES: usize = 26;

/// Mean and standard deviation [body weights].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanAndDeviation {
    pub mean: f64,
    pub deviation: f64,
}

#[derive(Debug, Clone)]
struct Curve {
    mean: [f64; SAMPLES],
    deviation: [f64; SAMPLES],
}

/// Times of the other foot's off and strike, as shares of a stance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OtherFootEvents {
    /// Off of the other foot.
    pub other_off: f64,
    /// Strike of the other foot.
    pub other_strike: f64,
}

/// The built-in normative curves.
#[derive(Debug, Clone)]
pub struct StanceCurves {
    speeds: [f64; SPEEDS],
    other_foot_events: [OtherFootEvents; SPEEDS],
    vertical: [Curve; SPEEDS],
    fore_aft: [Curve; SPEEDS],
}

/// The curves at a speed: index of the next lower speed of the table, and the share of the next higher one.
#[derive(Debug, Clone, Copy)]
pub struct AtSpeed<'c> {
    curves: &'c StanceCurves,
    index: usize,
    share: f64,
}

impl StanceCurves {
    /// The built-in curves.
    ///
    /// # Errors
    /// None: a test reads the file.
    pub fn built_in() -> Result<&'static StanceCurves, &'static TomlError> {
        static CURVES_READ: LazyLock<Result<StanceCurves, TomlError>> =
            LazyLock::new(|| StanceCurves::from_toml(CURVES));
        CURVES_READ.as_ref()
    }

    fn from_toml(text: &str) -> Result<StanceCurves, TomlError> {
        let source = Source::new(text, DOCUMENT);
        let parsed = source.parse()?;
        let root = Table::root(&source, &parsed);
        root.only(&[&["speeds", "foot_off", "other_off", "other_strike", "vertical", "fore_aft"]])?;
        let list = |key: &str| root.need(key, "one number per speed")?.numbers::<SPEEDS>("five numbers");
        let (off, other_off, other_strike) = (list("foot_off")?, list("other_off")?, list("other_strike")?);
        let other_foot_events = std::array::from_fn(|i| OtherFootEvents {
            other_off: other_off[i] / off[i],
            other_strike: other_strike[i] / off[i],
        });
        Ok(StanceCurves {
            speeds: list("speeds")?,
            other_foot_events,
            vertical: curves(&root, "vertical")?,
            fore_aft: curves(&root, "fore_aft")?,
        })
    }

    /// The curves at a dimensionless speed V / √(g L).
    pub fn at_speed(&self, speed: f64) -> AtSpeed<'_> {
        let speed = speed.clamp(self.speeds[0], self.speeds[SPEEDS - 1]);
        let index = self.speeds[1..SPEEDS - 1].partition_point(|s| *s < speed);
        let [low, high] = [self.speeds[index], self.speeds[index + 1]];
        AtSpeed { curves: self, index, share: (speed - low) / (high - low) }
    }
}

impl AtSpeed<'_> {
    pub fn other_foot_events(&self) -> OtherFootEvents {
        let [low, high] = [self.curves.other_foot_events[self.index], self.curves.other_foot_events[self.index + 1]];
        OtherFootEvents {
            other_off: mix(low.other_off, high.other_off, self.share),
            other_strike: mix(low.other_strike, high.other_strike, self.share),
        }
    }

    /// Vertical force at a share of the stance.
    pub fn vertical(&self, phase: f64) -> MeanAndDeviation {
        self.expected(&self.curves.vertical, phase)
    }

    /// Fore-aft force at a share of the stance.
    pub fn fore_aft(&self, phase: f64) -> MeanAndDeviation {
        self.expected(&self.curves.fore_aft, phase)
    }

    fn expected(&self, curves: &[Curve; SPEEDS], phase: f64) -> MeanAndDeviation {
        let [low, high] = [&curves[self.index], &curves[self.index + 1]];
        let read = |of: fn(&Curve) -> &[f64; SAMPLES]| mix(sample(of(low), phase), sample(of(high), phase), self.share);
        MeanAndDeviation { mean: read(|c| &c.mean), deviation: read(|c| &c.deviation) }
    }
}

fn mix(a: f64, b: f64, share: f64) -> f64 {
    a + (b - a) * share
}

fn sample(curve: &[f64; SAMPLES], phase: f64) -> f64 {
    let place = phase.clamp(0.0, 1.0) * (SAMPLES - 1) as f64;
    let index = (place as usize).min(SAMPLES - 2);
    mix(curve[index], curve[index + 1], place - index as f64)
}

fn curves(root: &Table<'_>, key: &str) -> Result<[Curve; SPEEDS], TomlError> {
    let read = |table: &Table<'_>| -> Result<Curve, TomlError> {
        table.only(&[&["mean", "deviation"]])?;
        let samples = |value: Value<'_>| value.numbers::<SAMPLES>("26 numbers [body weights]");
        Ok(Curve {
            mean: samples(table.need("mean", "the mean curve")?)?,
            deviation: samples(table.need("deviation", "standard deviations")?)?,
        })
    };
    let found = root.tables(key)?.iter().map(read).collect::<Result<Vec<_>, TomlError>>()?;
    found.try_into().map_err(|found: Vec<Curve>| root.wrong(format!("`{key}` has {} curves; expected 5", found.len())))
}
