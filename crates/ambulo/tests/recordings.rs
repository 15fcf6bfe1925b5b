//! From a table to a trajectory: units, names, times, gaps, filters, and coordinates that are not recorded.

use crate::free_bodies::{DOWN_Y, ball, coordinate_ids, free, free_bodies, weld};
use ambulo::findings::{Code, Findings, Severity};
use ambulo::kinematics::{Trajectory, TrajectoryError};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::{Body, Coordinate, CoordinateKind, Drive, Function, Model};
use ambulo::motion::filter::LowPass;
use ambulo::motion::{
    Motion, MotionError, SmoothMotion, SmoothSettings, Smoother, TimeGrid, Window, coordinates_from_table, smooth,
};
use ambulo_formats::table::Table;
use std::f64::consts::{PI, TAU};

/// A handful of roundings of numbers near one.
const ROUNDING: f64 = 1e-12;

#[track_caller]
fn assert_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found} instead of {expected}");
}

/// `pelvis_rx` to `pelvis_tz`.
fn pelvis() -> Model {
    free_bodies(DOWN_Y, &[("pelvis", 10.0)])
}

fn storage(header: &str, rows: &str) -> Table {
    let text = format!("Coordinates\nversion=1\n{header}endheader\n{rows}");
    Table::read_storage(text.as_bytes()).unwrap().0
}

fn import(table: &Table) -> (Result<Motion, MotionError>, Findings) {
    let mut findings = Findings::default();
    (coordinates_from_table(&pelvis(), table, "walk.mot", &mut findings), findings)
}

fn message(table: &Table) -> String {
    import(table).0.unwrap_err().to_string()
}

fn codes(findings: &Findings) -> Vec<(Code, usize)> {
    findings.as_slice().iter().map(|f| (f.code, f.count)).collect()
}

const NAMES: &str = "time\tpelvis_rx\tpelvis_tx\n";

/// Twenty frames at 100 Hz of a pelvis that turns by 1 degree and moves by 10 mm per frame, changed by `change`.
fn turning(change: impl Fn(usize, &mut [f64; 2])) -> Table {
    let row = |i: usize| {
        let mut values = [170.0 + i as f64, 0.01 * i as f64];
        change(i, &mut values);
        format!("{}\t{}\t{}\n", 0.01 * i as f64, values[0], values[1])
    };
    storage("inDegrees=yes\n", &format!("{NAMES}{}", (0..20).map(row).collect::<String>()))
}

#[test]
fn whole_turns_are_removed_from_angles() {
    let (whole, none) = import(&turning(|_, _| ()));
    assert!(none.as_slice().is_empty(), "{none:?}");
    let wrapped = turning(|_, [angle, _]| *angle -= if *angle > 180.0 { 360.0 } else { 0.0 });
    let (motion, findings) = import(&wrapped);
    assert_eq!(codes(&findings), [(Code::MotionUnwrapped, 1)], "{findings:?}");
    let message = &findings.as_slice()[0].message;
    assert!(message.contains("`pelvis_rx`") && message.contains("between frames 11 and 12 (0.1100 s)"), "{message}");
    let columns = |motion: &Result<Motion, MotionError>| motion.as_ref().unwrap().columns[0].clone().unwrap();
    for (found, expected) in columns(&motion).iter().zip(columns(&whole)) {
        assert_near(*found, expected, 1e-9, "angle without whole turns");
    }
    // A single frame that is a whole turn off comes back as well, and the others stay.
    let (motion, findings) = import(&turning(|i, [angle, _]| *angle += if i == 7 { -720.0 } else { 0.0 }));
    assert_eq!(codes(&findings), [(Code::MotionUnwrapped, 1)], "{findings:?}");
    assert!(findings.as_slice()[0].message.contains("and once more"), "{findings:?}");
    assert_near(columns(&motion)[7], 177f64.to_radians(), 1e-9, "the frame that was off");
}

#[test]
fn whole_turns_that_bring_an_angle_into_the_range_of_its_joint_are_removed() {
    let knee = |change: &dyn Fn(usize) -> f64| {
        let row = |i: usize| format!("{}\t{}\t0\t0\n", 0.01 * i as f64, -20.0 - i as f64 + change(i));
        let names = "time\tknee_angle_r\thip_flexion_r\thip_flexion_l\n";
        let table = storage("inDegrees=yes\n", &format!("{names}{}", (0..20).map(row).collect::<String>()));
        let build = Build { table: SegmentTable::DeLevaMale, mass: 70.0, height: 1.75, toe_joint: false };
        let model = build.human().unwrap().model;
        let mut findings = Findings::default();
        let motion = coordinates_from_table(&model, &table, "knee", &mut findings).unwrap();
        (motion.columns[model.coordinate("knee_angle_r").unwrap().index()].clone().unwrap(), findings)
    };
    let (right, none) = knee(&|_| 0.0);
    assert!(none.as_slice().is_empty(), "{none:?}");
    // Most of the frames, all of them, and the other direction.
    let changes: [&dyn Fn(usize) -> f64; 3] = [&|i| if i >= 5 { 360.0 } else { 0.0 }, &|_| 720.0, &|_| -360.0];
    for change in changes {
        let (found, findings) = knee(change);
        assert_eq!(codes(&findings), [(Code::MotionUnwrapped, 1)], "{findings:?}");
        assert!(found.iter().zip(&right).all(|(found, right)| (found - right).abs() < 1e-9), "{found:?}");
    }
    // An angle that no whole turn brings into the range stays.
    let (outside, findings) = knee(&|_| 180.0);
    assert!(findings.as_slice().is_empty() && (outside[0] - 160f64.to_radians()).abs() < 1e-9, "{findings:?}");
}

