//! Prior of a stance: mean and standard deviation of each component of a foot's load, before the forces of the motion
//! are used.
//!
//! * Walking: vertical and fore-aft force of [`StanceCurves`].
//! * Running: the vertical force rises faster than it falls, F = (π/2) m g T / t_c (sin(π u) + κ sin(2π u)) with T from
//!   strike to strike of either foot and t_c the contact time: the impulse of a step supports the body for a step
//!   (Morin, Dalleau, Kyröläinen, Jeannin, Belli 2005; unverified, with κ = 0). κ does not change the impulse.
//! * Standing: the body weight, shared equally by the feet on the ground.
//!
//! The force leans towards the mass centre: sideways, and forward where there is no curve, F_h = k F_v × lever /
//! height. In walking a foot pushes outwards briefly after its strike, as in all 16 stances of six straight trials
//! (0.008 to 0.058 body weights). Moments are the free moment, and moments of a centre of pressure away from its
//! expected path; their mean is zero.

use super::fitted_parameters::FittedParameters;
use super::stance_curves::{AtSpeed, MeanAndDeviation, StanceCurves};
use super::stances::{BodyScale, GaitType, Stance};
use crate::model::Side;
use crate::numerics::elementary::{exp, sin};
use crate::spatial::Vec3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Components of the load of a foot, in the axes of its stance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Component {
    /// Force forward, up, to the right.
    Force(usize),
    /// Moment about the expected centre of pressure: about forward, up, right.
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

/// Smallest deviations of forces [body weights] and moments [body weights × m].
const LEAST_SPREAD: [f64; 2] = [0.004, 0.000_2];
/// κ, the second harmonic of the vertical force in running as a share of the first. Mean curves on plates have 0.26,
/// 0.21 and 0.18 at 2.5, 3.5 and 4.5 m/s (thirteen runners of one laboratory) and 0.16 (one runner of another; measured
/// during development).
const RUN_SKEW: f64 = 0.2;
/// Deviation of the vertical force in running (share of the half sine's peak): of 0.05, 0.07, 0.1, 0.15 and 0.25 it
/// gave the smallest mean error of both laboratories (measured during development).
const RUN_SPREAD: f64 = 0.07;
/// Deviation of the vertical force in standing (share of body weight).
const STAND_SPREAD: f64 = 0.3;
/// Deviation of the fore-aft force in running and standing [body weights].
const LEAN_SPREAD: f64 = 0.12;
/// Deviation of the centre of pressure along the foot on stairs [m at a stature of 1.75 m]: there the shank leans for
/// other reasons than the foot rolls over, and a review on stairs found the expected path 51 mm too far forward. With
/// this deviation the moment of the whole body decides.
const STAIRS_CENTER_SPREAD: f64 = 0.05;
/// Vertical force from which on the lateral deviation has its full size [body weights].
const WHOLE_LOAD: f64 = 0.6;

/// Prior of one stance.
pub(super) struct Expectation<'a> {
    pub(super) stance: &'a Stance,
    curves: AtSpeed<'a>,
    parameters: &'a FittedParameters,
    body_scale: &'a BodyScale,
    /// Time from this strike to the next one of either foot [s].
    step_s: f64,
    /// Overlapping stances of the other foot.
    others: Vec<[f64; 2]>,
}

