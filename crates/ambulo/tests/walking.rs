//! Walking figures: forces compared with inverse dynamics, momentum, symmetry, contact laws, and invalid figures.

use ambulo::dynamics::{LoadSeries, Workspace, inverse};
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Walk};
use ambulo::kinematics::each_body_motion;
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::simulation::walking::{
    GroundContact, HARMONICS, Release, Shoes, TorqueSeries, WalkRecording, Walker, WalkingError, gait_signals,
};
use ambulo::simulation::{ImpactLaw, Signal, StepSettings};
use ambulo::spatial::{Vec3, Wrench};

const G: f64 = 9.80665;

fn human() -> Human {
    Build { table: SegmentTable::Faure1997, mass: 80.0, height: 1.80, toe_joint: false }.human().unwrap()
}

fn ground(friction: f64) -> GroundContact {
    GroundContact { friction, shoes: Shoes::Rigid, impact: ImpactLaw::Sticking }
}

fn walker(gait: &str, human: &Human, ground: &GroundContact) -> (Walker, f64) {
    let gait = Gait::named(gait).unwrap();
    let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).unwrap();
    (
        Walker::new(human, gait_signals(&walk, &human.model, 0.0, 1.0).unwrap(), ground, walk.speed()).unwrap(),
        walk.cycle_s(),
    )
}

fn walked(gait: &str, ground: &GroundContact, step_s: f64, cycles: f64) -> WalkRecording {
    let (walker, cycle_s) = walker(gait, &human(), ground);
    let settings = StepSettings { step_s, ..StepSettings::default() };
    walker.walk(&settings, cycles * cycle_s, &mut Findings::default()).unwrap()
}

#[test]
fn a_figure_begins_on_its_lowest_sole() {
    for table in SegmentTable::ALL {
        let human = Build { table, mass: 70.0, height: 1.75, toe_joint: true }.human().unwrap();
        let (walker, _) = walker("free", &human, &ground(1.0));
        let lowest = human.soles.iter().map(|sole| {
            let body = sole.body.index();
            let center = human.model.bodies()[body].inertia.center();
            walker.world.bodies[body].pose.place(sole.center - center).y - sole.radius
        });
        assert!(lowest.fold(f64::INFINITY, f64::min).abs() < 1e-12, "{table}");
        let speed = walker.world.bodies[0].twist.linear.x;
        assert!((speed - 1.3).abs() < 0.2, "{speed}");
    }
}

/// Loads of both feet on the model, one a row.
fn loads(recording: &WalkRecording) -> Vec<LoadSeries> {
    recording
        .feet
        .iter()
        .map(|foot| LoadSeries {
            body: foot.body,
            points: foot.point.clone(),
            wrenches: foot.force.iter().map(|force| Wrench { moment: Vec3::zeros(), force: *force }).collect(),
        })
        .collect()
}

#[test]
fn torques_of_the_multipliers_are_those_of_inverse_dynamics() {
    // Root mean square difference over its like of the torques themselves.
    let error = |step_s: f64| {
        let recording = walked("standard", &ground(1.0), step_s, 3.0);
        let forces = inverse(&mut Workspace::new(&recording.model), &recording.trajectory, &loads(&recording));
        let mut sums = [0.0, 0.0];
        for (of_multipliers, of_inverse) in recording.efforts.iter().zip(&forces.generalized) {
            for row in 1..of_inverse.len() {
                sums[0] += (of_multipliers[row] - of_inverse[row]).powi(2);
                sums[1] += of_multipliers[row].powi(2);
            }
        }
        (sums[0] / sums[1]).sqrt()
    };
    let errors = [error(2e-3), error(1e-3), error(5e-4)];
    // The joints' accelerations in a step of impulses are differences over it; those of the recording are the gait's
    // own.
    assert!(errors[1] < 0.01, "{errors:?}");
    assert!(errors[2] < 0.7 * errors[1] && errors[1] < 0.7 * errors[0], "{errors:?}");
}

#[test]
fn forces_and_impacts_carry_the_weight() {
    let recording = walked("standard", &ground(1.0), 1e-3, 12.0);
    let (grid, weight) = (recording.grid(), 80.0 * G);
    // From the middle of a cycle's flight on, six whole cycles: momentum comes back to where it was.
    let (from, to) = (6000, 12000);
    let vertical: f64 = recording.feet.iter().flat_map(|foot| &foot.force[from..to]).map(|f| f.y).sum();
    let within = |t: f64| (grid.time(from)..grid.time(to - 1)).contains(&t);
    let impacts = recording.impacts.iter().filter(|impact| within(impact.time_s));
    let impacts: f64 = impacts.flat_map(|impact| &impact.impulses).map(|impulse| impulse.y).sum();
    let carried = (vertical * grid.step_s + impacts) / (6.0 * weight);
    assert!((carried - 1.0).abs() < 1e-3, "{carried} of the weight");
    let forward: f64 = recording.feet.iter().flat_map(|foot| &foot.force[from..to]).map(|f| f.x).sum();
    let impacts: f64 =
        recording.impacts.iter().filter(|impact| within(impact.time_s)).flat_map(|b| &b.impulses).map(|i| i.x).sum();
    assert!((forward * grid.step_s + impacts).abs() < 1e-3 * weight, "forwards nothing is left");
    // Without the impacts it would not do.
    assert!((vertical * grid.step_s / (6.0 * weight) - 1.0).abs() > 0.05);
}

