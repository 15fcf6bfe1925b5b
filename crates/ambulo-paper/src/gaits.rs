//! Claim (g), figure 7: four gaits; and claim (j): the most plausible one.

use super::claim::{ClaimKind, Former, Numbers, Statement, number};
use super::evidence::Scope;
use super::open_values::GAITS;
use super::steady::Steady;
use ambulo_body::numerics::{correlation, extremes, mean, rms};

/// Correlation of curves with the same global shape.
const ALIKE: f64 = 0.8;
const KNEE: &str = "knee_angle_r";
const HIP: &str = "hip_flexion_r";

pub(super) const SHAPE: Statement = Statement {
    id: "g1",
    kind: ClaimKind::Paper,
    paper: "after time scaling the knee torque of four gaits has the same global shape",
    criterion: "each pair of the four curves has a correlation of r >= 0.8",
    former: None,
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
        let least = number(paper, "least_r");
        let most = paper.iter().map(|(_, r)| *r).fold(f64::NEG_INFINITY, f64::max);
        let note = format!("found {least:.2} to {most:.2}");
        (least >= ALIKE, note)
    },
};

pub(super) const LOWEST: Statement = Statement {
    id: "g2",
    kind: ClaimKind::Paper,
    paper: "short steps involve the lowest torques",
    criterion: "short steps have the lowest largest torque, of hip, knee and ankle",
    former: Some(Former {
        kind: ClaimKind::Paper,
        criterion: "short steps have the lowest root mean square of the knee torque",
        reason: "the paper speaks of torque values of the gait, not of a mean over time of one joint; both are \
            reported",
        judge: |paper, _| least_of(paper, "knee_rms_nm") == "short",
    }),
    headline: "short_over_lowest_other",
    scope: Scope::Brief,
    measure: |evidence| {
        let mut all = Numbers::new();
        for (name, run) in GAITS.iter().zip(&evidence.gaits) {
            all.push((format!("{name}_largest_torque_nm"), largest_torque(run)));
            all.push((format!("{name}_knee_rms_nm"), rms(&mean_torque(run, KNEE))));
            let knee = mean_torque(run, KNEE).iter().fold(0.0_f64, |most, torque| most.max(torque.abs()));
            all.push((format!("{name}_knee_largest_nm"), knee));
        }
        for (name, what) in
            [("short_over_lowest_other", "largest_torque_nm"), ("short_knee_rms_over_lowest_other", "knee_rms_nm")]
        {
            all.push((name.to_owned(), over_lowest_other(&all, what)));
        }
        all
    },
    judge: |paper, _| {
        let note = format!(
            "short steps have {:.2} of the lowest largest torque of the other gaits, and {:.2} of their lowest root \
             mean square of the knee torque. Accelerations are proportional to step length over period squared: at \
             0.62 s, steps below 0.38 of the standard length have lower ones",
            number(paper, "short_over_lowest_other"),
            number(paper, "short_knee_rms_over_lowest_other"),
        );
        (least_of(paper, "largest_torque_nm") == "short", note)
    },
};

/// Reason of the change of g3 and j.
const BY_THE_MEAN: &str =
    "the range was divided by the nominal speed, and by the mean speed in claim c1: both by the mean that is walked";

pub(super) const REGULAR: Statement = Statement {
    id: "g3",
    kind: ClaimKind::Paper,
    paper: "short steps give the most regular velocity",
    criterion: "the forward speed of short steps has the smallest range relative to its mean",
    former: Some(Former {
        kind: ClaimKind::Paper,
        criterion: "the same, relative to the nominal speed of the gait",
        reason: BY_THE_MEAN,
        judge: |paper, _| least_of(paper, "speed_peak_to_peak_share") == "short",
    }),
    headline: "short_speed_range_over_mean",
    scope: Scope::Brief,
    measure: |evidence| GAITS.iter().zip(&evidence.gaits).flat_map(|(name, run)| unevenness(name, run)).collect(),
    judge: |paper, _| {
        let regular = least_of(paper, "speed_range_over_mean");
        let of = |gait: &&str| format!("{gait} {:.2}", number(paper, &format!("{gait}_speed_range_over_mean")));
        let note = format!(
            "{regular} steps have the smallest range: {}",
            GAITS.iter().map(of).collect::<Vec<String>>().join(", ")
        );
        (regular == "short", note)
    },
};

