//! Checks of coordinates that arrive frame by frame. They are the checks of a recorded table
//! ([`super::coordinates_from_table`]), applied to the frames that have arrived so far. Each fault is reported once.

use super::import::{ENOUGH_ROTATIONS, LARGEST_PLAUSIBLE_ANGLE, SMALLEST_PLAUSIBLE_SPAN_DEG};
use super::jumps::{AROUND, jump_in_the_middle, whole_turns};
use crate::findings::{Code, Findings};
use crate::model::{Coordinate, CoordinateKind, Model};
use std::f64::consts::TAU;

/// Time after which angles that stayed small are judged: two steps [s].
const JUDGED_S: f64 = 2.5;
/// Number of implausibly large rotations that show degrees: a single one may be the heading of a person who turned.
const ENOUGH_LARGE: usize = 2;
/// Vertical movement of the pelvis that is impossible while every angle stays within 3.2 degrees [m]: legs of 0.85 m
/// need 25 degrees at the knee, feet of 0.2 m need 6 degrees at the ankle.
const RISE_M: f64 = 0.02;
/// Largest plausible speed of a person [m/s] and height of the pelvis [m].
const FASTEST_M_S: f64 = 50.0;
const HIGHEST_M: f64 = 100.0;
/// Time for which a position must be impossible before its unit is doubted [s].
const IMPOSSIBLE_S: f64 = 0.5;
/// Allowed excess over a coordinate's range [rad], as for recordings, and how long it may be exceeded [s].
const RANGE_SLACK_RAD: f64 = 0.35;
const OUT_OF_RANGE_S: f64 = 0.1;
/// Values around a change between two frames.
const RECENT: usize = 2 * AROUND + 2;

/// Checks the frames of a motion as they arrive.
#[derive(Debug, Clone)]
pub struct LiveChecks {
    step_s: f64,
    frames: usize,
    columns: Vec<Column>,
    findings: Findings,
}

/// The state of the checks of one coordinate.
#[derive(Debug, Clone)]
struct Column {
    /// Whole turns that were removed so far.
    turns: f64,
    /// Last value that was not missing; before the first one not-a-number.
    last: f64,
    least: f64,
    most: f64,
    recent: [f64; RECENT],
    /// Frames in which it was beyond its range, or at an impossible place.
    beyond: usize,
    impossible: usize,
    is_upward: bool,
}

impl LiveChecks {
    /// Starts the checks of a model's coordinates that arrive at this rate.
    #[must_use]
    pub fn new(model: &Model, rate_hz: f64) -> LiveChecks {
        let defaults: Vec<f64> = model.coordinates().iter().map(|coordinate| coordinate.default_value).collect();
        let column = |place: usize| Column {
            turns: 0.0,
            last: f64::NAN,
            least: f64::INFINITY,
            most: f64::NEG_INFINITY,
            recent: [f64::NAN; RECENT],
            beyond: 0,
            impossible: 0,
            is_upward: moves_up(model, &defaults, place),
        };
        let columns = (0..defaults.len()).map(column).collect();
        LiveChecks { step_s: 1.0 / rate_hz, frames: 0, columns, findings: Findings::default() }
    }

    /// The findings so far; each fault appears once.
    #[must_use]
    pub fn findings(&self) -> &Findings {
        &self.findings
    }

    /// Takes a frame [rad or m], not-a-number where a value is missing, and removes whole turns from its angles.
    pub fn take(&mut self, model: &Model, q: &mut [f64]) {
        let in_radians = !self.findings.has(Code::MotionDegreesAsRadians);
        for ((column, coordinate), x) in self.columns.iter_mut().zip(model.coordinates()).zip(q) {
            match coordinate.kind {
                CoordinateKind::Rotation if in_radians && column.unwrap(x) => {
                    let message = format!("`{}` jumps by a whole turn; the turns are removed", coordinate.name);
                    report_once(&mut self.findings, Code::MotionUnwrapped, message);
                }
                CoordinateKind::Translation if column.is_impossible(*x, self.step_s) => column.impossible += 1,
                _ => {}
            }
            column.add(*x);
        }
        self.frames += 1;
        self.judge_angles(model);
        self.judge_lengths(model);
        if !self.findings.has(Code::MotionDegreesAsRadians) {
            self.judge_ranges(model);
            self.judge_jumps(model);
        }
    }

