//! Muscles on the report page: activations, electromyograms, joint contact loads and reserves, from made files.

use crate::report_pages::{Files, Shown, page_of, recorded, with_summary};
use ambulo::muscles::emg::{AnatomicalMuscle, normal_timing};
use ambulo_formats::table::Table;
use ambulo_report::page::report_page;
use ambulo_results::Folder;
use serde_json::{Value, json};
use std::f64::consts::PI;

/// Body weight [N].
fn weight_n(files: &Files) -> f64 {
    let summary: Value = serde_json::from_slice(&files["summary.json"]).unwrap();
    summary["mass_kg"].as_f64().unwrap() * 9.80665
}

/// A table at the instants of the recording.
fn table(files: &Files, columns: &[(&str, &dyn Fn(f64) -> f64)]) -> Vec<u8> {
    let times = Table::read_storage(&files["kinematics.mot"]).unwrap().0.times().unwrap().to_vec();
    let column = |(name, value): &(&str, &dyn Fn(f64) -> f64)| {
        ((*name).to_owned(), times.iter().map(|time| value(*time)).collect::<Vec<f64>>())
    };
    let all = std::iter::once(("time".to_owned(), times.clone())).chain(columns.iter().map(column)).collect();
    Table::new("made", all).unwrap().write_storage()
}

fn slow(time_s: f64) -> f64 {
    0.4 + 0.3 * (2.0 * PI * time_s).sin()
}

fn fast(time_s: f64) -> f64 {
    0.5 + 0.2 * (9.0 * PI * time_s).cos()
}

/// The recorded walk with muscles: two vasti and a soleus on the right, loads of the right knee and ankle.
fn with_muscles() -> Files {
    let mut files = recorded();
    let constant = |value: f64| move |_: f64| value;
    let muscles = table(
        &files,
        &[
            ("vas_med_r_activation", &slow),
            ("vas_lat_r_activation", &fast),
            ("soleus_r_activation", &constant(1.0)),
            ("soleus_r_force", &constant(900.0)),
            ("ercspn_r_activation", &slow),
            ("knee_angle_r_reserve", &|time_s| 3.0 * (PI * time_s).sin()),
            ("ankle_angle_r_reserve", &constant(-0.5)),
            ("pelvis_tx_reserve", &constant(40.0)),
        ],
    );
    // 3, 4 and 12 times 200 N: 2600 N, with y along the shank.
    let contact = table(
        &files,
        &[
            ("knee_r_on_tibia_r_in_tibia_r_fx", &constant(600.0)),
            ("knee_r_on_tibia_r_in_tibia_r_fy", &constant(-2400.0)),
            ("knee_r_on_tibia_r_in_tibia_r_fz", &constant(800.0)),
            ("knee_r_medial", &constant(1800.0)),
            ("knee_r_lateral", &constant(600.0)),
            ("ankle_r_on_calcn_r_in_calcn_r_fx", &constant(0.0)),
            ("ankle_r_on_calcn_r_in_calcn_r_fy", &constant(-3000.0)),
            ("ankle_r_on_calcn_r_in_calcn_r_fz", &constant(0.0)),
        ],
    );
    let emg = table(&files, &[("vastus_medialis_r_emg", &|time_s| slow(time_s) / 2.0)]);
    files.insert("muscles.sto".to_owned(), muscles);
    files.insert("reactions_contact.sto".to_owned(), contact);
    files.insert("emg.sto".to_owned(), emg);
    with_summary(&mut files, |summary| summary["muscles"] = muscles_summary());
    files
}

/// The part of the summary: loads of the right knee, a reserve, an electromyogram.
fn muscles_summary() -> Value {
    let load = |quantity: &str, unit: &str, mean: f64| {
        json!({"quantity": quantity, "unit": unit, "right": {"mean": mean, "sd": 0.1, "strides": 2,
            "source": "measured"},
            "left": null, "both": null, "symmetry": null})
    };
    json!({"source": "built-in", "muscles": 80, "unmet_frames": 0, "condyles_m": 0.042,
        "largest_reserve": {"coordinate": "knee_angle_r", "unit": "N.m", "largest": 3.0, "at_s": 0.5, "share": 0.052},
        "contact_loads": [load("knee_first_peak", "BW", 3.68), load("knee_medial_impulse", "BW.s", 1.5),
            load("knee_lateral_impulse", "BW.s", 0.5)],
        "emg": [{"channel": "VM", "muscle": "vastus medialis", "side": "r", "model_muscles": ["vas_med_r"], "r": 0.874},
            {"channel": "SO", "muscle": "soleus", "side": "r", "model_muscles": ["soleus_r"], "r": null}]})
}

