//! Signals for detecting footfalls: the points of the soles, the mass centre, and the total ground force.
//!
//! | code              | symbol | unit  | meaning                                                              |
//! | `carried`         | f      | -     | u · F / (m g): vertical ground force, share of body weight           |
//! | `pressure_line`   | a, b   | m, -  | the centre of pressure at the height h is a + h b                    |
//!
//! F = Σ mᵢ (aᵢ - g), M = Σ rᵢ × mᵢ (aᵢ - g) + Iᵢ αᵢ + ωᵢ × Iᵢ ωᵢ about the world's origin (Newton, Euler), and from the statics of
//! [`crate::ground`]: p = (u × M + h F) / (u · F).

use crate::kinematics::{BodyMotion, Trajectory, each_body_motion};
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model, Side};
use crate::motion::TimeGrid;
use crate::spatial::{STANDARD_GRAVITY, Vec3};

/// The three points of one sole over time.
pub(super) struct FootPath {
    pub(super) side: Side,
    /// Rear, ball and tip [m], one entry per frame.
    pub(super) places: Vec<[Vec3; 3]>,
    /// Their velocities [m/s].
    pub(super) velocities: Vec<[Vec3; 3]>,
}

/// All signals of the detection.
pub(super) struct Signals {
    pub(super) grid: TimeGrid,
    /// Direction against gravity.
    pub(super) up: Vec3,
    /// √(g L), L from hip to ground: unit of walking speed [m/s].
    pub(super) leg_speed: f64,
    /// √(L / g): unit of time [s].
    pub(super) leg_time_s: f64,
    pub(super) feet: Vec<FootPath>,
    /// Velocity of the mass centre [m/s].
    pub(super) center_velocity: Vec<Vec3>,
    /// Vertical ground force that the motion requires, share of body weight.
    pub(super) carried: Vec<f64>,
    /// Line of action of the force: a and b.
    pub(super) pressure_line: Vec<[Vec3; 2]>,
}

impl Signals {
    /// Computes the signals; a foot without a sole is left out.
    pub(super) fn new(model: &Model, trajectory: &Trajectory, soles: &BySide<Option<Sole>>) -> Signals {
        let (up, grid) = (model.up(), trajectory.grid());
        let gravity = Some(model.gravity().norm()).filter(|g| *g > f64::MIN_POSITIVE).unwrap_or(STANDARD_GRAVITY);
        let leg = model.stature().leg_length_m;
        let mut signals = Signals {
            grid,
            up,
            leg_speed: (gravity * leg).sqrt(),
            leg_time_s: (leg / gravity).sqrt(),
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
            let whole = WholeBody::of(model, bodies);
            let vertical = whole.force.dot(&up);
            signals.center_velocity.push(whole.momentum / model.mass());
            signals.carried.push(vertical / weight);
            signals.pressure_line.push([up.cross(&whole.moment) / vertical, whole.force / vertical]);
        });
        signals
    }

    /// The horizontal part of a vector.
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

    /// Point where the line of action meets the horizontal plane at a height [m]; not finite in flight.
    pub(super) fn pressure(&self, frame: usize, height: f64) -> Vec3 {
        let [a, b] = self.pressure_line[frame];
        a + b * height
    }

    /// Number of frames in a time, at least one.
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

/// Momentum of the whole body, and the ground force and moment about the world's origin that its motion requires.
struct WholeBody {
    momentum: Vec3,
    force: Vec3,
    moment: Vec3,
}

impl WholeBody {
    fn of(model: &Model, bodies: &[BodyMotion]) -> WholeBody {
        let mut whole = WholeBody { momentum: Vec3::zeros(), force: Vec3::zeros(), moment: Vec3::zeros() };
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
