//! Coordinates that are held near values while markers are fitted.
//!
//! Three markers at a distance of 1 m from a hinge, recorded at the angle t: the cost of the markers is 2 (1 - cos(q -
//! t)), whatever their weights, and with a task k (q - a)² the angle solves sin(t - q) = k (q - a).

use ambulo::findings::{Code, Findings};
use ambulo::kinematics::marker_fit::{
    CoordinateTask, FitError, FitSettings, OutlierDetection, TaskTarget, fit_markers,
};
use ambulo::model::{Model, from_osim};
use ambulo::motion::{MarkerPath, MarkerRecording};
use ambulo::spatial::Vec3;
use ambulo_formats::osim::OsimModel;

const RECORDED: f64 = 0.6;
/// The iteration ends when a step is below 1e-7 rad, and its convergence is quadratic.
const ALLOWED: f64 = 1e-7;

/// A bar on a hinge about z, with a default angle of 0.2 rad; a second hinge has no marker.
fn hinge() -> Model {
    let pin = |name: &str, parent: &str, default: f64| {
        format!(
            "<PinJoint \
             name=\"{name}\"><socket_parent_frame>{parent}</socket_parent_frame><socket_child_frame>\
             /bodyset/{name}</socket_child_frame>\
             <coordinates><Coordinate \
             name=\"q_{name}\"><default_value>{default}</default_value></Coordinate></coordinates></PinJoint>"
        )
    };
    let marker = |name: &str, place: &str| {
        format!(
            "<Marker \
             name=\"{name}\"><socket_parent_frame>/bodyset/bar</socket_parent_frame><location>{place}</location>\
             </Marker>"
        )
    };
    let text = format!(
        "<OpenSimDocument Version=\"40000\"><Model name=\"hinge\"><BodySet><objects><Body \
         name=\"bar\"><mass>1</mass></Body>\
         <Body name=\"end\"><mass>1</mass></Body></objects></BodySet><JointSet><objects>{}{}</objects></JointSet>\
         <MarkerSet><objects>{}{}{}</objects></MarkerSet></Model></OpenSimDocument>",
        pin("bar", "/ground", 0.2),
        pin("end", "/bodyset/bar", 0.0),
        marker("a", "1 0 0"),
        marker("b", "0 1 0"),
        marker("c", "-1 0 0.3"),
    );
    from_osim(&OsimModel::read(text.as_bytes()).unwrap(), &mut Findings::default()).unwrap()
}

fn recording(model: &Model) -> MarkerRecording {
    let turned = |p: Vec3| {
        Vec3::new(p.x * RECORDED.cos() - p.y * RECORDED.sin(), p.x * RECORDED.sin() + p.y * RECORDED.cos(), p.z)
    };
    let path = |m: &ambulo::model::Marker| MarkerPath { name: m.name.clone(), positions: vec![turned(m.location); 3] };
    let markers = model.markers().iter().map(path).collect();
    MarkerRecording { name: "bar".into(), rate_hz: 10.0, times: vec![0.0, 0.1, 0.2], markers }
}

fn task(coordinate: &str, weight: f64, target: TaskTarget) -> CoordinateTask {
    CoordinateTask { coordinate: coordinate.into(), weight, target }
}

fn fit(tasks: Vec<CoordinateTask>, weight: f64, findings: &mut Findings) -> Result<Vec<f64>, FitError> {
    let model = hinge();
    let weights = model.markers().iter().map(|m| (m.name.clone(), weight)).collect();
    let settings = FitSettings { weights, tasks, outliers: OutlierDetection::Labels, ..FitSettings::default() };
    let fit = fit_markers(&model, &recording(&model), &settings, findings)?;
    Ok(fit.motion.columns[0].clone().unwrap())
}

/// The angle that solves sin(t - q) = k (q - a), by bisection.
fn expected(k: f64, a: f64) -> f64 {
    let (mut low, mut high) = (a.min(RECORDED), a.max(RECORDED));
    for _ in 0..60 {
        let q = 0.5 * (low + high);
        if (RECORDED - q).sin() > k * (q - a) { low = q } else { high = q }
    }
    low
}

