//! Results in the animator's own skeleton: figures whose motion is exactly that of the body, with the names, axes,
//! units and resting poses of several programs; what a skeleton cannot store; results that are not those of the
//! skeleton.

use crate::shared_data;
use ambulo::findings::Findings;
use ambulo::kinematics::Trajectory;
use ambulo::kinematics::retarget::{Retargeted, retarget};
use ambulo::kinematics::rig::{on_rig, segments};
use ambulo::model::Side;
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::motion::TimeGrid;
use ambulo::motion::skeleton::{Rig, RiggedMotion, skeleton_from_bvh};
use ambulo::spatial::{Mat3, Vec3};
use ambulo_formats::bvh::{Bvh, Channel, ChannelKind, Joint};
use nalgebra::Rotation3;

const BUILD: Build = Build { table: SegmentTable::DeLevaMale, mass: 70.0, height: 1.75, toe_joint: true };
const FRAMES: usize = 13;
const STEP_S: f64 = 0.02;

/// How a program names the joints, without sides: pelvis, first joint of the spine, thigh, shank, foot, toes, upper
/// arm, forearm, hand; and a side.
struct Names {
    joints: [&'static str; 9],
    side: fn(&str, Side) -> String,
}

fn in_front(name: &str, side: Side) -> String {
    let side = if side == Side::Right { "Right" } else { "Left" };
    match name.rsplit_once(':') {
        Some((space, name)) => format!("{space}:{side}{name}"),
        None => format!("{side}{name}"),
    }
}

fn behind(name: &str, side: Side) -> String {
    format!("{name}.{}", if side == Side::Right { "R" } else { "L" })
}

const LAFAN: Names =
    Names { joints: ["Hips", "Spine", "UpLeg", "Leg", "Foot", "Toe", "Arm", "ForeArm", "Hand"], side: in_front };
const SOMA: Names =
    Names { joints: ["Hips", "Spine1", "Leg", "Shin", "Foot", "ToeBase", "Arm", "ForeArm", "Hand"], side: in_front };
const CMU: Names = Names {
    joints: ["Hips", "LowerBack", "UpLeg", "Leg", "Foot", "ToeBase", "Arm", "ForeArm", "Hand"],
    side: in_front,
};
const ROKOKO: Names =
    Names { joints: ["Hips", "Spine1", "Thigh", "Shin", "Foot", "Toe", "Arm", "ForeArm", "Hand"], side: in_front };
const MIXAMO: Names = Names {
    joints: [
        "mixamorig:Hips",
        "mixamorig:Spine",
        "mixamorig:UpLeg",
        "mixamorig:Leg",
        "mixamorig:Foot",
        "mixamorig:ToeBase",
        "mixamorig:Arm",
        "mixamorig:ForeArm",
        "mixamorig:Hand",
    ],
    side: in_front,
};
const RIGIFY: Names = Names {
    joints: [
        "DEF-spine",
        "DEF-spine.001",
        "DEF-thigh",
        "DEF-shin",
        "DEF-foot",
        "DEF-toe",
        "DEF-upper_arm",
        "DEF-forearm",
        "DEF-hand",
    ],
    side: behind,
};

/// Properties of made files that the reader has to find out.
struct Style {
    names: Names,
    file_from_world: Mat3,
    units_per_metre: f64,
    /// Angle of the arms below the horizontal in the resting pose [rad].
    arms_below: f64,
}

fn z_up() -> Mat3 {
    Mat3::new(1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0)
}

fn facing_z() -> Mat3 {
    Mat3::new(0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0)
}

/// A joint of the figure: the body that carries it and its place there, and whether it drives a separate body or turns
/// at will.
struct Part {
    name: String,
    parent: Option<usize>,
    place: Vec3,
    drives: Option<usize>,
    /// Axes of the joint in those of its body.
    axes: Mat3,
    end: Option<Vec3>,
}

/// A figure with the joints and lengths of the built-in body, a spine of two joints, clavicles, twist bones, fingers
/// and a prop.
struct Figure {
    human: Human,
    style: Style,
    parts: Vec<Part>,
}

impl Figure {
    fn new(style: Style) -> Figure {
        let human = full_body(&BUILD).unwrap();
        let mut figure = Figure { human, style, parts: Vec::new() };
        let [pelvis, spine, ..] = figure.style.names.joints;
        let root = figure.driven(pelvis.to_owned(), None, "pelvis", 0.0);
        figure.free("Prop", root, Vec3::new(0.1, 0.0, 0.2));
        let low = figure.driven(spine.to_owned(), Some(root), "torso", 0.0);
        let high = figure.free("UpperSpine", low, Vec3::y() * 0.2);
        let head = figure.free("Head", high, Vec3::y() * 0.3);
        figure.parts[head].end = Some(Vec3::y() * 0.2);
        // A file has each joint directly before its children.
        Side::BOTH.into_iter().for_each(|side| figure.arm(side, high));
        Side::BOTH.into_iter().for_each(|side| figure.leg(side, root));
        figure
    }

