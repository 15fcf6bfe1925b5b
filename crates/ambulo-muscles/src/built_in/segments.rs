//! Frames of the segments of a leg in a model, from its joint centres in the neutral posture.

use super::BuiltInError;
use super::table::{Joint, Reference, Segment};
use ambulo_body::model::anatomy::{NeutralPosture, PelvicFrame};
use ambulo_body::model::full_body::STANDING_TILT;
use ambulo_body::model::marker_set::{Landmark, MarkerSet};
use ambulo_body::model::{
    BodyId, CoordinateId, Displacement, Function, Knots, Model, Movement, Side, SimmSpline, anatomy,
};
use ambulo_body::numerics::elementary::atan2;
use ambulo_body::spatial::{Mat3, Pose, Vec3, rotation_about};

/// Shortest segment that has a direction [m].
const SHORTEST: f64 = 0.02;

/// The frame of a segment.
#[derive(Debug, Clone, Copy)]
pub(super) struct SegmentFrame {
    /// The body that it is fixed to.
    pub(super) body: BodyId,
    /// Axes and origin of the segment in the body.
    pub(super) body_from_segment: Pose,
    /// Size of the segment over that of the reference.
    pub(super) scale: f64,
    /// The axes in the world, in the neutral posture.
    axes: Mat3,
    /// The origin in the neutral posture, with the lengths of the person and of the reference, from the hip [m].
    origins: [Vec3; 2],
}

impl SegmentFrame {
    /// A place of the reference in the body [m].
    pub(super) fn place(&self, place: Vec3) -> Vec3 {
        self.body_from_segment.place(place * self.scale)
    }
}

/// The angle of hip or knee between the axes of two segments, as the table has it: flexion of the hip and extension of
/// the knee are positive.
#[derive(Debug, Clone, Copy)]
pub(super) struct JointAngle {
    /// The coordinate.
    pub(super) coordinate: CoordinateId,
    /// The angle in the neutral posture [rad].
    pub(super) neutral: f64,
    /// +1 if the angle increases with the coordinate, otherwise -1.
    sign: f64,
}

impl JointAngle {
    fn of_angle(&self, angle: f64) -> f64 {
        self.sign * (angle - self.neutral)
    }

    /// The range of the coordinate for a range of the angle [rad].
    pub(super) fn range(&self, range: [f64; 2]) -> [f64; 2] {
        let [a, b] = range.map(|angle| self.of_angle(angle));
        [a.min(b), a.max(b)]
    }

    /// A spline of the angle, times a factor, as a function of the coordinate.
    pub(super) fn function(&self, spline: &SimmSpline, factor: f64) -> Function {
        let mut x: Vec<f64> = spline.knots().x().iter().map(|angle| self.of_angle(*angle)).collect();
        let mut y: Vec<f64> = spline.knots().y().iter().map(|y| factor * y).collect();
        if self.sign < 0.0 {
            x.reverse();
            y.reverse();
        }
        let middle = factor * spline.at(self.neutral)[0];
        Knots::new(x, y).and_then(SimmSpline::new).map_or(Function::Constant(middle), Function::SimmSpline)
    }
}

/// A leg with the frames of its segments.
#[derive(Debug, Clone)]
pub(super) struct Leg {
    pub(super) side: Side,
    /// Mean of thigh + shank of both legs over that of the reference.
    pub(super) size: f64,
    frames: [SegmentFrame; Segment::COUNT],
    hip: JointAngle,
    knee: JointAngle,
}

impl Leg {
    /// Both legs of a model, the right one first.
    pub(super) fn both(model: &Model, reference: &Reference) -> Result<[Leg; 2], BuiltInError> {
        let no_legs = || BuiltInError::NoLegs { model: model.name().to_owned() };
        let posture = model.anatomy().neutral().ok_or_else(no_legs)?;
        let found = model.anatomy().legs().both().ok_or_else(no_legs)?;
        let [right, left] = Side::BOTH.map(|side| Centres::find(model, posture, &found[side], side));
        let (right, left) = (right?, left?);
        let size = 0.5 * (right.length() + left.length()) / (reference.thigh_m + reference.shank_m);
        let pelvis = Pelvis::find(model, reference, size).ok_or_else(no_legs)?;
        let [right, left] = [right, left].map(|centres| centres.leg(model, posture, reference, (size, &pelvis)));
        Ok([right?, left?])
    }

