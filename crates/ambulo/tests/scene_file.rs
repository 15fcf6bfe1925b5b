//! Scene files: the content of valid ones. [`refused`] has the errors of invalid ones.

mod refused;

use ambulo::dynamics::Method;
use ambulo::simulation::scene::{
    Anchor, ArmEntry, Attachment, ContactPartner, DrivenCoordinates, EventAction, FigureWalkMode, GaitSource,
    JointAxes, MaterialLaw, MotionKind, ObstacleShape, Plot, RootMotion, SceneError, SceneFile, Solid, TimeFunction,
};
use ambulo::simulation::{ImpactLaw, Integrator};
use ambulo::spatial::{Mat3, Vec3};
use proptest::prelude::*;
use std::f64::consts::PI;
use std::fs;
use std::path::{Path, PathBuf};

/// A handful of operations on numbers of order one.
const ROUNDING: f64 = 1e-14;

/// Two hinged rods, a closure, a floor: everything a bad file can get wrong. Line numbers are counted below.
const GOOD: &str = r#"title = "Good"
step = 0.001
duration = 2.0

[material.rubber]
friction = 0.9

[[obstacle]]
name = "floor"
kind = "plane"
material = "rubber"

[[body]]
name = "upper"
mass = 2
position = [0, 1.0, 0]
shape = { kind = "box", size = [0.1, 0.4, 0.1] }

[[body]]
name = "lower"
mass = 1.5
inertia = [0.02, 0.001, 0.02]
position = [0, 0.6, 0]

[[joint]]
name = "hip"
kind = "revolute"
parent = "world"
child = "upper"
at = [0, 1.2, 0]
axis = [0, 0, 1]
[joint.coordinate]
limits = { lower_deg = -30, upper_deg = 90 }

[[joint]]
name = "knee"
kind = "ball"
parent = "upper"
child = "lower"
at = [0, 0.8, 0]

[[closure]]
name = "string"
kind = "ball"
first = "lower"
second = "world"
at = [0, 0.4, 0]

[[event]]
time = 1.0
remove = "string"
"#;

fn good() -> SceneFile {
    parse(GOOD)
}

fn parse(text: &str) -> SceneFile {
    SceneFile::parse(text).unwrap_or_else(|error| panic!("{error}"))
}

/// The refusal of a text.
fn refusal(text: &str) -> SceneError {
    SceneFile::parse(text).expect_err("a bad scene")
}

/// The error of the valid scene after one replacement.
fn said(from: &str, to: &str) -> String {
    assert_eq!(GOOD.matches(from).count(), 1, "{from:?} stands once");
    refusal(&GOOD.replace(from, to)).to_string()
}

/// The error of the valid scene with text appended.
fn said_with(end: &str) -> String {
    refusal(&format!("{GOOD}{end}")).to_string()
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= ROUNDING * expected.abs().max(1.0), "{found}, expected {expected}");
}

fn near_vector(found: Vec3, expected: [f64; 3]) {
    for (found, expected) in found.iter().zip(expected) {
        near(*found, expected);
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn examples() -> Vec<(String, String)> {
    let listing = |folder: &str| {
        let folder = root().join(folder);
        fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()))
    };
    let both = listing("examples").chain(listing("crates/ambulo-paper/data/scenes"));
    let mut paths: Vec<PathBuf> = both.map(|entry| entry.expect("a listing").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "toml"));
    paths.sort_by(|a, b| a.file_name().cmp(&b.file_name()));
    let name = |path: &PathBuf| path.file_stem().expect("a name").to_string_lossy().into_owned();
    paths.iter().map(|path| (name(path), fs::read_to_string(path).expect("a text"))).collect()
}

fn example(name: &str) -> SceneFile {
    let (_, text) = examples().into_iter().find(|(found, _)| found == name).expect(name);
    parse(&text)
}

// ---- good files ----