fn trace(shown: &Shown, panel: &str, role: &str) -> Vec<f64> {
    let traces = shown.panel(panel)["traces"].as_array().unwrap();
    let found = traces.iter().find(|trace| trace["role"] == role && trace["side"] == "r");
    shown.series(&found.unwrap_or_else(|| panic!("no {role} trace in {panel}"))["values"])
}

fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "found {found}, expected {expected}");
}

/// Half a step of 16 bits over a range of one.
const STEP: f64 = 1e-5;

#[test]
fn a_panel_is_the_mean_of_its_muscles_with_the_electromyogram_beside_it() {
    let shown = Shown::of(&with_muscles());
    let times = Table::read_storage(&with_muscles()["kinematics.mot"]).unwrap().0.times().unwrap().to_vec();
    let (computed, measured) =
        (trace(&shown, "vasti_activation", "main"), trace(&shown, "vasti_activation", "measured"));
    for (i, time) in times.iter().enumerate() {
        near(computed[i], f64::midpoint(slow(*time), fast(*time)), STEP);
        near(measured[i], slow(*time) / 2.0, STEP);
    }
    assert!(computed.iter().zip(&times).any(|(value, time)| (value - slow(*time)).abs() > 0.1), "not one muscle alone");
    let activity = &shown.panel("vasti_activation")["activity"];
    assert_eq!(activity["agreement"], "r with the electromyogram: right vastus medialis 0.87");
    assert_eq!(activity["measured"].as_array().unwrap().len(), 1, "a mean over the right cycles");
    let soleus = shown.panel("soleus_activation");
    assert_eq!(soleus["traces"][0]["origin"]["column"], "soleus_r_activation");
    assert_eq!(soleus["activity"]["agreement"], "r with the electromyogram: right -", "r of a constant is not known");
    assert!(!soleus["cycles"].as_array().unwrap().is_empty());
    let is_known = |id: &str| shown.panels().iter().any(|panel| panel["id"] == id);
    assert!(!is_known("hamstrings_activation"), "the model has none");
}

#[test]
fn curves_over_the_cycle_are_cut_at_the_strikes() {
    let shown = Shown::of(&with_muscles());
    let cycle = shown.session()["cycles"].as_array().unwrap().iter().find(|cycle| cycle["side"] == "r").unwrap();
    let at = |key: &str| cycle[key].as_f64().unwrap();
    let curves = shown.panel("vasti_activation")["cycles"].as_array().unwrap().clone();
    let curve = curves.iter().find(|curve| curve["number"] == cycle["number"] && curve["side"] == "r").unwrap();
    assert!(curve["origin"].is_null(), "a mean of two columns has no column");
    for (k, value) in shown.series(&curve["values"]).iter().enumerate() {
        let time = at("start_s") + (at("end_s") - at("start_s")) * k as f64 / 100.0;
        // Linear between samples 10 ms apart: (9 pi)^2 / 8 x 0.2 x 0.01^2 for the faster of both.
        near(*value, f64::midpoint(slow(time), fast(time)), 2e-3);
    }
}

#[test]
fn contact_loads_are_in_body_weights_along_the_bone() {
    let files = with_muscles();
    let (shown, weight_n) = (Shown::of(&files), weight_n(&files));
    near(trace(&shown, "knee_contact", "main")[7], 2600.0 / weight_n, STEP);
    // The shank of this figure is along y.
    near(trace(&shown, "knee_compression", "main")[7], 2400.0 / weight_n, STEP);
    near(trace(&shown, "ankle_compression", "main")[7], 3000.0 / weight_n, 1e-3);
    near(trace(&shown, "knee_medial", "main")[7], 1800.0 / weight_n, STEP);
    let is_known = |id: &str| shown.panels().iter().any(|panel| panel["id"] == id);
    assert!(!is_known("hip_contact") && is_known("knee_lateral"));
    let group = shown.session()["groups"].as_array().unwrap().iter().find(|group| group["id"] == "contact").unwrap();
    assert!(group["note"].as_str().unwrap().contains("by the frontal moment over 42 mm."), "{group}");
}

