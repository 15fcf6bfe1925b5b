//! Times inverse dynamics of other engines in the same run as ours: `cargo xtask peers [--env DIR] [--scripts DIR]`.
//!
//! The model (16 segments, 37 degrees of freedom), the motion (1000 frames, base at rest) and the C and C++ programs
//! are in the scripts folder; its README explains how to install each peer. A missing peer is listed with a hint.
//!
//! Times are CPU time of the thread per frame [us], the median of 31 to 41 passes over all frames. Compare only times
//! of one run: between runs, the same program varied by up to 30 %. All programs are built with `-O3 -march=native`.

use ambulo_formats::npz::Npz;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Folder of the peers' virtual environments, when `--env` is not given.
const ENV_VARIABLE: &str = "AMBULO_PEERS_ENV";
/// Scripts and data of the peers, relative to the workspace root.
const SCRIPTS: &str = "../shared/reference/peers";
/// Where the header-only library Eigen, which Pinocchio needs, is usually installed.
const EIGEN_FOLDERS: [&str; 3] = ["/usr/include/eigen3", "/usr/local/include/eigen3", "/opt/homebrew/include/eigen3"];
/// Pinocchio's headers do not compile without these; they come from its CMake file.
const PINOCCHIO_DEFINITIONS: [&str; 5] = [
    "-DNDEBUG",
    "-DBOOST_MPL_LIMIT_LIST_SIZE=30",
    "-DBOOST_MPL_LIMIT_VECTOR_SIZE=30",
    "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS",
    "-DBOOST_FUSION_INVOKE_MAX_ARITY=12",
];

/// Where the peers are and where to build them.
#[derive(Debug, Clone)]
pub(crate) struct Settings {
    /// Folder that holds the virtual environments `mujoco` and `pin`; none: only the floor loop runs.
    pub(crate) env: Option<PathBuf>,
    /// Folder with `id_mujoco.c`, `id_pinocchio.cpp`, `limit.cpp` and `data/`.
    pub(crate) scripts: PathBuf,
    /// Folder for programs and data, `target/peers`.
    pub(crate) build: PathBuf,
}

impl Default for Settings {
    fn default() -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let env = std::env::var_os(ENV_VARIABLE).map(PathBuf::from);
        Settings { env, scripts: root.join(SCRIPTS), build: root.join("target/peers") }
    }
}

/// What one line of a peer's program computes for each frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Task {
    /// Motion to joint torques.
    Inverse,
    /// Joint torques to accelerations, no contact.
    Forward,
    /// Joint-space inertia matrix.
    MassMatrix,
    /// Motion to joint torques by a loop written for this model only: a lower bound for any engine.
    Floor,
}

/// One row of the table.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PeerTiming {
    /// Peer, version and function: `MuJoCo 4.0.0 mj_inverse`.
    pub(crate) name: String,
    /// What was timed.
    pub(crate) task: Task,
    /// The time, or why there is none.
    pub(crate) outcome: Outcome,
}

/// Result of one program.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Outcome {
    /// It ran.
    Measured {
        /// CPU time for one frame, in microseconds.
        median_us: f64,
    },
    /// It cannot be built here.
    NotInstalled {
        /// What to install.
        hint: String,
    },
    /// It is installed, but did not compile, run or print what was expected.
    Failed {
        /// What happened.
        reason: String,
    },
}

impl PeerTiming {
    /// CPU time for one frame, in microseconds, if the peer ran.
    pub(crate) fn median_us(&self) -> Option<f64> {
        match self.outcome {
            Outcome::Measured { median_us } => Some(median_us),
            _ => None,
        }
    }
}

/// A peer's program and the lines it prints.
struct Program {
    peer: &'static str,
    source: &'static str,
    /// Virtual environment; pip's name of the package in it is the same.
    package: Option<&'static str>,
    command: fn(&Settings) -> Result<Build, String>,
    /// Label the program prints, how we call it, what it computes.
    lines: &'static [(&'static str, &'static str, Task)],
}

/// How to compile a program.
struct Build {
    compiler: &'static str,
    flags: Vec<String>,
}

