//! Skeletons of BVH files as recordings of joint centres: names, unit, axes, forward kinematics; synthetic and real
//! files.

use crate::shared_data;
use ambulo::findings::{Code, Findings};
use ambulo::motion::skeleton::{POINT_DISTANCE_M, SkeletonError, SkeletonRecording, skeleton_from_bvh};
use ambulo::spatial::Vec3;
use ambulo_formats::bvh::Bvh;

/// Two legs, an arm on the right, no toes on the left; centimetres, y up, facing +z. The right knee bends by 90 degrees
/// in the second frame.
const FIGURE: &str = "HIERARCHY
ROOT Hips
{
    OFFSET 7 8 9
    CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
    JOINT RightUpLeg
    {
        OFFSET -9 0 0
        CHANNELS 3 Zrotation Xrotation Yrotation
        JOINT RightLeg
        {
            OFFSET 0 -43 0
            CHANNELS 3 Zrotation Xrotation Yrotation
            JOINT RightFoot
            {
                OFFSET 0 -42 0
                CHANNELS 3 Zrotation Xrotation Yrotation
                JOINT RightToeBase
                {
                    OFFSET 0 -6 14
                    CHANNELS 3 Zrotation Xrotation Yrotation
                    End Site
                    {
                        OFFSET 0 0 6
                    }
                }
            }
        }
    }
    JOINT LeftUpLeg
    {
        OFFSET 9 0 0
        CHANNELS 3 Zrotation Xrotation Yrotation
        JOINT LeftLeg
        {
            OFFSET 0 -43 0
            CHANNELS 3 Zrotation Xrotation Yrotation
            JOINT LeftFoot
            {
                OFFSET 0 -42 0
                CHANNELS 3 Zrotation Xrotation Yrotation
                End Site
                {
                    OFFSET 0 -6 14
                }
            }
        }
    }
    JOINT RightShoulder
    {
        OFFSET 0 50 0
        CHANNELS 3 Zrotation Xrotation Yrotation
        JOINT RightArm
        {
            OFFSET -17 0 0
            CHANNELS 3 Zrotation Xrotation Yrotation
            End Site
            {
                OFFSET -28 0 0
            }
        }
    }
}
MOTION
Frames: 2
Frame Time: 0.01
0 93 0 0 0 0  0 0 0 0 0 0 0 0 0 0 0 0  0 0 0 0 0 0 0 0 0  0 0 0 0 0 0
0 93 0 0 0 0  0 0 0 0 90 0 0 0 0 0 0 0  0 0 0 0 0 0 0 0 0  0 0 0 0 0 0
";

fn read(text: &str, height_m: Option<f64>) -> (SkeletonRecording, Findings) {
    let mut findings = Findings::default();
    let (bvh, _) = Bvh::read(text.as_bytes()).unwrap();
    let recording = skeleton_from_bvh(&bvh, "figure", height_m, &mut findings).unwrap();
    (recording, findings)
}

fn refused(text: &str) -> String {
    let (bvh, _) = Bvh::read(text.as_bytes()).unwrap();
    skeleton_from_bvh(&bvh, "figure", None, &mut Findings::default()).unwrap_err().to_string()
}

#[track_caller]
fn assert_at(recording: &SkeletonRecording, name: &str, frame: usize, place: [f64; 3]) {
    let found = recording.markers.marker(name).unwrap_or_else(|| panic!("no {name}")).positions[frame];
    let distance = (found - Vec3::from(place)).norm();
    assert!(distance < 1e-12, "{name} at {found:?}, expected at {place:?}");
}

