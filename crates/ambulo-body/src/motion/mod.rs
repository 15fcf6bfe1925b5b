//! Recorded motion and forces: sampled series with names and units, their gaps, filters and derivatives.
//!
//! A [`Motion`] has recorded coordinates as in the file, in SI units. [`smooth`] resamples them to a uniform
//! [`TimeGrid`], filters and differentiates them. A [`ForceRecording`] has the forces of force plates or other sensors.

mod b3d_trial;
mod bids;
mod clock;
mod curves;
mod device_recording;
mod drawn;
pub mod filter;
pub mod force_plate;
mod force_recording;
mod gait_event;
#[doc(hidden)]
pub mod gaps;
mod glitches;
mod guessed_unit;
mod held;
mod import;
mod jumps;
mod laboratory;
pub mod landmarks;
mod live_checks;
mod marker_recording;
mod marker_table;
mod real_points;
mod recorded_motion;
mod recording;
mod segment_poses;
mod sensor_recording;
pub mod skeleton;
mod smooth;
mod smpl;
mod straightened;
mod subject_parameters;
mod time_grid;

pub use b3d_trial::{B3dError, B3dTrial, reasons as missing_force_reasons};
#[doc(hidden)]
pub use bids::BidsError;
pub use bids::{coordinates_from_bids, is_bids_markers, markers_from_bids};
pub use clock::{clock_of_table, misread_step, unit_of_times};
pub use curves::{CurveError, RecordedTable};
pub use device_recording::{DeviceRecording, device_from_table};
pub use force_plate::{PlateError, PlateRecording, PlateSettings, plates_from_c3d, standing_weight_n};
pub use force_recording::{ForceRecording, force_recordings};
pub use gait_event::{Event, EventKind, events_from_c3d};
pub use held::{release_held_coordinates, release_held_markers, release_held_poses, release_held_sensors};
pub use import::coordinates_from_table;
#[doc(hidden)]
pub use jumps::{Jumps, jumps};
pub use laboratory::{Heading, Laboratory, laboratory, laboratory_of_landmarks};
pub use landmarks::Landmarks;
pub use live_checks::LiveChecks;
pub use marker_recording::{MarkerError, MarkerPath, MarkerRecording, markers_from_c3d, markers_from_trc};
pub use marker_table::{is_marker_table, markers_from_table};
#[doc(hidden)]
pub use real_points::are_markers;
pub use recorded_motion::{RecordedMotion, motion_from_c3d};
pub use recording::{Motion, MotionError};
#[doc(hidden)]
pub use segment_poses::PosedSegment;
pub(crate) use segment_poses::posed_segment;
pub use segment_poses::{
    SegmentPoseError, SegmentPoses, events_from_mvnx, segment_poses_from_c3d, segment_poses_from_mvnx,
};
#[doc(hidden)]
pub use sensor_recording::SensorPath;
pub use sensor_recording::{SensorRecording, sensors_from_table};
#[doc(hidden)]
pub use smooth::check_range;
pub use smooth::{SmoothMotion, SmoothSettings, Smoother, smooth};
pub use smpl::{SmplBody, SmplError, SmplMotion};
pub use straightened::straightened;
pub use subject_parameters::{SubjectParameters, subject_from_c3d};
pub use time_grid::{Between, TimeGrid, Window, interpolate};
