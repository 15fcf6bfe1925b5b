//! The page of the 1997 paper: `cargo xtask reproduction [--write]`.
//!
//! Simulates all walks in both modes, judges the claims, and writes docs/measured/REPRODUCTION.md with their reasons,
//! the values that the paper does not give, and the muscle groups of the four gaits. Takes some minutes.

use crate::workspace;
use ambulo_paper::{
    Claim, CorrectedMode, Evidence, GAITS, NAMED, Scope, Sensitivity, Setting, StoredShares, TrialSettings,
    add_experiments, assumptions, claims, former_tally, number, read_shares, sensitivities, tally,
};
use std::fmt::Write;
use std::fs;
use std::ops::ControlFlow;
use std::time::Instant;

const PAGE: &str = "docs/measured/REPRODUCTION.md";
/// The stored shares of `cargo xtask claim-shares`.
const SHARES: &str = "crates/ambulo-paper/data/shares.csv";

/// Runs the command.
#[expect(clippy::print_stdout, reason = "the page is the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let write = workspace::write_option(words)?;
    let start = Instant::now();
    let clock = move || start.elapsed().as_secs_f64();
    let setting = Setting::papers_results().map_err(|e| e.to_string())?;
    let mut mode = |trial: &TrialSettings<'_>| setting.walk(trial);
    let paper = Evidence::gather(&mut mode, Scope::Full, Some(&clock)).map_err(|e| e.to_string())?;
    let mut corrected = CorrectedMode::of(&setting);
    let mut mode = |trial: &TrialSettings<'_>| corrected.walk(trial);
    let corrected = Evidence::gather(&mut mode, Scope::Full, Some(&clock)).map_err(|e| e.to_string())?;
    let mut claims = claims(&paper, Some(&corrected));
    add_experiments(&mut claims, &paper, &setting).map_err(|e| e.to_string())?;
    let mut named = Vec::new();
    for (name, _) in NAMED {
        let Some(other) = Setting::named(name) else { continue };
        let other = other.map_err(|e| e.to_string())?;
        let mut mode = |trial: &TrialSettings<'_>| other.walk(trial);
        let evidence = Evidence::gather(&mut mode, Scope::Full, Some(&clock)).map_err(|e| e.to_string())?;
        let judged = ambulo_paper::claims(&evidence, Some(&corrected));
        named.push((other.name, tally(&judged), former_tally(&judged)));
    }
    // Of the file, not of this program, which may be older.
    let stored =
        fs::read_to_string(workspace::root().join(SHARES)).map_err(|e| format!("{SHARES}: cannot read: {e}"))?;
    let others = sensitivities(&setting, &paper, &mut |_, _| ControlFlow::Continue(()));
    let page = text(&Results { claims, others, named, shares: read_shares(&stored), setting });
    println!("{page}");
    if write {
        workspace::save(PAGE, &page)?;
    }
    Ok(())
}

/// What the page shows.
struct Results {
    claims: Vec<Claim>,
    others: Vec<Sensitivity>,
    /// Settings that come with the program, each with the claims that hold and those that could fail, now and by the
    /// criteria before they were changed.
    named: Vec<(String, [usize; 2], [usize; 2])>,
    shares: StoredShares,
    setting: Setting,
}

fn text(results: &Results) -> String {
    let Results { claims, others, shares, setting, .. } = results;
    let [held, all] = tally(claims);
    let mut page = format!(
        "# The claims of the 1997 paper: results\n\n\
         **{held} of {all}** claims of the paper that could fail hold in its own mode, with the setting `{}`. Claims \
         that are true by construction and claims of ours are listed and not counted. \
         [REPRODUCTION.md](../REPRODUCTION.md) describes the mode, the settings, the files and the method.\n\n\
         \"Share\" is the share of {} settings (seed {}) of all values that the paper does not give, drawn jointly, \
         in which the claim holds, and the value that decides it: the share where this value is low (or the switch \
         off) and where it is high (or on). \"Turned\" is the number of other single values that reverse the \
         judgement.\n\n",
        setting.name, shares.settings, shares.seed
    );
    page += &claim_table(claims, others, shares);
    page += "\n## Criteria and reasons\n\n";
    for claim in claims {
        let note = claim.note.replace('\n', " ");
        let _ = writeln!(page, "- **{}**: holds if {}. {note}.", claim.id, claim.criterion);
        if let Some(experiment) = &claim.experiment {
            let _ = writeln!(page, "  It fails because {experiment}.");
        }
    }
    page += &counts(results);
    page += &changes(claims);
    page += &muscle_table(claims);
    page + &assumption_table(claims, setting, others)
}

