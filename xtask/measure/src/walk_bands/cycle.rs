//! One simulated cycle of a dynamically consistent walk.

use super::adjustment::{Adjustment, adjustments};
use super::curve::Peaks;
use crate::normative::SAMPLES;
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Speed, Trunk, Walk};
use ambulo::kinematics::each_body_motion;
use ambulo::model::Model;
use ambulo::model::anthropometry::{Build, Human};
use ambulo::numerics::{extremes, mean, rms};
use ambulo::simulation::consistent_walk::{ConsistentWalkSettings, make_consistent_walk};
use ambulo::simulation::walking::{StanceSlip, WalkRecording};
use cpu_time::ThreadTime;

/// Step of the simulator [s].
pub(super) const STEP_S: f64 = 1e-3;
/// Cycles walked; the last one is judged.
pub(super) const CYCLES: usize = 6;
/// Intervals per cycle for quantities that are not in the tables; a multiple of the tables' number.
const FINE: usize = 1000;

/// A walk with the results of its last cycle.
#[derive(Debug, Clone)]
pub(super) struct Cycle {
    pub(super) walk: Pace,
    /// The nine curves of the right foot's cycle, in the order of the tables and finer than they are; the last is the
    /// forward speed of the centre of mass [m/s].
    pub(super) curves: [Vec<f64>; 9],
    pub(super) peaks: Peaks,
    /// Mean force on both feet over the cycle [body weights]: up, forward.
    pub(super) mean_force: [f64; 2],
    /// Net fore-aft impulse over the propulsive one of both feet.
    pub(super) net_share: f64,
    /// Peak-to-peak forward speed of the centre of mass over its mean.
    pub(super) speed_range: f64,
    /// The worst of the complete stances in the last two cycles.
    pub(super) slip: StanceSlip,
    /// Time without a loaded foot in the cycle [s].
    pub(super) flight_s: f64,
    /// Torque that holds the trunk from outside [N.m]: root mean square, largest.
    pub(super) trunk: [f64; 2],
    pub(super) parameters: usize,
    pub(super) adjustments: Vec<Adjustment>,
    /// CPU time that making the walk consistent took [s], and iterations of the solver.
    pub(super) consistent_s: f64,
    pub(super) iterations: usize,
    /// Simulated over CPU time.
    pub(super) times_real_time: f64,
    pub(super) unsolved_steps: usize,
}

/// Speed and step of a walk.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pace {
    /// Leg of the figure [m].
    pub(super) leg_length: f64,
    /// [m/s]
    pub(super) speed: f64,
    pub(super) cycle_s: f64,
    /// [m]
    pub(super) step_length: f64,
}

/// Makes a walk at a dimensionless speed consistent, walks it and measures its last cycle.
pub(super) fn walk(build: &Build, speed: f64) -> Result<Cycle, String> {
    let human = build.human().map_err(|e| e.to_string())?;
    let mut gait = Gait::named("free").map_err(|e| e.to_string())?;
    gait.pace.speed = Some(Speed::Dimensionless(speed));
    let mut findings = Findings::default();
    let walk = Walk::new(&gait, human.dimensions.leg_length, &mut findings).map_err(|e| e.to_string())?;
    let settings = ConsistentWalkSettings::default();
    let start = ThreadTime::now();
    let consistent = make_consistent_walk(&human, &walk, &settings).map_err(|e| e.to_string())?;
    let consistent_s = start.elapsed().as_secs_f64();
    let start = ThreadTime::now();
    let recording = consistent.simulate(&human, &settings, STEP_S, CYCLES as f64, &mut findings);
    let recording = recording.map_err(|e| e.to_string())?;
    let simulated_s = start.elapsed().as_secs_f64();

    let weight = human.model.mass() * human.model.gravity().norm();
    let last = Last { cycle_s: walk.cycle_s(), rows: recording.grid().frames };
    let curves = curves(&human, &walk, &recording, &last);
    let foot_off = walk.phases(&walk.clock(0.0)).foot_off;
    let both: [Vec<f64>; 2] = [1, 0]
        .map(|axis| last.sampled(|row| recording.feet.iter().map(|foot| foot.force[row][axis]).sum::<f64>() / weight));
    let mean_force = both.each_ref().map(|force| mean(&force[..FINE]));
    let forward = |row: usize| recording.feet.iter().map(|foot| foot.force[row].x.max(0.0)).sum::<f64>() / weight;
    let propulsion = mean(&last.sampled(forward)[..FINE]);
    let trunk = last.sampled(|row| recording.effort("pelvis_tilt").map_or(0.0, |effort| effort[row]));
    let (slowest, fastest) = extremes(&curves[8]);
    let flying = last.rows().filter(|row| recording.flies(*row)).count();
    Ok(Cycle {
        walk: Pace {
            leg_length: walk.leg_length(),
            speed: walk.speed(),
            cycle_s: walk.cycle_s(),
            step_length: walk.step_length(),
        },
        peaks: Peaks::of(std::array::from_fn(|i| curves[i].as_slice()), foot_off),
        mean_force,
        net_share: mean_force[1] / propulsion,
        speed_range: (fastest - slowest) / mean(&curves[8][..FINE]),
        curves,
        slip: recording.stance_slip(last.row((CYCLES - 2) as f64) as usize).ok_or("no whole stance in two cycles")?,
        flight_s: flying as f64 * STEP_S,
        trunk: [rms(&trunk[..FINE]), trunk.iter().fold(0.0, |most, torque| torque.abs().max(most))],
        parameters: consistent.solution().unknowns().len(),
        adjustments: adjustments(&human, &consistent),
        consistent_s,
        iterations: consistent.solution().progress.iter().map(|stage| stage.steps).sum(),
        times_real_time: recording.grid().frames as f64 * STEP_S / simulated_s,
        unsolved_steps: recording.unsolved_steps,
    })
}

