//! The outcome of `reproduce`.

use super::say;
use crate::args::Voice;
use ambulo::reproduction::{Claim, Sensitivity};
use anyhow::Result;
use std::path::Path;

/// The outcome of `reproduce`.
pub(crate) fn reproduce(claims: &[Claim], others: &[Sensitivity], output: &Path, voice: Voice) -> Result<()> {
    if voice.quiet {
        return Ok(());
    }
    if voice.json {
        return say(&serde_json::to_string_pretty(claims)?);
    }
    for claim in claims {
        let holds = if claim.pass { "holds" } else { "fails" };
        say(&format!("{:3} {holds}  {}", claim.id, claim.paper))?;
        say(&format!("           {} = {:.4}", claim.headline, claim.value()))?;
        let turned = others.iter().filter(|other| other.turned(claims).contains(&claim.id)).count();
        if turned > 0 {
            say(&format!("           otherwise with {turned} of {} other values: assumptions.csv", others.len()))?;
        }
    }
    let held = claims.iter().filter(|claim| claim.pass).count();
    say(&format!("  {held} of {} hold; why and why not: claims.json", claims.len()))?;
    say(&format!("  written   {}", output.display()))
}
