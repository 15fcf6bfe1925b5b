//! Recordings of real laboratories: plates, axes, feet on plates, events.
//!
//! The recordings are not part of the repository. They are searched in `shared/data` next to it, or in
//! `$AMBULO_DATA/data`; without them each test prints `skipped` and passes.

use crate::shared_data::data;
use ambulo::analysis::event_agreement;
use ambulo::findings::{Code, Findings};
use ambulo::ground::foot_motion::foot_motion;
use ambulo::ground::phases::contacts_from_force;
use ambulo::ground::plates::{ContactQuality, feet_on_plates};
use ambulo::model::Side;
use ambulo::motion::{
    Event, EventKind, Laboratory, MarkerRecording, PlateRecording, PlateSettings, events_from_c3d, laboratory,
    markers_from_c3d, markers_from_trc, plates_from_c3d, standing_weight_n, subject_from_c3d,
};
use ambulo_formats::c3d::C3d;
use ambulo_formats::table::Table;
use ambulo_formats::trc::Trc;
use std::path::Path;

/// A trial in the axes of the world.
struct Trial {
    markers: MarkerRecording,
    plates: Vec<PlateRecording>,
    laboratory: Laboratory,
    file: C3d,
    findings: Findings,
}

fn trial(folder: &Path, name: &str) -> Trial {
    let (file, _) = C3d::read(&std::fs::read(folder.join(name)).unwrap()).unwrap();
    let mut findings = Findings::default();
    let plates = plates_from_c3d(&file, PlateSettings::default(), &mut findings).unwrap();
    let markers = markers_from_c3d(&file, &mut findings).unwrap();
    let laboratory = laboratory(&markers, &plates, &file.point_unit, &mut findings);
    Trial {
        markers: laboratory.markers(&markers),
        plates: plates.iter().map(|p| laboratory.plate(p)).collect(),
        laboratory,
        file,
        findings,
    }
}

/// Contacts of one foot with plates, from the README of the data: plate, side, first and last loaded time [s],
/// peak [body weights].
type Documented = (usize, Side, f64, f64, f64);

/// A peak that is not in the README.
const UNTOLD: f64 = f64::NAN;
const R: Side = Side::Right;
const L: Side = Side::Left;

const HC032A03: [Documented; 2] = [(1, R, 1.667, 2.282, 1.04), (0, L, 2.191, 2.819, 1.15)];
const HC002D06: [Documented; 2] = [(1, R, 1.830, 2.350, 1.25), (0, L, 2.284, 2.807, 1.19)];
const BTKDATA: [Documented; 3] = [(0, L, 7.853, 8.511, 1.09), (1, R, 8.382, 9.045, 1.13), (2, L, 8.93, 9.60, 1.14)];

fn events_of(told: &[Documented]) -> Vec<Event> {
    let event = |side, kind, time_s| Event { side, kind, time_s };
    told.iter().flat_map(|t| [event(t.1, EventKind::Strike, t.2), event(t.1, EventKind::Off, t.3)]).collect()
}

fn trc(path: &Path) -> MarkerRecording {
    let (file, _) = Trc::read(&std::fs::read(path).unwrap()).unwrap();
    let mut findings = Findings::default();
    let markers = markers_from_trc(&file, &mut findings).unwrap();
    laboratory(&markers, &[], file.unit.symbol(), &mut findings).markers(&markers)
}

/// Events from the vertical force columns of a table.
fn events_of_table(path: &Path, columns: [(Side, &str); 2], until_s: f64) -> Vec<Event> {
    let (table, _) = Table::read_storage(&std::fs::read(path).unwrap()).unwrap();
    let mut out = Vec::new();
    for (side, column) in columns {
        for contact in contacts_from_force(table.times().unwrap(), table.column(column).unwrap()) {
            let event = |kind, time_s| Event { side, kind, time_s };
            out.extend(contact.strike_s.map(|t| event(EventKind::Strike, t)));
            out.extend(contact.off_s.map(|t| event(EventKind::Off, t)));
        }
    }
    out.retain(|e| e.time_s < until_s);
    out
}

