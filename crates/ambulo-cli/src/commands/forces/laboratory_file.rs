//! What a laboratory's file holds: markers, plates, events, and what it states of the person.

use super::Reading;
use crate::files;
use ambulo::analysis::LaboratoryRecording;
use ambulo::motion::force_plate::{PlateSettings, plates_from_c3d};
use ambulo::motion::{Event, SubjectParameters, events_from_c3d, markers_from_c3d, markers_from_trc, subject_from_c3d};
use ambulo_formats::c3d::C3d;
use ambulo_formats::trc::Trc;
use anyhow::{Context, Result, bail};
use std::path::Path;

/// One file of markers, in the laboratory's axes.
pub(super) struct LaboratoryFile {
    /// Markers and force plates; a TRC has none of these.
    pub(super) recording: LaboratoryRecording,
    /// Foot strikes and toe-offs that it lists.
    pub(super) events: Vec<Event>,
    /// What it states of the person.
    pub(super) subject: SubjectParameters,
}

/// Reads a `.c3d` or a `.trc`.
pub(super) fn read(path: &Path, reading: &mut Reading) -> Result<LaboratoryFile> {
    let bytes = files::read(path)?;
    reading.read.push(path.to_owned());
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let shown = path.display().to_string();
    let read = match ending.as_str() {
        "c3d" => from_c3d(&bytes, &shown, reading),
        "trc" => from_trc(&bytes, &shown, reading),
        _ => bail!("{shown}: expected markers, a .c3d or a .trc"),
    };
    let mut file = read.with_context(|| shown.clone())?;
    file.recording.markers.name = shown;
    Ok(file)
}

fn from_c3d(bytes: &[u8], shown: &str, reading: &mut Reading) -> Result<LaboratoryFile> {
    let (c3d, remarks) = C3d::read(bytes)?;
    let findings = &mut reading.findings;
    files::note_remarks(shown, &remarks, findings);
    if c3d.frames() == 0 {
        let odd = remarks.last().map_or_else(String::new, |remark| format!(" ({remark})"));
        bail!("the file holds no frames{odd}; expected a recorded trial. hint: export it again");
    }
    Ok(LaboratoryFile {
        recording: LaboratoryRecording {
            markers: markers_from_c3d(&c3d, findings)?,
            plates: plates_from_c3d(&c3d, PlateSettings::default(), findings)?,
            unit: c3d.point_unit.clone(),
        },
        events: events_from_c3d(&c3d, findings),
        subject: subject_from_c3d(&c3d),
    })
}

fn from_trc(bytes: &[u8], shown: &str, reading: &mut Reading) -> Result<LaboratoryFile> {
    let (trc, remarks) = Trc::read(bytes)?;
    files::note_remarks(shown, &remarks, &mut reading.findings);
    Ok(LaboratoryFile {
        recording: LaboratoryRecording {
            markers: markers_from_trc(&trc, &mut reading.findings)?,
            plates: Vec::new(),
            unit: trc.unit.symbol().to_owned(),
        },
        events: Vec::new(),
        subject: SubjectParameters::default(),
    })
}
