//! Reading BVH.

use super::{Bvh, Channel, Joint, MAX_DEPTH, MAX_JOINTS, count_channels, is_frame_time};
use crate::content;
use crate::error::{Error, Remark, quoted};
use crate::plain_text::{Layout, PlainText};
use crate::table::lines::{Line, Lines, counted, duplicate, expected_number, number};

const CHANNEL_WORDS: &str = "Xposition, Yposition, Zposition, Xrotation, Yrotation or Zrotation";

pub(super) fn read(bytes: &[u8]) -> Result<(Bvh, Vec<Remark>), Error> {
    let text = PlainText::of(bytes).with_tabs(layout);
    read_text(&text.bytes, text.remarks).map_err(|error| error.or_other_content(bytes, content::BVH))
}

/// Numbers begin behind `MOTION`; only their decimal mark can differ.
fn layout(lines: &[&str]) -> Option<Layout> {
    let is_motion = |line: &&str| line.trim().eq_ignore_ascii_case("MOTION");
    let last_header_line = lines.iter().position(is_motion)?;
    let has_tabs = lines[last_header_line..].iter().any(|line| line.trim().contains('\t'));
    Some(Layout { separator: if has_tabs { '\t' } else { ' ' }, last_header_line })
}

fn read_text(bytes: &[u8], mut remarks: Vec<Remark>) -> Result<(Bvh, Vec<Remark>), Error> {
    let mut words = Words { lines: Lines::new(bytes, "a BVH file, which begins with `HIERARCHY`")?, line: None, at: 0 };
    words.keyword("HIERARCHY", "`HIERARCHY`, as a BVH file begins")?;
    let joints = read_hierarchy(&mut words)?;
    if let Some(twice) = duplicate(joints.iter().map(|joint| joint.name.as_str())) {
        let message = format!("two or more joints have the same name (first: {})", quoted(twice));
        remarks.push(Remark::of_file(message));
    }
    let (stated, frame_time_s) = read_motion_head(&mut words)?;
    let motion = read_frames(words, count_channels(&joints), stated)?;
    remarks.extend(motion.remarks);
    Ok((Bvh { joints, frame_time_s, values: motion.values, frames: motion.frames }, remarks))
}

/// The words of a file, separated by white space; a brace is a separate word.
struct Words<'a> {
    lines: Lines<'a>,
    line: Option<Line<'a>>,
    /// Byte in the text of `line` at which the search for the next word starts.
    at: usize,
}

/// A word and its line.
struct Word {
    text: String,
    line: usize,
}

impl Word {
    fn is(&self, keyword: &str) -> bool {
        self.text.eq_ignore_ascii_case(keyword)
    }

    fn error(&self, expected: impl Into<String>) -> Error {
        Error::Line { line: self.line, found: quoted(&self.text), expected: expected.into() }
    }
}

impl Words<'_> {
    /// The next word, or the error that the file ends before it.
    fn next(&mut self, expected: &str) -> Result<Word, Error> {
        loop {
            if let Some(line) = &self.line {
                let rest = line.text.get(self.at..).unwrap_or_default();
                let text = rest.trim_start();
                if !text.is_empty() {
                    let length = match text.find(|c: char| c.is_whitespace() || c == '{' || c == '}') {
                        Some(0) => 1,
                        Some(end) => end,
                        None => text.len(),
                    };
                    let word = Word { text: text[..length].to_owned(), line: line.number };
                    self.at += rest.len() - text.len() + length;
                    return Ok(word);
                }
            }
            let next = self.lines.next_filled()?;
            self.line = Some(next.ok_or_else(|| self.lines.truncated(expected))?);
            self.at = 0;
        }
    }

    /// The rest of the line up to a brace, without the white space around it.
    fn rest_of_line(&mut self) -> Option<Word> {
        let line = self.line.as_ref()?;
        let rest = line.text.get(self.at..).unwrap_or_default();
        let end = rest.find('{').unwrap_or(rest.len());
        self.at += end;
        Some(Word { text: rest[..end].trim().to_owned(), line: line.number })
    }

    fn keyword(&mut self, keyword: &str, expected: &str) -> Result<Word, Error> {
        let word = self.next(expected)?;
        if word.is(keyword) { Ok(word) } else { Err(word.error(expected)) }
    }

    fn offset(&mut self) -> Result<[f64; 3], Error> {
        let mut offset = [0.0; 3];
        for value in &mut offset {
            let word = self.next("three numbers after OFFSET")?;
            *value = number(&word.text).filter(|value| value.is_finite()).ok_or_else(|| {
                word.error(format!("OFFSET and three finite numbers: {}", expected_number(&word.text)))
            })?;
        }
        Ok(offset)
    }

    fn channels(&mut self) -> Result<Vec<Channel>, Error> {
        let count = self.next("the number of channels")?;
        let number = count.text.parse().ok().filter(|&n: &usize| n <= Channel::ALL.len());
        let number = number.ok_or_else(|| count.error("a number of channels from 0 to 6"))?;
        let mut channels = Vec::new();
        for _ in 0..number {
            let word = self.next(CHANNEL_WORDS)?;
            let channel = Channel::ALL.into_iter().find(|channel| word.is(channel.word()));
            let channel = channel.ok_or_else(|| word.error(format!("{number} channels: {CHANNEL_WORDS}")))?;
            if channels.contains(&channel) {
                return Err(word.error("different channels within a joint"));
            }
            channels.push(channel);
        }
        Ok(channels)
    }
}

