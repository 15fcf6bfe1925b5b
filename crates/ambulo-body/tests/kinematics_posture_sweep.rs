//! The motion of bodies per unit of a generalised speed: forces projected on it are those of inverse dynamics.

use ambulo_body::dynamics::{BodyLoad, Workspace, inverse_frame};
use ambulo_body::findings::Findings;
use ambulo_body::kinematics::{Posture, PostureSweep, body_motion};
use ambulo_body::model::{BodyId, Model};
use ambulo_body::spatial::{Vec3, Wrench};

/// A chain of bodies with every kind of joint that has its own rule.
fn chain() -> Model {
    let coordinates = |joint: &str, count: usize| -> String {
        (0..count).map(|i| format!("<Coordinate name=\"{joint}_{i}\"/>")).collect()
    };
    let custom = "<SpatialTransform><TransformAxis><coordinates>custom_0</coordinates><axis>0.6 0 0.8</axis>\
        <PolynomialFunction><coefficients>0.3 1 0.1</coefficients></PolynomialFunction></TransformAxis>\
        <TransformAxis><coordinates>custom_1</coordinates><axis>0 1 0</axis><LinearFunction><coefficients>1 0\
        </coefficients></LinearFunction></TransformAxis><TransformAxis><coordinates></coordinates><axis>1 0 0</axis>\
        <Constant><value>0.2</value></Constant></TransformAxis><TransformAxis><coordinates>custom_0</coordinates>\
        <axis>1 0 0</axis><PolynomialFunction><coefficients>0.2 0.1 0</coefficients></PolynomialFunction>\
        </TransformAxis><TransformAxis><coordinates>custom_1</coordinates><axis>0 1 \
        0</axis><LinearFunction><coefficients>0.1 0\
        </coefficients></LinearFunction></TransformAxis><TransformAxis><coordinates></coordinates><axis>0 0 1</axis>\
        <Constant><value>0</value></Constant></TransformAxis></SpatialTransform>";
    let joints = [
        ("free", "FreeJoint", 6, ""),
        ("ball", "BallJoint", 3, ""),
        ("ellipsoid", "EllipsoidJoint", 3, "<radii_x_y_z>0.1 0.2 0.3</radii_x_y_z>"),
        (
            "arc",
            "ConstantCurvatureJoint",
            3,
            "<neutral_angle_x_z_y>0.1 0.2 0</neutral_angle_x_z_y><length>0.4</length>",
        ),
        ("custom", "CustomJoint", 2, custom),
    ];
    let mut bodies = "<Body name=\"ground\"><mass>0</mass></Body>".to_owned();
    let mut parent = "ground";
    for (name, kind, count, more) in joints {
        bodies += &format!(
            "<Body name=\"{name}\"><mass>1</mass><mass_center>0.1 0.2 0.3</mass_center><inertia_xx>1</inertia_xx>\
             <inertia_yy>1</inertia_yy><inertia_zz>1</inertia_zz><Joint><{kind} name=\"{name}\"><parent_body>{parent}\
             </parent_body><location_in_parent>0.3 -0.2 0.1</location_in_parent><orientation_in_parent>0.2 0.3 -0.4\
             </orientation_in_parent><location>0.1 0 0.2</location><orientation>0.5 0.1 0.3</orientation>\
             <CoordinateSet><objects>{}</objects></CoordinateSet>{more}</{kind}></Joint></Body>",
            coordinates(name, count)
        );
        parent = name;
    }
    let text = format!(
        "<OpenSimDocument Version=\"30000\"><Model name=\"chain\"><BodySet><objects>{bodies}</objects>\
         </BodySet></Model></OpenSimDocument>"
    );
    Model::from_osim(text.as_bytes(), &mut Findings::default()).unwrap()
}

/// Largest difference between generalised forces of a load by inverse dynamics and by unit motions.
fn difference(shift: Vec3) -> f64 {
    let model = chain();
    let n = model.coordinates().len();
    assert_eq!(n, 17);
    let q: Vec<f64> = (0..n).map(|i| 0.5 * (1.3 * i as f64 + 0.4).sin()).collect();
    let qd: Vec<f64> = (0..n).map(|i| (0.7 * i as f64).cos()).collect();
    let zeros = vec![0.0; n];
    let posture = Posture { q: &q, qd: &qd, qdd: &zeros };
    let mut sweep = PostureSweep::new(&model);
    sweep.update(posture);
    assert_eq!(sweep.bodies(), &body_motion(&model, posture)[..]);
    let last = model.body("custom").unwrap();
    let wrench = Wrench { force: Vec3::new(3.0, -1.0, 2.0), moment: Vec3::new(0.5, 0.4, -0.6) };
    let load = BodyLoad { body: last, point: Vec3::new(0.2, 0.3, 0.4), wrench };
    let mut workspace = Workspace::new(&model);
    let bare = inverse_frame(&mut workspace, posture, &[]).generalized().to_vec();
    let loaded = inverse_frame(&mut workspace, posture, &[load]).generalized().to_vec();
    let mut worst = 0.0_f64;
    for body in model.body_ids() {
        let center = sweep.joint_centers()[body.index()] + shift;
        for motion in sweep.joint_motions(body) {
            let id = motion.coordinate.index();
            let force = wrench.about(load.point - center).power(&motion.twist);
            worst = worst.max((bare[id] - loaded[id] - force).abs());
        }
    }
    let listed: usize = (0..model.bodies().len()).map(|i| sweep.joint_motions(BodyId(i)).len()).sum();
    assert_eq!(listed, n);
    worst
}

#[test]
fn forces_on_unit_motions_are_those_of_inverse_dynamics() {
    let found = difference(Vec3::zeros());
    assert!(found < 1e-12, "{found:e}");
    assert!(difference(Vec3::new(0.01, 0.0, 0.0)) > 1e-3);
}
