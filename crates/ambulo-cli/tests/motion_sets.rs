//! Files of motion sets through the command: subjects of AddBiomechanics made from the demo's walk, and motions of the
//! SMPL family.

use crate::workbench::Workbench;
use ambulo::findings::Findings;
use ambulo::model::Model;
use ambulo::motion::coordinates_from_table;
use ambulo_formats::b3d::{
    B3d, ContactFrames, Header, MissingForce, Pass, PassFrames, PassKind, Person, TrialFrames, TrialHeader, TrialKind,
    TrialPass,
};
use ambulo_formats::npz::{Array, Data, Npz};
use ambulo_formats::osim::{OsimJoint, OsimModel};
use ambulo_formats::parquet::{ColumnValues, ParquetTable};
use ambulo_formats::table::Table;
use ambulo_formats::trc::Trc;
use std::fs;

/// Frames of the demo's walk in the file: two seconds.
const FRAMES: usize = 200;

/// The coordinates under a body in the order of the file: joint by joint outwards, each branch to its end.
fn order(document: &OsimModel, body: &str) -> Vec<String> {
    let joints = document.joints.iter().filter(|joint| joint.parent.body == body);
    let under = |joint: &OsimJoint| {
        let own = joint.coordinates.iter().map(|c| c.name.clone());
        own.chain(order(document, &joint.child.body)).collect::<Vec<String>>()
    };
    joints.flat_map(under).collect()
}

/// The demo's walk as a subject with two trials: the second has no ground forces.
fn subject(bench: &Workbench) -> B3d {
    let text = String::from_utf8(bench.read("demo/input/figure.osim")).unwrap();
    let document = OsimModel::read(text.as_bytes()).unwrap();
    let model = Model::from_osim(text.as_bytes(), &mut Findings::default()).unwrap();
    let read = |name: &str| Table::read_storage(&bench.read(name)).unwrap().0;
    let motion =
        coordinates_from_table(&model, &read("demo/input/walk.mot"), "walk", &mut Findings::default()).unwrap();
    let grf = read("demo/input/walk_grf.mot");
    let names = order(&document, "ground");
    let column = |name: &String| motion.columns[model.coordinate(name).unwrap().index()].clone();
    let zeros = || vec![0.0; FRAMES];
    let positions = names.iter().map(|name| column(name).map_or_else(zeros, |column| column[..FRAMES].to_vec()));
    let centre = |k: usize| {
        let q: Vec<f64> = motion.columns.iter().map(|column| column.as_ref().map_or(0.0, |column| column[k])).collect();
        model.mass_center(&q).into()
    };
    let triple = |stem: &str| {
        let axes = ["x", "y", "z"].map(|axis| grf.column(&format!("{stem}{axis}")).unwrap());
        (0..FRAMES).map(|k| axes.map(|axis| axis[k])).collect::<Vec<[f64; 3]>>()
    };
    let contact = |side: &str| ContactFrames {
        force: triple(&format!("ground_force_{side}_v")),
        centre_of_pressure: triple(&format!("ground_force_{side}_p")),
        moment: triple(&format!("ground_torque_{side}_")),
    };
    let (trc, _) = Trc::read(&bench.read("demo/input/walk.trc")).unwrap();
    let frames = TrialFrames {
        markers: trc.markers().iter().map(|marker| marker.positions_m[..FRAMES].to_vec()).collect(),
        passes: vec![PassFrames {
            positions: positions.collect(),
            mass_centre: (0..FRAMES).map(centre).collect(),
            contacts: ["r", "l"].map(contact).into(),
        }],
    };
    let trial = |name: &str, reason: u64| TrialHeader {
        name: name.into(),
        frames: FRAMES,
        step_s: 0.01,
        missing_force: vec![MissingForce(reason); FRAMES],
        passes: vec![TrialPass { kind: PassKind::Dynamics, observed: Vec::new(), cutoff_hz: 0.0 }],
        force_plates: 2,
        kind: TrialKind::Overground,
        marker_names_guessed: false,
    };
    let header = Header {
        version: 4,
        person: Person { sex: "male".into(), height_m: 1.75, mass_kg: 75.0, age_years: 40 },
        coordinates: names.len(),
        passes: vec![Pass { kind: PassKind::Dynamics, model: text }],
        contact_bodies: vec!["calcn_r".into(), "calcn_l".into()],
        markers: trc.markers().iter().map(|marker| marker.name.clone()).collect(),
        trials: vec![trial("walk/1", 0), trial("no plates", 14)],
        ..Header::default()
    };
    B3d { header, trials: vec![frames.clone(), frames] }
}

