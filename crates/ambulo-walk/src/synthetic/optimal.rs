//! The optimal mode: a walk in three dimensions, read from its solution. Nothing is simulated, because the solution has
//! no force from outside.

use super::settings::{SyntheticError, SyntheticWalkSettings};
use super::walk::{CORRECTED_SKIPPED, KeptPart, PredictionReport, SyntheticWalk, WalkReport, timed};
use crate::consistent_walk::{CorrectionReport, Magnitude};
use crate::engine::ContactForce;
use crate::findings::Findings;
use crate::gait::Walk;
use crate::kinematics::{Trajectory, TrajectoryError};
use crate::model::anthropometry::{ContactSphere, Human};
use crate::model::{BodyId, CoordinateId, CoordinateKind, Model, Side};
use crate::motion::TimeGrid;
use crate::optimal::{
    Device, DeviceEffort, Observer, OptimalWalk, OptimalWalkError, Sample, Solution, Unassisted, WalkConditions,
    metabolic_power, moment_at,
};
use crate::spatial::Vec3;
use crate::walking::{FootRecord, loads, worst_slip};

pub(super) fn optimal(
    settings: &SyntheticWalkSettings<'_>,
    observer: &Observer,
    findings: &mut Findings,
) -> Result<SyntheticWalk, SyntheticError> {
    let (walk, kept) = planned(settings, findings)?;
    let found = OptimalWalk::find_observed(&settings.build, &walk, observer)?;
    made(settings, walk, &kept, found)
}

/// The predicted mode: as the optimal mode, from a walk that minimises muscle effort.
pub(super) fn predicted(
    settings: &SyntheticWalkSettings<'_>,
    conditions: &WalkConditions,
    observer: &Observer,
    findings: &mut Findings,
) -> Result<SyntheticWalk, SyntheticError> {
    let no_curves = |gait| SyntheticError::Predicted { gait };
    let (walk, kept) = planned(settings, findings).map_err(|error| match error {
        SyntheticError::Changing { gait } | SyntheticError::NotOfPeople { gait } => no_curves(gait),
        other => other,
    })?;
    if !conditions.free_cadence {
        let found = OptimalWalk::predict_observed(&settings.build, &walk, conditions, observer)?;
        return reported(settings, (walk, kept), found, None);
    }
    let pace = settings.gait.pace;
    if pace.step_length.is_some() || pace.step_frequency.is_some() {
        return Err(SyntheticError::GivenSteps { gait: settings.gait.name.clone() });
    }
    let (found, own) = OptimalWalk::predict_freely(&settings.build, &walk, conditions, observer)?;
    let settings = &SyntheticWalkSettings { gait: own.gait(), ..*settings };
    // The usual cadence has had its findings.
    let planned = planned(settings, &mut Findings::default())?;
    reported(settings, planned, found, Some(120.0 / walk.cycle_s()))
}

/// A predicted walk with its report.
fn reported(
    settings: &SyntheticWalkSettings<'_>,
    (walk, kept): (Walk, KeptPart),
    found: OptimalWalk,
    usual_cadence: Option<f64>,
) -> Result<SyntheticWalk, SyntheticError> {
    let conditions = found.conditions.clone();
    let (mass, devices) = (settings.build.mass, &conditions.devices);
    let metabolic_power = metabolic_power(&found.solution, &walk, mass, devices).map_err(OptimalWalkError::from)?;
    let devices = DeviceEffort::of(&found.solution, &walk, mass, devices).map_err(OptimalWalkError::from)?;
    let mut predicted = made(settings, walk, &kept, found)?;
    let start_s = kept.first as f64 * settings.step_s();
    let moments = |effort: &DeviceEffort| device_moments(&predicted, effort.coordinate, &conditions.devices, start_s);
    let device_moments = devices.iter().map(moments).collect();
    predicted.report.prediction = Some(PredictionReport {
        conditions,
        metabolic_power,
        usual_cadence,
        devices,
        device_moments,
        unassisted: None,
    });
    Ok(predicted)
}

