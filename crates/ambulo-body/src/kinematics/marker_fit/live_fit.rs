//! The fit of markers that arrive frame by frame.
//!
//! Every frame is fitted as [`super::sequence`] fits those of a recording: from the postures of the frames before, with
//! the detection of jumps and swapped labels. Only the last frames are kept. In a frame that lacks markers, the missing
//! ones are where the posture has them at their last offsets, as in a recording after its last complete frame (`gaps`);
//! unknowns that the visible markers do not determine are not-a-number. What needs later frames is left out: offsets
//! interpolated up to the next complete frame, curves across gaps, misplaced markers.
//!
//! Cost: as of a frame of a recording, and at most [`super::budget`]'s rest of the first frame in a single one.
//! Pinned by: tests/live_markers.rs

use super::frames::Frames;
use super::gaps::{Determination, fit_as_if_seen, judge_loaded};
use super::problem::FitProblem;
use super::report::{Leader, leaders};
use super::result::FitError;
use super::sequence::{Tracking, fit_frame};
use super::settings::{FitSettings, OutlierDetection};
use crate::findings::Findings;
use crate::model::Model;
use crate::motion::{MarkerPath, MarkerRecording};
use crate::spatial::Vec3;

/// The two last frames with a posture, and the new one.
const KEPT: usize = 3;
/// Complete frames have the markers that were visible in half of the frames of this time [s].
const CORE_S: f64 = 20.0;
const CORE_SHARE: f64 = 0.5;

/// Fits a model to markers frame by frame.
#[derive(Debug, Clone)]
pub struct LiveMarkerFit {
    problem: FitProblem<'static>,
    frames: Frames,
    memory: Tracking,
    outliers: OutlierDetection,
    /// Names of the markers of a frame.
    markers: usize,
    /// Place in a frame of each fitted marker.
    places: Vec<usize>,
    rate_hz: f64,
    /// Number of the next frame.
    next: u64,
    /// Share of the last frames in which each fitted marker was visible.
    visible: Vec<f64>,
    /// Source of each coordinate, and the value of undetermined ones.
    leaders: Vec<Leader>,
    defaults: Vec<f64>,
    /// Start of the search for the first posture, one value per unknown.
    first: Vec<f64>,
    /// Change of each unknown per metre of error in a complete frame [rad/m or m/m].
    usual: Vec<f64>,
    /// Whether the last frame was complete, so that `usual` is that of an older one.
    was_complete: bool,
    states: Vec<Determination>,
    q: Vec<f64>,
}

impl LiveMarkerFit {
    /// Begins with the names of the markers of a frame, in its order; those that the model does not have are not used,
    /// which `findings` reports.
    ///
    /// # Errors
    /// No common marker, no coordinate that the markers determine, settings out of range.
    pub fn new(
        model: &Model,
        names: &[String],
        rate_hz: f64,
        settings: &FitSettings,
        findings: &mut Findings,
    ) -> Result<LiveMarkerFit, FitError> {
        let path = |name: &String| MarkerPath { name: name.clone(), positions: vec![Vec3::repeat(f64::NAN); KEPT] };
        let recording = MarkerRecording {
            name: "the stream".to_owned(),
            rate_hz,
            times: vec![0.0; KEPT],
            markers: names.iter().map(path).collect(),
        };
        let problem = FitProblem::new(model, &recording, settings, findings)?.into_owned();
        let place = |path: &str| names.iter().position(|name| name == path);
        let unknowns = problem.tree.unknowns();
        let coordinates = model.coordinates();
        let first: Vec<f64> =
            (0..unknowns).map(|unknown| coordinates[problem.tree.coordinate(unknown)].default_value).collect();
        let frames = Frames::new(&problem);
        Ok(LiveMarkerFit {
            memory: Tracking::new(frames.markers(), &first),
            outliers: settings.outliers,
            markers: names.len(),
            places: problem.paths.iter().filter_map(|path| place(&path.name)).collect(),
            rate_hz,
            next: 0,
            visible: vec![0.0; frames.markers()],
            leaders: leaders(model, &problem),
            defaults: coordinates.iter().map(|coordinate| coordinate.default_value).collect(),
            usual: vec![0.0; unknowns],
            was_complete: false,
            states: vec![Determination::Determined; KEPT * unknowns],
            q: vec![0.0; coordinates.len()],
            first,
            frames,
            problem,
        })
    }

