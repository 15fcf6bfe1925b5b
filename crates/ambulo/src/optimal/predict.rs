//! Walks that are predicted: muscles work as little and as smoothly as they can. No curve of people is a target.
//!
//! What remains of people are speed and cadence, the instants at which the feet must be clear of the ground, and the start of the solver: the
//! walk that follows people's curves. Their weight then falls to zero stage by stage.
//!
//! The largest costs are metabolic power by the efficiencies of muscles (Margaria 1968; unverified), 0.25 for positive and 1.2 for negative work, muscle
//! moments relative to strength, and the rates of joint moments. All costs are relative to the size of the body (mass m, leg length l,
//! gravity g), so that they mean the same for a child.

use super::conditions::{Device, WalkConditions};
use super::effort::{Effort, tissue_of};
use super::error::Overload;
use super::near::NEAR_STAGES;
use super::objective::{Bound, Quantity, Term};
use super::solution::Solution;
use super::solve::Continuation;
use super::walk::WalkProblem;
use crate::dynamics::CurvedJointError;
use crate::gait::Walk;
use crate::model::anthropometry::Human;
use crate::model::{CoordinateId, Movement, Side};

const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// Price of positive and negative mechanical work of muscles: the inverse of their efficiency.
pub const WORK_PRICES: [f64; 2] = [1.0 / 0.25, 1.0 / 1.2];

/// Costs of a predicted walk. Each is the deviation at which an instant costs 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EffortCosts {
    /// Metabolic power of all muscles [W/kg].
    pub power: f64,
    /// Muscle moment as a share of the muscles' strength.
    pub strength: f64,
    /// Rate of a joint moment [m g l √(g/l)].
    pub moment_rate: f64,
    /// Angular acceleration of a joint [g/l].
    pub acceleration: f64,
    /// Acceleration of the pelvis [g].
    pub pelvis: f64,
    /// Deviation of the trunk in the world from upright [rad], and its angular acceleration [g/l].
    pub trunk: [f64; 2],
    /// Angle of a shoulder, of an elbow, or of the rotation of a forearm from hanging arms [rad].
    pub arm: f64,
    /// Deviation of hip rotation and inversion of the foot from neutral [rad].
    pub twist: f64,
    /// Muscle moment above strength, as a share of strength.
    pub weakness: f64,
}

impl Default for EffortCosts {
    /// Set by hand on the walk of one man at free speed.
    fn default() -> EffortCosts {
        EffortCosts {
            power: 1.0,
            strength: 0.158,
            moment_rate: 0.09,
            acceleration: 9.4,
            pelvis: 0.5,
            trunk: [5.0 * DEGREE, 0.3],
            arm: 20.0 * DEGREE,
            twist: 8.0 * DEGREE,
            weakness: 0.02,
        }
    }
}

/// Stiffness of the toes [N.m/rad] and their damping [N.m.s/rad] in an adult. Falisse et al. 2022 (PLOS One 17:e0256311; unverified) have 25 N.m/rad.
const TOES: [f64; 2] = [25.0, 0.5];
/// Damping of shoulders and elbows in an adult [N.m.s/rad]: our choice.
const ARM_DAMPING: f64 = 0.3;
/// Body weight times stature of the adult of these laws [N.m].
const ADULT: f64 = 75.0 * 9.80665 * 1.75;
/// Mechanical power below which muscles cost more than their work [W/kg]: smooths the cost where the power changes its sign.
const SMOOTH: f64 = 0.067;
/// Weights of people's curves in the stages of a solution.
const PEOPLE: [f64; 3] = [0.1, 0.01, 0.0];
/// Steeper slopes are reached in steps of this size.
const SLOPE_STEP: f64 = 0.08;
/// Steps of the solver before an update, and factor of the gain below which a stage ends, as multiples of those near a known walk: the objective changes more.
const LONGER: (usize, f64) = (3, 0.3);

/// A walk that was predicted.
#[derive(Debug, Clone)]
pub struct Prediction {
    /// The problem without targets of people.
    pub problem: WalkProblem,
    /// Its solution.
    pub solution: Solution,
}

