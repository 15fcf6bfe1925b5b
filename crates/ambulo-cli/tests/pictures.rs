//! Conversion of result folders to animations and to one table: they agree with the files of the folder.

use crate::workbench::Workbench;
use ambulo::spatial::Vec3;
use ambulo_formats::bvh::Bvh;
use ambulo_formats::table::Table;
use ambulo_formats::trc::Trc;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::OnceLock;

/// A folder with `demo`.
fn demo() -> &'static Workbench {
    static DEMO: OnceLock<Workbench> = OnceLock::new();
    DEMO.get_or_init(|| {
        let bench = Workbench::empty("pictures");
        bench.run(&["demo", "-o", "demo", "--quiet"]).done();
        bench
    })
}

/// An animated glTF file as a program reads it.
struct Animation {
    document: Value,
    numbers: Vec<u8>,
    /// The values of animated properties of nodes, one row per instant.
    tracks: BTreeMap<(usize, String), Vec<Vec<f64>>>,
    parents: Vec<Option<usize>>,
}

impl Animation {
    fn new(file: &[u8]) -> Animation {
        let size = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap()) as usize;
        let text = size(12);
        let document: Value = serde_json::from_slice(&file[20..20 + text]).unwrap();
        assert_eq!(document["asset"]["version"], "2.0");
        let numbers = file[28 + text..].to_vec();
        let (tracks, parents) = (BTreeMap::new(), Vec::new());
        let mut animation = Animation { document, numbers, tracks, parents };
        animation.tracks = animation.tracks();
        animation.parents = animation.parents();
        animation
    }

    fn tracks(&self) -> BTreeMap<(usize, String), Vec<Vec<f64>>> {
        let animation = &self.document["animations"][0];
        let track = |channel: &Value| {
            let (target, sampler) = (&channel["target"], channel["sampler"].as_u64().unwrap() as usize);
            let node = target["node"].as_u64().unwrap() as usize;
            let name = target["path"].as_str().unwrap().to_owned();
            ((node, name), self.rows(&animation["samplers"][sampler]["output"]))
        };
        animation["channels"].as_array().unwrap().iter().map(track).collect()
    }

    fn parents(&self) -> Vec<Option<usize>> {
        let nodes = self.document["nodes"].as_array().unwrap();
        let carries =
            |node: usize| move |other: &Value| other["children"].as_array().is_some_and(|c| c.contains(&json!(node)));
        (0..nodes.len()).map(|node| nodes.iter().position(carries(node))).collect()
    }

    fn rows(&self, accessor: &Value) -> Vec<Vec<f64>> {
        let accessor = &self.document["accessors"][accessor.as_u64().unwrap() as usize];
        let view = &self.document["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        let range = |key: &str| view[key].as_u64().unwrap() as usize;
        let bytes = &self.numbers[range("byteOffset")..range("byteOffset") + range("byteLength")];
        let floats: Vec<f64> =
            bytes.chunks(4).map(|four| f64::from(f32::from_le_bytes(four.try_into().unwrap()))).collect();
        floats.chunks(floats.len() / accessor["count"].as_u64().unwrap() as usize).map(<[f64]>::to_vec).collect()
    }

    fn node(&self, name: &str) -> usize {
        self.document["nodes"].as_array().unwrap().iter().position(|node| node["name"] == name).unwrap()
    }

    /// A property of a node at an instant.
    fn property(&self, node: usize, name: &str, instant: usize) -> Vec<f64> {
        match self.tracks.get(&(node, name.to_owned())) {
            Some(rows) => rows[instant].clone(),
            None => serde_json::from_value(self.document["nodes"][node][name].clone()).unwrap(),
        }
    }

    /// A point of a node in the world at an instant [m].
    fn place(&self, node: usize, point: Vec3, instant: usize) -> Vec3 {
        let origin = Vec3::from_column_slice(&self.property(node, "translation", instant));
        let q = self.property(node, "rotation", instant);
        let (axis, w) = (Vec3::new(q[0], q[1], q[2]), q[3]);
        // v + 2 w (u x v) + 2 u x (u x v)
        let across = axis.cross(&point);
        let outer = origin + point + across * (2.0 * w) + axis.cross(&across) * 2.0;
        self.parents[node].map_or(outer, |parent| self.place(parent, outer, instant))
    }

    /// Corners of a node's mesh [m].
    fn corners(&self, node: usize) -> Vec<Vec3> {
        let mesh = self.document["nodes"][node]["mesh"].as_u64().unwrap() as usize;
        let accessor = &self.document["meshes"][mesh]["primitives"][0]["attributes"]["POSITION"];
        self.rows(accessor).iter().map(|row| Vec3::from_column_slice(row)).collect()
    }
}

