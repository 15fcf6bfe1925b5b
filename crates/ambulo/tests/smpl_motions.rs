//! Motions of the SMPL family: arrays, axes, lengths of a body or of a model file, and the clock that gravity shows.

use ambulo::findings::{Code, Findings};
use ambulo::kinematics::retarget::retarget;
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::motion::skeleton::SkeletonRecording;
use ambulo::motion::{SmplBody, SmplError, SmplMotion, Window};
use ambulo::spatial::{STANDARD_GRAVITY, Vec3, rotation};
use ambulo::study::{self, Measure, QualityState, Recording, Settings, Source};
use ambulo_formats::npz::{Array, Data, Npz};
use std::f64::consts::FRAC_PI_2;

const BUILD: Build = Build { table: SegmentTable::DeLevaMale, mass: 70.0, height: 1.75, toe_joint: true };

fn numbers(shape: &[usize], values: Vec<f64>) -> Array {
    Array { shape: shape.to_vec(), data: Data::Numbers(values) }
}

/// An archive of frames with z up: places of the pelvis, and a rotation of the right knee about its own x axis.
fn archive(rate_hz: f64, places: &[[f64; 3]], knee: f64) -> Npz {
    let pose = |_: &[f64; 3]| {
        let mut row = vec![0.0; 156];
        row[0] = FRAC_PI_2;
        row[15] = knee;
        row
    };
    let frames = places.len();
    let arrays = [
        ("poses", numbers(&[frames, 156], places.iter().flat_map(pose).collect())),
        ("trans", numbers(&[frames, 3], places.concat())),
        ("betas", numbers(&[16], vec![1.0; 16])),
        ("mocap_framerate", numbers(&[], vec![rate_hz])),
    ];
    Npz { arrays: arrays.map(|(name, array)| (name.to_owned(), array)).into() }
}

fn skeleton(npz: &Npz, body: &SmplBody, findings: &mut Findings) -> SkeletonRecording {
    SmplMotion::from_npz(npz).unwrap().skeleton(body, "walk.npz", Some(BUILD.height), findings).unwrap()
}

#[track_caller]
fn assert_at(recording: &SkeletonRecording, name: &str, place: Vec3) {
    let found = recording.markers.marker(name).unwrap().positions[1];
    assert!((found - place).norm() < 1e-9, "{name}: {found:?} instead of {place:?}");
}

#[test]
fn a_bent_knee_puts_the_foot_behind_the_body_with_z_up_in_the_file() {
    let body = SmplBody::of_stature(&BUILD).unwrap();
    let sizes = BUILD.human().unwrap().dimensions;
    let findings = &mut Findings::default();
    // The body faces -y in the file: its z axis, turned by 90 degrees about x.
    let recording = skeleton(&archive(60.0, &[[0.0, 0.0, 0.9], [0.0, -0.5, 0.9]], FRAC_PI_2), &body, findings);
    assert!(findings.has(Code::SmplBody) && !findings.has(Code::BvhRestPose), "{findings:?}");
    assert_eq!((recording.markers.rate_hz, recording.metres_per_unit), (60.0, 1.0));
    let hip = Vec3::new(0.5, 0.9, sizes.hip_width / 2.0);
    assert_at(&recording, "hip_r", hip);
    assert_at(&recording, "knee_r", hip - sizes.thigh * Vec3::y());
    assert_at(&recording, "ankle_r", hip - sizes.thigh * Vec3::y() - sizes.shank * Vec3::x());
    let left = Vec3::new(0.5, 0.9, -sizes.hip_width / 2.0);
    assert_at(&recording, "ankle_l", left - (sizes.thigh + sizes.shank) * Vec3::y());
    let wrist = sizes.shoulder_width / 2.0 + sizes.upper_arm + sizes.forearm;
    assert_at(&recording, "wrist_l", Vec3::new(0.5, 0.9 + sizes.shoulder_height, -wrist));
}

