//! Points: the first part of every frame.
//!
//! Four values per point: x, y, z and a word. Integer files: 16-bit integers, positions are multiplied by the scale; a
//! negative word: missing. Real files: reals, and the word is a real that is converted to an integer. High byte of the
//! word: one bit per camera; low byte: the residual divided by the scale.
//!
//! Real files also hold other words: -1.0 (missing), 65535.0 (all bits, missing: such points
//! are at the origin), 32768.0 to 65534.0 (an eighth camera), reals beyond 16 bits (the word is the upper half of
//! the real's bits: 1.7e38 has 0x7F00 there), reals below 1 (zero). Infinite and not-a-number: missing.
//!
//! Source: C3D user guide (c3d.org), "3D data - floating-point format"; the words, from files of c3d.org's samples.

use super::layout::Layout;
use super::parameters::Parameters;
use super::words::{Processor, Words};
use super::{Encoding, Storage};
use crate::error::Remark;

/// Choice of the points to read, by all names and the parameters: one value per name.
pub(super) type Choice<'a> = &'a dyn Fn(&[&str], &Parameters) -> Vec<bool>;

/// The trajectory of one point.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Name as in `POINT:LABELS`, `LABELS2` ...; `*3` for the third point if it has none.
    pub name: String,
    /// Text of `POINT:DESCRIPTIONS`.
    pub description: String,
    /// Position in the file's unit and axes, one per frame; not-a-number in all three where the marker is missing.
    pub positions: Vec<[f64; 3]>,
    /// Residual: mean distance from the rays of the cameras, in the file's unit, one per frame; zero: filtered or
    /// filled; not-a-number where the point is missing.
    pub residuals: Vec<f64>,
    /// Bit n: seen by camera n + 1; one value per frame; zero where the point is missing or cameras are not stated.
    pub cameras: Vec<u8>,
}

impl Point {
    /// A point with these positions, residual zero and no cameras.
    pub fn new(name: &str, positions: Vec<[f64; 3]>) -> Point {
        let seen = |position: &[f64; 3]| position.iter().all(|value| value.is_finite());
        let residuals = positions.iter().map(|position| if seen(position) { 0.0 } else { f64::NAN }).collect();
        let cameras = vec![0; positions.len()];
        Point { name: name.into(), description: String::new(), positions, residuals, cameras }
    }
}

/// A point in one frame.
struct Sighting {
    position: [f64; 3],
    residual: f64,
    cameras: u8,
}

const UNSEEN: Sighting = Sighting { position: [f64::NAN; 3], residual: f64::NAN, cameras: 0 };
/// All sixteen bits: missing.
const ALL_BITS: u16 = 0xffff;

/// The points of the data that are wanted. A point at exactly 0 0 0 is kept.
pub(super) fn read(
    words: Words<'_>,
    layout: &Layout,
    encoding: &Encoding,
    parameters: &Parameters,
    choice: Option<Choice<'_>>,
    remarks: &mut Vec<Remark>,
) -> Vec<Point> {
    let mut points = wanted(named(layout, parameters, remarks), parameters, choice);
    for (_, point) in &mut points {
        point.positions.reserve_exact(layout.frames);
        point.residuals.reserve_exact(layout.frames);
        point.cameras.reserve_exact(layout.frames);
    }
    let point_bytes = 4 * layout.width();
    for frame in 0..layout.frames {
        let start = layout.data_offset + frame * layout.frame_bytes();
        for (place, point) in &mut points {
            let at = start + *place * point_bytes;
            let scale = encoding.point_scale;
            let sighting = match layout.storage {
                Storage::Integer => words.array(at).and_then(|four| integers(words.processor, four, scale)),
                Storage::Real => words.array(at).and_then(|four| reals(words.processor, four, scale)),
            };
            let Sighting { position, residual, cameras } = sighting.unwrap_or(UNSEEN);
            point.positions.push(position);
            point.residuals.push(residual);
            point.cameras.push(cameras);
        }
    }
    points.into_iter().map(|(_, point)| point).collect()
}