fn converted(bench: &Workbench, input: &str, output: &str) -> Vec<u8> {
    bench.run(&["convert", input, output, "--force"]).done();
    bench.read(output)
}

#[test]
fn drawn_feet_touch_the_ground_where_their_forces_act() {
    let bench = demo();
    let animation = Animation::new(&converted(bench, "demo", "feet.glb"));
    let forces = bench.table("demo/grf.mot");
    let column = |name: &str| forces.column(name).unwrap().to_vec();
    let (mut seen, mut worst) = (0, [0.0_f64; 3]);
    for side in ["r", "l"] {
        let vertical = column(&format!("ground_force_{side}_vy"));
        let [x, z] = ["x", "z"].map(|axis| column(&format!("ground_force_{side}_p{axis}")));
        let arrow = animation.node(if side == "r" { "force right" } else { "force left" });
        for instant in (0..vertical.len()).step_by(9) {
            let stretch = animation.property(arrow, "scale", instant)[1];
            if vertical[instant].abs() < f64::MIN_POSITIVE {
                assert!(stretch.abs() < f64::MIN_POSITIVE, "an arrow without a force");
                continue;
            }
            let force = ["vx", "vy", "vz"].map(|axis| column(&format!("ground_force_{side}_{axis}"))[instant]);
            assert!((stretch - 1e-3 * Vec3::from(force).norm()).abs() < 1e-6);
            let point = Vec3::from_column_slice(&animation.property(arrow, "translation", instant));
            assert!((point.x - x[instant]).abs() < 1e-6 && (point.z - z[instant]).abs() < 1e-6);
            let foot: Vec<Vec3> = ["calcn", "toes"]
                .into_iter()
                .map(|body| animation.node(&format!("{body}_{side}")))
                .flat_map(|node| animation.corners(node).into_iter().map(move |corner| (node, corner)))
                .map(|(node, corner)| animation.place(node, corner, instant))
                .collect();
            let [low, high] = [f64::min, f64::max].map(|pick| {
                let start = if pick(0.0, 1.0) < 0.5 { f64::INFINITY } else { f64::NEG_INFINITY };
                [0, 1, 2].map(|k| foot.iter().map(|corner| corner[k]).fold(start, pick))
            });
            seen += 1;
            worst[0] = worst[0].max(low[0] - point.x).max(point.x - high[0]);
            worst[1] = worst[1].max((low[1] - point.y).abs());
            worst[2] = worst[2].max(low[2] - point.z).max(point.z - high[2]);
        }
    }
    println!(
        "{seen} instants: beyond the foot {:.1} and {:.1} mm, height {:.1} mm",
        1e3 * worst[0],
        1e3 * worst[2],
        1e3 * worst[1]
    );
    // Soft shoes are compressed by up to 1.5 cm; forces act between heel and tip.
    assert!(seen > 40 && worst[0] < 0.005 && worst[1] < 0.025 && worst[2] < 0.005, "{worst:?}");
}

#[test]
fn an_animation_agrees_with_the_markers_of_the_same_walk() {
    let bench = demo();
    let animation = Animation::new(&converted(bench, "demo", "markers.glb"));
    let (markers, _) = Trc::read(&bench.read("demo/input/walk.trc")).unwrap();
    // Origins of these bodies are their joints, where the markers of the figure are.
    for (body, marker) in
        [("calcn_r", "ankle_r"), ("tibia_l", "knee_l"), ("femur_r", "hip_r"), ("forearm_l", "elbow_l")]
    {
        let path = &markers.marker(marker).unwrap().positions_m;
        let node = animation.node(body);
        for instant in (0..path.len()).step_by(29) {
            let found = animation.place(node, Vec3::zeros(), instant);
            // Files of markers have micrometres; five chained rotations of 32-bit floats.
            assert!((found - Vec3::from(path[instant])).norm() < 1e-5, "{body} at {instant}");
        }
    }
}

