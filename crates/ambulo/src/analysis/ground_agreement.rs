//! Comparison of predicted with measured ground forces.
//!
//! | quantity | samples |
//! |---|---|
//! | force on a foot: RMSE in body weights, rRMSE, r | whole stances, where the measured vertical force exceeds 20 N |
//! | centre of pressure: RMS distance, unweighted and weighted by the vertical force | as above, where the measured vertical force exceeds 5 % of body weight |
//! | sagittal moments of a leg: RMSE, r | the instrumented window, swing included, and whole stances of that leg |
//! | foot strikes and foot offs: mean absolute error | events detected by force plates |
//!
//! Stances shorter than 0.2 s are left out. Vertical is against gravity; fore-aft and lateral follow
//! [`super::walking_direction`]. rRMSE and r: [`super::comparison`]. Bands: the share of samples within 1.645 standard
//! deviations, which would be 90 % for a normal distribution, and the width of the band relative to the RMSE.
//! Pinned by: tests/ground_agreement.rs

use super::comparison::agreement;
use super::event_agreement::{EventAgreement, event_agreement};
use super::events::{Contact, Event};
use super::predicted::PredictedAnalysis;
use super::recording::{Analysis, Mass};
use super::walking_direction::WalkingDirection;
use crate::ground::footfalls::Footfalls;
use crate::ground::phases::contacts_from_events;
use crate::ground::predict::{ErrorSample, FootDeviation, Prediction, Traits, outwards_sign, stance_traits};
use crate::ground::{BodyForces, CENTER_OF_PRESSURE_LOAD_N, feet};
use crate::model::{Model, Movement, Side};
use crate::motion::{ForceRecording, TimeGrid, Window};
use crate::numerics::or_nan;
use crate::spatial::Vec3;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Shorter stances are left out [s].
const SHORTEST_STANCE_S: f64 = 0.2;
/// Centres of pressure are compared above this share of body weight.
const CENTER_LOAD_BW: f64 = 0.05;
/// Standard deviations on either side that contain 90 % of a normal distribution.
const BAND_90: f64 = 1.645;
/// Movements whose moments are compared.
const MOMENTS: [Movement; 3] = [Movement::HipFlexion, Movement::KneeFlexion, Movement::AnkleDorsiflexion];
/// A stance detected in the motion counts as measured if a foot's sensor was loaded for at least this share of it.
const MEASURED_SHARE: f64 = 0.5;

/// Stances, time and events that force plates measured completely.
#[derive(Debug, Clone, PartialEq)]
pub struct PlateCoverage {
    /// Whole stances of feet that were entirely on a separate plate [s].
    pub stances: Vec<(Side, [f64; 2])>,
    /// The longest instrumented window [s].
    pub window: Option<[f64; 2]>,
    /// Foot strikes and foot offs.
    pub events: Vec<Event>,
}

/// Agreement of predicted with measured forces.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct GroundAgreement {
    /// Body mass for the normalisation to body weight [kg].
    pub mass_kg: f64,
    /// The instrumented window [s].
    pub window_s: Option<[f64; 2]>,
    /// Each foot with a whole stance on a separate plate.
    pub feet: Vec<FootAgreement>,
    /// Sagittal moments of the legs.
    pub moments: Vec<MomentAgreement>,
    /// Foot strikes, then foot offs.
    pub events: [EventAgreement; 2],
}

/// Agreement of one foot over its stances.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FootAgreement {
    /// `r` or `l`.
    pub side: Side,
    /// From foot strike to foot off [s].
    pub stances_s: Vec<[f64; 2]>,
    /// Number of samples.
    pub samples: usize,
    /// Against gravity.
    pub vertical: ForceAgreement,
    /// Along the walking direction.
    pub fore_aft: ForceAgreement,
    /// Across the walking direction.
    pub lateral: ForceAgreement,
    /// Centre of pressure.
    pub center_of_pressure: CenterAgreement,
}

