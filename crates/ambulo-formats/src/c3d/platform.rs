//! Force platforms: position, type, channels and calibration.
//!
//! | parameter of FORCE_PLATFORM | shape | content |
//! |---|---|---|
//! | USED | | number of platforms |
//! | TYPE | n | 1: force and centre of pressure, 2: force and moment, 3: eight sensors, 4: 2 with calibration matrix, .. |
//! | CORNERS | 3, 4, n | corners in laboratory axes, in the unit of the points |
//! | ORIGIN | 3, n | types 1, 2, 4: from the platform's origin to the middle of its surface, in the platform's axes; type 3: distances of the sensors |
//! | CHANNEL | k, n | numbers of channels, from 1 |
//! | CAL_MATRIX | rows, columns, n | column by column; force = matrix · channels |
//! | ZERO | 2 | first and last frame of the baseline; 0 0: none |
//!
//! | type | channels |
//! |---|---|
//! | 1 | Fx Fy Fz, centre of pressure x y, free moment Tz |
//! | 2, 4 | Fx Fy Fz Mx My Mz; 4: after multiplication with a 6 x 6 matrix |
//! | 3, 7 | Fx12 Fx34 Fy14 Fy23 Fz1 Fz2 Fz3 Fz4; 7: after multiplication with an 8 x 8 matrix |
//! | 5 | Cz Dz Az Bz Yac Xdc Xab Ybd |
//! | 6 | Fx Fy Fz of each of four sensors, with a 12 x 12 matrix |
//!
//! Sources: C3D user guide (c3d.org), "The FORCE_PLATFORM group", "FORCE_PLATFORM:CAL_MATRIX" (by columns);
//! channels of types 5 to 7: Visual3D documentation (wiki.has-motion.com), "FP_Type".

use super::parameters::{Group, Parameter, Parameters, Values};
use crate::error::Error;

/// One force platform, as described in the file.
#[derive(Debug, Clone, PartialEq)]
pub struct Platform {
    /// Type 1 to 7 (other numbers of other makers are possible).
    pub kind: u8,
    /// Corners in laboratory axes, in the unit of the points: in the quadrants (+x +y), (-x +y), (-x -y), (+x -y) of
    /// the platform's own axes.
    pub corners: [[f64; 3]; 4],
    /// ORIGIN as stated, in the unit of the points; its meaning depends on the type.
    pub origin: [f64; 3],
    /// Its channels, as indices (from 0) into [`super::C3d::channels`]; none for the number 0. Types 1 to
    /// 7 have as many as the type needs (6, 6, 8, 6, 8, 12, 8), or fewer if the file names fewer.
    pub channels: Vec<Option<usize>>,
    /// Rows of the calibration matrix; empty if there is none.
    pub calibration: Vec<Vec<f64>>,
    /// First and last frame of the baseline, if it is stated.
    pub zero_frames: Option<[i64; 2]>,
}

const GROUP: &str = "FORCE_PLATFORM";
/// No laboratory has more; a larger number is damage.
const MOST_PLATFORMS: usize = 256;

/// Every platform that the file states, or what its description lacks. `channels` is the number of analog channels.
pub(super) fn platforms(parameters: &Parameters, channels: usize) -> Vec<Result<Platform, Error>> {
    let used = parameters.count(GROUP, "USED").unwrap_or(0).min(MOST_PLATFORMS);
    let zero_frames = zero_frames(parameters);
    (0..used).map(|index| platform(parameters, index, channels, zero_frames)).collect()
}

fn platform(
    parameters: &Parameters,
    index: usize,
    channels: usize,
    zero_frames: Option<[i64; 2]>,
) -> Result<Platform, Error> {
    let kinds = numbers(parameters, "TYPE")?;
    let kind = *kinds.get(index).ok_or_else(|| too_few("TYPE", kinds.len(), index))?;
    if !(1.0..=255.0).contains(&kind) {
        return Err(wrong("TYPE", format!("{kind} for platform {}", index + 1), "a type from 1 to 7"));
    }
    let mut corners = [[0.0; 3]; 4];
    corners.as_flattened_mut().copy_from_slice(&part::<12>(parameters, "CORNERS", index)?);
    Ok(Platform {
        kind: kind as u8,
        corners,
        origin: part::<3>(parameters, "ORIGIN", index)?,
        channels: channel_indices(parameters, kind as u8, index, channels)?,
        calibration: calibration(parameters, index)?,
        zero_frames,
    })
}

fn numbers(parameters: &Parameters, name: &str) -> Result<Vec<f64>, Error> {
    let parameter =
        parameters.get(GROUP, name).ok_or_else(|| wrong(name, "nothing", "its values for every platform"))?;
    parameter.numbers().ok_or_else(|| wrong(name, "text", "numbers"))
}

/// The `index`th group of `N` numbers.
fn part<const N: usize>(parameters: &Parameters, name: &str, index: usize) -> Result<[f64; N], Error> {
    let numbers = numbers(parameters, name)?;
    let part = numbers.get(N * index..).and_then(|rest| rest.first_chunk()).copied();
    part.ok_or_else(|| too_few(name, numbers.len(), index))
}

/// Channels of one platform of this type; for other types, all that the file names.
fn needed_channels(kind: u8) -> usize {
    match kind {
        1 | 2 | 4 => 6,
        3 | 5 | 7 => 8,
        6 => 12,
        _ => usize::MAX,
    }
}

