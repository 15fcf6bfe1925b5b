//! The start of a world: velocities that agree with its joints and closed loops, and surfaces that overlap.
//!
//! Given velocities v⁻ may contradict the joints, J v⁻ ≠ 0, or the rates of their drives. The nearest ones by mass
//! minimise ½ (v - v⁻)ᵀ M (v - v⁻):
//!
//!   M v = M v⁻ + Jᵀ λ          J v = 0, or the rate of a drive
//!
//! as if the joints were closed by an impulse. Without drives this removes the energy ½ (v⁻ - v)ᵀ M (v⁻ - v), so it
//! never adds any (Carnot). Both integrators begin there.
//!
//! Pinned by: tests/scene_start.rs

use super::assemble::{Assembly, Prescribed, Span, twist};
use super::joint::JointKind;
use super::state::{WorldState, rates};
use super::touch::{ObstaclePoses, TouchWorkspace, obstacle_motion};
use super::world::{ContactLaw, Owner, World};
use crate::dynamics::{GraphSolution, GraphWorkspace, LinkError, Six, SolverSettings, solve_graph};
use crate::findings::{Code, Findings};
use std::collections::BTreeMap;

/// Velocities agree if the energy of their change is below this share of the kinetic energy: the solver's 1e-10,
/// squared, is far below it, and a rate that was given with five digits is not.
const AGREES: f64 = 1e-12;
/// A change of the velocities is reported if its energy is above this share of the kinetic energy: a change of one per
/// cent. Smaller ones are rounding of the numbers in a file.
const NOTABLE: f64 = 1e-4;
/// Rigid surfaces that overlap by more than this are pushed apart visibly [m].
const DEEP_M: f64 = 1e-3;
/// Soft surfaces that overlap by more than this begin with a large force [m]: the sole of a standing person yields a
/// third as much, that of a man of 120 kg who walks fast 0.028 m.
const DEEP_SOFT_M: f64 = 0.03;
/// Duration of the instant for which moving obstacles are placed [s].
const INSTANT_S: f64 = 1e-9;

/// Prepares a state for its first [`step`](super::step()): velocities that contradict joints, drives or closed loops
/// are replaced by the nearest ones by mass, and surfaces that overlap deeply are reported. Scenes do this by
/// themselves.
///
/// # Errors
/// Joints that do not form trees.
pub fn start(
    world: &World,
    state: &mut WorldState,
    solver: &SolverSettings,
    findings: &mut Findings,
) -> Result<(), LinkError> {
    project_velocities(world, state, solver, findings)?;
    report_overlaps(world, state, findings);
    Ok(())
}

fn project_velocities(
    world: &World,
    state: &mut WorldState,
    solver: &SolverSettings,
    findings: &mut Findings,
) -> Result<(), LinkError> {
    let mut assembly = Assembly::default();
    let prescribed = Prescribed::at(world, state.time_s);
    assembly.fill(world, state, &prescribed, &Vec::new(), Span::instant(0.0));
    assembly.keep_loops(world, state);
    keep_drives(world, state, &mut assembly);
    let mut solution = GraphSolution::default();
    solve_graph(&assembly.graph, solver, &mut GraphWorkspace::default(), &mut solution)?;
    let energy = |motion: &Six, body: usize| 0.5 * motion.dot(&assembly.graph.bodies[body].times(motion));
    let given = |body: usize| {
        let (w, v) = (state.twists[body].angular, state.twists[body].linear);
        Six::new(w.x, w.y, w.z, v.x, v.y, v.z)
    };
    let bodies = 0..world.bodies.len();
    let before: f64 = bodies.clone().map(|body| energy(&given(body), body)).sum();
    let after: f64 = bodies.clone().map(|body| energy(&solution.motions[body], body)).sum();
    let changes: Vec<f64> = bodies.map(|body| energy(&(given(body) - solution.motions[body]), body)).collect();
    let change: f64 = changes.iter().sum();
    if !change.is_finite() || change <= AGREES * before.max(after) {
        return Ok(());
    }
    for (now, motion) in state.twists.iter_mut().zip(&solution.motions) {
        *now = twist(motion);
    }
    if change <= NOTABLE * before.max(after) {
        return Ok(());
    }
    let most = (0..changes.len()).fold(0, |most, body| if changes[body] > changes[most] { body } else { most });
    findings.report(
        Code::StartContradictory,
        format!(
            "the initial velocities contradict the joints, most at `{}`; the nearest ones by mass are used: kinetic \
             energy {after:.4} J instead of {before:.4} J",
            world.bodies[most].name
        ),
    );
    Ok(())
}

/// Driven coordinates move at the rates of their drives.
fn keep_drives(world: &World, state: &WorldState, assembly: &mut Assembly) {
    for (number, joint) in world.joints.iter().enumerate().filter(|(_, joint)| joint.follows.is_none()) {
        let mut offset = Six::zeros();
        let now = rates(state, joint, &state.frames(joint));
        for (k, acting) in joint.coordinates.iter().enumerate() {
            let Some(drive) = &acting.drive else { continue };
            // The rate of a driven rotation vector is not an angular velocity.
            let turns = matches!(joint.kind, JointKind::Ball | JointKind::Free) && k < 3;
            let rate = if turns { now[k] } else { drive.signal.at(state.time_s)[1] };
            offset.axpy(rate, assembly.directions.at(number, k), 1.0);
        }
        assembly.graph.terms.offset[joint.child] = offset;
    }
}

/// Reports pairs of surfaces that overlap deeply, with the deepest point of each.
fn report_overlaps(world: &World, state: &WorldState, findings: &mut Findings) {
    let (mut obstacles, mut touch) = (ObstaclePoses::new(), TouchWorkspace::default());
    obstacle_motion(world, state.time_s, INSTANT_S, &mut obstacles);
    touch.detect(world, state, &obstacles, 0.0);
    let law = |surface: usize| world.materials[world.surfaces[surface].material].law;
    let mut deepest: BTreeMap<(Owner, Owner), f64> = BTreeMap::new();
    for contact in &touch.touches {
        let (a, b) = contact.surfaces;
        let rigid = law(a) == ContactLaw::Rigid && law(b) == ContactLaw::Rigid;
        let depth = -contact.at.gap;
        if depth > if rigid { DEEP_M } else { DEEP_SOFT_M } {
            let owners = (world.surfaces[a].owner, world.surfaces[b].owner);
            let worst = deepest.entry(owners).or_default();
            *worst = worst.max(depth);
        }
    }
    for ((a, b), depth) in deepest {
        let (a, b) = (world.owner_name(a), world.owner_name(b));
        findings.report(
            Code::ContactDeepOverlap,
            format!("`{a}` and `{b}` overlap by {:.1} mm at the start; they are pushed apart", 1e3 * depth),
        );
    }
}
