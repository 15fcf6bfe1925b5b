//! Pelvic tilt and hip flexion as the clinic defines them, against the angles that Plug-in-Gait wrote into the same
//! files.
//!
//! The recordings are not part of the repository; without them these tests say `skipped` and pass. The figures stand in
//! docs/PLUG_IN_GAIT.md.

use crate::anatomy_models;
use crate::common;
use crate::common::{State, assert_near};
use crate::gait_files;
use crate::gait_files::Subject;
use ambulo::findings::Findings;
use ambulo::kinematics::calibration::{Calibrated, Trial, calibrate};
use ambulo::kinematics::marker_fit::{FitSettings, fit_markers};
use ambulo::kinematics::{ClinicalAngles, Trajectory, clinical_angles};
use ambulo::model::anatomy::{Movement, PelvicFrame, PelvicFrameError};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::full_body::{STANDING_TILT, full_body};
use ambulo::model::marker_set::MarkerSet;
use ambulo::model::{Model, Side};
use ambulo::motion::{MarkerRecording, SmoothSettings, Smoother, Window, smooth};

/// Largest mean difference from Plug-in-Gait's angles [deg]: pelvis and hip. The pelvis is that of the same markers, as
/// far as the fit follows them. At the hip 1.9 to 4.5 degrees are left: Harrington's hip centre lies 8 to 18 mm behind
/// Davis', which are 1 to 3 degrees of a thigh. The coordinates of the model are 11 and 7 to 10 degrees off.
const MOST_DEG: [f64; 2] = [1.5, 5.5];

struct Walked {
    model: Model,
    frames: std::ops::Range<usize>,
    angles: ClinicalAngles,
    own_tilt: Vec<f64>,
}

fn trajectory(body: &Calibrated, markers: &MarkerRecording) -> (Trajectory, usize) {
    let (model, mut findings) = (&body.human.model, Findings::default());
    let settings = FitSettings { weights: body.weights.clone(), ..FitSettings::default() };
    let motion = fit_markers(model, markers, &settings, &mut findings).unwrap().motion;
    let settings = SmoothSettings { smoother: Smoother::Off, window: Window::default(), rate_hz: None };
    let smooth = smooth(model, &motion, settings, &mut findings).unwrap();
    let first = markers.times.partition_point(|t| *t < smooth.grid.start_s - 1e-6);
    (Trajectory::complete(model, smooth, &mut findings).unwrap(), first)
}

fn walked(subject: &Subject) -> Walked {
    let names = subject.standing.markers.markers.iter().map(|m| m.name.as_str());
    let known = MarkerSet::recognise(names).unwrap();
    let (markers, person) = (&subject.standing.markers, &subject.person);
    let body = calibrate(markers, Trial::Standing, &known, person, &mut Findings::default()).unwrap();
    let (trajectory, first) = trajectory(&body, &subject.walk.markers);
    let model = body.human.model;
    let frame = PelvicFrame::of_model(&model).unwrap();
    let angles = clinical_angles(&model, &trajectory, &frame).unwrap();
    let (id, sign) = model.anatomy().coordinate(Movement::PelvicTilt, None).unwrap();
    let own_tilt = trajectory.values(id).iter().map(|x| sign * x).collect();
    Walked { model, frames: first..first + trajectory.grid().frames, angles, own_tilt }
}

/// Mean difference [deg] and correlation.
fn compared(ours: &[f64], theirs: &[f64]) -> [f64; 2] {
    let pairs: Vec<(f64, f64)> =
        ours.iter().map(|x| x.to_degrees()).zip(theirs.iter().copied()).filter(|(_, b)| *b != 0.0).collect();
    let n = pairs.len() as f64;
    let (a, b) = (pairs.iter().map(|p| p.0).sum::<f64>() / n, pairs.iter().map(|p| p.1).sum::<f64>() / n);
    let sum = |f: &dyn Fn(f64, f64) -> f64| pairs.iter().map(|p| f(p.0 - a, p.1 - b)).sum::<f64>();
    [a - b, sum(&|x, y| x * y) / (sum(&|x, _| x * x) * sum(&|_, y| y * y)).sqrt()]
}

#[test]
fn pelvic_tilt_and_hip_flexion_are_plug_in_gaits_to_a_few_degrees() {
    for subject in gait_files::everyone() {
        let walked = walked(&subject);
        for side in Side::BOTH {
            let reference =
                |name: &str| subject.walk.angle(name, side).map(|angles| angles[walked.frames.clone()].to_vec());
            if let Some(theirs) = reference("PelvisAngles") {
                let [offset, r] = compared(&walked.angles.pelvic_tilt, &theirs);
                let [before, _] = compared(&walked.own_tilt, &theirs);
                println!(
                    "{} pelvic tilt {side}: {offset:+.1} deg, r {r:.3}; the model's own {before:+.1}",
                    subject.name
                );
                assert!(offset.abs() < MOST_DEG[0], "{}: {offset}", subject.name);
                assert!((before + 11.5).abs() < 1.5, "{}: {before}", subject.name);
            }
            let [flexion, ..] = walked.angles.hips[side].as_ref().unwrap();
            let theirs = reference("HipAngles").unwrap();
            let [offset, r] = compared(flexion, &theirs);
            println!("{} hip flexion {side}: {offset:+.1} deg, r {r:.3}", subject.name);
            assert!(offset.abs() < MOST_DEG[1] && r > 0.97, "{}: {offset} r {r}", subject.name);
        }
        assert!(walked.model.anatomy().pelvis().is_some());
    }
}

