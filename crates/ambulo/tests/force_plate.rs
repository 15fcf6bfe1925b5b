//! Force plates against examples worked by hand.
//!
//! The plate of [`plate_files::CORNERS_MM`] acts on a foot with F = (30, 50, 700) N at the point
//! (250, 200, 0) mm and with a free moment of 4 N.m about the vertical, all in the axes of the laboratory. About the
//! centre of the surface, C = (200, 300, 0) mm, the arm is r = (0.05, -0.1, 0) m, and
//!
//! ```text
//! M_C = r × F + (0, 0, 4) = (-0.1·700, -0.05·700, 0.05·50 + 0.1·30 + 4) = (-70, -35, 9.5) N.m
//! ```
//!
//! y and z of the plate are opposite to those of the laboratory: F' = (30, -50, -700) N, M' = (-70, 35, -9.5) N.m. The
//! comments below derive the channels of each type.

use crate::plate_files::{CORNERS_MM, File, RATE_HZ, record};
use ambulo::findings::{Code, Findings};
use ambulo::motion::{PlateRecording, PlateSettings, plates_from_c3d, standing_weight_n};
use ambulo::spatial::{Mat3, Vec3};

/// Parameters are stored with seven digits: 700 N to 1e-4, 60 N.m to 1e-5.
const ROUNDING: f64 = 1e-3;

/// The first loaded sample is 40; this one is in the middle.
const LOADED: usize = 60;

fn read(file: &File) -> (PlateRecording, Findings) {
    let mut findings = Findings::default();
    let mut plates = plates_from_c3d(&file.record(), PlateSettings::default(), &mut findings).unwrap();
    assert_eq!(plates.len(), 1, "{findings:?}");
    (plates.remove(0), findings)
}

#[track_caller]
fn assert_vector(found: Vec3, expected: [f64; 3], tolerance: f64) {
    assert!((found - Vec3::from(expected)).norm() <= tolerance, "{found:?} instead of {expected:?}");
}

/// Asserts the forces of the example above.
#[track_caller]
fn assert_person(plate: &PlateRecording) {
    assert_vector(plate.force[LOADED], [30.0, 50.0, 700.0], ROUNDING);
    // About the origin of the laboratory: (0.25, 0.2, 0) × F + (0, 0, 4).
    assert_vector(plate.moment[LOADED], [140.0, -175.0, 0.25 * 50.0 - 0.2 * 30.0 + 4.0], ROUNDING);
    assert_vector(plate.moment_about_center(LOADED), [-70.0, -35.0, 9.5], ROUNDING);
    assert_vector(plate.center_of_pressure(LOADED), [0.25, 0.2, 0.0], 1e-6);
    assert!((plate.free_moment(LOADED) - 4.0).abs() < ROUNDING, "{}", plate.free_moment(LOADED));
    assert!((plate.vertical(LOADED) - 700.0).abs() < ROUNDING && plate.vertical(10).abs() < ROUNDING);
    assert!(plate.center_of_pressure(10).x.is_nan() && plate.free_moment(10).is_nan(), "unloaded");
}

/// Type 2 with o = (1.5, -2, -40) mm: M_sensor = M' - F' × o, and F' × o = (-50·-0.04 - -700·-0.002, -700·0.0015 -
/// 30·-0.04, 30·-0.002 - -50·0.0015) = (0.6, 0.15, 0.015) N.m.
const TYPE_2: [f64; 6] = [30.0, -50.0, -700.0, -70_600.0, 34_850.0, -9_515.0];
const ORIGIN_2: [f64; 3] = [1.5, -2.0, -40.0];

fn type_2() -> File {
    File::step(2, ORIGIN_2, &TYPE_2)
}

