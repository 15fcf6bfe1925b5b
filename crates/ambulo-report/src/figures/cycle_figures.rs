//! Draws the figures over the gait cycle from the rows of `cycles.csv`.

use super::cycle_panel::{CyclePanel, MOST_CYCLES, dashes};
use super::sheet::{Sample, Sheet};
use super::svg::Stroke;
use super::{FigureError, Mark};
use crate::clinical::{ClinicalGroup, ClinicalNames, ClinicalQuantity, clinical_quantities, moves};
use crate::normative;
use crate::style::{Style, style};
use ambulo::model::Side;
use ambulo_results::Convention;
use ambulo_results::CycleRow;
use ambulo_results::OutputFile;
use std::ops::Range;

/// The data of the figures over the gait cycle.
#[derive(Debug, Clone, Copy)]
pub struct CycleFigures<'a> {
    /// The rows of `cycles.csv`.
    pub rows: &'a [CycleRow],
    /// Coordinates that measure clinical movements.
    pub names: &'a ClinicalNames,
    /// How the angles of pelvis and hips in the rows are measured.
    pub convention: Convention,
    /// Body mass that moments and powers are divided by [kg].
    pub mass_kg: f64,
    /// Caption: subject, mass and speed.
    pub caption: &'a str,
    /// Infeasible parts.
    pub marks: &'a [Mark],
    /// V / sqrt(g L); `None` if the speed is not known: there are no bands then.
    pub speed_dimensionless: Option<f64>,
}

/// One figure: file, title, which quantities, how they are arranged.
struct Plan {
    name: &'static str,
    title: &'static str,
    groups: &'static [ClinicalGroup],
    /// The quantities to show, in this order; all of the groups if empty.
    only: &'static [&'static str],
    one_column: bool,
    columns: usize,
    panel_height: f64,
}

const PLANS: [Plan; 6] = [
    Plan {
        name: "kinematics.svg",
        title: "Joint angles",
        groups: &[ClinicalGroup::Kinematics],
        only: &[],
        one_column: false,
        columns: 3,
        panel_height: 88.0,
    },
    Plan {
        name: "moments.svg",
        title: "Net joint moments",
        groups: &[ClinicalGroup::Moments],
        only: &[],
        one_column: false,
        columns: 3,
        panel_height: 98.0,
    },
    Plan {
        name: "powers.svg",
        title: "Joint powers",
        groups: &[ClinicalGroup::Powers],
        only: &[],
        one_column: false,
        columns: 3,
        panel_height: 98.0,
    },
    Plan {
        name: "ground_forces.svg",
        title: "Ground reaction forces",
        groups: &[ClinicalGroup::Ground],
        only: &[],
        one_column: false,
        columns: 3,
        panel_height: 98.0,
    },
    Plan {
        name: "sagittal_2col.svg",
        title: "Sagittal plane: angles, moments, powers",
        groups: &[ClinicalGroup::Kinematics, ClinicalGroup::Moments, ClinicalGroup::Powers],
        only: &[
            "hip_flexion_angle",
            "hip_flexion_moment",
            "hip_flexion_power",
            "knee_flexion_angle",
            "knee_flexion_moment",
            "knee_flexion_power",
            "ankle_dorsiflexion_angle",
            "ankle_dorsiflexion_moment",
            "ankle_dorsiflexion_power",
        ],
        one_column: false,
        columns: 3,
        panel_height: 92.0,
    },
    Plan {
        name: "sagittal_1col.svg",
        title: "Sagittal plane: moments, powers",
        groups: &[ClinicalGroup::Moments, ClinicalGroup::Powers],
        only: &[
            "hip_flexion_moment",
            "hip_flexion_power",
            "knee_flexion_moment",
            "knee_flexion_power",
            "ankle_dorsiflexion_moment",
            "ankle_dorsiflexion_power",
        ],
        one_column: true,
        columns: 2,
        panel_height: 84.0,
    },
];

