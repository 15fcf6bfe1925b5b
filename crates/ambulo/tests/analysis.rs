//! Events, cycles, peaks, agreement, residual, mass and speed compared with numbers computed by hand.

use crate::free_bodies::{DOWN_Y, free_bodies};
use ambulo::analysis::{
    Agreement, Analysis, AnalysisSettings, ComparisonError, Contact, Curve, Cycle, Event, EventKind, MassSource,
    SHORTEST_CONTACT_S, analyse, compare, contacts_from_force, cycles, events, over_cycle, peak, residual,
    residual_sizes,
};
use ambulo::dynamics::{LoadSeries, Workspace, inverse};
use ambulo::findings::{Code, Findings};
use ambulo::kinematics::Trajectory;
use ambulo::model::{Model, Side};
use ambulo::motion::{ForceRecording, Motion, Smoother, TimeGrid, Window};
use ambulo::spatial::{Vec3, Wrench};
use std::f64::consts::TAU;

/// Several rounding errors of numbers near one.
const ROUNDING: f64 = 1e-12;

#[track_caller]
fn assert_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found} instead of {expected}");
}

/// Foot strike and foot off of each contact; NaN at a cut end.
fn ends(contacts: &[Contact]) -> Vec<[f64; 2]> {
    contacts.iter().map(|c| [c.strike_s.unwrap_or(f64::NAN), c.off_s.unwrap_or(f64::NAN)]).collect()
}

#[track_caller]
fn assert_contacts(times: &[f64], vertical: &[f64], expected: &[[f64; 2]]) {
    let found = ends(&contacts_from_force(times, vertical));
    assert_eq!(found.len(), expected.len(), "{found:?} instead of {expected:?}");
    for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
        let same = (found.is_nan() && expected.is_nan()) || (found - expected).abs() < ROUNDING;
        assert!(same, "{found} instead of {expected}");
    }
}

/// 100 N inside the ranges and zero elsewhere, at 1 kHz for one second.
fn on_and_off(ranges: &[[f64; 2]]) -> (Vec<f64>, Vec<f64>) {
    let times: Vec<f64> = (0..=1000).map(|i| f64::from(i) * 1e-3).collect();
    let loaded = |t: f64| ranges.iter().any(|[from, to]| t > from - 1e-9 && t < to - 1e-9);
    let force = times.iter().map(|&t| if loaded(t) { 100.0 } else { 0.0 }).collect();
    (times, force)
}

const CUT: f64 = f64::NAN;
/// From 0 to 100 N in a millisecond: 20 N is crossed after a fifth of it, on the way back after four fifths.
const RISE: f64 = -0.0008;
const FALL: f64 = -0.0002;

#[test]
fn a_strike_is_interpolated_at_twenty_newtons_between_two_samples() {
    let times = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5];
    // 0 -> 100 N crosses at a fifth, 220 -> 20 N touches at its end, 20 -> -30 N is below.
    assert_contacts(&times, &[0.0, 0.0, 100.0, 220.0, 20.0, -30.0], &[[0.12, 0.4]]);
    assert_contacts(&times, &[0.0, 10.0, 30.0, 60.0, 10.0, 0.0], &[[0.15, 0.38]]);
    // Exactly the threshold is not above it.
    assert_contacts(&times, &[20.0; 6], &[]);
    assert_contacts(&times, &[-700.0; 6], &[]);
}

#[test]
fn a_contact_cut_by_the_recording_has_no_event_at_the_cut() {
    let (times, force) = on_and_off(&[[0.0, 0.3], [0.6, 2.0]]);
    assert_contacts(&times, &force, &[[CUT, 0.3 + FALL], [0.6 + RISE, CUT]]);
    assert_contacts(&times, &vec![700.0; times.len()], &[[CUT, CUT]]);
    // Its length is unknown, so even a short remainder is kept.
    let (times, force) = on_and_off(&[[0.0, 0.02], [0.99, 2.0]]);
    assert_contacts(&times, &force, &[[CUT, 0.02 + FALL], [0.99 + RISE, CUT]]);
}

