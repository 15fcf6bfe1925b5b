//! A marker fit of one model to one recording: the fitted markers, their weights, and the part of the model that
//! carries them.

use super::normal::{Point, Targets, cost};
use super::result::FitError;
use super::settings::{CoordinateTask, FitMethod, FitSettings, JointLimits, TaskTarget};
use super::solve::{Bounds, Outcome, STEPS, Solver};
use super::tasks::{HeldUnknown, held_unknowns};
use super::tree::MarkerTree;
use crate::findings::{Code, Findings};
use crate::model::neck_and_wrists::HEAD;
use crate::model::{CoordinateId, Drive, Function, Model, Region};
use crate::motion::{MarkerPath, MarkerRecording};
use crate::spatial::Vec3;
use std::borrow::Cow;

/// Maximum number of names in an error message.
const MOST_NAMES: usize = 20;
/// Maximum number of names in a note.
const FEW_NAMES: usize = 6;

/// Data and scratch memory of the fits of all frames.
#[derive(Debug, Clone)]
pub(super) struct FitProblem<'a> {
    pub(super) tree: MarkerTree,
    pub(super) solver: Solver,
    pub(super) bounds: Bounds,
    /// The markers of the model.
    pub(super) points: Vec<Point>,
    /// The recorded markers, in the same order.
    pub(super) paths: Vec<Cow<'a, MarkerPath>>,
    pub(super) weights: Vec<f64>,
    /// Whether each unknown moves an arm, or a head that is a body of its own.
    pub(super) on_arm_or_head: Vec<bool>,
    pub(super) times: Cow<'a, [f64]>,
    /// Coordinates that are functions of time.
    prescribed: Vec<(usize, Function)>,
    tasks: Vec<HeldUnknown>,
    /// Scratch: shifted markers, positions and weights of one frame.
    shifted: Vec<Point>,
    pub(super) positions: Vec<Vec3>,
    pub(super) frame_weights: Vec<f64>,
    /// Largest number of steps of the fit of a frame.
    pub(super) most_steps: usize,
}

