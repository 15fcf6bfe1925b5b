//! The page of the 1997 paper: `cargo xtask reproduction [--write]`.
//!
//! Simulates all walks in both modes, judges the claims, and writes docs/measured/REPRODUCTION.md with their reasons,
//! the values that the paper does not give, and the muscle groups of the four gaits. Takes some minutes.

use crate::workspace;
use ambulo_paper::{
    Claim, CorrectedMode, Evidence, GAITS, Scope, Sensitivity, StoredShares, TrialSettings, assumptions, claims,
    number, paper_walk, read_shares, sensitivities, tally,
};
use std::fmt::Write;
use std::fs;
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
    let mut mode = |trial: &TrialSettings<'_>| paper_walk(trial);
    let paper = Evidence::gather(&mut mode, Scope::Full, Some(&clock)).map_err(|e| e.to_string())?;
    let mut corrected = CorrectedMode::default();
    let mut mode = |trial: &TrialSettings<'_>| corrected.walk(trial);
    let corrected = Evidence::gather(&mut mode, Scope::Full, Some(&clock)).map_err(|e| e.to_string())?;
    let claims = claims(&paper, Some(&corrected));
    // Of the file, not of this program, which may be older.
    let stored =
        fs::read_to_string(workspace::root().join(SHARES)).map_err(|e| format!("{SHARES}: cannot read: {e}"))?;
    let page = text(&claims, &sensitivities().map_err(|e| e.to_string())?, &read_shares(&stored));
    println!("{page}");
    if write {
        workspace::save(PAGE, &page)?;
    }
    Ok(())
}

fn text(claims: &[Claim], others: &[Sensitivity], shares: &StoredShares) -> String {
    let [held, all] = tally(claims);
    let mut page = format!(
        "# The claims of the 1997 paper: results\n\n\
         **{held} of {all}** claims of the paper that could fail hold in its own mode. Claims that are true by \
         construction and claims of ours are \
         listed and not counted. [REPRODUCTION.md](../REPRODUCTION.md) describes the mode, the files and the \
         method.\n\n\
         \"Share\" is the share of {} settings (seed {}) of all values that the paper does not give, drawn jointly, in \
         which the claim holds; \
         \"turned\" is the number of other single values that reverse the judgement.\n\n",
        shares.settings, shares.seed
    );
    page += &claim_table(claims, others, shares);
    page += "\n## Criteria and reasons\n\n";
    for claim in claims {
        let _ = writeln!(page, "- **{}**: {}.", claim.id, claim.note.replace('\n', " "));
    }
    page += &contradictions(claims, shares);
    page += &best_setting(shares);
    page += &muscle_table(claims);
    page + &assumption_table(claims, others)
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

/// Claims that hold in no setting, with the mechanical reason.
fn contradictions(claims: &[Claim], shares: &StoredShares) -> String {
    let never: Vec<&Claim> = claims.iter().filter(|claim| shares.contradicts(claim)).collect();
    if never.is_empty() {
        return String::new();
    }
    let mut section = String::from(
        "\n## Claims that contradict the paper's own model\n\nThey hold in none of the settings. Their reasons:\n\n",
    );
    for claim in never {
        let _ = writeln!(section, "- **{}** ({}): {}.", claim.id, claim.paper, claim.mechanics());
    }
    section
}

fn best_setting(shares: &StoredShares) -> String {
    let [held, judged] = shares.best_held;
    let mut section = format!(
        "\n## The most plausible figure\n\nOf all settings, this one meets most claims: {held} of the {judged} claims \
         of the paper that were judged \
         with other settings. The 1997 figure most likely was near it:\n\n| value | |\n|---|---|\n"
    );
    for (name, value) in shares.best.named() {
        let _ = writeln!(section, "| `{name}` | {value:.3} |");
    }
    section
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

fn assumption_table(claims: &[Claim], others: &[Sensitivity]) -> String {
    let mut section = String::from(
        "\n## Values that the paper does not give\n\n| quantity | value | reason | other value → claims that change \
         |\n|---|---|---|---|\n",
    );
    for assumption in assumptions() {
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
            "| {} | {} | {} | {} |",
            assumption.what,
            assumption.value,
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
