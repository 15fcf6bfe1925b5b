//! Simulated scenes: the examples agree with their comments; joints, closures and figures follow the scene.

use crate::shared_data::data;
use ambulo::analysis::{AnalysisSettings, analyse};
use ambulo::findings::{Code, Findings};
use ambulo::model::Model;
use ambulo::motion::{Smoother, Window, coordinates_from_table};
use ambulo::simulation::scene::{RunError, Scene, SceneError, SceneFile, SceneFrame, SceneSettings};
use ambulo::spatial::Vec3;
use ambulo_formats::table::Table;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

const G: f64 = 9.80665;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples")
}

/// A scene of `examples/`, or one of the library's own.
fn path_of(name: &str) -> PathBuf {
    let own = folder().join(name);
    let library = Path::new(env!("CARGO_MANIFEST_DIR")).join("../ambulo-paper/data/scenes").join(name);
    if own.is_file() { own } else { library }
}

fn build_in(folder: &Path, text: &str, changes: SceneSettings) -> Result<(Scene, Findings), SceneError> {
    let mut findings = Findings::default();
    let mut load = |path: &str| std::fs::read(folder.join(path)).map_err(|e| format!("{path}: {e}"));
    let scene = Scene::build(&SceneFile::parse(text)?, changes, &mut load, &mut findings)?;
    Ok((scene, findings))
}

fn scene(text: &str) -> Scene {
    build_in(Path::new(""), text, SceneSettings::default()).unwrap_or_else(|e| panic!("{e}")).0
}

fn refusal(text: &str) -> String {
    build_in(Path::new(""), text, SceneSettings::default())
        .err()
        .map_or_else(|| panic!("a bad scene"), |e| e.to_string())
}

/// An example, shortened to `duration_s`.
fn example(name: &str, duration_s: f64) -> Scene {
    let text = std::fs::read_to_string(path_of(name)).unwrap();
    let changes = SceneSettings { duration_s: Some(duration_s), ..SceneSettings::default() };
    build_in(&folder(), &text, changes).unwrap_or_else(|e| panic!("{name}: {e}")).0
}

