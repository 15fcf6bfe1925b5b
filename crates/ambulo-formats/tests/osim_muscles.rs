//! Muscles in OpenSim documents, in both layouts; sets of reserve actuators.

use ambulo_formats::osim::{
    OsimForceSet, OsimFunction, OsimModel, OsimMuscleCurves, OsimMuscleKind, OsimMuscles, OsimPointPlace, OsimWrapShape,
};

/// A model with two bodies, everything nested as up to version 30500.
fn old(forces: &str) -> String {
    format!(
        "<OpenSimDocument Version=\"30000\"><Model name=\"m\"><BodySet><objects>\n\
         <Body name=\"ground\"><mass>0</mass><WrapObjectSet><objects><WrapSphere name=\"ball\"><radius>0.2</radius>\
         <translation>1 2 3</translation><quadrant>+y</quadrant></WrapSphere></objects></WrapObjectSet></Body>\n\
         <Body name=\"a\"><mass>1</mass><Joint><PinJoint name=\"j\"><parent_body>ground</parent_body><CoordinateSet>\
         <objects><Coordinate name=\"q\"/></objects></CoordinateSet></PinJoint></Joint></Body>\n\
         </objects></BodySet><ForceSet><objects>\n{forces}\n</objects></ForceSet></Model></OpenSimDocument>"
    )
}

/// The same model with joints in a set and sockets.
fn new(forces: &str) -> String {
    format!(
        "<OpenSimDocument Version=\"40000\"><Model name=\"m\">\n<Ground name=\"ground\"><WrapObjectSet><objects>\
         <WrapSphere name=\"ball\"><radius>0.2</radius><translation>1 2 3</translation><quadrant>+y</quadrant>\
         </WrapSphere></objects></WrapObjectSet></Ground>\n\
         <BodySet><objects><Body name=\"a\"><mass>1</mass></Body></objects></BodySet>\n\
         <JointSet><objects><PinJoint name=\"j\"><socket_parent_frame>/ground</socket_parent_frame>\
         <socket_child_frame>/bodyset/a</socket_child_frame><coordinates><Coordinate name=\"q\"/></coordinates>\
         </PinJoint></objects></JointSet><ForceSet><objects>\n{forces}\n</objects></ForceSet></Model></OpenSimDocument>"
    )
}

fn muscle(points: &str, more: &str) -> String {
    format!(
        "<Thelen2003Muscle name=\"m1\">\n{more}<GeometryPath><PathPointSet><objects>\n{points}\n</objects>\
         </PathPointSet><PathWrapSet><objects>\n<PathWrap><wrap_object>ball</wrap_object><range>1 \
         -1</range></PathWrap></objects>\
         </PathWrapSet></GeometryPath></Thelen2003Muscle>"
    )
}

const OLD_POINTS: &str = "<PathPoint name=\"p\"><location>0 0 1</location><body>ground</body></PathPoint>\n\
    <ConditionalPathPoint name=\"c\"><location>0 1 0</location><body>a</body><range>-1 0.5</range>\
    <coordinate>q</coordinate></ConditionalPathPoint>\n\
    <MovingPathPoint name=\"v\"><body>a</body><x_location><LinearFunction><coefficients>2 1</coefficients>\
    </LinearFunction></x_location><x_coordinate>q</x_coordinate></MovingPathPoint>";
const NEW_POINTS: &str = "<PathPoint name=\"p\"><socket_parent_frame>/ground</socket_parent_frame>\
    <location>0 0 1</location></PathPoint>\n\
    <ConditionalPathPoint name=\"c\"><socket_parent_frame>/bodyset/a</socket_parent_frame><location>0 1 0</location>\
    <socket_coordinate>/jointset/j/q</socket_coordinate><range>-1 0.5</range></ConditionalPathPoint>\n\
    <MovingPathPoint name=\"v\"><socket_parent_frame>/bodyset/a</socket_parent_frame>\
    <socket_x_coordinate>/jointset/j/q</socket_x_coordinate><x_location><LinearFunction><coefficients>2 1\
    </coefficients></LinearFunction></x_location></MovingPathPoint>";
const MOTOR: &str = "<CoordinateActuator name=\"t\"><coordinate>q</coordinate><optimal_force>50</optimal_force>\
    <min_control>-Inf</min_control></CoordinateActuator>";

fn read(text: &str) -> OsimMuscles {
    OsimModel::read(text.as_bytes()).unwrap().muscles.unwrap()
}

fn without_lines(mut muscles: OsimMuscles) -> OsimMuscles {
    muscles.muscles.iter_mut().for_each(|m| m.line = 0);
    muscles.wrap_objects.iter_mut().for_each(|w| w.line = 0);
    muscles.actuators.iter_mut().for_each(|a| a.line = 0);
    muscles
}