impl WalkProblem {
    /// Predicts the walk of a figure under some conditions, starting from a walk that follows people: `unknowns` solve this problem.
    ///
    /// `human` is the figure of this problem; the conditions change it. Check [`Solution::unbalanced`] and [`Prediction::overload`].
    ///
    /// # Errors
    /// If the figure has joints that are not hinges or slides.
    pub fn predict(
        &self,
        human: &Human,
        walk: &Walk,
        costs: &EffortCosts,
        conditions: &WalkConditions,
        unknowns: &[f64],
    ) -> Result<Prediction, CurvedJointError> {
        let stages: Vec<Continuation> = NEAR_STAGES
            .iter()
            .map(|stage| Continuation { steps: LONGER.0 * stage.steps, gain: LONGER.1 * stage.gain, ..*stage })
            .collect();
        let mut unknowns = unknowns.to_vec();
        let parts = (conditions.slope.abs() / SLOPE_STEP).ceil();
        for part in 1..parts as usize {
            let slope = conditions.slope * part as f64 / parts;
            let flatter = WalkConditions { slope, ..conditions.clone() };
            let on_it = Human { model: human.model.on_slope(flatter.incline()), ..human.clone() };
            let problem = self.of_muscles(&on_it, walk, costs, &flatter, PEOPLE[0]);
            unknowns = problem.problem.solve(&unknowns, &stages)?.unknowns().to_vec();
        }
        let mut problem = self.of_muscles(human, walk, costs, conditions, PEOPLE[0]);
        let mut solution = problem.problem.solve(&unknowns, &stages)?;
        for people in &PEOPLE[1..] {
            problem = self.of_muscles(human, walk, costs, conditions, *people);
            solution = problem.problem.solve(solution.unknowns(), &stages[1..])?;
        }
        Ok(Prediction { problem, solution })
    }

    /// This problem with the costs of muscles, and with a weight of people's curves: 1 as they are, 0 without them.
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
        let mut builder = Builder::new(human, walk, costs, conditions, &next);
        builder.keep(&self.problem.terms, people);
        builder.joints();
        builder.trunk();
        builder.step_width();
        next.problem.terms = builder.terms;
        next
    }
}

struct Builder<'a> {
    human: &'a Human,
    walk: &'a Walk,
    costs: &'a EffortCosts,
    conditions: &'a WalkConditions,
    problem: &'a WalkProblem,
    /// Unit of angular acceleration g/l [1/s²].
    turning: f64,
    terms: Vec<Term>,
}

/// Names of the terms of a walk that say how a foot moves and where the walk begins, not how people walk.
const KEPT: [&str; 3] = ["place", "clearance", "slip"];

/// Isometric strength of muscles, positive and negative moments of the movement, as shares of body weight times stature. Hip, knee and ankle: the
/// largest moments of Gait2392 near the postures of walking (feasibility/strength.csv); the others are our estimates.
fn strength_of(movement: Option<Movement>) -> [f64; 2] {
    match movement {
        Some(Movement::HipFlexion) => [0.157, 0.274],
        Some(Movement::KneeFlexion) => [0.122, 0.210],
        Some(Movement::AnkleDorsiflexion) => [0.0443, 0.186],
        Some(Movement::HipAdduction) => [0.192, 0.163],
        Some(Movement::HipRotation) => [0.058; 2],
        Some(Movement::SubtalarInversion) => [0.035; 2],
        Some(Movement::ToeExtension) => [0.0175; 2],
        Some(Movement::TrunkLean | Movement::TrunkObliquity | Movement::TrunkRotation) => [0.175; 2],
        _ => [0.047; 2],
    }
}

