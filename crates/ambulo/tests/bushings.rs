//! Bushings against OpenSim 4.6: generalised forces of random motions, recorded by
//! `xtask/measure/peers/opensim_bushings.py`.

use ambulo::dynamics::{Workspace, inverse_frame};
use ambulo::findings::{Code, Findings};
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::{MassDistribution, Model, ModelError, from_osim, to_osim};
use ambulo::spatial::Vec3;
use ambulo::study::exclude_bushings;
use ambulo_formats::osim::OsimModel;
use ambulo_formats::setup::{InverseDynamicsSetup, Setup};
use ambulo_formats::table::Table;

/// Forces are some 100 N; numbers are recorded with 15 digits.
const ALLOWED: f64 = 1e-8;
const DOCUMENT: &str = include_str!("testdata/opensim_bushings/bushings.osim");
const TABLE: &str = include_str!("testdata/opensim_bushings/bushings.csv");
/// Rows of the table with the model as it is, and those with another model.
const MOTIONS: [usize; 4] = [0, 1, 2, 3];
const SCALED: usize = 4;
const WITHOUT_STRAP: usize = 5;

fn document() -> OsimModel {
    OsimModel::read(DOCUMENT.as_bytes()).unwrap()
}

fn model() -> Model {
    from_osim(&document(), &mut Findings::default()).unwrap()
}

/// Values of all coordinates in a row of the table.
fn column(model: &Model, row: usize, what: &str) -> Vec<f64> {
    let table = Table::read_csv(TABLE.as_bytes()).unwrap().0;
    let of = |name: &str| table.column(&format!("{name}:{what}")).unwrap()[row];
    model.coordinates().iter().map(|c| of(&c.name)).collect()
}

