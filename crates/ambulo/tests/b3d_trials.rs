//! Trials of AddBiomechanics subjects, made from a recorded walk: the same results as from tables, missing ground
//! forces, the order of coordinates, and refusals.

use crate::shared_data;
use ambulo::findings::{Code, Findings};
use ambulo::ground::measured;
use ambulo::kinematics::Trajectory;
use ambulo::model::{Model, from_osim};
use ambulo::motion::{
    B3dError, B3dTrial, ForceRecording, Motion, SmoothSettings, Smoother, Window, coordinates_from_table,
    force_recordings, smooth,
};
use ambulo::study::{self, B3dSourceError, ForceOrigin, MeasuredForces, Outcome, Settings, Source};
use ambulo_formats::b3d::{
    B3d, ContactFrames, Header, MissingForce, Pass, PassFrames, PassKind, Person, TrialFrames, TrialHeader, TrialKind,
    TrialPass,
};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;
use std::fs;

/// The coordinates as nimblephysics orders them: each leg to its toes, then the other; no patella. The document has the
/// toes last.
const ORDER: [&str; 31] = [
    "pelvis_tilt",
    "pelvis_list",
    "pelvis_rotation",
    "pelvis_tx",
    "pelvis_ty",
    "pelvis_tz",
    "hip_flexion_r",
    "hip_adduction_r",
    "hip_rotation_r",
    "knee_angle_r",
    "ankle_angle_r",
    "mtp_angle_r",
    "hip_flexion_l",
    "hip_adduction_l",
    "hip_rotation_l",
    "knee_angle_l",
    "ankle_angle_l",
    "mtp_angle_l",
    "lumbar_extension",
    "lumbar_bending",
    "lumbar_rotation",
    "arm_flex_r",
    "arm_add_r",
    "arm_rot_r",
    "elbow_flex_r",
    "pro_sup_r",
    "arm_flex_l",
    "arm_add_l",
    "arm_rot_l",
    "elbow_flex_l",
    "pro_sup_l",
];
/// Frame rate of the trial [Hz]: every tenth frame of the recording.
const RATE_HZ: f64 = 100.0;

/// A walk on force plates, and the subject made from it.
struct Walk {
    model: Model,
    motion: Motion,
    forces: Vec<ForceRecording>,
    subject: B3d,
}

/// The walk of a person with arms over three plates; `None` without recordings.
fn walk() -> Option<Walk> {
    let folder = shared_data::data()?.join("opensim-rajagopal-walk");
    let read = |name: &str| fs::read(folder.join(name)).unwrap();
    let text = String::from_utf8(read("subject_walk_scaled.osim")).unwrap();
    let findings = &mut Findings::default();
    let model = from_osim(&OsimModel::read(text.as_bytes()).unwrap(), findings).unwrap();
    let table = Table::read_storage(&read("coordinates.sto")).unwrap().0;
    let mut motion = coordinates_from_table(&model, &table, "walk", findings).unwrap();
    let tenth = |column: &Vec<f64>| column.iter().step_by(10).copied().collect::<Vec<f64>>();
    motion.times = (0..tenth(&motion.times).len()).map(|k| k as f64 * (1.0 / RATE_HZ)).collect();
    motion.columns = motion.columns.iter().map(|column| column.as_ref().map(tenth)).collect();
    // Joints that do not move in the recording have a column in the file.
    for name in ORDER {
        let column = &mut motion.columns[model.coordinate(name).unwrap().index()];
        column.get_or_insert_with(|| vec![0.0; motion.times.len()]);
    }
    let forces = forces_at(&model, &motion, &read("grf_walk.xml"), &read("grf_walk.mot"));
    let subject = subject(&text, &model, &motion, &forces);
    Some(Walk { model, motion, forces, subject })
}

/// The measured forces at the frames of the motion, which begin 0.45 s after those of the plates.
fn forces_at(model: &Model, motion: &Motion, loads: &[u8], table: &[u8]) -> Vec<ForceRecording> {
    let findings = &mut Findings::default();
    let mut table = Table::read_storage(table).unwrap().0;
    let times: Vec<f64> = table.times().unwrap().iter().map(|t| t - 0.45).collect();
    let others = table.columns().skip(1).map(|(name, column)| (name.to_owned(), column.to_vec()));
    table = Table::new("forces", std::iter::once(("time".to_owned(), times)).chain(others).collect()).unwrap();
    let plates = force_recordings(model, &ExternalLoads::read(loads).unwrap().0, &table, findings).unwrap();
    let raw = SmoothSettings { smoother: Smoother::Off, window: Window::default(), rate_hz: None };
    let trajectory = Trajectory::complete(model, smooth(model, motion, raw, findings).unwrap(), findings).unwrap();
    let ground = measured(model, &trajectory, &plates, None, findings).unwrap();
    let on_foot = |plate: &ForceRecording| {
        let body = ground.bodies.iter().find(|body| body.body == plate.body).unwrap();
        let n = motion.times.len();
        let centre = |k: usize| Some(body.center_of_pressure[k]).filter(|p| p.x.is_finite()).unwrap_or_default();
        ForceRecording {
            name: model.bodies()[plate.body.index()].name.clone(),
            times: motion.times.clone(),
            force: body.force.clone(),
            point: (0..n).map(centre).collect(),
            moment: (0..n).map(|k| body.moment[k] - centre(k).cross(&body.force[k])).collect(),
            ..plate.clone()
        }
    };
    plates.iter().map(on_foot).collect()
}

