//! The command line, the clock and the line of results.
//!
//! ```text
//! simulate_rapier_f32 human|chain|ladder default|tight [--model human_contact.xml] [--size N]
//!                     [--duration SECONDS] [--budget SECONDS]
//! ```

use crate::human::Human;
use crate::rapier::prelude::*;
use crate::scene::{STEP_S, Scene};
use cpu_time::ThreadTime;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::process::ExitCode;

/// Processor times that are taken at least, whatever the budget.
const LEAST_SAMPLES: usize = 3;
/// From this size on each step is timed alone, smaller scenes step in tens.
const LARGE: usize = 1000;
/// The human is watched step by step over the last tenth of the duration.
const WATCHED: f64 = 0.1;
struct Arguments {
    scene: String,
    setting: String,
    model: String,
    size: usize,
    /// Simulated time [s].
    duration_s: f64,
    /// Processor time for stepping [s].
    budget_s: f64,
}

/// Runs one scene and prints one line of JSON.
pub fn run() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match parse(&words).and_then(|arguments| simulate(&arguments)) {
        Ok(line) => {
            println!("{line}");
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::from(2)
        }
    }
}

fn parse(words: &[String]) -> Result<Arguments, String> {
    let [scene, setting, options @ ..] = words else {
        return Err(
            "expected a scene (human, chain or ladder) and a setting (default or tight), then options".to_owned()
        );
    };
    let mut arguments = Arguments {
        scene: scene.clone(),
        setting: setting.clone(),
        model: String::new(),
        size: 0,
        duration_s: 10.0,
        budget_s: 20.0,
    };
    for option in options.chunks(2) {
        let [name, value] = option else { return Err(format!("{} needs a value", option[0])) };
        let wrong = |_| format!("{name} cannot be `{value}`");
        match name.as_str() {
            "--model" => arguments.model.clone_from(value),
            "--size" => arguments.size = value.parse().map_err(|_| format!("{name} cannot be `{value}`"))?,
            "--duration" => arguments.duration_s = value.parse().map_err(wrong)?,
            "--budget" => arguments.budget_s = value.parse().map_err(wrong)?,
            _ => return Err(format!("unknown option `{name}`")),
        }
    }
    Ok(arguments)
}

fn simulate(arguments: &Arguments) -> Result<String, String> {
    match arguments.scene.as_str() {
        "human" => human(arguments),
        "chain" => bodies(arguments, Scene::chain(arguments.size)),
        "ladder" => bodies(arguments, Scene::ladder(arguments.size)),
        other => Err(format!("unknown scene `{other}`")),
    }
}

// ---- the scenes ----

fn human(arguments: &Arguments) -> Result<String, String> {
    let text = std::fs::read_to_string(&arguments.model).map_err(|e| format!("{}: {e}", arguments.model))?;
    let mut human = Human::read(&text).map_err(|e| format!("{}: {e}", arguments.model))?;
    let settings = configure(&mut human.scene.world, &arguments.setting)?;
    let steps = steps(arguments);
    let watched = ((WATCHED * steps as f64).round() as usize).max(1);
    let (mut worst_error, mut worst_penetration) = (0.0_f64, 0.0_f64);
    let timed = timed(
        &mut human,
        |human| &mut human.scene.world,
        steps.saturating_sub(watched),
        10,
        arguments,
        |human| {
            worst_error = worst_error.max(human.scene.constraint_error());
            worst_penetration = worst_penetration.max(human.penetration());
        },
    );
    // `max` passes over what is not a number, so these stay so only if no contact sticks.
    let (mut force, mut penetration, mut slip, mut contacts) = (0.0, 0.0_f64, f64::NAN, 0);
    let mut ways: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
    for _ in 0..watched {
        human.scene.world.step();
        let stance = human.stance();
        force += stance.force_n;
        contacts = stance.contacts;
        for (sphere, [x, y]) in stance.sticking {
            slip = slip.max(x.hypot(y));
            let way = ways.entry(sphere).or_default();
            *way = [way[0] + x * STEP_S, way[1] + y * STEP_S];
        }
        penetration = penetration.max(human.penetration());
        worst_error = worst_error.max(human.scene.constraint_error());
    }
    let parameters = human.scene.world.integration_parameters;
    let mut line = Line::new(arguments, human.degrees_of_freedom, &settings);
    line.timing(timed, watched);
    line.number("constraint_error_worst_m", worst_error);
    line.number("constraint_error_last_m", human.scene.constraint_error());
    line.flag("diverged", human.scene.diverged());
    line.number("contact_force_n", force / watched as f64);
    line.number("weight_n", human.weight_n);
    line.number("pelvis_height_m", human.pelvis_height());
    line.number("contacts", contacts as f64);
    line.number("penetration_worst_m", worst_penetration.max(penetration));
    line.number("penetration_last_m", penetration);
    line.number("slip_m_per_s", slip);
    line.number("creep_m", ways.values().map(|[x, y]| x.hypot(*y)).fold(f64::NAN, f64::max));
    line.number(
        "solver_iterations",
        (parameters.num_solver_iterations * parameters.num_internal_pgs_iterations) as f64,
    );
    Ok(line.finish())
}