#[test]
fn gaps_and_contacts_shorter_than_a_twentieth_of_a_second_are_noise() {
    assert_near(SHORTEST_CONTACT_S, 0.05, 0.0, "shortest contact [s]");
    let (times, force) = on_and_off(&[[0.1, 0.3], [0.34, 0.6]]);
    assert_contacts(&times, &force, &[[0.1 + RISE, 0.6 + FALL]]);
    let (times, force) = on_and_off(&[[0.1, 0.3], [0.36, 0.6]]);
    assert_contacts(&times, &force, &[[0.1 + RISE, 0.3 + FALL], [0.36 + RISE, 0.6 + FALL]]);
    let (times, force) = on_and_off(&[[0.1, 0.14], [0.3, 0.36]]);
    assert_contacts(&times, &force, &[[0.3 + RISE, 0.36 + FALL]]);
    // Gaps are closed first: three short pieces are one contact.
    let (times, force) = on_and_off(&[[0.1, 0.13], [0.15, 0.18], [0.2, 0.23]]);
    assert_contacts(&times, &force, &[[0.1 + RISE, 0.23 + FALL]]);
}

fn event(side: Side, kind: EventKind, time_s: f64) -> Event {
    Event { side, kind, time_s }
}

#[test]
fn events_of_both_feet_are_in_order_of_time_and_cut_ends_give_none() {
    let contact = |strike: f64, off: f64| Contact {
        strike_s: strike.is_finite().then_some(strike),
        off_s: off.is_finite().then_some(off),
    };
    let list = [
        (Side::Right, vec![contact(CUT, 0.2), contact(0.6, 1.4)]),
        (Side::Left, vec![contact(0.1, 0.6), contact(1.2, CUT)]),
    ];
    let expected = [
        event(Side::Left, EventKind::Strike, 0.1),
        event(Side::Right, EventKind::Off, 0.2),
        event(Side::Right, EventKind::Strike, 0.6),
        event(Side::Left, EventKind::Off, 0.6),
        event(Side::Left, EventKind::Strike, 1.2),
        event(Side::Right, EventKind::Off, 1.4),
    ];
    assert_eq!(events(&list), expected);
    assert_eq!(EventKind::Strike.word(), "strike");
    assert_eq!(EventKind::Off.word(), "off");
}

#[test]
fn a_cycle_lasts_from_strike_to_strike_of_one_foot_within_the_grid() {
    use EventKind::{Off, Strike};
    let list = [
        event(Side::Right, Strike, 0.1),
        event(Side::Left, Strike, 0.6),
        event(Side::Right, Off, 0.8),
        event(Side::Right, Strike, 1.1),
        event(Side::Left, Strike, 1.65),
        event(Side::Right, Strike, 2.1),
        event(Side::Right, Strike, 3.2),
    ];
    let right = |number, start_s, end_s, foot_off_s| Cycle { side: Side::Right, number, start_s, end_s, foot_off_s };
    let left = Cycle { side: Side::Left, number: 1, start_s: 0.6, end_s: 1.65, foot_off_s: None };
    let whole = TimeGrid { start_s: 0.0, step_s: 0.01, frames: 401 };
    let expected = [right(1, 0.1, 1.1, Some(0.8)), right(2, 1.1, 2.1, None), right(3, 2.1, 3.2, None), left];
    assert_eq!(cycles(&list, whole), expected);
    // A narrower grid cuts the first and the last right cycle; the remaining ones are numbered from 1.
    let narrow = TimeGrid { start_s: 0.5, step_s: 0.01, frames: 200 };
    assert_eq!(cycles(&list, narrow), [right(1, 1.1, 2.1, None), left]);
    // Strikes on the first and the last frame count.
    let exact = TimeGrid { start_s: 1.1, step_s: 0.01, frames: 101 };
    assert_eq!(cycles(&list, exact), [right(1, 1.1, 2.1, None)]);
    assert_eq!(cycles(&[], whole), []);
}

#[test]
fn a_straight_line_stays_straight_over_a_cycle_of_101_samples() {
    let grid = TimeGrid { start_s: 0.4, step_s: 1.0 / 60.0, frames: 120 };
    let cycle = Cycle { side: Side::Left, number: 1, start_s: 0.503, end_s: 1.617, foot_off_s: None };
    let time = |percent: usize| cycle.start_s + percent as f64 / 100.0 * (cycle.end_s - cycle.start_s);
    let line: Vec<f64> = grid.times().iter().map(|t| 2.0 - 3.0 * t).collect();
    let read = over_cycle(grid, &line, &cycle);
    assert_eq!(read.len(), 101);
    for (percent, x) in read.iter().enumerate() {
        assert_near(*x, 2.0 - 3.0 * time(percent), ROUNDING, &format!("line at {percent} %"));
    }
    // A curve is cut by its chords: h²/8 |f''| = (1/60)²/8 τ² = 0.0014 at most.
    let curve: Vec<f64> = grid.times().iter().map(|t| (TAU * t).sin()).collect();
    let missed = over_cycle(grid, &curve, &cycle)
        .iter()
        .enumerate()
        .map(|(percent, x)| (x - (TAU * time(percent)).sin()).abs())
        .fold(0.0, f64::max);
    assert!(missed > 0.0005 && missed < 0.0014, "chords miss the curve by {missed}");
}

