//! The place of the root by the feet on the ground.
//!
//! A sensor shows how a segment is turned, not where it is. With the root at the origin, forward kinematics gives the
//! points k of the soles, x_k(t). The lowest ones are on the ground and do not move: the root is at
//!
//!   height:  h(t) = -Σ w_k y_k / Σ w_k           along the floor:  p(t+dt) = p(t) - Σ w_k (x_k(t+dt) - x_k(t)) / Σ w_k
//!
//!   w_k = exp(-(y_k - y_min)/ε) exp(-|v_k - v_min|²/2σ²)
//!
//! where v_k is the velocity of the point relative to the root, and v_min the same velocity of the lowest point: points
//! that are on the ground together move alike. ε and σ make the change from one point to the next smooth. The
//! increments along the floor use the mean weights of both frames.
//!
//! A foot is on the ground at every instant: flight is not detected, and its height is wrong.
//! Pinned by: tests/sensor_fit.rs

use super::SensorError;
use crate::findings::{Code, Findings};
use crate::model::anatomy::{Sole, SolePoint};
use crate::model::{BySide, Displacement, JointAxis, Model, ModelPosture};
use crate::motion::Motion;
use crate::numerics::elementary::exp;
use crate::spatial::Vec3;

/// ε: heights within which points of the soles share the contact [m]; soles of models are known to some millimetres.
const SHARED_M: f64 = 0.006;
/// σ: differences of velocity within which points share the contact [m/s]; a swinging toe passes the ground with some 3
/// m/s.
const ALIKE_M_S: f64 = 0.3;

/// Whether a coordinate only moves the root along a direction.
pub(super) fn moves_root(model: &Model, coordinate: &str) -> bool {
    let follows = |axis: &JointAxis| match &axis.displacement {
        Displacement::Follows(id, _) => model.coordinates()[id.index()].name == coordinate,
        Displacement::Fixed(_) => false,
    };
    model.bodies().first().is_some_and(|root| root.joint.translations.iter().any(follows))
}

/// Writes the coordinates of the place of the root.
pub(super) fn on_the_ground(
    model: &Model,
    soles: &BySide<Option<Sole>>,
    motion: &mut Motion,
    findings: &mut Findings,
) -> Result<(), SensorError> {
    let points: Vec<SolePoint> = soles.values().flatten().flat_map(|sole| sole.points).collect();
    if soles.values().any(|sole| sole.is_none()) {
        return Err(SensorError::NoFeet { model: model.name().to_owned() });
    }
    let axes = root_axes(model)?;
    let up = model.up();
    let places = sole_paths(model, motion, &points, &axes);
    let path = root_path(&motion.times, &places, up);
    for (column, axis, [value, slope]) in axes {
        let moved = path.iter().map(|place| (place.dot(&axis) - value) / slope);
        motion.columns[column] = Some(moved.collect());
    }
    let mut known = path.iter().filter(|place| place.iter().all(|x| x.is_finite()));
    let way = known
        .next()
        .zip(known.next_back())
        .map_or(0.0, |(first, last)| (last - first - up * (last - first).dot(&up)).norm());
    let message = format!(
        "sensors do not show where the person is: the lowest points of the feet were put on a level floor and kept in \
         place, one foot at every instant, which moves the pelvis by {way:.2} m along the floor; running, jumping and \
         stairs come out wrong"
    );
    findings.report(Code::SensorsPlaced, message);
    Ok(())
}

/// A coordinate of the place of the root: its number, its direction in the world, and value and slope of its
/// displacement at zero.
type RootAxis = (usize, Vec3, [f64; 2]);

fn root_axes(model: &Model) -> Result<Vec<RootAxis>, SensorError> {
    let joint = &model.bodies()[0].joint;
    let axis = |axis: &JointAxis| match &axis.displacement {
        Displacement::Follows(id, function) => {
            let [value, slope, ..] = function.at(0.0);
            let direction = joint.parent_from_joint.rotation * axis.direction;
            (slope != 0.0).then_some((id.index(), direction, [value, slope]))
        }
        Displacement::Fixed(_) => None,
    };
    let axes: Vec<RootAxis> = joint.translations.iter().filter_map(axis).collect();
    let is_frame = |axes: &[RootAxis]| match axes {
        [a, b, c] => a.1.cross(&b.1).dot(&c.1).abs() > 1.0 - 1e-6,
        _ => false,
    };
    if is_frame(&axes) { Ok(axes) } else { Err(SensorError::NoTranslation { model: model.name().to_owned() }) }
}

/// Positions of the points of the soles with the root at the origin; not numbers where a coordinate is unknown.
fn sole_paths(model: &Model, motion: &Motion, points: &[SolePoint], axes: &[RootAxis]) -> Vec<Vec<Vec3>> {
    let at = |frame: usize| {
        let value = |column: &Option<Vec<f64>>| column.as_ref().map_or(0.0, |column| column[frame]);
        let mut q: Vec<f64> = motion.columns.iter().map(value).collect();
        for (column, _, [value, slope]) in axes {
            q[*column] = -value / slope;
        }
        let posture = ModelPosture::new(model, q);
        points.iter().map(|point| posture.poses[point.body.index()].place(point.place)).collect()
    };
    (0..motion.times.len()).map(at).collect()
}

/// Positions of the root. Frames that are not known do not move it.
fn root_path(times: &[f64], places: &[Vec<Vec3>], up: Vec3) -> Vec<Vec3> {
    let weights: Vec<Vec<f64>> = (0..places.len()).map(|frame| contact_weights(times, places, frame, up)).collect();
    let mean = |weights: &[f64], vectors: &mut dyn Iterator<Item = Vec3>| {
        weights.iter().zip(vectors).map(|(weight, vector)| *weight * vector).sum::<Vec3>()
    };
    let mut along = Vec3::zeros();
    let mut path = Vec::with_capacity(places.len());
    for frame in 0..places.len() {
        if let Some(before) = frame.checked_sub(1) {
            let shared: Vec<f64> = weights[before].iter().zip(&weights[frame]).map(|(a, b)| (a + b) / 2.0).collect();
            let step = mean(&shared, &mut places[frame].iter().zip(&places[before]).map(|(now, then)| now - then));
            if step.iter().all(|x| x.is_finite()) {
                along -= step - up * step.dot(&up);
            }
        }
        let height = mean(&weights[frame], &mut places[frame].iter().copied()).dot(&up);
        path.push(along - up * height);
    }
    path
}

/// The share of each point in the contact with the ground; together 1.
fn contact_weights(times: &[f64], places: &[Vec<Vec3>], frame: usize, up: Vec3) -> Vec<f64> {
    let heights: Vec<f64> = places[frame].iter().map(|place| place.dot(&up)).collect();
    let Some(lowest) = (0..heights.len()).min_by(|&a, &b| heights[a].total_cmp(&heights[b])) else { return Vec::new() };
    let (before, after) = (frame.saturating_sub(1), (frame + 1).min(places.len() - 1));
    let span = (times[after] - times[before]).max(f64::MIN_POSITIVE);
    let speed = |k: usize| (places[after][k] - places[before][k]) / span;
    let reference = speed(lowest);
    let weight = |k: usize| {
        let above = (heights[k] - heights[lowest]) / SHARED_M;
        let apart = (speed(k) - reference).norm() / ALIKE_M_S;
        exp(-above - 0.5 * apart * apart)
    };
    let weights: Vec<f64> = (0..heights.len()).map(weight).collect();
    let sum: f64 = weights.iter().sum();
    weights.into_iter().map(|weight| weight / sum).collect()
}
