//! Reading and writing skeletons in motion.

use ambulo_formats::bvh::{Bvh, Channel, ChannelKind, Joint, MAX_DEPTH, MAX_JOINTS};
use proptest::prelude::*;

const WALK: &str = "HIERARCHY\nROOT Hips\n{\n\tOFFSET 1.5 35 -4\n\
    \tCHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation\n\
    \tJOINT mixamorig:Left Up Leg\n\t{\n\t\tOFFSET 0 0 0\n\t\tCHANNELS 3 Yrotation Xrotation Zrotation\n\
    \t\tEnd Site\n\t\t{\n\t\t\tOFFSET 0 -17.5 1e-1\n\t\t}\n\t}\n\
    \tJOINT Spine\n\t{\n\t\tOFFSET 0 8.5 0\n\t\tCHANNELS 1 Zrotation\n\t}\n}\n\
    MOTION\nFrames: 2\nFrame Time: .0083333\n\
    9 35 -163 1 2 3 4 5 6 7\n9.5 35.25 -162 -1 -2 -3.5e-3 -4 -5 -6 -7\n";

fn read(text: &str) -> (Bvh, Vec<String>) {
    let (bvh, remarks) = Bvh::read(text.as_bytes()).unwrap();
    (bvh, remarks.iter().map(ToString::to_string).collect())
}

#[track_caller]
fn assert_is_walk(text: &str) {
    let (bvh, remarks) = read(text);
    assert_eq!(remarks, Vec::<String>::new());
    let names: Vec<_> = bvh.joints().iter().map(|joint| (joint.name.as_str(), joint.parent)).collect();
    assert_eq!(names, [("Hips", None), ("mixamorig:Left Up Leg", Some(0)), ("Spine", Some(0))]);
    assert_eq!(bvh.joints()[0].offset.map(f64::to_bits), [1.5, 35.0, -4.0].map(f64::to_bits));
    assert_eq!(bvh.joints()[1].end_sites, [[0.0, -17.5, 0.1]]);
    assert_eq!((bvh.channels(), bvh.frames()), (10, 2));
    assert_eq!(bvh.frame_time_s().to_bits(), 0.008_333_3_f64.to_bits());
    assert_eq!(bvh.frame(1).unwrap(), [9.5, 35.25, -162.0, -1.0, -2.0, -0.0035, -4.0, -5.0, -6.0, -7.0]);
    assert_eq!(bvh.frame(2), None);
}

#[test]
fn a_file_is_read_with_joints_behind_their_parents_and_channels_in_its_own_order() {
    assert_is_walk(WALK);
    let (bvh, _) = read(WALK);
    let words = |joint: usize| bvh.joints()[joint].channels.iter().map(|c| c.word()).collect::<Vec<_>>().join(" ");
    assert_eq!(words(0), "Xposition Yposition Zposition Zrotation Yrotation Xrotation");
    assert_eq!((words(1), words(2)), ("Yrotation Xrotation Zrotation".into(), "Zrotation".into()));
    assert_eq!(bvh.channel_ranges(), [0..6, 6..9, 9..10]);
    assert_eq!((bvh.joint("Spine"), bvh.joint("spine")), (Some(2), None));
}

#[test]
fn case_white_space_and_line_ends_make_no_difference() {
    assert_is_walk(&WALK.replace('\n', "\r\n"));
    assert_is_walk(&WALK.replace('\n', "\r"));
    assert_is_walk(&WALK.replace('\t', "    "));
    assert_is_walk(&WALK.replace('\n', " \t\n\n"));
    assert_is_walk(&WALK.replace("\n\t{", " {").replace("\n{", " {").replace("Hips {", "Hips{"));
    assert_is_walk(&WALK.replace("{\n", "{ ").replace("\n\t\t\t", " "));
    assert_is_walk(&format!("\u{feff}{}", WALK.trim_end()));
    let mixed = WALK.replace("HIERARCHY", "Hierarchy").replace("JOINT", "Joint").replace("ROOT", "root");
    let mixed = mixed.replace("OFFSET", "Offset").replace("CHANNELS", "Channels").replace("rotation", "ROTATION");
    assert_is_walk(&mixed.replace("End Site", "END SITE").replace("MOTION", "Motion").replace("Frames", "FRAMES"));
    assert_is_walk(&WALK.replace("Frames: 2", "Frames:2").replace("Time: .", "Time:."));
    assert_is_walk(&WALK.replace("Frames: 2", "Frames 2").replace("Time: .", "Time : ."));
    assert_is_walk(&WALK.replace("End Site", "End Site toe").replace(" 2\n", "\t2\n"));
    assert_is_walk(&WALK.replace("9 35 -163 1", "  9\t35  -163 1"));
}

