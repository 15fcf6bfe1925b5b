//! Functions of one variable against closed forms, their own finite differences, and facts about splines.

use crate::common::random::{self, Random};
use crate::common::{assert_near, derivatives};
use ambulo::model::{Function, Knots, SimmSpline};
use ambulo::numerics::{Smoothing, SplineDegree, SplineFitter};

/// A few dozen operations on numbers of order one.
const ROUNDING: f64 = 1e-14;

fn points(list: &[(f64, f64)]) -> Knots {
    let (x, y) = list.iter().copied().unzip();
    Knots::new(x, y).expect("rising knots")
}

fn spline(list: &[(f64, f64)]) -> Function {
    Function::SimmSpline(SimmSpline::new(points(list)).expect("two knots or more"))
}

fn natural(degree: SplineDegree, f: impl Fn(f64) -> f64) -> Function {
    let times: Vec<f64> = (0..15).map(|i| 0.25 * f64::from(i) - 1.75).collect();
    let values: Vec<f64> = times.iter().map(|&t| f(t)).collect();
    let fitter = SplineFitter::new(degree, &times).expect("rising times");
    Function::NaturalSpline(fitter.fit(&values, Smoothing::Interpolate).expect("finite values"))
}

/// One of each kind, with the breaks of its pieces.
fn one_of_each() -> Vec<(&'static str, Function, Vec<f64>)> {
    let bends = [(-1.0, 0.3), (-0.4, -0.2), (0.1, 0.5), (0.7, 0.1), (1.2, 0.4)];
    let breaks: Vec<f64> = bends.iter().map(|p| p.0).collect();
    let sine = Function::Sine { amplitude: 0.7, omega: 2.0, phase: 0.4, offset: -0.3 };
    let knots: Vec<f64> = (0..15).map(|i| 0.25 * f64::from(i) - 1.75).collect();
    vec![
        ("constant", Function::Constant(0.4), vec![]),
        ("linear", Function::Linear { slope: -1.7, intercept: 0.2 }, vec![]),
        ("polynomial", Function::Polynomial(vec![0.5, -1.0, 0.25, 0.0, 2.0]), vec![]),
        ("SIMM spline", spline(&bends), breaks.clone()),
        ("cubic natural spline", natural(SplineDegree::Cubic, f64::sin), knots.clone()),
        ("quintic natural spline", natural(SplineDegree::Quintic, f64::cos), knots.clone()),
        ("heptic natural spline", natural(SplineDegree::Heptic, f64::exp), knots),
        ("piecewise linear", Function::PiecewiseLinear(points(&bends)), breaks.clone()),
        ("piecewise constant", Function::PiecewiseConstant(points(&bends)), breaks.clone()),
        ("step", Function::Step { start: (-0.8, 0.2), end: (0.9, -0.6) }, vec![-0.8, 0.9]),
        ("sine", sine, vec![]),
        ("scaled spline", Function::Scaled(-2.5, Box::new(spline(&bends))), breaks),
    ]
}

/// Largest error of both derivatives at x relative to finite differences, minus the error of the differences.
fn derivative_excess(function: &Function, x: f64) -> f64 {
    const STEP: f64 = 1e-3;
    let of_function = |x: f64| vec![function.at(x)[0], function.at(x)[1]];
    // Values of order ten, known to a few ε.
    let (slopes, error) = derivatives(of_function, x, STEP, ROUNDING);
    let [_, slope, curvature] = function.at(x);
    (slopes[0] - slope).abs().max((slopes[1] - curvature).abs()) - error
}

#[test]
fn both_derivatives_of_every_kind_are_those_of_its_values() {
    for (name, function, breaks) in one_of_each() {
        for x in (0..400).map(|i| 0.01 * f64::from(i) - 1.995) {
            // The stencil spans 4 h = 0.004 to each side; across a break a derivative jumps.
            if breaks.iter().all(|b| (x - b).abs() > 0.0041) {
                let excess = derivative_excess(&function, x);
                assert!(excess <= 0.0, "{name} at {x}: off by {excess:e} more than the stencil can be");
            }
        }
    }
}

#[test]
fn a_wrong_derivative_is_detected_by_the_differences() {
    struct Wrong;
    impl Wrong {
        fn at(x: f64) -> [f64; 3] {
            [x.sin(), x.cos() * (1.0 + 1e-7), -x.sin()]
        }
    }
    let (slopes, error) = derivatives(|x| vec![Wrong::at(x)[0]], 0.3, 1e-3, ROUNDING);
    assert!((slopes[0] - Wrong::at(0.3)[1]).abs() > error, "1e-7 is hidden by {error:e}");
}

