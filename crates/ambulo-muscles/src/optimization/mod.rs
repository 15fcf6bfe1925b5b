//! Static optimisation: the controls of least effort that produce given generalised forces.
//!
//!   minimise Σ w_j |x_j|^p   subject to   C x = τ,   low_j <= x_j <= high_j
//!
//! Its Lagrangian falls apart into one problem per actuator. With the multipliers λ, one per coordinate, and y = Cᵀ λ,
//!
//!   x_j(y_j) = clip( sign(y_j) (|y_j| / (p w_j))^(1/(p - 1)) )
//!   dual:  minimise φ(λ) = Σ h_j(y_j) - λᵀτ,   ∇φ = C x - τ,   ∇²φ = Σ (dx_j/dy_j) c_j c_jᵀ   (clipped actuators: 0)
//!
//! φ is convex with a continuous gradient. It is minimised by semi-smooth Newton steps. A whole step that does not
//! halve the residual is shortened, if it passes the minimum along its direction, to where the slope has fallen to a
//! tenth. For p = 2, φ is piecewise quadratic: once the right actuators are free, a whole step is exact.
//!
//! The optimum x is unique, and so is the result: a start from the λ of the frame before saves steps and nothing else.
//!
//! Converged means: in every row, |C x - τ| <= 1e-12 (|τ| + Σ |C_j x_j|), or 1e-9 of it (1e-6 for exponents above 6)
//! if two steps in a row did not halve what is left: with exponents above 2, small controls are steep functions of y,
//! and y is a difference of prices. Coordinates that no actuator moves are left out, and their τ is unmet. If no x
//! within the bounds gives τ, the same steps minimise φ(λ) + Σ (λ - μ)²/(2 t) with a sequence of centres μ (method of
//! multipliers): x tends to the controls with the least unmet forces, which are reported.
//!
//! | code | symbol | unit | shape |
//! |---|---|---|---|
//! | `columns` | C | N.m or N per unit control | a row per coordinate, a column per actuator |
//! | `multipliers` | λ | cost per N.m or N | one per coordinate |
//! | `tau` | τ | N.m or N | one per coordinate |
//!
//! Source: the problem is that of OpenSim's StaticOptimization (StaticOptimizationTarget.cpp); its dual is the standard
//! one of a separable convex programme with linear constraints.
//! Cost: measured by tests/optimization.rs (iterations).
//! Pinned by: tests/optimization.rs (closed forms, optimality conditions, exact solutions of three recordings)

mod columns;
mod factor;
mod line;

use ambulo_body::numerics::elementary::powf;
use columns::Columns;
use factor::Factor;

/// Share of a row's terms to which the equations are met.
const CLOSE: f64 = 1e-12;
/// The same, if rounding allows no more: for exponents up to `STEEP`, and above.
const CLOSE_ENOUGH: [f64; 2] = [1e-9, 1e-6];
/// Above this exponent, x(y) is so steep at 0 that the last digit of y moves a small control visibly.
const STEEP: f64 = 6.0;
/// Steps after which a problem is taken for one without solution.
const MOST_STEPS: usize = 60;
/// Centres of the method of multipliers.
const MOST_CENTRES: usize = 12;
/// First and further weights of a centre, relative to the diagonal of the Hessian.
const WEIGHT: f64 = 1e3;
/// Below this |y|, controls with exponents other than 2 are straight, so that their slope is finite.
const LEAST_EFFORT: f64 = 1e-14;

/// What a control costs and where it may be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Actuator {
    /// Least control; minus infinity if there is none.
    pub low: f64,
    /// Greatest control; infinity if there is none.
    pub high: f64,
    /// Weight of its cost.
    pub weight: f64,
}

/// Why a problem cannot be posed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OptimizationError {
    /// An exponent without a unique optimum.
    #[error("the exponent of the activations is {found}; expected more than 1 and at most 10")]
    Exponent {
        /// Found value.
        found: f64,
    },
    /// A weight that is not positive.
    #[error("the weight of actuator {index} is {found}; expected a positive number")]
    Weight {
        /// Index of the actuator.
        index: usize,
        /// Found value.
        found: f64,
    },
    /// Bounds that allow no control.
    #[error("the controls of actuator {index} are limited to {low} to {high}; expected a range")]
    Bounds {
        /// Index of the actuator.
        index: usize,
        /// Least control.
        low: f64,
        /// Greatest control.
        high: f64,
    },
}

/// How a problem was solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Convergence {
    /// Newton steps.
    pub iterations: usize,
    /// Largest |C x - τ| of all coordinates, as a share of the terms of its row.
    pub residual: f64,
    /// Whether the equations are met.
    pub is_met: bool,
}

