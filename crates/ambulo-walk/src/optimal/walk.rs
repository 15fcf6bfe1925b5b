//! The problem of walking: a figure walks at a given speed with mean curves of healthy subjects as targets.

pub(crate) mod passage;
mod targets;

pub(crate) use passage::{Passage, PassageEnd};

use super::error::OptimalWalkError;
use super::layout::Span;
use super::objective::{Bound, Quantity, Term};
use super::observer::Observer;
use super::problem::Problem;
use super::solution::Solution;
use super::solve::Continuation;
use crate::contact::HuntCrossley;
use crate::gait::{FREE_SPEED, JointMoments, Walk};
use crate::model::anthropometry::{ContactSphere, Human, SpherePart};
use crate::model::{CoordinateId, CoordinateKind, Model, Movement, Side};
use crate::numerics::elementary::powf;
use crate::spatial::Vec3;
use crate::toml_reader::TomlError;
use targets::{Target, Targets, settled_s};

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// The walk of a figure as a problem of optimal motion, with its first guess.
#[derive(Debug, Clone)]
pub struct WalkProblem {
    /// The problem of optimal motion.
    pub problem: Problem,
    /// Unknowns of the target motion, the first guess.
    pub guess: Vec<f64>,
    /// Numbers of the unknowns that keep their first guess.
    pub kept: Vec<usize>,
}

/// Contact spheres of a figure in three dimensions: each sphere of the planar figure is replaced by a medial and a
/// lateral one.
///
/// Under ball and toes, each pair is as wide as the foot, measured between its outer edges; under the heel, 0.7 times
/// as wide (our choice, after the ratio of heel to ball in Gait2392's foot).
#[must_use]
pub fn soles_with_width(human: &Human) -> Vec<ContactSphere> {
    let width = human.dimensions.foot_width;
    human
        .soles
        .iter()
        .flat_map(|sole| {
            let breadth = if sole.part == SpherePart::Heel { 0.7 * width } else { width };
            let aside = (0.5 * breadth - sole.radius).max(0.2 * breadth);
            [("medial", -1.0), ("lateral", 1.0)].map(|(place, sign)| {
                let outwards = if sole.side == Side::Right { sign } else { -sign };
                let center = sole.center + Vec3::new(0.0, 0.0, outwards * aside);
                ContactSphere { name: format!("{}_{place}", sole.name), center, ..sole.clone() }
            })
        })
        .collect()
}

/// Resolution and costs of a walk.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WalkCosts {
    /// Knot intervals per half cycle.
    pub knots: usize,
    /// Instants per knot interval.
    pub per_knot: usize,
    /// Deviation of hip flexion from its target that costs 1 [rad].
    pub hip: f64,
    /// The same for the knee [rad].
    pub knee: f64,
    /// The same for the ankle [rad].
    pub ankle: f64,
    /// The same for the angular accelerations of these joints [rad/s²].
    pub acceleration: f64,
    /// The same for the angular acceleration of the toes [rad/s²].
    pub toes: f64,
    /// The same for the angular accelerations of arms and other joints that are not named here [rad/s²].
    pub arms: f64,
    /// The same for the pelvis in the frontal and the transverse plane [rad].
    pub pelvis: f64,
    /// The same for the trunk in these planes [rad].
    pub trunk: f64,
    /// The same for hip adduction [rad].
    pub hip_adduction: f64,
    /// The same for hip rotation [rad].
    pub hip_rotation: f64,
    /// The same for the ground force of a foot, forward and up [body weights]; forward in free walking if it depends on
    /// the speed.
    pub force: [f64; 2],
    /// Power of the dimensionless speed that the deviation of the forward force grows with.
    pub force_exponent: f64,
    /// Weight of the normative ground forces in a gait without normative curves; 0 leaves them out.
    pub others: f64,
    /// Sideways ground force of a foot that costs 1 [body weights]: it should be small. Measured sideways forces are no
    /// target.
    pub sideways_force: f64,
    /// Deviation of a joint moment from [`JointMomentLaws`] that costs 1: extension of hip, knee and ankle [body weight
    /// × leg length].
    pub moment: f64,
    /// The same for hip abduction [body weight × leg length].
    pub abduction: f64,
    /// Rate of a joint moment that costs 1 [N.m/kg per cycle].
    pub moment_rate: f64,
    /// Slip velocity of a loaded sphere that costs 1, in free walking if it depends on the speed [m/s].
    pub slip: f64,
    /// Power of the dimensionless speed that it grows with.
    pub slip_exponent: f64,
    /// Height by which soles are lifted further than usual, in the middle of swing [m]: for uneven ground.
    pub lift: f64,
}