const PROGRAMS: [Program; 3] = [
    Program {
        peer: "MuJoCo",
        source: "id_mujoco.c",
        package: Some("mujoco"),
        command: mujoco,
        lines: &[
            ("C mj_kinematics+comPos+comVel+mj_rne", "mj_rne and what it needs", Task::Inverse),
            ("C mj_inverse", "mj_inverse", Task::Inverse),
            ("C mj_forward (no contact)", "mj_forward", Task::Forward),
        ],
    },
    Program {
        peer: "Pinocchio",
        source: "id_pinocchio.cpp",
        package: Some("pin"),
        command: pinocchio,
        lines: &[
            ("C++ pinocchio rnea", "rnea", Task::Inverse),
            ("C++ pinocchio aba", "aba", Task::Forward),
            ("C++ pinocchio crba", "crba", Task::MassMatrix),
        ],
    },
    Program {
        peer: "floor loop",
        source: "limit.cpp",
        package: None,
        command: floor_loop,
        lines: &[
            ("Newton-Euler, one frame at a time", "frame by frame", Task::Floor),
            ("Newton-Euler, 8 frames side by side, per frame", "8 frames side by side", Task::Floor),
        ],
    },
];

/// Measures every peer and prints the table. Fails on wrong arguments or when an installed peer is broken.
#[expect(clippy::print_stdout, reason = "the table is the command's result")]
pub(crate) fn run(args: &[String]) -> Result<(), String> {
    let timings = measure(&parse(args)?);
    print!("{}", table(&timings));
    let failed = timings.iter().filter(|t| matches!(t.outcome, Outcome::Failed { .. })).count();
    if failed == 0 { Ok(()) } else { Err(format!("{failed} of {} lines failed, see the table", timings.len())) }
}

/// Builds and runs each peer, one after the other; one or more rows for each, in a fixed order.
pub(crate) fn measure(settings: &Settings) -> Vec<PeerTiming> {
    PROGRAMS.iter().flat_map(|program| program_rows(program, settings)).collect()
}

/// The timings as text, one row each.
pub(crate) fn table(timings: &[PeerTiming]) -> String {
    let mut text = format!("{:<44} {:>12}\n", "inverse dynamics of other engines", "us per frame");
    for timing in timings {
        let result = match &timing.outcome {
            Outcome::Measured { median_us } => format!("{median_us:12.3}"),
            Outcome::NotInstalled { hint } => format!("not installed; hint: {hint}"),
            Outcome::Failed { reason } => format!("failed: {reason}"),
        };
        let kind = match timing.task {
            Task::Inverse | Task::Floor => "",
            Task::Forward => " (forward)",
            Task::MassMatrix => " (mass matrix)",
        };
        let _ = writeln!(text, "{:<44} {result}", format!("{}{kind}", timing.name));
    }
    if let Some((name, median_us)) = fastest(timings) {
        let _ = writeln!(text, "fastest inverse dynamics: {name}, {median_us:.3}");
    }
    text
}

/// The peer with the shortest time of inverse dynamics, and that time [us]; ours is compared with it.
pub(crate) fn fastest(timings: &[PeerTiming]) -> Option<(&str, f64)> {
    let inverse = timings.iter().filter(|t| t.task == Task::Inverse);
    let measured = inverse.filter_map(|t| Some((t.name.as_str(), t.median_us()?)));
    measured.min_by(|(_, a), (_, b)| a.total_cmp(b))
}

fn parse(args: &[String]) -> Result<Settings, String> {
    let mut settings = Settings::default();
    let mut args = args.iter();
    while let Some(option) = args.next() {
        let mut folder = || args.next().map(PathBuf::from).ok_or_else(|| format!("{option} needs a folder"));
        match option.as_str() {
            "--env" => settings.env = Some(folder()?),
            "--scripts" => settings.scripts = folder()?,
            _ => return Err(format!("unknown option `{option}`, expected --env DIR or --scripts DIR")),
        }
    }
    Ok(settings)
}

/// Rows of one program: measured, or each with the same reason for its absence.
fn program_rows(program: &Program, settings: &Settings) -> Vec<PeerTiming> {
    let name = versioned_name(program, settings);
    let ready = find_source(program, settings).and_then(|source| Ok((source, (program.command)(settings)?)));
    let printed = match ready {
        Ok((source, build)) => execute(&source, &build, settings).map_err(|reason| Outcome::Failed { reason }),
        Err(hint) => Err(Outcome::NotInstalled { hint }),
    };
    let row = |&(label, function, task): &(&str, &str, Task)| PeerTiming {
        name: format!("{name} {function}"),
        task,
        outcome: printed.as_ref().map_or_else(Clone::clone, |text| outcome(text, label)),
    };
    program.lines.iter().map(row).collect()
}

