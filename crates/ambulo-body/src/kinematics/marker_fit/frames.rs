//! State of the fit in all frames of a recording: markers used, labels, postures and offsets.

use super::problem::FitProblem;
use super::solve::Outcome;
use crate::motion::MarkerPath;
use crate::spatial::Vec3;
use std::borrow::Cow;

/// Minimum number of markers per frame: fewer do not even determine one rigid body.
pub(super) const FEWEST: usize = 3;
/// Share of the frames in which all markers of the core are visible.
const SHARE_COMPLETE: f64 = 0.5;

/// Per frame and marker: whether the marker is used, and from which path. Per frame: posture and result of the fit.
/// Swapped labels and offsets of missing markers take memory only in frames that have them.
#[derive(Debug, Clone)]
pub(super) struct Frames {
    markers: usize,
    unknowns: usize,
    /// Recorded.
    seen: Vec<bool>,
    /// Recorded and not an outlier.
    used: Vec<bool>,
    /// Index of the path of each marker, for frames with swapped labels.
    swapped: Vec<Option<Box<[usize]>>>,
    /// The same for all other frames: 0, 1, 2 ...
    own: Box<[usize]>,
    postures: Vec<f64>,
    pub(super) outcomes: Vec<Option<Outcome>>,
    /// Markers that a complete frame must have.
    pub(super) core: Vec<bool>,
    /// From the marker of the model to the recorded one, in body axes at the posture of the frame [m].
    offsets: Vec<Vec3>,
    /// The offsets used in the fit of a frame, for frames that lack markers [m].
    targets: Vec<Option<Box<[Vec3]>>>,
    /// The same for all other frames: NaN.
    no_targets: Box<[Vec3]>,
    /// Whether the frame was fitted to the markers of the model, without offsets.
    plain: Vec<bool>,
    /// Whether no linear solve was left before the fit of the frame was complete.
    unfinished: Vec<bool>,
}

impl Frames {
    pub(super) fn new(problem: &FitProblem<'_>) -> Frames {
        let (frames, markers, unknowns) = (problem.frames(), problem.points.len(), problem.tree.unknowns());
        let mut seen = vec![false; frames * markers];
        for (i, path) in problem.paths.iter().enumerate() {
            for frame in 0..frames {
                seen[frame * markers + i] = path.is_seen(frame);
            }
        }
        let mut all = Frames {
            markers,
            unknowns,
            used: seen.clone(),
            swapped: vec![None; frames],
            own: (0..markers).collect(),
            postures: vec![f64::NAN; frames * unknowns],
            outcomes: vec![None; frames],
            core: vec![true; markers],
            offsets: vec![Vec3::repeat(f64::NAN); frames * markers],
            targets: vec![None; frames],
            no_targets: vec![Vec3::repeat(f64::NAN); markers].into(),
            plain: vec![false; frames],
            unfinished: vec![false; frames],
            seen,
        };
        all.choose_core();
        all
    }

