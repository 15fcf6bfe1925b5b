//! Where the ground must push: the centre of pressure that the whole body's motion needs, against the soles that stand.
//!
//! A mean of centres of pressure, weighted by forces that push, lies inside the convex hull of all soles that stand during that time; how
//! far the needed one lies outside of it is what no pushing of these soles explains. A figure that moves in a plane is held in it by its
//! root's joint: of it the plane counts alone.

use super::CheckedPrediction;
use super::base_of_support::BaseOfSupport;
use super::judgement::{Judgement, Looked};
use super::lasting::lasting;
use super::low_pass::{Instant, LowPassed, SHORTEST_S};
use super::record::Record;
use crate::analysis::feasibility::Check;
use crate::spatial::Vec3;

pub(super) fn check(
    evidence: &CheckedPrediction<'_>,
    record: &Record,
    low_passed: &LowPassed,
    judgement: &mut Judgement<'_>,
) {
    let limit = evidence.thresholds.sole_margin_m;
    let looked = Looked { name: "center_of_pressure", allowed: [0.0, limit], unit: "m" };
    let radius = 0.5 * record.half_widths.iter().sum::<f64>();
    let axes = level_axes(record.up);
    let outside = |instant: &Instant| {
        let in_plane = |p: Vec3| record.plane_normal.map_or(p, |n| p - n * n.dot(&p));
        let places: Vec<Vec3> = low_passed.places(record, instant).into_iter().map(in_plane).collect();
        let base = BaseOfSupport::around(&places, radius, axes)?;
        let outside = base.outside(in_plane(instant.center(record)?));
        Some((instant.time_s, outside.norm()))
    };
    let series: Vec<(f64, f64)> = low_passed.instants.iter().filter_map(outside).collect();
    let Some(found) = lasting(&series, low_passed.step_s, SHORTEST_S) else {
        return judgement.skip(looked, "no foot stands for long enough");
    };
    if judgement.take(looked, found) {
        return;
    }
    let beyond = series.iter().filter(|(_, outside)| *outside > limit).count();
    let message = format!(
        "the whole body's motion needs a centre of pressure {:.0} mm outside of the soles that stand, from {:.3} to {:.3} s at least ({:.0} mm are allowed; {:.0} % of the time is beyond): part of the force does not go through the feet (a hand on a rail, a seat, a load), a step was not seen, or the body's masses lie elsewhere",
        1e3 * found.value,
        found.time_s[0],
        found.time_s[1],
        1e3 * limit,
        100.0 * beyond as f64 / series.len() as f64
    );
    judgement.oppose(Check::CenterOfPressure, looked, found, message);
}

/// Two level unit vectors, square to each other.
fn level_axes(up: Vec3) -> [Vec3; 2] {
    let aside = if up.x.abs() < 0.7 { Vec3::x() } else { Vec3::y() };
    let first = aside.cross(&up).normalize();
    [first, up.cross(&first)]
}
