//! Assigns force plates to feet, and determines whether a plate measured all of a foot's load.
//!
//! A **contact** is a time during which a plate carries more than 20 N. It belongs to the foot whose line from heel to
//! toe is nearest to the centre of pressure, averaged over the load, within 0.2 m (the limit in the documentation of
//! Visual3D). Height counts: a foot on another step of stairs is not on the plate. The contact is
//! - of **two feet** if the other foot was on the same plate as well,
//! - **partial** if the foot was on the floor clearly before or after the force, or over the edge of the plate,
//! - **shared** if it is partial alone and complete together with another plate under the same foot,
//! - **clean** otherwise.
//!
//! Before, plates are read as their feet show them ([`plates_under_feet`]).
//!
//! The **instrumented windows** are the times during which every foot on the ground is on a plate.
//! Pinned by: tests/feet_on_plates.rs, tests/laboratory_files.rs

mod by_foot;
mod contact;
mod corners;
mod cross_talk;
mod events;
mod feet;
mod windows;

pub(crate) use feet::FeetInMotion;

use super::foot_motion::FootMotion;
use super::phases::Contact;
use crate::findings::{Code, Findings, word};
use crate::model::{BodyId, BySide, Side};
use crate::motion::{ForceRecording, Landmarks, MarkerRecording, PlateRecording};
use crate::spatial::Vec3;

/// Contacts whose peak is below this share of the largest peak of all plates are vibration.
pub(super) const VIBRATION: f64 = 0.05;
/// Largest distance of a foot from its centre of pressure [m].
pub(super) const FARTHEST_M: f64 = 0.2;

/// How much of a foot's load a plate measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum ContactQuality {
    /// All of it, and nothing else.
    Clean,
    /// Part of it; another plate measured the rest.
    Shared,
    /// Part of it: the rest was earlier, later or off the plate.
    Partial,
    /// The load of both feet.
    #[serde(rename = "two feet")]
    TwoFeet,
    /// The load of an unknown foot.
    Unassigned,
}

impl ContactQuality {
    /// The name in tables.
    #[must_use]
    pub fn word(self) -> &'static str {
        word(&self)
    }
}

/// A time during which a plate was loaded.
#[derive(Debug, Clone, PartialEq)]
pub struct PlateContact {
    /// Index of the plate.
    pub plate: usize,
    /// The foot; `None` if unknown.
    pub side: Option<Side>,
    /// First loaded instant [s].
    pub start_s: f64,
    /// Last loaded instant [s].
    pub end_s: f64,
    /// Largest vertical force [N].
    pub peak_n: f64,
    /// Mean distance of the centre of pressure from the line from heel to toe [m]; not a number without visible
    /// markers.
    pub distance_m: f64,
    /// How much of the foot's load the plate measured.
    pub quality: ContactQuality,
    /// Why it is not clean; empty if it is.
    pub reason: String,
}

/// All contacts of a trial with the force plates.
#[derive(Debug, Clone, PartialEq)]
pub struct FeetOnPlates {
    /// Contacts, by plate and time.
    pub contacts: Vec<PlateContact>,
    /// Instrumented windows: times when the whole load of both feet was measured [s], the longest first.
    pub windows: Vec<[f64; 2]>,
    /// Stances on plates that show no load during them.
    pub(crate) silent: Vec<SilentStance>,
}

/// A foot that stands on a plate without a load: the plate was off, or its signal is of another trial.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SilentStance {
    /// Index of the plate.
    pub plate: usize,
    /// The foot.
    pub side: Side,
    /// Foot strike and foot off by the motion [s].
    pub span: [f64; 2],
}

/// Corrects plates by the feet on them: puts the corners into the order with which the loads are under the feet, and
/// removes cross-talk between plates.
#[must_use]
pub fn plates_under_feet(
    markers: &MarkerRecording,
    plates: Vec<PlateRecording>,
    motion: &FootMotion,
    findings: &mut Findings,
) -> Vec<PlateRecording> {
    let feet = FeetInMotion { markers, landmarks: Landmarks::find(markers), motion };
    plates_under_moving_feet(&feet, plates, findings)
}

/// [`plates_under_feet`] with known landmarks.
#[must_use]
pub(crate) fn plates_under_moving_feet(
    feet: &FeetInMotion<'_>,
    plates: Vec<PlateRecording>,
    findings: &mut Findings,
) -> Vec<PlateRecording> {
    cross_talk::removed(feet, corners::in_order(feet, plates, findings), findings)
}

/// Assigns each contact to a foot. Markers and plates are in the world's axes. `assigned` has the plates (by index) of
/// which the user stated the foot.
#[must_use]
pub fn feet_on_plates(
    markers: &MarkerRecording,
    plates: &[PlateRecording],
    motion: &FootMotion,
    assigned: &[(usize, Side)],
    findings: &mut Findings,
) -> FeetOnPlates {
    let feet = FeetInMotion { markers, landmarks: Landmarks::find(markers), motion };
    feet_in_motion_on_plates(&feet, plates, assigned, findings)
}

