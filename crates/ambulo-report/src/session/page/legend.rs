//! The legend of the page: each symbol with its meaning, once.

use crate::figures::LineLook;
use crate::html::escaped;
use std::fmt::Write;

/// Width and height of a symbol [px], and pixels per point.
const SIZE: [f64; 2] = [30.0, 14.0];
const PIXELS: f64 = 1.6;

/// Entries of a legend as HTML.
#[derive(Default)]
pub(super) struct Legend(String);

impl Legend {
    /// A line.
    pub(super) fn line(&mut self, look: &LineLook, words: &str) {
        self.stroke(look, [[0.0, 0.5 * SIZE[1]], [SIZE[0], 0.5 * SIZE[1]]], words);
    }

    /// A short vertical line.
    pub(super) fn tick(&mut self, look: &LineLook, words: &str) {
        self.stroke(look, [[0.5 * SIZE[0], 2.0], [0.5 * SIZE[0], SIZE[1] - 2.0]], words);
    }

    /// An area.
    pub(super) fn patch(&mut self, color: &str, opacity: f64, words: &str) {
        let [width, height] = SIZE;
        self.entry(
            &format!("<rect width=\"{width}\" height=\"{height}\" fill=\"{color}\" fill-opacity=\"{opacity}\"/>"),
            words,
        );
    }

    /// The legend.
    pub(super) fn html(self) -> String {
        format!("<ul class=\"legend\">\n{}</ul>\n", self.0)
    }

    fn stroke(&mut self, look: &LineLook, [[x, y], [u, v]]: [[f64; 2]; 2], words: &str) {
        let dash: Vec<String> = look.dash.iter().map(|length| format!("{:.1}", PIXELS * length)).collect();
        let drawn = format!(
            "<path d=\"M{x} {y}L{u} {v}\" stroke=\"{}\" stroke-width=\"{:.1}\" stroke-opacity=\"{}\" \
             stroke-dasharray=\"{}\"/>",
            look.color,
            PIXELS * look.width,
            look.opacity,
            dash.join(" ")
        );
        self.entry(&drawn, words);
    }

    fn entry(&mut self, drawn: &str, words: &str) {
        let [width, height] = SIZE;
        let _ = writeln!(
            self.0,
            "<li><svg width=\"{width}\" height=\"{height}\" aria-hidden=\"true\"><rect width=\"{width}\" \
             height=\"{height}\" fill=\"#ffffff\"/>{drawn}</svg>{}</li>",
            escaped(words)
        );
    }
}
