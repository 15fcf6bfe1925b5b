//! Orientations of sensors through the command: made from the demo's walk, for its model and for the built-in body.

use crate::segment_poses::quaternion;
use crate::workbench::Workbench;
use ambulo::findings::Findings;
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::{Model, from_osim};
use ambulo::motion::coordinates_from_table;
use ambulo::spatial::Mat3;
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::OrientationTable;

const BODIES: [&str; 12] = [
    "pelvis",
    "torso",
    "femur_r",
    "tibia_r",
    "calcn_r",
    "toes_r",
    "femur_l",
    "tibia_l",
    "calcn_l",
    "toes_l",
    "humerus_r",
    "humerus_l",
];

/// Sensors along the axes of the bodies, in an earth with z up.
fn sensors(model: &Model, times: &[f64], postures: &[Vec<f64>]) -> OrientationTable {
    let earth_from_world = Mat3::new(1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0);
    let rest = vec![0.0; model.coordinates().len()];
    let mut paths = vec![Vec::new(); BODIES.len()];
    for q in postures {
        let bodies = body_motion(model, Posture { q, qd: &rest, qdd: &rest });
        for (path, body) in paths.iter_mut().zip(BODIES) {
            let turn = earth_from_world * bodies[model.body(body).unwrap().index()].pose.rotation;
            path.push(Some(quaternion(&turn)));
        }
    }
    OrientationTable {
        rate_hz: Some(100.0),
        times: times.to_vec(),
        sensors: BODIES.map(|body| format!("{body}_imu")).into_iter().zip(paths).collect(),
        lines: Vec::new(),
    }
}

/// The demo, `walking.sto` from its walk and `standing.sto` from its model.
fn demo() -> Workbench {
    let bench = Workbench::empty("sensors");
    bench.run(&["demo", "-o", "demo", "--quiet"]).done();
    let document = OsimModel::read(&bench.read("demo/input/figure.osim")).unwrap();
    let model = from_osim(&document, &mut Findings::default()).unwrap();
    let walk = bench.table("demo/input/walk.mot");
    let motion = coordinates_from_table(&model, &walk, "walk.mot", &mut Findings::default()).unwrap();
    let posture = |frame: usize| -> Vec<f64> {
        motion.columns.iter().map(|column| column.as_ref().map_or(0.0, |column| column[frame])).collect()
    };
    let postures: Vec<Vec<f64>> = (0..motion.times.len()).map(posture).collect();
    let default: Vec<f64> = model.coordinates().iter().map(|coordinate| coordinate.default_value).collect();
    bench.write("walking.sto", sensors(&model, &motion.times, &postures).write().unwrap());
    bench.write("standing.sto", sensors(&model, &[0.0, 0.01], &[default.clone(), default]).write().unwrap());
    bench
}

#[test]
fn sensors_turn_a_model_or_the_built_in_body() {
    let bench = demo();
    let model = ["forces", "walking.sto", "--static", "standing.sto", "--model", "demo/input/figure.osim"];
    let run = bench.run(&[&model[..], &["-o", "model", "--verbose"]].concat());
    for words in
        ["the body follows 12 sensors", "by the bending of the knees", "sensors do not show where the person is"]
    {
        assert!(run.stderr.contains(words), "{words}: {}", run.stderr);
    }
    let summary = bench.json("model/summary.json");
    let reasons = summary["quality"]["reasons"].as_array().unwrap();
    assert!(reasons.iter().any(|reason| reason["measure"] == "derived_place"), "{reasons:?}");
    let (found, known) = (bench.table("model/kinematics.mot"), bench.table("demo/kinematics.mot"));
    let speed = |table: &ambulo_formats::table::Table| {
        let (x, t) = (table.column("pelvis_tx").unwrap(), table.times().unwrap());
        (x[x.len() - 1] - x[0]) / (t[t.len() - 1] - t[0])
    };
    println!("speed {:.3} m/s from sensors, {:.3} m/s in the demo", speed(&found), speed(&known));
    assert!((speed(&found) / speed(&known) - 1.0).abs() < 0.05);

    let built_in = ["forces", "walking.sto", "--static", "standing.sto", "--mass", "75", "--height", "1.75"];
    let run = bench.run(&[&built_in[..], &["--heading", "pelvis_imu:x", "-o", "built_in", "--verbose"]].concat());
    assert!(run.stderr.contains("by the axis x of `pelvis_imu`"), "{}", run.stderr);
    assert!(bench.table("built_in/kinematics.mot").column("knee_angle_r").is_some());

    let info = bench.run(&["info", "walking.sto"]).done();
    for words in ["orientations of sensors", "femur_r_imu", "next: ambulo forces walking.sto --static STANDING.sto"] {
        assert!(info.stdout.contains(words), "{words}: {}", info.stdout);
    }
    set_ups(&bench);
    refusals(&bench);
}

