//! Unusable markers, plates and skeletons: the message states where, what was found, what was expected and what to do.

use crate::workbench::{Run, Workbench};
use ambulo_formats::c3d::{C3d, Parameter, Values};
use ambulo_formats::trc::Trc;
use std::sync::OnceLock;

const STILL: [&str; 2] = ["--static", "standing.c3d"];
const FILES: [&str; 8] =
    ["walk.c3d", "standing.c3d", "walk.trc", "walk.bvh", "walk.mot", "walk_grf.mot", "walk_grf.xml", "figure.osim"];

/// A folder with the laboratory's files that `demo` writes.
fn laboratory(name: &str) -> Workbench {
    static DEMO: OnceLock<Workbench> = OnceLock::new();
    let made = DEMO.get_or_init(|| {
        let bench = Workbench::empty("marker_input_demo");
        bench.run(&["demo", "-o", "demo", "--quiet"]).done();
        bench
    });
    let bench = Workbench::empty(name);
    for file in FILES {
        bench.write(file, made.read(&format!("demo/input/{file}")));
    }
    bench
}

fn forces(bench: &Workbench, input: &str, more: &[&str]) -> Run {
    bench.run(&[&["forces", input], more].concat())
}

/// Changes a C3D and writes it under a new name.
fn edit_c3d(bench: &Workbench, name: &str, new: &str, edit: impl Fn(&mut C3d)) {
    let (mut c3d, _) = C3d::read(&bench.read(name)).unwrap();
    edit(&mut c3d);
    bench.write(new, c3d.write().unwrap());
}

/// Removes mass and stature from a recording.
fn without_mass(c3d: &mut C3d) {
    c3d.parameters.groups.retain(|group| group.name != "PROCESSING");
}

#[test]
fn a_c3d_that_is_cut_says_where() {
    let bench = laboratory("cut_c3d");
    let whole = bench.read("walk.c3d");
    let cut = |at: usize| {
        bench.write("cut.c3d", &whole[..at]);
        forces(&bench, "cut.c3d", &STILL)
    };
    cut(0).refused(&["cut.c3d", "the file is empty", "expected a C3D file"]);
    cut(1).refused(&["cut.c3d", "expected the key 80"]);
    cut(100).refused(&["cut.c3d", "ends after 100 bytes", "header of 512 bytes", "truncated"]);
    cut(512).refused(&["cut.c3d", "ends after 512 bytes", "parameter section", "truncated"]);
    cut(2000).refused(&["cut.c3d", "ends after 2000 bytes", "of the parameter section", "truncated"]);
    // The parameters end before byte 6000, and no frame is whole there.
    let data = C3d::read(&whole).unwrap().0.frames();
    cut(5000).refused(&["cut.c3d", "holds no frames", &format!("{data} frames are stated"), "hint: export it again"]);
    // Half of the walk is a walk.
    let half = cut(whole.len() / 2);
    half.warned(&["437 frames are stated, but the file ends after 217; it is truncated"]);
    for verb in [&["info"][..], &["events"]] {
        bench.write("cut.c3d", &whole[..2000]);
        bench.run(&[verb, &["cut.c3d"]].concat()).refused(&["cut.c3d", "truncated"]);
    }
    bench.write("cut.c3d", "not a recording");
    forces(&bench, "cut.c3d", &STILL).refused(&["cut.c3d", "expected the key 80"]);
}

#[test]
fn markers_that_were_never_seen_and_recordings_without_frames_are_rejected() {
    let bench = laboratory("never_seen");
    edit_c3d(&bench, "walk.c3d", "blind.c3d", |c3d| {
        c3d.points.iter_mut().for_each(|point| point.positions.fill([f64::NAN; 3]));
    });
    forces(&bench, "blind.c3d", &STILL)
        .refused(&["blind.c3d", "no marker was seen in any of the 437 frames of the recording (listed: RASI"]);
    edit_c3d(&bench, "standing.c3d", "blind.c3d", |c3d| {
        c3d.points.iter_mut().for_each(|point| point.positions.fill([f64::NAN; 3]));
    });
    forces(&bench, "walk.c3d", &["--static", "blind.c3d"]).refused(&["blind.c3d", "no marker was seen"]);
    // Only the pelvis was seen, and only in the walk.
    edit_c3d(&bench, "walk.c3d", "legless.c3d", |c3d| {
        c3d.points.retain(|point| ["RASI", "LASI", "RPSI", "LPSI", "SACR"].contains(&point.name.as_str()));
    });
    forces(&bench, "legless.c3d", &[]).refused(&[
        "legless.c3d",
        "the legs cannot be found",
        "asis r",
        "docs/MARKERS.md",
    ]);
}