/// Arranges panels in rows; if the pelvis has its own row, hip and trunk also begin a row.
fn rows(panels: &[CyclePanel<'_>], columns: usize) -> Vec<Range<usize>> {
    let central = |number: usize| panels[number].quantity.central;
    let pelvis = (0..panels.len()).take_while(|number| central(*number)).count();
    let breaks = |number: usize| pelvis == columns && central(number) && !central(number - 1);
    let mut rows: Vec<Range<usize>> = Vec::new();
    for number in 0..panels.len() {
        match rows.last_mut() {
            Some(row) if row.len() < columns && !breaks(number) => row.end = number + 1,
            _ => rows.push(number..number + 1),
        }
    }
    rows
}

impl CycleFigures<'_> {
    /// The figures for which there are rows: `figures/kinematics.svg`, `moments.svg`, `powers.svg`, `ground_forces.svg`
    /// in the width of two columns of a journal, and the sagittal plane in the width of two and of one.
    ///
    /// # Errors
    /// A style that cannot be read.
    pub fn files(&self) -> Result<Vec<OutputFile<'static>>, FigureError> {
        let figures = PLANS.iter().map(|plan| Ok(self.figure(plan)?.map(|svg| (plan.name, svg))));
        let drawn = figures.collect::<Result<Vec<_>, FigureError>>()?;
        let file = |(name, svg): (&str, String)| OutputFile::new(format!("figures/{name}"), svg.into_bytes());
        Ok(drawn.into_iter().flatten().map(file).collect())
    }

    fn figure(&self, plan: &Plan) -> Result<Option<String>, FigureError> {
        let style = style().map_err(|e| FigureError { name: plan.name, reason: e.to_string() })?;
        let panels = self.panels(plan);
        if panels.is_empty() {
            return Ok(None);
        }
        let dash = dashes(style, Side::Left);
        let widths = style.widths_mm;
        let sheet = Sheet {
            style,
            title: plan.title,
            caption: self.caption,
            width_mm: if plan.one_column { widths.one_column } else { widths.two_columns },
            rows: rows(&panels, plan.columns),
            panel_height: plan.panel_height,
            legend: self.legend(style, &panels, &dash),
            notes: self.notes(&panels),
            panel_legends: Vec::new(),
            description: panels.iter().map(CyclePanel::description).collect::<Vec<_>>().join(" "),
        };
        Ok(Some(sheet.draw(|drawing, slot| panels[slot.number].draw(drawing, style, slot, self.marks))))
    }

    fn panels(&self, plan: &Plan) -> Vec<CyclePanel<'_>> {
        let mut quantities = clinical_quantities(self.names, |name| self.rows.iter().any(|row| row.quantity == name));
        quantities.retain(|quantity| plan.groups.contains(&quantity.group));
        if !plan.only.is_empty() {
            quantities.retain(|quantity| plan.only.contains(&quantity.id));
            quantities.sort_by_key(|quantity| plan.only.iter().position(|id| *id == quantity.id));
        }
        // Leaves out sideways forces of a figure that moves in a plane, and locked joints.
        quantities.retain(|q| self.rows.iter().any(|row| q.has_column(&row.quantity) && moves(row.unit, &row.values)));
        let speed = self.speed_dimensionless.filter(|_| !self.runs());
        let band = |id: &str| speed.and_then(|speed| normative::band(id, speed, self.convention));
        let panel = |quantity: ClinicalQuantity| {
            let band = band(quantity.id);
            CyclePanel::new(quantity, self.rows, self.mass_kg, band)
        };
        quantities.into_iter().map(panel).collect()
    }

    /// Whether there are flight phases: the feet leave the ground before the middle of their cycles.
    fn runs(&self) -> bool {
        let offs: Vec<f64> = self.rows.iter().filter_map(|row| row.foot_off_percent).collect();
        !offs.is_empty() && offs.iter().sum::<f64>() < 50.0 * offs.len() as f64
    }

    fn legend<'s>(&self, style: &'s Style, panels: &[CyclePanel<'_>], dash: &'s [f64]) -> Vec<(Sample<'s>, String)> {
        let mut legend = Vec::new();
        let cycles = |side: Side| panels.iter().map(|panel| panel.cycles(side)).max().unwrap_or(0);
        for side in Side::BOTH {
            let dash = if side == Side::Left { dash } else { &[] };
            let stroke = Stroke { dash, ..Stroke::solid(&style.side(side).color, style.lines_pt.mean) };
            match cycles(side) {
                0 => {}
                1 => legend.push((Sample::Line(stroke), format!("{side}, 1 cycle"))),
                several => legend.push((Sample::Line(stroke), format!("{side}, mean of {several} cycles"))),
            }
        }
        let first = if cycles(Side::Right) > 0 { &style.right.color } else { &style.left.color };
        if Side::BOTH.iter().any(|side| cycles(*side) > 1) {
            let stroke = Stroke { opacity: style.cycle_opacity, ..Stroke::solid(first, style.lines_pt.cycle) };
            legend.push((Sample::Line(stroke), "single cycles".to_owned()));
        }
        if self.rows.iter().any(|row| row.foot_off_percent.is_some()) {
            legend.push((Sample::Tick(Stroke::solid(first, style.lines_pt.tick)), "foot off".to_owned()));
        }
        if panels.iter().any(|panel| panel.band.is_some()) {
            legend.push((Sample::Patch(&style.band.color, style.band.opacity), "children, mean ± SD".to_owned()));
        }
        if !self.marks.is_empty() {
            let stroke = Stroke::solid(&style.infeasible.color, style.lines_pt.infeasible);
            legend.push((Sample::Line(stroke), "red: not feasible".to_owned()));
        }
        legend
    }

    fn notes(&self, panels: &[CyclePanel<'_>]) -> Vec<String> {
        let mut notes: Vec<String> = Vec::new();
        let bands = panels.iter().filter_map(|panel| panel.band.as_ref());
        if let Some(shortest) = bands.clone().min_by_key(|band| band.citation.len()) {
            notes.push(format!("Grey band: {}", shortest.citation));
            let longest = bands.max_by_key(|band| band.citation.len());
            let shifted = longest.and_then(|band| band.citation.strip_prefix(&shortest.citation));
            if let Some(shifted) = shifted.filter(|text| !text.trim().is_empty()) {
                notes.push(format!("Grey band of pelvic tilt and hip flexion: {}", shifted.trim()));
            }
        } else if self.runs() {
            notes.push(
                "No normative band: stance is shorter than half of the cycle, so this is not walking.".to_owned(),
            );
        } else if self.speed_dimensionless.is_none() {
            notes.push("No normative band: the walking speed is not known.".to_owned());
        }
        if panels.iter().any(CyclePanel::is_thinned) {
            notes.push(format!("Of more than {MOST_CYCLES} cycles per side, only some are drawn; means are over all."));
        }
        notes
    }
}
