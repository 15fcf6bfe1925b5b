//! A random local search in the unit cube, the same for the same seed.
//!
//! A (1+1) evolution strategy on random subspaces: Gaussian steps on one to four of the numbers, kept if better; the
//! step grows on success and shrinks on failure so that one trial in five succeeds (Rechenberg's rule; unverified), and
//! starts anew where it has become too small to matter.

use ambulo::numerics::Random;

/// Most numbers that one step changes.
const MOST_CHANGED: usize = 4;
/// Step at the start and at each new start, least and largest step: shares of a range.
const STEP: [f64; 3] = [0.2, 0.01, 0.4];
/// Growth of the step on success; four failures take it back.
const GROWTH: f64 = 1.5;

/// The best point found, and its cost.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Found {
    pub(super) place: Vec<f64>,
    pub(super) cost: f64,
}

/// Minimises a cost in the unit cube from a start with a number of evaluations. A NaN cost is worse than any other.
/// `better` is called for each improvement with the number of evaluations.
pub(super) fn least(
    start: Vec<f64>,
    evaluations: usize,
    seed: u64,
    cost: &dyn Fn(&[f64]) -> f64,
    better: &mut dyn FnMut(usize, &Found),
) -> Found {
    let rated = |place: Vec<f64>| {
        let cost = cost(&place);
        Found { place, cost: if cost.is_nan() { f64::INFINITY } else { cost } }
    };
    let mut random = Random::seeded(seed);
    let mut best = rated(start);
    let mut step = STEP[0];
    for done in 1..evaluations {
        let next = rated(stepped(&best.place, step, &mut random));
        if next.cost < best.cost {
            best = next;
            step = (step * GROWTH).min(STEP[2]);
            better(done, &best);
        } else {
            step *= GROWTH.powf(-0.25);
            if step < STEP[1] {
                step = STEP[0];
            }
        }
    }
    best
}

/// A neighbouring point, reflected at the walls of the cube.
fn stepped(place: &[f64], step: f64, random: &mut Random) -> Vec<f64> {
    let mut next = place.to_vec();
    for _ in 0..=random.below(MOST_CHANGED) {
        let chosen = random.below(next.len());
        let moved = next[chosen] + step * random.normal();
        let folded = if moved < 0.0 {
            -moved
        } else if moved > 1.0 {
            2.0 - moved
        } else {
            moved
        };
        next[chosen] = folded.clamp(0.0, 1.0);
    }
    next
}

#[cfg(test)]
mod tests {
    use super::*;

    const MIDDLE: [f64; 6] = [0.1, 0.9, 0.4, 0.55, 0.3, 0.75];

    /// Its axes differ and its first two numbers pull at each other.
    fn bowl(place: &[f64]) -> f64 {
        let off: Vec<f64> = place.iter().zip(MIDDLE).map(|(a, b)| a - b).collect();
        let own: f64 = off.iter().enumerate().map(|(i, x)| (1.0 + i as f64) * x * x).sum();
        own + off[0] * off[1]
    }

    #[test]
    fn the_minimum_of_a_quadratic_is_found() {
        let found = least(vec![0.5; 6], 4000, 1, &bowl, &mut |_, _| ());
        for (a, b) in found.place.iter().zip(MIDDLE) {
            assert!((a - b).abs() < 0.01, "{:?}, cost {}", found.place, found.cost);
        }
    }

    #[test]
    fn a_seed_gives_the_same_path_and_another_seed_another() {
        let run = |seed| least(vec![0.5; 6], 200, seed, &bowl, &mut |_, _| ());
        assert_eq!(run(7), run(7));
        assert_ne!(run(7).place, run(8).place);
    }

    #[test]
    fn the_search_stays_in_the_cube_and_steps_over_what_is_no_number() {
        let cost = |place: &[f64]| {
            assert!(place.iter().all(|x| (0.0..=1.0).contains(x)), "{place:?}");
            if place[0] < 0.3 { f64::NAN } else { place.iter().sum::<f64>() }
        };
        let found = least(vec![0.9; 3], 3000, 3, &cost, &mut |_, _| ());
        assert!((0.3..0.32).contains(&found.place[0]) && found.place[1] < 0.02, "{:?}", found.place);
    }

    #[test]
    fn normal_deviates_have_mean_zero_and_deviation_one() {
        let mut random = Random::seeded(5);
        let all: Vec<f64> = (0..20_000).map(|_| random.normal()).collect();
        let mean = all.iter().sum::<f64>() / 2e4;
        let square = all.iter().map(|x| x * x).sum::<f64>() / 2e4;
        assert!(mean.abs() < 0.03 && (square - 1.0).abs() < 0.05, "{mean}, {square}");
    }
}
