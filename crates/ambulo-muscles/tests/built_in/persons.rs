//! The set on bodies of several sizes, sides and shapes, and models that cannot have it.

use crate::muscle_models::{State, load};
use ambulo_body::model::anthropometry::{Build, SegmentTable};
use ambulo_body::model::full_body::full_body;
use ambulo_body::model::{BodyId, Model, Side};
use ambulo_body::numerics::elementary::sin;
use ambulo_body::spatial::Vec3;
use ambulo_muscles::built_in::{BuiltInError, muscle_set};
use ambulo_muscles::path::PathWorkspace;
use ambulo_muscles::set::{MuscleSet, PointPlace};
use ambulo_muscles::wrap::WrapRule;

const ADULT: Build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };

fn body(build: Build) -> Model {
    full_body(&build).unwrap().model
}

/// A posture in the middle of the ranges of walking; mirrored postures have the same angles on the other side.
fn posture(model: &Model, seed: f64, is_mirrored: bool) -> State {
    let angle = |name: &str| {
        let (side, stem) = Side::split_name(name).unwrap();
        let side = if is_mirrored { side.other() } else { side };
        let turn = sin(seed + name.len() as f64 + if side == Side::Right { 0.0 } else { 2.0 });
        match stem.as_str() {
            "knee_angle" => -0.6 + 0.5 * turn,
            "hip_flexion" => 0.2 + 0.4 * turn,
            _ => 0.15 * turn,
        }
    };
    let value = |name: &str| if Side::split_name(name).is_some() { angle(name) } else { 0.0 };
    let q: Vec<f64> = model.coordinates().iter().map(|c| value(&c.name)).collect();
    let qd = vec![0.0; q.len()];
    State::new(q, qd)
}

fn paths(model: &Model, set: &MuscleSet, state: &State) -> PathWorkspace {
    let mut paths = PathWorkspace::new(model, set, WrapRule::Exact);
    paths.update(state.posture());
    paths
}

/// The largest moment arm of each muscle about each coordinate [m].
fn arms(model: &Model, paths: &PathWorkspace) -> Vec<Vec<f64>> {
    (0..paths.muscles()).map(|i| model.coordinate_ids().map(|id| paths.arm(i, id)).collect()).collect()
}

#[test]
fn a_built_in_body_has_43_muscles_a_leg_and_motors_elsewhere() {
    let model = body(ADULT);
    let set = muscle_set(&model).unwrap();
    assert_eq!(set.muscles.len(), 86);
    let on = |side: &str| set.muscles.iter().filter(|muscle| muscle.name.ends_with(side)).count();
    assert_eq!([on("_r"), on("_l")], [43, 43]);
    let motors: Vec<&str> =
        set.actuators.iter().map(|motor| model.coordinates()[motor.coordinate.index()].name.as_str()).collect();
    assert_eq!(
        motors,
        [
            "lumbar_extension",
            "lumbar_bending",
            "lumbar_rotation",
            "mtp_angle_r",
            "mtp_angle_l",
            "arm_flex_r",
            "arm_add_r",
            "arm_rot_r",
            "elbow_flex_r",
            "pro_sup_r",
            "arm_flex_l",
            "arm_add_l",
            "arm_rot_l",
            "elbow_flex_l",
            "pro_sup_l",
            "subtalar_angle_r",
            "subtalar_angle_l"
        ]
    );
    assert!(set.wraps.is_empty());
}

#[test]
fn both_legs_are_mirror_images() {
    let model = body(ADULT);
    let set = muscle_set(&model).unwrap();
    let (own, other) = (posture(&model, 0.3, false), posture(&model, 0.3, true));
    let [own, other] = [own, other].map(|state| paths(&model, &set, &state));
    let counterpart = |name: &str| {
        let (side, stem) = Side::split_name(name).unwrap();
        format!("{stem}_{}", side.other().letter())
    };
    let mut compared = 0;
    for (i, muscle) in set.muscles.iter().enumerate() {
        let twin = set.muscles.iter().position(|m| m.name == counterpart(&muscle.name)).unwrap();
        assert!((own.lengths()[i] - other.lengths()[twin]).abs() < 1e-12, "{}", muscle.name);
        let strength = |i: usize| set.muscles[i].parameters.max_isometric_force;
        assert!((strength(i) - strength(twin)).abs() < 1e-9, "{}", muscle.name);
        for id in own.coordinates(i) {
            let name = &model.coordinates()[id.index()].name;
            let mirrored = model.coordinate(&counterpart(name)).unwrap();
            assert!((own.arm(i, *id) - other.arm(twin, mirrored)).abs() < 1e-12, "{} {name}", muscle.name);
            compared += 1;
        }
        // In the same posture both legs differ.
        assert!((own.lengths()[i] - own.lengths()[twin]).abs() > 1e-6, "{}", muscle.name);
    }
    assert!(compared > 200, "{compared}");
}

