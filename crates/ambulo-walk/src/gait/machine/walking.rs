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
//! Machines of the gait ([`MachineSettings`](super::MachineSettings)) are added to this tree. One that drives a part of
//! the figure replaces the output of the machine of that part and is its child; all others are children of the root.
//!
//! Transitions of the machines above test only the clock: a machine leaves a state when the phase is outside the window
//! of the state. Windows are evaluated at the current speed, so all machines stay synchronised when the speed changes.
//! The machine of a joint evaluates the polynomial of its sub-cycle on the same curves as [`Walk::at`]: both give the
//! same bits at any step rate (tests/gait_machine.rs).

use super::authored::{authored, driven_part, pace_of};
use super::definition::{ChildOutputs, Machine, MachineInputs, Sensed, Span, State, Transition};
use super::running_machine::RunningMachine;
use super::settings::Driven;
use crate::findings::Findings;
use crate::gait::arms;
use crate::gait::cyclic_curve::{CyclicCurve, SteadyCurve};
use crate::gait::error::GaitError;
use crate::gait::jet::Jet;
use crate::gait::joint::{LegJoint, WalkPart};
use crate::gait::pace_plan::{Clock, PaceChange};
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
    let walking = global(&walk).with_children(legs).with_children(trunk).with_children(arms);
    walk.gait().machines.iter().fold(walking, |tree, settings| {
        let machine = authored(&walk, settings);
        match driven_part(settings) {
            Some(part) => driven_by(tree, part.name(), machine),
            None => tree.with_children([machine]),
        }
    })
}

/// The tree in which a machine takes the place of the one with this name.
fn driven_by(tree: Machine, name: &str, machine: Machine) -> Machine {
    let mut machine = Some(machine);
    replaced(tree, name, &mut machine)
}

fn replaced(tree: Machine, name: &str, machine: &mut Option<Machine>) -> Machine {
    if tree.name() == name
        && let Some(machine) = machine.take()
    {
        let driver = machine.name().to_owned();
        let state = State::named(&format!("driven by {driver}"));
        return Machine::new(name, vec![state], move |_, _, children| children.output(&driver))
            .with_children([machine]);
    }
    tree.with_mapped_children(|child| replaced(child, name, machine))
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
        span: Some(Span { window: [windows[k], windows[k + 1]], bounds: None }),
        ..State::named(NAMES[k])
    };
    let in_window = |k: usize| {
        let walk = Arc::clone(walk);
        move |clock: &Clock| {
            let Phases { cycle, foot_off, .. } = walk.phases(clock);
            let windows = support_windows(foot_off);
            (windows[k]..windows[k + 1]).contains(&cycle.right)
        }
    };
    let next = |k: usize| {
        let inside = in_window(k);
        Transition::new(k, (k + 1) % 4, EVENTS[k], move |inputs: &MachineInputs<'_>| !inside(inputs.clock))
    };
    let (mut states, mut transitions) = ((0..4).map(state).collect::<Vec<_>>(), Vec::new());
    if walk.may_stand() {
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
    let state =
        |name: &str, window: [f64; 2]| State { span: Some(Span { window, bounds: None }), ..State::named(name) };
    let states = vec![state("stance", [0.0, off]), state("swing", [off, 1.0])];
    let transition = |from: usize, when: &str| {
        let walk = Arc::clone(walk);
        Transition::new(from, 1 - from, when, move |inputs: &MachineInputs<'_>| {
            let stands = walk.phases(inputs.clock).stance[side];
            stands != (from == 0)
        })
    };
    let names = LegJoint::ALL.map(|joint| WalkPart::Leg(side, joint).name());
    let foot = move |_: usize, _: &MachineInputs<'_>, children: &ChildOutputs<'_>| {
        let [hip, knee, ankle] = names.map(|name| children.output(name));
        hip - knee + ankle
    };
    Machine::new(&format!("{side} leg"), states, foot)
        .with_transitions([transition(0, "foot off"), transition(1, "contact")])
        .with_children(LegJoint::ALL.map(|joint| joint_machine(walk, side, joint)))
}

