//! The frames of one sender and the answers to them.

use super::Setup;
use super::clock::{Clock, ClockDoubt};
use super::coordinates::CoordinateFrames;
use super::formats::{Answer, Description, Message, from_json, from_record, record_bytes, to_json, to_record};
use super::line_text::{is_wide, text};
use super::live_view::LiveView;
use super::markers::{Fitted, MarkerFrames};
use super::numbering::{Numbering, Place};
use crate::args::{StreamArgs, StreamFormat};
use ambulo::findings::{Code, Finding};
use ambulo::ground::predict::PredictError;
use ambulo::ground::stream::{Stream, StreamError, StreamFrame};
use ambulo::numerics::counted;
use ambulo_results::{stream_columns, stream_row};
use anyhow::{Result, anyhow, bail};

/// A longer gap restarts the stream [s], as in the library.
const LONGEST_GAP_S: f64 = 0.2;
/// A number that is further back than this begins a new sequence [s].
const NEW_SEQUENCE_S: f64 = 1.0;
/// Number of frames with numbers in order after which a new sequence begins: at its first number or zero, and at
/// another number, where they may be repeated or late ones.
const RUN_FROM_THE_FIRST: usize = 2;
const RUN: usize = 5;
/// Printed notices of each kind; all notices are counted and, with JSON, sent as answers.
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
    /// The line that described the frames was refused: frames may have any values.
    Refused,
}

/// A frame whose number is before the last one: repeated, late, or the beginning of a new sequence, which the frames
/// after it show.
struct Held {
    number: u64,
    values: Vec<Option<f64>>,
    place: Place,
}

/// Counts for the last line.
#[derive(Debug, Default)]
struct Counts {
    frames: u64,
    results: u64,
    /// Number of notices of each kind.
    notices: Vec<(&'static str, u64)>,
    /// Why the first message was refused.
    first_refusal: Option<String>,
}

/// The state of a conversation.
pub(super) struct Conversation<'a> {
    setup: &'a Setup<'a>,
    stream: Stream,
    numbering: Numbering,
    clock: Clock,
    /// Notices about lost and repeated frames that wait until the rate of the times is known; `None` once it is.
    undecided: Option<Vec<(&'static str, u64, String)>>,
    /// Whether the times have another rate, so that regular losses are not reported again.
    is_other_rate: bool,
    held: Vec<Held>,
    /// Number of the sender for frame 0 of the stream.
    origin: u64,
    frames: FrameKind,
    naming: Naming,
    /// Whether a message could be used.
    is_valid: bool,
    /// Codes of the doubts about the motion that were reported.
    doubted: Vec<Code>,
    page: Option<LiveView<'a>>,
    /// Answers that were not sent yet.
    pub(super) out: Vec<u8>,
    counts: Counts,
    /// Why no message could be used; known at the end.
    unused: Option<String>,
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
        Ok(Conversation {
            setup,
            stream,
            numbering: Numbering::default(),
            clock: Clock::new(rate),
            undecided: Some(Vec::new()),
            is_other_rate: false,
            held: Vec::new(),
            origin: 0,
            frames,
            naming: Naming::Unsaid,
            is_valid: false,
            doubted: Vec::new(),
            page,
            out: Vec::new(),
            counts: Counts::default(),
            unused: None,
        })
    }

    /// Whether the sender has sent a message that could be used.
    pub(super) fn is_valid(&self) -> bool {
        self.is_valid
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

    /// Answers with what results contain, before the answers that were not sent yet.
    pub(super) fn greet_first(&mut self) {
        let answers = std::mem::take(&mut self.out);
        self.greet();
        self.out.extend(answers);
    }

    /// Reports that the sender was silent for too long.
    pub(super) fn silent(&mut self) {
        let message = format!(
            "no complete frame came for {} s; the connection is ended, so that the next one is served. hint: --idle \
             sets this time",
            self.setup.args.idle
        );
        self.notice("idle", None, message);
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
            StreamFormat::Json if text(bytes).trim_ascii().is_empty() => return Ok(()),
            StreamFormat::Json => from_json(bytes),
            StreamFormat::F32 => from_record(bytes, self.values()),
        };
        if self.setup.args.format == StreamFormat::Json && is_wide(bytes) && !self.has_noticed("encoding") {
            let message = "the lines are UTF-16, as pipes of PowerShell write them; they are read as such";
            self.notice("encoding", None, message.to_owned());
        }
        // A first line that cannot be read may have been the one with the names; records have none.
        let names = match &message {
            Ok(message) => message.names_coordinates() || message.names_markers(),
            Err(_) => {
                let is_json = self.setup.args.format == StreamFormat::Json;
                is_json && self.naming == Naming::Unsaid && self.counts.frames == 0
            }
        };
        let is_content = message.as_ref().is_ok_and(|message| message.has_content());
        let taken = message.and_then(|message| self.take(&message));
        self.is_valid |= is_content && taken.is_ok();
        if names {
            self.naming = if taken.is_ok() { Naming::Said } else { Naming::Refused };
        }
        self.survive(taken)
    }

