//! Writing C3D files.

use super::header::{BLOCK, Header};
use super::points::word_of_sighting;
use super::words::Processor;
use super::{C3d, Channel, Point, Storage, events, section_write, stated};
use crate::error::{Error, quoted};
use std::ops::RangeInclusive;

/// Block of the parameter section.
const PARAMETER_BLOCK: u8 = 2;
/// Range of signed 16-bit integers.
const SIGNED: RangeInclusive<f64> = -32768.0..=32767.0;
/// Range of unsigned 16-bit integers.
const UNSIGNED: RangeInclusive<f64> = 0.0..=65535.0;
/// Rates come from 24-bit reals; one part in a million is above their rounding.
const RATIO_ROUNDING: f64 = 1e-6;
/// Counts of the header are words of 16 bits.
const WORD: usize = 65535;

pub(super) fn write(record: &C3d) -> Result<Vec<u8>, Error> {
    check(record)?;
    let processor = record.encoding.processor;
    // The length of the section does not depend on the numbers of the blocks.
    let length = section_write::write(&stated::parameters(record, [0, 0]), processor)?.len();
    let blocks = data_blocks(usize::from(PARAMETER_BLOCK) + length / BLOCK, record)?;
    let section = section_write::write(&stated::parameters(record, blocks), processor)?;
    let mut bytes = header(record, blocks[0])?;
    bytes.extend(section);
    write_frames(record, &mut bytes)?;
    // Of more frames than the header can count, ezc3d 1.7.2 reads as many as the file contains, so nothing may follow
    // them.
    if record.frames() <= WORD || !record.rotations.is_empty() {
        bytes.resize(bytes.len().next_multiple_of(BLOCK), 0);
    }
    write_rotations(record, &mut bytes)?;
    Ok(bytes)
}

/// The blocks where points and rotations begin in a record whose parameters end before the block `first`.
fn data_blocks(first: usize, record: &C3d) -> Result<[u16; 2], Error> {
    let width = match record.encoding.storage {
        Storage::Integer => 2,
        Storage::Real => 4,
    };
    let values = 4 * record.points.len() + record.channels.len() * record.samples_per_frame();
    let of_points = (record.frames() * values * width).div_ceil(BLOCK);
    let rotations = if record.rotations.is_empty() { 0 } else { first + of_points };
    let block = |block: usize| {
        let expected = "data that begin in the first 65535 blocks of 512 bytes";
        u16::try_from(block).map_err(|_| invalid(format!("data that begin in block {block}"), expected))
    };
    Ok([block(first)?, block(rotations)?])
}

fn header(record: &C3d, data_block: u16) -> Result<Vec<u8>, Error> {
    let samples = if record.channels.is_empty() { 0 } else { record.samples_per_frame() };
    let last = record.first_frame + record.frames() as i64 - 1;
    // 65535 means 65535 or more; the group TRIAL has the number.
    let word = |frame: i64| u16::try_from(frame).unwrap_or(u16::MAX);
    let header = Header {
        points: record.points.len() as u16,
        analog_words: (record.channels.len() * samples) as u16,
        first_frame: word(record.first_frame),
        last_frame: word(last),
        longest_gap: record.longest_gap,
        scale: stated::point_scale(record),
        data_block,
        samples_per_frame: samples as u16,
        rate_hz: record.point_rate_hz as f32,
    };
    let mut bytes = header
        .write(PARAMETER_BLOCK, record.encoding.processor)
        .ok_or_else(|| invalid("a rate or scale beyond the range of VAX reals", "below 1.7e38"))?;
    let start_s = (record.first_frame - 1) as f64 / record.point_rate_hz;
    events::write_header(&record.events, start_s, &mut bytes, record.encoding.processor)?;
    Ok(bytes)
}

