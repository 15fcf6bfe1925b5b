//! Models written and read back: every kind of joint that the writer knows, and what it refuses.

use ambulo_formats::osim::{Knots, OsimConstraint, OsimFunction, OsimJointKind, OsimModel};

/// A chain of bodies with odd names, turned frames and every joint.
fn document() -> String {
    let joints = [
        ("WeldJoint", 0),
        ("PinJoint", 1),
        ("SliderJoint", 1),
        ("UniversalJoint", 2),
        ("BallJoint", 3),
        ("GimbalJoint", 3),
        ("PlanarJoint", 3),
        ("FreeJoint", 6),
        ("CustomJoint", 2),
    ];
    let (mut bodies, mut all) = (String::new(), String::new());
    for (i, (kind, count)) in joints.into_iter().enumerate() {
        bodies += &format!(
            "<Body name=\"b&amp;{i}\"><mass>{}</mass><mass_center>0.1 -0.25 1e-3</mass_center><inertia>0.3 0.2 0.1 \
             0.01 -0.02 0</inertia></Body>",
            0.1 + i as f64 / 3.0
        );
        let parent = if i == 0 { "/ground".to_owned() } else { format!("/bodyset/b&amp;{}", i - 1) };
        let coordinates: String = (0..count)
            .map(|k| {
                format!(
                    "<Coordinate name=\"q{i}_{k}\"><default_value>0.{k}</default_value><range>-1.5 \
                2.25</range><locked>{}</locked></Coordinate>",
                    k == 1
                )
            })
            .collect();
        let axis = |content: &str| format!("<TransformAxis>{content}</TransformAxis>");
        let still = "<axis>0 0 1</axis><Constant><value>0.125</value></Constant>";
        let transform = [
            axis(
                "<coordinates>q8_0</coordinates><axis>0 0.6 0.8</axis><LinearFunction><coefficients>-1 \
                0.1</coefficients></LinearFunction>",
            ),
            axis(
                "<coordinates>q8_1</coordinates><axis>1 0 0</axis><PolynomialFunction><coefficients>2 0 \
                1</coefficients></PolynomialFunction>",
            ),
            axis(still),
            axis(still),
            axis(still),
            axis(still),
        ]
        .concat();
        let transform = if kind == "CustomJoint" {
            format!("<SpatialTransform>{transform}</SpatialTransform>")
        } else {
            String::new()
        };
        all += &format!(
            "<{kind} \
             name=\"j{i}\"><socket_parent_frame>p</socket_parent_frame><socket_child_frame>c</socket_child_frame>\
             <coordinates>{coordinates}</coordinates><frames>\
             <PhysicalOffsetFrame name=\"p\"><socket_parent>{parent}</socket_parent><translation>0 {i} \
             0.1</translation><orientation>0.3 -0.7 2.1</orientation></PhysicalOffsetFrame>\
             <PhysicalOffsetFrame name=\"c\"><socket_parent>/bodyset/b&amp;{i}</socket_parent><translation>0 0 \
             0</translation><orientation>0 0 0</orientation></PhysicalOffsetFrame>\
             </frames>{transform}</{kind}>"
        );
    }
    format!(
        "<OpenSimDocument Version=\"40000\"><Model name=\"all &lt;joints&gt;\"><gravity>0 -1.62 \
         0</gravity><BodySet><objects>{bodies}</objects></BodySet>\
         <JointSet><objects>{all}</objects></JointSet><MarkerSet><objects><Marker \
         name=\"m\"><socket_parent_frame>/bodyset/b&amp;2</socket_parent_frame>\
         <location>1 2 3</location></Marker></objects></MarkerSet></Model></OpenSimDocument>"
    )
}

/// The same but for lines of the text.
fn without_lines(mut model: OsimModel) -> OsimModel {
    // Frames are written as those of the joints, so their names differ.
    model.frames.clear();
    model.bodies.iter_mut().for_each(|body| body.line = 0);
    for joint in &mut model.joints {
        joint.line = 0;
        joint.coordinates.iter_mut().for_each(|coordinate| coordinate.line = 0);
    }
    for constraint in &mut model.constraints {
        if let OsimConstraint::CoordinateCoupler { line, .. } = constraint {
            *line = 0;
        }
    }
    model
}

