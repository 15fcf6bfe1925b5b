//! The part of `summary.json` for synthetic walks.

use ambulo::model::Model;
use ambulo::optimal::DeviceEffort;
use ambulo::simulation::consistent_walk::Magnitude;
use ambulo::simulation::synthetic::{CorrectionReport, PaceReached, PredictionReport, Progress, WalkReport};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// How a synthetic walk was made.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WalkSummary {
    /// Name of the gait.
    pub gait: String,
    /// Style of the joint curves: `knots` or `1997`.
    pub style: String,
    /// Mode: `optimal`, `predict`, `corrected` or `paper`.
    pub mode: String,
    /// Name of the table of segments.
    pub figure: String,
    /// Requested speed [m/s].
    pub speed_asked_m_s: f64,
    /// The same, dimensionless: V/√(gL).
    pub speed_dimensionless: f64,
    /// Step length, from the contact of one foot to that of the other [m].
    pub step_length_m: f64,
    /// Cadence [steps/min].
    pub cadence_steps_min: f64,
    /// Duration of a cycle [s].
    pub cycle_s: f64,
    /// Leg length, hip to floor in standing [m].
    pub leg_length_m: f64,
    /// Changes of pace on the way; empty for a walk at constant pace.
    #[serde(default)]
    pub pace_changes: Vec<PaceChangeSummary>,
    /// Number of adjusted parameters; `null` in paper mode. This and the following lines on the correction are of the
    /// first pace.
    pub parameters_adjusted: Option<usize>,
    /// Change of the angle of each coordinate [deg]; `null` in paper mode.
    pub adjustment_deg: Option<BTreeMap<String, Magnitude>>,
    /// Deviation of the path of the pelvis from uniform motion [mm]; `null` in paper mode.
    pub pelvis_path_mm: Option<PelvisPath>,
    /// Residual force at the root of the planned motion [N]; `null` in paper mode.
    pub lacking_force_n: Option<Magnitude>,
    /// Residual moment at the root of the planned motion [N.m]; `null` in paper mode.
    pub lacking_moment_nm: Option<Magnitude>,
    /// Progress of the solver by stage; `null` in paper mode.
    pub solver: Option<Vec<Progress>>,
    /// Conditions and effort of a predicted walk; `null` in the other modes.
    #[serde(default)]
    pub prediction: Option<WalkPredictionSummary>,
    /// External torque that supports the trunk [N.m].
    pub trunk_torque_nm: Magnitude,
    /// The same per kilogram of body mass [N.m/kg].
    pub trunk_torque_nm_kg: Magnitude,
    /// Largest displacement of a loaded sole in the worst stance [mm]; `null` without a whole stance.
    pub foot_slip_mm: Option<f64>,
    /// Length of the path of that displacement [mm].
    pub foot_slip_path_mm: Option<f64>,
    /// Time without a loaded foot [s].
    pub flight_s: f64,
    /// Impacts of rigid soles on the ground.
    pub impacts: usize,
    /// Largest impulse of an impact [N.s].
    pub largest_impact_n_s: f64,
    /// Largest difference of the mid-hip's speed from one cycle to the next [m/s], where the pace is constant.
    pub speed_drift_m_s: f64,
    /// Time steps of the simulator per second [Hz].
    pub simulator_hz: f64,
    /// Time steps whose contacts were not solved to the tolerance.
    pub unsolved_steps: usize,
}

/// Conditions and effort of a predicted walk.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WalkPredictionSummary {
    /// Slope of the ground [%], positive uphill. The axes of all results are those of the ground: x along the slope, y
    /// perpendicular to it.
    pub slope_percent: f64,
    /// Mass of the load [kg].
    pub load_kg: f64,
    /// Where it is carried: `back`, `hands` or `pelvis`; `null` without a load.
    #[serde(default)]
    pub load_place: Option<String>,
    /// Shares of strength that are left, by coordinate; joints with all their strength are not listed.
    pub strength: BTreeMap<String, f64>,
    /// Coordinates with devices, whose moments are parts of the joint moments; `moments_biological.sto` is without
    /// them.
    pub devices: Vec<String>,
    /// Work of devices and body at these joints.
    #[serde(default)]
    pub device_work: Vec<DeviceWorkSummary>,
    /// Asked distance between the paths of both feet [m].
    pub step_width_m: Option<f64>,
    /// Cadence of people at this speed [steps/min], where the walk chose its own; `null` where it has theirs.
    #[serde(default)]
    pub usual_cadence_steps_min: Option<f64>,
    /// Metabolic power per kilogram of the body without load, by a simple formula: positive joint work / 0.25 +
    /// negative joint work / 1.2 + 1.4 W/kg.
    pub metabolic_power_w_kg: f64,
    /// The same per distance [J/kg/m].
    pub cost_of_transport_j_kg_m: f64,
    /// Metabolic power of the walk without the devices, at the same speed and cadence [W/kg]; `null` where none is worn
    /// and where there is no such walk.
    #[serde(default)]
    pub metabolic_power_without_devices_w_kg: Option<f64>,
    /// Why there is no walk without the devices; `null` where there is one, or no device.
    #[serde(default)]
    pub no_walk_without_devices: Option<String>,
}

