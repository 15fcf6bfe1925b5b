//! Muscles of documents: what is read, what is left out with a finding, what is refused.

use crate::muscle_models::{MuscleModel, load};
use crate::shared_data;
use ambulo_body::findings::{Code, Findings};
use ambulo_body::model::from_osim;
use ambulo_formats::osim::{OsimForceSet, OsimModel};
use ambulo_muscles::MuscleError;
use ambulo_muscles::set::{MuscleCurves, MuscleSet, PointPlace};

#[test]
fn every_part_of_the_shared_models_is_read() {
    let count = |set: &MuscleSet| {
        let points = || set.muscles.iter().flat_map(|muscle| &muscle.path.points);
        let conditional = points().filter(|p| matches!(p.place, PointPlace::Conditional { .. })).count();
        let moving = points().filter(|p| matches!(p.place, PointPlace::Moving { .. })).count();
        let wraps: usize = set.muscles.iter().map(|muscle| muscle.path.wraps.len()).sum();
        [set.muscles.len(), points().count(), conditional, moving, wraps, set.wraps.len(), set.actuators.len()]
    };
    let expected = [
        ("gait2392", [92, 322, 26, 8, 0, 0, 0]),
        ("ceinms", [92, 322, 26, 8, 0, 0, 0]),
        ("gait10dof", [18, 60, 8, 4, 0, 0, 0]),
        ("rajagopal", [80, 288, 0, 0, 46, 44, 13]),
        ("opencap", [80, 288, 0, 0, 46, 44, 13]),
        ("stanford", [80, 288, 0, 0, 46, 40, 3]),
    ];
    for (name, counts) in expected {
        let Some(MuscleModel { set, findings, .. }) = load(name) else { return };
        assert_eq!(count(&set), counts, "{name}");
        println!("{name}: {:?}", findings.as_slice());
        assert!(!findings.has(Code::MusclesUnsupported) && !findings.has(Code::MusclesOff), "{name}");
    }
}

/// Numbers of a document are kept to the last bit.
fn assert_same(found: &[f64], stated: &[f64]) {
    let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(found), bits(stated), "{found:?} {stated:?}");
}

#[test]
fn parameters_are_those_of_the_document() {
    let Some(MuscleModel { set, .. }) = load("gait2392") else { return };
    let muscle = set.muscles.iter().find(|m| m.name == "glut_med1_r").unwrap();
    let p = &muscle.parameters;
    let found = [p.max_isometric_force, p.optimal_fiber_length, p.tendon_slack_length, p.pennation_at_optimal];
    assert_same(&found, &[819.0, 0.0535, 0.078, 0.13962634]);
    assert_same(&p.activation_range, &[0.01, 1.0]);
    let MuscleCurves::Thelen2003(curves) = &p.curves else { panic!("{:?}", p.curves) };
    assert_same(&[curves.tendon_strain_at_max, curves.active_shape, curves.lengthening_force], &[0.033, 0.5, 1.8]);
    let Some(MuscleModel { set, .. }) = load("rajagopal") else { return };
    let MuscleCurves::Millard2012(curves) = &set.muscles[0].parameters.curves else { panic!() };
    assert_same(&curves.active, &[0.25, 0.77, 1.9, 0.75, 0.0]);
    assert_eq!((curves.fiber_damping, curves.tendon[0]), (0.01, Some(0.049)));
}

#[test]
fn muscles_over_ellipsoids_are_left_out_by_name() {
    let Some(MuscleModel { set, findings, document, .. }) = load("arm26") else { return };
    let names: Vec<&str> = set.muscles.iter().map(|m| m.name.as_str()).collect();
    println!("{names:?}: {:?}", findings.as_slice());
    assert!(findings.has(Code::MusclesUnsupported));
    let total = document.muscles.unwrap().muscles.len();
    let left_out = total - names.len();
    let messages: Vec<&str> = findings.as_slice().iter().map(|f| f.message.as_str()).collect();
    assert!(left_out > 0 && messages.iter().any(|m| m.contains("WrapEllipsoid")), "{messages:?}");
}

