//! Reading models from OpenSim documents: every layout gives the same model, and errors state the position.

use ambulo::dynamics::{Workspace, inverse_frame};
use ambulo::findings::{Code, Findings};
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::{CoordinateKind, Drive, Model, from_osim};
use ambulo::spatial::Vec3;
use ambulo_formats::osim::OsimModel;
use std::path::{Path, PathBuf};

/// Sums and products of a dozen numbers of size 100.
const ROUNDING: f64 = 1e-12;

fn import(text: &str) -> (Model, Findings) {
    let mut findings = Findings::default();
    let document = OsimModel::read(text.as_bytes()).unwrap_or_else(|e| panic!("{e}\n{text}"));
    (from_osim(&document, &mut findings).unwrap_or_else(|e| panic!("{e}\n{text}")), findings)
}

/// The message of the step that rejects the document.
fn refusal(text: &str) -> String {
    match OsimModel::read(text.as_bytes()) {
        Err(error) => error.to_string(),
        Ok(document) => with_causes(&from_osim(&document, &mut Findings::default()).unwrap_err()),
    }
}

/// The message and what caused it, as a shell prints them.
fn with_causes(error: &dyn std::error::Error) -> String {
    let causes = std::iter::successors(Some(error), |e| e.source());
    causes.map(ToString::to_string).collect::<Vec<_>>().join(": ")
}

/// Asserts that the document is rejected with the line of `place` (the beginning of an element) and these words.
#[track_caller]
fn assert_refused(text: &str, place: &str, words: &[&str]) {
    let message = refusal(text);
    let line = text.lines().position(|l| l.contains(place)).unwrap() + 1;
    for word in words.iter().copied().chain([format!("line {line}").as_str()]) {
        assert!(message.contains(word), "`{word}` is missing in: {message}");
    }
}

// ---- One leg in every layout ----

const HIP_COORDINATE: &str =
    r#"<Coordinate name="hip_angle"><default_value>0.1</default_value><range>-2 2</range></Coordinate>"#;
const KNEE_COORDINATE: &str = r#"<Coordinate name="knee_angle"><default_value>-0.2</default_value></Coordinate>"#;

/// The knee: rotation about an oblique axis, with a centre that moves along a spline.
fn spatial_transform(spline: &str, wrap: impl Fn(&str) -> String) -> String {
    let axis = |name: &str, coordinates: &str, axis: &str, function: &str| {
        format!(
            "<TransformAxis name=\"{name}\"><coordinates>{coordinates}</coordinates><axis>{axis}</axis>{}\
             </TransformAxis>\n",
            wrap(function)
        )
    };
    let knots = "<x>-2 -1 -0.4 0 0.3</x><y>-0.01 0.02 0.03 0.035 0.02</y>";
    let still = "<Constant name=\"function\"><value>0</value></Constant>";
    let line = "<LinearFunction name=\"function\"><coefficients>1 0</coefficients></LinearFunction>";
    let curve = format!("<{spline} name=\"function\">{knots}</{spline}>");
    let scaled = format!(
        "<MultiplierFunction name=\"function\"><function>{curve}</function><scale>1.1</scale></MultiplierFunction>"
    );
    [
        "<SpatialTransform>\n".to_owned(),
        axis("rotation1", "knee_angle", "0 0.6 0.8", line),
        axis("rotation2", "", "0 1 0", still),
        axis("rotation3", "", "1 0 0", still),
        axis("translation1", "knee_angle", "1 0 0", &curve),
        axis("translation2", "knee_angle", "0 1 0", &scaled),
        axis("translation3", "", "0 0 1", "<Constant name=\"function\"><value>0.004</value></Constant>"),
        "</SpatialTransform>\n".to_owned(),
    ]
    .concat()
}

const HIP_PLACE: &str = "0.1 0.9 0.05";
const HIP_TURN: &str = "0.2 -0.1 0.3";
const THIGH_PLACE: &str = "0.01 0.02 -0.03";
const THIGH_TURN: &str = "-0.1 0.2 0.05";
const KNEE_PLACE: &str = "0 -0.4 0.01";
const KNEE_TURN: &str = "0.05 0 -0.04";

fn masses(six: bool) -> [String; 2] {
    [("8", "0 -0.17 0.01", "0.13 0.03 0.14 0.001 0.002 -0.003"), ("3.5", "0.01 -0.19 0", "0.05 0.005 0.05 0 0.001 0")]
        .map(|(mass, center, inertia)| {
            let inertia = if six {
                format!("<inertia>{inertia}</inertia>")
            } else {
                let names = ["xx", "yy", "zz", "xy", "xz", "yz"];
                let one = |(axes, x): (&str, &str)| format!("<inertia_{axes}>{x}</inertia_{axes}>");
                names.into_iter().zip(inertia.split(' ')).map(one).collect()
            };
            format!("<mass>{mass}</mass><mass_center>{center}</mass_center>{inertia}\n")
        })
}

