//! Checks of the clock of a recording before any computation: the time between its samples, held samples, and the
//! delay of the forces that the caller states.
//! Pinned by: tests/study_timing.rs

use super::error::StudyError;
use super::source::{MarkerSource, MeasuredForces, Recording};
use crate::analysis::LaboratoryRecording;
use crate::findings::Findings;
use crate::motion::{
    misread_step, release_held_coordinates, release_held_markers, release_held_poses, release_held_sensors,
};
use crate::numerics::median;

impl Recording {
    /// The recording with gaps in place of held samples, and its force plates without a stated delay.
    pub(super) fn with_sound_clock(mut self, delay_s: f64, findings: &mut Findings) -> Result<Recording, StudyError> {
        check_step(self.times())?;
        match &mut self {
            Recording::Coordinates { model, motion } => release_held_coordinates(model, motion, findings),
            Recording::Markers(markers) => {
                markers.trial.recording.release_held(findings);
                markers.shift_plates(delay_s);
            }
            Recording::Skeleton { skeleton, .. } => {
                release_held_markers(&mut skeleton.markers, findings);
                skeleton.markers = skeleton.markers.trimmed_to_visible();
            }
            Recording::Sensors(sensors) => release_held_sensors(&mut sensors.moving, findings),
            Recording::Complete(_) => {}
        }
        Ok(self)
    }

    /// Times of the samples [s]; empty for a complete motion.
    fn times(&self) -> &[f64] {
        match self {
            Recording::Coordinates { motion, .. } => &motion.times,
            Recording::Markers(markers) => &markers.trial.recording.markers.times,
            Recording::Skeleton { skeleton, .. } => &skeleton.markers.times,
            Recording::Sensors(sensors) => &sensors.moving.times,
            Recording::Complete(_) => &[],
        }
    }
}

/// Rejects a time between samples that no recording of a movement has.
fn check_step(times: &[f64]) -> Result<(), StudyError> {
    let steps = times.windows(2).map(|pair| pair[1] - pair[0]);
    let Some(step_s) = median(steps) else { return Ok(()) };
    match misread_step(step_s) {
        Some((looks_like, seconds)) => Err(StudyError::Clock { step_s, looks_like, seconds }),
        None => Ok(()),
    }
}

impl LaboratoryRecording {
    /// Makes gaps of the held samples of markers, or of poses and the points that follow from them.
    fn release_held(&mut self, findings: &mut Findings) {
        match &mut self.poses {
            None => release_held_markers(&mut self.markers, findings),
            Some(poses) => {
                if release_held_poses(poses, findings) {
                    self.markers = poses.points(&self.markers.name);
                }
            }
        }
    }
}

impl MarkerSource {
    /// Moves what the force plates measured to earlier times [s].
    fn shift_plates(&mut self, delay_s: f64) {
        if delay_s.abs() > 0.0 {
            let plates = &mut self.trial.recording.plates;
            plates.iter_mut().flat_map(|plate| &mut plate.times).for_each(|time| *time -= delay_s);
        }
    }
}

impl MeasuredForces {
    /// Forces on bodies without a delay; from plates and tables the delay is removed where they are read.
    pub(super) fn without_delay(mut self, delay_s: f64) -> MeasuredForces {
        if let MeasuredForces::OnBodies(forces) = &mut self
            && delay_s.abs() > 0.0
        {
            forces.iter_mut().flat_map(|force| &mut force.times).for_each(|time| *time -= delay_s);
        }
        self
    }
}