fn outcome(printed: &str, label: &str) -> Outcome {
    match median_us(printed, label) {
        Some(median_us) => Outcome::Measured { median_us },
        None => Outcome::Failed { reason: format!("the program printed no median for `{label}`") },
    }
}

/// Median in microseconds, from the line `LABEL  cpu us: median  3.683  p10 ..` (or `cpu ns:`).
fn median_us(printed: &str, label: &str) -> Option<f64> {
    printed.lines().find_map(|line| {
        let (head, tail) = line.split_once(": median")?;
        let (line_label, unit) = head.rsplit_once(" cpu ")?;
        let scale = match unit {
            "us" => 1.0,
            "ns" => 1e-3,
            _ => return None,
        };
        let median: f64 = tail.split_whitespace().next()?.parse().ok()?;
        (line_label.trim_end() == label && median.is_finite()).then_some(median * scale)
    })
}

// ---- building and running ----

/// Compiles the program if needed, runs it on the data, returns what it printed.
fn execute(source: &Path, build: &Build, settings: &Settings) -> Result<String, String> {
    let data = prepare_data(settings)?;
    let program = compile(source, build, settings)?;
    output(Command::new(&program).arg(&data), &program.display().to_string())
}

/// Compiles when the program is missing, older than its source, or was built by another command.
fn compile(source: &Path, build: &Build, settings: &Settings) -> Result<PathBuf, String> {
    let name = source.file_stem().unwrap_or(source.as_os_str());
    let program = settings.build.join(name);
    let record = program.with_extension("command");
    let command = format!("{} {} {}\n", build.compiler, source.display(), build.flags.join(" "));
    let same = fs::read_to_string(&record).is_ok_and(|earlier| earlier == command);
    if same && is_newer(&program, source) {
        return Ok(program);
    }
    // -w: Eigen and Boost print a thousand lines of warnings that are not ours to fix.
    let mut compiler = Command::new(build.compiler);
    compiler.args(["-O3", "-march=native", "-w"]).arg(source).args(&build.flags).arg("-o").arg(&program);
    output(&mut compiler, build.compiler)?;
    fs::write(&record, command).map_err(|e| format!("{}: cannot write: {e}", record.display()))?;
    Ok(program)
}

/// Standard output of a command that must succeed.
fn output(command: &mut Command, name: &str) -> Result<String, String> {
    let done = command.output().map_err(|e| format!("{name}: cannot start: {e}"))?;
    if done.status.success() {
        return Ok(String::from_utf8_lossy(&done.stdout).into_owned());
    }
    let stderr = String::from_utf8_lossy(&done.stderr);
    let line = stderr.lines().find(|l| l.contains("error")).or_else(|| stderr.lines().last()).unwrap_or_default();
    Err(format!("{name}: {}: {line}", done.status))
}

/// The folder with `human.xml`, `segments.txt` and `frames.txt`, filled from the scripts' `data/` where missing or
/// older.
fn prepare_data(settings: &Settings) -> Result<PathBuf, String> {
    let (from, to) = (settings.scripts.join("data"), settings.build.join("data"));
    fs::create_dir_all(&to).map_err(|e| format!("{}: cannot create: {e}", to.display()))?;
    for name in ["human.xml", "segments.txt"] {
        // Read and write, not copy: the source may be read-only, and the copy must be replaceable.
        let path = from.join(name);
        let text = fs::read(&path).map_err(|e| format!("{}: cannot read: {e}", path.display()))?;
        fs::write(to.join(name), text).map_err(|e| format!("{}: cannot write: {e}", to.join(name).display()))?;
    }
    let (npz, txt) = (from.join("frames.npz"), to.join("frames.txt"));
    if !is_newer(&txt, &npz) {
        let text = frames_text(&npz)?;
        fs::write(&txt, text).map_err(|e| format!("{}: cannot write: {e}", txt.display()))?;
    }
    Ok(to)
}