#[test]
fn jumps_are_named_with_frame_and_column() {
    let (motion, findings) = import(&turning(|i, [angle, _]| *angle += if i >= 12 { 40.0 } else { 0.0 }));
    assert_eq!(codes(&findings), [(Code::MotionJump, 1)], "{findings:?}");
    let message = &findings.as_slice()[0].message;
    assert!(message.contains("`pelvis_rx` jumps by 41.000 deg between frames 12 and 13 (0.1200 s)"), "{message}");
    assert_near(motion.unwrap().columns[0].as_ref().unwrap()[13], 223f64.to_radians(), 1e-9, "a jump stays");
    let (_, findings) = import(&turning(|i, [_, x]| *x += if i == 5 { 0.3 } else { 0.0 }));
    assert_eq!(codes(&findings), [(Code::MotionJump, 1)], "{findings:?}");
    assert!(findings.as_slice()[0].message.contains("`pelvis_tx` jumps by 0.310 m"), "{findings:?}");
    // A fast movement is no jump: its neighbours are fast too.
    let fast = turning(|i, [angle, _]| *angle += 60.0 * (0.4 * i as f64).sin());
    assert!(import(&fast).1.as_slice().is_empty());
}

#[test]
fn degrees_become_radians_and_lengths_stay() {
    let rows = format!("{NAMES}0.0\t90\t0.5\n0.1\t-45\t0.6\n");
    let (motion, findings) = import(&storage("inDegrees=yes\n", &rows));
    let motion = motion.unwrap();
    let column = |i: usize| motion.columns[i].clone().unwrap();
    assert_near(column(0)[0], PI / 2.0, ROUNDING, "angle");
    assert_near(column(0)[1], -PI / 4.0, ROUNDING, "angle");
    assert_eq!(column(3), [0.5, 0.6]);
    assert_eq!(motion.times, [0.0, 0.1]);
    assert_eq!(motion.origin, "walk.mot");
    assert!(motion.columns[1].is_none() && findings.as_slice().is_empty(), "{:?}", findings.as_slice());
    let (motion, findings) = import(&storage("inDegrees=no\n", &format!("{NAMES}0.0\t1.5\t0.5\n")));
    assert_eq!(motion.unwrap().columns[0], Some(vec![1.5]));
    assert!(findings.as_slice().is_empty(), "{:?}", findings.as_slice());
}

#[test]
fn a_header_that_states_no_unit_is_read_as_radians_with_a_warning() {
    let (motion, findings) = import(&storage("", &format!("{NAMES}0.0\t1.5\t0.5\n")));
    assert_eq!(motion.unwrap().columns[0], Some(vec![1.5]));
    assert_eq!(codes(&findings), [(Code::MotionUnitUnstated, 1)]);
    assert_eq!(findings.as_slice()[0].severity(), Severity::Warning);
    // More than a turn is no angle in radians.
    let (motion, findings) = import(&storage("", &format!("{NAMES}0.0\t90\t0.5\n")));
    assert_eq!(motion.unwrap().columns[0], Some(vec![std::f64::consts::FRAC_PI_2]));
    assert_eq!(codes(&findings), [(Code::MotionUnitUnstated, 1)]);
    assert!(findings.as_slice()[0].message.contains("read as degrees, because they exceed 7"));
}

#[test]
fn degrees_under_a_header_that_states_radians_are_detected() {
    let (_, findings) = import(&storage("inDegrees=no\n", &format!("{NAMES}0.0\t30\t0.5\n")));
    assert_eq!(codes(&findings), [(Code::MotionDegreesAsRadians, 1)]);
    let text = &findings.as_slice()[0].message;
    assert!(text.contains("look like degrees: they reach `pelvis_rx` 30") && text.contains("inDegrees=yes"), "{text}");
    // A length of 30 m is not an angle.
    let (_, findings) = import(&storage("inDegrees=no\n", &format!("{NAMES}0.0\t0.3\t30\n")));
    assert!(findings.as_slice().is_empty(), "{:?}", findings.as_slice());
}

