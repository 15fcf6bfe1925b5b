//! A session of one person: trials pooled, compared with healthy subjects and with an earlier session, as tables and as
//! a page.
//!
//! | file | content |
//! |---|---|
//! | `session.html` | the page |
//! | `summary.json` | [`SessionSummary`] |
//! | `cycles.csv` | every curve of every cycle |
//! | `times_and_distances.csv` | means over the strides that count, with normal ranges |
//! | `deviations.csv` | every quantity against the reference group |
//! | `trials.csv` | every trial |
//! | `differences.csv` | before and after, where an earlier session was given |
//!
//! Equations and rules: `ambulo::study::session`. Columns: docs/SESSION.md.

mod answer;
mod differences;
mod norms;
mod page;
pub(crate) mod quantities;
mod reference_group;
mod stance_loads;
mod summary;
mod tables;
mod trial;
mod walk_strip;

pub use reference_group::{ReferenceGroup, ReferenceGroupError};
pub use summary::{
    ChangeSummary, ChangesSummary, ExcludedSummary, ProfileSummary, RepresentativeSummary, SESSION_FORMAT,
    SessionSummary, Spread, TrialSummary, TrialWarning,
};
pub(crate) use summary::{DeviationIndexSummary, VariableSummary};
pub use tables::session_from_files;
pub use trial::{ComputedTrial, SessionTrial};

/// Name of a score, a time, a distance or a curve, for people.
#[must_use]
pub fn session_quantity_label(quantity: &str) -> String {
    page::answer::label(quantity)
}

use differences::{Change, changes};
pub(crate) use norms::Norms;
pub(crate) use quantities::{ANGLES, CONTACT, KINETICS, SessionQuantity, all};

use crate::figures::FigureError;
use ambulo::analysis::activity::ActivityKind;
use ambulo::analysis::{Stride, TimesAndDistances};
use ambulo::model::{BySide, Side};
use ambulo::study::session::{
    CycleFacts, CycleForces, NormalCurve, PROFILE, Representative, SessionCycle, TrialFacts, VariableScore,
    deviation_index, exclusions, profile, representative,
};
use ambulo_results::{CYCLES, OutputFile, SESSION_PAGE, TIMES_AND_DISTANCES, WalkingSummary};

/// A session: its summary and its cycles.
#[derive(Debug, Clone, PartialEq)]
pub struct Session {
    /// Everything but the curves.
    pub summary: SessionSummary,
    /// Every whole cycle of every trial.
    pub cycles: Vec<SessionCycle>,
    /// The person over a cycle of the representative trial, as SVG; only of sessions that were computed now.
    pub figure: Option<String>,
}

/// Statements of the laboratory about a session.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SessionFacts {
    /// The person; `None` in an anonymous session.
    pub person: Option<String>,
    /// Age [years].
    pub age_years: Option<f64>,
    /// Where the body of all trials comes from.
    pub body: String,
}

/// Times of the same foot strike differ by less [s].
const SAME_INSTANT_S: f64 = 1e-6;

impl Session {
    /// Pools the cycles of trials that were computed with the same body.
    #[must_use]
    pub fn pooled(facts: SessionFacts, trials: &[SessionTrial]) -> Session {
        let computed: Vec<(usize, &ComputedTrial)> =
            trials.iter().enumerate().filter_map(|(k, trial)| Some((k, trial.found.as_ref().ok()?))).collect();
        let cycles = cycles(trials.len(), &computed);
        let mut session = Session { summary: head(facts, trials, &computed), cycles, figure: None };
        session.exclude_other_conventions(&computed);
        let counts = |trial: usize| session.cycles.iter().any(|cycle| cycle.trial == trial && cycle.excluded.is_none());
        let speeds = |of: fn(&ComputedTrial) -> Option<f64>| {
            let counted = computed.iter().filter(|(k, _)| counts(*k));
            Spread::of(&counted.filter_map(|(_, trial)| of(trial)).collect::<Vec<_>>())
        };
        session.summary.speed_m_s = speeds(|trial| trial.speed_m_s);
        session.summary.speed_dimensionless = speeds(|trial| trial.speed_dimensionless);
        session.summary.times_and_distances = session.times(&computed);
        session.summary.knee_adduction_moment = stance_loads::knee_adduction(&session);
        session.summary.contact_loads = stance_loads::contact_loads(&session);
        session.summary.trials = trials.iter().enumerate().map(|(k, trial)| session.trial_summary(k, trial)).collect();
        session.summary.excluded = session.excluded();
        session.summary.representative = session.representative_summary();
        let best = session.representative().trial;
        let shown = computed.iter().find(|(k, _)| best == Some(*k)).or(computed.first());
        session.figure = shown.and_then(|(_, trial)| trial.strip.clone());
        session
    }

