//! Body mass: stated, or weighed on plates; which value is used, and whether the values agree.
//!
//! Three measurements are compared in pairs: a standing trial, the motion on the force plates, and the stated mass.
//! If two disagree, the third one decides. The errors are not symmetric: a load that rests next to the plates makes
//! the person too light on them, while only a wrong calibration or a carried load makes the person too heavy.

use super::source::{MarkerBody, MarkerSource};
use crate::analysis::MassSource;
use crate::findings::{Code, Findings, word};
use crate::motion::PlateRecording;
use crate::motion::force_plate::standing_weight_n;
use crate::numerics::elementary::hypot;
use crate::spatial::STANDARD_GRAVITY;
use serde::{Deserialize, Serialize};

/// Largest relative difference between masses of one person: clothes and shoes, a scale at home, a plate's calibration.
const SAME_PERSON: f64 = 0.05;
/// Body mass indices of people who walk [kg/m²]: the World Health Organization calls adults below 16 severely thin and
/// above 40 obese of the highest class (unverified); children of five years have 13 to 18. A stature that is estimated
/// from markers may be a tenth too small.
const BODY_MASS_INDEX: [f64; 2] = [11.0, 50.0];
/// The mass of a body that was made with a mass differs from it by roundings only, as a share.
const SAME_MASS: f64 = 1e-6;
/// Masses differ if their difference is more than this many standard errors.
const STANDARD_ERRORS: f64 = 2.0;
/// Standard error of a stated mass, as a share: twice it is [`SAME_PERSON`].
const STATED_ERROR: f64 = 0.025;
/// Sway of a standing person: samples further apart are independent [s].
const SWAY_S: f64 = 1.0;
/// Standard error of a force plate in use, as a share of the load: calibration and zero (ISB; Psycharakis, Miller 2006
/// give 0.5 to 1 %, unverified).
const PLATE_ERROR: f64 = 0.005;

/// The mass of the person: by each source, and which one the forces are computed with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BodyMass {
    /// How well it is known.
    pub state: MassState,
    /// The mass that forces are computed with [kg].
    pub kg: f64,
    /// Where this mass comes from: the source that gave exactly this mass, otherwise the model.
    pub source: MassWitness,
    /// Where the mass comes from that results are normalised by; it can differ from `kg` by up to 5 %.
    pub normalised_by: MassSource,
    /// Mass by the force plates [kg]; `null` if no person was weighed.
    pub plates_kg: Option<f64>,
    /// Standard error of `plates_kg` [kg].
    pub plates_error_kg: Option<f64>,
    /// Everything that states or weighs the mass.
    pub sources: Vec<MassEstimate>,
}

/// How well a mass is known. Forces that are predicted from the motion scale with the mass, so that a wrong mass shows
/// only against plates, a standing trial or a stated mass.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum MassState {
    /// Force plates carry this mass.
    Weighed,
    /// Stated, and not weighed.
    Stated,
    /// Force plates carry another mass.
    Contradicted,
    /// The model's own; neither stated nor weighed.
    Unknown,
}

impl MassState {
    /// The word in files and reports.
    #[must_use]
    pub fn word(self) -> &'static str {
        word(&self)
    }
}

/// A source of a body mass.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum MassWitness {
    /// Force plates under whole gait cycles, from strike to strike or off to off.
    Cycles,
    /// Force plates under steps, from the middle of a single support to that of the next.
    Valleys,
    /// Force plates under any time in which they carry everything.
    Impulse,
    /// Force plates under single stances of a symmetric gait.
    HalfStrides,
    /// Force plates under the standing person.
    Standing,
    /// Stated by the user or the files.
    Stated,
    /// Stated by the files, where the user states a mass as well.
    File,
    /// The model's own mass.
    Model,
}

impl MassWitness {
    /// The source in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            MassWitness::Cycles => "force plates, whole gait cycles",
            MassWitness::Valleys => "force plates, steps between single supports",
            MassWitness::Impulse => "force plates, impulse",
            MassWitness::HalfStrides => "force plates, single stances",
            MassWitness::Standing => "force plates, standing",
            MassWitness::Stated => "stated",
            MassWitness::File => "stated in the recording",
            MassWitness::Model => "the model's own",
        }
    }

    fn is_motion_on_plates(self) -> bool {
        use MassWitness::{Cycles, HalfStrides, Impulse, Valleys};
        matches!(self, Cycles | Valleys | Impulse | HalfStrides)
    }
}

