//! What is shown of one folder.

mod events;

use super::block::Block;
use super::contract::{PageSource, Quality, Session, TimeAxis};
use super::folder::{Folder, PageError};

/// The session of a folder; its numbers go into `block`.
pub(super) fn session(folder: &Folder<'_>, _block: &mut Block) -> Result<Session, PageError> {
    let summary = folder.summary()?;
    let kinematics = folder.table("kinematics.mot")?;
    let frames = kinematics.as_ref().map_or(0, |table| table.rows());
    let start_s = summary["window_s"][0].as_f64().unwrap_or(0.0);
    let step_s = summary["rate_hz"].as_f64().map_or(0.0, |rate| 1.0 / rate);
    let source = match summary["ground"]["source"].as_str() {
        Some("measured") => PageSource::Measured,
        Some("predicted") => PageSource::Predicted,
        Some("simulated") => PageSource::Simulated,
        _ => PageSource::None,
    };
    Ok(Session {
        name: summary["input"]["motion"].as_str().unwrap_or(&folder.name).to_owned(),
        header: Vec::new(),
        source,
        time: TimeAxis { start_s, step_s, frames },
        events: events::events(folder)?,
        cycles: Vec::new(),
        groups: Vec::new(),
        tables: Vec::new(),
        quality: Quality {
            facts: Vec::new(),
            groups: Vec::new(),
            tables: Vec::new(),
            findings: Vec::new(),
            assumptions: Vec::new(),
        },
        feasibility: None,
        view: None,
        missing: Vec::new(),
    })
}
