//! Reads `.mvnx`.

use super::{Mvnx, MvnxFrame, MvnxJoint, MvnxPose, MvnxSegment};
use crate::error::{Error, Remark, quoted};
use crate::xml::{self, child, document_text, elements, error_at, numbers_of, text};
use roxmltree::Node;

/// Largest number of XML nodes: some ten minutes at 240 frames per second, with all that MVN can export.
const NODE_LIMIT: u32 = 8_000_000;
/// Largest frame number that can be a time.
const LAST_INDEX: u64 = 1 << 40;
/// Largest difference of the length of a quaternion from 1; files have six decimals.
const QUATERNION_DEFECT: f64 = 1e-2;

impl Mvnx {
    /// Reads a file.
    ///
    /// # Errors
    /// A document that is no `.mvnx`, or that lacks segments, frame rate or frames; poses that do not belong to the
    /// segments; quaternions that are no rotations; frames that repeat.
    pub fn read(bytes: &[u8]) -> Result<(Mvnx, Vec<Remark>), Error> {
        let text = without_document_type(document_text(bytes));
        if text.trim().is_empty() {
            return Err(Error::Empty { expected: "an XML document with the element <mvnx>" });
        }
        let document = xml::parse_up_to(&text, NODE_LIMIT)?;
        let root = document.root_element();
        if !root.has_tag_name("mvnx") {
            return Err(error_at(
                root,
                "this element as the outermost one".to_owned(),
                "<mvnx>, as Xsens MVN exports it",
            ));
        }
        let subject = needed(root, "subject", "a subject with segments and frames")?;
        let mut mvnx = Mvnx {
            version: attribute(root, "version"),
            software: child(root, "mvn").map_or_else(String::new, |mvn| attribute(mvn, "version")),
            subject: attribute(subject, "label"),
            recorded_on: attribute(subject, "recDate"),
            configuration: attribute(subject, "configuration"),
            rate_hz: rate(subject)?,
            segments: segments(subject)?,
            joints: joints(subject),
            contacts: contacts(subject)?,
            calibration: Vec::new(),
            frames: Vec::new(),
        };
        let mut remarks = Vec::new();
        mvnx.read_frames(subject, &mut remarks)?;
        Ok((mvnx, remarks))
    }

    fn read_frames(&mut self, subject: Node<'_, '_>, remarks: &mut Vec<Remark>) -> Result<(), Error> {
        let frames = needed(subject, "frames", "the frames of the motion")?;
        let mut order = FrameOrder { rate_hz: self.rate_hz, first: None, last: None, off: 0 };
        for frame in elements(frames).filter(|frame| frame.has_tag_name("frame")) {
            let kind = attribute(frame, "type");
            let is_recorded = kind == "normal" || (kind.is_empty() && frame.attribute("index").is_some());
            if !is_recorded {
                if let Some(poses) = self.poses(frame)? {
                    self.calibration.push((kind, poses));
                }
                continue;
            }
            let index = order.next(frame)?;
            let Some(poses) = self.poses(frame)? else {
                let found = "neither <orientation> nor <position>".to_owned();
                return Err(error_at(
                    frame,
                    found,
                    "both, for each segment; export the file with segment orientations and positions",
                ));
            };
            self.frames.push(MvnxFrame { index, poses, contacts: self.flags(frame)? });
        }
        if self.frames.is_empty() {
            return Err(error_at(frames, "no frame of the type `normal`".to_owned(), "at least one recorded frame"));
        }
        remarks.extend(order.remark());
        Ok(())
    }

    /// The poses of all segments; `None` if the frame has none.
    fn poses(&self, frame: Node<'_, '_>) -> Result<Option<Vec<MvnxPose>>, Error> {
        let (orientation, position) = match (child(frame, "orientation"), child(frame, "position")) {
            (None, None) => return Ok(None),
            (Some(orientation), Some(position)) => (orientation, position),
            (found, _) => {
                let (found, missing) =
                    if found.is_some() { ("orientation", "position") } else { ("position", "orientation") };
                return Err(error_at(
                    frame,
                    format!("<{found}> but no <{missing}>{}", of_frame(frame)),
                    "both, for each segment",
                ));
            }
        };
        let turns = self.values(orientation, 4, "w x y z")?;
        let places = self.values(position, 3, "x y z")?;
        let mut poses = Vec::with_capacity(self.segments.len());
        for ((segment, q), p) in self.segments.iter().zip(turns.chunks_exact(4)).zip(places.chunks_exact(3)) {
            let length = q.iter().map(|part| part * part).sum::<f64>().sqrt();
            if (length - 1.0).abs() > QUATERNION_DEFECT {
                let found = format!(
                    "the quaternion {} {} {} {} of length {length:.3} for `{}`{}",
                    q[0],
                    q[1],
                    q[2],
                    q[3],
                    segment.label,
                    of_frame(frame)
                );
                return Err(error_at(
                    orientation,
                    found,
                    "a rotation: w x y z of length 1. Was the segment tracked in this frame?",
                ));
            }
            let orientation = [q[0] / length, q[1] / length, q[2] / length, q[3] / length];
            poses.push(MvnxPose { orientation, position: [p[0], p[1], p[2]] });
        }
        Ok(Some(poses))
    }