/// A mass by one source.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MassEstimate {
    /// The source.
    pub by: MassWitness,
    /// The mass [kg].
    pub kg: f64,
    /// Its standard error [kg].
    pub error_kg: f64,
    /// How many times it was weighed.
    pub times: usize,
    /// First and last instant of the weighing in the recording [s].
    pub time_s: Option<[f64; 2]>,
}

impl MassEstimate {
    #[doc(hidden)] // for tests
    pub fn stated(kg: f64) -> MassEstimate {
        MassEstimate { by: MassWitness::Stated, kg, error_kg: STATED_ERROR * kg, times: 1, time_s: None }
    }

    fn in_file(kg: f64) -> MassEstimate {
        MassEstimate { by: MassWitness::File, ..MassEstimate::stated(kg) }
    }

    /// Whether another mass can belong to the same person.
    fn agrees(&self, other: &MassEstimate) -> bool {
        let error_kg = hypot(self.error_kg, other.error_kg);
        (self.kg - other.kg).abs() <= (SAME_PERSON * self.kg.max(other.kg)).max(STANDARD_ERRORS * error_kg)
    }

    fn in_words(&self) -> String {
        format!("{:.1} kg ({}, standard error {:.1} kg)", self.kg, self.by.words(), self.error_kg)
    }
}

/// Estimates of the mass that do not need the motion.
#[derive(Debug, Clone, Default)]
pub struct KnownMass {
    /// Mass stated by the user.
    pub stated: Option<MassEstimate>,
    /// Mass from the plates in a standing trial.
    pub standing: Option<MassEstimate>,
    /// Mass in the files, where the user states one as well.
    pub file: Option<MassEstimate>,
}

impl KnownMass {
    pub(super) fn stated(kg: Option<f64>) -> KnownMass {
        KnownMass { stated: kg.map(MassEstimate::stated), ..KnownMass::default() }
    }

    /// Known masses of a recording of markers: the user's statement has priority over the files.
    pub(super) fn of_markers(markers: &MarkerSource) -> KnownMass {
        let MarkerSource { trial, standing, body, .. } = markers;
        let files = standing.as_ref().and_then(|standing| standing.subject.mass_kg).or(trial.subject.mass_kg);
        let by_user = match body {
            MarkerBody::BuiltIn { mass_kg, .. } | MarkerBody::Model { mass_kg, .. } => *mass_kg,
            MarkerBody::Calibrated(_) => None,
        };
        let file = files.filter(|_| by_user.is_some()).map(MassEstimate::in_file);
        let stated = match body {
            MarkerBody::BuiltIn { mass_kg, .. } => mass_kg.or(files),
            MarkerBody::Model { mass_kg, protocol, .. } => {
                let of_protocol = || protocol.as_ref()?.scaling.as_ref()?.mass_kg;
                mass_kg.or_else(of_protocol)
            }
            MarkerBody::Calibrated(subject) => subject.calibration.as_ref().map(|_| subject.model.mass()),
        };
        let standing = standing.as_ref().and_then(|standing| standing_estimate(&standing.recording.plates));
        KnownMass { stated: stated.map(MassEstimate::stated), standing, file }
    }

    /// Whether the mass must be determined from the motion on the plates.
    pub fn needs_motion(&self) -> bool {
        match (&self.stated, &self.standing) {
            (Some(stated), Some(standing)) => !stated.agrees(standing),
            (stated, standing) => stated.is_none() && standing.is_none(),
        }
    }

