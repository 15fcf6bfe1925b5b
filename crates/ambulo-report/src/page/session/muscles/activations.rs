//! Panels of activation: one per group of muscles, with electromyograms where the recording has them.
//!
//! A panel shows the mean over the muscles of its group, each with the same weight.

use super::muscle_groups::{GROUPS, MuscleGroup, Part, known};
use super::side_curves::{Head, SideCurve, over_the_cycle, panel, traces};
use crate::page::block::Block;
use crate::page::contract::{Activity, Group, Origin, Panel, Role};
use crate::page::session::results::Results;
use ambulo::model::{BySide, Side};
use ambulo::numerics::correlation;
use ambulo_formats::table::Table;
use ambulo_results::{EMG, MUSCLES};

/// A column of a muscle: its part of the group, its name, and one value per instant.
type Column<'a> = (&'static Part, &'a str, &'a [f64]);

/// The grid; `None` without muscles of known names.
pub(super) fn group(results: &Results, block: &mut Block) -> Option<Group> {
    let table = results.muscles.as_ref()?;
    let panels: Vec<Panel> = GROUPS.iter().filter_map(|group| panel_of(results, table, group, block)).collect();
    let measured = if results.emg.is_some() {
        " Thin black lines: envelope of the electromyogram, divided by its 99th percentile."
    } else {
        ""
    };
    let note = format!(
        "Activation from static optimisation, 0 (at rest) to 1 (fully active): the mean of the muscles of each panel. \
         It is an estimate of the model.{measured}"
    );
    (!panels.is_empty()).then(|| Group {
        id: "muscles".to_owned(),
        title: "Muscles".to_owned(),
        note: Some(note),
        columns: 3,
        panels,
    })
}

/// Whether a muscle has a panel.
pub(super) fn is_shown(results: &Results) -> bool {
    let muscles = results.muscles.iter().flat_map(|table| table.columns());
    let mut muscles = muscles.filter_map(|(name, _)| name.strip_suffix("_activation"));
    muscles.any(|muscle| GROUPS.iter().any(|group| known(group, muscle).is_some()))
}

fn panel_of(results: &Results, table: &Table, group: &'static MuscleGroup, block: &mut Block) -> Option<Panel> {
    let computed = columns(table, group, "_activation");
    let curves = computed.as_ref().map(|columns| mean(columns, MUSCLES));
    if curves.values().all(Option::is_none) {
        return None;
    }
    let head =
        Head { id: &format!("{}_activation", group.id), title: group.title, unit: "", directions: ["active", ""] };
    let mut panel = panel(results, &head, &curves, block);
    if let Some(emg) = &results.emg {
        let measured = columns(emg, group, "_emg");
        let envelopes = measured.as_ref().map(|columns| mean(columns, EMG));
        panel.traces.extend(traces(results, &envelopes, Role::Measured, block));
        let (_, means) = over_the_cycle(results, &envelopes, block);
        let agreement = agreement(group, &computed, &measured);
        let is_known = !means.is_empty() || agreement.is_some();
        panel.activity = is_known.then(|| Activity { measured: means, usual: Vec::new(), agreement });
    }
    Some(panel)
}

/// The columns of a group with this ending, of both legs.
fn columns<'a>(table: &'a Table, group: &'static MuscleGroup, ending: &str) -> BySide<Vec<Column<'a>>> {
    let mut found: BySide<Vec<Column<'a>>> = BySide { right: Vec::new(), left: Vec::new() };
    for (name, values) in table.columns() {
        if let Some((side, part)) = name.strip_suffix(ending).and_then(|muscle| known(group, muscle)) {
            found[side].push((part, name, values));
        }
    }
    found
}

/// The mean of columns, instant by instant; `None` without columns.
fn mean(columns: &[Column<'_>], file: &str) -> Option<SideCurve> {
    let (_, first, values) = columns.first()?;
    let at = |i: usize| columns.iter().map(|(.., values)| values[i]).sum::<f64>() / columns.len() as f64;
    let origin = Origin { file: file.to_owned(), column: (*first).to_owned(), factor: 1.0 };
    Some(SideCurve { values: (0..values.len()).map(at).collect(), origin: (columns.len() == 1).then_some(origin) })
}

/// Correlation of each electromyogram with the activation of the same muscle, or with that of the group if the model
/// does not divide it; `None` without electromyograms.
fn agreement(
    group: &MuscleGroup,
    computed: &BySide<Vec<Column<'_>>>,
    measured: &BySide<Vec<Column<'_>>>,
) -> Option<String> {
    let words = |(side, (part, _, emg)): (Side, &Column<'_>)| {
        let own: Vec<Column<'_>> =
            computed[side].iter().filter(|(known, ..)| known.words == part.words).copied().collect();
        let activation = mean(if own.is_empty() { &computed[side] } else { &own }, MUSCLES)?;
        let whole = part.words == group.title.to_lowercase();
        let name = if whole { String::new() } else { format!(" {}", part.words) };
        Some(format!("{side}{name} {:.2}", correlation(&activation.values, emg)))
    };
    let pairs = Side::BOTH.into_iter().flat_map(|side| measured[side].iter().map(move |column| (side, column)));
    let list: Vec<String> = pairs.filter_map(words).collect();
    (!list.is_empty()).then(|| format!("r with the electromyogram: {}", list.join(", ")))
}
