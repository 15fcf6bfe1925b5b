//! Compares the centre of pressure that the whole body's motion needs with the soles in stance.
//!
//! Soles can only push, so the mean centre of pressure, weighted by the force, lies in the convex hull of all soles in
//! stance during that time. A needed centre of pressure outside it cannot be explained by these soles. A planar figure
//! is held in its plane by the root joint: only the components in the plane are compared.

use super::CheckedPrediction;
use super::base_of_support::BaseOfSupport;
use super::judgement::{Criterion, Judgement};
use super::low_pass::{Instant, LowPassed, SHORTEST_S};
use super::record::Record;
use super::sustained::sustained_maximum;
use crate::analysis::feasibility::Check;
use crate::spatial::Vec3;

pub(super) fn check(
    evidence: &CheckedPrediction<'_>,
    record: &Record,
    low_passed: &LowPassed,
    judgement: &mut Judgement<'_>,
) {
    let limit = evidence.thresholds.sole_margin_m;
    let criterion = Criterion { name: "center_of_pressure", allowed: [0.0, limit], unit: "m" };
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
    let Some(found) = sustained_maximum(&series, low_passed.step_s, SHORTEST_S) else {
        return judgement.skip(criterion, "no foot is in stance for long enough");
    };
    if judgement.take(criterion, found) {
        return;
    }
    let beyond = series.iter().filter(|(_, outside)| *outside > limit).count();
    let message = format!(
        "the whole body's motion needs a centre of pressure {:.0} mm outside the soles in stance, at least from {:.3} \
         to {:.3} s ({:.0} mm are allowed, exceeded for {:.0} % of the time): part of the force does not act through \
         the feet (a hand on a rail, a seat, a load), a stance was not detected, or the mass distribution of the body \
         is wrong",
        1e3 * found.value,
        found.time_s[0],
        found.time_s[1],
        1e3 * limit,
        100.0 * beyond as f64 / series.len() as f64
    );
    judgement.report_infeasible(Check::CenterOfPressure, criterion, found, message);
}

/// Two horizontal orthogonal unit vectors.
fn level_axes(up: Vec3) -> [Vec3; 2] {
    let aside = if up.x.abs() < 0.7 { Vec3::x() } else { Vec3::y() };
    let first = aside.cross(&up).normalize();
    [first, up.cross(&first)]
}
