//! The external knee adduction moment over the whole stances of an outcome.
//!
//! It is the internal abduction moment of the knee's reaction per body mass. If a stance of a leg was measured, only
//! measured stances of this leg count, otherwise those with predicted or simulated forces; [`LegStances::source`] says
//! which. A stance at the edge of the motion is not whole, nor is one in which a plate felt the foot for a part of the
//! time.
//!
//! Pinned by: tests/joint_moments.rs, tests/stance_loads.rs

use super::outcome::Outcome;
use crate::analysis::{Analysis, Cycle, Event, EventKind, over_cycle_of, stance_load};
use crate::findings::word;
use crate::ground::stances::{Stance, StanceSource};
use crate::ground::{BodyForces, CENTER_OF_PRESSURE_LOAD_N};
use crate::model::anatomy::Movement;
use crate::model::{BySide, Model, Side};
use crate::motion::TimeGrid;
use crate::spatial::Vec3;
use serde::{Deserialize, Serialize};

/// Share of a stance at either end in which a foot may still be unloaded.
const ENDS: f64 = 0.1;

/// Where the loads of the stances of a leg come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum LoadSource {
    /// Force plates or a table of forces.
    Measured,
    /// The motion.
    Predicted,
    /// A simulation of the motion.
    Simulated,
}

impl LoadSource {
    /// The name in files and tables.
    #[must_use]
    pub fn word(self) -> &'static str {
        word(&self)
    }
}

/// A quantity over the stances of one leg.
#[derive(Debug, Clone, PartialEq)]
pub struct LegStances {
    /// Where the loads of all these stances come from.
    pub source: LoadSource,
    /// First peak, second peak and impulse of each whole stance: of the knee adduction moment [N.m/kg, N.m/kg,
    /// N.m.s/kg], of the load of a joint [body weights, body weights, body weights x s].
    pub stances: Vec<[f64; 3]>,
}

impl Outcome {
    /// First peak, second peak and impulse of the external knee adduction moment, for each whole stance of each leg
    /// ([`stance_load`]), all of one source. Without stances where the moment is not known: legs that move in the
    /// sagittal plane only, and joints down to the knee that are not measured.
    #[must_use]
    pub fn knee_adduction(&self) -> BySide<LegStances> {
        let (analysis, model) = (self.complete(), &self.body);
        let moments = analysis.joint_moments(model);
        let movement = Movement::KneeAdduction;
        BySide::from_fn(|side| {
            let is_unknown = model.anatomy().is_any_above(&self.not_measured, movement, side);
            self.over_stances(side, |frame| {
                let moment = moments.at(movement, side, frame).filter(|_| !is_unknown);
                moment.map_or(f64::NAN, |moment| -moment / analysis.mass.kg)
            })
        })
    }

    /// First peak, second peak and impulse of a quantity over each whole stance of a leg; `value` is the quantity at a
    /// frame of [`Outcome::complete`], not a number where it is not known.
    pub(super) fn over_stances(&self, side: Side, value: impl Fn(usize) -> f64) -> LegStances {
        let analysis = self.complete();
        let (source, spans) = self.whole_stances(analysis, side);
        let of_stance = |[start_s, end_s]: [f64; 2]| {
            let stance = Cycle { side, number: 1, start_s, end_s, foot_off_s: None };
            stance_load(&over_cycle_of(analysis.trajectory.grid(), &value, &stance), end_s - start_s)
        };
        LegStances { source, stances: spans.into_iter().filter_map(of_stance).collect() }
    }

    /// Foot strike and foot off of the stances of a leg that count [s], and the source of their loads.
    fn whole_stances(&self, analysis: &Analysis, side: Side) -> (LoadSource, Vec<[f64; 2]>) {
        let is_whole = |span: &[f64; 2]| {
            is_inside(*span, analysis.trajectory.grid()) && is_loaded(&self.body, analysis, side, *span)
        };
        if self.stances.is_empty() {
            return (LoadSource::Simulated, contacts(analysis, side).into_iter().filter(is_whole).collect());
        }
        let of_source = |is_meant: fn(&StanceSource) -> bool| -> Vec<[f64; 2]> {
            let own = self.stances.iter().filter(|stance| stance.side == side && is_meant(&stance.source));
            own.map(|Stance { start_s, end_s, .. }| [*start_s, *end_s]).filter(is_whole).collect()
        };
        let measured = of_source(StanceSource::is_measured);
        if measured.is_empty() {
            return (LoadSource::Predicted, of_source(|source| *source == StanceSource::Predicted));
        }
        (LoadSource::Measured, measured)
    }
}

/// From each foot strike of a foot to the next foot off [s].
fn contacts(analysis: &Analysis, side: Side) -> Vec<[f64; 2]> {
    let own: Vec<_> = analysis.events.iter().filter(|event| event.side == side).collect();
    let is_contact = |pair: &&[&Event]| pair[0].kind == EventKind::Strike && pair[1].kind == EventKind::Off;
    own.windows(2).filter(is_contact).map(|pair| [pair[0].time_s, pair[1].time_s]).collect()
}

/// Whether a stance begins and ends inside the motion, not at its edge.
fn is_inside([start_s, end_s]: [f64; 2], grid: TimeGrid) -> bool {
    start_s > grid.start_s + 0.5 * grid.step_s && end_s < grid.end_s() - 0.5 * grid.step_s
}

/// Whether the foot carries a load in every frame of a stance but at its ends.
fn is_loaded(model: &Model, analysis: &Analysis, side: Side, [start_s, end_s]: [f64; 2]) -> bool {
    let (grid, up, ends_s) = (analysis.trajectory.grid(), model.up(), ENDS * (end_s - start_s));
    let is_own = |part: &&BodyForces| model.anatomy().body_side(part.body) == Some(side);
    let parts: Vec<&BodyForces> = analysis.ground.bodies.iter().filter(is_own).collect();
    let carries =
        |frame: usize| parts.iter().map(|part| part.force[frame]).sum::<Vec3>().dot(&up) > CENTER_OF_PRESSURE_LOAD_N;
    // The stance is inside the motion.
    let frame = |time_s: f64| (time_s - grid.start_s) / grid.step_s;
    let (first, last) = (frame(start_s + ends_s).ceil() as usize, frame(end_s - ends_s).floor() as usize);
    (first..=last.min(grid.frames - 1)).all(carries)
}