#[test]
fn the_good_scene_reads_as_it_says() {
    let scene = good();
    assert_eq!(scene.title, "Good");
    assert_eq!(scene.gravity, Vec3::new(0.0, -9.80665, 0.0));
    near_vector(Vec3::new(scene.step_s, scene.duration_s, scene.output_rate_hz), [0.001, 2.0, 100.0]);
    assert_eq!((scene.integrator, scene.projection), (Integrator::Impulse, true));
    assert_eq!((scene.solver.method, scene.solver.max_iterations), (Method::Newton, 100));
    assert_eq!(scene.materials.len(), 2);
    assert_eq!((scene.materials[0].name.as_str(), scene.materials[0].line), ("default", 0));
    assert_eq!((scene.obstacles[0].material, scene.bodies[0].shapes[0].material), (1, 0));
    assert_eq!(scene.obstacles[0].shape, ObstacleShape::Plane { normal: Vec3::y() });
    assert_eq!(scene.joints[0].parent, Attachment::World);
    assert_eq!((&scene.joints[1].parent, scene.joints[1].child), (&Attachment::Body(0), 1));
    assert_eq!(scene.joints[1].coordinates.len(), 3);
    assert_eq!(scene.closures[0].anchor, Anchor::Start { at: Vec3::new(0.0, 0.4, 0.0) });
    assert_eq!(scene.events[0].change, EventAction::RemoveClosure(0));
    assert!(scene.outputs.poses && scene.outputs.plots.is_empty());
}

#[test]
fn every_record_keeps_its_line() {
    let scene = good();
    let lines = |list: &[usize]| list.to_vec();
    assert_eq!(lines(&[scene.materials[1].line, scene.obstacles[0].line]), [5, 8]);
    assert_eq!(lines(&[scene.bodies[0].line, scene.bodies[1].line, scene.bodies[0].shapes[0].line]), [13, 19, 17]);
    assert_eq!(lines(&[scene.joints[0].line, scene.joints[0].coordinates[0].line]), [25, 32]);
    assert_eq!(lines(&[scene.joints[1].line, scene.joints[1].coordinates[2].line]), [35, 35]);
    assert_eq!(lines(&[scene.closures[0].line, scene.events[0].line]), [42, 49]);
}

#[test]
fn the_examples_are_scenes() {
    let counts: Vec<(String, [usize; 5])> = examples()
        .iter()
        .map(|(name, text)| {
            let scene = SceneFile::parse(text).unwrap_or_else(|error| panic!("{name}: {error}"));
            let [bodies, obstacles] = [scene.bodies.len(), scene.obstacles.len()];
            (name.clone(), [bodies, obstacles, scene.joints.len(), scene.closures.len(), scene.events.len()])
        })
        .collect();
    let expected = [
        ("carry", [1, 1, 0, 2, 0]),
        ("four-bar", [3, 0, 3, 1, 0]),
        ("grasp", [4, 1, 3, 0, 0]),
        ("hand-in-hand-by-torques", [0, 1, 0, 1, 1]),
        ("hand-in-hand", [0, 1, 0, 1, 0]),
        ("hands", [6, 0, 6, 1, 2]),
        ("hurrying-walker", [0, 1, 0, 0, 0]),
        ("kerb-walker", [0, 2, 0, 0, 0]),
        ("ladder", [60, 0, 60, 20, 0]),
        ("nudged-by-a-cart", [1, 1, 1, 0, 0]),
        ("pendulum", [1, 0, 1, 0, 0]),
        ("pile", [10, 5, 0, 0, 0]),
        ("pushed-from-four-sides", [4, 1, 4, 0, 0]),
        ("pushed-in-standing", [1, 1, 1, 0, 0]),
        ("pushed-walker", [1, 1, 1, 0, 0]),
        ("pusher", [3, 2, 2, 0, 0]),
        ("rising-ground", [0, 1, 0, 0, 0]),
        ("shoved-from-the-side", [1, 1, 1, 0, 0]),
        ("slope", [2, 2, 0, 0, 0]),
        ("stop-and-go", [0, 1, 0, 0, 0]),
        ("stumble", [0, 2, 0, 0, 0]),
        ("top", [1, 0, 1, 0, 0]),
        ("walker-without-a-hand", [0, 1, 0, 0, 0]),
    ];
    assert_eq!(counts, expected.map(|(name, counts)| (name.to_owned(), counts)));
}

