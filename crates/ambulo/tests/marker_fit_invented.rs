//! Markers of invented motions on invented bodies: what forward kinematics makes, the fit takes back.

use crate::common::random::{self, Curves, Kind, Random, Waves};
use crate::common::{State, turn};
use ambulo::findings::{Code, Findings};
use ambulo::kinematics::body_motion;
use ambulo::kinematics::marker_fit::{FitError, FitSettings, JointLimits, MarkerFit, OutlierDetection, fit_markers};
use ambulo::model::{Body, Coordinate, CoordinateId, Drive, Function, JointAxis, Marker, Model};
use ambulo::motion::{MarkerPath, MarkerRecording};
use ambulo::spatial::{Mat3, Pose, Vec3};

/// The model with four markers on every body.
fn marked(r: &mut Random, model: &Model) -> Model {
    let markers = model
        .body_ids()
        .flat_map(|id| (0..4).map(move |k| (id, k)))
        .map(|(id, k)| Marker {
            name: format!("m{}_{k}", id.index()),
            body: Some(id),
            location: r.vector(0.2),
            fixed: false,
        })
        .collect();
    let (bodies, coordinates) = (model.bodies().to_vec(), model.coordinates().to_vec());
    Model::new("invented", model.gravity(), bodies, coordinates, markers).unwrap()
}

/// Where the markers are in these states, 100 frames a second.
fn recorded(model: &Model, states: &[State]) -> MarkerRecording {
    let mut markers: Vec<MarkerPath> =
        model.markers().iter().map(|m| MarkerPath { name: m.name.clone(), positions: Vec::new() }).collect();
    for state in states {
        let bodies = body_motion(model, state.posture());
        for (path, marker) in markers.iter_mut().zip(model.markers()) {
            path.positions.push(bodies[marker.body.unwrap().index()].pose.place(marker.location));
        }
    }
    let times = (0..states.len()).map(|i| 0.01 * i as f64).collect();
    MarkerRecording { name: "invented".into(), rate_hz: 100.0, times, markers }
}

fn fitted(model: &Model, markers: &MarkerRecording) -> MarkerFit {
    fit_markers(model, markers, &FitSettings::default(), &mut Findings::default()).unwrap()
}

fn states(r: &mut Random, model: &Model, frames: usize) -> Vec<State> {
    let waves = Waves::new(r, model);
    (0..frames).map(|i| waves.at(0.01 * i as f64)).collect()
}

/// Joints whose coordinates are one to one with their postures, on a body that flies.
fn chain(r: &mut Random) -> Model {
    const PLAIN: [Kind; 7] =
        [Kind::Pin, Kind::Slider, Kind::Universal, Kind::Gimbal, Kind::Planar, Kind::Ball, Kind::Weld];
    let mut kinds = vec![Kind::Free];
    kinds.extend((0..2 + r.below(4)).map(|_| PLAIN[r.below(PLAIN.len())]));
    let model = random::chain_of(r, &kinds, Curves::Smooth);
    marked(r, &model)
}

#[test]
fn markers_of_forward_kinematics_are_fitted_back() {
    for seed in 0..40 {
        let mut r = Random::new(seed);
        let model = chain(&mut r);
        let states = states(&mut r, &model, 30);
        let fit = fitted(&model, &recorded(&model, &states));
        let worst = fit.rms_m.iter().fold(0.0_f64, |a, b| a.max(*b));
        assert!(worst < 1e-8, "seed {seed}: {worst} m");
        assert!(fit.converged.iter().all(|c| *c), "seed {seed}");
        for (frame, state) in states.iter().enumerate() {
            for (c, value) in state.q.iter().enumerate() {
                let found = fit.motion.columns[c].as_ref().unwrap()[frame];
                assert!((found - value).abs() < 1e-8, "seed {seed}, frame {frame}, q{c}: {found} for {value}");
            }
        }
    }
}

