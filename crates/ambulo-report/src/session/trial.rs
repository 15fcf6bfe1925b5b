//! One computed trial of a session: its cycles in clinical signs, its strides, and the facts that decide whether its
//! cycles count.

use super::quantities::{FOOT_PROGRESSION, all};
use super::summary::TrialWarning;
use super::walk_strip::walk_strip;
use crate::clinical::{ClinicalGroup, ClinicalQuantity};
use crate::clinical_file::{Curves, angles_of};
use crate::normative::dimensionless_speed;
use ambulo::analysis::{Analysis, Cycle, Stride, foot_progression, over_cycle};
use ambulo::findings::Findings;
use ambulo::model::Side;
use ambulo::study::session::{CycleForces, SessionCycle, TrialFacts};
use ambulo::study::{Outcome, PredictedGround, QualityState};
use ambulo_results::{Convention, ConventionSummary, contact_rows};
use std::collections::BTreeMap;

/// A measured stance belongs to a cycle if both its ends differ by less than this share of the cycle.
const SAME_STANCE: f64 = 0.1;

/// A trial of a session.
#[derive(Debug, Clone)]
pub struct SessionTrial {
    /// Name in tables.
    pub name: String,
    /// Day of the recording, as YYYY-MM-DD.
    pub recorded_on: Option<String>,
    /// Its own page, relative to that of the session.
    pub page: Option<String>,
    /// Result, or the reason why there is none.
    pub found: Result<ComputedTrial, String>,
}

/// Data that a session takes from a computed trial.
#[derive(Debug, Clone)]
pub struct ComputedTrial {
    pub(super) facts: TrialFacts,
    /// Cycles of the trial; none is excluded yet, and their trial number is 0.
    pub(super) cycles: Vec<SessionCycle>,
    pub(super) strides: Vec<Stride>,
    pub(super) speed_m_s: Option<f64>,
    pub(super) speed_dimensionless: Option<f64>,
    pub(super) mass_kg: f64,
    pub(super) height_m: Option<f64>,
    pub(super) leg_length_m: f64,
    pub(super) gravity_m_s2: f64,
    pub(super) quality: &'static str,
    /// Why the quality is not good; the worst first.
    pub(super) quality_reasons: Vec<String>,
    pub(super) verdict: &'static str,
    pub(super) convention: ConventionSummary,
    pub(super) warnings: Vec<TrialWarning>,
    /// The person over a cycle, as SVG.
    pub(super) strip: Option<String>,
}

impl ComputedTrial {
    /// Takes the cycles of an outcome whose ground forces were predicted, with measured forces where plates measured
    /// the whole stance of the cycle. Angles of pelvis and hips follow the chosen convention, where it is
    /// possible.
    #[must_use]
    pub fn of(outcome: &Outcome, chosen: Convention, findings: &Findings) -> ComputedTrial {
        let Outcome { body, person, analysis, quality, verdict, times_and_distances, activity, .. } = outcome;
        let gravity_m_s2 = body.gravity().norm();
        let (angles, convention) = angles_of(outcome, chosen);
        // All trials of a session have one body, and their forces one mass.
        let unmeasured = &outcome.not_measured;
        let moving = Curves::of(body, analysis, angles.as_ref())
            .without(unmeasured)
            .with_knees(outcome.knee_angles())
            .per_mass(body.mass());
        let measured = outcome.prediction.as_ref().and_then(|found| found.measured.as_ref());
        let on_plates = measured
            .map(|measured| (measured, Curves::of(body, measured, None).without(unmeasured).per_mass(body.mass())));
        let progression = foot_progression(body, &person.soles, analysis);
        let mut reader = CurveReader { values: BTreeMap::new() };
        let cycles = analysis.cycles.iter().zip(progression).map(|(cycle, progression)| {
            let forces = forces_of(outcome, cycle);
            let source = match (&on_plates, forces) {
                (Some((measured, curves)), CycleForces::Measured) => (*measured, curves),
                _ => (analysis, &moving),
            };
            let mut curves = reader.of_cycle(cycle, (analysis, &moving), source, forces);
            let in_degrees = |angles: Vec<f64>| angles.into_iter().map(f64::to_degrees).collect();
            let progression = progression.filter(|_| !is_foot_unmeasured(outcome, cycle.side));
            curves.extend(progression.map(|angles| (FOOT_PROGRESSION.to_owned(), in_degrees(angles))));
            curves.extend(contact_curves(outcome, cycle, forces));
            session_cycle(cycle, forces, curves)
        });
        let cycles: Vec<SessionCycle> = cycles.collect();
        let speed_m_s = analysis.speed_m_s;
        let bad_data = quality.reasons.iter().find(|reason| reason.state == QualityState::Bad);
        ComputedTrial {
            facts: TrialFacts {
                bad_data: bad_data.map(|reason| reason.message.clone()),
                activity: activity.kind,
                turn: times_and_distances.turn,
            },
            cycles,
            strides: times_and_distances.strides.clone(),
            speed_m_s,
            speed_dimensionless: speed_m_s
                .and_then(|speed| dimensionless_speed(speed, gravity_m_s2, person.leg_length_m)),
            mass_kg: body.mass(),
            height_m: outcome.height_m(),
            leg_length_m: person.leg_length_m,
            gravity_m_s2,
            quality: quality.state.word(),
            quality_reasons: quality.reasons.iter().map(|reason| reason.message.clone()).collect(),
            verdict: verdict.state.words(),
            convention,
            warnings: TrialWarning::of(findings),
            strip: walk_strip(outcome),
        }
    }
}