#[test]
fn radians_under_a_header_that_states_degrees_are_detected_if_enough_angles_move() {
    let model = free_bodies(DOWN_Y, &[("pelvis", 10.0), ("torso", 10.0)]);
    let names = "time\tpelvis_rx\tpelvis_ry\tpelvis_rz\ttorso_rx\n";
    let read = |rows: &str| {
        let mut findings = Findings::default();
        let table = storage("inDegrees=yes\n", &format!("{names}{rows}"));
        coordinates_from_table(&model, &table, "walk.mot", &mut findings).unwrap();
        codes(&findings)
    };
    assert_eq!(read("0\t0.3\t-1.2\t0.5\t0.7\n"), [(Code::MotionRadiansAsDegrees, 1)]);
    assert_eq!(read("0\t0.3\t-12\t0.5\t0.7\n"), []);
    // Three angles near zero are not enough.
    assert_eq!(read("0\t0.3\t-1.2\t0.5\t0\n"), []);
}

#[test]
fn state_paths_are_coordinates_and_speeds_are_ignored() {
    let names = "time\t/jointset/ground_pelvis/pelvis_rx/value\t/jointset/ground_pelvis/pelvis_rx/speed\tpelvis_tx\n";
    let (motion, findings) = import(&storage("inDegrees=no\n", &format!("{names}0\t0.25\t9\t0.5\n")));
    let motion = motion.unwrap();
    assert_eq!(motion.columns[0], Some(vec![0.25]));
    assert_eq!(motion.columns[3], Some(vec![0.5]));
    assert!(findings.as_slice().is_empty(), "{:?}", findings.as_slice());
}

#[test]
fn an_unknown_column_is_reported_with_the_coordinates_that_have_none() {
    let (motion, findings) = import(&storage("inDegrees=no\n", "time\tpelvis_rx\tpelvis_tilt\n0\t0.1\t0.2\n"));
    assert!(motion.is_ok());
    assert_eq!(codes(&findings), [(Code::MotionUnknownCoordinate, 1)]);
    let text = &findings.as_slice()[0].message;
    assert!(text.contains("no such coordinates: `pelvis_tilt`") && text.contains("pelvis_ry, pelvis_rz"), "{text}");
    assert!(!text.contains("pelvis_rx"), "{text}");
    let text = message(&storage("inDegrees=no\n", "time\thip\tknee\n0\t0.1\t0.2\n"));
    for part in
        ["no column names a coordinate of the model `free bodies`", "found time, hip, knee", "pelvis_rx", "hint:"]
    {
        assert!(text.contains(part), "{text}");
    }
}

#[test]
fn a_repeated_row_is_dropped_and_counted_and_a_contradiction_is_an_error() {
    let rows = format!("{NAMES}0.0\t1\t2\n0.0\t1\t2\n0.1\t1\t3\n0.1\t1\t3\n0.1\t1\t3\n0.2\t1\t3\n");
    let (motion, findings) = import(&storage("inDegrees=no\n", &rows));
    let motion = motion.unwrap();
    assert_eq!(motion.times, [0.0, 0.1, 0.2]);
    assert_eq!(motion.columns[3], Some(vec![2.0, 3.0, 3.0]));
    assert_eq!(codes(&findings), [(Code::MotionRepeatedRow, 3)]);
    let text = message(&storage("inDegrees=no\n", &format!("{NAMES}0.0\t1\t2\n0.1\t1\t2\n0.1\t1\t2.5\n")));
    // Three header lines, names, and the third row: line 8.
    let expected = "line 8: a second row for time 0.1 s with other numbers in `pelvis_tx`; \
                    expected one row per time. \
                    hint: delete one of the two";
    assert_eq!(text, expected);
}

#[test]
fn a_decreasing_or_non_finite_time_is_an_error_with_its_line() {
    let text = message(&storage("inDegrees=no\n", &format!("{NAMES}0.0\t1\t2\n0.2\t1\t2\n0.1\t1\t2\n")));
    assert!(text.starts_with("line 8: time 0.1 s comes after 0.2 s; expected increasing times. hint:"), "{text}");
    for word in ["nan", "inf", "-inf"] {
        let text = message(&storage("inDegrees=no\n", &format!("{NAMES}0.0\t1\t2\n{word}\t1\t2\n")));
        let shown = word.replace("nan", "NaN");
        assert_eq!(text, format!("line 7: the time is {shown}; expected a finite number of seconds"));
    }
    let table = Table::new("", vec![("pelvis_rx".into(), vec![0.0]), ("time".into(), vec![0.0])]).unwrap();
    assert_eq!(message(&table), "the first column is `pelvis_rx`; expected `time`");
}

const RATE_HZ: f64 = 100.0;
const FRAMES: usize = 301;

fn clock() -> Vec<f64> {
    (0..FRAMES).map(|i| i as f64 / RATE_HZ).collect()
}