impl<'a> Builder<'a> {
    fn new(
        human: &'a Human,
        walk: &'a Walk,
        costs: &'a EffortCosts,
        conditions: &'a WalkConditions,
        problem: &'a WalkProblem,
    ) -> Builder<'a> {
        let turning = human.model.gravity().norm() / human.dimensions.leg_length;
        Builder { human, walk, costs, conditions, problem, turning, terms: Vec::new() }
    }

    fn constant(&self, value: f64) -> Vec<Option<f64>> {
        vec![Some(value); self.problem.problem.instants()]
    }

    fn add(&mut self, name: &str, quantity: Quantity, target: f64, deviation: f64, bound: Bound) {
        let targets = self.constant(target);
        self.terms.push(Term { name: name.to_owned(), quantity, targets, deviation, bound });
    }

    /// Keeps the terms of feet, limits of joints and rates of moments, and those of people with their weight.
    fn keep(&mut self, terms: &[Term], people: f64) {
        let size = self.human.build.mass * 9.80665 * self.human.dimensions.leg_length * self.turning.sqrt();
        for term in terms {
            let rate = matches!(term.quantity, Quantity::ForceRate(_)).then_some(self.costs.moment_rate * size);
            let stays = KEPT.contains(&term.name.as_str()) || term.bound == Bound::AtLeast;
            let of_people = (!stays && people > 0.0).then(|| term.deviation / people.sqrt());
            let deviation = rate.or(stays.then_some(term.deviation)).or(of_people);
            self.terms.extend(deviation.map(|deviation| Term { deviation, ..term.clone() }));
        }
    }

    fn joints(&mut self) {
        let model = &self.human.model;
        let root: Vec<CoordinateId> = self.problem.problem.root().into_iter().map(|(id, _)| id).collect();
        for id in model.coordinate_ids().filter(|id| !root.contains(id)) {
            let meaning = model.anatomy().meaning(id);
            let movement = meaning.map(|meaning| meaning.movement);
            let name = model.coordinates()[id.index()].name.clone();
            let effort = self.effort(id, &name, movement);
            self.muscles(&name, &effort, movement, meaning.map_or(1.0, |m| m.sign));
            let acceleration = self.costs.acceleration * self.turning;
            self.add(&name, Quantity::Acceleration(vec![(id, 1.0)]), 0.0, acceleration, Bound::Near);
            let posture = match movement {
                None => Some(self.costs.arm),
                Some(Movement::HipRotation | Movement::SubtalarInversion) => Some(self.costs.twist),
                Some(Movement::TrunkObliquity | Movement::TrunkRotation) => Some(self.costs.trunk[0]),
                _ => None,
            };
            if let Some(deviation) = posture {
                self.add(&name, Quantity::Position(vec![(id, 1.0)]), 0.0, deviation, Bound::Near);
            }
        }
        for movement in [Movement::PelvisForward, Movement::PelvisUp, Movement::PelvisRight] {
            if let Some((id, _)) = model.anatomy().coordinate(movement, None) {
                let deviation = self.costs.pelvis * model.gravity().norm();
                self.add("pelvis", Quantity::Acceleration(vec![(id, 1.0)]), 0.0, deviation, Bound::Near);
            }
        }
    }

    /// What the muscles of a joint do besides tissue and devices.
    fn effort(&self, id: CoordinateId, name: &str, movement: Option<Movement>) -> Effort {
        let model = &self.human.model;
        let size = self.human.build.mass * 9.80665 * self.human.build.height / ADULT;
        let mut effort = Effort::whole(id);
        match movement {
            Some(Movement::ToeExtension) => [effort.stiffness, effort.damping] = TOES.map(|value| value * size),
            None => effort.damping = ARM_DAMPING * size,
            _ => (),
        }
        let side = model.anatomy().meaning(id).and_then(|meaning| meaning.side);
        let mut constant = 0.0;
        if let (Some(movement), Some(side)) = (movement, side)
            && let Some((mut parts, rest)) = tissue_of(model.anatomy(), movement, side)
        {
            for part in &mut parts {
                part.scale *= size;
            }
            effort.tissue = parts;
            constant = rest * size;
        }
        let devices: Vec<&Device> = self.conditions.devices.iter().filter(|d| d.coordinate == name).collect();
        for device in &devices {
            effort.stiffness += device.stiffness;
            effort.damping += device.damping;
        }
        let ahead = ahead_of(name);
        let given = |share: &f64| {
            let place = share * self.problem.problem.duration_s / self.walk.cycle_s() + ahead;
            constant + devices.iter().map(|device| device.given(place)).sum::<f64>()
        };
        effort.given = self.problem.problem.shares().iter().map(given).collect();
        effort
    }

    fn muscles(&mut self, name: &str, effort: &Effort, movement: Option<Movement>, sign: f64) {
        let kg = self.human.build.mass;
        let prices = WORK_PRICES;
        let power = Quantity::RootPower { effort: effort.clone(), prices, smooth_w: SMOOTH * kg };
        self.add("power", power, 0.0, (self.costs.power * kg).sqrt(), Bound::Near);
        let [positive, negative] = self.strength(name, movement, sign);
        for (bound, strength, direction) in [(Bound::AtMost, positive, 1.0), (Bound::AtLeast, negative, -1.0)] {
            let quantity = || Quantity::Effort(effort.clone());
            self.add("effort", quantity(), 0.0, self.costs.strength * strength, bound);
            self.add(OVERLOAD, quantity(), direction * strength, self.costs.weakness * strength, bound);
        }
    }

    /// Strength of a coordinate in its positive and its negative direction [N.m].
    fn strength(&self, name: &str, movement: Option<Movement>, sign: f64) -> [f64; 2] {
        let size = self.human.build.mass * 9.80665 * self.human.build.height * self.conditions.strength(name);
        let [a, b] = strength_of(movement).map(|share| share * size);
        if sign > 0.0 { [a, b] } else { [b, a] }
    }

    /// The trunk stays upright in the world, not on the slope.
    fn trunk(&mut self) {
        let anatomy = self.human.model.anatomy();
        let [angle, acceleration] = self.costs.trunk;
        let upright = -self.conditions.incline();
        let pairs = [
            (Movement::PelvicTilt, Movement::TrunkLean, upright),
            (Movement::PelvicObliquity, Movement::TrunkObliquity, 0.0),
            (Movement::PelvicRotation, Movement::TrunkRotation, 0.0),
        ];
        let found = |movement| anatomy.coordinate(movement, None).map(|(id, _)| id);
        for (pelvis, trunk, target) in pairs {
            let (Some(pelvis), Some(trunk)) = (found(pelvis), found(trunk)) else { continue };
            let both = vec![(pelvis, 1.0), (trunk, 1.0)];
            self.add("trunk", Quantity::Position(both.clone()), target, angle, Bound::Near);
            self.add("trunk", Quantity::Acceleration(both), 0.0, acceleration * self.turning, Bound::Near);
        }
        if let Some(tilt) = found(Movement::PelvicTilt) {
            self.add("pelvis", Quantity::Position(vec![(tilt, 1.0)]), upright, angle, Bound::Near);
        }
    }

    /// The heels of both feet keep half the width of a step from the path of the body.
    fn step_width(&mut self) {
        let Some(width) = self.conditions.step_width_m else { return };
        let cleared = |sphere: usize| {
            let is_it = |term: &&Term| term.name == "clearance" && term.quantity == Quantity::Height(sphere);
            self.problem.problem.terms.iter().find(is_it).map(|term| term.targets.clone())
        };
        let heels = self.problem.problem.soles.iter().enumerate().filter(|(_, sole)| sole.name.starts_with("heel"));
        let half = |side: Side| if side == Side::Right { 0.5 * width } else { -0.5 * width };
        let mut terms = Vec::new();
        for (sphere, sole) in heels {
            let middle =
                self.problem.problem.soles.iter().filter(|s| s.side == sole.side && s.name.starts_with("heel"));
            let (sum, count) = middle.fold((0.0, 0.0), |(sum, count), s| (sum + s.center.z, count + 1.0));
            let target = half(sole.side) + sole.center.z - sum / count;
            let swing = cleared(sphere).unwrap_or_default();
            let stands = swing.iter().map(|swings| swings.is_none().then_some(target)).collect();
            let quantity = Quantity::Sideways(sphere);
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

/// Metabolic power that does not depend on the motion [W/kg]; of standing people (Ralston 1958; unverified).
const RESTING: f64 = 1.4;
/// Instants of a cycle at which power is computed.
const POWER_INSTANTS: usize = 400;

/// Metabolic power of a walk by a simple formula [W/kg of the body without a load]: positive joint work costs [`WORK_PRICES`], negative work
/// less, and 1.4 W/kg are always needed. Joint power is that of the joint moments without devices.
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
            let share = sample.time_s / walk.cycle_s() + ahead_of(name);
            let assisted = devices.iter().filter(|device| device.coordinate == *name);
            let moment = sample.forces[id.index()] - assisted.map(|d| d.moment(share, angle, rate)).sum::<f64>();
            let power = moment * rate;
            sum += if power > 0.0 { WORK_PRICES[0] * power } else { -WORK_PRICES[1] * power };
        }
    }
    Ok(RESTING + sum / POWER_INSTANTS as f64 / body_mass)
}

