//! The curves of the page: small panels in a grid, with one legend for all of them.

use super::super::{ANGLES, CONTACT, ComparedSession, KINETICS, Session, SessionQuantity, Spread};
use super::legend::Legend;
use crate::figures::{FigureError, LineLook, PanelArea, PanelLine, ProfileBars, ProfileFigure, SessionPanel};
use crate::html::escaped;
use crate::style::Style;
use ambulo::model::Side;
use ambulo::study::session::{CycleForces, PooledCurve, SessionCycle, depends_on_forces, pooled};
use std::fmt::Write;

/// Width of the line of one cycle [pt], and its opacity.
const CYCLE_WIDTH: f64 = 0.5;
const CYCLE_OPACITY: f64 = 0.45;
/// Dots of a line of predicted forces, in points.
const DOTTED: [f64; 2] = [0.9, 1.3];

/// Angles; moments, powers and ground forces; or loads of the joints with muscles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    Angles,
    Kinetics,
    Contact,
}

impl Part {
    pub(super) const ALL: [Part; 3] = [Part::Angles, Part::Kinetics, Part::Contact];

    fn words(self) -> &'static str {
        self.of(["Joint angles", "Joint moments, powers and ground forces", "Joint contact loads"])
    }

    fn id(self) -> &'static str {
        self.of(["angles", "kinetics", "contact"])
    }

    fn of<T>(self, [angles, kinetics, contact]: [T; 3]) -> T {
        match self {
            Part::Angles => angles,
            Part::Kinetics => kinetics,
            Part::Contact => contact,
        }
    }

    /// The quantities that the session has, in the order of the panels.
    fn quantities(self, compared: &ComparedSession) -> Vec<SessionQuantity> {
        let own = self.of([ANGLES.as_slice(), KINETICS.as_slice(), CONTACT.as_slice()]);
        compared.shown().into_iter().filter(|quantity| own.contains(quantity)).collect()
    }
}

/// Draws the panels of a session.
pub(super) struct Figures<'a> {
    pub(super) compared: &'a ComparedSession,
    pub(super) style: &'a Style,
}

