//! Predicted ground forces of landings on both feet: the feet carry the body until the recording ends.

use crate::activity::{GRAVITY, Places, man, moving};
use ambulo::findings::Findings;
use ambulo::ground::predict::{PredictSettings, predict};
use ambulo::model::BySide;

/// Time of the landing [s]; the flight before it lasts 0.3 s.
const LANDING_S: f64 = 0.6;

/// Height of the pelvis above standing: falls, is stopped by the legs and rises again; both parts have the same speed at the landing.
fn drop(t: f64) -> f64 {
    let s = t - LANDING_S;
    let speed = 0.3 * GRAVITY;
    if s < 0.0 {
        let before = s + 0.3;
        // At rest on a step until 0.3 s before the landing.
        if before < 0.0 { 0.15 * 0.3 * GRAVITY } else { 0.5 * GRAVITY * (0.09 - before * before) }
    } else {
        // -v s exp(-s/τ), τ = 0.2 s: back to standing.
        -speed * s * (-s / 0.2).exp()
    }
}

fn landing(t: f64, forward: f64) -> [[f64; 2]; 3] {
    let height = drop(t);
    let feet = height.max(0.0);
    let along = forward * t.min(LANDING_S);
    [[along + 0.04, 0.9 + height], [along, feet], [along, feet]]
}

/// Largest difference of predicted and required vertical force in the last 0.1 s of a recording that ends after some seconds [body weights].
fn error_at_end(places: Places, seconds: f64) -> f64 {
    let human = man();
    let trajectory = moving(&human, places, seconds);
    let soles = BySide::from_fn(|side| human.sole(side));
    let predicted =
        predict(&human.model, &trajectory, &soles, &PredictSettings::default(), &mut Findings::default()).unwrap();
    let weight = human.model.mass() * GRAVITY;
    let frames = trajectory.grid().frames;
    let error = |i: usize| {
        let carried: f64 = predicted.ground.bodies.iter().map(|foot| foot.force[i].y).sum();
        (carried - predicted.total[i].force.y).abs() / weight
    };
    (frames - 10..frames).map(error).fold(0.0, f64::max)
}

#[test]
fn a_landing_is_carried_to_the_end_of_the_recording() {
    // The feet of this motion stop within a frame, which needs 43 body weights; the low-pass spreads that over the first second.
    for (what, places) in [("on the spot", (|t| landing(t, 0.0)) as Places), ("forwards", |t| landing(t, 1.0))] {
        for (seconds, limit) in [(2.0, 0.1), (4.0, 0.05)] {
            let error = error_at_end(places, seconds);
            println!("landing {what}, {:.1} s after it: off by {error:.3} body weights", seconds - LANDING_S);
            assert!(error < limit, "{what}, {seconds} s: {error}");
        }
    }
}