    /// The mass to use [kg], with its source. The plates are used before a statement where both agree, because the
    /// ground forces are measured by them. Where standing and stated mass differ, the motion on the plates decides;
    /// without it the stated mass is used.
    pub fn decided(&self, motion: &[MassEstimate]) -> Option<MassEstimate> {
        let moving = combined(motion);
        match (&self.stated, &self.standing) {
            (Some(stated), Some(standing)) if stated.agrees(standing) => Some(standing.clone()),
            (Some(stated), Some(standing)) => {
                let distance = |to: &MassEstimate| moving.as_ref().map(|moving| (moving.kg - to.kg).abs());
                let is_standing = moving.as_ref().is_some_and(|moving| moving.agrees(standing))
                    && distance(standing) < distance(stated);
                Some(if is_standing { standing } else { stated }.clone())
            }
            (Some(one), None) | (None, Some(one)) => Some(one.clone()),
            (None, None) => moving,
        }
    }
}

impl BodyMass {
    /// The mass from all sources; `model_kg` is the mass that the forces are computed with.
    #[doc(hidden)] // for tests
    pub fn of(model_kg: f64, known: &KnownMass, motion: Vec<MassEstimate>, normalised_by: MassSource) -> BodyMass {
        let moving = combined(&motion);
        let chosen = known.decided(&motion).filter(|chosen| (chosen.kg / model_kg - 1.0).abs() < SAME_MASS);
        let source = chosen.map_or(MassWitness::Model, |chosen| chosen.by);
        let used = MassEstimate { by: source, kg: model_kg, error_kg: 0.0, times: 1, time_s: None };
        let plates = on_plates(known, moving, &used);
        let state = match &plates {
            Some(plates) if plates.agrees(&used) => MassState::Weighed,
            Some(_) => MassState::Contradicted,
            None if known.stated.is_some() => MassState::Stated,
            None => MassState::Unknown,
        };
        let mut sources: Vec<MassEstimate> = motion;
        sources.extend(known.standing.clone());
        sources.extend(known.stated.clone());
        sources.extend(known.file.clone());
        sources.push(MassEstimate { by: MassWitness::Model, ..used });
        let [plates_kg, plates_error_kg] =
            [plates.as_ref().map(|plates| plates.kg), plates.as_ref().map(|plates| plates.error_kg)];
        BodyMass { state, kg: model_kg, source, normalised_by, plates_kg, plates_error_kg, sources }
    }

    /// The mass that replaces the model's own [kg]: what the force plates carry, if it is not the mass of the model.
    ///
    /// A standing trial counts unless the motion agrees with the model instead. The motion alone must have been weighed
    /// over whole gait cycles, and twice if it is lighter than the model: a load that rests next to the plates makes a
    /// person too light on them, while nothing makes one too heavy but a load that is carried.
    pub(super) fn in_place_of_the_models(&self) -> Option<f64> {
        if self.source != MassWitness::Model {
            return None;
        }
        let own = MassEstimate { by: self.source, kg: self.kg, error_kg: 0.0, times: 1, time_s: None };
        let moving = self.in_motion();
        if let Some(standing) = self.by(MassWitness::Standing) {
            let is_denied = moving.as_ref().is_some_and(|moving| moving.agrees(&own) || !moving.agrees(standing));
            return (!standing.agrees(&own) && !is_denied).then_some(standing.kg);
        }
        let least = if moving.as_ref()?.kg < self.kg { 2 } else { 1 };
        let is_whole = self.by(MassWitness::Cycles).is_some_and(|cycles| cycles.times >= least && !cycles.agrees(&own));
        moving.filter(|moving| is_whole && !moving.agrees(&own)).map(|moving| moving.kg)
    }

    /// After residual reduction, which may have changed the mass of the body.
    pub(super) fn after_reduction(self, model_kg: f64) -> BodyMass {
        BodyMass { kg: model_kg, ..self }
    }

    /// The motion on the plates, all ways of weighing together.
    #[must_use]
    pub fn in_motion(&self) -> Option<MassEstimate> {
        let motion: Vec<MassEstimate> =
            self.sources.iter().filter(|estimate| estimate.by.is_motion_on_plates()).cloned().collect();
        combined(&motion)
    }

    /// Mass by the force plates.
    pub(super) fn on_plates(&self) -> Option<MassEstimate> {
        let (kg, error_kg) = (self.plates_kg?, self.plates_error_kg?);
        Some(MassEstimate { by: self.source, kg, error_kg, times: 1, time_s: None })
    }