    /// Whether any cycle counts.
    #[must_use]
    pub fn has_cycles(&self) -> bool {
        self.cycles.iter().any(|cycle| cycle.excluded.is_none())
    }

    /// Compares the session with an own reference group, or with children of the literature.
    #[must_use]
    pub fn compared_with_norm(mut self, group: Option<&ReferenceGroup>) -> ComparedSession {
        let norms = match group {
            _ if !self.walks() => {
                Norms::none("normal curves are those of straight walking, and no trial that counts is")
            }
            Some(group) => Norms::of_group(group, &self.summary),
            None => Norms::children(&self.summary),
        };
        self.summary.reference.clone_from(&norms.summary);
        self.summary.no_reference.clone_from(&norms.missing);
        self.summary.profile = norms.summary.is_some().then(|| self.profile(&norms));
        ComparedSession { session: self, norms, earlier: None, changes: Vec::new() }
    }

    /// Whether most trials are walks.
    fn walks(&self) -> bool {
        let counted = self.summary.trials.iter().filter(|trial| trial.counted.iter().any(|count| *count > 0));
        counted.clone().count() > 0
            && counted.clone().all(|trial| trial.activity.as_deref() == Some(ActivityKind::Walk.words()))
    }

    /// The most representative trial and cycles.
    fn representative(&self) -> Representative {
        representative(&self.cycles)
    }

    fn name(&self, trial: usize) -> &str {
        self.summary.trials.get(trial).map_or("", |trial| trial.trial.as_str())
    }

    /// Trials whose angles have another convention than the first are in no mean.
    fn exclude_other_conventions(&mut self, computed: &[(usize, &ComputedTrial)]) {
        for (k, trial) in computed.iter().filter(|(_, trial)| trial.convention.used != self.summary.convention) {
            let reason = format!(
                "its angles of pelvis and hips have the {} convention, those of the session the {} convention",
                trial.convention.used.word(),
                self.summary.convention.word()
            );
            let own = self.cycles.iter_mut().filter(|cycle| cycle.trial == *k && cycle.excluded.is_none());
            own.for_each(|cycle| cycle.excluded = Some(reason.clone()));
        }
    }

    /// Times and distances of the strides whose cycles count.
    fn times(&self, computed: &[(usize, &ComputedTrial)]) -> WalkingSummary {
        let counts = |trial: usize, stride: &Stride| {
            let same = |cycle: &&SessionCycle| {
                let near = (cycle.span_s[0] - stride.start_s).abs() < SAME_INSTANT_S;
                cycle.trial == trial && cycle.side == stride.side && near
            };
            self.cycles.iter().find(same).is_some_and(|cycle| cycle.excluded.is_none())
        };
        let strides = computed.iter().flat_map(|(k, trial)| trial.strides.iter().filter(|stride| counts(*k, stride)));
        WalkingSummary::of(&TimesAndDistances {
            speed_m_s: self.summary.speed_m_s.map(|speed| speed.mean),
            strides: strides.copied().collect(),
            ..TimesAndDistances::default()
        })
    }

    fn trial_summary(&self, k: usize, trial: &SessionTrial) -> TrialSummary {
        let count = |is_counted: fn(&SessionCycle) -> bool| {
            Side::BOTH.map(|side| {
                let own = self.cycles.iter().filter(|cycle| cycle.trial == k && cycle.side == side);
                own.filter(|cycle| is_counted(cycle)).count()
            })
        };
        let named = TrialSummary {
            trial: trial.name.clone(),
            recorded_on: trial.recorded_on.clone(),
            ..TrialSummary::default()
        };
        match &trial.found {
            Err(error) => TrialSummary { error: Some(error.clone()), ..named },
            Ok(found) => TrialSummary {
                activity: Some(found.facts.activity.words().to_owned()),
                speed_m_s: found.speed_m_s,
                quality: Some(found.quality.to_owned()),
                quality_reasons: found.quality_reasons.clone(),
                verdict: Some(found.verdict.to_owned()),
                cycles: count(|_| true),
                counted: count(|cycle| cycle.excluded.is_none()),
                measured: count(|cycle| cycle.excluded.is_none() && cycle.forces == CycleForces::Measured),
                warnings: found.warnings.clone(),
                page: trial.page.clone(),
                ..named
            },
        }
    }

