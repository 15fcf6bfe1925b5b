//! Robustness of the simulator: long runs, resumed runs, random scenes, impossible drives.

use crate::common::random::Random;
use crate::common::turn;
use crate::common::worlds::{
    G, O, Run, add_ball, add_body, add_box, add_closure, add_floor, add_hinge, add_joint, add_obstacle, add_surface,
    along, drive, empty, of_rigid, sine, turned, v,
};
use ambulo::contact::{HuntCrossley, Shape};
use ambulo::simulation::{
    ContactLaw, JointDrive, JointKind, Material, Motor, ObstaclePath, Owner, Signal, Spring, World, WorldState, energy,
    largest_joint_error,
};
use ambulo::spatial::{Mat3, Pose, Twist, Vec3, Wrench};
use std::panic::{AssertUnwindSafe, catch_unwind};

// ---- drift ----

/// Links of 0.2 m and 1 kg with alternating hinge axes, released from the horizontal with an initial spin.
fn chain(links: usize) -> World {
    let mut world = empty();
    for i in 0..links {
        let body = add_body(&mut world, 1.0, [0.002, 0.004, 0.004], Pose::at(v(0.2 * i as f64 + 0.1, 0.0, 0.0)));
        let axis = if i % 2 == 0 { Vec3::z() } else { Vec3::y() };
        let parent = body.checked_sub(1);
        let on_parent = along(axis, v(if parent.is_some() { 0.1 } else { 0.0 }, 0.0, 0.0));
        add_joint(&mut world, JointKind::Revolute, body, parent, [on_parent, along(axis, v(-0.1, 0.0, 0.0))]);
    }
    world.bodies[links - 1].twist.angular = v(0.0, 5.0, 3.0);
    world
}

/// Largest distance of the ends of two neighbours, from the poses.
fn gap_of_chain(run: &Run) -> f64 {
    let end = |body: usize, x: f64| run.state.poses[body].place(v(x, 0.0, 0.0));
    (1..run.world.bodies.len()).map(|b| (end(b - 1, 0.1) - end(b, -0.1)).norm()).fold(end(0, -0.1).norm(), f64::max)
}

#[test]
fn a_chain_of_twenty_links_that_flails_for_a_minute_keeps_together() {
    let mut run = Run::new(chain(20), 1e-3);
    let (mut gap, mut reported, mut fastest) = (0.0_f64, 0.0_f64, 0.0_f64);
    let start = energy(&run.world, &run.state).total();
    run.watch(60.0, |run| {
        gap = gap.max(gap_of_chain(run));
        fastest = fastest.max(run.spin(19).norm());
        if run.state.time_s.fract() < 1e-3 {
            reported = reported.max(largest_joint_error(&run.world, &run.state));
        }
    });
    let end = energy(&run.world, &run.state).total();
    println!("gap {gap:e} m (reported {reported:e}), fastest {fastest} rad/s, energy {start} -> {end} J");
    assert!(fastest > 20.0, "it must flail");
    // Children are seated by their coordinates: rounding of poses of 4 m, 1e-15 each, over 20 links.
    assert!(gap < 1e-12 && reported < 1e-12, "{gap:e} {reported:e}");
    assert!(end <= start, "a chain without drives may not gain energy");
    let mut loose = Run::new(chain(20), 1e-3);
    loose.settings.projection = false;
    assert!(gap_of_chain(loose.to(2.0)) > 1e-5, "without projection it must drift");
}

// ---- the same bits ----

