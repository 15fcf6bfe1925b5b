//! Recorded walks made to agree with what plates measured: what remains at the root, and what had to be changed.
//!
//! The recordings are not part of the repository; docs/CONSISTENCY.md has the table that this prints with `--nocapture`.

#![allow(clippy::unwrap_used, reason = "a test may stop where a recording cannot be used")]
#![allow(clippy::print_stdout, reason = "the figures are shown with --nocapture")]

mod gait_files;
mod marker_data;

use ambulo::analysis::{Analysis, Body, LaboratoryRecording, Settings, analyse, body_in_motion};
use ambulo::dynamics::consistency::{ConsistencySettings, Consistent, make_consistent};
use ambulo::findings::Findings;
use ambulo::kinematics::marker_fit::{FitSettings, fit_markers};
use ambulo::model::Model;
use ambulo::motion::filter::LowPass;
use ambulo::motion::{
    ForceRecording, Motion, PlateSettings, Smoother, Window, coordinates_from_table, force_recordings,
    markers_from_c3d, plates_from_c3d,
};
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use gait_files::{adult, child, woman};
use marker_data::{gait2392, rajagopal};

/// A recorded walk, and when plates saw every foot on the ground.
struct Case {
    name: &'static str,
    model: Model,
    analysis: Analysis,
    window: Window,
}

fn case(name: &'static str, model: Model, motion: &Motion, plates: &[ForceRecording], [from, to]: [f64; 2]) -> Case {
    let filter = LowPass { order: 3, cutoff_hz: 6.0 };
    let settings = Settings {
        smoother: Smoother::Butterworth(filter),
        force_filter: Some(filter),
        window: Window::default(),
        rate_hz: None,
        instrumented: None,
    };
    let analysis = analyse(&model, motion, plates, settings, &mut Findings::default(), &mut |_| ()).unwrap();
    Case { name, model, analysis, window: Window { from_s: Some(from), to_s: Some(to) } }
}

fn of_trc(name: &'static str, subject: &marker_data::Subject, window: [f64; 2]) -> Case {
    let mut findings = Findings::default();
    let fit = fit_markers(&subject.model, &subject.markers, &FitSettings::default(), &mut findings).unwrap();
    case(name, subject.model.clone(), &fit.motion, &subject.plates, window)
}

/// OpenSim's own angles, and forces that cover all of them.
fn of_given_angles(name: &'static str, model: &Model, window: [f64; 2]) -> Case {
    let folder = gait_files::folder().unwrap().join("opensim-gait2392-subject01");
    let mut findings = Findings::default();
    let angles = marker_data::table(&folder.join("subject01_walk1_ik.mot"));
    let motion = coordinates_from_table(model, &angles, name, &mut findings).unwrap();
    let feet = [("calcn_r", "ground_force_"), ("calcn_l", "l_ground_force_")];
    let forces = feet.map(|(body, prefix)| ExternalForce::with_prefix(body, body, prefix)).to_vec();
    let loads = ExternalLoads { name: "feet".into(), datafile: None, forces };
    let table = marker_data::table(&folder.join("core-id-test/subject01_walk1_grf.mot"));
    let plates = force_recordings(model, &loads, &table, &mut findings).unwrap();
    case(name, model.clone(), &motion, &plates, window)
}

fn of_c3d(name: &'static str, subject: &gait_files::Subject, window: [f64; 2]) -> Case {
    let mut findings = Findings::default();
    let mut recording = |file: &gait_files::File| LaboratoryRecording {
        markers: markers_from_c3d(&file.c3d, &mut findings).unwrap(),
        plates: plates_from_c3d(&file.c3d, PlateSettings::default(), &mut findings).unwrap_or_default(),
        unit: file.c3d.point_unit.clone(),
    };
    let (still, walk) = (recording(&subject.standing), recording(&subject.walk));
    let body = Body::BuiltIn { person: &subject.person, set: None };
    let settings = FitSettings::default();
    let body = body_in_motion(&walk, Some(&still), &body, &settings, &[], &mut findings, &mut |_| ()).unwrap();
    case(name, body.subject.model.clone(), &body.fit.motion, &body.plate_forces(), window)
}