/// One coordinate recorded at these times; the others are missing.
fn recorded(times: Vec<f64>, values: Vec<f64>) -> Motion {
    let mut columns = vec![None; 6];
    columns[0] = Some(values);
    Motion { origin: "made".into(), times, columns }
}

fn wave(t: f64) -> f64 {
    0.5 * (TAU * t).sin()
}

fn smoothed(motion: &Motion, smoother: Smoother, window: Window) -> (Result<SmoothMotion, MotionError>, Findings) {
    let mut findings = Findings::default();
    (smooth(&pelvis(), motion, SmoothSettings { smoother, window, rate_hz: None }, &mut findings), findings)
}

/// Largest errors of value, rate and acceleration against 0.5 sin(2πt), between 0.3 s and 2.7 s.
fn errors(found: &SmoothMotion) -> [f64; 3] {
    let [x, v, a] = found.columns[0].as_ref().unwrap();
    let mut worst = [0.0_f64; 3];
    for (i, t) in found.grid.times().into_iter().enumerate().filter(|(_, t)| (0.3..2.7).contains(t)) {
        let exact = [wave(t), 0.5 * TAU * (TAU * t).cos(), -TAU * TAU * wave(t)];
        for (worst, (found, exact)) in worst.iter_mut().zip([x[i], v[i], a[i]].into_iter().zip(exact)) {
            *worst = worst.max((found - exact).abs());
        }
    }
    worst
}

#[test]
fn a_short_gap_is_interpolated_and_reported() {
    let mut values: Vec<f64> = clock().into_iter().map(wave).collect();
    values[100..115].fill(f64::NAN);
    values[200] = f64::NAN;
    let (found, findings) = smoothed(&recorded(clock(), values), Smoother::Off, Window::default());
    // The error of a quintic through a hole of width w = 0.16 s is at most (w/2)⁶/6! max|f⁽⁶⁾| = 1.1e-5 of value, twice
    // that where its ends are not given with derivatives.
    let [value, ..] = errors(&found.unwrap());
    assert!(value < 3e-5, "the bridge misses the curve by {value}");
    assert_eq!(codes(&findings), [(Code::MotionGapFilled, 1)]);
    assert_eq!(findings.as_slice()[0].message, "`pelvis_rx`: 16 missing samples were bridged by a spline");
}

#[test]
fn a_long_gap_and_missing_ends_are_errors_that_name_column_and_time() {
    let with = |from: usize, to: usize| {
        let mut values: Vec<f64> = clock().into_iter().map(wave).collect();
        values[from..to].fill(f64::NAN);
        smoothed(&recorded(clock(), values), Smoother::Off, Window::default()).0.unwrap_err().to_string()
    };
    let expected = "expected gaps inside the recording of at most 0.2 s from sample to sample. hint: choose a range \
                    without the gap";
    assert_eq!(with(100, 125), format!("`pelvis_rx` has no number from 1.0000 s to 1.2400 s; {expected}"));
    assert_eq!(with(0, 3), format!("`pelvis_rx` has no number from 0.0000 s to 0.0200 s; {expected}"));
    assert_eq!(with(299, 301), format!("`pelvis_rx` has no number from 2.9900 s to 3.0000 s; {expected}"));
    let none = "`pelvis_rx` has no number in any row; expected a number in every row, or no such column";
    assert_eq!(with(0, 301), none);
}

#[test]
fn a_range_without_missing_ends_and_long_gaps_is_accepted() {
    for (from, to) in [(0, 10), (290, 301), (240, 280)] {
        let mut values: Vec<f64> = clock().into_iter().map(wave).collect();
        values[from..to].fill(f64::NAN);
        let window = Window { from_s: Some(0.2), to_s: Some(2.3) };
        let (found, _) = smoothed(&recorded(clock(), values), Smoother::Off, window);
        assert!(found.is_ok(), "samples {from} to {to} are missing, outside the range: {}", found.unwrap_err());
    }
}

