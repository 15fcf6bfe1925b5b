//! Optimal motion: the forces at the root vanish, a forward simulation follows the plan, sides are mirrored, momentum
//! is kept.

use ambulo::contact::{FrictionCurve, HuntCrossley, Onset};
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Speed, Walk};
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::Side;
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::optimal::{
    Bound, NEAR_STAGES, NO_ROOT_FORCE, OptimalWalk, OptimalWalkError, Quantity, SPATIAL_STAGES, STAGES, Solution, Span,
    Term, WalkCosts, WalkPlan, WalkProblem, soles_with_width,
};
use ambulo::spatial::{Pose, Vec3};
use std::sync::LazyLock;

const MAN: Build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };

struct Case {
    human: Human,
    walk: Walk,
    problem: WalkProblem,
    solution: Solution,
}

fn planar_costs(knots: usize) -> WalkCosts {
    WalkCosts { knots, force: [0.02, 0.04], slip: 0.02, slip_exponent: 0.0, ..WalkCosts::default() }
}

fn case(human: Human, wide: bool) -> Case {
    let gait = Gait::named("free").unwrap();
    let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).unwrap();
    let soles = if wide { soles_with_width(&human) } else { human.soles.clone() };
    let costs = if wide { WalkCosts { knots: 24, ..WalkCosts::default() } } else { planar_costs(24) };
    let problem = WalkProblem::new(&human, &soles, HuntCrossley::SOFT_SHOES, &walk, &costs).unwrap();
    let solution = problem.solve(problem.stages()).unwrap();
    Case { human, walk, problem, solution }
}

static PLANAR: LazyLock<Case> = LazyLock::new(|| case(MAN.human().unwrap(), false));
static SPATIAL: LazyLock<Case> = LazyLock::new(|| case(full_body(&MAN).unwrap(), true));

fn both() -> [&'static Case; 2] {
    [&PLANAR, &SPATIAL]
}

#[test]
fn nothing_but_joints_and_ground_moves_an_optimal_walk() {
    for case in both() {
        let last = case.solution.progress.last().unwrap();
        assert!(last.root.1 < NO_ROOT_FORCE, "{:?}", case.solution.progress);
        let drift = case.solution.forward(case.walk.cycle_s(), 5e-4).unwrap();
        assert!(drift.place_m < 0.01 && drift.angle_rad < 2_f64.to_radians(), "{drift:?}");
    }
}

/// Sideways forces cost something where a figure can have them, and their targets are zero: people's are not known to
/// the objective.
#[test]
fn only_a_walk_in_three_dimensions_has_a_cost_of_sideways_force() {
    let sideways = |case: &Case| -> Vec<(Vec<usize>, Vec<Option<f64>>, f64)> {
        let of = |term: &Term| match &term.quantity {
            Quantity::GroundForce(spheres, 2) => Some((spheres.clone(), term.targets.clone(), term.deviation)),
            _ => None,
        };
        case.problem.problem.terms.iter().filter_map(of).collect()
    };
    assert!(sideways(&PLANAR).is_empty());
    let found = sideways(&SPATIAL);
    let weight = 75.0 * SPATIAL.human.model.gravity().norm();
    assert_eq!(found.len(), 2);
    for (spheres, targets, deviation) in &found {
        assert_eq!(spheres.len(), 6);
        assert!(targets.iter().all(|target| *target == Some(0.0)));
        assert!((deviation - WalkCosts::default().sideways_force * weight).abs() < 1e-6 * weight, "{deviation} N");
    }
}

#[test]
fn a_first_guess_does_not_pass_as_a_walk() {
    let Case { problem, walk, .. } = &*PLANAR;
    let guess = problem.solve(&[]).unwrap();
    assert!(guess.root_forces(4).unwrap().1 > 100.0 * NO_ROOT_FORCE);
    let drift = guess.forward(walk.cycle_s(), 5e-4).unwrap();
    assert!(drift.place_m > 0.01 || drift.angle_rad > 2_f64.to_radians(), "{drift:?}");
}

