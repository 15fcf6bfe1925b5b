//! Times the prediction of ground forces: from a trajectory, including the marker fit, and frame by frame.
//!
//! A synthetic walk needs no data; the recording with markers is that of `bench-markers`. No other engine installed
//! here predicts ground forces, so there is no ratio. What a prediction holds in memory is counted by a test of the
//! library (crates/ambulo/tests/allocation.rs).

use super::timing::{Timing, cpu_us};
use super::{Row, markers, table, verdict};
use ambulo::analysis::feasibility::Person;
use ambulo::findings::Findings;
use ambulo::gait::Gait;
use ambulo::ground::footfalls::footfalls;
use ambulo::ground::predict::{PredictSettings, predict, total_wrench};
use ambulo::ground::stream::{Stream, StreamSettings};
use ambulo::kinematics::Trajectory;
use ambulo::kinematics::marker_fit::{FitSettings, fit_markers};
use ambulo::model::anatomy::Sole;
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::{BySide, Model};
use ambulo::motion::filter::LowPass;
use ambulo::motion::{MarkerRecording, SmoothSettings, Smoother, Window, smooth};
use ambulo::simulation::synthetic::{SyntheticMode, SyntheticWalkSettings, synthesise};
use cpu_time::ThreadTime;
use std::hint::black_box;

/// A prediction from a trajectory takes at most this a frame [us].
const REQUIRED_OF_PREDICTION_US: f64 = 20.0;
/// With marker fitting included this many frames a second at least, so a frame takes this long at most [us].
const REQUIRED_WITH_MARKERS_US: f64 = 1000.0;
/// Frames of the synthetic walk, a second.
const RATE_HZ: f64 = 100.0;
/// A frame that is pushed takes at most this [us].
const REQUIRED_OF_PUSH_US: f64 = 1000.0;
/// Pushes of one measurement.
const PUSHES: usize = 5;
/// Frames of a stream of recorded motion, a second, and pushes whose times are counted one by one.
const STREAM_RATE_HZ: f64 = 200.0;
const COUNTED: usize = 2000;

/// Prints and returns the rows.
#[expect(clippy::print_stdout, reason = "the table is the command's result")]
pub(super) fn bench() -> Result<Vec<Row>, String> {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
    let gait = Gait::named("free").map_err(|e| e.to_string())?;
    let order =
        SyntheticWalkSettings { gait: &gait, build, mode: SyntheticMode::Corrected, cycles: 6, rate_hz: RATE_HZ };
    let walk = synthesise(&order, &mut Findings::default()).map_err(|e| e.to_string())?;
    let (model, soles) = (&walk.human.model, Person::of_human(&walk.human).soles);
    let mut rows = of_trajectory("synthetic walk", model, &walk.trajectory, &soles)?;
    rows.push(row("stream, a push, synthetic walk", push(model, &walk.trajectory, &soles, RATE_HZ)?));
    if let Some((model, markers)) = markers::walk()? {
        rows.extend(of_markers(&model, &markers)?);
    }
    println!("\nground forces without plates");
    print!("{}", table(&rows));
    for (start, required) in [
        ("prediction,", REQUIRED_OF_PREDICTION_US),
        ("stream,", REQUIRED_OF_PUSH_US),
        ("fit, smooth and predict,", REQUIRED_WITH_MARKERS_US),
    ] {
        for row in rows.iter().filter(|row| row.quantity.starts_with(start)) {
            let per_second = 1e6 / row.timing.median;
            let met = verdict(row.timing.median, required);
            println!("{}: {per_second:.0} frames per second; required at most {required} us: {met}", row.quantity);
        }
    }
    Ok(rows)
}

fn row(quantity: &str, timing: Timing) -> Row {
    Row { quantity: quantity.to_owned(), unit: "us/frame", timing }
}

/// The prediction and, apart, its parts that others use as well.
fn of_trajectory(
    name: &str,
    model: &Model,
    trajectory: &Trajectory,
    soles: &BySide<Option<Sole>>,
) -> Result<Vec<Row>, String> {
    let settings = PredictSettings::default();
    let run = || predict(model, trajectory, soles, &settings, &mut Findings::default());
    run().map_err(|e| e.to_string())?;
    let frames = trajectory.grid().frames;
    let whole = cpu_us(frames, || {
        black_box(run().is_ok());
    });
    let steps = cpu_us(frames, || {
        black_box(footfalls(model, trajectory, soles, &mut Findings::default()));
    });
    let total = cpu_us(frames, || {
        black_box(total_wrench(model, trajectory));
    });
    Ok(vec![
        row(&format!("prediction, {name}"), whole),
        row("  of that: footfalls", steps),
        row("  of that: total wrench", total),
    ])
}