#[test]
fn uneven_time_steps_are_resampled_and_reported() {
    let times: Vec<f64> = clock().iter().enumerate().map(|(i, t)| t + 0.002 * (i as f64 * 0.7).sin()).collect();
    let values = times.iter().map(|&t| wave(t)).collect();
    let (found, findings) = smoothed(&recorded(times, values), Smoother::Off, Window::default());
    let found = found.unwrap();
    // A quintic through samples 0.013 s apart misses 0.5 sin(2πt) by (h/2)⁶/6! (2π)⁶/2 = 4e-13 and its second
    // derivative by some h⁴ (2π)⁶/2 = 9e-4/100.
    let [value, rate, acceleration] = errors(&found);
    assert!(value < 1e-9 && rate < 1e-6 && acceleration < 1e-3, "{value} {rate} {acceleration}");
    assert_eq!(codes(&findings), [(Code::MotionUnevenClock, 1)]);
    let even: Vec<f64> = clock().iter().map(|t| (t * 1e4).round() / 1e4).collect();
    let values = even.iter().map(|&t| wave(t)).collect();
    let (_, findings) = smoothed(&recorded(even, values), Smoother::Off, Window::default());
    assert!(findings.as_slice().is_empty(), "a clock rounded to 0.1 ms is even: {:?}", findings.as_slice());
    // A missing time interval is a gap.
    let holed: Vec<f64> = clock().iter().map(|&t| if t > 1.0 { t + 0.5 } else { t }).collect();
    let values = holed.iter().map(|&t| wave(t)).collect();
    let text = smoothed(&recorded(holed, values), Smoother::Off, Window::default()).0.unwrap_err().to_string();
    assert!(
        text.starts_with("there is no row between 1.0000 s and 1.5100 s; expected steps of at most 0.2 s"),
        "{text}"
    );
}

#[test]
fn tiny_and_large_time_steps_do_not_make_a_huge_grid() {
    // A logger that stamps each sample four times, a microsecond apart: the median step is a microsecond, the recording
    // lasts a second. Resampling at the median step takes a million frames per column, at a nanosecond a billion.
    let times: Vec<f64> = (0..40).map(|i| f64::from(i / 4) * 0.1 + f64::from(i % 4) * 1e-6).collect();
    let values = times.iter().map(|&t| wave(t)).collect();
    let (found, _) = smoothed(&recorded(times, values), Smoother::Off, Window::default());
    let frames = found.map_or(0, |f| f.grid.frames);
    assert!(frames < 100_000, "40 samples became {frames} frames");
}

#[test]
fn a_window_keeps_the_frames_inside_and_changes_no_number() {
    let motion = recorded(clock(), clock().into_iter().map(wave).collect());
    let filter = Smoother::Butterworth(LowPass { order: 3, cutoff_hz: 6.0 });
    let whole = smoothed(&motion, filter, Window::default()).0.unwrap();
    let window = Window { from_s: Some(0.495), to_s: Some(2.0) };
    let part = smoothed(&motion, filter, window).0.unwrap();
    assert_eq!(part.grid.frames, 151);
    assert_near(part.grid.start_s, 0.5, ROUNDING, "first frame [s]");
    assert_near(part.grid.end_s(), 2.0, ROUNDING, "last frame [s]");
    for (whole, part) in whole.columns[0].iter().flatten().zip(part.columns[0].iter().flatten()) {
        // The spline is evaluated at times that differ in the last bit.
        let largest = whole[50..201].iter().zip(part).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(largest < 1e-10, "the window changes a number by {largest}");
    }
}

#[test]
fn too_few_frames_are_an_error_with_the_duration_of_the_recording() {
    let motion = recorded(clock(), clock().into_iter().map(wave).collect());
    let window = |from: f64, to: f64| Window { from_s: Some(from), to_s: Some(to) };
    let text = |motion, window| smoothed(motion, Smoother::Off, window).0.unwrap_err().to_string();
    let hint = "expected at least 6, which rates and accelerations need. hint: choose a longer range; motion and \
        forces \
                are both known from 0.000 s to 3.000 s";
    assert_eq!(text(&motion, window(1.0, 1.04)), format!("the range from 1 s to 1.04 s has 5 frames; {hint}"));
    assert_eq!(text(&motion, window(2.0, 1.0)), format!("the range from 2 s to 1 s has 0 frames; {hint}"));
    assert_eq!(
        text(&motion, window(5.0, 6.0)),
        "the range from 5 s to 6 s is outside of the recorded time, 0.000 s to 3.000 s. hint: choose a range inside \
         the \
         recorded time"
    );
    assert!(smoothed(&motion, Smoother::Off, window(1.0, 1.05)).0.is_ok());
    let short = recorded(clock()[..5].to_vec(), vec![0.0; 5]);
    assert!(text(&short, Window::default()).contains("the recording has 5 frames; expected at least 6"));
}

#[test]
fn without_a_filter_the_samples_stay_and_the_derivatives_are_those_of_a_quintic_spline() {
    let motion = recorded(clock(), clock().into_iter().map(wave).collect());
    let found = smoothed(&motion, Smoother::Off, Window::default()).0.unwrap();
    // A quintic spline misses the second derivative by some h⁴ (2π)⁶/2/720 = 4e-7.
    let [value, rate, acceleration] = errors(&found);
    assert!(value < ROUNDING && rate < 1e-7 && acceleration < 1e-5, "{value} {rate} {acceleration}");
    assert_eq!(found.noise, vec![None; 6]);
}

