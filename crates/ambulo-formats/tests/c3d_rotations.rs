//! Poses of segments in C3D files: a file of Theia3D, made ones, and damaged ones.

use crate::shared_data::data;
use ambulo_formats::c3d::{C3d, Channel, Encoding, Parameter, Point, Processor, Rotation, Storage, Values};

/// A matrix with a different number in each place of its rotation and translation.
fn matrix(seed: f64) -> [[f64; 4]; 4] {
    let row = |i: f64| [seed + i, seed + i + 0.25, seed + i + 0.5, seed + i + 0.75];
    [row(1.0), row(2.0), row(3.0), [0.0, 0.0, 0.0, 1.0]]
}

/// Two segments with two poses per frame, one point and one channel.
fn sample() -> C3d {
    let mut record = C3d::new(50.0, "mm");
    record.points = vec![Point::new("HEEL", vec![[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]])];
    record.analog_rate_hz = 100.0;
    record.channels = vec![Channel::new("FZ", "N", vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0])];
    record.rotation_rate_hz = 100.0;
    let thigh = (0..6).map(|k| matrix(8.0 * f64::from(k))).collect();
    let mut shank: Vec<[[f64; 4]; 4]> = (0..6).map(|k| matrix(100.0 + 8.0 * f64::from(k))).collect();
    shank[4] = [[f64::NAN; 4]; 4];
    record.rotations = vec![Rotation::new("l_thigh_4X4", thigh), Rotation::new("l_shank_4X4", shank)];
    record.rotations[0].description = "thigh".into();
    record
}

/// Equal to the bit; not-a-number as itself.
#[track_caller]
fn assert_same(a: &C3d, b: &C3d) {
    let content = |record: &C3d| format!("{:?}{:?}{:?}", record.points, record.channels, record.rotations);
    assert_eq!(content(a), content(b));
    assert_eq!((a.frames(), a.rotations_per_frame()), (b.frames(), b.rotations_per_frame()));
}

#[track_caller]
fn again(record: &C3d) -> C3d {
    let (again, remarks) = C3d::read(&record.write().unwrap()).unwrap();
    assert_eq!(remarks, []);
    again
}

#[test]
fn poses_beside_points_and_channels_are_read_back_in_every_encoding() {
    for processor in Processor::ALL {
        for storage in [Storage::Integer, Storage::Real] {
            let encoding = Encoding { processor, storage, point_scale: 0.5, unsigned_analog: false };
            let record = C3d { encoding, ..sample() };
            assert_same(&record, &again(&record));
        }
    }
}

#[test]
fn a_file_with_poses_alone_has_their_frames() {
    let record = C3d { points: vec![], channels: vec![], analog_rate_hz: 0.0, ..sample() };
    assert_eq!((record.frames(), record.rotations_per_frame()), (3, 2));
    let read = again(&record);
    assert_same(&record, &read);
    assert!(!read.rotations[1].is_seen(4) && read.rotations[1].is_seen(3) && !read.rotations[1].is_seen(6));
}

#[test]
fn a_pose_with_negative_reliability_or_without_rotation_is_missing() {
    let mut record = sample();
    record.rotations[0].reliability[2] = -1.0;
    record.rotations[1].matrices[0] = [[0.0, 0.0, 0.0, 5.0], [0.0; 4], [0.0; 4], [0.0, 0.0, 0.0, 1.0]];
    let (read, _) = C3d::read(&record.write().unwrap()).unwrap();
    let seen = |rotation: &Rotation| (0..6).filter(|&sample| rotation.is_seen(sample)).collect::<Vec<_>>();
    assert_eq!(seen(&read.rotations[0]), [0, 1, 3, 4, 5]);
    assert_eq!(seen(&read.rotations[1]), [1, 2, 3, 5]);
}

/// The file of a record in which a parameter of the group ROTATION was changed.
fn with_parameter(name: &str, value: i16) -> Vec<u8> {
    let bytes = sample().write().unwrap();
    let key = [&[name.len() as u8, group_id(&bytes)][..], name.as_bytes()].concat();
    let place = bytes.windows(key.len()).position(|window| window == key).unwrap() + key.len();
    let mut changed = bytes;
    // Offset of the next parameter, type, number of dimensions, value.
    changed[place + 4..place + 6].copy_from_slice(&value.to_le_bytes());
    changed
}

/// Number of the group ROTATION: the byte after the length of its name, negative.
fn group_id(bytes: &[u8]) -> u8 {
    let place = bytes.windows(8).position(|window| window == b"ROTATION").unwrap();
    bytes[place - 1].cast_signed().wrapping_neg().cast_unsigned()
}

#[test]
fn a_section_outside_of_the_file_is_named_and_left_out() {
    for (block, shown) in [(0, "0"), (1, "1"), (9000, "9000")] {
        let (read, remarks) = C3d::read(&with_parameter("DATA_START", block)).unwrap();
        assert!(read.rotations.is_empty() && read.points.len() == 1);
        let wanted = format!(
            "ROTATION:USED is 2, but ROTATION:DATA_START is {shown}, which is no block of the file; the rotations were \
             not read"
        );
        assert!(remarks.iter().any(|remark| remark.message == wanted), "{remarks:?}");
    }
}

