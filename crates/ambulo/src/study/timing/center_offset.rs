//! The centre of pressure that the motion needs, against the measured one, along a foot that carries the body alone.
//!
//! The ground acts on one foot, and about the measured centre of pressure the motion needs the horizontal moment M and
//! the vertical force F. It needs its centre of pressure at
//!
//!   d = (up × M) / F    from the measured one,
//!
//! whatever gait the person has. Judged is the median of the component along the foot, over all times in which a foot
//! carries the body alone on one force plate, and how far two plates differ in it. 40 mm of either are more than clean
//! recordings have; a plate that is 60 mm forward or backward is named for all seven people of the test. A plate that
//! then seems to be under both feet is left out before, and cannot be judged.
//!
//! Pinned by: tests/study_timing.rs

use super::NeededWrenches;
use crate::analysis::Analysis;
use crate::findings::{Code, Findings};
use crate::ground::feet;
use crate::ground::stances::{Stance, StanceSource};
use crate::kinematics::each_body_motion;
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model, Side};
use crate::numerics::{extremes, median};

/// Clean data have no larger distance, and no larger difference of two plates [m].
pub(in crate::study) const MOST_OFFSET_M: f64 = 0.04;
/// A foot carries the body alone from this share of the weight on, and from this share of all loads on.
const LOADED_BW: f64 = 0.6;
const LOADED_SHARE: f64 = 0.95;
/// The vertical force that the motion needs is the measured one to this share of the weight; else it is not known where
/// it is needed.
const BALANCE: f64 = 0.1;
/// Smallest share of the frames in which it is.
const BALANCED_SHARE: f64 = 0.6;
/// Shortest time on a plate [s].
const SHORTEST_S: f64 = 0.15;

/// Distances of the measured centres of pressure from where the motion needs them.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::study) struct CenterOffset {
    /// Of each plate, or each foot of a table: its name, and how far the measured ones are ahead along the foot [m].
    ahead_m: Vec<(String, f64)>,
}

/// Frames of a plate, or of a load of a table.
struct Place<'a> {
    side: Side,
    source: &'a StanceSource,
    /// How far the measured centre is ahead [m]; `None` where the vertical forces differ.
    ahead_m: Vec<Option<f64>>,
}

impl CenterOffset {
    /// `None` if nowhere one foot carries the body alone for long.
    pub(in crate::study) fn of(
        model: &Model,
        analysis: &Analysis,
        soles: &BySide<Option<Sole>>,
        stances: &[Stance],
    ) -> Option<CenterOffset> {
        let fewest = SHORTEST_S / analysis.trajectory.grid().step_s;
        let judged = places(model, analysis, soles, stances)?.into_iter().filter_map(|place| {
            let balanced = place.ahead_m.iter().flatten().count() as f64;
            let is_known = balanced >= fewest && balanced >= BALANCED_SHARE * place.ahead_m.len() as f64;
            let name = match place.source {
                StanceSource::Table => format!("under the {} foot", place.side),
                source => format!("on {source}"),
            };
            Some((name, median(place.ahead_m.into_iter().flatten()).filter(|_| is_known)?))
        });
        let ahead_m: Vec<(String, f64)> = judged.collect();
        (!ahead_m.is_empty()).then_some(CenterOffset { ahead_m })
    }

    /// The largest distance, or the largest difference of two plates [m].
    pub(in crate::study) fn distance_m(&self) -> f64 {
        let ahead_m: Vec<f64> = self.ahead_m.iter().map(|(_, ahead_m)| *ahead_m).collect();
        let (low, high) = extremes(&ahead_m);
        (high - low).max(high).max(-low)
    }

    /// Reports an offset that clean data do not have.
    pub(in crate::study) fn report(&self, findings: &mut Findings) {
        if self.distance_m() > MOST_OFFSET_M {
            findings.report(Code::PlatesMisplaced, self.message());
        }
    }

    /// How far the centre of pressure is from where the motion needs it, in a sentence.
    pub(in crate::study) fn message(&self) -> String {
        let one = |(name, ahead_m): &(String, f64)| {
            let way = if *ahead_m > 0.0 { "ahead" } else { "behind" };
            format!("{:.0} mm {way} {name}", 1e3 * ahead_m.abs())
        };
        format!(
            "while one foot carries the body alone, the measured centre of pressure is not where the motion needs it: \
             {} (at most {:.0} mm, also between two): a force plate is not where the file states, or its moments are \
             wrong",
            self.ahead_m.iter().map(one).collect::<Vec<_>>().join(", "),
            1e3 * MOST_OFFSET_M
        )
    }
}

/// The frames in which a foot carries the body alone, by plate; `None` of a body with several joints to the ground.
fn places<'a>(
    model: &Model,
    analysis: &Analysis,
    soles: &BySide<Option<Sole>>,
    stances: &'a [Stance],
) -> Option<Vec<Place<'a>>> {
    let needed = NeededWrenches::of(model, analysis)?;
    let forces = feet(model, &analysis.ground);
    let (up, weight_n) = (model.up(), model.mass() * model.gravity().norm());
    let mut places: Vec<Place<'a>> = Vec::new();
    each_body_motion(model, &analysis.trajectory, |i, bodies| {
        let frame = &needed.frames[i];
        let mut standing = stances.iter().filter(|s| (s.start_s..=s.end_s).contains(&frame.time_s));
        let (Some(stance), None) = (standing.next(), standing.next()) else { return };
        let carried_n = |side: Side| {
            let of_side = forces.iter().filter(|(other, _)| *other == side);
            of_side.map(|(_, foot)| foot.force[i].dot(&up)).sum::<f64>()
        };
        let (own_n, other_n) = (carried_n(stance.side), carried_n(stance.side.other()));
        let is_alone = own_n > LOADED_BW * weight_n && own_n > LOADED_SHARE * (own_n + other_n);
        let Some(sole) = soles[stance.side].as_ref().filter(|_| is_alone && stance.source.is_measured()) else {
            return;
        };
        let Some((_, foot)) = forces.iter().find(|(side, _)| *side == stance.side) else { return };
        let [rear, _, tip] = sole.points.map(|point| bodies[point.body.index()].pose.place(point.place));
        let level = (tip - rear) - up * up.dot(&(tip - rear));
        let about = frame.whole.about(-foot.center_of_pressure[i]);
        let needed_n = about.force.dot(&up);
        let behind_m = level.try_normalize(1e-6).map(|along| up.cross(&about.moment).dot(&along) / needed_n);
        let is_balanced = (own_n + other_n - needed_n).abs() < BALANCE * weight_n;
        let ahead_m = behind_m.map(|behind_m| -behind_m).filter(|ahead_m| is_balanced && ahead_m.is_finite());
        let is_table = stance.source == StanceSource::Table;
        let is_same = |place: &&mut Place| *place.source == stance.source && (place.side == stance.side || !is_table);
        match places.iter_mut().find(is_same) {
            Some(place) => place.ahead_m.push(ahead_m),
            None => places.push(Place { side: stance.side, source: &stance.source, ahead_m: vec![ahead_m] }),
        }
    });
    Some(places)
}
