//! Identifies the content of a file by its first bytes.
//!
//! Files often have the name of another format, or contain a page of a server, a pointer to a large file or an archive
//! in place of a recording. If a reader fails, the content is identified here, so that the error names the true reason.
//! Readable files are not checked.
//!
//! Sources: git-lfs, docs/spec.md (the first line of a pointer); git-annex, doc/internals.mdwn (paths of objects);
//! PKWARE, APPNOTE.TXT 4.3; the "magic" numbers of file(1). All from memory, unverified, except for formats that this
//! crate reads. Pinned by: tests/other_contents.rs

use crate::error::Error;
use crate::plain_text::utf8;

/// Number of bytes that are searched for a kind of content.
const HEAD_BYTES: usize = 4096;
/// Fewest line breaks and characters that show damage by a program for text; fewer may be chance.
const ENOUGH: usize = 4;

/// The kinds of content that readers of this crate expect.
pub(crate) const C3D: &str = "a C3D recording (.c3d)";
pub(crate) const TRC: &str = "a marker file (.trc)";
pub(crate) const STORAGE: &str = "an OpenSim table (.mot or .sto)";
pub(crate) const BVH: &str = "a skeleton (.bvh)";
pub(crate) const XML: &str = "an XML document";
const MVNX: &str = "a recording of Xsens (.mvnx)";
const OPENSIM: &str = "an OpenSim document (.osim or .xml)";
pub(crate) const NPZ: &str = "an archive of NumPy arrays (.npz)";
pub(crate) const CSV: &str = "a table of comma-separated values (.csv)";

/// A kind of content.
struct Kind {
    name: &'static str,
    /// Remedy: how to get the expected content.
    remedy: &'static str,
    is: fn(&Head<'_>) -> bool,
}

/// The beginning of a file, as bytes and as lower-case text.
struct Head<'a> {
    bytes: &'a [u8],
    text: String,
}

impl Head<'_> {
    fn begins(&self, signs: &[&[u8]]) -> bool {
        signs.iter().any(|sign| self.bytes.starts_with(sign))
    }

    /// Whether the text begins with one of these words; white space and quotes before them do not count.
    fn reads(&self, words: &[&str]) -> bool {
        words.iter().any(|word| self.text.starts_with(word))
    }

    fn has(&self, words: &[&str]) -> bool {
        words.iter().any(|word| self.text.contains(word))
    }
}

const UNPACK: &str = "unpack it first";
const EXPORT: &str = "export the recording again, as .c3d, .trc or .bvh";

