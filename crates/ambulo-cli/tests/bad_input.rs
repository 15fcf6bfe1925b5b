//! Mistakes of users: each gives a clear message and exit code 2, or a finding, and never a panic.

use crate::workbench::{FORCES, INPUT, RAW, Workbench, demo_input};
use ambulo::analysis::{AnalysisSettings, analyse};
use ambulo::findings::Findings;
use ambulo::model::from_osim;
use ambulo::motion::filter::LowPass;
use ambulo::motion::{Smoother, Window, coordinates_from_table, force_recordings};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;
use ambulo_report::figure_files;
use ambulo_results::{Keep, output_files};

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
#[cfg(target_os = "linux")]
fn a_device_or_a_pipe_is_rejected_at_once() {
    let bench = Workbench::new("device");
    let made = std::process::Command::new("mkfifo").arg(bench.folder.join("pipe.toml")).status().unwrap();
    assert!(made.success());
    for args in [&["simulate", "/dev/zero"][..], &["simulate", "pipe.toml"], &["walk", "--gait", "pipe.toml"]] {
        bench.run(args).refused(&["this is a pipe or a device; expected a file", "hint: "]);
    }
}

#[test]
fn control_codes_of_a_file_name_do_not_reach_the_terminal() {
    let bench = Workbench::new("control_codes");
    let name = "red\u{1b}[31m\u{7}\u{9b}.mot";
    let run = bench.run(&["info", name]);
    run.refused(&["red\u{fffd}[31m", "there is no such file"]);
    bench.write(name, bench.read("walk.mot"));
    let run = bench.run(&["info", name]).done();
    for text in [run.stdout, run.stderr] {
        assert!(!text.contains(|c: char| c.is_control() && c != '\n' && c != '\t'), "{text:?}");
    }
}

#[test]
fn unknown_and_missing_coordinates_give_warnings() {
    let bench = Workbench::new("unknown_coordinate");
    bench.edit("walk.mot", "knee_angle_r", "knee_flexion_r");
    let unknown = "the model has no such coordinates: `knee_flexion_r`";
    bench
        .forces(&RAW)
        .infeasible()
        .warned(&[unknown, "the recording has no column for `knee_angle_r` (0); the default values"]);
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
fn the_motion_of_another_model_is_rejected() {
    let bench = Workbench::new("another_model");
    bench.write("walk.mot", "c\nnRows=2\nendheader\ntime a b\n0 1 2\n0.01 1 2\n");
    bench.forces(&RAW).refused(&[
        "walk.mot",
        "no column names a coordinate of the model `demo_figure`",
        "hint: is this",
    ]);
}

#[test]
fn short_gaps_in_the_motion_are_interpolated_and_long_ones_rejected() {
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
        "hint: choose a range without the gap; `--from` and `--to`",
    ]);
    blank(0, 5).refused(&["`pelvis_tilt` has no number from 0.0000 s to 0.0400 s"]);
}

#[test]
fn rows_that_all_have_one_time_are_named_and_no_standing_person_is_blamed() {
    let bench = Workbench::new("one_time");
    bench.edit_rows("walk.mot", |rows| vec![rows[7].clone(); 50]);
    let run = bench.forces(&RAW);
    assert!(!run.stderr.contains("standing"), "{}", run.stderr);
    run.refused(&["walk.mot", "all 50 rows have the time", "expected increasing times"]);
}

#[test]
fn a_force_that_is_not_a_number_is_rejected_with_its_load_and_time() {
    let bench = Workbench::new("nan_forces");
    bench.edit_rows("walk_grf.mot", |mut rows| {
        rows[50][2] = "nan".into();
        rows
    });
    bench.forces(&RAW).refused(&["`right` has no number at 0.5000 s"]);
    // The error is in the force file, not in the motion file.
    bench.forces(&RAW).refused(&["walk_grf.mot"]);
}

