//! Force platforms: where they stand and which channels they use.
//!
//! | parameter of FORCE_PLATFORM | shape | content |
//! |---|---|---|
//! | USED | | number of platforms |
//! | TYPE | n | 1: force and centre of pressure, 2: force and moment, 3: eight sensors, 4: 2 with calibration matrix, .. |
//! | CORNERS | 3, 4, n | corners in laboratory axes, in the unit of the points |
//! | ORIGIN | 3, n | types 1, 2, 4: from the platform's origin to the middle of its surface, in its own axes; type 3: distances of the sensors |
//! | CHANNEL | k, n | numbers of channels, from 1 |
//! | CAL_MATRIX | rows, columns, n | by columns; force = matrix · channels |
//! | ZERO | 2 | first and last frame of the baseline; 0 0: none |
//!
//! Source: C3D user guide (c3d.org), "The FORCE_PLATFORM group".

use super::parameters::Parameters;
use crate::error::Error;

/// One force platform, as the file describes it.
#[derive(Debug, Clone, PartialEq)]
pub struct Platform {
    /// Type 1 to 7 (other numbers of other makers are possible).
    pub kind: u8,
    /// Corners in laboratory axes, in the unit of the points: in the quadrants (+x +y), (-x +y), (-x -y), (+x -y) of
    /// the platform's own axes.
    pub corners: [[f64; 3]; 4],
    /// ORIGIN as stated, in the unit of the points; what it means depends on the type.
    pub origin: [f64; 3],
    /// Its channels, as indices (from 0) into [`super::C3d::channels`]; none where the file has the number 0.
    pub channels: Vec<Option<usize>>,
    /// Rows of the calibration matrix; empty if there is none.
    pub calibration: Vec<Vec<f64>>,
    /// First and last frame of the baseline, where one is stated.
    pub zero_frames: Option<[i64; 2]>,
}

const GROUP: &str = "FORCE_PLATFORM";

/// All platforms. `channels` is the number of analog channels.
pub(super) fn platforms(parameters: &Parameters, channels: usize) -> Result<Vec<Platform>, Error> {
    let used = parameters.count(GROUP, "USED").unwrap_or(0);
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
        channels: channel_indices(parameters, index, channels)?,
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

fn channel_indices(parameters: &Parameters, index: usize, channels: usize) -> Result<Vec<Option<usize>>, Error> {
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
    column.iter().map(checked).collect()
}

/// The matrix of one platform, turned from columns to rows. Missing or empty: none.
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