    /// The frame of a segment.
    pub(super) fn frame(&self, segment: Segment) -> &SegmentFrame {
        &self.frames[segment as usize]
    }

    /// The angle of a joint.
    pub(super) fn angle(&self, joint: Joint) -> &JointAngle {
        match joint {
            Joint::Hip => &self.hip,
            Joint::Knee => &self.knee,
        }
    }

    /// A place of the right leg, mirrored for the left one.
    pub(super) fn own_side(&self, place: Vec3) -> Vec3 {
        mirrored(self.side, place)
    }

    /// A place of a segment in the neutral posture, from the hip [m], with the sizes of the person or of the reference.
    pub(super) fn neutral_place(&self, segment: Segment, place: Vec3, is_own: bool) -> Vec3 {
        let frame = self.frame(segment);
        let (origin, scale) = if is_own { (frame.origins[0], frame.scale) } else { (frame.origins[1], 1.0) };
        origin + frame.axes * (place * scale)
    }
}

fn mirrored(side: Side, place: Vec3) -> Vec3 {
    match side {
        Side::Right => place,
        Side::Left => Vec3::new(place.x, place.y, -place.z),
    }
}

/// The pelvis of the reference in a model.
struct Pelvis {
    body: BodyId,
    /// The axes of the reference in the body.
    axes: Mat3,
    /// Size over that of the reference.
    scale: f64,
}

impl Pelvis {
    /// Where the model has markers on the iliac spines, the pelvis has their distance, and the line through them has
    /// the direction that it has on the reference. Otherwise both pelves stand upright and have sizes as the legs.
    fn find(model: &Model, reference: &Reference, of_legs: f64) -> Option<Pelvis> {
        let tilted = |frame: PelvicFrame, tilt: f64, scale: f64| Pelvis {
            body: frame.pelvis,
            axes: frame.axes * rotation_about(Vec3::z(), tilt),
            scale,
        };
        if let (Ok(frame), Some(distance)) = (PelvicFrame::of_model(model), spine_distance(model)) {
            return Some(tilted(frame, reference.spines_rad, distance / reference.spines_m));
        }
        Some(tilted(PelvicFrame::of_built_in(model).ok()?, STANDING_TILT, of_legs))
    }
}

/// Distance between the markers of the anterior iliac spines [m].
fn spine_distance(model: &Model) -> Option<f64> {
    let names = model.markers().iter().map(|marker| marker.name.as_str());
    let known = MarkerSet::recognise(names).ok()?;
    let place = |side: Side| {
        let name = known.on(Landmark::Asis, Some(side))?;
        Some(model.markers().iter().find(|marker| marker.name == name)?.location)
    };
    let distance = (place(Side::Right)? - place(Side::Left)?).norm();
    (distance > SHORTEST).then_some(distance)
}

/// The joint centres of a leg in the neutral posture.
struct Centres<'a> {
    leg: &'a anatomy::Leg,
    side: Side,
    hip: Vec3,
    knee: Vec3,
    ankle: Vec3,
    /// Axis of the knee in the world, to the right.
    knee_axis: Vec3,
}