#[test]
fn reserve_actuators_are_read_from_their_file() {
    let Some(MuscleModel { model, .. }) = load("rajagopal") else { return };
    let file = shared_data::data().unwrap().join("muscles/opensim46/setup/reserves_rajagopal.xml");
    let set = OsimForceSet::read(&std::fs::read(file).unwrap()).unwrap();
    let reserves = MuscleSet::actuators_of(&set.actuators, &model).unwrap();
    assert!(reserves.len() == 18 && set.ignored.is_empty());
    let of = |name: &str| {
        let id = model.coordinate(name).unwrap();
        reserves.iter().find(|r| r.coordinate == id).map(|r| (r.optimal_force, r.control_range))
    };
    assert_eq!(of("pelvis_tilt"), Some((1000.0, [-1e6, 1e6])));
    assert_eq!(of("knee_angle_r"), Some((1.0, [-1e6, 1e6])));
    let Some(MuscleModel { model: other, .. }) = load("gait10dof") else { return };
    let error = MuscleSet::actuators_of(&set.actuators, &other).unwrap_err().to_string();
    assert!(error.contains("names the coordinate `") && error.contains("does not have"), "{error}");
}

/// A thigh on the ground and a shank on the thigh, hinges about z at the origin and at y = -1, and these forces.
fn leg(forces: &str, surfaces: &str) -> String {
    let hinge = |name: &str, parent: &str, y: f64| {
        format!(
            "<Joint><PinJoint name=\"{name}\"><parent_body>{parent}</parent_body><location_in_parent>0 {y} 0\
             </location_in_parent><CoordinateSet><objects><Coordinate name=\"{name}_angle\"/></objects></CoordinateSet>\
             </PinJoint></Joint>"
        )
    };
    let mass = "<mass>1</mass><inertia_xx>1</inertia_xx><inertia_yy>1</inertia_yy><inertia_zz>1</inertia_zz>";
    format!(
        "<OpenSimDocument Version=\"30000\"><Model name=\"leg\"><BodySet><objects>\n\
         <Body name=\"ground\"><mass>0</mass></Body>\n\
         <Body name=\"thigh\">{mass}{}<WrapObjectSet><objects>{surfaces}</objects></WrapObjectSet></Body>\n\
         <Body name=\"shank\">{mass}{}</Body>\n</objects></BodySet><ForceSet><objects>{forces}</objects></ForceSet>\n\
         </Model></OpenSimDocument>",
        hinge("hip", "ground", 0.0),
        hinge("knee", "thigh", -1.0),
    )
}

const FROM: &str = "<PathPoint><location>0.1 -0.5 0</location><body>thigh</body></PathPoint>";
const TO: &str = "<PathPoint><location>0.1 -0.2 0</location><body>shank</body></PathPoint>";

fn muscle(name: &str, points: &str, more: &str) -> String {
    format!(
        "\n<Thelen2003Muscle name=\"{name}\">{more}<GeometryPath><PathPointSet><objects>{points}</objects>\
         </PathPointSet><PathWrapSet><objects>{}</objects></PathWrapSet></GeometryPath></Thelen2003Muscle>",
        if more.contains("wraps") { "<PathWrap><wrap_object>knob</wrap_object></PathWrap>" } else { "" }
    )
}

fn import(text: &str) -> (Result<MuscleSet, MuscleError>, Findings) {
    let document = OsimModel::read(text.as_bytes()).unwrap();
    let model = from_osim(&document, &mut Findings::default()).unwrap();
    let mut findings = Findings::default();
    (MuscleSet::of_document(&document, &model, &mut findings), findings)
}

/// The good muscle alone is kept, and one finding explains what became of the other.
fn assert_left_out(other: &str, surfaces: &str, code: Code, words: &str) {
    let (set, findings) = import(&leg(&(muscle("good", &[FROM, TO].concat(), "") + other), surfaces));
    assert_eq!(set.unwrap().muscles.len(), 1);
    let [finding] = findings.as_slice() else { panic!("{:?}", findings.as_slice()) };
    assert!(finding.code == code && finding.message.contains(words), "{finding:?}");
}