impl WalkPredictionSummary {
    fn new(report: &PredictionReport, model: &Model, speed: f64) -> WalkPredictionSummary {
        let (conditions, unassisted) = (&report.conditions, report.unassisted.as_ref());
        let alone = unassisted.and_then(|found| found.as_ref().ok());
        let work = |(number, effort)| {
            let without = alone.and_then(|alone| alone.body_work.get(number)).copied();
            DeviceWorkSummary::new(effort, without, model)
        };
        WalkPredictionSummary {
            slope_percent: 100.0 * conditions.slope,
            load_kg: conditions.load.map_or(0.0, |load| load.mass),
            load_place: conditions.load.map(|load| load.place.name().to_owned()),
            strength: conditions.strengths.iter().cloned().collect(),
            devices: conditions.devices.iter().map(|device| device.coordinate.clone()).collect(),
            step_width_m: conditions.step_width_m,
            device_work: report.devices.iter().enumerate().map(work).collect(),
            usual_cadence_steps_min: report.usual_cadence,
            metabolic_power_w_kg: report.metabolic_power,
            cost_of_transport_j_kg_m: report.metabolic_power / speed,
            metabolic_power_without_devices_w_kg: alone.map(|alone| alone.metabolic_power),
            no_walk_without_devices: unassisted.and_then(|found| found.as_ref().err()).map(ToString::to_string),
        }
    }

    /// Metabolic power with the devices and without them, in words; `None` where none is worn.
    #[must_use]
    pub fn without_devices(&self) -> Option<String> {
        if let Some(reason) = &self.no_walk_without_devices {
            return Some(format!("without it: {reason}"));
        }
        let (power, with) = (self.metabolic_power_without_devices_w_kg?, self.metabolic_power_w_kg);
        // Without the sign of a zero that rounding leaves.
        let change = (1000.0 * (with / power - 1.0)).round() / 10.0 + 0.0;
        Some(format!("metabolic power {with:.2} W/kg, without it {power:.2} ({change:+.1} %)"))
    }

    /// Work of devices and body in words, one text for all joints with the same numbers.
    #[must_use]
    pub fn device_words(&self) -> Vec<String> {
        let mut joints: Vec<(String, String)> = Vec::new();
        for work in &self.device_work {
            let words = work.words();
            match joints.iter_mut().find(|(_, known)| *known == words) {
                Some((names, _)) => *names = format!("{names} and {}", work.coordinate),
                None => joints.push((work.coordinate.clone(), words)),
            }
        }
        joints.into_iter().map(|(names, words)| format!("{names}: {words}")).collect()
    }

    /// The conditions in words: slope, load, weak joints, devices, width of steps, free cadence. Empty for level
    /// walking without any of them.
    #[must_use]
    pub fn conditions(&self) -> Vec<String> {
        let uphill = if self.slope_percent > 0.0 { "uphill" } else { "downhill" };
        let is_sloped = self.slope_percent.abs() > 0.0;
        let place = self.load_place.as_deref().map_or_else(String::new, |place| format!(" ({place})"));
        let listed =
            |names: Vec<String>, what: &str| (!names.is_empty()).then(|| format!("{what} {}", names.join(", ")));
        let weak = self.strength.iter().map(|(name, share)| format!("{name} {:.0} %", 100.0 * share)).collect();
        let parts = [
            is_sloped.then(|| format!("{} % {uphill}", rounded(self.slope_percent.abs()))),
            (self.load_kg > 0.0).then(|| format!("load of {} kg{place}", rounded(self.load_kg))),
            listed(weak, "strength of"),
            listed(self.devices.clone(), "devices at"),
            self.step_width_m.map(|width| format!("steps {} m wide", rounded(width))),
            self.usual_cadence_steps_min.map(|usual| {
                format!(
                    "its own cadence, where people have {usual:.0} \
                steps/min"
                )
            }),
        ];
        parts.into_iter().flatten().collect()
    }
}

