//! The algorithm of section 3.1 of the 1997 paper (docs/PAPER.md), written out for a loop of three bars and the ground
//! with a driven crank. In a plane a body has x, y and an angle, and a hinge is two scalar constraints. The test
//! `three_steps` compares the result with that of the engine.
//!
//!     cargo run -p ambulo-walk --example three_steps

#![allow(clippy::print_stdout, reason = "an example shows what it computed")]

use ambulo_walk::engine::Signal;
use ambulo_walk::numerics::elementary::sin_cos;
use ambulo_walk::spatial::{STANDARD_GRAVITY, Vec3};

/// Coordinates of three bodies, or one number for each of nine constraints.
pub(crate) type Nine = [f64; 9];
/// Length of the bars [m]: crank and rocker have the same, the coupler that of the ground. Mass of a bar [kg].
pub(crate) const LENGTHS: [f64; 3] = [0.2, 0.5, 0.2];
pub(crate) const MASSES: [f64; 3] = [0.6, 1.5, 0.6];
/// Angle of the crank [rad].
pub(crate) const DRIVE: Signal = Signal::Sine { amplitude: 0.3, frequency_hz: 1.2, phase: 0.7, offset: 1.0 };

/// The bars: half vectors along them [m], diagonal of M, velocities of the coordinates.
pub(crate) struct Linkage {
    pub(crate) half: [Vec3; 3],
    pub(crate) mass: Nine,
    pub(crate) v: Nine,
}

impl Linkage {
    /// The linkage at an instant at which its crank turns.
    pub(crate) fn new() -> Linkage {
        let [angle, rate, _] = DRIVE.at(0.0);
        let (sin, cos) = sin_cos(angle);
        let (arm, base) = (Vec3::new(cos, sin, 0.0) * LENGTHS[0], Vec3::x() * LENGTHS[1]);
        let velocity = (Vec3::z() * rate).cross(&arm);
        let centers = [velocity / 2.0, velocity, velocity / 2.0];
        let spin = [rate, 0.0, rate];
        Linkage {
            half: [arm / 2.0, base / 2.0, arm / 2.0],
            mass: std::array::from_fn(|k| MASSES[k / 3] * if k % 3 == 2 { LENGTHS[k / 3].powi(2) / 12.0 } else { 1.0 }),
            v: std::array::from_fn(|k| if k % 3 == 2 { spin[k / 3] } else { centers[k / 3][k % 3] }),
        }
    }

    /// A hinge: points at r from the centres of two bodies (`None`: the ground) coincide along x and y. Returns rows of
    /// J, and the accelerations that the points have by turning alone (J̇ v).
    fn hinge(&self, points: [Option<(usize, Vec3)>; 2]) -> [(Nine, f64); 2] {
        [0, 1].map(|axis| {
            let (mut row, mut turning) = ([0.0; 9], 0.0);
            for (sign, (body, r)) in [1.0, -1.0].into_iter().zip(points).filter_map(|(s, p)| Some((s, p?))) {
                (row[3 * body + axis], row[3 * body + 2]) = (sign, sign * if axis == 0 { -r.y } else { r.x });
                turning -= sign * self.v[3 * body + 2].powi(2) * r[axis];
            }
            (row, turning)
        })
    }

    /// M⁻¹ Jᵀ λ: the accelerations that constraint forces add.
    fn response(&self, rows: &[(Nine, f64)], lambda: &Nine) -> Nine {
        std::array::from_fn(|k| rows.iter().zip(lambda).map(|((row, _), l)| row[k] * l).sum::<f64>() / self.mass[k])
    }

    /// Accelerations of the coordinates, and constraint forces; the last three are those of the loop and of the drive.
    pub(crate) fn solve(&self) -> (Nine, Nine) {
        let [crank, coupler, rocker] = [0, 1, 2].map(|bar| move |sign: f64| Some((bar, self.half[bar] * sign)));
        let hinges =
            [[crank(-1.0), None], [coupler(-1.0), crank(1.0)], [rocker(-1.0), None], [coupler(1.0), rocker(1.0)]];
        // Section 3.2: the drive is one more constraint, with the acceleration that its motion prescribes.
        let drive = ([0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], -DRIVE.at(0.0)[2]);
        let rows: Vec<(Nine, f64)> = hinges.iter().flat_map(|points| self.hinge(*points)).chain([drive]).collect();
        // Step 1: the bodies move by external forces alone.
        let free: Nine = std::array::from_fn(|k| if k % 3 == 1 { -STANDARD_GRAVITY } else { 0.0 });
        // Step 2: their accelerations along each constraint are its errors.
        let errors: Nine = std::array::from_fn(|k| dot(&rows[k].0, &free) + rows[k].1);
        // Step 3: forces that cancel the errors, J M⁻¹ Jᵀ λ = -errors, by the conjugate gradient of Fletcher and
        // Reeves.
        let mut left = errors.map(|error| -error);
        let (mut lambda, mut along, least) = ([0.0; 9], left, 1e-32 * dot(&errors, &errors));
        for _ in 0..100 {
            if dot(&left, &left) <= least {
                break;
            }
            let (size, moved) = (dot(&left, &left), self.response(&rows, &along));
            let change: Nine = std::array::from_fn(|k| dot(&rows[k].0, &moved));
            let alpha = size / dot(&along, &change);
            (lambda, left) = (plus(&lambda, alpha, &along), plus(&left, -alpha, &change));
            along = plus(&left, dot(&left, &left) / size, &along);
        }
        (plus(&free, 1.0, &self.response(&rows, &lambda)), lambda)
    }
}

fn dot(a: &Nine, b: &Nine) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn plus(a: &Nine, factor: f64, b: &Nine) -> Nine {
    std::array::from_fn(|k| a[k] + factor * b[k])
}

/// Prints what the drive and the loop bear.
pub(crate) fn main() {
    let (accelerations, forces) = Linkage::new().solve();
    println!("accelerations: x, y [m/s²] and angle [rad/s²] of each bar: {accelerations:.4?}");
    println!("force in the hinge that closes the loop, on the coupler: {:.6?} N", &forces[6..8]);
    println!("moment of the drive: {:.6} N.m", forces[8]);
}