fn document(version: u32, inside: &str) -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<OpenSimDocument Version=\"{version}\">\n<Model name=\"leg\">\n\
         <gravity>0 -9.80665 0</gravity>\n{inside}\n</Model>\n</OpenSimDocument>\n"
    )
}

/// Joints inside their child bodies: OpenSim 2 and 3.
fn nested(version: u32, spline: &str) -> String {
    let [thigh, shank] = masses(false);
    let knee = spatial_transform(spline, |f| format!("<function>{f}</function>"));
    let set = |c: &str| format!("<CoordinateSet><objects>{c}</objects></CoordinateSet>");
    let inside = format!(
        "<BodySet><objects>\n<Body name=\"ground\"><mass>0</mass></Body>\n<Body name=\"thigh\">{thigh}<Joint>\n\
         <PinJoint name=\"hip\"><parent_body>ground</parent_body><location_in_parent>{HIP_PLACE}</location_in_parent>\
         <orientation_in_parent>{HIP_TURN}</orientation_in_parent><location>{THIGH_PLACE}</location>\
         <orientation>{THIGH_TURN}</orientation>{}</PinJoint>\n</Joint></Body>\n<Body name=\"shank\">{shank}<Joint>\n\
         <CustomJoint name=\"knee\"><parent_body>thigh</parent_body>\
         <location_in_parent>{KNEE_PLACE}</location_in_parent>\
         <orientation_in_parent>{KNEE_TURN}</orientation_in_parent><location>0 0 0</location>\
         <orientation>0 0 0</orientation>{}{knee}</CustomJoint>\n</Joint></Body>\n</objects></BodySet>",
        set(HIP_COORDINATE),
        set(KNEE_COORDINATE)
    );
    document(version, &inside)
}

/// Joints in a set with offset frames: since 30505. `socket` writes what a component is connected to.
fn framed(version: u32, socket: impl Fn(&str, &str) -> String, roots: [&str; 2]) -> String {
    let [thigh, shank] = masses(true);
    let knee = spatial_transform("SimmSpline", str::to_owned);
    let frame = |name: &str, parent: &str, place: &str, turn: &str| {
        format!(
            "<PhysicalOffsetFrame name=\"{name}\">{}<translation>{place}</translation><orientation>{turn}</orientation>\
             </PhysicalOffsetFrame>\n",
            socket("parent", parent)
        )
    };
    let [ground, bodies] = roots;
    let of = |body: &str| format!("{bodies}{body}");
    let inside = format!(
        "<BodySet><objects>\n<Body name=\"thigh\">{thigh}</Body>\n\
         <Body name=\"shank\">{shank}</Body>\n</objects></BodySet>\n\
         <JointSet><objects>\n<PinJoint name=\"hip\">{}{}\
         <coordinates>{HIP_COORDINATE}</coordinates><frames>{}{}</frames>\
         </PinJoint>\n<CustomJoint name=\"knee\">{}{}\
         <coordinates>{KNEE_COORDINATE}</coordinates><frames>{}</frames>{knee}\
         </CustomJoint>\n</objects></JointSet>",
        socket("parent_frame", "ground_offset"),
        socket("child_frame", "thigh_offset"),
        frame("ground_offset", ground, HIP_PLACE, HIP_TURN),
        frame("thigh_offset", &of("thigh"), THIGH_PLACE, THIGH_TURN),
        socket("parent_frame", "thigh_offset"),
        socket("child_frame", &of("shank")),
        frame("thigh_offset", &of("thigh"), KNEE_PLACE, KNEE_TURN),
    );
    document(version, &inside)
}

fn connectors(name: &str, target: &str) -> String {
    format!(
        "<connectors><Connector_PhysicalFrame_ name=\"{name}\"><connectee_name>{target}</connectee_name>\
         </Connector_PhysicalFrame_></connectors>"
    )
}

/// Two sockets of one joint in one `<connectors>`.
fn joined_connectors(text: String) -> String {
    text.replace("</connectors><connectors>", "")
}