/// Type 3 with a = 120, b = 200, o₃ = -40 mm: M_sensor = M' - F' × (0, 0, -0.04) = (-70 - 2, 35 - 1.2, -9.5) N.m, so
/// Fz1 + Fz2 - Fz3 - Fz4 = -72 / 0.2 = -360 N, -Fz1 + Fz2 + Fz3 - Fz4 = 33.8 / 0.12 = 281.67 N, the sum is -700 N, and
/// Fz1 - Fz2 + Fz3 - Fz4 = 0 is chosen; Fy14 = Fy23 = -25 N, so Fx34 - Fx12 = -9.5 / 0.2 = -47.5 N.
const TYPE_3: [f64; 8] = [
    38.75,
    -8.75,
    -25.0,
    -25.0,
    (-700.0 - 360.0 - 33.8 / 0.12) / 4.0,
    (-700.0 - 360.0 + 33.8 / 0.12) / 4.0,
    (-700.0 + 360.0 + 33.8 / 0.12) / 4.0,
    (-700.0 + 360.0 - 33.8 / 0.12) / 4.0,
];
const ORIGIN_3: [f64; 3] = [120.0, 200.0, -40.0];

#[test]
fn type_1_gives_force_point_and_free_moment() {
    // The point relative to the centre, in the axes of the plate: (50, 100) mm; the free moment about its z, -4 N.m.
    let mut file = File::step(1, [0.0, 0.0, -40.0], &[30.0, -50.0, -700.0, 50.0, 100.0, -4_000.0]);
    file.units = vec!["N", "N", "N", "mm", "mm", "Nmm"];
    assert_person(&read(&file).0);
}

#[test]
fn type_2_gives_force_and_moment_of_the_sensor() {
    let (plate, findings) = read(&type_2());
    assert_person(&plate);
    assert!(findings.as_slice().is_empty(), "{findings:?}");
}

#[test]
fn type_3_gives_eight_forces() {
    assert_person(&read(&File::step(3, ORIGIN_3, &TYPE_3)).0);
}

/// Rows that mix channels, so that a transposed matrix or a lost entry shows: Fx = 2 c₁, Fy = 2 c₂, Fz = 5 c₃ + 0.1 c₁,
/// Mx = 700 c₄, My = 700 c₅ + c₃, Mz = 400 c₆.
fn mixing_matrix(columns: usize) -> Vec<Vec<f64>> {
    let entries =
        [(0, 0, 2.0), (1, 1, 2.0), (2, 2, 5.0), (2, 0, 0.1), (3, 3, 700.0), (4, 4, 700.0), (4, 2, 1.0), (5, 5, 400.0)];
    let mut matrix = vec![vec![0.0; columns]; 6];
    for (row, column, value) in entries {
        matrix[row][column] = value;
    }
    matrix
}

/// The channels that the matrix converts to [`TYPE_2`].
fn volts() -> [f64; 6] {
    let c3 = (-700.0 - 0.1 * 15.0) / 5.0;
    [15.0, -25.0, c3, -70_600.0 / 700.0, (34_850.0 - c3) / 700.0, -9_515.0 / 400.0]
}

#[test]
fn type_4_multiplies_by_its_matrix() {
    let mut file = File::step(4, ORIGIN_2, &volts());
    file.units = vec!["V"; 6];
    file.matrix = mixing_matrix(6);
    assert_person(&read(&file).0);
    file.matrix = (0..6).map(|i| (0..6).map(|j| mixing_matrix(6)[j][i]).collect()).collect();
    let transposed = read(&file).0;
    assert!((transposed.force[LOADED] - Vec3::new(30.0, 50.0, 700.0)).norm() > 1.0, "the transposed matrix must show");
}

#[test]
fn type_5_multiplies_eight_channels_by_six_rows() {
    let channels: Vec<f64> = volts().into_iter().chain([3.0, -2.0]).collect();
    let mut file = File::step(5, ORIGIN_2, &channels);
    file.units = vec!["V"; 8];
    file.matrix = mixing_matrix(8);
    file.matrix[0][6] = 2.0; // 2·3 + 3·-2 = 0: both count
    file.matrix[0][7] = 3.0;
    assert_person(&read(&file).0);
}

