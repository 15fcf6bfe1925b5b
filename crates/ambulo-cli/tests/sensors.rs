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
    for words in ["12 sensors turn the body", "by the bending of the knees", "sensors do not show where the person is"]
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
    refusals(&bench);
}

fn refusals(bench: &Workbench) {
    let refused = |words: &[&str], message: &[&str]| {
        bench.run(&[&["forces"], words, &["-o", "out"]].concat()).refused(message);
    };
    refused(
        &["walking.sto", "--mass", "75"],
        &["walking.sto", "expected --mass KG and --height M", "--model FILE.osim"],
    );
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
        &["--markers has no effect for orientations of sensors"],
    );
    refused(
        &with_model(&["demo/input/walk.mot", "--heading", "pelvis_imu:x"]),
        &["--heading is for orientations of sensors"],
    );
    refused(&["walking.sto", "--heading", "pelvis_imu"], &["expected SENSOR:AXIS"]);
    refused(&["walking.sto", "--earth", "-90,0"], &["expected X,Y,Z: three angles in degrees"]);
}
