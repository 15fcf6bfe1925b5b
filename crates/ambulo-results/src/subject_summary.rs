//! `subject` of `summary.json`: marker fit, segments, plates and events (docs/OUTPUTS.md).

use ambulo::analysis::{BodyInMotion, Event, EventAgreement, event_agreement};
use ambulo::findings::word;
use ambulo::functional::CrossTalk;
use ambulo::ground::plates::{ContactQuality, PlateContact};
use ambulo::kinematics::calibration::{HipCentres, SegmentScale};
use ambulo::kinematics::marker_fit::MarkerFit;
use ambulo::model::{Region, Side};
use ambulo::motion::PlateRecording;
use ambulo::spatial::Vec3;
use ambulo::study::{RegionFit, TrackedMarkers};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;

/// The subject: marker fit, segments, plates and events.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SubjectSummary {
    /// Conversion of the axes and unit of the laboratory to those of the world, in one line.
    pub axes: String,
    /// Turn of the walking direction [deg]; `null` if the subject walks straight or not at all.
    pub turn_deg: Option<f64>,
    /// The detected marker sets; empty with an OpenSim model.
    pub marker_sets: Vec<String>,
    /// Quality of the marker fit.
    pub markers: MarkersSummary,
    /// Hip centres of the built-in body; left out if it was not calibrated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hips: Option<HipsSummary>,
    /// Cross-talk of the knees of the built-in body; left out for knees that do not show it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub knees: Vec<KneeSummary>,
    /// Sizes of the segments of the built-in body.
    pub segments: Vec<SegmentSummary>,
    /// Which foot loaded which plate, and when.
    pub plates: Vec<PlateContactSummary>,
    /// Positions of the plates.
    pub plate_corners_m: Vec<PlateCornersSummary>,
    /// Times in which every loaded foot is wholly on a plate [s], the longest first: only then are total forces
    /// and the forces at the pelvis meaningful.
    pub instrumented_windows_s: Vec<[f64; 2]>,
    /// Agreement of foot strikes and foot offs from several sources.
    pub events: Vec<EventAgreementSummary>,
    /// What contradicts the labels of the markers or the standing trial, in sentences; left out if nothing does.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub contradictions: Vec<String>,
    /// Assumptions of the built-in body about this person, in sentences.
    pub assumptions: Vec<String>,
}

/// Hip centres of the built-in body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct HipsSummary {
    /// The name of a regression, `functional` or `recorded`.
    pub method: String,
    /// Mean distance from the centres in images of the hips, as published for the method [mm]; `null` for recorded
    /// ones.
    pub expected_error_mm: Option<f64>,
    /// Place of the right one: forward, up and right from midway between the anterior spines, in axes through the
    /// spines [mm]. Recorded ones: from midway between both.
    pub right_mm: [f64; 3],
    /// Place of the left one [mm].
    pub left_mm: [f64; 3],
}

/// How far varus follows flexion at a knee, from the segments' own markers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct KneeSummary {
    /// The side.
    pub side: Side,
    /// Correlation of varus with flexion.
    pub r: f64,
    /// Range of varus from 2.5 to 97.5 % of the frames [deg].
    pub varus_range_deg: f64,
    /// Turn of the knee axis about the long axis of the thigh that makes the variance of varus least [deg].
    pub turn_deg: f64,
}

/// Quality of the marker fit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MarkersSummary {
    /// Root mean square distance of the markers, averaged over the frames [mm].
    pub rms_mm: Option<f64>,
    /// The same by region of the body, over markers and frames: `legs`, `trunk` and `arms` that have markers.
    #[serde(default)]
    pub regions: BTreeMap<Region, RegionSummary>,
    /// Frames in which the fit did not converge.
    pub frames_not_converged: usize,
    /// Number of markers that the body follows.
    #[serde(default)]
    pub used: usize,
    /// Number of markers of the recording.
    #[serde(default)]
    pub recorded: usize,
    /// Errors of each marker.
    pub errors: Vec<MarkerErrorSummary>,
}

/// Distances of the markers of a region of the body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RegionSummary {
    /// Root mean square over markers and frames [mm].
    pub rms_mm: f64,
    /// Names of the markers, the farthest first; `errors` has their distances.
    pub markers: Vec<String>,
}

/// Distance of one marker from its place on the body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MarkerErrorSummary {
    /// Name of the marker.
    pub name: String,
    /// Root mean square [mm]; `null` if it was never used.
    pub rms_mm: Option<f64>,
    /// Largest [mm].
    pub max_mm: Option<f64>,
    /// Frames in which it is visible.
    pub frames_seen: usize,
    /// Frames in which it is visible but was rejected.
    pub frames_refused: usize,
}

/// A time during which a force plate was loaded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlateContactSummary {
    /// Name of the plate.
    pub plate: String,
    /// The foot on it; `null` if not known.
    pub side: Option<Side>,
    /// First loaded instant [s].
    pub start_s: f64,
    /// Last loaded instant [s].
    pub end_s: f64,
    /// Largest vertical force [N].
    pub peak_n: f64,
    /// Whether the plate measured the whole load of the foot.
    pub quality: ContactQuality,
    /// Why the contact is not clean; empty if it is.
    pub reason: String,
}

/// Position of a force plate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlateCornersSummary {
    /// Name of the plate.
    pub plate: String,
    /// Its corners in turn, in world axes [m].
    pub corners_m: [[f64; 3]; 4],
}

