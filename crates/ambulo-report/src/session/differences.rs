//! Before and after: the changes between two sessions of a person. Equations: `ambulo::study::session`.

use super::{ComparedSession, Norms, Session, SessionQuantity, all};
use crate::validation::shown;
use ambulo::model::Side;
use ambulo::numerics::{mean, rms};
use ambulo::study::session::{Certainty, CurveChange, CycleForces, curve_change, mixed_with, pooled};
use std::fmt::Write;

/// The change of a quantity of one side.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Change {
    pub(super) quantity: SessionQuantity,
    pub(super) side: Side,
    /// The source of the forces, the same in both sessions; `None` for angles.
    pub(super) forces: Option<CycleForces>,
    pub(super) cycles: [usize; 2],
    /// The mean curves before and after.
    pub(super) means: [Vec<f64>; 2],
    pub(super) found: CurveChange,
    /// Distance from the mean of the reference group before and after.
    pub(super) from_normal: Option<[f64; 2]>,
}

impl Change {
    /// Place of the largest change [% of the cycle].
    pub(super) fn at_percent(&self) -> f64 {
        100.0 * self.found.place() as f64 / (self.found.change.len().max(2) - 1) as f64
    }

    /// The largest change, with its sign.
    pub(super) fn largest(&self) -> f64 {
        self.found.change.get(self.found.place()).copied().unwrap_or(f64::NAN)
    }
}

/// All changes; quantities whose forces have another source than before are left out.
pub(super) fn changes(after: &Session, before: &Session, norms: &Norms) -> Vec<Change> {
    let of = |quantity: SessionQuantity, side: Side| {
        let now = pooled(&after.cycles, quantity.id, side)?;
        let then = pooled(&before.cycles, quantity.id, side)?;
        let mixed = mixed_with(quantity.id).and_then(|other| middle(after, before, (other, side)));
        let found = curve_change(quantity.id, &then, &now, mixed.as_deref())?;
        let norm = norms.curve(quantity.id);
        let [then_mean, now_mean] = [then.statistics.mean, now.statistics.mean];
        Some(Change {
            quantity,
            side,
            forces: now.forces,
            cycles: [then.statistics.count, now.statistics.count],
            from_normal: norm.map(|norm| [norm.score(&then_mean), norm.score(&now_mean)]),
            means: [then_mean, now_mean],
            found,
        })
    };
    all().flat_map(|quantity| Side::BOTH.map(|side| of(quantity, side))).flatten().collect()
}

/// Mean of a quantity over both sessions.
fn middle(after: &Session, before: &Session, (quantity, side): (&str, Side)) -> Option<Vec<f64>> {
    let of = |session: &Session| Some(pooled(&session.cycles, quantity, side)?.statistics.mean);
    Some(of(after)?.iter().zip(&of(before)?).map(|(a, b)| mean(&[*a, *b])).collect())
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

impl TimeChange {
    /// Two standard deviations of the difference of the means; `None` if a session has a single stride.
    pub(super) fn variation(&self) -> Option<f64> {
        let square = |[_, sd, n]: [f64; 3]| sd * sd / n;
        Some(2.0 * (square(self.before) + square(self.after)).sqrt()).filter(|x| x.is_finite())
    }

    /// How sure the change is.
    pub(super) fn certainty(&self) -> Certainty {
        match self.variation() {
            None => Certainty::SingleCycle,
            // Values from files have six digits.
            Some(limit) if (self.after[0] - self.before[0]).abs() > limit.max(1e-5) => Certainty::Clear,
            Some(_) => Certainty::Variation,
        }
    }
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
pub(super) fn differences_csv(compared: &ComparedSession, before: &Session) -> String {
    let mut text = String::from(
        "quantity,unit,side,forces,n_before,n_after,mean_before,mean_after,change,rms_change,at_percent,clear_percent,\
         from_normal_before,from_normal_after,calibration_offset,beyond_calibration_rms,certainty\n",
    );
    for change in &compared.changes {
        let [from_before, from_after] = change.from_normal.unwrap_or([f64::NAN; 2]).map(shown);
        let CurveChange { change: all, beyond, offset, clear, certainty, .. } = &change.found;
        let _ = writeln!(
            text,
            "{},{},{},{},{},{},,,{},{},{},{},{from_before},{from_after},{offset},{},{}",
            change.quantity.id,
            change.quantity.wording().unit,
            change.side.letter(),
            change.forces.map_or("", CycleForces::word),
            change.cycles[0],
            change.cycles[1],
            change.largest(),
            rms(all),
            change.at_percent(),
            clear.map_or(String::new(), |clear| shown(100.0 * clear)),
            rms(beyond),
            certainty.word(),
        );
    }
    for row in time_changes(&compared.session, before) {
        let TimeChange { quantity, unit, side, before, after } = &row;
        let _ = writeln!(
            text,
            "{quantity},{unit},{side},,{},{},{},{},{},,,,,,,,{}",
            before[2],
            after[2],
            before[0],
            after[0],
            after[0] - before[0],
            row.certainty().word(),
        );
    }
    text
}