#[test]
fn butterworth_lowers_a_sine_by_its_gain_and_keeps_its_phase() {
    let motion = recorded(clock(), clock().into_iter().map(wave).collect());
    let low_pass = |cutoff_hz: f64| {
        let filter = LowPass { order: 3, cutoff_hz };
        smoothed(&motion, Smoother::Butterworth(filter), Window::default()).0.unwrap()
    };
    for cutoff in [3.0, 6.0, 12.0] {
        // The sine begins and ends at zero, so its odd reflection is the sine itself; beyond it the start's transient
        // has fallen by exp(-π/2 cutoff 1.5 s), 1e-3 at 3 Hz, times the gain's own error.
        let gain = 1.0 / (1.0 + ((PI / RATE_HZ).tan() / (PI * cutoff / RATE_HZ).tan()).powi(6));
        let found = low_pass(cutoff);
        let [x, v, a] = found.columns[0].as_ref().unwrap();
        for (i, t) in clock().into_iter().enumerate() {
            assert_near(x[i], gain * wave(t), 1e-4, "value");
            assert_near(v[i], gain * 0.5 * TAU * (TAU * t).cos(), 1e-3, "rate");
            assert_near(a[i], -gain * TAU * TAU * wave(t), 1e-2, "acceleration");
        }
    }
    // At 1 Hz half of the sine is left: 25 times what the tolerance above would forgive.
    let lost = errors(&low_pass(1.0))[0];
    assert!(lost > 0.2, "a cut-off at the sine's own frequency takes {lost} only");
}

/// Uniform noise with this standard deviation, from a linear congruential generator (Knuth's MMIX constants).
fn noise(standard_deviation: f64, seed: u64) -> Vec<f64> {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    (0..FRAMES).map(|_| 12.0_f64.sqrt() * standard_deviation * next()).collect()
}

#[test]
fn the_spline_estimates_the_derivatives_of_a_noisy_sine_and_its_noise() {
    const NOISE: f64 = 0.002;
    const SEED: u64 = 7;
    let noisy: Vec<f64> = clock().into_iter().zip(noise(NOISE, SEED)).map(|(t, e)| wave(t) + e).collect();
    let motion = recorded(clock(), noisy);
    let found = smoothed(&motion, Smoother::Spline, Window::default()).0.unwrap();
    let estimate = found.noise[0].unwrap();
    println!("noise {NOISE} rad, estimated {estimate:.6}");
    // 301 samples determine a standard deviation to 1/√602 = 4 %; the spline takes some freedoms: three times that.
    assert_near(estimate, NOISE, 0.12 * NOISE, "standard deviation of the noise");
    assert_eq!(found.noise[1..], [None; 5]);
    // White noise below a cut-off c leaves NOISE √(2c/rate) of value and (2πc)ⁿ/√(2n+1) times that of the n-th
    // derivative. Cross-validation chooses c = 3 to 8 Hz from noise to noise (ten seeds were seen); at 8 Hz that is
    // 8e-4 rad, 0.023 rad/s, 0.9 rad/s². The largest of 240 correlated errors is three times that.
    let [value, rate, acceleration] = errors(&found);
    println!("largest errors {value:.5} rad, {rate:.4} rad/s, {acceleration:.3} rad/s²");
    assert!(value < 2.5e-3 && rate < 0.07, "{value} rad, {rate} rad/s");
    assert!(acceleration < 2.7, "{acceleration} rad/s² of 19.7");
    // Without smoothing the second derivative is noise.
    let [_, _, raw] = errors(&smoothed(&motion, Smoother::Off, Window::default()).0.unwrap());
    assert!(raw > 50.0 * acceleration, "the raw samples give {raw} rad/s²");
}

#[test]
fn a_cutoff_beyond_half_the_rate_is_rejected_with_the_column_and_the_limit() {
    let motion = recorded(clock(), clock().into_iter().map(wave).collect());
    let filter = Smoother::Butterworth(LowPass { order: 3, cutoff_hz: 60.0 });
    let error = smoothed(&motion, filter, Window::default()).0.unwrap_err();
    let cause = std::error::Error::source(&error).map(ToString::to_string).unwrap_or_default();
    let text = format!("{error}: {cause}");
    assert!(text.contains("`pelvis_rx`") && text.contains("60 Hz") && text.contains("below 50 Hz"), "{text}");
}

/// A body at rest with unused coordinates of every kind: leader, follower, locked,
/// prescribed, free.
fn driven() -> Model {
    let ids = coordinate_ids(5);
    let square = Function::Polynomial(vec![1.0, 0.5, 0.25]);
    let sway = Function::Sine { amplitude: 0.2, omega: 3.0, phase: 0.1, offset: 1.0 };
    let drives = [Drive::Free, Drive::Coupled(ids[0], square), Drive::Locked, Drive::Prescribed(sway), Drive::Free];
    let names = ["leader", "follower", "locked", "prescribed", "alone"];
    let coordinate =
        |(name, drive): (&str, Drive)| Coordinate { drive, default_value: 0.7, ..free(name, CoordinateKind::Rotation) };
    let body = Body { name: "stand".into(), inertia: ball(1.0), joint: weld("stand") };
    Model::new("driven", DOWN_Y, vec![body], names.into_iter().zip(drives).map(coordinate).collect(), Vec::new())
        .unwrap()
}