    /// The numbers of an element with `each` of them per segment.
    fn values(&self, node: Node<'_, '_>, each: usize, meaning: &str) -> Result<Vec<f64>, Error> {
        let values = numbers_of(node)?;
        let segments = self.segments.len();
        if values.len() != each * segments {
            let found = format!("{} numbers{}", values.len(), node.parent().map_or_else(String::new, of_frame));
            let expected =
                format!("{}: {meaning} for each of the {segments} segments that <segments> lists", each * segments);
            return Err(error_at(node, found, expected));
        }
        Ok(values)
    }

    /// The contacts of the feet in a frame.
    fn flags(&self, frame: Node<'_, '_>) -> Result<Vec<bool>, Error> {
        let Some(node) = child(frame, "footContacts").filter(|_| !self.contacts.is_empty()) else {
            return Ok(Vec::new());
        };
        let flags = numbers_of(node)?;
        if flags.len() != self.contacts.len() {
            let expected = format!("{}, one for each contact that <footContactDefinition> lists", self.contacts.len());
            return Err(error_at(node, format!("{} flags{}", flags.len(), of_frame(frame)), expected));
        }
        Ok(flags.iter().map(|flag| *flag > 0.5).collect())
    }
}

/// The text without a document type that only names a file; a document type with declarations is kept and refused.
fn without_document_type(text: String) -> String {
    const BEGIN: &str = "<!DOCTYPE";
    let Some(start) = text.find(BEGIN) else { return text };
    let Some(length) = text[start..].find('>').filter(|length| !text[start..start + length].contains('[')) else {
        return text;
    };
    let blank: String = text[start..=start + length].chars().map(|c| if c == '\n' { '\n' } else { ' ' }).collect();
    format!("{}{blank}{}", &text[..start], &text[start + length + 1..])
}

/// The numbers of the frames, which increase.
struct FrameOrder {
    rate_hz: f64,
    /// Number and time [ms] of the first frame.
    first: Option<(u64, f64)>,
    /// Number, and time in milliseconds, of the frame before.
    last: Option<(u64, Option<f64>)>,
    /// Frames whose stated time differs from the time of their number.
    off: usize,
}

impl FrameOrder {
    /// The number of a frame: `index`, or the one after the last.
    fn next(&mut self, frame: Node<'_, '_>) -> Result<u64, Error> {
        let index = match frame.attribute("index").map(str::trim).filter(|index| !index.is_empty()) {
            Some(stated) => stated.parse().ok().filter(|index| *index < LAST_INDEX).ok_or_else(|| {
                error_at(frame, format!("index={}", quoted(stated)), "the number of the frame, counted from 0")
            })?,
            None => self.last.map_or(0, |(last, _)| last + 1),
        };
        let stated_ms = frame.attribute("time").and_then(|time| time.trim().parse().ok());
        let time_ms = stated_ms.filter(|time: &f64| time.is_finite());
        self.check(frame, index, time_ms)?;
        if let Some(time) = time_ms {
            let (first, start) = *self.first.get_or_insert((index, time));
            let by_number = start + 1e3 * (index - first) as f64 / self.rate_hz;
            self.off += usize::from((time - by_number).abs() > (0.5e3 / self.rate_hz).max(2.0));
        }
        self.last = Some((index, time_ms));
        Ok(index)
    }

    /// Rejects frames that repeat. Above 1000 Hz, whole milliseconds repeat.
    fn check(&self, frame: Node<'_, '_>, index: u64, time_ms: Option<f64>) -> Result<(), Error> {
        let Some((last, last_ms)) = self.last else { return Ok(()) };
        if index <= last {
            let expected = "frames with increasing numbers; remove the repeated ones, or export the file again";
            return Err(error_at(frame, format!("index {index} after index {last}"), expected));
        }
        let repeated = time_ms.zip(last_ms).filter(|(time, before)| time <= before && self.rate_hz < 1000.0);
        match repeated {
            Some((time, before)) => {
                let found = format!("time {time} ms in frame {index} after {before} ms in frame {last}");
                let expected = "frames at increasing times; remove the repeated ones, or export the file again";
                Err(error_at(frame, found, expected))
            }
            None => Ok(()),
        }
    }

