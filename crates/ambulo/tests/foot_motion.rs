//! Strikes and offs from markers of a walk whose events are known, and the comparison of lists of events.

use crate::marker_walk::{SPEED_M_S, STRIDE_S, events, walk};
use crate::plate_files;
use ambulo::analysis::event_agreement;
use ambulo::findings::{Code, Findings};
use ambulo::ground::foot_motion::{FootMotion, foot_motion};
use ambulo::ground::phases::{Contact, contacts_from_events};
use ambulo::model::Side;
use ambulo::motion::{Event, EventKind, MarkerRecording, events_from_c3d};
use ambulo::spatial::Vec3;

fn found(markers: &MarkerRecording) -> FootMotion {
    foot_motion(markers, &mut Findings::default())
}

#[test]
fn every_method_detects_every_event_of_a_plain_walk() {
    let found = found(&walk());
    assert_eq!(found.by_method.len(), 4);
    // The synthetic foot is as slow as the pelvis 0.05 s before foot strike, and accelerates most 0.21 of its swing,
    // 0.09 s, after foot off: single methods have errors of that size, their median half of it.
    let all = found.by_method.iter().map(|(m, e)| (*m, e)).chain([("together", &found.events)]);
    for (name, list) in all {
        for row in event_agreement(&events(), list) {
            assert!(row.missed == 0 && row.extra == 0 && row.mean_absolute_ms < 100.0, "{name}: {row:?}");
        }
    }
    for row in event_agreement(&events(), &found.events) {
        assert!(row.mean_absolute_ms < 50.0, "{row:?}");
    }
    assert!((found.walking_speed_m_s - SPEED_M_S).abs() < 0.02, "{}", found.walking_speed_m_s);
    assert!(found.floor_speed_m_s.abs() < 0.02, "{}", found.floor_speed_m_s);
}

#[test]
fn a_treadmill_changes_nothing_but_the_speed_of_the_floor() {
    let ground = found(&walk());
    let mut markers = walk();
    for marker in &mut markers.markers {
        for (position, t) in marker.positions.iter_mut().zip(&markers.times) {
            position.x -= SPEED_M_S * t;
        }
    }
    let belt = found(&markers);
    assert!((belt.floor_speed_m_s + SPEED_M_S).abs() < 0.02, "{}", belt.floor_speed_m_s);
    assert!((belt.walking_speed_m_s - SPEED_M_S).abs() < 0.02, "{}", belt.walking_speed_m_s);
    assert_eq!(belt.events.len(), ground.events.len());
    for (a, b) in belt.events.iter().zip(&ground.events) {
        assert!((a.time_s - b.time_s).abs() < 1e-3 && a.side == b.side && a.kind == b.kind, "{a:?} {b:?}");
    }
}

#[test]
fn swapped_sides_swap_the_events() {
    let straight = found(&walk());
    let mut markers = walk();
    for marker in &mut markers.markers {
        let other = if marker.name.starts_with('R') { "L" } else { "R" };
        if marker.name != "SACR" {
            marker.name.replace_range(..1, other);
        }
        marker.positions.iter_mut().for_each(|p| p.z = -p.z);
    }
    let swapped = found(&markers);
    let of = |list: &[Event], side| list.iter().filter(|e| e.side == side).map(|e| e.time_s).collect::<Vec<_>>();
    assert_eq!(of(&straight.events, Side::Right), of(&swapped.events, Side::Left));
    assert_eq!(of(&straight.events, Side::Left), of(&swapped.events, Side::Right));
}

#[test]
fn contacts_begin_and_end_with_the_events() {
    let found = found(&walk());
    // The left foot is in stance at the beginning and at the end of the recording.
    let left = found.contacts_of(Side::Left);
    assert!(left[0].strike_s.is_none() && left[0].off_s.is_some(), "{left:?}");
    for pair in left.windows(2) {
        let stride = pair[1].strike_s.unwrap() - pair[0].strike_s.unwrap_or(pair[1].strike_s.unwrap() - STRIDE_S);
        assert!((stride - STRIDE_S).abs() < 0.02, "{left:?}");
    }
    assert!(found.contacts_of(Side::Right).len() >= 3);
}

#[test]
fn a_short_gap_is_interpolated_and_a_long_one_only_hides_its_own_events() {
    let whole = found(&walk());
    let hidden = |from_s: f64, to_s: f64| {
        let mut markers = walk();
        let times = markers.times.clone();
        for (position, t) in markers.markers[3].positions.iter_mut().zip(&times) {
            if (from_s..to_s).contains(t) {
                *position = Vec3::repeat(f64::NAN);
            }
        }
        found(&markers)
    };
    assert_eq!(hidden(1.7, 1.85).events.len(), whole.events.len());
    let long = hidden(1.2, 1.9);
    assert!(long.events.len() >= whole.events.len() - 2, "{:?}", long.events);
    assert!(long.events.iter().filter(|e| e.side == Side::Left).count() >= 5);
}

