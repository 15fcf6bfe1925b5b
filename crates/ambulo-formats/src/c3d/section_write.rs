//! The parameter section from [`Parameters`]. See `section` for its form.

use super::header::BLOCK;
use super::parameters::{Group, Parameter, Parameters, Values};
use super::section::SECTION_HEADER;
use super::words::Processor;
use crate::error::{Error, quoted};

/// A section states its length in blocks in one byte.
const BLOCKS: usize = 255;
/// Groups are numbered in seven bits.
const GROUPS: usize = 127;
/// Lengths of names have seven bits, lengths of texts and dimensions eight.
const NAME: usize = 127;
/// Largest dimension, and longest text or description in bytes.
pub(super) const LARGEST: usize = 255;

/// The section's bytes, padded to whole blocks.
pub(super) fn write(parameters: &Parameters, processor: Processor) -> Result<Vec<u8>, Error> {
    if parameters.groups.len() > GROUPS {
        return Err(invalid(format!("{} groups of parameters", parameters.groups.len()), format!("at most {GROUPS}")));
    }
    let mut bytes = vec![0; SECTION_HEADER];
    for (group, number) in parameters.groups.iter().zip(1i8..) {
        // A group without a name holds parameters whose group the file does not name.
        if !group.name.is_empty() {
            write_group(group, number, processor, &mut bytes)?;
        }
        for parameter in &group.parameters {
            write_parameter(group, parameter, number, processor, &mut bytes)?;
        }
    }
    bytes.extend([0, 0]);
    let blocks = bytes.len().div_ceil(BLOCK);
    if blocks > BLOCKS {
        return Err(invalid(format!("parameters of {} bytes", bytes.len()), format!("at most {}", BLOCKS * BLOCK)));
    }
    bytes.resize(blocks * BLOCK, 0);
    bytes[..SECTION_HEADER].copy_from_slice(&[1, super::header::KEY, blocks as u8, processor.code()]);
    Ok(bytes)
}

fn write_group(group: &Group, number: i8, processor: Processor, bytes: &mut Vec<u8>) -> Result<(), Error> {
    write_name(&group.name, &group.name, group.locked, -number, bytes)?;
    let body = description(&group.name, &group.description)?;
    link(&group.name, &body, processor, bytes)
}

fn write_parameter(
    group: &Group,
    parameter: &Parameter,
    number: i8,
    processor: Processor,
    bytes: &mut Vec<u8>,
) -> Result<(), Error> {
    let place = format!("{}:{}", group.name, parameter.name);
    check_shape(&place, parameter)?;
    write_name(&place, &parameter.name, parameter.locked, number, bytes)?;
    let mut body = Vec::new();
    let (kind, width) = kind(&place, &parameter.values)?;
    body.push(kind.cast_unsigned());
    let dimensions: Vec<usize> = width.into_iter().chain(parameter.dimensions.iter().copied()).collect();
    body.push(dimensions.len() as u8);
    body.extend(dimensions.iter().map(|&dimension| dimension as u8));
    write_values(&place, &parameter.values, width.unwrap_or(0), processor, &mut body)?;
    body.extend(description(&place, &parameter.description)?);
    link(&place, &body, processor, bytes)
}

/// Checks that the number of values and the shape agree, and that each dimension can be written.
fn check_shape(place: &str, parameter: &Parameter) -> Result<(), Error> {
    let dimensions = &parameter.dimensions;
    if dimensions.len() > LARGEST - 1 || dimensions.iter().any(|&dimension| dimension > LARGEST) {
        return Err(invalid(format!("{place} of shape {dimensions:?}"), format!("dimensions up to {LARGEST}")));
    }
    let size = dimensions.iter().try_fold(1usize, |size, &dimension| size.checked_mul(dimension));
    if size != Some(parameter.values.len()) {
        let found = format!("{place} of shape {dimensions:?} with {} values", parameter.values.len());
        return Err(invalid(found, "as many values as its shape has"));
    }
    Ok(())
}

/// Type, and for texts the width of all of them.
fn kind(place: &str, values: &Values) -> Result<(i8, Option<usize>), Error> {
    Ok(match values {
        Values::Texts(texts) => {
            let width = texts.iter().map(String::len).max().unwrap_or(0);
            if width > LARGEST {
                return Err(invalid(format!("{place} with a text of {width} bytes"), format!("at most {LARGEST}")));
            }
            (-1, Some(width))
        }
        Values::Bytes(_) => (1, None),
        Values::Integers(_) => (2, None),
        Values::Reals(_) => (4, None),
    })
}

fn write_values(
    place: &str,
    values: &Values,
    width: usize,
    processor: Processor,
    body: &mut Vec<u8>,
) -> Result<(), Error> {
    match values {
        Values::Texts(texts) => {
            for text in texts {
                body.extend(text.bytes());
                body.extend(std::iter::repeat_n(b' ', width - text.len()));
            }
        }
        Values::Bytes(values) => body.extend(values),
        Values::Integers(values) => {
            body.extend(values.iter().flat_map(|value| processor.u16_bytes(value.cast_unsigned())));
        }
        Values::Reals(values) => {
            for &value in values {
                let bytes = processor.f32_bytes(value);
                body.extend(bytes.ok_or_else(|| invalid(format!("{place} of {value}"), "a VAX real"))?);
            }
        }
    }
    Ok(())
}

fn write_name(place: &str, name: &str, locked: bool, number: i8, bytes: &mut Vec<u8>) -> Result<(), Error> {
    let length = name.len();
    if length == 0 || length > NAME || name.bytes().any(|byte| byte.is_ascii_control()) {
        let found = format!("the name {} of {}", quoted(name), quoted(place));
        return Err(invalid(found, format!("1 to {NAME} printable bytes")));
    }
    let length = length as i8;
    bytes.push(if locked { -length } else { length }.cast_unsigned());
    bytes.push(number.cast_unsigned());
    bytes.extend(name.bytes());
    Ok(())
}

fn description(place: &str, text: &str) -> Result<Vec<u8>, Error> {
    if text.len() > LARGEST {
        let found = format!("a description of {place} with {} bytes", text.len());
        return Err(invalid(found, format!("at most {LARGEST}")));
    }
    Ok(std::iter::once(text.len() as u8).chain(text.bytes()).collect())
}

/// The offset to the next record, then the body.
fn link(place: &str, body: &[u8], processor: Processor, bytes: &mut Vec<u8>) -> Result<(), Error> {
    let Ok(offset) = u16::try_from(body.len() + 2) else {
        return Err(invalid(format!("{place} of {} bytes", body.len()), "at most 65533"));
    };
    bytes.extend(processor.u16_bytes(offset));
    bytes.extend(body);
    Ok(())
}

fn invalid(found: impl Into<String>, expected: impl Into<String>) -> Error {
    Error::Record { found: found.into(), expected: expected.into() }
}
