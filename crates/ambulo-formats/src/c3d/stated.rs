//! The parameters that repeat fields of a record (counts, rates, names, scales, events), computed before writing.

use super::events::{EventPlace, minutes_and_seconds};
use super::parameters::{Parameter, Parameters, Values, numbered_name};
use super::section_write::LARGEST;
use super::{C3d, Channel, Event, Storage};

/// Largest number of a header word.
const WORD: i64 = 65535;

/// The record's parameters, updated from its other fields, with the blocks where its points (with analog samples) and
/// its rotations begin.
pub(super) fn parameters(record: &C3d, [of_points, of_rotations]: [u16; 2]) -> Parameters {
    let mut stated = Stated { parameters: record.parameters.clone() };
    stated.points(record, of_points);
    stated.frames(record);
    stated.channels(record);
    stated.rotations(record, of_rotations);
    stated.events(record);
    stated.parameters
}

/// `POINT:SCALE` for writing: negative for reals.
pub(super) fn point_scale(record: &C3d) -> f32 {
    let scale = record.encoding.point_scale as f32;
    match record.encoding.storage {
        Storage::Integer => scale,
        Storage::Real => -scale,
    }
}

/// `ANALOG:GEN_SCALE`, kept from the file if it can be used.
pub(super) fn general_scale(parameters: &Parameters) -> f32 {
    let usable = |scale: &f64| scale.is_finite() && scale.abs() > 0.0;
    parameters.number("ANALOG", "GEN_SCALE").filter(usable).map_or(1.0, |scale| scale as f32)
}

/// `ANALOG:SCALE` of a channel.
pub(super) fn channel_scale(channel: &Channel, general: f32) -> f32 {
    (channel.scale / f64::from(general)) as f32
}

struct Stated {
    parameters: Parameters,
}

impl Stated {
    fn points(&mut self, record: &C3d, data_block: u16) {
        let points = &record.points;
        self.set("POINT", "USED", word(points.len()));
        self.set("POINT", "SCALE", Values::Reals(vec![point_scale(record)]));
        self.set("POINT", "RATE", Values::Reals(vec![record.point_rate_hz as f32]));
        self.set("POINT", "DATA_START", word(usize::from(data_block)));
        self.set("POINT", "UNITS", Values::Texts(vec![record.point_unit.clone()]));
        self.texts("POINT", "LABELS", points.iter().map(|point| point.name.clone()));
        self.texts("POINT", "DESCRIPTIONS", points.iter().map(|point| point.description.clone()));
    }

    /// With more than 65535 frames POINT:FRAMES is 65535; the number is in POINT:LONG_FRAMES and in the group TRIAL.
    /// (The user guide would have a real in POINT:FRAMES, which ezc3d 1.7.2 refuses.)
    fn frames(&mut self, record: &C3d) {
        let frames = record.frames() as i64;
        let last = record.first_frame + frames - 1;
        let many = frames > WORD;
        self.set("POINT", "FRAMES", word(frames.min(WORD) as usize));
        if many || self.parameters.get("POINT", "LONG_FRAMES").is_some() {
            self.set("POINT", "LONG_FRAMES", Values::Reals(vec![frames as f32]));
        }
        if last > WORD || self.parameters.get("TRIAL", "ACTUAL_START_FIELD").is_some() {
            for (name, frame) in [("ACTUAL_START_FIELD", record.first_frame), ("ACTUAL_END_FIELD", last)] {
                let words = [frame as u16, (frame >> 16) as u16].map(u16::cast_signed);
                self.list("TRIAL", name, &[2], Values::Integers(words.to_vec()));
            }
        }
    }

    fn channels(&mut self, record: &C3d) {
        let channels = &record.channels;
        let general = general_scale(&self.parameters);
        self.set("ANALOG", "USED", word(channels.len()));
        self.set("ANALOG", "RATE", Values::Reals(vec![record.analog_rate_hz as f32]));
        self.set("ANALOG", "GEN_SCALE", Values::Reals(vec![general]));
        self.texts("ANALOG", "LABELS", channels.iter().map(|channel| channel.name.clone()));
        self.texts("ANALOG", "DESCRIPTIONS", channels.iter().map(|channel| channel.description.clone()));
        self.texts("ANALOG", "UNITS", channels.iter().map(|channel| channel.unit.clone()));
        let scales: Vec<f32> = channels.iter().map(|channel| channel_scale(channel, general)).collect();
        self.numbered("ANALOG", "SCALE", scales.chunks(LARGEST).map(|part| Values::Reals(part.to_vec())));
        let offsets = offsets(record);
        let parts = match &offsets {
            Values::Reals(values) => values.chunks(LARGEST).map(|part| Values::Reals(part.to_vec())).collect(),
            Values::Integers(values) => values.chunks(LARGEST).map(|part| Values::Integers(part.to_vec())).collect(),
            _ => vec![],
        };
        self.numbered("ANALOG", "OFFSET", parts.into_iter());
        self.sign(record);
    }

    /// The group ROTATION, if there are rotations or were some.
    fn rotations(&mut self, record: &C3d, block: u16) {
        let rotations = &record.rotations;
        if rotations.is_empty() && self.parameters.group("ROTATION").is_none() {
            return;
        }
        let per_frame = record.rotations_per_frame();
        let samples = record.frames() * per_frame;
        self.set("ROTATION", "USED", word(rotations.len()));
        self.set("ROTATION", "RATE", Values::Reals(vec![record.rotation_rate_hz as f32]));
        self.set("ROTATION", "RATIO", word(per_frame));
        self.set("ROTATION", "DATA_START", word(usize::from(block)));
        self.set("ROTATION", "FRAMES", word(samples.min(WORD as usize)));
        self.texts("ROTATION", "LABELS", rotations.iter().map(|rotation| rotation.name.clone()));
        self.texts("ROTATION", "DESCRIPTIONS", rotations.iter().map(|rotation| rotation.description.clone()));
    }