#[test]
fn events_from_motion_agree_with_plates_within_the_published_errors() {
    let Some(data) = data() else { return };
    let c3d = |name: &str, told: &[Documented]| {
        let trial = trial(&data, name);
        (name.to_owned(), trial.markers, events_of(told))
    };
    let opensim = |markers: &str, forces: &str, columns: [(Side, &str); 2], until_s: f64| {
        let events = events_of_table(&data.join(forces), columns, until_s);
        (markers.to_owned(), trc(&data.join(markers)), events)
    };
    let recordings = [
        c3d("biomechzoo-HC032A/HC032A03.c3d", &HC032A03),
        c3d("biomechzoo-HC002D/HC002D06.c3d", &HC002D06),
        c3d("btkdata-pig-adult3plates/PiG_Motion3_FF.c3d", &BTKDATA),
        opensim(
            "opensim-rajagopal-walk/markers_walk.trc",
            "opensim-rajagopal-walk/grf_walk.mot",
            [(R, "ground_force_r_vy"), (L, "ground_force_l_vy")],
            2.3,
        ),
        opensim(
            "opensim-gait2392-subject01/subject01_walk1.trc",
            "opensim-gait2392-subject01/subject01_walk1_grf.mot",
            [(R, "ground_force_vy"), (L, "1_ground_force_vy")],
            2.4,
        ),
        opensim(
            "opensim-rajagopal-run/motion_capture_run.trc",
            "opensim-rajagopal-run/grf_run.mot",
            [(R, "R_ground_force_vy"), (L, "L_ground_force_vy")],
            5.2,
        ),
    ];
    let mut errors_ms = Vec::new();
    for (name, markers, reference) in recordings {
        let found = foot_motion(&markers, &mut Findings::default());
        println!("{name}: walking {:.2} m/s, floor {:.2} m/s", found.walking_speed_m_s, found.floor_speed_m_s);
        let rows = found.by_method.iter().map(|(m, e)| (*m, e));
        for (method, events) in rows.chain([("agreed", &found.events)]) {
            for row in event_agreement(&reference, events) {
                println!(
                    "   {method:<60} {:<6} {} pairs, {} missed, {} extra, mean {:.1} ms, bias {:+.1} ms",
                    row.kind, row.pairs, row.missed, row.extra, row.mean_absolute_ms, row.bias_ms
                );
            }
        }
        if !name.contains("run") {
            let rows = event_agreement(&reference, &found.events);
            assert!(rows.iter().all(|row| row.missed == 0 && row.extra == 0), "{name}: {rows:?}");
            errors_ms.extend(rows.map(|row| row.mean_absolute_ms));
        }
    }
    let mean_ms = errors_ms.iter().sum::<f64>() / errors_ms.len() as f64;
    println!("five walks, methods together: {mean_ms:.1} ms");
    // O'Connor 2007 gives 16 ms for strikes and 9 ms for offs, Zeni 2008 one to two frames of 17 ms.
    assert!(mean_ms < 16.0, "{mean_ms} ms");
}

#[test]
fn peaks_and_contact_times_are_those_of_the_readme() {
    let Some(data) = data() else { return };
    let recordings: [(&str, f64, &[Documented]); 5] = [
        ("biomechzoo-HC032A/HC032A03.c3d", 60.3, &HC032A03),
        ("biomechzoo-HC002D/HC002D06.c3d", 32.1, &HC002D06),
        ("btkdata-pig-adult3plates/PiG_Motion3_FF.c3d", 74.0, &BTKDATA),
        ("biomechzoo-HC032A/HC032A18.c3d", 60.3, &[(1, R, 1.765, 2.418, UNTOLD), (0, L, 2.335, 2.669, UNTOLD)]),
        ("biomechzoo-HC002D/HC002D25.c3d", 32.1, &[(0, L, 1.58, 2.12, UNTOLD), (1, R, 2.06, 2.58, UNTOLD)]),
    ];
    for (name, mass_kg, told) in recordings {
        let mut trial = trial(&data, name);
        let motion = foot_motion(&trial.markers, &mut trial.findings);
        let feet = feet_on_plates(&trial.markers, &trial.plates, &motion, &[], &mut trial.findings);
        assert_eq!(feet.contacts.len(), told.len(), "{name}: {:?}", feet.contacts);
        for (plate, side, strike_s, off_s, peak_bw) in told {
            let contact = feet.contacts.iter().find(|c| c.plate == *plate).unwrap();
            let found_bw = contact.peak_n / (mass_kg * 9.80665);
            println!(
                "{name} plate {plate}: {:?} {:.4}-{:.4} s (README {strike_s}-{off_s}), peak {found_bw:.3} BW \
                 ({peak_bw})",
                contact.side, contact.start_s, contact.end_s
            );
            assert_eq!(contact.side, Some(*side), "{name} plate {plate}");
            // The README has milliseconds, or hundredths where stated.
            let hundredths = |t: f64| ((t * 100.0).round() - t * 100.0).abs() < 1e-6;
            let rounding = if hundredths(*strike_s) && hundredths(*off_s) { 0.005 } else { 0.0 };
            assert!((contact.start_s - strike_s).abs() <= 0.005 + rounding, "{name} plate {plate}: {contact:?}");
            assert!((contact.end_s - off_s).abs() <= 0.005 + rounding, "{name} plate {plate}: {contact:?}");
            assert!(peak_bw.is_nan() || (found_bw - peak_bw).abs() <= 0.01, "{name} plate {plate}: {found_bw} BW");
        }
    }
}

