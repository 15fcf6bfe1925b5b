//! Checks of a whole motion.

use super::acceleration_ratio::AccelerationRatio;
use super::frame::{CheckedPart, CheckedValue, FeasibilityLimits, Frame, check_known};
use super::frame_reader::FrameReader;
use super::motion_and_forces::MotionAndForces;
use super::person::Person;
use super::spans::{Span, Track};
use super::thresholds::Thresholds;
use super::verdict::{
    Check, Closest, FitOfForces, LARGE_RESIDUAL_BW, NotJudged, Reason, Verdict, VerdictState,
    undecided_by_other_support,
};
use crate::findings::{Code, Findings};
use crate::kinematics::each_body_motion;
use crate::model::{CoordinateId, Model, Side};
use crate::motion::TimeGrid;
use crate::numerics::quantiles;
use std::ops::Range;

/// A feasible motion was judged in at least this share of its frames.
const LEAST_JUDGED_SHARE: f64 = 0.9;
/// Filters and splines have no neighbours on one side of the first and last frames, so these are not judged [s].
const EDGE_S: f64 = 0.1;
/// Measured forces that carry the body in a smaller share of the frames do not belong to this motion, and are not
/// replaced by a prediction.
const LEAST_MEASURED_SHARE: f64 = 0.1;
/// Forces that carry less of the weight than this, in all frames without a missing force, were not measured:
/// the plates were off.
const LEAST_CARRIED: f64 = 0.1;
/// A foot leaves the edge of a force plate within this time [s].
const STEP_OFF_S: f64 = 0.15;

/// Decides whether a person could make a motion.
#[must_use]
pub fn check(
    motion: &MotionAndForces<'_>,
    person: &Person,
    thresholds: &Thresholds,
    findings: &mut Findings,
) -> Verdict {
    let MotionAndForces { model, trajectory, .. } = *motion;
    let limits = FeasibilityLimits::new(model, person, thresholds);
    let (tracks, coverage) = measure(motion, &limits, findings);
    let grid = trajectory.grid();
    let (mut reasons, mut beside) = (Vec::new(), Vec::new());
    for (slot, track) in tracks.iter().enumerate() {
        let shortest = match check_of(model, slot) {
            Check::Flight => thresholds.flight_s,
            _ => shortest_s(thresholds, motion.cutoff_hz),
        };
        let spans = track.settled(grid.step_s, shortest);
        let list = if is_beside(model, slot) { &mut beside } else { &mut reasons };
        list.extend(spans.iter().map(|span| reason(model, grid, span, coverage.is_predicted(span.worst_at))));
    }
    let acceleration = coverage.acceleration.span(grid.step_s, &limits).filter(|_| !motion.forces_are_predicted);
    let too_fast = acceleration.filter(|span| span.worst.share > 1.0);
    reasons.extend(too_fast.map(|span| reason(model, grid, &span, false)));
    reasons.sort_by(|a: &Reason, b| a.time_s[0].total_cmp(&b.time_s[0]).then(a.check.cmp(&b.check)));
    let mut closest = closest(model, &tracks, grid);
    closest.extend(acceleration.map(|span| nearest(model, grid, span.worst_at, &span.worst)));
    let mut undecided = coverage.undecided(motion, &limits);
    undecided.extend(beside.first().map(undecided_by_direction));
    if motion.forces_are_predicted || motion.predicted.is_some() {
        let is_predicted = |at_s: f64| {
            motion.forces_are_predicted || coverage.is_predicted(((at_s - grid.start_s) / grid.step_s).round() as usize)
        };
        undecided.extend(other_support(&mut reasons, is_predicted));
    }
    Verdict {
        state: VerdictState::of(&reasons, &undecided),
        judged_share: coverage.judged_share(motion),
        undecided,
        reasons,
        closest,
        not_judged: not_judged(motion, &limits),
        frames: grid.frames,
        frames_unmeasured: coverage.unmeasured(),
        frames_predicted: coverage.predicted.iter().filter(|predicted| **predicted).count(),
        mass_kg: thresholds.mass_kg.unwrap_or(person.mass_kg),
        height_m: thresholds.height_m.unwrap_or(person.height_m),
        likeness: Vec::new(),
        fit: coverage.fit(&limits),
    }
}

