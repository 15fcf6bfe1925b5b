//! Torques by which a figure follows its plan: impedances of the joints, and feedback of the whole state.
//!
//!   k (q* - q) + d (q̇* - q̇)          impedance, with k = k₇₅ s m H / (75 kg · 1.75 m)
//!   -K(φ) (x - x*)                   feedback, within ±c L F at ankles and toes
//!
//! Feedback that acts d time steps later takes the deviation then, x̂_{k+d}, from x̂_{j+1} = A_j x̂_j + B_j u_j with
//! the feedback u_j that is on its way, as Smith's predictor does (1957; unverified).
//!
//! | code | symbol | unit | meaning |
//! |---|---|---|---|
//! | `stiffness`, `damping` | k, d | N.m/rad, N.m.s/rad | impedance of a joint |
//! | `settings.stiffness` | k₇₅ | N.m/rad | stiffness of a hip of an adult of 75 kg and 1.75 m |
//! | `share_of` | s | 1 | 1 for hips, knees, ankles and the lumbar joint; 0.2 for toes; 0.3 for others |
//! | `size_of` | m H / (75 kg · 1.75 m) | 1 | mass times height of the figure, relative to the adult |
//! | `deviation` | x - x* | rad, m; rad/s, m/s | coordinates but the place forward, then all rates |
//! | `lever_m` | c L | m | share c of the length L of the foot |
//! | `loads_n` | F | N | vertical force on the foot |
//! | `higher` | | m | height of the ground, and what longer legs add to the height of the pelvis |
//! | `Phase::aside_m` | | m | how far aside the figure has stepped out of standing |
//!
//! Pinned by: tests/physical_walk.rs.

use super::activation::left_over;
use super::foot_placement::{Followed, PlacedFeet};
use super::linear::Impedance;
use super::phase::{Phase, Sensed};
use super::plan::{PlannedStep, Root};
use super::riccati::StepMap;
use super::settings::{Balance, ControlError, ControlSettings};
use super::standing::Moment;
use super::walk_plan::WalkPlan;
use crate::engine::Motor;
use crate::model::anthropometry::Human;
use crate::model::{CoordinateId, Movement, Side};
use crate::optimal::StrengthCurve;
use nalgebra::DVector;
use std::collections::VecDeque;

/// Mass times stature of the adult of the settings [kg.m].
const ADULT: f64 = 75.0 * 1.75;
/// Largest feedback of the state at ankle and toes, as the load of the foot times a share of its length: more would
/// turn a foot that does not stand as firmly as planned, and the load on its edge would be lost.
const ANKLE_LEVER: f64 = 0.35;
const TOE_LEVER: f64 = 0.1;

/// Impedances and feedback of a figure.
#[derive(Debug, Clone)]
pub(super) struct Feedback {
    pub(super) impedances: Vec<Impedance>,
    /// Coordinates of the rows of gains.
    pub(super) joints: Vec<usize>,
    /// Coordinates of the first columns of gains; rates follow.
    places: Vec<usize>,
    /// By coordinate: the foot that it turns (0 right, 1 left), and the lever of its load by which feedback may turn it
    /// [m]; none where it turns no foot.
    levers: Vec<Option<(usize, f64)>>,
    /// Balance by foot placement instead of gains.
    placed_feet: Option<PlacedFeet>,
    /// Feedback that does not act yet, the oldest first.
    late: VecDeque<Vec<f64>>,
    /// Share of a torque of feedback that is left after a time step; none where it acts at once.
    pub(super) left: Option<f64>,
    /// Torques of feedback that act now, one per coordinate [N.m].
    acting: Vec<f64>,
}

impl Feedback {
    /// The feedback of a figure with these joints and places of its state.
    pub(super) fn new(
        human: &Human,
        [joints, places]: [Vec<usize>; 2],
        settings: &ControlSettings,
        step_s: f64,
    ) -> Result<Feedback, ControlError> {
        let placed_feet = match settings.balance {
            Balance::FootPlacement(law) => Some(PlacedFeet::new(&human.model, law, size_of(human))?),
            Balance::Nothing | Balance::WholeState => None,
        };
        let impedances = impedances(human, &joints, settings);
        let (late, left) = (late(human, settings, step_s), left_over(settings, step_s));
        let acting = vec![0.0; impedances.len()];
        Ok(Feedback { impedances, joints, places, levers: levers(human), placed_feet, late, left, acting })
    }

