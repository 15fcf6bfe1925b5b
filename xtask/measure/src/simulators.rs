//! Times and checks forward simulation of other engines in the same run as ours:
//! `cargo xtask simulators [--env DIR] [--data DIR] [--duration SECONDS] [--budget SECONDS] [--golden FILE]`.
//!
//! | scene  | size               | what                                                                             |
//! |--------|--------------------|----------------------------------------------------------------------------------|
//! | human  | degrees of freedom | stands on a plane on 12 spheres, springs in its joints (`human_contact.xml`)     |
//! | chain  | hinges             | links of 0.2 m and 1 kg along x, hinged to the world, about y and z by turns     |
//! | ladder | closed loops       | two rails of such links 0.3 m apart, rungs of 0.5 kg at their ends, hinges all y |
//!
//! Steps of 1 ms, gravity 9.81 m/s². Each case runs in a separate process, which prints one line of JSON:
//!
//! | key                                           | meaning                                                         |
//! |-----------------------------------------------|-----------------------------------------------------------------|
//! | `peer`, `version`, `scene`, `size`, `setting` | what ran; `solver_settings` has the details                     |
//! | `median_us`, `p10_us`, `p90_us`               | CPU time of the thread for one step [us]                        |
//! | `steps`                                       | steps done: the duration, or what the budget allowed            |
//! | `constraint_error_worst_m`, `.._last_m`       | distance of points that a joint joins [m]; 0 for coordinates    |
//! | `diverged`                                    | a state was not finite; MuJoCo then restarts and continues      |
//! | `energy_change_j`                             | chain, ladder: energy at the end minus at the start [J]         |
//! | `contact_force_n`, `weight_n`                 | human: upward force, mean over the last tenth; its weight [N]   |
//! | `pelvis_height_m`, `contacts`                 | human, at the end; below 0.9 m it sank or fell                  |
//! | `penetration_worst_m`, `.._last_m`            | human: deepest sphere [m], in all and over the last tenth       |
//! | `slip_m_per_s`, `creep_m`                     | human, last tenth: fastest sticking contact, longest path of one|
//! | `solver_iterations`                           | human, last tenth: mean per step                                |
//! | `error`                                       | instead of all results: the engine does not support this scene  |
//!
//! `null` means not finite, or not available: slip and creep if no contact stuck. A frictionless chain or ladder
//! conserves its energy, so the change is the error of the whole motion.
//!
//! Everything is also written to `target/simulators.json`. With `--golden FILE` nothing is timed: MuJoCo writes
//! accelerations and trajectories of the human without contact, and Pinocchio writes its accelerations next to them.
//!
//! Rapier is built with `-C target-cpu=native`, MuJoCo is a prebuilt library. Compare only times of one run.

use crate::workspace;
use serde_json::{Map, Value};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Folder of the peers' virtual environments, when `--env` is not given.
const ENV_VARIABLE: &str = "AMBULO_PEERS_ENV";
/// Our programs that run the peers, relative to the workspace root.
const PROGRAMS: &str = "xtask/measure/peers";
/// The human of the scene, and the one without springs and contact, in the data folder.
const HUMAN: &str = "human_contact.xml";
const GOLDEN_HUMAN: [&str; 2] = ["human.xml", "human.urdf"];

/// Where the peers are and how long they may run.
#[derive(Debug, Clone)]
pub(crate) struct Settings {
    /// Folder that holds the virtual environments `mujoco` and `pin`; none: only Rapier runs.
    pub(crate) env: Option<PathBuf>,
    /// Folder with `human_contact.xml`.
    pub(crate) data: PathBuf,
    /// Folder for programs, `target/peers`.
    pub(crate) build: PathBuf,
    /// Simulated time of each case [s].
    pub(crate) duration_s: f64,
    /// CPU time for the steps of each case [s]; at least three steps are done.
    pub(crate) budget_s: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            env: std::env::var_os(ENV_VARIABLE).map(PathBuf::from),
            data: workspace::data().join("reference/peers/data"),
            build: workspace::root().join("target/peers"),
            duration_s: 10.0,
            budget_s: 20.0,
        }
    }
}