#[test]
fn unknown_marker_names_are_listed_with_the_required_ones() {
    let bench = laboratory("unknown_names");
    edit_c3d(&bench, "walk.c3d", "mystery.c3d", |c3d| {
        c3d.points.iter_mut().enumerate().for_each(|(i, point)| point.name = format!("Mystery{i}"));
    });
    let words =
        ["no marker set fits", "of the 46 markers `Mystery0`", "plug-in-gait", "`RASI`", "at least 4", "hint: "];
    forces(&bench, "mystery.c3d", &[]).refused(&[&["mystery.c3d"], &words[..]].concat());
    // The message names the file with the error.
    edit_c3d(&bench, "standing.c3d", "mystery.c3d", |c3d| {
        c3d.points.iter_mut().enumerate().for_each(|(i, point)| point.name = format!("Mystery{i}"));
    });
    forces(&bench, "walk.c3d", &["--static", "mystery.c3d"]).refused(&[&["error: mystery.c3d"], &words[..]].concat());
    let markers = |markers: &str| forces(&bench, "walk.c3d", &[&STILL[..], &["--markers", markers]].concat());
    markers("helen").refused(&["marker set: no marker set is named `helen`", "plug-in-gait", "a TOML file"]);
    markers("none.toml").refused(&["none.toml: there is no such file", "hint: "]);
    bench.write("broken.toml", "name = \"mine\"\n[[marker]\n");
    markers("broken.toml").refused(&["broken.toml: line 2: this is not TOML", "docs/MARKERS.md"]);
    bench.write("odd.toml", "name = \"mine\"\ncolour = 3\n");
    markers("odd.toml").refused(&["odd.toml", "colour"]);
    // A set adds to the others, so that one with few of the names spoils nothing.
    let run = markers("rajagopal").done();
    assert!(run.stdout.contains("(rajagopal, plug-in-gait"), "{}", run.stdout);
}

#[test]
fn a_body_needs_a_plausible_mass_and_stature() {
    let bench = laboratory("mass");
    edit_c3d(&bench, "walk.c3d", "light.c3d", without_mass);
    // Force plates weigh a walking person; without them the mass must be stated.
    let plates_off: Vec<String> = (1..=9).flat_map(|plate| ["--plate".to_owned(), format!("{plate}=off")]).collect();
    let plates_off: Vec<&str> = plates_off.iter().map(String::as_str).collect();
    let unknown = ["light.c3d: the body mass is not known", "hint: `--mass KG`"];
    forces(&bench, "light.c3d", &plates_off).refused(&unknown);
    forces(&bench, "light.c3d", &[]).done();
    let weighed = bench.json("out/summary.json")["mass_kg"].as_f64().unwrap();
    assert!((weighed - 75.0).abs() < 1.0, "{weighed}");
    bench.run(&["convert", "light.c3d", "light.trc"]).done();
    forces(&bench, "light.trc", &[]).refused(&["light.trc: the body mass is not known", "hint: `--mass KG`"]);
    forces(&bench, "light.trc", &["--grf", "walk_grf.mot"]).done();
    let weighed = bench.json("out/summary.json")["mass"].clone();
    assert!(weighed["state"] == "weighed" && (weighed["kg"].as_f64().unwrap() - 75.0).abs() < 1.0, "{weighed}");
    forces(&bench, "walk.bvh", &[]).refused(&["walk.bvh: a BVH contains no body mass", "hint: `--mass KG`"]);
    for (input, mass) in [("walk.c3d", "-75"), ("walk.c3d", "nan"), ("walk.c3d", "75000"), ("walk.bvh", "-75")] {
        forces(&bench, input, &["--mass", mass]).refused(&[input, "the body mass is", "expected 2 to 300 kg"]);
    }
    let figure = ["--model", "figure.osim", "--grf", "walk_grf.mot"];
    for mass in ["-2", "0", "nan", "1e9"] {
        let run = forces(&bench, "walk.trc", &[&figure[..], &["--mass", mass]].concat());
        run.refused(&["the body mass is", "expected 2 to 300 kg", "`--mass KG`"]);
    }
    forces(&bench, "walk.c3d", &["--mass", "20"]).refused(&["20 kg at 1.75 m", "at this height"]);
    forces(&bench, "walk.c3d", &["--mass", "heavy"]).refused(&["'heavy' for '--mass <KG>'"]);
    for (input, mass) in [("walk.c3d", None), ("walk.bvh", Some("75"))] {
        for height in ["175", "-1.75", "0", "nan"] {
            let given = mass.map_or(Vec::new(), |mass| vec!["--mass", mass]);
            let run = forces(&bench, input, &[&given[..], &["--height", height]].concat());
            run.refused(&[input, "the height is", "expected 0.4 to 2.5 m", "hint: metres, not centimetres"]);
        }
    }
    forces(&bench, "walk.c3d", &["--figure", "nobody"]).refused(&["'nobody' for '--figure <NAME>'", "de-leva-female"]);
    forces(&bench, "walk.c3d", &["--figure", "faure-1997"]).refused(&["has no pelvis; expected de-leva-male"]);
}

