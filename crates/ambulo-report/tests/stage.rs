//! Stages of folders made in memory.

use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::{Model, Side, to_osim};
use ambulo::spatial::{Pose, Vec3};
use ambulo_formats::table::Table;
use ambulo_report::internals::{Stage, StageForce};
use ambulo_report::page::ViewShape;
use ambulo_results::Folder;
use nalgebra::Rotation3;
use serde_json::json;
use std::collections::BTreeMap;

const FRAMES: usize = 40;

type Files = BTreeMap<String, Vec<u8>>;

/// The stage of these files, or why there is none, or the error.
fn stage(files: &Files) -> Result<Stage, String> {
    let file = |name: &str| files.get(name).cloned();
    match Stage::of_folder(&Folder::of_files("walk", &file)) {
        Ok(found) => found,
        Err(error) => Err(error.to_string()),
    }
}

fn body() -> Model {
    let build = Build { table: SegmentTable::DeLevaFemale, mass: 61.0, height: 1.68, toe_joint: true };
    full_body(&build).unwrap().model
}

/// Every coordinate oscillates; the pelvis makes several full turns.
fn motion(model: &Model) -> Table {
    let times: Vec<f64> = (0..FRAMES).map(|i| 0.5 + 0.01 * i as f64).collect();
    let mut columns = vec![("time".to_owned(), times.clone())];
    for (number, coordinate) in model.coordinates().iter().enumerate() {
        let value = |t: &f64| match coordinate.name.as_str() {
            "pelvis_rotation" => 3000.0 * t,
            "pelvis_ty" => 0.9,
            "pelvis_tx" => 1.3 * t,
            _ => 20.0 * (9.0 * t + number as f64).sin(),
        };
        columns.push((coordinate.name.clone(), times.iter().map(value).collect()));
    }
    let mut table = Table::new("Coordinates", columns).unwrap();
    table.in_degrees = Some(true);
    table
}

fn folder(model: &Model) -> Files {
    let files = [
        ("subject.osim", to_osim(model).unwrap().write().unwrap()),
        ("kinematics.mot", motion(model).write_storage()),
        ("summary.json", summary(1.68)),
    ];
    files.into_iter().map(|(name, bytes)| (name.to_owned(), bytes)).collect()
}

/// The summary of a run without forces for a person of this stature [m].
fn summary(height_m: f64) -> Vec<u8> {
    let off = json!({"kind": "off", "cutoff_hz": null, "order": null});
    let summary = json!({
        "version": "0.1.0", "input": {"motion": "walk.mot", "model": "built-in", "added_mass": []}, "model": "figure",
        "mass_kg": 61.0, "gravity_m_s2": 9.80665, "mass": { "state": "unknown", "kg": 61.0, "source": "model",
            "normalised_by": "model", "plates_kg": null, "plates_error_kg": null, "sources": [] },
        "height_m": height_m, "window_s": [0.5, 1.0], "requested_window_s": [null, null], "rate_hz": 100.0,
            "frames": FRAMES,
        "filter": {"motion": off, "force": off}, "ground": {"source": "none", "rule": null, "threshold_n": 20.0},
        "times_and_distances": {"quantities": []}, "peaks": [], "findings": [], "timing_ms": {},
    });
    summary.to_string().into_bytes()
}

fn at(stage: &Stage, name: &str) -> usize {
    stage.bodies.iter().position(|body| body.name == name).unwrap()
}

/// Columns of `grf.mot`: the right foot carries 600 N in the first half, the left never anything.
fn forces(rows: usize) -> Vec<u8> {
    let mut columns = vec![("time".to_owned(), (0..rows).map(|i| 0.5 + 0.01 * i as f64).collect::<Vec<f64>>())];
    for side in ["r", "l"] {
        for (stem, value) in [("force", 600.0), ("place", 0.25), ("torque", 1.0)] {
            for axis in ["x", "y", "z"] {
                let name = match stem {
                    "force" => format!("ground_force_{side}_v{axis}"),
                    "place" => format!("ground_force_{side}_p{axis}"),
                    _ => format!("ground_torque_{side}_{axis}"),
                };
                let acts = |i: usize| side == "r" && 2 * i < rows && !(stem == "force" && axis != "y");
                columns.push((name, (0..rows).map(|i| if acts(i) { value } else { 0.0 }).collect()));
            }
        }
    }
    Table::new("Ground Reactions", columns).unwrap().write_storage()
}