fn channel_indices(
    parameters: &Parameters,
    kind: u8,
    index: usize,
    channels: usize,
) -> Result<Vec<Option<usize>>, Error> {
    let Some(parameter) = parameters.get(GROUP, "CHANNEL") else {
        return Err(wrong("CHANNEL", "nothing", "numbers of channels"));
    };
    let numbers = parameter.counts().ok_or_else(|| wrong("CHANNEL", parameter.to_string(), "numbers of channels"))?;
    // Column `index` of k rows; a list without columns belongs to one platform.
    let rows = parameter.dimensions.first().copied().unwrap_or(1);
    let column =
        numbers.get(rows * index..rows * (index + 1)).ok_or_else(|| too_few("CHANNEL", numbers.len(), index))?;
    let checked = |&number: &usize| match number.checked_sub(1) {
        Some(place) if place >= channels => {
            Err(wrong("CHANNEL", format!("channel {number}"), &format!("1 to {channels}, the channels of the file")))
        }
        place => Ok(place),
    };
    column.iter().take(needed_channels(kind)).map(checked).collect()
}

/// The matrix of one platform by rows (the file has it by columns); empty if it is missing.
fn calibration(parameters: &Parameters, index: usize) -> Result<Vec<Vec<f64>>, Error> {
    let Some(parameter) = parameters.get(GROUP, "CAL_MATRIX") else {
        return Ok(vec![]);
    };
    let numbers = parameter.numbers().unwrap_or_default();
    let (rows, columns) = match parameter.dimensions[..] {
        [rows, columns, ..] => (rows, columns),
        _ => (0, 0),
    };
    let size = rows * columns;
    if size == 0 || numbers.is_empty() {
        return Ok(vec![]);
    }
    let Some(matrix) = numbers.get(size * index..size * (index + 1)) else {
        // Some files have matrices only for the platforms that need one.
        return Ok(vec![]);
    };
    Ok((0..rows).map(|row| (0..columns).map(|column| matrix[row + rows * column]).collect()).collect())
}

/// The group FORCE_PLATFORM that describes these platforms. Lists that are shorter than others are filled up with
/// channel 0 (none) and with zeros in matrices. The baseline comes from the first platform.
pub(super) fn group(platforms: &[Platform]) -> Group {
    let count = platforms.len();
    let rows = platforms.iter().map(|platform| platform.channels.len()).max().unwrap_or(0);
    let number = |platform: &Platform, row: usize| {
        let place = platform.channels.get(row).copied().flatten();
        place.map_or(0, |place| (place + 1) as u16).cast_signed()
    };
    let channels = platforms.iter().flat_map(|platform| (0..rows).map(move |row| number(platform, row))).collect();
    let zero = platforms.first().and_then(|platform| platform.zero_frames).unwrap_or_default();
    let reals = |values: &[f64]| values.iter().map(|&value| value as f32).collect::<Vec<f32>>();
    let corners = platforms.iter().flat_map(|platform| reals(platform.corners.as_flattened())).collect();
    let origins = platforms.iter().flat_map(|platform| reals(&platform.origin)).collect();
    let shaped = |name, dimensions: &[usize], values| Parameter {
        dimensions: dimensions.to_vec(),
        ..Parameter::list(name, values)
    };
    let mut parameters = vec![
        Parameter::single("USED", Values::Integers(vec![count as i16])),
        Parameter::list("TYPE", Values::Integers(platforms.iter().map(|platform| i16::from(platform.kind)).collect())),
        Parameter::list("ZERO", Values::Integers(zero.map(|frame| (frame as u16).cast_signed()).to_vec())),
        shaped("CORNERS", &[3, 4, count], Values::Reals(corners)),
        shaped("ORIGIN", &[3, count], Values::Reals(origins)),
        shaped("CHANNEL", &[rows, count], Values::Integers(channels)),
    ];
    parameters.extend(matrices(platforms));
    Group { name: GROUP.into(), parameters, ..Group::default() }
}

/// All calibration matrices, by columns; `None` if no platform has one.
fn matrices(platforms: &[Platform]) -> Option<Parameter> {
    let rows = platforms.iter().map(|platform| platform.calibration.len()).max()?;
    let columns = platforms.iter().flat_map(|platform| platform.calibration.iter().map(Vec::len)).max()?;
    let element = |platform: &Platform, row: usize, column: usize| {
        let value = platform.calibration.get(row).and_then(|row| row.get(column));
        value.map_or(0.0, |&value| value as f32)
    };
    let mut values = Vec::with_capacity(rows * columns * platforms.len());
    for platform in platforms {
        for column in 0..columns {
            values.extend((0..rows).map(|row| element(platform, row, column)));
        }
    }
    let dimensions = vec![rows, columns, platforms.len()];
    Some(Parameter { dimensions, ..Parameter::list("CAL_MATRIX", Values::Reals(values)) })
}

fn zero_frames(parameters: &Parameters) -> Option<[i64; 2]> {
    let counts = parameters.get(GROUP, "ZERO")?.counts()?;
    let frames = counts.first_chunk::<2>()?.map(|frame| i64::try_from(frame).unwrap_or(0));
    (frames[0] > 0 && frames[1] >= frames[0]).then_some(frames)
}

fn too_few(name: &str, count: usize, index: usize) -> Error {
    wrong(name, format!("{count} values"), &format!("enough for platform {}", index + 1))
}

fn wrong(name: &str, found: impl Into<String>, expected: &str) -> Error {
    Error::Parameter { parameter: format!("{GROUP}:{name}"), found: found.into(), expected: expected.into() }
}
