//! One file of a laboratory: markers, force plates, events, and statements about the person.

use crate::analysis::{LaboratoryRecording, MarkerTrialError, identity};
use crate::findings::{Code, Finding, Findings};
use crate::motion::force_plate::{PlateError, PlateSettings, plates_from_c3d};
use crate::motion::{
    Event, MarkerError, MarkerPath, MarkerRecording, RecordedMotion, SegmentPoseError, SubjectParameters, are_markers,
    events_from_c3d, events_from_mvnx, markers_from_table, markers_from_trc, motion_from_c3d, segment_poses_from_mvnx,
    subject_from_c3d,
};
use crate::numerics::counted;
use crate::spatial::Vec3;
use ambulo_formats::c3d::C3d;
use ambulo_formats::mvnx::Mvnx;
use ambulo_formats::table::Table;
use ambulo_formats::trc::Trc;
use ambulo_formats::{Error, Remark};

/// Markers and all that was recorded with them, in the axes of the laboratory.
#[derive(Debug, Clone)]
pub struct LaboratoryFile {
    /// Markers and force plates; a TRC has no plates.
    pub recording: LaboratoryRecording,
    /// Foot strikes and foot offs that the file lists.
    pub events: Vec<Event>,
    /// Statements of the file about the person.
    pub subject: SubjectParameters,
    /// The number of force plates that the file states; some may be left out of the recording.
    pub stated_plates: usize,
}

