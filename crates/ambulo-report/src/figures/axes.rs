//! Draws the axes of a panel and converts numbers to positions in the figure.

use ambulo::numerics::elementary::{log10, powf, powi};

use super::svg::{Anchor, Drawing, Letters, Stroke, text_width};
use crate::style::Style;

/// A rectangle in the figure and the range of numbers that it shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axes<'a> {
    /// Left, top, right, bottom [pt].
    pub(super) place: [f64; 4],
    /// Abscissa at the left and at the right edge.
    pub(super) along: [f64; 2],
    /// Ordinate at the bottom and at the top edge.
    pub(super) up: [f64; 2],
    /// Ticks of abscissa and ordinate.
    pub(super) ticks: [Ticks<'a>; 2],
}

/// Which numbers of an axis have a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ticks<'a> {
    /// Three to six round numbers.
    Round,
    /// Given numbers with their labels, for example powers of ten on a logarithmic axis.
    Given(&'a [(f64, String)]),
}

/// Ticks with their labels.
#[derive(Debug, Clone, PartialEq)]
pub struct Labels {
    /// Their numbers, with what is written there.
    pub ticks: Vec<(f64, String)>,
    /// Labels are to be multiplied by this power of ten.
    pub power: i32,
}

/// The text at the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct AxisWords<'a> {
    /// Title above the axes.
    pub(super) title: &'a str,
    /// Unit of the ordinate, on the right of the title.
    pub(super) unit: &'a str,
    /// Meaning of positive and negative values, written along the ordinate.
    pub(super) directions: [&'a str; 2],
    /// Label below the axes; `None` if the panel below has the same abscissa.
    pub(super) abscissa: Option<&'a str>,
    /// Space for a legend between the title and the axes [pt].
    pub(super) legend_height: f64,
}

/// Space for text and ticks outside of the rectangle [pt]: left, above, below (with and without the name of the
/// abscissa).
pub(super) const LEFT: f64 = 31.0;
pub(super) const ABOVE: f64 = 14.0;
pub(super) const BELOW: f64 = 22.0;
pub(super) const BELOW_NAMELESS: f64 = 12.0;
const TICK: f64 = 2.5;
/// Letters of the browser's font may be wider than letters of the style's first font by this factor.
const WIDER: f64 = 1.15;
/// Bold text is wider by this factor.
const BOLD: f64 = 1.07;
/// Numbers up to this size are written in full; larger and much smaller ones share a power of ten.
const LARGEST: f64 = 1e5;
const SMALLEST: f64 = 1e-3;

