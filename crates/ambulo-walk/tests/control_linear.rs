//! Impedances of joints, and the derivatives of time steps of a figure.

use ambulo_walk::contact::HuntCrossley;
use ambulo_walk::dynamics::{Workspace, inverse_frame};
use ambulo_walk::engine::StepSettings;
use ambulo_walk::findings::Findings;
use ambulo_walk::gait::{Gait, Walk};
use ambulo_walk::internals::{
    Costs, CyclePlan, DIFFERENCES, FigureWorld, Impedance, PlannedStep, Root, StepMap, mirror, with_impedances,
};
use ambulo_walk::kinematics::Posture;
use ambulo_walk::model::anthropometry::{Build, SegmentTable};
use ambulo_walk::model::full_body::full_body;
use ambulo_walk::optimal::{OptimalWalk, StrengthCurve};
use nalgebra::DMatrix;

/// The strength of a giant.
fn strong() -> StrengthCurve {
    StrengthCurve { angles: vec![0.0], positive: vec![1e3], negative: vec![1e3], hill: None }
}

#[test]
fn maps_of_the_second_half_of_a_cycle_are_mirror_images_of_those_of_the_first() {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
    let human = full_body(&build).unwrap();
    let (count, mirror) = (human.model.coordinates().len(), mirror(&human.model));
    let root = Root::of(&human.model);
    let first: Vec<f64> = (0..count).map(|k| 0.2 * (1.0 + 1.7 * k as f64).sin()).collect();
    let second: Vec<f64> = mirror.iter().map(|(c, sign)| sign * first[*c]).collect();
    let on_the_ground = |q: &[f64]| {
        let mut q = q.to_vec();
        q[root.up] = 0.9;
        q
    };
    let step = |q: &[f64]| PlannedStep {
        state: [on_the_ground(q), q.to_vec()],
        target: [on_the_ground(q), q.to_vec()],
        torques: q.iter().map(|q| 50.0 * q).collect(),
    };
    let steps = vec![step(&first), step(&second)];
    let plan = CyclePlan { steps, strikes: [0; 2], root: root.clone(), mirror: Some(mirror.clone()) };
    let impedance = |stiffness: f64| Impedance { stiffness, damping: 5.0, strength: strong() };
    let joints = plan.joints();
    let impedances: Vec<Impedance> =
        (0..count).map(|c| impedance(if joints.contains(&c) { 50.0 } else { 0.0 })).collect();
    let mut figure = FigureWorld::new(&human, HuntCrossley::SOFT_SHOES, StepSettings::default()).unwrap();
    let image = figure.maps(&plan, &impedances).unwrap().remove(1);
    let found = figure.map(&plan, &impedances, 1, DIFFERENCES).unwrap();
    // The difference of a coordinate that changes its sign is one to the other side in the image.
    let states: Vec<usize> = (0..count).filter(|c| *c != root.forward).chain(0..count).collect();
    for (a, b, columns) in
        [(&found.by_state, &image.by_state, &states), (&found.by_input, &image.by_input, &plan.joints())]
    {
        for (side, most) in [(1.0, 1e-6), (-1.0, 1e-3)] {
            let of_side = (0..columns.len()).filter(|k| mirror[columns[*k]].1 * side > 0.0);
            let apart = of_side.map(|k| (a.column(k) - b.column(k)).amax() / a.amax()).fold(0.0, f64::max);
            println!("side {side}: {apart:.1e}");
            assert!(apart < most, "side {side}: {apart}");
        }
    }
}

/// Plan of a man's walk in three dimensions, impedances of his joints, and himself.
fn walker(gait: &str) -> (CyclePlan, Vec<Impedance>, FigureWorld) {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
    let leg_m = full_body(&build).unwrap().dimensions.leg_length;
    let walk = Walk::new(&Gait::named(gait).unwrap(), leg_m, &mut Findings::default()).unwrap();
    let found = OptimalWalk::find(&build, &walk).unwrap();
    let (human, settings) = (found.figure(), StepSettings::default());
    let plan = CyclePlan::new(&human, &found.solution, settings.step_s).unwrap();
    let joints = plan.joints();
    let impedance = |c: usize| {
        let stiffness = if joints.contains(&c) { 200.0 } else { 0.0 };
        Impedance { stiffness, damping: 0.1 * stiffness, strength: strong() }
    };
    let impedances = (0..human.model.coordinates().len()).map(impedance).collect();
    let figure = FigureWorld::new(&human, found.solution.problem().shoes, settings).unwrap();
    (plan, impedances, figure)
}

