//! Muscle forces of one posture: paths, strengths, static optimisation.
//!
//! | step | module | result |
//! |---|---|---|
//! | paths | [`path`](crate::path) | length, lengthening speed and moment arms of each muscle |
//! | strength | [`strength`](crate::strength) | its active force F at activation 1 |
//! | optimisation | [`optimization`](crate::optimization) | activations a and motors x with least Σ w aᵖ + Σ ∣x∣ᵖ |
//!
//!   Σ_muscles r_c F a + Σ_motors at c (optimal force) x = τ_c      for every free coordinate c
//!
//! A coordinate that follows another one adds its generalised force times the slope of the coupler to that of its
//! leader; its moment arms are in those of the leader already. Locked and prescribed coordinates have no equation.
//!
//! Source: OpenSim's StaticOptimization (see [`optimization`](crate::optimization)).
//! Pinned by: tests/solver.rs

use crate::curves::ForceCurves;
use crate::optimization::{Actuator, Convergence, Optimizer};
use crate::path::PathWorkspace;
use crate::set::{CoordinateActuator, MuscleCurves, MuscleSet};
use crate::settings::{MuscleSettings, Reserves, SolverError};
use crate::strength::Strength;
use ambulo_body::dynamics::BodyLoad;
use ambulo_body::kinematics::Posture;
use ambulo_body::model::{CoordinateId, Drive, Function, Model};

/// Computes muscle forces frame after frame. Made once for a model, its muscles and settings; frames allocate nothing.
#[derive(Debug, Clone)]
pub struct MuscleSolver {
    paths: PathWorkspace,
    curves: Vec<ForceCurves>,
    muscles: Vec<PreparedMuscle>,
    motors: Vec<Motor>,
    optimizer: Optimizer,
    coordinates: Vec<CoordinateId>,
    /// Row of each coordinate of the model.
    rows: Vec<Option<usize>>,
    couplers: Vec<Coupler>,
    tau: Vec<f64>,
    frame: FrameValues,
}

#[derive(Debug, Clone)]
struct PreparedMuscle {
    strength: Strength,
    /// Index of its curves.
    curves: usize,
}

/// A motor at a row.
#[derive(Debug, Clone, Copy)]
struct Motor {
    row: usize,
    optimal_force: f64,
    control_range: [f64; 2],
}

/// A coordinate that follows another one.
#[derive(Debug, Clone)]
struct Coupler {
    follower: usize,
    leader: usize,
    row: usize,
    function: Function,
}

/// Results of one frame. Slices have one entry per muscle, in the order of [`MuscleSet::muscles`], unless stated
/// otherwise.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FrameValues {
    /// Activations.
    pub activations: Vec<f64>,
    /// Tensions: active forces along the tendon [N].
    pub forces: Vec<f64>,
    /// Forces at activation 1 [N].
    pub strengths: Vec<f64>,
    /// Lengths of the paths [m].
    pub lengths: Vec<f64>,
    /// Lengthening speeds of the paths [m/s].
    pub speeds: Vec<f64>,
    /// Generalised force that muscles and motors must exert at each coordinate of [`MuscleSolver::coordinates`]: that
    /// of inverse dynamics, with those of coordinates that follow [N.m or N].
    pub required: Vec<f64>,
    /// Generalised force of the motors at each of these coordinates [N.m or N].
    pub reserves: Vec<f64>,
    /// Part of the required force that nothing could exert [N.m or N]: rounding, unless motors are missing or limited.
    pub unmet: Vec<f64>,
    /// Load of all tensions on each body of the model.
    pub body_loads: Vec<BodyLoad>,
    /// How the optimisation ended; `None` before the first frame.
    pub convergence: Option<Convergence>,
}

impl MuscleSolver {
    /// Prepares a model and its muscles.
    ///
    /// # Errors
    /// No muscles, curves that cannot be made, weights or motors for names that do not exist: see [`SolverError`].
    pub fn new(model: &Model, set: &MuscleSet, settings: &MuscleSettings) -> Result<MuscleSolver, SolverError> {
        if set.muscles.is_empty() {
            return Err(SolverError::NoMuscles);
        }
        let (curves, muscles) = prepared_muscles(set, settings)?;
        let is_free = |id: &CoordinateId| matches!(model.coordinates()[id.index()].drive, Drive::Free);
        let coordinates: Vec<CoordinateId> = model.coordinate_ids().filter(is_free).collect();
        let row_of = |id: CoordinateId| coordinates.iter().position(|free| *free == id);
        let rows: Vec<Option<usize>> = model.coordinate_ids().map(row_of).collect();
        let motors = motors(model, set, &settings.reserves, &rows)?;
        let optimizer = optimizer(set, settings, coordinates.len(), &motors)?;
        let zeros = |count: usize| vec![0.0; count];
        let (count, free) = (muscles.len(), coordinates.len());
        Ok(MuscleSolver {
            paths: PathWorkspace::new(model, set, settings.wraps),
            couplers: couplers(model, &rows),
            frame: FrameValues {
                activations: zeros(count),
                forces: zeros(count),
                strengths: zeros(count),
                lengths: zeros(count),
                speeds: zeros(count),
                required: zeros(free),
                reserves: zeros(free),
                unmet: zeros(free),
                body_loads: Vec::with_capacity(model.bodies().len()),
                convergence: None,
            },
            tau: zeros(free),
            curves,
            muscles,
            motors,
            optimizer,
            coordinates,
            rows,
        })
    }

