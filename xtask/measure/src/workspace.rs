//! Finds the workspace, the recordings next to it and the `ambulo` command; writes results into the workspace.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Folder that holds `data` and `reference`, where it is not [`DATA`].
const DATA_VARIABLE: &str = "AMBULO_DATA";
/// The same, relative to the workspace root.
const DATA: &str = "../shared";
/// Folder of the peers' virtual environments, when `--env` is not given.
const PEERS_VARIABLE: &str = "AMBULO_PEERS_ENV";
/// Programs that run the peers, relative to the workspace root.
const PEERS: &str = "xtask/measure/peers";
/// Folder of the recording that is timed and drawn: model, motion, forces, and the bodies on which they act.
const WALK: &str = "data/opensim-gait2392-subject01";

/// The folder of the workspace's `Cargo.toml`.
pub(crate) fn root() -> PathBuf {
    let above = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2);
    above.map(Path::to_path_buf).unwrap_or_default()
}

/// The folder that holds `data` and `reference`.
pub(crate) fn data() -> PathBuf {
    std::env::var_os(DATA_VARIABLE).map_or_else(|| root().join(DATA), PathBuf::from)
}

/// Folder of the peers' virtual environments, if no other is given.
pub(crate) fn peers_env() -> Option<PathBuf> {
    std::env::var_os(PEERS_VARIABLE).map(PathBuf::from)
}

/// Python of a peer's environment, about to run one of our programs.
pub(crate) fn peer_program(env: Option<&Path>, package: &str, script: &str) -> Result<Command, String> {
    let hint = format!("hint: pass --env DIR or set {PEERS_VARIABLE}; {PEERS}/README.md says how to make one");
    let env = env.ok_or_else(|| format!("no folder of environments\n{hint}"))?;
    let python = env.join(package).join("bin/python");
    if !python.is_file() {
        return Err(format!("{}: missing\n{hint}", python.display()));
    }
    let mut command = Command::new(python);
    command.arg(root().join(PEERS).join(script));
    Ok(command)
}

/// The commit that runs, if git knows it.
pub(crate) fn commit() -> String {
    let mut git = Command::new("git");
    git.current_dir(root()).args(["rev-parse", "--short=12", "HEAD"]);
    let output = git.output().ok().filter(|output| output.status.success());
    output.map_or_else(|| "unknown".to_owned(), |output| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

/// Whether the words of a command that has only the option `--write` contain it.
pub(crate) fn write_option(words: &[String]) -> Result<bool, String> {
    match words.iter().find(|word| *word != "--write") {
        Some(word) => Err(format!("unknown option `{word}`, expected --write")),
        None => Ok(!words.is_empty()),
    }
}

/// Writes a file of the workspace, with its folder, and reports it.
#[expect(clippy::print_stderr, reason = "the page itself goes to standard output")]
pub(crate) fn save(name: &str, text: &str) -> Result<(), String> {
    let path = root().join(name);
    let folder = path.parent().unwrap_or(&path);
    fs::create_dir_all(folder).map_err(|e| format!("{}: cannot make this folder: {e}", folder.display()))?;
    fs::write(&path, text).map_err(|e| format!("{}: cannot write: {e}", path.display()))?;
    eprintln!("written: {name}");
    Ok(())
}

/// The same cargo that runs this program, in the workspace root.
pub(crate) fn cargo() -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(root());
    command
}

/// Files of the recording that is timed and drawn.
#[derive(Debug, Clone)]
pub(crate) struct Walk {
    pub(crate) model: PathBuf,
    pub(crate) motion: PathBuf,
    pub(crate) forces: PathBuf,
    pub(crate) loads: PathBuf,
}

impl Walk {
    /// The recording, if it is there.
    pub(crate) fn find() -> Option<Walk> {
        let file = |name: &str| data().join(WALK).join(name);
        let walk = Walk {
            model: file("subject01_simbody.osim"),
            motion: file("subject01_walk1_ik.mot"),
            forces: file("subject01_walk1_grf.mot"),
            loads: file("subject01_walk1_grf.xml"),
        };
        [&walk.model, &walk.motion, &walk.forces, &walk.loads].iter().all(|path| path.is_file()).then_some(walk)
    }

    /// `ambulo forces` on this recording, with OpenSim's usual 6 Hz and the forces as measured.
    pub(crate) fn command(&self, program: &Path, output: &Path) -> Command {
        let mut command = Command::new(program);
        command.arg("forces").arg(&self.motion).arg("--model").arg(&self.model);
        command.args(["--cutoff", "6", "--force-cutoff", "off"]);
        command.arg("--grf").arg(&self.forces).arg("--loads").arg(&self.loads).arg("-o").arg(output);
        command
    }
}

/// The folder that cargo builds into: this program is in `<target>/<profile>`.
pub(crate) fn target() -> PathBuf {
    let here = std::env::current_exe().unwrap_or_default();
    here.parent().and_then(Path::parent).map_or_else(|| root().join("target"), Path::to_path_buf)
}

/// Builds the `ambulo` command with the optimisation of benchmarks and returns its path.
pub(crate) fn build_program() -> Result<PathBuf, String> {
    let mut build = cargo();
    build.args(["build", "--quiet", "--profile", "measure", "--locked", "--package", "ambulo-cli"]);
    let status = build.status().map_err(|e| format!("cargo: cannot start: {e}"))?;
    if !status.success() {
        return Err(format!("ambulo-cli did not build ({status}), see above"));
    }
    let program = target().join("measure").join(format!("ambulo{}", std::env::consts::EXE_SUFFIX));
    if program.is_file() { Ok(program) } else { Err(format!("{}: missing after the build", program.display())) }
}

/// Outcomes that a command has recorded in a JSON file, relative to the workspace root.
pub(crate) fn recorded(path: &str) -> Result<serde_json::Value, String> {
    let path = root().join(path);
    let text = fs::read_to_string(&path).map_err(|e| format!("{}: cannot read: {e}", path.display()))?;
    serde_json::from_str(&text).map_err(|e| format!("{}: {e}", path.display()))
}