/// Something of everything: a pile, a driven arm, a loop, a belt, soft feet.
fn medley() -> World {
    let mut world = of_rigid(0.5, 0.3);
    add_floor(&mut world, Pose::IDENTITY);
    for k in 0..3 {
        let x = 0.02 * f64::from(k);
        add_ball(&mut world, 1.0, 0.1, v(x, 0.3 + 0.5 * f64::from(k), 0.0));
        add_box(&mut world, 2.0, Vec3::repeat(0.1), turned(0.3, v(0.05 - x, 0.6 + 0.5 * f64::from(k), 0.03)));
    }
    let arm = add_box(&mut world, 2.0, v(0.3, 0.05, 0.05), Pose::at(v(1.0, 0.3, 0.0)));
    let joint = add_hinge(&mut world, arm, None, v(1.3, 0.3, 0.0), v(0.3, 0.0, 0.0));
    drive(&mut world, joint, 0, sine(0.4, 0.4, 0.0, 0.0));
    let rod = add_body(&mut world, 1.0, [0.01, 0.01, 0.01], Pose::at(v(-1.0, 1.0, 0.0)));
    add_hinge(&mut world, rod, None, v(-1.2, 1.0, 0.0), v(-0.2, 0.0, 0.0));
    let other = add_body(&mut world, 1.0, [0.01, 0.01, 0.01], Pose::at(v(-0.6, 1.0, 0.0)));
    add_closure(&mut world, JointKind::Ball, other, Some(rod), [v(-0.2, 0.0, 0.0), v(0.2, 0.0, 0.0)].map(Pose::at));
    world
}

#[test]
fn a_saved_state_resumes_bit_for_bit() {
    let mut whole = Run::new(medley(), 2e-3);
    whole.to(5.0);
    let saved = whole.state.clone();
    whole.to(10.0);
    let mut resumed = Run::new(medley(), 2e-3);
    resumed.state = saved.clone();
    resumed.to(10.0);
    assert_eq!(resumed.state, whole.state, "resumed with fresh scratch");
    let mut again = Run::new(medley(), 2e-3);
    again.to(10.0);
    assert_eq!(again.state, whole.state, "the same input, the same bits");
    let mut nudged = Run::new(medley(), 2e-3);
    nudged.state = WorldState { time_s: saved.time_s, ..saved };
    nudged.state.poses[0].translation.x += 1e-15;
    assert_ne!(nudged.to(10.0).state, whole.state, "a nudge of 1e-15 m must show");
}

// ---- random scenes ----

fn signal(r: &mut Random) -> Signal {
    match r.below(3) {
        0 => Signal::Constant(r.within(0.5)),
        1 => sine(r.within(1.0), r.between(0.1, 3.0), r.within(3.0), r.within(0.3)),
        _ => Signal::Stops(vec![(0.0, 0.0), (r.between(0.01, 0.5), r.within(1.0)), (1.0, r.within(1.0))]),
    }
}

fn shape(r: &mut Random) -> Shape {
    let size = |r: &mut Random| r.between(0.03, 0.3);
    match r.below(4) {
        0 => Shape::sphere(size(r)).unwrap(),
        1 => Shape::capsule(r.vector(0.3), r.vector(0.3) + v(0.7, 0.0, 0.0), size(r)).unwrap(),
        2 => Shape::cuboid(v(size(r), size(r), size(r))).unwrap(),
        _ => {
            let points: Vec<Vec3> = (0..4 + r.below(8)).map(|_| r.vector(0.3)).collect();
            Shape::convex(&points).unwrap_or_else(|_| Shape::sphere(0.1).unwrap())
        }
    }
}

const KINDS: [JointKind; 7] = [
    JointKind::Weld,
    JointKind::Revolute,
    JointKind::Prismatic,
    JointKind::Universal,
    JointKind::Ball,
    JointKind::Planar,
    JointKind::Free,
];

fn material(r: &mut Random) -> Material {
    let law = match r.below(4) {
        0 => ContactLaw::Regularised { stiffness: 10_f64.powf(r.between(2.0, 6.0)), damping: r.between(0.0, 500.0) },
        1 => ContactLaw::HuntCrossley(HuntCrossley::FALISSE_2022),
        _ => ContactLaw::Rigid,
    };
    let restitution = if r.chance(0.5) { 0.0 } else { r.between(0.0, 1.0) };
    Material { friction: r.between(0.0, 1.5) * f64::from(u8::from(r.chance(0.8))), restitution, law }
}