impl SyntheticWalk {
    /// Predicts a walk with devices once more without them, and adds that to the report. Other walks stay as they are.
    /// An observer follows the steps of the solver and may stop them.
    pub fn compare_without_devices(&mut self, observer: &Observer) {
        let Some(report) = self.report.prediction.as_mut().filter(|report| !report.devices.is_empty()) else { return };
        report.unassisted = Some(Unassisted::predict(&self.human.build, &self.walk, &report.conditions, observer));
    }
}

/// Moment of the devices at a joint in all frames of a walk that begins at a time of its solution [N.m].
fn device_moments(made: &SyntheticWalk, id: CoordinateId, devices: &[Device], start_s: f64) -> Vec<f64> {
    let name = &made.human.model.coordinates()[id.index()].name;
    let states = made.trajectory.values(id).iter().zip(made.trajectory.rates(id));
    let times = made.trajectory.grid().times();
    let moment = |(time_s, (angle, rate)): (f64, (&f64, &f64))| {
        moment_at(name, devices, start_s + time_s, &made.walk, [*angle, *rate])
    };
    times.into_iter().zip(states).map(moment).collect()
}

/// The walk to be found, and the part of it that is kept.
fn planned(settings: &SyntheticWalkSettings<'_>, findings: &mut Findings) -> Result<(Walk, KeptPart), SyntheticError> {
    let planar = settings.build.human()?;
    let (walk, kept) = timed(settings, settings.gait, &planar, CORRECTED_SKIPPED, findings)?;
    if !(walk.is_symmetric() && walk.is_steady()) {
        return Err(SyntheticError::Changing { gait: settings.gait.name.clone() });
    }
    if !walk.gait().follows_people() {
        return Err(SyntheticError::NotOfPeople { gait: settings.gait.name.clone() });
    }
    if !settings.build.toe_joint {
        return Err(SyntheticError::NoToeJoint);
    }
    Ok((walk, kept))
}

fn made(
    settings: &SyntheticWalkSettings<'_>,
    walk: Walk,
    kept: &KeptPart,
    found: OptimalWalk,
) -> Result<SyntheticWalk, SyntheticError> {
    let start_s = kept.first as f64 * settings.step_s();
    let grid = TimeGrid { start_s: 0.0, step_s: 1.0 / settings.rate_hz, frames: kept.frames };
    let trajectory = trajectory(&found.human.model, &found.solution, start_s, grid)?;
    let cycle = Cycle::new(&found, &walk, start_s, 1.0 / settings.step_s())?;
    // Forces last as long as the last frame.
    let rows = (grid.step_s * grid.frames as f64 / cycle.step_s).ceil() as usize + 1;
    let times: Vec<f64> = (0..rows).map(|row| cycle.step_s * row as f64).collect();
    let feet = cycle.feet(rows);
    let frame_times: Vec<f64> = grid.times().iter().map(|time_s| start_s + time_s).collect();
    let tilt = cycle.root_turning();
    let report = WalkReport {
        correction: Some(CorrectionReport::of(&found.problem, &found.solution, walk.cycle_s())?),
        trunk_torque: Magnitude::of(cycle.samples.iter().map(|sample| sample.forces[tilt])),
        slip: worst_slip(&cycle.feet(STRIDES_OF_SLIP * cycle.samples.len()), cycle.step_s, 0),
        flight_s: cycle.step_s * (0..rows).filter(|row| !feet.iter().any(|foot| foot.loaded(*row))).count() as f64,
        steps_hz: 1.0 / cycle.step_s,
        ..WalkReport::of_plan(settings, &found.human, &walk)
    };
    let states = kept.states(settings, &walk);
    Ok(SyntheticWalk {
        trajectory,
        loads: loads(&feet, 0..rows, &times),
        efforts: efforts(&found.solution, &frame_times)?,
        states: states.periods,
        state_changes: states.changes,
        torques: Vec::new(),
        report,
        human: found.human,
        walk,
    })
}

/// Number of cycles that are searched for a whole stance of each foot.
const STRIDES_OF_SLIP: usize = 3;

