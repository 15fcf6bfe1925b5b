//! A caller follows the solver of a walk and stops it.

use crate::walks::MAN;
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Speed, Walk};
use ambulo::optimal::{Observer, OptimalWalk, OptimalWalkError, WalkConditions};
use ambulo::simulation::scene::{Scene, SceneFile, SceneSettings};
use ambulo::simulation::synthetic::{
    SyntheticError, SyntheticMode, SyntheticWalkSettings, synthesise, synthesise_observed,
};
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex};

/// A speed without a built-in plan, so that the solver has work.
fn gait() -> Gait {
    let mut gait = Gait::named("free").unwrap();
    gait.pace.speed = Some(Speed::MetersPerSecond(1.13));
    gait
}

fn settings(gait: &Gait, mode: SyntheticMode) -> SyntheticWalkSettings<'_> {
    SyntheticWalkSettings { gait, build: MAN, mode, cycles: 1, rate_hz: 100.0 }
}

/// An observer that stops at its call with this number, counted from 0, and the numbers of steps that it was told.
fn stopping_at(call: usize) -> (Observer, Arc<Mutex<Vec<usize>>>) {
    let told = Arc::new(Mutex::new(Vec::new()));
    let steps_told = Arc::clone(&told);
    let observer = Observer::new(move |steps| {
        let mut told = told.lock().unwrap();
        told.push(steps);
        if told.len() > call { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    (observer, steps_told)
}

#[test]
fn a_walk_ends_with_an_error_at_the_step_at_which_the_observer_stops_it() {
    let gait = gait();
    for mode in [SyntheticMode::Optimal, SyntheticMode::Predicted, SyntheticMode::Corrected, SyntheticMode::Physical] {
        let (observer, told) = stopping_at(7);
        let stopped = synthesise_observed(&settings(&gait, mode), &observer, &mut Findings::default());
        let expected = SyntheticError::Optimal(OptimalWalkError::Stopped { steps: 7 });
        assert_eq!(stopped.map(|walk| walk.report.speed), Err(expected), "{mode}");
        assert_eq!(*told.lock().unwrap(), (0..=7).collect::<Vec<_>>(), "{mode}");
    }
}

/// A cadence at which no walk is found is left out; one whose solver is stopped is not. The usual cadence takes about
/// 140 of 370 steps.
#[test]
fn a_search_of_the_cadence_is_stopped_at_a_neighbouring_one() {
    let walk = Walk::new(&gait(), MAN.human().unwrap().dimensions.leg_length, &mut Findings::default()).unwrap();
    let (observer, told) = stopping_at(250);
    let stopped = OptimalWalk::predict_freely(&MAN, &walk, &WalkConditions::default(), &observer);
    assert_eq!(stopped.map(|(_, walk)| walk), Err(OptimalWalkError::Stopped { steps: 250 }));
    assert_eq!(told.lock().unwrap().len(), 251);
}

#[test]
fn an_observer_is_told_every_step_once_and_changes_nothing() {
    let gait = gait();
    for mode in [SyntheticMode::Optimal, SyntheticMode::Corrected] {
        let (observer, told) = stopping_at(usize::MAX);
        let settings = settings(&gait, mode);
        let observed = synthesise_observed(&settings, &observer, &mut Findings::default()).unwrap();
        let alone = synthesise(&settings, &mut Findings::default()).unwrap();
        assert_eq!(observed.trajectory.columns(), alone.trajectory.columns(), "{mode}");
        assert_eq!(format!("{:?}", observed.loads), format!("{:?}", alone.loads), "{mode}");
        let told = told.lock().unwrap();
        assert!(told.len() > 20, "{mode}: {} steps", told.len());
        assert!(told.iter().copied().eq(0..told.len()), "{mode}: {told:?}");
    }
}

#[test]
fn a_scene_is_not_built_when_the_observer_stops_the_plan_of_a_figure() {
    let text = "step = 0.001\nduration = 1.0\n[[figure]]\nname = \"ann\"\nwalk = { speed = 1.13 }\n\
        build = { table = \"de-leva-female\", mass = 60, height = 1.65 }\n";
    let (observer, _) = stopping_at(3);
    let settings = SceneSettings { observer, ..SceneSettings::default() };
    let mut no_files = |path: &str| Err(path.to_owned());
    let file = SceneFile::parse(text).unwrap();
    let error = Scene::build(&file, settings, &mut no_files, &mut Findings::default()).unwrap_err().to_string();
    assert!(error.ends_with("the solver was stopped after 3 steps"), "{error}");
}
