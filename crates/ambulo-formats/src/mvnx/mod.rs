//! Motions of Xsens MVN: `.mvnx`, versions 3 and 4.
//!
//! ```text
//! <mvnx version="4">
//!   <mvn version="2019.0.0"/>
//!   <subject label="MVN System 1" frameRate="60" segmentCount="23" configuration="FullBody">
//!     <segments>
//!       <segment label="Pelvis" id="1">
//!         <points><point label="jRightHip"><pos_b>0.000 -0.095 0.001</pos_b></point>…</points>    (pos_s in version 3)
//!       </segment>…
//!     </segments>
//!     <joints><joint label="jRightHip">
//!       <connector1>Pelvis/jRightHip</connector1><connector2>RightUpperLeg/jRightHip</connector2>
//!     </joint>…</joints>
//!     <footContactDefinition><contactDefinition label="LeftFoot_Heel" index="0"/>…</footContactDefinition>
//!     <frames segmentCount="23">
//!       <frame time="0" type="tpose"> … </frame>                          (also identity, npose, tpose-isb, npose-isb)
//!       <frame time="0" index="0" type="normal">
//!         <orientation>w x y z of each segment</orientation>                         (global from segment)
//!         <position>x y z of the origin of each segment [m]</position>
//!         <footContacts>1 1 0 0</footContacts>
//!       </frame>…
//! ```
//!
//! Positions are in metres, with z up; the origin of a segment is its upper joint, and the time of a frame is its index
//! divided by the frame rate (the attribute `time` is that in whole milliseconds). Velocities, accelerations, joint
//! angles and sensors are not read.
//!
//! Sources: MVN User Manual, document MV0319P.N (June 2015), MVNX and sections 19.5 to 19.7; Xsens' XML schema of
//! version 3; the head and the first frames of an upper-body recording of MVN 2019 (version 4). No other file of MVN
//! was seen. Pinned by: tests/motions_mvnx.rs

mod read;

/// A motion of Xsens MVN.
#[derive(Debug, Clone, PartialEq)]
pub struct Mvnx {
    /// Version of the format: `mvnx/@version`.
    pub version: String,
    /// Version of MVN: `mvn/@version`.
    pub software: String,
    /// Name of the system or the person: `subject/@label`.
    pub subject: String,
    /// Day and time of the recording in the words of the file: `subject/@recDate`.
    pub recorded_on: String,
    /// Which sensors were worn: `subject/@configuration`, such as `FullBody` and `LowerBody`.
    pub configuration: String,
    /// Frame rate [Hz].
    pub rate_hz: f64,
    /// The segments, in the order of the poses.
    pub segments: Vec<MvnxSegment>,
    /// The joints.
    pub joints: Vec<MvnxJoint>,
    /// Names of the contacts of the feet, in the order of the flags.
    pub contacts: Vec<String>,
    /// Poses of the calibration: kind (`identity`, `tpose`, `npose`, `tpose-isb` or `npose-isb`), and the pose of each
    /// segment.
    pub calibration: Vec<(String, Vec<MvnxPose>)>,
    /// The recorded frames.
    pub frames: Vec<MvnxFrame>,
}

/// A segment.
#[derive(Debug, Clone, PartialEq)]
pub struct MvnxSegment {
    /// Name: `RightUpperLeg`.
    pub label: String,
    /// Names and places of joints and landmarks, in the axes of the segment [m].
    pub points: Vec<(String, [f64; 3])>,
}

/// A joint.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MvnxJoint {
    /// Name: `jRightKnee`.
    pub label: String,
    /// The point on the parent: `RightUpperLeg/jRightKnee`.
    pub parent: String,
    /// The point on the child: `RightLowerLeg/jRightKnee`.
    pub child: String,
}

/// The pose of a segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MvnxPose {
    /// Unit quaternion w, x, y, z: global from segment.
    pub orientation: [f64; 4],
    /// Global position of the origin [m].
    pub position: [f64; 3],
}

/// A recorded frame.
#[derive(Debug, Clone, PartialEq)]
pub struct MvnxFrame {
    /// Number of the frame; its time is this divided by the frame rate.
    pub index: u64,
    /// One pose for each segment.
    pub poses: Vec<MvnxPose>,
    /// Whether each contact of the feet touches the ground; empty if the frame has no flags.
    pub contacts: Vec<bool>,
}

impl Mvnx {
    /// The place of a point in its segment [m].
    #[must_use]
    pub fn point(&self, segment: &str, point: &str) -> Option<[f64; 3]> {
        let points = &self.segments.iter().find(|known| known.label == segment)?.points;
        points.iter().find(|(label, _)| label == point).map(|(_, place)| *place)
    }
}
