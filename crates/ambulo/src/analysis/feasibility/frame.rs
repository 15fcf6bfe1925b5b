//! One instant against its limits. Nothing is allocated here.
//!
//! Every check yields the share of what is allowed; above one the instant is infeasible.

use super::person::Person;
use super::strength::{Hill, StrengthCurve};
use super::thresholds::Thresholds;
use super::verdict::Check;
use crate::ground::CENTER_OF_PRESSURE_LOAD_N;
use crate::kinematics::BodyMotion;
use crate::model::anatomy::Sole;
use crate::model::{BySide, CoordinateId, CoordinateKind, Drive, Model, Side};
use crate::spatial::{Vec3, Wrench};

/// A sole below this height above the ground [m] ...
const NEAR_GROUND_M: f64 = 0.06;
/// ... and slower than this against it [m/s] may stand on it (AnyBody's prediction of ground forces takes 0.04 m and 0.8
/// m/s for nodes of a fitted sole; ours is an estimate).
const NEAR_GROUND_M_S: f64 = 0.8;
/// Both feet together carry less than this share of body weight in flight.
const FLIGHT_LOAD_BW: f64 = 0.05;

/// Everything about a person and a model that stays the same from frame to frame.
#[derive(Debug, Clone)]
pub struct Judge {
    pub(super) thresholds: Thresholds,
    pub(super) person: Person,
    /// Upward unit vector.
    up: Vec3,
    /// Weight [N].
    weight: f64,
    coordinates: Vec<Limits>,
}

/// Limits of one coordinate.
#[derive(Debug, Clone)]
struct Limits {
    strength: Option<StrengthCurve>,
    /// With slack [rad].
    range: Option<[f64; 2]>,
    is_judged: bool,
}

/// One instant.
#[derive(Debug, Clone, Copy)]
pub struct Frame<'a> {
    /// Coordinates [rad or m], in the model's order.
    pub q: &'a [f64],
    /// Their rates.
    pub qd: &'a [f64],
    /// Generalised forces that the body must give [N.m or N].
    pub generalized: &'a [f64],
    /// Powers [W].
    pub powers: &'a [f64],
    /// Bodies, in the model's order.
    pub bodies: &'a [BodyMotion],
    /// What the ground does to each foot; `None` where it is not known.
    pub feet: BySide<Option<FootFrame>>,
    /// What motion and loads disagree by: force [N] and moment about the root joint [N.m], world axes.
    pub residual: Wrench,
    /// Velocity of the ground [m/s]: the belt's on a treadmill.
    pub ground_velocity: Vec3,
    /// Height of the ground above the world's origin [m].
    pub ground_height: f64,
    /// Whether the body walks: runners may fly.
    pub walking: bool,
}

/// What the ground does to a foot.
#[derive(Debug, Clone, Copy)]
pub struct FootFrame {
    /// Force on the foot [N], world axes.
    pub force: Vec3,
    /// Centre of pressure [m]; not a number while unloaded.
    pub center_of_pressure: Vec3,
}

/// What a measurement belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measured {
    /// A coordinate.
    Coordinate(CoordinateId),
    /// A foot.
    Foot(Side),
    /// The whole body.
    Body,
}

/// A value and what is allowed, in the unit of the check.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measurement {
    /// Which check.
    pub check: Check,
    /// What was measured.
    pub of: Measured,
    /// What was found.
    pub value: f64,
    /// What is allowed.
    pub limit: f64,
    /// Share of the allowed that is used: above one is infeasible.
    pub share: f64,
}

impl Judge {
    /// Prepares the limits of a model and a person.
    #[must_use]
    pub fn new(model: &Model, person: &Person, thresholds: &Thresholds) -> Judge {
        let limits = |id: CoordinateId| limits(model, id, person, thresholds);
        Judge {
            thresholds: thresholds.clone(),
            person: person.clone(),
            up: crate::ground::upward(model),
            weight: person.mass_kg * model.gravity().norm(),
            coordinates: model.coordinate_ids().map(limits).collect(),
        }
    }

