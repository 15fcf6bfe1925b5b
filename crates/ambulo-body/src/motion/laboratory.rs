//! Determines the axes of a laboratory relative to the world: x forward, y up, z right.
//!
//! **Up** is the direction of the forces of the plates on the feet, and the direction from the feet to pelvis and head;
//! it is rounded to one of the laboratory's axes. **Forward** is the direction in which the pelvis moves; if it does
//! not move (a treadmill, standing), the direction that feet and pelvis face. Within [`SNAP_DEG`] of an axis it is that
//! axis, otherwise the measured heading. The rows of `world_from_lab` are forward, up and right = forward × up.
//!
//! **Unit.** A body of 1800 m was written in millimetres: if the height of the markers is implausible for a person, the
//! power of ten that makes it plausible is used.
//! Pinned by: tests/laboratory.rs, tests/laboratory_files.rs

use super::force_plate::PlateRecording;
use super::landmarks::Landmarks;
use super::marker_recording::{MarkerPath, MarkerRecording};
use super::segment_poses::SegmentPoses;
use crate::findings::{Code, Findings};
use crate::model::Side;
use crate::numerics::elementary::{atan2, cos};
use crate::numerics::{degrees, median};
use crate::spatial::{Mat3, Vec3};

/// A heading closer than this to an axis of the laboratory is rounded to it [deg].
const SNAP_DEG: f64 = 10.0;
/// Largest angle between an upward direction and an axis [deg].
const UPRIGHT_DEG: f64 = 30.0;
/// The body walks if its pelvis moves further than this [m] ...
const WALKED_M: f64 = 0.4;
/// ... and faster than this [m/s].
const WALKED_M_S: f64 = 0.15;
/// A turn: the headings of the first and second half of the path differ by more than this [deg].
const TURN_DEG: f64 = 20.0;
/// Smallest angle between walking and facing direction in sideways walking [deg]; beyond 180° minus this it is
/// backwards.
const SIDEWAYS_DEG: f64 = 60.0;
/// Plausible heights of the markers, from a set for the legs of a child to a tall adult with raised arms [m].
const HEIGHT_M: [f64; 2] = [0.35, 3.0];
/// Factors of wrong units.
const UNIT_FACTORS: [f64; 6] = [0.001, 0.01, 0.1, 10.0, 100.0, 1000.0];
/// Directions are averaged only if the mean of the unit vectors is at least this long.
const LEAST_AGREEMENT: f64 = 0.7;

/// Axes and unit of a laboratory.
#[derive(Debug, Clone, PartialEq)]
pub struct Laboratory {
    /// Rotation from the laboratory's axes to the world's.
    pub world_from_lab: Mat3,
    /// 1, or the factor that corrects a wrong unit.
    pub metres_per_stated_metre: f64,
    /// Method that determined the forward direction.
    pub heading: Heading,
    /// Change of walking direction [deg]; `None` for a straight walk or none.
    pub turn_deg: Option<f64>,
    /// Summary in one line: `lab z up, mm, walking +y -> world x forward, y up, z right, m`.
    pub statement: String,
}

/// Method that determined the forward direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Heading {
    /// The motion of the pelvis.
    Walking,
    /// The facing direction of a body that stays in place.
    Facing,
    /// Unknown; an axis was assumed.
    Unknown,
}

impl Laboratory {
    /// Whether this direction of the laboratory is upwards.
    #[must_use]
    pub fn has_up(&self, direction: Vec3) -> bool {
        (self.world_from_lab * direction).dot(&Vec3::y()) > cos(UPRIGHT_DEG.to_radians())
    }

    /// The same laboratory with the ground axes of a model as world axes; `unit` is for the statement.
    #[must_use]
    pub fn as_ground(self, unit: &str) -> Laboratory {
        let statement = format!("ground of the model: x, y up, z, {unit} -> m");
        Laboratory { world_from_lab: Mat3::identity(), statement, ..self }
    }

    /// Transforms markers to the axes of the world, in metres.
    #[must_use]
    pub fn markers(&self, recording: &MarkerRecording) -> MarkerRecording {
        recording.rotated(&(self.world_from_lab * self.metres_per_stated_metre))
    }

