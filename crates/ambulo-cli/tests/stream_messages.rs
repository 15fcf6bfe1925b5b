//! Messages of a stream, and the order of its frames.

use ambulo_cli::internals::{AngleUnit, Numbering, Place, from_json, from_record, record_bytes, to_record};

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
