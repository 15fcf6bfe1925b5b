//! `ambulo run`: a request in JSON computes the bytes of the same words, and a mistake names its field.

use crate::workbench::Workbench;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// All files below a folder but the durations.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        match path.is_dir() {
            true => found.extend(files(&path).into_iter().map(|(inner, bytes)| (format!("{name}/{inner}"), bytes))),
            false if name == "timings.json" => {}
            false => drop(found.insert(name, fs::read(&path).unwrap())),
        }
    }
    found
}

/// Runs the words and the request, both into `out`, and compares exit codes and files.
fn assert_same(bench: &Workbench, words: &[&str], request: &Value) {
    let out = bench.folder.join("out");
    let by_words = bench.run(words);
    let expected = files(&out);
    fs::remove_dir_all(&out).unwrap();
    bench.write("request.json", request.to_string().as_bytes());
    let by_request = bench.run(&["run", "request.json"]);
    assert_eq!(by_words.code, by_request.code, "{}", by_request.stderr);
    let found = files(&out);
    assert_eq!(found.keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
    for (name, bytes) in &found {
        assert!(*bytes == expected[name], "{words:?}: {name} differs");
    }
    assert!(!found.is_empty());
    fs::remove_dir_all(&out).unwrap();
}

#[test]
fn a_recording_is_computed_as_by_words() {
    let bench = Workbench::new("request-forces");
    let words = "forces walk.mot --model figure.osim --grf walk_grf.mot --right calcn_r:ground_force_r_ --left \
                 calcn_l:ground_force_l_ --cutoff 8 --force-cutoff off --order 2 --from 0.5 --to 2 --add-mass \
                 torso:2.5:-0.1,0.3,0 --convention opensim --keep moments,clinical -o out";
    let request = json!({"forces": {
        "job": {
            "recording": "walk.mot",
            "model": "figure.osim",
            "forces": {
                "table": "walk_grf.mot",
                "right": "calcn_r:ground_force_r_",
                "left": "calcn_l:ground_force_l_",
            },
            "added_mass": ["torso:2.5:-0.1,0.3,0"],
            "settings": {"cutoff": 8, "force_cutoff": "off", "order": 2, "window": {"from_s": 0.5, "to_s": 2}},
        },
        "convention": "opensim",
        "keep": ["moments", "clinical"],
        "output": "out",
    }});
    assert_same(&bench, &words.split_whitespace().collect::<Vec<_>>(), &request);
    let predicted = json!({"forces": {"job": {
        "recording": "walk.mot", "model": "figure.osim", "forces": {"table": "walk_grf.mot", "loads": "walk_grf.xml"},
        "settings": {"ground": "predicted", "residual_reduction": null},
    }}});
    let words = "forces walk.mot --model figure.osim --grf walk_grf.mot --loads walk_grf.xml --predict";
    assert_same(&bench, &words.split_whitespace().collect::<Vec<_>>(), &predicted);
}

#[test]
fn walks_are_computed_as_by_words() {
    let bench = Workbench::empty("request-walk");
    let words = "walk --gait standard --speed 1.2 --speed-change 2:1.3:0.5 --style knots --figure de-leva-female \
                 --mass 60 --no-toe-joint --mode paper --cycles 1 --rate 50 --keep kinematics,grf -o out";
    let request = json!({"walk": {
        "gait": {"gait": "standard", "speed": 1.2, "speed_change": ["2:1.3:0.5"], "style": "knots"},
        "figure": {"figure": "de-leva-female", "mass": 60, "no_toe_joint": true},
        "mode": "paper",
        "cycles": 1,
        "rate": 50,
        "keep": ["kinematics", "grf"],
        "output": "out",
    }});
    assert_same(&bench, &words.split_whitespace().collect::<Vec<_>>(), &request);
    let words = "walk --slope 5 --load 12:hands --weak ankle=0.8 --cycles 1 --keep grf -o out";
    let request = json!({"walk": {
        "conditions": {"slope": 5, "load": "12:hands", "weak": ["ankle=0.8"]}, "cycles": 1, "keep": ["grf"],
    }});
    assert_same(&bench, &words.split_whitespace().collect::<Vec<_>>(), &request);
    let request = json!({"sweep": {"speed": [1.2], "mass": 80, "height": "1.8", "keep": ["walks"]}});
    assert_same(&bench, &["sweep", "--speed", "1.2", "--mass", "80", "--height", "1.8", "--keep", "walks"], &request);
    assert_same(&bench, &["demo", "--keep", "grf"], &json!({"demo": {"keep": ["grf"]}}));
}

#[test]
fn scenes_and_events_are_computed_as_by_words() {
    let bench = Workbench::empty("request-scene");
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/pendulum.toml");
    bench.write("scene.toml", fs::read(scene).unwrap());
    let words = ["simulate", "scene.toml", "--duration", "0.2", "--step", "0.002", "--keep", "energy,poses"];
    let request = json!({"simulate": {
        "scene": "scene.toml", "duration": 0.2, "step": 0.002, "keep": ["energy", "poses"],
    }});
    assert_same(&bench, &words, &request);
    bench.run(&["demo", "-o", "demo", "--quiet"]).done();
    fs::create_dir(bench.folder.join("out")).unwrap();
    let request = json!({"events": {"input": "demo/input/walk.c3d", "output": "out/events.csv"}});
    bench.write("events.json", request.to_string().as_bytes());
    let words = ["events", "demo/input/walk.c3d", "-o", "out/events.csv", "--json"];
    let expected = bench.run(&words).done().stdout;
    assert_eq!(bench.run(&["run", "events.json", "--json", "--force"]).done().stdout, expected);
}

#[test]
fn trials_are_computed_as_by_words() {
    let bench = Workbench::empty("request-trials");
    bench.run(&["demo", "-o", "demo", "--quiet"]).done();
    fs::create_dir(bench.folder.join("plates")).unwrap();
    for name in ["walk.c3d", "standing.c3d"] {
        fs::copy(bench.folder.join("demo/input").join(name), bench.folder.join("plates").join(name)).unwrap();
    }
    let size = json!({"mass_kg": 75, "height_m": 1.75});
    let words = "validate plates --mass 75 --height 1.75 --jobs 1 -o out";
    let request = json!({"validate": {"folder": "plates", "mass": 75, "height": 1.75, "jobs": 1, "output": "out"}});
    assert_same(&bench, &words.split(' ').collect::<Vec<_>>(), &request);
    let words = "session plates -o out -- --mass 75 --height 1.75";
    let request = json!({"session": {"own": {"source": ["plates"], "output": "out"}, "job": {"size": size}}});
    assert_same(&bench, &words.split(' ').collect::<Vec<_>>(), &request);
    let words = "batch plates -o out --part 7 --keep grf,events -- --mass 75 --height 1.75";
    let request = json!({"batch": {
        "own": {"source": "plates", "output": "out", "part": 7, "keep": ["grf", "events"]}, "job": {"size": size},
    }});
    assert_same(&bench, &words.split(' ').collect::<Vec<_>>(), &request);
    let words = "calibrate plates/walk.c3d --static plates/standing.c3d --mass 75 --height 1.75 -o out/person.toml";
    let request = json!({"calibrate": {
        "trials": ["plates/walk.c3d"], "job": {"standing": "plates/standing.c3d", "size": size},
        "output": "out/person.toml",
    }});
    assert_same(&bench, &words.split(' ').collect::<Vec<_>>(), &request);
}

#[test]
fn a_mistake_in_a_request_names_its_field() {
    let bench = Workbench::new("request-mistakes");
    let cases = [
        (json!({"wakl": {}}), &["unknown variant `wakl`", "`walk`"][..]),
        (json!({"walk": {"sped": 1}}), &["`walk.sped`", "unknown field `sped`", "`gait`"]),
        (json!({"walk": {"gait": {"speed": "fast"}}}), &["`walk.gait.speed`", "invalid type: string \"fast\""]),
        (json!({"walk": {"cycles": 1.5}}), &["`walk.cycles`", "1.5"]),
        (json!({"walk": {"mode": "fly"}}), &["`walk.mode`", "`fly`", "`predict`"]),
        (json!({"walk": {"keep": ["grf", "gfr"]}}), &["`walk.keep`", "found `gfr`", "moments"]),
        (json!({"walk": {"gait": {"style": "2024"}}}), &["style: found `2024`", "expected one of knots", "`--style`"]),
        (json!({"walk": {"conditions": {"load": "12:head"}}}), &["`walk.conditions.load`", "back, hands or pelvis"]),
        (json!({"walk": {"conditions": {"weak": ["ankle"]}}}), &["`walk.conditions.weak`", "JOINT=SHARE"]),
        (json!({"sweep": {"speed": [1, "x"]}}), &["`sweep.speed`", "a list of numbers"]),
        (json!({"simulate": {"scene": "a.toml", "step": 0}}), &["`simulate.step`", "found `0`", "above 0"]),
        (json!({"simulate": {}}), &["`simulate`", "missing field `scene`"]),
        (json!({"batch": {"own": {"source": ".", "part": 0}}}), &["`batch.own.part`", "from 1 to 100000"]),
        (json!({"batch": {"own": {"source": ".", "shard": "4/4"}}}), &["`batch.own.shard`", "found `4/4`"]),
        (json!({"session": {"own": {"source": []}}}), &["`session.own.source`", "expected a file or a folder"]),
        (json!({"validate": {"folder": ".", "jobs": 5000}}), &["`validate.jobs`", "from 1 to 1024"]),
        (json!({"forces": {"job": {"segments": "robot"}}}), &["`forces.job.segments`", "found `robot`"]),
        (
            json!({"forces": {"job": {"settings": {"cutoff": -1}}}}),
            &["`forces.job.settings.cutoff`", "found `-1`", "above 0"],
        ),
        (json!({"forces": {"job": {"size": {"mass": 70}}}}), &["`forces.job.size.mass`", "`mass_kg`"]),
        (json!({"forces": {"job": {"recording": "walk.mot", "settings": {"order": 9}}}}), &["the order 9", "1 to 8"]),
        (
            json!({"forces": {"job": {"recording": "walk.mot", "model": "figure.osim", "size": {"mass_kg": 900}}}}),
            &["the body mass is 900 kg", "2 to 300 kg", "`--mass KG`"],
        ),
        (json!([1]), &["request.json", "line 1 column 1"]),
    ];
    for (request, expected) in cases {
        bench.write("request.json", request.to_string().as_bytes());
        bench.run(&["run", "request.json"]).refused(expected);
    }
    bench.write("request.json", b"{\"walk\": {\"cycles\": }}");
    bench.run(&["run", "request.json"]).refused(&["request.json", "line 1 column 21"]);
    bench.write("request.json", b"{\"walk\": {}} {}");
    bench.run(&["run", "request.json"]).refused(&["request.json", "expected one request"]);
    bench.run(&["run", "none.json"]).refused(&["none.json: there is no such file"]);
}

#[test]
fn a_request_takes_options_as_they_are_typed() {
    let bench = Workbench::new("request-options");
    let job = json!({"recording": "walk.mot", "model": "figure.osim", "size": {"mass_kg": 75}});
    bench.write("request.json", json!({"forces": {"job": job}}).to_string().as_bytes());
    let line = bench.run(&["run", "request.json", "--options", "--predict --from 0.5", "--words"]).done().stdout;
    assert_eq!(line.trim(), "ambulo forces walk.mot --model figure.osim --mass 75 --predict --from 0.5 -o out");
    bench.run(&["run", "request.json", "--options", "--predict --from 0.5", "--quiet"]);
    let by_request = files(&bench.folder.join("out"));
    bench.run(&line.trim().split(' ').skip(1).chain(["--quiet"]).collect::<Vec<_>>());
    assert!(by_request == files(&bench.folder.join("out")));
    bench.run(&["run", "request.json", "--options", "--nonsense"]).refused(&["'--nonsense'"]);
    for (quoted, file) in [("--person 'no such'", "no such"), ("--device=\"neither file\"", "neither file")] {
        let said = format!("{file}: there is no such file");
        bench.run(&["run", "request.json", "--options", quoted]).refused(&[&said]);
    }
    let walk = json!({"walk": {
        "gait": {"gait": "slow", "speed_change": ["3:1.6"]}, "figure": {"mass": 60.5},
        "conditions": {"load": "12kg:hands", "weak": ["ankle=0.6"], "asymmetric": true, "free_cadence": true},
        "mode": "predict", "convention": "opensim", "cycles": 2, "keep": ["grf", "moments"], "output": "my walk",
    }});
    bench.write("request.json", walk.to_string().as_bytes());
    let line = bench.run(&["run", "request.json", "--words"]).done().stdout;
    let expected = "ambulo walk --gait slow --speed-change 3:1.6 --mass 60.5 --load 12:hands --weak ankle=0.6 \
                    --asymmetric --free-cadence --mode predict --convention opensim --cycles 2 --keep grf,moments -o \
                    'my walk'";
    if cfg!(unix) {
        assert_eq!(line.trim(), expected);
    }
    bench.write("request.json", br#"{"sweep": {}}"#);
    bench.run(&["run", "request.json", "--words"]).refused(&["expected forces, session, walk, simulate or demo"]);
}

#[test]
fn options_of_a_session_are_those_of_its_trials() {
    let bench = Workbench::new("request-session");
    let request = json!({"session": {
        "own": {"source": ["visit"], "name": "Ann", "date": "2026-11-02", "jobs": 1, "output": "out"},
        "job": {"size": {"mass_kg": 60.5}},
    }});
    bench.write("request.json", request.to_string().as_bytes());
    let line = bench.run(&["run", "request.json", "--options", "--cutoff 8", "--words"]).done().stdout;
    let expected = "ambulo session visit --name Ann --date 2026-11-02 --jobs 1 -o out -- --mass 60.5 --cutoff 8";
    assert_eq!(line.trim(), expected);
    bench.run(&["run", "request.json", "--options", "--nonsense"]).refused(&["'--nonsense'"]);
}
