//! A gait as signals of a figure's coordinates.

use crate::gait::{Walk, WalkCoordinates};
use crate::model::Model;
use crate::simulation::{Samples, Signal};
use std::sync::Arc;

/// Samples of a gait are no farther apart [s].
const STEP_S: f64 = 1e-3;

/// One signal a coordinate of the model: the gait's where it has one, else the default value. The gait's speed at time zero is
/// kept. The gait is sampled every millisecond, with its rates and accelerations: between samples angles differ by less than
/// 1e-9 rad, and accelerations by what a jump of the third derivative makes of a millisecond.
#[must_use]
pub fn gait_signals(walk: &Walk, model: &Model) -> Vec<Signal> {
    let coordinates = WalkCoordinates::of(model);
    let count = model.coordinates().len();
    let (mut q, mut qd, mut qdd) = (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
    for (value, coordinate) in q.iter_mut().zip(model.coordinates()) {
        *value = coordinate.default_value;
    }
    let samples = Samples::new(count, [0.0, walk.cycle_s()], STEP_S, true, |t, row| {
        coordinates.write(&walk.at(t), &mut q, &mut qd, &mut qdd);
        for (k, entry) in row.iter_mut().enumerate() {
            *entry = [q[k], qd[k], qdd[k]];
        }
    });
    let samples = Arc::new(samples);
    (0..count).map(|k| Signal::Sampled(Arc::clone(&samples), k)).collect()
}
