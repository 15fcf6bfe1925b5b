//! Prints the outcome of `reproduce`.

use super::print_line;
use crate::args::PrintArgs;
use ambulo_paper::{Claim, Sensitivity, stored_shares, tally};
use anyhow::Result;
use std::path::Path;

pub(crate) fn reproduce(claims: &[Claim], others: &[Sensitivity], output: &Path, print: PrintArgs) -> Result<()> {
    if print.quiet {
        return Ok(());
    }
    if print.json {
        return print_line(&serde_json::to_string_pretty(claims)?);
    }
    let shares = stored_shares();
    for claim in claims {
        let holds = if claim.pass { "holds" } else { "fails" };
        print_line(&format!("{:3} {holds}  {} ({})", claim.id, claim.paper, claim.kind.words()))?;
        print_line(&format!("           {} = {:.4}", claim.headline, claim.value()))?;
        if shares.of(claim.id).is_some() {
            print_line(&format!("           holds in {} of {} settings", shares.words(claim), shares.settings))?;
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
    print_line(&format!("  written   {}", output.display()))
}
