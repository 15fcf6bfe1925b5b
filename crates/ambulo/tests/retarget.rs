//! Skeletons of BVH files on the built-in body: lengths, postures, and a walk through inverse dynamics without plates.

use crate::shared_data;
use ambulo::analysis::{AnalysisSettings, analyse};
use ambulo::findings::Findings;
use ambulo::ground::foot_motion::foot_motion;
use ambulo::kinematics::retarget::{Retargeted, retarget};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::motion::filter::LowPass;
use ambulo::motion::skeleton::{SkeletonRecording, skeleton_from_bvh};
use ambulo::motion::{Event, EventKind, Smoother, Window, straightened};
use ambulo_formats::bvh::Bvh;

fn real(file: &str) -> Option<Bvh> {
    let path = shared_data::data()?.join("bvh").join(file);
    Some(Bvh::read(&std::fs::read(path).unwrap()).unwrap().0)
}

fn on_a_body(bvh: &Bvh, mass: f64, height: Option<f64>) -> (SkeletonRecording, Retargeted, Findings) {
    let mut findings = Findings::default();
    let skeleton = skeleton_from_bvh(bvh, "skeleton", height, &mut findings).unwrap();
    let build = Build { table: SegmentTable::DeLevaMale, mass, height: skeleton.height_m, toe_joint: true };
    let moved = retarget(&build, &skeleton, &mut findings).unwrap();
    (skeleton, moved, findings)
}

fn coordinate<'r>(moved: &'r Retargeted, name: &str) -> &'r [f64] {
    let id = moved.human.model.coordinate(name).unwrap();
    moved.fit.motion.columns[id.index()].as_deref().unwrap_or_else(|| panic!("{name} was not seen"))
}

fn range(values: &[f64]) -> [f64; 2] {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    [sorted[sorted.len() / 50], sorted[sorted.len() - 1 - sorted.len() / 50]]
}

#[test]
fn the_walk_in_a_figure_of_eight_runs_through_inverse_dynamics() {
    let Some(bvh) = real("AV_8Walk_Meredith_HVHA_Rep1.bvh") else { return };
    let (skeleton, moved, mut findings) = on_a_body(&bvh, 65.0, None);
    println!("{}", skeleton.statement);
    for finding in findings.as_slice() {
        println!("  {finding}");
    }
    for error in &moved.fit.errors {
        println!("  {:14} {:6.1} mm rms {:6.1} mm at most", error.name, 1e3 * error.rms_m, 1e3 * error.max_m);
    }
    for name in [
        "pelvis_tilt",
        "pelvis_list",
        "hip_flexion_r",
        "hip_adduction_r",
        "hip_rotation_r",
        "knee_angle_r",
        "ankle_angle_r",
        "subtalar_angle_r",
        "mtp_angle_r",
        "lumbar_extension",
        "lumbar_bending",
        "lumbar_rotation",
        "arm_flex_r",
        "arm_add_r",
        "arm_rot_r",
        "elbow_flex_r",
    ] {
        let [low, high] = range(coordinate(&moved, name)).map(f64::to_degrees);
        println!("  {name:18} {low:7.1} {high:7.1}");
    }
    // What an animation program fitted to a skeleton of other joints stays near a body of hinges and balls.
    let worst = moved.fit.errors.iter().map(|error| error.rms_m).fold(0.0, f64::max);
    assert!(worst < 0.03 && moved.fit.converged.iter().all(|converged| *converged), "{worst}");
    let within = |name: &str, lowest: [f64; 2], highest: [f64; 2]| {
        let [low, high] = range(coordinate(&moved, name)).map(f64::to_degrees);
        let fits = (lowest[0]..lowest[1]).contains(&low) && (highest[0]..highest[1]).contains(&high);
        assert!(fits, "{name} runs from {low:.1} to {high:.1} degrees");
    };
    // Walking: Schwartz 2008 has -10 to 40 at the hip, 5 to 70 of flexion at the knee, -20 to 15 at the ankle at free
    // speed; fast and in curves people use more.
    for side in ["r", "l"] {
        within(&format!("hip_flexion_{side}"), [-35.0, -5.0], [20.0, 50.0]);
        within(&format!("knee_angle_{side}"), [-85.0, -55.0], [-15.0, 5.0]);
        within(&format!("ankle_angle_{side}"), [-35.0, -5.0], [5.0, 25.0]);
    }
    let support = support(&moved, [1.0, 8.0], &mut findings);
    let mean = support.iter().sum::<f64>() / support.len() as f64;
    println!("support {mean:.3} BW on average, {:.3?} BW", range(&support));
    // A walk neither rises nor sinks: 1 BW on average; the floor takes all of it, there being no plates.
    assert!((mean - 1.0).abs() < 0.05, "{mean}");
    assert!(range(&support)[0] > 0.1 && range(&support)[1] < 1.8);
}

