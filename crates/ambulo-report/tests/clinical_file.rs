//! `clinical.csv` has the numbers that the page draws, in both conventions.

use crate::report_pages::{Files, Shown};
use crate::shared_data;
use crate::svg_reader::Figure;
use ambulo::findings::Findings;
use ambulo::model::{BySide, Model, to_osim};
use ambulo::motion::coordinates_from_table;
use ambulo::numerics::mean;
use ambulo::study::{self, ForceTable, LegStances, LoadSource, MeasuredForces, Outcome, Settings, Source};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::table::Table;
use ambulo_report::{clinical_file, outcome_figures};
use ambulo_results::{
    Convention, GroundSource, Input, Keep, Summary, knee_adduction_summary, outcome_summary, outcome_tables,
    summary_json,
};
use std::path::Path;

/// Columns of `clinical.csv` and the panels that show them.
const PANELS: [(&str, &str); 6] = [
    ("pelvis_tilt", "pelvis_tilt_angle"),
    ("hip_flexion", "hip_flexion_angle"),
    ("knee_flexion", "knee_flexion_angle"),
    ("knee_flexion_moment", "knee_flexion_moment"),
    ("ankle_dorsiflexion_power", "ankle_dorsiflexion_power"),
    ("ground_force_vertical", "ground_force_vertical"),
];

/// Moments that no coordinate of a body has whose knee only flexes: columns and panels have the same names.
const OTHER_PLANES: [&str; 4] =
    ["knee_adduction_moment", "knee_rotation_moment", "ankle_inversion_moment", "ankle_rotation_moment"];

fn outcome(folder: &Path, [model, motion, forces, loads]: [&str; 4]) -> (Outcome, Findings) {
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let mut findings = Findings::default();
    let model = Model::from_osim(&read(model), &mut findings).unwrap();
    let table = |name: &str| Table::read_storage(&read(name)).unwrap().0;
    let coordinates = coordinates_from_table(&model, &table(motion), motion, &mut findings).unwrap();
    let loads = Some(ExternalLoads::read(&read(loads)).unwrap().0);
    let measured = MeasuredForces::Table(ForceTable { table: table(forces), loads });
    let source = Source::coordinates(model, coordinates).with_forces(measured);
    (study::run(source, &Settings::default(), &mut findings).unwrap(), findings)
}

/// The recording of the command's tests, whose pelvis has no markers on its iliac spines.
fn walk() -> (Outcome, Findings) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../ambulo-cli/tests/recording");
    outcome(&folder, ["figure.osim", "walk.mot", "walk_grf.mot", "walk_grf.xml"])
}

fn files((outcome, findings): &(Outcome, Findings), convention: Convention) -> Files {
    let (clinical, used) = clinical_file(outcome, convention);
    let input = Input {
        motion: "walk.mot".to_owned(),
        person: None,
        recorded_on: None,
        model: "figure.osim".to_owned(),
        standing: None,
        ground: None,
        loads: None,
        device: None,
        added_mass: Vec::new(),
        ground_source: GroundSource::None,
    };
    let summary = Summary { convention: Some(used), ..outcome_summary(outcome, input, findings) };
    let tables = outcome_tables(outcome, &Keep::all()).unwrap().into_iter().chain([clinical]);
    let mut files: Files = tables.map(|file| (file.name.clone(), file.bytes().unwrap())).collect();
    files.insert("subject.osim".to_owned(), to_osim(&outcome.body).unwrap().write().unwrap());
    files.insert("summary.json".to_owned(), summary_json(&summary).unwrap());
    files
}

fn clinical(files: &Files) -> Table {
    Table::read_csv(&files["clinical.csv"]).unwrap().0
}

/// Largest difference between the mean curves of a panel of `kinematics.svg` and a column of `clinical.csv` over the
/// same cycles [deg].
#[track_caller]
fn difference(outcome: &Outcome, convention: Convention, column: &str, panel: &str) -> f64 {
    let figures = outcome_figures(outcome, convention).unwrap();
    let kinematics = figures.into_iter().find(|file| file.name == "figures/kinematics.svg").unwrap();
    let figure = Figure::read(&String::from_utf8(kinematics.bytes().unwrap()).unwrap());
    let panel = figure.panels.iter().find(|drawn| drawn.id == panel).unwrap();
    let table = Table::read_csv(&clinical_file(outcome, convention).0.bytes().unwrap()).unwrap().0;
    let times = table.column("time").unwrap();
    let mut differences = Vec::new();
    for curve in panel.lines.iter().filter(|line| line.role == "mean") {
        let values = table.column(&format!("{column}_{}", curve.side.letter())).unwrap();
        let at = |time: f64| {
            let after = times.partition_point(|t| *t < time).clamp(1, times.len() - 1);
            let share = (time - times[after - 1]) / (times[after] - times[after - 1]);
            values[after - 1] + share * (values[after] - values[after - 1])
        };
        let cycles = outcome.analysis.cycles.iter().filter(|cycle| cycle.side == curve.side);
        let cycles: Vec<[f64; 2]> = cycles.map(|cycle| [cycle.start_s, cycle.end_s]).collect();
        for [percent, drawn] in &curve.points {
            let own: Vec<f64> = cycles.iter().map(|[from, to]| at(from + percent / 100.0 * (to - from))).collect();
            differences.push((drawn - mean(&own)).abs());
        }
    }
    differences.into_iter().reduce(f64::max).unwrap()
}

