//! OpenSim's own files around a model: sets of markers and set-ups of its tools.

use crate::shared_data::data;
use crate::workbench::{Run, Workbench};
use ambulo::analysis::{Curve, compare};
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;
use std::sync::OnceLock;

/// A folder with the files of a laboratory that works with OpenSim: a model without markers (`bare.osim`), its markers
/// (`markers.xml`), and the files that `demo` writes.
fn laboratory(name: &str) -> Workbench {
    static DEMO: OnceLock<Workbench> = OnceLock::new();
    let made = DEMO.get_or_init(|| {
        let bench = Workbench::empty("opensim_setup_demo");
        bench.run(&["demo", "-o", "demo", "--quiet"]).done();
        bench
    });
    let bench = Workbench::empty(name);
    for file in ["figure.osim", "walk.trc", "walk.mot", "walk_grf.mot", "walk_grf.xml", "standing.c3d"] {
        bench.write(file, made.read(&format!("demo/input/{file}")));
    }
    let model = OsimModel::read(&bench.read("figure.osim")).unwrap();
    bench.write("markers.xml", marker_set(&model));
    bench.write("bare.osim", OsimModel { markers: Vec::new(), ..model }.write().unwrap());
    bench
}

/// The markers of a model as a document of OpenSim 3.
fn marker_set(model: &OsimModel) -> String {
    let marker = |m: &ambulo_formats::osim::OsimMarker| {
        let [x, y, z] = m.location_m;
        format!(
            "<Marker name=\"{}\"><body> {} </body><location> {x} {y} {z} </location><fixed> {} </fixed></Marker>\n",
            m.name, m.body, m.fixed
        )
    };
    let markers: String = model.markers.iter().map(marker).collect();
    format!(
        "<OpenSimDocument Version=\"30000\"><MarkerSet \
         name=\"set\"><objects>\n{markers}</objects></MarkerSet></OpenSimDocument>"
    )
}

fn forces(bench: &Workbench, more: &[&str]) -> Run {
    bench.run(&[&["forces"], more, &["--keep", "moments,kinematics"]].concat())
}

#[test]
fn markers_of_a_file_of_their_own_give_the_moments_of_the_markers_in_the_model() {
    let bench = laboratory("marker_set");
    forces(&bench, &["walk.trc", "--model", "figure.osim", "--loads", "walk_grf.xml", "-o", "own"]).done();
    let with_set = ["walk.trc", "--model", "bare.osim", "--marker-set", "markers.xml"];
    forces(&bench, &[&with_set[..], &["--loads", "walk_grf.xml", "-o", "set"]].concat()).done();
    assert_eq!(bench.text("own/moments.sto"), bench.text("set/moments.sto"));
    // A marker 50 mm away from its place changes the moments.
    let text = bench.text("markers.xml");
    let line = text.lines().find(|line| line.contains("> femur_r <")).unwrap();
    let (head, rest) = line.split_once("<location>").unwrap();
    let (_, tail) = rest.split_once("</location>").unwrap();
    let moved = format!("{head}<location>0.05 0 0</location>{tail}");
    bench.edit("markers.xml", line, &moved);
    forces(&bench, &[&with_set[..], &["--loads", "walk_grf.xml", "-o", "moved"]].concat()).done();
    assert_ne!(bench.text("own/moments.sto"), bench.text("moved/moments.sto"));
}

#[test]
fn a_marker_set_without_a_model_or_markers_is_refused() {
    let bench = laboratory("marker_set_alone");
    let set = ["--marker-set", "markers.xml"];
    forces(&bench, &[&["walk.trc"][..], &set].concat()).refused(&["`--marker-set FILE`", "`--model FILE.osim`"]);
    forces(&bench, &[&["walk.mot", "--model", "figure.osim"][..], &set].concat()).refused(&[
        "walk.mot",
        "can only be used with markers",
        "`--marker-set FILE`",
    ]);
    bench.edit("markers.xml", "> pelvis <", "> hip <");
    forces(&bench, &[&["walk.trc", "--model", "bare.osim"][..], &set].concat()).refused(&[
        "markers.xml",
        "line ",
        "`hip`, which the model",
        "one of its bodies: pelvis",
    ]);
}

// ---- Small set-ups ----

/// A set-up of inverse dynamics in a folder beside the files of the laboratory.
fn dynamics(more: &str) -> String {
    format!(
        "<OpenSimDocument Version=\"30000\"><InverseDynamicsTool name=\"walk\"><model_file>../figure.osim</model_file>\
         <time_range> 0.5 1.5 </time_range><coordinates_file>..\\walk.mot</coordinates_file>\
         <lowpass_cutoff_frequency_for_coordinates>6</lowpass_cutoff_frequency_for_coordinates>\
         {more}</InverseDynamicsTool></OpenSimDocument>"
    )
}