/// Rejects what the format cannot hold, before any byte is written.
fn check(record: &C3d) -> Result<(), Error> {
    let positive = |what: &str, value: f64| {
        // The value as it will be read: VAX reals below 2^-128 become zero.
        let bytes = record.encoding.processor.f32_bytes(value as f32);
        let written = bytes.map_or(f32::NAN, |bytes| record.encoding.processor.f32(bytes));
        let fine = written.is_finite() && written > 0.0;
        if fine { Ok(()) } else { Err(invalid(format!("{what} of {value}"), "a finite number above zero")) }
    };
    positive("a rate of points", record.point_rate_hz)?;
    positive("a scale of points", record.encoding.point_scale)?;
    if !(0..=i64::from(u32::MAX) - record.frames() as i64).contains(&record.first_frame) {
        return Err(invalid(format!("first frame {}", record.first_frame), "an unsigned 32-bit number"));
    }
    check_channels(record)?;
    for (what, count) in [
        ("points", record.points.len()),
        ("analog values per frame", record.channels.len() * record.samples_per_frame()),
    ] {
        if count > WORD {
            return Err(invalid(format!("{count} {what}"), format!("at most {WORD}")));
        }
    }
    check_rotations(record)?;
    record.points.iter().try_for_each(|point| check_point(point, record.frames()))
}

fn check_rotations(record: &C3d) -> Result<(), Error> {
    if record.rotations.is_empty() {
        return Ok(());
    }
    let per_frame = record.rotations_per_frame();
    let ratio = record.rotation_rate_hz / record.point_rate_hz;
    if !((ratio - per_frame as f64).abs() <= RATIO_ROUNDING * ratio && per_frame <= WORD) {
        let found = format!("{} poses and {} frames per second", record.rotation_rate_hz, record.point_rate_hz);
        return Err(invalid(found, format!("a whole number of poses per frame, at most {WORD}")));
    }
    if record.rotations.len() > WORD {
        return Err(invalid(format!("{} segments", record.rotations.len()), format!("at most {WORD}")));
    }
    let expected = record.frames() * per_frame;
    for rotation in &record.rotations {
        let counts = [rotation.matrices.len(), rotation.reliability.len()];
        if counts != [expected; 2] {
            let found = format!("{counts:?} matrices and reliabilities of segment {}", quoted(&rotation.name));
            return Err(invalid(found, format!("{expected} of each, {per_frame} for each frame")));
        }
    }
    Ok(())
}

fn check_point(point: &Point, frames: usize) -> Result<(), Error> {
    let counts = [point.positions.len(), point.residuals.len(), point.cameras.len()];
    if counts == [frames; 3] {
        return Ok(());
    }
    let found = format!("{counts:?} positions, residuals and cameras of point {}", quoted(&point.name));
    Err(invalid(found, format!("{frames} of each, as of the first point")))
}

fn check_channels(record: &C3d) -> Result<(), Error> {
    if record.channels.is_empty() {
        return Ok(());
    }
    let samples = record.samples_per_frame();
    let ratio = record.analog_rate_hz / record.point_rate_hz;
    if !((ratio - samples as f64).abs() <= RATIO_ROUNDING * ratio && samples <= WORD) {
        let found = format!("{} analog samples and {} frames per second", record.analog_rate_hz, record.point_rate_hz);
        return Err(invalid(found, format!("a whole number of samples per frame, at most {WORD}")));
    }
    for channel in &record.channels {
        if channel.samples.len() != record.frames() * samples {
            let found = format!("{} samples of channel {}", channel.samples.len(), quoted(&channel.name));
            return Err(invalid(found, format!("{}, {samples} for each frame", record.frames() * samples)));
        }
    }
    Ok(())
}

fn write_frames(record: &C3d, bytes: &mut Vec<u8>) -> Result<(), Error> {
    let general = stated::general_scale(&record.parameters);
    let scales: Vec<f64> = record
        .channels
        .iter()
        .map(|channel| f64::from(stated::channel_scale(channel, general)) * f64::from(general))
        .collect();
    let samples = record.samples_per_frame();
    for frame in 0..record.frames() {
        for point in &record.points {
            write_point(record, point, frame, bytes)?;
        }
        for sample in frame * samples..(frame + 1) * samples {
            for (channel, &scale) in record.channels.iter().zip(&scales) {
                write_sample(record, channel, sample, scale, bytes)?;
            }
        }
    }
    Ok(())
}

