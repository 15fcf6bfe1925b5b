//! The Python package: `cargo xtask python`, with `--profile NAME`, `--with PROGRAM`, `--measure` or `--free-threaded`.
//!
//! Without an option it makes a wheel from the module that `cargo test` has compiled, installs it into a bare virtual
//! environment, checks that it needs nothing but NumPy, and runs the tests of `crates/ambulo-py/tests` and stubtest;
//! with `--with` in the environment of another Python. `--measure` builds the wheel for users with maturin, compresses
//! it again as a release does, and prints its size and its times. `--free-threaded` compiles the module for
//! free-threaded Python, which need not be installed.

use crate::workspace;
use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The version of maturin that builds the wheel for users.
const MATURIN: &str = "maturin==1.16.0";
/// What PyO3 has to know about free-threaded Python. The oldest one that it supports is 3.14.
const FREE_THREADED: &str =
    "implementation=CPython\nversion=3.14\nshared=true\npointer_width=64\nbuild_flags=Py_GIL_DISABLED\n";
/// Prints the commands of the package and the packages that are installed, in an environment without anything else.
const BARE: &str = "import ambulo, importlib.metadata as m; names = sorted({d.name for d in m.distributions()} - \
    {'pip', 'setuptools'}); assert names == ['ambulo', 'numpy'], names; print(ambulo.__version__, 'installed with', \
    names)";

pub(crate) fn run(words: &[String]) -> Result<(), String> {
    match words {
        [] => test(interpreter(), "debug"),
        [option, profile] if option == "--profile" => test(interpreter(), profile),
        [option, program] if option == "--with" => test(program, "debug"),
        [option] if option == "--measure" => measure(),
        [option] if option == "--free-threaded" => free_threaded(),
        _ => {
            Err("usage: cargo xtask python [--profile NAME | --with PROGRAM | --measure | --free-threaded]".to_owned())
        }
    }
}

/// The program that makes virtual environments.
pub(crate) fn interpreter() -> &'static str {
    if cfg!(windows) { "python" } else { "python3" }
}

/// Tests the package in an environment of this Python, with the module in this folder of cargo's profiles.
fn test(program: &str, profile: &str) -> Result<(), String> {
    let module = workspace::target().join(profile).join("deps").join(format!("{DLL_PREFIX}_ambulo{DLL_SUFFIX}"));
    if !module.is_file() {
        return Err(format!(
            "{}: there is no such file; expected the compiled module\nhint: `cargo test --package ambulo-py --no-run` \
             compiles it",
            module.display()
        ));
    }
    let (folder, package) = (workspace::target().join("python"), package());
    let made = Command::new(interpreter())
        .arg(package.join("tests/wheel.py"))
        .arg(&module)
        .arg(folder.join("wheels"))
        .output();
    let made = made.map_err(|e| format!("{}: cannot start: {e}", interpreter()))?;
    if !made.status.success() {
        return Err(format!("the wheel was not made: {}", String::from_utf8_lossy(&made.stderr)));
    }
    let wheel = String::from_utf8_lossy(&made.stdout).trim().to_owned();
    let environment = Environment::new(program, &folder.join("environment"))?;
    environment.install(&[&wheel])?;
    environment.python(&package, &["-c", BARE])?;
    environment.install(&["--requirement", &package.join("tests/requirements.txt").display().to_string()])?;
    environment.python(&package, &["-m", "pytest", "-q", "-p", "no:cacheprovider", "--durations=5"])?;
    let stubtest = ["-m", "mypy.stubtest", "ambulo", "--mypy-config-file", "pyproject.toml"];
    environment.python(&package, &[&stubtest[..], &["--allowlist", "tests/stubtest_allowlist.txt"]].concat())
}

