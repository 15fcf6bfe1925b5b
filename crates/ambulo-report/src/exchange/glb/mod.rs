//! A stage as an animated glTF 2.0 file in its binary form (`.glb`): bodies as nodes with meshes, their paths as an
//! animation, ground forces as arrows that move, turn and grow.
//!
//! Metres, seconds, newtons; x forward, y up, z right, as in all files of this program (glTF itself only requires y up
//! for a scene that is not an asset). Times begin at zero. Nodes of bodies are nested as in the model; their
//! translation and rotation are relative to the parent. An arrow of 1000 N is one metre long; its scale is zero while
//! its force does not act.
//!
//! Source: Khronos glTF 2.0 specification (sections 3.6 data, 3.11 animations, 4 GLB container; unverified).

mod animation;
mod arrow;
mod buffer;
mod container;
mod material;
pub(crate) mod mesh;

use crate::stage::{BodyPath, Stage, StageBody, StagePlate};
use animation::Animation;
use buffer::Buffer;
use material::Paint;
use mesh::Triangles;
use serde_json::{Value, json};

/// Length of an arrow for its force [m/N].
pub const METRES_PER_NEWTON: f64 = 1e-3;

/// Builds the file.
#[derive(Default)]
struct GlbBuilder {
    buffer: Buffer,
    nodes: Vec<Value>,
    meshes: Vec<Value>,
    animation: Animation,
    /// Nodes without a parent.
    roots: Vec<usize>,
}

/// The stage as bytes of a `.glb` file.
///
/// # Errors
/// Data that JSON cannot store.
pub fn glb(stage: &Stage, name: &str) -> Result<Vec<u8>, serde_json::Error> {
    let mut builder = GlbBuilder::default();
    let times: Vec<f64> = (0..stage.grid.frames).map(|frame| stage.grid.step_s * frame as f64).collect();
    builder.animation.time(&times, &mut builder.buffer);
    builder.add_bodies(stage);
    arrow::add(stage, &mut builder);
    builder.add_still(stage);
    container::file(&builder.document(stage, name), builder.buffer.bytes())
}

impl GlbBuilder {
    /// Adds nodes of all bodies in order, so that the index of a body equals the index of its node.
    fn add_bodies(&mut self, stage: &Stage) {
        for (number, body) in stage.bodies.iter().enumerate() {
            let mut node = json!({ "name": body.name });
            let triangles = body.shapes.iter().map(Triangles::of_shape).fold(Triangles::default(), Triangles::with);
            if let Some(mesh) = self.mesh(&body.name, &triangles, Paint::of_side(body.side)) {
                node["mesh"] = json!(mesh);
            }
            let parent = body.parent.and_then(|parent| stage.bodies.get(parent));
            let (translation, rotation) = path_in(parent, body);
            self.animation.place(number, &mut node, &translation, &rotation, &mut self.buffer);
            let carried: Vec<usize> =
                stage.bodies.iter().enumerate().filter(|(_, b)| b.parent == Some(number)).map(|(i, _)| i).collect();
            if !carried.is_empty() {
                node["children"] = json!(carried);
            }
            if body.parent.is_none() {
                self.roots.push(number);
            }
            self.nodes.push(node);
        }
    }

    /// Adds plates and fixed shapes.
    fn add_still(&mut self, stage: &Stage) {
        let plates = stage.plates.iter().map(plate);
        let fixed = stage.fixed.iter().map(Triangles::of_shape).enumerate();
        let fixed = fixed.map(|(i, triangles)| (format!("obstacle {}", i + 1), triangles, Paint::Still));
        for (name, triangles, paint) in plates.chain(fixed).collect::<Vec<_>>() {
            if let Some(mesh) = self.mesh(&name, &triangles, paint) {
                self.add_root(json!({ "name": name, "mesh": mesh }));
            }
        }
    }

    /// Adds a node without a parent.
    fn add_root(&mut self, node: Value) -> usize {
        self.roots.push(self.nodes.len());
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    /// Adds a mesh; `None` without triangles.
    fn mesh(&mut self, name: &str, triangles: &Triangles, paint: Paint) -> Option<usize> {
        if triangles.corners.is_empty() {
            return None;
        }
        let position = self.buffer.points(&triangles.points);
        let normal = self.buffer.directions(&triangles.normals);
        let indices = self.buffer.indices(&triangles.corners);
        let primitive = json!({
            "attributes": { "POSITION": position, "NORMAL": normal },
            "indices": indices,
            "material": paint as usize,
        });
        self.meshes.push(json!({ "name": name, "primitives": [primitive] }));
        Some(self.meshes.len() - 1)
    }

    fn document(&self, stage: &Stage, name: &str) -> Value {
        let mut document = json!({
            "asset": { "version": "2.0", "generator": concat!("ambulo ", env!("CARGO_PKG_VERSION")) },
            "scene": 0,
            "scenes": [{
                "name": name,
                "nodes": self.roots,
                "extras": {
                    "axes": "x forward, y up, z right",
                    "units": "m, s, N",
                    "start_s": stage.grid.start_s,
                    "rate_hz": if stage.grid.step_s > 0.0 { json!(1.0 / stage.grid.step_s) } else { Value::Null },
                    "metres_per_newton": METRES_PER_NEWTON,
                    "weight_n": stage.weight_n,
                    "floor_m": stage.floor_m,
                },
            }],
            "nodes": self.nodes,
            "materials": material::all(),
            "accessors": self.buffer.accessors,
            "bufferViews": self.buffer.views,
            "buffers": [{ "byteLength": self.buffer.length() }],
        });
        if let Some(animation) = self.animation.described() {
            document["animations"] = json!([animation]);
        }
        if !self.meshes.is_empty() {
            document["meshes"] = json!(self.meshes);
        }
        document
    }
}

/// The path of a body relative to its parent, or to the world.
fn path_in(parent: Option<&StageBody>, body: &StageBody) -> (Vec<[f64; 3]>, Vec<[f64; 4]>) {
    let mut local = BodyPath::default();
    for (instant, (place, turn)) in body.path.position.iter().zip(&body.path.rotation).enumerate() {
        match parent {
            Some(parent) => {
                let (outer, origin) = (parent.path.rotation[instant].inverse(), parent.path.position[instant]);
                local.push_turned(outer * (place - origin), outer * turn);
            }
            None => local.push_turned(*place, *turn),
        }
    }
    (
        local.position.iter().map(|place| (*place).into()).collect(),
        local.rotation.iter().map(|turn| turn.coords.into()).collect(),
    )
}

fn plate(plate: &StagePlate) -> (String, Triangles, Paint) {
    (plate.name.clone(), Triangles::sheet(&plate.corners), Paint::Plate)
}