fn layouts() -> Vec<(&'static str, String)> {
    let connectee =
        |name: &str, target: &str| format!("<socket_{name}_connectee_name>{target}</socket_{name}_connectee_name>");
    let socket = |name: &str, target: &str| format!("<socket_{name}>{target}</socket_{name}>");
    vec![
        ("20303, nested, NaturalCubicSpline", nested(20303, "NaturalCubicSpline")),
        ("30000, nested", nested(30000, "SimmSpline")),
        ("30505, connectors", joined_connectors(framed(30505, connectors, ["../ground", "../"]))),
        ("30515, socket_..._connectee_name", framed(30515, connectee, ["../ground", "../"])),
        ("40000, sockets", framed(40000, socket, ["/ground", "/bodyset/"])),
    ]
}

/// Generalised forces at one posture, and the place of the shank.
fn behaviour(model: &Model) -> Vec<f64> {
    let posture = Posture { q: &[0.37, -0.81], qd: &[2.3, -4.1], qdd: &[-17.0, 31.0] };
    let mut workspace = Workspace::new(model);
    let mut all = inverse_frame(&mut workspace, posture, &[]).generalized().to_vec();
    for body in body_motion(model, posture) {
        all.extend(body.pose.translation.iter().chain(body.pose.rotation.iter()));
    }
    all
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

#[test]
fn one_leg_is_the_same_model_in_every_layout_of_the_format() {
    let list = layouts();
    let (reference, _) = import(&list[0].1);
    let expected = behaviour(&reference);
    assert!(expected[..2].iter().all(|tau| tau.abs() > 1.0), "the posture is too tame: {expected:?}");
    for (name, text) in &list {
        let (model, findings) = import(text);
        assert!(findings.as_slice().is_empty(), "{name}: {:?}", findings.as_slice());
        let names: Vec<_> = model.coordinates().iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["hip_angle", "knee_angle"], "{name}");
        assert_eq!(model.force_names(), ["hip_angle_moment", "knee_angle_moment"], "{name}");
        assert!((model.mass() - 11.5).abs() < ROUNDING, "{name}: {} kg", model.mass());
        assert_eq!(model.coordinates()[0].range, Some([-2.0, 2.0]), "{name}");
        let difference = distance(&behaviour(&model), &expected);
        assert!(difference < ROUNDING, "{name} differs by {difference}");
        // Counter-example: a frame rotated by a hundredth of a radian is noticed.
        let turned = import(&text.replace(HIP_TURN, "0.21 -0.1 0.3")).0;
        assert!(distance(&behaviour(&turned), &expected) > 1e-3, "{name}: a turned frame goes unnoticed");
    }
}

// ---- Parts of a small document in the layout of 40000 ----

/// One body on ground by `joint`, the text of a joint without its frames; more text may follow the sets.
fn single(joint: &str, more: &str) -> String {
    let (open, rest) = joint.split_once('>').unwrap();
    let sockets =
        "<socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>/bodyset/stone</socket_child_frame>";
    document(
        40000,
        &format!(
            "<BodySet><objects>\n<Body name=\"stone\"><mass>2</mass><mass_center>0 0 0</mass_center>\
             <inertia>0.1 0.1 0.1 0 0 0</inertia></Body>\n</objects></BodySet>\n<JointSet><objects>\n\
             {open}>{sockets}{rest}\n\
             </objects></JointSet>\n{more}"
        ),
    )
}

fn coordinates(names: &[&str]) -> String {
    let one = |n: &&str| format!("<Coordinate name=\"{n}\"></Coordinate>");
    format!("<coordinates>\n{}</coordinates>", names.iter().map(one).collect::<String>())
}

fn simple(kind: &str, names: &[&str]) -> String {
    single(&format!("<{kind} name=\"joint\">{}</{kind}>", coordinates(names)), "")
}

/// A custom joint whose body rises along y by a function of the coordinate `q`.
fn rising(function: &str) -> String {
    custom("q", function, "")
}

fn custom(follows: &str, function: &str, more: &str) -> String {
    let axis = |name: &str, axis: &str| {
        let (coordinate, held) = if name == "translation2" { (follows, function) } else { ("", "") };
        format!(
            "<TransformAxis name=\"{name}\"><coordinates>{coordinate}</coordinates><axis>{axis}</axis>{held}\
             </TransformAxis>\n"
        )
    };
    let axes = [("rotation1", "1 0 0"), ("rotation2", "0 1 0"), ("rotation3", "0 0 1")].into_iter().chain([
        ("translation1", "1 0 0"),
        ("translation2", "0 1 0"),
        ("translation3", "0 0 1"),
    ]);
    let axes: String = axes.map(|(name, direction)| axis(name, direction)).collect();
    let list = coordinates(&["q", "p"]);
    single(
        &format!("<CustomJoint name=\"joint\">{list}<SpatialTransform>\n{axes}</SpatialTransform></CustomJoint>"),
        more,
    )
}