    fn arm(&mut self, side: Side, high: usize) {
        let [.., arm, forearm, hand] = self.style.names.joints.map(|name| (self.style.names.side)(name, side));
        let s = side.letter();
        let raised = self.style.arms_below - std::f64::consts::FRAC_PI_2;
        let clavicle = self.free(&format!("Clavicle_{s}"), high, Vec3::y() * 0.1);
        let upper = self.driven(arm, Some(clavicle), &format!("humerus_{s}"), raised);
        // The place of the shoulder on the trunk, less the places of the joints between.
        self.parts[upper].place -= Vec3::y() * 0.3;
        self.free(&format!("ArmTwist_{s}"), upper, -Vec3::y() * 0.1);
        let lower = self.driven(forearm, Some(upper), &format!("forearm_{s}"), raised);
        let hand = self.free(&hand, lower, -Vec3::y() * self.human.dimensions.forearm);
        let finger = self.free(&format!("Finger_{s}"), hand, -Vec3::y() * 0.08);
        self.parts[finger].end = Some(-Vec3::y() * 0.03);
    }

    fn leg(&mut self, side: Side, root: usize) {
        let [_, _, thigh, shank, foot, toes, ..] =
            self.style.names.joints.map(|name| (self.style.names.side)(name, side));
        let s = side.letter();
        let thigh = self.driven(thigh, Some(root), &format!("femur_{s}"), 0.0);
        self.free(&format!("LegTwist_{s}"), thigh, -Vec3::y() * 0.2);
        let shank = self.driven(shank, Some(thigh), &format!("tibia_{s}"), 0.0);
        let foot = self.driven(foot, Some(shank), &format!("calcn_{s}"), 0.0);
        let toes = self.driven(toes, Some(foot), &format!("toes_{s}"), 0.0);
        self.parts[toes].end = Some(Vec3::x() * self.human.dimensions.ball_to_toe);
    }

    /// A joint that drives a body. In the resting pose the body is turned outwards by an angle.
    fn driven(&mut self, name: String, parent: Option<usize>, body: &str, raised: f64) -> usize {
        let model = &self.human.model;
        let id = model.body(body).unwrap();
        let outwards = if model.anatomy().body_side(id) == Some(Side::Left) { -raised } else { raised };
        let turned = *Rotation3::from_axis_angle(&Vec3::x_axis(), -outwards).matrix();
        let axes = turned * self.style.file_from_world.transpose();
        let place = model.bodies()[id.index()].joint.parent_from_joint.translation;
        self.parts.push(Part { name, parent, place, drives: Some(id.index()), axes, end: None });
        self.parts.len() - 1
    }

    /// A joint that drives no body, at a place relative to its parent.
    fn free(&mut self, name: &str, parent: usize, place: Vec3) -> usize {
        let axes = self.parts[parent].axes;
        let part = Part { name: name.to_owned(), parent: Some(parent), place, drives: None, axes, end: None };
        self.parts.push(part);
        self.parts.len() - 1
    }

    /// The skeleton with this motion: one list of coordinates per frame.
    fn bvh(&self, motion: &[Vec<f64>]) -> Bvh {
        let unit = self.style.units_per_metre;
        let inside = |parent: Option<usize>, place: Vec3| match parent {
            Some(parent) => self.parts[parent].axes.transpose() * place * unit,
            None => Vec3::zeros(),
        };
        let joint = |(index, part): (usize, &Part)| {
            let rotations = [2, 1, 0].map(|axis| Channel { kind: ChannelKind::Rotation, axis });
            let positions = [0, 1, 2].map(|axis| Channel { kind: ChannelKind::Position, axis });
            let own = positions.into_iter().filter(|_| part.parent.is_none()).chain(rotations).collect();
            let end = part.end.map(|end| inside(Some(index), end).into());
            Joint {
                name: part.name.clone(),
                parent: part.parent,
                offset: inside(part.parent, part.place).into(),
                channels: own,
                end_sites: end.into_iter().collect(),
            }
        };
        let joints = self.parts.iter().enumerate().map(joint).collect();
        let frames: Vec<Vec<f64>> = motion.iter().enumerate().map(|(frame, q)| self.frame(frame, q)).collect();
        Bvh::new(joints, STEP_S, &frames).unwrap()
    }