#[test]
fn several_roots_joints_without_channels_and_several_end_sites_are_read() {
    let text = "HIERARCHY\nROOT \
        a\n{\nOFFSET 0 0 0\nCHANNELS 0\nEnd Site\n{\nOFFSET 1 0 0\n}\nEnd Site\n{\nOFFSET 2 0 0\n}\n}\n\
        ROOT b\n{\nOFFSET 0 0 0\nJOINT c\n{\nCHANNELS 1 Xrotation\nOFFSET 1 2 3\n}\n}\nMOTION\nFrames: 1\nFrame Time: \
        1\n7\n";
    let (bvh, remarks) = read(text);
    assert_eq!(remarks, Vec::<String>::new());
    let parents: Vec<_> = bvh.joints().iter().map(|joint| joint.parent).collect();
    assert_eq!(parents, [None, None, Some(1)]);
    assert_eq!(bvh.joints()[0].end_sites, [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]);
    assert_eq!((bvh.joints()[2].offset, bvh.frame(0)), ([1.0, 2.0, 3.0], Some(&[7.0][..])));
}

#[test]
fn frame_counts_that_disagree_with_the_data_are_remarked() {
    let (bvh, remarks) = read(&WALK.replace("Frames: 2", "Frames: 5"));
    assert_eq!((bvh.frames(), remarks), (2, vec!["`Frames:` states 5, the file has 2; read 2".into()]));
    let (bvh, remarks) = read(&WALK.replace("Frames: 2", "Frames: 1"));
    assert_eq!((bvh.frames(), remarks), (2, vec!["`Frames:` states 1, the file has 2; read 2".into()]));
    let (_, remarks) = read(WALK.replace("Frames: 2", "Frames: 3").trim_end());
    let cut = "the last line has no line end, so its last number may be truncated";
    assert_eq!(remarks, [format!("`Frames:` states 3, the file has 2; read 2; {cut}")]);
}

#[test]
fn a_skeleton_without_frames_is_a_skeleton() {
    let head = &WALK[..WALK.find("9 35").unwrap()];
    let (bvh, remarks) = read(&head.replace("Frames: 2", "Frames: 0"));
    assert_eq!((bvh.frames(), bvh.joints().len(), remarks.len()), (0, 3, 0));
    assert_eq!(bvh.frame(0), None);
}

#[test]
fn names_that_stand_twice_and_values_not_seen_are_remarked() {
    let (_, remarks) = read(&WALK.replace("Spine", "Hips"));
    assert_eq!(remarks, ["two or more joints have the same name (first: `Hips`)"]);
    let (bvh, remarks) = read(&WALK.replace("9 35 -163", "9 nan -nan(ind)"));
    assert_eq!(remarks, ["line 24: 2 values not-a-number; kept as missing"]);
    assert!(bvh.frame(0).unwrap()[1].is_nan());
}

fn joint(name: &str, parent: Option<usize>) -> Joint {
    let channels = vec![Channel { kind: ChannelKind::Rotation, axis: 0 }];
    Joint { name: name.into(), parent, offset: [0.0; 3], channels, end_sites: vec![] }
}

