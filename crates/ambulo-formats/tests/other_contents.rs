//! Files that have the name of another format: the error names what they are.

use ambulo_formats::b3d::Header;
use ambulo_formats::bvh::Bvh;
use ambulo_formats::c3d::C3d;
use ambulo_formats::content;
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::npz::Npz;
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;
use ambulo_formats::trc::Trc;

/// The errors of all readers.
fn errors(bytes: &[u8]) -> Vec<String> {
    [
        C3d::read(bytes).err(),
        Trc::read(bytes).err(),
        Table::read_storage(bytes).err(),
        Table::read_csv(bytes).err(),
        Bvh::read(bytes).err(),
        Npz::read(bytes).err(),
        OsimModel::read(bytes).err(),
        ExternalLoads::read(bytes).err(),
        Header::length(bytes).err().map(|error| error.or_other_content(bytes, "a subject of AddBiomechanics (.b3d)")),
    ]
    .into_iter()
    .map(|error| error.map_or_else(|| "read".to_owned(), |error| error.to_string()))
    .collect()
}

#[test]
fn what_is_no_recording_is_named_by_every_reader() {
    let padded = |start: &[u8]| [start, &[b' '; 600]].concat();
    for (bytes, what) in [
        (&b"version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n"[..], "a pointer of Git LFS"),
        (b"../../.git/annex/objects/aa/bb/SHA256E-s1--d.c3d/SHA256E-s1--d.c3d", "a pointer of git-annex"),
        (b"/annex/objects/SHA256E-s1--d.c3d\n", "a pointer of git-annex"),
        (b"\n<!DOCTYPE html>\n<html><head><title>404</title></head><body><p>Not found</html>\n", "a web page (HTML)"),
        (&padded(b"MATLAB 5.0 MAT-file"), "a file of MATLAB"),
        (&padded(b"\x89HDF\r\n\x1a\n"), "an HDF5 file"),
        (&padded(b"\x1f\x8b\x08\0"), "a compressed archive"),
        (&padded(b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"), "a spreadsheet or document of Office"),
        (&padded(b"Kaydara FBX Binary  \0"), "an animation scene"),
        (&padded(b"%PDF-1.7"), "a picture, video or document"),
        (&padded(b"\x80\x04\x95"), "a pickled object"),
        (b"{\"message\": \"Not Found\", \"status\": 404}", "JSON"),
        (&[0; 5000], "zeros only"),
    ] {
        // XML readers know what a text is.
        let readers = if bytes.is_ascii() { 9 } else { 6 };
        for error in errors(bytes).into_iter().take(readers) {
            assert!(
                error.starts_with(&format!("the content is {what}")) && error.contains(". hint: "),
                "{what}: {error}"
            );
        }
    }
}

#[test]
fn tables_of_capture_programs_are_named() {
    for (text, what) in [
        ("NO_OF_FRAMES\t100\nNO_OF_CAMERAS\t8\n", "Qualisys Track Manager"),
        ("Format Version,1.23,Take Name,Walk\n,,Name\n", "OptiTrack Motive"),
        ("Trajectories\r\n100\r\n,,LASI,,\r\nFrame,Sub Frame,X,Y,Z\r\n", "Vicon Nexus"),
    ] {
        let error = Table::read_csv(text.as_bytes()).unwrap_err().to_string();
        assert!(error.starts_with(&format!("the content is a table of {what}; expected a table")), "{error}");
    }
}

#[test]
fn recordings_are_known_by_their_content() {
    let mut c3d = vec![0; 600];
    c3d[..2].copy_from_slice(&[2, 0x50]);
    for (bytes, name) in [
        (&c3d[..], "a C3D recording (.c3d)"),
        (b"\xef\xbb\xbfPathFileType\t4\t(X/Y/Z)\ta.trc\n", "a marker file (.trc)"),
        (b"Coordinates\nversion=1\nendheader\ntime\tx\n", "an OpenSim table (.mot or .sto)"),
        (b"Coordinates,,\nversion=1,,\nendheader,,\ntime,x,y\n", "an OpenSim table (.mot or .sto)"),
        (b" HIERARCHY\nROOT a\n", "a skeleton (.bvh)"),
        (b"<?xml version=\"1.0\"?>\n<OpenSimDocument Version=\"40000\">", "an OpenSim document (.osim or .xml)"),
    ] {
        assert_eq!(content(bytes).map(|(name, _)| name), Some(name));
    }
    for text in [&b"time,x\n0,1\n"[..], b"Frame#\tTime\n", b"", b"0"] {
        assert_eq!(content(text), None);
    }
}

#[test]
fn a_c3d_that_was_changed_as_text_is_named() {
    let mut bytes = vec![0; 1024];
    bytes[..2].copy_from_slice(&[2, 0x50]);
    bytes[512..516].copy_from_slice(&[1, 80, 1, 84]);
    bytes[516..526].copy_from_slice(b"\xff\n\n\n\n\n\xc3\xe9\xe8\x90");
    let text: String = bytes.iter().map(|b| char::from(*b)).collect();
    let error = C3d::read(text.as_bytes()).unwrap_err().to_string();
    assert!(error.starts_with("the content is a binary file that was saved as text (UTF-8)"), "{error}");
    let feeds: Vec<u8> = bytes.iter().flat_map(|b| if *b == b'\n' { vec![b'\r', b'\n'] } else { vec![*b] }).collect();
    let error = C3d::read(&feeds).unwrap_err().to_string();
    assert!(error.starts_with("the content is a binary file whose line ends were changed"), "{error}");
    let error = C3d::read(&bytes).unwrap_err().to_string();
    assert!(!error.starts_with("the content is"), "{error}");
}

#[test]
fn an_element_with_very_many_attributes_is_refused_at_once() {
    let document = |count: usize| {
        let attributes: String = (0..count).map(|k| format!(" a{k}=\"{k}\"")).collect();
        format!("<OpenSimDocument><!-- {} --><Model name=\"a=b='c'\"{attributes}/></OpenSimDocument>", "=".repeat(5000))
    };
    let error = |count| OsimModel::read(document(count).as_bytes()).unwrap_err().to_string();
    assert!(error(300_000).contains("an element with 300001 attributes; expected at most 1000"), "{}", error(300_000));
    assert!(!error(900).contains("attributes"), "{}", error(900));
}
