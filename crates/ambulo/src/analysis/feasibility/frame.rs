//! Checks of one frame. Nothing is allocated here.
//!
//! Every check returns the share of the limit that is used; above 1 the frame is infeasible.

use super::person::Person;
use super::thresholds::Thresholds;
use super::verdict::Check;
use crate::ground::CENTER_OF_PRESSURE_LOAD_N;
use crate::kinematics::BodyMotion;
use crate::model::anatomy::Sole;
use crate::model::{BySide, CoordinateId, CoordinateKind, Drive, Model, Side};
use crate::numerics::elementary::{hypot, tan};
use crate::optimal::{Hill, StrengthCurve};
use crate::spatial::{Vec3, Wrench, level_distance};

/// A sole point lower than this above the ground [m] ...
pub(super) const NEAR_GROUND_M: f64 = 0.06;
/// ... and slower than this relative to it [m/s] may be in contact (AnyBody's prediction of ground forces uses 0.04 m
/// and 0.8 m/s for nodes of a fitted sole; ours are estimates).
const NEAR_GROUND_M_S: f64 = 0.8;
/// The lowest point of a loaded sole may be this far above or below its centre of pressure: thick shoes, errors of feet
/// and floor [m].
const OFF_GROUND_M: f64 = 0.1;
/// Largest error of the direction of a foot [rad], 30 degrees. A marker at the side of the forefoot instead of its
/// middle turns a foot by the angle of half the breadth to the length, about 15 degrees; the markers of heel and ankle
/// add to it.
const TURNED_RAD: f64 = 0.524;
/// In flight both feet together carry less than this share of body weight.
const FLIGHT_LOAD_BW: f64 = 0.05;

/// The limits of one model and one person, prepared for many frames.
#[derive(Debug, Clone)]
pub struct FeasibilityLimits {
    pub(super) thresholds: Thresholds,
    pub(super) person: Person,
    /// Upward unit vector.
    up: Vec3,
    /// Weight [N].
    pub(super) weight: f64,
    /// Mass of the body and of what it carries [kg].
    pub(super) mass: f64,
    coordinates: Vec<CoordinateLimits>,
}

/// Limits of one coordinate.
#[derive(Debug, Clone)]
struct CoordinateLimits {
    strength: Option<StrengthCurve>,
    /// Share of it that may be used.
    strength_share: f64,
    /// Range of motion with its slack [rad].
    range: Option<[f64; 2]>,
    is_judged: bool,
}

/// Motion and forces at one instant.
#[derive(Debug, Clone, Copy)]
pub struct Frame<'a> {
    /// Coordinates [rad or m], in the model's order.
    pub q: &'a [f64],
    /// Their rates.
    pub qd: &'a [f64],
    /// Generalised forces that the muscles must supply [N.m or N].
    pub generalized: &'a [f64],
    /// Powers [W].
    pub powers: &'a [f64],
    /// Motion of the bodies, in the model's order.
    pub bodies: &'a [BodyMotion],
    /// Ground force on each foot; `None` if unknown.
    pub feet: BySide<Option<FootFrame>>,
    /// Residual force [N] and residual moment about the root joint [N.m], world axes.
    pub residual: Wrench,
    /// Velocity of the ground [m/s]: the belt velocity on a treadmill.
    pub ground_velocity: Vec3,
    /// Height of the ground under each foot, above the world's origin [m].
    pub ground_height: BySide<f64>,
    /// Whether a foot should be on the ground at all times: the person walks.
    pub walking: bool,
}

/// Ground force on a foot at one instant.
#[derive(Debug, Clone, Copy)]
pub struct FootFrame {
    /// Force on the foot [N], world axes.
    pub force: Vec3,
    /// Centre of pressure [m]; NaN while unloaded.
    pub center_of_pressure: Vec3,
}

/// The part of the body that a check is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CheckedPart {
    /// A coordinate.
    Coordinate(CoordinateId),
    /// A foot.
    Foot(Side),
    /// The whole body.
    Body,
}

/// The value of a check in one frame and its limit, in the unit of the check.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CheckedValue {
    /// The check.
    pub check: Check,
    /// The part of the body.
    pub of: CheckedPart,
    /// The value.
    pub value: f64,
    /// The limit.
    pub limit: f64,
    /// Share of the limit that is used; infeasible above 1.
    pub share: f64,
}