#[test]
fn a_peak_has_the_first_time_of_its_extremes() {
    let grid = TimeGrid { start_s: 1.0, step_s: 0.5, frames: 5 };
    let found = peak(grid, &[1.0, 7.0, -2.0, 7.0, -2.0]).unwrap();
    let expected = [(found.max, 7.0), (found.max_at_s, 1.5), (found.min, -2.0), (found.min_at_s, 2.0)];
    for (found, expected) in expected {
        assert_near(found, expected, 0.0, "peak");
    }
    assert!(peak(grid, &[]).is_none());
}

fn agree(a: &[f64], b: &[f64]) -> Agreement {
    let times: Vec<f64> = (0..a.len()).map(|i| i as f64).collect();
    compare(Curve { times: &times, values: a }, Curve { times: &times, values: b }).unwrap()
}

#[test]
fn agreement_has_the_textbook_values() {
    // Differences 0, 0, 2; ranges 2 and 4; covariance 4/3, variances 2/3 and 26/9.
    let found = agree(&[0.0, 1.0, 2.0], &[0.0, 1.0, 4.0]);
    assert_near(found.rmse, (4.0_f64 / 3.0).sqrt(), ROUNDING, "rmse");
    assert_near(found.rrmse, (4.0_f64 / 3.0).sqrt() / 3.0, ROUNDING, "rrmse");
    assert_near(found.r, (4.0 / 3.0) / (2.0_f64 / 3.0 * 26.0 / 9.0).sqrt(), ROUNDING, "r");
    assert_near(found.max_difference, 2.0, 0.0, "largest difference");
    assert_eq!(found.samples, 3);
}

#[test]
fn rmse_rrmse_and_r_detect_different_errors() {
    let wave: Vec<f64> = (0..100).map(|i| (TAU * f64::from(i) / 100.0).sin()).collect();
    let same = agree(&wave, &wave);
    assert_near(same.rmse, 0.0, 0.0, "rmse of equals");
    assert_near(same.r, 1.0, ROUNDING, "r of equals");
    // A wrong sign: r = -1, RMSE = 2 / √2, half of twice the range.
    let negated: Vec<f64> = wave.iter().map(|x| -x).collect();
    let opposite = agree(&wave, &negated);
    assert_near(opposite.r, -1.0, ROUNDING, "r of opposites");
    assert_near(opposite.rmse, 2.0_f64.sqrt(), ROUNDING, "rmse of opposites");
    assert_near(opposite.rrmse, 2.0_f64.sqrt() / 2.0, ROUNDING, "rrmse of opposites");
    // The correlation does not detect an offset and a wrong scale; the RMSE does.
    let shifted: Vec<f64> = wave.iter().map(|x| 3.0 * x + 5.0).collect();
    let shifted = agree(&wave, &shifted);
    assert_near(shifted.r, 1.0, ROUNDING, "r of a scaled and shifted curve");
    assert_near(shifted.rmse, (25.0 + 4.0 * 0.5_f64).sqrt(), ROUNDING, "rmse of a scaled and shifted curve");
    // A quarter of a cycle late: no correlation.
    let late: Vec<f64> = (0..100).map(|i| (TAU * f64::from(i + 25) / 100.0).sin()).collect();
    assert_near(agree(&wave, &late).r, 0.0, ROUNDING, "r of a curve a quarter late");
    // Flat curves have no range and no correlation.
    let flat = agree(&[2.0; 4], &[3.0; 4]);
    assert!(flat.r.is_nan() && flat.rrmse.is_infinite(), "{flat:?}");
    assert_near(flat.rmse, 1.0, 0.0, "rmse of flat curves");
}

