//! A recording, with the statements of the laboratory about it.

use super::error::StudyError;
use super::laboratory_file::LaboratoryFile;
use super::muscle_request::MuscleRequest;
use super::size::StatedSize;
use super::standing_trial::StandingTrial;
use crate::analysis::feasibility::Person;
use crate::analysis::{ModelProtocol, Subject};
use crate::kinematics::Trajectory;
use crate::kinematics::sensor_fit::SensorAxes;
use crate::model::anthropometry::{Build, SegmentTable};
use crate::model::marker_set::MarkerSet;
use crate::model::{Model, Side};
use crate::motion::skeleton::SkeletonRecording;
use crate::motion::{ForceRecording, Motion, SensorRecording};
use crate::numerics::mean;
use crate::spatial::Vec3;
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::table::Table;
use std::sync::Arc;

/// A recording with all statements about it. It contains data; names of files appear in messages only.
#[derive(Debug, Clone)]
pub struct Source {
    /// The recorded motion.
    pub recording: Recording,
    /// The measured ground forces.
    pub forces: MeasuredForces,
    /// Joint moments of a worn device: a table with columns named as in `moments.sto`.
    pub device: Option<Table>,
    /// Masses that the person carried.
    pub added_mass: Vec<AddedMass>,
    /// Mass and stature that a given model is scaled to, if no standing trial scales it. The built-in body has its own
    /// ([`MarkerBody::BuiltIn`]).
    pub stated: StatedSize,
    /// A movement of the same person that shows the hip centres and the knee axes of the built-in body.
    pub movement: Option<Arc<LaboratoryFile>>,
    /// Muscle forces to compute; `None` computes none.
    pub muscles: Option<MuscleRequest>,
}

impl Source {
    /// Mean width of the knees that the files of markers state [m].
    pub(super) fn knee_width_m(&self) -> Option<f64> {
        let Recording::Markers(markers) = &self.recording else { return None };
        let stated: Vec<f64> = markers.measurements().knee_width.values().copied().flatten().collect();
        (!stated.is_empty()).then(|| mean(&stated))
    }
}

/// The kinds of recording.
#[derive(Debug, Clone)]
pub enum Recording {
    /// Coordinates of a model.
    Coordinates {
        /// The body.
        model: Model,
        /// Coordinates of the model over time.
        motion: Motion,
    },
    /// Markers in a laboratory.
    Markers(Box<MarkerSource>),
    /// Joint centres of a skeleton; the built-in body takes its lengths.
    Skeleton {
        /// The joint centres.
        skeleton: SkeletonRecording,
        /// Segment masses of the built-in body.
        table: SegmentTable,
        /// Body mass [kg].
        mass_kg: f64,
    },
    /// Orientations of inertial sensors.
    Sensors(Box<SensorSource>),
    /// A complete motion with its ground forces. Nothing is smoothed or predicted.
    Complete(Box<CompleteMotion>),
}

/// Orientations of sensors, and the body that they turn.
#[derive(Debug, Clone)]
pub struct SensorSource {
    /// The motion.
    pub moving: SensorRecording,
    /// The person in the default posture of the body; `None`: the first frame of the motion.
    pub standing: Option<SensorRecording>,
    /// Axes of the sensors' earth.
    pub axes: SensorAxes,
    /// The body.
    pub body: SensorBody,
}

/// The body that sensors turn.
#[derive(Debug, Clone)]
pub enum SensorBody {
    /// The built-in one.
    BuiltIn(Build),
    /// A model.
    Model(Model),
}

/// A complete motion with its ground forces, from a synthetic walk or a simulation.
#[derive(Debug, Clone)]
pub struct CompleteMotion {
    /// The body.
    pub model: Model,
    /// Stature and soles.
    pub person: Person,
    /// The motion.
    pub trajectory: Trajectory,
    /// The forces of the ground.
    pub loads: Vec<ForceRecording>,
    /// How the forces were divided between the feet in double support.
    pub rule: &'static str,
}

/// Measured ground forces.
#[derive(Debug, Clone, Default)]
pub enum MeasuredForces {
    /// Forces of the force plates in a recording of markers, if it has any.
    #[default]
    InRecording,
    /// Forces on bodies of the model.
    OnBodies(Vec<ForceRecording>),
    /// A table, in the axes of the markers or of the world.
    Table(ForceTable),
}

