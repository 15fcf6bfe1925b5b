//! Nothing is allocated per frame after the first, and what a prediction and a stream hold is bounded: counted by an
//! allocator of this process.
#![allow(clippy::disallowed_methods, reason = "expected values of tests may have the bits of the platform")]
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, in its helpers too, and says why it skips"
)]
#![expect(unsafe_code, reason = "an allocator is unsafe by its trait; this one counts and forwards")]

mod common;
mod shared_data;

use ambulo::analysis::feasibility::{FeasibilityLimits, FootFrame, Frame, Person, Thresholds, check_frame};
use ambulo::dynamics::{self, BodyLoad, Workspace};
use ambulo::findings::Findings;
use ambulo::gait::machine::WalkMachine;
use ambulo::gait::{Gait, Walk};
use ambulo::ground::predict::{PredictSettings, predict};
use ambulo::ground::stream::{Stream, StreamSettings};
use ambulo::kinematics::body_motion;
use ambulo::kinematics::marker_fit::{FitSettings, fit_markers};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::{BySide, Marker, Model};
use ambulo::motion::{MarkerPath, MarkerRecording, Motion};
use ambulo::simulation::synthetic::{SyntheticMode, SyntheticWalk, SyntheticWalkSettings, synthesise};
use ambulo::spatial::{Vec3, Wrench};
use ambulo::study::{self, GroundSettings, LaboratoryFile, MarkerBody, MarkerSource, Settings, Source};
use common::random::{self, Curves, KINDS, Random};
use common::{State, load_series, trajectory};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::hint::black_box;

struct Counting;

thread_local! {
    /// Per thread, so that the test harness on its own threads does not disturb the count.
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
    /// Bytes that this thread took and did not give back, and the most of them at any time.
    static HELD: Cell<[isize; 2]> = const { Cell::new([0, 0]) };
}

fn count_bytes(more: usize, less: usize) {
    let [held, most] = HELD.get();
    let held = held + more as isize - less as isize;
    HELD.set([held, most.max(held)]);
}

fn count_one() {
    ALLOCATIONS.set(ALLOCATIONS.get() + 1);
}

// SAFETY: every call is forwarded unchanged to the system's allocator; the counter is a constant-initialised cell
// without a destructor, so counting allocates nothing.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count_one();
        count_bytes(layout.size(), 0);
        // SAFETY: the caller's promise about `layout` is passed on.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count_bytes(0, layout.size());
        // SAFETY: `pointer` came from `System` with this layout.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count_one();
        count_bytes(size, layout.size());
        // SAFETY: `pointer` came from `System` with this layout.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Allocations of this thread while `work` runs.
fn allocations(work: impl FnOnce()) -> usize {
    let before = ALLOCATIONS.get();
    work();
    ALLOCATIONS.get() - before
}

/// Bytes that `work` holds when it is done with what it returns, and the most that it held.
fn bytes_held<T>(work: impl FnOnce() -> T) -> [usize; 2] {
    let [before, _] = HELD.get();
    HELD.set([before, before]);
    let result = black_box(work());
    let after = HELD.get().map(|bytes| usize::try_from(bytes - before).unwrap_or(0));
    drop(result);
    after
}

/// A chain of every joint kind, twenty-one postures (no multiple of eight), two loads each.
fn evidence() -> (Model, Vec<State>, Vec<Vec<BodyLoad>>) {
    let mut r = Random::new(1);
    let model = random::chain_of(&mut r, &KINDS, Curves::Any);
    let states = (0..21).map(|_| random::state(&mut r, &model)).collect();
    let loaded: Vec<_> = model.body_ids().skip(3).step_by(4).collect();
    let loads = (0..21).map(|_| loaded.iter().map(|&body| random::load_on(&mut r, body)).collect()).collect();
    (model, states, loads)
}