#[test]
fn curves_are_compared_at_the_common_times_of_the_second() {
    let (coarse, fine) = ([0.0, 1.0, 2.0], [0.5, 1.0, 1.5, 2.0, 2.5]);
    let a = Curve { times: &coarse, values: &[0.0, 10.0, 0.0] };
    let found = compare(a, Curve { times: &fine, values: &[5.0, 10.0, 5.0, 0.0, 99.0] }).unwrap();
    assert_eq!(found.samples, 4);
    assert_near(found.rmse, 0.0, ROUNDING, "rmse on the chords");
    let error = compare(a, Curve { times: &[3.0, 4.0], values: &[0.0, 0.0] }).unwrap_err();
    let expected = "no common time: one curve covers 0 s to 2 s, the other 3 s to 4 s; expected an overlap";
    assert_eq!(error.to_string(), expected);
    let error = compare(a, Curve { times: &fine, values: &[5.0, f64::NAN, 5.0, 0.0, 1.0] }).unwrap_err();
    assert_eq!(error, ComparisonError::NotFinite { time_s: 1.0 });
}

const STEP: f64 = 0.01;
const FRAMES: usize = 301;

fn grid() -> TimeGrid {
    TimeGrid { start_s: 0.0, step_s: STEP, frames: FRAMES }
}

#[test]
fn the_residual_of_a_body_at_rest_is_its_weight_and_zero_on_a_plate() {
    let model = free_bodies(DOWN_Y, &[("pelvis", 50.0), ("foot_r", 20.0)]);
    let (pelvis, foot) = (model.body("pelvis").unwrap(), model.body("foot_r").unwrap());
    let mut columns = vec![[vec![0.0; FRAMES], vec![0.0; FRAMES], vec![0.0; FRAMES]]; 12];
    // The foot 0.3 m in front of the pelvis: its weight turns about the first root.
    columns[9][0] = vec![0.3; FRAMES];
    let trajectory = Trajectory::new(&model, grid(), columns).unwrap();
    let load = |body, up: f64| LoadSeries {
        body,
        points: vec![Vec3::zeros(); FRAMES],
        wrenches: vec![
            Wrench { force: Vec3::new(0.0, up, 0.0), moment: Vec3::new(0.0, 0.0, 0.3 * up * 20.0 / 70.0) };
            FRAMES
        ],
    };
    let of =
        |loads: &[LoadSeries]| residual(&model, &inverse(&mut Workspace::new(&model), &trajectory, loads)).unwrap();
    let unloaded = of(&[]);
    for force in [unloaded.force_rms_n, unloaded.force_peak_n] {
        assert_near(force, 70.0 * 9.81, 1e-10, "residual force [N]");
    }
    for moment in [unloaded.moment_rms_nm, unloaded.moment_peak_nm] {
        assert_near(moment, 0.3 * 20.0 * 9.81, 1e-10, "residual moment [N.m]");
    }
    // The total does not depend on the body on which the force acts.
    for body in [pelvis, foot] {
        let carried = of(&[load(body, 70.0 * 9.81)]);
        assert_near(carried.force_peak_n, 0.0, 1e-10, "residual force [N]");
        assert_near(carried.moment_peak_nm, 0.0, 1e-10, "residual moment [N.m]");
    }
    let mut half = load(pelvis, 70.0 * 9.81);
    half.wrenches[..150].fill(Wrench::ZERO);
    let half = of(&[half]);
    assert_near(half.force_peak_n, 70.0 * 9.81, 1e-10, "peak [N]");
    assert_near(half.force_rms_n, 70.0 * 9.81 * (150.0 / 301.0_f64).sqrt(), 1e-9, "root mean square [N]");
}

#[test]
fn the_residual_of_each_frame_is_the_weight_that_the_plate_does_not_carry() {
    let model = free_bodies(DOWN_Y, &[("pelvis", 50.0)]);
    let columns = vec![[vec![0.0; FRAMES], vec![0.0; FRAMES], vec![0.0; FRAMES]]; 6];
    let trajectory = Trajectory::new(&model, grid(), columns).unwrap();
    let weight = 50.0 * 9.81;
    let share = |frame: usize| frame as f64 / (FRAMES - 1) as f64;
    // Carried beside the centre: the moment of what is carried is left.
    let wrench = |frame| {
        let force = Vec3::new(0.0, share(frame) * weight, 0.0);
        Wrench { force, moment: Vec3::new(0.1, 0.0, 0.0).cross(&force) }
    };
    let load = LoadSeries {
        body: model.body("pelvis").unwrap(),
        points: vec![Vec3::zeros(); FRAMES],
        wrenches: (0..FRAMES).map(wrench).collect(),
    };
    let sizes = residual_sizes(&model, &inverse(&mut Workspace::new(&model), &trajectory, &[load]));
    assert_eq!(sizes.len(), FRAMES);
    for (frame, [force, moment]) in sizes.into_iter().enumerate() {
        assert_near(force, (1.0 - share(frame)) * weight, 1e-10, "force [N]");
        assert_near(moment, 0.1 * share(frame) * weight, 1e-10, "moment [N.m]");
    }
}

