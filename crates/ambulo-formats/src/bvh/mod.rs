//! Skeletons in motion: BVH (Biovision's hierarchy), as motion capture and animation programs exchange it.
//!
//! ```text
//! HIERARCHY
//! ROOT Hips
//! {
//!     OFFSET 0.0 0.0 0.0
//!     CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
//!     JOINT LeftUpLeg
//!     {
//!         OFFSET 3.4 0.0 0.0
//!         CHANNELS 3 Zrotation Xrotation Yrotation
//!         End Site
//!         {
//!             OFFSET 0.0 -17.0 0.0
//!         }
//!     }
//! }
//! MOTION
//! Frames: 2
//! Frame Time: 0.033333
//! 8.0 35.0 41.9 0.0 0.0 0.0  5.1 2.2 -0.3
//! 7.8 35.1 41.8 0.1 0.0 0.0  5.9 2.1 -0.2
//! ```
//!
//! A file states no unit of length, no upward direction and no mass: lengths are kept as they are, angles are degrees.
//! The reader accepts any number of roots, joints without channels or of zero length, channels in any order, keywords
//! in any case, names with spaces and colons, braces on the line of the name. One line is one frame.
//!
//! The pose of a joint in its parent's frame: its position, then the rotations in the order of the channels, each about
//! the axes turned by the rotations before it. Without position channels the position is the offset. With them,
//! they replace the offset in most programs (and in both real files of the tests) and are added to it in a few; the
//! file does not state which.
//!
//! Not handled, and rejected: channels of scale, frames broken over several lines.
//! Source: M. Meredith, S. Maddock, Motion capture file formats explained, University of Sheffield, 2001 (unverified).
//! Pinned by: tests/skeletons.rs, tests/malformed.rs, tests/real_files.rs

mod read;
mod write;

use crate::error::{Error, Remark, quoted};
use crate::table::lines::check_name;

/// Largest number of joints; the largest rigs of hands and face have a few hundred.
pub const MAX_JOINTS: usize = 4096;
/// Deepest nesting of joints.
pub const MAX_DEPTH: usize = 256;

/// A skeleton and its motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Bvh {
    joints: Vec<Joint>,
    frame_time_s: f64,
    /// Values of all channels, frame after frame.
    values: Vec<f64>,
    frames: usize,
}

/// A joint and the bone that leads to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Name as in the file.
    pub name: String,
    /// The parent joint, as index into [`Bvh::joints`]; `None` for a root.
    pub parent: Option<usize>,
    /// Position in the parent's axes when all channels are zero [the file's unit of length].
    pub offset: [f64; 3],
    /// Meaning of the joint's columns of motion, in the file's order; at most six, all different.
    pub channels: Vec<Channel>,
    /// Ends of bones without a further joint, in this joint's axes [the file's unit of length]; usually none or one.
    pub end_sites: Vec<[f64; 3]>,
}

/// The quantity in one column of motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Channel {
    /// Translation or rotation.
    pub kind: ChannelKind,
    /// The axis: 0 = x, 1 = y, 2 = z.
    pub axis: usize,
}

/// Translation or rotation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ChannelKind {
    /// A distance [the file's unit of length].
    Position,
    /// An angle [degrees].
    Rotation,
}

impl Channel {
    /// All six, positions first.
    pub const ALL: [Channel; 6] = {
        const fn channel(kind: ChannelKind, axis: usize) -> Channel {
            Channel { kind, axis }
        }
        use ChannelKind::{Position, Rotation};
        [
            channel(Position, 0),
            channel(Position, 1),
            channel(Position, 2),
            channel(Rotation, 0),
            channel(Rotation, 1),
            channel(Rotation, 2),
        ]
    };

    /// Keyword in the file.
    pub fn word(self) -> &'static str {
        const WORDS: [&str; 6] = ["Xposition", "Yposition", "Zposition", "Xrotation", "Yrotation", "Zrotation"];
        let place = Channel::ALL.iter().position(|&channel| channel == self);
        place.map_or("", |place| WORDS[place])
    }
}