#[test]
fn type_6_gives_twelve_forces() {
    // Those of type 3 with half of each shear channel at each of its sensors, halved and doubled by the matrix.
    let [x12, x34, y14, y23, z1, z2, z3, z4] = TYPE_3;
    let forces = [
        [x12 / 2.0, y14 / 2.0, z1],
        [x12 / 2.0, y23 / 2.0, z2],
        [x34 / 2.0, y23 / 2.0, z3],
        [x34 / 2.0, y14 / 2.0, z4],
    ];
    let channels: Vec<f64> = forces.as_flattened().iter().map(|f| f / 2.0).collect();
    let mut file = File::step(6, ORIGIN_3, &channels);
    file.matrix = (0..12).map(|i| (0..12).map(|j| if i == j { 2.0 } else { 0.0 }).collect()).collect();
    assert_person(&read(&file).0);
}

#[test]
fn type_7_is_type_3_after_a_matrix() {
    let mut file = File::step(7, ORIGIN_3, &TYPE_3.map(|f| f / 4.0));
    file.matrix = (0..8).map(|i| (0..8).map(|j| if i == j { 4.0 } else { 0.0 }).collect()).collect();
    assert_person(&read(&file).0);
}

#[test]
fn an_origin_of_the_other_sign_is_reversed_and_reported() {
    let (plate, findings) = read(&File::step(2, ORIGIN_2.map(|x| -x), &TYPE_2));
    assert_person(&plate);
    assert!(findings.has(Code::PlatesOriginTurned));
    // Half distances of sensors have no sign; the height has. ezc3d reverses all three, and with them both moments.
    assert_person(&read(&File::step(3, [120.0, 200.0, 40.0], &TYPE_3)).0);
}

#[test]
fn forces_on_the_plate_are_reversed_and_reported() {
    let (plate, findings) = read(&File::step(2, ORIGIN_2, &TYPE_2.map(|x| -x)));
    assert_person(&plate);
    assert!(findings.has(Code::PlatesForceOnPlate));
}

#[test]
fn markers_determine_the_upper_side_of_the_plate() {
    // The corners are in reverse order: x of the plate is reversed, z points up. In its axes F' = (-30,
    // -50, 700) and M' = (70, 35, 9.5).
    let mut file = File::step(2, [0.0; 3], &[-30.0, -50.0, 700.0, 70_000.0, 35_000.0, 9_500.0]);
    file.corners_mm = [CORNERS_MM[1], CORNERS_MM[0], CORNERS_MM[3], CORNERS_MM[2]];
    file.markers_mm = vec![[200.0, 300.0, 900.0], [250.0, 200.0, 50.0]];
    let (plate, findings) = read(&file);
    assert_person(&plate);
    assert!(!findings.has(Code::PlatesForceOnPlate));
    // Without markers z is assumed to point down, and the load to pull.
    file.markers_mm.clear();
    assert!(read(&file).1.has(Code::PlatesForceOnPlate));
}

#[test]
fn the_unit_of_moments_is_inferred_from_the_center_of_pressure() {
    let mut values = TYPE_2;
    values[3..].iter_mut().for_each(|m| *m /= 1000.0);
    let mut file = File::step(2, ORIGIN_2, &values);
    file.units = vec!["", "", "", "", "", ""]; // read as N and N.mm, since points are mm
    let (plate, findings) = read(&file);
    assert_person(&plate);
    assert!(findings.has(Code::PlatesReadingChanged));
    // With the unit nothing is inferred.
    file.units = vec!["N", "N", "N", "Nm", "Nm", "Nm"];
    let (plate, findings) = read(&file);
    assert_person(&plate);
    assert!(findings.as_slice().is_empty(), "{findings:?}");
}

#[test]
fn a_center_outside_the_plate_is_reported() {
    let mut values = TYPE_2;
    values[4] += 700_000.0; // 1 m further along x
    let (plate, findings) = read(&File::step(2, ORIGIN_2, &values));
    assert!(findings.has(Code::PlatesCenterOutside));
    assert!(plate.center_of_pressure(LOADED).x > 1.0);
}

