//! Marker sets: the built-in ones agree with docs/MARKERS.md, and names of real recordings are recognised.

use ambulo::findings::Code;
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::marker_set::{Landmark, MarkerSet, RecognisedMarkers, Segment};
use ambulo::model::{Side, marker_set::MarkerSetError};

const PAGE: &str = include_str!("../../../docs/MARKERS.md");

fn recognised(names: &str) -> RecognisedMarkers {
    MarkerSet::recognise(names.split_whitespace()).unwrap_or_else(|e| panic!("{e}"))
}

fn refused(text: &str) -> String {
    MarkerSet::from_toml(text).unwrap_err().to_string()
}

/// Rows of the tables of a section of the page, cells without back quotes.
fn rows(section: &str) -> Vec<Vec<String>> {
    let begin = PAGE.find(&format!("\n## {section}\n")).unwrap_or_else(|| panic!("no section {section}"));
    let text = &PAGE[begin + 4..];
    let text = &text[..text.find("\n## ").unwrap_or(text.len())];
    let lines = text.lines().filter(|l| l.starts_with('|')).skip(2);
    lines.map(|l| l.trim_matches('|').split('|').map(|c| c.trim().replace('`', "")).collect()).collect()
}

#[test]
fn every_built_in_set_is_read_and_has_each_name_once() {
    for set in MarkerSet::built_in().unwrap() {
        assert!(set.markers.len() >= 15, "{}", set.name);
        assert!(MarkerSet::NAMES.contains(&set.name.as_str()), "file and name agree");
        for marker in &set.markers {
            assert!(marker.landmark.is_none_or(|l| l.segment() == marker.segment && marker.place.is_some()));
            let loose = matches!(marker.segment, Segment::Humerus | Segment::Forearm);
            let expected = marker.landmark.map_or(if loose { 0.02 } else { 0.1 }, Landmark::weight);
            assert!((marker.weight - expected).abs() < 1e-15 || marker.names == ["RBAK"], "{:?}", marker.names);
            assert!(!loose || marker.weight < 0.2, "{:?}", marker.names);
        }
    }
}

#[test]
fn the_page_lists_every_marker_of_every_set_with_its_names_and_meaning() {
    for set in MarkerSet::built_in().unwrap() {
        let mut expected: Vec<Vec<String>> = Vec::new();
        for marker in &set.markers {
            let side = marker.side.map_or("-".to_owned(), |side| side.to_string());
            let on = marker.landmark.map_or("technical", Landmark::word).to_owned();
            expected.push(vec![marker.names.join(", "), side, marker.segment.word().to_owned(), on]);
        }
        assert_eq!(rows(&set.name), expected, "section {} of docs/MARKERS.md", set.name);
    }
}

#[test]
fn the_page_lists_every_landmark() {
    let expected: Vec<Vec<String>> = Landmark::all()
        .map(|l| {
            let place = l.place();
            let places = format!("{} {} {}", place.x, place.y, place.z);
            vec![l.word().to_owned(), l.segment().word().to_owned(), places, l.meaning().to_owned()]
        })
        .collect();
    assert_eq!(rows("Landmarks"), expected);
}

#[test]
fn markers_are_on_the_body_where_their_names_mean() {
    let human =
        full_body(&Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true }).unwrap();
    for set in MarkerSet::built_in().unwrap() {
        let markers = set.on(&human);
        for definition in &set.markers {
            let Some(marker) = markers.iter().find(|m| m.name == definition.names[0]) else { continue };
            let out = match definition.side {
                Some(Side::Right) => 1.0,
                Some(Side::Left) => -1.0,
                None => continue,
            };
            let is_inner = definition.landmark.is_some_and(|l| l.place().z < 0.0);
            assert!(
                if is_inner { out * marker.location.z < 0.0 } else { out * marker.location.z >= 0.0 },
                "{}",
                marker.name
            );
            // No marker is further from the origin of its segment than 0.8 m, the distance of the vertex from the lumbar joint.
            assert!(marker.location.norm() < 0.8, "{}", marker.name);
        }
    }
}

