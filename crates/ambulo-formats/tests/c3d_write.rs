//! C3D files written and read back: real recordings, hand-made ones, random ones.

use crate::shared_data::data;
use ambulo_formats::c3d::{
    C3d, Channel, Encoding, Event, EventPlace, Group, Parameter, Parameters, Platform, Point, Processor, Storage,
    Values,
};
use proptest::prelude::*;

/// All of a record but its parameters, to the bit: `Debug` prints every digit, and not-a-number as itself. Only the
/// sign of zero is dropped, which neither VAX nor integers have.
fn content(record: &C3d) -> String {
    let mut record = record.clone();
    record.parameters = Parameters::default();
    let positions = record.points.iter_mut().flat_map(|point| point.positions.as_flattened_mut());
    positions
        .chain(record.channels.iter_mut().flat_map(|channel| &mut channel.samples))
        .for_each(|value| *value += 0.0);
    format!("{record:?}")
}

#[track_caller]
fn assert_same(a: &C3d, b: &C3d, what: &str) {
    let (a, b) = (content(a), content(b));
    let place = a.bytes().zip(b.bytes()).position(|(x, y)| x != y).unwrap_or(a.len().min(b.len()));
    let around = |text: &str| text.chars().skip(place.saturating_sub(60)).take(120).collect::<String>();
    assert!(a == b, "{what}: {} differs from {}", around(&a), around(&b));
}

/// Parameters that repeat the record or describe the file, and are made anew.
const MADE_ANEW: [&str; 5] = ["POINT", "ANALOG", "EVENT", "TRIAL", ""];

fn others(record: &C3d) -> Vec<&Group> {
    record.parameters.groups.iter().filter(|group| !MADE_ANEW.contains(&group.name.as_str())).collect()
}

#[track_caller]
fn again(record: &C3d) -> C3d {
    let (again, remarks) = C3d::read(&record.write().unwrap()).unwrap();
    assert_eq!(remarks, []);
    again
}

/// A walk of two points with one that was lost, two channels and a platform.
fn sample() -> C3d {
    let mut record = C3d::new(100.0, "mm");
    record.first_frame = 12;
    let nan = f64::NAN;
    let mut heel = Point::new("HEEL", vec![[1.0, -2.0, 3.5], [nan; 3], [7.0, 8.0, 9.0]]);
    heel.description = "behind".into();
    heel.residuals[0] = 0.5;
    heel.cameras[0] = 5;
    record.encoding.point_scale = 0.25;
    record.points = vec![heel, Point::new("TOE", vec![[0.0; 3], [0.25; 3], [-0.5; 3]])];
    record.analog_rate_hz = 200.0;
    record.channels = vec![
        Channel::new("FX", "N", vec![0.5, 1.5, 2.5, 3.5, 4.5, 5.5]),
        Channel { scale: -0.5, offset: 2048.0, ..Channel::new("FZ", "N", vec![0.0, -1.5, -700.0, 3.5, 4.5, 5.0]) },
    ];
    record.events = vec![
        Event::new("Foot Strike", "Left", 0.25),
        Event { icon: 2, flag: 1, subject: "A".into(), ..Event::new("Foot Off", "Right", 75.5) },
        Event { place: EventPlace::Header, flag: 1, ..Event::new("RHS", "", 0.125 + 0.11) },
    ];
    record.set_platforms(&[platform()]);
    record
}

fn platform() -> Platform {
    Platform {
        kind: 4,
        corners: [[400.0, 600.0, 0.0], [0.0, 600.0, 0.0], [0.0; 3], [400.0, 0.0, 0.0]],
        origin: [0.5, -0.25, -40.0],
        channels: vec![Some(0), None, Some(1), None, None, None],
        calibration: (0..6).map(|row| (0..6).map(|column| f64::from(10 * row + column)).collect()).collect(),
        zero_frames: Some([1, 10]),
    }
}