    /// Whether a coordinate is judged at all: a rotation inside the body that nothing else decides.
    #[must_use]
    pub fn judges(&self, id: CoordinateId) -> bool {
        self.coordinates[id.index()].is_judged
    }

    /// Whether a coordinate's moment can be judged.
    #[must_use]
    pub fn knows_strength(&self, id: CoordinateId) -> bool {
        self.coordinates[id.index()].strength.is_some()
    }

    /// Whether a foot is unloaded, near the ground and slow: it may stand where nothing measures.
    fn may_stand_unseen(&self, frame: &Frame<'_>, side: Side) -> bool {
        let carried = frame.feet[side].map_or(0.0, |foot| foot.force.dot(&self.up));
        if carried > CENTER_OF_PRESSURE_LOAD_N {
            return false;
        }
        let Some(sole) = &self.person.soles[side] else { return frame.feet[side].is_none() };
        sole.points.iter().any(|point| {
            let body = &frame.bodies[point.body.index()];
            let place = body.pose.place(point.place);
            let velocity = body.twist.velocity_at(place - body.center) - frame.ground_velocity;
            place.dot(&self.up) - frame.ground_height < NEAR_GROUND_M && velocity.norm() < NEAR_GROUND_M_S
        })
    }
}

fn limits(model: &Model, id: CoordinateId, person: &Person, t: &Thresholds) -> Limits {
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
    Limits {
        strength: given.or_else(built_in).filter(|_| is_judged),
        range: coordinate.range.map(|[low, high]| [low - slack, high + slack]).filter(|_| is_judged),
        is_judged,
    }
}

/// Measures one instant; `visit` receives every value with its limit, feasible or not. Allocates nothing.
///
/// Returns false if the ground forces of the instant are not all there (a foot may stand where nothing measures): moments, powers,
/// flight, support and balance are then not judged.
///
/// # Panics
/// If a slice of the frame is shorter than the model.
pub fn check_frame(judge: &Judge, frame: &Frame<'_>, mut visit: impl FnMut(Measurement)) -> bool {
    let t = &judge.thresholds;
    let mut visit = |m: Measurement| {
        if t.judges(m.check) {
            visit(m);
        }
    };
    let unsupported = share(frame.residual.force.norm(), judge.weight);
    let ground_known = frame.feet.values().any(Option::is_some);
    let whole = !ground_known
        || unsupported <= t.support_bw
        || !Side::BOTH.into_iter().any(|side| judge.may_stand_unseen(frame, side));
    for (index, limits) in judge.coordinates.iter().enumerate().filter(|(_, limits)| limits.is_judged) {
        check_coordinate(judge, frame, CoordinateId(index), limits, whole, &mut visit);
    }
    for side in Side::BOTH {
        if let Some(foot) = &frame.feet[side] {
            check_foot(judge, frame, side, foot, &mut visit);
        }
    }
    if whole && ground_known {
        let of = Measured::Body;
        let mut say = |check: Check, value: f64, limit: f64| {
            visit(Measurement { check, of, value, limit, share: share(value, limit) });
        };
        say(Check::Support, unsupported, t.support_bw);
        say(Check::Balance, frame.residual.moment.norm() / judge.person.mass_kg, t.balance_nm_kg);
        let carried: f64 = frame.feet.values().flatten().map(|foot| foot.force.dot(&judge.up)).sum();
        let flies = frame.walking && carried < FLIGHT_LOAD_BW * judge.weight;
        let [value, share] = if flies { [f64::INFINITY; 2] } else { [0.0, 0.0] };
        visit(Measurement { check: Check::Flight, of, value, limit: t.flight_s, share });
    }
    whole
}

