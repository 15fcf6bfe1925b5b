//! How often the claims of the 1997 paper hold: `cargo xtask claim-shares [--settings N] [--seed S] [--threads T]
//! [--log FILE] [--write]`.
//!
//! Draws all values that the paper does not give jointly, the time and the angle of every bound of the joint curves
//! included, until N settings could be simulated; judges the claims with each of them; and finds for each claim the
//! value that decides it. Drawn settings whose gaits are not possible are counted by their reasons. Each outcome is
//! added to the log at once, and an interrupted run goes on where it ended. With `--write` the table goes to
//! `crates/ambulo-paper/data/shares.csv`, from where `ambulo reproduce` prints it. Takes half an hour on two cores;
//! start it with `nice`.

use crate::workspace;
use ambulo_paper::{Judgement, Scope, Setting, StoredShares, judged_with, shares_csv, shares_of};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs::{self, File, OpenOptions};
use std::io::Write as _;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use std::thread;

/// The stored table, relative to the workspace root.
const FILE: &str = "crates/ambulo-paper/data/shares.csv";
/// For each setting that is simulated, at most so many are drawn.
const MOST_DRAWN: u64 = 40;

/// What was asked for.
struct Options {
    /// Settings that are simulated.
    settings: u64,
    seed: u64,
    threads: u64,
    log: PathBuf,
    write: bool,
}

impl Options {
    fn read(words: &[String]) -> Result<Options, String> {
        let log = workspace::root().join("target/claim-shares.csv");
        // The seed is the year of the paper.
        let mut options = Options { settings: 2000, seed: 1997, threads: 2, log, write: false };
        let mut rest = words.iter();
        while let Some(word) = rest.next() {
            let mut value = || rest.next().ok_or(format!("`{word}`: expected a value"));
            let number = |text: &String| text.parse().map_err(|_| format!("`{word}`: expected a whole number"));
            match word.as_str() {
                "--settings" => options.settings = number(value()?)?,
                "--seed" => options.seed = number(value()?)?,
                "--threads" => options.threads = number(value()?)?,
                "--log" => options.log = PathBuf::from(value()?),
                "--write" => options.write = true,
                _ => {
                    let known = "--settings, --seed, --threads, --log or --write";
                    return Err(format!("unknown option `{word}`, expected {known}"));
                }
            }
        }
        Ok(options)
    }
}

/// Runs the command.
#[expect(clippy::print_stdout, reason = "the results of the command")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let options = Options::read(words)?;
    let mut outcomes = Outcomes::read(&fs::read_to_string(&options.log).unwrap_or_default())?;
    let log = OpenOptions::new().create(true).append(true).open(&options.log);
    let log = log.map_err(|e| format!("{}: cannot be written: {e}", options.log.display()))?;
    outcomes.complete(&options, log)?;
    let (text, reasons) = outcomes.table(&options);
    println!("{text}settings that could not be simulated:");
    for (reason, count) in &reasons {
        println!("  {count}: {reason}");
    }
    if options.write {
        fs::write(workspace::root().join(FILE), text).map_err(|e| format!("{FILE}: cannot write: {e}"))?;
    }
    Ok(())
}

/// Outcomes by the number of the setting: a letter for each claim, `1` if it holds and `0` if it does not, or `!` and
/// why the setting could not be simulated.
#[derive(Default)]
struct Outcomes {
    claims: Vec<String>,
    rows: BTreeMap<u64, String>,
}

impl Outcomes {
    /// Reads a log: first the claims, then a number and an outcome in each line.
    fn read(text: &str) -> Result<Outcomes, String> {
        let mut lines = text.lines().filter_map(|line| line.split_once(','));
        let Some((_, claims)) = lines.next() else { return Ok(Outcomes::default()) };
        let claims = claims.split(' ').map(str::to_owned).collect();
        let row = |(number, outcome): (&str, &str)| {
            let number =
                number.parse().map_err(|_| format!("the log has the number `{number}`; expected a whole one"))?;
            Ok::<_, String>((number, outcome.to_owned()))
        };
        Ok(Outcomes { claims, rows: lines.map(row).collect::<Result<_, _>>()? })
    }

