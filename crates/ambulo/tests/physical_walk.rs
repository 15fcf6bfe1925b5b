//! Walking by own torques: nothing else moves the figure, it needs its feedback, it survives pushes and uneven ground,
//! and a fall is reported.

use crate::scene_walkers::{example, scene, verdict};
use ambulo::analysis::feasibility::VerdictState;
use ambulo::contact::{Shape, contacts};
use ambulo::figure_shape::{BodySolid, FigureShape};
use ambulo::findings::{Code, Findings};
use ambulo::gait::{Gait, Speed, Walk};
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::{Model, Movement};
use ambulo::optimal::{ECCENTRIC, OptimalWalk, Solution, StandingMovements, StrengthCurve, soles_with_width};
use ambulo::simulation::consistent_walk::{ConsistentWalk, ConsistentWalkSettings, make_consistent_walk};
use ambulo::simulation::control::{
    Balance, ControlError, ControlSettings, FootPlacement, PhysicalWalk, TorqueCurves, WalkController,
};
use ambulo::simulation::scene::{Scene, SceneError, SceneFile, SceneSettings};
use ambulo::simulation::walking::TorqueSeries;
use ambulo::simulation::{Obstacle, Owner, StepSettings, Surface, scene_walked};
use ambulo::spatial::{Pose, Vec3, Wrench};
use std::sync::LazyLock;

const MAN: Build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };

struct Case {
    human: Human,
    walk: ConsistentWalk,
    controller: WalkController,
}

fn case(lift: f64) -> Case {
    let human = MAN.human().unwrap();
    let mut gait = Gait::named("free").unwrap();
    gait.pace.speed = Some(Speed::MetersPerSecond(1.25));
    let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).unwrap();
    let mut settings = ConsistentWalkSettings::default();
    settings.costs.lift = lift;
    let walk = make_consistent_walk(&human, &walk, &settings).unwrap();
    let controller = controller(&human, &walk, &ControlSettings::default());
    Case { human, walk, controller }
}

fn controller(human: &Human, walk: &ConsistentWalk, settings: &ControlSettings) -> WalkController {
    WalkController::new(human, walk.solution(), StepSettings::default(), settings).unwrap()
}

static LEVEL: LazyLock<Case> = LazyLock::new(|| case(0.0));

impl Case {
    fn walk(&self) -> PhysicalWalk {
        self.walk_of(&self.human)
    }

    fn walk_of(&self, human: &Human) -> PhysicalWalk {
        PhysicalWalk::with(human, self.walk.solution(), StepSettings::default(), self.controller.clone()).unwrap()
    }

    fn index(&self, coordinate: &str) -> usize {
        self.human.model.coordinate(coordinate).unwrap().index()
    }

    /// Pushes the trunk forward with a force [N] for 0.2 s from a time [s] on, and walks on for 10 steps.
    fn pushed(&self, force: f64, from_s: f64) -> PhysicalWalk {
        let trunk = self.human.model.body("torso").unwrap().index();
        let mut walk = self.walk();
        walk.walk_until(from_s).unwrap();
        walk.world_mut().bodies[trunk].load = Wrench { moment: Vec3::zeros(), force: Vec3::x() * force };
        walk.walk_until(from_s + 0.2).unwrap();
        walk.world_mut().bodies[trunk].load = Wrench::ZERO;
        steps(&mut walk, 10);
        walk
    }
}

/// Walks a number of further steps, or until a fall.
fn steps(walk: &mut PhysicalWalk, count: usize) {
    let last = walk.controller().strikes() + count;
    while walk.controller().strikes() < last && walk.fall().is_none() {
        walk.step().unwrap();
    }
}

#[test]
fn nothing_but_joints_and_ground_moves_a_figure_that_walks_by_its_own_torques() {
    let case = &*LEVEL;
    let mut walk = case.walk();
    let root = ["pelvis_tx", "pelvis_ty", "pelvis_tilt"].map(|name| case.index(name));
    let legs: Vec<usize> = ["hip_flexion_r", "knee_angle_r", "ankle_angle_r"].map(|name| case.index(name)).to_vec();
    let (mut sum, mut count) = (0.0, 0);
    while walk.controller().strikes() < 20 {
        walk.step().unwrap();
        assert!(walk.fall().is_none(), "{:?}", walk.fall());
        let efforts = walk.efforts();
        assert!(root.iter().all(|&c| efforts[c] == 0.0), "{efforts:?}");
        let (now, planned) = (walk.coordinates(), walk.controller().planned());
        sum += legs.iter().map(|&c| (now[c][0] - planned[0][c]).powi(2)).sum::<f64>();
        count += legs.len();
    }
    let (apart, speed) = ((sum / count as f64).sqrt().to_degrees(), walk.coordinates()[root[0]][0] / walk.time_s());
    println!("{apart:.2} degrees from the plan at {speed:.3} m/s");
    assert!(apart < 1.0 && (speed - 1.25).abs() < 0.02, "{apart} {speed}");
}

#[test]
fn without_feedback_of_the_state_the_figure_falls() {
    let case = &*LEVEL;
    let settings = ControlSettings { balance: Balance::Nothing, ..ControlSettings::default() };
    let own = controller(&case.human, &case.walk, &settings);
    let mut walk = PhysicalWalk::with(&case.human, case.walk.solution(), StepSettings::default(), own).unwrap();
    let fall = walk.walk_until(20.0).unwrap().unwrap();
    assert!(fall.time_s > 0.5 && fall.time_s < 10.0 && fall.strikes < 20, "{fall:?}");
}