#[test]
fn a_recording_made_in_memory_reads_back_the_same() {
    let record = sample();
    let again = again(&record);
    assert_same(&again, &record, "read back");
    assert_eq!(again.platforms().unwrap(), [platform()]);
    assert_eq!(again.parameters.text("EVENT", "LABELS"), Some("Foot Strike"));
    assert_eq!(again.write().unwrap(), record.write().unwrap());
}

#[test]
fn every_processor_and_storage_holds_the_same_recording() {
    for processor in Processor::ALL {
        for storage in [Storage::Integer, Storage::Real] {
            let mut record = sample();
            record.encoding = Encoding { processor, storage, ..record.encoding };
            // Integers hold whole steps: the first channel gets a scale that does.
            record.channels[0].scale = 0.5;
            assert_same(&again(&record), &record, &format!("{processor:?} {storage:?}"));
        }
    }
}

#[test]
fn the_bytes_are_those_of_the_format() {
    let bytes = sample().write().unwrap();
    let word = |number: usize| u16::from_le_bytes([bytes[2 * number - 2], bytes[2 * number - 1]]);
    assert_eq!(bytes[..2], [2, 0x50]);
    assert_eq!([2, 3, 4, 5, 6, 10].map(word), [2, 4, 12, 14, 0, 2]);
    let data = 512 * (usize::from(word(9)) - 1);
    assert_eq!(bytes[512 + 2], (data / 512 - 1) as u8, "blocks of parameters");
    assert_eq!(bytes[512 + 3], 84);
    let real = |at: usize| *bytes[data + 4 * at..].first_chunk().unwrap();
    let bytes_of = |values: [f32; 4]| values.map(f32::to_le_bytes);
    // HEEL with cameras 1 and 3 and a residual of two steps, then TOE, then two samples of two channels.
    assert_eq!([0, 1, 2, 3].map(real), bytes_of([1.0, -2.0, 3.5, 5.0 * 256.0 + 2.0]));
    assert_eq!([8, 9, 10, 11].map(real), bytes_of([0.5, 2048.0, 1.5, 2051.0]));
    // The lost point of the second frame.
    assert_eq!([12, 13, 14, 15].map(real), bytes_of([0.0, 0.0, 0.0, -1.0]));
    assert_eq!(bytes.len() % 512, 0);
}

#[test]
fn recordings_of_others_read_back_the_same_in_every_encoding() {
    let Some(folder) = data() else { return };
    let names = [
        "biomechzoo-HC032A/HC032A03.c3d",
        "btkdata-pig-adult3plates/PiG_Motion3_FF.c3d",
        "btkdata-pig-adult3plates/PiG_Calibration3_FF.c3d",
        "c3d-format-variants/Eb015pi.c3d",
        "c3d-format-variants/Eb015vr.c3d",
        "c3d-format-variants/Eb015si.c3d",
        "c3d-format-variants/FP1.C3D",
        "c3d-format-variants/TYPE-3.c3d",
        "c3d-format-variants/type-4a.c3d",
    ];
    for name in names {
        let bytes = std::fs::read(folder.join(name)).unwrap();
        let (record, _) = C3d::read(&bytes).unwrap();
        for processor in Processor::ALL {
            let mut record = record.clone();
            record.encoding.processor = processor;
            let again = again(&record);
            assert_same(&again, &record, &format!("{name} {processor:?}"));
            assert_eq!(others(&again), others(&record), "{name} {processor:?}");
            assert_eq!(again.platforms(), record.platforms(), "{name} {processor:?}");
        }
    }
}