    /// Transforms poses of segments to the axes of the world, in metres.
    #[must_use]
    pub fn poses(&self, poses: &SegmentPoses) -> SegmentPoses {
        poses.transformed(&self.world_from_lab, self.metres_per_stated_metre)
    }

    /// Transforms a plate to the axes of the world. Its unit was corrected when it was read.
    #[must_use]
    pub fn plate(&self, plate: &PlateRecording) -> PlateRecording {
        plate.rotated(&self.world_from_lab)
    }
}

/// Determines the laboratory of a recording from its markers in metres and its plates, both in the laboratory's axes.
/// `unit` is the unit in the file, for the statement.
///
/// Undetermined quantities are reported as warnings.
#[must_use]
pub fn laboratory(
    markers: &MarkerRecording,
    plates: &[PlateRecording],
    unit: &str,
    findings: &mut Findings,
) -> Laboratory {
    laboratory_of_landmarks(markers, &Landmarks::find(markers), plates, unit, findings)
}

/// [`laboratory`] with known landmarks.
#[must_use]
pub fn laboratory_of_landmarks(
    markers: &MarkerRecording,
    landmarks: &Landmarks,
    plates: &[PlateRecording],
    unit: &str,
    findings: &mut Findings,
) -> Laboratory {
    let up = upward(markers, landmarks, plates, findings);
    let scale = scale(markers, landmarks, up, findings);
    let travel = travel(markers, landmarks, plates, up, scale, findings);
    let (forward, heading) = forward(
        travel.map(|travel| travel.direction),
        facing(markers, landmarks, up),
        (up, no_facing(landmarks)),
        findings,
    );
    let right = forward.cross(&up);
    let way = match heading {
        Heading::Walking => "walking",
        Heading::Facing => "facing",
        Heading::Unknown => "forward assumed as",
    };
    let unit = if (scale - 1.0).abs() > 0.0 { format!("{unit} x {scale}") } else { unit.to_owned() };
    Laboratory {
        world_from_lab: Mat3::from_rows(&[forward.transpose(), up.transpose(), right.transpose()]),
        metres_per_stated_metre: scale,
        heading,
        turn_deg: travel.and_then(|travel| travel.turn_deg),
        statement: format!(
            "lab {} up, {unit}, {way} {} -> world x forward, y up, z right, m",
            up_name(up),
            direction_name(forward, up)
        ),
    }
}

// ---- up ----

fn upward(
    markers: &MarkerRecording,
    landmarks: &Landmarks,
    plates: &[PlateRecording],
    findings: &mut Findings,
) -> Vec3 {
    let of_body = body_axis(markers, landmarks);
    let pushed: Vec3 =
        plates.iter().flat_map(|p| (0..p.times.len()).filter(|&i| p.is_loaded(i)).map(|i| p.force[i])).sum();
    let of_plates = pushed.try_normalize(1.0).map(nearest_axis).filter(|(_, deg)| *deg <= UPRIGHT_DEG);
    let of_body = of_body.map(nearest_axis);
    match (of_body, of_plates) {
        (Some((body, deg)), Some((plate, _))) if deg <= UPRIGHT_DEG && body != plate => {
            let message = format!(
                "by the markers {} is up, by the force plates {}; the markers were used",
                up_name(body),
                up_name(plate)
            );
            findings.report(Code::LaboratoryUpContradicted, message);
            body
        }
        (_, Some((plate, _))) => plate,
        (Some((body, deg)), None) if deg <= UPRIGHT_DEG => body,
        (body, None) => {
            let up = body.map_or_else(|| longest_axis(markers), |(axis, _)| axis);
            let message = format!(
                "the upward axis cannot be determined from plates or posture; {} was assumed. hint: name heel, toe and \
                 pelvis markers as in the list of marker sets",
                up_name(up)
            );
            findings.report(Code::LaboratoryUpUnclear, message);
            up
        }
    }
}