fn check_coordinate(
    judge: &Judge,
    frame: &Frame<'_>,
    id: CoordinateId,
    limits: &Limits,
    whole: bool,
    visit: &mut impl FnMut(Measurement),
) {
    let (t, i, of) = (&judge.thresholds, id.index(), Measured::Coordinate(id));
    if let Some([low, high]) = limits.range {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let bound = if frame.q[i] < middle { low } else { high };
        let share = share((frame.q[i] - middle).abs(), half);
        let [value, limit] = [frame.q[i], bound].map(f64::to_degrees);
        visit(Measurement { check: Check::Range, of, value, limit, share });
    }
    if !whole {
        return;
    }
    if let Some(strength) = &limits.strength {
        let moment = frame.generalized[i];
        let available = strength.available(frame.q[i], frame.qd[i], moment, t.eccentric);
        let allowed = t.strength_share * available + t.strength_tolerance_nm_kg * judge.person.mass_kg;
        let share = share(moment.abs(), allowed);
        visit(Measurement { check: Check::Strength, of, value: moment, limit: allowed.copysign(moment), share });
    }
    let power = frame.powers[i] / judge.person.mass_kg;
    let allowed = if power >= 0.0 { t.generation_w_kg } else { t.absorption_w_kg };
    let share = share(power.abs(), allowed);
    visit(Measurement { check: Check::Power, of, value: power, limit: allowed.copysign(power), share });
}

/// A foot is judged while it carries more than this [N]: a share of the weight, and never less than what has a centre of pressure.
#[must_use]
pub fn least_load_n(load_bw: f64, weight_n: f64) -> f64 {
    (load_bw * weight_n).max(CENTER_OF_PRESSURE_LOAD_N)
}

fn check_foot(judge: &Judge, frame: &Frame<'_>, side: Side, foot: &FootFrame, visit: &mut impl FnMut(Measurement)) {
    let (t, up, of) = (&judge.thresholds, judge.up, Measured::Foot(side));
    let normal = foot.force.dot(&up);
    let carries = |load_bw: f64| normal > least_load_n(load_bw, judge.weight);
    let mut say = |check: Check, value: f64, limit: f64| {
        visit(Measurement { check, of, value, limit, share: share(value, limit) });
    };
    if carries(t.friction_load_bw) {
        say(Check::Friction, (foot.force - up * normal).norm() / normal, t.friction);
    }
    let Some(sole) = &judge.person.soles[side] else { return };
    if carries(t.sole_load_bw) {
        let outside = distance_to_line(judge, frame, sole, foot.center_of_pressure) - sole.half_width;
        say(Check::CenterOfPressure, outside.max(0.0), t.sole_margin_m);
    }
    if carries(t.sliding_load_bw) {
        say(Check::Sliding, slip(judge, frame, sole, foot.center_of_pressure), t.sliding_m_s);
    }
}

/// Value over limit; a limit of zero allows nothing but zero.
fn share(value: f64, limit: f64) -> f64 {
    if limit > 0.0 {
        value / limit
    } else if value > 0.0 {
        f64::INFINITY
    } else {
        0.0
    }
}

/// Distance of a place from the line along the sole, seen from above [m].
fn distance_to_line(judge: &Judge, frame: &Frame<'_>, sole: &Sole, place: Vec3) -> f64 {
    let seen = |v: Vec3| v - judge.up * v.dot(&judge.up);
    let points = sole.points.map(|p| seen(frame.bodies[p.body.index()].pose.place(p.place)));
    let place = seen(place);
    let to_part = |a: Vec3, b: Vec3| {
        let along = b - a;
        let length = along.norm_squared();
        let share = if length > 0.0 { ((place - a).dot(&along) / length).clamp(0.0, 1.0) } else { 0.0 };
        (place - a - along * share).norm()
    };
    to_part(points[0], points[1]).min(to_part(points[1], points[2]))
}

/// Speed along the ground of the foot's material at a place [m/s]: of the toes if the tip is nearest, else of the foot.
fn slip(judge: &Judge, frame: &Frame<'_>, sole: &Sole, place: Vec3) -> f64 {
    let distance = |k: usize| {
        let point = &sole.points[k];
        (frame.bodies[point.body.index()].pose.place(point.place) - place).norm()
    };
    let nearest = if distance(2) < distance(1) { 2 } else { 0 };
    let body = &frame.bodies[sole.points[nearest].body.index()];
    let velocity = body.twist.velocity_at(place - body.center) - frame.ground_velocity;
    (velocity - judge.up * velocity.dot(&judge.up)).norm()
}
