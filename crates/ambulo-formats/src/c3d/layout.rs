//! Number of points, samples and frames in the data. Header, parameters and size of the file may disagree.

use super::Storage;
use super::header::{BLOCK, Header};
use super::parameters::Parameters;
use crate::error::{Error, Remark};

/// Largest number of 16 bits.
const WORD: usize = 65535;
/// Rates agree if they differ by less, as a share: 29.97 and 30 frames per second do, 50 and 60 do not.
pub(super) const SAME_RATE: f64 = 0.02;

/// Where the data are, and the structure of a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Layout {
    pub(super) storage: Storage,
    pub(super) point_scale: f64,
    pub(super) data_offset: usize,
    pub(super) points: usize,
    pub(super) channels: usize,
    pub(super) samples_per_frame: usize,
    pub(super) frames: usize,
    pub(super) first_frame: i64,
    pub(super) point_rate_hz: f64,
}

/// Bytes of the file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    /// Size of the file [bytes].
    pub(super) size: usize,
    /// First byte after the blocks of the parameter section.
    pub(super) after_parameters: usize,
}

/// A number of frames and the part of the file that states it.
#[derive(Debug, Clone, Copy)]
struct Claim {
    who: &'static str,
    value: usize,
}

impl Layout {
    /// Words of four points and all samples of one frame.
    fn values_per_frame(&self) -> usize {
        (4 * self.points).saturating_add(self.channels.saturating_mul(self.samples_per_frame))
    }

    /// Bytes of one value.
    pub(super) fn width(&self) -> usize {
        match self.storage {
            Storage::Integer => 2,
            Storage::Real => 4,
        }
    }

    /// Bytes of one frame.
    pub(super) fn frame_bytes(&self) -> usize {
        self.values_per_frame().saturating_mul(self.width())
    }
}

/// First byte of the section of rotations; `None` if the file has none.
pub(super) fn rotation_offset(parameters: &Parameters) -> Option<usize> {
    parameters.count("ROTATION", "USED").filter(|&used| used > 0)?;
    parameters.count("ROTATION", "DATA_START")?.checked_sub(1).map(|block| block.saturating_mul(BLOCK))
}

/// Decides on the content of the file.
pub(super) fn decide(
    header: &Header,
    parameters: &Parameters,
    file: &Extent,
    remarks: &mut Vec<Remark>,
) -> Result<Layout, Error> {
    let scales = scales(header, parameters, remarks);
    let data_offset = data_offset(header, parameters, file, remarks);
    let point_rate_hz = point_rate(header, parameters, remarks)?;
    let frame_claims = frame_claims(header, parameters);
    let mut layout = Layout {
        storage: Storage::Real,
        point_scale: 1.0,
        data_offset,
        points: 0,
        channels: 0,
        samples_per_frame: 1,
        frames: 0,
        first_frame: 1,
        point_rate_hz,
    };
    // Rotations have their own section, usually after the section of the points.
    let end = rotation_offset(parameters).filter(|&start| start > data_offset).unwrap_or(file.size);
    let room = end.min(file.size).saturating_sub(data_offset);
    let question = Question { header, parameters, scales: &scales, frames: &frame_claims, room };
    choose_frame(&mut layout, &question, remarks);
    layout.frames = choose_frames(&layout, room, &frame_claims, remarks);
    if layout.frames == 0 {
        keep_named(&mut layout, parameters);
    }
    layout.first_frame = first_frame(header, parameters, layout.frames, remarks);
    Ok(layout)
}

/// A positive scale means integers, a negative one reals. Two answers, the parameter's first, if the sign in the header
/// differs.
fn scales(header: &Header, parameters: &Parameters, remarks: &mut Vec<Remark>) -> Vec<f64> {
    let usable = |scale: &f64| scale.is_finite() && scale.abs() > 0.0;
    let in_header = Some(f64::from(header.scale)).filter(usable);
    let mut scales: Vec<f64> = parameters.number("POINT", "SCALE").filter(usable).into_iter().collect();
    if scales.first().is_none_or(|&scale| in_header.is_some_and(|other| scale * other < 0.0)) {
        scales.extend(in_header);
    }
    if scales.is_empty() {
        remark(remarks, "neither POINT:SCALE nor the header has a scale; read as reals".into());
        scales.push(-1.0);
    }
    scales
}

