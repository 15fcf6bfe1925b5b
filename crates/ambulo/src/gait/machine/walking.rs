//! The machine that walks: the global cycle, with machines for the joints side by side below it.
//!
//! ```text
//! walk                      double and single support; output: phase of the right foot [cycles, 0 to 1]
//! ├ right leg, left leg     stance, swing; output: direction of the foot against the pelvis, hip - knee + ankle [rad]
//! │ └ hip, knee, ankle      sub-cycles; output: the joint's angle [rad]
//! ├ pelvis, trunk           one state; output: anterior tilt, forward lean [rad]
//! └ shoulders, elbows       forward and backward swing, flexion and extension; output: flexion [rad]
//! ```
//!
//! Transitions test the clock alone: a state is left when the phase is outside its window, and windows are read at the speed of
//! the moment, so a change of speed brings all machines into step by itself. In its state a joint's machine evaluates the
//! polynomial of that sub-cycle, on the same curves that [`Walk::at`] reads: both give the same bits, at any rate of steps
//! (tests/gait_machine.rs).

use super::definition::{Machine, Span, State, Transition};
use super::running::{Children, Running, Sight};
use crate::gait::arms::ArmCurves;
use crate::gait::cyclic_curve::CyclicCurve;
use crate::gait::jet::Jet;
use crate::gait::joint::Joint;
use crate::gait::speed_plan::Clock;
use crate::gait::sub_cycle::SubCycle;
use crate::gait::walk::{LegAngles, Phases, Walk, WalkPosture};
use crate::model::Side;
use std::sync::Arc;

/// The walking machine of a walk.
#[must_use]
pub fn walking_machine(walk: &Walk) -> Machine {
    let walk = Arc::new(walk.clone());
    let sides = Side::BOTH;
    let legs = sides.map(|side| leg(&walk, side));
    let arms = sides.into_iter().flat_map(|side| [shoulder(&walk, side), elbow(&walk, side)]);
    let trunk = [pelvis(&walk), lean(&walk)];
    global(&walk).with_children(legs).with_children(trunk).with_children(arms)
}

/// Phase of a side's foot.
fn phase_of(side: Side, clock: &Clock) -> Jet {
    match side {
        Side::Right => clock.phase,
        Side::Left => clock.phase + 0.5,
    }
}

/// Windows of the global cycle in cycles of the right foot.
fn support_windows(foot_off: f64) -> [f64; 5] {
    [0.0, foot_off - 0.5, 0.5, foot_off, 1.0]
}

fn global(walk: &Arc<Walk>) -> Machine {
    const NAMES: [&str; 4] = [
        "double support, right foot ahead",
        "single support on the right, left swing",
        "double support, left foot ahead",
        "single support on the left, right swing",
    ];
    const EVENTS: [&str; 4] = ["left foot off", "left contact", "right foot off", "right contact"];
    let windows = support_windows(walk.foot_off(&walk.clock(0.0)));
    let state = |k: usize| State {
        name: NAMES[k].into(),
        span: Some(Span { window: [windows[k], windows[k + 1]], bounds: None }),
    };
    let way = |k: usize| {
        let walk = Arc::clone(walk);
        Transition::new(k, (k + 1) % 4, EVENTS[k], move |sight: &Sight<'_>| {
            let windows = support_windows(walk.foot_off(sight.clock));
            let [phase, _] = walk.phases(sight.clock).cycle;
            !(windows[k]..windows[k + 1]).contains(&phase)
        })
    };
    let phase = |_: usize, sight: &Sight<'_>, _: &Children<'_>| sight.clock.phase - sight.clock.phase.value.floor();
    Machine::new("walk", (0..4).map(state).collect(), phase).with_transitions((0..4).map(way))
}