fn read_all_bodies(model: &Model, workspace: &mut Workspace, state: &State, loads: &[BodyLoad]) {
    let forces = dynamics::inverse_frame(workspace, state.posture(), loads);
    black_box(forces.generalized());
    for body in model.body_ids() {
        black_box((forces.reaction(body), forces.body_motion(body)));
    }
}

#[test]
fn frames_after_the_first_allocate_nothing() {
    let (model, states, loads) = evidence();
    let (path, series) = (trajectory(&model, &states), load_series(&loads));
    let mut workspace = Workspace::new(&model);

    // The counter works: a box is one allocation, its growth another, and the first frame makes room for the loads.
    assert_eq!(allocations(|| drop(black_box(Box::new(1)))), 1, "one box");
    let mut list = black_box(Vec::<u64>::with_capacity(1));
    assert_eq!(allocations(|| list.reserve_exact(black_box(1000))), 1, "one list that grows");
    let first = allocations(|| read_all_bodies(&model, &mut workspace, &states[0], &loads[0]));
    assert!(first > 0, "the first frame found room for its loads");

    let later = allocations(|| {
        for (state, loads) in states.iter().zip(&loads) {
            read_all_bodies(&model, &mut workspace, state, loads);
        }
    });
    assert_eq!(later, 0, "inverse_frame");

    let mut columns = vec![vec![0.0; states.len()]; model.coordinates().len()];
    let mut solve = || {
        dynamics::inverse_frames(&mut workspace, &path, &series, |coordinate, first, values| {
            columns[coordinate][first..first + values.len()].copy_from_slice(values);
        });
    };
    assert!(allocations(&mut solve) > 0, "the first block found room for its loads");
    assert_eq!(allocations(&mut solve), 0, "inverse_frames");
    assert!(columns.iter().flatten().any(|tau| tau.abs() > 1.0), "no forces: {columns:?}");
}

#[test]
fn postures_of_a_walk_and_of_its_machine_allocate_nothing() {
    let gait = Gait::named("free").unwrap_or_else(|e| panic!("{e}"));
    let walk = Walk::new(&gait, 0.92, &mut Findings::default()).unwrap_or_else(|e| panic!("{e}"));
    let mut machine = WalkMachine::new(&walk);
    let count = allocations(|| {
        for i in 0..100 {
            let t = 0.013 * f64::from(i);
            black_box((walk.at(t), machine.step(t)));
        }
    });
    assert_eq!(count, 0);
}

#[test]
fn judging_an_instant_allocates_nothing() {
    let build = Build { table: SegmentTable::DeLevaFemale, mass: 60.0, height: 1.65, toe_joint: true };
    let Ok(human) = build.human() else { panic!("no figure") };
    let judge = FeasibilityLimits::new(&human.model, &Person::of_human(&human), &Thresholds::default());
    let state = State::rest(&human.model);
    let bodies = body_motion(&human.model, state.posture());
    let foot = FootFrame { force: Vec3::new(50.0, 300.0, 0.0), center_of_pressure: Vec3::new(0.05, -0.9, 0.0) };
    let frame = Frame {
        q: &state.q,
        qd: &state.qd,
        generalized: &state.qd,
        powers: &state.qd,
        bodies: &bodies,
        feet: BySide { right: Some(foot), left: Some(foot) },
        residual: Wrench::ZERO,
        ground_velocity: Vec3::zeros(),
        ground_height: BySide { right: -0.9, left: -0.9 },
        walking: true,
    };
    let mut measured = 0;
    let count = allocations(|| {
        check_frame(&judge, &frame, |m| {
            measured += 1;
            black_box(m);
        });
    });
    assert_eq!(count, 0, "check_frame");
    assert!(measured > 30, "only {measured} measurements");
}

