//! Claim (f), figure 6: the effect of the mass of the figure on the hip torque.

use super::claim::{ClaimKind, Numbers, Statement, number, numbers};
use super::evidence::{MASSES, Scope};
use super::mode::Run;
use super::paper_human::MASS;
use super::steady::Steady;
use ambulo_body::model::Side;
use ambulo_body::numerics::{correlation, rms};

/// The largest difference of torques from the ratio of the masses that is a rounding error.
const EXACT: f64 = 1e-6;

pub(super) const EXACTLY: Statement = Statement {
    id: "f1",
    kind: ClaimKind::ByConstruction,
    paper: "the amplitude of the torques changes in a scale close to that of the weight, the shape stays",
    criterion: "all torques at 60 and 100 kg are equal to those at 80 kg times the ratio of the masses, within 1e-6 of \
        the largest, \
        with the same lengths and radii",
    former: None,
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
        let note =
            format!("found {worst:.1e}: with rigid soles and a prescribed motion the mass only sets the unit of force");
        (worst < EXACT, note)
    },
};

pub(super) const NEARLY: Statement = Statement {
    id: "f2",
    kind: ClaimKind::Paper,
    paper: "the change of mass slightly changes the torques during the swing phase too",
    criterion: "with the same density, and therefore other radii of segments and soles, the hip torque in swing, \
        scaled by the mass, \
        differs by more than rounding and by less than 20 % of its root mean square",
    former: None,
    headline: "dense_100_kg_swing_difference_percent",
    scope: Scope::Sampled,
    measure: |evidence| {
        let mut all = Numbers::new();
        for (what, runs) in [("soft", &evidence.soft_masses), ("dense", &evidence.dense_masses)] {
            for (run, mass) in runs.iter().zip(MASSES).filter(|(_, mass)| (mass - MASS).abs() > 1.0) {
                let parts = compare(&runs[1], run, mass / MASS);
                for (part, Comparison { ratio, difference, shape }) in [("stance", parts[0]), ("swing", parts[1])] {
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
            "at most {worst:.2} % (in \
             stance {:.2} %). With the \
             same lengths and radii there is no difference (f1); the paper does not say which radii grew with the \
             mass. In soft shoes of \
             constant stiffness, which the paper did not use: {:.1} % (in stance {:.1} %)",
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

/// Comparison of a part of the cycle.
#[derive(Clone, Copy)]
struct Comparison {
    /// Root mean square, relative to the base [1].
    ratio: f64,
    /// Root mean square of the difference after scaling, relative to the base [1].
    difference: f64,
    /// Correlation.
    shape: f64,
}

/// Compares the hip torque of the right leg while its foot is loaded in the base, and while it is not.
fn compare(base: &Run, run: &Run, ratio: f64) -> [Comparison; 2] {
    let nothing = Comparison { ratio: f64::NAN, difference: f64::NAN, shape: f64::NAN };
    let (Ok(base), Ok(other)) = (Steady::of(base), Steady::of(run)) else { return [nothing; 2] };
    let (a, b) = (base.effort("hip_flexion_r"), other.effort("hip_flexion_r"));
    let foot = base.run.recording.foot(Side::Right);
    [true, false].map(|stance| {
        let rows: Vec<usize> = base.rows().filter(|row| foot.loaded(*row) == stance).collect();
        let of = |series: &[f64]| rows.iter().map(|row| series[*row]).collect::<Vec<f64>>();
        let (a, b) = (of(&a), of(&b));
        let off: Vec<f64> = a.iter().zip(&b).map(|(a, b)| b / ratio - a).collect();
        Comparison { ratio: rms(&b) / rms(&a), difference: rms(&off) / rms(&a), shape: correlation(&a, &b) }
    })
}