#[test]
fn both_layouts_give_the_same_muscles() {
    let first = read(&old(&(muscle(OLD_POINTS, "") + MOTOR)));
    let second = read(&new(&(muscle(NEW_POINTS, "") + MOTOR)));
    assert_eq!(without_lines(first.clone()), without_lines(second));
    assert_ne!(without_lines(first.clone()), without_lines(read(&old(&muscle(OLD_POINTS, "")))));
    let [muscle] = &first.muscles[..] else { panic!("{first:?}") };
    let OsimMuscleKind::Known(parameters) = &muscle.kind else { panic!("{muscle:?}") };
    assert_eq!((muscle.line, muscle.applies_force, parameters.control_range), (5, true, [0.01, 1.0]));
    assert_eq!(parameters.curves, OsimMuscleCurves::Thelen2003([0.04, 0.6, 0.45, 5.0, 0.25, 1.4, 0.95]));
    let [point, conditional, moving] = &parameters.path.points[..] else { panic!("{:?}", parameters.path) };
    assert_eq!((point.frame.body.as_str(), &point.place), ("ground", &OsimPointPlace::Fixed([0.0, 0.0, 1.0])));
    let expected =
        OsimPointPlace::Conditional { location_m: [0.0, 1.0, 0.0], coordinate: Some("q".into()), range: [-1.0, 0.5] };
    assert_eq!((conditional.frame.body.as_str(), &conditional.place), ("a", &expected));
    let OsimPointPlace::Moving(axes) = &moving.place else { panic!("{moving:?}") };
    assert_eq!(axes[0], (Some("q".to_owned()), OsimFunction::Linear { slope: 2.0, intercept: 1.0 }));
    assert_eq!(axes[1], (None, OsimFunction::Constant(0.0)));
    let [wrap] = &parameters.path.wraps[..] else { panic!() };
    assert_eq!((wrap.object.as_str(), wrap.range, wrap.method.as_str()), ("ball", [1, -1], "hybrid"));
    let [ball] = &first.wrap_objects[..] else { panic!("{:?}", first.wrap_objects) };
    assert_eq!((ball.line, ball.quadrant, &ball.shape), (2, "y", &OsimWrapShape::Sphere { radius: 0.2 }));
    assert_eq!((ball.frame.body.as_str(), ball.frame.translation_m), ("ground", [1.0, 2.0, 3.0]));
    let [motor] = &first.actuators[..] else { panic!("{:?}", first.actuators) };
    assert_eq!((motor.coordinate.as_str(), motor.optimal_force), ("q", 50.0));
    assert!(motor.control_range.map(f64::is_infinite) == [true; 2] && motor.control_range[0] < 0.0);
}

#[test]
fn written_muscles_read_back() {
    let millard = muscle(
        NEW_POINTS,
        "<fiber_damping>0.2</fiber_damping><max_control>0.9</max_control>\
        <ActiveForceLengthCurve name=\"f\"><minimum_value>0.3</minimum_value></ActiveForceLengthCurve>\
        <TendonForceLengthCurve name=\"t\"><curviness>0.4</curviness></TendonForceLengthCurve>",
    )
    .replace("Thelen2003Muscle", "Millard2012EquilibriumMuscle")
    .replace("m1", "m2");
    let document = OsimModel::read(new(&(muscle(NEW_POINTS, "") + &millard + MOTOR)).as_bytes()).unwrap();
    let again = OsimModel::read(&document.write().unwrap()).unwrap();
    let muscles = document.muscles.unwrap();
    assert_eq!(without_lines(again.muscles.unwrap()), without_lines(muscles.clone()));
    let OsimMuscleKind::Known(parameters) = &muscles.muscles[1].kind else { panic!() };
    let OsimMuscleCurves::Millard2012 { active_force_length, tendon_force_length, fiber_damping, .. } =
        &parameters.curves
    else {
        panic!("{:?}", parameters.curves)
    };
    assert_eq!((active_force_length[4], tendon_force_length[3], *fiber_damping), (0.3, Some(0.4), 0.2));
}

#[test]
fn what_is_read_is_not_counted_as_ignored() {
    let more = "<PathSpring name=\"s\"/><Schutte1993Muscle_Deprecated name=\"o\"/>";
    let document = OsimModel::read(new(&(muscle(NEW_POINTS, "") + MOTOR + more)).as_bytes()).unwrap();
    let ignored: Vec<_> = document.ignored.into_iter().collect();
    assert_eq!(ignored, [("PathSpring".to_owned(), 1), ("Schutte1993Muscle_Deprecated".to_owned(), 1)]);
    let muscles = document.muscles.unwrap();
    assert_eq!(muscles.muscles[1].kind, OsimMuscleKind::Other("Schutte1993Muscle_Deprecated".into()));
    // Such a document cannot be written without loss.
    let document = OsimModel::read(new(more).as_bytes()).unwrap();
    let error = document.write().unwrap_err().to_string();
    assert!(error.contains("the Schutte1993Muscle_Deprecated `o`"), "{error}");
}

