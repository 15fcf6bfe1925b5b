//! The evolution strategy with covariance matrix adaptation (CMA-ES).

use ambulo_body::internals::{with_path, with_sigma};
use ambulo_body::numerics::Cma;

fn sphere(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum()
}

fn rosenbrock(x: &[f64]) -> f64 {
    x.windows(2).map(|two| 100.0 * (two[0].powi(2) - two[1]).powi(2) + (two[0] - 1.0).powi(2)).sum()
}

/// Axes from 1 to 1000, none of them along an unknown.
fn ellipsoid(x: &[f64]) -> f64 {
    let n = x.len();
    let turned = |k: usize| -> f64 {
        // A Householder reflection about (1, 2, …, n).
        let squares: f64 = (1..=n).map(|i| (i * i) as f64).sum();
        let along: f64 = x.iter().enumerate().map(|(i, x)| (i + 1) as f64 * x).sum();
        x[k] - 2.0 * (k + 1) as f64 * along / squares
    };
    (0..n).map(|k| (1000_f64.powf(k as f64 / (n - 1) as f64) * turned(k)).powi(2)).sum()
}

fn generation(cma: &mut Cma, of: fn(&[f64]) -> f64) -> (usize, f64) {
    let candidates = cma.ask();
    let costs: Vec<f64> = candidates.iter().map(|x| of(x)).collect();
    cma.tell(&candidates, &costs);
    (costs.len(), costs.into_iter().fold(f64::INFINITY, f64::min))
}

#[test]
fn known_functions_are_minimised_within_their_numbers_of_evaluations() {
    for (name, of, start, most) in [
        ("sphere", sphere as fn(&[f64]) -> f64, 1.0, 1800),
        ("rosenbrock", rosenbrock, 0.0, 5500),
        ("ellipsoid", ellipsoid, 1.0, 5500),
    ] {
        for seed in 1..4 {
            let mut cma = Cma::new(&[start; 8], 0.3, seed);
            let (mut evaluations, mut least) = (0, f64::INFINITY);
            while evaluations < most && least > 1e-10 {
                let (count, best) = generation(&mut cma, of);
                (evaluations, least) = (evaluations + count, least.min(best));
            }
            println!("{name}, seed {seed}: {least:.1e} after {evaluations} evaluations");
            assert!(least <= 1e-10, "{name}, seed {seed}: {least} after {evaluations} evaluations");
        }
    }
}

#[test]
fn equal_seeds_give_equal_bits_and_others_do_not() {
    let [mut one, mut same, mut other] = [11, 11, 12].map(|seed| Cma::new(&[1.0; 5], 0.5, seed));
    for _ in 0..10 {
        for cma in [&mut one, &mut same, &mut other] {
            generation(cma, ellipsoid);
        }
    }
    assert!(one == same && one != other);
    assert!(one.is_valid(5) && !one.is_valid(4));
    assert!(!with_sigma(&one, f64::NAN).is_valid(5) && !with_path(&one, vec![0.0; 4]).is_valid(5));
}

#[test]
fn costs_that_are_not_finite_are_the_largest() {
    // Half of the plane has no cost.
    let of = |x: &[f64]| if x[0] < 0.5 { f64::NAN } else { sphere(x) };
    let mut cma = Cma::new(&[2.0, 2.0], 0.5, 1);
    for _ in 0..200 {
        let candidates = cma.ask();
        let costs: Vec<f64> = candidates.iter().map(|x| of(x)).collect();
        cma.tell(&candidates, &costs);
    }
    assert!((cma.mean()[0] - 0.5).abs() < 1e-3 && cma.mean()[1].abs() < 1e-2, "{:?}", cma.mean());
    let before = cma.clone();
    let candidates = cma.ask();
    cma.tell(&candidates, &vec![f64::NAN; candidates.len()]);
    assert!(cma.mean() == before.mean() && cma.generations() == before.generations() + 1 && cma.is_valid(2));
}
