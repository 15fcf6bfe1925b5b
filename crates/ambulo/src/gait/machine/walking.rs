//! The machine of a walk: the global cycle, with concurrent machines for the joints below it.
//!
//! ```text
//! walk                      double and single support; output: phase of the right foot [cycles, 0 to 1]
//! ├ right leg, left leg     stance, swing; output: angle of the foot relative to the pelvis, hip - knee + ankle [rad]
//! │ └ hip, knee, ankle      sub-cycles; output: joint angle [rad]
//! ├ pelvis, trunk           one state; output: anterior tilt, forward lean [rad]
//! └ shoulders, elbows       forward and backward swing, flexion and extension; output: flexion [rad]
//! ```
//!
//! Transitions test only the clock: a machine leaves a state when the phase is outside the window of the state. Windows are evaluated at
//! the current speed, so all machines stay synchronised when the speed changes. The machine of a joint evaluates the polynomial of its
//! sub-cycle on the same curves as [`Walk::at`]: both give the same bits at any step rate (tests/gait_machine.rs).

use super::definition::{ChildOutputs, Machine, MachineInputs, Span, State, Transition};
use super::running_machine::RunningMachine;
use crate::gait::arms::ArmCurves;
use crate::gait::cyclic_curve::CyclicCurve;
use crate::gait::jet::Jet;
use crate::gait::joint::LegJoint;
use crate::gait::pace_plan::Clock;
use crate::gait::sub_cycle::SubCycle;
use crate::gait::walk::{LegAngles, Phases, Walk, WalkPosture};
use crate::model::{BySide, Side};
use std::sync::Arc;

/// The state machine of a walk.
#[must_use]
pub fn walking_machine(walk: &Walk) -> Machine {
    let walk = Arc::new(walk.clone());
    let sides = Side::BOTH;
    let legs = sides.map(|side| leg(&walk, side));
    let arms = sides.into_iter().flat_map(|side| [shoulder(&walk, side), elbow(&walk, side)]);
    let trunk = [pelvis(&walk), lean(&walk)];
    global(&walk).with_children(legs).with_children(trunk).with_children(arms)
}

/// Phase of the foot of a side.
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
    const STANDING: usize = 4;
    let windows = support_windows(walk.foot_off(&walk.first_clock()));
    let state = |k: usize| State {
        name: NAMES[k].into(),
        span: Some(Span { window: [windows[k], windows[k + 1]], bounds: None }),
    };
    let in_window = |k: usize| {
        let walk = Arc::clone(walk);
        move |clock: &Clock| {
            let windows = support_windows(walk.foot_off(clock));
            (windows[k]..windows[k + 1]).contains(&walk.phases(clock).cycle.right)
        }
    };
    let next = |k: usize| {
        let inside = in_window(k);
        Transition::new(k, (k + 1) % 4, EVENTS[k], move |inputs: &MachineInputs<'_>| !inside(inputs.clock))
    };
    let (mut states, mut transitions) = ((0..4).map(state).collect::<Vec<_>>(), Vec::new());
    if !walk.is_steady() {
        states.push(State::named("standing"));
        let halt =
            |k: usize| Transition::new(k, STANDING, "speed 0", |inputs: &MachineInputs<'_>| inputs.clock.stands());
        let begin = |k: usize| {
            let inside = in_window(k);
            Transition::new(STANDING, k, "a speed above 0", move |inputs: &MachineInputs<'_>| {
                !inputs.clock.stands() && inside(inputs.clock)
            })
        };
        transitions.extend((0..4).map(halt).chain((0..4).map(begin)));
    }
    transitions.extend((0..4).map(next));
    let phase = |_: usize, inputs: &MachineInputs<'_>, _: &ChildOutputs<'_>| {
        inputs.clock.phase - inputs.clock.phase.value.floor()
    };
    Machine::new("walk", states, phase).with_transitions(transitions)
}

fn leg(walk: &Arc<Walk>, side: Side) -> Machine {
    let off = walk.foot_off(&walk.first_clock());
    let state = |name: &str, window: [f64; 2]| State { name: name.into(), span: Some(Span { window, bounds: None }) };
    let states = vec![state("stance", [0.0, off]), state("swing", [off, 1.0])];
    let transition = |from: usize, when: &str| {
        let walk = Arc::clone(walk);
        Transition::new(from, 1 - from, when, move |inputs: &MachineInputs<'_>| {
            let stands = walk.phases(inputs.clock).stance[side];
            stands != (from == 0)
        })
    };
    let names = LegJoint::ALL.map(|joint| joint_name(side, joint));
    let foot = move |_: usize, _: &MachineInputs<'_>, children: &ChildOutputs<'_>| {
        let [hip, knee, ankle] = [0, 1, 2].map(|i| children.output(&names[i]));
        hip - knee + ankle
    };
    Machine::new(&format!("{side} leg"), states, foot)
        .with_transitions([transition(0, "foot off"), transition(1, "contact")])
        .with_children(LegJoint::ALL.map(|joint| joint_machine(walk, side, joint)))
}

fn joint_name(side: Side, joint: LegJoint) -> String {
    format!("{side} {}", joint.name())
}

fn joint_machine(walk: &Arc<Walk>, side: Side, joint: LegJoint) -> Machine {
    let angle = {
        let walk = Arc::clone(walk);
        move |curve: Jet, clock: &Clock| walk.leg_angle(joint, curve, clock)
    };
    curve_machine(walk, &joint_name(side, joint), side, walk.legs().of(joint), angle)
}

