//! All frames of a recording: what is believed in each, and what was found.

use super::problem::Problem;
use super::solve::Outcome;
use crate::spatial::Vec3;

/// Fewer markers than this leave even one rigid body undetermined.
pub(super) const FEWEST: usize = 3;
/// At least this share of the frames shows all markers of the core, if any set of markers does.
const SHARE_COMPLETE: f64 = 0.5;

/// Per frame and marker: is it believed, whose path is it; per frame: the posture and how it was found.
#[derive(Debug, Clone)]
pub(super) struct Frames {
    markers: usize,
    unknowns: usize,
    /// Seen by the cameras.
    seen: Vec<bool>,
    /// Seen and believed.
    used: Vec<bool>,
    /// Whose path a marker took.
    path: Vec<usize>,
    postures: Vec<f64>,
    pub(super) outcomes: Vec<Option<Outcome>>,
    /// Markers that are seen in the frames called complete.
    pub(super) core: Vec<bool>,
    /// From the model's marker to the recorded one in body axes, at the posture of the frame [m].
    offsets: Vec<Vec3>,
    /// The offsets at which the frame was fitted, if not to the model's own markers [m].
    targets: Vec<Vec3>,
    /// Fitted to the model's own markers, all that are believed.
    plain: Vec<bool>,
}

impl Frames {
    pub(super) fn new(problem: &Problem<'_>) -> Frames {
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
            path: (0..frames * markers).map(|i| i % markers).collect(),
            postures: vec![f64::NAN; frames * unknowns],
            outcomes: vec![None; frames],
            core: vec![true; markers],
            offsets: vec![Vec3::repeat(f64::NAN); frames * markers],
            targets: vec![Vec3::repeat(f64::NAN); frames * markers],
            plain: vec![false; frames],
            seen,
        };
        all.choose_core();
        all
    }

    /// Number of frames.
    pub(super) fn count(&self) -> usize {
        self.outcomes.len()
    }

    /// Number of markers.
    pub(super) fn markers(&self) -> usize {
        self.markers
    }

    /// Leaves out the most rarely seen markers until half of the frames show all of the others.
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

    /// Whether every marker of the core is believed.
    pub(super) fn is_complete(&self, frame: usize) -> bool {
        let used = &self.used[frame * self.markers..(frame + 1) * self.markers];
        used.iter().zip(&self.core).all(|(used, core)| *used || !*core) && used.iter().any(|used| *used)
    }

    /// Frames in which a marker is believed.
    pub(super) fn frames_used(&self, marker: usize) -> usize {
        (0..self.count()).filter(|&frame| self.is_used(frame, marker)).count()
    }

    pub(super) fn is_seen(&self, frame: usize, marker: usize) -> bool {
        self.seen[frame * self.markers + marker]
    }

    pub(super) fn is_used(&self, frame: usize, marker: usize) -> bool {
        self.used[frame * self.markers + marker]
    }

    /// Markers believed in a frame.
    pub(super) fn used_in(&self, frame: usize) -> usize {
        self.used[frame * self.markers..(frame + 1) * self.markers].iter().filter(|used| **used).count()
    }

    /// Whose path a marker took.
    pub(super) fn path(&self, frame: usize, marker: usize) -> usize {
        self.path[frame * self.markers + marker]
    }

    /// Whose path each marker took.
    pub(super) fn paths(&self, frame: usize) -> &[usize] {
        &self.path[frame * self.markers..(frame + 1) * self.markers]
    }

    /// Believes a marker or not.
    pub(super) fn believe(&mut self, frame: usize, marker: usize, believed: bool) {
        let i = frame * self.markers + marker;
        let path_seen = self.seen[frame * self.markers + self.path[i]];
        self.used[i] = believed && path_seen;
    }

    /// States whose path every marker took in a frame.
    pub(super) fn exchange(&mut self, frame: usize, paths: &[usize]) {
        self.path[frame * self.markers..(frame + 1) * self.markers].copy_from_slice(paths);
    }

    pub(super) fn posture(&self, frame: usize) -> &[f64] {
        &self.postures[frame * self.unknowns..(frame + 1) * self.unknowns]
    }

    pub(super) fn posture_mut(&mut self, frame: usize) -> &mut [f64] {
        &mut self.postures[frame * self.unknowns..(frame + 1) * self.unknowns]
    }

    /// From the model's markers to the recorded ones in body axes [m]; not a number where not believed.
    pub(super) fn offsets(&self, frame: usize) -> &[Vec3] {
        &self.offsets[frame * self.markers..(frame + 1) * self.markers]
    }

    /// Loads what is believed in a frame; returns how many markers that are.
    pub(super) fn load(&self, frame: usize, problem: &mut Problem<'_>) -> usize {
        problem.load(frame, |i| self.is_used(frame, i), |i| self.path(frame, i))
    }

    /// The offsets at which a frame was fitted that lacks markers [m]; not a number for markers left out.
    pub(super) fn targets(&self, frame: usize) -> &[Vec3] {
        &self.targets[frame * self.markers..(frame + 1) * self.markers]
    }

    /// Notes the offsets at which a frame is fitted.
    pub(super) fn aim(&mut self, frame: usize, offsets: &[Vec3]) {
        self.targets[frame * self.markers..(frame + 1) * self.markers].copy_from_slice(offsets);
    }

    /// Loads what is believed in a frame, and missing markers of the core where its posture has them at their offsets.
    pub(super) fn load_as_if_seen(&self, frame: usize, problem: &mut Problem<'_>, with_missing: bool) {
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

    /// Keeps the posture of a frame, at which the problem stands.
    /// `plain` if it was fitted to the model's own markers.
    pub(super) fn keep(&mut self, frame: usize, problem: &Problem<'_>, x: &[f64], outcome: Outcome, plain: bool) {
        self.plain[frame] = plain;
        self.posture_mut(frame).copy_from_slice(x);
        self.outcomes[frame] = Some(outcome);
        for i in 0..self.markers {
            let used = problem.frame_weights[i] > 0.0;
            self.offsets[frame * self.markers + i] =
                if used { problem.offset(i, &problem.positions[i]) } else { Vec3::repeat(f64::NAN) };
        }
    }

    /// Whether the frame was fitted to the model's own markers.
    pub(super) fn is_plain(&self, frame: usize) -> bool {
        self.plain[frame]
    }

    /// Forgets the posture of a frame.
    pub(super) fn lose(&mut self, frame: usize) {
        self.posture_mut(frame).fill(f64::NAN);
        self.outcomes[frame] = None;
    }
}
