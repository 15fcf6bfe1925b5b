//! Times synthetic walks: one cycle of joint curves, the consistent walk, and the simulation in the corrected and in
//! the paper's mode.

use super::timing::{Timing, cpu_us};
use super::{Row, table, verdict};
use ambulo::dynamics::{Workspace, inverse_frame};
use ambulo::findings::Findings;
use ambulo::gait::machine::WalkMachine;
use ambulo::gait::{Gait, Walk, WalkCoordinates};
use ambulo::kinematics::Posture;
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::simulation::consistent_walk::{ConsistentWalk, ConsistentWalkSettings, make_consistent_walk};
use ambulo_paper::{Footwear, TrialSettings, paper_human, paper_walk};
use cpu_time::ThreadTime;
use std::hint::black_box;

/// Frame rate of a cycle [Hz].
const RATE_HZ: f64 = 100.0;
/// A cycle with its torques takes less than this [ms].
const REQUIRED_OF_CYCLE_MS: f64 = 1.0;
/// A step of the paper's mode takes at most this [us]: 200 times real time at 1 kHz.
const REQUIRED_OF_STEP_US: f64 = 5.0;
/// Largest share of a simulated step that state machines cost more than closed curves, which know no states.
const REQUIRED_OF_MACHINES: f64 = 0.05;
/// Time step of the simulator [s], and number of cycles.
const STEP_S: f64 = 1e-3;
const CYCLES: usize = 6;
/// How often a walk is made consistent: a second each.
const RUNS: usize = 5;

/// Prints and returns the rows.
#[expect(clippy::print_stdout, reason = "the table is the command's result")]
pub(super) fn bench() -> Result<Vec<Row>, String> {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
    let human = build.human().map_err(|e| e.to_string())?;
    let cycle = cycle(&human)?;
    let (consistent, walk) = consistent(&human)?;
    let corrected = corrected(&human, &walk)?;
    let paper = paper()?;
    let machines = machines(&human)?;
    let row = |quantity: &str, unit, timing| Row { quantity: quantity.to_owned(), unit, timing };
    let rows = vec![
        row("gait and torques of a cycle at 100 Hz", "ms", cycle),
        row("making a walk consistent", "s", consistent),
        row("corrected mode, 1 kHz", "us/step", corrected),
        row("paper mode, 1 kHz", "us/step", paper),
        row("posture by closed curves", "us", machines.curves),
        row("posture by state machines", "us", machines.whole),
    ];
    println!("\nsynthetic walks");
    print!("{}", table(&rows));
    println!(
        "required of a cycle: less than {REQUIRED_OF_CYCLE_MS} ms: {}",
        verdict(cycle.median, REQUIRED_OF_CYCLE_MS)
    );
    let times = |us: f64| STEP_S * 1e6 / us;
    println!("corrected mode: {:.0} times real time", times(corrected.median));
    println!(
        "paper mode: {:.0} times real time, required {:.0}: {}",
        times(paper.median),
        times(REQUIRED_OF_STEP_US),
        verdict(paper.median, REQUIRED_OF_STEP_US)
    );
    let shares = [machines.whole.median / paper.median, machines.more() / paper.median];
    println!(
        "state machines: {:.0} % of a step of the paper mode if they run in each step; {:.1} % more than closed \
         curves, required {:.0} %: {}",
        100.0 * shares[0],
        100.0 * shares[1],
        100.0 * REQUIRED_OF_MACHINES,
        verdict(shares[1], REQUIRED_OF_MACHINES)
    );
    println!("the paper mode runs them for one cycle: {:.1} % of {CYCLES} cycles", 100.0 * shares[0] / CYCLES as f64);
    Ok(rows)
}

fn free(human: &Human) -> Result<Walk, String> {
    let gait = Gait::named("free").map_err(|e| e.to_string())?;
    Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).map_err(|e| e.to_string())
}

