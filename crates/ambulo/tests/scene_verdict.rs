//! Verdicts on figures of a scene that follow a recording.

use crate::shared_data::data;
use ambulo::analysis::feasibility::{Check, Thresholds, VerdictState};
use ambulo::dynamics::{Workspace, inverse};
use ambulo::findings::Findings;
use ambulo::simulation::scene::{FigureMotion, FigureRecord, Scene, SceneFile, SceneSettings};
use ambulo::simulation::{FigureVerdict, scene_verdict};

/// A scene with a Gait2392 figure that follows a recorded walk, after it has run.
fn walked(settings: &str, figure: &str) -> Option<Scene> {
    let folder = data()?.join("opensim-gait2392-subject01");
    let text = format!(
        "{settings}[[figure]]\nname = \"walker\"\nmodel = \"subject01_simbody.osim\"\n\
         motion = \"subject01_walk1_ik.mot\"\nfrom = 1.0\n{figure}"
    );
    let mut findings = Findings::default();
    let mut load = |path: &str| std::fs::read(folder.join(path)).map_err(|e| format!("{path}: {e}"));
    let file = SceneFile::parse(&text).unwrap_or_else(|e| panic!("{e}"));
    let mut scene = Scene::build(&file, SceneSettings::default(), &mut load, &mut findings).unwrap();
    scene.run(&mut findings, |_| ()).unwrap();
    Some(scene)
}

fn verdict(scene: &Scene) -> FigureVerdict {
    let found = scene_verdict(scene, &Thresholds::default(), &mut Findings::default()).unwrap();
    found.expect("a verdict").figures.remove(0)
}

fn motion(scene: &Scene) -> FigureMotion {
    match scene.records().unwrap().remove(0) {
        FigureRecord::Motion(motion) => *motion,
        FigureRecord::Walk(_) => panic!("a walk"),
    }
}

/// Largest and mean generalised force on the root [N, N.m] that remain after the scene's forces on the figure. The
/// first step is left out: driven coordinates have their velocity there, and the recording has no place before it that
/// tells their acceleration.
fn residual(motion: &FigureMotion) -> [f64; 2] {
    let forces = inverse(&mut Workspace::new(&motion.model), &motion.trajectory, &motion.loads);
    let root = motion.model.bodies().iter().find(|body| body.joint.parent.is_none()).unwrap().joint.coordinates();
    let remaining = root.iter().flat_map(|id| &forces.generalized[id.index()][1..]).map(|force| force.abs());
    let count = remaining.clone().count() as f64;
    [remaining.clone().fold(0.0, f64::max), remaining.sum::<f64>() / count]
}

const FLOOR: &str =
    "[[obstacle]]\nname = \"floor\"\nkind = \"plane\"\nnormal = [0, 1, 0]\nat = [0, 0, 0]\nmaterial = \"shoe\"\n";

/// Spheres under heels and toes.
fn spheres() -> String {
    let sphere = |body: &str, at: &str| {
        format!("[[figure.sphere]]\nbody = \"{body}\"\nat = {at}\nradius = 0.02\nmaterial = \"shoe\"\n")
    };
    let sides = ["r", "l"].map(|side| {
        sphere(&format!("calcn_{side}"), "[0.02, 0, 0]") + &sphere(&format!("toes_{side}"), "[0.04, 0, 0]")
    });
    sides.concat()
}

#[test]
fn what_the_scene_does_to_a_figure_with_a_free_root_leaves_no_residual() {
    let material = "[material.shoe]\nfriction = 0.8\n";
    let figure = format!("root = \"free\"\nat = [0, 0.05, 0]\n{}", spheres());
    let mut found = Vec::new();
    for step in [0.0005, 0.00025] {
        let settings = format!("step = {step}\nduration = 0.3\n{material}{FLOOR}");
        let Some(scene) = walked(&settings, &figure) else { return };
        let motion = motion(&scene);
        assert!(!motion.ground.is_empty(), "the feet must meet the floor");
        let weight = motion.model.mass() * 9.80665;
        found.push(residual(&motion).map(|force| force / weight));
    }
    let [[worst, coarse], [_, fine]] = [found[0], found[1]];
    println!(
        "residual of the root: {worst:.1e} body weights at worst, {coarse:.1e} on average, {fine:.1e} with half the \
         step"
    );
    // Steps are of first order; the worst one is the impact of a foot.
    assert!(worst < 0.02 && coarse < 1e-3 && fine < 0.6 * coarse, "{found:?}");
}

#[test]
fn a_loop_and_a_bag_that_pull_at_a_figure_leave_no_residual() {
    // Moments of a loop about a wrong point, or with the wrong sign, would leave most of the weight.
    let bag = "[[body]]\nname = \"bag\"\nmass = 5.0\ninertia = [0.1, 0.1, 0.1]\nposition = [0, 0.5, 0]\n";
    let hook = "[[closure]]\nname = \"hook\"\nkind = \"ball\"\nfirst = \"walker/torso\"\nsecond = \"world\"\nat = [0, \
        1.4, 0]\n";
    let strap = "[[closure]]\nname = \"strap\"\nkind = \"ball\"\nfirst = \"bag\"\nsecond = \"walker/pelvis\"\nat = [0, \
        0.7, 0]\n";
    let settings = format!("step = 0.0005\nduration = 0.3\n{bag}{hook}{strap}");
    let Some(scene) = walked(&settings, "root = \"free\"\n") else { return };
    let motion = motion(&scene);
    assert_eq!(motion.loads.len(), 2, "torso and pelvis");
    let [worst, mean] = residual(&motion).map(|force| force / (motion.model.mass() * 9.80665));
    println!("residual of the root: {worst:.1e} body weights at worst, {mean:.1e} on average");
    assert!(worst < 0.02 && mean < 1e-3, "{worst} {mean}");
}

