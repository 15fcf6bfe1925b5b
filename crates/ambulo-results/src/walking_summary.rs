//! Times and distances of walking: `times_and_distances` of `summary.json`, and `times_and_distances.csv`.

use crate::files::{OutputFile, check_column};
use ambulo::analysis::{StrideQuantity, StrideStatistics, TimesAndDistances, symmetry_index};
use ambulo::model::{BySide, Side};
use ambulo::numerics::{mean, sample_deviation};
use ambulo::study::{LegStances, LoadSource};
use ambulo_formats::Error;
use serde::{Deserialize, Serialize};

/// Times and distances of the strides of both feet.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WalkingSummary {
    /// Mean speed over the floor or belt [m/s].
    pub speed_m_s: Option<f64>,
    /// Mean speed along the path of the pelvis [m/s]; `null` where the path is straight.
    pub path_speed_m_s: Option<f64>,
    /// Speed of the belt of a treadmill [m/s]; `null` on a floor that does not move.
    pub belt_speed_m_s: Option<f64>,
    /// Mean velocity of the pelvis in the world, forward (x) and to the right (z) [m/s]; `null` without a pelvis.
    pub pelvis_velocity_m_s: Option<[f64; 2]>,
    /// Largest angle between the directions of two strides [deg]; `null` with fewer than two strides.
    pub turn_deg: Option<f64>,
    /// Every quantity known for at least one stride.
    pub quantities: Vec<QuantitySummary>,
}

/// One quantity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct QuantitySummary {
    /// Name: `cadence`, `step_length`.
    pub quantity: String,
    /// Unit of mean and standard deviation: `steps/min`, `m`, `s`, `%`, `m/(steps/min)`, `N.m/kg`, `N.m.s/kg`, `BW`,
    /// `BW.s`.
    pub unit: String,
    /// Strides of the right foot.
    pub right: Option<SpreadSummary>,
    /// Strides of the left foot.
    pub left: Option<SpreadSummary>,
    /// Strides of both feet; `null` if their loads have different sources.
    pub both: Option<SpreadSummary>,
    /// (right - left) / mean of both; `null` if not meaningful, or if their loads have different sources.
    pub symmetry: Option<f64>,
}

/// Mean and standard deviation over strides.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SpreadSummary {
    /// Mean.
    pub mean: f64,
    /// Standard deviation; `null` for a single stride.
    pub sd: Option<f64>,
    /// Number of strides.
    pub strides: usize,
    /// Of a quantity that depends on forces: where the loads of these strides come from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<LoadSource>,
}

impl WalkingSummary {
    /// Converts to the units of files.
    #[must_use]
    pub fn of(found: &TimesAndDistances) -> WalkingSummary {
        let quantities = StrideQuantity::ALL.into_iter().map(|quantity| {
            let (unit, factor) = unit(quantity);
            let side = |side| found.spread(quantity, side).map(|spread| SpreadSummary::of(spread, factor));
            QuantitySummary {
                quantity: quantity.word().to_owned(),
                unit: unit.to_owned(),
                right: side(Some(Side::Right)),
                left: side(Some(Side::Left)),
                both: side(None),
                symmetry: found.symmetry(quantity),
            }
        });
        WalkingSummary {
            speed_m_s: found.speed_m_s,
            path_speed_m_s: found.path_speed_m_s,
            belt_speed_m_s: found.belt_speed_m_s,
            pelvis_velocity_m_s: found.pelvis_velocity.map(|velocity| [velocity.x, velocity.z]),
            turn_deg: found.turn.map(f64::to_degrees),
            quantities: quantities.filter(|quantity| quantity.both.is_some()).collect(),
        }
    }

    /// A quantity by its name; `None` if no stride has it.
    #[must_use]
    pub fn quantity(&self, quantity: StrideQuantity) -> Option<&QuantitySummary> {
        self.quantities.iter().find(|known| known.quantity == quantity.word())
    }

    /// `times_and_distances.csv`: `quantity,unit,side,mean,sd,strides` with side `r`, `l` or `both`; a cell is empty if
    /// its number is not known.
    ///
    /// # Errors
    /// A number that is not finite.
    pub fn file(&self) -> Result<OutputFile<'static>, Error> {
        let mut text = String::from("quantity,unit,side,mean,sd,strides\n");
        for (quantity, speed) in [("speed", self.speed_m_s), ("path_speed", self.path_speed_m_s)] {
            if let Some(speed) = speed {
                check_column(crate::TIMES_AND_DISTANCES, quantity, &[speed])?;
                text += &format!("{quantity},m/s,both,{speed},,\n");
            }
        }
        for QuantitySummary { quantity, unit, right, left, both, .. } in &self.quantities {
            for (side, spread) in [("r", right), ("l", left), ("both", both)] {
                let Some(SpreadSummary { mean, sd, strides, .. }) = spread else { continue };
                check_column(crate::TIMES_AND_DISTANCES, quantity, &[*mean, sd.unwrap_or_default()])?;
                let sd = sd.map_or_else(String::new, |sd| sd.to_string());
                text += &format!("{quantity},{unit},{side},{mean},{sd},{strides}\n");
            }
        }
        Ok(OutputFile::new(crate::TIMES_AND_DISTANCES, text.into_bytes()))
    }
}