fn kinematics(more: &str) -> String {
    format!(
        "<InverseKinematicsTool \
         name=\"walk\"><model_file>../figure.osim</model_file><marker_file>../walk.trc</marker_file>\
         {more}</InverseKinematicsTool>"
    )
}

const LOADS: &str =
    "<external_loads_file>../walk_grf.xml</external_loads_file><forces_to_exclude>ALL</forces_to_exclude>";
const SCALE: &str = "<ScaleTool \
    name=\"s\"><mass>70</mass><GenericModelMaker><model_file>../figure.osim</model_file></GenericModelMaker>\
    <ModelScaler><apply>false</apply></ModelScaler><MarkerPlacer><marker_file>../standing.c3d</marker_file>\
    </MarkerPlacer></ScaleTool>";

fn laboratory_with_setups(name: &str) -> Workbench {
    let bench = laboratory(name);
    std::fs::create_dir(bench.folder.join("setups")).unwrap();
    bench.write("setups/id.xml", dynamics(LOADS));
    bench.write("setups/ik.xml", kinematics(""));
    bench.write("setups/scale.xml", SCALE);
    bench
}

/// The codes and messages of the findings of a run.
fn findings(bench: &Workbench, folder: &str) -> Vec<(String, String)> {
    let summary = bench.json(&format!("{folder}/summary.json"));
    let text = |finding: &serde_json::Value, key: &str| finding[key].as_str().unwrap().to_owned();
    summary["findings"].as_array().unwrap().iter().map(|f| (text(f, "code"), text(f, "message"))).collect()
}

#[track_caller]
fn assert_found(bench: &Workbench, folder: &str, code: &str, words: &str) {
    let found = findings(bench, folder);
    assert!(found.iter().any(|(c, m)| c == code && m.contains(words)), "no {code} with `{words}`: {found:#?}");
}

#[test]
fn a_set_up_of_inverse_dynamics_is_the_command_with_its_files_and_settings() {
    let bench = laboratory_with_setups("setup_id");
    let by_options = ["walk.mot", "--model", "figure.osim", "--loads", "walk_grf.xml", "--from", "0.5", "--to", "1.5"];
    forces(&bench, &[&by_options[..], &["--cutoff", "6", "--force-cutoff", "off", "-o", "options"]].concat()).done();
    // The set-up excludes all forces of the model, also a strap between thigh and shank.
    let strap = "<ForceSet><objects><BushingForce name=\"strap\"><socket_frame1>/bodyset/femur_r</socket_frame1>\
        <socket_frame2>/bodyset/tibia_r</socket_frame2><rotational_stiffness>50 50 \
        50</rotational_stiffness></BushingForce></objects></ForceSet></Model>";
    bench.edit("figure.osim", "</Model>", strap);
    forces(&bench, &["--setup", "setups/id.xml", "-o", "setup"]).done();
    assert_eq!(bench.text("options/moments.sto"), bench.text("setup/moments.sto"));
    assert!(findings(&bench, "setup").iter().all(|(code, _)| code != "model.bushing"));
    // An option replaces what the set-up states.
    forces(&bench, &["--setup", "setups/id.xml", "--cutoff", "10", "--to", "1.2", "-o", "other"]).done();
    assert_ne!(bench.text("options/moments.sto"), bench.text("other/moments.sto"));
    assert_found(&bench, "other", "setup.replaced", "cut-off 10 replaces 6 of the set-up");
    assert_found(&bench, "other", "setup.replaced", "end 1.2 replaces 1.5 of the set-up");
    // Without loads nothing acts but gravity: the whole weight is residual.
    bench.write("setups/id.xml", dynamics("<colour>blue</colour>"));
    forces(&bench, &["--setup", "setups/id.xml", "-o", "flight"]).done();
    let weight = bench.table("flight/moments.sto").column("pelvis_ty_force").unwrap().to_vec();
    assert!(weight.iter().sum::<f64>() / weight.len() as f64 > 500.0);
    assert_found(&bench, "flight", "setup.unused", "names no external loads");
    assert_found(&bench, "flight", "setup.unused", "the element <colour> is not known");
    assert_found(&bench, "flight", "setup.unused", "forces of the model");
    assert_found(&bench, "flight", "model.bushing", "`strap` between `femur_r` and `tibia_r`");
}

