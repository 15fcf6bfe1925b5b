//! Closures that a step has left open, closed where the bodies now stand.
//!
//! The displacements of the step's own factor suffice while bodies turn little in a step. Where loops whip round, they do
//! not: then M δ = Jᵀ ν, J δ = -error is solved anew at the present places, a few times (Gauss and Newton, the least mass
//! moved).

use super::assemble::{Prescribed, Span, twist};
use super::impulse::advance;
use super::projection::{closure_errors, share_of_displacements};
use super::state::{RowKey, WorldState};
use super::step::{StepSettings, StepWorkspace};
use super::world::World;
use crate::dynamics::{LinkError, Six, solve_graph};

/// A closure is closed within this [m, rad].
const CLOSED: f64 = 1e-7;
/// A closure that is farther apart at the start of a step has not come together yet [m, rad].
const FAR: f64 = 1e-4;
/// Rounds, at most.
const ROUNDS: usize = 8;

/// Largest error of a closure [m, rad].
fn largest_error(world: &World, state: &WorldState, number: usize) -> f64 {
    closure_errors(world, state, number).1.iter().fold(0.0, |m: f64, e| m.max(e.abs()))
}

/// Whether a closure is still on its way together, as when a hand has just been taken: such are left to close at their pace.
pub(super) fn closing(world: &World, state: &WorldState) -> bool {
    (0..world.closures.len()).any(|number| world.closures[number].active && largest_error(world, state, number) > FAR)
}

impl StepWorkspace {
    pub(super) fn close(
        &mut self,
        world: &World,
        state: &mut WorldState,
        prescribed: &Prescribed,
        settings: &StepSettings,
    ) -> Result<(), LinkError> {
        let h = self.step_s;
        for _ in 0..ROUNDS {
            if !self.open(world, state) {
                break;
            }
            let (assembly, solution) = &mut self.later;
            assembly.fill(world, state, prescribed, &Vec::new(), Span { h, instant: false });
            let graph = &mut assembly.graph;
            graph.wrenches.fill(Six::zeros());
            graph.efforts.fill(0.0);
            graph.terms.offset.fill(Six::zeros());
            let closures = assembly.keys.iter().map(|key| matches!(key, RowKey::Closure(_)));
            let mut held = closures.clone();
            graph.groups.retain(|_| held.next().unwrap_or(false));
            self.targets.clear();
            self.targets.resize(graph.rows.len(), 0.0);
            let numbers = assembly.keys.iter().filter_map(|key| match key {
                RowKey::Closure(number) => Some(*number),
                _ => None,
            });
            for (group, number) in graph.groups.iter().zip(numbers) {
                for (row, error) in group.rows.clone().zip(closure_errors(world, state, number).1) {
                    (graph.rows[row].target, self.targets[row]) = (-error, -error);
                }
            }
            solution.lambda.clear();
            solve_graph(graph, &settings.solver, &mut self.closing, solution)?;
            let share = share_of_displacements(&self.targets, &[], &solution.motions);
            for (pose, displacement) in state.poses.iter_mut().zip(&solution.motions) {
                advance(pose, &twist(displacement), share);
            }
            self.seat(world, state, prescribed, true);
        }
        Ok(())
    }

    /// Whether a closure of the step is open.
    fn open(&self, world: &World, state: &WorldState) -> bool {
        self.assembly.keys.iter().any(|key| match key {
            RowKey::Closure(number) => largest_error(world, state, *number) > CLOSED,
            _ => false,
        })
    }
}