/// `frames.npz` as the C programs read it: frames and joints, joint names, then angles (rad), rates (rad/s) and
/// accelerations (rad/s^2) of one frame on each line. Every number reads back to the same bits.
fn frames_text(npz: &Path) -> Result<String, String> {
    let bytes = fs::read(npz).map_err(|e| format!("{}: cannot read: {e}", npz.display()))?;
    let arrays = Npz::read(&bytes).map_err(|e| format!("{}: {e}", npz.display()))?;
    let array = |name: &str| arrays.array(name).ok_or_else(|| format!("{}: no array `{name}`", npz.display()));
    let wrong = |name: &str, found: &str| format!("{}: array `{name}` {found}", npz.display());
    let names = array("names")?.texts().ok_or_else(|| wrong("names", "has no texts"))?;
    let frames = array("q")?.shape.first().copied().unwrap_or_default();
    let mut blocks = Vec::new();
    for name in ["q", "qd", "qdd"] {
        let block = array(name)?;
        if block.shape != [frames, names.len()] {
            let expected = [frames, names.len()];
            return Err(wrong(name, &format!("has shape {:?}, expected {expected:?}", block.shape)));
        }
        blocks.push(block.numbers().ok_or_else(|| wrong(name, "has no numbers"))?);
    }
    let mut text = format!("{frames} {}\n{}\n", names.len(), names.join(" "));
    for frame in 0..frames {
        let row = frame * names.len()..(frame + 1) * names.len();
        let numbers = blocks.iter().flat_map(|block| &block[row.clone()]);
        text.push_str(&numbers.map(|x| format!("{x:e}")).collect::<Vec<_>>().join(" "));
        text.push('\n');
    }
    Ok(text)
}

fn is_newer(made: &Path, source: &Path) -> bool {
    let time = |path: &Path| fs::metadata(path).and_then(|m| m.modified()).ok();
    matches!((time(made), time(source)), (Some(made), Some(source)) if made >= source)
}

// ---- finding what is installed; an Err is a hint for the reader ----

fn find_source(program: &Program, settings: &Settings) -> Result<PathBuf, String> {
    let source = settings.scripts.join(program.source);
    let missing = || format!("no {} in {}; pass --scripts DIR", program.source, settings.scripts.display());
    if source.is_file() { Ok(source) } else { Err(missing()) }
}

fn mujoco(settings: &Settings) -> Result<Build, String> {
    let folder = site_packages(settings, "mujoco")?.join("mujoco");
    let library = entry(&folder, |name| name.starts_with("libmujoco."));
    let library = library.ok_or_else(|| install_hint("mujoco"))?;
    let flags = vec![
        format!("-I{}", folder.join("include").display()),
        library.display().to_string(),
        format!("-Wl,-rpath,{}", folder.display()),
        "-lm".to_owned(),
    ];
    Ok(Build { compiler: compiler("gcc")?, flags })
}

fn pinocchio(settings: &Settings) -> Result<Build, String> {
    let prefix = site_packages(settings, "pin")?.join("cmeel.prefix");
    if !prefix.join("include/pinocchio").is_dir() {
        return Err(install_hint("pin"));
    }
    let eigen = EIGEN_FOLDERS.into_iter().find(|folder| Path::new(folder).is_dir());
    let eigen = eigen.ok_or("install Eigen (Debian: libeigen3-dev)")?;
    let mut flags = vec!["-std=c++17".to_owned()];
    flags.extend(PINOCCHIO_DEFINITIONS.map(str::to_owned));
    let library = prefix.join("lib");
    flags.extend([
        format!("-I{}", prefix.join("include").display()),
        format!("-I{eigen}"),
        format!("-L{}", library.display()),
        "-lpinocchio_default".to_owned(),
        format!("-Wl,-rpath,{}", library.display()),
    ]);
    Ok(Build { compiler: compiler("g++")?, flags })
}

/// Our own Newton-Euler loop in C++, a lower bound for any engine on this machine; it needs no peer.
fn floor_loop(_: &Settings) -> Result<Build, String> {
    Ok(Build { compiler: compiler("g++")?, flags: vec!["-ffast-math".to_owned(), "-std=c++17".to_owned()] })
}