/// A push once the window is full.
fn push(model: &Model, trajectory: &Trajectory, soles: &BySide<Option<Sole>>, rate_hz: f64) -> Result<Timing, String> {
    let mut stream =
        Stream::new(model.clone(), *soles, &StreamSettings::at_rate(rate_hz)).map_err(|e| e.to_string())?;
    let mut frames = Vec::new();
    trajectory.for_each_posture(|_, posture| frames.push(posture.q.to_vec()));
    let mut next = to_and_fro(&frames);
    // The window is filled first.
    for q in next.by_ref().take((3.0 * rate_hz) as usize) {
        stream.push(q).map_err(|e| e.to_string())?;
    }
    histogram(&mut stream, &mut next);
    Ok(cpu_us(PUSHES, || {
        for q in next.by_ref().take(PUSHES) {
            black_box(stream.push(q).is_ok());
        }
    }))
}

/// A motion that is repeated without a jump.
fn to_and_fro(frames: &[Vec<f64>]) -> impl Iterator<Item = &Vec<f64>> {
    frames.iter().chain(frames.iter().rev().skip(1).take(frames.len().saturating_sub(2))).cycle()
}

/// Prints how long single pushes take: what is added to the delay.
#[expect(clippy::print_stdout, reason = "the table is the command's result")]
fn histogram<'f>(stream: &mut Stream, frames: &mut impl Iterator<Item = &'f Vec<f64>>) {
    let mut times: Vec<f64> = frames
        .take(COUNTED)
        .map(|q| {
            let start = ThreadTime::now();
            black_box(stream.push(q).is_ok());
            start.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    times.sort_by(f64::total_cmp);
    let rank = |share: f64| times[((times.len() - 1) as f64 * share) as usize];
    println!(
        "\nCPU time of a push beyond the delay, {COUNTED} pushes of {} values: median {:.2} ms, 99th percentile {:.2} \
         ms, longest {:.2} ms",
        stream.values(),
        rank(0.5),
        rank(0.99),
        rank(1.0)
    );
    for (from, to) in [(0.0, 0.5), (0.5, 1.0), (1.0, 2.0), (2.0, 4.0), (4.0, 8.0), (8.0, f64::INFINITY)] {
        let count = times.iter().filter(|time| (from..to).contains(*time)).count();
        println!("  {from} to {to} ms: {count}");
    }
}

/// From recorded markers to forces.
fn of_markers(model: &Model, markers: &MarkerRecording) -> Result<Vec<Row>, String> {
    let soles = Person::of_model(model).soles;
    let fitted = |rate_hz: Option<f64>| -> Result<Trajectory, String> {
        let mut findings = Findings::default();
        let fit = fit_markers(model, markers, &FitSettings::default(), &mut findings).map_err(|e| e.to_string())?;
        let smoother = Smoother::Butterworth(LowPass::MOTION);
        let settings = SmoothSettings { smoother, window: Window::default(), rate_hz };
        let smoothed = smooth(model, &fit.motion, settings, &mut findings).map_err(|e| e.to_string())?;
        Trajectory::complete(model, smoothed, &mut findings).map_err(|e| e.to_string())
    };
    let run = || {
        let trajectory = fitted(None)?;
        predict(model, &trajectory, &soles, &PredictSettings::default(), &mut Findings::default())
            .map_err(|e| e.to_string())
    };
    run()?;
    let trajectory = fitted(None)?;
    let together = cpu_us(trajectory.grid().frames, || {
        black_box(run().is_ok());
    });
    let mut rows = of_trajectory("rajagopal-walk", model, &trajectory, &soles)?;
    rows.push(row("fit, smooth and predict, rajagopal-walk", together));
    let faster = fitted(Some(STREAM_RATE_HZ))?;
    let name = format!("stream, a push, rajagopal-walk at {STREAM_RATE_HZ} Hz");
    rows.push(row(&name, push(model, &faster, &soles, STREAM_RATE_HZ)?));
    Ok(rows)
}
