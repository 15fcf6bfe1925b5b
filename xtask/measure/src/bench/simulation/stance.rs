//! The standing human: time per step, its stance, and the violation of the contact laws.
//!
//! The violations are computed from the states before and after a step: v is the velocity of the contact point, g the
//! gap before the step of length h, F the force, W the weight and G = |gravity| h the change of speed in free fall
//! during a step. A violation is the smallest change of force (relative to W) or velocity (relative to G) that would
//! satisfy the law:
//!
//! | name              | violation                                                              |
//! |-------------------|------------------------------------------------------------------------|
//! | `complementarity` | min(F_n/W, (v_n + max(g, 0)/h)/G): no pulling, no penetration, no force at a distance |
//! | `cone`            | (F_t - mu F_n)/W if above zero                                           |
//! | `slip`            | F_t/W - P(F_t/W - v_t/G), P onto the disc mu F_n/W: sticking, or friction opposite to slip |
//! | `balance`         | (sum of F - m (a - gravity))/W, a from velocities of all mass centres    |

use super::super::timing::Timing;
use super::run::{DURATION_S, STEP_S, Simulation};
use ambulo::simulation::{ContactForce, Owner, StepSettings, World, WorldState};
use ambulo::spatial::{Vec3, Wrench};
use std::collections::BTreeMap;

/// Steps until it stands, which are not timed: it falls 3 mm at the start.
const LANDING: usize = 1000;
/// Steps timed together.
const BATCH: usize = 10;
/// Last part of the time, in which the stance is measured, as the peers' programs do it.
const WATCHED: f64 = 0.1;
/// A contact sticks when it carries more than this part of the weight, and friction stays below this part of its limit.
const CARRIES: f64 = 1e-3;
const WITHIN_CONE: f64 = 0.95;
/// The pelvis is the first body; its mass centre lies so high above its origin [m].
const PELVIS: usize = 0;
const PELVIS_CENTER_M: f64 = 0.04;
/// Gaps below this count as closed [m], as in the simulator: over a step, it is 1e-5 of the speed of free fall.
const CLOSED_M: f64 = 1e-10;
/// A push on the pelvis [N] from `LANDING` on, for so many steps; then it is watched for some more.
const PUSH_N: Vec3 = Vec3::new(150.0, 100.0, 0.0);
const PUSHED: usize = 200;
const AFTER_PUSH: usize = 1000;

/// All results.
pub(super) struct Standing {
    /// CPU time of one step once it stands [us].
    pub(super) step_us: Timing,
    pub(super) stance: Stance,
    pub(super) pushed: Pushed,
}

/// The stance of the human.
#[derive(Debug, Default)]
pub(super) struct Stance {
    /// Tree solves and factorisations of a step, means over the last tenth.
    pub(super) iterations: f64,
    pub(super) factorizations: f64,
    /// Upward force, mean over the last tenth, and the weight [N].
    pub(super) contact_force_n: f64,
    pub(super) weight_n: f64,
    pub(super) pelvis_height_m: f64,
    pub(super) contacts: usize,
    /// Deepest sphere over the last tenth [m].
    pub(super) penetration_m: f64,
    /// Fastest sticking contact [m/s], longest way of one [m], both over the last tenth.
    pub(super) slip_m_per_s: f64,
    pub(super) creep_m: f64,
    pub(super) joint_error_m: f64,
    /// Largest over all steps: falling, landing, standing.
    pub(super) left: Left,
}

/// The effect of a push on the pelvis.
#[derive(Debug, Default)]
pub(super) struct Pushed {
    pub(super) left: Left,
    /// Most contacts that slipped at once, fewest that touched.
    pub(super) slipping: usize,
    pub(super) touching: usize,
}

/// Violations of the contact laws; see above.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Left {
    pub(super) complementarity: f64,
    pub(super) cone: f64,
    pub(super) slip: f64,
    pub(super) balance: f64,
}