#[test]
fn each_joint_type_has_its_coordinates_in_opensims_order_and_kind() {
    use CoordinateKind::{Rotation as R, Translation as T};
    let table: [(&str, &[CoordinateKind]); 9] = [
        ("WeldJoint", &[]),
        ("PinJoint", &[R]),
        ("SliderJoint", &[T]),
        ("UniversalJoint", &[R, R]),
        ("BallJoint", &[R, R, R]),
        ("GimbalJoint", &[R, R, R]),
        ("PlanarJoint", &[R, T, T]),
        ("FreeJoint", &[R, R, R, T, T, T]),
        ("EllipsoidJoint", &[R, R, R]),
    ];
    let names = ["a", "b", "c", "d", "e", "f"];
    for (kind, kinds) in table {
        let mut text = simple(kind, &names[..kinds.len()]);
        text = text.replace("</EllipsoidJoint>", "<radii_x_y_z>0.3 0.4 0.5</radii_x_y_z></EllipsoidJoint>");
        let (model, findings) = import(&text);
        let found: Vec<_> = model.coordinates().iter().map(|c| c.kind).collect();
        assert_eq!(found, kinds, "{kind}");
        assert!(findings.as_slice().is_empty(), "{kind}: {:?}", findings.as_slice());
        // One coordinate too many is rejected with the number of the joint.
        let more =
            simple(kind, &names[..(kinds.len() + 1) % 7]).replace("</Ell", "<radii_x_y_z>1 1 1</radii_x_y_z></Ell");
        if kinds.len() < 6 {
            assert_refused(&more, &format!("<{kind}"), &[kind, &format!("expected {} coordinates", kinds.len())]);
        }
    }
}

/// Place of the stone at these coordinates.
fn place(text: &str, q: &[f64]) -> Vec3 {
    let (model, _) = import(text);
    let zeros = vec![0.0; q.len()];
    body_motion(&model, Posture { q, qd: &zeros, qdd: &zeros })[0].pose.translation
}

#[test]
fn joints_move_along_the_axes_that_the_format_defines() {
    let near =
        |found: Vec3, x: f64, y: f64, z: f64| assert!((found - Vec3::new(x, y, z)).norm() < ROUNDING, "{found:?}");
    near(place(&simple("SliderJoint", &["a"]), &[0.5]), 0.5, 0.0, 0.0);
    // The planar joint rotates first and moves along the axes of the parent.
    near(place(&simple("PlanarJoint", &["a", "b", "c"]), &[0.7, 0.5, 0.25]), 0.5, 0.25, 0.0);
    near(place(&simple("FreeJoint", &["a", "b", "c", "d", "e", "f"]), &[1.0, 1.0, 1.0, 0.1, 0.2, 0.3]), 0.1, 0.2, 0.3);
    // The centre of the ellipsoid joint is in the direction of its z axis: x by sin b, y by -sin a cos b, z by cos a
    // cos b.
    let text = simple("EllipsoidJoint", &["a", "b", "c"])
        .replace("</EllipsoidJoint>", "<radii_x_y_z>0.3 0.4 0.5</radii_x_y_z></EllipsoidJoint>");
    let ((sa, ca), (sb, cb)) = (0.4_f64.sin_cos(), 0.9_f64.sin_cos());
    near(place(&text, &[0.4, 0.9, 0.2]), 0.3 * sb, -0.4 * sa * cb, 0.5 * ca * cb);
}

#[test]
fn each_function_gives_its_value() {
    let points = "<x>0 1 2 3 4 5 6 7</x><y>0 1 4 9 16 25 36 49</y>";
    let line = "<LinearFunction><coefficients>2 1</coefficients></LinearFunction>";
    let step = "<StepFunction><start_time>1</start_time><end_time>3</end_time><end_value>4</end_value></StepFunction>";
    let sine = "<Sine><amplitude>2</amplitude><omega>3</omega><phase>0.5</phase><offset>1</offset></Sine>";
    let table: [(String, f64, f64); 12] = [
        ("<Constant><value>0.25</value></Constant>".into(), 9.0, 0.25),
        (line.into(), 3.0, 7.0),
        ("<PolynomialFunction><coefficients>1 0 -2</coefficients></PolynomialFunction>".into(), 3.0, 7.0),
        (format!("<SimmSpline>{points}</SimmSpline>"), 3.0, 9.0),
        (format!("<GCVSpline><half_order>3</half_order>{points}</GCVSpline>"), 4.0, 16.0),
        (format!("<PiecewiseLinearFunction>{points}</PiecewiseLinearFunction>"), 2.5, 6.5),
        (format!("<PiecewiseLinearFunction>{points}</PiecewiseLinearFunction>"), 99.0, 49.0 + 92.0 * 13.0),
        (format!("<PiecewiseConstantFunction>{points}</PiecewiseConstantFunction>"), 2.5, 4.0),
        (step.into(), 2.0, 2.0),
        (step.into(), 9.0, 4.0),
        (sine.into(), 0.25, 1.0 + 2.0 * 1.25_f64.sin()),
        (format!("<MultiplierFunction><function>{line}</function><scale>-3</scale></MultiplierFunction>"), 1.0, -9.0),
    ];
    for (function, q, expected) in table {
        let found = place(&rising(&function), &[q, 0.0]).y;
        // A spline through ordinates up to 49 returns them to a few roundings.
        assert!((found - expected).abs() < 1e-11, "{function} at {q}: {found} instead of {expected}");
    }
    // An axis with a coordinate and no function follows it; without either it is constant.
    assert!((place(&rising(""), &[0.3, 0.0]).y - 0.3).abs() < ROUNDING);
}