#[test]
fn joint_centres_follow_from_the_bones() {
    let (recording, findings) = read(FIGURE, None);
    println!("{}", recording.statement);
    assert_eq!(
        recording.statement,
        "lengths in centimetres (thigh and shank of 0.850 m correspond to a stature of 1.73 m); \
         +y up, facing along +z -> world x forward, y up, z right"
    );
    // The person faces +z of the file, so -x of the file is to the right: world z.
    assert_at(&recording, "hip_r", 0, [0.0, 0.93, 0.09]);
    assert_at(&recording, "hip_l", 0, [0.0, 0.93, -0.09]);
    assert_at(&recording, "ankle_r", 0, [0.0, 0.08, 0.09]);
    assert_at(&recording, "toe_r", 0, [0.14, 0.02, 0.09]);
    assert_at(&recording, "toe_tip_r", 0, [0.2, 0.02, 0.09]);
    assert_at(&recording, "toe_tip_l", 0, [0.14, 0.02, -0.09]);
    assert_at(&recording, "shoulder_r", 0, [0.0, 1.43, 0.17]);
    // A rotation of +90 degrees about x, which points to the left, moves the shank from down to backwards: a flexed
    // knee.
    assert_at(&recording, "knee_r", 1, [0.0, 0.5, 0.09]);
    assert_at(&recording, "ankle_r", 1, [-0.42, 0.5, 0.09]);
    assert_at(&recording, "toe_r", 1, [-0.48, 0.36, 0.09]);
    assert!(findings.has(Code::BvhLowTrust) && findings.has(Code::BvhJointsMissing), "{findings:?}");
}

#[test]
fn points_next_to_a_joint_show_the_orientation_of_its_segment() {
    let (recording, _) = read(FIGURE, None);
    assert_at(&recording, "pelvis_up", 0, [0.0, 0.93 + POINT_DISTANCE_M, 0.0]);
    assert_at(&recording, "pelvis_front", 0, [POINT_DISTANCE_M, 0.93, 0.0]);
    assert_at(&recording, "thigh_side_r", 0, [0.0, 0.5, 0.09 + POINT_DISTANCE_M]);
    assert_at(&recording, "thigh_side_l", 0, [0.0, 0.5, POINT_DISTANCE_M - 0.09]);
    assert_at(&recording, "shank_side_r", 1, [-0.42, 0.5, 0.09 + POINT_DISTANCE_M]);
    let turned = FIGURE.replace("0 93 0 0 0 0  0 0 0 0 90", "0 93 0 0 0 90  0 0 0 0 90");
    let (recording, _) = read(&turned, None);
    // A rotation of +90 degrees about y: the person faces left, and right becomes forward.
    assert_at(&recording, "hip_r", 1, [0.09, 0.93, 0.0]);
    assert_at(&recording, "pelvis_front", 1, [0.0, 0.93, -POINT_DISTANCE_M]);
    assert_at(&recording, "thigh_side_r", 1, [0.09 + POINT_DISTANCE_M, 0.5, 0.0]);
}

#[test]
fn with_a_resting_pose_that_is_not_upright_the_mean_posture_is_used() {
    // The bones of the legs lie along +z at rest; thighs rotated by 90 degrees about x hang down. (x, y, z) = Rx(90)
    // (x, z, -y).
    let lying = FIGURE
        .replace("OFFSET 0 -43 0", "OFFSET 0 0 43")
        .replace("OFFSET 0 -42 0", "OFFSET 0 0 42")
        .replace("OFFSET 0 -6 14", "OFFSET 0 14 6")
        .replace("OFFSET 0 0 6\n", "OFFSET 0 6 0\n");
    let (head, _) = lying.split_once("0 93 0 0").unwrap();
    let frame = "0 93 0 0 0 0  0 90 0 0 0 0 0 0 0 0 0 0  0 90 0 0 0 0 0 0 0  0 0 0 0 0 0\n";
    let (recording, findings) = read(&format!("{head}{frame}{frame}"), None);
    assert!(findings.has(Code::BvhRestPose), "{findings:?}");
    assert!(!read(FIGURE, None).1.has(Code::BvhRestPose));
    for (name, place) in [
        ("ankle_r", [0.0, 0.08, 0.09]),
        ("toe_r", [0.14, 0.02, 0.09]),
        ("toe_tip_r", [0.2, 0.02, 0.09]),
        ("pelvis_up", [0.0, 0.93 + POINT_DISTANCE_M, 0.0]),
        ("pelvis_front", [POINT_DISTANCE_M, 0.93, 0.0]),
        ("thigh_side_r", [0.0, 0.5, 0.09 + POINT_DISTANCE_M]),
        ("shank_side_l", [0.0, 0.08, POINT_DISTANCE_M - 0.09]),
        ("foot_front_r", [POINT_DISTANCE_M, 0.08, 0.09]),
        ("foot_side_r", [0.0, 0.08, 0.09 + POINT_DISTANCE_M]),
        ("toe_front_r", [0.14 + POINT_DISTANCE_M, 0.02, 0.09]),
        // A third of 0.2 m behind the ankle, as low as the ball.
        ("heel_r", [-0.2 / 3.0, 0.02, 0.09]),
    ] {
        assert_at(&recording, name, 0, place);
        assert_at(&read(FIGURE, None).0, name, 0, place);
    }
}