/// The first that fits counts.
const KINDS: &[Kind] = &[
    Kind {
        name: "a pointer of Git LFS to the file, not the file itself",
        remedy: "`git lfs pull` fetches the file",
        is: |head| head.reads(&["version https://git-lfs"]),
    },
    Kind {
        name: "a pointer of git-annex to the file, not the file itself",
        remedy: "`git annex get` or `datalad get` fetches the file",
        is: |head| head.reads(&["/annex/objects/", "../", ".git/annex"]) && head.has(&["annex/objects/"]),
    },
    Kind {
        name: "a web page (HTML)",
        remedy: "a server sent a page in place of the file; download the file itself",
        is: |head| {
            head.reads(&["<!doctype html", "<html", "<head", "<script"])
                || (head.reads(&["<?xml", "<!--"]) && head.has(&["<html"]))
        },
    },
    Kind {
        name: OPENSIM,
        remedy: "state it as the model, set-up or external loads that it is",
        is: |head| head.reads(&["<"]) && head.has(&["<opensimdocument"]),
    },
    Kind {
        name: MVNX,
        remedy: "give the file a name that ends with .mvnx",
        is: |head| head.reads(&["<"]) && head.has(&["<mvnx"]),
    },
    Kind { name: XML, remedy: "choose the recording itself", is: |head| head.reads(&["<?xml"]) },
    Kind {
        name: C3D,
        remedy: "give the file a name that ends with .c3d",
        is: |head| matches!(head.bytes, [2..=16, 0x50, ..]) && head.bytes.len() >= 512,
    },
    Kind { name: TRC, remedy: "give the file a name that ends with .trc", is: |head| head.reads(&["pathfiletype"]) },
    Kind { name: BVH, remedy: "give the file a name that ends with .bvh", is: |head| head.reads(&["hierarchy"]) },
    Kind {
        name: STORAGE,
        remedy: "give the file a name that ends with .mot or .sto",
        is: |head| head.text.lines().any(|line| line.trim_matches([' ', ',', ';', '\t', '"']) == "endheader"),
    },
    Kind {
        name: "a table of Qualisys Track Manager",
        remedy: EXPORT,
        is: |head| head.reads(&["no_of_frames", "file_version\t"]),
    },
    Kind { name: "a table of OptiTrack Motive", remedy: EXPORT, is: |head| head.reads(&["format version,"]) },
    Kind {
        name: "a table of Vicon Nexus",
        remedy: EXPORT,
        is: |head| {
            let mut lines = head.text.lines().map(|line| line.trim_matches([',', '\t', ' ', '"']));
            let is_title = lines
                .next()
                .is_some_and(|line| ["trajectories", "devices", "model outputs", "joints", "segments"].contains(&line));
            is_title && lines.next().is_some_and(|rate| rate.parse::<f64>().is_ok())
        },
    },
    Kind {
        name: NPZ,
        remedy: "give the file a name that ends with .npz",
        is: |head| head.begins(&[b"PK\x03\x04"]) && head.has(&[".npy"]),
    },
    Kind {
        name: "a spreadsheet (.xlsx)",
        remedy: "save the sheet as .csv",
        is: |head| head.begins(&[b"PK\x03\x04"]) && head.has(&["[content_types].xml", "xl/"]),
    },
    Kind { name: "a ZIP archive", remedy: UNPACK, is: |head| head.begins(&[b"PK\x03\x04", b"PK\x05\x06"]) },
    Kind {
        name: "a compressed archive",
        remedy: UNPACK,
        is: |head| {
            head.begins(&[b"\x1f\x8b", b"7z\xbc\xaf\x27\x1c", b"Rar!", b"BZh", b"\xfd7zXZ", b"\x28\xb5\x2f\xfd"])
                || head.bytes.get(257..262) == Some(b"ustar")
        },
    },
    Kind {
        name: "a spreadsheet or document of Office (.xls, .doc)",
        remedy: "save the sheet as .csv",
        is: |head| head.begins(&[b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"]),
    },
    Kind { name: "a file of MATLAB (.mat)", remedy: EXPORT, is: |head| head.begins(&[b"MATLAB "]) },
    Kind {
        name: "an HDF5 file (.h5, or .mat of MATLAB 7.3)",
        remedy: EXPORT,
        is: |head| head.begins(&[b"\x89HDF\r\n\x1a\n"]),
    },
    Kind {
        name: "an animation scene (FBX or glTF)",
        remedy: "export the skeleton as .bvh",
        is: |head| head.begins(&[b"Kaydara FBX", b"glTF"]) || head.reads(&["; fbx"]),
    },
    Kind {
        name: "a single array of NumPy (.npy)",
        remedy: "save all arrays of the motion in one .npz with numpy.savez",
        is: |head| head.begins(&[b"\x93NUMPY"]),
    },
    Kind {
        name: "a pickled object of Python",
        remedy: "save its arrays in one .npz with numpy.savez; pickled objects are not opened",
        is: |head| matches!(head.bytes, [0x80, 2..=5, ..]),
    },
    Kind { name: "a table of Parquet", remedy: "save it as .csv", is: |head| head.begins(&[b"PAR1"]) },
    Kind {
        name: "a picture, video or document",
        remedy: "choose the recording itself",
        is: |head| {
            head.begins(&[b"%PDF", b"\x89PNG", b"\xff\xd8\xff", b"GIF8", b"RIFF", b"\x1aE\xdf\xa3"])
                || head.bytes.get(4..8) == Some(b"ftyp")
        },
    },
    Kind {
        name: "JSON",
        remedy: "if a server sent it in place of the file, download the file itself",
        is: |head| head.reads(&["{", "["]) && head.has(&["\":", "\" :"]),
    },
];

/// The kind of content of a file by its beginning, and how to get a recording from it; `None` if it is unknown.
#[must_use]
pub fn content(bytes: &[u8]) -> Option<(&'static str, &'static str)> {
    let start = &bytes[..bytes.len().min(HEAD_BYTES)];
    if start.len() >= ENOUGH && bytes.iter().all(|byte| *byte == 0) {
        return Some(("zeros only", "the file was not copied completely; copy or download it again"));
    }
    let text = String::from_utf8_lossy(&utf8(start)).to_lowercase();
    let blank = |c: char| c.is_whitespace() || matches!(c, '\u{feff}' | '"');
    let head = Head { bytes: start, text: text.trim_start_matches(blank).to_owned() };
    KINDS.iter().find(|kind| (kind.is)(&head)).map(|kind| (kind.name, kind.remedy))
}

impl Error {
    /// The same error, unless the content is of another kind than `expected`: then that is the reason.
    #[must_use]
    pub fn or_other_content(self, bytes: &[u8], expected: &'static str) -> Error {
        match content(bytes) {
            Some((found, _)) if expected == XML && [XML, MVNX, OPENSIM].contains(&found) => self,
            Some((found, remedy)) if found != expected => Error::OtherContent { found, expected, remedy },
            _ => self,
        }
    }

    /// The same error, unless a program that took the binary file for text has changed its bytes.
    pub(crate) fn or_changed_as_text(self, bytes: &[u8]) -> Error {
        let Some(found) = was_changed_as_text(bytes) else { return self };
        let remedy = "copy it again from its source as it is (FTP: binary mode; git: `*.c3d binary` in .gitattributes)";
        Error::OtherContent { found, expected: C3D, remedy }
    }
}

/// Damage by a program that treated a binary file as text; `None` if the bytes show none.
pub(crate) fn was_changed_as_text(bytes: &[u8]) -> Option<&'static str> {
    match std::str::from_utf8(bytes) {
        Ok(text) if text.chars().filter(|c| !c.is_ascii()).count() >= ENOUGH => {
            Some("a binary file that was saved as text (UTF-8)")
        }
        _ if has_text_line_ends(bytes) => Some("a binary file whose line ends were changed as in a text"),
        _ => None,
    }
}

/// Whether every line feed of a binary file follows a carriage return.
fn has_text_line_ends(bytes: &[u8]) -> bool {
    let feeds = bytes.iter().filter(|byte| **byte == b'\n').count();
    feeds >= ENOUGH && bytes.windows(2).filter(|pair| pair == b"\r\n").count() == feeds
}