#[test]
fn a_coordinate_is_coupled_in_kind_unless_an_axis_follows_it_one_to_one() {
    let kind = |function: &str| import(&rising(function)).0.coordinates()[0].kind;
    let linear =
        |slope: &str| kind(&format!("<LinearFunction><coefficients>{slope} 0</coefficients></LinearFunction>"));
    assert_eq!(linear("1"), CoordinateKind::Translation);
    assert_eq!(linear("-1"), CoordinateKind::Translation);
    assert_eq!(linear("0.5"), CoordinateKind::Coupled);
    assert_eq!(kind("<SimmSpline><x>0 1 2</x><y>0 1 2</y></SimmSpline>"), CoordinateKind::Coupled);
}

fn coupler(leader: &str, follower: &str, state: &str) -> String {
    format!(
        "<ConstraintSet><objects>\n<CoordinateCouplerConstraint name=\"tie\">{state}<coupled_coordinates_function>\
         <LinearFunction><coefficients>2 0.5</coefficients></LinearFunction></coupled_coordinates_function>\
         <independent_coordinate_names>{leader}</independent_coordinate_names>\
         <dependent_coordinate_name>{follower}</dependent_coordinate_name><scale_factor>3</scale_factor>\
         </CoordinateCouplerConstraint>\n</objects></ConstraintSet>"
    )
}

#[test]
fn a_coupler_ties_one_coordinate_to_another_unless_it_is_switched_off() {
    let drive = |state: &str| import(&custom("q", "", &coupler("q", "p", state))).0.coordinates()[1].drive.clone();
    let Drive::Coupled(leader, function) = drive("") else { panic!("not coupled") };
    assert_eq!(leader.index(), 0);
    assert!((function.at(1.0)[0] - 3.0 * 2.5).abs() < ROUNDING && (function.at(1.0)[1] - 6.0).abs() < ROUNDING);
    for off in ["<isDisabled>true</isDisabled>", "<isEnforced>false</isEnforced>"] {
        assert!(matches!(drive(off), Drive::Free), "{off}");
    }
    let place = "<CoordinateCouplerConstraint";
    assert_refused(&custom("q", "", &coupler("q", "knee", "")), place, &["constraint `tie`", "coordinate `knee`"]);
    assert_refused(&custom("q", "", &coupler("", "p", "")), place, &["name=\"tie\"", "independent_coordinate_names"]);
    let two = ["`q p` in <independent_coordinate_names>, which `p` follows", "one name. hint: keep"];
    assert_refused(&custom("q", "", &coupler("q p", "p", "")), place, &two);
    let circle = refusal(&custom("q", "", &coupler("q", "q", "")));
    assert!(circle.contains("coordinate `q` follows a coordinate that itself follows another"), "{circle}");
}

#[test]
fn a_constraint_that_closes_a_loop_is_not_enforced_but_reported() {
    let more = "<ConstraintSet><objects>\n<PointConstraint name=\"pin\"></PointConstraint>\n</objects></ConstraintSet>";
    let (_, findings) = import(&custom("q", "", more));
    assert!(findings.has(Code::ModelConstraint));
    let message = &findings.as_slice()[0].message;
    assert!(message.contains("PointConstraint `pin`") && message.contains("not enforced"), "{message}");
}

