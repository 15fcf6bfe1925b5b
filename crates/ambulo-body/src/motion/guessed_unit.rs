//! The unit of length of a file that states none or an invalid one: it is inferred from the size of the person.

use super::real_points::real_points;
use crate::findings::{Code, Findings};
use crate::numerics::median;
use crate::spatial::Vec3;
use ambulo_formats::c3d::C3d;

/// Units that are tried.
const UNITS: [(&str, f64); 3] = [("mm", 1e-3), ("cm", 1e-2), ("m", 1.0)];
/// Largest distance of markers along an axis, from the legs of a child to a tall adult with raised arms [m]. The range
/// is narrower than the factor of ten between the units.
const BODY_M: [f64; 2] = [0.35, 3.0];
/// Edges of force plates [m].
const PLATE_M: [f64; 2] = [0.25, 2.4];

/// Metres per unit of the positions of a C3D: as stated, else inferred from the size of the markers, or of the force
/// plates without markers. `None` if neither does.
pub(super) fn metres_per_unit(file: &C3d, findings: &mut Findings) -> Option<f64> {
    if let Some(metres) = file.metres_per_unit() {
        return Some(metres);
    }
    let points = real_points(file);
    let at = |frame: usize| points.iter().filter_map(move |point| point.positions.get(frame)).map(|p| Vec3::from(*p));
    let of_points = unit_of_frames(file.frames(), at).map(|unit| (unit, "markers"));
    let ((name, metres), what) = of_points.or_else(|| unit_of_plates(file).map(|unit| (unit, "force plates")))?;
    let stated = &file.point_unit;
    let message = format!(
        "POINT:UNITS is `{stated}`, which is no unit of length; by the size of the {what} lengths are in {name}"
    );
    findings.report(Code::FileUnitGuessed, message);
    Some(metres)
}

/// The unit in which the markers of most frames extend as far as a person.
pub(super) fn unit_of_frames<P: Iterator<Item = Vec3>>(
    frames: usize,
    places: impl Fn(usize) -> P,
) -> Option<(&'static str, f64)> {
    /// Number of evaluated frames, spread over the recording.
    const FRAMES: usize = 200;
    let step = frames.div_ceil(FRAMES).max(1);
    let extent = |frame: usize| {
        let seen = || places(frame).filter(|place| place.iter().all(|x| x.is_finite()) && *place != Vec3::zeros());
        let (low, high) = (seen().reduce(|a, b| a.inf(&b))?, seen().reduce(|a, b| a.sup(&b))?);
        (seen().count() >= 3).then(|| (high - low).amax())
    };
    unit_within(median((0..frames).step_by(step).filter_map(extent))?, BODY_M)
}

fn unit_of_plates(file: &C3d) -> Option<(&'static str, f64)> {
    let platforms: Vec<_> = file.each_platform().into_iter().flatten().collect();
    let edge = |corners: &[[f64; 3]; 4]| (Vec3::from(corners[0]) - Vec3::from(corners[1])).norm();
    let edges = platforms.iter().map(|platform| edge(&platform.corners)).filter(|edge| *edge > 0.0 && edge.is_finite());
    unit_within(median(edges)?, PLATE_M)
}

fn unit_within(length: f64, [least, most]: [f64; 2]) -> Option<(&'static str, f64)> {
    UNITS.into_iter().find(|(_, metres)| (least..=most).contains(&(length * metres)))
}