impl WalkCosts {
    /// For a figure in the sagittal plane that walks in any gait at a constant pace. Fewer splines with more instants
    /// each leave less of the forces at the root between the instants, which acts in a simulation. Toes and arms must
    /// be slow: they are so light that shaking them, toes by 1,000 to 5,000 rad/s², is the cheapest way to supply what
    /// the splines leave at the root, and the solver then finds no smoother walk. Forward forces are followed more
    /// closely in slow walking, where they are small and yet make the speed rise and fall the most.
    #[must_use]
    pub fn planar() -> WalkCosts {
        WalkCosts {
            per_knot: 4,
            hip: 1.5 * DEGREE,
            ankle: DEGREE,
            toes: 45.0,
            force: [0.009, 0.009],
            force_exponent: 1.1,
            others: 1.0,
            moment: 0.0055,
            moment_rate: 3.5,
            slip: 0.005,
            slip_exponent: 0.0,
            ..WalkCosts::default()
        }
    }

    /// For a figure in the sagittal plane whose pace changes. Toes must be slower still, or the last swing of some
    /// halts folds them by more than 100°. From 1.2 to 1.6 m/s within two steps, soles slip by at most 2 mm.
    #[must_use]
    pub(crate) fn change_of_pace() -> WalkCosts {
        WalkCosts {
            knots: 24,
            per_knot: 4,
            ankle: DEGREE,
            toes: 6.0,
            arms: 3.0,
            force: [0.02, 0.01],
            others: 1.0,
            slip: 0.0025,
            slip_exponent: 0.0,
            ..WalkCosts::default()
        }
    }

    /// The costs at a dimensionless speed.
    fn at(self, speed: f64) -> WalkCosts {
        let [forward, up] = self.force;
        let grown = |exponent: f64| powf(speed / FREE_SPEED, exponent);
        let force = [forward * grown(self.force_exponent), up];
        WalkCosts { force, slip: self.slip * grown(self.slip_exponent), ..self }
    }
}

impl Default for WalkCosts {
    /// For a figure in three dimensions. In fast walking feet would slip more, so slip costs more there.
    fn default() -> WalkCosts {
        WalkCosts {
            knots: 32,
            per_knot: 2,
            hip: 2.0 * DEGREE,
            knee: 2.0 * DEGREE,
            ankle: 1.2 * DEGREE,
            acceleration: 30.0,
            toes: 90.0,
            arms: 10.0,
            pelvis: 0.35 * DEGREE,
            trunk: 1.0 * DEGREE,
            hip_adduction: 2.3 * DEGREE,
            hip_rotation: 1.7 * DEGREE,
            force: [0.013, 0.04],
            force_exponent: 0.0,
            others: 0.0,
            sideways_force: 0.04,
            moment: 0.006,
            abduction: 0.0039,
            moment_rate: 3.0,
            slip: 0.005,
            slip_exponent: -1.0,
            lift: 0.0,
        }
    }
}

