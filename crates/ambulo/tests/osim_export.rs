//! Models written as OpenSim models and read back are the same models.

use crate::marker_data;
use ambulo::findings::Findings;
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::{Displacement, Drive, ExportError, Function, JointAxis, Model, from_osim, to_osim};
use ambulo_formats::osim::{OsimJointKind, OsimModel};

fn figure(table: SegmentTable, toe_joint: bool) -> Model {
    Build { table, mass: 71.3, height: 1.734, toe_joint }.human().unwrap().model
}

fn read_back(model: &Model) -> Model {
    let mut findings = Findings::default();
    let read = Model::from_osim(&to_osim(model).unwrap().write().unwrap(), &mut findings).unwrap();
    assert!(findings.as_slice().is_empty(), "{findings:?}");
    read
}

#[test]
fn every_figure_is_unchanged_after_writing_and_reading() {
    for table in SegmentTable::ALL {
        for toe_joint in [true, false] {
            let (written, read) = (figure(table, toe_joint), &read_back(&figure(table, toe_joint)));
            // OpenSim allows no spaces in names.
            assert_eq!(read.name(), written.name().replace(" ", "_"));
            assert_eq!(read.gravity(), written.gravity());
            assert_eq!(read.bodies().len(), written.bodies().len());
            for body in written.bodies() {
                let same = &read.bodies()[read.body(&body.name).unwrap().index()];
                assert_eq!(same.inertia, body.inertia, "{table}, {}", body.name);
                assert_eq!(same.joint.name, body.joint.name);
            }
            for coordinate in written.coordinates() {
                let same = &read.coordinates()[read.coordinate(&coordinate.name).unwrap().index()];
                assert_eq!((same.kind, same.range), (coordinate.kind, coordinate.range), "{}", coordinate.name);
                assert!((same.default_value - coordinate.default_value).abs() < f64::EPSILON);
            }
            assert_eq!(read.markers().len(), written.markers().len());
            for (a, b) in read.markers().iter().zip(written.markers()) {
                assert_eq!((&a.name, a.location), (&b.name, b.location));
            }
        }
    }
}

#[test]
fn a_model_that_was_written_and_read_moves_the_same() {
    let written = figure(SegmentTable::DeLevaFemale, true);
    assert_same_motions(&written, &read_back(&written));
}

fn assert_same_motions(written: &Model, read: &Model) {
    // Arbitrary numbers, by name: the order of coordinates may differ.
    let number = |name: &str, k: usize| {
        let sum: usize = name.bytes().enumerate().map(|(i, b)| (i + 1) * usize::from(b)).sum();
        ((sum * (k + 3)) % 97) as f64 / 97.0 - 0.5
    };
    let motions = |model: &Model| {
        let values = |k: usize| model.coordinates().iter().map(|c| number(&c.name, k)).collect::<Vec<f64>>();
        let (q, qd, qdd) = (values(0), values(1), values(2));
        body_motion(model, Posture { q: &q, qd: &qd, qdd: &qdd })
    };
    let (a, b) = (motions(written), motions(read));
    for (i, body) in written.bodies().iter().enumerate() {
        let same = &b[read.body(&body.name).unwrap().index()];
        // A dozen products of numbers near one.
        assert!((same.center - a[i].center).norm() < 1e-13, "{}", body.name);
        assert!((same.pose.rotation - a[i].pose.rotation).norm() < 1e-13, "{}", body.name);
        assert!((same.twist.linear - a[i].twist.linear).norm() < 1e-12, "{}", body.name);
    }
}