#[test]
fn pushes_of_150_n_are_survived_and_a_blow_is_not() {
    let case = &*LEVEL;
    for (force, from_s) in [(150.0, 2.2), (150.0, 2.6), (-150.0, 2.3), (-150.0, 2.8)] {
        let walk = case.pushed(force, from_s);
        assert!(walk.fall().is_none(), "{force} N at {from_s} s: {:?}", walk.fall());
    }
    let mut walk = case.pushed(-900.0, 2.3);
    let fall = walk.fall().unwrap();
    assert!(fall.time_s > 2.4 && fall.time_s < 6.0, "{fall:?}");
    let (limb, since_s) = fall.at_limit.unwrap();
    assert!(since_s >= 2.3 && since_s <= fall.time_s, "{fall:?}");
    assert!(case.human.model.coordinates().get(limb.index()).is_some());
    // Who has fallen does not get up, and what is left of the motion ends.
    let end_s = walk.time_s() + 1.0;
    while walk.time_s() < end_s {
        walk.step().unwrap();
    }
    assert_eq!(walk.fall(), Some(fall));
}

/// Torques stay within the isometric strength of muscles, also while a push is survived.
#[test]
fn uneven_ground_needs_a_plan_that_lifts_the_feet() {
    let walked = |case: &Case| {
        let length = 0.5 * case.walk.walk().speed() * case.walk.walk().cycle_s();
        let mut walk = case.walk();
        let world = walk.world_mut();
        world.obstacles[0].pose = Pose::at(Vec3::new(0.0, -5.0, 0.0));
        for tile in -2..25 {
            // Differences between neighbours of up to 20 mm.
            let height = if tile < 2 { 0.0 } else { 0.01 * (2.7 * f64::from(tile)).sin() };
            let place = Vec3::new((f64::from(tile) + 0.5) * length, height - 1.0, 0.0);
            world.obstacles.push(Obstacle { name: format!("tile {tile}"), pose: Pose::at(place), path: None });
            world.surfaces.push(Surface {
                owner: Owner::Obstacle(world.obstacles.len() - 1),
                shape: Shape::cuboid(Vec3::new(0.5 * length, 1.0, 1.0)).unwrap(),
                owner_from_shape: Pose::IDENTITY,
                material: 0,
            });
        }
        steps(&mut walk, 20);
        walk
    };
    let lifted = walked(&case(0.027));
    assert!(lifted.fall().is_none() && lifted.controller().strikes() == 20, "{:?}", lifted.fall());
    assert!(walked(&LEVEL).fall().is_some(), "the plan for level ground clears 8 mm and must trip");
}

#[test]
fn other_masses_and_legs_walk_with_the_same_plan_and_gains() {
    let case = &*LEVEL;
    for build in [
        Build { mass: 0.85 * MAN.mass, ..MAN },
        Build { mass: 1.15 * MAN.mass, ..MAN },
        Build { height: 0.95 * MAN.height, ..MAN },
        Build { height: 1.05 * MAN.height, ..MAN },
    ] {
        let mut walk = case.walk_of(&build.human().unwrap());
        steps(&mut walk, 20);
        assert!(walk.fall().is_none(), "{build:?}: {:?}", walk.fall());
    }
}

#[test]
fn one_controller_of_several_plans_changes_its_speed_on_the_way() {
    let human = MAN.human().unwrap();
    let at = |speed: f64| {
        let mut gait = Gait::named("free").unwrap();
        gait.pace.speed = Some(Speed::MetersPerSecond(speed));
        let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).unwrap();
        make_consistent_walk(&human, &walk, &ConsistentWalkSettings::default()).unwrap()
    };
    let settings = ControlSettings::default();
    let case = &*LEVEL;
    let fast = controller(&human, &at(1.5), &settings);
    let joined = WalkController::joined(&[fast, case.controller.clone()]).unwrap();
    let mut walk = PhysicalWalk::with(&human, case.walk.solution(), StepSettings::default(), joined).unwrap();
    let forward = case.index("pelvis_tx");
    let mut speeds = Vec::new();
    for speed in [1.25, 1.4, 1.5] {
        walk.set_speed(speed).unwrap();
        walk.walk_until(walk.time_s() + 4.0).unwrap();
        let (time_s, place) = (walk.time_s(), walk.coordinates()[forward][0]);
        walk.walk_until(time_s + 4.0).unwrap();
        speeds.push((walk.coordinates()[forward][0] - place) / (walk.time_s() - time_s));
    }
    println!("{speeds:.3?} m/s");
    assert!(walk.fall().is_none(), "{:?}", walk.fall());
    for (speed, expected) in speeds.iter().zip([1.25, 1.4, 1.5]) {
        assert!((speed - expected).abs() < 0.04, "{speeds:?}");
    }
    for speed in [9.0, 0.2, f64::NAN] {
        let error = walk.set_speed(speed).unwrap_err().to_string();
        assert!(error.contains("1.25 to 1.50 m/s"), "{error}");
    }
    // Strikes of these two plans lie on either side of the end of the cycle.
    let [slower, faster] = [1.0, 1.1].map(|speed| controller(&human, &at(speed), &settings));
    let joined = WalkController::joined(&[slower, faster]).unwrap();
    let mut walk = PhysicalWalk::with(&human, case.walk.solution(), StepSettings::default(), joined).unwrap();
    walk.set_speed(1.05).unwrap();
    steps(&mut walk, 20);
    assert!(walk.fall().is_none(), "{:?}", walk.fall());
    let other = Build { mass: 60.0, ..MAN }.human().unwrap();
    let other = controller(&other, &case.walk, &ControlSettings { balance: Balance::Nothing, ..settings });
    let error = WalkController::joined(&[case.controller.clone(), other]).unwrap_err();
    assert!(error.to_string().contains("different impedances"), "{error}");
    assert!(WalkController::joined(&[]).is_err());
}

#[test]
fn a_few_harmonics_of_the_torques_suffice() {
    let case = &*LEVEL;
    let settings = ControlSettings { torques: TorqueCurves::Harmonics(5), ..ControlSettings::default() };
    let own = controller(&case.human, &case.walk, &settings);
    let mut walk = PhysicalWalk::with(&case.human, case.walk.solution(), StepSettings::default(), own).unwrap();
    steps(&mut walk, 20);
    assert!(walk.fall().is_none(), "{:?}", walk.fall());
}

