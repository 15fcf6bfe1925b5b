//! A part of a walk that does not repeat: a change of pace, a start or a halt, as one motion whose ends are given.
//!
//! It begins in the state of the motion before and ends in the state of the motion after, both of which repeat: a walk,
//! or standing. So no force from outside is needed at any time. The place of its end is free: the walk continues from
//! there.
//!
//! **Ends.** Five coefficients of a quintic spline determine its value and its first four derivatives at a knot. With
//! derivatives p, p', .. p'''' by knots, the coefficient c knots behind that knot is (Marsden's identity for uniform
//! knots)
//!
//!   x(c) = P(c) - P''(c)/4 + P''''(c)/30,    P(c) = p + c p' + c²/2 p'' + c³/6 p''' + c⁴/24 p''''
//!
//! because the Fourier transform of the spline is (sin(ω/2)/(ω/2))⁶. These coefficients keep their value. Value, rate
//! and acceleration are exact; the other two are differences of the acceleration.
//!
//! **The first guess** is the motion that the gait plans, changed as both motions are: with the share R of the change,
//! the share of walking w and the changes c₀, c₁ of both walks at the same phase φ,
//!
//!   q = q_gait(t) + w [(1 - R) c₀(φ) + R c₁(φ)]

use super::targets::Targets;
use super::{Builder, WalkCosts, WalkProblem, empty, forward};
use crate::contact::HuntCrossley;
use crate::dynamics::CurvedJointError;
use crate::gait::Walk;
use crate::model::Model;
use crate::model::anthropometry::{ContactSphere, Human};
use crate::optimal::layout::Span;
use crate::optimal::objective::{Bound, Quantity, Term};
use crate::optimal::problem::Problem;
use crate::optimal::solution::Solution;
use crate::toml_reader::TomlError;

/// Deviations that cost 1 at the end: forward velocity [m/s] and acceleration [m/s²]. The place there is free.
const SAME: [f64; 2] = [1e-5, 1e-3];
/// Coefficients that determine a spline and four derivatives at a knot.
const AT_A_KNOT: usize = 5;
/// Distance of the accelerations whose differences are the next two derivatives, a share of a knot interval.
const APART: f64 = 0.05;
/// Cycle of a standing figure [s], and its knot intervals.
const STANDING: (f64, usize) = (0.4, 8);

/// A motion that repeats, before or after a passage.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PassageEnd<'a> {
    /// Problem of the motion; its first guess is the gait.
    pub problem: &'a WalkProblem,
    /// Solved motion.
    pub solution: &'a Solution,
    /// Duration of its cycle [s].
    pub cycle_s: f64,
}

/// A part of a walk that does not repeat.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Passage<'a> {
    /// Number of the change of pace in the walk.
    pub change: usize,
    /// Start in the time of the walk [s].
    pub start_s: f64,
    /// Duration [s].
    pub duration_s: f64,
    /// The motions before and after it.
    pub ends: [PassageEnd<'a>; 2],
}

impl WalkProblem {
    /// The problem of a figure that stands as a walk does at a time [s] at which it stands. Its solution does not move.
    ///
    /// # Errors
    /// Does not fail: a test reads the built-in laws.
    pub fn standing(
        human: &Human,
        soles: &[ContactSphere],
        shoes: HuntCrossley,
        walk: &Walk,
        costs: &WalkCosts,
        time_s: f64,
    ) -> Result<WalkProblem, TomlError> {
        let (duration_s, knots) = STANDING;
        let empty = Problem { span: Span::Cycle, duration_s, knots, ..empty(human, soles, shoes, costs) };
        let targets = Targets::new(human, walk)?.at(&vec![time_s; empty.instants()]);
        let builder = Builder { model: &human.model, targets, terms: Vec::new() };
        let coordinates: Vec<Vec<f64>> = builder.targets.iter().map(|target| target.posture[0].clone()).collect();
        Ok(WalkProblem::guessed(builder.problem(empty, walk, costs), &coordinates))
    }

    /// The problem of a passage.
    ///
    /// # Errors
    /// Does not fail: a test reads the built-in laws.
    pub(crate) fn passage(
        human: &Human,
        soles: &[ContactSphere],
        shoes: HuntCrossley,
        walk: &Walk,
        costs: &WalkCosts,
        passage: &Passage<'_>,
    ) -> Result<WalkProblem, TomlError> {
        let half_s = 0.5 * passage.ends.iter().map(|end| end.knots_s(costs)).fold(f64::INFINITY, f64::min);
        let knots = (costs.knots as f64 * passage.duration_s / half_s).ceil() as usize;
        let empty = Problem { duration_s: passage.duration_s, knots, ..empty(human, soles, shoes, costs) };
        let times: Vec<f64> = empty.shares().iter().map(|share| passage.start_s + share * passage.duration_s).collect();
        let builder = Builder::new(human, walk, &times)?;
        let asked: Vec<Vec<f64>> = builder.targets.iter().map(|target| target.posture[0].clone()).collect();
        let coordinates = passage.guess(&human.model, walk, &times, asked);
        let mut problem = builder.problem(empty, walk, costs);
        problem.terms.retain(|term| term.name != "place");
        let mut made = WalkProblem::guessed(problem, &coordinates);
        for (end, [time_s, knot]) in passage.ends.iter().zip([[times[0], 0.0], [times[times.len() - 1], knots as f64]])
        {
            made.hold(end, walk.clock(time_s).phase.value * end.cycle_s, knot as usize);
        }
        Ok(made)
    }