#[test]
fn the_instrumented_windows_are_those_of_the_readme() {
    let Some(data) = data() else { return };
    for (name, from_s, to_s) in [
        ("biomechzoo-HC032A/HC032A03.c3d", 1.79, 2.72),
        ("biomechzoo-HC002D/HC002D06.c3d", 1.87, 2.74),
        ("btkdata-pig-adult3plates/PiG_Motion3_FF.c3d", 7.97, 9.46),
    ] {
        let mut trial = trial(&data, name);
        let motion = foot_motion(&trial.markers, &mut trial.findings);
        let feet = feet_on_plates(&trial.markers, &trial.plates, &motion, &[], &mut trial.findings);
        println!("{name}: {:?}, README {from_s}-{to_s}", feet.windows);
        // Both ends come from motion, whose events err by up to 0.05 s.
        assert!((feet.windows[0][0] - from_s).abs() < 0.05 && (feet.windows[0][1] - to_s).abs() < 0.05, "{name}");
        assert!(feet.contacts.iter().all(|c| c.quality == ContactQuality::Clean), "{:?}", feet.contacts);
    }
}

#[test]
fn a_foot_that_leaves_its_plate_early_is_partial_and_ends_the_window() {
    let Some(data) = data() else { return };
    let mut trial = trial(&data, "biomechzoo-HC032A/HC032A18.c3d");
    let motion = foot_motion(&trial.markers, &mut trial.findings);
    let feet = feet_on_plates(&trial.markers, &trial.plates, &motion, &[], &mut trial.findings);
    let left = feet.contacts.iter().find(|c| c.plate == 0).unwrap();
    assert_eq!(left.quality, ContactQuality::Partial, "{left:?}");
    assert!(left.reason.contains("0.29 s before the foot left"), "{}", left.reason);
    assert!(trial.findings.has(Code::PlatesPartial) && trial.findings.has(Code::LaboratoryTurning));
    assert!(feet.windows.iter().all(|w| w[1] <= left.start_s + 0.05), "{:?}", feet.windows);
}

#[test]
fn both_feet_on_one_plate_of_the_standing_trial_are_detected_and_weighed() {
    let Some(data) = data() else { return };
    for (name, weight_n) in [("biomechzoo-HC032A/HC032A01.c3d", 591.7), ("biomechzoo-HC002D/HC002D02.c3d", 304.7)] {
        let mut trial = trial(&data, name);
        let motion = foot_motion(&trial.markers, &mut trial.findings);
        let feet = feet_on_plates(&trial.markers, &trial.plates, &motion, &[], &mut trial.findings);
        assert_eq!(feet.contacts[0].quality, ContactQuality::TwoFeet, "{:?}", feet.contacts);
        let found = standing_weight_n(&trial.plates).unwrap();
        assert!((found - weight_n).abs() < 1.0, "{name}: {found} N");
    }
}