/// A joint whose brace is not closed yet.
struct Open {
    joint: usize,
    line: usize,
    has_offset: bool,
    has_channels: bool,
}

/// All roots with their descendants, up to the word `MOTION`.
fn read_hierarchy(words: &mut Words<'_>) -> Result<Vec<Joint>, Error> {
    let mut joints: Vec<Joint> = Vec::new();
    loop {
        let word = words.next("a `ROOT`, or `MOTION` after the last one")?;
        if word.is("ROOT") {
            read_root(words, &word, &mut joints)?;
        } else if word.is("MOTION") && !joints.is_empty() {
            return Ok(joints);
        } else {
            let expected = if joints.is_empty() { "`ROOT` and a name" } else { "`ROOT` and a name, or `MOTION`" };
            return Err(word.error(expected));
        }
    }
}

/// A root up to its closing brace, without recursion.
fn read_root(words: &mut Words<'_>, keyword: &Word, joints: &mut Vec<Joint>) -> Result<(), Error> {
    const EXPECTED: &str = "`OFFSET`, `CHANNELS`, `JOINT`, `End Site` or `}`";
    let mut open = vec![begin_joint(words, keyword, None, joints)?];
    while let Some(current) = open.last_mut() {
        let word = words.next(EXPECTED)?;
        let joint = current.joint;
        if word.is("OFFSET") && !current.has_offset {
            current.has_offset = true;
            joints[joint].offset = words.offset()?;
        } else if word.is("CHANNELS") && !current.has_channels {
            // Columns of motion are in the order of the CHANNELS keywords.
            if joint + 1 != joints.len() {
                return Err(word.error("`CHANNELS` of a joint before its child joints"));
            }
            current.has_channels = true;
            joints[joint].channels = words.channels()?;
        } else if word.is("JOINT") {
            if open.len() >= MAX_DEPTH {
                return Err(word.error(format!("joints nested at most {MAX_DEPTH} deep")));
            }
            open.push(begin_joint(words, &word, Some(joint), joints)?);
        } else if word.is("End") {
            words.rest_of_line();
            let end = read_end_site(words)?;
            joints[joint].end_sites.push(end);
        } else if word.text == "}" {
            if !current.has_offset {
                let found = format!("joint {} without OFFSET", quoted(&joints[joint].name));
                return Err(Error::Line { line: current.line, found, expected: "OFFSET and three numbers".into() });
            }
            open.pop();
        } else {
            return Err(word.error(EXPECTED));
        }
    }
    Ok(())
}

/// Name and opening brace.
fn begin_joint(
    words: &mut Words<'_>,
    keyword: &Word,
    parent: Option<usize>,
    joints: &mut Vec<Joint>,
) -> Result<Open, Error> {
    if joints.len() >= MAX_JOINTS {
        return Err(keyword.error(format!("at most {MAX_JOINTS} joints")));
    }
    let name = words.rest_of_line().map(|word| word.text).unwrap_or_default();
    let name: String = name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let name = name.trim().to_owned();
    if name.is_empty() || name.contains('}') {
        let found = if name.is_empty() { format!("{} without a name", quoted(&keyword.text)) } else { quoted(&name) };
        return Err(Error::Line { line: keyword.line, found, expected: "a name without braces".into() });
    }
    words.keyword("{", "`{` after the name of a joint")?;
    joints.push(Joint { name, parent, offset: [0.0; 3], channels: vec![], end_sites: vec![] });
    Ok(Open { joint: joints.len() - 1, line: keyword.line, has_offset: false, has_channels: false })
}

fn read_end_site(words: &mut Words<'_>) -> Result<[f64; 3], Error> {
    words.keyword("{", "`{` behind `End Site`")?;
    words.keyword("OFFSET", "`OFFSET` in an `End Site`")?;
    let offset = words.offset()?;
    words.keyword("}", "`}` after the OFFSET of an `End Site`")?;
    Ok(offset)
}

