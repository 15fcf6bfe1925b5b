//! A user's reference group: mean and standard deviation between healthy subjects, from one session each; written as
//! `norm.json`.
//!
//! Each subject counts once: the mean of the mean curves of both sides. Moments, powers and ground forces come from
//! subjects with measured forces, if there are at least two, otherwise from predicted forces.
//!
//! ```text
//! { "format": "ambulo-reference-group", "version": 1, "persons": 12, "ages_years": [8, 14], "speed_m_s": [1.1, 1.4],
//!   "convention": "clinical",
//!   "curves": { "knee_flexion_angle": { "unit": "deg", "persons": 12, "forces": null, "mean": [101], "sd": [101] } },
//!   "times": { "cadence": { "mean": 118, "sd": 7, "n": 12 } } }
//! ```

use super::Session;
use super::quantities::all;
use super::summary::Spread;
use ambulo::analysis::CYCLE_SAMPLES;
use ambulo::model::Side;
use ambulo::numerics::elementary::ln;
use ambulo::numerics::mean;
use ambulo::study::session::{
    CurveStatistics, CycleForces, NormalCurve, PooledCurve, depends_on_forces, pooled, profile,
};
use ambulo_results::{Convention, EXPECTED, is_sound};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The word by which the file is recognised.
const FORMAT: &str = "ambulo-reference-group";
const VERSION: u32 = 1;
/// A standard deviation needs two subjects.
const FEWEST: usize = 2;
/// Subjects from whom mean and standard deviation of the scores are known well enough for a gait deviation index.
const FEWEST_OF_INDEX: usize = 30;

/// Mean and standard deviation between subjects.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReferenceGroup {
    format: String,
    version: u32,
    /// Number of subjects.
    pub persons: usize,
    /// Youngest and oldest [years]; `null` unless the age of everybody is stated.
    pub ages_years: Option<[f64; 2]>,
    /// Lowest and highest mean speed of a person [m/s].
    pub speed_m_s: Option<[f64; 2]>,
    /// Speeds over √(g L).
    pub speed_dimensionless: Option<[f64; 2]>,
    /// Convention of the angles of pelvis and hips.
    pub convention: Convention,
    /// Curves over the gait cycle by quantity.
    pub(crate) curves: BTreeMap<String, GroupCurve>,
    /// Times and distances by quantity, in the units of `times_and_distances.csv`.
    pub times: BTreeMap<String, Spread>,
    /// Natural logarithm of the gait profile scores [deg] of the subjects, for the gait deviation index; `null` unless
    /// two subjects have all nine angles.
    #[serde(default)]
    pub log_scores: Option<Spread>,
}

/// A quantity of a group.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct GroupCurve {
    /// Unit.
    pub unit: String,
    /// Number of subjects.
    pub persons: usize,
    /// `measured` or `predicted`; `null` for angles.
    pub forces: Option<String>,
    /// Mean at 0, 1, ... 100 % of the cycle.
    pub mean: Vec<f64>,
    /// Standard deviation between subjects.
    pub sd: Vec<f64>,
}

/// Why there is no group.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ReferenceGroupError {
    /// Too few subjects.
    #[error(
        "found {found} persons with cycles; expected at least {FEWEST}, because a standard deviation is computed \
         between them"
    )]
    TooFew {
        /// Their number.
        found: usize,
    },
    /// Subjects whose angles have different conventions.
    #[error(
        "the angles of some persons have the clinical convention, those of others that of OpenSim; expected one \
         convention"
    )]
    Conventions,
    /// A file that is none.
    #[error("{0}")]
    File(String),
}