/// A table of ground forces, and which columns act on which body.
#[derive(Debug, Clone)]
pub struct ForceTable {
    /// The table.
    pub table: Table,
    /// The columns of each foot; `None` recognises columns by the names that laboratories use.
    pub loads: Option<ExternalLoads>,
}

/// Markers, and the body that follows them.
#[derive(Debug, Clone)]
pub struct MarkerSource {
    /// The trial.
    pub trial: LaboratoryFile,
    /// The same person standing still.
    pub standing: Option<Arc<StandingTrial>>,
    /// The body.
    pub body: MarkerBody,
    /// Statements of the laboratory about force plates.
    pub plates: Vec<PlateAssignment>,
}

/// The body that follows markers.
#[derive(Debug, Clone)]
pub enum MarkerBody {
    /// The built-in one, calibrated from the standing trial or, without one, from the trial itself.
    BuiltIn {
        /// Segment masses.
        table: SegmentTable,
        /// Stated body mass [kg]; `None` takes it from the standing trial or the files.
        mass_kg: Option<f64>,
        /// Stature [m]; `None` takes it from the files or estimates it from the legs.
        height_m: Option<f64>,
        /// The set of markers; `None` finds it by the names of the markers.
        set: Option<MarkerSet>,
    },
    /// A model, scaled to the person if there is a standing trial.
    Model {
        /// The model.
        model: Model,
        /// Body mass [kg]; `None` keeps the value of the model, or takes the value of the protocol.
        mass_kg: Option<f64>,
        /// The statements of a laboratory that works with OpenSim; `None` detects the axes of the recordings, and sizes
        /// from the standing trial.
        protocol: Option<Box<ModelProtocol>>,
    },
    /// A body that was calibrated before.
    Calibrated(Box<Subject>),
}

/// A statement of the laboratory about a force plate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlateAssignment {
    /// The plate, counted from 0 in the order of the file.
    pub plate: usize,
    /// Which foot is on it, or what is wrong with it.
    pub(crate) used: PlateUse,
}

/// Which foot is on a force plate, or what is wrong with it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PlateUse {
    /// One foot was on it.
    Foot(Side),
    /// No foot was on it; its recording is left out.
    Off,
    /// Its force along x (0) or y (1) has the wrong sign.
    Flip(usize),
    /// Its recording must be turned to the left, as seen from above, by this many quarters.
    Turn(i32),
}

/// A mass that the person carried.
#[derive(Debug, Clone, PartialEq)]
pub struct AddedMass {
    /// The body that it is fixed to.
    pub body: String,
    /// Mass [kg].
    pub mass_kg: f64,
    /// Position in the frame of the body [m].
    pub position_m: Vec3,
}

impl Source {
    /// A recording alone: its own force plates, no device, no added mass.
    #[must_use]
    pub fn new(recording: Recording) -> Source {
        Source {
            recording,
            forces: MeasuredForces::InRecording,
            device: None,
            added_mass: Vec::new(),
            stated: StatedSize::default(),
            movement: None,
            muscles: None,
        }
    }

    /// Coordinates of a model, without measured forces.
    #[must_use]
    pub fn coordinates(model: Model, motion: Motion) -> Source {
        Source::new(Recording::Coordinates { model, motion })
    }

    /// Markers.
    #[must_use]
    pub fn markers(markers: MarkerSource) -> Source {
        Source::new(Recording::Markers(Box::new(markers)))
    }

    /// The same recording with these ground forces.
    #[must_use]
    pub fn with_forces(self, forces: MeasuredForces) -> Source {
        Source { forces, ..self }
    }
}

impl AddedMass {
    /// The model with this mass.
    pub(super) fn on(&self, model: &Model) -> Result<Model, StudyError> {
        let Some(body) = model.body(&self.body) else {
            let known = model.bodies().iter().map(|body| body.name.clone()).collect();
            return Err(StudyError::UnknownBody { found: self.body.clone(), known });
        };
        model.with_point_mass(body, self.mass_kg, self.position_m).map_err(StudyError::AddedMass)
    }
}
