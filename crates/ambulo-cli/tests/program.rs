//! The command as a user meets it: exit codes, messages, files.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]
#![allow(clippy::print_stdout, reason = "the figures are shown with --nocapture")]

mod workbench;

use ambulo::analysis::{Settings, analyse};
use ambulo::findings::Findings;
use ambulo::model::from_osim;
use ambulo::motion::filter::LowPass;
use ambulo::motion::{Smoother, Window, coordinates_from_table, force_recordings};
use ambulo::report::output_files;
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;
use serde_json::Value;
use std::time::Duration;
use workbench::{FORCES, INPUT, RAW, Workbench, demo_input};

/// Largest difference of a column in two tables of the same length.
fn largest_difference(a: &Table, b: &Table, column: &str) -> f64 {
    let (a, b) = (a.column(column).unwrap(), b.column(column).unwrap());
    assert_eq!(a.len(), b.len(), "{column}");
    a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

// ---- Guide, help, options ----

#[test]
fn alone_it_prints_a_guide() {
    let run = Workbench::empty("guide").run(&[]).done();
    for verb in ["ambulo demo", "ambulo forces", "ambulo info", "ambulo compare", "--help"] {
        assert!(run.stdout.contains(verb), "{}", run.stdout);
    }
    assert!(run.stderr.is_empty(), "{}", run.stderr);
}

#[test]
fn help_of_every_verb_has_an_example() {
    let bench = Workbench::empty("help");
    for verb in ["demo", "forces", "info", "compare"] {
        let run = bench.run(&[verb, "--help"]).done();
        let example = run.stdout.split("Example").nth(1).unwrap_or_default();
        assert!(example.contains(&format!("ambulo {verb}")), "{}", run.stdout);
        assert!(run.stderr.is_empty(), "{}", run.stderr);
    }
    assert!(bench.run(&["--version"]).done().stdout.contains(env!("CARGO_PKG_VERSION")));
}

#[test]
fn what_cannot_be_asked_for_exits_with_two_and_says_what_can() {
    let bench = Workbench::new("options");
    let cases: [(&[&str], &str); 12] = [
        (&["dance"], "unrecognized subcommand"),
        (&["forces"], "<INPUT>"),
        (&["forces", "walk.mot"], "--model <FILE>"),
        (&["forces", "walk.mot", "--model", "figure.osim", "--fast"], "--fast"),
        (&["info"], "<FILE>"),
        (&["compare", "walk.mot"], "<B>"),
        (&["forces", "walk.mot", "--model", "figure.osim", "--cutoff", "0"], "a frequency above 0"),
        (&["forces", "walk.mot", "--model", "figure.osim", "--cutoff", "six"], "or `off`"),
        (&["forces", "walk.mot", "--model", "figure.osim", "--right", "calcn_r"], "BODY:PREFIX"),
        (&["forces", "walk.mot", "--model", "figure.osim", "--add-mass", "torso"], "BODY:KG"),
        (&["forces", "walk.mot", "--model", "figure.osim", "--add-mass", "torso:1:2,3"], "BODY:KG:X,Y,Z"),
        (
            &["forces", "walk.mot", "--model", "figure.osim", "--loads", "a.xml", "--right", "r:force", "--grf", "g"],
            "cannot be used with",
        ),
    ];
    for (args, words) in cases {
        let run = bench.run(args);
        assert_eq!(run.code, Some(2), "{args:?}: {}", run.stderr);
        assert!(run.stderr.contains(words), "{args:?}: {}", run.stderr);
    }
}

// ---- Bad input: each with its message ----

#[test]
fn a_missing_file_is_named_once_with_a_hint() {
    let bench = Workbench::new("missing");
    for (at, name) in [(1, "no.mot"), (3, "no.osim"), (5, "no_grf.mot"), (7, "no.xml")] {
        let mut args = FORCES;
        args[at] = name;
        let run = bench.run(&args);
        run.refused(&[&format!("{name}: there is no such file"), "hint: "]);
        assert_eq!(run.stderr.matches(name).count(), 1, "{}", run.stderr);
    }
    for args in [&["info", "no.osim"][..], &["compare", "no.osim", "walk.mot"]] {
        let run = bench.run(args);
        run.refused(&["no.osim: there is no such file"]);
        assert_eq!(run.stderr.matches("no.osim").count(), 1, "{}", run.stderr);
    }
    bench.run(&["info", "."]).refused(&["this is a folder"]);
}

#[test]
fn a_coordinate_that_the_model_does_not_know_and_one_that_is_missing_are_warned_about() {
    let bench = Workbench::new("unknown_coordinate");
    bench.edit("walk.mot", "knee_angle_r", "knee_flexion_r");
    let unknown = "the model has no such coordinates: `knee_flexion_r`";
    bench.forces(&RAW).warned(&[unknown, "the recording has no column for `knee_angle_r` (0); the default values"]);
    let codes: Vec<String> = bench.json("out/summary.json")["findings"]
        .as_array()
        .unwrap()
        .iter()
        .map(|f| f["code"].as_str().unwrap().to_owned())
        .collect();
    assert!(codes.contains(&"motion.unknown_coordinate".into()), "{codes:?}");
    assert!(codes.contains(&"motion.missing_coordinate".into()), "{codes:?}");
}

#[test]
fn the_motion_of_another_model_is_refused() {
    let bench = Workbench::new("another_model");
    bench.write("walk.mot", "c\nnRows=2\nendheader\ntime a b\n0 1 2\n0.01 1 2\n");
    bench.forces(&RAW).refused(&[
        "walk.mot",
        "no column names a coordinate of the model `demo_figure`",
        "hint: is this",
    ]);
}

#[test]
fn rows_without_numbers_are_bridged_where_short_and_refused_where_long() {
    let bench = Workbench::new("nan_rows");
    let blank = |from: usize, to: usize| {
        bench.write("walk.mot", demo_input("walk.mot"));
        bench.edit_rows("walk.mot", |mut rows| {
            for row in &mut rows[from..to] {
                row[1..].fill("nan".into());
            }
            rows
        });
        bench.forces(&RAW)
    };
    blank(100, 110).warned(&["`pelvis_tilt`: 10 missing samples were bridged"]);
    blank(100, 140).refused(&[
        "walk.mot",
        "`pelvis_tilt` has no number from 1.0000 s to 1.3900 s",
        "hint: cut the range",
    ]);
    blank(0, 5).refused(&["`pelvis_tilt` has no number from 0.0000 s to 0.0400 s"]);
}

#[test]
fn forces_without_numbers_are_refused_with_load_and_time() {
    let bench = Workbench::new("nan_forces");
    bench.edit_rows("walk_grf.mot", |mut rows| {
        rows[50][2] = "nan".into();
        rows
    });
    bench.forces(&RAW).refused(&["`right` has no number from 0.5000 s"]);
    // The fault is in the forces' file, not in the motion's.
    bench.forces(&RAW).refused(&["walk_grf.mot"]);
}

#[test]
fn the_hint_to_cut_the_range_helps_against_forces_without_numbers() {
    let bench = Workbench::new("cut_nan_forces");
    bench.edit_rows("walk_grf.mot", |mut rows| {
        rows[50][2] = "nan".into();
        rows
    });
    bench.forces(&[&RAW[..], &["--from", "0.6"]].concat()).done();
}

#[test]
fn an_error_says_what_is_wrong_once() {
    let bench = Workbench::new("once");
    let cutoff = bench.forces(&["--cutoff", "80"]);
    assert_eq!(cutoff.stderr.matches("cut-off is 80 Hz").count(), 1, "{}", cutoff.stderr);
    bench.edit("figure.osim", "<mass>8.0424<", "<mass>-8<");
    let mass = bench.run(&["info", "figure.osim"]);
    assert_eq!(mass.stderr.matches("the mass is -8 kg").count(), 1, "{}", mass.stderr);
}

#[test]
fn a_clock_that_runs_back_and_two_rows_for_one_instant_are_refused_with_their_line() {
    let bench = Workbench::new("clock");
    // Five lines of header without nRows, the names, then the rows: row 10 stands in line 17 - 1.
    let line = |name: &str, row: usize| {
        let text = bench.text(name);
        text.lines().position(|l| l.trim() == "endheader").unwrap() + 3 + row
    };
    for (name, words) in [("walk.mot", "walk.mot"), ("walk_grf.mot", "walk_grf.mot")] {
        let with_time = |time: &str| {
            bench.write(name, demo_input(name));
            bench.edit_rows(name, |mut rows| {
                rows[10][0] = time.to_owned();
                rows[10][2] = "123".into();
                rows
            });
            let run = bench.forces(&RAW);
            (run, format!("line {}", line(name, 10)))
        };
        let (run, line) = with_time("0.05");
        run.refused(&[words, &line, "time 0.05 s comes after 0.09 s", "hint: sort the rows"]);
        let (run, line) = with_time("0.09");
        run.refused(&[words, &line, "a second row for time 0.09 s", "hint: delete one of the two"]);
        let (run, line) = with_time("nan");
        run.refused(&[words, &line, "the time is NaN"]);
        bench.write(name, demo_input(name));
    }
}

#[test]
fn degrees_under_a_header_of_radians_are_warned_about() {
    let bench = Workbench::new("degrees");
    bench.edit("walk.mot", "inDegrees=yes", "inDegrees=no");
    bench.forces(&RAW).warned(&["look like degrees", "hint: set inDegrees=yes"]);
}

#[test]
fn plates_in_millimetres_are_warned_about() {
    let bench = Workbench::new("millimetres");
    bench.edit_rows("walk_grf.mot", |mut rows| {
        for row in &mut rows {
            for cell in [4, 5, 6, 13, 14, 15] {
                row[cell] = format!("{}", 1e3 * row[cell].parse::<f64>().unwrap());
            }
        }
        rows
    });
    let names = bench.table("walk_grf.mot").names().join(" ");
    assert!(names.contains("ground_torque_r_z ground_force_l_vx"), "columns moved: {names}");
    bench.forces(&RAW).warned(&["its points look like millimetres", "hint: divide the points by 1000"]);
}

#[test]
fn a_load_on_a_body_that_does_not_exist_is_refused_with_the_bodies_that_do() {
    let bench = Workbench::new("unknown_body");
    bench.edit("walk_grf.xml", "calcn_r", "hoof_r");
    bench.forces(&RAW).refused(&["walk_grf.xml", "the load `right`", "the body `hoof_r`", "calcn_r"]);
    let named =
        [&FORCES[..6], &["--right", "hoof_r:ground_force_r_", "--left", "calcn_l:ground_force_l_"], &RAW].concat();
    bench.run(&named).refused(&["the body `hoof_r`", "calcn_r"]);
    bench.run(&[&FORCES[..], &["--add-mass", "hoof_r:1"]].concat()).refused(&["--add-mass", "`hoof_r`", "calcn_r"]);
}

#[test]
fn a_load_whose_columns_do_not_exist_is_refused_with_the_columns_that_do() {
    let bench = Workbench::new("unknown_columns");
    bench.edit("walk_grf.xml", "ground_force_r_v", "plate_v");
    bench.forces(&RAW).refused(&[
        "no column `plate_vx`",
        "the force of the load `right`",
        "ground_force_r_vx",
        "hint: ",
    ]);
}

#[test]
fn without_ground_forces_the_user_is_told_what_to_give() {
    let bench = Workbench::new("no_ground");
    bench.run(&FORCES[..4]).refused(&["no ground forces were given", "--grf", "hint: --no-ground"]);
    bench.run(&[&FORCES[..4], &["--no-ground"], &RAW].concat()).done();
    assert_eq!(bench.json("out/summary.json")["ground"]["source"], "none");
    assert!(!bench.folder.join("out/grf.mot").exists(), "forces that nobody measured were written");
}

#[test]
fn an_empty_file_is_refused_whichever_it_is() {
    let bench = Workbench::new("empty");
    for name in INPUT {
        for content in ["", " \n\t\n"] {
            bench.write(name, content);
            bench.forces(&RAW).refused(&[name, "the file is empty; expected"]);
            bench.run(&["info", name]).refused(&[name, "the file is empty; expected"]);
        }
        bench.write(name, demo_input(name));
    }
}

#[test]
fn a_file_of_another_kind_is_refused() {
    let bench = Workbench::new("another_kind");
    for (name, other) in [(0, 1), (1, 0), (2, 3), (3, 2), (3, 0), (0, 3)].map(|(a, b)| (INPUT[a], INPUT[b])) {
        bench.write(name, demo_input(other));
        bench.forces(&RAW).refused(&[name]);
        bench.write(name, demo_input(name));
    }
    for input in ["walk.trc", "walk.c3d", "walk.bvh"] {
        bench.run(&["forces", input, "--model", "figure.osim"]).refused(&[input]);
    }
    bench.write("notes.txt", "walk");
    bench.run(&["info", "notes.txt"]).refused(&["notes.txt", "unknown kind of file `.txt`", ".osim"]);
}

#[test]
fn a_truncated_file_is_refused_or_its_missing_rows_are_said() {
    let bench = Workbench::new("truncated");
    for name in INPUT {
        let bytes = demo_input(name);
        // Where only the last number is cut, nobody can tell.
        let last_row = bytes.trim_ascii_end().iter().rposition(|&b| b == b'\n').unwrap();
        let step = bytes.len() / 60 + 1;
        for cut in (0..bytes.len()).step_by(step).chain([last_row, last_row + 3]) {
            bench.write(name, &bytes[..cut]);
            let run = bench.forces(&RAW);
            if run.code == Some(0) && name.ends_with(".mot") {
                assert!(
                    cut > last_row || run.stderr.contains("the header states"),
                    "{name} cut at {cut}: {}",
                    run.stderr
                );
            } else {
                run.refused(&[name]);
            }
        }
        bench.write(name, &bytes);
    }
    bench.forces(&RAW).done();
}

#[test]
fn no_reader_panics_on_input_cut_at_every_100th_byte() {
    let [figure, walk, grf, loads] = INPUT.map(demo_input);
    let end = |bytes: &[u8]| bytes.trim_ascii_end().len();
    let whole = OsimModel::read(&figure).unwrap();
    let model = from_osim(&whole, &mut Findings::default()).unwrap();
    for cut in (0..end(&figure)).step_by(100) {
        assert!(OsimModel::read(&figure[..cut]).is_err(), "the model reads when cut at {cut}");
    }
    for cut in (0..end(&loads)).step_by(100) {
        assert!(ExternalLoads::read(&loads[..cut]).is_err(), "the loads read when cut at {cut}");
    }
    let loads = ExternalLoads::read(&loads).unwrap().0;
    let settings = Settings { smoother: Smoother::Off, force_filter: None, window: Window::default(), rate_hz: None };
    let (mut read, mut analysed) = (0, 0);
    for (bytes, is_motion) in [(&walk, true), (&grf, false)] {
        for cut in (0..end(bytes)).step_by(100) {
            let mut findings = Findings::default();
            let Ok((table, remarks)) = Table::read_storage(&bytes[..cut]) else { continue };
            read += 1;
            assert!(!remarks.is_empty() || cut + 400 > bytes.len(), "cut at {cut} of {}, no remark", bytes.len());
            let (motion, forces) = match is_motion {
                true => (table, Table::read_storage(&grf).unwrap().0),
                false => (Table::read_storage(&walk).unwrap().0, table),
            };
            let Ok(motion) = coordinates_from_table(&model, &motion, "walk", &mut findings) else { continue };
            let Ok(plates) = force_recordings(&model, &loads, &forces, &mut findings) else { continue };
            analysed += usize::from(analyse(&model, &motion, &plates, settings, &mut findings, &mut |_| {}).is_ok());
        }
    }
    println!("{read} cut tables read with a remark, {analysed} of them went through the analysis");
    assert!(read > 0 && analysed > 0, "no cut fell between two numbers");
}

/// Everything that `forces` does between reading and writing; whether it came to the end.
fn whole_way(files: [&[u8]; 4]) -> Option<usize> {
    let [figure, walk, grf, loads] = files;
    let mut findings = Findings::default();
    let model = from_osim(&OsimModel::read(figure).ok()?, &mut findings).ok()?;
    let motion = coordinates_from_table(&model, &Table::read_storage(walk).ok()?.0, "walk", &mut findings).ok()?;
    let loads = ExternalLoads::read(loads).ok()?.0;
    let plates = force_recordings(&model, &loads, &Table::read_storage(grf).ok()?.0, &mut findings).ok()?;
    let low_pass = LowPass { order: 3, cutoff_hz: 6.0 };
    let smoother = Smoother::Butterworth(low_pass);
    let settings = Settings { smoother, force_filter: Some(low_pass), window: Window::default(), rate_hz: None };
    let analysis = analyse(&model, &motion, &plates, settings, &mut findings, &mut |_| {}).ok()?;
    Some(output_files(&model, &analysis, None).ok()?.len())
}

#[test]
fn no_damaged_byte_makes_the_library_panic() {
    // The first second of the walk; damage from a linear congruential generator (Knuth's MMIX constants, seed 3).
    let short = |name: &str| demo_input(name).split_inclusive(|&b| b == b'\n').take(106).collect::<Vec<_>>().concat();
    let files = [demo_input(INPUT[0]), short(INPUT[1]), short(INPUT[2]), demo_input(INPUT[3])];
    let mut state: u64 = 3;
    let mut random = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let damage = b"0123456789-+.eE \t\n<>/\"=nai,;\0\xff";
    let mut through = 0;
    for round in 0..1200 {
        let mut damaged = files.clone();
        let file = &mut damaged[round % 4];
        for _ in 0..=random(3) {
            let at = random(file.len());
            match random(3) {
                0 => file[at] = damage[random(damage.len())],
                1 => drop(file.remove(at)),
                _ => file.insert(at, damage[random(damage.len())]),
            }
        }
        let [figure, walk, grf, loads] = &damaged;
        through += usize::from(whole_way([figure, walk, grf, loads]).is_some());
    }
    println!("{through} of 1200 damaged inputs went through");
    assert!(through > 100, "only {through} of 1200: the damage never reaches the analysis");
}

#[test]
fn an_entity_bomb_is_refused_at_once() {
    let entity = |i: usize| format!("<!ENTITY e{} \"{}\">\n", i + 1, format!("&e{i};").repeat(10));
    let entities: String = (0..9).map(entity).collect();
    let bomb = format!("<?xml version=\"1.0\"?>\n<!DOCTYPE bomb [<!ENTITY e0 \"ha\">\n{entities}]>\n");
    let bench = Workbench::new("bomb");
    for (name, body) in [
        ("figure.osim", "<OpenSimDocument Version=\"40000\"><Model name=\"&e9;\"></Model></OpenSimDocument>"),
        ("walk_grf.xml", "<OpenSimDocument Version=\"40000\"><ExternalLoads name=\"&e9;\"/></OpenSimDocument>"),
    ] {
        bench.write(name, format!("{bomb}{body}"));
        let run = bench.run_in_a_gigabyte(&FORCES);
        run.refused(&[name, "not a readable XML document", "DTD"]);
        assert!(run.took < Duration::from_secs(5), "{:?}", run.took);
        bench.run_in_a_gigabyte(&["info", name]).refused(&[name]);
        bench.write(name, demo_input(name));
    }
}

#[test]
fn elements_nested_without_end_are_refused() {
    let bench = Workbench::new("nested");
    let depth = 100_000;
    let nest = |open: &str, inside: &str, close: &str| format!("{}{inside}{}", open.repeat(depth), close.repeat(depth));
    bench.write(
        "deep.osim",
        format!("<OpenSimDocument Version=\"40000\"><Model>{}</Model></OpenSimDocument>", nest("<a>", "", "</a>")),
    );
    bench.run_in_a_gigabyte(&["info", "deep.osim"]).refused(&["deep.osim"]);
    bench.write("deep.xml", nest("<a>", "", "</a>"));
    bench.run_in_a_gigabyte(&["info", "deep.xml"]).refused(&["deep.xml"]);
}

#[test]
fn functions_nested_without_end_are_refused() {
    // A reader that calls itself for each level needs a limit: the stack ends the program without a message.
    let bench = Workbench::new("nested_functions");
    for depth in [100, 1_000, 10_000, 100_000] {
        let open = "<MultiplierFunction><scale>1</scale><function>".repeat(depth);
        let close = "</function></MultiplierFunction>".repeat(depth);
        let function = format!("{open}<LinearFunction><coefficients>1 0</coefficients></LinearFunction>{close}");
        bench.write("figure.osim", demo_input("figure.osim"));
        let text = bench.text("figure.osim");
        let at = text.find("<LinearFunction").unwrap();
        let end = at + text[at..].find("</LinearFunction>").unwrap() + "</LinearFunction>".len();
        bench.write("figure.osim", format!("{}{function}{}", &text[..at], &text[end..]));
        let run = bench.run_in_a_gigabyte(&["info", "figure.osim"]);
        assert!(matches!(run.code, Some(0 | 2)), "{depth} levels: {}", run.stderr);
    }
}

#[test]
fn a_joint_whose_child_is_ground_is_refused() {
    let bench = Workbench::new("ground_is_child");
    let joint = "<WeldJoint name=\"back\"><socket_parent_frame>/bodyset/torso</socket_parent_frame>\
        <socket_child_frame>/ground</socket_child_frame></WeldJoint>\n</objects></JointSet>";
    bench.edit("figure.osim", "</objects></JointSet>", joint);
    let run = bench.run_in_a_gigabyte(&["info", "figure.osim"]);
    run.refused(&["figure.osim", "`back`", "ground"]);
}

#[test]
fn a_hundred_megabytes_of_garbage_are_refused_in_a_gigabyte_and_a_few_seconds() {
    const SIZE: usize = 100 << 20;
    let bench = Workbench::new("garbage").removed_at_the_end();
    let mut state: u64 = 11;
    let mut bytes = Vec::with_capacity(SIZE);
    while bytes.len() < SIZE {
        // Linear congruential generator, Knuth's MMIX constants; its upper half.
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        bytes.extend_from_slice(&state.to_be_bytes()[..4]);
    }
    let kinds = ["g.osim", "g.mot", "g.csv", "g.trc", "g.xml"];
    let refuse_all = |what: &str| {
        for kind in kinds {
            std::fs::rename(bench.folder.join("garbage"), bench.folder.join(kind)).unwrap();
            let mut runs = vec![vec!["info", kind]];
            let place = match kind {
                "g.osim" => Some(3),
                "g.mot" => Some(1),
                "g.csv" => Some(5),
                "g.xml" => Some(7),
                _ => None,
            };
            if let Some(place) = place {
                let mut args = FORCES.to_vec();
                args[place] = kind;
                runs.push(args);
            }
            for args in runs {
                let run = bench.run_in_a_gigabyte(&args);
                println!("{what} as {kind}, {}: {:?}, {}", args[0], run.took, run.stderr.trim());
                run.refused(&[kind]);
                assert!(run.took < Duration::from_secs(10), "{args:?} took {:?}", run.took);
                assert!(run.stderr.len() < 2000, "the message has {} bytes", run.stderr.len());
            }
            std::fs::rename(bench.folder.join(kind), bench.folder.join("garbage")).unwrap();
        }
    };
    bench.write("garbage", &bytes);
    refuse_all("random bytes");
    bench.write("garbage", vec![0; SIZE]);
    refuse_all("zeros");
    let tags: Vec<u8> = b"<a></a>\n".iter().copied().cycle().take(SIZE).collect();
    bench.write("garbage", [b"<a>\n", &tags[..]].concat());
    refuse_all("empty elements");
}

// ---- Results ----

#[test]
fn a_run_writes_the_documented_files_with_the_documented_columns() {
    let bench = Workbench::new("files");
    let run = bench.forces(&RAW).done();
    assert!(run.stdout.contains("demo_figure") && run.stdout.contains("ankle_angle_r_moment"), "{}", run.stdout);
    let coordinates = bench.table("walk.mot").names()[1..].to_vec();
    let model = from_osim(&OsimModel::read(&bench.read("figure.osim")).unwrap(), &mut Findings::default()).unwrap();
    let times = bench.table("walk.mot").times().unwrap().to_vec();
    let expect = |file: &str, names: &mut dyn Iterator<Item = String>| {
        let table = bench.table(&format!("out/{file}"));
        let names: std::collections::BTreeSet<String> = names.chain(["time".into()]).collect();
        let found: std::collections::BTreeSet<String> = table.names().iter().cloned().collect();
        assert_eq!(found, names, "{file}");
        let largest = table.times().unwrap().iter().zip(&times).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(table.rows() == times.len() && largest < 1e-9, "{file} has other instants: {} rows", table.rows());
        // Written and read, it is the same bytes when written again.
        assert_eq!(table.write_storage(), bench.read(&format!("out/{file}")), "{file}");
        table
    };
    let kinematics = expect("kinematics.mot", &mut coordinates.iter().cloned());
    assert_eq!(kinematics.in_degrees, Some(true));
    for name in &coordinates {
        let difference = largest_difference(&kinematics, &bench.table("walk.mot"), name);
        assert!(difference < 1e-9, "without a filter `{name}` changes by {difference}");
    }
    expect("moments.sto", &mut model.force_names().into_iter());
    expect("powers.sto", &mut coordinates.iter().map(|c| format!("{c}_power")));
    let axes = |stem: String| ["x", "y", "z"].map(|axis| format!("{stem}{axis}"));
    let parts = |s: &str| ["ground_force_S_v", "ground_force_S_p", "ground_torque_S_"].map(|p| p.replace('S', s));
    expect("grf.mot", &mut ["r", "l"].iter().flat_map(|s| parts(s)).flat_map(axes));
    let joints = model
        .bodies()
        .iter()
        .flat_map(|b| ["f", "m", "p"].map(|part| format!("{}_on_{}_in_ground_{part}", b.joint.name, b.name)));
    expect("reactions.sto", &mut joints.flat_map(axes));

    let events = bench.text("out/events.csv");
    assert!(events.starts_with("side,event,time\n"), "{events}");
    for line in events.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        assert!(["r", "l"].contains(&cells[0]) && ["strike", "off"].contains(&cells[1]), "{line}");
        assert!(cells[2].parse::<f64>().is_ok_and(|t| (0.0..=3.0).contains(&t)), "{line}");
    }
    let cycles = bench.text("out/cycles.csv");
    assert!(cycles.starts_with("quantity,side,cycle,percent,value,unit\n"));
    assert_eq!((cycles.lines().count() - 1) % 101, 0, "a cycle has 101 rows");
    assert!(bench.text("out/figures/moments.svg").contains("</svg>"));
    let (loads, remarks) = ExternalLoads::read(&bench.read("out/external_loads.xml")).unwrap();
    assert!(remarks.is_empty() && loads.datafile.as_deref() == Some("grf.mot") && loads.forces.len() == 2);
}

