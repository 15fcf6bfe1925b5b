//! Makes the panel of one clinical quantity: its cycles, their mean, and its curve over time.

use super::results::Results;
use super::sides;
use super::size::BodySize;
use crate::clinical::{ClinicalGroup, ClinicalQuantity};
use crate::clinical_file::PELVIS_AND_HIPS;
use crate::normative;
use crate::page::block::Block;
use crate::page::contract::{Band, CycleCurve, MeanCurve, Origin, PageCycle, Panel, Role, Series, Trace};
use ambulo::analysis::CYCLE_SAMPLES;
use ambulo::model::Side;
use ambulo::motion::interpolate;
use ambulo::numerics;
use ambulo::study::session::CurveStatistics;
use ambulo_formats::table::Table;
use ambulo_results::{CLINICAL, CYCLES, Convention, CycleRow, GROUND, KINEMATICS, MOMENTS, POWERS};

/// Names of ground forces in `cycles.csv` and their axes in `grf.mot`.
pub(super) const GROUND_AXES: [(&str, &str); 3] =
    [("ground_force_fore_aft", "x"), ("ground_force_vertical", "y"), ("ground_force_lateral", "z")];

/// The panel of a quantity; `empty` is its text if no file contains the quantity.
pub(super) fn panel(
    results: &Results,
    size: &BodySize,
    quantity: &ClinicalQuantity,
    empty: &str,
    block: &mut Block,
) -> Panel {
    let (mut cycles, mut means) = (Vec::new(), Vec::new());
    for side in Side::BOTH {
        let shown = shown_cycles(results, quantity, side);
        means.extend(mean_curve(results, side, &shown, block));
        cycles.extend(shown.into_iter().map(|curve| curve.added(block)));
    }
    let traces = traces(results, quantity, block);
    let nothing = cycles.is_empty() && traces.is_empty();
    Panel {
        id: quantity.id.to_owned(),
        title: quantity.title.to_owned(),
        unit: quantity.unit.to_owned(),
        positive: quantity.positive.to_owned(),
        negative: quantity.negative.to_owned(),
        cycles,
        means,
        band: band(size, quantity, results.convention(), block),
        traces,
        red: Vec::new(),
        empty: nothing.then(|| empty.to_owned()),
        activity: None,
    }
}

/// The normative band at this speed; `None` if the speed or the leg length is unknown.
fn band(size: &BodySize, quantity: &ClinicalQuantity, convention: Convention, block: &mut Block) -> Option<Band> {
    let normal = normative::band(quantity.id, size.walking_speed()?, convention)?;
    Some(Band { mean: block.add(&normal.mean), sd: block.add(&normal.sd), citation: normal.citation })
}

/// A curve converted to clinical signs.
pub(super) struct ShownCurve {
    pub(super) side: Side,
    pub(super) number: usize,
    pub(super) values: Vec<f64>,
    origin: Option<Origin>,
}

impl ShownCurve {
    pub(super) fn added(self, block: &mut Block) -> CycleCurve {
        let values = block.add(&self.values);
        CycleCurve { side: sides::page(self.side), number: self.number, values, origin: self.origin }
    }
}

/// The cycles of a foot, in the order of the file.
pub(super) fn shown_cycles(results: &Results, quantity: &ClinicalQuantity, side: Side) -> Vec<ShownCurve> {
    if results.summary.not_measured.contains(&quantity.coordinates[side]) || is_left_out(results, quantity, side) {
        return Vec::new();
    }
    let is_clinical = results.convention() == Convention::Clinical && PELVIS_AND_HIPS.contains(&quantity.id)
        || quantity.derived.is_some() && quantity.group == ClinicalGroup::Kinematics;
    if let Some((column, values)) = results.clinical_column(quantity, side).filter(|_| is_clinical) {
        let origin = Origin { file: CLINICAL.to_owned(), column, factor: 1.0 };
        return over_cycles(results, side, values, Some(&origin));
    }
    let factor = quantity.factor(results.mass_kg, side);
    let rows = results.curves.iter().filter(|curve| curve.side == side && curve.quantity == quantity.columns[side]);
    let shown = |curve: &CycleRow| {
        let factor = factor * if curve.unit == "rad" { 1.0_f64.to_degrees() } else { 1.0 };
        ShownCurve {
            side,
            number: curve.cycle,
            values: curve.values.iter().map(|x| factor * x).collect(),
            origin: Some(Origin { file: CYCLES.to_owned(), column: curve.quantity.clone(), factor }),
        }
    };
    rows.map(shown).collect()
}

/// Whether `clinical.csv` leaves out a quantity that no coordinate has, because the joint is not measured.
fn is_left_out(results: &Results, quantity: &ClinicalQuantity, side: Side) -> bool {
    let has_file = quantity.derived.is_some() && results.clinical.is_some();
    has_file && results.clinical_column(quantity, side).is_none()
}

/// Values over time, time-normalised over every cycle of a foot.
pub(super) fn over_cycles(results: &Results, side: Side, values: &[f64], origin: Option<&Origin>) -> Vec<ShownCurve> {
    let last = (CYCLE_SAMPLES - 1) as f64;
    let one = |&PageCycle { number, start_s, end_s, .. }: &PageCycle| {
        let at = |k: usize| interpolate(&results.times, values, start_s + (end_s - start_s) * k as f64 / last);
        ShownCurve { side, number, values: (0..CYCLE_SAMPLES).map(at).collect(), origin: origin.cloned() }
    };
    results.cycles_of(side).map(one).collect()
}

