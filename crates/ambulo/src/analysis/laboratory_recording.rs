//! Markers and force plates of a laboratory file, and their transformation to world axes.

use crate::findings::{Code, Findings};
use crate::model::marker_set::MarkerSet;
use crate::motion::force_plate::PlateRecording;
use crate::motion::{Laboratory, Landmarks, MarkerRecording, SegmentPoses, laboratory_of_landmarks};
use crate::spatial::Vec3;

/// The markers and force plates of one laboratory file, in the laboratory's axes.
#[derive(Debug, Clone)]
pub struct LaboratoryRecording {
    /// Markers, or the points of `poses` [m].
    pub markers: MarkerRecording,
    /// Poses of segments, if the file has them instead of markers.
    pub poses: Option<SegmentPoses>,
    /// Force plates.
    pub plates: Vec<PlateRecording>,
    /// The unit of length as the file states it.
    pub unit: String,
}

impl LaboratoryRecording {
    /// Detects the laboratory's axes; returns them with the recording in world axes.
    #[must_use]
    pub fn in_world(&self, findings: &mut Findings) -> (Laboratory, LaboratoryRecording) {
        self.in_world_by(None, findings)
    }

    /// As [`LaboratoryRecording::in_world`], with the landmarks of a marker set.
    pub(super) fn in_world_by(
        &self,
        set: Option<&MarkerSet>,
        findings: &mut Findings,
    ) -> (Laboratory, LaboratoryRecording) {
        let landmarks = Landmarks::named(&self.markers, set);
        let axes = laboratory_of_landmarks(&self.markers, &landmarks, &self.plates, &self.unit, findings);
        self.turned(axes)
    }

    /// As [`LaboratoryRecording::in_world`] for a recording in the axes of the ground of a model. If the person is
    /// upright along another axis than y, the axes are those that were detected, with a warning.
    pub(super) fn in_ground(&self, findings: &mut Findings) -> (Laboratory, LaboratoryRecording) {
        let mut of_detection = Findings::default();
        let landmarks = Landmarks::named(&self.markers, None);
        let axes = laboratory_of_landmarks(&self.markers, &landmarks, &self.plates, &self.unit, &mut of_detection);
        let is_upright = of_detection.has(Code::LaboratoryUpUnclear) || axes.has_up(Vec3::y());
        if !is_upright {
            let message = format!(
                "{}: the person is not upright along y, as in the ground of the model; the axes were detected: {}",
                self.markers.name, axes.statement
            );
            findings.report(Code::LaboratoryUpContradicted, message);
            return self.turned(axes);
        }
        self.turned(axes.as_ground(&self.unit))
    }

    fn turned(&self, axes: Laboratory) -> (Laboratory, LaboratoryRecording) {
        let plates = self.plates.iter().map(|plate| axes.plate(plate)).collect();
        let (markers, poses) = (axes.markers(&self.markers), self.poses.as_ref().map(|poses| axes.poses(poses)));
        let turned = LaboratoryRecording { markers, poses, plates, unit: self.unit.clone() };
        (axes, turned)
    }
}