#[test]
fn the_signal_of_the_unloaded_plate_is_removed_from_every_channel() {
    let mut file = type_2();
    let offsets = [3.0, -5.0, 25.0, 900.0, -1_500.0, 300.0];
    for (channel, offset) in file.channels.iter_mut().zip(offsets) {
        channel.iter_mut().for_each(|x| *x += offset);
    }
    let (plate, findings) = read(&file);
    assert_person(&plate);
    assert!((plate.baseline_n.unwrap() + 25.0).abs() < ROUNDING, "{:?}", plate.baseline_n);
    assert!(findings.has(Code::PlatesLargeBaseline));
    let keep = PlateSettings { remove_baseline: false };
    let kept = plates_from_c3d(&file.record(), keep, &mut Findings::default()).unwrap();
    assert!((kept[0].vertical(LOADED) - 675.0).abs() < ROUNDING && kept[0].baseline_n.is_none());
}

#[test]
fn a_stated_point_has_no_offset_to_remove() {
    let mut file = File::step(1, [0.0; 3], &[30.0, -50.0, -700.0, 50.0, 100.0, -4_000.0]);
    file.units = vec!["N", "N", "N", "mm", "mm", "Nmm"];
    for i in [3, 4] {
        file.channels[i][..40].fill(17.0);
    }
    file.channels[2].iter_mut().for_each(|x| *x += 12.0);
    let (plate, _) = read(&file);
    assert_vector(plate.center_of_pressure(LOADED), [0.25, 0.2, 0.0], 1e-6);
    assert!((plate.vertical(LOADED) - 700.0).abs() < ROUNDING);
}

/// A plate whose vertical force has these levels [N], each for half a second.
fn levels(levels: &[f64]) -> File {
    let mut file = type_2();
    let samples: Vec<f64> = levels.iter().flat_map(|level| vec![-level; (0.5 * RATE_HZ) as usize]).collect();
    file.channels = vec![vec![0.0; samples.len()]; 6];
    file.channels[2] = samples;
    file
}

#[test]
fn continuous_standing_is_not_an_offset() {
    let (plate, _) = read(&levels(&[600.0, 600.0]));
    assert!(plate.baseline_n.is_none() && (plate.vertical(5) - 600.0).abs() < ROUNDING);
    assert!((standing_weight_n(&[plate]).unwrap() - 600.0).abs() < ROUNDING);
    let (stepped, _) = read(&levels(&[300.0, 700.0, 300.0]));
    assert!(stepped.baseline_n.is_none(), "{:?}", stepped.baseline_n);
    assert_eq!(standing_weight_n(&[stepped]), None, "who steps does not stand");
}

#[test]
fn a_large_offset_is_removed_if_the_zero_frames_confirm_it_or_it_is_negative() {
    let mut file = levels(&[120.0, 820.0, 120.0]);
    assert!(read(&file).0.baseline_n.is_none());
    file.zero = [1, 50];
    let (plate, findings) = read(&file);
    assert!((plate.peak_n() - 700.0).abs() < ROUNDING, "{}", plate.peak_n());
    assert!(findings.as_slice().iter().any(|f| f.message.contains("ZERO frames")), "{findings:?}");
    // ZERO frames under load confirm nothing.
    file.zero = [120, 180];
    assert!(read(&file).0.baseline_n.is_none());
    // A foot cannot pull: a negative level is an offset.
    let (plate, _) = read(&levels(&[-210.0, 500.0, -210.0]));
    assert!((plate.peak_n() - 710.0).abs() < ROUNDING, "{}", plate.peak_n());
}

/// A stance as half a sine, on a plate with the signal `quiet` without load, clipped at `limit` [N].
fn sine(limit: f64) -> File {
    let mut file = type_2();
    let stance = |i: usize| 800.0 * (std::f64::consts::PI * i as f64 / 140.0).sin();
    let samples: Vec<f64> = (0..300).map(|i| if (80..220).contains(&i) { stance(i - 80) } else { 0.0 }).collect();
    file.channels = vec![vec![0.0; samples.len()]; 6];
    file.channels[2] = samples.iter().map(|x| -x.min(limit)).collect();
    file
}

