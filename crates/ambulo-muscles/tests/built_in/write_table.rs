//! The table of the muscles of a leg, from Gait2392.
//!
//! Points of Gait2392 are moved from the frames of its bones to segment frames that joint centres define. Its knee
//! rolls and slides in the sagittal plane; the built-in body has a hinge. Points of thigh and shank are therefore given
//! from the hinge that fits the published knee best over its whole flexion: the points a of the thigh and b of the
//! shank with the least Σ |t(θ) + R(θ) b - a|², one degree apart.

use crate::shared_data;
use ambulo_body::findings::Findings;
use ambulo_body::model::{Displacement, Knots, Model, SimmSpline, from_osim, osim_function};
use ambulo_body::numerics::elementary::{atan2, sin_cos};
use ambulo_body::spatial::{Mat3, Vec3};
use ambulo_formats::osim::{
    OsimFunction, OsimModel, OsimMuscle, OsimMuscleCurves, OsimMuscleKind, OsimMuscleParameters, OsimPathPoint,
    OsimPointPlace,
};
use nalgebra::{Matrix2x4, Matrix4, Vector2, Vector4};
use std::fmt::Write as _;
use std::path::Path;

const HEADER: &str = "\
# The 43 muscles of a right leg: paths in segment frames, and parameters.
#
# Source: Gait2392 (`gait2392.osim` of CEINMS-RT/LowerLimbModel, commit 4056e1c6de2276f174c1b1ef3f1de5ea017a0f07), a
# model by D. G. Thelen, A. Seth, F. C. Anderson and S. L. Delp. Lower extremity: Delp, Loan, Hoy, Zajac, Topp, Rosen
# 1990. Knee: Yamaguchi, Zajac 1989.
# Licence of the model: Creative Commons Attribution 3.0 (CC BY 3.0, http://creativecommons.org/licenses/by/3.0/),
# stated in its <credits>; licence of the repository: Apache-2.0. Carried over: points of the paths and parameters.
# Changed: the points are in other frames (below); where the range of a conditional point reached the end of the
# coordinate's own range, it has no end here.
#
# Markers of the iliac spines for `spines_rad` and `spines_m`: R.ASIS and V.Sacral of `gait2392_Scale_MarkerSet.xml`
# (opensim-models).
#
# Places in m, angles in rad. Axes: x forward, y up, z to the right; origins: own hip centre (pelvis, thigh), knee
# (shank), ankle (foot), ball of the foot (toes). y of the thigh points from the knee to the hip, y of the shank from
# the ankle to the knee. Angles: flexion of the hip and extension of the knee from the straight leg.
#
# AMBULO_WRITE=1 cargo test -p ambulo-muscles the_table_is_gait2392 writes this file from
# shared/data/muscles/B-ceinms-lowerlimb.
";

/// Markers of the iliac spines of Gait2392's marker set in its pelvis [m]: right anterior one, and sacrum.
const SPINES: [[f64; 3]; 2] = [[0.02, 0.03, 0.128], [-0.16, 0.04, 0.0]];
/// Flexion over which the hinge is fitted: the whole range of Gait2392's knee [deg].
const FLEXION_DEG: i32 = 120;
/// An end of a range that is at least that of the coordinate, less this, is none [rad].
const END: f64 = 1e-6;

/// The end of a range that has none [rad].
const NO_END: f64 = std::f64::consts::PI;

/// Frames of Gait2392's right leg and the model.
struct Source {
    model: Model,
    document: OsimModel,
    hip: Vec3,
    ball: Vec3,
    foot: Vec3,
    /// Best hinge on thigh and shank.
    hinge: [Vec3; 2],
    thigh: Mat3,
    shank: Mat3,
    thigh_m: f64,
    shank_m: f64,
}

fn read(data: &Path) -> Source {
    let bytes = std::fs::read(data.join("muscles/B-ceinms-lowerlimb/gait2392.osim")).unwrap();
    let document = OsimModel::read(&bytes).unwrap();
    let model = from_osim(&document, &mut Findings::default()).unwrap();
    let place = |body: &str| model.bodies()[model.body(body).unwrap().index()].joint.parent_from_joint.translation;
    let hinge = best_hinge(&model);
    let ankle = place("talus_r");
    let axes = |y: Vec3| {
        let y = y.normalize();
        let x = Vec3::new(y.y, -y.x, 0.0).normalize();
        Mat3::from_columns(&[x, y, Vec3::z()])
    };
    let (thigh, shank) = (axes(-hinge[0]), axes(hinge[1] - ankle));
    let (thigh_m, shank_m) = (hinge[0].norm(), (hinge[1] - ankle).norm());
    let foot = -place("calcn_r");
    Source {
        hip: place("femur_r"),
        ball: place("toes_r") - foot,
        foot,
        hinge,
        thigh,
        shank,
        thigh_m,
        shank_m,
        model,
        document,
    }
}