#[test]
fn a_standing_person_has_both_feet_on_the_ground_and_no_events() {
    let mut markers = walk();
    for marker in &mut markers.markers {
        let place = marker.positions[80];
        marker.positions.fill(place);
    }
    let found = found(&markers);
    assert!(found.events.is_empty() && found.by_method.is_empty(), "{:?}", found.events);
    for side in Side::BOTH {
        assert_eq!(found.contacts_of(side), [Contact { strike_s: None, off_s: None }]);
    }
}

#[test]
fn feet_without_markers_are_reported() {
    let mut markers = walk();
    markers.markers.retain(|m| !m.name.starts_with("RTOE") && !m.name.starts_with("RHEE"));
    let mut findings = Findings::default();
    let found = foot_motion(&markers, &mut findings);
    assert!(findings.has(Code::EventsNoFootMarkers));
    assert_eq!(found.feet_without_markers, [Side::Right]);
    assert!(found.contacts_of(Side::Right).is_empty() && !found.contacts_of(Side::Left).is_empty());
    // An empty recording is accepted.
    markers.markers.clear();
    assert!(foot_motion(&markers, &mut findings).events.is_empty());
}

fn event(side: Side, kind: EventKind, time_s: f64) -> Event {
    Event { side, kind, time_s }
}

#[test]
fn events_become_contacts_and_doubled_ones_are_ignored() {
    use EventKind::{Off, Strike};
    let right = |kind, t| event(Side::Right, kind, t);
    let list = [
        right(Off, 0.2),
        right(Strike, 0.6),
        event(Side::Left, Strike, 0.65),
        right(Strike, 0.7),
        right(Off, 1.2),
        right(Off, 1.3),
        right(Strike, 1.6),
    ];
    let contact = |strike_s, off_s| Contact { strike_s, off_s };
    let expected = [contact(None, Some(0.2)), contact(Some(0.6), Some(1.2)), contact(Some(1.6), None)];
    assert_eq!(contacts_from_events(&list, Side::Right), expected);
    // What the recording cuts ends with it.
    let is = |found: [f64; 2], expected: [f64; 2]| (0..2).all(|i| (found[i] - expected[i]).abs() < 1e-12);
    assert!(is(expected[0].span(0.0, 9.0), [0.0, 0.2]) && is(expected[2].span(0.0, 9.0), [1.6, 9.0]));
}

#[test]
fn the_comparison_pairs_the_closest_events_and_counts_the_rest() {
    use EventKind::{Off, Strike};
    let (r, l) = (Side::Right, Side::Left);
    let reference = [event(r, Strike, 1.0), event(l, Strike, 1.5), event(r, Strike, 2.0), event(r, Off, 1.6)];
    let found = [
        event(r, Strike, 1.02),
        event(r, Strike, 0.9), // the second nearest
        event(l, Strike, 1.46),
        event(l, Strike, 2.0), // of the other foot
        event(l, Strike, 3.0), // beyond the reference
        event(r, Off, 1.9),    // too far
    ];
    let [strikes, offs] = event_agreement(&reference, &found);
    assert_eq!((strikes.pairs, strikes.missed, strikes.extra), (2, 1, 2), "{strikes:?}");
    assert!((strikes.mean_absolute_ms - 30.0).abs() < 1e-9 && (strikes.bias_ms + 10.0).abs() < 1e-9, "{strikes:?}");
    assert_eq!((offs.pairs, offs.missed, offs.extra), (0, 1, 0), "{offs:?}");
    assert!(offs.mean_absolute_ms.is_nan());
}

#[test]
fn events_of_a_file_are_read_with_their_side() {
    let listed = ambulo_formats::c3d::Event::new;
    let mut file = plate_record();
    file.events = vec![
        listed("Foot Off", "Right", 2.5),
        listed("Foot Strike", "Left", 1.0),
        listed("LHS", "", 1.0004), // of the header, which some programs repeat
        listed("RHS", "", 1.5),
        listed("LTO", "", 1.7),
        listed("Event", "General", 0.1),
        listed("Foot Strike", "General", 0.2),
    ];
    let mut findings = Findings::default();
    let found = events_from_c3d(&file, &mut findings);
    let expected = [
        event(Side::Left, EventKind::Strike, 1.0),
        event(Side::Right, EventKind::Strike, 1.5),
        event(Side::Left, EventKind::Off, 1.7),
        event(Side::Right, EventKind::Off, 2.5),
    ];
    assert_eq!(found, expected);
    assert_eq!(findings.as_slice().len(), 2, "{findings:?}");
}

fn plate_record() -> ambulo_formats::c3d::C3d {
    plate_files::File::step(2, [0.0; 3], &[0.0, 0.0, -700.0, 0.0, 0.0, 0.0]).record()
}
