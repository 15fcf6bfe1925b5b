//! `info`, `convert` and `events` on files of every kind, and `forces` on laboratory files; `demo` writes all of them.

use crate::workbench::Workbench;
use ambulo_formats::bvh::{Bvh, Joint};
use ambulo_formats::c3d::{C3d, Values};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::table::Table;
use ambulo_formats::trc::Trc;
use serde_json::Value;
use std::fs;
use std::sync::OnceLock;

/// A folder with `demo/input`: a walk as C3D, TRC, BVH, coordinates and forces, with the figure that walks.
fn with_demo(name: &str) -> Workbench {
    static DEMO: OnceLock<Workbench> = OnceLock::new();
    let made = DEMO.get_or_init(|| {
        let bench = Workbench::empty("exchange_demo");
        bench.run(&["demo", "-o", "demo", "--quiet"]).done();
        bench
    });
    let bench = Workbench::empty(name);
    for folder in ["demo", "demo/input"] {
        fs::create_dir_all(bench.folder.join(folder)).unwrap();
        for entry in fs::read_dir(made.folder.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.is_file() {
                fs::copy(&path, bench.folder.join(folder).join(path.file_name().unwrap())).unwrap();
            }
        }
    }
    bench
}

fn info(bench: &Workbench, file: &str) -> (Value, String) {
    let json = serde_json::from_str(&bench.run(&["info", file, "--json"]).done().stdout).unwrap();
    (json, bench.run(&["info", file]).done().stdout)
}

#[test]
fn info_describes_a_recording() {
    let bench = with_demo("info_recording");
    let (json, text) = info(&bench, "demo/input/walk.c3d");
    assert_eq!(
        (&json["kind"], &json["unit"], &json["first_frame"]),
        (&"C3D recording".into(), &"mm".into(), &1.into())
    );
    assert_eq!((&json["rate_hz"], &json["analog_rate_hz"]), (&100.0.into(), &1000.0.into()));
    assert_eq!(json["marker_set"]["sets"], serde_json::json!(["plug-in-gait"]));
    let [used, unused] = ["used", "unused"].map(|key| json["markers_used"][key].as_array().unwrap().len());
    assert_eq!(used + unused, 46, "{json}");
    assert!(used >= 40 && text.contains(&format!("markers used: {used} of 46 markers by the built-in body")), "{text}");
    assert!((json["mass_kg"].as_f64().unwrap() - 75.0).abs() < 1e-6, "{json}");
    let plates = json["plates"].as_array().unwrap();
    // Three cycles and a little more: a plate for each of nine contacts, the highest peaks 1.14 body weights.
    assert_eq!((plates.len(), json["events"].as_array().unwrap().len()), (9, 16));
    assert!(plates.iter().all(|plate| (700.0..900.0).contains(&plate["peak_n"].as_f64().unwrap())), "{json}");
    assert!(plates.iter().all(|plate| plate["loaded_s"].as_array().unwrap().len() == 1), "{json}");
    let feet = json["feet_on_plates"].as_array().unwrap();
    let sides: Vec<&str> = feet.iter().filter_map(|foot| foot["side"].as_str()).collect();
    // The plates are in the order of right, then left contacts.
    assert_eq!(sides.concat(), "rrrrlllll", "{json}");
    for line in [
        "encoding: Intel (little-endian), reals",
        "markers with gaps: none",
        "marker set: plug-in-gait, 46 of 46 markers",
        "axes: lab z up, mm, walking +y -> world x forward, y up, z right, m",
        "next: ambulo forces demo/input/walk.c3d --static STANDING -o out",
    ] {
        assert!(text.contains(line), "`{line}` is missing in {text}");
    }
    // The first strike follows the start by a fifth of a cycle.
    let strike = text.lines().find_map(|line| line.trim().strip_suffix(" s Right Foot Strike")).unwrap();
    assert!((0.2..0.26).contains(&strike.parse::<f64>().unwrap()), "{strike}");
    let (_, text) = info(&bench, "demo/input/standing.c3d");
    assert!(text.contains("next: a standing trial: ambulo forces WALK --static demo/input/standing.c3d"), "{text}");
}

