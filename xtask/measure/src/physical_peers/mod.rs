//! Walks by own torques in MuJoCo: `cargo xtask physical-peers [--env DIR]`, `.. --write`.
//!
//! A planar figure and one in three dimensions, with their plans and the default controller, walk in our simulator and
//! in MuJoCo: the figure is written as MJCF ([`figure`]), and the controller drives it step by step through pipes
//! ([`mujoco`]). MuJoCo is not installed everywhere, so the outcomes are recorded ([`OUTCOMES`]), and `--write` makes
//! the page docs/measured/PHYSICAL_PEERS.md from the record.

mod figure;
mod mujoco;
mod page;

use crate::workspace;
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Speed, Walk};
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::optimal::{OptimalWalk, Solution};
use ambulo::simulation::StepSettings;
use ambulo::simulation::consistent_walk::{ConsistentWalkSettings, make_consistent_walk};
use ambulo::simulation::control::{ControlSettings, PhysicalWalk, WalkController};
use cpu_time::ThreadTime;
use figure::Dynamics;
use mujoco::MuJoCo;
use serde_json::{Value, json};
use std::path::PathBuf;

/// Outcomes of the last run.
const OUTCOMES: &str = "xtask/measure/peers/physical_outcomes.json";
/// Folder of the models, relative to the workspace root.
const MODELS: &str = "target/peers/physical";
/// The figure, and the speed of its plans [m/s].
const MAN: Build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
const SPEED: f64 = 1.25;
/// Steps of a walk; fewer are asked. A walk also ends after this time [s].
const STEPS: usize = 100;
const LONGEST_S: f64 = 100.0;
/// Largest difference of mass matrix and forces between the figures, share of the largest entry.
const SAME_FIGURE: f64 = 1e-9;
/// Our walk is timed this often; the median counts.
const PASSES: usize = 5;

struct Settings {
    env: Option<PathBuf>,
    write: bool,
}

/// A figure with its plan.
struct Case {
    name: &'static str,
    /// Steps that are asked of it.
    asked: usize,
    human: Human,
    plan: Solution,
}

/// The state of a walk at the start of a step: values and rates, and the loads of both feet in the step before.
type Felt = (Vec<[f64; 2]>, [f64; 2]);

/// A walk, as far as it went.
struct Walked {
    steps: usize,
    time_s: f64,
    fell: bool,
    /// Mean speed [m/s].
    speed: f64,
    /// Root mean square differences of hips, knees and ankles from the plan [rad].
    apart: [f64; 3],
}

/// Runs the command.
#[expect(clippy::print_stdout, reason = "the page is the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let settings = Settings::parse(words)?;
    if !settings.write {
        let outcomes = measure(&settings)?;
        workspace::save(OUTCOMES, &format!("{outcomes:#}\n"))?;
    }
    let page = page::text(&workspace::recorded(OUTCOMES)?)?;
    println!("{page}");
    if settings.write {
        workspace::save("docs/measured/PHYSICAL_PEERS.md", &page)?;
    }
    Ok(())
}

impl Settings {
    fn parse(words: &[String]) -> Result<Settings, String> {
        let mut settings = Settings { env: workspace::peers_env(), write: false };
        let mut words = words.iter();
        while let Some(word) = words.next() {
            match word.as_str() {
                "--write" => settings.write = true,
                "--env" => settings.env = Some(words.next().ok_or("--env needs a folder")?.into()),
                other => return Err(format!("unknown option `{other}`, expected --write or --env DIR")),
            }
        }
        Ok(settings)
    }
}

fn measure(settings: &Settings) -> Result<Value, String> {
    // Before minutes of work.
    workspace::peer_program(settings.env.as_deref(), "mujoco", "walk_mujoco.py")?;
    let walks = [planar()?, spatial()?].iter().map(|case| walks(case, settings)).collect::<Result<Vec<_>, _>>()?;
    Ok(json!({
        "machine": crate::bench::machine(),
        "commit": workspace::commit(),
        "figure": crate::walk_bands::build_name(&MAN),
        "speed": SPEED,
        "walks": walks,
    }))
}