/// Where each check came closest to its limit.
fn closest(model: &Model, tracks: &[Track], grid: TimeGrid) -> Vec<Closest> {
    let of_check = |check: Check| {
        let tracks = tracks.iter().enumerate().filter(|(slot, _)| check_of(model, *slot) == check);
        let found = tracks.filter_map(|(_, track)| track.closest).max_by(|a, b| a.1.share.total_cmp(&b.1.share));
        let nearest_frame = found.filter(|(_, m)| m.share.is_finite() && check != Check::Flight);
        nearest_frame.map(|(frame, m)| nearest(model, grid, frame, &m))
    };
    Check::ALL.into_iter().filter_map(of_check).collect()
}

/// A value as it is reported.
fn nearest(model: &Model, grid: TimeGrid, frame: usize, m: &CheckedValue) -> Closest {
    Closest {
        check: m.check,
        quantity: quantity(model, m),
        at_s: grid.time(frame),
        value: m.value,
        limit: m.limit,
        unit: m.check.unit().into(),
        share: m.share,
    }
}

/// An excess that is shorter cannot be distinguished from noise [s]. A low-pass makes an impulse 0.603/fc wide at half
/// of its height: that is the width of sin(x)/x with x = 2π fc t.
fn shortest_s(thresholds: &Thresholds, cutoff_hz: Option<f64>) -> f64 {
    const WIDTH: f64 = 0.603;
    cutoff_hz.map_or(0.0, |cutoff_hz| WIDTH / cutoff_hz).max(thresholds.shortest_s)
}

/// Where forces are predicted from the motion and cannot act through the feet, something else may support the person:
/// hands, a seat, a harness. Removes the reasons that come from such forces and returns why the verdict is undecided;
/// reasons from the motion stay.
fn other_support(reasons: &mut Vec<Reason>, is_predicted: impl Fn(f64) -> bool) -> Option<String> {
    let lacking =
        |reason: &Reason| is_predicted(reason.at_s) && matches!(reason.check, Check::Support | Check::Balance);
    let first = reasons.iter().find(|reason| lacking(reason))?.message.clone();
    reasons.retain(|reason| !is_predicted(reason.at_s) || matches!(reason.check, Check::Range | Check::Pull));
    Some(undecided_by_other_support(&first))
}

/// The message of an undecided verdict if the centre of pressure is outside the sole, but no further from the heel than
/// a foot reaches.
fn undecided_by_direction(reason: &Reason) -> String {
    format!(
        "the coordinates may show the direction of a foot wrongly, or force plates and motion are not aligned: {}",
        reason.message
    )
}

// One track per check of each coordinate, then of each foot, then of the whole body; then the centre of pressure of
// each foot while it is outside the sole, but within the reach of a foot that is turned about its heel.
const OF_COORDINATES: [Check; 3] = [Check::Strength, Check::Range, Check::Power];
const OF_FEET: [Check; 3] = [Check::Friction, Check::CenterOfPressure, Check::Sliding];
const OF_BODY: [Check; 4] = [Check::Flight, Check::Support, Check::Balance, Check::Pull];

fn slot(model: &Model, measurement: &CheckedValue) -> Option<usize> {
    let among = |checks: &[Check]| checks.iter().position(|check| *check == measurement.check);
    let coordinates = OF_COORDINATES.len() * model.coordinates().len();
    match measurement.of {
        CheckedPart::Coordinate(id) => Some(OF_COORDINATES.len() * id.index() + among(&OF_COORDINATES)?),
        CheckedPart::Foot(side) => {
            Some(coordinates + OF_FEET.len() * usize::from(side == Side::Left) + among(&OF_FEET)?)
        }
        CheckedPart::Body => Some(coordinates + 2 * OF_FEET.len() + among(&OF_BODY)?),
    }
}