#[test]
fn curved_joints_and_ellipsoids_are_fitted_back_from_near() {
    for seed in 0..40 {
        let mut r = Random::new(seed);
        let kinds = [Kind::Free, Kind::Custom, Kind::Ellipsoid, Kind::Custom];
        let model = random::chain_of(&mut r, &kinds, Curves::Smooth);
        let model = marked(&mut r, &model);
        // Curves may have several coordinates for one posture: from a motion that begins where the fit does.
        let waves = Waves::new(&mut r, &model);
        let states: Vec<State> = (0..30)
            .map(|i| {
                let (a, b) = (waves.at(0.0), waves.at(0.01 * i as f64));
                State { q: b.q.iter().zip(&a.q).map(|(b, a)| b - a).collect(), ..b }
            })
            .collect();
        let fit = fitted(&model, &recorded(&model, &states));
        let worst = fit.rms_m.iter().fold(0.0_f64, |a, b| a.max(*b));
        assert!(worst < 1e-8, "seed {seed}: {worst} m, {:?}", fit.iterations);
    }
}

#[test]
fn turning_the_laboratory_changes_only_what_carries_the_body() {
    for seed in 0..10 {
        let mut r = Random::new(seed);
        let model = chain(&mut r);
        let states = states(&mut r, &model, 10);
        let mut markers = recorded(&model, &states);
        // Skin that is not where the model has it.
        for marker in &mut markers.markers {
            let off = r.vector(0.01);
            marker.positions.iter_mut().for_each(|p| *p += off);
        }
        let plain = fitted(&model, &markers);
        let (rotation, shift) = (turn(r.unit(), r.within(3.0)), r.vector(4.0));
        let mut turned = markers.rotated(&rotation);
        for marker in &mut turned.markers {
            marker.positions.iter_mut().for_each(|p| *p += shift);
        }
        let moved = fitted(&model, &turned);
        for frame in 0..10 {
            assert!((plain.rms_m[frame] - moved.rms_m[frame]).abs() < 1e-9, "seed {seed}");
        }
        for (c, (a, b)) in plain.motion.columns.iter().zip(&moved.motion.columns).enumerate().skip(6) {
            for (a, b) in a.as_ref().unwrap().iter().zip(b.as_ref().unwrap()) {
                assert!((a - b).abs() < 1e-6, "seed {seed}, q{c}: {a} and {b}");
            }
        }
    }
}

/// The mirror image in the plane x = 0; axes of rotation are pseudovectors.
fn mirrored(model: &Model) -> Model {
    let s = Mat3::from_diagonal(&Vec3::new(-1.0, 1.0, 1.0));
    let pose = |p: &Pose| Pose { rotation: s * p.rotation * s, translation: s * p.translation };
    let axis = |a: &JointAxis, sign: f64| JointAxis { direction: s * a.direction * sign, ..a.clone() };
    let body = |b: &Body| {
        let mut image = b.clone();
        image.joint.parent_from_joint = pose(&b.joint.parent_from_joint);
        image.joint.child_from_joint = pose(&b.joint.child_from_joint);
        image.joint.rotations = b.joint.rotations.iter().map(|a| axis(a, -1.0)).collect();
        image.joint.translations = b.joint.translations.iter().map(|a| axis(a, 1.0)).collect();
        image
    };
    let markers = model.markers().iter().map(|m| Marker { location: s * m.location, ..m.clone() }).collect();
    let bodies = model.bodies().iter().map(body).collect();
    Model::new("mirrored", model.gravity(), bodies, model.coordinates().to_vec(), markers).unwrap()
}