/// A rigid rod's end is where the neighbour's end is: the examples' geometry, whose numbers are rounded to 1e-6 m.
#[test]
fn bodies_of_the_examples_hang_where_their_joints_are() {
    // Half lengths of the rods along the axis that each example uses.
    let ends = |name: &str, body: &str| match (name, body.rsplit(' ').next().unwrap_or(body)) {
        ("pendulum", _) => Some(Vec3::new(0.0, 0.25, 0.0)),
        ("top", _) => Some(Vec3::new(0.0, -0.1, 0.0)),
        ("four-bar", "crank") => Some(Vec3::new(-0.05, 0.0, 0.0)),
        ("four-bar", "coupler") => Some(Vec3::new(-0.175, 0.0, 0.0)),
        ("four-bar", "rocker") => Some(Vec3::new(-0.15, 0.0, 0.0)),
        ("hands", "arm" | "forearm") => Some(Vec3::new(0.0, 0.15, 0.0)),
        ("hands", "hand") => Some(Vec3::new(0.0, 0.075, 0.0)),
        ("pusher", _) => Some(Vec3::new(0.0, 0.25, 0.0)),
        ("ladder", _) if body.starts_with("rung") => Some(Vec3::new(0.0, 0.0, -0.2)),
        ("ladder", _) => Some(Vec3::new(0.0, 0.15, 0.0)),
        _ => None,
    };
    let mut checked = 0;
    for (name, text) in examples() {
        let scene = parse(&text);
        for joint in &scene.joints {
            let child = &scene.bodies[joint.child];
            let Some(end) = ends(&name, &child.name) else { continue };
            let miss = (child.start.place(end) - joint.at).norm();
            assert!(miss < 3e-6, "{name}, {}: {miss} m", joint.name);
            checked += 1;
        }
    }
    assert_eq!(checked, 1 + 1 + 3 + 6 + 2 + 60);
    let linkage = example("four-bar");
    let Anchor::Start { at } = linkage.closures[0].anchor else { panic!("a point at the start") };
    for (body, half) in [(1, 0.175), (2, 0.15)] {
        assert!((linkage.bodies[body].start.place(Vec3::new(half, 0.0, 0.0)) - at).norm() < 3e-6);
    }
}

#[test]
fn degrees_become_radians_and_radians_stay() {
    let scene = parse(
        r#"
        step = 0.01
        duration = 1
        [[body]]
        name = "a"
        mass = 1
        inertia = [1, 1, 1]
        rotation = { axis = [0, 0, 2], angle_deg = 90 }
        angular_velocity_deg = [180, 0, 0]
        velocity = [1, 2, 3]
        [[body]]
        name = "b"
        mass = 1
        inertia = [1, 1, 1]
        rotation = { quaternion = [1, 0, 0, 1] }
        [[body]]
        name = "c"
        mass = 1
        inertia = [1, 1, 1]
        angular_velocity = [0, 0.5, 0]
        [[joint]]
        name = "j"
        kind = "revolute"
        parent = "a"
        child = "b"
        at = [0, 0, 0]
        axis = [3, 0, 4]
        [joint.coordinate]
        start_deg = 60
        rate = 2
        spring = { stiffness = 5, damping = 1, rest_deg = 30 }
        limits = { lower_deg = -90, upper = 1.5 }
        motor = { target_deg = { sine = { amplitude = 90, frequency_hz = 2, phase_deg = 45, offset = -180 } }, stiffness = 7 }
        [[joint]]
        name = "k"
        kind = "planar"
        parent = "world"
        child = "c"
        axis = [0, 1, 0]
        [[joint.coordinate]]
        drive_deg = { points = [[0, 0], [1, 180]] }
        drive_max = 12
        [[joint.coordinate]]
        limits = { lower = -1 }
        friction = 3
        "#,
    );
    // Both turn x to y, one by axis and angle, one by a quaternion that is not of length one.
    for body in [0, 1] {
        near_vector(scene.bodies[body].start.rotation * Vec3::x(), [0.0, 1.0, 0.0]);
    }
    near_vector(scene.bodies[0].angular_velocity.unwrap(), [PI, 0.0, 0.0]);
    near_vector(scene.bodies[0].velocity.unwrap(), [1.0, 2.0, 3.0]);
    near_vector(scene.bodies[2].angular_velocity.unwrap(), [0.0, 0.5, 0.0]);
    assert_eq!(scene.bodies[1].angular_velocity, None);

    let JointAxes::Revolute { axis } = scene.joints[0].kind else { panic!("{:?}", scene.joints[0].kind) };
    near_vector(axis, [0.6, 0.0, 0.8]);
    let hinge = &scene.joints[0].coordinates[0];
    near(hinge.start, PI / 3.0);
    near(hinge.rate, 2.0);
    let (spring, limits) = (hinge.spring.unwrap(), hinge.limits.unwrap());
    near(spring.rest, PI / 6.0);
    near(spring.stiffness, 5.0);
    near(limits.lower, -PI / 2.0);
    near(limits.upper, 1.5);
    let motor = hinge.motor.as_ref().unwrap();
    assert!(motor.max.is_infinite());
    let TimeFunction::Sine { amplitude, frequency_hz, phase, offset } = motor.target else { panic!("{motor:?}") };
    near(amplitude, PI / 2.0);
    near(frequency_hz, 2.0);
    near(phase, PI / 4.0);
    near(offset, -PI);

    let JointAxes::Planar { normal, along } = scene.joints[1].kind else { panic!("{:?}", scene.joints[1].kind) };
    assert_eq!((normal, along), (Vec3::y(), Vec3::x()));
    let [turn, slide, other] = &scene.joints[1].coordinates[..] else { panic!("three coordinates") };
    assert_eq!([turn.kind, slide.kind], [MotionKind::Rotation, MotionKind::Translation]);
    let drive = turn.drive.as_ref().unwrap();
    near(drive.max, 12.0);
    assert_eq!(drive.function, TimeFunction::Points(vec![(0.0, 0.0), (1.0, 180_f64.to_radians())]));
    assert!(slide.limits.unwrap().upper.is_infinite());
    near(slide.friction, 3.0);
    assert!(other.drive.is_none() && other.line == scene.joints[1].line);
}

