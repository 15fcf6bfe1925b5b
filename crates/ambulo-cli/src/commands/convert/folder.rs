//! Result folders: for animation programs, and as one long table.

use super::{Converted, lost};
use crate::args::ConvertArgs;
use ambulo::findings::Findings;
use ambulo::report::page::Folder;
use ambulo::report::{bvh_of_folder, csv_of_folder, glb_of_folder};
use anyhow::Result;
use std::fs;

/// What can be made of a folder.
pub(super) const TARGETS: &[&str] = &["glb", "bvh", "csv"];

pub(super) fn convert(args: &ConvertArgs, to: &str) -> Result<Converted> {
    let file = |name: &str| fs::read(args.input.join(name)).ok();
    let folder = Folder { name: args.input.display().to_string(), file: &file };
    let mut findings = Findings::default();
    let bytes = match to {
        "glb" => {
            lost(&mut findings, &["joint moments and powers".to_owned(), "masses and inertias".to_owned()]);
            let glb = glb_of_folder(&folder)?;
            let arrows = if glb.arrows > 0 { "; arrows are 1 m for 1000 N" } else { "" };
            findings.note("convert.axes", format!("lengths are in metres; x forward, y up, z right{arrows}"));
            glb.bytes
        }
        "bvh" => {
            lost(
                &mut findings,
                &["forces".to_owned(), "masses and inertias".to_owned(), "the time of the first frame".to_owned()],
            );
            findings.note("convert.axes", "lengths are in centimetres; x forward, y up, z right");
            bvh_of_folder(&folder)?
        }
        _ => csv_of_folder(&folder)?.into_bytes(),
    };
    Ok(Converted { files: vec![(args.output.clone(), bytes)], findings })
}
