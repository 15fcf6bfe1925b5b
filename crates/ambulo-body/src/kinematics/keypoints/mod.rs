//! Keypoints of video: joint centres, heels and toes that a network located, each in every frame by itself.
//!
//! They jitter by 3 to 30 mm, some are far away, and their errors differ between joints, networks and views. So nothing
//! is assumed about them: the noise of each point is estimated from its own recording, the path is smoothed, and only
//! then are positions far from their path left out, never most of a frame.
//!
//! Pinned by: tests/keypoints.rs

mod frozen;
mod robust_path;

use crate::findings::{Code, Findings};
use crate::model::marker_set::{MarkerSet, RecognisedMarkers};
use crate::motion::{MarkerPath, MarkerRecording};
use crate::numerics::median;
use crate::spatial::Vec3;
pub use frozen::FrozenLegs;
use robust_path::RobustPath;

/// At most this share of the points of a frame are outliers: where more are far from their paths, the paths are wrong.
const MOST_OUTLIERS: f64 = 0.5;
/// Smooth positions are continued across gaps of at most this length [s], as coordinates are.
const LONGEST_GAP_S: f64 = 0.35;
/// And beyond the first and the last position that is used by at most this length [s].
const LONGEST_END_S: f64 = 0.1;

/// Noise and faults of a recording of keypoints.
#[derive(Debug, Clone, PartialEq)]
pub struct KeypointReport {
    /// Noise of each point, in the order of the recording.
    pub points: Vec<PointNoise>,
    /// Legs whose points move as one rigid piece.
    pub frozen: FrozenLegs,
    /// Standard deviation of the axial rotation of the thighs, mean of both sides [rad]; not a number if it is not
    /// fitted.
    pub thigh_rotation: f64,
}

/// Noise of one keypoint.
#[derive(Debug, Clone, PartialEq)]
pub struct PointNoise {
    /// Its name.
    pub name: String,
    /// Standard deviation of the jitter along one axis [m]; not a number if it is hardly seen.
    pub jitter_m: f64,
    /// Frames in which it is seen.
    pub seen: usize,
    /// Frames in which it is far from its path, and left out.
    pub outliers: usize,
}

/// Keypoints with their noise.
#[derive(Debug, Clone)]
#[doc(hidden)]
pub struct Keypoints {
    /// As recorded, without outliers.
    pub(crate) observed: MarkerRecording,
    /// On their smooth paths, also where they are outliers or missing for a short time.
    pub smooth: MarkerRecording,
    pub(crate) report: KeypointReport,
}

impl Keypoints {
    /// The points of a recording in world axes. `None` if it has markers on the pelvis, or names that are not
    /// recognised.
    pub fn recognised(recording: &MarkerRecording, set: Option<&MarkerSet>) -> Option<Keypoints> {
        let names = recording.markers.iter().map(|marker| marker.name.as_str());
        let recognised = RecognisedMarkers::with(set, names).ok()?;
        recognised.has_hips_only().then(|| Keypoints::of(recording, &recognised))
    }

    /// Estimates the noise of every point from the recording.
    fn of(recording: &MarkerRecording, recognised: &RecognisedMarkers) -> Keypoints {
        let paths: Vec<Option<RobustPath>> =
            recording.markers.iter().map(|marker| RobustPath::through(&marker.positions)).collect();
        let far: Vec<Vec<bool>> = (0..recording.frames()).map(|frame| outliers_in(recording, &paths, frame)).collect();
        let [longest, ends] = [LONGEST_GAP_S, LONGEST_END_S].map(|gap_s| (gap_s * recording.rate_hz) as usize);
        let mut points = Vec::new();
        let (mut observed, mut smooth) = (recording.clone(), recording.clone());
        for (i, path) in paths.iter().enumerate() {
            let marker = &recording.markers[i];
            let kept: Vec<bool> = far.iter().enumerate().map(|(frame, far)| marker.is_seen(frame) && !far[i]).collect();
            points.push(PointNoise {
                name: marker.name.clone(),
                jitter_m: path.as_ref().map_or(f64::NAN, |path| path.noise_m),
                seen: (0..recording.frames()).filter(|frame| marker.is_seen(*frame)).count(),
                outliers: far.iter().filter(|far| far[i]).count(),
            });
            hide(&mut observed.markers[i], &kept);
            if let Some(path) = path {
                smooth.markers[i].positions.clone_from(&path.smooth);
                hide(&mut smooth.markers[i], &bridged(&kept, longest, ends));
            }
        }
        let frozen = FrozenLegs::of(recording, recognised);
        Keypoints { observed, smooth, report: KeypointReport { points, frozen, thigh_rotation: f64::NAN } }
    }

    /// States the noise.
    pub(crate) fn report_noise(&self, findings: &mut Findings) {
        let points = &self.report.points;
        let known = || points.iter().filter(|point| point.jitter_m.is_finite());
        let Some(worst) = known().max_by(|a, b| a.jitter_m.total_cmp(&b.jitter_m)) else { return };
        let usual = median(known().map(|point| point.jitter_m)).unwrap_or(f64::NAN);
        let count = |of: fn(&PointNoise) -> usize| points.iter().map(of).sum::<usize>();
        let (seen, outliers) = (count(|point| point.seen), count(|point| point.outliers));
        let most = points.iter().max_by_key(|point| point.outliers).filter(|point| point.outliers > 0);
        let most = most.map_or(String::new(), |most| format!(", most of `{}` ({})", most.name, most.outliers));
        findings.report(
            Code::KeypointsNoise,
            format!(
                "the points are keypoints of video; by the recording itself they jitter by {:.1} mm along each axis \
                 (standard deviation, median; `{}` most, {:.1} mm), and {outliers} of {seen} positions are far from \
                 their paths and left out{most}",
                1e3 * usual,
                worst.name,
                1e3 * worst.jitter_m
            ),
        );
    }
}

/// Which points are far from their paths in a frame; none if most are.
fn outliers_in(recording: &MarkerRecording, paths: &[Option<RobustPath>], frame: usize) -> Vec<bool> {
    let far: Vec<bool> = paths.iter().map(|path| path.as_ref().is_some_and(|path| path.outlier[frame])).collect();
    let seen = recording.markers.iter().filter(|marker| marker.is_seen(frame)).count();
    let count = far.iter().filter(|far| **far).count();
    if count as f64 > MOST_OUTLIERS * seen as f64 { vec![false; far.len()] } else { far }
}

/// Removes the positions that are not kept.
fn hide(marker: &mut MarkerPath, kept: &[bool]) {
    let hidden = marker.positions.iter_mut().zip(kept).filter(|(_, kept)| !**kept);
    hidden.for_each(|(position, _)| *position = Vec3::repeat(f64::NAN));
}

/// Frames that are kept, those in gaps between them of at most `longest` frames, and at most `ends` at both ends.
fn bridged(kept: &[bool], longest: usize, ends: usize) -> Vec<bool> {
    let mut all = kept.to_vec();
    let frames: Vec<usize> = (0..kept.len()).filter(|frame| kept[*frame]).collect();
    for pair in frames.windows(2).filter(|pair| pair[1] - pair[0] - 1 <= longest) {
        all[pair[0]..pair[1]].fill(true);
    }
    if let [first, .., last] = frames[..] {
        all[first.saturating_sub(ends)..first].fill(true);
        let end = last.saturating_add(ends).saturating_add(1).min(kept.len());
        all[last..end].fill(true);
    }
    all
}
