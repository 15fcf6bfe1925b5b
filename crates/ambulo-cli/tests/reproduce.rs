//! `ambulo reproduce`: the files that it writes, and that their pages name them.

use crate::workbench::Workbench;
use std::path::Path;
use std::sync::OnceLock;

/// The folder with `paper`, which `ambulo reproduce --brief` wrote, and what it printed; other tests read it, too.
pub(crate) fn recomputed() -> &'static (Workbench, String) {
    static RECOMPUTED: OnceLock<(Workbench, String)> = OnceLock::new();
    RECOMPUTED.get_or_init(|| {
        let bench = Workbench::empty("reproduce");
        let stdout = bench.run(&["reproduce", "--brief", "-o", "paper"]).done().stdout;
        (bench, stdout)
    })
}

fn page() -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/REPRODUCTION.md")).unwrap()
}

#[test]
fn the_paper_is_recomputed_into_the_documented_files() {
    let (bench, stdout) = recomputed();
    assert!(stdout.contains("a1  holds") && stdout.contains(" claims of the paper hold"), "{stdout}");
    bench.run(&["view", "paper"]).done();
    bench.run(&["report", "paper"]).refused(&["`ambulo reproduce` wrote this folder"]);
    let claims = bench.json("paper/claims.json");
    let rows = claims.as_array().unwrap();
    assert_eq!(rows.len(), 35);
    crate::measured_pages::claims_are_those_of_the_page(rows);
    for row in rows {
        let keys: Vec<&String> = row.as_object().unwrap().keys().collect();
        let all = [
            "id",
            "paper",
            "criterion",
            "paper_mode",
            "corrected",
            "pass",
            "note",
            "headline",
            "kind",
            "former",
            "experiment",
        ];
        for key in all {
            assert!(row.get(key).is_some(), "{key} is missing in {keys:?}");
            assert!(page().contains(&format!("`{key}`")), "{key} is not documented");
        }
        let headline = row["headline"].as_str().unwrap();
        for mode in ["paper_mode", "corrected"] {
            assert!(row[mode].get(headline).is_some(), "{mode}: {headline}");
        }
    }
    // The clock was held.
    let speed = rows.iter().find(|row| row["id"] == "k").unwrap();
    assert!(speed["paper_mode"]["drawn_frames_per_s"].as_f64().unwrap() > 30.0 && speed["pass"] == true);
    for number in 1..=7 {
        assert!(bench.text(&format!("paper/figures/figure{number}.svg")).ends_with("</svg>\n"));
        let csv = bench.text(&format!("paper/figures/figure{number}.csv"));
        assert!(csv.starts_with("panel,series,x_quantity,x,y_quantity,y\n") && csv.lines().count() > 40, "{number}");
    }
    // Two modes.
    let tables = [
        (
            "paper_muscles.csv",
            "mode,gait,joint,phase,group,action,share,moment_nm_kg,power_w_kg,work_j_kg",
            2 * 4 * 3 * 7,
        ),
        ("torques.csv", "mode,gait,coordinate,cycle_s,harmonic,cosine_nm,sine_nm,r_squared", 2 * 4 * 6 * 7),
    ];
    for (name, columns, count) in tables {
        let text = bench.text(&format!("paper/{name}"));
        assert_eq!((text.lines().next().unwrap(), text.lines().count()), (columns, 1 + count), "{name}");
        let missing = columns.split(',').find(|column| !page().contains(&format!("`{column}`")));
        assert_eq!(missing, None, "not documented");
    }
    assert!(bench.text("paper/torques.toml").matches("[[torque]]").count() == 2 * 4 * 6);
    // Nothing else was tried: one row for each thing that is left open.
    assert!(
        bench
            .text("paper/assumptions.csv")
            .starts_with("what,value,range,source,why,other,claim,headline,with_value,with_other,turns\n")
    );
    assert_eq!(bench.text("paper/assumptions.csv").lines().count(), 1 + 45);
    the_setting_is_written(bench, stdout, rows);
    the_torques_are_replayed(bench);
    the_page_says_what_the_files_say(&bench.text("paper/report.html"), rows);
}

/// The setting that was used, with the claims that hold, and the counts by both kinds of criteria.
fn the_setting_is_written(bench: &Workbench, stdout: &str, rows: &[serde_json::Value]) {
    let held: Vec<String> = rows
        .iter()
        .filter(|row| row["kind"] == "paper" && row["pass"] == true)
        .map(|row| row["id"].to_string())
        .collect();
    let setting = bench.text("paper/setting.toml");
    assert!(setting.contains(&format!("holds = [{}]", held.join(", "))), "{setting}");
    bench.run(&["reproduce", "--write-setting", "default.toml"]).done();
    assert_eq!(bench.text("default.toml"), setting);
    assert!(stdout.contains("by the first criteria: "), "{stdout}");
    for row in rows.iter().filter(|row| row["kind"] == "paper" && row["pass"] == false) {
        let reason = row["experiment"].as_str().unwrap();
        assert!(reason.contains("Experiment: ") && stdout.contains(reason), "{reason}");
    }
}