impl<'a> Centres<'a> {
    fn find(
        model: &Model,
        posture: &NeutralPosture,
        leg: &'a anatomy::Leg,
        side: Side,
    ) -> Result<Centres<'a>, BuiltInError> {
        let center = |body: BodyId| {
            posture.poses[body.index()].place(model.bodies()[body.index()].joint.child_from_joint.translation)
        };
        let not_a_hinge = || BuiltInError::Knee { model: model.name().to_owned(), side };
        let knee_axis = hinge_axis(model, posture, leg.knee).ok_or_else(not_a_hinge)?;
        Ok(Centres { leg, side, hip: center(leg.hip), knee: center(leg.knee), ankle: center(leg.ankle), knee_axis })
    }

    /// Thigh and shank together [m].
    fn length(&self) -> f64 {
        (self.hip - self.knee).norm() + (self.knee - self.ankle).norm()
    }

    fn leg(
        &self,
        model: &Model,
        posture: &NeutralPosture,
        reference: &Reference,
        (size, pelvis): (f64, &Pelvis),
    ) -> Result<Leg, BuiltInError> {
        let Centres { leg, side, hip, knee, ankle, knee_axis } = *self;
        let rotation = |body: BodyId| posture.poses[body.index()].rotation;
        let too_short = |segment| BuiltInError::Length { model: model.name().to_owned(), side, segment };
        let pelvic = rotation(pelvis.body) * pelvis.axes;
        let knee_axis = knee_axis * knee_axis.dot(&pelvic.column(2)).signum();
        let thigh = along(hip - knee, knee_axis).ok_or_else(|| too_short("thigh"))?;
        let shank = along(knee - ankle, knee_axis).ok_or_else(|| too_short("shank"))?;
        let [ahead, up] = leg.foot_axes();
        let foot = rotation(leg.foot) * Mat3::from_columns(&[ahead, up, ahead.cross(&up)]);
        let scales = [(hip - knee).norm() / reference.thigh_m, (knee - ankle).norm() / reference.shank_m];
        let reference_knee = thigh * Vec3::y() * -reference.thigh_m;
        let reference_ankle = reference_knee + shank * Vec3::y() * -reference.shank_m;
        let ball = foot * mirrored(side, reference.ball);
        // The joint of the toes lies on the middle line of a built-in foot, to whose side the ball is not measured.
        let lateral = foot.column(2) * (ball.dot(&foot.column(2)) * size);
        let on_middle = |toes: Vec3| toes - foot.column(2) * (toes - ankle).dot(&foot.column(2)) + lateral;
        let own_ball = toe_joint(model, posture, leg).map_or(ankle + ball * size, on_middle);
        let frame = |body: BodyId, axes: Mat3, scale: f64, [own, of_reference]: [Vec3; 2]| SegmentFrame {
            body,
            body_from_segment: posture.poses[body.index()].inverse() * Pose { rotation: axes, translation: own },
            scale,
            axes,
            origins: [own - hip, of_reference],
        };
        let frames = [
            frame(pelvis.body, pelvic, pelvis.scale, [hip, Vec3::zeros()]),
            frame(leg.thigh, thigh, scales[0], [hip, Vec3::zeros()]),
            frame(leg.shank, shank, scales[1], [knee, reference_knee]),
            frame(leg.foot, foot, size, [ankle, reference_ankle]),
            frame(leg.toes.unwrap_or(leg.foot), foot, size, [own_ball, reference_ankle + ball]),
        ];
        let angle = |movement, words, sign: f64, [upper, lower]: [Mat3; 2]| -> Result<JointAngle, BuiltInError> {
            let missing = || BuiltInError::NoCoordinate { model: model.name().to_owned(), side, movement: words };
            let (coordinate, own) = model.anatomy().coordinate(movement, Some(side)).ok_or_else(missing)?;
            let between = upper.transpose() * lower;
            Ok(JointAngle { coordinate, neutral: atan2(between.m21, between.m11), sign: sign * own })
        };
        Ok(Leg {
            side,
            size,
            frames,
            hip: angle(Movement::HipFlexion, "flexion of the hip", 1.0, [pelvic, thigh])?,
            knee: angle(Movement::KneeFlexion, "flexion of the knee", -1.0, [thigh, shank])?,
        })
    }
}

/// The centre of the joint of the toes [m].
fn toe_joint(model: &Model, posture: &NeutralPosture, leg: &anatomy::Leg) -> Option<Vec3> {
    let toes = leg.toes?;
    Some(posture.poses[toes.index()].place(model.bodies()[toes.index()].joint.child_from_joint.translation))
}

/// Axes with y along a segment and z as near as possible to an axis.
fn along(segment: Vec3, axis: Vec3) -> Option<Mat3> {
    let y = segment.try_normalize(SHORTEST)?;
    let z = (axis - y * axis.dot(&y)).try_normalize(f64::EPSILON)?;
    Some(Mat3::from_columns(&[y.cross(&z), y, z]))
}

/// The axis of a hinge in the world; `None` if the joint has another number of moving axes, or slides.
fn hinge_axis(model: &Model, posture: &NeutralPosture, body: BodyId) -> Option<Vec3> {
    let joint = &model.bodies()[body.index()].joint;
    let moves = |displacement: &Displacement| matches!(displacement, Displacement::Follows(..));
    if joint.translations.iter().any(|axis| moves(&axis.displacement)) {
        return None;
    }
    let mut turning = joint.rotations.iter().filter(|axis| moves(&axis.displacement));
    let (axis, None) = (turning.next()?, turning.next()) else { return None };
    let parent = joint.parent.map_or(Mat3::identity(), |parent| posture.poses[parent.index()].rotation);
    Some(parent * joint.parent_from_joint.rotation * axis.direction)
}