#[test]
fn torque_curves_of_a_file_replace_those_of_the_plan() {
    let case = &*LEVEL;
    let text = TorqueSeries::text([("physical", "free", case.controller.torque_series())]);
    let curves = TorqueSeries::read(&text, "physical", "free").unwrap();
    let given = |curves: Vec<TorqueSeries>| {
        let settings = ControlSettings {
            torques: TorqueCurves::Given(curves),
            balance: Balance::Nothing,
            ..ControlSettings::default()
        };
        WalkController::new(&case.human, case.walk.solution(), StepSettings::default(), &settings)
    };
    // Six harmonics of six harmonics are the same six harmonics, in twice as heavy a figure twice as large.
    let back = given(curves.clone()).unwrap().torque_series();
    for (one, other) in curves.iter().zip(&back) {
        assert_eq!(one.coordinate, other.coordinate);
        assert!((0..50).all(|k| (one.at(f64::from(k) / 50.0) - other.at(f64::from(k) / 50.0)).abs() < 1e-3), "{one:?}");
    }
    let of_legs = curves
        .iter()
        .filter(|one| ["hip_flexion", "knee_angle", "ankle_angle"].iter().any(|leg| one.coordinate.starts_with(leg)));
    assert!(of_legs.clone().count() == 6 && of_legs.clone().all(|one| one.r_squared > 0.9), "{curves:?}");
    let light: Vec<TorqueSeries> =
        curves.iter().map(|one| TorqueSeries { body_kg: 0.5 * one.body_kg, ..one.clone() }).collect();
    let heavy = given(light).unwrap().torque_series();
    assert!(curves.iter().zip(&heavy).all(|(one, other)| (2.0 * one.at(0.3) - other.at(0.3)).abs() < 1e-3));
    // Curves of another walk, and of what is not a joint.
    let slow = curves.iter().map(|one| TorqueSeries { cycle_s: 2.0 * one.cycle_s, ..one.clone() }).collect();
    assert!(matches!(given(slow), Err(ControlError::TorqueCycle { .. })));
    let root = TorqueSeries { coordinate: "pelvis_tilt".to_owned(), ..curves[0].clone() };
    assert!(matches!(given(vec![root]), Err(ControlError::TorqueOf { .. })));
    assert!(TorqueSeries::read(&text, "paper", "free").unwrap_err().to_string().contains("in the mode `paper`"));
}

#[test]
fn no_torque_exceeds_the_strength_of_its_muscles_at_the_angle_and_the_speed_of_the_joint() {
    let case = &*LEVEL;
    let mut walk = case.walk();
    walk.walk_until(2.2).unwrap();
    // A push that takes several joints to their limits.
    let trunk = case.human.model.body("torso").unwrap().index();
    walk.world_mut().bodies[trunk].load = Wrench { moment: Vec3::zeros(), force: Vec3::x() * -300.0 };
    let curve = |movement| StrengthCurve::built_in(movement, 75.0, 1.75).unwrap();
    let joints = [
        ("hip_flexion", curve(Movement::HipFlexion)),
        ("knee_angle", curve(Movement::KneeFlexion)),
        ("ankle_angle", curve(Movement::AnkleDorsiflexion)),
    ];
    let mut at_limit = 0;
    for _ in 0..400 {
        let now = walk.coordinates();
        walk.step().unwrap();
        if walk.fall().is_some() {
            break;
        }
        for (joint, strength) in &joints {
            for side in ["r", "l"] {
                let id = case.human.model.coordinate(&format!("{joint}_{side}")).unwrap();
                let sign = case.human.model.anatomy().meaning(id).unwrap().sign;
                let ([q, rate], effort) = (now[id.index()], sign * walk.efforts()[id.index()]);
                let most = strength.available(sign * q, sign * rate, effort, ECCENTRIC);
                assert!(effort.abs() <= most + 1e-6, "{joint}_{side}: {effort} N.m instead of at most {most}");
                at_limit += usize::from(effort.abs() > 0.999 * most);
            }
        }
    }
    assert!(at_limit > 10, "{at_limit}");
}

/// Feedback that acts later, with torques that follow their command with a time constant.
#[test]
fn a_figure_whose_feedback_acts_late_survives_pushes() {
    let case = &*LEVEL;
    for (delay_s, activation_s) in [(0.06, 0.0), (0.04, 0.04)] {
        let settings = ControlSettings { delay_s, activation_s, ..ControlSettings::default() };
        let own = controller(&case.human, &case.walk, &settings);
        let late = Case { controller: own, human: case.human.clone(), walk: case.walk.clone() };
        for force in [100.0, -100.0] {
            let walk = late.pushed(force, 2.2);
            assert!(walk.fall().is_none(), "{delay_s} s, {activation_s} s, {force} N: {:?}", walk.fall());
        }
    }
}

#[test]
fn tuned_gains_survive_a_push_that_the_usual_ones_do_not() {
    let case = &*LEVEL;
    let tuned = controller(&case.human, &case.walk, &ControlSettings::tuned_in_the_plane());
    let tuned = Case { controller: tuned, human: case.human.clone(), walk: case.walk.clone() };
    let fall = |case: &Case| case.pushed(-250.0, 2.2).fall().is_some();
    assert!(fall(case) && !fall(&tuned), "usual fell: {}, tuned fell: {}", fall(case), fall(&tuned));
}

