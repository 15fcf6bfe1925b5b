//! The stances of both feet with the source of their loads, and ground forces that are complete.
//!
//! A laboratory has a few force plates, and the feet stand alongside them as well. A stance was **measured** if the
//! load of its foot was measured for at least half of it. A load that a plate measured in part (a foot
//! over its edge) counts if it carries the body alone: in single support the vertical force is then what Newton's law
//! requires,
//!
//!   Σ F ≥ c Σ m (a + g)        c = 0.85, over the frames in which the other foot is in the air
//!
//! An unmeasured stance in which the measured loads carry the whole body is no stance: the foot
//! touches the floor without a load. The others have **missing** loads; `completed` takes them from a prediction.
//!
//! | code        | symbol | unit | meaning                                                     |
//! | `required`  | m(a+g) | N    | vertical force that the motion requires, one entry per frame |
//! | `measured`  | F      | N    | measured vertical force on a foot, one entry per frame       |
//!
//! Pinned by: tests/stance_loads.rs

use super::footfalls::{Footfall, Footfalls};
use super::measured::{BodyForces, GroundForces};
use super::plates::{ContactQuality, FeetOnPlates, PlateContact};
use super::predict::Prediction;
use crate::model::{BySide, Model, Side};
use crate::motion::{TimeGrid, Window};
use crate::numerics::Order;
use std::fmt;
use std::ops::Range;

/// A stance whose foot carried a measured load for a smaller share of its time was not measured.
pub(crate) const MEASURED_SHARE: f64 = 0.5;
/// A load that may be a part of the foot's is all of it from this share of the required force on: the error of the
/// vertical force that a motion requires is some 5 % in single support (docs/measured/VALIDATION.md).
const CARRIED_SHARE: f64 = 0.85;
/// A foot carries less than this share of the weight if it only touches the floor: twice that error.
const TOUCH_SHARE: f64 = 0.1;
/// A predicted load begins and ends within this time outside of its stance [s].
const RAMP_S: f64 = 0.03;
/// Shorter times have no separate residual [s].
const SHORTEST_WINDOW_S: f64 = 0.05;

/// A stance of one foot.
#[derive(Debug, Clone, PartialEq)]
pub struct Stance {
    /// Side of the foot.
    pub side: Side,
    /// Foot strike, or the first instant of a motion that begins during the stance [s].
    pub start_s: f64,
    /// Foot off, or the last instant of a motion that ends during the stance [s].
    pub end_s: f64,
    /// Where its load comes from.
    pub source: StanceSource,
}

/// Where the load of a stance comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum StanceSource {
    /// Force plates, by index.
    Plates(Vec<usize>),
    /// Forces that were given apart from plates.
    Table,
    /// The motion.
    Predicted,
    /// No forces: the stance was not measured, and predictions were never validated in this activity, or are
    /// impossible.
    Unknown,
}

impl StanceSource {
    /// Whether the load was measured.
    #[must_use]
    pub fn is_measured(&self) -> bool {
        matches!(self, StanceSource::Plates(_) | StanceSource::Table)
    }

    /// As a number in tables: 0 measured, 1 predicted, 2 unknown.
    #[must_use]
    pub fn number(&self) -> f64 {
        match self {
            StanceSource::Plates(_) | StanceSource::Table => 0.0,
            StanceSource::Predicted => 1.0,
            StanceSource::Unknown => 2.0,
        }
    }
}

impl fmt::Display for StanceSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            StanceSource::Plates(plates) => {
                let numbers: Vec<String> = plates.iter().map(|plate| (plate + 1).to_string()).collect();
                write!(f, "plate {}", numbers.join(" + "))
            }
            StanceSource::Table => f.write_str("table"),
            StanceSource::Predicted => f.write_str("predicted"),
            StanceSource::Unknown => f.write_str("unknown"),
        }
    }
}

impl Stance {
    /// A stance cut to the time of the motion; `None` if it is outside.
    pub(crate) fn within(
        side: Side,
        [start_s, end_s]: [f64; 2],
        source: StanceSource,
        grid: TimeGrid,
    ) -> Option<Stance> {
        let (start_s, end_s) = (start_s.max(grid.start_s), end_s.min(grid.end_s()));
        (end_s > start_s).then_some(Stance { side, start_s, end_s, source })
    }
}

/// Of the time in which a leg was loaded, the share in which its load was measured; `None` if it was never loaded.
pub(crate) fn measured_share(stances: &[Stance], side: Side) -> Option<f64> {
    let loaded_s = |of: fn(&StanceSource) -> bool| -> f64 {
        let own = stances.iter().filter(|stance| stance.side == side && of(&stance.source));
        own.map(|stance| stance.end_s - stance.start_s).fold(0.0, |sum, duration_s| sum + duration_s)
    };
    let all_s = loaded_s(|_| true);
    (all_s > 0.0).then(|| loaded_s(StanceSource::is_measured) / all_s)
}