impl FeasibilityLimits {
    /// Prepares the limits of a model and a person.
    #[must_use]
    pub fn new(model: &Model, person: &Person, thresholds: &Thresholds) -> FeasibilityLimits {
        let of_coordinate = |id: CoordinateId| coordinate_limits(model, id, person, thresholds);
        FeasibilityLimits {
            thresholds: thresholds.clone(),
            person: person.clone(),
            up: model.up(),
            weight: person.mass_kg * model.gravity().norm(),
            mass: model.mass(),
            coordinates: model.coordinate_ids().map(of_coordinate).collect(),
        }
    }

    /// Whether a coordinate is checked: a free rotation that does not belong to the root.
    #[must_use]
    pub(crate) fn covers(&self, id: CoordinateId) -> bool {
        self.coordinates[id.index()].is_judged
    }

    /// Whether the strength of a coordinate is known.
    #[must_use]
    pub(crate) fn has_strength(&self, id: CoordinateId) -> bool {
        self.coordinates[id.index()].strength.is_some()
    }

    /// The residual force [body weights].
    fn unsupported(&self, frame: &Frame<'_>) -> f64 {
        share(frame.residual.force.norm(), self.weight)
    }

    /// Upward force that the feet carry, and that the motion of the body needs [N].
    pub(super) fn upward_forces(&self, frame: &Frame<'_>) -> [f64; 2] {
        let carried: f64 = frame.feet.values().flatten().map(|foot| foot.force.dot(&self.up)).sum();
        [carried, carried + frame.residual.force.dot(&self.up)]
    }

    /// Whether the residual force is too large for a person.
    pub(super) fn lacks_support(&self, frame: &Frame<'_>) -> bool {
        let is_small = self.unsupported(frame) <= self.thresholds.support_bw;
        !is_small
    }

    /// Whether no ground force can be missing: support is sufficient, or no foot may be in contact outside the force
    /// plates.
    pub(super) fn support_is_known(&self, frame: &Frame<'_>) -> bool {
        frame.feet.values().all(Option::is_none)
            || !self.lacks_support(frame)
            || !Side::BOTH.into_iter().any(|side| self.may_be_on_unmeasured_ground(frame, side))
    }

    /// Whether the centre of pressure of a foot would be on its sole, with the usual margin, if the foot were turned
    /// about the heel by at most [`TURNED_RAD`]. A foot whose direction is wrong by a marker at its side has its centre
    /// of pressure there.
    pub(super) fn foot_reaches(&self, frame: &Frame<'_>, side: Side) -> bool {
        let (Some(sole), Some(foot)) = (&self.person.soles[side], &frame.feet[side]) else { return false };
        let points = sole.points.map(|p| frame.bodies[p.body.index()].pose.place(p.place));
        let level = |v: Vec3| v - self.up * v.dot(&self.up);
        let (length, place) = (level(points[2] - points[0]), foot.center_of_pressure);
        let from_heel = level(place - points[0]);
        let margin = sole.half_width + self.thresholds.sole_margin_m;
        let forward = from_heel.dot(&length) / length.norm().max(f64::MIN_POSITIVE);
        let sideways = (from_heel.norm_squared() - forward * forward).max(0.0).sqrt();
        let is_in_reach = from_heel.norm() <= length.norm() + margin;
        is_in_reach
            && sideways <= forward.max(0.0) * tan(TURNED_RAD) + margin
            && height_beyond(points, place, self.up) == 0.0
    }

    /// Whether a foot is unloaded, near the ground and slow: it may be in contact outside the force plates. A force
    /// that pulls down is measured.
    fn may_be_on_unmeasured_ground(&self, frame: &Frame<'_>, side: Side) -> bool {
        let carried = frame.feet[side].map_or(0.0, |foot| foot.force.dot(&self.up));
        if carried.abs() > CENTER_OF_PRESSURE_LOAD_N {
            return false;
        }
        let Some(sole) = &self.person.soles[side] else { return frame.feet[side].is_none() };
        sole.points.iter().any(|point| {
            let body = &frame.bodies[point.body.index()];
            let place = body.pose.place(point.place);
            let velocity = body.twist.velocity_at(place - body.center) - frame.ground_velocity;
            place.dot(&self.up) - frame.ground_height[side] < NEAR_GROUND_M && velocity.norm() < NEAR_GROUND_M_S
        })
    }
}