#[test]
fn models_that_the_format_cannot_express_are_rejected() {
    let document = r#"<OpenSimDocument Version="40000"><Model name="m"><BodySet><objects>
        <Body name="b"><mass>1</mass><inertia>1 1 1 0 0 0</inertia></Body></objects></BodySet>
        <JointSet><objects><BallJoint name="ball"><socket_parent_frame>/ground</socket_parent_frame>
        <socket_child_frame>/bodyset/b</socket_child_frame><coordinates>
        <Coordinate name="x"/><Coordinate name="y"/><Coordinate name="z"/></coordinates></BallJoint>
        </objects></JointSet></Model></OpenSimDocument>"#;
    let mut findings = Findings::default();
    let ball = from_osim(&OsimModel::read(document.as_bytes()).unwrap(), &mut findings).unwrap();
    let mut bodies = ball.bodies().to_vec();
    bodies[0].joint.rotations.swap(0, 1);
    let odd = Model::new("m", ball.gravity(), bodies, ball.coordinates().to_vec(), Vec::new()).unwrap();
    let error = to_osim(&odd).unwrap_err();
    assert!(matches!(&error, ExportError::Unknown { name, .. } if name == "ball"), "{error}");
    assert!(
        error.to_string().contains("joint `ball`: found angular velocities about its own axes as speeds"),
        "{error}"
    );

    let still = "<TransformAxis><axis>1 0 0</axis></TransformAxis>".repeat(6);
    let end = format!("<SpatialTransform>{still}</SpatialTransform></CustomJoint>");
    let idle = document.replace("<BallJoint", "<CustomJoint").replace("</BallJoint>", &end);
    let model = Model::from_osim(idle.as_bytes(), &mut findings).unwrap();
    let error = to_osim(&model).unwrap_err().to_string();
    assert!(error.contains("coordinate `x`: found no axis of a joint that follows it"), "{error}");
}

#[test]
fn the_full_body_is_unchanged_after_writing_and_reading() {
    for table in SegmentTable::ALL {
        let build = Build { table, mass: 71.3, height: 1.734, toe_joint: true };
        let written = ambulo::model::full_body::full_body(&build).unwrap().model;
        let read = read_back(&written);
        assert_same_motions(&written, &read);
    }
}

