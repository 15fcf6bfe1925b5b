//! Bounds the time of a fit by the number of its linear solves, each of which takes about 6.5 µs for a full body of 43
//! unknowns.
//!
//! A frame with all its markers takes about five solves; later frames may use those that it does not need. Swapped
//! labels, jumps and gaps take more; frames for which nothing is left are reported.
//!
//! Pinned by: tests/marker_outliers.rs

/// Solves to find the posture of the first frame from nothing: placements of the rigid model and fits of the best.
/// Recordings without faults take some hundred; starts joint by joint or with labels that are swapped take more.
const TO_BEGIN: usize = 3200;
/// To find the posture again after a gap.
const TO_BEGIN_AGAIN: usize = 800;
/// Largest number of solves that the first frame does not need and that later frames may then use.
const LEFT_OF_BEGINNING: usize = 2800;
/// Solves per frame while frames are fitted one after the other: what the detection of jumps may take, so that the body
/// is not lost.
const PER_FRAME: usize = 26;
/// Solves per frame for what follows, besides those that were not needed: misplaced markers, and frames that lack
/// markers.
const PER_FRAME_AFTERWARDS: usize = 6;
/// Solves that the detection of jumps leaves for the fit of the same frame.
const RESERVE: usize = 8;
/// Share of the remaining solves that frames without all markers may use for their offsets; what follows needs the
/// others.
const SHARE_OF_OFFSETS: f64 = 0.7;
/// Where the part of a frame is larger than most frames need, one frame may take several parts.
const LARGE_PART: f64 = 60.0;
const TIMES_LARGE_PART: f64 = 8.0;

/// Linear solves that a fit may still take.
#[derive(Debug, Clone, Default)]
pub(super) struct Budget {
    spent: usize,
    granted: usize,
    set_aside: usize,
    /// Frames among which the rest is divided.
    parts: usize,
}

impl Budget {
    /// Enough for the first frame.
    pub(super) fn to_begin() -> Budget {
        Budget { granted: TO_BEGIN, ..Budget::default() }
    }

    pub(super) fn spend_one(&mut self) {
        self.spent += 1;
    }

    /// Number of solves so far.
    pub(super) fn spent(&self) -> usize {
        self.spent
    }

    pub(super) fn left(&self) -> usize {
        self.granted.saturating_sub(self.spent)
    }

    pub(super) fn is_spent(&self) -> bool {
        self.left() == 0
    }

    /// Enough for another first frame, whatever the frames before it took. Returns what they left.
    pub(super) fn begin_again(&mut self) -> usize {
        let left = self.left();
        self.granted = self.spent + TO_BEGIN;
        left
    }

    /// Leaves as much as there was before [`Budget::begin_again`].
    pub(super) fn go_on_with(&mut self, left: usize) {
        self.granted = self.spent + left;
    }

    /// The posture of the first frame is found.
    pub(super) fn end_beginning(&mut self) {
        self.limit_rest();
    }

    /// Adds what one more frame may take.
    pub(super) fn grant_frame(&mut self) {
        self.granted += PER_FRAME;
    }

    /// Limits what was not needed so far, so that a frame of an endless stream takes no longer than one of a recording.
    pub(super) fn limit_rest(&mut self) {
        self.granted = self.spent + self.left().min(LEFT_OF_BEGINNING);
    }

    /// Adds what all frames may take after each was fitted once.
    pub(super) fn grant_afterwards(&mut self, frames: usize) {
        self.granted += PER_FRAME_AFTERWARDS * frames;
    }

    /// Whether the posture can be searched for again after a gap.
    pub(super) fn allows_search(&self) -> bool {
        self.left() >= TO_BEGIN_AGAIN
    }

    /// Keeps a reserve back until [`Budget::release`].
    pub(super) fn reserve(&mut self) {
        self.keep_back(RESERVE);
    }

    /// Divides the rest among this number of frames.
    pub(super) fn divide(&mut self, frames: usize) {
        self.parts = frames;
    }

    /// Keeps everything back until [`Budget::release`], except the part of the next frame.
    pub(super) fn open_part(&mut self) {
        let rest = SHARE_OF_OFFSETS * self.left() as f64;
        let part = rest / self.parts.max(1) as f64;
        let part = if part > LARGE_PART { (TIMES_LARGE_PART * part).min(rest) } else { part };
        self.parts = self.parts.saturating_sub(1);
        self.keep_back(self.left() - part as usize);
    }

    /// Gives back what was kept back.
    pub(super) fn release(&mut self) {
        self.granted += std::mem::take(&mut self.set_aside);
    }

    fn keep_back(&mut self, solves: usize) {
        let kept = solves.min(self.left());
        self.granted -= kept;
        self.set_aside += kept;
    }
}
