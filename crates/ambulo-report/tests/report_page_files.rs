//! Broken files are rejected with the file, the place, what was found and what was expected, by the page and by the
//! exports.

use crate::report_pages::{Files, page_of, predicted, recorded, with_summary};
use ambulo_formats::table::Table;
use ambulo_report::{csv_of_folder, glb_of_folder};
use ambulo_results::Folder;
use serde_json::{Value, json};

#[track_caller]
fn rejected_by_page(files: &Files, expected: &str) {
    let error = page_of("folder", files).unwrap_err().to_string();
    assert!(error.contains(expected), "{error}\nexpected {expected}");
}

#[track_caller]
fn rejected_by_exports(files: &Files, expected: &str) {
    let file = |name: &str| files.get(name).cloned();
    let folder = Folder::of_files("folder", &file);
    for error in [glb_of_folder(&folder).unwrap_err(), csv_of_folder(&folder).unwrap_err()] {
        assert!(error.to_string().contains(expected), "{error}\nexpected {expected}");
    }
}

/// With this number in row 101 of the second column.
fn with_number(files: &Files, name: &str, number: f64) -> (Files, String) {
    let table = Table::read_storage(&files[name]).unwrap().0;
    let spoilt = table.names()[1].clone();
    let columns = table.columns().map(|(column, values)| {
        let mut values = values.to_vec();
        if column == spoilt {
            values[100] = number;
        }
        (column.to_owned(), values)
    });
    let mut changed = Table::new("changed", columns.collect()).unwrap();
    changed.in_degrees = table.in_degrees;
    let mut files = files.clone();
    files.insert(name.to_owned(), changed.write_storage());
    (files, spoilt)
}

#[test]
fn numbers_that_cannot_be_results_are_rejected() {
    let files = predicted();
    for number in [1e300, -1e300, f64::INFINITY, f64::NAN] {
        for name in ["kinematics.mot", "grf.mot", "grf_sd.mot", "grf_measured.mot", "moments.sto", "powers.sto"] {
            let (broken, column) = with_number(&files, name, number);
            let expected =
                format!(", column `{column}`: found {number:?}; expected a finite number, at most 1e12 in size");
            rejected_by_page(&broken, &format!("folder/{name}: line "));
            rejected_by_page(&broken, &expected);
            if ["kinematics.mot", "grf.mot", "grf_measured.mot", "moments.sto"].contains(&name) {
                rejected_by_exports(&broken, &expected);
            }
        }
    }
    let (fine, _) = with_number(&files, "powers.sto", 1e11);
    page_of("folder", &fine).unwrap();
}

#[test]
fn a_body_light_years_long_is_not_drawn() {
    let files = recorded();
    let text = String::from_utf8(files["subject.osim"].clone()).unwrap();
    let (before, after) = text.split_once("<translation>").unwrap();
    let (_, after) = after.split_once("</translation>").unwrap();
    let text = format!("{before}<translation>1e300 0 0</translation>{after}");
    let mut broken = files.clone();
    broken.insert("subject.osim".to_owned(), text.into_bytes());
    let file = |name: &str| broken.get(name).cloned();
    let error = glb_of_folder(&Folder::of_files("folder", &file)).unwrap_err().to_string();
    assert!(error.contains("expected a finite number, at most 1e12"), "{error}");
    rejected_by_page(&broken, "expected a finite number, at most 1e12");
}

#[test]
fn a_summary_with_wrong_types_is_rejected_with_its_key() {
    type Change = fn(&mut Value);
    let cases: [(Change, &str); 13] = [
        (
            |s| s["ground"]["source"] = json!("guessed"),
            "`ground.source`: unknown variant `guessed`, expected one of `measured`, ",
        ),
        (|s| s["ground"] = json!("none"), "`ground`: invalid type: string \"none\", expected struct Ground"),
        (|s| s["verdict"] = json!(5), "`verdict`: invalid type: integer `5`, expected struct Verdict"),
        (
            |s| s["verdict"]["state"] = json!("yes"),
            "`verdict.state`: unknown variant `yes`, expected one of `feasible`, `infeasible`, `not_judged`",
        ),
        (|s| s["verdict"]["reasons"] = json!({}), "`verdict.reasons`: invalid type: map, expected a sequence"),
        (
            |s| s["verdict"]["closest"] = json!([7]),
            "`verdict.closest[0]`: invalid type: integer `7`, expected struct Closest",
        ),
        (|s| s["findings"] = json!([{"code": 1}]), "`findings[0]"),
        (
            |s| s["residual"]["force_rms_n"] = json!("small"),
            "`residual.force_rms_n`: invalid type: string \"small\", expected f64",
        ),
        (|s| s["residual"]["force_rms_n"] = json!(1e300), "`residual.force_rms_n` is 1e300; expected a finite number"),
        (|s| s["height_m"] = json!(true), "`height_m`: invalid type: boolean `true`, expected f64"),
        (|s| drop(s.as_object_mut().unwrap().remove("frames")), "missing field `frames`"),
        (|s| drop(s["verdict"].as_object_mut().unwrap().remove("frames")), "`verdict`: missing field `frames`"),
        (|s| *s = json!([1]), "summary.json: found [1]; expected an object"),
    ];
    for (change, expected) in cases {
        let mut files = recorded();
        with_summary(&mut files, change);
        rejected_by_page(&files, expected);
        rejected_by_page(&files, "folder/summary.json: ");
    }
}

