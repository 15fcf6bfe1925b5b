//! Movement analysis profile, gait profile score, and deviations from the mean of healthy subjects.
//!
//!   GVS_q  = √( mean over t of (x_q(t) - n_q(t))² )
//!   GPS    = √( mean over q of GVS_q² )          over the nine angles of a side
//!   GPS    = √( Σ GVS_q² / 15 )                  of both sides: pelvis of the left cycles, six angles of each leg
//!
//! | symbol | unit | meaning |
//! |---|---|---|
//! | x_q(t) | deg | angle q of a cycle at t per cent of the cycle |
//! | n_q(t), σ_q(t) | deg | mean of the reference group, and standard deviation between its subjects |
//! | GVS | deg | gait variable score; all of them together are the movement analysis profile |
//! | GPS | deg | gait profile score |
//!
//! Scores are computed per cycle; a session has their mean and standard deviation over its cycles. A person drawn from
//! the reference group has the expected score √( mean over t of σ_q(t)² ), because the expectation of (x - n)² is σ².
//!
//! Source: Baker, McGinley, Schwartz, Beynon, Rozumalski, Graham, Tirosh 2009 (The gait profile score and movement
//! analysis profile, Gait Posture 30:265), unverified; variables and the pelvis of the left side as in the
//! implementation of pyCGM2 (`CGM1_GPS`, read in excerpts).

use super::SessionCycle;
use super::pool::{CurveStatistics, rms_difference};
use crate::model::{BySide, Side};
use crate::motion::interpolate;
use crate::numerics::elementary::ln;
use crate::numerics::rms;

/// The angles of the profile, pelvis angles first.
pub const PROFILE: [&str; 9] = [
    "pelvis_tilt_angle",
    "pelvis_obliquity_angle",
    "pelvis_rotation_angle",
    "hip_flexion_angle",
    "hip_adduction_angle",
    "hip_rotation_angle",
    "knee_flexion_angle",
    "ankle_dorsiflexion_angle",
    "foot_progression_angle",
];
/// Number of pelvis angles, which come first.
const OF_PELVIS: usize = 3;
/// More standard deviations from the mean are outside the normal range: 95 % of a normal distribution are inside.
const RANGE_SD: f64 = 2.0;
/// A smaller standard deviation between subjects, as a share of the largest, is no measure [1].
const LEAST_SD: f64 = 0.05;

/// Mean and standard deviation of a reference group over the cycle, at equal distances from 0 to 100 %.
#[derive(Debug, Clone, PartialEq)]
pub struct NormalCurve {
    /// Mean.
    pub mean: Vec<f64>,
    /// Standard deviation between subjects.
    pub sd: Vec<f64>,
}

impl NormalCurve {
    /// Values of a curve, which has its own number of samples from 0 to 100 %, at the samples of this one.
    fn sampled(&self, curve: &[f64]) -> Vec<f64> {
        let percents = |count: usize| (0..count).map(move |i| 100.0 * i as f64 / (count.max(2) - 1) as f64);
        let own: Vec<f64> = percents(curve.len()).collect();
        percents(self.mean.len()).map(|percent| interpolate(&own, curve, percent)).collect()
    }

    /// Gait variable score of a curve.
    #[must_use]
    pub fn score(&self, curve: &[f64]) -> f64 {
        rms_difference(&self.sampled(curve), &self.mean)
    }

    /// The mean at a per cent of the cycle.
    #[must_use]
    pub fn at_percent(&self, percent: f64) -> f64 {
        let own: Vec<f64> =
            (0..self.mean.len()).map(|i| 100.0 * i as f64 / (self.mean.len().max(2) - 1) as f64).collect();
        interpolate(&own, &self.mean, percent)
    }

    /// The score to expect of a person of the reference group.
    #[must_use]
    pub fn expected_score(&self) -> f64 {
        rms(&self.sd)
    }
}

/// Mean of a score over cycles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VariableScore {
    /// Mean [deg].
    pub mean: f64,
    /// Standard deviation over the cycles [deg]; `None` for one cycle.
    pub sd: Option<f64>,
    /// Number of cycles.
    pub cycles: usize,
}

impl VariableScore {
    fn of(scores: &[f64]) -> Option<VariableScore> {
        let values: Vec<[f64; 1]> = scores.iter().map(|score| [*score]).collect();
        let CurveStatistics { mean, sd, count } =
            CurveStatistics::of(&values.iter().map(<[f64; 1]>::as_slice).collect::<Vec<_>>())?;
        Some(VariableScore { mean: mean[0], sd: sd.map(|sd| sd[0]), cycles: count })
    }
}