impl<'a> FitProblem<'a> {
    pub(super) fn new(
        model: &Model,
        recording: &'a MarkerRecording,
        settings: &FitSettings,
        findings: &mut Findings,
    ) -> Result<FitProblem<'a>, FitError> {
        check_settings(settings)?;
        let common = common_markers(model, recording, settings, findings)?;
        let bodies: Vec<_> = common.iter().map(|c| c.body).collect();
        let (tree, nodes) = MarkerTree::new(model, &bodies);
        if tree.unknowns() == 0 {
            let markers = listed(common.iter().map(|c| c.path.name.as_str()));
            return Err(FitError::NothingToFit { model: model.name().to_owned(), markers });
        }
        let points: Vec<Point> = common.iter().zip(nodes).map(|(c, node)| Point { node, place: c.place }).collect();
        let prescribed = model.coordinates().iter().enumerate().filter_map(|(i, c)| match &c.drive {
            Drive::Prescribed(function) => Some((i, function.clone())),
            _ => None,
        });
        Ok(FitProblem {
            solver: Solver::new(&tree),
            bounds: bounds(model, &tree, settings.limits),
            shifted: points.clone(),
            positions: vec![Vec3::zeros(); points.len()],
            frame_weights: vec![0.0; points.len()],
            most_steps: STEPS,
            paths: common.iter().map(|c| Cow::Borrowed(c.path)).collect(),
            weights: common.iter().map(|c| c.weight).collect(),
            on_arm_or_head: on_arm_or_head(model, &tree),
            times: Cow::Borrowed(&recording.times),
            prescribed: prescribed.collect(),
            tasks: held_unknowns(model, &tree, &settings.tasks, findings),
            points,
            tree,
        })
    }

    /// The same with a copy of the recording.
    pub(super) fn into_owned(self) -> FitProblem<'static> {
        FitProblem {
            tree: self.tree,
            solver: self.solver,
            bounds: self.bounds,
            points: self.points,
            paths: self.paths.into_iter().map(|path| Cow::Owned(path.into_owned())).collect(),
            weights: self.weights,
            on_arm_or_head: self.on_arm_or_head,
            times: Cow::Owned(self.times.into_owned()),
            prescribed: self.prescribed,
            tasks: self.tasks,
            shifted: self.shifted,
            positions: self.positions,
            frame_weights: self.frame_weights,
            most_steps: self.most_steps,
        }
    }

    /// Replaces a frame of the recording: its time [s] and the position of each fitted marker, not-a-number where it is
    /// missing.
    pub(super) fn record(&mut self, frame: usize, time_s: f64, positions: impl Iterator<Item = Vec3>) {
        self.times.to_mut()[frame] = time_s;
        for (path, position) in self.paths.iter_mut().zip(positions) {
            path.to_mut().positions[frame] = position;
        }
    }

    /// Number of frames.
    pub(super) fn frames(&self) -> usize {
        self.times.len()
    }

    /// Loads the recorded positions of a frame. `used` selects markers, `exchanged` is the path that belongs to a
    /// marker in this frame. Returns the number of loaded markers.
    pub(super) fn load(
        &mut self,
        frame: usize,
        used: impl Fn(usize) -> bool,
        exchanged: impl Fn(usize) -> usize,
    ) -> usize {
        let mut count = 0;
        let mut sum = Vec3::zeros();
        for i in 0..self.points.len() {
            let position = self.paths[exchanged(i)].positions[frame];
            let is_used = used(i) && position.iter().all(|x| x.is_finite());
            self.frame_weights[i] = if is_used { self.weights[i] } else { 0.0 };
            self.positions[i] = if is_used { position } else { Vec3::zeros() };
            if is_used {
                sum += position;
                count += 1;
            }
        }
        if count > 0 {
            self.tree.refer_to(sum / count as f64);
        }
        self.enter(frame);
        let sum_of_weights: f64 = self.frame_weights.iter().sum();
        for task in &self.tasks {
            task.hold(self.times[frame], sum_of_weights, &mut self.bounds);
        }
        count
    }

    /// Sets the coordinates that are functions of time.
    pub(super) fn enter(&mut self, frame: usize) {
        for (coordinate, function) in &self.prescribed {
            self.tree.give(*coordinate, function.at(self.times[frame])[0]);
        }
    }

    /// Fits the loaded markers to the markers of the model.
    pub(super) fn fit(&mut self, x: &mut [f64]) -> Outcome {
        let targets = Targets { points: &self.points, positions: &self.positions, weights: &self.frame_weights };
        self.solver.fit(&mut self.tree, &targets, &self.bounds, x, self.most_steps)
    }

    /// Fits the loaded markers to markers of the model that are shifted by offsets in the axes of their bodies [m].
    pub(super) fn fit_with_offsets(&mut self, offsets: &[Vec3], x: &mut [f64]) -> Outcome {
        self.approach_offsets(offsets, x, self.most_steps)
    }

    /// As [`FitProblem::fit_with_offsets`], with at most this number of steps.
    pub(super) fn approach_offsets(&mut self, offsets: &[Vec3], x: &mut [f64], most_steps: usize) -> Outcome {
        for ((shifted, point), offset) in self.shifted.iter_mut().zip(&self.points).zip(offsets) {
            shifted.place = point.place + offset;
        }
        let targets = Targets { points: &self.shifted, positions: &self.positions, weights: &self.frame_weights };
        self.solver.fit(&mut self.tree, &targets, &self.bounds, x, most_steps)
    }

    /// Change of each unknown per metre of error in the loaded markers [rad/m or m/m].
    pub(super) fn uncertainty(&mut self, sensitivity: &mut [f64]) {
        let targets = Targets { points: &self.points, positions: &self.positions, weights: &self.frame_weights };
        self.solver.uncertainty(&self.tree, &targets, sensitivity);
    }

    /// Puts the model into a posture; returns the cost of the loaded markers.
    pub(super) fn pose_at(&mut self, x: &[f64]) -> f64 {
        self.tree.pose_at(x);
        let targets = Targets { points: &self.points, positions: &self.positions, weights: &self.frame_weights };
        cost(&self.tree, &targets)
    }

    /// Offset of a position from the marker of the model, in the axes of its body [m].
    pub(super) fn offset(&self, marker: usize, position: &Vec3) -> Vec3 {
        let pose = self.tree.pose(self.points[marker].node);
        pose.rotation.tr_mul(&(position - pose.translation)) - self.points[marker].place
    }

    /// Position of a marker shifted by an offset in the axes of its body, at the current posture [m].
    pub(super) fn place(&self, marker: usize, offset: &Vec3) -> Vec3 {
        let point = self.points[marker];
        self.tree.pose(point.node).place(point.place + offset)
    }

    /// Distance of the recorded position from the marker of the model at the current posture [m].
    pub(super) fn distance(&self, marker: usize) -> f64 {
        let pose = self.tree.pose(self.points[marker].node);
        (self.positions[marker] - pose.place(self.points[marker].place)).norm()
    }
}

