//! Random numbers that are the same for the same seed.

use ambulo_body::numerics::Random;

#[test]
fn normal_numbers_have_the_moments_of_the_normal_distribution() {
    let mut random = Random::new(7, 0);
    let count = 20_000;
    let numbers: Vec<f64> = (0..count).map(|_| random.normal()).collect();
    let moment = |power: i32| numbers.iter().map(|x| x.powi(power)).sum::<f64>() / f64::from(count);
    // Standard errors of the moments of so many numbers: 0.007, 0.010, 0.027 and 0.069.
    for (power, expected, error) in [(1, 0.0, 0.03), (2, 1.0, 0.04), (3, 0.0, 0.11), (4, 3.0, 0.28)] {
        assert!((moment(power) - expected).abs() < error, "{power}: {}", moment(power));
    }
}

#[test]
fn sequences_of_one_seed_differ_and_repeat() {
    let first = |number: u64| {
        let mut random = Random::new(3, number);
        [random.share(), random.share()].map(f64::to_bits)
    };
    assert!(first(0) != first(1) && first(0) == first(0));
}