    /// Difference of the used mass from a weighing, less the standard error, as a share.
    pub(super) fn disagreement(&self, weighing: &MassEstimate) -> f64 {
        ((weighing.kg - self.kg).abs() - weighing.error_kg) / self.kg
    }

    /// The estimate of one source.
    #[must_use]
    pub fn by(&self, source: MassWitness) -> Option<&MassEstimate> {
        self.sources.iter().find(|estimate| estimate.by == source)
    }

    /// The mass in the files, if it contradicts the stated one and nothing was weighed.
    pub(super) fn otherwise_in_file(&self) -> Option<&MassEstimate> {
        let (stated, file) = (self.by(MassWitness::Stated)?, self.by(MassWitness::File)?);
        Some(file).filter(|file| self.state == MassState::Stated && !file.agrees(stated))
    }

    /// Factor by which the body mass index of a stature [m] is outside the range of people who walk; 1 on its edge.
    pub(super) fn unusual_by(&self, height_m: f64) -> f64 {
        let index = self.kg / (height_m * height_m);
        (index / BODY_MASS_INDEX[1]).max(BODY_MASS_INDEX[0] / index)
    }

    /// A sentence about a mass that is too large or too small for a stature [m].
    pub(super) fn unusual(&self, height_m: f64) -> String {
        let ([least, most], index) = (BODY_MASS_INDEX, self.kg / (height_m * height_m));
        format!(
            "{:.1} kg at {height_m:.2} m is a body mass index of {index:.0} kg/m²; people who walk have {least:.0} to \
             {most:.0}: mass, stature or the unit of the force plates is wrong",
            self.kg
        )
    }

    /// Reports a statement that the files or the stature [m] contradict.
    #[doc(hidden)] // for tests
    pub fn report_statement(&self, height_m: f64, findings: &mut Findings) {
        if let Some(file) = self.otherwise_in_file() {
            let message = format!(
                "the body mass is given as {:.1} kg, the recording states {:.1} kg, and no force plate decides; the \
                 given mass was used",
                self.kg, file.kg
            );
            findings.report(Code::MassStatedTwice, message);
        }
        if self.unusual_by(height_m) > 1.0 {
            findings.report(Code::MassUnusual, self.unusual(height_m));
        }
    }

    /// Reports sources that contradict the used mass.
    #[doc(hidden)] // for tests
    pub fn report(&self, findings: &mut Findings) {
        let used = MassEstimate { by: self.source, kg: self.kg, error_kg: 0.0, times: 1, time_s: None };
        let witnesses = [self.in_motion(), self.by(MassWitness::Standing).cloned()];
        let others: Vec<MassEstimate> = witnesses.into_iter().flatten().filter(|other| !other.agrees(&used)).collect();
        if others.is_empty() {
            return;
        }
        let found: Vec<String> = others.iter().map(MassEstimate::in_words).collect();
        let is_confirmed = self.by(MassWitness::Standing).is_some_and(|standing| standing.agrees(&used));
        let why = match (self.state, is_confirmed, others.iter().all(|other| other.kg < self.kg)) {
            (_, true, true) => {
                "the standing trial confirms the mass, so a part of the weight was next to the plates, or they measure \
                 too little"
            }
            (_, true, false) => {
                "the standing trial confirms the mass, so the plates carried something else, or they measure too much"
            }
            (MassState::Contradicted, false, true) => {
                "either the body is not this person's, or a part of the weight was next to the plates"
            }
            (MassState::Contradicted, false, false) => {
                "the body is not this person's: every force is wrong in proportion"
            }
            (_, false, _) => "the other sources confirm it",
        };
        let message = format!(
            "forces are computed with {:.1} kg ({}), but the ground forces carry {}: {why}",
            self.kg,
            self.source.words(),
            found.join(" and ")
        );
        findings.report(Code::MassContradicted, message);
    }
}