#[test]
fn axes_and_unit_of_each_laboratory_are_stated_in_one_line() {
    let Some(data) = data() else { return };
    let world = "world x forward, y up, z right, m";
    for (name, expected) in [
        ("biomechzoo-HC032A/HC032A03.c3d", "lab z up, mm, walking +y"),
        ("biomechzoo-HC032A/HC032A01.c3d", "lab z up, mm, facing -y"),
        ("btkdata-pig-adult3plates/PiG_Motion3_FF.c3d", "lab z up, mm, walking +y"),
        ("btkdata-pig-adult3plates/PiG_Calibration3_FF.c3d", "lab z up, mm, facing +x"),
        ("biomechzoo-HC002D/HC002D25.c3d", "lab z up, mm, walking 21 degrees from -y towards -x"),
        ("c3d-format-variants/Eb015si.c3d", "lab z up, mm, walking +y"),
        ("c3d-format-variants/TYPE-3.c3d", "lab z up, mm, walking +x"),
    ] {
        let trial = trial(&data, name);
        assert_eq!(trial.laboratory.statement, format!("{expected} -> {world}"), "{name}");
    }
    for (name, expected) in [
        ("opensim-rajagopal-walk/markers_walk.trc", "lab y up, mm, walking +x"),
        ("opensim-rajagopal-walk/static_walk_1.trc", "lab y up, mm, facing +z"),
        ("opensim-gait2392-subject01/subject01_walk1.trc", "lab y up, mm, facing +x"),
    ] {
        let (file, _) = Trc::read(&std::fs::read(data.join(name)).unwrap()).unwrap();
        let mut findings = Findings::default();
        let markers = markers_from_trc(&file, &mut findings).unwrap();
        let found = laboratory(&markers, &[], file.unit.symbol(), &mut findings);
        assert_eq!(found.statement, format!("{expected} -> {world}"), "{name}");
    }
}

#[test]
fn the_offset_of_an_unloaded_plate_is_removed_and_reported() {
    let Some(data) = data() else { return };
    for letters in ["pi", "pr", "vi", "vr", "si", "sr"] {
        let trial = trial(&data, &format!("c3d-format-variants/Eb015{letters}.c3d"));
        let offsets: Vec<f64> = trial.plates.iter().map(|p| p.baseline_n.unwrap()).collect();
        assert!((offsets[0] - 21.2).abs() < 0.1 && (offsets[1] - 30.6).abs() < 0.1, "{letters}: {offsets:?}");
        assert!(trial.findings.has(Code::PlatesLargeBaseline));
        for plate in &trial.plates {
            let start = plate.vertical(0).abs();
            assert!(start < 3.0, "{letters} {}: {start} N at the start", plate.name);
        }
    }
}

#[test]
fn one_recording_as_type_2_and_as_type_4_agrees_to_three_percent() {
    let Some(data) = data() else { return };
    for (two, four) in [("TYPE-2.C3D", "TYPE-4.C3D"), ("type-2a.c3d", "type-4a.c3d")] {
        let folder = data.join("c3d-format-variants");
        let (two, four) = (trial(&folder, two), trial(&folder, four));
        for (a, b) in two.plates.iter().zip(&four.plates) {
            let peak = a.peak_n();
            let apart = (0..a.times.len()).map(|i| (a.force[i] - b.force[i]).norm()).fold(0.0, f64::max);
            let centers = (0..a.times.len()).filter(|&i| a.vertical(i) > 0.5 * peak);
            let moved = centers.map(|i| (a.center_of_pressure(i) - b.center_of_pressure(i)).norm()).fold(0.0, f64::max);
            println!(
                "{}: peaks {peak:.1} and {:.1} N, force apart by up to {:.2} %, centre by {:.1} mm",
                a.name,
                b.peak_n(),
                100.0 * apart / peak,
                1000.0 * moved
            );
            assert!((b.peak_n() / peak - 1.0).abs() < 0.03 && apart < 0.03 * peak, "{}", a.name);
            // TYPE-2.C3D scales Mx and My by 36.83 and 37.03 N.mm a bit, TYPE-4.C3D by 741.87 x 0.0611 = 45.33 and
            // 45.19: the moments in the two files themselves differ by a fifth.
            let allowed = if two.file.channels.len() == 6 { 0.03 } else { 0.002 };
            assert!(moved < allowed, "{}: {moved} m", a.name);
        }
    }
}