/// Simulates to the end; returns the findings.
fn run(scene: &mut Scene, visit: impl FnMut(&SceneFrame<'_>)) -> Findings {
    let mut findings = Findings::default();
    scene.run(&mut findings, visit).unwrap();
    findings
}

#[test]
fn a_visit_may_stop_the_simulation() {
    let (mut scene, mut seen) = (example("pendulum.toml", 1.0), 0);
    let stopped = scene.run_while(&mut Findings::default(), |_| {
        seen += 1;
        if seen == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert!(matches!(stopped, Err(RunError::Stopped { time_s }) if time_s > 0.0 && time_s < 0.9), "{stopped:?}");
    assert_eq!(seen, 3);
}

fn body(scene: &Scene, name: &str) -> usize {
    scene.world().bodies.iter().position(|body| body.name == name).unwrap_or_else(|| panic!("no body {name}"))
}

fn place(scene: &Scene, name: &str) -> Vec3 {
    scene.state().poses[body(scene, name)].translation
}

fn speed(scene: &Scene, name: &str) -> f64 {
    scene.state().twists[body(scene, name)].linear.norm()
}

fn joint(scene: &Scene, name: &str) -> usize {
    scene.world().joints.iter().position(|joint| joint.name == name).unwrap_or_else(|| panic!("no joint {name}"))
}

#[test]
fn the_pendulum_swings_with_the_period_of_its_amplitude() {
    let mut scene = example("pendulum.toml", 3.0);
    let (mut last, mut crossings) = (None::<(f64, f64)>, Vec::new());
    let mut energies = Vec::new();
    run(&mut scene, |frame| {
        let state = frame.scene.state();
        let now = (state.time_s, state.coordinates[0][0]);
        if let Some(before) = last.filter(|(_, angle)| *angle > 0.0 && now.1 <= 0.0) {
            crossings.push(before.0 + (now.0 - before.0) * before.1 / (before.1 - now.1));
        }
        last = Some(now);
        energies.push(frame.energy.total());
    });
    // Amplitude a: T = T0 (1 + a²/16 + 11 a⁴/3072 + ...), the next term 3e-5; l = 0.5 m, inertia 0.020833 + m l²/4.
    let a: f64 = 30.0_f64.to_radians();
    let t0 = std::f64::consts::TAU * ((0.020833 + 0.0625) / (G * 0.25)).sqrt();
    let period = t0 * (1.0 + a * a / 16.0 + 11.0 * a.powi(4) / 3072.0);
    assert!((crossings[1] - crossings[0] - period).abs() < 1e-4, "{crossings:?}, expected {period}");
    let drift = energies.iter().map(|e| (e - energies[0]).abs()).fold(0.0, f64::max);
    assert!(drift < 1e-9, "{drift} J");
}

#[test]
fn the_top_precesses_and_nods_as_lagranges_equations_have_it() {
    let mut scene = example("top.toml", 4.0);
    let (mut turned, mut last, mut lowest) = (0.0, None::<f64>, 1.0_f64);
    run(&mut scene, |frame| {
        let p = frame.scene.state().poses[0].translation;
        let angle = f64::atan2(p.z, -p.x);
        let step = last
            .map_or(0.0, |last| (angle - last + 9.0).rem_euclid(std::f64::consts::TAU) - 9.0 + std::f64::consts::TAU);
        turned += if step > 3.0 { step - std::f64::consts::TAU } else { step };
        last = Some(angle);
        lowest = lowest.min(p.y);
    });
    // Integrated from Lagrange's equations: 1.6925568 rad/s, 21.477179 degrees.
    assert!((turned.abs() / 4.0 - 1.692_556_8).abs() < 1e-4, "{} rad/s", turned / 4.0);
    assert!(((lowest / 0.1).acos().to_degrees() - 21.477_179).abs() < 0.01, "{}", (lowest / 0.1).acos().to_degrees());
}

#[test]
fn of_two_blocks_on_a_slope_one_rests_and_one_slides_with_coulombs_acceleration() {
    let mut scene = example("slope.toml", 0.5);
    let starts = [place(&scene, "staying block"), place(&scene, "sliding block")];
    run(&mut scene, |_| {});
    let a = G * (20.0_f64.to_radians().sin() - 0.2 * 20.0_f64.to_radians().cos());
    assert!((place(&scene, "staying block") - starts[0]).norm() < 1e-6);
    // Places in the file are rounded to a micrometre, which the first step takes back.
    assert!((speed(&scene, "sliding block") - a * 0.5).abs() < 1e-5, "{}", speed(&scene, "sliding block"));
    // First order in time: half a step more.
    let way = (place(&scene, "sliding block") - starts[1]).norm();
    assert!((way - 0.5 * a * 0.5 * 0.501).abs() < 3e-6, "{way}");
}

#[test]
fn ten_balls_come_to_rest_in_the_bin_without_gaining_energy() {
    let mut scene = example("pile.toml", 2.2);
    let mut energies = Vec::new();
    run(&mut scene, |frame| energies.push(frame.energy.total()));
    for pair in energies.windows(2) {
        assert!(pair[1] <= pair[0] + 1e-6, "{} J after {} J", pair[1], pair[0]);
    }
    for k in 1..=10 {
        let (p, v) = (place(&scene, &format!("ball {k}")), speed(&scene, &format!("ball {k}")));
        assert!(p.x.abs() < 0.152 && p.z.abs() < 0.152 && p.y > 0.098 && p.y < 0.55, "ball {k} at {p:?}");
        assert!(v < 1e-6, "ball {k} moves with {v} m/s");
    }
}

#[test]
fn the_crank_makes_full_turns_and_the_rocker_swings() {
    let mut scene = example("four-bar.toml", 2.1);
    let (crank, rocker) = (joint(&scene, "motor"), joint(&scene, "rocker pivot"));
    let (mut angles, mut gap) = ((f64::MAX, f64::MIN), 0.0_f64);
    let findings = run(&mut scene, |frame| {
        let angle = frame.scene.state().coordinates[rocker][0].to_degrees();
        angles = (angles.0.min(angle), angles.1.max(angle));
        gap = gap.max(frame.scene.largest_joint_error());
    });
    // The revolute closure holds three directions that the plane of the other hinges holds already.
    let codes: Vec<Code> = findings.as_slice().iter().map(|f| f.code).collect();
    assert_eq!(codes, [Code::ClosureRedundant], "{:?}", findings.as_slice());
    assert!((scene.state().coordinates[crank][0].to_degrees() - 780.0).abs() < 1e-9);
    // After whole turns the rocker is where it was. Its extremes, from crank and coupler in line: law of cosines in the
    // triangle of frame 0.4, rocker 0.3 and 0.25 or 0.45.
    let at = |reach: f64| (180.0 - ((0.16 + 0.09 - reach * reach) / 0.24_f64).acos().to_degrees()) - 102.890_327;
    assert!(scene.state().coordinates[rocker][0].abs().to_degrees() < 1e-3);
    assert!((angles.1 - at(0.25)).abs() < 0.05 && (angles.0 - at(0.45)).abs() < 0.05, "{angles:?}");
    assert!(gap < 1e-6, "{gap} m");
}

#[test]
fn the_ladder_swings_as_one_and_its_loops_stay_closed() {
    let mut scene = example("ladder.toml", 0.3);
    let first = place(&scene, "rung 20");
    let mut gap = 0.0_f64;
    let findings = run(&mut scene, |frame| gap = gap.max(frame.scene.largest_joint_error()));
    assert!(findings.as_slice().is_empty(), "{:?}", findings.as_slice());
    let last = place(&scene, "rung 20");
    // Seen from the side it is symmetric; it falls towards hanging.
    assert!(last.y < first.y && last.x < first.x && last.z.abs() < 1e-9, "{last:?}");
    assert!(gap < 1e-5, "{gap} m");
}

#[test]
fn the_arm_pushes_the_box_along_the_floor() {
    let mut scene = example("pusher.toml", 1.7);
    run(&mut scene, |_| {});
    let p = place(&scene, "box");
    assert!((p - Vec3::new(0.6, 0.1, 0.0)).norm() < 1e-3, "{p:?}");
}

#[test]
fn friction_lifts_and_holds_the_box() {
    let mut scene = example("grasp.toml", 2.8);
    let slide = joint(&scene, "left slide");
    let mut pressed = Vec::new();
    let findings = run(&mut scene, |frame| {
        if let (Some(forces), true) = (&frame.forces, frame.scene.state().time_s > 0.7) {
            pressed.push(forces.efforts[slide][0]);
        }
    });
    // The limit of a finger is what it is meant to press with.
    assert!(findings.as_slice().is_empty(), "{:?}", findings.as_slice());
    let p = place(&scene, "box");
    assert!((p - Vec3::new(0.0, 0.34, 0.0)).norm() < 1e-6 && speed(&scene, "box") < 1e-6, "{p:?}");
    assert!(pressed.iter().all(|force| (force - 20.0).abs() < 1e-6), "the fingers press with 20 N");
    // A drive that gives way does not creep on through what holds it: the finger stops at the box.
    assert!((place(&scene, "left finger").x + 0.04).abs() < 1e-9, "{:?}", place(&scene, "left finger"));
}

#[test]
fn a_gripper_too_weak_for_its_own_fingers_is_reported() {
    // 0.2 kg reach 25 mm in 0.6 s with at most 0.08 N; the fingers get less, and touch nothing but air.
    let text = std::fs::read_to_string(path_of("grasp.toml")).unwrap();
    let weak = text.replace("drive_max = 20 ", "drive_max = 0.01 ");
    let changes = SceneSettings { duration_s: Some(0.4), ..SceneSettings::default() };
    let (mut scene, _) = build_in(&folder(), &weak, changes).unwrap();
    let findings = run(&mut scene, |_| {});
    assert!(findings.has(Code::DriveAtLimit), "{:?}", findings.as_slice());
}

#[test]
fn without_friction_the_box_stays_on_the_table() {
    let text = std::fs::read_to_string(path_of("grasp.toml")).unwrap();
    let slippery = text.replace("friction = 0.8", "friction = 0.0");
    let changes = SceneSettings { duration_s: Some(1.8), ..SceneSettings::default() };
    let (mut scene, _) = build_in(&folder(), &slippery, changes).unwrap();
    run(&mut scene, |_| {});
    assert!((place(&scene, "box").y - 0.04).abs() < 1e-6 && place(&scene, "palm").y > 0.2);
}

#[test]
fn hands_meet_hold_and_let_go() {
    let mut scene = example("hands.toml", 3.0);
    let (left, right) = (body(&scene, "left hand"), body(&scene, "right hand"));
    // Where the left tip is in each hand, known once they hold.
    let (mut gap, mut held, mut first_seen, mut last_seen, mut together) = (0.0_f64, 0, f64::NAN, f64::NAN, Vec::new());
    run(&mut scene, |frame| {
        let (state, t) = (frame.scene.state(), frame.scene.state().time_s);
        let Some(forces) = frame.forces.as_ref().filter(|f| !f.closing.is_empty()) else { return };
        held += 1;
        first_seen = if held == 1 { t } else { first_seen };
        last_seen = t;
        gap = gap.max(frame.scene.closure_gap(0));
        together.push((state.poses[left].translation - state.poses[right].translation).norm());
        assert!(forces.closing[0].1.force.norm() < 200.0);
    });
    assert!((first_seen - 1.0).abs() < 1e-9 && (last_seen - 2.49).abs() < 1e-9, "{first_seen} to {last_seen}");
    assert!(gap < 1e-9, "the point that both hold splits by {gap} m");
    assert!(together.iter().all(|distance| *distance < 0.16), "{together:?}");
    assert!((place(&scene, "left hand") - place(&scene, "right hand")).norm() > 0.3, "they have let go");
}

/// A body on each kind of joint, turned and offset, all with rates.
const JOINTED: &str = r#"
step = 0.001
duration = 0.2
gravity = [0, 0, 0]
[[body]]
name = "a"
mass = 1
inertia = [0.1, 0.2, 0.15]
position = [0.3, 0.1, -0.2]
rotation = { axis = [1, 2, 3], angle_deg = 50 }
[[joint]]
name = "j"
parent = "world"
child = "a"
"#;

#[test]
fn coordinates_begin_as_they_are_called_and_move_along_their_axes() {
    let ways = [
        ("kind = \"revolute\"\nat = [0, 0, 0]\naxis = [1, 1, 0]\ncoordinate = { start = 0.4, rate = 0.5 }", vec![0.4]),
        ("kind = \"prismatic\"\naxis = [1, 1, 0]\ncoordinate = { start = 0.4, rate = 0.5 }", vec![0.4]),
        (
            "kind = \"universal\"\nat = [0, 0, 0]\naxis = [1, 0, 0]\nsecond_axis = [0, 0, 1]\ncoordinate = \
             [{ start = 0.4 }, { start = -0.2, rate = 0.5 }]",
            vec![0.4, -0.2],
        ),
        ("kind = \"ball\"\nat = [0, 0, 0]\ncoordinate = [{ start = 0.4, rate = 0.5 }]", vec![0.4, 0.0, 0.0]),
        // The file turns first, the simulator slides first.
        (
            "kind = \"planar\"\naxis = [0, 1, 0]\ncoordinate = [{ start = 0.4, rate = 0.5 }, { start = 2 }, \
             { start = 3 }]",
            vec![2.0, 3.0, 0.4],
        ),
        ("kind = \"free\"\ncoordinate = [{ start = 0.4, rate = 0.5 }]", vec![0.4, 0.0, 0.0, 0.0, 0.0, 0.0]),
    ];
    for (way, values) in ways {
        let mut scene = scene(&format!("{JOINTED}{way}\n"));
        let start = scene.state().clone();
        let near = start.coordinates[0].iter().zip(&values).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(near && scene.largest_joint_error() < 1e-15, "{way}: {:?}", start.coordinates);
        let rates = start.rates(&scene.world().joints[0]);
        let moving = rates.iter().filter(|rate| (*rate - 0.5).abs() < 1e-12).count();
        assert!(
            moving == 1 && rates.iter().filter(|rate| rate.abs() < 1e-12).count() == rates.len() - 1,
            "{way}: {rates:?}"
        );
        for joint in &scene.world().joints {
            for frame in [joint.parent_from_joint, joint.child_from_joint] {
                assert!((frame.rotation.determinant() - 1.0).abs() < 1e-12, "{way}");
            }
        }
        run(&mut scene, |_| {});
        assert!(scene.largest_joint_error() < 1e-12, "{way}");
    }
}

#[test]
fn driven_joints_begin_at_their_drives_and_carry_their_children() {
    let text = r#"
step = 0.001
duration = 0.1
[[body]]
name = "upper"
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [0.5, 0, 0]
[[body]]
name = "lower"
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [1.5, 0, 0]
[[joint]]
name = "shoulder"
kind = "revolute"
parent = "world"
child = "upper"
at = [0, 0, 0]
axis = [0, 0, 1]
coordinate = { drive_deg = { points = [[0, 400], [1, 490]] } }
[[joint]]
name = "elbow"
kind = "revolute"
parent = "upper"
child = "lower"
at = [1, 0, 0]
axis = [0, 0, -1]
coordinate = { rate = 1 }
"#;
    let mut scene = scene(text);
    let rate = 90.0_f64.to_radians();
    assert!((scene.state().coordinates[0][0] - 400.0_f64.to_radians()).abs() < 1e-12);
    let twists = &scene.state().twists;
    assert!((twists[0].linear - Vec3::new(0.0, 0.5 * rate, 0.0)).norm() < 1e-12, "{twists:?}");
    assert!((twists[1].angular.z - (rate - 1.0)).abs() < 1e-12, "the elbow's axis points against z");
    assert!((twists[1].linear.y - (rate + 0.5 * (rate - 1.0))).abs() < 1e-12);
    run(&mut scene, |_| {});
    assert!((scene.state().coordinates[0][0].to_degrees() - 409.0).abs() < 1e-9);
}

#[test]
fn a_joint_that_lets_go_leaves_its_child_to_fall() {
    let text = r#"
step = 0.001
duration = 0.5
[[body]]
name = "a"
mass = 1
inertia = [0.1, 0.1, 0.1]
[[body]]
name = "b"
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [0, -1, 0]
[[joint]]
name = "first"
kind = "weld"
parent = "world"
child = "a"
[[joint]]
name = "second"
kind = "revolute"
parent = "a"
child = "b"
at = [0, -0.5, 0]
axis = [0, 0, 1]
coordinate = { limits = { lower = 0 }, friction = 0.1 }
[[event]]
time = 0.1
remove = "first"
[[event]]
time = 0.2
remove = "second"
"#;
    let mut scene = scene(text);
    run(&mut scene, |_| {});
    assert!(scene.world().joints.is_empty());
    // Both fall from rest for 0.4 s.
    let way = 0.5 * G * 0.4 * 0.4;
    assert!((place(&scene, "a").y + way).abs() < 1e-9 && (place(&scene, "b").y + 1.0 + way).abs() < 1e-9);
}

#[test]
fn closures_hold_from_world_or_body_and_connected_bodies_do_not_touch() {
    let text = r#"
step = 0.001
duration = 0.3
[[body]]
name = "a"
mass = 1
position = [0, 1, 0]
shape = { kind = "sphere", radius = 0.3 }
[[body]]
name = "b"
mass = 1
position = [0, 0.5, 0]
shape = { kind = "sphere", radius = 0.3 }
[[closure]]
name = "nail"
kind = "weld"
first = "world"
second = "a"
at = [0, 1, 0]
[[closure]]
name = "hook"
kind = "universal"
first = "a"
second = "b"
at = [0, 0.7, 0]
axis = [1, 0, 0]
second_axis = [0, 0, 1]
"#;
    let mut scene = scene(text);
    let mut points = 0;
    run(&mut scene, |frame| points += frame.forces.as_ref().map_or(0, |forces| forces.contacts.len()));
    assert_eq!(points, 0, "the overlapping balls are hooked together");
    assert!((place(&scene, "b") - Vec3::new(0.0, 0.5, 0.0)).norm() < 1e-9, "{:?}", place(&scene, "b"));
}

#[test]
fn soft_shapes_without_a_radius_are_warned_about() {
    let text = r#"
step = 0.001
duration = 0.01
material.foam = { law = "hunt-crossley" }
[[obstacle]]
name = "mat"
kind = "plane"
material = "foam"
[[body]]
name = "brick"
mass = 1
position = [0, 1, 0]
shape = { kind = "box", size = [0.1, 0.1, 0.1] }
"#;
    let (_, findings) = build_in(Path::new(""), text, SceneSettings::default()).unwrap();
    assert!(findings.has(Code::ContactNotRound), "{:?}", findings.as_slice());
}

#[test]
fn a_figure_that_a_scene_leaves_free_must_have_joints_that_the_simulator_knows() {
    // A knee whose translations follow its angle by splines.
    let Some(data) = data() else { return };
    let folder = data.join("opensim-gait2392-subject01");
    let text = "step = 0.001\nduration = 0.1\n[[figure]]\nname = \"doll\"\nmodel = \"subject01_simbody.osim\"\n";
    let error = build_in(&folder, text, SceneSettings::default()).err().unwrap().to_string();
    assert!(error.starts_with("line 3, `figure[1]`: found the joint `knee_r`"), "{error}");
    assert!(error.contains("hint: drive all coordinates of the joint, or none"), "{error}");
    let text = "step = 0.001\nduration = 0.1\n[[body]]\nname = \"a\"\nmass = 1\ninertia = [1, 1, 1]\n[[joint]]\nname = \
        \"j\"\n\
                kind = \"weld\"\nparent = \"doll/head\"\nchild = \"a\"\n[[figure]]\nname = \"doll\"\nmodel = \
                \"no.osim\"\n";
    assert!(refusal(text).starts_with("line 14, `figure[1].model`: no.osim"));
}

/// Largest difference of any force between a scene that drives the recorded figure and inverse dynamics of the
/// recording, by coordinate, with the largest force. `late` frames of the recording are half a millisecond each.
fn against_inverse_dynamics(folder: &Path, figure: &str, settings: &str, late: usize) -> Vec<(String, f64, f64)> {
    let text = format!(
        "{settings}duration = 0.6\noutput_rate = 60\n[[figure]]\nname = \"walker\"\nmodel = \
         \"subject01_simbody.osim\"\n\
         motion = \"subject01_walk1_ik.mot\"\nfrom = 1.0\nroot = \"driven\"\n{figure}"
    );
    let (mut scene, _) = build_in(folder, &text, SceneSettings::default()).unwrap();
    let mut rows: Vec<(f64, Vec<f64>)> = Vec::new();
    run(&mut scene, |frame| {
        if let Some(forces) = &frame.forces {
            let forces = &frame.scene.generalized_forces(forces)[0];
            rows.push((frame.scene.state().time_s, forces.iter().map(|[_, _, force]| *force).collect()));
        }
    });
    let mut findings = Findings::default();
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let model = Model::from_osim(&read("subject01_simbody.osim"), &mut findings).unwrap();
    let (table, _) = Table::read_storage(&read("subject01_walk1_ik.mot")).unwrap();
    let motion = coordinates_from_table(&model, &table, "recording", &mut findings).unwrap();
    let rate_hz = Some(2000.0);
    let window = Window { from_s: Some(1.0), to_s: Some(1.7) };
    let asked = AnalysisSettings { smoother: Smoother::Off, force_filter: None, window, rate_hz, instrumented: None };
    let analysis = analyse(&model, &motion, &[], asked, &mut findings).unwrap();
    let grid = analysis.trajectory.grid();
    let mut found = Vec::new();
    for (k, name) in model.force_names().into_iter().enumerate() {
        let (mut difference, mut largest) = (0.0_f64, 0.0_f64);
        for (time_s, forces) in &rows {
            let at = 1.0 + time_s;
            let frame = ((at - grid.start_s) / grid.step_s).round() as usize;
            assert!((grid.time(frame) - at).abs() < 1e-9);
            let expected = analysis.forces.generalized[k][frame + late];
            difference = difference.max((forces[k] - expected).abs());
            largest = largest.max(expected.abs());
        }
        found.push((name, difference, largest));
    }
    found
}

#[test]
fn a_driven_figure_needs_the_efforts_of_inverse_dynamics() {
    let Some(data) = data() else { return };
    let folder = data.join("opensim-gait2392-subject01");
    let moved = "at = [1, 0.5, -2]\nrotation = { axis = [0, 1, 0], angle_deg = 40 }\n";
    let worst = |method: &str, late: usize, figure: &str| {
        let settings = format!("step = 0.001\nintegrator = \"{method}\"\n");
        let found = against_inverse_dynamics(&folder, figure, &settings, late);
        let worst = found.iter().map(|(_, difference, largest)| difference / largest.max(1.0)).fold(0.0, f64::max);
        println!("{method}, {late} frames late, {figure:?}: differs by {worst:.2e} of a coordinate's largest force");
        worst
    };
    // The same equations at the time of the row: rounding of sums of some hundred terms. Impulses place the bodies by
    // steps.
    assert!(worst("runge-kutta", 0, "") < 1e-12 && worst("runge-kutta", 0, moved) < 1e-12);
    assert!(worst("impulse", 0, "") < 1e-9);
    // A time that is off by half a step of this unfiltered recording shows.
    assert!(worst("impulse", 1, "") > 1e-3);
}
