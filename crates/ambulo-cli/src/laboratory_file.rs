//! What a laboratory's file holds: markers, plates, events, and what it states of the person.

use crate::files;
use ambulo::analysis::LaboratoryRecording;
use ambulo::findings::Findings;
use ambulo::motion::force_plate::{PlateSettings, plates_from_c3d};
use ambulo::motion::{Event, SubjectParameters, events_from_c3d, markers_from_c3d, markers_from_trc, subject_from_c3d};
use ambulo_formats::c3d::C3d;
use ambulo_formats::trc::Trc;
use anyhow::{Context, Result, bail};
use std::path::Path;

/// One file of markers, in the laboratory's axes.
pub(crate) struct LaboratoryFile {
    /// Markers and force plates; a TRC has none of these.
    pub(crate) recording: LaboratoryRecording,
    /// Foot strikes and toe-offs that it lists.
    pub(crate) events: Vec<Event>,
    /// What it states of the person.
    pub(crate) subject: SubjectParameters,
}

/// Reads a `.c3d` or a `.trc`.
pub(crate) fn read(path: &Path, findings: &mut Findings) -> Result<LaboratoryFile> {
    let bytes = files::read(path)?;
    let shown = path.display().to_string();
    let read = match files::ending(path).as_str() {
        "c3d" => from_c3d(&bytes, &shown, findings),
        "trc" => from_trc(&bytes, &shown, findings),
        _ => bail!("{shown}: expected markers, a .c3d or a .trc"),
    };
    let mut file = read.with_context(|| shown.clone())?;
    file.recording.markers.name = shown;
    Ok(file)
}

/// From the bytes of a C3D; `shown` is its name in findings.
pub(crate) fn from_c3d(bytes: &[u8], shown: &str, findings: &mut Findings) -> Result<LaboratoryFile> {
    let (c3d, remarks) = C3d::read(bytes)?;
    files::note_remarks(shown, &remarks, findings);
    if c3d.frames() == 0 {
        let odd = remarks.last().map_or_else(String::new, |remark| format!(" ({remark})"));
        bail!("the file holds no frames{odd}; expected a recorded trial. hint: export it again");
    }
    Ok(LaboratoryFile {
        recording: recording_of_c3d(&c3d, findings)?,
        events: events_from_c3d(&c3d, findings),
        subject: subject_from_c3d(&c3d),
    })
}

/// Markers and plates of a C3D.
pub(crate) fn recording_of_c3d(c3d: &C3d, findings: &mut Findings) -> Result<LaboratoryRecording> {
    Ok(LaboratoryRecording {
        markers: markers_from_c3d(c3d, findings)?,
        plates: plates_from_c3d(c3d, PlateSettings::default(), findings)?,
        unit: c3d.point_unit.clone(),
    })
}

/// From the bytes of a TRC; `shown` is its name in findings.
pub(crate) fn from_trc(bytes: &[u8], shown: &str, findings: &mut Findings) -> Result<LaboratoryFile> {
    let (trc, remarks) = Trc::read(bytes)?;
    files::note_remarks(shown, &remarks, findings);
    Ok(LaboratoryFile {
        recording: LaboratoryRecording {
            markers: markers_from_trc(&trc, findings)?,
            plates: Vec::new(),
            unit: trc.unit.symbol().to_owned(),
        },
        events: Vec::new(),
        subject: SubjectParameters::default(),
    })
}
