//! Quality of the data: whether recording, body and forces fit together well enough for the results to be used.
//!
//! The verdict is about the movement, the quality is about the data. Each [`Measure`] has two limits: beyond the first
//! the data are doubtful, beyond the second bad.
//!
//! Sources: Hicks, Uchida, Seth, Rajagopal, Delp 2015, J Biomech Eng 137:020905 ask for marker errors below 20 mm rms,
//! and for residual forces below 5 % of the largest ground force (unverified); the limit of the residual is wider here,
//! because forces and motion are filtered apart. The other limits are chosen here, so that clean walks are inside and
//! spoiled copies of them outside. [`stance_heights`] has its own source.
//! Pinned by: tests/quality.rs

mod measure;
mod plate_place;
pub(crate) mod stance_heights;

use super::force_directions::{ForceDirections, is_used};
use super::idle_forces::IdleForces;
use super::mass::BodyMass;
use super::origin::{ForceOrigin, Tracking};
use super::region_fit::RegionFit;
use super::timing::{CenterOffset, ForceDelay, Tempo};
use super::unmeasured_leg::UnmeasuredLeg;
use crate::analysis::PredictionCheck;
use crate::analysis::feasibility::{Check, Reason, Verdict};
use crate::findings::word;
use crate::kinematics::keypoints::{FrozenLegs, KeypointReport};
use crate::model::{CoordinateId, Model, Region};
use crate::motion::{Jumps, Motion, Smoother, jumps};
use crate::numerics::degrees;
use crate::spatial::Vec3;
#[doc(hidden)]
pub use measure::{Measure, QualityLimits};
pub(super) use plate_place::PlatePlace;
use serde::{Deserialize, Serialize};
pub(super) use stance_heights::StanceHeights;

/// Whether the data can be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum QualityState {
    /// No measure is beyond its limits.
    Good,
    /// Results may be wrong in parts; the reasons say where.
    Doubtful,
    /// Results should not be used.
    Bad,
}

impl QualityState {
    /// The word in files and reports.
    #[must_use]
    pub fn word(self) -> &'static str {
        word(&self)
    }
}

/// Whether the data can be used, and why not.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Quality {
    /// Good, doubtful or bad.
    pub state: QualityState,
    /// Measures beyond their limits, the worst first.
    pub reasons: Vec<QualityReason>,
}

/// A measure beyond its limit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct QualityReason {
    /// Measured quantity.
    pub measure: Measure,
    /// Doubtful or bad.
    pub state: QualityState,
    /// The value.
    pub value: f64,
    /// The limit of good data.
    pub limit: f64,
    /// Unit of both.
    pub unit: String,
    /// The same as a sentence, with the place.
    pub message: String,
}

impl Quality {
    #[doc(hidden)] // for tests
    pub fn of(reasons: impl IntoIterator<Item = QualityReason>) -> Quality {
        let mut reasons: Vec<QualityReason> = reasons.into_iter().collect();
        reasons.sort_by(|a, b| b.state.cmp(&a.state).then(b.excess().total_cmp(&a.excess())));
        Quality { state: reasons.first().map_or(QualityState::Good, |worst| worst.state), reasons }
    }
}

impl QualityReason {
    /// By which factor the limit is missed; infinite where the limit or the value is zero.
    fn excess(&self) -> f64 {
        let ratio = self.value / self.limit;
        ratio.max(ratio.recip())
    }
}

/// Faults of a motion as recorded, before smoothing hides them.
pub(super) struct RecordedFaults {
    /// Share of the frames in which a coordinate is not known.
    unknown_share: f64,
    /// Time of the first such frame [s].
    first_unknown_s: Option<f64>,
    /// Number of jumps of coordinates.
    jumps: usize,
    /// Coordinate, frame (counted from 1) and time [s] of the first jump.
    first_jump: Option<(String, usize, f64)>,
}

