//! Assignment of force plates to feet, in a walk whose steps are known.

use crate::free_bodies::{DOWN_Y, free_bodies};
use crate::marker_walk::{Load, climb, place, plate, plate_under, stair, stances, walk};
use ambulo::findings::{Code, Findings};
use ambulo::ground::foot_motion::foot_motion;
use ambulo::ground::plates::{ContactQuality, FeetOnPlates, feet_on_plates};
use ambulo::model::{BodyId, BySide, Side};
use ambulo::motion::{MarkerRecording, PlateRecording};
use ambulo::spatial::Vec3;

const R: Side = Side::Right;
const L: Side = Side::Left;

fn judge(markers: &MarkerRecording, plates: &[PlateRecording], assigned: &[(usize, Side)]) -> (FeetOnPlates, Findings) {
    let mut findings = Findings::default();
    let motion = foot_motion(markers, &mut findings);
    let feet = feet_on_plates(markers, plates, &motion, assigned, &mut findings);
    (feet, findings)
}

/// Two plates, under the right foot's second stance and the left foot's that follows.
fn two_plates() -> Vec<PlateRecording> {
    vec![plate_under(R, 1, &[Load::whole(R, 1)]), plate_under(L, 1, &[Load::whole(L, 1)])]
}

#[test]
fn a_foot_on_a_plate_of_its_own_is_clean() {
    let (feet, findings) = judge(&walk(), &two_plates(), &[]);
    let assigned: Vec<_> = feet.contacts.iter().map(|c| (c.plate, c.side, c.quality)).collect();
    assert_eq!(assigned, [(0, Some(R), ContactQuality::Clean), (1, Some(L), ContactQuality::Clean)], "{feet:?}");
    assert!(findings.as_slice().is_empty(), "{findings:?}");
    let (_, strike, off) = stances(R)[2];
    let contact = &feet.contacts[0];
    assert!((contact.start_s - strike).abs() < 0.003 && (contact.end_s - off).abs() < 0.003, "{contact:?}");
    assert!((contact.peak_n - 700.0).abs() < 1.0 && contact.distance_m < 0.02, "{contact:?}");
}

#[test]
fn the_instrumented_window_is_the_time_without_a_foot_off_the_plates() {
    let (feet, _) = judge(&walk(), &two_plates(), &[]);
    // From the off of the left foot before its plate to the strike of the right foot after its plate.
    let (from, to) = (stances(L)[1].2, stances(R)[3].1);
    assert_eq!(feet.windows.len(), 1, "{:?}", feet.windows);
    // Both ends are events from motion, of a foot that stops 0.05 s before its stance.
    assert!((feet.windows[0][0] - from).abs() < 0.06 && (feet.windows[0][1] - to).abs() < 0.06, "{:?}", feet.windows);
    // One plate alone: until the other foot's strike.
    let (one, _) = judge(&walk(), &two_plates()[..1], &[]);
    assert!((one.windows[0][1] - stances(L)[2].1).abs() < 0.06, "{:?}", one.windows);
}

#[test]
fn two_feet_on_one_plate_are_reported_and_the_load_is_assigned_to_neither() {
    let (a, b) = (place(R, 1), place(L, 1));
    let big = plate([a.x - 0.3, -0.4], [b.x + 0.4, 0.4], 0.0, &[Load::whole(R, 1), Load::whole(L, 1)]);
    let (feet, findings) = judge(&walk(), std::slice::from_ref(&big), &[]);
    assert_eq!(feet.contacts.len(), 1);
    assert_eq!(feet.contacts[0].quality, ContactQuality::TwoFeet, "{feet:?}");
    assert!(findings.has(Code::PlatesTwoFeet) && findings.has(Code::PlatesNoWindow));
    let bodies = two_bodies();
    assert!(feet.recordings(std::slice::from_ref(&big), bodies).is_empty());
    // The user may assign the plate.
    let (assigned, _) = judge(&walk(), std::slice::from_ref(&big), &[(0, L)]);
    assert_eq!(assigned.contacts[0].side, Some(L));
    assert_eq!(assigned.recordings(&[big], bodies)[0].body, bodies.left);
}

/// Four steps, each on a plate that reaches under the next step, on stairs of this rise [m].
fn four_stairs(rise_m: f64) -> Vec<PlateRecording> {
    let steps = [(R, 0), (L, 0), (R, 1), (L, 1)];
    let under = |(side, k): (Side, i32)| {
        let x = place(side, k).x;
        plate([x - 0.2, -0.4], [x + 1.0, 0.4], stair(side, k, rise_m), &[Load::whole(side, k)])
    };
    steps.into_iter().map(under).collect()
}

