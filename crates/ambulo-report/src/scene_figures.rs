//! Figures of a simulated scene: curves over time.

use super::plot::{Area, COLORS, DrawResult, FINE, FigureError, GREY, GRID, RED, font, shown_at};
use ambulo::analysis::SceneVerdict;
use ambulo::simulation::scene::{Frame, Plot, Scene};
use ambulo_results::OutputFile;
use plotters::prelude::*;
use std::collections::BTreeMap;

/// Width and height of one panel as shown, width of the names beside it, and height of the title [px].
const PANEL: (u32, u32) = (700, 230);
const NAMES: u32 = 210;
const TITLE: u32 = 40;
/// More curves than this are not told apart; those with the largest values are drawn.
const MOST_CURVES: usize = COLORS.len();
/// Height of the bar that marks what is not feasible, share of the panel's.
const FAULT_BAR: f64 = 0.03;
/// Forces below this along slides are rounding of coordinates that nothing holds [N].
const ROUNDING_N: f64 = 1e-6;
/// More points than this on a curve are not seen.
const MOST_POINTS: usize = 1500;

/// A quantity over time: (instant [s], value).
type Curve = Vec<(f64, f64)>;

/// What is drawn of one coordinate of a joint.
#[derive(Debug, Clone, Default)]
struct JointCurves {
    /// Whether it is an angle.
    turns: bool,
    /// Value [rad, m].
    value: Curve,
    /// [N.m, N].
    effort: Curve,
}

/// Curves of a run, gathered frame by frame.
#[derive(Debug, Clone, Default)]
pub struct SceneCurves {
    /// Energies: kinetic, gravity, springs, total [J].
    energy: [Curve; 4],
    /// Iterations and the logarithm of the residual.
    solver: [Curve; 2],
    /// By pair of owners: normal force and friction [N].
    contacts: BTreeMap<String, [Curve; 2]>,
    /// By joint and coordinate.
    joints: BTreeMap<(String, &'static str), JointCurves>,
    /// By body: place along x, y, z [m].
    bodies: Vec<(String, [Curve; 3])>,
    /// By closure: force and moment.
    closures: BTreeMap<String, [Curve; 2]>,
}

/// One set of axes.
struct Panel {
    title: &'static str,
    label: &'static str,
    curves: Vec<(String, Curve)>,
}

impl SceneCurves {
    /// Takes in one instant.
    pub fn add(&mut self, frame: &Frame<'_>) {
        let (world, state, t) = (frame.scene.world(), frame.scene.state(), frame.scene.state().time_s);
        let e = &frame.energy;
        for (curve, value) in self.energy.iter_mut().zip([e.kinetic, e.gravity, e.springs, e.total()]) {
            curve.push((t, value));
        }
        if self.bodies.is_empty() {
            self.bodies = world.bodies.iter().map(|body| (body.name.clone(), Default::default())).collect();
        }
        for ((_, axes), pose) in self.bodies.iter_mut().zip(&state.poses) {
            for (axis, x) in axes.iter_mut().zip(pose.translation.iter()) {
                axis.push((t, *x));
            }
        }
        let Some(forces) = &frame.forces else { return };
        self.solver[0].push((t, forces.convergence.iterations as f64));
        if forces.convergence.residual > 0.0 {
            self.solver[1].push((t, forces.convergence.residual.log10()));
        }
        for (number, joint) in world.joints.iter().enumerate() {
            for (k, name) in joint.kind.coordinate_names().iter().enumerate() {
                let entry = self.joints.entry((joint.name.clone(), *name)).or_default();
                entry.turns = joint.kind.turns(k);
                entry.value.push((t, state.coordinates[number][k]));
                entry.effort.push((t, forces.efforts[number][k]));
            }
        }
        for (number, wrench) in &forces.closing {
            let entry = self.closures.entry(world.closures[*number].name.clone()).or_default();
            entry[0].push((t, wrench.force.norm()));
        }
        self.add_contacts(frame, t);
    }