    /// The same feedback with the impedances and the delay of other settings.
    pub(crate) fn with_settings(&self, human: &Human, settings: &ControlSettings, step_s: f64) -> Feedback {
        let impedances = impedances(human, &self.joints, settings);
        let (late, left) = (late(human, settings, step_s), left_over(settings, step_s));
        Feedback { impedances, late, left, ..self.clone() }
    }

    /// Motors of a figure that has fallen.
    pub(super) fn limp(&self, now: &[[f64; 2]]) -> Vec<Option<Motor>> {
        let limp =
            |(impedance, now): (&Impedance, &[f64; 2])| (impedance.stiffness > 0.0).then(|| impedance.limp(*now));
        self.impedances.iter().zip(now).map(limp).collect()
    }

    /// Motors that follow a planned time step, with the feedback that acts now.
    pub(super) fn motors(
        &mut self,
        plan: &WalkPlan,
        phase: &Phase,
        planned: &PlannedStep,
        sensed: Sensed<'_>,
    ) -> Vec<Option<Motor>> {
        let feedback = self.torques(plan, phase, planned, sensed);
        self.late.push_back(feedback);
        let commanded = self.late.pop_front().unwrap_or_default();
        let left = self.left.unwrap_or(0.0);
        for (torque, command) in self.acting.iter_mut().zip(commanded) {
            *torque = left * *torque + (1.0 - left) * command;
        }
        let motor = |(c, impedance): (usize, &Impedance)| {
            let target = [planned.target[0][c], planned.target[1][c]];
            let torque = planned.torques[c] + self.acting[c];
            (impedance.stiffness > 0.0).then(|| impedance.motor(target, torque, sensed.now[c]))
        };
        self.impedances.iter().enumerate().map(motor).collect()
    }

    /// Torque of each coordinate from the deviation of the state [N.m].
    fn torques(&self, plan: &WalkPlan, phase: &Phase, planned: &PlannedStep, sensed: Sensed<'_>) -> Vec<f64> {
        let Sensed { now, loads_n } = sensed;
        let mut feedback = vec![0.0; now.len()];
        if let Some(law) = &self.placed_feet {
            let [q, qd]: [Vec<f64>; 2] = [0, 1].map(|k| now.iter().map(|now| now[k]).collect());
            let state = Followed { now: [&q, &qd], planned: [&planned.state[0], &planned.state[1]] };
            for (hip, torque) in law.torques(&plan.body.model, &self.impedances, &state, phase.stance) {
                feedback[hip] = torque;
            }
            return feedback;
        }
        let deviation = self.deviation(plan, phase, planned, now);
        let (at, deviation) = self.foreseen(plan, phase.at, deviation);
        if let Some(torques) = plan.feedback(at, &deviation) {
            for (joint, torque) in self.joints.iter().zip(torques.iter()) {
                let most =
                    self.levers[*joint].map_or(f64::INFINITY, |(foot, lever_m)| lever_m * loads_n[foot].max(0.0));
                feedback[*joint] = (-torque).clamp(-most, most);
            }
        }
        feedback
    }

    /// The deviation of the state from a planned time step, with the torques that are on their way.
    pub(super) fn deviation(
        &self,
        plan: &WalkPlan,
        phase: &Phase,
        planned: &PlannedStep,
        now: &[[f64; 2]],
    ) -> DVector<f64> {
        let &Root { up, sideways, .. } = plan.root();
        let higher = phase.level_m + (plan.height_ratio - 1.0) * planned.state[0][up];
        let elsewhere = |c: usize| match c {
            c if c == up => higher,
            c if Some(c) == sideways => phase.aside_m,
            _ => 0.0,
        };
        let places = self.places.iter().map(|&c| now[c][0] - planned.state[0][c] - elsewhere(c));
        let rates = (0..now.len()).map(|c| now[c][1] - planned.state[1][c]);
        let torques = self.joints.iter().filter(|_| self.left.is_some()).map(|joint| self.acting[*joint]);
        DVector::from_vec(places.chain(rates).chain(torques).collect())
    }

