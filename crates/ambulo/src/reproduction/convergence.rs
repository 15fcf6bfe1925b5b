//! (a) "The shape of the resulting plots converged to a solution when we increased the sampling rate."
//!
//! Two measures against a walk at 8 kHz, over one steady cycle: the torque at the instants of the coarser walk, but for 20 ms
//! around the blows of either; and what it adds up to, blows included, since the start of that cycle. Both as root mean
//! square, in percent of the range over the cycle.

use super::claim::{Numbers, Statement, number};
use super::evidence::{Evidence, RATES_HZ, Scope};
use super::mode::Run;
use super::steady::{Steady, mean, range_of, rms};

pub(super) const JOINTS: [(&str, &str); 3] =
    [("hip", "hip_flexion_r"), ("knee", "knee_angle_r"), ("ankle", "ankle_angle_r")];

pub(super) const TORQUE: Statement = Statement {
    id: "a1",
    paper: "the torque curves converge to a solution as the sampling rate grows (shown at 30 Hz)",
    headline: "order",
    scope: Scope::Full,
    measure: |evidence| measure(evidence, "torque", |distance| distance.torque),
    judge: |paper, _| judge(paper, "torque"),
};

pub(super) const IMPULSE: Statement = Statement {
    id: "a2",
    paper: "the same, of what torques and blows add up to",
    headline: "order",
    scope: Scope::Full,
    measure: |evidence| measure(evidence, "impulse", |distance| distance.impulse),
    judge: |paper, _| judge(paper, "impulse"),
};

/// Distances of a walk from the reference, in shares of the range over a cycle.
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

/// Slope of log error against log step, by least squares.
fn order(errors: &[f64]) -> f64 {
    let x: Vec<f64> = RATES_HZ.iter().map(|rate| -rate.ln()).collect();
    let y: Vec<f64> = errors.iter().map(|error| error.max(1e-12).ln()).collect();
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
        "passes if the distance from a walk at 8 kHz falls from rate to rate and ends below 2 %; mean of hip, knee and ankle \
         {first:.1} % at 30 Hz and {last:.1} % at 1000 Hz, order {:.2} in the step",
        number(paper, "order")
    );
    (pass, note)
}

fn distance(run: &Run, reference: &Run, coordinate: &str) -> Distance {
    let (Ok(coarse), Ok(fine)) = (Steady::of(run), Steady::of(reference)) else {
        return Distance { torque: f64::NAN, impulse: f64::NAN };
    };
    let (torque, truth) = (coarse.effort(coordinate), fine.effort(coordinate));
    let (step, fine_step) = (run.recording.grid().step_s, reference.recording.grid().step_s);
    let first = coarse.rows().start;
    let rows = first..first + (run.cycle_s / step).floor() as usize;
    let start_s = first as f64 * step;
    let at = |t: f64| ((t / fine_step).round() as usize).min(truth.len() - 1);
    let (mut sum, mut true_sum, mut next) = (0.0, 0.0, at(start_s));
    let (mut off, mut off_sum, mut true_sums) = (Vec::new(), Vec::new(), Vec::new());
    for row in rows {
        let t = row as f64 * step;
        let blows = |run: &Run| blows_until(run, coordinate, start_s, t);
        off_sum.push(sum + blows(run) - true_sum - blows(reference));
        true_sums.push(true_sum + blows(reference));
        if !coarse.near_blow(t) && !fine.near_blow(t) {
            off.push(torque[row] - truth[at(t)]);
        }
        sum += torque[row] * step;
        let end = at(t + step);
        true_sum += truth[next..end].iter().sum::<f64>() * fine_step;
        next = end;
    }
    let share = |off: &[f64], range: f64| rms(off) / range;
    Distance { torque: share(&off, range_of(&fine.mean_cycle(&truth))), impulse: share(&off_sum, range_of(&true_sums)) }
}

/// What blows gave to a coordinate from one instant up to another [N.m.s].
fn blows_until(run: &Run, coordinate: &str, from_s: f64, to_s: f64) -> f64 {
    let Some(id) = run.recording.coordinate(coordinate) else { return 0.0 };
    let within = |t: f64| t >= from_s - 1e-9 && t < to_s - 1e-9;
    run.recording.impacts.iter().filter(|blow| within(blow.time_s)).map(|blow| blow.efforts[id.index()]).sum()
}