impl Cycle {
    /// A curve at the samples of the tables.
    pub(super) fn at_samples(&self, curve: usize) -> Vec<f64> {
        self.curves[curve].iter().step_by(FINE / (SAMPLES - 1)).copied().collect()
    }
}

/// The last whole cycle of a recording.
struct Last {
    cycle_s: f64,
    rows: usize,
}

impl Last {
    /// Position of a time among the rows [rows].
    fn row(&self, cycles: f64) -> f64 {
        cycles * self.cycle_s / STEP_S
    }

    fn rows(&self) -> std::ops::Range<usize> {
        self.row((CYCLES - 1) as f64).ceil() as usize..self.rows
    }

    /// A quantity at the fine samples, interpolated linearly between rows; beyond the last row its value is used.
    fn sampled(&self, value: impl Fn(usize) -> f64) -> Vec<f64> {
        let sample = |k: usize| {
            let place = self.row((CYCLES - 1) as f64 + k as f64 / FINE as f64).min((self.rows - 1) as f64);
            let (row, share) = (place as usize, place.fract());
            let next = value((row + 1).min(self.rows - 1));
            value(row) * (1.0 - share) + next * share
        };
        (0..=FINE).map(sample).collect()
    }
}

fn curves(human: &Human, walk: &Walk, recording: &WalkRecording, last: &Last) -> [Vec<f64>; 9] {
    let (mass, weight) = (human.model.mass(), human.model.mass() * human.model.gravity().norm());
    let angle = |name: &str, row: usize| {
        recording.coordinate(name).map_or(0.0, |id| recording.trajectory.values(id)[row].to_degrees())
    };
    let moment = |name: &str, sign: f64| {
        last.sampled(|row| recording.effort(name).map_or(0.0, |effort| sign * effort[row] / mass))
    };
    let force = |axis: usize| last.sampled(|row| recording.feet[0].force[row][axis] / weight);
    let trunk = Trunk::of(&human.model);
    // Clinical hip flexion is counted from the pelvis, whose tilt in upright standing is no zero; a pelvis that is one
    // with the trunk has the gait's tilt.
    let hip = |row: usize| match trunk {
        Trunk::WithPelvis => angle("hip_flexion_r", row) + walk.standing_tilt().to_degrees(),
        Trunk::OneBody => {
            let tilt = walk.at(row as f64 * STEP_S).pelvis_tilt.value.to_degrees();
            angle("hip_flexion_r", row) + angle("pelvis_tilt", row) + tilt
        }
    };
    let speed = center_speed(&human.model, recording);
    [
        last.sampled(hip),
        last.sampled(|row| -angle("knee_angle_r", row)),
        last.sampled(|row| angle("ankle_angle_r", row)),
        moment("hip_flexion_r", -1.0),
        moment("knee_angle_r", 1.0),
        moment("ankle_angle_r", -1.0),
        force(1),
        force(0),
        last.sampled(|row| speed[row]),
    ]
}

/// Forward velocity of the centre of mass of the whole body in each row [m/s]: momentum of all bodies over their mass.
fn center_speed(model: &Model, recording: &WalkRecording) -> Vec<f64> {
    let mut speed = Vec::with_capacity(recording.grid().frames);
    each_body_motion(model, &recording.trajectory, |_, bodies| {
        let momentum = model.bodies().iter().zip(bodies).map(|(body, at)| body.inertia.mass() * at.twist.linear.x);
        speed.push(momentum.sum::<f64>() / model.mass());
    });
    speed
}
