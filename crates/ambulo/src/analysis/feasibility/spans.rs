//! Joins frames beyond a limit to time spans.

use super::frame::CheckedValue;
use std::collections::VecDeque;

/// Consecutive frames beyond a limit, and the worst of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Span {
    pub(super) first: usize,
    pub(super) last: usize,
    pub(super) worst_at: usize,
    pub(super) worst: CheckedValue,
}

/// One check of one part of the body over time.
#[derive(Debug, Clone, Default)]
pub struct Track {
    pub(super) spans: Vec<Span>,
    /// Frame and value of the largest share that lasted long enough.
    pub closest: Option<(usize, CheckedValue)>,
    /// First and latest of the consecutive frames.
    run: Option<[usize; 2]>,
    /// Of the latest `lasting` of them, those with a smaller share than all after them: the first has the smallest.
    smallest: VecDeque<(usize, CheckedValue)>,
}

impl Track {
    /// Adds the value of the next frame. Fewer than `lasting` consecutive frames are noise.
    pub fn add(&mut self, frame: usize, measurement: CheckedValue, lasting: usize) {
        let first = match self.run {
            Some([first, last]) if last + 1 == frame => first,
            _ => {
                self.smallest.clear();
                frame
            }
        };
        self.run = Some([first, frame]);
        while self.smallest.back().is_some_and(|(_, before)| before.share.total_cmp(&measurement.share).is_gt()) {
            self.smallest.pop_back();
        }
        self.smallest.push_back((frame, measurement));
        while self.smallest.front().is_some_and(|(early, _)| early + lasting <= frame) {
            self.smallest.pop_front();
        }
        if let Some(&(at, m)) = self.smallest.front().filter(|_| frame + 1 - first >= lasting)
            && self.closest.is_none_or(|(_, closest)| m.share > closest.share)
        {
            self.closest = Some((at, m));
        }
        if measurement.share <= 1.0 {
            return;
        }
        match self.spans.last_mut() {
            Some(span) if span.last + 1 == frame => span.extend(frame, frame, measurement),
            _ => self.spans.push(Span { first: frame, last: frame, worst_at: frame, worst: measurement }),
        }
    }

    /// Joins spans with gaps shorter than `shortest_s` and drops spans that remain shorter. A span of one frame lasts
    /// one time step.
    pub(super) fn settled(&self, step_s: f64, shortest_s: f64) -> Vec<Span> {
        let mut joined: Vec<Span> = Vec::new();
        for span in &self.spans {
            match joined.last_mut() {
                Some(before) if ((span.first - before.last - 1) as f64) * step_s < shortest_s => {
                    before.extend(span.last, span.worst_at, span.worst);
                }
                _ => joined.push(*span),
            }
        }
        // Tolerance for rounding of the time step.
        joined.retain(|span| span.duration_s(step_s) > shortest_s * (1.0 - 1e-9));
        joined
    }
}

impl Span {
    fn extend(&mut self, last: usize, at: usize, measurement: CheckedValue) {
        self.last = last;
        if measurement.share > self.worst.share {
            (self.worst, self.worst_at) = (measurement, at);
        }
    }

    pub(super) fn duration_s(&self, step_s: f64) -> f64 {
        (self.last - self.first + 1) as f64 * step_s
    }
}
