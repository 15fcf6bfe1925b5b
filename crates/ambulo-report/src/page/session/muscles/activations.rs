//! Panels of activation: one per group of muscles, with electromyograms where the recording has them.
//!
//! A panel shows the mean over the muscles of its group, each with the same weight.

use super::muscle_groups::{GROUPS, MuscleColumn, MuscleGroup};
use super::side_curves::{Head, SideCurve, over_the_cycle, panel, traces};
use crate::page::block::Block;
use crate::page::contract::{Activity, Group, Origin, Panel, Role};
use crate::page::session::results::Results;
use ambulo::model::{BySide, Side};
use ambulo::numerics::correlation;
use ambulo_formats::table::Table;
use ambulo_results::{EMG, MUSCLES};

/// The grid; `None` without muscles of known names.
pub(super) fn group(results: &Results, block: &mut Block) -> Option<Group> {
    let table = results.muscles.as_ref()?;
    let panels: Vec<Panel> = GROUPS.iter().filter_map(|group| panel_of(results, table, group, block)).collect();
    (!panels.is_empty()).then(|| Group {
        id: "muscles".to_owned(),
        title: "Muscles".to_owned(),
        note: Some(note(results)),
        columns: 3,
        panels,
    })
}

/// What the curves are.
fn note(results: &Results) -> String {
    let measured = if results.emg.is_some() {
        " Thin black lines: envelope of the electromyogram, divided by its 99th percentile."
    } else {
        ""
    };
    let known: Vec<String> = GROUPS.iter().filter_map(|group| Some(group.usual()?.0.to_string())).collect();
    let usual = if known.is_empty() {
        String::new()
    } else {
        format!(
            " Bars above: percent of the cycle in which at least half of ten adults, at their own speed, have the \
             muscle on ({}; docs/EMG.md).",
            known.join(", ")
        )
    };
    format!(
        "Activation from static optimisation, 0 (at rest) to 1 (fully active): the mean of the muscles of each panel. \
         It is an estimate of the model.{measured}{usual}"
    )
}

/// Whether a muscle has a panel.
pub(super) fn is_shown(results: &Results) -> bool {
    let muscles = results.muscles.iter().flat_map(|table| table.columns());
    let mut muscles = muscles.filter_map(|(name, _)| name.strip_suffix("_activation"));
    muscles.any(|muscle| GROUPS.iter().any(|group| group.known(muscle).is_some()))
}

fn panel_of(results: &Results, table: &Table, group: &MuscleGroup, block: &mut Block) -> Option<Panel> {
    let computed = group.columns(table, "_activation");
    let curves = computed.as_ref().map(|columns| mean(columns, MUSCLES));
    if curves.values().all(Option::is_none) {
        return None;
    }
    let head =
        Head { id: &format!("{}_activation", group.id), title: group.title, unit: "", directions: ["active", ""] };
    let mut panel = panel(results, &head, &curves, block);
    let mut activity = Activity {
        measured: Vec::new(),
        usual: group.usual().map(|(_, times)| times).unwrap_or_default(),
        agreement: None,
    };
    if let Some(emg) = &results.emg {
        let measured = group.columns(emg, "_emg");
        let envelopes = measured.as_ref().map(|columns| mean(columns, EMG));
        panel.traces.extend(traces(results, &envelopes, Role::Measured, block));
        activity.measured = over_the_cycle(results, &envelopes, block).1;
        activity.agreement = agreement(group, &computed, &measured);
    }
    let nothing = activity.measured.is_empty() && activity.usual.is_empty() && activity.agreement.is_none();
    panel.activity = (!nothing).then_some(activity);
    Some(panel)
}

/// The mean of columns, instant by instant; `None` without columns.
fn mean(columns: &[MuscleColumn<'_>], file: &str) -> Option<SideCurve> {
    let (_, first, values) = columns.first()?;
    let at = |i: usize| columns.iter().map(|(.., values)| values[i]).sum::<f64>() / columns.len() as f64;
    let origin = Origin { file: file.to_owned(), column: (*first).to_owned(), factor: 1.0 };
    Some(SideCurve { values: (0..values.len()).map(at).collect(), origin: (columns.len() == 1).then_some(origin) })
}

/// Correlation of each electromyogram with the mean activation of the muscles that share its fibres; `None` without
/// electromyograms.
fn agreement(
    group: &MuscleGroup,
    computed: &BySide<Vec<MuscleColumn<'_>>>,
    measured: &BySide<Vec<MuscleColumn<'_>>>,
) -> Option<String> {
    let words = |(side, (muscle, _, emg)): (Side, &MuscleColumn<'_>)| {
        let shares = |(known, ..): &&MuscleColumn<'_>| known.shares_fibres_with(*muscle);
        let own: Vec<MuscleColumn<'_>> = computed[side].iter().filter(shares).copied().collect();
        let activation = mean(&own, MUSCLES)?;
        let name = muscle.to_string();
        let name = if name == group.title.to_lowercase() { String::new() } else { format!(" {name}") };
        Some(format!("{side}{name} {:.2}", correlation(&activation.values, emg)))
    };
    let pairs = Side::BOTH.into_iter().flat_map(|side| measured[side].iter().map(move |column| (side, column)));
    let list: Vec<String> = pairs.filter_map(words).collect();
    (!list.is_empty()).then(|| format!("r with the electromyogram: {}", list.join(", ")))
}
