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
pub(super) struct Track {
    pub(super) spans: Vec<Span>,
    /// Frame and value of the largest share that lasted long enough.
    pub(super) closest: Option<(usize, CheckedValue)>,
    /// The latest consecutive frames, at most `lasting` of them.
    latest: VecDeque<(usize, CheckedValue)>,
}

impl Track {
    /// Adds the value of the next frame. Fewer than `lasting` consecutive frames are noise.
    pub(super) fn add(&mut self, frame: usize, measurement: CheckedValue, lasting: usize) {
        if self.latest.back().is_some_and(|(before, _)| before + 1 != frame) {
            self.latest.clear();
        }
        self.latest.push_back((frame, measurement));
        if self.latest.len() > lasting {
            self.latest.pop_front();
        }
        let lasted = self.latest.iter().min_by(|a, b| a.1.share.total_cmp(&b.1.share));
        if let Some(&(at, m)) = lasted.filter(|_| self.latest.len() == lasting)
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

    /// Joins spans with gaps shorter than `shortest_s` and drops spans that remain shorter. A span of one frame lasts one time step.
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
