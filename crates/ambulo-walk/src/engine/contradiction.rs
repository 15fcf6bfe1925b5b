//! Steps whose constraints could not be satisfied: the most violated constraint, and exceeded work limits.

use super::assemble::Assembly;
use super::state::RowKey;
use super::workspace::Equations;
use super::world::World;
use crate::dynamics::Convergence;
use crate::findings::{Code, Findings};

/// A residual above this means contradictory constraints; below, slow convergence, as in stretched loops.
const CONTRADICTION: f64 = 1e-6;
/// A residual above this after all work of a step is reported: forces have eight digits below it.
const UNFINISHED: f64 = 1e-8;

/// Reports a solution that violates its constraints, or whose work was used up before it was found.
pub(super) fn report_unsatisfied(world: &World, equations: &Equations, time_s: f64, findings: &mut Findings) {
    let convergence = &equations.solution.convergence;
    if let Some(message) = contradiction(world, equations) {
        findings.report(Code::SolverNotConverged, message);
    }
    if let (true, Some(row)) = (used_up(convergence), convergence.worst) {
        let name = equations.assembly.row_name(world, row);
        report_work(
            format!(
                "at {time_s:.4} s the work of a step was used up; the residual is {:.1e}, and what is violated most is \
                 {name}",
                convergence.residual
            ),
            findings,
        );
    }
}

/// Reports the first step that used up its work; others are like it.
pub(super) fn report_work(message: String, findings: &mut Findings) {
    if !findings.has(Code::SolverWorkLimit) {
        findings.report(Code::SolverWorkLimit, message);
    }
}

fn used_up(convergence: &Convergence) -> bool {
    convergence.gave_up && convergence.residual > UNFINISHED
}

fn contradiction(world: &World, equations: &Equations) -> Option<String> {
    let convergence = &equations.solution.convergence;
    let contradicts = convergence.residual > CONTRADICTION || convergence.residual.is_nan();
    let name = equations.assembly.row_name(world, convergence.worst.filter(|_| contradicts)?);
    Some(format!("the constraints contradict each other; the one violated most is {name}"))
}

impl Equations {
    /// Counts the iterations of the last solution, and keeps what it violates.
    pub(super) fn note(&mut self, world: &World) {
        self.iterations += self.solution.convergence.iterations;
        if self.contradiction.is_none() {
            self.contradiction = contradiction(world, self);
        }
    }
}

impl Assembly {
    /// Description of a row for messages.
    pub(super) fn row_name(&self, world: &World, row: usize) -> String {
        let Some(group) = self.graph.groups.iter().position(|g| g.rows.contains(&row)) else {
            return format!("row {row}");
        };
        let coordinate = |joint: usize, k: usize| {
            let joint = &world.joints[joint];
            format!("`{}` ({})", joint.name, joint.kind.coordinate_names()[k])
        };
        match self.keys[group] {
            RowKey::Closure(closure) => format!("the closure `{}`", world.closures[closure].name),
            RowKey::Drive(j, k) => format!("the drive of {}", coordinate(j, k)),
            RowKey::Motor(j, k) => format!("the motor of {}", coordinate(j, k)),
            RowKey::Friction(j, k) => format!("the friction of {}", coordinate(j, k)),
            RowKey::LowerLimit(j, k) => format!("the lower limit of {}", coordinate(j, k)),
            RowKey::UpperLimit(j, k) => format!("the upper limit of {}", coordinate(j, k)),
            RowKey::Contact(a, b, _) | RowKey::SoftFriction(a, b, _) => {
                let name = |surface: usize| world.owner_name(world.surfaces[surface].owner);
                format!("the contact of `{}` with `{}`", name(a), name(b))
            }
        }
    }
}