/// Number of tracks before the tracks of centres of pressure outside the sole.
fn regular_slots(model: &Model) -> usize {
    OF_COORDINATES.len() * model.coordinates().len() + 2 * OF_FEET.len() + OF_BODY.len()
}

fn is_beside(model: &Model, slot: usize) -> bool {
    slot >= regular_slots(model)
}

/// The track of a value; a centre of pressure that a foot in another direction would reach has its own.
fn slot_in_frame(model: &Model, limits: &FeasibilityLimits, frame: &Frame<'_>, m: &CheckedValue) -> Option<usize> {
    match (m.check, m.of) {
        (Check::CenterOfPressure, CheckedPart::Foot(side)) if m.share > 1.0 && limits.foot_reaches(frame, side) => {
            Some(regular_slots(model) + usize::from(side == Side::Left))
        }
        _ => slot(model, m),
    }
}

fn check_of(model: &Model, slot: usize) -> Check {
    let coordinates = OF_COORDINATES.len() * model.coordinates().len();
    let feet = coordinates + 2 * OF_FEET.len();
    if is_beside(model, slot) {
        Check::CenterOfPressure
    } else if slot < coordinates {
        OF_COORDINATES[slot % OF_COORDINATES.len()]
    } else if slot < feet {
        OF_FEET[(slot - coordinates) % OF_FEET.len()]
    } else {
        OF_BODY[slot - feet]
    }
}

/// How much of a motion was judged.
#[derive(Debug, Clone, Default)]
struct Coverage {
    /// Frames in which the given ground forces are complete.
    covered: Vec<bool>,
    /// Frames that were judged on predicted forces.
    predicted: Vec<bool>,
    /// Frames that count: all without the first and last moments.
    counted: usize,
    /// Of those, frames in which all checks were made.
    judged: usize,
    /// Of those, frames with the given ground forces.
    judged_as_given: usize,
    /// Values or limits that are not a number.
    not_numbers: usize,
    /// Sum of the squared residual forces of these frames [N^2].
    residual_n2: f64,
    /// Sum of the squared residual moments of these frames [(N.m)^2].
    residual_nm2: f64,
    /// Speeds of loaded soles along the ground [m/s].
    slips: Vec<f64>,
    /// Acceleration of the mass centre by the motion and by these forces.
    acceleration: AccelerationRatio,
}

impl Coverage {
    /// Number of frames in which ground forces may be missing.
    fn unmeasured(&self) -> usize {
        self.covered.iter().filter(|covered| !**covered).count()
    }

    /// Whether a frame was judged on predicted forces.
    fn is_predicted(&self, frame: usize) -> bool {
        self.predicted.get(frame).is_some_and(|predicted| *predicted)
    }

    /// Share of the counted frames that were judged; without ground forces most checks cannot be made, so it is zero.
    fn judged_share(&self, motion: &MotionAndForces<'_>) -> f64 {
        if motion.ground.bodies.is_empty() || self.counted == 0 {
            0.0
        } else {
            self.judged as f64 / self.counted as f64
        }
    }

    /// Reports frames in which ground forces may be missing.
    fn report(&self, grid: TimeGrid, findings: &mut Findings) {
        let Some(first) = self.covered.iter().position(|covered| !covered) else { return };
        let judged = match self.predicted[first] {
            true => "moments, powers, flight, support and balance were judged on forces predicted from the motion",
            false => "moments, powers, flight, support and balance were not checked",
        };
        let message = format!(
            "{judged} in {} of {} frames (the first at {:.3} s), because a foot may be on ground whose force is not \
             known",
            self.unmeasured(),
            grid.frames,
            grid.time(first)
        );
        findings.report(Code::FeasibilityUnmeasuredSupport, message);
    }