fn laws(leg_length: f64) -> Result<Walk, String> {
    let mut gait = Gait::named("free").map_err(|e| e.to_string())?;
    gait.pace.speed = Some(Speed::MetersPerSecond(SPEED));
    Walk::new(&gait, leg_length, &mut Findings::default()).map_err(|e| e.to_string())
}

fn planar() -> Result<Case, String> {
    let human = MAN.human().map_err(|e| e.to_string())?;
    let walk = laws(human.dimensions.leg_length)?;
    let walk = make_consistent_walk(&human, &walk, &ConsistentWalkSettings::default()).map_err(|e| e.to_string())?;
    Ok(Case { name: "planar", asked: 20, plan: walk.solution().clone(), human })
}

fn spatial() -> Result<Case, String> {
    let leg_length = MAN.human().map_err(|e| e.to_string())?.dimensions.leg_length;
    let found = OptimalWalk::find(&MAN, &laws(leg_length)?).map_err(|e| e.to_string())?;
    Ok(Case { name: "three dimensions", asked: 10, human: found.figure(), plan: found.solution })
}

/// All walks of a figure.
fn walks(case: &Case, settings: &Settings) -> Result<Value, String> {
    let step = StepSettings::default();
    let controller =
        WalkController::new(&case.human, &case.plan, step, &ControlSettings::default()).map_err(|e| e.to_string())?;
    let model = format!("{MODELS}/{}.xml", case.name.replace(' ', "-"));
    workspace::save(&model, &figure::mjcf(&case.human, &case.plan.problem().shoes, step.step_s)?)?;
    let [shoes, default] = ["shoes", "default"].map(|contact| {
        let mut command = workspace::peer_program(settings.env.as_deref(), "mujoco", "walk_mujoco.py")?;
        command.arg(workspace::root().join(&model)).arg(contact);
        mujoco_walk(case, &controller, MuJoCo::start(command, &controller.start())?)
    });
    let (walked, step_us) = our_walk(case, &controller)?;
    Ok(json!({
        "name": case.name,
        "asked": case.asked,
        "coordinates": case.human.model.coordinates().len(),
        "spheres": case.human.soles.len(),
        "mujoco": shoes?,
        "mujoco_default_contact": default?,
        "ours": { "walk": walked.json(), "step_us": step_us },
    }))
}

/// The walk in MuJoCo.
fn mujoco_walk(case: &Case, controller: &WalkController, mut peer: MuJoCo) -> Result<Value, String> {
    let apart = Dynamics::of(&case.human.model, &controller.start()).difference(&peer.dynamics);
    if apart > SAME_FIGURE {
        return Err(format!(
            "the figure in MuJoCo differs from ours: mass matrix and forces by {apart:e} of the largest"
        ));
    }
    let walked = in_mujoco(&case.human, controller.clone(), &mut peer)?;
    let settings = peer.settings.clone();
    let ended = peer.finish()?;
    Ok(json!({
        "walk": walked.json(), "step_us": ended["step_us"], "finite": ended["finite"], "settings": settings,
        "figure_difference": apart,
    }))
}

/// Drives the figure of MuJoCo.
fn in_mujoco(human: &Human, mut controller: WalkController, peer: &mut MuJoCo) -> Result<Walked, String> {
    let [q, qd] = controller.start();
    let mut felt: Felt = (q.into_iter().zip(qd).map(|(q, qd)| [q, qd]).collect(), [0.0; 2]);
    let mut log = Log::new(human, &controller);
    while log.goes_on(&controller) {
        let motors = controller.act(&felt.0, felt.1);
        let answer = peer.step(&motors)?;
        felt = (answer.now, answer.loads_n);
        log.add(answer.time_s, &felt.0, &controller);
    }
    Ok(log.walked(&controller))
}

/// The walk in our simulator, and the time of its steps without the controller [us].
fn our_walk(case: &Case, controller: &WalkController) -> Result<(Walked, f64), String> {
    let start = || {
        PhysicalWalk::with(&case.human, &case.plan, StepSettings::default(), controller.clone())
            .map_err(|e| e.to_string())
    };
    let (mut walk, mut log, mut states) = (start()?, Log::new(&case.human, controller), Vec::new());
    while log.goes_on(walk.controller()) {
        states.push(walk.coordinates());
        walk.step().map_err(|e| e.to_string())?;
        log.add(walk.time_s(), &walk.coordinates(), walk.controller());
    }
    let mut times = Vec::new();
    for _ in 0..PASSES {
        let mut again = start()?;
        let clock = ThreadTime::now();
        for _ in &states {
            again.step().map_err(|e| e.to_string())?;
        }
        let all_s = clock.elapsed().as_secs_f64();
        times.push((all_s - acting_s(controller.clone(), &states)) / states.len() as f64 * 1e6);
    }
    times.sort_by(f64::total_cmp);
    Ok((log.walked(walk.controller()), times[PASSES / 2]))
}

