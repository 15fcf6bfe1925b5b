//! Claim (a): "The shape of the resulting plots converged to a solution when we increased the sampling rate." Claim
//! (b): "All the torques [...] have a one second period, and only slight differences appear between two periods."
//!
//! Convergence has two measures relative to a walk at 8 kHz, over one steady cycle: the torque at the instants of the
//! coarser walk, except for 20 ms around the impacts of both walks; and the integral of the torque since the start of
//! that cycle, impacts included. Both are root mean squares in percent of the range over the cycle.

use ambulo_body::numerics::elementary::ln;

use super::claim::{ClaimKind, Numbers, Statement, number, numbers};
use super::evidence::{Evidence, RATES_HZ, Scope};
use super::mode::Run;
use super::steady::{POINTS, Steady, near_impact};
use ambulo_body::numerics::{mean, range, rms};

pub(super) const JOINTS: [(&str, &str); 3] =
    [("hip", "hip_flexion_r"), ("knee", "knee_angle_r"), ("ankle", "ankle_angle_r")];

pub(super) const TORQUE: Statement = Statement {
    id: "a1",
    kind: ClaimKind::Paper,
    paper: "the torque curves converge to a solution as the sampling rate grows (shown at 30 Hz)",
    criterion: "the distance from a walk at 8 kHz decreases from rate to rate and is below 2 % of the range at the \
        highest rate, as the \
        mean of hip, knee and ankle",
    former: None,
    headline: "order",
    scope: Scope::Full,
    measure: |evidence| measure(evidence, "torque", |distance| distance.torque),
    judge: |paper, _| judge(paper, "torque"),
};

pub(super) const IMPULSE: Statement = Statement {
    id: "a2",
    kind: ClaimKind::Ours,
    paper: "the same for the integral of torques and impacts over time",
    criterion: "the distance from a walk at 8 kHz decreases from rate to rate and is below 2 % of the range at the \
        highest rate, as the \
        mean of hip, knee and ankle",
    former: None,
    headline: "order",
    scope: Scope::Full,
    measure: |evidence| measure(evidence, "impulse", |distance| distance.impulse),
    judge: |paper, _| judge(paper, "impulse"),
};

/// Distances of a walk from the reference, as shares of the range over a cycle.
struct Distance {
    torque: f64,
    impulse: f64,
}

fn measure(evidence: &Evidence, what: &str, of: fn(&Distance) -> f64) -> Numbers {
    let mut numbers = Numbers::new();
    let mut means = Vec::new();
    let Some((reference, rates)) = evidence.rates.split_last() else { return numbers };
    for (run, rate) in rates.iter().zip(RATES_HZ) {
        let distances: Vec<f64> =
            JOINTS.iter().map(|(_, coordinate)| of(&distance(run, reference, coordinate))).collect();
        for ((joint, _), distance) in JOINTS.iter().zip(&distances) {
            numbers.push((format!("{joint}_{what}_{rate:.0}hz_percent"), 100.0 * distance));
        }
        means.push(mean(&distances));
    }
    numbers.push(("order".into(), order(&means)));
    let unsolved: usize = evidence.rates.iter().map(|run| run.recording.unsolved_steps).sum();
    numbers.push(("steps_left_unsolved".into(), unsolved as f64));
    numbers
}

/// Slope of log error against log time step, by least squares.
fn order(errors: &[f64]) -> f64 {
    let x: Vec<f64> = RATES_HZ.iter().map(|rate| -ln(*rate)).collect();
    let y: Vec<f64> = errors.iter().map(|error| ln(error.max(1e-12))).collect();
    let (x0, y0) = (mean(&x), mean(&y));
    let products = |f: &dyn Fn(f64, f64) -> f64| x.iter().zip(&y).map(|(x, y)| f(x - x0, y - y0)).sum::<f64>();
    products(&|x, y| x * y) / products(&|x, _| x * x)
}

fn judge(paper: &Numbers, what: &str) -> (bool, String) {
    let at = |rate: f64| {
        let of_joint = |(joint, _): &(&str, &str)| number(paper, &format!("{joint}_{what}_{rate:.0}hz_percent"));
        mean(&JOINTS.iter().map(of_joint).collect::<Vec<f64>>())
    };
    let errors: Vec<f64> = RATES_HZ.iter().map(|rate| at(*rate)).collect();
    let falls = errors.windows(2).all(|pair| pair[1] < pair[0]);
    let pass = falls && errors[RATES_HZ.len() - 1] < 2.0;
    let (first, last) = (errors[0], errors[RATES_HZ.len() - 1]);
    let note = format!(
        "the mean of hip, knee and ankle is {first:.1} % at 30 Hz and {last:.1} % at 1000 Hz, of order {:.2} in the \
         time step",
        number(paper, "order")
    );
    (pass, note)
}

