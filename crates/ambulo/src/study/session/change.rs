//! Change of a mean curve between two sessions, and the part of it that a new calibration of the body explains.
//!
//!   d(t) = x̄_after(t) - x̄_before(t)          change
//!   c(t) = a + b f(t)                         least squares fit to d(t), within the limits below
//!   r(t) = d(t) - c(t)                        the change beyond the error of a calibration
//!   s(t) = √( s_before(t)² / n_before + s_after(t)² / n_after )
//!
//! Markers are placed anew in every session. A marker in another place turns the axes of its segment: that adds a
//! constant to angles, and mixes the angle and the moment about the largest axis of a joint into those about its other
//! axes. Such a change is not one of the person. It cannot be told from one either, so it is not counted as clear.
//!
//! | symbol | unit | meaning |
//! |---|---|---|
//! | a | deg | constant of an angle, at most [`calibration_error`]; 0 for other quantities |
//! | b | 1 | share of f, the flexion or its moment ([`mixed_with`]); at most sin 20° |
//! | s(t) | unit of the curve | standard deviation of the difference of the means over the cycles |
//!
//! A sample is clear if \|r\| exceeds both 2 s and [`least_change`].
//!
//! Source of the limits: ours. McGinley et al. 2009 (Gait and Posture 29:360, abstract read) review repeatability
//! between sessions: the largest errors are those of rotations of hip and knee.
//! Pinned by: tests/session.rs

use super::pool::CurveStatistics;
use super::{CycleForces, PooledCurve};
use crate::numerics::mean;

/// A change above this many standard deviations of the difference is more than variation.
const CLEAR_SD: f64 = 2.0;
/// A change is clear if it is so in more than this share of the cycle.
const CLEAR_SHARE: f64 = 0.1;
/// Largest share that a turned axis mixes into the quantities about other axes: sin 20°.
const MOST_CROSS_TALK: f64 = 0.342;
/// A curve whose squares sum to less shows no axis.
const LEAST_SQUARES: f64 = 0.1;

/// How sure a change is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Certainty {
    /// More than the variation between cycles and than the error of a calibration.
    Clear,
    /// Another calibration of the body explains it.
    Calibration,
    /// Not more than the variation between cycles.
    Variation,
    /// The forces are predicted, and errors of predictions are larger than most changes.
    Predicted,
    /// A session has a single cycle, so that its variation is not known.
    SingleCycle,
}

impl Certainty {
    /// The name in files.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Certainty::Clear => "clear",
            Certainty::Calibration => "calibration",
            Certainty::Variation => "variation",
            Certainty::Predicted => "predicted",
            Certainty::SingleCycle => "single_cycle",
        }
    }

    /// The explanation in tables.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Certainty::Clear => "clear",
            Certainty::Calibration => "a new calibration explains it",
            Certainty::Variation => "within the variation between cycles",
            Certainty::Predicted => "not sure: predicted forces",
            Certainty::SingleCycle => "not known: a single cycle",
        }
    }
}

/// Change of a mean curve.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveChange {
    /// d(t).
    pub change: Vec<f64>,
    /// c(t).
    pub explained: Vec<f64>,
    /// r(t).
    pub beyond: Vec<f64>,
    /// 2 s(t); `None` if a session has a single cycle.
    pub variation: Option<Vec<f64>>,
    /// a.
    pub offset: f64,
    /// Share of the cycle that is clear, from 0 to 1; `None` if the variation is not known.
    pub clear: Option<f64>,
    /// How sure the change is.
    pub certainty: Certainty,
}

impl CurveChange {
    /// Place of the largest change beyond calibration, or of the largest change if nothing is beyond.
    #[must_use]
    pub fn place(&self) -> usize {
        let curve = if self.certainty == Certainty::Clear { &self.beyond } else { &self.change };
        (0..curve.len()).max_by(|i, k| curve[*i].abs().total_cmp(&curve[*k].abs())).unwrap_or(0)
    }
}

/// The constant [deg] that another placement of markers may add to an angle; `None` for other quantities.
#[must_use]
pub fn calibration_error(quantity: &str) -> Option<f64> {
    match quantity {
        "hip_rotation_angle" | "knee_rotation_angle" | "subtalar_angle" => Some(30.0),
        "knee_adduction_angle" => Some(10.0),
        angle if angle.ends_with("_angle") => Some(5.0),
        _ => None,
    }
}

