//! A posture as coordinates of a model: signs, and the direction of the thigh.

use crate::common::{assert_near, derivatives};
use ambulo::findings::Findings;
use ambulo::gait::{COORDINATE_NAMES, Gait, Jet, Pelvis, Trunk, Walk, WalkCoordinates, coordinates};
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::{Model, from_osim};
use ambulo_formats::osim::OsimModel;

const FIGURE: &[u8] = include_bytes!("../../ambulo-cli/tests/recording/figure.osim");

fn walk(edit: impl Fn(&mut Gait)) -> Walk {
    let mut gait = Gait::named("free").unwrap();
    edit(&mut gait);
    Walk::new(&gait, 0.92, &mut Findings::default()).unwrap()
}

fn figure() -> Model {
    from_osim(&OsimModel::read(FIGURE).unwrap(), &mut Findings::default()).unwrap()
}

fn named(jets: &[Jet; 12], name: &str) -> Jet {
    jets[COORDINATE_NAMES.iter().position(|known| *known == name).unwrap()]
}

#[test]
fn the_thigh_keeps_its_direction_whatever_the_pelvis_does() {
    let (moving, vertical) = (walk(|_| ()), walk(|gait| gait.pelvis = Pelvis::Vertical));
    for i in 0..60 {
        let t = 0.02 * f64::from(i);
        for walk in [&moving, &vertical] {
            let posture = walk.at(t);
            for trunk in [Trunk::WithPelvis, Trunk::OneBody] {
                let jets = coordinates(&posture, trunk);
                // Both turn the thigh forwards: a pelvis that tilts backwards carries it along.
                let thigh = named(&jets, "hip_flexion_r") + named(&jets, "pelvis_tilt");
                let expected = posture.right.hip - posture.pelvis_tilt;
                assert_near(thigh.value, expected.value, 1e-14, "direction");
                assert_near(thigh.acceleration, expected.acceleration, 1e-11, "acceleration");
                let backwards = match trunk {
                    Trunk::WithPelvis => named(&jets, "pelvis_tilt") + named(&jets, "lumbar_extension"),
                    Trunk::OneBody => named(&jets, "pelvis_tilt"),
                };
                assert_near(-backwards.value, posture.trunk_lean.value, 1e-15, "lean");
            }
        }
    }
}

#[test]
fn knees_change_their_sign_and_ankles_do_not() {
    let posture = walk(|_| ()).at(0.8);
    let jets = coordinates(&posture, Trunk::OneBody);
    assert_eq!(named(&jets, "knee_angle_r"), -posture.right.knee);
    assert_eq!(named(&jets, "knee_angle_l"), -posture.left.knee);
    assert_eq!(named(&jets, "ankle_angle_r"), posture.right.ankle);
    assert_eq!(named(&jets, "arm_flex_l"), posture.shoulders[1]);
    assert_eq!(named(&jets, "elbow_flex_r"), posture.elbows[0]);
}

/// At contact the right foot of the built-in figure is ahead of the left by about a step, and arms and legs are
/// opposite.
#[test]
fn the_built_in_figure_takes_a_step() {
    let (walk, model) = (walk(|_| ()), figure());
    let writer = WalkCoordinates::of(&model);
    let names: Vec<&str> = writer.names().collect();
    assert!(names.contains(&"lumbar_extension") && names.contains(&"ankle_angle_l"), "{names:?}");
    let state = |t: f64| {
        let mut q: Vec<f64> = model.coordinates().iter().map(|c| c.default_value).collect();
        let (mut qd, mut qdd) = (vec![0.0; q.len()], vec![0.0; q.len()]);
        writer.write(&walk.at(t), &mut q, &mut qd, &mut qdd);
        (q, qd, qdd)
    };
    let (q, qd, qdd) = state(0.0);
    let motions = body_motion(&model, Posture { q: &q, qd: &qd, qdd: &qdd });
    let heel = |name: &str| motions[model.body(name).unwrap().index()].center;
    let step = heel("calcn_r").x - heel("calcn_l").x;
    assert!((0.8..1.3).contains(&(step / walk.step_length())), "feet {step} m apart, step {} m", walk.step_length());
    // Rates and accelerations of the coordinates are those of their values.
    let (rates, error) = derivatives(|t| state(t).0, 0.4, 1e-5, 1e-14);
    let (accelerations, second_error) = derivatives(|t| state(t).1, 0.4, 1e-5, 1e-13);
    let (_, qd, qdd) = state(0.4);
    for i in 0..qd.len() {
        assert_near(qd[i], rates[i], error + 1e-6, "rate");
        assert_near(qdd[i], accelerations[i], second_error + 0.1, "acceleration");
    }
}

#[test]
fn arms_swing_against_the_legs() {
    let walk = walk(|_| ());
    for i in 0..40 {
        let posture = walk.at(0.027 * f64::from(i));
        let legs = posture.right.hip.value - posture.left.hip.value;
        let arms = posture.shoulders[0].value - posture.shoulders[1].value;
        // Where the legs are well apart: the two pass each other some percents of the cycle apart.
        if legs.abs() > 0.35 {
            assert!(legs * arms < 0.0, "legs {legs}, arms {arms}");
        }
        assert!(posture.elbows.iter().all(|elbow| elbow.value > 0.05), "an elbow bends backwards");
    }
}