const MASS: f64 = 70.0;

/// A body of 70 kg over two feet without mass.
fn walker() -> Model {
    free_bodies(DOWN_Y, &[("torso", MASS), ("calcn_r", 0.0), ("calcn_l", 0.0)])
}

/// The torso and the feet slide along x with these speeds [m/s].
fn sliding(torso: f64, feet: f64) -> Motion {
    let column = |speed: f64| Some(grid().times().iter().map(|t| speed * t).collect());
    let mut columns = vec![Some(vec![0.0; FRAMES]); 18];
    (columns[3], columns[9], columns[15]) = (column(torso), column(feet), column(feet));
    Motion { origin: "made".into(), times: grid().times(), columns }
}

/// Both feet together carry `share` of the weight at any instant; each in turn, a cycle of one second.
fn alternating(model: &Model, share: f64) -> Vec<ForceRecording> {
    let weight = share * MASS * 9.81;
    let times: Vec<f64> = (0..=600).map(|i| f64::from(i) * 0.005).collect();
    // 0 to 1 over a tenth of a second at 0.2, back at 0.7, in each second.
    let ramp = |t: f64, at: f64| ((t - at) / 0.1).clamp(0.0, 1.0);
    let right = |t: f64| ramp(t.fract(), 0.2) - ramp(t.fract(), 0.7);
    let foot = |name: &str, load: &dyn Fn(f64) -> f64| ForceRecording {
        name: name.into(),
        body: model.body(name).unwrap(),
        force_frame: None,
        point_frame: None,
        force: times.iter().map(|&t| Vec3::new(0.0, load(t), 0.0)).collect(),
        point: vec![Vec3::zeros(); times.len()],
        moment: vec![Vec3::zeros(); times.len()],
        times: times.clone(),
    };
    vec![foot("calcn_r", &|t| weight * right(t)), foot("calcn_l", &|t| weight * (1.0 - right(t)))]
}

fn run(model: &Model, motion: &Motion, plates: &[ForceRecording]) -> (Analysis, Findings) {
    let settings = AnalysisSettings {
        smoother: Smoother::Off,
        force_filter: None,
        window: Window::default(),
        rate_hz: None,
        instrumented: None,
    };
    let mut findings = Findings::default();
    let analysis = analyse(model, motion, plates, settings, &mut findings).unwrap();
    (analysis, findings)
}

#[test]
fn the_mass_is_the_mean_vertical_force_over_whole_cycles() {
    let model = walker();
    for share in [1.0, 0.98, 1.02] {
        let (analysis, findings) = run(&model, &sliding(1.3, 0.0), &alternating(&model, share));
        assert_eq!(analysis.mass.source, MassSource::Plates);
        // The sum of both feet is constant; the trapezium rule is exact for it.
        assert_near(analysis.mass.kg, share * MASS, 1e-9, "mass [kg]");
        assert!(findings.as_slice().is_empty(), "{:?}", findings.as_slice());
        // Right strikes at 0.2 s and a little, every second: two cycles; left ones at 0.7 s.
        let sides: Vec<_> = analysis.cycles.iter().map(|c| (c.side, c.number)).collect();
        assert_eq!(sides, [(Side::Right, 1), (Side::Right, 2), (Side::Left, 1), (Side::Left, 2)]);
    }
}

