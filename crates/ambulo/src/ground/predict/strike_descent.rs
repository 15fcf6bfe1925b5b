//! How fast the mass centre moves downwards at a foot strike: the kinetic energy that the strike takes up.
//!
//!   x = (min(v, v₁)² - v₀²) / v₁²      v = max(0, (climb - ż) / √(g L))
//!
//! ż is the upward velocity of the mass centre at the strike, climb the rate at which the floor rises from the previous
//! stance to this one, L the length from hip to ground. x is about 0 in a usual strike and at most 0.85. The faster the
//! descent, the later is the vertical force than the motion of the skin shows, and the prior of usual strikes: the
//! errors of a stance are a mean curve and x times a second curve ([`super::stance_errors`]). It explained most of the
//! errors of subjects and laboratories left out, among 27 quantities of the motion of a stance. The others include
//! walking speed, pitch of the foot, speed of the heel, lean of the shank and flexion of the knee.

use crate::motion::TimeGrid;
use crate::spatial::Vec3;

/// v₀, the descent in a usual strike [√(g L)]: 0.08 m/s of an adult.
pub const USUAL: f64 = 0.027;
/// v₁, the descent from which on it makes no further difference [√(g L)]: 0.21 m/s of an adult.
pub const MOST: f64 = 0.07;

/// Time and height at which a stance begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strike {
    /// `None` where the recording begins with the foot on the ground [s].
    pub time_s: Option<f64>,
    /// Height of the floor [m].
    pub height_m: f64,
}

/// Velocity of the mass centre [m/s], one entry per frame.
#[derive(Debug, Clone, Copy)]
pub struct CenterVelocity<'a> {
    /// Times of the frames.
    pub grid: TimeGrid,
    /// Velocity of the mass centre, one entry per frame [m/s].
    pub velocity: &'a [Vec3],
}

/// x of each stance, in order of time; 0 where the recording does not show the strike.
pub fn descents(strikes: &[Strike], center: CenterVelocity<'_>, up: Vec3, leg_speed_m_s: f64) -> Vec<f64> {
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
