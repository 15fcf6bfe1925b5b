//! Description of a motion for drawing: bodies with shapes and paths, ground forces, joint moments, plates, obstacles.
//!
//! Used by the 3-D view of the page (which quantises it) and by animation files. World axes: x forward, y up, z right,
//! m.

mod arrow;
mod contact_forces;
pub(crate) mod csv_rows;
mod figure;
mod floor;
mod ground_plane;
mod muscle;
pub(crate) mod path;
mod scene;
mod sole;
mod sound;
mod torque;

pub(crate) use figure::{FolderMotion, figure_shapes, folder_motion};
pub use path::quaternion;
pub(crate) use path::{BodyPath, upward_to};

use super::page::ViewShape;
use ambulo::figure_shape::BodySolid;
use ambulo::model::Side;
use ambulo::motion::TimeGrid;
use ambulo::spatial::Vec3;
use ambulo_results::{Folder, KINEMATICS, POSES, ResultsError};

/// A motion to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// The instants of all paths.
    pub grid: TimeGrid,
    /// The bodies that move, parents first.
    pub bodies: Vec<StageBody>,
    /// Fixed shapes, in world axes.
    pub fixed: Vec<ViewShape>,
    /// Force plates.
    pub plates: Vec<StagePlate>,
    /// Ground forces.
    pub forces: Vec<StageForce>,
    /// Joint moments.
    pub torques: Vec<StageTorque>,
    /// Points of the soles.
    pub contacts: Vec<StageContact>,
    /// Muscles with their activation.
    pub muscles: Vec<StageMuscle>,
    /// Height of the floor [m].
    pub floor_m: f64,
    /// Weight of all bodies [N].
    pub weight_n: f64,
    /// Sentences on what is not shown, and why.
    pub missing: Vec<String>,
}

impl Stage {
    /// The stage of a result folder, or why there is none.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn of_folder(folder: &Folder<'_>) -> Result<Result<Stage, String>, ResultsError> {
        let is_scene = !folder.has(KINEMATICS) && folder.has(POSES);
        if is_scene { Stage::of_scene(folder) } else { Stage::of_figure(folder) }
    }
}

/// A body with its shapes and its path.
#[derive(Debug, Clone, PartialEq)]
pub struct StageBody {
    /// Name.
    pub name: String,
    /// Index in `bodies` of its parent.
    pub parent: Option<usize>,
    /// Side of the body; `None` in the middle.
    pub side: Option<Side>,
    /// Shapes in its axes.
    pub shapes: Vec<ViewShape>,
    /// Pose of the body over time.
    pub path: BodyPath,
    /// The same in the recorded motion, where the motion was changed.
    pub recorded: Option<BodyPath>,
}

/// A force plate.
#[derive(Debug, Clone, PartialEq)]
pub struct StagePlate {
    /// Name.
    pub name: String,
    /// Corners in turn [m].
    pub corners: [[f64; 3]; 4],
}

/// The part of a force in the view.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ForceRole {
    /// The results are based on it.
    Main,
    /// Force plates measured it; the results are based on a prediction.
    Measured,
}

/// A force with its point of application, one entry per instant; both are NaN while it does not act.
#[derive(Debug, Clone, PartialEq)]
pub struct StageForce {
    /// Name: `right`, `left, plates`.
    pub name: String,
    /// Side of the force.
    pub side: Option<Side>,
    /// Whether results are based on it, or it is shown for comparison.
    pub role: ForceRole,
    /// Point of application [m].
    pub point: Vec<Vec3>,
    /// The force on the body [N].
    pub force: Vec<Vec3>,
}

/// A joint moment about an axis of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct StageTorque {
    /// Name: `right knee flexion`.
    pub name: String,
    /// Side of the moment.
    pub side: Option<Side>,
    /// Index in `bodies` of the body on which it acts.
    pub body: usize,
    /// Centre of the joint in this body's axes [m].
    pub center: Vec3,
    /// Unit axis of a positive moment, in the axes of this body.
    pub axis: Vec3,
    /// Moment [N.m/kg] in clinical sign, one entry per instant.
    pub values: Vec<f64>,
    /// The panel that shows it.
    pub panel: String,
}

/// A point of a sole.
#[derive(Debug, Clone, PartialEq)]
pub struct StageContact {
    /// Index in `bodies`.
    pub body: usize,
    /// Place in the axes of this body [m].
    pub place: Vec3,
    /// Side of the sole.
    pub side: Option<Side>,
}

/// A muscle as a line through points of bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct StageMuscle {
    /// Name in the model.
    pub name: String,
    /// Side of the muscle.
    pub side: Option<Side>,
    /// Index in `bodies`, and place in the axes of this body [m], from origin to insertion.
    pub points: Vec<(usize, Vec3)>,
    /// Activation, one entry per instant.
    pub activation: Vec<f64>,
}

/// Solids of a body as shapes.
fn view_shapes(solids: &[BodySolid]) -> Vec<ViewShape> {
    let of = |solid: &BodySolid| match solid {
        BodySolid::Capsule { from, to, radius } => {
            ViewShape::Capsule { from: (*from).into(), to: (*to).into(), radius: *radius }
        }
        BodySolid::Faces { points, triangles } => ViewShape::Mesh {
            points: points.iter().map(|point| (*point).into()).collect(),
            triangles: triangles.clone(),
        },
    };
    solids.iter().map(of).collect()
}
