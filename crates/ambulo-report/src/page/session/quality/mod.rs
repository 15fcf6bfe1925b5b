//! Quality of the results: how reliable the numbers are.

mod facts;
mod friction;
mod ground_points;
mod residual;
mod tables;

use super::muscles;
use super::results::Results;
use crate::clinical::ClinicalQuantity;
use crate::page::block::Block;
use crate::page::contract::{Group, PageFinding, Panel, Quality, Trace};
use ambulo::findings::Finding;

/// Ids of panels that reasons of a verdict link to.
pub(super) const RESIDUAL_FORCE: &str = "residual_force";
pub(super) const RESIDUAL_MOMENT: &str = "residual_moment";
pub(super) const FRICTION: &str = "friction_use";
pub(super) const CENTER_FORWARD: &str = "center_of_pressure_x";

/// All quality information in the files.
pub(super) fn quality(results: &Results, quantities: &[ClinicalQuantity], block: &mut Block) -> Quality {
    let groups = [
        residual::residual(results, block),
        friction::friction(results, block),
        ground_points::ground_points(results, block),
    ];
    Quality {
        facts: facts::facts(results),
        groups: groups.into_iter().flatten().collect(),
        tables: tables::tables(results, quantities).into_iter().chain(muscles::reserve_table(results)).collect(),
        findings: findings(&results.summary.findings),
        assumptions: results.summary.subject.as_ref().map_or_else(Vec::new, |subject| subject.assumptions.clone()),
    }
}

/// Warnings and notes of the program.
pub(super) fn findings(findings: &[Finding]) -> Vec<PageFinding> {
    let one = |finding: &Finding| PageFinding {
        code: finding.code.to_string(),
        severity: finding.severity().to_string(),
        message: finding.message.clone(),
        count: finding.count,
    };
    findings.iter().map(one).collect()
}

/// A group of panels over time.
fn group(id: &str, title: &str, note: String, columns: usize, panels: Vec<Panel>) -> Group {
    Group { id: id.to_owned(), title: title.to_owned(), note: Some(note), columns, panels }
}

/// A panel with curves over time only.
pub(super) fn over_time([id, title, unit]: [&str; 3], directions: [&str; 2], traces: Vec<Trace>) -> Panel {
    Panel {
        id: id.to_owned(),
        title: title.to_owned(),
        unit: unit.to_owned(),
        positive: directions[0].to_owned(),
        negative: directions[1].to_owned(),
        cycles: Vec::new(),
        means: Vec::new(),
        band: None,
        empty: traces.is_empty().then(|| "The files contain no data for this.".to_owned()),
        traces,
        red: Vec::new(),
        activity: None,
    }
}