/// A simulated scene; see the table above.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scene {
    Human,
    Chain,
    Ladder,
}

impl Scene {
    fn name(self) -> &'static str {
        match self {
            Scene::Human => "human",
            Scene::Chain => "chain",
            Scene::Ladder => "ladder",
        }
    }
}

/// An engine in one precision.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Peer {
    MuJoCo,
    RapierF32,
    RapierF64,
}

impl Peer {
    fn name(self) -> &'static str {
        match self {
            Peer::MuJoCo => "MuJoCo",
            Peer::RapierF32 => "Rapier f32",
            Peer::RapierF64 => "Rapier f64",
        }
    }
}

/// Sizes of a scene that one engine runs with one of its settings.
struct Cases {
    scene: Scene,
    peer: Peer,
    /// A name that the peer's program knows.
    setting: &'static str,
    /// The human has only one size, which its program prints.
    sizes: &'static [usize],
}

const fn cases(scene: Scene, peer: Peer, setting: &'static str, sizes: &'static [usize]) -> Cases {
    Cases { scene, peer, setting, sizes }
}

/// In the order of the table. Settings other than an engine's defaults run where they might do better.
const CASES: [Cases; 21] = [
    cases(Scene::Human, Peer::MuJoCo, "Euler", &[0]),
    cases(Scene::Human, Peer::MuJoCo, "implicitfast", &[0]),
    cases(Scene::Human, Peer::MuJoCo, "discrete", &[0]),
    cases(Scene::Human, Peer::MuJoCo, "implicitfast tight", &[0]),
    cases(Scene::Human, Peer::MuJoCo, "discrete tight", &[0]),
    cases(Scene::Human, Peer::RapierF32, "default", &[0]),
    cases(Scene::Human, Peer::RapierF64, "default", &[0]),
    cases(Scene::Human, Peer::RapierF32, "tight", &[0]),
    cases(Scene::Human, Peer::RapierF64, "tight", &[0]),
    cases(Scene::Chain, Peer::MuJoCo, "Euler", &[10, 100, 1000, 10_000]),
    cases(Scene::Chain, Peer::MuJoCo, "RK4", &[10, 100]),
    cases(Scene::Chain, Peer::RapierF32, "default", &[10, 100, 1000, 10_000]),
    cases(Scene::Chain, Peer::RapierF64, "default", &[10, 100, 1000, 10_000]),
    cases(Scene::Chain, Peer::RapierF64, "tight", &[10, 100, 1000]),
    cases(Scene::Ladder, Peer::MuJoCo, "Euler", &[10, 100, 1000]),
    cases(Scene::Ladder, Peer::MuJoCo, "implicitfast tight", &[10, 100]),
    cases(Scene::Ladder, Peer::MuJoCo, "discrete tight", &[10, 100]),
    cases(Scene::Ladder, Peer::RapierF32, "default", &[10, 100, 1000]),
    cases(Scene::Ladder, Peer::RapierF64, "default", &[10, 100, 1000]),
    cases(Scene::Ladder, Peer::RapierF32, "tight", &[10, 100]),
    cases(Scene::Ladder, Peer::RapierF64, "tight", &[10, 100, 1000]),
];

/// One row of the table.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PeerTiming {
    pub(crate) peer: Peer,
    pub(crate) scene: Scene,
    /// Hinges or loops; 0 for the human, whose size is in the measurement.
    pub(crate) size: usize,
    pub(crate) setting: &'static str,
    /// The results, or why there are none.
    pub(crate) outcome: Outcome,
}

/// Result of one case.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Outcome {
    /// It ran.
    Measured(Box<Measurement>),
    /// The engine does not support this scene.
    Refused { reason: String },
    /// The engine or the data are missing.
    NotInstalled { hint: String },
    /// It is installed, but did not build, run or print what was expected.
    Failed { reason: String },
}

