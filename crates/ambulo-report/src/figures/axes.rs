//! Axes of a panel: from numbers to places on the paper, with ticks at round numbers.

use super::svg::{Anchor, Drawing, Letters, Stroke, text_width};
use crate::style::Style;

/// A rectangle of the paper with the numbers that its edges stand for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Axes {
    /// Left, top, right, bottom [pt].
    pub(super) place: [f64; 4],
    /// Abscissa at the left and at the right edge.
    pub(super) along: [f64; 2],
    /// Ordinate at the bottom and at the top edge.
    pub(super) up: [f64; 2],
}

/// What is written at axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct AxisWords<'a> {
    /// Above the axes.
    pub(super) title: &'a str,
    /// Unit, behind the title.
    pub(super) unit: &'a str,
    /// What up and down mean, upwards along the ordinate.
    pub(super) directions: [&'a str; 2],
    /// Below the axes; none where the panel below has it.
    pub(super) abscissa: Option<&'a str>,
}

/// Room that words and ticks need outside of the rectangle [pt]: left, above, below (with and without the abscissa's name).
pub(super) const LEFT: f64 = 31.0;
pub(super) const ABOVE: f64 = 14.0;
pub(super) const BELOW: f64 = 22.0;
pub(super) const BELOW_NAMELESS: f64 = 12.0;
const TICK: f64 = 2.5;
/// Bold letters are wider by so much.
const BOLD: f64 = 1.07;

impl Axes {
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

    /// What a reader of the file needs to turn places into numbers.
    pub(super) fn attributes(&self) -> Vec<(&'static str, String)> {
        let words = |numbers: &[f64]| numbers.iter().map(|x| format!("{x}")).collect::<Vec<_>>().join(" ");
        vec![("data-place", words(&self.place)), ("data-along", words(&self.along)), ("data-up", words(&self.up))]
    }

    /// Grid and zero line, to be drawn below the curves.
    pub(super) fn draw_ground(&self, drawing: &mut Drawing, style: &Style) {
        let [left, _, right, _] = self.place;
        let grid = Stroke::solid(&style.grid.color, style.lines_pt.grid);
        for number in ticks(self.up).0 {
            drawing.line([left, self.y(number)], [right, self.y(number)], grid);
        }
        if self.up[0] < 0.0 && self.up[1] > 0.0 {
            let zero = Stroke::solid(&style.quiet.color, style.lines_pt.zero);
            drawing.line([left, self.y(0.0)], [right, self.y(0.0)], zero);
        }
    }

    /// Axes, ticks and words, to be drawn above the curves.
    pub(super) fn draw_frame(&self, drawing: &mut Drawing, style: &Style, words: AxisWords<'_>) {
        let [left, top, right, bottom] = self.place;
        let axis = Stroke::solid(&style.quiet.color, style.lines_pt.axis);
        drawing.line([left, top], [left, bottom], axis);
        drawing.line([left, bottom], [right, bottom], axis);
        let font = &style.font;
        let (rows, digits) = ticks(self.up);
        for number in rows {
            let y = self.y(number);
            drawing.line([left - TICK, y], [left, y], axis);
            let letters = Letters::plain(font.tick_pt, &style.text.color, Anchor::End);
            drawing.text([left - TICK - 1.5, y + 0.35 * font.tick_pt], &number_text(number, digits), letters);
        }
        let (columns, digits) = ticks(self.along);
        for number in columns {
            let x = self.x(number);
            drawing.line([x, bottom], [x, bottom + TICK], axis);
            let letters = Letters::plain(font.tick_pt, &style.text.color, Anchor::Middle);
            drawing.text([x, bottom + TICK + font.tick_pt], &number_text(number, digits), letters);
        }
        self.draw_words(drawing, style, words);
    }

    fn draw_words(&self, drawing: &mut Drawing, style: &Style, words: AxisWords<'_>) {
        let [left, top, right, bottom] = self.place;
        let font = &style.font;
        let unit = Letters::plain(font.label_pt, &style.quiet.color, Anchor::End);
        let room = right - (left - LEFT + 2.0) - text_width(words.unit, font.label_pt) - 4.0;
        let fitting = room / (BOLD * text_width(words.title, 1.0)).max(f64::MIN_POSITIVE);
        let size = font.panel_pt.min(fitting).max(font.note_pt);
        let title = Letters { bold: true, ..Letters::plain(size, &style.text.color, Anchor::Start) };
        let line = top - 4.5;
        drawing.text([left - LEFT + 2.0, line], words.title, title);
        drawing.text([right, line], words.unit, unit);
        if let Some(name) = words.abscissa {
            let letters = Letters::plain(font.label_pt, &style.text.color, Anchor::Middle);
            drawing.text([0.5 * (left + right), bottom + BELOW - 3.0], name, letters);
        }
        let upwards = |anchor| Letters { upwards: true, ..Letters::plain(font.note_pt, &style.quiet.color, anchor) };
        let x = left - LEFT + font.note_pt + 1.0;
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
pub(super) fn range(numbers: impl IntoIterator<Item = f64>, least: f64) -> [f64; 2] {
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
fn ticks([low, high]: [f64; 2]) -> (Vec<f64>, usize) {
    let rough = (high - low) / 5.0;
    if !(rough > 0.0 && rough.is_finite()) {
        return (Vec::new(), 0);
    }
    let power = 10.0_f64.powf(rough.log10().floor());
    // 25 is rounder than 20, but 0.25 needs a digit more than 0.2.
    let quarter = if power >= 10.0 { 2.5 } else { 2.0 };
    let step =
        [1.0, 2.0, quarter, 5.0, 10.0].map(|k| k * power).into_iter().find(|s| *s >= rough * 0.999).unwrap_or(rough);
    let hidden = 1e-9 * step;
    let (first, last) = (((low - hidden) / step).ceil(), ((high + hidden) / step).floor());
    let mut digits = 0;
    while digits < 9 && ((step * 10.0_f64.powi(digits)).round() - step * 10.0_f64.powi(digits)).abs() > 1e-6 {
        digits += 1;
    }
    ((0..=(last - first).max(0.0) as usize).map(|k| (first + k as f64) * step).collect(), digits as usize)
}

fn number_text(number: f64, digits: usize) -> String {
    let text = format!("{number:.digits$}");
    let zero = text.trim_start_matches('-').chars().all(|letter| matches!(letter, '0' | '.'));
    // A minus as long as a plus is wide.
    if zero { text.trim_start_matches('-').to_owned() } else { text.replace('-', "−") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(ticks([0.0, 100.0]), (vec![0.0, 20.0, 40.0, 60.0, 80.0, 100.0], 0));
        let (rows, digits) = ticks([-0.83, 1.41]);
        assert_eq!((rows.len(), digits), (4, 1), "{rows:?}");
        assert!(rows.iter().all(|x| (-0.83..1.41).contains(x)));
        assert_eq!(ticks([1.0, 1.0]).0.len(), 0);
        assert_eq!(number_text(-0.0, 1), "0.0");
        assert_eq!(number_text(-2.5, 1), "−2.5");
    }

    #[test]
    fn a_range_is_never_empty() {
        let [low, high] = range([], 0.2);
        assert!(low < 0.0 && high > 0.0);
        let [low, high] = range([5.0, 5.0, f64::NAN], 1.0);
        assert!(low < 5.0 && high > 5.0 && high - low >= 1.0);
    }
}