#[test]
fn every_body_has_a_shape_and_limbs_end_where_the_next_begins() {
    let stage = stage(&folder(&body())).unwrap();
    assert!(stage.bodies.iter().all(|body| !body.shapes.is_empty()));
    assert_eq!((stage.bodies.len(), stage.grid.frames, stage.contacts.len()), (14, FRAMES, 6));
    for (upper, lower) in [("femur_r", "tibia_r"), ("tibia_l", "calcn_l"), ("humerus_r", "forearm_r")] {
        let (upper, lower) = (&stage.bodies[at(&stage, upper)], &stage.bodies[at(&stage, lower)]);
        let ends = upper.shapes.iter().map(|shape| match shape {
            ViewShape::Capsule { to, .. } => (upper.path.place(7, Vec3::from(*to)) - lower.path.position[7]).norm(),
            _ => f64::INFINITY,
        });
        // Joints of this body are at the origins of its children.
        assert!(ends.fold(f64::INFINITY, f64::min) < 1e-9, "{}", upper.name);
    }
    let radii = |name: &str| {
        let radius = |shape: &ViewShape| if let ViewShape::Capsule { radius, .. } = shape { *radius } else { 0.0 };
        stage.bodies[at(&stage, name)].shapes.iter().map(radius).fold(0.0, f64::max)
    };
    assert!(radii("femur_r") > radii("tibia_r") && radii("tibia_r") > radii("toes_r"));
}

#[test]
fn the_vertex_is_as_high_as_the_person_is_tall() {
    let model = body();
    let mut files = folder(&model);
    let still = Table::new("Coordinates", vec![("time".into(), vec![0.0, 0.1]), ("pelvis_tx".into(), vec![0.0, 0.1])]);
    files.insert("kinematics.mot".into(), still.unwrap().write_storage());
    let stage = stage(&files).unwrap();
    let trunk = &stage.bodies[at(&stage, "torso")];
    let tops = trunk.shapes.iter().map(|shape| match shape {
        ViewShape::Capsule { from, to, radius } => {
            radius + trunk.path.place(0, Vec3::from(*from)).y.max(trunk.path.place(0, Vec3::from(*to)).y)
        }
        _ => 0.0,
    });
    let height = tops.fold(0.0, f64::max) - stage.floor_m;
    assert!((height - 1.68).abs() < 0.005, "{height}");
}