#[test]
fn the_ground_carries_the_weight_and_takes_no_momentum() {
    for case in both() {
        const SAMPLES: usize = 400;
        let times: Vec<f64> = (0..SAMPLES).map(|k| case.walk.cycle_s() * k as f64 / SAMPLES as f64).collect();
        let all: Vec<usize> = (0..case.problem.problem.soles.len()).collect();
        let weight = case.human.model.mass() * case.human.model.gravity().norm();
        let samples = case.solution.samples(&times).unwrap();
        for (axis, expected) in [(0, 0.0), (1, 1.0), (2, 0.0)] {
            let mean = samples.iter().map(|s| s.ground_force(&all)[axis]).sum::<f64>() / (SAMPLES as f64 * weight);
            assert!((mean - expected).abs() < 2e-3, "axis {axis}: {mean} body weights");
        }
        assert!(samples.iter().all(|s| s.contacts.iter().all(|c| c.force.y >= 0.0)));
    }
}

#[test]
fn left_does_half_a_cycle_later_what_right_did() {
    let Case { human, walk, solution, .. } = &*SPATIAL;
    let model = &human.model;
    let count = model.coordinates().len();
    let at = |time_s: f64| {
        let mut posture = [vec![0.0; count], vec![0.0; count], vec![0.0; count]];
        solution.write(time_s, &mut posture);
        posture
    };
    let half = 0.5 * walk.cycle_s();
    let id = |name: &str| model.coordinate(name).unwrap().index();
    for k in 0..20 {
        let time_s = 0.07 * f64::from(k);
        let (now, later) = (at(time_s), at(time_s + half));
        for part in 0..3 {
            for (name, other, sign) in [
                ("hip_flexion_r", "hip_flexion_l", 1.0),
                ("hip_adduction_r", "hip_adduction_l", 1.0),
                ("knee_angle_r", "knee_angle_l", 1.0),
                ("pelvis_list", "pelvis_list", -1.0),
                ("pelvis_rotation", "pelvis_rotation", -1.0),
                ("pelvis_tilt", "pelvis_tilt", 1.0),
            ] {
                let (a, b) = (now[part][id(name)], sign * later[part][id(other)]);
                assert!((a - b).abs() < 1e-9 * (1.0 + a.abs()), "{name}, derivative {part}, at {time_s} s: {a}, {b}");
            }
        }
        let forward = at(time_s + 2.0 * half)[0][id("pelvis_tx")] - now[0][id("pelvis_tx")];
        assert!((forward - walk.speed() * walk.cycle_s()).abs() < 1e-9, "{forward} m in a cycle");
    }
}

/// Pose of a body of the three-dimensional walk, with the phase of the right foot.
fn pose(body: &str, phase: f64) -> Pose {
    let Case { human, walk, solution, .. } = &*SPATIAL;
    let at = solution.samples(&[phase * walk.cycle_s()]).unwrap().remove(0);
    let [q, qd, qdd] = &at.posture;
    let number = human.model.bodies().iter().position(|b| b.name == body).unwrap();
    body_motion(&human.model, Posture { q, qd, qdd })[number].pose
}

/// Mean of a quantity from one phase of the right foot to another.
fn mean(from: f64, to: f64, quantity: impl Fn(f64) -> f64) -> f64 {
    (0..=10).map(|k| quantity(from + (to - from) * f64::from(k) / 10.0)).sum::<f64>() / 11.0
}

/// From the left to the right hip centre [m].
fn hips(phase: f64) -> Vec3 {
    pose("femur_r", phase).translation - pose("femur_l", phase).translation
}