#[test]
fn a_clipped_channel_is_reported_and_a_rounded_peak_is_not() {
    let (clipped, findings) = read(&sine(600.0));
    assert!(findings.has(Code::PlatesClipped));
    // asin(600/800) of half a sine of 0.7 s: from 0.589 to 0.911 s.
    let [from, to] = clipped.clipped[0];
    assert!((from - 0.589).abs() < 0.01 && (to - 0.911).abs() < 0.01, "{from} {to}");
    let (whole, findings) = read(&sine(1000.0));
    assert!(whole.clipped.is_empty() && !findings.has(Code::PlatesClipped), "{:?}", whole.clipped);
}

/// The plate of a file whose samples are a millisecond apart.
fn read_fast(file: &File) -> (PlateRecording, Findings) {
    let mut findings = Findings::default();
    let mut record = file.record();
    (record.point_rate_hz, record.analog_rate_hz) = (1000.0, 1000.0);
    let mut plates = plates_from_c3d(&record, PlateSettings::default(), &mut findings).unwrap();
    (plates.remove(0), findings)
}

#[test]
fn what_no_load_does_to_a_channel_is_bridged_and_reported() {
    let (clean, findings) = read_fast(&sine(1000.0));
    assert!(!findings.has(Code::PlatesExcursion), "{findings:?}");
    for (name, span, value) in
        [("spike", 150..151, 8000.0), ("dropout", 140..170, 0.0), ("two spikes", 120..122, -900.0)]
    {
        let mut file = sine(1000.0);
        file.channels[2][span.clone()].fill(value);
        let (plate, findings) = read_fast(&file);
        let finding = findings.as_slice().iter().find(|finding| finding.code == Code::PlatesExcursion).unwrap();
        assert!(
            finding.message.contains(&format!("channel 3 of plate 1 jumps away and back, first at 0.{}", span.start))
        );
        for i in 0..300 {
            // A straight line over 30 ms is 800 (1 - cos(0.34)) = 45 N from a half sine of 140 ms at most.
            let off = (plate.vertical(i) - clean.vertical(i)).abs();
            assert!(off < if span.contains(&i) { 50.0 } else { ROUNDING }, "{name} {i}: {off} N");
        }
    }
    // A loose plug in the moment.
    let mut file = sine(1000.0);
    file.channels[4] = (0..300).map(|i| -0.1 * file.channels[2][i]).collect();
    file.channels[4][150..153].fill(9e4);
    let (plate, findings) = read_fast(&file);
    let said = findings.as_slice().iter().find(|finding| finding.code == Code::PlatesExcursion).unwrap();
    assert!(said.message.contains("channel 5 of plate 1 jumps away and back, first at 0.150 s"), "{said:?}");
    for i in 0..300 {
        // The whole plate is bridged: 800 (1 - cos(0.045)) = 0.8 N from the half sine.
        let most = if (150..153).contains(&i) { 1.0 } else { ROUNDING };
        assert!((plate.vertical(i) - clean.vertical(i)).abs() < most, "{i}");
    }
    // The plug of the whole plate: shear is bridged, too, though its own jump is small.
    let mut file = sine(1000.0);
    file.channels[1] = file.channels[2].iter().map(|force| 0.1 * force).collect();
    let (whole, _) = read_fast(&file);
    file.channels.iter_mut().for_each(|channel| channel[140..170].fill(0.0));
    let (plate, _) = read_fast(&file);
    let off = (0..300).map(|i| (plate.force[i] - whole.force[i]).norm()).fold(0.0, f64::max);
    assert!(off < 50.0 && (plate.force[155] - whole.force[155]).norm() < 0.1 * whole.force[155].norm(), "{off} N");
    // Every second sample of noise jumps back, and a step stays where it is.
    let noise = |i: usize| f64::from(u8::from(i.is_multiple_of(2))) - 0.5;
    let mut file = sine(1000.0);
    file.channels[0] = (0..300).map(noise).collect();
    file.channels[1] = (0..300).map(|i| if i < 150 { 0.0 } else { 60.0 }).collect();
    assert!(!read_fast(&file).1.has(Code::PlatesExcursion));
    // At 200 Hz a strike may be as fast.
    let mut file = sine(1000.0);
    file.channels[2][150] = 8000.0;
    assert!(!read(&file).1.has(Code::PlatesExcursion));
}