/// Stages of the solution: shoes become stiffer, friction steeper, and residual forces at the root more expensive.
pub const STAGES: [Continuation; 8] = [
    Continuation { stiffness: 0.25, creep: 50.0, slip: 1.0, slack: 0.05, updates: 0, steps: 20, gain: 3e-3 },
    Continuation { stiffness: 0.5, creep: 20.0, slip: 1.0, slack: 0.02, updates: 0, steps: 20, gain: 3e-3 },
    Continuation { stiffness: 1.0, creep: 8.0, slip: 1.0, slack: 0.01, updates: 0, steps: 10, gain: 3e-3 },
    Continuation { stiffness: 1.0, creep: 4.0, slip: 1.0, slack: 0.005, updates: 0, steps: 10, gain: 3e-3 },
    Continuation { stiffness: 1.0, creep: 2.0, slip: 1.0, slack: 0.002, updates: 0, steps: 10, gain: 3e-3 },
    Continuation { stiffness: 1.0, creep: 1.0, slip: 1.0, slack: 0.001, updates: 0, steps: 10, gain: 1e-3 },
    Continuation { stiffness: 1.0, creep: 1.0, slip: 1.0, slack: 0.0002, updates: 1, steps: 10, gain: 1e-3 },
    Continuation { stiffness: 1.0, creep: 1.0, slip: 1.0, slack: 0.00003, updates: 6, steps: 10, gain: 1e-3 },
];

/// Stages of the solution of a walk in three dimensions: as [`STAGES`], but slip of soles becomes expensive as friction
/// becomes steep. Before that, soles must creep to transmit forces, and a high cost of slip leads to motions that avoid
/// forces.
pub const SPATIAL_STAGES: [Continuation; 8] = {
    let factors = [4.0, 4.0, 4.0, 4.0, 4.0, 3.0, 1.7, 1.0];
    let (mut stages, mut k) = (STAGES, 0);
    while k < stages.len() {
        stages[k].slip = factors[k];
        k += 1;
    }
    stages[k - 1].updates = 10;
    stages
};

/// Stages of the solution of a gait far from normative gaits, such as a step with straight knees: friction becomes
/// steeper in more stages of more steps.
pub const FINE_STAGES: [Continuation; 11] = [
    Continuation { stiffness: 0.25, creep: 50.0, slip: 1.0, slack: 0.05, updates: 0, steps: 30, gain: 1e-3 },
    Continuation { stiffness: 0.5, creep: 25.0, slip: 1.0, slack: 0.02, updates: 0, steps: 30, gain: 1e-3 },
    Continuation { stiffness: 1.0, creep: 16.0, slip: 1.0, slack: 0.01, updates: 0, steps: 30, gain: 1e-3 },
    Continuation { stiffness: 1.0, creep: 10.0, slip: 1.0, slack: 0.005, updates: 0, steps: 30, gain: 1e-3 },
    Continuation { stiffness: 1.0, creep: 6.0, slip: 1.0, slack: 0.003, updates: 0, steps: 30, gain: 1e-3 },
    Continuation { stiffness: 1.0, creep: 4.0, slip: 1.0, slack: 0.002, updates: 0, steps: 30, gain: 1e-3 },
    Continuation { stiffness: 1.0, creep: 2.5, slip: 1.0, slack: 0.001, updates: 0, steps: 30, gain: 1e-3 },
    Continuation { stiffness: 1.0, creep: 1.6, slip: 1.0, slack: 0.001, updates: 0, steps: 30, gain: 1e-3 },
    Continuation { stiffness: 1.0, creep: 1.0, slip: 1.0, slack: 0.001, updates: 0, steps: 40, gain: 1e-3 },
    Continuation { stiffness: 1.0, creep: 1.0, slip: 1.0, slack: 0.0003, updates: 2, steps: 20, gain: 1e-3 },
    Continuation { stiffness: 1.0, creep: 1.0, slip: 1.0, slack: 0.0001, updates: 4, steps: 20, gain: 1e-3 },
];

/// Deviation of a joint angle from its range that costs 1 [rad].
const RANGE: f64 = 0.2 * DEGREE;

struct Builder<'a> {
    model: &'a Model,
    targets: Vec<Target>,
    terms: Vec<Term>,
}