impl Figures<'_> {
    fn session(&self) -> &Session {
        &self.compared.session
    }

    /// A panel with the band of the reference group and without lines.
    fn panel(&self, quantity: SessionQuantity) -> SessionPanel {
        let words = quantity.wording();
        SessionPanel {
            id: quantity.id,
            title: words.title,
            unit: words.unit,
            directions: words.directions.map(short),
            scale: quantity.scale,
            band: self.compared.norm(quantity.id).cloned(),
            areas: Vec::new(),
            lines: Vec::new(),
            foot_offs: [Vec::new(), Vec::new()],
        }
    }

    /// The line of a mean: the left one has dashes.
    fn mean_look(&self, side: Side) -> LineLook {
        let line = self.style.side(side);
        self.thick(&line.color, &line.dash)
    }

    fn thick(&self, color: &str, dash: &[f64]) -> LineLook {
        let width = self.style.lines_pt.mean;
        let dash = dash.iter().map(|widths| widths * width).collect();
        LineLook { color: color.to_owned(), width, opacity: 1.0, dash }
    }

    /// The line of a cycle: dots where its forces are predicted.
    fn cycle_look(&self, side: Side, is_predicted: bool) -> LineLook {
        let dash = if is_predicted { DOTTED.to_vec() } else { Vec::new() };
        LineLook { color: self.style.side(side).color.clone(), width: CYCLE_WIDTH, opacity: CYCLE_OPACITY, dash }
    }

    fn tick_look(&self, side: Side) -> LineLook {
        let width = self.style.lines_pt.tick;
        LineLook { color: self.style.side(side).color.clone(), width, opacity: 0.7, dash: Vec::new() }
    }

    /// The line of the earlier session (0) and of this one (1).
    fn session_look(&self, k: usize) -> LineLook {
        let line = self.style.sessions.get(k).unwrap_or(&self.style.right);
        self.thick(&line.color, &line.dash)
    }

    /// The one legend of all panels.
    pub(super) fn legend(&self) -> String {
        let has_predicted = self.session().cycles.iter().any(|cycle| cycle.forces == CycleForces::Predicted);
        let mut legend = Legend::default();
        legend.line(&self.mean_look(Side::Right), "right, mean");
        legend.line(&self.mean_look(Side::Left), "left, mean");
        legend.line(&self.cycle_look(Side::Right, false), "a cycle");
        if has_predicted {
            legend.line(&self.cycle_look(Side::Right, true), "a cycle with predicted forces");
        }
        if self.compared.earlier.is_some() {
            legend.line(&self.session_look(0), "before, mean");
            legend.line(&self.session_look(1), "after, mean");
        }
        legend.patch(&self.style.right.color, self.style.uncertainty_opacity, "± 1 standard deviation of the cycles");
        legend.tick(&self.tick_look(Side::Right), "foot off");
        if !self.compared.norms.short.is_empty() {
            legend.patch(&self.style.band.color, self.style.band.opacity, &self.compared.norms.short);
        }
        legend.html()
    }

    fn foot_offs(&self) -> [Vec<(f64, LineLook)>; 2] {
        Side::BOTH.map(|side| {
            let own = self.session().cycles.iter().filter(|cycle| cycle.side == side && cycle.excluded.is_none());
            own.filter_map(|cycle| Some((cycle.foot_off_percent?, self.tick_look(side)))).collect()
        })
    }

    /// Every cycle that counts as a thin line, with the mean and standard deviation of each side.
    pub(super) fn means(&self, part: Part) -> Result<String, FigureError> {
        let mut counts = Counts::default();
        let panels = part.quantities(self.compared).into_iter().map(|quantity| {
            let mut panel = self.panel(quantity);
            panel.foot_offs = self.foot_offs();
            for side in Side::BOTH {
                let Some(found) = pooled(&self.session().cycles, quantity.id, side) else { continue };
                counts.add(side.to_string(), &found);
                let look = self.mean_look(side);
                panel.areas.extend(area(&found, &look.color, self.style.uncertainty_opacity));
                panel.lines.extend(self.cycles_of(quantity, side));
                panel.lines.push(PanelLine { values: found.statistics.mean, look, role: "mean" });
            }
            panel
        });
        let panels: Vec<SessionPanel> = panels.collect();
        grid(&Grid { id: &format!("mean-{}", part.id()), title: part.words(), note: &counts.words() }, &panels)
    }

    fn cycles_of(&self, quantity: SessionQuantity, side: Side) -> Vec<PanelLine> {
        let own = self.session().cycles.iter().filter(|cycle| cycle.side == side && cycle.excluded.is_none());
        let line = |cycle: &SessionCycle| {
            let dotted = depends_on_forces(quantity.id) && cycle.forces == CycleForces::Predicted;
            let values = cycle.curves.get(quantity.id)?.clone();
            Some(PanelLine { values, look: self.cycle_look(cycle.side, dotted), role: "cycle" })
        };
        own.filter_map(line).collect()
    }

    /// The most representative cycle of each side.
    pub(super) fn representative(&self, part: Part) -> Result<String, FigureError> {
        let found = self.session().representative();
        let panels = part.quantities(self.compared).into_iter().map(|quantity| {
            let mut panel = self.panel(quantity);
            for (side, best) in found.cycles.iter() {
                let values = best.and_then(|k| self.session().cycles[k].curves.get(quantity.id).cloned());
                let look = self.mean_look(side);
                panel.lines.extend(values.map(|values| PanelLine { values, look, role: "representative" }));
            }
            panel
        });
        let named = |side: Side| {
            let cycle = &self.session().cycles[found.cycles[side]?];
            let forces = if part == Part::Angles { String::new() } else { format!(", forces {}", cycle.forces.word()) };
            Some(format!("{side}: {}, cycle {}{forces}", self.session().name(cycle.trial), cycle.number))
        };
        let note = Side::BOTH.into_iter().filter_map(named).collect::<Vec<_>>().join("; ");
        let panels: Vec<SessionPanel> = panels.collect();
        grid(&Grid { id: &format!("representative-{}", part.id()), title: part.words(), note: &note }, &panels)
    }

    /// Means of one side before and after.
    pub(super) fn change(&self, part: Part, side: Side) -> Result<String, FigureError> {
        let Some(before) = self.compared.earlier.as_ref() else { return Ok(String::new()) };
        let mut counts = Counts::default();
        let panels = part.quantities(self.compared).into_iter().map(|quantity| {
            let mut panel = self.panel(quantity);
            for (k, (session, words)) in [(before, "before"), (self.session(), "after")].into_iter().enumerate() {
                let Some(found) = pooled(&session.cycles, quantity.id, side) else { continue };
                counts.add(words.to_owned(), &found);
                let look = self.session_look(k);
                panel.areas.extend(area(&found, &look.color, self.style.uncertainty_opacity));
                panel.lines.push(PanelLine { values: found.statistics.mean, look, role: words });
            }
            panel
        });
        let panels: Vec<SessionPanel> = panels.collect();
        let title = format!("{}, {side} side: before and after", part.words());
        grid(&Grid { id: &format!("change-{}-{side}", part.id()), title: &title, note: &counts.words() }, &panels)
    }

    /// The movement analysis profile.
    pub(super) fn profile(&self) -> Option<ProfileFigure> {
        let profile = self.session().summary.profile.as_ref()?;
        let score = |spread: Option<Spread>| spread.map(|spread| (spread.mean, spread.sd));
        let mut bars: Vec<ProfileBars> = profile
            .variables
            .iter()
            .map(|variable| {
                let title = super::super::quantities::named(&variable.quantity).map_or("", |q| q.wording().title);
                let (first, second) = title.split_once(' ').unwrap_or((title, ""));
                ProfileBars {
                    name: [first, second].map(str::to_owned),
                    sides: [score(variable.right), score(variable.left)],
                    expected: variable.expected,
                }
            })
            .collect();
        bars.push(ProfileBars {
            name: ["GPS", ""].map(str::to_owned),
            sides: [score(profile.right), score(profile.left)],
            expected: profile.expected,
        });
        Some(ProfileFigure {
            title: "Movement analysis profile".to_owned(),
            caption: "Distance of each angle from the mean of the reference group, root mean square over the cycle."
                .to_owned(),
            bars,
            legend: ["right", "left", "expected of a person of the reference group"].map(str::to_owned),
        })
    }
}

