//! Checks of a scene while it runs: what goes wrong is reported, and what does not is not.
//!
//! | claim                                                                     | tolerance and its reason                      |
//! |---------------------------------------------------------------------------|-----------------------------------------------|
//! | a fast ball rebounds from a thin wall where it meets it                    | 0.05 m: twice half of ball and wall            |
//! | a body that moves further in a step than its own size is named            | -                                             |
//! | a closure that cannot close is named, one that closes is not              | -                                             |
//! | the energy is watched after events                                        | -                                             |
//! | Runge-Kutta names the constraints that its stages violate                 | -                                             |
//! | a step of few bodies has bounded work                                     | 20,000 iterations                             |

use crate::shared_data::data;
use ambulo::findings::{Code, Findings};
use ambulo::simulation::scene::{RunStatistics, Scene, SceneFile, SceneSettings};

/// A scene that was run to its end, with its findings.
fn run(text: &str, duration_s: Option<f64>) -> (Scene, RunStatistics, Findings) {
    let mut findings = Findings::default();
    let mut no_files = |path: &str| Err(format!("{path}: this scene names no files"));
    let settings = SceneSettings { duration_s, ..SceneSettings::default() };
    let file = SceneFile::parse(text).unwrap();
    let mut scene = Scene::build(&file, settings, &mut no_files, &mut findings).unwrap();
    let statistics = scene.run(&mut findings, |_| ()).unwrap();
    (scene, statistics, findings)
}

fn message(findings: &Findings, code: Code) -> Option<&str> {
    findings.as_slice().iter().find(|finding| finding.code == code).map(|finding| finding.message.as_str())
}

fn ball_and_wall(speed: f64) -> String {
    format!(
        "step = 0.001\nduration = 0.5\ngravity = [0, 0, 0]\n[material.m]\nfriction = 0.0\nrestitution = 1\n\
         [[obstacle]]\nname = \"wall\"\nkind = \"box\"\nsize = [0.01, 2, 2]\nat = [1, 0, 0]\nmaterial = \"m\"\n\
         [[body]]\nname = \"ball\"\nmass = 1\nvelocity = [{speed}, 0, 0]\n\
         shape = {{ kind = \"sphere\", radius = 0.02, material = \"m\" }}\n"
    )
}

#[test]
fn a_fast_ball_rebounds_from_a_thin_wall_and_is_named() {
    for speed in [50.0, 90.0, 333.0] {
        let (scene, _, findings) = run(&ball_and_wall(speed), None);
        let found = scene.state().poses[0].translation.x;
        // The ball meets the wall when its surface does, at 1 - 0.005 - 0.02 m.
        let expected = 0.975 - (0.5 * speed - 0.975);
        // It may overlap by half of both, 0.025 m, before it rebounds, and returns from there.
        assert!((found - expected).abs() < 0.05 + 1e-6, "{speed}: {found}, expected {expected}");
        let message = message(&findings, Code::BodyTooFast).unwrap();
        assert!(message.contains("`ball`") && message.contains("`wall`"), "{message}");
    }
    let (scene, _, findings) = run(&ball_and_wall(5.0), None);
    assert!(scene.state().twists[0].linear.x < 0.0);
    assert_eq!(findings.as_slice(), []);
}

/// A body on a hinge and one that is held; an event connects them. The hinge is 0.5 m from the origin, the other end of
/// the body 0.8 m from the hinge.
fn connected(at_m: f64) -> String {
    format!(
        "step = 0.01\nduration = 6\n[[body]]\nname = \"a\"\nmass = 1\ninertia = [1, 1, 1]\n[[body]]\nname = \"b\"\n\
         mass = 1\nposition = [{at_m}, 0, 0]\ninertia = [1, 1, 1]\n[[joint]]\nname = \"h\"\nkind = \"revolute\"\n\
         parent = \"world\"\nchild = \"a\"\nat = [0.5, 0, 0]\naxis = [0, 0, 1]\n[[closure]]\nname = \"c\"\n\
         kind = \"ball\"\nfirst = \"a\"\nsecond = \"b\"\non_first = [-0.3, 0, 0]\non_second = [0, 0, 0]\n\
         active = false\n[[closure]]\nname = \"w\"\nkind = \"ball\"\nfirst = \"b\"\nsecond = \"world\"\n\
         at = [{at_m}, 0, 0]\n[[event]]\ntime = 0.5\nadd = \"c\"\n"
    )
}

#[test]
fn a_closure_that_cannot_close_is_named_with_its_gap_and_one_that_closes_is_not() {
    let (_, _, open) = run(&connected(3.0), None);
    let found = message(&open, Code::ClosureOpen).unwrap();
    assert!(found.contains("`c`") && found.contains(" m apart"), "{found}");
    // Also if the run ends before it would have closed.
    let (_, _, early) = run(&connected(3.0), Some(2.0));
    assert!(message(&early, Code::ClosureOpen).is_some());
    // The end of the body reaches everything 0.8 m from the hinge.
    let (_, _, closed) = run(&connected(1.3), None);
    assert_eq!(message(&closed, Code::ClosureOpen), None);
    assert_eq!(message(&closed, Code::EnergyRose), None);
}

fn case(name: &str) -> Option<String> {
    Some(std::fs::read_to_string(data()?.join("cases").join(name)).unwrap())
}

#[test]
fn the_energy_is_watched_although_a_scene_has_events() {
    let (Some(stiff), Some(heavy)) =
        (case("attack-event-energy/sc_20141.toml"), case("attack-event-energy/sc_30807.toml"))
    else {
        return;
    };
    for text in [stiff, heavy] {
        assert!(message(&run(&text, None).2, Code::EnergyRose).is_some());
    }
    // A pendulum that is released falls, and gains nothing.
    let released = "step = 0.001\nduration = 1\n[[body]]\nname = \"bob\"\nmass = 1\ninertia = [0.1, 0.1, 0.1]\n\
        position = [1, 0, 0]\n[[joint]]\nname = \"hinge\"\nkind = \"revolute\"\nparent = \"world\"\nchild = \"bob\"\n\
        at = [0, 0, 0]\naxis = [0, 0, 1]\n[[event]]\ntime = 0.4\nremove = \"hinge\"\n";
    assert_eq!(run(released, None).2.as_slice(), []);
}

#[test]
fn runge_kutta_names_the_constraints_that_its_steps_violate() {
    for name in ["sc_20080", "sc_30139", "sc_30342"] {
        let Some(text) = case(&format!("attack-runge-kutta-unsaid/{name}.toml")) else { return };
        let (_, statistics, findings) = run(&text, None);
        assert!(statistics.not_converged > 0 && message(&findings, Code::SolverNotConverged).is_some(), "{name}");
    }
}

#[test]
fn a_step_of_few_bodies_has_bounded_work() {
    let Some(text) = case("attack-slow-scenes/sc_20294.toml") else { return };
    let (_, statistics, findings) = run(&text, Some(2.0));
    println!("{statistics:?} {findings:?}");
    assert!(statistics.most_iterations < 20_000, "{statistics:?}");
}
