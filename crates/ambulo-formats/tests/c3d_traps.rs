//! C3D files that deviate from the description of the format: one hand-made file per deviation.

use crate::c3d_bytes::File;
use ambulo_formats::Error;
use ambulo_formats::c3d::{C3d, EventPlace, Processor, Storage, Values};

#[track_caller]
fn read(file: &File) -> (C3d, Vec<String>) {
    let (record, remarks) = C3d::read(&file.bytes()).unwrap();
    (record, remarks.iter().map(ToString::to_string).collect())
}

#[track_caller]
fn refused(file: &File) -> String {
    C3d::read(&file.bytes()).unwrap_err().to_string()
}

#[track_caller]
fn assert_close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() < 1e-9 || (a.is_nan() && b.is_nan()), "{found:?} {expected:?}");
    }
}

/// All channels one after the other.
fn samples(record: &C3d) -> Vec<f64> {
    record.channels.iter().flat_map(|channel| channel.samples.iter().copied()).collect()
}

#[test]
fn the_fourth_word_of_real_files_is_sixteen_bits_in_a_real() {
    // 0: filtered; 258: camera 1, residual 2; 32738: seven cameras, residual 226; 32769: camera 8, residual 1;
    // -1 and 65535: not seen; 1.7e38: the word 0x7F00 in the upper half of the real's bits.
    let seven_cameras = f32::from_bits(0x7F00_0000);
    let (record, remarks) = read(&File::with_words(&[0.0, 258.0, 32738.0, 32769.0, -1.0, 65535.0, seven_cameras]));
    let point = &record.points[0];
    let nan = f64::NAN;
    assert_close(&point.residuals, &[0.0, 1.0, 113.0, 0.5, nan, nan, 0.0]);
    assert_eq!(point.cameras, [0, 1, 0x7F, 0x80, 0, 0, 0x7F]);
    assert_close(&point.positions.iter().map(|p| p[1]).collect::<Vec<_>>(), &[2.0, 2.0, 2.0, 2.0, nan, nan, 2.0]);
    assert_eq!(remarks, ["1 of 1 points have no name in POINT:LABELS; they were named *n"]);
    assert_eq!(point.name, "*1");
}

#[test]
fn points_at_no_number_are_not_seen() {
    let mut file = File::new(1, 3, 0, 0, -1.0);
    file.reals(&[f32::NAN, 2.0, 3.0, 0.0]).reals(&[1.0, f32::INFINITY, 3.0, 0.0]).reals(&[1.0, 2.0, 3.0, f32::NAN]);
    let (record, _) = read(&file);
    assert!(record.points[0].positions.iter().flatten().all(|value| value.is_nan()));
}

#[test]
fn integer_points_have_a_scale_and_a_sign_in_the_fourth_word() {
    let mut file = File::new(1, 3, 0, 0, 0.5);
    file.integers(&[10, -20, 30, 0x0302]).integers(&[1, 1, 1, -1]).integers(&[4, 4, 4, 0x7F01]);
    let (record, _) = read(&file);
    let point = &record.points[0];
    assert_eq!(record.encoding.storage, Storage::Integer);
    assert_close(&point.positions[0], &[5.0, -10.0, 15.0]);
    assert!(point.positions[1][0].is_nan());
    assert_close(&point.residuals, &[1.0, f64::NAN, 0.5]);
    assert_eq!(point.cameras, [3, 0, 0x7F]);
}

#[test]
fn frames_beyond_16_bits_come_from_the_group_trial() {
    // 70000 frames of one point in integers, from frame 5 to 70004 = 1 * 65536 + 4468.
    let mut file = File::new(1, 65535, 0, 0, 1.0);
    file.word(4, 5);
    file.integer(3, "ACTUAL_START_FIELD", &[2], &[5, 0]).integer(3, "ACTUAL_END_FIELD", &[2], &[4468, 1]);
    file.texts(1, "LABELS", &["HEEL"]);
    for frame in 0..70_000 {
        file.integers(&[(frame % 30_000) as i16, 0, 0, 0]);
    }
    let (record, remarks) = read(&file);
    assert_eq!((record.frames(), record.first_frame), (70_000, 5));
    assert_close(&record.points[0].positions[69_999], &[9_999.0, 0.0, 0.0]);
    assert!((record.times()[69_999] - 700.03).abs() < 1e-9);
    assert_eq!(remarks, Vec::<String>::new());
}

