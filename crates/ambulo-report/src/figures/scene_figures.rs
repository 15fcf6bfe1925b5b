//! Draws the quantities of a simulated scene over time.

use super::FigureError;
use super::chart::{CURVE_COLORS, Chart, ChartAxis, ChartCurve, ChartPanel, CurveForm};
use ambulo::numerics::Order;
use ambulo::numerics::elementary::log10;
use ambulo::simulation::SceneVerdict;
use ambulo::simulation::scene::{Plot, Scene, SceneFrame};
use ambulo_results::OutputFile;
use std::collections::BTreeMap;

/// Width of the figures [mm] and height of one panel [pt].
const WIDTH_MM: f64 = 178.0;
const HEIGHT: f64 = 100.0;
/// Maximum number of curves (one per colour); those with the largest values are drawn.
const MOST_CURVES: usize = CURVE_COLORS.len();
/// Forces along sliding joints below this are rounding errors of free coordinates [N].
const ROUNDING_N: f64 = 1e-6;

/// A quantity over time: instant [s] and value.
type Curve = Vec<[f64; 2]>;

/// Collects the curves of a run frame by frame.
#[derive(Debug, Clone, Default)]
pub struct SceneCurves {
    /// Energies: kinetic, gravity, springs, total [J].
    energy: [Curve; 4],
    /// Iterations and the logarithm of the residual.
    solver: [Curve; 2],
    /// Normal force and friction [N], by pair of owners.
    contacts: BTreeMap<String, [Curve; 2]>,
    /// Whether the coordinate is an angle, its value [rad, m] and effort [N.m, N], by joint and coordinate.
    joints: BTreeMap<(String, &'static str), (bool, [Curve; 2])>,
    /// Place along x, y, z [m], by body.
    bodies: Vec<(String, [Curve; 3])>,
    /// Force and moment, by closure.
    closures: BTreeMap<String, [Curve; 2]>,
}

/// One set of axes.
struct Panel {
    title: &'static str,
    label: &'static str,
    curves: Vec<(String, Curve)>,
}

impl SceneCurves {
    /// Adds one instant.
    pub fn add(&mut self, frame: &SceneFrame<'_>) {
        let (world, state, t) = (frame.scene.world(), frame.scene.state(), frame.scene.state().time_s);
        let e = &frame.energy;
        for (curve, value) in self.energy.iter_mut().zip([e.kinetic, e.gravity, e.springs, e.total()]) {
            curve.push([t, value]);
        }
        if self.bodies.is_empty() {
            self.bodies = world.bodies.iter().map(|body| (body.name.clone(), Default::default())).collect();
        }
        for ((_, axes), pose) in self.bodies.iter_mut().zip(&state.poses) {
            for (axis, x) in axes.iter_mut().zip(pose.translation.iter()) {
                axis.push([t, *x]);
            }
        }
        let Some(forces) = &frame.forces else { return };
        self.solver[0].push([t, forces.convergence.iterations as f64]);
        if forces.convergence.residual > 0.0 {
            self.solver[1].push([t, log10(forces.convergence.residual)]);
        }
        for (number, joint) in world.joints.iter().enumerate() {
            for (k, name) in joint.kind.coordinate_names().iter().enumerate() {
                let (turns, [value, effort]) = self.joints.entry((joint.name.clone(), *name)).or_default();
                *turns = joint.kind.turns(k);
                value.push([t, state.coordinates[number][k]]);
                effort.push([t, forces.efforts[number][k]]);
            }
        }
        for (number, wrench) in &forces.closing {
            let entry = self.closures.entry(world.closures[*number].name.clone()).or_default();
            entry[0].push([t, wrench.force.norm()]);
        }
        self.add_contacts(frame, t);
    }

    fn add_contacts(&mut self, frame: &SceneFrame<'_>, t: f64) {
        let world = frame.scene.world();
        let mut sums: BTreeMap<String, [f64; 2]> = self.contacts.keys().map(|name| (name.clone(), [0.0; 2])).collect();
        for contact in frame.forces.iter().flat_map(|forces| &forces.contacts) {
            if contact.normal_force <= 0.0 {
                continue;
            }
            let owner = |surface: usize| world.owner_name(world.surfaces[surface].owner).to_owned();
            let name = format!("{} on {}", owner(contact.surfaces.0), owner(contact.surfaces.1));
            let sum = sums.entry(name).or_default();
            sum[0] += contact.normal_force;
            sum[1] += (contact.force - contact.normal * contact.normal_force).norm();
        }
        for (name, sum) in sums {
            let entry = self.contacts.entry(name).or_default();
            for (curve, value) in entry.iter_mut().zip(sum) {
                curve.push([t, value]);
            }
        }
    }

