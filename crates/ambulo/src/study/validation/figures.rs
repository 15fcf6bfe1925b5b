//! Figures of a trial, and their means over trials and persons.

use super::trial::JudgedTrial;
use crate::analysis::{EventAgreement, FootAgreement, ForceAgreement, GroundAgreement, MomentAgreement};
use crate::numerics::finite_mean;

/// A component of a ground force.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Component {
    /// Against gravity.
    Vertical,
    /// Along the walking direction.
    ForeAft,
    /// Across the walking direction.
    Lateral,
}

/// A joint whose sagittal moment is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LegJoint {
    /// Flexion of the hip.
    Hip,
    /// Flexion of the knee.
    Knee,
    /// Dorsiflexion of the ankle.
    Ankle,
}

/// A figure of a trial: the mean over its feet. [`super`] has the definitions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Figure {
    /// RMSE of a component [% of body weight].
    Rmse(Component),
    /// Relative RMSE of a component [%].
    Relative(Component),
    /// Correlation of a component.
    Correlation(Component),
    /// Centre of pressure along the walking direction [mm].
    CenterAlong,
    /// Centre of pressure across the walking direction [mm].
    CenterAcross,
    /// RMSE of a sagittal moment [N.m/kg].
    Moment(LegJoint),
    /// Correlation of a sagittal moment [1].
    MomentCorrelation(LegJoint),
    /// Foot strikes and foot offs [ms].
    Events,
    /// Share of the samples of a component inside the 90 % band [%].
    InBand(Component),
    /// Half-width of that band over the RMSE.
    BandWidth(Component),
}

impl Component {
    /// All components, in the order of tables.
    pub const ALL: [Component; 3] = [Component::Vertical, Component::ForeAft, Component::Lateral];

    /// The word of tables.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Component::Vertical => "vertical",
            Component::ForeAft => "fore-aft",
            Component::Lateral => "lateral",
        }
    }

    /// Index of the component in the forces of a [`ComparedSample`](crate::analysis::ComparedSample).
    pub(super) fn axis(self) -> usize {
        match self {
            Component::Vertical => 0,
            Component::ForeAft => 1,
            Component::Lateral => 2,
        }
    }

    /// Agreement of the component, from the agreement of a foot.
    #[must_use]
    pub fn of(self, foot: &FootAgreement) -> ForceAgreement {
        match self {
            Component::Vertical => foot.vertical,
            Component::ForeAft => foot.fore_aft,
            Component::Lateral => foot.lateral,
        }
    }
}

impl LegJoint {
    /// All joints, in the order of tables.
    pub const ALL: [LegJoint; 3] = [LegJoint::Hip, LegJoint::Knee, LegJoint::Ankle];

    /// The word of tables.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            LegJoint::Hip => "hip",
            LegJoint::Knee => "knee",
            LegJoint::Ankle => "ankle",
        }
    }

    /// Whether a moment belongs to this joint, by the beginning of the column's name in models of OpenSim and the
    /// built-in body.
    #[must_use]
    pub fn has(self, moment: &MomentAgreement) -> bool {
        let beginning = match self {
            LegJoint::Hip => "hip_flexion",
            LegJoint::Knee => "knee_angle",
            LegJoint::Ankle => "ankle_angle",
        };
        moment.quantity.starts_with(beginning)
    }
}

impl Figure {
    /// The figure of one agreement; not a number where there is none.
    #[must_use]
    pub fn of(self, agreement: &GroundAgreement) -> f64 {
        let feet = |pick: &dyn Fn(&FootAgreement) -> f64| finite_mean(agreement.feet.iter().map(pick));
        let moments = |joint: LegJoint, pick: &dyn Fn(&MomentAgreement) -> f64| {
            finite_mean(agreement.moments.iter().filter(|moment| joint.has(moment)).map(pick))
        };
        match self {
            Figure::Rmse(of) => feet(&|foot| 100.0 * of.of(foot).rmse_bw),
            Figure::Relative(of) => feet(&|foot| 100.0 * of.of(foot).rrmse),
            Figure::Correlation(of) => feet(&|foot| of.of(foot).r),
            Figure::CenterAlong => feet(&|foot| foot.center_of_pressure.fore_aft_weighted_mm),
            Figure::CenterAcross => feet(&|foot| foot.center_of_pressure.lateral_weighted_mm),
            Figure::Moment(joint) => moments(joint, &|moment| moment.rmse_nm_kg),
            Figure::MomentCorrelation(joint) => moments(joint, &|moment| moment.r),
            Figure::Events => events_ms(&agreement.events),
            Figure::InBand(of) => feet(&|foot| 100.0 * of.of(foot).band.holds),
            Figure::BandWidth(of) => feet(&|foot| of.of(foot).band.half_width_over_rmse),
        }
    }
}

/// Mean absolute error of all events together [ms].
fn events_ms(events: &[EventAgreement; 2]) -> f64 {
    let pairs: usize = events.iter().map(|event| event.pairs).sum();
    let total = |event: &EventAgreement| match event.pairs {
        0 => 0.0,
        pairs => event.mean_absolute_ms * pairs as f64,
    };
    events.iter().map(total).sum::<f64>() / pairs as f64
}

/// Mean over persons of the mean of their values; a value comes with the person.
pub fn over_persons<'a>(values: impl Iterator<Item = (&'a str, f64)>) -> f64 {
    let values: Vec<(&str, f64)> = values.collect();
    let of_person = |person: &str| finite_mean(values.iter().filter(|(of, _)| *of == person).map(|(_, value)| *value));
    finite_mean(distinct(values.iter().map(|(person, _)| *person)).into_iter().map(of_person))
}

/// Mean over persons of a figure of their trials of a kind.
pub fn over_kind<'a>(trials: &[&'a JudgedTrial], kind: &str, of: impl Fn(&'a JudgedTrial) -> f64) -> f64 {
    over_persons(trials.iter().filter(|trial| trial.kind == kind).map(|trial| (trial.person.as_str(), of(trial))))
}

/// Every person, in the order of the trials.
#[must_use]
pub fn persons<'a>(trials: &[&'a JudgedTrial]) -> Vec<&'a str> {
    distinct(trials.iter().map(|trial| trial.person.as_str()))
}

/// Every kind of trial, in the order of the trials.
#[must_use]
pub fn kinds<'a>(trials: &[&'a JudgedTrial]) -> Vec<&'a str> {
    distinct(trials.iter().map(|trial| trial.kind.as_str()))
}

fn distinct<'a>(words: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut all = Vec::new();
    for word in words {
        if !all.contains(&word) {
            all.push(word);
        }
    }
    all
}