#[test]
fn a_contradicting_number_of_frames_is_remarked() {
    let (read, remarks) = C3d::read(&with_parameter("FRAMES", 5)).unwrap();
    assert_same(&sample(), &read);
    let wanted = "ROTATION:FRAMES is 5, but the points have 3 frames with 2 samples each; read 6";
    assert!(remarks.iter().any(|remark| remark.message == wanted), "{remarks:?}");
}

#[test]
fn a_truncated_section_has_missing_poses_at_its_end() {
    let mut record = sample();
    let many = |first: f64| (0..600).map(|k| matrix(first + f64::from(k))).collect::<Vec<_>>();
    record.points = vec![Point::new("HEEL", vec![[1.0, 2.0, 3.0]; 300])];
    record.channels = vec![];
    record.rotations = vec![Rotation::new("a", many(0.0)), Rotation::new("b", many(1.0))];
    let bytes = record.write().unwrap();
    let (read, remarks) = C3d::read(&bytes[..bytes.len() - 20 * 1024]).unwrap();
    assert_eq!((read.frames(), read.rotations[0].matrices.len()), (300, 600));
    assert!(read.rotations[0].is_seen(400) && !read.rotations[0].is_seen(599));
    assert!(
        remarks.iter().any(|remark| remark.message.contains("of 600 samples; the file is truncated")),
        "{remarks:?}"
    );
    let (read, remarks) = C3d::read(&bytes[..bytes.len() - 60 * 1024]).unwrap();
    assert!(read.rotations.is_empty());
    assert!(remarks.iter().any(|remark| remark.message.ends_with("they were not read")), "{remarks:?}");
}

#[test]
fn a_file_cut_at_any_byte_is_read_or_refused() {
    let bytes = sample().write().unwrap();
    for length in 0..bytes.len() {
        if let Ok((read, _)) = C3d::read(&bytes[..length]) {
            assert!(read.rotations.iter().all(|r| r.matrices.len() == r.reliability.len()), "{length}");
        }
    }
}

#[test]
fn poses_that_do_not_fit_the_frames_are_not_written() {
    let mut record = sample();
    record.rotations[1].matrices.pop();
    let error = record.write().unwrap_err().to_string();
    let wanted = "not a valid record: found [5, 6] matrices and reliabilities of segment `l_shank_4X4`; expected 6 of \
        each, 2 for each frame";
    assert_eq!(error, wanted);
    let record = C3d { rotation_rate_hz: 75.0, ..sample() };
    let error = record.write().unwrap_err().to_string();
    assert!(error.contains("75 poses and 50 frames per second"), "{error}");
}

#[test]
fn rotations_that_were_removed_leave_no_count_behind() {
    let record = C3d { rotations: vec![], rotation_rate_hz: 0.0, ..again(&sample()) };
    let read = again(&record);
    assert_eq!((read.rotations.len(), read.parameters.count("ROTATION", "USED")), (0, Some(0)));
}

#[test]
fn theia3d_writes_a_pose_of_21_segments_in_340_frames() {
    let Some(folder) = data() else { return };
    let bytes = std::fs::read(folder.join("markerless-theia/C3DRotationExample.c3d")).unwrap();
    let (record, remarks) = C3d::read(&bytes).unwrap();
    assert_eq!(remarks, []);
    assert_eq!((record.frames(), record.rotations.len(), record.points.len()), (340, 21, 0));
    assert!((record.rotation_rate_hz - 85.0).abs() < 1e-9);
    let thigh = record.rotations.iter().find(|rotation| rotation.name == "l_thigh_4X4").unwrap();
    let seen: Vec<usize> = (0..340).filter(|&sample| thigh.is_seen(sample)).collect();
    assert_eq!((seen.len(), seen[0], seen[334]), (335, 1, 335));
    // Orthonormal axes, to the rounding of 24-bit reals, and the knee on the long axis of the thigh.
    let knee = &record.rotations.iter().find(|rotation| rotation.name == "l_shank_4X4").unwrap().matrices;
    for sample in seen {
        let m = thigh.matrices[sample];
        for (a, b, product) in [(0, 0, 1.0), (1, 1, 1.0), (0, 1, 0.0), (1, 2, 0.0)] {
            let dot: f64 = (0..3).map(|row| m[row][a] * m[row][b]).sum();
            assert!((dot - product).abs() < 1e-5, "{sample}: {dot}");
        }
        let way: Vec<f64> = (0..3).map(|row| knee[sample][row][3] - m[row][3]).collect();
        let along: f64 = (0..3).map(|row| m[row][2] * way[row]).sum();
        assert!((along + 417.7).abs() < 0.1, "{sample}: {along} mm");
    }
    assert_same(&record, &again(&record));
}

#[test]
fn a_rate_that_is_the_only_statement_gives_the_samples_per_frame() {
    let mut record = sample();
    let used = Parameter::single("USED", Values::Integers(vec![2]));
    record.parameters.set("ROTATION", used);
    let bytes = record.write().unwrap();
    // RATIO gets a name that nothing reads.
    let key = [&[5u8, group_id(&bytes)][..], b"RATIO"].concat();
    let place = bytes.windows(key.len()).position(|window| window == key).unwrap() + 2;
    let mut renamed = bytes;
    renamed[place..place + 5].copy_from_slice(b"OTHER");
    let (read, remarks) = C3d::read(&renamed).unwrap();
    assert_eq!((read.rotations_per_frame(), remarks), (2, vec![]));
}
