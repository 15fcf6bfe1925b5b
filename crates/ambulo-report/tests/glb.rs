//! Reads the written file back.

use ambulo::model::Side;
use ambulo::motion::TimeGrid;
use ambulo::spatial::Vec3;
use ambulo_report::internals::{
    BodyPath, ForceRole, METRES_PER_NEWTON, Stage, StageBody, StageForce, StagePlate, Triangles, glb,
};
use ambulo_report::page::ViewShape;
use nalgebra::{Quaternion, UnitQuaternion};
use serde_json::Value;

const FRAMES: usize = 12;

/// A trunk that translates and rotates, with a swinging leg attached, over a plate, next to a stone; a force that acts
/// at times.
fn stage() -> Stage {
    let (mut trunk, mut leg) = (BodyPath::default(), BodyPath::default());
    for frame in 0..FRAMES {
        let t = frame as f64 * 0.1;
        let turn = UnitQuaternion::from_euler_angles(0.3 * t, 4.0 * t, -0.2 * t);
        let place = Vec3::new(1.3 * t, 0.9, 0.1 * t);
        trunk.push_turned(place, turn);
        let swing = turn * UnitQuaternion::from_axis_angle(&Vec3::z_axis(), t.sin());
        leg.push_turned(place + turn * Vec3::new(0.0, -0.4, 0.1), swing);
    }
    let body = |name: &str, parent: Option<usize>, side: Option<Side>, path: BodyPath| StageBody {
        name: name.into(),
        parent,
        side,
        shapes: vec![ViewShape::Capsule { from: [0.0; 3], to: [0.0, -0.4, 0.0], radius: 0.05 }],
        path,
        recorded: None,
    };
    let gap = Vec3::repeat(f64::NAN);
    let force = |frame: usize| if (4..8).contains(&frame) { Vec3::new(100.0, 700.0, -20.0) } else { gap };
    let point = |frame: usize| if (4..8).contains(&frame) { Vec3::new(0.1 * frame as f64, 0.0, 0.1) } else { gap };
    Stage {
        grid: TimeGrid { start_s: 1.5, step_s: 0.1, frames: FRAMES },
        bodies: vec![body("trunk", None, None, trunk), body("leg", Some(0), Some(Side::Right), leg)],
        fixed: vec![
            ViewShape::Box { center: [1.0, 0.1, 0.0], half: [0.2, 0.1, 0.3], turn: [0.0, 0.0, 0.0, 1.0] },
            ViewShape::Mesh { points: vec![[0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]], triangles: vec![[0, 1, 2]] },
        ],
        plates: vec![StagePlate {
            name: "plate 1".into(),
            corners: [[0.0, 0.0, 0.0], [0.0, 0.0, 0.5], [0.4, 0.0, 0.5], [0.4, 0.0, 0.0]],
        }],
        forces: vec![StageForce {
            name: "right".into(),
            side: Some(Side::Right),
            role: ForceRole::Main,
            point: (0..FRAMES).map(point).collect(),
            force: (0..FRAMES).map(force).collect(),
        }],
        torques: Vec::new(),
        contacts: Vec::new(),
        muscles: Vec::new(),
        floor_m: 0.0,
        weight_n: 700.0,
        missing: Vec::new(),
    }
}

/// A file taken apart.
struct Read {
    document: Value,
    numbers: Vec<u8>,
}

impl Read {
    fn new(file: &[u8]) -> Read {
        let word = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((&file[..4], word(4), word(8)), (&b"glTF"[..], 2, file.len()));
        let text = word(12);
        assert_eq!((&file[16..20], text % 4), (&b"JSON"[..], 0));
        let binary = 20 + text;
        assert_eq!((&file[binary + 4..binary + 8], word(binary) % 4), (&b"BIN\0"[..], 0));
        assert_eq!(binary + 8 + word(binary), file.len());
        Read { document: serde_json::from_slice(&file[20..binary]).unwrap(), numbers: file[binary + 8..].to_vec() }
    }