fn write_point(record: &C3d, point: &Point, frame: usize, bytes: &mut Vec<u8>) -> Result<(), Error> {
    let encoding = &record.encoding;
    let scale = f64::from(encoding.point_scale as f32);
    let position = point.positions[frame];
    let seen = position.iter().all(|value| value.is_finite());
    let word = if seen {
        let found = || {
            let (residual, cameras) = (point.residuals[frame], point.cameras[frame]);
            format!("residual {residual} and cameras {cameras:#b} of point {} in frame {frame}", quoted(&point.name))
        };
        let word = word_of_sighting(point.residuals[frame], point.cameras[frame], scale, encoding.storage);
        Some(word.ok_or_else(|| invalid(found(), "a residual of at most 255 scales; seven cameras in integer files"))?)
    } else {
        None
    };
    for value in position {
        let value = if seen { value } else { 0.0 };
        let written = match encoding.storage {
            Storage::Integer => integer(value / scale, encoding.processor, SIGNED, bytes),
            Storage::Real => real(value, encoding.processor, bytes),
        };
        written.ok_or_else(|| {
            let found = format!("{value} as a position of point {} in frame {frame}", quoted(&point.name));
            invalid(found, format!("positions that {:?} numbers can hold with scale {scale}", encoding.storage))
        })?;
    }
    let written = match encoding.storage {
        Storage::Integer => integer(word.map_or(-1.0, f64::from), encoding.processor, SIGNED, bytes),
        Storage::Real => real(word.map_or(-1.0, f64::from), encoding.processor, bytes),
    };
    written.ok_or_else(|| invalid("a word beyond 16 bits", "cameras and residual"))
}

fn write_sample(record: &C3d, channel: &Channel, sample: usize, scale: f64, bytes: &mut Vec<u8>) -> Result<(), Error> {
    let encoding = &record.encoding;
    let value = channel.samples[sample];
    // A scale of zero makes every sample zero for any raw number. A sum with zero would lose the sign of -0.
    let steps = if scale.abs() > 0.0 { value / scale } else { 0.0 };
    let raw = if channel.offset.abs() > 0.0 { steps + channel.offset } else { steps };
    let written = match encoding.storage {
        Storage::Integer if encoding.unsigned_analog => integer(raw, encoding.processor, UNSIGNED, bytes),
        Storage::Integer => integer(raw, encoding.processor, SIGNED, bytes),
        Storage::Real => real(raw, encoding.processor, bytes),
    };
    written.ok_or_else(|| {
        let found = format!("{value} as sample {sample} of channel {}", quoted(&channel.name));
        let numbers = encoding.storage;
        invalid(
            found,
            format!("samples that {numbers:?} numbers can hold with scale {scale} and offset {}", channel.offset),
        )
    })
}

/// Appends the rotations. VAX has no not-a-number: missing poses are zeros with their reliability there.
fn write_rotations(record: &C3d, bytes: &mut Vec<u8>) -> Result<(), Error> {
    let processor = record.encoding.processor;
    for sample in 0..record.frames() * record.rotations_per_frame() {
        for rotation in &record.rotations {
            let seen = rotation.is_seen(sample) && rotation.reliability[sample] >= 0.0;
            let absent = if processor == Processor::Dec { 0.0 } else { f64::NAN };
            let value = |i: usize| if seen { rotation.matrices[sample][i % 4][i / 4] } else { absent };
            let reliability = Some(rotation.reliability[sample]).filter(|r| seen || *r < 0.0).unwrap_or(-1.0);
            let values = (0..16).map(value).chain([reliability]);
            let written = values.map(|value| real(value, processor, bytes)).collect::<Option<Vec<()>>>();
            written.ok_or_else(|| {
                let found = format!("the pose of segment {} in sample {sample}", quoted(&rotation.name));
                invalid(found, "numbers that 32-bit reals can hold")
            })?;
        }
    }
    Ok(())
}

/// Appends the nearest 16-bit integer; `None` if there is none.
fn integer(value: f64, processor: Processor, range: RangeInclusive<f64>, bytes: &mut Vec<u8>) -> Option<()> {
    let nearest = value.round();
    let word = range.contains(&nearest).then_some((nearest as i32) as u16)?;
    bytes.extend(processor.u16_bytes(word));
    Some(())
}

/// Appends the nearest 32-bit real; not-a-number is kept, except for VAX, which has none. `None` if it is too large.
fn real(value: f64, processor: Processor, bytes: &mut Vec<u8>) -> Option<()> {
    let nearest = value as f32;
    if nearest.is_infinite() {
        return None;
    }
    bytes.extend(processor.f32_bytes(nearest)?);
    Some(())
}

fn invalid(found: impl Into<String>, expected: impl Into<String>) -> Error {
    Error::Record { found: found.into(), expected: expected.into() }
}