fn joint_machine(walk: &Arc<Walk>, side: Side, joint: LegJoint) -> Machine {
    let angle = {
        let walk = Arc::clone(walk);
        move |curve: Jet, clock: &Clock| walk.leg_angle(side, joint, curve, clock)
    };
    curve_machine(walk, WalkPart::Leg(side, joint), walk.legs().of(joint), angle)
}

/// A machine whose states are the sub-cycles of a curve; `angle` makes the angle of the joint from the value of the
/// curve.
fn curve_machine(
    walk: &Arc<Walk>,
    part: WalkPart,
    curve: &CyclicCurve,
    angle: impl Fn(Jet, &Clock) -> Jet + Send + Sync + 'static,
) -> Machine {
    let side = part.side();
    let sub_cycles = Arc::new(SubCycle::of(curve));
    let start = walk.first_clock();
    let speed = walk.curve_speed(&start);
    let steady = Arc::new(SteadyCurve::new(curve, speed));
    let state = |part: &SubCycle| {
        let bounds = part.bounds(curve, speed.value).map(|value| angle(Jet::constant(value), &start).value);
        let span = Span { window: part.window(curve, speed.value), bounds: Some(bounds) };
        State { span: Some(span), ..State::named(&part.name) }
    };
    let count = sub_cycles.len();
    let transition = |k: usize| {
        let (walk, steady, parts) = (Arc::clone(walk), Arc::clone(&steady), Arc::clone(&sub_cycles));
        let knots = curve.knots().len();
        let when = curve.knots()[parts[k].to % knots].name.clone();
        Transition::new(k, (k + 1) % count, when, move |inputs: &MachineInputs<'_>| {
            let segment = steady.segment_at(inputs.clock.phase_of(side).value, walk.curve_speed(inputs.clock));
            !parts[k].has_segment(segment, knots)
        })
    };
    let states = sub_cycles.iter().map(state).collect();
    let transitions: Vec<Transition> = if count > 1 { (0..count).map(transition).collect() } else { Vec::new() };
    let activity = {
        let (walk, knots, parts) = (Arc::clone(walk), curve.knots().len(), Arc::clone(&sub_cycles));
        move |state: usize, inputs: &MachineInputs<'_>, _: &ChildOutputs<'_>| {
            let (phase, speed) = (inputs.clock.phase_of(side), walk.curve_speed(inputs.clock));
            let curve = steady.at_chosen(phase, speed, |segment| parts[state].segment(segment, knots));
            angle(curve, inputs.clock)
        }
    };
    Machine::new(part.name(), states, activity).with_transitions(transitions)
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
    let angle = |phase: f64| arms::shoulder(Jet::constant(phase), speed).value;
    let state = |name: &str, window: [f64; 2]| {
        let span = Span { window, bounds: Some(window.map(angle)) };
        State { span: Some(span), ..State::named(name) }
    };
    let states = vec![state("forward swing", [0.0, 0.5]), state("backward swing", [0.5, 1.0])];
    let transition = |from: usize, when: &str| {
        Transition::new(from, 1 - from, when, move |inputs: &MachineInputs<'_>| {
            let phase = inputs.clock.phase_of(side).value;
            (phase - phase.floor() < 0.5) != (from == 0)
        })
    };
    let walk = Arc::clone(walk);
    Machine::new(WalkPart::Shoulder(side).name(), states, move |_, inputs, _| {
        let swing = arms::shoulder(inputs.clock.phase_of(side), walk.curve_speed(inputs.clock));
        walk.arm_angle(WalkPart::Shoulder(side), swing, inputs.clock)
    })
    .with_transitions([transition(0, "the other foot's contact"), transition(1, "contact")])
}

fn elbow(walk: &Arc<Walk>, side: Side) -> Machine {
    let angle = {
        let walk = Arc::clone(walk);
        move |curve: Jet, clock: &Clock| walk.arm_angle(WalkPart::Elbow(side), curve, clock)
    };
    curve_machine(walk, WalkPart::Elbow(side), walk.elbow(), angle)
}

