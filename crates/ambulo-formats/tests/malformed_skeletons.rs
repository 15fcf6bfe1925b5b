//! BVH files that are wrong: the message for each fault, and no panic, hang or large allocation on anything.

use ambulo_formats::bvh::{Bvh, MAX_DEPTH, MAX_JOINTS};
use proptest::prelude::*;
use std::fmt::Write;

const WALK: &str = "HIERARCHY\nROOT Hips\n{\nOFFSET 1.5 35 -4\nCHANNELS 3 Xposition Yposition Zrotation\n\
    JOINT Spine\n{\nOFFSET 0 8.5 0\nCHANNELS 1 Zrotation\nEnd Site\n{\nOFFSET 0 4 0\n}\n}\n}\n\
    MOTION\nFrames: 2\nFrame Time: 0.01\n9 35 1 4\n9.5 35.25 -1 -4\n";

fn error(text: impl AsRef<[u8]>) -> String {
    Bvh::read(text.as_ref()).unwrap_err().to_string()
}

#[track_caller]
fn change(from: &str, to: &str) -> String {
    assert!(WALK.contains(from), "{from}");
    error(WALK.replacen(from, to, 1))
}

#[test]
fn a_file_of_another_kind_is_named() {
    for text in ["", " \r\n\t\n", "\u{feff}"] {
        assert_eq!(error(text), "the file is empty; expected a BVH file, which begins with `HIERARCHY`");
    }
    assert_eq!(error("Skeleton 4"), "line 1: found `Skeleton`; expected `HIERARCHY`, as a BVH file begins");
    assert_eq!(
        error("x".repeat((1 << 20) + 1)),
        "line 1: found a line of more than 1048576 bytes; expected a text file with shorter lines"
    );
}

#[test]
fn a_bad_skeleton_is_named() {
    let inside = "expected `OFFSET`, `CHANNELS`, `JOINT`, `End Site` or `}`";
    assert_eq!(change("ROOT Hips", "JOINT Hips"), "line 2: found `JOINT`; expected `ROOT` and a name");
    assert_eq!(change("ROOT Hips\n", "ROOT\n"), "line 2: found `ROOT` without a name; expected a name without braces");
    assert_eq!(change("JOINT Spine\n", "JOINT a}\n"), "line 6: found `a}`; expected a name without braces");
    assert_eq!(change("Spine\n{", "Spine\n("), "line 7: found `(`; expected `{` after the name of a joint");
    assert_eq!(change("JOINT", "BONE"), format!("line 6: found `BONE`; {inside}"));
    assert_eq!(change("MOTION", "}\nMOTION"), "line 16: found `}`; expected `ROOT` and a name, or `MOTION`");
    assert_eq!(change("}\n}\n}\n", "}\n}\n"), format!("line 15: found `MOTION`; {inside}"));
    assert_eq!(change("End Site\n{", "End Site"), "line 11: found `OFFSET`; expected `{` behind `End Site`");
    assert_eq!(change("OFFSET 0 4 0", "}"), "line 12: found `}`; expected `OFFSET` in an `End Site`");
    let end = "expected `}` after the OFFSET of an `End Site`";
    assert_eq!(change("OFFSET 0 4 0\n", "OFFSET 0 4 0 1\n"), format!("line 12: found `1`; {end}"));
    assert_eq!(error("HIERARCHY\nMOTION\nFrames: 0\n"), "line 2: found `MOTION`; expected `ROOT` and a name");
}

