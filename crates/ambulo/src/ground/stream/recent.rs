//! The last few seconds of a stream: as many frames as fit, the oldest forgotten first.

use super::StreamError;
use crate::model::{Drive, Model};
use crate::motion::Motion;

/// Frames of the free coordinates; the model itself knows the others.
#[derive(Debug, Clone)]
pub(super) struct Recent {
    motion: Motion,
    step_s: f64,
    most: usize,
    /// Number of the next frame, and the newest one without a gap.
    pub(super) next: usize,
    newest_complete: Option<usize>,
}

impl Recent {
    pub(super) fn new(model: &Model, rate_hz: f64, most: usize) -> Recent {
        let is_free = |drive: &Drive| matches!(drive, Drive::Free);
        let column = |drive: &Drive| is_free(drive).then(|| Vec::with_capacity(most));
        let motion = Motion {
            origin: "stream".to_owned(),
            times: Vec::with_capacity(most),
            columns: model.coordinates().iter().map(|c| column(&c.drive)).collect(),
        };
        Recent { motion, step_s: 1.0 / rate_hz, most, next: 0, newest_complete: None }
    }

    /// Takes a frame in, and the oldest one out when all places are taken.
    pub(super) fn push(&mut self, model: &Model, q: &[f64]) -> Result<(), StreamError> {
        let (frame, expected) = (self.next, model.coordinates().len());
        if q.len() != expected {
            return Err(StreamError::Length { frame, found: q.len(), expected, model: model.name().to_owned() });
        }
        let free = || model.coordinates().iter().zip(q).filter(|(c, _)| matches!(c.drive, Drive::Free));
        if let Some((coordinate, found)) = free().find(|(_, x)| x.is_infinite()) {
            return Err(StreamError::Infinite { coordinate: coordinate.name.clone(), frame, found: *found });
        }
        if free().all(|(_, x)| x.is_finite()) {
            self.newest_complete = Some(frame);
        }
        if self.motion.times.len() == self.most {
            self.forget(1);
        }
        self.motion.times.push(frame as f64 * self.step_s);
        for (column, value) in self.motion.columns.iter_mut().zip(q) {
            if let Some(column) = column {
                column.push(*value);
            }
        }
        self.next += 1;
        Ok(())
    }

    /// Frames since the newest one without a gap: 0 if that is the newest of all.
    pub(super) fn missing(&self) -> usize {
        self.newest_complete.map_or(self.next, |newest| self.next - 1 - newest)
    }

    pub(super) fn clear(&mut self) {
        self.forget(self.motion.times.len());
    }

    /// Forgets incomplete frames at the start: no spline reaches them.
    pub(super) fn forget_leading_gap(&mut self) {
        let columns = || self.motion.columns.iter().flatten();
        let is_complete = |&row: &usize| columns().all(|c| c[row].is_finite());
        let first = (0..self.motion.times.len()).find(is_complete);
        self.forget(first.unwrap_or(self.motion.times.len()));
    }

    fn forget(&mut self, rows: usize) {
        self.motion.times.drain(..rows);
        for column in self.motion.columns.iter_mut().flatten() {
            column.drain(..rows);
        }
    }

    pub(super) fn len(&self) -> usize {
        self.motion.times.len()
    }

    pub(super) fn motion(&self) -> &Motion {
        &self.motion
    }

    /// Time of a frame of the stream [s].
    pub(super) fn time(&self, number: usize) -> f64 {
        number as f64 * self.step_s
    }

    /// Bytes that the frames take, full or not.
    pub(super) fn bytes(&self) -> usize {
        let columns = self.motion.columns.iter().flatten().map(Vec::capacity).sum::<usize>();
        (self.motion.times.capacity() + columns) * size_of::<f64>()
    }
}