/// Place of the tibia in the femur at an extension of the knee [m].
fn knee(model: &Model, angle: f64) -> Vec3 {
    let joint = &model.bodies()[model.body("tibia_r").unwrap().index()].joint;
    let moved = joint.translations.iter().map(|axis| match &axis.displacement {
        Displacement::Fixed(distance) => axis.direction * *distance,
        Displacement::Follows(_, function) => axis.direction * function.at(angle)[0],
    });
    moved.sum()
}

fn best_hinge(model: &Model) -> [Vec3; 2] {
    let (mut normal, mut right) = (Matrix4::<f64>::zeros(), Vector4::<f64>::zeros());
    for degree in 0..=FLEXION_DEG {
        let angle = -f64::from(degree).to_radians();
        let (s, c) = sin_cos(angle);
        let row = Matrix2x4::new(1.0, 0.0, -c, s, 0.0, 1.0, -s, -c);
        let place = knee(model, angle);
        normal += row.transpose() * row;
        right += row.transpose() * Vector2::new(place.x, place.y);
    }
    let found = normal.try_inverse().unwrap() * right;
    [Vec3::new(found[0], found[1], 0.0), Vec3::new(found[2], found[3], 0.0)]
}

impl Source {
    /// Segment of a bone, and a place of it in the frame of the segment.
    fn place(&self, bone: &str, place: Vec3) -> (&'static str, Vec3) {
        match bone {
            "pelvis" => ("pelvis", place - self.hip),
            "femur_r" => ("thigh", self.thigh.transpose() * place),
            "tibia_r" => ("shank", self.shank.transpose() * (place - self.hinge[1])),
            "talus_r" => ("foot", place),
            "calcn_r" => ("foot", place - self.foot),
            "toes_r" => ("toes", place),
            _ => panic!("a point on {bone}"),
        }
    }

    /// The joint of a coordinate. Its zero is the straight leg here as there.
    fn joint(coordinate: &str) -> &'static str {
        match coordinate {
            "hip_flexion_r" => "hip",
            "knee_angle_r" => "knee",
            _ => panic!("a point that follows {coordinate}"),
        }
    }

    fn point(&self, point: &OsimPathPoint) -> String {
        assert!(Vec3::from(point.frame.translation_m).norm() < f64::MIN_POSITIVE, "a frame of its own");
        match &point.place {
            OsimPointPlace::Fixed(place) => {
                let (segment, place) = self.place(&point.frame.body, Vec3::from(*place));
                format!("{{ on = \"{segment}\", at = {} }}", numbers(place.as_slice()))
            }
            OsimPointPlace::Conditional { location_m, coordinate, range } => {
                let (segment, place) = self.place(&point.frame.body, Vec3::from(*location_m));
                let name = coordinate.as_deref().unwrap();
                let joint = Source::joint(name);
                let own = self.model.coordinates()[self.model.coordinate(name).unwrap().index()].range.unwrap();
                let low = if range[0] <= own[0] + END { -NO_END } else { range[0] };
                let high = if range[1] >= own[1] - END { NO_END } else { range[1] };
                format!(
                    "{{ on = \"{segment}\", at = {}, joint = \"{joint}\", between = {} }}",
                    numbers(place.as_slice()),
                    numbers(&[low, high])
                )
            }
            OsimPointPlace::Moving(axes) => self.moving(&point.frame.body, axes),
        }
    }

    fn moving(&self, bone: &str, axes: &[(Option<String>, OsimFunction); 3]) -> String {
        let joint = Source::joint(axes[0].0.as_deref().unwrap());
        assert!(axes.iter().all(|(name, _)| *name == axes[0].0));
        let OsimFunction::SimmSpline(knots) = &axes[0].1 else { panic!("another function than a spline") };
        let OsimFunction::SimmSpline(of_y) = &axes[1].1 else { panic!("another function than a spline") };
        assert_eq!(knots.x, of_y.x);
        let functions = [0, 1, 2].map(|k| osim_function::read(&axes[k].1).unwrap());
        let at = |x: f64| self.place(bone, Vec3::from([0, 1, 2].map(|k| functions[k].at(x)[0])));
        let places: Vec<Vec3> = knots.x.iter().map(|x| at(*x).1).collect();
        let column = |k: usize| places.iter().map(|place| place[k]).collect::<Vec<f64>>();
        // Splines through the same angles may be rotated; a third one must be a straight line.
        let spline = SimmSpline::new(Knots::new(knots.x.clone(), column(2)).unwrap()).unwrap();
        let middle = |pair: &[f64]| 0.5 * (pair[0] + pair[1]);
        assert!(knots.x.windows(2).all(|x| (spline.at(middle(x))[0] - at(middle(x)).1.z).abs() < 1e-9));
        format!(
            "{{ on = \"{}\", joint = \"{joint}\", angles = {}, x = {}, y = {}, z = {} }}",
            at(0.0).0,
            numbers(&knots.x),
            numbers(&column(0)),
            numbers(&column(1)),
            numbers(&column(2))
        )
    }
}