/// Numbers that a peer's program printed. `None`: not finite.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Measurement {
    pub(crate) version: String,
    /// CPU time of one step [us]: median, tenth and ninetieth percentile.
    pub(crate) median_us: f64,
    pub(crate) p10_us: f64,
    pub(crate) p90_us: f64,
    pub(crate) steps: f64,
    /// Distance of points that a joint keeps together: largest, and at the end [m].
    pub(crate) constraint_error_m: [Option<f64>; 2],
    pub(crate) diverged: bool,
    /// Chain and ladder only [J].
    pub(crate) energy_change_j: Option<f64>,
    /// Human only.
    pub(crate) stance: Option<Stance>,
    /// The line as printed, with more keys than are here.
    pub(crate) line: String,
}

/// How the human stands. `None`: not finite.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Stance {
    pub(crate) contact_force_n: Option<f64>,
    pub(crate) weight_n: Option<f64>,
    pub(crate) pelvis_height_m: Option<f64>,
    /// Over the last tenth of the time [m].
    pub(crate) penetration_m: Option<f64>,
    pub(crate) slip_m_per_s: Option<f64>,
    pub(crate) creep_m: Option<f64>,
}

impl PeerTiming {
    /// The results, if the peer ran.
    pub(crate) fn measurement(&self) -> Option<&Measurement> {
        match &self.outcome {
            Outcome::Measured(measurement) => Some(measurement),
            _ => None,
        }
    }

    /// `MuJoCo 4.0.0, Euler`, without the version where it is not known.
    pub(crate) fn name(&self) -> String {
        let version = self.measurement().map(|m| format!(" {}", m.version)).unwrap_or_default();
        format!("{}{version}, {}", self.peer.name(), self.setting)
    }
}

// ---- the command ----

/// Runs all cases, prints the table and writes `target/simulators.json`; or makes the golden numbers. Fails on wrong
/// arguments and when an installed peer is broken, not when one is missing.
#[expect(clippy::print_stdout, reason = "the table is the command's result")]
pub(crate) fn command(args: &[String]) -> Result<(), String> {
    let (settings, golden_file) = parse(args)?;
    if let Some(file) = golden_file {
        print!("{}", golden(&settings, &file)?);
        return Ok(());
    }
    let timings = run(&settings);
    print!("{}", table(&timings));
    let path = workspace::root().join("target/simulators.json");
    let failed = |e: std::io::Error| format!("{}: cannot write: {e}", path.display());
    fs::create_dir_all(workspace::root().join("target")).map_err(failed)?;
    fs::write(&path, json(&timings)).map_err(failed)?;
    println!("\nwritten: {}", path.display());
    let failed = timings.iter().filter(|t| matches!(t.outcome, Outcome::Failed { .. })).count();
    if failed == 0 { Ok(()) } else { Err(format!("{failed} of {} cases failed, see the table", timings.len())) }
}

/// Runs every case, one after the other, in a fixed order. Prints on stderr which one is running.
#[expect(clippy::print_stderr, reason = "minutes pass before the table is complete")]
pub(crate) fn run(settings: &Settings) -> Vec<PeerTiming> {
    let rapier = build_rapier(settings);
    let mut timings = Vec::new();
    for Cases { scene, peer, setting, sizes } in CASES {
        for &size in sizes {
            eprintln!("{} {size}: {}, {setting}", scene.name(), peer.name());
            let rapier =
                |program| rapier.as_ref().map(|folder| Command::new(folder.join(program))).map_err(Clone::clone);
            let command = match peer {
                Peer::MuJoCo => mujoco(settings),
                Peer::RapierF32 => rapier("simulate_rapier_f32"),
                Peer::RapierF64 => rapier("simulate_rapier_f64"),
            };
            let outcome = command.and_then(|mut command| {
                command.args([scene.name(), setting]).arg("--duration").arg(settings.duration_s.to_string());
                command.arg("--budget").arg(settings.budget_s.to_string());
                match scene {
                    Scene::Human => command.arg("--model").arg(data_file(settings, HUMAN)?),
                    Scene::Chain | Scene::Ladder => command.arg("--size").arg(size.to_string()),
                };
                measure(&mut command)
            });
            timings.push(PeerTiming { peer, scene, size, setting, outcome: outcome.unwrap_or_else(|why_not| why_not) });
        }
    }
    timings
}