/// Agreement of one component of a force.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ForceAgreement {
    /// Root-mean-square difference in body weights.
    #[serde(deserialize_with = "or_nan")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub rmse_bw: f64,
    /// RMSE over the mean of the two ranges.
    #[serde(deserialize_with = "or_nan")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub rrmse: f64,
    /// Pearson's correlation.
    #[serde(deserialize_with = "or_nan")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub r: f64,
    /// Agreement of the predicted standard deviation with the error.
    pub band: BandAgreement,
}

/// A band of 1.645 standard deviations about the prediction.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BandAgreement {
    /// Share of the measured samples inside the band.
    #[serde(deserialize_with = "or_nan")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub holds: f64,
    /// Mean half-width of the band over the RMSE.
    #[serde(deserialize_with = "or_nan")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub half_width_over_rmse: f64,
}

/// Agreement of the centre of pressure [mm].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CenterAgreement {
    /// Samples with a predicted and a measured centre of pressure.
    pub samples: usize,
    /// Samples with a measured but no predicted centre of pressure.
    pub missing: usize,
    /// RMS along the walking direction.
    #[serde(deserialize_with = "or_nan")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub fore_aft_mm: f64,
    /// RMS across the walking direction.
    #[serde(deserialize_with = "or_nan")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub lateral_mm: f64,
    /// RMS along the walking direction, samples weighted by the measured vertical force.
    #[serde(deserialize_with = "or_nan")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub fore_aft_weighted_mm: f64,
    /// RMS across the walking direction, with the same weights.
    #[serde(deserialize_with = "or_nan")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub lateral_weighted_mm: f64,
}

/// Agreement of one joint moment.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MomentAgreement {
    /// Column of `moments.sto`.
    pub quantity: String,
    /// `r` or `l`.
    pub side: Side,
    /// Number of samples.
    pub samples: usize,
    /// Root-mean-square difference [N.m].
    #[serde(deserialize_with = "or_nan")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub rmse_nm: f64,
    /// RMSE over body mass [N.m/kg].
    #[serde(deserialize_with = "or_nan")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub rmse_nm_kg: f64,
    /// Pearson's correlation.
    #[serde(deserialize_with = "or_nan")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub r: f64,
}

impl PlateCoverage {
    /// Coverage without markers that show which foot was on which plate: stances are the times in which a foot's sensor
    /// was loaded, and stances that are detected in the motion but not by a sensor are excluded from the window.
    #[must_use]
    pub fn by_load(measured: &Analysis, plates: &[ForceRecording], footfalls: &Footfalls) -> PlateCoverage {
        let grid = measured.trajectory.grid();
        let ends =
            |plate: &ForceRecording| Window { from_s: plate.times.first().copied(), to_s: plate.times.last().copied() };
        let whole = Window { from_s: Some(grid.start_s), to_s: Some(grid.end_s()) };
        let both = plates.iter().fold(whole, |window, plate| window.overlap(ends(plate)));
        let [from, to] = [both.from_s.unwrap_or(f64::NAN), both.to_s.unwrap_or(f64::NAN)];
        let mut coverage = PlateCoverage { stances: Vec::new(), window: None, events: measured.events.clone() };
        let mut free = if to > from { vec![[from, to]] } else { Vec::new() };
        for side in Side::BOTH {
            let contacts = contacts_from_events(&measured.events, side);
            coverage.stances.extend(contacts.iter().filter_map(|c| Some((side, [c.strike_s?, c.off_s?]))));
            let spans: Vec<[f64; 2]> = contacts.iter().map(|c: &Contact| c.span(from, to)).collect();
            for fall in footfalls.of(side) {
                let span = [fall.strike_s.unwrap_or(from).max(from), fall.off_s.unwrap_or(to).min(to)];
                let covered: f64 = spans.iter().map(|s| (s[1].min(span[1]) - s[0].max(span[0])).max(0.0)).sum();
                if covered < MEASURED_SHARE * (span[1] - span[0]) {
                    free = free.iter().flat_map(|stretch| without(*stretch, span)).collect();
                }
            }
        }
        coverage.window = free.into_iter().max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
        coverage
    }
}