/// What a recording of a plate lost, in words.
fn lost(findings: &Findings) -> Option<String> {
    let lost = findings.as_slice().iter().find(|finding| finding.code == Code::PlatesLost);
    lost.map(|finding| finding.message.clone())
}

/// Largest difference of the force on two plates [N].
fn apart(a: &PlateRecording, b: &PlateRecording) -> f64 {
    (0..a.times.len()).map(|i| (a.force[i] - b.force[i]).norm()).fold(0.0, f64::max)
}

#[test]
fn a_plug_that_is_out_for_a_while_is_bridged_in_the_channels_that_lost_it() {
    let mut whole = sine(1000.0);
    // Shear of a step: braking, then propulsion, each a fifth of the load.
    let shear = |i: usize| 160.0 * (2.0 * std::f64::consts::PI * (i as f64 - 80.0) / 140.0).sin();
    whole.channels[1] = (0..300).map(|i| if (80..220).contains(&i) { shear(i) } else { 0.0 }).collect();
    let (clean, findings) = read_fast(&whole);
    assert_eq!(lost(&findings), None);
    // Only shear, for 30 ms around its largest value: the vertical force keeps its course.
    let mut file = whole.clone();
    file.channels[1][100..130].fill(0.0);
    let (plate, findings) = read_fast(&file);
    assert!(findings.has(Code::PlatesExcursion) && lost(&findings).is_none(), "{findings:?}");
    // A line over 34 ms below the top of a sine of 140 ms: 160 (1 - cos(2 pi 17 / 140)) = 44 N.
    assert!(apart(&plate, &clean) < 45.0, "{} N", apart(&plate, &clean));
    assert!((0..300).all(|i| (plate.vertical(i) - clean.vertical(i)).abs() < ROUNDING));
    // The whole plate, while the load falls, and for longer than a foot takes to load and unload it.
    for span in [175..200, 120..185] {
        let mut file = whole.clone();
        file.channels.iter_mut().for_each(|channel| channel[span.clone()].fill(0.0));
        let (plate, findings) = read_fast(&file);
        assert_eq!(lost(&findings).is_some(), span.len() > 50, "{findings:?}");
        let most = (0..300).map(|i| (plate.vertical(i) - clean.vertical(i)).abs()).fold(0.0, f64::max);
        // The half sine is 800 N where the longer line is 571 N.
        assert!(most < 230.0, "{span:?}: {most} N");
    }
    // A plug that stays out.
    let mut file = whole.clone();
    file.channels[2][150..].fill(0.0);
    let said = lost(&read_fast(&file).1).unwrap();
    assert!(said.contains("plate 1 jumps to or from one level at 0.150 s"), "{said}");
}

#[test]
fn a_plate_that_keeps_its_values_under_a_load_is_not_called_clipped() {
    let (clean, _) = read_fast(&sine(1000.0));
    let mut file = sine(1000.0);
    for channel in &mut file.channels {
        let kept = channel[110];
        channel[110..170].fill(kept);
    }
    let (plate, findings) = read_fast(&file);
    let said = lost(&findings).unwrap();
    assert!(said.contains("plate 1 lost its signal from 0.111 to 0.170 s"), "{said}");
    assert!(!findings.has(Code::PlatesClipped) && apart(&plate, &clean) < 250.0, "{}", apart(&plate, &clean));
}

#[test]
fn a_channel_that_never_moves_is_reported_if_the_plate_was_loaded() {
    let still = |file: &File| {
        let (_, findings) = read(file);
        findings.as_slice().iter().find(|f| f.code == Code::PlatesStillChannel).map(|found| found.message.clone())
    };
    assert_eq!(still(&type_2()), None);
    let mut dead = type_2();
    dead.channels[1].fill(0.3);
    let message = still(&dead).unwrap();
    assert!(message.contains("a load of 713 N, but channel 2 has one value"), "{message}");
    dead.channels.iter_mut().for_each(|channel| channel.fill(0.0));
    assert_eq!(still(&dead), None, "nobody stepped on the plate");
    // A point has no moments, and does not move under a load that rests.
    assert_eq!(still(&File::step(1, [0.0; 3], &[30.0, -50.0, -700.0, 50.0, 100.0, -4000.0])), None);
}