#[test]
fn frames_beyond_16_bits_come_from_long_frames_or_a_real() {
    for name in ["LONG_FRAMES", "FRAMES"] {
        let mut file = File::new(1, 65535, 0, 0, 1.0);
        file.texts(1, "LABELS", &["HEEL"]).float(1, name, &[], &[66_000.0]);
        file.integers(&vec![0; 4 * 66_000]);
        let (record, remarks) = read(&file);
        assert_eq!((record.frames(), remarks), (66_000, vec![]), "{name}");
    }
}

#[test]
fn a_first_frame_beyond_16_bits_is_believed_without_a_remark() {
    // Frames 70001 and 70002, of which the header has the lower 16 bits.
    let mut file = File::new(1, 2, 0, 0, -1.0);
    file.word(4, 4465).word(5, 4466).texts(1, "LABELS", &["HEEL"]);
    file.integer(3, "ACTUAL_START_FIELD", &[2], &[4465, 1]).integer(3, "ACTUAL_END_FIELD", &[2], &[4466, 1]);
    file.reals(&[0.0; 8]);
    let (record, remarks) = read(&file);
    assert_eq!((record.first_frame, record.frames(), remarks), (70_001, 2, vec![]));
}

#[test]
fn a_first_frame_is_taken_from_whoever_counts_the_frames_right() {
    // Two frames; the header states 5 to 6, the group TRIAL 7 to 8, or 7 to 90.
    for (last, first, told) in [(8, 7, "7 was used"), (90, 5, "5 was used")] {
        let mut file = File::new(1, 2, 0, 0, -1.0);
        file.word(4, 5).word(5, 6).texts(1, "LABELS", &["HEEL"]).reals(&[0.0; 8]);
        file.integer(3, "ACTUAL_START_FIELD", &[2], &[7, 0]).integer(3, "ACTUAL_END_FIELD", &[2], &[last, 0]);
        let (record, remarks) = read(&file);
        assert_eq!((record.first_frame, record.frames()), (first, 2));
        assert!(remarks.iter().any(|remark| remark.ends_with(told)), "{remarks:?}");
    }
}

#[test]
fn a_general_scale_of_zero_is_not_believed() {
    let mut file = File::new(0, 1, 1, 1, -1.0);
    file.texts(2, "LABELS", &["A"]).float(2, "SCALE", &[1], &[2.0]).integer(2, "OFFSET", &[1], &[0]);
    file.float(2, "GEN_SCALE", &[], &[0.0]).reals(&[3.0]);
    let (record, remarks) = read(&file);
    assert_close(&samples(&record), &[6.0]);
    assert_eq!(remarks, ["ANALOG:GEN_SCALE is 0; 1 is taken"]);
}

#[test]
fn names_may_be_filled_up_with_zeros() {
    let mut file = File::with_words(&[0.0]);
    file.record("UNITS\0\0", 1, &[0xFF, 1, 2, b'm', b'm', 0]);
    assert_eq!(read(&file).0.point_unit, "mm");
}

#[test]
fn frame_counts_in_conflict_are_decided_by_the_size_of_the_file() {
    // Header 300, POINT:FRAMES 200; the data fill 200 frames, or 300.
    for (frames, other) in [(200, 300), (300, 200)] {
        let mut file = File::new(1, 300, 0, 0, -1.0);
        file.texts(1, "LABELS", &["HEEL"]).integer(1, "FRAMES", &[], &[200]);
        file.reals(&vec![0.0; 4 * frames]);
        let (record, remarks) = read(&file);
        assert_eq!(record.frames(), frames, "not {other}");
        let room = (4 * 4 * frames).next_multiple_of(512) / 16;
        let said = format!(
            "number of frames: 300 by the header, 200 by POINT:FRAMES; the file has room for {room}; read {frames}"
        );
        assert_eq!(remarks, [said]);
    }
}