#[test]
fn locked_and_prescribed_coordinates_are_driven() {
    let text = custom("q", "", "");
    let line = "<prescribed_function><LinearFunction><coefficients>0.5 1</coefficients></LinearFunction>\
        </prescribed_function>";
    let with = |inside: &str| {
        let old = "<Coordinate name=\"q\">";
        let (model, _) = import(&text.replace(old, &format!("{old}<default_value>0.7</default_value>{inside}")));
        model.coordinates()[0].clone()
    };
    let locked = with("<locked>true</locked>");
    assert!(matches!(locked.drive, Drive::Locked) && (locked.default_value - 0.7).abs() < ROUNDING);
    let Drive::Prescribed(function) = with(&format!("{line}<prescribed>true</prescribed>")).drive else {
        panic!("free")
    };
    assert!((function.at(2.0)[0] - 2.0).abs() < ROUNDING);
    // A function that is not switched on and a lock that is off have no effect; a lock has priority.
    assert!(matches!(with(&format!("{line}<prescribed>false</prescribed><locked>false</locked>")).drive, Drive::Free));
    assert!(matches!(with(&format!("{line}<prescribed>true</prescribed><locked>true</locked>")).drive, Drive::Locked));
}

#[test]
fn markers_are_on_bodies_on_frames_and_on_ground() {
    let more = "<MarkerSet><objects>\n\
        <Marker name=\"old\"><body>stone</body><location>0.1 0.2 0.3</location></Marker>\n\
        <Marker name=\"new\">\
        <socket_parent_frame>/bodyset/stone</socket_parent_frame><location>1 2 3</location></Marker>\n\
        <Marker name=\"fixed\"><socket_parent_frame>/ground</socket_parent_frame><location>4 5 6</location></Marker>\n\
        <Marker name=\"turned\">\
        <socket_parent_frame>/bodyset/stone/patch</socket_parent_frame><location>1 0 0</location></Marker>\n\
        </objects></MarkerSet>";
    let patch = "<components><PhysicalOffsetFrame name=\"patch\"><socket_parent>..</socket_parent>\
        <translation>0 0 1</translation><orientation>0 0 1.5707963267948966</orientation>\
        </PhysicalOffsetFrame></components>";
    let text = custom("q", "", more).replacen("<inertia>", &format!("{patch}<inertia>"), 1);
    let (model, _) = import(&text);
    let stone = model.body("stone");
    let expected = [
        ("old", stone, [0.1, 0.2, 0.3]),
        ("new", stone, [1.0, 2.0, 3.0]),
        ("fixed", None, [4.0, 5.0, 6.0]),
        ("turned", stone, [0.0, 1.0, 1.0]),
    ];
    assert_eq!(model.markers().len(), 4);
    for (marker, (name, body, place)) in model.markers().iter().zip(expected) {
        assert_eq!((marker.name.as_str(), marker.body), (name, body));
        assert!((marker.location - Vec3::from(place)).norm() < ROUNDING, "{marker:?}");
    }
    let lost = custom("q", "", &more.replace("/bodyset/stone/patch", "/bodyset/sand"));
    assert_refused(&lost, "name=\"turned\"", &["Marker", "`/bodyset/sand`, which leads to no body"]);
}

#[test]
fn unused_parts_are_counted_in_one_note() {
    let more = "<ForceSet><objects>\n<PathSpring name=\"a\"/><PathSpring name=\"b\"/><Ligament name=\"c\"/>\n\
        </objects></ForceSet>";
    let (_, findings) = import(&custom("q", "", more));
    assert_eq!(findings.as_slice().len(), 1);
    let finding = &findings.as_slice()[0];
    assert_eq!((finding.code, finding.count), (Code::ModelIgnored, 1));
    assert!(finding.message.ends_with("1 Ligament, 2 PathSpring"), "{finding}");
}

#[test]
fn an_impossible_inertia_and_a_body_without_mass_give_warnings() {
    let text = custom("q", "", "");
    let with = |old: &str, new: &str| import(&text.replace(old, new)).1;
    let findings = with("<inertia>0.1 0.1 0.1", "<inertia>0.1 0.1 0.3");
    let message = &findings.as_slice()[0].message;
    assert!(findings.has(Code::ModelInertia) && message.contains("body `stone` (line 6)"), "{message}");
    assert!(message.contains("3.000e-1 exceeds the sum of the others"), "{message}");
    let findings = with("<inertia>0.1 0.1 0.1", "<inertia>0.1 0.1 -0.1");
    assert!(findings.as_slice()[0].message.contains("one is negative"), "{:?}", findings.as_slice());
    assert!(with("<mass>2<", "<mass>0<").has(Code::ModelMassless));
    // A thin rod is the limiting case and is allowed.
    assert!(with("<inertia>0.1 0.1 0.1", "<inertia>0.1 0.1 0").as_slice().is_empty());
}

