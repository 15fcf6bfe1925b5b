//! The part of `summary.json` that only synthetic walks have.

use ambulo::model::Model;
use ambulo::simulation::consistent_walk::Magnitude;
use ambulo::simulation::synthetic::{CorrectionReport, Progress, WalkReport};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// How a walk was made.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WalkSummary {
    /// Name of the gait.
    pub gait: String,
    /// How its curves run: `knots` or `1997`.
    pub style: String,
    /// `corrected` or `paper`.
    pub mode: String,
    /// Table of the figure's segments.
    pub figure: String,
    /// Speed that the gait asks for [m/s].
    pub speed_asked_m_s: f64,
    /// The same as V/√(gL).
    pub speed_dimensionless: f64,
    /// Contact of one foot to contact of the other [m].
    pub step_length_m: f64,
    /// Steps a minute.
    pub cadence_steps_min: f64,
    /// Duration of a cycle [s].
    pub cycle_s: f64,
    /// Hip to floor, standing [m].
    pub leg_length_m: f64,
    /// How many numbers were adjusted; `null` in paper mode.
    pub parameters_adjusted: Option<usize>,
    /// By coordinate, the change of its angle [deg]; `null` in paper mode.
    pub adjustment_deg: Option<BTreeMap<String, Size>>,
    /// The pelvis' path against even motion [mm]; `null` in paper mode.
    pub pelvis_path_mm: Option<PelvisPath>,
    /// What the plan's root lacks [N]; `null` in paper mode.
    pub lacking_force_n: Option<Size>,
    /// What the plan's root lacks [N.m]; `null` in paper mode.
    pub lacking_moment_nm: Option<Size>,
    /// How the solver got there, by stage; `null` in paper mode.
    pub solver: Option<Vec<SolverStage>>,
    /// Torque that holds the trunk from outside [N.m].
    pub trunk_torque_nm: Size,
    /// The same by kg of body mass [N.m/kg].
    pub trunk_torque_nm_kg: Size,
    /// How far a loaded sole gets from where it stood, in the worst stance [mm]; `null` without a whole stance.
    pub foot_slip_mm: Option<f64>,
    /// Its way there and back [mm].
    pub foot_slip_path_mm: Option<f64>,
    /// Time that no foot is loaded [s].
    pub flight_s: f64,
    /// Impacts of rigid soles on the ground.
    pub impacts: usize,
    /// Largest impulse of an impact [N.s].
    pub largest_impact_n_s: f64,
    /// Largest difference of the mid-hip's speed from one cycle to the next [m/s].
    pub speed_drift_m_s: f64,
    /// Steps of the simulator a second [Hz].
    pub simulator_hz: f64,
    /// Steps whose contacts were not solved to the tolerance.
    pub unsolved_steps: usize,
}

/// Root mean square and largest size.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Size {
    /// Root mean square.
    pub rms: f64,
    /// Largest.
    pub largest: f64,
}

/// A path forwards and up.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PelvisPath {
    /// Against constant speed.
    pub forward: Size,
    /// Against its mean height.
    pub up: Size,
}

/// One stage of the solver.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SolverStage {
    /// Steps taken.
    pub iterations: usize,
    /// Sum of squares at the start.
    pub from: f64,
    /// Sum of squares at the end.
    pub to: f64,
}

impl Size {
    fn new(change: Magnitude, factor: f64) -> Size {
        Size { rms: factor * change.rms, largest: factor * change.largest }
    }
}

impl WalkSummary {
    /// From the report of a walk.
    #[must_use]
    pub fn new(model: &Model, report: &WalkReport) -> WalkSummary {
        let correction = report.correction.as_ref();
        let degrees = 1.0_f64.to_degrees();
        let adjusted = |c: &CorrectionReport| -> BTreeMap<String, Size> {
            c.adjustment.angles.iter().map(|(name, change)| (name.clone(), Size::new(*change, degrees))).collect()
        };
        let path = |c: &CorrectionReport| {
            let [forward, up] = c.adjustment.pelvis.map(|change| Size::new(change, 1e3));
            PelvisPath { forward, up }
        };
        let stage = |p: &Progress| SolverStage { iterations: p.iterations, from: p.from, to: p.to };
        WalkSummary {
            gait: report.gait.clone(),
            style: report.style.name().to_owned(),
            mode: report.mode.name().to_owned(),
            figure: report.figure.name().to_owned(),
            speed_asked_m_s: report.speed,
            speed_dimensionless: report.dimensionless_speed,
            step_length_m: report.step_length,
            cadence_steps_min: 120.0 / report.cycle_s,
            cycle_s: report.cycle_s,
            leg_length_m: report.leg_length,
            parameters_adjusted: correction.map(|c| c.parameters),
            adjustment_deg: correction.map(adjusted),
            pelvis_path_mm: correction.map(path),
            lacking_force_n: correction.map(|c| Size::new(c.residual[0], 1.0)),
            lacking_moment_nm: correction.map(|c| Size::new(c.residual[1], 1.0)),
            solver: correction.map(|c| c.progress.iter().map(stage).collect()),
            trunk_torque_nm: Size::new(report.trunk_torque, 1.0),
            trunk_torque_nm_kg: Size::new(report.trunk_torque, 1.0 / model.mass()),
            foot_slip_mm: report.slip.map(|slip| 1e3 * slip.excursion),
            foot_slip_path_mm: report.slip.map(|slip| 1e3 * slip.path),
            flight_s: report.flight_s,
            impacts: report.impacts.0,
            largest_impact_n_s: report.impacts.1,
            speed_drift_m_s: report.speed_drift,
            simulator_hz: report.steps_hz,
            unsolved_steps: report.unsolved_steps,
        }
    }
}
