//! The most representative cycle of a side: the one nearest to the median of all.
//!
//!   m_q(t) = median over k of x_qk(t)
//!   d_qk   = √( mean over t of (x_qk(t) - m_q(t))² )
//!   D_k    = mean over q of d_qk / median over k of d_qk
//!
//! | symbol | meaning |
//! |---|---|
//! | x_qk(t) | angle q of cycle k at t per cent of the cycle [deg] |
//! | d_qk | distance of the cycle from the median curve [deg] |
//! | D_k | distance over all angles, without unit: 1 is usual, so that an angle that varies much has no more weight than another |
//!
//! The representative cycle has the least D. A cycle with D above [`FAR`] is far from the others; it is marked and
//! stays in the means. The representative trial has the least mean D of its best right and its best left cycle.
//!
//! Source: the idea of Sangeux and Polak 2015 (A simple method to choose the most representative stride and detect
//! outliers, Gait and Posture 41:726), of whom only the abstract was read: a curve is the deeper, the nearer it is to
//! the median. Distance, scaling and limit are ours.

use super::pool::rms_difference;
use super::{SessionCycle, depends_on_forces};
use crate::model::{BySide, Side};
use crate::numerics::median;
use std::collections::BTreeSet;

/// A cycle is an outlier if its distance from the median is more than this many times the usual distance.
const FAR: f64 = 2.0;
/// With fewer cycles a median gives no information about the others.
const FEWEST: usize = 3;
/// Smaller distances are rounding [deg].
const LEAST_DEG: f64 = 1e-6;

/// The most representative trial and cycles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Representative {
    /// The trial with the most representative cycles of both sides; `None` if no trial has cycles of both that are not
    /// excluded.
    pub trial: Option<usize>,
    /// The most representative cycle of each side: of this trial, or, without one, of all. An index into the cycles.
    pub cycles: BySide<Option<usize>>,
    /// Distance D of each cycle from the median of its side; `None` for excluded cycles, and where fewer than three can
    /// be compared.
    pub distances: Vec<Option<f64>>,
}

impl Representative {
    /// Whether a cycle is far from the others of its side.
    #[must_use]
    pub fn is_far(&self, cycle: usize) -> bool {
        self.distances.get(cycle).copied().flatten().is_some_and(|distance| distance > FAR)
    }
}

/// Finds the most representative trial and cycles.
#[must_use]
pub fn representative(cycles: &[SessionCycle]) -> Representative {
    let mut distances = vec![None; cycles.len()];
    for side in Side::BOTH {
        let own: Vec<usize> =
            (0..cycles.len()).filter(|k| cycles[*k].side == side && cycles[*k].excluded.is_none()).collect();
        for (k, distance) in own.iter().zip(of_side(cycles, &own)) {
            distances[*k] = distance;
        }
    }
    // One or two cycles have no distance and are as good as each other: the first is taken.
    let rank = |k: usize| distances[k].unwrap_or(0.0);
    let best = |side: Side, trial: Option<usize>| {
        let is_own = |k: &usize| {
            let cycle = &cycles[*k];
            cycle.side == side && cycle.excluded.is_none() && trial.is_none_or(|trial| cycle.trial == trial)
        };
        (0..cycles.len()).filter(is_own).min_by(|a, b| rank(*a).total_cmp(&rank(*b)))
    };
    let trials: BTreeSet<usize> = cycles.iter().map(|cycle| cycle.trial).collect();
    let of_both = |trial: usize| BySide::from_fn(|side| best(side, Some(trial))).both();
    let mean = |trial: usize| of_both(trial).map(|found| 0.5 * (rank(found.right) + rank(found.left)));
    let ranked = trials.into_iter().filter_map(|trial| Some((trial, mean(trial)?)));
    let trial = ranked.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(trial, _)| trial);
    Representative { trial, cycles: BySide::from_fn(|side| best(side, trial)), distances }
}

/// D of these cycles.
fn of_side(cycles: &[SessionCycle], own: &[usize]) -> Vec<Option<f64>> {
    if own.len() < FEWEST {
        return vec![None; own.len()];
    }
    let in_all = |quantity: &&String| own.iter().all(|k| cycles[*k].curves.contains_key(*quantity));
    let angles: Vec<&String> =
        cycles[own[0]].curves.keys().filter(|quantity| !depends_on_forces(quantity)).filter(in_all).collect();
    let mut sums = vec![0.0; own.len()];
    let mut counted = 0.0;
    for quantity in angles {
        let curves: Vec<&[f64]> = own.iter().map(|k| cycles[*k].curves[quantity].as_slice()).collect();
        let middle = median_curve(&curves);
        let away: Vec<f64> = curves.iter().map(|curve| rms_difference(curve, &middle)).collect();
        // A locked joint has the same curve in all cycles.
        let Some(usual) = median(away.iter().copied()).filter(|usual| *usual > LEAST_DEG) else { continue };
        sums.iter_mut().zip(&away).for_each(|(sum, distance)| *sum += distance / usual);
        counted += 1.0;
    }
    sums.into_iter().map(|sum| (counted > 0.0).then_some(sum / counted)).collect()
}

/// The median at each sample.
fn median_curve(curves: &[&[f64]]) -> Vec<f64> {
    let length = curves.iter().map(|curve| curve.len()).min().unwrap_or(0);
    (0..length).map(|i| median(curves.iter().map(|curve| curve[i])).unwrap_or(f64::NAN)).collect()
}
