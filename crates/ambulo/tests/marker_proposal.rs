//! Proposals for markers with unknown names: hidden names of real recordings are found again by position.

use crate::shared_data;
use ambulo::findings::Findings;
use ambulo::kinematics::marker_proposal::{MarkerProposals, markers_at_joints, propose_markers};
use ambulo::model::Side;
use ambulo::model::marker_set::{Landmark, MarkerSet, RecognisedMarkers, marker_template};
use ambulo::motion::{Heading, MarkerPath, MarkerRecording};
use ambulo::study::LaboratoryFile;

/// Markers of a recording in world axes.
fn recording(name: &str) -> Option<MarkerRecording> {
    let bytes = std::fs::read(shared_data::data()?.join(name)).unwrap();
    let mut findings = Findings::default();
    let file = LaboratoryFile::from_c3d(bytes, name, &mut findings).unwrap();
    Some(file.recording.in_world(&mut findings).1.markers)
}

/// The recording with other names for some markers.
fn renamed(recording: &MarkerRecording, hidden: &[(&str, &str)]) -> MarkerRecording {
    let mut renamed = recording.clone();
    for (name, new) in hidden {
        renamed.markers.iter_mut().find(|m| m.name == *name).unwrap().name = (*new).to_owned();
    }
    renamed
}

fn recognised(recording: &MarkerRecording) -> RecognisedMarkers {
    MarkerSet::recognise(recording.markers.iter().map(|m| m.name.as_str())).unwrap()
}

/// The meaning that a marker got.
fn meaning(found: &MarkerProposals, name: &str) -> Option<(Option<Landmark>, Option<Side>)> {
    let marker = found.markers.iter().find(|marker| marker.name == name)?;
    Some((marker.definition.landmark, marker.definition.side))
}

#[test]
fn hidden_names_of_a_walk_are_found_again_by_position() {
    let Some(walk) = recording("motonms-unipd/Walking1.c3d") else { return };
    let hidden = [("RME", "m01"), ("LMM", "m02"), ("RCA", "m03"), ("LVMH", "m04"), ("C7", "m05"), ("RHF", "m06")];
    let walk = renamed(&walk, &hidden);
    let found = propose_markers(&walk, Some(&recognised(&walk)), Heading::Walking);
    println!("{}", found.statement);
    for (old, new) in hidden {
        println!("{old}: {:?}", meaning(&found, new));
    }
    let side = |right: bool| Some(if right { Side::Right } else { Side::Left });
    assert_eq!(meaning(&found, "m01"), Some((Some(Landmark::MedialEpicondyle), side(true))));
    assert_eq!(meaning(&found, "m02"), Some((Some(Landmark::MedialMalleolus), side(false))));
    assert_eq!(meaning(&found, "m03").unwrap().1, side(true));
    assert_eq!(meaning(&found, "m04").unwrap().1, side(false));
    assert!(found.proposed.len() >= 6 && found.statement.contains("known markers"));
}

#[test]
fn a_standing_person_without_any_known_name_gets_proposals() {
    let Some(standing) = recording("motonms-unipd/Static1.c3d") else { return };
    let mut nameless = standing.clone();
    for (i, marker) in nameless.markers.iter_mut().enumerate() {
        marker.name = format!("m{i:02}");
    }
    let found = propose_markers(&nameless, None, Heading::Facing);
    println!("{}", found.statement);
    let truth = recognised(&standing);
    let mut right_segment = 0;
    for (i, marker) in standing.markers.iter().enumerate() {
        let name = format!("m{i:02}");
        let own = truth.markers.iter().find(|known| known.name == marker.name);
        let new = found.markers.iter().find(|known| known.name == name);
        if let (Some(own), Some(new)) = (own, new) {
            let same = own.definition.segment == new.definition.segment && own.definition.side == new.definition.side;
            right_segment += usize::from(same);
            println!(
                "{} {:?} {:?}: {:?} {:?}",
                marker.name,
                own.definition.segment,
                own.definition.side,
                new.definition.segment,
                new.definition.landmark
            );
        }
    }
    println!("{right_segment} of {}", truth.markers.len());
    assert!(3 * right_segment >= 2 * truth.markers.len(), "{right_segment} of {}", truth.markers.len());
}

#[test]
fn markers_that_a_body_needs_are_found_by_name_and_place_together() {
    let Some(standing) = recording("motonms-unipd/Static1.c3d") else { return };
    let hidden = [("RLE", "x1"), ("LLE", "x2"), ("RLM", "x5"), ("LLM", "x6")];
    let standing = renamed(&standing, &hidden);
    let found = markers_at_joints(&standing, &recognised(&standing));
    for marker in &found {
        println!("{}: {:?} {:?}", marker.name, marker.definition.side, marker.definition.landmark);
    }
    let side = |name: &str| Some(if name.starts_with('R') { Side::Right } else { Side::Left });
    for (name, new) in hidden {
        let marker = found.iter().find(|marker| marker.name == new).unwrap_or_else(|| panic!("{new}"));
        let meaning = match &name[1..] {
            "LE" => Landmark::LateralEpicondyle,
            _ => Landmark::LateralMalleolus,
        };
        assert_eq!((marker.definition.landmark, marker.definition.side), (Some(meaning), side(name)), "{name}");
    }
    let proposed = propose_markers(&standing, Some(&recognised(&standing)), Heading::Facing);
    assert!(proposed.statement.contains("mean build"), "{}", proposed.statement);
    // Nothing is known of a person of whom no name is.
    let nameless = renamed(&standing, &[("RASIS", "y1"), ("LASIS", "y2")]);
    let few = RecognisedMarkers { markers: Vec::new(), ..recognised(&nameless) };
    assert!(markers_at_joints(&nameless, &few).is_empty());
}

#[test]
fn a_template_is_read_back_as_a_set_with_the_same_meaning() {
    let Some(walk) = recording("motonms-unipd/Walking1.c3d") else { return };
    let walk = renamed(&walk, &[("RME", "odd \"name\" \\ 1"), ("LMM", "m02")]);
    let found = propose_markers(&walk, Some(&recognised(&walk)), Heading::Walking);
    let text = marker_template("a walk\nwith two lines", &found.markers, &found.proposed, &found.unknown);
    let set = MarkerSet::from_toml(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let again = RecognisedMarkers::with(Some(&set), walk.markers.iter().map(|m| m.name.as_str())).unwrap();
    for marker in &found.markers {
        let same = again.markers.iter().find(|known| known.name == marker.name).unwrap();
        let (a, b) = (&same.definition, &marker.definition);
        assert_eq!((a.landmark, a.segment, a.side), (b.landmark, b.segment, b.side), "{}", marker.name);
    }
    assert!(text.contains("# proposed by its position; check it\n[[single]]\nnames = \"m02\""), "{text}");
}

#[test]
fn a_recording_without_a_body_gets_no_proposals() {
    let path = |name: &str| MarkerPath { name: name.to_owned(), positions: vec![ambulo::spatial::Vec3::zeros(); 3] };
    let few = MarkerRecording {
        name: "few".to_owned(),
        rate_hz: 100.0,
        times: vec![0.0, 0.01, 0.02],
        markers: ["a", "b", "c"].map(path).to_vec(),
    };
    let found = propose_markers(&few, None, Heading::Unknown);
    assert_eq!((found.markers.len(), found.unknown.len()), (0, 3));
    let empty = MarkerRecording { markers: Vec::new(), times: Vec::new(), ..few };
    assert_eq!(propose_markers(&empty, None, Heading::Unknown).unknown.len(), 0);
}