#[test]
fn foot_placement_is_for_planar_figures_and_keeps_a_figure_up_for_longer_than_nothing() {
    let case = &*LEVEL;
    let law = FootPlacement { distance: 2.0, velocity: 0.1, trunk: [300.0, 30.0] };
    let with = |balance: Balance| {
        let own = controller(&case.human, &case.walk, &ControlSettings { balance, ..ControlSettings::default() });
        let mut walk = PhysicalWalk::with(&case.human, case.walk.solution(), StepSettings::default(), own).unwrap();
        walk.walk_until(8.0).unwrap().map_or(8.0, |fall| fall.time_s)
    };
    let [placed, nothing] = [with(Balance::FootPlacement(law)), with(Balance::Nothing)];
    println!("until the fall: {placed:.1} s with foot placement, {nothing:.1} s without");
    assert!(placed > nothing, "{placed} {nothing}");
}

#[test]
fn a_controller_needs_a_gain_for_every_step() {
    let case = &*LEVEL;
    let step = StepSettings { step_s: 0.02, ..StepSettings::default() };
    let error = WalkController::new(&case.human, case.walk.solution(), step, &ControlSettings::default()).unwrap_err();
    assert!(matches!(error, ControlError::Steps { found: 50..60, least: 100, .. }), "{error:?}");
}

#[test]
fn a_walker_without_a_hand_goes_twelve_metres() {
    let mut scene = scene(&example("walker-without-a-hand.toml"));
    let mut root = 0.0_f64;
    scene
        .run(&mut Findings::default(), |frame| {
            if let Some(forces) = &frame.forces {
                let all = frame.scene.generalized_forces(forces);
                root = all[0][..3].iter().fold(root, |most, [_, _, force]| most.max(force.abs()));
            }
        })
        .unwrap();
    assert!(root == 0.0, "{root}");
    let pelvis = scene.world().bodies.iter().position(|body| body.name == "ann/pelvis").unwrap();
    assert!(scene.state().poses[pelvis].translation.x > 12.0);
    assert_eq!(verdict(&scene).state, VerdictState::Feasible);
}

/// With these words, a figure of a scene has three dimensions; without them it is planar.
const SPATIAL_MODE: &str = ", mode = \"optimal\"";

/// Runs a scene to its end. Nobody may fall, the walk has to be feasible, and the first figure has to walk a distance
/// [m].
fn walks_on(name: &str, text: &str, distance: f64) -> Scene {
    let mut scene = scene(text);
    let mut findings = Findings::default();
    scene.run(&mut findings, |_| ()).unwrap();
    assert!(!findings.has(Code::FigureFell), "{name}: {findings:?}");
    let pelvis = scene.world().bodies.iter().position(|body| body.name.ends_with("/pelvis")).unwrap();
    let place = scene.state().poses[pelvis].translation;
    assert!(place.x > distance, "{name}: {place:?}");
    assert_eq!(verdict(&scene).state, VerdictState::Feasible, "{name}");
    scene
}

#[test]
fn figures_of_scenes_walk_by_their_own_torques() {
    for (name, distance) in [("pushed-walker.toml", 8.0), ("kerb-walker.toml", 8.0)] {
        let mut scene = walks_on(name, &example(name), distance);
        let saved = scene.save();
        assert!(scene.resume(&saved).unwrap_err().to_string().contains("controller"));
    }
    // In the plane, because plans and gains of a figure in three dimensions take long without optimisation.
    for (name, distance) in [("nudged-by-a-cart.toml", 14.0), ("rising-ground.toml", 9.5)] {
        walks_on(name, &example(name).replace(SPATIAL_MODE, ""), distance);
    }
}

#[test]
fn a_figure_of_a_scene_changes_its_speed() {
    let text =
        example("hurrying-walker.toml").replace("speed = 1.6", "speed = 1.25").replace("speed = 0.9", "speed = 1.2");
    let scene = walks_on("hurrying-walker.toml", &text, 18.5);
    let pelvis = scene.world().bodies.iter().position(|body| body.name == "ann/pelvis").unwrap();
    // 3 s at 1.2 m/s, 3 s between, 3 s at 1.25, 3 s between, 4 s at 1.2.
    let expected = 3.0 * (1.2 + 1.225 + 1.25 + 1.225) + 4.0 * 1.2;
    let place = scene.state().poses[pelvis].translation.x;
    assert!((place - expected).abs() < 0.3, "{place} instead of {expected}");
}

/// The first start is with the left foot, the stop and the start after it are its mirror images.
#[test]
fn a_figure_of_a_scene_stands_walks_off_stops_and_walks_off() {
    let text = example("stop-and-go.toml");
    let of_walk = text.find("walk = {").unwrap();
    let walk = "walk = { speed = 0, changes = [{ at = 0.5, within = 0.5, speed = 0.75 }, { at = 3.7, speed = 0 }, \
        { at = 9.0, within = 0.5, speed = 0.75 }] }\ncontrol = {}\n";
    let text = text[..of_walk].replace("duration = 16.0", "duration = 12.0") + walk;
    let mut places = Vec::new();
    let mut scene = scene(&text);
    let bodies = ["max/pelvis", "max/calcn_r", "max/calcn_l"]
        .map(|name| scene.world().bodies.iter().position(|body| body.name == name).unwrap());
    let mut findings = Findings::default();
    let place = |scene: &Scene| bodies.map(|body| scene.state().poses[body].translation.x);
    scene.run(&mut findings, |frame| places.push(place(frame.scene))).unwrap();
    assert!(!findings.has(Code::FigureFell), "{findings:?}");
    let [pelvis, right, left] = [0, 1, 2].map(|body| {
        let places = &places;
        move |time_s: f64| places[(time_s / 12.0 * (places.len() - 1) as f64).round() as usize][body]
    });
    let [first, off, last] = [pelvis(0.5) - pelvis(0.0), pelvis(4.0) - pelvis(2.0), pelvis(9.0) - pelvis(8.0)];
    println!("{first:.3} m in standing, {off:.3} m in 2 s of walking, {last:.3} m in standing");
    assert!(first.abs() < 0.01 && last.abs() < 0.02 && (1.2..1.8).contains(&off), "{first} {off} {last}");
    let first_to_move = |from_s: f64| {
        let moved = |time_s: &f64| [right(*time_s) - right(from_s), left(*time_s) - left(from_s)];
        let mut times = (0..).map(|k| from_s + 0.01 * f64::from(k));
        times.find_map(|time_s| moved(&time_s).iter().position(|moved| *moved > 0.05)).unwrap()
    };
    assert_eq!([first_to_move(0.5), first_to_move(9.0)], [1, 0], "the left foot, then the right one");
    assert!((right(8.5) - left(8.5)).abs() < 0.03, "{} {}", right(8.5), left(8.5));
    let verdict = verdict(&scene);
    assert_eq!(verdict.state, VerdictState::Feasible);
    let likeness = &verdict.figures[0].verdict.likeness;
    println!("{:?}", likeness.iter().map(|found| (found.measure, found.share)).collect::<Vec<_>>());
    assert!(likeness.len() == 5 && likeness.iter().all(|found| found.share < 0.8), "{likeness:?}");
}

