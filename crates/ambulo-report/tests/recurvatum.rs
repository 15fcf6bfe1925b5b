//! A knee that bends backward further than it flexes keeps its signs: in the panels, in the figures and in the 3-D
//! view.
//!
//! Gait2392 counts extension of the knee positive, Rajagopal's model flexion. The recording goes from 6 degrees of
//! flexion to 10 degrees of hyperextension, so its largest angle is no flexion in either.

use crate::report_pages::{Files, Shown, analysed};
use crate::svg_reader::Figure;
use ambulo::findings::Findings;
use ambulo::model::{Body, CoordinateKind, Model, to_osim};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::table::Table;
use std::path::Path;

/// Least and largest flexion of the recording [deg].
const FLEXION_DEG: [f64; 2] = [-10.0, 6.0];

/// A model, and +1 where its knee's coordinate counts flexion.
struct Case {
    name: &'static str,
    model: Model,
    flexion: f64,
}

fn model(bytes: &[u8]) -> Model {
    Model::from_osim(bytes, &mut Findings::default()).unwrap()
}

/// The demo's body, whose knees count extension, and the same with knees that count flexion.
fn built_in() -> [Case; 2] {
    let extension = model(include_bytes!("../../ambulo-cli/tests/recording/figure.osim"));
    let turned = |body: &Body| {
        let mut body = body.clone();
        if body.name.starts_with("tibia") {
            body.joint.rotations.iter_mut().for_each(|axis| axis.direction = -axis.direction);
        }
        body
    };
    let bodies = extension.bodies().iter().map(turned).collect();
    let flexion =
        Model::new("flexion", extension.gravity(), bodies, extension.coordinates().to_vec(), Vec::new()).unwrap();
    [
        Case { name: "knee extension positive", model: extension, flexion: -1.0 },
        Case { name: "knee flexion positive", model: flexion, flexion: 1.0 },
    ]
}

/// The published models, where they are.
fn published() -> Vec<Case> {
    let root = match std::env::var_os("AMBULO_DATA") {
        Some(root) => Path::new(&root).join("data"),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"),
    };
    let case = |(name, file, flexion): (&'static str, &str, f64)| {
        let bytes = std::fs::read(root.join(file)).ok()?;
        Some(Case { name, model: model(&bytes), flexion })
    };
    let files = [
        ("Gait2392", "opensim-gait2392-subject01/subject01_simbody.osim", -1.0),
        ("Rajagopal", "opensim-rajagopal-walk/subject_walk_scaled.osim", 1.0),
    ];
    let found: Vec<Case> = files.into_iter().filter_map(case).collect();
    if found.is_empty() {
        println!("skipped: no data");
    }
    found
}

fn table(text: &[u8]) -> Table {
    Table::read_storage(text).unwrap().0
}

/// A storage file with these columns.
fn storage(names: &[String], rows: impl Iterator<Item = Vec<f64>>) -> Vec<u8> {
    let rows: Vec<String> = rows.map(|row| row.iter().map(f64::to_string).collect::<Vec<_>>().join("\t")).collect();
    let head =
        format!("Coordinates\nversion=1\nnRows={}\nnColumns={}\ninDegrees=yes\nendheader", rows.len(), names.len());
    format!("{head}\n{}\n{}\n", names.join("\t"), rows.join("\n")).into_bytes()
}

/// The demo's walk on plates, its knees brought into the range of the recording.
fn walk(case: &Case) -> Files {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../ambulo-cli/tests/recording");
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let motion = table(&read("walk.mot"));
    let flexion = |name: &str| -> Vec<f64> { motion.column(name).unwrap().iter().map(|x| -x).collect() };
    let knees: Vec<f64> = ["knee_angle_r", "knee_angle_l"].iter().flat_map(|name| flexion(name)).collect();
    let (low, high) = knees.iter().fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(*x), high.max(*x)));
    let [least, most] = FLEXION_DEG;
    let squeezed = |x: f64| least + (x - low) / (high - low) * (most - least);
    let names: Vec<String> = motion.names().to_vec();
    let rows = (0..motion.rows()).map(|row| {
        let value = |name: &String| {
            let x = motion.column(name).unwrap()[row];
            if name.starts_with("knee_angle") { case.flexion * squeezed(-x) } else { x }
        };
        names.iter().map(value).collect()
    });
    let loads = ExternalLoads::read(&read("walk_grf.xml")).unwrap().0;
    analysed(&to_osim(&case.model).unwrap().write().unwrap(), &storage(&names, rows), &read("walk_grf.mot"), &loads)
}