#[test]
fn the_summary_has_its_stable_keys() {
    let bench = Workbench::new("summary");
    bench.forces(&RAW).done();
    let summary = bench.json("out/summary.json");
    for key in [
        "version",
        "input",
        "model",
        "mass_kg",
        "mass_source",
        "height_m",
        "speed_m_s",
        "window_s",
        "filter",
        "ground",
        "residual",
        "peaks",
        "convergence",
        "findings",
        "verdict",
        "comparison",
        "timing_ms",
    ] {
        assert!(summary.get(key).is_some(), "no key `{key}`");
    }
    for key in ["force_rms_n", "force_peak_n", "force_rms_bw", "moment_rms_nm", "moment_peak_nm"] {
        assert!(summary["residual"][key].is_number(), "no key `residual.{key}`");
    }
    assert_eq!(summary["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(summary["window_s"], serde_json::json!([0.0, 2.9]));
    // The figure has 72 kg, and its plates carry it.
    assert!((summary["mass_kg"].as_f64().unwrap() - 72.0).abs() < 0.5, "{}", summary["mass_kg"]);
}

#[test]
fn quiet_prints_nothing_and_json_is_the_summary() {
    let bench = Workbench::new("voices");
    let quiet = bench.forces(&[&RAW[..], &["--quiet"]].concat()).done();
    assert!(quiet.stdout.is_empty() && quiet.stderr.is_empty(), "{}{}", quiet.stdout, quiet.stderr);
    let json = bench.forces(&[&RAW[..], &["--json"]].concat()).done();
    let printed: Value = serde_json::from_str(&json.stdout).unwrap();
    assert_eq!(printed, bench.json("out/summary.json"));
    for args in [&["info", "walk.mot"][..], &["compare", "walk.mot", "walk.mot"]] {
        let json = bench.run(&[args, &["--json"]].concat()).done();
        serde_json::from_str::<Value>(&json.stdout).unwrap();
        assert!(bench.run(&[args, &["--quiet"]].concat()).done().stdout.is_empty());
    }
    // Errors are printed all the same.
    bench.run(&["info", "no.mot", "--quiet"]).refused(&["no.mot"]);
}

#[test]
fn the_demo_writes_its_input_and_the_same_run_can_be_repeated() {
    let bench = Workbench::empty("demo");
    bench.run(&["demo", "-o", "demo"]).done();
    for name in INPUT {
        assert_eq!(bench.read(&format!("demo/input/{name}")), demo_input(name), "{name}");
    }
    let input = |name: &str| format!("demo/input/{name}");
    let [model, motion, grf, loads] = INPUT.map(input);
    let args = ["forces", &motion, "--model", &model, "--grf", &grf, "--loads", &loads, "-o", "again"];
    bench.run(&[&args[..], &RAW].concat()).done();
    for name in ["moments.sto", "powers.sto", "reactions.sto", "kinematics.mot", "grf.mot", "events.csv", "cycles.csv"]
    {
        assert_eq!(bench.read(&format!("demo/{name}")), bench.read(&format!("again/{name}")), "{name}");
    }
}

#[test]
fn two_runs_give_identical_bytes_but_for_their_timing() {
    let bench = Workbench::new("determinism");
    let files = |folder: &str| {
        bench.forces(&["-o", folder]).done();
        let mut names: Vec<String> = std::fs::read_dir(bench.folder.join(folder))
            .unwrap()
            .map(|f| f.unwrap().file_name().into_string().unwrap())
            .filter(|name| name != "figures" && name != "summary.json")
            .collect();
        names.push("figures/moments.svg".into());
        names.sort();
        let mut summary = bench.json(&format!("{folder}/summary.json"));
        assert!(summary.as_object_mut().unwrap().remove("timing_ms").is_some());
        let bytes: Vec<_> = names.iter().map(|name| bench.read(&format!("{folder}/{name}"))).collect();
        (names, bytes, summary)
    };
    let (first, second) = (files("first"), files("second"));
    assert!(first.0.len() >= 9, "{:?}", first.0);
    assert_eq!(first, second);
}

#[test]
fn the_written_ground_forces_give_the_same_moments_when_fed_back() {
    let bench = Workbench::new("fed_back");
    bench.forces(&RAW).done();
    let again =
        ["forces", "walk.mot", "--model", "figure.osim", "--grf", "out/grf.mot", "--loads", "out/external_loads.xml"];
    bench.run(&[&again[..], &RAW, &["-o", "again"]].concat()).done();
    let grf = bench.table("walk_grf.mot");
    let vertical = |side: &str| grf.column(&format!("ground_force_{side}_vy")).unwrap();
    let (first, second) = (bench.table("out/moments.sto"), bench.table("again/moments.sto"));
    let mut small_loads = 0;
    for name in first.names().iter().skip(1) {
        let (a, b) = (first.column(name).unwrap(), second.column(name).unwrap());
        for frame in 0..first.rows() {
            let small = |side: &str| vertical(side)[frame].abs() < 20.0;
            let lost: f64 = ["r", "l"].iter().filter(|s| small(s)).map(|s| vertical(s)[frame].abs()).sum();
            small_loads += usize::from(lost > 0.0);
            // Centre of pressure and free moment carry the wrench to rounding (1e-13 of 1000 N.m about the origin).
            // Below 20 N a side the file holds zeros: what is lost acts at an arm of at most 1.3 m, hips to floor and a
            // step, and its horizontal part is at most half of it.
            let allowed = 1e-9 + 1.5 * lost * 1.3;
            let difference = (a[frame] - b[frame]).abs();
            assert!(difference <= allowed, "{name}, frame {frame}: {difference}, {lost} N were lost");
        }
    }
    println!("{small_loads} of {} numbers stand at loads below 20 N", first.rows() * (first.names().len() - 1));
    // The same file without its description is recognised by its column names.
    bench.run(&[&again[..6], &RAW, &["-o", "guessed"]].concat()).done();
    assert_eq!(bench.read("guessed/moments.sto"), bench.read("again/moments.sto"));
    // Left out, the forces are missed: several hundred newtons at the root.
    bench.run(&[&FORCES[..4], &RAW, &["--no-ground", "-o", "without"]].concat()).done();
    assert!(largest_difference(&first, &bench.table("without/moments.sto"), "pelvis_ty_force") > 500.0);
}

#[test]
fn feet_can_be_named_on_the_command_line_instead_of_in_a_document() {
    let bench = Workbench::new("named_feet");
    bench.forces(&RAW).done();
    let feet = ["--right", "calcn_r:ground_force_r_", "--left", "calcn_l:ground_force_l_", "-o", "named"];
    bench.run(&[&FORCES[..6], &feet, &RAW].concat()).done();
    assert_eq!(bench.read("out/moments.sto"), bench.read("named/moments.sto"));
    let swapped = ["--right", "calcn_r:ground_force_l_", "--left", "calcn_l:ground_force_r_", "-o", "swapped"];
    bench.run(&[&FORCES[..6], &swapped, &RAW].concat()).done();
    let difference =
        largest_difference(&bench.table("out/moments.sto"), &bench.table("swapped/moments.sto"), "knee_angle_r_moment");
    assert!(difference > 50.0, "swapped feet change the knee by {difference} N.m only");
}

#[test]
fn a_device_that_gives_half_of_the_ankle_moment_leaves_the_other_half_to_the_body() {
    let bench = Workbench::new("device");
    bench.forces(&RAW).done();
    let total = bench.table("out/moments.sto");
    let half: Vec<f64> = total.column("ankle_angle_r_moment").unwrap().iter().map(|x| 0.5 * x).collect();
    let times = total.times().unwrap().to_vec();
    let device = Table::new("exoskeleton", vec![("time".into(), times), ("ankle_angle_r_moment".into(), half.clone())]);
    bench.write("device.sto", device.unwrap().write_storage());
    bench.forces(&[&RAW[..], &["--device", "device.sto", "-o", "worn"]].concat()).done();
    assert_eq!(bench.read("worn/moments.sto"), bench.read("out/moments.sto"), "the total does not change");
    let body = bench.table("worn/moments_biological.sto");
    for name in total.names().iter().skip(1) {
        let expected = if name == "ankle_angle_r_moment" { &half[..] } else { total.column(name).unwrap() };
        let worst = body.column(name).unwrap().iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-9, "{name}: {worst}");
    }
    assert!(!bench.folder.join("out/moments_biological.sto").exists());
    bench.write("device.sto", "x\nendheader\ntime elbow\n0 1\n1 1\n");
    bench.forces(&["--device", "device.sto"]).refused(&[
        "device.sto",
        "no column of the device",
        "ankle_angle_r_moment",
    ]);
}

#[test]
fn a_mass_carried_on_the_torso_loads_the_back_and_the_root_and_no_leg() {
    let bench = Workbench::new("add_mass");
    bench.forces(&RAW).done();
    let carried = ["--add-mass", "torso:10:-0.15,0.3,0", "-o", "carried"];
    bench.forces(&[&RAW[..], &carried].concat()).done();
    let (before, after) = (bench.table("out/moments.sto"), bench.table("carried/moments.sto"));
    let more = |name: &str| mean(after.column(name).unwrap()) - mean(before.column(name).unwrap());
    // The plates did not feel it, so the root must hold it: m g on the average, and m Δv / T for what its speed changes
    // from the first frame to the last (at most 0.3 m/s over 2.9 s: 1 N).
    assert!((more("pelvis_ty_force") - 98.07).abs() < 1.0, "{} N", more("pelvis_ty_force"));
    // 0.15 m behind the back's centre, 15 N.m of extension are to be held, less or more as the trunk leans by degrees
    // (10 degrees move it by 0.05 m: 5 N.m).
    assert!((more("lumbar_extension_moment").abs() - 14.7).abs() < 6.0, "{} N.m", more("lumbar_extension_moment"));
    // A leg's moments follow from what is below them.
    for name in ["hip_flexion_r_moment", "knee_angle_l_moment", "ankle_angle_r_moment"] {
        assert!(largest_difference(&before, &after, name) < 1e-9, "{name}");
    }
    // A shoe of 1 kg does change the hip.
    bench.forces(&[&RAW[..], &["--add-mass", "calcn_r:1:0.05,-0.05,0", "-o", "shod"]].concat()).done();
    let hip = largest_difference(&before, &bench.table("shod/moments.sto"), "hip_flexion_r_moment");
    assert!(hip > 3.0, "a shoe of 1 kg changes the hip by {hip} N.m only");
    assert!(largest_difference(&before, &bench.table("shod/moments.sto"), "hip_flexion_l_moment") < 1e-9);
    for (mass, words) in [("torso:-1000", "the mass is -1000 kg"), ("torso:nan", "the mass is NaN kg")] {
        bench.forces(&["--add-mass", mass]).refused(&["--add-mass", words]);
    }
}

#[test]
fn from_and_to_cut_the_range_without_changing_a_number() {
    let bench = Workbench::new("window");
    bench.forces(&["--cutoff", "6"]).done();
    bench.forces(&["--cutoff", "6", "--from", "0.5", "--to", "1.25", "-o", "cut"]).done();
    let (whole, cut) = (bench.table("out/moments.sto"), bench.table("cut/moments.sto"));
    assert_eq!(cut.rows(), 76);
    assert!((cut.times().unwrap()[0] - 0.5).abs() < 1e-9 && (cut.times().unwrap()[75] - 1.25).abs() < 1e-9);
    for name in whole.names().iter().skip(1) {
        let pairs = whole.column(name).unwrap()[50..126].iter().zip(cut.column(name).unwrap());
        // Instants of the two grids differ in the last bit; moments change by up to 1e4 N.m/s.
        let worst = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-7, "{name}: {worst}");
    }
    bench.forces(&["--from", "5", "--to", "6"]).refused(&[
        "the range from 5 s to 6 s has 0 frames",
        "hint: motion and forces were both recorded from 0 s to 2.9 s",
    ]);
    bench.forces(&["--from", "2", "--to", "1"]).refused(&["--from 2 is after --to 1"]);
    bench.forces(&["--cutoff", "80"]).refused(&["cut-off is 80 Hz", "hint: "]);
    bench.forces(&["--order", "0"]).refused(&["expected a whole number from 1 to 8"]);
    bench.forces(&["--from", "nan"]).refused(&["expected a number of seconds"]);
    bench.forces(&["--cutoff", "-6"]).refused(&["expected a frequency above 0 in Hz, or `off`"]);
}

