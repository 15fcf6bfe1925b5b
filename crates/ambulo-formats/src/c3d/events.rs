//! Events: named instants, in the group EVENT and in the header.
//!
//! | where | what |
//! |---|---|
//! | EVENT:USED, LABELS, CONTEXTS, TIMES (two per event: minutes, seconds), DESCRIPTIONS, SUBJECTS, ICON_IDS | any number |
//! | header words 150 (key 12345), 151 (count), 153-188 (seconds), 189-197 (one byte each), 199-234 (4 letters each) | at most 18 |
//!
//! In the group, time zero is at frame 1. In the header it is at the first frame of the file; such
//! times are shifted. Source: C3D user guide (c3d.org), "The EVENT group", "Header events". The meaning of the byte is
//! stated in two ways there (0 on, 1 off; and the opposite), so the byte is kept as it is.

use super::parameters::Parameters;
use super::section::text;
use super::words::{Processor, Words};
use crate::error::{Error, Remark, quoted};

/// A named instant.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// Kind of event: `Foot Strike`, `Foot Off`; four letters in the header.
    pub label: String,
    /// Side or object: `Left`, `Right`, `General`; empty in the header.
    pub context: String,
    /// Time \[s\]; frame 1 is at zero.
    pub time_s: f64,
    /// Subject of the event, if the file states it.
    pub subject: String,
    /// Description in the file.
    pub description: String,
    /// Number of the icon with which programs show it.
    pub icon: i16,
    /// `EVENT:GENERIC_FLAGS`, or the header's byte: whether programs show the event.
    pub flag: u8,
    /// Where the file contains it.
    pub place: EventPlace,
}

impl Event {
    /// An event of the group EVENT.
    pub fn new(label: &str, context: &str, time_s: f64) -> Event {
        let nothing = String::new;
        let (label, context) = (label.into(), context.into());
        Event {
            label,
            context,
            time_s,
            subject: nothing(),
            description: nothing(),
            icon: 0,
            flag: 0,
            place: EventPlace::Group,
        }
    }
}

/// Where a file contains an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventPlace {
    /// The group EVENT.
    Group,
    /// The header. Old programs repeat the events of the group there.
    Header,
}

/// Key in word 150 of a header that has events.
const EVENT_KEY: u16 = 12345;
/// Largest number of events in the header.
const HEADER_EVENTS: usize = 18;
/// Positions of the key, the count, times, flags and labels in the header [bytes].
const KEY_AT: usize = 298;
const COUNT_AT: usize = 300;
const TIMES_AT: usize = 304;
const FLAGS_AT: usize = 376;
const LABELS_AT: usize = 396;

/// All events of the file.
/// `start_s` is the time of the first frame.
pub(super) fn read(words: Words<'_>, parameters: &Parameters, start_s: f64, remarks: &mut Vec<Remark>) -> Vec<Event> {
    let mut events = of_group(parameters, remarks);
    events.extend(of_header(words, start_s, remarks));
    events
}

fn of_group(parameters: &Parameters, remarks: &mut Vec<Remark>) -> Vec<Event> {
    let times = parameters.numbers("EVENT", "TIMES");
    let used = parameters.count("EVENT", "USED").unwrap_or(times.len() / 2);
    if times.len() / 2 < used {
        let message = format!("EVENT:USED is {used}, but EVENT:TIMES has {} events, which were read", times.len() / 2);
        remarks.push(Remark::of_file(message));
    }
    let list = |name| parameters.texts("EVENT", name);
    let (labels, contexts, subjects) = (list("LABELS"), list("CONTEXTS"), list("SUBJECTS"));
    let descriptions = list("DESCRIPTIONS");
    let icons = parameters.numbers("EVENT", "ICON_IDS");
    let flags = parameters.numbers("EVENT", "GENERIC_FLAGS");
    let text = |texts: &[&str], i: usize| texts.get(i).copied().unwrap_or_default().to_owned();
    let event = |(i, time): (usize, &[f64; 2])| Event {
        label: text(&labels, i),
        context: text(&contexts, i),
        time_s: 60.0 * time[0] + time[1],
        subject: text(&subjects, i),
        description: text(&descriptions, i),
        icon: icons.get(i).map_or(0, |&icon| icon as i16),
        flag: flags.get(i).map_or(0, |&flag| flag as u8),
        place: EventPlace::Group,
    };
    times.as_chunks().0.iter().take(used).enumerate().map(event).collect()
}

fn of_header(words: Words<'_>, start_s: f64, remarks: &mut Vec<Remark>) -> Vec<Event> {
    if words.u16(KEY_AT) != Some(EVENT_KEY) {
        return vec![];
    }
    let count = usize::from(words.u16(COUNT_AT).unwrap_or(0));
    if count > HEADER_EVENTS {
        let message = format!("the header states {count} events but has room for {HEADER_EVENTS}, which were read");
        remarks.push(Remark::of_file(message));
    }
    (0..count.min(HEADER_EVENTS)).filter_map(|i| header_event(words, start_s, i)).collect()
}

fn header_event(words: Words<'_>, start_s: f64, i: usize) -> Option<Event> {
    let time_s = start_s + f64::from(words.f32(TIMES_AT + 4 * i)?);
    let flag = words.u8(FLAGS_AT + i)?;
    let label = text(&words.array::<4>(LABELS_AT + 4 * i)?);
    Some(Event { flag, place: EventPlace::Header, ..Event::new(&label, "", time_s) })
}

/// Puts the events of the header into its bytes. `start_s` is the time of the first frame.
pub(super) fn write_header(
    events: &[Event],
    start_s: f64,
    header: &mut [u8],
    processor: Processor,
) -> Result<(), Error> {
    let events: Vec<&Event> = events.iter().filter(|event| event.place == EventPlace::Header).collect();
    if events.is_empty() {
        return Ok(());
    }
    if events.len() > HEADER_EVENTS {
        let expected = format!("at most {HEADER_EVENTS}; the group EVENT can hold the others");
        return Err(Error::Record { found: format!("{} events in the header", events.len()), expected });
    }
    put(header, KEY_AT, &processor.u16_bytes(EVENT_KEY));
    put(header, COUNT_AT, &processor.u16_bytes(events.len() as u16));
    for (i, event) in events.iter().enumerate() {
        let seconds = (event.time_s - start_s) as f32;
        let bytes = processor.f32_bytes(seconds).filter(|_| seconds.is_finite());
        let bytes = bytes.ok_or_else(|| wrong(event, format!("{} s", event.time_s), "a finite time"))?;
        put(header, TIMES_AT + 4 * i, &bytes);
        put(header, FLAGS_AT + i, &[event.flag]);
        if event.label.len() > 4 {
            return Err(wrong(
                event,
                format!("{} bytes", event.label.len()),
                "a label of at most four bytes in the header",
            ));
        }
        let mut label = [b' '; 4];
        label[..event.label.len()].copy_from_slice(event.label.as_bytes());
        put(header, LABELS_AT + 4 * i, &label);
    }
    Ok(())
}

fn put(header: &mut [u8], at: usize, bytes: &[u8]) {
    header[at..at + bytes.len()].copy_from_slice(bytes);
}

fn wrong(event: &Event, found: String, expected: &str) -> Error {
    Error::Record { found: format!("event {} of {found}", quoted(&event.label)), expected: expected.into() }
}

/// Minutes and seconds of a time. Values that were read from a file are kept, or written as an equal sum.
pub(super) fn minutes_and_seconds(time_s: f64) -> [f32; 2] {
    let minutes = (time_s / 60.0).trunc();
    [minutes as f32, (time_s - 60.0 * minutes) as f32]
}
