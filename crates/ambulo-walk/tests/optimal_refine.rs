//! Newton's method.

use ambulo_walk::contact::{FrictionCurve, HuntCrossley, Onset};
use ambulo_walk::findings::Findings;
use ambulo_walk::gait::{Gait, Walk};
use ambulo_walk::internals::Newton;
use ambulo_walk::model::anthropometry::{Build, SegmentTable};
use ambulo_walk::optimal::{Bound, WalkCosts, WalkProblem};

#[test]
fn second_derivatives_are_differences_of_the_gradient() {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: false };
    let human = build.human().unwrap();
    let gait = Gait::named("free").unwrap();
    let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).unwrap();
    let smooth = HuntCrossley { friction_curve: FrictionCurve::Smooth, ..HuntCrossley::MOCO_2D_GAIT };
    let shoes = HuntCrossley { onset: Onset::Published, ..smooth };
    let costs = WalkCosts { knots: 8, per_knot: 1, ..WalkCosts::default() };
    let WalkProblem { mut problem, guess, .. } = WalkProblem::new(&human, &human.soles, shoes, &walk, &costs).unwrap();
    // Without corners; all kinds of terms remain.
    for term in &mut problem.terms {
        term.bound = Bound::Near;
    }
    let mut newton = Newton::new(&problem).unwrap();
    newton.cost(&guess);
    newton.update_multipliers();
    newton.half_gradient();
    let mut matrix = newton.half_hessian();
    // With a diagonal that makes it positive definite, the matrix can be solved for the direction.
    let shift = 2.0 * matrix.diagonal().iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    (0..guess.len()).for_each(|row| matrix.add(row, row, shift));
    let factor = matrix.factor().unwrap();
    for seed in 0..3 {
        let direction: Vec<f64> = (0..guess.len()).map(|i| (1.0 + 3.7 * (i * i + seed) as f64).sin()).collect();
        let h = 1e-7;
        let mut gradient = |step: f64| {
            let moved: Vec<f64> = guess.iter().zip(&direction).map(|(x, d)| x + step * d).collect();
            newton.cost(&moved);
            newton.half_gradient()
        };
        let (plus, minus) = (gradient(h), gradient(-h));
        let mut found: Vec<f64> =
            (0..guess.len()).map(|i| (plus[i] - minus[i]) / (2.0 * h) + shift * direction[i]).collect();
        factor.solve(&mut found);
        let worst = found.iter().zip(&direction).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-4, "direction {seed}: {worst}");
    }
}
