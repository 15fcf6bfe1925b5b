//! Content of `summary.json` of a session: the person, the trials, times and distances, the profile; read back by later
//! sessions.

use ambulo::findings::{Code, Finding, Findings, Severity};
use ambulo::numerics::{mean, sample_deviation};
use ambulo::study::session::VariableScore;
use ambulo_results::{Convention, QuantitySummary, WalkingSummary};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The layout of the files of a session; another number is another layout.
pub const SESSION_FORMAT: u32 = 1;

/// Mean and standard deviation, and the number of cycles, trials or subjects behind them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// Standard deviation; `null` of a single number.
    pub sd: Option<f64>,
    /// Number of values.
    pub n: usize,
}

impl From<VariableScore> for Spread {
    fn from(score: VariableScore) -> Spread {
        Spread { mean: score.mean, sd: score.sd, n: score.cycles }
    }
}

impl Spread {
    /// Statistics of at least one number.
    #[must_use]
    pub fn of(values: &[f64]) -> Option<Spread> {
        let sd = sample_deviation(values);
        (!values.is_empty()).then(|| Spread { mean: mean(values), sd, n: values.len() })
    }
}

/// A trial of a session.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TrialSummary {
    /// Name.
    pub trial: String,
    /// Day of the recording, as YYYY-MM-DD.
    pub recorded_on: Option<String>,
    /// Why nothing could be computed; the rest is then empty.
    pub error: Option<String>,
    /// Activity of the person.
    pub activity: Option<String>,
    /// Walking speed [m/s].
    pub speed_m_s: Option<f64>,
    /// Good, doubtful or bad data.
    pub quality: Option<String>,
    /// Why the data are not good.
    pub quality_reasons: Vec<String>,
    /// Feasible, infeasible or not judged.
    pub verdict: Option<String>,
    /// Whole cycles of the right and of the left foot.
    pub cycles: [usize; 2],
    /// Cycles that count in the means.
    pub counted: [usize; 2],
    /// Counted cycles with measured forces.
    pub measured: [usize; 2],
    /// Warnings about data and calibration.
    #[serde(default)]
    pub warnings: Vec<TrialWarning>,
    /// Its own page, relative to that of the session.
    #[serde(default)]
    pub page: Option<String>,
}

/// A warning about a trial.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct TrialWarning {
    /// Code of the finding (docs/FINDINGS.md).
    pub code: String,
    /// Found value, place, and consequence.
    pub message: String,
}

impl TrialWarning {
    /// The warnings of a run, and the assumptions of its calibration.
    pub(super) fn of(findings: &Findings) -> Vec<TrialWarning> {
        let is_shown =
            |finding: &&Finding| finding.severity() == Severity::Warning || finding.code == Code::CalibrationAssumed;
        let shown = findings.as_slice().iter().filter(is_shown);
        shown
            .map(|finding| TrialWarning { code: finding.code.name().to_owned(), message: finding.message.clone() })
            .collect()
    }

    /// Whether it is about the body that was calibrated, or about where its markers are.
    #[must_use]
    pub fn is_of_calibration(&self) -> bool {
        let of_markers = ["markers.moved", "markers.misplaced", "markers.not_measured", "markers.held_in_place"];
        self.code.starts_with("calibration.") || of_markers.contains(&self.code.as_str())
    }
}

/// A cycle that is in no mean.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ExcludedSummary {
    /// Name of the trial.
    pub trial: String,
    /// `r` or `l`.
    pub side: String,
    /// Number of the cycle, from 1.
    pub cycle: usize,
    /// Why.
    pub reason: String,
}

/// The representative trial and its cycles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RepresentativeSummary {
    /// Name of the trial that has the representative cycles of both sides; `null` if they are of two trials.
    pub trial: Option<String>,
    /// Trial and number of the right cycle.
    pub right: Option<(String, usize)>,
    /// Trial and number of the left cycle.
    pub left: Option<(String, usize)>,
}

/// The reference group of a session.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct ReferenceSummary {
    /// The group in a sentence.
    pub words: String,
    /// Number of subjects, if it is known.
    pub persons: Option<usize>,
    /// Youngest and oldest [years].
    pub ages_years: Option<[f64; 2]>,
}

/// One angle of the movement analysis profile.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct VariableSummary {
    /// The angle.
    pub quantity: String,
    /// Gait variable score of the right cycles [deg].
    pub right: Option<Spread>,
    /// Of the left cycles [deg].
    pub left: Option<Spread>,
    /// The score to expect of a person of the reference group [deg].
    pub expected: Option<f64>,
}

/// Movement analysis profile and gait profile scores.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ProfileSummary {
    /// Gait profile score of the right cycles [deg].
    pub right: Option<Spread>,
    /// Of the left cycles [deg].
    pub left: Option<Spread>,
    /// Of both sides [deg].
    pub overall: Option<f64>,
    /// The score to expect of a person of the reference group [deg].
    pub expected: Option<f64>,
    /// The angles.
    pub(crate) variables: Vec<VariableSummary>,
    /// Gait deviation indices; `null` without an own reference group of 30 people.
    #[serde(default)]
    pub(crate) deviation_index: Option<DeviationIndexSummary>,
    /// Why there is none.
    #[serde(default)]
    pub no_deviation_index: Option<String>,
}

