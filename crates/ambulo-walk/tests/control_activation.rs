//! Feedback torques that follow their command late: the map of the state with these torques.

use ambulo_walk::internals::{StepMap, activated};
use nalgebra::{DMatrix, DVector};

fn map() -> StepMap {
    StepMap {
        by_state: DMatrix::from_row_slice(2, 2, &[1.0, 0.1, -0.3, 0.9]),
        by_input: DMatrix::from_row_slice(2, 1, &[0.2, 1.5]),
    }
}

/// Some steps with a command that is held: the torque comes nearer to it by a factor, and moves the state.
#[test]
fn torques_come_nearer_to_their_command_and_move_the_state() {
    let (left, command): (f64, f64) = (0.8, 3.0);
    let whole = activated(vec![map()], Some(left)).remove(0);
    let (mut state, mut torque) = (DVector::from_vec(vec![0.5, -1.0]), 0.0);
    let mut together = DVector::from_vec(vec![0.5, -1.0, torque]);
    for k in 1..8 {
        torque = command * (1.0 - left.powi(k));
        state = map().after(&state, &DVector::from_element(1, torque));
        together = whole.after(&together, &DVector::from_element(1, command));
        let expected = [state[0], state[1], torque];
        assert!(together.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-12), "{together}");
    }
}

#[test]
fn without_activation_maps_stay_as_they_are() {
    let same = activated(vec![map()], None).remove(0);
    assert_eq!((same.by_state, same.by_input), (map().by_state, map().by_input));
}