    /// Reports an error of a frame and goes on; only a model with which no frame can be computed ends the stream.
    fn survive(&mut self, done: Result<()>) -> Result<()> {
        match done {
            Err(error) if error.downcast_ref().is_some_and(is_of_the_model) => Err(error),
            Err(error) => {
                let message = format!("{error:#}");
                self.counts.first_refusal.get_or_insert_with(|| message.clone());
                self.notice("refused", None, message);
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
        self.checked(&values)?;
        self.check_clock(message)?;
        let number = self.number(message)?;
        self.counts.frames += 1;
        self.place(number, values)
    }

    /// Takes a frame with its number.
    fn place(&mut self, number: u64, values: Vec<Option<f64>>) -> Result<()> {
        let rate_hz = self.setup.settings.rate_hz;
        let expected = self.numbering.expected();
        let place = self.numbering.place(number, (NEW_SEQUENCE_S * rate_hz) as u64);
        if let Place::Doubled | Place::Late = place {
            return self.hold(Held { number, values, place });
        }
        self.give_up_held();
        match place {
            Place::After(missing) => self.bridge(expected, missing, number)?,
            Place::Anew => self.begin_again(number, expected)?,
            _ if self.counts.frames == 1 => self.origin = number,
            _ => {}
        }
        self.use_frame(number, &values)
    }

    /// Keeps a frame whose number is before the last one, until it is known whether a new sequence has begun.
    fn hold(&mut self, held: Held) -> Result<()> {
        if self.held.last().is_some_and(|last| last.number + 1 != held.number) {
            self.give_up_held();
        }
        self.held.push(held);
        let first = self.held[0].number;
        let run = if first == 0 || first == self.origin { RUN_FROM_THE_FIRST } else { RUN };
        if self.held.len() < run {
            return Ok(());
        }
        self.begin_again(first, self.numbering.expected())?;
        self.numbering = Numbering::default();
        for Held { number, values, .. } in std::mem::take(&mut self.held) {
            self.numbering.place(number, u64::MAX);
            self.use_frame(number, &values)?;
        }
        Ok(())
    }

    /// Reports the frames that began no new sequence.
    fn give_up_held(&mut self) {
        for Held { number, place, .. } in std::mem::take(&mut self.held) {
            let (kind, message) = match place {
                Place::Doubled => ("doubled", format!("frame {number} came again and is not used")),
                _ => ("late", format!("frame {number} came after a later one and is not used")),
            };
            self.loss(kind, number, message);
        }
    }

    /// Begins a new sequence with the frame of a number.
    fn begin_again(&mut self, number: u64, expected: u64) -> Result<()> {
        let message = format!("frame {number} follows frame {}: a new sequence begins", expected - 1);
        self.notice("restarted", Some(number), message);
        self.restart(number)?;
        if let FrameKind::Markers(frames) = &mut self.frames {
            frames.restart(&self.setup.model)?;
        }
        Ok(())
    }

    /// Computes the forces with a frame whose turn it is.
    fn use_frame(&mut self, number: u64, values: &[Option<f64>]) -> Result<()> {
        let q = self.checked(values)?;
        let q = self.fitted(q, number)?;
        if let Some(page) = &mut self.page {
            page.arrived(number, &q);
        }
        let forces = self.stream.push(&q)?;
        self.doubt();
        self.answer(forces);
        Ok(())
    }

    /// Reports the doubts of the library about the motion, each code once.
    fn doubt(&mut self) {
        // Angles that were fitted have the unit of the model.
        let is_unit = |code: Code| {
            matches!(code, Code::MotionDegreesAsRadians | Code::MotionRadiansAsDegrees | Code::MotionLengthUnit)
        };
        let is_fitted = matches!(self.frames, FrameKind::Markers(_));
        let is_new = |finding: &&Finding| !(self.doubted.contains(&finding.code) || is_fitted && is_unit(finding.code));
        let Some(finding) = self.stream.doubts().as_slice().iter().find(is_new).cloned() else { return };
        self.doubted.push(finding.code);
        self.notice(finding.code.name(), None, finding.message);
    }

    /// Reports what the times of the frames show.
    fn check_clock(&mut self, message: &Message) -> Result<()> {
        let (None, Some(time)) = (message.frame, message.time) else {
            self.decide();
            return Ok(());
        };
        let doubt = self.clock.doubt(time);
        let (stated_hz, is_judged) = (self.setup.settings.rate_hz, self.clock.is_judged());
        match doubt {
            Some(ClockDoubt::Unit(unit)) => {
                let message = format!(
                    "the times of the frames are {unit}, by the rate of {stated_hz} Hz; they are read as such. hint: \
                     send seconds"
                );
                self.undecided = Some(Vec::new());
                self.notice("clock", None, message);
                self.numbering = Numbering::default();
                if let Some(number) = self.clock.number(time) {
                    self.restart(number)?;
                }
            }
            Some(ClockDoubt::Rate(found_hz)) => {
                self.is_other_rate = true;
                let found_hz = (100.0 * found_hz).round() / 100.0;
                let message = format!(
                    "the times of the frames are those of {found_hz} Hz, but the stated rate is {stated_hz} Hz: \
                     frames are left out or bridged all the time. hint: --rate {found_hz}"
                );
                self.notice("clock", None, message);
            }
            None => {}
        }
        if is_judged {
            self.decide();
        }
        Ok(())
    }

    /// Reports the losses that waited, unless the times have another rate.
    fn decide(&mut self) {
        for (kind, frame, message) in self.undecided.take().unwrap_or_default() {
            self.loss(kind, frame, message);
        }
    }

    /// Reports a lost or repeated frame, once it is known that the rate is right.
    fn loss(&mut self, kind: &'static str, frame: u64, message: String) {
        match &mut self.undecided {
            _ if self.is_other_rate => {}
            Some(waiting) => waiting.push((kind, frame, message)),
            None => self.notice(kind, Some(frame), message),
        }
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
        let unit = frames.correct_unit(&self.setup.model);
        let fitted = frames.fit(&self.setup.model)?;
        if let Some(message) = unit {
            self.notice(Code::MotionLengthUnit.name(), Some(number), message);
        }
        let message = match fitted {
            Fitted::Posture(q) => {
                let FrameKind::Markers(frames) = &mut self.frames else { return Ok(q) };
                if let Some(message) = frames.judge_axes(&self.setup.model, &q) {
                    self.notice("axes", Some(number), message);
                }
                return Ok(q);
            }
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
            (None, Some(time)) => self
                .clock
                .number(time)
                .ok_or_else(|| anyhow!("a frame at {time:e} s; expected a time in seconds of at least 0")),
        }
    }

    /// Puts missing frames where some were lost: few are bridged, more restart the stream.
    fn bridge(&mut self, from: u64, missing: u64, number: u64) -> Result<()> {
        let lost = if missing == 1 { format!("frame {from}") } else { format!("frames {from} to {}", number - 1) };
        self.loss("lost", from, format!("{lost} did not arrive"));
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
        self.give_up_held();
        self.decide();
        let ended = std::mem::replace(&mut self.stream, self.setup.stream()?);
        let finished = self.finish(ended);
        self.survive(finished)?;
        let Counts { frames, results, notices, first_refusal } = std::mem::take(&mut self.counts);
        self.unused = match first_refusal {
            Some(refusal) if results == 0 => {
                Some(format!("no frame could be used, because messages were refused; the first: {refusal}"))
            }
            _ => None,
        };
        let notices: String = notices.iter().map(|(kind, count)| format!(", {count} x {kind}")).collect();
        let [frames, out] =
            [frames, results].map(|count| counted(usize::try_from(count).unwrap_or(usize::MAX), "frame"));
        let message = format!("{frames} in, forces of {out} out{notices}");
        self.setup.say(&message);
        self.send(&Answer::Notice { notice: "ended", frame: None, message });
        self.numbering = Numbering::default();
        self.clock = Clock::new(self.setup.settings.rate_hz);
        (self.undecided, self.is_other_rate) = (Some(Vec::new()), false);
        if let Some(page) = &mut self.page {
            page.ended();
        }
        Ok(())
    }

    /// # Errors
    /// Messages came, but no forces could be computed with any of them; known at the end.
    pub(super) fn check_used(&self) -> Result<()> {
        match &self.unused {
            Some(message) => bail!("{message}"),
            None => Ok(()),
        }
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

    /// Reports a notice about the frames: a few times on standard error, always in answers of formats that have
    /// notices.
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

    fn has_noticed(&self, kind: &str) -> bool {
        self.counts.notices.iter().any(|(other, _)| *other == kind)
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
