//! Measured quantities that replace their estimates in a prediction, so that each source of error can be evaluated
//! alone.

use super::PredictError;
use crate::ground::footfalls::Footfalls;
use crate::model::{BySide, Side};
use crate::spatial::{Vec3, Wrench};

/// Quantities that are given and not estimated. Series have one entry per frame of the motion; not a number where
/// unknown.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Prescribed {
    /// Stances of the feet.
    pub footfalls: Option<Footfalls>,
    /// Total ground force [N] and its moment about the world's origin [N.m].
    pub total: Option<Vec<Wrench>>,
    /// The right foot's share of the vertical force, 0 to 1.
    pub right_share: Option<Vec<f64>>,
    /// Centres of pressure of the right and the left foot [m].
    pub centers: Option<BySide<Vec<Vec3>>>,
}

impl Prescribed {
    /// Checks that every series is as long as the motion, and that the stances of each foot are in order of time.
    pub(super) fn check(&self, frames: usize) -> Result<(), PredictError> {
        let centers = |side: Side| self.centers.as_ref().map(|c| c[side].len());
        let series = [
            ("total wrench", self.total.as_ref().map(Vec::len)),
            ("share of the right foot", self.right_share.as_ref().map(Vec::len)),
            ("centre of pressure of the right foot", centers(Side::Right)),
            ("centre of pressure of the left foot", centers(Side::Left)),
        ];
        for side in Side::BOTH {
            let falls = self.footfalls.iter().flat_map(|footfalls| footfalls.of(side));
            let mut free_s = f64::NEG_INFINITY;
            for fall in falls {
                let (strike, off) = (fall.strike_s.unwrap_or(free_s), fall.off_s.unwrap_or(f64::INFINITY));
                if !(strike >= free_s && off >= strike) {
                    let time_s = fall.strike_s.or(fall.off_s).unwrap_or(free_s);
                    return Err(PredictError::Footfalls { side, time_s });
                }
                free_s = off;
            }
        }
        match series.into_iter().find_map(|(what, length)| Some((what, length.filter(|found| *found != frames)?))) {
            Some((what, found)) => Err(PredictError::Shape { what, found, expected: frames }),
            None => Ok(()),
        }
    }

    /// The total wrench: the given one where it is a number, otherwise the computed one.
    pub(super) fn total(&self, computed: Vec<Wrench>) -> Vec<Wrench> {
        let Some(given) = &self.total else { return computed };
        given.iter().zip(computed).map(|(given, computed)| if is_number(given) { *given } else { computed }).collect()
    }

    /// The given total wrench in a frame.
    pub(super) fn total_at(&self, frame: usize) -> Option<Wrench> {
        self.total.as_ref().map(|total| total[frame]).filter(is_number)
    }

    /// The given share of the right foot in the vertical force in a frame.
    pub(super) fn right_share_at(&self, frame: usize) -> Option<f64> {
        self.right_share.as_ref().map(|share| share[frame]).filter(|share| share.is_finite())
    }

    /// The given centre of pressure of a foot in a frame [m].
    pub(super) fn center_at(&self, side: Side, frame: usize) -> Option<Vec3> {
        self.centers.as_ref().map(|c| c[side][frame]).filter(|center| center.iter().all(|x| x.is_finite()))
    }
}

fn is_number(load: &Wrench) -> bool {
    load.force.iter().chain(load.moment.iter()).all(|x| x.is_finite())
}