    /// The figures that the scene requests, or all kinds if it names none; red bars mark infeasible parts of a walk.
    ///
    /// # Errors
    /// A style that cannot be read.
    pub fn files(
        &self,
        scene: &Scene,
        verdict: Option<&SceneVerdict>,
    ) -> Result<Vec<OutputFile<'static>>, FigureError> {
        let reasons = verdict.into_iter().flat_map(|v| &v.figures).flat_map(|figure| &figure.verdict.reasons);
        let faults: Vec<[f64; 2]> = reasons.map(|reason| reason.time_s).collect();
        let plots = &scene.outputs().plots;
        let all = plots.is_empty();
        let wants = |plot: &Plot| all || plots.contains(plot);
        let title = if scene.title().is_empty() { "Scene" } else { scene.title() };
        let times = &self.energy[0];
        let span = times.first().zip(times.last()).map_or([0.0, 1.0], |(first, last)| [first[0], last[0]]);
        let mut files = Vec::new();
        let mut draw = |name: &'static str, panels: Vec<Panel>| -> Result<(), FigureError> {
            let panels: Vec<Panel> =
                panels.into_iter().filter(|p| p.curves.iter().any(|(_, c)| !c.is_empty())).collect();
            if !panels.is_empty() {
                let svg = figure(name, title, &panels, (span, &faults))?;
                files.push(OutputFile::new(format!("figures/{name}.svg"), svg.into_bytes()));
            }
            Ok(())
        };
        if wants(&Plot::Energy) {
            draw("energy", self.energy_panels())?;
        }
        if plots.contains(&Plot::Solver) {
            draw("solver", self.solver_panels())?;
        }
        if wants(&Plot::Contacts) {
            draw("contacts", self.contact_panels())?;
        }
        let joint =
            |name: &str| all || plots.iter().any(|p| matches!(p, Plot::Joint(j) if scene.joint_name(*j) == name));
        draw("joints", self.joint_panels(joint))?;
        let bodies = &scene.world().bodies;
        let body = |name: &str| all || plots.iter().any(|p| matches!(p, Plot::Body(b) if bodies[*b].name == name));
        draw("bodies", self.body_panels(body, all))?;
        let closures = &scene.world().closures;
        let closure =
            |name: &str| all || plots.iter().any(|p| matches!(p, Plot::Closure(c) if closures[*c].name == name));
        draw("closures", self.closure_panels(closure))?;
        Ok(files)
    }

    fn energy_panels(&self) -> Vec<Panel> {
        let [kinetic, gravity, springs, total] = &self.energy;
        let first = total.first().map_or(0.0, |[_, e]| *e);
        let lift = gravity.first().map_or(0.0, |[_, e]| *e);
        let from = |curve: &[[f64; 2]], zero: f64| curve.iter().map(|[t, e]| [*t, e - zero]).collect::<Curve>();
        let mut curves = vec![
            ("kinetic".to_owned(), kinetic.clone()),
            ("gravity, change since the start".to_owned(), from(gravity, lift)),
        ];
        if springs.iter().any(|[_, e]| *e != 0.0) {
            curves.push(("springs".to_owned(), springs.clone()));
        }
        let change = vec![("total".to_owned(), from(total, first))];
        vec![
            Panel { title: "Energy", label: "energy (J)", curves },
            Panel { title: "Change of the total energy", label: "change (J)", curves: change },
        ]
    }

    fn solver_panels(&self) -> Vec<Panel> {
        let [iterations, residual] = self.solver.clone();
        vec![
            Panel {
                title: "Tree solves per step",
                label: "iterations",
                curves: vec![("iterations".into(), iterations)],
            },
            Panel {
                title: "Relative residual",
                label: "log10 of residual",
                curves: vec![("residual".into(), residual)],
            },
        ]
    }

    fn contact_panels(&self) -> Vec<Panel> {
        let of = |k: usize| largest(self.contacts.iter().map(|(name, curves)| (name.clone(), curves[k].clone())));
        vec![
            Panel { title: "Normal forces", label: "force (N)", curves: of(0) },
            Panel { title: "Friction", label: "force (N)", curves: of(1) },
        ]
    }

    fn joint_panels(&self, wanted: impl Fn(&str) -> bool) -> Vec<Panel> {
        let (value, effort) = (0, 1);
        let of = |turning: bool, which: usize, unit: f64| {
            let chosen = self.joints.iter().filter(|((joint, _), (turns, _))| *turns == turning && wanted(joint));
            largest(chosen.map(|((joint, coordinate), (_, curves))| {
                let plain = matches!(*coordinate, "angle" | "distance");
                let name = if plain { joint.clone() } else { format!("{joint} {coordinate}") };
                (name, curves[which].iter().map(|[t, x]| [*t, unit * x]).collect())
            }))
        };
        let mut pushing = of(false, effort, 1.0);
        pushing.retain(|(_, curve)| curve.iter().any(|[_, force]| force.abs() > ROUNDING_N));
        vec![
            Panel { title: "Joint angles", label: "angle (deg)", curves: of(true, value, 1.0_f64.to_degrees()) },
            Panel { title: "Joint moments", label: "moment (N.m)", curves: of(true, effort, 1.0) },
            Panel { title: "Displacements of sliding joints", label: "distance (m)", curves: of(false, value, 1.0) },
            Panel { title: "Forces along sliding joints", label: "force (N)", curves: pushing },
        ]
    }

    fn body_panels(&self, wanted: impl Fn(&str) -> bool, heights_only: bool) -> Vec<Panel> {
        let of = |axis: usize| {
            let chosen = self.bodies.iter().filter(|(name, _)| wanted(name));
            largest(chosen.map(|(name, axes)| (name.clone(), axes[axis].clone())))
        };
        let height = Panel { title: "Heights of centres of mass", label: "y (m)", curves: of(1) };
        if heights_only {
            return vec![height];
        }
        vec![
            Panel { title: "Centres of mass along x", label: "x (m)", curves: of(0) },
            height,
            Panel { title: "Centres of mass along z", label: "z (m)", curves: of(2) },
        ]
    }

    fn closure_panels(&self, wanted: impl Fn(&str) -> bool) -> Vec<Panel> {
        let chosen = self.closures.iter().filter(|(name, _)| wanted(name));
        let curves = largest(chosen.map(|(name, curves)| (name.clone(), curves[0].clone())));
        vec![Panel { title: "Forces of loop closures", label: "force (N)", curves }]
    }
}