#[test]
fn a_mirror_changes_no_coordinate() {
    for seed in 0..10 {
        let mut r = Random::new(seed);
        let kinds = [Kind::Free, Kind::Pin, Kind::Ellipsoid, Kind::Ball];
        let model = random::chain_of(&mut r, &kinds, Curves::Smooth);
        let model = marked(&mut r, &model);
        let states = states(&mut r, &model, 10);
        let mut markers = recorded(&model, &states);
        for marker in &mut markers.markers {
            let off = r.vector(0.01);
            marker.positions.iter_mut().for_each(|p| *p += off);
        }
        let plain = fitted(&model, &markers);
        let image = fitted(&mirrored(&model), &markers.rotated(&Mat3::from_diagonal(&Vec3::new(-1.0, 1.0, 1.0))));
        for (c, (a, b)) in plain.motion.columns.iter().zip(&image.motion.columns).enumerate() {
            for (a, b) in a.as_ref().unwrap().iter().zip(b.as_ref().unwrap()) {
                assert!((a - b).abs() < 1e-6, "seed {seed}, q{c}: {a} and {b}");
            }
        }
    }
}

fn with_coordinates(model: &Model, change: impl Fn(usize, &Coordinate) -> Coordinate) -> Model {
    let coordinates = model.coordinates().iter().enumerate().map(|(i, c)| change(i, c)).collect();
    let (bodies, markers) = (model.bodies().to_vec(), model.markers().to_vec());
    Model::new("changed", model.gravity(), bodies, coordinates, markers).unwrap()
}

fn pins(r: &mut Random) -> Model {
    let model = random::chain_of(r, &[Kind::Free, Kind::Pin, Kind::Pin], Curves::Smooth);
    marked(r, &model)
}

#[test]
fn clamped_ranges_hold_and_others_do_not() {
    let mut r = Random::new(5);
    let model = pins(&mut r);
    let (knee, ankle) = (6, 7);
    let ranged = |clamped: bool| {
        with_coordinates(&model, |i, c| match i {
            i if i == knee => Coordinate { range: Some([-0.3, 0.3]), clamped, ..c.clone() },
            _ => c.clone(),
        })
    };
    let mut bent = State::rest(&model);
    (bent.q[knee], bent.q[ankle]) = (0.5, -0.4);
    let mut opposite = bent.clone();
    opposite.q[knee] = -0.6;
    let markers = recorded(&model, &[bent, opposite]);
    let value = |fit: &MarkerFit, frame: usize| fit.motion.columns[knee].as_ref().unwrap()[frame];
    let fit = |model: &Model, limits: JointLimits| {
        // The joint leaps by a radian in a hundredth of a second.
        let settings = FitSettings { limits, outliers: OutlierDetection::Off, ..FitSettings::default() };
        fit_markers(model, &markers, &settings, &mut Findings::default()).unwrap()
    };
    let held = fit(&ranged(true), JointLimits::Clamped);
    assert!((value(&held, 0) - 0.3).abs() < 1e-15 && (value(&held, 1) + 0.3).abs() < 1e-15, "{:?}", held.motion);
    assert!(held.converged.iter().all(|c| *c) && held.rms_m[0] > 0.001);
    for free in [fit(&ranged(true), JointLimits::Off), fit(&ranged(false), JointLimits::Clamped)] {
        assert!((value(&free, 0) - 0.5).abs() < 1e-8 && (value(&free, 1) + 0.6).abs() < 1e-8);
    }
    assert!((value(&fit(&ranged(false), JointLimits::Ranges), 0) - 0.3).abs() < 1e-15);

    // What the limit leaves is the best: no other posture inside the range is nearer.
    let locked = with_coordinates(&model, |i, c| match i {
        i if i == knee => Coordinate { default_value: 0.3, drive: Drive::Locked, ..c.clone() },
        _ => c.clone(),
    });
    let best = fit(&locked, JointLimits::Off);
    assert!((best.rms_m[0] - held.rms_m[0]).abs() < 1e-12, "{} and {}", best.rms_m[0], held.rms_m[0]);
}

