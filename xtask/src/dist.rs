//! Archives of the `ambulo` command for users: `cargo xtask dist [--target TARGET].. [--runner PROGRAM] [--tag TAG]`,
//! and crates for the registry of Rust: `cargo xtask dist --crates`.
//!
//! Builds the command in the profile `dist`, packs it with its licences and the list of its components
//! (`packaging/archive.py`) into `target/archives`, and tries the archive (`packaging/trial.py`) if this machine can
//! run it. Python packs: its standard library has archives, hashes and JSON, so this program needs no dependency for
//! them.
//!
//! `--crates` packs every crate that is to be published and builds each from its own archive, in the order in which
//! they need each other. Nothing is uploaded.

use crate::python::interpreter;
use crate::workspace;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const USAGE: &str = "usage: cargo xtask dist [--target TARGET].. [--runner PROGRAM] [--tag TAG], or --crates";

/// Members of the workspace that are not published: the Python module is a wheel, the automation is for contributors.
const UNPUBLISHED: [&str; 3] = ["ambulo-py", "xtask", "xtask-measure"];
/// Largest archive that the registry takes [bytes].
const LARGEST_CRATE: u64 = 10 << 20;

/// A machine that archives are made for.
struct Target {
    /// The compiler's name of it, which is in the name of the archive.
    triple: &'static str,
    linker: Linker,
}

/// What links the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Linker {
    /// The one that the compiler takes by itself.
    Own,
    /// Zig, through `cargo zigbuild`: for other processors, and for a C library as old as the version states.
    Zig { glibc: Option<&'static str> },
}

/// The oldest C library that the programs for it run on, that of manylinux2014 (CentOS 7).
const GLIBC: &str = "2.17";

const TARGETS: [Target; 7] = [
    Target { triple: "x86_64-unknown-linux-gnu", linker: Linker::Zig { glibc: Some(GLIBC) } },
    Target { triple: "aarch64-unknown-linux-gnu", linker: Linker::Zig { glibc: Some(GLIBC) } },
    Target { triple: "x86_64-unknown-linux-musl", linker: Linker::Own },
    Target { triple: "aarch64-unknown-linux-musl", linker: Linker::Zig { glibc: None } },
    Target { triple: "x86_64-apple-darwin", linker: Linker::Own },
    Target { triple: "aarch64-apple-darwin", linker: Linker::Own },
    Target { triple: "x86_64-pc-windows-gnu", linker: Linker::Own },
];

/// What the command line asks for.
#[derive(Debug, Default, PartialEq, Eq)]
struct Request {
    targets: Vec<String>,
    /// Starts programs of another machine.
    runner: Option<String>,
    /// The tag of a release, compared with the version.
    tag: Option<String>,
}

pub(crate) fn run(words: &[String]) -> Result<(), String> {
    if words == ["--crates"] {
        return crates();
    }
    let mut request = request(words)?;
    if let Some(tag) = &request.tag {
        let changes = fs::read_to_string(workspace::root().join("CHANGELOG.md")).map_err(|e| e.to_string())?;
        check_tag(tag, env!("CARGO_PKG_VERSION"), &changes)?;
    }
    if request.targets.is_empty() {
        request.targets.push(usual_target()?.to_owned());
    }
    // All names are known before the first build, which takes minutes.
    let targets = request.targets.iter().map(|name| target(name)).collect::<Result<Vec<_>, _>>()?;
    targets.into_iter().try_for_each(|target| release(target, request.runner.as_deref()))
}

fn request(words: &[String]) -> Result<Request, String> {
    let mut request = Request::default();
    for pair in words.chunks(2) {
        match pair {
            [option, value] if option == "--target" => request.targets.push(value.clone()),
            [option, value] if option == "--runner" => request.runner = Some(value.clone()),
            [option, value] if option == "--tag" => request.tag = Some(value.clone()),
            _ => return Err(USAGE.to_owned()),
        }
    }
    Ok(request)
}

/// An error if a tag is not that of the version, or if the list of changes has no heading for it.
fn check_tag(tag: &str, version: &str, changes: &str) -> Result<(), String> {
    if tag != format!("v{version}") {
        return Err(format!(
            "the tag is `{tag}`; expected `v{version}`, the version in Cargo.toml\nhint: tag the commit that sets the \
             version"
        ));
    }
    let heading = format!("## {version}");
    if changes.lines().any(|line| line == heading || line.starts_with(&format!("{heading} "))) {
        return Ok(());
    }
    Err(format!("CHANGELOG.md has no heading `{heading}`\nhint: add it in the commit that sets the version"))
}