#[test]
fn a_foot_on_the_next_step_of_stairs_is_not_on_the_plate_below() {
    const RISE_M: f64 = 0.195;
    let (up, findings) = judge(&climb(RISE_M), &four_stairs(RISE_M), &[]);
    let sides: Vec<_> = up.contacts.iter().map(|c| (c.side, c.quality)).collect();
    let clean = |side| (Some(side), ContactQuality::Clean);
    assert_eq!(sides, [clean(R), clean(L), clean(R), clean(L)], "{up:?}");
    assert!(!findings.has(Code::PlatesTwoFeet) && !up.windows.is_empty(), "{findings:?}");
    // Down the same stairs, with the time reversed: the foot on the step below does not count either.
    let mut down = climb(RISE_M);
    let mut plates = four_stairs(RISE_M);
    let last = down.times[down.frames() - 1];
    down.markers.iter_mut().for_each(|marker| marker.positions.reverse());
    for plate in &mut plates {
        assert!((plate.times[plate.times.len() - 1] - last).abs() < 1e-9);
        plate.force.reverse();
        plate.moment.reverse();
    }
    let (down, _) = judge(&down, &plates, &[]);
    assert!(down.contacts.iter().all(|c| c.quality != ContactQuality::TwoFeet), "{down:?}");
    let sides: Vec<_> = down.contacts.iter().map(|c| c.side).collect();
    assert_eq!(sides, [Some(R), Some(L), Some(R), Some(L)], "{down:?}");
    // The same plates on level ground carry two feet.
    let (level, findings) = judge(&climb(0.0), &four_stairs(0.0), &[]);
    assert!(level.contacts.iter().all(|c| c.quality == ContactQuality::TwoFeet), "{level:?}");
    assert!(findings.has(Code::PlatesTwoFeet));
}

#[test]
fn a_force_that_ends_before_foot_off_is_partial() {
    let early = Load { to: 0.55, ..Load::whole(L, 1) };
    let plates = [two_plates()[0].clone(), plate_under(L, 1, &[early])];
    let (feet, findings) = judge(&walk(), &plates, &[]);
    let left = &feet.contacts[1];
    assert_eq!((left.side, left.quality), (Some(L), ContactQuality::Partial), "{left:?}");
    assert!(left.reason.contains("before the foot left the floor"), "{}", left.reason);
    assert!(findings.has(Code::PlatesPartial));
    assert!(feet.windows.iter().all(|w| w[1] <= stances(L)[2].1 + 0.06), "{:?}", feet.windows);
    let late = Load { from: 0.4, ..Load::whole(L, 1) };
    let (feet, _) = judge(&walk(), &[plate_under(L, 1, &[late])], &[]);
    assert!(feet.contacts[0].reason.contains("before the force"), "{:?}", feet.contacts);
}

#[test]
fn a_foot_over_the_edge_is_partial_and_with_the_next_plate_shared() {
    let p = place(R, 1);
    // An edge in the middle of the foot, half of the load on either side.
    let half = Load { share: 0.5, ..Load::whole(R, 1) };
    let (behind, ahead) = (
        plate([p.x - 0.4, -0.1], [p.x + 0.04, 0.3], 0.0, &[half]),
        plate([p.x + 0.04, -0.1], [p.x + 0.5, 0.3], 0.0, &[half]),
    );
    let (alone, findings) = judge(&walk(), std::slice::from_ref(&behind), &[]);
    assert_eq!(alone.contacts[0].quality, ContactQuality::Partial);
    assert!(alone.contacts[0].reason.contains("toe was 100 mm beyond the edge"), "{:?}", alone.contacts);
    assert!(findings.has(Code::PlatesPartial));
    let (both, findings) = judge(&walk(), &[behind, ahead], &[]);
    assert!(both.contacts.iter().all(|c| c.quality == ContactQuality::Shared && c.side == Some(R)), "{both:?}");
    assert!(findings.has(Code::PlatesShared) && !findings.has(Code::PlatesPartial));
    assert!(!both.windows.is_empty());
}