    /// How well motion and ground forces fit together.
    fn fit(&self, limits: &FeasibilityLimits) -> FitOfForces {
        let rms = |squares: f64| (self.judged_as_given > 0).then(|| (squares / self.judged_as_given as f64).sqrt());
        FitOfForces {
            residual_force_bw: rms(self.residual_n2).map(|force_n| force_n / limits.weight),
            residual_moment_nm_kg: rms(self.residual_nm2).map(|moment_nm| moment_nm / limits.mass),
            complete_share: self.judged_as_given as f64 / self.counted.max(1) as f64,
            sliding_m_s: lower_quartile(&self.slips),
        }
    }

    /// Why this motion cannot be called feasible.
    fn undecided(&self, motion: &MotionAndForces<'_>, limits: &FeasibilityLimits) -> Vec<String> {
        let mut list = Vec::new();
        let judged = self.judged_share(motion);
        if motion.ground.bodies.is_empty() {
            list.push("the ground forces are unknown".to_owned());
        } else if self.counted == 0 {
            list.push(format!("the motion is too short: the first and the last {EDGE_S} s are not judged"));
        } else if judged < LEAST_JUDGED_SHARE {
            list.push(format!(
                "ground forces are known in {:.0} % of the frames; {:.0} % are needed",
                100.0 * judged,
                100.0 * LEAST_JUDGED_SHARE
            ));
        }
        let FitOfForces { residual_force_bw, complete_share: measured, .. } = self.fit(limits);
        if !motion.ground.bodies.is_empty() && self.counted > 0 && measured < LEAST_MEASURED_SHARE {
            list.push(format!(
                "the measured ground forces carry the body in {:.0} % of the frames; they may not be those of this \
                 motion",
                100.0 * measured
            ));
        }
        let residual_bw = residual_force_bw.unwrap_or(0.0);
        if residual_bw > LARGE_RESIDUAL_BW {
            list.push(format!(
                "the residual force is {:.0} % of body weight; above {:.0} %, motion, body and ground forces do not \
                 belong together",
                100.0 * residual_bw,
                100.0 * LARGE_RESIDUAL_BW
            ));
        }
        if self.not_numbers > 0 {
            list.push(format!("{} checked values are not a number", self.not_numbers));
        }
        list
    }
}

/// The value that a quarter of the values stay below; `None` without values.
fn lower_quartile(values: &[f64]) -> Option<f64> {
    quantiles(values.iter().copied(), [0.25]).map(|[low]| low)
}

/// The frames without the first and the last [`EDGE_S`]; none in a motion that is too short to be judged.
pub(crate) fn inner_frames(grid: TimeGrid) -> Range<usize> {
    let edge = (EDGE_S / grid.step_s).round() as usize;
    edge..grid.frames.saturating_sub(edge).max(edge)
}

/// Checks every frame.
fn measure(
    motion: &MotionAndForces<'_>,
    limits: &FeasibilityLimits,
    findings: &mut Findings,
) -> (Vec<Track>, Coverage) {
    let MotionAndForces { model, trajectory, .. } = *motion;
    let mut tracks = vec![Track::default(); regular_slots(model) + Side::BOTH.len()];
    let mut given = FrameReader::new(motion, motion.forces, motion.ground);
    let mut coverage = Coverage { covered: covered(motion, &mut given, limits), ..Coverage::default() };
    let mut predicted = motion.predicted.map(|predicted| FrameReader::new(motion, predicted.forces, predicted.ground));
    let lasting = frames_that_last(shortest_s(&limits.thresholds, motion.cutoff_hz), trajectory.grid());
    let inner = inner_frames(trajectory.grid());
    coverage.predicted = coverage.covered.iter().map(|covered| !covered && predicted.is_some()).collect();
    each_body_motion(model, trajectory, |i, bodies| {
        let covered = coverage.covered[i];
        let frame = match &mut predicted {
            Some(predicted) if !covered => predicted.frame(i, bodies),
            _ => given.frame(i, bodies),
        };
        let whole = covered || coverage.predicted[i];
        check_known(limits, &frame, whole, |m| {
            coverage.not_numbers += usize::from(m.share.is_nan());
            if m.check == Check::Sliding && covered && inner.contains(&i) {
                coverage.slips.push(m.value);
            }
            if let Some(slot) = slot_in_frame(model, limits, &frame, &m).filter(|_| inner.contains(&i)) {
                tracks[slot].add(i, m, lasting);
            }
        });
        if inner.contains(&i) {
            coverage.counted += 1;
            coverage.judged += usize::from(whole);
            if covered {
                coverage.judged_as_given += 1;
                coverage.residual_n2 += frame.residual.force.norm_squared();
                coverage.residual_nm2 += frame.residual.moment.norm_squared();
                coverage.acceleration.add(i, &frame);
            }
        }
    });
    coverage.report(trajectory.grid(), findings);
    (tracks, coverage)
}

