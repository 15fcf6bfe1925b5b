//! The simulator: worlds of rigid bodies, driven joints, contacts and loops, stepped through time.
//!
//! A [`World`] describes bodies, the [`TreeJoint`]s that make trees of them, [`Closure`]s that close loops, and
//! [`Surface`]s that may touch. A [`WorldState`] contains positions and velocities; [`step`] advances it, and
//! [`StepWorkspace::forces`] returns the forces of the step, which are the multipliers of its constraints. Every body
//! has six coordinates. Only memory limits their number.
//!
//! A pendulum (a point of 1 kg on a rod of 1 m), released at the height of its hinge, has the speed √(2 g l) at its
//! lowest point:
//!
//! ```
//! use ambulo_walk::findings::Findings;
//! use ambulo_walk::engine::{
//!     RigidBody, Integrator, TreeJoint, JointCoordinate, JointKind, WorldState, StepSettings, StepWorkspace, World, step,
//! };
//! use ambulo_walk::spatial::{Mat3, Pose, Twist, Vec3, Wrench};
//!
//! let mut world = World::default();
//! world.bodies.push(RigidBody {
//!     name: "bob".to_owned(),
//!     mass: 1.0,
//!     inertia: Mat3::zeros(),
//!     pose: Pose::at(Vec3::new(1.0, 0.0, 0.0)),
//!     twist: Twist::ZERO,
//!     load: Wrench::ZERO,
//! });
//! world.joints.push(TreeJoint {
//!     name: "hinge".to_owned(),
//!     child: 0,
//!     parent: None,                                              // the world
//!     parent_from_joint: Pose::IDENTITY,                         // turns about z
//!     child_from_joint: Pose::at(Vec3::new(-1.0, 0.0, 0.0)),
//!     kind: JointKind::Revolute,
//!     coordinates: vec![JointCoordinate::default()],
//!     follows: None,
//! });
//! world.check()?;
//!
//! let settings = StepSettings { integrator: Integrator::RungeKutta, ..StepSettings::default() };
//! let (mut state, mut workspace, mut findings) = (WorldState::new(&world), StepWorkspace::default(), Findings::default());
//! let mut fastest = 0.0_f64;
//! for _ in 0..2000 {
//!     step(&world, &mut state, &settings, &mut workspace, &mut findings)?;
//!     fastest = fastest.max(state.twists[0].linear.norm());
//! }
//! assert!((fastest - (2.0 * 9.80665_f64).sqrt()).abs() < 1e-5);
//! // The force of the hinge on the bob, here after 2 s.
//! println!("force of the hinge now: {:?} N", workspace.forces(&world).joints[0].force);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! docs/SIMULATION.md explains the method; docs/measured/BENCHMARKS.md lists measured speed and accuracy.

mod check;
pub(crate) mod energy;
mod fallen;
pub(crate) mod figure_tree;
pub(crate) mod joint;
mod legs;
mod midpoint;
mod samples;
pub(crate) mod signal;
pub(crate) mod state;
pub(crate) mod world;

mod assemble;
mod contradiction;
pub(crate) mod forces;
mod impact;
mod impulse;
pub(crate) mod projection;
pub(crate) mod row;
mod smooth;
pub(crate) mod soles;
pub(crate) mod start;
pub(crate) mod step;
pub(crate) mod touch;
pub(crate) mod workspace;

pub use check::WorldError;
pub use energy::{Energy, energy};
pub use forces::{ContactForce, Impact, StepForces};
pub use joint::JointKind;
pub use projection::largest_joint_error;
pub use samples::Samples;
pub use signal::Signal;
pub use start::start;
#[doc(hidden)]
pub use state::RowKey;
pub use state::WorldState;
pub use step::{accelerations, step};
pub use workspace::{Integrator, StepSettings, StepWorkspace};
pub use world::{
    Closure, Figure, Follows, ImpactLaw, JointCoordinate, Material, Motor, Obstacle, Owner, RigidBody, Spring, Surface,
    TreeJoint, World,
};
#[doc(hidden)]
pub use world::{ContactLaw, JointDrive, ObstaclePath};
