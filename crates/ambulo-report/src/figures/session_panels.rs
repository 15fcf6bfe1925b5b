//! Draws curves over the gait cycle on scales that are the same for every session: small multiples for a page.

use super::FigureError;
use super::axes::{ABOVE, Axes, AxisWords, BELOW, LEFT};
use super::cycle_panel::draw_band;
use super::sheet::{Sample, Sheet, Slot};
use super::svg::{Anchor, Drawing, Letters, Stroke, points};
use crate::style::{Style, style};
use ambulo::study::session::NormalCurve;

/// Height of the ticks at foot off, as a share of the panel's.
const TICK: f64 = 0.07;
/// Steps by which a scale grows where a curve leaves it, as a share of its range.
const STEP: f64 = 0.1;
/// Height of the axes [pt]: five rows fit on a printed page.
const HEIGHT: f64 = 76.0;
/// A curve that leaves the scale by less, as a share of its range, changes no scale.
const SLACK: f64 = 0.01;

/// How a line is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct LineLook {
    /// As `#RRGGBB`.
    pub color: String,
    /// Width [pt].
    pub width: f64,
    /// 0 to 1.
    pub opacity: f64,
    /// Lengths of dashes and gaps [pt].
    pub dash: Vec<f64>,
}

impl LineLook {
    fn stroke(&self) -> Stroke<'_> {
        Stroke { color: &self.color, width: self.width, opacity: self.opacity, dash: &self.dash }
    }
}

/// A curve with values at equal distances from 0 to 100 %.
#[derive(Debug, Clone, PartialEq)]
pub struct PanelLine {
    /// The values; a gap is not finite.
    pub values: Vec<f64>,
    /// How the line is drawn.
    pub look: LineLook,
    /// Kind of line, for readers of the file: `cycle`, `mean`.
    pub role: &'static str,
}

/// The area between two curves.
#[derive(Debug, Clone, PartialEq)]
pub struct PanelArea {
    /// The lower curve.
    pub low: Vec<f64>,
    /// The upper curve.
    pub high: Vec<f64>,
    /// As `#RRGGBB`.
    pub color: String,
    /// 0 to 1.
    pub opacity: f64,
}

/// A quantity over the gait cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct SessionPanel {
    /// As in `clinical.csv`, without the side.
    pub id: &'static str,
    /// Title above the axes.
    pub title: &'static str,
    /// Unit of the values.
    pub unit: &'static str,
    /// Meaning of positive and negative values.
    pub directions: [&'static str; 2],
    /// The usual range of the ordinate.
    pub scale: [f64; 2],
    /// The normative band.
    pub band: Option<NormalCurve>,
    /// Areas, below the lines.
    pub areas: Vec<PanelArea>,
    /// The curves.
    pub lines: Vec<PanelLine>,
    /// Foot off [% of the cycle]: the right ones stand on the abscissa, the left ones above them.
    pub foot_offs: [Vec<(f64, LineLook)>; 2],
}

/// Width of a panel; the margins at the left and at the right of its axes [pt]: half of the label `100` at the right.
const WIDTH_MM: f64 = 59.0;
const MARGINS: [f64; 2] = [2.0, 7.0];

impl SessionPanel {
    /// The panel as SVG; `figure` comes first in its name.
    ///
    /// # Errors
    /// A style that cannot be read.
    pub fn svg(&self, figure: &str) -> Result<String, FigureError> {
        let style = style().map_err(|e| FigureError { name: "session", reason: e.to_string() })?;
        let mut drawing = Drawing::new(points(WIDTH_MM), &style.font.family);
        let place = [MARGINS[0] + LEFT, ABOVE, drawing.width() - MARGINS[1], ABOVE + HEIGHT];
        self.draw(&mut drawing, style, Slot { number: 0, place, named: true, legend_height: 0.0 }, figure);
        Ok(drawing.finish(ABOVE + HEIGHT + BELOW, self.title, &self.description(), &style.paper.color))
    }

    fn description(&self) -> String {
        format!("{} over the gait cycle ({}, {} positive).", self.title, self.unit, self.directions[0])
    }

