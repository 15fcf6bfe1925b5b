//! Conversion of result folders: for animation programs, and to one long table.

use super::{Converted, report_lost};
use crate::args::ConvertArgs;
use crate::commands::result_folder::ResultFolder;
use crate::files;
use ambulo::findings::{Code, Findings};
use ambulo_formats::bvh::Bvh;
use ambulo_report::{bvh_of_folder, csv_of_folder, glb_of_folder, rig_of_folder};
use ambulo_results::{Folder, KINEMATICS, POSES};
use anyhow::{Context, Result, bail};

/// Formats to which a result folder can be converted.
pub(super) const TARGETS: &[&str] = &["glb", "bvh", "csv"];

pub(super) fn convert(args: &ConvertArgs, to: &str) -> Result<Converted> {
    let opened = ResultFolder::open(&args.input)?;
    if to == "bvh" && opened.has(POSES) && !opened.has(KINEMATICS) {
        bail!("{}: a scene has no skeleton; expected .glb or .csv for the output", opened.shown());
    }
    let file = |name: &str| opened.read(name);
    let folder = Folder::of_files(opened.shown(), &file);
    let mut findings = Findings::default();
    let made = match to {
        "bvh" if let Some(path) = &args.rig => {
            let (bvh, remarks) = Bvh::read(&files::read(path)?).with_context(|| path.display().to_string())?;
            files::note_remarks(&path.display().to_string(), &remarks, &mut findings);
            let made = rig_of_folder(&folder, &bvh, &files::last(path), &mut findings);
            opened.check()?;
            return Ok(Converted {
                files: vec![(args.output.clone(), made.with_context(|| path.display().to_string())?)],
                findings,
            });
        }
        "glb" => glb_of_folder(&folder).map(|(bytes, arrows)| {
            report_lost(&mut findings, &["joint moments and powers".to_owned(), "masses and inertias".to_owned()]);
            let arrows = if arrows > 0 { "; arrows are 1 m for 1000 N" } else { "" };
            findings.report(Code::ConvertAxes, format!("lengths are in metres; x forward, y up, z right{arrows}"));
            bytes
        }),
        "bvh" => {
            report_lost(
                &mut findings,
                &["forces".to_owned(), "masses and inertias".to_owned(), "the time of the first frame".to_owned()],
            );
            findings.report(Code::ConvertAxes, "lengths are in centimetres; x forward, y up, z right");
            bvh_of_folder(&folder)
        }
        _ => csv_of_folder(&folder).map(String::into_bytes),
    };
    // An unreadable file is the cause of any later error, so it is reported first.
    opened.check()?;
    Ok(Converted { files: vec![(args.output.clone(), made?)], findings })
}