#[test]
fn damaged_muscles_do_not_damage_the_model() {
    let damaged = |forces: &str, words: &[&str]| {
        let document = OsimModel::read(new(forces).as_bytes()).unwrap();
        assert_eq!((document.bodies.len(), document.joints.len()), (1, 1));
        let error = document.muscles.clone().unwrap_err().to_string();
        for word in words {
            assert!(error.contains(word), "{error}");
        }
        assert_eq!(document.write().unwrap_err().to_string(), error);
    };
    let whole = muscle(NEW_POINTS, "<max_isometric_force>5</max_isometric_force>");
    let replaced = |from: &str, to: &str, words: &[&str]| {
        assert!(whole.contains(from), "{from}");
        damaged(&whole.replace(from, to), words);
    };
    replaced("<max_isometric_force>5<", "<max_isometric_force>five<", &["line 6", "`five`", "finite numbers"]);
    replaced(
        "GeometryPath",
        "Scholz2015GeometryPath",
        &["line 5", "Thelen2003Muscle name=\"m1\"", "no <GeometryPath>"],
    );
    replaced("/bodyset/a<", "/bodyset/b<", &["line 8", "ConditionalPathPoint", "`/bodyset/b`, which leads to no body"]);
    replaced("<location>0 0 1</location>", "", &["line 7", "PathPoint name=\"p\"", "no <location>"]);
    replaced("0 0 1<", "0 0<", &["line 7", "2 numbers", "three numbers"]);
    replaced("-1 0.5<", "-1<", &["line 8", "1 numbers in <range>"]);
    replaced("LinearFunction", "Wobble", &["line 9", "the function type `Wobble`"]);
    replaced("<MovingPathPoint name=\"v\">", "<PathPoint2/><MovingPathPoint name=\"v\">", &["line 9", "PathPoint2"]);
    replaced("<range>1 -1<", "<range>1<", &["line 11", "PathWrap", "two whole numbers"]);
    replaced("<wrap_object>ball</wrap_object>", "", &["line 11", "no <wrap_object>"]);
    damaged(&muscle("", ""), &["line 5", "0 points in the path", "at least two"]);
    let motor = MOTOR.replace("<coordinate>q</coordinate>", "");
    damaged(&motor, &["line 5", "CoordinateActuator name=\"t\"", "no <coordinate>"]);
    damaged(
        &MOTOR.replace("-Inf", "1</min_control><max_control>0</max_control><min_control>"),
        &["controls from 1 to 0"],
    );
    let wrapped = new(&whole);
    for (from, to, words) in [("0.2</radius>", "-1</radius>", "-1 in <radius>"), ("+y", "up", "the quadrant `up`")] {
        let error = OsimModel::read(wrapped.replace(from, to).as_bytes()).unwrap().muscles.unwrap_err().to_string();
        assert!(error.contains("line 2") && error.contains("WrapSphere") && error.contains(words), "{error}");
    }
}

#[test]
fn sets_of_reserve_actuators_are_read() {
    let document = |set: &str| {
        format!("<OpenSimDocument Version=\"40000\">\n<ForceSet name=\"r\">{set}</ForceSet></OpenSimDocument>")
    };
    let listed = |objects: &str| document(&format!("<objects>{objects}</objects>"));
    let set = OsimForceSet::read(listed(&(MOTOR.to_owned() + "<PointActuator name=\"FX\"/>")).as_bytes()).unwrap();
    assert_eq!((set.name.as_str(), set.actuators.len()), ("r", 1));
    assert_eq!(set.ignored.into_iter().collect::<Vec<_>>(), [("PointActuator".to_owned(), 1)]);
    let off = MOTOR.replace("<coordinate>", "<appliesForce>false</appliesForce><coordinate>");
    for (text, words) in [
        (listed(""), "no <CoordinateActuator>"),
        (listed(&off), "no <CoordinateActuator>"),
        ("<OpenSimDocument Version=\"40000\"><Model/></OpenSimDocument>".to_owned(), "<Model>; expected a <ForceSet>"),
        (" ".to_owned(), "the file is empty"),
        ("<ForceSet".to_owned(), "not a readable XML document"),
    ] {
        let error = OsimForceSet::read(text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
}