/// A time span without another one: up to two parts.
fn without([from, to]: [f64; 2], removed: [f64; 2]) -> Vec<[f64; 2]> {
    let parts = [[from, to.min(removed[0])], [from.max(removed[1]), to]];
    if removed[1] <= from || removed[0] >= to {
        vec![[from, to]]
    } else {
        parts.into_iter().filter(|s| s[1] > s[0]).collect()
    }
}

/// A whole stance of a foot on a separate plate, predicted and measured.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparedStance {
    /// Side of the foot.
    pub side: Side,
    /// From foot strike to foot off [s].
    pub span_s: [f64; 2],
    /// Traits on which the mean errors of predictions depend (`stance_traits`).
    pub traits: Traits,
    /// The frames in which the plate was loaded.
    pub samples: Vec<ComparedSample>,
}

/// One frame of a stance. Forces are vertical, fore-aft, lateral (to the right) [N]; centres of pressure fore-aft,
/// lateral [m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ComparedSample {
    /// Elapsed share of the stance by the plates.
    pub phase: f64,
    /// Elapsed share of the stance as it was detected from the motion, 0 to 1.
    pub detected_phase: f64,
    /// Predicted force.
    pub predicted: [f64; 3],
    /// Measured force.
    pub measured: [f64; 3],
    /// Standard deviation of the predicted force.
    pub deviation: [f64; 3],
    /// Predicted minus measured centre of pressure; not a number where one of them is unknown.
    pub center_off: [f64; 2],
    /// Standard deviation of the predicted centre of pressure.
    pub center_deviation: [f64; 2],
    /// Predicted minus measured free moment about the vertical [N.m].
    pub free_moment_off: f64,
    /// Standard deviation of the predicted free moment.
    pub free_moment_deviation: f64,
}

impl ComparedStance {
    /// Agreement of this stance alone; `None` without a loaded frame. `weight_n` is the body weight [N].
    #[must_use]
    pub fn agreement(&self, weight_n: f64) -> Option<FootAgreement> {
        foot(self.side, weight_n, &[self])
    }

    /// The samples in a fifth of the time of the stance by the plates, counted from 0.
    #[must_use]
    pub fn fifth(&self, fifth: usize) -> ComparedStance {
        let is_inside = |s: &&ComparedSample| ((5.0 * s.phase) as usize).min(4) == fifth;
        ComparedStance { samples: self.samples.iter().filter(is_inside).copied().collect(), ..*self }
    }

    /// Errors over the stance as detected, in the order of [`StanceErrors`](crate::ground::predict::StanceErrors):
    /// forces in body weights, centres of pressure in statures, sideways is outwards. The weights of the samples of a
    /// component sum to 1; samples of a centre of pressure weigh more where the foot is loaded.
    #[must_use]
    pub fn errors(&self, weight_n: f64, stature_m: f64) -> [Vec<ErrorSample>; 5] {
        let mut all: [Vec<ErrorSample>; 5] = Default::default();
        let (outwards, traits) = (outwards_sign(self.side), self.traits);
        for s in &self.samples {
            let phase = s.detected_phase;
            let [up, forward, sideways] = [0, 1, 2].map(|axis| (s.measured[axis] - s.predicted[axis]) / weight_n);
            let weight = 1.0 / self.samples.len() as f64;
            for (axis, error) in [forward, up, outwards * sideways].into_iter().enumerate() {
                all[axis].push(ErrorSample { phase, error, weight, traits });
            }
            let load = s.measured[0] / weight_n;
            if load > CENTER_LOAD_BW {
                let [along, across] = s.center_off.map(|off| -off / stature_m);
                let weight = weight * load;
                all[3].push(ErrorSample { phase, error: along, weight, traits });
                all[4].push(ErrorSample { phase, error: outwards * across, weight, traits });
            }
        }
        all
    }
}

/// Two analyses of one motion, with predicted and with measured forces.
#[derive(Debug, Clone, Copy)]
pub struct ComparedAnalyses<'a> {
    /// The body.
    pub model: &'a Model,
    /// With predicted forces.
    pub predicted: &'a Analysis,
    /// The prediction.
    pub prediction: &'a Prediction,
    /// With measured forces.
    pub measured: &'a Analysis,
}