/// Straight legs along +z at rest, which hang down when the thighs turn by 90 degrees, and both arms along x.
const LYING: &str = "HIERARCHY
ROOT Hips
{
OFFSET 0 0 0
CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
JOINT RightUpLeg
{
OFFSET -9 0 0
CHANNELS 3 Zrotation Xrotation Yrotation
JOINT RightLeg
{
OFFSET 0 0 43
CHANNELS 3 Zrotation Xrotation Yrotation
JOINT RightFoot
{
OFFSET 0 0 42
CHANNELS 3 Zrotation Xrotation Yrotation
End Site
{
OFFSET 0 14 6
}
}
}
}
JOINT LeftUpLeg
{
OFFSET 9 0 0
CHANNELS 3 Zrotation Xrotation Yrotation
JOINT LeftLeg
{
OFFSET 0 0 43
CHANNELS 3 Zrotation Xrotation Yrotation
JOINT LeftFoot
{
OFFSET 0 0 42
CHANNELS 3 Zrotation Xrotation Yrotation
End Site
{
OFFSET 0 14 6
}
}
}
}
JOINT RightArm
{
OFFSET -17 50 0
CHANNELS 3 Zrotation Xrotation Yrotation
JOINT RightForeArm
{
OFFSET -28 0 0
CHANNELS 3 Zrotation Xrotation Yrotation
JOINT RightHand
{
OFFSET -25 0 0
CHANNELS 0
}
}
}
JOINT LeftArm
{
OFFSET 17 50 0
CHANNELS 3 Zrotation Xrotation Yrotation
JOINT LeftForeArm
{
OFFSET 28 0 0
CHANNELS 3 Zrotation Xrotation Yrotation
JOINT LeftHand
{
OFFSET 25 0 0
CHANNELS 0
}
}
}
}
MOTION
";

#[test]
fn a_t_or_a_pose_is_found_and_taken_for_upright_standing() {
    // One frame of a calibration pose with the arms lowered by an angle, then five with a bent knee.
    let text = |lowered: f64| {
        let frame = |thigh: f64, knee: f64, lowered: f64| {
            format!(
                "0 93 0 0 0 0  0 {thigh} 0 0 {knee} 0 0 0 0  0 {thigh} 0 0 {knee} 0 0 0 0  {lowered} 0 0 0 0 0  \
                 -{lowered} 0 0 0 0 0\n"
            )
        };
        let bent = frame(60.0, 60.0, 70.0).repeat(5);
        format!("{LYING}Frames: 6\nFrame Time: 0.5\n{}{bent}", frame(90.0, 0.0, lowered))
    };
    for (lowered, pose) in [(0.0, "the T-pose in frame 1"), (45.0, "the A-pose in frame 1")] {
        let (recording, findings) = read(&text(lowered), None);
        let said = findings.as_slice().iter().find(|finding| finding.code == Code::BvhRestPose).unwrap();
        assert!(said.message.contains(pose), "{said:?}");
        // The foot points forward along the floor in that pose; a mean posture would tilt it with the bent legs.
        assert_at(&recording, "foot_front_r", 0, [POINT_DISTANCE_M, 0.08, 0.09]);
        assert_at(&recording, "pelvis_up", 0, [0.0, 0.93 + POINT_DISTANCE_M, 0.0]);
    }
    // Hanging arms are no calibration pose.
    let said = read(&text(80.0), None).1;
    assert!(said.as_slice().iter().any(|finding| finding.message.contains("the mean posture")), "{said:?}");
}

