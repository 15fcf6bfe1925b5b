//! Anderson mixing: reaches the fixed point of a map in fewer iterations.
//!
//! Of a map x -> g(x), the last inputs x_j and outputs g_j are known, newest first. With f = g - x, the weights θ that
//! minimise |f_0 - Σ θ_j (f_0 - f_j)| give the next input g_0 - Σ θ_j (g_0 - g_j). For a linear map with at most as
//! many dimensions as earlier iterations, this is the fixed point.
//!
//! Used for friction: its bound follows the normal forces, which for a box that slides on legs depend on two angles.
//!
//! Source: Anderson 1965, "Iterative procedures for nonlinear integral equations" (unverified); the equations are
//! above.

/// Number of earlier iterations kept.
const DEPTH: usize = 2;
/// Relative tolerance of linear dependence between iterations.
const INDEPENDENT: f64 = 1e-8;

/// The last iterations, newest first.
#[derive(Debug, Clone, Default)]
pub(super) struct AndersonMixing {
    rounds: [Round; DEPTH + 1],
    /// Differences between iterations, each orthogonal to those before.
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

impl AndersonMixing {
    /// Forgets the earlier iterations, because the map has changed.
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
            // The parts of f_0 - f_j and g_0 - g_j orthogonal to those before (Gram-Schmidt).
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
            if squares > INDEPENDENT * INDEPENDENT * whole {
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