fn distance(run: &Run, reference: &Run, coordinate: &str) -> Distance {
    let effort = |run: &Run| run.recording.effort(coordinate).map(<[f64]>::to_vec);
    let (Ok(coarse), Some(torque), Some(truth)) = (Steady::of(run), effort(run), effort(reference)) else {
        return Distance { torque: f64::NAN, impulse: f64::NAN };
    };
    let (step, fine_step) = (run.recording.grid().step_s, reference.recording.grid().step_s);
    let first = coarse.rows().start;
    let rows = first..first + (run.cycle_s / step).floor() as usize;
    let start_s = first as f64 * step;
    let at = |t: f64| ((t / fine_step).round() as usize).min(truth.len() - 1);
    let (mut sum, mut true_sum, mut next) = (0.0, 0.0, at(start_s));
    let (mut off, mut off_sum, mut true_sums) = (Vec::new(), Vec::new(), Vec::new());
    for row in rows {
        let t = row as f64 * step;
        let impulses = |run: &Run| impacts_until(run, coordinate, start_s, t);
        off_sum.push(sum + impulses(run) - true_sum - impulses(reference));
        true_sums.push(true_sum + impulses(reference));
        if !near_impact(run, t) && !near_impact(reference, t) {
            off.push(torque[row] - truth[at(t)]);
        }
        sum += torque[row] * step;
        let end = at(t + step);
        true_sum += truth[next..end].iter().sum::<f64>() * fine_step;
        next = end;
    }
    let share = |off: &[f64], range: f64| rms(off) / range;
    let cycle = &truth[at(start_s)..at(start_s + run.cycle_s)];
    Distance { torque: share(&off, range(cycle)), impulse: share(&off_sum, range(&true_sums)) }
}

/// Sum of the impulses of impacts on a coordinate between two instants [N.m.s].
fn impacts_until(run: &Run, coordinate: &str, from_s: f64, to_s: f64) -> f64 {
    let Some(id) = run.recording.coordinate(coordinate) else { return 0.0 };
    let within = |t: f64| t >= from_s - 1e-9 && t < to_s - 1e-9;
    run.recording.impacts.iter().filter(|impact| within(impact.time_s)).map(|impact| impact.efforts[id.index()]).sum()
}

/// The largest difference of cycles that counts as slight.
const SLIGHT_PERCENT: f64 = 5.0;

pub(super) const PERIOD: Statement = Statement {
    id: "b",
    kind: ClaimKind::ByConstruction,
    paper: "all torques have a one second period; only slight differences between two periods",
    criterion: "consecutive cycles after the start differ by less than 5 % of the range (root mean square, except for \
        20 ms around \
        impacts), and the period is one second",
    former: None,
    headline: "hip_cycle_to_cycle_percent",
    scope: Scope::Brief,
    measure: measure_period,
    judge: |paper, _| {
        let worst = JOINTS.iter().map(|(joint, _)| number(paper, &format!("{joint}_cycle_to_cycle_percent")));
        let worst = worst.fold(0.0, f64::max);
        let pass = worst < SLIGHT_PERCENT && (number(paper, "period_s") - 1.0).abs() < 1e-9;
        let note = format!("the largest difference of hip, knee and ankle is {worst:.3} %");
        (pass, note)
    },
};

fn measure_period(evidence: &Evidence) -> Numbers {
    let run = evidence.standard();
    let mut numbers = numbers([("period_s", run.cycle_s)]);
    let Ok(steady) = Steady::of(run) else { return numbers };
    for (joint, coordinate) in JOINTS {
        let cycles = steady.cycles(&steady.effort(coordinate));
        let range = range(&steady.mean_cycle(&steady.effort(coordinate)));
        let worst = cycles.windows(2).enumerate().map(|(cycle, pair)| {
            let at =
                |point: usize| steady.start_s() + run.cycle_s * (cycle as f64 + point as f64 / (POINTS - 1) as f64);
            let far = |point: &usize| !steady.near_impact(at(*point)) && !steady.near_impact(at(*point) + run.cycle_s);
            let off: Vec<f64> = (0..POINTS - 1).filter(far).map(|p| pair[1][p] - pair[0][p]).collect();
            rms(&off) / range
        });
        numbers.push((format!("{joint}_cycle_to_cycle_percent"), 100.0 * worst.fold(0.0, f64::max)));
    }
    numbers
}