    /// Number of markers that are fitted.
    #[must_use]
    pub fn fitted(&self) -> usize {
        self.places.len()
    }

    /// Passes over frames that did not arrive.
    pub fn skip(&mut self, frames: u64) {
        self.next += frames;
    }

    /// Fits the next frame: a position per marker, in the axes of the ground of the model [m], not-a-number where it is
    /// missing. Returns a value per coordinate of the model [rad or m], not-a-number where the visible markers do not
    /// determine it; `None` if too few are visible.
    ///
    /// # Errors
    /// Another number of markers.
    pub fn push(&mut self, positions: &[Vec3]) -> Result<Option<&[f64]>, FitError> {
        if positions.len() != self.markers {
            let setting = "the number of positions in a frame".to_owned();
            let expected = "one position per marker";
            return Err(FitError::Setting { setting, found: positions.len() as f64, expected });
        }
        let slot = (0..KEPT).find(|slot| !self.memory.last.contains(&Some(*slot))).unwrap_or(0);
        self.problem.record(slot, self.next as f64 / self.rate_hz, self.places.iter().map(|&place| positions[place]));
        self.next += 1;
        self.frames.observe_frame(slot, &self.problem.paths);
        self.frames.remove_posture(slot);
        self.choose_core(slot);
        let before = self.memory.last[0];
        if before.is_some() {
            self.problem.solver.budget.limit_rest();
        }
        fit_frame(&mut self.problem, &mut self.frames, &mut self.memory, slot, self.outliers, &self.first);
        if self.frames.outcomes[slot].is_none() {
            return Ok(None);
        }
        self.judge(slot, before);
        Ok(Some(self.values(slot)))
    }

    /// Complete frames have the markers that were visible in at least half of the last frames.
    fn choose_core(&mut self, slot: usize) {
        let count = (self.next as f64).min(CORE_S * self.rate_hz);
        for (i, visible) in self.visible.iter_mut().enumerate() {
            *visible += (f64::from(u8::from(self.frames.is_seen(slot, i))) - *visible) / count;
            self.frames.core[i] = *visible >= CORE_SHARE;
        }
    }

    /// Fits a frame that lacks markers as if it had them, and finds out which unknowns the others determine.
    fn judge(&mut self, slot: usize, before: Option<usize>) {
        let unknowns = self.usual.len();
        self.states[slot * unknowns..(slot + 1) * unknowns].fill(Determination::Determined);
        let is_complete = self.frames.is_complete(slot);
        if is_complete || before.is_none() {
            self.was_complete = is_complete;
            return;
        }
        if self.was_complete
            && let Some(complete) = before
        {
            self.frames.load(complete, &mut self.problem);
            self.problem.pose_at(self.frames.posture(complete));
            self.problem.uncertainty(&mut self.usual);
            self.was_complete = false;
        }
        self.frames.set_targets(slot, &self.memory.offsets);
        fit_as_if_seen(&mut self.problem, &mut self.frames, slot);
        for (i, offset) in self.memory.offsets.iter_mut().enumerate().filter(|(i, _)| self.frames.is_used(slot, *i)) {
            *offset = self.frames.offsets(slot)[i];
        }
        self.frames.load(slot, &mut self.problem);
        self.problem.pose_at(self.frames.posture(slot));
        judge_loaded(&mut self.problem, slot, &self.usual, &mut self.states);
    }

    fn values(&mut self, slot: usize) -> &[f64] {
        self.frames.load(slot, &mut self.problem);
        self.problem.pose_at(self.frames.posture(slot));
        let unknowns = self.usual.len();
        let states = &self.states[slot * unknowns..(slot + 1) * unknowns];
        for (c, (q, leader)) in self.q.iter_mut().zip(&self.leaders).enumerate() {
            *q = match leader {
                Leader::Nothing => self.defaults[c],
                Leader::Unknown(u) if states[*u] == Determination::Gap => f64::NAN,
                _ => self.problem.tree.values()[c],
            };
        }
        &self.q
    }
}
