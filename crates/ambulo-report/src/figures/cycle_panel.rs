//! Draws one quantity over the gait cycle: normative band, single cycles (thin), means (thick), foot off, infeasible
//! parts.

use super::Mark;
use super::axes::{Axes, AxisWords, range};
use super::sheet::Slot;
use super::svg::{Drawing, Stroke};
use crate::clinical::{ClinicalGroup, ClinicalQuantity};
use crate::normative::NormativeBand;
use crate::style::Style;
use ambulo::model::Side;
use ambulo::motion::interpolate;
use ambulo_results::CycleRow;

/// Maximum number of cycles drawn per side; means are over all.
pub(super) const MOST_CYCLES: usize = 30;
/// Height of the ticks at foot off, as a share of the panel's.
const TICK: f64 = 0.06;
/// Thickness of the bars at the bottom [pt].
const BAR: f64 = 1.5;

/// A row of `cycles.csv` with clinical sign and unit.
#[derive(Debug, Clone)]
struct Curve<'a> {
    row: &'a CycleRow,
    values: Vec<f64>,
}

/// The content of a panel.
#[derive(Debug, Clone)]
pub(super) struct CyclePanel<'a> {
    pub(super) quantity: ClinicalQuantity,
    pub(super) band: Option<NormativeBand>,
    curves: Vec<Curve<'a>>,
}

impl<'a> CyclePanel<'a> {
    pub(super) fn new(
        quantity: ClinicalQuantity,
        rows: &'a [CycleRow],
        mass_kg: f64,
        band: Option<NormativeBand>,
    ) -> CyclePanel<'a> {
        let of_quantity = rows.iter().filter(|row| row.quantity == quantity.columns[row.side]);
        let curve = |row: &'a CycleRow| {
            let factor = quantity.factor(mass_kg, row.side);
            Curve { row, values: row.values.iter().map(|x| factor * x).collect() }
        };
        let curves = of_quantity.map(curve).collect();
        CyclePanel { quantity, band, curves }
    }

    fn of_side(&self, side: Side) -> Vec<&Curve<'a>> {
        self.curves.iter().filter(|curve| curve.row.side == side).collect()
    }

    /// The mean over the cycles of a side; `None` without cycles.
    pub(super) fn mean(&self, side: Side) -> Option<Vec<f64>> {
        let curves = self.of_side(side);
        let length = curves.iter().map(|curve| curve.values.len()).min()?;
        Some((0..length).map(|i| curves.iter().map(|c| c.values[i]).sum::<f64>() / curves.len() as f64).collect())
    }

    /// Number of cycles of a side.
    pub(super) fn cycles(&self, side: Side) -> usize {
        self.of_side(side).len()
    }

    /// Whether some cycles of a side are left out.
    pub(super) fn is_thinned(&self) -> bool {
        Side::BOTH.iter().any(|side| self.cycles(*side) > MOST_CYCLES)
    }

    /// Describes the panel for screen readers.
    pub(super) fn description(&self) -> String {
        let of_side = |side: Side| {
            let mean = self.mean(side)?;
            let low = mean.iter().copied().fold(f64::INFINITY, f64::min);
            let high = mean.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            Some(format!("{side} {low:.2} to {high:.2}"))
        };
        let sides: Vec<String> = Side::BOTH.into_iter().filter_map(of_side).collect();
        let ClinicalQuantity { title, unit, positive, .. } = self.quantity;
        format!("{title} ({unit}, {positive} positive): mean {}.", sides.join(", "))
    }

    /// Range of the ordinate, including curves, band and zero.
    fn range(&self) -> [f64; 2] {
        let least = match self.quantity.group {
            ClinicalGroup::Kinematics => 10.0,
            ClinicalGroup::Moments => 0.2,
            ClinicalGroup::Powers => 0.5,
            ClinicalGroup::Ground => 0.1,
        };
        let curves = self.curves.iter().flat_map(|curve| curve.values.iter().copied());
        let band = self.band.iter().flat_map(|b| b.mean.iter().zip(&b.sd)).flat_map(|(m, sd)| [m - sd, m + sd]);
        range(curves.chain(band).chain([0.0]), least)
    }

    pub(super) fn draw(&self, drawing: &mut Drawing, style: &Style, slot: Slot, marks: &[Mark]) {
        let axes = Axes::new(slot.place, [0.0, 100.0], self.range());
        let mut attributes = vec![("id", self.quantity.id.to_owned())];
        attributes.extend(axes.attributes());
        drawing.open(&self.description(), &attributes);
        if let Some(band) = &self.band {
            draw_band(drawing, style, &axes, &band.mean, &band.sd);
        }
        axes.draw_ground(drawing, style);
        for side in Side::BOTH {
            self.draw_cycles(drawing, style, &axes, side);
        }
        for side in Side::BOTH {
            self.draw_mean(drawing, style, &axes, side);
        }
        self.draw_marks(drawing, style, &axes, marks);
        let unit = self.quantity.unit.replace("N.m", "N·m");
        let words = AxisWords {
            title: self.quantity.title,
            unit: &unit,
            directions: [self.quantity.positive, self.quantity.negative],
            abscissa: slot.named.then_some("gait cycle (%)"),
            legend_height: slot.legend_height,
        };
        axes.draw_frame(drawing, style, words);
        drawing.close();
    }

    fn draw_cycles(&self, drawing: &mut Drawing, style: &Style, axes: &Axes<'_>, side: Side) {
        let curves = self.of_side(side);
        let stroke =
            Stroke { opacity: style.cycle_opacity, ..Stroke::solid(&style.side(side).color, style.lines_pt.cycle) };
        let every = curves.len().div_ceil(MOST_CYCLES).max(1);
        // A single cycle is its own mean.
        for curve in curves.iter().step_by(every).filter(|_| curves.len() > 1) {
            drawing.polyline(&placed(axes, &curve.values), stroke, &tags(side, "cycle", curve.row.cycle));
        }
        let [_, top, _, bottom] = axes.place;
        let height = TICK * (bottom - top);
        // Ticks of the left foot are above ticks of the right, so that both are visible at the same percentage.
        let from = bottom - if side == Side::Right { 0.0 } else { height };
        for off in curves.iter().step_by(every).filter_map(|curve| curve.row.foot_off_percent) {
            let stroke =
                Stroke { opacity: style.cycle_opacity.max(0.6), ..Stroke::solid(stroke.color, style.lines_pt.tick) };
            drawing.line([axes.x(off), from], [axes.x(off), from - height], stroke);
        }
    }

    fn draw_mean(&self, drawing: &mut Drawing, style: &Style, axes: &Axes<'_>, side: Side) {
        let Some(mean) = self.mean(side) else { return };
        let dash = dashes(style, side);
        let stroke = Stroke { dash: &dash, ..Stroke::solid(&style.side(side).color, style.lines_pt.mean) };
        let count = self.of_side(side).len();
        drawing.polyline(&placed(axes, &mean), stroke, &tags(side, "mean", count));
    }

    fn draw_marks(&self, drawing: &mut Drawing, style: &Style, axes: &Axes<'_>, marks: &[Mark]) {
        let stroke = Stroke::solid(&style.infeasible.color, style.lines_pt.infeasible);
        let bottom = axes.place[3];
        for curve in &self.curves {
            for mark in marks.iter().filter(|mark| mark.side == curve.row.side && mark.cycle == curve.row.cycle) {
                let attributes = tags(mark.side, "infeasible", mark.cycle);
                match &mark.quantity {
                    Some(column) if *column == self.quantity.columns[mark.side] => {
                        let points = within(&curve.values, mark.percent).map(|point| axes.at(point));
                        drawing.polyline(&points.collect::<Vec<_>>(), stroke, &attributes);
                    }
                    Some(_) => {}
                    None => {
                        let y = bottom - if mark.side == Side::Right { 1.1 } else { 3.0 };
                        let points = mark.percent.map(|percent| [axes.x(percent), y]);
                        drawing.polyline(&points, Stroke { width: BAR, ..stroke }, &attributes);
                    }
                }
            }
        }
    }
}