/// Every walk of which plates saw all feet; windows as the data's own page states them, a tenth of a second from the ends of a
/// recording, where filters have nothing to lean on.
fn cases() -> Vec<Case> {
    let mut list = Vec::new();
    if let Some(subject) = gait2392() {
        list.push(of_trc("gait2392, markers", &subject, [0.1, 2.4]));
        list.push(of_given_angles("gait2392, given angles", &subject.model, [0.6, 3.9]));
    }
    if let Some(subject) = rajagopal() {
        list.push(of_trc("rajagopal walk", &subject, [0.45, 1.80]));
    }
    let c3d =
        [(woman(), "HC032A03", [1.79, 2.72]), (child(), "HC002D06", [1.87, 2.74]), (adult(), "PiG", [7.97, 9.46])];
    for (subject, name, window) in c3d {
        list.extend(subject.map(|subject| of_c3d(name, &subject, window)));
    }
    list
}

fn consistent(case: &Case, settings: ConsistencySettings) -> Consistent {
    let settings = ConsistencySettings { within: case.window, ..settings };
    let loads = case.analysis.ground.loads();
    make_consistent(&case.model, &case.analysis.trajectory, &loads, &settings, &mut Findings::default()).unwrap()
}

fn print_row(case: &Case, done: &Consistent) {
    let (before, after) = (done.residual_before, done.residual_after);
    let mut angles: Vec<_> = done.changes.iter().filter(|c| c.unit == "rad").collect();
    angles.sort_by(|a, b| b.max.total_cmp(&a.max));
    let shown: Vec<String> = angles
        .iter()
        .take(4)
        .map(|c| format!("{} {:.2}/{:.2}", c.name, c.rms.to_degrees(), c.max.to_degrees()))
        .collect();
    let root = done.changes.iter().filter(|c| c.unit == "m").map(|c| 1e3 * c.max).fold(0.0, f64::max);
    let foot = done.feet.iter().map(|f| 1e3 * f.max_m).fold(0.0, f64::max);
    println!(
        "{:<28} {:5.2} {:5.2} %BW {:6.1} {:5.1} N.m -> {:5.2} {:5.2} %BW {:5.2} {:5.2} N.m, {} it{} | {} | pelvis {root:.1} mm, feet {foot:.1} mm | mass {:.2} %, trunk {:.0} {:.0} {:.0} mm",
        case.name,
        100.0 * before.force_rms_bw,
        100.0 * before.force_peak_bw,
        before.moment_rms_nm,
        before.moment_peak_nm,
        100.0 * after.force_rms_bw,
        100.0 * after.force_peak_bw,
        after.moment_rms_nm,
        after.moment_peak_nm,
        done.iterations,
        if done.converged { "" } else { "!" },
        shown.join(", "),
        100.0 * done.body.mass_share,
        1e3 * done.body.trunk_center_m.x,
        1e3 * done.body.trunk_center_m.y,
        1e3 * done.body.trunk_center_m.z
    );
}

#[test]
fn table() {
    for body in [false, true] {
        for hz in [6.0] {
            println!("body {body} {hz} Hz");
            for case in cases() {
                let settings = ConsistencySettings {
                    adjust_mass: body,
                    adjust_trunk_center: body,
                    bandwidth_hz: hz,
                    ..ConsistencySettings::default()
                };
                let t = std::time::Instant::now();
                let done = consistent(&case, settings);
                print_row(&case, &done);
                let g = case.analysis.trajectory.grid();
                let id = case.model.coordinate("lumbar_rotation").unwrap();
                let (a, b) = (case.analysis.trajectory.values(id), done.trajectory.values(id));
                let d: Vec<String> = (0..g.frames)
                    .step_by(g.frames / 20)
                    .map(|i| format!("{:.2}:{:.2}", g.time(i), (b[i] - a[i]).to_degrees()))
                    .collect();
                println!("    {}", d.join(" "));
                println!("    {:.2} s", t.elapsed().as_secs_f64());
            }
        }
    }
}