fn measure() -> Result<(), String> {
    let (folder, package) = (workspace::target().join("python"), package());
    let environment = Environment::new(interpreter(), &folder.join("environment"))?;
    environment.install(&[MATURIN])?;
    let wheels = folder.join("dist");
    // An older wheel would be measured instead.
    if wheels.is_dir() {
        fs::remove_dir_all(&wheels).map_err(|e| format!("{}: {e}", wheels.display()))?;
    }
    let folder = wheels.display().to_string();
    let build = ["-m", "maturin", "build", "--locked", "--out", &folder, "--compression-level", "9"];
    // The map of the linker has the size of every function. Other systems have other linkers.
    let map = workspace::target().join("python/module.map").display().to_string();
    let linked = format!("link-arg=-Wl,-Map={map}");
    let with_map = if cfg!(target_os = "linux") { vec!["--", "-C", &linked] } else { Vec::new() };
    environment.python(&package, &[&build[..], &with_map].concat())?;
    let found = fs::read_dir(&wheels).ok().and_then(|mut files| files.next()?.ok());
    let wheel = found.ok_or_else(|| format!("{}: maturin has made no wheel", wheels.display()))?.path();
    let wheel = wheel.display().to_string();
    let [smaller, sizes, versions] = ["smallest_wheel.py", "module_sizes.py", "requirements.txt"].map(packaging);
    environment.install(&["--constraint", &versions, "zopfli"])?;
    environment.python(&package, &[&smaller, &wheel])?;
    if cfg!(target_os = "linux") {
        environment.python(&package, &[&sizes, &wheel, &map])?;
    }
    environment.install(&["--force-reinstall", "--no-deps", &wheel])?;
    environment.install(&["numpy"])?;
    environment.python(&package, &["bench/measure.py", &wheel])
}

/// Compiles the module for free-threaded Python; it is not run. PyO3 reads what it needs to know from a file, so that
/// no such Python is needed.
fn free_threaded() -> Result<(), String> {
    let folder = workspace::target().join("free-threaded");
    fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let configuration = folder.join("pyo3.txt");
    fs::write(&configuration, FREE_THREADED).map_err(|e| format!("{}: {e}", configuration.display()))?;
    let mut cargo = workspace::cargo();
    // A folder of its own: the module has the same name as the one that the tests use.
    cargo.env("CARGO_TARGET_DIR", &folder).env("PYO3_CONFIG_FILE", &configuration);
    cargo.args(["build", "--locked", "--package", "ambulo-py", "--lib", "--no-default-features"]);
    run_or(&mut cargo, "the module was not compiled")
}

/// The folder of the package.
fn package() -> PathBuf {
    workspace::root().join("crates/ambulo-py")
}

/// A file of the release.
fn packaging(name: &str) -> String {
    workspace::root().join("packaging").join(name).display().to_string()
}

/// A virtual environment.
struct Environment {
    python: PathBuf,
}

impl Environment {
    /// Makes an empty one; an earlier one in the folder is replaced.
    fn new(program: &str, folder: &Path) -> Result<Environment, String> {
        let mut venv = Command::new(program);
        run_or(venv.args(["-m", "venv", "--clear"]).arg(folder), "a virtual environment was not made")?;
        let python = if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" };
        Ok(Environment { python: folder.join(python) })
    }

    fn install(&self, what: &[&str]) -> Result<(), String> {
        let mut pip = Command::new(&self.python);
        pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]).args(what);
        run_or(&mut pip, "pip has failed")
    }

    fn python(&self, folder: &Path, words: &[&str]) -> Result<(), String> {
        let mut python = Command::new(&self.python);
        run_or(python.current_dir(folder).args(words), "see above")
    }
}

fn run_or(command: &mut Command, otherwise: &str) -> Result<(), String> {
    let program = command.get_program().to_string_lossy().into_owned();
    // The folder of the sources is no place for compiled Python.
    let status =
        command.env("PYTHONDONTWRITEBYTECODE", "1").status().map_err(|e| format!("{program}: cannot start: {e}"))?;
    if status.success() {
        return Ok(());
    }
    let words: Vec<_> = command.get_args().map(|word| word.to_string_lossy().into_owned()).collect();
    Err(format!("{program} {} ({status}): {otherwise}", words.join(" ")))
}
