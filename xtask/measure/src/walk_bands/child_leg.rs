//! Estimates the leg length of the subjects of the tables, which is not published, from the tables themselves.
//!
//! Power is moment times angular velocity, so the tables of moment M, angle θ (per cycle) and power P give the duration
//! of a cycle,
//!
//! ```text
//! P = M dθ/ds / T      T by least squares over the cycle's samples, s = t / T
//! ```
//!
//! and with the tables' dimensionless step frequency f* = (2/T) √(L/g) the leg:  L = g (f* T / 2)².
//!
//! Means of products are not products of means, so the joints give different lengths. The lengths from the knee vary
//! least over the speeds and are plausible for children; the ankle correlates better and gives the leg of an adult. The
//! choice of the knee is a judgement, so the page shows all three and the results that depend on the choice.

use crate::harmonics::{harmonics, value_slope_curvature};
use crate::normative::{self, CADENCES, Curves, Sheet};
use ambulo::numerics::correlation;
use ambulo::spatial::STANDARD_GRAVITY;

/// The leg length from one joint.
#[derive(Debug, Clone)]
pub(crate) struct FromJoint {
    pub(crate) joint: &'static str,
    /// At five speeds [m].
    pub(crate) legs: [f64; 5],
    /// Correlation of power with moment times angular velocity at five speeds.
    pub(crate) correlations: [f64; 5],
}

impl FromJoint {
    /// Mean over the speeds [m].
    pub(crate) fn mean(&self) -> f64 {
        self.legs.iter().sum::<f64>() / self.legs.len() as f64
    }

    /// Shortest and longest [m].
    pub(crate) fn range(&self) -> [f64; 2] {
        self.legs.iter().fold([f64::INFINITY, 0.0], |[least, most], leg| [leg.min(least), leg.max(most)])
    }
}

/// Names in the tables: power, angle, moment. Moments are extensor and plantarflexor positive, angles flexion and
/// dorsiflexion.
const JOINTS: [(&str, &str, &str); 3] = [
    ("Knee", "Knee Flex/Extension", "Knee Ext/Flexion"),
    ("Hip", "Hip Flex/Extension", "Hip Ext/Flexion"),
    ("Ankle", "Ankle Dorsi/Plantarflexion", "Ankle Dorsi/Plantarflexion"),
];

/// Knee, hip and ankle; the first is the one to use.
pub(crate) fn legs() -> Result<[FromJoint; 3], String> {
    let read = |(power, angle, moment)| {
        let curves = [(Sheet::Powers, power), (Sheet::Angles, angle), (Sheet::Moments, moment)];
        let [powers, angles, moments] = curves.map(|(sheet, name)| normative::curves(sheet, name));
        Ok(from_joint(power, &powers?, &angles?, &moments?))
    };
    let [knee, hip, ankle]: [Result<FromJoint, String>; 3] = JOINTS.map(read);
    Ok([knee?, hip?, ankle?])
}

fn from_joint(joint: &'static str, powers: &Curves, angles: &Curves, moments: &Curves) -> FromJoint {
    let (mut legs, mut correlations) = ([0.0; 5], [0.0; 5]);
    for i in 0..5 {
        let work = work_rate(&angles[i], &moments[i]);
        let cycle_s = dot(&work, &work) / dot(&work, &powers[i]);
        legs[i] = STANDARD_GRAVITY * (0.5 * CADENCES[i] * cycle_s).powi(2);
        correlations[i] = correlation(&work, &powers[i]);
    }
    FromJoint { joint, legs, correlations }
}

/// Moment times angular velocity per cycle [W.s/kg]; an extensor moment works where flexion falls.
fn work_rate(angles: &[f64], moments: &[f64]) -> Vec<f64> {
    let curve = harmonics(angles);
    let count = (angles.len() - 1) as f64;
    let flexion = |i: usize| value_slope_curvature(&curve, i as f64 / count)[1].to_radians();
    moments.iter().enumerate().map(|(i, moment)| -moment * flexion(i)).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn the_leg_of_made_up_people_is_found_again() {
        let (leg, samples) = (0.8, normative::SAMPLES);
        let phase = |i: usize| TAU * i as f64 / (samples - 1) as f64;
        let angles: Vec<f64> = (0..samples).map(|i| 20.0 * phase(i).sin()).collect();
        let moments: Vec<f64> = (0..samples).map(|i| 0.4 * (phase(i) + 0.3).cos()).collect();
        let powers = CADENCES.map(|cadence| {
            let cycle_s = 2.0 / cadence * f64::sqrt(leg / STANDARD_GRAVITY);
            let velocity = |i: usize| 20f64.to_radians() * TAU / cycle_s * phase(i).cos();
            (0..samples).map(|i| -moments[i] * velocity(i)).collect::<Vec<f64>>()
        });
        let all = |curve: &Vec<f64>| -> Curves { std::array::from_fn(|_| curve.clone()) };
        let found = from_joint("made up", &powers, &all(&angles), &all(&moments));
        for (length, r) in found.legs.iter().zip(found.correlations) {
            assert!((length - leg).abs() < 1e-9 && (r - 1.0).abs() < 1e-9, "{length} {r}");
        }
    }
}
