//! Marker trajectories in metres; gaps are not-a-number.

use super::clock::clock_of_table;
use super::guessed_unit::metres_per_unit;
use super::real_points::{real_points, shared_prefix};
use crate::findings::{Code, Findings};
use crate::numerics::median;
use crate::spatial::{Mat3, Vec3};
use ambulo_formats::c3d::{C3d, Point};
use ambulo_formats::trc::Trc;
use std::ops::Range;

/// Marker trajectories. From a file they are in the axes of the laboratory; [`MarkerRecording::rotated`] rotates them
/// to world axes.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerRecording {
    /// Name of their source, for messages.
    pub name: String,
    /// Frame rate [Hz].
    pub rate_hz: f64,
    /// Times [s], strictly increasing.
    pub times: Vec<f64>,
    /// The markers, in the order of the file.
    pub markers: Vec<MarkerPath>,
}

/// The trajectory of one marker.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerPath {
    /// Name in the file, without the prefix of the subject.
    pub name: String,
    /// Position [m], one per frame; not a number in gaps.
    pub positions: Vec<Vec3>,
}

/// Largest possible distance from the origin, in any unit [m].
const FARTHEST_M: f64 = 1e6;

/// Why markers cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MarkerError {
    /// No marker is visible in any frame.
    #[error(
        "no marker was seen in any of the {frames} frames of {} (listed: {listed}); expected at least one. hint: check \
         that this is the recording of the trial, and that its markers are labelled",
        shown(name)
    )]
    NoMarker {
        /// Name of their source.
        name: String,
        /// Number of frames of the recording.
        frames: usize,
        /// First marker names of the recording.
        listed: String,
    },
    /// Two points for most names, at different places.
    #[error(
        "{count} names have two points each, {apart_m:.1} m apart (first {listed}): the markers are those of two \
         people; expected one person. hint: export one person, or give the markers of each a prefix with the name, \
         such as `Anna:LASI`"
    )]
    TwoPeople {
        /// Number of names with two points.
        count: usize,
        /// Median distance of the two points [m].
        apart_m: f64,
        /// The first of these names.
        listed: String,
    },
    /// Lengths without a unit.
    #[error(
        "the markers have the unit `{found}` (POINT:UNITS), and their size is that of no person in mm, cm or m; \
         expected a unit of length such as mm. hint: set POINT:UNITS in the file"
    )]
    Unit {
        /// The unit in the file.
        found: String,
    },
    /// Times that do not increase.
    #[error(
        "frame {frame} of {}: time {later} s comes after {earlier} s; expected increasing times. hint: sort the rows, \
         or cut the file where the clock was reset",
        shown(name)
    )]
    TimeNotRising {
        /// Name of their source.
        name: String,
        /// Frame, counted from 1.
        frame: usize,
        /// The time before [s].
        earlier: f64,
        /// The time that follows [s].
        later: f64,
    },
}

impl MarkerPath {
    /// Whether the marker is visible in a frame.
    #[must_use]
    pub fn is_seen(&self, frame: usize) -> bool {
        self.positions.get(frame).is_some_and(is_finite)
    }
}

impl MarkerRecording {
    /// The smallest change of any coordinate: the resolution of the file [m].
    pub(super) fn resolution_m(&self) -> f64 {
        let paths = self.markers.iter().map(|marker| &marker.positions);
        let pairs = paths.flat_map(|path| path.windows(2));
        let changes = pairs.flat_map(|pair| [0, 1, 2].map(|axis| (pair[1][axis] - pair[0][axis]).abs()));
        changes.filter(|change| *change > 0.0).fold(f64::INFINITY, f64::min)
    }

    /// Number of frames.
    #[must_use]
    pub fn frames(&self) -> usize {
        self.times.len()
    }

    /// The marker with exactly this name.
    #[must_use]
    pub fn marker(&self, name: &str) -> Option<&MarkerPath> {
        self.markers.iter().find(|marker| marker.name == name)
    }

    /// Removes the frames at both ends in which less than half of the markers are visible: the person walks into and
    /// out of the view of the cameras. Returns the whole recording if no frames would be left.
    #[must_use]
    pub fn trimmed_to_visible(&self) -> MarkerRecording {
        let ever_seen: Vec<&MarkerPath> =
            self.markers.iter().filter(|marker| (0..self.frames()).any(|frame| marker.is_seen(frame))).collect();
        let enough = |frame: &usize| 2 * ever_seen.iter().filter(|m| m.is_seen(*frame)).count() >= ever_seen.len();
        let first = (0..self.frames()).find(enough).unwrap_or(0);
        let last = (0..self.frames()).rev().find(enough).unwrap_or(self.frames().saturating_sub(1));
        self.part(first..last.saturating_add(1))
    }

