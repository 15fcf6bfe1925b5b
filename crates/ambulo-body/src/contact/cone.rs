//! Coulomb's friction cone: projection of a contact force onto it, with the derivative.
//!
//! The nearest force λ of the cone |λ_t| ≤ μ λ_n to a force z = (z_n, z_t), normal part first:
//!
//!   |z_t| ≤ μ z_n         λ = z
//!   μ |z_t| ≤ -z_n        λ = 0
//!   else                  λ_n = (z_n + μ |z_t|)/(1 + μ²),  λ_t = μ λ_n ẑ
//!
//! The projection is the gradient of ½ |λ|², so its derivative ∂λ/∂z is symmetric with eigenvalues between 0 and 1.

/// Projects a force onto Coulomb's cone with this friction coefficient, in the frame of the contact (normal, first
/// tangent, second tangent) [N]: the nearest force λ of the cone, and ∂λ/∂z, symmetric.
#[inline]
#[must_use]
pub fn project_onto_cone(z: [f64; 3], friction: f64) -> ([f64; 3], [[f64; 3]; 3]) {
    let [normal, x, y] = z;
    let length = (x * x + y * y).sqrt();
    if length <= friction * normal {
        return (z, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    }
    if friction * length <= -normal || length <= 0.0 {
        return ([0.0; 3], [[0.0; 3]; 3]);
    }
    let (x, y) = (x / length, y / length);
    let share = 1.0 / (1.0 + friction * friction);
    let pushed = (normal + friction * length) * share;
    // Along the edge (1, μ ẑ), and around the cone.
    let edge = [1.0, friction * x, friction * y];
    let around = friction * pushed / length;
    let mut slope = [[0.0; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            slope[i][j] = share * edge[i] * edge[j];
        }
    }
    let across = [[y * y, -x * y], [-x * y, x * x]];
    for i in 0..2 {
        for j in 0..2 {
            slope[1 + i][1 + j] += around * across[i][j];
        }
    }
    ([pushed, pushed * edge[1], pushed * edge[2]], slope)
}