#[test]
fn pelvis_and_thighs_move_out_of_plane_as_in_people() {
    // Obliquity: up on the stance side in early stance. Rotation: forward on the side of the foot strike.
    assert!(mean(0.10, 0.22, |phase| hips(phase).y) > 0.004, "{}", mean(0.10, 0.22, |phase| hips(phase).y));
    assert!(mean(0.60, 0.72, |phase| hips(phase).y) < -0.004);
    assert!(mean(0.0, 0.10, |phase| hips(phase).x) > 0.004, "{}", mean(0.0, 0.10, |phase| hips(phase).x));
    assert!(mean(0.50, 0.60, |phase| hips(phase).x) < -0.004);
    // Adduction: in the pelvis, the knee is medial of the hip in stance and lateral of it in early swing. Lateral is +z
    // on the right.
    for (side, right, later) in [("r", 1.0, 0.0), ("l", -1.0, 0.5)] {
        let knee_beyond_hip = |phase: f64| {
            let [knee, hip] = ["tibia", "femur"].map(|body| pose(&format!("{body}_{side}"), phase).translation);
            right * (pose("pelvis", phase).rotation.transpose() * (knee - hip)).z
        };
        let (stance, swing) =
            (mean(0.15 + later, 0.40 + later, knee_beyond_hip), mean(0.62 + later, 0.75 + later, knee_beyond_hip));
        assert!(stance < -0.01 && swing > 0.02, "{side}: knee {stance} m and {swing} m lateral of the hip");
    }
}

#[test]
fn the_trunk_turns_against_the_pelvis() {
    // Right side of the trunk in axes of the pelvis: forward and up.
    let right = |phase: f64| pose("pelvis", phase).rotation.transpose() * (pose("torso", phase).rotation * Vec3::z());
    assert!(mean(0.06, 0.22, |phase| right(phase).y) < -0.05, "{}", mean(0.06, 0.22, |phase| right(phase).y));
    assert!(mean(0.56, 0.72, |phase| right(phase).y) > 0.05);
    assert!(mean(0.0, 0.08, |phase| right(phase).x) < -0.03, "{}", mean(0.0, 0.08, |phase| right(phase).x));
    assert!(mean(0.50, 0.58, |phase| right(phase).x) > 0.03);
}

#[test]
fn joint_moments_of_an_optimal_walk_have_the_signs_of_peoples() {
    let Case { human, walk, solution, .. } = &*SPATIAL;
    for (side, later) in [("r", 0.0), ("l", 0.5)] {
        // Mean moment that flexes, dorsiflexes or adducts, but extends the knee [N.m/kg].
        let moment = |joint: &str, from: f64, to: f64| {
            let id = human.model.coordinate(&format!("{joint}_{side}")).unwrap().index();
            let at = |phase: f64| solution.samples(&[(phase + later) * walk.cycle_s()]).unwrap()[0].forces[id];
            mean(from, to, at) / human.model.mass()
        };
        let extends_at_loading = moment("hip_flexion", 0.04, 0.16);
        let flexes_before_foot_off = moment("hip_flexion", 0.44, 0.56);
        assert!(extends_at_loading < -0.2 && flexes_before_foot_off > 0.2, "hip {side}");
        let (loading, terminal) = (moment("knee_angle", 0.10, 0.18), moment("knee_angle", 0.34, 0.44));
        assert!(loading > 0.15 && terminal < -0.05, "knee {side}: {loading} and {terminal}");
        assert!(moment("ankle_angle", 0.40, 0.52) < -0.8, "ankle {side}");
        for (from, to) in [(0.14, 0.22), (0.26, 0.36), (0.40, 0.48)] {
            assert!(moment("hip_adduction", from, to) < -0.2, "hip abduction {side}, {from} to {to}");
        }
    }
}

#[test]
fn position_rate_and_acceleration_belong_together_across_the_seam() {
    let Case { human, walk, solution, .. } = &*SPATIAL;
    let count = human.model.coordinates().len();
    let at = |time_s: f64| {
        let mut posture = [vec![0.0; count], vec![0.0; count], vec![0.0; count]];
        solution.write(time_s, &mut posture);
        posture
    };
    let (half, step) = (0.5 * walk.cycle_s(), 1e-5);
    for time_s in [0.3 * half, half, 1.4 * half, 2.0 * half] {
        let (before, now, after) = (at(time_s - step), at(time_s), at(time_s + step));
        for part in 0..2 {
            for c in 0..count {
                let slope = (after[part][c] - before[part][c]) / (2.0 * step);
                let size = 1.0 + now[part + 1][c].abs();
                let apart = (slope - now[part + 1][c]).abs();
                assert!(apart < 2e-5 * size, "coordinate {c}, derivative {part}, {time_s} s: {apart}");
            }
        }
    }
}