#[test]
fn a_controller_without_standing_cannot_stop() {
    let case = &*LEVEL;
    let error = case.walk().set_speed(0.0).unwrap_err();
    assert!(error.to_string().contains("found the speed 0 m/s"), "{error}");
    assert!(!case.walk().controller().is_standing());
}

#[test]
fn movements_that_do_not_join_the_walk_are_refused() {
    let Case { human, walk, controller } = &*LEVEL;
    let walk = walk.solution();
    let of_another = StandingMovements { stop: walk.clone(), start: walk.clone(), steps: None };
    let settings = ControlSettings::default();
    let error = controller.clone().with_movements(human, walk, &of_another, StepSettings::default(), &settings);
    assert!(matches!(error, Err(ControlError::Movements { speed }) if (speed - 1.25).abs() < 1e-9));
}

#[test]
fn a_figure_of_a_scene_is_hit_from_four_sides_in_three_dimensions() {
    let scene = walks_on("pushed-from-four-sides.toml", &example("pushed-from-four-sides.toml"), 15.0);
    for (body, direction, speed) in [
        ("ball from behind", Vec3::x(), 4.25),
        ("ball from the right", Vec3::z(), -3.0),
        ("ball from the front", Vec3::x(), -1.75),
        ("ball from the left", Vec3::z(), 3.0),
    ] {
        let number = scene.world().bodies.iter().position(|own| own.name == body).unwrap();
        let now = scene.state().twists[number].linear.dot(&direction);
        assert!((now - speed).abs() > 1.5, "{body} did not hit: {now} m/s");
    }
}

#[test]
fn two_figures_of_a_scene_walk_hand_in_hand_by_their_own_torques() {
    let text = example("hand-in-hand-by-torques.toml").replace(SPATIAL_MODE, "");
    let scene = walks_on("hand-in-hand-by-torques.toml", &text, 9.0);
    assert!(scene.closure_gap(0) < 1e-9, "{}", scene.closure_gap(0));
}

#[test]
fn a_fall_in_a_scene_is_told_with_its_time_and_cause() {
    let mut scene =
        scene(&example("kerb-walker.toml").replace("0.03, 2.0]", "0.2, 2.0]").replace("0.015, 0]", "0.1, 0]"));
    let mut findings = Findings::default();
    scene.run(&mut findings, |_| ()).unwrap();
    let told: Vec<String> = findings
        .as_slice()
        .iter()
        .filter(|finding| finding.code == Code::FigureFell)
        .map(|finding| finding.message.clone())
        .collect();
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].starts_with("`ann` fell; "), "{told:?}");
    let seconds = scene.state().time_s;
    let fell_s = scene_walked(&scene).unwrap()[0].fell_at_s.unwrap();
    assert!((seconds - fell_s - 2.0).abs() < 0.1, "fell at {fell_s} s, the run ended at {seconds} s");
    // She lies on the floor by her whole body, and her joints are within their ranges.
    let human = Build { table: SegmentTable::DeLevaFemale, mass: 60.0, height: 1.65, toe_joint: true }.human().unwrap();
    let pose = |name: &str| {
        let number = scene.world().bodies.iter().position(|body| body.name == format!("ann/{name}")).unwrap();
        scene.state().poses[number]
    };
    let (deepest, highest) = heights_of_the_body(&human.model, pose);
    println!("{:.1} to {:.1} mm", 1e3 * deepest, 1e3 * highest);
    assert!(deepest > -0.02 && deepest < 0.0 && highest < 0.65, "{deepest} {highest}");
    for (body, pose) in scene.world().bodies.iter().zip(&scene.state().poses) {
        assert!(pose.translation.y > 0.0 && pose.translation.y < 0.7, "{}: {}", body.name, pose.translation.y);
    }
    let knee = scene.world().joints.iter().position(|joint| joint.name.contains("knee_angle_r")).unwrap();
    let knee = scene.state().coordinates[knee][0].to_degrees();
    // Her thighs lie on the kerb, so the knee is straight, at the end of its range of 10 degrees.
    assert!((-150.0..10.1).contains(&knee), "{knee}");
}

/// Lowest and highest point of the solids of a body [m]; `pose` has the place of the mass centre of a body.
fn heights_of_the_body(model: &Model, pose: impl Fn(&str) -> Pose) -> (f64, f64) {
    let solids = FigureShape::new(model, None, [0.0; 2]).solids;
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for (body, solids) in model.bodies().iter().zip(solids) {
        let frame = pose(&body.name) * Pose::at(-body.inertia.center());
        for solid in solids {
            let BodySolid::Capsule { from, to, radius } = solid else { continue };
            let heights = [from, to].map(|end| frame.place(end).y);
            low = low.min(heights[0].min(heights[1]) - radius);
            high = high.max(heights[0].max(heights[1]) + radius);
        }
    }
    (low, high)
}