/// [`feet_on_plates`] with known landmarks.
#[must_use]
pub(crate) fn feet_in_motion_on_plates(
    feet: &FeetInMotion<'_>,
    plates: &[PlateRecording],
    assigned: &[(usize, Side)],
    findings: &mut Findings,
) -> FeetOnPlates {
    let highest = plates.iter().map(PlateRecording::peak_n).fold(0.0, f64::max);
    let mut found: Vec<PlateContact> = Vec::new();
    for (i, plate) in plates.iter().enumerate() {
        let assigned = assigned.iter().find(|(index, _)| *index == i).map(|(_, side)| *side);
        let spans =
            contact::loaded_spans(plate).into_iter().filter(|s| contact::peak(plate, *s) >= VIBRATION * highest);
        found.extend(spans.map(|span| contact::classified(feet, i, plate, span, assigned)));
    }
    for i in 0..found.len() {
        found[i] = contact::with_other_plates(feet, &found, i);
    }
    let windows = windows::windows(feet, &found);
    report(plates, &found, findings);
    if windows.is_empty() && !found.is_empty() {
        findings.report(
            Code::PlatesNoWindow,
            "there is no time at which the whole load of both feet was measured: the \
            total force and the residual force at the pelvis cannot be checked",
        );
    }
    let silent = (0..plates.len()).flat_map(|index| silent_stances(feet, index, &plates[index], &found)).collect();
    FeetOnPlates { contacts: found, windows, silent }
}

/// Stances on a plate during which it shows no load.
///
/// The centre of pressure begins under the heel and ends under the toes. A whole stance with one of them on the plate
/// loads it at some time; of one that the recording cuts, both must be on it.
fn silent_stances(
    feet: &FeetInMotion<'_>,
    plate: usize,
    recording: &PlateRecording,
    found: &[PlateContact],
) -> Vec<SilentStance> {
    let is_loaded = |[from, to]: [f64; 2]| {
        found.iter().any(|contact| contact.plate == plate && contact.start_s < to && contact.end_s > from)
    };
    let of_side = |side: Side| {
        let stands = |contact: &Contact, [from, to]: [f64; 2]| {
            let fewest = if contact.strike_s.is_some() && contact.off_s.is_some() { 1 } else { 2 };
            let at = |share: f64| feet.ends_inside(side, recording, from + share * (to - from));
            [0.3, 0.45, 0.6].into_iter().all(|share| at(share) >= fewest)
        };
        let stances = feet.motion.contacts_of(side).iter().zip(feet.stances(side));
        let silent = stances.filter(|(contact, span)| !is_loaded(*span) && stands(contact, *span));
        silent.map(|(_, span)| SilentStance { plate, side, span }).collect::<Vec<_>>()
    };
    Side::BOTH.into_iter().flat_map(of_side).collect()
}

fn report(plates: &[PlateRecording], found: &[PlateContact], findings: &mut Findings) {
    for contact in found {
        let name = &plates[contact.plate].name;
        let times = format!("{:.3}-{:.3} s", contact.start_s, contact.end_s);
        let reason = &contact.reason;
        match (contact.quality, contact.side) {
            (ContactQuality::Partial, Some(side)) => findings.report(
                Code::PlatesPartial,
                format!("{name}, {times}: not all of the {side} foot's load was measured: {reason}"),
            ),
            (ContactQuality::TwoFeet, _) => findings.report(
                Code::PlatesTwoFeet,
                format!(
                    "{name}, {times}: two feet were on one plate: {reason}; this load was assigned to neither foot"
                ),
            ),
            (ContactQuality::Unassigned, _) => findings.report(
                Code::PlatesUnassigned,
                format!("{name}, {times}: its load was not assigned to a foot: {reason}"),
            ),
            (ContactQuality::Shared, Some(side)) => {
                findings
                    .report(Code::PlatesShared, format!("{name}, {times}, {side}: {reason}; both forces were added"));
            }
            _ => {}
        }
    }
}

impl FeetOnPlates {
    /// Loads on the feet, one recording per plate and foot, for [`super::measured`], which adds those on one body.
    /// `feet` are the bodies that the ground acts on ([`Anatomy::feet`](crate::model::Anatomy::feet)). Loads of two
    /// feet and of an unknown foot are left out.
    #[must_use]
    pub fn recordings(&self, plates: &[PlateRecording], feet: BySide<BodyId>) -> Vec<ForceRecording> {
        let mut out = Vec::new();
        for (i, plate) in plates.iter().enumerate() {
            let on_plate: Vec<&PlateContact> = self.contacts.iter().filter(|c| c.plate == i).collect();
            for (side, &body) in feet.iter() {
                let is_own = |c: &&PlateContact| c.side == Some(side) && c.quality != ContactQuality::TwoFeet;
                if on_plate.iter().any(is_own) {
                    let own = |t: f64| nearest(&on_plate, t).is_some_and(|c| is_own(&c));
                    out.push(recording(plate, side, body, own));
                }
            }
        }
        out
    }
}

/// The contact nearest to a time: the signal between two contacts belongs to the nearer one. `contacts` are in order
/// of time.
fn nearest<'a>(contacts: &[&'a PlateContact], t: f64) -> Option<&'a PlateContact> {
    let next = contacts.partition_point(|c| c.end_s < t);
    let apart = |c: &PlateContact| (c.start_s - t).max(t - c.end_s).max(0.0);
    let around = [next.checked_sub(1), Some(next)].into_iter().flatten().filter_map(|i| contacts.get(i).copied());
    around.min_by(|a, b| apart(a).total_cmp(&apart(b)))
}

fn recording(plate: &PlateRecording, side: Side, body: BodyId, own: impl Fn(f64) -> bool) -> ForceRecording {
    let masked = |value: &dyn Fn(usize) -> Vec3| -> Vec<Vec3> {
        let at = |i: usize| if own(plate.times[i]) { value(i) } else { Vec3::zeros() };
        (0..plate.times.len()).map(at).collect()
    };
    ForceRecording {
        name: format!("{}, {side}", plate.name),
        body,
        force_frame: None,
        point_frame: None,
        times: plate.times.clone(),
        force: masked(&|i| plate.force[i]),
        point: vec![plate.center(); plate.times.len()],
        moment: masked(&|i| plate.moment_about_center(i)),
    }
}