/// The estimate of a motion: the mean of all ways, weighted by the inverse of their variance. The ways share the same
/// forces, so that together they are no more certain than the best of them, and less where they differ (Birge 1932,
/// Phys Rev 40:207-227).
pub fn combined(estimates: &[MassEstimate]) -> Option<MassEstimate> {
    let best = estimates.iter().min_by(|a, b| a.error_kg.total_cmp(&b.error_kg))?;
    let weight = |e: &MassEstimate| e.error_kg.max(f64::MIN_POSITIVE).powi(-2);
    let total: f64 = estimates.iter().map(weight).sum();
    let kg = estimates.iter().map(|e| weight(e) * e.kg).sum::<f64>() / total;
    let chi2: f64 = estimates.iter().map(|e| weight(e) * (e.kg - kg).powi(2)).sum();
    let birge = (chi2 / (estimates.len().max(2) - 1) as f64).sqrt().max(1.0);
    Some(MassEstimate { kg, error_kg: birge * best.error_kg, ..best.clone() })
}

/// Mass by the plates. Where standing and motion disagree, the motion counts, since its forces are those that moments
/// are computed from; where neither agrees with the used mass, the heavier: a load next to the plates makes a person
/// lighter.
fn on_plates(known: &KnownMass, moving: Option<MassEstimate>, used: &MassEstimate) -> Option<MassEstimate> {
    match (known.standing.clone(), moving) {
        (Some(standing), Some(moving)) if standing.agrees(&moving) => {
            Some(if moving.error_kg < standing.error_kg { moving } else { standing })
        }
        (Some(standing), Some(moving)) => {
            let is_known = standing.agrees(used) || moving.agrees(used);
            Some(if is_known || moving.kg > standing.kg { moving } else { standing })
        }
        (one, None) | (None, one) => one,
    }
}

/// The mass of a person who stands still, with the scatter of the force as its error: sway moves the mass centre up and
/// down.
fn standing_estimate(plates: &[PlateRecording]) -> Option<MassEstimate> {
    let kg = standing_weight_n(plates)? / STANDARD_GRAVITY;
    let samples = plates.iter().map(|plate| plate.times.len()).min()?;
    let total = |i: usize| plates.iter().map(|plate| plate.vertical(i)).sum::<f64>() / STANDARD_GRAVITY;
    // Beyond a fifth of the weight the person steps on or off.
    let still: Vec<f64> = (0..samples).map(total).filter(|found| (found / kg - 1.0).abs() < 0.2).collect();
    let times = &plates.first()?.times;
    let lasted_s = (times.last()? - times.first()?) * still.len() as f64 / samples as f64;
    let variance = still.iter().map(|found| (found - kg).powi(2)).sum::<f64>() / still.len().max(1) as f64;
    let scatter_kg = (variance / (lasted_s / SWAY_S).max(1.0)).sqrt();
    Some(MassEstimate {
        by: MassWitness::Standing,
        kg,
        error_kg: hypot(scatter_kg, PLATE_ERROR * kg),
        times: 1,
        time_s: None,
    })
}

/// Reports which mass the built-in body has.
pub fn report_decided(known: &KnownMass, decided: &MassEstimate, findings: &mut Findings) {
    let kg = decided.kg;
    match (&known.stated, &known.standing) {
        (Some(stated), Some(standing)) if stated.agrees(standing) => {
            let message = format!(
                "{:.2} kg stand on the plates in the standing trial and were used; {:.2} kg are stated",
                standing.kg, stated.kg
            );
            findings.report(Code::MassStanding, message);
        }
        // Where the stated mass is used, `BodyMass::report` names the weighing that contradicts it.
        (Some(stated), Some(standing)) if decided.by == MassWitness::Standing => {
            let message = format!(
                "the stated mass is {:.1} kg, force plates measured {:.1} kg in the standing trial and in motion; the \
                 measured mass was used",
                stated.kg, standing.kg
            );
            findings.report(Code::MassStandingMismatch, message);
        }
        (None, Some(_)) => {
            let message = format!("no mass is stated; {kg:.1} kg stand on the plates in the standing trial");
            findings.report(Code::MassStanding, message);
        }
        (None, None) => {
            let [from, to] = decided.time_s.unwrap_or([f64::NAN; 2]);
            let message = format!(
                "no mass is stated; the force plates carry {kg:.1} kg from {from:.3} to {to:.3} s (standard error \
                 {:.1} kg), which was used",
                decided.error_kg
            );
            findings.report(Code::MassWeighed, message);
        }
        (Some(_), _) => {}
    }
}