/// The curves with the largest values, in their original order.
fn largest(curves: impl Iterator<Item = (String, Curve)>) -> Vec<(String, Curve)> {
    let mut curves: Vec<(String, Curve)> = curves.collect();
    if curves.len() > MOST_CURVES {
        let size = |curve: &[[f64; 2]]| curve.iter().fold(0.0_f64, |m, [_, y]| m.max(y.abs()));
        let mut sizes: Vec<f64> = curves.iter().map(|(_, curve)| size(curve)).collect();
        sizes.sort_by_number(|value| -value);
        let least = sizes[MOST_CURVES - 1];
        curves.retain(|(_, curve)| size(curve) >= least);
        curves.truncate(MOST_CURVES);
    }
    curves
}

/// Panels below each other over the same time; `faults` are the infeasible times.
fn figure(
    name: &'static str,
    title: &str,
    panels: &[Panel],
    (span, faults): ([f64; 2], &[[f64; 2]]),
) -> Result<String, FigureError> {
    let curve = |((name, points), color): (&(String, Curve), &'static str)| ChartCurve {
        name: name.clone(),
        color,
        form: CurveForm::Line,
        points: points.clone(),
    };
    let time = ChartAxis { range: Some([span[0], span[1].max(span[0] + 1e-9)]), ..ChartAxis::labelled("time (s)") };
    let panel = |panel: &Panel| ChartPanel {
        title: panel.title.to_owned(),
        abscissa: time.clone(),
        ordinate: ChartAxis::labelled(panel.label),
        to_scale: false,
        curves: panel.curves.iter().zip(CURVE_COLORS.into_iter().cycle()).map(curve).collect(),
        infeasible: faults.to_vec(),
    };
    let chart = Chart {
        name,
        title: title.to_owned(),
        caption: String::new(),
        width_mm: WIDTH_MM,
        columns: 1,
        panel_height_pt: HEIGHT,
        panels: panels.iter().map(panel).collect(),
        notes: Vec::new(),
    };
    chart.svg()
}