/// A time in which a measured load acts on a foot.
#[derive(Debug, Clone)]
pub(crate) struct LoadedTime {
    pub(crate) side: Side,
    pub(crate) span: [f64; 2],
    pub(crate) source: StanceSource,
    /// Whether it may be a part of the foot's load.
    pub(crate) may_be_partial: bool,
}

impl LoadedTime {
    /// The loads of force plates with one foot each.
    pub(crate) fn on_plates(on_plates: &FeetOnPlates) -> Vec<LoadedTime> {
        let of_contact = |contact: &PlateContact| {
            let is_own =
                matches!(contact.quality, ContactQuality::Clean | ContactQuality::Shared | ContactQuality::Partial);
            Some(LoadedTime {
                side: contact.side.filter(|_| is_own)?,
                span: [contact.start_s, contact.end_s],
                source: StanceSource::Plates(vec![contact.plate]),
                may_be_partial: contact.quality == ContactQuality::Partial,
            })
        };
        merged(on_plates.contacts.iter().filter_map(of_contact).collect())
    }
}

/// Whole loads of a foot that follow each other on several plates are one.
fn merged(mut times: Vec<LoadedTime>) -> Vec<LoadedTime> {
    times.sort_by_numbers(|time| [time.side.rank(), time.span[0]]);
    let mut out: Vec<LoadedTime> = Vec::new();
    for time in times {
        let last = out.last_mut().filter(|last| {
            last.side == time.side && time.span[0] <= last.span[1] && last.may_be_partial == time.may_be_partial
        });
        let Some(last) = last else {
            out.push(time);
            continue;
        };
        last.span[1] = last.span[1].max(time.span[1]);
        if let (StanceSource::Plates(all), StanceSource::Plates(more)) = (&mut last.source, time.source) {
            all.extend(more.into_iter().filter(|plate| !all.contains(plate)).collect::<Vec<_>>());
        }
    }
    out
}

/// Vertical forces at the frames of a motion [N].
pub(crate) struct VerticalForces {
    pub(crate) required: Vec<f64>,
    pub(crate) measured: BySide<Vec<f64>>,
    /// Body weight [N].
    pub(crate) weight_n: f64,
}

/// A motion with loads that were measured at some times.
pub(crate) struct MeasuredMotion<'a> {
    pub(crate) grid: TimeGrid,
    pub(crate) footfalls: &'a Footfalls,
    /// Measured loads, in order of time for each foot.
    pub(crate) loaded: Vec<LoadedTime>,
}

impl MeasuredMotion<'_> {
    /// The measured stances, and the times of the others.
    pub(crate) fn stances(&self, forces: impl FnOnce() -> VerticalForces) -> (Vec<Stance>, Vec<Missing>) {
        let needs_forces = self.loaded.iter().any(|time| time.may_be_partial)
            || self.falls().any(|(side, span)| !is_covered(side, span, self.loaded.iter()));
        let forces = needs_forces.then(forces);
        let is_whole = |time: &&LoadedTime| {
            !time.may_be_partial || forces.as_ref().is_some_and(|forces| self.carries(time, forces))
        };
        let (whole, parts): (Vec<&LoadedTime>, Vec<&LoadedTime>) = self.loaded.iter().partition(is_whole);
        let missing = self.falls().filter(|(side, span)| !is_covered(*side, *span, whole.iter().copied()));
        let missing = missing.filter_map(|(side, span)| {
            let overlaps = |part: &&&LoadedTime| part.side == side && overlap_s(part.span, span) > 0.0;
            let of_parts = parts.iter().filter(overlaps).map(|part| part.span);
            let lacks = forces.as_ref().is_some_and(|forces| self.lacks(span, forces));
            let union = of_parts.fold(span, |[a, b], part| [a.min(part[0]), b.max(part[1])]);
            (lacks || union[0] < span[0] || union[1] > span[1]).then_some(Missing { side, span: union })
        });
        let missing = missing.collect();
        let measured =
            whole.iter().filter_map(|time| Stance::within(time.side, time.span, time.source.clone(), self.grid));
        (measured.collect(), missing)
    }

    /// The stances that the motion shows, inside of it.
    fn falls(&self) -> impl Iterator<Item = (Side, [f64; 2])> {
        let (first, last) = (self.grid.start_s, self.grid.end_s());
        let span =
            move |fall: &Footfall| [fall.strike_s.unwrap_or(first).max(first), fall.off_s.unwrap_or(last).min(last)];
        let falls = self.footfalls.falls.iter().map(move |fall| (fall.side, span(fall)));
        falls.filter(|(_, [start_s, end_s])| end_s > start_s)
    }

    /// Whether a load carries the body alone where the other foot is in the air.
    fn carries(&self, time: &LoadedTime, forces: &VerticalForces) -> bool {
        let is_alone =
            |at_s: f64| !self.falls().any(|(side, [from, to])| side != time.side && (from..=to).contains(&at_s));
        let alone: Vec<usize> = self.frames(time.span).filter(|frame| is_alone(self.grid.time(*frame))).collect();
        let sum = |values: &[f64]| alone.iter().map(|frame| values[*frame]).sum::<f64>();
        !alone.is_empty() && sum(&forces.measured[time.side]) >= CARRIED_SHARE * sum(&forces.required)
    }

    /// Whether the measured loads do not carry the body.
    fn lacks(&self, span: [f64; 2], forces: &VerticalForces) -> bool {
        let frames: Vec<usize> = self.frames(span).collect();
        let lacking = |frame: &usize| {
            forces.required[*frame] - forces.measured.values().map(|of_foot| of_foot[*frame]).sum::<f64>()
        };
        let mean_n = frames.iter().map(lacking).sum::<f64>() / frames.len().max(1) as f64;
        mean_n > TOUCH_SHARE * forces.weight_n
    }

    fn frames(&self, [from, to]: [f64; 2]) -> Range<usize> {
        let (first, count) = self.grid.inside(Window { from_s: Some(from), to_s: Some(to) });
        first..first + count
    }

    /// The longest time without a missing load, where the residual can be judged; an empty one if there is none.
    pub(crate) fn complete_window(&self, missing: &[Missing]) -> Window {
        let mut free = vec![[self.grid.start_s, self.grid.end_s()]];
        for Missing { span: [from, to], .. } in missing {
            let parts = |[a, b]: [f64; 2]| [[a, b.min(*from)], [a.max(*to), b]].into_iter().filter(|[a, b]| b > a);
            free = free.into_iter().flat_map(parts).collect();
        }
        let longest = free.into_iter().max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
        let [from, to] =
            longest.filter(|[a, b]| b - a >= SHORTEST_WINDOW_S).unwrap_or([f64::INFINITY, f64::NEG_INFINITY]);
        Window { from_s: Some(from), to_s: Some(to) }
    }
}