/// What acts on coordinates, seldom all of it.
fn act(world: &mut World, joint: usize, r: &mut Random) {
    for acting in &mut world.joints[joint].coordinates {
        if r.chance(0.25) {
            acting.drive = Some(JointDrive { signal: signal(r), max: r.chance(0.3).then(|| r.between(0.1, 100.0)) });
        }
        if r.chance(0.2) {
            acting.spring =
                Some(Spring { stiffness: r.between(0.0, 1e4), damping: r.between(0.0, 10.0), rest: r.within(1.0) });
        }
        if r.chance(0.2) {
            let (kp, kd) = (r.between(0.0, 1e3), r.between(0.0, 100.0));
            acting.motor = Some(Motor { target: signal(r), kp, kd, max: r.between(0.0, 100.0) });
        }
        if r.chance(0.2) {
            // Not every start lies within.
            acting.limits = (r.chance(0.7).then(|| r.between(-1.0, 0.05)), r.chance(0.7).then(|| r.between(0.1, 1.0)));
        }
        acting.friction = if r.chance(0.2) { r.between(0.0, 5.0) } else { 0.0 };
        acting.rotor = if r.chance(0.2) { r.between(0.0, 1.0) } else { 0.0 };
    }
}

fn random_scene(r: &mut Random) -> World {
    let mut world = World { gravity: if r.chance(0.9) { v(0.0, -G, 0.0) } else { O }, ..World::default() };
    world.materials = (0..3).map(|_| material(r)).collect();
    if r.chance(0.7) {
        add_floor(
            &mut world,
            Pose { rotation: turn(r.unit(), r.within(0.3)), translation: v(0.0, r.within(0.5), 0.0) },
        );
    } else {
        let heights = r.list(25, 0.3);
        let field = Shape::height_field(5, 5, &heights, 4.0, 4.0).unwrap();
        let obstacle = add_obstacle(&mut world, Pose::IDENTITY, None);
        add_surface(&mut world, Owner::Obstacle(obstacle), field, Pose::IDENTITY);
    }
    if r.chance(0.4) {
        let path = ObstaclePath { shift: [signal(r), signal(r), signal(r)], axis: r.unit(), turn: signal(r) };
        let obstacle =
            add_obstacle(&mut world, Pose { rotation: r.rotation(), translation: r.vector(1.0) }, Some(path));
        add_surface(&mut world, Owner::Obstacle(obstacle), shape(r), Pose::IDENTITY);
    }
    for child in 0..1 + r.below(9) {
        let parent = (child > 0 && r.chance(0.8)).then(|| r.below(child.max(1)));
        let [on_parent, on_child] = [r.pose(), r.pose()];
        let joined = r.chance(0.75);
        let pose = if joined {
            parent.map_or(Pose::IDENTITY, |p| world.bodies[p].pose) * on_parent * on_child.inverse()
        } else {
            Pose { rotation: r.rotation(), translation: r.vector(1.5) }
        };
        let mass = 10_f64.powf(r.between(-2.0, 2.0));
        let (a, b) = (r.between(0.01, 0.1), r.between(0.01, 0.1));
        let body = add_body(&mut world, mass, [a, b, r.between((a - b).abs() + 1e-4, a + b)].map(|i| i * mass), pose);
        world.bodies[body].twist = Twist { angular: r.vector(5.0), linear: r.vector(3.0) };
        if r.chance(0.3) {
            world.bodies[body].load = Wrench { moment: r.vector(5.0 * mass), force: r.vector(20.0 * mass) };
        }
        if joined {
            let kind = KINDS[r.below(KINDS.len())];
            let joint = add_joint(&mut world, kind, body, parent, [on_parent, on_child]);
            act(&mut world, joint, r);
        }
        for _ in 0..r.below(3) {
            let place = r.pose();
            let surface = add_surface(&mut world, Owner::Body(body), shape(r), place);
            world.surfaces[surface].material = r.below(3);
        }
    }
    for _ in 0..r.below(3) {
        let first = r.below(world.bodies.len());
        let second = Some(r.below(world.bodies.len())).filter(|s| *s != first && r.chance(0.8));
        let on_first = r.pose();
        // Most loops close at the start; some have to be pulled together.
        let seat = world.bodies[first].pose * on_first;
        let on_second = second.map_or(Pose::IDENTITY, |s| world.bodies[s].pose).inverse() * seat;
        let off = if r.chance(0.8) { Pose::IDENTITY } else { Pose::at(r.vector(0.2)) };
        add_closure(&mut world, KINDS[r.below(KINDS.len())], first, second, [on_first, on_second * off]);
    }
    world
}