/// Movement analysis profile and gait profile scores of a session.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct GaitProfile {
    /// Scores of the angles, in the order of [`PROFILE`]; `None` where the angle, its norm or the cycles are missing.
    pub variables: [BySide<Option<VariableScore>>; PROFILE.len()],
    /// The score to expect of a person of the reference group, per angle.
    pub expected: [Option<f64>; PROFILE.len()],
    /// Gait profile score of each side; `None` unless all nine angles are known.
    pub sides: BySide<Option<VariableScore>>,
    /// Gait profile score of both sides, from the mean scores of the angles.
    pub overall: Option<f64>,
    /// The gait profile score to expect of a person of the reference group.
    pub expected_overall: Option<f64>,
}

/// Gait deviation index of a gait profile score [deg], from mean and standard deviation of ln(GPS) over healthy people:
///
///   GDI = 100 - 10 (ln GPS - mean) / sd
///
/// This is the index of the profile score (Baker et al. 2009 call it GDI*, unverified); the index of Schwartz and
/// Rozumalski 2008 (Gait and Posture 28:351, unverified) takes features of thousands of strides in place of the score.
#[must_use]
pub fn deviation_index(score_deg: f64, [mean, sd]: [f64; 2]) -> f64 {
    100.0 - 10.0 * (ln(score_deg) - mean) / sd
}

/// The profile of the cycles that are not excluded; `norm` returns the curve of the reference group for an angle.
#[must_use]
pub fn profile(cycles: &[SessionCycle], norm: impl Fn(&str) -> Option<NormalCurve>) -> GaitProfile {
    let norms = PROFILE.map(norm);
    let score = |cycle: &SessionCycle, q: usize| Some(norms[q].as_ref()?.score(cycle.curves.get(PROFILE[q])?));
    let own = |side: Side| cycles.iter().filter(move |cycle| cycle.side == side && cycle.excluded.is_none());
    let variables: [BySide<Option<VariableScore>>; PROFILE.len()] = std::array::from_fn(|q| {
        BySide::from_fn(|side| VariableScore::of(&own(side).filter_map(|cycle| score(cycle, q)).collect::<Vec<_>>()))
    });
    let of_cycle = |cycle: &SessionCycle| {
        let scores: Option<Vec<f64>> = (0..PROFILE.len()).map(|q| score(cycle, q)).collect();
        scores.map(|scores| rms(&scores))
    };
    let sides = BySide::from_fn(|side| VariableScore::of(&own(side).filter_map(of_cycle).collect::<Vec<_>>()));
    let fifteen: Option<Vec<f64>> = Side::BOTH
        .into_iter()
        .flat_map(|side| (if side == Side::Left { 0 } else { OF_PELVIS }..PROFILE.len()).map(move |q| (side, q)))
        .map(|(side, q)| variables[q][side].map(|score| score.mean))
        .collect();
    let expected = norms.each_ref().map(|norm| norm.as_ref().map(NormalCurve::expected_score));
    let nine: Option<Vec<f64>> = expected.iter().copied().collect();
    GaitProfile {
        variables,
        sides,
        overall: fifteen.map(|scores| rms(&scores)),
        expected_overall: nine.map(|scores| rms(&scores)),
        expected,
    }
}

/// How a mean curve differs from the reference group.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// Root mean square difference from the mean of the group, in the unit of the quantity.
    pub rms: f64,
    /// Root mean square to expect of a person of the group.
    pub expected_rms: f64,
    /// The largest difference in standard deviations of the group: in the unit of the quantity, positive above the
    /// mean.
    pub largest: f64,
    /// Largest deviation in standard deviations.
    pub largest_sd: f64,
    /// Place of the largest difference [% of the cycle].
    pub at_percent: f64,
    /// Share of the cycle more than two standard deviations away, from 0 to 1.
    pub outside: f64,
}

/// Deviation of a mean curve from a reference group. Where the group varies little, in less than 5 % of its largest
/// standard deviation, that share is used. `None` for a group without variation.
#[must_use]
pub fn deviation(mean: &[f64], norm: &NormalCurve) -> Option<Deviation> {
    let found = norm.sampled(mean);
    let largest_sd = norm.sd.iter().copied().fold(0.0, f64::max);
    let in_sd = |i: usize| (found[i] - norm.mean[i]) / norm.sd[i].max(LEAST_SD * largest_sd);
    if largest_sd <= 0.0 || found.is_empty() {
        return None;
    }
    let far = (0..found.len()).max_by(|a, b| in_sd(*a).abs().total_cmp(&in_sd(*b).abs()))?;
    let outside = (0..found.len()).filter(|i| in_sd(*i).abs() > RANGE_SD).count();
    Some(Deviation {
        rms: norm.score(mean),
        expected_rms: norm.expected_score(),
        largest: found[far] - norm.mean[far],
        largest_sd: in_sd(far),
        at_percent: 100.0 * far as f64 / (found.len().max(2) - 1) as f64,
        outside: outside as f64 / found.len() as f64,
    })
}
