//! Recognises the unit of measured forces from the body weight that follows from single steps.
//!
//! The shape of a step does not depend on the unit: the vertical force rises steeply from zero, stays high and falls
//! again. The mean force over a stance of duration t is m g (T / t), with the time T from one step to the next, because
//! the mean over all steps equals the weight (Newton). In walking t = 1.2 T (a stance takes 60 % of the stride). In
//! running there are 2.8 steps per second, and t is shorter than T. A single step therefore gives the weight to about
//! 15 %, which is enough to distinguish newtons, kilonewtons and body weights.
//!
//! Pinned by: tests/motion_body_weight.rs

use crate::numerics::{median, quantiles};

/// Range of body weights, from a small child to the heaviest person [N].
const PERSON_N: [f64; 2] = [50.0, 3000.0];
/// Without a known mass, weights in this range are taken as newtons [N].
const NEWTONS: [f64; 2] = [20.0, 12_000.0];
/// Largest ratio of the weight from a step to the known weight for the right unit.
const SAME_WEIGHT: f64 = 2.0;
/// Kilonewtons and body weights are the same for a person of 102 kg; within this factor of each other the usual unit,
/// kilonewtons, is taken.
const SAME_UNIT: f64 = 1.05;
/// Shortest and longest step [s].
const STEP_S: [f64; 2] = [0.12, 1.6];
/// A step begins and ends at this share of the largest force.
const LOADED: f64 = 0.1;
/// In the middle of a step the force is at least this share of its largest value: the dip of a walk is 0.6 to 0.9.
const HELD: f64 = 0.3;
/// Stance over the time between two steps in walking.
const WALK_STANCE: f64 = 1.2;
/// Time between two steps in running [s], 2.8 a second, and the longest stance in running [s].
const RUN_STEP_S: f64 = 0.36;
const RUN_STANCE_S: f64 = 0.4;

/// Units of ground forces in files that state newtons, or no unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ForceUnit {
    /// Thousands of newtons.
    Kilonewtons,
    /// The weight of the person.
    BodyWeights,
    /// Thousandths of a newton.
    Millinewtons,
}

impl ForceUnit {
    /// The unit of the forces, or `None` if they are newtons or no unit gives the weight of a person. `stepped` is the
    /// [`stepped_weight`] in the unit of the file, `weight_n` the weight of the person, if it is known [N].
    #[must_use]
    pub fn of_steps(stepped: f64, weight_n: Option<f64>) -> Option<ForceUnit> {
        let is_person = match weight_n {
            Some(weight_n) => off(stepped, weight_n) < SAME_WEIGHT,
            None => false,
        };
        if is_person || (NEWTONS[0]..=NEWTONS[1]).contains(&stepped) {
            return None;
        }
        let Some(weight_n) = weight_n else {
            let is_unit = |unit: &&ForceUnit| {
                unit.newtons(None).is_some_and(|n| (PERSON_N[0]..=PERSON_N[1]).contains(&(n * stepped)))
            };
            return [ForceUnit::Kilonewtons, ForceUnit::Millinewtons].iter().find(is_unit).copied();
        };
        let off_of = |unit: ForceUnit| unit.newtons(Some(weight_n)).map(|n| (unit, off(n * stepped, weight_n)));
        let units = [ForceUnit::Kilonewtons, ForceUnit::BodyWeights, ForceUnit::Millinewtons];
        let (best, least) = units.into_iter().filter_map(off_of).min_by(|a, b| a.1.total_cmp(&b.1))?;
        let usual = off_of(ForceUnit::Kilonewtons).filter(|(_, other)| *other < SAME_UNIT * least);
        (least < SAME_WEIGHT).then(|| usual.map_or(best, |(unit, _)| unit))
    }

    /// Newtons of one unit; `None` for body weights of an unknown person.
    #[must_use]
    pub fn newtons(self, weight_n: Option<f64>) -> Option<f64> {
        match self {
            ForceUnit::Kilonewtons => Some(1000.0),
            ForceUnit::BodyWeights => weight_n,
            ForceUnit::Millinewtons => Some(0.001),
        }
    }

    /// The name in messages.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            ForceUnit::Kilonewtons => "kilonewtons",
            ForceUnit::BodyWeights => "body weights",
            ForceUnit::Millinewtons => "thousandths of a newton",
        }
    }
}

/// Factor between two weights, 1 or more.
fn off(a: f64, b: f64) -> f64 {
    (a / b).max(b / a)
}

/// The body weight that follows from the whole steps in a vertical force (median), in the unit of the force. `None` if
/// there is no whole step, as in noise.
#[must_use]
pub fn stepped_weight(times: &[f64], vertical: &[f64]) -> Option<f64> {
    let [unloaded, most] = quantiles(vertical.iter().copied(), [0.05, 0.998])?;
    let load: Vec<f64> = vertical.iter().map(|x| x - unloaded).collect();
    let limit = LOADED * (most - unloaded);
    let indices: Vec<usize> = (0..load.len().min(times.len())).collect();
    let runs = indices.chunk_by(|a, b| (load[*a] > limit) == (load[*b] > limit));
    let is_inside = |run: &&[usize]| run[0] > 0 && run[run.len() - 1] + 1 < indices.len();
    let loaded: Vec<&[usize]> = runs.filter(|run| load[run[0]] > limit).filter(is_inside).collect();
    let weights: Vec<f64> = loaded.iter().filter_map(|run| weight_of(run, times, &load)).collect();
    // Noise crosses the limit many times.
    (2 * weights.len() >= loaded.len()).then(|| median(weights)).flatten()
}

/// The body weight that follows from one loaded stretch; `None` if its duration or shape is not that of a step.
fn weight_of(run: &[usize], times: &[f64], load: &[f64]) -> Option<f64> {
    let (first, last) = (*run.first()?, *run.last()?);
    let stance_s = times[last] - times[first];
    let own = &load[first..=last];
    let most = own.iter().copied().fold(0.0, f64::max);
    let fifth = own.len() / 5;
    let is_held = own[fifth..own.len() - fifth].iter().all(|x| *x > HELD * most);
    let step_s = if stance_s < RUN_STANCE_S { RUN_STEP_S } else { stance_s / WALK_STANCE };
    let mean = own.iter().sum::<f64>() / own.len() as f64;
    ((STEP_S[0]..=STEP_S[1]).contains(&stance_s) && is_held).then(|| mean * stance_s / step_s)
}
