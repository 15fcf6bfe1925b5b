//! A figure in a separate world, as the controller reads it: coordinates of its model, motors at its joints, loads
//! under its feet.

use super::settings::ControlError;
use crate::consistent_walk::soft_ground;
use crate::contact::HuntCrossley;
use crate::dynamics::{Convergence, LinkError};
use crate::engine::figure_tree::{FigurePlace, FigureTree};
use crate::engine::soles::{add_level_ground, add_soles};
use crate::engine::{ContactLaw, Material, Motor, StepSettings, StepWorkspace, World, WorldState, step};
use crate::findings::Findings;
use crate::kinematics::Posture;
use crate::model::Side;
use crate::model::anthropometry::Human;
use crate::walking::{WalkingError, sole_material};

/// A figure on level ground.
#[derive(Debug, Clone)]
pub struct FigureWorld {
    /// Bodies in the order of the model, then the links between hinges; surfaces are the soles in their order, then the
    /// ground.
    pub(super) world: World,
    pub(super) state: WorldState,
    pub(super) settings: StepSettings,
    pub(super) workspace: StepWorkspace,
    pub(super) tree: FigureTree,
    /// The joint of every body.
    joint_of: Vec<Option<usize>>,
    sides: Vec<Option<Side>>,
    /// The surface of the ground.
    ground: usize,
}

impl FigureWorld {
    /// A figure whose soles are `human.soles`, in shoes on level ground.
    pub fn new(human: &Human, shoes: HuntCrossley, settings: StepSettings) -> Result<FigureWorld, ControlError> {
        let mut world = World { gravity: human.model.gravity(), ..World::default() };
        let tree = FigureTree::add(&mut world, &human.model, "")?;
        world.materials.push(sole_material(&soft_ground(shoes)));
        let soles = add_soles(&mut world, human, 0, 0).map_err(WalkingError::from)?;
        add_level_ground(&mut world, 0);
        let ground = world.surfaces.len() - 1;
        tree.add_solid_legs(&mut world).map_err(WalkingError::from)?;
        let limbs = (ground..world.surfaces.len()).map(|_| None);
        let sides = soles.into_iter().map(|(_, side)| Some(side)).chain(limbs).collect();
        world.check().map_err(WalkingError::from)?;
        let state = WorldState::new(&world);
        let joint_of = world.joint_of_body();
        Ok(FigureWorld { world, state, settings, workspace: StepWorkspace::default(), tree, joint_of, sides, ground })
    }

    /// Sets coordinates and rates of the figure.
    pub(super) fn place(&mut self, q: &[f64], qd: &[f64]) {
        let still = vec![0.0; q.len()];
        let motions = self.tree.motions(&self.world, Posture { q, qd, qdd: &still });
        (self.state.poses, self.state.twists) = motions.into_iter().map(|body| (body.pose, body.twist)).unzip();
        for (place, value) in self.tree.places.iter().zip(q) {
            if let Some((joint, k)) = place.joint(&self.joint_of) {
                self.state.coordinates[joint][k] = *value;
            }
        }
    }

    /// Value and rate of every coordinate.
    pub(super) fn read(&self) -> Vec<[f64; 2]> {
        self.tree.read(&self.world, &self.state, &self.joint_of)
    }

    /// Sets the motor of a coordinate; nothing drives a root.
    pub(super) fn drive(&mut self, coordinate: usize, motor: Motor) {
        if let Some((joint, k)) = self.tree.places[coordinate].joint(&self.joint_of) {
            self.world.joints[joint].coordinates[k].motor = Some(motor);
        }
    }

    /// The figure has fallen and lies on the ground by its body; `now` has value and rate of each coordinate.
    pub(super) fn lie_down(&mut self, now: &[[f64; 2]]) {
        // Soft shoes would push out what is already below the ground with thousands of newtons: the ground is rigid
        // from now on, and the body has its own softness. The shoes keep theirs.
        let friction = self.world.materials[self.world.surfaces[self.ground].material].friction;
        self.world.surfaces[self.ground].material = self.world.materials.len();
        self.world.materials.push(Material { friction, restitution: 0.0, law: ContactLaw::Rigid });
        // The solids of a figure have a size.
        let _lies = self.tree.lie_down(&mut self.world, now);
    }

    /// Makes one step.
    pub(super) fn step(&mut self, findings: &mut Findings) -> Result<Convergence, LinkError> {
        step(&self.world, &mut self.state, &self.settings, &mut self.workspace, findings)
    }

    /// Vertical force of the last step on the right and the left foot [N].
    pub(super) fn loads(&self) -> [f64; 2] {
        let mut loads = [0.0; 2];
        for contact in self.workspace.contacts() {
            let (first, second) = contact.surfaces;
            for (surface, sense) in [(first, 1.0), (second, -1.0)] {
                if let Some(side) = self.sides.get(surface).copied().flatten() {
                    loads[usize::from(side == Side::Left)] += sense * contact.force.y;
                }
            }
        }
        loads
    }

    /// Effort of each coordinate in the last step [N.m or N].
    pub(super) fn efforts(&self) -> Vec<f64> {
        let forces = self.workspace.forces(&self.world);
        let effort =
            |place: &FigurePlace| place.joint(&self.joint_of).map_or(0.0, |(joint, k)| forces.efforts[joint][k]);
        self.tree.places.iter().map(effort).collect()
    }
}