#[test]
fn rotations_are_applied_in_the_order_of_the_channels() {
    let turned = FIGURE.replace("0 93 0 0 0 0  0 0 0 0 90", "0 93 0 0 0 0  0 90 90 0 0");
    let (recording, _) = read(&turned, None);
    // Z, then X, then Y: R = Rz(0) Rx(90) Ry(90); the thigh (0,-1,0) is unchanged by Ry and rotated backwards by Rx.
    assert_at(&recording, "knee_r", 1, [-0.43, 0.93, 0.09]);
    let other = turned.replace("CHANNELS 3 Zrotation Xrotation Yrotation", "CHANNELS 3 Xrotation Yrotation Zrotation");
    let (recording, _) = read(&other, None);
    // X 0, Y 90, Z 90: R = Ry(90) Rz(90); Rz turns (0,-1,0) to +x, Ry turns +x to -z: backwards again, by another
    // sequence.
    assert_at(&recording, "knee_r", 1, [-0.43, 0.93, 0.09]);
    let third = turned.replace("CHANNELS 3 Zrotation Xrotation Yrotation", "CHANNELS 3 Xrotation Zrotation Yrotation");
    let (recording, _) = read(&third, None);
    // X 0, Z 90, Y 90: R = Rz(90) Ry(90); the thigh goes to +x of the file, to the left.
    assert_at(&recording, "knee_r", 1, [0.0, 0.93, 0.09 - 0.43]);
}

#[test]
fn unit_and_axes_are_inferred_from_the_body() {
    for (unit, metres, name) in [(0.01, 1.0, "metres"), (10.0, 0.001, "millimetres"), (1.0 / 2.54, 0.0254, "inches")] {
        let (recording, _) = read(&scaled(unit), None);
        assert!(recording.statement.starts_with(&format!("lengths in {name} (")), "{}", recording.statement);
        assert!((recording.metres_per_unit - metres).abs() < 1e-12);
        let knee = recording.markers.marker("knee_r").unwrap().positions[0];
        assert!((knee - Vec3::new(0.0, 0.5, 0.09)).norm() < 1e-12, "{knee:?}");
    }
    // A unit of 3 cm is not usual; legs of 28.3 inches are plausible for 1.9 m, but the stated stature decides.
    let (recording, findings) = read(&scaled(1.0 / 3.0), Some(1.3));
    assert!(!findings.has(Code::BvhUnit) && recording.statement.contains("inches"), "{}", recording.statement);
    let (recording, findings) = read(&scaled(1.0 / 20.0), Some(1.7));
    assert!(findings.has(Code::BvhUnit) && recording.statement.contains("units of 0.19"), "{}", recording.statement);
    assert!((recording.height_m - 1.7).abs() < 1e-12);
    assert!(refused(&scaled(1.0 / 20.0)).contains("expected the stature"), "{}", refused(&scaled(1.0 / 20.0)));
}

/// The figure in another unit.
fn scaled(factor: f64) -> String {
    let number = |word: &str| word.parse::<f64>().map(|x| format!("{}", x * factor));
    let scale_places = |line: &str, count: usize| {
        let words: Vec<String> = line
            .split_whitespace()
            .enumerate()
            .map(|(k, word)| if k < count { number(word).unwrap_or(word.into()) } else { word.into() })
            .collect();
        words.join(" ")
    };
    let line = |line: &str| match line.trim() {
        offset if offset.starts_with("OFFSET") => scale_places(offset, 4),
        frame if frame.starts_with("0 93") => scale_places(frame, 3),
        other => other.to_owned(),
    };
    FIGURE.lines().map(line).collect::<Vec<_>>().join("\n")
}

