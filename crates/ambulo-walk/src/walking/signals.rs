//! Joint motions of a gait: targets for the drives of a model, step by step or sampled in advance.

use super::figure::WalkingError;
use crate::engine::Signal;
use crate::gait::machine::{Condition, Driven, MachineSettings, StateTrace, WalkMachine};
use crate::gait::{LegJoint, Walk, WalkCoordinates, WalkPart, WalkPosture};
use crate::model::{BySide, CoordinateId, Model, Side};

/// The machine of a walk as targets for the coordinates of a model.
#[derive(Debug, Clone)]
pub struct GaitTargets {
    machine: WalkMachine,
    coordinates: WalkCoordinates,
    /// The coordinates that machines of the gait drive, in the order of [`WalkMachine::coordinates`].
    driven: Vec<CoordinateId>,
    /// Coordinates whose angles the machines read, and the sense of the angle, in the order of
    /// [`Sensed::angles`](crate::gait::machine::Sensed).
    read: Vec<(CoordinateId, f64)>,
    /// Coordinates of the model, without the gait.
    defaults: Vec<f64>,
    /// Values, rates and accelerations.
    columns: [Vec<f64>; 3],
    trace: StateTrace,
    time_s: f64,
}

impl GaitTargets {
    /// The targets of a walk.
    ///
    /// # Errors
    /// A machine that drives or reads a coordinate that the model does not have, or reads a signal that does not exist;
    /// `signals` are the names of those that do.
    pub fn new(walk: &Walk, model: &Model, signals: &[String]) -> Result<GaitTargets, WalkingError> {
        let defaults: Vec<f64> = model.coordinates().iter().map(|coordinate| coordinate.default_value).collect();
        let of_machine = |machine: &MachineSettings| match &machine.drives {
            Driven::Coordinate(name) => Some(model.coordinate(name).ok_or_else(|| WalkingError::Coordinate {
                machine: machine.name.clone(),
                found: name.clone(),
                expected: model.coordinates().iter().map(|own| own.name.as_str()).collect::<Vec<_>>().join(", "),
            })),
            _ => None,
        };
        let mut machine = WalkMachine::new(walk);
        let sensed = machine.sensed_mut();
        sensed.signals = signals.iter().map(|name| (name.clone(), 0.0)).collect();
        let mut read = Vec::new();
        for settings in &walk.gait().machines {
            for condition in settings.conditions() {
                match condition {
                    Condition::Angle(name, ..) if !sensed.angles.iter().any(|(own, _)| own == name) => {
                        if let Some(place) = read_angle(settings, name, model)? {
                            read.push(place);
                            sensed.angles.push((name.clone(), 0.0));
                        }
                    }
                    Condition::Signal(name, ..) if !signals.contains(name) => {
                        return Err(WalkingError::Signal {
                            machine: settings.name.clone(),
                            found: name.clone(),
                            expected: if signals.is_empty() { "none".to_owned() } else { signals.join(", ") },
                        });
                    }
                    _ => {}
                }
            }
        }
        Ok(GaitTargets {
            machine,
            coordinates: WalkCoordinates::of(model),
            driven: walk.gait().machines.iter().filter_map(of_machine).collect::<Result<_, _>>()?,
            read,
            columns: [defaults.clone(), vec![0.0; defaults.len()], vec![0.0; defaults.len()]],
            defaults,
            trace: StateTrace::default(),
            time_s: 0.0,
        })
    }

    /// Targets at a time [s] with feet that are loaded as the gait plans.
    pub fn step(&mut self, time_s: f64) {
        let posture = self.machine.step(time_s);
        self.write(&posture, time_s);
    }

    /// Sets what the machines read of the figure: the values of the model's coordinates, by number, and the signals in
    /// their order.
    pub fn measure(&mut self, value: impl Fn(usize) -> f64, signals: impl Fn(usize) -> f64) {
        let sensed = self.machine.sensed_mut();
        for ((id, sense), (_, angle)) in self.read.iter().zip(&mut sensed.angles) {
            *angle = sense * value(id.index());
        }
        for (k, (_, signal)) in sensed.signals.iter_mut().enumerate() {
            *signal = signals(k);
        }
    }