#[test]
fn a_body_may_turn_further_than_the_range_of_its_root_and_keeps_count_over_a_gap() {
    let mut r = Random::new(11);
    let model = with_coordinates(&pins(&mut r), |i, c| match i {
        0 => Coordinate { range: Some([-3.2, 3.2]), clamped: true, ..c.clone() },
        _ => c.clone(),
    });
    let state = |i: u32| {
        let mut state = State::rest(&model);
        state.q[0] = 0.04 * f64::from(i);
        state
    };
    let states: Vec<State> = (0..200).map(state).collect();
    let mut markers = recorded(&model, &states);
    markers.markers.iter_mut().for_each(|m| m.positions[150..190].fill(Vec3::repeat(f64::NAN)));
    let fit = fitted(&model, &markers);
    let turn = fit.motion.columns[0].as_ref().unwrap();
    for i in (0..150).chain(190..200) {
        assert!((turn[i] - states[i].q[0]).abs() < 1e-7, "frame {i}: {} for {}", turn[i], states[i].q[0]);
    }
    assert!(turn[170].is_nan());
}

#[test]
fn markers_on_a_follower_tell_its_leader() {
    let mut r = Random::new(6);
    let model = pins(&mut r);
    let curve = Function::Polynomial(vec![0.3, 1.2, -0.1]);
    let coupled = with_coordinates(&model, |i, c| match i {
        7 => Coordinate { drive: Drive::Coupled(leader(&model), curve.clone()), ..c.clone() },
        _ => c.clone(),
    });
    let states: Vec<State> = (0..20)
        .map(|i| {
            let mut state = State::rest(&model);
            state.q[6] = 0.02 * i as f64 - 0.1;
            state.q[7] = curve.at(state.q[6])[0];
            state
        })
        .collect();
    let mut markers = recorded(&model, &states);
    markers.markers.retain(|m| !m.name.starts_with("m1_"));
    let fit = fitted(&coupled, &markers);
    for (frame, state) in states.iter().enumerate() {
        for c in [6, 7] {
            let found = fit.motion.columns[c].as_ref().unwrap()[frame];
            assert!((found - state.q[c]).abs() < 1e-8, "frame {frame}: {found} for {}", state.q[c]);
        }
    }
    // Uncoupled, two hinges have one angle to share only if they are not parallel; coupled, the follower obeys.
    assert_eq!(fit.motion.columns.iter().filter(|c| c.is_some()).count(), 8);
}

fn leader(model: &Model) -> CoordinateId {
    model.coordinate_ids().nth(6).unwrap()
}

#[test]
fn long_losses_stay_gaps_and_short_ones_are_bridged() {
    let mut r = Random::new(7);
    let model = pins(&mut r);
    let waves = Waves::new(&mut r, &model);
    let states: Vec<State> = (0..200).map(|i| waves.at(0.01 * f64::from(i))).collect();
    let whole = recorded(&model, &states);
    let mut cut = whole.clone();
    for marker in cut.markers.iter_mut().filter(|m| m.name.starts_with("m2_")) {
        for i in (40..60).chain(100..160) {
            marker.positions[i] = Vec3::repeat(f64::NAN);
        }
    }
    let mut findings = Findings::default();
    let fit = fit_markers(&model, &cut, &FitSettings::default(), &mut findings).unwrap();
    let last = fit.motion.columns[7].as_ref().unwrap();
    for (i, state) in states.iter().enumerate() {
        if (100..160).contains(&i) {
            assert!(last[i].is_nan(), "frame {i} of the long gap has a value");
        } else {
            // A wave of 3 rad/s and 0.8 rad has a jerk of 22 rad/s³: a parabola misses the middle of 0.2 s by 0.004
            // rad.
            let allowed = if (40..60).contains(&i) { 0.01 } else { 1e-8 };
            assert!((last[i] - state.q[7]).abs() < allowed, "frame {i}: {} for {}", last[i], state.q[7]);
        }
        let knee = fit.motion.columns[6].as_ref().unwrap()[i];
        assert!((knee - state.q[6]).abs() < 1e-8, "frame {i}: the joint above is untouched");
    }
    for code in [Code::MarkersGap, Code::MarkersBridged, Code::MarkersMissing] {
        assert!(findings.has(code), "{code}: {:?}", findings.as_slice());
    }
}