#[test]
fn whoever_falls_without_a_scene_lies_on_the_ground_too() {
    let case = &*LEVEL;
    for force in [-900.0, 900.0] {
        let mut walk = case.pushed(force, 2.3);
        walk.walk_until(8.0).unwrap();
        let fall = walk.fall().unwrap();
        let mut deepest = f64::INFINITY;
        let model = &case.human.model;
        let now = |walk: &mut PhysicalWalk| {
            let poses = walk.poses().to_vec();
            heights_of_the_body(model, |name| poses[model.body(name).unwrap().index()])
        };
        while walk.time_s() < fall.time_s + 3.0 {
            walk.step().unwrap();
            if walk.time_s() > fall.time_s + 0.5 {
                deepest = deepest.min(now(&mut walk).0);
            }
        }
        let (end, highest) = now(&mut walk);
        println!("{force} N: {:.1} mm, at the end {:.1} to {:.1} mm", 1e3 * deepest, 1e3 * end, 1e3 * highest);
        assert!(deepest > -0.06 && end > -0.02 && end < 0.0 && highest < 0.65, "{force} N: {deepest} {end} {highest}");
    }
}

#[test]
fn a_controller_that_cannot_be_is_refused_with_its_line() {
    let text = example("kerb-walker.toml");
    for (from, to, expected) in [
        ("control = {}", "control = { stifness = 200 }", "stiffness"),
        ("control = {}", "control = { gains = \"best\" }", "expected one of \"usual\", \"tuned\""),
        ("control = {}", "control = { gains = \"tuned\", delay = 0.04 }", "planar figures whose feedback acts at once"),
        ("control = {}", "control = { stiffness = 0 }", "above zero"),
        ("control = {}", "control = { costs = { hight = 1 } }", "did you mean `height`"),
        ("control = {}", "control = { costs = { height = 1e4 } }", "found 1e4; expected a number from 5.0e-5 to 5.0e1"),
        ("control = {}", "control = { costs = { angle_deg = 5, angle = 0.1 } }", "found both `angle_deg` and `angle`"),
        ("lift = 0.03", "lift = 0.3", "0 to 0.1 m"),
        ("lift = 0.03", "mode = \"curves\"", "in the mode `corrected` or `optimal`"),
        ("walk = { gait = \"free\", speed = 1.2, lift = 0.03 }\n", "", "in the mode `corrected` or `optimal`"),
        ("lift = 0.03 }\ncontrol = {}", "mode = \"optimal\" }", "walks by its own torques"),
        ("lift = 0.03 }", "mode = \"optimal\" }\narms = { left = { abduction_deg = 5 } }", "which moves the arms"),
        ("control = {}", "control = {}\n[[figure.coordinate]]\nname = \"knee_angle_r\"", "together with `control`"),
    ] {
        assert!(text.contains(from), "{from}");
        let error = SceneFile::parse(&text.replace(from, to)).unwrap_err().to_string();
        assert!(error.contains("line ") && error.contains(expected), "{to}: {error}");
    }
    for (from, to, expected) in [
        ("lift = 0.03", "changes = [{ at = 3, step_length = 0.5 }]", "expected changes of `speed`"),
        ("gait = \"free\"", "mode = \"optimal\", gait = \"standard\"", "normative curves"),
    ] {
        let file = SceneFile::parse(&text.replace(from, to)).unwrap();
        let error = built(&file, SceneSettings::default()).unwrap_err().to_string();
        assert!(error.contains("line ") && error.contains(expected), "{to}: {error}");
    }
    let steps = SceneSettings { step_s: Some(0.02), ..SceneSettings::default() };
    let file = SceneFile::parse(&text).unwrap();
    let error = built(&file, steps).unwrap_err();
    assert!(error.to_string().contains("time steps"), "{error}");
}

fn built(file: &SceneFile, settings: SceneSettings) -> Result<Scene, SceneError> {
    let mut none = |path: &str| -> Result<Vec<u8>, String> { Err(path.to_owned()) };
    Scene::build(file, settings, &mut none, &mut Findings::default())
}

/// A man in three dimensions with his plan and controller.
struct Spatial {
    human: Human,
    plan: Solution,
    controller: WalkController,
}

static SPATIAL: LazyLock<Spatial> = LazyLock::new(|| {
    let mut gait = Gait::named("free").unwrap();
    gait.pace.speed = Some(Speed::MetersPerSecond(1.25));
    let leg_length = MAN.human().unwrap().dimensions.leg_length;
    let walk = Walk::new(&gait, leg_length, &mut Findings::default()).unwrap();
    let found = OptimalWalk::find(&MAN, &walk).unwrap();
    let human = found.figure();
    let controller =
        WalkController::new(&human, &found.solution, StepSettings::default(), &ControlSettings::default()).unwrap();
    Spatial { human, plan: found.solution, controller }
});

impl Spatial {
    fn walk_of(&self, human: &Human) -> PhysicalWalk {
        PhysicalWalk::with(human, &self.plan, StepSettings::default(), self.controller.clone()).unwrap()
    }

    fn index(&self, coordinate: &str) -> usize {
        self.human.model.coordinate(coordinate).unwrap().index()
    }
}

#[test]
fn a_figure_in_three_dimensions_walks_along_its_plan_and_nothing_holds_it() {
    let case = &*SPATIAL;
    let mut walk = case.walk_of(&case.human);
    let root = ["pelvis_tilt", "pelvis_list", "pelvis_rotation", "pelvis_tx", "pelvis_ty", "pelvis_tz"];
    let root = root.map(|name| case.index(name));
    let (mut squares, mut count) = (0.0, 0.0);
    while walk.controller().strikes() < 20 && walk.fall().is_none() {
        walk.step().unwrap();
        let (now, planned, efforts) = (walk.coordinates(), walk.controller().planned(), walk.efforts());
        assert!(root.iter().all(|&c| efforts[c] == 0.0), "{efforts:?}");
        for name in ["hip_flexion_r", "hip_adduction_r", "knee_angle_l", "ankle_angle_l", "pelvis_list"] {
            squares += (now[case.index(name)][0] - planned[0][case.index(name)]).powi(2);
            count += 1.0;
        }
    }
    let apart = f64::sqrt(squares / count).to_degrees();
    assert!(walk.fall().is_none() && apart < 0.5, "{:?}, {apart} deg", walk.fall());
    let place = walk.coordinates()[case.index("pelvis_tx")][0];
    assert!((place / walk.time_s() - 1.25).abs() < 0.03, "{place} m in {} s", walk.time_s());
}

