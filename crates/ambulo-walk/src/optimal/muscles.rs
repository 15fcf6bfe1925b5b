//! The terms of an objective that belong to muscles: metabolic power, moments relative to strength, and smooth motion.
//!
//! The largest costs are metabolic power by the efficiencies of muscles (Margaria 1968; unverified), 0.25 for positive
//! and 1.2 for negative work, and muscle moments relative to strength. All costs are relative to the size of the body
//! (mass m, leg length l, gravity g), so that they mean the same for a child.

use super::conditions::{Device, WalkConditions};
use super::effort::{Effort, tissue_of};
use super::error::Overload;
use super::objective::{Bound, Quantity, Term};
use super::problem::Problem;
use super::solution::Solution;
use super::strength::StrengthCurve;
use crate::model::anthropometry::{Build, Human};
use crate::model::{CoordinateId, Movement, Side};

const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// Price of positive and negative mechanical work of muscles: the inverse of their efficiency.
pub const WORK_PRICES: [f64; 2] = [1.0 / 0.25, 1.0 / 1.2];

/// Costs of muscles. Each is the deviation at which an instant costs 1.
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
    /// Slip velocity of a loaded sphere [m/s].
    pub slip: f64,
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
            slip: 0.02,
        }
    }
}

/// Stiffness of the toes [N.m/rad] and their damping [N.m.s/rad] in an adult. Falisse et al. 2022 (PLOS One
/// 17:e0256311; unverified) have 25 N.m/rad.
const TOES: [f64; 2] = [25.0, 0.5];
/// Damping of shoulders and elbows in an adult [N.m.s/rad]: our choice.
const ARM_DAMPING: f64 = 0.3;
/// Body weight times stature of the adult of these laws [N.m].
const ADULT: f64 = 75.0 * 9.80665 * 1.75;
/// Mechanical power below which muscles cost more than their work [W/kg]: smooths the cost where the power changes its
/// sign.
const SMOOTH: f64 = 0.067;
/// Adds the costs of muscles to the terms of a problem.
pub(super) struct MuscleTerms<'a> {
    pub(super) human: &'a Human,
    pub(super) costs: &'a EffortCosts,
    pub(super) conditions: &'a WalkConditions,
    pub(super) problem: &'a Problem,
    /// Duration of the cycle in which the given moments of devices repeat [s].
    pub(super) cycle_s: f64,
    /// Unit of angular acceleration g/l [1/s²].
    pub(super) turning: f64,
    pub(super) terms: Vec<Term>,
}

