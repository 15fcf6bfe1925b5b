//! Writes the markers of a recording with their meaning as a marker set (`--markers FILE`).

use crate::args::InfoArgs;
use crate::files;
use ambulo::findings::Findings;
use ambulo::job::{ending, table};
use ambulo::kinematics::marker_proposal::{MarkerProposals, propose_markers};
use ambulo::model::marker_set::{MarkerSet, marker_template};
use ambulo::motion::{Heading, is_marker_table};
use ambulo::numerics::counted;
use ambulo::study::LaboratoryFile;
use anyhow::{Context, Result, bail};
use std::path::Path;

/// Writes the template; returns its content in one line.
pub(super) fn write(args: &InfoArgs, target: &Path, bytes: &[u8]) -> Result<String> {
    files::check_target(target, std::slice::from_ref(&args.file), args.replace.existing())?;
    let shown = args.file.display().to_string();
    let mut findings = Findings::default();
    let file = match ending(&args.file).as_str() {
        "c3d" => LaboratoryFile::from_c3d(bytes, &shown, &mut findings).with_context(|| shown.clone())?,
        "trc" => LaboratoryFile::from_trc(bytes, &shown, &mut findings).with_context(|| shown.clone())?,
        "csv" => {
            let (table, _) = table(&args.file, bytes)?;
            if !is_marker_table(&table) {
                bail!(
                    "{shown}: the table has no three columns per marker; --markers is for markers (.c3d, .trc, .csv)"
                );
            }
            LaboratoryFile::from_table(&table, &shown, &mut findings).with_context(|| shown.clone())?
        }
        _ => bail!("{shown}: --markers is for markers (.c3d, .trc, .csv)"),
    };
    if file.recording.poses.is_some() {
        bail!("{shown}: poses of segments need no marker set; --markers is for markers");
    }
    let names: Vec<String> = file.recording.markers.markers.iter().map(|marker| marker.name.clone()).collect();
    let recognised = MarkerSet::recognise(names.iter().map(String::as_str)).ok();
    let (axes, world) = file.recording.in_world(&mut findings);
    let found = propose_markers(&world.markers, recognised.as_ref(), axes.heading);
    let text = marker_template(&comment(&shown, &found, axes.heading), &found.markers, &found.proposed, &found.unknown);
    files::write(target, text.as_bytes())?;
    let (known, proposed, unknown) =
        (found.markers.len() - found.proposed.len(), found.proposed.len(), found.unknown.len());
    Ok(format!(
        "{}: {} by name, {proposed} proposed by position ({}), {unknown} without a proposal",
        target.display(),
        counted(known, "marker"),
        found.statement
    ))
}

fn comment(shown: &str, found: &MarkerProposals, heading: Heading) -> String {
    let sides = match heading {
        Heading::Unknown => "\nThe direction in which the person faces was found with the body: check right and left.",
        Heading::Walking | Heading::Facing => "",
    };
    let name = Path::new(shown).file_name().unwrap_or_default().to_string_lossy().into_owned();
    format!(
        "Markers of {name}. Positions were compared {}.{sides}\nCheck the proposed ones, then: ambulo forces {name} \
         --markers THIS_FILE. docs/MARKERS.md explains the words.",
        found.statement
    )
}
