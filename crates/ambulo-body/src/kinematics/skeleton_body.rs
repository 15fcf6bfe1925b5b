//! The built-in body with the segment lengths of recorded joint centres.
//!
//! In a segment scaled by f, the mass centre and the radii of gyration are scaled by f; masses come from the table.
//! The joint centres, and points next to them that show the orientation of the segments, become markers of the body.
//! Their names are listed in [`crate::motion::skeleton`].
//!
//! Not handled: shoulders that move relative to the trunk, hands.
//! Pinned by: tests/retarget.rs, tests/segment_poses.rs

use super::marker_fit::FitError;
use crate::findings::{Code, Findings};
use crate::model::anthropometry::{BuildError, Dimensions, Human};
use crate::model::subject_shape::{SegmentShape, SolePlacement, SubjectShape, reshaped};
use crate::model::{BodyId, Marker, Side};
use crate::motion::skeleton::POINT_DISTANCE_M;
use crate::motion::{MarkerPath, MarkerRecording};
use crate::numerics::{median, quantiles};
use crate::spatial::{Mat3, Pose, Vec3};

/// Quantile of the ankle height that corresponds to a flat foot: stance is 60 % of a cycle, and the foot is flat, with
/// the lowest ankle, in about half of it.
pub const STANDING: f64 = 0.1;
/// Relative difference of a segment length from the table above which it is reported.
const REPORTED: f64 = 0.15;

/// Why recorded joint centres give no body, or no motion of it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum JointCentreError {
    /// The body cannot be built.
    #[error(transparent)]
    Body(#[from] BuildError),
    /// Two joint centres that are never recorded together.
    #[error("`{a}` and `{b}` are seen together in no frame of the skeleton's motion; expected at least one")]
    Unseen {
        /// The first point.
        a: String,
        /// The second point.
        b: String,
    },
    /// The marker fit failed.
    #[error(transparent)]
    Fit(#[from] FitError),
}

/// The body of a table with the lengths of recorded joint centres, and with these feet; `unusual` is the code for
/// lengths that differ much from the table.
pub(super) fn body_of_joint_centres(
    table: &Human,
    markers: &MarkerRecording,
    feet: [SolePlacement; 2],
    (unusual, findings): (Code, &mut Findings),
) -> Result<Human, JointCentreError> {
    let measured = Measured { markers };
    let lengths = Lengths::measure(&measured, table)?;
    lengths.report_differences(table, unusual, findings);
    Ok(lengths.body(&measured, table, feet)?)
}

/// Height of the ankles of these sides in standing [m]: the [`STANDING`] quantile; not a number if none was recorded.
pub(super) fn standing_ankle_height(markers: &MarkerRecording, sides: &[Side]) -> f64 {
    let measured = Measured { markers };
    let paths = sides.iter().filter_map(|side| measured.path(&sided("ankle", *side)));
    quantiles(paths.flatten().map(|place| place.y), [STANDING]).map_or(f64::NAN, |[height]| height)
}

/// Median distance of two joint centres of a side [m]; `None` if they are never recorded together.
pub(super) fn measured_distance(markers: &MarkerRecording, [a, b]: [&str; 2], side: Side) -> Option<f64> {
    Measured { markers }.distance(&sided(a, side), &sided(b, side))
}

/// Lengths measured in the recording.
struct Measured<'m> {
    markers: &'m MarkerRecording,
}

