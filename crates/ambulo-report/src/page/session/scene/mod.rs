//! Makes the session of a simulated scene.

mod contacts;
mod energy;
mod facts;
mod instants;
mod joints;
mod moments;

use super::feasibility::Basis;
use super::{feasibility, peaks, quality};
use crate::clinical::ClinicalQuantity;
use crate::page::block::Block;
use crate::page::contract::{Feasibility, PageSource, Quality, RedSpan, Session, Table};
use crate::page::view::view;
use ambulo_results::{Folder, ResultsError, SceneSummary};
use instants::Instants;

/// The session of the result folder of a scene.
pub(super) fn session(folder: &Folder<'_>, summary: &SceneSummary, block: &mut Block) -> Result<Session, ResultsError> {
    let viewed = view(folder, block)?;
    let instants = Instants::of(folder, viewed.time)?;
    let mut missing = viewed.missing;
    let figures = moments::figures(folder, summary)?;
    let mut groups = moments::groups(&figures, &instants, block);
    groups.extend(joints::groups(folder, &instants, block, &mut missing)?);
    groups.extend(contacts::group(folder, &instants, block, &mut missing)?);
    groups.extend(energy::groups(folder, &instants, block)?);
    let mut feasibility = verdict(summary, &figures);
    match &mut feasibility {
        Some(verdict) => feasibility::mark(&mut [&mut groups], &mut verdict.red),
        None => missing.push("No verdict: this scene has no walking figure.".to_owned()),
    }
    if groups.is_empty() {
        missing.push("No curves: the folder has no joints.csv, contacts.csv, energy.csv or moments.sto.".to_owned());
    }
    Ok(Session {
        name: folder.name.clone(),
        outcome: facts::outcome(summary),
        data: None,
        glance: None,
        header: facts::header(summary),
        source: PageSource::Simulated,
        time: instants.axis(),
        events: Vec::new(),
        cycles: Vec::new(),
        groups,
        machines: Vec::new(),
        tables: vec![peaks::peaks(&summary.peaks)],
        quality: Quality {
            facts: facts::quality(summary),
            groups: Vec::new(),
            tables: Vec::new(),
            findings: quality::findings(&summary.findings),
            assumptions: Vec::new(),
        },
        feasibility,
        view: viewed.view,
        missing,
    })
}

/// Combines the verdicts of all figures.
fn verdict(summary: &SceneSummary, figures: &[moments::Figure]) -> Option<Feasibility> {
    let state = summary.verdict.as_ref()?.state.into();
    let quantities = |figure: &moments::Figure| -> Vec<ClinicalQuantity> { figure.quantities.clone() };
    let (mut red, mut sentences, mut closest): (Vec<RedSpan>, Vec<String>, Option<Table>) = Default::default();
    for figure in figures {
        // All contacts of a scene are known.
        let judged = feasibility::feasibility(&figure.verdict, &Basis::default(), &quantities(figure));
        let Some(one) = judged else { continue };
        let who = |sentence: &str| format!("{}: {sentence}", figure.name);
        sentences.push(who(&one.sentence));
        red.extend(one.red.into_iter().map(|span| RedSpan {
            sentence: who(&span.sentence),
            panel: span.panel.map(|panel| figure.panel(&panel)),
            ..span
        }));
        closest = Some(joined(closest, one.closest, &figure.name));
    }
    Some(Feasibility {
        state,
        sentence: sentences.join(" "),
        red,
        closest: closest.unwrap_or_else(feasibility::no_checks),
    })
}

/// Adds the rows of another figure to a table.
fn joined(before: Option<Table>, mut next: Table, name: &str) -> Table {
    for quantity in next.rows.iter_mut().filter_map(|row| row.get_mut(feasibility::QUANTITY)) {
        quantity.text = format!("{name}: {}", quantity.text);
    }
    match before {
        None => next,
        Some(mut table) => {
            table.rows.append(&mut next.rows);
            table.note = [table.note, next.note].into_iter().flatten().reduce(|a, b| format!("{a} {b}"));
            table
        }
    }
}