#[test]
fn a_figure_in_three_dimensions_survives_pushes_from_all_sides_and_falls_under_a_large_one() {
    let case = &*SPATIAL;
    let trunk = case.human.model.body("torso").unwrap().index();
    let pushed = |force: Vec3| {
        let mut walk = case.walk_of(&case.human);
        walk.walk_until(1.3).unwrap();
        walk.world_mut().bodies[trunk].load = Wrench { moment: Vec3::zeros(), force };
        walk.walk_until(1.5).unwrap();
        walk.world_mut().bodies[trunk].load = Wrench::ZERO;
        walk.walk_until(6.0).unwrap().is_none()
    };
    for [x, z] in [[100.0, 0.0], [-100.0, 0.0], [0.0, 60.0], [0.0, -60.0], [70.7, 70.7], [-70.7, -70.7]] {
        assert!(pushed(Vec3::new(x, 0.0, z)), "{x} N forward, {z} N to the right");
    }
    assert!(!pushed(Vec3::z() * 600.0));
}

impl Spatial {
    /// His walk with a push of 0.2 s at a phase of the second cycle, to the right if the force [N] is positive, for
    /// five cycles.
    fn shoved(&self, mut walk: PhysicalWalk, phase: f64, force_n: f64, mut look: impl FnMut(&PhysicalWalk)) -> bool {
        let trunk = self.human.model.body("torso").unwrap().index();
        let start_s = self.plan.cycle_s() * (1.0 + phase);
        for (force, until_s) in [(0.0, start_s), (force_n, start_s + 0.2), (0.0, start_s + 5.0 * self.plan.cycle_s())] {
            walk.world_mut().bodies[trunk].load = Wrench { moment: Vec3::zeros(), force: Vec3::z() * force };
            while walk.time_s() < until_s && walk.fall().is_none() {
                walk.step().unwrap();
                look(&walk);
            }
        }
        walk.fall().is_none()
    }

    fn without_recovery_steps(&self) -> PhysicalWalk {
        let alone = self.controller.clone().without_recovery_steps();
        PhysicalWalk::with(&self.human, &self.plan, StepSettings::default(), alone).unwrap()
    }
}

#[test]
fn recovery_steps_survive_shoves_from_the_side_that_feedback_alone_does_not() {
    let (case, alone) = (&*SPATIAL, SPATIAL.without_recovery_steps());
    let pushes = [(0.07, 150.0), (0.33, 150.0), (0.45, -150.0), (0.62, 150.0), (0.86, -150.0)];
    let survived = |walk: &PhysicalWalk| {
        pushes.into_iter().filter(|(phase, force)| case.shoved(walk.clone(), *phase, *force, |_| ())).count()
    };
    let [with, without] = [survived(&case.walk_of(&case.human)), survived(&alone)];
    println!("with recovery steps {with} of {}, without {without}", pushes.len());
    assert!(with == pushes.len() && without <= 1, "{with}, {without}");
}

#[test]
fn nothing_is_planned_again_while_a_figure_walks_undisturbed() {
    let mut walks = [SPATIAL.walk_of(&SPATIAL.human), SPATIAL.without_recovery_steps()];
    for _ in 0..3000 {
        for walk in &mut walks {
            walk.step().unwrap();
        }
        let [with, without] = [0, 1].map(|k| walks[k].coordinates());
        assert_eq!(with, without);
    }
}

/// Standing after a stop from a slow walk, and the same by feedback alone.
static STANDING: LazyLock<[PhysicalWalk; 2]> = LazyLock::new(|| {
    let mut gait = Gait::named("free").unwrap();
    gait.pace.speed = Some(Speed::MetersPerSecond(StandingMovements::speed(&SPATIAL.human)));
    let leg_length = MAN.human().unwrap().dimensions.leg_length;
    let walk = Walk::new(&gait, leg_length, &mut Findings::default()).unwrap();
    let found = OptimalWalk::find(&MAN, &walk).unwrap();
    let (human, plan, step) = (found.figure(), &found.solution, StepSettings::default());
    let movements = StandingMovements::find(&human, plan).and_then(|found| found.with_steps(&human, plan)).unwrap();
    let settings = ControlSettings::default();
    let own = WalkController::new(&human, plan, step, &settings).unwrap();
    let own = own.with_movements(&human, plan, &movements, step, &settings).unwrap();
    [own.clone(), own.without_recovery_steps()].map(|controller| {
        let mut walk = PhysicalWalk::with(&human, plan, step, controller).unwrap();
        walk.set_speed(0.0).unwrap();
        walk.walk_until(6.0).unwrap();
        assert!(walk.controller().is_standing());
        walk
    })
});

/// A figure after a push of its trunk for 0.2 s, forward and to the right [N], some seconds later.
fn pushed_in_standing(walk: &PhysicalWalk, [x, z]: [f64; 2]) -> PhysicalWalk {
    let mut walk = walk.clone();
    let trunk = SPATIAL.human.model.body("torso").unwrap().index();
    walk.world_mut().bodies[trunk].load = Wrench { moment: Vec3::zeros(), force: Vec3::new(x, 0.0, z) };
    walk.walk_until(6.2).unwrap();
    walk.world_mut().bodies[trunk].load = Wrench::ZERO;
    walk.walk_until(11.0).unwrap();
    walk
}

