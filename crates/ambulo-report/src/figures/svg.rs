//! Writes SVG: lines, areas and text as text, in points (1/72 inch), with the size of the drawing in millimetres.
//!
//! Coordinates keep two decimals, dashes are attributes and panels are groups, so that a figure can be scaled, edited
//! and searched.

use std::fmt::Write as _;

const POINTS_PER_MM: f64 = 72.0 / 25.4;

/// Millimetres in points.
pub(super) fn points(mm: f64) -> f64 {
    mm * POINTS_PER_MM
}

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke<'a> {
    pub(super) color: &'a str,
    pub(super) width: f64,
    pub(super) opacity: f64,
    /// Lengths of dashes and gaps [pt].
    pub(super) dash: &'a [f64],
}

impl<'a> Stroke<'a> {
    /// Without dashes [pt].
    #[must_use]
    pub fn solid(color: &'a str, width: f64) -> Stroke<'a> {
        Stroke { color, width, opacity: 1.0, dash: &[] }
    }
}

/// Anchor of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// How a text is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Letters<'a> {
    pub(super) size: f64,
    pub(super) color: &'a str,
    pub(super) anchor: Anchor,
    pub(super) bold: bool,
    /// Rotated to read upwards.
    pub(super) upwards: bool,
}

impl<'a> Letters<'a> {
    pub(super) fn plain(size: f64, color: &'a str, anchor: Anchor) -> Letters<'a> {
        Letters { size, color, anchor, bold: false, upwards: false }
    }
}

/// Width of a text [pt], estimated: letters of Arial are 0.5 em wide on average, small ones and blanks less.
#[must_use]
pub fn text_width(text: &str, size: f64) -> f64 {
    let of = |letter: char| match letter {
        'i' | 'j' | 'l' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' => 0.25,
        ' ' | 'f' | 't' | 'r' | '(' | ')' | '-' | '/' | '·' => 0.32,
        'm' | 'w' | 'M' | 'W' | '%' | '→' | '←' => 0.88,
        letter if letter.is_uppercase() => 0.69,
        _ => 0.56,
    };
    text.chars().map(of).sum::<f64>() * size
}

/// Builds a drawing.
#[derive(Debug, Clone)]
pub struct Drawing {
    width: f64,
    family: String,
    body: String,
}

impl Drawing {
    /// An empty drawing with this width [pt] and font family.
    #[must_use]
    pub fn new(width: f64, family: &str) -> Drawing {
        Drawing { width, family: family.to_owned(), body: String::new() }
    }

    pub(super) fn width(&self) -> f64 {
        self.width
    }

    /// Opens a group; `attributes` are names and values, escaped here.
    pub(super) fn open(&mut self, title: &str, attributes: &[(&str, String)]) {
        self.put("<g");
        self.attributes(attributes);
        self.put(">");
        if !title.is_empty() {
            let title = escaped(title);
            self.write(format_args!("<title>{title}</title>"));
        }
        self.put("\n");
    }

    pub(super) fn close(&mut self) {
        self.put("</g>\n");
    }

    pub(super) fn line(&mut self, from: [f64; 2], to: [f64; 2], stroke: Stroke<'_>) {
        let ([x1, y1], [x2, y2]) = (from.map(short), to.map(short));
        self.write(format_args!("<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\""));
        self.stroke(stroke);
        self.put("/>\n");
    }

    /// A line through points, interrupted at points that are not finite.
    pub fn polyline(&mut self, points: &[[f64; 2]], stroke: Stroke<'_>, attributes: &[(&str, String)]) {
        for part in points.split(|[x, y]| !(x.is_finite() && y.is_finite())).filter(|part| part.len() > 1) {
            self.put("<polyline points=\"");
            self.list(part);
            self.put("\" fill=\"none\"");
            self.stroke(stroke);
            self.attributes(attributes);
            self.put("/>\n");
        }
    }

    /// A filled area; left out if a corner is not finite.
    pub(super) fn polygon(&mut self, corners: &[[f64; 2]], fill: &str, opacity: f64, attributes: &[(&str, String)]) {
        if corners.len() < 3 || corners.iter().flatten().any(|x| !x.is_finite()) {
            return;
        }
        self.put("<polygon points=\"");
        self.list(corners);
        let (fill, opacity) = (escaped(fill), short(opacity));
        self.write(format_args!("\" fill=\"{fill}\" fill-opacity=\"{opacity}\""));
        self.attributes(attributes);
        self.put("/>\n");
    }

    /// A filled circle; left out if its centre is not finite.
    pub(super) fn circle(&mut self, center: [f64; 2], radius: f64, fill: &str) {
        if center.iter().any(|x| !x.is_finite()) {
            return;
        }
        let ([x, y], r, fill) = (center.map(short), short(radius), escaped(fill));
        self.write(format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" fill=\"{fill}\"/>\n"));
    }

