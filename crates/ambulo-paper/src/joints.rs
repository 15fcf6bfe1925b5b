//! Claim (h), figure 4: hip, knee and ankle torques of the standard gait.

use super::claim::{ClaimKind, Numbers, Statement, number, numbers};
use super::convergence::JOINTS;
use super::evidence::Scope;
use super::steady::Steady;
use ambulo_body::model::Side;
use ambulo_body::numerics::{correlation, mean, range, rms};

/// A change of a curve within one millisecond by more than this share of its range is a jump.
const JUMP: f64 = 0.05;
/// Jumps per cycle up to which a curve counts as rather continuous.
const FEW: f64 = 4.0;

pub(super) const ORDER: Statement = Statement {
    id: "h1",
    kind: ClaimKind::Paper,
    paper: "torques at the hip are greater than at the knee, those at the ankle are lower",
    criterion: "the largest torques of hip, knee and ankle are in this order",
    former: None,
    headline: "hip_largest_nm",
    scope: Scope::Brief,
    measure: |evidence| {
        let mut numbers = Numbers::new();
        let Ok(steady) = Steady::of(evidence.standard()) else { return numbers };
        for (joint, coordinate) in JOINTS {
            let curve = steady.mean_cycle(&steady.effort(coordinate));
            numbers.push((format!("{joint}_largest_nm"), curve.iter().fold(0.0_f64, |m, x| m.max(x.abs()))));
            numbers.push((format!("{joint}_rms_nm"), rms(&curve)));
        }
        numbers
    },
    judge: |paper, corrected| {
        let of = |joint: &str, numbers: &Numbers| number(numbers, &format!("{joint}_largest_nm"));
        let pass = of("hip", paper) > of("knee", paper) && of("knee", paper) > of("ankle", paper);
        let better = corrected.map_or(String::new(), |numbers| {
            format!(
                "; corrected: hip {:.0}, knee {:.0}, ankle {:.0} N.m",
                of("hip", numbers),
                of("knee", numbers),
                of("ankle", numbers)
            )
        });
        let note = format!(
            "in people the ankle has the largest torque (1.2 to 1.6 \
             N.m/kg, hip 0.9). The order \
             is a property of the paper's mode, in which residual forces hold the trunk and fore-aft forces reach the \
             friction limit{better}"
        );
        (pass, note)
    },
};

pub(super) const ALIKE: Statement = Statement {
    id: "h2",
    kind: ClaimKind::Paper,
    paper: "the shapes of hip and knee torques look alike",
    criterion: "r >= 0.8 between hip flexion and knee extension torque over the cycle",
    former: None,
    headline: "r_hip_knee",
    scope: Scope::Brief,
    measure: |evidence| {
        let Ok(steady) = Steady::of(evidence.standard()) else { return Numbers::new() };
        let curve = |name: &str| steady.mean_cycle(&steady.effort(name));
        let (hip, knee, ankle) = (curve("hip_flexion_r"), curve("knee_angle_r"), curve("ankle_angle_r"));
        numbers([("r_hip_knee", correlation(&hip, &knee)), ("r_hip_ankle", correlation(&hip, &ankle))])
    },
    judge: |paper, _| {
        let r = number(paper, "r_hip_knee");
        (r >= 0.8, format!("r = {r:.2}"))
    },
};

pub(super) const CONTINUOUS: Statement = Statement {
    id: "h3",
    kind: ClaimKind::Paper,
    paper: "all torques are rather continuous",
    criterion: "except for 20 ms around impacts, no curve has more than 4 jumps per cycle, which are changes by more \
        than 5 % of its \
        range within one millisecond",
    former: None,
    headline: "hip_jumps_a_cycle",
    scope: Scope::Brief,
    measure: |evidence| {
        let mut numbers = Numbers::new();
        let Ok(steady) = Steady::of(evidence.standard()) else { return numbers };
        let step = steady.run.recording.grid().step_s;
        for (joint, coordinate) in JOINTS {
            let series = steady.effort(coordinate);
            let range = range(&series[steady.rows()]);
            let steps: Vec<f64> = steady
                .rows()
                .skip(1)
                .filter(|row| !steady.near_impact(*row as f64 * step))
                .map(|row| (series[row] - series[row - 1]).abs() / range)
                .collect();
            let cycles = super::steady::STEADY_CYCLES as f64;
            let jumps = steps.iter().filter(|size| **size > JUMP).count() as f64 / cycles;
            numbers.push((format!("{joint}_jumps_a_cycle"), jumps));
            numbers.push((format!("{joint}_largest_jump_percent"), 100.0 * steps.iter().copied().fold(0.0, f64::max)));
        }
        numbers
    },
    judge: |paper, _| {
        let most = JOINTS.iter().map(|(joint, _)| number(paper, &format!("{joint}_jumps_a_cycle"))).fold(0.0, f64::max);
        let note = format!(
            "at most {most:.1}. They occur where the sole changes between \
             sticking and slipping, or \
             leaves the ground"
        );
        (most <= FEW, note)
    },
};

pub(super) const SIGNS: Statement = Statement {
    id: "h4",
    kind: ClaimKind::Paper,
    paper: "support: a negative propulsive torque, then a positive one; swing: a lower positive torque brings the leg \
        back",
    criterion: "the hip torque (flexion +) is on average negative in the first half of stance, positive in the second \
        half, and \
        positive but lower in swing",
    former: None,
    headline: "hip_mean_late_support_nm",
    scope: Scope::Brief,
    measure: |evidence| {
        let run = evidence.standard();
        let Ok(steady) = Steady::of(run) else { return Numbers::new() };
        let hip = steady.mean_cycle(&steady.effort("hip_flexion_r"));
        let load = steady.mean_cycle(&steady.vertical(Side::Right));
        let stance: Vec<f64> = hip.iter().zip(&load).filter(|(_, load)| **load > 0.0).map(|(hip, _)| *hip).collect();
        let swing: Vec<f64> = hip.iter().zip(&load).filter(|(_, load)| **load <= 0.0).map(|(hip, _)| *hip).collect();
        let (early, late) = stance.split_at(stance.len() / 2);
        let (lows, highs): (Vec<f64>, Vec<f64>) = stance.iter().partition(|x| **x < 0.0);
        let place = |sign: f64| {
            let by = |a: &(usize, &f64), b: &(usize, &f64)| (sign * a.1).total_cmp(&(sign * b.1));
            stance.iter().enumerate().max_by(by).map_or(f64::NAN, |(k, _)| k as f64 / stance.len() as f64)
        };
        numbers([
            ("hip_mean_early_support_nm", mean(early)),
            ("hip_mean_late_support_nm", mean(late)),
            ("hip_mean_swing_nm", mean(&swing)),
            ("hip_mean_where_positive_in_support_nm", mean(&highs)),
            ("hip_mean_where_negative_in_support_nm", mean(&lows)),
            ("most_negative_at_share_of_support", place(-1.0)),
            ("most_positive_at_share_of_support", place(1.0)),
        ])
    },
    judge: |paper, _| {
        let of = |name: &str| number(paper, name);
        let (early, late, swing) =
            (of("hip_mean_early_support_nm"), of("hip_mean_late_support_nm"), of("hip_mean_swing_nm"));
        let pass = early < 0.0 && late > 0.0 && swing > 0.0 && swing < of("hip_mean_where_positive_in_support_nm");
        let note = format!("found {early:.0}, {late:.0}, {swing:.0} N.m");
        (pass, note)
    },
};