#[test]
fn joints_with_angular_velocities_are_unchanged_after_writing_and_reading() {
    let body = |name: &str| format!(r#"<Body name="{name}"><mass>1</mass><inertia>1 1 1 0 0 0</inertia></Body>"#);
    let joint = |kind: &str, parent: &str, child: &str, count: usize, rest: &str| {
        let coordinates: String = (0..count).map(|k| format!(r#"<Coordinate name="{child}{k}"/>"#)).collect();
        format!(
            r#"<{kind} name="{child}_joint"><socket_parent_frame>p</socket_parent_frame><socket_child_frame>/bodyset/{child}</socket_child_frame>
            <frames><PhysicalOffsetFrame name="p"><socket_parent>{parent}</socket_parent><translation>0.1 0.2 0.3</translation>
            <orientation>0.3 -0.2 0.4</orientation></PhysicalOffsetFrame></frames><coordinates>{coordinates}</coordinates>{rest}</{kind}>"#
        )
    };
    let radii = "<radii_x_y_z>0.1 0.2 0.15</radii_x_y_z>";
    let document = format!(
        r#"<OpenSimDocument Version="40000"><Model name="m"><BodySet><objects>{}{}{}</objects></BodySet>
        <JointSet><objects>{}{}{}</objects></JointSet></Model></OpenSimDocument>"#,
        body("a"),
        body("b"),
        body("c"),
        joint("FreeJoint", "/ground", "a", 6, ""),
        joint("BallJoint", "/bodyset/a", "b", 3, ""),
        joint("EllipsoidJoint", "/bodyset/b", "c", 3, radii),
    );
    let written = Model::from_osim(document.as_bytes(), &mut Findings::default()).unwrap();
    let read = read_back(&written);
    assert_same_models(&written, &read);
    assert_same_motions(&written, &read);
}

/// Values, slopes and curvatures agree far inside, at and beyond the knots.
fn assert_same_curve(a: &Function, b: &Function, name: &str) {
    for i in -70..=70 {
        let x = f64::from(i) * 0.05;
        for (a, b) in a.at(x).into_iter().zip(b.at(x)) {
            // Equal to the last bit but for natural splines, whose coefficients are computed again.
            assert!((a - b).abs() <= 1e-12 * a.abs().max(1.0), "{name} at {x}: {a} and {b}");
        }
    }
}

fn assert_same_axes(a: &[JointAxis], b: &[JointAxis], name: &str) -> usize {
    // A missing axis of a joint is written as a constant one.
    assert!(b.len() == 3 || a.len() == b.len(), "{name}");
    let still = |axis: &JointAxis| matches!(axis.displacement, Displacement::Fixed(0.0));
    assert!(b[a.len()..].iter().all(still), "{name}");
    let mut curves = 0;
    for (a, b) in a.iter().zip(b) {
        assert!((a.direction - b.direction).norm() < 1e-15, "{name}");
        match (&a.displacement, &b.displacement) {
            (Displacement::Fixed(a), Displacement::Fixed(b)) => assert_eq!(a.to_bits(), b.to_bits(), "{name}"),
            (Displacement::Follows(i, a), Displacement::Follows(j, b)) => {
                assert_eq!(i, j, "{name}");
                assert_same_curve(a, b, name);
                curves += usize::from(a.as_linear().is_none());
            }
            other => panic!("{name}: {other:?}"),
        }
    }
    curves
}

/// Asserts that two models are the same except for joint names; returns the number of curves that are not straight
/// lines.
fn assert_same_models(a: &Model, b: &Model) -> usize {
    assert_eq!((a.name(), a.gravity()), (b.name(), b.gravity()));
    assert_eq!((a.bodies().len(), a.coordinates().len()), (b.bodies().len(), b.coordinates().len()));
    let mut curves = 0;
    for (a, b) in a.bodies().iter().zip(b.bodies()) {
        assert_eq!((&a.name, &a.inertia), (&b.name, &b.inertia));
        assert_eq!((&a.joint.name, a.joint.parent, a.joint.speeds), (&b.joint.name, b.joint.parent, b.joint.speeds));
        let frames = |body: &ambulo::model::Body| [body.joint.parent_from_joint, body.joint.child_from_joint];
        for (x, y) in frames(a).iter().zip(frames(b)) {
            assert_eq!(x.translation, y.translation, "{}", a.name);
            assert!((x.rotation - y.rotation).norm() < 1e-14, "{}", a.name);
        }
        curves += assert_same_axes(&a.joint.rotations, &b.joint.rotations, &a.name);
        curves += assert_same_axes(&a.joint.translations, &b.joint.translations, &a.name);
    }
    for (a, b) in a.coordinates().iter().zip(b.coordinates()) {
        assert_eq!((&a.name, a.kind, a.range, a.clamped), (&b.name, b.kind, b.range, b.clamped));
        assert_eq!(a.default_value.to_bits(), b.default_value.to_bits(), "{}", a.name);
        match (&a.drive, &b.drive) {
            (Drive::Free, Drive::Free) | (Drive::Locked, Drive::Locked) => {}
            (Drive::Prescribed(x), Drive::Prescribed(y)) => assert_same_curve(x, y, &a.name),
            (Drive::Coupled(i, x), Drive::Coupled(j, y)) => {
                assert_eq!(i, j, "{}", a.name);
                assert_same_curve(x, y, &a.name);
            }
            other => panic!("{}: {other:?}", a.name),
        }
    }
    assert_eq!(a.markers(), b.markers());
    curves
}

#[test]
fn published_models_are_unchanged_after_writing_and_reading() {
    let Some((gait2392, rajagopal)) = marker_data::gait2392().zip(marker_data::rajagopal()) else { return };
    let coupled = |model: &Model| model.coordinates().iter().filter(|c| matches!(c.drive, Drive::Coupled(..))).count();
    let locked = |model: &Model| model.coordinates().iter().filter(|c| matches!(c.drive, Drive::Locked)).count();
    // The knees' curves: translations of Gait2392's; two rotations and three translations of Rajagopal's, and the
    // patellae's.
    for (model, least_curves, couplers) in [(&gait2392.model, 4, 0), (&rajagopal.model, 10, 2)] {
        let read = read_back(model);
        let curves = assert_same_models(model, &read);
        assert!(curves >= least_curves, "{}: {curves} curves", model.name());
        assert_eq!((coupled(model), coupled(&read)), (couplers, couplers), "{}", model.name());
        assert_eq!(locked(model), locked(&read), "{}", model.name());
        assert_same_motions(model, &read);
    }
}

#[test]
fn driven_coordinates_and_smoothed_curves_are_unchanged_after_writing_and_reading() {
    let axis = |name: &str, direction: &str, function: &str| {
        format!("<TransformAxis><coordinates>{name}</coordinates><axis>{direction}</axis>{function}</TransformAxis>")
    };
    let points = "<x>-2 -1.1 -0.4 0.3 0.9 1.6 2.2</x><y>0 0.3 -0.2 0.5 0.1 0.4 -0.6</y>";
    let smoothed =
        format!("<GCVSpline><half_order>2</half_order><error_variance>0.01</error_variance>{points}</GCVSpline>");
    // The axes have the coordinates in another order than the joint.
    let axes = [
        axis("c", "0 0 1", &smoothed),
        axis("a", "1 0 0", "<StepFunction><start_time>0</start_time><end_time>0.5</end_time></StepFunction>"),
        axis("b", "0 1 0", "<LinearFunction><coefficients>1 0</coefficients></LinearFunction>"),
        axis("", "1 0 0", "<Constant><value>0.25</value></Constant>"),
        axis("b", "0 1 0", &format!("<PiecewiseLinearFunction>{points}</PiecewiseLinearFunction>")),
        axis("c", "0 0 1", "<Sine><amplitude>0.1</amplitude><omega>3</omega><phase>0.2</phase></Sine>"),
    ]
    .concat();
    let document = format!(
        r#"<OpenSimDocument Version="40000"><Model name="m"><BodySet><objects>
        <Body name="body"><mass>1</mass><inertia>1 1 1 0 0 0</inertia></Body></objects></BodySet>
        <JointSet><objects><CustomJoint name="joint"><socket_parent_frame>/ground</socket_parent_frame>
        <socket_child_frame>/bodyset/body</socket_child_frame><coordinates>
        <Coordinate name="a"><prescribed_function><PolynomialFunction><coefficients>0.3 -1 0.2</coefficients>
        </PolynomialFunction></prescribed_function><prescribed>true</prescribed></Coordinate>
        <Coordinate name="b"><locked>true</locked><default_value>0.4</default_value><clamped>true</clamped></Coordinate>
        <Coordinate name="c"/></coordinates><SpatialTransform>{axes}</SpatialTransform></CustomJoint></objects></JointSet>
        <ConstraintSet><objects><CoordinateCouplerConstraint name="k"><coupled_coordinates_function>
        <SimmSpline>{points}</SimmSpline></coupled_coordinates_function>
        <independent_coordinate_names>b</independent_coordinate_names>
        <dependent_coordinate_name>c</dependent_coordinate_name><scale_factor>-0.7</scale_factor>
        </CoordinateCouplerConstraint></objects></ConstraintSet></Model></OpenSimDocument>"#
    );
    let model = Model::from_osim(document.as_bytes(), &mut Findings::default()).unwrap();
    let drives: Vec<_> = model.coordinates().iter().map(|c| &c.drive).collect();
    assert!(matches!(drives[..], [Drive::Prescribed(_), Drive::Locked, Drive::Coupled(..)]), "{drives:?}");
    assert_eq!(assert_same_models(&model, &read_back(&model)), 4);
}

#[test]
fn a_joint_that_cannot_move_is_written_as_a_weld() {
    let axis = |direction: &str, value: f64| {
        format!("<TransformAxis><axis>{direction}</axis><Constant><value>{value}</value></Constant></TransformAxis>")
    };
    let axes = [axis("1 0 0", 0.3), axis("0 1 0", -0.7), axis("0 0 1", 1.1)]
        .into_iter()
        .chain([axis("1 0 0", 0.1), axis("0 1 0", 0.2), axis("0 0 1", -0.4)])
        .collect::<String>();
    let document = format!(
        r#"<OpenSimDocument Version="40000"><Model name="m"><BodySet><objects>
        <Body name="body"><mass>1</mass><inertia>1 1 1 0 0 0</inertia></Body></objects></BodySet>
        <JointSet><objects><CustomJoint name="joint"><socket_parent_frame>p</socket_parent_frame>
        <socket_child_frame>/bodyset/body</socket_child_frame><coordinates/>
        <frames><PhysicalOffsetFrame name="p"><socket_parent>/ground</socket_parent><translation>1 2 3</translation>
        <orientation>0.2 0.5 -0.4</orientation></PhysicalOffsetFrame></frames>
        <SpatialTransform>{axes}</SpatialTransform></CustomJoint></objects></JointSet></Model></OpenSimDocument>"#
    );
    let model = Model::from_osim(document.as_bytes(), &mut Findings::default()).unwrap();
    let written = to_osim(&model).unwrap();
    // OpenSim 4.6 ends with a segmentation fault if a custom joint has no coordinate.
    assert_eq!(written.joints[0].kind, OsimJointKind::Weld);
    assert_same_motions(&model, &read_back(&model));
}