    /// The frames in a range; the whole recording if it does not have them all.
    #[must_use]
    pub fn part(&self, frames: Range<usize>) -> MarkerRecording {
        let cut = |path: &MarkerPath| MarkerPath {
            name: path.name.clone(),
            positions: path.positions.get(frames.clone()).unwrap_or(&path.positions).to_vec(),
        };
        MarkerRecording {
            name: self.name.clone(),
            rate_hz: self.rate_hz,
            times: self.times.get(frames.clone()).unwrap_or(&self.times).to_vec(),
            markers: self.markers.iter().map(cut).collect(),
        }
    }

    /// At most this many frames, evenly spread over the recording.
    #[must_use]
    pub fn sample(&self, most: usize) -> MarkerRecording {
        let step = self.frames().div_ceil(most.max(1)).max(1);
        let path = |path: &MarkerPath| MarkerPath {
            name: path.name.clone(),
            positions: path.positions.iter().copied().step_by(step).collect(),
        };
        MarkerRecording {
            name: self.name.clone(),
            rate_hz: self.rate_hz / step as f64,
            times: self.times.iter().copied().step_by(step).collect(),
            markers: self.markers.iter().map(path).collect(),
        }
    }

    /// The trajectories in rotated axes: `world_from_lab * p`.
    #[must_use]
    pub fn rotated(&self, world_from_lab: &Mat3) -> MarkerRecording {
        let turn = |path: &MarkerPath| MarkerPath {
            name: path.name.clone(),
            positions: path.positions.iter().map(|p| world_from_lab * p).collect(),
        };
        MarkerRecording {
            name: self.name.clone(),
            rate_hz: self.rate_hz,
            times: self.times.clone(),
            markers: self.markers.iter().map(turn).collect(),
        }
    }
}

/// Reads the markers of a TRC file, in the axes of the laboratory.
///
/// Some programs write gaps as positions of exactly 0 0 0; these are read as gaps and reported.
///
/// # Errors
/// Times that do not increase, no visible marker.
pub fn markers_from_trc(trc: &Trc, findings: &mut Findings) -> Result<MarkerRecording, MarkerError> {
    let paths = trc.markers().iter().map(|marker| MarkerPath {
        name: marker.name.clone(),
        positions: marker.positions_m.iter().map(|p| Vec3::from(*p)).collect(),
    });
    let recording = MarkerRecording {
        name: trc.name.clone(),
        rate_hz: trc.rate_hz,
        times: clock_of_table("", trc.times(), Some(trc.frames()), Some(trc.rate_hz), findings),
        markers: paths.collect(),
    };
    checked(recording, findings)
}

/// Reads the markers of a C3D file, in the axes of the laboratory.
///
/// Points with angles, forces, moments, powers or scalars, computed points (axes and joint centres of
/// Plug-in Gait), and unlabelled ones (`*7`, no name) are left out. A prefix of the subject that all labels share is
/// removed: `Anna:LASI` becomes `LASI`. Of two points with the same name the one that is visible longer is kept.
///
/// # Errors
/// A unit of length that is neither stated nor inferred from the size of the markers, times that do not increase, no
/// visible marker.
pub fn markers_from_c3d(file: &C3d, findings: &mut Findings) -> Result<MarkerRecording, MarkerError> {
    let Some(unit_m) = metres_per_unit(file, findings) else {
        return Err(MarkerError::Unit { found: file.point_unit.clone() });
    };
    let points = real_points(file);
    let names: Vec<&str> = points.iter().map(|p| p.name.as_str()).collect();
    let prefix = shared_prefix(&names);
    let path = |point: &&Point| MarkerPath {
        name: point.name[prefix..].to_owned(),
        positions: point.positions.iter().map(|p| Vec3::from(*p) * unit_m).collect(),
    };
    let recording = MarkerRecording {
        name: String::new(),
        rate_hz: file.point_rate_hz,
        times: file.times(),
        markers: one_of_each_name(points.iter().map(path).collect(), findings)?,
    };
    checked(recording, findings)
}

/// The name of a recording for messages; some formats have none.
fn shown(name: &str) -> String {
    if name.is_empty() { "the recording".to_owned() } else { format!("`{name}`") }
}