    /// ANALOG:FORMAT, if it is present or needed: without it, an offset at the end of the signed range means unsigned
    /// numbers.
    fn sign(&mut self, record: &C3d) {
        let unsigned = record.encoding.unsigned_analog;
        let at_end = |channel: &Channel| channel.offset.abs() > 32766.5;
        let there = self.parameters.get("ANALOG", "FORMAT").is_some();
        if unsigned || there || record.channels.iter().any(at_end) {
            let word = if unsigned { "UNSIGNED" } else { "SIGNED" };
            self.set("ANALOG", "FORMAT", Values::Texts(vec![word.into()]));
        }
    }

    fn events(&mut self, record: &C3d) {
        let events: Vec<&Event> = record.events.iter().filter(|event| event.place == EventPlace::Group).collect();
        if events.is_empty() && self.parameters.group("EVENT").is_none() {
            return;
        }
        self.set("EVENT", "USED", word(events.len()));
        self.texts("EVENT", "CONTEXTS", events.iter().map(|event| event.context.clone()));
        self.texts("EVENT", "LABELS", events.iter().map(|event| event.label.clone()));
        self.texts("EVENT", "DESCRIPTIONS", events.iter().map(|event| event.description.clone()));
        self.texts("EVENT", "SUBJECTS", events.iter().map(|event| event.subject.clone()));
        let icons: Vec<i16> = events.iter().map(|event| event.icon).collect();
        self.numbered("EVENT", "ICON_IDS", icons.chunks(LARGEST).map(|part| Values::Integers(part.to_vec())));
        let flags: Vec<u8> = events.iter().map(|event| event.flag).collect();
        self.numbered("EVENT", "GENERIC_FLAGS", flags.chunks(LARGEST).map(|part| Values::Bytes(part.to_vec())));
        self.times(&events);
    }

    fn times(&mut self, events: &[&Event]) {
        let lists: Vec<Vec<f32>> = events
            .chunks(LARGEST)
            .map(|part| part.iter().flat_map(|event| minutes_and_seconds(event.time_s)).collect())
            .collect();
        let count = lists.len();
        for (list, number) in lists.into_iter().zip(1..) {
            let shape = [2, list.len() / 2];
            self.list("EVENT", &numbered_name("TIMES", number), &shape, Values::Reals(list));
        }
        if count == 0 {
            self.list("EVENT", "TIMES", &[2, 0], Values::Reals(vec![]));
        }
        self.drop_after("EVENT", "TIMES", count.max(1));
    }

    fn texts(&mut self, group: &str, name: &str, texts: impl Iterator<Item = String>) {
        let texts: Vec<String> = texts.collect();
        let parts: Vec<Values> = texts.chunks(LARGEST).map(|part| Values::Texts(part.to_vec())).collect();
        let none = || vec![Values::Texts(vec![])];
        self.numbered(group, name, if parts.is_empty() { none() } else { parts }.into_iter());
    }

    /// `name`, `name2`, `name3` with one list each; further lists of an earlier file are removed.
    fn numbered(&mut self, group: &str, name: &str, lists: impl Iterator<Item = Values>) {
        let mut count = 0;
        for values in lists {
            count += 1;
            let shape = [values.len()];
            self.list(group, &numbered_name(name, count), &shape, values);
        }
        self.drop_after(group, name, count);
    }

    /// Removes `name` with numbers above `last`, up to the first that is missing.
    fn drop_after(&mut self, group: &str, name: &str, last: usize) {
        for number in last + 1.. {
            let name = numbered_name(name, number);
            let Some(group) = self.parameters.groups.iter_mut().find(|g| g.name.eq_ignore_ascii_case(group)) else {
                return;
            };
            let before = group.parameters.len();
            group.parameters.retain(|parameter| !parameter.name.eq_ignore_ascii_case(&name));
            if group.parameters.len() == before {
                return;
            }
        }
    }

    /// A single value.
    fn set(&mut self, group: &str, name: &str, values: Values) {
        self.list(group, name, &[], values);
    }

    /// Values with a shape; description and lock of an earlier parameter are kept.
    fn list(&mut self, group: &str, name: &str, shape: &[usize], values: Values) {
        let fresh = Parameter { dimensions: shape.to_vec(), ..Parameter::list(name, values) };
        let parameter = match self.parameters.get(group, name) {
            Some(old) => {
                Parameter { name: old.name.clone(), description: old.description.clone(), locked: old.locked, ..fresh }
            }
            None => fresh,
        };
        self.parameters.set(group, parameter);
    }
}

/// A count as an unsigned 16-bit integer.
fn word(count: usize) -> Values {
    Values::Integers(vec![(count as u16).cast_signed()])
}

/// ANALOG:OFFSET: integers if all are whole and fit, otherwise reals.
fn offsets(record: &C3d) -> Values {
    let range = if record.encoding.unsigned_analog { 0.0..=65535.0 } else { -32768.0..=32767.0 };
    let whole = |channel: &Channel| channel.offset.fract().abs() < f64::MIN_POSITIVE && range.contains(&channel.offset);
    if record.channels.iter().all(whole) {
        let bits = |channel: &Channel| (channel.offset as i32) as i16;
        return Values::Integers(record.channels.iter().map(bits).collect());
    }
    Values::Reals(record.channels.iter().map(|channel| channel.offset as f32).collect())
}