#[test]
fn a_solution_starts_the_next_problem() {
    let Case { problem, solution, .. } = &*PLANAR;
    let again = problem.problem.solve(solution.unknowns(), &NEAR_STAGES[2..]).unwrap();
    assert!(steps(&again) < steps(solution), "{} and {} steps", steps(&again), steps(solution));
    assert!(again.progress.last().unwrap().root.1 < NO_ROOT_FORCE);
}

fn steps(solution: &Solution) -> usize {
    solution.progress.iter().map(|p| p.steps).sum()
}

#[test]
fn a_known_walk_starts_other_speeds_and_other_figures() {
    let Case { human, walk, problem, solution } = &*PLANAR;
    let costs = planar_costs(24);
    let other = |human: &Human, speed: f64| {
        let mut gait = Gait::named("free").unwrap();
        gait.pace = gait.pace.with(Some(speed), None, None);
        let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).unwrap();
        WalkProblem::new(human, &human.soles, HuntCrossley::SOFT_SHOES, &walk, &costs).unwrap()
    };
    let woman = Build { table: SegmentTable::DeLevaFemale, mass: 60.0, height: 1.65, toe_joint: true }.human().unwrap();
    // It has no joint in the trunk.
    let stiff = Build { table: SegmentTable::Faure1997, mass: 80.0, height: 1.8, toe_joint: true }.human().unwrap();
    assert!(stiff.model.coordinates().len() < human.model.coordinates().len());
    let slower = other(human, walk.speed() - 0.1);
    let cost = |s: &Solution| s.progress.last().unwrap().cost;
    let figures = [&woman, &stiff].map(|figure| other(figure, walk.speed()));
    for next in [&slower, &other(human, walk.speed() + 0.2), &figures[0], &figures[1]] {
        let (near, cold) = (next.solve_near(problem, solution.unknowns()).unwrap(), next.solve(&STAGES).unwrap());
        let root = near.progress.last().unwrap().root.1;
        println!(
            "{} steps instead of {}, root {root:.1e}; cost {} and {}",
            steps(&near),
            steps(&cold),
            cost(&near),
            cost(&cold)
        );
        assert!(steps(&near) < steps(&cold), "{:?} {:?}", near.progress, cold.progress);
        assert!(root < NO_ROOT_FORCE, "{:?}", near.progress);
        assert!(cost(&near) < 1.2 * cost(&cold), "{} and {}", cost(&near), cost(&cold));
    }
}

#[test]
fn a_walk_with_other_joints_or_knots_is_no_start() {
    let Case { human, walk, problem, solution } = &*PLANAR;
    let costs = planar_costs(12);
    let coarse = WalkProblem::new(human, &human.soles, HuntCrossley::SOFT_SHOES, walk, &costs).unwrap();
    let stages = |s: &Solution| s.progress.len();
    // Coarse splines leave forces at the root, and the solver goes on.
    assert!(stages(&coarse.solve_near(problem, solution.unknowns()).unwrap()) >= STAGES.len());
    // As from the first guess.
    let build = Build { toe_joint: false, ..MAN };
    let fewer = case(build.human().unwrap(), false);
    assert_eq!(stages(&problem.solve_near(&fewer.problem, fewer.solution.unknowns()).unwrap()), stages(solution));
    assert_eq!(stages(&problem.solve_near(problem, &solution.unknowns()[1..]).unwrap()), stages(solution));
    assert_eq!(stages(&problem.solve_near(problem, solution.unknowns()).unwrap()), NEAR_STAGES.len());
}

#[test]
fn an_objective_of_ones_own_is_followed() {
    let Case { human, problem, solution, .. } = &*PLANAR;
    let mut own = problem.problem.clone();
    let knee = human.model.coordinate("knee_angle_r").unwrap();
    for term in &mut own.terms {
        if term.quantity == Quantity::Position(vec![(knee, 1.0)]) {
            term.deviation *= 0.25;
            for target in term.targets.iter_mut().flatten() {
                *target -= 0.05;
            }
        }
    }
    assert_eq!(own.span, Span::MirroredHalfCycle);
    let bent = own.solve(solution.unknowns(), &NEAR_STAGES[2..]).unwrap();
    let mean = |s: &Solution| {
        let count = human.model.coordinates().len();
        let mut posture = [vec![0.0; count], vec![0.0; count], vec![0.0; count]];
        let mut sum = 0.0;
        for k in 0..50 {
            s.write(own.duration_s * f64::from(k) / 50.0, &mut posture);
            sum += posture[0][knee.index()] / 50.0;
        }
        sum
    };
    assert!(mean(&bent) < mean(solution) - 0.005, "{} and {} rad", mean(&bent), mean(solution));
}

