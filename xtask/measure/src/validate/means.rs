//! Means: feet, then trials, then subjects; a subject with several files counts once.

use super::recording::Group;
use super::trial::Trial;
use ambulo::analysis::{ComparedStance, FootAgreement, ForceAgreement, GroundAgreement};

/// A figure of a trial: the mean over its feet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Figure {
    /// RMSE of a component [% of body weight]: 0 vertical, 1 fore-aft, 2 lateral.
    Force(usize),
    /// rRMSE of a component [%].
    Relative(usize),
    /// Correlation of a component.
    Correlation(usize),
    /// Centre of pressure weighted by the vertical force [mm]: 0 fore-aft, 1 lateral.
    Center(usize),
    /// RMSE of a sagittal moment [N.m/kg]: 0 hip, 1 knee, 2 ankle.
    Moment(usize),
    /// Its correlation.
    MomentCorrelation(usize),
    /// Strikes and offs [ms].
    Events,
    /// Share of the samples of a component inside the 90 % band [%].
    Band(usize),
    /// Half-width of that band over the RMSE.
    Width(usize),
}

/// Standard deviations on either side that contain 90 % of a normal distribution.
const BAND_90: f64 = 1.645;
/// Names of the components of a force.
pub(super) const COMPONENTS: [&str; 3] = ["vertical", "fore-aft", "lateral"];
/// Joints whose sagittal moments are compared, by the beginning of the column's name.
pub(super) const JOINTS: [(&str, &str); 3] = [("hip", "hip_flexion"), ("knee", "knee_angle"), ("ankle", "ankle_angle")];

pub(super) fn component(foot: &FootAgreement, k: usize) -> ForceAgreement {
    [foot.vertical, foot.fore_aft, foot.lateral][k]
}

impl Figure {
    /// The figure of one agreement; not a number where there is none.
    pub(super) fn of(self, agreement: &GroundAgreement) -> f64 {
        let feet = |pick: &dyn Fn(&FootAgreement) -> f64| mean(agreement.feet.iter().map(pick));
        let moments = |joint: usize, pick: &dyn Fn(&ambulo::analysis::MomentAgreement) -> f64| {
            mean(agreement.moments.iter().filter(|m| m.quantity.starts_with(JOINTS[joint].1)).map(pick))
        };
        match self {
            Figure::Force(k) => feet(&|foot| 100.0 * component(foot, k).rmse_bw),
            Figure::Relative(k) => feet(&|foot| 100.0 * component(foot, k).rrmse),
            Figure::Correlation(k) => feet(&|foot| component(foot, k).r),
            Figure::Center(0) => feet(&|foot| foot.center_of_pressure.fore_aft_weighted_mm),
            Figure::Center(_) => feet(&|foot| foot.center_of_pressure.lateral_weighted_mm),
            Figure::Moment(joint) => moments(joint, &|m| m.rmse_nm_kg),
            Figure::MomentCorrelation(joint) => moments(joint, &|m| m.r),
            Figure::Events => {
                let pairs: usize = agreement.events.iter().map(|e| e.pairs).sum();
                let total = |e: &ambulo::analysis::EventAgreement| match e.pairs {
                    0 => 0.0,
                    pairs => e.mean_absolute_ms * pairs as f64,
                };
                agreement.events.iter().map(total).sum::<f64>() / pairs as f64
            }
            Figure::Band(k) => feet(&|foot| 100.0 * component(foot, k).band.holds),
            Figure::Width(k) => feet(&|foot| component(foot, k).band.half_width_over_rmse),
        }
    }
}

/// Mean over subjects of the mean over their trials of a kind.
pub(super) fn over_subjects<'a>(trials: &'a [Trial], group: Group, of: impl Fn(&'a Trial) -> f64) -> f64 {
    let own: Vec<&Trial> = trials.iter().filter(|trial| trial.group == group).collect();
    let mut subjects: Vec<&str> = own.iter().map(|trial| trial.subject).collect();
    subjects.dedup();
    let of_subject = |subject: &str| mean(own.iter().filter(|trial| trial.subject == subject).map(|trial| of(trial)));
    mean(subjects.into_iter().map(of_subject))
}

/// Share of the samples of a component inside the 90 % band in a fifth of the stances of a trial.
pub(super) fn held_in_fifth(trial: &Trial, axis: usize, fifth: usize) -> f64 {
    let of_stance = |stance: &ComparedStance| {
        let own = stance.samples.iter().filter(|s| ((5.0 * s.phase) as usize).min(4) == fifth);
        mean(own.map(|s| {
            let is_inside = (s.predicted[axis] - s.measured[axis]).abs() <= BAND_90 * s.deviation[axis];
            f64::from(u8::from(is_inside))
        }))
    };
    mean(trial.stances.iter().map(of_stance))
}

/// Mean of what is a number.
pub(super) fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let known: Vec<f64> = values.filter(|x| x.is_finite()).collect();
    known.iter().sum::<f64>() / known.len() as f64
}
