//! (b) "All the torques [...] have a one second period, and only slight differences appear between two periods."

use super::claim::{Numbers, Statement, number, numbers};
use super::convergence::JOINTS;
use super::evidence::{Evidence, Scope};
use super::steady::{POINTS, Steady, range_of, rms};

/// Largest difference of cycles that is slight.
const SLIGHT_PERCENT: f64 = 5.0;

pub(super) const PERIOD: Statement = Statement {
    id: "b",
    paper: "all torques have a one second period; only slight differences between two periods",
    headline: "hip_cycle_to_cycle_percent",
    scope: Scope::Brief,
    measure,
    judge: |paper, _| {
        let worst = JOINTS.iter().map(|(joint, _)| number(paper, &format!("{joint}_cycle_to_cycle_percent")));
        let worst = worst.fold(0.0, f64::max);
        let pass = worst < SLIGHT_PERCENT && (number(paper, "period_s") - 1.0).abs() < 1e-9;
        let note = format!(
            "passes if consecutive cycles differ by less than {SLIGHT_PERCENT} % of the range (root mean square, outside 20 ms \
             around blows) once the start has died down; the largest of hip, knee and ankle is {worst:.3} %"
        );
        (pass, note)
    },
};

fn measure(evidence: &Evidence) -> Numbers {
    let run = evidence.standard();
    let mut numbers = numbers([("period_s", run.cycle_s)]);
    let Ok(steady) = Steady::of(run) else { return numbers };
    for (joint, coordinate) in JOINTS {
        let cycles = steady.cycles(&steady.effort(coordinate));
        let range = range_of(&steady.mean_cycle(&steady.effort(coordinate)));
        let worst = cycles.windows(2).enumerate().map(|(cycle, pair)| {
            let at =
                |point: usize| steady.start_s() + run.cycle_s * (cycle as f64 + point as f64 / (POINTS - 1) as f64);
            let far = |point: &usize| !steady.near_blow(at(*point)) && !steady.near_blow(at(*point) + run.cycle_s);
            let off: Vec<f64> = (0..POINTS - 1).filter(far).map(|p| pair[1][p] - pair[0][p]).collect();
            rms(&off) / range
        });
        numbers.push((format!("{joint}_cycle_to_cycle_percent"), 100.0 * worst.fold(0.0, f64::max)));
    }
    numbers
}