impl ReferenceGroup {
    /// From the sessions of several subjects; sessions without cycles are left out.
    ///
    /// # Errors
    /// Fewer than two subjects, or different conventions.
    pub fn of(sessions: &[Session]) -> Result<ReferenceGroup, ReferenceGroupError> {
        let people: Vec<&Session> =
            sessions.iter().filter(|session| session.cycles.iter().any(|cycle| cycle.excluded.is_none())).collect();
        if people.len() < FEWEST {
            return Err(ReferenceGroupError::TooFew { found: people.len() });
        }
        let convention = people[0].summary.convention;
        if people.iter().any(|person| person.summary.convention != convention) {
            return Err(ReferenceGroupError::Conventions);
        }
        let curves = all().filter_map(|quantity| {
            let curve = group_curve(&people, quantity.id, quantity.wording().unit)?;
            Some((quantity.id.to_owned(), curve))
        });
        let curves: BTreeMap<String, GroupCurve> = curves.collect();
        let ages: Option<Vec<f64>> = people.iter().map(|person| person.summary.age_years).collect();
        let speeds = |of: fn(&Session) -> Option<Spread>| {
            range(&people.iter().filter_map(|person| Some(of(person)?.mean)).collect::<Vec<_>>())
        };
        Ok(ReferenceGroup {
            format: FORMAT.to_owned(),
            version: VERSION,
            persons: people.len(),
            ages_years: ages.and_then(|ages| range(&ages)),
            speed_m_s: speeds(|session| session.summary.speed_m_s),
            speed_dimensionless: speeds(|session| session.summary.speed_dimensionless),
            convention,
            times: group_times(&people),
            log_scores: log_scores(&people, &curves),
            curves,
        })
    }

    /// Reads the content of a file.
    ///
    /// # Errors
    /// Another kind of file, another version, curves of another length, numbers that are not finite.
    pub fn from_json(bytes: &[u8]) -> Result<ReferenceGroup, ReferenceGroupError> {
        #[derive(Deserialize)]
        struct Head {
            format: Option<String>,
            version: Option<u32>,
        }
        let refused = |what: String| ReferenceGroupError::File(what);
        let expected = format!("expected a reference group as `norm.json` of a session: `\"format\": \"{FORMAT}\"`");
        let head: Head = serde_json::from_slice(bytes).map_err(|error| refused(format!("{error}; {expected}")))?;
        if head.format.as_deref() != Some(FORMAT) {
            return Err(refused(format!("found no reference group; {expected}")));
        }
        if head.version != Some(VERSION) {
            let found = head.version.map_or("none".to_owned(), |version| version.to_string());
            return Err(refused(format!(
                "found version {found} of the file; this version of Ambulo reads version {VERSION}"
            )));
        }
        let group: ReferenceGroup = serde_json::from_slice(bytes).map_err(|error| refused(error.to_string()))?;
        group.check().map_err(refused)?;
        Ok(group)
    }

    fn check(&self) -> Result<(), String> {
        if self.persons < FEWEST {
            return Err(format!("found `persons` {}; expected at least {FEWEST}", self.persons));
        }
        for (name, curve) in &self.curves {
            let lengths = [curve.mean.len(), curve.sd.len()];
            if lengths != [CYCLE_SAMPLES; 2] {
                return Err(format!("`{name}`: found {lengths:?} numbers; expected {CYCLE_SAMPLES} of mean and sd"));
            }
            if let Some(bad) = curve.mean.iter().chain(&curve.sd).find(|x| !is_sound(**x)) {
                return Err(format!("`{name}`: found {bad}; expected {EXPECTED}"));
            }
            if let Some(bad) = curve.sd.iter().find(|sd| **sd < 0.0) {
                return Err(format!("`{name}`: found the standard deviation {bad}; expected at least 0"));
            }
        }
        Ok(())
    }

    /// The content of `norm.json`.
    ///
    /// # Errors
    /// None for a group that was computed or read.
    pub fn to_json(&self) -> Result<Vec<u8>, serde_json::Error> {
        let mut bytes = serde_json::to_vec_pretty(self)?;
        bytes.push(b'\n');
        Ok(bytes)
    }

    /// The curve of a quantity.
    pub(crate) fn curve(&self, quantity: &str) -> Option<NormalCurve> {
        self.curves.get(quantity).map(GroupCurve::normal)
    }