impl RecordedFaults {
    pub(super) fn of(model: &Model, motion: &Motion) -> RecordedFaults {
        let is_unknown = |frame: &usize| motion.columns.iter().flatten().any(|column| column[*frame].is_nan());
        let unknown = || (0..motion.times.len()).filter(is_unknown);
        let found = jumps(model, motion);
        let first_jump =
            found.iter().filter_map(|jumps| Some((jumps, *jumps.frames.first()?))).min_by_key(|(_, frame)| *frame);
        let described = |(jumps, frame): (&Jumps, usize)| {
            let name = model.coordinates()[jumps.coordinate.index()].name.clone();
            (name, frame + 1, motion.times[frame])
        };
        RecordedFaults {
            unknown_share: unknown().count() as f64 / motion.times.len().max(1) as f64,
            first_unknown_s: unknown().next().map(|frame| motion.times[frame]),
            jumps: found.iter().map(|jumps| jumps.frames.len()).sum(),
            first_jump: first_jump.map(described),
        }
    }
}

/// Everything that the quality depends on.
pub(super) struct QualityEvidence<'a> {
    /// Faults of the motion before smoothing; `None` for a complete motion.
    pub(super) recorded: Option<&'a RecordedFaults>,
    /// The filter of the motion, and its rate [Hz].
    pub(super) smoothed: (Smoother, f64),
    /// Whether no frame remains without the ends of the motion, which are not measured.
    pub(super) is_too_short: bool,
    pub(super) force_origin: ForceOrigin,
    /// Whether forces were measured, but at no time those of all loaded feet.
    pub(super) is_never_complete: bool,
    pub(super) tracking: Option<&'a Tracking>,
    /// Whether the place of the person follows from the feet on the ground.
    pub(super) place_is_derived: bool,
    pub(super) mass: &'a BodyMass,
    /// Stature [m].
    pub(super) height_m: f64,
    /// Messages about force plates, and forces of a table, of which a part is missing.
    pub(super) lost_forces: Vec<String>,
    pub(super) not_measured: &'a [(CoordinateId, bool)],
    pub(super) model: &'a Model,
    pub(super) idle: &'a IdleForces,
    /// A leg that stood on plates, but none of whose stances was measured.
    pub(super) unmeasured_leg: Option<&'a UnmeasuredLeg>,
    pub(super) directions: &'a ForceDirections,
    pub(super) heights: StanceHeights,
    /// Of measured forces.
    pub(super) place: Option<PlatePlace>,
    /// Of measured forces under a whole body.
    pub(super) center_offset: Option<CenterOffset>,
    /// How late the measured forces are; late forces do no harm to a prediction that they are only compared with.
    pub(super) delay: Option<ForceDelay>,
    /// The clock of the motion, if it is wrong.
    pub(super) tempo: Option<Tempo>,
    pub(super) verdict: &'a Verdict,
    /// How well the motion shows the foot strikes from which forces were predicted.
    pub(super) shown: Option<&'a PredictionCheck>,
}