    fn simulated(&self) -> u64 {
        self.rows.values().filter(|outcome| !outcome.starts_with('!')).count() as u64
    }

    /// Judges settings until enough could be simulated; outcomes do not depend on the number of threads.
    fn complete(&mut self, options: &Options, log: File) -> Result<(), String> {
        if self.claims.is_empty() {
            let setting = Setting::papers_results().map_err(|e| e.to_string())?;
            let judged = judged_with(&setting, Scope::Sampled).map_err(|e| e.to_string())?;
            self.claims = judged.iter().map(|judgement| judgement.id.to_owned()).collect();
            writeln!(&log, "claims,{}", self.claims.join(" ")).map_err(|e| e.to_string())?;
        }
        let next = Mutex::new((0, self, log));
        thread::scope(|scope| {
            let workers: Vec<_> = (0..options.threads.max(1)).map(|_| scope.spawn(|| work(options, &next))).collect();
            workers.into_iter().try_for_each(|worker| worker.join().map_err(|_| "a thread failed".to_owned())?)
        })
    }

    /// The table, and why settings could not be simulated. Counts the first settings that could, so that a longer log
    /// gives the same table.
    fn table(&self, options: &Options) -> (String, BTreeMap<String, usize>) {
        let (mut judged, mut reasons, mut drawn) = (Vec::new(), BTreeMap::new(), 0);
        for (number, outcome) in &self.rows {
            if judged.len() as u64 == options.settings {
                break;
            }
            drawn += 1;
            match outcome.strip_prefix('!') {
                Some(reason) => *reasons.entry(reason.to_owned()).or_default() += 1,
                None => {
                    let passes = outcome.chars().map(|letter| letter == '1').collect();
                    judged.push((Setting::drawn(options.seed, *number), passes));
                }
            }
        }
        let ids: Vec<&str> = self.claims.iter().map(String::as_str).collect();
        let version = env!("CARGO_PKG_VERSION").to_owned();
        let claims = shares_of(&judged, &ids);
        let shares = StoredShares { version, seed: options.seed, drawn, settings: judged.len(), claims };
        (shares_csv(&shares), reasons)
    }
}

/// Judges settings that are not in the log, one after the other.
#[expect(clippy::print_stderr, reason = "the progress of the command")]
fn work(options: &Options, shared: &Mutex<(u64, &mut Outcomes, File)>) -> Result<(), String> {
    loop {
        let number = {
            let mut guard = shared.lock().unwrap_or_else(PoisonError::into_inner);
            let (next, outcomes, _) = &mut *guard;
            while outcomes.rows.contains_key(next) {
                *next += 1;
            }
            if outcomes.simulated() >= options.settings || *next >= MOST_DRAWN * options.settings {
                return Ok(());
            }
            *next += 1;
            *next - 1
        };
        let outcome = judged(options.seed, number);
        let mut guard = shared.lock().unwrap_or_else(PoisonError::into_inner);
        let (_, outcomes, log) = &mut *guard;
        writeln!(log, "{number},{outcome}").map_err(|e| format!("the log cannot be written: {e}"))?;
        outcomes.rows.insert(number, outcome);
        if outcomes.rows.len() % 200 == 0 {
            eprintln!("{} drawn, {} of {} simulated", outcomes.rows.len(), outcomes.simulated(), options.settings);
        }
    }
}

/// The outcome of a setting; numbers in a reason are left out, so that equal reasons are counted together.
fn judged(seed: u64, number: u64) -> String {
    let letters = |judgements: Vec<Judgement>| {
        judgements.iter().fold(String::new(), |mut text, judgement| {
            let _ = write!(text, "{}", u8::from(judgement.pass));
            text
        })
    };
    let without_numbers = |c: char| c.is_ascii_digit() || c == '\n';
    match judged_with(&Setting::drawn(seed, number), Scope::Sampled) {
        Ok(judgements) => letters(judgements),
        Err(error) => format!("!{}", error.to_string().replace(without_numbers, "")),
    }
}
