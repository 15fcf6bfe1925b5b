//! Damaged C3D files: cut at every byte of header and parameters, bytes changed at random, counts without measure.

use crate::c3d_bytes::File;
use crate::shared_data::data;
use ambulo_formats::c3d::{C3d, Channel, Event, Point};
use proptest::prelude::*;

/// A small recording with all groups: two points, two channels, a platform, events.
fn sample() -> File {
    let mut file = File::new(2, 3, 2, 2, -0.1);
    file.integer(1, "USED", &[], &[2]).integer(1, "FRAMES", &[], &[3]).float(1, "RATE", &[], &[100.0]);
    file.float(1, "SCALE", &[], &[-0.1]).texts(1, "LABELS", &["HEEL", "TOE"]).texts(1, "UNITS", &["mm"]);
    file.integer(2, "USED", &[], &[2]).texts(2, "LABELS", &["FX", "FZ"]).texts(2, "UNITS", &["N", "N"]);
    file.float(2, "SCALE", &[2], &[1.0; 2]).integer(2, "OFFSET", &[2], &[0; 2]).float(2, "RATE", &[], &[200.0]);
    file.integer(4, "USED", &[], &[1]).integer(4, "TYPE", &[1], &[2]).float(4, "CORNERS", &[3, 4, 1], &[0.0; 12]);
    file.float(4, "ORIGIN", &[3, 1], &[0.0; 3]).integer(4, "CHANNEL", &[6, 1], &[1, 2, 1, 1, 1, 1]);
    file.integer(5, "USED", &[], &[1]).texts(5, "LABELS", &["Foot Strike"]).float(5, "TIMES", &[2, 1], &[0.0, 0.5]);
    for _ in 0..3 {
        file.reals(&[1.0, 2.0, 3.0, 258.0, 4.0, 5.0, 6.0, -1.0, 0.5, 0.25, 0.125, 1.0]);
    }
    file
}

/// Reads and uses everything; the record may not be larger than a file of this size allows.
fn use_all(bytes: &[u8]) {
    let Ok((record, _)) = C3d::read(bytes) else { return };
    let values = |record: &C3d| {
        let points = 4 * record.points.len() * record.frames();
        points + record.channels.iter().map(|channel| channel.samples.len()).sum::<usize>()
    };
    assert!(values(&record) <= bytes.len() / 2, "{} values in {} bytes", values(&record), bytes.len());
    let _ = (record.platforms(), record.times(), record.analog_times(), record.metres_per_unit());
    if let Ok(written) = record.write() {
        let (again, _) = C3d::read(&written).unwrap();
        assert_eq!((again.points.len(), again.channels.len()), (record.points.len(), record.channels.len()));
    }
}

#[test]
fn the_sample_is_read_without_a_remark() {
    let (record, remarks) = C3d::read(&sample().bytes()).unwrap();
    assert_eq!((record.frames(), remarks.len()), (3, 0));
    assert_eq!(record.platforms().unwrap().len(), 1);
}

#[test]
fn a_file_cut_within_header_or_parameters_is_refused_and_later_keeps_whole_frames() {
    let mut file = sample();
    file.padded = false;
    let bytes = file.bytes();
    let data = bytes.len() - 3 * 48;
    let closing = 516 + file.records.len();
    for length in 0..bytes.len() {
        let read = C3d::read(&bytes[..length]);
        if length <= closing {
            let message = read.unwrap_err().to_string();
            assert!(
                message.contains("the file ends after") || message.contains("empty") || length == 1,
                "{length}: {message}"
            );
        } else {
            let (record, remarks) = read.unwrap();
            assert_eq!(record.frames(), length.saturating_sub(data) / 48, "{length}");
            assert!(remarks.iter().any(|remark| remark.to_string().contains("truncated")), "{length}");
        }
    }
}

#[test]
fn every_real_recording_survives_being_cut_in_header_and_parameters() {
    let Some(folder) = data() else { return };
    let names = ["Eb015pi.c3d", "Eb015vr.c3d", "Eb015si.c3d", "TYPE-2.C3D", "FP1.C3D", "bad_parameter_section.c3d"];
    for name in names {
        let bytes = std::fs::read(folder.join("c3d-format-variants").join(name)).unwrap();
        let data = 512 * usize::from(bytes[17].max(bytes[16]));
        for length in 0..data.min(bytes.len()) {
            let _ = C3d::read(&bytes[..length]);
        }
    }
}

/// Reading as much as these files announce would take hours and more memory than there is.
#[test]
fn counts_without_measure_are_not_believed() {
    let mut file = sample();
    for word in [2, 3, 4, 5, 9, 10] {
        let mut damaged = file.clone();
        damaged.word(word, 65535);
        use_all(&damaged.bytes());
    }
    file.word(2, 65535).word(3, 65535).word(5, 65535).word(10, 1);
    file.integer(3, "ACTUAL_START_FIELD", &[2], &[0, 0]).integer(3, "ACTUAL_END_FIELD", &[2], &[-1, -1]);
    use_all(&file.bytes());
    let mut file = sample();
    file.float(1, "FRAMES", &[], &[1e30]).float(1, "LONG_FRAMES", &[], &[2e9]).integer(5, "USED", &[], &[-1]);
    file.integer(4, "USED", &[], &[-1]);
    use_all(&file.bytes());
}

/// A file made by the crate's own writer.
fn written(points: usize, frames: usize) -> Vec<u8> {
    let mut record = C3d::new(50.0, "m");
    let point = |n: usize| Point::new(&format!("P{n}"), (0..frames).map(|f| [f as f64, n as f64, 1.0]).collect());
    record.points = (0..points).map(point).collect();
    record.analog_rate_hz = 100.0;
    record.channels = vec![Channel::new("FZ", "N", (0..2 * frames).map(|s| s as f64).collect())];
    record.events = vec![Event::new("Foot Off", "Left", 0.5)];
    record.write().unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn changed_bytes_never_panic(changes in prop::collection::vec((0usize..2560, any::<u8>()), 1..8)) {
        let mut bytes = sample().bytes();
        for (at, value) in changes {
            let length = bytes.len();
            bytes[at % length] = value;
        }
        use_all(&bytes);
    }

    #[test]
    fn random_parameters_never_panic(noise in prop::collection::vec(any::<u8>(), 0..1500)) {
        let mut file = sample();
        file.records.extend(noise);
        use_all(&file.bytes());
    }

    #[test]
    fn written_files_with_changed_bytes_never_panic(
        points in 0usize..4, frames in 0usize..5, cut in 0usize..4096, at in 0usize..4096, value in any::<u8>()
    ) {
        let mut bytes = written(points, frames);
        let length = bytes.len();
        bytes[at % length] = value;
        bytes.truncate(cut.max(600));
        use_all(&bytes);
    }
}