    /// When feedback of now will act, and the deviation of the state then: the feedback until then is known.
    fn foreseen(&self, plan: &WalkPlan, now: Moment, deviation: DVector<f64>) -> (Moment, DVector<f64>) {
        self.late.iter().fold((now, deviation), |(at, deviation), feedback| {
            let inputs = DVector::from_iterator(self.joints.len(), self.joints.iter().map(|joint| feedback[*joint]));
            let after = plan.after(at, &deviation, &inputs).unwrap_or(deviation);
            (plan.later(at), after)
        })
    }

    /// Maps of time steps, where feedback has to foresee the state.
    pub(super) fn kept(&self, maps: Vec<StepMap>) -> Vec<StepMap> {
        if self.late.is_empty() { Vec::new() } else { maps }
    }

    /// The largest stiffness of a coordinate by its own angle, impedance and feedback together [N.m/rad].
    pub(super) fn largest_stiffness(&self, c: usize, plan: &WalkPlan) -> f64 {
        let own = self.impedances[c].stiffness;
        let row = self.joints.iter().position(|joint| *joint == c);
        let column = self.places.iter().position(|place| *place == c);
        let (Some(row), Some(column)) = (row, column) else { return own };
        plan.gains().map(|gain| gain[(row, column)] + own).fold(own, f64::max)
    }
}

/// Share of the settings that a joint has, and its movement.
pub(super) fn share_of(human: &Human, coordinate: usize) -> (f64, Option<Movement>) {
    let anatomy = human.model.anatomy();
    let movement = anatomy.meaning(CoordinateId(coordinate)).map(|meaning| meaning.movement);
    let share = match movement {
        Some(Movement::ToeExtension) => 0.2,
        Some(Movement::HipFlexion | Movement::KneeFlexion | Movement::AnkleDorsiflexion | Movement::TrunkLean) => 1.0,
        _ => 0.3,
    };
    (share, movement)
}

/// Mass times height, relative to the adult of the settings [1].
pub(super) fn size_of(human: &Human) -> f64 {
    human.model.mass() * human.build.height / ADULT
}

/// Steps after which feedback acts.
pub(super) fn delay_steps(settings: &ControlSettings, step_s: f64) -> usize {
    (settings.delay_s / step_s).round() as usize
}

/// The feedback that acts before the first one arrives: none.
fn late(human: &Human, settings: &ControlSettings, step_s: f64) -> VecDeque<Vec<f64>> {
    VecDeque::from(vec![vec![0.0; human.model.coordinates().len()]; delay_steps(settings, step_s)])
}

/// The impedance of every coordinate; zero where nothing drives it.
fn impedances(human: &Human, joints: &[usize], settings: &ControlSettings) -> Vec<Impedance> {
    let of = |c: usize| {
        let (share, movement) = share_of(human, c);
        let is_driven = if joints.contains(&c) { 1.0 } else { 0.0 };
        let stiffness = is_driven * settings.stiffness * share * size_of(human);
        let strength = StrengthCurve::of_movement(movement, human.model.mass(), human.build.height);
        let sign = human.model.anatomy().meaning(CoordinateId(c)).map_or(1.0, |meaning| meaning.sign);
        let strength = if sign < 0.0 { strength.reversed() } else { strength };
        Impedance { stiffness, damping: stiffness * settings.damping_s, strength }
    };
    (0..human.model.coordinates().len()).map(of).collect()
}

/// The levers of coordinates that turn a foot or its toes.
fn levers(human: &Human) -> Vec<Option<(usize, f64)>> {
    let anatomy = human.model.anatomy();
    let of = |id: CoordinateId| {
        let meaning = anatomy.meaning(id)?;
        let share = match meaning.movement {
            Movement::AnkleDorsiflexion => ANKLE_LEVER,
            Movement::ToeExtension => TOE_LEVER,
            _ => return None,
        };
        let foot = usize::from(meaning.side? == Side::Left);
        Some((foot, share * human.dimensions.foot_length))
    };
    human.model.coordinate_ids().map(of).collect()
}