/// Loads of the joints of the leg over a cycle, from the forces that its other curves are from.
fn contact_curves(outcome: &Outcome, cycle: &Cycle, forces: CycleForces) -> Vec<(String, Vec<f64>)> {
    let of_source = outcome.muscles.as_ref().and_then(|muscles| match forces {
        CycleForces::None => None,
        CycleForces::Predicted => Some((&outcome.analysis, &muscles.loads)),
        CycleForces::Measured => outcome.prediction.as_ref()?.measured.as_ref().zip(muscles.measured_loads.as_ref()),
    });
    let Some((analysis, loads)) = of_source else { return Vec::new() };
    let rows = contact_rows(&outcome.body, analysis, loads, cycle);
    rows.into_iter().map(|row| (row.quantity, row.values)).collect()
}

/// Whether the direction of a foot is unknown, because a joint of its leg is not measured.
fn is_foot_unmeasured(outcome: &Outcome, side: Side) -> bool {
    let anatomy = outcome.body.anatomy();
    outcome.not_measured.iter().any(|id| anatomy.coordinate_side(*id) == Some(side))
}

fn session_cycle(cycle: &Cycle, forces: CycleForces, curves: BTreeMap<String, Vec<f64>>) -> SessionCycle {
    let duration = cycle.end_s - cycle.start_s;
    SessionCycle {
        trial: 0,
        side: cycle.side,
        number: cycle.number,
        span_s: [cycle.start_s, cycle.end_s],
        foot_off_percent: cycle.foot_off_s.map(|off| 100.0 * (off - cycle.start_s) / duration),
        forces,
        excluded: None,
        curves,
    }
}

/// Measured if plates measured the whole stance of the cycle, otherwise predicted, if there is a prediction.
fn forces_of(outcome: &Outcome, cycle: &Cycle) -> CycleForces {
    let Some(PredictedGround { measured, coverage, .. }) = &outcome.prediction else { return CycleForces::None };
    let near = SAME_STANCE * (cycle.end_s - cycle.start_s);
    let is_own = |(side, [strike, off]): &(Side, [f64; 2])| {
        let same_off = cycle.foot_off_s.is_some_and(|found| (found - off).abs() < near);
        *side == cycle.side && (cycle.start_s - strike).abs() < near && same_off
    };
    let covered = coverage.as_ref().is_some_and(|coverage| coverage.stances.iter().any(is_own));
    if covered && measured.is_some() { CycleForces::Measured } else { CycleForces::Predicted }
}

/// Curves over the frames, each computed once.
struct CurveReader {
    values: BTreeMap<(&'static str, Side, bool), Option<Vec<f64>>>,
}

impl CurveReader {
    /// The curves of a cycle: angles of the motion, and what depends on forces from their source.
    fn of_cycle(
        &mut self,
        cycle: &Cycle,
        motion: (&Analysis, &Curves<'_>),
        source: (&Analysis, &Curves<'_>),
        forces: CycleForces,
    ) -> BTreeMap<String, Vec<f64>> {
        let mut found = BTreeMap::new();
        for quantity in motion.1.quantities().iter().chain(&source.1.quantities()) {
            let is_angle = quantity.group == ClinicalGroup::Kinematics;
            let is_wanted = all().any(|known| known.id == quantity.id) && !found.contains_key(quantity.id);
            if !is_wanted || !is_angle && forces == CycleForces::None {
                continue;
            }
            let (analysis, curves) = if is_angle { motion } else { source };
            let is_measured = !is_angle && forces == CycleForces::Measured;
            if let Some(values) = self.values(quantity, cycle.side, is_measured, curves) {
                let curve = over_cycle(analysis.trajectory.grid(), values, cycle);
                // Markers that were lost leave gaps in the angles of knees.
                if curve.iter().all(|value| value.is_finite()) {
                    found.insert(quantity.id.to_owned(), curve);
                }
            }
        }
        found
    }

    fn values(
        &mut self,
        quantity: &ClinicalQuantity,
        side: Side,
        is_measured: bool,
        curves: &Curves<'_>,
    ) -> Option<&Vec<f64>> {
        let key = (quantity.id, side, is_measured);
        self.values.entry(key).or_insert_with(|| curves.values(quantity, side)).as_ref()
    }
}