fn complete(columns: Vec<Option<[Vec<f64>; 3]>>) -> (Trajectory, Findings) {
    let grid = TimeGrid { start_s: 0.5, step_s: 0.01, frames: 50 };
    let mut findings = Findings::default();
    let motion = SmoothMotion { grid, noise: vec![None; columns.len()], columns };
    (Trajectory::complete(&driven(), motion, &mut findings).unwrap(), findings)
}

/// 0.4 sin 5t with its derivatives on the grid of `complete`.
fn leader() -> [Vec<f64>; 3] {
    let times: Vec<f64> = (0..50).map(|i| 0.5 + 0.01 * f64::from(i)).collect();
    let series = |f: &dyn Fn(f64) -> f64| times.iter().map(|&t| f(t)).collect();
    [series(&|t| 0.4 * (5.0 * t).sin()), series(&|t| 2.0 * (5.0 * t).cos()), series(&|t| -10.0 * (5.0 * t).sin())]
}

#[test]
fn a_follower_obeys_its_coupler_by_the_chain_rule() {
    let (trajectory, findings) = complete(vec![Some(leader()), None, None, None, None]);
    let ids: Vec<_> = driven().coordinate_ids().collect();
    for frame in 0..50 {
        let [x, v, a] = [0, 1, 2].map(|k| leader()[k][frame]);
        let slope = 2.0 * x + 0.5;
        assert_near(trajectory.values(ids[1])[frame], x * x + 0.5 * x + 0.25, ROUNDING, "value");
        assert_near(trajectory.rates(ids[1])[frame], slope * v, ROUNDING, "rate");
        assert_near(trajectory.accelerations(ids[1])[frame], slope * a + 2.0 * v * v, ROUNDING, "acceleration");
    }
    assert_eq!(codes(&findings), [(Code::MotionMissingCoordinate, 1)]);
}

#[test]
fn recorded_values_of_locked_and_prescribed_coordinates_are_used_as_in_opensim() {
    let other = || Some([vec![0.75; 50], vec![0.5; 50], vec![0.25; 50]]);
    let (trajectory, findings) = complete(vec![Some(leader()), None, other(), other(), Some(leader())]);
    let ids: Vec<_> = driven().coordinate_ids().collect();
    for i in [2, 3] {
        let used = [trajectory.values(ids[i]), trajectory.rates(ids[i]), trajectory.accelerations(ids[i])];
        assert_eq!(used.map(<[f64]>::to_vec), other().unwrap());
    }
    assert_eq!(codes(&findings), [(Code::MotionModelReplaced, 1), (Code::MotionModelReplaced, 1)]);
    let [locked, prescribed] = [0, 1].map(|i| findings.as_slice()[i].message.clone());
    assert!(locked.contains("`locked` is locked in the model; the recorded values, which differ by up to 0.050 rad"));
    assert!(prescribed.contains("`prescribed` is prescribed in the model; the recorded values"), "{prescribed}");
    // Values that agree are no override.
    let same = Some([vec![0.7; 50], vec![0.0; 50], vec![0.0; 50]]);
    assert_eq!(codes(&complete(vec![Some(leader()), None, same, None, Some(leader())]).1), []);
}

#[test]
fn locked_prescribed_and_missing_coordinates_get_their_own_values() {
    let still = || [vec![0.7; 50], vec![0.0; 50], vec![0.0; 50]];
    let nonsense = || Some([vec![9.0; 50], vec![1.0; 50], vec![1.0; 50]]);
    let (trajectory, findings) = complete(vec![Some(leader()), nonsense(), None, None, None]);
    let ids: Vec<_> = driven().coordinate_ids().collect();
    let of = |i: usize| [trajectory.values(ids[i]), trajectory.rates(ids[i]), trajectory.accelerations(ids[i])];
    assert_eq!(of(0), leader());
    assert_eq!(of(2), still());
    assert_eq!(of(4), still());
    for (frame, t) in trajectory.grid().times().into_iter().enumerate() {
        let (s, c) = (3.0 * t + 0.1).sin_cos();
        let expected = [1.0 + 0.2 * s, 0.6 * c, -1.8 * s];
        for (found, expected) in of(3).into_iter().zip(expected) {
            assert_near(found[frame], expected, ROUNDING, "prescribed");
        }
    }
    let found: Vec<&str> = findings.as_slice().iter().map(|f| f.message.as_str()).collect();
    assert!(found.iter().any(|m| m.contains("`follower` follows a coupler of the model")), "{found:?}");
    assert!(found.iter().any(|m| m.contains("no column for `alone` (0.7); the default values")), "{found:?}");
}