/// Along a walk, forward differences agree with central ones of ten times their size, except in single time steps in
/// which a sphere of a foot begins to carry load: there a derivative changes within the difference.
#[test]
fn forward_differences_agree_with_central_ones_along_a_walk() {
    let (plan, impedances, mut figure) = walker("free");
    let mut map =
        |step: usize, factor: f64| figure.map(&plan, &impedances, step, DIFFERENCES.map(|size| factor * size)).unwrap();
    let mut apart: Vec<f64> = Vec::new();
    for step in (0..plan.steps.len() / 2).step_by(23) {
        let [forward, ahead, back] = [1.0, 10.0, -10.0].map(|factor| map(step, factor));
        for (forward, ahead, back) in
            [(&forward.by_state, &ahead.by_state, &back.by_state), (&forward.by_input, &ahead.by_input, &back.by_input)]
        {
            let central = 0.5 * (ahead + back);
            apart.push((forward - &central).amax() / central.amax());
        }
    }
    apart.sort_by(f64::total_cmp);
    let [median, most] = [apart[apart.len() / 2], apart[apart.len() - 1]];
    println!("{} maps: apart by {median:.1e} (median), {most:.1e} (most)", apart.len());
    assert!(median < 1e-5 && most < 2e-4, "{median} {most}");
    assert!(median > 0.0, "the differences are the same");
}

/// Gains from maps that are linear between computed ones are near the gains from maps that are all computed. A straight
/// line over each sixteen time steps, without a look at the middle, is no substitute.
#[test]
fn maps_that_are_not_computed_are_near_those_that_are() {
    let (mut plan, impedances, mut figure) = walker("fast");
    // A third of a cycle is enough: in it a foot strikes, and the other one leaves the ground.
    plan.steps.truncate(plan.steps.len() / 3);
    plan.mirror = None;
    let maps = figure.maps(&plan, &impedances).unwrap();
    let all: Vec<StepMap> =
        (0..plan.steps.len()).map(|step| figure.map(&plan, &impedances, step, DIFFERENCES).unwrap()).collect();
    let computed = maps.iter().zip(&all).filter(|(a, b)| a.by_state == b.by_state).count();
    let straight = |k: usize| {
        let from = k - k % 16;
        let to = (from + 16).min(all.len() - 1);
        all[from].mixed(&all[to], (k - from) as f64 / (to - from).max(1) as f64)
    };
    let coarse: Vec<StepMap> = (0..all.len()).map(straight).collect();
    let states = all[0].by_state.nrows();
    let diagonal = |count: usize, cost: f64| DMatrix::from_diagonal_element(count, count, cost);
    let costs = Costs { state: diagonal(states, 1.0), input: diagonal(plan.joints().len(), 1e-4) };
    let gains = |maps: &[StepMap]| costs.gains(maps, &mut diagonal(states, 1.0)).unwrap();
    let exact = gains(&all);
    let apart = |maps: &[StepMap]| {
        let of_step = |(gain, exact): (&DMatrix<f64>, &DMatrix<f64>)| (gain - exact).norm() / exact.norm();
        let mut apart: Vec<f64> = gains(maps).iter().zip(&exact).map(of_step).collect();
        apart.sort_by(f64::total_cmp);
        [apart[apart.len() / 2], apart[apart.len() - 1]]
    };
    let [own, coarse] = [&maps, &coarse].map(|maps| apart(maps));
    println!("{computed} of {} computed; gains apart by {own:?} (median, most), {coarse:?} if linear", all.len());
    assert!((10..maps.len() / 2).contains(&computed), "{computed}");
    assert!(own[0] < 1e-3 && own[1] < 0.02, "{own:?}");
    assert!(coarse[0] > 3e-3 && coarse[1] > 0.1, "{coarse:?}");
}

