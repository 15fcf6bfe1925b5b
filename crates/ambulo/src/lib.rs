//! Forces behind human walking: joint moments, powers, reactions and ground forces, computed from motion.
//!
//! ```text
//! files ──> formats ──> model + motion ──> kinematics ──> dynamics ──> analysis ──> study::Outcome
//!           bytes to    body, markers,     markers to     joint        events, cycles, body mass,
//!           records     coordinates,       coordinates    moments,     residual forces, verdict
//!                       force plates                      ground forces
//!
//! gait ──> simulation   synthetic walks, and worlds of bodies stepped through time
//! ```
//!
//! # Where to start
//!
//! | you have | start with |
//! |---|---|
//! | files of a recording: markers, coordinates of a model, a skeleton, with or without force plates | [`job::Job`] |
//! | the same, decoded | [`study::run`] |
//! | coordinates as arrays | [`dynamics::inverse`] |
//! | an OpenSim model | [`Model::from_osim`](model::Model::from_osim) |
//! | a motion without force plates | [`ground::predict`] |
//! | a motion that arrives frame by frame | [`ground::stream`] |
//! | markers, and no body yet | [`kinematics::calibration`], [`kinematics::marker_fit`] |
//! | a walking speed, and no recording | [`simulation::synthetic`] |
//! | a body, and what its motion should be like | [`optimal`] |
//! | a scene of bodies, joints and contacts | [`simulation::scene`] |
//!
//! This crate opens no file, reads no clock, starts no thread and prints nothing: it takes bytes and numbers and
//! returns values. What is unusual in the input is reported in [`findings::Findings`], which every function that needs
//! it takes as an argument.
//!
//! # Forces from a recording
//!
//! Coordinates of an OpenSim model, with the forces of force plates:
//!
//! ```no_run
//! use ambulo::formats::{external_loads::ExternalLoads, table::Table};
//! use ambulo::study::{self, ForceTable, MeasuredForces, Settings, Source};
//! use ambulo::{findings::Findings, model::Model, motion::coordinates_from_table};
//!
//! let mut findings = Findings::default();
//! let model = Model::from_osim(&std::fs::read("subject.osim")?, &mut findings)?;
//! let walk = Table::read_storage(&std::fs::read("walk.mot")?)?.0;
//! let motion = coordinates_from_table(&model, &walk, "walk.mot", &mut findings)?;
//! let table = Table::read_storage(&std::fs::read("grf.mot")?)?.0;
//! let loads = Some(ExternalLoads::read(&std::fs::read("grf.xml")?)?.0);
//! let forces = MeasuredForces::Table(ForceTable { table, loads });
//! let source = Source::coordinates(model, motion).with_forces(forces);
//! let outcome = study::run(source, &Settings::default(), &mut findings)?;
//! println!("{}, body mass {:.1} kg", outcome.verdict.state.words(), outcome.analysis.mass.kg);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Inverse dynamics of arrays
//!
//! A person of 72.6 kg standing still; without ground forces, the root joint carries the body weight:
//!
//! ```
//! use ambulo::dynamics::{Workspace, inverse};
//! use ambulo::kinematics::Trajectory;
//! use ambulo::model::anthropometry::{Build, SegmentTable};
//! use ambulo::motion::TimeGrid;
//!
//! let build = Build { table: SegmentTable::DeLevaMale, mass: 72.6, height: 1.80, toe_joint: false };
//! let model = build.human()?.model;
//! let grid = TimeGrid { start_s: 0.0, step_s: 0.01, frames: 3 };
//! let at_rest = [vec![0.0; 3], vec![0.0; 3], vec![0.0; 3]]; // value, rate and acceleration in 3 frames
//! let trajectory = Trajectory::new(&model, grid, vec![at_rest; model.coordinates().len()])?;
//! let forces = inverse(&mut Workspace::new(&model), &trajectory, &[]);
//! let vertical = model.coordinate("pelvis_ty").ok_or("no such coordinate")?;
//! assert!((forces.generalized[vertical.index()][0] - 72.6 * 9.80665).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Conventions
//!
//! SI units and radians; world x forward, y up, z to the right; body quantities at the centre of mass in world axes,
//! angular part before linear; joint moments act from the parent on the child, with the sign of the model's own
//! coordinate (docs/CONVENTIONS.md).

#[doc(inline)]
pub use ambulo_body::{
    contact, dynamics, findings, formats, kinematics, model, motion, numerics, spatial, toml_reader,
};
#[doc(inline)]
pub use ambulo_muscles as muscles;
pub use ambulo_walk::{figure_shape, gait, optimal};

#[doc(hidden)]
pub mod technical_markers;

#[doc(hidden)]
pub mod functional;

pub mod ground;

pub mod analysis;

pub mod simulation;

pub mod study;

pub mod job;

/// The code in README.md is compiled as a test.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;

/// For the tests of this crate.
#[doc(hidden)]
pub mod internals {
    pub use crate::analysis::feasibility::spans::Track;
    pub use crate::analysis::foot_progression::{inwards, level_axes};
    pub use crate::analysis::motion_bandwidth::{HIGHEST_HZ, bandwidth};
    pub use crate::analysis::prediction_checks::base_of_support::BaseOfSupport;
    pub use crate::analysis::prediction_checks::sustained::sustained_maximum;
    pub use crate::analysis::progress::Progress;
    pub use crate::analysis::recording::cycle_mean;
    pub use crate::analysis::times_and_distances::{Floor, Places, Strike};
    pub use crate::analysis::walking_direction::WalkingDirection;
    pub use crate::ground::predict::center_path::{center_path, share};
    pub use crate::ground::predict::deviation_calibration::Misfit;
    pub use crate::ground::predict::evidence_filter::EvidenceFilter;
    pub use crate::ground::predict::forefoot::heel_down;
    pub use crate::ground::predict::geometry::FootPlace;
    pub use crate::ground::predict::stance_curves::StanceCurves;
    pub use crate::ground::predict::stance_traits::traits;
    pub use crate::ground::predict::stances::{BodyScale, GaitType, Stance};
    pub use crate::ground::predict::strike_descent::{CenterVelocity, MOST, Strike as DescentStrike, USUAL, descents};
    pub use crate::ground::predict::unilateral::{unilateral_share, within_friction_cone};
    pub use crate::ground::predict::unknowns::{Curve, UNIT};
    pub use crate::ground::predict::zero_moment_point::{share_along_soles, zero_moment_point};
    pub use crate::ground::refit::{Refit, hold_loaded_feet};
    pub use crate::ground::stream::continuation::Continuation;
    pub use crate::ground::stream::frame_buffer::FrameBuffer;
    pub use crate::ground::stream::step_timing::StepTiming;
    pub use crate::ground::stream::tail::{FrameRange, NEIGHBOURS, TailSmoother};
    pub use crate::job::sensors::about_fixed_axes;
    pub use crate::job::trials::participants::{
        DESCRIPTION as PARTICIPANTS_DESCRIPTION, Size, TABLE as PARTICIPANTS_TABLE, sizes,
    };
    pub use crate::study::events::contradiction;
    pub use crate::study::force_columns::{load_columns, with_axis_last};
    pub use crate::study::mass::{KnownMass, combined, report_decided};
    pub use crate::study::quality::stance_heights::{Middle, compared};
    pub use crate::study::trial_list::pattern::Pattern;
}
