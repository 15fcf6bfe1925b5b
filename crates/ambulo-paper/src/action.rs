//! Claims about what the figure does with its torques: it moves forward, the ground does not pull, torques above a
//! threshold give a warning, and muscle groups act differently in different gaits.

use super::claim::{ClaimKind, Former, Numbers, Statement, number, numbers};
use super::convergence::JOINTS;
use super::evidence::Scope;
use super::mode::Run;
use super::muscles::GROUPS;
use super::open_values::GAITS;
use super::paper_human::HEIGHT;
use super::steady::{STEADY_CYCLES, Steady};
use ambulo_body::model::anatomy::Movement;
use ambulo_body::numerics::{extremes, mean, range};
use ambulo_walk::optimal::StrengthCurve;

/// Largest difference between mean speed and the gait's speed, as a share of the latter, with which the legs carry the
/// body as asked.
const AS_ASKED: f64 = 0.2;
/// The largest joint moment of measured walking at free speed, at the ankle [N.m/kg] (claim h1).
const THRESHOLD_NM_KG: f64 = 1.6;
/// Difference of a share of work that makes one gait differ from another.
const DIFFERENT: f64 = 0.1;

pub(super) const FORWARD: Statement = Statement {
    id: "c4",
    kind: ClaimKind::Paper,
    paper: "the driven motion of the legs makes the body move forwards",
    criterion: "the mean forward speed is that of the gait within 20 %, in each of the four gaits",
    former: Some(Former {
        kind: ClaimKind::Paper,
        criterion: "the same, in the standard gait alone",
        reason: "the sentence is about the driven motion and not about one gait; short steps on the spot passed",
        judge: |paper, _| as_asked(number(paper, "standard_progress_share")),
    }),
    headline: "worst_progress_share",
    scope: Scope::Brief,
    measure: |evidence| {
        let mut shares = Numbers::new();
        for (name, run) in GAITS.iter().zip(&evidence.gaits) {
            shares.push((format!("{name}_progress_share"), progress(run)));
        }
        let off = |share: &f64| (share - 1.0).abs();
        let worst = shares.iter().map(|(_, x)| *x).max_by(|a, b| off(a).total_cmp(&off(b)));
        shares.push(("worst_progress_share".into(), worst.unwrap_or(f64::NAN)));
        shares
    },
    judge: |paper, _| {
        let of = |gait: &&str| number(paper, &format!("{gait}_progress_share"));
        let all: Vec<String> = GAITS.iter().map(|gait| format!("{gait} {:.2}", of(gait))).collect();
        let note = format!("speed that is walked as a share of the speed of the gait: {}", all.join(", "));
        (GAITS.iter().all(|gait| as_asked(of(gait))), note)
    },
};

/// Whether the legs carry the body as asked; `share` is the mean speed as a share of the gait's speed.
fn as_asked(share: f64) -> bool {
    (share - 1.0).abs() <= AS_ASKED
}

pub(super) const NO_PULL: Statement = Statement {
    id: "e4",
    kind: ClaimKind::ByConstruction,
    paper: "a contact is given up where its force would be an attraction",
    criterion: "no vertical force is below zero, and the feet leave the ground",
    former: None,
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
            "the least force is {least:.1e} \
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
    criterion: "with the isometric strength of a man of this size, at the best angle of hip, knee and ankle, as the \
        threshold, each of the four gaits of \
        the paper's mode causes a warning, and none of the same gaits in the corrected mode does",
    former: Some(Former {
        kind: ClaimKind::Paper,
        criterion: "the largest torque of the standard gait is above 1.6 N.m/kg, the largest of people who walk",
        reason: "a warning is of use only if it is not given to feasible walks too; ten times the threshold could not \
            fail",
        judge: |paper, _| number(paper, "largest_torque_nm_kg") > THRESHOLD_NM_KG,
    }),
    headline: "least_share_of_strength",
    scope: Scope::Brief,
    measure: |evidence| {
        let mut all = Numbers::new();
        let mut shares = Vec::new();
        for (gait, run) in GAITS.iter().zip(&evidence.gaits) {
            shares.push(share_of_strength(run));
            all.push((format!("{gait}_share_of_strength"), share_of_strength(run)));
        }
        let (least, most) = extremes(&shares);
        let mass = evidence.standard().recording.model.mass();
        let largest = largest_torques(evidence.standard()).into_iter().fold(0.0, f64::max) / mass;
        all.extend(numbers([
            ("least_share_of_strength", least),
            ("largest_share_of_strength", most),
            ("largest_torque_nm_kg", largest),
        ]));
        all
    },
    judge: |paper, corrected| {
        let of = |numbers: &Numbers, gait: &str| number(numbers, &format!("{gait}_share_of_strength"));
        let list = |numbers: &Numbers| {
            GAITS.iter().map(|gait| format!("{gait} {:.2}", of(numbers, gait))).collect::<Vec<String>>().join(", ")
        };
        let warned = GAITS.iter().all(|gait| of(paper, gait) > 1.0);
        let silent = corrected.is_none_or(|numbers| GAITS.iter().all(|gait| of(numbers, gait) <= 1.0));
        let note = format!(
            "largest torque as a share of this strength: {}; corrected mode: {}",
            list(paper),
            corrected.map_or("not run".to_owned(), list)
        );
        (warned && silent, note)
    },
};

/// Largest torques of hip, knee and ankle over the steady cycles [N.m].
fn largest_torques(run: &Run) -> [f64; 3] {
    let Ok(steady) = Steady::of(run) else { return [f64::NAN; 3] };
    JOINTS.map(|(_, coordinate)| {
        steady.effort(coordinate)[steady.rows()].iter().fold(0.0_f64, |most, torque| most.max(torque.abs()))
    })
}

/// The largest torque of a joint relative to the strength of the joint.
fn share_of_strength(run: &Run) -> f64 {
    let movements = [Movement::HipFlexion, Movement::KneeFlexion, Movement::AnkleDorsiflexion];
    let strength = |movement| {
        let curve = StrengthCurve::built_in(movement, run.recording.model.mass(), HEIGHT)?;
        Some(curve.positive.iter().chain(&curve.negative).copied().fold(0.0, f64::max))
    };
    let shares =
        movements.into_iter().zip(largest_torques(run)).map(|(of, torque)| torque / strength(of).unwrap_or(f64::NAN));
    shares.fold(0.0, f64::max)
}

pub(super) const MUSCLES: Statement = Statement {
    id: "m1",
    kind: ClaimKind::ByConstruction,
    paper: "the force curves tell the respective action of muscles in various styles of walks",
    criterion: "at one joint the share of one muscle group in the work differs by more than 0.1 between two gaits",
    former: Some(Former {
        kind: ClaimKind::Paper,
        criterion: "the same",
        reason: "four different motions never have the same torques, so the claim could not fail: it leaves the count",
        judge: |paper, _| number(paper, "largest_difference_of_extensor_share") > DIFFERENT,
    }),
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
            "found {difference:.2}. Work is concentric (energy is generated) or eccentric (negative: energy is \
             absorbed), \
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