#[test]
fn peaks_and_impulses_of_contact_loads_are_those_of_the_summary() {
    let shown = Shown::of(&with_muscles());
    assert_eq!(shown.row("contact_loads", "knee first peak")[1..], ["BW", "3.68 ± 0.10", "-", "-", "measured"]);
    assert_eq!(shown.row("contact_loads", "knee medial impulse")[1..3], ["BW.s", "1.50 ± 0.10"]);
    near(shown.value("contact_loads", "knee medial share of the impulse", 2), 75.0, 1e-9);
}

#[test]
fn the_largest_reserve_is_judged() {
    let mut files = with_muscles();
    let shown = Shown::of(&files);
    let fact = |shown: &Shown, label: &str| {
        let facts = shown.session()["quality"]["facts"].as_array().unwrap();
        let fact = facts.iter().find(|fact| fact["label"] == label).unwrap();
        (fact["value"].as_str().unwrap().to_owned(), fact["good"].as_bool())
    };
    let expected = "3.0 N.m at knee_angle_r, 0.50 s, 5 % of the largest moment there".to_owned();
    assert_eq!(fact(&shown, "Largest reserve of the muscles"), (expected, Some(true)));
    assert_eq!(fact(&shown, "Muscles").0, "80, the built-in set");
    assert_eq!(fact(&shown, "Muscles that reach full activation").0, "1 of 4 (soleus_r)");
    assert_eq!(shown.row("reserves", "pelvis_tx")[1..4], ["40.00", "N", "0.00"]);
    let moments = Table::read_storage(&files["moments.sto"]).unwrap().0;
    let peak = moments.column("knee_angle_r_moment").unwrap().iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    near(shown.value("reserves", "knee_angle_r", 4), 300.0 / peak, 0.01);
    with_summary(&mut files, |summary| summary["muscles"]["largest_reserve"]["share"] = json!(0.2));
    assert_eq!(fact(&Shown::of(&files), "Largest reserve of the muscles").1, Some(false));
    files.insert("muscles.sto".to_owned(), table(&files, &[("knee_angle_r_reserve", &|_| 30.0)]));
    assert!(Shown::of(&files).misses("No panels of muscles"));
}

#[test]
fn a_folder_without_muscles_has_the_same_page() {
    let mut files = with_muscles();
    let without = page_of("folder", &recorded()).unwrap();
    assert_ne!(page_of("folder", &files).unwrap(), without);
    for name in ["muscles.sto", "reactions_contact.sto", "emg.sto"] {
        files.remove(name);
    }
    files.insert("summary.json".to_owned(), recorded()["summary.json"].clone());
    assert_eq!(page_of("folder", &files).unwrap(), without);
    let (_, data) = without.split_once("id=\"ambulo-page\">").unwrap();
    let data = data.split_once("</script>").unwrap().0;
    for word in ["activity", "muscles", "contact_loads", "reserves"] {
        assert!(!data.contains(&format!("\"{word}\"")), "{word}");
    }
}

#[test]
fn missing_and_malformed_files_of_muscles_are_reported() {
    let mut files = with_muscles();
    files.remove("reactions_contact.sto");
    assert!(Shown::of(&files).misses("No joint contact loads: the folder has no reactions_contact.sto"));
    let other = table(&files, &[("elbow_r_on_ulna_r_in_ulna_r_fx", &|_| 1.0)]);
    files.insert("reactions_contact.sto".to_owned(), other);
    assert!(Shown::of(&files).misses("has no columns of the hips, knees and ankles"));
    let short = Table::new("short", vec![("time".to_owned(), vec![0.0, 0.01]), ("a".to_owned(), vec![1.0, 2.0])]);
    files.insert("muscles.sto".to_owned(), short.unwrap().write_storage());
    let error = page_of("folder", &files).unwrap_err().to_string();
    assert!(error.contains("folder/muscles.sto: 2 rows; expected 291"), "{error}");
}