fn leg(walk: &Arc<Walk>, side: Side) -> Machine {
    let off = walk.foot_off(&walk.clock(0.0));
    let state = |name: &str, window: [f64; 2]| State { name: name.into(), span: Some(Span { window, bounds: None }) };
    let states = vec![state("stance", [0.0, off]), state("swing", [off, 1.0])];
    let way = |from: usize, when: &str| {
        let walk = Arc::clone(walk);
        Transition::new(from, 1 - from, when, move |sight: &Sight<'_>| {
            let stands = walk.phases(sight.clock).stance[side_index(side)];
            stands != (from == 0)
        })
    };
    let names = Joint::ALL.map(|joint| joint_name(side, joint));
    let foot = move |_: usize, _: &Sight<'_>, children: &Children<'_>| {
        let [hip, knee, ankle] = [0, 1, 2].map(|i| children.output(&names[i]));
        hip - knee + ankle
    };
    Machine::new(&format!("{side} leg"), states, foot)
        .with_transitions([way(0, "foot off"), way(1, "contact")])
        .with_children(Joint::ALL.map(|joint| joint_machine(walk, side, joint)))
}

fn side_index(side: Side) -> usize {
    match side {
        Side::Right => 0,
        Side::Left => 1,
    }
}

fn joint_name(side: Side, joint: Joint) -> String {
    format!("{side} {}", joint.name())
}

fn joint_machine(walk: &Arc<Walk>, side: Side, joint: Joint) -> Machine {
    let offset = {
        let walk = Arc::clone(walk);
        move |speed: Jet| if joint == Joint::Hip { walk.hip_offset(speed) } else { Jet::ZERO }
    };
    curve_machine(walk, &joint_name(side, joint), side, walk.legs().of(joint), offset)
}

/// A machine whose states are the sub-cycles of a curve; `offset` is taken from the curve.
fn curve_machine(
    walk: &Arc<Walk>,
    name: &str,
    side: Side,
    curve: &CyclicCurve,
    offset: impl Fn(Jet) -> Jet + Send + Sync + 'static,
) -> Machine {
    let curve = Arc::new(curve.clone());
    let sub_cycles = Arc::new(SubCycle::of(&curve));
    let speed = walk.curve_speed(&walk.clock(0.0));
    let taken = offset(speed).value;
    let state = |part: &SubCycle| {
        let bounds = part.bounds(&curve, speed.value).map(|angle| angle - taken);
        let span = Span { window: part.window(&curve, speed.value), bounds: Some(bounds) };
        State { name: part.name.clone(), span: Some(span) }
    };
    let count = sub_cycles.len();
    let way = |k: usize| {
        let (walk, curve, parts) = (Arc::clone(walk), Arc::clone(&curve), Arc::clone(&sub_cycles));
        let end = parts[k].to % curve.knots().len();
        let when = curve.knots()[end].name.clone();
        Transition::new(k, (k + 1) % count, when, move |sight: &Sight<'_>| {
            let speed = walk.curve_speed(sight.clock).value;
            let segment = curve.segment_at(phase_of(side, sight.clock).value, speed);
            !parts[k].has_segment(segment, curve.knots().len())
        })
    };
    let states = sub_cycles.iter().map(state).collect();
    let ways: Vec<Transition> = if count > 1 { (0..count).map(way).collect() } else { Vec::new() };
    let activity = {
        let (walk, curve, parts) = (Arc::clone(walk), Arc::clone(&curve), Arc::clone(&sub_cycles));
        move |state: usize, sight: &Sight<'_>, _: &Children<'_>| {
            let (phase, speed) = (phase_of(side, sight.clock), walk.curve_speed(sight.clock));
            let segment = parts[state].segment(&curve, phase.value, speed.value);
            curve.on_segment(segment, phase, speed) - offset(speed)
        }
    };
    Machine::new(name, states, activity).with_transitions(ways)
}

fn pelvis(walk: &Arc<Walk>) -> Machine {
    let walk = Arc::clone(walk);
    Machine::new("pelvis", vec![State::named("tilting")], move |_, sight, _| {
        walk.pelvis_tilt(sight.clock.phase, walk.curve_speed(sight.clock))
    })
}

fn lean(walk: &Arc<Walk>) -> Machine {
    let walk = Arc::clone(walk);
    Machine::new("trunk", vec![State::named("leaning")], move |_, sight, _| {
        walk.trunk_lean(sight.clock.phase, walk.curve_speed(sight.clock))
    })
}