#[test]
fn info_lists_marker_gaps_and_unknown_markers() {
    let bench = with_demo("info_gaps");
    let (mut c3d, _) = C3d::read(&bench.read("demo/input/walk.c3d")).unwrap();
    for frame in (10..30).chain(50..55) {
        c3d.points[0].positions[frame] = [f64::NAN; 3];
    }
    c3d.points[1].positions.fill([f64::NAN; 3]);
    for (k, point) in c3d.points.iter_mut().enumerate().skip(6) {
        point.name = format!("Mystery{k}");
    }
    bench.write("gaps.c3d", c3d.write().unwrap());
    let (json, text) = info(&bench, "gaps.c3d");
    let gap = serde_json::json!({ "marker": "RASI", "gaps": 2, "missing_frames": 25, "longest_s": 0.2 });
    assert_eq!(json["markers_with_gaps"][0], gap);
    assert!(
        text.contains("RASI: 2 gaps, 25 frames (6 %), longest 0.200 s") && text.contains("LASI: never visible"),
        "{text}"
    );
    assert!(text.contains("Mystery7"), "{text}");
}

#[test]
fn info_describes_how_a_skeleton_is_interpreted() {
    let bench = with_demo("info_skeleton");
    let (json, text) = info(&bench, "demo/input/walk.bvh");
    assert_eq!((&json["frames"], &json["channels"]), (&437.into(), &45.into()));
    assert!((json["height_m"].as_f64().unwrap() - 1.75).abs() < 0.05, "{json}");
    assert!(text.contains("axes: lengths in centimetres") && text.contains("+y up"), "{text}");
    assert!(text.contains("next: ambulo forces demo/input/walk.bvh --mass KG --height M"), "{text}");
    let (_, text) = info(&bench, "demo/input/walk.trc");
    assert!(text.contains("axes: lab y up, mm, walking +x"), "{text}");
    let (_, text) = info(&bench, "demo/input/walk_grf.mot");
    assert!(text.contains("ground_force_r_..., ground_force_l_..."), "{text}");
    bench.write(
        "tree.bvh",
        "HIERARCHY\nROOT Trunk\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n}\nMOTION\nFrames: 2\nFrame Time: 1\n0\n1\n",
    );
    let (_, text) = info(&bench, "tree.bvh");
    assert!(text.contains("axes: unknown: no joint was recognised as right hip"), "{text}");
}

/// A part of the demo's walk with a finger and a prop, which no body has.
fn take(bench: &Workbench, frames: std::ops::Range<usize>) -> Bvh {
    let (walk, _) = Bvh::read(&bench.read("demo/input/walk.bvh")).unwrap();
    let mut joints = walk.joints().to_vec();
    let turning = joints[1].channels.clone();
    for (name, parent) in [("Thumb", Some(joints.len() - 1)), ("Ball", None)] {
        let (offset, channels) = ([0.0, 3.0, 1.0], turning.clone());
        joints.push(Joint { name: name.to_owned(), parent, offset, channels, end_sites: vec![[0.0, 1.0, 0.0]] });
    }
    let own = 2 * turning.len();
    let frame = |k: usize| [walk.frame(k).unwrap(), &vec![k as f64; own][..]].concat();
    Bvh::new(joints, walk.frame_time_s(), &frames.map(frame).collect::<Vec<_>>()).unwrap()
}

#[test]
fn a_result_is_written_into_the_skeleton_of_the_animator() {
    let bench = with_demo("convert_rig");
    let own = take(&bench, 0..150);
    bench.write("take.bvh", own.write());
    let forces = ["--mass", "75", "--height", "1.75", "--keep", "kinematics,model"];
    bench.run(&[&["forces", "take.bvh", "-o", "same", "--cutoff", "off"][..], &forces].concat()).done();
    let run = bench.run(&["convert", "same", "same.bvh", "--rig", "take.bvh", "--verbose"]).done();
    run.reports(&["turned by 0.00 degrees (RMS)", "all other joints keep their own rotation"]);
    let (same, _) = Bvh::read(&bench.read("same.bvh")).unwrap();
    assert_eq!((same.joints(), same.frames(), same.frame_time_s()), (own.joints(), 150, own.frame_time_s()));
    let largest = |other: &Bvh| {
        let away = |k: usize| own.frame(k).unwrap().iter().zip(other.frame(k).unwrap()).map(|(a, b)| (a - b).abs());
        (0..other.frames()).flat_map(away).fold(0.0, f64::max)
    };
    assert!(largest(&same) < 1e-3, "{}", largest(&same));
    // The part that was changed: its skeleton read again has the motion of the result.
    bench.run(&[&["forces", "take.bvh", "-o", "out", "--consistent", "--to", "0.8"][..], &forces].concat());
    let run = bench.run(&["convert", "out", "mine.bvh", "--rig", "take.bvh", "--verbose"]).done();
    run.reports(&["of 150 frames, which the result does not have"]);
    let (mine, _) = Bvh::read(&bench.read("mine.bvh")).unwrap();
    assert!(mine.frames() < 150 && largest(&mine) > 0.1, "{}", largest(&mine));
    let last = |bvh: &Bvh, k: usize| bvh.frame(k).unwrap()[own.channels() - 6..].to_vec();
    assert_eq!(last(&mine, 7), last(&own, 7));
}