#[test]
fn both_layouts_of_the_arrays_and_both_names_of_the_rate_are_read() {
    let whole = archive(120.0, &[[0.0, 0.0, 0.9]; 3], 0.3);
    let motion = SmplMotion::from_npz(&whole).unwrap();
    let rows = whole.array("poses").unwrap().numbers().unwrap();
    let part = |from: usize, to: usize| rows.chunks(156).flat_map(|row| row[from..to].to_vec()).collect::<Vec<f64>>();
    let mut divided = whole.clone();
    divided.arrays.retain(|(name, _)| name == "trans" || name == "betas");
    divided.arrays.push(("root_orient".into(), numbers(&[3, 3], part(0, 3))));
    divided.arrays.push(("pose_body".into(), numbers(&[3, 63], part(3, 66))));
    divided.arrays.push(("mocap_frame_rate".into(), numbers(&[1], vec![120.0])));
    assert_eq!(SmplMotion::from_npz(&divided).unwrap(), motion);
    let refused = |change: &dyn Fn(&mut Npz)| {
        let mut changed = whole.clone();
        change(&mut changed);
        SmplMotion::from_npz(&changed).unwrap_err().to_string()
    };
    let text = refused(&|npz| npz.arrays.retain(|(name, _)| name != "poses"));
    assert!(text.contains("no array `poses`; found trans, betas, mocap_framerate"), "{text}");
    let text = refused(&|npz| npz.arrays.retain(|(name, _)| name != "mocap_framerate"));
    assert!(text.contains("no array `mocap_framerate`"), "{text}");
    let text = refused(&|npz| npz.arrays[3].1 = numbers(&[], vec![0.0]));
    assert!(text.contains("frame rate is 0 Hz"), "{text}");
    let text = refused(&|npz| npz.arrays[1].1 = numbers(&[2, 3], vec![0.0; 6]));
    assert!(text.contains("rotations of 3 frames and `trans` of 2 frames"), "{text}");
    let text = refused(&|npz| npz.arrays[0].1 = Array { shape: vec![3], data: Data::Other("|O".into()) });
    assert!(text.contains("`poses` holds `|O`; expected numbers"), "{text}");
    let text = refused(&|npz| npz.arrays[0].1 = numbers(&[3, 24], vec![0.0; 72]));
    assert!(text.contains("`poses` has the shape [3, 24]"), "{text}");
}

#[test]
fn joint_centres_of_the_users_model_follow_its_shape() {
    // Each joint is a separate vertex; the only shape lengthens the body by a tenth per unit.
    let body = SmplBody::of_stature(&BUILD).unwrap();
    let npz = archive(60.0, &[[0.0, 0.0, 0.9]; 2], 0.0);
    let names = ["hip_r", "knee_r", "ankle_r", "shoulder_l", "wrist_l"];
    let places: Vec<[f64; 3]> = (0..22).map(|k| [0.01 * f64::from(k), 0.1 * f64::from(k), 0.02]).collect();
    let mut given = places.clone();
    // A person's legs: hips, knees and ankles below the pelvis.
    for (joint, place) in [
        (0, [0.0, 0.0, 0.0]),
        (1, [0.08, -0.05, 0.0]),
        (2, [-0.08, -0.05, 0.0]),
        (4, [0.08, -0.45, 0.0]),
        (5, [-0.08, -0.45, 0.0]),
        (7, [0.08, -0.85, 0.0]),
        (8, [-0.08, -0.85, 0.0]),
        (10, [0.08, -0.9, 0.12]),
        (11, [-0.08, -0.9, 0.12]),
    ] {
        given[joint] = place;
    }
    let regressor: Vec<f64> = (0..22 * 22).map(|at| if at / 22 == at % 22 { 1.0 } else { 0.0 }).collect();
    let model = |shapes: Vec<f64>| Npz {
        arrays: vec![
            ("v_template".into(), numbers(&[22, 3], given.concat())),
            ("shapedirs".into(), numbers(&[22, 3, 1], shapes)),
            ("J_regressor".into(), numbers(&[22, 22], regressor.clone())),
        ],
    };
    let grown = model(given.concat().iter().map(|x| 0.1 * x).collect());
    let sizes = BUILD.human().unwrap().dimensions;
    let findings = &mut Findings::default();
    let of = |npz: &Npz, betas: &[f64]| SmplBody::of_model(npz, betas, &sizes).unwrap();
    let at = |recording: &SkeletonRecording, name: &str| recording.markers.marker(name).unwrap().positions[1];
    let [plain, tall] = [[0.0], [1.0]].map(|betas| skeleton(&npz, &of(&grown, &betas), &mut Findings::default()));
    for name in names {
        let from_hip = |recording: &SkeletonRecording| at(recording, name) - at(recording, "hip_l");
        assert!((from_hip(&tall) - 1.1 * from_hip(&plain)).norm() < 1e-9, "{name}");
    }
    assert!((at(&plain, "knee_r") - at(&plain, "ankle_r") - 0.4 * Vec3::y()).norm() < 1e-9);
    let other = skeleton(&npz, &body, findings);
    assert!((at(&other, "knee_r") - at(&plain, "knee_r")).norm() > 1e-3, "the built-in body has other lengths");
    let mut odd = grown.clone();
    odd.arrays.remove(2);
    let refused = SmplBody::of_model(&odd, &[], &sizes).unwrap_err();
    assert!(matches!(refused, SmplError::NoBody { .. }), "{refused}");
    odd = grown;
    odd.arrays[2].1 = Array { shape: vec![24, 6890], data: Data::Other("|O".into()) };
    let refused = SmplBody::of_model(&odd, &[], &sizes).unwrap_err().to_string();
    assert!(refused.contains("`J_regressor` holds `|O`"), "{refused}");
}