impl PredictedAnalysis {
    /// Agreement of predicted with measured forces; `None` without plates, or if they measured nothing completely.
    #[must_use]
    pub fn agreement(&self, model: &Model, coverage: &PlateCoverage) -> Option<GroundAgreement> {
        let PredictedAnalysis { analysis, prediction, measured } = self;
        ComparedAnalyses { model, predicted: analysis, prediction, measured: measured.as_ref()? }.agreement(coverage)
    }
}

impl ComparedAnalyses<'_> {
    /// Agreement of both; `None` if the plates measured nothing completely.
    pub(crate) fn agreement(&self, coverage: &PlateCoverage) -> Option<GroundAgreement> {
        let found = ground_agreement(self, coverage);
        (!found.feet.is_empty() || !found.moments.is_empty()).then_some(found)
    }
}

/// Compares predicted with measured forces wherever the measurement is complete.
#[must_use]
pub fn ground_agreement(compared: &ComparedAnalyses<'_>, coverage: &PlateCoverage) -> GroundAgreement {
    let ComparedAnalyses { model, predicted, prediction, measured } = *compared;
    let Mass { kg, .. } = measured.mass;
    let weight = kg * model.gravity().norm();
    let compared_stances = compared_stances(compared, coverage);
    let of_foot = |side: Side| {
        let own: Vec<&ComparedStance> = compared_stances.iter().filter(|stance| stance.side == side).collect();
        foot(side, weight, &own)
    };
    let truth = feet(model, &measured.ground);
    let moments = Side::BOTH.into_iter().flat_map(|side| {
        let truth = truth.iter().find(|(s, _)| *s == side).map(|(_, f)| &**f);
        let frames = measured_frames(compared, side, coverage, truth);
        MOMENTS.into_iter().filter_map(move |movement| moment(compared, side, movement, &frames)).collect::<Vec<_>>()
    });
    let grid = predicted.trajectory.grid();
    let inside = |event: &&Event| (grid.start_s..=grid.end_s()).contains(&event.time_s);
    let events: Vec<Event> = coverage.events.iter().filter(inside).copied().collect();
    GroundAgreement {
        mass_kg: kg,
        window_s: coverage.window,
        feet: Side::BOTH.into_iter().filter_map(of_foot).collect(),
        moments: moments.collect(),
        events: event_agreement(&events, &prediction.footfalls.events()),
    }
}