/// Frames in which no ground force is missing. A lack of support while a plate measures only a part of a foot's load is
/// that part. A foot that steps off a force plate leaves a part of its load there: a lack of support that begins or
/// ends with missing forces has the same cause.
fn covered(motion: &MotionAndForces<'_>, given: &mut FrameReader<'_>, limits: &FeasibilityLimits) -> Vec<bool> {
    let (mut covered, mut lacking): (Vec<bool>, Vec<bool>) = (Vec::new(), Vec::new());
    let mut upward_n = [0.0; 2];
    let is_partly_measured = |i: usize| {
        let time_s = motion.trajectory.grid().time(i);
        motion.partly_measured.iter().any(|[from, to]| (*from..=*to).contains(&time_s))
    };
    each_body_motion(motion.model, motion.trajectory, |i, bodies| {
        let frame = given.frame(i, bodies);
        let lacks = limits.lacks_support(&frame);
        covered.push(limits.support_is_known(&frame) && !(lacks && is_partly_measured(i)));
        lacking.push(lacks);
        if covered[i] {
            let [carried, needed] = limits.upward_forces(&frame);
            upward_n = [upward_n[0] + carried, upward_n[1] + needed];
        }
    });
    if !motion.ground.bodies.is_empty() && upward_n[0] < LEAST_CARRIED * upward_n[1] {
        covered.fill(false);
    }
    let most = (STEP_OFF_S / motion.trajectory.grid().step_s) as usize;
    let known = covered.clone();
    let gap_near = |i: usize| {
        let before = (0..=i).rev().take(most + 1).take_while(|k| !known[*k] || lacking[*k]).any(|k| !known[k]);
        before || (i..known.len()).take(most + 1).take_while(|k| !known[*k] || lacking[*k]).any(|k| !known[k])
    };
    (0..known.len()).map(|i| known[i] && !(lacking[i] && gap_near(i))).collect()
}

/// Number of consecutive frames that is not noise.
fn frames_that_last(shortest_s: f64, grid: TimeGrid) -> usize {
    ((shortest_s / grid.step_s - 1e-9).ceil().max(1.0) as usize).min(grid.frames.max(1))
}

fn not_judged(motion: &MotionAndForces<'_>, limits: &FeasibilityLimits) -> Vec<NotJudged> {
    let model = motion.model;
    let mut list = Vec::new();
    let mut add = |check: Check, why: String| list.push(NotJudged { check, why });
    for check in Check::ALL.into_iter().filter(|check| !limits.thresholds.judges(*check)) {
        add(check, "skipped by the thresholds".to_owned());
    }
    let unknown: Vec<&str> = model
        .coordinate_ids()
        .filter(|id| limits.covers(*id) && !limits.has_strength(*id))
        .map(|id: CoordinateId| model.coordinates()[id.index()].name.as_str())
        .collect();
    if !unknown.is_empty() {
        add(Check::Strength, format!("no strength is known for {}", unknown.join(", ")));
    }
    if motion.ground.bodies.is_empty() {
        for check in OF_FEET.iter().chain(&OF_BODY) {
            add(*check, "no ground forces".to_owned());
        }
        return list;
    }
    let unknown = |side: &Side| limits.person.soles[*side].is_none();
    for side in Side::BOTH.into_iter().filter(unknown) {
        for check in [Check::CenterOfPressure, Check::Sliding] {
            add(check, format!("unknown {side} sole: the model has no {side} foot"));
        }
    }
    list
}

