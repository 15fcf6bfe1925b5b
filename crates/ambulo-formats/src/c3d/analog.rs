//! Analog channels: the second part of every frame.
//!
//! ```text
//! value = (raw - offset) · scale · general scale          ANALOG:OFFSET, SCALE, GEN_SCALE
//! ```
//!
//! Within a frame, all channels of the first sample come first, then all channels of the second, and so on.
//! Source: C3D user guide (c3d.org), "Analog data - integer format".

use super::layout::Layout;
use super::parameters::Parameters;
use super::words::Words;
use super::{Encoding, Storage};
use crate::error::Remark;

/// One analog channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// Name as in `ANALOG:LABELS`, `LABELS2` ...; `*3` for the third channel if it has none.
    pub name: String,
    /// Unit as in `ANALOG:UNITS`: `N`, `Nmm`, `V`; empty if the file has none.
    pub unit: String,
    /// Text of `ANALOG:DESCRIPTIONS`.
    pub description: String,
    /// The samples in that unit: (raw - offset) · scale.
    pub samples: Vec<f64>,
    /// Units per step of the raw numbers, including the general scale.
    pub scale: f64,
    /// The raw number of zero.
    pub offset: f64,
}

impl Channel {
    /// A channel whose raw numbers equal its samples.
    pub fn new(name: &str, unit: &str, samples: Vec<f64>) -> Channel {
        let (name, unit) = (name.into(), unit.into());
        Channel { name, unit, description: String::new(), samples, scale: 1.0, offset: 0.0 }
    }
}

/// Whether integer samples are unsigned.
pub(super) fn unsigned(parameters: &Parameters, remarks: &mut Vec<Remark>) -> bool {
    if let Some(format) = parameters.text("ANALOG", "FORMAT").filter(|format| !format.is_empty()) {
        return format.eq_ignore_ascii_case("UNSIGNED");
    }
    // Half the range of unsigned 16-bit numbers. As a signed number it would be at the end of the range.
    let middle = |offset: &f64| [32767.0, -32768.0].iter().any(|end| (offset - end).abs() < 0.5);
    let Some(offset) = parameters.numbers("ANALOG", "OFFSET").into_iter().find(middle) else {
        return false;
    };
    let message =
        format!("ANALOG:OFFSET is {offset} and ANALOG:FORMAT is missing; samples and offsets were read as unsigned");
    remarks.push(Remark::of_file(message));
    true
}

/// All channels of the data.
pub(super) fn read(
    words: Words<'_>,
    layout: &Layout,
    encoding: &Encoding,
    parameters: &Parameters,
    remarks: &mut Vec<Remark>,
) -> Vec<Channel> {
    let mut channels = named(layout, encoding, parameters, remarks);
    let width = layout.width();
    for frame in 0..layout.frames {
        let start = layout.data_offset + frame * layout.frame_bytes() + 4 * layout.points * width;
        for sample in 0..layout.samples_per_frame {
            for (i, channel) in channels.iter_mut().enumerate() {
                let at = start + (sample * layout.channels + i) * width;
                let raw = raw(words, at, encoding).unwrap_or(f64::NAN);
                channel.samples.push((raw - channel.offset) * channel.scale);
            }
        }
    }
    channels
}

fn raw(words: Words<'_>, at: usize, encoding: &Encoding) -> Option<f64> {
    Some(match encoding.storage {
        Storage::Real => f64::from(words.f32(at)?),
        Storage::Integer if encoding.unsigned_analog => f64::from(words.u16(at)?),
        Storage::Integer => f64::from(words.i16(at)?),
    })
}

/// ANALOG:GEN_SCALE; 1 if it is missing, or if it would make every sample zero.
fn general_scale(parameters: &Parameters, remarks: &mut Vec<Remark>) -> f64 {
    match parameters.number("ANALOG", "GEN_SCALE") {
        Some(scale) if scale.is_finite() && scale.abs() > 0.0 => scale,
        Some(scale) => {
            remarks.push(Remark::of_file(format!("ANALOG:GEN_SCALE is {scale}; 1 is taken")));
            1.0
        }
        None => 1.0,
    }
}

/// The channels without their samples.
fn named(layout: &Layout, encoding: &Encoding, parameters: &Parameters, remarks: &mut Vec<Remark>) -> Vec<Channel> {
    let labels = parameters.texts("ANALOG", "LABELS");
    let units = parameters.texts("ANALOG", "UNITS");
    let descriptions = parameters.texts("ANALOG", "DESCRIPTIONS");
    let scales = parameters.numbers("ANALOG", "SCALE");
    let offsets = parameters.numbers("ANALOG", "OFFSET");
    let general = general_scale(parameters, remarks);
    for (name, count) in [("LABELS", labels.len()), ("SCALE", scales.len()), ("OFFSET", offsets.len())] {
        if count < layout.channels {
            let taken = match name {
                "LABELS" => "the rest were named *n",
                "SCALE" => "1 was used for the rest",
                _ => "0 was used for the rest",
            };
            let message = format!("ANALOG:{name} has {count} values for {} channels; {taken}", layout.channels);
            remarks.push(Remark::of_file(message));
        }
    }
    let signless = |offset: f64| if encoding.unsigned_analog && offset < 0.0 { offset + 65536.0 } else { offset };
    let named = |i: usize| Channel {
        name: labels.get(i).filter(|name| !name.is_empty()).map_or_else(|| format!("*{}", i + 1), |&name| name.into()),
        unit: units.get(i).copied().unwrap_or_default().into(),
        description: descriptions.get(i).copied().unwrap_or_default().into(),
        samples: Vec::with_capacity(layout.frames * layout.samples_per_frame),
        scale: scales.get(i).copied().unwrap_or(1.0) * general,
        offset: offsets.get(i).copied().map_or(0.0, signless),
    };
    (0..layout.channels).map(named).collect()
}
