//! Predicted walks: they minimise muscle effort. No recorded curve is a target.
//!
//! From recordings come speed and cadence, the instants at which the feet must be clear of the ground, and the start of
//! the solver: the walk near normative curves, whose weight falls to zero stage by stage.
//!
//! The costs are the costs of `muscles`, and the rates of joint moments.

use super::conditions::{Device, WalkConditions};
use super::error::OptimalWalkError;
use super::muscles::{EffortCosts, MuscleTerms, WORK_PRICES, ahead_of};
use super::near::{NEAR_STAGES, longer};
use super::objective::{Bound, Quantity, Term};
use super::solution::Solution;
use super::walk::WalkProblem;
use crate::dynamics::CurvedJointError;
use crate::gait::Walk;
use crate::model::anthropometry::{Human, SpherePart};
use crate::model::{CoordinateId, Side};
use std::ops::Range;

/// Weights of the normative curves one after the other, each with the part of [`NEAR_STAGES`] that is solved with it.
/// The last weight alone needs the accuracy of the last stages.
const PEOPLE: [(f64, Range<usize>); 3] = [(0.1, 0..3), (0.01, 1..3), (0.0, 1..5)];
/// Steeper slopes are reached in steps of this size.
const SLOPE_STEP: f64 = 0.08;

/// A walk that was predicted.
#[derive(Debug, Clone)]
pub struct Prediction {
    /// The problem without normative targets.
    pub problem: WalkProblem,
    /// Solution of the problem.
    pub solution: Solution,
}

impl WalkProblem {
    /// Predicts the walk of a figure under some conditions, starting from a walk near normative curves: `unknowns`
    /// solve this problem.
    ///
    /// `human` is the figure of this problem; the conditions change it. Check [`Solution::unbalanced`] and
    /// [`Solution::overload`].
    ///
    /// # Errors
    /// As [`WalkProblem::solve`].
    pub fn predict(
        &self,
        human: &Human,
        walk: &Walk,
        costs: &EffortCosts,
        conditions: &WalkConditions,
        unknowns: &[f64],
    ) -> Result<Prediction, OptimalWalkError> {
        let stages = longer(&NEAR_STAGES);
        let [(near, first), later @ ..] = PEOPLE;
        let mut unknowns = unknowns.to_vec();
        for slope in flatter_slopes(conditions.slope) {
            let flatter = WalkConditions { slope, ..conditions.clone() };
            let on_it = Human { model: human.model.on_slope(flatter.incline()), ..human.clone() };
            let problem = self.of_muscles(&on_it, walk, costs, &flatter, near);
            unknowns = problem.problem.solve(&unknowns, &stages[first.clone()])?.unknowns().to_vec();
        }
        let mut problem = self.of_muscles(human, walk, costs, conditions, near);
        let mut solution = problem.problem.solve(&unknowns, &stages[first])?;
        for (people, part) in later {
            problem = self.of_muscles(human, walk, costs, conditions, people);
            solution = problem.problem.solve(solution.unknowns(), &stages[part])?;
        }
        Ok(Prediction { problem, solution })
    }

    /// This problem with the costs of muscles, and with a weight of normative curves: 1 as they are, 0 without them.
    #[must_use]
    pub fn of_muscles(
        &self,
        human: &Human,
        walk: &Walk,
        costs: &EffortCosts,
        conditions: &WalkConditions,
        people: f64,
    ) -> WalkProblem {
        let mut next = self.clone();
        next.problem.model = human.model.clone();
        let mut muscles = MuscleTerms::new(human, costs, conditions, &next.problem, walk.cycle_s());
        muscles.keep(&self.problem.terms, people);
        muscles.joints();
        muscles.trunk();
        muscles.step_width();
        next.problem.terms = muscles.terms;
        next
    }
}

/// Slopes between the level and a steep slope, in equal steps.
pub fn flatter_slopes(slope: f64) -> impl Iterator<Item = f64> {
    let parts = (slope.abs() / SLOPE_STEP).ceil();
    (1..parts as usize).map(move |part| slope * part as f64 / parts)
}

/// Names of the terms of a walk for the motion of the feet and the start; they are no normative targets.
const KEPT: [&str; 2] = ["place", "clearance"];

impl MuscleTerms<'_> {
    /// Keeps the terms of feet, limits of joints and, with the weights of muscles, slip and rates of moments, and
    /// normative terms with their weight.
    fn keep(&mut self, terms: &[Term], people: f64) {
        for term in terms {
            let own = match term.quantity {
                Quantity::ForceRate(_) => Some(self.moment_rate()),
                Quantity::Slip { .. } => Some(self.costs.slip),
                _ => None,
            };
            let stays = KEPT.contains(&term.name.as_str()) || term.bound != Bound::Near;
            let of_people = (!stays && people > 0.0).then(|| term.deviation / people.sqrt());
            let deviation = own.or(stays.then_some(term.deviation)).or(of_people);
            self.terms.extend(deviation.map(|deviation| Term { deviation, ..term.clone() }));
        }
    }

    /// The heels of both feet keep half the width of a step from the path of the body.
    fn step_width(&mut self) {
        let Some(width) = self.conditions.step_width_m else { return };
        let cleared = |sphere: usize| {
            let is_it = |term: &&Term| term.name == "clearance" && term.quantity == Quantity::Height(sphere);
            self.problem.terms.iter().find(is_it).map(|term| term.targets.clone())
        };
        let heels = self.problem.soles.iter().enumerate().filter(|(_, sole)| sole.part == SpherePart::Heel);
        let half = |side: Side| if side == Side::Right { 0.5 * width } else { -0.5 * width };
        let mut terms = Vec::new();
        for (sphere, sole) in heels {
            let middle = self.problem.soles.iter().filter(|s| s.side == sole.side && s.part == SpherePart::Heel);
            let (sum, count) = middle.fold((0.0, 0.0), |(sum, count), s| (sum + s.center.z, count + 1.0));
            let target = half(sole.side) + sole.center.z - sum / count;
            let swing = cleared(sphere).unwrap_or_default();
            let stands = swing.iter().map(|swings| swings.is_none().then_some(target)).collect();
            let quantity = Quantity::Place(sphere, 2);
            terms.push(Term {
                name: "step width".to_owned(),
                quantity,
                targets: stands,
                deviation: 0.002,
                bound: Bound::Near,
            });
        }
        self.terms.extend(terms);
    }
}