fn parse(args: &[String]) -> Result<(Settings, Option<PathBuf>), String> {
    let (mut settings, mut golden_file) = (Settings::default(), None);
    let mut args = args.iter();
    while let Some(option) = args.next() {
        let mut value = || args.next().ok_or_else(|| format!("{option} needs a value"));
        match option.as_str() {
            "--env" => settings.env = Some(PathBuf::from(value()?)),
            "--data" => settings.data = PathBuf::from(value()?),
            "--golden" => golden_file = Some(PathBuf::from(value()?)),
            "--duration" => settings.duration_s = seconds(value()?)?,
            "--budget" => settings.budget_s = seconds(value()?)?,
            _ => {
                let known = "--env DIR, --data DIR, --duration SECONDS, --budget SECONDS or --golden FILE";
                return Err(format!("unknown option `{option}`, expected {known}"));
            }
        }
    }
    Ok((settings, golden_file))
}

fn seconds(word: &str) -> Result<f64, String> {
    let found: Option<f64> = word.parse().ok();
    found.filter(|s| s.is_finite() && *s > 0.0).ok_or_else(|| format!("`{word}` is not a number of seconds above 0"))
}

// ---- the table and the file ----

/// The timings as text: one row each, then what the human does.
fn table(timings: &[PeerTiming]) -> String {
    let mut text = format!(
        "{:<12} {:<40} {:>10} {:>10} {:>10} {:>6} {:>10} {:>10} {:>10}\n",
        "scene", "us for a step of 1 ms", "median", "p10", "p90", "steps", "apart [m]", "last [m]", "energy [J]"
    );
    for timing in timings {
        let size = if timing.size == 0 { String::new() } else { timing.size.to_string() };
        let head = format!("{:<6} {size:>5} {:<40}", timing.scene.name(), timing.name());
        let _ = match &timing.outcome {
            Outcome::Measured(m) => writeln!(
                text,
                "{head} {:10.2} {:10.2} {:10.2} {:6.0} {} {} {}{}",
                m.median_us,
                m.p10_us,
                m.p90_us,
                m.steps,
                short(m.constraint_error_m[0]),
                short(m.constraint_error_m[1]),
                if timing.scene == Scene::Human { String::new() } else { short(m.energy_change_j) },
                if m.diverged { "  DIVERGED" } else { "" },
            ),
            Outcome::Refused { reason } => writeln!(text, "{head} not taken by the engine: {reason}"),
            Outcome::NotInstalled { hint } => writeln!(text, "{head} not installed; hint: {hint}"),
            Outcome::Failed { reason } => writeln!(text, "{head} failed: {reason}"),
        };
    }
    text + &stance_table(timings)
}

fn stance_table(timings: &[PeerTiming]) -> String {
    let rows = timings.iter().filter_map(|timing| Some((timing.name(), timing.measurement()?.stance.as_ref()?)));
    let mut text = format!(
        "\n{:<40} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10}\n",
        "human, last tenth of the time", "force [N]", "weight", "pelvis [m]", "sunk [m]", "slip [m/s]", "creep [m]"
    );
    let empty = text.len();
    for (name, stance) in rows {
        let number = |value: Option<f64>| value.map_or_else(|| format!("{:>10}", "-"), |x| format!("{x:10.3}"));
        let _ = writeln!(
            text,
            "{name:<40} {} {} {} {} {} {}",
            number(stance.contact_force_n),
            number(stance.weight_n),
            number(stance.pelvis_height_m),
            short(stance.penetration_m),
            short(stance.slip_m_per_s),
            short(stance.creep_m),
        );
    }
    if text.len() == empty { String::new() } else { text }
}

