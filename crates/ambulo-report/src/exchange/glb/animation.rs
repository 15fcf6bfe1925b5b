//! The animation of a glTF file: translation, rotation and scale of each moving node over time, linear between
//! instants.

use super::buffer::Buffer;
use serde_json::{Value, json};

/// A value that changes by less than this [m, or quaternion component] is stored in the node and not animated.
const STILL: f64 = 1e-9;

/// Channels under construction.
#[derive(Debug, Default)]
pub(super) struct Animation {
    time: usize,
    channels: Vec<Value>,
    samplers: Vec<Value>,
}

impl Animation {
    /// The instants of all channels [s].
    pub(super) fn time(&mut self, times: &[f64], buffer: &mut Buffer) {
        self.time = buffer.times(times);
    }

    /// Sets the first pose of the node with this number and adds its path.
    pub(super) fn place(
        &mut self,
        number: usize,
        node: &mut Value,
        translation: &[[f64; 3]],
        rotation: &[[f64; 4]],
        buffer: &mut Buffer,
    ) {
        self.channel(number, node, "translation", translation, buffer);
        self.channel(number, node, "rotation", rotation, buffer);
    }

    /// One property of a node over time, one row per instant.
    pub(super) fn channel<const N: usize>(
        &mut self,
        number: usize,
        node: &mut Value,
        path: &str,
        rows: &[[f64; N]],
        buffer: &mut Buffer,
    ) {
        let Some(first) = rows.first() else { return };
        node[path] = json!(first.to_vec());
        let moves = |row: &[f64; N]| row.iter().zip(first).any(|(a, b)| (a - b).abs() > STILL);
        // glTF requires at least one channel in an animation.
        if !rows.iter().any(moves) && !self.channels.is_empty() {
            return;
        }
        let output = buffer.values(rows);
        self.channels.push(json!({ "sampler": self.samplers.len(), "target": { "node": number, "path": path } }));
        self.samplers.push(json!({ "input": self.time, "output": output, "interpolation": "LINEAR" }));
    }

    /// The animation; `None` without channels.
    pub(super) fn described(&self) -> Option<Value> {
        let animation = || json!({ "name": "motion", "channels": self.channels, "samplers": self.samplers });
        (!self.channels.is_empty()).then(animation)
    }
}