/// Two seconds in the air in which only the right knee moves, through the range of the recording.
fn swing(case: &Case) -> Files {
    let names: Vec<String> =
        std::iter::once("time".to_owned()).chain(case.model.coordinates().iter().map(|c| c.name.clone())).collect();
    let [least, most] = FLEXION_DEG;
    let rows = (0..=200).map(|i| {
        let t = 0.01 * f64::from(i);
        let knee = 0.5 * (least + most) + 0.5 * (most - least) * (std::f64::consts::TAU * t).sin();
        let value = |c: &ambulo::model::Coordinate| match c.kind {
            _ if c.name == "knee_angle_r" => case.flexion * knee,
            CoordinateKind::Rotation => c.default_value.to_degrees(),
            _ => c.default_value,
        };
        std::iter::once(t).chain(case.model.coordinates().iter().map(value)).collect()
    });
    let nothing = ExternalLoads { name: "none".into(), datafile: None, forces: Vec::new() };
    let bytes = to_osim(&case.model).unwrap().write().unwrap();
    analysed(
        &bytes,
        &storage(&names, rows),
        b"none\nversion=1\nnRows=2\nnColumns=1\ninDegrees=no\nendheader\ntime\n0\n1\n",
        &nothing,
    )
}

/// The curve of the right side over time in a panel.
fn over_time(shown: &Shown, panel: &str) -> Vec<f64> {
    let traces = shown.panel(panel)["traces"].as_array().unwrap();
    let right = traces.iter().find(|trace| trace["side"] == "r").unwrap_or_else(|| panic!("{panel}: {traces:?}"));
    shown.series(&right["values"])
}

#[track_caller]
fn assert_range(values: impl Iterator<Item = f64> + Clone, what: &str) {
    let (low, high) = values.fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
    assert!((low - FLEXION_DEG[0]).abs() < 0.2 && (high - FLEXION_DEG[1]).abs() < 0.2, "{what}: {low} to {high}");
}

#[track_caller]
fn assert_same(a: &[f64], b: &[f64], what: &str) {
    let size = b.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    assert!(a.len() == b.len() && size > 0.0, "{what}");
    for (a, b) in a.iter().zip(b) {
        assert!((a - b).abs() < 2e-3 * size, "{what}: {a} instead of {b}");
    }
}

#[test]
fn a_page_shows_hyperextension_as_extension() {
    let cases = built_in().into_iter().map(|case| (walk(&case), case));
    for (files, Case { name, flexion, .. }) in cases.chain(published().into_iter().map(|case| (swing(&case), case))) {
        let shown = Shown::of(&files);
        let summary: serde_json::Value = serde_json::from_slice(&files["summary.json"]).unwrap();
        let mass_kg = summary["mass_kg"].as_f64().unwrap();
        assert_range(over_time(&shown, "knee_flexion_angle").into_iter(), name);
        // Moments of the extensors are positive, whatever the coordinate counts.
        let moments = table(&files["moments.sto"]);
        let extensor: Vec<f64> =
            moments.column("knee_angle_r_moment").unwrap().iter().map(|moment| -flexion * moment / mass_kg).collect();
        assert_same(&over_time(&shown, "knee_flexion_moment"), &extensor, name);
        let torques = shown.session()["view"]["torques"].as_array().unwrap();
        let knee = torques.iter().find(|t| t["panel"] == "knee_flexion_moment" && t["side"] == "r").unwrap();
        assert_same(&shown.series(&knee["values"]), &extensor, name);
        // The arrow of an extensor moment points along the axis of extension: to the right.
        let axis = &knee["axis"];
        assert!(axis[2].as_f64().unwrap() > 0.9, "{name}: {axis}");
    }
}

#[test]
fn figures_over_the_cycle_show_it_in_the_same_way() {
    for case in built_in() {
        let files = walk(&case);
        let figure = Figure::read(std::str::from_utf8(&files["figures/kinematics.svg"]).unwrap());
        let panel = figure.panels.iter().find(|panel| panel.id == "knee_flexion_angle").unwrap();
        let single = panel.lines.iter().filter(|line| line.role != "infeasible");
        let values = single.flat_map(|line| line.points.iter().map(|point| point[1]));
        assert_range(values, case.name);
    }
}
