//! Synthetic walks through the analysis of recordings: the forces that come out are those that the simulator applied.
//!
//! | claim                                                        | tolerance and its reason                                   |
//! |--------------------------------------------------------------|------------------------------------------------------------|
//! | inverse dynamics under the simulated ground forces gives the | 0.6 N.m: the body's weight (735 N) times half the way of a |
//! | simulator's efforts                                          | step of 1 ms (0.65 mm); less than a third at 4 kHz         |
//! | cycles repeat                                                | 2 % of the largest moment                                  |
//! | mean vertical force over a cycle is the weight               | 0.5 % (the issue's)                                        |

use crate::walks::{self, MAN};
use ambulo::analysis::{Analysis, ForceSource, MassSource, analyse_trajectory};
use ambulo::findings::{Code, Findings};
use ambulo::gait::Gait;
use ambulo::model::Side;
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::simulation::synthetic::{SyntheticError, SyntheticMode, SyntheticWalk, SyntheticWalkSettings, synthesise};

fn order<'a>(gait: &'a Gait, build: Build, mode: SyntheticMode) -> SyntheticWalkSettings<'a> {
    SyntheticWalkSettings { gait, build, mode, cycles: 2, rate_hz: 100.0 }
}

fn made(gait: &str, build: Build, mode: SyntheticMode) -> &'static walks::Made {
    walks::made(gait, build, mode, 2)
}

fn analysed(walk: &SyntheticWalk) -> Analysis {
    let (model, mut findings) = (&walk.human.model, Findings::default());
    let trajectory = walk.trajectory.clone();
    analyse_trajectory(model, trajectory, &walk.loads, ForceSource::Simulated, &mut findings).unwrap()
}

/// Largest difference between moments of inverse dynamics and the simulator's efforts, with the coordinate [N.m].
fn worst_moment(walk: &SyntheticWalk, analysis: &Analysis) -> (f64, String) {
    let mut worst = (0.0, String::new());
    for (id, coordinate) in walk.human.model.coordinates().iter().enumerate() {
        if coordinate.name == "pelvis_tx" || coordinate.name == "pelvis_ty" {
            continue;
        }
        for (found, applied) in analysis.forces.generalized[id].iter().zip(&walk.efforts[id]) {
            if (found - applied).abs() > worst.0 {
                worst = ((found - applied).abs(), coordinate.name.clone());
            }
        }
    }
    worst
}

#[test]
fn inverse_dynamics_gives_the_efforts_of_the_simulator() {
    for toe_joint in [true, false] {
        let (walk, _) = made("free", Build { toe_joint, ..MAN }, SyntheticMode::Corrected);
        let analysis = analysed(walk);
        let (worst, name) = worst_moment(walk, &analysis);
        println!("toe joint {toe_joint}: moments differ by {worst:.4} N.m at most, {name}");
        assert!(worst < 0.6, "{name}: {worst} N.m");
        // Nothing but the ground carries the body: the root's slides have no force.
        let residual = analysis.residual.unwrap();
        println!("root: {residual:?}");
        assert!(residual.force_peak_n < 2.0, "{residual:?}");
        // Of the moments it is the one that holds the trunk; what holds the figure in its plane is none.
        let tilt = walk.human.model.coordinate("pelvis_tilt").unwrap().index();
        let held = analysis.forces.generalized[tilt].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        assert!((residual.moment_peak_nm - held).abs() < 1e-9, "{residual:?}, {held} N.m");
    }
}

#[test]
fn inverse_dynamics_gives_the_moments_of_an_optimal_walk() {
    let (walk, findings) = made("free", MAN, SyntheticMode::Optimal);
    assert!(findings.as_slice().is_empty(), "{findings:?}");
    let analysis = analysed(walk);
    let (worst, name) = worst_moment(walk, &analysis);
    let residual = analysis.residual.unwrap();
    println!("moments differ by {worst:.4} N.m at most, {name}; root: {residual:?}");
    // Forces are sampled each millisecond and interpolated between: half a step of 1.3 mm/ms under the body's weight.
    assert!(worst < 0.6, "{name}: {worst} N.m");
    // Between the instants of the problem a little remains (docs/measured/OPTIMAL_WALK.md).
    assert!(residual.force_rms_n < 5.0 && residual.moment_rms_nm < 3.0, "{residual:?}");
    let bare = SyntheticWalk { loads: Vec::new(), ..walk.clone() };
    assert!(analysed(&bare).residual.unwrap().force_peak_n > 700.0);
}