fn trajectory(model: &Model, solution: &Solution, start_s: f64, grid: TimeGrid) -> Result<Trajectory, TrajectoryError> {
    let count = model.coordinates().len();
    let mut columns = vec![[(); 3].map(|()| Vec::with_capacity(grid.frames)); count];
    let mut posture = [(); 3].map(|()| vec![0.0; count]);
    for time_s in grid.times() {
        solution.write(start_s + time_s, &mut posture);
        for (coordinate, column) in columns.iter_mut().enumerate() {
            for (series, values) in column.iter_mut().zip(&posture) {
                series.push(values[coordinate]);
            }
        }
    }
    Trajectory::new(model, grid, columns)
}

/// Generalised forces at some times, one column per coordinate.
fn efforts(solution: &Solution, times_s: &[f64]) -> Result<Vec<Vec<f64>>, SyntheticError> {
    let samples = solution.samples(times_s).map_err(OptimalWalkError::from)?;
    let count = solution.problem().model.coordinates().len();
    Ok((0..count).map(|c| samples.iter().map(|sample| sample.forces[c]).collect()).collect())
}

/// One cycle of the forces under the feet; every cycle has the same, a stride further on.
struct Cycle<'a> {
    found: &'a OptimalWalk,
    samples: Vec<Sample>,
    step_s: f64,
    stride: Vec3,
}

impl<'a> Cycle<'a> {
    /// Samples one cycle from a time on, at least as often as `rate_hz`.
    fn new(found: &'a OptimalWalk, walk: &Walk, start_s: f64, rate_hz: f64) -> Result<Cycle<'a>, SyntheticError> {
        let rows = (walk.cycle_s() * rate_hz).ceil() as usize;
        let step_s = walk.cycle_s() / rows as f64;
        let times: Vec<f64> = (0..rows).map(|row| start_s + step_s * row as f64).collect();
        let samples = found.solution.samples(&times).map_err(OptimalWalkError::from)?;
        Ok(Cycle { found, samples, step_s, stride: Vec3::new(walk.speed() * walk.cycle_s(), 0.0, 0.0) })
    }

    /// Number of the coordinate that turns the root in the sagittal plane.
    fn root_turning(&self) -> usize {
        let model = &self.found.human.model;
        let turns = |id: &CoordinateId| model.coordinates()[id.index()].kind == CoordinateKind::Rotation;
        model.coordinate_ids().find(turns).map_or(0, CoordinateId::index)
    }

    /// Ground reactions on the feet in some rows.
    fn feet(&self, rows: usize) -> [FootRecord; 2] {
        let soles = &self.found.problem.problem.soles;
        let friction = self.found.problem.problem.shoes.dynamic_friction;
        Side::BOTH.map(|side| {
            let own: Vec<(usize, &ContactSphere)> =
                soles.iter().enumerate().filter(|(_, sole)| sole.side == side).collect();
            let [body, toes] = bodies(&self.found.human, side);
            let mut foot = FootRecord::new(body.unwrap_or(BodyId(0)), toes, rows);
            for row in 0..rows {
                let (cycles, at) = (row / self.samples.len(), row % self.samples.len());
                foot.begin_row();
                for (sphere, sole) in &own {
                    let contact = &self.samples[at].contacts[*sphere];
                    let force = ContactForce {
                        surfaces: (*sphere, soles.len()),
                        point: contact.place + self.stride * cycles as f64,
                        normal: Vec3::y(),
                        gap: contact.height_m,
                        force: contact.force,
                        normal_force: contact.force.y,
                        slip: Vec3::new(contact.slip[0], 0.0, contact.slip[1]),
                    };
                    foot.add(&force, sole.body, friction);
                }
                foot.end_row();
            }
            foot
        })
    }
}

/// The body that carries the heel of a foot, and its other body with soles, the toes.
fn bodies(human: &Human, side: Side) -> [Option<BodyId>; 2] {
    let mut own = human.soles.iter().filter(|sole| sole.side == side).map(|sole| sole.body);
    let heel = own.next();
    [heel, own.find(|body| Some(*body) != heel)]
}
