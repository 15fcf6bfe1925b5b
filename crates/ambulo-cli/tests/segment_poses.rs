//! Poses of segments in a C3D or a `.mvnx`: results with and without force plates in the same file, agreement with the
//! motion that they were made from, and what `info` states.

use crate::workbench::Workbench;
use ambulo::findings::Findings;
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::{Model, from_osim};
use ambulo::motion::coordinates_from_table;
use ambulo::spatial::{Mat3, Vec3};
use ambulo_formats::c3d::{C3d, Rotation};
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;

/// Labels of Theia3D with the bodies that have the same origin.
const LABELS: [(&str, &str); 14] = [
    ("pelvis_4X4", "pelvis"),
    ("torso_4X4", "torso"),
    ("r_thigh_4X4", "femur_r"),
    ("l_thigh_4X4", "femur_l"),
    ("r_shank_4X4", "tibia_r"),
    ("l_shank_4X4", "tibia_l"),
    ("r_foot_4X4", "calcn_r"),
    ("l_foot_4X4", "calcn_l"),
    ("r_toes_4X4", "toes_r"),
    ("l_toes_4X4", "toes_l"),
    ("r_uarm_4X4", "humerus_r"),
    ("l_uarm_4X4", "humerus_l"),
    ("r_larm_4X4", "forearm_r"),
    ("l_larm_4X4", "forearm_l"),
];

/// The poses of the demo's walk, in the axes of its laboratory (x right, y forward, z up), which are those of the
/// segments too.
fn rotations(model: &Model, table: &Table) -> Vec<Rotation> {
    let motion = coordinates_from_table(model, table, "walk.mot", &mut Findings::default()).unwrap();
    let ours_from_theirs = Mat3::from_columns(&[Vec3::z(), Vec3::x(), Vec3::y()]);
    let rest = vec![0.0; model.coordinates().len()];
    let mut rotations: Vec<Rotation> = LABELS.iter().map(|(label, _)| Rotation::new(label, Vec::new())).collect();
    for frame in 0..motion.times.len() {
        let value = |column: &Option<Vec<f64>>| column.as_ref().map_or(0.0, |column| column[frame]);
        let q: Vec<f64> = motion.columns.iter().map(value).collect();
        let bodies = body_motion(model, Posture { q: &q, qd: &rest, qdd: &rest });
        for ((_, body), rotation) in LABELS.iter().zip(&mut rotations) {
            let pose = bodies[model.body(body).unwrap().index()].pose;
            let turn = ours_from_theirs.transpose() * pose.rotation * ours_from_theirs;
            let place = ours_from_theirs.transpose() * pose.translation * 1000.0;
            let row = |i: usize| [turn[(i, 0)], turn[(i, 1)], turn[(i, 2)], place[i]];
            rotation.matrices.push([row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]]);
            rotation.reliability.push(0.0);
        }
    }
    rotations
}

/// A folder with the demo and two files made from its walk: `plates.c3d` with poses and force plates, `poses.c3d` with
/// poses alone.
fn demo(name: &str) -> Workbench {
    let bench = Workbench::empty(name);
    bench.run(&["demo", "-o", "demo", "--quiet"]).done();
    let document = OsimModel::read(&bench.read("demo/input/figure.osim")).unwrap();
    let model = from_osim(&document, &mut Findings::default()).unwrap();
    let (mut c3d, _) = C3d::read(&bench.read("demo/input/walk.c3d")).unwrap();
    c3d.rotations = rotations(&model, &bench.table("demo/input/walk.mot"));
    c3d.rotation_rate_hz = c3d.point_rate_hz;
    assert_eq!(c3d.rotations[0].matrices.len(), c3d.frames(), "the demo writes both at one rate");
    bench.write("both.c3d", c3d.write().unwrap());
    c3d.points.clear();
    bench.write("plates.c3d", c3d.write().unwrap());
    c3d.channels.clear();
    c3d.analog_rate_hz = 0.0;
    c3d.set_platforms(&[]);
    bench.write("poses.c3d", c3d.write().unwrap());
    bench
}

