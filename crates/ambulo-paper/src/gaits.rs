//! Claim (g), figure 7: four gaits; and claim (j): the most plausible one.

use super::claim::{ClaimKind, Numbers, Statement, number};
use super::evidence::{Evidence, GAITS, Scope};
use super::steady::Steady;
use ambulo_body::numerics::{correlation, extremes, rms};

/// Correlation of curves with the same global shape.
const ALIKE: f64 = 0.8;
const KNEE: &str = "knee_angle_r";
const HIP: &str = "hip_flexion_r";

pub(super) const SHAPE: Statement = Statement {
    id: "g1",
    kind: ClaimKind::Paper,
    paper: "after time scaling the knee torque of four gaits has the same global shape",
    headline: "least_r",
    scope: Scope::Brief,
    measure: |evidence| {
        let curves: Vec<Vec<f64>> = evidence.gaits.iter().map(|run| mean_torque(run, KNEE)).collect();
        let mut numbers = Numbers::new();
        for (i, one) in curves.iter().enumerate() {
            for (j, other) in curves.iter().enumerate().skip(i + 1) {
                numbers.push((format!("r_{}_{}", GAITS[i], GAITS[j]), correlation(one, other)));
            }
        }
        let least = numbers.iter().map(|(_, r)| *r).fold(f64::INFINITY, f64::min);
        numbers.push(("least_r".into(), least));
        numbers
    },
    judge: |paper, _| {
        let (least, most) = extremes(&paper.iter().map(|(_, r)| *r).collect::<Vec<f64>>());
        let note = format!(
            "passes if each pair of the four curves has a correlation of r >= {ALIKE}; found {least:.2} to {most:.2}. \
             In short steps \
             the foot strikes the ground at other times, in part in mid-swing, and these impacts determine where the \
             torque is high"
        );
        (least >= ALIKE, note)
    },
};

pub(super) const LOWEST: Statement = Statement {
    id: "g2",
    kind: ClaimKind::Paper,
    paper: "short steps involve the lowest torques",
    headline: "short_over_lowest_other",
    scope: Scope::Brief,
    measure: |evidence| torques(evidence, KNEE),
    judge: |paper, _| {
        let lowest = least_of(paper, "rms_nm");
        let note = format!(
            "passes if short steps have the lowest root mean square of the knee torque; {lowest} steps have the \
             lowest. Accelerations are \
             proportional to step length over period squared: at 0.62 s, short steps need to be below 0.38 of the \
             standard length for lower \
             torques. The paper gives no length; the table of assumptions has other lengths"
        );
        (lowest == "short", note)
    },
};

pub(super) const REGULAR: Statement = Statement {
    id: "g3",
    kind: ClaimKind::Paper,
    paper: "short steps give the most regular velocity",
    headline: "short_speed_peak_to_peak_share",
    scope: Scope::Brief,
    measure: |evidence| {
        let of = |name: &str, run: &super::mode::Run| (format!("{name}_speed_peak_to_peak_share"), unevenness(run));
        GAITS.iter().zip(&evidence.gaits).map(|(name, run)| of(name, run)).collect()
    },
    judge: |paper, _| {
        let regular = least_of(paper, "speed_peak_to_peak_share");
        let note = format!(
            "passes if the forward speed of short steps has the smallest range relative to the speed of the gait; \
             {regular} steps have the \
             smallest. With all angles scaled alike, as in the paper, short steps lift the foot less: it strikes the \
             ground in mid-swing \
             and, because impacts cancel all velocity, pushes the figure backwards"
        );
        (regular == "short", note)
    },
};

pub(super) const PLAUSIBLE: Statement = Statement {
    id: "j",
    kind: ClaimKind::Paper,
    paper: "the most plausible gait, with short steps, has the most plausible torques",
    headline: "short_largest_torque_nm_kg",
    scope: Scope::Brief,
    measure: |evidence| {
        let mut numbers = Numbers::new();
        for (name, run) in GAITS.iter().zip(&evidence.gaits) {
            numbers.push((format!("{name}_speed_peak_to_peak_share"), unevenness(run)));
            let peaks = [HIP, KNEE, "ankle_angle_r"].map(|joint| {
                mean_torque(run, joint).iter().fold(0.0_f64, |m, x| m.max(x.abs())) / run.recording.model.mass()
            });
            numbers.push((format!("{name}_largest_torque_nm_kg"), peaks.into_iter().fold(0.0, f64::max)));
        }
        numbers
    },
    judge: |paper, _| {
        let (regular, lowest) = (least_of(paper, "speed_peak_to_peak_share"), least_of(paper, "largest_torque_nm_kg"));
        let note = format!(
            "passes if short steps have both the most regular speed ({regular} steps have it) and the lowest torques \
             relative to body mass \
             ({lowest} steps, {:.1} N.m/kg; below 1.6 in measured walking)",
            number(paper, &format!("{lowest}_largest_torque_nm_kg"))
        );
        (regular == "short" && lowest == "short", note)
    },
};

fn mean_torque(run: &super::mode::Run, coordinate: &str) -> Vec<f64> {
    Steady::of(run).map_or(vec![f64::NAN], |steady| steady.mean_cycle(&steady.effort(coordinate)))
}

/// Range of the forward speed of the mid-hip relative to the speed of the gait (the mean speed of short steps can be
/// zero).
pub(super) fn unevenness(run: &super::mode::Run) -> f64 {
    let Ok(steady) = Steady::of(run) else { return f64::NAN };
    let speed = &run.recording.speed()[steady.rows()];
    let (least, most) = extremes(speed);
    (most - least) / run.speed
}

fn torques(evidence: &Evidence, coordinate: &str) -> Numbers {
    let mut numbers = Numbers::new();
    for (name, run) in GAITS.iter().zip(&evidence.gaits) {
        let curve = mean_torque(run, coordinate);
        numbers.push((format!("{name}_rms_nm"), rms(&curve)));
        numbers.push((format!("{name}_largest_nm"), curve.iter().fold(0.0_f64, |m, x| m.max(x.abs()))));
    }
    let of = |gait: &str| number(&numbers, &format!("{gait}_rms_nm"));
    let lowest_other = ["standard", "long", "goose"].map(of).into_iter().fold(f64::INFINITY, f64::min);
    numbers.push(("short_over_lowest_other".into(), of("short") / lowest_other));
    numbers
}

/// The gait with the smallest number of this name.
fn least_of(numbers: &Numbers, what: &str) -> &'static str {
    let of = |gait: &&str| number(numbers, &format!("{gait}_{what}"));
    GAITS.iter().min_by(|a, b| of(a).total_cmp(&of(b))).copied().unwrap_or("no")
}