/// Mean direction from the feet to pelvis and head, from markers with known names.
fn body_axis(markers: &MarkerRecording, landmarks: &Landmarks) -> Option<Vec3> {
    let low: Vec<usize> = landmarks.right.all().chain(landmarks.left.all()).collect();
    let high: Vec<usize> = landmarks.pelvis().into_iter().chain(landmarks.head.iter().copied()).collect();
    let directions = (0..markers.frames()).filter_map(|i| {
        let (low, high) = (mean_of_seen(markers, &low, i)?, mean_of_seen(markers, &high, i)?);
        (high - low).try_normalize(f64::MIN_POSITIVE)
    });
    mean_direction(directions)
}

/// The axis along which the markers of a frame extend furthest.
fn longest_axis(markers: &MarkerRecording) -> Vec3 {
    let spread = |axis: &Vec3| median((0..markers.frames()).filter_map(|i| extent(markers, i, *axis)));
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    let spreads = axes.each_ref().map(|a| spread(a).unwrap_or(0.0));
    let longest = (0..3).max_by(|&a, &b| spreads[a].total_cmp(&spreads[b])).unwrap_or(2);
    axes[longest]
}

// ---- unit ----

fn scale(markers: &MarkerRecording, landmarks: &Landmarks, up: Vec3, findings: &mut Findings) -> f64 {
    let Some(height) = median((0..markers.frames()).filter_map(|i| extent(markers, i, up))) else {
        return 1.0;
    };
    let fits = |factor: f64| (HEIGHT_M[0]..=HEIGHT_M[1]).contains(&(height * factor));
    if fits(1.0) || height <= 0.0 {
        return 1.0;
    }
    // A factor of ten is a usual unit for a whole body only: feet or a pelvis alone span a few centimetres.
    let is_whole = body_axis(markers, landmarks).is_some();
    let is_usual = |f: f64| is_whole || !(0.05..20.0).contains(&f);
    let Some(factor) = UNIT_FACTORS.into_iter().find(|&f| fits(f) && is_usual(f)) else {
        let message = format!(
            "the markers span {height:.3} m from lowest to highest, which is not a standing person in any unit; \
             lengths were not changed"
        );
        findings.report(Code::LaboratorySizeOdd, message);
        return 1.0;
    };
    let message = format!(
        "the markers span {height:.4} m from lowest to highest by the file's unit; lengths were multiplied by \
         {factor}, which gives {:.3} m",
        height * factor
    );
    findings.report(Code::LaboratoryUnitChanged, message);
    factor
}

/// Distance from the lowest to the highest marker of a frame; `None` with fewer than three.
fn extent(markers: &MarkerRecording, frame: usize, axis: Vec3) -> Option<f64> {
    let seen = markers.markers.iter().filter(|m| m.is_seen(frame)).map(|m| m.positions[frame].dot(&axis));
    let (low, high, count) =
        seen.fold((f64::INFINITY, f64::NEG_INFINITY, 0), |(l, h, n), x| (l.min(x), h.max(x), n + 1));
    (count >= 3).then_some(high - low)
}

// ---- forward ----

/// Why the body has no facing direction, if it has none.
fn no_facing(landmarks: &Landmarks) -> &'static str {
    let has_foot =
        Side::BOTH.iter().any(|side| landmarks.foot(*side).heel.is_some() && landmarks.foot(*side).toe.is_some());
    let has_pelvis = landmarks.asis_r.is_some() && landmarks.asis_l.is_some();
    if has_foot || has_pelvis {
        "its heel, toe and pelvis markers point in different directions, or are not seen"
    } else {
        "no heel and toe or pelvis markers are known"
    }
}