#[test]
fn plates_may_have_different_heights() {
    let mut step = type_2();
    step.corners_mm.iter_mut().for_each(|c| c[2] += 150.0);
    let mut findings = Findings::default();
    let plates = plates_from_c3d(&record(&[type_2(), step]), PlateSettings::default(), &mut findings).unwrap();
    assert_person(&plates[0]);
    assert_vector(plates[1].center_of_pressure(LOADED), [0.25, 0.2, 0.15], 1e-6);
    // (0.25, 0.2, 0.15) × F + (0, 0, 4): 0.15 m above, the moments differ by 0.15·(-50, 30).
    assert_vector(plates[1].moment[LOADED], [140.0 - 7.5, -175.0 + 4.5, 10.5], ROUNDING);
}

#[test]
fn a_plate_that_cannot_be_read_is_left_out_with_the_reason_and_the_others_stay() {
    let read = |spoiled: File| {
        let mut findings = Findings::default();
        let plates = plates_from_c3d(&record(&[type_2(), spoiled]), PlateSettings::default(), &mut findings).unwrap();
        assert_eq!(plates.len(), 1, "{findings:?}");
        assert_person(&plates[0]);
        let finding = findings.as_slice().iter().find(|f| f.code == Code::PlatesUnusable).unwrap();
        finding.message.clone()
    };
    let unknown = File { kind: 21, ..type_2() };
    assert!(read(unknown).contains("type 21"));
    let point = File { corners_mm: [[0.0; 3]; 4], ..type_2() };
    assert!(read(point).contains("shortest edge"));
    let crossed = File { corners_mm: [CORNERS_MM[0], CORNERS_MM[2], CORNERS_MM[1], CORNERS_MM[3]], ..type_2() };
    assert!(read(crossed).contains("do not form a rectangle"));
    let few = File { channels: type_2().channels[..4].to_vec(), ..type_2() };
    assert!(read(few).contains("4 channels"));
    let unmixed = File { kind: 5, channels: vec![vec![0.0; 80]; 8], ..type_2() };
    assert!(read(unmixed).contains("calibration matrix"));
}

#[test]
fn a_plate_without_sensor_distances_gives_forces_and_a_warning() {
    let (plate, findings) = read(&File::step(3, [0.0; 3], &TYPE_3));
    assert_vector(plate.force[LOADED], [30.0, 50.0, 700.0], ROUNDING);
    assert!(findings.has(Code::PlatesNoSensorDistance));
}

#[test]
fn type_4_without_a_matrix_is_assumed_calibrated_and_reported() {
    let (plate, findings) = read(&File::step(4, ORIGIN_2, &TYPE_2));
    assert_person(&plate);
    assert!(findings.has(Code::PlatesNoCalibration));
}

#[test]
fn the_size_of_a_plate_tells_an_unknown_unit() {
    let mut file = type_2().record();
    file.point_unit = "furlong".to_owned();
    let mut findings = Findings::default();
    let plates = plates_from_c3d(&file, PlateSettings::default(), &mut findings).unwrap();
    assert!(((plates[0].corners[0] - plates[0].corners[1]).norm() - 0.4).abs() < 1e-6);
    assert!(findings.has(Code::FileUnitGuessed));
}

#[test]
fn lengths_of_no_plate_in_any_unit_are_an_error_that_names_the_parameter() {
    let mut file = File { corners_mm: CORNERS_MM.map(|corner| corner.map(|x| 1e4 * x)), ..type_2() }.record();
    file.point_unit = "furlong".to_owned();
    let error = plates_from_c3d(&file, PlateSettings::default(), &mut Findings::default()).unwrap_err();
    assert!(error.to_string().contains("POINT:UNITS is `furlong`"), "{error}");
}