#[test]
fn sticking_impacts_require_steps_of_impulses() {
    let scene = |more: &str| {
        format!("step = 0.001\nduration = 1\n{more}\n[[body]]\nname = \"b\"\nmass = 1\ninertia = [1, 1, 1]\n")
    };
    assert_eq!(parse(&scene("impact = \"sticking\"")).impact, ImpactLaw::Sticking);
    assert_eq!(parse(&scene("")).impact, ImpactLaw::Coulomb);
    let both = scene("impact = \"sticking\"\nintegrator = \"runge-kutta\"");
    let error = SceneFile::parse(&both).unwrap_err().to_string();
    assert!(error.contains("line 3, `impact`") && error.contains("coulomb"), "{error}");
}

#[test]
fn figures_materials_and_obstacles_read_as_they_say() {
    let scene = parse(
        r#"
        step = 0.001
        duration = 1
        integrator = "runge-kutta"
        projection = false
        output_rate = 1000
        [solver]
        method = "conjugate-gradient"
        tolerance = 1e-6
        max_iterations = 20
        [material.shoe]
        law = "hunt-crossley"
        dissipation = 1
        [material.mat]
        law = "regularised"
        friction = 0.7
        stiffness = 2e4
        damping = 100
        [material.default]
        friction = 0.1
        [[figure]]
        name = "walker"
        model = "gait.osim"
        motion = "walk.mot"
        from = 0.4
        root = "driven"
        at = [1, 0, 0]
        rotation = { axis = [0, 1, 0], angle_deg = 180 }
        [[figure.sphere]]
        body = "calcn_r"
        at = [0.01, -0.01, 0]
        radius = 0.032
        material = "shoe"
        [[figure]]
        name = "doll"
        model = "doll.osim"
        [[figure]]
        name = "partner"
        model = "gait.osim"
        motion = "walk.mot"
        drive = ["knee_angle_r", "knee_angle_l"]
        [[obstacle]]
        name = "terrain"
        kind = "height-field"
        heights = [[0, 0.1, 0], [0, 0.2, 0]]
        size = [4, 2]
        material = "mat"
        [obstacle.motion]
        displacement = [{ motion = "belt.sto", column = "x" }, 0, { ramp = { from = 0, to = 1, start = 0, end = 1 } }]
        [[obstacle]]
        name = "post"
        kind = "capsule"
        from = [0, 0, 0]
        to = [0, 1, 0]
        radius = 0.1
        [[closure]]
        name = "hand in hand"
        kind = "ball"
        first = "walker/hand_r"
        second = "partner/hand_l"
        on_first = [0, -0.1, 0]
        active = false
        [[event]]
        time = 0.7
        remove = "hand in hand"
        [[event]]
        time = 0.2
        add = "hand in hand"
        [[ignore]]
        pair = ["walker", "walker"]
        [[ignore]]
        pair = ["post", "partner/hand_r"]
        [output]
        contacts = false
        plot = ["energy", "closure:hand in hand"]
        "#,
    );
    assert_eq!((scene.integrator, scene.projection), (Integrator::RungeKutta, false));
    assert_eq!((scene.solver.method, scene.solver.max_iterations), (Method::ConjugateGradient, 20));
    let names: Vec<&str> = scene.materials.iter().map(|material| material.name.as_str()).collect();
    assert_eq!(names, ["default", "shoe", "mat"]);
    assert_eq!(scene.materials[0].law, MaterialLaw::Rigid { friction: 0.1, restitution: 0.0 });
    let MaterialLaw::HuntCrossley { stiffness, dissipation, .. } = scene.materials[1].law else { panic!("soft") };
    near(stiffness, 1e6);
    near(dissipation, 1.0);
    assert_eq!(scene.materials[2].law, MaterialLaw::Regularised { friction: 0.7, stiffness: 2e4, damping: 100.0 });

    let [walker, doll, partner] = &scene.figures[..] else { panic!("three figures") };
    assert_eq!((&walker.driven, walker.root, walker.from_s), (&DrivenCoordinates::All, RootMotion::Driven, Some(0.4)));
    assert_eq!(walker.motion.as_deref(), Some("walk.mot"));
    near_vector(walker.pose.place(Vec3::x()), [0.0, 0.0, 0.0]);
    assert_eq!((walker.spheres[0].body.as_str(), walker.spheres[0].material), ("calcn_r", 1));
    assert_eq!((&doll.driven, doll.root), (&DrivenCoordinates::Nothing, RootMotion::Free));
    assert_eq!(partner.driven, DrivenCoordinates::Only(vec!["knee_angle_r".into(), "knee_angle_l".into()]));

    let ObstacleShape::HeightField { heights, size_x, size_z } = &scene.obstacles[0].shape else { panic!("terrain") };
    assert_eq!((heights.len(), heights[1][1], *size_x, *size_z), (2, 0.2, 4.0, 2.0));
    let motion = scene.obstacles[0].motion.as_ref().unwrap();
    assert_eq!(motion.displacement[1], TimeFunction::Constant(0.0));
    assert_eq!(motion.displacement[2], TimeFunction::Stops(vec![(0.0, 0.0), (1.0, 1.0)]));
    assert_eq!(motion.angle, TimeFunction::Constant(0.0));
    let TimeFunction::Motion { place, file, column, from_s: None } = &motion.displacement[0] else {
        panic!("a column")
    };
    assert_eq!((file.as_str(), column.as_str()), ("belt.sto", "x"));
    assert!(place.line > 1 && place.key.starts_with("obstacle[1].motion.displacement[1]"), "{place:?}");
    assert!(matches!(scene.obstacles[1].shape, ObstacleShape::Solid(Solid::Capsule { .. })));

    let first = &scene.closures[0].first;
    assert!(matches!(first, Attachment::FigureBody { figure: 0, body } if body == "hand_r"), "{first:?}");
    assert_eq!(scene.closures[0].anchor, Anchor::AsFound { on_first: Vec3::new(0.0, -0.1, 0.0) });
    // In the order of time, not of the file.
    let changes: Vec<EventAction> = scene.events.iter().map(|event| event.change).collect();
    assert_eq!(changes, [EventAction::AddClosure(0), EventAction::RemoveClosure(0)]);
    assert_eq!(
        (&scene.ignored[0].first, &scene.ignored[1].first),
        (&ContactPartner::Figure(0), &ContactPartner::Obstacle(1))
    );
    assert_eq!(scene.outputs.plots, [Plot::Energy, Plot::Closure(0)]);
    assert!(!scene.outputs.contacts && scene.outputs.joints);
}