    /// A text on the line through a point.
    pub(super) fn text(&mut self, [x, y]: [f64; 2], text: &str, letters: Letters<'_>) {
        let [x, y, size] = [x, y, letters.size].map(short);
        let anchor = match letters.anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let turn = if letters.upwards { format!(" transform=\"rotate(-90 {x} {y})\"") } else { String::new() };
        let weight = if letters.bold { " font-weight=\"bold\"" } else { "" };
        let (text, color) = (escaped(text), escaped(letters.color));
        self.write(format_args!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\"{weight} \
             fill=\"{color}\"{turn}>{text}</text>\n"
        ));
    }

    /// The file: `height` [pt], title and description for screen readers, background colour. It has no ids, so that
    /// several drawings can be part of one page.
    #[must_use]
    pub fn finish(self, height: f64, title: &str, description: &str, ground: &str) -> String {
        let mm = |length: f64| short(length / POINTS_PER_MM);
        let (w, h) = (short(self.width), short(height));
        let (title, description) = (escaped(title), escaped(description));
        let (family, ground) = (escaped(&self.family), escaped(ground));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}mm\" height=\"{}mm\" viewBox=\"0 0 {w} {h}\" \
             role=\"img\" \
             font-family=\"{family}\" stroke-linejoin=\"round\">\n\
             <title>{title}</title>\n<desc>{description}</desc>\n\
             <rect width=\"{w}\" height=\"{h}\" fill=\"{ground}\"/>\n{}</svg>\n",
            mm(self.width),
            mm(height),
            self.body
        )
    }

    fn stroke(&mut self, stroke: Stroke<'_>) {
        let (color, width) = (escaped(stroke.color), short(stroke.width));
        self.write(format_args!(" stroke=\"{color}\" stroke-width=\"{width}\""));
        if stroke.opacity < 1.0 {
            let opacity = short(stroke.opacity);
            self.write(format_args!(" stroke-opacity=\"{opacity}\""));
        }
        if !stroke.dash.is_empty() {
            let dash = stroke.dash.iter().map(|x| short(*x)).collect::<Vec<_>>().join(" ");
            self.write(format_args!(" stroke-dasharray=\"{dash}\""));
        }
    }

    fn attributes(&mut self, attributes: &[(&str, String)]) {
        for (name, value) in attributes {
            let value = escaped(value);
            self.write(format_args!(" {name}=\"{value}\""));
        }
    }

    fn list(&mut self, points: &[[f64; 2]]) {
        for (number, [x, y]) in points.iter().enumerate() {
            if number > 0 {
                self.body.push(' ');
            }
            push_short(&mut self.body, *x);
            self.body.push(',');
            push_short(&mut self.body, *y);
        }
    }

    fn put(&mut self, text: &str) {
        self.body.push_str(text);
    }

    fn write(&mut self, arguments: std::fmt::Arguments<'_>) {
        // Writing to a string cannot fail.
        let _ = self.body.write_fmt(arguments);
    }
}

/// A hundredth of a point is 3.5 micrometres.
const HUNDREDTHS: f64 = 100.0;
/// Larger numbers of hundredths are not rounded here.
const MOST_HUNDREDTHS: f64 = 1e9;
/// Closer to the middle between two hundredths the product does not decide, because it is rounded itself.
const UNDECIDED: f64 = 1e-6;

/// Two decimals, without zeros at the end: the digits of `{:.2}`.
#[must_use]
pub fn short(x: f64) -> String {
    let mut text = String::new();
    push_short(&mut text, x);
    text
}

/// Appends the digits of [`short`].
fn push_short(text: &mut String, x: f64) {
    let scaled = (HUNDREDTHS * x).abs();
    let down = scaled.floor();
    if !(scaled < MOST_HUNDREDTHS && (scaled - down - 0.5).abs() > UNDECIDED) {
        text.push_str(without_zeros(&format!("{x:.2}")));
        return;
    }
    let hundredths = down as u32 + u32::from(scaled - down > 0.5);
    if x < 0.0 && hundredths > 0 {
        text.push('-');
    }
    // The digits, from the last to the first; there is one before the point.
    let mut digits = [b'0'; 10];
    let (mut rest, mut first) = (hundredths, digits.len());
    while rest > 0 {
        first -= 1;
        digits[first] = b'0' + (rest % 10) as u8;
        rest /= 10;
    }
    let (whole, decimals) = digits.split_at(digits.len() - 2);
    text.extend(whole[first.min(whole.len() - 1)..].iter().map(|digit| char::from(*digit)));
    match decimals {
        [b'0', b'0'] => {}
        [tenths, b'0'] => text.extend(['.', char::from(*tenths)]),
        both => text.extend(['.', char::from(both[0]), char::from(both[1])]),
    }
}

/// Decimals without the zeros at their end.
#[must_use]
pub fn without_zeros(decimals: &str) -> &str {
    let text = decimals.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0" } else { text }
}

/// Escapes text for XML; characters that XML does not allow are left out.
#[must_use]
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\t' | '\n' | '\r' => out.push(' '),
            letter if letter.is_control() || matches!(letter, '\u{fffe}' | '\u{ffff}') => {}
            letter => out.push(letter),
        }
    }
    out
}
