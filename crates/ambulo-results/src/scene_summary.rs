//! `summary.json` of a simulated scene (docs/OUTPUTS.md).

use crate::force_unit::ForceUnit;
use crate::summary::PeakSummary;
use ambulo::findings::{Finding, Findings};
use ambulo::simulation::scene::{IntegratorReason, RunStatistics, Scene, SceneFrame};
use ambulo::simulation::{FigureWalked, Integrator, Owner, SceneVerdict};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The summary of one run. Keys that do not apply to a run are `null`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SceneSummary {
    /// Version of the program.
    pub version: String,
    /// Identifies the run: SHA-256 of version, options and the content of the input files. Empty until files are
    /// written.
    #[serde(default)]
    pub run_id: String,
    /// SHA-256 of every other file of the run but `timings.json`, by name.
    #[serde(default)]
    pub files: BTreeMap<String, String>,
    /// Input files.
    pub input: SceneInput,
    /// Title of the scene.
    pub title: Option<String>,
    /// Numbers of bodies, joints and shapes.
    pub world: WorldSummary,
    /// The integrator.
    pub integrator: Integrator,
    /// Why it is this one; `null` in folders of earlier versions.
    #[serde(default)]
    pub integrator_reason: Option<IntegratorReason>,
    /// Time step [s].
    pub step_s: f64,
    /// Number of time steps in this run.
    pub steps: usize,
    /// First and last instant of this run [s].
    pub window_s: [f64; 2],
    /// Number of output instants (rows of the tables).
    pub frames: usize,
    /// Energies at the output instants [J].
    pub energy: EnergySummary,
    /// Largest constraint error of a joint or closure at the output instants [m].
    pub joint_error_max_m: f64,
    /// Contacts at the output instants.
    pub contacts: ContactSummary,
    /// Extremes of the effort (moment or force) of every coordinate.
    pub peaks: Vec<PeakSummary>,
    /// Convergence of the solver.
    pub convergence: ConvergenceSummary,
    /// Warnings and notes.
    pub findings: Vec<Finding>,
    /// How far each walking figure came, and whether it fell; empty without walking figures.
    #[serde(default)]
    pub walked: Vec<FigureWalked>,
    /// Whether a person could do the motion of the walking figures; `null` without walking figures.
    pub verdict: Option<SceneVerdict>,
    /// Empty: durations are in `timings.json`. Folders of earlier versions have them here [ms].
    #[serde(default)]
    pub timing_ms: BTreeMap<String, f64>,
}

/// Input files.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SceneInput {
    /// The scene file.
    pub scene: String,
    /// Models and recordings that the scene uses.
    pub files: Vec<String>,
    /// The saved state that was resumed.
    pub resumed: Option<String>,
}

/// Numbers of bodies, joints and shapes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WorldSummary {
    /// Bodies that forces move, including those of figures.
    pub bodies: usize,
    /// Joints of the kinematic trees at the end.
    pub joints: usize,
    /// Joints that close loops, active or not.
    pub closures: usize,
    /// Obstacles, which forces do not move.
    pub obstacles: usize,
    /// Figures made from OpenSim models.
    pub figures: usize,
    /// Shapes with contact.
    pub surfaces: usize,
    /// Mass of all bodies [kg].
    pub mass_kg: f64,
}

/// Energies [J].
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EnergySummary {
    /// Total at the first instant.
    pub start_j: f64,
    /// Total at the last instant.
    pub end_j: f64,
    /// Lowest total.
    pub lowest_j: f64,
    /// Highest total.
    pub highest_j: f64,
    /// Highest kinetic energy.
    pub kinetic_max_j: f64,
}

/// Contacts.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ContactSummary {
    /// Largest number of simultaneously loaded contact points.
    pub points_max: usize,
    /// Largest normal force at one point [N].
    pub normal_force_max_n: f64,
    /// Largest overlap [m].
    pub overlap_max_m: f64,
    /// Largest total force of obstacles on bodies [N].
    pub obstacles_force_max_n: f64,
    /// Collisions found within steps of the integrator `runge-kutta`.
    pub impacts: usize,
}

/// Convergence of the solver over all time steps.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ConvergenceSummary {
    /// Mean number of tree solves per time step.
    pub iterations_mean: f64,
    /// Largest number of tree solves in a time step.
    pub iterations_max: usize,
    /// Mean number of factorisations per time step.
    pub factorizations_mean: f64,
    /// Largest relative residual of a time step.
    pub residual_max: f64,
    /// Time steps whose residual is above the tolerance.
    pub not_converged: usize,
}

/// Collects the extremes of a run frame by frame.
#[derive(Debug, Clone, Default)]
pub struct SceneExtremes {
    frames: usize,
    start_s: f64,
    energy: EnergySummary,
    joint_error: f64,
    contacts: ContactSummary,
    /// By joint and coordinate, in the order of the world.
    efforts: Vec<PeakSummary>,
}

