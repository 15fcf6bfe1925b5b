//! The page `docs/measured/MUTANTS.md`, from recorded outcomes and reasons.

use super::modules::MODULES;
use super::record::{Counts, Outcome, Record, reasons};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

/// Standard normal quantile of a two-sided interval of 95 %.
const Z: f64 = 1.959_963_984_540_054;
/// Share of viable mutants that the tests should notice.
const REQUIRED: f64 = 0.95;

/// The page without its first line.
pub(super) fn render(folder: &Path) -> Result<String, String> {
    let reasons = reasons(folder)?;
    let mut records = Vec::new();
    for module in &MODULES {
        if folder.join(module.name).with_extension("txt").exists() {
            records.push((module, Record::read(folder, module.name)?));
        }
    }
    let mut page = introduction();
    let mut sum = Counts::default();
    for (module, record) in &records {
        let counts = record.counts(&reasons);
        sum = sum + counts;
        let place = below_src(module.files).trim_end_matches("/**");
        let _ = writeln!(page, "{}", row(&format!("`{place}`"), Some(record.mutants), &counts));
    }
    let _ = writeln!(page, "{}\n", row("all that were run", None, &sum));
    let _ = writeln!(
        page,
        "Commits and seeds: {}.\n",
        origins(records.iter().map(|(module, record)| (module.name, record)))
    );
    let absent: Vec<String> = MODULES
        .iter()
        .filter(|module| !records.iter().any(|(known, _)| known.name == module.name))
        .map(|module| format!("`{}`", module.name))
        .collect();
    if !absent.is_empty() {
        let _ = writeln!(page, "Not yet run: {}.\n", absent.join(", "));
    }
    let list = |page: &mut String, title: &str, wanted: Outcome| {
        let _ = writeln!(page, "## {title}\n");
        let names = records.iter().flat_map(|(_, record)| record.with(wanted)).collect::<Vec<_>>();
        page.push_str(&table(&names, &reasons));
    };
    list(&mut page, "Survivors", Outcome::Missed);
    list(&mut page, "Survived at first, caught by tests written since", Outcome::Mended);
    Ok(page)
}

/// A path without its crate.
fn below_src(path: &str) -> &str {
    path.split_once("/src/").map_or(path, |(_, below)| below)
}

fn introduction() -> String {
    format!(
        "# What the tests would notice

`cargo mutants` changes one function of the library at a time: another operator, another return value, a lost branch. A mutant that no
test notices survives. `cargo xtask mutants` runs all mutants of two files and random samples of larger modules, first with the quick
tests of the subject, then the survivors with wider tests. Tests that take more than five seconds are left out
(`xtask/src/mutants/modules.rs` lists them), so a survivor here may still fail in a complete run.

A mutant is *viable* if it compiles and is not *equivalent*: an equivalent one changes results nowhere, or only where two computed numbers are
exactly equal; it is listed as a survivor with that reason. *At first* is the share of viable mutants that the tests caught when the sample was drawn, with
Wilson's 95 % interval: an estimate for the whole module where it is a sample. *Now* includes tests written for the survivors, and so is
no estimate for mutants that were not drawn. A test that hangs (timeout) has noticed. Required: {:.0} %.

The page is written from recorded outcomes and reasons: a run takes hours, and mutants are found by line and column, so any edit
moves them. The commits below were measured.

| module | mutants | run | equivalent | viable | caught | timeouts | caught since | survivors | at first | Wilson 95 % | now |
|:---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|
",
        100.0 * REQUIRED
    )
}

fn row(name: &str, mutants: Option<usize>, counts: &Counts) -> String {
    let viable = counts.viable();
    let share = |noticed: usize| 100.0 * noticed as f64 / viable.max(1) as f64;
    let (low, high) = wilson(counts.noticed_at_first(), viable);
    let now = share(counts.noticed_at_first() + counts.mended);
    let mutants = mutants.map_or_else(String::new, |count| count.to_string());
    let Counts { caught, timeout, missed, mended, equivalent, .. } = counts;
    format!(
        "| {name} | {mutants} | {} | {equivalent} | {viable} | {caught} | {timeout} | {mended} | {missed} | {:.1} % | \
         {:.1} to {:.1} % | {now:.1} %{} |",
        counts.run(),
        share(counts.noticed_at_first()),
        100.0 * low,
        100.0 * high,
        if now >= 100.0 * REQUIRED { "" } else { ", missed" }
    )
}

/// Wilson's interval of a share of `hits` in `trials`: (p + z²/2n ± z √(p(1-p)/n + z²/4n²)) / (1 + z²/n).
fn wilson(hits: usize, trials: usize) -> (f64, f64) {
    if trials == 0 {
        return (0.0, 1.0);
    }
    let (n, z2) = (trials as f64, Z * Z);
    let p = hits as f64 / n;
    let center = p + z2 / (2.0 * n);
    let half = Z * (p * (1.0 - p) / n + z2 / (4.0 * n * n)).sqrt();
    ((center - half) / (1.0 + z2 / n), (center + half) / (1.0 + z2 / n))
}

/// Where the outcomes come from.
fn origins<'a>(records: impl Iterator<Item = (&'a str, &'a Record)>) -> String {
    let one = |(name, record): (&str, &Record)| {
        let drawn = match (record.outcomes.len() < record.mutants, record.note.as_str()) {
            (false, "") => "all mutants".to_owned(),
            (false, note) => format!("all mutants; {note}"),
            (true, "") => format!("seed {}", record.seed),
            (true, note) => note.to_owned(),
        };
        format!("{name} {} ({drawn})", record.commit)
    };
    records.map(one).collect::<Vec<_>>().join("; ")
}

/// A table of mutants with their reasons.
fn table(names: &[String], reasons: &BTreeMap<String, String>) -> String {
    if names.is_empty() {
        return "None.\n\n".to_owned();
    }
    let mut table = "| place | mutation | reason |\n|:---|:---|:---|\n".to_owned();
    for name in names {
        let (place, mutation) = name.split_once(": ").unwrap_or((name, ""));
        let place = below_src(place);
        let reason = reasons.get(name).map_or("not yet judged", String::as_str);
        let _ = writeln!(table, "| {place} | `{}` | {} |", mutation.replace('|', "\\|"), reason.replace('|', "\\|"));
    }
    table + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_is_wilson_s() {
        // p solves (p - hits/n)² = z² p (1 - p) / n at both ends: the definition, before it is solved.
        for (hits, trials) in [(38, 40), (40, 40), (0, 7), (140, 144)] {
            let (low, high) = wilson(hits, trials);
            let (n, share) = (trials as f64, hits as f64 / trials as f64);
            for p in [low, high] {
                let difference = (p - share).powi(2) - Z * Z * p * (1.0 - p) / n;
                assert!(difference.abs() < 1e-12, "{hits} of {trials}: {p} leaves {difference}");
            }
            assert!(low <= share + 1e-12 && share <= high + 1e-12);
        }
    }

    #[test]
    fn a_row_counts_what_was_mended_only_now() {
        let counts = Counts { caught: 17, timeout: 1, missed: 1, mended: 1, equivalent: 2, unviable: 3 };
        let row = row("`contact`", Some(900), &counts);
        assert!(
            row.starts_with("| `contact` | 900 | 25 | 2 | 20 | 17 | 1 | 1 | 1 | 90.0 % | 69.9 to 97.2 % | 95.0 % |"),
            "{row}"
        );
    }
}
