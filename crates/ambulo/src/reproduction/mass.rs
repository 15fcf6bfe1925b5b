//! (f) Figure 6: the mass of the figure and its hip torque.

use super::claim::{Numbers, Statement, number, numbers};
use super::evidence::{MASS, MASSES, Scope};
use super::mode::Run;
use super::steady::{Steady, correlation, rms};
use crate::model::Side;

/// Largest departure of torques from the ratio of the masses that is rounding.
const EXACT: f64 = 1e-6;

pub(super) const EXACTLY: Statement = Statement {
    id: "f1",
    paper: "the amplitude of the torques changes in a scale close to that of the weight, the shape stays",
    headline: "departure_60_kg",
    scope: Scope::Full,
    measure: |evidence| {
        if evidence.masses.is_empty() {
            return Numbers::new();
        }
        let off = |run: &Run, mass: f64| departure(&evidence.masses[1], run, mass / MASS);
        numbers([
            ("departure_60_kg", off(&evidence.masses[0], MASSES[0])),
            ("departure_100_kg", off(&evidence.masses[2], MASSES[2])),
        ])
    },
    judge: |paper, _| {
        let worst = number(paper, "departure_60_kg").max(number(paper, "departure_100_kg"));
        let note = format!(
            "passes if all torques at 60 and 100 kg are those at 80 kg times the ratio of the masses within {EXACT:e} of the largest, with \
             lengths and radii as they were, rigid soles and the motion prescribed: then mass is but the unit of force; {worst:.1e}"
        );
        (worst < EXACT, note)
    },
};

pub(super) const NEARLY: Statement = Statement {
    id: "f2",
    paper: "the change of mass slightly changes the torques during the swing phase too",
    headline: "dense_100_kg_swing_difference_percent",
    scope: Scope::Full,
    measure: |evidence| {
        let mut all = Numbers::new();
        for (what, runs) in [("soft", &evidence.soft_masses), ("dense", &evidence.dense_masses)] {
            for (run, mass) in runs.iter().zip(MASSES).filter(|(_, mass)| (mass - MASS).abs() > 1.0) {
                let parts = compare(&runs[1], run, mass / MASS);
                for (part, Parts { ratio, difference, shape }) in [("stance", parts[0]), ("swing", parts[1])] {
                    all.push((format!("{what}_{mass:.0}_kg_{part}_ratio"), ratio));
                    all.push((format!("{what}_{mass:.0}_kg_{part}_difference_percent"), 100.0 * difference));
                    all.push((format!("{what}_{mass:.0}_kg_{part}_shape_r"), shape));
                }
            }
        }
        all
    },
    judge: |paper, _| {
        let most = |what: &str, part: &str| {
            let of = |mass: &str| number(paper, &format!("{what}_{mass}_kg_{part}_difference_percent"));
            of("60").max(of("100"))
        };
        let worst = most("dense", "swing");
        let note = format!(
            "passes if, with segments and soles as thick as the density asks, the hip's torque in swing differs after scaling by the mass \
             by more than rounding and by less than 20 % of its root mean square: at most {worst:.2} % (in stance {:.2} %). With lengths \
             and radii as they were nothing differs (f1); the paper does not say which of its radii grew with the mass. In soft shoes of \
             one stiffness, which the paper did not have yet: {:.1} % (in stance {:.1} %)",
            most("dense", "stance"),
            most("soft", "swing"),
            most("soft", "stance"),
        );
        (worst > 100.0 * EXACT && worst < 20.0, note)
    },
};

/// Largest |τ/ratio - τ₀| of hip, knee and ankle over the steady cycles, over the largest |τ₀|.
fn departure(base: &Run, run: &Run, ratio: f64) -> f64 {
    let (Ok(base), Ok(other)) = (Steady::of(base), Steady::of(run)) else { return f64::NAN };
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for (_, coordinate) in super::convergence::JOINTS {
        let (a, b) = (base.effort(coordinate), other.effort(coordinate));
        for row in base.rows() {
            worst = worst.max((b[row] / ratio - a[row]).abs());
            largest = largest.max(a[row].abs());
        }
    }
    worst / largest
}

/// A part of the cycle, compared.
#[derive(Clone, Copy)]
struct Parts {
    /// Root mean square over that of the base.
    ratio: f64,
    /// Root mean square of the difference after scaling, over that of the base.
    difference: f64,
    /// Correlation.
    shape: f64,
}

/// Hip torque of the right leg while its foot presses in the base, and while it does not.
fn compare(base: &Run, run: &Run, ratio: f64) -> [Parts; 2] {
    let nothing = Parts { ratio: f64::NAN, difference: f64::NAN, shape: f64::NAN };
    let (Ok(base), Ok(other)) = (Steady::of(base), Steady::of(run)) else { return [nothing; 2] };
    let (a, b) = (base.effort("hip_flexion_r"), other.effort("hip_flexion_r"));
    let foot = base.run.recording.foot(Side::Right);
    [true, false].map(|stance| {
        let rows: Vec<usize> = base.rows().filter(|row| foot.loaded(*row) == stance).collect();
        let of = |series: &[f64]| rows.iter().map(|row| series[*row]).collect::<Vec<f64>>();
        let (a, b) = (of(&a), of(&b));
        let off: Vec<f64> = a.iter().zip(&b).map(|(a, b)| b / ratio - a).collect();
        Parts { ratio: rms(&b) / rms(&a), difference: rms(&off) / rms(&a), shape: correlation(&a, &b) }
    })
}
