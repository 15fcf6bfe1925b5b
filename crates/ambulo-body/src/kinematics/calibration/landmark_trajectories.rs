//! Positions of anatomical landmarks in each frame of a recording.

use crate::model::Side;
use crate::model::marker_set::{Landmark, NamedMarker, RecognisedMarkers};
use crate::motion::{MarkerPath, MarkerRecording};
use crate::spatial::Vec3;

/// Largest number of markers named in a message.
const MOST_NAMES: usize = 12;

/// A recording with the landmarks of its markers.
#[derive(Debug)]
pub(super) struct LandmarkTrajectories<'a> {
    pub(super) recording: &'a MarkerRecording,
    /// Recognised markers that are visible in a frame, with their number in the recording.
    pub(super) markers: Vec<(&'a NamedMarker, usize)>,
    /// Names of the marker sets.
    pub(super) sets: &'a [String],
}

impl<'a> LandmarkTrajectories<'a> {
    pub(super) fn new(recording: &'a MarkerRecording, recognised: &'a RecognisedMarkers) -> LandmarkTrajectories<'a> {
        // A marker that is listed but never seen determines nothing: the others of its segment must.
        let is_seen = |path: &MarkerPath| (0..path.positions.len()).any(|frame| path.is_seen(frame));
        let number = |m: &'a NamedMarker| {
            let index = recording.markers.iter().position(|path| path.name == m.name)?;
            is_seen(&recording.markers[index]).then_some((m, index))
        };
        LandmarkTrajectories {
            recording,
            markers: recognised.markers.iter().filter_map(number).collect(),
            sets: &recognised.sets,
        }
    }

    /// Number of the marker on a landmark.
    fn number(&self, landmark: Landmark, side: Option<Side>) -> Option<usize> {
        let is_it =
            |(m, _): &&(&NamedMarker, usize)| m.definition.landmark == Some(landmark) && m.definition.side == side;
        self.markers.iter().find(is_it).map(|(_, index)| *index)
    }

    /// Whether the recording has a landmark.
    pub(super) fn has(&self, landmark: Landmark, side: Option<Side>) -> bool {
        self.number(landmark, side).is_some()
    }

    /// Position of a landmark in a frame [m]; `None` if it is not visible.
    pub(super) fn at(&self, landmark: Landmark, side: Option<Side>, frame: usize) -> Option<Vec3> {
        self.place(self.number(landmark, side)?, frame)
    }

    /// As [`LandmarkTrajectories::at`], for a landmark of one side.
    pub(super) fn of(&self, landmark: Landmark, side: Side, frame: usize) -> Option<Vec3> {
        self.at(landmark, Some(side), frame)
    }

    /// Position of a marker by its number in a frame [m]; `None` if it is not visible.
    pub(super) fn place(&self, number: usize, frame: usize) -> Option<Vec3> {
        let place = *self.recording.markers.get(number)?.positions.get(frame)?;
        place.iter().all(|x| x.is_finite()).then_some(place)
    }

    /// Lists the landmarks of the recording for a message.
    pub(super) fn words(&self) -> String {
        let word = |(m, _): &(&NamedMarker, usize)| {
            let side = m.definition.side.map_or(String::new(), |side| format!(" {}", side.letter()));
            m.definition.landmark.map(|landmark| format!("{}{side}", landmark.word()))
        };
        let words: Vec<String> = self.markers.iter().filter_map(word).collect();
        if words.is_empty() {
            let names: Vec<&str> = self.recording.markers.iter().map(|marker| marker.name.as_str()).collect();
            let shown = names.len().min(MOST_NAMES);
            let rest = names.len() - shown;
            let more = if rest > 0 { format!(" and {rest} more") } else { String::new() };
            return format!("none among the markers {}{more}", names[..shown].join(", "));
        }
        words.join(", ")
    }
}