/// Times a scene of hinged bodies.
fn bodies(arguments: &Arguments, mut scene: Scene) -> Result<String, String> {
    let settings = configure(&mut scene.world, &arguments.setting)?;
    let before = scene.energy();
    let batch = if arguments.size >= LARGE { 1 } else { 10 };
    let mut worst = 0.0_f64;
    let timed = timed(
        &mut scene,
        |scene| &mut scene.world,
        steps(arguments),
        batch,
        arguments,
        |scene| {
            worst = worst.max(scene.constraint_error());
        },
    );
    let mut line = Line::new(arguments, arguments.size, &settings);
    line.timing(timed, 0);
    line.number("constraint_error_worst_m", worst);
    line.number("constraint_error_last_m", scene.constraint_error());
    line.flag("diverged", scene.diverged());
    line.number("energy_change_j", scene.energy() - before);
    Ok(line.finish())
}

/// Changes the world's parameters; -> what the solver then works with, as text.
fn configure(world: &mut PhysicsWorld, setting: &str) -> Result<String, String> {
    let parameters = &mut world.integration_parameters;
    match setting {
        "default" => {}
        // The cheapest of the combinations tried (4 to 64 iterations, 1 to 20 sweeps, contacts at 60 to 1000 Hz) in
        // which the human stands: with the contacts' own 60 Hz it falls, however many iterations are made.
        "tight" => {
            parameters.num_internal_pgs_iterations = 8;
            parameters.warmstart_joints = true;
            parameters.contact_recycling = false;
            parameters.friction_in_bias_pass = true;
            parameters.friction_model = FrictionModel::Coulomb;
            parameters.static_contact_softness = SpringCoefficients::new(300.0, 1.0);
        }
        _ => return Err(format!("unknown setting `{setting}`, expected default or tight")),
    }
    Ok(format!(
        "impulse joints, {}, {} solver iterations of {} sweeps, joints {} warm-started, {:?} friction, \
         contact with fixed bodies {} Hz, damping ratio {}",
        crate::PRECISION[0],
        parameters.num_solver_iterations,
        parameters.num_internal_pgs_iterations,
        if parameters.warmstart_joints { "are" } else { "not" },
        parameters.friction_model,
        parameters.static_contact_softness.natural_frequency,
        parameters.static_contact_softness.damping_ratio,
    ))
}

fn steps(arguments: &Arguments) -> usize {
    (arguments.duration_s / STEP_S).round() as usize
}

// ---- the clock ----

/// Processor time of one step [us], one for each batch, and the steps done.
struct Timed {
    samples_us: Vec<f64>,
    steps: usize,
}

/// Steps until `steps` are done or the budget is used up; `watch` runs after each batch.
fn timed<T>(
    scene: &mut T,
    world: fn(&mut T) -> &mut PhysicsWorld,
    steps: usize,
    batch: usize,
    arguments: &Arguments,
    mut watch: impl FnMut(&T),
) -> Timed {
    let mut timed = Timed { samples_us: Vec::new(), steps: 0 };
    let start = ThreadTime::now();
    while timed.steps < steps {
        let taken = timed.samples_us.len();
        if taken >= LEAST_SAMPLES && start.elapsed().as_secs_f64() * (1.0 + 1.0 / taken as f64) > arguments.budget_s {
            break;
        }
        let count = batch.min(steps - timed.steps);
        let begin = ThreadTime::now();
        for _ in 0..count {
            world(scene).step();
        }
        timed.samples_us.push(begin.elapsed().as_secs_f64() * 1e6 / count as f64);
        timed.steps += count;
        watch(scene);
    }
    timed
}

// ---- the line of results ----

/// A JSON object in the making.
struct Line(String);

impl Line {
    fn new(arguments: &Arguments, size: usize, settings: &str) -> Line {
        let mut line = Line("{".to_owned());
        line.text("peer", "Rapier");
        line.text("version", version());
        line.text("scene", &arguments.scene);
        line.number("size", size as f64);
        line.text("setting", &format!("{} {}", crate::PRECISION[0], arguments.setting));
        line.text("solver_settings", settings);
        line
    }

    /// Median, tenth and ninetieth percentile by rank, and the steps with those that were watched, not timed.
    fn timing(&mut self, timed: Timed, watched: usize) {
        let mut samples = timed.samples_us;
        samples.sort_by(f64::total_cmp);
        let rank = |part: usize, whole: usize| samples.get(samples.len() * part / whole).copied().unwrap_or(f64::NAN);
        self.number("median_us", rank(1, 2));
        self.number("p10_us", rank(1, 10));
        self.number("p90_us", rank(9, 10));
        self.number("steps", (timed.steps + watched) as f64);
    }

    /// Our own words only: nothing in them needs an escape.
    fn text(&mut self, key: &str, value: &str) {
        let _ = write!(self.0, "\"{key}\": \"{value}\", ");
    }

    /// JSON has no word for what is not finite; null stands for it.
    fn number(&mut self, key: &str, value: f64) {
        let _ = match value.is_finite() {
            true => write!(self.0, "\"{key}\": {value:e}, "),
            false => write!(self.0, "\"{key}\": null, "),
        };
    }

    fn flag(&mut self, key: &str, value: bool) {
        let _ = write!(self.0, "\"{key}\": {value}, ");
    }

    fn finish(self) -> String {
        format!("{}}}", self.0.trim_end_matches(", "))
    }
}

/// Rapier's version, from the lock file that this program was built with.
fn version() -> &'static str {
    let lock = include_str!("../Cargo.lock");
    let after = lock.split_once(&format!("name = \"{}\"\nversion = \"", crate::PRECISION[1])).map(|(_, after)| after);
    after.and_then(|after| after.split('"').next()).unwrap_or("unknown")
}