/// All traces of these panels are columns of the file.
#[track_caller]
fn assert_drawn(files: &Files, panels: &[(&str, &str)]) {
    let (shown, table) = (Shown::of(files), clinical(files));
    for (column, panel) in panels {
        let traces = shown.panel(panel)["traces"].as_array().unwrap();
        assert!(!traces.is_empty(), "{panel}");
        for trace in traces {
            let side = trace["side"].as_str().unwrap_or("r");
            let expected = table.column(&format!("{column}_{side}")).unwrap();
            let drawn = shown.series(&trace["values"]);
            let span = expected.iter().copied().fold(f64::NEG_INFINITY, f64::max)
                - expected.iter().copied().fold(f64::INFINITY, f64::min);
            for (drawn, expected) in drawn.iter().zip(expected) {
                // Numbers of a page have 16 bits.
                assert!((drawn - expected).abs() <= span / 60_000.0 + 1e-9, "{panel} {side}: {drawn}, {expected}");
            }
            assert_eq!(trace["origin"]["file"], "clinical.csv");
        }
    }
}

#[test]
fn the_page_draws_the_numbers_of_the_file() {
    let files = files(&walk(), Convention::Opensim);
    // The trunk of this walk stays upright: pelvic tilt has no panel.
    assert_drawn(&files, &PANELS[1..]);
    assert!(Shown::of(&files).header("Pelvis and hip angles").starts_with("OpenSim"));
}

#[test]
fn a_pelvis_without_landmarks_keeps_the_models_angles_and_the_page_says_why() {
    let walk = walk();
    let (file, used) = clinical_file(&walk.0, Convention::Clinical);
    assert_eq!(used.used, Convention::Opensim);
    assert!(used.reason.unwrap().contains("iliac spines"));
    assert_eq!(file.bytes().unwrap(), clinical_file(&walk.0, Convention::Opensim).0.bytes().unwrap());
}

#[test]
fn the_clinical_convention_tilts_the_pelvis_and_flexes_the_hips_by_the_same() {
    let Some(data) = shared_data::data() else { return };
    let names =
        ["subject01_simbody.osim", "subject01_walk1_ik.mot", "subject01_walk1_grf.mot", "subject01_walk1_grf.xml"];
    let walk = outcome(&data.join("opensim-gait2392-subject01"), names);
    let [own, clinic] = [Convention::Opensim, Convention::Clinical].map(|convention| files(&walk, convention));
    assert_drawn(&clinic, &PANELS);
    assert_drawn(&clinic, &OTHER_PLANES.map(|name| (name, name)));
    let (shown, own_shown) = (Shown::of(&clinic), Shown::of(&own));
    assert!(shown.header("Pelvis and hip angles").starts_with("clinical"));
    let offset = |column: &str| {
        let [own, clinic] = [&own, &clinic].map(|files| mean(clinical(files).column(column).unwrap()));
        clinic - own
    };
    let [tilt, hip, knee] = ["pelvis_tilt_r", "hip_flexion_r", "knee_flexion_r"].map(offset);
    println!("tilt {tilt:+.1} deg, hip flexion {hip:+.1} deg");
    // The sacral marker of this model is on the skin, above the posterior spines: its line is less steep than between
    // spines.
    assert!((1.0..20.0).contains(&tilt) && (tilt - hip).abs() < 1.0 && knee.abs() < 1e-9);
    // Figures for papers show the same angles, and not those of the other convention.
    for (column, panel) in &PANELS[..2] {
        for convention in [Convention::Clinical, Convention::Opensim] {
            let own = difference(&walk.0, convention, column, panel);
            assert!(own < 0.2, "{panel}, {convention:?}: {own} degrees");
        }
    }
    // Curves over the cycle and bands move along.
    let of_panel = |shown: &Shown, what: &str| match what {
        "band" => mean(&shown.series(&shown.panel("hip_flexion_angle")["band"]["mean"])),
        _ => mean(&shown.series(&shown.panel("hip_flexion_angle")["means"][0]["values"])),
    };
    let cycles = of_panel(&shown, "means") - of_panel(&own_shown, "means");
    let bands = of_panel(&shown, "band") - of_panel(&own_shown, "band");
    assert!((cycles - hip).abs() < 1.0 && (bands - 12.0).abs() < 3.0, "{cycles} {bands}");
}