/// Gait deviation index, from the gait profile score: 100 is the mean of the reference group, 10 less a standard
/// deviation away.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct DeviationIndexSummary {
    /// Of the right cycles.
    pub right: Option<f64>,
    /// Of the left cycles.
    pub left: Option<f64>,
    /// Of both sides.
    pub overall: Option<f64>,
}

/// A score, time or curve before and after.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ChangeSummary {
    /// Name of the quantity.
    pub quantity: String,
    /// Unit of the numbers.
    pub unit: String,
    /// `r`, `l` or `both`.
    pub side: String,
    /// Value of the earlier session.
    pub before: f64,
    /// Value of this session.
    pub after: f64,
    /// Two standard deviations of the change over the cycles; `null` if a session has a single one.
    pub two_sd: Option<f64>,
    /// Place of the values [% of the cycle]; `null` for scores, times and distances.
    pub at_percent: Option<f64>,
    /// Mean of the reference group, at this place.
    pub normal: Option<f64>,
    /// Constant part that a calibration explains; curves only.
    pub offset: Option<f64>,
    /// `clear`, `calibration`, `variation`, `predicted` or `single_cycle`.
    pub certainty: String,
    /// The same in words.
    #[serde(skip)]
    pub words: &'static str,
}

/// The answer to the question what changed.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ChangesSummary {
    /// Gait profile scores and gait deviation indices.
    pub scores: Vec<ChangeSummary>,
    /// The score of both sides after, without the changes that a calibration explains [deg].
    pub score_without_calibration: Option<f64>,
    /// Speed, cadence, step lengths.
    pub times: Vec<ChangeSummary>,
    /// The largest changes beyond the error of a calibration, at most three, the largest first.
    pub largest: Vec<ChangeSummary>,
    /// Changes that a calibration explains.
    pub calibration: Vec<ChangeSummary>,
    /// Number of curves that changed clearly, and of all that were compared.
    pub clear: [usize; 2],
}

/// `summary.json` of a session.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SessionSummary {
    /// Version of Ambulo.
    pub version: String,
    /// Identity of the run.
    pub run_id: String,
    /// Layout of the files ([`SESSION_FORMAT`]).
    pub session_format: u32,
    /// The person; `null` in an anonymous session.
    pub person: Option<String>,
    /// Age, if it is stated [years].
    pub age_years: Option<f64>,
    /// Days of the recordings, as YYYY-MM-DD; empty if they are not known, and in an anonymous session.
    pub recorded_on: Vec<String>,
    /// SHA-256 of the recordings, sorted.
    pub recordings: Vec<String>,
    /// Body mass [kg].
    pub mass_kg: Option<f64>,
    /// Stature [m], if it is known.
    pub height_m: Option<f64>,
    /// Hip to ground in standing [m].
    pub leg_length_m: Option<f64>,
    /// Gravity [m/s²].
    pub gravity_m_s2: Option<f64>,
    /// Where the body of all trials comes from.
    pub body: String,
    /// Convention of the angles of pelvis and hips.
    pub convention: Convention,
    /// Why it is not the chosen one.
    pub convention_reason: Option<String>,
    /// Walking speed over the trials [m/s].
    pub speed_m_s: Option<Spread>,
    /// V / √(g L) over the trials.
    pub speed_dimensionless: Option<Spread>,
    /// Every trial.
    pub trials: Vec<TrialSummary>,
    /// Recordings that are no trials, each with the reason.
    pub not_computed: BTreeMap<String, String>,
    /// Cycles that are in no mean.
    pub excluded: Vec<ExcludedSummary>,
    /// The most representative cycles.
    pub representative: Option<RepresentativeSummary>,
    /// Over the strides of the cycles that count.
    pub times_and_distances: WalkingSummary,
    /// External knee adduction moment over the stances of these cycles: `first_peak`, `second_peak`, `impulse`.
    #[serde(default)]
    pub knee_adduction_moment: Vec<QuantitySummary>,
    /// With muscles, what joints carry over the stances of these cycles: `first_peak`, `second_peak` and `impulse` of
    /// `hip`, `knee`, `ankle`, `knee_medial` and `knee_lateral`; empty without muscles.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub contact_loads: Vec<QuantitySummary>,
    /// The reference group of the session; `null` if there is none.
    pub(crate) reference: Option<ReferenceSummary>,
    /// Why it is not compared.
    pub no_reference: Option<String>,
    /// Movement analysis profile.
    pub profile: Option<ProfileSummary>,
    /// The earlier session that it is compared with: its days, or `an earlier session`.
    pub compared_with: Option<String>,
    /// Changes since then.
    #[serde(default)]
    pub changes: Option<ChangesSummary>,
    /// Warnings about the session as a whole.
    pub warnings: Vec<String>,
    /// SHA-256 of the other files.
    pub files: BTreeMap<String, String>,
}

impl SessionSummary {
    /// The days in words: `2026-11-03`, or `2026-11-03 and 2026-11-04`.
    #[must_use]
    pub fn days(&self) -> Option<String> {
        (!self.recorded_on.is_empty()).then(|| self.recorded_on.join(" and "))
    }
}
