//! What was seen of landmarks in a frame.

use crate::model::Side;
use crate::model::marker_set::{Landmark, NamedMarker, Recognised};
use crate::motion::MarkerRecording;
use crate::spatial::Vec3;

/// Markers named in a message at most.
const MOST_NAMES: usize = 12;

/// A recording seen as landmarks.
#[derive(Debug)]
pub(super) struct Sight<'a> {
    pub(super) recording: &'a MarkerRecording,
    /// Markers whose meaning is known, with their number in the recording.
    pub(super) markers: Vec<(&'a NamedMarker, usize)>,
    /// Names of the marker sets.
    pub(super) sets: &'a [String],
}

impl<'a> Sight<'a> {
    pub(super) fn new(recording: &'a MarkerRecording, recognised: &'a Recognised) -> Sight<'a> {
        let number =
            |m: &'a NamedMarker| recording.markers.iter().position(|path| path.name == m.name).map(|index| (m, index));
        Sight { recording, markers: recognised.markers.iter().filter_map(number).collect(), sets: &recognised.sets }
    }

    /// Number of the marker on a landmark.
    fn number(&self, landmark: Landmark, side: Option<Side>) -> Option<usize> {
        let is_it =
            |(m, _): &&(&NamedMarker, usize)| m.definition.landmark == Some(landmark) && m.definition.side == side;
        self.markers.iter().find(is_it).map(|(_, index)| *index)
    }

    /// Whether the recording has a landmark at all.
    pub(super) fn has(&self, landmark: Landmark, side: Option<Side>) -> bool {
        self.number(landmark, side).is_some()
    }

    /// A landmark in a frame [m], if it was seen.
    pub(super) fn at(&self, landmark: Landmark, side: Option<Side>, frame: usize) -> Option<Vec3> {
        self.place(self.number(landmark, side)?, frame)
    }

    /// A landmark of one side in a frame [m], if it was seen.
    pub(super) fn of(&self, landmark: Landmark, side: Side, frame: usize) -> Option<Vec3> {
        self.at(landmark, Some(side), frame)
    }

    /// A marker of the recording in a frame [m], if it was seen.
    pub(super) fn place(&self, number: usize, frame: usize) -> Option<Vec3> {
        let place = *self.recording.markers.get(number)?.positions.get(frame)?;
        place.iter().all(|x| x.is_finite()).then_some(place)
    }

    /// The landmarks that the recording has, in words.
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
            return format!("none, the markers are called {}{more}", names[..shown].join(", "));
        }
        words.join(", ")
    }
}