    fn rotations<'a>(&'a self, model: &'a Model) -> impl Iterator<Item = (&'a Coordinate, f64)> {
        let of_kind = |(c, _): &(&Coordinate, &Column)| c.kind == CoordinateKind::Rotation;
        let known = model.coordinates().iter().zip(&self.columns).filter(of_kind);
        known.filter(|(_, column)| !column.last.is_nan()).map(|(c, column)| (c, column.most.max(-column.least)))
    }

    fn judge_angles(&mut self, model: &Model) {
        let is_large = |entry: &(&Coordinate, f64)| entry.1 > LARGEST_PLAUSIBLE_ANGLE;
        if !self.findings.has(Code::MotionDegreesAsRadians)
            && self.rotations(model).filter(is_large).count() >= ENOUGH_LARGE
        {
            let large = self.rotations(model).filter(is_large).map(|(c, largest)| format!("`{}` {largest:.0}", c.name));
            let message = format!(
                "angles that were read as radians look like degrees: they reach {}; all forces are wrong. hint: state \
                 the unit of the angles, or send radians",
                large.collect::<Vec<_>>().join(", ")
            );
            report_once(&mut self.findings, Code::MotionDegreesAsRadians, message);
        }
        if self.frames == (JUDGED_S / self.step_s) as usize && self.is_too_stiff(model) {
            let message = format!(
                "no angle exceeds {SMALLEST_PLAUSIBLE_SPAN_DEG} deg while the body moves: the angles look like radians \
                 that were stated as degrees; all forces are wrong. hint: state the unit of the angles"
            );
            report_once(&mut self.findings, Code::MotionRadiansAsDegrees, message);
        }
    }

    /// Whether the pelvis rises and falls although all joints and the pelvis keep their angles.
    fn is_too_stiff(&self, model: &Model) -> bool {
        let turning: Vec<f64> =
            self.rotations(model).map(|(_, largest)| largest.to_degrees()).filter(|x| *x > 0.0).collect();
        turning.len() >= ENOUGH_ROTATIONS
            && turning.iter().all(|largest| *largest < SMALLEST_PLAUSIBLE_SPAN_DEG)
            && self.columns.iter().any(|column| column.is_upward && column.most - column.least > RISE_M)
    }

    fn judge_lengths(&mut self, model: &Model) {
        let many = (IMPOSSIBLE_S / self.step_s) as usize;
        if self.findings.has(Code::MotionLengthUnit) {
            return;
        }
        let mut known = model.coordinates().iter().zip(&self.columns);
        let Some((coordinate, column)) = known.find(|(_, column)| column.impossible > many) else { return };
        let message = format!(
            "`{}` is {:.1} m and moves faster or higher than a person can: positions look like millimetres or \
             centimetres; all forces are wrong. hint: send metres",
            coordinate.name, column.last
        );
        report_once(&mut self.findings, Code::MotionLengthUnit, message);
    }

    fn judge_ranges(&mut self, model: &Model) {
        let many = (OUT_OF_RANGE_S / self.step_s) as usize + 1;
        for (coordinate, column) in model.coordinates().iter().zip(&mut self.columns) {
            let (Some([low, high]), CoordinateKind::Rotation) = (coordinate.range, coordinate.kind) else { continue };
            let value = column.recent[RECENT - 1];
            if value > high + RANGE_SLACK_RAD || value < low - RANGE_SLACK_RAD {
                column.beyond += 1;
            }
            if column.beyond == many {
                column.beyond += 1;
                let [value, low, high] = [value, low, high].map(f64::to_degrees);
                let message = format!(
                    "`{}` is {value:.0} deg; the model allows {low:.0} to {high:.0} deg. hint: is this the motion of \
                     another model? Knee flexion is positive in some models and negative in others",
                    coordinate.name
                );
                self.findings.report(Code::MotionOutOfRange, message);
            }
        }
    }

    fn judge_jumps(&mut self, model: &Model) {
        for (coordinate, column) in model.coordinates().iter().zip(&self.columns) {
            let Some(change) = jump_in_the_middle(coordinate.kind, &column.recent, self.step_s) else { continue };
            let is_angle = coordinate.kind == CoordinateKind::Rotation;
            let (change, unit) = if is_angle { (change.to_degrees(), "deg") } else { (change, "m") };
            let message = format!(
                "`{}` jumps by {change:.3} {unit} between two frames; its rate, and the forces, are wrong there",
                coordinate.name
            );
            report_once(&mut self.findings, Code::MotionJump, message);
        }
    }
}

impl Column {
    /// Removes whole turns from an angle; returns whether another turn began.
    fn unwrap(&mut self, x: &mut f64) -> bool {
        let raw = *x;
        *x -= self.turns * TAU;
        let Some(whole) = whole_turns(*x - self.last).filter(|_| raw.abs() < LARGEST_PLAUSIBLE_ANGLE) else {
            return false;
        };
        self.turns += whole;
        *x -= whole * TAU;
        true
    }

    fn is_impossible(&self, x: f64, step_s: f64) -> bool {
        (x - self.last).abs() > FASTEST_M_S * step_s || self.is_upward && x.abs() > HIGHEST_M
    }

    fn add(&mut self, x: f64) {
        self.recent.copy_within(1.., 0);
        self.recent[RECENT - 1] = x;
        if x.is_finite() {
            self.last = x;
            self.least = self.least.min(x);
            self.most = self.most.max(x);
        }
    }
}

fn report_once(findings: &mut Findings, code: Code, message: String) {
    if !findings.has(code) {
        findings.report(code, message);
    }
}

/// Whether a coordinate lifts the body.
fn moves_up(model: &Model, defaults: &[f64], place: usize) -> bool {
    if model.coordinates()[place].kind != CoordinateKind::Translation {
        return false;
    }
    let mut moved = defaults.to_vec();
    moved[place] += 1.0;
    let (from, to) = (model.poses(defaults), model.poses(&moved));
    let rise = |(from, to): (&crate::spatial::Pose, &crate::spatial::Pose)| {
        (to.translation - from.translation).dot(&model.up()).abs() > 0.5
    };
    from.iter().zip(&to).all(rise)
}
