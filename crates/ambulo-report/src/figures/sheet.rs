//! Lays out a figure: title, caption and legend above, panels in rows and columns, notes below.

use super::axes::{ABOVE, BELOW, BELOW_NAMELESS, LEFT};
use super::svg::{Anchor, Drawing, Letters, Stroke, points, text_width};
use crate::style::Style;
use std::ops::Range;

/// Margin of the paper and space between panels [pt]; distance of lines of text, in font sizes.
const MARGIN: f64 = 6.0;
const BETWEEN: f64 = 9.0;
const LEADING: f64 = 1.35;
/// Length of a line in a legend, and the gap after an entry [pt].
const SAMPLE: f64 = 16.0;
const ENTRY_GAP: f64 = 12.0;

/// The symbol of a legend's entry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sample<'a> {
    Line(Stroke<'a>),
    /// A short vertical line.
    Tick(Stroke<'a>),
    /// A point of a colour.
    Dot(&'a str),
    /// A patch of a colour with its opacity.
    Patch(&'a str, f64),
}

/// Entries of a legend.
pub(super) type Legend<'a> = Vec<(Sample<'a>, String)>;

/// Everything around the panels, and their arrangement.
#[derive(Debug, Clone)]
pub(super) struct Sheet<'a> {
    pub(super) style: &'a Style,
    pub(super) title: &'a str,
    pub(super) caption: &'a str,
    pub(super) width_mm: f64,
    /// The panels of each row.
    pub(super) rows: Vec<Range<usize>>,
    /// Height of the axes [pt].
    pub(super) panel_height: f64,
    pub(super) legend: Legend<'a>,
    /// Legends above the axes of single panels; shorter than the number of panels if the rest has none.
    pub(super) panel_legends: Vec<Legend<'a>>,
    pub(super) notes: Vec<String>,
    /// Content of the figure, for screen readers.
    pub(super) description: String,
}

/// The slot of a panel: its number, the rectangle of its axes, and whether it labels the abscissa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Slot {
    pub(super) number: usize,
    pub(super) place: [f64; 4],
    pub(super) named: bool,
    /// Height of the legend between title and axes [pt].
    pub(super) legend_height: f64,
}

impl Sheet<'_> {
    /// Draws head, the panels with `panel`, and notes.
    pub(super) fn draw(&self, mut panel: impl FnMut(&mut Drawing, Slot)) -> String {
        let mut drawing = Drawing::new(points(self.width_mm), &self.style.font.family);
        let mut y = self.draw_head(&mut drawing);
        let axes_width = axes_width(self.width_mm, self.rows.iter().map(Range::len).max().unwrap_or(1));
        for (number, row) in self.rows.iter().enumerate() {
            let lines = row.clone().filter_map(|panel| self.panel_legends.get(panel));
            let lines = lines.map(|legend| self.placed(legend, axes_width).last().map_or(0, |entry| entry.line + 1));
            let legend_height = lines.max().unwrap_or(0) as f64 * LEADING * self.style.font.label_pt;
            let named = |column: usize| self.rows[number + 1..].iter().all(|below| below.len() <= column);
            for (column, panel_number) in row.clone().enumerate() {
                let left = MARGIN + LEFT + column as f64 * (axes_width + AROUND);
                let (top, right) = (y + ABOVE + legend_height, left + axes_width);
                let place = [left, top, right, top + self.panel_height];
                if let Some(legend) = self.panel_legends.get(panel_number) {
                    let from = [left, y + ABOVE - 4.5];
                    self.draw_legend(&mut drawing, legend, from, right);
                }
                panel(&mut drawing, Slot { number: panel_number, place, named: named(column), legend_height });
            }
            let below = if (0..row.len()).any(named) { BELOW } else { BELOW_NAMELESS };
            y += ABOVE + legend_height + self.panel_height + below + 2.0;
        }
        y = self.draw_notes(&mut drawing, y);
        let title = format!("{}: {}", self.title, self.caption);
        drawing.finish(y + MARGIN - 2.0, &title, &self.description, &self.style.paper.color)
    }

    /// Title, caption and legend; returns where they end.
    fn draw_head(&self, drawing: &mut Drawing) -> f64 {
        let (font, ink) = (&self.style.font, &self.style.text.color);
        let mut y = MARGIN + font.title_pt;
        let title = Letters { bold: true, ..Letters::plain(font.title_pt, ink, Anchor::Start) };
        drawing.text([MARGIN, y], self.title, title);
        let room = drawing.width() - 2.0 * MARGIN;
        let caption = Letters::plain(font.label_pt, &self.style.quiet.color, Anchor::Start);
        for line in wrapped(self.caption, font.label_pt, room) {
            y += LEADING * font.label_pt;
            drawing.text([MARGIN, y], &line, caption);
        }
        if !self.legend.is_empty() {
            y = self.draw_legend(drawing, &self.legend, [MARGIN, y + 1.0], drawing.width() - MARGIN);
        }
        y + 5.0
    }

    /// Draws a legend below a point and up to an abscissa; returns its last baseline.
    fn draw_legend(&self, drawing: &mut Drawing, legend: &Legend<'_>, [left, top]: [f64; 2], right: f64) -> f64 {
        let size = self.style.font.label_pt;
        let words = Letters::plain(size, &self.style.text.color, Anchor::Start);
        let mut y = top;
        for Entry { sample, name, indent, line } in self.placed(legend, right - left) {
            y = top + (line + 1) as f64 * LEADING * size;
            draw_sample(drawing, sample, [left + indent, y - 0.35 * size], size);
            drawing.text([left + indent + SAMPLE + 3.0, y], &name, words);
        }
        y
    }

    /// Places the entries of a legend in lines of a width; names that are longer than a line are cut.
    fn placed<'l>(&self, legend: &Legend<'l>, room: f64) -> Vec<Entry<'l>> {
        let size = self.style.font.label_pt;
        let (mut indent, mut line) = (0.0, 0);
        let place = |(sample, name): &(Sample<'l>, String)| {
            let name = cut(name, size, room - SAMPLE - 3.0);
            let wide = SAMPLE + 3.0 + text_width(&name, size);
            if indent > 0.0 && indent + wide > room {
                (indent, line) = (0.0, line + 1);
            }
            let entry = Entry { sample: *sample, name, indent, line };
            indent += wide + ENTRY_GAP;
            entry
        };
        legend.iter().map(place).collect()
    }

    fn draw_notes(&self, drawing: &mut Drawing, from: f64) -> f64 {
        let size = self.style.font.note_pt;
        let letters = Letters::plain(size, &self.style.quiet.color, Anchor::Start);
        let mut y = from;
        let room = drawing.width() - 2.0 * MARGIN;
        for line in self.notes.iter().flat_map(|note| wrapped(note, size, room)) {
            y += LEADING * size;
            drawing.text([MARGIN, y], &line, letters);
        }
        y
    }
}