#[test]
fn simm_splines_pass_through_their_knots_and_bend_without_a_jump() {
    for seed in 0..200 {
        let knots = random::knots(&mut Random::new(seed));
        let spline = SimmSpline::new(knots.clone()).expect("two knots or more");
        for (&x, &y) in knots.x().iter().zip(knots.y()) {
            // Curvature jumps nowhere inside: over 2e-9 it changes by the third derivative (below 1e5) times that.
            let (below, above) = (spline.at(x - 1e-9), spline.at(x + 1e-9));
            assert_near(spline.at(x)[0], y, ROUNDING, &format!("seed {seed}, knot {x}"));
            assert_near(below[1], above[1], 1e-5, &format!("seed {seed}, slope at {x}"));
            let inside = x > knots.x()[0] && x < knots.x()[knots.x().len() - 1];
            assert!(!inside || (below[2] - above[2]).abs() < 1e-3, "seed {seed}, curvature at {x}");
        }
    }
}

#[test]
fn simm_splines_of_four_or_more_knots_are_any_cubic() {
    let cubic = |x: f64| 0.7 * x * x * x - 0.4 * x * x + 1.1 * x - 0.2;
    let exact = |x: f64| [cubic(x), 2.1 * x * x - 0.8 * x + 1.1, 4.2 * x - 0.8];
    for n in 4..9 {
        let mut r = Random::new(n);
        let x: Vec<f64> = (0..n).map(|i| 0.4 * (i as f64 + r.between(0.1, 0.9)) - 1.0).collect();
        let list: Vec<(f64, f64)> = x.iter().map(|&x| (x, cubic(x))).collect();
        let function = spline(&list);
        for share in 1..50 {
            let at = x[0] + (x[x.len() - 1] - x[0]) * f64::from(share) / 50.0;
            for (k, (found, expected)) in function.at(at).into_iter().zip(exact(at)).enumerate() {
                // Second differences of values of order three over gaps of 0.08 and more: ε · 3/0.08² ≈ 1e-13; the end
                // rows divide once more.
                assert_near(found, expected, 1e-11, &format!("{n} knots, derivative {k} at {at}"));
            }
        }
    }
}

#[test]
fn simm_splines_are_not_natural_splines() {
    let list: Vec<(f64, f64)> = (0..6).map(|i| (f64::from(i), f64::from(i * i * i))).collect();
    // A natural spline has no curvature at its ends; x³ has 30 at 5, and is met exactly.
    assert_near(spline(&list).at(5.0)[2], 30.0, 1e-11, "curvature at the end");
}

#[test]
fn simm_splines_of_two_knots_are_lines_and_of_three_knots_parabolas() {
    let line = spline(&[(-1.0, 2.0), (1.0, 1.0)]);
    // Uneven gaps: x² - 3x + 1.
    let parabola = spline(&[(0.0, 1.0), (1.0, -1.0), (3.0, 1.0)]);
    for x in [0.0, 0.3, 0.9] {
        assert_near(line.at(x)[0], 1.5 - 0.5 * x, ROUNDING, "line");
        assert_near(line.at(x)[1], -0.5, ROUNDING, "slope of the line");
        assert_near(parabola.at(x)[0], x * x - 3.0 * x + 1.0, ROUNDING, "parabola");
        assert_near(parabola.at(x)[2], 2.0, ROUNDING, "curvature of the parabola");
    }
    assert!(SimmSpline::new(points(&[(0.0, 1.0)])).is_none(), "one knot");
}

#[test]
fn simm_splines_are_straight_beyond_their_ends() {
    for seed in 0..100 {
        let knots = random::knots(&mut Random::new(seed));
        let spline = SimmSpline::new(knots.clone()).expect("two knots or more");
        for (end, beyond) in [(knots.x()[0], -0.7), (knots.x()[knots.x().len() - 1], 0.9)] {
            let ([y, slope, _], [found, slope_beyond, curvature]) = (spline.at(end), spline.at(end + beyond));
            // Slopes of order 10 over a distance of order one.
            assert_near(found, y + slope * beyond, 1e-13, &format!("seed {seed}, beyond {end}"));
            assert_near(slope_beyond, slope, 1e-13, &format!("seed {seed}, slope beyond {end}"));
            assert_near(curvature, 0.0, 0.0, &format!("seed {seed}, curvature beyond {end}"));
        }
    }
}

#[test]
fn a_step_is_level_at_both_ends_and_half_way_in_the_middle() {
    let step = Function::Step { start: (1.0, -2.0), end: (3.0, 4.0) };
    for (x, level) in [(-5.0, -2.0), (1.0, -2.0), (3.0, 4.0), (9.0, 4.0)] {
        let [y, slope, curvature] = step.at(x);
        assert_near(y, level, 0.0, "level");
        assert_near(slope.abs() + curvature.abs(), 0.0, 0.0, "slope and curvature");
    }
    // Height 6 over width 2: in the middle half the height, slope 30/16 · 6/2, no curvature.
    let [y, slope, curvature] = step.at(2.0);
    assert_near(y, 1.0, ROUNDING, "middle");
    assert_near(slope, 5.625, ROUNDING, "slope in the middle");
    assert_near(curvature, 0.0, ROUNDING, "curvature in the middle");
    // Just inside, slope and curvature are small: 30 u² · 3 and 60 u · 1.5 with u = 5e-7.
    let [_, slope, curvature] = step.at(1.0 + 1e-6);
    assert!(slope.abs() < 3e-11 && curvature.abs() < 5e-5, "{slope:e}, {curvature:e}");
}