#[test]
fn plates_keep_the_numbers_of_the_file() {
    let bench = laboratory("plates");
    let plate = |plates: &[&str]| {
        let options: Vec<&str> = plates.iter().flat_map(|plate| ["--plate", plate]).collect();
        forces(&bench, "walk.c3d", &[&STILL[..], &options, &["--verbose"]].concat())
    };
    plate(&["99=r"]).refused(&["plate 99", "walk.c3d has 9 force plates", "from 1 to 9", "hint: `ambulo info`"]);
    for words in ["words", "0=r", "1=x", "1.5=r", "=", "1=", "18446744073709551616=r"] {
        plate(&[words]).refused(&[words, "expected PLATE=FOOT, such as 1=r", "plates counted from 1"]);
    }
    plate(&["1=l", "1=r"]).refused(&["plate 1 is assigned twice", "`--plate"]);
    let all: Vec<String> = (1..=9).map(|i| format!("{i}=off")).collect();
    let all: Vec<&str> = all.iter().map(String::as_str).collect();
    let predicted = |run: Run, words: &[&str]| {
        assert!(matches!(run.code, Some(0 | 1)), "{}", run.stderr);
        run.reports(words);
        run.reports(&["the ground forces are predicted from the motion"]);
        assert_eq!(bench.json("out/summary.json")["ground"]["source"], "predicted");
    };
    let hint = "`--no-ground` computes";
    predicted(plate(&all), &["no load was measured on the file's 9 force plates", hint]);
    let trc = ["--model", "figure.osim", "--plate", "1=r"];
    forces(&bench, "walk.trc", &trc).refused(&["walk.trc has no force plates", "expected a C3D with force plates"]);
    predicted(
        forces(&bench, "walk.trc", &[&trc[..2], &["--verbose"]].concat()),
        &["the file has no force plates", "hint: `--grf`"],
    );
    // A person who stands with both feet on one plate.
    let words = ["plate 1, 0.000-0.499 s: the right foot was on it", "a standing trial with `--static`"];
    predicted(forces(&bench, "standing.c3d", &["--verbose"]), &words);
    // A trial without a foot on a plate.
    edit_c3d(&bench, "walk.c3d", "missed.c3d", |c3d| {
        c3d.channels.iter_mut().for_each(|channel| channel.samples.fill(0.0));
    });
    predicted(forces(&bench, "missed.c3d", &[&STILL[..], &["--verbose"]].concat()), &["no load was measured", hint]);
}

