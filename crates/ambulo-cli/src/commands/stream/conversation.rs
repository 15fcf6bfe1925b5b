//! The frames of one sender and the answers to them.

use super::Setup;
use super::formats::{
    AngleUnit, Answer, Description, Message, from_json, from_record, record_bytes, to_json, to_record,
};
use super::numbering::{Numbering, Place};
use crate::args::StreamFormat;
use ambulo::ground::predict::PredictError;
use ambulo::ground::stream::{Stream, StreamError, StreamFrame};
use ambulo::model::CoordinateKind;
use ambulo_results::{stream_columns, stream_row};
use anyhow::{Result, bail};

/// A longer gap restarts the stream [s], as in the library.
const LONGEST_GAP_S: f64 = 0.2;
/// A number that lies farther back begins a new sequence [s].
const NEW_SEQUENCE_S: f64 = 1.0;
/// So many notices of a kind are printed; all are counted and, as JSON, answered.
const PRINTED: u64 = 5;

/// A value of a frame: the coordinate of the model that it belongs to, and its unit in that of the model.
#[derive(Debug, Clone, Copy)]
struct Slot {
    coordinate: usize,
    unit: f64,
}

/// Counts for the last line.
#[derive(Debug, Default)]
struct Counts {
    frames: u64,
    results: u64,
    /// Of each kind of notice.
    notices: Vec<(&'static str, u64)>,
}

/// The state of a conversation.
pub(super) struct Conversation<'a> {
    setup: &'a Setup<'a>,
    stream: Stream,
    numbering: Numbering,
    /// Number of the sender for frame 0 of the stream.
    origin: u64,
    slots: Vec<Slot>,
    /// Answers that were not sent yet.
    pub(super) out: Vec<u8>,
    counts: Counts,
}