#[test]
fn a_skeleton_that_is_not_that_of_the_result_is_refused() {
    let bench = with_demo("convert_rig_refused");
    bench.write("take.bvh", take(&bench, 0..100).write());
    bench.write("later.bvh", take(&bench, 300..400).write());
    bench.run(&["forces", "take.bvh", "-o", "out", "--mass", "75", "--height", "1.75", "--keep", "kinematics,model"]);
    let refused = |args: &[&str], words: &[&str]| bench.run(&[&["convert"][..], args].concat()).refused(words);
    refused(&["take.bvh", "x.trc", "--rig", "take.bvh"], &["--rig is for result folders only"]);
    refused(&["out", "x.glb", "--rig", "take.bvh"], &["--rig writes a .bvh only; found `.glb`"]);
    refused(&["out", "take.bvh", "--rig", "take.bvh", "--force"], &["this input file would be overwritten"]);
    refused(&["out", "x.bvh", "--rig", "none.bvh"], &["none.bvh: there is no such file"]);
    refused(&["out", "x.bvh", "--rig", "later.bvh"], &["later.bvh", "is this the result of another take?"]);
    refused(&["demo", "x.bvh", "--rig", "take.bvh"], &["expected the result of an animation file"]);
    bench.write("x.bvh", "mine");
    refused(&["out", "x.bvh", "--rig", "take.bvh"], &["x.bvh", "exists"]);
    bench.write("copy.bvh", bench.read("take.bvh"));
    bench
        .run(&["convert", "out", "y.bvh", "--rig", "copy.bvh"])
        .done()
        .reports(&["the result was computed from `take.bvh` and written into the skeleton of `copy.bvh`"]);
}

#[test]
fn laboratory_files_give_the_forces_of_the_synthetic_walk() {
    let bench = with_demo("laboratory");
    // Markers on a body made to measure, and plates, against the figure's own moments, which are not filtered. The
    // default of 6 Hz would take 6 N.m rms from the hip, of a range of 131, most of it at foot strike; 10 Hz leave 1.6
    // to 2.1 N.m at all joints.
    let standing = ["--static", "demo/input/standing.c3d", "--cutoff", "10", "--force-cutoff", "10"];
    bench.run(&[&["forces", "demo/input/walk.c3d", "-o", "out", "--quiet"][..], &standing].concat()).done();
    let range = ["--from", "0.5", "--to", "3.8"];
    for joint in ["hip_flexion", "knee_angle", "ankle_angle"] {
        let columns = ["r", "l"].map(|side| format!("{joint}_{side}_moment")).join(",");
        let files = ["compare", "out/moments.sto", "demo/moments.sto", "--columns", &columns, "--limit", "3"];
        bench.run(&[&files[..], &range].concat()).done();
    }
    let forces = bench.json("out/summary.json");
    assert!((forces["mass_kg"].as_f64().unwrap() - 75.0).abs() < 0.75, "{}", forces["mass_kg"]);
    // The same from the figure's own markers on its own model.
    let own =
        ["forces", "demo/input/walk.trc", "--model", "demo/input/figure.osim", "--loads", "demo/input/walk_grf.xml"];
    bench.run(&[&own[..], &["-o", "own", "--quiet"]].concat()).done();
    let ankle = ["--columns", "ankle_angle_r_moment", "--limit", "4"];
    bench.run(&[&["compare", "own/moments.sto", "demo/moments.sto"][..], &ankle, &range].concat()).done();
}