/// A machine whose states are the sub-cycles of a curve; `angle` makes the angle of the joint from the value of the curve.
fn curve_machine(
    walk: &Arc<Walk>,
    name: &str,
    side: Side,
    curve: &CyclicCurve,
    angle: impl Fn(Jet, &Clock) -> Jet + Send + Sync + 'static,
) -> Machine {
    let curve = Arc::new(curve.clone());
    let sub_cycles = Arc::new(SubCycle::of(&curve));
    let start = walk.first_clock();
    let speed = walk.curve_speed(&start);
    let state = |part: &SubCycle| {
        let bounds = part.bounds(&curve, speed.value).map(|value| angle(Jet::constant(value), &start).value);
        let span = Span { window: part.window(&curve, speed.value), bounds: Some(bounds) };
        State { name: part.name.clone(), span: Some(span) }
    };
    let count = sub_cycles.len();
    let transition = |k: usize| {
        let (walk, curve, parts) = (Arc::clone(walk), Arc::clone(&curve), Arc::clone(&sub_cycles));
        let end = parts[k].to % curve.knots().len();
        let when = curve.knots()[end].name.clone();
        Transition::new(k, (k + 1) % count, when, move |inputs: &MachineInputs<'_>| {
            let speed = walk.curve_speed(inputs.clock).value;
            let segment = curve.segment_at(phase_of(side, inputs.clock).value, speed);
            !parts[k].has_segment(segment, curve.knots().len())
        })
    };
    let states = sub_cycles.iter().map(state).collect();
    let transitions: Vec<Transition> = if count > 1 { (0..count).map(transition).collect() } else { Vec::new() };
    let activity = {
        let (walk, curve, parts) = (Arc::clone(walk), Arc::clone(&curve), Arc::clone(&sub_cycles));
        move |state: usize, inputs: &MachineInputs<'_>, _: &ChildOutputs<'_>| {
            let (phase, speed) = (phase_of(side, inputs.clock), walk.curve_speed(inputs.clock));
            let segment = parts[state].segment(&curve, phase.value, speed.value);
            angle(curve.on_segment(segment, phase, speed), inputs.clock)
        }
    };
    Machine::new(name, states, activity).with_transitions(transitions)
}

fn pelvis(walk: &Arc<Walk>) -> Machine {
    let walk = Arc::clone(walk);
    Machine::new("pelvis", vec![State::named("tilting")], move |_, inputs, _| walk.pelvis_tilt(inputs.clock))
}

fn lean(walk: &Arc<Walk>) -> Machine {
    let walk = Arc::clone(walk);
    Machine::new("trunk", vec![State::named("leaning")], move |_, inputs, _| walk.trunk_lean(inputs.clock))
}

fn shoulder(walk: &Arc<Walk>, side: Side) -> Machine {
    let speed = walk.curve_speed(&walk.first_clock());
    let angle = |phase: f64| ArmCurves::shoulder(Jet::constant(phase), speed).value;
    let state = |name: &str, window: [f64; 2]| {
        let span = Span { window, bounds: Some(window.map(angle)) };
        State { name: name.into(), span: Some(span) }
    };
    let states = vec![state("forward swing", [0.0, 0.5]), state("backward swing", [0.5, 1.0])];
    let transition = |from: usize, when: &str| {
        Transition::new(from, 1 - from, when, move |inputs: &MachineInputs<'_>| {
            let phase = phase_of(side, inputs.clock).value;
            (phase - phase.floor() < 0.5) != (from == 0)
        })
    };
    let walk = Arc::clone(walk);
    Machine::new(&format!("{side} shoulder"), states, move |_, inputs, _| {
        let swing = ArmCurves::shoulder(phase_of(side, inputs.clock), walk.curve_speed(inputs.clock));
        walk.arm_angle(swing, inputs.clock)
    })
    .with_transitions([transition(0, "the other foot's contact"), transition(1, "contact")])
}

fn elbow(walk: &Arc<Walk>, side: Side) -> Machine {
    let angle = {
        let walk = Arc::clone(walk);
        move |curve: Jet, clock: &Clock| walk.arm_angle(curve, clock)
    };
    curve_machine(walk, &format!("{side} elbow"), side, walk.arms().elbow(), angle)
}

/// A walk that is driven by its state machine.
#[derive(Debug)]
pub struct WalkMachine {
    walk: Walk,
    running: RunningMachine,
    /// Numbers of the machines whose outputs are parts of the posture.
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

    /// The same machine with the children sorted by a key of their names.
    #[must_use]
    pub fn ordered(walk: &Walk, key: &impl Fn(&str) -> u64) -> WalkMachine {
        WalkMachine::with(walk, walking_machine(walk).with_children_ordered(key))
    }

    fn with(walk: &Walk, machine: Machine) -> WalkMachine {
        let running = RunningMachine::new(machine);
        // Every name is one that `walking_machine` gave.
        let number = |name: &str| running.number(name).unwrap_or(0);
        WalkMachine {
            walk: walk.clone(),
            legs: Side::BOTH.map(|side| number(&format!("{side} leg"))),
            joints: Side::BOTH.map(|side| LegJoint::ALL.map(|joint| number(&joint_name(side, joint)))),
            trunk: ["pelvis", "trunk"].map(number),
            arms: Side::BOTH.map(|side| ["shoulder", "elbow"].map(|part| number(&format!("{side} {part}")))),
            running,
        }
    }

    /// The walk that is driven.
    #[must_use]
    pub fn walk(&self) -> &Walk {
        &self.walk
    }

    /// Runs all machines once at a time [s] and returns the posture of their outputs.
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
            phases: Phases {
                stance: BySide::from(self.legs).map(|leg| self.running.state(leg) == 0),
                ..self.walk.phases(&clock)
            },
        }
    }

    /// The machines with their states.
    #[must_use]
    pub fn running(&self) -> &RunningMachine {
        &self.running
    }
}