/// Time that the controller takes for these states [s]. Both feet bear half the weight or so: the time does not depend
/// on it.
fn acting_s(mut controller: WalkController, states: &[Vec<[f64; 2]>]) -> f64 {
    let clock = ThreadTime::now();
    for now in states {
        std::hint::black_box(controller.act(now, [400.0; 2]));
    }
    clock.elapsed().as_secs_f64()
}

/// What is recorded of a walk.
struct Log {
    /// Coordinates of hips, knees and ankles, and the one along the ground.
    joints: [Vec<usize>; 3],
    forward: usize,
    /// Place at the start, and now [m].
    start_m: f64,
    place_m: f64,
    squares: [f64; 3],
    count: f64,
    time_s: f64,
}

impl Log {
    fn new(human: &Human, controller: &WalkController) -> Log {
        let index = |name: &str| human.model.coordinate(name).map(|id| id.index());
        let of = |joint: &str| ["r", "l"].iter().filter_map(|side| index(&format!("{joint}_{side}"))).collect();
        let forward = index("pelvis_tx").unwrap_or(0);
        let [start, _] = controller.start();
        Log {
            joints: ["hip_flexion", "knee_angle", "ankle_angle"].map(of),
            forward,
            start_m: start[forward],
            place_m: start[forward],
            squares: [0.0; 3],
            count: 0.0,
            time_s: 0.0,
        }
    }

    fn goes_on(&self, controller: &WalkController) -> bool {
        controller.strikes() < STEPS && controller.fall().is_none() && self.time_s < LONGEST_S
    }

    fn add(&mut self, time_s: f64, now: &[[f64; 2]], controller: &WalkController) {
        let [planned, _] = controller.planned();
        for (square, joints) in self.squares.iter_mut().zip(&self.joints) {
            *square += joints.iter().map(|&c| (now[c][0] - planned[c]).powi(2)).sum::<f64>() / joints.len() as f64;
        }
        self.count += 1.0;
        self.time_s = time_s;
        self.place_m = now[self.forward][0];
    }

    fn walked(&self, controller: &WalkController) -> Walked {
        Walked {
            steps: controller.strikes(),
            time_s: self.time_s,
            fell: controller.fall().is_some(),
            speed: (self.place_m - self.start_m) / self.time_s,
            apart: self.squares.map(|sum| (sum / self.count).sqrt()),
        }
    }
}

impl Walked {
    fn json(&self) -> Value {
        json!({
            "steps": self.steps, "time_s": self.time_s, "fell": self.fell, "speed": self.speed,
            "apart_deg": self.apart.map(f64::to_degrees),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_is_that_of_the_recorded_outcomes() {
        let page = std::fs::read_to_string(workspace::root().join("docs/measured/PHYSICAL_PEERS.md")).unwrap();
        let (_, written) = page.split_once("\n\n").unwrap();
        let rendered = page::text(&workspace::recorded(OUTCOMES).unwrap()).unwrap();
        assert!(written == rendered, "hint: run `cargo xtask measured PHYSICAL_PEERS`");
    }

    #[test]
    fn options_are_read_and_a_missing_environment_is_an_error() {
        let parse = |words: &[&str]| Settings::parse(&words.iter().map(|&w| w.to_owned()).collect::<Vec<_>>());
        let settings = parse(&["--env", "there", "--write"]).unwrap();
        assert_eq!((settings.env, settings.write), (Some("there".into()), true));
        assert!(parse(&["--quick"]).is_err() && parse(&["--env"]).is_err());
        let nowhere = Settings { env: Some("/nowhere".into()), write: false };
        assert!(measure(&nowhere).unwrap_err().contains("README"));
    }
}
