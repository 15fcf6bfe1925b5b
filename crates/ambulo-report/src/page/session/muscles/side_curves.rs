//! A panel of one quantity of both legs, from its values over time.

use crate::page::block::Block;
use crate::page::contract::{CycleCurve, MeanCurve, Origin, Panel, Role, Trace};
use crate::page::session::curves::{mean_curve, over_cycles};
use crate::page::session::results::Results;
use crate::page::session::sides;
use ambulo::model::{BySide, Side};

/// A quantity of one leg over time, as displayed.
pub(super) struct SideCurve {
    /// One value per instant.
    pub(super) values: Vec<f64>,
    /// Its column, if it is the value of one column.
    pub(super) origin: Option<Origin>,
}

/// A quantity of both legs; a leg without it has none.
pub(super) type SideCurves = BySide<Option<SideCurve>>;

/// Id, title, unit and the meaning of positive and negative values.
pub(super) struct Head<'a> {
    pub(super) id: &'a str,
    pub(super) title: &'a str,
    pub(super) unit: &'a str,
    pub(super) directions: [&'a str; 2],
}

/// The panel; it depends on the ground forces, so that times without measured forces are marked.
pub(super) fn panel(results: &Results, head: &Head<'_>, curves: &SideCurves, block: &mut Block) -> Panel {
    let (cycles, means) = over_the_cycle(results, curves, block);
    Panel {
        id: head.id.to_owned(),
        title: head.title.to_owned(),
        unit: head.unit.to_owned(),
        positive: head.directions[0].to_owned(),
        negative: head.directions[1].to_owned(),
        cycles,
        means,
        band: None,
        traces: traces(results, curves, Role::Main, block),
        red: Vec::new(),
        empty: None,
        activity: None,
    }
}

/// Curves of every cycle, and their means.
pub(super) fn over_the_cycle(
    results: &Results,
    curves: &SideCurves,
    block: &mut Block,
) -> (Vec<CycleCurve>, Vec<MeanCurve>) {
    let (mut cycles, mut means) = (Vec::new(), Vec::new());
    for side in Side::BOTH {
        let Some(SideCurve { values, origin }) = &curves[side] else { continue };
        let shown = over_cycles(results, side, values, origin.as_ref());
        means.extend(mean_curve(results, side, &shown, block));
        cycles.extend(shown.into_iter().map(|curve| curve.added(block)));
    }
    (cycles, means)
}

/// The quantity over time.
pub(super) fn traces(results: &Results, curves: &SideCurves, role: Role, block: &mut Block) -> Vec<Trace> {
    let trace = |side: Side| {
        let curve = curves[side].as_ref()?;
        let is_computed = role == Role::Main;
        Some(Trace {
            name: if is_computed { side.to_string() } else { format!("{side}, measured") },
            side: Some(sides::page(side)),
            role,
            values: block.add(&curve.values),
            sd: None,
            predicted: if is_computed { results.predicted_times(side) } else { Vec::new() },
            origin: curve.origin.clone(),
        })
    };
    Side::BOTH.into_iter().filter_map(trace).collect()
}