impl<'a> MuscleTerms<'a> {
    pub(super) fn new(
        human: &'a Human,
        costs: &'a EffortCosts,
        conditions: &'a WalkConditions,
        problem: &'a Problem,
        cycle_s: f64,
    ) -> MuscleTerms<'a> {
        let turning = human.model.gravity().norm() / human.dimensions.leg_length;
        MuscleTerms { human, costs, conditions, problem, cycle_s, turning, terms: Vec::new() }
    }

    fn constant(&self, value: f64) -> Vec<Option<f64>> {
        vec![Some(value); self.problem.instants()]
    }

    fn add(&mut self, name: &str, quantity: Quantity, target: f64, deviation: f64, bound: Bound) {
        let targets = self.constant(target);
        self.terms.push(Term { name: name.to_owned(), quantity, targets, deviation, bound });
    }

    /// Rate of a joint moment that costs 1 [N.m/s].
    pub(super) fn moment_rate(&self) -> f64 {
        let size = self.human.build.mass * 9.80665 * self.human.dimensions.leg_length;
        self.costs.moment_rate * size * self.turning.sqrt()
    }

    /// Adds the costs of all joints but the root.
    pub(super) fn joints(&mut self) {
        let model = &self.human.model;
        let root: Vec<CoordinateId> = self.problem.root().into_iter().map(|(id, _)| id).collect();
        for id in model.coordinate_ids().filter(|id| !root.contains(id)) {
            let meaning = model.anatomy().meaning(id);
            let movement = meaning.map(|meaning| meaning.movement);
            let name = model.coordinates()[id.index()].name.clone();
            let efforts = [true, false].map(|is_less_tissue| self.effort(id, &name, movement, is_less_tissue));
            self.muscles(&name, &efforts, movement, meaning.map_or(1.0, |m| m.sign));
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

    /// Muscle moment of a joint without devices, and without the passive moment of tissue or with it.
    fn effort(&self, id: CoordinateId, name: &str, movement: Option<Movement>, is_less_tissue: bool) -> Effort {
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
        if let (Some(movement), Some(side), true) = (movement, side, is_less_tissue)
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
            let place = share * self.problem.duration_s / self.cycle_s + ahead;
            constant + devices.iter().map(|device| device.given(place)).sum::<f64>()
        };
        effort.given = self.problem.shares().iter().map(given).collect();
        effort
    }

    fn muscles(&mut self, name: &str, efforts: &[Effort; 2], movement: Option<Movement>, sign: f64) {
        let [effort, with_tissue] = efforts;
        let kg = self.human.build.mass;
        let prices = WORK_PRICES;
        let power = Quantity::RootPower { effort: effort.clone(), prices, smooth_w: SMOOTH * kg };
        self.add("power", power, 0.0, (self.costs.power * kg).sqrt(), Bound::Near);
        let strength = self.strength(name, movement, sign);
        let share =
            |effort: &Effort, sign| Quantity::Activation { effort: effort.clone(), strength: strength.clone(), sign };
        // The isometric moments of the table hold the passive forces of tissue.
        for sign in [1.0, -1.0] {
            self.add("effort", share(effort, sign), 0.0, self.costs.strength, Bound::AtMost);
            self.add(OVERLOAD, share(with_tissue, sign), 1.0, self.costs.weakness, Bound::AtMost);
        }
    }

    /// What the muscles of a coordinate can do, with the share that its condition leaves.
    fn strength(&self, name: &str, movement: Option<Movement>, sign: f64) -> StrengthCurve {
        let Build { mass, height, .. } = self.human.build;
        let curve = StrengthCurve::of_movement(movement, mass, height).scaled(self.conditions.strength(name));
        if sign > 0.0 { curve } else { curve.reversed() }
    }

    /// Moments of joints change slowly.
    pub(super) fn moment_rates(&mut self) {
        let root: Vec<CoordinateId> = self.problem.root().into_iter().map(|(id, _)| id).collect();
        let rate = self.moment_rate();
        for id in self.human.model.coordinate_ids().filter(|id| !root.contains(id)) {
            self.add("moment rate", Quantity::ForceRate(id), 0.0, rate, Bound::Near);
        }
    }

    /// The trunk stays upright in the world, not on the slope.
    pub(super) fn trunk(&mut self) {
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
}

/// Share of the cycle by which the cycle of a coordinate's leg is ahead of the cycle of the right leg.
pub(super) fn ahead_of(name: &str) -> f64 {
    if Side::split_name(name).is_some_and(|(side, _)| side == Side::Left) { 0.5 } else { 0.0 }
}

/// Name of the terms for muscle moments above strength.
const OVERLOAD: &str = "overload";

impl Solution {
    /// The largest muscle moment above the strength of its joint, if it exceeds it by more than the share `more`.
    /// Problems without costs of muscles have none.
    #[must_use]
    pub fn overload(&self, more: f64) -> Option<Overload> {
        let problem = self.problem();
        let model = &problem.model;
        let step_s = problem.duration_s / (problem.instants() - 1) as f64;
        let mut worst: Option<(f64, Overload)> = None;
        for term in problem.terms.iter().filter(|term| term.name == OVERLOAD) {
            let Quantity::Activation { effort, .. } = &term.quantity else { continue };
            let moment = Quantity::Effort(effort.clone());
            let both = self.values(&term.quantity).zip(self.values(&moment));
            for (instant, (share, moment)) in both.enumerate() {
                if share > 1.0 + more && worst.as_ref().is_none_or(|(found, _)| share > *found) {
                    let coordinate = model.coordinates()[effort.coordinate.index()].name.clone();
                    let strength = moment.abs() / share;
                    worst = Some((share, Overload { coordinate, moment, strength, time_s: step_s * instant as f64 }));
                }
            }
        }
        worst.map(|(_, overload)| overload)
    }
}