    fn add_contacts(&mut self, frame: &Frame<'_>, t: f64) {
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
                curve.push((t, value));
            }
        }
    }

    /// The figures that the scene asks for, or all kinds if it names none; a red bar where the verdict finds a walk at fault.
    ///
    /// # Errors
    /// A canvas that the plotting library refuses.
    pub fn files(&self, scene: &Scene, verdict: Option<&SceneVerdict>) -> Result<Vec<OutputFile>, FigureError> {
        let reasons = verdict.into_iter().flat_map(|v| &v.figures).flat_map(|figure| &figure.verdict.reasons);
        let faults: Vec<[f64; 2]> = reasons.map(|reason| reason.time_s).collect();
        let plots = &scene.outputs().plots;
        let all = plots.is_empty();
        let wants = |plot: &Plot| all || plots.contains(plot);
        let title = if scene.title().is_empty() { "Scene" } else { scene.title() };
        let times = &self.energy[0];
        let span = times.first().zip(times.last()).map_or((0.0, 1.0), |(first, last)| (first.0, last.0));
        let mut files = Vec::new();
        let mut draw = |name: &'static str, panels: Vec<Panel>| -> Result<(), FigureError> {
            let panels: Vec<Panel> =
                panels.into_iter().filter(|p| p.curves.iter().any(|(_, c)| !c.is_empty())).collect();
            if !panels.is_empty() {
                let svg =
                    figure(title, &panels, span, &faults).map_err(|e| FigureError { name, reason: e.to_string() })?;
                files.push(OutputFile { name: format!("figures/{name}"), bytes: svg.into_bytes() });
            }
            Ok(())
        };
        if wants(&Plot::Energy) {
            draw("energy.svg", self.energy_panels())?;
        }
        if plots.contains(&Plot::Solver) {
            draw("solver.svg", self.solver_panels())?;
        }
        if wants(&Plot::Contacts) {
            draw("contacts.svg", self.contact_panels())?;
        }
        let joint =
            |name: &str| all || plots.iter().any(|p| matches!(p, Plot::Joint(j) if scene.joint_name(*j) == name));
        draw("joints.svg", self.joint_panels(joint))?;
        let bodies = &scene.world().bodies;
        let body = |name: &str| all || plots.iter().any(|p| matches!(p, Plot::Body(b) if bodies[*b].name == name));
        draw("bodies.svg", self.body_panels(body, all))?;
        let closures = &scene.world().closures;
        let closure =
            |name: &str| all || plots.iter().any(|p| matches!(p, Plot::Closure(c) if closures[*c].name == name));
        draw("closures.svg", self.closure_panels(closure))?;
        Ok(files)
    }

    fn energy_panels(&self) -> Vec<Panel> {
        let [kinetic, gravity, springs, total] = &self.energy;
        let first = total.first().map_or(0.0, |(_, e)| *e);
        let lift = gravity.first().map_or(0.0, |(_, e)| *e);
        let from = |curve: &[(f64, f64)], zero: f64| curve.iter().map(|(t, e)| (*t, e - zero)).collect::<Vec<_>>();
        let mut curves =
            vec![("kinetic".to_owned(), kinetic.clone()), ("gravity, from the start".to_owned(), from(gravity, lift))];
        if springs.iter().any(|(_, e)| *e != 0.0) {
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
            Panel { title: "Tree solves a step", label: "iterations", curves: vec![("iterations".into(), iterations)] },
            Panel {
                title: "Residual, relative",
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
        let of = |turning: bool, pick: fn(&JointCurves) -> &Curve, unit: f64| {
            let chosen = self.joints.iter().filter(|((joint, _), curves)| curves.turns == turning && wanted(joint));
            largest(chosen.map(|((joint, coordinate), curves)| {
                let plain = matches!(*coordinate, "angle" | "distance");
                let name = if plain { joint.clone() } else { format!("{joint} {coordinate}") };
                (name, pick(curves).iter().map(|(t, x)| (*t, unit * x)).collect())
            }))
        };
        let mut pushing = of(false, |c| &c.effort, 1.0);
        pushing.retain(|(_, curve)| curve.iter().any(|(_, force)| force.abs() > ROUNDING_N));
        vec![
            Panel { title: "Joint angles", label: "angle (deg)", curves: of(true, |c| &c.value, 1.0_f64.to_degrees()) },
            Panel { title: "Joint moments", label: "moment (N.m)", curves: of(true, |c| &c.effort, 1.0) },
            Panel { title: "Slides", label: "distance (m)", curves: of(false, |c| &c.value, 1.0) },
            Panel { title: "Forces along slides", label: "force (N)", curves: pushing },
        ]
    }

    fn body_panels(&self, wanted: impl Fn(&str) -> bool, heights_only: bool) -> Vec<Panel> {
        let of = |axis: usize| {
            let chosen = self.bodies.iter().filter(|(name, _)| wanted(name));
            largest(chosen.map(|(name, axes)| (name.clone(), axes[axis].clone())))
        };
        let height = Panel { title: "Heights of mass centres", label: "y (m)", curves: of(1) };
        if heights_only {
            return vec![height];
        }
        vec![
            Panel { title: "Mass centres along x", label: "x (m)", curves: of(0) },
            height,
            Panel { title: "Mass centres along z", label: "z (m)", curves: of(2) },
        ]
    }

    fn closure_panels(&self, wanted: impl Fn(&str) -> bool) -> Vec<Panel> {
        let chosen = self.closures.iter().filter(|(name, _)| wanted(name));
        let curves = largest(chosen.map(|(name, curves)| (name.clone(), curves[0].clone())));
        vec![Panel { title: "Forces of closures", label: "force (N)", curves }]
    }
}

/// The curves with the largest values, in the order in which they came.
fn largest(curves: impl Iterator<Item = (String, Curve)>) -> Vec<(String, Curve)> {
    let mut curves: Vec<(String, Curve)> = curves.collect();
    if curves.len() > MOST_CURVES {
        let size = |curve: &[(f64, f64)]| curve.iter().fold(0.0_f64, |m, (_, y)| m.max(y.abs()));
        let mut sizes: Vec<f64> = curves.iter().map(|(_, curve)| size(curve)).collect();
        sizes.sort_by(|a, b| b.total_cmp(a));
        let least = sizes[MOST_CURVES - 1];
        curves.retain(|(_, curve)| size(curve) >= least);
        curves.truncate(MOST_CURVES);
    }
    curves
}

/// Panels one below the other, all over the same time.
fn figure(
    title: &str,
    panels: &[Panel],
    span: (f64, f64),
    faults: &[[f64; 2]],
) -> Result<String, Box<dyn std::error::Error>> {
    let (width, height) = (PANEL.0 + NAMES, TITLE + PANEL.1 * panels.len() as u32);
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (FINE * width, FINE * height)).into_drawing_area();
        root.fill(&WHITE).map_err(|e| e.to_string())?;
        let (top, body) = root.split_vertically(FINE * TITLE);
        top.draw_text(title, &font(15), ((FINE * 14) as i32, (FINE * 12) as i32)).map_err(|e| e.to_string())?;
        if !faults.is_empty() {
            let place = ((FINE * 500) as i32, (FINE * 14) as i32);
            top.draw_text("red: not feasible", &font(11).color(&RED), place).map_err(|e| e.to_string())?;
        }
        for (panel, area) in panels.iter().zip(body.split_evenly((panels.len(), 1))) {
            let (chart, names) = area.split_horizontally(FINE * PANEL.0);
            draw_panel(&chart, panel, span, faults)?;
            draw_names(&names, panel)?;
        }
        root.present().map_err(|e| e.to_string())?;
    }
    Ok(shown_at(&svg, width, height))
}