    /// Mean and standard deviation of the logarithms of the scores, or why there is no gait deviation index.
    pub(crate) fn index_scale(&self) -> Result<[f64; 2], String> {
        let found = self.log_scores.map_or(0, |scores| scores.n);
        match self.log_scores.and_then(|scores| Some([scores.mean, scores.sd?])) {
            Some(scale) if found >= FEWEST_OF_INDEX => Ok(scale),
            _ => Err(format!(
                "it needs a reference group of at least {FEWEST_OF_INDEX} people with all nine angles; this one has \
                 {found}"
            )),
        }
    }

    /// `Mean ± 1 SD of an own group of 12 people, 8 to 14 years old, at 1.10 to 1.40 m/s.`
    pub(crate) fn words(&self) -> String {
        let ages = self
            .ages_years
            .map_or(", of unstated age".to_owned(), |[youngest, oldest]| format!(", {youngest} to {oldest} years old"));
        let speeds = self.speed_m_s.map_or(String::new(), |[low, high]| format!(", at {low:.2} to {high:.2} m/s"));
        format!("Mean ± 1 SD of an own group of {} people{ages}{speeds}.", self.persons)
    }
}

impl GroupCurve {
    fn normal(&self) -> NormalCurve {
        NormalCurve { mean: self.mean.clone(), sd: self.sd.clone() }
    }
}

/// ln GPS over the subjects, each with the mean of both sides.
fn log_scores(people: &[&Session], curves: &BTreeMap<String, GroupCurve>) -> Option<Spread> {
    let of_person = |person: &&Session| {
        let sides = profile(&person.cycles, |quantity| curves.get(quantity).map(GroupCurve::normal)).sides;
        let scores: Vec<f64> = [sides.right, sides.left].into_iter().flatten().map(|score| ln(score.mean)).collect();
        (!scores.is_empty()).then(|| mean(&scores))
    };
    Spread::of(&people.iter().filter_map(of_person).collect::<Vec<_>>())
}

/// Lowest and highest.
fn range(values: &[f64]) -> Option<[f64; 2]> {
    let low = values.iter().copied().min_by(f64::total_cmp)?;
    Some([low, values.iter().copied().max_by(f64::total_cmp)?])
}

/// The mean of both sides of a person, as far as they have the same source of forces.
fn of_person(session: &Session, quantity: &str, source: Option<CycleForces>) -> Option<Vec<f64>> {
    let sides = Side::BOTH.map(|side| pooled(&session.cycles, quantity, side));
    let own: Vec<&PooledCurve> = sides.iter().flatten().filter(|pooled| pooled.forces == source).collect();
    let means: Vec<&[f64]> = own.iter().map(|pooled| pooled.statistics.mean.as_slice()).collect();
    CurveStatistics::of(&means).map(|statistics| statistics.mean)
}

fn group_curve(people: &[&Session], quantity: &str, unit: &str) -> Option<GroupCurve> {
    let of_source = |source: Option<CycleForces>| {
        let curves: Vec<Vec<f64>> = people.iter().filter_map(|person| of_person(person, quantity, source)).collect();
        let statistics = CurveStatistics::of(&curves.iter().map(Vec::as_slice).collect::<Vec<_>>())?;
        Some(GroupCurve {
            unit: unit.to_owned(),
            persons: statistics.count,
            forces: source.map(|source| source.word().to_owned()),
            sd: statistics.sd?,
            mean: statistics.mean,
        })
    };
    if depends_on_forces(quantity) {
        return of_source(Some(CycleForces::Measured)).or_else(|| of_source(Some(CycleForces::Predicted)));
    }
    of_source(None)
}

/// Mean and standard deviation between subjects of the mean of both sides.
fn group_times(people: &[&Session]) -> BTreeMap<String, Spread> {
    let mut values: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for person in people {
        for found in &person.summary.times_and_distances.quantities {
            if let Some(both) = found.both {
                values.entry(found.quantity.clone()).or_default().push(both.mean);
            }
        }
    }
    values.into_iter().filter_map(|(name, values)| Some((name, Spread::of(&values)?))).collect()
}
