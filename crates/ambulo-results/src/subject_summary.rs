//! How markers became a body in motion: `subject` of `summary.json` (docs/OUTPUTS.md).

use ambulo::analysis::{BodyInMotion, Event, EventAgreement, event_agreement};
use ambulo::ground::plates::{ContactQuality, PlateContact};
use ambulo::kinematics::calibration::SegmentScale;
use ambulo::kinematics::marker_fit::MarkerFit;
use ambulo::model::Side;
use ambulo::motion::PlateRecording;
use serde::{Deserialize, Serialize};
use std::fmt;

/// How markers became a body in motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SubjectSummary {
    /// How the laboratory's axes and unit were turned into the world's, in one line.
    pub axes: String,
    /// How far the body turns on its way [deg]; `null` where it walks straight or not at all.
    pub turn_deg: Option<f64>,
    /// The sets of markers whose names were found; none with an OpenSim model.
    pub marker_sets: Vec<String>,
    /// How well the body follows the markers.
    pub markers: MarkersSummary,
    /// Sizes of the built-in body's segments.
    pub segments: Vec<SegmentSummary>,
    /// Whose foot loaded which plate, and when.
    pub plates: Vec<PlateContactSummary>,
    /// Where the plates lie.
    pub plate_corners_m: Vec<PlateCornersSummary>,
    /// Times during which every foot on the ground stood on a plate that saw all of it [s], the longest first: only there do totals
    /// and the forces at the pelvis mean anything.
    pub instrumented_windows_s: Vec<[f64; 2]>,
    /// How well foot strikes and toe-offs of several sources agree.
    pub events: Vec<EventAgreementSummary>,
    /// What the built-in body assumes of this person, in sentences.
    pub assumptions: Vec<String>,
}

/// How well a body follows markers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MarkersSummary {
    /// Mean over the frames of the root mean square distance of the markers [mm].
    pub rms_mm: Option<f64>,
    /// Frames in which the iteration did not come to rest.
    pub frames_not_converged: usize,
    /// Each marker.
    pub errors: Vec<MarkerErrorSummary>,
}

/// How far one marker stayed from its place on the body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MarkerErrorSummary {
    /// Name of the marker.
    pub name: String,
    /// Root mean square [mm]; `null` if it was never used.
    pub rms_mm: Option<f64>,
    /// Largest [mm].
    pub max_mm: Option<f64>,
    /// Frames in which it was seen.
    pub frames_seen: usize,
    /// Frames in which it was seen and not believed.
    pub frames_refused: usize,
}

/// A time during which a force plate was loaded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlateContactSummary {
    /// Name of the plate.
    pub plate: String,
    /// The foot on it; `null` where it is not known.
    pub side: Option<Side>,
    /// First loaded instant [s].
    pub start_s: f64,
    /// Last loaded instant [s].
    pub end_s: f64,
    /// Largest vertical force [N].
    pub peak_n: f64,
    /// How much of the foot's load the plate measured.
    pub quality: ContactQuality,
    /// Why it is not clean; empty if it is.
    pub reason: String,
}

/// Where a force plate lies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlateCornersSummary {
    /// Name of the plate.
    pub plate: String,
    /// Its corners in turn, in world axes [m].
    pub corners_m: [[f64; 3]; 4],
}

/// How well two sources of foot strikes and toe-offs agree.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EventAgreementSummary {
    /// The events that are compared.
    pub found: EventOrigin,
    /// The events that they are compared with.
    pub reference: EventOrigin,
    /// Strikes, then offs.
    pub kinds: Vec<EventAgreement>,
}

/// Where events come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum EventOrigin {
    /// Forces of plates.
    Plates,
    /// Motion of the feet.
    Motion,
    /// A list in the recording's file.
    File,
}

impl EventOrigin {
    /// The name in files.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            EventOrigin::Plates => "plates",
            EventOrigin::Motion => "motion",
            EventOrigin::File => "file",
        }
    }
}

/// The size of a segment of the built-in body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SegmentSummary {
    /// Name of the body.
    pub body: String,
    /// Length over the table's for the stature.
    pub factor: f64,
    /// Whether markers say so, or the table.
    pub measured: bool,
}