    /// The free coordinates, in the order of [`FrameValues::reserves`].
    #[must_use]
    pub fn coordinates(&self) -> &[CoordinateId] {
        &self.coordinates
    }

    /// The paths of the muscles in the posture of the last frame.
    #[must_use]
    pub fn paths(&self) -> &PathWorkspace {
        &self.paths
    }

    /// Forgets the last frame as the start of the optimisation.
    pub fn forget(&mut self) {
        self.optimizer.forget();
    }

    /// Muscle forces of a posture with the generalised forces [N.m or N] of inverse dynamics, one per coordinate of the
    /// model. The last frame is where the optimisation starts; the result does not depend on it.
    ///
    /// # Panics
    /// If the length of a slice differs from the number of coordinates.
    pub fn frame(&mut self, posture: Posture<'_>, generalized: &[f64]) -> &FrameValues {
        self.paths.update(posture);
        self.set_strengths();
        self.gather(posture, generalized);
        let MuscleSolver { paths, optimizer, frame, rows, motors, tau, .. } = self;
        for (muscle, strength) in frame.strengths.iter().enumerate() {
            let arms = paths.coordinates(muscle).iter().zip(paths.arms(muscle));
            let entries = arms.filter_map(|(id, arm)| Some((rows[id.index()]?, arm * strength)));
            optimizer.set_column(muscle, entries);
        }
        frame.convergence = Some(optimizer.solve(tau));
        let (activations, controls) = optimizer.controls().split_at(frame.activations.len());
        frame.activations.copy_from_slice(activations);
        for (force, (activation, strength)) in frame.forces.iter_mut().zip(activations.iter().zip(&frame.strengths)) {
            *force = activation * strength;
        }
        frame.reserves.fill(0.0);
        for (motor, control) in motors.iter().zip(controls) {
            frame.reserves[motor.row] += control * motor.optimal_force;
        }
        for (unmet, excess) in frame.unmet.iter_mut().zip(optimizer.excess()) {
            *unmet = -excess;
        }
        frame.required.copy_from_slice(tau);
        paths.loads(&frame.forces, &mut frame.body_loads);
        frame
    }

    fn set_strengths(&mut self) {
        let MuscleSolver { paths, curves, muscles, frame, .. } = self;
        frame.lengths.copy_from_slice(paths.lengths());
        frame.speeds.copy_from_slice(paths.speeds());
        for (i, muscle) in muscles.iter().enumerate() {
            let (length, speed) = (frame.lengths[i], frame.speeds[i]);
            frame.strengths[i] = muscle.strength.force(&curves[muscle.curves], length, speed, 1.0);
        }
    }

    /// The generalised forces of the free coordinates, with those of the coordinates that follow them.
    fn gather(&mut self, posture: Posture<'_>, generalized: &[f64]) {
        assert_eq!(generalized.len(), self.rows.len(), "generalised forces of another model");
        for (tau, id) in self.tau.iter_mut().zip(&self.coordinates) {
            *tau = generalized[id.index()];
        }
        for coupler in &self.couplers {
            let slope = coupler.function.at(posture.q[coupler.leader])[1];
            self.tau[coupler.row] += slope * generalized[coupler.follower];
        }
    }
}

/// Curves without repetition, and every muscle.
fn prepared_muscles(
    set: &MuscleSet,
    settings: &MuscleSettings,
) -> Result<(Vec<ForceCurves>, Vec<PreparedMuscle>), SolverError> {
    let mut known: Vec<&MuscleCurves> = Vec::new();
    let mut curves = Vec::new();
    let mut muscles = Vec::with_capacity(set.muscles.len());
    for muscle in &set.muscles {
        let own = &muscle.parameters.curves;
        let index = match known.iter().position(|other| *other == own) {
            Some(index) => index,
            None => {
                let named = |source| SolverError::Curve { muscle: muscle.name.clone(), source };
                known.push(own);
                curves.push(ForceCurves::new(own).map_err(named)?);
                curves.len() - 1
            }
        };
        let strength = Strength::new(&muscle.parameters, &curves[index], settings.pennation);
        muscles.push(PreparedMuscle { strength, curves: index });
    }
    Ok((curves, muscles))
}