impl Measured<'_> {
    fn path(&self, name: &str) -> Option<&[Vec3]> {
        self.markers.marker(name).map(|MarkerPath { positions, .. }| positions.as_slice())
    }

    /// Median distance of two points [m]; `None` if one is missing or they are never recorded together.
    fn distance(&self, a: &str, b: &str) -> Option<f64> {
        let pairs = self.path(a)?.iter().zip(self.path(b)?);
        median(pairs.map(|(a, b)| (a - b).norm()))
    }

    fn needed(&self, a: &str, b: &str) -> Result<f64, JointCentreError> {
        let unseen = || JointCentreError::Unseen { a: a.to_owned(), b: b.to_owned() };
        self.distance(a, b).filter(|distance| *distance > 0.0).ok_or_else(unseen)
    }

    /// Median distance between the middles of two pairs of points [m].
    fn between_middles(&self, a: &str, b: &str) -> Option<f64> {
        let [ar, al, br, bl] = [(a, Side::Right), (a, Side::Left), (b, Side::Right), (b, Side::Left)]
            .map(|(n, s)| self.path(&sided(n, s)));
        let lists = ar?.iter().zip(al?).zip(br?.iter().zip(bl?));
        median(lists.map(|((ar, al), (br, bl))| ((ar + al) - (br + bl)).norm() / 2.0))
    }

    /// Median position of a point in the axes of the foot: forward, up, right of the ankle [m].
    fn in_foot(&self, point: &str, side: Side) -> Option<Vec3> {
        let ways = |name: &str| {
            let ankle = self.path(&sided("ankle", side))?;
            Some(self.path(&sided(name, side))?.iter().zip(ankle).map(|(p, ankle)| p - ankle).collect::<Vec<Vec3>>())
        };
        let (front, right, way) = (ways("foot_front")?, ways("foot_side")?, ways(point)?);
        let local = |frame: usize| {
            let (x, z) = (front[frame] / POINT_DISTANCE_M, right[frame] / POINT_DISTANCE_M);
            Mat3::from_columns(&[x, z.cross(&x), z]).transpose() * way[frame]
        };
        let places: Vec<Vec3> = (0..way.len()).map(local).collect();
        let component = |axis: usize| median(places.iter().map(|place| place[axis]));
        Some(Vec3::new(component(0)?, component(1)?, component(2)?))
    }
}

fn sided(name: &str, side: Side) -> String {
    format!("{name}_{}", side.letter())
}

/// Segment lengths of a skeleton, right and left [m]; missing ones are from the table.
struct Lengths {
    hip_width: f64,
    shoulder_height: f64,
    shoulder_width: f64,
    thigh: [f64; 2],
    shank: [f64; 2],
    upper_arm: [f64; 2],
    forearm: [f64; 2],
}

impl Lengths {
    fn measure(measured: &Measured<'_>, table: &Human) -> Result<Lengths, JointCentreError> {
        let d = &table.dimensions;
        let both = |a: &str, b: &str| -> Result<[f64; 2], JointCentreError> {
            let [right, left] = Side::BOTH.map(|side| measured.needed(&sided(a, side), &sided(b, side)));
            Ok([right?, left?])
        };
        let either = |a: &str, b: &str, other: f64| {
            Side::BOTH
                .map(|side| measured.distance(&sided(a, side), &sided(b, side)).filter(|l| *l > 0.0).unwrap_or(other))
        };
        let or = |length: Option<f64>, other: f64| length.filter(|length| *length > 0.0).unwrap_or(other);
        Ok(Lengths {
            hip_width: measured.needed("hip_r", "hip_l")?,
            shoulder_height: or(measured.between_middles("hip", "shoulder"), d.shoulder_height),
            shoulder_width: or(measured.distance("shoulder_r", "shoulder_l"), d.shoulder_width),
            thigh: both("hip", "knee")?,
            shank: both("knee", "ankle")?,
            upper_arm: either("shoulder", "elbow", d.upper_arm),
            forearm: either("elbow", "wrist", d.forearm),
        })
    }