fn quantity(model: &Model, m: &CheckedValue) -> String {
    match m.of {
        CheckedPart::Coordinate(id) => {
            let coordinate = &model.coordinates()[id.index()];
            match m.check {
                Check::Strength => format!("{}_{}", coordinate.name, coordinate.kind.force_suffix()),
                Check::Power => format!("{}_power", coordinate.name),
                _ => coordinate.name.clone(),
            }
        }
        CheckedPart::Foot(side) => format!("{}_{}", m.check, side.letter()),
        CheckedPart::Body => m.check.to_string(),
    }
}

fn reason(model: &Model, grid: TimeGrid, span: &Span, is_predicted: bool) -> Reason {
    let mut m = span.worst;
    if m.check == Check::Flight {
        m.value = span.duration_s(grid.step_s);
    }
    let side = match m.of {
        CheckedPart::Coordinate(id) => model.anatomy().coordinate_side(id),
        CheckedPart::Foot(side) => Some(side),
        CheckedPart::Body => None,
    };
    let (time_s, at_s) = ([grid.time(span.first), grid.time(span.last)], grid.time(span.worst_at));
    let quantity = quantity(model, &m);
    let origin =
        if is_predicted { "; the forces are predicted, because the plates do not cover this time" } else { "" };
    let message = message(&m, &quantity, side, time_s, at_s) + origin;
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

fn message(m: &CheckedValue, quantity: &str, side: Option<Side>, [from, to]: [f64; 2], at: f64) -> String {
    let (value, limit) = (m.value, m.limit);
    let when = format!("from {from:.3} to {to:.3} s, worst at {at:.3} s");
    let foot = side.map_or_else(String::new, |side| side.to_string());
    match m.check {
        Check::Strength => {
            format!(
                "`{quantity}` is {value:.1} N.m; the muscles can supply {limit:.1} N.m at this angle and speed ({when})"
            )
        }
        Check::Range => format!("`{quantity}` is {value:.1} deg; the joint reaches {limit:.1} deg with slack ({when})"),
        Check::Power => format!("`{quantity}` is {value:.1} W/kg; at most {limit:.1} W/kg are plausible ({when})"),
        Check::Friction => {
            format!("the {foot} foot needs a coefficient of friction of {value:.2}; {limit:.2} is available ({when})")
        }
        Check::CenterOfPressure => {
            format!(
                "the centre of pressure is {value:.3} m away from the {foot} sole; {limit:.3} m are allowed ({when})"
            )
        }
        Check::Sliding => {
            format!("the loaded {foot} foot slides at {value:.2} m/s; {limit:.2} m/s are allowed ({when})")
        }
        Check::Flight => format!(
            "no foot is loaded for {value:.3} s while walking; {limit:.3} s are allowed (from {from:.3} to {to:.3} s)"
        ),
        Check::Support => format!(
            "the residual force is {value:.2} body weights, which neither ground nor muscles supply; {limit:.2} are \
             allowed ({when})"
        ),
        Check::Pull => format!(
            "the motion needs a ground that pulls down with {value:.2} body weights; {limit:.2} are allowed. hint: \
             check unit and frame rate of the motion ({when})"
        ),
        Check::Acceleration => format!(
            "the body accelerates {value:.2} times as much as the measured ground forces make it; {limit:.2} times is \
             allowed (from {from:.3} to {to:.3} s). hint: check the frame rate of the motion, and whether motion and \
             forces are of one recording"
        ),
        Check::Balance => format!(
            "the residual moment about the root is {value:.2} N.m/kg, which neither ground nor muscles supply; \
             {limit:.2} are allowed ({when})"
        ),
    }
}