#[test]
fn truncated_data_are_told_and_the_frames_that_are_there_are_read() {
    let mut file = File::new(2, 10, 0, 0, -1.0);
    file.padded = false;
    file.texts(1, "LABELS", &["HEEL", "TOE"]).reals(&[7.0; 8 * 6 + 3]);
    let (record, remarks) = read(&file);
    assert_eq!(record.frames(), 6);
    assert_close(&record.points[1].positions[5], &[7.0; 3]);
    assert_eq!(remarks, ["10 frames are stated, but the file ends after 6; it is truncated; read 6"]);
}

#[test]
fn without_a_frame_only_names_count() {
    let mut file = File::new(60_000, 9, 60_000, 1, -1.0);
    file.texts(1, "LABELS", &["HEEL", "TOE"]);
    let (record, remarks) = read(&file);
    assert_eq!((record.points.len(), record.channels.len(), record.frames()), (2, 0, 0));
    assert_eq!(remarks[0], "9 frames are stated, but the file ends after 0; it is truncated; read 0");
}

#[test]
fn bytes_after_the_last_frame_are_told() {
    let mut file = File::new(1, 2, 0, 0, -1.0);
    file.texts(1, "LABELS", &["HEEL"]).reals(&[0.0; 8]).reals(&[1.0; 4 * 40]);
    let (record, remarks) = read(&file);
    assert_eq!((record.frames(), remarks), (2, vec!["992 bytes follow the last frame; they were not read".to_owned()]));
}

#[test]
fn a_file_of_analog_channels_alone_keeps_its_frames() {
    let mut file = File::new(0, 3, 2, 2, -1.0);
    file.integer(2, "USED", &[], &[2]).texts(2, "LABELS", &["FX", "FZ"]).float(2, "SCALE", &[2], &[2.0, 1.0]);
    file.integer(2, "OFFSET", &[2], &[1, 0]).float(2, "GEN_SCALE", &[], &[0.5]);
    for frame in 0..3 {
        let n = 10.0 * frame as f32;
        file.reals(&[n, n + 1.0, n + 2.0, n + 3.0]);
    }
    let (record, remarks) = read(&file);
    assert_eq!((record.frames(), record.samples_per_frame(), record.analog_rate_hz), (3, 2, 200.0));
    assert_close(&record.channels[0].samples, &[-1.0, 1.0, 9.0, 11.0, 19.0, 21.0]);
    assert_close(&record.channel("FZ").unwrap().samples, &[0.5, 1.5, 5.5, 6.5, 10.5, 11.5]);
    assert_close(&record.analog_times()[..3], &[0.0, 0.005, 0.01]);
    assert_eq!(remarks, Vec::<String>::new());
}

#[test]
fn samples_without_sign_have_an_offset_without_sign() {
    let mut file = File::new(0, 1, 2, 1, 1.0);
    file.integer(2, "USED", &[], &[2]).texts(2, "LABELS", &["A", "B"]).float(2, "SCALE", &[2], &[1.0, 1.0]);
    file.integer(2, "OFFSET", &[2], &[32767, -32768]).integers(&[-32768, 32767]);
    // Raw 32768 - 32767 = 1 and 32767 - 32768 = -1; with signs it would be -65535 and 65535.
    let (record, remarks) = read(&file);
    assert_close(&samples(&record), &[1.0, -1.0]);
    assert_eq!(
        remarks,
        ["ANALOG:OFFSET is 32767 and ANALOG:FORMAT is missing; samples and offsets were read as unsigned"]
    );
    let (record, remarks) = read(file.clone().texts(2, "FORMAT", &["UNSIGNED"]));
    assert_close(&samples(&record), &[1.0, -1.0]);
    assert_eq!((record.encoding.unsigned_analog, remarks), (true, vec![]));
    let (record, _) = read(file.clone().texts(2, "FORMAT", &["SIGNED"]));
    assert_close(&samples(&record), &[-65535.0, 65535.0]);
}