/// Walks of the usual figures at slow, free and fast speed.
fn shipped() -> impl Iterator<Item = (Build, Walk)> {
    SegmentTable::ALL.into_iter().flat_map(|table| {
        let build = Build::usual(table);
        let leg_length = build.human().unwrap().dimensions.leg_length;
        ["slow", "free", "fast"].map(|name| {
            let gait = Gait::named(name).unwrap();
            (build, Walk::new(&gait, leg_length, &mut Findings::default()).unwrap())
        })
    })
}

#[test]
fn shipped_plans_solve_the_present_problem() {
    for (build, walk) in shipped() {
        let plan = WalkPlan::of(&build, &walk).unwrap();
        let plan = plan.unwrap_or_else(|| panic!("no plan of {} at {}", build.table, walk.name()));
        let found = OptimalWalk::find(&build, &walk).unwrap();
        assert_eq!(found.solution.unknowns(), plan.coefficients, "{} {}", build.table, walk.name());
        let root = found.solution.progress[0].root.1;
        println!("{} {}: {root:.1e}", build.table, walk.name());
        assert!(root < NO_ROOT_FORCE, "{} {}: {root:.1e}", build.table, walk.name());
        let between = found.solution.root_forces(10).unwrap().0;
        assert!(between < 4e-3, "{} {}: {between:.1e} between the instants", build.table, walk.name());
        let names: Vec<&str> = found.human.model.coordinates().iter().map(|c| c.name.as_str()).collect();
        assert_eq!(plan.coordinates, names);
        let text = plan.to_toml();
        assert_eq!(WalkPlan::from_toml(&text).unwrap(), plan);
    }
}

#[test]
fn a_shipped_plan_is_the_best_motion() {
    let (build, walk) = shipped().find(|(build, walk)| build.table == MAN.table && walk.name() == "free").unwrap();
    let found = OptimalWalk::find(&build, &walk).unwrap();
    let problem = &found.problem.problem;
    let again = problem.solve(found.solution.unknowns(), &STAGES[STAGES.len() - 1..]).unwrap();
    let apart = again.unknowns().iter().zip(found.solution.unknowns()).map(|(a, b)| (a - b).abs());
    let (apart, cost) = (apart.fold(0.0, f64::max), |s: &Solution| s.progress.last().unwrap().cost);
    println!("solved again: coefficients move by {apart:.1e}; cost {} and {}", cost(&found.solution), cost(&again));
    assert!(apart < 0.02, "{apart} rad or m");
    assert!(cost(&again) > 0.9 * cost(&found.solution), "{} and {}", cost(&found.solution), cost(&again));
}

/// Root mean square of the part of a periodic series between two frequencies [Hz], by its harmonics.
fn band(values: &[f64], cycle_s: f64, [low, high]: [f64; 2]) -> f64 {
    let count = values.len() as f64;
    let power = |harmonic: usize| {
        let turn = |i: usize| std::f64::consts::TAU * harmonic as f64 * i as f64 / count;
        let part =
            |wave: fn(f64) -> f64| values.iter().enumerate().map(|(i, x)| x * wave(turn(i))).sum::<f64>() * 2.0 / count;
        0.5 * (part(f64::cos).powi(2) + part(f64::sin).powi(2))
    };
    let harmonics = 1..values.len() / 2;
    harmonics.filter(|h| (low..=high).contains(&(*h as f64 / cycle_s))).map(power).sum::<f64>().sqrt()
}