/// The points that are read, each with its place in a frame; all of them if none is wanted.
fn wanted(points: Vec<Point>, parameters: &Parameters, choice: Option<Choice<'_>>) -> Vec<(usize, Point)> {
    let names: Vec<&str> = points.iter().map(|point| point.name.as_str()).collect();
    let is_wanted = choice.map_or_else(Vec::new, |choice| choice(&names, parameters));
    let none_is = is_wanted.len() == points.len() && !is_wanted.contains(&true);
    let keep = |place: &usize| none_is || is_wanted.get(*place).is_none_or(|wanted| *wanted);
    points.into_iter().enumerate().filter(|(place, _)| keep(place)).collect()
}

/// The points without their frames.
fn named(layout: &Layout, parameters: &Parameters, remarks: &mut Vec<Remark>) -> Vec<Point> {
    let labels = parameters.texts("POINT", "LABELS");
    let descriptions = parameters.texts("POINT", "DESCRIPTIONS");
    if labels.len() < layout.points {
        let message = format!(
            "{} of {} points have no name in POINT:LABELS; they were named *n",
            layout.points - labels.len(),
            layout.points
        );
        remarks.push(Remark::of_file(message));
    }
    let named = |i: usize| Point {
        name: labels.get(i).filter(|name| !name.is_empty()).map_or_else(|| format!("*{}", i + 1), |&name| name.into()),
        description: descriptions.get(i).copied().unwrap_or_default().into(),
        positions: Vec::new(),
        residuals: Vec::new(),
        cameras: Vec::new(),
    };
    (0..layout.points).map(named).collect()
}

/// The bytes of four 16-bit words.
fn integers(processor: Processor, four: [u8; 8], scale: f64) -> Option<Sighting> {
    let [x0, x1, y0, y1, z0, z1, w0, w1] = four;
    let word = processor.i16([w0, w1]);
    if word < 0 {
        return None;
    }
    let position = [[x0, x1], [y0, y1], [z0, z1]].map(|bytes| f64::from(processor.i16(bytes)) * scale);
    Some(sighting(position, word.cast_unsigned(), scale))
}

/// The bytes of four reals.
fn reals(processor: Processor, four: [u8; 16], scale: f64) -> Option<Sighting> {
    let [x0, x1, x2, x3, y0, y1, y2, y3, z0, z1, z2, z3, w0, w1, w2, w3] = four;
    let word = word_of_real(processor.f32([w0, w1, w2, w3]))?;
    let position = [[x0, x1, x2, x3], [y0, y1, y2, y3], [z0, z1, z2, z3]].map(|bytes| f64::from(processor.f32(bytes)));
    let is_seen = position.iter().all(|value| value.is_finite());
    is_seen.then(|| sighting(position, word, scale))
}

/// The fourth value of a real file as 16 bits; `None` if the point is missing.
fn word_of_real(value: f32) -> Option<u16> {
    if !value.is_finite() || value < 0.0 {
        return None;
    }
    let word = if value <= f32::from(u16::MAX) { value as u16 } else { (value.to_bits() >> 16) as u16 };
    (word != ALL_BITS).then_some(word)
}

/// The word of a point that is present; `None` if residual and cameras do not fit into it.
pub(super) fn word_of_sighting(residual: f64, cameras: u8, scale: f64, storage: Storage) -> Option<u16> {
    let steps = if residual.is_nan() { 0.0 } else { (residual / scale).round() };
    if !(0.0..=255.0).contains(&steps) {
        return None;
    }
    let word = u16::from_be_bytes([cameras, steps as u8]);
    match storage {
        Storage::Integer => (cameras < 128).then_some(word),
        Storage::Real => (word != ALL_BITS).then_some(word),
    }
}

fn sighting(position: [f64; 3], word: u16, scale: f64) -> Sighting {
    let [cameras, residual] = word.to_be_bytes();
    Sighting { position, residual: f64::from(residual) * scale, cameras }
}