/// A time in which a foot carries a load that was not measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Missing {
    pub(crate) side: Side,
    /// Start and end [s].
    pub(crate) span: [f64; 2],
}

fn overlap_s(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[1].min(b[1]) - a[0].max(b[0])).max(0.0)
}

fn is_covered<'a>(side: Side, span: [f64; 2], loaded: impl Iterator<Item = &'a LoadedTime>) -> bool {
    let covered: f64 = loaded.filter(|time| time.side == side).map(|time| overlap_s(time.span, span)).sum();
    covered >= MEASURED_SHARE * (span[1] - span[0])
}

/// Measured ground forces with predicted ones where loads are missing.
///
/// In double support with a measured foot, the rest of what the motion requires would be the other foot's; but then one
/// foot gets the error of the total. Over 21 stances of eight subjects in four laboratories whose plate was left out,
/// the moments differ from the measured ones by 0.11 (ankle), 0.12 (knee) and 0.17 (hip) N.m/kg (rms) with the
/// prediction. They differ by 0.11, 0.14 and 0.23 with the rest of the forces, and by 0.23, 0.19 and 0.19 with the rest
/// of the wrench.
pub(crate) fn completed(
    model: &Model,
    grid: TimeGrid,
    measured: &GroundForces,
    prediction: &Prediction,
    missing: &[Missing],
) -> GroundForces {
    let mut bodies = measured.bodies.to_vec();
    for side in Side::BOTH {
        let spans: Vec<[f64; 2]> = missing.iter().filter(|time| time.side == side).map(|time| time.span).collect();
        if spans.is_empty() {
            continue;
        }
        let (predicted, _) = prediction.foot(side);
        let of_prediction: Vec<f64> = (0..grid.frames).map(|frame| weight(&spans, grid.time(frame))).collect();
        let of_measurement: Vec<f64> = of_prediction.iter().map(|weight| 1.0 - weight).collect();
        let own = bodies.iter_mut().filter(|body| model.anatomy().body_side(body.body) == Some(side));
        own.for_each(|body| *body = BodyForces::weighted_sum(&[(body, &of_measurement)], model.up()));
        let added = (predicted, &*of_prediction);
        match bodies.iter_mut().find(|body| body.body == predicted.body) {
            Some(body) => *body = BodyForces::weighted_sum(&[(body, &vec![1.0; grid.frames]), added], model.up()),
            None => bodies.push(BodyForces::weighted_sum(&[added], model.up())),
        }
    }
    GroundForces { bodies: bodies.into() }
}

/// 1 in the stances, 0 from [`RAMP_S`] outside of them on.
fn weight(spans: &[[f64; 2]], time_s: f64) -> f64 {
    let outside = spans.iter().map(|[from, to]| (from - time_s).max(time_s - to).max(0.0));
    (1.0 - outside.fold(f64::INFINITY, f64::min) / RAMP_S).max(0.0)
}
