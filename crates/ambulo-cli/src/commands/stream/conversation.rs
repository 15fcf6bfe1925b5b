//! The frames of one sender and the answers to them.

use super::Setup;
use super::coordinates::CoordinateFrames;
use super::formats::{Answer, Description, Message, from_json, from_record, record_bytes, to_json, to_record};
use super::live_view::LiveView;
use super::markers::{Fitted, MarkerFrames};
use super::numbering::{Numbering, Place};
use crate::args::{StreamArgs, StreamFormat};
use ambulo::ground::predict::PredictError;
use ambulo::ground::stream::{Stream, StreamError, StreamFrame};
use ambulo_results::{stream_columns, stream_row};
use anyhow::{Result, bail};

/// A longer gap restarts the stream [s], as in the library.
const LONGEST_GAP_S: f64 = 0.2;
/// A number that lies farther back begins a new sequence [s].
const NEW_SEQUENCE_S: f64 = 1.0;
/// So many notices of a kind are printed; all are counted and, as JSON, answered.
const PRINTED: u64 = 5;

/// Content of a sender's frames.
enum FrameKind {
    Coordinates(CoordinateFrames),
    Markers(Box<MarkerFrames>),
}

/// Whether the sender described its frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Naming {
    /// Not yet: frames have everything of the model, in its units.
    Unsaid,
    Said,
    /// It tried, but that line was refused: frames may have anything.
    Refused,
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
    frames: FrameKind,
    naming: Naming,
    page: Option<LiveView<'a>>,
    /// Answers that were not sent yet.
    pub(super) out: Vec<u8>,
    counts: Counts,
}

