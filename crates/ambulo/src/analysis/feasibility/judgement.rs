//! A whole motion against its limits.

use super::frame::{FootFrame, Frame, Judge, Measured, Measurement, check_frame};
use super::ground_speed::over_ground;
use super::person::Person;
use super::spans::{Span, Track};
use super::thresholds::Thresholds;
use super::verdict::{Check, Closest, NotJudged, Reason, Verdict};
use crate::dynamics::{Forces, Roots};
use crate::findings::{Code, Findings};
use crate::ground::{BodyForces, GroundForces, feet, upward};
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::{BySide, CoordinateId, Model, Side};
use crate::motion::TimeGrid;
use crate::spatial::Vec3;

/// A motion and its forces, whoever made them.
#[derive(Debug, Clone, Copy)]
pub struct Evidence<'a> {
    /// The body.
    pub model: &'a Model,
    /// Its motion.
    pub trajectory: &'a Trajectory,
    /// The forces of inverse dynamics or of a simulation.
    pub forces: &'a Forces,
    /// What the ground does; without bodies where it is not known.
    pub ground: &'a GroundForces,
    /// What a worn device gives of the generalised forces: one column a coordinate [N.m or N].
    pub device: Option<&'a [Vec<f64>]>,
}

/// Judges a whole motion.
#[must_use]
pub fn check(evidence: &Evidence<'_>, person: &Person, thresholds: &Thresholds, findings: &mut Findings) -> Verdict {
    let Evidence { model, trajectory, .. } = *evidence;
    let judge = Judge::new(model, person, thresholds);
    let (tracks, frames_unmeasured) = measure(evidence, &judge, findings);
    let grid = trajectory.grid();
    let (mut reasons, mut closest) = (Vec::new(), Vec::new());
    for (slot, track) in tracks.iter().enumerate() {
        let check = check_of(model, slot);
        let shortest = if check == Check::Flight { thresholds.flight_s } else { thresholds.shortest_s };
        reasons.extend(track.settled(grid.step_s, shortest).iter().map(|span| reason(model, grid, span)));
    }
    reasons.sort_by(|a: &Reason, b| a.time_s[0].total_cmp(&b.time_s[0]).then(a.check.cmp(&b.check)));
    for check in Check::ALL {
        let of_check = tracks.iter().enumerate().filter(|(slot, _)| check_of(model, *slot) == check);
        let nearest = of_check.filter_map(|(_, track)| track.closest).max_by(|a, b| a.1.share.total_cmp(&b.1.share));
        closest.extend(nearest.filter(|(_, m)| m.share.is_finite() && check != Check::Flight).map(|(frame, m)| {
            Closest {
                check,
                quantity: quantity(model, &m),
                at_s: grid.time(frame),
                value: m.value,
                limit: m.limit,
                unit: check.unit().into(),
                share: m.share,
            }
        }));
    }
    Verdict {
        feasible: reasons.is_empty(),
        reasons,
        closest,
        not_judged: not_judged(evidence, &judge),
        frames: grid.frames,
        frames_unmeasured,
        mass_kg: thresholds.mass_kg.unwrap_or(person.mass_kg),
        height_m: thresholds.height_m.unwrap_or(person.height_m),
    }
}

// A track for each check of each coordinate, then of each foot, then of the whole body.
const OF_COORDINATES: [Check; 3] = [Check::Strength, Check::Range, Check::Power];
const OF_FEET: [Check; 3] = [Check::Friction, Check::CenterOfPressure, Check::Sliding];
const OF_BODY: [Check; 3] = [Check::Flight, Check::Support, Check::Balance];

fn slot(model: &Model, measurement: &Measurement) -> Option<usize> {
    let among = |checks: &[Check]| checks.iter().position(|check| *check == measurement.check);
    let coordinates = OF_COORDINATES.len() * model.coordinates().len();
    match measurement.of {
        Measured::Coordinate(id) => Some(OF_COORDINATES.len() * id.index() + among(&OF_COORDINATES)?),
        Measured::Foot(side) => Some(coordinates + OF_FEET.len() * usize::from(side == Side::Left) + among(&OF_FEET)?),
        Measured::Body => Some(coordinates + 2 * OF_FEET.len() + among(&OF_BODY)?),
    }
}