fn coordinate_limits(model: &Model, id: CoordinateId, person: &Person, t: &Thresholds) -> CoordinateLimits {
    let coordinate = &model.coordinates()[id.index()];
    let is_root = model.bodies().iter().any(|b| b.joint.parent.is_none() && b.joint.coordinates().contains(&id));
    let is_judged = coordinate.kind == CoordinateKind::Rotation && matches!(coordinate.drive, Drive::Free) && !is_root;
    let (mass, height) = (t.mass_kg.unwrap_or(person.mass_kg), t.height_m.unwrap_or(person.height_m));
    let meaning = model.anatomy().meaning(id);
    let stem = model.coordinate_stem(id);
    let given = t.tables.iter().find(|(name, _)| *name == coordinate.name || *name == stem);
    let given = given.map(|(_, table)| {
        let hill = meaning.map_or(Hill::UNKNOWN, |m| Hill::of_direction(m.movement, m.sign));
        StrengthCurve { hill: table.hill.or(Some(hill)), ..table.clone() }
    });
    let built_in = || {
        let meaning = meaning?;
        let curve = StrengthCurve::built_in(meaning.movement, mass, height)?;
        Some(if meaning.sign < 0.0 { curve.reversed() } else { curve })
    };
    let slack = t.range_slack_rad;
    let weak = t.weak.iter().find(|(name, _)| *name == coordinate.name);
    CoordinateLimits {
        strength_share: t.strength_share * weak.map_or(1.0, |(_, share)| *share),
        strength: given.or_else(built_in).filter(|_| is_judged),
        range: coordinate.range.map(|[low, high]| [low - slack, high + slack]).filter(|_| is_judged),
        is_judged,
    }
}

/// Checks one frame; `visit` receives every value with its limit, feasible or not. Allocates nothing.
///
/// Returns false if ground forces may be missing (a foot may be in contact outside the force plates): moments, powers,
/// flight, support and balance are then not checked.
///
/// # Panics
/// If a slice of the frame is shorter than the model.
pub fn check_frame(limits: &FeasibilityLimits, frame: &Frame<'_>, visit: impl FnMut(CheckedValue)) -> bool {
    let whole = limits.support_is_known(frame);
    check_known(limits, frame, whole, visit);
    whole
}

/// As [`check_frame`], with the knowledge whether all ground forces are known; the kinetics are checked only then.
pub(super) fn check_known(
    limits: &FeasibilityLimits,
    frame: &Frame<'_>,
    whole: bool,
    mut visit: impl FnMut(CheckedValue),
) {
    let t = &limits.thresholds;
    let mut visit = |m: CheckedValue| {
        if t.judges(m.check) {
            visit(m);
        }
    };
    let unsupported = limits.unsupported(frame);
    let ground_known = frame.feet.values().any(Option::is_some);
    for (index, coordinate) in limits.coordinates.iter().enumerate().filter(|(_, coordinate)| coordinate.is_judged) {
        check_coordinate(limits, frame, CoordinateId(index), coordinate, whole, &mut visit);
    }
    for side in Side::BOTH {
        if let Some(foot) = &frame.feet[side] {
            check_foot(limits, frame, side, foot, &mut visit);
        }
    }
    if whole && ground_known {
        let of = CheckedPart::Body;
        let mut add = |check: Check, value: f64, limit: f64| {
            visit(CheckedValue { check, of, value, limit, share: share(value, limit) });
        };
        add(Check::Support, unsupported, t.support_bw);
        add(Check::Balance, frame.residual.moment.norm() / limits.person.mass_kg, t.balance_nm_kg);
        let [carried, needed] = limits.upward_forces(frame);
        add(Check::Pull, (-needed).max(0.0) / limits.weight, t.pull_bw);
        let flies = frame.walking && carried < FLIGHT_LOAD_BW * limits.weight;
        let [value, share] = if flies { [f64::INFINITY; 2] } else { [0.0, 0.0] };
        visit(CheckedValue { check: Check::Flight, of, value, limit: t.flight_s, share });
    }
}