#[test]
fn the_laws_of_contact_hold_in_every_row() {
    let recording = walked("standard", &ground(0.8), 1e-3, 6.0);
    assert_eq!(recording.unsolved_steps, 0);
    let (mut stuck, mut slid, mut flew) = (0, 0, 0);
    for row in 0..recording.grid().frames {
        for foot in &recording.feet {
            let force = foot.force[row];
            assert!(force.y >= 0.0 && force.z.abs() < 1e-6 * (1.0 + force.y), "{force}");
            assert!(force.x.abs() <= 0.8 * force.y * (1.0 + 1e-6) + 1e-9, "beyond the cone: {force}");
            if foot.loaded(row) && !foot.at_limit[row] {
                assert!(foot.slip[row].abs() < 1e-6, "slips inside its cone at row {row}: {}", foot.slip[row]);
                stuck += 1;
            }
            slid += usize::from(foot.at_limit[row]);
        }
        flew += usize::from(recording.flies(row));
    }
    assert!(stuck > 500 && slid > 200 && flew > 200, "{stuck} {slid} {flew}");
}

#[test]
fn in_flight_the_mass_centre_falls_freely() {
    let recording = walked("standard", &ground(1.0), 2e-4, 4.0);
    let masses: Vec<f64> = recording.model.bodies().iter().map(|body| body.inertia.mass()).collect();
    let mut fallen = 0;
    each_body_motion(&recording.model, &recording.trajectory, |row, motions| {
        let near_impact =
            recording.impacts.iter().any(|impact| (impact.time_s - recording.grid().time(row)).abs() < 1e-3);
        if near_impact || !recording.flies(row) {
            return;
        }
        let sum: Vec3 = motions.iter().zip(&masses).map(|(motion, m)| motion.acceleration.linear * *m).sum();
        let acceleration = sum / 80.0;
        // Rows have the accelerations of a step, which meet the gait's own to its order.
        assert!((acceleration - Vec3::new(0.0, -G, 0.0)).norm() < 0.1, "row {row}: {acceleration}");
        fallen += 1;
    });
    assert!(fallen > 1000);
}

#[test]
fn right_and_left_do_the_same_half_a_cycle_later() {
    let recording = walked("standard", &ground(1.0), 1e-3, 12.0);
    let [right, left] = ["hip_flexion_r", "hip_flexion_l"].map(|name| recording.effort(name).unwrap());
    let largest = right[6000..].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let off = (6000..11000).map(|row| (right[row] - left[row + 500]).abs()).fold(0.0, f64::max);
    assert!(off < 1e-3 * largest, "{off} of {largest}");
}

#[test]
fn the_same_walk_has_the_same_bits() {
    let one = walked("short", &ground(1.0), 1e-3, 2.0);
    let other = walked("short", &ground(1.0), 1e-3, 2.0);
    assert_eq!((one.efforts, one.impacts), (other.efforts, other.impacts));
}

#[test]
fn invalid_figures_are_rejected() {
    let human = human();
    let none = Walker::new(&human, vec![Signal::Constant(0.0)], &ground(1.0), 1.0);
    assert_eq!(none.unwrap_err(), WalkingError::Signals { found: 1, expected: human.model.coordinates().len() });
    let (walker, _) = walker("free", &human, &ground(1.0));
    let refused = walker.walk(&StepSettings::default(), 1e-4, &mut Findings::default()).unwrap_err();
    assert!(refused.to_string().contains("at least one whole step"), "{refused}");
}

#[test]
fn a_figure_without_drives_and_torques_falls_like_a_pendulum_that_is_let_go() {
    let (walker, cycle_s) = walker("standard", &human(), &ground(1.0));
    let still = |coordinate: &str| TorqueSeries {
        coordinate: coordinate.to_owned(),
        cycle_s,
        body_kg: 72.6,
        mean: 0.0,
        cosine: [0.0; HARMONICS],
        sine: [0.0; HARMONICS],
        r_squared: 1.0,
    };
    let joints = ["hip_flexion", "knee_angle", "ankle_angle"];
    let torques: Vec<TorqueSeries> =
        joints.iter().flat_map(|joint| ["r", "l"].map(|side| still(&format!("{joint}_{side}")))).collect();
    let settings = StepSettings { step_s: 1e-3, ..StepSettings::default() };
    let release = Release { torques: &torques, time_s: 1.0 };
    let (recording, fell_after_s) = walker.walk_released(release, &settings, 4.0, &mut Findings::default()).unwrap();
    let fell_after_s = fell_after_s.unwrap();
    // Falling freely through a quarter of its height takes 0.22 s; legs that fold hold it up longer, but not for long.
    assert!((0.2..1.0).contains(&fell_after_s), "{fell_after_s}");
    assert!((recording.grid().end_s() - 1.0 - fell_after_s - 0.1).abs() < 0.01);
    // The efforts are those that were asked for: none, and the trunk is held by nothing.
    for name in ["knee_angle_r", "hip_flexion_l", "pelvis_tilt"] {
        let largest = recording.effort(name).unwrap()[1001..1150].iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        assert!(largest < 1e-6, "{name}: {largest}");
    }
    let driven = walker.walk(&settings, 1.0, &mut Findings::default()).unwrap();
    for id in recording.model.coordinate_ids() {
        assert_eq!(driven.trajectory.values(id)[..999], recording.trajectory.values(id)[..999]);
    }
    let unknown = [still("pelvis_tx")];
    let release = Release { torques: &unknown, time_s: 1.0 };
    let error = walker.walk_released(release, &settings, 2.0, &mut Findings::default()).unwrap_err();
    assert!(error.to_string().starts_with("found torques of the coordinate `pelvis_tx`"), "{error}");
}