/// Measures everything.
pub(super) fn measure(world: &World) -> Result<Standing, String> {
    Ok(Standing { step_us: time(world)?, stance: watch(world)?, pushed: push(world)? })
}

fn steps() -> usize {
    (DURATION_S / STEP_S).round() as usize
}

fn weight(world: &World) -> f64 {
    world.mass() * world.gravity.norm()
}

fn simulation(world: &World) -> Simulation<'_> {
    Simulation::new(world, StepSettings { step_s: STEP_S, ..StepSettings::default() })
}

/// CPU time of a step, without any checks.
fn time(world: &World) -> Result<Timing, String> {
    let mut simulation = simulation(world);
    simulation.time(LANDING, |_| {})?;
    let batches = (steps() - LANDING) / BATCH;
    Ok(Timing::of((0..batches).map(|_| simulation.time(BATCH, |_| {})).collect::<Result<_, _>>()?))
}

/// Repeats the motion and checks every step.
fn watch(world: &World) -> Result<Stance, String> {
    let mut found = Stance { weight_n: weight(world), ..Stance::default() };
    let mut simulation = simulation(world);
    let watched = (WATCHED * steps() as f64).round() as usize;
    let mut ways: BTreeMap<(usize, usize), Vec3> = BTreeMap::new();
    for number in 0..steps() {
        let before = simulation.state.clone();
        let convergence = simulation.step()?;
        let contacts = simulation.forces().contacts;
        found.left.look(world, &before, &simulation.state, &contacts);
        found.joint_error_m = found.joint_error_m.max(simulation.joint_error());
        if number < steps() - watched {
            continue;
        }
        found.iterations += convergence.iterations as f64 / watched as f64;
        found.factorizations += convergence.factorizations as f64 / watched as f64;
        found.contact_force_n += contacts.iter().map(|c| upward(world, c)).sum::<f64>() / watched as f64;
        found.penetration_m = found.penetration_m.max(penetration(world, &simulation.state));
        for contact in contacts.iter().filter(|c| sticks(world, c)) {
            let velocity = along(contact, velocity(world, &before, &simulation.state, contact));
            found.slip_m_per_s = found.slip_m_per_s.max(velocity.norm());
            *ways.entry(contact.surfaces).or_default() += velocity * STEP_S;
        }
        found.contacts = contacts.iter().filter(|c| c.normal_force > 0.0).count();
    }
    found.creep_m = ways.values().map(Vec3::norm).fold(0.0, f64::max);
    found.pelvis_height_m = simulation.state.poses[PELVIS].place(Vec3::new(0.0, 0.0, -PELVIS_CENTER_M)).z;
    Ok(found)
}

/// The laws while the human is pushed.
fn push(world: &World) -> Result<Pushed, String> {
    let mut loaded = world.clone();
    loaded.bodies[PELVIS].load = Wrench { moment: Vec3::zeros(), force: PUSH_N };
    let mut standing = simulation(world);
    standing.time(LANDING, |_| {})?;
    let mut simulation = standing.in_world(&loaded);
    let mut found = Pushed { touching: usize::MAX, ..Pushed::default() };
    for number in 0..PUSHED + AFTER_PUSH {
        if number == PUSHED {
            simulation = simulation.in_world(world);
        }
        let before = simulation.state.clone();
        simulation.step()?;
        let contacts = simulation.forces().contacts;
        found.left.look(simulation.world, &before, &simulation.state, &contacts);
        let pushing =
            |sticking: bool| contacts.iter().filter(|c| c.normal_force > 0.0 && sticks(world, c) == sticking).count();
        found.slipping = found.slipping.max(pushing(false));
        found.touching = found.touching.min(pushing(true) + pushing(false));
    }
    Ok(found)
}

