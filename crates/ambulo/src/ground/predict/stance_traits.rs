//! Traits of a stance on which the mean errors of the estimate depend ([`super::stance_errors`]): numbers that are 0 in
//! a usual stance of an adult.
//!
//! | trait   | value                                | bounds               |
//! |---------|--------------------------------------|----------------------|
//! | descent | x of [`super::strike_descent`]       | -0.15 to 0.85        |
//! | haste   | (V* - 0.45) / 0.1, V* = V / √(g L)   | V* from 0.45 to 0.65 |
//! | leg     | (L - 0.85 m) / 0.1 m                 | L from 0.6 to 1 m    |
//!
//! They were chosen by the errors of people whose laboratory was left out (docs/GROUND_FORCES.md). Beyond the bounds,
//! where nobody was measured, a trait keeps the value that it has at the bound.

use super::strike_descent::{CenterVelocity, Strike, descents};
use crate::ground::footfalls::{Footfall, Footfalls};
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::Model;
use crate::motion::TimeGrid;
use crate::spatial::Vec3;

/// Number of traits.
pub const TRAITS: usize = 3;
/// Index of haste among them.
pub const HASTE: usize = 1;
/// Values of the traits of a stance, in the order of the table.
pub type Traits = [f64; TRAITS];

/// V* and L where the traits are 0, their units, least and most.
const SPEED: [f64; 4] = [0.45, 0.1, 0.45, 0.65];
const LEG_M: [f64; 4] = [0.85, 0.1, 0.6, 1.0];

/// The traits of a stance by descent, dimensionless speed and leg length [m].
pub fn traits(descent: f64, speed: f64, leg_m: f64) -> Traits {
    let relative = |x: f64, [usual, unit, least, most]: [f64; 4]| (x.clamp(least, most) - usual) / unit;
    [descent, relative(speed, SPEED), relative(leg_m, LEG_M)]
}

/// The traits of each stance, in the order of the footfalls.
#[must_use]
pub(crate) fn stance_traits(model: &Model, trajectory: &Trajectory, footfalls: &Footfalls) -> Vec<Traits> {
    let masses: Vec<f64> = model.bodies().iter().map(|body| body.inertia.mass()).collect();
    let whole: f64 = masses.iter().sum();
    let mut velocity = Vec::with_capacity(trajectory.grid().frames);
    each_body_motion(model, trajectory, |_, bodies| {
        let momentum: Vec3 = bodies.iter().zip(&masses).map(|(body, mass)| body.twist.linear * *mass).sum();
        velocity.push(momentum / whole);
    });
    let strikes: Vec<Strike> =
        footfalls.falls.iter().map(|fall| Strike { time_s: fall.strike_s, height_m: fall.floor_height_m }).collect();
    let (grid, leg_m) = (trajectory.grid(), model.stature().leg_length_m);
    let leg_speed_m_s = (leg_m * model.gravity().norm()).sqrt();
    let found = descents(&strikes, CenterVelocity { grid, velocity: &velocity }, model.up(), leg_speed_m_s);
    let speed = |fall: &Footfall| level_speed(fall, grid, &velocity, model.up()) / leg_speed_m_s;
    footfalls.falls.iter().zip(found).map(|(fall, descent)| traits(descent, speed(fall), leg_m)).collect()
}

/// Level speed of the mass centre relative to the floor, mean over a stance [m/s].
fn level_speed(fall: &Footfall, grid: TimeGrid, velocity: &[Vec3], up: Vec3) -> f64 {
    let frame = |time: f64| (((time - grid.start_s) / grid.step_s).round().max(0.0) as usize).min(grid.frames - 1);
    let [from, to] = [fall.strike_s.unwrap_or(grid.start_s), fall.off_s.unwrap_or(grid.end_s())].map(frame);
    let own = &velocity[from..=to.max(from)];
    let drift = own.iter().sum::<Vec3>() / own.len() as f64 - fall.floor_velocity;
    (drift - up * drift.dot(&up)).norm()
}