#[test]
fn inverse_kinematics_and_dynamics_are_one_run() {
    let bench = laboratory_with_setups("setup_ik_id");
    // The points of the demo are joint centres like keypoints, which are fitted together unless a set-up asks for
    // OpenSim's fit.
    let by_options = ["walk.trc", "--model", "figure.osim", "--fit", "frames", "--loads", "walk_grf.xml"];
    let range = ["--from", "0.5", "--to", "1.5", "--cutoff", "6", "--force-cutoff", "off", "-o", "options"];
    forces(&bench, &[&by_options[..], &range].concat()).done();
    forces(&bench, &["--setup", "setups/id.xml", "--setup", "setups/ik.xml", "-o", "setup"]).done();
    let [options, setup] = ["options", "setup"].map(|folder| bench.table(&format!("{folder}/moments.sto")));
    assert!(difference(&options, &setup, "knee_angle_r_moment") < 0.05);
    assert_found(&bench, "setup", "setup.unused", "walk.mot was not read; the coordinates are those of the markers");
    // A knee that is held straight by a task.
    let task = "<IKTaskSet><objects><IKCoordinateTask \
        name=\"knee_angle_r\"><weight>1000</weight><value_type>manual_value</value_type>\
        <value>0</value></IKCoordinateTask></objects></IKTaskSet>";
    // In a separate file, as in the tutorials of OpenSim 2, whose file of coordinates was needed by no task.
    bench.write("setups/tasks.xml", format!("<OpenSimDocument Version=\"20302\">{task}</OpenSimDocument>"));
    let elsewhere = "<IKTaskSet file=\"tasks.xml\"/><coordinate_file>missing.mot</coordinate_file>";
    bench.write("setups/ik.xml", kinematics(elsewhere));
    forces(&bench, &["--setup", "setups/id.xml", "--setup", "setups/ik.xml", "-o", "straight"]).done();
    let straight = bench.table("straight/kinematics.mot").column("knee_angle_r").unwrap().to_vec();
    assert!(straight.iter().all(|angle| angle.abs() < 0.5), "{straight:?}");
}

#[test]
fn set_ups_that_contradict_each_other_or_an_option_are_refused() {
    let bench = laboratory_with_setups("setup_contradictions");
    let setups = |files: &[&str], more: &[&str]| {
        let words: Vec<String> =
            files.iter().flat_map(|file| ["--setup".to_owned(), format!("setups/{file}.xml")]).collect();
        forces(&bench, &[&words.iter().map(String::as_str).collect::<Vec<_>>()[..], more].concat())
    };
    setups(&["id", "id"], &[]).refused(&[
        "setups/id.xml",
        "a second set-up of InverseDynamicsTool",
        "one of each tool",
    ]);
    setups(&["scale", "id"], &[]).refused(&["names coordinates", "expected a set-up of InverseKinematicsTool"]);
    setups(&["scale", "ik"], &["--height", "1.8"]).refused(&["the height contradicts", "setups/scale.xml"]);
    setups(&["ik"], &["--static", "standing.c3d"])
        .refused(&["the standing trial would scale", "a set-up of ScaleTool"]);
    setups(&["ik"], &["walk.mot"]).refused(&["walk.mot", "these are coordinates", "expected markers"]);
    bench.write("setups/ik.xml", kinematics("").replace("figure", "other"));
    setups(&["ik", "id"], &[]).refused(&["two models", "other.osim", "figure.osim", "hint: `--model"]);
    setups(&["ik"], &[]).refused(&["other.osim", "there is no such file"]);
    bench.write("setups/ik.xml", kinematics("").replace("<marker_file>../walk.trc</marker_file>", ""));
    setups(&["ik"], &[]).refused(&["names no recording", "<marker_file>"]);
    bench.write("setups/ik.xml", "<RRATool/>");
    setups(&["ik"], &[]).refused(&["setups/ik.xml", "<RRATool>", "<InverseKinematicsTool>"]);
    forces(&bench, &[]).refused(&["INPUT"]);
}

// ---- Set-ups ----

/// The recordings of an OpenSim tutorial, with set-ups of our own; `None` without data.
fn tutorial(name: &str, recordings: &str) -> Option<Workbench> {
    let source = data()?.join(recordings);
    let bench = Workbench::empty(&format!("opensim_{name}")).always_removed();
    for file in std::fs::read_dir(source).unwrap() {
        let file = file.unwrap().path();
        if file.is_file() {
            bench.write(file.file_name().unwrap().to_str().unwrap(), std::fs::read(&file).unwrap());
        }
    }
    for tool in TOOLS {
        bench.write(&format!("{tool}.xml"), std::fs::read(recorded(&format!("{name}_{tool}.xml"))).unwrap());
    }
    Some(bench)
}

const TOOLS: [&str; 3] = ["scale", "ik", "id"];
const ALL: [&str; 6] = ["--setup", "scale.xml", "--setup", "ik.xml", "--setup", "id.xml"];

/// What OpenSim 4.6 gives for these set-ups (`xtask/measure/peers/opensim_setup.py`), or a set-up.
fn recorded(file: &str) -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/testdata/opensim_setup").join(file)
}

