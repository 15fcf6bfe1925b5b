//! How near a walk that a program made is to walks of people: how high a swinging foot is, how fast joints turn, and
//! how far the pelvis moves back.
//!
//!   h = lowest point of a sole - lowest point of both soles
//!   ω = |q(t + 20 ms) - q(t)| / 20 ms          of hip flexion, knee flexion and ankle dorsiflexion
//!   b = farthest place of the pelvis so far - its place, along the way from its first to its last place
//!
//! Limits are 1.5 times the largest values of people: in 21 walks of ten adults at their own and at a fast speed, h was
//! at most 0.085 m and ω 353, 474 and 399 deg/s. The pelvis of a person who walks does not move back; who starts to
//! walk moves it back by centimetres. Heights and ways are shares of leg length L, speeds are multiples of √(g/L), for
//! legs of 0.9 m. A person may do more on purpose, so this is no reason to call a motion infeasible; recordings of
//! people are not judged. Frames after a fall are left out.
//!
//! Pinned by: tests/likeness.rs, tests/muscles.rs (people)

use super::person::Person;
use super::verdict::{Likeness, LikenessMeasure};
use crate::kinematics::{BodyMotion, Trajectory, each_body_motion};
use crate::model::anatomy::{Sole, SolePoint};
use crate::model::{Model, Movement, Side};
use crate::spatial::Vec3;

/// Greatest height of a swinging sole [leg lengths].
const HIGHEST: f64 = 0.155;
/// Greatest speeds of joints [deg/s], for legs of [`ADULT_LEG_M`] on Earth.
const FASTEST: [(Movement, f64); 3] =
    [(Movement::HipFlexion, 530.0), (Movement::KneeFlexion, 710.0), (Movement::AnkleDorsiflexion, 600.0)];
/// Greatest way of the pelvis back [leg lengths].
const BACK: f64 = 0.1;
/// Leg length and gravity to which the speeds belong [m, m/s²].
const ADULT_LEG_M: f64 = 0.9;
const EARTH: f64 = 9.80665;
/// Time over which speeds are averaged [s].
const SHORT_S: f64 = 0.02;
/// A pelvis that moves less far from its first to its last place does not walk [leg lengths].
const WALKS: f64 = 0.5;
/// A pelvis lower than this share of its first height has fallen.
const FALLEN: f64 = 0.7;

/// Compares a walk with those of people: height of the swing, way of the pelvis back, speed of hips, knees and ankles,
/// each at the instant at which it is nearest to its limit. Empty for a body without pelvis, legs and soles.
#[must_use]
pub fn likeness(model: &Model, trajectory: &Trajectory, person: &Person) -> Vec<Likeness> {
    let Some((pelvis, soles)) = places(model, trajectory, person) else { return Vec::new() };
    let up = model.up();
    let upright = |place: &&Vec3| place.dot(&up) >= FALLEN * pelvis[0].dot(&up);
    let frames = pelvis.iter().take_while(upright).count();
    let compared = Compared { model, trajectory, person, frames };
    let speeds = FASTEST.iter().map(|(movement, limit)| compared.speed(*movement, *limit));
    let others = [compared.swing(&soles), compared.way_back(&pelvis[..frames])];
    others.into_iter().chain(speeds).flatten().collect()
}

/// Places of the pelvis, and heights of the lowest points of the right and the left sole, in all frames [m].
fn places(model: &Model, trajectory: &Trajectory, person: &Person) -> Option<(Vec<Vec3>, Vec<[f64; 2]>)> {
    let root = model.anatomy().pelvis()?;
    let both: [&Sole; 2] = [person.soles[Side::Right].as_ref()?, person.soles[Side::Left].as_ref()?];
    let up = model.up();
    let lowest = |sole: &Sole, bodies: &[BodyMotion]| {
        let height = |point: &SolePoint| bodies[point.body.index()].pose.place(point.place).dot(&up);
        sole.points.iter().map(height).fold(f64::INFINITY, f64::min)
    };
    let (mut pelvis, mut soles) = (Vec::new(), Vec::new());
    each_body_motion(model, trajectory, |_, bodies| {
        pelvis.push(bodies[root.index()].pose.translation);
        soles.push(both.map(|sole| lowest(sole, bodies)));
    });
    (!pelvis.is_empty()).then_some((pelvis, soles))
}