    fn excluded(&self) -> Vec<ExcludedSummary> {
        let excluded = self.cycles.iter().filter_map(|cycle| Some((cycle, cycle.excluded.as_ref()?)));
        let row = |(cycle, reason): (&SessionCycle, &String)| ExcludedSummary {
            trial: self.name(cycle.trial).to_owned(),
            side: cycle.side.letter().to_owned(),
            cycle: cycle.number,
            reason: reason.clone(),
        };
        excluded.map(row).collect()
    }

    fn representative_summary(&self) -> Option<RepresentativeSummary> {
        let found = self.representative();
        let named = |cycle: Option<usize>| {
            let cycle = &self.cycles[cycle?];
            Some((self.name(cycle.trial).to_owned(), cycle.number))
        };
        let BySide { right, left } = found.cycles.map(named);
        (right.is_some() || left.is_some()).then(|| RepresentativeSummary {
            trial: found.trial.map(|trial| self.name(trial).to_owned()),
            right,
            left,
        })
    }

    fn profile(&self, norms: &Norms) -> ProfileSummary {
        profile_summary(&self.cycles, norms)
    }
}

/// Scores of cycles.
fn profile_summary(cycles: &[SessionCycle], norms: &Norms) -> ProfileSummary {
    let found = profile(cycles, |quantity| norms.curve(quantity).cloned());
    let variables = PROFILE.iter().enumerate().map(|(q, quantity)| VariableSummary {
        quantity: (*quantity).to_owned(),
        right: found.variables[q].right.map(Spread::from),
        left: found.variables[q].left.map(Spread::from),
        expected: found.expected[q],
    });
    let scale = norms.index_scale.as_ref();
    let index = |score: Option<f64>| Some(deviation_index(score?, *scale?.as_ref().ok()?));
    let mean = |side: Option<VariableScore>| side.map(|score| score.mean);
    ProfileSummary {
        right: found.sides.right.map(Spread::from),
        left: found.sides.left.map(Spread::from),
        overall: found.overall,
        expected: found.expected_overall,
        variables: variables.collect(),
        deviation_index: scale.filter(|scale| scale.is_ok()).map(|_| DeviationIndexSummary {
            right: index(mean(found.sides.right)),
            left: index(mean(found.sides.left)),
            overall: index(found.overall),
        }),
        no_deviation_index: scale.and_then(|scale| scale.clone().err()),
    }
}

/// The cycles of all trials, with what excludes them.
fn cycles(trials: usize, computed: &[(usize, &ComputedTrial)]) -> Vec<SessionCycle> {
    let of_trial = |(k, trial): &(usize, &ComputedTrial)| {
        let trial_index = *k;
        trial.cycles.iter().cloned().map(move |cycle| SessionCycle { trial: trial_index, ..cycle }).collect::<Vec<_>>()
    };
    let mut cycles: Vec<SessionCycle> = computed.iter().flat_map(of_trial).collect();
    // A trial without results has no cycles; it counts as none in the vote on the activity.
    let missing = || TrialFacts { bad_data: Some(String::new()), activity: ActivityKind::Other, turn: None };
    let mut facts: Vec<TrialFacts> = (0..trials).map(|_| missing()).collect();
    computed.iter().for_each(|(k, trial)| facts[*k] = trial.facts.clone());
    let of_cycles: Vec<CycleFacts> = cycles.iter().map(CycleFacts::of).collect();
    for (cycle, reason) in cycles.iter_mut().zip(exclusions(&facts, &of_cycles)) {
        cycle.excluded = reason.map(|reason| reason.to_string());
    }
    cycles
}