#[test]
fn a_figure_that_stands_steps_to_keep_its_balance_and_stands_again() {
    let [steps, alone] = &*STANDING;
    let places = ["pelvis_tx", "pelvis_tz"].map(|name| SPATIAL.index(name));
    for force in [[0.0, 100.0], [-71.0, -71.0], [150.0, 0.0], [106.0, -106.0]] {
        let after = pushed_in_standing(steps, force);
        let [q, before] = [&after, steps].map(PhysicalWalk::coordinates);
        let [forward, right] = places.map(|c| q[c][0] - before[c][0]);
        let strikes = after.controller().strikes() - steps.controller().strikes();
        println!("{force:?} N: {strikes} steps, {forward:.2} m forward, {right:.2} m to the right");
        assert!(after.fall().is_none() && after.controller().is_standing(), "{force:?}: {:?}", after.fall());
        let moved = forward.hypot(right);
        assert!(places.iter().all(|&c| q[c][1].abs() < 0.02) && strikes < 8 && moved > 0.1, "{force:?}: {q:?}");
        assert!(pushed_in_standing(alone, force).fall().is_some(), "{force:?} by feedback alone");
        // It walks off from where it came to stand, and straight on: its plan has moved with its feet.
        let mut off = after;
        off.set_speed(off.controller().speeds()[0]).unwrap();
        off.walk_until(17.0).unwrap();
        let [walked, aside] = places.map(|c| off.coordinates()[c][0] - q[c][0]);
        println!("{walked:.2} m on, {aside:.3} m to the right");
        assert!(off.fall().is_none() && walked > 2.0 && aside.abs() < 0.1, "{:?}, {walked} m, {aside} m", off.fall());
    }
    assert!(pushed_in_standing(steps, [0.0, 600.0]).fall().is_some());
}

/// Pushes that feedback alone can take change nothing either.
#[test]
fn a_figure_that_stands_undisturbed_or_is_pushed_a_little_makes_no_step() {
    for force in [[0.0; 2], [50.0, 0.0], [-50.0, 0.0]] {
        let [with, alone] = STANDING.each_ref().map(|walk| pushed_in_standing(walk, force));
        assert_eq!(with.coordinates(), alone.coordinates(), "{force:?}");
    }
}

/// The foot that feedback alone would swing through the other leg is stopped by it.
#[test]
fn legs_do_not_pass_through_each_other() {
    let case = &*SPATIAL;
    let least = |is_solid: bool| {
        let mut alone = case.without_recovery_steps();
        let world = alone.world_mut();
        let (surfaces, pairs) = (world.surfaces.clone(), world.limbs.clone());
        if !is_solid {
            world.limbs = pairs.iter().flat_map(|(a, b)| [(*a, *a), (*b, *b)]).collect();
        }
        let mut least = f64::INFINITY;
        for (phase, force_n) in [(0.12, 150.0), (0.25, 150.0), (0.62, -150.0), (0.75, -150.0)] {
            case.shoved(alone.clone(), phase, force_n, |walk| {
                let placed = |surface: usize| {
                    let Owner::Body(body) = surfaces[surface].owner else { panic!("a limb of an obstacle") };
                    walk.poses()[body] * surfaces[surface].owner_from_shape
                };
                let mut points = Vec::new();
                for &(a, b) in &pairs {
                    contacts(&surfaces[a].shape, &placed(a), &surfaces[b].shape, &placed(b), 1.0, &mut points);
                }
                least = points.iter().map(|point| point.gap).fold(least, f64::min);
            });
        }
        least
    };
    let [solid, soft] = [true, false].map(least);
    println!("least distance of the legs: {:.1} mm solid, {:.1} mm if they are not", 1e3 * solid, 1e3 * soft);
    assert!(solid > -0.03 && soft < -0.05, "{solid}, {soft}");
}

#[test]
fn a_figure_of_a_scene_recovers_from_a_shove_from_the_side() {
    let text = example("shoved-from-the-side.toml");
    walks_on("shoved-from-the-side.toml", &text, 9.0);
    let mut alone = scene(&text.replace("recovery_steps = true", "recovery_steps = false"));
    let mut findings = Findings::default();
    alone.run(&mut findings, |_| ()).unwrap();
    assert!(findings.as_slice().iter().any(|finding| finding.code == Code::FigureFell), "{findings:?}");
}

/// By feedback alone he falls: [`a_figure_that_stands_steps_to_keep_its_balance_and_stands_again`].
#[test]
fn a_figure_of_a_scene_that_is_pushed_in_standing_steps_aside() {
    let mut scene = scene(&example("pushed-in-standing.toml"));
    let pelvis = scene.world().bodies.iter().position(|body| body.name == "tim/pelvis").unwrap();
    let place = |scene: &Scene| scene.state().poses[pelvis].translation.z;
    let (before, mut findings) = (place(&scene), Findings::default());
    scene.run(&mut findings, |_| ()).unwrap();
    let aside = place(&scene) - before;
    assert!(!findings.has(Code::FigureFell) && (0.1..0.8).contains(&aside), "{aside} m, {findings:?}");
    let verdict = verdict(&scene);
    assert_eq!(verdict.state, VerdictState::Feasible);
    let likeness = &verdict.figures[0].verdict.likeness;
    assert!(likeness.iter().all(|found| found.share < 1.0), "{likeness:?}");
}

#[test]
fn another_man_in_three_dimensions_walks_with_the_same_plan_and_gains() {
    let case = &*SPATIAL;
    for (mass, height) in [(0.85, 1.0), (1.15, 1.0), (1.0, 0.95), (1.0, 1.05)] {
        let build = Build { mass: mass * MAN.mass, height: height * MAN.height, ..MAN };
        let other = full_body(&build).unwrap();
        let other = Human { soles: soles_with_width(&other), ..other };
        let mut walk = case.walk_of(&other);
        walk.walk_until(8.0).unwrap();
        assert!(walk.fall().is_none(), "mass x {mass}, height x {height}: {:?}", walk.fall());
    }
}
