//! Worlds stepped through time: figures, obstacles, driven joints, collisions, scenes.

pub mod scene;