    /// The usual range, with whole steps more at the ends where a curve leaves it.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        let step = STEP * (self.scale[1] - self.scale[0]);
        let lines = self.lines.iter().flat_map(|line| line.values.iter());
        let areas = self.areas.iter().flat_map(|area| area.low.iter().chain(&area.high));
        let finite = lines.chain(areas).copied().filter(|x| x.is_finite());
        let (low, high) = finite.fold((self.scale[0], self.scale[1]), |(low, high), x| (low.min(x), high.max(x)));
        let more = |beyond: f64| step * ((beyond - SLACK * (self.scale[1] - self.scale[0])) / step).ceil().max(0.0);
        [self.scale[0] - more(self.scale[0] - low), self.scale[1] + more(high - self.scale[1])]
    }

    /// Whether a curve leaves the usual range.
    #[must_use]
    pub fn is_widened(&self) -> bool {
        let [low, high] = self.range();
        low < self.scale[0] || high > self.scale[1]
    }

    fn draw(&self, drawing: &mut Drawing, style: &Style, slot: Slot, figure: &str) {
        let axes = Axes::new(slot.place, [0.0, 100.0], self.range());
        let mut attributes = vec![("id", format!("{figure}-{}", self.id))];
        attributes.extend(axes.attributes());
        drawing.open(&self.description(), &attributes);
        if let Some(NormalCurve { mean, sd }) = &self.band {
            draw_band(drawing, style, &axes, mean, sd);
        }
        axes.draw_ground(drawing, style);
        for area in &self.areas {
            let mut corners = placed(&axes, &area.high);
            corners.extend(placed(&axes, &area.low).into_iter().rev());
            drawing.polygon(&corners, &area.color, area.opacity, &[("data-role", "spread".to_owned())]);
        }
        for line in &self.lines {
            drawing.polyline(&placed(&axes, &line.values), line.look.stroke(), &[("data-role", line.role.to_owned())]);
        }
        self.draw_foot_offs(drawing, &axes);
        let unit = self.unit.replace("N.m", "N·m");
        let words = AxisWords {
            title: self.title,
            unit: &unit,
            directions: self.directions,
            abscissa: slot.named.then_some("gait cycle (%)"),
            legend_height: slot.legend_height,
        };
        axes.draw_frame(drawing, style, words);
        drawing.close();
    }

    fn draw_foot_offs(&self, drawing: &mut Drawing, axes: &Axes<'_>) {
        let [_, top, _, bottom] = axes.place;
        let height = TICK * (bottom - top);
        for (row, offs) in self.foot_offs.iter().enumerate() {
            let from = bottom - row as f64 * height;
            for (percent, look) in offs {
                drawing.line([axes.x(*percent), from], [axes.x(*percent), from - height], look.stroke());
            }
        }
    }
}

/// The points of a curve, cut off at the edges of the axes.
fn placed(axes: &Axes<'_>, values: &[f64]) -> Vec<[f64; 2]> {
    let last = (values.len().max(2) - 1) as f64;
    values.iter().enumerate().map(|(i, y)| axes.at([100.0 * i as f64 / last, *y])).collect()
}

/// Bars of the movement analysis profile: one group per angle, with the score of each side and the one to expect.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ProfileFigure {
    pub(crate) title: String,
    pub(crate) caption: String,
    pub(crate) bars: Vec<ProfileBars>,
    /// Names of right, left and expected, for the legend.
    pub(crate) legend: [String; 3],
}

/// The bars of one angle.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ProfileBars {
    /// Name in two lines.
    pub(crate) name: [String; 2],
    /// Mean and standard deviation of the right and the left score [deg].
    pub(crate) sides: [Option<(f64, Option<f64>)>; 2],
    /// The score to expect [deg].
    pub(crate) expected: Option<f64>,
}

/// Highest score of the usual scale [deg].
const PROFILE_SCALE: f64 = 30.0;
/// So many angles fit on the screen of a phone.
const NARROW: usize = 5;
/// Width of a bar, as a share of its group.
const BAR: f64 = 0.28;

impl ProfileFigure {
    /// The figure as SVG.
    ///
    /// # Errors
    /// A style that cannot be read.
    pub(crate) fn svg(&self) -> Result<String, FigureError> {
        let style = style().map_err(|e| FigureError { name: "profile", reason: e.to_string() })?;
        let [right, left, expected] = &self.legend;
        let sheet = Sheet {
            style,
            title: &self.title,
            caption: &self.caption,
            width_mm: if self.is_narrow() { style.widths_mm.one_column } else { style.widths_mm.two_columns },
            rows: std::iter::once(0..1).collect(),
            panel_height: 1.5 * HEIGHT,
            legend: vec![
                (Sample::Patch(&style.right.color, 1.0), right.clone()),
                (Sample::Patch(&style.left.color, 1.0), left.clone()),
                (Sample::Patch(&style.band.color, style.band.opacity), expected.clone()),
            ],
            panel_legends: Vec::new(),
            notes: vec!["Whiskers: standard deviation over the cycles.".to_owned()],
            description: self.bars.iter().map(ProfileBars::description).collect::<Vec<_>>().join(" "),
        };
        Ok(sheet.draw(|drawing, slot| self.draw(drawing, style, slot)))
    }

