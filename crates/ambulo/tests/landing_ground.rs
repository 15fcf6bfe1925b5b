//! Predicted ground forces of landings: on both feet, which carry the body until the recording ends, and on the
//! forefoot, as downstairs.

use crate::activity::{GRAVITY, Places, man, moving, moving_on_soles, smooth, stepping};
use ambulo::findings::Findings;
use ambulo::ground::predict::{PredictSettings, predict};
use ambulo::model::anthropometry::Human;
use ambulo::model::{BySide, Side};

/// Time of the landing [s]; the flight before it lasts 0.3 s.
const LANDING_S: f64 = 0.6;

/// Height of the pelvis above standing: falls, is stopped by the legs and rises again; both parts have the same speed
/// at the landing.
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

/// Largest difference of predicted and required vertical force in the last 0.1 s of a recording that ends after some
/// seconds [body weights].
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
    // The feet of this motion stop within a frame, which needs 43 body weights; the low-pass spreads that over the
    // first second.
    for (what, places) in [("on the spot", (|t| landing(t, 0.0)) as Places), ("forwards", |t| landing(t, 1.0))] {
        for (seconds, limit) in [(2.0, 0.1), (4.0, 0.05)] {
            let error = error_at_end(places, seconds);
            println!("landing {what}, {:.1} s after it: off by {error:.3} body weights", seconds - LANDING_S);
            assert!(error < limit, "{what}, {seconds} s: {error}");
        }
    }
}

/// Time of a stride and the share of it that a foot is on the ground, downstairs.
const STRIDE_S: f64 = 1.4;
const DUTY: f64 = 0.65;
/// Stairs down: forward and up in a stride [m].
const STAIRS: [f64; 2] = [0.6, -0.34];

/// Slope of a sole that comes down with its ball first and has its heel down 0.2 s later [rad], against the share of
/// the stride.
fn forefoot_first(share: f64) -> f64 {
    let p = share.rem_euclid(1.0);
    0.5 * if p < DUTY { 1.0 - smooth(p * STRIDE_S / 0.2) } else { smooth((p - DUTY) / (1.0 - DUTY)) }
}

/// Someone who goes downstairs; the soles turn about the balls of the feet, so that these are where they would be in
/// level feet.
fn downstairs(human: &Human, t: f64, pitch: fn(f64) -> f64) -> ([[f64; 2]; 3], [f64; 2]) {
    let [pelvis, right, left] = stepping(t, STRIDE_S, DUTY, STAIRS, 0.8);
    let pitches = [pitch(t / STRIDE_S), pitch(t / STRIDE_S - 0.5)];
    let ball = human.sole(Side::Right).map(|sole| sole.points[1].place).unwrap();
    let lifted = |ankle: [f64; 2], pitch: f64| {
        let (sine, cosine) = pitch.sin_cos();
        [ankle[0] + ball.x * (1.0 - cosine) - ball.y * sine, ankle[1] + ball.x * sine + ball.y * (1.0 - cosine)]
    };
    ([pelvis, lifted(right, pitches[0]), lifted(left, pitches[1])], pitches)
}

/// Places of the centre of pressure between heel (0) and ball (1) a time after each strike that is known; from the
/// strikes of the puppet.
fn places_after_strikes(pitch: fn(f64) -> f64, after_s: f64) -> Vec<f64> {
    let human = man();
    let trajectory = moving_on_soles(&human, |t| downstairs(&human, t, pitch), 5.0);
    let soles = BySide::from_fn(|side| human.sole(side));
    let predicted =
        predict(&human.model, &trajectory, &soles, &PredictSettings::default(), &mut Findings::default()).unwrap();
    let mut places = Vec::new();
    for (side, first) in [(Side::Right, 0.0), (Side::Left, 0.5)] {
        let foot = predicted.foot(side).0;
        for stride in 1..3 {
            let strike = (f64::from(stride) + first) * STRIDE_S;
            let found = predicted.footfalls.falls.iter().filter(|fall| fall.side == side);
            let off =
                found.filter_map(|fall| fall.strike_s).map(|at| (at - strike).abs()).fold(f64::INFINITY, f64::min);
            assert!(off < 0.1, "{side} strike {strike}: {off} s off");
            let (places, frame) = (&mut places, ((strike + after_s) / trajectory.grid().step_s).round() as usize);
            let ([_, right, left], _) = downstairs(&human, strike + 0.3, pitch);
            let ankle = if side == Side::Right { right } else { left };
            let sole = human.sole(side).unwrap().points.map(|point| point.place.x);
            assert!(
                foot.force[frame].y > 0.05 * human.model.mass() * GRAVITY,
                "{side} {strike}: {}",
                foot.force[frame]
            );
            places.push((foot.center_of_pressure[frame].x - ankle[0] - sole[0]) / (sole[1] - sole[0]));
        }
    }
    places
}

#[test]
fn downstairs_the_forefoot_is_loaded_first_and_then_the_heel() {
    let early = places_after_strikes(forefoot_first, 0.08);
    let flat = places_after_strikes(|_| 0.0, 0.08);
    println!("centre of pressure 0.08 s after the strike: {early:.2?}, of level feet {flat:.2?}");
    for (forefoot, flat) in early.iter().zip(&flat) {
        assert!(*forefoot > 0.8 && *flat < 0.5, "{forefoot} {flat}");
    }
}
