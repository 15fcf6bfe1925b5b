//! `ambulo tune`: its file, resumption bit for bit, and what it refuses.

use crate::workbench::Workbench;
use serde_json::Value;

/// A walker in the plane with long time steps, so that gains and trials are quick.
const SCENE: &str = r#"step = 0.005
duration = 8.0
[[figure]]
name = "ann"
build = { table = "de-leva-female", mass = 60, height = 1.65 }
walk = { gait = "free", speed = 1.2 }
control = { stiffness = 150, costs = { height = 0.06 } }
"#;
/// Few and large pushes: all end in a fall, which takes a second.
const QUICK: [&str; 8] = ["tune", "scene.toml", "--gains", "stiffness,angle_deg", "--push", "2000", "--pushes", "1"];

fn bench(name: &str) -> Workbench {
    let bench = Workbench::empty(name);
    bench.write("scene.toml", SCENE);
    bench
}

fn words<'w>(more: &[&'w str]) -> Vec<&'w str> {
    QUICK.into_iter().chain(more.iter().copied()).collect()
}

/// Generations of two gains have six candidates and their mean.
#[test]
fn a_run_in_two_parts_writes_the_same_bytes_as_one_run_with_one_thread() {
    let bench = bench("tune_resume");
    let whole = bench.run(&words(&["--evaluations", "14", "--jobs", "1", "-o", "whole.toml"])).done();
    assert!(whole.stderr.contains("7 of 14 evaluations") && whole.stderr.contains("14 of 14"), "{}", whole.stderr);
    assert!(whole.stdout.contains("held-out, 2000 N"), "{}", whole.stdout);
    bench.run(&words(&["--evaluations", "13", "--quiet", "-o", "parts.toml"])).done();
    assert!(bench.text("parts.toml").contains(": 7 evaluations"));
    bench.run(&words(&["--evaluations", "14", "--jobs", "3", "--resume", "--quiet", "-o", "parts.toml"])).done();
    assert_eq!(bench.text("whole.toml"), bench.text("parts.toml"));
    assert_eq!(bench.text("whole.state.json"), bench.text("parts.state.json"));

    // The line for the scene.
    let text = bench.text("whole.toml");
    let line = text.lines().find(|line| line.starts_with("control = ")).unwrap();
    assert!(line.contains("stiffness = ") && line.contains("angle_deg = ") && line.contains("height = 0.06"), "{line}");

    // A result without an evaluation is that of the scene.
    let run = bench.run(&words(&["--evaluations", "0", "--json", "-o", "none.toml"])).done();
    let printed: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!((&printed["is_better"], &printed["evaluations"]), (&false.into(), &0.into()));
    assert_eq!(printed["control"], "control = { stiffness = 150, costs = { angle_deg = 5.73, height = 0.06 } }");
    assert!(bench.text("none.toml").contains("a generation needs 7 evaluations; give --evaluations 7 or more"));
    for judged in [&printed["choice"], &printed["report"][1]["outcome"]] {
        assert_eq!(judged["before"], judged["after"]);
    }

    // Other settings than those of the run.
    let other = ["tune", "scene.toml", "--gains", "damping", "--push", "2000", "--pushes", "1", "--resume", "--quiet"];
    let expected = "found --gains damping; expected stiffness,angle_deg";
    bench.run(&[&other[..], &["-o", "whole.toml"]].concat()).refused(&["whole.state.json", expected]);
    bench.write("scene.toml", SCENE.replace("150", "151"));
    bench.run(&words(&["--resume", "--quiet", "-o", "whole.toml"])).refused(&["that run had another scene"]);
}

#[test]
fn scenes_and_options_that_cannot_be_tuned_are_refused_before_anything_is_computed() {
    let bench = bench("tune_bad");
    bench.write("standing.toml", SCENE.replace("control = {", "# control = {"));
    bench.write("stiff.toml", SCENE.replace("stiffness = 150", "stiffness = 800"));
    bench.write("cost.toml", SCENE.replace("height = 0.06", "height = 600"));
    bench.write("key.toml", SCENE.replace("height = 0.06", "hight = 0.06"));
    bench.write("old.toml", "mine");
    for (words, found) in [
        (&["standing.toml"][..], "found no figure with the key `control`"),
        (&["scene.toml", "--figure", "bob"], "found no figure `bob` with the key `control`"),
        (&["stiff.toml"], "found `stiffness` = 800 N.m/rad; expected 20 to 300 N.m/rad"),
        (&["cost.toml"], "line 7, `figure[1].control.costs.height`: found 600; expected a number from 5.0e-5 to 5.0e1"),
        (&["key.toml"], "did you mean `height`"),
        (&["scene.toml", "--gains", "stifness"], "found the gain `stifness`; expected one of `stiffness`"),
        (&["scene.toml", "--gains", "height,height"], "found `height` twice"),
        (&["scene.toml", "-o", "old.toml"], "old.toml: this file already exists"),
        (&["scene.toml", "-o", "scene.toml", "--force"], "scene.toml: this input file would be overwritten"),
        (&["scene.toml", "--resume", "-o", "old.toml"], "old.toml: this file already exists"),
        (&["no.toml"], "no.toml: there is no such file"),
        (&["scene.toml", "--push", "nan"], "expected a force from 1 to 10000 N"),
        (&["scene.toml", "--push", "1e308"], "expected a force from 1 to 10000 N"),
        (&["scene.toml", "--pushes", "0"], "0 is not in 1..=1000"),
        (&["scene.toml", "--jobs", "0"], "expected a whole number from 1 to 1024"),
        (&["scene.toml", "--seed", "1.5"], "invalid digit"),
        (&["scene.toml", "--evaluations", "1e9"], "invalid digit"),
        (&["scene.toml", "--evaluations", "18446744073709551616"], "--evaluations"),
    ] {
        let run = bench.run(&[&["tune"], words].concat());
        let said = run.stderr.replace("\n  hint: ", " hint: ");
        assert!(run.code == Some(2) && said.contains(found), "{words:?}: {:?} {said}", run.code);
        assert!(!bench.exists("tuned.toml") && bench.text("old.toml") == "mine", "{words:?}");
    }
}