#[test]
fn more_than_255_points_channels_and_events_are_written_in_lists() {
    let mut record = C3d::new(100.0, "mm");
    record.points = (0..600).map(|n| Point::new(&format!("P{n}"), vec![[f64::from(n), 0.0, 1.0]])).collect();
    record.analog_rate_hz = 100.0;
    record.channels = (0..300).map(|n| Channel::new(&format!("C{n}"), "V", vec![f64::from(n)])).collect();
    record.events = (0..300).map(|n| Event::new("Foot Off", "Left", f64::from(n))).collect();
    let first = again(&record);
    assert_same(&first, &record, "read back");
    assert!(first.parameters.get("POINT", "LABELS3").is_some() && first.parameters.get("EVENT", "TIMES2").is_some());
    // Lists that are no longer needed are taken out.
    let mut fewer = first.clone();
    fewer.points.truncate(2);
    fewer.events.truncate(2);
    let fewer = again(&fewer);
    assert_eq!((fewer.points.len(), fewer.events.len()), (2, 2));
    assert_eq!(fewer.parameters.get("POINT", "LABELS2"), None);
    assert_eq!(fewer.parameters.get("EVENT", "TIMES2"), None);
}

#[test]
fn frames_beyond_16_bits_are_written() {
    let mut record = C3d::new(100.0, "mm");
    record.first_frame = 70_000;
    record.points = vec![Point::new("HEEL", (0..66_000).map(|n| [f64::from(n), 0.0, 0.0]).collect())];
    assert_same(&again(&record), &record, "read back");
}

#[test]
fn recordings_without_frames_points_or_channels_are_written() {
    let mut record = C3d::new(100.0, "mm");
    assert_same(&again(&record), &record, "read back");
    record.points = vec![Point::new("HEEL", vec![])];
    assert_same(&again(&record), &record, "read back");
    let mut record = C3d::new(100.0, "mm");
    record.analog_rate_hz = 300.0;
    record.channels = vec![Channel::new("FZ", "N", vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0])];
    assert_eq!(again(&record).frames(), 2);
    assert_same(&again(&record), &record, "read back");
}

#[test]
fn samples_without_sign_are_written() {
    let mut record = sample();
    record.encoding = Encoding { storage: Storage::Integer, unsigned_analog: true, ..record.encoding };
    record.channels =
        vec![Channel { offset: 32768.0, ..Channel::new("FZ", "N", vec![32767.0, -32768.0, 0.0, 1.0, 2.0, 3.0]) }];
    record.set_platforms(&[]);
    assert_same(&again(&record), &record, "read back");
    assert_eq!(again(&record).parameters.text("ANALOG", "FORMAT"), Some("UNSIGNED"));
}

#[test]
fn what_the_format_cannot_hold_is_refused() {
    let refused = |change: fn(&mut C3d)| {
        let mut record = sample();
        change(&mut record);
        record.write().unwrap_err().to_string()
    };
    let said = |message: String, part: &str| assert!(message.contains(part), "{message}");
    said(refused(|r| r.point_rate_hz = 0.0), "a rate of points of 0; expected a finite number above zero");
    said(refused(|r| r.points[1].positions.truncate(2)), "[2, 3, 3] positions, residuals and cameras of point `TOE`");
    said(refused(|r| r.channels[1].samples.truncate(5)), "5 samples of channel `FZ`; expected 6, 2 for each frame");
    said(refused(|r| r.analog_rate_hz = 250.0), "250 analog samples and 100 frames per second");
    said(refused(|r| r.first_frame = -3), "first frame -3");
    said(refused(|r| r.points[0].residuals[0] = 100.0), "residual 100 and cameras 0b101 of point `HEEL` in frame 0");
    said(refused(|r| r.points[0].positions[0][1] = 1e39), "00000 as a position of point `HEEL` in frame 0");
    said(
        refused(|r| {
            r.encoding.storage = Storage::Integer;
            r.points[0].positions[2][0] = 9000.0;
        }),
        "9000 as a position of point `HEEL` in frame 2",
    );
    said(refused(|r| r.channels[0].samples[3] = f64::INFINITY), "inf as sample 3 of channel `FX`");
    said(refused(|r| r.events[2].label = "Heel strike".into()), "expected a label of at most four bytes in the header");
    said(refused(|r| r.points[0].name = "x".repeat(256)), "a text of 256 bytes; expected at most 255");
    said(
        refused(|r| {
            r.encoding.processor = Processor::Dec;
            r.encoding.point_scale = 1e-39;
        }),
        "a scale of points of 0.000000000000000000000000000000000000001; expected a finite number above zero",
    );
    let crooked = Parameter { dimensions: vec![2, 2], ..Parameter::list("P", Values::Reals(vec![0.0; 3])) };
    let mut record = sample();
    record.parameters.set("MINE", crooked);
    said(record.write().unwrap_err().to_string(), "MINE:P of shape [2, 2] with 3 values");
}