fn compiler(name: &'static str) -> Result<&'static str, String> {
    let found = Command::new(name).arg("--version").output().is_ok();
    if found { Ok(name) } else { Err(format!("install {name}")) }
}

/// `<env>/<package>/lib/python3.*/site-packages`.
fn site_packages(settings: &Settings, package: &str) -> Result<PathBuf, String> {
    let Some(env) = &settings.env else {
        return Err(format!("{}, then pass --env DIR or set {ENV_VARIABLE}", install_hint(package)));
    };
    let python = entry(&env.join(package).join("lib"), |name| name.starts_with("python3"));
    python.map(|p| p.join("site-packages")).ok_or_else(|| install_hint(package))
}

fn install_hint(package: &str) -> String {
    format!("python3.11 -m venv DIR/{package} && DIR/{package}/bin/pip install {package} numpy")
}

/// `MuJoCo 4.0.0`: the version is in the name of pip's record folder, `mujoco-4.0.0.dist-info`.
fn versioned_name(program: &Program, settings: &Settings) -> String {
    let version = program.package.and_then(|package| {
        let folder = site_packages(settings, package).ok()?;
        let is_record = |name: &str| name.starts_with(&format!("{package}-")) && name.ends_with(".dist-info");
        let record = entry(&folder, is_record)?.file_stem()?.to_string_lossy().into_owned();
        record.strip_prefix(package)?.strip_prefix('-').map(str::to_owned)
    });
    version.map_or_else(|| program.peer.to_owned(), |version| format!("{} {version}", program.peer))
}

/// First entry of `folder`, by name, that matches.
fn entry(folder: &Path, fits: impl Fn(&str) -> bool) -> Option<PathBuf> {
    let names = fs::read_dir(folder).ok()?.flatten().filter(|e| fits(&e.file_name().to_string_lossy()));
    names.map(|e| e.path()).min()
}

#[cfg(test)]
mod tests {
    use super::*;

    const PRINTED: &str = "\
C mj_inverse                                         cpu us: median     4.778  p10     4.703  p90     4.839  min     4.679
Newton-Euler, one frame at a time            cpu ns: median    831.73  p10    817.25  p90    844.36  min    810.51
nv 37 joints 33 checksum 793809341
";

    fn nowhere() -> Settings {
        let folder = std::env::temp_dir().join(format!("xtask-peers-{}-absent", std::process::id()));
        Settings { env: None, scripts: folder.clone(), build: folder }
    }

    #[test]
    fn medians_are_read_in_microseconds() {
        assert_eq!(median_us(PRINTED, "C mj_inverse"), Some(4.778));
        let floor = median_us(PRINTED, "Newton-Euler, one frame at a time").unwrap();
        assert!((floor - 0.83173).abs() < 1e-12, "{floor}");
    }

    #[test]
    fn a_line_that_is_not_there_or_begins_alike_is_a_failure() {
        for label in ["C mj_rne", "C mj_inv", ""] {
            assert!(matches!(outcome(PRINTED, label), Outcome::Failed { .. }), "{label}");
        }
    }

    #[test]
    fn peers_that_are_not_installed_are_rows_with_a_hint() {
        let timings = measure(&nowhere());
        assert_eq!(timings.len(), 8);
        for timing in &timings {
            assert!(matches!(&timing.outcome, Outcome::NotInstalled { hint } if hint.contains("--scripts")));
            assert_eq!(timing.median_us(), None);
        }
        assert!(table(&timings).contains("MuJoCo mj_inverse"));
        assert!(mujoco(&nowhere()).err().unwrap().contains("bin/pip install mujoco numpy"));
    }

    #[test]
    fn the_fastest_peer_is_an_engine_that_ran() {
        let row = |name: &str, task, outcome| PeerTiming { name: name.to_owned(), task, outcome };
        let ran = |median_us| Outcome::Measured { median_us };
        let mut timings = vec![row("floor", Task::Floor, ran(0.5)), row("aba", Task::Forward, ran(1.0))];
        timings.push(row("broken", Task::Inverse, Outcome::Failed { reason: String::new() }));
        assert_eq!(fastest(&timings), None);
        timings.extend([row("slow", Task::Inverse, ran(9.0)), row("quick", Task::Inverse, ran(3.0))]);
        assert_eq!(fastest(&timings), Some(("quick", 3.0)));
    }

    #[test]
    fn wrong_arguments_are_named() {
        let args = |words: &[&str]| words.iter().map(|&w| w.to_owned()).collect::<Vec<_>>();
        assert_eq!(parse(&args(&["--env", "here"])).unwrap().env, Some(PathBuf::from("here")));
        assert_eq!(parse(&args(&["--scripts"])).unwrap_err(), "--scripts needs a folder");
        assert!(parse(&args(&["--fast"])).unwrap_err().starts_with("unknown option `--fast`"));
    }
}