#[test]
fn the_long_table_has_the_numbers_of_the_files() {
    let bench = demo();
    let text = String::from_utf8(converted(bench, "demo", "results.csv")).unwrap();
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0], ["time", "quantity", "unit", "value"]);
    let of = |quantity: &str| -> Vec<&Vec<&str>> { rows.iter().filter(|row| row[1] == quantity).collect() };
    let same = |file: &str, quantity: &str, unit: &str| {
        let table: Table = bench.table(file);
        let found = of(quantity);
        assert_eq!(found.len(), table.rows(), "{quantity}");
        for ((row, value), time) in found.iter().zip(table.column(quantity).unwrap()).zip(table.times().unwrap()) {
            assert_eq!(row[2], unit, "{quantity}");
            assert_eq!(row[3].parse::<f64>().unwrap().to_bits(), value.to_bits(), "{quantity}");
            assert_eq!(row[0].parse::<f64>().unwrap().to_bits(), time.to_bits(), "{quantity}");
        }
    };
    same("demo/kinematics.mot", "knee_angle_r", "deg");
    same("demo/kinematics.mot", "pelvis_tx", "m");
    same("demo/moments.sto", "knee_angle_l_moment", "N.m");
    same("demo/moments.sto", "pelvis_ty_force", "N");
    same("demo/powers.sto", "ankle_angle_r_power", "W");
    same("demo/grf.mot", "ground_force_l_vy", "N");
    // An unloaded foot has no centre of pressure.
    let loaded =
        bench.table("demo/grf.mot").column("ground_force_r_vy").unwrap().iter().filter(|f| f.abs() > 0.0).count();
    assert_eq!((of("ground_force_r_px").len(), of("ground_torque_r_y").len()), (loaded, loaded));
    assert_eq!((of("ground_force_r_px")[0][2], of("ground_torque_r_y")[0][2]), ("m", "N.m"));
}

#[test]
fn a_folder_and_its_files_give_the_same_skeleton_and_animation() {
    let bench = demo();
    let folder = Bvh::read(&converted(bench, "demo", "folder.bvh")).unwrap().0;
    let model = ["--model", "demo/figure.osim", "--force"];
    bench.run(&[&["convert", "demo/kinematics.mot", "files.bvh"][..], &model].concat()).done();
    let files = Bvh::read(&bench.read("files.bvh")).unwrap().0;
    assert_eq!((folder.joints(), folder.frames()), (files.joints(), files.frames()));
    let worst = (0..folder.frames()).flat_map(|i| folder.frame(i).unwrap().iter().zip(files.frame(i).unwrap()));
    // The other way goes through a spline that reads its own knots.
    assert!(worst.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < 1e-6);
    bench.run(&[&["convert", "demo/kinematics.mot", "files.glb"][..], &model].concat()).done();
    let [folder, files] = ["folder.glb", "files.glb"].map(|name| {
        if name == "folder.glb" {
            converted(bench, "demo", name);
        }
        Animation::new(&bench.read(name))
    });
    for body in ["pelvis", "toes_l", "forearm_r"] {
        let place = |animation: &Animation| animation.place(animation.node(body), Vec3::new(0.1, 0.2, 0.3), 200);
        assert!((place(&folder) - place(&files)).norm() < 1e-5, "{body}");
    }
    let arrows = |animation: &Animation| animation.document.to_string().matches("\"force ").count();
    assert!(arrows(&folder) > 0 && arrows(&files) == 0);
}