fn check_coordinate(
    limits: &FeasibilityLimits,
    frame: &Frame<'_>,
    id: CoordinateId,
    coordinate: &CoordinateLimits,
    whole: bool,
    visit: &mut impl FnMut(CheckedValue),
) {
    let (t, i, of) = (&limits.thresholds, id.index(), CheckedPart::Coordinate(id));
    if let Some([low, high]) = coordinate.range {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let bound = if frame.q[i] < middle { low } else { high };
        let share = share((frame.q[i] - middle).abs(), half);
        let [value, limit] = [frame.q[i], bound].map(f64::to_degrees);
        visit(CheckedValue { check: Check::Range, of, value, limit, share });
    }
    if !whole {
        return;
    }
    if let Some(strength) = &coordinate.strength {
        let moment = frame.generalized[i];
        let available = strength.available(frame.q[i], frame.qd[i], moment, t.eccentric);
        let allowed = coordinate.strength_share * available + t.strength_tolerance_nm_kg * limits.person.mass_kg;
        let share = share(moment.abs(), allowed);
        visit(CheckedValue { check: Check::Strength, of, value: moment, limit: allowed.copysign(moment), share });
    }
    let power = frame.powers[i] / limits.person.mass_kg;
    let allowed = if power >= 0.0 { t.generation_w_kg } else { t.absorption_w_kg };
    let share = share(power.abs(), allowed);
    visit(CheckedValue { check: Check::Power, of, value: power, limit: allowed.copysign(power), share });
}

/// The load above which a foot is checked [N]: a share of the weight, and at least the load that defines a centre of
/// pressure.
#[must_use]
pub fn least_load_n(load_bw: f64, weight_n: f64) -> f64 {
    (load_bw * weight_n).max(CENTER_OF_PRESSURE_LOAD_N)
}

fn check_foot(
    limits: &FeasibilityLimits,
    frame: &Frame<'_>,
    side: Side,
    foot: &FootFrame,
    visit: &mut impl FnMut(CheckedValue),
) {
    let (t, up, of) = (&limits.thresholds, limits.up, CheckedPart::Foot(side));
    let normal = foot.force.dot(&up);
    let carries = |load_bw: f64| normal > least_load_n(load_bw, limits.weight);
    let mut add = |check: Check, value: f64, limit: f64| {
        visit(CheckedValue { check, of, value, limit, share: share(value, limit) });
    };
    if carries(t.friction_load_bw) {
        add(Check::Friction, (foot.force - up * normal).norm() / normal, t.friction);
    }
    let Some(sole) = &limits.person.soles[side] else { return };
    if carries(t.sole_load_bw) {
        add(Check::CenterOfPressure, distance_to_sole(limits, frame, sole, foot.center_of_pressure), t.sole_margin_m);
    }
    if carries(t.sliding_load_bw) {
        add(Check::Sliding, slip(limits, frame, sole, foot.center_of_pressure), t.sliding_m_s);
    }
}

/// Value over limit; a limit of zero allows only zero.
fn share(value: f64, limit: f64) -> f64 {
    if limit > 0.0 {
        value / limit
    } else if value > 0.0 {
        f64::INFINITY
    } else {
        0.0
    }
}

/// Distance of a point from the sole [m]: along the ground from its edge, and in height beyond [`OFF_GROUND_M`] from
/// its lowest point.
fn distance_to_sole(limits: &FeasibilityLimits, frame: &Frame<'_>, sole: &Sole, place: Vec3) -> f64 {
    let points = sole.points.map(|p| frame.bodies[p.body.index()].pose.place(p.place));
    let [rear, ball, tip] = points;
    let to_part = |part: [Vec3; 2]| level_distance(place, part, limits.up);
    let outside = to_part([rear, ball]).min(to_part([ball, tip])) - sole.half_width;
    hypot(outside.max(0.0), height_beyond(points, place, limits.up))
}

/// Distance in height of the lowest point of a sole from a place, beyond [`OFF_GROUND_M`] [m].
fn height_beyond(points: [Vec3; 3], place: Vec3, up: Vec3) -> f64 {
    let lowest = points.iter().map(|point| (point - place).dot(&up)).fold(f64::INFINITY, f64::min);
    (lowest.abs() - OFF_GROUND_M).max(0.0)
}

/// Horizontal speed of the foot's material at a point relative to the ground [m/s]: of the toes if the tip is nearest,
/// else of the foot.
fn slip(limits: &FeasibilityLimits, frame: &Frame<'_>, sole: &Sole, place: Vec3) -> f64 {
    let distance = |k: usize| {
        let point = &sole.points[k];
        (frame.bodies[point.body.index()].pose.place(point.place) - place).norm()
    };
    let nearest = if distance(2) < distance(1) { 2 } else { 0 };
    let body = &frame.bodies[sole.points[nearest].body.index()];
    let velocity = body.twist.velocity_at(place - body.center) - frame.ground_velocity;
    (velocity - limits.up * velocity.dot(&limits.up)).norm()
}