/// The set-ups of OpenSense's tools are the options; without a base sensor, the knees show the direction.
fn set_ups(bench: &Workbench) {
    let earth = "<sensor_to_opensim_rotations>-1.5707963267948966 0 0</sensor_to_opensim_rotations>";
    let placer = format!(
        "<OpenSimDocument Version=\"40000\"><IMUPlacer><model_file>../demo/input/figure.osim</model_file>{earth}\
         <orientation_file_for_calibration>../standing.sto</orientation_file_for_calibration>\
         <output_model_file>calibrated.osim</output_model_file></IMUPlacer></OpenSimDocument>"
    );
    let kinematics = format!(
        "<OpenSimDocument Version=\"40000\"><IMUInverseKinematicsTool><model_file>calibrated.osim</model_file>{earth}\
         <orientations_file>../walking.sto</orientations_file><time_range>-Inf \
         Inf</time_range></IMUInverseKinematicsTool></OpenSimDocument>"
    );
    std::fs::create_dir(bench.folder.join("setups")).unwrap();
    bench.write("setups/placer.xml", placer);
    bench.write("setups/imu.xml", kinematics);
    let both = ["forces", "--setup", "setups/placer.xml", "--setup", "setups/imu.xml"];
    let run = bench.run(&[&both[..], &["-o", "set_ups", "--verbose"]].concat());
    assert!(run.stderr.contains("calibrated.osim was not read; the model on which"), "{}", run.stderr);
    let (found, known) = (bench.table("set_ups/kinematics.mot"), bench.table("model/kinematics.mot"));
    for name in ["hip_flexion_r", "knee_angle_l", "pelvis_tx"] {
        let pairs = found.column(name).unwrap().iter().zip(known.column(name).unwrap());
        let off = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-5, "{name} {off}");
    }
    placed_sensors(bench);
    let refused = |words: &[&str], message: &[&str]| bench.run(&[&both[..], words].concat()).refused(message);
    refused(&["demo/input/walk.mot"], &["walk.mot", "imu.xml needs orientations of sensors"]);
    bench.write("setups/ik.xml", "<InverseKinematicsTool/>");
    refused(&["--setup", "setups/ik.xml"], &["imu.xml is for sensors, and another set-up is for markers"]);
    bench
        .run(&["forces", "walking.sto", "--setup", "setups/ik.xml", "--model", "demo/input/figure.osim"])
        .refused(&["walking.sto", "these are orientations of sensors; the set-up needs markers"]);
}

/// Inverse kinematics alone uses the sensors of its model, which another program placed; their heading is that of the
/// model.
fn placed_sensors(bench: &Workbench) {
    let mut model = bench.text("demo/input/figure.osim");
    for body in BODIES {
        let frame = format!(
            "<Body name=\"{body}\"><components><PhysicalOffsetFrame \
             name=\"{body}_imu\"><socket_parent>..</socket_parent>\
             <orientation>0 0 0</orientation></PhysicalOffsetFrame></components>"
        );
        assert!(model.contains(&format!("<Body name=\"{body}\">")), "{body}");
        model = model.replace(&format!("<Body name=\"{body}\">"), &frame);
    }
    bench.write("setups/calibrated.osim", model);
    bench.run(&["forces", "--setup", "setups/imu.xml", "--cutoff", "off", "-o", "placed"]).done();
    let (found, known) = (bench.table("placed/kinematics.mot"), bench.table("demo/input/walk.mot"));
    for name in ["hip_flexion_r", "knee_angle_l", "pelvis_rotation"] {
        let pairs = found.column(name).unwrap().iter().zip(known.column(name).unwrap());
        let off = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-3, "{name} {off}");
    }
}

fn refusals(bench: &Workbench) {
    let refused = |words: &[&str], message: &[&str]| {
        bench.run(&[&["forces"], words, &["-o", "out"]].concat()).refused(message);
    };
    refused(&["walking.sto", "--mass", "75"], &["walking.sto", "`--mass KG`, `--height M`", "`--model FILE.osim`"]);
    let model = ["--model", "demo/input/figure.osim"];
    let with_model = |words: &[&'static str]| -> Vec<&str> { [words, &model[..]].concat() };
    refused(
        &with_model(&["walking.sto", "--static", "demo/input/walk.mot"]),
        &["walk.mot", "expected orientations of sensors"],
    );
    refused(
        &with_model(&["walking.sto", "--static", "standing.sto", "--heading", "pelvis_imu:y"]),
        &["walking.sto", "the axis y of `pelvis_imu`", "hint: `--heading"],
    );
    refused(
        &with_model(&["standing.sto"]),
        &["standing.sto", "the direction forward is not known", "hint: `--heading"],
    );
    refused(
        &with_model(&["walking.sto", "--markers", "cmu"]),
        &["the marker set has no effect for orientations of sensors", "`--markers NAME|FILE`"],
    );
    refused(
        &with_model(&["demo/input/walk.mot", "--heading", "pelvis_imu:x"]),
        &["the heading is for orientations of sensors", "`--heading SENSOR:AXIS`"],
    );
    refused(&["walking.sto", "--heading", "pelvis_imu"], &["expected SENSOR:AXIS"]);
    refused(&["walking.sto", "--earth", "-90,0"], &["expected X,Y,Z: three angles in degrees"]);
}