/// A direction in a word that leaves room for the other one along the ordinate.
fn short(direction: &'static str) -> &'static str {
    match direction {
        "dorsiflexion" | "dorsiflexor" => "dorsi",
        "plantarflexion" | "plantarflexor" => "plantar",
        other => other,
    }
}

/// Numbers of cycles behind the means of a figure, by name and source of the forces.
#[derive(Default)]
struct Counts(Vec<(String, usize)>);

impl Counts {
    fn add(&mut self, name: String, found: &PooledCurve) {
        let source = found.forces.map_or(String::new(), |forces| format!(" with {} forces", forces.word()));
        let entry = (format!("{name}{source}"), found.statistics.count);
        if !self.0.contains(&entry) {
            self.0.push(entry);
        }
    }

    fn words(&self) -> String {
        let words: Vec<String> = self.0.iter().map(|(name, count)| format!("{name} {count}")).collect();
        if words.is_empty() { String::new() } else { format!("Cycles: {}.", words.join(", ")) }
    }
}

/// Name, title and note of a grid of panels.
struct Grid<'a> {
    id: &'a str,
    title: &'a str,
    note: &'a str,
}

/// Panels with their title; nothing without lines.
fn grid(grid: &Grid<'_>, panels: &[SessionPanel]) -> Result<String, FigureError> {
    if panels.iter().all(|panel| panel.lines.is_empty()) {
        return Ok(String::new());
    }
    let mut html = format!(
        "<section class=\"curves\" id=\"{}\"><h3>{}</h3>\n<p class=\"soft\">{}</p>\n<div class=\"panels\">\n",
        grid.id,
        escaped(grid.title),
        escaped(grid.note)
    );
    for panel in panels {
        let _ = writeln!(html, "<figure>{}</figure>", panel.svg(grid.id)?);
    }
    html += "</div>\n";
    let widened: Vec<&str> = panels.iter().filter(|panel| panel.is_widened()).map(|panel| panel.title).collect();
    if !widened.is_empty() {
        let _ = writeln!(
            html,
            "<p class=\"soft\">Scale larger than usual, because curves leave the usual one: {}.</p>",
            escaped(&widened.join(", "))
        );
    }
    Ok(html + "</section>\n")
}

/// The area within one standard deviation.
fn area(found: &PooledCurve, color: &str, opacity: f64) -> Option<PanelArea> {
    let sd = found.statistics.sd.as_ref()?;
    let edge = |sign: f64| found.statistics.mean.iter().zip(sd).map(|(mean, sd)| mean + sign * sd).collect();
    Some(PanelArea { low: edge(-1.0), high: edge(1.0), color: color.to_owned(), opacity })
}
