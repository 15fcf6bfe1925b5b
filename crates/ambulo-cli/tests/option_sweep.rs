//! Every numeric option of every verb with extreme values: an error, or results with finite numbers; no panic, no
//! signal, no run without end, at most 1 GB of memory.
//!
//! Most values are refused while the words are parsed. That is tried here, with the parser of the program; the program
//! itself runs with the rest.
//!
//! The options come from the definition of the command line, so that a new one is tested as well. A third of the values
//! is tried by default, chosen by a fixed hash; all of them if `AMBULO_SWEEP=all` is set, as by
//! `cargo xtask check --full`.

use crate::workbench::{Run, Workbench};
use ambulo_cli::internals;
use clap::Arg;
use std::any::TypeId;
use std::path::{Path, PathBuf};

/// Extreme values that are typing errors, and some that are plausible.
const VALUES: [&str; 39] = [
    "0",
    "-0",
    "-1",
    "1",
    "0.1",
    "5",
    "10",
    "0.001",
    "1e-308",
    "5e-324",
    "-5e-324",
    "1e-9",
    "1e6",
    "1e9",
    "-1e9",
    "1e15",
    "1e308",
    "-1e308",
    "1.7976931348623157e308",
    "1e400",
    "-1e400",
    "inf",
    "-inf",
    "infinity",
    "nan",
    "-NaN",
    "",
    " ",
    "text",
    "1,5",
    "0x10",
    "1e",
    "--1",
    "1_000",
    "½",
    "9223372036854775807",
    "18446744073709551615",
    "18446744073709551616",
    "-9223372036854775809",
];

/// By default one of so many combinations is tried.
const SAMPLE: u64 = 3;

/// How a number is written in the value of an option that is not a number alone, by the name of the value.
fn forms(value_name: &str) -> &'static [&'static str] {
    match value_name {
        "BODY:KG[:X,Y,Z]" => &["torso:#", "torso:1:#,0,0", "torso:1:0,0,#"],
        "TIME:SPEED[:DURATION]" | "TIME:LENGTH[:DURATION]" => &["#:1", "1:#", "1:1:#"],
        "TIME:CADENCE[:DURATION]" => &["#:100", "1:#", "1:100:#"],
        "N=r|l|off|..." => &["#=r", "#=off", "#=flip-y", "#=l+turn-90"],
        "BODY:PREFIX" => &["calcn_r:#"],
        _ => &["#"],
    }
}

/// Whether an option takes something else than a path, a name or one of a few words.
fn takes_a_number(option: &Arg) -> bool {
    let of = |kind: TypeId| option.get_value_parser().type_id() == kind;
    let is_text = of(TypeId::of::<PathBuf>()) || of(TypeId::of::<String>());
    option.get_action().takes_values()
        && option.get_long().is_some()
        && option.get_possible_values().is_empty()
        && !is_text
}

/// The command line with the options of all verbs, which a run describes only when it needs them.
fn command_line() -> clap::Command {
    let mut command = internals::command_line();
    command.build();
    command
}

/// The numeric options of a verb: name, and the name of its value.
fn options(verb: &str) -> Vec<(String, String)> {
    let command = command_line();
    let verb = command.find_subcommand(verb).unwrap();
    let named = |option: &Arg| {
        let value = option.get_value_names().and_then(|names| names.first()).map_or("", |name| name.as_str());
        (option.get_long().unwrap().to_owned(), value.to_owned())
    };
    verb.get_arguments().filter(|option| takes_a_number(option)).map(named).collect()
}

/// A run that succeeds, to which one option is added: words, and pairs of option and value that the added option
/// replaces.
struct Base {
    words: &'static [&'static str],
    options: &'static [(&'static str, &'static str)],
    /// The options that are tried; all if empty.
    only: &'static [&'static str],
}

impl Base {
    /// Runs the command, with one option added if it is given, and checks the run. None if the words are refused before
    /// anything is run.
    fn run(&self, bench: &Workbench, added: Option<(&str, &str)>) -> Option<Run> {
        let others = self.options.iter().filter(|(name, _)| added.is_none_or(|(option, _)| option != *name));
        let options = others.copied().chain(added).map(|(name, value)| format!("--{name}={value}"));
        let words: Vec<String> = self.words.iter().map(|word| (*word).to_owned()).chain(options).collect();
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        if let Some(refusal) = internals::refusal(&[&["ambulo"][..], &words].concat()) {
            check_refusal(refusal.exit_code(), &refusal.to_string(), &words);
            return None;
        }
        let run = bench.run_within_limits(&words);
        check(&run, &words, &bench.folder.join("out"));
        Some(run)
    }

    fn has(&self, option: &str) -> bool {
        self.only.is_empty() || self.only.contains(&option)
    }
}