#[test]
fn an_optimal_walk_repeats_itself_in_three_dimensions() {
    let (walk, _) = made("free", MAN, SyntheticMode::Optimal);
    let analysis = analysed(walk);
    let whole = |side: Side| analysis.cycles.iter().filter(|cycle| cycle.side == side).count();
    assert_eq!(Side::BOTH.map(whole), [2, 2]);
    for cycle in &analysis.cycles {
        assert!((cycle.end_s - cycle.start_s - walk.walk.cycle_s()).abs() < 2e-3 && cycle.foot_off_s.is_some());
    }
    let report = &walk.report;
    assert!(report.slip.is_some_and(|slip| slip.excursion < 0.006), "{:?}", report.slip);
    assert!((report.flight_s, report.impacts.0, report.unsolved_steps) == (0.0, 0, 0), "{report:?}");
    let [force, moment] = report.correction.as_ref().unwrap().residual;
    assert!(force.rms < 5.0 && moment.rms < 3.0, "{force:?}, {moment:?}");
    let range = |name: &str| {
        let values = walk.trajectory.values(walk.human.model.coordinate(name).unwrap());
        let (low, high) = values.iter().fold((f64::MAX, f64::MIN), |(a, b), &x| (a.min(x), b.max(x)));
        high - low
    };
    // A figure on two rails has none of these.
    for (name, least) in
        [("pelvis_list", 0.08), ("pelvis_rotation", 0.08), ("pelvis_tz", 0.01), ("hip_adduction_r", 0.1)]
    {
        assert!(range(name) > least, "{name}: {} rad or m", range(name));
    }
}

#[test]
fn cycles_and_rate_do_not_change_an_optimal_walk() {
    let gait = Gait::named("free").unwrap();
    let make = |cycles, rate_hz| {
        let order = SyntheticWalkSettings { rate_hz, cycles, ..order(&gait, MAN, SyntheticMode::Optimal) };
        synthesise(&order, &mut Findings::default()).unwrap()
    };
    let (short, long) = (make(1, 100.0), make(3, 200.0));
    let ankle = short.human.model.coordinate("ankle_angle_r").unwrap();
    for frame in 0..short.trajectory.grid().frames {
        let (a, b) = (short.trajectory.values(ankle)[frame], long.trajectory.values(ankle)[2 * frame]);
        assert!((a - b).abs() < 1e-12, "frame {frame}: {a} and {b} rad");
    }
    let (a, b) = (&short.loads[0], &long.loads[0]);
    let one_cycle = (short.walk.cycle_s() / (a.times[1] - a.times[0])).round() as usize;
    let stride = short.walk.speed() * short.walk.cycle_s();
    for row in 0..one_cycle {
        assert!((a.force[row] - b.force[row]).norm() < 1e-9);
        // A cycle later the same force acts a stride further on.
        let moved = a.moment[row] + ambulo::spatial::Vec3::new(stride, 0.0, 0.0).cross(&a.force[row]);
        assert!((b.moment[row + one_cycle] - moved).norm() < 1e-6, "row {row}");
    }
}

#[test]
fn gaits_take_the_mode_that_can_compute_them() {
    let leg_length = MAN.human().unwrap().dimensions.leg_length;
    let mode = |change: &dyn Fn(&mut Gait, &mut Build)| {
        let (mut gait, mut build) = (Gait::named("free").unwrap(), MAN);
        change(&mut gait, &mut build);
        SyntheticMode::of(&gait, &build, leg_length)
    };
    assert_eq!(mode(&|_, _| ()), SyntheticMode::Optimal);
    assert_eq!(mode(&|gait, _| gait.pace = gait.pace.with(Some(1.0), None, None)), SyntheticMode::Optimal);
    assert_eq!(mode(&|gait, _| gait.pace = gait.pace.with(Some(0.1), None, None)), SyntheticMode::Corrected);
    let paced = |speed, steps_min: f64| {
        move |gait: &mut Gait, _: &mut Build| {
            gait.pace = gait.pace.with(Some(speed), None, Some(steps_min / 60.0));
        }
    };
    assert_eq!(mode(&paced(1.3, 100.0)), SyntheticMode::Optimal);
    assert_eq!(mode(&paced(1.3, 90.0)), SyntheticMode::Corrected);
    assert_eq!(mode(&|_, build| build.toe_joint = false), SyntheticMode::Corrected);
    assert_eq!(mode(&|gait, _| *gait = Gait::named("standard").unwrap()), SyntheticMode::Corrected);
    let limp = "base = \"free\"\n[[joint]]\njoint = \"right knee\"\nangle_deg = 3\n";
    assert_eq!(mode(&|gait, _| *gait = Gait::from_toml(limp).unwrap()), SyntheticMode::Corrected);
}