fn couplers(model: &Model, rows: &[Option<usize>]) -> Vec<Coupler> {
    let coupler = |(follower, coordinate): (usize, &ambulo_body::model::Coordinate)| match &coordinate.drive {
        Drive::Coupled(leader, function) => {
            let row = rows[leader.index()]?;
            Some(Coupler { follower, leader: leader.index(), row, function: function.clone() })
        }
        _ => None,
    };
    model.coordinates().iter().enumerate().filter_map(coupler).collect()
}

/// The motors of the model, and the reserves.
fn motors(
    model: &Model,
    set: &MuscleSet,
    reserves: &Reserves,
    rows: &[Option<usize>],
) -> Result<Vec<Motor>, SolverError> {
    let mut motors = Vec::new();
    for actuator in &set.actuators {
        // Motors at locked and prescribed coordinates do nothing in OpenSim either.
        if rows.get(actuator.coordinate.index()).copied().flatten().is_some() {
            motors.push(motor(model, actuator, rows)?);
        }
    }
    match reserves {
        Reserves::Listed(actuators) => {
            for actuator in actuators {
                motors.push(motor(model, actuator, rows)?);
            }
        }
        Reserves::Everywhere { joints, root } => {
            let is_root = |id: CoordinateId| {
                let moved = |body: &&ambulo_body::model::Body| body.joint.coordinates().contains(&id);
                model.bodies().iter().find(moved).is_some_and(|body| body.joint.parent.is_none())
            };
            for id in model.coordinate_ids() {
                let Some(row) = rows[id.index()] else { continue };
                if motors.iter().all(|motor| motor.row != row) {
                    let actuator = CoordinateActuator {
                        name: format!("{}_reserve", model.coordinates()[id.index()].name),
                        coordinate: id,
                        optimal_force: if is_root(id) { *root } else { *joints },
                        control_range: [f64::NEG_INFINITY, f64::INFINITY],
                    };
                    motors.push(motor(model, &actuator, rows)?);
                }
            }
        }
    }
    Ok(motors)
}

fn motor(model: &Model, actuator: &CoordinateActuator, rows: &[Option<usize>]) -> Result<Motor, SolverError> {
    let CoordinateActuator { name, coordinate, optimal_force, control_range } = actuator;
    let named = model.coordinates().get(coordinate.index());
    let error = |found: String, expected: &'static str| SolverError::Motor {
        name: name.clone(),
        coordinate: named.map_or_else(|| coordinate.index().to_string(), |known| known.name.clone()),
        found,
        expected,
    };
    let Some(row) = rows.get(coordinate.index()).copied().flatten() else {
        return Err(error("the coordinate is locked, prescribed, coupled or unknown".into(), "a free coordinate"));
    };
    if !(optimal_force.abs() > 0.0 && optimal_force.is_finite()) {
        return Err(error(format!("an optimal force of {optimal_force}"), "a number other than 0"));
    }
    let [low, high] = *control_range;
    if !(low <= high && low < f64::INFINITY && high > f64::NEG_INFINITY) {
        return Err(error(format!("controls from {low} to {high}"), "a range"));
    }
    Ok(Motor { row, optimal_force: *optimal_force, control_range: *control_range })
}

/// The optimisation with the columns of the motors set.
fn optimizer(
    set: &MuscleSet,
    settings: &MuscleSettings,
    rows: usize,
    motors: &[Motor],
) -> Result<Optimizer, SolverError> {
    let mut actuators = Vec::with_capacity(set.muscles.len() + motors.len());
    for weight in &settings.weights {
        if set.muscles.iter().all(|muscle| muscle.name != weight.muscle) {
            return Err(SolverError::UnknownMuscle { muscle: weight.muscle.clone() });
        }
    }
    for muscle in &set.muscles {
        let [low, high] = muscle.parameters.activation_range;
        let weight = settings.weights.iter().rfind(|weight| weight.muscle == muscle.name);
        actuators.push(Actuator { low, high, weight: weight.map_or(1.0, |weight| weight.weight) });
    }
    for Motor { control_range: [low, high], .. } in motors {
        actuators.push(Actuator { low: *low, high: *high, weight: 1.0 });
    }
    let mut optimizer = Optimizer::new(rows, actuators, settings.exponent)?;
    for (i, motor) in motors.iter().enumerate() {
        optimizer.set_column(set.muscles.len() + i, [(motor.row, motor.optimal_force)]);
    }
    Ok(optimizer)
}