impl Bvh {
    /// A motion made in memory.
    ///
    /// Each joint comes after its parent and directly before its children, as in a file. `frames` have one value for
    /// each channel of each joint, in order; missing values are not-a-number.
    pub fn new(joints: Vec<Joint>, frame_time_s: f64, frames: &[Vec<f64>]) -> Result<Bvh, Error> {
        check_skeleton(&joints)?;
        if !is_frame_time(frame_time_s) {
            return Err(invalid(format!("a frame time of {frame_time_s} s"), "a finite time above zero"));
        }
        let width = count_channels(&joints);
        if let Some(odd) = frames.iter().find(|frame| frame.len() != width) {
            return Err(invalid(format!("a frame of {} values", odd.len()), format!("{width}, one per channel")));
        }
        if frames.iter().flatten().any(|value| value.is_infinite()) {
            return Err(invalid("an infinite value", "numbers, or not-a-number for missing values"));
        }
        if width == 0 && !frames.is_empty() {
            return Err(invalid("frames without a channel", "no frames, or joints with channels"));
        }
        Ok(Bvh { joints, frame_time_s, values: frames.concat(), frames: frames.len() })
    }

    /// Reads a `.bvh` file.
    pub fn read(bytes: &[u8]) -> Result<(Bvh, Vec<Remark>), Error> {
        read::read(bytes)
    }

    /// Writes a `.bvh` file; it reads back to the same bits.
    pub fn write(&self) -> Vec<u8> {
        write::write(self)
    }

    /// All joints, each after its parent.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Index of the first joint with exactly this name in [`Bvh::joints`].
    pub fn joint(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|joint| joint.name == name)
    }

    /// Time from one frame to the next \[s\].
    pub fn frame_time_s(&self) -> f64 {
        self.frame_time_s
    }

    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.frames
    }

    /// Number of channels of all joints, which is the number of values in a frame.
    pub fn channels(&self) -> usize {
        count_channels(&self.joints)
    }

    /// The values of one frame (counted from 0), one per channel; `None` after the last frame.
    pub fn frame(&self, frame: usize) -> Option<&[f64]> {
        let width = self.channels();
        if frame >= self.frames {
            return None;
        }
        self.values.get(frame * width..(frame + 1) * width)
    }

    /// The values of each joint within a frame: half-open ranges, one per joint.
    pub fn channel_ranges(&self) -> Vec<std::ops::Range<usize>> {
        let mut start = 0;
        let range = |joint: &Joint| {
            let range = start..start + joint.channels.len();
            start = range.end;
            range
        };
        self.joints.iter().map(range).collect()
    }
}

fn count_channels(joints: &[Joint]) -> usize {
    joints.iter().map(|joint| joint.channels.len()).sum()
}

fn is_frame_time(seconds: f64) -> bool {
    seconds.is_finite() && seconds > 0.0
}

/// Whether the skeleton can be written and read back: the same joints in the same order.
fn check_skeleton(joints: &[Joint]) -> Result<(), Error> {
    if joints.is_empty() || joints.len() > MAX_JOINTS {
        return Err(invalid(format!("{} joints", joints.len()), format!("1 to {MAX_JOINTS}")));
    }
    // The joints from the root to the previous one: only these can be the parent of the next joint in a file.
    let mut open: Vec<usize> = Vec::new();
    for (index, joint) in joints.iter().enumerate() {
        check_joint(joint)?;
        let carrier = joint.parent.map(|parent| open.iter().position(|&o| o == parent));
        match carrier {
            None => open.clear(),
            Some(Some(depth)) => open.truncate(depth + 1),
            Some(None) => {
                let found = format!("joint {} before its parent", quoted(&joint.name));
                return Err(invalid(found, "each joint directly before its children"));
            }
        }
        open.push(index);
        if open.len() > MAX_DEPTH {
            return Err(invalid(
                format!("joint {} nested too deeply", quoted(&joint.name)),
                format!("at most {MAX_DEPTH} deep"),
            ));
        }
    }
    Ok(())
}

fn check_joint(joint: &Joint) -> Result<(), Error> {
    check_name(&joint.name)?;
    let name = quoted(&joint.name);
    if joint.name.contains(['{', '}']) {
        return Err(invalid(format!("the name {name}"), "a name without braces"));
    }
    if joint.end_sites.iter().chain([&joint.offset]).flatten().any(|value| !value.is_finite()) {
        return Err(invalid(format!("an offset of {name} that is not finite"), "finite offsets"));
    }
    let known = |channel: &Channel| Channel::ALL.contains(channel);
    let twice = (1..joint.channels.len()).any(|k| joint.channels[..k].contains(&joint.channels[k]));
    if twice || !joint.channels.iter().all(known) {
        return Err(invalid(format!("the channels of {name}"), "positions and rotations in x, y, z, all different"));
    }
    Ok(())
}

fn invalid(found: impl Into<String>, expected: impl Into<String>) -> Error {
    Error::Record { found: found.into(), expected: expected.into() }
}
