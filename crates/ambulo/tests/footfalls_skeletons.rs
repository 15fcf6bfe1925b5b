//! When the feet stand, of BVH files: a walk in a figure of eight and jumps, without markers, plates or masses.
//!
//! The files are not part of the repository; without them each test states `skipped` and passes.

use crate::shared_data;
use ambulo::analysis::feasibility::Person;
use ambulo::dynamics::{Workspace, inverse};
use ambulo::findings::Findings;
use ambulo::ground::footfalls::{Footfalls, footfalls};
use ambulo::kinematics::Trajectory;
use ambulo::kinematics::retarget::retarget;
use ambulo::model::Side;
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::motion::filter::LowPass;
use ambulo::motion::skeleton::skeleton_from_bvh;
use ambulo::motion::{EventKind, SmoothSettings, Smoother, TimeGrid, Window, smooth};
use ambulo_formats::bvh::Bvh;

/// Footfalls, and what the body needs from the ground, share of its weight, one entry a frame.
fn of_file(file: &str, cutoff_hz: f64) -> Option<(Footfalls, TimeGrid, Vec<f64>)> {
    let path = shared_data::data()?.join("bvh").join(file);
    let bvh = Bvh::read(&std::fs::read(path).unwrap()).unwrap().0;
    let mut findings = Findings::default();
    let skeleton = skeleton_from_bvh(&bvh, "skeleton", None, &mut findings).unwrap();
    let build = Build { table: SegmentTable::DeLevaMale, mass: 70.0, height: skeleton.height_m, toe_joint: true };
    let moved = retarget(&build, &skeleton, &mut findings).unwrap();
    let model = &moved.human.model;
    let smoother = Smoother::Butterworth(LowPass { order: 3, cutoff_hz });
    let settings = SmoothSettings { smoother, window: Window::default(), rate_hz: None };
    let smoothed = smooth(model, &moved.fit.motion, settings, &mut findings).unwrap();
    let trajectory = Trajectory::complete(model, smoothed, &mut findings).unwrap();
    let found = footfalls(model, &trajectory, &Person::of_human(&moved.human).soles, &mut findings);
    let forces = inverse(&mut Workspace::new(model), &trajectory, &[]);
    let weight = model.mass() * model.gravity().norm();
    let up = model.coordinate("pelvis_ty").unwrap().index();
    Some((found, trajectory.grid(), forces.generalized[up].iter().map(|force| force / weight).collect()))
}

#[test]
fn the_feet_of_a_walk_in_a_figure_of_eight_take_turns() {
    for cutoff_hz in [6.0, 12.0] {
        let Some((found, ..)) = of_file("AV_8Walk_Meredith_HVHA_Rep1.bvh", cutoff_hz) else { return };
        let sides: Vec<Side> = found.falls.iter().map(|fall| fall.side).collect();
        println!("{} footfalls, floor {:?}", sides.len(), found.floor_velocity);
        // A step takes 0.5 s; of 8.9 s.
        assert!((17..=20).contains(&sides.len()) && sides.windows(2).all(|pair| pair[0] != pair[1]), "{sides:?}");
        assert!(found.floor_velocity.norm() <= 0.0);
        let length = |fall: &&ambulo::ground::footfalls::Footfall| Some(fall.off_s? - fall.strike_s?);
        assert!(found.falls.iter().filter_map(|fall| length(&fall)).all(|s| (0.45..0.75).contains(&s)), "{found:?}");
        let heights: Vec<f64> = found.falls.iter().map(|fall| fall.floor_height_m).collect();
        assert!(heights.iter().all(|h| (h - heights[9]).abs() < 0.03), "one floor: {heights:?}");
    }
}

#[test]
fn nobody_stands_in_the_flights_of_jumps() {
    let Some((found, grid, carried)) = of_file("01_01.bvh", 6.0) else { return };
    let standing = |t: f64| {
        let spans = found.falls.iter().map(|fall| fall.contact().span(grid.start_s, grid.end_s()));
        spans.filter(|span| (span[0]..=span[1]).contains(&t)).count()
    };
    let frames: Vec<usize> = (0..grid.frames).collect();
    let flies = |frame: usize| standing(grid.time(frame)) == 0;
    let flights: Vec<&[usize]> =
        frames.chunk_by(|a, b| flies(*a) == flies(*b)).filter(|chunk| flies(chunk[0]) && chunk.len() > 24).collect();
    for flight in &flights {
        // A low-pass of 6 Hz smears take-off and landing over 50 ms; between them the body needs nothing.
        let middle = &flight[flight.len() / 3..2 * flight.len() / 3];
        let mean = middle.iter().map(|&frame| carried[frame]).sum::<f64>() / middle.len() as f64;
        assert!(mean < 0.15, "at {:.2} s the body needs {mean:.2} of its weight", grid.time(middle[0]));
    }
    for frame in 0..grid.frames {
        let t = grid.time(frame);
        assert!(carried[frame] > 0.03 || flies(frame), "at {t:.2} s a foot stands in flight");
    }
    let flights = flights.len();
    println!("{flights} flights, {} footfalls", found.falls.len());
    // As many as Newton's law sees: half the weight splits the low-passed force in the middle of take-off and landing.
    let long = carried.split(|force| *force > 0.5).filter(|air| air.len() as f64 * grid.step_s > 0.2).count();
    assert!(long >= 8 && flights == long, "{flights} flights, {long} in the force");
    let offs = found.events().iter().filter(|e| e.kind == EventKind::Off).count();
    assert!(offs >= 2 * long);
}