/// An entry of a legend with its place: distance from the left [pt], and line.
struct Entry<'a> {
    sample: Sample<'a>,
    name: String,
    indent: f64,
    line: usize,
}

/// Space between the axes of two columns [pt].
const AROUND: f64 = LEFT + BETWEEN + 4.0;

/// Width of the axes of a panel [pt] in a figure with this number of columns.
pub(super) fn axes_width(width_mm: f64, columns: usize) -> f64 {
    (points(width_mm) - 2.0 * MARGIN + BETWEEN) / columns.max(1) as f64 - AROUND
}

fn draw_sample(drawing: &mut Drawing, sample: Sample<'_>, [x, y]: [f64; 2], size: f64) {
    match sample {
        Sample::Line(stroke) => drawing.line([x, y], [x + SAMPLE, y], stroke),
        Sample::Tick(stroke) => {
            drawing.line([x + 0.7 * SAMPLE, y - 0.4 * size], [x + 0.7 * SAMPLE, y + 0.4 * size], stroke);
        }
        Sample::Dot(color) => drawing.circle([x + 0.7 * SAMPLE, y], 0.3 * size, color),
        Sample::Patch(color, opacity) => {
            let (top, bottom) = (y - 0.4 * size, y + 0.4 * size);
            let corners = [[x, top], [x + SAMPLE, top], [x + SAMPLE, bottom], [x, bottom]];
            drawing.polygon(&corners, color, opacity, &[]);
        }
    }
}

/// Lines of a text that fit into a width; words longer than that are cut.
#[must_use]
pub fn wrapped(text: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let word = cut(word, size, room);
        match lines.last_mut() {
            Some(line) if text_width(line, size) + text_width(" ", size) + text_width(&word, size) <= room => {
                line.push(' ');
                line.push_str(&word);
            }
            _ => lines.push(word),
        }
    }
    lines
}

fn cut(word: &str, size: f64, room: f64) -> String {
    if text_width(word, size) <= room {
        return word.to_owned();
    }
    let mut shown = String::new();
    for letter in word.chars() {
        if text_width(&shown, size) + 2.0 * size > room {
            break;
        }
        shown.push(letter);
    }
    shown + "…"
}