#[test]
fn a_muscle_without_effect_is_left_out_with_a_reason() {
    let both = [FROM, TO].concat();
    let off = muscle("bad", &both, "<isDisabled>true</isDisabled>");
    assert_left_out(&off, "", Code::MusclesOff, "1 muscle is left out (switched off in the model): bad");
    let weak = muscle("bad", &both, "<max_isometric_force>0</max_isometric_force>");
    assert_left_out(&weak, "", Code::MusclesNoStrength, "(greatest isometric force of zero): bad");
    let idle = muscle("bad", &[FROM, FROM].concat(), "");
    assert_left_out(&idle, "", Code::MusclesNoJoint, "(path crosses no joint that moves): bad");
    let foreign = "<Schutte1993Muscle_Deprecated name=\"bad\"/>";
    assert_left_out(
        foreign,
        "",
        Code::MusclesUnsupported,
        "(the type Schutte1993Muscle_Deprecated is not supported): bad",
    );
    let wrapped = muscle("bad", &both, "<!--wraps-->");
    let torus = "<WrapTorus name=\"knob\"/>";
    assert_left_out(
        &wrapped,
        torus,
        Code::MusclesUnsupported,
        "(path over the WrapTorus `knob`, which is not supported): bad",
    );
    // Without its fault the muscle is kept.
    let (set, findings) = import(&leg(&muscle("bad", &both, ""), ""));
    assert_eq!((set.unwrap().muscles.len(), findings.as_slice().len()), (1, 0));
}

#[test]
fn a_point_inside_its_surface_is_reported() {
    let wrapped = muscle("over", &[FROM, TO].concat(), "<!--wraps-->");
    let sphere = |radius: f64| {
        format!("<WrapSphere name=\"knob\"><translation>0.1 -0.5 0</translation><radius>{radius}</radius></WrapSphere>")
    };
    let (set, findings) = import(&leg(&wrapped, &sphere(0.1)));
    assert_eq!(set.unwrap().muscles.len(), 1);
    let [finding] = findings.as_slice() else { panic!("{:?}", findings.as_slice()) };
    assert_eq!(finding.code, Code::MusclesInsideWrap);
    assert!(finding.message.contains("`over` has an end inside the surface `knob`"), "{finding:?}");
    let aside = sphere(0.1).replace("0.1 -0.5 0", "0.4 -0.5 0");
    assert!(import(&leg(&wrapped, &aside)).1.as_slice().is_empty());
}

#[test]
fn a_model_without_muscles_is_refused() {
    let refused = |text: &str, words: &str| {
        let error = import(text).0.unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    refused(&leg("", ""), "the model `leg` has no muscles; expected at least one Thelen2003Muscle or");
    let off = muscle("a", &[FROM, TO].concat(), "<isDisabled>true</isDisabled>");
    refused(&leg(&off, ""), "has 1 muscles, none of which can be used");
    let lost = FROM.replace("thigh", "head");
    refused(&leg(&muscle("a", &[&lost, TO].concat(), ""), ""), "the frame `head`, which leads to no body");
    let conditional =
        FROM.replace("PathPoint", "ConditionalPathPoint").replace("<body>", "<coordinate>c</coordinate><body>");
    refused(
        &leg(&muscle("a", &[FROM, &conditional, TO].concat(), ""), ""),
        "muscle `a` (line 6) names the coordinate `c`, which the model does not have",
    );
    refused(&leg(&muscle("a", &[FROM, TO].concat(), "<!--wraps-->"), ""), "names the wrap object `knob`");
    for (parameter, value) in
        [("optimal_fiber_length", "0"), ("pennation_angle_at_optimal", "2"), ("max_isometric_force", "-1")]
    {
        let more = format!("<{parameter}>{value}</{parameter}>");
        let words = format!("muscle `a` (line 6) has {parameter} {value}; expected");
        refused(&leg(&muscle("a", &[FROM, TO].concat(), &more), ""), &words);
    }
}
