//! Numbers of the pages of `docs/measured/`, a sample computed anew: equal to the digits that the page prints.
//!
//! | page | sample |
//! |---|---|
//! | VALIDATION | errors of the forces of each foot, 12 trials |
//! | PEOPLE | a walk of a laboratory that recorded one person once |
//! | GROUND_FIT | the fitted numbers, figures of seven straight walks |
//! | WALK_BANDS | peaks of free walking |
//! | OPTIMAL_WALK | slip and knee of three walks |
//! | PHYSICAL_WALK | harmonics of the torques of the plan |
//! | REPRODUCTION | all claims but the clock (called from `reproduce.rs`) |
//!
//! A number that moved is an error of the change, or the page is out of date: `cargo xtask measured PAGE` writes it
//! again.

use crate::shared_data;
use crate::workbench::Workbench;
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Speed, Walk};
use ambulo::ground::predict::FittedParameters;
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::numerics::Harmonics;
use ambulo::simulation::consistent_walk::{ConsistentWalkSettings, make_consistent_walk};
use ambulo_formats::table::Table;
use serde_json::Value;
use std::path::Path;

/// A trial of VALIDATION.
struct Trial {
    /// Its name on the page.
    name: &'static str,
    /// Its person in GROUND_FIT, if this is the only straight walk of the person.
    subject: Option<&'static str>,
    folder: &'static str,
    recording: &'static str,
    standing: Option<&'static str>,
    /// Mass [kg], if the recording does not have it.
    mass: Option<&'static str>,
}

/// A straight walk.
const fn straight(name: &'static str, subject: &'static str, folder: &'static str, files: [&'static str; 2]) -> Trial {
    Trial { subject: Some(subject), ..turn(name, folder, files) }
}

