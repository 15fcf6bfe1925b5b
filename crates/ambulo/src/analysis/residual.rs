//! What the measured loads and the motion disagree by: the wrench at the root that nothing supplies.

use crate::dynamics::Forces;
use crate::model::Model;

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

/// The residual: sum of the wrenches at the joints to ground. `None` without frames.
///
/// For a body that is truly fastened to ground (a robot arm) this is the load on its foundation.
#[must_use]
pub fn residual(model: &Model, forces: &Forces) -> Option<Residual> {
    let roots: Vec<usize> =
        model.body_ids().map(|id| id.index()).filter(|&i| model.bodies()[i].joint.parent.is_none()).collect();
    let frames = forces.reactions.first()?.len();
    if frames == 0 {
        return None;
    }
    let (mut force, mut moment) = (Series::default(), Series::default());
    for frame in 0..frames {
        let first = forces.reactions[*roots.first()?][frame].center;
        let mut total = crate::spatial::Wrench::ZERO;
        for &root in &roots {
            let reaction = forces.reactions[root][frame];
            let moved = reaction.wrench.about(reaction.center - first);
            total.force += moved.force;
            total.moment += moved.moment;
        }
        force.add(total.force.norm());
        moment.add(total.moment.norm());
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