/// Two hops with straight legs at 100 frames per second: half a second on the floor, then a flight from 2.2 m/s
/// upwards.
fn hopping(stated_hz: f64, findings: &mut Findings) -> SkeletonRecording {
    let (speed, stand_s) = (2.2, 0.5);
    let flight_s = 2.0 * speed / STANDARD_GRAVITY;
    let place = |frame: u32| {
        let in_hop = (f64::from(frame) / 100.0) % (stand_s + flight_s) - stand_s;
        let up = if in_hop > 0.0 { speed * in_hop - 0.5 * STANDARD_GRAVITY * in_hop * in_hop } else { 0.0 };
        [0.0, -0.01 * f64::from(frame), 0.9 + up]
    };
    let places: Vec<[f64; 3]> = (0..190).map(place).collect();
    let body = SmplBody::of_stature(&BUILD).unwrap();
    skeleton(&archive(stated_hz, &places, 0.0), &body, findings)
}

fn hops(stated_hz: f64) -> Findings {
    let mut findings = Findings::default();
    let recording = hopping(stated_hz, &mut findings);
    retarget(&BUILD, &recording, &mut findings).unwrap();
    findings
}

#[test]
fn a_frame_rate_that_gravity_contradicts_is_reported_with_the_one_that_it_needs() {
    assert!(!hops(100.0).has(Code::MotionClock), "{:?}", hops(100.0));
    let slow = hops(50.0);
    let said = slow.as_slice().iter().find(|finding| finding.code == Code::MotionClock).unwrap();
    assert!(said.message.contains("falls with 2.5 m/s² at the stated 50 frames per second"), "{said:?}");
    assert!(said.message.contains("gravity means about 100 frames per second"), "{said:?}");
}

#[test]
fn a_frame_rate_that_gravity_contradicts_makes_the_quality_bad() {
    let quality = |stated_hz: f64| {
        let recording = hopping(stated_hz, &mut Findings::default());
        let skeleton = Recording::Skeleton { skeleton: recording, table: BUILD.table, mass_kg: BUILD.mass };
        study::run(Source::new(skeleton), &Settings::default(), &mut Findings::default()).unwrap().quality
    };
    let slow = quality(50.0);
    let reason = slow.reasons.iter().find(|reason| reason.measure == Measure::FrameRate).unwrap();
    assert_eq!((slow.state, reason.state), (QualityState::Bad, QualityState::Bad));
    assert!((reason.value - 2.0).abs() < 0.05, "{reason:?}");
    assert!(reason.message.contains("about 100 frames per second and not 50 as stated"), "{reason:?}");
    assert!(quality(100.0).reasons.iter().all(|reason| reason.measure != Measure::FrameRate));
}

#[test]
fn a_motion_that_is_too_short_to_be_measured_says_so() {
    let skeleton = hopping(100.0, &mut Findings::default());
    let window = Window { from_s: None, to_s: Some(0.19) };
    let source = Source::new(Recording::Skeleton { skeleton, table: BUILD.table, mass_kg: BUILD.mass });
    let settings = Settings { window, ..Settings::default() };
    let quality = study::run(source, &settings, &mut Findings::default()).unwrap().quality;
    let said: Vec<&str> = quality.reasons.iter().map(|reason| reason.message.as_str()).collect();
    assert!(said.iter().any(|message| message.contains("the motion is too short to compare it")), "{said:?}");
    assert!(said.iter().all(|message| !message.contains("0 %")), "{said:?}");
}