#[test]
fn an_instant_without_any_marker_is_bridged() {
    let mut r = Random::new(8);
    let model = pins(&mut r);
    let waves = Waves::new(&mut r, &model);
    let states: Vec<State> = (0..100).map(|i| waves.at(0.01 * f64::from(i))).collect();
    let mut cut = recorded(&model, &states);
    for marker in &mut cut.markers {
        (50..60).for_each(|i| marker.positions[i] = Vec3::repeat(f64::NAN));
        marker.positions[99] = Vec3::repeat(f64::NAN);
    }
    let fit = fitted(&model, &cut);
    for (c, column) in fit.motion.columns.iter().enumerate() {
        let column = column.as_ref().unwrap();
        assert!(column[99].is_nan(), "q{c} at the end");
        (50..60).for_each(|i| assert!((column[i] - states[i].q[c]).abs() < 0.01, "q{c}, frame {i}"));
    }
    assert!(fit.rms_m[55].is_nan() && fit.rms_m[49] < 1e-8);
}

#[test]
fn what_cannot_be_fitted_is_said() {
    let mut r = Random::new(9);
    let model = pins(&mut r);
    let good = recorded(&model, &[State::rest(&model)]);
    let error = |markers: &MarkerRecording, settings: &FitSettings| {
        fit_markers(&model, markers, settings, &mut Findings::default()).unwrap_err()
    };
    let mut blind = good.clone();
    blind.markers.iter_mut().skip(2).for_each(|m| m.positions[0] = Vec3::repeat(f64::NAN));
    assert!(matches!(error(&blind, &FitSettings::default()), FitError::TooFewMarkers { most: 2, .. }));
    let mut short = good.clone();
    short.markers[0].positions.clear();
    assert!(matches!(error(&short, &FitSettings::default()), FitError::Frames { found: 0, expected: 1, .. }));
    let weights = [("m0_0".to_owned(), -1.0)].into_iter().collect();
    assert!(error(&good, &FitSettings { weights, ..FitSettings::default() }).to_string().contains("weight of m0_0"));
    let longest_gap_s = f64::NAN;
    assert!(matches!(error(&good, &FitSettings { longest_gap_s, ..FitSettings::default() }), FitError::Setting { .. }));
    let held = with_coordinates(&model, |_, c| Coordinate { drive: Drive::Locked, ..c.clone() });
    let nothing = fit_markers(&held, &good, &FitSettings::default(), &mut Findings::default()).unwrap_err();
    assert!(matches!(nothing, FitError::NothingToFit { .. }));
    let empty = MarkerRecording { times: Vec::new(), markers: Vec::new(), ..good };
    assert!(matches!(error(&empty, &FitSettings::default()), FitError::NoCommonMarker { .. }));
}

#[test]
fn weights_decide_between_markers() {
    let mut r = Random::new(10);
    let model = random::chain_of(&mut r, &[Kind::Slider], Curves::Smooth);
    let body = model.body_ids().next();
    let marker = |name: &str| Marker { name: name.into(), body, location: Vec3::zeros(), fixed: false };
    let markers = vec![marker("a"), marker("b"), marker("c")];
    let model =
        Model::new("slider", Vec3::zeros(), model.bodies().to_vec(), model.coordinates().to_vec(), markers).unwrap();
    let mut recording = recorded(&model, &[State::rest(&model)]);
    let along = model.bodies()[0].joint.parent_from_joint.rotation * Vec3::x();
    recording.markers[0].positions[0] += along * 0.1;
    // Weight 3 at 0.1 m against weights 1 and 2 at 0.
    let weights = [("a".to_owned(), 3.0), ("c".to_owned(), 2.0)].into_iter().collect();
    let settings = FitSettings { weights, ..FitSettings::default() };
    let fit = fit_markers(&model, &recording, &settings, &mut Findings::default()).unwrap();
    assert!((fit.motion.columns[0].as_ref().unwrap()[0] - 0.05).abs() < 1e-12, "{:?}", fit.motion);
}