fn data_offset(header: &Header, parameters: &Parameters, file: &Extent, remarks: &mut Vec<Remark>) -> usize {
    let in_header = usize::from(header.data_block);
    let stated = parameters.count("POINT", "DATA_START").filter(|block| (1..=WORD).contains(block));
    let inside = |block: usize| block >= 3 && (block - 1) * BLOCK <= file.size;
    let block = match stated {
        Some(block) if block != in_header => {
            let chosen = if inside(in_header) { in_header } else { block };
            let message = format!(
                "the data begin in block {in_header} (header) or {block} (POINT:DATA_START); read from {chosen}"
            );
            remark(remarks, message);
            chosen
        }
        _ => in_header,
    };
    if block >= 3 {
        return (block - 1) * BLOCK;
    }
    remark(remarks, format!("the data cannot begin in block {block}; read from the end of the parameters"));
    file.after_parameters
}

fn point_rate(header: &Header, parameters: &Parameters, remarks: &mut Vec<Remark>) -> Result<f64, Error> {
    let usable = |rate: &f64| rate.is_finite() && *rate > 0.0;
    let parameter = parameters.number("POINT", "RATE");
    let in_header = f64::from(header.rate_hz);
    if let Some(rate) = parameter.filter(usable) {
        // Half a hundredth: both are reals of 24 bits, and headers are often rounded to two digits.
        if usable(&in_header) && (rate - in_header).abs() > 0.005 {
            return Ok(contradicted_rate(rate, in_header, header, parameters, remarks));
        }
        return Ok(rate);
    }
    if usable(&in_header) {
        if let Some(rate) = parameter {
            remark(remarks, format!("POINT:RATE is {rate}; the header's rate of {in_header} Hz was used"));
        }
        return Ok(in_header);
    }
    let found =
        format!("{} and {in_header} in the header", parameter.map_or("nothing".into(), |rate| rate.to_string()));
    Err(Error::Parameter { parameter: "POINT:RATE".into(), found, expected: "a frame rate above zero".into() })
}

/// The frame rate of a file whose header and `POINT:RATE` differ: the rate of the header if the rate of the
/// analog channels, over the samples per frame, agrees with it and not with the parameter.
fn contradicted_rate(
    parameter: f64,
    in_header: f64,
    header: &Header,
    parameters: &Parameters,
    remarks: &mut Vec<Remark>,
) -> f64 {
    let agree = |a: f64, b: f64| (a / b - 1.0).abs() < SAME_RATE;
    if agree(parameter, in_header) {
        let message = format!("POINT:RATE is {parameter} Hz, the header's rate {in_header} Hz; POINT:RATE was used");
        remark(remarks, message);
        return parameter;
    }
    let samples = f64::from(header.samples_per_frame);
    let by_channels = parameters.number("ANALOG", "RATE").map(|rate| rate / samples).filter(|rate| rate.is_finite());
    let (used, chosen) = match by_channels {
        Some(rate) if agree(rate, in_header) && !agree(rate, parameter) => {
            (in_header, "the header's rate was used, because ANALOG:RATE agrees with it")
        }
        Some(rate) if agree(rate, parameter) => (parameter, "POINT:RATE was used, because ANALOG:RATE agrees with it"),
        _ => (parameter, "POINT:RATE was used"),
    };
    let message = format!(
        "POINT:RATE is {parameter} Hz, but the header states {in_header} frames per second; {chosen}. hint: every \
         speed and force depends on it; correct the one that is wrong"
    );
    remarks.push(Remark::of_clock(message));
    used
}

/// The numbers of frames in header and parameters. A 16-bit number that only lacks the higher bits of a
/// number stated elsewhere is ignored: 65535 in its place, or its lower bits.
fn frame_claims(header: &Header, parameters: &Parameters) -> Vec<Claim> {
    let (start, end) = (field(parameters, "ACTUAL_START_FIELD"), field(parameters, "ACTUAL_END_FIELD"));
    let actual =
        start.zip(end).and_then(|(start, end)| end.checked_add(1)?.checked_sub(start)).filter(|&frames| frames > 0);
    let frames = parameters.count("POINT", "FRAMES");
    let long = long_frames(parameters);
    let in_header = header.frames();
    let largest = [actual, frames, long].into_iter().flatten().max().unwrap_or(0);
    let first = start.unwrap_or(usize::from(header.first_frame));
    let last = first.saturating_add(largest).saturating_sub(1);
    let header_full = last > WORD && [WORD, last & 0xffff].contains(&usize::from(header.last_frame));
    let cut = |frames: &usize| largest > WORD && *frames < largest && [WORD, largest & 0xffff].contains(frames);
    let claims = [
        ("the header", in_header.filter(|_| !header_full)),
        ("TRIAL:ACTUAL_START_FIELD and ACTUAL_END_FIELD", actual),
        ("POINT:FRAMES", frames.filter(|frames| !cut(frames))),
        ("POINT:LONG_FRAMES", long),
    ];
    claims.into_iter().filter_map(|(who, value)| value.map(|value| Claim { who, value })).collect()
}