/// Lengths of dashes and gaps of a side's mean [pt].
pub(super) fn dashes(style: &Style, side: Side) -> Vec<f64> {
    style.side(side).dash.iter().map(|widths| widths * style.lines_pt.mean).collect()
}

fn tags(side: Side, role: &str, number: usize) -> [(&'static str, String); 3] {
    let number = if role == "mean" { ("data-cycles", number.to_string()) } else { ("data-cycle", number.to_string()) };
    [("data-side", side.letter().to_owned()), ("data-role", role.to_owned()), number]
}

/// The area within one standard deviation of the mean.
pub(super) fn draw_band(drawing: &mut Drawing, style: &Style, axes: &Axes<'_>, mean: &[f64], sd: &[f64]) {
    let percent = |i: usize| 100.0 * i as f64 / (mean.len().max(2) - 1) as f64;
    let edge = |sign: f64| {
        let values = mean.iter().zip(sd).enumerate();
        values.map(move |(i, (mean, sd))| axes.at([percent(i), mean + sign * sd])).collect::<Vec<_>>()
    };
    let mut corners = edge(1.0);
    corners.extend(edge(-1.0).into_iter().rev());
    drawing.polygon(&corners, &style.band.color, style.band.opacity, &[("data-role", "band".to_owned())]);
}

fn placed(axes: &Axes<'_>, values: &[f64]) -> Vec<[f64; 2]> {
    let last = (values.len().max(2) - 1) as f64;
    values.iter().enumerate().map(|(i, y)| axes.at([100.0 * i as f64 / last, *y])).collect()
}

/// The curve between two percentages, with linearly interpolated ends.
fn within(values: &[f64], [from, to]: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    let percents: Vec<f64> = (0..values.len()).map(|i| i as f64).collect();
    let between: Vec<f64> = percents.iter().copied().filter(|p| (from..to).contains(p)).collect();
    let wanted: Vec<f64> = std::iter::once(from).chain(between).chain([to]).collect();
    wanted
        .into_iter()
        .map(move |percent| [percent, interpolate(&percents, values, percent)])
        .collect::<Vec<_>>()
        .into_iter()
}