// ---- Small tools ----

#[test]
fn compare_exits_with_one_where_a_limit_is_missed_and_two_where_nothing_can_be_compared() {
    let bench = Workbench::empty("compare");
    let table = |offset: f64| {
        format!("t\nendheader\ntime\ta\tb\n0\t{}\t1\n1\t{}\t2\n2\t{}\t3\n", offset, 1.0 + offset, 2.0 + offset)
    };
    bench.write("a.sto", table(0.0));
    bench.write("b.sto", table(0.25));
    let same = bench.run(&["compare", "a.sto", "a.sto", "--limit", "0"]).done();
    assert!(same.stdout.contains("0 of 2 columns over the limit"), "{}", same.stdout);
    bench.run(&["compare", "a.sto", "b.sto"]).done();
    bench.run(&["compare", "a.sto", "b.sto", "--limit", "0.26"]).done();
    let over = bench.run(&["compare", "a.sto", "b.sto", "--limit", "0.24"]);
    assert_eq!(over.code, Some(1), "{}", over.stderr);
    assert!(over.stdout.contains("1 of 2 columns over the limit"), "{}", over.stdout);
    bench.run(&["compare", "a.sto", "b.sto", "--limit", "0.24", "--columns", "b"]).done();
    let json: Value = serde_json::from_str(&bench.run(&["compare", "a.sto", "b.sto", "--json"]).done().stdout).unwrap();
    assert!((json[0]["rmse"].as_f64().unwrap() - 0.25).abs() < 1e-12 && json[0]["samples"] == 3, "{json}");

    bench.run(&["compare", "a.sto", "b.sto", "--columns", "c"]).refused(&["there is no column `c`", "a, b"]);
    bench
        .run(&["compare", "a.sto", "b.sto", "--from", "7"])
        .refused(&["no row between --from and --to", "from 0 s to 2 s"]);
    bench.write("late.sto", "t\nendheader\ntime\ta\n8\t1\n9\t1\n");
    bench.run(&["compare", "a.sto", "late.sto"]).refused(&["no common time", "from 8 s to 9 s"]);
    bench.write("other.sto", "t\nendheader\ntime\tz\n0\t1\n");
    bench.run(&["compare", "a.sto", "other.sto"]).refused(&["no column in common"]);
    bench.write("hole.sto", "t\nendheader\ntime\ta\n0\tnan\n1\t1\n");
    bench.run(&["compare", "a.sto", "hole.sto"]).refused(&["column `a`", "not a finite number at 0.0000 s", "hint: "]);
}

