//! Coulomb's friction cone.

use ambulo_body::contact::project_onto_cone;

const FORCES: [[f64; 3]; 6] =
    [[2.0, 0.3, -0.4], [1.0, 3.0, 1.0], [-0.2, 1.0, -2.0], [-3.0, 0.5, 0.2], [-1.0, 1.0, 1.0], [0.5, -0.6, 0.0]];

#[test]
fn the_projection_lies_in_the_cone_and_leaves_a_rest_in_its_polar() {
    for z in FORCES {
        for friction in [0.0, 0.3, 1.5] {
            let ([n, x, y], _) = project_onto_cone(z, friction);
            assert!(x.hypot(y) <= friction * n + 1e-15 && n >= 0.0);
            let rest = [z[0] - n, z[1] - x, z[2] - y];
            // Moreau: the rest is orthogonal to the projection and lies in the polar cone, μ |r_t| ≤ -r_n.
            assert!((rest[0] * n + rest[1] * x + rest[2] * y).abs() < 1e-14);
            assert!(friction * rest[1].hypot(rest[2]) <= -rest[0] + 1e-14);
        }
    }
}

#[test]
fn the_slope_is_that_of_differences() {
    let h = 1e-6;
    for z in FORCES {
        let (_, slope) = project_onto_cone(z, 0.7);
        for j in 0..3 {
            let (mut more, mut less) = (z, z);
            more[j] += h;
            less[j] -= h;
            let (more, less) = (project_onto_cone(more, 0.7).0, project_onto_cone(less, 0.7).0);
            for i in 0..3 {
                assert!(((more[i] - less[i]) / (2.0 * h) - slope[i][j]).abs() < 1e-8, "{z:?} {i} {j}");
            }
        }
    }
}