    /// Holds the state of a motion at a time [s] at a knot. At the last one the forward motion has its own place.
    fn hold(&mut self, end: &PassageEnd<'_>, time_s: f64, knot: usize) {
        let (width, last) = (self.problem.model.coordinates().len(), self.problem.knots);
        let along = forward(&self.problem.model).map(|id| id.index());
        let interval_s = self.problem.duration_s / last as f64;
        let jets = end.derivatives(time_s, interval_s, width);
        for c in 0..width {
            if Some(c) == along && knot == last {
                self.arrive(jets[c][1] / interval_s, jets[c][2] / interval_s.powi(2));
                continue;
            }
            let from = if Some(c) == along { [0.0, jets[c][1], jets[c][2], jets[c][3], jets[c][4]] } else { jets[c] };
            for k in 0..AT_A_KNOT {
                let number = (knot + k) * width + c;
                self.guess[number] = coefficient(from, k as f64 - 2.0);
                self.kept.push(number);
            }
        }
    }

    /// Asks for a forward velocity [m/s] and acceleration [m/s²] at the last instant.
    fn arrive(&mut self, velocity: f64, acceleration: f64) {
        let Some(id) = forward(&self.problem.model) else { return };
        let of = [Quantity::Rate(vec![(id, 1.0)]), Quantity::Acceleration(vec![(id, 1.0)])];
        for ((quantity, value), deviation) in of.into_iter().zip([velocity, acceleration]).zip(SAME) {
            let mut targets = vec![None; self.problem.instants()];
            targets.iter_mut().next_back().into_iter().for_each(|last| *last = Some(value));
            let term = Term { name: "arrival".to_owned(), quantity, targets, deviation, bound: Bound::Near };
            self.problem.terms.push(term);
        }
    }
}

/// The coefficient of a spline c knots behind a knot, from value and derivatives by knots there.
pub fn coefficient([p, d1, d2, d3, d4]: [f64; 5], c: f64) -> f64 {
    let value = p + c * (d1 + c * (d2 / 2.0 + c * (d3 / 6.0 + c * d4 / 24.0)));
    let second = d2 + c * (d3 + c * d4 / 2.0);
    value - second / 4.0 + d4 / 30.0
}

impl Passage<'_> {
    /// The first guess at some times [s], from the posture `asked` that the gait plans.
    fn guess(&self, model: &Model, walk: &Walk, times_s: &[f64], asked: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
        let count = model.coordinates().len();
        let along = forward(model);
        let gaits = self.ends.map(|end| end.gait());
        let [mut old, mut new] = [(); 2].map(|()| [(); 3].map(|()| vec![0.0; count]));
        let (mut place, mut before_s) = (0.0, self.start_s);
        let mut guess = asked;
        for (coordinates, &time_s) in guess.iter_mut().zip(times_s) {
            place += (time_s - before_s) * walk.speed_at(0.5 * (time_s + before_s));
            before_s = time_s;
            let clock = walk.clock(time_s);
            let done = match walk.change_progress(time_s) {
                Some((change, share)) if change == self.change => share.value,
                _ => 0.0,
            };
            for ((end, gait), share) in self.ends.iter().zip(&gaits).zip([1.0 - done, done]) {
                let Ok(gait) = gait else { continue };
                let own_s = clock.phase.value * end.cycle_s;
                end.solution.write(own_s, &mut new);
                gait.write(own_s, &mut old);
                for (value, (new, old)) in coordinates.iter_mut().zip(new[0].iter().zip(&old[0])) {
                    *value += share * (new - old);
                }
            }
            if let Some(id) = along {
                coordinates[id.index()] += place;
            }
        }
        guess
    }
}

impl PassageEnd<'_> {
    /// The cycle whose half has the knots of the costs [s].
    fn knots_s(&self, costs: &WalkCosts) -> f64 {
        let Problem { duration_s, knots, .. } = self.problem.problem;
        let is_standing = (duration_s, knots) == STANDING;
        if is_standing { f64::INFINITY } else { 2.0 * duration_s * costs.knots as f64 / knots as f64 }
    }

    /// The motion that the gait plans.
    fn gait(&self) -> Result<Solution, CurvedJointError> {
        self.problem.problem.at(&self.problem.guess)
    }

    /// Value and four derivatives of every coordinate at a time [s], by intervals.
    fn derivatives(&self, time_s: f64, interval_s: f64, width: usize) -> Vec<[f64; 5]> {
        let apart_s = APART * interval_s;
        let at = |time_s: f64| {
            let mut posture = [(); 3].map(|()| vec![0.0; width]);
            self.solution.write(time_s, &mut posture);
            posture
        };
        let [before, [q, qd, qdd], after] = [time_s - apart_s, time_s, time_s + apart_s].map(at);
        let scale = interval_s * interval_s;
        let of = |c: usize| {
            let [a, b, d] = [before[2][c], qdd[c], after[2][c]].map(|acceleration| acceleration * scale);
            [q[c], qd[c] * interval_s, b, (d - a) / (2.0 * APART), (d - 2.0 * b + a) / (APART * APART)]
        };
        (0..width).map(of).collect()
    }
}