/// A recording of as many frames of a body that flies, with four markers on each of its three parts.
fn marked(frames: usize) -> (Model, MarkerRecording) {
    let mut r = Random::new(3);
    let chain = random::chain_of(&mut r, &[random::Kind::Free, random::Kind::Pin, random::Kind::Ball], Curves::Smooth);
    let places: Vec<_> = chain.body_ids().flat_map(|id| [id; 4]).map(|id| (id, r.vector(0.2))).collect();
    let marker = |(k, (id, location)): (usize, &(_, Vec3))| Marker {
        name: format!("m{k}"),
        body: Some(*id),
        location: *location,
        fixed: false,
    };
    let markers: Vec<Marker> = places.iter().enumerate().map(marker).collect();
    let model = Model::new("marked", Vec3::zeros(), chain.bodies().to_vec(), chain.coordinates().to_vec(), markers);
    let Ok(model) = model else { panic!("no model") };
    let waves = random::Waves::new(&mut r, &model);
    let times: Vec<f64> = (0..frames).map(|i| 0.01 * i as f64).collect();
    let bodies: Vec<_> = times.iter().map(|t| body_motion(&model, waves.at(*t).posture())).collect();
    let path = |m: &Marker| MarkerPath {
        name: m.name.clone(),
        positions: bodies.iter().filter_map(|b| Some(b[m.body?.index()].pose.place(m.location))).collect(),
    };
    let markers = model.markers().iter().map(path).collect();
    (model, MarkerRecording { name: "marked".to_owned(), rate_hz: 100.0, times, markers })
}

#[test]
fn fitting_markers_allocates_for_the_recording_and_not_for_its_frames() {
    let count = |frames: usize| {
        let (model, markers) = marked(frames);
        let mut findings = Findings::default();
        allocations(|| {
            black_box(fit_markers(&model, &markers, &FitSettings::default(), &mut findings).is_ok());
        })
    };
    let (few, many) = (count(20), count(400));
    assert_eq!(few, many, "allocations in 20 and in 400 frames");
}

fn synthetic(cycles: usize) -> SyntheticWalk {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: false };
    let gait = Gait::named("free").unwrap_or_else(|e| panic!("{e}"));
    let order = SyntheticWalkSettings { gait: &gait, build, mode: SyntheticMode::Corrected, cycles, rate_hz: 100.0 };
    synthesise(&order, &mut Findings::default()).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn a_prediction_holds_a_bounded_number_of_bytes_a_frame() {
    let held = |walk: &SyntheticWalk| {
        let soles = Person::of_human(&walk.human).soles;
        let (model, settings) = (&walk.human.model, PredictSettings::default());
        let frames = walk.trajectory.grid().frames;
        let run = || predict(model, &walk.trajectory, &soles, &settings, &mut Findings::default()).ok();
        // The first one reads the crate's curves, which stay.
        black_box(run());
        (frames, bytes_held(run))
    };
    let ((few, of_few), (many, of_many)) = (held(&synthetic(2)), held(&synthetic(8)));
    let [result, most] = [0, 1].map(|i| (of_many[i] - of_few[i]) as f64 / (many - few) as f64);
    println!("a prediction: {result:.0} bytes a frame, {most:.0} while it is made ({few} and {many} frames)");
    // Two feet of four vectors, a height, two vectors and a number each, and the total's six numbers make 48 + 2 *
    // 160 = 368 bytes.
    assert!((300.0..800.0).contains(&result), "{result} bytes a frame");
    // Beside the result, places of the feet and the equations, in whose memory the inverse is made.
    assert!(most < 1400.0, "{most} bytes a frame");
}

#[test]
fn a_stream_holds_no_more_the_longer_it_runs() {
    let walk = synthetic(2);
    let soles = Person::of_human(&walk.human).soles;
    let mut frames = Vec::new();
    walk.trajectory.for_each_posture(|_, posture| frames.push(posture.q.to_vec()));
    let settings = StreamSettings { window_s: 1.0, ..StreamSettings::at_rate(100.0) };
    let Ok(full) = Stream::new(walk.human.model.clone(), soles, &settings) else { panic!("no stream") };
    let after = |count: usize| {
        bytes_held(|| {
            let mut stream = full.clone();
            for i in 0..count {
                black_box(stream.push(&frames[i % frames.len()]).is_ok());
            }
            stream
        })
    };
    // The walk begins again after 328 frames: a jump, at which feet seem to step more often. Both have it in all places
    // of the window.
    let (few, many) = (after(440), after(1760));
    println!("a stream holds {} bytes, {} during a push", few[0], few[1]);
    // Findings of the last window may differ by a message.
    assert!(few[0] > 50_000 && many[0] < few[0] + 2000, "{many:?} after {few:?}");
    assert!((many[1] as f64) < 1.2 * few[1] as f64, "{many:?} after {few:?}");
}