#[test]
fn a_coordinate_that_is_not_measured_is_in_no_clinical_curve_and_in_no_figure() {
    let (mut outcome, _) = walk();
    let columns = |outcome: &Outcome| {
        let bytes = clinical_file(outcome, Convention::Clinical).0.bytes().unwrap();
        Table::read_csv(&bytes).unwrap().0.names().to_vec()
    };
    let curves = |outcome: &Outcome| {
        let files = outcome_figures(outcome, Convention::Clinical).unwrap();
        let file = files.into_iter().find(|file| file.name == "figures/kinematics.svg").unwrap();
        let figure = Figure::read(&String::from_utf8(file.bytes().unwrap()).unwrap());
        figure.panels.iter().find(|panel| panel.id == "ankle_dorsiflexion_angle").unwrap().lines.len()
    };
    let (all, drawn) = (columns(&outcome), curves(&outcome));
    outcome.not_measured = vec![outcome.body.coordinate("ankle_angle_r").unwrap()];
    let left = columns(&outcome);
    let lost: Vec<_> = all.iter().filter(|name| !left.contains(name)).map(String::as_str).collect();
    // The moments of the other planes have axes that turn with the foot.
    let expected = [
        "ankle_dorsiflexion_r",
        "ankle_dorsiflexion_moment_r",
        "ankle_inversion_moment_r",
        "ankle_rotation_moment_r",
        "ankle_dorsiflexion_power_r",
    ];
    assert_eq!(lost, expected);
    assert!(curves(&outcome) < drawn, "{drawn}");
}

/// The peaks of the summary are those of the curve, up to the interpolation between frames of 60 Hz.
#[test]
fn the_peaks_of_the_knee_adduction_moment_are_those_of_its_curve() {
    let Some(data) = shared_data::data() else { return };
    let names =
        ["subject01_simbody.osim", "subject01_walk1_ik.mot", "subject01_walk1_grf.mot", "subject01_walk1_grf.xml"];
    let walk = outcome(&data.join("opensim-gait2392-subject01"), names);
    let files = files(&walk, Convention::Clinical);
    let table = clinical(&files);
    let times = table.column("time").unwrap();
    let stances = walk.0.knee_adduction();
    for (side, found) in stances.iter() {
        let whole = walk.0.stances.iter().filter(|stance| stance.side == side);
        let whole: Vec<_> = whole.filter(|s| s.start_s > times[1] && s.end_s < times[times.len() - 2]).collect();
        assert_eq!((found.stances.len(), found.source), (whole.len(), LoadSource::Measured), "{side}");
        let curve = table.column(&format!("knee_adduction_moment_{}", side.letter())).unwrap();
        for ([first, second, impulse], stance) in found.stances.iter().zip(whole) {
            let middle = 0.5 * (stance.start_s + stance.end_s);
            let largest = |from: f64, to: f64| {
                let inside = times.iter().zip(curve).filter(|(t, _)| (from..=to).contains(*t));
                inside.map(|(_, moment)| *moment).fold(f64::NEG_INFINITY, f64::max)
            };
            println!("{side}: peaks {first:.3} {second:.3} N.m/kg, impulse {impulse:.3} N.m.s/kg");
            assert!((first - largest(stance.start_s, middle)).abs() < 0.02, "{side}: first peak");
            assert!((second - largest(middle, stance.end_s)).abs() < 0.02, "{side}: second peak");
            let duration_s = stance.end_s - stance.start_s;
            assert!(*impulse > 0.0 && *impulse < first.max(*second) * duration_s, "{side}: impulse");
        }
    }
    assert!(stances.values().any(|found| !found.stances.is_empty()));
    let shown = Shown::of(&files);
    assert!(shown.panel("knee_adduction_moment")["band"]["mean"].is_object(), "Schwartz 2008 has this moment");
}

#[test]
fn a_measured_and_a_predicted_leg_are_neither_pooled_nor_compared() {
    let leg = |source: LoadSource, peak: f64| LegStances { source, stances: vec![[peak, 0.5 * peak, 0.2]] };
    let [measured, predicted] = [LoadSource::Measured, LoadSource::Predicted];
    let rows = |right, left| knee_adduction_summary(&BySide { right: leg(right, 0.435), left: leg(left, 0.286) });
    let mixed = rows(measured, predicted);
    assert_eq!(mixed.len(), 3);
    for row in &mixed {
        assert_eq!((row.both, row.symmetry), (None, None), "{row:?}");
        assert_eq!(row.source_words(), "right measured, left predicted");
        let sources = [row.right, row.left].map(|side| side.unwrap().source);
        assert_eq!(sources, [Some(measured), Some(predicted)]);
    }
    let same = rows(measured, measured);
    assert!(same.iter().all(|row| row.both.unwrap().strides == 2 && row.symmetry.is_some()));
    assert_eq!(same[0].source_words(), "measured");
    let words = serde_json::to_value(&mixed[0]).unwrap();
    assert_eq!((words["right"]["source"].as_str(), words["both"].is_null()), (Some("measured"), true));
}
