//! Before and after: the changes between two sessions of a person.
//!
//!   change(t) = x̄_after(t) - x̄_before(t)
//!
//! A change is larger than the variation between cycles where it exceeds two standard deviations of the difference of
//! the means, √(s_before²/n_before + s_after²/n_after); of single cycles that is not known.

use super::{Norms, Session, SessionQuantity, all};
use crate::validation::shown;
use ambulo::model::Side;
use ambulo::study::session::{CurveStatistics, CycleForces, pooled};
use std::fmt::Write;

/// A larger change, in standard deviations of the difference, is more than variation.
const CLEAR: f64 = 2.0;

/// The change of a quantity of one side.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Change {
    pub(super) quantity: SessionQuantity,
    pub(super) side: Side,
    /// The source of the forces, the same in both sessions; `None` for angles.
    pub(super) forces: Option<CycleForces>,
    pub(super) cycles: [usize; 2],
    /// Root mean square of the change.
    pub(super) rms: f64,
    /// The largest change, with its sign, and where it is [% of the cycle].
    pub(super) largest: f64,
    pub(super) at_percent: f64,
    /// Share of the cycle in which the change is larger than the variation between cycles.
    pub(super) clear: Option<f64>,
    /// Distance from the mean of the reference group before and after.
    pub(super) from_normal: Option<[f64; 2]>,
}

/// All changes; quantities whose forces have another source than before are left out.
pub(super) fn changes(after: &Session, before: &Session, norms: &Norms) -> Vec<Change> {
    let of = |quantity: SessionQuantity, side: Side| {
        let now = pooled(&after.cycles, quantity.id, side)?;
        let then = pooled(&before.cycles, quantity.id, side).filter(|then| then.forces == now.forces)?;
        let (a, b) = (&now.statistics, &then.statistics);
        let change: Vec<f64> = a.mean.iter().zip(&b.mean).map(|(a, b)| a - b).collect();
        let far = (0..change.len()).max_by(|i, k| change[*i].abs().total_cmp(&change[*k].abs()))?;
        let square: f64 = change.iter().map(|x| x * x).sum();
        let norm = norms.curve(quantity.id);
        Some(Change {
            quantity,
            side,
            forces: now.forces,
            cycles: [b.count, a.count],
            rms: (square / change.len() as f64).sqrt(),
            largest: change[far],
            at_percent: 100.0 * far as f64 / (change.len().max(2) - 1) as f64,
            clear: clear_share(&change, a, b),
            from_normal: norm.map(|norm| [norm.score(&b.mean), norm.score(&a.mean)]),
        })
    };
    all().flat_map(|quantity| Side::BOTH.map(|side| of(quantity, side))).flatten().collect()
}

fn clear_share(change: &[f64], a: &CurveStatistics, b: &CurveStatistics) -> Option<f64> {
    let (of_a, of_b) = (a.sd.as_ref()?, b.sd.as_ref()?);
    let is_clear = |i: &usize| {
        let variance = of_a[*i].powi(2) / a.count as f64 + of_b[*i].powi(2) / b.count as f64;
        change[*i].abs() > CLEAR * variance.sqrt()
    };
    Some((0..change.len()).filter(is_clear).count() as f64 / change.len().max(1) as f64)
}

/// A time or distance before and after, in the unit of its table: mean, standard deviation, number.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TimeChange {
    pub(super) quantity: String,
    pub(super) unit: String,
    pub(super) side: &'static str,
    pub(super) before: [f64; 3],
    pub(super) after: [f64; 3],
}

/// Times and distances that both sessions have.
pub(super) fn time_changes(after: &Session, before: &Session) -> Vec<TimeChange> {
    let mut rows = Vec::new();
    let spread = |spread: super::Spread| [spread.mean, spread.sd.unwrap_or(f64::NAN), spread.n as f64];
    if let (Some(now), Some(then)) = (after.summary.speed_m_s, before.summary.speed_m_s) {
        rows.push(TimeChange {
            quantity: "speed".to_owned(),
            unit: "m/s".to_owned(),
            side: "both",
            before: spread(then),
            after: spread(now),
        });
    }
    for now in &after.summary.times_and_distances.quantities {
        let same = |known: &&ambulo_results::QuantitySummary| known.quantity == now.quantity;
        let Some(then) = before.summary.times_and_distances.quantities.iter().find(same) else { continue };
        for (side, a, b) in
            [("r", &now.right, &then.right), ("l", &now.left, &then.left), ("both", &now.both, &then.both)]
        {
            let (Some(a), Some(b)) = (a, b) else { continue };
            let numbers = |s: &ambulo_results::SpreadSummary| [s.mean, s.sd.unwrap_or(f64::NAN), s.strides as f64];
            rows.push(TimeChange {
                quantity: now.quantity.clone(),
                unit: now.unit.clone(),
                side,
                before: numbers(b),
                after: numbers(a),
            });
        }
    }
    rows
}

/// `differences.csv`: a row per quantity and side; curves first, then times and distances.
pub(super) fn differences_csv(after: &Session, before: &Session, norms: &Norms) -> String {
    let mut text = String::from(
        "quantity,unit,side,forces,n_before,n_after,mean_before,mean_after,change,rms_change,at_percent,clear_percent,\
         from_normal_before,from_normal_after\n",
    );
    for change in changes(after, before, norms) {
        let [from_before, from_after] = change.from_normal.unwrap_or([f64::NAN; 2]).map(shown);
        let _ = writeln!(
            text,
            "{},{},{},{},{},{},,,{},{},{},{},{from_before},{from_after}",
            change.quantity.id,
            change.quantity.wording().unit,
            change.side.letter(),
            change.forces.map_or("", CycleForces::word),
            change.cycles[0],
            change.cycles[1],
            change.largest,
            change.rms,
            change.at_percent,
            change.clear.map_or(String::new(), |clear| shown(100.0 * clear)),
        );
    }
    for TimeChange { quantity, unit, side, before, after } in time_changes(after, before) {
        let _ = writeln!(
            text,
            "{quantity},{unit},{side},,{},{},{},{},{},,,,,",
            before[2],
            after[2],
            before[0],
            after[0],
            after[0] - before[0]
        );
    }
    text
}