fn check_settings(settings: &FitSettings) -> Result<(), FitError> {
    let setting = |setting: &str, found: f64, allowed: bool, expected| {
        if allowed { Ok(()) } else { Err(FitError::Setting { setting: setting.to_owned(), found, expected }) }
    };
    for (name, &weight) in &settings.weights {
        setting(
            &format!("weight of {name}"),
            weight,
            weight >= 0.0 && weight.is_finite(),
            "a finite number, zero or more",
        )?;
    }
    for task in &settings.tasks {
        check_task(task)?;
    }
    let gap = settings.longest_gap_s;
    setting("longest_gap_s", gap, gap >= 0.0 && gap.is_finite(), "a finite number of seconds, zero or more")?;
    if let FitMethod::Together(smoothing) = settings.method {
        let numbers = [
            ("marker_noise_m", smoothing.marker_noise_m),
            ("rotation_jerk", smoothing.rotation_jerk),
            ("translation_jerk", smoothing.translation_jerk),
        ];
        for (name, value) in numbers {
            setting(name, value, value > 0.0 && value.is_finite(), "a finite number above zero")?;
        }
    }
    Ok(())
}

fn check_task(task: &CoordinateTask) -> Result<(), FitError> {
    let error = |setting: String, found: f64, expected| Err(FitError::Setting { setting, found, expected });
    if !(task.weight >= 0.0 && task.weight.is_finite()) {
        return error(format!("weight of {}", task.coordinate), task.weight, "a finite number, zero or more");
    }
    let values: &[f64] = match &task.target {
        TaskTarget::Default => &[],
        TaskTarget::Value(value) => std::slice::from_ref(value),
        TaskTarget::Samples { times, values } if !values.is_empty() && times.len() == values.len() => values,
        TaskTarget::Samples { values, .. } => {
            let setting = format!("values of {}", task.coordinate);
            return error(setting, values.len() as f64, "one value for each time, at least one");
        }
    };
    match values.iter().find(|value| !value.is_finite()) {
        Some(value) => error(format!("value of {}", task.coordinate), *value, "finite numbers"),
        None => Ok(()),
    }
}

struct Common<'a> {
    path: &'a MarkerPath,
    body: crate::model::BodyId,
    place: Vec3,
    weight: f64,
}