impl<'a> Conversation<'a> {
    pub(super) fn new(setup: &'a Setup<'a>) -> Result<Conversation<'a>> {
        let StreamArgs { markers, rate, unit, axes, .. } = *setup.args;
        let frames = match markers {
            false => FrameKind::Coordinates(CoordinateFrames::new(&setup.model)),
            true => FrameKind::Markers(Box::new(MarkerFrames::new(&setup.model, rate, unit, axes)?)),
        };
        let stream = setup.stream()?;
        let view = |server| LiveView::new(server, &setup.model, rate, stream.delay_frames());
        let page = setup.page.as_ref().map(view);
        let (numbering, counts) = (Numbering::default(), Counts::default());
        let naming = Naming::Unsaid;
        Ok(Conversation { setup, stream, numbering, origin: 0, frames, naming, page, out: Vec::new(), counts })
    }

    /// The description of frames and results that the sender gets first.
    pub(super) fn description(&self) -> Description {
        let model = &self.setup.model;
        let (columns, units) = stream_columns(model).into_iter().unzip();
        Description {
            model: model.name().to_owned(),
            rate_hz: self.setup.settings.rate_hz,
            delay_frames: self.stream.delay_frames(),
            coordinates: match &self.frames {
                FrameKind::Coordinates(frames) => Some(frames.names(model)),
                FrameKind::Markers(_) => None,
            },
            markers: match &self.frames {
                FrameKind::Coordinates(_) => None,
                FrameKind::Markers(frames) => Some(frames.description()),
            },
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
            StreamFormat::F32 => Some(record_bytes(self.values())),
        }
    }

    /// Values of a frame.
    fn values(&self) -> usize {
        match &self.frames {
            FrameKind::Coordinates(frames) => frames.values(),
            FrameKind::Markers(frames) => frames.values(),
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
            StreamFormat::F32 => from_record(bytes, self.values()),
        };
        // A first line that cannot be read may have been the one with the names; records have none.
        let names = match &message {
            Ok(message) => message.names_coordinates() || message.names_markers(),
            Err(_) => {
                let is_json = self.setup.args.format == StreamFormat::Json;
                is_json && self.naming == Naming::Unsaid && self.counts.frames == 0
            }
        };
        let taken = message.and_then(|message| self.take(&message));
        if names {
            self.naming = if taken.is_ok() { Naming::Said } else { Naming::Refused };
        }
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
        self.name_values(message)?;
        let Some(values) = message.values() else { return Ok(()) };
        if self.naming == Naming::Refused && !message.names_coordinates() && !message.names_markers() {
            bail!(
                "a frame after a line with names or units that was refused; expected such a line first. hint: send it \
                 again, corrected"
            );
        }
        let q = self.checked(&values)?;
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
                if let FrameKind::Markers(frames) = &mut self.frames {
                    frames.restart(&self.setup.model)?;
                }
            }
        }
        let q = self.fitted(q, number)?;
        if let Some(page) = &mut self.page {
            page.arrived(number, &q);
        }
        let forces = self.stream.push(&q)?;
        self.answer(forces);
        Ok(())
    }

    /// The coordinates of a frame that has them; markers are only checked, because they are fitted in the order of the
    /// frames.
    fn checked(&mut self, values: &[Option<f64>]) -> Result<Vec<f64>> {
        match &mut self.frames {
            FrameKind::Coordinates(frames) => frames.in_model_order(&self.setup.model, values),
            FrameKind::Markers(frames) => frames.take(values).map(|()| Vec::new()),
        }
    }

    /// The coordinates of a frame; with markers they are fitted now.
    fn fitted(&mut self, q: Vec<f64>, number: u64) -> Result<Vec<f64>> {
        let FrameKind::Markers(frames) = &mut self.frames else { return Ok(q) };
        let message = match frames.fit(&self.setup.model)? {
            Fitted::Posture(q) => return Ok(q),
            Fitted::TooFew => format!("frame {number} has too few visible markers for a posture"),
            Fitted::Lost(distance_m) => {
                let from_body = distance_m.map_or_else(String::new, |far| {
                    format!(": a quarter of them is more than {:.0} mm from it", 1e3 * far)
                });
                format!(
                    "the markers of frame {number} are not where the body can have them{from_body}; the next frame is \
                     fitted as the first one. hint: check the unit, the axes and the names of the markers"
                )
            }
        };
        self.notice("unfitted", Some(number), message);
        Ok(vec![f64::NAN; self.setup.model.coordinates().len()])
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
        if let FrameKind::Markers(frames) = &mut self.frames {
            frames.skip(missing);
        }
        if let Some(page) = &mut self.page {
            page.lost(missing);
        }
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

    /// The end of the frames: answers the frames within the delay, and reports the counts.
    pub(super) fn end(&mut self) -> Result<()> {
        let ended = std::mem::replace(&mut self.stream, self.setup.stream()?);
        let finished = self.finish(ended);
        self.survive(finished)?;
        let Counts { frames, results, notices } = std::mem::take(&mut self.counts);
        let notices: String = notices.iter().map(|(kind, count)| format!(", {count} x {kind}")).collect();
        let counted = |count: u64| if count == 1 { "1 frame".to_owned() } else { format!("{count} frames") };
        let message = format!("{} in, forces of {} out{notices}", counted(frames), counted(results));
        self.setup.say(&message);
        self.send(&Answer::Notice { notice: "ended", frame: None, message });
        self.numbering = Numbering::default();
        if let Some(page) = &mut self.page {
            page.ended();
        }
        Ok(())
    }

    /// Takes the names of what frames have, and units, from a message that has some.
    fn name_values(&mut self, message: &Message) -> Result<()> {
        let model = &self.setup.model;
        match &mut self.frames {
            FrameKind::Coordinates(frames) if message.names_coordinates() => {
                let others = frames.name_values(model, message)?;
                if !others.is_empty() {
                    let message = format!("no values for {}; the defaults of the model are used", others.join(", "));
                    self.notice("defaults", None, message);
                }
            }
            FrameKind::Markers(frames) if message.names_markers() => {
                if let Some(message) = frames.name_markers(model, message)? {
                    self.notice("markers", None, message);
                }
            }
            FrameKind::Markers(_) if message.names_coordinates() || message.q.is_some() && !message.is_record => {
                bail!("coordinates in a stream of markers; expected {{\"markers\": [...]}}. hint: leave out --markers")
            }
            FrameKind::Coordinates(_) if message.names_markers() || message.markers.is_some() => {
                bail!("markers in a stream of coordinates; expected {{\"q\": [...]}}. hint: --markers takes markers")
            }
            _ => {}
        }
        Ok(())
    }

    fn answer(&mut self, forces: Option<StreamFrame>) {
        let Some(forces) = forces else { return };
        self.counts.results += 1;
        let frame = self.origin + forces.frame as u64;
        let values: Vec<f32> = stream_row(&self.setup.model, &forces).into_iter().map(|value| value as f32).collect();
        if let Some(page) = &mut self.page {
            page.results(frame, &values);
        }
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