/// A number with two digits, ten characters wide.
fn short(value: Option<f64>) -> String {
    value.map_or_else(|| format!("{:>10}", "-"), |x| format!("{x:>10.1e}"))
}

/// A JSON array: the lines as printed, and an object with the reason for each case that did not run.
fn json(timings: &[PeerTiming]) -> String {
    let object = |timing: &PeerTiming| {
        let (key, why_not) = match &timing.outcome {
            Outcome::Measured(measurement) => return measurement.line.clone(),
            Outcome::Refused { reason } => ("error", reason),
            Outcome::NotInstalled { hint } => ("not_installed", hint),
            Outcome::Failed { reason } => ("failed", reason),
        };
        let [peer, scene, setting] = [timing.peer.name(), timing.scene.name(), timing.setting].map(Value::from);
        let size = timing.size;
        let head = format!("\"peer\": {peer}, \"scene\": {scene}, \"size\": {size}, \"setting\": {setting}");
        format!("{{{head}, \"{key}\": {}}}", Value::from(why_not.as_str()))
    };
    format!("[\n{}\n]\n", timings.iter().map(object).collect::<Vec<_>>().join(",\n"))
}

// ---- running; an Err is why there is no result ----

/// Runs a peer's program and reads the line it prints.
fn measure(command: &mut Command) -> Result<Outcome, Outcome> {
    let printed = output(command).map_err(|reason| Outcome::Failed { reason })?;
    let line = printed.lines().rfind(|line| line.starts_with('{')).unwrap_or_default();
    Ok(read(line).unwrap_or_else(|e| Outcome::Failed { reason: format!("cannot read `{line}`: {e}") }))
}

fn read(line: &str) -> Result<Outcome, String> {
    let object: Map<String, Value> = serde_json::from_str(line).map_err(|e| e.to_string())?;
    if let Some(Value::String(reason)) = object.get("error") {
        return Ok(Outcome::Refused { reason: reason.clone() });
    }
    let number = |key: &str| finite(&object, key);
    let needed = |key: &str| number(key)?.ok_or_else(|| format!("`{key}` is null"));
    let Some(Value::String(version)) = object.get("version") else { return Err("no text `version`".to_owned()) };
    let stance = object.contains_key("pelvis_height_m").then(|| {
        Ok::<_, String>(Stance {
            contact_force_n: number("contact_force_n")?,
            weight_n: number("weight_n")?,
            pelvis_height_m: number("pelvis_height_m")?,
            penetration_m: number("penetration_last_m")?,
            slip_m_per_s: number("slip_m_per_s")?,
            creep_m: number("creep_m")?,
        })
    });
    Ok(Outcome::Measured(Box::new(Measurement {
        version: version.clone(),
        median_us: needed("median_us")?,
        p10_us: needed("p10_us")?,
        p90_us: needed("p90_us")?,
        steps: needed("steps")?,
        constraint_error_m: [number("constraint_error_worst_m")?, number("constraint_error_last_m")?],
        diverged: object.get("diverged") != Some(&Value::Bool(false)),
        energy_change_j: if stance.is_none() { number("energy_change_j")? } else { None },
        stance: stance.transpose()?,
        line: line.to_owned(),
    })))
}

/// A required number; `None` if it was not finite.
fn finite(object: &Map<String, Value>, key: &str) -> Result<Option<f64>, String> {
    match object.get(key) {
        Some(Value::Number(number)) => Ok(number.as_f64()),
        Some(Value::Null) => Ok(None),
        _ => Err(format!("no number `{key}`")),
    }
}

/// Standard output of a command that must succeed.
fn output(command: &mut Command) -> Result<String, String> {
    let name = command.get_program().display().to_string();
    let done = command.output().map_err(|e| format!("{name}: cannot start: {e}"))?;
    if done.status.success() {
        return Ok(String::from_utf8_lossy(&done.stdout).into_owned());
    }
    let stderr = String::from_utf8_lossy(&done.stderr);
    let named = stderr.lines().rfind(|line| line.to_lowercase().contains("error"));
    Err(format!("{name}: {}: {}", done.status, named.or_else(|| stderr.lines().last()).unwrap_or_default()))
}

