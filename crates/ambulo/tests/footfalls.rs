//! Stances detected from the motion alone, compared with force plates in every recording.
//!
//! The recordings are not part of the repository; without them each test prints `skipped` and passes.

use crate::footfall_trials::{Recorded, everything};
use ambulo::findings::Findings;
use ambulo::ground::footfalls::{Footfalls, OffSpeed, footfalls, footfalls_at};
use ambulo::kinematics::Trajectory;
use ambulo::model::BySide;
use ambulo::motion::{Event, EventKind};

fn found(trial: &Recorded, cutoff_hz: f64) -> Footfalls {
    footfalls(&trial.model, &trial.trajectory(cutoff_hz), &trial.soles, &mut Findings::default())
}

/// Detected - plates for each event of a kind [ms]: the nearest event of the same foot; not a number beyond 0.15 s.
fn errors_ms(plates: &[Event], found: &[Event], kind: EventKind) -> Vec<f64> {
    let of = |e: &&Event| {
        let same = found.iter().filter(|f| f.side == e.side && f.kind == e.kind).map(|f| 1e3 * (f.time_s - e.time_s));
        same.filter(|d| d.abs() < 150.0).min_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(f64::NAN)
    };
    let of_kind: Vec<&Event> = plates.iter().filter(|e| e.kind == kind).collect();
    of_kind.iter().map(of).collect()
}

fn mean(values: impl IntoIterator<Item = f64>) -> f64 {
    let (sum, count) = values.into_iter().fold((0.0, 0.0), |(sum, n), x| (sum + x, n + 1.0));
    sum / count
}

fn most(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m: f64, x| m.max(x.abs()))
}

/// Errors of strikes and offs in one trial [ms].
struct Row {
    subject: &'static str,
    errors: [Vec<f64>; 2],
}

fn table(trials: &[Recorded], cutoff_hz: f64) -> Vec<Row> {
    println!("{cutoff_hz} Hz: found - plates [ms]: mean, mean of magnitudes, most; floor [m/s]");
    let row = |trial: &Recorded| {
        let all = found(trial, cutoff_hz);
        let events = all.events();
        let errors = [EventKind::Strike, EventKind::Off].map(|kind| errors_ms(&trial.plates, &events, kind));
        let [s, o] =
            errors.each_ref().map(|e| (e.len(), mean(e.iter().copied()), mean(e.iter().map(|x| x.abs())), most(e)));
        println!(
            "  {:<17} {:2} strikes {:+6.1} {:5.1} {:5.1}   {:2} offs {:+6.1} {:5.1} {:5.1}   floor {:.2}",
            trial.name,
            s.0,
            s.1,
            s.2,
            s.3,
            o.0,
            o.1,
            o.2,
            o.3,
            all.floor_velocity.norm()
        );
        Row { subject: trial.subject, errors }
    };
    let rows: Vec<Row> = trials.iter().map(row).collect();
    let of_kind = |k: usize| mean(rows.iter().map(|r| mean(r.errors[k].iter().map(|x| x.abs()))));
    println!("  mean over trials: strikes {:.1}, offs {:.1}", of_kind(0), of_kind(1));
    rows
}

/// Leave-one-out: errors of each subject minus the mean error of all others, the effect of an offset fitted to others.
fn leave_one_out(rows: &[Row]) {
    println!("leave one subject out: mean of magnitudes as it is, and with the others' mean error taken off [ms]");
    let mut subjects: Vec<&str> = rows.iter().map(|r| r.subject).collect();
    subjects.sort_unstable();
    subjects.dedup();
    let of_subject = |name: &str, k: usize| -> Vec<f64> {
        rows.iter().filter(|r| r.subject == name).flat_map(|r| r.errors[k].iter().copied()).collect()
    };
    for name in &subjects {
        let text = [0, 1].map(|k| {
            let own = of_subject(name, k);
            let others = mean(subjects.iter().filter(|s| *s != name).map(|s| mean(of_subject(s, k))));
            format!("{:5.1} {:5.1}", mean(own.iter().map(|x| x.abs())), mean(own.iter().map(|x| (x - others).abs())))
        });
        println!("  {name:<17} strikes {}   offs {}", text[0], text[1]);
    }
}

#[test]
fn strikes_and_offs_are_those_of_the_plates() {
    let trials = everything();
    if trials.is_empty() {
        return;
    }
    for cutoff_hz in [6.0, 8.0, 10.0, 12.0] {
        let rows = table(trials, cutoff_hz);
        leave_one_out(&rows);
        for (row, trial) in rows.iter().zip(trials) {
            for errors in &row.errors {
                // None missed, and no error above the limit.
                assert!(errors.iter().all(|e| e.abs() <= 30.0), "{} at {cutoff_hz} Hz: {errors:?}", trial.name);
            }
        }
        for k in [0, 1] {
            let of_trials = mean(rows.iter().map(|r| mean(r.errors[k].iter().map(|x| x.abs()))));
            assert!(of_trials < 15.0, "{of_trials} ms at {cutoff_hz} Hz");
        }
    }
}