#[test]
fn compare_refuses_a_clock_that_runs_back() {
    // Values between samples are looked up by bisection, which returns nonsense in unsorted instants.
    let bench = Workbench::empty("compare_clock");
    bench.write("a.sto", "t\nendheader\ntime\ta\n0\t0\n2\t2\n1\t1\n3\t3\n");
    bench.write("b.sto", "t\nendheader\ntime\ta\n0\t0\n1\t1\n2\t2\n3\t3\n");
    bench.run(&["compare", "a.sto", "b.sto"]).refused(&["a.sto", "time"]);
}

#[test]
fn info_tells_what_each_kind_of_file_holds() {
    let bench = Workbench::new("info");
    let json = |file: &str| serde_json::from_str::<Value>(&bench.run(&["info", file, "--json"]).done().stdout).unwrap();
    let model = json("figure.osim");
    assert_eq!(model["kind"], "OpenSim model");
    assert!((model["mass_kg"].as_f64().unwrap() - 72.0).abs() < 0.01, "{model}");
    assert_eq!((model["bodies"].as_array().unwrap().len(), model["coordinates"].as_array().unwrap().len()), (8, 19));
    let motion = json("walk.mot");
    assert_eq!(
        (&motion["kind"], &motion["rows"], &motion["angles"]),
        (&"OpenSim storage".into(), &291.into(), &"degrees".into())
    );
    assert!((motion["rate_hz"].as_f64().unwrap() - 100.0).abs() < 1e-9, "{motion}");
    let loads = json("walk_grf.xml");
    assert_eq!((&loads["kind"], &loads["data_file"]), (&"external loads".into(), &"walk_grf.mot".into()));
    bench.write("a.csv", "time,force\n0,1\n0.5,2\n");
    assert_eq!(json("a.csv")["columns"], serde_json::json!(["time", "force"]));
    bench.write(
        "a.trc",
        "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\t\
         OrigDataStartFrame\tOrigNumFrames\n100\t100\t1\t1\tmm\t100\t1\t1\nFrame#\tTime\tHeel\t\t\n\t\tX1\tY1\tZ1\n\n\
         1\t0.0\t12.5\t30\t-4.1\n",
    );
    assert_eq!(json("a.trc")["markers"], serde_json::json!(["Heel"]));
    for file in ["figure.osim", "walk.mot", "walk_grf.xml", "a.csv", "a.trc"] {
        let run = bench.run(&["info", file]).done();
        assert!(run.stdout.starts_with("kind: ") || run.stdout.contains("\nkind: "), "{file}: {}", run.stdout);
    }
}

