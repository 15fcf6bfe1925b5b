//! Times and distances of walking: `times_and_distances` of `summary.json`, and `times_and_distances.csv`.

use crate::files::OutputFile;
use ambulo::analysis::{StrideQuantity, StrideStatistics, TimesAndDistances};
use ambulo::model::Side;
use serde::{Deserialize, Serialize};

/// Times and distances of the strides of both feet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WalkingSummary {
    /// Mean speed over the floor or belt [m/s].
    pub speed_m_s: Option<f64>,
    /// Each quantity that is known of at least one stride.
    pub quantities: Vec<QuantitySummary>,
}

/// One quantity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct QuantitySummary {
    /// Its name: `cadence`, `step_length`.
    pub quantity: String,
    /// Unit of mean and standard deviation: `steps/min`, `m`, `s`, `%`, `m/(steps/min)`.
    pub unit: String,
    /// Strides of the right foot.
    pub right: Option<SpreadSummary>,
    /// Strides of the left foot.
    pub left: Option<SpreadSummary>,
    /// Strides of both feet.
    pub both: Option<SpreadSummary>,
    /// (right - left) over the mean of both; `null` where it means nothing.
    pub symmetry: Option<f64>,
}

/// Mean and standard deviation over strides.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SpreadSummary {
    /// Mean.
    pub mean: f64,
    /// Standard deviation; `null` for a single stride.
    pub sd: Option<f64>,
    /// Number of strides.
    pub strides: usize,
}

impl WalkingSummary {
    /// In the units of files.
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
            quantities: quantities.filter(|quantity| quantity.both.is_some()).collect(),
        }
    }

    /// `times_and_distances.csv`: `quantity,unit,side,mean,sd,strides` with side `r`, `l` or `both`; an empty cell where a number is not
    /// known.
    #[must_use]
    pub fn file(&self) -> OutputFile {
        let mut text = String::from("quantity,unit,side,mean,sd,strides\n");
        if let Some(speed) = self.speed_m_s {
            text += &format!("speed,m/s,both,{speed},,\n");
        }
        for QuantitySummary { quantity, unit, right, left, both, .. } in &self.quantities {
            for (side, spread) in [("r", right), ("l", left), ("both", both)] {
                let Some(SpreadSummary { mean, sd, strides }) = spread else { continue };
                let sd = sd.map_or_else(String::new, |sd| sd.to_string());
                text += &format!("{quantity},{unit},{side},{mean},{sd},{strides}\n");
            }
        }
        OutputFile { name: crate::TIMES_AND_DISTANCES.to_owned(), bytes: text.into_bytes() }
    }
}

impl SpreadSummary {
    fn of(spread: StrideStatistics, factor: f64) -> SpreadSummary {
        SpreadSummary {
            mean: factor * spread.mean,
            sd: spread.standard_deviation.map(|sd| factor * sd),
            strides: spread.strides,
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