impl WalkProblem {
    /// The problem of a figure that walks in a gait.
    ///
    /// # Errors
    /// Does not fail: a test reads the built-in laws.
    pub fn new(
        human: &Human,
        soles: &[ContactSphere],
        shoes: HuntCrossley,
        walk: &Walk,
        costs: &WalkCosts,
    ) -> Result<WalkProblem, TomlError> {
        WalkProblem::over(Span::MirroredHalfCycle, human, soles, shoes, walk, costs)
    }

    /// As [`WalkProblem::new`], over half a mirrored cycle or a whole cycle, whose sides may then differ.
    ///
    /// # Errors
    /// As [`WalkProblem::new`].
    pub fn over(
        span: Span,
        human: &Human,
        soles: &[ContactSphere],
        shoes: HuntCrossley,
        walk: &Walk,
        costs: &WalkCosts,
    ) -> Result<WalkProblem, TomlError> {
        let halves = if span == Span::MirroredHalfCycle { 1 } else { 2 };
        let duration_s = 0.5 * walk.cycle_s() * halves as f64;
        let distance = walk.speed() * duration_s;
        let empty = Problem {
            span,
            duration_s,
            travel: forward(&human.model).map(|id| (id, distance)),
            knots: costs.knots * halves,
            ..empty(human, soles, shoes, costs)
        };
        let start_s = settled_s(walk);
        let times: Vec<f64> = empty.shares().iter().map(|share| start_s + share * duration_s).collect();
        let builder = Builder::new(human, walk, &times)?;
        let coordinates: Vec<Vec<f64>> = builder.targets.iter().map(|target| target.posture[0].clone()).collect();
        let costs = costs.at(walk.dimensionless_speed());
        Ok(WalkProblem::guessed(builder.problem(empty, walk, &costs), &coordinates))
    }

    /// A problem with the first guess that fits coordinates at its instants, at the height at which the ground carries
    /// the body.
    fn guessed(problem: Problem, coordinates: &[Vec<f64>]) -> WalkProblem {
        let mut guess = problem.fitted(coordinates);
        if let Some((height, _)) = problem.model.anatomy().coordinate(Movement::PelvisUp, None) {
            let _ = problem.settle(&mut guess, height);
        }
        WalkProblem { problem, guess, kept: Vec::new() }
    }

    /// The same problem, whose solver is followed by an observer.
    pub(crate) fn observed_by(mut self, observer: &Observer) -> WalkProblem {
        self.problem.observer = observer.clone();
        self
    }

    /// The stages in which a walk from a first guess is solved: [`SPATIAL_STAGES`] for a figure that can move sideways,
    /// [`STAGES`] for one in the sagittal plane.
    #[must_use]
    pub fn stages(&self) -> &'static [Continuation] {
        if moves_sideways(&self.problem.model) { &SPATIAL_STAGES } else { &STAGES }
    }

    /// Solves the problem from its first guess. If forces at the root remain, it repeats the last stage, then from
    /// the middle stage on, and then with the last one again.
    ///
    /// # Errors
    /// If the figure has joints that are not hinges or slides, or the observer stops the solver.
    pub fn solve(&self, stages: &[Continuation]) -> Result<Solution, OptimalWalkError> {
        let (longer, softer) = (Continuation::on(stages), &stages[stages.len() / 2..]);
        let found = self.problem.solve_keeping(&self.guess, stages, &self.kept)?;
        self.problem.balanced(found, &[&longer, softer, &longer], &self.kept)
    }

    /// As [`WalkProblem::solve`], in less time where a knot interval has many instants: the first stages, which only
    /// make a better guess, count every second instant. All count from the last stage before the first update of
    /// multipliers on.
    ///
    /// # Errors
    /// As [`WalkProblem::solve`].
    pub(crate) fn solve_coarse_first(&self, stages: &[Continuation]) -> Result<Solution, OptimalWalkError> {
        let exact = stages.iter().position(|stage| stage.updates > 0).unwrap_or_default();
        let (coarse, fine) = stages.split_at(exact.saturating_sub(1));
        if coarse.is_empty() || !self.problem.instants_per_knot.is_multiple_of(2) {
            return self.solve(stages);
        }
        let first = self.problem.every_second().solve_keeping(&self.guess, coarse, &self.kept)?;
        let mut found = self.problem.solve_keeping(first.unknowns(), fine, &self.kept)?;
        found.progress.splice(0..0, first.progress);
        Ok(found)
    }
}