#[test]
fn a_load_far_from_both_feet_is_not_assigned() {
    // The load of the right foot, two metres to the side.
    let mut plate = plate_under(R, 1, &[Load::whole(R, 1)]);
    let aside = Vec3::new(0.0, 0.0, 2.0);
    plate.corners = plate.corners.map(|c| c + aside);
    for (moment, force) in plate.moment.iter_mut().zip(&plate.force) {
        *moment += aside.cross(force);
    }
    let (feet, findings) = judge(&walk(), &[plate], &[]);
    assert_eq!((feet.contacts[0].side, feet.contacts[0].quality), (None, ContactQuality::Unassigned));
    assert!(findings.has(Code::PlatesUnassigned) && feet.contacts[0].reason.contains("no foot is near"));
}

#[test]
fn a_foot_with_hidden_markers_is_identified_by_its_stance() {
    let mut markers = walk();
    let (_, strike, off) = stances(R)[2];
    let times = markers.times.clone();
    for marker in markers.markers.iter_mut().filter(|m| m.name == "RTOE") {
        for (position, t) in marker.positions.iter_mut().zip(&times) {
            if (strike - 0.02..off - 0.2).contains(t) {
                *position = Vec3::repeat(f64::NAN);
            }
        }
    }
    let (feet, _) = judge(&markers, &two_plates(), &[]);
    assert_eq!(feet.contacts[0].side, Some(R), "{:?}", feet.contacts);
}

#[test]
fn recordings_contain_all_that_each_plate_measured() {
    // One plate that both feet use, one after the other, and one for the left foot alone at another height.
    let a = place(R, 0);
    let shared = plate([a.x - 0.5, -0.4], [a.x + 3.0, 0.4], 0.0, &[Load::whole(R, 0), Load::whole(L, 2)]);
    let alone = plate([place(L, 1).x - 0.2, -0.3], [place(L, 1).x + 0.3, 0.1], 0.1, &[Load::whole(L, 1)]);
    let plates = [shared, alone];
    let (feet, _) = judge(&walk(), &plates, &[(1, L)]);
    let bodies = two_bodies();
    let forced: Vec<_> = feet.contacts.iter().map(|c| (c.plate, c.side, c.quality)).collect();
    assert_eq!(forced.len(), 3, "{forced:?}");
    let recordings = feet.recordings(&plates, bodies);
    for (i, &t) in plates[0].times.iter().enumerate() {
        let expected: Vec3 = plates.iter().map(|p| p.force[i]).sum();
        let given: Vec3 = recordings.iter().map(|r| r.force[i]).sum();
        let moment: Vec3 = recordings.iter().map(|r| r.point[i].cross(&r.force[i]) + r.moment[i]).sum();
        let measured: Vec3 = plates.iter().map(|p| p.moment[i]).sum();
        let whose = feet.contacts.iter().filter(|c| c.quality != ContactQuality::TwoFeet);
        if whose.clone().any(|c| c.start_s < t && t < c.end_s) || expected.norm() < 1.0 {
            assert!((expected - given).norm() < 1e-9 && (moment - measured).norm() < 1e-9, "{t}");
        }
    }
}

#[test]
fn light_contacts_next_to_a_real_step_are_vibration() {
    let touch = Load { share: 0.04, ..Load::whole(L, 1) };
    let plates = [two_plates()[0].clone(), plate_under(L, 1, &[touch])];
    let (feet, _) = judge(&walk(), &plates, &[]);
    assert_eq!(feet.contacts.len(), 1, "{:?}", feet.contacts);
}

/// Bodies of a right and a left foot.
fn two_bodies() -> BySide<BodyId> {
    let ids: Vec<BodyId> = free_bodies(DOWN_Y, &[("calcn_r", 1.0), ("calcn_l", 1.0)]).body_ids().collect();
    BySide { right: ids[0], left: ids[1] }
}

#[test]
fn events_are_from_force_where_measured_and_from_motion_elsewhere() {
    let markers = walk();
    let motion = foot_motion(&markers, &mut Findings::default());
    let (feet, _) = judge(&markers, &two_plates(), &[]);
    let by_force = feet.force_events([0.0, 4.0]);
    assert_eq!(by_force.len(), 4, "{by_force:?}");
    let all = feet.events(&motion, [0.0, 4.0]);
    assert_eq!(all.len(), motion.events.len(), "{all:?}");
    for event in &by_force {
        assert!(all.contains(event) && !motion.events.contains(event), "{event:?}");
    }
    for pair in all.windows(2) {
        assert!(pair[0].time_s <= pair[1].time_s);
    }
    // A contact that the recording cuts has no event there.
    assert_eq!(feet.force_events([by_force[0].time_s, 4.0]).len(), 3);
}