/// The common markers of model and recording, in the order of the recording.
fn common_markers<'a>(
    model: &Model,
    recording: &'a MarkerRecording,
    settings: &FitSettings,
    findings: &mut Findings,
) -> Result<Vec<Common<'a>>, FitError> {
    let (mut common, mut without_weight) = (Vec::new(), 0);
    let mut only_recorded = Vec::new();
    for path in &recording.markers {
        let (found, expected) = (path.positions.len(), recording.frames());
        if found != expected {
            return Err(FitError::Frames { marker: path.name.clone(), found, expected });
        }
        let known = model.markers().iter().find(|m| m.name == path.name);
        match known.and_then(|m| Some((m.body?, m.location))) {
            Some((body, place)) => {
                let weight = settings.weights.get(&path.name).copied().unwrap_or(1.0);
                match weight > 0.0 {
                    true => common.push(Common { path, body, place, weight }),
                    false => without_weight += 1,
                }
            }
            None => only_recorded.push(path.name.as_str()),
        }
    }
    let recorded = |name: &str| recording.markers.iter().any(|m| m.name == name);
    if common.is_empty() && without_weight > 0 {
        let (model, recording) = (model.name().to_owned(), recording.name.clone());
        return Err(FitError::NoTrackedMarker { model, recording, common: without_weight });
    }
    if common.is_empty() {
        return Err(FitError::NoCommonMarker {
            model: model.name().to_owned(),
            recording: recording.name.clone(),
            model_markers: listed(model.markers().iter().map(|m| m.name.as_str())),
            recorded: listed(recording.markers.iter().map(|m| m.name.as_str())),
        });
    }
    let only_model: Vec<&str> =
        model.markers().iter().map(|m| m.name.as_str()).filter(|name| !recorded(name)).collect();
    report_uncommon(recording, [common.len(), without_weight], [&only_recorded, &only_model], findings);
    Ok(common)
}

fn report_uncommon(
    recording: &MarkerRecording,
    [tracked, without_weight]: [usize; 2],
    [only_recorded, only_model]: [&[&str]; 2],
    findings: &mut Findings,
) {
    if only_recorded.is_empty() && only_model.is_empty() {
        return;
    }
    let part = |what: &str, names: &[&str]| match names {
        [] => String::new(),
        _ => format!("; {} only {what}: {}", names.len(), first(names.iter().copied(), FEW_NAMES)),
    };
    let untracked = match without_weight {
        0 => String::new(),
        count => format!("; {count} more have the weight 0 and are not fitted"),
    };
    let message = format!(
        "{tracked} of {} markers of `{}` are on the model and are fitted{untracked}{}{}",
        recording.markers.len(),
        recording.name,
        part("in the recording", only_recorded),
        part("on the model", only_model)
    );
    findings.report(Code::MarkersUncommon, message);
}

/// Names in one line; very long lists are shortened.
pub(super) fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    first(names, MOST_NAMES)
}

fn first<'a>(names: impl Iterator<Item = &'a str>, most: usize) -> String {
    let names: Vec<&str> = names.collect();
    match names.len() {
        0 => "none".to_owned(),
        n if n > most => format!("{} and {} more", names[..most].join(", "), n - most),
        _ => names.join(", "),
    }
}

/// Whether each unknown moves an arm or a head that is a body of its own.
fn on_arm_or_head(model: &Model, tree: &MarkerTree) -> Vec<bool> {
    let ids: Vec<CoordinateId> = model.coordinate_ids().collect();
    let neck = model.body(HEAD).map(|head| model.bodies()[head.index()].joint.coordinates()).unwrap_or_default();
    let is_spared = |unknown: usize| {
        let id = ids[tree.coordinate(unknown)];
        neck.contains(&id) || Region::of_coordinate(model, id) == Some(Region::Arms)
    };
    (0..tree.unknowns()).map(is_spared).collect()
}

/// Ranges of the unknowns. Joints to ground have none: a person may turn around more often than the range of the root
/// allows.
fn bounds(model: &Model, tree: &MarkerTree, limits: JointLimits) -> Bounds {
    let mut bounds = Bounds::none(tree.unknowns());
    let on_ground = model.bodies().iter().filter(|b| b.joint.parent.is_none());
    let places: Vec<usize> = on_ground.flat_map(|b| b.joint.coordinates()).map(|id| id.index()).collect();
    for unknown in (0..tree.unknowns()).filter(|&u| !places.contains(&tree.coordinate(u))) {
        let coordinate = &model.coordinates()[tree.coordinate(unknown)];
        let obeyed = match limits {
            JointLimits::Off => false,
            JointLimits::Clamped => coordinate.clamped,
            JointLimits::Ranges => true,
        };
        if let (true, Some([low, high])) = (obeyed, coordinate.range)
            && low <= high
        {
            (bounds.low[unknown], bounds.high[unknown]) = (low, high);
        }
    }
    bounds
}
