//! Reading C3D files.

use super::header::{Header, parameter_offset};
use super::layout::{self, Extent, Layout};
use super::parameters::Parameters;
use super::points::Choice;
use super::words::Words;
use super::{C3d, Encoding, analog, events, points, rotations, section};
use crate::content;
use crate::error::{Error, Remark};

/// `choice`: all points if it is `None`.
pub(super) fn read(bytes: &[u8], choice: Option<Choice<'_>>) -> Result<(C3d, Vec<Remark>), Error> {
    match read_bytes(bytes, choice) {
        Ok((c3d, _)) if c3d.frames() == 0 && content::was_changed_as_text(bytes).is_some() => {
            let expected = "a recorded trial".to_owned();
            Err(Error::CutOff { offset: bytes.len(), expected }.or_changed_as_text(bytes))
        }
        Err(error) => Err(error.or_changed_as_text(bytes).or_other_content(bytes, content::C3D)),
        read => read,
    }
}

fn read_bytes(bytes: &[u8], choice: Option<Choice<'_>>) -> Result<(C3d, Vec<Remark>), Error> {
    let mut remarks = Vec::new();
    let start = parameter_offset(bytes)?;
    let processor = section::processor(bytes, start, &mut remarks)?;
    let words = Words { bytes, processor };
    let header = Header::read(words)?;
    let parameters = section::read(words, start, header.data_block, &mut remarks)?;
    let file = Extent { size: bytes.len(), after_parameters: section::end(words, start) };
    let layout = layout::decide(&header, &parameters, &file, &mut remarks)?;
    let Layout { storage, point_scale, .. } = layout;
    let unsigned_analog = analog::unsigned(&parameters, &mut remarks);
    let encoding = Encoding { processor, storage, point_scale, unsigned_analog };
    let points = points::read(words, &layout, &encoding, &parameters, choice, &mut remarks);
    let channels = analog::read(words, &layout, &encoding, &parameters, &mut remarks);
    check_analog_rate(&layout, &parameters, &mut remarks);
    let rotations = rotations::read(words, &layout, &header, &parameters, &file, &mut remarks);
    let start_s = (layout.first_frame - 1) as f64 / layout.point_rate_hz;
    let events = events::read(words, &parameters, start_s, &mut remarks);
    let recording = C3d {
        encoding,
        point_rate_hz: layout.point_rate_hz,
        point_unit: parameters.text("POINT", "UNITS").unwrap_or_default().to_owned(),
        first_frame: layout.first_frame,
        longest_gap: header.longest_gap,
        points,
        analog_rate_hz: analog_rate(&layout),
        channels,
        rotation_rate_hz: layout.point_rate_hz * rotations.per_frame as f64,
        rotations: rotations.rotations,
        events,
        parameters,
    };
    Ok((recording, remarks))
}

fn analog_rate(layout: &Layout) -> f64 {
    if layout.channels == 0 { 0.0 } else { layout.point_rate_hz * layout.samples_per_frame as f64 }
}

fn check_analog_rate(layout: &Layout, parameters: &Parameters, remarks: &mut Vec<Remark>) {
    let rate = analog_rate(layout);
    let stated = parameters.number("ANALOG", "RATE").unwrap_or(rate);
    // A part in a thousand: rates are rounded, but devices deviate by less.
    if layout.channels > 0 && (stated - rate).abs() > 1e-3 * rate {
        let samples = layout.samples_per_frame;
        let message = format!("ANALOG:RATE is {stated} Hz, but a frame has {samples} samples; {rate} Hz was used");
        let contradicts = (stated / rate - 1.0).abs() > layout::SAME_RATE && remarks.iter().all(|r| !r.is_about_clock);
        remarks.push(if contradicts { Remark::of_clock(message) } else { Remark::of_file(message) });
    }
}
