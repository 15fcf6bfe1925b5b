//! A figure of panels in rows and columns: head and legend above, notes below.

use super::axes::{ABOVE, BELOW, BELOW_NAMELESS, LEFT};
use super::svg::{Anchor, Drawing, Letters, Stroke, points, text_width};
use crate::style::Style;
use std::ops::Range;

/// Margin of the paper, between panels, and between lines of the head [pt].
const MARGIN: f64 = 6.0;
const BETWEEN: f64 = 9.0;
const LEADING: f64 = 1.35;
/// Length of a legend's line, and the gap behind an entry [pt].
const SAMPLE: f64 = 16.0;
const ENTRY_GAP: f64 = 12.0;

/// An entry of the legend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sample<'a> {
    Line(Stroke<'a>),
    /// A short upright line.
    Tick(Stroke<'a>),
    /// A patch of a colour with its opacity.
    Patch(&'a str, f64),
}

/// What stands around the panels, and how they are arranged.
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
    pub(super) legend: Vec<(Sample<'a>, String)>,
    pub(super) notes: Vec<String>,
    /// What the figure shows, for those who cannot see it.
    pub(super) description: String,
}

/// A panel's place: number, rectangle of its axes, and whether the abscissa's name belongs below it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Slot {
    pub(super) number: usize,
    pub(super) place: [f64; 4],
    pub(super) named: bool,
}

impl Sheet<'_> {
    /// Draws head, the panels with `panel`, and notes.
    pub(super) fn draw(&self, mut panel: impl FnMut(&mut Drawing, Slot)) -> String {
        let mut drawing = Drawing::new(points(self.width_mm), &self.style.font.family);
        let mut y = self.draw_head(&mut drawing);
        let columns = self.rows.iter().map(Range::len).max().unwrap_or(1).max(1);
        let cell = (drawing.width() - 2.0 * MARGIN + BETWEEN) / columns as f64;
        for (number, row) in self.rows.iter().enumerate() {
            let named = |column: usize| self.rows[number + 1..].iter().all(|below| below.len() <= column);
            for (column, panel_number) in row.clone().enumerate() {
                let left = MARGIN + column as f64 * cell;
                let (top, right) = (y + ABOVE, left + cell - BETWEEN - 4.0);
                let place = [left + LEFT, top, right, top + self.panel_height];
                panel(&mut drawing, Slot { number: panel_number, place, named: named(column) });
            }
            let below = if (0..row.len()).any(named) { BELOW } else { BELOW_NAMELESS };
            y += ABOVE + self.panel_height + below + 2.0;
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
            y += LEADING * font.label_pt + 1.0;
        }
        let mut x = MARGIN;
        for (sample, name) in &self.legend {
            let wide = SAMPLE + 3.0 + text_width(name, font.label_pt);
            if x > MARGIN && x + wide > drawing.width() - MARGIN {
                (x, y) = (MARGIN, y + LEADING * font.label_pt);
            }
            draw_sample(drawing, *sample, [x, y - 0.35 * font.label_pt], font.label_pt);
            let words = Letters::plain(font.label_pt, ink, Anchor::Start);
            drawing.text([x + SAMPLE + 3.0, y], name, words);
            x += wide + ENTRY_GAP;
        }
        y + 5.0
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

fn draw_sample(drawing: &mut Drawing, sample: Sample<'_>, [x, y]: [f64; 2], size: f64) {
    match sample {
        Sample::Line(stroke) => drawing.line([x, y], [x + SAMPLE, y], stroke),
        Sample::Tick(stroke) => {
            drawing.line([x + 0.7 * SAMPLE, y - 0.4 * size], [x + 0.7 * SAMPLE, y + 0.4 * size], stroke);
        }
        Sample::Patch(color, opacity) => {
            let (top, bottom) = (y - 0.4 * size, y + 0.4 * size);
            let corners = [[x, top], [x + SAMPLE, top], [x + SAMPLE, bottom], [x, bottom]];
            drawing.polygon(&corners, color, opacity, &[]);
        }
    }
}

/// Lines of a text that fit into a width; words longer than that are cut.
fn wrapped(text: &str, size: f64, room: f64) -> Vec<String> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_wrapped_and_a_word_without_end_is_cut() {
        let lines = wrapped("one two three four", 10.0, text_width("one two", 10.0) + 0.1);
        assert_eq!(lines, ["one two", "three", "four"]);
        let long = wrapped(&"x".repeat(500), 6.0, 100.0);
        assert!(long.len() == 1 && long[0].ends_with('…') && text_width(&long[0], 6.0) <= 106.0, "{long:?}");
    }
}
