//! Ranges of motion of the joints.
//!
//! Normal ranges of motion as listed in the Merck manual and in clinical tables (hip flexion 125, extension 15 to 30;
//! knee flexion 130 to 150, hyperextension 0 to 15; ankle dorsiflexion 20, plantarflexion 50; first metatarsophalangeal
//! extension 70 to 80, flexion 30 to 45; shoulder flexion 180, extension 60; elbow flexion 150 to 160, extension 0 to
//! 10; lumbar flexion 75, extension 30), read; the larger value is used. Dorsiflexion is listed for an unloaded foot;
//! under load it is larger, and 35 is used here (unverified).

/// Range of a coordinate [deg].
pub(super) type Range = [f64; 2];

pub(super) const LUMBAR_EXTENSION: Range = [-75.0, 30.0];
pub(super) const HIP_FLEXION: Range = [-30.0, 125.0];
/// Extension is positive.
pub(super) const KNEE: Range = [-150.0, 10.0];
/// Dorsiflexion is positive.
pub(super) const ANKLE: Range = [-50.0, 35.0];
/// Toes up is positive.
pub(super) const TOES: Range = [-45.0, 80.0];
pub(super) const SHOULDER_FLEXION: Range = [-60.0, 180.0];
pub(super) const ELBOW_FLEXION: Range = [-10.0, 160.0];
