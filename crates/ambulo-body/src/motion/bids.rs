//! Markers and joint angles of BIDS motion data.
//!
//! Three channels of the type POS with the components x, y and z and the same tracked point are a marker. A channel of
//! the type JNTANG is a coordinate of a model if its name or tracked point names the coordinate; so is a POS
//! channel with the name of a translation. Pinned by: tests/bids_recordings.rs

use super::import::coordinates_from_table;
use super::marker_recording::{MarkerError, MarkerPath, MarkerRecording, checked};
use super::recording::{Motion, MotionError};
use crate::findings::{Code, Findings};
use crate::model::Model;
use crate::spatial::Vec3;
use ambulo_formats::bids_motion::{BidsChannel, BidsMotion};
use ambulo_formats::table::Table;

/// Fewest tracked points by which a motion is one of markers.
const FEWEST_MARKERS: usize = 4;
const POSITION: &str = "POS";
const ANGLE: &str = "JNTANG";
const TIME: &str = "LATENCY";

/// Why a BIDS motion cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BidsError {
    /// Neither a frame rate nor times.
    #[error(
        "no frame rate; expected `SamplingFrequency` in the _motion.json next to the file, or a channel of the type \
         LATENCY"
    )]
    NoRate,
    /// A unit that is not known for this type of channel.
    #[error("the channel `{channel}` of the type {kind} has the unit `{found}`; expected {expected}")]
    Unit {
        /// The channel.
        channel: String,
        /// Type of the channel.
        kind: String,
        /// Unit of the channel.
        found: String,
        /// Known units.
        expected: &'static str,
    },
    /// Neither markers nor joint angles.
    #[error(
        "fewer than four tracked points with positions (POS in x, y and z), and no joint angles (JNTANG); found \
         channels of the types {found}"
    )]
    Nothing {
        /// The types.
        found: String,
    },
    /// Markers that cannot be used.
    #[error(transparent)]
    Markers(#[from] MarkerError),
    /// Coordinates that cannot be used.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// Columns that are no table.
    #[error(transparent)]
    Table(#[from] ambulo_formats::Error),
}

/// The columns of a tracked point.
fn tracked(bids: &BidsMotion) -> Vec<(&str, [usize; 3])> {
    let mut found: Vec<(&str, [usize; 3])> = Vec::new();
    for (k, channel) in bids.channels.iter().enumerate().filter(|(_, channel)| channel.kind == POSITION) {
        let point = channel.tracked_point.as_str();
        let of = |axis: &str| {
            bids.channels.iter().position(|c| c.kind == POSITION && c.tracked_point == point && c.component == axis)
        };
        if let (true, Some(x), Some(y), Some(z)) =
            (channel.component == "x" && !point.is_empty(), of("x"), of("y"), of("z"))
            && x == k
        {
            found.push((point, [x, y, z]));
        }
    }
    found
}

/// Whether the motion is one of markers, rather than of joint angles.
///
/// # Errors
/// Neither.
pub fn is_bids_markers(bids: &BidsMotion) -> Result<bool, BidsError> {
    if tracked(bids).len() >= FEWEST_MARKERS {
        return Ok(true);
    }
    if bids.channels.iter().any(|channel| channel.kind == ANGLE) {
        return Ok(false);
    }
    let mut kinds: Vec<&str> = bids.channels.iter().map(|channel| channel.kind.as_str()).collect();
    kinds.sort_unstable();
    kinds.dedup();
    Err(BidsError::Nothing { found: kinds.join(", ") })
}

/// Times of the frames, and their rate: by the channel of times, or by the frame rate.
fn times(bids: &BidsMotion, rate_hz: Option<f64>) -> Result<(Vec<f64>, f64), BidsError> {
    let latency = bids.channels.iter().position(|channel| channel.kind == TIME).map(|k| bids.columns[k].clone());
    if let Some(times) = latency.filter(|times| times.iter().all(|t| t.is_finite())) {
        let lasts_s = times.last().zip(times.first()).map_or(0.0, |(last, first)| last - first);
        let rate_hz = if lasts_s > 0.0 { (times.len() - 1) as f64 / lasts_s } else { 1.0 };
        return Ok((times, rate_hz));
    }
    let rate_hz = rate_hz.or(bids.rate_hz).filter(|rate| rate.is_finite() && *rate > 0.0).ok_or(BidsError::NoRate)?;
    Ok(((0..bids.frames()).map(|frame| frame as f64 / rate_hz).collect(), rate_hz))
}

/// The factor from the unit of a channel to metres or radians.
fn factor(channel: &BidsChannel) -> Result<f64, BidsError> {
    let (known, expected): (&[(&str, f64)], _) = match channel.kind.as_str() {
        ANGLE => (&[("rad", 1.0), ("deg", 1_f64.to_radians()), ("°", 1_f64.to_radians())], "rad or deg"),
        _ => (&[("m", 1.0), ("cm", 0.01), ("mm", 0.001)], "m, cm or mm"),
    };
    let found = known.iter().find(|(unit, _)| *unit == channel.units).map(|(_, factor)| *factor);
    found.ok_or_else(|| BidsError::Unit {
        channel: channel.name.clone(),
        kind: channel.kind.clone(),
        found: channel.units.clone(),
        expected,
    })
}

/// The markers; `rate_hz` is the frame rate of the `_motion.json`. Channels that are marked as bad are gaps, with a
/// finding.
///
/// # Errors
/// No frame rate, unknown units, no visible marker.
pub fn markers_from_bids(
    bids: &BidsMotion,
    rate_hz: Option<f64>,
    name: &str,
    findings: &mut Findings,
) -> Result<MarkerRecording, BidsError> {
    let (times, rate_hz) = times(bids, rate_hz)?;
    let mut markers = Vec::new();
    let mut bad = Vec::new();
    for (point, columns) in tracked(bids) {
        let channels = columns.map(|k| &bids.channels[k]);
        let is_bad = channels.iter().any(|channel| channel.is_bad);
        bad.extend(is_bad.then_some(point));
        let mut metres = [0.0; 3];
        for (metres, channel) in metres.iter_mut().zip(channels) {
            *metres = if is_bad { f64::NAN } else { factor(channel)? };
        }
        let place = |frame: usize| Vec3::from_fn(|axis, _| bids.columns[columns[axis]][frame] * metres[axis]);
        markers.push(MarkerPath { name: point.to_owned(), positions: (0..times.len()).map(place).collect() });
    }
    if !bad.is_empty() {
        let message = format!("{name}: tracked points that the channels mark as bad were not used: {}", bad.join(", "));
        findings.report(Code::FileOdd, message);
    }
    Ok(checked(MarkerRecording { name: name.to_owned(), rate_hz, times, markers }, findings)?)
}

/// The coordinates of a model.
///
/// # Errors
/// No frame rate, unknown units, no channel of a coordinate of the model.
pub fn coordinates_from_bids(
    model: &Model,
    bids: &BidsMotion,
    rate_hz: Option<f64>,
    name: &str,
    findings: &mut Findings,
) -> Result<Motion, BidsError> {
    let mut columns = vec![("time".to_owned(), times(bids, rate_hz)?.0)];
    for (channel, values) in bids.channels.iter().zip(&bids.columns) {
        let known = [&channel.name, &channel.tracked_point].into_iter().find(|name| model.coordinate(name).is_some());
        let title = match (known, channel.kind.as_str()) {
            (Some(known), ANGLE | POSITION) => known,
            (None, ANGLE) => &channel.name,
            _ => continue,
        };
        let factor = factor(channel)?;
        if columns.iter().all(|(other, _)| other != title) {
            columns.push((title.clone(), values.iter().map(|value| value * factor).collect()));
        }
    }
    let mut table = Table::new(name, columns)?;
    table.in_degrees = Some(false);
    Ok(coordinates_from_table(model, &table, name, findings)?)
}
