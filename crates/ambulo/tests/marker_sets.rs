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

/// A section of the page as Markdown, for a new set.
fn section(name: &str, rows: &[Vec<String>]) -> String {
    let row = |cells: &Vec<String>| {
        let names: Vec<String> = cells[0].split(", ").map(|name| format!("`{name}`")).collect();
        format!("| {} | {} |\n", names.join(", "), cells[1..].join(" | "))
    };
    let head = "| names | side | segment | landmark |\n|---|---|---|---|\n";
    format!("## {name}\n\n{head}{}", rows.iter().map(row).collect::<String>())
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
        let is_there = PAGE.contains(&format!("\n## {}\n", set.name));
        let found = if is_there { rows(&set.name) } else { Vec::new() };
        assert!(found == expected, "docs/MARKERS.md should have this section:\n\n{}", section(&set.name, &expected));
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
            // No marker is further from the origin of its segment than 0.8 m, the distance of the vertex from the
            // lumbar joint.
            assert!(marker.location.norm() < 0.8, "{}", marker.name);
        }
    }
}

#[test]
fn names_are_recognised_the_same_whatever_was_asked_before() {
    let plug_in_gait = "LASI RASI LPSI RPSI LKNE RKNE LANK RANK LHEE RHEE LTOE RTOE";
    let lists: Vec<String> = (0..12).map(|k| format!("{plug_in_gait} further{k}")).collect();
    let first: Vec<_> = lists.iter().map(|names| recognised(names)).collect();
    for (k, (names, first)) in lists.iter().zip(&first).enumerate() {
        assert_eq!(first.unknown, [format!("further{k}")]);
        for _ in 0..2 {
            assert_eq!(recognised(names), *first);
        }
    }
    // A laboratory's own set decides, also where the built-in ones were asked for the same names.
    let own = "name = 'own'\n[[single]]\nnames = 'further0'\nside = 'right'\nsegment = 'tibia'";
    let own = MarkerSet::from_toml(own).unwrap();
    let found = RecognisedMarkers::with(Some(&own), lists[0].split_whitespace()).unwrap();
    assert!(found.sets.contains(&"own".to_owned()), "{:?}", found.sets);
    assert!(found.unknown.is_empty(), "{:?}", found.unknown);
    assert_eq!(recognised(&lists[0]), first[0]);
}

