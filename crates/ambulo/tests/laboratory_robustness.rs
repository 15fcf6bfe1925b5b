//! Any file content gives a result or an error, never a panic, from the file to feet on plates.

use crate::plate_files::File;
use ambulo::findings::Findings;
use ambulo::ground::foot_motion::foot_motion;
use ambulo::ground::plates::feet_on_plates;
use ambulo::motion::{PlateSettings, events_from_c3d, laboratory, markers_from_c3d, plates_from_c3d};
use ambulo_formats::c3d::{C3d, Event, Point};
use proptest::prelude::*;

/// Unusual numbers in files.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        6 => -2000.0..2000.0,
        2 => Just(0.0),
        1 => Just(f64::NAN),
        1 => prop_oneof![Just(f64::INFINITY), Just(-1e300), Just(1e-300), Just(f64::MAX)],
    ]
}

fn numbers(count: impl Into<prop::collection::SizeRange>) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(number(), count)
}

fn plate(frames: usize) -> impl Strategy<Value = File> {
    let regular = prop_oneof![Just(true), Just(false)];
    (
        0_i16..23,
        numbers(12),
        numbers(3),
        0_usize..13,
        numbers(12 * frames),
        regular,
        [-2_i16..9, -2_i16..9],
        0_usize..13,
    )
        .prop_map(move |(kind, corners, origin, channels, samples, regular, zero, rows)| {
            let mut file = File::step(kind.max(1), [origin[0], origin[1], origin[2]], &[]);
            if !regular {
                file.corners_mm = [0, 3, 6, 9].map(|i| [corners[i], corners[i + 1], corners[i + 2]]);
            }
            let channel = |c: usize| samples[c * frames..(c + 1) * frames].to_vec();
            file.channels = (0..channels.max(1)).map(|c| channel(c.min(11))).collect();
            file.zero = zero;
            file.matrix = (0..rows).map(|r| (0..channels.max(1)).map(|c| corners[(r + c) % 12]).collect()).collect();
            file
        })
}

/// A recording of markers with names of landmarks, plates and events.
fn record() -> impl Strategy<Value = C3d> {
    let names = ["LHEE", "RHEE", "LTOE", "RTOE", "RASI", "LASI", "SACR", "*1", "A:B", "", "LHEE"];
    let sizes = (1_usize..40, 0_usize..11);
    sizes.prop_flat_map(move |(frames, points)| {
        let rate = prop_oneof![4 => 20.0..500.0_f64, 1 => Just(1e-9), 1 => Just(1e12)];
        (plate(frames), numbers(3 * frames * points), rate, number()).prop_map(move |(plate, places, rate, time)| {
            let mut record = plate.record();
            let point = |p: usize| {
                let at = |i: usize| 3 * (p * frames + i);
                let places = (0..frames).map(|i| [places[at(i)], places[at(i) + 1], places[at(i) + 2]]);
                Point::new(names[p], places.collect())
            };
            record.points = (0..points).map(point).collect();
            (record.point_rate_hz, record.analog_rate_hz) = (rate, rate);
            record.events = vec![Event::new("Foot Strike", "Left", time), Event::new("", "R", time)];
            record
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_recording_ends_in_a_result_or_an_error(record in record()) {
        let mut findings = Findings::default();
        prop_assert!(events_from_c3d(&record, &mut findings).len() <= 2);
        let plates = plates_from_c3d(&record, PlateSettings::default(), &mut findings).unwrap_or_default();
        for plate in &plates {
            prop_assert_eq!(plate.force.len(), plate.times.len());
        }
        let Ok(markers) = markers_from_c3d(&record, &mut findings) else { return Ok(()) };
        let laboratory = laboratory(&markers, &plates, "mm", &mut findings);
        prop_assert!((laboratory.world_from_lab.determinant() - 1.0).abs() < 1e-6, "{}", laboratory.statement);
        let markers = laboratory.markers(&markers);
        let plates: Vec<_> = plates.iter().map(|p| laboratory.plate(p)).collect();
        let motion = foot_motion(&markers, &mut findings);
        let feet = feet_on_plates(&markers, &plates, &motion, &[], &mut findings);
        for window in feet.windows {
            prop_assert!(window[1] > window[0]);
        }
    }
}