/// Every whole stance of a foot on a separate plate, predicted and measured, right foot first.
#[must_use]
pub fn compared_stances(compared: &ComparedAnalyses<'_>, coverage: &PlateCoverage) -> Vec<ComparedStance> {
    let ComparedAnalyses { model, predicted, prediction, measured } = *compared;
    let grid = predicted.trajectory.grid();
    let direction = WalkingDirection::of(model, &predicted.trajectory, &prediction.footfalls);
    let (found, truth) = (feet(model, &predicted.ground), feet(model, &measured.ground));
    let of = |list: &[(Side, Cow<'_, BodyForces>)], side: Side| list.iter().position(|(s, _)| *s == side);
    let all_traits = stance_traits(model, &predicted.trajectory, &prediction.footfalls);
    let mut all = Vec::new();
    for side in Side::BOTH {
        let (Some(found_at), Some(truth_at)) = (of(&found, side), of(&truth, side)) else { continue };
        let foot = ComparedFoot {
            grid,
            up: model.up(),
            found: &found[found_at].1,
            truth: &truth[truth_at].1,
            deviation: prediction.deviations.iter().find(|deviation| deviation.side == side),
        };
        for span_s in stances(coverage, side, grid) {
            let detected = detected(&prediction.footfalls, side, span_s);
            let detected_s = detected.map_or(span_s, |(_, span)| span);
            let samples = foot.samples([span_s, detected_s], direction.during(span_s));
            let traits = detected.map_or(Traits::default(), |(fall, _)| all_traits[fall]);
            all.push(ComparedStance { side, span_s, traits, samples });
        }
    }
    all
}

/// Index, strike and off of the stance from the motion that overlaps one on a plate most.
fn detected(footfalls: &Footfalls, side: Side, [from_s, to_s]: [f64; 2]) -> Option<(usize, [f64; 2])> {
    let own = footfalls.falls.iter().enumerate().filter(|(_, fall)| fall.side == side);
    let spans = own.map(|(i, fall)| (i, [fall.strike_s.unwrap_or(from_s), fall.off_s.unwrap_or(to_s)]));
    let overlap = |(_, [a, b]): &(usize, [f64; 2])| b.min(to_s) - a.max(from_s);
    spans.max_by(|a, b| overlap(a).total_cmp(&overlap(b))).filter(|span| overlap(span) > 0.0)
}

/// Stances of a side that are long enough and lie entirely in the motion, with a tolerance of one frame.
fn stances(coverage: &PlateCoverage, side: Side, grid: TimeGrid) -> Vec<[f64; 2]> {
    let long = |s: &[f64; 2]| s[1] - s[0] >= SHORTEST_STANCE_S;
    let inside = |s: &[f64; 2]| s[0] >= grid.start_s - grid.step_s && s[1] <= grid.end_s() + grid.step_s;
    let of_side = coverage.stances.iter().filter(|(of, _)| *of == side).map(|(_, s)| *s);
    of_side.filter(long).filter(inside).collect()
}

fn moment(
    compared: &ComparedAnalyses<'_>,
    side: Side,
    movement: Movement,
    frames: &[usize],
) -> Option<MomentAgreement> {
    let ComparedAnalyses { model, predicted, measured, .. } = *compared;
    let id = model.anatomy().coordinate(movement, Some(side))?.0.index();
    let (found, truth) = (&predicted.forces.generalized[id], &measured.forces.generalized[id]);
    let pairs: Vec<(f64, f64)> = frames.iter().map(|&i| (found[i], truth[i])).collect();
    if pairs.is_empty() {
        return None;
    }
    let agreement = agreement(&pairs);
    Some(MomentAgreement {
        quantity: model.force_names()[id].clone(),
        side,
        samples: agreement.samples,
        rmse_nm: agreement.rmse,
        rmse_nm_kg: agreement.rmse / measured.mass.kg,
        r: agreement.r,
    })
}

/// Frames in which all forces on a leg were measured.
fn measured_frames(
    compared: &ComparedAnalyses<'_>,
    side: Side,
    coverage: &PlateCoverage,
    truth: Option<&BodyForces>,
) -> Vec<usize> {
    let grid = compared.predicted.trajectory.grid();
    let mut known = vec![false; grid.frames];
    if let Some([from_s, to_s]) = coverage.window {
        let (first, count) = grid.inside(Window { from_s: Some(from_s), to_s: Some(to_s) });
        known[first..first + count].fill(true);
    }
    if let Some(truth) = truth {
        let up = compared.model.up();
        let frames = stances(coverage, side, grid).into_iter().flat_map(|stance| loaded(grid, truth, up, stance));
        frames.for_each(|i| known[i] = true);
    }
    (0..known.len()).filter(|&i| known[i]).collect()
}

/// Frames of a stance in which the plate is loaded.
fn loaded(grid: TimeGrid, truth: &BodyForces, up: Vec3, [from_s, to_s]: [f64; 2]) -> Vec<usize> {
    let (first, count) = grid.inside(Window { from_s: Some(from_s), to_s: Some(to_s) });
    (first..first + count).filter(|&i| truth.force[i].dot(&up) > CENTER_OF_PRESSURE_LOAD_N).collect()
}

/// Both sources of the forces on one foot.
struct ComparedFoot<'a> {
    grid: TimeGrid,
    up: Vec3,
    found: &'a BodyForces,
    truth: &'a BodyForces,
    deviation: Option<&'a FootDeviation>,
}

impl ComparedFoot<'_> {
    /// The loaded frames of a stance, along its axes.
    fn samples(&self, [span_s, detected_s]: [[f64; 2]; 2], [forward, right]: [Vec3; 2]) -> Vec<ComparedSample> {
        let axes = [self.up, forward, right];
        let share = |time: f64, [from, to]: [f64; 2]| (time - from) / (to - from);
        let across = |v: Vec3| axes.map(|axis| v.component_mul(&axis).norm());
        let sample = |i: usize| {
            let off = self.found.center_of_pressure[i] - self.truth.center_of_pressure[i];
            let [_, along, beside] = axes.map(|axis| off.dot(&axis));
            let [_, center_along, center_beside] = self.deviation.map_or([0.0; 3], |d| across(d.center[i]));
            ComparedSample {
                phase: share(self.grid.time(i), span_s),
                detected_phase: share(self.grid.time(i), detected_s).clamp(0.0, 1.0),
                predicted: axes.map(|axis| self.found.force[i].dot(&axis)),
                measured: axes.map(|axis| self.truth.force[i].dot(&axis)),
                deviation: self.deviation.map_or([0.0; 3], |d| across(d.force[i])),
                center_off: [along, beside],
                center_deviation: [center_along, center_beside],
                free_moment_off: (self.found.free_moment[i] - self.truth.free_moment[i]).dot(&self.up),
                free_moment_deviation: self.deviation.map_or(0.0, |d| d.free_moment[i]),
            }
        };
        loaded(self.grid, self.truth, self.up, span_s).into_iter().map(sample).collect()
    }
}