/// Coordinate of forward motion.
fn forward(model: &Model) -> Option<CoordinateId> {
    model.anatomy().coordinate(Movement::PelvisForward, None).map(|(id, _)| id)
}

/// Whether the figure is not bound to the sagittal plane.
pub(super) fn moves_sideways(model: &Model) -> bool {
    model.anatomy().coordinate(Movement::PelvisRight, None).is_some()
}

/// A problem of a figure that has no span and no terms yet.
fn empty(human: &Human, soles: &[ContactSphere], shoes: HuntCrossley, costs: &WalkCosts) -> Problem {
    Problem {
        model: human.model.clone(),
        soles: soles.to_vec(),
        levels_m: Vec::new(),
        shoes,
        span: Span::Single,
        duration_s: 1.0,
        travel: None,
        knots: costs.knots,
        instants_per_knot: costs.per_knot,
        length_m: human.dimensions.leg_length,
        terms: Vec::new(),
        observer: Observer::default(),
    }
}

impl<'a> Builder<'a> {
    fn new(human: &'a Human, walk: &Walk, times_s: &[f64]) -> Result<Builder<'a>, TomlError> {
        Ok(Builder { model: &human.model, targets: Targets::new(human, walk)?.at(times_s), terms: Vec::new() })
    }

    /// The problem with the terms of a walk.
    fn problem(mut self, empty: Problem, walk: &Walk, costs: &WalkCosts) -> Problem {
        self.posture(costs);
        self.forces(&empty, walk, costs);
        self.moment_rates(walk, costs);
        self.feet(&empty, costs);
        Problem { terms: self.terms, ..empty }
    }
}

impl Builder<'_> {
    fn add(&mut self, name: &str, quantity: Quantity, targets: Vec<Option<f64>>, deviation: f64, bound: Bound) {
        self.terms.push(Term { name: name.to_owned(), quantity, targets, deviation, bound });
    }

    fn constant(&self, value: f64) -> Vec<Option<f64>> {
        vec![Some(value); self.targets.len()]
    }

    /// Adds terms for angle and acceleration of a coordinate, with the walk's as targets.
    fn follow(&mut self, id: CoordinateId, angle: f64, acceleration: f64) {
        let name = self.model.coordinates()[id.index()].name.clone();
        let part = |d: usize| self.targets.iter().map(|t| Some(t.posture[d][id.index()])).collect::<Vec<_>>();
        let (angles, accelerations) = (part(0), part(2));
        self.add(&name, Quantity::Position(vec![(id, 1.0)]), angles, angle, Bound::Near);
        self.add(&name, Quantity::Acceleration(vec![(id, 1.0)]), accelerations, acceleration, Bound::Near);
    }