impl QualityEvidence<'_> {
    pub(super) fn quality(&self) -> Quality {
        let of_forces = [self.residual_force(), self.residual_moment(), self.ground_forces(), self.measured_forces()];
        let of_body = [self.marker_fit(), self.trunk_fit(), self.scaling(), self.scale_factors(), self.mass()];
        let of_size = [self.body_mass_index(), self.lost_forces()];
        let of_person = [self.whose_markers(), self.unmeasured()];
        let of_motion = [self.gaps(), self.jumps(), self.frame_rate(), self.cutoff(), self.bandwidth()];
        let of_feet =
            [self.sliding(), self.center_of_pressure(), self.stance_height(), self.plate_place(), self.center_offset()];
        let of_plates =
            [self.unchecked_forces(), self.unmeasured_leg(), self.unassigned_forces(), self.silent_plates()];
        let of_recording = [self.force_directions(), self.force_delay(), self.tempo()];
        let of_keypoints = [self.frozen_points(), self.axial_rotation(), self.derived_place()];
        Quality::of(
            of_forces
                .into_iter()
                .chain(of_plates)
                .chain(of_recording)
                .chain(of_keypoints)
                .chain(of_body)
                .chain(of_size)
                .chain(of_person)
                .chain(of_feet)
                .chain(of_motion)
                .flatten(),
        )
    }

    fn residual_force(&self) -> Option<QualityReason> {
        let force_bw = self.verdict.fit.residual_force_bw?;
        Measure::ResidualForce.reason(force_bw, |limit| {
            format!(
                "the residual force is {} of body weight (at most {}): motion, body and ground forces do not fit \
                 together",
                percent(force_bw),
                percent(limit)
            )
        })
    }

    fn residual_moment(&self) -> Option<QualityReason> {
        let moment_nm_kg = self.verdict.fit.residual_moment_nm_kg?;
        Measure::ResidualMoment.reason(moment_nm_kg, |limit| {
            format!(
                "the residual moment is {moment_nm_kg:.3} N.m/kg (at most {limit}): posture and centre of pressure do \
                 not fit together"
            )
        })
    }

    fn ground_forces(&self) -> Option<QualityReason> {
        let share = self.verdict.judged_share;
        Measure::GroundForces.reason(share, |limit| match self.force_origin {
            ForceOrigin::None => "there are no ground forces: moments of legs on the ground are wrong".to_owned(),
            _ if self.is_too_short => {
                "the motion is too short to compare it with its ground forces: the first and the last 0.1 s are not \
                 measured"
                    .to_owned()
            }
            _ => {
                format!("ground forces are known in {} of the motion (at least {})", percent(share), percent(limit))
            }
        })
    }

    fn measured_forces(&self) -> Option<QualityReason> {
        if self.is_too_short {
            return None;
        }
        let share = (self.force_origin == ForceOrigin::Measured).then_some(self.verdict.fit.complete_share)?;
        Measure::MeasuredForces.reason(share, |limit| {
            format!(
                "the measured ground forces carry the body in {} of the motion (at least {}): they may not belong to \
                 it",
                percent(share),
                percent(limit)
            )
        })
    }

    /// Where no residual can be computed, nothing shows that the forces belong to the motion.
    fn unchecked_forces(&self) -> Option<QualityReason> {
        let value = if self.is_never_complete { 1.0 } else { 0.0 };
        Measure::UncheckedForces.reason(value, |_| {
            "forces were measured, but at no time those of all loaded feet: the residual cannot be computed, and \
             nothing shows that forces and motion belong together"
                .to_owned()
        })
    }

    /// The residual is checked in the stances of the other leg only.
    fn unmeasured_leg(&self) -> Option<QualityReason> {
        let leg = self.unmeasured_leg?;
        Measure::UnmeasuredLeg.reason(1.0, |_| leg.message())
    }

    fn unassigned_forces(&self) -> Option<QualityReason> {
        let (share, [from, to]) = self.idle.unassigned()?;
        Measure::UnassignedForces.reason(share, |limit| {
            format!(
                "{} of the measured load lies under no foot, first from {from:.3} to {to:.3} s (at most {}): forces \
                 and motion may not belong together",
                percent(share),
                percent(limit)
            )
        })
    }

    fn silent_plates(&self) -> Option<QualityReason> {
        let (share, first) = self.idle.silent()?;
        Measure::SilentPlates.reason(share, |_| {
            format!("no load was measured in {} of the stances on force plates, first {first}", percent(share))
        })
    }

    /// A wrong sign or direction is in the moments, unless the forces are predicted.
    fn force_directions(&self) -> Option<QualityReason> {
        let (sentence, agreement) = self.directions.worst()?;
        let reason = Measure::ForceDirections.reason(agreement, |_| sentence.to_owned());
        reason.filter(|_| is_used(&self.force_origin))
    }

    fn marker_fit(&self) -> Option<QualityReason> {
        let judged = decisive(self.tracking?.regions())?;
        Measure::MarkerFit.reason(judged.rms_m, |limit| {
            format!(
                "{}, at most {}: the body is not this person's, or points are misplaced",
                judged.words(),
                millimetres(limit)
            )
        })
    }

    /// Moments of the legs do not follow from the trunk, but residuals and predicted forces do.
    fn trunk_fit(&self) -> Option<QualityReason> {
        let trunk = above_the_legs(self.tracking?.regions()).find(|fit| fit.region == Region::Trunk)?;
        Measure::TrunkFit.reason(trunk.rms_m, |limit| {
            format!(
                "{}, at most {}: residuals and predicted forces, which need the motion of the trunk, are uncertain",
                trunk.words(),
                millimetres(limit)
            )
        })
    }

    fn whose_markers(&self) -> Option<QualityReason> {
        let Some(Tracking::Markers(tracked)) = self.tracking else { return None };
        let contradictions = &tracked.body.contradictions;
        Measure::WhoseMarkers.reason(contradictions.len() as f64, |_| contradictions.join("; "))
    }

    fn unmeasured(&self) -> Option<QualityReason> {
        let held = self.not_measured.iter().filter(|(_, is_held)| *is_held);
        let names: Vec<String> =
            held.map(|(id, _)| format!("`{}`", self.model.coordinates()[id.index()].name)).collect();
        Measure::NotMeasured.reason(names.len() as f64, |_| {
            format!("nothing recorded determines {}: one value in every frame", names.join(", "))
        })
    }

    fn scaling(&self) -> Option<QualityReason> {
        let Some(Tracking::Markers(tracked)) = self.tracking else { return None };
        let rms_m = tracked.body.subject.scaling_rms_m?;
        Measure::Scaling.reason(rms_m, |limit| {
            format!(
                "the scaled model is {} from the markers of the standing trial (rms; at most {}): the markers have \
                 other places on this model",
                millimetres(rms_m),
                millimetres(limit)
            )
        })
    }

    fn scale_factors(&self) -> Option<QualityReason> {
        let Some(Tracking::Markers(tracked)) = self.tracking else { return None };
        let size = |(_, factors): &&(String, Vec3)| factors.sum() / 3.0;
        let scaled = || tracked.body.subject.scaled.iter();
        let least = scaled().min_by(|a, b| size(a).total_cmp(&size(b)))?;
        let most = scaled().max_by(|a, b| size(a).total_cmp(&size(b)))?;
        let ratio = size(&most) / size(&least);
        Measure::ScaleFactors.reason(ratio, |limit| {
            format!(
                "the scale factors of the model reach from {:.2} (`{}`) to {:.2} (`{}`), {ratio:.2} times as much (at \
                 most {limit} times): standing trial and model do not fit together",
                size(&least),
                least.0,
                size(&most),
                most.0
            )
        })
    }

    fn mass(&self) -> Option<QualityReason> {
        if let Some(file) = self.mass.otherwise_in_file() {
            return Measure::Mass.reason(self.mass.disagreement(file), |limit| {
                format!(
                    "the recording states {:.1} kg, the body has the given {:.1} kg, and no force plate decides (at \
                     most {} apart)",
                    file.kg,
                    self.mass.kg,
                    percent(limit)
                )
            });
        }
        let weighing = self.mass.on_plates()?;
        Measure::Mass.reason(self.mass.disagreement(&weighing), |limit| {
            format!(
                "force plates carry {:.1} kg, the body has {:.1} kg (at most {} apart, and {:.1} kg for the error of \
                 weighing)",
                weighing.kg,
                self.mass.kg,
                percent(limit),
                weighing.error_kg
            )
        })
    }

    fn body_mass_index(&self) -> Option<QualityReason> {
        let value = self.mass.unusual_by(self.height_m);
        Measure::BodyMassIndex.reason(value, |_| self.mass.unusual(self.height_m))
    }

    /// A part of the measured force is missing.
    fn lost_forces(&self) -> Option<QualityReason> {
        let lost = self.lost_forces.iter().filter(|_| is_used(&self.force_origin));
        let messages: Vec<&str> = lost.map(String::as_str).collect();
        Measure::LostForces.reason(messages.len() as f64, |_| messages.join("; "))
    }

    fn gaps(&self) -> Option<QualityReason> {
        self.tracking?;
        let RecordedFaults { unknown_share: share, first_unknown_s, .. } = *self.recorded?;
        Measure::Gaps.reason(share, |limit| {
            format!(
                "markers are missing or were left out as outliers, so that the posture is unknown in {} of the frames, \
                 the first at {:.3} s (at most {})",
                percent(share),
                first_unknown_s.unwrap_or(f64::NAN),
                percent(limit)
            )
        })
    }

    fn sliding(&self) -> Option<QualityReason> {
        let speed_m_s = self.verdict.fit.sliding_m_s?;
        Measure::Sliding.reason(speed_m_s, |limit| {
            format!(
                "soles that carry the body move along the ground at {speed_m_s:.3} m/s or more for three quarters of \
                 the time (at most {limit} m/s): the motion of the legs is wrong"
            )
        })
    }

    /// Force plates and motion that are not aligned in place or time are a fault of the data, whatever the movement is.
    fn center_of_pressure(&self) -> Option<QualityReason> {
        let outside = |reason: &&Reason| reason.check == Check::CenterOfPressure;
        let reasons =
            self.verdict.reasons.iter().filter(outside).filter(|_| self.force_origin == ForceOrigin::Measured);
        let worst = reasons.max_by(|a, b| a.value.total_cmp(&b.value))?;
        Measure::CenterOfPressure.reason(worst.value, |limit| {
            format!(
                "the measured centre of pressure is {:.3} m outside the sole at {:.3} s (at most {limit} m): force \
                 plates and motion are not aligned in place or time, or a force acts on the wrong foot",
                worst.value, worst.at_s
            )
        })
    }

    fn plate_place(&self) -> Option<QualityReason> {
        self.place?.reason()
    }

    fn center_offset(&self) -> Option<QualityReason> {
        let offset = self.center_offset.as_ref()?;
        Measure::CenterOffset.reason(offset.distance_m(), |_| offset.message())
    }

    /// The floor of a level walk has one height.
    fn stance_height(&self) -> Option<QualityReason> {
        let farthest = self.heights.farthest()?;
        Measure::StanceHeight.reason(farthest.above_m.abs(), |limit| {
            let (verb, direction) = if farthest.above_m < 0.0 { ("sinks", "below") } else { ("floats", "above") };
            format!(
                "the {} foot {verb}: in the stance at {:.3} s its sole is {} {direction} that of its other stances (at \
                 most {}), while the pelvis stays level",
                farthest.side,
                farthest.at_s,
                millimetres(farthest.above_m.abs()),
                millimetres(limit)
            )
        })
    }

    fn jumps(&self) -> Option<QualityReason> {
        // Coordinates that were fitted to markers jump where few markers determine them; the distance of the markers
        // judges these.
        let recorded = self.recorded.filter(|_| self.tracking.is_none())?;
        let RecordedFaults { jumps, first_jump: Some((name, frame, time_s)), .. } = recorded else { return None };
        Measure::Jumps.reason(*jumps as f64, |_| {
            format!(
                "coordinates jump in {jumps} place{}, first `{name}` at frame {frame} ({time_s:.3} s): forces are \
                 wrong there",
                if *jumps == 1 { "" } else { "s" },
            )
        })
    }

    fn keypoints(&self) -> Option<&KeypointReport> {
        let Some(Tracking::Markers(tracked)) = self.tracking else { return None };
        tracked.body.keypoints.as_ref()
    }

    fn frozen_points(&self) -> Option<QualityReason> {
        let FrozenLegs { share, thigh_from_vertical } = self.keypoints()?.frozen;
        Measure::FrozenPoints.reason(share, |limit| {
            format!(
                "the points of the legs move as one rigid piece in {} of the time in which the hips move (at most {}), \
                 with the thighs {} from the vertical: a program filled them in, because the person was \
                 partly out of view",
                percent(share),
                percent(limit),
                degrees(thigh_from_vertical.to_degrees())
            )
        })
    }

    /// Axial rotations follow from feet and bent knees only, and the lever of the ankle from the toe.
    fn axial_rotation(&self) -> Option<QualityReason> {
        let deviation = Some(self.keypoints()?.thigh_rotation).filter(|deviation| !deviation.is_nan())?;
        let deviation_deg = deviation.to_degrees().min(180.0);
        Measure::AxialRotation.reason(deviation_deg, |limit| {
            format!(
                "keypoints hardly show axial rotations: that of the thighs is known to {} (at most {limit}), so \
                 moments about the long axes, and how the others are divided between flexion and adduction, are \
                 uncertain; the ankle moment changes by 0.1 N.m/kg with every 10 mm by which toe or \
                 heel are misplaced",
                degrees(deviation_deg)
            )
        })
    }

    /// Orientations do not show where the person is.
    fn derived_place(&self) -> Option<QualityReason> {
        let share = if self.place_is_derived { 1.0 } else { 0.0 };
        Measure::DerivedPlace.reason(share, |_| {
            "where the person is was derived from the feet on the ground, not measured: the path of the mass centre, \
             and with it forces along the floor and the vertical force in double support, are less certain than the \
             joint angles"
                .to_owned()
        })
    }

    /// Every velocity depends on the frame rate, and every force on its square.
    fn frame_rate(&self) -> Option<QualityReason> {
        let Some(Tracking::Skeleton { flights: Some(flights), .. }) = self.tracking else { return None };
        Measure::FrameRate.reason(flights.wrong_by(), |limit| {
            format!(
                "in flight the person falls with {:.1} m/s², so the motion has about {:.0} frames per second and not \
                 {:.0} as stated (at most {limit} times apart): every force is wrong",
                flights.gravity,
                flights.rate_hz(),
                flights.stated_hz
            )
        })
    }

    fn force_delay(&self) -> Option<QualityReason> {
        let delay = self.delay?;
        Measure::ForceDelay.reason(delay.delay_s.abs(), |_| delay.message())
    }

    fn tempo(&self) -> Option<QualityReason> {
        let tempo = self.tempo?;
        Measure::Tempo.reason(tempo.wrong_by(), |_| tempo.message())
    }

    fn cutoff(&self) -> Option<QualityReason> {
        let (Smoother::Butterworth(filter), rate_hz) = self.smoothed else { return None };
        let cutoff_hz = filter.cutoff_hz;
        let low = Measure::LowCutoff.reason(cutoff_hz, |limit| {
            format!("the motion is filtered at {cutoff_hz} Hz (at least {limit} Hz): the movement itself is removed")
        });
        let high = || {
            // Times with few digits give a rate of 29.99999 Hz.
            let share = (1e4 * cutoff_hz / rate_hz).round() / 1e4;
            Measure::HighCutoff.reason(share, |limit| {
                format!(
                    "the motion is filtered at {cutoff_hz} Hz (at most {:.1} Hz with {rate_hz:.0} frames per second): \
                     noise remains in the forces",
                    limit * rate_hz
                )
            })
        };
        low.or_else(high)
    }

    /// Predicted forces miss the peaks that the motion no longer shows.
    fn bandwidth(&self) -> Option<QualityReason> {
        let failed = self.shown.filter(|check| check.passed == Some(false))?;
        let PredictionCheck { value, allowed: [least, _], .. } = failed;
        let share = (*value)? / least;
        Measure::MotionBandwidth.reason(share, |_| {
            format!(
                "the motion was recorded up to {:.1} Hz, where foot strikes at this speed need {least:.1} Hz: peaks of \
                 the predicted forces are missing",
                share * least
            )
        })
    }
}

/// The region whose fit decides whether the motion is known: pelvis and legs, or the first region of a model without.
pub(super) fn decisive(regions: &[RegionFit]) -> Option<&RegionFit> {
    regions.first()
}

/// The fits of trunk and arms, if another region is decisive.
pub(super) fn above_the_legs(regions: &[RegionFit]) -> impl Iterator<Item = &RegionFit> {
    regions.iter().skip(1)
}

fn percent(share: f64) -> String {
    format!("{:.0} %", 100.0 * share)
}

fn millimetres(length_m: f64) -> String {
    format!("{:.0} mm", 1e3 * length_m)
}