/// From the gait's name to the torques of a cycle, ground forces apart: every joint and the root, workspace included
/// [ms].
fn cycle(human: &Human) -> Result<Timing, String> {
    free(human)?;
    let count = human.model.coordinates().len();
    let timing = cpu_us(1, || {
        let Ok(walk) = free(human) else { return };
        let (coordinates, mut workspace) = (WalkCoordinates::of(&human.model), Workspace::new(&human.model));
        let (mut q, mut qd, mut qdd) = (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
        for frame in 0..(walk.cycle_s() * RATE_HZ).ceil() as usize {
            coordinates.write(&walk.at(frame as f64 / RATE_HZ), &mut q, &mut qd, &mut qdd);
            let posture = Posture { q: &q, qd: &qd, qdd: &qdd };
            black_box(inverse_frame(&mut workspace, posture, &[]).generalized());
        }
    });
    Ok(scaled(timing, 1e-3))
}

/// [s]
fn consistent(human: &Human) -> Result<(Timing, ConsistentWalk), String> {
    let walk = free(human)?;
    let make = || make_consistent_walk(human, &walk, &ConsistentWalkSettings::default()).map_err(|e| e.to_string());
    let made = make()?;
    let mut times = Vec::new();
    for _ in 0..RUNS {
        let start = ThreadTime::now();
        black_box(make()?);
        times.push(start.elapsed().as_secs_f64());
    }
    Ok((Timing::of(times), made))
}

/// [us/step]
fn corrected(human: &Human, walk: &ConsistentWalk) -> Result<Timing, String> {
    let simulate = || {
        let findings = &mut Findings::default();
        walk.simulate(human, &ConsistentWalkSettings::default(), STEP_S, CYCLES as f64, findings)
            .map_err(|e| e.to_string())
    };
    let steps = simulate()?.grid().frames;
    Ok(cpu_us(steps, || {
        black_box(simulate().is_ok());
    }))
}

/// The paper's figure in its standard gait on rigid soles [us/step].
fn paper() -> Result<Timing, String> {
    let human = paper_human().map_err(|e| e.to_string())?;
    let gait = Gait::named("standard").map_err(|e| e.to_string())?;
    let (shoes, friction) = (Footwear::Own, 1.0);
    let trial = TrialSettings { gait: &gait, human: &human, shoes, friction, rate_hz: 1.0 / STEP_S, cycles: CYCLES };
    let steps = paper_walk(&trial).map_err(|e| e.to_string())?.recording.grid().frames;
    Ok(cpu_us(steps, || {
        black_box(paper_walk(&trial).is_ok());
    }))
}

/// Times of one posture of a walk [us].
struct MachineTimes {
    /// Closed curves ([`Walk::at`]).
    curves: Timing,
    /// The state machines, which evaluate the curves.
    whole: Timing,
}

impl MachineTimes {
    /// What the machines cost more than closed curves [us].
    fn more(&self) -> f64 {
        (self.whole.median - self.curves.median).max(0.0)
    }
}

/// Postures of the standard gait, with and without its machines.
fn machines(human: &Human) -> Result<MachineTimes, String> {
    let gait = Gait::named("standard").map_err(|e| e.to_string())?;
    let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).map_err(|e| e.to_string())?;
    let steps = (walk.cycle_s() / STEP_S) as usize;
    let times = || (0..steps).map(|step| STEP_S * step as f64);
    let curves = cpu_us(steps, || times().for_each(|t| _ = black_box(walk.at(t))));
    let mut machine = WalkMachine::new(&walk);
    let whole = cpu_us(steps, || times().for_each(|t| _ = black_box(machine.step(t))));
    Ok(MachineTimes { curves, whole })
}

fn scaled(timing: Timing, factor: f64) -> Timing {
    let scale = |value: f64| value * factor;
    Timing { median: scale(timing.median), spread: timing.spread.map(|spread| spread.map(scale)) }
}
