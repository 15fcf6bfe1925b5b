//! Measured forces that do not belong to the motion: loads under no foot, and plates that measure no load although a
//! foot stands on them.
//!
//! They come from another trial or from other plates, or the plates were switched off. The ground forces are then
//! predicted from the motion where none are left, but nothing is called feasible on them.
//!
//! A leg without any measured load may be the plan of a laboratory with one plate. It is a fault if the foot stood on a
//! plate ([`IdleForces::lost`]): its load should have been measured.
//! Pinned by: tests/quality.rs, ambulo-cli/tests/plates.rs

use super::force_table::{TableForces, is_loaded};
use super::source::{MarkerSource, PlateAssignment, PlateUse};
use crate::analysis::BodyInMotion;
use crate::findings::{Code, Findings, and_more_times};
use crate::ground::plates::{ContactQuality, SilentStance};
use crate::model::{BySide, Side};

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
    /// For each foot, why a load that should have been measured is not there; `None` if there is no such load.
    lost: BySide<Option<String>>,
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
            lost: BySide::from_fn(|_| found.idle.first().map(|load| format!("the load `{load}` of the table is zero"))),
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
            lost: BySide::from_fn(|side| lost_on_plates(body, markers, side)),
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

    /// Why a load of a foot that should have been measured is not there; `None` if there is no such load.
    pub(super) fn lost(&self, side: Side) -> Option<&str> {
        self.lost[side].as_deref()
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

/// The places of stances on plates without a load; plates that the user switched off are left out.
fn silent_stances(body: &BodyInMotion, markers: &MarkerSource) -> Vec<String> {
    let silent = body.on_plates.silent.iter().filter(|stance| !is_off(markers, stance.plate));
    silent.map(|stance| place(body, stance)).collect()
}

fn is_off(markers: &MarkerSource, plate: usize) -> bool {
    let is_it = |known: &&PlateAssignment| markers.plate_at(known.plate) == Some(plate);
    markers.plates.iter().filter(is_it).any(|known| known.used == PlateUse::Off)
}

fn place(body: &BodyInMotion, SilentStance { plate, side, span: [from, to] }: &SilentStance) -> String {
    format!("{} under the {side} foot, {from:.3}-{to:.3} s", body.plates[*plate].name)
}

/// Why a load of a foot is not there although a plate was under it, or may have been. Loads that belong to no foot
/// alone have warnings of their own.
fn lost_on_plates(body: &BodyInMotion, markers: &MarkerSource, side: Side) -> Option<String> {
    let silent = || {
        let stance = body.on_plates.silent.iter().find(|stance| stance.side == side)?;
        let state = if is_off(markers, stance.plate) { "was left out" } else { "shows no load" };
        Some(format!("{} {state}", place(body, stance)))
    };
    let unread = || {
        let is_lacking = markers.trial.stated_plates > markers.trial.recording.plates.len();
        is_lacking.then(|| "a force plate of the file could not be read".to_owned())
    };
    silent().or_else(unread)
}

fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}