#[test]
fn a_claim_that_held_and_no_longer_does_gives_exit_code_1() {
    let bench = Workbench::empty("reproduce-check");
    // A long step is no slow walk.
    bench.write("own.toml", "name = \"long\"\nholds = [\"c3\", \"e2\"]\n[gait]\nstandard_step_m = 0.75\n");
    let check = ["reproduce", "--setting", "own.toml", "--brief", "--check", "--keep", "claims,setting", "-o", "own"];
    let run = bench.run(&check);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stdout.contains("no longer hold with the setting `long`: c3"), "{}", run.stdout);
    assert!(!bench.text("own/setting.toml").contains("\"c3\""));
}

#[test]
fn settings_that_cannot_be_used_are_refused() {
    let bench = Workbench::empty("reproduce-settings");
    bench.write("own.toml", "[figure]\nstatur_m = 1.7\n");
    let refused = |words: &[&str], expected: &[&str]| bench.run(&[&["reproduce"], words].concat()).refused(expected);
    refused(&["--setting", "own.toml"], &["own.toml", "line 2", "unknown key", "did you mean `stature_m`?"]);
    refused(&["--setting", "nothing.toml"], &["nothing.toml", "papers-results, schwartz-children"]);
    bench.write("own.toml", "[figure]\nstature_m = 1.7\n");
    refused(&["--setting", "own.toml", "--check"], &["has no list `holds`", "setting.toml"]);
    bench.run(&["reproduce", "--setting", "own.toml", "--write-setting", "whole.toml"]).done();
    assert!(bench.text("whole.toml").contains("\nstature_m = 1.7\n"));
    refused(&["--setting", "own.toml", "--write-setting", "own.toml"], &["this input file would be overwritten"]);
    refused(&["--setting", "own.toml", "--write-setting", "whole.toml"], &["already exists"]);
}

/// The torques act on the figure that they were computed for, which falls without feedback.
fn the_torques_are_replayed(bench: &Workbench) {
    let replay = ["walk", "--torques", "paper/torques.toml", "--figure", "faure-1997", "-v", "-o", "replay"];
    let run = bench.run(&replay).infeasible();
    run.reports(&["the torques act without feedback from 1.00 s on", "the figure falls 0."]);
    let findings = bench.json("replay/summary.json")["findings"].clone();
    assert!(findings.as_array().unwrap().iter().any(|finding| finding["code"] == "walk.replay_fell"), "{findings}");
    assert!(bench.text("replay/report.html").contains("the figure falls 0."));
    assert!(!run.stderr.contains("computed for a figure of"), "{}", run.stderr);
    let other = ["walk", "--torques", "paper/torques.toml", "--mass", "90", "-v", "-o", "other"];
    bench.run(&other).infeasible().reports(&["the torques were computed for a figure of", "this one has 90.0 kg"]);
    let refused = |more: &[&str], words: &[&str]| bench.run(&[&replay[..], more].concat()).refused(words);
    refused(&["--mode", "corrected"], &["--torques", "expected the mode paper"]);
    refused(&["--gait", "free"], &["found no torques of the gait `free`", "standard, long, short, goose"]);
    refused(&["--speed-change", "1:1.6"], &["expected equal cycles"]);
    let text = bench.text("paper/torques.toml");
    for (from, to, words) in [
        ("mean = ", "mean = \"x\" # ", "expected a number"),
        ("cosine = [", "cosine = [1, ", "six torques"),
        ("coordinate = \"knee_angle_r\"", "coordinate = \"knee\"", "found torques of the coordinate `knee`"),
        ("cycle_s = ", "cycle_s = 0 # ", "expected a number above zero"),
    ] {
        bench.write("paper/torques.toml", text.replacen(from, to, 1));
        refused(&[], &[words]);
    }
}

fn the_page_says_what_the_files_say(html: &str, claims: &[serde_json::Value]) {
    assert!(!html.contains("src=\"http") && !html.contains("href=\"http") && !html.contains("<script"));
    // Seven figures, five of them again for the corrected mode, four gaits in two modes, and the speed of one.
    assert_eq!(html.matches("<svg ").count(), 7 + 5 + 8 + 1);
    assert!(html.matches("<animate attributeName=\"d\"").count() == 8 * 5);
    let counted = || claims.iter().filter(|claim| claim["kind"] == "paper");
    let held = counted().filter(|claim| claim["pass"] == true).count();
    assert!(html.contains(&format!("{held} of {} claims of the paper that can fail hold", counted().count())));
    for claim in claims {
        let id = claim["id"].as_str().unwrap();
        let row = html.split(&format!("<tr id=\"{id}\">")).nth(1).unwrap().split("</tr>\n").next().unwrap();
        let mark = if claim["pass"] == true { "✓ holds" } else { "✗ fails" };
        assert!(row.contains(mark), "{id}: {row}");
        let value = claim["paper_mode"][claim["headline"].as_str().unwrap()].as_f64().unwrap();
        let cell = row.rsplit("<td class=\"number\">").nth(1).unwrap().split('<').next().unwrap();
        let shown: f64 = cell.parse().unwrap();
        assert!((shown - value).abs() <= 0.06 * value.abs(), "{id}: {shown} for {value}");
    }
}