#[test]
fn an_unknown_version_is_read_and_remarked() {
    for version in ["10901", "50000"] {
        let (_, findings) = import(&custom("q", "", "").replace("\"40000\"", &format!("\"{version}\"")));
        assert!(findings.has(Code::ModelDocument), "{version}");
        assert!(findings.as_slice()[0].message.contains(version), "{:?}", findings.as_slice());
    }
    assert_refused(&custom("q", "", "").replace("\"40000\"", "\"new\""), "<OpenSimDocument", &["`new`", "Version"]);
}

#[test]
fn errors_state_line_and_element() {
    let text = custom("q", "", "");
    assert_refused(&simple("ScrewJoint", &["q"]), "<ScrewJoint", &["joint type `ScrewJoint`", "PinJoint", "FreeJoint"]);
    assert_refused(&simple("CustomJoint", &["q"]), "<CustomJoint", &["name=\"joint\"", "<SpatialTransform>", "six"]);
    let mute = text.replace("/bodyset/stone</socket_child", "/bodyset/sand</socket_child");
    assert_refused(&mute, "<CustomJoint", &["`/bodyset/sand`, which leads to no body", "stone"]);
    let unconnected = text.replace("<socket_child_frame>/bodyset/stone</socket_child_frame>", "");
    assert_refused(&unconnected, "<CustomJoint", &["no <socket_child_frame>"]);
    let words =
        ["the axis `translation2` of the joint `joint`", "`q`, `p`", "a function of one coordinate. hint: keep"];
    assert_refused(&custom("q p", "", ""), "translation2", &words);
    assert_refused(&custom("knee", "", ""), "<CustomJoint", &["an axis that follows `knee`"]);
    let unknown = rising("<Spline3D><x>1</x></Spline3D>");
    assert_refused(&unknown, "<Spline3D", &["function type `Spline3D`", "SimmSpline"]);
    let falling = rising("<SimmSpline><x>0 2 1</x><y>0 1 2</y></SimmSpline>");
    assert_refused(&falling, "<SimmSpline", &["x = 2 followed by 1", "strictly rising"]);
    let uneven = rising("<SimmSpline><x>0 1 2</x><y>0 1</y></SimmSpline>");
    assert_refused(&uneven, "<SimmSpline", &["3 numbers in <x> and 2 in <y>"]);
    let two = rising("<LinearFunction><coefficients>1 2 3</coefficients></LinearFunction>");
    assert_refused(&two, "<LinearFunction", &["3 coefficients", "slope and intercept"]);
    assert_refused(&text.replace("<axis>0 1 0<", "<axis>0 0 0<"), "rotation2", &["the axis 0 0 0"]);
    assert_refused(&text.replace("<axis>0 1 0<", "<axis>0 1<"), "rotation2", &["2 numbers", "three numbers"]);
    assert_refused(&text.replace("<mass>2<", "<mass>two<"), "<mass>", &["`two`", "<mass>"]);
    assert_refused(&text.replace("<mass>2<", "<mass>nan<"), "<mass>", &["`nan`", "finite"]);
    assert_refused(&text.replace("<mass>2</mass>", ""), "<Body name", &["no <mass>", "name=\"stone\""]);
    assert_refused(
        &text.replace("<inertia>0.1 0.1 0.1 0 0 0<", "<inertia>1 1 1<"),
        "<Body name",
        &["3 numbers in <inertia>"],
    );
    let reversed = text.replace("<SpatialTransform>", "<reverse>true</reverse><SpatialTransform>");
    assert_refused(&reversed, "<CustomJoint", &["<reverse>true</reverse>"]);
    assert_refused(
        &text.replace("<Model ", "<Kit ").replace("</Model>", "</Kit>"),
        "<OpenSimDocument",
        &["<Kit>", "<Model>"],
    );
    assert_refused("<Person>\n</Person>", "<Person", &["root element <Person>", "<OpenSimDocument>"]);
}

#[test]
fn a_body_must_be_the_child_of_exactly_one_joint() {
    let text = custom("q", "", "");
    let body = "<Body name=\"drifter\"><mass>1</mass></Body>\n</objects></BodySet>";
    let loose = text.replace("</objects></BodySet>", body);
    assert_refused(&loose, "<Body name=\"drifter\"", &["body `drifter`", "not connected to ground", "FreeJoint"]);
    let second = "<WeldJoint name=\"second\"><socket_parent_frame>/ground</socket_parent_frame>\
        <socket_child_frame>/bodyset/stone</socket_child_frame></WeldJoint>\n</objects></JointSet>";
    let looped = text.replace("</objects></JointSet>", second);
    assert_refused(&looped, "<WeldJoint", &["body `stone`", "`joint` and `second`", "closed loops are not supported"]);
}