/// Work of devices and body at a joint in a cycle, per kilogram of the body without load.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DeviceWorkSummary {
    /// Coordinate of the joint.
    pub coordinate: String,
    /// Positive and negative work of the devices [J/kg].
    pub device_j_kg: [f64; 2],
    /// Positive and negative work of the rest of the joint moment, that of muscles and tissue [J/kg].
    pub body_j_kg: [f64; 2],
    /// The same in the walk without the devices, at the same speed and cadence; `null` where there is none.
    #[serde(default)]
    pub body_without_device_j_kg: Option<[f64; 2]>,
}

impl DeviceWorkSummary {
    fn new(effort: &DeviceEffort, without: Option<[f64; 2]>, model: &Model) -> DeviceWorkSummary {
        DeviceWorkSummary {
            coordinate: model.coordinates()[effort.coordinate.index()].name.clone(),
            device_j_kg: effort.device_work,
            body_j_kg: effort.body_work,
            body_without_device_j_kg: without,
        }
    }

    /// The work in words, without the joint.
    fn words(&self) -> String {
        let [[device, device_taken], [body, body_taken]] = [self.device_j_kg, self.body_j_kg];
        let without = self.body_without_device_j_kg.map_or_else(String::new, |[alone, alone_taken]| {
            format!(", without it {alone:.3} and {:.3}", -alone_taken)
        });
        format!(
            "the device does {device:.3} and takes {:.3} J/kg in a cycle, muscles and tissue do {body:.3} and take \
             {:.3}{without}",
            -device_taken, -body_taken
        )
    }
}

/// As it was typed: without the digits of a conversion.
fn rounded(value: f64) -> f64 {
    (1e6 * value).round() / 1e6
}

/// A change of pace.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PaceChangeSummary {
    /// Start [s].
    pub start_s: f64,
    /// Duration [s].
    pub duration_s: f64,
    /// Speed after the change [m/s]; 0 if the figure then stands.
    pub speed_m_s: f64,
    /// Step length after the change [m].
    pub step_length_m: f64,
    /// Cadence after the change [steps/min].
    pub cadence_steps_min: f64,
}

/// Deviation of a path, forward and up.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PelvisPath {
    /// Forward, from constant speed.
    pub forward: Magnitude,
    /// Upward, from the mean height.
    pub up: Magnitude,
}

impl PaceChangeSummary {
    fn of(change: &PaceReached) -> PaceChangeSummary {
        PaceChangeSummary {
            start_s: change.start_s,
            duration_s: change.duration_s,
            speed_m_s: change.speed,
            step_length_m: change.step_length,
            cadence_steps_min: 60.0 * change.step_frequency,
        }
    }
}

impl WalkSummary {
    /// Makes the summary from the report of a walk.
    #[must_use]
    pub fn new(model: &Model, report: &WalkReport) -> WalkSummary {
        let correction = report.correction.as_ref();
        let degrees = 1.0_f64.to_degrees();
        let adjusted = |c: &CorrectionReport| -> BTreeMap<String, Magnitude> {
            c.adjustment.angles.iter().map(|(name, change)| (name.clone(), change.times(degrees))).collect()
        };
        let path = |c: &CorrectionReport| {
            let [forward, up] = c.adjustment.pelvis.map(|change| change.times(1e3));
            PelvisPath { forward, up }
        };
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
            pace_changes: report.changes.iter().map(PaceChangeSummary::of).collect(),
            parameters_adjusted: correction.map(|c| c.parameters),
            adjustment_deg: correction.map(adjusted),
            pelvis_path_mm: correction.map(path),
            lacking_force_n: correction.map(|c| c.residual[0]),
            lacking_moment_nm: correction.map(|c| c.residual[1]),
            solver: correction.map(|c| c.progress.clone()),
            prediction: report.prediction.as_ref().map(|made| WalkPredictionSummary::new(made, model, report.speed)),
            trunk_torque_nm: report.trunk_torque,
            trunk_torque_nm_kg: report.trunk_torque.times(1.0 / model.mass()),
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
