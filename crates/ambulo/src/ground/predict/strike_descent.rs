//! How fast the mass centre moves downwards at a foot strike: the kinetic energy that the strike takes up.
//!
//!   x = (min(v, v₁)² - v₀²) / v₁²      v = max(0, (climb - ż) / √(g L))
//!
//! ż is the upward velocity of the mass centre at the strike, climb the rate at which the floor rises from the previous stance to this one, L the
//! length from hip to ground. x is about 0 in a usual strike and at most 0.85. The faster the descent, the later is the vertical force than
//! the motion of the skin shows, and the prior of usual strikes: the errors of a stance are a mean curve and x times a second curve
//! ([`super::stance_errors`]). Of 27 quantities of the motion of a stance (walking speed, duration of the stance, pitch of the foot and its rate, speed
//! of the heel, lean of the shank, flexion of the knee and its rate, force of the whole body and others) it explained most of the errors of subjects and laboratories left out.

use crate::ground::footfalls::Footfalls;
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::Model;
use crate::motion::TimeGrid;
use crate::spatial::Vec3;

/// v₀, the descent in a usual strike, and v₁, from which on it makes no further difference [√(g L)]: 0.08 and 0.21 m/s of an adult.
const USUAL: f64 = 0.027;
const MOST: f64 = 0.07;

/// When and at which height a stance begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Strike {
    /// `None` where the recording begins with the foot on the ground [s].
    pub(super) time_s: Option<f64>,
    /// Of the floor [m].
    pub(super) height_m: f64,
}

/// Velocity of the mass centre [m/s], one entry per frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct CenterVelocity<'a> {
    pub(super) grid: TimeGrid,
    pub(super) velocity: &'a [Vec3],
}

/// x of each stance, in order of time; 0 where the recording does not show the strike.
pub(super) fn descents(strikes: &[Strike], center: CenterVelocity<'_>, up: Vec3, leg_speed_m_s: f64) -> Vec<f64> {
    let before = |i: usize| strikes[..i].iter().rev().find_map(|strike| Some((strike.time_s?, strike.height_m)));
    let at = |i: usize| -> Option<f64> {
        let Strike { time_s, height_m } = strikes[i];
        let time_s = time_s.filter(|time| (center.grid.start_s..=center.grid.end_s()).contains(time))?;
        let climb = before(i).map_or(0.0, |(time_before_s, height_before_m)| {
            (height_m - height_before_m) / (time_s - time_before_s).max(center.grid.step_s)
        });
        Some(descent((climb - center.upwards(time_s, up)) / leg_speed_m_s))
    };
    (0..strikes.len()).map(|i| at(i).unwrap_or(0.0)).collect()
}

/// x for a dimensionless velocity of descent.
fn descent(downwards: f64) -> f64 {
    (downwards.clamp(0.0, MOST).powi(2) - USUAL.powi(2)) / MOST.powi(2)
}

impl CenterVelocity<'_> {
    /// Upward velocity at a time inside the motion [m/s], linear between frames.
    fn upwards(&self, time_s: f64, up: Vec3) -> f64 {
        let last = self.velocity.len() - 1;
        let place = ((time_s - self.grid.start_s) / self.grid.step_s).clamp(0.0, last as f64);
        let (frame, share) = (place as usize, place.fract());
        let of = |frame: usize| self.velocity[frame.min(last)].dot(&up);
        of(frame) + (of(frame + 1) - of(frame)) * share
    }
}

/// How much more than usual the mass centre descends at the strike of each stance, from 0 (as usual) to 0.85, negative if it descends less; 0
/// where the recording does not show the strike. The formula is at the top of `strike_descent.rs`.
#[must_use]
pub(crate) fn strike_descents(model: &Model, trajectory: &Trajectory, footfalls: &Footfalls) -> Vec<f64> {
    let masses: Vec<f64> = model.bodies().iter().map(|body| body.inertia.mass()).collect();
    let whole: f64 = masses.iter().sum();
    let mut velocity = Vec::with_capacity(trajectory.grid().frames);
    each_body_motion(model, trajectory, |_, bodies| {
        let momentum: Vec3 = bodies.iter().zip(&masses).map(|(body, mass)| body.twist.linear * *mass).sum();
        velocity.push(momentum / whole);
    });
    let strike =
        |fall: &crate::ground::footfalls::Footfall| Strike { time_s: fall.strike_s, height_m: fall.floor_height_m };
    let strikes: Vec<Strike> = footfalls.falls.iter().map(strike).collect();
    let leg_speed_m_s = (model.stature().leg_length_m * model.gravity().norm()).sqrt();
    descents(&strikes, CenterVelocity { grid: trajectory.grid(), velocity: &velocity }, model.up(), leg_speed_m_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Descents of strikes at 0.5 s on these heights, one step of 0.5 s before, with an upward velocity [m/s].
    fn of(upwards: f64, heights: [f64; 2]) -> f64 {
        let grid = TimeGrid { start_s: 0.0, step_s: 0.01, frames: 101 };
        let velocity = vec![Vec3::y() * upwards; 101];
        let strikes = [0, 1].map(|i| Strike { time_s: Some(0.5 * i as f64), height_m: heights[i] });
        descents(&strikes, CenterVelocity { grid, velocity: &velocity }, Vec3::y(), 3.0)[1]
    }

    #[test]
    fn a_usual_descent_counts_nothing_a_faster_one_with_its_energy_and_none_beyond_the_most() {
        let speed = 3.0;
        assert!(of(-USUAL * speed, [0.0; 2]).abs() < 1e-12);
        let whole = 1.0 - (USUAL / MOST).powi(2);
        assert!((of(-MOST * speed, [0.0; 2]) - whole).abs() < 1e-12 && (of(-9.0, [0.0; 2]) - whole).abs() < 1e-12);
        assert!((of(0.4, [0.0; 2]) + (USUAL / MOST).powi(2)).abs() < 1e-12, "rising counts as no descent");
    }

    #[test]
    fn on_a_ramp_the_descent_is_relative_to_the_floor() {
        // 0.1 m/s of descent with a floor that falls by 0.1 m/s is none.
        let level = of(0.0, [0.0; 2]);
        assert!((of(-0.1, [0.2, 0.15]) - level).abs() < 1e-12 && of(-0.1, [0.2, 0.2]) > level);
    }

    #[test]
    fn where_the_recording_does_not_show_the_strike_it_is_as_usual() {
        let grid = TimeGrid { start_s: 0.0, step_s: 0.01, frames: 11 };
        let velocity = [Vec3::y() * -1.0; 11];
        let strikes = [None, Some(-0.2), Some(0.4)].map(|time_s| Strike { time_s, height_m: 0.0 });
        assert_eq!(descents(&strikes, CenterVelocity { grid, velocity: &velocity }, Vec3::y(), 3.0), [0.0; 3]);
    }
}