#[test]
fn moments_of_shipped_walks_do_not_ripple() {
    let sine: Vec<f64> = (0..400).map(|i| (std::f64::consts::TAU * 15.0 * f64::from(i) / 400.0).sin()).collect();
    assert!((band(&sine, 1.0, [10.0, 20.0]) - 0.5_f64.sqrt()).abs() < 1e-12);
    assert!(band(&sine, 1.0, [16.0, 20.0]) < 1e-12);
    for (build, walk) in shipped().filter(|(_, walk)| walk.name() == "free") {
        let found = OptimalWalk::find(&build, &walk).unwrap();
        let times: Vec<f64> = (0..400).map(|i| walk.cycle_s() * f64::from(i) / 400.0).collect();
        let samples = found.solution.samples(&times).unwrap();
        for joint in ["hip_flexion_r", "knee_angle_r"] {
            let id = found.human.model.coordinate(joint).unwrap();
            let moment: Vec<f64> = samples.iter().map(|sample| sample.forces[id.index()] / build.mass).collect();
            let [ripple, all] = [[10.0, 20.0], [0.0, 1000.0]].map(|range| band(&moment, walk.cycle_s(), range));
            println!("{} {joint}: {ripple:.4} of {all:.3} N.m/kg between 10 and 20 Hz", build.table);
            assert!(ripple < 0.025 && ripple < 0.1 * all, "{joint} {ripple} {all}");
        }
    }
}

#[test]
fn a_plan_belongs_to_its_figure_speed_and_cadence_alone() {
    let (build, walk) = shipped().next().unwrap();
    assert!(WalkPlan::of(&build, &walk).unwrap().is_some());
    assert!(WalkPlan::of(&Build { mass: build.mass + 1.0, ..build }, &walk).unwrap().is_none());
    let other = |change: &dyn Fn(&mut Gait)| {
        let mut gait = walk.gait().clone();
        change(&mut gait);
        let walk = Walk::new(&gait, walk.leg_length(), &mut Findings::default()).unwrap();
        WalkPlan::of(&build, &walk).unwrap()
    };
    assert!(other(&|_| ()).is_some());
    assert!(other(&|gait| gait.step_height = 1.2).is_none());
    assert!(other(&|gait| gait.pace = gait.pace.with(Some(walk.speed() + 0.01), None, None)).is_none());
    let (speed, steps) = (Some(walk.speed()), Some(2.1 / walk.cycle_s()));
    assert!(other(&|gait| gait.pace = gait.pace.with(speed, None, steps)).is_none());
}

#[test]
fn other_speeds_are_solved_from_the_nearest_plan() {
    for (build, _) in shipped().step_by(3) {
        let leg_length = build.human().unwrap().dimensions.leg_length;
        for (speed, nearest) in [(0.25, 0.29), (0.4, 0.429), (0.56, 0.56), (0.7, 0.56)] {
            let mut gait = Gait::named("free").unwrap();
            gait.pace.speed = Some(Speed::Dimensionless(speed));
            let walk = Walk::new(&gait, leg_length, &mut Findings::default()).unwrap();
            let (plan, walk_of_plan) = WalkPlan::nearest(build.table, &walk).unwrap().unwrap();
            assert!((plan.speed - nearest).abs() < 1e-9, "{} at {speed}: {}", build.table, plan.speed);
            assert!((walk_of_plan.cycle_s() - plan.cycle_s).abs() < 1e-9);
            gait.step_height = 1.2;
            let walk = Walk::new(&gait, leg_length, &mut Findings::default()).unwrap();
            assert!(WalkPlan::nearest(build.table, &walk).unwrap().is_none(), "steps that are not those of people");
        }
    }
    // The plan is of another mass and height, and of a speed that is 0.17 m/s slower.
    let build = Build { mass: 60.0, height: 1.62, ..MAN };
    let mut gait = Gait::named("free").unwrap();
    gait.pace.speed = Some(Speed::MetersPerSecond(1.4));
    let leg_length = build.human().unwrap().dimensions.leg_length;
    let walk = Walk::new(&gait, leg_length, &mut Findings::default()).unwrap();
    let found = OptimalWalk::find(&build, &walk).unwrap();
    let cold = OptimalWalk::find_with(&build, &walk, &SPATIAL_STAGES).unwrap();
    let steps = |found: &OptimalWalk| found.solution.progress.iter().map(|stage| stage.steps).sum::<usize>();
    println!("{} steps from the plan, {} from the laws", steps(&found), steps(&cold));
    assert!(found.solution.unbalanced(NO_ROOT_FORCE).is_none());
    assert!(steps(&found) < steps(&cold));
}

