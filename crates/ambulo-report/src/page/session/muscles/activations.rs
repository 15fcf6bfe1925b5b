//! Panels of activation: one per group of muscles, with electromyograms where the recording has them.
//!
//! A panel shows the mean over the muscles of its group, each with the same weight.

use super::muscle_groups::{GROUPS, MuscleColumn, MuscleGroup, active_times};
use super::side_curves::{Head, SideCurve, SideCurves, over_the_cycle, panel, traces};
use crate::page::block::Block;
use crate::page::contract::{ActiveTimes, Activity, Group, Origin, Panel, Role};
use crate::page::session::curves::{over_cycles, statistics};
use crate::page::session::results::Results;
use crate::page::session::sides;
use ambulo::model::Side;
use ambulo::muscles::emg::{OnOffSettings, on_off};
use ambulo::study::session::CurveStatistics;
use ambulo_formats::table::Table;
use ambulo_results::{EMG, EmgSummary, MUSCLES};

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
        " Thin black lines: envelope of the electromyogram, divided by its 99th percentile. Bars of the colours of the \
         sides: where its mean is above a fifth of its maximum for at least 5 % of the cycle."
    } else {
        ""
    };
    let known: Vec<String> = GROUPS.iter().filter_map(|group| Some(group.usual()?.0.to_string())).collect();
    let usual = if known.is_empty() {
        String::new()
    } else {
        format!(
            " Grey bars: where the electromyogram of at least half of ten adults, at their own speed, is on \
             (Schreiber and Moissenet 2019: {}).",
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
    let curves = group.columns(table, "_activation").as_ref().map(|columns| mean(columns, MUSCLES));
    if curves.values().all(Option::is_none) {
        return None;
    }
    let head =
        Head { id: &format!("{}_activation", group.id), title: group.title, unit: "", directions: ["active", ""] };
    let mut panel = panel(results, &head, &curves, block);
    let mut activity = Activity {
        measured: Vec::new(),
        recorded: Vec::new(),
        usual: group.usual().map(|(_, times)| times).unwrap_or_default(),
        agreement: agreement(results, group),
    };
    if let Some(emg) = &results.emg {
        let envelopes = group.columns(emg, "_emg").as_ref().map(|columns| mean(columns, EMG));
        panel.traces.extend(traces(results, &envelopes, Role::Measured, block));
        activity.measured = over_the_cycle(results, &envelopes, block).1;
        activity.recorded = recorded(results, &envelopes);
    }
    let nothing = activity.measured.is_empty() && activity.usual.is_empty() && activity.agreement.is_none();
    panel.activity = (!nothing).then_some(activity);
    Some(panel)
}

/// When the mean envelope of each leg is on, by the rule of the usual times.
fn recorded(results: &Results, envelopes: &SideCurves) -> Vec<ActiveTimes> {
    let of_side = |side: Side| {
        let SideCurve { values, .. } = envelopes[side].as_ref()?;
        let CurveStatistics { mean, .. } = statistics(&over_cycles(results, side, values, None))?;
        let times = active_times(&on_off(&mean, OnOffSettings::default()));
        Some(ActiveTimes { side: sides::page(side), times })
    };
    Side::BOTH.into_iter().filter_map(of_side).collect()
}

/// The mean of columns, instant by instant; `None` without columns.
fn mean(columns: &[MuscleColumn<'_>], file: &str) -> Option<SideCurve> {
    let (_, first, values) = columns.first()?;
    let at = |i: usize| columns.iter().map(|(.., values)| values[i]).sum::<f64>() / columns.len() as f64;
    let origin = Origin { file: file.to_owned(), column: (*first).to_owned(), factor: 1.0 };
    Some(SideCurve { values: (0..values.len()).map(at).collect(), origin: (columns.len() == 1).then_some(origin) })
}

/// Correlation of the electromyograms of the group with the activations of the same muscles; `None` without
/// electromyograms.
fn agreement(results: &Results, group: &MuscleGroup) -> Option<String> {
    let words = |compared: &EmgSummary| {
        let EmgSummary { muscle, side, r, .. } = compared;
        let (side, _) = group.known(&format!("{muscle} {side}"))?;
        let name = if *muscle == group.title.to_lowercase() { String::new() } else { format!(" {muscle}") };
        let r = r.map_or_else(|| "-".to_owned(), |r| format!("{r:.2}"));
        Some(format!("{side}{name} {r}"))
    };
    let list: Vec<String> = results.summary.muscles.iter().flat_map(|found| &found.emg).filter_map(words).collect();
    (!list.is_empty()).then(|| format!("r with the electromyogram: {}", list.join(", ")))
}