/// Writes the first frames of a table of the demo; filters of the whole table would see what follows.
fn cut(bench: &Workbench, from: &str, to: &str) {
    let (table, _) = Table::read_storage(&bench.read(from)).unwrap();
    let columns = table.columns().map(|(name, column)| (name.to_owned(), column[..FRAMES].to_vec())).collect();
    let mut short = Table::new("short", columns).unwrap();
    short.in_degrees = table.in_degrees;
    bench.write(to, short.write_storage());
}

fn largest_difference(a: &Table, b: &Table, column: &str) -> f64 {
    let both = a.column(column).unwrap().iter().zip(b.column(column).unwrap());
    both.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn trials_of_a_subject_are_listed_and_computed_one_by_one_or_all() {
    let bench = Workbench::empty("motion_sets_b3d");
    bench.run(&["demo", "-o", "demo", "--quiet"]).done();
    bench.write("subject.b3d", subject(&bench).write().unwrap());
    let listed = bench.run(&["info", "subject.b3d"]).done().stdout;
    for line in [
        "1 walk/1: 200 frames, 1.990 s at 100 Hz, over ground, 1 pass, ground force in 200 frames",
        "2 no plates: 200 frames, 1.990 s at 100 Hz, over ground, 1 pass, ground force in 0 frames (no force plate \
         200)",
    ] {
        assert!(listed.contains(line), "{listed}");
    }
    let forces = |more: &[&str]| bench.run(&[&["forces", "subject.b3d", "--keep", "tables"], more].concat());
    forces(&["-o", "none"]).refused(&["subject.b3d: the file has 2 trials; expected one of 1 (walk/1), 2 (no plates)"]);
    forces(&["--trial", "3"]).refused(&["the file has no trial `3`", "`--trial"]);
    forces(&["--trial", "1", "--grf", "x.mot"]).refused(&["cannot be used with a .b3d", "`--grf FILE`"]);
    forces(&["--trial", "1", "--markers", "keypoints"])
        .refused(&["the marker set can only be used with markers", "`--model"]);
    bench
        .run(&["forces", "demo/input/walk.mot", "--model", "demo/input/figure.osim", "--trial", "1"])
        .refused(&["a trial is chosen in a .b3d", "`--trial"]);

    forces(&["--trial", "all", "-o", "all"]).done();
    let summary = bench.json("all/1-walk_1/summary.json");
    assert_eq!(summary["input"]["model"], "the file's own");
    assert_eq!(summary["input"]["motion"], "subject.b3d, trial 1");
    assert_eq!(summary["ground"]["source"], "measured");
    assert_eq!(bench.json("all/2-no_plates/summary.json")["ground"]["source"], "predicted");
    fs::create_dir(bench.folder.join("set")).unwrap();
    bench.write("set/subject.b3d", bench.read("subject.b3d"));
    let run = bench.run(&["validate", "set", "-o", "judged"]).done();
    let none = "subject.b3d, trial 002 (no plates): ";
    assert!(run.stdout.contains("1 of 2 trials; persons 1") && run.stdout.contains(none), "{}", run.stdout);
    assert!(bench.text("judged/means.csv").contains("\ntrial,\"subject.b3d, trial 001 (walk/1)\",subject,walk,"));
    // The same motion and forces from the demo's tables.
    cut(&bench, "demo/input/walk.mot", "walk.mot");
    cut(&bench, "demo/input/walk_grf.mot", "walk_grf.mot");
    let tables = ["walk.mot", "--model", "demo/input/figure.osim", "--grf", "walk_grf.mot"];
    bench.run(&[&["forces"], &tables[..], &["--keep", "tables", "-o", "direct"]].concat()).done();
    let [own, direct] = ["all/1-walk_1/moments.sto", "direct/moments.sto"].map(|name| bench.table(name));
    let off = largest_difference(&own, &direct, "knee_angle_r_moment");
    assert!(off < 1e-6, "{off} N.m");

    // The built-in body follows the markers, with the same forces under its feet.
    forces(&["--trial", "walk/1", "--model", "built-in", "-o", "ours"]).done();
    let summary = bench.json("ours/summary.json");
    assert_eq!((&summary["input"]["model"], &summary["ground"]["source"]), (&"built-in".into(), &"measured".into()));
    let ours = bench.table("ours/moments.sto");
    let off = largest_difference(&ours, &direct, "ankle_angle_r_moment");
    println!("ankle moments of the built-in body differ by up to {off:.2} N.m");
    assert!(off < 15.0, "{off} N.m");
}

/// A motion of the SMPL family in which a person stands, with z up.
fn standing(rate: &str) -> Npz {
    let numbers = |shape: &[usize], values: Vec<f64>| Array { shape: shape.to_vec(), data: Data::Numbers(values) };
    let frames = 60;
    let mut poses = vec![0.0; frames * 72];
    poses.iter_mut().step_by(72).for_each(|about_x| *about_x = std::f64::consts::FRAC_PI_2);
    let arrays = vec![
        ("poses".to_owned(), numbers(&[frames, 72], poses)),
        ("trans".to_owned(), numbers(&[frames, 3], vec![0.0; 3 * frames])),
        (rate.to_owned(), numbers(&[], vec![60.0])),
    ];
    Npz { arrays }
}

#[test]
fn a_motion_of_the_smpl_family_needs_a_mass_and_lengths() {
    let bench = Workbench::empty("motion_sets_npz");
    bench.write("stand.npz", standing("mocap_framerate").write().unwrap());
    bench.write("other.npz", standing("speed").write().unwrap());
    let info = bench.run(&["info", "stand.npz"]).done().stdout;
    assert!(info.contains("poses: 60 x 72 numbers") && info.contains("rate hz: 60"), "{info}");
    let forces = |more: &[&str]| bench.run(&[&["forces", "stand.npz"], more].concat());
    forces(&[]).refused(&["stand.npz: a motion of the SMPL family contains no body mass", "--mass KG"]);
    forces(&["--mass", "70"]).refused(&["the file has no lengths", "the stature of the person"]);
    forces(&["--mass", "70", "--height", "1.7", "--smpl", "stand.npz"]).refused(&["no array `v_template`"]);
    bench
        .run(&["forces", "other.npz", "--mass", "70", "--height", "1.7"])
        .refused(&["no array `mocap_framerate`; found poses, trans, speed"]);
    forces(&["--mass", "70", "--height", "1.7", "--keep", "tables", "-o", "out"]).done();
    let grf = bench.table("out/grf.mot");
    let vertical = |side: &str| grf.column(&format!("ground_force_{side}_vy")).unwrap()[30];
    let weight = 70.0 * 9.80665;
    assert!((vertical("r") + vertical("l") - weight).abs() < 0.02 * weight, "a person who stands carries the weight");
}

/// Writes a BIDS motion: channels with type and unit, and their columns.
fn write_bids(bench: &Workbench, stem: &str, channels: &[(String, &str, &str, String)], columns: &[Vec<f64>]) {
    let lines = channels.iter().map(|(name, component, kind, point)| {
        let unit = if *kind == "POS" { "m" } else { "rad" };
        format!("{name}\t{component}\t{kind}\t{point}\t{unit}\n")
    });
    let heading = "name\tcomponent\ttype\ttracked_point\tunits\n".to_owned();
    bench.write(&format!("{stem}_channels.tsv"), heading + &lines.collect::<String>());
    let row = |k: usize| columns.iter().map(|column| column[k].to_string()).collect::<Vec<_>>().join("\t") + "\n";
    bench.write(&format!("{stem}_motion.tsv"), (0..FRAMES).map(row).collect::<String>());
    bench.write(&format!("{stem}_motion.json"), r#"{"TaskName": "walk", "SamplingFrequency": 100}"#);
}

/// Adds a session with coordinates and a broken one to the data set, and computes it.
fn bids_data_set_in_a_batch(bench: &Workbench, channels: &[(String, &str, &str, String)], columns: &[Vec<f64>]) {
    write_bids(bench, "set/sub-01/ses-b/motion/sub-01_ses-b_task-walk", channels, columns);
    bench.write("set/sub-01/ses-b/motion/figure.osim", bench.read("demo/input/figure.osim"));
    bench.write("set/sub-01/ses-b/motion/sub-01_ses-b_task-lost_motion.tsv", "1\t2\n");
    let batch = ["batch", "set", "-o", "tables", "--quiet", "--part", "2", "--"];
    let size = ["--mass", "75", "--height", "1.75"];
    bench.run(&[&batch[..], &size].concat()).done();
    let read =
        |part: &str| ParquetTable::read(&bench.read(&format!("tables/trials/part-000-0000{part}.parquet"))).unwrap();
    let texts = |column: &str| -> Vec<Option<String>> {
        let of = |part| match read(part).column(column) {
            Some(ColumnValues::Text(values)) => values.clone(),
            other => panic!("{column}: {other:?}"),
        };
        ["0", "1"].into_iter().flat_map(of).collect()
    };
    let names: Vec<String> = texts("trial").into_iter().flatten().collect();
    assert_eq!(
        names,
        [
            "ses-a/motion/sub-01_ses-a_task-walk",
            "ses-b/motion/sub-01_ses-b_task-lost",
            "ses-b/motion/sub-01_ses-b_task-walk"
        ]
        .map(|stem| format!("sub-01/{stem}_motion.tsv"))
    );
    assert!(texts("person").iter().all(|person| person.as_deref() == Some("sub-01")));
    let errors = texts("error");
    assert!(errors[0].is_none() && errors[2].is_none(), "{errors:?}");
    assert!(errors[1].as_ref().is_some_and(|error| error.contains("task-lost_channels.tsv")), "{errors:?}");
    assert!(texts("inputs")[0].as_ref().is_some_and(|inputs| inputs.contains("task-walk_channels.tsv")));
    // The size of a person, in the units that are stated.
    bench.write("set/participants.tsv", "participant_id\theight\tweight\nsub-01\t175\t75\n");
    bench.write("set/participants.json", r#"{"weight": {"Units": "kg"}, "height": {"Units": "cm"}}"#);
    bench.run(&["batch", "set", "-o", "sized", "--quiet", "--part", "2"]).done();
    let sized = ParquetTable::read(&bench.read("sized/trials/part-000-00000.parquet")).unwrap();
    for column in ["mass_kg", "height_m"] {
        let value = |table: &ParquetTable| match table.column(column) {
            Some(ColumnValues::Double(values)) => values[0],
            other => panic!("{column}: {other:?}"),
        };
        assert!((value(&sized) - value(&read("0"))).abs() < 1e-12, "{column}");
    }
    for name in ["participants.tsv", "participants.json"] {
        fs::remove_file(bench.folder.join("set").join(name)).unwrap();
    }
    // The description beside a motion is a part of the trial.
    bench.write("set/sub-01/ses-a/motion/sub-01_ses-a_task-walk_motion.json", r#"{"SamplingFrequency": 100.0}"#);
    let again = ["batch", "set", "-o", "tables", "--quiet", "--part", "2", "--resume", "--"];
    bench.run(&[&again[..], &size].concat()).refused(&["sub-01_ses-a_task-walk_motion.tsv", "changed since"]);
}

#[test]
fn bids_motions_give_the_forces_of_the_same_markers_and_coordinates() {
    let bench = Workbench::empty("motion_sets_bids");
    bench.run(&["demo", "-o", "demo", "--quiet"]).done();
    let (trc, _) = Trc::read(&bench.read("demo/input/walk.trc")).unwrap();
    let (mut channels, mut columns) = (Vec::new(), Vec::new());
    let mut table = vec![("time".to_owned(), (0..FRAMES).map(|k| 0.01 * k as f64).collect::<Vec<f64>>())];
    for marker in trc.markers() {
        for (axis, component) in ["x", "y", "z"].into_iter().enumerate() {
            let metres: Vec<f64> = marker.positions_m[..FRAMES].iter().map(|p| p[axis]).collect();
            let name = format!("{}_{component}", marker.name);
            channels.push((name.clone(), component, "POS", marker.name.clone()));
            columns.push(metres.clone());
            table.push((name, metres));
        }
    }
    bench.write("markers.csv", Table::new("markers", table).unwrap().write_csv());
    write_bids(&bench, "sub-1", &channels, &columns);
    // A data set with sessions; originals of its recordings are no trials of their own.
    for folder in ["set/sub-01/ses-a/motion", "set/sub-01/ses-b/motion", "set/sourcedata"] {
        fs::create_dir_all(bench.folder.join(folder)).unwrap();
    }
    bench.write("set/dataset_description.json", "{}");
    bench.write("set/sourcedata/walk.trc", bench.read("demo/input/walk.trc"));
    write_bids(&bench, "set/sub-01/ses-a/motion/sub-01_ses-a_task-walk", &channels, &columns);
    let text = bench.run(&["info", "sub-1_motion.tsv"]).done().stdout;
    for line in [
        "kind: motion of a BIDS data set".to_owned(),
        format!("frames: {FRAMES}"),
        "rate hz: 100".to_owned(),
        format!("POS: {} in m", channels.len()),
        format!("tracked points: {}", trc.markers().len()),
        "next: ambulo forces sub-1_motion.tsv --mass KG -o out".to_owned(),
    ] {
        assert!(text.contains(&line), "`{line}` is missing in {text}");
    }
    let common = ["--mass", "75", "--height", "1.75", "--to", "1.9", "--keep", "tables"];
    let computed = |input: &[&str], out: &str| bench.run(&[&["forces"], input, &common, &["-o", out]].concat()).done();
    computed(&["sub-1_motion.tsv"], "bids");
    computed(&["markers.csv"], "csv");
    let [bids, direct] = ["bids/kinematics.mot", "csv/kinematics.mot"].map(|name| bench.table(name));
    // The calibration of these markers turns the knee by degrees after a rounding of the times; the pelvis stays.
    let off = largest_difference(&bids, &direct, "pelvis_ty");
    assert!(off < 0.02, "{off} m");

    let model = Model::from_osim(&bench.read("demo/input/figure.osim"), &mut Findings::default()).unwrap();
    let (table, _) = Table::read_storage(&bench.read("demo/input/walk.mot")).unwrap();
    let motion = coordinates_from_table(&model, &table, "walk", &mut Findings::default()).unwrap();
    let (mut channels, mut columns) = (Vec::new(), Vec::new());
    for (coordinate, column) in model.coordinates().iter().zip(&motion.columns) {
        let is_length = coordinate.name.starts_with("pelvis_t") && coordinate.name.len() == "pelvis_tx".len();
        let kind = if is_length { "POS" } else { "JNTANG" };
        let Some(column) = column else { continue };
        channels.push((coordinate.name.clone(), "n/a", kind, "n/a".to_owned()));
        columns.push(column.clone());
    }
    write_bids(&bench, "sub-2", &channels, &columns);
    let text = bench.run(&["info", "sub-2_motion.tsv"]).done().stdout;
    assert!(text.contains("JNTANG: ") && text.contains("--model FILE.osim"), "{text}");
    let of_model = ["--model", "demo/input/figure.osim", "--keep", "tables"];
    bench.run(&[&["forces", "sub-2_motion.tsv", "-o", "angles"], &of_model[..]].concat()).done();
    cut(&bench, "demo/input/walk.mot", "walk.mot");
    bench.run(&[&["forces", "walk.mot", "-o", "direct"], &of_model[..]].concat()).done();
    let [angles, direct] = ["angles/kinematics.mot", "direct/kinematics.mot"].map(|name| bench.table(name));
    let off = largest_difference(&angles, &direct, "hip_flexion_l");
    assert!(off < 1e-6, "{off} degrees");
    bids_data_set_in_a_batch(&bench, &channels, &columns);
    bench.write("alone_motion.tsv", "1\t2\n");
    bench
        .run(&["forces", "alone_motion.tsv"])
        .refused(&["alone_channels.tsv: there is no such file", "described in a file next to it"]);
    bench.run(&["info", "alone_motion.tsv"]).refused(&["alone_channels.tsv: there is no such file"]);
    bench.run(&["info", "sub-1_motion.tsv", "--markers", "m.toml"]).refused(&["a .tsv lists its markers"]);
    bench.write("table.tsv", "1\t2\n");
    bench.run(&["forces", "table.tsv"]).refused(&["a .tsv is read as motion of a BIDS data set"]);
}