impl<'a> Expectation<'a> {
    pub(super) fn new(
        stance: &'a Stance,
        all: &[Stance],
        curves: &'a StanceCurves,
        parameters: &'a FittedParameters,
        body_scale: &'a BodyScale,
    ) -> Expectation<'a> {
        let next = all.iter().map(|s| s.start_s - stance.start_s).filter(|t| *t > 0.0).fold(f64::INFINITY, f64::min);
        let before = all.iter().map(|s| stance.start_s - s.start_s).filter(|t| *t > 0.0).fold(f64::INFINITY, f64::min);
        let step_s = if next.is_finite() { next } else { before };
        let meets = |s: &&Stance| s.side != stance.side && s.start_s < stance.end_s && s.end_s > stance.start_s;
        let others = all.iter().filter(meets).map(|s| [s.start_s, s.end_s]).collect();
        let step_s = if step_s.is_finite() { step_s } else { 1.5 * stance.duration_s() };
        Expectation { stance, curves: stance.curves(curves), parameters, body_scale, step_s, others }
    }

    /// Vertical force [body weights].
    pub(super) fn vertical(&self, time: f64) -> MeanAndDeviation {
        let own = self.stance.elapsed_share(time);
        match self.stance.gait {
            GaitType::Walk => {
                let found = self.curves.vertical(own);
                MeanAndDeviation { mean: found.mean, deviation: found.deviation * self.parameters.spread[1] }
            }
            GaitType::Run => {
                let peak = FRAC_PI_2 * (self.step_s / self.stance.duration_s()).clamp(0.5, 4.0);
                let mean = peak * (sin(PI * own) + RUN_SKEW * sin(TAU * own));
                MeanAndDeviation { mean, deviation: RUN_SPREAD * peak * rise(own, 0.1) }
            }
            GaitType::Stand => {
                let shared = self.others.iter().any(|o| (o[0]..=o[1]).contains(&time));
                let mean = if shared { 0.5 } else { 1.0 };
                MeanAndDeviation { mean, deviation: STAND_SPREAD }
            }
        }
    }

    /// Means and deviations of all components [N or N.m], in the order of [`Component::ALL`]. `lever` leads from the
    /// expected centre of pressure to the mass centre [m].
    pub(super) fn all(&self, time: f64, lever: Vec3) -> [MeanAndDeviation; 6] {
        let BodyScale { up, weight_n, height_m, .. } = *self.body_scale;
        let (stance, parameters) = (self.stance, self.parameters);
        let vertical = self.vertical(time);
        let own = stance.elapsed_share(time);
        let loaded = (vertical.mean / WHOLE_LOAD).clamp(0.0, 1.0);
        let height = lever.dot(&up).max(0.1 * height_m);
        let lean = |axis: Vec3| parameters.sideways_lever * vertical.mean * lever.dot(&axis) / height;
        let forward = match stance.gait {
            GaitType::Walk => {
                let found = self.curves.fore_aft(stance.phase(time));
                MeanAndDeviation { deviation: found.deviation * parameters.spread[0], ..found }
            }
            GaitType::Run | GaitType::Stand => MeanAndDeviation {
                mean: lean(stance.forward),
                deviation: LEAN_SPREAD * vertical.mean.max(0.2) * rise(own, 0.1),
            },
        };
        let outwards = if stance.side == Side::Right { 1.0 } else { -1.0 };
        let push = if stance.gait == GaitType::Walk { parameters.strike_push * push_after_strike(own) } else { 0.0 };
        let right = MeanAndDeviation {
            mean: lean(stance.right) + outwards * push,
            deviation: parameters.sideways_spread * loaded,
        };
        let about_zero = |deviation: f64| MeanAndDeviation { mean: 0.0, deviation: deviation * self.body_scale.size() };
        // A centre of pressure displaced along the foot makes a moment about the right axis, across the foot about the
        // forward axis.
        let [along, across] = parameters.center_spread;
        let along = if stance.on_stairs { along.max(STAIRS_CENTER_SPREAD) } else { along };
        let [along, across] = [along, across].map(|spread| spread * vertical.mean.max(0.0));
        let all = [
            forward,
            vertical,
            right,
            about_zero(across),
            about_zero(parameters.free_moment_spread * loaded),
            about_zero(along),
        ];
        // Without a smallest deviation a curve could not adapt to a strike or off that was detected early or late.
        std::array::from_fn(|c| MeanAndDeviation {
            mean: all[c].mean * weight_n,
            deviation: all[c].deviation.max(LEAST_SPREAD[c / 3]) * weight_n,
        })
    }
}

/// A pulse: 0 at the strike, 1 at a twentieth of the stance, then decaying.
fn push_after_strike(phase: f64) -> f64 {
    const HIGHEST_AT: f64 = 0.05;
    let x = phase / HIGHEST_AT;
    x * exp(0.5 * (1.0 - x * x))
}

/// A ramp from (almost) 0 at both ends of the stance to 1 after a share of it.
fn rise(phase: f64, share: f64) -> f64 {
    (phase.min(1.0 - phase) / share).clamp(0.05, 1.0)
}