#[test]
fn a_trunk_has_no_slit() {
    let model = body();
    let stage = stage(&folder(&model)).unwrap();
    let shapes = &stage.bodies[at(&stage, "torso")].shapes;
    let faces = shapes.iter().find_map(|shape| match shape {
        ViewShape::Mesh { points, triangles } => Some((points, triangles)),
        ViewShape::Capsule { .. } | ViewShape::Box { .. } => None,
    });
    let (points, triangles) = faces.unwrap();
    let point = |corner: u32| Vec3::from(points[corner as usize]);
    let distances = |place: Vec3| {
        let distance = move |shape: &ViewShape| match shape {
            ViewShape::Capsule { from, to, radius } => {
                let (a, b) = (Vec3::from(*from), Vec3::from(*to));
                let share = ((place - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
                (place - a - (b - a) * share).norm() - radius
            }
            ViewShape::Mesh { .. } | ViewShape::Box { .. } => f64::INFINITY,
        };
        shapes.iter().map(distance)
    };
    let mut forwards = 0;
    for [a, b, c] in triangles.iter().map(|corners| corners.map(point)) {
        // In axes of the trunk: x forward, y up, z right. A face looks away from the middle, which is behind or ahead
        // of it.
        let normal = (b - a).cross(&(c - a)).normalize();
        assert!(normal.x.abs() > 0.9 && normal.x * a.x > 0.0, "{normal:?} at {a:?}");
        forwards += usize::from(normal.x > 0.0);
        for corner in [a, b, c] {
            // On the surface of a capsule and not inside one: no edges and no gaps.
            assert!(distances(corner).fold(f64::INFINITY, f64::min).abs() < 1e-9);
        }
    }
    assert_eq!((forwards, triangles.len()), (2, 4));
}

#[test]
fn a_turned_world_turns_the_picture() {
    let model = body();
    let mut bodies = model.bodies().to_vec();
    let turn = Pose {
        rotation: Rotation3::from_axis_angle(&Vec3::y_axis(), 0.7).into_inner(),
        translation: Vec3::new(0.3, 0.0, -2.0),
    };
    bodies[0].joint.parent_from_joint = turn * bodies[0].joint.parent_from_joint;
    let turned =
        Model::new(model.name(), model.gravity(), bodies, model.coordinates().to_vec(), model.markers().to_vec());
    let (plain, turned) = (stage(&folder(&model)).unwrap(), stage(&folder(&turned.unwrap())).unwrap());
    for (a, b) in plain.bodies.iter().zip(&turned.bodies) {
        for frame in 0..FRAMES {
            assert!((turn.place(a.path.position[frame]) - b.path.position[frame]).norm() < 1e-9, "{}", a.name);
            let rotation = turn.rotation * a.path.rotation[frame].to_rotation_matrix().into_inner();
            assert!((rotation - b.path.rotation[frame].to_rotation_matrix().into_inner()).norm() < 1e-9, "{}", a.name);
        }
        for (a, b) in a.shapes.iter().zip(&b.shapes) {
            let near = |p: &[f64; 3], q: &[f64; 3]| (Vec3::from(*p) - Vec3::from(*q)).norm() < 1e-9;
            match (a, b) {
                (ViewShape::Capsule { from: p, radius: r, .. }, ViewShape::Capsule { from: q, radius: s, .. }) => {
                    assert!(near(p, q) && (r - s).abs() < 1e-12);
                }
                (ViewShape::Mesh { points: p, .. }, ViewShape::Mesh { points: q, .. }) => {
                    assert!(p.len() == q.len() && p.iter().zip(q).all(|(p, q)| near(p, q)));
                }
                _ => panic!("{a:?} {b:?}"),
            }
        }
    }
    assert!((plain.floor_m - turned.floor_m).abs() < 1e-9);
}

#[test]
fn a_body_that_turns_round_and_round_never_jumps() {
    let stage = stage(&folder(&body())).unwrap();
    let path = &stage.bodies[at(&stage, "pelvis")].path;
    // 30 degrees an instant: cos 15° between neighbours, and more than three whole turns.
    for pair in path.rotation.windows(2) {
        assert!(pair[0].coords.dot(&pair[1].coords) > 0.9);
    }
    assert!(path.rotation.iter().any(|q| q.w < -0.5) && path.rotation.iter().any(|q| q.w > 0.5));
}

#[test]
fn an_unloaded_foot_has_no_arrow() {
    let mut files = folder(&body());
    assert!(stage(&files).unwrap().forces.is_empty());
    files.insert("grf.mot".into(), forces(FRAMES));
    files.insert("grf_measured.mot".into(), forces(FRAMES));
    let stage = stage(&files).unwrap();
    let names: Vec<&str> = stage.forces.iter().map(|force| force.name.as_str()).collect();
    assert_eq!(names, ["right", "right, plates"]);
    let StageForce { force, point, .. } = &stage.forces[0];
    assert!((force[3].y - 600.0).abs() < 1e-9 && (point[3].z - 0.25).abs() < 1e-9);
    assert!(force[FRAMES - 1].y.is_nan() && point[FRAMES - 1].x.is_nan());
    // The floor is where forces act.
    assert!((stage.floor_m - 0.25).abs() < 1e-9);
}

#[test]
fn a_moment_turns_its_body_about_its_axis() {
    let mut files = folder(&body());
    let rows: Vec<f64> = (0..FRAMES).map(|i| 0.5 + 0.01 * i as f64).collect();
    let constant = |value: f64| vec![value; FRAMES];
    let columns = vec![
        ("time".into(), rows),
        ("knee_angle_r_moment".into(), constant(61.0)),
        ("hip_flexion_l_moment".into(), constant(30.5)),
    ];
    files.insert("moments.sto".into(), Table::new("m", columns).unwrap().write_storage());
    let stage = stage(&files).unwrap();
    let found: Vec<_> =
        stage.torques.iter().map(|t| (t.name.as_str(), t.panel.as_str(), t.body, t.values[0], t.axis.z)).collect();
    // Extensors are positive; the knee of this body counts extension positive about z, the hip flexion.
    assert_eq!(found.len(), 2, "{found:?}");
    assert_eq!((found[0].0, found[0].1, found[0].2), ("left hip flexion", "hip_flexion_moment", at(&stage, "femur_l")));
    assert_eq!(
        (found[1].0, found[1].1, found[1].2),
        ("right knee flexion", "knee_flexion_moment", at(&stage, "tibia_r"))
    );
    for ((.., value, axis), [moment, along]) in found.into_iter().zip([[-0.5, -1.0], [1.0, 1.0]]) {
        assert!((value - moment).abs() < 1e-12 && (axis - along).abs() < 1e-12, "{value} about {axis}");
    }
}

/// Two instants of a right foot with this force at this height.
fn one_foot(force: f64, height: f64) -> Vec<u8> {
    let value = |name: &str| match name {
        "vy" => force,
        "py" => height,
        _ => 0.0,
    };
    let mut columns = vec![("time".to_owned(), vec![0.0, 0.1])];
    for name in ["vx", "vy", "vz", "px", "py", "pz"] {
        columns.push((format!("ground_force_r_{name}"), vec![value(name); 2]));
    }
    Table::new("Ground Reactions", columns).unwrap().write_storage()
}

#[test]
fn a_model_with_one_leg_and_one_without_legs_are_drawn() {
    let part = |name: &str, place: &str| {
        format!(
            r#"<Body name="{name}"><mass>3</mass><mass_center>{place}</mass_center><inertia>1 1 1 0 0 0</inertia></Body>"#
        )
    };
    let hinge = |coordinate: &str, parent: &str, child: &str, place: &str| {
        format!(
            r#"<PinJoint name="{child}_joint"><socket_parent_frame>p</socket_parent_frame><socket_child_frame>/bodyset/{child}</socket_child_frame>
            <frames><PhysicalOffsetFrame name="p"><socket_parent>{parent}</socket_parent><translation>{place}</translation></PhysicalOffsetFrame></frames>
            <coordinates><Coordinate name="{coordinate}"/></coordinates></PinJoint>"#
        )
    };
    let model = |bodies: &[String], joints: &[String]| {
        format!(
            r#"<OpenSimDocument Version="40000"><Model name="m"><BodySet><objects>{}</objects></BodySet>
            <JointSet><objects>{}</objects></JointSet></Model></OpenSimDocument>"#,
            bodies.concat(),
            joints.concat()
        )
    };
    let bodies = [
        part("pelvis", "0 0.1 0"),
        part("femur_r", "0 -0.2 0"),
        part("tibia_r", "0 -0.2 0"),
        part("calcn_r", "0.05 -0.03 0"),
    ];
    let joints = [
        hinge("pelvis_tilt", "/ground", "pelvis", "0 0.9 0"),
        hinge("hip_flexion_r", "/bodyset/pelvis", "femur_r", "0 0 0.08"),
        hinge("knee_angle_r", "/bodyset/femur_r", "tibia_r", "0 -0.42 0"),
        hinge("ankle_angle_r", "/bodyset/tibia_r", "calcn_r", "0 -0.41 0"),
    ];
    let table = Table::new("c", vec![("time".into(), vec![0.0, 0.1]), ("pelvis_tilt".into(), vec![0.0; 2])]).unwrap();
    for (count, soles) in [(4, 3), (1, 0)] {
        let mut files = folder(&body());
        files.insert("subject.osim".into(), model(&bodies[..count], &joints[..count]).into_bytes());
        files.insert("kinematics.mot".into(), table.write_storage());
        let stage = stage(&files).unwrap();
        assert_eq!((stage.bodies.len(), stage.contacts.len()), (count, soles));
        assert!(stage.bodies.iter().all(|body| !body.shapes.is_empty()));
        // The foot is 20 mm below the sole that the proportions of a person give: the sole follows.
        files.insert("grf.mot".into(), one_foot(30.0, -0.02));
        let standing = self::stage(&files).unwrap();
        let heights = standing.contacts.iter().map(|c| standing.bodies[c.body].path.place(0, c.place).y);
        let lowest = heights.fold(f64::INFINITY, f64::min);
        assert!(count == 1 || (lowest + 0.02).abs() < 1e-3, "{lowest}");
        let finite = |shape: &ViewShape| match shape {
            ViewShape::Capsule { from, to, radius } => from.iter().chain(to).chain([radius]).all(|x| x.is_finite()),
            ViewShape::Mesh { points, .. } => points.iter().flatten().all(|x| x.is_finite()),
            ViewShape::Box { .. } => false,
        };
        assert!(stage.bodies.iter().flat_map(|body| &body.shapes).all(finite));
    }
}

#[test]
fn missing_and_wrong_data_are_reported_with_their_place() {
    let model = body();
    let lacks = |name: &str| {
        let mut files = folder(&model);
        files.remove(name);
        stage(&files).unwrap_err()
    };
    assert_eq!(lacks("subject.osim"), "There is no body (subject.osim or figure.osim), so no figure can be drawn.");
    assert_eq!(lacks("kinematics.mot"), "There is no kinematics.mot, so no figure can be drawn.");
    let with = |name: &str, bytes: Vec<u8>| {
        let mut files = folder(&model);
        files.insert(name.into(), bytes);
        stage(&files).unwrap_err()
    };
    let osim = folder(&model)["subject.osim"].clone();
    let cut = with("subject.osim", osim[..osim.len() / 2].to_vec());
    assert!(cut.starts_with("walk/subject.osim: "), "{cut}");
    let rows = with("grf.mot", forces(FRAMES - 1));
    assert_eq!(rows, format!("walk/grf.mot: {} rows; expected {FRAMES}, one for each of kinematics.mot", FRAMES - 1));
    let text = String::from_utf8(folder(&model)["kinematics.mot"].clone()).unwrap();
    let gap = with("kinematics.mot", text.replacen("\t0.9\t", "\tnan\t", 1).into_bytes());
    assert!(gap.contains("column `pelvis_ty`: found NaN; expected a finite number"), "{gap}");
}

/// A ball falls on a slope next to a box; a wall moves.
fn scene() -> Files {
    let shapes = r#"{"format":1,"gravity_m_s2":[0,-9.8,0],
        "bodies":[{"name":"ball, red","mass_kg":2,"side":null,"shapes":[{"kind":"capsule","from":[0,0,0],"to":[0,0,0],"radius":0.1}]}],
        "obstacles":[{"name":"floor","moves":false,"shapes":[],"planes":[{"point":[0,-0.5,0],"normal":[0,1,0]},{"point":[1,0,0],"normal":[0.6,0.8,0]}]},
            {"name":"stone","moves":false,"shapes":[{"kind":"mesh","points":[[0,0,0],[1,0,0],[0,1,0]],"triangles":[[0,1,2]]}],"planes":[]},
            {"name":"wall","moves":true,"shapes":[{"kind":"box","center":[0,0,0],"half":[1,1,1],"turn":[0,0,0,1]}],"planes":[]}]}"#;
    let mut poses = "time,body,px,py,pz,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n".to_owned();
    for i in 0..5000 {
        let t = f64::from(i) / 1000.0;
        poses += &format!("{t},\"ball, red\",{t},1,0,1,0,0,0,0,0,0,0,0,0\n{t},wall,0,0,{t},1,0,0,0,0,0,0,0,0,0\n");
    }
    let mut contacts =
        "time,kind,first,second,px,py,pz,nx,ny,nz,fx,fy,fz,normal_force,friction_force,slip_m_s,gap_m\n".to_owned();
    for (x, force, kind) in [(1.0, 10.0, "contact"), (2.0, 30.0, "contact"), (9.0, 99.0, "impact")] {
        contacts += &format!("0.003,{kind},\"ball, red\",floor,{x},0,0,0,1,0,1,{force},0,{force},1,0,0\n");
    }
    let files = [("poses.csv", poses), ("shapes.json", shapes.to_owned()), ("contacts.csv", contacts)];
    files.into_iter().map(|(name, text)| (name.to_owned(), text.into_bytes())).collect()
}

#[test]
fn rear_foot_and_toes_of_a_scene_have_one_arrow() {
    let mut files = scene();
    let mut contacts = String::from_utf8(files["contacts.csv"].clone()).unwrap();
    for (body, x, force) in [("calcn_r", 1.0, 300.0), ("toes_r", 1.2, 100.0), ("calcn_l", 0.0, 7.0)] {
        contacts += &format!("0.006,contact,ann/{body},floor,{x},0,0,0,1,0,0,{force},0,{force},1,0,0\n");
    }
    files.insert("contacts.csv".to_owned(), contacts.into_bytes());
    let stage = stage(&files).unwrap();
    let names: Vec<&str> = stage.forces.iter().map(|force| force.name.as_str()).collect();
    assert_eq!(names, ["floor on ann/foot_l", "floor on ann/foot_r", "floor on ball, red"]);
    let right = &stage.forces[1];
    assert!(right.side == Some(Side::Right) && (right.force[2].y - 400.0).abs() < 1e-9);
    assert!((right.point[2].x - 1.05).abs() < 1e-12, "{}", right.point[2].x);
}

#[test]
fn arms_end_in_hands_with_fingers_and_a_thumb_in_front() {
    let model = body();
    let stage = stage(&folder(&model)).unwrap();
    for side in ["r", "l"] {
        let arm = &stage.bodies[at(&stage, &format!("forearm_{side}"))];
        let ends: Vec<(Vec3, f64)> = arm
            .shapes
            .iter()
            .map(|shape| match shape {
                ViewShape::Capsule { to, radius, .. } => (Vec3::from(*to), *radius),
                other => panic!("{other:?}"),
            })
            .collect();
        // The origin is the elbow. Forearm 0.155 and hand 0.108 of the stature of 1.68 m (de Leva 1996).
        let reach = ends.iter().map(|(to, radius)| radius - to.y).fold(0.0, f64::max);
        println!("{reach}");
        assert!((reach - 0.44).abs() < 0.02, "{reach}");
        let ahead = ends.iter().map(|(to, radius)| to.x + radius).fold(0.0, f64::max);
        let behind = ends.iter().map(|(to, radius)| radius - to.x).fold(0.0, f64::max);
        assert!(ahead > 1.3 * behind && ends.len() >= 10, "{ahead} {behind}");
    }
}

#[test]
fn a_scene_has_its_bodies_obstacles_floor_and_sums_of_contact_forces() {
    let stage = stage(&scene()).unwrap();
    let names: Vec<&str> = stage.bodies.iter().map(|body| body.name.as_str()).collect();
    assert_eq!(names, ["ball, red", "wall"]);
    assert_eq!((stage.grid.frames, stage.missing.len()), (1667, 1));
    assert!(
        stage.missing[0].contains("one of every 3 instants is drawn in 3-D (5000 in total)"),
        "{:?}",
        stage.missing
    );
    assert!((stage.bodies[0].path.position[1].x - 0.003).abs() < 1e-12 && (stage.grid.step_s - 0.003).abs() < 1e-9);
    assert!((stage.floor_m + 0.5).abs() < 1e-12 && (stage.weight_n - 19.6).abs() < 1e-9);
    // A stone, and a slab whose upper face goes through the point of the tilted plane.
    let ViewShape::Box { center, half, .. } = &stage.fixed[1] else { panic!("{:?}", stage.fixed) };
    let height = (Vec3::from(*center) - Vec3::new(1.0, 0.0, 0.0)).dot(&Vec3::new(0.6, 0.8, 0.0)) + half[1];
    assert!(height.abs() < 1e-9, "{height}");
    assert_eq!((stage.forces.len(), stage.forces[0].name.as_str()), (1, "floor on ball, red"));
    // 10 N at 1 m and 30 N at 2 m.
    assert!((stage.forces[0].force[1] - Vec3::new(2.0, 40.0, 0.0)).norm() < 1e-12);
    assert!((stage.forces[0].point[1] - Vec3::new(1.75, 0.0, 0.0)).norm() < 1e-12);
    assert!(stage.forces[0].force[2].x.is_nan());
}

#[test]
fn a_damaged_scene_is_rejected_with_file_and_line() {
    let refused = |file: &str, from: &str, to: &str| {
        let mut files = scene();
        let text = String::from_utf8(files[file].clone()).unwrap();
        assert!(text.contains(from), "{from}");
        files.insert(file.into(), text.replacen(from, to, 1).into_bytes());
        stage(&files).unwrap_err()
    };
    let unknown = refused("shapes.json", "\"format\":1", "\"format\":7");
    assert_eq!(unknown, "walk/shapes.json: format is 7; expected 1");
    assert!(refused("shapes.json", "\"bodies\"", "\"corpses\"").starts_with("walk/shapes.json: "));
    let corner = refused("shapes.json", "[0,1,2]", "[0,1,3]");
    assert_eq!(
        corner,
        "walk/shapes.json: `stone`: found a triangle with the corner 3; the mesh has 3 points, from 0 on"
    );
    let radius = refused("shapes.json", "\"radius\":0.1", "\"radius\":-1");
    assert!(radius.contains("`ball, red`: found a capsule of radius -1 m"), "{radius}");
    let number = refused("poses.csv", "0.002,wall,0", "0.002,wall,x");
    assert!(number.starts_with("walk/poses.csv: line 7, column 3: found `x`; expected a finite number"), "{number}");
    let lacking = refused("poses.csv", "0.002,wall", "0.002,hall");
    assert!(lacking.contains("line 7: `hall` has 1 rows at 3 instants"), "{lacking}");
    let head = refused("contacts.csv", "time,kind", "time,sort");
    assert!(head.starts_with("walk/contacts.csv: line 1: found `time,sort"), "{head}");
    let mut files = scene();
    files.remove("shapes.json");
    assert!(stage(&files).unwrap_err().contains("no poses.csv with shapes.json"));
}