#[test]
fn what_is_not_found_is_said_with_place_and_size() {
    let (build, walk) = shipped().next().unwrap();
    let found = OptimalWalk::find_with(&build, &walk, &[]);
    let Err(OptimalWalkError::NotConverged { worst, .. }) = &found else { panic!("{found:?}") };
    assert!(worst.force.abs() > worst.allowed && worst.coordinate.starts_with("pelvis"), "{worst:?}");
    let message = found.unwrap_err().to_string();
    for part in ["no walk at 0.", "steps/min", " s `pelvis_", "; expected at most"] {
        assert!(message.contains(part), "{message}");
    }
}

#[test]
fn a_plan_file_that_is_wrong_is_refused_with_its_line() {
    let (build, walk) = shipped().next().unwrap();
    let text = WalkPlan::of(&build, &walk).unwrap().unwrap().to_toml();
    for (from, to, expected) in [
        ("figure = \"faure-1997\"", "figure = \"nobody\"", "line 2"),
        ("speed = ", "pace = ", "pace"),
        ("  [", "  [0.5, ", "one list of numbers per knot"),
        ("cycle_s = ", "cycle_s = -", "cycle_s"),
    ] {
        let message = WalkPlan::from_toml(&text.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn a_deviation_of_one_costs_one_for_any_number_of_instants() {
    for per_knot in [1, 2, 5] {
        let mut problem = PLANAR.problem.problem.clone();
        problem.instants_per_knot = per_knot;
        // The sum of no coordinates is zero.
        let (quantity, targets) = (Quantity::Position(Vec::new()), vec![Some(-3.0); problem.instants()]);
        problem.terms = vec![Term { name: "three".to_owned(), quantity, targets, deviation: 3.0, bound: Bound::Near }];
        let costs = problem.costs(PLANAR.solution.unknowns());
        assert!((costs[0].1 - 1.0).abs() < 1e-12, "{costs:?}");
    }
}

#[test]
fn soles_with_width_have_their_medial_spheres_nearer_to_the_middle() {
    let human = full_body(&MAN).unwrap();
    let soles = soles_with_width(&human);
    assert_eq!(soles.len(), 2 * human.soles.len());
    for pair in soles.chunks(2) {
        let right = if pair[0].side == Side::Right { 1.0 } else { -1.0 };
        assert!(pair[0].name.ends_with("medial") && pair[1].name.ends_with("lateral"));
        assert!(right * (pair[1].center.z - pair[0].center.z) > 0.02, "{pair:?}");
        assert_eq!(pair[0].center.x.to_bits(), pair[1].center.x.to_bits());
    }
}

#[test]
fn newton_s_method_finds_the_exact_minimum_near_a_solution() {
    let build = Build { toe_joint: false, ..MAN };
    let human = build.human().unwrap();
    let gait = Gait::named("free").unwrap();
    let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).unwrap();
    let smooth = HuntCrossley { friction_curve: FrictionCurve::Smooth, ..HuntCrossley::MOCO_2D_GAIT };
    let shoes = HuntCrossley { onset: Onset::Published, ..smooth };
    let costs = WalkCosts { knots: 8, per_knot: 1, ..WalkCosts::default() };
    let mut own = WalkProblem::new(&human, &human.soles, shoes, &walk, &costs).unwrap();
    // Terms without corners.
    own.problem.terms.retain(|term| term.bound == Bound::Near && !matches!(term.quantity, Quantity::Slip { .. }));
    let near = own.solve(&STAGES[..4]).unwrap();
    let exact = own.problem.refine(near.unknowns(), 1e-4, 300).unwrap();
    let last = exact.progress.last().unwrap();
    println!("{:?} to {last:?}", near.progress.last().unwrap());
    assert!(near.progress.last().unwrap().root.1 > 1e-3 && last.root.1 <= 1e-4 && last.steps > 0, "{last:?}");
}