/// Agreement of two sources of foot strikes and foot offs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EventAgreementSummary {
    /// The events that are compared.
    pub found: EventOrigin,
    /// The events that they are compared with.
    pub reference: EventOrigin,
    /// Agreement of foot strikes, then of foot offs.
    pub kinds: Vec<EventAgreement>,
}

/// Source of events.
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
        word(&self)
    }
}

/// The size of a segment of the built-in body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SegmentSummary {
    /// Name of the body.
    pub body: String,
    /// Length relative to the table for the stature.
    pub factor: f64,
    /// Whether it was measured by markers; otherwise it is from the table.
    pub measured: bool,
}

impl SubjectSummary {
    /// Makes the summary of a body fitted to markers.
    #[must_use]
    pub fn of_markers(tracked: &TrackedMarkers) -> SubjectSummary {
        let TrackedMarkers { body, regions, listed_events: listed, measured_events: measured } = tracked;
        let report = body.subject.calibration.as_ref();
        let segments = report.map_or(&[][..], |report| &report.segments);
        SubjectSummary {
            turn_deg: body.laboratory.turn_deg,
            marker_sets: body.subject.sets.clone(),
            knees: body.cross_talk.iter().filter_map(|(side, knee)| Some(KneeSummary::new(side, (*knee)?))).collect(),
            hips: report.map(|report| HipsSummary::new(&report.hips)),
            segments: segments.iter().map(SegmentSummary::new).collect(),
            plates: plate_contacts(body),
            plate_corners_m: body.plates.iter().map(PlateCornersSummary::new).collect(),
            instrumented_windows_s: body.on_plates.windows.clone(),
            events: agreements(body, listed, measured),
            contradictions: body.contradictions.clone(),
            assumptions: report.map(|r| r.assumptions.clone()).unwrap_or_default(),
            markers: MarkersSummary::new(&body.fit, regions, body.recorded_markers),
            ..SubjectSummary::of_skeleton(&body.laboratory.statement, &body.fit, regions)
        }
    }

    /// Makes the summary of a body fitted to a skeleton.
    #[must_use]
    pub fn of_skeleton(axes: &str, fit: &MarkerFit, regions: &[RegionFit]) -> SubjectSummary {
        SubjectSummary {
            axes: axes.to_owned(),
            turn_deg: None,
            marker_sets: Vec::new(),
            markers: MarkersSummary::new(fit, regions, fit.errors.len()),
            hips: None,
            knees: Vec::new(),
            segments: Vec::new(),
            plates: Vec::new(),
            plate_corners_m: Vec::new(),
            instrumented_windows_s: Vec::new(),
            events: Vec::new(),
            contradictions: Vec::new(),
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

/// Compares motion and file with plates; without plates, the file with the motion.
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

impl KneeSummary {
    fn new(side: Side, knee: CrossTalk) -> KneeSummary {
        let [varus_range_deg, turn_deg] = [knee.varus_range_rad, knee.turn_rad].map(f64::to_degrees);
        KneeSummary { side, r: knee.r, varus_range_deg, turn_deg }
    }
}

impl HipsSummary {
    fn new(hips: &HipCentres) -> HipsSummary {
        let millimetres = |centre: Vec3| centre.map(|length| 1e3 * length).into();
        HipsSummary {
            method: hips.method.to_owned(),
            expected_error_mm: hips.expected_error_m.map(|error| 1e3 * error),
            right_mm: millimetres(hips.centres_m.right),
            left_mm: millimetres(hips.centres_m.left),
        }
    }
}

impl MarkersSummary {
    fn new(fit: &MarkerFit, regions: &[RegionFit], recorded: usize) -> MarkersSummary {
        let millimetres = |m: f64| m.is_finite().then_some(1e3 * m);
        let used: Vec<f64> = fit.rms_m.iter().copied().filter(|rms| rms.is_finite()).collect();
        let errors = fit.errors.iter().map(|error| MarkerErrorSummary {
            name: error.name.clone(),
            rms_mm: millimetres(error.rms_m),
            max_mm: millimetres(error.max_m),
            frames_seen: error.seen,
            frames_refused: error.down_weighted,
        });
        MarkersSummary {
            rms_mm: millimetres(used.iter().sum::<f64>() / used.len() as f64),
            regions: regions.iter().map(|fit| (fit.region, RegionSummary::new(fit))).collect(),
            frames_not_converged: fit.converged.iter().filter(|converged| !**converged).count(),
            used: fit.errors.iter().filter(|error| error.rms_m.is_finite()).count(),
            recorded,
            errors: errors.collect(),
        }
    }
}

impl RegionSummary {
    fn new(fit: &RegionFit) -> RegionSummary {
        RegionSummary { rms_mm: 1e3 * fit.rms_m, markers: fit.markers.iter().map(|(name, _)| name.clone()).collect() }
    }
}

impl MarkersSummary {
    /// A region in words: its distance, and the markers that are farthest from the body.
    #[must_use]
    pub fn region_words(&self, region: &RegionSummary) -> String {
        /// Markers named.
        const NAMED: usize = 3;
        let distance = |name: &String| self.errors.iter().find(|error| error.name == *name)?.rms_mm;
        let shown = |name: &String| Some(format!("{name} {:.0}", distance(name)?));
        let farthest: Vec<String> = region.markers.iter().take(NAMED).filter_map(shown).collect();
        format!("{:.1} mm rms, farthest {}", region.rms_mm, farthest.join(", "))
    }
}

impl fmt::Display for EventOrigin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}