/// A number that 24 bits hold.
fn real() -> impl Strategy<Value = f64> {
    (-30_000i32..30_000, 0i32..8).prop_map(|(n, shift)| f64::from(n) / f64::from(1 << shift))
}

fn name() -> impl Strategy<Value = String> {
    "[A-Za-z0-9:é_]([A-Za-z0-9:é_ ]{0,20}[A-Za-z0-9:é_])?"
}

prop_compose! {
    fn point(frames: usize)(
        name in name(),
        description in name(),
        positions in prop::collection::vec(prop::option::weighted(0.8, [real(), real(), real()]), frames),
        words in prop::collection::vec((0u8..=255, 0u8..255), frames),
    ) -> Point {
        let seen = |i: usize| positions[i].is_some();
        Point {
            name,
            description,
            residuals: (0..frames).map(|i| if seen(i) { f64::from(words[i].1) * 0.5 } else { f64::NAN }).collect(),
            cameras: (0..frames).map(|i| if seen(i) { words[i].0 } else { 0 }).collect(),
            positions: positions.iter().map(|position| position.unwrap_or([f64::NAN; 3])).collect(),
        }
    }
}

prop_compose! {
    fn channel(samples: usize)(
        name in name(),
        unit in "[A-Za-z]{0,4}",
        raw in prop::collection::vec(real(), samples),
        scale in prop::sample::select(vec![1.0, -0.25, 0.01f32.into(), 3e-5f32.into()]),
        offset in prop::sample::select(vec![0.0, 2048.0, -17.0]),
    ) -> Channel {
        let samples = raw.iter().map(|raw| (raw - offset) * scale).collect();
        Channel { scale, offset, ..Channel::new(&name, &unit, samples) }
    }
}

prop_compose! {
    fn recording()(frames in 0usize..12, samples in 1usize..4)(
        points in prop::collection::vec(point(frames), 0..6),
        channels in prop::collection::vec(channel(frames * samples), 0..5),
        times in prop::collection::vec((name(), name(), 0u32..100_000), 0..5),
        processor in prop::sample::select(Processor::ALL.to_vec()),
        first_frame in 1i64..200_000,
        rate in prop::sample::select(vec![50.0, 59.94f32.into(), 100.0, 240.0]),
        samples in Just(samples),
    ) -> C3d {
        let mut record = C3d::new(rate, "mm");
        record.encoding = Encoding { processor, point_scale: 0.5, ..record.encoding };
        record.analog_rate_hz = if channels.is_empty() { 0.0 } else { rate * samples as f64 };
        let event = |(label, context, ms): (String, String, u32)| Event::new(&label, &context, f64::from(ms) / 128.0);
        record.events = times.into_iter().map(event).collect();
        record.first_frame = if points.is_empty() && channels.is_empty() { 1 } else { first_frame };
        (record.points, record.channels) = (points, channels);
        record
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn random_recordings_read_back_the_same(record in recording()) {
        let bytes = record.write().unwrap();
        let (again, remarks) = C3d::read(&bytes).unwrap();
        prop_assert_eq!(remarks, []);
        assert_same(&again, &record, "read back");
        prop_assert_eq!(again.write().unwrap(), bytes);
    }
}