/// A file with one trial.
fn subject(text: &str, model: &Model, motion: &Motion, forces: &[ForceRecording]) -> B3d {
    let frames = motion.times.len();
    let column = |name: &str| motion.columns[model.coordinate(name).unwrap().index()].clone().unwrap();
    let centre = |k: usize| {
        let q: Vec<f64> = motion.columns.iter().map(|column| column.as_ref().map_or(0.0, |column| column[k])).collect();
        model.mass_center(&q).into()
    };
    let contact = |force: &ForceRecording| ContactFrames {
        force: force.force.iter().map(|v| (*v).into()).collect(),
        centre_of_pressure: force.point.iter().map(|v| (*v).into()).collect(),
        moment: force.moment.iter().map(|v| (*v).into()).collect(),
    };
    let pass = PassFrames {
        positions: ORDER.iter().map(|name| column(name)).collect(),
        mass_centre: (0..frames).map(centre).collect(),
        contacts: forces.iter().map(contact).collect(),
    };
    let of_trial = TrialPass { kind: PassKind::Dynamics, observed: vec![true; ORDER.len()], cutoff_hz: 0.0 };
    let trial = TrialHeader {
        name: "walk".into(),
        frames,
        step_s: 1.0 / RATE_HZ,
        missing_force: vec![MissingForce::default(); frames],
        passes: vec![of_trial],
        force_plates: 2,
        kind: TrialKind::Overground,
        marker_names_guessed: false,
    };
    let header = Header {
        person: Person { sex: "male".into(), height_m: 1.83, mass_kg: 85.0, age_years: 30 },
        coordinates: ORDER.len(),
        passes: vec![Pass { kind: PassKind::Dynamics, model: text.to_owned() }],
        contact_bodies: forces.iter().map(|force| force.name.clone()).collect(),
        trials: vec![trial],
        ..Header::default()
    };
    B3d { header, trials: vec![TrialFrames { markers: Vec::new(), passes: vec![pass] }] }
}

fn source(subject: &B3d, window: Window, findings: &mut Findings) -> Result<Source, B3dSourceError> {
    let trial = B3dTrial { header: &subject.header, trial: 0, frames: &subject.trials[0], name: "walk" };
    Source::of_b3d(&trial, window, findings)
}

fn outcome(subject: &B3d, settings: &Settings, findings: &mut Findings) -> Outcome {
    let source = source(subject, settings.window, findings).unwrap();
    study::run(source, settings, findings).unwrap()
}

fn moments(outcome: &Outcome) -> &[Vec<f64>] {
    &outcome.analysis.forces.generalized
}

#[test]
fn a_trial_gives_the_forces_of_the_same_motion_and_loads() {
    let Some(Walk { model, motion, forces, subject }) = walk() else { return };
    let bytes = subject.write().unwrap();
    let read = B3d::read(&bytes).unwrap();
    let findings = &mut Findings::default();
    let found = outcome(&read, &Settings::default(), findings);
    assert_eq!(found.force_origin, ForceOrigin::Measured);
    for absent in [Code::B3dForceMissing, Code::B3dUnobserved, Code::B3dFiltered, Code::B3dStatedMass] {
        assert!(!findings.has(absent), "{findings:?}");
    }
    let direct = Source::coordinates(model, motion).with_forces(MeasuredForces::OnBodies(forces));
    let expected = study::run(direct, &Settings::default(), &mut Findings::default()).unwrap();
    assert_eq!(moments(&found), moments(&expected), "bit for bit");
}

