//! What footfalls are found from: the points of the soles, the mass centre, and the force that the body needs.
//!
//! | code              | symbol | unit  | meaning                                                              |
//! | `carried`         | f      | -     | u · F / (m g): what the ground carries, share of the weight          |
//! | `pressure_line`   | a, b   | m, -  | the centre of pressure at the height h is a + h b                    |
//!
//! F = Σ mᵢ (aᵢ - g), M = Σ rᵢ × mᵢ (aᵢ - g) + Iᵢ αᵢ + ωᵢ × Iᵢ ωᵢ about the world's origin (Newton, Euler), and from the statics of
//! [`crate::ground`]: p = (u × M + h F) / (u · F).

use crate::ground::upward;
use crate::kinematics::{BodyMotion, Trajectory, each_body_motion};
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model, Side};
use crate::motion::TimeGrid;
use crate::spatial::{STANDARD_GRAVITY, Vec3};

/// The three points of one sole, frame by frame.
pub(super) struct FootPath {
    pub(super) side: Side,
    /// Rear, ball and tip [m], one entry a frame.
    pub(super) places: Vec<[Vec3; 3]>,
    /// Their velocities [m/s].
    pub(super) velocities: Vec<[Vec3; 3]>,
}

/// Everything that the search reads.
pub(super) struct Signals {
    pub(super) grid: TimeGrid,
    /// Direction against gravity.
    pub(super) up: Vec3,
    /// √(g L), L from hip to ground: the speed against which walking speeds are counted [m/s].
    pub(super) pace: f64,
    /// √(L / g): the time that goes with it [s].
    pub(super) swing_s: f64,
    pub(super) feet: Vec<FootPath>,
    /// Velocity of the mass centre [m/s].
    pub(super) center_velocity: Vec<Vec3>,
    /// Vertical force that the body needs, share of its weight.
    pub(super) carried: Vec<f64>,
    /// Line of the force: a and b.
    pub(super) pressure_line: Vec<[Vec3; 2]>,
}

impl Signals {
    /// Of the soles that there are.
    pub(super) fn new(model: &Model, trajectory: &Trajectory, soles: &BySide<Option<Sole>>) -> Signals {
        let (up, grid) = (upward(model), trajectory.grid());
        let gravity = Some(model.gravity().norm()).filter(|g| *g > f64::MIN_POSITIVE).unwrap_or(STANDARD_GRAVITY);
        let leg = model.stature().leg_length_m;
        let mut signals = Signals {
            grid,
            up,
            pace: (gravity * leg).sqrt(),
            swing_s: (leg / gravity).sqrt(),
            feet: Vec::new(),
            center_velocity: Vec::with_capacity(grid.frames),
            carried: Vec::with_capacity(grid.frames),
            pressure_line: Vec::with_capacity(grid.frames),
        };
        let standing: Vec<Sole> = soles.values().flatten().copied().collect();
        for (side, _) in soles.iter().filter(|(_, sole)| sole.is_some()) {
            let (places, velocities) = (Vec::with_capacity(grid.frames), Vec::with_capacity(grid.frames));
            signals.feet.push(FootPath { side, places, velocities });
        }
        let weight = model.mass() * gravity;
        each_body_motion(model, trajectory, |_, bodies| {
            for (sole, path) in standing.iter().zip(&mut signals.feet) {
                path.push(sole, bodies);
            }
            let whole = Needed::of(model, bodies);
            let vertical = whole.force.dot(&up);
            signals.center_velocity.push(whole.momentum / model.mass());
            signals.carried.push(vertical / weight);
            signals.pressure_line.push([up.cross(&whole.moment) / vertical, whole.force / vertical]);
        });
        signals
    }

    /// The part of a vector across the direction against gravity.
    pub(super) fn level(&self, v: Vec3) -> Vec3 {
        v - self.up * v.dot(&self.up)
    }

    /// Height of a point of a foot [m].
    pub(super) fn height(&self, foot: &FootPath, frame: usize, point: usize) -> f64 {
        foot.places[frame][point].dot(&self.up)
    }

    /// The lowest point of a foot, and its height [m].
    pub(super) fn lowest(&self, foot: &FootPath, frame: usize) -> (usize, f64) {
        let heights = [0, 1, 2].map(|point| self.height(foot, frame, point));
        let point = (1..3).fold(0, |low, point| if heights[point] < heights[low] { point } else { low });
        (point, heights[point])
    }

    /// Where the force meets the level at a height [m]; not finite in flight.
    pub(super) fn pressure(&self, frame: usize, height: f64) -> Vec3 {
        let [a, b] = self.pressure_line[frame];
        a + b * height
    }

    /// Frames in a time, at least one.
    pub(super) fn frames_in(&self, time_s: f64) -> usize {
        ((time_s / self.grid.step_s).round() as usize).clamp(1, self.grid.frames.max(1))
    }
}

impl FootPath {
    fn push(&mut self, sole: &Sole, bodies: &[BodyMotion]) {
        let moves = sole.points.map(|point| {
            let body = &bodies[point.body.index()];
            let place = body.pose.place(point.place);
            (place, body.twist.velocity_at(place - body.center))
        });
        self.places.push(moves.map(|(place, _)| place));
        self.velocities.push(moves.map(|(_, velocity)| velocity));
    }
}

/// Momentum of the whole body, and the force and moment about the world's origin that its change needs.
struct Needed {
    momentum: Vec3,
    force: Vec3,
    moment: Vec3,
}

impl Needed {
    fn of(model: &Model, bodies: &[BodyMotion]) -> Needed {
        let mut whole = Needed { momentum: Vec3::zeros(), force: Vec3::zeros(), moment: Vec3::zeros() };
        for (body, motion) in model.bodies().iter().zip(bodies) {
            let (mass, rotation) = (body.inertia.mass(), motion.pose.rotation);
            let force = (motion.acceleration.linear - model.gravity()) * mass;
            let inertia = rotation * body.inertia.about_center() * rotation.transpose();
            let omega = motion.twist.angular;
            whole.momentum += motion.twist.linear * mass;
            whole.force += force;
            whole.moment +=
                motion.center.cross(&force) + inertia * motion.acceleration.angular + omega.cross(&(inertia * omega));
        }
        whole
    }
}