impl<'a> Conversation<'a> {
    pub(super) fn new(setup: &'a Setup<'a>) -> Result<Conversation<'a>> {
        let slots = (0..setup.model.coordinates().len()).map(|coordinate| Slot { coordinate, unit: 1.0 }).collect();
        let (numbering, counts) = (Numbering::default(), Counts::default());
        Ok(Conversation { setup, stream: setup.stream()?, numbering, origin: 0, slots, out: Vec::new(), counts })
    }

    /// The description of frames and results that the sender gets first.
    pub(super) fn description(&self) -> Description {
        let model = &self.setup.model;
        let (columns, units) = stream_columns(model).into_iter().unzip();
        Description {
            model: model.name().to_owned(),
            rate_hz: self.setup.settings.rate_hz,
            delay_frames: self.stream.delay_frames(),
            coordinates: self.slots.iter().map(|slot| model.coordinates()[slot.coordinate].name.clone()).collect(),
            columns,
            units,
        }
    }

    /// Answers with what results contain.
    pub(super) fn greet(&mut self) {
        if self.setup.args.format == StreamFormat::Json {
            to_json(&self.description(), &mut self.out);
        }
    }

    /// Bytes of a message; `None` where it ends with its line.
    pub(super) fn message_bytes(&self) -> Option<usize> {
        match self.setup.args.format {
            StreamFormat::Json => None,
            StreamFormat::F32 => Some(record_bytes(self.slots.len())),
        }
    }

    /// Takes a message. One that is not valid gets a notice, and the next one is taken.
    ///
    /// # Errors
    /// A model that cannot be streamed.
    pub(super) fn receive(&mut self, bytes: &[u8]) -> Result<()> {
        let message = match self.setup.args.format {
            StreamFormat::Json if bytes.trim_ascii().is_empty() => return Ok(()),
            StreamFormat::Json => from_json(bytes),
            StreamFormat::F32 => from_record(bytes, self.slots.len()),
        };
        let taken = message.and_then(|message| self.take(&message));
        self.survive(taken)
    }

    /// Says what was wrong; only a model that no frame can be computed of is an error.
    fn survive(&mut self, done: Result<()>) -> Result<()> {
        match done {
            Err(error) if error.downcast_ref().is_some_and(is_of_the_model) => Err(error),
            Err(error) => {
                self.notice("refused", None, format!("{error:#}"));
                Ok(())
            }
            Ok(()) => Ok(()),
        }
    }

    fn take(&mut self, message: &Message) -> Result<()> {
        if message.coordinates.is_some() || message.angles.is_some() {
            self.name_values(message)?;
        }
        let Some(values) = &message.q else { return Ok(()) };
        let expected = self.slots.len();
        if values.len() != expected {
            bail!("a frame with {} values; expected {expected}, one per coordinate", values.len());
        }
        let q = self.in_model_order(values)?;
        let number = self.number(message)?;
        self.counts.frames += 1;
        let rate_hz = self.setup.settings.rate_hz;
        let expected = self.numbering.expected();
        match self.numbering.place(number, (NEW_SEQUENCE_S * rate_hz) as u64) {
            Place::Next if self.counts.frames == 1 => self.origin = number,
            Place::Next => {}
            Place::After(missing) => self.bridge(expected, missing, number)?,
            Place::Doubled => {
                self.notice("doubled", Some(number), format!("frame {number} came again and is not used"));
                return Ok(());
            }
            Place::Late => {
                let message = format!("frame {number} came after a later one and is not used");
                self.notice("late", Some(number), message);
                return Ok(());
            }
            Place::Anew => {
                let message = format!("frame {number} follows frame {}: a new sequence begins", expected - 1);
                self.notice("restarted", Some(number), message);
                self.restart(number)?;
            }
        }
        let forces = self.stream.push(&q)?;
        self.answer(forces);
        Ok(())
    }

    /// The number of a frame, from its number, its time, or the frame before.
    fn number(&self, message: &Message) -> Result<u64> {
        match (message.frame, message.time) {
            (Some(number), _) => Ok(number),
            (None, None) => Ok(self.numbering.expected()),
            (None, Some(time_s)) => {
                let number = (time_s * self.setup.settings.rate_hz).round();
                if !(0.0..9e15).contains(&number) {
                    bail!("a frame at {time_s} s; expected a time of at least 0");
                }
                Ok(number as u64)
            }
        }
    }

    /// Puts missing frames where some were lost: few are bridged, more restart the stream.
    fn bridge(&mut self, from: u64, missing: u64, number: u64) -> Result<()> {
        let lost = if missing == 1 { format!("frame {from}") } else { format!("frames {from} to {}", number - 1) };
        self.notice("lost", Some(from), format!("{lost} did not arrive"));
        if missing as f64 > LONGEST_GAP_S * self.setup.settings.rate_hz {
            return self.restart(number);
        }
        let unknown = vec![f64::NAN; self.setup.model.coordinates().len()];
        for _ in 0..missing {
            self.stream.push(&unknown)?;
        }
        Ok(())
    }

    /// Ends the stream and begins another one with the frame of a number.
    fn restart(&mut self, number: u64) -> Result<()> {
        let ended = std::mem::replace(&mut self.stream, self.setup.stream()?);
        self.finish(ended)?;
        self.origin = number;
        Ok(())
    }

    fn finish(&mut self, stream: Stream) -> Result<()> {
        for forces in stream.finish()? {
            self.answer(Some(forces));
        }
        Ok(())
    }

    /// The end of the frames: answers those of the delay, and says what came.
    pub(super) fn end(&mut self) -> Result<()> {
        let ended = std::mem::replace(&mut self.stream, self.setup.stream()?);
        let finished = self.finish(ended);
        self.survive(finished)?;
        let Counts { frames, results, notices } = std::mem::take(&mut self.counts);
        let notices: String = notices.iter().map(|(kind, count)| format!(", {count} x {kind}")).collect();
        let message = format!("{frames} frames in, forces of {results} frames out{notices}");
        self.setup.say(&message);
        self.send(&Answer::Notice { notice: "ended", frame: None, message });
        self.numbering = Numbering::default();
        Ok(())
    }

    /// Sets which values a frame has, and their units.
    fn name_values(&mut self, message: &Message) -> Result<()> {
        let model = &self.setup.model;
        let coordinates: Vec<usize> = match &message.coordinates {
            None => self.slots.iter().map(|slot| slot.coordinate).collect(),
            Some(names) => names.iter().map(|name| self.coordinate(name)).collect::<Result<_>>()?,
        };
        let is_degrees = message.angles == Some(AngleUnit::Deg);
        let slot = |coordinate: usize| {
            let is_angle = model.coordinates()[coordinate].kind != CoordinateKind::Translation;
            Slot { coordinate, unit: if is_angle && is_degrees { 1_f64.to_radians() } else { 1.0 } }
        };
        self.slots = coordinates.into_iter().map(slot).collect();
        let is_named = |place: usize| self.slots.iter().any(|slot| slot.coordinate == place);
        let others = model.coordinates().iter().enumerate().filter(|(place, _)| !is_named(*place));
        let others: Vec<&str> = others.map(|(_, coordinate)| coordinate.name.as_str()).collect();
        if !others.is_empty() {
            let message = format!("no values for {}; the defaults of the model are used", others.join(", "));
            self.notice("defaults", None, message);
        }
        Ok(())
    }

    fn coordinate(&self, name: &str) -> Result<usize> {
        let model = &self.setup.model;
        match model.coordinate(name) {
            Some(id) => Ok(id.index()),
            None => {
                let names: Vec<&str> = model.coordinates().iter().map(|c| c.name.as_str()).collect();
                bail!("no coordinate `{name}` in the model; expected some of {}", names.join(", "))
            }
        }
    }

    /// One value per coordinate of the model, not-a-number where it is missing.
    fn in_model_order(&self, values: &[Option<f64>]) -> Result<Vec<f64>> {
        let coordinates = self.setup.model.coordinates();
        let mut q: Vec<f64> = coordinates.iter().map(|c| c.default_value).collect();
        for (slot, value) in self.slots.iter().zip(values) {
            let value = value.map_or(f64::NAN, |value| value * slot.unit);
            if value.is_infinite() {
                bail!("`{}` is {value}; expected a finite number, or none", coordinates[slot.coordinate].name);
            }
            q[slot.coordinate] = value;
        }
        Ok(q)
    }

    fn answer(&mut self, forces: Option<StreamFrame>) {
        let Some(forces) = forces else { return };
        self.counts.results += 1;
        let frame = self.origin + forces.frame as u64;
        let values: Vec<f32> = stream_row(&self.setup.model, &forces).into_iter().map(|value| value as f32).collect();
        match self.setup.args.format {
            StreamFormat::F32 => to_record(frame, &values, &mut self.out),
            StreamFormat::Json => {
                let time = frame as f64 / self.setup.settings.rate_hz;
                to_json(&Answer::Forces { frame, time, values }, &mut self.out);
            }
        }
    }

    /// Says something about the frames: a few times on standard error, always in the answers that have room for words.
    pub(super) fn notice(&mut self, kind: &'static str, frame: Option<u64>, message: String) {
        let counted = match self.counts.notices.iter_mut().find(|(other, _)| *other == kind) {
            Some((_, count)) => {
                *count += 1;
                *count
            }
            None => {
                self.counts.notices.push((kind, 1));
                1
            }
        };
        if counted <= PRINTED {
            let more = if counted == PRINTED { "; more of this kind are only counted" } else { "" };
            self.setup.say(&format!("warning: {message}{more}"));
        }
        self.send(&Answer::Notice { notice: kind, frame, message });
    }

    fn send(&mut self, answer: &Answer) {
        if self.setup.args.format == StreamFormat::Json {
            to_json(answer, &mut self.out);
        }
    }
}

fn is_of_the_model(error: &StreamError) -> bool {
    let StreamError::Prediction(error) = error else { return false };
    matches!(
        error,
        PredictError::NoFeet { .. }
            | PredictError::NoSole { .. }
            | PredictError::NoMass { .. }
            | PredictError::NoGravity { .. }
    )
}