/// In the air, a torque e of one joint changes the rates by Δ with (M + h d + h² k) Δ = h e, and M Δ is what inverse
/// dynamics says.
#[test]
fn derivatives_by_torque_agree_with_inverse_dynamics() {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
    let human = full_body(&build).unwrap();
    let count = human.model.coordinates().len();
    let root = Root::of(&human.model);
    let wave = |k: usize, size: f64| size * (1.0 + 1.7 * k as f64).sin();
    let mut q: Vec<f64> = (0..count).map(|k| wave(k, 0.3)).collect();
    q[root.up] = 3.0;
    // At rest: rates after a step are those of its posture at the end.
    let qd = vec![0.0; count];
    let step =
        PlannedStep { state: [q.clone(), qd.clone()], target: [q.clone(), qd.clone()], torques: vec![0.0; count] };
    let plan = CyclePlan { steps: vec![step], strikes: [0; 2], root, mirror: None };
    let impedance = |stiffness: f64| Impedance { stiffness, damping: 0.1 * stiffness, strength: strong() };
    let impedances: Vec<Impedance> =
        (0..count).map(|c| impedance(if plan.joints().contains(&c) { 50.0 + c as f64 } else { 0.0 })).collect();
    let settings = StepSettings::default();
    let mut figure = FigureWorld::new(&human, HuntCrossley::SOFT_SHOES, settings).unwrap();
    let map = figure.maps(&plan, &impedances).unwrap().remove(0);
    let mut workspace = Workspace::new(&human.model);
    let mut torques = |qdd: &[f64]| {
        let still = vec![0.0; count];
        inverse_frame(&mut workspace, Posture { q: &q, qd: &still, qdd }, &[]).generalized().to_vec()
    };
    let weight = torques(&vec![0.0; count]);
    let h = settings.step_s;
    for (column, joint) in plan.joints().into_iter().enumerate() {
        let change: Vec<f64> = (0..count).map(|c| map.by_input[(count - 1 + c, column)]).collect();
        let inertial = torques(&change);
        for c in 0..count {
            let yields = (h * impedances[c].damping + h * h * impedances[c].stiffness) * change[c];
            let expected = if c == joint { h } else { 0.0 };
            let found = inertial[c] - weight[c] + yields;
            assert!((found - expected).abs() < 1e-6 * h.max(1e-3), "{joint}, {c}: {found} instead of {expected}");
        }
    }
}

/// In the air and at rest nothing moves the joints, whatever their impedance, so both maps belong to the same torques.
#[test]
fn maps_of_another_impedance_follow_from_those_of_one() {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
    let human = build.human().unwrap();
    let count = human.model.coordinates().len();
    let root = Root::of(&human.model);
    let mut q: Vec<f64> = (0..count).map(|k| 0.3 * (1.0 + 1.7 * k as f64).sin()).collect();
    q[root.up] = 3.0;
    let mut figure = FigureWorld::new(&human, HuntCrossley::SOFT_SHOES, StepSettings::default()).unwrap();
    let state = [q, vec![0.0; count]];
    let step = PlannedStep { state: state.clone(), target: state, torques: vec![0.0; count] };
    let plan = CyclePlan { steps: vec![step], strikes: [0; 2], root, mirror: None };
    let with = |stiffness: f64, damping: f64| -> Vec<Impedance> {
        let joints = plan.joints();
        let driven = |c: usize| if joints.contains(&c) { 1.0 } else { 0.0 };
        let of = |c: usize| Impedance {
            stiffness: driven(c) * (stiffness + c as f64),
            damping: driven(c) * damping,
            strength: strong(),
        };
        (0..count).map(of).collect()
    };
    let [soft, stiff] = [with(20.0, 1.0), with(250.0, 30.0)];
    let own = figure.maps(&plan, &soft).unwrap();
    let direct = figure.maps(&plan, &stiff).unwrap().remove(0);
    let found = with_impedances(&own, &plan, [&soft, &stiff], StepSettings::default().step_s).unwrap().remove(0);
    for (name, found, direct, other) in [
        ("state", found.by_state, direct.by_state, &own[0].by_state),
        ("input", found.by_input, direct.by_input, &own[0].by_input),
    ] {
        let (apart, change) = ((found - &direct).amax(), (other - &direct).amax());
        println!("{name}: {apart:.1e} of a change of {change:.1e}");
        assert!(apart < 1e-5 * change, "{name}: {apart} of a change of {change}");
    }
}