#[test]
fn vertical_peaks_of_the_variants_are_those_of_ezc3d() {
    let Some(data) = data() else { return };
    // ezc3d 1.7.2, python: c3d(file, extract_forceplat_data=True)["data"]["platform"][i]["force"][2].max(). It leaves
    // offsets where they are. FP1 and FP2 have the force on the plate (positive along a z that points down), which
    // ezc3d passes on as -284.46 and -302.93 N.
    let folder = data.join("c3d-format-variants");
    for (name, expected) in [
        ("TYPE-2.C3D", vec![397.851]),
        ("TYPE-3.c3d", vec![726.632, 577.792, 515.2712, 606.9877]),
        ("TYPE-4.C3D", vec![390.4838]),
        ("type-2a.c3d", vec![521.6416, 582.8346]),
        ("type-4a.c3d", vec![520.678, 583.2359]),
        ("Eb015pi.c3d", vec![838.5556, 836.3133]),
        ("FP1.C3D", vec![284.4618]),
        ("FP2.C3D", vec![302.9257]),
    ] {
        let (file, _) = C3d::read(&std::fs::read(folder.join(name)).unwrap()).unwrap();
        let settings = PlateSettings { remove_baseline: false };
        let mut findings = Findings::default();
        let plates = plates_from_c3d(&file, settings, &mut findings).unwrap();
        assert_eq!(plates.len(), expected.len(), "{name}");
        for (plate, expected) in plates.iter().zip(&expected) {
            let peak = plate.force.iter().map(|f| f.z).fold(0.0, f64::max);
            assert!((peak - expected).abs() < 0.15, "{name} {}: {peak} N, ezc3d {expected} N", plate.name);
        }
        assert_eq!(findings.has(Code::PlatesForceOnPlate), name.starts_with("FP"), "{name}");
    }
}

#[test]
fn strikes_and_offs_of_a_foot_alternate_in_turning_walks() {
    let Some(data) = data() else { return };
    for name in [
        "biomechzoo-HC032A/HC032A18.c3d",
        "biomechzoo-HC002D/HC002D25.c3d",
        "biomechzoo-HC032A/HC032A03.c3d",
        "btkdata-pig-adult3plates/PiG_Motion3_FF.c3d",
    ] {
        let mut trial = trial(&data, name);
        let motion = foot_motion(&trial.markers, &mut trial.findings);
        for side in Side::BOTH {
            let kinds: Vec<EventKind> = motion.events.iter().filter(|e| e.side == side).map(|e| e.kind).collect();
            assert!(kinds.windows(2).all(|pair| pair[0] != pair[1]), "{name} {side}: {kinds:?}");
        }
        let listed = events_from_c3d(&trial.file, &mut trial.findings);
        let rows = event_agreement(&listed, &motion.events);
        println!("{name}: the file's own list and motion: {rows:?}");
        // They were set in whole frames of 10 ms.
        assert!(rows.iter().all(|r| r.pairs >= 4 && r.missed + r.extra <= 1 && r.mean_absolute_ms < 40.0), "{rows:?}");
    }
}

#[test]
fn over_a_whole_cycle_on_plates_the_mean_ground_force_is_the_body_weight() {
    let Some(data) = data() else { return };
    let trial = trial(&data, "btkdata-pig-adult3plates/PiG_Motion3_FF.c3d");
    // One cycle inside the instrumented window: as long as from the left foot's first strike to its second.
    let (from_s, to_s) = (8.0, 8.0 + 8.931 - 7.853);
    let times = &trial.plates[0].times;
    let inside: Vec<usize> = (0..times.len()).filter(|&i| (from_s..to_s).contains(&times[i])).collect();
    let total = |i: usize| trial.plates.iter().map(|p| p.force[i]).sum::<ambulo::spatial::Vec3>();
    let mean = inside.iter().map(|&i| total(i)).sum::<ambulo::spatial::Vec3>() / inside.len() as f64;
    println!("mean total force {mean:?} N, {:.2} kg", mean.y / 9.80665);
    // The README has 72.3 kg.
    assert!((mean.y / 9.80665 - 72.3).abs() < 0.3 && mean.x.abs() < 3.0 && mean.z.abs() < 3.0, "{mean:?}");
}

#[test]
fn the_day_of_a_recording_is_read_where_the_file_states_it() {
    let Some(data) = data() else { return };
    let day = |name: &str| {
        let (file, _) = C3d::read(&std::fs::read(data.join(name)).unwrap()).unwrap();
        subject_from_c3d(&file).recorded_on
    };
    assert_eq!(day("motonms-unipd/Walking1.c3d").as_deref(), Some("2013-04-03"));
    assert_eq!(day("biomechzoo-HC032A/HC032A03.c3d"), None, "no date in the file, so none is made up");
}