fn is_chosen(option: &str, form: &str, value: &str) -> bool {
    // FNV-1a: the same choice on every machine.
    let mix = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    let hash = format!("{option} {form} {value}").bytes().fold(0xcbf2_9ce4_8422_2325, mix);
    (hash >> 32).is_multiple_of(SAMPLE) || std::env::var("AMBULO_SWEEP").is_ok_and(|which| which == "all")
}

/// Whether a number once ended in a panic, in too much memory or in NaN; these are always tried.
fn was_a_bug(option: &str, value: &str) -> bool {
    match option {
        "speed" => matches!(value, "1e-308" | "1e-9" | "1e6"),
        "step-length" => matches!(value, "1e-9" | "0.001" | "1e308"),
        "cadence" => matches!(value, "0.001" | "1e308"),
        "force-cutoff" => value == "1e-308",
        "cutoff" => value == "1e-9",
        "add-mass" => value == "1e308",
        "duration" => value == "1e6",
        _ => false,
    }
}

/// Tries the values of every numeric option of a verb on each base.
fn sweep(bench: &Workbench, verb: &str, bases: &[Base]) {
    let (mut tried, mut started, mut accepted) = (0, 0, 0);
    let is_accepted = |run: &Run| run.code != Some(2);
    // Otherwise every value could be refused for another reason.
    let works = |base: &Base| base.run(bench, None).as_ref().is_some_and(is_accepted);
    assert!(bases.iter().all(works), "a base of `{verb}` fails");
    for (option, value_name) in options(verb) {
        let all = forms(&value_name).iter().flat_map(|form| VALUES.map(|value| (form, value)));
        for (form, value) in all.filter(|(form, value)| is_chosen(&option, form, value) || was_a_bug(&option, value)) {
            for base in bases.iter().filter(|base| base.has(&option)) {
                let run = base.run(bench, Some((&option, &form.replace('#', value))));
                tried += 1;
                started += usize::from(run.is_some());
                accepted += usize::from(run.as_ref().is_some_and(is_accepted));
            }
        }
    }
    println!("{verb}: {tried} tried, {started} started, {accepted} accepted");
    assert!(started > 0, "`{verb}` has no numeric option");
}

fn check(run: &Run, words: &[&str], results: &Path) {
    assert!(matches!(run.code, Some(0..=2)), "{words:?}: {:?} {}", run.code, run.stderr);
    if let Some(code @ 2) = run.code {
        check_refusal(code, &run.stderr, words);
        return;
    }
    let Ok(files) = std::fs::read_dir(results) else { return };
    for path in files.map(|file| file.unwrap().path()).filter(|path| is_table(path)) {
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(not_finite(&text), None, "{words:?}: {}", path.display());
    }
    std::fs::remove_dir_all(results).unwrap();
}

fn check_refusal(code: i32, message: &str, words: &[&str]) {
    assert!(code == 2 && message.starts_with("error: ") && message.len() < 2000, "{words:?}: {code} {message}");
}

fn is_table(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ["sto", "mot", "csv"].iter().any(|known| ending == *known))
}

/// The first cell that is not a finite number, with its line.
fn not_finite(text: &str) -> Option<String> {
    let is_odd = |cell: &str| cell.trim().parse::<f64>().is_ok_and(|number| !number.is_finite());
    let mut lines = text.lines().enumerate();
    lines.find(|(_, line)| line.split([',', '\t']).any(is_odd)).map(|(i, line)| format!("line {}: {line}", i + 1))
}

#[test]
fn numbers_that_are_not_finite_are_found_in_tables() {
    assert_eq!(not_finite("time,knee\n0,1e308\n0.1,\n"), None);
    assert_eq!(not_finite("time,knee\n0,1\n0.1,NaN\n").as_deref(), Some("line 3: 0.1,NaN"));
    assert_eq!(not_finite("time\tknee\n0\t-inf\n").as_deref(), Some("line 2: 0\t-inf"));
}