#[test]
fn places_in_millimetres_and_time_steps_for_rates_are_refused_with_the_reason() {
    let refused = |npz: &Npz| SmplMotion::from_npz(npz).unwrap_err().to_string();
    let places = |unit: f64| [[0.0, 0.0, 0.9 * unit], [0.0, -0.01 * unit, 0.9 * unit]];
    for (unit, shown) in [(1000.0, "900 above the origin"), (100.0, "90 above the origin")] {
        let error = refused(&archive(100.0, &places(unit), 0.0));
        assert!(error.contains(shown) && error.contains("Divide it by 1000 or 100"), "{error}");
    }
    for rate in [0.001, 0.0, 1e6, f64::NAN] {
        let error = refused(&archive(rate, &places(1.0), 0.0));
        assert!(error.contains("expected 5 to 2000 frames per second"), "{error}");
    }
    assert!(refused(&archive(0.0083, &places(1.0), 0.0)).contains("is it the time from one frame to the next?"));
    assert!(SmplMotion::from_npz(&archive(5.0, &places(20.0), 0.0)).is_ok());
}

#[test]
fn names_of_pose_estimators_and_rotation_matrices_are_read() {
    let whole = archive(120.0, &[[0.0, 0.0, 0.9]; 3], 0.3);
    let motion = SmplMotion::from_npz(&whole).unwrap();
    let rows: Vec<f64> = whole.array("poses").unwrap().numbers().unwrap().to_vec();
    let vectors = |from: usize, to: usize| -> Vec<f64> {
        rows.chunks(156).flat_map(|row| row[3 * from..3 * to].to_vec()).collect()
    };
    let with = |arrays: Vec<(&str, Array)>| {
        let mut npz = whole.clone();
        npz.arrays.retain(|(name, _)| name != "poses" && name != "trans" && name != "mocap_framerate");
        npz.arrays.push(("transl".into(), whole.array("trans").unwrap().clone()));
        npz.arrays.push(("fps".into(), numbers(&[], vec![120.0])));
        npz.arrays.extend(arrays.into_iter().map(|(name, array)| (name.to_owned(), array)));
        npz
    };
    // SMPL's own body_pose has two joints of the hands more.
    let hands: Vec<f64> = rows.chunks(156).flat_map(|row| [&row[3..66], &[0.0; 6][..]].concat()).collect();
    for body in [numbers(&[3, 63], vectors(1, 22)), numbers(&[3, 21, 3], vectors(1, 22)), numbers(&[3, 69], hands)] {
        for root in [numbers(&[3, 3], vectors(0, 1)), numbers(&[3, 1, 3], vectors(0, 1))] {
            let npz = with(vec![("global_orient", root), ("body_pose", body.clone())]);
            assert_eq!(SmplMotion::from_npz(&npz).unwrap(), motion);
        }
    }
    let matrices = |from: usize, to: usize| -> Vec<f64> {
        let of = |three: &[f64]| rotation(&Vec3::new(three[0], three[1], three[2])).transpose().as_slice().to_vec();
        vectors(from, to).chunks(3).flat_map(of).collect()
    };
    let near = |npz: &Npz| {
        let found = SmplMotion::from_npz(npz).unwrap();
        for (a, b) in found.rotations.iter().flatten().zip(motion.rotations.iter().flatten()) {
            assert!((rotation(a) - rotation(b)).norm() < 1e-12, "{a} {b}");
        }
    };
    near(&with(vec![
        ("global_orient", numbers(&[3, 1, 3, 3], matrices(0, 1))),
        ("body_pose", numbers(&[3, 21, 3, 3], matrices(1, 22))),
    ]));
    near(&with(vec![("poses", numbers(&[3, 22, 3, 3], matrices(0, 22)))]));
    near(&with(vec![("poses", numbers(&[3, 198], matrices(0, 22)))]));
}

#[test]
fn other_representations_and_degrees_are_refused_by_name() {
    let whole = archive(120.0, &[[0.0, 0.0, 0.9]; 3], 0.3);
    let refused = |shape: &[usize], value: f64| {
        let mut npz = whole.clone();
        npz.arrays[0].1 = numbers(shape, vec![value; shape.iter().product()]);
        SmplMotion::from_npz(&npz).unwrap_err().to_string()
    };
    for shape in [&[3, 24, 4][..], &[3, 96], &[3, 88]] {
        assert!(refused(shape, 0.5).contains("`poses` has quaternions (4 numbers) for each joint"), "{shape:?}");
    }
    for shape in [&[3, 22, 6][..], &[3, 132], &[3, 144]] {
        assert!(refused(shape, 0.5).contains("`poses` has 6 numbers for each joint"), "{shape:?}");
    }
    assert!(refused(&[3, 22, 9], 0.5).contains("no rotation matrices"), "{}", refused(&[3, 22, 9], 0.5));
    assert!(refused(&[3, 72], 60.0).contains("which look like degrees"), "{}", refused(&[3, 72], 60.0));
    assert!(refused(&[3, 70], 0.0).contains("has the shape [3, 70]"));
}
