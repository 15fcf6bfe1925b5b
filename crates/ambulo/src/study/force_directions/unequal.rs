//! Finds plates that measure different loads for the same need.
//!
//! While one plate carries the body alone, its vertical force is m (a - g), whatever gait the person has. The mean of
//! the measured force over that of the needed one has the same error of mass and motion on all plates, so that plates
//! are compared with each other. In recordings that are used as clean the largest is at most 1.06 times the smallest,
//! but 1.11 to 1.13 in three fast walks of one laboratory, and more in one sample of a file format, which is named.
//! `cargo xtask twins` counts how many plates of 1.25 times the strength are named.
//!
//! Pinned by: ambulo-cli/tests/plates.rs

use super::{Body, Sensor, names};
use crate::findings::Code;

/// A larger ratio of two plates is a fault.
const MOST: f64 = 1.14;
/// A plate carries the body alone with this share of the weight, while all others have less than the second one.
const CARRIES_BW: f64 = 0.6;
const UNLOADED_BW: f64 = 0.03;
/// Most scatter of the measured force about its share of the needed one, rms, as a share of the weight. Walks with one
/// plate of 1.25 times the strength stay below it, also those of children; a motion in a wrong unit does not.
const MOST_SCATTER_BW: f64 = 0.4;
/// Shortest time alone on a plate [s].
const SHORTEST_S: f64 = 0.25;

pub(super) fn unequal(body: &Body, sensors: &[Sensor<'_>]) -> Option<(Code, String)> {
    let loads = sensors.iter().filter_map(|sensor| Some((sensor, load(body, sensors, sensor)?)));
    let mut loads: Vec<(&Sensor<'_>, f64)> = loads.collect();
    loads.sort_by(|a, b| a.1.total_cmp(&b.1));
    let [(low, least), .., (high, most)] = loads[..] else { return None };
    (most > MOST * least).then(|| {
        let (low, high) = (names(&[low]), names(&[high]));
        let message = format!(
            "while it carries the body alone, {high} measures {most:.2} of the vertical force that the motion needs, \
             {low} {least:.2}: one of them has a wrong sensitivity, or something else, such as a cane, carries a part \
             of the body there. hint: check the calibration of both with a known weight"
        );
        (Code::PlatesUnequal, message)
    })
}

/// Measured over needed vertical force while a sensor carries the body alone. `None` if it does so for too short a
/// time, or if motion and force are not alike: the motion is wrong, and shows nothing about a plate.
fn load(body: &Body, sensors: &[Sensor<'_>], own: &Sensor<'_>) -> Option<f64> {
    let mut alone = Vec::new();
    for (frame, need) in body.needed.iter().enumerate() {
        let time_s = body.grid.time(frame);
        let vertical = own.total_at(time_s).dot(&body.up);
        let all: f64 = sensors.iter().map(|sensor| sensor.total_at(time_s).dot(&body.up)).sum();
        if vertical > CARRIES_BW * body.weight_n && (all - vertical).abs() < UNLOADED_BW * body.weight_n {
            alone.push([vertical, need.dot(&body.up)]);
        }
    }
    let sum = |k: usize| alone.iter().map(|pair| pair[k]).sum::<f64>();
    let share = sum(0) / sum(1);
    let off = alone.iter().map(|[vertical, need]| (vertical - share * need).powi(2)).sum::<f64>();
    let scatter_n = (off / alone.len() as f64).sqrt();
    (alone.len() as f64 * body.grid.step_s >= SHORTEST_S && scatter_n < MOST_SCATTER_BW * body.weight_n)
        .then_some(share)
}
