//! Messages of a stream: lines of JSON, or records of 32-bit numbers.

use super::line_text::{text, without_nan};
use crate::args::{LabAxes, MarkerUnit};
use anyhow::{Result, anyhow, bail};
use serde::{Deserialize, Serialize};

/// A message to the command.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Message {
    /// Names of the coordinates in the order of the values that follow.
    pub coordinates: Option<Vec<String>>,
    /// Unit of angles that follow.
    pub angles: Option<AngleUnit>,
    /// Number of the frame.
    pub frame: Option<u64>,
    /// Time of the frame [s].
    pub(super) time: Option<f64>,
    /// Values of the frame; missing ones are null, or not-a-number in a record.
    pub q: Option<Vec<Option<f64>>>,
    /// Names of the markers, or their positions in a frame.
    pub(super) markers: Option<Markers>,
    /// Unit of positions that follow.
    pub(super) unit: Option<MarkerUnit>,
    /// Axes of positions that follow: which of the laboratory's points forward and which up.
    pub(super) axes: Option<LabAxes>,
    /// Whether the values come from a record, in which they have no name.
    #[serde(skip)]
    pub(super) is_record: bool,
}

/// Names of markers or their positions.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(untagged)]
pub(super) enum Markers {
    Names(Vec<String>),
    /// Null for a marker that is not seen.
    Positions(Vec<Option<[Option<f64>; 3]>>),
}

impl Message {
    /// Whether the message describes the coordinates of frames or their unit.
    pub(super) fn names_coordinates(&self) -> bool {
        self.coordinates.is_some() || self.angles.is_some()
    }

    /// Whether the message has content.
    pub(super) fn has_content(&self) -> bool {
        self.names_coordinates() || self.names_markers() || self.q.is_some() || self.markers.is_some()
    }

    /// Whether the message describes the markers of frames, or their unit and axes.
    pub(super) fn names_markers(&self) -> bool {
        self.marker_names().is_some() || self.unit.is_some() || self.axes.is_some()
    }

    /// Names of the markers of frames.
    pub(super) fn marker_names(&self) -> Option<&[String]> {
        match &self.markers {
            Some(Markers::Names(names)) => Some(names),
            _ => None,
        }
    }

    /// The values of a frame one after the other; `None` if the message has no frame.
    pub(super) fn values(&self) -> Option<Vec<Option<f64>>> {
        match (&self.q, &self.markers) {
            (None, Some(Markers::Positions(positions))) => {
                Some(positions.iter().flat_map(|place| place.unwrap_or_default()).collect())
            }
            (q, _) => q.clone(),
        }
    }
}

/// Unit of angles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum AngleUnit {
    /// Radians.
    Rad,
    /// Degrees.
    Deg,
}

/// Describes frames and results: names, units, rate and delay.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Description {
    pub(crate) model: String,
    pub(crate) rate_hz: f64,
    pub(crate) delay_frames: usize,
    /// Coordinates of a frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) coordinates: Option<Vec<String>>,
    /// Markers of a frame, with their unit and axes.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub(crate) markers: Option<MarkerDescription>,
    /// Names and units of the values of a result.
    pub(crate) columns: Vec<String>,
    pub(crate) units: Vec<&'static str>,
}

/// Describes frames of markers.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct MarkerDescription {
    /// Their names.
    pub(crate) markers: Vec<String>,
    pub(crate) unit: MarkerUnit,
    /// Axes of the laboratory that point forward and up.
    pub(crate) axes: LabAxes,
}

/// A message of the command other than the description.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub(super) enum Answer {
    Forces {
        frame: u64,
        time: f64,
        values: Vec<f32>,
    },
    /// A notice about the frames.
    Notice {
        notice: &'static str,
        #[serde(skip_serializing_if = "Option::is_none")]
        frame: Option<u64>,
        message: String,
    },
}

/// Reads a line.
///
/// # Errors
/// A line that is no message.
pub fn from_json(line: &[u8]) -> Result<Message> {
    let line = text(line);
    let read = serde_json::from_slice(&line).or_else(|error| match without_nan(&line) {
        readable if readable != line => serde_json::from_slice(&readable),
        _ => Err(error),
    });
    read.map_err(|error| {
        // A message is one line, so that the number of the line is always 1.
        let what = error.to_string().replace(" at line 1 column", " at column");
        anyhow!(
            "a line that is no message ({what}); expected a frame, {{\"frame\": 0, \"q\": [...]}} or with \
            --markers {{\"frame\": 0, \"markers\": [...]}}"
        )
    })
}

/// Bytes of a record with this number of values.
#[must_use]
pub fn record_bytes(values: usize) -> usize {
    4 * (values + 1)
}

/// Reads a record.
///
/// # Errors
/// A record of another size.
pub fn from_record(record: &[u8], values: usize) -> Result<Message> {
    if record.len() != record_bytes(values) {
        let expected = record_bytes(values);
        bail!("a record of {} bytes; expected {expected}, the number of the frame and {values} values", record.len());
    }
    let mut words = record.chunks_exact(4).map(|word| [word[0], word[1], word[2], word[3]]);
    let frame = words.next().map(|word| u64::from(u32::from_le_bytes(word)));
    let q = words.map(f32::from_le_bytes).map(|x| (!x.is_nan()).then_some(f64::from(x))).collect();
    Ok(Message { frame, q: Some(q), is_record: true, ..Message::default() })
}

/// Appends a line.
pub(super) fn to_json(message: &impl Serialize, out: &mut Vec<u8>) {
    // Writing to memory does not fail, and these structures have no keys that JSON refuses.
    let _ = serde_json::to_writer(&mut *out, message);
    out.push(b'\n');
}

/// Appends a record.
pub fn to_record(frame: u64, values: &[f32], out: &mut Vec<u8>) {
    // Numbers go on from zero after the largest.
    out.extend((frame as u32).to_le_bytes());
    out.extend(values.iter().flat_map(|value| value.to_le_bytes()));
}
