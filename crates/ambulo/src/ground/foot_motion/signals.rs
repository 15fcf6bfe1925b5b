//! Signals of the methods: filtered marker paths, their rates, the speed of the floor.

use crate::model::Side;
use crate::motion::filter::{LowPass, low_pass};
use crate::motion::{Landmarks, MarkerRecording};
use crate::numerics::{median, quantiles};
use crate::spatial::Vec3;

/// Low-pass filter of the markers.
const FILTER: LowPass = LowPass { order: 2, cutoff_hz: 10.0 };
/// Gaps up to this long are bridged [s].
const LONGEST_GAP_S: f64 = 0.2;
/// A marker this close to its lowest positions moves with the floor [m].
const ON_FLOOR_M: f64 = 0.01;

/// Filtered paths of one foot; not a number in gaps.
pub(super) struct Foot {
    pub(super) side: Side,
    pub(super) heel: Option<Vec<Vec3>>,
    pub(super) toe: Option<Vec<Vec3>>,
}

pub(super) fn foot(markers: &MarkerRecording, landmarks: &Landmarks, side: Side) -> Foot {
    let of = landmarks.foot(side);
    let path = |marker: Option<usize>| mean_path(markers, &[marker?]);
    Foot { side, heel: path(of.heel.or(of.ankle)), toe: path(of.toe.or(of.side)) }
}

/// Filtered mean of some markers, where all of them are visible.
pub(super) fn mean_path(markers: &MarkerRecording, chosen: &[usize]) -> Option<Vec<Vec3>> {
    let useful =
        |m: &&usize| 2 * (0..markers.frames()).filter(|&i| markers.markers[**m].is_seen(i)).count() > markers.frames();
    let chosen: Vec<usize> = chosen.iter().filter(useful).copied().collect();
    if chosen.is_empty() {
        return None;
    }
    let mean = |i: usize| chosen.iter().map(|&m| markers.markers[m].positions[i]).sum::<Vec3>() / chosen.len() as f64;
    let columns: [Vec<f64>; 3] = std::array::from_fn(|axis| {
        let column: Vec<f64> = (0..markers.frames()).map(|i| mean(i)[axis]).collect();
        smoothed(&column, markers.rate_hz)
    });
    Some((0..markers.frames()).map(|i| Vec3::new(columns[0][i], columns[1][i], columns[2][i])).collect())
}

/// Low-pass filtered between gaps; short gaps are interpolated linearly, long ones stay.
fn smoothed(column: &[f64], rate_hz: f64) -> Vec<f64> {
    let bridged = bridged(column, (LONGEST_GAP_S * rate_hz).round() as usize);
    let mut out = vec![f64::NAN; column.len()];
    let mut start = 0;
    while start < bridged.len() {
        let length = bridged[start..].iter().take_while(|x| x.is_finite()).count();
        let piece = &bridged[start..start + length];
        // Too low a frame rate for the filter: unfiltered.
        let filtered = low_pass(piece, rate_hz, FILTER).unwrap_or_else(|_| piece.to_vec());
        out[start..start + length].copy_from_slice(&filtered);
        start += length.max(1);
    }
    out
}

fn bridged(column: &[f64], longest: usize) -> Vec<f64> {
    let mut out = column.to_vec();
    let known: Vec<usize> = (0..column.len()).filter(|&i| column[i].is_finite()).collect();
    for pair in known.windows(2).filter(|pair| pair[1] - pair[0] > 1 && pair[1] - pair[0] - 1 <= longest) {
        for i in pair[0] + 1..pair[1] {
            let share = (i - pair[0]) as f64 / (pair[1] - pair[0]) as f64;
            out[i] = column[pair[0]] * (1.0 - share) + column[pair[1]] * share;
        }
    }
    out
}

/// Central differences; not a number at the ends and next to gaps.
pub(super) fn rate(column: &[f64], rate_hz: f64) -> Vec<f64> {
    let inside = |i: usize| match (i.checked_sub(1).and_then(|j| column.get(j)), column.get(i + 1)) {
        (Some(before), Some(after)) => (after - before) * 0.5 * rate_hz,
        _ => f64::NAN,
    };
    (0..column.len()).map(inside).collect()
}

pub(super) fn axis(path: &[Vec3], axis: usize) -> Vec<f64> {
    path.iter().map(|p| p[axis]).collect()
}

/// Mean velocity along x from the first to the last visible frame [m/s].
pub(super) fn mean_rate(markers: &MarkerRecording, path: &[Vec3]) -> f64 {
    let seen = |i: &usize| path[*i].x.is_finite();
    let (first, last) = ((0..path.len()).find(seen), (0..path.len()).rfind(seen));
    match (first, last) {
        (Some(a), Some(b)) if b > a => (path[b].x - path[a].x) / (markers.times[b] - markers.times[a]),
        _ => f64::NAN,
    }
}

/// Speed of the floor along x: the median over low positions of heels and toes [m/s].
pub(super) fn floor_speed(markers: &MarkerRecording, feet: &[Foot]) -> f64 {
    let mut speeds = Vec::new();
    for path in feet.iter().flat_map(|f| [&f.heel, &f.toe]).flatten() {
        let heights = axis(path, 1);
        let Some([lowest]) = quantiles(heights.iter().copied(), [0.05]) else { continue };
        let speed = rate(&axis(path, 0), markers.rate_hz);
        let low = (0..path.len()).filter(|&i| heights[i] <= lowest + ON_FLOOR_M && speed[i].is_finite());
        speeds.extend(low.map(|i| speed[i]));
    }
    median(speeds).unwrap_or(0.0)
}