/// Largest difference of the generalised forces from those of OpenSim [N.m or N].
fn difference(model: &Model, row: usize) -> f64 {
    let [q, qd, qdd, tau] = ["q", "qd", "qdd", "tau"].map(|what| column(model, row, what));
    let mut workspace = Workspace::new(model);
    let ours = inverse_frame(&mut workspace, Posture { q: &q, qd: &qd, qdd: &qdd }, &[]).generalized().to_vec();
    ours.iter().zip(&tau).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn forces_with_bushings_agree_with_opensim() {
    let model = model();
    for row in MOTIONS {
        let found = difference(&model, row);
        println!("motion {row}: {found:.1e} N.m");
        assert!(found < ALLOWED, "{found}");
    }
    // Any part that were left out would be found.
    let without = |from: &str| {
        let changed = DOCUMENT.replace(from, &from.replace(['1', '2', '3', '4', '5', '6'], "0"));
        difference(&from_osim(&OsimModel::read(changed.as_bytes()).unwrap(), &mut Findings::default()).unwrap(), 0)
    };
    for part in ["stiffness>10 20 30<", "stiffness>100 200 300<", "damping>1 2 3<", "damping>4 5 6<"] {
        assert!(without(part) > 0.1, "{part} {}", without(part));
    }
}

#[test]
fn bushings_are_scaled_with_their_bodies() {
    let model = model();
    let factors =
        [("thigh", [1.1, 0.9, 1.2]), ("shank", [0.8, 1.3, 1.1]), ("cuff", [1.2, 1.2, 0.9]), ("other", [1.0; 3])];
    let of = |name: &str| Vec3::from(factors.iter().find(|(body, _)| *body == name).unwrap().1);
    let factors: Vec<Vec3> = model.bodies().iter().map(|body| of(&body.name)).collect();
    let scaled = model.scaled_with(&factors, Some(model.mass()), MassDistribution::Kept).unwrap();
    assert!(difference(&scaled, SCALED) < ALLOWED, "{}", difference(&scaled, SCALED));
    let left = scaled.with_bushings(model.bushings().to_vec()).unwrap();
    assert!(difference(&left, SCALED) > 0.1);
}

#[test]
fn excluded_bushings_do_not_act() {
    let setup = |words: &str| -> InverseDynamicsSetup {
        let text = format!("<InverseDynamicsTool><forces_to_exclude>{words}</forces_to_exclude></InverseDynamicsTool>");
        let (Setup::InverseDynamics(setup), _) = Setup::read(text.as_bytes()).unwrap() else { panic!("another tool") };
        setup
    };
    let after = |words: &str| {
        let mut document = document();
        exclude_bushings(&mut document, &setup(words));
        from_osim(&document, &mut Findings::default()).unwrap()
    };
    for words in ["strap", "Muscles orthosis"] {
        assert!(difference(&after(words), WITHOUT_STRAP) < ALLOWED, "{words}");
    }
    assert!(difference(&after("Muscles"), WITHOUT_STRAP) > 0.1);
    assert!(after("All").bushings().is_empty());
}

#[test]
fn bushings_are_named_and_read_back_from_what_is_written() {
    let mut findings = Findings::default();
    let model = from_osim(&document(), &mut findings).unwrap();
    let found: Vec<_> = findings.as_slice().iter().filter(|f| f.code == Code::ModelBushing).collect();
    assert_eq!(found.len(), 2, "one switched off: {found:?}");
    assert!(found[0].message.contains("`strap` between `shank` and `cuff`"), "{}", found[0].message);
    let written = to_osim(&model).unwrap().write().unwrap();
    let again = from_osim(&OsimModel::read(&written).unwrap(), &mut Findings::default()).unwrap();
    for row in MOTIONS {
        assert!(difference(&again, row) < ALLOWED);
    }
    assert_eq!(again.bushings()[0].groups, ["orthosis"]);
}

/// The layout to 30500, against OpenSim 4.6 for the same document: force and moment of a bushing from ground to a body
/// 0.5 m away.
#[test]
fn bushings_of_old_documents_have_their_frames_by_location_and_orientation() {
    let text = "<OpenSimDocument Version=\"30000\"><Model name=\"m\"><gravity>0 0 0</gravity><BodySet><objects><Body \
        name=\"ground\"><mass>0</mass></Body>\
        <Body name=\"b\"><mass>1</mass><mass_center>0 0 \
        0</mass_center><inertia_xx>1</inertia_xx><inertia_yy>1</inertia_yy><inertia_zz>1</inertia_zz>\
        <Joint><PinJoint name=\"j\"><parent_body>ground</parent_body><CoordinateSet><objects><Coordinate \
        name=\"q\"/></objects></CoordinateSet>\
        </PinJoint></Joint></Body></objects></BodySet><ForceSet><objects><BushingForce \
        name=\"old\"><isDisabled>false</isDisabled>\
        <body_1>ground</body_1><body_2>b</body_2><location_body_1>0.1 0.2 0.3</location_body_1><orientation_body_1>0.1 \
        0 0</orientation_body_1>\
        <location_body_2>0 0.5 0</location_body_2><orientation_body_2>0 0.2 \
        0</orientation_body_2><rotational_stiffness>1 1 1</rotational_stiffness>\
        <translational_stiffness>1 1 \
        1</translational_stiffness></BushingForce></objects></ForceSet></Model></OpenSimDocument>";
    let read = |text: &str| OsimModel::read(text.as_bytes());
    let model = from_osim(&read(text).unwrap(), &mut Findings::default()).unwrap();
    let mut workspace = Workspace::new(&model);
    let still = [0.0];
    let found = inverse_frame(&mut workspace, Posture { q: &still, qd: &still, qdd: &still }, &[]).generalized()[0];
    // OpenSim records the moment -0.070271 N.m about z on the body.
    assert!((found - 0.070_271).abs() < 1e-6, "{found}");
    let off = text.replace("<isDisabled>false", "<isDisabled>true");
    assert!(read(&off).unwrap().bushings.is_empty());
    let lost = read(&text.replace("<body_2>b<", "<body_2>c<")).unwrap_err().to_string();
    assert!(lost.contains("BushingForce") && lost.contains("the frame `c`, which leads to no body"), "{lost}");
}

/// A bushing without damping takes no energy: the power of the coordinates is the rate of all energy.
#[test]
fn a_spring_between_bodies_stores_the_work_that_it_takes() {
    let text = DOCUMENT.replace("<gravity>0 -9.81 0", "<gravity>0 0 0");
    let text = text.replace("damping>1 2 3<", "damping>0 0 0<").replace("damping>4 5 6<", "damping>0 0 0<");
    let model = from_osim(&OsimModel::read(text.as_bytes()).unwrap(), &mut Findings::default()).unwrap();
    // The coordinates of the cuff are not dual to its speeds; it stands still.
    let moves = |i: usize| !model.coordinates()[i].name.starts_with("cuff");
    let rate: Vec<f64> =
        (0..model.coordinates().len()).map(|i| if moves(i) { 0.7 + 0.2 * i as f64 } else { 0.0 }).collect();
    let (start, none) = (column(&model, 0, "q"), vec![0.0; rate.len()]);
    let at = |t: f64| -> Vec<f64> { start.iter().zip(&rate).map(|(q, qd)| q + t * qd).collect() };
    let free = model.clone().with_bushings(Vec::new()).unwrap();
    let power = |t: f64| {
        let place = at(t);
        let posture = Posture { q: &place, qd: &rate, qdd: &none };
        let tau = |model: &Model| inverse_frame(&mut Workspace::new(model), posture, &[]).generalized().to_vec();
        let of_springs = tau(&model).iter().zip(tau(&free)).map(|(a, b)| a - b).collect::<Vec<f64>>();
        of_springs.iter().zip(&rate).map(|(tau, qd)| tau * qd).sum::<f64>()
    };
    // Of the bushing from the cuff to the arm, the energy is known from its angles and places; here from the linear
    // parts of both frames.
    let energy = |t: f64| {
        let place = at(t);
        let bodies = body_motion(&model, Posture { q: &place, qd: &rate, qdd: &none });
        let strap = &model.bushings()[0];
        let [first, second] = strap.ends.map(|end| bodies[end.body.unwrap().index()].pose * end.frame);
        let relative = first.inverse() * second;
        let r = relative.rotation;
        let angles = Vec3::new((-r.m23).atan2(r.m33), r.m13.asin(), (-r.m12).atan2(r.m11));
        let stored = |k: &Vec3, x: &Vec3| 0.5 * k.component_mul(x).dot(x);
        stored(&strap.stiffness.linear, &relative.translation) + stored(&strap.stiffness.angular, &angles)
    };
    let h = 1e-4;
    let expected = (energy(h) - energy(-h)) / (2.0 * h);
    assert!(expected.abs() > 1.0 && (power(0.0) - expected).abs() < 1e-5 * expected.abs(), "{} {expected}", power(0.0));
}

#[test]
fn a_bushing_on_a_body_of_another_model_is_refused() {
    let model = model();
    let mut bushings = model.bushings().to_vec();
    let person = Build { table: SegmentTable::DeLevaMale, mass: 70.0, height: 1.8, toe_joint: false }.human().unwrap();
    bushings[0].ends[0].body = person.model.body_ids().last();
    let error = model.with_bushings(bushings).unwrap_err();
    assert!(matches!(error, ModelError::Bushing { ref bushing, .. } if bushing == "strap"), "{error}");
}