/// The least change that counts, in the unit of the quantity.
#[must_use]
pub fn least_change(quantity: &str) -> f64 {
    match quantity {
        angle if angle.ends_with("_angle") => 2.0,
        moment if moment.ends_with("_moment") => 0.1,
        power if power.ends_with("_power") => 0.3,
        ground if ground.starts_with("ground_force") => 0.03,
        _ => 0.3,
    }
}

/// The quantity that a turned axis of the joint mixes into this one.
#[must_use]
pub fn mixed_with(quantity: &str) -> Option<&'static str> {
    match quantity {
        "knee_adduction_angle" | "knee_rotation_angle" => Some("knee_flexion_angle"),
        "subtalar_angle" => Some("ankle_dorsiflexion_angle"),
        "hip_adduction_moment" | "hip_rotation_moment" => Some("hip_flexion_moment"),
        "knee_adduction_moment" | "knee_rotation_moment" => Some("knee_flexion_moment"),
        "ankle_inversion_moment" | "ankle_rotation_moment" => Some("ankle_dorsiflexion_moment"),
        _ => None,
    }
}

/// Change of a quantity of one side. `mixed` is the mean over both sessions of the curve of [`mixed_with`]. `None` if
/// the forces have another source in each session, or the curves different lengths.
#[must_use]
pub fn curve_change(
    quantity: &str,
    before: &PooledCurve,
    after: &PooledCurve,
    mixed: Option<&[f64]>,
) -> Option<CurveChange> {
    let (a, b) = (&after.statistics, &before.statistics);
    if before.forces != after.forces || a.mean.len() != b.mean.len() {
        return None;
    }
    let change: Vec<f64> = a.mean.iter().zip(&b.mean).map(|(a, b)| a - b).collect();
    let mixed = mixed.filter(|f| f.len() == change.len() && mixed_with(quantity).is_some());
    let (offset, explained) = explained(quantity, &change, mixed);
    let beyond: Vec<f64> = change.iter().zip(&explained).map(|(d, c)| d - c).collect();
    let variation = variation(a, b);
    let least = least_change(quantity);
    let share = |curve: &[f64], least: f64| {
        let variation = variation.as_ref()?;
        let clear = curve.iter().zip(variation).filter(|(x, limit)| x.abs() > limit.max(least));
        Some(clear.count() as f64 / curve.len().max(1) as f64)
    };
    let clear = share(&beyond, least);
    let certainty = match (after.forces, clear, share(&change, least)) {
        (Some(CycleForces::Predicted), ..) => Certainty::Predicted,
        (_, None, _) | (_, _, None) => Certainty::SingleCycle,
        (_, Some(beyond), _) if beyond > CLEAR_SHARE => Certainty::Clear,
        (_, _, Some(all)) if all > CLEAR_SHARE => Certainty::Calibration,
        _ => Certainty::Variation,
    };
    Some(CurveChange { change, explained, beyond, variation, offset, clear, certainty })
}

/// a and c(t).
fn explained(quantity: &str, change: &[f64], mixed: Option<&[f64]>) -> (f64, Vec<f64>) {
    let limit = calibration_error(quantity);
    // Without a constant the line goes through the origin.
    let centred = |curve: &[f64]| limit.map_or(0.0, |_| mean(curve));
    let share = mixed.map_or(0.0, |f| slope([f, change], [centred(f), centred(change)]));
    let offset = centred(change) - share * mixed.map_or(0.0, centred);
    let offset = limit.map_or(0.0, |limit| offset.clamp(-limit, limit));
    let at = |i: usize| offset + share * mixed.map_or(0.0, |f| f[i]);
    (offset, (0..change.len()).map(at).collect())
}

/// Slope of the least squares line of y over x through a point, within the limits; 0 if x hardly changes.
fn slope([x, y]: [&[f64]; 2], [x_at, y_at]: [f64; 2]) -> f64 {
    let squares: f64 = x.iter().map(|x| (x - x_at).powi(2)).sum();
    let products: f64 = x.iter().zip(y).map(|(x, y)| (x - x_at) * (y - y_at)).sum();
    if squares > LEAST_SQUARES { (products / squares).clamp(-MOST_CROSS_TALK, MOST_CROSS_TALK) } else { 0.0 }
}

/// 2 s(t).
fn variation(a: &CurveStatistics, b: &CurveStatistics) -> Option<Vec<f64>> {
    let (of_a, of_b) = (a.sd.as_ref()?, b.sd.as_ref()?);
    let at =
        |(a_sd, b_sd): (&f64, &f64)| CLEAR_SD * (a_sd.powi(2) / a.count as f64 + b_sd.powi(2) / b.count as f64).sqrt();
    Some(of_a.iter().zip(of_b).map(at).collect())
}
