//! Required friction coefficient: horizontal over vertical ground force of each foot.

use super::{FRICTION, group, over_time};
use crate::page::block::Block;
use crate::page::contract::{Group, Role, Trace};
use crate::page::session::results::Results;
use crate::page::session::sides;
use ambulo::analysis::feasibility::{Check, Thresholds, least_load_n};
use ambulo::model::Side;
use ambulo::numerics::elementary::hypot;

/// Both feet over time with the limit; `None` without ground forces.
pub(super) fn friction(results: &Results, block: &mut Block) -> Option<Group> {
    let usual = Thresholds::default();
    // The verdict uses the weight of the model; results are normalised by the mass that the plates measured.
    let weight_n = results.body.as_ref().map_or(results.weight_n, |(_, body)| body.mass() * results.gravity());
    let least_n = least_load_n(usual.friction_load_bw, weight_n);
    let used: Vec<(Side, Vec<f64>)> = Side::BOTH
        .into_iter()
        .filter_map(|side| Some((side, use_of(results, side, least_n)?)))
        .filter(|(_, values)| values.iter().any(|x| x.is_finite()))
        .collect();
    if used.is_empty() {
        return None;
    }
    let trace = |name: &str, side, role, values| Trace {
        name: name.to_owned(),
        side,
        role,
        values,
        sd: None,
        predicted: Vec::new(),
        origin: None,
    };
    let mut traces: Vec<Trace> = used
        .iter()
        .map(|(side, values)| trace(&side.to_string(), Some(sides::page(*side)), Role::Main, block.add(values)))
        .collect();
    let limit = results.limit(Check::Friction).unwrap_or(usual.friction);
    traces.push(trace("limit", None, Role::Limit, block.add(&vec![limit; results.grid.frames])));
    let note = format!(
        "Horizontal / vertical force of each foot while its load exceeds {least_n:.0} N ({:.1} body weights, the \
         default of the verdict). The limit is {limit:.2}; the verdict ignores excesses shorter than {} s.",
        usual.friction_load_bw, usual.shortest_s
    );
    let panel = over_time([FRICTION, "Required friction coefficient", ""], ["", ""], traces);
    Some(group("friction", "Friction", note, 1, vec![panel]))
}

/// NaN while the load of the foot is too small.
fn use_of(results: &Results, side: Side, least_n: f64) -> Option<Vec<f64>> {
    let table = results.ground.as_ref()?;
    let [x, y, z] = ["x", "y", "z"].map(|axis| table.column(&format!("ground_force_{}_v{axis}", side.letter())));
    let triples = x?.iter().zip(y?).zip(z?);
    Some(triples.map(|((x, y), z)| if *y > least_n { hypot(*x, *z) / y } else { f64::NAN }).collect())
}