fn draw_panel(area: &Area<'_>, panel: &Panel, (start, end): (f64, f64), faults: &[[f64; 2]]) -> DrawResult {
    let values = panel.curves.iter().flat_map(|(_, curve)| curve).map(|(_, y)| *y);
    let range = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
    let (low, high) = spread(range);
    let digits = digits(high - low);
    let mut chart = ChartBuilder::on(area)
        .caption(panel.title, font(13))
        .margin(FINE * 8)
        .margin_right(FINE * 16)
        .x_label_area_size(FINE * 34)
        .y_label_area_size(FINE * 58)
        .build_cartesian_2d(start..end.max(start + 1e-9), low..high)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID.stroke_width(FINE))
        .axis_style(GREY.stroke_width(FINE))
        .label_style(font(11))
        .axis_desc_style(font(11))
        .x_labels(8)
        .y_labels(6)
        .x_desc("time (s)")
        .y_desc(panel.label)
        .y_label_formatter(&|y| match digits {
            Some(digits) => format!("{y:.digits$}"),
            None => format!("{y:.1e}"),
        })
        .draw()?;
    if low < 0.0 && high > 0.0 {
        chart.draw_series(LineSeries::new([(start, 0.0), (end, 0.0)], GREY.stroke_width(FINE)))?;
    }
    let bar = low + FAULT_BAR * (high - low);
    chart.draw_series(faults.iter().map(|[from, to]| {
        let [from, to] = [*from, to.max(from + FAULT_BAR * 0.1 * (end - start))].map(|t| t.clamp(start, end));
        Rectangle::new([(from, low), (to, bar)], RED.filled())
    }))?;
    for (number, (_, curve)) in panel.curves.iter().enumerate() {
        let every = curve.len().div_ceil(MOST_POINTS).max(1);
        let thinned: Curve = curve.iter().step_by(every).copied().collect();
        let style = COLORS[number % COLORS.len()].stroke_width(3 * FINE / 2);
        chart.draw_series(LineSeries::new(thinned, style))?;
    }
    Ok(())
}

/// A line and a name for each curve, beside the panel.
fn draw_names(area: &Area<'_>, panel: &Panel) -> DrawResult {
    /// Longer names would leave the figure.
    const LONGEST: usize = 28;
    let at = |x: u32, y: u32| ((FINE * x) as i32, (FINE * y) as i32);
    for (number, (name, _)) in panel.curves.iter().enumerate() {
        let y = 34 + 17 * number as u32;
        let style = COLORS[number % COLORS.len()].stroke_width(2 * FINE);
        area.draw(&PathElement::new(vec![at(0, y + 6), at(20, y + 6)], style))?;
        let mut shown: String = name.chars().take(LONGEST).collect();
        if shown.len() < name.len() {
            shown.push('…');
        }
        area.draw_text(&shown, &font(11), at(26, y))?;
    }
    Ok(())
}

/// A range with a margin; never empty.
fn spread((low, high): (f64, f64)) -> (f64, f64) {
    let least = 1e-12_f64.max(1e-6 * low.abs().max(high.abs()));
    let margin = (0.08 * (high - low)).max(least);
    (low - margin, high + margin)
}

/// Decimals that six labels over a range need; `None` where powers of ten read better.
fn digits(range: f64) -> Option<usize> {
    let decimals = (-(range / 6.0).log10()).ceil().max(0.0);
    (decimals <= 5.0 && range < 1e6).then_some(decimals as usize)
}