fn check_of(model: &Model, slot: usize) -> Check {
    let coordinates = OF_COORDINATES.len() * model.coordinates().len();
    let feet = coordinates + 2 * OF_FEET.len();
    if slot < coordinates {
        OF_COORDINATES[slot % OF_COORDINATES.len()]
    } else if slot < feet {
        OF_FEET[(slot - coordinates) % OF_FEET.len()]
    } else {
        OF_BODY[slot - feet]
    }
}

/// Every frame, into tracks; and the number of frames in which a foot may stand where nothing measures.
fn measure(evidence: &Evidence<'_>, judge: &Judge, findings: &mut Findings) -> (Vec<Track>, usize) {
    let Evidence { model, trajectory, forces, ground, device } = *evidence;
    let up = upward(model);
    let count = OF_COORDINATES.len() * model.coordinates().len() + 2 * OF_FEET.len() + OF_BODY.len();
    let mut tracks = vec![Track::default(); count];
    let over = over_ground(model, trajectory, ground, up);
    let gravity = model.gravity().norm();
    let froude = over.map(|o| o.speed * o.speed / (gravity * judge.person.leg_length_m));
    let by_side = feet(model, ground);
    let feet = BySide::from_fn(|side| by_side.iter().find(|(s, _)| *s == side).map(|(_, forces)| forces));
    let roots = Roots::of(model);
    let n = model.coordinates().len();
    let [mut q, mut qd, mut tau, mut power] = [0; 4].map(|_| vec![0.0; n]);
    let height = ground_height(&feet, up);
    let lasting = frames_that_last(judge.thresholds.shortest_s, trajectory.grid());
    let (mut unseen, mut first_unseen) = (0, None);
    each_body_motion(model, trajectory, |i, bodies| {
        for (c, id) in model.coordinate_ids().enumerate() {
            (q[c], qd[c]) = (trajectory.values(id)[i], trajectory.rates(id)[i]);
            (tau[c], power[c]) = (forces.generalized[c][i], forces.powers[c][i]);
            if let Some(device) = device {
                tau[c] -= device[c][i];
            }
        }
        let frame = Frame {
            q: &q,
            qd: &qd,
            generalized: &tau,
            powers: &power,
            bodies,
            feet: feet.map(|foot| foot.map(|f| foot_frame(f, i))),
            residual: roots.residual(|body| forces.reactions[body.index()][i]),
            ground_velocity: over.map_or(Vec3::zeros(), |o| o.ground),
            ground_height: height,
            walking: froude.is_none_or(|froude| froude < judge.thresholds.running_froude),
        };
        let whole = check_frame(judge, &frame, |m| {
            if let Some(slot) = slot(model, &m) {
                tracks[slot].add(i, m, lasting);
            }
        });
        if !whole {
            unseen += 1;
            first_unseen.get_or_insert(i);
        }
    });
    if let Some(first) = first_unseen {
        let message = format!(
            "moments, powers, flight, support and balance were not judged in {unseen} of {} frames (the first at {:.3} s): a foot may stand there where nothing measures its force",
            trajectory.grid().frames,
            trajectory.grid().time(first)
        );
        findings.report(Code::FeasibilityUnmeasuredSupport, message);
    }
    (tracks, unseen)
}

/// Least number of frames in a row that is no noise.
fn frames_that_last(shortest_s: f64, grid: TimeGrid) -> usize {
    ((shortest_s / grid.step_s - 1e-9).ceil().max(1.0) as usize).min(grid.frames.max(1))
}

fn foot_frame(foot: &BodyForces, frame: usize) -> FootFrame {
    FootFrame { force: foot.force[frame], center_of_pressure: foot.center_of_pressure[frame] }
}

/// Median height of the centres of pressure [m].
fn ground_height(feet: &BySide<Option<&BodyForces>>, up: Vec3) -> f64 {
    let centers = feet.values().flatten().flat_map(|foot| &foot.center_of_pressure);
    let mut heights: Vec<f64> = centers.map(|p| p.dot(&up)).filter(|h| h.is_finite()).collect();
    heights.sort_by(f64::total_cmp);
    heights.get(heights.len() / 2).copied().unwrap_or(0.0)
}