/// A walk that is driven by its state machine.
#[derive(Debug, Clone)]
pub struct WalkMachine {
    walk: Walk,
    running: RunningMachine,
    sensed: Sensed,
    /// Numbers of the machines whose outputs are parts of the posture.
    legs: [usize; 2],
    parts: [usize; 12],
    /// Names and numbers of the machines that drive coordinates of the model.
    coordinates: Vec<(String, usize)>,
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
        let coordinates = walk.gait().machines.iter().filter_map(|settings| match &settings.drives {
            Driven::Coordinate(name) => Some((name.clone(), number(&settings.name))),
            _ => None,
        });
        WalkMachine {
            walk: walk.clone(),
            sensed: Sensed::default(),
            legs: Side::BOTH.map(|side| number(&format!("{side} leg"))),
            parts: WalkPart::ALL.map(|part| number(part.name())),
            coordinates: coordinates.collect(),
            running,
        }
    }

    /// The walk that is driven.
    #[must_use]
    pub fn walk(&self) -> &Walk {
        &self.walk
    }

    /// Runs all machines once at a time [s] and returns the posture of their outputs. Feet are loaded as the gait
    /// plans; the machines read the angles of the previous step.
    pub fn step(&mut self, time_s: f64) -> WalkPosture {
        let clock = self.walk.clock(time_s);
        let phases = self.walk.phases(&clock);
        self.step_to(time_s, &clock, phases, phases.stance)
    }

    /// As [`WalkMachine::step`], with the measured loads of the feet.
    pub(crate) fn step_with(&mut self, time_s: f64, loaded: BySide<bool>) -> WalkPosture {
        let clock = self.walk.clock(time_s);
        let phases = self.walk.phases(&clock);
        self.step_to(time_s, &clock, phases, loaded)
    }

    fn step_to(&mut self, time_s: f64, clock: &Clock, phases: Phases, loaded: BySide<bool>) -> WalkPosture {
        self.sensed.time_s = time_s - self.walk.machines_begin_s();
        self.sensed.loaded_before = std::mem::replace(&mut self.sensed.loaded, loaded);
        self.running.step(clock, &self.sensed);
        let part = |part: WalkPart| {
            let place = WalkPart::ALL.iter().position(|own| *own == part).unwrap_or(0);
            self.running.output(self.parts[place])
        };
        let leg = |side: Side| {
            let [hip, knee, ankle] = LegJoint::ALL.map(|joint| part(WalkPart::Leg(side, joint)));
            LegAngles { hip, knee, ankle }
        };
        WalkPosture {
            right: leg(Side::Right),
            left: leg(Side::Left),
            pelvis_tilt: part(WalkPart::Pelvis),
            standing_tilt: self.walk.standing_tilt(),
            trunk_lean: part(WalkPart::Trunk),
            shoulders: Side::BOTH.map(|side| part(WalkPart::Shoulder(side))),
            elbows: Side::BOTH.map(|side| part(WalkPart::Elbow(side))),
            phases: Phases { stance: BySide::from(self.legs).map(|leg| self.running.state(leg) == 0), ..phases },
        }
    }

    /// Coordinates of the model that machines drive, by name, with what they add to the default value [rad].
    pub fn coordinates(&self) -> impl Iterator<Item = (&str, Jet)> {
        self.coordinates.iter().map(|(name, number)| (name.as_str(), self.running.output(*number)))
    }

    /// State of the figure that the machines read in the last step.
    #[must_use]
    pub(crate) fn sensed(&self) -> &Sensed {
        &self.sensed
    }

    /// State of the figure for the next step: the caller may set angles and signals.
    pub(crate) fn sensed_mut(&mut self) -> &mut Sensed {
        &mut self.sensed
    }

    /// The machines with their states.
    #[must_use]
    pub fn running(&self) -> &RunningMachine {
        &self.running
    }

    /// Changes the pace as the states ask that machines have entered in the last step.
    fn change_pace(&mut self, time_s: f64, findings: &mut Findings) -> Result<(), GaitError> {
        let machines = self.walk.gait().machines.clone();
        for settings in &machines {
            let Some(number) = self.running.number(&settings.name) else { continue };
            let entered = self.running.has_changed(number);
            if let Some(change) = pace_of(settings, self.running.state(number)).filter(|_| entered) {
                self.walk.add_change(&PaceChange { start_s: time_s, ..*change }, findings)?;
            }
        }
        Ok(())
    }
}

