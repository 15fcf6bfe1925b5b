//! Positions of landmarks over the frames of a recording, in any axes, and the directions of the body that do not
//! depend on the sides of the labels.

use crate::model::Side;
use crate::model::marker_set::{Landmark, MarkerSet, RecognisedMarkers};
use crate::motion::MarkerRecording;
use crate::numerics::sampled;
use crate::spatial::Vec3;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Largest number of frames that are looked at, spread over the recording.
const MOST_FRAMES: usize = 100;

/// The two front points of a foot, the best first.
pub(super) const FRONTS: [Landmark; 5] =
    [Landmark::SecondToe, Landmark::Hallux, Landmark::FirstMetatarsal, Landmark::FifthMetatarsal, Landmark::SmallToe];
pub(super) const ANKLES: [Landmark; 3] = [Landmark::LateralMalleolus, Landmark::AnkleCentre, Landmark::MedialMalleolus];
const REARS: [Landmark; 4] =
    [Landmark::Heel, Landmark::LateralMalleolus, Landmark::AnkleCentre, Landmark::MedialMalleolus];

/// A recording with the landmarks of its markers.
pub(super) struct LandmarkPaths<'a> {
    pub(super) recording: &'a MarkerRecording,
    pub(super) recognised: Arc<RecognisedMarkers>,
    numbers: BTreeMap<(Landmark, Option<Side>), usize>,
    /// The direction to the right in each of [`LandmarkPaths::frames`], which depends on no labels of sides.
    rights: Arc<Vec<Option<Vec3>>>,
}

impl<'a> LandmarkPaths<'a> {
    /// `None` if the names belong to no marker set.
    pub(super) fn of(recording: &'a MarkerRecording, set: Option<&MarkerSet>) -> Option<LandmarkPaths<'a>> {
        let names = || recording.markers.iter().map(|marker| marker.name.as_str());
        let recognised = RecognisedMarkers::with(set, names()).ok()?;
        let number = |name: &str| names().position(|known| known == name);
        let numbers = recognised
            .markers
            .iter()
            .filter_map(|marker| Some(((marker.definition.landmark?, marker.definition.side), number(&marker.name)?)));
        let numbers = numbers.collect();
        let recognised = Arc::new(recognised);
        let mut paths = LandmarkPaths { recording, recognised, numbers, rights: Arc::default() };
        paths.rights = Arc::new(paths.frames().map(|frame| paths.right(frame)).collect());
        Some(paths)
    }

    /// The same landmarks in a recording with the same markers.
    pub(super) fn with<'b>(&self, recording: &'b MarkerRecording) -> LandmarkPaths<'b> {
        LandmarkPaths {
            recording,
            recognised: Arc::clone(&self.recognised),
            numbers: self.numbers.clone(),
            rights: Arc::clone(&self.rights),
        }
    }

    /// Frames spread over the recording.
    pub(super) fn frames(&self) -> impl Iterator<Item = usize> + use<> {
        sampled(self.recording.frames(), MOST_FRAMES)
    }

    /// The frames in which the direction to the right is known, with it.
    pub(super) fn facing(&self) -> impl Iterator<Item = (usize, Vec3)> {
        self.frames().zip(self.rights.iter()).filter_map(|(frame, right)| Some((frame, (*right)?)))
    }

    /// Number of a marker in the recording.
    pub(super) fn number(&self, name: &str) -> Option<usize> {
        self.recording.markers.iter().position(|marker| marker.name == name)
    }

    /// A marker in a frame, if it is visible.
    pub(super) fn place(&self, number: usize, frame: usize) -> Option<Vec3> {
        let marker = &self.recording.markers[number];
        marker.is_seen(frame).then(|| marker.positions[frame])
    }

    pub(super) fn at(&self, landmark: Landmark, side: Option<Side>, frame: usize) -> Option<Vec3> {
        self.place(*self.numbers.get(&(landmark, side))?, frame)
    }

    /// The first of some landmarks that is visible on a side.
    pub(super) fn first(&self, landmarks: &[Landmark], side: Side, frame: usize) -> Option<Vec3> {
        landmarks.iter().find_map(|landmark| self.at(*landmark, Some(side), frame))
    }

    /// Midway between both sides of the first of some landmarks that is visible on both.
    fn middle(&self, landmarks: &[Landmark], frame: usize) -> Option<Vec3> {
        landmarks.iter().find_map(|landmark| {
            let [right, left] = Side::BOTH.map(|side| self.at(*landmark, Some(side), frame));
            Some((right? + left?) * 0.5)
        })
    }

    /// Back of the pelvis: midway between the posterior spines, or the sacrum.
    pub(super) fn back_of_pelvis(&self, frame: usize) -> Option<Vec3> {
        self.middle(&[Landmark::Psis], frame).or_else(|| self.at(Landmark::Sacrum, None, frame))
    }

    /// The direction to the right of the person that follows from up (feet to pelvis) and forward (heels to toes, back
    /// to front of the pelvis); it does not change when left and right labels are exchanged. `None` where pelvis and
    /// feet face different ways, or are not seen.
    fn right(&self, frame: usize) -> Option<Vec3> {
        let pelvis = self.middle(&[Landmark::Asis, Landmark::HipCentre, Landmark::Psis], frame)?;
        let up = (pelvis - self.middle(&ANKLES, frame)?).try_normalize(f64::MIN_POSITIVE)?;
        let level = |v: Vec3| (v - up * v.dot(&up)).try_normalize(f64::MIN_POSITIVE);
        let of_pelvis = self.middle(&[Landmark::Asis], frame).zip(self.back_of_pelvis(frame));
        let of_pelvis = of_pelvis.and_then(|(front, back)| level(front - back));
        let foot = |side: Side| Some(self.first(&FRONTS, side, frame)? - self.first(&REARS, side, frame)?);
        let of_feet = foot(Side::Right).zip(foot(Side::Left)).and_then(|(right, left)| level(right + left));
        let forward = match (of_pelvis, of_feet) {
            (Some(pelvis), Some(feet)) if pelvis.dot(&feet) <= 0.0 => return None,
            (Some(pelvis), Some(feet)) => level(pelvis + feet)?,
            (pelvis, feet) => pelvis.or(feet)?,
        };
        Some(forward.cross(&up))
    }
}