/// The numbers of frames that header and parameters state, the most reliable first.
pub(super) fn stated_frames(header: &Header, parameters: &Parameters) -> Vec<usize> {
    distinct(frame_claims(header, parameters).iter().map(|claim| Some(claim.value)))
}

/// A frame number of the group TRIAL: two unsigned words, the low one first; or one number.
/// (The user guide multiplies the high word by 65535; two words are 65536.)
fn field(parameters: &Parameters, name: &str) -> Option<usize> {
    wide(&parameters.get("TRIAL", name)?.counts()?)
}

/// One number, or two words, the low one first.
fn wide(words: &[usize]) -> Option<usize> {
    match *words {
        [low, high, ..] => (low <= WORD && high <= WORD).then_some((high << 16) | low),
        [number] => Some(number),
        [] => None,
    }
}

/// POINT:LONG_FRAMES: a real, or two words as in TRIAL.
fn long_frames(parameters: &Parameters) -> Option<usize> {
    wide(&parameters.get("POINT", "LONG_FRAMES")?.counts()?)
}

/// The input of [`choose_frame`].
struct Question<'a> {
    header: &'a Header,
    parameters: &'a Parameters,
    scales: &'a [f64],
    frames: &'a [Claim],
    /// Bytes from the beginning of the data to the end of the file.
    room: usize,
}

/// Chooses storage, points, channels and samples such that one of the stated numbers of frames fills the file; if none
/// does, the most reliable combination.
fn choose_frame(layout: &mut Layout, question: &Question<'_>, remarks: &mut Vec<Remark>) {
    let &Question { header, parameters, scales, frames, room } = question;
    let points = distinct([Some(usize::from(header.points)), used(parameters, "POINT")]);
    let samples = sample_candidates(layout.point_rate_hz, header, parameters);
    let mut candidates = Vec::new();
    for &scale in scales {
        let storage = if scale < 0.0 { Storage::Real } else { Storage::Integer };
        for &points in &points {
            for &(channels, samples_per_frame) in &samples {
                let point_scale = scale.abs();
                candidates.push(Layout { storage, point_scale, points, channels, samples_per_frame, ..*layout });
            }
        }
    }
    let fits = |candidate: &&Layout| frames.iter().any(|claim| fills(candidate, claim.value, room));
    if let Some(best) = candidates.iter().find(fits).or(candidates.first()) {
        *layout = *best;
    }
    if let [parameter, in_header] = scales[..] {
        let what = "one means integers, the other reals";
        let storage = layout.storage;
        let message =
            format!("POINT:SCALE is {parameter}, the header's scale {in_header}: {what}; read as {storage:?} numbers");
        remark(remarks, message);
    }
    if let [in_header, used] = points[..] {
        remark(remarks, format!("the header has {in_header} points, POINT:USED {used}; read {}", layout.points));
    }
    if samples.len() > 1 {
        let used = parameters.count("ANALOG", "USED").map_or("missing".into(), |used| used.to_string());
        let message = format!(
            "the header has {} analog values per frame, {} per channel; ANALOG:USED is {used}; read {} channels with \
             {} per frame",
            header.analog_words, header.samples_per_frame, layout.channels, layout.samples_per_frame
        );
        remark(remarks, message);
    }
}

/// `POINT:USED` or `ANALOG:USED`.
fn used(parameters: &Parameters, group: &str) -> Option<usize> {
    parameters.count(group, "USED").filter(|&used| used <= WORD)
}