/// Solves the same kind of problem frame after frame. Made once; later calls allocate nothing.
#[derive(Debug, Clone)]
pub struct Optimizer {
    exponent: f64,
    actuators: Vec<Actuator>,
    columns: Columns,
    multipliers: Vec<f64>,
    effort: Vec<f64>,
    control: Vec<f64>,
    slope: Vec<f64>,
    gradient: Vec<f64>,
    terms: Vec<f64>,
    step: Vec<f64>,
    step_effort: Vec<f64>,
    diagonal: Vec<f64>,
    centre: Vec<f64>,
    factor: Factor,
}

impl Optimizer {
    /// A problem with so many coordinates and these actuators.
    ///
    /// # Errors
    /// Exponents, weights and bounds without a unique optimum: see [`OptimizationError`].
    pub fn new(coordinates: usize, actuators: Vec<Actuator>, exponent: f64) -> Result<Optimizer, OptimizationError> {
        if !(exponent > 1.0 && exponent <= 10.0) {
            return Err(OptimizationError::Exponent { found: exponent });
        }
        for (index, &Actuator { low, high, weight }) in actuators.iter().enumerate() {
            if !(weight > 0.0 && weight.is_finite()) {
                return Err(OptimizationError::Weight { index, found: weight });
            }
            if !(low <= high && low < f64::INFINITY && high > f64::NEG_INFINITY) {
                return Err(OptimizationError::Bounds { index, low, high });
            }
        }
        let [rows, columns] = [coordinates, actuators.len()].map(|count| vec![0.0; count]);
        Ok(Optimizer {
            exponent,
            columns: Columns::new(coordinates, actuators.len()),
            multipliers: rows.clone(),
            effort: columns.clone(),
            control: columns.clone(),
            slope: columns.clone(),
            gradient: rows.clone(),
            terms: rows.clone(),
            step: rows.clone(),
            step_effort: columns,
            diagonal: rows.clone(),
            centre: rows,
            factor: Factor::new(coordinates),
            actuators,
        })
    }

    /// Sets the generalised forces of an actuator at control 1 [N.m or N], as pairs of a coordinate and a force.
    ///
    /// # Panics
    /// If there is no such actuator or coordinate, or if there are more pairs than coordinates.
    pub fn set_column(&mut self, actuator: usize, forces: impl IntoIterator<Item = (usize, f64)>) {
        self.columns.set(actuator, forces);
    }

    /// Forgets the multipliers of the frame before. The result of the next frame is the same, to 1e-9.
    pub fn forget(&mut self) {
        self.multipliers.fill(0.0);
    }

    /// Controls of least effort, one per actuator; of the last [`solve`](Self::solve).
    #[must_use]
    pub fn controls(&self) -> &[f64] {
        &self.control
    }

    /// Multipliers of the coordinates: what one more N.m or N would cost.
    #[must_use]
    pub fn multipliers(&self) -> &[f64] {
        &self.multipliers
    }

    /// C x - τ of each coordinate [N.m or N]: the forces that the actuators produce beyond those that were asked.
    #[must_use]
    pub fn excess(&self) -> &[f64] {
        &self.gradient
    }

    /// Finds the controls that produce generalised forces [N.m or N], one per coordinate.
    ///
    /// # Panics
    /// If `tau` has not one entry per coordinate.
    pub fn solve(&mut self, tau: &[f64]) -> Convergence {
        assert_eq!(tau.len(), self.multipliers.len(), "generalised forces of other coordinates");
        self.set_diagonal();
        let first = self.minimise(tau, None);
        if first.is_met {
            return first;
        }
        // Perhaps nothing gives τ: the same from the beginning, near a centre that moves.
        self.multipliers.fill(0.0);
        let mut weight = WEIGHT;
        let mut iterations = first.iterations;
        let mut last = first;
        for _ in 0..MOST_CENTRES {
            self.centre.copy_from_slice(&self.multipliers);
            iterations += self.minimise(tau, Some(weight)).iterations;
            self.evaluate(tau, None);
            let residual = self.residual();
            last = Convergence { iterations, residual, is_met: residual <= self.close_enough() };
            if last.is_met {
                break;
            }
            weight *= 10.0;
        }
        last
    }

    /// Newton's method; with a weight, near `centre`.
    fn minimise(&mut self, tau: &[f64], weight: Option<f64>) -> Convergence {
        let (mut before, mut best) = ([f64::INFINITY; 2], f64::INFINITY);
        self.evaluate(tau, weight);
        for iterations in 0..MOST_STEPS {
            let residual = self.residual();
            let stalls = residual <= self.close_enough() && residual >= 0.5 * before[1] && before[1] >= 0.5 * before[0];
            if residual <= CLOSE || stalls {
                return Convergence { iterations, residual, is_met: true };
            }
            best = residual.min(best);
            before = [before[1], residual];
            self.take_step(tau, weight);
            if self.residual() > 0.5 * best {
                self.shorten_step(tau, weight);
            }
        }
        let residual = self.residual();
        Convergence { iterations: MOST_STEPS, residual, is_met: residual <= self.close_enough() }
    }

    fn close_enough(&self) -> f64 {
        CLOSE_ENOUGH[usize::from(self.exponent > STEEP)]
    }

