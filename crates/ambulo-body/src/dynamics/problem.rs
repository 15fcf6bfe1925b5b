//! Common parts of the solvers of a constraint graph: settings, problem and line search.
//!
//! For a motion a + s Δ along a step Δ, the derivative of the convex function φ of Newton's method (see `proximal`) is
//! φ'(s) = Δᵀ(A a - b) + s Δᵀ A Δ - (J Δ)ᵀ λ(s). It rises with s, since λ falls with J a.

use super::block::Six;
use super::constraint::ConstraintGraph;
use super::departure::Departures;
use super::elimination::EliminationWorkspace;
use super::elimination_order::Elimination;

/// Number of halvings of the interval in which the slope changes sign.
const HALVINGS: usize = 30;
/// A slope below this share of the first counts as zero.
const LEVEL: f64 = 0.1;

/// Solver of loop closures and contacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Newton steps on an augmented Lagrangian. The initial guess affects the result only by rounding; redundant rows
    /// get the least-squares forces.
    #[default]
    Newton,
    /// Conjugate gradient, as in the paper of 1997. Starts at the guess; redundant rows get the forces nearest to it,
    /// without a guess the least-squares forces.
    ConjugateGradient,
}

/// Settings of the constraint solver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolverSettings {
    /// Solver method.
    pub method: Method,
    /// Largest accepted residual; see [`Convergence::residual`](super::Convergence::residual).
    pub tolerance: f64,
    /// Maximum number of tree solves. Newton needs few in every scene; conjugate gradient up to a multiple of the
    /// number of rows.
    pub max_iterations: usize,
}

impl Default for SolverSettings {
    fn default() -> Self {
        SolverSettings { method: Method::Newton, tolerance: 1e-10, max_iterations: 100 }
    }
}

/// A constraint graph, prepared for a solver.
pub(super) struct Problem<'a> {
    pub(super) graph: &'a ConstraintGraph,
    pub(super) elimination: &'a Elimination,
    pub(super) settings: SolverSettings,
    pub(super) blocks: &'a [Option<(usize, bool)>],
    pub(super) factors: &'a mut EliminationWorkspace,
    pub(super) departures: &'a mut Departures,
}

impl Problem<'_> {
    /// Loads the inertias of bodies and coordinates, to be factored.
    pub(super) fn begin(&mut self) {
        self.factors.begin(self.elimination, &self.graph.bodies);
        for body in 0..self.graph.links.len() {
            for coordinate in self.elimination.coordinates_of(body) {
                let rotor = self.graph.rotors[coordinate];
                self.factors.add_to_coordinate(self.elimination, coordinate, body, rotor);
            }
        }
    }
}

/// Δᵀ(A a - b) and Δᵀ A Δ, for (motions, coordinates) of a and Δ.
pub(super) fn inertial_slope(
    graph: &ConstraintGraph,
    (motions, coordinates): (&[Six], &[f64]),
    (step, step_coordinates): (&[Six], &[f64]),
) -> [f64; 2] {
    let [mut constant, mut linear] = [0.0; 2];
    for (i, d) in step.iter().enumerate() {
        let body = &graph.bodies[i];
        constant += d.dot(&(body.times(&motions[i]) - graph.wrenches[i]));
        linear += d.dot(&body.times(d));
    }
    for (k, d) in step_coordinates.iter().enumerate() {
        constant += d * (graph.rotors[k] * coordinates[k] - graph.efforts[k]);
        linear += d * d * graph.rotors[k];
    }
    [constant, linear]
}

/// The share of the step at which φ is about minimal: 1, unless the slope there is above `steep` times the first.
pub(super) fn lowest(start: f64, steep: f64, mut slope: impl FnMut(f64) -> f64) -> f64 {
    if slope(1.0) <= steep * start.abs() {
        return 1.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        let here = slope(middle);
        if here.abs() <= LEVEL * start.abs() {
            return middle;
        }
        if here > 0.0 { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}