/// Step at which machines run in a plan [s].
const PLAN_STEP_S: f64 = 1e-3;
/// Standing after the last change of pace [s].
const STANDING_S: f64 = 1.0;

/// Runs the machines of a walk in advance. Returns the walk with the changes of pace that they make, and the duration
/// of the plan [s].
///
/// The plan begins with the machines and ends when the right foot has made `cycles` cycles, when the figure stands and
/// no machine can make it walk again, or after `longest_s` seconds.
///
/// # Errors
/// Changes of pace that are not possible, or that overlap.
pub fn planned(walk: Walk, cycles: f64, longest_s: f64, findings: &mut Findings) -> Result<(Walk, f64), GaitError> {
    let begin_s = walk.machines_begin_s();
    let mut machine = WalkMachine::new(&walk);
    let first = machine.walk.clock(begin_s).phase.value;
    let mut stood_s = 0.0;
    for step in 0..(longest_s / PLAN_STEP_S) as usize {
        let since_s = PLAN_STEP_S * step as f64;
        let time_s = begin_s + since_s;
        machine.step(time_s);
        machine.change_pace(time_s, findings)?;
        let clock = machine.walk.clock(time_s);
        stood_s = if clock.stands() { stood_s + PLAN_STEP_S } else { 0.0 };
        let stays = stood_s > STANDING_S && machine.is_final();
        if clock.phase.value >= first + cycles || stays {
            return Ok((machine.walk, since_s));
        }
    }
    Ok((machine.walk, longest_s))
}

/// Cycles until machines repeat what they do, cycles in which this is judged, and instants of each.
const JUDGED: (usize, usize, usize) = (1, 20, 500);
/// Negligible difference of an angle between two cycles [rad]: a transition may be detected one instant later.
const SAME_ANGLE: f64 = 0.03;

/// Whether the machines of a walk that move joints do the same in every cycle of its first pace, after the first cycle
/// of 21. A change in later cycles would be missing in the cycle that is solved and repeated.
#[must_use]
pub fn repeats(walk: &Walk) -> bool {
    if !walk.gait().machines.iter().any(|machine| machine.drives.moves_a_joint()) {
        return true;
    }
    let (settling, judged, instants) = JUDGED;
    let mut machine = WalkMachine::new(walk);
    let mut angles = Vec::new();
    for step in 0..(settling + judged) * instants {
        let time_s = walk.machines_begin_s() + walk.cycle_s() * step as f64 / instants as f64;
        let mut at = machine.angles(time_s);
        at.extend(machine.coordinates().map(|(_, jet)| jet.value));
        angles.push(at);
    }
    let settled = &angles[settling * instants..];
    let same = |(a, b): (&Vec<f64>, &Vec<f64>)| a.iter().zip(b).all(|(a, b)| (a - b).abs() < SAME_ANGLE);
    settled.iter().zip(&settled[instants..]).all(same)
}

impl WalkMachine {
    /// All angles of the posture after a step to a time [s].
    fn angles(&mut self, time_s: f64) -> Vec<f64> {
        let at = self.step(time_s);
        let legs = [at.right, at.left].into_iter().flat_map(|leg| [leg.hip, leg.knee, leg.ankle]);
        let others = [at.pelvis_tilt, at.trunk_lean].into_iter().chain(at.shoulders).chain(at.elbows);
        legs.chain(others).map(|jet| jet.value).collect()
    }

    /// Whether no machine of the pace can leave its state any more.
    fn is_final(&self) -> bool {
        self.walk.gait().machines.iter().filter(|settings| settings.drives == Driven::Pace).all(|settings| {
            let state = self.running.number(&settings.name).map_or(0, |number| self.running.state(number));
            state > 0 && !settings.transitions.iter().any(|transition| transition.from + 1 == state)
        })
    }
}