fn target(name: &str) -> Result<&'static Target, String> {
    TARGETS.iter().find(|target| target.triple == name).ok_or_else(|| {
        let known: Vec<_> = TARGETS.iter().map(|target| target.triple).collect();
        format!("archives are not made for the target `{name}`; known: {}", known.join(", "))
    })
}

/// The archive that runs on the most machines like this one: static on Linux.
fn usual_target() -> Result<&'static str, String> {
    let (processor, system) = (std::env::consts::ARCH, std::env::consts::OS);
    let target = TARGETS.iter().find(|target| match system {
        "linux" => target.triple == format!("{processor}-unknown-linux-musl"),
        "macos" => target.triple == format!("{processor}-apple-darwin"),
        "windows" => target.triple == format!("{processor}-pc-windows-gnu"),
        _ => false,
    });
    target.map(|target| target.triple).ok_or_else(|| format!("no archive is made for {system} on {processor}\n{USAGE}"))
}

/// Packs all crates, builds each from its archive, and compares their sizes with what the registry takes.
#[expect(clippy::print_stdout, reason = "the sizes are the command's result")]
fn crates() -> Result<(), String> {
    let left_out = UNPUBLISHED.iter().flat_map(|name| ["--exclude", name]);
    finish(workspace::cargo().args(["package", "--workspace", "--locked"]).args(left_out))?;
    let folder = workspace::target().join("package");
    let entries = fs::read_dir(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let ending = format!("-{}.crate", env!("CARGO_PKG_VERSION"));
    let mut packed: Vec<(String, u64)> = Vec::new();
    for entry in entries {
        let entry = entry.map_err(|e| e.to_string())?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if name.ends_with(&ending) {
            packed.push((name, entry.metadata().map_err(|e| e.to_string())?.len()));
        }
    }
    packed.sort();
    packed.iter().for_each(|(name, bytes)| println!("{name}: {:.2} MB", *bytes as f64 / 1e6));
    match packed.iter().find(|(_, bytes)| *bytes > LARGEST_CRATE) {
        Some((name, bytes)) => Err(format!("{name} has {bytes} bytes; the registry takes {LARGEST_CRATE} at most")),
        None => Ok(()),
    }
}

/// Builds, packs and tries one archive.
#[expect(clippy::print_stdout, reason = "what was not tried is part of the command's result")]
fn release(target: &Target, runner: Option<&str>) -> Result<(), String> {
    let program = build(target)?;
    let folder = workspace::target().join("archives");
    finish(python("archive.py").arg(target.triple).arg(&program).arg(&folder))?;
    let archive = folder.join(target.archive(env!("CARGO_PKG_VERSION")));
    if runner.is_none() && !target.runs_here() {
        println!("{}: not run, this machine is another one (--runner PROGRAM starts it)", target.triple);
        return Ok(());
    }
    finish(python("trial.py").arg(&archive).args(runner))
}

/// Builds the command; returns the path of the program.
fn build(target: &Target) -> Result<PathBuf, String> {
    let mut command = workspace::cargo();
    let name = match target.linker {
        Linker::Own => target.triple.to_owned(),
        Linker::Zig { glibc: None } => target.triple.to_owned(),
        Linker::Zig { glibc: Some(version) } => format!("{}.{version}", target.triple),
    };
    command.arg(if target.linker == Linker::Own { "build" } else { "zigbuild" });
    command.args(["--locked", "--package", "ambulo-cli", "--bin", "ambulo", "--profile", "dist", "--target", &name]);
    finish(&mut command).map_err(|error| match target.linker {
        Linker::Own => format!("{error}\nhint: `rustup target add {}` installs the target", target.triple),
        Linker::Zig { .. } => format!(
            "{error}\nhint: `rustup target add {}` installs the target, `pip install -r packaging/requirements.txt` \
             the linker",
            target.triple
        ),
    })?;
    let extension = if target.is_windows() { ".exe" } else { "" };
    Ok(workspace::target().join(target.triple).join("dist").join(format!("ambulo{extension}")))
}

impl Target {
    fn is_windows(&self) -> bool {
        self.triple.contains("windows")
    }

    /// File name of the archive.
    fn archive(&self, version: &str) -> String {
        format!("ambulo-{version}-{}.{}", self.triple, if self.is_windows() { "zip" } else { "tar.gz" })
    }

    /// Whether this machine runs its programs by itself.
    fn runs_here(&self) -> bool {
        let system = match std::env::consts::OS {
            "macos" => "darwin",
            other => other,
        };
        self.triple.starts_with(std::env::consts::ARCH) && self.triple.contains(system)
    }
}

/// Python with a script of `packaging/`.
fn python(script: &str) -> Command {
    let path: PathBuf = workspace::root().join("packaging").join(script);
    let mut command = Command::new(interpreter());
    command.arg(path);
    command
}

fn finish(command: &mut Command) -> Result<(), String> {
    let name = |command: &Command| {
        let first = command.get_args().next().map(|word| Path::new(word).display().to_string());
        format!("{} {}", command.get_program().to_string_lossy(), first.unwrap_or_default())
    };
    let status = command.status().map_err(|e| format!("{}: cannot start: {e}", name(command)))?;
    if status.success() { Ok(()) } else { Err(format!("`{}` failed ({status}), see above", name(command))) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MANIFEST: &str = "crates/ambulo-cli/Cargo.toml";
    const WORKFLOW: &str = ".github/workflows/release.yml";

    fn read(name: &str) -> String {
        fs::read_to_string(workspace::root().join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// A value of the table for `cargo binstall` for a target: of its own table if that has the key.
    fn binstall(manifest: &str, triple: &str, key: &str) -> String {
        let value = |table: &str| {
            let (_, rest) = manifest.split_once(&format!("\n[{table}]\n"))?;
            let rows = rest.split("\n\n").next()?.lines();
            let (_, value) = rows.filter_map(|row| row.split_once(" = ")).find(|(name, _)| *name == key)?;
            Some(value.trim_matches('"').to_owned())
        };
        let own = value(&format!("package.metadata.binstall.overrides.{triple}"));
        let template =
            own.or_else(|| value("package.metadata.binstall")).unwrap_or_else(|| panic!("{MANIFEST}: {key}"));
        let ending = if triple.contains("windows") { ".exe" } else { "" };
        let filled =
            template.replace("{ version }", "1.2.3").replace("{ target }", triple).replace("{ bin }", "ambulo");
        filled.replace("{ binary-ext }", ending)
    }

    #[test]
    fn binstall_asks_for_the_archives_that_are_made() {
        let manifest = read(MANIFEST);
        // What `cargo binstall` looks for on Windows with the other compiler is the same archive.
        let windows = target("x86_64-pc-windows-gnu").unwrap();
        let machines =
            TARGETS.iter().map(|target| (target.triple, target)).chain([("x86_64-pc-windows-msvc", windows)]);
        for (machine, target) in machines {
            let url = format!("{{ repo }}/releases/download/v1.2.3/{}", target.archive("1.2.3"));
            assert_eq!(binstall(&manifest, machine, "pkg-url"), url);
            let (ending, format) = if target.is_windows() { (".exe", "zip") } else { ("", "tgz") };
            let program = format!("ambulo-1.2.3-{}/ambulo{ending}", target.triple);
            assert_eq!(binstall(&manifest, machine, "bin-dir"), program);
            assert_eq!(binstall(&manifest, machine, "pkg-fmt"), format, "{machine}");
        }
    }

    /// The targets of a job of the workflow.
    fn targets_of(job: &str) -> Vec<String> {
        let workflow = read(WORKFLOW);
        let (_, rest) =
            workflow.split_once(&format!("\n  {job}:\n")).unwrap_or_else(|| panic!("{WORKFLOW}: no job {job}"));
        let own = rest.lines().take_while(|line| line.is_empty() || line.starts_with("   "));
        let named = own.filter_map(|line| line.trim().strip_prefix("- { target: ")?.split(',').next());
        named.map(str::to_owned).collect()
    }

    #[test]
    fn the_workflow_builds_and_tries_every_archive() {
        assert_eq!(targets_of("archives"), TARGETS.map(|target| target.triple));
        // Archives that their builder cannot run are tried by another job.
        let elsewhere = |target: &&Target| target.triple.starts_with("aarch64-unknown-linux") || target.is_windows();
        let tried: Vec<_> = TARGETS.iter().filter(elsewhere).map(|target| target.triple).collect();
        assert_eq!(targets_of("trial"), tried);
    }

    /// The manifests of all crates in `crates/`, with their names.
    fn manifests() -> Vec<(String, String)> {
        let folders = fs::read_dir(workspace::root().join("crates")).unwrap();
        let names = folders.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut all: Vec<_> = names.map(|name| (read(&format!("crates/{name}/Cargo.toml")), name)).collect();
        all.sort_by(|(_, a), (_, b)| a.cmp(b));
        all.into_iter().map(|(manifest, name)| (name, manifest)).collect()
    }

    #[test]
    fn every_crate_has_what_the_registry_asks_for() {
        let workspace = read("Cargo.toml");
        let own = format!("version = \"{}\"", env!("CARGO_PKG_VERSION"));
        let paths = workspace.lines().filter(|line| line.starts_with("ambulo"));
        assert!(paths.clone().count() > 5 && paths.clone().all(|line| line.contains(&own)), "dependencies of our own");
        let is_published = |manifest: &str| !manifest.contains("publish = false");
        for (name, manifest) in manifests() {
            assert_eq!(is_published(&manifest), !UNPUBLISHED.contains(&name.as_str()), "{name}");
            for text in ["LICENSE-MIT", "LICENSE-APACHE"] {
                assert_eq!(read(&format!("crates/{name}/{text}")), read(text), "{name}");
            }
            for key in ["description = ", "readme.workspace", "keywords.workspace", "categories.workspace"] {
                assert!(!is_published(&manifest) || manifest.contains(key), "{name}: {key}");
            }
        }
    }

    /// The licences of tables under a folder, as their heads name them.
    fn licences_of_tables(folder: &Path, found: &mut Vec<&'static str>) {
        const KNOWN: [(&str, &str); 3] =
            [("CC BY-SA 4.0", "CC-BY-SA-4.0"), ("CC BY 4.0", "CC-BY-4.0"), ("CC BY 3.0", "CC-BY-3.0")];
        let Ok(entries) = fs::read_dir(folder) else { return };
        for path in entries.map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                licences_of_tables(&path, found);
            } else if let Ok(text) = fs::read_to_string(&path) {
                let head: String = text.lines().take_while(|line| line.starts_with('#')).collect();
                found.extend(KNOWN.iter().filter(|(words, _)| head.contains(words)).map(|(_, licence)| licence));
            }
        }
    }

    #[test]
    fn every_crate_states_the_licences_of_its_tables() {
        let mut with_tables = 0;
        for (name, manifest) in manifests() {
            let mut found = Vec::new();
            licences_of_tables(&workspace::root().join("crates").join(&name).join("data"), &mut found);
            with_tables += usize::from(!found.is_empty());
            let stated = manifest.lines().find_map(|line| line.strip_prefix("license = \"")).unwrap_or_default();
            for licence in found {
                assert!(stated.contains(&format!(" AND {licence}")), "{name}: {licence}, stated `{stated}`");
            }
        }
        assert!(with_tables >= 4);
    }

    /// What the workflow does before it signs: the list of components of a program, and the paths for the action.
    #[test]
    fn the_list_of_components_has_a_serial_number_that_follows_the_program() {
        let python = interpreter();
        let knows_toml = Command::new(python).args(["-c", "import tomllib"]).output();
        if std::env::var_os("CI").is_none() && !knows_toml.is_ok_and(|output| output.status.success()) {
            return; // Python 3.11 or later is not installed
        }
        let folder = std::env::temp_dir().join(format!("ambulo-components-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let triple = "x86_64-unknown-linux-gnu";
        let pack = |content: &str| {
            let program = folder.join("ambulo");
            fs::write(&program, content).unwrap();
            let out = folder.join("out");
            let run = |words: &[&std::ffi::OsStr]| {
                let output = Command::new(python).current_dir(workspace::root()).args(words).output().unwrap();
                assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
                String::from_utf8(output.stdout).unwrap()
            };
            run(&["packaging/archive.py".as_ref(), triple.as_ref(), program.as_ref(), out.as_ref()]);
            let signed = run(&["packaging/attestable.py".as_ref(), out.as_ref(), triple.as_ref()]);
            let list = signed.lines().find_map(|line| line.strip_prefix("list=")).unwrap();
            assert!(signed.contains("archive=") && !signed.contains('*'), "{signed}");
            fs::read_to_string(list).unwrap()
        };
        let (first, again, other) = (pack("one"), pack("one"), pack("two"));
        fs::remove_dir_all(&folder).unwrap();
        assert_eq!(first, again, "same program, same bytes");
        let serial = |text: &str| text.lines().find(|line| line.contains("serialNumber")).unwrap().to_owned();
        assert!(serial(&first).contains("urn:uuid:") && serial(&first) != serial(&other));
        for licence in ["CC-BY-SA-4.0", "CC-BY-4.0", "CC-BY-3.0"] {
            assert!(first.contains(licence), "{licence}");
        }
        let workflow = read(WORKFLOW);
        assert!(workflow.contains("packaging/attestable.py target/archives ${{ matrix.target }}"));
        assert!(workflow.contains("sbom-path: ${{ steps.bill.outputs.list }}"));
    }

    #[test]
    fn every_action_of_the_workflows_is_pinned_to_a_commit() {
        for name in [WORKFLOW, ".github/workflows/ci.yml", ".github/workflows/pages.yml"] {
            let text = read(name);
            for action in text.lines().filter_map(|line| line.split_once("uses: ")).map(|(_, action)| action) {
                let commit = action.split('@').nth(1).and_then(|rest| rest.split(' ').next()).unwrap_or_default();
                let pinned =
                    commit.len() == 40 && commit.bytes().all(|b| b.is_ascii_hexdigit()) && action.contains(" # v");
                assert!(pinned || action.starts_with("./"), "{name}: {action}");
            }
        }
    }

    /// The number after a key in a file.
    fn stated(file: &str, key: &str) -> String {
        let text = read(file);
        let (_, rest) = text.split_once(key).unwrap_or_else(|| panic!("{file}: no `{key}`"));
        rest.chars().take_while(|c| c.is_ascii_digit() || *c == '.').collect()
    }

    #[test]
    fn packages_and_documents_state_the_same_versions() {
        let recipe = ("packaging/recipe.yaml", "version: \"");
        for (file, key) in [recipe, ("packaging/Dockerfile", "ARG VERSION="), ("packaging/ambulo.def", "ambulo-")] {
            assert_eq!(stated(file, key), env!("CARGO_PKG_VERSION"), "{file}");
        }
        assert_eq!(stated(WORKFLOW, "MATURIN: "), stated("xtask/src/python.rs", "\"maturin=="));
        assert_eq!(stated("docs/RELEASES.md", "glibc "), GLIBC);
    }

    fn words(text: &str) -> Vec<String> {
        text.split(' ').map(str::to_owned).collect()
    }

    #[test]
    fn a_command_line_has_targets_a_runner_and_a_tag() {
        let asked = request(&words("--target a --target b --runner wine --tag v1.0.0")).unwrap();
        assert_eq!(asked.targets, ["a", "b"]);
        assert_eq!((asked.runner.as_deref(), asked.tag.as_deref()), (Some("wine"), Some("v1.0.0")));
        assert_eq!(request(&[]).unwrap(), Request::default());
        assert_eq!(request(&words("--target")).unwrap_err(), USAGE);
        assert_eq!(request(&words("--fast yes")).unwrap_err(), USAGE);
    }

    #[test]
    fn a_tag_has_the_version_and_the_changes_have_its_heading() {
        let changes = "# Changelog\n\n## 1.2.0 (2030-01-31)\n";
        assert_eq!(check_tag("v1.2.0", "1.2.0", changes), Ok(()));
        assert!(check_tag("1.2.0", "1.2.0", changes).unwrap_err().contains("expected `v1.2.0`"));
        assert!(check_tag("v1.2", "1.2", changes).unwrap_err().contains("no heading `## 1.2`"));
        assert!(check_tag("v1.3.0", "1.3.0", changes).unwrap_err().contains("no heading"));
    }

    #[test]
    fn an_unknown_target_is_refused_with_the_known_ones() {
        let error = target("sparc-unknown-linux-gnu").err().unwrap();
        assert!(error.contains("`sparc-unknown-linux-gnu`; known: x86_64-unknown-linux-gnu, "), "{error}");
    }
}