#[test]
fn a_standing_trial_must_show_the_same_person_standing_still() {
    let bench = laboratory("static");
    forces(&bench, "walk.c3d", &["--static", "none.c3d"]).refused(&["none.c3d: there is no such file"]);
    forces(&bench, "walk.c3d", &["--static", "walk.mot"])
        .refused(&["walk.mot: found a file `.mot`", "expected markers (.c3d, .trc or .csv)"]);
    forces(&bench, "walk.c3d", &["--static", "walk.c3d"]).warned(&[
        "in the standing trial the markers move",
        "0 of 437 frames",
        "hint: use a trial in which the person",
    ]);
    // Case and blanks in the name of the person do not count.
    let named = |name: &str| Parameter::list("NAMES", Values::Texts(vec![name.to_owned()]));
    edit_c3d(&bench, "walk.c3d", "anna.c3d", |c3d| c3d.parameters.set("SUBJECTS", named("Anna")));
    edit_c3d(&bench, "standing.c3d", "of-anna.c3d", |c3d| c3d.parameters.set("SUBJECTS", named("ANNA ")));
    edit_c3d(&bench, "standing.c3d", "of-ben.c3d", |c3d| c3d.parameters.set("SUBJECTS", named("Ben")));
    forces(&bench, "anna.c3d", &["--static", "of-ben.c3d"]).warned(&["names another person (SUBJECTS:NAMES)"]);
    let same = forces(&bench, "anna.c3d", &["--static", "of-anna.c3d"]).done();
    assert!(!same.stderr.contains("another person"), "{}", same.stderr);
    // The standing trial has other names than the walk, so the calibrated body has none of the markers.
    edit_c3d(&bench, "walk.c3d", "prefixed.c3d", |c3d| {
        c3d.points.iter_mut().enumerate().for_each(|(i, point)| point.name = format!("Mystery{i}"));
    });
    let words =
        ["prefixed.c3d", "have no marker in common", "the model has RASI", "the recording has Mystery0", "hint: "];
    forces(&bench, "prefixed.c3d", &STILL).refused(&words);
    // A standing trial that scales a model needs the markers of the model.
    let figure = ["--model", "figure.osim", "--grf", "walk_grf.mot"];
    let run = forces(&bench, "walk.trc", &[&figure[..], &STILL].concat());
    run.refused(&["standing.c3d", "no marker in common", "sacrum", "RASI"]);
}

#[test]
fn a_model_needs_the_markers_of_the_recording_and_rejects_options_of_the_built_in_body() {
    let bench = laboratory("model");
    let figure = ["--model", "figure.osim"];
    forces(&bench, "walk.c3d", &figure).refused(&[
        "walk.c3d: the model",
        "have no marker in common",
        "the model has sacrum",
        "the recording has RASI",
        "hint: ",
    ]);
    for (option, value) in [("--markers", "plug-in-gait"), ("--figure", "de-leva-female")] {
        let run = forces(&bench, "walk.trc", &[&figure[..], &["--grf", "walk_grf.mot", option, value]].concat());
        run.refused(&["has no effect with a model", &format!("`{option} N"), "`--static FILE`"]);
    }
    for given in [&STILL[..], &["--fit", "trajectory"], &["--plate", "1=r"]] {
        let run = forces(&bench, "walk.mot", &[&figure[..], &["--grf", "walk_grf.mot"], given].concat());
        run.refused(&["walk.mot", "can only be used with markers (.c3d, .trc)", &format!("hint: `{} ", given[0])]);
    }
    let run = forces(&bench, "walk.trc", &["--model", "walk.trc", "--grf", "walk_grf.mot"]);
    run.refused(&["walk.trc"]);
}

#[test]
fn a_model_is_scaled_to_a_stated_mass_and_stature() {
    let bench = laboratory("stated_size");
    let figure = ["--model", "figure.osim", "--grf", "walk_grf.mot", "-v"];
    let masses = |given: &[&str]| {
        let run = forces(&bench, "walk.mot", &[&figure[..], given].concat()).done();
        let text = bench.text("out/subject.osim");
        let numbers = |tag: &str| -> Vec<f64> {
            let opening = format!("<{tag}>");
            let parts = text.split(&opening).skip(1);
            parts
                .flat_map(|part| {
                    part.split('<').next().unwrap().split_whitespace().map(|x| x.parse().unwrap()).collect::<Vec<f64>>()
                })
                .collect()
        };
        (run.stdout + &run.stderr, numbers("mass"), numbers("inertia"))
    };
    let (_, own, own_inertias) = masses(&[]);
    let (said, scaled, inertias) = masses(&["--mass", "60", "--height", "1.575"]);
    assert!(said.contains("the model was scaled to the stated size: masses by 0.800"), "{said}");
    assert!((scaled.iter().sum::<f64>() - 60.0).abs() < 1e-6, "{}", scaled.iter().sum::<f64>());
    for (own, scaled) in own.iter().zip(&scaled) {
        assert!((scaled - 0.8 * own).abs() < 1e-6, "{own} {scaled}");
    }
    let factor = inertias.iter().sum::<f64>() / own_inertias.iter().sum::<f64>();
    let length = said.split("lengths by ").nth(1).unwrap().split(',').next().unwrap().parse::<f64>().unwrap();
    assert!((factor / (0.8 * length * length) - 1.0).abs() < 2e-3, "{factor} {length}");
    let mass = bench.json("out/summary.json")["mass"].clone();
    assert_eq!((mass["state"].as_str(), mass["source"].as_str()), (Some("contradicted"), Some("stated")), "{mass}");
    assert!((mass["plates_kg"].as_f64().unwrap() - 75.0).abs() < 1.0, "{mass}");
    forces(&bench, "walk.mot", &[&figure[..], &["--height", "175"]].concat())
        .refused(&["--height", "expected 0.4 to 2.5 m"]);
}

