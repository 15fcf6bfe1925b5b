//! Worlds of bodies stepped through time, figures that walk in them, and the verdict on a scene.
//!
//! [`World`], [`step`] and what belongs to them are the simulator. [`walking`] and [`consistent_walk`] have figures
//! that walk, [`control`] figures that walk by their own torques, [`scene`] worlds from files, [`synthetic`] walks from
//! a gait and a body size. [`scene_verdict`] judges the figures of a scene, [`scene_walked`] says how far they came.

mod verdict;
mod walked;

#[doc(inline)]
pub use ambulo_walk::engine::*;
#[doc(inline)]
pub use ambulo_walk::{consistent_walk, scene, synthetic, walking};
pub use verdict::{FigureVerdict, SceneVerdict, scene_verdict};
pub use walked::{FigureWalked, scene_walked};

/// Figures that walk by their own torques: feedback keeps them near a planned walk.
pub mod control {
    #[doc(inline)]
    pub use ambulo_walk::control::*;
    #[doc(inline)]
    pub use ambulo_walk::tuning;
}
