//! Which markers of a motion the body follows: those that its calibration knows, and those that move with a segment.

use super::laboratory_recording::LaboratoryRecording;
use super::subject::{BodySource, Subject};
use crate::findings::{Code, Findings};
use crate::kinematics::calibration::{BodyMeasurements, PersonMeasurements};
use crate::kinematics::marker_fit::MarkerFit;
use crate::model::anthropometry::SegmentTable;
use crate::model::marker_set::{MarkerSet, NamedMarker, RecognisedMarkers};
use crate::model::{BodyId, Marker, Side};
use crate::motion::{MarkerPath, MarkerRecording};
use crate::numerics::counted;
use crate::technical_markers::{MarkedBody, computed_points, technical_markers};

/// Of the markers of a motion, a body should follow at least this share [1].
pub const LEAST_MARKER_SHARE: f64 = 0.6;
/// A body that follows this share by name, and every thigh and shank, needs no others [1].
const ENOUGH_BY_NAME: f64 = 0.95;
/// Markers that show the pose of a segment without markers of the joint at its end.
const OF_A_POSE: usize = 3;
/// Weight of markers that define a joint.
const AT_JOINT: f64 = 1.0;
/// Most names in a message.
const MOST_NAMES: usize = 12;

/// The markers of a motion, without points that a program computed from others.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MarkerUse {
    /// Names of those that the body follows.
    pub used: Vec<String>,
    /// Names of the others.
    pub unused: Vec<String>,
}

/// The markers that the built-in body follows if it is calibrated from the motion itself: those with known names, and
/// those that move with a segment. `None` for points of video, and for markers that do not suffice for a body.
#[must_use]
pub fn marker_use(recording: &LaboratoryRecording) -> Option<MarkerUse> {
    /// No marker depends on the mass.
    const ANY_MASS_KG: f64 = 70.0;
    let mut unheard = Findings::default();
    let moving = recording.in_world(&mut unheard).1.markers.trimmed_to_visible();
    let named = named(&moving, None)?;
    let measurements = BodyMeasurements::default();
    let person = PersonMeasurements { table: SegmentTable::DeLevaMale, mass: ANY_MASS_KG, height: None, measurements };
    let body = BodySource::BuiltIn { person: &person, set: None };
    let subject = Subject::of_source(&body, &moving, None, &mut unheard).ok()?;
    let subject = subject.with_technical_markers(None, &moving, None, &mut unheard);
    let is_used = |name: &&str| subject.model.markers().iter().any(|marker| marker.name == *name);
    let (used, unused): (Vec<&str>, Vec<&str>) = recorded(&moving, &named).into_iter().partition(is_used);
    let [used, unused] = [used, unused].map(|names| names.into_iter().map(str::to_owned).collect());
    Some(MarkerUse { used, unused })
}

impl Subject {
    /// The body with the markers of the motion that it does not have yet, on the segments with which they move. A given
    /// model keeps its markers. Both recordings are in world axes; `set` is the marker set that the caller names.
    pub(super) fn with_technical_markers(
        self,
        set: Option<&MarkerSet>,
        moving: &MarkerRecording,
        standing: Option<&MarkerRecording>,
        findings: &mut Findings,
    ) -> Subject {
        if self.calibration.is_none() {
            return self;
        }
        let Some(named) = named(moving, set) else { return self };
        let followed = self.known_share(moving, &named);
        if followed.is_some_and(|share| share >= ENOUGH_BY_NAME) {
            return self;
        }
        let is_shown = followed.is_some_and(|share| share >= LEAST_MARKER_SHARE);
        let body = MarkedBody { model: &self.model, weights: &self.weights, is_shown };
        let found = technical_markers(body, moving, standing, &named);
        if found.is_empty() {
            return self;
        }
        let markers = self.model.markers().iter().chain(found.iter().map(|(marker, _)| marker)).cloned();
        let Ok(model) = self.model.with_markers(markers.collect()) else { return self };
        report_found(&self, &found, findings);
        let mut weights = self.weights.clone();
        weights.extend(found.iter().map(|(marker, weight)| (marker.name.clone(), *weight)));
        Subject { model, weights, ..self }
    }

    /// The share of the recorded markers that the body has by their names; `None` if they hardly show a thigh or shank.
    fn known_share(&self, moving: &MarkerRecording, named: &[NamedMarker]) -> Option<f64> {
        let recorded = recorded(moving, named);
        let is_on_body = |name: &&str| self.model.markers().iter().any(|marker| marker.name == *name);
        let followed: Vec<&str> = recorded.iter().copied().filter(is_on_body).collect();
        let is_shown = hardly_shown(self, &followed).next().is_none();
        is_shown.then_some(followed.len() as f64 / recorded.len() as f64)
    }
}