impl SubjectSummary {
    /// Of a body that was fitted to the markers of a laboratory; `listed` are the events that the file lists.
    #[must_use]
    pub fn of_markers(body: &BodyInMotion, listed: &[Event], measured: &[Event]) -> SubjectSummary {
        let report = body.subject.calibration.as_ref();
        let segments = report.map_or(&[][..], |report| &report.segments);
        SubjectSummary {
            turn_deg: body.laboratory.turn_deg,
            marker_sets: body.subject.sets.clone(),
            segments: segments.iter().map(SegmentSummary::new).collect(),
            plates: plate_contacts(body),
            plate_corners_m: body.plates.iter().map(PlateCornersSummary::new).collect(),
            instrumented_windows_s: body.on_plates.windows.clone(),
            events: agreements(body, listed, measured),
            assumptions: report.map(|r| r.assumptions.clone()).unwrap_or_default(),
            ..SubjectSummary::of_skeleton(&body.laboratory.statement, &body.fit)
        }
    }

    /// Of a body that was fitted to a skeleton.
    #[must_use]
    pub fn of_skeleton(axes: &str, fit: &MarkerFit) -> SubjectSummary {
        SubjectSummary {
            axes: axes.to_owned(),
            turn_deg: None,
            marker_sets: Vec::new(),
            markers: MarkersSummary::new(fit),
            segments: Vec::new(),
            plates: Vec::new(),
            plate_corners_m: Vec::new(),
            instrumented_windows_s: Vec::new(),
            events: Vec::new(),
            assumptions: Vec::new(),
        }
    }
}

fn plate_contacts(body: &BodyInMotion) -> Vec<PlateContactSummary> {
    let summary = |contact: &PlateContact| PlateContactSummary {
        plate: body.plates[contact.plate].name.clone(),
        side: contact.side,
        start_s: contact.start_s,
        end_s: contact.end_s,
        peak_n: contact.peak_n,
        quality: contact.quality,
        reason: contact.reason.clone(),
    };
    body.on_plates.contacts.iter().map(summary).collect()
}

/// Motion and file against plates; the file against the motion where there are no plates.
fn agreements(body: &BodyInMotion, listed: &[Event], measured: &[Event]) -> Vec<EventAgreementSummary> {
    let sources =
        [(EventOrigin::Plates, measured), (EventOrigin::Motion, &body.feet.events[..]), (EventOrigin::File, listed)];
    let filled: Vec<_> = sources.into_iter().filter(|(_, events)| !events.is_empty()).collect();
    let Some((&(reference, events), others)) = filled.split_first() else { return Vec::new() };
    let agreement = |&(found, with): &(EventOrigin, &[Event])| EventAgreementSummary {
        found,
        reference,
        kinds: event_agreement(events, with).to_vec(),
    };
    others.iter().map(agreement).collect()
}

impl PlateCornersSummary {
    fn new(plate: &PlateRecording) -> PlateCornersSummary {
        PlateCornersSummary { plate: plate.name.clone(), corners_m: plate.corners.map(Into::into) }
    }
}

impl SegmentSummary {
    fn new(scale: &SegmentScale) -> SegmentSummary {
        SegmentSummary { body: scale.body.clone(), factor: scale.factor, measured: scale.is_measured }
    }
}

impl MarkersSummary {
    fn new(fit: &MarkerFit) -> MarkersSummary {
        let millimetres = |m: f64| m.is_finite().then_some(1e3 * m);
        let seen: Vec<f64> = fit.rms_m.iter().copied().filter(|rms| rms.is_finite()).collect();
        let errors = fit.errors.iter().map(|error| MarkerErrorSummary {
            name: error.name.clone(),
            rms_mm: millimetres(error.rms_m),
            max_mm: millimetres(error.max_m),
            frames_seen: error.seen,
            frames_refused: error.down_weighted,
        });
        MarkersSummary {
            rms_mm: millimetres(seen.iter().sum::<f64>() / seen.len() as f64),
            frames_not_converged: fit.converged.iter().filter(|converged| !**converged).count(),
            errors: errors.collect(),
        }
    }
}

impl fmt::Display for EventOrigin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}