#[test]
fn a_skeleton_gives_the_angles_that_it_was_written_from() {
    let bench = with_demo("skeleton");
    let run = bench.run(&["forces", "demo/input/walk.bvh", "--mass", "75", "--height", "1.75", "-o", "out", "--quiet"]);
    assert!(matches!(run.code, Some(0 | 1)), "{}", run.stderr);
    let summary = bench.json("out/summary.json");
    let codes: Vec<&str> =
        summary["findings"].as_array().unwrap().iter().map(|f| f["code"].as_str().unwrap()).collect();
    assert!(codes.contains(&"bvh.low_trust"), "{codes:?}");
    // Degrees. A filter of 6 Hz takes half a degree from the ankle.
    let columns = "hip_flexion_r,knee_angle_r,ankle_angle_r,hip_flexion_l,knee_angle_l,ankle_angle_l,pelvis_tilt,\
        arm_flex_r,elbow_flex_r";
    let files = ["compare", "out/kinematics.mot", "demo/kinematics.mot", "--columns", columns, "--limit", "1"];
    bench.run(&[&files[..], &["--from", "0.5", "--to", "3.8"]].concat()).done();
}

#[test]
fn events_of_plates_motion_and_file_agree() {
    let bench = with_demo("events");
    let run = bench.run(&["events", "demo/input/walk.c3d", "--json", "-o", "events.csv"]).done();
    let json: Value = serde_json::from_str(&run.stdout).unwrap();
    for agreement in json["agreement"].as_array().unwrap() {
        for kind in agreement["kinds"].as_array().unwrap() {
            let (pairs, apart) = (kind["pairs"].as_u64().unwrap(), kind["mean_absolute_ms"].as_f64().unwrap());
            // Published methods have errors of about 20 ms; a stance at an end of the recording has no event there.
            assert!(pairs == 8 && kind["missed"] == 0 && apart < 30.0, "{agreement}");
        }
    }
    let csv = bench.text("events.csv");
    assert!(csv.starts_with("side,event,time,source\n") && csv.contains("\nr,strike,0.2"), "{csv}");
    let forces = bench.run(&["events", "demo/input/walk_grf.mot"]).done();
    assert!(forces.stdout.starts_with("ground forces (20 N): 16\n"), "{}", forces.stdout);
    for file in ["demo/input/walk.trc", "demo/input/walk.bvh"] {
        let motion = bench.run(&["events", file]).done();
        assert!(motion.stdout.starts_with("motion of the feet (4 methods): 16\n"), "{file}: {}", motion.stdout);
    }
    bench.run(&["events", "demo/input/figure.osim"]).refused(&["`.osim` contains no gait; expected .c3d, .trc"]);
    bench.run(&["events", "demo/input/walk.mot"]).refused(&["no ground-force columns", "hint: "]);
    let input = "demo/input/walk.trc";
    bench.run(&["events", input, "-o", input]).refused(&["this input file would be overwritten"]);
}

#[test]
fn markers_go_from_c3d_to_trc_and_back() {
    let bench = with_demo("convert_markers");
    let run = bench.run(&["convert", "demo/input/walk.c3d", "walk.trc"]).done();
    assert_eq!(run.stdout, "written: walk.trc\n");
    run.reports(&["note: not carried over: 54 analog channels, 16 events, "]);
    bench.run(&["convert", "walk.trc", "again.c3d"]).done();
    let (first, _) = C3d::read(&bench.read("demo/input/walk.c3d")).unwrap();
    let (again, _) = C3d::read(&bench.read("again.c3d")).unwrap();
    assert_eq!(
        (first.frames(), first.points.len(), first.first_frame),
        (again.frames(), again.points.len(), again.first_frame)
    );
    for (a, b) in first.points.iter().zip(&again.points) {
        let differences = a.positions.iter().flatten().zip(b.positions.iter().flatten()).map(|(a, b)| (a - b).abs());
        assert_eq!(a.name, b.name);
        // Single precision: 0.0005 mm at 7000 mm.
        assert!(differences.fold(0.0, f64::max) < 1e-3, "{}", a.name);
    }
    let run = bench.run(&["convert", "demo/input/walk.c3d", "world.trc", "--world"]).done();
    run.reports(&["walking +y -> world x forward"]);
    let (lab, _) = Trc::read(&bench.read("walk.trc")).unwrap();
    let (world, _) = Trc::read(&bench.read("world.trc")).unwrap();
    for (a, b) in lab.markers().iter().zip(world.markers()) {
        let ([x, y, z], [forward, up, right]) = (a.positions_m[7], b.positions_m[7]);
        assert!([y - forward, z - up, x - right].iter().all(|d| d.abs() < 1e-12), "{}", a.name);
    }
    bench.run(&["convert", "demo/input/walk.c3d", "walk.csv"]).done();
    let (table, _) = Table::read_csv(&bench.read("walk.csv")).unwrap();
    assert_eq!((table.names()[0].as_str(), table.names()[1].as_str(), table.rows()), ("time", "RASI_x", 437));
    bench.run(&["convert", "demo/input/walk.c3d", "analog.csv", "--what", "analog"]).done();
    let (table, _) = Table::read_csv(&bench.read("analog.csv")).unwrap();
    assert_eq!((table.names()[3].as_str(), table.names().len(), table.rows()), ("Fz1 [N]", 55, 4370));
}

