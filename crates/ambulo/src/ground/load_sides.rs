//! Which foot is under a measured load, by its centre of pressure: for force tables, whose columns do not show the
//! corners of plates.
//!
//! As for force plates of a C3D ([`super::plates`]), each time during which a load carries more than 20 N belongs to
//! the foot that is nearest to the centre of pressure, averaged over the load, within 0.2 m. Height counts, as on
//! stairs; only where no foot is near does a foot above or below the centre of pressure carry the load, because forces
//! act on the person. The feet are the soles of the model. Pinned by: ambulo-cli/tests/plates.rs

use super::measured::{Surface, center_of_pressure};
use super::phases::contacts_from_force;
use super::plates::{FARTHEST_M, VIBRATION};
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model, Side};
use crate::motion::{ForceRecording, TimeGrid};
use crate::numerics::elementary::hypot;
use crate::spatial::{Vec3, level_distance};

/// Largest distance of the lower end of a sole from the surface that carries it [m].
const OFF_SURFACE_M: f64 = 0.1;

/// Rear and tip of both soles over time.
pub(crate) struct FootPaths {
    grid: TimeGrid,
    up: Vec3,
    lines: BySide<Vec<[Vec3; 2]>>,
}

/// A time during which a load carries a foot.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LoadedSpan {
    /// Start and end [s].
    pub(crate) span: [f64; 2],
    /// Mean distance of each foot from the centre of pressure [m]; not a number outside the motion.
    pub(crate) distance_m: BySide<f64>,
    /// The part of this distance along the ground [m].
    level_m: BySide<f64>,
}

impl LoadedSpan {
    /// The foot on the load, or else the foot above or below it.
    pub(crate) fn side(&self) -> Option<Side> {
        nearest(&self.distance_m).or_else(|| nearest(&self.level_m))
    }

    /// The foot that carries the load although it is this far above or below the centre of pressure [m].
    pub(crate) fn at_another_height(&self) -> Option<(Side, f64)> {
        let side = nearest(&self.level_m).filter(|_| nearest(&self.distance_m).is_none())?;
        let off_m = (self.distance_m[side].powi(2) - self.level_m[side].powi(2)).max(0.0).sqrt();
        Some((side, OFF_SURFACE_M + off_m))
    }
}

fn nearest(distance_m: &BySide<f64>) -> Option<Side> {
    let near = distance_m.iter().filter(|(_, distance)| **distance <= FARTHEST_M);
    near.min_by(|a, b| a.1.total_cmp(b.1)).map(|(side, _)| side)
}

impl FootPaths {
    /// The feet of a motion; `None` for a model without two soles.
    pub(crate) fn new(model: &Model, trajectory: &Trajectory, soles: &BySide<Option<Sole>>) -> Option<FootPaths> {
        let soles = BySide { right: soles.right?, left: soles.left? };
        let (mut right, mut left) = (Vec::new(), Vec::new());
        each_body_motion(model, trajectory, |_, bodies| {
            let line = |sole: &Sole| {
                let [rear, _, tip] = sole.points;
                [rear, tip].map(|point| bodies[point.body.index()].pose.place(point.place))
            };
            right.push(line(&soles.right));
            left.push(line(&soles.left));
        });
        Some(FootPaths { grid: trajectory.grid(), up: model.up(), lines: BySide { right, left } })
    }

    /// The loaded times of each load during the motion; vibrations are left out. A load in the axes of a body has none.
    pub(crate) fn spans(&self, loads: &[ForceRecording]) -> Vec<Vec<LoadedSpan>> {
        let vertical: Vec<Vec<f64>> =
            loads.iter().map(|load| load.force.iter().map(|force| force.dot(&self.up)).collect()).collect();
        let highest = vertical.iter().flatten().copied().fold(0.0, f64::max);
        let of_load = |(load, vertical): (&ForceRecording, &Vec<f64>)| {
            let (Some(&first), Some(&last)) = (load.times.first(), load.times.last()) else { return Vec::new() };
            if load.force_frame.is_some() || load.point_frame.is_some() {
                return Vec::new();
            }
            let contacts = contacts_from_force(&load.times, vertical);
            let spans = contacts.iter().map(|contact| contact.span(first, last));
            spans.filter_map(|span| self.judged(load, vertical, span, VIBRATION * highest)).collect()
        };
        loads.iter().zip(&vertical).map(of_load).collect()
    }

    fn judged(&self, load: &ForceRecording, vertical: &[f64], span: [f64; 2], least_n: f64) -> Option<LoadedSpan> {
        let from = load.times.partition_point(|&t| t < span[0]);
        let to = load.times.partition_point(|&t| t <= span[1]);
        let surface = Surface::of(load, self.up);
        let mut sum = BySide { right: [0.0; 2], left: [0.0; 2] };
        let mut weight = 0.0;
        for i in (from..to).filter(|&i| vertical[i] > 0.0) {
            let moment = load.moment[i] + load.point[i].cross(&load.force[i]);
            let (center, _) = center_of_pressure(load.force[i], moment, self.up, surface.height(load.times[i]));
            let Some(distance) = self.distances(center, load.times[i]) else { continue };
            sum = BySide::from_fn(|side| [0, 1].map(|k| sum[side][k] + vertical[i] * distance[side][k]));
            weight += vertical[i];
        }
        let peak = vertical[from..to].iter().copied().fold(0.0, f64::max);
        (peak >= least_n && weight > 0.0).then(|| LoadedSpan {
            span,
            distance_m: sum.map(|[distance, _]| distance / weight),
            level_m: sum.map(|[_, level]| level / weight),
        })
    }

    /// Distances of a centre of pressure from both feet, with and without height [m]; `None` outside the motion or
    /// without a centre of pressure.
    fn distances(&self, center: Vec3, time_s: f64) -> Option<BySide<[f64; 2]>> {
        let frame = ((time_s - self.grid.start_s) / self.grid.step_s).round();
        let is_known = center.iter().all(|x| x.is_finite()) && frame >= 0.0 && frame < self.grid.frames as f64;
        is_known.then(|| BySide::from_fn(|side| self.distance(&self.lines[side][frame as usize], center)))
    }

    /// Distance along the ground and by how much the foot is too high or too low for the surface, together; then only
    /// the first [m].
    fn distance(&self, [rear, tip]: &[Vec3; 2], center: Vec3) -> [f64; 2] {
        let above = (rear - center).dot(&self.up).min((tip - center).dot(&self.up));
        let level = level_distance(center, [*rear, *tip], self.up);
        [hypot(level, (above.abs() - OFF_SURFACE_M).max(0.0)), level]
    }
}
