//! Signals for detecting footfalls: the points of the soles, the mass centre, and the total ground force.
//!
//! | code              | symbol | unit  | meaning                                                              |
//! | `carried`         | f      | -     | u · F / (m g): vertical ground force, share of body weight           |
//! | `pressure_line`   | a, b   | m, -  | the centre of pressure at the height h is a + h b                    |
//!
//! F = Σ mᵢ (aᵢ - g), M = Σ rᵢ × mᵢ (aᵢ - g) + Iᵢ αᵢ + ωᵢ × Iᵢ ωᵢ about the world's origin (Newton, Euler), and from
//! the statics of [`crate::ground`]: p = (u × M + h F) / (u · F).

use crate::kinematics::{BodyMotion, Trajectory, each_body_motion};
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model, Side};
use crate::motion::TimeGrid;
use crate::spatial::{STANDARD_GRAVITY, Vec3, Wrench};

/// The three points of one sole over time.
pub(super) struct FootPath {
    pub(super) side: Side,
    /// Rear, ball and tip [m], one entry per frame.
    pub(super) places: Vec<[Vec3; 3]>,
    /// Their velocities [m/s].
    pub(super) velocities: Vec<[Vec3; 3]>,
}

/// All signals of the detection.
pub(in crate::ground) struct Signals {
    pub(super) grid: TimeGrid,
    /// Direction against gravity.
    pub(super) up: Vec3,
    /// Body weight [N].
    pub(super) weight_n: f64,
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

/// Contribution of one frame to the signals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::ground) struct SignalFrame {
    /// Places [m] and velocities [m/s] of the points of each sole; `None` for a foot without a sole.
    feet: BySide<Option<[[Vec3; 3]; 2]>>,
    center_velocity: Vec3,
    /// Total ground force [N] and moment about the world's origin [N.m].
    pub(in crate::ground) total: Wrench,
}

impl SignalFrame {
    /// Computes the signals from the motion of all bodies.
    pub(in crate::ground) fn of(model: &Model, soles: &BySide<Option<Sole>>, bodies: &[BodyMotion]) -> SignalFrame {
        let whole = WholeBody::of(model, bodies);
        SignalFrame {
            feet: BySide::from_fn(|side| soles[side].as_ref().map(|sole| sole_motion(sole, bodies))),
            center_velocity: whole.momentum / model.mass(),
            total: Wrench { force: whole.force, moment: whole.moment },
        }
    }
}

/// Places and velocities of the points of a sole.
fn sole_motion(sole: &Sole, bodies: &[BodyMotion]) -> [[Vec3; 3]; 2] {
    let moves = sole.points.map(|point| {
        let body = &bodies[point.body.index()];
        let place = body.pose.place(point.place);
        (place, body.twist.velocity_at(place - body.center))
    });
    [moves.map(|(place, _)| place), moves.map(|(_, velocity)| velocity)]
}

impl Signals {
    /// Computes the signals; a foot without a sole is left out.
    pub(super) fn new(model: &Model, trajectory: &Trajectory, soles: &BySide<Option<Sole>>) -> Signals {
        let mut signals = Signals::empty(model, trajectory.grid(), soles);
        each_body_motion(model, trajectory, |_, bodies| signals.push(&SignalFrame::of(model, soles, bodies)));
        signals
    }

    /// Signals with room for the frames of a grid.
    pub(in crate::ground) fn empty(model: &Model, grid: TimeGrid, soles: &BySide<Option<Sole>>) -> Signals {
        let gravity = Some(model.gravity().norm()).filter(|g| *g > f64::MIN_POSITIVE).unwrap_or(STANDARD_GRAVITY);
        let leg = model.stature().leg_length_m;
        let path = |side: Side| FootPath {
            side,
            places: Vec::with_capacity(grid.frames),
            velocities: Vec::with_capacity(grid.frames),
        };
        Signals {
            grid,
            up: model.up(),
            weight_n: model.mass() * gravity,
            leg_speed: (gravity * leg).sqrt(),
            leg_time_s: (leg / gravity).sqrt(),
            feet: soles.iter().filter(|(_, sole)| sole.is_some()).map(|(side, _)| path(side)).collect(),
            center_velocity: Vec::with_capacity(grid.frames),
            carried: Vec::with_capacity(grid.frames),
            pressure_line: Vec::with_capacity(grid.frames),
        }
    }

    /// Adds the next frame.
    pub(in crate::ground) fn push(&mut self, frame: &SignalFrame) {
        for (path, [places, velocities]) in self.feet.iter_mut().zip(frame.feet.values().flatten()) {
            path.places.push(*places);
            path.velocities.push(*velocities);
        }
        let Wrench { force, moment } = frame.total;
        let vertical = force.dot(&self.up);
        self.center_velocity.push(frame.center_velocity);
        self.carried.push(vertical / self.weight_n);
        self.pressure_line.push([self.up.cross(&moment) / vertical, force / vertical]);
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