#[test]
fn plates_become_ground_reactions_by_foot() {
    let bench = with_demo("convert_plates");
    bench.run(&["convert", "demo/input/walk.c3d", "grf.mot"]).done();
    let (loads, _) = ExternalLoads::read(&bench.read("grf.xml")).unwrap();
    assert_eq!(loads.datafile.as_deref(), Some("grf.mot"));
    // Against what the figure was walked with, in the same axes; the plates were sampled on straight lines between
    // frames.
    let columns = "ground_force_r_vy,ground_force_l_vy,ground_force_r_vx,ground_force_l_vx";
    let files = ["compare", "grf.mot", "demo/grf.mot", "--columns", columns, "--limit", "2"];
    bench.run(&[&files[..], &["--from", "0.5", "--to", "3.8"]].concat()).done();
    // `forces` reads them.
    let run = [
        "forces",
        "demo/input/walk.mot",
        "--model",
        "demo/input/figure.osim",
        "--loads",
        "grf.xml",
        "-o",
        "out",
        "--quiet",
    ];
    bench.run(&run).done();
}

#[test]
fn tables_and_skeletons_are_converted() {
    let bench = with_demo("convert_tables");
    let run = bench.run(&["convert", "demo/input/walk.mot", "walk.csv"]).done();
    run.reports(&["not carried over: the header's statement that angles are in degrees"]);
    bench.run(&["convert", "walk.csv", "walk.sto"]).done().reports(&["does not say whether angles are in degrees"]);
    let (first, again) = (bench.table("demo/input/walk.mot"), bench.table("walk.sto"));
    assert!(again.columns().eq(first.columns()) && again.in_degrees.is_none());
    let figure = "demo/input/figure.osim";
    bench.run(&["convert", "demo/input/walk.mot", "walk.bvh", "--model", figure]).done();
    let (bvh, _) = Bvh::read(&bench.read("walk.bvh")).unwrap();
    assert_eq!((bvh.frames(), bvh.joints()[0].name.as_str(), bvh.joint("RightForeArm").is_some()), (437, "Hips", true));
    bench.run(&["convert", "walk.bvh", "channels.csv"]).done();
    let (table, _) = Table::read_csv(&bench.read("channels.csv")).unwrap();
    assert_eq!((table.names()[1].as_str(), table.names().len()), ("Hips.Xposition", 46));
    bench.run(&["convert", "walk.bvh", "centres.trc"]).done().reports(&["lengths in centimetres"]);
    let (centres, _) = Trc::read(&bench.read("centres.trc")).unwrap();
    let (markers, _) = Trc::read(&bench.read("demo/input/walk.trc")).unwrap();
    // The centre of the knee by the skeleton and by the model.
    let (a, b) = (centres.marker("RightLeg").unwrap(), markers.marker("knee_r").unwrap());
    let differences = a.positions_m.iter().flatten().zip(b.positions_m.iter().flatten()).map(|(a, b)| (a - b).abs());
    let worst = differences.fold(0.0, f64::max);
    println!("knee by skeleton and by model: {worst:.2e} m");
    assert!(worst < 1e-9);
}