/// Lengths of a figure of the same shape are proportional to its stature.
#[test]
fn a_person_of_twice_the_size_has_twice_the_paths_arms_fibres_and_tendons() {
    let bodies = [(20.0, 1.0), (160.0, 2.0)].map(|(mass, height)| body(Build { mass, height, ..ADULT }));
    let sets = [0, 1].map(|i| muscle_set(&bodies[i]).unwrap());
    let state = posture(&bodies[0], 0.7, false);
    let [of_small, of_large] = [0, 1].map(|i| paths(&bodies[i], &sets[i], &state));
    let (a, b) = (arms(&bodies[0], &of_small), arms(&bodies[1], &of_large));
    // The muscle volume of both legs by mass and stature [cm³].
    let volume = |model: &Model| 47.05 * model.mass() * model.stature().height_m + 1289.6;
    for (i, (small, large)) in sets[0].muscles.iter().zip(&sets[1].muscles).enumerate() {
        assert!((of_large.lengths()[i] - 2.0 * of_small.lengths()[i]).abs() < 1e-12, "{}", small.name);
        assert!(a[i].iter().zip(&b[i]).all(|(a, b)| (b - 2.0 * a).abs() < 1e-12), "{}", small.name);
        let (small, large) = (&small.parameters, &large.parameters);
        assert!((large.optimal_fiber_length - 2.0 * small.optimal_fiber_length).abs() < 1e-12);
        assert!((large.tendon_slack_length - 2.0 * small.tendon_slack_length).abs() < 1e-12);
        let ratio = large.max_isometric_force / small.max_isometric_force;
        assert!((ratio - 0.5 * volume(&bodies[1]) / volume(&bodies[0])).abs() < 1e-9, "{ratio}");
    }
}

#[test]
fn moment_arms_are_the_derivative_of_length() {
    const STEP: f64 = 1e-3;
    let model = body(ADULT);
    let set = muscle_set(&model).unwrap();
    let mut worst = 0.0_f64;
    for seed in [0.1, 1.9, 4.0] {
        let state = posture(&model, seed, false);
        let found = arms(&model, &paths(&model, &set, &state));
        for id in model.coordinate_ids() {
            let at = |steps: f64| {
                let mut moved = state.clone();
                moved.q[id.index()] += steps * STEP;
                paths(&model, &set, &moved).lengths().to_vec()
            };
            let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(at);
            for i in 0..set.muscles.len() {
                // Five-point difference.
                let slope = (a[i] - 8.0 * b[i] + 8.0 * c[i] - d[i]) / (12.0 * STEP);
                worst = worst.max((found[i][id.index()] + slope).abs());
            }
        }
    }
    println!("largest difference {worst:.1e} m");
    assert!(worst < 1e-9, "{worst}");
}

