//! From instants beyond a limit to times beyond it.

use super::frame::Measurement;
use std::collections::VecDeque;

/// Frames in a row beyond a limit, and the worst of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Span {
    pub(super) first: usize,
    pub(super) last: usize,
    pub(super) worst_at: usize,
    pub(super) worst: Measurement,
}

/// What one measured thing did over time.
#[derive(Debug, Clone, Default)]
pub(super) struct Track {
    pub(super) spans: Vec<Span>,
    /// Frame and value of the largest share that lasted.
    pub(super) closest: Option<(usize, Measurement)>,
    /// The latest frames in a row, at most as many as make a time that counts.
    latest: VecDeque<(usize, Measurement)>,
}

impl Track {
    /// Takes the measurement of a frame; frames come in order. Shorter than `lasting` frames in a row is noise.
    pub(super) fn add(&mut self, frame: usize, measurement: Measurement, lasting: usize) {
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

    /// Closes breaks shorter than `shortest_s` and drops spans that remain shorter. A span of one frame lasts one step.
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
        // Rounding of a step must not decide.
        joined.retain(|span| span.duration_s(step_s) > shortest_s * (1.0 - 1e-9));
        joined
    }
}

impl Span {
    fn extend(&mut self, last: usize, at: usize, measurement: Measurement) {
        self.last = last;
        if measurement.share > self.worst.share {
            (self.worst, self.worst_at) = (measurement, at);
        }
    }

    pub(super) fn duration_s(&self, step_s: f64) -> f64 {
        (self.last - self.first + 1) as f64 * step_s
    }
}
