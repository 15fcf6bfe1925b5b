//! Fixed points reached in fewer rounds: Anderson's mixing of the last three.
//!
//! Of a map x -> g(x), the last inputs x_j and outputs g_j are known, newest first. With f = g - x, the weights θ that
//! make f_0 - Σ θ_j (f_0 - f_j) least give the next input g_0 - Σ θ_j (g_0 - g_j). Of a linear map in as many dimensions
//! as there are earlier rounds this is the fixed point.
//!
//! Friction needs it: its radius follows the normal force, and a box that slides on its legs leans on them by two angles.
//!
//! Source: Anderson 1965, "Iterative procedures for nonlinear integral equations" (unverified); the equations are above.

/// Earlier rounds kept.
const DEPTH: usize = 2;
/// A direction whose part aside from the others is below this share of itself brings nothing new.
const NEW: f64 = 1e-8;

/// The last rounds, newest first.
#[derive(Debug, Clone, Default)]
pub(super) struct Mixing {
    rounds: [Round; DEPTH + 1],
    /// Differences between rounds, each made perpendicular to the one before.
    basis: [Round; DEPTH],
    left: Vec<f64>,
    count: usize,
}

#[derive(Debug, Clone, Default)]
struct Round {
    /// f = g - x.
    change: Vec<f64>,
    output: Vec<f64>,
}

impl Mixing {
    /// The map is another one now.
    pub(super) fn forget(&mut self) {
        self.count = 0;
    }

    /// Replaces `output` = g(`input`) by the next input.
    pub(super) fn mix(&mut self, input: &[f64], output: &mut [f64]) {
        self.rounds.rotate_right(1);
        let [newest, earlier @ ..] = &mut self.rounds;
        set_difference(&mut newest.change, output, input);
        newest.output.clear();
        newest.output.extend_from_slice(output);
        self.left.clone_from(&newest.change);
        let mut used = 0;
        for round in earlier.iter().take(self.count) {
            // Of f_0 - f_j and g_0 - g_j, what is aside from those before (Gram and Schmidt).
            let (before, rest) = self.basis.split_at_mut(used);
            let own = &mut rest[0];
            set_difference(&mut own.change, &newest.change, &round.change);
            set_difference(&mut own.output, &newest.output, &round.output);
            let whole = dot(&own.change, &own.change);
            for other in before.iter() {
                let share = dot(&other.change, &own.change) / dot(&other.change, &other.change);
                subtract(share, &other.change, &mut own.change);
                subtract(share, &other.output, &mut own.output);
            }
            let squares = dot(&own.change, &own.change);
            if squares > NEW * NEW * whole {
                let share = dot(&own.change, &self.left) / squares;
                subtract(share, &own.change, &mut self.left);
                subtract(share, &own.output, output);
                used += 1;
            }
        }
        self.count = (self.count + 1).min(DEPTH);
    }
}

fn set_difference(of: &mut Vec<f64>, x: &[f64], y: &[f64]) {
    of.clear();
    of.extend(x.iter().zip(y).map(|(x, y)| x - y));
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

fn subtract(share: f64, x: &[f64], from: &mut [f64]) {
    from.iter_mut().zip(x).for_each(|(y, x)| *y -= share * x);
}
