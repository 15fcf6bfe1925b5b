//! Machines from their descriptions, as parts of the machine of a walk.
//!
//! A machine that drives a part of the figure is placed below the machine of that part, which then passes its output
//! on; all others run below the root. Their first state is `rest`, in which the part follows the gait.

use super::condition::Condition;
use super::definition::{ChildOutputs, Gate, Machine, MachineInputs, State, Transition};
use super::settings::{Activity, Driven, MachineSettings, PASSAGE_S, StateSettings};
use crate::gait::jet::Jet;
use crate::gait::joint::WalkPart;
use crate::gait::pace_plan::{Clock, PaceChange};
use crate::gait::walk::Walk;
use crate::model::Side;
use std::sync::Arc;

/// Name of the state of a machine that does not run.
pub(super) const REST: &str = "rest";

/// The machine of a description.
pub(super) fn authored(walk: &Arc<Walk>, settings: &MachineSettings) -> Machine {
    let named = |state: &StateSettings| State { done: state.done, ..State::named(&state.name) };
    let states = std::iter::once(State::named(REST)).chain(settings.states.iter().map(named)).collect();
    let within = |to: usize, within_s: f64| match settings.states[to].activity {
        Activity::SubCycle { within_s, .. } => within_s,
        _ => within_s,
    };
    let transitions = settings.transitions.iter().map(|transition| {
        let when: Condition = transition.when.clone();
        Transition::new(transition.from + 1, transition.to + 1, when.to_string(), move |inputs: &MachineInputs<'_>| {
            when.holds(inputs)
        })
        .within(within(transition.to, transition.within_s))
    });
    let activity = {
        let (walk, drives) = (Arc::clone(walk), settings.drives.clone());
        let activities: Vec<Activity> = settings.states.iter().map(|state| state.activity.clone()).collect();
        move |state: usize, inputs: &MachineInputs<'_>, _: &ChildOutputs<'_>| match state.checked_sub(1) {
            None => at_rest(&walk, &drives, inputs.clock),
            Some(own) => output(&walk, &drives, &activities[own], inputs),
        }
    };
    let gate = Gate {
        during: settings.during.clone(),
        resumes: settings.resumes,
        within_s: [within(0, PASSAGE_S), PASSAGE_S],
    };
    Machine::new(&settings.name, states, activity).with_transitions(transitions).with_gate(gate)
}

fn at_rest(walk: &Walk, drives: &Driven, clock: &Clock) -> Jet {
    match drives {
        Driven::Part(part) => walk.part_angle(*part, clock),
        _ => Jet::ZERO,
    }
}

fn output(walk: &Walk, drives: &Driven, activity: &Activity, inputs: &MachineInputs<'_>) -> Jet {
    let clock = inputs.clock;
    let side = match drives {
        Driven::Part(part) => part.side(),
        Driven::Coordinate(name) => Side::of_name(name).unwrap_or(Side::Right),
        Driven::Pace | Driven::Nothing => return Jet::ZERO,
    };
    match activity {
        Activity::Wait | Activity::Pace(_) => at_rest(walk, drives, clock),
        Activity::Walk { scale, angle, phase } => {
            let shifted = Clock { phase: clock.phase + *phase, ..*clock };
            match drives {
                Driven::Part(part) => walk.altered_angle(*part, &shifted, *scale, *angle),
                _ => Jet::ZERO,
            }
        }
        Activity::SubCycle { to, .. } => Jet::constant(*to),
        Activity::Curve(curve) => curve.at(clock.phase_of(side), walk.curve_speed(clock)),
        Activity::Recording { values, from_s } => {
            let (first, last) = (values.times()[0], values.times()[values.times().len() - 1]);
            let time_s = from_s + inputs.since_s();
            if (first..=last).contains(&time_s) {
                let [value, rate, acceleration] = values.value_and_two_derivatives(time_s);
                Jet::new(value, rate, acceleration)
            } else {
                Jet::constant(values.value(time_s.clamp(first, last)))
            }
        }
    }
}

/// The part of the figure that a description drives.
pub(super) fn driven_part(settings: &MachineSettings) -> Option<WalkPart> {
    match settings.drives {
        Driven::Part(part) => Some(part),
        _ => None,
    }
}

/// The pace of a state of a machine that drives the pace; the state of rest is counted.
pub(super) fn pace_of(settings: &MachineSettings, state: usize) -> Option<&PaceChange> {
    match (&settings.drives, &settings.states.get(state.checked_sub(1)?)?.activity) {
        (Driven::Pace, Activity::Pace(change)) => Some(change),
        _ => None,
    }
}