    /// Reports lengths that differ from the table.
    fn report_differences(&self, table: &Human, code: Code, findings: &mut Findings) {
        let d = &table.dimensions;
        let mean = |pair: [f64; 2]| (pair[0] + pair[1]) / 2.0;
        let rows = [
            ("hip width", self.hip_width, d.hip_width),
            ("hips to shoulders", self.shoulder_height, d.shoulder_height),
            ("shoulder width", self.shoulder_width, d.shoulder_width),
            ("thigh", mean(self.thigh), d.thigh),
            ("shank", mean(self.shank), d.shank),
            ("upper arm", mean(self.upper_arm), d.upper_arm),
            ("forearm", mean(self.forearm), d.forearm),
        ];
        let unlike: Vec<String> = rows
            .iter()
            .filter(|(_, found, usual)| (found / usual - 1.0).abs() > REPORTED)
            .map(|(name, found, usual)| format!("{name} {found:.3} m instead of {usual:.3} m"))
            .collect();
        if !unlike.is_empty() {
            findings.report(
                code,
                format!("segment lengths of the skeleton differ from a typical body: {}", unlike.join(", ")),
            );
        }
    }

    /// The dimensions of the table with these lengths, as the mean of both sides.
    fn dimensions(&self, table: Dimensions, feet: [SolePlacement; 2]) -> Dimensions {
        let ankle_height = (feet[0].ankle_height + feet[1].ankle_height) / 2.0;
        let [thigh, shank, upper_arm, forearm] =
            [self.thigh, self.shank, self.upper_arm, self.forearm].map(|pair| (pair[0] + pair[1]) / 2.0);
        Dimensions {
            leg_length: thigh + shank + ankle_height,
            ankle_height,
            thigh,
            shank,
            hip_width: self.hip_width,
            shoulder_width: self.shoulder_width,
            shoulder_height: self.shoulder_height,
            lumbar_height: table.lumbar_height.map(|lumbar| lumbar * self.shoulder_height / table.shoulder_height),
            upper_arm,
            forearm,
            ..table
        }
    }

    /// The body of the table with these lengths.
    fn body(&self, measured: &Measured<'_>, table: &Human, feet: [SolePlacement; 2]) -> Result<Human, BuildError> {
        let mut fitting = Fitting { table, shapes: SegmentShape::of(table), markers: Vec::new() };
        fitting.trunk(self);
        for (k, side) in Side::BOTH.into_iter().enumerate() {
            fitting.leg(self, side, k);
            fitting.foot(measured, side, feet[k].ankle_height);
            fitting.arm(self, side, k);
        }
        let Fitting { shapes, markers, .. } = fitting;
        let dimensions = self.dimensions(table.dimensions, feet);
        reshaped(table, &SubjectShape { segments: shapes, markers, feet, dimensions, locked: Vec::new() })
    }
}

/// A body under construction: segment shapes and markers.
struct Fitting<'t> {
    table: &'t Human,
    shapes: Vec<SegmentShape>,
    markers: Vec<Marker>,
}