fn finite(state: &WorldState) -> bool {
    let six = |t: &Twist| t.angular.iter().chain(t.linear.iter()).all(|x| x.is_finite());
    let pose = |p: &Pose| p.rotation.iter().chain(p.translation.iter()).all(|x| x.is_finite());
    state.poses.iter().all(pose)
        && state.twists.iter().all(six)
        && state.coordinates.iter().flatten().all(|x| x.is_finite())
}

/// Departure of the change of momentum from the outer forces, as a share of all momenta and impulses; `None` where
/// ground joints or closures take part.
fn newton(before: Vec3, run: &Run) -> Option<f64> {
    let world = &run.world;
    if world.joints.iter().any(|j| j.parent.is_none()) || world.closures.iter().any(|c| c.second.is_none()) {
        return None;
    }
    let h = run.settings.step_s;
    let mut impulse: Vec3 = world.bodies.iter().map(|b| (world.gravity * b.mass + b.load.force) * h).sum();
    let mut size = impulse.norm();
    for contact in run.forces().contacts {
        let outer = |s: usize| f64::from(matches!(world.surfaces[s].owner, Owner::Obstacle(_)));
        impulse += contact.force * h * (outer(contact.surfaces.1) - outer(contact.surfaces.0));
        size += contact.force.norm() * h;
    }
    size += world.bodies.iter().zip(&run.state.twists).map(|(b, t)| b.mass * t.linear.norm()).sum::<f64>();
    Some((run.momentum().0 - before - impulse).norm() / size)
}

#[derive(Default, Clone, Copy)]
struct Count {
    steps: usize,
    unconverged: usize,
    iterations: usize,
    unbalanced: f64,
}

/// Runs a scene and returns what is wrong, if anything.
fn problem(seed: u64, count: &mut Count) -> Option<String> {
    let r = &mut Random::new(seed);
    let world = random_scene(r);
    let mut run = Run::new(world, 10_f64.powf(r.between(-4.0, -2.0)));
    run.settings.projection = r.chance(0.9);
    for step in 0..30 + r.below(71) {
        let before = run.momentum().0;
        let convergence = run.step();
        count.steps += 1;
        count.iterations += convergence.iterations;
        count.unconverged += usize::from(!convergence.converged);
        if !finite(&run.state) {
            return Some(format!("step {step}: not finite"));
        }
        let skew = |p: &Pose| (p.rotation.transpose() * p.rotation - Mat3::identity()).norm();
        if run.state.poses.iter().map(skew).fold(0.0, f64::max) > 1e-9 {
            return Some(format!("step {step}: a rotation is none"));
        }
        let forces = run.forces();
        let contacts = forces.contacts.iter().all(|c| c.force.iter().all(|x| x.is_finite()));
        if !(contacts && forces.efforts.iter().flatten().all(|x| x.is_finite())) {
            return Some(format!("step {step}: forces are not finite"));
        }
        if convergence.residual > 1e-6 && run.findings.as_slice().is_empty() {
            return Some(format!("step {step}: rows contradict each other, and no finding says so: {convergence:?}"));
        }
        if let (true, Some(share)) = (convergence.converged, newton(before, &run)) {
            count.unbalanced = count.unbalanced.max(share);
            // 1e6 ε of what a solve exchanges, and the solver's 1e-10.
            if share > 1e-8 {
                return Some(format!("step {step}: momentum off by {share:e}"));
            }
        }
    }
    None
}