#[test]
fn a_figure_that_is_carried_along_by_nothing_is_not_called_feasible() {
    let Some(scene) = walked("step = 0.001\nduration = 0.6\n", "root = \"driven\"\n") else { return };
    let found = verdict(&scene);
    println!("{:?}: {:?} {:?}", found.verdict.state, found.verdict.reasons.first(), found.verdict.undecided);
    assert_ne!(found.verdict.state, VerdictState::Feasible);
}

#[test]
fn a_walk_that_begins_above_the_floor_is_infeasible() {
    let settings = format!("step = 0.001\nduration = 0.8\n[material.shoe]\nfriction = 0.8\n{FLOOR}");
    let figure = format!("root = \"free\"\nat = [0, 0.6, 0]\n{}", spheres());
    let Some(scene) = walked(&settings, &figure) else { return };
    let found = verdict(&scene);
    let first = found.verdict.reasons.first();
    println!("{:?}: {first:?}", found.verdict.state);
    assert_eq!(found.verdict.state, VerdictState::Infeasible);
}

/// A 60 kg bag that hangs at the right foot of a walker.
const BAG_AT_FOOT: &str = "[[body]]\nname = \"bag\"\nmass = 60.0\ninertia = [0.5, 0.5, 0.5]\nposition = [0, 1.0, 0]\n\
     [[closure]]\nname = \"strap\"\nkind = \"ball\"\nfirst = \"bag\"\nsecond = \"walker/calcn_r\"\nat = [0, 1.0, 0]\n";

#[test]
fn a_leg_that_swings_a_heavy_bag_is_infeasible_through_its_strength() {
    let checks = |bag: &str| -> Option<Vec<Check>> {
        let settings = format!("step = 0.001\nduration = 0.8\n[material.shoe]\nfriction = 0.8\n{FLOOR}{bag}");
        let scene = walked(&settings, &format!("root = \"driven\"\n{}", spheres()))?;
        let found = verdict(&scene);
        println!(
            "{:?}: {:?}",
            found.verdict.state,
            found.verdict.reasons.iter().map(|r| &r.message).collect::<Vec<_>>()
        );
        Some(found.verdict.reasons.iter().map(|reason| reason.check).collect())
    };
    let Some(with_bag) = checks(BAG_AT_FOOT) else { return };
    assert!(with_bag.contains(&Check::Strength), "{with_bag:?}");
    let without = checks("").unwrap();
    assert!(!without.contains(&Check::Strength), "{without:?}");
}

/// Coordinates of a Gait2392 figure without the root.
const DRIVEN: [&str; 12] = [
    "hip_flexion",
    "hip_adduction",
    "hip_rotation",
    "knee_angle",
    "subtalar_angle",
    "mtp_angle",
    "hip_flexion",
    "hip_adduction",
    "hip_rotation",
    "knee_angle",
    "subtalar_angle",
    "mtp_angle",
];

#[test]
fn passive_joints_beside_driven_ones_carry_no_moment_in_a_recorded_figure() {
    // Ankles turn about oblique axes and the trunk about three; nothing holds them, so their moments are zero in the
    // recorded motion.
    let sided = DRIVEN.iter().enumerate().map(|(k, name)| format!("\"{name}_{}\"", if k < 6 { "r" } else { "l" }));
    let figure = format!("root = \"free\"\ndrive = [{}]\n", sided.collect::<Vec<_>>().join(", "));
    let passive = ["ankle_angle_r", "ankle_angle_l", "lumbar_extension", "lumbar_bending", "lumbar_rotation"];
    let mut found = Vec::new();
    for step in [0.0005, 0.00025] {
        let Some(scene) = walked(&format!("step = {step}\nduration = 0.2\n"), &figure) else { return };
        let motion = motion(&scene);
        let forces = inverse(&mut Workspace::new(&motion.model), &motion.trajectory, &motion.loads);
        let largest = |name: &str| {
            let id = motion.model.coordinate(name).unwrap();
            forces.generalized[id.index()][1..].iter().fold(0.0_f64, |most, moment| most.max(moment.abs()))
        };
        let [free, driven] = [passive.map(largest).into_iter().fold(0.0, f64::max), largest("hip_flexion_r")];
        println!("step {step} s: {free:.2e} N.m in passive joints, {driven:.1} N.m in the hip");
        assert!(largest("knee_angle_r") > 1.0 && driven > 1.0);
        let state = verdict(&scene).verdict.state;
        assert_ne!(state, VerdictState::Feasible, "a figure that falls freely");
        found.push(free / driven);
    }
    // First order in the step.
    assert!(found[0] < 0.02 && found[1] < 0.6 * found[0], "{found:?}");
}