/// A recorded walk of Gait2392's subject, as markers; it runs forwards and backwards until it has this number of
/// frames.
fn walked_to_and_fro(frames: usize) -> Option<MarkerSource> {
    let folder = shared_data::data()?.join("opensim-gait2392-subject01");
    let bytes = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let mut findings = Findings::default();
    let model = Model::from_osim(&bytes("subject01_simbody.osim"), &mut findings).unwrap();
    let mut trial =
        LaboratoryFile::from_trc(bytes("subject01_walk1.trc"), "subject01_walk1.trc", &mut findings).unwrap();
    let markers = &mut trial.recording.markers;
    let last = markers.times.len() - 1;
    let frame = |i: usize| if (i / last).is_multiple_of(2) { i % last } else { last - i % last };
    for marker in &mut markers.markers {
        marker.positions = (0..frames).map(|i| marker.positions[frame(i)]).collect();
    }
    markers.times = (0..frames).map(|i| i as f64 / markers.rate_hz).collect();
    Some(MarkerSource {
        trial,
        standing: None,
        body: MarkerBody::Model { model, mass_kg: None, protocol: None },
        plates: Vec::new(),
    })
}

/// Bytes a frame that a study of two lengths holds at the end and at most, its source included, and allocations a
/// frame.
fn study_per_frame(source: impl Fn(usize) -> Option<Source>) -> Option<[f64; 3]> {
    let settings = Settings { ground: GroundSettings::Predicted, ..Settings::default() };
    let mut found = Vec::new();
    for frames in [600, 600, 2400] {
        let source = source(frames)?;
        let [of_source, _] = bytes_held(|| source.clone());
        let mut held = [0; 2];
        let run = || study::run(source, &settings, &mut Findings::default()).unwrap();
        let count = allocations(|| held = bytes_held(run));
        found.push([held[0] + of_source, held[1] + of_source, count].map(|number| number as f64));
    }
    // The first one reads what the crate keeps.
    Some(std::array::from_fn(|k| (found[2][k] - found[1][k]) / 1800.0))
}

#[test]
fn a_study_holds_a_bounded_number_of_bytes_a_frame() {
    let Some([result, most, count]) = study_per_frame(|frames| Some(Source::markers(walked_to_and_fro(frames)?)))
    else {
        return;
    };
    println!("markers: {result:.0} bytes a frame, {most:.0} while they are studied, {count:.1} allocations a frame");
    assert!(most < 3800.0 && result < 2000.0 && count < 20.0, "{result} {most} {count}");
    let coordinates = |frames: usize| {
        let source = Source::markers(walked_to_and_fro(frames)?);
        let outcome = study::run(source, &Settings::default(), &mut Findings::default()).unwrap();
        let (model, trajectory) = (outcome.body, &outcome.analysis.trajectory);
        let columns = model.coordinate_ids().map(|id| Some(trajectory.values(id).to_vec())).collect();
        let motion = Motion { origin: "walk".to_owned(), times: trajectory.grid().times(), columns };
        Some(Source::coordinates(model, motion))
    };
    let [result, most, count] = study_per_frame(coordinates).unwrap();
    println!(
        "coordinates: {result:.0} bytes a frame, {most:.0} while they are studied, {count:.1} allocations a frame"
    );
    assert!(most < 2000.0 && result < 1500.0 && count < 20.0, "{result} {most} {count}");
}
