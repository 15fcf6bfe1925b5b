//! Residual force and moment: the wrench at the root that neither the ground nor muscles supply.

use crate::dynamics::{Forces, Roots};
use crate::model::Model;
use std::ops::Range;

/// Size of the residual at the root joints over a trajectory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Residual {
    /// Root mean square of the residual force's length [N].
    pub force_rms_n: f64,
    /// Largest length of the residual force [N].
    pub force_peak_n: f64,
    /// Root mean square of the residual moment's length, about the root joint's centre [N.m].
    pub moment_rms_nm: f64,
    /// Largest length of the residual moment [N.m].
    pub moment_peak_nm: f64,
}

/// The residual: sum of the wrenches at the joints to ground along their free directions. `None` without frames.
///
/// The constraint forces that hold a planar figure in its plane are not part of the residual. For a body that is fixed
/// to ground (a robot arm) the residual is the load on its foundation.
#[must_use]
pub fn residual(model: &Model, forces: &Forces) -> Option<Residual> {
    residual_within(model, forces, 0..forces.reactions.first()?.len())
}

/// Length of the residual force [N] and moment [N.m] in every frame.
#[must_use]
pub fn residual_sizes(model: &Model, forces: &Forces) -> Vec<[f64; 2]> {
    let frames = 0..forces.reactions.first().map_or(0, Vec::len);
    sizes(model, forces, frames).collect()
}

fn sizes(model: &Model, forces: &Forces, frames: Range<usize>) -> impl Iterator<Item = [f64; 2]> {
    let roots = Roots::of(model);
    frames.map(move |frame| {
        let total = roots.residual(|body| forces.reactions[body.index()][frame]);
        [total.force.norm(), total.moment.norm()]
    })
}

/// The residual over some of the frames, such as the instrumented window.
#[must_use]
pub(crate) fn residual_within(model: &Model, forces: &Forces, frames: Range<usize>) -> Option<Residual> {
    let frames = frames.start..frames.end.min(forces.reactions.first()?.len());
    if frames.is_empty() {
        return None;
    }
    let (mut force, mut moment) = (Series::default(), Series::default());
    for [force_n, moment_nm] in sizes(model, forces, frames) {
        force.add(force_n);
        moment.add(moment_nm);
    }
    Some(Residual {
        force_rms_n: force.rms(),
        force_peak_n: force.peak,
        moment_rms_nm: moment.rms(),
        moment_peak_nm: moment.peak,
    })
}

#[derive(Default)]
struct Series {
    squares: f64,
    peak: f64,
    count: usize,
}

impl Series {
    fn add(&mut self, x: f64) {
        self.squares += x * x;
        self.peak = self.peak.max(x);
        self.count += 1;
    }

    fn rms(&self) -> f64 {
        (self.squares / self.count as f64).sqrt()
    }
}