#[test]
fn a_figure_with_z_up_gives_the_same_result() {
    // (x, y, z) -> (-x, z, y): z up, facing +y.
    let swap = |words: &[&str]| format!("{} {} {}", negative(words[0]), words[2], words[1]);
    let line = |line: &str| {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["OFFSET", ..] => format!("OFFSET {}", swap(&words[1..4])),
            ["0", "93", ..] => "0 0 93 ".to_owned() + &"0 ".repeat(words.len() - 3),
            _ => line.to_owned(),
        }
    };
    let (recording, _) = read(&FIGURE.lines().map(line).collect::<Vec<_>>().join("\n"), None);
    assert!(recording.statement.ends_with("+z up, facing along +y -> world x forward, y up, z right"));
    assert_at(&recording, "hip_r", 0, [0.0, 0.93, 0.09]);
    assert_at(&recording, "toe_r", 0, [0.14, 0.02, 0.09]);
    assert_at(&recording, "pelvis_front", 0, [POINT_DISTANCE_M, 0.93, 0.0]);
}

fn negative(word: &str) -> String {
    format!("{}", -word.parse::<f64>().unwrap())
}

#[test]
fn positions_of_a_joint_replace_its_offset_or_are_added_depending_on_their_values() {
    let six = |values: [&str; 2]| {
        let six = "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation";
        let (head, tail) = FIGURE.split_once("JOINT RightLeg").unwrap();
        let text = format!("{head}JOINT RightLeg{}", tail.replacen("CHANNELS 3 Zrotation Xrotation Yrotation", six, 1));
        let frame = |text: String, knee: &str, value: &str| {
            text.replacen(&format!("0 93 0 0 0 0  0 0 0 0 {knee}"), &format!("0 93 0 0 0 0  0 0 0 {value} 0 {knee}"), 1)
        };
        frame(frame(text, "0 0", values[0]), "90 0", values[1])
    };
    let (replaced, _) = read(&six(["0 -43 0", "0 -43 1"]), None);
    assert_at(&replaced, "knee_r", 0, [0.0, 0.5, 0.09]);
    assert_at(&replaced, "knee_r", 1, [0.01, 0.5, 0.09]);
    let (added, _) = read(&six(["0 0 0", "0 0 1"]), None);
    assert_at(&added, "knee_r", 0, [0.0, 0.5, 0.09]);
    assert_at(&added, "knee_r", 1, [0.01, 0.5, 0.09]);
}