fn counts(results: &Results) -> String {
    let mut section = String::from(
        "\n## Settings that come with the program\n\n| setting | claims that hold | by the first criteria \
         |\n|---|---|---|\n",
    );
    for (name, [held, all], [before, all_before]) in &results.named {
        let _ = writeln!(section, "| `{name}` | {held} of {all} | {before} of {all_before} |");
    }
    section
}

/// Criteria that were changed.
fn changes(claims: &[Claim]) -> String {
    let mut section =
        String::from("\n## Criteria that were changed\n\n| claim | before | now | reason |\n|---|---|---|---|\n");
    let words = |pass: bool| if pass { "holds" } else { "fails" };
    for claim in claims {
        let Some(former) = &claim.former else { continue };
        let _ = writeln!(
            section,
            "| {} | {} ({}): {} | {} ({}): {} | {} |",
            claim.id,
            words(former.pass),
            former.kind.words(),
            former.criterion,
            words(claim.pass),
            claim.kind.words(),
            claim.criterion,
            former.reason
        );
    }
    section
}

fn claim_table(claims: &[Claim], others: &[Sensitivity], shares: &StoredShares) -> String {
    let mut table = String::from(
        "| claim | statement in short | paper's mode | number | corrected | kind | share | turned \
         |\n|---|---|---|---|---|---|---|---|\n",
    );
    for claim in claims {
        let holds = if claim.pass { "holds" } else { "fails" };
        let corrected = claim.corrected.as_ref().map_or(f64::NAN, |numbers| number(numbers, claim.headline));
        let turned = others.iter().filter(|other| other.reversed(claims).contains(&claim.id)).count();
        let _ = writeln!(
            table,
            "| {} | {} | {holds} | {} `{}` | {} | {} | {} | {turned} of {} |",
            claim.id,
            claim.paper,
            shown(claim.value()),
            claim.headline,
            shown(corrected),
            claim.kind.words(),
            shares.words(claim),
            others.len()
        );
    }
    table
}

/// Work of the muscle groups per gait, from the numbers of claim m1.
fn muscle_table(claims: &[Claim]) -> String {
    let Some(claim) = claims.iter().find(|claim| claim.id == "m1") else { return String::new() };
    let mut section = String::from(
        "\n## Action of muscles in the four gaits\n\nConcentric and eccentric work per cycle [J/kg] and the instant of \
         the largest torque \
         [% of the cycle], right leg, net moments without impacts.\n\n\
         | mode | gait | joint | group | concentric | eccentric | peak |\n|---|---|---|---|---|---|---|\n",
    );
    for (mode, numbers) in [("paper", Some(&claim.paper_mode)), ("corrected", claim.corrected.as_ref())] {
        let Some(numbers) = numbers else { continue };
        for gait in GAITS {
            let start = format!("{gait}_");
            for (name, concentric) in numbers {
                let Some(group) = name.strip_prefix(&start).and_then(|rest| rest.strip_suffix("_concentric_j_kg"))
                else {
                    continue;
                };
                let of = |what: &str| number(numbers, &format!("{gait}_{group}_{what}"));
                let (joint, muscles) = group.split_once('_').unwrap_or((group, ""));
                let (eccentric, peak) = (of("eccentric_j_kg"), of("peak_percent"));
                let _ = writeln!(
                    section,
                    "| {mode} | {gait} | {joint} | {muscles} | {concentric:.2} | {eccentric:.2} | {peak:.0} |"
                );
            }
        }
    }
    section
}

fn assumption_table(claims: &[Claim], setting: &Setting, others: &[Sensitivity]) -> String {
    let mut section = String::from(
        "\n## Values that the paper does not give\n\n| quantity | value | range | source of the range | open because | \
         other \
         value → claims that change |\n|---|---|---|---|---|---|\n",
    );
    for assumption in assumptions(setting) {
        let own = others.iter().filter(|other| other.what == assumption.what);
        let turned: Vec<String> = own
            .map(|other| match &other.outcome {
                Err(reason) => format!("{}: {reason}", other.other),
                Ok(_) => match &other.reversed(claims)[..] {
                    [] => format!("{} → none", other.other),
                    turned => format!("{} → {}", other.other, turned.join(", ")),
                },
            })
            .collect();
        let _ = writeln!(
            section,
            "| {} | {} | {} | {} | {} | {} |",
            assumption.what,
            assumption.value,
            assumption.range,
            assumption.source,
            assumption.why,
            turned.join("; ")
        );
    }
    section
}

/// Four significant digits, or a dash if there is no number.
fn shown(value: f64) -> String {
    match value.abs() {
        _ if !value.is_finite() => "-".to_owned(),
        size if size >= 1e5 || (size > 0.0 && size < 1e-3) => format!("{value:.3e}"),
        100.0.. => format!("{value:.1}"),
        10.0.. => format!("{value:.2}"),
        _ => format!("{value:.4}"),
    }
}