    /// Targets at a time [s] with the loads that the feet have.
    pub(crate) fn step_with(&mut self, time_s: f64, loaded: BySide<bool>) {
        let posture = self.machine.step_with(time_s, loaded);
        self.write(&posture, time_s);
    }

    fn write(&mut self, posture: &WalkPosture, time_s: f64) {
        self.time_s = time_s;
        self.trace.add(self.machine.running(), time_s);
        let [q, qd, qdd] = &mut self.columns;
        self.coordinates.write(posture, q, qd, qdd);
        for (id, (_, jet)) in self.driven.iter().zip(self.machine.coordinates()) {
            let k = id.index();
            (q[k], qd[k], qdd[k]) = (self.defaults[k] + jet.value, jet.rate, jet.acceleration);
        }
    }

    /// Value, rate and acceleration of a coordinate of the model, by number.
    #[must_use]
    pub fn at(&self, coordinate: usize) -> [f64; 3] {
        [0, 1, 2].map(|k| self.columns[k][coordinate])
    }

    /// Number of coordinates.
    #[must_use]
    pub fn count(&self) -> usize {
        self.defaults.len()
    }

    /// Names of the signals that the machines may read.
    pub fn signals(&self) -> impl Iterator<Item = &str> {
        self.machine.sensed().signals.iter().map(|(name, _)| name.as_str())
    }

    /// The states of all machines since the first step.
    #[doc(hidden)]
    #[must_use]
    pub fn trace(&self) -> &StateTrace {
        &self.trace
    }

    /// Time of the last step [s]; before it, zero.
    #[must_use]
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// The machine.
    #[must_use]
    pub fn machine(&self) -> &WalkMachine {
        &self.machine
    }
}

/// The coordinate of an angle that a machine reads, and its sense. Hip, pelvis and trunk are parts of several
/// coordinates: their angle is the angle of the machine that drives them.
fn read_angle(
    settings: &MachineSettings,
    name: &str,
    model: &Model,
) -> Result<Option<(CoordinateId, f64)>, WalkingError> {
    let part = WalkPart::ALL.into_iter().find(|part| part.name() == name);
    let of_side = |joint: &str, side: Side| format!("{joint}_{}", side.letter());
    let (coordinate, sense) = match part {
        Some(WalkPart::Leg(_, LegJoint::Hip) | WalkPart::Pelvis | WalkPart::Trunk) => return Ok(None),
        Some(WalkPart::Leg(side, LegJoint::Knee)) => (of_side("knee_angle", side), -1.0),
        Some(WalkPart::Leg(side, LegJoint::Ankle)) => (of_side("ankle_angle", side), 1.0),
        Some(WalkPart::Shoulder(side)) => (of_side("arm_flex", side), 1.0),
        Some(WalkPart::Elbow(side)) => (of_side("elbow_flex", side), 1.0),
        None => (name.to_owned(), 1.0),
    };
    let unknown = || WalkingError::Angle {
        machine: settings.name.clone(),
        found: name.to_owned(),
        expected: model.coordinates().iter().map(|own| own.name.as_str()).collect::<Vec<_>>().join(", "),
    };
    model.coordinate(&coordinate).map(|id| Some((id, sense))).ok_or_else(unknown)
}

/// The targets as signals in the order of the model's coordinates, beginning `start_s` after the start of the walk. A
/// walk whose cycles differ is sampled for `duration_s`.
///
/// The state machine of the walk computes the targets, from step to step of the samples; steps of a simulation read
/// samples, so their number per second does not change the motion.
///
/// # Errors
/// A machine that drives a coordinate that the model does not have.
pub fn gait_signals(walk: &Walk, model: &Model, start_s: f64, duration_s: f64) -> Result<Vec<Signal>, WalkingError> {
    let signals: Vec<String> = walk.gait().signals().map(str::to_owned).collect();
    let mut targets = GaitTargets::new(walk, model, &signals)?;
    let count = model.coordinates().len();
    let motion = |t: f64, row: &mut [[f64; 3]]| {
        targets.step(start_s + t);
        for (k, entry) in row.iter_mut().enumerate() {
            *entry = targets.at(k);
        }
    };
    Ok(if walk.is_steady() {
        Signal::periodic(count, walk.cycle_s(), motion)
    } else {
        Signal::over(count, duration_s, motion)
    })
}
