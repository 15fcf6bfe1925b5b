//! The verdict on the figures of a scene that walk or follow a recording.

use super::scene::{FigureMotion, FigureRecord, FigureWalk, ObstacleForces, Scene};
use super::walking::WalkRecording;
use crate::analysis::activity::{ActivityKind, activity};
use crate::analysis::feasibility::{MotionAndForces, Person, Thresholds, Verdict, VerdictState, check, likeness};
use crate::dynamics::{Forces, JointReaction, Workspace, inverse_with_residual};
use crate::findings::Findings;
use crate::ground::footfalls::footfalls;
use crate::ground::{BodyForces, GroundForces};
use crate::kinematics::{TrajectoryError, each_body_motion};
use crate::model::{Body, CoordinateKind, Model};
use crate::spatial::{Vec3, Wrench};
use serde::{Deserialize, Serialize};

/// The verdict on all figures of a scene that walk or follow a recording.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SceneVerdict {
    /// Infeasible if one figure is, else not judged if one figure is, else feasible.
    pub state: VerdictState,
    /// One entry per figure, in the order of the file.
    pub figures: Vec<FigureVerdict>,
}

/// The verdict on one figure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FigureVerdict {
    /// Name of the figure.
    pub figure: String,
    /// Its verdict.
    #[serde(flatten)]
    pub verdict: Verdict,
}

/// Judges every figure that walked or followed a recording; `None` if none did.
///
/// # Errors
/// A scene that has not been stepped.
pub fn scene_verdict(
    scene: &Scene,
    thresholds: &Thresholds,
    findings: &mut Findings,
) -> Result<Option<SceneVerdict>, TrajectoryError> {
    let judged = |record: FigureRecord| match record {
        FigureRecord::Walk(walk) => {
            FigureVerdict { verdict: walk_verdict(&walk, thresholds, findings), figure: walk.name }
        }
        FigureRecord::Motion(motion) => {
            FigureVerdict { verdict: motion_verdict(&motion, thresholds, findings), figure: motion.name }
        }
    };
    let figures: Vec<FigureVerdict> = scene.records()?.into_iter().map(judged).collect();
    let any = |state| figures.iter().any(|figure| figure.verdict.state == state);
    let worst = [VerdictState::Infeasible, VerdictState::NotJudged].into_iter().find(|state| any(*state));
    Ok((!figures.is_empty()).then_some(SceneVerdict { state: worst.unwrap_or(VerdictState::Feasible), figures }))
}

/// The verdict on a motion with the forces of the scene on it. Joint forces and residual come from inverse dynamics.
fn motion_verdict(motion: &FigureMotion, thresholds: &Thresholds, findings: &mut Findings) -> Verdict {
    let FigureMotion { model, trajectory, ground, loads, .. } = motion;
    let forces = inverse_with_residual(&mut Workspace::new(model), trajectory, loads);
    let up = model.up();
    let body_forces = |on: &ObstacleForces| BodyForces::on_ground(on.body, &on.force, &on.moment, up, &on.height);
    let ground = &GroundForces { bodies: ground.iter().map(body_forces).collect() };
    let person = Person::of_model(model);
    let footfalls = footfalls(model, trajectory, &person.soles, &mut Findings::default());
    let evidence = MotionAndForces {
        model,
        trajectory,
        forces: &forces,
        ground,
        device: None,
        predicted: None,
        partly_measured: &[],
        stances: None,
        activity: activity(model, trajectory, &person.soles, person.leg_length_m, &footfalls).kind,
        cutoff_hz: None,
        forces_are_predicted: false,
    };
    check(&evidence, &person, thresholds, findings)
}

fn walk_verdict(walk: &FigureWalk, thresholds: &Thresholds, findings: &mut Findings) -> Verdict {
    let recording = &walk.recording;
    let forces = forces(recording);
    let ground = ground(recording);
    let evidence = MotionAndForces {
        model: &recording.model,
        trajectory: &recording.trajectory,
        forces: &forces,
        ground: &ground,
        device: None,
        predicted: None,
        partly_measured: &[],
        stances: None,
        activity: ActivityKind::Walk,
        cutoff_hz: None,
        forces_are_predicted: false,
    };
    let person = Person::of_human(&walk.human);
    let likeness = likeness(&recording.model, &recording.trajectory, &person);
    Verdict { likeness, ..check(&evidence, &person, thresholds, findings) }
}

/// The ground forces on the feet. Contact points transmit no moment, so the free moment is zero.
fn ground(recording: &WalkRecording) -> GroundForces {
    let up = recording.model.up();
    let bodies = recording.feet.iter().map(|foot| {
        let moments: Vec<Vec3> = foot.point.iter().zip(&foot.force).map(|(point, force)| point.cross(force)).collect();
        BodyForces::on_level_ground(foot.body, &foot.force, &moments, up, 0.0)
    });
    GroundForces { bodies: bodies.collect() }
}

/// The joint drives as generalised forces. Only the moment of the root's reaction that holds the trunk upright is a
/// residual; the other components keep the figure in its plane, and its translations are free. A verdict needs the
/// reactions of no other joint.
fn forces(recording: &WalkRecording) -> Forces {
    let WalkRecording { model, trajectory, efforts, .. } = recording;
    let mut reactions = vec![Vec::new(); model.bodies().len()];
    let is_root = |body: &Body| body.joint.parent.is_none();
    let roots: Vec<usize> = (0..model.bodies().len()).filter(|index| is_root(&model.bodies()[*index])).collect();
    each_body_motion(model, trajectory, |frame, bodies| {
        for &root in &roots {
            let center = bodies[root].pose.place(model.bodies()[root].joint.child_from_joint.translation);
            let wrench = Wrench { moment: root_moment(model, efforts, root, frame), force: Vec3::zeros() };
            reactions[root].push(JointReaction { center, wrench });
        }
    });
    Forces { generalized: efforts.clone(), reactions }
}

/// Moment about the rotation axis of the root, world axes [N.m].
fn root_moment(model: &Model, efforts: &[Vec<f64>], root: usize, frame: usize) -> Vec3 {
    let joint = &model.bodies()[root].joint;
    let turning = |id: &crate::model::CoordinateId| model.coordinates()[id.index()].kind == CoordinateKind::Rotation;
    let moment: f64 = joint.coordinates().iter().filter(|id| turning(id)).map(|id| efforts[id.index()][frame]).sum();
    joint.parent_from_joint.rotation * Vec3::z() * moment
}