/// Share of the cycle by which the cycle of a coordinate's leg is ahead of that of the right leg.
fn ahead_of(name: &str) -> f64 {
    if Side::split_name(name).is_some_and(|(side, _)| side == Side::Left) { 0.5 } else { 0.0 }
}

/// Name of the terms for muscle moments above strength.
const OVERLOAD: &str = "overload";

impl Prediction {
    /// The largest muscle moment above the strength of its joint, if it exceeds it by more than the share `more`.
    #[must_use]
    pub fn overload(&self, more: f64) -> Option<Overload> {
        let problem = &self.problem.problem;
        let model = &problem.model;
        let step_s = problem.duration_s / (problem.instants() - 1) as f64;
        let mut worst: Option<(f64, Overload)> = None;
        for term in problem.terms.iter().filter(|term| term.name == OVERLOAD) {
            let Quantity::Effort(effort) = &term.quantity else { continue };
            let strength = term.targets.first().copied().flatten().unwrap_or_default();
            for (instant, moment) in self.solution.values(&term.quantity).enumerate() {
                let share = moment / strength;
                if share > 1.0 + more && worst.as_ref().is_none_or(|(found, _)| share > *found) {
                    let coordinate = model.coordinates()[effort.coordinate.index()].name.clone();
                    let strength = strength.abs();
                    worst = Some((share, Overload { coordinate, moment, strength, time_s: step_s * instant as f64 }));
                }
            }
        }
        worst.map(|(_, overload)| overload)
    }
}