fn shoulder(walk: &Arc<Walk>, side: Side) -> Machine {
    let speed = walk.curve_speed(&walk.clock(0.0));
    let angle = |phase: f64| ArmCurves::shoulder(Jet::constant(phase), speed).value;
    let state = |name: &str, window: [f64; 2]| {
        let span = Span { window, bounds: Some(window.map(angle)) };
        State { name: name.into(), span: Some(span) }
    };
    let states = vec![state("forward swing", [0.0, 0.5]), state("backward swing", [0.5, 1.0])];
    let way = |from: usize, when: &str| {
        Transition::new(from, 1 - from, when, move |sight: &Sight<'_>| {
            let phase = phase_of(side, sight.clock).value;
            (phase - phase.floor() < 0.5) != (from == 0)
        })
    };
    let walk = Arc::clone(walk);
    Machine::new(&format!("{side} shoulder"), states, move |_, sight, _| {
        ArmCurves::shoulder(phase_of(side, sight.clock), walk.curve_speed(sight.clock))
    })
    .with_transitions([way(0, "the other foot's contact"), way(1, "contact")])
}

fn elbow(walk: &Arc<Walk>, side: Side) -> Machine {
    curve_machine(walk, &format!("{side} elbow"), side, walk.arms().elbow(), |_| Jet::ZERO)
}

/// A walk driven by its machine.
#[derive(Debug)]
pub struct WalkMachine {
    walk: Walk,
    running: Running,
    /// Numbers of the machines whose outputs make a posture.
    legs: [usize; 2],
    joints: [[usize; 3]; 2],
    trunk: [usize; 2],
    arms: [[usize; 2]; 2],
}

impl WalkMachine {
    /// The machine of a walk, before its first step.
    #[must_use]
    pub fn new(walk: &Walk) -> WalkMachine {
        WalkMachine::with(walk, walking_machine(walk))
    }

    /// The same, with the machine's children in another order.
    #[must_use]
    pub fn ordered(walk: &Walk, key: &impl Fn(&str) -> u64) -> WalkMachine {
        WalkMachine::with(walk, walking_machine(walk).with_children_ordered(key))
    }

    fn with(walk: &Walk, machine: Machine) -> WalkMachine {
        let running = Running::new(machine);
        // Every name is one that `walking_machine` gave.
        let number = |name: &str| running.number(name).unwrap_or(0);
        WalkMachine {
            walk: walk.clone(),
            legs: Side::BOTH.map(|side| number(&format!("{side} leg"))),
            joints: Side::BOTH.map(|side| Joint::ALL.map(|joint| number(&joint_name(side, joint)))),
            trunk: ["pelvis", "trunk"].map(number),
            arms: Side::BOTH.map(|side| ["shoulder", "elbow"].map(|part| number(&format!("{side} {part}")))),
            running,
        }
    }

    /// Runs all machines once at a time [s], and gives the posture of their outputs.
    pub fn step(&mut self, time_s: f64) -> WalkPosture {
        let clock = self.walk.clock(time_s);
        self.running.step(&clock);
        let output = |number: usize| self.running.output(number);
        let leg =
            |[hip, knee, ankle]: [usize; 3]| LegAngles { hip: output(hip), knee: output(knee), ankle: output(ankle) };
        WalkPosture {
            right: leg(self.joints[0]),
            left: leg(self.joints[1]),
            pelvis_tilt: output(self.trunk[0]),
            standing_tilt: self.walk.standing_tilt(),
            trunk_lean: output(self.trunk[1]),
            shoulders: self.arms.map(|arm| output(arm[0])),
            elbows: self.arms.map(|arm| output(arm[1])),
            phases: Phases { stance: self.legs.map(|leg| self.running.state(leg) == 0), ..self.walk.phases(&clock) },
        }
    }

    /// The machines with their states.
    #[must_use]
    pub fn running(&self) -> &Running {
        &self.running
    }
}