fn recorded_table(file: &str) -> Table {
    Table::read_csv(&std::fs::read(recorded(file)).unwrap()).unwrap().0
}

/// A recorded table of numbers by name.
fn by_name(file: &str) -> Vec<(String, Vec<f64>)> {
    let text = std::fs::read_to_string(recorded(file)).unwrap();
    let row = |line: &str| {
        let (name, numbers) = line.split_once(',').unwrap();
        (name.to_owned(), numbers.split(',').map(|number| number.parse().unwrap()).collect())
    };
    text.lines().skip(1).map(row).collect()
}

/// Root mean square difference of a column from the recorded one.
fn difference(ours: &Table, recorded: &Table, column: &str) -> f64 {
    let curve = |table: &Table| (table.times().unwrap().to_vec(), table.column(column).unwrap().to_vec());
    let ((times, values), (at, expected)) = (curve(ours), curve(recorded));
    let inside = |t: &f64| (times[0]..=times[times.len() - 1]).contains(t);
    let (at, expected): (Vec<f64>, Vec<f64>) = at.into_iter().zip(expected).filter(|(t, _)| inside(t)).unzip();
    compare(Curve { times: &times, values: &values }, Curve { times: &at, values: &expected }).unwrap().rmse
}

/// Runs all three set-ups and compares body, angles and moments with what OpenSim's tools give.
fn assert_agrees(name: &str, recordings: &str, allowed_deg: f64) {
    let Some(bench) = tutorial(name, recordings) else { return };
    bench.run(&[&["forces"], &ALL[..], &["-o", "out", "--keep", "moments,kinematics,model"]].concat()).done();
    let body = OsimModel::read(&bench.read("out/subject.osim")).unwrap();
    let mut worst = [0.0f64; 3];
    for (expected, numbers) in by_name(&format!("{name}_bodies.csv")) {
        let ours = body.bodies.iter().find(|b| b.name == expected).unwrap();
        worst[0] = worst[0].max((ours.mass_kg / numbers[0] - 1.0).abs());
        let places = ours.mass_center_m.iter().zip(&numbers[1..4]);
        worst[1] = places.fold(worst[1], |worst, (a, b)| worst.max((a - b).abs()));
    }
    let markers = by_name(&format!("{name}_markers.csv"));
    for (expected, numbers) in &markers {
        let ours = body.markers.iter().find(|m| m.name == *expected).unwrap_or_else(|| panic!("no {expected}"));
        let off = ours.location_m.iter().zip(numbers).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        worst[2] = worst[2].max(off);
    }
    assert_eq!(body.markers.len(), markers.len());
    println!("{name}: masses {:.1e}, mass centres {:.1e} m, markers {:.1e} m", worst[0], worst[1], worst[2]);
    // OpenSim's angles are those of the markers, before the filter.
    bench.run(&[&["forces"], &ALL[..], &["--cutoff", "off", "-o", "raw", "--keep", "kinematics"]].concat()).done();
    let (angles, moments) = (bench.table("raw/kinematics.mot"), bench.table("out/moments.sto"));
    let (ik, id) = (recorded_table(&format!("{name}_ik.csv")), recorded_table(&format!("{name}_id.csv")));
    let mut largest = [0.0f64; 2];
    for side in ["r", "l"] {
        for joint in ["hip_flexion", "hip_adduction", "hip_rotation", "knee_angle", "ankle_angle"] {
            let of_angle = difference(&angles, &ik, &format!("{joint}_{side}"));
            let of_moment = difference(&moments, &id, &format!("{joint}_{side}_moment"));
            println!("  {joint}_{side}: {of_angle:.1e} deg, {of_moment:.2} N.m");
            largest = [largest[0].max(of_angle), largest[1].max(of_moment)];
        }
    }
    // Masses and places follow from the same formulas, markers and angles from minima of the same cost. The times of
    // the Gait2392 recording are rounded to milliseconds, and OpenSim's filter resamples them to another grid: some
    // tenths of N.m.
    assert!(worst[0] < 1e-8 && worst[1] < 1e-8 && worst[2] < 1e-5, "{worst:?}");
    assert!(largest[0] < allowed_deg && largest[1] < 0.5, "{largest:?}");
}

#[test]
fn the_tutorial_with_gait2392_agrees_with_the_tools_of_opensim() {
    // Times rounded to milliseconds are up to 0.3 ms off, in which a knee turns by 0.1 degrees.
    assert_agrees("gait2392", "opensim-gait2392-subject01", 0.1);
}

#[test]
fn the_tutorial_with_the_model_of_rajagopal_agrees_with_the_tools_of_opensim() {
    assert_agrees("rajagopal", "opensim-rajagopal-walk", 0.02);
}
