//! Prints the outcome of `reproduce`.

use super::{print_json, print_line};
use crate::args::PrintArgs;
use ambulo_paper::{Claim, Sensitivity, former_tally, stored_shares, tally};
use anyhow::Result;
use std::path::Path;

pub(crate) fn reproduce(claims: &[Claim], others: &[Sensitivity], output: &Path, print: PrintArgs) -> Result<()> {
    if print.quiet {
        return Ok(());
    }
    if print.json {
        return print_json(claims);
    }
    let shares = stored_shares();
    for claim in claims {
        let holds = if claim.pass { "holds" } else { "fails" };
        print_line(&format!("{:3} {holds}  {} ({})", claim.id, claim.paper, claim.kind.words()))?;
        print_line(&format!("           {} = {:.4}", claim.headline, claim.value()))?;
        if let Some(experiment) = &claim.experiment {
            print_line(&format!("           because {experiment}"))?;
        }
        if shares.of(claim.id).is_some() {
            print_line(&format!("           in {} settings: {}", shares.settings, shares.words(claim)))?;
        }
        let reversed = others.iter().filter(|other| other.reversed(claims).contains(&claim.id)).count();
        if reversed > 0 {
            print_line(&format!(
                "           reversed by {reversed} of {} other values: assumptions.csv",
                others.len()
            ))?;
        }
    }
    let [held, all] = tally(claims);
    print_line(&format!("  {held} of {all} claims of the paper hold that could fail; reasons: claims.json"))?;
    changed_criteria(claims)?;
    print_line(&format!("  written   {}", output.display()))
}

/// Prints changed criteria, with their reasons and earlier results.
fn changed_criteria(claims: &[Claim]) -> Result<()> {
    let [held, all] = former_tally(claims);
    print_line(&format!("  by the first criteria: {held} of {all}. Changes:"))?;
    for claim in claims {
        let Some(former) = &claim.former else { continue };
        let words = |pass: bool| if pass { "holds" } else { "fails" };
        print_line(&format!(
            "    {:3} {} before ({}): {}",
            claim.id,
            words(former.pass),
            former.kind.words(),
            former.criterion
        ))?;
        print_line(&format!("        {} now ({}): {}", words(claim.pass), claim.kind.words(), claim.criterion))?;
        print_line(&format!("        because {}", former.reason))?;
    }
    Ok(())
}

pub(crate) fn setting_written(path: &Path, print: PrintArgs) -> Result<()> {
    if print.quiet || print.json { Ok(()) } else { print_line(&format!("  written   {}", path.display())) }
}

/// Claims that held with the setting and do not hold now.
pub(crate) fn lost_claims(lost: &[String], setting: &str, print: PrintArgs) -> Result<()> {
    if lost.is_empty() || print.quiet || print.json {
        return Ok(());
    }
    print_line(&format!("  no longer hold with the setting `{setting}`: {}", lost.join(", ")))
}