impl<'a> Axes<'a> {
    /// Axes with ticks at round numbers.
    pub(super) fn new(place: [f64; 4], along: [f64; 2], up: [f64; 2]) -> Axes<'a> {
        Axes { place, along, up, ticks: [Ticks::Round; 2] }
    }

    pub(super) fn x(&self, number: f64) -> f64 {
        let [left, _, right, _] = self.place;
        left + (number - self.along[0]) / (self.along[1] - self.along[0]) * (right - left)
    }

    pub(super) fn y(&self, number: f64) -> f64 {
        let [_, top, _, bottom] = self.place;
        bottom - (number - self.up[0]) / (self.up[1] - self.up[0]) * (bottom - top)
    }

    pub(super) fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x(x), self.y(y)]
    }

    /// Attributes that let a reader of the file convert positions back to numbers.
    pub(super) fn attributes(&self) -> Vec<(&'static str, String)> {
        let words = |numbers: &[f64]| numbers.iter().map(|x| format!("{x}")).collect::<Vec<_>>().join(" ");
        vec![("data-place", words(&self.place)), ("data-along", words(&self.along)), ("data-up", words(&self.up))]
    }

    /// Horizontal grid and zero line, to be drawn below the curves.
    pub(super) fn draw_ground(&self, drawing: &mut Drawing, style: &Style) {
        let [left, _, right, _] = self.place;
        let grid = Stroke::solid(&style.grid.color, style.lines_pt.grid);
        for (number, _) in self.ticks[1].labels(self.up).ticks {
            drawing.line([left, self.y(number)], [right, self.y(number)], grid);
        }
        // A given tick at zero, for example of a logarithm, is not the zero of the quantity.
        if self.ticks[1] == Ticks::Round && self.up[0] < 0.0 && self.up[1] > 0.0 {
            let zero = Stroke::solid(&style.quiet.color, style.lines_pt.zero);
            drawing.line([left, self.y(0.0)], [right, self.y(0.0)], zero);
        }
    }

    /// Vertical grid, to be drawn below the curves.
    pub(super) fn draw_columns(&self, drawing: &mut Drawing, style: &Style) {
        let [_, top, _, bottom] = self.place;
        let grid = Stroke::solid(&style.grid.color, style.lines_pt.grid);
        for (number, _) in self.ticks[0].labels(self.along).ticks {
            drawing.line([self.x(number), top], [self.x(number), bottom], grid);
        }
    }

    /// Axes, ticks and text, to be drawn above the curves.
    pub(super) fn draw_frame(&self, drawing: &mut Drawing, style: &Style, words: AxisWords<'_>) {
        self.draw_ordinate(drawing, style);
        self.draw_abscissa(drawing, style);
        self.draw_words(drawing, style, words);
    }

    /// The vertical axis with its ticks.
    pub(super) fn draw_ordinate(&self, drawing: &mut Drawing, style: &Style) {
        let [left, top, _, bottom] = self.place;
        let axis = Stroke::solid(&style.quiet.color, style.lines_pt.axis);
        let size = style.font.tick_pt;
        drawing.line([left, top], [left, bottom], axis);
        for (number, label) in &self.ticks[1].labels(self.up).ticks {
            let y = self.y(*number);
            drawing.line([left - TICK, y], [left, y], axis);
            let letters = Letters::plain(size, &style.text.color, Anchor::End);
            drawing.text([left - TICK - 1.5, y + 0.35 * size], label, letters);
        }
    }

    /// The horizontal axis with its ticks.
    pub(super) fn draw_abscissa(&self, drawing: &mut Drawing, style: &Style) {
        let [left, _, right, bottom] = self.place;
        let axis = Stroke::solid(&style.quiet.color, style.lines_pt.axis);
        let size = style.font.tick_pt;
        drawing.line([left, bottom], [right, bottom], axis);
        for (number, label) in &self.ticks[0].labels(self.along).ticks {
            let x = self.x(*number);
            drawing.line([x, bottom], [x, bottom + TICK], axis);
            let letters = Letters::plain(size, &style.text.color, Anchor::Middle);
            drawing.text([x, bottom + TICK + size], label, letters);
        }
    }

    /// Title, unit, directions and the name of the abscissa.
    pub(super) fn draw_words(&self, drawing: &mut Drawing, style: &Style, words: AxisWords<'_>) {
        let [left, top, right, bottom] = self.place;
        let font = &style.font;
        let powers = [self.ticks[0].labels(self.along).power, self.ticks[1].labels(self.up).power];
        let unit_text = with_power(words.unit, powers[1]);
        let quiet = |size, anchor| Letters::plain(size, &style.quiet.color, anchor);
        let upwards = |anchor| Letters { upwards: true, ..quiet(font.note_pt, anchor) };
        let (start, line) = (left - LEFT + 2.0, top - 4.5 - words.legend_height);
        let width = WIDER * BOLD * text_width(words.title, 1.0);
        let size_in = |room: f64| font.panel_pt.min(room / width.max(f64::MIN_POSITIVE));
        let beside = size_in(right - start - WIDER * text_width(&unit_text, font.label_pt) - 4.0);
        // A unit that does not fit next to a long title is written along the axis.
        let is_beside = beside >= font.note_pt || words.directions != [""; 2];
        let size = if is_beside { beside } else { size_in(right - start) }.max(font.note_pt);
        let title = Letters { bold: true, ..Letters::plain(size, &style.text.color, Anchor::Start) };
        drawing.text([start, line], words.title, title);
        let x = left - LEFT + font.note_pt + 1.0;
        if is_beside {
            drawing.text([right, line], &unit_text, quiet(font.label_pt, Anchor::End));
        } else {
            drawing.text([x, 0.5 * (top + bottom)], &unit_text, upwards(Anchor::Middle));
        }
        if let Some(name) = words.abscissa {
            let letters = Letters::plain(font.label_pt, &style.text.color, Anchor::Middle);
            drawing.text([0.5 * (left + right), bottom + BELOW - 3.0], &with_power(name, powers[0]), letters);
        }
        let [up, down] = words.directions;
        if !up.is_empty() {
            drawing.text([x, top], &format!("{up} →"), upwards(Anchor::End));
        }
        if !down.is_empty() {
            drawing.text([x, bottom], &format!("← {down}"), upwards(Anchor::Start));
        }
    }
}