#[test]
fn a_force_that_is_marked_as_missing_is_not_used_as_zero() {
    let Some(Walk { subject, .. }) = walk() else { return };
    let frames = subject.header.trials[0].frames;
    let gap = 40..52;
    let mut holed = subject.clone();
    for k in gap.clone() {
        holed.header.trials[0].missing_force[k] = MissingForce(5);
        holed.trials[0].passes[0].contacts.iter_mut().for_each(|contact| contact.force[k] = [0.0; 3]);
    }
    let findings = &mut Findings::default();
    let found = outcome(&holed, &Settings::default(), findings);
    let grid = found.analysis.trajectory.grid();
    assert!(grid.start_s > 0.515 && grid.frames <= frames - 52, "{grid:?}");
    let said = findings.as_slice().iter().find(|finding| finding.code == Code::B3dForceMissing).unwrap();
    assert!(said.message.contains("missing in 12 of 135 frames (not over a force plate 12)"), "{said:?}");
    // The time before the gap can be chosen.
    let before = Settings { window: Window { from_s: None, to_s: Some(0.5) }, ..Settings::default() };
    let early = outcome(&holed, &before, &mut Findings::default());
    assert!(matches!(early.force_origin, ForceOrigin::Predicted { .. }), "0.4 s hold no step");
    // Without a mark, the same zeros are forces, and the residual shows them.
    holed.header.trials[0].missing_force.fill(MissingForce(0));
    let unmarked = outcome(&holed, &Settings::default(), &mut Findings::default());
    let rms = |outcome: &Outcome| outcome.analysis.residual.unwrap().force_rms_n;
    assert!(rms(&unmarked) > 2.0 * rms(&found), "{} N, {} N", rms(&unmarked), rms(&found));
    // All missing: forces are predicted.
    holed.header.trials[0].missing_force.fill(MissingForce(14));
    let findings = &mut Findings::default();
    let predicted = outcome(&holed, &Settings::default(), findings);
    assert!(matches!(predicted.force_origin, ForceOrigin::Predicted { .. }) && findings.has(Code::B3dForceMissing));
}

#[test]
fn coordinates_in_another_order_or_number_are_refused() {
    let Some(Walk { subject, .. }) = walk() else { return };
    let refused = |change: &dyn Fn(&mut B3d)| {
        let mut changed = subject.clone();
        change(&mut changed);
        source(&changed, Window::default(), &mut Findings::default()).unwrap_err()
    };
    // The order of the document, in which the toes come last: legs and arms get each other's angles.
    let confused = refused(&|changed| {
        let pass = &mut changed.trials[0].passes[0];
        let toe = pass.positions.remove(11);
        pass.positions.push(toe);
    });
    let B3dSourceError::Trial(B3dError::MassCentre { distance_m, .. }) = confused else { panic!("{confused:?}") };
    println!("mass centre {distance_m:.3} m away");
    let fewer = refused(&|changed| {
        changed.trials[0].passes[0].positions.pop();
    });
    assert!(fewer.to_string().contains("30 coordinates, its model"), "{fewer}");
    let other = refused(&|changed| changed.header.contact_bodies[0] = "foot_r".into());
    assert!(other.to_string().contains("`foot_r`"), "{other}");
    let text = refused(&|changed| changed.header.passes[0].model = "<OpenSimDocument/>".into());
    assert!(matches!(text, B3dSourceError::Format(_)), "{text}");
    let none = refused(&|changed| changed.trials[0].passes.clear());
    assert_eq!(none, B3dSourceError::Trial(B3dError::NoPass));
}

#[test]
fn statements_of_the_file_are_compared_and_not_believed() {
    let Some(Walk { subject, .. }) = walk() else { return };
    let codes = |person: Person, observed: Vec<bool>, kind: PassKind| {
        let mut changed = subject.clone();
        changed.header.person = person;
        changed.header.trials[0].passes[0] = TrialPass { kind, observed, cutoff_hz: 6.0 };
        let findings = &mut Findings::default();
        source(&changed, Window::default(), findings).unwrap();
        let ours = [Code::B3dStatedMass, Code::B3dFormDefaults, Code::B3dUnobserved, Code::B3dFiltered];
        ours.into_iter().filter(|code| findings.has(*code)).collect::<Vec<Code>>()
    };
    let person =
        |mass_kg: f64, height_m: f64, age_years: usize| Person { mass_kg, height_m, age_years, sex: "male".into() };
    assert_eq!(codes(person(85.0, 1.83, 30), Vec::new(), PassKind::Dynamics), []);
    assert_eq!(codes(person(68.0, 1.83, 30), Vec::new(), PassKind::Kinematics), [Code::B3dStatedMass]);
    assert_eq!(codes(person(68.0, 1.70, 18), Vec::new(), PassKind::Kinematics), [Code::B3dFormDefaults]);
    let mut observed = vec![true; ORDER.len()];
    observed[30] = false;
    assert_eq!(codes(person(0.0, 0.0, 0), observed, PassKind::LowPassFilter), [Code::B3dUnobserved, Code::B3dFiltered]);
}
