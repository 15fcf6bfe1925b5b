//! Hierarchical concurrent state machines: snapshots, order of siblings, and the machine that walks.

use crate::common::random::Random;
use ambulo::findings::Findings;
use ambulo::gait::machine::{
    ChildOutputs, Machine, MachineInputs, RunningMachine, Sensed, State, Transition, WalkMachine, state_table,
};
use ambulo::gait::{Clock, Gait, Jet, PaceChange, Speed, Walk};
use ambulo::model::Side;

const LEG: f64 = 0.92;

fn walk(name: &str) -> Walk {
    let mut gait = Gait::named(name).unwrap();
    gait.pace_changes =
        vec![PaceChange { start_s: 2.0, duration_s: Some(1.5), speed: Some(0.8), ..PaceChange::default() }];
    Walk::new(&gait, LEG, &mut Findings::default()).unwrap()
}

/// Stands for 0.4 s, walks, stands from 3 s to 3.5 s, and walks on.
fn stop_and_go(name: &str) -> Walk {
    let mut gait = Gait::named(name).unwrap();
    gait.pace.speed = Some(Speed::MetersPerSecond(0.0));
    (gait.pace.step_length, gait.pace.step_frequency) = (None, None);
    let change = |start_s: f64, speed: f64| PaceChange {
        start_s,
        duration_s: Some(0.8),
        speed: Some(speed),
        ..PaceChange::default()
    };
    gait.pace_changes = vec![change(0.4, 1.3), change(2.2, 0.0), change(3.5, 1.0)];
    Walk::new(&gait, LEG, &mut Findings::default()).unwrap()
}

/// A key that puts names into another order for every seed.
pub(crate) fn shuffled(seed: u64) -> impl Fn(&str) -> u64 {
    move |name| {
        name.bytes().fold(seed, |sum, byte| (sum ^ u64::from(byte)).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(29))
    }
}

#[test]
fn stepped_at_any_rate_the_machine_gives_what_the_walk_gives() {
    for (name, walk) in Gait::NAMES.into_iter().flat_map(|name| [(name, walk(name)), (name, stop_and_go(name))]) {
        for step_s in [0.0007, 0.01, 1.0 / 30.0, 0.13, 0.41, 0.9, 2.7] {
            let mut machine = WalkMachine::new(&walk);
            for i in 0..(6.0 / step_s) as u32 {
                let t = step_s * f64::from(i);
                assert_eq!(machine.step(t), walk.at(t), "{name}, every {step_s} s, at {t} s");
            }
        }
    }
}

#[test]
fn stepped_at_random_times_too_even_backwards() {
    let walk = walk("fast");
    let mut machine = WalkMachine::new(&walk);
    let mut random = Random::new(5);
    for _ in 0..2000 {
        let t = random.between(-3.0, 8.0);
        assert_eq!(machine.step(t), walk.at(t), "at {t} s");
    }
}

#[test]
fn the_order_of_children_changes_no_bit() {
    let walk = walk("free");
    let mut plain = WalkMachine::new(&walk);
    let mut orders = std::collections::BTreeSet::new();
    let mut others: Vec<WalkMachine> = (0..20).map(|seed| WalkMachine::ordered(&walk, &shuffled(seed))).collect();
    for i in 0..300 {
        let t = 0.017 * f64::from(i);
        let expected = plain.step(t);
        for other in &mut others {
            // Equal jets of finite numbers that are no zeros of two signs have equal bits.
            assert_eq!(other.step(t), expected);
            let (a, b) = (plain.running(), other.running());
            for name in ["walk", "left leg", "right knee", "left ankle", "trunk", "right elbow"] {
                let [a, b] = [a, b].map(|running| running.state_name(running.number(name).unwrap()).to_owned());
                assert_eq!(a, b, "{name}");
            }
        }
    }
    for other in &others {
        let names = other.running().machine().children().iter().map(|child| child.name().to_owned());
        orders.insert(names.collect::<Vec<_>>());
    }
    assert!(orders.len() > 15, "{} orders", orders.len());
}

/// Two machines that always do what the other was doing, and a third that counts what it saw: side by side all at once.
/// Run one after the other on live values, both would end in the same state.
fn mirrors() -> Machine {
    let mirror = |name: &str, other: &'static str, start: [&str; 2]| {
        let states = start.map(State::named).to_vec();
        let transition = |from: usize| {
            let wanted = start[1 - from].to_owned();
            Transition::new(from, 1 - from, "the other was", move |inputs: &MachineInputs<'_>| {
                inputs.state(other) == Some(&wanted)
            })
        };
        Machine::new(name, states, |state, _, _| Jet::constant(state as f64))
            .with_transitions([transition(0), transition(1)])
    };
    let counter = Machine::new("counter", Vec::new(), |_, inputs, _| {
        inputs.output("counter").unwrap() * 10.0 + inputs.output("left").unwrap().value
    });
    let sum = |_: usize, _: &MachineInputs<'_>, children: &ChildOutputs<'_>| {
        children.output("left") + children.output("right") * 10.0 + children.output("counter") * 100.0
    };
    Machine::new("root", Vec::new(), sum).with_children([
        mirror("left", "right", ["high", "low"]),
        mirror("right", "left", ["low", "high"]),
        counter,
    ])
}