#[test]
fn a_negative_mass_is_rejected_with_the_name_and_line_of_the_body() {
    let text = custom("q", "", "").replace("<mass>2<", "<mass>-2<");
    assert_refused(&text, "<Body name", &["body `stone`", "the mass is -2 kg", "zero or more"]);
}

#[test]
fn a_repeated_coordinate_is_rejected_with_its_name_and_line() {
    let text = custom("q", "", "").replace("name=\"p\"", "name=\"q\"");
    assert_refused(&text, "<Coordinate name", &["`q`"]);
}

#[test]
fn an_unknown_parent_in_the_old_layout_is_named() {
    let text = nested(30000, "SimmSpline").replace("<parent_body>thigh<", "<parent_body>femur<");
    assert_refused(&text, "<CustomJoint", &["`femur`"]);
}

#[test]
fn other_documents_and_other_text_are_rejected() {
    assert_eq!(refusal(" \n"), "the file is empty; expected an <OpenSimDocument>");
    for text in ["no xml", "\u{0}\u{1}"] {
        assert!(refusal(text).contains("expected an XML document, which begins with `<`"), "{}", refusal(text));
    }
    for text in ["<", "<a>", "<OpenSimDocument Version=\"40000\">"] {
        assert!(refusal(text).starts_with("not a readable XML document:"), "{}", refusal(text));
    }
    let bomb = "<?xml version=\"1.0\"?>\n<!DOCTYPE z [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;\">]>\n\
        <OpenSimDocument Version=\"40000\"><Model name=\"&b;\"/></OpenSimDocument>";
    assert!(refusal(bomb).contains("DTD"), "{}", refusal(bomb));
}

#[test]
fn a_document_truncated_at_any_byte_is_rejected() {
    for (name, text) in layouts() {
        let end = text.trim_end().len();
        for cut in 0..end {
            let document = OsimModel::read(&text.as_bytes()[..cut]);
            assert!(document.is_err(), "{name}: cut at byte {cut} of {end} it still reads");
        }
    }
}

// ---- Real files ----

fn real_files() -> Vec<PathBuf> {
    let folder = match std::env::var_os("AMBULO_DATA") {
        Some(root) => PathBuf::from(root).join("data"),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"),
    };
    if !folder.is_dir() {
        assert!(std::env::var_os("CI").is_none(), "no recordings, and in CI no test may be skipped");
        println!("skipped: no data");
        return Vec::new();
    }
    let models = [
        "markerless-pose2sim/body25b.osim",
        "markerless-pose2sim/simple.osim",
        "opencap-adult-83kg/LaiArnoldModified2017_poly_withArms_weldHand_scaled.osim",
        "opensim-gait10dof-subject01/subject01.osim",
        "opensim-gait2392-subject01/subject01_simbody.osim",
        "opensim-rajagopal-walk/subject_walk_scaled.osim",
    ];
    models.into_iter().map(|name| folder.join(name)).collect()
}

#[test]
fn the_real_models_load_with_the_masses_that_their_authors_state() {
    // File, bodies, coordinates, mass [kg] with the digits in the README of the data.
    let expected =
        [("subject01.osim", 10, 72.6), ("subject01_simbody.osim", 23, 72.6), ("subject_walk_scaled.osim", 0, 85.27)];
    for file in real_files() {
        let text = String::from_utf8(std::fs::read(&file).unwrap()).unwrap();
        let (model, findings) = import(&text);
        let name = file.file_name().unwrap().to_string_lossy();
        println!(
            "{name}: {} bodies, {} coordinates, {:.3} kg",
            model.bodies().len(),
            model.coordinates().len(),
            model.mass()
        );
        for finding in findings.as_slice() {
            println!("  {finding}");
        }
        let Some((_, coordinates, mass)) = expected.iter().find(|(n, ..)| *n == name) else { continue };
        assert!((model.mass() - mass).abs() < 0.1, "{name}: {} kg instead of {mass}", model.mass());
        assert!(
            *coordinates == 0 || model.coordinates().len() == *coordinates,
            "{name}: {}",
            model.coordinates().len()
        );
    }
}

#[test]
fn a_real_model_truncated_anywhere_is_rejected_without_a_panic() {
    for file in real_files() {
        let bytes = std::fs::read(&file).unwrap();
        for cut in (0..bytes.len() - 64).step_by(10_007) {
            assert!(OsimModel::read(&bytes[..cut]).is_err(), "{}: cut at byte {cut} it still reads", file.display());
        }
    }
}
