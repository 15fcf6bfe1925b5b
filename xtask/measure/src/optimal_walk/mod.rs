//! Compares optimal walks in three dimensions with healthy people: `cargo xtask optimal-walk [--write]`.
//!
//! Walks of a figure at the five speeds of Schwartz, Rozumalski, Trost 2008 (equal V/√(gL)) are solved from the first
//! guess and compared with their tables, with a second laboratory, and with the sideways forces of the recordings. A
//! failed criterion is listed as missed and is no error. With `--write` the page goes to docs/measured/OPTIMAL_WALK.md.

mod criteria;
mod curves;
mod page;
mod prediction;
mod sideways;

use crate::normative::{Band, SPEEDS};
use crate::walk_bands::child_leg;
use crate::workspace;
use ambulo::contact::HuntCrossley;
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Speed, Walk};
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::optimal::{Drift, Solution, WalkCosts, WalkProblem, soles_with_width};
use cpu_time::ThreadTime;
use curves::Cycle;

/// Index of free walking among the speeds.
const FREE: usize = 2;
/// The main figure.
const MAN: Build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
/// Other figures, at free speed.
const BUILDS: [Build; 4] = [
    Build { table: SegmentTable::DeLevaFemale, mass: 60.0, height: 1.65, toe_joint: true },
    Build { mass: 30.0, height: 1.30, ..MAN },
    Build { mass: 120.0, height: 1.90, ..MAN },
    Build { table: SegmentTable::Faure1997, mass: 80.0, height: 1.80, toe_joint: true },
];
/// Step of the forward simulation [s].
const STEP_S: f64 = 5e-4;
/// Changes of speed from free walking whose solution starts from that of free walking [m/s].
const SPEED_STEPS: [f64; 6] = [-0.2, -0.1, -0.05, 0.05, 0.1, 0.2];

/// A solved walk.
struct Found {
    speed: f64,
    cycle: Cycle,
    leg_length: f64,
    /// CPU time of the solver [s].
    seconds: f64,
    steps: usize,
    /// Residual forces at the root at the instants of the problem, and also between them: root mean square and maximum.
    root: (f64, f64),
    between: (f64, f64),
    drift: Drift,
    problem: WalkProblem,
    unknowns: Vec<f64>,
}

/// How a problem was solved from the solution of free walking of the main figure.
struct Near {
    name: String,
    /// CPU time of the solver [s].
    seconds: f64,
    steps: usize,
    /// Largest residual force at the root.
    root: f64,
}

/// Everything measured in one run.
struct Results {
    machine: String,
    /// Bands for the leg length of the main figure, at five speeds.
    people: [Vec<Band>; 5],
    /// Mean sideways force of people over stance, and number of people.
    sideways: (Vec<f64>, usize),
    man: Vec<Found>,
    near: Vec<Near>,
    /// The planar figure at free speed: CPU time [s], steps, largest residual force at the root.
    planar: (f64, usize, f64),
    others: Vec<(Build, Found, Vec<Band>)>,
}

/// Runs the command.
#[expect(clippy::print_stdout, reason = "the page is the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let write = workspace::write_option(words)?;
    let page = page::text(&measure()?)?;
    println!("{page}");
    if write {
        workspace::save("docs/measured/OPTIMAL_WALK.md", &page)?;
    }
    Ok(())
}

fn measure() -> Result<Results, String> {
    let their_leg = child_leg::legs()?[0].mean();
    let human = spatial(&MAN)?;
    let mut man = Vec::new();
    for speed in SPEEDS {
        man.push(find(&human, speed, None)?);
    }
    let near = near(&human, &man[FREE])?;
    let planar_figure = MAN.human().map_err(|e| e.to_string())?;
    let planar = find(&planar_figure, SPEEDS[FREE], None)?;
    let mut others = Vec::new();
    for build in BUILDS {
        let human = spatial(&build)?;
        let [_, _, bands, _, _] = curves::people(human.dimensions.leg_length, their_leg)?;
        others.push((build, find(&human, SPEEDS[FREE], None)?, bands));
    }
    Ok(Results {
        machine: crate::bench::machine(),
        people: curves::people(human.dimensions.leg_length, their_leg)?,
        sideways: sideways::people()?,
        near,
        planar: (planar.seconds, planar.steps, planar.root.1),
        man,
        others,
    })
}

fn spatial(build: &Build) -> Result<Human, String> {
    full_body(build).map_err(|e| e.to_string())
}

/// Other speeds of the figure, and another figure at the same dimensionless speed, from the solution of free walking.
fn near(human: &Human, free: &Found) -> Result<Vec<Near>, String> {
    let solved =
        |name: String, found: Found| Near { name, seconds: found.seconds, steps: found.steps, root: found.root.1 };
    let mut all = vec![solved("fast walking".to_owned(), find(human, SPEEDS[FREE + 1], Some(free))?)];
    for step in SPEED_STEPS {
        let found = find(human, SPEEDS[FREE] * (free.speed + step) / free.speed, Some(free))?;
        all.push(solved(format!("{step:+.2} m/s"), found));
    }
    for build in BUILDS {
        let found = find(&spatial(&build)?, SPEEDS[FREE], Some(free))?;
        all.push(solved(crate::walk_bands::build_name(&build), found));
    }
    Ok(all)
}

/// Costs of the planar figure whose time is measured. Slip and ground forces cost less than in three dimensions, as
/// when this time was first measured.
fn planar_costs() -> WalkCosts {
    WalkCosts { force: [0.02, 0.04], slip: 0.02, slip_exponent: 0.0, ..WalkCosts::default() }
}

/// Solves the walk of a figure at a dimensionless speed, from the first guess or from the solution of a similar walk.
fn find(human: &Human, speed: f64, near: Option<&Found>) -> Result<Found, String> {
    let mut gait = Gait::named("free").map_err(|e| e.to_string())?;
    gait.pace.speed = Some(Speed::Dimensionless(speed));
    let leg_length = human.dimensions.leg_length;
    let walk = Walk::new(&gait, leg_length, &mut Findings::default()).map_err(|e| e.to_string())?;
    let planar = human.model.coordinate("pelvis_list").is_none();
    let soles = if planar { human.soles.clone() } else { soles_with_width(human) };
    let clock = ThreadTime::now();
    let costs = if planar { planar_costs() } else { WalkCosts::default() };
    let problem =
        WalkProblem::new(human, &soles, HuntCrossley::SOFT_SHOES, &walk, &costs).map_err(|e| e.to_string())?;
    let solution: Solution = match near {
        Some(known) => problem.solve_near(&known.problem, &known.unknowns),
        None => problem.solve(problem.stages()),
    }
    .map_err(|e| e.to_string())?;
    let seconds = clock.elapsed().as_secs_f64();
    Ok(Found {
        speed: walk.speed(),
        cycle: Cycle::of(human, &walk, &problem, &solution)?,
        leg_length,
        seconds,
        steps: solution.progress.iter().map(|stage| stage.steps).sum(),
        root: solution.progress.last().map_or((f64::NAN, f64::NAN), |stage| stage.root),
        between: solution.root_forces(10).map_err(|e| e.to_string())?,
        drift: solution.forward(walk.cycle_s(), STEP_S).map_err(|e| e.to_string())?,
        unknowns: solution.unknowns().to_vec(),
        problem,
    })
}