#[test]
fn a_follower_recorded_in_degrees_is_detected_and_one_that_agrees_is_not_reported() {
    let follower = |scale: f64| {
        let values = leader()[0].iter().map(|x| scale * (x * x + 0.5 * x + 0.25)).collect();
        Some([values, vec![0.0; 50], vec![0.0; 50]])
    };
    let all = |column| complete(vec![Some(leader()), column, None, None, Some(leader())]).1;
    assert_eq!(codes(&all(follower(1.0))), []);
    let findings = all(follower(1.0_f64.to_degrees()));
    assert_eq!(codes(&findings), [(Code::MotionCoupledMismatch, 1)]);
    assert!(findings.as_slice()[0].message.contains("in degrees under a header that states radians"));
    let findings = all(follower(1.5));
    assert!(!findings.as_slice()[0].message.contains("in degrees"));
}

#[test]
fn numbers_that_are_not_finite_are_rejected_by_the_trajectory() {
    let model = pelvis();
    let grid = TimeGrid { start_s: 1.0, step_s: 0.1, frames: 4 };
    let column = || [vec![0.0; 4], vec![0.0; 4], vec![0.0; 4]];
    let mut columns = vec![column(); 6];
    columns[2][1][3] = f64::INFINITY;
    let text = Trajectory::new(&model, grid, columns).unwrap_err().to_string();
    assert!(text.starts_with("coordinate `pelvis_rz` is not a finite number at 1.3000 s"), "{text}");
    let shape = |what, found, expected| TrajectoryError::Shape { what, found, expected };
    assert_eq!(Trajectory::new(&model, grid, vec![column(); 5]).unwrap_err(), shape("columns", 5, 6));
    let none = TimeGrid { frames: 0, ..grid };
    let empty = vec![[vec![], vec![], vec![]]; 6];
    assert_eq!(Trajectory::new(&model, none, empty).unwrap_err(), TrajectoryError::NoFrames);
    let mut columns = vec![column(); 6];
    columns[4][0].pop();
    assert_eq!(Trajectory::new(&model, grid, columns).unwrap_err(), shape("frames", 3, 4));
}

#[test]
fn a_range_far_away_from_the_recording_is_rejected() {
    let motion = recorded(clock(), clock().into_iter().map(wave).collect());
    let within = |from_s: f64, to_s: f64| {
        let window = Window { from_s: Some(from_s), to_s: Some(to_s) };
        let settings = SmoothSettings { smoother: Smoother::Off, window, rate_hz: None };
        smooth(&pelvis(), &motion, settings, &mut Findings::default())
    };
    for (from_s, to_s) in [(-1e308, 1.0), (0.0, 1e308), (0.0, 1e9), (f64::NAN, 1.0)] {
        let text = within(from_s, to_s).unwrap_err().to_string();
        assert!(text.contains("expected an instant near the recording") && text.len() < 250, "{text}");
    }
    assert_eq!(within(-10.0, 99_999.0).unwrap().grid, within(0.0, 1000.0).unwrap().grid);
}

#[test]
fn another_rate_evaluates_the_same_curve_at_other_times() {
    let motion = recorded(clock(), clock().into_iter().map(wave).collect());
    let at = |rate_hz| {
        let settings = SmoothSettings { smoother: Smoother::Off, window: Window::default(), rate_hz };
        smooth(&pelvis(), &motion, settings, &mut Findings::default())
    };
    let (own, fine) = (at(None).unwrap(), at(Some(4.0 * RATE_HZ)).unwrap());
    assert_eq!(fine.grid.frames, 4 * (own.grid.frames - 1) + 1);
    let (own, fine) = (own.columns[0].as_ref().unwrap(), fine.columns[0].as_ref().unwrap());
    for k in 0..3 {
        for (i, value) in own[k].iter().enumerate() {
            // The same spline at the same instant, but for the rounding of the instant: 1e-16 s times slopes of 60
            // rad/s³.
            assert!((value - fine[k][4 * i]).abs() < 1e-9, "{k} {i}");
        }
    }
    for rate in [0.0, -1.0, f64::NAN, 1e9, 1e-3] {
        assert!(matches!(at(Some(rate)), Err(MotionError::Rate { .. })), "{rate}");
    }
}

#[test]
fn units_behind_names_and_names_in_other_letters_are_understood() {
    let rows = "0\t90\t45\n0.01\t80\t40\n";
    let table = storage("", &format!("time\tpelvis_rx (deg)\tPELVIS_RY [deg]\n{rows}"));
    let (motion, findings) = import(&table);
    let motion = motion.unwrap();
    assert_eq!(codes(&findings), []);
    assert!((motion.columns[0].as_ref().unwrap()[0] - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    assert!((motion.columns[1].as_ref().unwrap()[0] - std::f64::consts::FRAC_PI_4).abs() < 1e-12);
}
