//! The recipes of docs/clusters on this machine, each with a worker or job that is killed in the middle: `cargo xtask clusters [RECIPE]..`.
//!
//! | recipe | what is killed by SIGKILL | how it continues |
//! |---|---|---|
//! | `dask`, `ray` | a worker while its task runs | the engine repeats the task |
//! | `snakemake` | the command of a job | `retries` of the rule |
//! | `slurm` | the command of a task of the array | the same line again; a stand-in sets the variables of Slurm, which is not needed |
//!
//! Then all trials must be there, with the bytes of a run that nothing disturbed. The command is the one that `cargo build` has compiled. The engines are installed from PyPI, in the
//! versions of [`ENGINES`], into a virtual environment in `target`. Linux only: workers are found in `/proc`.

use crate::python::Environment;
use crate::workspace;
use std::collections::BTreeMap;
use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// The engines.
const ENGINES: [&str; 3] = ["dask[distributed]==2026.8.0", "ray==2.60.0", "snakemake==9.27.1"];
const RECIPES: [&str; 4] = ["dask", "ray", "snakemake", "slurm"];
/// Shards of a run, two at a time.
const SHARDS: usize = 4;
/// Trials of the set.
const TRIALS: usize = 48;
/// Time of the first kill after a command has started; a shard takes longer.
const BEFORE_KILL: Duration = Duration::from_millis(700);
/// No run takes longer.
const LONGEST: Duration = Duration::from_secs(600);

/// A set of recordings and the command.
struct Bench {
    program: PathBuf,
    environment: Environment,
    folder: PathBuf,
    /// The results without a disturbance.
    whole: BTreeMap<PathBuf, Vec<u8>>,
}

/// Tests the recipes.
#[expect(clippy::print_stdout, reason = "the outcomes are the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let known = |word: &&String| RECIPES.contains(&word.as_str());
    if let Some(unknown) = words.iter().find(|word| !known(word)) {
        return Err(format!("found `{unknown}`; expected some of {}", RECIPES.join(", ")));
    }
    let bench = Bench::new()?;
    for recipe in RECIPES.into_iter().filter(|recipe| words.is_empty() || words.iter().any(|word| word == recipe)) {
        println!("{recipe:10} {}", bench.test(recipe)?);
    }
    Ok(())
}

impl Bench {
    fn new() -> Result<Bench, String> {
        let program = workspace::debug_program();
        if !program.is_file() {
            return Err(format!("{}: there is no such file\nhint: `cargo build` compiles it", program.display()));
        }
        let folder = workspace::target().join("clusters");
        let _ = fs::remove_dir_all(folder.join("runs"));
        let environment = Environment::new(crate::python::interpreter(), &folder.join("environment"))?;
        environment.install(&ENGINES)?;
        let folder = folder.join("runs");
        fs::create_dir_all(&folder).map_err(|e| format!("{}: cannot be created: {e}", folder.display()))?;
        let mut bench = Bench { program, environment, folder, whole: BTreeMap::new() };
        bench.fill()?;
        // The same shards, one after the other: the names of the files have the numbers of the shards.
        for index in 0..SHARDS {
            let shard = format!("{index}/{SHARDS}");
            let words = ["batch", "set", "-o", "whole", "--quiet", "--shard", &shard];
            let mut command = bench.command("ambulo", &words);
            ended(command.status().map_err(|e| format!("ambulo: cannot start: {e}"))?, "ambulo batch")?;
        }
        bench.whole = crate::batch_cost::files_in(&bench.folder.join("whole"))?;
        Ok(bench)
    }

    /// A folder with copies of a synthetic walk.
    fn fill(&self) -> Result<(), String> {
        let mut demo = self.command("ambulo", &["demo", "-o", "demo", "--quiet", "--keep", "recording"]);
        ended(demo.status().map_err(|e| format!("ambulo: cannot start: {e}"))?, "ambulo demo")?;
        for trial in 0..TRIALS {
            let own = self.folder.join(format!("set/{trial:04}"));
            let cannot = |e: std::io::Error| format!("{}: cannot be filled: {e}", own.display());
            fs::create_dir_all(&own).map_err(cannot)?;
            for name in ["figure.osim", "walk.mot"] {
                fs::hard_link(self.folder.join("demo/input").join(name), own.join(name)).map_err(cannot)?;
            }
        }
        Ok(())
    }

    /// A program in the folder of the runs, with our command and the engines on its path.
    fn command(&self, program: &str, words: &[&str]) -> Command {
        let own = [self.program.parent(), self.environment.programs()].into_iter().flatten().map(Path::to_owned);
        let others = env::var_os("PATH").unwrap_or_default();
        let path = env::join_paths(own.chain(env::split_paths(&others))).unwrap_or(others);
        let mut command = Command::new(self.found(program));
        command.args(words).current_dir(&self.folder).env("PATH", path);
        command.stdout(Stdio::null()).stderr(Stdio::null());
        command
    }

    fn found(&self, program: &str) -> OsString {
        match program {
            "ambulo" => self.program.clone().into_os_string(),
            "bash" => OsString::from(program),
            _ => self.environment.programs().map_or_else(|| program.into(), |folder| folder.join(program).into()),
        }
    }