    fn posture(&mut self, costs: &WalkCosts) {
        let model = self.model;
        let anatomy = model.anatomy();
        for id in model.coordinate_ids() {
            let meaning = anatomy.meaning(id);
            let name = model.coordinates()[id.index()].name.clone();
            match meaning.map(|meaning| meaning.movement) {
                Some(Movement::HipFlexion) => self.follow(id, costs.hip, costs.acceleration),
                Some(Movement::KneeFlexion) => {
                    self.follow(id, costs.knee, costs.acceleration);
                    let sign = meaning.map_or(1.0, |m| m.sign);
                    let flexion = Quantity::Position(vec![(id, sign)]);
                    self.add(&name, flexion, self.constant(1.5 * DEGREE), 0.5 * DEGREE, Bound::AtLeast);
                }
                Some(Movement::AnkleDorsiflexion) => self.follow(id, costs.ankle, costs.acceleration),
                Some(Movement::ToeExtension) => {
                    let side = usize::from(meaning.and_then(|m| m.side) == Some(Side::Left));
                    let toes = self.targets.iter().map(|t| Some(t.toes[side])).collect();
                    self.add(&name, Quantity::Position(vec![(id, 1.0)]), toes, 8.0 * DEGREE, Bound::Near);
                    let still = self.constant(0.0);
                    self.add(&name, Quantity::Acceleration(vec![(id, 1.0)]), still, costs.toes, Bound::Near);
                }
                Some(Movement::PelvisForward | Movement::PelvisUp | Movement::PelvisRight) => {
                    let still = self.constant(0.0);
                    self.add(&name, Quantity::Acceleration(vec![(id, 1.0)]), still, 20.0, Bound::Near);
                }
                Some(Movement::PelvicTilt) => self.follow(id, DEGREE, 3.0),
                Some(Movement::PelvicObliquity | Movement::PelvicRotation) => {
                    self.follow(id, costs.pelvis, 10.0);
                }
                Some(Movement::HipAdduction) => self.follow(id, costs.hip_adduction, 20.0),
                Some(Movement::HipRotation) => self.follow(id, costs.hip_rotation, 20.0),
                Some(Movement::SubtalarInversion) => self.follow(id, 3.0 * DEGREE, 6.0),
                Some(Movement::TrunkLean) => self.trunk(id),
                Some(Movement::TrunkObliquity | Movement::TrunkRotation) => self.follow(id, costs.trunk, 10.0),
                _ => self.follow(id, 3.0 * DEGREE, costs.arms),
            }
            self.range(id, &name);
        }
        if let Some((id, _)) = anatomy.coordinate(Movement::PelvisForward, None) {
            let mut at_start = vec![None; self.targets.len()];
            at_start[0] = Some(0.0);
            self.add("place", Quantity::Position(vec![(id, 1.0)]), at_start, 1e-3, Bound::Near);
        }
    }

    /// Adds terms that keep a joint angle in the range of its joint.
    fn range(&mut self, id: CoordinateId, name: &str) {
        let coordinate = &self.model.coordinates()[id.index()];
        let Some(range) = coordinate.range.filter(|_| coordinate.kind == CoordinateKind::Rotation) else { return };
        for (limit, bound) in range.into_iter().zip([Bound::AtLeast, Bound::AtMost]) {
            let name = format!("range of {name}");
            self.add(&name, Quantity::Position(vec![(id, 1.0)]), self.constant(limit), RANGE, bound);
        }
    }

    /// Adds terms for the lean of the trunk in the world, the sum of pelvic tilt and lumbar angle.
    fn trunk(&mut self, lumbar: CoordinateId) {
        let Some((tilt, _)) = self.model.anatomy().coordinate(Movement::PelvicTilt, None) else { return };
        let both = vec![(tilt, 1.0), (lumbar, 1.0)];
        let sum = |d: usize| -> Vec<Option<f64>> {
            self.targets.iter().map(|t| Some(t.posture[d][tilt.index()] + t.posture[d][lumbar.index()])).collect()
        };
        let (angles, accelerations) = (sum(0), sum(2));
        self.add("trunk", Quantity::Position(both.clone()), angles, DEGREE, Bound::Near);
        self.add("trunk", Quantity::Acceleration(both), accelerations, 3.0, Bound::Near);
    }