    /// Diagonal of the Hessian with every actuator free, at control 1: the scale of each row.
    fn set_diagonal(&mut self) {
        self.diagonal.fill(0.0);
        for (j, actuator) in self.actuators.iter().enumerate() {
            let slope = 1.0 / (self.exponent * (self.exponent - 1.0) * actuator.weight);
            for (row, force) in self.columns.of(j) {
                self.diagonal[row] += slope * force * force;
            }
        }
    }

    /// Controls, their slopes and the gradient at the multipliers.
    fn evaluate(&mut self, tau: &[f64], weight: Option<f64>) {
        for (row, (gradient, terms)) in self.gradient.iter_mut().zip(&mut self.terms).enumerate() {
            (*gradient, *terms) = (-tau[row], tau[row].abs());
        }
        for (j, actuator) in self.actuators.iter().enumerate() {
            let y = self.columns.times(j, &self.multipliers);
            let (x, slope) = control(actuator, self.exponent, y);
            (self.effort[j], self.control[j], self.slope[j]) = (y, x, slope);
            for (row, force) in self.columns.of(j) {
                self.gradient[row] += force * x;
                self.terms[row] += (force * x).abs();
            }
        }
        if let Some(weight) = weight {
            for row in 0..tau.len() {
                let from_centre = self.multipliers[row] - self.centre[row];
                self.gradient[row] += from_centre * self.diagonal[row] / weight;
            }
        }
    }

    /// Largest entry of the gradient as a share of the terms of its row; rows that nothing moves do not count.
    fn residual(&self) -> f64 {
        let share = |row: usize| match self.diagonal[row] > 0.0 && self.terms[row] > 0.0 {
            true => self.gradient[row].abs() / self.terms[row],
            false => 0.0,
        };
        (0..self.terms.len()).map(share).fold(0.0, f64::max)
    }

    /// One whole Newton step.
    fn take_step(&mut self, tau: &[f64], weight: Option<f64>) {
        self.factor.clear();
        for j in 0..self.actuators.len() {
            if self.slope[j] > 0.0 {
                self.columns.add_square(j, self.slope[j], &mut self.factor);
            }
        }
        for row in 0..tau.len() {
            let scale = self.diagonal[row];
            let own = if scale > 0.0 { weight.map_or(0.0, |weight| scale / weight) } else { 1.0 };
            self.factor.add(row, row, own);
            self.step[row] = if scale > 0.0 { -self.gradient[row] } else { 0.0 };
        }
        self.factor.factor(&self.diagonal);
        self.factor.solve(&mut self.step);
        self.move_by(1.0, tau, weight);
    }

    /// Goes back to where φ is lower, if the last step passed its minimum.
    fn shorten_step(&mut self, tau: &[f64], weight: Option<f64>) {
        for j in 0..self.actuators.len() {
            self.step_effort[j] = self.columns.times(j, &self.step);
        }
        let share = line::share_of_step(|share| self.slope_along(share, tau, weight));
        if share < 1.0 {
            self.move_by(share - 1.0, tau, weight);
        }
    }

    fn move_by(&mut self, share: f64, tau: &[f64], weight: Option<f64>) {
        for (multiplier, step) in self.multipliers.iter_mut().zip(&self.step) {
            *multiplier += share * step;
        }
        self.evaluate(tau, weight);
    }

    /// Slope of φ along the last step, after a share of it.
    fn slope_along(&self, share: f64, tau: &[f64], weight: Option<f64>) -> f64 {
        let (mut slope, back) = (0.0, share - 1.0);
        for (j, actuator) in self.actuators.iter().enumerate() {
            let along = self.step_effort[j];
            let x = control(actuator, self.exponent, self.effort[j] + back * along).0;
            slope += along * x;
        }
        for row in 0..tau.len() {
            slope -= self.step[row] * tau[row];
            if let Some(weight) = weight {
                let from_centre = self.multipliers[row] + back * self.step[row] - self.centre[row];
                slope += self.step[row] * from_centre * self.diagonal[row] / weight;
            }
        }
        slope
    }
}

/// The control with the least cost at a price y per unit, and its slope over y; the slope is 0 at a bound.
#[inline]
fn control(actuator: &Actuator, exponent: f64, y: f64) -> (f64, f64) {
    let Actuator { low, high, weight } = *actuator;
    let (x, slope) = if (exponent - 2.0).abs() < f64::EPSILON {
        (y / (2.0 * weight), 0.5 / weight)
    } else {
        let size = y.abs().max(LEAST_EFFORT);
        let x = powf(size / (exponent * weight), 1.0 / (exponent - 1.0));
        match y.abs() < LEAST_EFFORT {
            true => (x * (y / size), x / size),
            false => (x.copysign(y), x / ((exponent - 1.0) * size)),
        }
    };
    if x < low {
        (low, 0.0)
    } else if x > high {
        (high, 0.0)
    } else {
        (x, slope)
    }
}
