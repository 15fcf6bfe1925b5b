//! Claims about what the figure does with its torques: it moves forward, the ground does not pull, torques above a
//! threshold give a warning, and muscle groups act differently in different gaits.

use super::claim::{ClaimKind, Numbers, Statement, number, numbers};
use super::convergence::JOINTS;
use super::evidence::{GAITS, Scope};
use super::mode::Run;
use super::muscles::GROUPS;
use super::steady::{STEADY_CYCLES, Steady};
use ambulo_body::numerics::{mean, range};

/// Departure of the mean speed from that of the gait up to which the legs carry the body as asked.
const AS_ASKED: f64 = 0.2;
/// The largest joint moment of measured walking at free speed, that of the ankle [N.m/kg] (claim h1).
const THRESHOLD_NM_KG: f64 = 1.6;
/// Difference of a share of work that makes one gait differ from another.
const DIFFERENT: f64 = 0.1;

pub(super) const FORWARD: Statement = Statement {
    id: "c4",
    kind: ClaimKind::Paper,
    paper: "the driven motion of the legs makes the body move forwards",
    headline: "standard_progress_share",
    scope: Scope::Brief,
    measure: |evidence| {
        GAITS.iter().zip(&evidence.gaits).map(|(name, run)| (format!("{name}_progress_share"), progress(run))).collect()
    },
    judge: |paper, _| {
        let share = number(paper, "standard_progress_share");
        let others: Vec<String> =
            paper.iter().map(|(name, x)| format!("{} {x:.2}", name.trim_end_matches("_progress_share"))).collect();
        let note = format!(
            "passes if the mean forward speed in the standard gait is that of the gait within {:.0} %; as a share of \
             the speed of the gait: {}",
            100.0 * AS_ASKED,
            others.join(", ")
        );
        ((share - 1.0).abs() <= AS_ASKED, note)
    },
};

pub(super) const NO_PULL: Statement = Statement {
    id: "e4",
    kind: ClaimKind::ByConstruction,
    paper: "a contact is given up where its force would be an attraction",
    headline: "least_vertical_force_bw",
    scope: Scope::Brief,
    measure: |evidence| {
        let run = evidence.standard();
        let Ok(steady) = Steady::of(run) else { return Numbers::new() };
        let weight = run.recording.model.mass() * run.recording.model.gravity().norm();
        let feet = &run.recording.feet;
        let least =
            steady.rows().flat_map(|row| feet.iter().map(move |foot| foot.force[row].y)).fold(f64::INFINITY, f64::min);
        let lifts: usize =
            feet.iter().map(|f| steady.rows().skip(1).filter(|row| !f.loaded(*row) && f.loaded(row - 1)).count()).sum();
        let steps = 2.0 * STEADY_CYCLES as f64;
        numbers([("least_vertical_force_bw", least / weight), ("lifts_a_step", lifts as f64 / steps)])
    },
    judge: |paper, _| {
        let (least, lifts) = (number(paper, "least_vertical_force_bw"), number(paper, "lifts_a_step"));
        let note = format!(
            "passes if no vertical force is below zero and the feet leave the ground; the least force is {least:.1e} \
             body weights, with \
             {lifts:.1} lifts per step"
        );
        (least >= -1e-9 && lifts > 0.0, note)
    },
};

pub(super) const WARNING: Statement = Statement {
    id: "m2",
    kind: ClaimKind::Paper,
    paper: "torques above a threshold warn that a motion is not feasible",
    headline: "largest_torque_nm_kg",
    scope: Scope::Brief,
    measure: |evidence| {
        let run = evidence.standard();
        let Ok(steady) = Steady::of(run) else { return Numbers::new() };
        let mass = run.recording.model.mass();
        let mut over = 0.0_f64;
        let mut largest = 0.0_f64;
        for (_, coordinate) in JOINTS {
            let torque = &steady.effort(coordinate)[steady.rows()];
            let above = torque.iter().filter(|x| x.abs() > THRESHOLD_NM_KG * mass).count();
            over = over.max(above as f64 / torque.len() as f64);
            largest = torque.iter().fold(largest, |most, x| most.max(x.abs() / mass));
        }
        numbers([("largest_torque_nm_kg", largest), ("share_of_time_above_threshold", over)])
    },
    judge: |paper, corrected| {
        let of = |numbers: &Numbers| number(numbers, "largest_torque_nm_kg");
        let other = corrected.map_or("not run".to_owned(), |numbers| format!("{:.2}", of(numbers)));
        let note = format!(
            "passes if the largest torque of the standard gait is above {THRESHOLD_NM_KG} N.m/kg, the largest of \
             people who walk; {:.1} (above \
             for up to {:.0} % of the time at one joint); the corrected motion is not judged: {other}",
            of(paper),
            100.0 * number(paper, "share_of_time_above_threshold")
        );
        (of(paper) > THRESHOLD_NM_KG, note)
    },
};

