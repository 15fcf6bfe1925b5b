//! Data of the live page: frames with their results, and events of the stream.
//!
//! The figure is shown as it was recorded, and its forces in the same frame, both after the delay. Nothing is computed
//! while no browser watches.

use super::page_server::PageServer;
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::Model;
use ambulo_report::page::{LiveFrame, LiveState};
use ambulo_report::quaternion;
use std::collections::VecDeque;

/// Frames shown per second.
const SHOWN_HZ: f64 = 50.0;

/// The live page of one sequence of frames.
pub(super) struct LiveView<'a> {
    server: &'a PageServer,
    model: &'a Model,
    rate_hz: f64,
    /// The newest frames that have no results yet, and their numbers.
    recent: VecDeque<(u64, Vec<f64>)>,
    /// Frames that are kept: frames within the delay.
    most: usize,
    lost: u64,
    is_running: bool,
}

impl<'a> LiveView<'a> {
    pub(super) fn new(server: &'a PageServer, model: &'a Model, rate_hz: f64, delay_frames: usize) -> LiveView<'a> {
        let (recent, most) = (VecDeque::new(), delay_frames + 1);
        LiveView { server, model, rate_hz, recent, most, lost: 0, is_running: false }
    }

    /// A frame has come.
    pub(super) fn arrived(&mut self, number: u64, q: &[f64]) {
        if !self.is_running {
            self.is_running = true;
            state(self.server, "running", "frames are coming in");
        }
        if self.recent.len() == self.most {
            self.recent.pop_front();
        }
        self.recent.push_back((number, q.to_vec()));
    }

    /// Frames have not come.
    pub(super) fn lost(&mut self, frames: u64) {
        self.lost += frames;
    }

    /// The results of a frame.
    pub(super) fn results(&mut self, frame: u64, values: &[f32]) {
        let stride = (self.rate_hz / SHOWN_HZ).ceil().max(1.0) as u64;
        if !frame.is_multiple_of(stride) || !self.server.is_watched() {
            return;
        }
        let q = self.recent.iter().find(|(number, _)| *number == frame).map(|(_, q)| q);
        let shown = LiveFrame {
            frame,
            time_s: frame as f64 / self.rate_hz,
            values: values.to_vec(),
            poses: q.map(|q| poses(self.model, q)).unwrap_or_default(),
            lost: self.lost,
        };
        // These structures have no keys that JSON refuses.
        self.server.publish("frame", &serde_json::to_string(&shown).unwrap_or_default());
    }

    /// The end of the frames.
    pub(super) fn ended(&mut self) {
        if self.is_running {
            state(self.server, "ended", "the stream has ended");
            self.server.finish();
        }
        self.is_running = false;
        self.recent.clear();
    }
}

/// Publishes what happens to the stream.
pub(super) fn state(server: &PageServer, state: &str, message: &str) {
    let shown = LiveState { state: state.to_owned(), message: message.to_owned() };
    server.publish_first("state", &serde_json::to_string(&shown).unwrap_or_default());
}

/// Position and orientation of every body; empty if a coordinate is missing.
fn poses(model: &Model, q: &[f64]) -> Vec<f32> {
    if q.iter().any(|value| !value.is_finite()) {
        return Vec::new();
    }
    let still = vec![0.0; q.len()];
    let bodies = body_motion(model, Posture { q, qd: &still, qdd: &still });
    let numbers = |body: &ambulo::kinematics::BodyMotion| {
        let (at, turn) = (body.pose.translation, quaternion(&body.pose.rotation));
        [at.x, at.y, at.z, turn[0], turn[1], turn[2], turn[3]].map(|number| number as f32)
    };
    bodies.iter().flat_map(numbers).collect()
}
