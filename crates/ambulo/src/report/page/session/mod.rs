//! What is shown of one folder.
//!
//! `results` reads the files of a recording or walk; every other file makes one part of the page of them.

mod curves;
mod cycles;
mod cycles_file;
mod events;
mod feet;
mod groups;
mod header;
mod results;
mod sides;
mod size;
mod strides;
mod time_distance;

use super::block::Block;
use super::contract::{Quality, Session};
use super::folder::{Folder, PageError};
use super::view::view;
use results::Results;
use size::BodySize;

/// The session of a folder; its numbers go into `block`.
pub(super) fn session(folder: &Folder<'_>, block: &mut Block) -> Result<Session, PageError> {
    let summary = folder.summary()?;
    recording(folder, Results::read(folder, summary)?, block)
}

/// Of a recording or a synthetic walk.
fn recording(folder: &Folder<'_>, results: Results, block: &mut Block) -> Result<Session, PageError> {
    let quantities = groups::quantities(&results);
    let strides = strides::strides(&results);
    let size = BodySize::of(&results, &strides);
    let viewed = view(folder, block)?;
    Ok(Session {
        name: header::recording_name(&results).unwrap_or_else(|| folder.name.clone()),
        header: header::header(&results, &size, &strides),
        source: results.source,
        time: results.time(),
        groups: groups::groups(&results, &size, &quantities, block),
        tables: vec![time_distance::table(&results, &size, &strides)],
        quality: Quality {
            facts: Vec::new(),
            groups: Vec::new(),
            tables: Vec::new(),
            findings: Vec::new(),
            assumptions: Vec::new(),
        },
        feasibility: None,
        view: viewed.view,
        missing: viewed.missing,
        events: results.events,
        cycles: results.cycles,
    })
}
