//! The source of the forces of a study, and the fit of its body to the recording.

use super::region_fit::RegionFit;
use crate::analysis::{BodyInMotion, Event};
use crate::kinematics::FlightGravity;
use crate::kinematics::marker_fit::MarkerFit;

/// Where ground forces come from.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum ForceOrigin {
    /// Force plates or other sensors.
    Measured,
    /// Force plates or other sensors; the motion where a foot was not on them.
    Mixed {
        /// How double support was resolved.
        rule: &'static str,
    },
    /// The motion itself.
    Predicted {
        /// How double support was resolved.
        rule: &'static str,
    },
    /// A simulation of the motion.
    Simulated {
        /// How double support was resolved.
        rule: &'static str,
    },
    /// There are none.
    #[default]
    None,
}

/// How a body follows what was recorded.
#[derive(Debug, Clone)]
pub enum Tracking {
    /// Markers.
    Markers(Box<TrackedMarkers>),
    /// A skeleton.
    Skeleton {
        /// The assumed unit and axes, in one line.
        statement: String,
        /// How well the body follows.
        fit: Box<MarkerFit>,
        /// The same by region of the body.
        regions: Vec<RegionFit>,
        /// How the person falls in flight, at the stated frame rate; `None` without a flight.
        flights: Option<FlightGravity>,
    },
}

impl Tracking {
    /// How well the body follows, by region of the body: those that have markers, in the order of
    /// [`Region::ALL`](crate::model::Region::ALL).
    #[must_use]
    pub fn regions(&self) -> &[RegionFit] {
        match self {
            Tracking::Markers(tracked) => &tracked.regions,
            Tracking::Skeleton { regions, .. } => regions,
        }
    }
}

/// A body that follows markers.
#[derive(Debug, Clone)]
pub struct TrackedMarkers {
    /// The body, its motion, and which foot was on which plate.
    pub body: BodyInMotion,
    /// How well it follows, by region of the body.
    pub regions: Vec<RegionFit>,
    /// Foot strikes and foot offs that the file lists.
    pub listed_events: Vec<Event>,
    /// Events that plates measured.
    pub measured_events: Vec<Event>,
}