pub(super) const MUSCLES: Statement = Statement {
    id: "m1",
    kind: ClaimKind::Paper,
    paper: "the force curves tell the respective action of muscles in various styles of walks",
    headline: "largest_difference_of_extensor_share",
    scope: Scope::Brief,
    measure: |evidence| {
        let mut all = Numbers::new();
        let mut difference = 0.0_f64;
        for (joint, coordinate, groups) in GROUPS {
            let mut shares = Vec::new();
            for (gait, run) in GAITS.iter().zip(&evidence.gaits) {
                let works = groups.iter().zip([1.0, -1.0]).map(|(_, sign)| group_work(run, coordinate, sign));
                let works: Vec<Work> = works.collect();
                for (group, work) in groups.iter().zip(&works) {
                    all.push((format!("{gait}_{joint}_{group}_concentric_j_kg"), work.concentric));
                    all.push((format!("{gait}_{joint}_{group}_eccentric_j_kg"), work.eccentric));
                    all.push((format!("{gait}_{joint}_{group}_peak_percent"), work.peak_percent));
                }
                let size = |work: &Work| work.concentric - work.eccentric;
                shares.push(size(&works[0]) / (size(&works[0]) + size(&works[1])));
            }
            difference = difference.max(range(&shares));
        }
        all.push(("largest_difference_of_extensor_share".into(), difference));
        all
    },
    judge: |paper, _| {
        let difference = number(paper, "largest_difference_of_extensor_share");
        let note = format!(
            "passes if at one joint the share of one muscle group in the work differs by more than {DIFFERENT} between \
             two gaits; \
             {difference:.2}. Work is concentric (energy is generated) or eccentric (negative: energy is absorbed), \
             per cycle and kg; the \
             peak is the instant of the largest torque of the group. These are net moments without impacts"
        );
        (difference > DIFFERENT, note)
    },
};

/// Mean forward speed as a share of the speed of the gait.
fn progress(run: &Run) -> f64 {
    Steady::of(run).map_or(f64::NAN, |steady| mean(&run.recording.speed()[steady.rows()]) / run.speed)
}

/// Work of a muscle group over a cycle.
struct Work {
    /// [J/kg].
    concentric: f64,
    /// [J/kg], negative.
    eccentric: f64,
    /// Instant of its largest torque [% of the cycle].
    peak_percent: f64,
}

/// Work of the group whose torque has this sign.
fn group_work(run: &Run, coordinate: &str, sign: f64) -> Work {
    let mut work = Work { concentric: 0.0, eccentric: 0.0, peak_percent: f64::NAN };
    let (Ok(steady), Some(id)) = (Steady::of(run), run.recording.coordinate(coordinate)) else { return work };
    let (torque, rates, mass) =
        (steady.effort(coordinate), run.recording.trajectory.rates(id), run.recording.model.mass());
    let share = run.recording.grid().step_s / STEADY_CYCLES as f64 / mass;
    for row in steady.rows().filter(|row| sign * torque[*row] > 0.0) {
        let power = torque[row] * rates[row] * share;
        if power > 0.0 { work.concentric += power } else { work.eccentric += power }
    }
    let cycle = steady.mean_cycle(&torque);
    let peak =
        cycle.iter().enumerate().filter(|(_, x)| sign * **x > 0.0).max_by(|a, b| (sign * a.1).total_cmp(&(sign * b.1)));
    work.peak_percent = peak.map_or(f64::NAN, |(point, _)| point as f64);
    work
}