/// Constant offset: what tilt gains, flexion gains; rotation and obliquity of a straight posture do not change.
#[test]
fn angles_of_one_joint_are_the_coordinates_beside_the_constant_tilt() {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 70.0, height: 1.75, toe_joint: true };
    for model in [full_body(&build).unwrap().model, anatomy_models::demo()] {
        let frame = PelvicFrame::of_built_in(&model).unwrap();
        for (movement, side, angle) in [
            (Movement::PelvicTilt, None, 0.2),
            (Movement::HipFlexion, Some(Side::Right), 0.5),
            (Movement::HipFlexion, Some(Side::Left), -0.2),
        ] {
            let (id, sign) = model.anatomy().coordinate(movement, side).unwrap();
            let mut state = State::rest(&model);
            state.q[id.index()] = sign * angle;
            let found = clinical_angles(&model, &common::trajectory(&model, &[state]), &frame).unwrap();
            let of = |wanted: Movement, of_side: Option<Side>| {
                if (movement, side) == (wanted, of_side) { angle } else { 0.0 }
            };
            assert_near(found.pelvic_tilt[0], STANDING_TILT + of(Movement::PelvicTilt, None), 1e-9, "tilt");
            assert_near(found.pelvic_obliquity[0], 0.0, 1e-9, "obliquity");
            for hip_side in Side::BOTH {
                let [flexion, adduction, rotation] = found.hips[hip_side].as_ref().unwrap();
                let expected = STANDING_TILT + of(Movement::HipFlexion, Some(hip_side));
                assert_near(flexion[0], expected, 1e-9, "flexion relative to the tilted pelvis");
                assert_near(adduction[0], 0.0, 1e-9, "adduction");
                assert_near(rotation[0], 0.0, 1e-9, "rotation");
            }
        }
        // Signs of the other planes: in a pelvis without offset they are the coordinates' own.
        let upright = PelvicFrame { axes: ambulo::spatial::Mat3::identity(), ..frame };
        for side in Side::BOTH {
            for movement in [Movement::HipAdduction, Movement::HipRotation] {
                let (id, sign) = model.anatomy().coordinate(movement, Some(side)).unwrap();
                let mut state = State::rest(&model);
                state.q[id.index()] = sign * 0.1;
                let found = clinical_angles(&model, &common::trajectory(&model, &[state]), &upright).unwrap();
                let [_, adduction, rotation] = found.hips[side].as_ref().unwrap();
                let value = if movement == Movement::HipAdduction { adduction[0] } else { rotation[0] };
                assert_near(value, 0.1, 1e-9, &format!("{movement:?} {side}"));
            }
        }
        for (movement, angle) in [(Movement::PelvicObliquity, 0.1), (Movement::PelvicRotation, -0.3)] {
            let (id, sign) = model.anatomy().coordinate(movement, None).unwrap();
            let mut state = State::rest(&model);
            state.q[id.index()] = sign * angle;
            let found = clinical_angles(&model, &common::trajectory(&model, &[state]), &upright).unwrap();
            let value = if movement == Movement::PelvicObliquity {
                found.pelvic_obliquity[0]
            } else {
                found.pelvic_rotation[0]
            };
            assert_near(value, angle, 1e-9, &format!("{movement:?}"));
        }
    }
}

/// The anterior tilt of the pelvic axes in the neutral posture [deg].
fn tilt_deg(model: &Model) -> f64 {
    let frame = PelvicFrame::of_model(model).unwrap();
    let still = common::trajectory(model, &[State::rest(model)]);
    clinical_angles(model, &still, &frame).unwrap().pelvic_tilt[0].to_degrees()
}

#[test]
fn published_models_have_their_own_spines_and_others_say_what_is_missing() {
    if let (Some(gait2392), Some(rajagopal)) = (anatomy_models::gait2392(), anatomy_models::rajagopal()) {
        let tilts = [tilt_deg(&gait2392), tilt_deg(&rajagopal)];
        println!("anterior tilt of the upright pelvis: Gait2392 {:.1}, Rajagopal {:.1} deg", tilts[0], tilts[1]);
        // Their authors drew the pelvis with its spines nearly level.
        assert!(tilts.iter().all(|tilt| (-10.0..10.0).contains(tilt)), "{tilts:?}");
    }
    let bare = anatomy_models::demo();
    let error = PelvicFrame::of_model(&bare).unwrap_err();
    assert!(matches!(error, PelvicFrameError::NoLandmarks { .. }), "{error}");
    assert!(
        error.to_string().contains("ASIS") && error.to_string().contains("those of the coordinates of the model"),
        "{error}"
    );
}