#[test]
fn a_run_with_muscles_is_compared_with_one_without() {
    let (with, without) = (with_muscles(), recorded());
    let (first, second) = (|name: &str| without.get(name).cloned(), |name: &str| with.get(name).cloned());
    let folders = [Folder::of_files("before", &first), Folder::of_files("after", &second)];
    let shown = Shown::read(&report_page(&folders).unwrap());
    let groups = |session: usize| {
        let groups = shown.page["sessions"][session]["groups"].as_array().unwrap();
        groups.iter().map(|group| group["id"].as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    assert!(!groups(0).contains(&"muscles".to_owned()) && groups(1).contains(&"muscles".to_owned()));
    assert!(groups(1).contains(&"contact".to_owned()));
}

/// A soleus from shank to foot with a point that comes and goes and one that moves by 1 mm per radian from 2 mm.
const SOLEUS: &str = "<ForceSet><objects><Thelen2003Muscle name=\"soleus_r\">\
    <max_isometric_force>3000</max_isometric_force><optimal_fiber_length>0.05</optimal_fiber_length>\
    <tendon_slack_length>0.25</tendon_slack_length><GeometryPath><PathPointSet><objects>\
    <PathPoint name=\"a\"><socket_parent_frame>/bodyset/tibia_r</socket_parent_frame>\
    <location>-0.01 -0.15 0</location></PathPoint>\
    <ConditionalPathPoint name=\"b\"><socket_parent_frame>/bodyset/tibia_r</socket_parent_frame>\
    <location>-0.02 -0.3 0</location><socket_coordinate>/jointset/knee_r/knee_angle_r</socket_coordinate>\
    <range>-9 -8</range></ConditionalPathPoint>\
    <MovingPathPoint name=\"c\"><socket_parent_frame>/bodyset/calcn_r</socket_parent_frame>\
    <socket_x_coordinate>/jointset/knee_r/knee_angle_r</socket_x_coordinate>\
    <x_location><LinearFunction><coefficients>0.001 0.002</coefficients></LinearFunction></x_location>\
    <y_location><Constant><value>-0.03</value></Constant></y_location>\
    <z_location><Constant><value>0.004</value></Constant></z_location></MovingPathPoint>\
    </objects></PathPointSet></GeometryPath></Thelen2003Muscle></objects></ForceSet></Model>";

#[test]
fn the_figure_draws_muscles_through_the_points_of_their_bodies() {
    let mut files = with_muscles();
    assert!(Shown::of(&files).misses("No muscles in the figure: subject.osim"));
    let body = String::from_utf8(files["subject.osim"].clone()).unwrap().replace("</Model>", SOLEUS);
    files.insert("subject.osim".to_owned(), body.into_bytes());
    let shown = Shown::of(&files);
    let view = &shown.session()["view"];
    let [muscle] = &view["muscles"].as_array().unwrap()[..] else { panic!("{}", view["muscles"]) };
    assert_eq!((muscle["name"].as_str(), muscle["side"].as_str()), (Some("soleus_r"), Some("r")));
    assert!(shown.series(&muscle["activation"]).iter().all(|activation| (activation - 1.0).abs() < STEP));
    let name = |point: &Value| view["bodies"][point["body"].as_u64().unwrap() as usize]["name"].clone();
    let points = muscle["points"].as_array().unwrap();
    assert_eq!(points.iter().map(name).collect::<Vec<_>>(), ["tibia_r", "tibia_r", "calcn_r"]);
    assert_eq!(points[1]["place"], json!([-0.02, -0.3, 0.0]), "a point that comes and goes is always drawn");
    let moving = points[2]["place"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect::<Vec<_>>();
    assert!(moving.iter().zip([0.002, -0.03, 0.004]).all(|(x, expected)| (x - expected).abs() < 1e-9), "{moving:?}");
    assert!(!shown.misses("No muscles in the figure"));
}

#[test]
fn usual_times_of_activity_are_those_of_the_table() {
    let mut files = with_muscles();
    let muscles = table(&files, &[("tib_ant_r_activation", &slow), ("psoas_r_activation", &slow)]);
    files.insert("muscles.sto".to_owned(), muscles);
    let shown = Shown::of(&files);
    let on = normal_timing(AnatomicalMuscle::TibialisAnterior).unwrap().is_on(0.5);
    let drawn = &shown.panel("tibialis_anterior_activation")["activity"]["usual"];
    let times: Vec<[f64; 2]> = serde_json::from_value(drawn.clone()).unwrap_or_default();
    let is_drawn = |percent: f64| times.iter().any(|[from, to]| (*from..*to).contains(&percent));
    assert_eq!(on.len(), 100, "percents of the cycle");
    assert!(on.iter().enumerate().all(|(k, on)| is_drawn(k as f64 + 0.5) == *on), "{times:?}");
    assert!(on.iter().any(|on| *on) && !on.iter().all(|on| *on));
    assert!(shown.panel("hip_flexors_activation")["activity"].is_null(), "nobody measured the psoas");
}