#[test]
fn names_of_real_recordings_are_recognised() {
    let lower = recognised("LASI RASI LPSI RPSI LTHI LKNE LTIB LANK LHEE LTOE RTHI RKNE RTIB RANK RHEE RTOE");
    assert_eq!(lower.sets, ["plug-in-gait"]);
    assert_eq!(lower.markers.len(), 16);
    assert_eq!(lower.on(Landmark::LateralMalleolus, Some(Side::Left)), Some("LANK"));
    assert_eq!(lower.on(Landmark::MedialMalleolus, Some(Side::Left)), None);
    let oxford = recognised(
        "LFHD LBHD RFHD RBHD C7 T2 T6 T10 T12 RBAK CLAV STRN LSHO LELB LWRA LWRB LFIN RSHO RELB RWRA RWRB RFIN SACR \
         RASI LASI \
         LTHI LKNE LHFB LTUB LTIB LSHN LANK LMMA LHEE LCPG LPCA LLCA LSTL LNAV LP1M LD1M LP5M LD5M LTOE LHLX LHJC RHJC \
         LAJC PELO",
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
fn a_landmark_has_the_same_marker_on_both_sides_whatever_the_order_of_the_file() {
    // Exchanged labels: the left heels are named in the other order than the right ones.
    let found =
        recognised("LASI RASI LPSI RPSI LKNE RKNE LANK RANK RHEE RCAL RTOE LCAL LHEE LTOE LNAV RNAV R.Knee L.Knee");
    for side in Side::BOTH {
        let name = if side == Side::Right { "RHEE" } else { "LHEE" };
        assert_eq!(found.on(Landmark::Heel, Some(side)), Some(name));
    }
}

#[test]
fn a_custom_set_adds_to_the_built_in_ones_and_its_landmarks_win() {
    let text = "name = 'mine'\n[[single]]\nnames = 'own knee'\nside = 'right'\nlandmark = 'lateral_epicondyle'\n\
                [[single]]\nnames = 'LTHI'\nside = 'left'\nsegment = 'tibia'";
    let set = MarkerSet::from_toml(text).unwrap();
    let names = ["RASI", "LASI", "SACR", "RKNE", "LKNE", "RANK", "LTHI", "own knee", "nothing"];
    let found = RecognisedMarkers::with(Some(&set), names).unwrap();
    assert_eq!(found.sets[..2], ["mine", "plug-in-gait"]);
    assert_eq!(found.unknown, ["nothing"]);
    let of = |name: &str| landmark(&found, name);
    assert_eq!(of("own knee"), Some((Some(Landmark::LateralEpicondyle), Some(Side::Right))));
    assert_eq!(of("RKNE"), Some((None, Some(Side::Right))), "the second marker on a landmark is technical");
    assert_eq!(of("LKNE"), Some((Some(Landmark::LateralEpicondyle), Some(Side::Left))));
    assert_eq!(of("LTHI"), Some((None, Some(Side::Left))));
    let thigh = found.markers.iter().find(|marker| marker.name == "LTHI").unwrap();
    assert_eq!(thigh.definition.segment, Segment::Tibia);
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
    let unknown = MarkerSet::named("helen").unwrap_err();
    assert!(matches!(unknown, MarkerSetError::Unknown { .. }) && unknown.to_string().contains("plug-in-gait"));
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

/// The landmark of a recorded name.
fn landmark(recognised: &RecognisedMarkers, name: &str) -> Option<(Option<Landmark>, Option<Side>)> {
    let marker = recognised.markers.iter().find(|marker| marker.name == name)?;
    Some((marker.definition.landmark, marker.definition.side))
}

/// The set that fits best, the names of a recording, and the landmarks of some markers on the right.
type Case = (&'static str, &'static str, &'static [(&'static str, Landmark)]);

#[test]
fn names_of_other_laboratories_mean_what_they_say() {
    use Landmark as L;
    let right = Some(Side::Right);
    let cases: [Case; 11] = [
        // OpenCap's laboratory names, as in keenon/nimblephysics data/grf/OpenCapUnfiltered.
        (
            "opencap",
            "r.ASIS L.ASIS r.PSIS L.PSIS r_knee L_knee r_mknee L_mknee r_ankle L_ankle r_mankle L_mankle r_calc L_calc \
             r_toe L_toe \
             r_5meta L_5meta r_sh1 r_sh2 L_sh1 r_thigh1 L_thigh1 C7 R_Shoulder L_Shoulder",
            &[
                ("r_knee", L::LateralEpicondyle),
                ("r_mankle", L::MedialMalleolus),
                ("r_calc", L::Heel),
                ("r_5meta", L::FifthMetatarsal),
            ],
        ),
        (
            "cmu",
            "ARIEL C7 LFSH RFSH LUPA RUPA LELB RELB LIEL RIEL LIWR RIWR CLAV T10 STRN LFWT RFWT LBWT RBWT LMWT RMWT \
             LKNE \
             LKNI RKNE RKNI LSHN RSHN LANK LANI RANK RANI LHEL RHEL LMT5 RMT5 LMT1 RMT1 LTOE RTOE",
            &[("RKNI", L::MedialEpicondyle), ("RANI", L::MedialMalleolus), ("RIEL", L::MedialElbow), ("RHEL", L::Heel)],
        ),
        (
            "words",
            "LFrontAsis RFrontAsis LBackAsis RBackAsis LKneeOut RKneeOut LKneeIn RKneeIn LAnkleOut RAnkleOut LHeel \
             RHeel \
             LMeta5 RMeta5",
            &[("RFrontAsis", L::Asis), ("RBackAsis", L::Psis), ("RKneeIn", L::MedialEpicondyle)],
        ),
        (
            "bones",
            "Hips RightThigh RightLeg RightFoot RightToe LeftThigh LeftLeg LeftFoot LeftToe Spine Neck Head RightArm \
             RightForeArm RightHand LeftArm LeftForeArm LeftHand",
            &[
                ("RightThigh", L::HipCentre),
                ("RightLeg", L::KneeCentre),
                ("RightFoot", L::AnkleCentre),
                ("RightArm", L::ShoulderCentre),
                ("RightHand", L::WristCentre),
            ],
        ),
        (
            "cmu",
            "LFWT RFWT LBWT RBWT LTHI RTHI LKNE RKNE LSHN RSHN LANK RANK LHEE RHEE LTOE RTOE LMT5 RMT5 C7 T10 CLAV \
             STRN",
            &[("RFWT", L::Asis), ("RBWT", L::Psis), ("RKNE", L::LateralEpicondyle), ("RMT5", L::FifthMetatarsal)],
        ),
        (
            "cast",
            "C7 RA LA L5 RPSIS LPSIS RASIS LASIS RGT LGT RLE LLE RME LME RHF LHF RTT LTT RLM LLM RMM LMM RCA LCA RVMH \
             LVMH RIMH LIMH RIIT LIIT",
            &[
                ("RA", L::Acromion),
                ("RVMH", L::FifthMetatarsal),
                ("RIMH", L::FirstMetatarsal),
                ("RIIT", L::SecondToe),
                ("RCA", L::Heel),
            ],
        ),
        (
            "rajagopal",
            "RASI LASI RPSI LPSI RLFC RMFC LLFC LMFC RLMAL RMMAL LLMAL LMMAL RCAL LCAL RMT1 RMT2 LMT1 LMT2 RTH1 RTB1",
            &[("RMT1", L::FirstMetatarsal), ("RMT2", L::SecondToe), ("RCAL", L::Heel)],
        ),
        (
            "plug-in-gait",
            "LASI RASI LPSI RPSI LTHI LKNE LTHAP LTHAD LTIB LANK LTIAP LTIAD LHEE LSMH LFMH LVMH RTHI RKNE RTIB RANK \
             RHEE RSMH RFMH RVMH",
            &[("RSMH", L::SecondToe), ("RFMH", L::FirstMetatarsal), ("RVMH", L::FifthMetatarsal)],
        ),
        (
            "human-body-model",
            "LASIS RASIS LPSIS RPSIS LGTRO RGTRO LLEK RLEK LMEK RMEK LATI RATI LLM RLM LMM RMM LHEE RHEE LTOE RTOE \
             LMT5 RMT5 XYPH NAVE SACR",
            &[("RLEK", L::LateralEpicondyle), ("RMEK", L::MedialEpicondyle), ("RLM", L::LateralMalleolus)],
        ),
        (
            "gait2392",
            "asis_R asis_L psis_R psis_L Knee.Lat_R Knee.Lat_L Knee.Med_R Ankle.Lat_R Ankle.Lat_L Heel_R Heel_L \
             Toe.Tip_R Toe.Tip_L",
            &[("Knee.Lat_R", L::LateralEpicondyle), ("Heel_R", L::Heel), ("Toe.Tip_R", L::Hallux)],
        ),
        (
            "words",
            "front-waist-right front-waist-left back-waist-right back-waist-left Lateral-Knee-Right Lateral-Knee-Left \
             Medial-Knee-Right \
             lateral-malleolus-right lateral-malleolus-left Calcaneus-right Calcaneus-left first-metatarsal-head-right \
             5th-met-right",
            &[
                ("front-waist-right", L::Asis),
                ("Lateral-Knee-Right", L::LateralEpicondyle),
                ("Medial-Knee-Right", L::MedialEpicondyle),
                ("Calcaneus-right", L::Heel),
                ("5th-met-right", L::FifthMetatarsal),
            ],
        ),
    ];
    for (set, names, meanings) in cases {
        let found = recognised(names);
        assert_eq!(found.sets[0], set, "{names}: {:?}", found.sets);
        for (name, meaning) in meanings {
            assert_eq!(landmark(&found, name), Some((Some(*meaning), right)), "{name} in {names}");
        }
        assert!(found.unknown.len() <= 1, "{set}: {:?}", found.unknown);
    }
    let bts = MarkerSet::recognise([
        "c7", "r should", "l should", "sacrum", "r asis", "l asis", "r bar 1", "r knee 1", "r mall", "l met",
    ]);
    let bts = bts.unwrap();
    assert_eq!(bts.sets, ["bts"]);
    assert_eq!(landmark(&bts, "r mall"), Some((Some(L::LateralMalleolus), right)));
}

#[test]
fn a_prefix_of_the_subject_does_not_hide_the_names() {
    let found = recognised("P01_LASI P01_RASI P01_LPSI P01_RPSI P01_LKNE P01_RKNE P01_LANK P01_RANK P01_LHEE P01_RTOE");
    assert_eq!(found.sets, ["plug-in-gait"]);
    assert_eq!(found.on(Landmark::Asis, Some(Side::Left)), Some("P01_LASI"));
    let one_sided = recognised("R_knee R_ankle R_calc R_toe R_mknee R_mankle R_5meta");
    assert_eq!(one_sided.on(Landmark::Heel, Some(Side::Right)), Some("R_calc"));
}

#[test]
fn computed_points_and_bare_sides_have_no_meaning() {
    let found =
        recognised("LASI RASI LPSI RPSI LKNE RKNE LANK RANK RHJC LHJC RTIB0 RTIB1 RTIB2 RTIB3 R L CentreOfMass");
    assert_eq!(found.unknown, ["RHJC", "LHJC", "RTIB0", "RTIB1", "RTIB2", "RTIB3", "R", "L", "CentreOfMass"]);
    let error =
        MarkerSet::recognise(["Marker_1", "Marker_2", "Marker_3", "Marker_4", "Marker_5"]).unwrap_err().to_string();
    assert!(error.contains("at most 0 belong to one set"), "{error}");
}