    fn frame(&self, frame: usize, q: &[f64]) -> Vec<f64> {
        let poses = self.human.model.poses(q);
        let (mut values, mut rotations) = (Vec::new(), Vec::<Mat3>::new());
        for part in &self.parts {
            let parent = part.parent.map_or(Mat3::identity(), |parent| rotations[parent]);
            let rotation = match part.drives {
                Some(body) => self.style.file_from_world * poses[body].rotation * part.axes,
                None => parent * self.own_turn(part, frame),
            };
            if part.parent.is_none() {
                let place = self.style.file_from_world * poses[0].translation * self.style.units_per_metre;
                values.extend(place.iter());
            }
            let (x, y, z) = Rotation3::from_matrix_unchecked(parent.transpose() * rotation).euler_angles();
            values.extend([z, y, x].map(f64::to_degrees));
            rotations.push(rotation);
        }
        values
    }

    /// Fingers, twist bones and props turn; the spine and the clavicles do not, because the trunk of the body is one
    /// piece.
    fn own_turn(&self, part: &Part, frame: usize) -> Mat3 {
        let turns = ["Prop", "Twist", "Finger", "Head"].iter().any(|word| part.name.contains(word));
        let angle = if turns { 0.3 + 0.05 * frame as f64 } else { 0.0 };
        *Rotation3::from_euler_angles(angle, -0.5 * angle, 2.0 * angle).matrix()
    }

