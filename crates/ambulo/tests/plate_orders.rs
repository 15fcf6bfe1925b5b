//! Force plates whose corners, signs or loads are wrong in the file, in a walk whose steps are known.

use crate::marker_walk::{Load, SPEED_M_S, place, plate, stances, walk};
use ambulo::findings::{Code, Findings};
use ambulo::ground::foot_motion::foot_motion;
use ambulo::ground::plates::{ContactQuality, feet_on_plates, plates_under_feet};
use ambulo::model::Side;
use ambulo::motion::PlateRecording;
use ambulo::motion::force_plate::CORNER_ORDERS;
use ambulo::spatial::Vec3;

const R: Side = Side::Right;
const L: Side = Side::Left;

/// The plate with forces that lead from the centre of pressure to the middle of the pelvis, as those of a walk.
fn through_the_pelvis(mut plate: PlateRecording) -> PlateRecording {
    for i in 0..plate.times.len() {
        if plate.is_loaded(i) {
            let (pressure, vertical) = (plate.center_of_pressure(i), plate.vertical(i));
            let arm = Vec3::new(SPEED_M_S * plate.times[i], 1.0, 0.0) - pressure;
            plate.force[i] = arm * (vertical / arm.y);
            plate.moment[i] = pressure.cross(&plate.force[i]);
        }
    }
    plate
}

/// Two plates of 0.5 x 0.6 m, under the right foot's second stance and the left foot's that follows; the feet are not
/// in their middle, nor on its lines of symmetry, on which a mirrored order leaves them.
fn two_plates() -> Vec<PlateRecording> {
    let under = |(name, side): (&str, Side)| {
        let p = place(side, 1);
        let made = plate([p.x - 0.27, p.z - 0.35], [p.x + 0.23, p.z + 0.25], 0.0, &[Load::whole(side, 1)]);
        through_the_pelvis(PlateRecording { name: name.to_owned(), ..made })
    };
    [("plate 1", R), ("plate 2", L)].map(under).to_vec()
}

fn read(plates: Vec<PlateRecording>) -> (Vec<PlateRecording>, Findings) {
    let (markers, mut findings) = (walk(), Findings::default());
    let motion = foot_motion(&markers, &mut findings);
    (plates_under_feet(&markers, plates, &motion, &mut findings), findings)
}

/// Largest difference of forces [N] and moments [N.m].
fn off(a: &PlateRecording, b: &PlateRecording) -> f64 {
    let pairs = a.force.iter().zip(&b.force).chain(a.moment.iter().zip(&b.moment));
    pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}

#[test]
fn a_plate_read_in_an_order_and_back_is_the_same_plate() {
    for plate in two_plates() {
        for order in CORNER_ORDERS {
            let mut back = [0; 4];
            order.iter().enumerate().for_each(|(place, corner)| back[*corner] = place);
            let again = plate.with_corners(order).unwrap().with_corners(back).unwrap();
            assert!(off(&again, &plate) < 1e-9, "{order:?}");
            assert!((again.corners[0] - plate.corners[0]).norm() < 1e-12);
        }
        // A quarter to the left, seen from above, is the plate with its axes one corner further back.
        let turned = [1, 2, 3].map(|quarters| plate.turned(quarters));
        let orders = [1, 2, 3].map(|k| plate.with_corners(CORNER_ORDERS[k]).unwrap());
        let matches = turned.iter().filter(|t| orders.iter().any(|order| off(t, order) < 1e-9)).count();
        assert_eq!(matches, 3);
    }
}

#[test]
fn corners_in_any_of_the_eight_orders_are_put_in_the_one_that_puts_the_loads_under_the_feet() {
    let clean = two_plates();
    let (same, findings) = read(clean.clone());
    assert_eq!(same, clean);
    assert!(findings.as_slice().is_empty(), "{findings:?}");
    for (k, order) in CORNER_ORDERS.into_iter().enumerate().skip(1) {
        let spoiled: Vec<PlateRecording> = clean.iter().map(|plate| plate.with_corners(order).unwrap()).collect();
        let (mended, findings) = read(spoiled);
        for (mended, clean) in mended.iter().zip(&clean) {
            assert!(off(mended, clean) < 1e-6, "order {k}: {} {findings:?}", off(mended, clean));
        }
        let message = &findings.as_slice().iter().find(|f| f.code == Code::PlatesCornersOrdered).unwrap().message;
        assert!(message.contains("of the eight orders of four corners") && message.contains("CORNERS"), "{message}");
    }
}