#[test]
fn impossible_conversions_are_rejected_with_the_possible_ones() {
    let bench = with_demo("convert_refused");
    let refused = |args: &[&str], words: &[&str]| bench.run(&[&["convert"][..], args].concat()).refused(words);
    let (walk, figure) = ("demo/input/walk.c3d", "demo/input/figure.osim");
    refused(&[walk, "x.bvh"], &[".c3d cannot be converted to .bvh; expected one of .trc, .csv, .mot, .sto"]);
    refused(&[figure, "x.trc"], &["`.osim` cannot be converted; expected an input with the extension .c3d, .trc"]);
    refused(&["demo/input/walk.mot", "x.bvh"], &["expected --model FILE.osim"]);
    refused(&[walk, "x.trc", "--what", "analog"], &["--what is for .c3d to .csv only"]);
    refused(&["demo/input/walk.mot", "x.csv", "--world"], &["--world is for markers and joint centres only"]);
    refused(&["demo/input/standing.c3d", "x.trc", "--model", figure], &["--model is for .bvh and .glb only"]);
    refused(&["no.c3d", "x.trc"], &["no.c3d: there is no such file"]);
    bench.write("x.trc", "mine");
    refused(&[walk, "x.trc"], &["x.trc: this file already exists", "hint: --force overwrites it"]);
    assert_eq!(bench.text("x.trc"), "mine");
    bench.run(&["convert", walk, "x.trc", "--force"]).done();
    assert!(bench.text("x.trc").starts_with("PathFileType"));
    bench.write("y.xml", "mine");
    refused(&[walk, "y.mot"], &["y.xml: this file already exists"]);
    assert!(!bench.exists("y.mot"));
    bench.write("walk.csv", "a,b\n1,2\n");
    refused(&["walk.csv", "x.sto"], &["the first column is `a`; expected `time`"]);
    bench.write("short.bvh", "HIERARCHY\nROOT a\n{\n");
    refused(&["short.bvh", "x.csv"], &["short.bvh", "line 3: the file ends here", "Is it truncated?"]);
    bench.write("bad.c3d", [0_u8; 600]);
    refused(&["bad.c3d", "z.trc"], &["bad.c3d"]);
}

#[test]
fn converted_forces_agree_with_their_recording() {
    let bench = with_demo("own_forces");
    bench.run(&["convert", "demo/input/walk.c3d", "grf.mot"]).done();
    let walk = ["forces", "demo/input/walk.c3d", "--static", "demo/input/standing.c3d", "--quiet"];
    bench.run(&[&walk[..], &["-o", "plates"]].concat()).done();
    // The table is in world axes, the markers in laboratory axes.
    bench.run(&[&walk[..], &["--loads", "grf.xml", "-o", "table"]].concat()).done();
    let summary = bench.json("table/summary.json");
    let codes: Vec<&str> =
        summary["findings"].as_array().unwrap().iter().map(|f| f["code"].as_str().unwrap()).collect();
    assert!(codes.contains(&"loads.world_axes"), "{codes:?}");
    let columns = "hip_flexion_r_moment,knee_angle_r_moment,ankle_angle_r_moment,hip_adduction_r_moment";
    // A table is zero where a foot carries less than 20 N. At the hip, 0.9 m higher, that is at most 18 N.m in the
    // frame after a foot off, one of 109 frames: 1.7 N.m rms.
    bench.run(&["compare", "table/moments.sto", "plates/moments.sto", "--columns", columns, "--limit", "0.6"]).done();
}

#[test]
fn messages_are_short_and_not_repeated() {
    let bench = with_demo("calm");
    for name in ["walk", "standing"] {
        let file = format!("demo/input/{name}.c3d");
        let (mut c3d, _) = C3d::read(&bench.read(&file)).unwrap();
        // As Vicon's programs write it, down to the sensors; and points that are not markers.
        let mut origin = c3d.parameters.get("FORCE_PLATFORM", "ORIGIN").unwrap().clone();
        let plates = origin.numbers().unwrap().len() / 3;
        origin.values = Values::Reals([0.0, 0.0, 10.0].repeat(plates));
        c3d.parameters.set("FORCE_PLATFORM", origin);
        let extra: Vec<_> = (0..40)
            .map(|i| {
                let mut point = c3d.points[0].clone();
                point.name = format!("Extra{i}");
                point
            })
            .collect();
        c3d.points.extend(extra);
        bench.write(&file, c3d.write().unwrap());
    }
    let run =
        bench.run(&["forces", "demo/input/walk.c3d", "--static", "demo/input/standing.c3d", "-v", "-o", "out"]).done();
    run.reports(&["40 markers were given to the segments", "and 28 more"]);
    assert_eq!(run.stderr.matches("ORIGIN of every plate").count(), 1, "{}", run.stderr);
    assert!(!run.stderr.contains("times)") && !run.stderr.contains("Extra29"), "{}", run.stderr);
}