/// Names of the markers that are seen in any frame, without points that a program computed from others.
fn recorded<'m>(moving: &'m MarkerRecording, named: &[NamedMarker]) -> Vec<&'m str> {
    let computed = computed_points(moving, named);
    let is_seen = |path: &&MarkerPath| (0..path.positions.len()).any(|frame| path.is_seen(frame));
    let seen = moving.markers.iter().filter(is_seen).map(|marker| marker.name.as_str());
    seen.filter(|name| !computed.contains(name)).collect()
}

fn report_found(subject: &Subject, found: &[(Marker, f64)], findings: &mut Findings) {
    let bodies = subject.model.bodies();
    let shown = |(marker, _): &(Marker, f64)| {
        let body = marker.body.map_or("ground", |body| &bodies[body.index()].name);
        format!("`{}` on `{body}`", marker.name)
    };
    let were = if found.len() == 1 { "was" } else { "were" };
    let markers = counted(found.len(), "marker");
    let listed = listed(found.iter().map(shown));
    let message = format!("{markers} {were} given to the segments by how they move: {listed}");
    findings.report(Code::MarkersByMotion, message);
}

/// The markers whose names are known; `None` for points of video, which are joint centres and have their segments.
fn named(moving: &MarkerRecording, set: Option<&MarkerSet>) -> Option<Vec<NamedMarker>> {
    let names = moving.markers.iter().map(|marker| marker.name.as_str());
    match RecognisedMarkers::with(set, names) {
        Ok(known) if known.has_hips_only() => None,
        known => Some(known.map(|known| known.markers).unwrap_or_default()),
    }
}

/// Reports a motion of which the body follows few markers, and thighs and shanks that few markers show. Returns the
/// number of markers that are seen in any frame, without points that a program computed from others.
pub(super) fn report_use(
    subject: &Subject,
    fit: &MarkerFit,
    (moving, set): (&MarkerRecording, Option<&MarkerSet>),
    findings: &mut Findings,
) -> usize {
    let Some(named) = named(moving, set) else { return moving.markers.len() };
    let recorded = recorded(moving, &named);
    let followed: Vec<&str> =
        fit.errors.iter().filter(|error| error.rms_m.is_finite()).map(|error| error.name.as_str()).collect();
    if (followed.len() as f64) < LEAST_MARKER_SHARE * recorded.len() as f64 {
        let unused = recorded.iter().filter(|name| !followed.contains(name)).map(|name| format!("`{name}`"));
        let message = format!(
            "the body follows {} of the {} markers of `{}`; not used: {}",
            followed.len(),
            recorded.len(),
            moving.name,
            listed(unused)
        );
        findings.report(Code::MarkersUnused, message);
    }
    let shown: Vec<String> = hardly_shown(subject, &followed).collect();
    if !shown.is_empty() {
        let message = format!(
            "the motion hardly shows {}; the pose of such a segment rests on its neighbours. Expected are a marker of \
             the knee on a thigh and of the ankle on a shank, or three others that are in the standing trial too",
            shown.join(", ")
        );
        findings.report(Code::MarkersSegmentHardlyShown, message);
    }
    recorded.len()
}

/// The thighs and shanks that the markers hardly show, with the number of their markers.
fn hardly_shown(subject: &Subject, followed: &[&str]) -> impl Iterator<Item = String> {
    let legs = subject.model.anatomy().legs();
    let segments = Side::BOTH.into_iter().filter_map(|side| Some((side, legs[side].as_ref()?)));
    let segments = segments.flat_map(|(side, leg)| [(side, "thigh", leg.thigh), (side, "shank", leg.shank)]);
    segments.filter_map(|(side, name, body)| {
        let own: Vec<&Marker> = markers_of(subject, body).filter(|m| followed.contains(&m.name.as_str())).collect();
        let weight = |marker: &Marker| subject.weights.get(&marker.name).copied().unwrap_or(AT_JOINT);
        let is_enough = own.len() >= OF_A_POSE || own.iter().any(|marker| weight(marker) >= AT_JOINT);
        (!is_enough).then(|| format!("the {side} {name} ({})", counted(own.len(), "marker")))
    })
}

fn markers_of(subject: &Subject, body: BodyId) -> impl Iterator<Item = &Marker> {
    subject.model.markers().iter().filter(move |marker| marker.body == Some(body))
}

fn listed(names: impl Iterator<Item = String>) -> String {
    let mut names: Vec<String> = names.collect();
    let more = names.len().saturating_sub(MOST_NAMES);
    names.truncate(MOST_NAMES);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("{}{more}", names.join(", "))
}