/// From a child to a tall adult flexors flex and extensors extend, and fibres have lengths at which they exert force.
#[test]
fn muscles_of_every_size_act_as_their_names_say() {
    const ACTIONS: [(&str, &str, f64); 12] = [
        ("iliacus", "hip_flexion", 1.0),
        ("rect_fem", "hip_flexion", 1.0),
        ("glut_max2", "hip_flexion", -1.0),
        ("semiten", "hip_flexion", -1.0),
        ("glut_med2", "hip_adduction", -1.0),
        ("add_long", "hip_adduction", 1.0),
        ("vas_lat", "knee_angle", 1.0),
        ("rect_fem", "knee_angle", 1.0),
        ("semimem", "knee_angle", -1.0),
        ("med_gas", "knee_angle", -1.0),
        ("soleus", "ankle_angle", -1.0),
        ("tib_ant", "ankle_angle", 1.0),
    ];
    for (mass, height) in [(12.0, 0.85), (30.0, 1.35), (58.0, 1.62), (75.0, 1.75), (110.0, 2.05)] {
        let model = body(Build { mass, height, ..ADULT });
        let set = muscle_set(&model).unwrap();
        let paths = paths(&model, &set, &posture(&model, 1.1, false));
        for (muscle, stem, sign) in ACTIONS {
            for side in ["r", "l"] {
                let i = set.muscles.iter().position(|m| m.name == format!("{muscle}_{side}")).unwrap();
                let arm = paths.arm(i, model.coordinate(&format!("{stem}_{side}")).unwrap());
                assert!(sign * arm > 0.005 * height, "{muscle} {stem} {side} at {height} m: {arm}");
            }
        }
        for (muscle, length) in set.muscles.iter().zip(paths.lengths()) {
            let fiber = (length - muscle.parameters.tendon_slack_length) / muscle.parameters.optimal_fiber_length;
            assert!((0.3..1.7).contains(&fiber), "{} at {height} m: {fiber}", muscle.name);
        }
    }
}

/// A planar figure has two legs with hinges, without rotations of the hips. Without toe joint, points of the toes
/// belong to the foot, and the ball of the foot is where it is on the reference.
#[test]
fn a_planar_figure_without_toe_joints_has_the_muscles_too() {
    let human = Build { toe_joint: false, ..ADULT }.human().unwrap();
    let set = muscle_set(&human.model).unwrap();
    assert_eq!(set.muscles.len(), 86);
    let spatial = body(ADULT);
    let reference = muscle_set(&spatial).unwrap();
    let still = |model: &Model| State::new(vec![0.0; model.coordinates().len()], vec![0.0; model.coordinates().len()]);
    let (own, other) = (paths(&human.model, &set, &still(&human.model)), paths(&spatial, &reference, &still(&spatial)));
    let is_toes = |body: BodyId| spatial.bodies()[body.index()].name.starts_with("toes");
    for (i, muscle) in set.muscles.iter().enumerate() {
        let on_toes = reference.muscles[i].path.points.iter().any(|point| point.body.is_some_and(is_toes));
        // The ball of a foot of the reference is 10 mm further forward than that of the segment table.
        let allowed = if on_toes { 0.015 } else { 1e-12 };
        assert!((own.lengths()[i] - other.lengths()[i]).abs() < allowed, "{}", muscle.name);
    }
}

#[test]
fn a_model_with_sliding_knees_or_without_legs_is_refused() {
    let pendulum = {
        let human = body(ADULT);
        let arm = human.bodies()[0].clone();
        let coordinates = human.coordinates()[..6].to_vec();
        Model::new("block", Vec3::new(0.0, -9.81, 0.0), vec![arm], coordinates, Vec::new()).unwrap()
    };
    assert_eq!(
        muscle_set(&pendulum).unwrap_err().to_string(),
        "the model `block` has no pelvis with two legs; expected both for the built-in muscles"
    );
    let Some(gait2392) = load("gait2392") else { return };
    let error = muscle_set(&gait2392.model).unwrap_err();
    assert!(matches!(error, BuiltInError::Knee { side: Side::Right, .. }), "{error}");
    assert!(error.to_string().contains("models of OpenSim bring their own muscles"), "{error}");
}

/// Conditional points have no end where the coordinate of Gait2392's knee ends.
#[test]
fn a_hyperextended_knee_loses_no_point_of_a_path() {
    let model = body(ADULT);
    let set = muscle_set(&model).unwrap();
    let ends = |muscle: &str| {
        let found = set.muscles.iter().find(|m| m.name == muscle).unwrap();
        let ranges = found.path.points.iter().filter_map(|point| match point.place {
            PointPlace::Conditional { range, .. } => Some(range),
            _ => None,
        });
        ranges.collect::<Vec<[f64; 2]>>()
    };
    assert!(ends("semiten_r")[0][1] > 0.5 && ends("vas_int_l")[0][0] < -3.0);
    assert!(ends("psoas_r")[0][1] < 1.0);
}
