//! Nonlinear least squares by the Levenberg-Marquardt method.

use ambulo_body::numerics::{NormalEquations, Residuals, minimise};

/// Rosenbrock's valley: 10 (x₂ - x₁²) and 1 - x₁.
struct Valley;

impl Residuals for Valley {
    fn count(&self) -> usize {
        2
    }
    fn cost(&mut self, x: &[f64]) -> f64 {
        (10.0 * (x[1] - x[0] * x[0])).powi(2) + (1.0 - x[0]).powi(2)
    }
    fn linearise(&mut self, x: &[f64], normal: &mut NormalEquations) -> f64 {
        normal.add(10.0 * (x[1] - x[0] * x[0]), &[0, 1], &[-20.0 * x[0], 10.0]);
        normal.add(1.0 - x[0], &[0], &[-1.0]);
        self.cost(x)
    }
}

#[test]
fn the_bottom_of_a_curved_valley_is_found() {
    let mut x = [-1.2, 1.0];
    let progress = minimise(&mut Valley, &mut x, 100);
    assert!((x[0] - 1.0).abs() < 1e-6 && (x[1] - 1.0).abs() < 1e-6, "{x:?} after {progress:?}");
    assert!(progress.to < 1e-12 && progress.from > 24.0);
}

/// A straight line through points, the slope standing in two columns of every row.
struct Line([(f64, f64); 4]);

impl Residuals for Line {
    fn count(&self) -> usize {
        2
    }
    fn cost(&mut self, x: &[f64]) -> f64 {
        self.0.iter().map(|(t, y)| (x[0] + x[1] * t - y).powi(2)).sum()
    }
    fn linearise(&mut self, x: &[f64], normal: &mut NormalEquations) -> f64 {
        for (t, y) in self.0 {
            normal.add(x[0] + x[1] * t - y, &[1, 0, 1], &[0.25 * t, 1.0, 0.75 * t]);
        }
        self.cost(x)
    }
}

#[test]
fn an_unknown_may_stand_in_two_columns() {
    let mut x = [5.0, 5.0];
    minimise(&mut Line([(0.0, 1.0), (1.0, 3.0), (2.0, 4.0), (3.0, 8.0)]), &mut x, 50);
    assert!((x[0] - 0.7).abs() < 1e-5 && (x[1] - 2.2).abs() < 1e-5, "{x:?}");
}