#[test]
fn what_an_optimal_walk_cannot_do_is_refused() {
    let refused = |gait: &Gait, build: Build| {
        let order = order(gait, build, SyntheticMode::Optimal);
        synthesise(&order, &mut Findings::default()).unwrap_err().to_string()
    };
    let limp = Gait::from_toml("base = \"free\"\n[[joint]]\njoint = \"right knee\"\nangle_deg = 3\n").unwrap();
    assert!(refused(&limp, MAN).contains("sides half a cycle apart"));
    assert!(refused(&Gait::named("goose").unwrap(), MAN).contains("expected the normative curves"));
    let free = Gait::named("free").unwrap();
    assert!(refused(&free, Build { toe_joint: false, ..MAN }).contains("expected toe joints"));
}

#[test]
fn the_agreement_grows_with_the_rate_of_the_simulator() {
    let gait = Gait::named("free").unwrap();
    let worst = [1000.0, 4000.0].map(|rate_hz| {
        let order = SyntheticWalkSettings { rate_hz, cycles: 1, ..order(&gait, MAN, SyntheticMode::Corrected) };
        let walk = synthesise(&order, &mut Findings::default()).unwrap();
        worst_moment(&walk, &analysed(&walk)).0
    });
    println!("moments differ by {:.4} N.m at 1 kHz, by {:.4} N.m at 4 kHz", worst[0], worst[1]);
    assert!(worst[1] < 0.35 * worst[0], "{worst:?}");
}

#[test]
fn without_the_ground_forces_the_moments_are_others() {
    let (walk, _) = made("free", MAN, SyntheticMode::Corrected);
    let bare = SyntheticWalk { loads: Vec::new(), ..walk.clone() };
    let analysis = analysed(&bare);
    assert!(worst_moment(&bare, &analysis).0 > 50.0);
    assert!(analysis.residual.unwrap().force_peak_n > 700.0);
}

#[test]
fn every_cycle_is_whole_and_like_the_one_before() {
    let (walk, findings) = made("free", MAN, SyntheticMode::Corrected);
    let analysis = analysed(walk);
    for side in Side::BOTH {
        let cycles: Vec<_> = analysis.cycles.iter().filter(|cycle| cycle.side == side).collect();
        assert_eq!(cycles.len(), 2, "{side}");
        for cycle in cycles {
            let duration = cycle.end_s - cycle.start_s;
            assert!((duration - walk.walk.cycle_s()).abs() < 2e-3, "{side}: {duration} s");
            assert!(cycle.foot_off_s.is_some());
        }
    }
    let grid = analysis.trajectory.grid();
    let later = walk.walk.cycle_s() / grid.step_s;
    let ankle = &analysis.forces.generalized[walk.human.model.coordinate("ankle_angle_r").unwrap().index()];
    let after = |i: usize| {
        let (whole, share) = ((i as f64 + later).floor() as usize, (i as f64 + later).fract());
        ankle[whole] * (1.0 - share) + ankle[whole + 1] * share
    };
    let range = ankle.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let count = grid.frames - later.ceil() as usize - 1;
    let worst = (0..count).map(|i| (ankle[i] - after(i)).abs()).fold(0.0, f64::max);
    println!("ankle from cycle to cycle: {worst:.2} of {range:.1} N.m");
    assert!(worst < 0.02 * range, "{worst} of {range} N.m");
    assert!(walk.report.speed_drift < 0.005, "{} m/s", walk.report.speed_drift);
    assert!(findings.as_slice().is_empty(), "{findings:?}");
    let speed = analysis.speed_m_s.unwrap();
    assert!((speed / walk.walk.speed() - 1.0).abs() < 0.02, "{speed} m/s");
    assert_eq!((analysis.mass.kg, analysis.mass.source), (walk.human.model.mass(), MassSource::Model));
}

#[test]
fn the_ground_carries_the_weight() {
    let (walk, _) = made("free", MAN, SyntheticMode::Corrected);
    let analysis = analysed(walk);
    let (grid, cycle) = (analysis.trajectory.grid(), analysis.cycles[0]);
    let inside: Vec<usize> =
        (0..grid.frames).filter(|&i| (cycle.start_s..cycle.end_s).contains(&grid.time(i))).collect();
    let total: f64 = analysis.ground.bodies.iter().flat_map(|b| inside.iter().map(|&i| b.force[i].y)).sum();
    let weight = walk.human.model.mass() * walk.human.model.gravity().norm();
    let share = total / inside.len() as f64 / weight;
    println!("mean vertical force {share:.4} BW");
    assert!((share - 1.0).abs() < 0.005, "{share} BW");
}