#[test]
fn the_feet_of_the_walk_in_a_figure_of_eight_meet_the_ground_in_turn() {
    let Some(bvh) = real("AV_8Walk_Meredith_HVHA_Rep1.bvh") else { return };
    let mut findings = Findings::default();
    let skeleton = skeleton_from_bvh(&bvh, "walk", None, &mut findings).unwrap();
    let straight = straightened(&skeleton.markers).unwrap();
    let motion = foot_motion(&straight, &mut findings);
    // The first second begins from a stand.
    let strikes: Vec<&Event> = motion.events.iter().filter(|e| e.kind == EventKind::Strike && e.time_s > 1.0).collect();
    let steps: Vec<f64> = strikes.windows(2).map(|pair| pair[1].time_s - pair[0].time_s).collect();
    let step = steps.iter().sum::<f64>() / steps.len() as f64;
    let cadence = 60.0 / step;
    let is_later =
        |from: &&&Event, off: &&Event| off.kind == EventKind::Off && off.side == from.side && off.time_s > from.time_s;
    let stance = |strike: &&Event| {
        let off = motion.events.iter().find(|off| is_later(&strike, off))?;
        Some(off.time_s - strike.time_s)
    };
    let stances: Vec<f64> = strikes[1..strikes.len() - 2].iter().filter_map(stance).collect();
    let share = stances.iter().sum::<f64>() / stances.len() as f64 / (2.0 * step);
    let speed = motion.walking_speed_m_s;
    println!(
        "{} strikes, {cadence:.1} steps/min, stance {:.1} % of a cycle, {speed:.3} m/s",
        strikes.len(),
        100.0 * share
    );
    println!("steps {steps:.3?} s");
    assert!(strikes.windows(2).all(|pair| pair[0].side != pair[1].side));
    assert!(steps.iter().all(|step| (0.35..0.65).contains(step)));
    // Walkers of any speed: 90 to 140 steps a minute, 55 to 68 % stance.
    assert!((90.0..140.0).contains(&cadence) && (0.55..0.68).contains(&share) && (1.0..1.9).contains(&speed));
    // In the file's own axes the walk leads nowhere, and methods that look along x find nothing.
    assert!(foot_motion(&skeleton.markers, &mut findings).events.is_empty());
}

/// Upward force at the root, which without plates is all that the ground gives, over the body's weight.
fn support(moved: &Retargeted, [from, to]: [f64; 2], findings: &mut Findings) -> Vec<f64> {
    let model = &moved.human.model;
    let filter = LowPass { order: 3, cutoff_hz: 6.0 };
    let settings = AnalysisSettings {
        smoother: Smoother::Butterworth(filter),
        force_filter: Some(filter),
        window: Window { from_s: Some(from), to_s: Some(to) },
        rate_hz: None,
        instrumented: None,
    };
    let analysis = analyse(model, &moved.fit.motion, &[], settings, findings).unwrap();
    let up = model.coordinate("pelvis_ty").unwrap();
    let weight = model.mass() * model.gravity().norm();
    analysis.forces.generalized[up.index()].iter().map(|force| force / weight).collect()
}

#[test]
fn the_jumps_of_the_cmu_database_leave_the_ground() {
    let Some(bvh) = real("01_01.bvh") else { return };
    let (skeleton, moved, mut findings) = on_a_body(&bvh, 70.0, None);
    println!("{}", skeleton.statement);
    for finding in findings.as_slice() {
        println!("  {finding}");
    }
    let worst = moved.fit.errors.iter().max_by(|a, b| a.rms_m.total_cmp(&b.rms_m)).unwrap();
    println!("worst {} {:.1} mm rms, {:.1} mm at most", worst.name, 1e3 * worst.rms_m, 1e3 * worst.max_m);
    let support = support(&moved, [0.5, 22.0], &mut findings);
    let air = support.iter().filter(|force| **force < 0.15).count() as f64 / 120.0;
    let most = support.iter().copied().fold(0.0, f64::max);
    println!(
        "support {:.2} to {most:.2} BW, below 0.15 BW for {air:.2} s",
        support.iter().copied().fold(f64::INFINITY, f64::min)
    );
    // In the air nothing pushes; a low-pass of 6 Hz shortens a flight of 0.3 s, but leaves its middle.
    assert!(air > 0.2 && most > 2.0, "{air} {most}");
}
