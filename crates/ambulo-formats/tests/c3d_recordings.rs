//! Real C3D files: counts and sums against ezc3d, one recording in six encodings. Skipped where the data are not there.

use crate::shared_data::data;
use ambulo_formats::c3d::{C3d, Processor, Storage};
use std::path::Path;

/// What ezc3d 1.7.2 (PyPI) reads: points, frames, channels, points that were seen, sum of absolute coordinates of
/// those, sum of absolute samples. `np.isfinite`, `np.nansum(abs(points[:3]))`, `abs(analogs).sum()`.
type Row = (&'static str, usize, usize, usize, usize, f64, f64);
#[rustfmt::skip]
const EZC3D: [Row; 19] = [
    ("biomechzoo-HC002D/HC002D02.c3d", 311, 51, 24, 15717, 10405326.8942, 13428925.0305),
    ("biomechzoo-HC002D/HC002D06.c3d", 286, 255, 24, 68034, 72464987.0512, 24278546.9767),
    ("biomechzoo-HC002D/HC002D25.c3d", 287, 237, 24, 64148, 56340939.7600, 64012828.2284),
    ("biomechzoo-HC032A/HC032A01.c3d", 311, 300, 24, 92913, 64523470.3898, 80246881.5345),
    ("biomechzoo-HC032A/HC032A03.c3d", 291, 195, 24, 54273, 50274160.0557, 76207158.7794),
    ("biomechzoo-HC032A/HC032A18.c3d", 291, 337, 24, 91536, 110937785.2784, 78151990.0158),
    ("btkdata-pig-adult3plates/PiG_Calibration3_FF.c3d", 66, 95, 0, 6266, 4853031.6896, 0.0),
    ("btkdata-pig-adult3plates/PiG_Motion3_FF.c3d", 97, 293, 34, 23992, 25529435.2134, 191828264.5251),
    ("c3d-format-variants/Eb015pi.c3d", 26, 450, 16, 11474, 18953147.0648, 119771668.6963),
    ("c3d-format-variants/Eb015pr.c3d", 26, 450, 16, 11474, 18953147.0440, 119771668.6963),
    ("c3d-format-variants/Eb015vi.c3d", 26, 450, 16, 11474, 18953147.0648, 119771668.6963),
    ("c3d-format-variants/Eb015vr.c3d", 26, 450, 16, 11474, 18953147.0440, 119771668.6963),
    ("c3d-format-variants/FP1.C3D", 8, 480, 12, 3840, 8984.1123, 1800570.9302),
    ("c3d-format-variants/FP2.C3D", 8, 480, 12, 3840, 7350.4660, 2011229.7427),
    ("c3d-format-variants/TYPE-2.C3D", 13, 199, 6, 1934, 3284020.9533, 16144044.1775),
    ("c3d-format-variants/TYPE-3.c3d", 21, 515, 28, 7826, 18095941.5702, 25272451.4697),
    ("c3d-format-variants/TYPE-4.C3D", 13, 199, 6, 1934, 3284020.9533, 97423.4369),
    ("c3d-format-variants/type-2a.c3d", 25, 360, 20, 2730, 4236198.4620, 96657141.8456),
    ("c3d-format-variants/type-4a.c3d", 25, 360, 20, 2730, 4236198.4620, 207154.7843),
];

#[track_caller]
fn read(path: &Path) -> (C3d, Vec<String>) {
    let bytes = std::fs::read(path).unwrap();
    let (record, remarks) = C3d::read(&bytes).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    (record, remarks.iter().map(ToString::to_string).collect())
}

/// How many coordinates triples are there, and the sum of their absolute values.
fn sums(record: &C3d) -> (usize, f64) {
    let seen = record.points.iter().flat_map(|point| &point.positions).filter(|p| p.iter().all(|x| x.is_finite()));
    let sum = seen.clone().flatten().map(|x| x.abs()).sum();
    (seen.count(), sum)
}

#[test]
fn chosen_points_are_read_as_among_all() {
    let Some(folder) = data() else { return };
    for (name, ..) in EZC3D {
        let bytes = std::fs::read(folder.join(name)).unwrap();
        let (all, remarks) = C3d::read(&bytes).unwrap();
        // Every third name, and the rest, which a short answer leaves open.
        let third = |names: &[&str]| (0..names.len().min(9)).map(|k| k % 3 == 0).collect::<Vec<bool>>();
        let (chosen, same_remarks) = C3d::read_points(&bytes, |names, parameters| {
            assert_eq!(*parameters, all.parameters, "{name}");
            third(names)
        })
        .unwrap();
        assert_eq!(remarks, same_remarks, "{name}");
        let names: Vec<&str> = all.points.iter().map(|point| point.name.as_str()).collect();
        let wanted = third(&names);
        let mut expected = all.clone();
        let mut place = 0..;
        expected.points.retain(|_| place.next().and_then(|k| wanted.get(k)).is_none_or(|wanted| *wanted));
        // Not-a-number equals nothing.
        assert_eq!(format!("{chosen:?}"), format!("{expected:?}"), "{name}");
        let (none, _) = C3d::read_points(&bytes, |names, _| vec![false; names.len()]).unwrap();
        assert_eq!(none.points.len(), all.points.len(), "{name}");
    }
}

#[test]
fn every_recording_has_the_counts_and_sums_that_ezc3d_finds() {
    let Some(folder) = data() else { return };
    for (name, points, frames, channels, seen, positions, samples) in EZC3D {
        let (record, remarks) = read(&folder.join(name));
        let nameless = "group 7 has parameters (`IS_STATIC`) but no name";
        let known =
            if ["TYPE-2.C3D", "TYPE-4.C3D"].iter().any(|end| name.ends_with(end)) { vec![nameless] } else { vec![] };
        assert_eq!(remarks, known, "{name}");
        assert_eq!((record.points.len(), record.frames(), record.channels.len()), (points, frames, channels), "{name}");
        let (count, sum) = sums(&record);
        assert_eq!(count, seen, "{name}");
        // The table has four decimals; sums of up to 3e5 numbers in another order move by 1e-11 of themselves.
        assert!((sum - positions).abs() < 1e-4 + 1e-11 * positions, "{name}: {sum}");
        let sum: f64 = record.channels.iter().flat_map(|channel| &channel.samples).map(|x| x.abs()).sum();
        assert!((sum - samples).abs() < 1e-4 + 1e-11 * samples, "{name}: {sum}");
        for channel in &record.channels {
            assert_eq!(channel.samples.len(), frames * record.samples_per_frame(), "{name}");
        }
    }
}

#[test]
fn one_recording_in_six_encodings_gives_the_same_numbers() {
    let Some(folder) = data() else { return };
    let folder = folder.join("c3d-format-variants");
    let (first, _) = read(&folder.join("Eb015pi.c3d"));
    let encodings = [
        ("pi", Processor::Intel, Storage::Integer),
        ("pr", Processor::Intel, Storage::Real),
        ("vi", Processor::Dec, Storage::Integer),
        ("vr", Processor::Dec, Storage::Real),
        ("si", Processor::Sgi, Storage::Integer),
        ("sr", Processor::Sgi, Storage::Real),
    ];
    for (ending, processor, storage) in encodings {
        let (record, remarks) = read(&folder.join(format!("Eb015{ending}.c3d")));
        assert_eq!(remarks, Vec::<String>::new(), "{ending}");
        assert_eq!((record.encoding.processor, record.encoding.storage), (processor, storage));
        let (largest, compared) = largest_difference(&first, &record);
        // Integer positions are exact multiples of the scale; a real of 24 bits is off by 1e-7 of 2000 mm.
        assert!(largest < 1e-3, "{ending}: {largest} mm");
        assert_eq!(compared, 3 * 11474, "{ending}");
        for (a, b) in first.channels.iter().zip(&record.channels) {
            assert_eq!((&a.name, &a.unit, a.samples.len()), (&b.name, &b.unit, 1800));
            let off = a.samples.iter().zip(&b.samples).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
            assert!(off < 1e-9, "{ending} {}: {off}", a.name);
        }
        let (residuals, same): (Vec<_>, Vec<_>) = first.points.iter().zip(&record.points).map(words_agree).unzip();
        assert!(same.iter().all(|&same| same) && residuals.iter().all(|&off| off < 1e-3), "{ending}");
        let labels: Vec<_> = record.events.iter().map(|event| event.label.as_str()).collect();
        assert_eq!(labels, first.events.iter().map(|event| event.label.as_str()).collect::<Vec<_>>());
        assert_eq!(record.platforms().unwrap().len(), 2);
    }
}

/// Largest difference of residuals, and whether all camera masks are the same.
fn words_agree((a, b): (&ambulo_formats::c3d::Point, &ambulo_formats::c3d::Point)) -> (f64, bool) {
    let off = a.residuals.iter().zip(&b.residuals).filter(|(x, _)| x.is_finite()).map(|(x, y)| (x - y).abs());
    (off.fold(0.0, f64::max), a.cameras == b.cameras)
}

/// Largest difference of coordinates that both have, and how many were compared.
fn largest_difference(a: &C3d, b: &C3d) -> (f64, usize) {
    assert_eq!(a.points.len(), b.points.len());
    let (mut largest, mut compared) = (0.0, 0);
    for (p, q) in a.points.iter().zip(&b.points) {
        assert_eq!(p.name, q.name);
        for (x, y) in p.positions.as_flattened().iter().zip(q.positions.as_flattened()) {
            assert_eq!(x.is_nan(), y.is_nan());
            if x.is_finite() {
                largest = f64::max(largest, (x - y).abs());
                compared += 1;
            }
        }
    }
    (largest, compared)
}

#[test]
fn a_vicon_recording_is_read_with_names_events_platforms_and_time() {
    let Some(folder) = data() else { return };
    let (record, _) = read(&folder.join("biomechzoo-HC032A/HC032A03.c3d"));
    assert_eq!((record.first_frame, record.point_unit.as_str()), (157, "mm"));
    assert_eq!((record.point_rate_hz, record.analog_rate_hz), (100.0, 1000.0));
    assert!((record.times()[0] - 1.56).abs() < 1e-12 && (record.analog_times()[1] - 1.561).abs() < 1e-12);
    // Names beyond 255 are in LABELS2.
    assert_eq!(record.parameters.texts("POINT", "LABELS").len(), 291);
    assert!(record.points[255..].iter().any(|point| point.name == "LKneeMoment"));
    assert_eq!(record.metres_per_unit(), Some(1e-3));
    let strike = &record.events[0];
    assert_eq!(
        (strike.label.as_str(), strike.context.as_str(), strike.subject.as_str()),
        ("Foot Strike", "Left", "HC032A")
    );
    assert!((strike.time_s - 2.19).abs() < 1e-6, "{}", strike.time_s);
    let platforms = record.platforms().unwrap();
    assert_eq!(platforms[1].channels, (6..12).map(Some).collect::<Vec<_>>());
    assert!((platforms[0].corners[0][0] - 463.774353).abs() < 1e-5, "{:?}", platforms[0].corners);
    assert!((platforms[1].origin[2] - 37.566597).abs() < 1e-5, "{:?}", platforms[1].origin);
    assert_eq!(platforms[0].zero_frames, None);
}

#[test]
fn calibration_matrices_are_given_by_rows() {
    let Some(folder) = data() else { return };
    let (record, _) = read(&folder.join("c3d-format-variants/type-4a.c3d"));
    let platforms = record.platforms().unwrap();
    // From the file with ezc3d: parameters.FORCE_PLATFORM.CAL_MATRIX.value[:2, :2, 0], rows first.
    let corner = [[3.054, 0.062], [-0.058, 3.077]];
    assert_eq!(platforms[0].calibration.len(), 6);
    for (row, expected) in platforms[0].calibration.iter().zip(corner) {
        assert_eq!(row.len(), 6);
        for (value, expected) in row.iter().zip(expected) {
            assert!((value - expected).abs() < 1e-6, "{row:?}");
        }
    }
}

#[test]
fn a_parameter_section_that_was_written_over_is_refused_with_its_place() {
    let Some(folder) = data() else { return };
    let bytes = std::fs::read(folder.join("c3d-format-variants/bad_parameter_section.c3d")).unwrap();
    assert_eq!(
        C3d::read(&bytes).unwrap_err().to_string(),
        "byte 5771: found a parameter's name with unprintable characters, \
         `\\x00\\x11\\x1e\\x00\\x00\\x00\\x00\\x00\\x00`; \
         expected letters and digits; the parameter section is damaged or was overwritten"
    );
}
