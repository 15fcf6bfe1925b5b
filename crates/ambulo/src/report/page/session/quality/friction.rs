//! Friction that the feet use: horizontal over vertical ground force.

use super::{FRICTION, group, over_time};
use crate::analysis::feasibility::Thresholds;
use crate::model::Side;
use crate::report::page::block::Block;
use crate::report::page::contract::{Group, Role, Trace};
use crate::report::page::session::results::Results;
use crate::report::page::session::sides;

/// Both feet over time with the limit; `None` without ground forces.
pub(super) fn friction(results: &Results, block: &mut Block) -> Option<Group> {
    let usual = Thresholds::default();
    let used: Vec<(Side, Vec<f64>)> = Side::BOTH
        .into_iter()
        .filter_map(|side| Some((side, use_of(results, side, usual.friction_load_bw * results.weight_n)?)))
        .filter(|(_, values)| values.iter().any(|x| x.is_finite()))
        .collect();
    if used.is_empty() {
        return None;
    }
    let trace =
        |name: &str, side, role, values| Trace { name: name.to_owned(), side, role, values, sd: None, origin: None };
    let mut traces: Vec<Trace> = used
        .iter()
        .map(|(side, values)| trace(&side.to_string(), Some(sides::page(*side)), Role::Main, block.add(values)))
        .collect();
    let limit = results.limit("friction").unwrap_or(usual.friction);
    traces.push(trace("limit", None, Role::Limit, block.add(&vec![limit; results.grid.frames])));
    let note = format!(
        "Horizontal over vertical force of each foot while it carries at least {:.1} body weights; the limit is {limit:.2}.",
        usual.friction_load_bw
    );
    let panel = over_time([FRICTION, "Friction used", ""], ["", ""], traces);
    Some(group("friction", "Friction use", note, 1, vec![panel]))
}

/// Not a number while the foot carries too little.
fn use_of(results: &Results, side: Side, least_n: f64) -> Option<Vec<f64>> {
    let table = results.ground.as_ref()?;
    let [x, y, z] = ["x", "y", "z"].map(|axis| table.column(&format!("ground_force_{}_v{axis}", side.letter())));
    let triples = x?.iter().zip(y?).zip(z?);
    Some(triples.map(|((x, y), z)| if *y >= least_n { x.hypot(*z) / y } else { f64::NAN }).collect())
}
