//! Archives of arrays: two that NumPy wrote, round trips, and damaged ones.

use ambulo_formats::Error;
use ambulo_formats::npz::{Array, Data, Npz};

/// Written by testdata/by_numpy.py with NumPy 2.4.6.
const STORED: &[u8] = include_bytes!("testdata/by_numpy.npz");
const DEFLATED: &[u8] = include_bytes!("testdata/by_numpy_deflated.npz");

#[test]
fn archives_that_numpy_wrote_are_read() {
    let npz = Npz::read(STORED).unwrap();
    assert_eq!(Npz::read(DEFLATED).unwrap(), npz);
    let found = |name: &str| npz.array(name).unwrap();
    let numbers = |name: &str| (found(name).shape.clone(), found(name).numbers().unwrap().to_vec());
    assert_eq!(numbers("poses"), (vec![2, 6], (0..12).map(|k| f64::from(k) / 8.0).collect()));
    assert_eq!(numbers("trans"), (vec![2, 3], vec![0.5, -1.0, 2.0, 3.0, 4.0, 5.0]));
    assert_eq!(numbers("half"), (vec![3], vec![1.5, -0.25, 65504.0]));
    assert_eq!(numbers("columns"), (vec![2, 3], vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0]), "the first axis runs first there");
    assert_eq!(numbers("mocap_framerate"), (vec![], vec![120.0]));
    assert_eq!(numbers("flags"), (vec![2], vec![1.0, 0.0]));
    assert_eq!(numbers("signed"), (vec![2], vec![-3.0, 7.0]));
    assert_eq!(found("gender").data, Data::Text("female".into()));
    assert_eq!(found("gender_bytes").data, Data::Text("male".into()));
    assert_eq!(found("object").data, Data::Other("|O".into()), "a pickle is not opened");
    let names: Vec<_> = ["hip", "kneé", "", "ankle"].map(str::to_owned).into();
    assert_eq!(found("names").texts(), Some(&names[..]), "without the zeros that fill them up");
    assert_eq!(found("names_columns").texts().unwrap().concat(), "abcdef", "the first axis runs first there");
    assert_eq!((found("gender").texts(), found("poses").texts()), (None, None));
    assert_eq!(Npz::names(STORED).unwrap().len(), 12);
}

fn made() -> Npz {
    let numbers = |shape: Vec<usize>, numbers: Vec<f64>| Array { shape, data: Data::Numbers(numbers) };
    let arrays = vec![
        ("poses".to_owned(), numbers(vec![2, 2], vec![1.0, f64::MIN_POSITIVE, -0.0, 1e300])),
        ("none".to_owned(), numbers(vec![0, 3], Vec::new())),
        ("gender".to_owned(), Array { shape: Vec::new(), data: Data::Text("neutral".into()) }),
    ];
    Npz { arrays }
}

#[test]
fn what_is_written_reads_back() {
    let bytes = made().write().unwrap();
    assert_eq!(Npz::read(&bytes).unwrap(), made());
    let mut odd = made();
    odd.arrays[0].1.shape = vec![3, 2];
    assert!(odd.write().unwrap_err().to_string().contains("`poses` of the shape [3, 2]"));
}

#[test]
fn damaged_archives_are_refused_with_the_reason() {
    let bytes = made().write().unwrap();
    for end in 0..bytes.len() {
        assert!(Npz::read(&bytes[..end]).is_err(), "{end} bytes");
    }
    for bytes in [&bytes[..], DEFLATED] {
        for place in 0..bytes.len() {
            let mut changed = bytes.to_vec();
            changed[place] ^= 0x55;
            let _ = Npz::read(&changed);
        }
    }
    let mut flipped = bytes.clone();
    let place = bytes.windows(8).position(|eight| eight == 1e300_f64.to_le_bytes()).unwrap();
    flipped[place] ^= 1;
    let refused = Npz::read(&flipped).unwrap_err().to_string();
    assert!(refused.contains("checksum in `poses.npy`"), "{refused}");
    let text = Npz::read(b"SKELETONS").unwrap_err().to_string();
    assert!(text.contains("found the bytes 53 4b 45 4c; expected a ZIP archive"), "{text}");
    assert!(matches!(Npz::read(&[]), Err(Error::Empty { .. })));
}

#[test]
fn an_archive_that_would_unpack_to_terabytes_is_refused_before() {
    let mut bytes = made().write().unwrap();
    // The unpacked sizes in the list of entries.
    for at in 0..bytes.len() - 28 {
        if bytes[at..at + 4] == *b"PK\x01\x02" {
            bytes[at + 24..at + 28].copy_from_slice(&[0xff; 4]);
        }
    }
    let refused = Npz::read(&bytes).unwrap_err().to_string();
    assert!(refused.contains("when `poses.npy` is unpacked; expected at most 1073741824"), "{refused}");
}

#[test]
fn only_wanted_arrays_are_unpacked_and_shapes_are_compared_before() {
    let array = |shape: &[usize]| Array {
        shape: shape.to_vec(),
        data: Data::Numbers((0..shape.iter().product()).map(|k| k as f64).collect()),
    };
    let npz = Npz { arrays: vec![("large".into(), array(&[400, 5])), ("small".into(), array(&[2]))] };
    let bytes = npz.write().unwrap();
    let read = Npz::read_named(&bytes, |name| name == "small").unwrap();
    assert_eq!(read.array("small"), npz.array("small"));
    assert_eq!(read.array("large").unwrap(), &Array { shape: vec![400, 5], data: Data::Numbers(Vec::new()) });
    assert_eq!(Npz::shapes(&bytes).unwrap().array("small").unwrap().numbers(), Some(&[][..]));
    // A shape that is not that of the elements is found without them.
    let mut changed = bytes.clone();
    let place = changed.windows(8).position(|eight| eight == b"(400,5,)").unwrap();
    changed[place + 1] = b'9';
    let refused = Npz::shapes(&changed).unwrap_err().to_string();
    assert!(refused.contains("16000 bytes of elements of the shape [900, 5] in `large.npy`"), "{refused}");
}