    /// Uses the positions of these paths, one per marker, wherever they are recorded.
    pub(super) fn observe(&mut self, paths: &[Cow<'_, MarkerPath>]) {
        (0..self.count()).for_each(|frame| self.observe_frame(frame, paths));
    }

    /// The same in one frame.
    pub(super) fn observe_frame(&mut self, frame: usize, paths: &[Cow<'_, MarkerPath>]) {
        for (i, path) in paths.iter().enumerate() {
            let place = frame * self.markers + i;
            self.seen[place] = path.is_seen(frame);
            self.used[place] = self.seen[place];
        }
    }

    /// Number of frames.
    pub(super) fn count(&self) -> usize {
        self.outcomes.len()
    }

    /// Number of markers.
    pub(super) fn markers(&self) -> usize {
        self.markers
    }

    /// Removes the least visible markers from the core until half of the frames are complete.
    pub(super) fn choose_core(&mut self) {
        self.core.fill(true);
        loop {
            let complete = (0..self.count()).filter(|&frame| self.is_complete(frame)).count();
            if complete as f64 >= SHARE_COMPLETE * self.count() as f64 {
                return;
            }
            let in_core = (0..self.markers).filter(|&i| self.core[i]);
            match in_core.min_by_key(|&i| self.frames_used(i)) {
                Some(rarest) => self.core[rarest] = false,
                None => return,
            }
        }
    }

    /// Whether every marker of the core is used.
    pub(super) fn is_complete(&self, frame: usize) -> bool {
        let used = &self.used[frame * self.markers..(frame + 1) * self.markers];
        used.iter().zip(&self.core).all(|(used, core)| *used || !*core) && used.iter().any(|used| *used)
    }

    /// Number of frames in which a marker is used.
    pub(super) fn frames_used(&self, marker: usize) -> usize {
        (0..self.count()).filter(|&frame| self.is_used(frame, marker)).count()
    }

    pub(super) fn is_seen(&self, frame: usize, marker: usize) -> bool {
        self.seen[frame * self.markers + marker]
    }

    pub(super) fn is_used(&self, frame: usize, marker: usize) -> bool {
        self.used[frame * self.markers + marker]
    }

    /// Number of markers used in a frame.
    pub(super) fn used_in(&self, frame: usize) -> usize {
        self.used[frame * self.markers..(frame + 1) * self.markers].iter().filter(|used| **used).count()
    }

    /// Index of the path that belongs to a marker; another one where labels are swapped.
    pub(super) fn path(&self, frame: usize, marker: usize) -> usize {
        self.paths(frame)[marker]
    }

    /// Path of each marker in a frame.
    pub(super) fn paths(&self, frame: usize) -> &[usize] {
        self.swapped[frame].as_deref().unwrap_or(&self.own)
    }

    /// Uses or excludes a marker in a frame.
    pub(super) fn set_used(&mut self, frame: usize, marker: usize, believed: bool) {
        let i = frame * self.markers + marker;
        let path_seen = self.is_seen(frame, self.path(frame, marker));
        self.used[i] = believed && path_seen;
    }

    /// Sets the path of every marker in a frame.
    pub(super) fn exchange(&mut self, frame: usize, paths: &[usize]) {
        self.swapped[frame] = (*paths != *self.own).then(|| paths.into());
    }

    pub(super) fn posture(&self, frame: usize) -> &[f64] {
        &self.postures[frame * self.unknowns..(frame + 1) * self.unknowns]
    }

    pub(super) fn posture_mut(&mut self, frame: usize) -> &mut [f64] {
        &mut self.postures[frame * self.unknowns..(frame + 1) * self.unknowns]
    }

    /// From the markers of the model to the recorded ones in body axes [m]; NaN if not used.
    pub(super) fn offsets(&self, frame: usize) -> &[Vec3] {
        &self.offsets[frame * self.markers..(frame + 1) * self.markers]
    }

    /// Loads the markers used in a frame; returns their number.
    pub(super) fn load(&self, frame: usize, problem: &mut FitProblem<'_>) -> usize {
        problem.load(frame, |i| self.is_used(frame, i), |i| self.path(frame, i))
    }

    /// The offsets used in the fit of a frame that lacks markers [m]; NaN for excluded markers.
    pub(super) fn targets(&self, frame: usize) -> &[Vec3] {
        self.targets[frame].as_deref().unwrap_or(&self.no_targets)
    }

    /// Stores the offsets used in the fit of a frame.
    pub(super) fn set_targets(&mut self, frame: usize, offsets: &[Vec3]) {
        match &mut self.targets[frame] {
            Some(targets) => targets.copy_from_slice(offsets),
            none => *none = Some(offsets.into()),
        }
    }

    /// Loads the markers used in a frame, and the missing markers of the core at the positions that follow from posture
    /// and offsets.
    pub(super) fn load_as_if_seen(&self, frame: usize, problem: &mut FitProblem<'_>, with_missing: bool) {
        self.load(frame, problem);
        if self.is_plain(frame) || !with_missing || self.outcomes[frame].is_none() {
            return;
        }
        problem.tree.pose_at(self.posture(frame));
        for (i, offset) in self.targets(frame).iter().enumerate() {
            let is_known = offset.iter().all(|x| x.is_finite());
            if problem.frame_weights[i] <= 0.0 && self.core[i] && is_known {
                problem.positions[i] = problem.place(i, offset);
                problem.frame_weights[i] = problem.weights[i];
            }
        }
    }

    /// Stores the current posture of the problem for a frame; `plain` if it was fitted without offsets.
    pub(super) fn keep(&mut self, frame: usize, problem: &FitProblem<'_>, x: &[f64], outcome: Outcome, plain: bool) {
        self.plain[frame] = plain;
        self.posture_mut(frame).copy_from_slice(x);
        self.outcomes[frame] = Some(outcome);
        self.unfinished[frame] = outcome.ran_out;
        for i in 0..self.markers {
            let used = problem.frame_weights[i] > 0.0;
            self.offsets[frame * self.markers + i] =
                if used { problem.offset(i, &problem.positions[i]) } else { Vec3::repeat(f64::NAN) };
        }
    }

    /// Whether the frame was fitted to the markers of the model, without offsets.
    pub(super) fn is_plain(&self, frame: usize) -> bool {
        self.plain[frame]
    }

    /// Whether no linear solve was left before the fit of a frame was complete.
    pub(super) fn is_unfinished(&self, frame: usize) -> bool {
        self.unfinished[frame]
    }

    /// Whether no linear solve was left for a frame at all, so that it has at most a posture that frames before it
    /// predict.
    pub(super) fn is_unfitted(&self, frame: usize) -> bool {
        self.unfinished[frame] && self.outcomes[frame].is_none_or(|outcome| outcome.ran_out && outcome.steps == 0)
    }

    /// Keeps the posture of a frame, because no linear solve is left for a better one.
    pub(super) fn leave_unfinished(&mut self, frame: usize) {
        self.unfinished[frame] = true;
    }

    /// Removes the posture of a frame for whose fit no linear solve is left.
    pub(super) fn leave_unfitted(&mut self, frame: usize) {
        self.remove_posture(frame);
        self.unfinished[frame] = true;
    }

    /// Removes the posture of a frame.
    pub(super) fn remove_posture(&mut self, frame: usize) {
        self.posture_mut(frame).fill(f64::NAN);
        self.outcomes[frame] = None;
    }
}