impl Fitting<'_> {
    fn body(&self, name: &str) -> Option<BodyId> {
        self.table.model.body(name)
    }

    /// Scales a segment and places its joint in the parent.
    fn shape(&mut self, name: &str, factor: f64, place: Vec3) {
        if let Some(body) = self.body(name) {
            let shape = &mut self.shapes[body.index()];
            shape.factor = factor;
            shape.parent_from_joint = Pose::at(place);
        }
    }

    fn marker(&mut self, name: String, body: &str, location: Vec3) {
        let body = self.body(body);
        self.markers.push(Marker { name, body, location, fixed: false });
    }

    fn trunk(&mut self, lengths: &Lengths) {
        let d = &self.table.dimensions;
        let factor = lengths.shoulder_height / d.shoulder_height;
        let lumbar = d.lumbar_height.unwrap_or(0.0) * factor;
        let root = self.table.model.bodies()[0].name.clone();
        self.shape(&root, factor, Vec3::zeros());
        if d.lumbar_height.is_some() {
            self.shape("torso", factor, Vec3::y() * lumbar);
        }
        self.marker("pelvis_up".to_owned(), &root, Vec3::y() * POINT_DISTANCE_M);
        self.marker("pelvis_front".to_owned(), &root, Vec3::x() * POINT_DISTANCE_M);
        for side in Side::BOTH {
            self.marker(sided("hip", side), &root, outward(side, lengths.hip_width / 2.0));
            let shoulder = outward(side, lengths.shoulder_width / 2.0) + Vec3::y() * (lengths.shoulder_height - lumbar);
            self.marker(sided("shoulder", side), "torso", shoulder);
        }
    }

    fn leg(&mut self, lengths: &Lengths, side: Side, k: usize) {
        let d = &self.table.dimensions;
        let (thigh, shank) = (lengths.thigh[k], lengths.shank[k]);
        let [femur, tibia, calcn] = ["femur", "tibia", "calcn"].map(|name| sided(name, side));
        let (knee, ankle) = (-Vec3::y() * thigh, -Vec3::y() * shank);
        self.shape(&femur, thigh / d.thigh, outward(side, lengths.hip_width / 2.0));
        self.shape(&tibia, shank / d.shank, knee);
        self.shape(&calcn, 1.0, ankle);
        self.marker(sided("knee", side), &femur, knee);
        self.marker(sided("thigh_side", side), &femur, knee + Vec3::z() * POINT_DISTANCE_M);
        self.marker(sided("ankle", side), &tibia, ankle);
        self.marker(sided("shank_side", side), &tibia, ankle + Vec3::z() * POINT_DISTANCE_M);
    }

    fn foot(&mut self, measured: &Measured<'_>, side: Side, ankle_height: f64) {
        let d = &self.table.dimensions;
        let [calcn, toes] = ["calcn", "toes"].map(|name| sided(name, side));
        self.marker(sided("foot_front", side), &calcn, Vec3::x() * POINT_DISTANCE_M);
        self.marker(sided("foot_side", side), &calcn, Vec3::z() * POINT_DISTANCE_M);
        if let Some(heel) = measured.in_foot("heel", side) {
            self.marker(sided("heel", side), &calcn, heel);
        }
        let tip = measured.in_foot("toe_tip", side);
        let Some(toe) = measured.in_foot("toe", side).filter(|toe| toe.x > 0.0) else {
            if let Some(tip) = tip {
                self.marker(sided("toe_tip", side), &calcn, tip);
            }
            return;
        };
        // The ball of the foot keeps the height above the sole.
        let factor = toe.x / d.ankle_to_ball;
        let joint = Vec3::new(toe.x, d.ball_radius * factor - ankle_height, 0.0);
        if let Some(calcn) = self.body(&calcn) {
            self.shapes[calcn.index()].factor = factor;
        }
        self.marker(sided("toe", side), &calcn, toe);
        let length = measured.distance(&sided("toe", side), &sided("toe_tip", side)).unwrap_or(0.0);
        self.shape(&toes, if length > 0.0 { length / d.ball_to_toe } else { factor }, joint);
        self.marker(sided("toe_front", side), &toes, toe - joint + Vec3::x() * POINT_DISTANCE_M);
    }

    fn arm(&mut self, lengths: &Lengths, side: Side, k: usize) {
        let d = &self.table.dimensions;
        let (upper_arm, forearm) = (lengths.upper_arm[k], lengths.forearm[k]);
        let lumbar = d.lumbar_height.unwrap_or(0.0) * lengths.shoulder_height / d.shoulder_height;
        let shoulder = outward(side, lengths.shoulder_width / 2.0) + Vec3::y() * (lengths.shoulder_height - lumbar);
        let elbow = -Vec3::y() * upper_arm;
        let [humerus, lower] = ["humerus", "forearm"].map(|name| sided(name, side));
        self.shape(&humerus, upper_arm / d.upper_arm, shoulder);
        self.shape(&lower, forearm / d.forearm, elbow);
        self.marker(sided("elbow", side), &humerus, elbow);
        self.marker(sided("wrist", side), &lower, -Vec3::y() * forearm);
    }
}

/// A lateral distance with the sign of the side [m].
fn outward(side: Side, distance: f64) -> Vec3 {
    match side {
        Side::Right => Vec3::z() * distance,
        Side::Left => Vec3::z() * -distance,
    }
}