    /// Forces on the ground and in joints. Normative forces are used for normative gaits only.
    fn forces(&mut self, problem: &Problem, walk: &Walk, costs: &WalkCosts) {
        let weight = problem.weight_n();
        for side in Side::BOTH {
            let toes = Quantity::GroundForce(spheres_of(problem, side, Some(SpherePart::Toes)), 1);
            self.add("force under the toes", toes, self.constant(0.0), 0.15 * weight, Bound::Near);
            if moves_sideways(self.model) {
                let sideways = Quantity::GroundForce(spheres_of(problem, side, None), 2);
                let deviation = costs.sideways_force * weight;
                self.add("sideways force", sideways, self.constant(0.0), deviation, Bound::Near);
            }
        }
        let share = if walk.gait().follows_people() { 1.0 } else { costs.others };
        if share <= 0.0 {
            return;
        }
        for (k, side) in Side::BOTH.into_iter().enumerate() {
            let spheres = spheres_of(problem, side, None);
            for axis in 0..2 {
                let targets = self.targets.iter().map(|t| Some(t.forces[k][axis] * weight)).collect();
                let deviation = costs.force[axis] * weight / share.sqrt();
                self.add("ground force", Quantity::GroundForce(spheres.clone(), axis), targets, deviation, Bound::Near);
            }
        }
        if walk.gait().follows_people() {
            self.moments(problem, costs);
        }
    }

    fn moment_rates(&mut self, walk: &Walk, costs: &WalkCosts) {
        let rate = costs.moment_rate * self.model.mass() / walk.cycle_s();
        for id in self.model.coordinate_ids() {
            let Some(meaning) = self.model.anatomy().meaning(id) else { continue };
            let moves = matches!(
                meaning.movement,
                Movement::HipFlexion
                    | Movement::HipAdduction
                    | Movement::HipRotation
                    | Movement::KneeFlexion
                    | Movement::AnkleDorsiflexion
                    | Movement::SubtalarInversion
            );
            if moves {
                self.add("moment rate", Quantity::ForceRate(id), self.constant(0.0), rate, Bound::Near);
            }
        }
    }

    fn moments(&mut self, problem: &Problem, costs: &WalkCosts) {
        let weight_times_leg = problem.weight_n() * problem.length_m;
        type Part = fn(&JointMoments) -> f64;
        let parts: [(Movement, Part, f64); 4] = [
            (Movement::HipFlexion, |m| -m.hip_extension, costs.moment),
            (Movement::KneeFlexion, |m| -m.knee_extension, costs.moment),
            (Movement::AnkleDorsiflexion, |m| -m.plantarflexion, costs.moment),
            (Movement::HipAdduction, |m| -m.hip_abduction, costs.abduction),
        ];
        for (k, side) in Side::BOTH.into_iter().enumerate() {
            for (movement, part, deviation) in parts {
                let Some((id, sign)) = self.model.anatomy().coordinate(movement, Some(side)) else { continue };
                let target = |t: &Target| Some(sign * part(&t.moments[k]) * weight_times_leg);
                let targets = self.targets.iter().map(target).collect();
                let deviation = deviation * weight_times_leg;
                self.add("moment", Quantity::Force(id), targets, deviation, Bound::Near);
            }
        }
    }

    fn feet(&mut self, problem: &Problem, costs: &WalkCosts) {
        let light_n = 0.05 * problem.weight_n();
        for (sphere, sole) in problem.soles.iter().enumerate() {
            let side = usize::from(sole.side == Side::Left);
            let part = SpherePart::OF_FOOT.iter().position(|(part, _)| *part == sole.part).unwrap_or(0);
            for axis in 0..2 {
                let slip = Quantity::Slip { sphere, axis, light_n };
                self.add("slip", slip, self.constant(0.0), costs.slip, Bound::Near);
            }
            let height =
                |target: &Target| target.clearance[side][part].map(|[least, share]| least + costs.lift * share);
            let clear = self.targets.iter().map(height).collect();
            self.add("clearance", Quantity::Height(sphere), clear, 0.002, Bound::AtLeast);
        }
    }
}

/// Numbers of the spheres under a part of the foot of a side, or under the whole foot.
fn spheres_of(problem: &Problem, side: Side, part: Option<SpherePart>) -> Vec<usize> {
    let is_it = |sole: &ContactSphere| sole.side == side && part.is_none_or(|part| sole.part == part);
    (0..problem.soles.len()).filter(|&k| is_it(&problem.soles[k])).collect()
}