/// Micrometres and microradians.
fn number(value: f64) -> f64 {
    let rounded = (1e6 * value).round() / 1e6;
    if rounded == 0.0 { 0.0 } else { rounded }
}

fn numbers(values: &[f64]) -> String {
    format!("{:?}", values.iter().map(|value| number(*value)).collect::<Vec<f64>>())
}

fn known(muscle: &OsimMuscle) -> &OsimMuscleParameters {
    let OsimMuscleKind::Known(known) = &muscle.kind else { panic!("{}", muscle.name) };
    known
}

fn table(source: &Source) -> String {
    let set = source.document.muscles.as_ref().unwrap();
    let is_of_leg = |muscle: &&OsimMuscle| {
        muscle.name.ends_with("_r") && known(muscle).path.points.iter().all(|point| point.frame.body != "torso")
    };
    let legs: Vec<&OsimMuscle> = set.muscles.iter().filter(is_of_leg).collect();
    let first = known(legs[0]);
    let OsimMuscleCurves::Thelen2003(curves) = &first.curves else { panic!("other curves") };
    let spines = atan2(SPINES[1][1] - SPINES[0][1], SPINES[0][0] - SPINES[1][0]);
    let mut text = format!("{HEADER}\n[reference]\nmass_kg = {:?}\n", (1e3 * source.model.mass()).round() / 1e3);
    let mut line = |words: String| writeln!(text, "{words}").unwrap();
    line(format!("thigh_m = {:?}\nshank_m = {:?}", number(source.thigh_m), number(source.shank_m)));
    line(format!("ball_m = {}\nspines_rad = {:?}", numbers(source.ball.as_slice()), number(spines)));
    line(format!("spines_m = {:?}", number(2.0 * SPINES[0][2])));
    line("\n[curves]".to_owned());
    let words = [
        "tendon_strain_at_max",
        "fiber_strain_at_max",
        "active_shape",
        "passive_shape",
        "velocity_shape",
        "lengthening_force",
        "straight_from",
    ];
    for (word, value) in words.iter().zip(curves) {
        line(format!("{word} = {:?}", number(*value)));
    }
    line(format!("max_contraction_velocity = {:?}", first.max_contraction_velocity));
    line(format!("max_pennation_rad = {:?}", first.maximum_pennation_angle));
    for muscle in legs {
        let found = known(muscle);
        assert!(found.curves == first.curves && found.path.wraps.is_empty());
        let shared = |known: &OsimMuscleParameters| [known.maximum_pennation_angle, known.max_contraction_velocity];
        assert_eq!(shared(found).map(f64::to_bits), shared(first).map(f64::to_bits));
        line(format!("\n[[muscle]]\nname = \"{}\"", muscle.name.trim_end_matches("_r")));
        line(format!("force_n = {:?}\nfiber_m = {:?}", found.max_isometric_force, found.optimal_fiber_length));
        line(format!("tendon_m = {:?}", found.tendon_slack_length));
        line(format!("pennation_rad = {:?}\npoints = [", found.pennation_angle_at_optimal));
        for point in &found.path.points {
            line(format!("    {},", source.point(point)));
        }
        line("]".to_owned());
    }
    text
}

#[test]
fn the_table_is_gait2392_in_the_frames_of_the_segments() {
    let Some(data) = shared_data::data() else { return };
    let source = read(&data);
    let text = table(&source);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/leg_muscles.toml");
    if std::env::var_os("AMBULO_WRITE").is_some() {
        std::fs::write(&path, &text).unwrap();
    }
    let found = std::fs::read_to_string(&path).unwrap();
    assert!(found == text, "{} is out of date; run this test with AMBULO_WRITE=1", path.display());
}

/// The hinge replaces a knee that rolls and slides: how far the shank is from where the published knee has it.
#[test]
fn a_hinge_fits_the_published_knee_to_three_millimetres() {
    let Some(data) = shared_data::data() else { return };
    let source = read(&data);
    let apart = |degree: i32, [a, b]: [Vec3; 2]| {
        let angle = -f64::from(degree).to_radians();
        let (s, c) = sin_cos(angle);
        (knee(&source.model, angle) + Mat3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0) * b - a).norm()
    };
    let worst = |hinge: [Vec3; 2]| (0..=FLEXION_DEG).map(|degree| apart(degree, hinge)).fold(0.0, f64::max);
    println!("{:.2} mm at most, {:.2} mm to 70 degrees", 1e3 * worst(source.hinge), {
        1e3 * (0..=70).map(|degree| apart(degree, source.hinge)).fold(0.0, f64::max)
    });
    assert!(worst(source.hinge) < 0.003);
    // The origin of the tibia is no such hinge.
    assert!(worst([knee(&source.model, 0.0), Vec3::zeros()]) > 0.01);
}