#[test]
fn joint_names_of_many_programs_are_recognised() {
    let rename = |names: [&str; 8]| {
        let old = ["Hips", "RightUpLeg", "RightLeg", "RightFoot", "RightToeBase", "LeftUpLeg", "LeftLeg", "LeftFoot"];
        // By way of marks, because a new name may be the old one of another joint.
        let marked = old
            .iter()
            .enumerate()
            .fold(FIGURE.to_owned(), |text, (k, old)| text.replace(&format!(" {old}\n"), &format!(" joint {k}\n")));
        names
            .iter()
            .enumerate()
            .fold(marked, |text, (k, new)| text.replace(&format!(" joint {k}\n"), &format!(" {new}\n")))
    };
    let expected = ["hip_r", "knee_r", "ankle_r", "toe_r", "hip_l", "knee_l", "ankle_l"];
    for names in [
        [
            "mixamorig:Hips",
            "mixamorig:RightUpLeg",
            "mixamorig:RightLeg",
            "mixamorig:RightFoot",
            "mixamorig:RightToeBase",
            "mixamorig:LeftUpLeg",
            "mixamorig:LeftLeg",
            "mixamorig:LeftFoot",
        ],
        ["Hips", "RightHip", "RightKnee", "RightAnkle", "RightToe", "LeftHip", "LeftKnee", "LeftAnkle"],
        ["hip", "rThigh", "rShin", "rFoot", "rToe", "lThigh", "lShin", "lFoot"],
        ["pelvis", "thigh_r", "calf_r", "foot_r", "ball_r", "thigh_l", "calf_l", "foot_l"],
        ["hips", "thigh.R", "shin.R", "foot.R", "toe.R", "thigh.L", "shin.L", "foot.L"],
        ["Pelvis", "R_Hip", "R_Knee", "R_Ankle", "R_Foot", "L_Hip", "L_Knee", "L_Ankle"],
        ["Hips", "RHip", "RKnee", "RAnkle", "RToes", "LHip", "LKnee", "LAnkle"],
        // SOMA: where a shin exists, the leg is the thigh.
        ["Hips", "RightLeg", "RightShin", "RightFoot", "RightToeBase", "LeftLeg", "LeftShin", "LeftFoot"],
        // Rokoko.
        ["Hips", "RightThigh", "RightShin", "RightFoot", "RightToe", "LeftThigh", "LeftShin", "LeftFoot"],
        // Rigify: bones that deform, and control bones, below a root with another name.
        ["root", "DEF-thigh.R", "DEF-shin.R", "DEF-foot.R", "DEF-toe.R", "DEF-thigh.L", "DEF-shin.L", "DEF-foot.L"],
        ["root", "thigh_fk.R", "shin_fk.R", "foot_fk.R", "toe_fk.R", "thigh_fk.L", "shin_fk.L", "foot_fk.L"],
        // Mixamo without its colon, MotionBuilder with a namespace, the first names of CMU.
        [
            "mixamorigHips",
            "mixamorigRightUpLeg",
            "mixamorigRightLeg",
            "mixamorigRightFoot",
            "mixamorigRightToeBase",
            "mixamorigLeftUpLeg",
            "mixamorigLeftLeg",
            "mixamorigLeftFoot",
        ],
        [
            "Character1:Hips",
            "Character1:RightUpLeg",
            "Character1:RightLeg",
            "Character1:RightFoot",
            "Character1:RightToeBase",
            "Character1:LeftUpLeg",
            "Character1:LeftLeg",
            "Character1:LeftFoot",
        ],
        ["root", "rfemur", "rtibia", "rfoot", "rtoes", "lfemur", "ltibia", "lfoot"],
    ] {
        let (recording, _) = read(&rename(names), None);
        for name in expected {
            assert!(recording.markers.marker(name).is_some(), "{name} of {names:?}");
        }
        assert_at(&recording, "toe_r", 0, [0.14, 0.02, 0.09]);
    }
    // 3ds Max Biped: all names have the same prefix.
    let biped = rename([
        "Bip01",
        "Bip01 R Thigh",
        "Bip01 R Calf",
        "Bip01 R Foot",
        "Bip01 R Toe0",
        "Bip01 L Thigh",
        "Bip01 L Calf",
        "Bip01 L Foot",
    ]);
    let biped = biped.replace("RightShoulder", "Bip01 R Clavicle").replace("RightArm", "Bip01 R UpperArm");
    let (recording, _) = read(&biped, None);
    assert_at(&recording, "toe_r", 0, [0.14, 0.02, 0.09]);
    assert_at(&recording, "shoulder_r", 0, [0.0, 1.43, 0.17]);
}

#[test]
fn a_skeleton_that_is_not_a_person_is_rejected_with_its_joint_names() {
    let message = refused(&FIGURE.replace("LeftLeg", "Tail"));
    assert!(message.starts_with("no joint was recognised as left knee; expected the joints of both legs"), "{message}");
    assert!(message.contains("Found: Hips, RightUpLeg, RightLeg"), "{message}");
    let (bvh, _) = Bvh::read(FIGURE.split("Frames").next().unwrap().to_owned().as_bytes())
        .map_or_else(
            |_| Bvh::read(format!("{}Frames: 0\nFrame Time: 0.1\n", FIGURE.split("Frames").next().unwrap()).as_bytes()),
            Ok,
        )
        .unwrap();
    let error = skeleton_from_bvh(&bvh, "figure", None, &mut Findings::default()).unwrap_err();
    assert_eq!(error, SkeletonError::NoFrames);
    let flat = FIGURE.replace("OFFSET 0 -43 0", "OFFSET 0 0 0").replace("OFFSET 0 -42 0", "OFFSET 0 0 0");
    assert!(refused(&flat).contains("0 long together"), "{}", refused(&flat));
}

