//! Symmetric matrices whose unknowns form a tree: an entry is zero unless one of its unknowns is on the path of the
//! other to the root.
//!
//! The normal equations of a marker fit are of this kind: a marker on a hand does not depend on a knee. Each row has an
//! entry for each unknown on its path, from the root to itself, and nothing else. The factors of
//!
//!   A = Lᵀ D L,      L unit lower triangular
//!
//! have the same entries, because eliminating an unknown changes only the unknowns on its own path. The path of an
//! unknown on the path is the beginning of the path, so that each elimination adds a multiple of the beginning of one
//! row to another row.
//!
//! | code | symbol |
//! |---|---|
//! | `entries` | A, then L below the diagonal and D on it |
//! | `path` | unknowns of the entries |
//!
//! Unknowns that move bodies on several branches (coordinates that drive others) also have entries outside the tree of
//! the joints. The tree is therefore that of the elimination: the parent of an unknown is the first one that its
//! elimination changes. The path then has every entry that is not zero, and a few that are.
//!
//! Source: R. Featherstone 2005, "Efficient factorization of the joint-space inertia matrix for branched kinematic
//! trees", Int. J. Robot. Res. 24:487-500 (unverified); elimination trees: T.A. Davis 2006, "Direct Methods for Sparse
//! Linear Systems", chapter 4 (unverified). Cost: half the sum of the squared lengths of all paths; for 43 unknowns of
//! a whole body a fifth of a dense factor's. Pinned by: tests/kinematics_branch_matrix.rs (dense matrices),
//! tests/marker_fit.rs

/// Places of the entries of matrices with the same tree.
#[derive(Debug, Clone)]
pub struct Branches {
    /// First entry of the row of each unknown.
    start: Vec<usize>,
    /// Number of unknowns on the path before each unknown.
    level: Vec<usize>,
    path: Vec<usize>,
    /// All unknowns, from the root outwards.
    outwards: Vec<usize>,
}

impl Branches {
    /// The tree of matrices with entries for these pairs of unknowns and for each unknown with itself. `outwards` has
    /// all unknowns; those of a body come after those of its parent.
    pub fn new(outwards: Vec<usize>, pairs: impl Iterator<Item = (usize, usize)>) -> Branches {
        let n = outwards.len();
        let mut place = vec![0; n];
        outwards.iter().enumerate().for_each(|(k, &u)| place[u] = k);
        // Places of the unknowns before each one that its elimination changes.
        let mut changed = vec![vec![false; n]; n];
        for (a, b) in pairs {
            let (a, b) = (place[a].max(place[b]), place[a].min(place[b]));
            changed[a][b] = true;
        }
        let mut parents = vec![None; n];
        for k in (0..n).rev() {
            let parent = (0..k).rev().find(|&j| changed[k][j]);
            parents[k] = parent;
            if let Some(parent) = parent {
                let row = std::mem::take(&mut changed[k]);
                changed[parent].iter_mut().zip(&row).take(parent).for_each(|(has, new)| *has |= *new);
            }
        }
        let mut branches = Branches { start: vec![0; n], level: vec![0; n], path: Vec::new(), outwards };
        for (k, parent) in parents.iter().enumerate() {
            let own = branches.outwards[k];
            branches.start[own] = branches.path.len();
            if let Some(parent) = *parent {
                let row = branches.row(branches.outwards[parent]);
                branches.path.extend_from_within(row);
            }
            branches.level[own] = branches.path.len() - branches.start[own];
            branches.path.push(own);
        }
        branches
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.start.len()
    }

    /// Number of entries.
    pub fn entries(&self) -> usize {
        self.path.len()
    }

    /// Place of the entry of two unknowns, one of which is on the path of the other.
    pub(super) fn entry(&self, a: usize, b: usize) -> usize {
        let entry =
            if self.level[a] >= self.level[b] { self.start[a] + self.level[b] } else { self.start[b] + self.level[a] };
        debug_assert!([a, b].contains(&self.path[entry]), "unknowns {a} and {b} are on different branches");
        entry
    }

    /// The entry on the diagonal.
    pub fn diagonal(&self, unknown: usize) -> usize {
        self.start[unknown] + self.level[unknown]
    }

    /// Unknowns of each entry: that of the row, that of the column, and the place of the entry.
    pub fn each_entry(&self) -> impl Iterator<Item = (usize, usize, usize)> + '_ {
        self.outwards.iter().flat_map(move |&row| self.row(row).map(move |entry| (row, self.path[entry], entry)))
    }

    /// Places of the entries of a row, from the root to the diagonal.
    fn row(&self, unknown: usize) -> std::ops::Range<usize> {
        self.start[unknown]..self.diagonal(unknown) + 1
    }

    /// Replaces a matrix by its factors. Returns false if it is not positive definite.
    pub fn factor(&self, entries: &mut [f64]) -> bool {
        for &own in self.outwards.iter().rev() {
            let (inner, row) = entries.split_at_mut(self.start[own]);
            let (row, diagonal) = row.split_at_mut(self.level[own]);
            let pivot = diagonal[0];
            if !(pivot > 0.0 && pivot.is_finite()) {
                return false;
            }
            for level in (0..row.len()).rev() {
                let share = row[level] / pivot;
                let other = self.start[self.path[self.start[own] + level]];
                let changed = &mut inner[other..=other + level];
                changed.iter_mut().zip(&row[..=level]).for_each(|(a, b)| *a -= share * b);
                row[level] = share;
            }
        }
        true
    }

    /// Solves A x = b in place, with the factors.
    pub fn solve(&self, factors: &[f64], x: &mut [f64]) {
        for &own in self.outwards.iter().rev() {
            let value = x[own];
            for (entry, &other) in self.before(own, factors) {
                x[other] -= entry * value;
            }
        }
        for &own in &self.outwards {
            let known: f64 = self.before(own, factors).map(|(entry, &other)| entry * x[other]).sum();
            x[own] = x[own] / factors[self.diagonal(own)] - known;
        }
    }

    /// The diagonal of A⁻¹, with the factors: entry k is Σ z²/D with zᵀ = eₖᵀ L⁻¹, which is zero outside the path of k.
    pub fn inverse_diagonal(&self, factors: &[f64], scratch: &mut [f64], diagonal: &mut [f64]) {
        for &own in &self.outwards {
            let row = self.row(own);
            let z = &mut scratch[..row.len()];
            z.fill(0.0);
            z[row.len() - 1] = 1.0;
            let mut sum = 0.0;
            for (level, &unknown) in self.path[row].iter().enumerate().rev() {
                let value = z[level];
                sum += value * value / factors[self.diagonal(unknown)];
                let inner = &factors[self.start[unknown]..][..level];
                z[..level].iter_mut().zip(inner).for_each(|(z, entry)| *z -= value * entry);
            }
            diagonal[own] = sum;
        }
    }

    /// Makes the row and the column of some unknowns those of the unit matrix.
    pub fn hold(&self, entries: &mut [f64], held: &[bool]) {
        for (row, column, entry) in self.each_entry() {
            if held[row] || held[column] {
                entries[entry] = if row == column { 1.0 } else { 0.0 };
            }
        }
    }

    /// Entries of a row before the diagonal, with their unknowns.
    fn before<'a>(&'a self, unknown: usize, entries: &'a [f64]) -> impl Iterator<Item = (f64, &'a usize)> {
        let row = self.start[unknown]..self.diagonal(unknown);
        entries[row.clone()].iter().copied().zip(&self.path[row])
    }
}