#[test]
fn bad_offsets_and_channels_are_named() {
    let three = "expected OFFSET and three finite numbers: a number";
    assert_eq!(change("35 -4\n", "35\n"), format!("line 5: found `CHANNELS`; {three}"));
    assert_eq!(change("35 -4", "inf -4"), format!("line 4: found `inf`; {three}"));
    let comma = "with a decimal point; the file appears to use a decimal comma; export it with a decimal point";
    assert_eq!(change("1.5 35", "1,5 35"), format!("line 4: found `1,5`; {three} {comma}"));
    assert_eq!(
        change("OFFSET 0 8.5 0\n", ""),
        "line 6: found joint `Spine` without OFFSET; expected OFFSET and three numbers"
    );
    let inside = "expected `OFFSET`, `CHANNELS`, `JOINT`, `End Site` or `}`";
    assert_eq!(change("35 -4\n", "35 -4 5\n"), format!("line 4: found `5`; {inside}"));
    assert_eq!(change("OFFSET 0 8.5 0", "OFFSET 0 8.5 0\nOFFSET 1 1 1"), format!("line 9: found `OFFSET`; {inside}"));
    let words = "Xposition, Yposition, Zposition, Xrotation, Yrotation or Zrotation";
    assert_eq!(change("S 3", "S 4"), format!("line 6: found `JOINT`; expected 4 channels: {words}"));
    assert_eq!(change("S 3", "S 2"), format!("line 5: found `Zrotation`; {inside}"));
    assert_eq!(change("S 3", "S 7"), "line 5: found `7`; expected a number of channels from 0 to 6");
    let absurd = "found `99999999999999999999`; expected a number of channels from 0 to 6";
    assert_eq!(change("S 3", "S 99999999999999999999"), format!("line 5: {absurd}"));
    assert_eq!(change("Yposition", "Yscale"), format!("line 5: found `Yscale`; expected 3 channels: {words}"));
    let twice = "found `Xposition`; expected different channels within a joint";
    assert_eq!(change("Yposition", "Xposition"), format!("line 5: {twice}"));
    let late = WALK.replace("CHANNELS 3 Xposition Yposition Zrotation\n", "");
    let late = late.replace("}\n}\nMOTION", "}\nCHANNELS 1 Xposition\n}\nMOTION");
    let before = "expected `CHANNELS` of a joint before its child joints";
    assert_eq!(error(late), format!("line 14: found `CHANNELS`; {before}"));
}

#[test]
fn a_bad_motion_is_named() {
    assert_eq!(change("Frames: 2", "Frame: 2"), "line 17: found `Frame`; expected `Frames:` and their number");
    assert_eq!(change(": 2\n", ": many\n"), "line 17: found `many`; expected `Frames:` and a whole number");
    assert_eq!(change(": 2\n", ": -2\n"), "line 17: found `-2`; expected `Frames:` and a whole number");
    assert_eq!(change(" Time", ""), "line 18: found `Frame:`; expected `Frame Time:` and seconds");
    let time = "expected `Frame Time:` and seconds from one frame to the next, a finite number above zero";
    for wrong in ["0", "-0.01", "inf", "nan", "fast"] {
        assert_eq!(change("0.01", wrong), format!("line 18: found `{wrong}`; {time}"));
    }
    let end = "expected the end of the line after the frame time";
    assert_eq!(change("0.01\n", "0.01 9 35 1 4\n"), format!("line 18: found `9 35 1 4`; {end}"));
    let values = "expected 4, one per channel of the skeleton, with one frame per line";
    assert_eq!(change("9 35 1 4", "9 35 1"), format!("line 19: found 3 values; {values}"));
    assert_eq!(change("9 35 1 4", "9 35 1 4 7"), format!("line 19: found 5 values; {values}"));
    assert_eq!(change("9 35", "9 x"), "line 19: found `x`; expected a number");
}

#[test]
fn a_file_that_ends_early_is_truncated() {
    let cut = |from: &str| error(WALK.split(from).next().unwrap());
    let message =
        |line: usize, expected: &str| format!("line {line}: the file ends here; expected {expected}. Is it truncated?");
    assert_eq!(cut("ROOT"), message(1, "a `ROOT`, or `MOTION` after the last one"));
    assert_eq!(cut("35 -4"), message(4, "three numbers after OFFSET"));
    assert_eq!(cut("3 X"), message(5, "the number of channels"));
    let words = "Xposition, Yposition, Zposition, Xrotation, Yrotation or Zrotation";
    assert_eq!(cut("Yposition"), message(5, words));
    assert_eq!(cut("JOINT"), message(5, "`OFFSET`, `CHANNELS`, `JOINT`, `End Site` or `}`"));
    assert_eq!(cut("MOTION"), message(15, "a `ROOT`, or `MOTION` after the last one"));
    assert_eq!(cut("Frames"), message(16, "`Frames:` and their number"));
    assert_eq!(cut("0.01"), message(18, "`Frame Time:` and seconds"));
    assert_eq!(cut(" -1 -4\n"), message(20, "the rest of a frame of 4 values"));
    assert_eq!(error(WALK.replace("-1 -4\n", "-1 -")), message(20, "the rest of a frame of 4 values"));
}