/// Root mean square difference of a moment from that of the demo [N.m], between two times.
fn difference(bench: &Workbench, folder: &str, column: &str) -> f64 {
    let (found, known) = (bench.table(&format!("{folder}/moments.sto")), bench.table("demo/moments.sto"));
    let series = |table: &Table| -> Vec<(f64, f64)> {
        let times = table.column("time").unwrap().to_vec();
        times.into_iter().zip(table.column(column).unwrap().iter().copied()).collect()
    };
    let known = series(&known);
    let mut squares = Vec::new();
    for (time, value) in series(&found).into_iter().filter(|(time, _)| (0.8..3.0).contains(time)) {
        let nearest = known.iter().min_by(|a, b| (a.0 - time).abs().total_cmp(&(b.0 - time).abs())).unwrap();
        squares.push((nearest.1 - value).powi(2));
    }
    assert!(squares.len() > 100, "{}", squares.len());
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

#[test]
fn poses_give_the_moments_of_the_walk_that_they_were_made_from() {
    let bench = demo("segment_poses");
    let run = bench.run(&["forces", "plates.c3d", "-o", "plates"]).done();
    assert!(run.stdout.contains("(segment poses)"), "{}", run.stdout);
    let summary = bench.json("plates/summary.json");
    assert_eq!(summary["ground"]["source"], "measured");
    let run = bench.run(&["forces", "poses.c3d", "-o", "poses"]);
    assert!(run.stdout.contains("forces    predicted"), "{} {}", run.stdout, run.stderr);
    for column in ["hip_flexion_r_moment", "knee_angle_l_moment", "ankle_angle_r_moment"] {
        let [measured, predicted] = ["plates", "poses"].map(|folder| difference(&bench, folder, column));
        println!("{column}: {measured:.2} N.m with plates, {predicted:.2} N.m without");
        // The filters at 6 Hz: the demo's moments have none. Predicted double support is a maximum a posteriori
        // estimate.
        assert!(measured < 8.0 && predicted < 25.0, "{column}: {measured} {predicted}");
    }
}

#[test]
fn markers_beside_poses_are_named_and_a_model_is_refused() {
    let bench = demo("segment_poses_and_markers");
    let run = bench.run(&["forces", "both.c3d", "-o", "out", "--verbose"]).done();
    assert!(run.stderr.contains("; not used: "), "{}", run.stderr);
    bench.run(&["forces", "plates.c3d", "--model", "demo/input/figure.osim", "-o", "out2"]).refused(&[
        "plates.c3d",
        "has poses of segments, which drive the built-in body",
        "hint: leave the model out",
    ]);
}

#[test]
fn info_lists_the_segments_and_the_next_command() {
    let bench = demo("segment_poses_info");
    let run = bench.run(&["info", "poses.c3d"]).done();
    for words in [
        "segment poses: 14 at",
        "r_thigh_4X4",
        "segments +y forward, +z up, +x right",
        "next: ambulo forces poses.c3d -o out",
    ] {
        assert!(run.stdout.contains(words), "{words}: {}", run.stdout);
    }
    let trc = bench.run(&["convert", "poses.c3d", "centres.trc"]);
    trc.done();
    assert!(bench.text("centres.trc").contains("knee_r"));
}

/// Names of Xsens MVN for the segments of Theia3D, without the arms.
const XSENS: [(&str, &str); 10] = [
    ("pelvis_4X4", "Pelvis"),
    ("torso_4X4", "T8"),
    ("r_thigh_4X4", "RightUpperLeg"),
    ("l_thigh_4X4", "LeftUpperLeg"),
    ("r_shank_4X4", "RightLowerLeg"),
    ("l_shank_4X4", "LeftLowerLeg"),
    ("r_foot_4X4", "RightFoot"),
    ("l_foot_4X4", "LeftFoot"),
    ("r_toes_4X4", "RightToe"),
    ("l_toes_4X4", "LeftToe"),
];

/// The quaternion w, x, y, z of a rotation by less than half a turn.
pub(crate) fn quaternion(r: &Mat3) -> [f64; 4] {
    let w = (1.0 + r.trace()).sqrt() / 2.0;
    let part = |a: f64, b: f64| (a - b) / (4.0 * w);
    [w, part(r.m32, r.m23), part(r.m13, r.m31), part(r.m21, r.m12)]
}

/// The poses of a C3D as a `.mvnx`: earth and segments have x forward, y left, z up.
fn mvnx(c3d: &C3d, kept: &[(&str, &str)]) -> String {
    let theirs = Mat3::from_columns(&[Vec3::y(), -Vec3::x(), Vec3::z()]);
    let of = |label: &str| c3d.rotations.iter().find(|rotation| rotation.name == label).unwrap();
    let joined = |numbers: Vec<f64>| numbers.iter().map(|x| format!("{x:.6}")).collect::<Vec<_>>().join(" ");
    let segments: String = kept.iter().map(|(_, name)| format!("<segment label=\"{name}\"/>")).collect();
    let mut text = format!(
        "<mvnx version=\"4\"><subject label=\"made\" frameRate=\"{}\"><segments>{segments}</segments><frames>\n",
        c3d.rotation_rate_hz
    );
    for frame in 0..c3d.frames() {
        let (mut turns, mut places) = (Vec::new(), Vec::new());
        for (label, _) in kept {
            let m = of(label).matrices[frame];
            let turn = theirs.transpose() * Mat3::from_fn(|i, j| m[i][j]) * theirs;
            turns.extend(quaternion(&turn));
            places.extend((theirs.transpose() * Vec3::from_fn(|i, _| m[i][3]) / 1000.0).iter());
        }
        text += &format!(
            "<frame index=\"{frame}\" type=\"normal\"><orientation>{}</orientation><position>{}</position></frame>\n",
            joined(turns),
            joined(places)
        );
    }
    text + "</frames></subject></mvnx>\n"
}

#[test]
fn a_motion_of_xsens_mvn_gives_the_moments_of_the_walk_that_it_was_made_from() {
    let bench = demo("xsens_motion");
    let (c3d, _) = C3d::read(&bench.read("poses.c3d")).unwrap();
    bench.write("take.mvnx", mvnx(&c3d, &XSENS));
    let run = bench.run(&["forces", "take.mvnx", "--mass", "75", "--height", "1.75", "-o", "xsens", "--verbose"]);
    assert!(run.stdout.contains("ground    predicted"), "{} {}", run.stdout, run.stderr);
    for words in
        ["poses of 10 segments of Xsens MVN drive the body", "positions of a suit of inertial sensors are not measured"]
    {
        assert!(run.stderr.contains(words), "{words}: {}", run.stderr);
    }
    for column in ["hip_flexion_r_moment", "knee_angle_l_moment", "ankle_angle_r_moment"] {
        let predicted = difference(&bench, "xsens", column);
        println!("{column}: {predicted:.2} N.m");
        // As from the poses of a C3D.
        assert!(predicted < 25.0, "{column}: {predicted}");
    }
    let info = bench.run(&["info", "take.mvnx"]).done();
    for words in [
        "motion of Xsens MVN",
        "RightUpperLeg",
        "segments +x forward, +z up, -y right",
        "next: ambulo forces take.mvnx --mass KG",
    ] {
        assert!(info.stdout.contains(words), "{words}: {}", info.stdout);
    }

    let events = bench.run(&["events", "take.mvnx"]).done();
    assert!(events.stdout.contains("motion of the feet"), "{}", events.stdout);

    let lower: Vec<(&str, &str)> =
        XSENS.into_iter().filter(|(_, name)| *name != "T8" && !name.contains("Toe")).collect();
    bench.write("lower.mvnx", mvnx(&c3d, &lower));
    let run = bench.run(&["forces", "lower.mvnx", "--mass", "75", "--height", "1.75", "-o", "lower", "--verbose"]);
    assert!(run.stderr.contains("the trunk was not recorded: it is assumed upright"), "{}", run.stderr);
    let knee = difference(&bench, "lower", "knee_angle_l_moment");
    assert!(knee < 30.0, "{knee}");
    bench.run(&["forces", "take.mvnx", "-o", "out"]).refused(&["mass"]);
    bench.write("short.mvnx", mvnx(&c3d, &XSENS[..5]));
    bench.run(&["forces", "short.mvnx", "--mass", "75", "-o", "out"]).refused(&[
        "short.mvnx",
        "but none of",
        "right foot",
    ]);
    bench.run(&["info", "short.mvnx"]).done();
}