#[test]
fn the_options_of_the_sweep_are_the_numeric_ones() {
    let names = |verb: &str| options(verb).into_iter().map(|(name, _)| name).collect::<Vec<String>>();
    let gait =
        ["speed", "step-length", "cadence", "speed-change", "step-length-change", "cadence-change", "step-height"];
    let walk = [&gait[..], &["mass", "height", "slope", "load", "weak", "step-width", "cycles", "rate"]].concat();
    assert_eq!(names("walk"), walk);
    for name in
        ["from", "to", "rate", "cutoff", "force-cutoff", "order", "mass", "height", "max-gap", "add-mass", "plate"]
    {
        assert!(names("forces").iter().any(|known| known == name), "{name}");
    }
    for name in ["model", "output", "figure", "filter", "json"] {
        assert!(names("forces").iter().all(|known| known != name), "{name}");
    }
    // A verb with its first numeric option needs a sweep below; numbers of `tune` are tried in tune.rs, because an
    // accepted one takes seconds, those of `calibrate` are some of `forces`, those of `validate` too, apart from the
    // number of threads (validate.rs); those of `batch` and `session` are counts and limits (batch.rs,
    // session.rs).
    let command = command_line();
    let verbs: Vec<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
    let swept: Vec<&str> = verbs.into_iter().filter(|verb| !names(verb).is_empty()).collect();
    assert_eq!(
        swept,
        [
            "forces",
            "calibrate",
            "validate",
            "batch",
            "session",
            "stream",
            "walk",
            "sweep",
            "simulate",
            "tune",
            "compare"
        ]
    );
    assert!(names("calibrate").iter().all(|name| names("forces").contains(name)));
    assert_eq!(names("validate"), ["mass", "height", "jobs"]);
    assert_eq!(names("batch"), ["jobs", "shard", "part", "limit", "time-limit", "size-limit"]);
    assert_eq!(names("session"), ["jobs"]);
}

/// Where options are described late, clap takes the description of a group of options for that of the subcommand, if
/// the group has one.
#[test]
fn each_subcommand_keeps_its_own_description() {
    let [described_late, described] = [internals::command_line(), command_line()];
    for verb in described_late.get_subcommands() {
        let found = described.find_subcommand(verb.get_name()).and_then(clap::Command::get_about);
        assert!(verb.get_about().is_some(), "{}", verb.get_name());
        assert_eq!(found.map(ToString::to_string), verb.get_about().map(ToString::to_string), "{}", verb.get_name());
    }
}

#[test]
fn forces_survives_every_number() {
    let bench = Workbench::new("forces");
    // The first frames, so that accepted values are quick.
    for file in ["walk.mot", "walk_grf.mot"] {
        bench.edit_rows(file, |rows| rows.into_iter().take(40).collect());
    }
    let base = Base {
        words: &["forces", "walk.mot", "--model=figure.osim", "--grf=walk_grf.mot", "--loads=walk_grf.xml", "--quiet"],
        options: &[],
        only: &[],
    };
    sweep(&bench, "forces", &[base]);
}

#[test]
fn forces_of_markers_and_skeletons_survives_every_number() {
    let bench = Workbench::empty("markers");
    bench.run(&["demo", "-o", "demo", "--quiet"]).done();
    let whole = bench.read("demo/input/walk.c3d");
    bench.write("short.c3d", &whole[..whole.len() / 5]);
    let markers = Base {
        words: &["forces", "short.c3d", "--quiet"],
        options: &[("mass", "75")],
        only: &["mass", "height", "plate", "max-gap"],
    };
    let skeleton = Base {
        words: &["forces", "demo/input/walk.bvh", "--to=1", "--quiet"],
        options: &[("mass", "75")],
        only: &["mass", "height"],
    };
    sweep(&bench, "forces", &[markers, skeleton]);
}

#[test]
fn stream_survives_every_number() {
    let bench = Workbench::new("sweep_stream");
    let base = Base { words: &["stream", "figure.osim", "--quiet"], options: &[("rate", "100")], only: &[] };
    sweep(&bench, "stream", &[base]);
}

#[test]
fn walk_survives_every_number() {
    let bench = Workbench::empty("walk");
    let paper =
        Base { words: &["walk", "--mode=paper", "--quiet", "-o", "out"], options: &[("cycles", "1")], only: &[] };
    sweep(&bench, "walk", &[paper]);
}

/// Slopes and loads are not tried: a predicted walk takes as long as a run may take.
#[test]
fn sweep_survives_every_number() {
    let bench = Workbench::empty("sweep_walks");
    let one = Base { words: &["sweep", "--quiet", "-o", "out"], options: &[], only: &["speed", "mass", "height"] };
    sweep(&bench, "sweep", &[one]);
}

#[test]
fn simulate_survives_every_number() {
    let bench = Workbench::empty("simulate");
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/pendulum.toml");
    bench.write("pendulum.toml", std::fs::read(scene).unwrap());
    sweep(&bench, "simulate", &[Base { words: &["simulate", "pendulum.toml", "--quiet"], options: &[], only: &[] }]);
}

#[test]
fn compare_survives_every_number() {
    let bench = Workbench::empty("sweep_compare");
    bench.write("a.sto", "t\nendheader\ntime\ta\n0\t0\n1\t1\n2\t2\n");
    bench.write("b.sto", "t\nendheader\ntime\ta\n0\t0\n1\t1.5\n2\t2\n");
    sweep(&bench, "compare", &[Base { words: &["compare", "a.sto", "b.sto", "--quiet"], options: &[], only: &[] }]);
}