struct Compared<'a> {
    model: &'a Model,
    trajectory: &'a Trajectory,
    person: &'a Person,
    /// Frames before a fall.
    frames: usize,
}

impl Compared<'_> {
    fn swing(&self, soles: &[[f64; 2]]) -> Option<Likeness> {
        let height = |frame: usize, k: usize| soles[frame][k] - soles[frame][0].min(soles[frame][1]);
        let all = (0..self.frames).flat_map(|frame| [0, 1].map(|k| (frame, k, height(frame, k))));
        let (frame, k, value) = all.max_by(|a, b| a.2.total_cmp(&b.2))?;
        let (limit, side) = (HIGHEST * self.person.leg_length_m, Side::BOTH[k]);
        let at_s = self.trajectory.grid().time(frame);
        let message = format!(
            "the whole {side} foot is {value:.2} m above the other one at {at_s:.2} s; {limit:.2} m is more than \
             people need on level ground"
        );
        Some(Likeness::new(
            LikenessMeasure::SwingHeight,
            format!("sole_{}", side.letter()),
            at_s,
            [value, limit],
            message,
        ))
    }

    /// Of both sides, the faster one.
    fn speed(&self, movement: Movement, limit: f64) -> Option<Likeness> {
        let grid = self.trajectory.grid();
        let apart = ((SHORT_S / grid.step_s).round() as usize).max(1);
        let time_s = apart as f64 * grid.step_s;
        let limit = limit * (self.model.gravity().norm() / EARTH * ADULT_LEG_M / self.person.leg_length_m).sqrt();
        let of_side = |side: Side| {
            let (id, _) = self.model.anatomy().coordinate(movement, Some(side))?;
            let values = &self.trajectory.values(id)[..self.frames];
            let speeds = values.windows(apart + 1).map(|part| (part[apart] - part[0]).abs().to_degrees() / time_s);
            speeds.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(frame, value)| (id, frame, value))
        };
        let sides = Side::BOTH.into_iter().filter_map(of_side);
        let (id, frame, value) = sides.max_by(|a, b| a.2.total_cmp(&b.2))?;
        let (name, at_s) = (self.model.coordinates()[id.index()].name.clone(), grid.time(frame));
        let message =
            format!("`{name}` turns at {value:.0} deg/s at {at_s:.2} s; {limit:.0} deg/s is faster than people walk");
        Some(Likeness::new(LikenessMeasure::JointSpeed, name, at_s, [value, limit], message))
    }

    fn way_back(&self, pelvis: &[Vec3]) -> Option<Likeness> {
        let up = self.model.up();
        let whole = pelvis.last()? - pelvis.first()?;
        let level = whole - up * whole.dot(&up);
        if level.norm() < WALKS * self.person.leg_length_m {
            return None;
        }
        let along = level.normalize();
        let (mut farthest, mut worst) = (f64::NEG_INFINITY, (0, 0.0));
        for (frame, place) in pelvis.iter().map(|place| place.dot(&along)).enumerate() {
            farthest = farthest.max(place);
            if farthest - place > worst.1 {
                worst = (frame, farthest - place);
            }
        }
        let (at_s, limit) = (self.trajectory.grid().time(worst.0), BACK * self.person.leg_length_m);
        let message = format!(
            "the pelvis has moved back by {:.2} m at {at_s:.2} s; {limit:.2} m is more than people do before or in a \
             walk",
            worst.1
        );
        Some(Likeness::new(LikenessMeasure::PelvisPath, "pelvis".to_owned(), at_s, [worst.1, limit], message))
    }
}