/// `up`: with the reason why no facing direction is known.
fn forward(
    travel: Option<Vec3>,
    facing: Option<Vec3>,
    (up, no_facing): (Vec3, &str),
    findings: &mut Findings,
) -> (Vec3, Heading) {
    match (travel, facing) {
        (Some(travel), None) => (snapped(travel, up), Heading::Walking),
        (Some(travel), Some(facing)) => {
            let apart = angle_deg(travel, facing);
            if apart <= SIDEWAYS_DEG {
                return (snapped(travel, up), Heading::Walking);
            }
            if apart >= 180.0 - SIDEWAYS_DEG {
                let message = "the body walks backwards: forward is its facing direction, opposite to its motion";
                findings.report(Code::LaboratoryBackwards, message);
                return (snapped(-travel, up), Heading::Walking);
            }
            let message = format!(
                "the body moves at {} to its facing direction; forward is the facing direction. hint: check whether \
                 left and right markers are swapped",
                degrees(apart)
            );
            findings.report(Code::LaboratorySideways, message);
            (snapped(facing, up), Heading::Facing)
        }
        (None, Some(facing)) => (snapped(facing, up), Heading::Facing),
        (None, None) => {
            let forward = if up.x.abs() > 0.5 { Vec3::y() } else { Vec3::x() };
            let message = format!(
                "the forward direction cannot be determined (the body stays in place, and {no_facing}); {} was assumed",
                direction_name(forward, up)
            );
            findings.report(Code::LaboratoryForwardUnclear, message);
            (forward, Heading::Unknown)
        }
    }
}

/// Horizontal motion of the pelvis.
#[derive(Debug, Clone, Copy)]
struct Travel {
    direction: Vec3,
    turn_deg: Option<f64>,
}

/// Horizontal motion of the pelvis; `None` if it stays in place.
fn travel(
    markers: &MarkerRecording,
    landmarks: &Landmarks,
    plates: &[PlateRecording],
    up: Vec3,
    scale: f64,
    findings: &mut Findings,
) -> Option<Travel> {
    let path = body_path(markers, landmarks, up);
    let (first, last) = (path.first()?, path.last()?);
    let way = level(last.1 - first.1, up);
    let duration = last.0 - first.0;
    if way.norm() * scale < WALKED_M || way.norm() * scale < WALKED_M_S * duration {
        return None;
    }
    let middle = path[path.len() / 2].1;
    let turn = angle_deg(middle - first.1, last.1 - middle);
    if turn <= TURN_DEG {
        return Some(Travel { direction: way.normalize(), turn_deg: None });
    }
    let on_plates = loaded_span(plates).and_then(|[from, to]| {
        let inside: Vec<&(f64, Vec3)> = path.iter().filter(|(t, _)| (from..=to).contains(t)).collect();
        let way = inside.last()?.1 - inside.first()?.1;
        (way.norm() * scale >= WALKED_M).then(|| way.normalize())
    });
    let chosen = if on_plates.is_some() {
        "its direction over the loaded plates"
    } else {
        "its direction from beginning to end"
    };
    let message = format!(
        "the body turns by about {}; forward is {chosen}, so that pelvis angles and fore-aft forces are less \
         meaningful than in a straight walk",
        degrees(turn)
    );
    findings.report(Code::LaboratoryTurning, message);
    Some(Travel { direction: on_plates.unwrap_or_else(|| way.normalize()), turn_deg: Some(turn) })
}

/// Times and horizontal positions of the pelvis, or of the mean of the markers that are visible longest.
fn body_path(markers: &MarkerRecording, landmarks: &Landmarks, up: Vec3) -> Vec<(f64, Vec3)> {
    let of = |chosen: &[usize]| -> Vec<(f64, Vec3)> {
        let place = |i: usize| mean_of(markers, chosen, i).map(|p| (markers.times[i], level(p, up)));
        (0..markers.frames()).filter_map(place).collect()
    };
    let seen = |m: &MarkerPath| (0..m.positions.len()).filter(|&i| m.is_seen(i)).count();
    let mut pelvis = landmarks.pelvis();
    pelvis.retain(|&m| 2 * seen(&markers.markers[m]) > markers.frames());
    let path = of(&pelvis);
    if path.len() >= 2 {
        return path;
    }
    let most = markers.markers.iter().map(seen).max().unwrap_or(0);
    let steady: Vec<usize> = (0..markers.markers.len()).filter(|&i| seen(&markers.markers[i]) == most).collect();
    of(&steady)
}

/// First and last time at which a plate is loaded [s].
fn loaded_span(plates: &[PlateRecording]) -> Option<[f64; 2]> {
    let loaded = || plates.iter().flat_map(|p| (0..p.times.len()).filter(|&i| p.is_loaded(i)).map(|i| p.times[i]));
    let (from, to) = (loaded().reduce(f64::min)?, loaded().reduce(f64::max)?);
    (to > from).then_some([from, to])
}

