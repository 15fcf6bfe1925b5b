//! Writing BVH.

use super::{Bvh, Joint};
use std::fmt::Write;

pub(super) fn write(bvh: &Bvh) -> Vec<u8> {
    let mut out = Text(String::from("HIERARCHY\n"));
    let mut open: Vec<usize> = Vec::new();
    for (index, joint) in bvh.joints.iter().enumerate() {
        let depth = joint.parent.and_then(|parent| open.iter().position(|&o| o == parent)).map_or(0, |d| d + 1);
        out.close(&mut open, depth);
        out.joint(joint, depth);
        open.push(index);
    }
    out.close(&mut open, 0);
    out.motion(bvh);
    out.0.into_bytes()
}

struct Text(String);

impl Text {
    fn line(&mut self, depth: usize, text: std::fmt::Arguments<'_>) {
        (0..depth).for_each(|_| self.0.push('\t'));
        writeln!(self.0, "{text}").expect("writing to memory does not fail");
    }

    /// Closes joints until `depth` of them are open.
    fn close(&mut self, open: &mut Vec<usize>, depth: usize) {
        while open.len() > depth {
            open.pop();
            self.line(open.len(), format_args!("}}"));
        }
    }

    /// Writes a joint up to its children; its brace stays open.
    fn joint(&mut self, joint: &Joint, depth: usize) {
        let keyword = if joint.parent.is_some() { "JOINT" } else { "ROOT" };
        self.line(depth, format_args!("{keyword} {}", joint.name));
        self.line(depth, format_args!("{{"));
        self.offset(joint.offset, depth + 1);
        let words: String = joint.channels.iter().flat_map(|channel| [" ", channel.word()]).collect();
        self.line(depth + 1, format_args!("CHANNELS {}{words}", joint.channels.len()));
        for &end in &joint.end_sites {
            self.line(depth + 1, format_args!("End Site"));
            self.line(depth + 1, format_args!("{{"));
            self.offset(end, depth + 2);
            self.line(depth + 1, format_args!("}}"));
        }
    }

    fn offset(&mut self, [x, y, z]: [f64; 3], depth: usize) {
        self.line(depth, format_args!("OFFSET {x:?} {y:?} {z:?}"));
    }

    fn motion(&mut self, bvh: &Bvh) {
        self.line(0, format_args!("MOTION"));
        self.line(0, format_args!("Frames: {}", bvh.frames));
        self.line(0, format_args!("Frame Time: {:?}", bvh.frame_time_s));
        for frame in (0..bvh.frames).filter_map(|k| bvh.frame(k)) {
            let values: Vec<String> = frame.iter().map(|value| format!("{value:?}")).collect();
            self.line(0, format_args!("{}", values.join(" ")));
        }
    }
}