pub(super) const PLAUSIBLE: Statement = Statement {
    id: "j",
    kind: ClaimKind::Paper,
    paper: "the most plausible gait, with short steps, has the most plausible torques",
    criterion: "short steps have both the smallest range of speed relative to its mean, and the lowest largest torque",
    former: Some(Former {
        kind: ClaimKind::Paper,
        criterion: "the same, with the range relative to the nominal speed of the gait",
        reason: BY_THE_MEAN,
        judge: |paper, _| {
            least_of(paper, "speed_peak_to_peak_share") == "short" && least_of(paper, "largest_torque_nm_kg") == "short"
        },
    }),
    headline: "short_largest_torque_nm_kg",
    scope: Scope::Brief,
    measure: |evidence| {
        let mut numbers = Numbers::new();
        for (name, run) in GAITS.iter().zip(&evidence.gaits) {
            numbers.extend(unevenness(name, run));
            let largest = largest_torque(run) / run.recording.model.mass();
            numbers.push((format!("{name}_largest_torque_nm_kg"), largest));
        }
        numbers
    },
    judge: |paper, _| {
        let (regular, lowest) = (least_of(paper, "speed_range_over_mean"), least_of(paper, "largest_torque_nm_kg"));
        let note = format!(
            "{regular} steps have the most regular speed, {lowest} steps the lowest torques relative to body mass \
             ({:.1} N.m/kg; below 1.6 in measured walking)",
            number(paper, &format!("{lowest}_largest_torque_nm_kg"))
        );
        (regular == "short" && lowest == "short", note)
    },
};

fn mean_torque(run: &super::mode::Run, coordinate: &str) -> Vec<f64> {
    Steady::of(run).map_or(vec![f64::NAN], |steady| steady.mean_cycle(&steady.effort(coordinate)))
}

/// The largest torque of hip, knee and ankle in the mean cycle [N.m].
fn largest_torque(run: &super::mode::Run) -> f64 {
    let joints = [HIP, KNEE, "ankle_angle_r"];
    let largest = |joint| mean_torque(run, joint).iter().fold(0.0_f64, |most, torque| most.max(torque.abs()));
    joints.map(largest).into_iter().fold(0.0, f64::max)
}

/// Range of the forward speed of the mid-hip, relative to its mean and to the nominal speed of the gait. The figure
/// does not walk forwards, and its speed is not regular, if the mean is not above zero.
fn unevenness(name: &str, run: &super::mode::Run) -> Numbers {
    let Ok(steady) = Steady::of(run) else { return Numbers::new() };
    let speed = &run.recording.speed()[steady.rows()];
    let ((least, most), mean) = (extremes(speed), mean(speed));
    let over_mean = if mean > 0.0 { (most - least) / mean } else { f64::INFINITY };
    vec![
        (format!("{name}_speed_range_over_mean"), over_mean),
        (format!("{name}_speed_peak_to_peak_share"), (most - least) / run.speed),
    ]
}

/// A number of the short steps relative to the lowest of the other gaits.
fn over_lowest_other(all: &Numbers, what: &str) -> f64 {
    let of = |gait: &str| number(all, &format!("{gait}_{what}"));
    of("short") / ["standard", "long", "goose"].map(of).into_iter().fold(f64::INFINITY, f64::min)
}

/// The gait with the smallest number of this name.
fn least_of(numbers: &Numbers, what: &str) -> &'static str {
    let of = |gait: &&str| number(numbers, &format!("{gait}_{what}"));
    GAITS.iter().min_by(|a, b| of(a).total_cmp(&of(b))).copied().unwrap_or("no")
}