/// A quarter of the scenes, because four tests run side by side. A quarter has 100 scenes, or 250 if
/// `AMBULO_SCENES=all` is set, as by `cargo xtask check --full`.
fn random_scenes_stay_finite_and_in_balance(quarter: u64) {
    let all = std::env::var("AMBULO_SCENES").is_ok_and(|which| which == "all");
    let seeds = 250 * quarter..250 * quarter + if all { 250 } else { 100 };
    let mut count = Count::default();
    let mut problems = Vec::new();
    for seed in seeds {
        match catch_unwind(AssertUnwindSafe(|| problem(seed, &mut count))) {
            Ok(None) => {}
            Ok(Some(text)) => problems.push(format!("seed {seed}: {text}")),
            Err(_) => problems.push(format!("seed {seed}: panic")),
        }
    }
    println!(
        "{} steps, {} of them not converged, {:.2} solves a step, momentum off by {:e}",
        count.steps,
        count.unconverged,
        count.iterations as f64 / count.steps as f64,
        count.unbalanced
    );
    assert!(problems.is_empty(), "{} scenes:\n{}", problems.len(), problems.join("\n"));
}

#[test]
fn the_first_quarter_of_random_scenes_stays_finite_and_in_balance() {
    random_scenes_stay_finite_and_in_balance(0);
}

#[test]
fn the_second_quarter_of_random_scenes_stays_finite_and_in_balance() {
    random_scenes_stay_finite_and_in_balance(1);
}

#[test]
fn the_third_quarter_of_random_scenes_stays_finite_and_in_balance() {
    random_scenes_stay_finite_and_in_balance(2);
}

#[test]
fn the_fourth_quarter_of_random_scenes_stays_finite_and_in_balance() {
    random_scenes_stay_finite_and_in_balance(3);
}

// ---- drives that cannot be obeyed ----

/// Simulates and checks that everything is finite and forces are below `most` [N, N.m]; returns the messages.
fn endured(world: World, seconds: f64, most: f64) -> (Run, Vec<String>) {
    let mut run = Run::new(world, 1e-3);
    run.watch(seconds, |run| {
        assert!(finite(&run.state), "not finite at {} s", run.state.time_s);
        let forces = run.forces();
        let largest = forces.efforts.iter().flatten().copied().chain(forces.contacts.iter().map(|c| c.force.norm()));
        let largest = largest.fold(0.0, |m: f64, x| m.max(x.abs()));
        assert!(largest <= most, "a force of {largest} at {} s", run.state.time_s);
        let farthest = run.state.poses.iter().map(|p| p.translation.norm()).fold(0.0, f64::max);
        assert!(farthest < 10.0, "{farthest} m away at {} s", run.state.time_s);
    });
    let messages = run.findings.as_slice().iter().map(|f| f.message.clone()).collect();
    (run, messages)
}

/// Three bars of 0.4 m over pivots 0.5 m apart, the crank driven to where coupler and rocker do not reach.
fn jammed_four_bar(max: Option<f64>) -> World {
    let mut world = empty();
    // Crank straight up: B = (0, 0.4); D = (0.5, 0); C where both bars of 0.4 m meet.
    let (b, d) = (v(0.0, 0.4, 0.0), v(0.5, 0.0, 0.0));
    let half = (b - d).norm() / 2.0;
    let across = v(0.4, 0.5, 0.0).normalize();
    let c = (b + d) / 2.0 + across * (0.4_f64 * 0.4 - half * half).sqrt();
    for (from, to) in [(O, b), (b, c), (d, c)] {
        let angle = f64::atan2(to.y - from.y, to.x - from.x);
        add_body(&mut world, 1.0, [0.01; 3], turned(angle, (from + to) / 2.0));
    }
    let end = v(0.2, 0.0, 0.0);
    let crank = add_hinge(&mut world, 0, None, O, -end);
    add_hinge(&mut world, 1, Some(0), end, -end);
    add_hinge(&mut world, 2, None, d, -end);
    add_closure(&mut world, JointKind::Revolute, 1, Some(2), [Pose::at(end), Pose::at(end)]);
    // Towards straight left: B is then 0.9 m from D, and the bars reach 0.8 m.
    let half_turn = std::f64::consts::PI;
    drive(&mut world, crank, 0, Signal::Stops(vec![(0.0, half_turn / 2.0), (1.0, half_turn)]));
    world.joints[crank].coordinates[0].drive.as_mut().unwrap().max = max;
    world
}