#[test]
fn a_motion_in_memory_must_be_whole() {
    let error = |joints: Vec<Joint>, time, frames: &[Vec<f64>]| Bvh::new(joints, time, frames).unwrap_err().to_string();
    let start = "not a valid record: found";
    assert_eq!(error(vec![], 1.0, &[]), format!("{start} 0 joints; expected 1 to {MAX_JOINTS}"));
    let one = || vec![joint("a", None)];
    assert_eq!(error(one(), 0.0, &[]), format!("{start} a frame time of 0 s; expected a finite time above zero"));
    assert_eq!(error(one(), 1.0, &[vec![]]), format!("{start} a frame of 0 values; expected 1, one per channel"));
    let numbers = "expected numbers, or not-a-number for missing values";
    assert_eq!(error(one(), 1.0, &[vec![f64::INFINITY]]), format!("{start} an infinite value; {numbers}"));
    let behind = "expected each joint directly before its children";
    let late = vec![joint("a", None), joint("b", Some(0)), joint("c", Some(0)), joint("d", Some(1))];
    assert_eq!(error(late, 1.0, &[]), format!("{start} joint `d` before its parent; {behind}"));
    assert_eq!(error(vec![joint("a", Some(0))], 1.0, &[]), format!("{start} joint `a` before its parent; {behind}"));
    assert_eq!(
        error(vec![joint("a{", None)], 1.0, &[]),
        format!("{start} the name `a{{`; expected a name without braces")
    );
    let deep = (0..=MAX_DEPTH).map(|k| joint("a", k.checked_sub(1))).collect();
    assert_eq!(
        error(deep, 1.0, &[]),
        format!("{start} joint `a` nested too deeply; expected at most {MAX_DEPTH} deep")
    );
    let mut twice = one();
    twice[0].channels = vec![Channel::ALL[0]; 2];
    let none_twice = "expected positions and rotations in x, y, z, all different";
    assert_eq!(error(twice, 1.0, &[]), format!("{start} the channels of `a`; {none_twice}"));
    let mut far = one();
    far[0].end_sites = vec![[f64::NAN; 3]];
    assert_eq!(error(far, 1.0, &[]), format!("{start} an offset of `a` that is not finite; expected finite offsets"));
    let mut still = one();
    still[0].channels = vec![];
    assert_eq!(
        error(still, 1.0, &[vec![]]),
        format!("{start} frames without a channel; expected no frames, or joints with channels")
    );
}

/// Parents by how many of the open joints are closed before the next one begins; all closed makes a root.
fn parents(closed: &[usize]) -> Vec<Option<usize>> {
    let mut open: Vec<usize> = Vec::new();
    let parent = |(index, &closed): (usize, &usize)| {
        open.truncate(open.len().saturating_sub(closed));
        let parent = open.last().copied();
        open.push(index);
        parent
    };
    closed.iter().enumerate().map(parent).collect()
}

fn any_joint() -> impl Strategy<Value = Joint> {
    let number = || prop::num::f64::NORMAL | prop::num::f64::ZERO | prop::num::f64::SUBNORMAL;
    let place = move || prop::array::uniform3(number());
    let channels = prop::sample::subsequence(Channel::ALL.to_vec(), 0..=6).prop_shuffle();
    let name = "[A-Za-z:_.0-9]([A-Za-z:_. 0-9]{0,8}[A-Za-z:_0-9])?";
    (name, place(), channels, prop::collection::vec(place(), 0..3))
        .prop_map(|(name, offset, channels, end_sites)| Joint { name, parent: None, offset, channels, end_sites })
}

fn any_bvh() -> impl Strategy<Value = Bvh> {
    let skeleton = prop::collection::vec((any_joint(), 0..4_usize), 1..8).prop_map(|made| {
        let (mut joints, closed): (Vec<Joint>, Vec<usize>) = made.into_iter().unzip();
        joints.iter_mut().zip(parents(&closed)).for_each(|(joint, parent)| joint.parent = parent);
        joints
    });
    let value = || prop_oneof![8 => prop::num::f64::NORMAL, 1 => Just(0.0), 1 => Just(f64::NAN)];
    (skeleton, 1e-4..1e3_f64, 0..4_usize).prop_flat_map(move |(joints, time, frames)| {
        let width = joints.iter().map(|joint| joint.channels.len()).sum::<usize>();
        let frames = if width == 0 { 0 } else { frames };
        let rows = prop::collection::vec(prop::collection::vec(value(), width), frames);
        rows.prop_map(move |rows| Bvh::new(joints.clone(), time, &rows).unwrap())
    })
}

fn bits(bvh: &Bvh) -> Vec<u64> {
    let values = (0..bvh.frames()).flat_map(|k| bvh.frame(k).unwrap().to_vec());
    values.map(|value| if value.is_nan() { f64::NAN.to_bits() } else { value.to_bits() }).collect()
}

proptest! {
    #[test]
    fn what_is_written_reads_back_to_the_same_bits(bvh in any_bvh()) {
        let (again, remarks) = Bvh::read(&bvh.write()).unwrap();
        prop_assert!(remarks.iter().all(|remark| !remark.message.contains("states")), "{:?}", remarks);
        prop_assert_eq!(again.joints(), bvh.joints());
        prop_assert_eq!(again.frame_time_s().to_bits(), bvh.frame_time_s().to_bits());
        prop_assert_eq!(bits(&again), bits(&bvh));
        prop_assert_eq!(again.write(), bvh.write());
    }
}