    fn is_narrow(&self) -> bool {
        self.bars.len() <= NARROW
    }

    /// The same angles in figures that fit on the screen of a phone.
    pub(crate) fn narrow(&self) -> Vec<Self> {
        self.bars.chunks(NARROW).map(|bars| Self { bars: bars.to_vec(), ..self.clone() }).collect()
    }

    /// The usual scale, or one with whole steps more for higher scores.
    fn top(&self) -> f64 {
        let highest = |bars: &ProfileBars| {
            let sides = bars.sides.iter().flatten().map(|(mean, sd)| mean + sd.unwrap_or(0.0));
            sides.chain(bars.expected).fold(0.0, f64::max)
        };
        let step = STEP * PROFILE_SCALE;
        let highest = self.bars.iter().map(highest).fold(PROFILE_SCALE, f64::max);
        PROFILE_SCALE + step * ((highest - PROFILE_SCALE) / step).ceil()
    }

    fn draw(&self, drawing: &mut Drawing, style: &Style, slot: Slot) {
        let axes = Axes::new(slot.place, [0.0, self.bars.len() as f64], [0.0, self.top()]);
        drawing.open(&self.title, &axes.attributes());
        axes.draw_ground(drawing, style);
        for (k, bars) in self.bars.iter().enumerate() {
            bars.draw(drawing, style, &axes, k as f64);
        }
        axes.draw_ordinate(drawing, style);
        let [left, _, right, bottom] = axes.place;
        drawing.line([left, bottom], [right, bottom], Stroke::solid(&style.quiet.color, style.lines_pt.axis));
        let words = AxisWords {
            title: "Score",
            unit: "deg",
            directions: [""; 2],
            abscissa: None,
            legend_height: slot.legend_height,
        };
        axes.draw_words(drawing, style, words);
        drawing.close();
    }
}

impl ProfileBars {
    fn description(&self) -> String {
        let side = |name: &str, k: usize| self.sides[k].map_or(String::new(), |(mean, _)| format!(" {name} {mean:.1}"));
        let expected = self.expected.map_or(String::new(), |expected| format!(" expected {expected:.1}"));
        format!("{}:{}{}{expected} deg.", self.name.join(" "), side("right", 0), side("left", 1))
    }

    fn draw(&self, drawing: &mut Drawing, style: &Style, axes: &Axes<'_>, from: f64) {
        let middle = from + 0.5;
        let bar = |drawing: &mut Drawing, [start, end]: [f64; 2], height: f64, color: &str, opacity: f64| {
            let corners = [[start, 0.0], [start, height], [end, height], [end, 0.0]].map(|corner| axes.at(corner));
            drawing.polygon(&corners, color, opacity, &[]);
        };
        if let Some(expected) = self.expected {
            bar(drawing, [from + 0.08, from + 0.92], expected, &style.band.color, style.band.opacity);
        }
        let colors = [&style.right.color, &style.left.color];
        for (k, side) in self.sides.iter().enumerate() {
            let Some((mean, sd)) = side else { continue };
            let start = middle + (k as f64 - 1.0) * (BAR + 0.02) + if k == 0 { 0.0 } else { 0.02 };
            bar(drawing, [start, start + BAR], *mean, colors[k], 1.0);
            if let Some(sd) = sd {
                let x = start + 0.5 * BAR;
                let whisker = Stroke::solid(&style.text.color, style.lines_pt.axis);
                drawing.line(axes.at([x, (mean - sd).max(0.0)]), axes.at([x, mean + sd]), whisker);
            }
        }
        let size = style.font.tick_pt;
        let letters = Letters::plain(size, &style.text.color, Anchor::Middle);
        for (line, word) in self.name.iter().enumerate() {
            let y = axes.place[3] + 3.0 + (line as f64 + 0.9) * size;
            drawing.text([axes.x(middle), y], word, letters);
        }
    }
}
