//! Coordinates of pelvis and legs that a recording does not measure.
//!
//! | coordinate | why it is not measured |
//! |---|---|
//! | held: one value in every frame | no marker, sensor or column determines it; an anatomical angle of a moving person is never constant |
//! | on its limit in more than a tenth of the frames | the fit stops at the limit: a marker is misplaced, or the joint was folded in the wrong direction |
//!
//! The ranges are passive ranges of joints ([`crate::model::anthropometry`]), which walking does not reach for a tenth
//! of the time. Toes, arms and trunk are left out: clinical tables do not have the first two, and many laboratories
//! record none of them.

use crate::findings::{Code, Findings};
use crate::model::{Coordinate, CoordinateId, Drive, Model, Movement};
use crate::motion::Motion;
use crate::numerics::degrees;

/// Largest share of the frames on a limit.
const ON_LIMIT: f64 = 0.1;
/// Largest distance of a coordinate from the limit on which it counts as being [rad, m]: the fit ends exactly on it.
const AT_M: f64 = 1e-9;

/// A coordinate that is not measured.
struct NotMeasured {
    coordinate: CoordinateId,
    /// The reason, as words that follow the name of the coordinate in messages.
    why: String,
    is_held: bool,
}

/// Finds and reports the coordinates of a fitted motion that are not measured. Each is returned with whether it is
/// held.
pub(super) fn not_measured(model: &Model, motion: &Motion, findings: &mut Findings) -> Vec<(CoordinateId, bool)> {
    let asked = || model.coordinate_ids().filter(|id| is_asked(model, *id));
    let found: Vec<NotMeasured> = asked().filter_map(|id| of_coordinate(model, motion, id)).collect();
    // A figure in which nothing moves is still, not unmeasured.
    if found.iter().filter(|one| one.is_held).count() == asked().count() {
        return Vec::new();
    }
    if let Some(first) = found.first() {
        let name = |one: &NotMeasured| format!("`{}` {}", model.coordinates()[one.coordinate.index()].name, one.why);
        let listed: Vec<String> = found.iter().map(name).collect();
        let of_joints = if found.len() > 1 { "these joints" } else { "this joint" };
        let cause = match first.is_held {
            true => "markers of the segment are missing in the standing trial or in the motion",
            false => "markers may be misplaced or exchanged",
        };
        let message = format!(
            "not measured: {}; clinical tables and scores leave them out, and powers of {of_joints} are no results. \
             hint: \
             {cause}",
            listed.join(", ")
        );
        findings.report(Code::MarkersNotMeasured, message);
    }
    found.into_iter().map(|one| (one.coordinate, one.is_held)).collect()
}

/// Whether a coordinate is free and measures a movement that clinical tables have.
fn is_asked(model: &Model, id: CoordinateId) -> bool {
    let is_free = matches!(model.coordinates()[id.index()].drive, Drive::Free);
    is_free && model.anatomy().meaning(id).is_some_and(|meaning| is_clinical(meaning.movement))
}

fn of_coordinate(model: &Model, motion: &Motion, id: CoordinateId) -> Option<NotMeasured> {
    let coordinate = &model.coordinates()[id.index()];
    if motion.times.len() < 2 {
        return None;
    }
    let Some(column) = motion.column(id) else {
        let why = format!("is held at {}, because nothing recorded determines it", shown(coordinate.default_value));
        return Some(NotMeasured { coordinate: id, why, is_held: true });
    };
    let known: Vec<f64> = column.iter().copied().filter(|value| value.is_finite()).collect();
    let first = *known.first()?;
    // Equal to the last bit: a measured angle never is.
    if known.iter().all(|value| value.to_bits() == first.to_bits()) {
        let why = format!("is held at {} in every frame", shown(first));
        return Some(NotMeasured { coordinate: id, why, is_held: true });
    }
    on_limit(coordinate, &known).map(|why| NotMeasured { coordinate: id, why, is_held: false })
}

/// Movements that clinical tables and scores have.
fn is_clinical(movement: Movement) -> bool {
    use Movement as M;
    let of_pelvis = [M::PelvicTilt, M::PelvicObliquity, M::PelvicRotation];
    let of_legs = [M::HipFlexion, M::HipAdduction, M::HipRotation, M::KneeFlexion, M::AnkleDorsiflexion];
    of_pelvis.contains(&movement) || of_legs.contains(&movement)
}

fn on_limit(coordinate: &Coordinate, known: &[f64]) -> Option<String> {
    let [least, most] = coordinate.range?;
    let share =
        |limit: f64| known.iter().filter(|value| (**value - limit).abs() < AT_M).count() as f64 / known.len() as f64;
    let limit = if share(least) > share(most) { least } else { most };
    let share = share(limit);
    (share > ON_LIMIT).then(|| {
        format!(
            "sits on its limit of {} in {:.0} % of the frames (at most {:.0} %)",
            shown(limit),
            100.0 * share,
            100.0 * ON_LIMIT
        )
    })
}

fn shown(angle: f64) -> String {
    degrees(angle.to_degrees())
}