#[test]
fn natural_splines_in_joints_are_those_of_the_fitter() {
    let times: Vec<f64> = (0..34).map(|i| 0.1 * f64::from(i)).collect();
    let values: Vec<f64> = times.iter().map(|t| t.sin()).collect();
    let fitted = SplineFitter::new(SplineDegree::Quintic, &times)
        .and_then(|fitter| fitter.fit(&values, Smoothing::Interpolate))
        .expect("a spline");
    let function = Function::NaturalSpline(fitted);
    for (&t, &y) in times.iter().zip(&values) {
        // A banded solve with condition of order 1e3.
        assert_near(function.at(t)[0], y, 1e-12, "knot");
    }
    // Sixteen knots from the ends, where a sine is not natural (the error there, of order h³, decays by 0.43 a knot:
    // 1e-3 · 1e-6), the quintic misses a sine by the order of h⁶/720 = 1e-9 and its slope by 1/h of that.
    assert_near(function.at(1.65)[0], 1.65_f64.sin(), 3e-9, "between knots");
    assert_near(function.at(1.65)[1], 1.65_f64.cos(), 3e-8, "slope between knots");
}

#[test]
fn piecewise_functions_take_their_values_from_the_knots() {
    let knots = points(&[(0.0, 1.0), (2.0, 5.0), (3.0, 4.0)]);
    let lines = Function::PiecewiseLinear(knots.clone());
    for (x, y, slope) in [(0.0, 1.0, 2.0), (1.0, 3.0, 2.0), (2.0, 5.0, -1.0), (2.5, 4.5, -1.0)] {
        let found = lines.at(x);
        assert_near(found[0], y, ROUNDING, "line");
        assert_near(found[1], slope, ROUNDING, "slope");
        assert_near(found[2], 0.0, 0.0, "curvature");
    }
    assert_near(lines.at(3.0)[0], 4.0, ROUNDING, "last knot");
    let levels = Function::PiecewiseConstant(knots);
    for (x, y) in [(-1.0, 1.0), (0.0, 1.0), (1.99, 1.0), (2.0, 5.0), (2.99, 5.0), (3.0, 4.0), (8.0, 4.0)] {
        assert_near(levels.at(x)[0], y, 0.0, "level");
    }
}

/// OpenSim's `PiecewiseLinearFunction::calcValue`: y₀ + (x - x₀) b₀ before the first knot, yₙ + (x - xₙ) bₙ after the
/// last, b the slopes of the outer pieces.
#[test]
fn piecewise_lines_continue_beyond_their_ends_as_in_opensim() {
    let lines = Function::PiecewiseLinear(points(&[(0.0, 1.0), (2.0, 5.0), (3.0, 4.0)]));
    assert_near(lines.at(-1.0)[0], -1.0, ROUNDING, "before the first knot");
    assert_near(lines.at(-1.0)[1], 2.0, ROUNDING, "slope before the first knot");
    assert_near(lines.at(5.0)[0], 2.0, ROUNDING, "after the last knot");
    assert_near(lines.at(5.0)[1], -1.0, ROUNDING, "slope after the last knot");
}

#[test]
fn a_scaled_function_is_the_function_times_the_factor() {
    let inner = Function::Polynomial(vec![1.0, -2.0, 3.0]);
    let scaled = Function::Scaled(-0.5, Box::new(inner.clone()));
    for (found, plain) in scaled.at(0.7).into_iter().zip(inner.at(0.7)) {
        assert_near(found, -0.5 * plain, 0.0, "scaled");
    }
    let line = Function::Scaled(2.0, Box::new(Function::Linear { slope: 3.0, intercept: -1.0 }));
    assert_eq!(line.as_linear(), Some((6.0, -2.0)));
    assert_eq!(Function::Scaled(2.0, Box::new(Function::Constant(1.5))).as_constant(), Some(3.0));
    assert_eq!(line.as_constant(), None);
    assert_eq!(scaled.as_linear(), None);
}

#[test]
fn knots_that_do_not_increase_or_match_are_rejected() {
    let refused = [
        (vec![], vec![]),
        (vec![0.0, 0.0], vec![1.0, 2.0]),
        (vec![1.0, 0.0], vec![1.0, 2.0]),
        (vec![0.0, 1.0], vec![1.0]),
        (vec![0.0, f64::NAN], vec![1.0, 2.0]),
        (vec![0.0, 1.0], vec![1.0, f64::INFINITY]),
    ];
    for (x, y) in refused {
        assert!(Knots::new(x.clone(), y.clone()).is_none(), "{x:?}, {y:?}");
    }
}
