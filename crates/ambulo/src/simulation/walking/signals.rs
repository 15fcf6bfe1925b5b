//! A gait as signals of a figure's coordinates, made by its state machine.

use crate::gait::machine::WalkMachine;
use crate::gait::{Walk, WalkCoordinates};
use crate::model::Model;
use crate::simulation::Signal;

/// One signal per coordinate of the model: what the state machine of the gait gives for it, otherwise the default value. Time zero of the
/// signals is `start_s` of the walk. A walk whose pace changes is computed for `duration_s`; otherwise it repeats every cycle.
///
/// # Panics
/// If the pace changes and the duration is not above zero.
#[must_use]
pub fn gait_signals(walk: &Walk, model: &Model, start_s: f64, duration_s: f64) -> Vec<Signal> {
    let coordinates = WalkCoordinates::of(model);
    let mut machine = WalkMachine::new(walk);
    let count = model.coordinates().len();
    let (mut q, mut qd, mut qdd) = (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
    for (value, coordinate) in q.iter_mut().zip(model.coordinates()) {
        *value = coordinate.default_value;
    }
    let motion = |t: f64, row: &mut [[f64; 3]]| {
        coordinates.write(&machine.step(start_s + t), &mut q, &mut qd, &mut qdd);
        for (k, entry) in row.iter_mut().enumerate() {
            *entry = [q[k], qd[k], qdd[k]];
        }
    };
    if walk.is_steady() {
        Signal::periodic(count, walk.cycle_s(), motion)
    } else {
        Signal::over(count, duration_s, motion)
    }
}
