//! The numbers of a glTF file: one buffer, a view of it and an accessor for each series.

use serde_json::{Value, json};

// Codes from the specification.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY: u32 = 34962;
const ELEMENTS: u32 = 34963;

/// All numbers as 32-bit floats and integers, little-endian.
#[derive(Debug, Default)]
pub(super) struct Buffer {
    data: Vec<u8>,
    pub(super) views: Vec<Value>,
    pub(super) accessors: Vec<Value>,
}

impl Buffer {
    pub(super) fn bytes(&self) -> &[u8] {
        &self.data
    }

    pub(super) fn length(&self) -> usize {
        self.data.len()
    }

    /// Corners of a mesh [m].
    pub(super) fn points(&mut self, points: &[[f64; 3]]) -> usize {
        self.floats(points, Some(ARRAY), true)
    }

    /// Normals of a mesh.
    pub(super) fn directions(&mut self, directions: &[[f64; 3]]) -> usize {
        self.floats(directions, Some(ARRAY), false)
    }

    /// Instants of an animation [s]; glTF requires their minimum and maximum.
    pub(super) fn times(&mut self, times: &[f64]) -> usize {
        let times: Vec<[f64; 1]> = times.iter().map(|time| [*time]).collect();
        self.floats(&times, None, true)
    }

    /// Values of an animation.
    pub(super) fn values<const N: usize>(&mut self, values: &[[f64; N]]) -> usize {
        self.floats(values, None, false)
    }

    /// Three corner indices per triangle.
    pub(super) fn indices(&mut self, triangles: &[[u32; 3]]) -> usize {
        let start = self.data.len();
        self.data.extend(triangles.iter().flatten().flat_map(|corner| corner.to_le_bytes()));
        let view = self.view(start, Some(ELEMENTS));
        self.accessors.push(json!({
            "bufferView": view, "componentType": UNSIGNED_INT, "count": 3 * triangles.len(), "type": "SCALAR",
        }));
        self.accessors.len() - 1
    }

    fn floats<const N: usize>(&mut self, rows: &[[f64; N]], target: Option<u32>, bounded: bool) -> usize {
        let start = self.data.len();
        let (mut low, mut high) = ([f32::INFINITY; N], [f32::NEG_INFINITY; N]);
        for row in rows {
            for (k, number) in row.iter().enumerate() {
                let number = *number as f32;
                (low[k], high[k]) = (low[k].min(number), high[k].max(number));
                self.data.extend(number.to_le_bytes());
            }
        }
        let view = self.view(start, target);
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"].get(N.wrapping_sub(1)).copied().unwrap_or("SCALAR");
        let mut accessor = json!({ "bufferView": view, "componentType": FLOAT, "count": rows.len(), "type": kind });
        if bounded {
            accessor["min"] = json!(low.to_vec());
            accessor["max"] = json!(high.to_vec());
        }
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// A view of what was added since `start`; all numbers have four bytes, so that every view begins at a multiple of
    /// four.
    fn view(&mut self, start: usize, target: Option<u32>) -> usize {
        let mut view = json!({ "buffer": 0, "byteOffset": start, "byteLength": self.data.len() - start });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.views.push(view);
        self.views.len() - 1
    }
}