#[test]
fn one_plate_with_turned_corners_leaves_the_other_as_it_is() {
    let clean = two_plates();
    let spoiled = vec![clean[0].clone(), clean[1].with_corners(CORNER_ORDERS[2]).unwrap()];
    let (mended, findings) = read(spoiled);
    assert_eq!(mended[0], clean[0]);
    assert!(off(&mended[1], &clean[1]) < 1e-6, "{findings:?}");
    assert_eq!(findings.as_slice().len(), 1, "{findings:?}");
}

#[test]
fn a_flipped_channel_changes_the_moment_by_its_lever_and_flipping_it_again_restores_the_plate() {
    let mut plate = two_plates().remove(0);
    plate.center_from_sensors = Vec3::new(0.0, 0.04, 0.0);
    let flipped = plate.flipped(1);
    let [x, y] = plate.axes().unwrap();
    let loaded = (0..plate.times.len()).find(|i| plate.vertical(*i) > 300.0).unwrap();
    let (f, g) = (plate.force[loaded], flipped.force[loaded]);
    assert!((f.dot(&x) - g.dot(&x)).abs() < 1e-12 && (f.dot(&y) + g.dot(&y)).abs() < 1e-12);
    // The sensors are 40 mm below the surface: the moment about them is unchanged, M - F × o.
    let about_sensors =
        |p: &PlateRecording| p.moment_about_center(loaded) - p.force[loaded].cross(&p.center_from_sensors);
    assert!((about_sensors(&plate) - about_sensors(&flipped)).norm() < 1e-9);
    assert!((flipped.moment_about_center(loaded) - plate.moment_about_center(loaded)).norm() > 0.1);
    assert!(off(&flipped.flipped(1), &plate) < 1e-9);
}

/// The second plate shows 25 N, or a share of the other plate's load, while the first one is loaded.
fn with_cross_talk(talk_n: impl Fn(f64) -> f64) -> Vec<PlateRecording> {
    let mut plates = two_plates();
    let talk: Vec<f64> = (0..plates[0].times.len()).map(|i| plates[0].vertical(i)).map(talk_n).collect();
    let center = plates[1].center();
    for (i, talk) in talk.iter().enumerate() {
        let force = Vec3::y() * *talk;
        plates[1].force[i] += force;
        plates[1].moment[i] += center.cross(&force);
    }
    plates
}

#[test]
fn cross_talk_of_a_neighbouring_plate_is_no_load() {
    let constant = with_cross_talk(|load| if load > 20.0 { 25.0 } else { 0.0 });
    let share = with_cross_talk(|load| 0.045 * load);
    for spoiled in [constant, share] {
        let (plates, findings) = read(spoiled);
        assert!(findings.has(Code::PlatesCrossTalk), "{findings:?}");
        let markers = walk();
        let motion = foot_motion(&markers, &mut Findings::default());
        let feet = feet_on_plates(&markers, &plates, &motion, &[], &mut Findings::default());
        let found: Vec<_> = feet.contacts.iter().map(|c| (c.plate, c.side, c.quality)).collect();
        assert_eq!(found, [(0, Some(R), ContactQuality::Clean), (1, Some(L), ContactQuality::Clean)], "{feet:?}");
        let (_, strike, off) = stances(L)[2];
        let contact = &feet.contacts[1];
        assert!((contact.start_s - strike).abs() < 0.02 && (contact.end_s - off).abs() < 0.02, "{contact:?}");
    }
    // Less than a load: it follows the step on the other plate.
    let (_, findings) = read(with_cross_talk(|load| 0.025 * load));
    assert!(findings.has(Code::PlatesCrossTalk), "{findings:?}");
    // A light foot on the plate is a load.
    let (light, findings) = read(vec![two_plates().remove(0), {
        let p = place(L, 1);
        let load = Load { share: 0.04, ..Load::whole(L, 1) };
        plate([p.x - 0.2, p.z - 0.15], [p.x + 0.3, p.z + 0.15], 0.0, &[load])
    }]);
    assert!(!findings.has(Code::PlatesCrossTalk) && light[1].peak_n() > 20.0, "{findings:?}");
}