impl SceneExtremes {
    /// Adds one instant.
    pub fn add(&mut self, frame: &SceneFrame<'_>) {
        let total = frame.energy.total();
        let time_s = frame.scene.state().time_s;
        if self.frames == 0 {
            self.start_s = time_s;
            self.energy =
                EnergySummary { start_j: total, lowest_j: total, highest_j: total, ..EnergySummary::default() };
        }
        self.frames += 1;
        let energy = &mut self.energy;
        energy.end_j = total;
        (energy.lowest_j, energy.highest_j) = (energy.lowest_j.min(total), energy.highest_j.max(total));
        energy.kinetic_max_j = energy.kinetic_max_j.max(frame.energy.kinetic);
        self.joint_error = self.joint_error.max(frame.scene.largest_joint_error());
        self.contacts.impacts += frame.impacts.len();
        self.add_contacts(frame);
        self.add_efforts(frame, time_s);
    }

    fn add_contacts(&mut self, frame: &SceneFrame<'_>) {
        let Some(forces) = &frame.forces else { return };
        let (mut points, mut sum) = (0, ambulo::spatial::Vec3::zeros());
        for contact in &forces.contacts {
            self.contacts.overlap_max_m = self.contacts.overlap_max_m.max(-contact.gap);
            self.contacts.normal_force_max_n = self.contacts.normal_force_max_n.max(contact.normal_force);
            points += usize::from(contact.normal_force > 0.0);
            let owner = |surface: usize| frame.scene.world().surfaces[surface].owner;
            match (owner(contact.surfaces.0), owner(contact.surfaces.1)) {
                (_, Owner::Obstacle(_)) => sum += contact.force,
                (Owner::Obstacle(_), _) => sum -= contact.force,
                _ => {}
            }
        }
        self.contacts.points_max = self.contacts.points_max.max(points);
        self.contacts.obstacles_force_max_n = self.contacts.obstacles_force_max_n.max(sum.norm());
    }

    fn add_efforts(&mut self, frame: &SceneFrame<'_>, time_s: f64) {
        let Some(forces) = &frame.forces else { return };
        let world = frame.scene.world();
        for (joint, efforts) in world.joints.iter().zip(&forces.efforts) {
            for (k, effort) in efforts.iter().enumerate() {
                let quantity = format!("{}/{}", joint.name, joint.kind.coordinate_names()[k]);
                self.peak(quantity, ForceUnit::of_rotation(joint.kind.turns(k)), *effort, time_s);
            }
        }
        let figures = frame.scene.generalized_forces(forces);
        for ((name, figure), values) in frame.scene.figure_names().zip(&world.figures).zip(figures) {
            let columns = figure.model.force_names().into_iter().zip(figure.model.coordinates());
            for ((column, coordinate), [_, _, force]) in columns.zip(values) {
                let unit = ForceUnit::of_rotation(coordinate.kind.force_suffix() == "moment");
                self.peak(format!("{name}/{column}"), unit, force, time_s);
            }
        }
    }

    fn peak(&mut self, quantity: String, unit: ForceUnit, value: f64, time_s: f64) {
        match self.efforts.iter_mut().find(|peak| peak.quantity == quantity) {
            Some(peak) => {
                if value > peak.max {
                    (peak.max, peak.max_at_s) = (value, time_s);
                }
                if value < peak.min {
                    (peak.min, peak.min_at_s) = (value, time_s);
                }
            }
            None => self.efforts.push(PeakSummary {
                quantity,
                unit,
                max: value,
                max_at_s: time_s,
                min: value,
                min_at_s: time_s,
            }),
        }
    }

    /// The summary of a finished run.
    #[must_use]
    pub fn summary(
        self,
        scene: &Scene,
        statistics: &RunStatistics,
        input: SceneInput,
        findings: &Findings,
    ) -> SceneSummary {
        let world = scene.world();
        let each = |count: usize| count as f64 / statistics.steps.max(1) as f64;
        SceneSummary {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            run_id: String::new(),
            files: BTreeMap::new(),
            input,
            title: Some(scene.title().to_owned()).filter(|title| !title.is_empty()),
            world: WorldSummary {
                bodies: world.bodies.len(),
                joints: world.joints.len(),
                closures: world.closures.len(),
                obstacles: world.obstacles.len(),
                figures: world.figures.len(),
                surfaces: world.surfaces.len(),
                mass_kg: world.mass(),
            },
            integrator: scene.settings().integrator,
            integrator_reason: Some(scene.integrator_reason()),
            step_s: scene.settings().step_s,
            steps: statistics.steps,
            window_s: [self.start_s, scene.state().time_s],
            frames: self.frames,
            energy: self.energy,
            joint_error_max_m: self.joint_error,
            contacts: self.contacts,
            peaks: self.efforts,
            convergence: ConvergenceSummary {
                iterations_mean: each(statistics.iterations),
                iterations_max: statistics.most_iterations,
                factorizations_mean: each(statistics.factorizations),
                residual_max: statistics.largest_residual,
                not_converged: statistics.not_converged,
            },
            findings: findings.as_slice().to_vec(),
            walked: Vec::new(),
            verdict: None,
            timing_ms: BTreeMap::new(),
        }
    }
}