impl Left {
    fn look(&mut self, world: &World, before: &WorldState, after: &WorldState, contacts: &[ContactForce]) {
        let (weight, fall) = (weight(world), world.gravity.norm() * STEP_S);
        // NaN must not be ignored, as `max` would do.
        let raise = |worst: &mut f64, now: f64| *worst = if now.is_nan() { f64::INFINITY } else { worst.max(now) };
        let mut total = Vec3::zeros();
        for contact in contacts {
            total += contact.force * sign(world, contact);
            let velocity = velocity(world, before, after, contact);
            let gap = if contact.gap > CLOSED_M { contact.gap } else { 0.0 };
            let approach = (contact.normal.dot(&velocity) * sign(world, contact) + gap / STEP_S) / fall;
            raise(&mut self.complementarity, (contact.normal_force / weight).min(approach).abs());
            let rubbing = along(contact, contact.force * sign(world, contact)) / weight;
            let limit = friction(world, contact) * contact.normal_force / weight;
            raise(&mut self.cone, (rubbing.norm() - limit).max(0.0));
            raise(&mut self.slip, (rubbing - onto_disc(rubbing - along(contact, velocity) / fall, limit)).norm());
        }
        let momentum = |state: &WorldState| -> Vec3 {
            world.bodies.iter().zip(&state.twists).map(|(body, twist)| twist.linear * body.mass).sum()
        };
        let loads: Vec3 = world.bodies.iter().map(|body| body.load.force + world.gravity * body.mass).sum();
        let needed = (momentum(after) - momentum(before)) / STEP_S - loads;
        raise(&mut self.balance, (total - needed).norm() / weight);
    }

    /// The largest of them.
    pub(super) fn worst(&self) -> f64 {
        [self.complementarity, self.cone, self.slip, self.balance].into_iter().fold(0.0, f64::max)
    }
}

fn onto_disc(v: Vec3, radius: f64) -> Vec3 {
    let length = v.norm();
    if length > radius { v * (radius.max(0.0) / length) } else { v }
}

/// The body of a contact with the floor.
fn body(world: &World, contact: &ContactForce) -> usize {
    let (first, second) = contact.surfaces;
    match (world.surfaces[first].owner, world.surfaces[second].owner) {
        (Owner::Body(body), _) | (_, Owner::Body(body)) => body,
        _ => PELVIS,
    }
}

/// Whether force and normal are those of the body (1) or of the floor (-1).
fn sign(world: &World, contact: &ContactForce) -> f64 {
    if matches!(world.surfaces[contact.surfaces.0].owner, Owner::Body(_)) { 1.0 } else { -1.0 }
}

fn upward(world: &World, contact: &ContactForce) -> f64 {
    contact.force.z * sign(world, contact)
}

/// Velocity after the step of the point that touched at its start.
fn velocity(world: &World, before: &WorldState, after: &WorldState, contact: &ContactForce) -> Vec3 {
    let body = body(world, contact);
    after.twists[body].velocity_at(contact.point - before.poses[body].translation)
}

/// The part along the surfaces.
fn along(contact: &ContactForce, v: Vec3) -> Vec3 {
    v - contact.normal * contact.normal.dot(&v)
}

fn friction(world: &World, contact: &ContactForce) -> f64 {
    let of = |surface: usize| world.materials[world.surfaces[surface].material].friction;
    (of(contact.surfaces.0) * of(contact.surfaces.1)).sqrt()
}

fn sticks(world: &World, contact: &ContactForce) -> bool {
    let rubbing = along(contact, contact.force).norm();
    contact.normal_force > CARRIES * weight(world)
        && rubbing < WITHIN_CONE * friction(world, contact) * contact.normal_force
}

/// How far the lowest sphere is below the floor [m]; 0 above it.
fn penetration(world: &World, state: &WorldState) -> f64 {
    let depth = |surface: &ambulo::simulation::Surface| match (surface.owner, surface.shape.radius()) {
        (Owner::Body(body), Some(radius)) => radius - state.poses[body].place(surface.owner_from_shape.translation).z,
        _ => 0.0,
    };
    world.surfaces.iter().map(depth).fold(0.0, f64::max)
}
