//! The figures of the page: all cycles, means, representative cycles, the profile, before and after.

use super::super::{ANGLES, CONTACT, ComparedSession, KINETICS, Session, SessionQuantity};
use crate::figures::{
    LineLook, PanelArea, PanelLine, ProfileBars, ProfileFigure, SessionFigure, SessionPanel, SessionSample,
};
use crate::style::{Color, Style};
use ambulo::model::Side;
use ambulo::study::session::{CycleForces, PooledCurve, SessionCycle, depends_on_forces, pooled};

/// Width of the line of one cycle [pt].
const CYCLE_WIDTH: f64 = 0.7;
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
        match self {
            Part::Angles => "Joint angles",
            Part::Kinetics => "Joint moments, powers and ground forces",
            Part::Contact => "Joint contact loads",
        }
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

/// Draws the figures of a session.
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
            directions: words.directions,
            scale: quantity.scale,
            band: self.compared.norm(quantity.id).cloned(),
            areas: Vec::new(),
            lines: Vec::new(),
            foot_offs: [Vec::new(), Vec::new()],
            legend: Vec::new(),
        }
    }

    fn figure(
        &self,
        name: &'static str,
        title: String,
        caption: String,
        panels: Vec<SessionPanel>,
    ) -> Option<SessionFigure> {
        let mut legend = Vec::new();
        if panels.iter().any(|panel| panel.band.is_some()) {
            let band = SessionSample::Patch(self.style.band.color.clone(), self.style.band.opacity);
            legend.push((band, self.compared.norms.short.clone()));
        }
        let empty = panels.iter().all(|panel| panel.lines.is_empty());
        (!empty).then(|| SessionFigure { name, title, caption, panels, legend, notes: Vec::new() })
    }

    /// The line of a mean: the left one has dashes.
    fn mean_look(&self, side: Side) -> LineLook {
        let line = self.style.side(side);
        let width = self.style.lines_pt.mean;
        let dash = line.dash.iter().map(|widths| widths * width).collect();
        LineLook { color: line.color.clone(), width, opacity: 1.0, dash }
    }

    /// The line of a cycle: dots where its forces are predicted.
    fn cycle_look(&self, side: Side, is_predicted: bool) -> LineLook {
        let dash = if is_predicted { DOTTED.to_vec() } else { Vec::new() };
        LineLook { color: self.style.side(side).color.clone(), width: CYCLE_WIDTH, opacity: 0.75, dash }
    }

    fn tick_look(&self, side: Side) -> LineLook {
        let width = self.style.lines_pt.tick;
        LineLook { color: self.style.side(side).color.clone(), width, opacity: 0.7, dash: Vec::new() }
    }

    fn foot_offs(&self, is_shown: impl Fn(usize, &SessionCycle) -> bool) -> [Vec<(f64, LineLook)>; 2] {
        Side::BOTH.map(|side| {
            let own =
                self.session().cycles.iter().enumerate().filter(|(k, cycle)| cycle.side == side && is_shown(*k, cycle));
            own.filter_map(|(_, cycle)| Some((cycle.foot_off_percent?, self.tick_look(side)))).collect()
        })
    }

    fn with_sides(&self, figure: SessionFigure, part: Part) -> SessionFigure {
        let mut legend = vec![
            (SessionSample::Line(self.cycle_look(Side::Right, false)), "right".to_owned()),
            (SessionSample::Line(self.cycle_look(Side::Left, false)), "left".to_owned()),
        ];
        if part != Part::Angles {
            let has_predicted = self.session().cycles.iter().any(|cycle| cycle.forces == CycleForces::Predicted);
            let dotted = (SessionSample::Line(self.cycle_look(Side::Right, true)), "predicted forces".to_owned());
            legend.extend(has_predicted.then_some(dotted));
        }
        legend.push((SessionSample::Tick(self.tick_look(Side::Right)), "foot off".to_owned()));
        legend.extend(figure.legend);
        SessionFigure { legend, ..figure }
    }

    /// Every cycle that counts, one line each.
    pub(super) fn consistency(&self, part: Part) -> Option<SessionFigure> {
        let counts = |cycle: &SessionCycle| cycle.excluded.is_none();
        let panels = part.quantities(self.compared).into_iter().map(|quantity| {
            let own = self.session().cycles.iter().filter(|cycle| counts(cycle));
            let line = |cycle: &SessionCycle| {
                let dotted = depends_on_forces(quantity.id) && cycle.forces == CycleForces::Predicted;
                let values = cycle.curves.get(quantity.id)?.clone();
                Some(PanelLine { values, look: self.cycle_look(cycle.side, dotted), role: "cycle" })
            };
            SessionPanel {
                lines: own.filter_map(line).collect(),
                foot_offs: self.foot_offs(|_, cycle| counts(cycle)),
                ..self.panel(quantity)
            }
        });
        let name = part.of(["all-angles", "all-kinetics", "all-contact"]);
        let title = format!("{}: all cycles", part.words());
        let figure = self.figure(name, title, self.caption(), panels.collect())?;
        Some(self.with_sides(figure, part))
    }

    /// Mean and standard deviation of each side.
    pub(super) fn means(&self, part: Part) -> Option<SessionFigure> {
        let panels = part.quantities(self.compared).into_iter().map(|quantity| {
            let mut panel = self.panel(quantity);
            for side in Side::BOTH {
                let Some(found) = pooled(&self.session().cycles, quantity.id, side) else { continue };
                let look = self.mean_look(side);
                panel.areas.extend(area(&found, &look.color, self.style.uncertainty_opacity));
                panel.legend.push((look.clone(), counted(side, &found)));
                panel.lines.push(PanelLine { values: found.statistics.mean, look, role: "mean" });
            }
            panel
        });
        let name = part.of(["mean-angles", "mean-kinetics", "mean-contact"]);
        let title = format!("{}: mean ± standard deviation", part.words());
        self.figure(name, title, self.caption(), panels.collect())
    }

    /// The most representative cycle of each side.
    pub(super) fn representative(&self, part: Part) -> Option<SessionFigure> {
        let found = self.session().representative();
        let is_best = |k: usize| Side::BOTH.iter().any(|side| found.cycles[*side] == Some(k));
        let panels = part.quantities(self.compared).into_iter().map(|quantity| {
            let mut panel = self.panel(quantity);
            for (side, best) in found.cycles.iter() {
                let Some(cycle) = best.map(|k| &self.session().cycles[k]) else { continue };
                let Some(values) = cycle.curves.get(quantity.id).cloned() else { continue };
                let look = self.mean_look(side);
                if depends_on_forces(quantity.id) {
                    panel.legend.push((look.clone(), format!("{side}, {}", cycle.forces.word())));
                }
                panel.lines.push(PanelLine { values, look, role: "representative" });
            }
            SessionPanel { foot_offs: self.foot_offs(|k, _| is_best(k)), ..panel }
        });
        let named = |side: Side| {
            let cycle = &self.session().cycles[found.cycles[side]?];
            Some(format!("{side}: {}, cycle {}", self.session().name(cycle.trial), cycle.number))
        };
        let caption = Side::BOTH.into_iter().filter_map(named).collect::<Vec<_>>().join("; ");
        let name = part.of(["representative-angles", "representative-kinetics", "representative-contact"]);
        let title = format!("{}: representative cycles", part.words());
        let figure = self.figure(name, title, caption, panels.collect())?;
        let mut legend: Vec<(SessionSample, String)> =
            Side::BOTH.map(|side| (SessionSample::Line(self.mean_look(side)), side.to_string())).to_vec();
        legend.extend(figure.legend);
        Some(SessionFigure { legend, ..figure })
    }

    /// Means of one side before and after.
    pub(super) fn change(&self, part: Part, side: Side) -> Option<SessionFigure> {
        let before = self.compared.earlier.as_ref()?;
        let panels = part.quantities(self.compared).into_iter().map(|quantity| {
            let mut panel = self.panel(quantity);
            for (k, (session, words)) in [(before, "before"), (self.session(), "after")].into_iter().enumerate() {
                let Some(found) = pooled(&session.cycles, quantity.id, side) else { continue };
                let look = self.session_look(k);
                panel.areas.extend(area(&found, &look.color, self.style.uncertainty_opacity));
                let source = found.forces.map_or(String::new(), |forces| format!(", {}", forces.word()));
                panel.legend.push((look.clone(), format!("{words}, {} cycles{source}", found.statistics.count)));
                panel.lines.push(PanelLine { values: found.statistics.mean, look, role: words });
            }
            panel
        });
        let name = match (part, side) {
            (Part::Angles, Side::Right) => "change-angles-right",
            (Part::Angles, Side::Left) => "change-angles-left",
            (Part::Kinetics, Side::Right) => "change-kinetics-right",
            (Part::Kinetics, Side::Left) => "change-kinetics-left",
            (Part::Contact, Side::Right) => "change-contact-right",
            (Part::Contact, Side::Left) => "change-contact-left",
        };
        let title = format!("{}, {side} side: before and after, mean ± standard deviation", part.words());
        self.figure(name, title, self.change_caption(before), panels.collect())
    }

    fn change_caption(&self, before: &Session) -> String {
        let days = |session: &Session| session.summary.days().unwrap_or_else(|| "day not stated".to_owned());
        format!("Before: {}. After: {}.", days(before), days(self.session()))
    }

    fn session_look(&self, k: usize) -> LineLook {
        let width = self.style.lines_pt.mean;
        let line = self.style.sessions.get(k).unwrap_or(&self.style.right);
        let dash = line.dash.iter().map(|widths| widths * width).collect();
        LineLook { color: line.color.clone(), width, opacity: 1.0, dash }
    }

    /// The movement analysis profile.
    pub(super) fn profile(&self) -> Option<ProfileFigure> {
        let profile = self.session().summary.profile.as_ref()?;
        let score = |spread: Option<super::super::Spread>| spread.map(|spread| (spread.mean, spread.sd));
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
        let overall = profile
            .overall
            .map_or(String::new(), |overall| format!(" Gait profile score of both sides: {overall:.1} deg."));
        Some(ProfileFigure {
            title: "Movement analysis profile".to_owned(),
            caption: format!(
                "Distance of the angles from the mean of the reference group, root mean square over the cycle.{overall}"
            ),
            bars,
            legend: ["right", "left", "expected of a person of the reference group"].map(str::to_owned),
        })
    }

    /// Person, days, mass and speed, as far as they are known.
    pub(super) fn caption(&self) -> String {
        let summary = &self.session().summary;
        let mass = summary.mass_kg.map(|mass| format!("{mass:.1} kg"));
        let speed = summary.speed_m_s.map(|speed| format!("{:.2} m/s", speed.mean));
        let parts = [summary.person.clone(), summary.days(), mass, speed];
        parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
    }
}

fn counted(side: Side, found: &PooledCurve) -> String {
    let count = match found.statistics.count {
        1 => "1 cycle".to_owned(),
        several => format!("{several} cycles"),
    };
    found.forces.map_or_else(|| format!("{side}, {count}"), |forces| format!("{side}, {count} {}", forces.word()))
}

/// The area within one standard deviation.
fn area(found: &PooledCurve, color: &str, opacity: f64) -> Option<PanelArea> {
    let sd = found.statistics.sd.as_ref()?;
    let edge = |sign: f64| found.statistics.mean.iter().zip(sd).map(|(mean, sd)| mean + sign * sd).collect();
    Some(PanelArea { low: edge(-1.0), high: edge(1.0), color: color.to_owned(), opacity })
}

/// The colour for text about a side.
pub(super) fn color_of(style: &Style, side: Side) -> Color {
    let line = style.side(side);
    Color { color: line.color.clone(), dark: line.dark.clone() }
}