#[test]
fn names_of_real_recordings_are_recognised() {
    let lower = recognised("LASI RASI LPSI RPSI LTHI LKNE LTIB LANK LHEE LTOE RTHI RKNE RTIB RANK RHEE RTOE");
    assert_eq!(lower.sets, ["plug-in-gait"]);
    assert_eq!(lower.markers.len(), 16);
    assert_eq!(lower.on(Landmark::LateralMalleolus, Some(Side::Left)), Some("LANK"));
    assert_eq!(lower.on(Landmark::MedialMalleolus, Some(Side::Left)), None);
    let oxford = recognised(
        "LFHD LBHD RFHD RBHD C7 T2 T6 T10 T12 RBAK CLAV STRN LSHO LELB LWRA LWRB LFIN RSHO RELB RWRA RWRB RFIN SACR RASI LASI \
         LTHI LKNE LHFB LTUB LTIB LSHN LANK LMMA LHEE LCPG LPCA LLCA LSTL LNAV LP1M LD1M LP5M LD5M LTOE LHLX LHJC RHJC LAJC PELO",
    );
    assert_eq!(oxford.sets, ["plug-in-gait", "oxford-foot"]);
    assert_eq!(oxford.unknown, ["LHJC", "RHJC", "LAJC", "PELO"], "computed points are no markers");
    let gait = recognised(
        "R.ASIS L.ASIS V.Sacral R.Thigh.Upper R.Thigh.Front R.Knee.Lat R.Knee.Med R.Ankle.Lat R.Heel R.Toe.Tip",
    );
    assert_eq!(gait.sets, ["gait2392"]);
    let walk = recognised(
        "R.Shoulder L.Shoulder R.ASIS L.ASIS R.PSIS S2 L.PSIS R.TH1 R.TH2 R.Knee R.SH1 R.Ankle R.Heel R.MT5 R.Toe",
    );
    assert_eq!(walk.sets[0], "rajagopal");
    assert_eq!(walk.unknown, Vec::<String>::new());
    let run = recognised(
        "LASI RASI LPSI RPSI RTH2 RLFC RMFC RTB1 RLMAL RMMAL RCAL RTOE RMT5 LACR RACR CLAV C7 RUA1 RLEL RFAulna RHJC",
    );
    assert_eq!((run.sets[0].as_str(), run.unknown.len()), ("rajagopal", 1));
    let video = recognised(
        "Hip RHip RKnee RAnkle RBigToe RSmallToe RHeel LHip LKnee LAnkle LHeel Neck Head Nose RShoulder LShoulder",
    );
    assert_eq!(video.sets, ["keypoints"]);
    assert_eq!(
        recognised("r_shoulder_study L_shoulder_study r.ASIS_study L.ASIS_study r_knee_study r_mknee_study").sets,
        ["opencap"]
    );
    assert_eq!(recognised("RASIS LASIS RPSIS LPSIS RLE RME RLM RMM RCA RFM RVM RGT RHF").sets, ["cast"]);
}

#[test]
fn prefixes_and_capitals_do_not_matter() {
    let found = recognised("Anna:LASI Anna:RASI Anna:lpsi Anna:Rpsi Anna:LKNE");
    assert_eq!(found.markers.len(), 5);
    assert_eq!(found.on(Landmark::Psis, Some(Side::Left)), Some("Anna:lpsi"));
}

#[test]
fn unknown_names_are_rejected_with_those_found_and_those_expected() {
    let message = MarkerSet::recognise(["M1", "M2", "M3", "LASI"]).unwrap_err().to_string();
    for part in ["4 markers", "`M1`", "at most 1", "plug-in-gait", "`RASI`", "docs/MARKERS.md"] {
        assert!(message.contains(part), "{part}: {message}");
    }
    assert!(MarkerSet::recognise([]).is_err());
}

#[test]
fn a_second_marker_on_a_landmark_is_technical() {
    let found = recognised("LASI RASI LPSI RPSI LKNE L.Knee.Lat R.Knee.Lat");
    let knees: Vec<Option<Landmark>> = found
        .markers
        .iter()
        .filter(|m| m.name.contains("KNE") || m.name.contains("Knee"))
        .map(|m| m.definition.landmark)
        .collect();
    assert_eq!(knees, [Some(Landmark::LateralEpicondyle), None, Some(Landmark::LateralEpicondyle)]);
}

#[test]
fn a_custom_set_is_read_and_its_errors_are_stated() {
    let text = "name = 'mine'\n[[pair]]\nright = 'kr'\nleft = ['kl', 'knee left']\nlandmark = 'lateral_epicondyle'\n\
                [[single]]\nnames = 'x1'\nsegment = 'femur'\nside = 'left'\nplace = [0, -0.5, 0.1]\nweight = 2";
    let set = MarkerSet::from_toml(text).unwrap();
    assert_eq!(set.markers.len(), 3);
    assert_eq!(set.markers[1].names, ["kl", "knee left"]);
    assert!((set.markers[0].place.unwrap().z + set.markers[1].place.unwrap().z).abs() < 1e-15);
    assert_eq!((set.markers[2].side, set.markers[2].segment), (Some(Side::Left), Segment::Femur));
    for (fault, parts) in [
        ("name = 'x'", ["no marker", "[[pair]]"]),
        ("name = 'x'\n[[pair]]\nright = 'a'\nleft = 'A'\nlandmark = 'asis'", ["line 4", "no other marker"]),
        ("name = 'x'\n[[pair]]\nright = 'a'\nleft = 'b'\nlandmark = 'asi'", ["line 5", "asis"]),
        ("name = 'x'\n[[pair]]\nright = 'a'\nleft = 'b'", ["landmark", "segment"]),
        ("name = 'x'\n[[single]]\nnames = 'a'\nsegment = 'femur'", ["side", "right"]),
        ("name = 'x'\n[[single]]\nnames = 'a'\nsegment = 'torso'\nweight = -1", ["line 5", "-1"]),
        ("name = 'x'\n[[single]]\nnames = []\nsegment = 'torso'", ["names", "marker"]),
    ] {
        let message = refused(fault);
        assert!(parts.iter().all(|part| message.contains(part)), "{fault}: {message}");
    }
    assert!(
        matches!(MarkerSet::named("helen"), Err(MarkerSetError::Unknown(e)) if e.to_string().contains("plug-in-gait"))
    );
}

#[test]
fn the_page_lists_every_finding_of_a_calibration() {
    let names = Code::all().map(Code::name).filter(|name| name.starts_with("calibration."));
    let codes: std::collections::BTreeSet<String> = names.map(str::to_owned).collect();
    let listed: std::collections::BTreeSet<String> =
        rows("How a body is measured").into_iter().map(|row| row[0].clone()).filter(|c| c.contains('.')).collect();
    assert_eq!(codes, listed);
    assert!(codes.len() >= 3);
}
