//! Residual force and moment: the wrench at the joints to ground that no load supplies.

use super::inverse::JointReaction;
use crate::model::{BodyId, Displacement, Joint, JointAxis, Model};
use crate::spatial::{Vec3, Wrench};

/// The joints to ground and their free directions.
#[derive(Debug, Clone)]
pub struct Roots {
    joints: Vec<Root>,
}

#[derive(Debug, Clone)]
struct Root {
    body: BodyId,
    /// Directions along which forces and moments are residual.
    force: Free,
    moment: Free,
}

#[derive(Debug, Clone)]
enum Free {
    Everywhere,
    Along(Vec<Vec3>),
}

impl Roots {
    /// The roots of a model.
    pub fn of(model: &Model) -> Roots {
        let is_root = |id: &BodyId| model.bodies()[id.index()].joint.parent.is_none();
        let root = |body: BodyId| Root::of(body, &model.bodies()[body.index()].joint);
        Roots { joints: model.body_ids().filter(is_root).map(root).collect() }
    }

    /// Residual wrench at one instant, about the joint of the first root, from the reaction in the joint of each body.
    pub fn residual(&self, reaction: impl Fn(BodyId) -> JointReaction) -> Wrench {
        let mut total = Wrench::ZERO;
        let Some(first) = self.joints.first() else { return total };
        let center = reaction(first.body).center;
        for root in &self.joints {
            let JointReaction { wrench, center: at } = reaction(root.body);
            let free = Wrench { force: root.force.part(wrench.force), moment: root.moment.part(wrench.moment) };
            let moved = free.about(at - center);
            total.force += moved.force;
            total.moment += moved.moment;
        }
        total
    }
}

impl Root {
    /// A joint that translates and rotates about one axis (planar models) has residuals along its free directions only.
    /// For a joint with several rotations, or without translations, the whole wrench is residual.
    fn of(body: BodyId, joint: &Joint) -> Root {
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

/// Orthonormal vectors that span the same directions (Gram-Schmidt).
fn square(directions: Vec<Vec3>) -> Vec<Vec3> {
    /// A shorter remainder means that a direction depends on those before it.
    const SHORT: f64 = 1e-9;
    let mut axes: Vec<Vec3> = Vec::new();
    for direction in directions {
        let rest = direction - axes.iter().map(|axis| axis * axis.dot(&direction)).sum::<Vec3>();
        axes.extend(rest.try_normalize(SHORT));
    }
    axes
}
