//! Natural splines against closed forms, an independent dense solution, an independent tridiagonal one, and scipy.
#![expect(clippy::float_cmp, reason = "exact reproduction is what some of these tests claim")]

use std::time::Instant;

use ambulo::numerics::{NaturalSpline, Smoothing, SplineDegree, SplineError, SplineFitter};

/// The p [s^(2m-1)] whose fit halves a sine of `cutoff_hz` on samples at `rate_hz`: (2π cutoff)^(-2m) rate.
fn smoothing_parameter_for_cutoff(degree: SplineDegree, cutoff_hz: f64, rate_hz: f64) -> f64 {
    rate_hz * (std::f64::consts::TAU * cutoff_hz).powi(-2 * degree.half_order() as i32)
}

const DEGREES: [SplineDegree; 4] =
    [SplineDegree::Linear, SplineDegree::Cubic, SplineDegree::Quintic, SplineDegree::Heptic];

fn uneven_times(n: usize) -> Vec<f64> {
    (0..n).map(|i| 0.01 * i as f64 + 0.003 * (2.0 * i as f64).sin()).collect()
}

fn even_times(n: usize, rate_hz: f64) -> Vec<f64> {
    (0..n).map(|i| i as f64 / rate_hz).collect()
}

fn wave(t: f64) -> f64 {
    (9.0 * t).sin() + 0.3 * (23.0 * t).cos()
}

fn fit(degree: SplineDegree, times: &[f64], values: &[f64], smoothing: Smoothing) -> NaturalSpline {
    SplineFitter::new(degree, times).unwrap().fit(values, smoothing).unwrap()
}

fn assert_close(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found} instead of {expected}, allowed {tolerance:e}");
}