#[test]
fn mass_events_and_moments_of_the_synthetic_walk_are_recovered_over_the_whole_recording() {
    let bench = with_demo("identity");
    let run =
        ["forces", "demo/input/walk.c3d", "--static", "demo/input/standing.c3d", "--mass", "75", "--height", "1.75"];
    bench.run(&[&run[..], &["--force-cutoff", "same", "-o", "out", "--quiet"]].concat()).done();
    bench.run(&[&run[..], &["--cutoff", "off", "--force-cutoff", "off", "-o", "raw", "--quiet"]].concat()).done();
    // N.m rms: without a filter 1.1 at the hip, 0.4 at the knee, 1.8 at the ankle; the filter of 6 Hz takes the rest
    // from the figure's own.
    for (joint, limit, raw_limit) in
        [("hip_flexion", "4.5", "1.5"), ("knee_angle", "4.5", "0.8"), ("ankle_angle", "3.5", "2.2")]
    {
        let columns = format!("{joint}_r_moment,{joint}_l_moment");
        for (moments, limit) in [("out/moments.sto", limit), ("raw/moments.sto", raw_limit)] {
            bench.run(&["compare", moments, "demo/moments.sto", "--columns", &columns, "--limit", limit]).done();
        }
    }
    let mass = bench.json("out/summary.json")["mass_kg"].as_f64().unwrap();
    assert!((mass - 75.0).abs() < 0.05, "{mass}");
    let events = |file: &str| -> Vec<(String, f64)> {
        let row = |line: &str| {
            let (what, time) = line.rsplit_once(',').unwrap();
            (what.to_owned(), time.parse().unwrap())
        };
        bench.text(file).lines().skip(1).map(row).collect()
    };
    let (found, own) = (events("out/events.csv"), events("demo/events.csv"));
    assert_eq!(found.len(), own.len(), "{found:?}");
    for ((what, time), (own_what, own_time)) in found.iter().zip(&own) {
        assert!(what == own_what && (time - own_time).abs() < 0.02, "{what} {time}: {own_what} {own_time}");
    }
}

#[test]
fn the_command_that_info_suggests_works() {
    let bench = with_demo("next");
    let (_, text) = info(&bench, "demo/input/walk.trc");
    assert!(text.contains("--height M -o out") && text.contains("keypoints"), "{text}");
    // The joint centres of the figure have the names of key points.
    let size = ["--mass", "75", "--height", "1.75"];
    let run = bench.run(&[&["forces", "demo/input/walk.trc", "-o", "centres", "--quiet"], &size[..]].concat());
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    bench.run(&["convert", "demo/input/walk.c3d", "walk.trc", "--world"]).done();
    bench.run(&["convert", "demo/input/walk.c3d", "grf.mot"]).done();
    let (_, text) = info(&bench, "walk.trc");
    let next = "next: ambulo forces walk.trc --static STANDING --mass KG --height M -o out";
    assert!(text.contains(next), "{text}");
    let run = ["forces", "walk.trc", "--static", "demo/input/standing.c3d", "--mass", "75", "--height", "1.75"];
    bench.run(&[&run[..], &["--grf", "grf.mot", "-o", "out", "--quiet"]].concat()).done();
    // Without measured forces they are predicted; this figure does not sway over its feet, so the verdict may be
    // infeasible.
    bench.run(&[&run[..], &["-o", "predicted", "--quiet"]].concat()).infeasible();
    // The standing figure has both feet on one plate.
    let (_, text) = info(&bench, "demo/input/standing.c3d");
    assert!(text.contains("s: two feet: the right foot was on it"), "{text}");
}