impl QuantitySummary {
    /// Where the loads come from, in words: `measured`, or `right measured, left predicted`; empty for quantities that
    /// do not depend on forces and for results of earlier versions.
    #[must_use]
    pub fn source_words(&self) -> String {
        let source = |side: Side| self.side(side).and_then(|spread| spread.source);
        match (source(Side::Right), source(Side::Left)) {
            (Some(right), Some(left)) if right != left => format!("right {}, left {}", right.word(), left.word()),
            (right, left) => right.or(left).map_or_else(String::new, |source| source.word().to_owned()),
        }
    }

    /// The strides of one foot.
    #[must_use]
    pub fn side(&self, side: Side) -> Option<&SpreadSummary> {
        match side {
            Side::Right => self.right.as_ref(),
            Side::Left => self.left.as_ref(),
        }
    }
}

/// First peak, second peak and impulse of the external knee adduction moment over the stances of both legs
/// ([`ambulo::study::Outcome::knee_adduction`]); empty without stances. Legs whose loads have different sources are
/// neither pooled nor compared: predicted peaks are lower than measured ones.
#[must_use]
pub fn knee_adduction_summary(legs: &BySide<LegStances>) -> Vec<QuantitySummary> {
    stance_summary(legs, ["N.m/kg", "N.m/kg", "N.m.s/kg"], "")
}

/// The same of the load of a joint, or of a condyle, with its name before the quantities
/// ([`ambulo::study::Outcome::contact_load_stances`]).
#[must_use]
pub fn contact_load_summary(load: &str, legs: &BySide<LegStances>) -> Vec<QuantitySummary> {
    stance_summary(legs, ["BW", "BW", "BW.s"], &format!("{load}_"))
}

/// `first_peak`, `second_peak` and `impulse` over the stances of both legs, in these units, with this before their
/// names.
fn stance_summary(legs: &BySide<LegStances>, units: [&str; 3], prefix: &str) -> Vec<QuantitySummary> {
    let names = ["first_peak", "second_peak", "impulse"].into_iter().zip(units);
    let quantity = |(k, (quantity, unit)): (usize, (&str, &str))| {
        let values = |side: Side| legs[side].stances.iter().map(|found| found[k]).collect::<Vec<f64>>();
        let of = |side: Side| SpreadSummary::of_values(&values(side), legs[side].source);
        let (right, left) = (of(Side::Right), of(Side::Left));
        let sides = right.zip(left);
        let is_comparable = sides.is_none_or(|(right, left)| right.source == left.source);
        let symmetry = sides.and_then(|(right, left)| symmetry_index(right.mean, left.mean));
        let pooled = || {
            let source = right.or(left).and_then(|known| known.source)?;
            SpreadSummary::of_values(&Side::BOTH.map(values).concat(), source)
        };
        QuantitySummary {
            quantity: format!("{prefix}{quantity}"),
            unit: unit.to_owned(),
            right,
            left,
            both: is_comparable.then(pooled).flatten(),
            symmetry: symmetry.filter(|_| is_comparable),
        }
    };
    let quantities = names.enumerate().map(quantity);
    quantities.filter(|quantity| quantity.right.is_some() || quantity.left.is_some()).collect()
}

impl SpreadSummary {
    /// Of numbers, one for each stride; `None` without any.
    fn of_values(values: &[f64], source: LoadSource) -> Option<SpreadSummary> {
        let (sd, strides, source) = (sample_deviation(values), values.len(), Some(source));
        (strides > 0).then(|| SpreadSummary { mean: mean(values), sd, strides, source })
    }

    fn of(spread: StrideStatistics, factor: f64) -> SpreadSummary {
        SpreadSummary {
            mean: factor * spread.mean,
            sd: spread.standard_deviation.map(|sd| factor * sd),
            strides: spread.strides,
            source: None,
        }
    }
}

/// Unit in files, and the factor to it from SI units.
fn unit(quantity: StrideQuantity) -> (&'static str, f64) {
    use StrideQuantity as Q;
    match quantity {
        Q::Cadence => ("steps/min", 60.0),
        Q::StrideLength | Q::StepLength | Q::StepWidth => ("m", 1.0),
        Q::CycleTime | Q::StepTime | Q::StanceTime | Q::SwingTime => ("s", 1.0),
        Q::WalkRatio => ("m/(steps/min)", 1.0 / 60.0),
        Q::Stance
        | Q::Swing
        | Q::SingleSupport
        | Q::DoubleSupport
        | Q::InitialDoubleSupport
        | Q::TerminalDoubleSupport => ("%", 100.0),
    }
}