    /// Rows of an accessor of floats.
    fn rows(&self, accessor: usize) -> Vec<Vec<f64>> {
        let accessor = &self.document["accessors"][accessor];
        let view = &self.document["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        let (start, length) =
            (view["byteOffset"].as_u64().unwrap() as usize, view["byteLength"].as_u64().unwrap() as usize);
        let width = match accessor["type"].as_str().unwrap() {
            "SCALAR" => 1,
            "VEC3" => 3,
            _ => 4,
        };
        assert_eq!(length, 4 * width * accessor["count"].as_u64().unwrap() as usize);
        let floats: Vec<f64> = self.numbers[start..start + length]
            .chunks(4)
            .map(|bytes| f64::from(f32::from_le_bytes(bytes.try_into().unwrap())))
            .collect();
        floats.chunks(width).map(<[f64]>::to_vec).collect()
    }

    /// Values of a property of a node over time; the node's own where it is not animated.
    fn path(&self, node: usize, property: &str) -> Vec<Vec<f64>> {
        let animation = &self.document["animations"][0];
        let is_ours = |channel: &&Value| channel["target"]["node"] == node && channel["target"]["path"] == property;
        let channel = animation["channels"].as_array().unwrap().iter().find(is_ours);
        let Some(channel) = channel else {
            let own: Vec<f64> = serde_json::from_value(self.document["nodes"][node][property].clone()).unwrap();
            return vec![own; FRAMES];
        };
        let sampler = &animation["samplers"][channel["sampler"].as_u64().unwrap() as usize];
        assert_eq!(sampler["interpolation"], "LINEAR");
        self.rows(sampler["output"].as_u64().unwrap() as usize)
    }

    fn node(&self, name: &str) -> usize {
        self.document["nodes"].as_array().unwrap().iter().position(|node| node["name"] == name).unwrap()
    }

    fn place(&self, node: usize, frame: usize) -> (Vec3, UnitQuaternion<f64>) {
        let (translation, rotation) = (&self.path(node, "translation")[frame], &self.path(node, "rotation")[frame]);
        let [x, y, z, w] = rotation[..] else { panic!("{rotation:?}") };
        let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        (Vec3::from_column_slice(translation), turn)
    }
}

fn read() -> Read {
    Read::new(&glb(&stage(), "a walk").unwrap())
}

#[test]
fn bodies_move_as_on_the_stage() {
    let (read, stage) = (read(), stage());
    assert_eq!(read.document["nodes"][0]["children"], serde_json::json!([1]));
    for frame in 0..FRAMES {
        let ((origin, outer), (place, turn)) = (read.place(0, frame), read.place(1, frame));
        // 32-bit floats of numbers near one.
        assert!((origin - stage.bodies[0].path.position[frame]).norm() < 1e-6);
        assert!((origin + outer * place - stage.bodies[1].path.position[frame]).norm() < 1e-6, "{frame}");
        assert!((outer * turn).angle_to(&stage.bodies[1].path.rotation[frame]) < 1e-5);
    }
    // The leg hangs on one place of the trunk: nothing to animate.
    let channels = read.document["animations"][0]["channels"].as_array().unwrap();
    assert!(
        !channels.iter().any(|channel| channel["target"]["node"] == 1 && channel["target"]["path"] == "translation")
    );
}

#[test]
fn neighbouring_rotations_never_jump() {
    let read = read();
    for node in [0, 1, read.node("force right")] {
        for pair in read.path(node, "rotation").windows(2) {
            assert!(pair[0].iter().zip(&pair[1]).map(|(a, b)| a * b).sum::<f64>() > 0.0);
        }
    }
}

#[test]
fn an_arrow_starts_at_its_point_along_its_force_and_vanishes_without_force() {
    let (read, stage) = (read(), stage());
    let node = read.node("force right");
    let scale = read.path(node, "scale");
    for frame in 0..FRAMES {
        let (place, turn) = read.place(node, frame);
        if !(4..8).contains(&frame) {
            assert!(scale[frame].iter().all(|s| s.abs() < f64::MIN_POSITIVE), "{frame}");
            continue;
        }
        let tip = place + turn * Vec3::y() * scale[frame][1];
        let force = stage.forces[0].force[frame];
        assert!((place - stage.forces[0].point[frame]).norm() < 1e-6);
        assert!((tip - place - force * METRES_PER_NEWTON).norm() < 1e-6);
    }
}

#[test]
fn bounds_are_those_of_the_numbers_and_normals_are_units() {
    let read = read();
    let time = read.document["animations"][0]["samplers"][0]["input"].as_u64().unwrap() as usize;
    let times = read.rows(time);
    assert!(times[0][0].abs() < f64::MIN_POSITIVE && (times[FRAMES - 1][0] - 1.1).abs() < 1e-6);
    let mut bounded = 0;
    for (number, accessor) in read.document["accessors"].as_array().unwrap().iter().enumerate() {
        let Some(low) = accessor["min"].as_array() else { continue };
        let rows = read.rows(number);
        for (k, bound) in low.iter().enumerate() {
            let found = rows.iter().map(|row| row[k]).fold(f64::INFINITY, f64::min);
            assert!((found - bound.as_f64().unwrap()).abs() < f64::MIN_POSITIVE, "{found} {bound}");
            let found = rows.iter().map(|row| row[k]).fold(f64::NEG_INFINITY, f64::max);
            assert!((found - accessor["max"][k].as_f64().unwrap()).abs() < f64::MIN_POSITIVE);
        }
        bounded += 1;
    }
    let meshes = read.document["meshes"].as_array().unwrap();
    assert_eq!((meshes.len(), bounded), (6, 7));
    for mesh in meshes {
        let normals = read.rows(mesh["primitives"][0]["attributes"]["NORMAL"].as_u64().unwrap() as usize);
        assert!(normals.iter().all(|n| (n.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-5), "{mesh}");
    }
}

/// Twice the surface, as a vector sum, is zero; the volume inside is positive where triangles face outwards.
#[test]
fn round_and_square_shapes_face_outwards() {
    let shapes = [
        (ViewShape::Capsule { from: [0.1, 0.2, 0.3], to: [0.4, -0.2, 0.3], radius: 0.1 }, 0.0199),
        (ViewShape::Capsule { from: [0.1; 3], to: [0.1; 3], radius: 0.2 }, 0.0335),
        (ViewShape::Box { center: [1.0, 0.0, 0.0], half: [0.1, 0.2, 0.3], turn: [0.0, 0.6, 0.0, 0.8] }, 0.048),
    ];
    for (shape, expected) in shapes {
        let triangles = Triangles::of_shape(&shape);
        let at = |corner: u32| Vec3::from(triangles.points[corner as usize]);
        let sixth = |[a, b, c]: &[u32; 3]| at(*a).dot(&at(*b).cross(&at(*c))) / 6.0;
        let volume: f64 = triangles.corners.iter().map(sixth).sum();
        // Sixteen sides instead of a circle enclose 3 to 8 % less.
        assert!(volume > 0.9 * expected && volume < 1.01 * expected, "{shape:?}: {volume}");
        let outward = triangles.corners.iter().all(|[a, b, c]| {
            let facing = (at(*b) - at(*a)).cross(&(at(*c) - at(*a)));
            facing.dot(&Vec3::from(triangles.normals[*a as usize])) > -1e-9
        });
        assert!(outward, "{shape:?}");
    }
}
