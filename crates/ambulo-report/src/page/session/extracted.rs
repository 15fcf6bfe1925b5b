//! Tables of peaks and ranges of motion, and of the differences between the sides.
//!
//! Each value is computed for every cycle; the tables show mean and standard deviation over the cycles of a side.
//! Symmetry is 100 (R - L) / ((R + L) / 2) of the means, marked above 10 % (Robinson, Herzog, Nigg 1987, unverified).

use super::cells::{mean_cell, number, text};
use super::curves::{ShownCurve, shown_cycles};
use super::results::Results;
use super::time_distance;
use crate::clinical::ClinicalQuantity;
use crate::page::contract::{Cell, Table};
use ambulo::analysis::symmetry_index;
use ambulo::model::Side;
use ambulo::numerics::mean;
use ambulo_results::WalkingSummary;

/// Asymmetry above this is marked [%].
const ASYMMETRIC: f64 = 10.0;

/// How a value is computed from the curve of a cycle.
#[derive(Clone, Copy)]
pub enum Read {
    /// Maximum over a part.
    Largest(Part),
    /// Minimum over a part.
    Smallest(Part),
    /// Maximum minus minimum over the whole cycle.
    Range,
    /// At foot strike.
    AtStrike,
}

/// A part of the cycle.
#[derive(Clone, Copy)]
pub enum Part {
    /// Foot strike to the next one.
    Whole,
    /// Foot strike to foot off.
    Stance,
    /// First half of stance.
    EarlyStance,
    /// Second half of stance.
    LateStance,
    /// Second and third quarter of stance.
    MiddleOfStance,
    /// Foot off to foot strike.
    Swing,
}

use Part::{EarlyStance, LateStance, MiddleOfStance, Stance, Swing, Whole};
use Read::{AtStrike, Largest, Range, Smallest};

/// Quantity, name of the value, how it is computed, digits, and whether its sides are compared in per cent.
type Row = (&'static str, &'static str, Read, usize, bool);

#[rustfmt::skip]
const ROWS: &[Row] = &[
    ("pelvis_tilt_angle", "Pelvic tilt, range", Range, 1, false),
    ("pelvis_obliquity_angle", "Pelvic obliquity, range", Range, 1, false),
    ("pelvis_rotation_angle", "Pelvic rotation, range", Range, 1, false),
    ("hip_flexion_angle", "Hip flexion at foot strike", AtStrike, 1, false),
    ("hip_flexion_angle", "Hip flexion, maximum", Largest(Whole), 1, false),
    ("hip_flexion_angle", "Hip flexion, minimum (extension is negative)", Smallest(Whole), 1, false),
    ("hip_flexion_angle", "Hip flexion, range", Range, 1, true),
    ("hip_adduction_angle", "Hip adduction, maximum in stance", Largest(Stance), 1, false),
    ("hip_adduction_angle", "Hip adduction, range", Range, 1, true),
    ("hip_rotation_angle", "Hip rotation, range", Range, 1, true),
    ("knee_flexion_angle", "Knee flexion at foot strike", AtStrike, 1, false),
    ("knee_flexion_angle", "Knee flexion, maximum in early stance", Largest(EarlyStance), 1, false),
    ("knee_flexion_angle", "Knee flexion, minimum in late stance", Smallest(LateStance), 1, false),
    ("knee_flexion_angle", "Knee flexion, maximum in swing", Largest(Swing), 1, true),
    ("knee_flexion_angle", "Knee flexion, range", Range, 1, true),
    ("ankle_dorsiflexion_angle", "Ankle dorsiflexion at foot strike", AtStrike, 1, false),
    ("ankle_dorsiflexion_angle", "Ankle dorsiflexion, maximum in stance", Largest(Stance), 1, false),
    ("ankle_dorsiflexion_angle", "Ankle dorsiflexion, minimum (plantarflexion is negative)", Smallest(Whole), 1, false),
    ("ankle_dorsiflexion_angle", "Ankle dorsiflexion, range", Range, 1, true),
    ("hip_flexion_moment", "Hip extensor moment, peak", Largest(Whole), 2, true),
    ("hip_flexion_moment", "Hip flexor moment, peak (negative)", Smallest(Whole), 2, true),
    ("hip_adduction_moment", "Hip abductor moment, peak", Largest(Stance), 2, true),
    ("knee_flexion_moment", "Knee extensor moment, peak in stance", Largest(Stance), 2, true),
    ("knee_flexion_moment", "Knee flexor moment, peak in stance (negative)", Smallest(Stance), 2, true),
    ("ankle_dorsiflexion_moment", "Ankle plantarflexor moment, peak", Largest(Stance), 2, true),
    ("hip_flexion_power", "Hip power generated, peak", Largest(Whole), 2, true),
    ("knee_flexion_power", "Knee power absorbed, peak (negative)", Smallest(Whole), 2, true),
    ("ankle_dorsiflexion_power", "Ankle power generated, peak", Largest(Whole), 2, true),
    ("ankle_dorsiflexion_power", "Ankle power absorbed, peak in stance (negative)", Smallest(Stance), 2, true),
    ("ground_force_vertical", "Vertical force, first peak", Largest(EarlyStance), 2, true),
    ("ground_force_vertical", "Vertical force, minimum between the peaks", Smallest(MiddleOfStance), 2, true),
    ("ground_force_vertical", "Vertical force, second peak", Largest(LateStance), 2, true),
    ("ground_force_fore_aft", "Braking force, peak (negative)", Smallest(Stance), 2, true),
    ("ground_force_fore_aft", "Propulsive force, peak", Largest(Stance), 2, true),
    ("ground_force_lateral", "Medial force, peak", Largest(Stance), 2, true),
];