    /// Runs a recipe with a kill; returns what happened.
    fn test(&self, recipe: &str) -> Result<String, String> {
        let place = workspace::root().join("docs/clusters");
        let file = |name: &str| place.join(name).display().to_string();
        let shards = SHARDS.to_string();
        let (dask, ray, rules, script) =
            (file("dask_batch.py"), file("ray_batch.py"), file("Snakefile"), file("slurm.sh"));
        let killed = match recipe {
            "dask" => self.worker(self.command("python", &[&dask, "set", "dask", &shards]), recipe)?,
            "ray" => self.worker(self.command("python", &[&ray, "set", "ray", &shards]), recipe)?,
            "snakemake" => {
                let sizes = format!("shards={SHARDS}");
                let words =
                    ["--snakefile", &rules, "--cores", "2", "--config", "source=set", "results=snakemake", &sizes];
                self.job(self.command("snakemake", &words), recipe)?
            }
            _ => self.array(&script)?,
        };
        let found = crate::batch_cost::files_in(&self.folder.join(recipe))?;
        if found != self.whole {
            let names = |files: &BTreeMap<PathBuf, Vec<u8>>| files.len();
            return Err(format!(
                "{recipe}: the tables differ from those of an undisturbed run ({} files, expected {})",
                names(&found),
                names(&self.whole)
            ));
        }
        Ok(format!("{killed}; {TRIALS} trials in {SHARDS} shards, the bytes of an undisturbed run"))
    }

    /// An engine whose worker, the parent of a command, is killed once.
    fn worker(&self, command: Command, results: &str) -> Result<String, String> {
        let mut engine = Running::start(command)?;
        let victim = engine.victim(results)?;
        let worker = parent(victim).filter(|worker| descends(*worker, engine.0.id()));
        let worker = worker.ok_or("the command of a task has no worker that this run has started")?;
        kill(worker)?;
        engine.end(results)?;
        Ok(format!("worker {worker} killed"))
    }

    /// An engine one of whose jobs is killed once.
    fn job(&self, command: Command, results: &str) -> Result<String, String> {
        let mut engine = Running::start(command)?;
        let victim = engine.victim(results)?;
        kill(victim)?;
        engine.end(results)?;
        Ok(format!("job {victim} killed"))
    }

    /// The tasks of a job array, one after the other; the second is killed, and the array is submitted again.
    fn array(&self, script: &str) -> Result<String, String> {
        let task = |index: usize| {
            let mut task = self.command("bash", &[script, "set", "slurm"]);
            task.env("SLURM_JOB_ID", "1").env("SLURM_ARRAY_TASK_ID", index.to_string());
            task.env("SLURM_ARRAY_TASK_COUNT", SHARDS.to_string());
            task
        };
        let mut second = Running::start(task(1))?;
        let victim = second.victim("slurm")?;
        kill(victim)?;
        let _ = second.0.wait();
        for index in 0..SHARDS {
            Running::start(task(index))?.end("slurm")?;
        }
        Ok(format!("task {victim} killed"))
    }
}

/// A program that was started here; it is ended with this value.
struct Running(Child);

impl Running {
    fn start(mut command: Command) -> Result<Running, String> {
        let name = command.get_program().to_string_lossy().into_owned();
        command.spawn().map(Running).map_err(|e| format!("{name}: cannot start: {e}"))
    }

    /// A command that has been computing into this folder for a while.
    fn victim(&mut self, results: &str) -> Result<u32, String> {
        let begun = Instant::now();
        while begun.elapsed() < LONGEST {
            if let Some(found) = commands_into(results).first().copied() {
                sleep(BEFORE_KILL);
                if commands_into(results).contains(&found) {
                    return Ok(found);
                }
            }
            if self.0.try_wait().is_ok_and(|status| status.is_some()) {
                break;
            }
            sleep(Duration::from_millis(20));
        }
        Err(format!("{results}: no command ran longer than {} ms; nothing could be killed", BEFORE_KILL.as_millis()))
    }

    fn end(&mut self, what: &str) -> Result<(), String> {
        let begun = Instant::now();
        while begun.elapsed() < LONGEST {
            match self.0.try_wait().map_err(|e| format!("{what}: {e}"))? {
                Some(status) => return ended(status, what),
                None => sleep(Duration::from_millis(100)),
            }
        }
        Err(format!("{what}: did not end within {} s", LONGEST.as_secs()))
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        if self.0.try_wait().is_ok_and(|status| status.is_none()) {
            let _ = self.0.kill();
            let _ = self.0.wait();
        }
    }
}

fn ended(status: ExitStatus, what: &str) -> Result<(), String> {
    if status.success() { Ok(()) } else { Err(format!("{what} ended with {status}")) }
}

/// Processes of our command whose results go to this folder.
fn commands_into(results: &str) -> Vec<u32> {
    let Ok(entries) = fs::read_dir("/proc") else { return Vec::new() };
    let numbers = entries.filter_map(|entry| entry.ok()?.file_name().to_str()?.parse().ok());
    let is_ours = |id: &u32| {
        let words = fs::read(format!("/proc/{id}/cmdline")).unwrap_or_default();
        let words: Vec<&[u8]> = words.split(|byte| *byte == 0).collect();
        words.first().is_some_and(|program| program.ends_with(b"ambulo"))
            && words.windows(2).any(|pair| pair[0] == b"-o" && pair[1] == results.as_bytes())
    };
    numbers.filter(is_ours).collect()
}

/// The parent of a process: field 4 of `/proc/ID/stat` (`man proc_pid_stat`).
fn parent(id: u32) -> Option<u32> {
    let text = fs::read_to_string(format!("/proc/{id}/stat")).ok()?;
    text.rsplit_once(')')?.1.split_whitespace().nth(1)?.parse().ok()
}

/// Whether a process was started by another one, or by one of those that it started.
fn descends(id: u32, from: u32) -> bool {
    std::iter::successors(Some(id), |id| parent(*id)).skip(1).any(|ancestor| ancestor == from)
}

fn kill(id: u32) -> Result<(), String> {
    let status = Command::new("kill").args(["-KILL", &id.to_string()]).status().map_err(|e| format!("kill: {e}"))?;
    ended(status, "kill")
}