/// Python with MuJoCo, about to run our program.
fn mujoco(settings: &Settings) -> Result<Command, Outcome> {
    python(settings, "mujoco", "simulate_mujoco.py")
}

fn python(settings: &Settings, package: &str, program: &str) -> Result<Command, Outcome> {
    let install = format!("python3 -m venv DIR/{package} && DIR/{package}/bin/pip install {package} numpy");
    let Some(env) = &settings.env else {
        return Err(Outcome::NotInstalled { hint: format!("{install}, then pass --env DIR or set {ENV_VARIABLE}") });
    };
    let python = env.join(package).join("bin/python");
    if !python.is_file() {
        return Err(Outcome::NotInstalled { hint: install });
    }
    let mut command = Command::new(python);
    command.arg(workspace::root().join(PROGRAMS).join(program));
    Ok(command)
}

/// The folder of our programs that run Rapier, built if needed.
fn build_rapier(settings: &Settings) -> Result<PathBuf, Outcome> {
    let manifest = workspace::root().join(PROGRAMS).join("rapier/Cargo.toml");
    let target = settings.build.join("rapier");
    let cargo = |verb: &str| {
        let mut command = workspace::cargo();
        command.args([verb, "--quiet", "--locked", "--manifest-path"]).arg(&manifest);
        command
    };
    let not_fetched =
        |e| Outcome::NotInstalled { hint: format!("its crates could not be fetched, is there a network? {e}") };
    output(&mut cargo("fetch")).map_err(not_fetched)?;
    let mut build = cargo("build");
    build.args(["--release", "--target-dir"]).arg(&target).env("RUSTFLAGS", "-C target-cpu=native");
    output(&mut build).map_err(|reason| Outcome::Failed { reason })?;
    Ok(target.join("release"))
}

fn data_file(settings: &Settings, name: &str) -> Result<PathBuf, Outcome> {
    let path = settings.data.join(name);
    let hint = || format!("no {name} in {}; pass --data DIR", settings.data.display());
    if path.is_file() { Ok(path) } else { Err(Outcome::NotInstalled { hint: hint() }) }
}

// ---- golden numbers ----