#[test]
fn siblings_see_the_step_before_and_nothing_of_this_one() {
    for seed in 0..6 {
        let mut running = RunningMachine::new(mirrors().with_children_ordered(&shuffled(seed)));
        let clock = Clock::default();
        let number = |name: &str| running.number(name).unwrap();
        let (left, right, root) = (number("left"), number("right"), number("root"));
        let mut expected_counter = 0.0;
        let (mut seen, mut states) = (0.0, [0, 0]);
        for step in 0..8 {
            running.step(&clock, &Sensed::default());
            // Both change at once, from opposite to opposite.
            states = [1 - states[0], 1 - states[1]];
            assert_eq!([running.state(left), running.state(right)], states, "seed {seed}, step {step}");
            expected_counter = 10.0 * expected_counter + seen;
            seen = states[0] as f64;
            let expected = states[0] as f64 + 10.0 * states[1] as f64 + 100.0 * expected_counter;
            assert_eq!(running.output(root), Jet::constant(expected), "seed {seed}, step {step}");
        }
        assert_ne!(running.state_name(left), running.state_name(right));
    }
}

#[test]
fn the_global_cycle_agrees_with_the_legs() {
    let walk = walk("slow");
    let mut machine = WalkMachine::new(&walk);
    let mut seen = std::collections::BTreeSet::new();
    for i in 0..700 {
        let posture = machine.step(0.01 * f64::from(i));
        let running = machine.running();
        let state = running.state_name(running.number("walk").unwrap()).to_owned();
        let expected = match Side::BOTH.map(|side| posture.phases.stance[side]) {
            [true, true] if posture.phases.cycle.right < 0.5 => "double support, right foot ahead",
            [true, true] => "double support, left foot ahead",
            [true, false] => "single support on the right, left swing",
            [false, true] => "single support on the left, right swing",
            [false, false] => "flight",
        };
        assert_eq!(state, expected);
        seen.insert(state);
    }
    assert_eq!(seen.len(), 4, "{seen:?}");
}

#[test]
fn the_global_cycle_stands_between_walks() {
    let mut machine = WalkMachine::new(&stop_and_go("free"));
    let mut order: Vec<String> = Vec::new();
    for i in 0..500 {
        machine.step(0.01 * f64::from(i));
        let running = machine.running();
        let state = running.state_name(running.number("walk").unwrap());
        if order.last().is_none_or(|last| last != state) {
            order.push(state.to_owned());
        }
    }
    assert_eq!(order.iter().filter(|state| *state == "standing").count(), 2, "{order:?}");
    // The right leg swings first.
    assert_eq!(order[0..2], ["standing", "single support on the left, right swing"]);
}

#[test]
fn a_leg_gives_the_direction_of_its_foot_from_its_children() {
    let walk = walk("free");
    let mut machine = WalkMachine::new(&walk);
    for i in 0..100 {
        let posture = machine.step(0.03 * f64::from(i));
        let running = machine.running();
        let foot = running.output(running.number("left leg").unwrap());
        assert_eq!(foot, posture.left.hip - posture.left.knee + posture.left.ankle);
    }
}

#[test]
fn the_table_of_states_shows_machines_windows_bounds_and_transitions() {
    let walk = Walk::new(&Gait::named("standard").unwrap(), LEG, &mut Findings::default()).unwrap();
    let table = state_table(&walk);
    let line =
        |name: &str| table.lines().find(|line| line.contains(name)).unwrap_or_else(|| panic!("{name}:\n{table}"));
    assert!(table.starts_with("standard, style 1997: 1.50 m/s on a leg of 0.92 m"), "{table}");
    let cells: Vec<&str> = line("right knee").split_whitespace().collect();
    // E3 of the knee: from the stance peak at 12.4 % and 18.9° to the minimum at 39.4 % and 4.2°.
    assert_eq!(cells, ["right", "knee", "E3", "12.4", "39.4", "18.9", "4.2", "F,", "stance", "minimum"]);
    assert!(line("left foot off").contains("double support, right foot ahead"));
    assert_eq!(table.matches("right ").count(), table.matches("left ").count(), "sides differ:\n{table}");
}
