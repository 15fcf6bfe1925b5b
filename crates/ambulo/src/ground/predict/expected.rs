//! What a foot probably carries, before the motion's forces are looked at: mean and deviation of each component over a stance.
//!
//! * Walking: upward and forward force of [`StanceCurves`].
//! * Running: upward force a half sine, F = (π/2) m g T / t_c sin(π u) with T from strike to strike of either foot and t_c the contact:
//!   the impulse of a step carries the body for a step (Morin, Dalleau, Kyröläinen, Jeannin, Belli 2005; unverified).
//! * Standing: the weight, shared evenly by the feet that stand.
//!
//! The force leans towards the mass centre: sideways, and forward where no curve is known, F_h = k F_v × lever / height.
//! Moments are those that a centre of pressure beside its path makes, and the free moment; their mean is zero.

use super::geometry::Geometry;
use super::stance_curves::{AtSpeed, Expected, StanceCurves};
use super::stances::{Gait, Measure, Stance};
use super::weights::Weights;
use crate::spatial::Vec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Parts of the load of a foot, in the axes of its stance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Component {
    /// Force forward, up, to the right.
    Force(usize),
    /// Moment about the path of the centre of pressure: about forward, up, right.
    Moment(usize),
}

impl Component {
    pub(super) const ALL: [Component; 6] = [
        Component::Force(0),
        Component::Force(1),
        Component::Force(2),
        Component::Moment(0),
        Component::Moment(1),
        Component::Moment(2),
    ];
}

/// Stature for which lengths of [`Weights`] are given [m].
const STATURE_M: f64 = 1.75;
/// Deviation of the upward force of a run and of somebody who stands, share of the mean and of the weight.
const RUN_SPREAD: f64 = 0.25;
const STAND_SPREAD: f64 = 0.3;
/// Deviation of forces along the ground that lean towards the mass centre [body weights].
const LEAN_SPREAD: f64 = 0.12;
/// Upward force at which sideways deviations are whole [body weights].
const WHOLE_LOAD: f64 = 0.6;

/// What is expected of one stance.
pub(super) struct Expectation<'a> {
    pub(super) stance: &'a Stance,
    curves: AtSpeed<'a>,
    weights: &'a Weights,
    measure: &'a Measure,
    /// From this strike to the next of either foot [s].
    step_s: f64,
    /// Other stances, which share the weight of somebody who stands.
    others: Vec<[f64; 2]>,
}

impl<'a> Expectation<'a> {
    pub(super) fn new(
        stance: &'a Stance,
        all: &[Stance],
        curves: &'a StanceCurves,
        weights: &'a Weights,
        measure: &'a Measure,
    ) -> Expectation<'a> {
        let next = all.iter().map(|s| s.start_s - stance.start_s).filter(|t| *t > 0.0).fold(f64::INFINITY, f64::min);
        let before = all.iter().map(|s| stance.start_s - s.start_s).filter(|t| *t > 0.0).fold(f64::INFINITY, f64::min);
        let step_s = if next.is_finite() { next } else { before };
        let others = all.iter().filter(|s| s.side != stance.side).map(|s| [s.start_s, s.end_s]).collect();
        let step_s = if step_s.is_finite() { step_s } else { 1.5 * stance.duration_s() };
        Expectation { stance, curves: stance.curves(curves), weights, measure, step_s, others }
    }

    /// Upward force [body weights].
    pub(super) fn vertical(&self, time: f64) -> Expected {
        let own = self.stance.own_phase(time);
        match self.stance.gait {
            Gait::Walk => {
                let phase = self.weights.own_phase * own + (1.0 - self.weights.own_phase) * self.stance.phase(time);
                let found = self.curves.vertical(phase);
                Expected { mean: found.mean, deviation: found.deviation * self.weights.spread[1] }
            }
            Gait::Run => {
                let peak = FRAC_PI_2 * (self.step_s / self.stance.duration_s()).clamp(0.5, 4.0);
                let mean = peak * (PI * own).sin();
                Expected { mean, deviation: RUN_SPREAD * peak * rise(own, 0.1) }
            }
            Gait::Stand => {
                let shared = self.others.iter().any(|o| (o[0]..=o[1]).contains(&time));
                let mean = if shared { 0.5 } else { 1.0 };
                Expected { mean, deviation: STAND_SPREAD }
            }
        }
    }

    /// Mean and deviation of a component [N or N.m]. `lever` leads from the expected centre of pressure to the mass centre [m].
    pub(super) fn of(&self, component: Component, time: f64, lever: Vec3) -> Expected {
        let vertical = self.vertical(time);
        let own = self.stance.own_phase(time);
        let loaded = (vertical.mean / WHOLE_LOAD).clamp(0.0, 1.0);
        let size = self.measure.height_m / STATURE_M;
        let height = lever.dot(&self.measure.up).max(0.1 * self.measure.height_m);
        let lean = |axis: Vec3| self.weights.sideways_lever * vertical.mean * lever.dot(&axis) / height;
        let found = match component {
            Component::Force(1) => vertical,
            Component::Force(0) if self.stance.gait == Gait::Walk => {
                let found = self.curves.fore_aft(self.stance.phase(time));
                Expected { mean: found.mean, deviation: found.deviation * self.weights.spread[0] }
            }
            Component::Force(0) => Expected {
                mean: lean(self.stance.forward),
                deviation: LEAN_SPREAD * vertical.mean.max(0.2) * rise(own, 0.1),
            },
            Component::Force(_) => {
                Expected { mean: lean(self.stance.right), deviation: self.weights.sideways_spread * loaded }
            }
            Component::Moment(1) => Expected { mean: 0.0, deviation: self.weights.free_moment_spread * size * loaded },
            // Along the foot the centre of pressure turns the load about the right, across it about forward.
            Component::Moment(axis) => {
                let spread = self.weights.center_spread[usize::from(axis == 0)] * size;
                Expected { mean: 0.0, deviation: spread * vertical.mean.max(0.0) }
            }
        };
        let weight = self.measure.weight_n;
        // A curve that cannot deviate at all cannot follow what an end of the stance found early or late asks for.
        let least = if matches!(component, Component::Force(_)) { 0.004 } else { 0.000_2 };
        Expected { mean: found.mean * weight, deviation: found.deviation.max(least) * weight }
    }
}

/// From 0 at both ends of the stance to 1 after a share of it.
fn rise(phase: f64, share: f64) -> f64 {
    (phase.min(1.0 - phase) / share).clamp(0.05, 1.0)
}

/// How far the model's mass centre may be off, on this person [m].
pub(super) fn mass_center_spread(weights: &Weights, measure: &Measure) -> f64 {
    weights.mass_center_spread * measure.height_m / STATURE_M
}

/// Where the mass centre stands against a point.
pub(super) fn lever(geometry: &Geometry, frame: usize, center: Vec3) -> Vec3 {
    geometry.center[frame] - center
}
