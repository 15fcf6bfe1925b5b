//! Legs whose points move as one rigid piece: a program filled them in while the person was out of view.
//!
//! The angles of knee and ankle of a person always change a little, and a network never finds the same place twice.
//! Where the distances from hip to ankle and from knee to foot stay the same while the hip moves, no camera saw the
//! leg.

use crate::model::Side;
use crate::model::marker_set::{Landmark, RecognisedMarkers};
use crate::motion::{MarkerPath, MarkerRecording};
use crate::numerics::median;
use crate::spatial::{Vec3, angle_between};

/// Distances are the same if they differ by less within [`SPAN_S`] [m]: the rounding of files that have tenths of a
/// millimetre.
const SAME_M: f64 = 0.0002;
/// A hip that moves less within [`SPAN_S`] stands still [m].
const MOVES_M: f64 = 0.001;
const SPAN_S: f64 = 0.2;

/// How often the points of a leg move as one rigid piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrozenLegs {
    /// Share of the time in which the hips move.
    pub share: f64,
    /// Median angle of the thigh from the vertical in that time [rad]; not a number if there is none.
    pub thigh_from_vertical: f64,
}

impl FrozenLegs {
    pub(super) fn of(recording: &MarkerRecording, recognised: &RecognisedMarkers) -> FrozenLegs {
        let (mut moving, mut angles) = (0_usize, Vec::new());
        for side in Side::BOTH {
            let path = |landmark| recording.marker(recognised.on(landmark, Some(side))?);
            let foot = || path(Landmark::Hallux).or_else(|| path(Landmark::SmallToe)).or_else(|| path(Landmark::Heel));
            let (Some(hip), Some(knee), Some(ankle), Some(foot)) =
                (path(Landmark::HipCentre), path(Landmark::KneeCentre), path(Landmark::AnkleCentre), foot())
            else {
                continue;
            };
            let leg = PointsOfLeg { hip, knee, ankle, foot };
            let span = ((SPAN_S * recording.rate_hz).ceil() as usize).max(2);
            for first in 0..recording.frames().saturating_sub(span) {
                let frames = first..first + span + 1;
                if leg.travel(frames.clone()) > MOVES_M {
                    moving += 1;
                    if leg.is_rigid(frames) {
                        angles.push(angle_between(&(hip.positions[first] - knee.positions[first]), &Vec3::y()));
                    }
                }
            }
        }
        let share = if moving > 0 { angles.len() as f64 / moving as f64 } else { 0.0 };
        FrozenLegs { share, thigh_from_vertical: median(angles).unwrap_or(f64::NAN) }
    }
}

struct PointsOfLeg<'a> {
    hip: &'a MarkerPath,
    knee: &'a MarkerPath,
    ankle: &'a MarkerPath,
    foot: &'a MarkerPath,
}

impl PointsOfLeg<'_> {
    /// How far the hip is from its first position at most [m]; not a number if it is not seen then.
    fn travel(&self, mut frames: std::ops::Range<usize>) -> f64 {
        let first = self.hip.positions[frames.start];
        frames
            .try_fold(0.0, |most: f64, frame| {
                let away = (self.hip.positions[frame] - first).norm();
                away.is_finite().then(|| most.max(away))
            })
            .unwrap_or(f64::NAN)
    }

    /// Whether the distances across knee and ankle stay the same.
    fn is_rigid(&self, frames: std::ops::Range<usize>) -> bool {
        let stays = |a: &MarkerPath, b: &MarkerPath| {
            let distances = frames.clone().map(|frame| (a.positions[frame] - b.positions[frame]).norm());
            let [low, high] = distances.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], distance| {
                if distance.is_finite() {
                    [low.min(distance), high.max(distance)]
                } else {
                    [f64::NEG_INFINITY, f64::INFINITY]
                }
            });
            high - low < SAME_M
        };
        stays(self.hip, self.ankle) && stays(self.knee, self.foot)
    }
}