fn not_judged(evidence: &Evidence<'_>, judge: &Judge) -> Vec<NotJudged> {
    let model = evidence.model;
    let mut list = Vec::new();
    let mut add = |check: Check, why: String| list.push(NotJudged { check, why });
    for check in Check::ALL.into_iter().filter(|check| !judge.thresholds.judges(*check)) {
        add(check, "left out by the thresholds".to_owned());
    }
    let unknown: Vec<&str> = model
        .coordinate_ids()
        .filter(|id| judge.judges(*id) && !judge.knows_strength(*id))
        .map(|id: CoordinateId| model.coordinates()[id.index()].name.as_str())
        .collect();
    if !unknown.is_empty() {
        add(Check::Strength, format!("no strength is known for {}", unknown.join(", ")));
    }
    if evidence.ground.bodies.is_empty() {
        for check in OF_FEET.iter().chain(&OF_BODY) {
            add(*check, "no ground forces".to_owned());
        }
        return list;
    }
    let unknown = |side: &Side| judge.person.soles[*side].is_none();
    for side in Side::BOTH.into_iter().filter(unknown) {
        for check in [Check::CenterOfPressure, Check::Sliding] {
            add(check, format!("the {side} sole is not known: the model has no {side} foot"));
        }
    }
    list
}

fn quantity(model: &Model, m: &Measurement) -> String {
    match m.of {
        Measured::Coordinate(id) => {
            let coordinate = &model.coordinates()[id.index()];
            match m.check {
                Check::Strength => format!("{}_{}", coordinate.name, coordinate.kind.force_suffix()),
                Check::Power => format!("{}_power", coordinate.name),
                _ => coordinate.name.clone(),
            }
        }
        Measured::Foot(side) => format!("{}_{}", m.check, side.letter()),
        Measured::Body => m.check.to_string(),
    }
}

fn reason(model: &Model, grid: TimeGrid, span: &Span) -> Reason {
    let mut m = span.worst;
    if m.check == Check::Flight {
        m.value = span.duration_s(grid.step_s);
    }
    let side = match m.of {
        Measured::Coordinate(id) => model.anatomy().coordinate_side(id),
        Measured::Foot(side) => Some(side),
        Measured::Body => None,
    };
    let (time_s, at_s) = ([grid.time(span.first), grid.time(span.last)], grid.time(span.worst_at));
    let quantity = quantity(model, &m);
    let message = message(&m, &quantity, side, time_s, at_s);
    Reason {
        check: m.check,
        quantity,
        side,
        time_s,
        at_s,
        value: m.value,
        limit: m.limit,
        unit: m.check.unit().into(),
        message,
    }
}

fn message(m: &Measurement, quantity: &str, side: Option<Side>, [from, to]: [f64; 2], at: f64) -> String {
    let (value, limit) = (m.value, m.limit);
    let when = format!("from {from:.3} to {to:.3} s, worst at {at:.3} s");
    let foot = side.map_or_else(String::new, |side| side.to_string());
    match m.check {
        Check::Strength => {
            format!("`{quantity}` is {value:.1} N.m; the muscles give {limit:.1} N.m at this angle and speed ({when})")
        }
        Check::Range => format!("`{quantity}` is {value:.1} deg; the joint goes to {limit:.1} deg with slack ({when})"),
        Check::Power => format!("`{quantity}` is {value:.1} W/kg; at most {limit:.1} W/kg are plausible ({when})"),
        Check::Friction => format!("the {foot} foot needs a friction of {value:.2}; {limit:.2} is there ({when})"),
        Check::CenterOfPressure => format!(
            "the centre of pressure lies {value:.3} m outside the {foot} sole; {limit:.3} m are allowed ({when})"
        ),
        Check::Sliding => {
            format!("the loaded {foot} foot slides at {value:.2} m/s; {limit:.2} m/s are allowed ({when})")
        }
        Check::Flight => format!(
            "no foot is loaded for {value:.3} s while walking; {limit:.3} s are allowed (from {from:.3} to {to:.3} s)"
        ),
        Check::Support => format!(
            "the motion needs {value:.2} body weights more than ground and muscles give; {limit:.2} are allowed ({when})"
        ),
        Check::Balance => format!(
            "the motion needs {value:.2} N.m/kg about the root that ground and muscles do not give; {limit:.2} are allowed ({when})"
        ),
    }
}