#[test]
fn plates_of_four_hundred_metres_or_four_centimetres_were_written_in_another_unit() {
    for (unit, factor) in [("m", 1.0), ("mm", 0.1)] {
        let mut file = type_2();
        file.corners_mm.iter_mut().flatten().for_each(|corner| *corner *= factor);
        let mut file = file.record();
        file.point_unit = unit.to_owned();
        let mut findings = Findings::default();
        let plates = plates_from_c3d(&file, PlateSettings::default(), &mut findings).unwrap();
        let edge_m = (plates[0].corners[0] - plates[0].corners[1]).norm();
        assert!((edge_m - 0.4).abs() < 1e-6, "{unit} {edge_m}");
        assert!(findings.has(Code::PlatesUnitChanged));
        if unit == "m" {
            assert_person(&plates[0]);
        }
    }
}

#[test]
fn volts_without_a_matrix_and_unused_polynomials_are_reported() {
    let mut file = type_2();
    file.units[0] = "V";
    assert!(read(&file).1.has(Code::PlatesUnitUnknown));
    let mut record = type_2().record();
    let polynomial = ambulo_formats::c3d::Values::Reals(vec![0.1; 12]);
    let parameter = ambulo_formats::c3d::Parameter::list("FPCOPPOLY", polynomial);
    record.parameters.groups[0].parameters.push(parameter);
    let mut findings = Findings::default();
    plates_from_c3d(&record, PlateSettings::default(), &mut findings).unwrap();
    assert!(findings.has(Code::PlatesPolynomial));
}

#[test]
fn rotating_the_axes_rotates_all_vectors() {
    let (plate, _) = read(&type_2());
    let world_from_lab = Mat3::new(0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0);
    let turned = plate.rotated(&world_from_lab);
    assert_vector(turned.force[LOADED], [50.0, 700.0, 30.0], ROUNDING);
    assert_vector(turned.center_of_pressure(LOADED), [0.2, 0.0, 0.25], 1e-6);
    assert!((turned.free_moment(LOADED) - plate.free_moment(LOADED)).abs() < 1e-9);
    assert!((turned.vertical(LOADED) - plate.vertical(LOADED)).abs() < 1e-9);
}

#[test]
fn depth_is_the_distance_to_the_nearest_edge() {
    let (plate, _) = read(&type_2());
    for (point, expected) in [
        ([0.2, 0.3, 0.0], 0.2),
        ([0.05, 0.3, 0.4], 0.05),
        ([0.2, 0.58, 0.0], 0.02),
        ([-0.03, 0.3, 0.0], -0.03),
        ([0.2, 0.7, 0.0], -0.1),
    ] {
        let depth = plate.depth_inside(Vec3::from(point));
        assert!((depth - expected).abs() < 1e-6, "{point:?}: {depth}");
    }
}

/// Without a step, the shape of the load does not show the unit; that somebody stands still above the plate does.
#[test]
fn somebody_who_stands_still_on_a_plate_in_kilonewtons_weighs_a_person() {
    let mut file = levels(&[0.7, 0.7]);
    file.markers_mm = vec![[200.0, 300.0, 900.0], [250.0, 200.0, 50.0]];
    let (plate, findings) = read(&file);
    assert!((plate.vertical(5) - 700.0).abs() < 0.01, "{}", plate.vertical(5));
    let found = findings.as_slice().iter().find(|finding| finding.code == Code::PlatesUnitByWeight).unwrap();
    assert!(found.message.starts_with("the person who stands on the force plates weighs 0.7 N"), "{}", found.message);
    // An offset of a plate on which nobody stands, and a load that changes, are no weight.
    let beside = File { markers_mm: vec![[1400.0, 300.0, 900.0], [1450.0, 200.0, 50.0]], ..file.clone() };
    let changing = File { markers_mm: file.markers_mm.clone(), ..levels(&[0.7, 0.2]) };
    for file in [beside, changing] {
        let (plate, findings) = read(&file);
        assert!(plate.vertical(5) < 1.0 && !findings.has(Code::PlatesUnitByWeight), "{:?}", findings.as_slice());
    }
}