    /// A motion of all coordinates that a skeleton shows. The trunk bends in the last third only, so that the median
    /// distance from hips to shoulders is that of the upright body.
    fn motion(&self) -> Vec<Vec<f64>> {
        let model = &self.human.model;
        let value = |frame: usize, index: usize, name: &str| {
            let wave = (0.4 * frame as f64 + index as f64).sin();
            match name {
                "pelvis_tx" => 0.05 * frame as f64,
                "pelvis_ty" => 0.9 + 0.01 * wave,
                _ if name.starts_with("lumbar") => 0.1 * wave * f64::from(u8::from(3 * frame > 2 * FRAMES)),
                _ if name.starts_with("knee") => -0.5 + 0.3 * wave,
                _ if name.starts_with("elbow") => 0.8 + 0.3 * wave,
                _ if name.starts_with("pro_sup") => 0.0,
                _ => 0.1 * wave,
            }
        };
        let frame = |frame: usize| {
            model.coordinates().iter().enumerate().map(|(index, c)| value(frame, index, &c.name)).collect()
        };
        (0..FRAMES).map(frame).collect()
    }
}

/// The body of a skeleton, and the motion of its fit.
fn fitted(bvh: &Bvh) -> (Retargeted, Vec<Vec<f64>>) {
    let findings = &mut Findings::default();
    let skeleton = skeleton_from_bvh(bvh, "take", Some(BUILD.height), findings).unwrap();
    let body = retarget(&BUILD, &skeleton, findings).unwrap();
    let columns = &body.fit.motion.columns;
    let value = |frame: usize| move |column: &Option<Vec<f64>>| column.as_ref().map_or(0.0, |column| column[frame]);
    let motion = (0..skeleton.markers.frames()).map(|frame| columns.iter().map(value(frame)).collect()).collect();
    (body, motion)
}

fn trajectory(body: &Retargeted, start_s: f64, step_s: f64, motion: &[Vec<f64>]) -> Trajectory {
    let still = vec![0.0; motion.len()];
    let column = |index: usize| [motion.iter().map(|q| q[index]).collect(), still.clone(), still.clone()];
    let columns = (0..body.human.model.coordinates().len()).map(column).collect();
    Trajectory::new(&body.human.model, TimeGrid { start_s, step_s, frames: motion.len() }, columns).unwrap()
}

fn written(bvh: &Bvh, body: &Retargeted, motion: &Trajectory) -> Result<RiggedMotion, String> {
    let model = &body.human.model;
    let rig = Rig::new(bvh, "take", Some(BUILD.height), &segments(model)).map_err(|error| error.to_string())?;
    on_rig(model, motion, rig).map_err(|error| error.to_string())
}

/// Largest difference between the rotations of all joints of two motions of a skeleton [degrees], and between its
/// positions [its unit].
fn difference(a: &Bvh, b: &Bvh) -> [f64; 2] {
    let mut most = [0.0_f64; 2];
    for (a, b) in (0..a.frames()).map(|frame| (a.frame(frame).unwrap(), b.frame(frame).unwrap())) {
        most[1] = (0..3).map(|axis| (a[axis] - b[axis]).abs()).fold(most[1], f64::max);
        for (a, b) in a[3..].chunks(3).zip(b[3..].chunks(3)) {
            let turn = |v: &[f64]| Rotation3::from_euler_angles(v[2], v[1], v[0]);
            let [a, b] = [a, b].map(|v| turn(&v.iter().map(|x| x.to_radians()).collect::<Vec<f64>>()));
            let away = (a.matrix() - b.matrix()).norm() / 2.0_f64.sqrt();
            most[0] = most[0].max(away.to_degrees());
        }
    }
    most
}

fn styles() -> Vec<Style> {
    let style = |names, file_from_world, units_per_metre, arms_below| Style {
        names,
        file_from_world,
        units_per_metre,
        arms_below,
    };
    vec![
        style(LAFAN, facing_z(), 100.0, 0.0),
        style(SOMA, facing_z(), 100.0, 0.7),
        style(CMU, facing_z(), 1.0 / 0.0254, 0.2),
        style(ROKOKO, z_up(), 100.0, 0.0),
        style(MIXAMO, facing_z(), 1.0, 0.8),
        style(RIGIFY, z_up(), 1.0, 0.6),
    ]
}

#[test]
fn a_motion_of_the_body_comes_back_unchanged() {
    for style in styles() {
        let figure = Figure::new(style);
        let bvh = figure.bvh(&figure.motion());
        let (body, motion) = fitted(&bvh);
        let made = written(&bvh, &body, &trajectory(&body, 0.0, STEP_S, &motion)).unwrap();
        let [degrees, units] = difference(&bvh, &made.bvh);
        println!("{}: {degrees:.1e} degrees, {units:.1e} units", bvh.joints()[0].name);
        assert!(degrees < 1e-6 && units < 1e-6, "{degrees} degrees, {units} units");
        assert!(made.limits.without_joint.is_empty() && !made.limits.stays, "{:?}", made.limits);
        assert_eq!((made.bvh.joints(), made.bvh.frame_time_s()), (bvh.joints(), bvh.frame_time_s()));
    }
}

#[test]
fn a_changed_motion_of_the_body_is_that_of_the_skeleton_and_the_rest_follows() {
    for style in styles() {
        let figure = Figure::new(style);
        let bvh = figure.bvh(&figure.motion());
        let (body, mut motion) = fitted(&bvh);
        let model = &body.human.model;
        for (frame, q) in motion.iter_mut().enumerate() {
            for (index, (value, coordinate)) in q.iter_mut().zip(model.coordinates()).enumerate() {
                let is_trunk = coordinate.name.starts_with("lumbar");
                let change = 0.05 * (0.3 * frame as f64 + 2.0 * index as f64).cos();
                *value += if is_trunk { 0.0 } else { change };
            }
        }
        let made = written(&bvh, &body, &trajectory(&body, 0.0, STEP_S, &motion)).unwrap();
        let (_, found) = fitted(&made.bvh);
        for (index, coordinate) in model.coordinates().iter().enumerate() {
            // The floor is found anew, and nothing in a skeleton shows pronation.
            let by = if coordinate.name == "pelvis_ty" { found[0][index] - motion[0][index] } else { 0.0 };
            if coordinate.name.starts_with("pro_sup") {
                continue;
            }
            for (frame, (found, wanted)) in found.iter().zip(&motion).enumerate() {
                let away = found[index] - wanted[index] - by;
                assert!(away.abs() < 1e-6, "{} in frame {frame}: {away}", coordinate.name);
            }
        }
        let [degrees, _] = difference(&bvh, &made.bvh);
        let DifferencesOf { most, rms } = DifferencesOf::new(&made);
        assert!(degrees > 3.0 && most > 3.0 && rms < most, "{degrees} {most} {rms}");
        assert_kept(&figure, &bvh, &made.bvh);
    }
}

/// What a changed skeleton states about its changes [degrees].
struct DifferencesOf {
    most: f64,
    rms: f64,
}

impl DifferencesOf {
    fn new(made: &RiggedMotion) -> DifferencesOf {
        let most = made.differences.most_turned.as_ref().map_or(0.0, |(_, angle)| angle.to_degrees());
        DifferencesOf { most, rms: made.differences.turned_rms_rad.to_degrees() }
    }
}

/// Fingers, twist bones, head and prop keep their numbers to the last bit.
fn assert_kept(figure: &Figure, before: &Bvh, after: &Bvh) {
    for (part, range) in figure.parts.iter().zip(before.channel_ranges()) {
        let kept = (0..before.frames())
            .all(|frame| before.frame(frame).unwrap()[range.clone()] == after.frame(frame).unwrap()[range.clone()]);
        assert_eq!(kept, part.drives.is_none(), "{}", part.name);
    }
}

/// A figure of LAFAN's names, with its body and motion.
fn lafan() -> (Figure, Bvh, Retargeted, Vec<Vec<f64>>) {
    let figure = Figure::new(styles().remove(0));
    let bvh = figure.bvh(&figure.motion());
    let (body, motion) = fitted(&bvh);
    (figure, bvh, body, motion)
}

/// The same file with other frames.
fn with_frames(bvh: &Bvh, joints: Vec<Joint>, frame: impl Fn(usize, Vec<f64>) -> Vec<f64>) -> Bvh {
    let frames: Vec<Vec<f64>> = (0..bvh.frames()).map(|k| frame(k, bvh.frame(k).unwrap().to_vec())).collect();
    Bvh::new(joints, bvh.frame_time_s(), &frames).unwrap()
}

#[test]
fn a_result_of_a_part_has_its_frames_and_a_separate_first_pose_stays() {
    let (_, bvh, body, motion) = lafan();
    let part = trajectory(&body, 4.0 * STEP_S, STEP_S, &motion[4..9]);
    let made = written(&bvh, &body, &part).unwrap().bvh;
    assert_eq!(made.frames(), 5);
    assert!((0..5).all(|k| (made.frame(k).unwrap()[0] - bvh.frame(k + 4).unwrap()[0]).abs() < 1e-6));
    // Two metres in a frame are no motion: the first frame is not part of the recording, whose results begin with the
    // second.
    let posed = with_frames(&bvh, bvh.joints().to_vec(), |frame, mut values| {
        values[0] += if frame == 0 { 200.0 } else { 0.0 };
        values
    });
    let (body, motion) = fitted(&posed);
    assert_eq!(motion.len(), FRAMES - 1);
    let made = written(&posed, &body, &trajectory(&body, STEP_S, STEP_S, &motion)).unwrap().bvh;
    assert_eq!((made.frames(), made.frame(0)), (FRAMES, posed.frame(0)));
    assert!(difference(&posed, &made).into_iter().all(|most| most < 1e-6));
}

#[test]
fn a_joint_with_fewer_channels_gets_what_it_can_store() {
    let (figure, bvh, _, _) = lafan();
    let knee = figure.parts.iter().position(|part| part.name == "RightLeg").unwrap();
    let mut joints = bvh.joints().to_vec();
    joints[knee].channels.retain(|channel| channel.axis == 0);
    joints[0].channels.retain(|channel| channel.kind == ChannelKind::Rotation);
    let first = bvh.channel_ranges()[knee].start;
    let bvh = with_frames(&bvh, joints, |_, mut values| {
        // A hinge, which a knee of the body is.
        values.drain(first..first + 2);
        values.drain(..3);
        values
    });
    let (body, mut motion) = fitted(&bvh);
    let index = body.human.model.coordinate("knee_angle_r").unwrap().index();
    motion.iter_mut().for_each(|q| q[index] -= 0.1);
    let made = written(&bvh, &body, &trajectory(&body, 0.0, STEP_S, &motion)).unwrap();
    assert_eq!((made.limits.few_channels, made.limits.stays), (vec!["RightLeg".to_owned()], true));
    let (_, found) = fitted(&made.bvh);
    assert!(found.iter().zip(&motion).all(|(found, wanted)| (found[index] - wanted[index]).abs() < 1e-6));
}

#[test]
fn results_of_something_else_are_refused() {
    let (_, bvh, body, motion) = lafan();
    let refused = |bvh: &Bvh, body: &Retargeted, motion: &Trajectory, words: &str| {
        let error = written(bvh, body, motion).unwrap_err();
        assert!(error.contains(words), "{error}");
    };
    let own = trajectory(&body, 0.0, STEP_S, &motion);
    let mut joints = bvh.joints().to_vec();
    let shank = joints.iter_mut().find(|joint| joint.name == "RightFoot").unwrap();
    shank.offset = shank.offset.map(|x| 1.05 * x);
    let longer = with_frames(&bvh, joints, |_, values| values);
    refused(&longer, &body, &own, "the right shank is 0.4");
    let slower = trajectory(&body, 0.0, 1.5 * STEP_S, &motion[..5]);
    refused(
        &bvh,
        &body,
        &slower,
        "the result has 5 frames from 0.0000 s at 33.33 Hz, the skeleton 13 frames at 50.00 Hz",
    );
    let longer = [&motion[..], &motion[..1]].concat();
    refused(&bvh, &body, &trajectory(&body, 0.0, STEP_S, &longer), "the result has 14 frames");
    let elsewhere: Vec<Vec<f64>> = motion.iter().map(|q| q.iter().map(|x| x + 0.5).collect()).collect();
    refused(&bvh, &body, &trajectory(&body, 0.0, STEP_S, &elsewhere), "is this the result of another take?");
    let unmarked = Retargeted { human: full_body(&BUILD).unwrap(), ..body };
    refused(&bvh, &unmarked, &trajectory(&unmarked, 0.0, STEP_S, &motion), "has no marker `pelvis_up`");
}

/// 120 frames of a real file.
fn real(file: &str) -> Option<Bvh> {
    let data = shared_data::data()?;
    let (all, _) = Bvh::read(&std::fs::read(data.join("bvh").join(file)).unwrap()).unwrap();
    let frames: Vec<Vec<f64>> = (1..121).filter_map(|frame| all.frame(frame).map(<[f64]>::to_vec)).collect();
    Some(Bvh::new(all.joints().to_vec(), all.frame_time_s(), &frames).unwrap())
}

#[test]
fn real_skeletons_get_back_their_own_fit() {
    for file in ["AV_8Walk_Meredith_HVHA_Rep1.bvh", "01_01.bvh"] {
        let Some(bvh) = real(file) else { return };
        let (body, motion) = fitted(&bvh);
        let made = written(&bvh, &body, &trajectory(&body, 0.0, bvh.frame_time_s(), &motion)).unwrap();
        let DifferencesOf { most, rms } = DifferencesOf::new(&made);
        println!("{file}: {rms:.1e} degrees RMS, {most:.1e} at most ({:?})", made.differences.most_turned);
        // These skeletons are not quite bodies: their points are millimetres away from it, and that stays.
        assert!(body.fit.errors.iter().any(|error| error.rms_m > 1e-3));
        assert!(most < 1e-4 && made.differences.most_moved_m < 1e-8, "{:?}", made.differences);
    }
}

#[test]
fn a_real_skeleton_read_again_has_the_changed_motion() {
    let Some(bvh) = real("AV_8Walk_Meredith_HVHA_Rep1.bvh") else { return };
    let (body, mut motion) = fitted(&bvh);
    let coordinates = body.human.model.coordinates();
    let is_angle = |index: &usize| {
        let name = &coordinates[*index].name;
        let is_place = name.starts_with("pelvis_t") && name != "pelvis_tilt";
        !is_place && !name.starts_with("pro_sup")
    };
    let angles: Vec<usize> = (0..coordinates.len()).filter(is_angle).collect();
    for (frame, q) in motion.iter_mut().enumerate() {
        for &index in &angles {
            q[index] += 0.05 * (0.1 * frame as f64 + 2.0 * index as f64).cos();
        }
    }
    let made = written(&bvh, &body, &trajectory(&body, 0.0, bvh.frame_time_s(), &motion)).unwrap();
    let rms_deg = |other: &Bvh| {
        let (_, found) = fitted(other);
        let away = |(found, wanted): (&Vec<f64>, &Vec<f64>)| -> f64 {
            angles.iter().map(|&index| (found[index] - wanted[index]).powi(2)).sum()
        };
        let squares: f64 = found.iter().zip(&motion).map(away).sum();
        (squares / (motion.len() * angles.len()) as f64).sqrt().to_degrees()
    };
    let (before, after) = (rms_deg(&bvh), rms_deg(&made.bvh));
    println!("{before:.2} degrees RMS from the changed motion before, {after:.2} degrees after");
    // Read again, the body has other lengths: those of the trunk are medians over the motion.
    assert!(before > 1.5 && after < 0.15 * before, "{before} {after}");
}