#[test]
fn a_trc_that_is_cut_says_where() {
    let bench = laboratory("cut_trc");
    let text = bench.text("walk.trc");
    let cut = |at: usize| {
        bench.write("cut.trc", &text[..at]);
        forces(&bench, "cut.trc", &["--model", "figure.osim", "--grf", "walk_grf.mot"])
    };
    cut(0).refused(&["cut.trc", "empty"]);
    cut(150).refused(&["cut.trc: line 3", "expected 8"]);
    let rows = text.match_indices('\n').nth(4).unwrap().0;
    cut(rows).refused(&["cut.trc", "expected rows of frame, time and positions", "truncated"]);
    let middle = text[..text.len() / 2].rfind('\t').unwrap();
    cut(middle).refused(&["cut.trc: line", "the file ends here", "truncated"]);
    let (mut trc, _) = Trc::read(text.as_bytes()).unwrap();
    trc.name = "cut".to_owned();
    assert_eq!(trc.times().len(), 437);
}

#[test]
fn a_truncated_skeleton_and_options_without_effect_are_rejected() {
    let bench = laboratory("cut_bvh");
    let text = bench.text("walk.bvh");
    let motion = text.find("MOTION").unwrap();
    let cut = |at: usize| {
        bench.write("cut.bvh", &text[..at]);
        forces(&bench, "cut.bvh", &["--mass", "75"])
    };
    cut(0).refused(&["cut.bvh", "empty"]);
    cut(motion / 2).refused(&["cut.bvh: line"]);
    cut(motion).refused(&["cut.bvh: line", "the file ends here", "`MOTION`", "truncated"]);
    cut(text.len() / 2).refused(&["cut.bvh: line", "the rest of a frame of 45 values", "truncated"]);
    bench.run(&["events", "cut.bvh"]).refused(&["cut.bvh: line", "truncated"]);
    for given in [&STILL[..], &["--model", "figure.osim"], &["--grf", "walk_grf.mot"], &["--markers", "cast"]] {
        let run = forces(&bench, "walk.bvh", &[&["--mass", "75"][..], given].concat());
        run.refused(&[
            "walk.bvh",
            "has no effect for a .bvh",
            &format!("hint: `{} ", given[0]),
            "body mass and height",
        ]);
    }
}

#[test]
fn other_files_are_rejected_by_their_extension() {
    let bench = laboratory("names");
    let kinds = "expected .c3d, .trc or .csv (markers)";
    forces(&bench, "-", &[]).refused(&["-: standard input is not read"]);
    forces(&bench, ".", &[]).refused(&["this is a folder", "`ambulo batch .`"]);
    forces(&bench, "walk", &[]).refused(&["walk: its name has no extension", kinds]);
    forces(&bench, "walk.xyz", &[]).refused(&["unknown kind of recording `.xyz`", kinds]);
    forces(&bench, "none.c3d", &[]).refused(&["none.c3d: there is no such file", "hint: "]);
    forces(&bench, "walk.c3d", &["--max-gap", "-1"]).refused(&["'-1' for '--max-gap <S>'", "zero or more"]);
    forces(&bench, "walk.c3d", &["--from", "50"]).refused(&["walk.c3d: the start of the range, 50 s", "hint: "]);
    bench.run(&["convert", "walk.c3d", "walk"]).refused(&["has no extension", ".trc, .csv"]);
}