/// A value of both sides, one number per cycle.
pub(super) struct Extracted {
    label: &'static str,
    unit: &'static str,
    digits: usize,
    compared: bool,
    sides: [Vec<f64>; 2],
}

/// Every value that can be computed from the cycles.
pub(super) fn extracted(results: &Results, quantities: &[ClinicalQuantity]) -> Vec<Extracted> {
    let value = |&(id, label, read, digits, compared): &Row| {
        let quantity = quantities.iter().find(|quantity| quantity.id == id)?;
        let of = |side| {
            let curves = shown_cycles(results, quantity, side);
            curves.iter().filter_map(|curve| read.off(&curve.values, foot_off(results, curve))).collect::<Vec<f64>>()
        };
        let sides = Side::BOTH.map(of);
        let some = sides.iter().any(|values| !values.is_empty());
        some.then_some(Extracted { label, unit: quantity.unit, digits, compared, sides })
    };
    ROWS.iter().filter_map(value).collect()
}

/// The table of peaks and ranges.
pub(super) fn table(values: &[Extracted]) -> Table {
    let row = |value: &Extracted| {
        let [right, left] = [0, 1].map(|side| mean_cell(&value.sides[side], value.digits, None));
        let difference = number(right.value.zip(left.value).map(|(r, l)| r - l), value.digits, None);
        vec![text(value.label), text(value.unit), right, left, difference]
    };
    Table {
        id: "extracted".to_owned(),
        title: "Peaks and ranges of motion".to_owned(),
        note: Some(
            "Mean ± standard deviation over the cycles of each side; each value is computed per cycle.".to_owned(),
        ),
        columns: ["", "Unit", "Right", "Left", "Right minus left"].map(str::to_owned).to_vec(),
        rows: values.iter().map(row).collect(),
        empty: values.is_empty().then(|| "There is no whole gait cycle to compute them from.".to_owned()),
    }
}

/// The table of differences between the sides.
pub(super) fn symmetry(values: &[Extracted], walking: &WalkingSummary) -> Table {
    let extracted = values.iter().filter(|value| value.compared).map(|value| {
        let means = value.sides.each_ref().map(|side| (!side.is_empty()).then(|| mean(side)));
        (value.label, value.unit, value.digits, means)
    });
    let rows: Vec<Vec<Cell>> = time_distance::sides(walking)
        .into_iter()
        .chain(extracted)
        .filter_map(|(label, unit, digits, means)| {
            let [Some(right), Some(left)] = means else { return None };
            let percent = symmetry_index(right, left).map(|index| 100.0 * index);
            let index = number(percent, 0, Some([-ASYMMETRIC, ASYMMETRIC]));
            Some(vec![
                text(label),
                text(unit),
                number(Some(right), digits, None),
                number(Some(left), digits, None),
                index,
            ])
        })
        .collect();
    let note = format!(
        "100 (right - left) / mean of both sides, from the means over the cycles. 0 is symmetric; positive values mean \
         that the right side is larger. Marked above {ASYMMETRIC:.0} %."
    );
    Table {
        id: "symmetry".to_owned(),
        title: "Right and left".to_owned(),
        note: Some(note),
        columns: ["", "Unit", "Right", "Left", "Difference [%]"].map(str::to_owned).to_vec(),
        empty: rows.is_empty().then(|| "There are no whole cycles of both sides to compare.".to_owned()),
        rows,
    }
}

fn foot_off(results: &Results, curve: &ShownCurve) -> Option<f64> {
    results.cycles_of(curve.side).find(|cycle| cycle.number == curve.number)?.foot_off_percent
}

impl Read {
    /// The value of a cycle; `None` if it needs a foot off that was not detected.
    #[must_use]
    pub fn off(self, values: &[f64], foot_off: Option<f64>) -> Option<f64> {
        let of = |part: Part| Some(values.get(part.samples(values.len(), foot_off)?)?.iter().copied());
        let largest = |part| Some(of(part)?.fold(f64::NEG_INFINITY, f64::max));
        let smallest = |part| Some(of(part)?.fold(f64::INFINITY, f64::min));
        let value = match self {
            Largest(part) => largest(part)?,
            Smallest(part) => smallest(part)?,
            Range => largest(Whole)? - smallest(Whole)?,
            AtStrike => *values.first()?,
        };
        value.is_finite().then_some(value)
    }
}

impl Part {
    /// Range of samples within a cycle of `count` samples; parts of the stance are shares of its duration.
    fn samples(self, count: usize, foot_off: Option<f64>) -> Option<std::ops::Range<usize>> {
        let at = |share: f64| ((count - 1) as f64 * share / 100.0).round() as usize;
        let stance = |from: f64, to: f64| {
            let off = foot_off?;
            Some(at(from * off)..at(to * off) + 1)
        };
        match self {
            Whole => Some(0..count),
            Stance => stance(0.0, 1.0),
            EarlyStance => stance(0.0, 0.5),
            MiddleOfStance => stance(0.25, 0.75),
            LateStance => stance(0.5, 1.0),
            Swing => Some(at(foot_off?)..count),
        }
    }
}