/// Writes MuJoCo's numbers to `file` and Pinocchio's next to it, and returns a report. MuJoCo is required.
fn golden(settings: &Settings, file: &Path) -> Result<String, String> {
    let reason = |outcome: Outcome| match outcome {
        Outcome::NotInstalled { hint } => format!("not installed; hint: {hint}"),
        Outcome::Failed { reason } | Outcome::Refused { reason } => reason,
        Outcome::Measured(_) => String::new(),
    };
    let [mjcf, urdf] = GOLDEN_HUMAN.map(|name| data_file(settings, name).map_err(reason));
    let mut command = mujoco(settings).map_err(|why_not| format!("MuJoCo: {}", reason(why_not)))?;
    output(command.arg("golden").arg("--model").arg(mjcf?).arg("--output").arg(file))?;
    let mut text = format!("written: {}\n", file.display());
    let beside = file.with_extension("pinocchio.json");
    let pinocchio = python(settings, "pin", "accelerations_pinocchio.py").map_err(reason);
    let differences = pinocchio.and_then(|mut command| output(command.arg(file).arg(urdf?).arg(&beside)));
    let _ = match differences {
        Ok(line) => writeln!(text, "written: {}\nlargest differences: {}", beside.display(), line.trim_end()),
        Err(why_not) => writeln!(text, "Pinocchio: {why_not}"),
    };
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINE: &str = r#"{"peer": "P", "version": "1.2", "scene": "chain", "size": 10, "setting": "s", "median_us": 2.5,
        "p10_us": 2.0, "p90_us": 3.0, "steps": 100, "constraint_error_worst_m": 1e-3, "constraint_error_last_m": null,
        "diverged": false, "energy_change_j": -4.0}"#;

    fn timing(outcome: Outcome) -> PeerTiming {
        PeerTiming { peer: Peer::MuJoCo, scene: Scene::Chain, size: 10, setting: "Euler", outcome }
    }

    fn nowhere() -> Settings {
        let folder = std::env::temp_dir().join(format!("xtask-simulators-{}-absent", std::process::id()));
        Settings { env: None, data: folder.clone(), build: folder, ..Settings::default() }
    }

    #[test]
    fn a_printed_line_becomes_a_row() {
        let timing = timing(read(LINE).unwrap());
        let measurement = timing.measurement().unwrap();
        assert!((measurement.median_us - 2.5).abs() < 1e-12);
        assert_eq!(measurement.constraint_error_m, [Some(1e-3), None]);
        assert_eq!((measurement.energy_change_j, &measurement.stance), (Some(-4.0), &None));
        assert!(table(&[timing]).contains("chain     10 MuJoCo 1.2, Euler"));
    }

    #[test]
    fn a_human_needs_all_of_its_numbers() {
        let human = LINE.replace("\"energy_change_j\": -4.0", "\"pelvis_height_m\": 0.93");
        assert_eq!(read(&human).unwrap_err(), "no number `contact_force_n`");
        let whole = r#""contact_force_n": 735, "weight_n": 735.75, "penetration_last_m": 1e-3, "slip_m_per_s": 0,
            "creep_m": 0, "pelvis_height_m""#;
        let timing = timing(read(&human.replace("\"pelvis_height_m\"", whole)).unwrap());
        assert_eq!(timing.measurement().unwrap().stance.as_ref().unwrap().weight_n, Some(735.75));
        assert!(stance_table(&[timing]).contains("735.750"));
    }

    #[test]
    fn a_line_without_its_time_is_refused() {
        assert_eq!(
            read(&LINE.replace("\"median_us\": 2.5", "\"median_us\": null")).unwrap_err(),
            "`median_us` is null"
        );
        assert_eq!(read(&LINE.replace("\"steps\"", "\"strides\"")).unwrap_err(), "no number `steps`");
        assert!(read("").is_err());
    }

    #[test]
    fn an_engine_that_says_no_is_not_a_failure() {
        let refused = read(r#"{"peer": "P", "error": "too deep"}"#).unwrap();
        assert_eq!(refused, Outcome::Refused { reason: "too deep".to_owned() });
        let text = json(&[timing(refused), timing(read(LINE).unwrap())]);
        assert!(text.contains("\"error\": \"too deep\"") && text.contains("\"median_us\": 2.5"), "{text}");
    }

    #[test]
    fn what_is_missing_is_a_hint() {
        let hint = |found: Result<Command, Outcome>| match found {
            Err(Outcome::NotInstalled { hint }) => hint,
            other => panic!("{other:?}"),
        };
        assert!(hint(mujoco(&nowhere())).contains("bin/pip install mujoco numpy, then pass --env"));
        let other_env = Settings { env: Some(nowhere().data), ..nowhere() };
        assert!(hint(mujoco(&other_env)).ends_with("install mujoco numpy"));
        assert!(matches!(data_file(&nowhere(), HUMAN), Err(Outcome::NotInstalled { hint }) if hint.contains("--data")));
        assert!(golden(&nowhere(), Path::new("golden.json")).is_err());
    }

    #[test]
    fn wrong_arguments_are_named() {
        let args = |words: &[&str]| words.iter().map(|&w| w.to_owned()).collect::<Vec<_>>();
        assert_eq!(parse(&args(&["--golden", "here"])).unwrap().1, Some(PathBuf::from("here")));
        assert_eq!(parse(&args(&["--env"])).unwrap_err(), "--env needs a value");
        assert!(parse(&args(&["--budget", "-1"])).unwrap_err().contains("above 0"));
        assert!(parse(&args(&["--fast"])).unwrap_err().starts_with("unknown option `--fast`"));
    }
}