/// The stated number of frames, with the frame time \[s\].
fn read_motion_head(words: &mut Words<'_>) -> Result<(usize, f64), Error> {
    let frames = labelled(words, &["Frames"], "`Frames:` and their number")?;
    let count = frames.text.parse().map_err(|_| frames.error("`Frames:` and a whole number"))?;
    let time = labelled(words, &["Frame", "Time"], "`Frame Time:` and seconds")?;
    let seconds = number(&time.text).filter(|&seconds| is_frame_time(seconds));
    let expected = "`Frame Time:` and seconds from one frame to the next, a finite number above zero";
    Ok((count, seconds.ok_or_else(|| time.error(expected))?))
}

/// The word after a label; the colon may be attached to the label or be a separate word.
fn labelled(words: &mut Words<'_>, label: &[&str], expected: &str) -> Result<Word, Error> {
    for (k, part) in label.iter().enumerate() {
        let mut word = words.next(expected)?;
        let is_last = k + 1 == label.len();
        if is_last && let Some((before, behind)) = word.text.split_once(':') {
            // `Frames:12` is label and value in one.
            let value = Word { text: behind.to_owned(), line: word.line };
            word.text = before.to_owned();
            if !word.is(part) {
                return Err(word.error(expected));
            }
            return if value.text.is_empty() { words.next(expected) } else { Ok(value) };
        }
        if !word.is(part) {
            return Err(word.error(expected));
        }
    }
    let word = words.next(expected)?;
    match word.text.strip_prefix(':') {
        Some("") => words.next(expected),
        Some(value) => Ok(Word { text: value.to_owned(), line: word.line }),
        None => Ok(word),
    }
}

struct Motion {
    values: Vec<f64>,
    frames: usize,
    remarks: Vec<Remark>,
}

/// One line per frame, to the end of the file.
fn read_frames(words: Words<'_>, width: usize, stated: usize) -> Result<Motion, Error> {
    let Words { mut lines, line, at } = words;
    if let Some(line) = line.filter(|line| !line.text.get(at..).unwrap_or_default().trim().is_empty()) {
        let found = quoted(line.text.get(at..).unwrap_or_default());
        return Err(line.error(found, "the end of the line after the frame time"));
    }
    let mut motion = Motion { values: vec![], frames: 0, remarks: vec![] };
    let mut unseen: Option<(usize, usize)> = None;
    while let Some(line) = lines.next_filled()? {
        match read_frame(&line, width, &mut motion.values) {
            Ok(0) => {}
            Ok(missing) => unseen.get_or_insert((line.number, 0)).1 += missing,
            Err(error) => {
                let cut = motion.frames < stated && lines.is_at_end() && is_cut(&line, width, lines.last_is_ended());
                return Err(if cut {
                    lines.truncated(format!("the rest of a frame of {width} values"))
                } else {
                    error
                });
            }
        }
        motion.frames += 1;
    }
    if let Some((line, count)) = unseen {
        let message = format!("{} not-a-number; kept as missing", counted(count, "value"));
        motion.remarks.push(Remark::of_line(line, message));
    }
    if motion.frames != stated {
        motion.remarks.push(Remark::of_file(frame_count_message(stated, motion.frames, &lines)));
    }
    Ok(motion)
}

fn frame_count_message(stated: usize, frames: usize, lines: &Lines<'_>) -> String {
    let cut = if frames < stated && !lines.last_is_ended() {
        "; the last line has no line end, so its last number may be truncated"
    } else {
        ""
    };
    format!("`Frames:` states {stated}, the file has {frames}; read {frames}{cut}")
}

/// Whether the file is truncated in this frame: values are missing, or the last one is incomplete.
fn is_cut(line: &Line<'_>, width: usize, ended: bool) -> bool {
    let count = line.text.split_whitespace().count();
    let last_is_broken = || line.text.split_whitespace().last().is_some_and(|word| number(word).is_none());
    count < width || (count == width && !ended && last_is_broken())
}

/// Appends a frame; returns how many of its values are not-a-number.
fn read_frame(line: &Line<'_>, width: usize, values: &mut Vec<f64>) -> Result<usize, Error> {
    let count = line.text.split_whitespace().count();
    if count != width {
        let expected = format!("{width}, one per channel of the skeleton, with one frame per line");
        return Err(line.error(counted(count, "value"), expected));
    }
    let mut missing = 0;
    for word in line.text.split_whitespace() {
        let value = number(word).ok_or_else(|| line.error(quoted(word), expected_number(word)))?;
        let value = if value.is_infinite() { f64::NAN } else { value };
        missing += usize::from(value.is_nan());
        values.push(value);
    }
    Ok(missing)
}