/// Range of numbers with a margin above and below; around 0 if there are none; never empty.
pub fn range(numbers: impl IntoIterator<Item = f64>, least: f64) -> [f64; 2] {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    let finite = numbers.into_iter().filter(|x| x.is_finite());
    let (low, high) = finite.fold(start, |(low, high), x| (low.min(x), high.max(x)));
    if low > high {
        return [-least, least];
    }
    let missing = (least - (high - low)).max(0.0);
    let margin = 0.06 * (high - low).max(least) + 0.5 * missing;
    [low - margin, high + margin]
}

/// Round numbers inside a range, three to six, and the decimals that they need.
#[must_use]
pub fn ticks([low, high]: [f64; 2]) -> (Vec<f64>, usize) {
    let rough = (high - low) / 5.0;
    if !(rough > 0.0 && rough.is_finite()) {
        return (Vec::new(), 0);
    }
    let power = powf(10.0_f64, log10(rough).floor());
    // 25 is rounder than 20, but 0.25 needs a digit more than 0.2.
    let quarter = if power >= 10.0 { 2.5 } else { 2.0 };
    let step =
        [1.0, 2.0, quarter, 5.0, 10.0].map(|k| k * power).into_iter().find(|s| *s >= rough * 0.999).unwrap_or(rough);
    let hidden = 1e-9 * step;
    let (first, last) = (((low - hidden) / step).ceil(), ((high + hidden) / step).floor());
    let mut digits = 0;
    while digits < 9 && ((step * powi(10.0_f64, digits)).round() - step * powi(10.0_f64, digits)).abs() > 1e-6 {
        digits += 1;
    }
    ((0..=(last - first).max(0.0) as usize).map(|k| (first + k as f64) * step).collect(), digits as usize)
}

impl Ticks<'_> {
    /// The ticks inside a range.
    #[must_use]
    pub fn labels(self, range: [f64; 2]) -> Labels {
        match self {
            Ticks::Round => round_labels(range),
            Ticks::Given(ticks) => {
                let inside = |number: f64| (range[0]..=range[1]).contains(&number);
                Labels { ticks: ticks.iter().filter(|(number, _)| inside(*number)).cloned().collect(), power: 0 }
            }
        }
    }
}

/// Round numbers inside a range with their labels.
#[must_use]
pub fn round_labels([low, high]: [f64; 2]) -> Labels {
    let size = low.abs().max(high.abs());
    let written_in_full = !size.is_normal() || (SMALLEST..LARGEST).contains(&size);
    // Multiples of three, as for prefixes of units.
    let power = if written_in_full { 0 } else { 3 * (log10(size) / 3.0).floor() as i32 };
    let scale = powi(10.0_f64, power);
    let (numbers, digits) = ticks([low / scale, high / scale]);
    let ticks = numbers.into_iter().map(|number| (scale * number, number_text(number, digits))).collect();
    Labels { ticks, power }
}

/// A unit, or a quantity with its unit in parentheses, whose numbers are to be multiplied by a power of ten.
#[must_use]
pub fn with_power(unit: &str, power: i32) -> String {
    if power == 0 {
        return unit.to_owned();
    }
    let digit = |letter: char| match letter {
        '-' => '⁻',
        letter => letter
            .to_digit(10)
            .map_or(letter, |digit| ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize]),
    };
    let ten = format!("10{}", power.to_string().chars().map(digit).collect::<String>());
    match unit.rsplit_once('(') {
        Some((quantity, unit)) => format!("{quantity}({ten} {unit}"),
        None => format!("{ten} {unit}"),
    }
}

/// A number with this many digits, as written at an axis.
#[must_use]
pub fn number_text(number: f64, digits: usize) -> String {
    let text = format!("{number:.digits$}");
    let zero = text.trim_start_matches('-').chars().all(|letter| matches!(letter, '0' | '.'));
    // A minus sign instead of a hyphen.
    if zero { text.trim_start_matches('-').to_owned() } else { text.replace('-', "−") }
}