// ---- Input that does not belong together ----

#[test]
fn exchanged_feet_are_noticed() {
    let bench = Workbench::new("exchanged");
    let swapped = ["--right", "calcn_r:ground_force_l_", "--left", "calcn_l:ground_force_r_"];
    let run = bench.run(&[&FORCES[..4], &["--grf", "walk_grf.mot"], &swapped, &RAW].concat()).done();
    run.warned(&["`calcn_r` acts", "from the other foot", "right and left may be exchanged"]);
    assert!(!bench.forces(&RAW).done().stderr.contains("exchanged"));
}

#[test]
fn forces_on_the_plate_in_place_of_forces_on_the_foot_are_noticed() {
    let bench = Workbench::new("downward");
    bench.edit_rows("walk_grf.mot", |mut rows| {
        for row in &mut rows[1..] {
            for cell in &mut row[1..4] {
                *cell = format!("{}", -cell.parse::<f64>().unwrap());
            }
        }
        rows
    });
    let run = bench.forces(&RAW).done();
    run.warned(&["pulls `calcn_r` down", "hint: change the sign of forces and torques"]);
    run.warned(&["the residual at the root is", "hint: check files, sides and time origin"]);
}

#[test]
fn a_knee_that_bends_the_other_way_is_noticed() {
    let bench = Workbench::new("knee");
    let joint = "<Coordinate name=\"knee_angle_r\"><default_value>0</default_value>";
    bench.edit("figure.osim", joint, &format!("{joint}<range>-0.1 2.1</range>"));
    bench.forces(&RAW).done().warned(&["`knee_angle_r` runs from -6", "the model allows -6 to 120"]);
}

// ---- Folders ----

#[test]
fn what_was_read_is_never_written_over() {
    let bench = Workbench::new("same_folder");
    bench.write("external_loads.xml", bench.read("walk_grf.xml"));
    let before = bench.read("external_loads.xml");
    bench
        .run(&[&FORCES[..4], &["--loads", "external_loads.xml", "-o", "."], &RAW].concat())
        .refused(&["external_loads.xml: this file was read and would be written over", "hint: choose another folder"]);
    assert_eq!(bench.read("external_loads.xml"), before);
}

#[test]
fn results_of_an_earlier_run_do_not_stay_beside_those_of_the_next() {
    let bench = Workbench::new("stale");
    bench.forces(&[&RAW[..], &["-o", "out"]].concat()).done();
    assert!(!bench.read("out/cycles.csv").is_empty());
    bench.write("out/notes.txt", "mine");
    bench.run(&[&FORCES[..4], &RAW, &["--no-ground", "-o", "out"]].concat()).done();
    assert!(
        !bench.exists("out/cycles.csv") && !bench.exists("out/grf.mot") && !bench.exists("out/figures/moments.svg")
    );
    assert!(bench.exists("out/moments.sto") && bench.exists("out/notes.txt"));
}