/// Channels and samples per frame, the most reliable first.
fn sample_candidates(point_rate_hz: f64, header: &Header, parameters: &Parameters) -> Vec<(usize, usize)> {
    let words = usize::from(header.analog_words);
    let per_frame = usize::from(header.samples_per_frame);
    let used = used(parameters, "ANALOG");
    let rate = parameters.number("ANALOG", "RATE").map(|rate| (rate / point_rate_hz).round());
    let by_rate = rate.filter(|ratio| (1.0..=65535.0).contains(ratio)).map(|ratio| ratio as usize);
    let mut found: Vec<(usize, usize)> = Vec::new();
    let mut add = |channels: usize, samples: usize| {
        let candidate = if channels == 0 || samples == 0 { (0, 1) } else { (channels, samples) };
        if !found.contains(&candidate) {
            found.push(candidate);
        }
    };
    match used {
        Some(used) if used > 0 && words.is_multiple_of(used) && words > 0 => add(used, words / used),
        Some(0) | None if words == 0 => add(0, 1),
        _ if per_frame > 0 && words.is_multiple_of(per_frame) => add(words / per_frame, per_frame),
        _ => add(words, 1),
    }
    if let Some(used) = used.filter(|&used| used * per_frame.max(1) != words) {
        add(used, per_frame.max(1));
        if let Some(by_rate) = by_rate {
            add(used, by_rate);
        }
    }
    found
}

/// Whether this number of frames ends within the last block of the file.
fn fills(layout: &Layout, frames: usize, room: usize) -> bool {
    let bytes = layout.frame_bytes().checked_mul(frames);
    bytes.is_some_and(|bytes| bytes <= room && room - bytes < BLOCK)
}

/// Without frames only names show that there are points and channels: a count alone may be wrong.
fn keep_named(layout: &mut Layout, parameters: &Parameters) {
    layout.points = layout.points.min(parameters.texts("POINT", "LABELS").len());
    layout.channels = layout.channels.min(parameters.texts("ANALOG", "LABELS").len());
}

fn choose_frames(layout: &Layout, room: usize, claims: &[Claim], remarks: &mut Vec<Remark>) -> usize {
    let available = room.checked_div(layout.frame_bytes()).unwrap_or(0);
    if layout.frame_bytes() == 0 {
        return 0;
    }
    let stated = distinct(claims.iter().map(|claim| Some(claim.value)));
    let fitting = stated.iter().copied().find(|&frames| fills(layout, frames, room));
    let within = stated.iter().copied().filter(|&frames| frames <= available).max();
    let frames = fitting.or(within).unwrap_or(available);
    if stated.len() > 1 {
        let words: Vec<String> = claims.iter().map(|claim| format!("{} by {}", claim.value, claim.who)).collect();
        remark(
            remarks,
            format!("number of frames: {}; the file has room for {available}; read {frames}", words.join(", ")),
        );
    } else if let Some(&one) = stated.first().filter(|&&one| one > available) {
        remark(
            remarks,
            format!("{one} frames are stated, but the file ends after {available}; it is truncated; read {available}"),
        );
    }
    let rest = room - frames * layout.frame_bytes();
    if frames < available && rest >= BLOCK {
        remark(remarks, format!("{rest} bytes follow the last frame; they were not read"));
    }
    frames
}

/// The group TRIAL is used if it differs from the header, unless it states another number of frames than was read.
fn first_frame(header: &Header, parameters: &Parameters, frames: usize, remarks: &mut Vec<Remark>) -> i64 {
    let in_header = usize::from(header.first_frame);
    let Some(actual) = field(parameters, "ACTUAL_START_FIELD").filter(|&actual| actual != in_header) else {
        return i64::from(header.first_frame);
    };
    let counted = field(parameters, "ACTUAL_END_FIELD").and_then(|end| end.checked_add(1)?.checked_sub(actual));
    let header_alone = header.frames() == Some(frames) && counted != Some(frames);
    let first = if header_alone { in_header } else { actual };
    // Headers have 16 bits: a larger number is truncated or replaced by the largest.
    let explained = actual > WORD && (actual & 0xffff == in_header || in_header == WORD);
    if !explained {
        let message =
            format!("the first frame is {in_header} (header) or {actual} (TRIAL:ACTUAL_START_FIELD); {first} was used");
        remark(remarks, message);
    }
    i64::try_from(first).unwrap_or(i64::from(u32::MAX))
}

/// The given values, each once, in order.
fn distinct(values: impl IntoIterator<Item = Option<usize>>) -> Vec<usize> {
    let mut found = Vec::new();
    for value in values.into_iter().flatten() {
        if !found.contains(&value) {
            found.push(value);
        }
    }
    found
}

fn remark(remarks: &mut Vec<Remark>, message: String) {
    remarks.push(Remark::of_file(message));
}