fn assert_near(found: &[f64], expected: &[f64]) {
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < ALLOWED), "{found:?} for {expected:?}");
}

#[test]
fn a_task_holds_a_coordinate_by_its_weight_whatever_the_weights_of_the_markers() {
    for (weight, k) in [(1.0, 0.5), (40.0, 0.5), (0.1, 3.0)] {
        let found = fit(vec![task("q_bar", k, TaskTarget::Value(0.0))], weight, &mut Findings::default()).unwrap();
        assert_near(&found, &[expected(k, 0.0); 3]);
    }
    let free = fit(vec![task("q_bar", 0.0, TaskTarget::Value(0.0))], 1.0, &mut Findings::default()).unwrap();
    assert_near(&free, &[RECORDED; 3]);
}

#[test]
fn the_target_may_be_the_default_or_change_over_time() {
    let default = fit(vec![task("q_bar", 0.5, TaskTarget::Default)], 1.0, &mut Findings::default()).unwrap();
    assert_near(&default, &[expected(0.5, 0.2); 3]);
    let samples = TaskTarget::Samples { times: vec![0.1, 0.2], values: vec![0.0, 0.4] };
    let moving = fit(vec![task("q_bar", 0.5, samples)], 1.0, &mut Findings::default()).unwrap();
    assert_near(&moving, &[0.0, 0.0, 0.4].map(|a| expected(0.5, a)));
}

#[test]
fn tasks_that_cannot_be_followed_are_reported() {
    let mut findings = Findings::default();
    let tasks = vec![task("q_tail", 1.0, TaskTarget::Default), task("q_end", 1.0, TaskTarget::Value(0.3))];
    assert_near(&fit(tasks, 1.0, &mut findings).unwrap(), &[RECORDED; 3]);
    let messages: Vec<&str> = findings.as_slice().iter().map(|f| f.message.as_str()).collect();
    assert!(findings.has(Code::MarkersTask), "{messages:?}");
    assert!(messages.iter().any(|m| m.contains("no coordinate `q_tail`")), "{messages:?}");
    assert!(messages.iter().any(|m| m.contains("no marker moves with `q_end`")), "{messages:?}");
    let mut fine = Findings::default();
    fit(vec![task("q_end", 1.0, TaskTarget::Default)], 1.0, &mut fine).unwrap();
    assert!(!fine.has(Code::MarkersTask));
}

#[test]
fn markers_without_a_task_are_counted() {
    let (model, mut findings) = (hinge(), Findings::default());
    let mut recording = recording(&model);
    recording.markers.push(MarkerPath { name: "x".into(), positions: vec![Vec3::zeros(); 3] });
    let settings = FitSettings { weights: [("b".to_owned(), 0.0)].into(), ..FitSettings::default() };
    // Two markers may be too few for a fit; which are common is reported before.
    let _ = fit_markers(&model, &recording, &settings, &mut findings);
    let expected = "2 of 4 markers of `bar` are on the model and are fitted; 1 more have the weight 0 and are not \
        fitted; 1 only in the recording: x";
    let messages: Vec<&str> = findings.as_slice().iter().map(|f| f.message.as_str()).collect();
    assert!(messages.contains(&expected), "{messages:?}");
}

#[test]
fn impossible_tasks_are_rejected() {
    let of = |task| fit(vec![task], 1.0, &mut Findings::default()).unwrap_err().to_string();
    let heavy = of(task("q_bar", -1.0, TaskTarget::Default));
    assert!(heavy.contains("weight of q_bar") && heavy.contains("zero or more"), "{heavy}");
    let odd = of(task("q_bar", 1.0, TaskTarget::Value(f64::NAN)));
    assert!(odd.contains("value of q_bar") && odd.contains("finite"), "{odd}");
    let none = of(task("q_bar", 1.0, TaskTarget::Samples { times: vec![0.0], values: Vec::new() }));
    assert!(none.contains("values of q_bar"), "{none}");
}