/// Work of the devices at a joint, and work of the body at the same joint.
#[derive(Debug, Clone, PartialEq)]
pub struct DeviceEffort {
    /// The coordinate of the joint.
    pub coordinate: CoordinateId,
    /// Positive and negative work of the devices in a cycle [J/kg of the body without load].
    pub device_work: [f64; 2],
    /// The same of the rest of the joint moment, that of muscles and tissue.
    pub body_work: [f64; 2],
}

impl DeviceEffort {
    /// The work of the devices of a solved walk, and of the body at their joints, for a body of some mass [kg].
    ///
    /// # Errors
    /// Does not fail for a solved problem.
    pub fn of(
        solution: &Solution,
        walk: &Walk,
        body_mass: f64,
        devices: &[Device],
    ) -> Result<Vec<DeviceEffort>, CurvedJointError> {
        let step_s = walk.cycle_s() / POWER_INSTANTS as f64;
        let times: Vec<f64> = (0..POWER_INSTANTS).map(|k| step_s * k as f64).collect();
        let (samples, model) = (solution.samples(&times)?, &solution.problem().model);
        let of = |id: CoordinateId| {
            let mut effort = DeviceEffort { coordinate: id, device_work: [0.0; 2], body_work: [0.0; 2] };
            for sample in &samples {
                let (angle, rate) = (sample.posture[0][id.index()], sample.posture[1][id.index()]);
                let given =
                    moment_at(&model.coordinates()[id.index()].name, devices, sample.time_s, walk, [angle, rate]);
                let parts = [given, sample.forces[id.index()] - given];
                for (work, moment) in [&mut effort.device_work, &mut effort.body_work].into_iter().zip(parts) {
                    work[usize::from(moment * rate < 0.0)] += moment * rate * step_s / body_mass;
                }
            }
            effort
        };
        let is_worn = |id: &CoordinateId| {
            let name = &model.coordinates()[id.index()].name;
            devices.iter().any(|device| device.coordinate == *name)
        };
        Ok(model.coordinate_ids().filter(is_worn).map(of).collect())
    }
}

/// Moment of all devices at a coordinate at a time of a walk [N.m], at its angle [rad] and rate [rad/s].
pub(crate) fn moment_at(
    coordinate: &str,
    devices: &[Device],
    time_s: f64,
    walk: &Walk,
    [angle, rate]: [f64; 2],
) -> f64 {
    let share = time_s / walk.cycle_s() + ahead_of(coordinate);
    let own = devices.iter().filter(|device| device.coordinate == coordinate);
    own.map(|device| device.moment(share, angle, rate)).sum()
}

/// Metabolic power that does not depend on the motion [W/kg]; measured in standing (Ralston 1958; unverified).
const RESTING: f64 = 1.4;
/// Instants of a cycle at which power is computed.
const POWER_INSTANTS: usize = 400;

/// Metabolic power of a walk by a simple formula [W/kg of the body without a load]: positive joint work costs
/// [`WORK_PRICES`], negative work less, and 1.4 W/kg are always needed. Joint power is the power of the joint moments
/// without devices.
///
/// # Errors
/// Does not fail for a solved problem.
pub fn metabolic_power(
    solution: &Solution,
    walk: &Walk,
    body_mass: f64,
    devices: &[Device],
) -> Result<f64, CurvedJointError> {
    let times: Vec<f64> = (0..POWER_INSTANTS).map(|k| walk.cycle_s() * k as f64 / POWER_INSTANTS as f64).collect();
    let (problem, model) = (solution.problem(), &solution.problem().model);
    let root: Vec<CoordinateId> = problem.root().into_iter().map(|(id, _)| id).collect();
    let mut sum = 0.0;
    for sample in solution.samples(&times)? {
        for id in model.coordinate_ids().filter(|id| !root.contains(id)) {
            let name = &model.coordinates()[id.index()].name;
            let (angle, rate) = (sample.posture[0][id.index()], sample.posture[1][id.index()]);
            let moment = sample.forces[id.index()] - moment_at(name, devices, sample.time_s, walk, [angle, rate]);
            let power = moment * rate;
            sum += if power > 0.0 { WORK_PRICES[0] * power } else { -WORK_PRICES[1] * power };
        }
    }
    Ok(RESTING + sum / POWER_INSTANTS as f64 / body_mass)
}
