//! A gait as signals of a figure's coordinates.

use crate::gait::{Walk, WalkCoordinates};
use crate::model::Model;
use crate::simulation::Signal;

/// One signal per coordinate of the model: the gait's curve if it has one, otherwise the default value. The walk keeps its
/// speed of time zero.
#[must_use]
pub fn gait_signals(walk: &Walk, model: &Model) -> Vec<Signal> {
    let coordinates = WalkCoordinates::of(model);
    let count = model.coordinates().len();
    let (mut q, mut qd, mut qdd) = (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
    for (value, coordinate) in q.iter_mut().zip(model.coordinates()) {
        *value = coordinate.default_value;
    }
    Signal::periodic(count, walk.cycle_s(), |t, row| {
        coordinates.write(&walk.at(t), &mut q, &mut qd, &mut qdd);
        for (k, entry) in row.iter_mut().enumerate() {
            *entry = [q[k], qd[k], qdd[k]];
        }
    })
}
