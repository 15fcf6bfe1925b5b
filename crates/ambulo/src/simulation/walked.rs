//! How far a figure of a scene walked, and whether it fell.
//!
//!   fallen:     h - g < 0.7 (h₀ - g₀)           as `control::fall`
//!   step:       a foot carries a load again after at least 0.1 s without one
//!   distance:   |r - r₀|, up to the fall
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | h, r | height and level place of the pelvis; ₀: in the first row | m |
//! | g | height of the ground under the foot that was loaded last | m |
//!
//! The part that reaches the ground first is that whose joint centre comes within 80 mm of it first, from half a second
//! before the fall on. Figures touch the ground with their feet only, so other parts sink into it afterwards.
//!
//! Pinned by: tests/scene_walked.rs

use super::scene::{FigureRecord, FigureWalk, Scene};
use super::walking::{FootRecord, WalkRecording};
use crate::kinematics::TrajectoryError;
use crate::model::anatomy::Leg;
use crate::model::{BodyId, Model};
use crate::spatial::{Pose, Vec3};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A figure whose pelvis is lower than this share of its first height has fallen.
const FALLEN: f64 = 0.7;
/// Shortest time without a load before a step [s].
const SWING_S: f64 = 0.1;
/// A joint centre this close to the ground touches it [m]: hips have 0.09 m of flesh around them.
const NEAR_M: f64 = 0.1;
/// Parts are watched from so long before the fall on [s].
const BEFORE_S: f64 = 0.5;

/// How far a figure walked and whether it fell.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FigureWalked {
    /// Name of the figure.
    pub figure: String,
    /// Steps until the end or the fall: foot strikes after a swing.
    pub steps: usize,
    /// Distance of the pelvis from where it began, at the end or the fall [m].
    pub distance_m: f64,
    /// When it fell [s]; `null` if it did not.
    pub fell_at_s: Option<f64>,
    /// The part that reached the ground first: `hip`, `knee`, or the name of a body; `null` without a fall, or if none
    /// reached it.
    pub first_part: Option<String>,
}

impl FigureWalked {
    /// `walked 14 steps, 9.8 m`, or `fell after 5 steps at 3.20 s, hip first`.
    #[must_use]
    pub fn sentence(&self) -> String {
        let steps = format!("{} step{}", self.steps, if self.steps == 1 { "" } else { "s" });
        let Some(time_s) = self.fell_at_s else { return format!("walked {steps}, {:.1} m", self.distance_m) };
        let first = self.first_part.as_ref().map_or(String::new(), |part| format!(", {part} first"));
        format!("fell after {steps} at {time_s:.2} s{first}")
    }
}

/// How far each walking figure of a scene walked and whether it fell, in the order of the file.
///
/// # Errors
/// A scene that has not been stepped.
pub fn scene_walked(scene: &Scene) -> Result<Vec<FigureWalked>, TrajectoryError> {
    let walks = scene.records()?.into_iter().filter_map(|record| match record {
        FigureRecord::Walk(walk) => Some(walk),
        FigureRecord::Motion(_) => None,
    });
    Ok(walks.map(|walk| walked(&walk)).collect())
}

fn walked(walk: &FigureWalk) -> FigureWalked {
    let recording = &walk.recording;
    let grid = recording.grid();
    let ground = ground(recording);
    let (model, up) = (&recording.model, recording.model.up());
    let root = model.anatomy().pelvis().or_else(|| model.body_ids().next());
    let place = |row: usize| root.map_or(Vec3::zeros(), |root| center(model, &poses(recording, row), root));
    let pelvis: Vec<Vec3> = (0..grid.frames).map(place).collect();
    let height = |row: usize| pelvis[row].dot(&up) - ground[row];
    let has_fallen = |row: &usize| height(*row).is_nan() || height(*row) < FALLEN * height(0);
    let fall = (0..grid.frames).find(has_fallen);
    let last = fall.unwrap_or(grid.frames - 1);
    let moved = pelvis[last] - pelvis[0];
    FigureWalked {
        figure: walk.name.clone(),
        steps: recording.feet.iter().map(|foot| steps(foot, grid.step_s, last)).sum(),
        distance_m: (moved - up * moved.dot(&up)).norm(),
        fell_at_s: fall.map(|row| grid.time(row)),
        first_part: fall.and_then(|row| first_part(recording, &ground, row)),
    }
}

/// Steps of a foot up to a row.
fn steps(foot: &FootRecord, step_s: f64, last: usize) -> usize {
    let swing = (SWING_S / step_s).ceil() as usize;
    let (mut count, mut unloaded) = (0, 0);
    for row in 0..=last {
        match foot.loaded(row) {
            true => {
                count += usize::from(unloaded >= swing);
                unloaded = 0;
            }
            false => unloaded += 1,
        }
    }
    count
}

/// Height of the ground under the foot that was loaded last, in every row; before the first load that of the first one.
fn ground(recording: &WalkRecording) -> Vec<f64> {
    let up = recording.model.up();
    let loaded = |row: usize| {
        let feet = recording.feet.iter().filter(move |foot| foot.loaded(row));
        feet.map(move |foot| foot.point[row].dot(&up)).reduce(f64::max)
    };
    let frames = recording.grid().frames;
    let mut last = (0..frames).find_map(loaded).unwrap_or(0.0);
    (0..frames)
        .map(|row| {
            last = loaded(row).unwrap_or(last);
            last
        })
        .collect()
}

/// The joint centre that comes close to the ground first around a fall.
fn first_part(recording: &WalkRecording, ground: &[f64], fall: usize) -> Option<String> {
    let (model, grid) = (&recording.model, recording.grid());
    let (parts, up) = (parts(model), model.up());
    let first = fall.saturating_sub((BEFORE_S / grid.step_s) as usize);
    (first..grid.frames).find_map(|row| {
        let poses = poses(recording, row);
        let height = |body: &BodyId| center(model, &poses, *body).dot(&up) - ground[row];
        let lowest = parts.iter().min_by(|(a, _), (b, _)| height(a).total_cmp(&height(b)))?;
        (height(lowest.0) < NEAR_M).then(|| lowest.1.clone())
    })
}

/// Bodies with a proximal joint that may reach the ground, and what people call the joint.
fn parts(model: &Model) -> BTreeMap<BodyId, String> {
    let mut parts: BTreeMap<BodyId, String> = model
        .body_ids()
        .filter(|body| model.bodies()[body.index()].joint.parent.is_some())
        .map(|body| (body, model.bodies()[body.index()].name.clone()))
        .collect();
    for Leg { hip, knee, ankle, foot, .. } in model.anatomy().legs().values().flatten() {
        // Feet and ankles touch the ground in every step; that is no fall.
        let carried = |body: BodyId| std::iter::successors(Some(body), |own| model.bodies()[own.index()].joint.parent);
        parts.retain(|body, _| !carried(*body).any(|own| own == *ankle || own == *foot));
        parts.insert(*hip, "hip".to_owned());
        parts.insert(*knee, "knee".to_owned());
    }
    parts
}

/// The poses of all bodies in a row.
fn poses(recording: &WalkRecording, row: usize) -> Vec<Pose> {
    let model = &recording.model;
    let q: Vec<f64> = model.coordinate_ids().map(|id| recording.trajectory.values(id)[row]).collect();
    model.poses(&q)
}

/// The centre of the joint that carries a body [m].
fn center(model: &Model, poses: &[Pose], body: BodyId) -> Vec3 {
    poses[body.index()].place(model.bodies()[body.index()].joint.child_from_joint.translation)
}