#[test]
fn the_hint_to_choose_another_time_range_works() {
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
fn decreasing_and_repeated_times_are_rejected_with_their_line() {
    let bench = Workbench::new("clock");
    // Five lines of header without nRows, the names, then the rows: row 10 is in line 17 - 1.
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
fn degrees_in_a_file_declared_in_radians_give_a_warning() {
    let bench = Workbench::new("degrees");
    bench.edit("walk.mot", "inDegrees=yes", "inDegrees=no");
    bench.forces(&RAW).infeasible().warned(&["look like degrees", "hint: set inDegrees=yes"]);
}

#[test]
fn centres_of_pressure_in_millimetres_give_a_warning() {
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
    bench.forces(&RAW).infeasible().warned(&["its points look like millimetres", "hint: divide the points by 1000"]);
}

#[test]
fn a_load_on_a_body_that_does_not_exist_is_rejected_with_the_bodies_that_do() {
    let bench = Workbench::new("unknown_body");
    bench.edit("walk_grf.xml", "calcn_r", "hoof_r");
    bench.forces(&RAW).refused(&["walk_grf.xml", "the load `right`", "the body `hoof_r`", "calcn_r"]);
    let named =
        [&FORCES[..6], &["--right", "hoof_r:ground_force_r_", "--left", "calcn_l:ground_force_l_"], &RAW].concat();
    bench.run(&named).refused(&["the body `hoof_r`", "calcn_r"]);
    bench.run(&[&FORCES[..], &["--add-mass", "hoof_r:1"]].concat()).refused(&["--add-mass", "`hoof_r`", "calcn_r"]);
}

#[test]
fn a_load_whose_columns_do_not_exist_is_rejected_with_the_columns_that_do() {
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
fn without_ground_forces_they_are_predicted_and_a_note_names_the_alternatives() {
    let bench = Workbench::new("no_ground");
    let run = bench.run(&[&FORCES[..4], &["--verbose"]].concat());
    assert!(matches!(run.code, Some(0 | 1)), "{}", run.stderr);
    run.reports(&["note: no ground forces were given; they are predicted", "hint: `--grf`", "--no-ground"]);
    assert_eq!(bench.json("out/summary.json")["ground"]["source"], "predicted");
    bench.run(&[&FORCES[..4], &["--predict", "--no-ground"]].concat()).refused(&["--predict", "--no-ground"]);
    for other in ["--predict", "--no-ground", "--consistent"] {
        bench.run(&[&FORCES[..4], &["--track", other]].concat()).refused(&["--track", other]);
    }
    bench.run(&[&FORCES[..4], &["--no-ground"], &RAW].concat()).done();
    assert_eq!(bench.json("out/summary.json")["ground"]["source"], "none");
    assert!(!bench.folder.join("out/grf.mot").exists(), "ground forces were written without ground contact");
}

#[test]
fn an_empty_file_is_rejected_whichever_it_is() {
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
fn a_file_of_another_kind_is_rejected() {
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
fn a_truncated_file_is_rejected_or_its_missing_rows_are_reported() {
    let bench = Workbench::new("truncated");
    for name in INPUT {
        let bytes = demo_input(name);
        // A cut inside the last number cannot be detected.
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
    let settings = AnalysisSettings {
        smoother: Smoother::Off,
        force_filter: None,
        window: Window::default(),
        rate_hz: None,
        instrumented: None,
    };
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
            analysed += usize::from(analyse(&model, &motion, &plates, settings, &mut findings).is_ok());
        }
    }
    println!("{read} cut tables read with a remark, {analysed} of them went through the analysis");
    assert!(read > 0 && analysed > 0, "no cut fell between two numbers");
}

/// The whole computation of `forces` without files; `None` if it ends with an error.
fn analysed_files(files: [&[u8]; 4]) -> Option<usize> {
    let [figure, walk, grf, loads] = files;
    let mut findings = Findings::default();
    let model = from_osim(&OsimModel::read(figure).ok()?, &mut findings).ok()?;
    let motion = coordinates_from_table(&model, &Table::read_storage(walk).ok()?.0, "walk", &mut findings).ok()?;
    let loads = ExternalLoads::read(loads).ok()?.0;
    let plates = force_recordings(&model, &loads, &Table::read_storage(grf).ok()?.0, &mut findings).ok()?;
    let low_pass = LowPass { order: 3, cutoff_hz: 6.0 };
    let smoother = Smoother::Butterworth(low_pass);
    let settings = AnalysisSettings {
        smoother,
        force_filter: Some(low_pass),
        window: Window::default(),
        rate_hz: None,
        instrumented: None,
    };
    let analysis = analyse(&model, &motion, &plates, settings, &mut findings).ok()?;
    Some(
        output_files(&model, &analysis, None, &Keep::all()).ok()?.len()
            + figure_files(&model, &analysis, &[], None).ok()?.len(),
    )
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
        through += usize::from(analysed_files([figure, walk, grf, loads]).is_some());
    }
    println!("{through} of 1200 damaged inputs went through");
    assert!(through > 100, "only {through} of 1200: the damage never reaches the analysis");
}

#[test]
fn an_entity_bomb_is_rejected_in_a_gigabyte() {
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
        bench.run_in_a_gigabyte(&["info", name]).refused(&[name]);
        bench.write(name, demo_input(name));
    }
}

#[test]
fn elements_nested_without_end_are_rejected() {
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
fn functions_nested_without_end_are_rejected() {
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
fn a_joint_whose_child_is_ground_is_rejected() {
    let bench = Workbench::new("ground_is_child");
    let joint = "<WeldJoint name=\"back\"><socket_parent_frame>/bodyset/torso</socket_parent_frame>\
        <socket_child_frame>/ground</socket_child_frame></WeldJoint>\n</objects></JointSet>";
    bench.edit("figure.osim", "</objects></JointSet>", joint);
    let run = bench.run_in_a_gigabyte(&["info", "figure.osim"]);
    run.refused(&["figure.osim", "`back`", "ground"]);
}

#[test]
fn a_hundred_megabytes_of_garbage_are_rejected_in_a_gigabyte() {
    const SIZE: usize = 100 << 20;
    let bench = Workbench::new("garbage").always_removed();
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

#[test]
fn exchanged_feet_give_a_warning() {
    let bench = Workbench::new("exchanged");
    let swapped = ["--right", "calcn_r:ground_force_l_", "--left", "calcn_l:ground_force_r_"];
    let run = bench.run(&[&FORCES[..4], &["--grf", "walk_grf.mot"], &swapped, &RAW].concat()).infeasible();
    run.warned(&["`calcn_r` acts", "from the other foot", "right and left may be exchanged"]);
    assert!(!bench.forces(&RAW).done().stderr.contains("exchanged"));
}

#[test]
fn forces_on_the_plate_instead_of_on_the_foot_give_a_warning() {
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
    assert!(!run.stdout.contains("verdict   feasible"), "{}", run.stdout);
    run.warned(&["pulls `calcn_r` down", "hint: reverse the sign of forces and torques"]);
    assert!(!run.stdout.contains("quality   good"), "{}", run.stdout);
}

#[test]
fn a_knee_that_bends_the_other_way_gives_a_warning() {
    let bench = Workbench::new("knee");
    let joint = "<Coordinate name=\"knee_angle_r\"><default_value>0</default_value>";
    bench.edit("figure.osim", joint, &format!("{joint}<range>-0.1 2.1</range>"));
    bench.forces(&RAW).infeasible().warned(&["`knee_angle_r` ranges from -6", "the model allows -6 to 120"]);
}