#[test]
fn missing_values_are_gaps() {
    let (recording, _) = read(&FIGURE.replace("0 0 0 0 90 0", "0 0 0 nan 90 0"), None);
    let seen = |name: &str, frame: usize| recording.markers.marker(name).unwrap().is_seen(frame);
    let all = [seen("ankle_r", 0), seen("knee_r", 1), seen("ankle_r", 1), seen("ankle_l", 1)];
    assert_eq!(all, [true, true, false, true]);
}

fn real(file: &str) -> Option<Bvh> {
    let path = shared_data::data()?.join("bvh").join(file);
    Some(Bvh::read(&std::fs::read(path).unwrap()).unwrap().0)
}

fn heights(recording: &SkeletonRecording, name: &str) -> Vec<f64> {
    let mut heights: Vec<f64> = recording.markers.marker(name).unwrap().positions.iter().map(|p| p.y).collect();
    heights.sort_by(f64::total_cmp);
    heights
}

#[test]
fn the_walk_in_a_figure_of_eight_is_a_person_of_usual_size_and_speed() {
    let Some(bvh) = real("AV_8Walk_Meredith_HVHA_Rep1.bvh") else { return };
    let mut findings = Findings::default();
    let recording = skeleton_from_bvh(&bvh, "walk", None, &mut findings).unwrap();
    let [hip, toe] = ["hip_r", "toe_r"].map(|name| heights(&recording, name));
    let path = &recording.markers.marker("hip_r").unwrap().positions;
    let level = |a: Vec3, b: Vec3| (a - b).xz().norm();
    // A tenth of a second between the points of the path, so that noise does not add to it.
    let way: f64 = path.iter().step_by(12).zip(path.iter().step_by(12).skip(1)).map(|(a, b)| level(*a, *b)).sum();
    let speed = way / (recording.markers.times.last().unwrap() - recording.markers.times[0]);
    println!("{}\n{findings:?}", recording.statement);
    println!(
        "stature {:.3} m, hip {:.3} m high, toe {:.3} m at its lowest, speed {speed:.3} m/s, {way:.2} m",
        recording.height_m,
        hip[hip.len() / 2],
        toe[0]
    );
    assert!(recording.statement.contains("inches") && recording.statement.contains("+y up"), "{}", recording.statement);
    assert!((1.5..1.9).contains(&recording.height_m));
    assert!((0.75..0.95).contains(&hip[hip.len() / 2]) && (-0.1..0.1).contains(&toe[0]));
    assert!((0.7..1.9).contains(&speed), "{speed}");
}

#[test]
fn the_jumps_of_the_cmu_database_are_in_its_unit_and_leave_the_ground() {
    let Some(bvh) = real("01_01.bvh") else { return };
    let mut findings = Findings::default();
    let recording = skeleton_from_bvh(&bvh, "jumps", None, &mut findings).unwrap();
    let toes = ["toe_tip_r", "toe_tip_l"].map(|name| heights(&recording, name));
    let lowest = (0..recording.markers.frames())
        .map(|frame| {
            ["toe_tip_r", "toe_tip_l", "ankle_r", "ankle_l"]
                .map(|name| recording.markers.marker(name).unwrap().positions[frame].y)
                .into_iter()
                .fold(f64::INFINITY, f64::min)
        })
        .fold(f64::NEG_INFINITY, f64::max);
    println!("{}\n{findings:?}", recording.statement);
    println!(
        "stature {:.3} m, lowest toe {:.3} {:.3} m, feet up to {lowest:.3} m in the air",
        recording.height_m, toes[0][0], toes[1][0]
    );
    assert!(
        recording.statement.contains("CMU units") && recording.statement.contains("+y up"),
        "{}",
        recording.statement
    );
    assert!((1.5..1.9).contains(&recording.height_m));
}