#[test]
fn absurd_skeletons_are_refused() {
    let mut deep = String::from("HIERARCHY\n");
    for k in 0..100_000 {
        let keyword = if k == 0 { "ROOT" } else { "JOINT" };
        writeln!(deep, "{keyword} a{{OFFSET 0 0 0").unwrap();
    }
    let line = MAX_DEPTH + 2;
    assert_eq!(error(deep), format!("line {line}: found `JOINT`; expected joints nested at most {MAX_DEPTH} deep"));
    let wide = format!("HIERARCHY\n{}", "ROOT a{OFFSET 0 0 0}\n".repeat(100_000));
    assert_eq!(error(wide), format!("line {}: found `ROOT`; expected at most {MAX_JOINTS} joints", MAX_JOINTS + 2));
}

#[test]
fn stated_counts_reserve_no_memory() {
    let (bvh, remarks) = Bvh::read(WALK.replace("Frames: 2", "Frames: 18446744073709551615").as_bytes()).unwrap();
    assert_eq!((bvh.frames(), remarks.len()), (2, 1));
}

#[test]
fn a_hundred_megabytes_of_garbage_are_refused() {
    let head = WALK.split("9 35").next().unwrap().as_bytes();
    let kinds: [Vec<u8>; 4] = [
        vec![b'a'; 100 << 20],
        [b"HIERARCHY ROOT a".to_vec(), b" {\n".repeat(33 << 20)].concat(),
        [head.to_vec(), b"\xff \"\n".repeat(25 << 20)].concat(),
        [b"HIERARCHY\nROOT a{OFFSET 0 0 0\n".to_vec(), b"End Site{OFFSET 0 0 0}\n".repeat(4 << 20)].concat(),
    ];
    for garbage in kinds {
        // A tenth of a second to half a second each; a reader whose time grows with the square of the size would take
        // hours.
        assert!(Bvh::read(&garbage).is_err());
    }
}

#[test]
fn small_files_cut_or_damaged_at_any_byte_do_not_panic() {
    for k in 0..WALK.len() {
        let _ = Bvh::read(&WALK.as_bytes()[..k]);
        for byte in [0, b'\t', b'\n', b'\r', b' ', b':', b'{', b'}', b'-', b'9', 0xff] {
            let mut damaged = WALK.as_bytes().to_vec();
            damaged[k] = byte;
            if let Ok((bvh, _)) = Bvh::read(&damaged) {
                let (again, _) = Bvh::read(&bvh.write()).unwrap();
                assert_eq!(again.joints(), bvh.joints());
            }
        }
    }
}

proptest! {
    #[test]
    fn random_bytes_do_not_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = Bvh::read(&bytes);
    }

    #[test]
    fn random_words_do_not_panic(words in prop::collection::vec(0..14_usize, 0..60)) {
        const WORDS: [&str; 14] = ["ROOT a\n", "JOINT b\n", "{", "}\n", "OFFSET", "CHANNELS", "End Site", "MOTION\n",
            "Frames:", "Frame Time:", "1", " 0.5 ", "Xrotation", "\n"];
        let text: String = words.into_iter().flat_map(|k| [" ", WORDS[k]]).collect();
        let _ = Bvh::read(text.as_bytes());
        let _ = Bvh::read(format!("HIERARCHY\n{text}").as_bytes());
        let _ = Bvh::read(format!("HIERARCHY ROOT a {{ OFFSET 0 0 0 CHANNELS 1 Xrotation }} MOTION {text}").as_bytes());
    }
}