#[test]
fn a_driven_four_bar_that_cannot_close_gives_way_and_says_so() {
    for max in [Some(50.0), None] {
        // Without a separate limit a drive gives way where rows contradict each other, not before. In the last step
        // before, the elbow is at δ = √(2 h ω) = 0.08 rad from straight and must turn at ω/δ = 35 rad/s at once: 35 ·
        // 0.05 N.m.s in 1 ms, 1/δ² of it in the bars: 3e5 N.
        let (mut run, messages) = endured(jammed_four_bar(max), 1.0, max.map_or(1e6, |m| m * 1.001));
        println!("{max:?}: {messages:?}");
        assert!(messages.iter().any(|m| m.contains("`joint 0` (angle)")), "{messages:?}");
        // The bars reach 0.8 m: where |B - D| = 0.8 the crank can go no farther; there the elbow swings to and fro.
        let stretched = f64::acos((0.16 + 0.25 - 0.64) / 0.4);
        let mut farthest = f64::NEG_INFINITY;
        run.watch(1.5, |run| farthest = farthest.max(run.q(0, 0)));
        let error = largest_joint_error(&run.world, &run.state);
        println!("crank up to {farthest} rad of {stretched}, joint error {error:e} m");
        // Without a limit the drive is left a thousand weights, and tears the loop open.
        assert!(max.is_none() || (farthest - stretched).abs() < 1e-4 && error < 1e-8);
    }
    let mut feasible = jammed_four_bar(Some(50.0));
    drive(&mut feasible, 0, 0, Signal::Stops(vec![(0.0, std::f64::consts::FRAC_PI_2), (1.0, 2.0)]));
    let (_, messages) = endured(feasible, 1.5, 100.0);
    assert!(messages.is_empty(), "{messages:?}");
}

/// An arm of 0.6 m, driven to turn through a wall 0.5 m in front of it.
fn arm_at_wall(max: Option<f64>) -> World {
    let mut world = of_rigid(0.3, 0.0);
    add_floor(&mut world, turned(std::f64::consts::FRAC_PI_2, v(0.5, 0.0, 0.0)));
    let arm = add_box(&mut world, 2.0, v(0.03, 0.3, 0.03), Pose::at(v(0.0, -0.3, 0.0)));
    let joint = add_hinge(&mut world, arm, None, O, v(0.0, 0.3, 0.0));
    drive(&mut world, joint, 0, Signal::Stops(vec![(0.0, 0.0), (1.0, 1.5)]));
    world.joints[joint].coordinates[0].drive.as_mut().unwrap().max = max;
    world
}

#[test]
fn an_arm_driven_into_a_wall_gives_way_and_says_so() {
    for max in [Some(40.0), None] {
        // On a contact 0.4 m from the hinge the drive leans with its effort over the arm, and the impact with more.
        let (run, messages) = endured(arm_at_wall(max), 1.5, 1e6);
        println!("{max:?}: {messages:?}");
        assert!(messages.iter().any(|m| m.contains("joint 0") || m.contains("the contact of")), "{messages:?}");
        let tip = [-0.03, 0.03].map(|x| run.state.poses[0].place(v(x, -0.3, 0.03)).x);
        println!("tip at {tip:?}, efforts {:?}, contacts {:?}", run.forces().efforts, run.forces().contacts.len());
        assert!(tip.iter().all(|x| *x < 0.5 + 1e-3), "{tip:?}");
        assert!((run.forces().efforts[0][0].abs()) <= max.unwrap_or(1001.0 * 2.0 * G) * 1.001);
    }
    let mut free = arm_at_wall(Some(40.0));
    free.surfaces.clear();
    let (run, messages) = endured(free, 1.5, 100.0);
    assert!(messages.is_empty() && (run.q(0, 0) - 1.5).abs() < 1e-9, "without a wall it arrives: {messages:?}");
}