#[test]
fn impossible_conversions_of_a_folder_are_rejected() {
    let bench = demo();
    bench
        .run(&["convert", "demo", "x.trc"])
        .refused(&["a result folder is converted to .glb, .bvh or .csv; found `.trc`"]);
    bench.run(&["convert", "demo", "x"]).refused(&["found a name without an extension"]);
    bench.run(&["convert", "demo", "x.glb", "--world"]).refused(&["--what, --world and --model are for files"]);
    std::fs::create_dir_all(bench.folder.join("empty")).unwrap();
    bench.run(&["convert", "empty", "x.glb"]).refused(&["empty: found no summary.json"]);
    bench.run(&["convert", "empty", "x.csv"]).refused(&["empty: found no summary.json"]);
    std::fs::create_dir_all(bench.folder.join("cut")).unwrap();
    for file in ["kinematics.mot", "summary.json", "grf.mot"] {
        bench.write(&format!("cut/{file}"), bench.read(&format!("demo/{file}")));
    }
    bench.run(&["convert", "cut", "x.glb"]).refused(&["cut/figure.osim: this file of the run is missing"]);
    bench.record("cut");
    bench.run(&["convert", "cut", "x.glb"]).refused(&["There is no body (subject.osim or figure.osim)"]);
    bench.write("cut/summary.json", bench.read("demo/summary.json"));
    bench.write("cut/figure.osim", &bench.read("demo/figure.osim")[..900]);
    bench.run(&["convert", "cut", "x.glb"]).refused(&["these files belong to two runs: figure.osim"]);
    bench.record("cut");
    bench.run(&["convert", "cut", "x.glb"]).refused(&["cut/figure.osim: "]);
    bench.write("cut/figure.osim", bench.read("demo/figure.osim"));
    let rows = bench.text("demo/grf.mot");
    bench.write("cut/grf.mot", rows.lines().take(100).collect::<Vec<_>>().join("\n") + "\n");
    bench.record("cut");
    bench.run(&["convert", "cut", "x.glb"]).refused(&["cut/grf.mot: "]);
    // The scale of the arrows is stated if there are arrows.
    std::fs::remove_file(bench.folder.join("cut/grf.mot")).unwrap();
    bench.record("cut");
    for (folder, arrows) in [("demo", true), ("cut", false)] {
        let said = bench.run(&["convert", folder, "said.glb", "--force"]).done();
        assert_eq!(said.stderr.contains("arrows are 1 m for 1000 N"), arrows, "{folder}: {}", said.stderr);
    }
    bench.write("x.glb", "mine");
    bench.run(&["convert", "demo", "x.glb"]).refused(&["x.glb: this file already exists"]);
}

#[test]
fn forces_of_coordinates_write_the_body_that_they_used() {
    let bench = demo();
    let recording = ["forces", "demo/input/walk.mot", "--model", "demo/input/figure.osim"];
    let forces = ["--grf", "demo/input/walk_grf.mot", "--loads", "demo/input/walk_grf.xml"];
    let rest = ["--add-mass", "torso:5", "-o", "carried", "--quiet"];
    bench.run(&[&recording[..], &forces, &rest].concat());
    let info = bench.run(&["info", "carried/subject.osim", "--json"]).done().stdout;
    let mass = serde_json::from_str::<Value>(&info).unwrap()["mass_kg"].as_f64().unwrap();
    assert!((mass - 80.0).abs() < 1e-9, "{mass}");
    // The body goes with the folder's own motion.
    let animation = Animation::new(&converted(bench, "carried", "carried.glb"));
    assert_eq!(animation.document["scenes"][0]["extras"]["units"], "m, s, N");
}

#[test]
fn a_scene_writes_its_shapes_and_becomes_an_animation() {
    let bench = Workbench::empty("pictures_scene");
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/stumble.toml");
    bench.write("stumble.toml", std::fs::read(example).unwrap());
    bench.run(&["simulate", "stumble.toml", "--duration", "0.3", "-o", "out", "--quiet"]);
    let shapes = bench.json("out/shapes.json");
    let documented = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/OUTPUTS.md");
    let documented = std::fs::read_to_string(documented).unwrap();
    for value in [&shapes, &shapes["bodies"][0], &shapes["obstacles"][0]] {
        for key in value.as_object().unwrap().keys() {
            assert!(documented.contains(&format!("`{key}`")), "{key} of shapes.json is not documented");
        }
    }
    let (bodies, obstacles) = (shapes["bodies"].as_array().unwrap(), shapes["obstacles"].as_array().unwrap());
    assert!(bodies.iter().all(|body| !body["shapes"].as_array().unwrap().is_empty()));
    assert!(obstacles.iter().any(|o| !o["planes"].as_array().unwrap().is_empty()), "the floor has no end");
    let animation = Animation::new(&converted(&bench, "out", "scene.glb"));
    let poses = bench.text("out/poses.csv");
    let cells: Vec<&str> = poses.lines().find(|line| line.starts_with("0.2,ann/tibia_r")).unwrap().split(',').collect();
    let place: Vec<f64> = cells[2..5].iter().map(|cell| cell.parse().unwrap()).collect();
    let found = animation.place(animation.node("ann/tibia_r"), Vec3::zeros(), 20);
    assert!((found - Vec3::from_column_slice(&place)).norm() < 1e-5, "{found} {place:?}");
    bench.run(&["convert", "out", "x.bvh"]).refused(&["a scene has no skeleton", ".glb or .csv"]);
}