/// A turn; files are the recording and the standing trial.
const fn turn(name: &'static str, folder: &'static str, files: [&'static str; 2]) -> Trial {
    Trial { name, subject: None, folder, recording: files[0], standing: Some(files[1]), mass: None }
}

const TRIALS: [Trial; 12] = [
    straight("HC032A03", "HC032A", "biomechzoo-HC032A", ["HC032A03.c3d", "HC032A01.c3d"]),
    turn("HC032A18", "biomechzoo-HC032A", ["HC032A18.c3d", "HC032A01.c3d"]),
    turn("HC002D25", "biomechzoo-HC002D", ["HC002D25.c3d", "HC002D02.c3d"]),
    straight("HC030A05", "HC030A", "biomechzoo-HC030A", ["HC030A05.c3d", "HC030A01.c3d"]),
    turn("HC031A23", "biomechzoo-HC031A", ["HC031A23.c3d", "HC031A01.c3d"]),
    straight("HC033A10", "HC033A", "biomechzoo-HC033A", ["HC033A10.c3d", "HC033A01.c3d"]),
    straight("HC036A10", "HC036A", "biomechzoo-HC036A", ["HC036A10.c3d", "HC036A01.c3d"]),
    turn("HC055A34", "biomechzoo-HC055A", ["HC055A34.c3d", "HC055A01.c3d"]),
    Trial { standing: None, ..straight("HC003B08", "HC003B", "biomechzoo-HC003B", ["HC003B08.c3d", ""]) },
    Trial { standing: None, ..straight("HC034A07", "HC034A", "biomechzoo-HC034A", ["HC034A07.c3d", ""]) },
    straight(
        "flat foot",
        "flat foot",
        "btkdata-flatfoot-full",
        ["PiG_Motion-FlatFoot-Full.c3d", "PiG_Calibration-FlatFoot-Full.c3d"],
    ),
    // One of three trials of a person who walks fast.
    Trial { standing: None, mass: Some("66.4"), ..turn("fast 5", "opensim-core-fast-walk", ["walking5.c3d", ""]) },
];

/// A page of `docs/measured/`.
struct MeasuredPage {
    name: &'static str,
    text: String,
}

impl MeasuredPage {
    fn read(name: &'static str) -> MeasuredPage {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/measured").join(name).with_extension("md");
        MeasuredPage { name, text: std::fs::read_to_string(path).unwrap() }
    }

    /// The cells of the first row below a heading that begins with these.
    fn row(&self, heading: &str, begins: &[&str]) -> Vec<&str> {
        let (_, below) = self.text.split_once(heading).unwrap_or_else(|| panic!("{}: no {heading}", self.name));
        let rows = below.lines().filter(|line| line.starts_with('|'));
        let mut rows = rows.map(|line| line.trim_matches('|').split('|').map(str::trim).collect::<Vec<_>>());
        rows.find(|row| row.starts_with(begins)).unwrap_or_else(|| panic!("{}: {heading}: no {begins:?}", self.name))
    }

    /// Compares the first number of a cell with one computed anew.
    fn compare(&self, what: &str, cell: &str, found: f64) {
        if let Err(reason) = equal_as_printed(cell, found) {
            let name = self.name;
            panic!(
                "docs/measured/{name}.md: {what}: {reason}\n\
                 hint: if the change is meant, `cargo xtask measured {name}` writes the page again"
            );
        }
    }
}

/// Whether a number has the printed digits; what follows the first number of the text is not read.
fn equal_as_printed(text: &str, found: f64) -> Result<(), String> {
    let end = text.find(|c: char| !(c.is_ascii_digit() || ".-+e".contains(c))).unwrap_or(text.len());
    let printed = &text[..end];
    let value: f64 = printed.parse().map_err(|_| format!("`{text}` begins with no number"))?;
    let (mantissa, exponent) = printed.split_once('e').unwrap_or((printed, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let last_digit = 10.0_f64.powi(exponent.parse::<i32>().unwrap() - i32::try_from(decimals).unwrap());
    // Half a digit, and what the number loses when it is read.
    let is_equal = (found - value).abs() <= 0.5 * last_digit + 1e-12 * value.abs();
    if is_equal { Ok(()) } else { Err(format!("the page has {printed}, computed anew it is {found}")) }
}

/// Mean of a figure over feet.
fn mean(feet: &[Value], figure: impl Fn(&Value) -> f64) -> f64 {
    feet.iter().map(figure).sum::<f64>() / feet.len() as f64
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// Predicts the forces of a trial and returns the comparison with its plates, foot by foot.
fn feet_of(bench: &Workbench, data: &Path, trial: &Trial) -> Vec<Value> {
    let path = |name: &str| data.join(trial.folder).join(name).display().to_string();
    let (recording, standing) = (path(trial.recording), trial.standing.map(path));
    let mut words = vec!["forces", &recording, "--predict", "--keep", "summary", "--json", "-o", "out"];
    words.extend(standing.iter().flat_map(|standing| ["--static", standing]));
    words.extend(trial.mass.iter().flat_map(|mass| ["--mass", mass]));
    let run = bench.run(&words).done();
    let summary: Value = serde_json::from_str(&run.stdout).unwrap();
    summary["comparison"]["feet"].as_array().unwrap().clone()
}

/// Components of the force as the pages name them, with their keys.
const COMPONENTS: [(&str, &str); 3] = [("vertical", "vertical"), ("fore-aft", "fore_aft"), ("lateral", "lateral")];

fn compare_with_validation(page: &MeasuredPage, name: &str, feet: &[Value]) -> usize {
    let mut compared = 0;
    for foot in feet {
        let side = foot["side"].as_str().unwrap();
        let heading = "## Forces of each foot";
        let kind = page.row(heading, &[name])[1];
        for (component, key) in COMPONENTS {
            let stances = foot["stances_s"].as_array().unwrap().len().to_string();
            let row = page.row(heading, &[name, kind, side, &stances, component]);
            let error = &foot[key];
            let found = [
                100.0 * number(&error["rmse_bw"]),
                100.0 * number(&error["rrmse"]),
                number(&error["r"]),
                100.0 * number(&error["band"]["holds"]),
                number(&error["band"]["half_width_over_rmse"]),
            ];
            for (cell, found) in row[5..].iter().zip(found) {
                page.compare(&format!("{name}, foot {side}, {component}"), cell, found);
                compared += 1;
            }
        }
    }
    compared
}

fn compare_with_fit(page: &MeasuredPage, subject: &str, feet: &[Value]) {
    let of_forces = COMPONENTS.iter().flat_map(|(_, key)| {
        let of = |figure: &'static str, factor: f64| mean(feet, |foot| factor * number(&foot[key][figure]));
        [of("rmse_bw", 100.0), of("rrmse", 100.0), of("r", 1.0)]
    });
    let centres = ["fore_aft_weighted_mm", "lateral_weighted_mm"];
    let centres = centres.map(|key| mean(feet, |foot| number(&foot["center_of_pressure"][key])));
    let found: Vec<f64> = of_forces.chain(centres).collect();
    let row = page.row("## Figures of straight walks", &[subject, "own"]);
    assert_eq!(row.len(), 2 + found.len());
    for (cell, found) in row[2..].iter().zip(found) {
        page.compare(&format!("figures of {subject}"), cell, found);
    }
}

#[test]
fn predicted_forces_have_the_errors_of_the_pages() {
    let Some(data) = shared_data::data() else { return };
    let bench = Workbench::empty("measured_pages_forces");
    let (validation, fit) = (MeasuredPage::read("VALIDATION"), MeasuredPage::read("GROUND_FIT"));
    let mut compared = 0;
    for trial in &TRIALS {
        let feet = feet_of(&bench, &data, trial);
        compared += compare_with_validation(&validation, trial.name, &feet);
        if let Some(subject) = trial.subject {
            compare_with_fit(&fit, subject, &feet);
        }
    }
    assert!(compared >= 280, "{compared}");
}

/// The run of OpenSim: fits of mean errors, which leave laboratories out, do not change runs.
#[test]
fn predicted_forces_of_a_laboratory_have_the_errors_of_the_page() {
    let Some(data) = shared_data::data() else { return };
    let bench = Workbench::empty("measured_pages_people");
    let path = |name: &str| data.join("opensim-rajagopal-run").join(name).display().to_string();
    let (markers, standing, plates) = (path("motion_capture_run.trc"), path("static_run.trc"), path("grf_run.mot"));
    let size = ["--static", &standing, "--mass", "72.84", "--height", "1.8"];
    let sides = ["--grf", &plates, "--right", "calcn_r:R_ground_force_", "--left", "calcn_l:L_ground_force_"];
    let output = ["--predict", "--keep", "summary", "--json", "-o", "out"];
    let run = bench.run(&[&["forces", markers.as_str()][..], &size, &sides, &output].concat());
    let summary: Value = serde_json::from_str(&run.done().stdout).unwrap();
    let feet = summary["comparison"]["feet"].as_array().unwrap();
    let of = |key: &str, figure: &str, factor: f64| mean(feet, |foot| factor * number(&foot[key][figure]));
    let errors = COMPONENTS.iter().flat_map(|(_, key)| [of(key, "rmse_bw", 100.0), of(key, "r", 1.0)]);
    let centres = ["fore_aft_weighted_mm", "lateral_weighted_mm"].map(|figure| of("center_of_pressure", figure, 1.0));
    let page = MeasuredPage::read("PEOPLE");
    let row = page.row("## The same, by laboratory", &["OpenSim, run", "runners", "running"]);
    for (cell, found) in row[5..].iter().zip(errors.chain(centres)) {
        page.compare("OpenSim, run", cell, found);
    }
}

/// The curves of the mean errors and the floors of the deviations are those that the fit has found.
#[test]
fn the_fitted_curves_are_those_of_the_page() {
    let page = MeasuredPage::read("GROUND_FIT");
    let FittedParameters { errors, calibration, .. } = FittedParameters::default();
    let row = page.row("## Mean errors that are taken off", &["0.10"]);
    let curves = [&errors.usual.force[1], &errors.changes[1][0], &errors.changes[1][1], &errors.usual.force[0]];
    for (cell, curve) in row[1..].iter().step_by(2).zip(curves) {
        page.compare("mean error at a tenth of the stance", cell, 100.0 * curve.at(0.1));
    }
    for (component, fifths) in ["force forward", "force up", "force sideways"].iter().zip(&calibration.force) {
        let row = page.row("## Standard deviations: factor and floor", &[component, "0.1"]);
        page.compare(component, row[3], fifths[0].factor);
        page.compare(component, row[4], fifths[0].floor);
    }
}

#[test]
fn the_fitted_numbers_are_those_of_the_page() {
    let page = MeasuredPage::read("GROUND_FIT");
    let fitted = FittedParameters::default();
    for (name, value) in [
        ("bandwidth_hz", fitted.bandwidth_hz),
        ("force_noise up", fitted.force_noise[1]),
        ("moment_noise about sideways", fitted.moment_noise[2]),
        ("spread forward", fitted.spread[0]),
        ("sideways_lever", fitted.sideways_lever),
        ("strike_push", fitted.strike_push),
        ("detail up", fitted.detail[1]),
        ("center_spread along", fitted.center_spread[0]),
        ("center_outwards", fitted.center_outwards),
    ] {
        let row = page.row("## Numbers: range, fit", &[name]);
        page.compare(name, row[5], value);
    }
}

/// Largest value of a column, times a factor.
fn peak(table: &Table, column: &str, factor: f64) -> f64 {
    table.column(column).unwrap().iter().map(|value| factor * value).fold(f64::NEG_INFINITY, f64::max)
}

#[test]
fn a_corrected_walk_has_the_peaks_of_the_page() {
    let bench = Workbench::empty("measured_pages_corrected");
    let walk = ["walk", "--mode", "corrected", "--cycles", "5", "--keep", "moments,grf", "--json", "-o", "out"];
    let summary: Value = serde_json::from_str(&bench.run(&walk).done().stdout).unwrap();
    let (moments, forces) = (bench.table("out/moments.sto"), bench.table("out/grf.mot"));
    let (kg, weight) = (75.0, 75.0 * 9.80665);
    let page = MeasuredPage::read("WALK_BANDS");
    for (row, found) in [
        ("hip extension moment [N.m/kg]", peak(&moments, "hip_flexion_r_moment", -1.0 / kg)),
        ("hip flexion moment [N.m/kg]", peak(&moments, "hip_flexion_r_moment", 1.0 / kg)),
        ("knee extension moment [N.m/kg]", peak(&moments, "knee_angle_r_moment", 1.0 / kg)),
        ("ankle plantarflexion moment [N.m/kg]", peak(&moments, "ankle_angle_r_moment", -1.0 / kg)),
        ("vertical force, first peak [BW]", peak(&forces, "ground_force_r_vy", 1.0 / weight)),
        ("braking [BW]", -peak(&forces, "ground_force_r_vx", -1.0 / weight)),
        ("propulsion [BW]", peak(&forces, "ground_force_r_vx", 1.0 / weight)),
    ] {
        page.compare(row, page.row("## Peaks against speed", &[row])[3], found);
    }
    let held = &summary["walk"]["trunk_torque_nm"];
    for (row, key) in [("RMS", "rms"), ("largest", "largest")] {
        let row = format!("torque that holds the trunk, {row}");
        page.compare(&row, page.row("## Free walking", &[&row])[2], number(&held[key]));
    }
}

#[test]
fn optimal_walks_have_slip_and_knees_of_the_page() {
    let bench = Workbench::empty("measured_pages_optimal");
    let page = MeasuredPage::read("OPTIMAL_WALK");
    for (gait, column) in [("slow", 3), ("free", 4), ("fast", 5)] {
        let walk = ["walk", "--gait", gait, "--keep", "kinematics", "--json", "-o", gait];
        let summary: Value = serde_json::from_str(&bench.run(&walk).done().stdout).unwrap();
        let angles = bench.table(&format!("{gait}/kinematics.mot"));
        let heading = "## Five speeds";
        let knee = -peak(&angles, "knee_angle_r", 1.0);
        for (row, found) in [
            ("slip of a stance [mm]", number(&summary["walk"]["foot_slip_mm"])),
            ("smallest flexion of the knee [deg]", knee),
        ] {
            page.compare(&format!("{gait}, {row}"), page.row(heading, &[row])[column], found);
        }
    }
}

#[test]
fn harmonics_keep_the_share_of_the_torques_that_the_page_has() {
    let man = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
    let human = man.human().unwrap();
    let mut gait = Gait::named("free").unwrap();
    gait.pace.speed = Some(Speed::MetersPerSecond(1.25));
    let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).unwrap();
    let walk = make_consistent_walk(&human, &walk, &ConsistentWalkSettings::default()).unwrap();
    let plan = walk.solution();
    let phases: Vec<f64> = (0..1000).map(|k| f64::from(k) / 1000.0).collect();
    let times: Vec<f64> = phases.iter().map(|phase| plan.cycle_s() * phase).collect();
    let samples = plan.samples(&times).unwrap();
    let page = MeasuredPage::read("PHYSICAL_WALK");
    for count in [1, 3, 6, 12] {
        let row = page.row("## How many parameters", &[&count.to_string()]);
        for (cell, name) in row[1..].iter().zip(["hip_flexion_r", "knee_angle_r", "ankle_angle_r"]) {
            let c = human.model.coordinate(name).unwrap().index();
            let torques: Vec<f64> = samples.iter().map(|sample| sample.forces[c]).collect();
            let share = Harmonics::of(&phases, &torques, count).r_squared(&phases, &torques);
            page.compare(&format!("{count} harmonics, {name}"), cell, share);
        }
    }
}

/// Compares the rows of `claims.json` with the table of REPRODUCTION; the clock of the machine is left out.
pub(crate) fn claims_are_those_of_the_page(rows: &[Value]) {
    let page = MeasuredPage::read("REPRODUCTION");
    for row in rows.iter().filter(|row| row["id"] != "k") {
        let (id, headline) = (row["id"].as_str().unwrap(), row["headline"].as_str().unwrap());
        let printed = page.row("# The claims", &[id]);
        assert_eq!(printed[2] == "holds", row["pass"].as_bool().unwrap(), "{id}");
        assert!(printed[3].ends_with(&format!("`{headline}`")), "{id}: {} is not {headline}", printed[3]);
        for (cell, mode) in [(printed[3], "paper_mode"), (printed[4], "corrected")] {
            page.compare(&format!("claim {id}, {mode}"), cell, number(&row[mode][headline]));
        }
    }
}

#[test]
fn a_number_that_moved_in_its_last_digit_is_found() {
    for (printed, equal, moved) in [
        ("3.20", 3.2029, 3.206),
        ("-0.17", -0.1731, -0.176),
        ("1.05 N.m", 1.0525, 1.056),
        ("0.74 (0.91)", 0.7394, 0.734),
        ("3.561e-4", 3.5612e-4, 3.562e-4),
        ("200", 199.6, 201.0),
    ] {
        assert_eq!(equal_as_printed(printed, equal), Ok(()));
        assert!(equal_as_printed(printed, moved).is_err(), "{printed}");
    }
    assert!(equal_as_printed("met", 1.0).is_err());
    let page = MeasuredPage::read("GROUND_FIT");
    let printed = page.row("## Numbers: range, fit", &["sideways_lever"])[5];
    let spoiled = MeasuredPage { text: page.text.replace(printed, "0.628"), ..page };
    let found = std::panic::catch_unwind(|| {
        let row = spoiled.row("## Numbers: range, fit", &["sideways_lever"]);
        spoiled.compare("sideways_lever", row[5], FittedParameters::default().sideways_lever);
    });
    assert!(found.is_err());
}