/// Normal deviates by Box-Muller from a xorshift generator.
fn noise(count: usize, seed: u64) -> Vec<f64> {
    let mut state = seed;
    let mut uniform = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        ((state >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    };
    (0..count).map(|_| (-2.0 * uniform().ln()).sqrt() * (std::f64::consts::TAU * uniform()).cos()).collect()
}

/// Gaussian elimination with partial pivoting.
fn solve_dense(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for column in 0..n {
        let pivot = (column..n).max_by(|i, j| a[*i][column].abs().total_cmp(&a[*j][column].abs())).unwrap();
        a.swap(column, pivot);
        b.swap(column, pivot);
        for row in column + 1..n {
            let factor = a[row][column] / a[column][column];
            for k in column..n {
                a[row][k] -= factor * a[column][k];
            }
            b[row] -= factor * b[column];
        }
    }
    for row in (0..n).rev() {
        let known: f64 = (row + 1..n).map(|k| a[row][k] * b[k]).sum();
        b[row] = (b[row] - known) / a[row][row];
    }
    b
}

/// The smoothing spline as radial functions plus a polynomial, in dense matrices:
/// f = Σ cᵢ |t-tᵢ|^(2m-1) / (2 (2m-1)!) + Σ dₖ tᵏ,  Σ cᵢ tᵢᵏ = 0,  y - f(tᵢ) = (-1)ᵐ p cᵢ.
struct Radial {
    m: usize,
    times: Vec<f64>,
    weights: Vec<f64>,
}

impl Radial {
    fn fit(m: usize, times: &[f64], values: &[f64], p: f64) -> Self {
        let n = times.len();
        let sign = if m.is_multiple_of(2) { 1.0 } else { -1.0 };
        let mut a = vec![vec![0.0; n + m]; n + m];
        for i in 0..n {
            for j in 0..n {
                a[i][j] = kernel(m, times[i] - times[j], 0);
            }
            a[i][i] += sign * p;
            for k in 0..m {
                a[i][n + k] = times[i].powi(k as i32);
                a[n + k][i] = a[i][n + k];
            }
        }
        let b = values.iter().copied().chain(std::iter::repeat_n(0.0, m)).collect();
        Self { m, times: times.to_vec(), weights: solve_dense(a, b) }
    }

    fn derivative(&self, order: usize, t: f64) -> f64 {
        let n = self.times.len();
        let radial: f64 = (0..n).map(|i| self.weights[i] * kernel(self.m, t - self.times[i], order)).sum();
        let falling = |k: usize| (0..order).map(|r| k as f64 - r as f64).product::<f64>();
        let polynomial: f64 =
            (order..self.m).map(|k| self.weights[n + k] * falling(k) * t.powi((k - order) as i32)).sum();
        radial + polynomial
    }
}

fn kernel(m: usize, x: f64, order: usize) -> f64 {
    let power = 2 * m - 1 - order;
    let factorial: f64 = (1..=power).map(|k| k as f64).product();
    let sign = if order % 2 == 1 { x.signum() } else { 1.0 };
    sign * x.abs().powi(power as i32) / (2.0 * factorial)
}

// ---------------------------------------------------------------- closed forms

#[test]
fn a_polynomial_below_the_half_order_is_reproduced_by_any_smoothing() {
    let times = uneven_times(30);
    for degree in DEGREES {
        let m = degree.half_order();
        let polynomial = |t: f64| (0..m).map(|k| (1.0 + k as f64) * t.powi(k as i32)).sum::<f64>();
        let values: Vec<f64> = times.iter().map(|t| polynomial(*t)).collect();
        let fitter = SplineFitter::new(degree, &times).unwrap();
        let strong = smoothing_parameter_for_cutoff(degree, 3.0, 100.0);
        for smoothing in [
            Smoothing::Interpolate,
            Smoothing::Parameter(strong),
            Smoothing::GeneralizedCrossValidation,
            Smoothing::ErrorVariance(0.01),
        ] {
            let spline = fitter.fit(&values, smoothing).unwrap();
            for t in [-0.05, 0.0, 0.123, 0.2, 0.35] {
                // Values up to 3 with rounding 4e-16, amplified at most p ‖QᵀQ‖ʹ½ ~ 1e6 fold by the strongest search.
                assert_close(spline.value(t), polynomial(t), 1e-9, &format!("{degree:?} {smoothing:?} at {t}"));
            }
        }
    }
}

#[test]
fn smoothing_changes_a_polynomial_of_the_half_order() {
    let times = uneven_times(30);
    for degree in DEGREES {
        let values: Vec<f64> = times.iter().map(|t| (10.0 * t).powi(degree.half_order() as i32)).collect();
        let p = smoothing_parameter_for_cutoff(degree, 3.0, 100.0);
        let spline = fit(degree, &times, &values, Smoothing::Parameter(p));
        let change = times.iter().zip(&values).map(|(t, y)| (spline.value(*t) - y).abs()).fold(0.0, f64::max);
        assert!(change > 1e-3, "{degree:?} moved t^m by only {change}");
    }
}

#[test]
fn interpolation_passes_through_every_sample() {
    let times = uneven_times(40);
    let values: Vec<f64> = times.iter().map(|t| wave(*t)).collect();
    for degree in DEGREES {
        let spline = fit(degree, &times, &values, Smoothing::Interpolate);
        assert!(times.iter().zip(&values).all(|(t, y)| spline.value(*t) == *y));
        // From the left each piece must arrive at the next sample: the sum of 2m terms of rounding 1e-16.
        for (t, y) in times.iter().zip(&values).skip(1) {
            assert_close(spline.value(t.next_down()), *y, 1e-12, "left limit");
        }
        assert_eq!(spline.noise_standard_deviation(), None);
        assert_eq!(spline.effective_degrees_of_freedom(), 40.0);
    }
}

#[test]
fn derivatives_up_to_2m_minus_2_are_continuous_and_the_next_is_not() {
    let times = uneven_times(40);
    let values: Vec<f64> = times.iter().map(|t| wave(*t)).collect();
    for degree in DEGREES {
        let m = degree.half_order();
        let spline =
            fit(degree, &times, &values, Smoothing::Parameter(smoothing_parameter_for_cutoff(degree, 20.0, 100.0)));
        let jump = |order: usize| {
            let size = times.iter().map(|t| spline.derivative(order, *t).abs()).fold(0.0, f64::max);
            let gap = |t: &f64| (spline.derivative(order, *t) - spline.derivative(order, t.next_down())).abs();
            times[1..].iter().map(gap).fold(0.0, f64::max) / size
        };
        for order in 0..=2 * m - 2 {
            // Rounding of values 1e-16 divided by step^order, relative to a wave of 0.2 rad per step: 1e-16 5^order.
            assert!(jump(order) < 1e-16 * 1e3 * 8f64.powi(order as i32), "{degree:?} order {order}: {}", jump(order));
        }
        assert!(jump(2 * m - 1) > 1e-3, "{degree:?} is smoother than a spline: {}", jump(2 * m - 1));
    }
}

#[test]
fn derivatives_from_m_to_2m_minus_2_vanish_at_both_ends_and_below_m_do_not() {
    let times = uneven_times(40);
    let values: Vec<f64> = times.iter().map(|t| wave(*t)).collect();
    for degree in DEGREES {
        let m = degree.half_order();
        let spline = fit(degree, &times, &values, Smoothing::Interpolate);
        for end in [times[0], times[39].next_down()] {
            for order in m..=2 * m - 2 {
                let inside = spline.derivative(order, 0.2).abs();
                assert_close(spline.derivative(order, end), 0.0, 1e-9 * inside, &format!("{degree:?} order {order}"));
            }
            assert!(spline.derivative(m - 1, end).abs() > 1e-2, "{degree:?} at {end}");
        }
    }
}

#[test]
fn outside_the_data_the_spline_continues_as_a_polynomial_of_degree_m_minus_1() {
    let times = uneven_times(40);
    let values: Vec<f64> = times.iter().map(|t| wave(*t)).collect();
    for degree in DEGREES {
        let m = degree.half_order();
        let spline = fit(degree, &times, &values, Smoothing::Interpolate);
        for (end, t) in [(times[0], times[0] - 0.03), (times[39], times[39] + 0.03)] {
            let taylor: f64 = (0..m)
                .map(|k| {
                    let factorial: f64 = (1..=k).map(|f| f as f64).product();
                    spline.derivative(k, end) * (t - end).powi(k as i32) / factorial
                })
                .sum();
            assert_close(spline.value(t), taylor, 1e-12, &format!("{degree:?} at {t}"));
            assert_eq!(spline.derivative(m, t), 0.0);
        }
    }
}

#[test]
fn the_acceleration_of_a_sine_comes_out_with_the_error_of_a_quintic() {
    // 1 Hz at 100 Hz: θ = ω h = 0.063. The error of the second derivative at the samples of a periodic quintic spline
    // is of order θ⁴/720 = 2e-8 of ω² (measured 2.2e-8). Ends excluded: natural conditions disturb them.
    let times = even_times(400, 100.0);
    let omega = std::f64::consts::TAU;
    let values: Vec<f64> = times.iter().map(|t| (omega * t).sin()).collect();
    let spline = fit(SplineDegree::Quintic, &times, &values, Smoothing::Interpolate);
    for t in &times[100..300] {
        let [value, speed, acceleration] = spline.value_and_two_derivatives(*t);
        assert_close(value, (omega * t).sin(), 1e-15, "value");
        assert_close(speed, omega * (omega * t).cos(), 1e-8 * omega, "speed");
        assert_close(acceleration, -omega * omega * (omega * t).sin(), 5e-8 * omega * omega, "acceleration");
    }
}

#[test]
fn the_three_ways_to_evaluate_agree() {
    let times = uneven_times(40);
    let values: Vec<f64> = times.iter().map(|t| wave(*t)).collect();
    for degree in DEGREES {
        let spline = fit(degree, &times, &values, Smoothing::Interpolate);
        for i in -5..60 {
            let t = 0.008 * f64::from(i);
            let all = spline.value_and_two_derivatives(t);
            assert_eq!(all[0], spline.value(t));
            for order in 0..3 {
                let single = spline.derivative(order, t);
                assert_close(all[order], single, 1e-13 * single.abs().max(1.0), "derivative");
            }
        }
    }
}

#[test]
fn a_time_far_from_even_spacing_finds_its_own_piece() {
    let times: Vec<f64> = (0..60).map(|i| 1.15f64.powi(i)).collect();
    let values: Vec<f64> = times.iter().map(|t| t.ln()).collect();
    let spline = fit(SplineDegree::Cubic, &times, &values, Smoothing::Interpolate);
    for t in [1.5, 2.0, 7.0, 60.0, 700.0, 3000.0] {
        assert_close(spline.value(t), f64::ln(t), 2e-3, "logarithm");
    }
}

// ---------------------------------------------------------------- independent solutions

#[test]
fn every_degree_and_smoothing_agrees_with_a_dense_radial_solution() {
    // The dense matrix loses about 1e-16 x its condition, 1e9 for heptics in these units of about one step.
    let times: Vec<f64> = (0..14).map(|i| f64::from(i) - 6.5 + 0.3 * (2.0 * f64::from(i)).sin()).collect();
    let values: Vec<f64> = times.iter().map(|t| (0.7 * t).sin() + 0.2 * (3.1 * t).cos()).collect();
    for degree in DEGREES {
        let m = degree.half_order();
        let fitter = SplineFitter::new(degree, &times).unwrap();
        for p in [0.0, 1e-3, 0.5, 40.0] {
            let spline = fitter.fit(&values, Smoothing::Parameter(p)).unwrap();
            let dense = Radial::fit(m, &times, &values, p);
            for t in [-8.0, -6.0, -2.3, 0.01, 1.9, 5.2, 8.0] {
                for order in 0..(2 * m - 1).min(4) {
                    let what = format!("{degree:?} p {p} order {order} at {t}");
                    assert_close(spline.derivative(order, t), dense.derivative(order, t), 1e-8, &what);
                }
            }
        }
    }
}

#[test]
fn effective_degrees_of_freedom_are_the_trace_of_the_dense_influence_matrix() {
    let times: Vec<f64> = (0..12).map(|i| f64::from(i) - 5.5 + 0.3 * (2.0 * f64::from(i)).sin()).collect();
    for degree in DEGREES {
        let fitter = SplineFitter::new(degree, &times).unwrap();
        for p in [1e-3, 0.5, 40.0] {
            let influence = |i: usize| {
                let unit: Vec<f64> = (0..12).map(|j| if i == j { 1.0 } else { 0.0 }).collect();
                Radial::fit(degree.half_order(), &times, &unit, p).derivative(0, times[i])
            };
            let trace: f64 = (0..12).map(influence).sum();
            let spline = fitter.fit(&times, Smoothing::Parameter(p)).unwrap();
            assert_close(spline.effective_degrees_of_freedom(), trace, 1e-8, &format!("{degree:?} p {p}"));
        }
    }
}

#[test]
fn the_natural_cubic_agrees_with_a_tridiagonal_solve_for_its_second_derivatives() {
    let times = uneven_times(40);
    let values: Vec<f64> = times.iter().map(|t| wave(*t)).collect();
    let n = times.len();
    let h: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let slope: Vec<f64> = (0..n - 1).map(|i| (values[i + 1] - values[i]) / h[i]).collect();
    // h[i-1] M[i-1] + 2 (h[i-1] + h[i]) M[i] + h[i] M[i+1] = 6 (slope[i] - slope[i-1]), M = 0 at the ends: Thomas.
    let (mut upper, mut right) = (vec![0.0; n], vec![0.0; n]);
    for i in 1..n - 1 {
        let pivot = 2.0 * (h[i - 1] + h[i]) - h[i - 1] * upper[i - 1];
        upper[i] = h[i] / pivot;
        right[i] = (6.0 * (slope[i] - slope[i - 1]) - h[i - 1] * right[i - 1]) / pivot;
    }
    let mut curvature = vec![0.0; n];
    for i in (1..n - 1).rev() {
        curvature[i] = right[i] - upper[i] * curvature[i + 1];
    }
    let cubic = fit(SplineDegree::Cubic, &times, &values, Smoothing::Interpolate);
    let quintic = fit(SplineDegree::Quintic, &times, &values, Smoothing::Interpolate);
    let worst = |spline: &NaturalSpline| {
        (0..n).map(|i| (spline.derivative(2, times[i]) - curvature[i]).abs()).fold(0.0, f64::max)
    };
    // Values of 1 with rounding 1e-16 over steps of 4 ms squared: 1e-11 in a curvature of 200.
    assert!(worst(&cubic) < 1e-9, "{}", worst(&cubic));
    assert!(worst(&quintic) > 1.0, "a quintic passed for a cubic: {}", worst(&quintic));
}

// Golden numbers of scipy 1.17.1 with numpy 2.4.6:
//   i = arange(40); t = 0.01*i + 0.003*sin(2.0*i); y = sin(9*t) + 0.3*cos(23*t); q = [0.0312, 0.1, 0.2221, 0.35]
//   s = make_interp_spline(t, y, k=5, bc_type=([(3, 0.0), (4, 0.0)],)*2); s(q, 0), s(q, 1), s(q, 2)
//   y += 0.1*sin(1000.0*i*i); make_smoothing_spline(t, y, lam=1e-6)(q)
// scipy's own choice of lam stops within 1e-5 of lam, which is of the size of lam here; so the score was minimised with
//   A = array([make_smoothing_spline(t, e, lam=lam)(t) for e in eye(40)]).T; 40*sum((y - A@y)**2)/trace(eye(40) - A)**2
//   minimize_scalar(score of exp(u), bounds around the best of linspace(-22, -6, 65), 'bounded', xatol=1e-7)
const QUERIES: [f64; 4] = [0.0312, 0.1, 0.2221, 0.35];

#[test]
fn the_natural_quintic_agrees_with_scipy() {
    let golden = [
        [0.5031398072171209, 0.5834441161704813, 1.025449301165428, -0.06683471384005917],
        [4.1100507535378386, 0.449117736770122, 2.629934192748016, -15.768322236253931],
        [-141.96174151522456, 42.288851774861655, -134.8926701467687, 31.408983157799867],
    ];
    let times = uneven_times(40);
    let values: Vec<f64> = times.iter().map(|t| wave(*t)).collect();
    let spline = fit(SplineDegree::Quintic, &times, &values, Smoothing::Interpolate);
    for (q, query) in QUERIES.iter().enumerate() {
        let found = spline.value_and_two_derivatives(*query);
        for order in 0..3 {
            // Rounding 1e-16 of values over steps of about 4 ms, twice, and the conditioning of scipy's collocation.
            let tolerance = [1e-12, 1e-10, 1e-8][order];
            assert_close(found[order], golden[order][q], tolerance, &format!("order {order} at {query}"));
        }
    }
}

#[test]
fn the_smoothing_cubic_agrees_with_scipy_and_so_does_its_cross_validation() {
    let given = [0.5141041111598846, 0.5608085085251736, 1.0474947753869523, -0.10811442478312815];
    let chosen = [0.47602488239184165, 0.5752926404971679, 1.0220658763354766, -0.09014916891596439];
    let times = uneven_times(40);
    let noise = |i: usize| 0.1 * (1000.0 * (i * i) as f64).sin();
    let values: Vec<f64> = times.iter().enumerate().map(|(i, t)| wave(*t) + noise(i)).collect();
    let by_parameter = fit(SplineDegree::Cubic, &times, &values, Smoothing::Parameter(1e-6));
    let by_validation = fit(SplineDegree::Cubic, &times, &values, Smoothing::GeneralizedCrossValidation);
    for (q, query) in QUERIES.iter().enumerate() {
        assert_close(by_parameter.value(*query), given[q], 1e-11, "given p");
        // Our search knows p to 1e-3, which moves values by less than 1e-3 of the residual of 0.1.
        assert_close(by_validation.value(*query), chosen[q], 1e-4, "chosen p");
    }
    assert_close(by_validation.smoothing_parameter(), 1.8882257802953044e-5, 1e-3 * 1.888e-5, "p");
    let wrong = fit(SplineDegree::Cubic, &times, &values, Smoothing::Parameter(2e-6));
    assert!((wrong.value(QUERIES[0]) - given[0]).abs() > 1e-4, "twice the p went unnoticed");
}

// Golden numbers of OpenSim 4.6 (the `opensim` wheel 4.6-2 from PyPI, GetVersion 4.6-2026-06-22-85aaf64), with i, t, y,
// q as above, and y += 0.1*sin(1000.0*i*i) where the variance is not 0:
//   table = TimeSeriesTable(); table.setColumnLabels(['c']); table.appendRow(t[k], RowVector([y[k]])) for all k
//   s = GCVSplineSet(table, StdVectorString(), degree, variance); s.evaluate(0, order, q) for orders 0, 1, 2
// Variance 0 is its default; a negative one asks for generalised cross-validation.

#[test]
fn interpolation_agrees_with_opensim() {
    let golden = [
        (
            SplineDegree::Cubic,
            [
                [0.5031523025310628, 0.5834482266813753, 1.0254474769725404, -0.06683199522970973],
                [4.113461864024735, 0.4473381125336282, 2.628831567071189, -15.769113214349783],
                [-144.2299228204348, 42.2581456766611, -134.9523573750486, 31.11621745470992],
            ],
        ),
        (
            SplineDegree::Quintic,
            [
                [0.5031398072171207, 0.5834441161704813, 1.025449301165428, -0.06683471384005933],
                [4.110050753537855, 0.4491177367701122, 2.6299341927480513, -15.768322236253873],
                [-141.9617415152163, 42.28885177485645, -134.89267014676972, 31.4089831578151],
            ],
        ),
        (
            SplineDegree::Heptic,
            [
                [0.5031393317114906, 0.5834440891593377, 1.0254493070697688, -0.06683736918618695],
                [4.109853974869077, 0.44912999246147467, 2.629937436931511, -15.767365053775999],
                [-141.91551827490755, 42.28806593822771, -134.89260287826323, 31.621314103080806],
            ],
        ),
    ];
    let times = uneven_times(40);
    let values: Vec<f64> = times.iter().map(|t| wave(*t)).collect();
    for (degree, golden) in golden {
        let spline = fit(degree, &times, &values, Smoothing::Interpolate);
        for (q, query) in QUERIES.iter().enumerate() {
            for order in 0..3 {
                // Rounding as for scipy above; accelerations reach 150.
                let tolerance = [1e-12, 1e-10, 1e-8][order];
                let what = format!("{degree:?} order {order} at {query}");
                assert_close(spline.derivative(order, *query), golden[order][q], tolerance, &what);
            }
        }
    }
}

#[test]
fn continuation_beyond_the_ends_agrees_with_opensim() {
    // s.evaluate(0, order, x) of the quintic above, orders 0 to 3, x = -0.03 and 0.45.
    let golden = [
        (-0.03, [-0.043200481123213175, 13.87163154248912, -162.1077003365784, 0.0]),
        (0.45, [-1.031425049222373, -1.9434237900634046, 158.46474290686905, 0.0]),
    ];
    let times = uneven_times(40);
    let values: Vec<f64> = times.iter().map(|t| wave(*t)).collect();
    let spline = fit(SplineDegree::Quintic, &times, &values, Smoothing::Interpolate);
    for (t, golden) in golden {
        for order in 0..4 {
            let tolerance = [1e-12, 1e-10, 1e-8, 0.0][order];
            assert_close(spline.derivative(order, t), golden[order], tolerance, &format!("order {order} at {t}"));
        }
    }
}

#[test]
fn smoothing_chosen_from_the_data_agrees_with_opensim() {
    let golden = [
        (
            SplineDegree::Cubic,
            Smoothing::GeneralizedCrossValidation,
            [
                [0.47602487864242327, 0.5752926416788271, 1.0220658725611296, -0.09014916513291187],
                [2.635155635346723, 1.819777716614282, 2.0251927426850695, -15.836164301586287],
                [-80.7275284860973, 37.79773910612277, -156.20947097497475, 3.0842346926678865],
            ],
        ),
        (
            SplineDegree::Quintic,
            Smoothing::GeneralizedCrossValidation,
            [
                [0.479834120178416, 0.5714400798077042, 1.0207943369110686, -0.08496977351506041],
                [2.6987892922029917, 1.3978970334955731, 2.2496523549441156, -16.149783757453285],
                [-79.92792493021918, 35.4901906781217, -143.53264299866905, -22.13299847491502],
            ],
        ),
        (
            SplineDegree::Quintic,
            Smoothing::ErrorVariance(0.005),
            [
                [0.480763723907295, 0.571351397008739, 1.021513542797176, -0.08648861224774776],
                [2.7235381870387583, 1.3910769223489095, 2.276852706490058, -16.13275538649838],
                [-83.30052629159225, 35.68028088249443, -144.64495712273373, -18.827496655164488],
            ],
        ),
    ];
    let times = uneven_times(40);
    let values: Vec<f64> =
        times.iter().enumerate().map(|(i, t)| wave(*t) + 0.1 * (1000.0 * (i * i) as f64).sin()).collect();
    for (degree, smoothing, golden) in golden {
        let spline = fit(degree, &times, &values, smoothing);
        for (q, query) in QUERIES.iter().enumerate() {
            for order in 0..3 {
                // ln p to 1e-3 moves values by 1e-4 of the noise of 0.1, and derivatives by that times the half-gain
                // ω, about 40 /s, to the order.
                let tolerance = 1e-5 * 40f64.powi(order as i32);
                let what = format!("{degree:?} {smoothing:?} order {order} at {query}");
                assert_close(spline.derivative(order, *query), golden[order][q], tolerance, &what);
            }
        }
    }
}

// ---------------------------------------------------------------- smoothing

#[test]
fn cross_validation_recovers_the_noise_of_a_sine() {
    // 400 samples: the estimate of a standard deviation itself scatters by 1/√800 = 3.5 %.
    let times = even_times(400, 100.0);
    for (seed, sd) in [(1, 0.01), (2, 0.01), (3, 0.1), (4, 0.001)] {
        let noise = noise(400, 0x9E37_79B9_7F4A_7C15 ^ seed);
        let clean = |t: f64| (std::f64::consts::TAU * t).sin() + 0.3 * (15.0 * t).cos();
        let values: Vec<f64> = times.iter().zip(&noise).map(|(t, e)| clean(*t) + sd * e).collect();
        for degree in [SplineDegree::Cubic, SplineDegree::Quintic, SplineDegree::Heptic] {
            let spline = fit(degree, &times, &values, Smoothing::GeneralizedCrossValidation);
            let found = spline.noise_standard_deviation().unwrap();
            assert_close(found, sd, 0.15 * sd, &format!("{degree:?}, seed {seed}"));
            let rms = |f: &dyn Fn(usize) -> f64| ((0..400).map(|i| f(i).powi(2)).sum::<f64>() / 400.0).sqrt();
            let error = rms(&|i| spline.value(times[i]) - clean(times[i]));
            // What remains of the noise is sd √(tr A / n), and the bias at the best p is about as large or smaller.
            let remaining = sd * (spline.effective_degrees_of_freedom() / 400.0).sqrt();
            assert!(error < 1.5 * remaining && error < 0.7 * sd, "{degree:?}, seed {seed}: {error}, {remaining}");
        }
    }
}

#[test]
fn the_true_error_variance_gives_nearly_the_same_fit_and_a_wrong_one_does_not() {
    let times = even_times(400, 100.0);
    let noise = noise(400, 77);
    let values: Vec<f64> = times.iter().zip(&noise).map(|(t, e)| (6.0 * t).sin() + 0.02 * e).collect();
    let freedom = |smoothing| fit(SplineDegree::Quintic, &times, &values, smoothing).effective_degrees_of_freedom();
    let validated = freedom(Smoothing::GeneralizedCrossValidation);
    let known = freedom(Smoothing::ErrorVariance(0.02 * 0.02));
    let wrong = freedom(Smoothing::ErrorVariance(0.002 * 0.002));
    assert!((known / validated - 1.0).abs() < 0.2, "{known} and {validated}");
    assert!(wrong > 2.0 * validated, "a tenth of the noise went unnoticed: {wrong} and {validated}");
}

#[test]
fn cross_validation_survives_a_gap_of_a_thousand_steps() {
    let times: Vec<f64> = (0..300).map(|i| 0.01 * f64::from(if i < 150 { i } else { i + 1000 })).collect();
    let noise = noise(300, 5);
    let values: Vec<f64> = times.iter().zip(&noise).map(|(t, e)| (3.0 * t).sin() + 0.02 * e).collect();
    for degree in DEGREES {
        let spline = fit(degree, &times, &values, Smoothing::GeneralizedCrossValidation);
        let found = spline.noise_standard_deviation().unwrap();
        assert_close(found, 0.02, 0.2 * 0.02, &format!("{degree:?}"));
    }
}

#[test]
fn error_variance_zero_interpolates() {
    let times = uneven_times(40);
    let values: Vec<f64> = times.iter().map(|t| wave(*t)).collect();
    let spline = fit(SplineDegree::Quintic, &times, &values, Smoothing::ErrorVariance(0.0));
    assert_eq!(spline.fitted_values().collect::<Vec<_>>(), values);
    assert_eq!(spline.smoothing_parameter(), 0.0);
}

#[test]
fn the_parameter_for_a_cutoff_halves_a_sine_of_that_frequency() {
    let times = even_times(2000, 100.0);
    for degree in [SplineDegree::Cubic, SplineDegree::Quintic, SplineDegree::Heptic] {
        for (frequency, gain) in [(6.0, 0.5), (3.0, 1.0 / (1.0 + 0.5f64.powi(2 * degree.half_order() as i32)))] {
            let sine = |t: f64| (std::f64::consts::TAU * frequency * t).sin();
            let values: Vec<f64> = times.iter().map(|t| sine(*t)).collect();
            let p = smoothing_parameter_for_cutoff(degree, 6.0, 100.0);
            let spline = fit(degree, &times, &values, Smoothing::Parameter(p));
            // Sampling changes the gain by about (ω h)^(2m)/12 or so: 1e-3 at 6 Hz for a cubic.
            for t in &times[900..1100] {
                assert_close(spline.value(*t), gain * sine(*t), 2e-3, &format!("{degree:?} at {frequency} Hz"));
            }
        }
    }
}

#[test]
fn strong_smoothing_of_a_long_fast_recording_keeps_its_digits() {
    // 10,000 samples at 1 kHz with a half-gain frequency of 6 Hz: p ‖QᵀQ‖ = 2e10, where one factorisation alone would
    // leave 1e-6. In the middle of a long even grid the answer is known: the gain of one sine, up to sampling (1e-9).
    let times = even_times(10_000, 1000.0);
    let omega = std::f64::consts::TAU * 2.0;
    let values: Vec<f64> = times.iter().map(|t| 5.0 + (omega * t).sin()).collect();
    let p = smoothing_parameter_for_cutoff(SplineDegree::Quintic, 6.0, 1000.0);
    let spline = fit(SplineDegree::Quintic, &times, &values, Smoothing::Parameter(p));
    let gain = 1.0 / (1.0 + (1.0f64 / 3.0).powi(6));
    for i in (4000..6000).step_by(7) {
        let [value, speed, acceleration] = spline.value_and_two_derivatives(times[i]);
        let (sine, cosine) = (omega * times[i]).sin_cos();
        assert_close(value, 5.0 + gain * sine, 1e-9, "value");
        assert_close(speed, gain * omega * cosine, 1e-8 * omega, "speed");
        assert_close(acceleration, -gain * omega * omega * sine, 1e-6 * omega * omega, "acceleration");
    }
}

#[test]
fn a_late_clock_and_another_unit_of_time_change_nothing() {
    // Whole milliseconds after 1024 s are rounded to 2e-13 s, 2e-10 of a step.
    let times = even_times(300, 1000.0);
    let values: Vec<f64> = times.iter().map(|t| wave(10.0 * t)).collect();
    let p = smoothing_parameter_for_cutoff(SplineDegree::Quintic, 20.0, 1000.0);
    let spline = fit(SplineDegree::Quintic, &times, &values, Smoothing::Parameter(p));
    let late: Vec<f64> = times.iter().map(|t| t + 1024.0).collect();
    let late_spline = fit(SplineDegree::Quintic, &late, &values, Smoothing::Parameter(p));
    let milliseconds: Vec<f64> = times.iter().map(|t| 1000.0 * t).collect();
    let scaled = fit(SplineDegree::Quintic, &milliseconds, &values, Smoothing::Parameter(p * 1000f64.powi(5)));
    for i in 0..300 {
        let size = 1e4; // the accelerations of this wave, 90² and 0.3 x 230², per s²
        let acceleration = spline.derivative(2, times[i]);
        assert_close(late_spline.derivative(2, late[i]), acceleration, 1e-5 * size, "late clock");
        assert_close(1e6 * scaled.derivative(2, milliseconds[i]), acceleration, 1e-8 * size, "milliseconds");
    }
}

#[test]
fn many_columns_give_the_bits_of_single_fits() {
    let times = uneven_times(60);
    let columns: Vec<Vec<f64>> =
        (1..=4).map(|c| times.iter().zip(noise(60, c)).map(|(t, e)| wave(*t) + 0.05 * e).collect()).collect();
    let fitter = SplineFitter::new(SplineDegree::Quintic, &times).unwrap();
    for smoothing in [
        Smoothing::Interpolate,
        Smoothing::Parameter(1e-10),
        Smoothing::GeneralizedCrossValidation,
        Smoothing::ErrorVariance(0.0025),
    ] {
        let together = fitter.fit_many(&columns, smoothing).unwrap();
        for (spline, column) in together.iter().zip(&columns) {
            let alone = fitter.fit(column, smoothing).unwrap();
            assert!((0..90).all(|i| spline.value(0.01 * f64::from(i)) == alone.value(0.01 * f64::from(i))));
        }
    }
}

#[test]
fn the_fewest_samples_allowed_can_be_fitted() {
    for degree in DEGREES {
        let times = uneven_times(2 * degree.half_order());
        let values: Vec<f64> = times.iter().map(|t| wave(*t)).collect();
        let spline = fit(degree, &times, &values, Smoothing::Interpolate);
        let dense = Radial::fit(degree.half_order(), &times, &values, 0.0);
        for t in [0.0, 0.005, 0.03] {
            assert_close(spline.value(t), dense.derivative(0, t), 1e-8, &format!("{degree:?}"));
        }
        fit(degree, &times, &values, Smoothing::GeneralizedCrossValidation);
    }
}

// ---------------------------------------------------------------- errors

#[test]
fn too_few_samples_say_how_many_are_needed() {
    let error = SplineFitter::new(SplineDegree::Quintic, &[0.0, 0.1, 0.2, 0.3, 0.4]).unwrap_err();
    assert_eq!(error, SplineError::TooFewSamples { found: 5, allowed: 6, degree: 5 });
    assert!(error.to_string().starts_with("5 samples are too few for a spline of degree 5: at least 6 are needed"));
    assert!(SplineFitter::new(SplineDegree::Quintic, &[]).is_err());
}

#[test]
fn bad_times_are_named_by_index() {
    let mut times = uneven_times(10);
    times[4] = times[3];
    let error = SplineFitter::new(SplineDegree::Cubic, &times).unwrap_err();
    assert!(matches!(error, SplineError::TimeNotIncreasing { index: 4, .. }), "{error}");
    times[7] = f64::NAN;
    let error = SplineFitter::new(SplineDegree::Cubic, &times).unwrap_err();
    assert_eq!(error.to_string(), "time 7 is NaN: finite seconds are needed");
}

#[test]
fn bad_values_are_named_by_column_and_index() {
    let times = uneven_times(10);
    let fitter = SplineFitter::new(SplineDegree::Cubic, &times).unwrap();
    let mut columns = vec![vec![1.0; 10]; 3];
    columns[2][5] = f64::INFINITY;
    let error = fitter.fit_many(&columns, Smoothing::Interpolate).unwrap_err();
    assert_eq!(error, SplineError::NonFiniteValue { column: 2, index: 5, found: f64::INFINITY });
    let error = fitter.fit(&[1.0; 9], Smoothing::Interpolate).unwrap_err();
    assert_eq!(error.to_string(), "column 0 has 9 values for 10 times: one value per time is needed");
}

#[test]
fn smoothing_out_of_range_is_refused() {
    let fitter = SplineFitter::new(SplineDegree::Quintic, &even_times(100, 100.0)).unwrap();
    for smoothing in [
        Smoothing::Parameter(-1.0),
        Smoothing::Parameter(f64::NAN),
        Smoothing::Parameter(1e20),
        Smoothing::ErrorVariance(-1.0),
        Smoothing::ErrorVariance(f64::NAN),
    ] {
        let error = fitter.fit(&[0.0; 100], smoothing).unwrap_err();
        assert!(matches!(error, SplineError::SmoothingOutOfRange { .. }), "{smoothing:?}: {error}");
    }
}

// ---------------------------------------------------------------- speed

#[test]
fn thirty_columns_fit_and_evaluate_in_time() {
    // The limit only catches a cost that is no longer linear. It is checked where the machine does nothing else:
    // `cargo xtask check --full`.
    let is_checked = std::env::var_os("AMBULO_TIMES").is_some();
    for n in [300usize, 10_000] {
        let times = even_times(n, 100.0);
        let columns: Vec<Vec<f64>> =
            (0..30).map(|c| times.iter().map(|t| (t * (1.0 + 0.1 * f64::from(c))).sin()).collect()).collect();
        let started = Instant::now();
        let fitter = SplineFitter::new(SplineDegree::Quintic, &times).unwrap();
        let prepared = started.elapsed();
        let splines = fitter.fit_many(&columns, Smoothing::Interpolate).unwrap();
        let fitted = started.elapsed();
        let mut sum = 0.0;
        for t in &times {
            for spline in &splines {
                sum += spline.value_and_two_derivatives(*t)[2];
            }
        }
        let evaluated = started.elapsed();
        let p = smoothing_parameter_for_cutoff(SplineDegree::Quintic, 6.0, 100.0);
        fitter.fit_many(&columns, Smoothing::Parameter(p)).unwrap();
        let smoothed = started.elapsed();
        println!(
            "30 x {n}: grid {prepared:?}, fit {:?}, evaluate {:?}, smooth {:?} ({sum})",
            fitted - prepared,
            evaluated - fitted,
            smoothed - evaluated
        );
        assert!(!is_checked || evaluated.as_secs_f64() < 1.0);
    }
}