/// Mean facing direction of pelvis and feet.
fn facing(markers: &MarkerRecording, landmarks: &Landmarks, up: Vec3) -> Option<Vec3> {
    let level = |v: Vec3| level(v, up).try_normalize(f64::MIN_POSITIVE);
    let at = |marker: Option<usize>, i: usize| {
        marker.filter(|&m| markers.markers[m].is_seen(i)).map(|m| markers.markers[m].positions[i])
    };
    let pelvis = (0..markers.frames()).filter_map(|i| {
        let right = at(landmarks.asis_r, i)? - at(landmarks.asis_l, i)?;
        level(up.cross(&right))
    });
    let foot = |side: Side| {
        let foot = *landmarks.foot(side);
        (0..markers.frames()).filter_map(move |i| level(at(foot.toe, i)? - at(foot.heel, i)?)).collect::<Vec<_>>()
    };
    let feet = Side::BOTH.into_iter().flat_map(foot);
    mean_direction(pelvis.chain(feet))
}

// ---- directions ----

/// A horizontal direction, or the axis of the laboratory close to it.
fn snapped(direction: Vec3, up: Vec3) -> Vec3 {
    let level = level(direction, up).normalize();
    let (axis, deg) = nearest_axis(level);
    if deg <= SNAP_DEG { axis } else { level }
}

fn level(v: Vec3, up: Vec3) -> Vec3 {
    v - up * v.dot(&up)
}

/// The axis of the laboratory nearest to a unit vector, and the angle between them [deg].
fn nearest_axis(direction: Vec3) -> (Vec3, f64) {
    let i = direction.iamax();
    let mut axis = Vec3::zeros();
    axis[i] = direction[i].signum();
    (axis, angle_deg(axis, direction))
}

fn angle_deg(a: Vec3, b: Vec3) -> f64 {
    atan2(a.cross(&b).norm(), a.dot(&b)).to_degrees()
}

/// The mean direction; `None` if the directions do not agree.
fn mean_direction(directions: impl Iterator<Item = Vec3>) -> Option<Vec3> {
    let (sum, count) = directions.fold((Vec3::zeros(), 0.0), |(s, n), d| (s + d, n + 1.0));
    (count > 0.0 && sum.norm() / count >= LEAST_AGREEMENT).then(|| sum.normalize())
}

/// `+y`, or the angle of a direction that is not an axis.
fn direction_name(direction: Vec3, up: Vec3) -> String {
    let (axis, deg) = nearest_axis(direction);
    if deg < 1e-6 {
        return axis_name(axis);
    }
    let second = direction - axis * direction.dot(&axis);
    let (towards, _) = nearest_axis(second.try_normalize(f64::MIN_POSITIVE).unwrap_or(up));
    format!("{} from {} towards {}", degrees(deg), axis_name(axis), axis_name(towards))
}

fn axis_name(axis: Vec3) -> String {
    let i = axis.iamax();
    let sign = if axis[i] < 0.0 { '-' } else { '+' };
    format!("{sign}{}", ["x", "y", "z"][i])
}

/// `z`, or `-z` if the axis points down.
fn up_name(up: Vec3) -> String {
    axis_name(up).trim_start_matches('+').to_owned()
}

// ---- markers ----

/// Mean of the markers that are visible in a frame.
fn mean_of_seen(markers: &MarkerRecording, chosen: &[usize], frame: usize) -> Option<Vec3> {
    let seen: Vec<usize> = chosen.iter().copied().filter(|&m| markers.markers[m].is_seen(frame)).collect();
    mean_of(markers, &seen, frame)
}

/// Mean of some markers in a frame; `None` unless all of them are visible, so that the mean does not jump.
fn mean_of(markers: &MarkerRecording, chosen: &[usize], frame: usize) -> Option<Vec3> {
    if chosen.is_empty() || !chosen.iter().all(|&m| markers.markers[m].is_seen(frame)) {
        return None;
    }
    Some(chosen.iter().map(|&m| markers.markers[m].positions[frame]).sum::<Vec3>() / chosen.len() as f64)
}