/// The mean over the cycles of a foot; `None` without cycles.
pub(super) fn mean_curve(results: &Results, side: Side, curves: &[ShownCurve], block: &mut Block) -> Option<MeanCurve> {
    let CurveStatistics { mean, sd, count } = statistics(curves)?;
    let foot_offs: Vec<f64> = results.cycles_of(side).filter_map(|cycle| cycle.foot_off_percent).collect();
    Some(MeanCurve {
        side: sides::page(side),
        cycles: count,
        values: block.add(&mean),
        sd: sd.map(|sd| block.add(&sd)),
        foot_off_percent: (!foot_offs.is_empty()).then(|| numerics::mean(&foot_offs)),
    })
}

/// Mean and standard deviation point by point.
pub(super) fn statistics(curves: &[ShownCurve]) -> Option<CurveStatistics> {
    CurveStatistics::of(&curves.iter().map(|curve| curve.values.as_slice()).collect::<Vec<_>>())
}

/// Traces of both sides over time; a pelvis or trunk coordinate with the same meaning on both sides gives one trace.
fn traces(results: &Results, quantity: &ClinicalQuantity, block: &mut Block) -> Vec<Trace> {
    let factors = Side::BOTH.map(|side| quantity.factor(results.mass_kg, side));
    if quantity.central && factors[0].total_cmp(&factors[1]).is_eq() {
        return trace(results, quantity, None, factors[0], block).into_iter().collect();
    }
    let pairs = Side::BOTH.into_iter().zip(factors);
    pairs.filter_map(|(side, factor)| trace(results, quantity, Some(side), factor, block)).collect()
}

fn trace(
    results: &Results,
    quantity: &ClinicalQuantity,
    side: Option<Side>,
    factor: f64,
    block: &mut Block,
) -> Option<Trace> {
    let Place { table, file, column, divisor } = Place::of(results, quantity, side)?;
    let factor = factor / divisor;
    let of_file = table.column(&column)?;
    let (values, origin) = match results.clinical_column(quantity, side.unwrap_or(Side::Right)) {
        Some((clinical, values)) => {
            (block.add(values), Origin { file: CLINICAL.to_owned(), column: clinical, factor: 1.0 })
        }
        None => (scaled(of_file, factor, block), Origin { file: file.to_owned(), column: column.clone(), factor }),
    };
    let deviation = results.deviations.as_ref().filter(|_| file == GROUND);
    let sd = deviation.and_then(|table| table.column(&format!("{column}_sd")));
    Some(Trace {
        name: side.map_or_else(|| "both sides".to_owned(), |side| side.to_string()),
        side: side.map(sides::page),
        role: Role::Main,
        values,
        sd: sd.map(|sd| scaled(sd, factor.abs(), block)),
        predicted: side
            .filter(|_| quantity.group != ClinicalGroup::Kinematics)
            .map_or_else(Vec::new, |side| results.predicted_times(side)),
        origin: Some(origin),
    })
}

/// Finds a quantity over time: file, column, and its numbers if the column exists. `None` without the file.
pub(super) fn over_time<'a>(
    results: &'a Results,
    quantity: &ClinicalQuantity,
    side: Side,
) -> Option<(&'static str, String, Option<&'a [f64]>)> {
    let Place { table, file, column, .. } = Place::of(results, quantity, Some(side))?;
    let values = table.column(&column);
    Some((file, column, values))
}

fn scaled(values: &[f64], factor: f64, block: &mut Block) -> Series {
    block.add(&values.iter().map(|x| factor * x).collect::<Vec<_>>())
}

/// Place of a column over time.
struct Place<'a> {
    table: &'a Table,
    file: &'static str,
    column: String,
    /// Divisor of the file's number, in addition to the quantity's own factor.
    divisor: f64,
}

impl Place<'_> {
    fn of<'a>(results: &'a Results, quantity: &ClinicalQuantity, side: Option<Side>) -> Option<Place<'a>> {
        let letter = side.map(Side::letter).unwrap_or_default();
        let coordinate = quantity.coordinates[side.unwrap_or(Side::Right)].clone();
        if results.summary.not_measured.contains(&coordinate) {
            return None;
        }
        let place = |table, file, column| Place { table, file, column, divisor: 1.0 };
        if quantity.derived.is_some() {
            let (column, _) = results.clinical_column(quantity, side?)?;
            return Some(place(results.clinical.as_ref()?, CLINICAL, column));
        }
        match quantity.group {
            ClinicalGroup::Kinematics => Some(place(&results.kinematics, KINEMATICS, coordinate)),
            ClinicalGroup::Moments => Some(place(results.moments.as_ref()?, MOMENTS, format!("{coordinate}_moment"))),
            ClinicalGroup::Powers => Some(place(results.powers.as_ref()?, POWERS, format!("{coordinate}_power"))),
            ClinicalGroup::Ground => {
                let (_, axis) = GROUND_AXES.iter().find(|(name, _)| *name == coordinate)?;
                let column = format!("ground_force_{letter}_v{axis}");
                Some(Place { divisor: results.weight_n, ..place(results.ground.as_ref()?, GROUND, column) })
            }
        }
    }
}
