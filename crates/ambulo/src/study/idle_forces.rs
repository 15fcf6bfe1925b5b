//! Measured forces that do not belong to the motion: loads under no foot, and plates that measure no load although a
//! foot stands on them.
//!
//! They come from another trial or from other plates, or the plates were switched off. The ground forces are then
//! predicted from the motion where none are left, but nothing is called feasible on them.
//! Pinned by: tests/quality.rs, ambulo-cli/tests/plates.rs

use super::force_table::TableForces;
use super::source::{MarkerSource, PlateAssignment, PlateUse};
use crate::analysis::BodyInMotion;
use crate::findings::{Code, Findings, and_more_times};
use crate::ground::CENTER_OF_PRESSURE_LOAD_N;
use crate::ground::plates::{ContactQuality, SilentStance};
use crate::motion::ForceRecording;

/// Largest share of the loaded time with loads under no foot in a motion that is judged.
const MOST_UNASSIGNED: f64 = 0.5;

/// Measured forces that cannot belong to this person and motion.
#[derive(Debug, Clone, Default)]
pub(super) struct IdleForces {
    /// Loaded times without a foot [s].
    unassigned: Vec<[f64; 2]>,
    /// Share of the loaded time with these loads.
    unassigned_share: f64,
    /// Plates or tables without a load although feet are on them.
    silent: Vec<String>,
    /// Share of the stances on plates without a load.
    silent_share: f64,
    /// Whether the forces were in body weights: they do not weigh the person.
    pub(super) is_relative: bool,
}

impl IdleForces {
    pub(super) fn of_table(found: &TableForces) -> IdleForces {
        let unassigned_s: f64 = found.unassigned.iter().map(|[from, to]| to - from).sum();
        let is_silent = found.unassigned.is_empty() && !found.forces.iter().any(is_loaded);
        IdleForces {
            unassigned: found.unassigned.clone(),
            unassigned_share: share(unassigned_s, found.loaded_s),
            silent_share: if is_silent { 1.0 } else { 0.0 },
            is_relative: found.is_relative,
            silent: if is_silent { vec!["the force table".to_owned()] } else { Vec::new() },
        }
    }

    /// Idle forces of the plates of a file, without plates that the user switched off.
    pub(super) fn of_plates(body: &BodyInMotion, markers: &MarkerSource) -> IdleForces {
        let contacts = &body.on_plates.contacts;
        let unassigned: Vec<[f64; 2]> = contacts
            .iter()
            .filter(|contact| contact.quality == ContactQuality::Unassigned)
            .map(|contact| [contact.start_s, contact.end_s])
            .collect();
        let loaded_s: f64 = contacts.iter().map(|contact| contact.end_s - contact.start_s).sum();
        let unassigned_s: f64 = unassigned.iter().map(|[from, to]| to - from).sum();
        let silent = silent_stances(body, markers);
        IdleForces {
            unassigned,
            unassigned_share: share(unassigned_s, loaded_s),
            silent_share: share(silent.len() as f64, (silent.len() + contacts.len()) as f64),
            is_relative: false,
            silent,
        }
    }

    /// The share of the loaded time in which loads lie under no foot, with the first of these times; `None` if there is
    /// none.
    pub(super) fn unassigned(&self) -> Option<(f64, [f64; 2])> {
        Some((self.unassigned_share, *self.unassigned.first()?))
    }

    /// The share of the stances on plates that show no load, with the first of them; `None` if there is none.
    pub(super) fn silent(&self) -> Option<(f64, &str)> {
        Some((self.silent_share, self.silent.first()?))
    }

    /// Why the measured forces do not support a verdict; `None` if they do.
    pub(super) fn undecided(&self) -> Option<String> {
        if let Some((share, [from, to])) = self.unassigned().filter(|(share, _)| *share > MOST_UNASSIGNED) {
            return Some(format!(
                "{:.0} % of the measured load lies under no foot (first from {from:.3} to {to:.3} s): forces and \
                 motion may not belong together",
                100.0 * share
            ));
        }
        let (_, first) = self.silent().filter(|(share, _)| *share >= 1.0)?;
        Some(format!("no force was measured where a foot stood ({first}); the forces are predicted from the motion"))
    }

    pub(super) fn report(&self, findings: &mut Findings) {
        if let Some(first) = self.silent.first() {
            let message = format!(
                "no load was measured on {first}{}, although the foot stood on the ground. hint: check that the force \
                 plates were switched on and that the forces are those of this trial",
                and_more_times(self.silent.len())
            );
            findings.report(Code::PlatesSilent, message);
        }
    }
}

/// Whether a force is ever large enough for a centre of pressure.
pub(super) fn is_loaded(force: &ForceRecording) -> bool {
    force.force.iter().any(|force| force.norm() > CENTER_OF_PRESSURE_LOAD_N)
}

/// The places of stances on plates without a load; plates that the user switched off are left out.
fn silent_stances(body: &BodyInMotion, markers: &MarkerSource) -> Vec<String> {
    let is_off = |plate: usize| {
        let is_it = |known: &&PlateAssignment| markers.plate_at(known.plate) == Some(plate);
        markers.plates.iter().filter(is_it).any(|known| known.used == PlateUse::Off)
    };
    let place = |SilentStance { plate, side, span: [from, to] }: &SilentStance| {
        format!("{} under the {side} foot, {from:.3}-{to:.3} s", body.plates[*plate].name)
    };
    body.on_plates.silent.iter().filter(|stance| !is_off(stance.plate)).map(place).collect()
}

fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}