/// Checks the recording and reads zeros as gaps.
pub(super) fn checked(mut recording: MarkerRecording, findings: &mut Findings) -> Result<MarkerRecording, MarkerError> {
    if let Some(i) = (1..recording.frames()).find(|&i| recording.times[i - 1] >= recording.times[i]) {
        let (earlier, later) = (recording.times[i - 1], recording.times[i]);
        return Err(MarkerError::TimeNotRising { name: recording.name, frame: i + 1, earlier, later });
    }
    read_zeros_as_gaps(&mut recording, findings);
    drop_impossible_places(&mut recording, findings);
    if !recording.markers.iter().any(|m| m.positions.iter().any(is_finite)) {
        let listed: Vec<&str> = recording.markers.iter().take(6).map(|m| m.name.as_str()).collect();
        let listed = if listed.is_empty() { "none".to_owned() } else { listed.join(", ") };
        return Err(MarkerError::NoMarker { frames: recording.frames(), listed, name: recording.name });
    }
    Ok(recording)
}

fn read_zeros_as_gaps(recording: &mut MarkerRecording, findings: &mut Findings) {
    let mut names = Vec::new();
    let mut count = 0;
    for marker in &mut recording.markers {
        let before = count;
        for position in marker.positions.iter_mut().filter(|p| **p == Vec3::zeros()) {
            *position = Vec3::repeat(f64::NAN);
            count += 1;
        }
        if count > before {
            names.push(marker.name.as_str());
        }
    }
    if count > 0 {
        let message = format!("{count} positions of exactly 0 0 0 were read as gaps; markers: {}", names.join(", "));
        findings.report(Code::MarkersZeroIsGap, message);
    }
}

/// Reads impossible positions, as in broken files, as gaps.
fn drop_impossible_places(recording: &mut MarkerRecording, findings: &mut Findings) {
    let possible = |p: &Vec3| p.iter().all(|x| x.abs() < FARTHEST_M);
    let mut count = 0;
    for position in recording.markers.iter_mut().flat_map(|m| &mut m.positions) {
        if !possible(position) {
            count += usize::from(!position.iter().any(|x| x.is_nan()));
            *position = Vec3::repeat(f64::NAN);
        }
    }
    if count > 0 {
        let message = format!("{count} positions further than {FARTHEST_M} m from the origin were read as gaps");
        findings.report(Code::MarkersImpossible, message);
    }
}

fn is_finite(position: &Vec3) -> bool {
    position.iter().all(|x| x.is_finite())
}

/// Keeps one trajectory per name: the one that is visible longest, at the position of the first. If most names of a
/// body have two points at different places, these are two persons.
fn one_of_each_name(paths: Vec<MarkerPath>, findings: &mut Findings) -> Result<Vec<MarkerPath>, MarkerError> {
    let seen = |path: &MarkerPath| (0..path.positions.len()).filter(|&i| path.is_seen(i)).count();
    let mut kept: Vec<MarkerPath> = Vec::new();
    let mut twice: Vec<(String, f64)> = Vec::new();
    for path in paths {
        match kept.iter_mut().find(|k| k.name == path.name) {
            None => kept.push(path),
            Some(before) => {
                twice.extend(distance(before, &path).map(|apart_m| (path.name.clone(), apart_m)));
                let message = format!("two points are named {}; the one that is visible longer was kept", path.name);
                findings.report(Code::MarkersNameTwice, message);
                if seen(&path) > seen(before) {
                    *before = path;
                }
            }
        }
    }
    twice.retain(|(_, apart_m)| *apart_m > FROM_PERSON_TO_PERSON_M);
    if twice.len() < OF_A_PERSON {
        return Ok(kept);
    }
    let listed: Vec<&str> = twice.iter().take(3).map(|(name, _)| name.as_str()).collect();
    let apart_m = median(twice.iter().map(|(_, apart_m)| *apart_m)).unwrap_or(f64::NAN);
    Err(MarkerError::TwoPeople { count: twice.len(), apart_m, listed: listed.join(", ") })
}

/// Two persons are further apart than a marker and its ghost [m].
const FROM_PERSON_TO_PERSON_M: f64 = 0.2;
/// Fewest markers of a person: a pelvis and two legs.
const OF_A_PERSON: usize = 8;

/// Median distance of two points in the frames that have both [m]; `None` without such a frame.
fn distance(a: &MarkerPath, b: &MarkerPath) -> Option<f64> {
    let both = (0..a.positions.len()).filter(|&i| a.is_seen(i) && b.is_seen(i));
    median(both.map(|i| (a.positions[i] - b.positions[i]).norm()))
}
