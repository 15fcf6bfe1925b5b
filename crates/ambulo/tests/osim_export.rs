//! Figures written as OpenSim models and read back are the same figures.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use ambulo::findings::Findings;
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::{ExportError, Model, from_osim, from_osim_bytes, to_osim};
use ambulo_formats::osim::OsimModel;

fn figure(table: SegmentTable, toe_joint: bool) -> Model {
    Build { table, mass: 71.3, height: 1.734, toe_joint }.human().unwrap().model
}

fn read_back(model: &Model) -> Model {
    let mut findings = Findings::default();
    let read = from_osim_bytes(&to_osim(model).unwrap().write().unwrap(), &mut findings).unwrap();
    assert!(findings.as_slice().is_empty(), "{findings:?}");
    read
}

#[test]
fn every_figure_reads_back_as_it_was() {
    for table in SegmentTable::ALL {
        for toe_joint in [true, false] {
            let (written, read) = (figure(table, toe_joint), &read_back(&figure(table, toe_joint)));
            // OpenSim takes no blanks in names.
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
fn what_was_read_back_moves_the_same_way() {
    let written = figure(SegmentTable::DeLevaFemale, true);
    let read = read_back(&written);
    // Any numbers, by name: the order of coordinates may differ.
    let number = |name: &str, k: usize| {
        let sum: usize = name.bytes().enumerate().map(|(i, b)| (i + 1) * usize::from(b)).sum();
        ((sum * (k + 3)) % 97) as f64 / 97.0 - 0.5
    };
    let motions = |model: &Model| {
        let values = |k: usize| model.coordinates().iter().map(|c| number(&c.name, k)).collect::<Vec<f64>>();
        let (q, qd, qdd) = (values(0), values(1), values(2));
        body_motion(model, Posture { q: &q, qd: &qd, qdd: &qdd })
    };
    let (a, b) = (motions(&written), motions(&read));
    for (i, body) in written.bodies().iter().enumerate() {
        let same = &b[read.body(&body.name).unwrap().index()];
        // A dozen products of numbers near one.
        assert!((same.center - a[i].center).norm() < 1e-13, "{}", body.name);
        assert!((same.pose.rotation - a[i].pose.rotation).norm() < 1e-13, "{}", body.name);
        assert!((same.twist.linear - a[i].twist.linear).norm() < 1e-12, "{}", body.name);
    }
}

#[test]
fn what_the_writer_does_not_know_is_refused() {
    let document = r#"<OpenSimDocument Version="40000"><Model name="m"><BodySet><objects>
        <Body name="b"><mass>1</mass><inertia>1 1 1 0 0 0</inertia></Body></objects></BodySet>
        <JointSet><objects><BallJoint name="ball"><socket_parent_frame>/ground</socket_parent_frame>
        <socket_child_frame>/bodyset/b</socket_child_frame><coordinates>
        <Coordinate name="x"/><Coordinate name="y"/><Coordinate name="z"/></coordinates></BallJoint>
        </objects></JointSet></Model></OpenSimDocument>"#;
    let mut findings = Findings::default();
    let model = from_osim(&OsimModel::read(document.as_bytes()).unwrap(), &mut findings).unwrap();
    let error = to_osim(&model).unwrap_err();
    assert!(matches!(&error, ExportError::Unknown { name, .. } if name == "ball"), "{error}");
    assert!(error.to_string().contains("joint `ball`: found forces that go with angular velocity"), "{error}");
}
