//! What the measured loads and the motion disagree by: the wrench at the root that nothing supplies.

use crate::dynamics::{Forces, JointReaction};
use crate::model::{Displacement, Joint, JointAxis, Model};
use crate::spatial::{Vec3, Wrench};
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

/// The residual: sum of the wrenches at the joints to ground, as far as they let move. `None` without frames.
///
/// A figure that moves in a plane is held in it by its root's joint; what holds it there is no disagreement. For a body that is
/// truly fastened to ground (a robot arm) this is the load on its foundation.
#[must_use]
pub fn residual(model: &Model, forces: &Forces) -> Option<Residual> {
    residual_within(model, forces, 0..forces.reactions.first()?.len())
}

/// The residual over some of the frames: those in which all that the ground does was measured.
#[must_use]
pub fn residual_within(model: &Model, forces: &Forces, frames: Range<usize>) -> Option<Residual> {
    let frames = frames.start..frames.end.min(forces.reactions.first()?.len());
    if frames.is_empty() {
        return None;
    }
    let roots = Roots::of(model);
    let (mut force, mut moment) = (Series::default(), Series::default());
    for frame in frames {
        let total = roots.residual(forces, frame);
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

/// The joints to ground, and how they let move.
#[derive(Debug, Clone)]
pub(super) struct Roots {
    joints: Vec<Root>,
}

#[derive(Debug, Clone)]
struct Root {
    body: usize,
    /// Where forces and moments are residual: everywhere, or along some directions.
    force: Free,
    moment: Free,
}

#[derive(Debug, Clone)]
enum Free {
    Everywhere,
    Along(Vec<Vec3>),
}

impl Roots {
    pub(super) fn of(model: &Model) -> Roots {
        let is_root = |&i: &usize| model.bodies()[i].joint.parent.is_none();
        let root = |body: usize| Root::of(body, &model.bodies()[body].joint);
        Roots { joints: (0..model.bodies().len()).filter(is_root).map(root).collect() }
    }

    /// What nothing supplies in a frame, about the first root's joint.
    pub(super) fn residual(&self, forces: &Forces, frame: usize) -> Wrench {
        let mut total = Wrench::ZERO;
        let Some(first) = self.joints.first() else { return total };
        let center = forces.reactions[first.body][frame].center;
        for root in &self.joints {
            let JointReaction { wrench, center: at } = forces.reactions[root.body][frame];
            let free = Wrench { force: root.force.part(wrench.force), moment: root.moment.part(wrench.moment) };
            let moved = free.about(at - center);
            total.force += moved.force;
            total.moment += moved.moment;
        }
        total
    }
}

impl Root {
    /// A joint that slides and turns about one axis keeps the rest of the motion; one that turns about several axes, or does not
    /// slide at all, is taken as a whole.
    fn of(body: usize, joint: &Joint) -> Root {
        let directions = |axes: &[JointAxis]| -> Vec<Vec3> {
            let moves = |axis: &&JointAxis| matches!(axis.displacement, Displacement::Follows(..));
            axes.iter().filter(moves).map(|axis| joint.parent_from_joint.rotation * axis.direction).collect()
        };
        let (turns, slides) = (directions(&joint.rotations), directions(&joint.translations));
        if turns.len() == 1 && !slides.is_empty() {
            return Root { body, force: Free::Along(square(slides)), moment: Free::Along(turns) };
        }
        Root { body, force: Free::Everywhere, moment: Free::Everywhere }
    }
}

impl Free {
    fn part(&self, whole: Vec3) -> Vec3 {
        match self {
            Free::Everywhere => whole,
            Free::Along(axes) => axes.iter().map(|axis| axis * axis.dot(&whole)).sum(),
        }
    }
}

/// Unit vectors at right angles that span the same directions (Gram and Schmidt's method).
fn square(directions: Vec<Vec3>) -> Vec<Vec3> {
    /// Shorter than this, a direction is one of those before it.
    const SHORT: f64 = 1e-9;
    let mut axes: Vec<Vec3> = Vec::new();
    for direction in directions {
        let rest = direction - axes.iter().map(|axis| axis * axis.dot(&direction)).sum::<Vec3>();
        axes.extend(rest.try_normalize(SHORT));
    }
    axes
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