    fn remark(&self) -> Option<Remark> {
        (self.off > 0).then(|| {
            Remark::of_file(format!(
                "{} frames state another time than their number divided by the frame rate ({} Hz); the number was used",
                self.off, self.rate_hz
            ))
        })
    }
}

/// ` in frame 12`.
fn of_frame(frame: Node<'_, '_>) -> String {
    let kind = frame.attribute("type").filter(|kind| *kind != "normal");
    let index = frame.attribute("index").filter(|index| !index.trim().is_empty());
    match (kind, index) {
        (Some(kind), _) => format!(" in the calibration pose {}", quoted(kind)),
        (None, Some(index)) => format!(" in frame {}", index.trim()),
        (None, None) => String::new(),
    }
}

fn needed<'a, 'i>(node: Node<'a, 'i>, tag: &str, what: &str) -> Result<Node<'a, 'i>, Error> {
    child(node, tag).ok_or_else(|| error_at(node, format!("no <{tag}>"), what))
}

fn attribute(node: Node<'_, '_>, name: &str) -> String {
    node.attribute(name).unwrap_or_default().trim().to_owned()
}

fn rate(subject: Node<'_, '_>) -> Result<f64, Error> {
    let stated = attribute(subject, "frameRate");
    let rate = stated.parse().ok().filter(|rate: &f64| rate.is_finite() && *rate > 0.0);
    rate.ok_or_else(|| error_at(subject, format!("frameRate={}", quoted(&stated)), "the frame rate in Hz, above 0"))
}

fn segments(subject: Node<'_, '_>) -> Result<Vec<MvnxSegment>, Error> {
    let list = needed(subject, "segments", "the list of the segments")?;
    let mut segments: Vec<MvnxSegment> = Vec::new();
    for node in elements(list).filter(|node| node.has_tag_name("segment")) {
        let label = attribute(node, "label");
        if label.is_empty() || segments.iter().any(|known| known.label == label) {
            return Err(error_at(node, format!("label={}", quoted(&label)), "a label that no other segment has"));
        }
        let mut points = Vec::new();
        for point in child(node, "points").into_iter().flat_map(elements).filter(|point| point.has_tag_name("point")) {
            let Some(place) = child(point, "pos_b").or_else(|| child(point, "pos_s")) else { continue };
            let Ok(place) = <[f64; 3]>::try_from(numbers_of(place)?) else {
                return Err(error_at(place, quoted(place.text().unwrap_or_default()), "three numbers x y z in metres"));
            };
            points.push((attribute(point, "label"), place));
        }
        segments.push(MvnxSegment { label, points });
    }
    if segments.is_empty() {
        return Err(error_at(list, "no <segment>".to_owned(), "the segments whose poses the frames have"));
    }
    Ok(segments)
}

fn joints(subject: Node<'_, '_>) -> Vec<MvnxJoint> {
    let joint = |node: Node<'_, '_>| MvnxJoint {
        label: attribute(node, "label"),
        parent: text(node, "connector1").unwrap_or_default().to_owned(),
        child: text(node, "connector2").unwrap_or_default().to_owned(),
    };
    let list = child(subject, "joints").into_iter().flat_map(elements);
    list.filter(|node| node.has_tag_name("joint")).map(joint).collect()
}

/// The contacts of the feet in the order of their `index`.
fn contacts(subject: Node<'_, '_>) -> Result<Vec<String>, Error> {
    let list = child(subject, "footContactDefinition").into_iter().flat_map(elements);
    let nodes: Vec<Node<'_, '_>> = list.filter(|node| node.has_tag_name("contactDefinition")).collect();
    let mut contacts = vec![String::new(); nodes.len()];
    for (place, node) in nodes.iter().enumerate() {
        let stated = attribute(*node, "index");
        let index = if stated.is_empty() { Some(place) } else { stated.parse().ok() };
        let free = index.filter(|index| contacts.get(*index).is_some_and(String::is_empty));
        let Some(index) = free else {
            let expected = format!("each of 0 to {} once", nodes.len() - 1);
            return Err(error_at(*node, format!("index={}", quoted(&stated)), expected));
        };
        contacts[index] = attribute(*node, "label");
    }
    Ok(contacts)
}