#[test]
fn the_error_of_a_truncated_summary_says_what_to_do() {
    let mut files = recorded();
    let whole = files["summary.json"].clone();
    files.insert("summary.json".to_owned(), whole[..whole.len() / 2].to_vec());
    rejected_by_page(&files, "hint: the file is truncated or not JSON; run the command that wrote it again");
}

#[test]
fn causes_of_errors_are_not_lost() {
    let mut files = recorded();
    let text = String::from_utf8(files["subject.osim"].clone()).unwrap();
    let (before, after) = text.split_once("<mass>").unwrap();
    files.insert("subject.osim".to_owned(), format!("{before}<mass>-{after}").into_bytes());
    rejected_by_page(&files, "folder/subject.osim: ");
    rejected_by_page(&files, "mass");
    rejected_by_page(&files, "expected");
}

#[test]
fn a_byte_order_mark_is_skipped_and_zero_bytes_are_reported() {
    let files = recorded();
    for name in ["summary.json", "cycles.csv", "events.csv", "kinematics.mot", "subject.osim"] {
        let mut marked = files.clone();
        marked.insert(name.to_owned(), [b"\xef\xbb\xbf", files[name].as_slice()].concat());
        assert_eq!(page_of("folder", &marked).unwrap(), page_of("folder", &files).unwrap(), "{name}");
    }
    for name in ["summary.json", "cycles.csv", "events.csv", "kinematics.mot", "grf.mot"] {
        let mut binary = files.clone();
        binary.insert(name.to_owned(), b"PK\x03\x04\x00\x00\xffdata".to_vec());
        rejected_by_page(&binary, &format!("folder/{name}: byte 4 is zero, so this is not text"));
    }
}

#[test]
fn a_scene_with_such_numbers_is_not_drawn() {
    let poses = |x: &str| format!("time,body,px,py,pz,qw,qx,qy,qz\n0,ball,0,1,0,1,0,0,0\n0.1,ball,{x},1,0,1,0,0,0\n");
    let shapes = |radius: f64| {
        let ball = json!({"kind": "capsule", "from": [0.0, 0.0, 0.0], "to": [0.0, 0.1, 0.0], "radius": radius});
        let body = json!({"name": "ball", "mass_kg": 1.0, "side": null, "shapes": [ball]});
        json!({"format": 1, "gravity_m_s2": [0.0, -9.81, 0.0], "bodies": [body], "obstacles": []}).to_string()
    };
    let glb = |poses: String, shapes: String| {
        let file = |name: &str| match name {
            "poses.csv" => Some(poses.clone().into_bytes()),
            "shapes.json" => Some(shapes.clone().into_bytes()),
            _ => None,
        };
        glb_of_folder(&Folder::of_files("folder", &file)).map_err(|error| error.to_string())
    };
    glb(poses("0.5"), shapes(0.2)).unwrap();
    for (poses, shapes, expected) in [
        (poses("1e300"), shapes(0.2), "folder/poses.csv: line 3, column 3: found `1e300`; expected a finite number"),
        (poses("inf"), shapes(0.2), "folder/poses.csv: line 3, column 3: found `inf`"),
        (poses("0.5"), shapes(1e300), "folder/shapes.json: a shape of `ball`: found 1e300; expected a finite number"),
        (poses("0.5"), shapes(0.2)[..80].to_owned(), "folder/shapes.json: EOF while parsing"),
    ] {
        let error = glb(poses, shapes).unwrap_err();
        assert!(error.contains(expected), "{error}\nexpected {expected}");
    }
}