// ---- uniform solids ----

/// Inertia about the mass centre of a body of 1 kg with these shapes in a scene.
fn inertia_of(shapes: &str) -> Mat3 {
    let text = format!("step = 1\nduration = 1\n[[body]]\nname = \"b\"\nmass = 1\nshape = {shapes}\n");
    parse(&text).bodies[0].inertia.about_center()
}

/// The same as a sum over a grid of points that are inside, spaced `h`.
fn summed(inside: impl Fn(Vec3) -> bool, reach: f64, h: f64) -> Mat3 {
    let n = (reach / h) as i32;
    let (mut sum, mut count) = (Mat3::zeros(), 0.0);
    for (i, j, k) in (-n..n).flat_map(|i| (-n..n).flat_map(move |j| (-n..n).map(move |k| (i, j, k)))) {
        let p = Vec3::new(f64::from(i) + 0.5, f64::from(j) + 0.5, f64::from(k) + 0.5) * h;
        if inside(p) {
            sum += Mat3::identity() * p.norm_squared() - p * p.transpose();
            count += 1.0;
        }
    }
    sum / count
}

#[test]
fn shapes_without_inertia_are_uniform_solids() {
    let to_segment = |p: Vec3, a: Vec3, b: Vec3| {
        let t = ((p - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
        (p - a - (b - a) * t).norm()
    };
    let (a, b) = (Vec3::new(-0.3, 0.0, -0.2), Vec3::new(0.3, 0.0, 0.2));
    let turned = PI / 6.0;
    let in_box = |p: Vec3| {
        let (sin, cos) = turned.sin_cos();
        let q = Vec3::new(cos * p.x + sin * p.y, -sin * p.x + cos * p.y, p.z);
        q.x.abs() < 0.4 && q.y.abs() < 0.2 && q.z.abs() < 0.1
    };
    let in_dumbbell = |p: Vec3| [-0.3, 0.3].iter().any(|x| (p - Vec3::new(*x, 0.0, 0.0)).norm() < 0.2);
    let cases = [
        (inertia_of("{ kind = \"sphere\", radius = 0.5 }"), summed(|p| p.norm() < 0.5, 0.6, 0.01)),
        (
            inertia_of("{ kind = \"capsule\", from = [-0.3, 0, -0.2], to = [0.3, 0, 0.2], radius = 0.2 }"),
            summed(|p| to_segment(p, a, b) < 0.2, 0.6, 0.01),
        ),
        (
            inertia_of("{ kind = \"box\", size = [0.8, 0.4, 0.2], rotation = { axis = [0, 0, 1], angle_deg = 30 } }"),
            summed(in_box, 0.6, 0.01),
        ),
        (
            inertia_of(
                "[{ kind = \"sphere\", radius = 0.2, at = [-0.3, 0, 0] }, { kind = \"sphere\", radius = 0.2, \
                 at = [0.3, 0, 0] }]",
            ),
            summed(in_dumbbell, 0.6, 0.01),
        ),
    ];
    // A cell of 0.01 on the surface of a solid half as large as 0.1 to 0.5 is in or out as a whole: well under 1 %.
    for (found, expected) in cases {
        assert!((found - expected).amax() < 0.01 * expected.amax(), "{found} {expected}");
    }
    // The same box not turned is another: the comparison sees the difference.
    let straight = inertia_of("{ kind = \"box\", size = [0.8, 0.4, 0.2] }");
    assert!((straight - summed(in_box, 0.6, 0.01)).amax() > 0.1 * straight.amax());
}

/// A built-in figure; `build` is in line 4.
fn person(build: &str, more: &str) -> String {
    format!("step = 1\nduration = 1\n[[figure]]\nbuild = {build}\nname = \"ann\"\n{more}\n")
}

const ANN: &str = "{ table = \"de-leva-female\", mass = 60, height = 1.65 }";

#[test]
fn built_figures_read_as_they_say() {
    let file = parse(&person(
        ANN,
        "walk = { gait = \"slow\", speed = 0.9, mode = \"curves\", phase = 0.25 }\narms = \
         { left = { abduction_deg = 30, stiffness = 20, damping = 2 } }\n\
         shoes = \"default\"\nat = [1, 0, 2]\n[[figure.coordinate]]\nname = \"arm_flex_l\"\nstart_deg = 90\n\
         follow = { stiffness = 5 }\n[[figure.coordinate]]\nname = \"knee_angle_r\"",
    ));
    let built = file.figures[0].built.as_ref().unwrap();
    assert!(built.build.toe_joint && (built.build.mass - 60.0).abs() < ROUNDING);
    assert_eq!((built.build.table.name(), built.shoes), ("de-leva-female", Some(0)));
    let walk = built.walk.as_ref().unwrap();
    assert_eq!(
        (&walk.gait, walk.speed, walk.mode),
        (&GaitSource::Named("slow".into()), Some(0.9), FigureWalkMode::Curves)
    );
    near(walk.phase, 0.25);
    near(built.arms[1].abduction, PI / 6.0);
    assert_eq!((built.arms[0], built.arms[1].spring), (ArmEntry::default(), Some([20.0, 2.0])));
    let [arm, knee] = &built.coordinates[..] else { panic!("two coordinates") };
    near(arm.acting.start, PI / 2.0);
    assert_eq!((arm.starts, knee.starts, knee.follow), ([true, false], [false, false], None));
    let follow = arm.follow.unwrap();
    assert!((follow.stiffness - 5.0).abs() < ROUNDING && follow.damping.abs() < ROUNDING && follow.max.is_infinite());
    let file = parse(&person(ANN, "walk = { gait = \"mine.toml\" }"));
    let walk = file.figures[0].built.as_ref().unwrap().walk.as_ref().unwrap();
    assert_eq!((&walk.gait, walk.mode), (&GaitSource::File("mine.toml".into()), FigureWalkMode::Corrected));
}

// ---- the reference ----

fn reference() -> String {
    fs::read_to_string(root().join("docs/SCENES.md")).expect("docs/SCENES.md")
}

#[test]
fn the_scenes_of_the_reference_parse() {
    let text = reference();
    let scenes: Vec<&str> = text.split("```toml\n").skip(1).map(|rest| rest.split("```").next().unwrap()).collect();
    let whole: Vec<&&str> = scenes.iter().filter(|scene| scene.contains("duration =")).collect();
    assert!(!whole.is_empty());
    for scene in whole {
        parse(scene);
    }
}

/// A misplaced key makes the reader list the keys it knows there: the reference must have them all.
#[test]
fn the_reference_has_every_key() {
    let text = reference();
    let mut asked = 0;
    let mut check = |scene: &str| {
        let error = refusal(scene);
        let list = error.message.split("expected ").nth(1).unwrap_or_else(|| panic!("{error}"));
        assert!(error.key.ends_with("zzz"), "{error}");
        assert!(!list.contains('…'), "{error}");
        for key in list.split(", ") {
            assert!(text.contains(key), "docs/SCENES.md has no {key}, which {} may have", error.key);
            asked += 1;
        }
    };
    let scene =
        |more: &str| format!("step = 1\nduration = 1\n{more}\n[[body]]\nname = \"b\"\nmass = 1\ninertia = [1,1,1]\n");
    check("zzz = 1");
    let joint = "name = \"j\"\nparent = \"world\"\nchild = \"b\"\nat = [0,0,0]\n";
    for kind in ["weld", "revolute", "universal", "ball", "prismatic", "planar", "free"] {
        check(&format!("{}[[joint]]\n{joint}kind = \"{kind}\"\nzzz = 1", scene("")));
        check(&format!("{}[[closure]]\nname = \"c\"\nkind = \"{kind}\"\nzzz = 1", scene("")));
    }
    let hinge = format!("{}[[joint]]\n{joint}kind = \"revolute\"\naxis = [1,0,0]\n", scene(""));
    for part in ["zzz = 1", "spring.zzz = 1", "limits.zzz = 1", "motor.zzz = 1", "drive.zzz = 1"] {
        check(&format!("{hinge}[joint.coordinate]\n{part}"));
    }
    for function in ["sine", "ramp"] {
        check(&format!("{hinge}[joint.coordinate]\ndrive.{function}.zzz = 1"));
    }
    check(&format!("{hinge}[joint.coordinate]\ndrive = {{ motion = \"a\", zzz = 1 }}"));
    for law in ["rigid", "regularised", "hunt-crossley"] {
        check(&scene(&format!("[material.m]\nlaw = \"{law}\"\nzzz = 1")));
    }
    for kind in ["sphere", "capsule", "box", "convex"] {
        check(&format!("{}[[body.shape]]\nkind = \"{kind}\"\nzzz = 1", scene("")));
    }
    for kind in ["sphere", "capsule", "box", "convex", "plane", "height-field"] {
        check(&scene(&format!("[[obstacle]]\nname = \"o\"\nkind = \"{kind}\"\nzzz = 1")));
    }
    let plane = "[[obstacle]]\nname = \"o\"\nkind = \"plane\"\n";
    for part in ["motion.zzz = 1", "rotation.zzz = 1", "rotation = { quaternion = [1,0,0,0], zzz = 1 }"] {
        check(&scene(&format!("{plane}{part}")));
    }
    let figure = "[[figure]]\nname = \"f\"\nmodel = \"m\"\n";
    check(&scene(&format!("{figure}zzz = 1")));
    check(&scene(&format!("{figure}[[figure.sphere]]\nzzz = 1")));
    let person = "[[figure]]\nname = \"f\"\nbuild = { table = \"de-leva-male\", mass = 75, height = 1.8 }\n";
    check(&scene(&format!("{person}zzz = 1")));
    check(&scene(&person.replace("mass", "zzz = 1, mass")));
    for part in ["walk.zzz = 1", "arms.zzz = 1", "arms.right.zzz = 1", "[[figure.coordinate]]\nzzz = 1"] {
        check(&scene(&format!("{person}{part}")));
    }
    let own = "walk = {}\n[[figure.coordinate]]\nname = \"arm_flex_r\"\n";
    check(&scene(&format!("{person}{own}follow.zzz = 1")));
    for table in ["[solver]", "[output]", "[[event]]", "[[ignore]]", "[[body]]"] {
        check(&format!("{}{table}\nzzz = 1", scene("")));
    }
    assert!(asked > 150, "{asked}");
}

// ---- anything ----

/// The examples and the good scene.
fn seeds() -> Vec<String> {
    examples().into_iter().map(|(_, text)| text).chain([GOOD.to_owned()]).collect()
}

/// The line of every error is in the text.
fn survives(text: &str) -> Result<(), TestCaseError> {
    if let Err(error) = SceneFile::parse(text) {
        prop_assert!(error.line >= 1 && error.line <= text.matches('\n').count() + 1, "{}", error);
        prop_assert!(!error.message.is_empty());
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, ..ProptestConfig::default() })]

    #[test]
    fn a_truncated_scene_is_no_panic(which: prop::sample::Index, cut: prop::sample::Index) {
        let seeds = seeds();
        let text = which.get(&seeds);
        let cut = cut.index(text.len() + 1);
        survives(&String::from_utf8_lossy(&text.as_bytes()[..cut]))?;
    }

    #[test]
    fn a_scene_with_changed_bytes_is_no_panic(
        which: prop::sample::Index,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let seeds = seeds();
        let mut bytes = which.get(&seeds).clone().into_bytes();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        survives(&String::from_utf8_lossy(&bytes))?;
    }

    /// Numbers are where a scene that still is TOML can hurt.
    #[test]
    fn a_scene_with_changed_numbers_is_no_panic(
        which: prop::sample::Index,
        at: prop::sample::Index,
        number in prop::sample::select(vec![
            "0", "-1", "nan", "inf", "1e-320", "1e-160", "1e15", "-1e15", "1e400", "true", "\"x\"", "[]", "{}", "0x10",
            "9999999999999999999999", "1979-05-27",
        ]),
    ) {
        let seeds = seeds();
        let text = which.get(&seeds);
        let digits: Vec<usize> = text.char_indices().filter(|(_, c)| c.is_ascii_digit()).map(|(i, _)| i).collect();
        let start = *at.get(&digits);
        let of_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | 'e' | '-');
        let from = text[..start].rfind(|c| !of_number(c)).map_or(0, |i| i + 1);
        let to = text[start..].find(|c| !of_number(c)).map_or(text.len(), |i| start + i);
        survives(&format!("{}{number}{}", &text[..from], &text[to..]))?;
    }
}