#[test]
fn results_never_overwrite_input_markers_or_an_input_model() {
    let bench = laboratory("overwrite");
    // A run writes `subject.osim`, and a later run may read it.
    forces(&bench, "walk.c3d", &[&STILL[..], &["-o", "out", "--quiet"]].concat()).done();
    let before = bench.read("out/subject.osim");
    let run = forces(&bench, "walk.c3d", &["--model", "out/subject.osim", "-o", "out"]);
    run.refused(&["out/subject.osim: this input file would be overwritten", "hint: choose another folder"]);
    assert_eq!(bench.read("out/subject.osim"), before);
    forces(&bench, "walk.c3d", &["--model", "out/subject.osim", "-o", "again", "--quiet"]).done();
    // An input in the result folder is kept.
    bench.write("out/walk.c3d", bench.read("walk.c3d"));
    forces(&bench, "out/walk.c3d", &[&STILL[..], &["-o", "out", "--quiet"]].concat()).done();
    assert_eq!(bench.read("out/walk.c3d"), bench.read("walk.c3d"));
    forces(&bench, "walk.c3d", &[&STILL[..], &["-o", "walk.trc"]].concat()).refused(&["walk.trc", "expected a folder"]);
}

#[test]
fn a_carried_mass_is_added_to_the_built_in_body_too() {
    let bench = laboratory("carried");
    let load = ["--add-mass", "torso:5"];
    let total = |input: &str, given: &[&str]| -> f64 {
        forces(&bench, input, &[given, &load, &["-o", "out", "--quiet"]].concat());
        let model = bench.run(&["info", "out/subject.osim", "--json"]).done().stdout;
        serde_json::from_str::<serde_json::Value>(&model).unwrap()["mass_kg"].as_f64().unwrap()
    };
    for (input, given) in [("walk.c3d", &STILL[..]), ("walk.bvh", &["--mass", "75"])] {
        let found = total(input, given);
        // A C3D holds its forces in single precision, and the standing trial weighs the person.
        assert!((found - 80.0).abs() < 1e-4, "{input}: {found}");
    }
    let run = forces(&bench, "walk.c3d", &[&STILL[..], &["--add-mass", "rucksack:5"]].concat());
    run.refused(&["added mass: the model has no body `rucksack`; expected one of", "torso"]);
}

#[test]
fn a_template_of_the_markers_gives_own_names_a_meaning() {
    let bench = laboratory("marker_template");
    let own = ["RHEE", "LTOE", "C7"];
    let edit = |c3d: &mut C3d| {
        for (i, name) in own.iter().enumerate() {
            c3d.points.iter_mut().find(|point| point.name == *name).unwrap().name = format!("own {i}");
        }
    };
    edit_c3d(&bench, "walk.c3d", "own.c3d", edit);
    edit_c3d(&bench, "standing.c3d", "own-standing.c3d", edit);
    let run = bench.run(&["info", "own.c3d", "--markers", "mine.toml"]).done();
    assert!(run.stdout.contains("3 proposed by position"), "{}", run.stdout);
    assert!(bench.text("mine.toml").contains("# proposed by its position; check it"));
    bench.run(&["info", "own.c3d", "--markers", "mine.toml"]).refused(&["mine.toml", "already exists"]);
    bench.run(&["info", "walk.bvh", "--markers", "other.toml"]).refused(&["walk.bvh", "--markers is for markers"]);
    let run =
        forces(&bench, "own.c3d", &["--static", "own-standing.c3d", "--markers", "mine.toml", "-o", "own"]).done();
    assert!(run.stdout.contains("(template)"), "{}", run.stdout);
}

#[test]
fn markers_in_a_table_and_without_a_unit_give_the_results_of_the_recording() {
    let bench = laboratory("marker_table");
    bench.run(&["convert", "walk.c3d", "walk.csv"]).done();
    let run = bench.run(&["info", "walk.csv"]).done();
    assert!(run.stdout.contains("plug-in-gait"), "{}", run.stdout);
    let size = ["--mass", "75", "--height", "1.75", "--static", "standing.c3d"];
    forces(&bench, "walk.csv", &size)
        .warned(&["states no unit of length; by the size of the markers lengths are in m"]);
    edit_c3d(&bench, "walk.c3d", "unitless.c3d", |c3d| c3d.point_unit = String::new());
    forces(&bench, "unitless.c3d", &STILL).warned(&["POINT:UNITS is ``", "lengths are in mm"]);
}
