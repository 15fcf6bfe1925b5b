//! Speed over time of a walk whose pace changes.

use super::results::Results;
use crate::page::block::Block;
use crate::page::contract::{Group, Origin, Panel, Role, Trace};
use ambulo_results::PaceChangeSummary;

/// Coordinate of the pelvis along the walk.
const FORWARD: &str = "pelvis_tx";

/// The grid with the speed; `None` for a constant pace.
pub(super) fn group(results: &Results, block: &mut Block) -> Option<Group> {
    let walk = results.summary.walk.as_ref().filter(|walk| !walk.pace_changes.is_empty())?;
    let speed = mean_speed(results.kinematics.column(FORWARD)?, results.grid.step_s, walk.cycle_s);
    let asked = asked(walk.speed_asked_m_s, &walk.pace_changes, &results.times);
    let trace = |name: &str, role: Role, values: &[f64], block: &mut Block, origin: Option<Origin>| Trace {
        name: name.to_owned(),
        side: None,
        role,
        values: block.add(values),
        sd: None,
        predicted: Vec::new(),
        origin,
    };
    let panel = Panel {
        id: "walking_speed".to_owned(),
        title: "Walking speed".to_owned(),
        unit: "m/s".to_owned(),
        positive: String::new(),
        negative: String::new(),
        cycles: Vec::new(),
        means: Vec::new(),
        band: None,
        traces: vec![
            trace("pelvis, mean of a step", Role::Main, &speed, block, None),
            trace("asked", Role::Limit, &asked, block, None),
        ],
        red: Vec::new(),
        empty: None,
        activity: None,
    };
    Some(Group {
        id: "pace".to_owned(),
        title: "Pace".to_owned(),
        note: Some(
            "Forward speed of the pelvis, averaged over one step; dashed: the speed that the gait asks for.".to_owned(),
        ),
        columns: 1,
        panels: vec![panel],
    })
}

/// Mean speed [m/s] over one step of the first pace around each frame; over what there is of it at the ends.
#[must_use]
pub fn mean_speed(place: &[f64], step_s: f64, cycle_s: f64) -> Vec<f64> {
    let half = (0.25 * cycle_s / step_s).round().max(1.0) as usize;
    let last = place.len().saturating_sub(1);
    let around = |frame: usize| (frame.saturating_sub(half), (frame + half).min(last));
    let speed = |(from, to): (usize, usize)| (place[to] - place[from]) / ((to - from).max(1) as f64 * step_s);
    (0..place.len()).map(|frame| speed(around(frame))).collect()
}

/// The planned speed: straight lines from the pace before to the pace after each change.
#[must_use]
pub fn asked(first: f64, changes: &[PaceChangeSummary], times: &[f64]) -> Vec<f64> {
    let at = |time_s: f64| {
        changes.iter().fold(first, |speed, change| {
            let share = ((time_s - change.start_s) / change.duration_s).clamp(0.0, 1.0);
            speed + share * (change.speed_m_s - speed)
        })
    };
    times.iter().map(|time_s| at(*time_s)).collect()
}
