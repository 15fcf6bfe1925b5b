//! Rotations: poses of segments, in a separate section.
//!
//! For each frame, and within it for each sample, all segments: sixteen reals of a 4 x 4 matrix, column by column, then
//! one real that states the reliability. The matrix maps points of the segment to points of the laboratory; its last
//! column is the origin of the segment in the unit of the points. The numbers are reals also in files with integer
//! points.
//!
//! `ROTATION:DATA_START` is the block where the section begins, `USED` the number of segments, `RATIO` (or `RATE`) the
//! samples per frame of the points, `FRAMES` the number of samples; Theia3D 2020 leaves `FRAMES` out. A file without
//! points and channels has the number of frames in its header.
//!
//! A pose is missing if its reliability is negative (Theia3D writes -1 with matrices of not-a-number), if a number is
//! not finite, or if the rotation is all zeros.
//!
//! Source: wiki.has-motion.com, "ROTATION DATA TYPE"; `C3DRotationExample.c3d` of pyomeca/ezc3d-testFiles, written by
//! Theia3D. Pinned by: tests/c3d_rotations.rs

use super::header::{BLOCK, Header};
use super::layout::{Extent, Layout, rotation_offset, stated_frames};
use super::parameters::{Parameter, Parameters};
use super::words::Words;
use crate::error::Remark;

/// Values of a pose: a 4 x 4 matrix and its reliability.
pub(super) const VALUES: usize = 17;
/// Bytes of a value.
const WIDTH: usize = 4;

/// The pose of one segment over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Rotation {
    /// Name as in `ROTATION:LABELS`, for example `l_thigh_4X4`; `*3` for the third segment if it has none.
    pub name: String,
    /// Text of `ROTATION:DESCRIPTIONS`.
    pub description: String,
    /// `laboratory_from_segment`, one per sample, rows of four; the translation is in the unit of the points.
    /// Not-a-number in all sixteen where the pose is missing.
    pub matrices: Vec<[[f64; 4]; 4]>,
    /// Reliability, one per sample: in files of Theia3D zero, or -1 where the pose is missing.
    pub reliability: Vec<f64>,
}

/// A pose that is missing.
pub(super) const MISSING: [[f64; 4]; 4] = [[f64::NAN; 4]; 4];

impl Rotation {
    /// Poses of a segment, with reliability zero, or -1 where a pose is not finite.
    #[must_use]
    pub fn new(name: &str, matrices: Vec<[[f64; 4]; 4]>) -> Rotation {
        let reliability = matrices.iter().map(|matrix| if is_finite(matrix) { 0.0 } else { -1.0 }).collect();
        let matrices = matrices.into_iter().map(|matrix| if is_finite(&matrix) { matrix } else { MISSING }).collect();
        Rotation { name: name.into(), description: String::new(), matrices, reliability }
    }

    /// Whether the pose of a sample is known.
    #[must_use]
    pub fn is_seen(&self, sample: usize) -> bool {
        self.matrices.get(sample).is_some_and(is_finite)
    }
}

fn is_finite(matrix: &[[f64; 4]; 4]) -> bool {
    matrix.as_flattened().iter().all(|value| value.is_finite())
}

/// The poses of a file, and their samples per frame.
#[derive(Debug, Default)]
pub(super) struct Section {
    pub(super) rotations: Vec<Rotation>,
    pub(super) per_frame: usize,
}

/// Reads all poses. Missing samples at the end are read as missing poses.
pub(super) fn read(
    words: Words<'_>,
    layout: &Layout,
    header: &Header,
    parameters: &Parameters,
    file: &Extent,
    remarks: &mut Vec<Remark>,
) -> Section {
    let used = parameters.count("ROTATION", "USED").unwrap_or(0);
    if used == 0 {
        return Section::default();
    }
    let Some(start) = rotation_offset(parameters).filter(|&start| start >= 2 * BLOCK && start < file.size) else {
        let found = parameters.get("ROTATION", "DATA_START").map_or("missing".into(), Parameter::to_string);
        let message = format!(
            "ROTATION:USED is {used}, but ROTATION:DATA_START is {found}, which is no block of the file; the rotations \
             were not read"
        );
        remarks.push(Remark::of_file(message));
        return Section::default();
    };
    let per_frame = samples_per_frame(layout, parameters, remarks);
    let room = (file.size - start) / used.saturating_mul(VALUES * WIDTH);
    let samples = samples(layout, header, parameters, room, per_frame, remarks);
    if samples == 0 {
        return Section::default();
    }
    let mut rotations = named(used, samples, parameters, room, remarks);
    for sample in 0..samples {
        for (i, rotation) in rotations.iter_mut().enumerate() {
            let at = start + (sample * used + i) * VALUES * WIDTH;
            let (matrix, reliability) = if sample < room { pose(words, at) } else { None }.unwrap_or((MISSING, -1.0));
            rotation.matrices.push(matrix);
            rotation.reliability.push(reliability);
        }
    }
    Section { rotations, per_frame }
}

