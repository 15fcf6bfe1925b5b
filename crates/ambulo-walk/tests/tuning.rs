//! Gains of a controller found by trial.

use ambulo_walk::control::{ControlSettings, WalkController};
use ambulo_walk::findings::Findings;
use ambulo_walk::optimal::Observer;
use ambulo_walk::scene::{ControlledFigure, SceneFile};
use ambulo_walk::tuning::{Gain, Push, PushSettings, PushUse, TrialOutcome, Tuning, TuningProblem};

/// A figure of a scene with long time steps, so that its maps and trials are quick.
fn controlled(control: &str) -> ControlledFigure {
    let text = format!(
        "step = 0.004\nduration = 8.0\n[[figure]]\nname = \"ann\"\nwalk = {{ speed = 1.2 }}\n\
     build = {{ table = \"de-leva-female\", mass = 60, height = 1.65 }}\n{control}\n"
    );
    let mut none = |path: &str| -> Result<Vec<u8>, String> { Err(path.to_owned()) };
    let file = SceneFile::parse(&text).unwrap();
    ControlledFigure::of(&file, Some("ann"), &mut none, &Observer::default(), &mut Findings::default()).unwrap()
}

#[test]
fn gains_are_tuned_along_the_plan_of_a_scene() {
    let figure = controlled("control = { stiffness = 150, damping = 0.08 }");
    let gains = Gain::usual(false);
    let of = |figure: &ControlledFigure| {
        TuningProblem::new(&figure.human, &figure.plan, figure.step, &figure.settings, &gains).unwrap()
    };
    let problem = of(&figure);

    // A controller from the maps of another impedance is the one that is made anew.
    let mut other = ControlSettings { stiffness: 250.0, ..figure.settings.clone() };
    other.costs.height = 0.02;
    let own = problem.controller(&other).unwrap();
    let anew = WalkController::new(&figure.human, &figure.plan, figure.step, &other).unwrap();
    // Differences across contacts that change within them are not exactly linear, so gains are compared together.
    let stiffness = |controller: &WalkController| -> Vec<f64> {
        figure.human.model.coordinate_ids().map(|id| controller.largest_stiffness(id)).collect()
    };
    let (found, expected) = (stiffness(&own), stiffness(&anew));
    let apart: f64 = found.iter().zip(&expected).map(|(a, b)| (a - b).powi(2)).sum();
    let size: f64 = expected.iter().map(|x| x * x).sum();
    println!("gains of other maps differ by {:.2e} of their size", (apart / size).sqrt());
    assert!(apart <= 5e-3_f64.powi(2) * size, "{found:?} instead of {expected:?}");

    // The settings at the origin of the search are those of the scene with the digits that are written; others are
    // within bounds and cost their distance.
    let (same, outside) = problem.settings_at(&[0.0; 8]);
    let is_near = |gain: &Gain| (gain.value(&same) / gain.value(&figure.settings) - 1.0).abs() < 5e-4;
    assert!(gains.iter().all(is_near) && outside == 0.0, "{same:?} {outside}");
    // Gains are judged without recovery steps, which the scene has again.
    let written = |settings: &ControlSettings| {
        let again = controlled(&Gain::table(settings, None, &gains)).settings;
        assert!(again.recovery_steps && !settings.recovery_steps);
        ControlSettings { recovery_steps: false, ..again }
    };
    assert_eq!(written(&same), same);
    let (far, outside) = problem.settings_at(&[9.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    assert!(
        (far.stiffness - 300.0).abs() < 1e-9 && (outside - (9.0 - 2_f64.ln()).powi(2)).abs() < 1e-9,
        "{far:?} {outside}"
    );

    // What the tuner writes is what a scene reads.
    let (tuned, _) = problem.settings_at(&[0.1, -0.2, 0.3, -0.4, 0.5, -0.6, 0.7, -0.8]);
    assert_eq!(written(&tuned), tuned);

    // Large pushes end in falls, small ones do not; the search keeps what is best.
    let pushes = PushSettings { seed: 1, force_n: 60.0, count: 1, all_around: false };
    let set = pushes.pushes(PushUse::Choice);
    let outcome = |force_n: f64| {
        let set: Vec<Push> = set.iter().map(|push| Push { force_n, ..*push }).collect();
        problem.outcome(&figure.settings, &set).unwrap()
    };
    let [small, large] = [outcome(60.0), outcome(1500.0)];
    println!("{small:?}\n{large:?}");
    assert!((small.survived, large.survived) == (3, 0) && small.cost < 0.5 && large.cost > 1.0);
    let mut tuning = Tuning::new(&gains, pushes);
    let tasks = tuning.ask(&problem);
    let costs = tasks.iter().enumerate().map(|(k, _)| TrialOutcome { cost: 1.0 + k as f64, ..small });
    tuning.tell(&tasks, &costs.collect::<Vec<_>>());
    let mean = tuning.mean(&problem);
    assert!(mean.point != tasks[0].point && tuning.best() == tuning.start() && tuning.evaluations() == tasks.len());
    tuning.judge(&mean, TrialOutcome { cost: 2.0, ..small });
    assert_eq!(tuning.best(), tuning.start());
    tuning.judge(&mean, TrialOutcome { cost: 0.5, ..small });
    assert_eq!(tuning.best().unwrap().point, mean.point);
    assert!(tuning.is_valid(8) && !tuning.is_valid(7));
}