#[test]
fn missing_parameters_are_remarks() {
    let mut file = File::new(1, 1, 2, 1, -1.0);
    file.reals(&[1.0, 2.0, 3.0, 0.0, 4.0, 5.0]);
    let (record, remarks) = read(&file);
    assert_eq!(record.point_unit, "");
    assert_eq!(record.metres_per_unit(), None);
    assert_close(&samples(&record), &[4.0, 5.0]);
    assert_eq!(record.platforms().unwrap(), []);
    let expected = [
        "POINT:RATE is 0; the header's rate of 100 Hz was used",
        "1 of 1 points have no name in POINT:LABELS; they were named *n",
        "ANALOG:LABELS has 0 values for 2 channels; the rest were named *n",
        "ANALOG:SCALE has 0 values for 2 channels; 1 was used for the rest",
        "ANALOG:OFFSET has 0 values for 2 channels; 0 was used for the rest",
    ];
    // A rate in the header alone is enough; a parameter that cannot be used is told.
    assert_eq!(remarks, expected[1..]);
    let (_, remarks) = read(file.clone().float(1, "RATE", &[], &[0.0]));
    assert_eq!(remarks, expected);
    assert_eq!(
        refused(file.clone().float(1, "RATE", &[], &[0.0]).real(11, 0.0)),
        "parameter POINT:RATE: found 0 and 0 in the header; expected a frame rate above zero"
    );
}

#[test]
fn of_three_stated_rates_the_two_that_agree_are_used_and_the_third_is_named() {
    // The header states 100 frames per second, and 2 samples per frame.
    for (parameter, analog, used, words) in [
        (125.0, Some(200.0), 100.0, "the header's rate was used, because ANALOG:RATE agrees with it"),
        (125.0, Some(250.0), 125.0, "POINT:RATE was used, because ANALOG:RATE agrees with it"),
        (125.0, None, 125.0, "but the header states 100 frames per second; POINT:RATE was used"),
        (100.0, Some(250.0), 100.0, "ANALOG:RATE is 250 Hz, but a frame has 2 samples; 200 Hz was used"),
    ] {
        let mut file = File::new(1, 1, 1, 2, -1.0);
        file.reals(&[1.0, 2.0, 3.0, 0.0, 4.0, 5.0]).float(1, "RATE", &[], &[parameter]);
        if let Some(analog) = analog {
            file.float(2, "RATE", &[], &[analog]);
        }
        let (record, remarks) = C3d::read(&file.bytes()).unwrap();
        let of_clock: Vec<&str> =
            remarks.iter().filter(|remark| remark.is_about_clock).map(|remark| remark.message.as_str()).collect();
        assert!(of_clock.len() == 1 && of_clock[0].contains(words), "{remarks:?}");
        assert_close(&[record.point_rate_hz], &[used]);
    }
    let mut file = File::new(1, 1, 1, 2, -1.0);
    file.reals(&[1.0, 2.0, 3.0, 0.0, 4.0, 5.0]).float(1, "RATE", &[], &[100.04]).float(2, "RATE", &[], &[200.0]);
    let (_, remarks) = C3d::read(&file.bytes()).unwrap();
    assert!(remarks.iter().all(|remark| !remark.is_about_clock), "rounding: {remarks:?}");
}

#[test]
fn more_than_255_points_and_channels_have_their_names_in_several_lists() {
    let names: Vec<String> = (1..=600).map(|n| format!("P{n}")).collect();
    let words: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut file = File::new(300, 1, 300, 1, -1.0);
    file.integer(1, "USED", &[], &[300]).integer(2, "USED", &[], &[300]);
    file.texts(1, "LABELS", &words[..255]).texts(1, "LABELS2", &words[255..300]);
    file.texts(2, "LABELS", &words[300..555]).texts(2, "LABELS2", &words[555..]);
    file.float(2, "SCALE", &[255], &[2.0; 255]).float(2, "SCALE2", &[45], &[3.0; 45]);
    file.integer(2, "OFFSET", &[255], &[0; 255]).integer(2, "OFFSET2", &[45], &[0; 45]);
    file.reals(&[1.0; 1200 + 300]);
    let (record, remarks) = read(&file);
    assert_eq!((record.points[255].name.as_str(), record.channels[299].name.as_str()), ("P256", "P600"));
    assert_close(&[record.channels[254].samples[0], record.channels[255].samples[0]], &[2.0, 3.0]);
    assert_eq!(remarks, Vec::<String>::new());
}