/// Agreement of a foot over its stances; `None` without a loaded frame.
fn foot(side: Side, weight: f64, stances: &[&ComparedStance]) -> Option<FootAgreement> {
    let samples: Vec<&ComparedSample> = stances.iter().flat_map(|stance| &stance.samples).collect();
    if samples.is_empty() {
        return None;
    }
    let [vertical, fore_aft, lateral] = [0, 1, 2].map(|axis| force(&samples, axis, weight));
    Some(FootAgreement {
        side,
        stances_s: stances.iter().map(|stance| stance.span_s).collect(),
        samples: samples.len(),
        vertical,
        fore_aft,
        lateral,
        center_of_pressure: center(&samples, weight),
    })
}

fn force(samples: &[&ComparedSample], axis: usize, weight: f64) -> ForceAgreement {
    let pairs: Vec<(f64, f64)> = samples.iter().map(|s| (s.predicted[axis], s.measured[axis])).collect();
    let agreement = agreement(&pairs);
    let half_width = |s: &&ComparedSample| BAND_90 * s.deviation[axis];
    let inside = samples.iter().zip(&pairs).filter(|(s, (a, b))| (a - b).abs() <= half_width(s)).count();
    let n = samples.len() as f64;
    ForceAgreement {
        rmse_bw: agreement.rmse / weight,
        rrmse: agreement.rrmse,
        r: agreement.r,
        band: BandAgreement {
            holds: inside as f64 / n,
            half_width_over_rmse: samples.iter().map(half_width).sum::<f64>() / n / agreement.rmse,
        },
    }
}

fn center(samples: &[&ComparedSample], weight: f64) -> CenterAgreement {
    let load = |s: &ComparedSample| s.measured[0];
    let measured = || samples.iter().filter(|s| load(s) > CENTER_LOAD_BW * weight);
    let known: Vec<_> = measured().filter(|s| !s.center_off[0].is_nan()).collect();
    let loads: f64 = known.iter().map(|s| load(s)).sum();
    let root_mm = |axis: usize, of: &dyn Fn(&ComparedSample) -> f64, sum: f64| {
        1e3 * (known.iter().map(|s| s.center_off[axis].powi(2) * of(s)).sum::<f64>() / sum).sqrt()
    };
    let count = known.len();
    CenterAgreement {
        samples: count,
        missing: measured().count() - count,
        fore_aft_mm: root_mm(0, &|_| 1.0, count as f64),
        lateral_mm: root_mm(1, &|_| 1.0, count as f64),
        fore_aft_weighted_mm: root_mm(0, &load, loads),
        lateral_weighted_mm: root_mm(1, &load, loads),
    }
}
