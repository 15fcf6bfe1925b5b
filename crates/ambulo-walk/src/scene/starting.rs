//! Initial velocities of bodies, from the file or from the rates of their joints.

use super::file::SceneFile;
use crate::dynamics::Six;
use crate::engine::joint::Frames;
use crate::engine::world::World;
use crate::spatial::{Pose, Twist, Vec3};

/// Sets the twists of the file's bodies; twists of figures are already set. `rates` are the coordinate rates of the
/// file's joints, which come first in the world.
pub(super) fn start_moving(world: &mut World, file: &SceneFile, rates: &[Vec<f64>]) {
    let joint_of = world.joint_of_body();
    for body in parents_first(world, file.bodies.len()) {
        let body_entry = &file.bodies[body];
        let (mut angular, mut linear) = (Vec3::zeros(), Vec3::zeros());
        if let Some(number) = joint_of[body] {
            let relative = Relative::of(world, number, &rates[number]);
            angular = relative.angular;
            // A given angular velocity also moves the mass centre.
            linear = relative.at_joint + body_entry.angular_velocity.unwrap_or(angular).cross(&relative.to_center);
        }
        world.bodies[body].twist = Twist {
            angular: body_entry.angular_velocity.unwrap_or(angular),
            linear: body_entry.velocity.unwrap_or(linear),
        };
    }
}

/// The motion of a joint's child.
struct Relative {
    angular: Vec3,
    /// Velocity of the origin of C.
    at_joint: Vec3,
    /// Vector from the origin of C to the child's mass centre.
    to_center: Vec3,
}

impl Relative {
    fn of(world: &World, number: usize, rates: &[f64]) -> Relative {
        let joint = &world.joints[number];
        let place = |body: usize| world.bodies[body].pose;
        let parent = joint.parent.map_or(Pose::IDENTITY, place);
        let frames =
            Frames { parent: parent * joint.parent_from_joint, child: place(joint.child) * joint.child_from_joint };
        let origin = frames.child.translation;
        let carried = joint.parent.map_or(Twist::ZERO, |p| {
            let twist = world.bodies[p].twist;
            Twist { linear: twist.velocity_at(origin - parent.translation), ..twist }
        });
        // About the origin of C itself.
        let directions = joint.kind.directions(&frames, &Vec3::zeros());
        let mut own = Six::zeros();
        for (rate, direction) in rates.iter().zip(&directions) {
            own.axpy(*rate, direction, 1.0);
        }
        Relative {
            angular: carried.angular + Vec3::new(own[0], own[1], own[2]),
            at_joint: carried.linear + Vec3::new(own[3], own[4], own[5]),
            to_center: place(joint.child).translation - origin,
        }
    }
}

/// The file's bodies, each after its parent.
fn parents_first(world: &World, count: usize) -> Vec<usize> {
    let joint_of = world.joint_of_body();
    let parent = |body: usize| joint_of[body].and_then(|j| world.joints[j].parent).filter(|p| *p < count);
    let mut known = vec![false; count];
    let mut order = Vec::with_capacity(count);
    for body in 0..count {
        let mut path = Vec::new();
        let mut at = Some(body);
        while let Some(next) = at.filter(|next| !known[*next]) {
            known[next] = true;
            path.push(next);
            at = parent(next);
        }
        order.extend(path.into_iter().rev());
    }
    order
}