#[test]
fn analog_counts_in_conflict_are_decided_by_the_size_of_the_file() {
    // ANALOG:USED states 2 channels; the header counts 3 values a frame. Frames of 2 channels fill the file.
    let mut file = File::new(0, 200, 3, 1, -1.0);
    file.integer(2, "USED", &[], &[2]).texts(2, "LABELS", &["A", "B"]);
    file.float(2, "SCALE", &[2], &[1.0; 2]).integer(2, "OFFSET", &[2], &[0; 2]).reals(&[1.0; 400]);
    let (record, remarks) = read(&file);
    assert_eq!((record.channels.len(), record.frames()), (2, 200));
    let said =
        "the header has 3 analog values per frame, 1 per channel; ANALOG:USED is 2; read 2 channels with 1 per frame";
    assert_eq!(remarks, [said]);
}

#[test]
fn platforms_are_read_from_bytes_short_lists_and_wide_channel_tables() {
    let mut file = File::new(0, 1, 12, 1, -1.0);
    file.integer(2, "USED", &[], &[12]).texts(2, "LABELS", &["A"; 12]).float(2, "SCALE", &[12], &[1.0; 12]);
    file.integer(2, "OFFSET", &[12], &[0; 12]).reals(&[0.0; 12]);
    // USED as a byte; a channel table of shape [6, 3] for two platforms; a 6 x 6 matrix for the first alone.
    file.parameter(4, "USED", 1, &[], &[2]).integer(4, "TYPE", &[2], &[4, 2]);
    let corners: Vec<f32> = (0..24).map(|n| n as f32).collect();
    file.float(4, "CORNERS", &[3, 4, 2], &corners).float(4, "ORIGIN", &[3, 2], &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    let channels: Vec<i16> = (1..=12).chain([0; 6]).collect();
    file.integer(4, "CHANNEL", &[6, 3], &channels).integer(4, "ZERO", &[2], &[1, 10]);
    let matrix: Vec<f32> = (0..36).map(|n| n as f32).collect();
    file.float(4, "CAL_MATRIX", &[6, 6, 1], &matrix);
    let (record, _) = read(&file);
    let platforms = record.platforms().unwrap();
    assert_eq!(platforms.iter().map(|platform| platform.kind).collect::<Vec<_>>(), [4, 2]);
    assert_close(&platforms[1].corners[1], &[15.0, 16.0, 17.0]);
    assert_close(&platforms[1].origin, &[4.0, 5.0, 6.0]);
    assert_eq!(platforms[1].channels, (6..12).map(Some).collect::<Vec<_>>());
    // By columns in the file: the second value is in the second row.
    assert_close(&platforms[0].calibration[1], &[1.0, 7.0, 13.0, 19.0, 25.0, 31.0]);
    assert!(platforms[1].calibration.is_empty());
    assert_eq!(platforms[0].zero_frames, Some([1, 10]));
}

#[test]
fn platforms_of_every_type_have_their_channels_and_matrices() {
    for (kind, channels, shape) in [(1, 6, [6, 6]), (3, 8, [0, 0]), (5, 8, [6, 8]), (6, 12, [12, 12]), (7, 8, [8, 8])] {
        let mut file = File::new(0, 1, 12, 1, -1.0);
        file.reals(&[0.0; 12]).integer(4, "USED", &[], &[1]).integer(4, "TYPE", &[1], &[kind]);
        file.float(4, "CORNERS", &[3, 4, 1], &[0.0; 12]).float(4, "ORIGIN", &[3, 1], &[0.0; 3]);
        let numbers: Vec<i16> = (1..=12).collect();
        file.integer(4, "CHANNEL", &[12, 1], &numbers);
        let values: Vec<f32> = (0..shape[0] * shape[1]).map(|n| n as f32).collect();
        // Without a third dimension: there is one platform.
        file.float(4, "CAL_MATRIX", &shape.map(|n| n as u8), &values);
        let platform = read(&file).0.platforms().unwrap().remove(0);
        assert_eq!((platform.kind, platform.channels.len()), (kind as u8, channels));
        assert_eq!(platform.calibration.len(), shape[0]);
        for (row, values) in platform.calibration.iter().enumerate() {
            let by_columns: Vec<f64> = (0..shape[1]).map(|column| (row + shape[0] * column) as f64).collect();
            assert_close(values, &by_columns);
        }
    }
}

#[test]
fn platforms_that_the_file_does_not_describe_are_errors() {
    let mut file = File::new(0, 1, 1, 1, -1.0);
    file.reals(&[0.0]).integer(4, "USED", &[], &[1]).integer(4, "TYPE", &[1], &[2]);
    let error = |file: &File| read(file).0.platforms().unwrap_err().to_string();
    assert_eq!(error(&file), "parameter FORCE_PLATFORM:CORNERS: found nothing; expected its values for every platform");
    file.float(4, "CORNERS", &[3, 4, 1], &[0.0; 12]).float(4, "ORIGIN", &[3, 1], &[0.0; 3]);
    let channels = |numbers: &[i16]| {
        let mut file = file.clone();
        file.integer(4, "CHANNEL", &[numbers.len() as u8, 1], numbers);
        file
    };
    assert_eq!(
        error(&channels(&[1, 2])),
        "parameter FORCE_PLATFORM:CHANNEL: found channel 2; expected 1 to 1, the channels of the file"
    );
    let (record, _) = read(&channels(&[0, 1, 0, 0, 0, 0, 0, 0]));
    assert_eq!(record.platforms().unwrap()[0].channels, [None, Some(0), None, None, None, None]);
    assert_eq!(
        error(file.clone().integer(4, "TYPE", &[0], &[]).integer(4, "USED", &[], &[2])),
        "parameter FORCE_PLATFORM:CHANNEL: found nothing; expected numbers of channels"
    );
}

#[test]
fn events_have_minutes_seconds_and_sides() {
    let mut file = File::with_words(&[0.0]);
    file.word(4, 11).word(5, 11).integer(5, "USED", &[], &[2]).texts(5, "LABELS", &["Foot Strike", "Foot Off"]);
    file.texts(5, "CONTEXTS", &["Left", "Right"]).float(5, "TIMES", &[2, 2], &[0.0, 1.5, 2.0, 3.25]);
    file.word(150, 12345).word(151, 1).real(153, 0.25).header[376] = 1;
    file.header[396..400].copy_from_slice(b"RHS ");
    let (record, _) = read(&file);
    let told: Vec<_> = record.events.iter().map(|e| (e.label.as_str(), e.context.as_str(), e.place, e.flag)).collect();
    let (group, header) = (EventPlace::Group, EventPlace::Header);
    assert_eq!(told, [("Foot Strike", "Left", group, 0), ("Foot Off", "Right", group, 0), ("RHS", "", header, 1)]);
    // The header's times begin with the file, which begins with frame 11 at 0.1 s.
    assert_close(&record.events.iter().map(|event| event.time_s).collect::<Vec<_>>(), &[1.5, 123.25, 0.35]);
}

#[test]
fn more_events_than_times_is_a_remark() {
    let mut file = File::with_words(&[0.0]);
    file.texts(1, "LABELS", &["HEEL"]).integer(5, "USED", &[], &[3]).float(5, "TIMES", &[2, 1], &[0.0, 1.5]);
    let (record, remarks) = read(&file);
    assert_eq!(record.events.len(), 1);
    assert_eq!(remarks, ["EVENT:USED is 3, but EVENT:TIMES has 1 events, which were read"]);
}

#[test]
fn locked_groups_orphans_and_parameters_before_their_group_are_read() {
    let mut file = File::with_words(&[0.0]);
    file.texts(1, "LABELS", &["HEEL"]);
    file.linked(-4, b"MINE", 7, 2 + 3 + 1, &[1, 0, 42, 0]);
    file.integer(9, "LOST", &[], &[5]);
    file.linked(-5, b"MAKER", -7, 3, &[0]);
    let (record, remarks) = read(&file);
    assert_eq!(remarks, ["group 9 has parameters (`LOST`) but no name"]);
    let group = record.parameters.group("maker").unwrap();
    assert!(group.locked && group.parameters[0].locked);
    assert_eq!(group.get("Mine").unwrap().values, Values::Bytes(vec![42]));
    assert_eq!(record.parameters.number("", "LOST"), Some(5.0));
}

#[test]
fn the_chain_of_parameters_ends_with_an_offset_of_zero() {
    let mut file = File::with_words(&[0.0]);
    file.linked(6, b"LABELS", 1, 0, &[0xFF, 1, 1, b'H', 0]);
    let (record, remarks) = read(&file);
    assert_eq!((record.points[0].name.as_str(), remarks.len()), ("H", 0));
}

#[test]
fn a_chain_without_an_end_is_told() {
    let mut file = File::with_words(&[0.0]);
    file.texts(1, "LABELS", &["HEEL"]);
    let used = file.records.len() + 4;
    let rest = (512 - used % 512) as u16;
    // A last record that takes all the room that is left.
    let body = vec![0; usize::from(rest) - 2 - 1 - 2];
    file.linked(1, b"X", -8, body.len() as u16 + 2, &body);
    let mut bytes = file.bytes();
    bytes[514] -= 1; // one block less: without the block that the builder added for the closing zero
    bytes.drain(1024..1536);
    bytes[16] -= 1;
    let (_, remarks) = C3d::read(&bytes).unwrap();
    let said = "the parameter section ends at byte 1024 without the zero that should close it";
    assert_eq!(remarks.iter().map(ToString::to_string).collect::<Vec<_>>(), [said]);
}

#[test]
fn damaged_records_are_refused_with_place_and_reason() {
    let start = File::with_words(&[0.0]);
    let at = 512 + 4 + start.records.len();
    let damaged = |change: fn(&mut File) -> &mut File| {
        let mut file = start.clone();
        change(&mut file);
        refused(&file)
    };
    assert_eq!(
        damaged(|file| file.linked(4, b"RATE", 1, 60_000, &[4, 0])),
        format!(
            "byte {at}: found `RATE`, whose record extends to byte {}; expected records within the parameter section, \
             which ends at byte 1024; it is damaged",
            at + 6 + 60_000
        )
    );
    assert_eq!(
        damaged(|file| file.linked(4, b"RATE", 1, 12, &[3, 0, 0, 0, 0, 0, 0, 0, 0, 0])),
        format!("byte {}: found `RATE` of type 3; expected type -1 (text), 1 (byte), 2 (integer) or 4 (real)", at + 10)
    );
    assert_eq!(
        damaged(|file| file.linked(4, b"RATE", 1, 8, &[4, 2, 255, 255, 0, 0])),
        format!(
            "byte {}: found `RATE` of shape [255, 255] in a record with 2 bytes left; \
             expected as many values as the record has room for",
            at + 12
        )
    );
    assert_eq!(
        damaged(|file| file.linked(4, b"RATE", 0, 3, &[0])),
        format!(
            "byte {}: found `RATE` in group 0; expected groups numbered from 1; the parameter section is damaged",
            at + 1
        )
    );
}

#[test]
fn empty_texts_take_no_memory() {
    let mut file = File::with_words(&[0.0]);
    file.parameter(1, "NAMES", -1, &[0, 255, 255, 255, 255], &[]);
    assert!(refused(&file).contains("`NAMES` of shape [0, 255, 255, 255, 255]"));
    let mut file = File::with_words(&[0.0]);
    file.parameter(1, "NAMES", -1, &[0, 3], &[]);
    assert_eq!(read(&file).0.parameters.texts("POINT", "NAMES"), ["", "", ""]);
}

#[test]
fn texts_are_utf_8_or_latin_1_without_blanks_at_their_end() {
    let mut file = File::with_words(&[0.0]);
    file.parameter(1, "LABELS", -1, &[4, 1], b"H\xE9  ").parameter(1, "UNITS", -1, &[4], b"mm\0\0");
    let (record, _) = read(&file);
    assert_eq!((record.points[0].name.as_str(), record.point_unit.as_str()), ("Hé", "mm"));
    assert_eq!(record.metres_per_unit(), Some(1e-3));
}

#[test]
fn scales_in_conflict_are_decided_by_the_size_of_the_file() {
    // 100 frames of one point as integers (800 bytes) or reals (1600 bytes); header states reals, POINT:SCALE integers.
    for (storage, bytes) in [(Storage::Integer, 800), (Storage::Real, 1600)] {
        let mut file = File::new(1, 100, 0, 0, -0.5);
        file.texts(1, "LABELS", &["HEEL"]).float(1, "SCALE", &[], &[0.25]);
        file.data = vec![0; bytes];
        let (record, remarks) = read(&file);
        assert_eq!((record.encoding.storage, record.frames()), (storage, 100));
        let said = "POINT:SCALE is 0.25, the header's scale -0.5: one means integers, the other reals; read as";
        assert_eq!(remarks, [format!("{said} {storage:?} numbers")]);
    }
}

#[test]
fn data_blocks_in_conflict_or_without_sense_are_remarks() {
    let mut file = File::with_words(&[0.0]);
    file.texts(1, "LABELS", &["HEEL"]).integer(1, "DATA_START", &[], &[90]);
    let (record, remarks) = read(&file);
    assert_close(&record.points[0].positions[0], &[1.0, 2.0, 3.0]);
    assert_eq!(remarks, ["the data begin in block 3 (header) or 90 (POINT:DATA_START); read from 3"]);
    let mut bytes = File::with_words(&[0.0]).texts(1, "LABELS", &["HEEL"]).bytes();
    bytes[16] = 0;
    let (record, remarks) = C3d::read(&bytes).unwrap();
    assert_close(&record.points[0].positions[0], &[1.0, 2.0, 3.0]);
    assert_eq!(remarks[0].to_string(), "the data cannot begin in block 0; read from the end of the parameters");
}

#[test]
fn an_unknown_processor_is_guessed_and_told() {
    let mut bytes = File::with_words(&[0.0]).bytes();
    bytes[515] = 1;
    let (record, remarks) = C3d::read(&bytes).unwrap();
    assert_eq!(record.encoding.processor, Processor::Intel);
    assert_eq!(remarks[0].to_string(), "byte 515: processor 1 is not 84, 85 or 86; read as Intel");
}

#[test]
fn other_files_are_refused() {
    let error = |bytes: &[u8]| C3d::read(bytes).unwrap_err().to_string();
    assert_eq!(error(b""), "the file is empty; expected a C3D file, whose second byte is the key 80 (0x50)");
    assert_eq!(
        error(b"Path\t4"),
        "byte 1: found key 97; expected the key 80 (0x50) of a C3D file; the file may have another format"
    );
    assert_eq!(error(&[2, 80, 0]), "the file ends after 3 bytes; expected a header of 512 bytes. Is it truncated?");
    let mut bytes = File::with_words(&[0.0]).bytes();
    bytes[0] = 1;
    assert!(matches!(C3d::read(&bytes), Err(Error::Byte { offset: 0, .. })));
}

#[test]
fn a_record_whose_length_is_in_the_other_byte_order_is_read_and_named() {
    let texts = [&[(-1_i8).cast_unsigned(), 2, 2, 2][..], b"abcd", &[0]].concat();
    let offset = texts.len() as u16 + 2;
    let with = |offset: u16, body: &[u8]| {
        let mut file = File::with_words(&[0.0]);
        file.group("MADE", 5).linked(4, b"TEXT", 5, offset, body).texts(5, "LAST", &["end"]);
        read(&file)
    };
    let (right, none) = with(offset, &texts);
    let (swapped, remarks) = with(offset.swap_bytes(), &texts);
    assert_eq!(swapped.parameters, right.parameters);
    assert_eq!(remarks.len(), none.len() + 1, "{remarks:?}");
    let said = remarks.iter().find(|remark| remark.contains("`TEXT`")).unwrap();
    assert!(said.contains(&format!("states {} bytes and has {offset}", offset.swap_bytes())), "{said}");
}

#[test]
fn the_case_of_a_swapped_length_has_the_points_of_the_whole_recording() {
    let Some(folder) = crate::shared_data::data() else { return };
    let read = |name: &str| C3d::read(&std::fs::read(folder.join(name)).unwrap()).unwrap();
    let (found, remarks) = read("cases/mips-record-with-swapped-length/walk.c3d");
    let (whole, _) = read("c3d-format-variants/Eb015si.c3d");
    let positions = |c3d: &C3d| -> Vec<u64> {
        c3d.points.iter().flat_map(|point| point.positions.as_flattened()).map(|x| x.to_bits()).collect()
    };
    assert_eq!(positions(&found), positions(&whole));
    assert!(remarks.iter().any(|remark| remark.message.contains("in the other byte order")), "{remarks:?}");
}