/// Data before the cycles are pooled.
fn head(facts: SessionFacts, trials: &[SessionTrial], computed: &[(usize, &ComputedTrial)]) -> SessionSummary {
    let first = computed.first().map(|(_, trial)| *trial);
    let mut recorded_on: Vec<String> = trials.iter().filter_map(|trial| trial.recorded_on.clone()).collect();
    recorded_on.sort();
    recorded_on.dedup();
    SessionSummary {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        session_format: SESSION_FORMAT,
        person: facts.person,
        age_years: facts.age_years,
        recorded_on,
        body: facts.body,
        mass_kg: first.map(|trial| trial.mass_kg),
        height_m: first.and_then(|trial| trial.height_m),
        leg_length_m: first.map(|trial| trial.leg_length_m),
        gravity_m_s2: first.map(|trial| trial.gravity_m_s2),
        convention: first.map(|trial| trial.convention.used).unwrap_or_default(),
        convention_reason: first.and_then(|trial| trial.convention.reason.clone()),
        ..SessionSummary::default()
    }
}

/// A session with its reference group and, where there is one, an earlier session.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparedSession {
    /// The session.
    pub session: Session,
    norms: Norms,
    earlier: Option<Session>,
    changes: Vec<Change>,
}

/// A mass that differs by more than this share may belong to another person.
const OTHER_MASS: f64 = 0.2;

impl ComparedSession {
    /// Also shows what changed since an earlier session.
    #[must_use]
    pub fn since(mut self, mut earlier: Session, group: Option<&ReferenceGroup>) -> ComparedSession {
        let words = earlier.summary.days().unwrap_or_else(|| "an earlier session".to_owned());
        self.session.summary.compared_with = Some(words);
        if earlier.summary.convention != self.session.summary.convention {
            self.session.summary.warnings.push(format!(
                "the angles of pelvis and hips have the {} convention, those of the earlier session the {} convention: \
                 their differences are no changes of the person",
                self.session.summary.convention.word(),
                earlier.summary.convention.word()
            ));
        }
        let masses = self.session.summary.mass_kg.zip(earlier.summary.mass_kg);
        if let Some((now_kg, then_kg)) = masses.filter(|(now, then)| (now - then).abs() > OTHER_MASS * then) {
            self.session.summary.warnings.push(format!(
                "the body mass is {now_kg:.1} kg, that of the earlier session {then_kg:.1} kg: if it is not the same \
                 person, the differences are not those of two visits"
            ));
        }
        // Each session has the norms of its own speed, so that its scores are those of its own page.
        let norms =
            group.map_or_else(|| Norms::children(&earlier.summary), |group| Norms::of_group(group, &earlier.summary));
        earlier.summary.profile = self.session.summary.profile.as_ref().map(|_| earlier.profile(&norms));
        self.changes = changes(&self.session, &earlier, &self.norms);
        self.session.summary.changes = Some(answer::answer(&self, &earlier));
        ComparedSession { earlier: Some(earlier), ..self }
    }

    /// All files but the summary.
    ///
    /// # Errors
    /// A style that cannot be read.
    pub fn files(&self) -> Result<Vec<OutputFile<'static>>, FigureError> {
        let mut files = vec![
            OutputFile::new(TIMES_AND_DISTANCES, tables::times_csv(self).into_bytes()),
            OutputFile::new("deviations.csv", tables::deviations_csv(self).into_bytes()),
            OutputFile::new("trials.csv", tables::trials_csv(&self.session).into_bytes()),
        ];
        if let Some(earlier) = &self.earlier {
            let text = differences::differences_csv(self, earlier);
            files.push(OutputFile::new("differences.csv", text.into_bytes()));
        }
        let page = page::page(self, &files)?;
        files.push(OutputFile::new(CYCLES, tables::cycles_csv(&self.session).into_bytes()));
        files.push(OutputFile::new(SESSION_PAGE, page.into_bytes()));
        Ok(files)
    }

    fn norm(&self, quantity: &str) -> Option<&NormalCurve> {
        self.norms.curve(quantity)
    }

    /// The quantities that change in at least one cycle.
    fn shown(&self) -> Vec<SessionQuantity> {
        let moves = |quantity: &SessionQuantity| {
            let curves = self.session.cycles.iter().filter_map(|cycle| cycle.curves.get(quantity.id));
            curves.into_iter().any(|curve| crate::clinical::moves(quantity.wording().unit, curve))
        };
        all().filter(moves).collect()
    }
}