/// Why a file of a laboratory cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LaboratoryFileError {
    /// The format.
    #[error(transparent)]
    Format(#[from] Error),
    /// The markers of a TRC or a table.
    #[error(transparent)]
    Markers(#[from] MarkerError),
    /// The markers or poses of a C3D, or the poses of a motion of Xsens MVN.
    #[error(transparent)]
    Poses(#[from] SegmentPoseError),
    /// The force plates.
    #[error(transparent)]
    Plates(#[from] PlateError),
    /// A file without a recording.
    #[error("the file holds no frames{}; expected a recorded trial. hint: export it again",
        .remark.as_ref().map_or_else(String::new, |remark| format!(" ({remark})")))]
    NoFrames {
        /// The last oddity of the file.
        remark: Option<String>,
    },
}

/// Markers of a person standing still stay this close to their mean position, root mean square [m]: sway is 1 to 2 cm.
const STILL_M: f64 = 0.05;
/// The share of the markers that do; others may be lost, or mistaken for each other.
const STILL_SHARE: f64 = 0.75;

impl LaboratoryFile {
    /// Whether the person stands, sits or lies still: three quarters of the markers stay within 5 cm of their mean
    /// position. Markers alone decide, so that a standing trial is found before there is a body.
    #[must_use]
    pub(crate) fn is_still(&self) -> bool {
        let spread_m = |path: &MarkerPath| {
            let seen = || path.positions.iter().filter(|position| position.iter().all(|x| x.is_finite()));
            let count = seen().count().max(1) as f64;
            let mean = seen().sum::<Vec3>() / count;
            (seen().count() > 0).then(|| (seen().map(|p| (p - mean).norm_squared()).sum::<f64>() / count).sqrt())
        };
        let spreads: Vec<f64> = self.recording.markers.markers.iter().filter_map(spread_m).collect();
        let still = spreads.iter().filter(|spread| **spread < STILL_M).count();
        !spreads.is_empty() && still as f64 >= STILL_SHARE * spreads.len() as f64
    }

    /// The markers of one person of several in the file, by the prefix of their names; the file as it is for `None`,
    /// and if it is of one person who has this name or none.
    ///
    /// # Errors
    /// A name that no person of the file has.
    pub fn of_person(mut self, name: Option<&str>) -> Result<LaboratoryFile, MarkerTrialError> {
        let Some(name) = name else { return Ok(self) };
        if identity::people_in(&self.recording.markers).len() > 1 {
            self.recording.markers = identity::person_in(self.recording.markers, name)?;
            self.subject.name = Some(name.to_owned());
            return Ok(self);
        }
        match &self.subject.name {
            Some(own) if !own.trim().eq_ignore_ascii_case(name.trim()) => {
                Err(MarkerTrialError::NoSuchPerson { found: name.to_owned(), people: vec![own.clone()] })
            }
            _ => Ok(self),
        }
    }

    /// From the bytes of a C3D; `label` names the file in findings. Bytes that are not borrowed are dropped as soon as
    /// they are decoded, and points that are no markers are not decoded.
    ///
    /// # Errors
    /// A file that is no C3D, holds no frames, or has markers or plates that cannot be used.
    pub fn from_c3d(
        bytes: impl AsRef<[u8]>,
        label: &str,
        findings: &mut Findings,
    ) -> Result<LaboratoryFile, LaboratoryFileError> {
        let (c3d, remarks) = C3d::read_points(bytes.as_ref(), are_markers)?;
        drop(bytes);
        report_remarks(label, &remarks, findings);
        if c3d.frames() == 0 {
            return Err(LaboratoryFileError::NoFrames { remark: remarks.last().map(ToString::to_string) });
        }
        let mut recording = LaboratoryFile::recording_of_c3d(&c3d, findings)?;
        recording.markers.name = label.to_owned();
        Ok(LaboratoryFile {
            recording,
            events: events_from_c3d(&c3d, findings),
            subject: subject_from_c3d(&c3d),
            stated_plates: c3d.each_platform().len(),
        })
    }

    /// Markers, or poses of segments, and force plates of a C3D.
    ///
    /// # Errors
    /// Markers or plates that cannot be used.
    pub fn recording_of_c3d(c3d: &C3d, findings: &mut Findings) -> Result<LaboratoryRecording, LaboratoryFileError> {
        let RecordedMotion { markers, poses } = motion_from_c3d(c3d, findings)?;
        Ok(LaboratoryRecording {
            markers,
            poses,
            plates: plates_from_c3d(c3d, PlateSettings::default(), findings)?,
            unit: c3d.point_unit.clone(),
        })
    }

    /// From a table of markers; `label` names the file in findings.
    ///
    /// # Errors
    /// A table whose markers cannot be used.
    pub fn from_table(
        table: &Table,
        label: &str,
        findings: &mut Findings,
    ) -> Result<LaboratoryFile, LaboratoryFileError> {
        Ok(LaboratoryFile::of_markers(markers_from_table(table, label, findings)?))
    }

    /// Markers alone, in metres.
    #[must_use]
    pub fn of_markers(markers: MarkerRecording) -> LaboratoryFile {
        LaboratoryFile {
            recording: LaboratoryRecording { markers, poses: None, plates: Vec::new(), unit: "m".to_owned() },
            events: Vec::new(),
            subject: SubjectParameters::default(),
            stated_plates: 0,
        }
    }

    /// From the bytes of a motion of Xsens MVN; `label` names the file in findings. Its frames have the poses of
    /// segments, and its contact flags are listed as foot strikes and foot offs.
    ///
    /// # Errors
    /// A file that is no `.mvnx`, or has poses that cannot be used.
    pub fn from_mvnx(
        bytes: impl AsRef<[u8]>,
        label: &str,
        findings: &mut Findings,
    ) -> Result<LaboratoryFile, LaboratoryFileError> {
        let (mvnx, remarks) = Mvnx::read(bytes.as_ref())?;
        drop(bytes);
        report_remarks(label, &remarks, findings);
        let poses = segment_poses_from_mvnx(&mvnx, findings)?;
        let message = format!(
            "poses of {} of Xsens MVN drive the body ({})",
            counted(poses.segments.len(), "segment"),
            poses.statement
        );
        findings.report(Code::PosesUsed, message);
        let markers = poses.points(label);
        let recording = LaboratoryRecording { markers, poses: Some(poses), plates: Vec::new(), unit: "m".to_owned() };
        let (events, subject) = (events_from_mvnx(&mvnx), SubjectParameters::default());
        Ok(LaboratoryFile { recording, events, subject, stated_plates: 0 })
    }

    /// From the bytes of a TRC; `label` names the file in findings.
    ///
    /// # Errors
    /// A file that is no TRC, or has markers that cannot be used.
    pub fn from_trc(
        bytes: impl AsRef<[u8]>,
        label: &str,
        findings: &mut Findings,
    ) -> Result<LaboratoryFile, LaboratoryFileError> {
        let (mut trc, remarks) = Trc::read(bytes.as_ref())?;
        drop(bytes);
        // Errors name the file, not the path in its first line.
        trc.name.clear();
        report_remarks(label, &remarks, findings);
        let mut markers = markers_from_trc(&trc, findings)?;
        markers.name = label.to_owned();
        Ok(LaboratoryFile {
            recording: LaboratoryRecording {
                markers,
                poses: None,
                plates: Vec::new(),
                unit: trc.unit.symbol().to_owned(),
            },
            events: Vec::new(),
            subject: SubjectParameters::default(),
            stated_plates: 0,
        })
    }
}

/// Reads a standing trial with `read`. Its findings are marked as such, and those that the walk has already are not
/// repeated.
///
/// # Errors
/// Errors of `read`.
pub fn standing_trial<T, E>(findings: &mut Findings, read: impl FnOnce(&mut Findings) -> Result<T, E>) -> Result<T, E> {
    let mut own = Findings::default();
    let file = read(&mut own);
    let of_walk = findings.clone();
    for finding in own.as_slice() {
        if !of_walk.as_slice().iter().any(|known| known.code == finding.code && known.message == finding.message) {
            findings.add(Finding { message: format!("standing trial: {}", finding.message), ..finding.clone() });
        }
    }
    file
}

/// Oddities of a file become findings.
fn report_remarks(label: &str, remarks: &[Remark], findings: &mut Findings) {
    for remark in remarks {
        let code = if remark.is_about_clock { Code::MotionClock } else { Code::FileOdd };
        findings.report(code, format!("{label}: {remark}"));
    }
}