#[test]
fn no_step_is_invented_where_plates_measured_every_step() {
    for trial in everything().iter().filter(|trial| trial.all_seen) {
        let times = || trial.plates.iter().map(|e| e.time_s);
        let (first, last) = (times().fold(f64::INFINITY, f64::min), times().fold(f64::NEG_INFINITY, f64::max));
        let found = found(trial, 6.0).events();
        let inside = found.iter().filter(|e| (first - 0.05..last + 0.05).contains(&e.time_s)).count();
        assert_eq!(inside, trial.plates.len(), "{}", trial.name);
    }
}

#[test]
fn floors_are_at_rest_and_belts_move() {
    for trial in everything() {
        let floor = found(trial, 6.0).floor_velocity;
        // The data's README: in stance the walker's midfoot goes back at 1.10 m/s, the runner's heel, which is on the
        // belt for a moment only, at about 3.6 m/s. A low-pass of 6 Hz lets half a contact of 0.24 s through.
        let belt = match trial.subject {
            "gait2392" => 1.10,
            "rajagopal-run" => 3.6,
            _ => {
                assert!(floor.iter().all(|v| v.to_bits() & !(1 << 63) == 0), "{}: {floor:?}", trial.name);
                continue;
            }
        };
        println!("{}: {floor:?}", trial.name);
        assert!((floor.x + belt).abs() < 0.15 * belt && floor.z.abs() < 0.1, "{}: {floor:?}", trial.name);
    }
}

#[test]
fn a_wrong_foot_and_a_wrong_time_are_noticed() {
    for trial in everything() {
        let mut events = found(trial, 6.0).events();
        for event in &mut events {
            event.time_s += 0.06;
        }
        let late = mean(errors_ms(&trial.plates, &events, EventKind::Strike).into_iter().map(f64::abs));
        assert!(late > 15.0 || late.is_nan(), "{}: {late}", trial.name);
        let mut swapped = trial.clone();
        swapped.soles = BySide { right: trial.soles.left, left: trial.soles.right };
        let other = errors_ms(&trial.plates, &found(&swapped, 6.0).events(), EventKind::Strike);
        // `soles` defines the side: here the points of the feet have the wrong side.
        assert!(other.iter().all(|e| e.is_nan() || e.abs() > 60.0), "{}: {other:?}", trial.name);
    }
}

/// Mean over subjects of the mean over their trials of the mean magnitude [ms].
fn cost(trials: &[Recorded], errors: &[f64], subjects: &[&str]) -> f64 {
    let of_subject = |name: &&str| {
        let own = trials.iter().zip(errors).filter(|(trial, _)| trial.subject == *name);
        mean(own.map(|(_, error)| *error))
    };
    mean(subjects.iter().map(of_subject))
}

#[test]
fn the_speed_threshold_of_foot_off_is_the_best_of_a_grid() {
    let trials = everything();
    if trials.is_empty() {
        return;
    }
    let motions: Vec<Trajectory> = trials.iter().map(|trial| trial.trajectory(6.0)).collect();
    let errors = |left: OffSpeed| -> Vec<f64> {
        let of_trial = |(trial, motion): (&Recorded, &Trajectory)| {
            let found = footfalls_at(&trial.model, motion, &trial.soles, left, &mut Findings::default());
            mean(errors_ms(&trial.plates, &found.events(), EventKind::Off).into_iter().map(f64::abs))
        };
        trials.iter().zip(&motions).map(of_trial).collect()
    };
    let factors = (6..=16).map(|k| 0.05 * f64::from(k));
    let grid: Vec<OffSpeed> =
        factors.flat_map(|factor| [0.0, 0.125, 0.25, 0.375, 0.5].map(|power| OffSpeed { factor, power })).collect();
    let all: Vec<(OffSpeed, Vec<f64>)> = grid.into_iter().map(|left| (left, errors(left))).collect();
    let mut subjects: Vec<&str> = trials.iter().map(|trial| trial.subject).collect();
    subjects.sort_unstable();
    subjects.dedup();
    let best = |subjects: &[&str]| {
        let costs = all.iter().map(|(left, errors)| (*left, errors, cost(trials, errors, subjects)));
        costs.filter(|c| c.2.is_finite()).min_by(|a, b| a.2.total_cmp(&b.2)).unwrap()
    };
    let mut left_out = Vec::new();
    for name in &subjects {
        let others: Vec<&str> = subjects.iter().copied().filter(|s| s != name).collect();
        let (left, errors, _) = best(&others);
        left_out.push(cost(trials, errors, &[*name]));
        println!(
            "without {name:<15} {:.2} and {:.3}: {:.1} ms for it",
            left.factor,
            left.power,
            left_out[left_out.len() - 1]
        );
    }
    let (left, _, least) = best(&subjects);
    let own = cost(trials, &errors(OffSpeed::default()), &subjects);
    println!(
        "all: {:.2} and {:.3}, {least:.1} ms; default {own:.1} ms; left out {:.1} ms",
        left.factor,
        left.power,
        mean(left_out)
    );
    assert!(own < least + 0.5, "{own} ms, {least} ms at {left:?}");
    // The grid must distinguish the speeds.
    assert!(all.iter().any(|(_, errors)| cost(trials, errors, &subjects) > 1.5 * own));
}