#[test]
fn the_correction_is_reported() {
    let (walk, _) = made("free", MAN, SyntheticMode::Corrected);
    let report = walk.report.correction.as_ref().unwrap();
    assert!(report.parameters > 50);
    let names: Vec<&str> = report.adjustment.angles.iter().map(|(name, _)| name.as_str()).collect();
    for name in ["hip_flexion_r", "knee_angle_r", "ankle_angle_r", "mtp_angle_r", "pelvis_tilt", "lumbar_extension"] {
        assert!(names.contains(&name), "{names:?}");
    }
    for (name, change) in &report.adjustment.angles {
        assert!(change.rms > 0.0 && change.rms <= change.largest && change.largest < 1.2, "{name}: {change:?}");
    }
    let [forward, up] = report.adjustment.pelvis;
    assert!(forward.largest < 0.1 && up.largest < 0.1 && up.rms > 0.0, "{forward:?} {up:?}");
    // Multipliers grow from stage to stage, so costs of different stages cannot be compared.
    assert!(report.progress.iter().any(|stage| stage.iterations > 0 && stage.to < stage.from), "{:?}", report.progress);
}

#[test]
fn a_gait_that_cannot_be_made_consistent_gives_a_warning() {
    // Steps of three leg lengths: every foot lands out of reach of the hip that stands on the other one.
    let (mut gait, mut findings) = (Gait::named("parade").unwrap(), Findings::default());
    gait.pace = gait.pace.with(Some(4.5), Some(2.8), None);
    synthesise(&order(&gait, MAN, SyntheticMode::Corrected), &mut findings).unwrap();
    let found = findings.as_slice().iter().find(|finding| finding.code == Code::WalkNotConsistent);
    assert!(found.is_some_and(|finding| finding.message.contains("found no motion near this gait")), "{findings:?}");
}

#[test]
fn the_papers_mode_holds_the_trunk_and_lists_impacts_separately() {
    let build = Build { table: SegmentTable::Faure1997, mass: 80.0, height: 1.8, toe_joint: false };
    let (walk, _) = made("standard", build, SyntheticMode::Paper);
    assert!(walk.report.correction.is_none() && walk.report.impacts.0 > 0 && walk.report.impacts.1 > 0.0);
    assert!(walk.report.trunk_torque.rms > 20.0, "{:?}", walk.report.trunk_torque);
    let tilt = walk.human.model.coordinate("pelvis_tilt").unwrap();
    assert!(walk.trajectory.values(tilt).iter().all(|angle| angle.abs() < 1e-12));
}

#[test]
fn invalid_settings_are_rejected() {
    let gait = Gait::named("free").unwrap();
    let refused =
        |order: SyntheticWalkSettings<'_>| synthesise(&order, &mut Findings::default()).unwrap_err().to_string();
    let good = order(&gait, MAN, SyntheticMode::Corrected);
    assert_eq!(
        refused(SyntheticWalkSettings { cycles: 0, ..good }),
        "found 0 cycles; expected 1 to 1000, because a walk repeats its cycles"
    );
    for rate_hz in [0.0, -100.0, f64::NAN, 1e9] {
        assert!(refused(SyntheticWalkSettings { rate_hz, ..good }).contains("Hz; expected 20 to 5000 Hz"), "{rate_hz}");
    }
    let heavy = Build { mass: 1000.0, ..MAN };
    let error = synthesise(&order(&gait, heavy, SyntheticMode::Corrected), &mut Findings::default()).unwrap_err();
    assert!(matches!(error, SyntheticError::Build(_)), "{error}");
}

#[test]
fn other_rates_show_the_same_walk() {
    let gait = Gait::named("free").unwrap();
    let at = |rate_hz: f64| {
        let order = SyntheticWalkSettings { rate_hz, cycles: 1, ..order(&gait, MAN, SyntheticMode::Corrected) };
        synthesise(&order, &mut Findings::default()).unwrap()
    };
    let (coarse, fine) = (at(50.0), at(250.0));
    let knee = coarse.human.model.coordinate("knee_angle_r").unwrap();
    let (a, b) = (coarse.trajectory.values(knee), fine.trajectory.values(knee));
    assert!((coarse.trajectory.grid().rate_hz() - 50.0).abs() < 1e-9 && fine.trajectory.grid().frames > 4 * a.len());
    for (i, value) in a.iter().enumerate().take(a.len() - 1) {
        // Both start at the same step of 1 ms.
        assert!((value - b[5 * i]).abs() < 1e-9, "frame {i}");
    }
}