#[test]
fn what_is_written_reads_back_the_same() {
    let model = without_lines(OsimModel::read(document().as_bytes()).unwrap());
    let written = model.write().unwrap();
    let mut again = without_lines(OsimModel::read(&written).unwrap());
    assert!(again.remarks.is_empty(), "{:?}", again.remarks);
    for (a, b) in again.joints.iter_mut().zip(&model.joints) {
        for (a, b) in [(&mut a.parent, &b.parent), (&mut a.child, &b.child)] {
            for (x, y) in a.rotation.as_flattened_mut().iter_mut().zip(b.rotation.as_flattened()) {
                // Matrix to angles and back.
                assert!((*x - y).abs() < 1e-15 * 8.0, "{x} instead of {y}");
                *x = *y;
            }
        }
    }
    assert_eq!(again, model);
    assert_eq!(without_lines(OsimModel::read(&written).unwrap()).write().unwrap(), again.write().unwrap());
}

#[test]
fn what_the_writer_does_not_know_is_refused() {
    let model = OsimModel::read(document().as_bytes()).unwrap();
    let refused = |change: &dyn Fn(&mut OsimModel), words: &str| {
        let mut changed = model.clone();
        change(&mut changed);
        let error = changed.write().unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    let weld = || OsimConstraint::Other { kind: "WeldConstraint".into(), name: "c".into(), line: 1 };
    refused(&|m| m.constraints.push(weld()), "found the WeldConstraint `c`; expected couplers of coordinates");
    refused(&|m| m.bodies[0].mass_kg = f64::NAN, "found NaN; expected finite numbers");
    let endless = knots(&[0.0, f64::INFINITY], &[0.0, 1.0]);
    refused(&|m| set_curve(m, OsimFunction::SimmSpline(endless.clone())), "found inf; expected finite numbers");
    let nested = (0..40).fold(OsimFunction::Constant(1.0), |inner, _| scaled(1.5, inner));
    refused(&|m| set_curve(m, nested.clone()), "found functions nested more than 32 deep");
}

fn knots(x: &[f64], y: &[f64]) -> Knots {
    Knots { x: x.to_vec(), y: y.to_vec() }
}

fn scaled(scale: f64, function: OsimFunction) -> OsimFunction {
    OsimFunction::Multiplier { scale, function: Box::new(function) }
}

/// The first axis of the custom joint follows its coordinate so.
fn set_curve(model: &mut OsimModel, curve: OsimFunction) {
    if let OsimJointKind::Custom(axes) = &mut model.joints[8].kind {
        axes[0].function = curve;
    }
}

#[test]
fn every_function_reads_back_the_same_wherever_it_stands() {
    let (x, y) = ([-2.1, -0.1, 0.1 + 0.2, 1e-3 + 1.0], [1.0 / 3.0, -0.0125, 0.7, 1e-9]);
    let points = || knots(&x, &y);
    let functions = [
        OsimFunction::Linear { slope: -1.0 / 3.0, intercept: 0.1 },
        OsimFunction::Polynomial(vec![0.1, -2.0, 1.0 / 7.0]),
        OsimFunction::SimmSpline(points()),
        OsimFunction::GcvSpline { degree: 1, knots: points(), error_variance: 0.0 },
        OsimFunction::GcvSpline { degree: 3, knots: points(), error_variance: 0.25 },
        OsimFunction::PiecewiseLinear(points()),
        OsimFunction::PiecewiseConstant(points()),
        OsimFunction::Step { start: (0.1, 0.2), end: (0.7, -0.3) },
        OsimFunction::Sine { amplitude: 0.1, omega: 6.5, phase: -0.2, offset: 0.05 },
        scaled(1.150324903, scaled(-1.0, OsimFunction::SimmSpline(points()))),
    ];
    let model = without_lines(OsimModel::read(document().as_bytes()).unwrap());
    for function in functions {
        let mut written = model.clone();
        set_curve(&mut written, function.clone());
        written.joints[1].coordinates[0].prescribed = Some(function.clone());
        let coupler = |scale: f64| OsimConstraint::CoordinateCoupler {
            name: "follow".into(),
            line: 0,
            independent: "q3_0".into(),
            dependent: "q8_1".into(),
            function: scaled(scale, function.clone()),
        };
        written.constraints = vec![coupler(-0.4), OsimConstraint::Off { name: "nothing".into() }];
        let read = without_lines(OsimModel::read(&written.write().unwrap()).unwrap());
        let (OsimJointKind::Custom(axes), [held]) = (&read.joints[8].kind, &read.constraints[..]) else {
            panic!("{read:?}");
        };
        assert_eq!(axes[0].function, function);
        assert_eq!(read.joints[1].coordinates, written.joints[1].coordinates);
        assert_eq!(*held, coupler(-0.4));
    }
}