#[test]
fn loads_that_a_file_of_two_feet_cannot_keep_apart_are_named() {
    let model = free_bodies(DOWN_Y, &[("torso", MASS), ("calcn_r", 0.0), ("toes_r", 0.0), ("calcn_l", 0.0)]);
    let mut motion = sliding(1.3, 0.0);
    motion.columns.resize(24, Some(vec![0.0; FRAMES]));
    let [right, left] = &alternating(&model, 1.0)[..] else { panic!("two feet") };
    let on = |load: &ForceRecording, body: &str, share: f64| ForceRecording {
        name: body.into(),
        body: model.body(body).unwrap(),
        force: load.force.iter().map(|force| force * share).collect(),
        ..load.clone()
    };
    let said = |plates: &[ForceRecording]| {
        let (_, findings) = run(&model, &motion, plates);
        let of =
            |code: Code| findings.as_slice().iter().filter(|f| f.code == code).map(|f| f.message.clone()).collect();
        [of(Code::LoadsNoSide), of(Code::LoadsSeveralBodies)] as [Vec<String>; 2]
    };
    assert!(said(&[right.clone(), left.clone()]).iter().all(Vec::is_empty));
    let [no_side, several] = said(&[on(right, "calcn_r", 0.7), on(right, "toes_r", 0.3), left.clone()]);
    assert!(no_side.is_empty());
    assert!(
        matches!(&several[..], [one] if one.contains("calcn_r and toes_r") && one.contains("right")),
        "{several:?}"
    );
    let [no_side, several] = said(&[right.clone(), on(left, "calcn_l", 0.9), on(left, "torso", 0.1)]);
    assert!(matches!(&no_side[..], [one] if one.contains("`torso`")), "{no_side:?}");
    assert!(several.is_empty());
}

#[test]
fn different_masses_of_plates_and_model_give_a_warning() {
    let model = walker();
    let (analysis, findings) = run(&model, &sliding(1.3, 0.0), &alternating(&model, 1.05));
    assert_near(analysis.mass.kg, 1.05 * MASS, 1e-9, "mass [kg]");
    let message = &findings.as_slice()[0].message;
    assert!(
        findings.has(Code::MassMismatch) && message.contains("73.5 kg") && message.contains("70.0 kg"),
        "{message}"
    );
}

#[test]
fn plates_under_one_foot_only_do_not_give_the_mass() {
    let model = walker();
    let plates = alternating(&model, 1.0);
    let (analysis, findings) = run(&model, &sliding(1.3, 0.0), &plates[..1]);
    assert_eq!(analysis.mass.source, MassSource::Model);
    assert_near(analysis.mass.kg, MASS, 0.0, "mass [kg]");
    let message = &findings.as_slice()[0].message;
    assert!(findings.has(Code::CyclesOtherFootUnseen) && message.contains("right cycle 1"), "{message}");
    assert!(findings.has(Code::ResidualLarge), "half of the weight is missing");
    // Without a whole cycle there is no mass from plates and no warning.
    let (analysis, findings) = run(&model, &sliding(1.3, 0.0), &[]);
    assert_eq!(analysis.mass.source, MassSource::Model);
    assert!(findings.as_slice().is_empty() && analysis.cycles.is_empty(), "{:?}", findings.as_slice());
}

#[test]
fn the_speed_is_relative_to_the_ground_or_the_belt() {
    let model = walker();
    let plates = alternating(&model, 1.0);
    // A spline through a straight line is that line.
    let speed = |torso, feet| run(&model, &sliding(torso, feet), &plates).0.speed_m_s.unwrap();
    assert_near(speed(1.3, 0.0), 1.3, 1e-9, "overground [m/s]");
    assert_near(speed(0.0, -1.3), 1.3, 1e-9, "treadmill [m/s]");
    assert_near(speed(0.1, -1.3), 1.4, 1e-9, "treadmill, drifting forward [m/s]");
    assert_near(speed(0.0, 0.0), 0.0, 1e-9, "standing [m/s]");
    // Without a foot on the ground the speed is unknown.
    assert_eq!(run(&model, &sliding(1.3, 0.0), &[]).0.speed_m_s, None);
}

#[test]
fn forces_shorter_than_the_motion_limit_the_window_with_a_warning() {
    let model = walker();
    let mut plates = alternating(&model, 1.0);
    let keep = |plate: &ForceRecording| plate.times.iter().filter(|&&t| t <= 2.0).count();
    for plate in &mut plates {
        let kept = keep(plate);
        plate.times.truncate(kept);
        plate.force.truncate(kept);
        plate.point.truncate(kept);
        plate.moment.truncate(kept);
    }
    let (analysis, findings) = run(&model, &sliding(1.3, 0.0), &plates);
    assert_near(analysis.trajectory.grid().end_s(), 2.0, 1e-9, "end of the window [s]");
    assert!(findings.has(Code::LoadsShorterThanMotion), "{:?}", findings.as_slice());
}