/// One pose and its reliability.
fn pose(words: Words<'_>, at: usize) -> Option<([[f64; 4]; 4], f64)> {
    let mut matrix = [[0.0; 4]; 4];
    for value in 0..16 {
        matrix[value % 4][value / 4] = f64::from(words.f32(at + WIDTH * value)?);
    }
    let reliability = f64::from(words.f32(at + WIDTH * 16)?);
    let turned = matrix[..3].iter().any(|row| row[..3].iter().any(|value| value.abs() > 0.0));
    let seen = is_finite(&matrix) && turned && reliability >= 0.0;
    let reliability = if reliability.is_nan() { -1.0 } else { reliability };
    Some((if seen { matrix } else { MISSING }, reliability))
}

/// `ROTATION:RATIO`, or the ratio of the rates; 1 if neither can be used.
fn samples_per_frame(layout: &Layout, parameters: &Parameters, remarks: &mut Vec<Remark>) -> usize {
    /// Largest ratio: words of 16 bits.
    const MOST: usize = 65535;
    let usable = |ratio: &usize| (1..=MOST).contains(ratio);
    let stated = parameters.count("ROTATION", "RATIO");
    let rate = parameters.number("ROTATION", "RATE").map(|rate| rate / layout.point_rate_hz);
    let of_rates = rate.filter(|ratio| (0.5..=MOST as f64).contains(ratio)).map(|ratio| ratio.round() as usize);
    if let Some(ratio) = stated.filter(usable).or(of_rates.filter(usable)) {
        return ratio;
    }
    remarks.push(Remark::of_file("ROTATION has no usable RATIO or RATE; one sample per frame was read"));
    1
}

/// Number of samples: as for the points, else as stated; at most as many as the file has room for.
fn samples(
    layout: &Layout,
    header: &Header,
    parameters: &Parameters,
    room: usize,
    per_frame: usize,
    remarks: &mut Vec<Remark>,
) -> usize {
    let stated = parameters.count("ROTATION", "FRAMES").filter(|&frames| frames > 0);
    let of_points = layout.frames.saturating_mul(per_frame);
    if layout.frames > 0 {
        if let Some(stated) = stated.filter(|&stated| stated != of_points && stated != layout.frames) {
            let message = format!(
                "ROTATION:FRAMES is {stated}, but the points have {} frames with {per_frame} samples each; read \
                 {of_points}",
                layout.frames
            );
            remarks.push(Remark::of_file(message));
        }
        // Fewer than half would let a small file ask for much memory.
        let read = if room >= of_points.div_ceil(2) { of_points } else { 0 };
        if room < of_points {
            let rest = if read > 0 { "the others are missing" } else { "they were not read" };
            let message =
                format!("the rotations end after {room} of {of_points} samples; the file is truncated; {rest}");
            remarks.push(Remark::of_file(message));
        }
        return read;
    }
    let claims = stated_frames(header, parameters).into_iter().map(|frames| frames.saturating_mul(per_frame));
    let claim = stated.into_iter().chain(claims).find(|&claim| claim > 0 && claim <= room);
    let samples = claim.unwrap_or(room);
    if claim.is_none() {
        let message =
            format!("no stated number of frames fits the rotations; the file has room for {room}; read {room}");
        remarks.push(Remark::of_file(message));
    }
    samples - samples % per_frame
}

/// The segments without their samples.
fn named(
    used: usize,
    samples: usize,
    parameters: &Parameters,
    room: usize,
    remarks: &mut Vec<Remark>,
) -> Vec<Rotation> {
    let labels = parameters.texts("ROTATION", "LABELS");
    let descriptions = parameters.texts("ROTATION", "DESCRIPTIONS");
    if labels.len() < used {
        let message =
            format!("{} of {used} segments have no name in ROTATION:LABELS; they were named *n", used - labels.len());
        remarks.push(Remark::of_file(message));
    }
    let capacity = samples.min(room);
    let rotation = |i: usize| Rotation {
        name: labels.get(i).filter(|name| !name.is_empty()).map_or_else(|| format!("*{}", i + 1), |&name| name.into()),
        description: descriptions.get(i).copied().unwrap_or_default().into(),
        matrices: Vec::with_capacity(capacity),
        reliability: Vec::with_capacity(capacity),
    };
    (0..used).map(rotation).collect()
}
