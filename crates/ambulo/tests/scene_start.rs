//! The start of scenes: contradictory velocities, deep overlaps, and energy that rises.

use ambulo::dynamics::SolverSettings;
use ambulo::findings::{Code, Findings};
use ambulo::simulation::scene::{Scene, SceneFile, SceneSettings};
use ambulo::simulation::{WorldState, energy, start};

fn built(text: &str) -> (Scene, Findings) {
    let mut findings = Findings::default();
    let mut load = |path: &str| Err(format!("no file {path}"));
    let file = SceneFile::parse(text).unwrap_or_else(|e| panic!("{e}"));
    let scene = Scene::build(&file, SceneSettings::default(), &mut load, &mut findings).unwrap();
    (scene, findings)
}

/// A rod of 2 kg on a hinge 0.5 m from its centre, I = 0.3 kg.m², with this velocity of its centre and this angular
/// velocity.
fn hinged(integrator: &str, velocity: &str, turning: f64) -> String {
    format!(
        "step = 0.001\nduration = 0.2\ngravity = [0, 0, 0]\nintegrator = \"{integrator}\"\n\
         [[body]]\nname = \"rod\"\nmass = 2.0\ninertia = [0.3, 0.3, 0.3]\nposition = [0.5, 0, 0]\n\
         velocity = {velocity}\nangular_velocity = [0, 0, {turning}]\n\
         [[joint]]\nname = \"hinge\"\nkind = \"revolute\"\nparent = \"world\"\nchild = \"rod\"\nat = [0, 0, 0]\naxis = \
         [0, 0, 1]\n"
    )
}

#[test]
fn contradictory_velocities_start_as_if_the_joint_took_hold_with_an_impulse_in_both_integrators() {
    // Angular momentum about the hinge is kept: (I + m r²) ω = I ω⁻ + m r v⁻.
    let (mass, inertia, r, v, turning) = (2.0, 0.3, 0.5, 1.5, -4.0);
    let omega = (inertia * turning + mass * r * v) / (inertia + mass * r * r);
    let expected = 0.5 * (inertia + mass * r * r) * omega * omega;
    for integrator in ["impulse", "runge-kutta"] {
        let (mut scene, mut findings) = built(&hinged(integrator, "[0.7, 1.5, -0.3]", turning));
        assert!(findings.has(Code::StartContradictory), "{integrator}");
        let twist = scene.state().twists[0];
        assert!((twist.angular.z - omega).abs() < 1e-9 && (twist.linear.y - r * omega).abs() < 1e-9, "{twist:?}");
        let start = energy(scene.world(), scene.state()).total();
        assert!((start - expected).abs() < 1e-9 * expected, "{integrator}: {start} J, expected {expected} J");
        scene.run(&mut findings, |_| ()).unwrap();
        let now = energy(scene.world(), scene.state()).total();
        println!("{integrator}: {now:.9} J, expected {expected:.9} J");
        // A step h of impulses turns the hinge by ω h and loses (ω h)² of the energy at most; there are 200 of them.
        let steps = 200.0;
        let most = steps * (omega * 0.001).powi(2);
        assert!((now - expected).abs() < most.max(1e-9) * expected, "{integrator}: {now} J, expected {expected} J");
        assert!(!findings.has(Code::EnergyRose), "{integrator}");
    }
}

#[test]
fn a_body_whose_velocity_points_away_from_its_hinge_keeps_its_angular_momentum_about_it() {
    // 1 kg at 1 m from the hinge, I = 0.1 kg.m², v = (3, 4, 0) m/s, 1 rad/s: L = 0.1 + 4 = 4.1, energy L²/(2 (0.1 +
    // 1)) = 7.6409 J.
    for integrator in ["impulse", "runge-kutta"] {
        let text = format!(
            "step = 0.001\nduration = 0.01\ngravity = [0, 0, 0]\nintegrator = \"{integrator}\"\n\
             [[body]]\nname = \"ball\"\nmass = 1.0\ninertia = [0.1, 0.1, 0.1]\nposition = [1, 0, 0]\n\
             velocity = [3, 4, 0]\nangular_velocity = [0, 0, 1]\n\
             [[joint]]\nname = \"hinge\"\nkind = \"revolute\"\nparent = \"world\"\nchild = \"ball\"\nat = [0, 0, \
             0]\naxis = [0, 0, 1]\n"
        );
        let (scene, findings) = built(&text);
        let found = energy(scene.world(), scene.state()).total();
        assert!((found - 4.1 * 4.1 / 2.2).abs() < 1e-9, "{integrator}: {found} J");
        assert!(findings.has(Code::StartContradictory), "{integrator}");
    }
}

#[test]
fn a_world_without_a_scene_starts_the_same_way() {
    let text = hinged("impulse", "[3, 4, 0]", 1.0);
    let (scene, _) = built(&text);
    let mut contradictory = WorldState::new(scene.world());
    let given = energy(scene.world(), &contradictory).total();
    let mut findings = Findings::default();
    start(scene.world(), &mut contradictory, &SolverSettings::default(), &mut findings).unwrap();
    assert!(findings.has(Code::StartContradictory));
    assert!(energy(scene.world(), &contradictory).total() < given);
    for (own, of_scene) in contradictory.twists.iter().zip(&scene.state().twists) {
        assert!((own.linear - of_scene.linear).norm() < 1e-12 && (own.angular - of_scene.angular).norm() < 1e-12);
    }
}

#[test]
fn velocities_that_agree_with_the_joint_are_kept_to_the_bit() {
    let (scene, findings) = built(&hinged("runge-kutta", "[0, 1.5, 0]", 3.0));
    assert!(!findings.has(Code::StartContradictory), "{:?}", findings.as_slice());
    assert_eq!(scene.state().twists[0].linear.as_slice(), [0.0, 1.5, 0.0]);
}

/// A ball of 0.1 m radius above a plane.
fn ball(height: f64) -> String {
    format!(
        "step = 0.001\nduration = 0.3\n[material.wood]\nfriction = 0.4\n\
         [[obstacle]]\nname = \"floor\"\nkind = \"plane\"\nnormal = [0, 1, 0]\nat = [0, 0, 0]\nmaterial = \"wood\"\n\
         [[body]]\nname = \"ball\"\nmass = 1.0\nposition = [0, {height}, 0]\n\
         shape = {{ kind = \"sphere\", radius = 0.1, material = \"wood\" }}\n"
    )
}

#[test]
fn a_deep_overlap_at_the_start_is_reported_and_a_touch_is_not() {
    let (_, findings) = built(&ball(0.06));
    let message = &findings.as_slice()[0];
    assert!(message.code == Code::ContactDeepOverlap && message.message.contains("40.0 mm"), "{message:?}");
    for height in [0.0995, 0.1, 0.2] {
        let (_, findings) = built(&ball(height));
        assert!(findings.as_slice().is_empty(), "{height}: {:?}", findings.as_slice());
    }
}

#[test]
fn energy_that_rises_without_a_drive_is_reported_and_a_fall_is_not() {
    let (mut overlapping, mut findings) = built(&ball(0.06));
    overlapping.run(&mut findings, |_| ()).unwrap();
    assert!(findings.has(Code::EnergyRose), "lifted by 40 mm from rest: {:?}", findings.as_slice());
    let (mut falling, mut findings) = built(&ball(0.3));
    falling.run(&mut findings, |_| ()).unwrap();
    assert!(findings.as_slice().is_empty(), "{:?}", findings.as_slice());
}
