//! Poses of the joints of a skeleton: forward kinematics.
//!
//! The frame of a joint in its parent: its position, then the rotations of its channels in the order of the file, each
//! about axes rotated by the previous ones: R = R_1 R_2 R_3.
//!
//! Position channels either replace the offset or are added to it; the file does not specify which. For a root the
//! choice shifts the whole motion by a constant, and they are assumed to replace it. For other joints the assumption is
//! the one that is nearer to the values on average: the offset, or zero.

use super::channel_angles::about;
use super::error::SkeletonError;
use crate::numerics::sampled;
use crate::spatial::{Mat3, Pose, Vec3};
use ambulo_formats::bvh::{Bvh, ChannelKind, Joint};
use std::ops::Range;

/// A skeleton in motion, in the unit and the axes of the file.
pub(super) struct Skeleton<'b> {
    bvh: &'b Bvh,
    ranges: Vec<Range<usize>>,
    /// Whether the position channels of a joint are added to its offset.
    added: Vec<bool>,
}

impl<'b> Skeleton<'b> {
    pub(super) fn new(bvh: &'b Bvh) -> Result<Skeleton<'b>, SkeletonError> {
        if bvh.frames() < 2 {
            return Err(SkeletonError::NoFrames);
        }
        let ranges = bvh.channel_ranges();
        let added = (0..ranges.len()).map(|joint| is_added(bvh, joint, &ranges[joint])).collect();
        Ok(Skeleton { bvh, ranges, added })
    }

    pub(super) fn frames(&self) -> usize {
        self.bvh.frames()
    }

    /// The parent of a joint.
    pub(super) fn parent(&self, joint: usize) -> Option<usize> {
        self.bvh.joints()[joint].parent
    }

    /// Time from one frame to the next [s].
    pub(super) fn frame_time_s(&self) -> f64 {
        self.bvh.frame_time_s()
    }

    /// The file.
    pub(super) fn file(&self) -> &'b Bvh {
        self.bvh
    }

    /// The joints of the file.
    pub(super) fn joints(&self) -> &'b [Joint] {
        self.bvh.joints()
    }

    /// The values of a joint within a frame.
    pub(super) fn range(&self, joint: usize) -> Range<usize> {
        self.ranges[joint].clone()
    }

    /// Place in a frame and axis of each channel of this kind, in the order of the file.
    pub(super) fn channels(&self, joint: usize, kind: ChannelKind) -> Vec<(usize, usize)> {
        let of_kind = self.joints()[joint].channels.iter().zip(self.range(joint));
        of_kind.filter(|(channel, _)| channel.kind == kind).map(|(channel, place)| (place, channel.axis)).collect()
    }

    /// A joint, its parent and so on up to a root.
    pub(super) fn upwards(&self, joint: usize) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(Some(joint), |&joint| self.parent(joint))
    }

    /// Poses of all joints in a frame; `None` is the resting pose, with all channels zero.
    pub(super) fn poses(&self, frame: Option<usize>) -> Vec<Pose> {
        match frame.and_then(|frame| self.bvh.frame(frame)) {
            Some(values) => self.poses_of(values),
            None => self.chained(|joint| Pose::at(Vec3::from(self.joints()[joint].offset))),
        }
    }

    /// Poses of all joints with these values of all channels.
    pub(super) fn poses_of(&self, values: &[f64]) -> Vec<Pose> {
        self.chained(|joint| self.own_pose(joint, &values[self.range(joint)]))
    }

    /// Poses of all joints from the pose of each in its parent.
    fn chained(&self, own_pose: impl Fn(usize) -> Pose) -> Vec<Pose> {
        let mut poses: Vec<Pose> = Vec::with_capacity(self.ranges.len());
        for joint in 0..self.ranges.len() {
            let parent = self.parent(joint).map_or(Pose::IDENTITY, |parent| poses[parent]);
            poses.push(parent * own_pose(joint));
        }
        poses
    }

    /// The poses of all frames.
    pub(super) fn all_poses(&self) -> impl Iterator<Item = Vec<Pose>> + '_ {
        (0..self.frames()).map(|frame| self.poses(Some(frame)))
    }

    /// The poses of at most `most` frames, spread over the recording.
    pub(super) fn some_poses(&self, most: usize) -> impl Iterator<Item = Vec<Pose>> + '_ {
        self.some_frames(most).map(|frame| self.poses(Some(frame)))
    }

    /// At most `most` frames, spread over the recording; the first is one of them.
    pub(super) fn some_frames(&self, most: usize) -> impl Iterator<Item = usize> + use<> {
        sampled(self.frames(), most)
    }

    /// The pose of a joint in its parent with these values of its channels.
    pub(super) fn own_pose(&self, joint: usize, values: &[f64]) -> Pose {
        let description = &self.bvh.joints()[joint];
        let offset = Vec3::from(description.offset);
        let mut translation = offset;
        let mut rotation = Mat3::identity();
        for (channel, &value) in description.channels.iter().zip(values) {
            match channel.kind {
                ChannelKind::Position => {
                    let start = if self.added[joint] { offset[channel.axis] } else { 0.0 };
                    translation[channel.axis] = start + value;
                }
                ChannelKind::Rotation => rotation *= about(channel.axis, value.to_radians()),
            }
        }
        Pose { rotation, translation }
    }

    /// Vector from a joint to one of its descendants in the resting pose; zero to itself.
    pub(super) fn offset_between(&self, from: usize, to: usize) -> Vec3 {
        let joints = self.bvh.joints();
        let (mut way, mut at) = (Vec3::zeros(), to);
        while at != from {
            way += Vec3::from(joints[at].offset);
            match joints[at].parent {
                Some(parent) => at = parent,
                None => break,
            }
        }
        way
    }

    /// Distal end of the bone of a joint, in its axes: an end site or a child joint at another position.
    pub(super) fn tip(&self, joint: usize) -> Option<Vec3> {
        let joints = self.bvh.joints();
        let carried = joints.iter().filter(|other| other.parent == Some(joint)).map(|other| other.offset);
        let ends = joints[joint].end_sites.iter().copied().chain(carried);
        ends.map(Vec3::from).find(|end| end.norm() > 0.0)
    }

    /// The last common ancestor of two joints.
    pub(super) fn common_ancestor(&self, a: usize, b: usize) -> Option<usize> {
        self.upwards(a).skip(1).find(|joint| self.upwards(b).skip(1).any(|other| other == *joint))
    }
}

fn is_added(bvh: &Bvh, joint: usize, range: &Range<usize>) -> bool {
    let description = &bvh.joints()[joint];
    if description.parent.is_none() {
        return false;
    }
    let (mut to_offset, mut to_zero) = (0.0, 0.0);
    for values in (0..bvh.frames()).filter_map(|frame| bvh.frame(frame)?.get(range.clone())) {
        for (channel, value) in description.channels.iter().zip(values) {
            if channel.kind == ChannelKind::Position && value.is_finite() {
                to_offset += (value - description.offset[channel.axis]).abs();
                to_zero += value.abs();
            }
        }
    }
    to_zero < to_offset
}
