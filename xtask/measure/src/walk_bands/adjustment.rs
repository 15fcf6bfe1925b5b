//! Difference of a consistent walk from its original gait.

use ambulo::gait::WalkCoordinates;
use ambulo::model::anthropometry::Human;
use ambulo::simulation::consistent_walk::ConsistentWalk;

/// Instants per cycle that are evaluated.
const INSTANTS: usize = 200;

/// Departure of one coordinate over a cycle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Adjustment {
    pub(super) what: &'static str,
    /// `deg` or `mm`.
    pub(super) unit: &'static str,
    pub(super) rms: f64,
    pub(super) largest: f64,
}

/// Coordinate, its name on the page, and whether its mean is removed because it has no meaning (start position, leg
/// length).
const COORDINATES: [(&str, &str, bool); 8] = [
    ("hip_flexion_r", "hip", false),
    ("knee_angle_r", "knee", false),
    ("ankle_angle_r", "ankle", false),
    ("mtp_angle_r", "toes, from straight", false),
    ("pelvis_tilt", "pelvis tilt", false),
    ("lumbar_extension", "trunk against pelvis", false),
    ("pelvis_tx", "mid-hip forward, from constant speed", true),
    ("pelvis_ty", "mid-hip height, from its mean", true),
];

/// Departures of a walk's coordinates from the gait's; the left leg's are the right one's half a cycle later.
pub(super) fn adjustments(human: &Human, walk: &ConsistentWalk) -> Vec<Adjustment> {
    let model = &human.model;
    let gait = WalkCoordinates::of(model);
    let zeros = || vec![0.0; model.coordinates().len()];
    let (mut rates, mut accelerations) = (zeros(), zeros());
    let mut departures: Vec<Vec<f64>> = Vec::with_capacity(INSTANTS);
    for k in 0..INSTANTS {
        let time_s = walk.walk().cycle_s() * k as f64 / INSTANTS as f64;
        let (mut before, mut posture) = (zeros(), [zeros(), zeros(), zeros()]);
        gait.write(&walk.walk().at(time_s), &mut before, &mut rates, &mut accelerations);
        walk.write(time_s, &mut posture);
        if let Some(forward) = model.coordinate("pelvis_tx") {
            before[forward.index()] = walk.walk().speed() * time_s;
        }
        departures.push(posture[0].iter().zip(&before).map(|(after, before)| after - before).collect());
    }
    let of = |&(name, what, without_mean): &(&'static str, &'static str, bool)| {
        let id = model.coordinate(name)?.index();
        let column: Vec<f64> = departures.iter().map(|row| row[id]).collect();
        let (unit, scale) = if name.starts_with("pelvis_t") && !name.ends_with("tilt") {
            ("mm", 1e3)
        } else {
            ("deg", 1f64.to_degrees())
        };
        let mean = if without_mean { column.iter().sum::<f64>() / column.len() as f64 } else { 0.0 };
        let sizes: Vec<f64> = column.iter().map(|value| scale * (value - mean).abs()).collect();
        let rms = (sizes.iter().map(|size| size * size).sum::<f64>() / sizes.len() as f64).sqrt();
        Some(Adjustment { what, unit, rms, largest: sizes.into_iter().fold(0.0, f64::max) })
    };
    COORDINATES.iter().filter_map(of).collect()
}
