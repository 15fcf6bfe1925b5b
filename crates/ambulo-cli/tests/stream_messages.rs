//! Messages of a stream, and the order of its frames.

use ambulo_cli::internals::{
    AngleUnit, Clock, ClockDoubt, Numbering, Place, from_json, from_record, is_http, record_bytes, to_record,
    without_nan,
};

#[test]
fn records_have_the_numbers_that_were_written() {
    let mut bytes = Vec::new();
    to_record(70_000, &[1.5, f32::NAN, -3.25e7], &mut bytes);
    assert_eq!(bytes.len(), record_bytes(3));
    let message = from_record(&bytes, 3).unwrap();
    assert_eq!((message.frame, message.q), (Some(70_000), Some(vec![Some(1.5), None, Some(-3.25e7)])));
    let error = from_record(&bytes[..12], 3).unwrap_err().to_string();
    assert!(error.contains("12 bytes; expected 16"), "{error}");
}

#[test]
fn lines_are_frames_or_names_and_nothing_else() {
    let frame = from_json(b"{\"frame\": 3, \"q\": [0.5, null]}").unwrap();
    assert_eq!((frame.frame, frame.q), (Some(3), Some(vec![Some(0.5), None])));
    let names = from_json(b"{\"coordinates\": [\"hip\"], \"angles\": \"deg\"}").unwrap();
    assert_eq!((names.coordinates, names.angles), (Some(vec!["hip".to_owned()]), Some(AngleUnit::Deg)));
    assert_eq!(from_json(b"\xef\xbb\xbf{\"frame\": 3}").unwrap().frame, Some(3));
    for wrong in ["", "[]", "{\"frame\": -1}", "{\"q\": [\"x\"]}", "{\"values\": []}", "{\"angles\": \"turns\"}"] {
        assert!(from_json(wrong.as_bytes()).is_err(), "{wrong}");
    }
}

#[test]
fn lost_doubled_late_and_new_sequences_are_told_apart() {
    let mut numbering = Numbering::default();
    let far = 200;
    let cases = [
        (7, Place::Next),
        (8, Place::Next),
        (11, Place::After(2)),
        (11, Place::Doubled),
        (9, Place::Late),
        (9, Place::Doubled),
        (10, Place::Late),
        (12, Place::Next),
        (400, Place::After(387)),
        (12, Place::Anew),
        (13, Place::Next),
        (u64::MAX, Place::After(u64::MAX - 14)),
        (u64::MAX - 1, Place::Late),
        (u64::MAX, Place::Doubled),
    ];
    for (number, expected) in cases {
        assert_eq!(numbering.place(number, far), expected, "{number}");
    }
}

#[test]
fn numbers_that_are_none_are_missing_and_names_keep_their_letters() {
    let line = br#"{"frame": 3, "q": [NaN, -nan, 1.5,nan]}"#;
    assert_eq!(&*without_nan(line), br#"{"frame": 3, "q": [null,null, 1.5,null]}"#);
    let names = br#"{"coordinates": ["NaN", "nan, [nan]"]}"#;
    assert_eq!(&*without_nan(names), names);
    assert_eq!(from_json(line).unwrap().q, Some(vec![None, None, Some(1.5), None]));
    assert!(from_json(b"{\"q\": [Infinity]}").is_err());
}

#[test]
fn requests_of_http_are_told_from_frames() {
    for request in ["GET / HTTP/1.1\r\n", "POST /x HTTP/1.1\r\n", "OPTIONS * HTTP/1.1\r\n"] {
        assert!(is_http(request.as_bytes()), "{request}");
    }
    assert!(!is_http(b"{\"frame\": 0}") && !is_http(b"GETTING") && !is_http(b""));
}

#[test]
fn a_clock_finds_its_unit_and_its_rate_and_is_not_misled_by_losses_or_jitter() {
    let doubts = |times: &mut dyn Iterator<Item = f64>| {
        let mut clock = Clock::new(100.0);
        times.filter_map(|time| clock.doubt(time)).collect::<Vec<ClockDoubt>>()
    };
    let even = |step: f64| doubts(&mut (0..60).map(|frame| step * f64::from(frame)));
    assert_eq!(even(0.01), []);
    assert_eq!(even(10.0), [ClockDoubt::Unit("milliseconds")]);
    assert_eq!(even(1e7), [ClockDoubt::Unit("nanoseconds")]);
    assert!(matches!(even(0.005)[..], [ClockDoubt::Rate(rate)] if (rate - 200.0).abs() < 1e-6));
    // Times in milliseconds of another rate: both.
    assert!(matches!(even(5.0)[..], [ClockDoubt::Unit("milliseconds"), ClockDoubt::Rate(_)]));
    // Two losses of ten seconds are no unit of their own; late and early frames are no other rate.
    assert_eq!(doubts(&mut [0.0, 10.0, 10.01, 20.0, 20.01].into_iter()), []);
    let jitter = |frame: i32| 0.01 * f64::from(frame) + [0.0, 0.003, -0.002][(frame % 3) as usize];
    assert_eq!(doubts(&mut (0..60).map(jitter)), []);
    assert_eq!(doubts(&mut (0..60).filter(|frame| frame % 4 != 1).map(|frame| 0.01 * f64::from(frame))), []);
}
