//! A periodic angle: knots whose time, angle, slope and curvature depend on speed, joined by quintics.
//!
//! On the segment between knots k and k+1, with phase φ [cycles] and dimensionless speed V*:
//!
//! ```text
//! w = p_{k+1}(V*) - p_k(V*),  u = (φ - p_k(V*)) / w,  angle = h(u; a_k, s_k w, c_k w²; a_{k+1}, s_{k+1} w, c_{k+1} w²)
//! ```
//!
//! **C² in φ and V* together.** Each segment is a smooth function of (φ, V*), because w is above zero. Let D be the
//! difference of the segments on both sides of knot k. On the line φ = p_k(V*) both sides have angle a_k, slope s_k and
//! curvature c_k, so D = ∂D/∂φ = ∂²D/∂φ² = 0 there for every V*. By Taylor's theorem D = (φ - p_k(V*))³ E(φ, V*) with E
//! smooth, and every derivative of D up to the second, in φ, in V* or mixed, has a factor φ - p_k(V*) and vanishes on
//! the line. Hence angle(φ(t), V*(t)) is C² in t if φ and V* are.
//!
//! | code | symbol | unit |
//! |---|---|---|
//! | `phase` | φ, p_k | cycles, 0 at foot strike of the same side |
//! | `angle` | a_k | rad |
//! | `slope` | s_k | rad/cycle |
//! | `curvature` | c_k | rad/cycle² |
//!
//! Pinned by: tests/gait_curves.rs, tests/gait_accuracy.rs.

use super::jet::Jet;
use super::pace_plan::whole_cycles;
use super::quintic::{End, Polynomial};
use super::speed_law::SpeedLaw;

/// A knot of a curve; its numbers depend on the dimensionless speed.
#[derive(Debug, Clone, PartialEq)]
pub struct Knot {
    /// Name, such as `swing peak`.
    pub name: String,
    /// The sub-cycle that starts here.
    pub begins: Option<String>,
    /// Time [cycles].
    pub phase: SpeedLaw,
    /// Angle [rad].
    pub angle: SpeedLaw,
    /// First derivative [rad/cycle].
    pub slope: SpeedLaw,
    /// Second derivative [rad/cycle²].
    pub curvature: SpeedLaw,
    /// Share of a change of step height that applies to this knot, 0 to 1.
    pub height_share: f64,
}

impl Knot {
    /// The knot with slope, curvature and distance from the neutral angle of the joint multiplied by a factor.
    #[must_use]
    pub(crate) fn scaled_about(&self, neutral: f64, factor: f64) -> Knot {
        Knot {
            angle: self.angle.plus(-neutral).scaled(factor).plus(neutral),
            slope: self.slope.scaled(factor),
            curvature: self.curvature.scaled(factor),
            ..self.clone()
        }
    }
}

/// A periodic angle against phase and dimensionless speed.
#[derive(Debug, Clone, PartialEq)]
pub struct CyclicCurve {
    /// Knots in order of their phases, which span less than one cycle; at least two.
    knots: Vec<Knot>,
}

impl CyclicCurve {
    /// A curve through two knots or more; `None` for fewer.
    #[must_use]
    pub fn new(knots: Vec<Knot>) -> Option<CyclicCurve> {
        (knots.len() >= 2).then_some(CyclicCurve { knots })
    }

    /// A curve through knots that the crate itself chose, at least two.
    #[doc(hidden)] // for tests
    pub fn of(knots: Vec<Knot>) -> CyclicCurve {
        debug_assert!(knots.len() >= 2, "a curve needs two knots");
        CyclicCurve { knots }
    }

    /// The knots, in order.
    #[must_use]
    pub fn knots(&self) -> &[Knot] {
        &self.knots
    }

    /// The curve with each knot replaced by the result of a function.
    #[must_use]
    pub(crate) fn mapped(&self, image: impl FnMut(&Knot) -> Knot) -> CyclicCurve {
        CyclicCurve { knots: self.knots.iter().map(image).collect() }
    }

    /// Phase of knot k [cycles]; beyond the end of the cycle, knot n is knot 0 one cycle later.
    #[must_use]
    pub fn knot_phase(&self, k: usize, speed: f64) -> f64 {
        let n = self.knots.len();
        self.knots[k % n].phase.at(speed) + (k / n) as f64
    }

    /// The phase in a cycle that starts at knot 0: `phase` without whole cycles.
    fn wrapped(&self, phase: Jet, speed: f64) -> Jet {
        wrapped(phase, self.knot_phase(0, speed))
    }

    /// The segment of a phase; segment k starts at knot k.
    #[must_use]
    pub fn segment_at(&self, phase: f64, speed: f64) -> usize {
        let phase = self.wrapped(Jet::constant(phase), speed).value;
        let later = (1..self.knots.len()).take_while(|k| self.knot_phase(*k, speed) <= phase);
        later.last().unwrap_or(0)
    }

    /// The angle [rad] with its time derivatives.
    #[must_use]
    pub fn at(&self, phase: Jet, speed: Jet) -> Jet {
        self.on_segment(self.segment_at(phase.value, speed.value), phase, speed)
    }

    /// The angle [rad] by the polynomial of one segment, for phases on that segment.
    #[must_use]
    pub fn on_segment(&self, k: usize, phase: Jet, speed: Jet) -> Jet {
        self.segment(k, speed).at(self.wrapped(phase, speed.value))
    }

    fn segment(&self, k: usize, speed: Jet) -> Segment {
        let n = self.knots.len();
        let (from, to) = (&self.knots[k], &self.knots[(k + 1) % n]);
        let start = from.phase.jet(speed);
        let mut end = to.phase.jet(speed);
        if k + 1 == n {
            end.value += 1.0;
        }
        let width = end - start;
        let polynomial = Polynomial::between(self.end(from, width, speed), self.end(to, width, speed));
        Segment { start, per_width: width.reciprocal(), polynomial }
    }

    fn end(&self, knot: &Knot, width: Jet, speed: Jet) -> End {
        End {
            value: knot.angle.jet(speed),
            slope: knot.slope.jet(speed) * width,
            curvature: knot.curvature.jet(speed) * width * width,
        }
    }
}

/// The phase in a cycle that starts at `first`: `phase` without whole cycles.
fn wrapped(phase: Jet, first: f64) -> Jet {
    let whole = whole_cycles(phase.value - first);
    let phase = phase - whole;
    // A tiny negative difference rounds up to a whole cycle.
    if phase.value - first < 1.0 { phase } else { phase - 1.0 }
}

/// One segment at one speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Phase of its start, and 1/w.
    start: Jet,
    per_width: Jet,
    polynomial: Polynomial,
}

impl Segment {
    /// The angle [rad] at a phase in the cycle that starts at knot 0.
    #[inline]
    fn at(&self, phase: Jet) -> Jet {
        self.polynomial.at((phase - self.start) * self.per_width)
    }
}

/// A curve with the numbers of all its segments at one speed, for walks whose speed is that one most of the time. It
/// gives the same bits as the curve; at any other speed it computes them.
#[derive(Debug, Clone, PartialEq)]
pub struct SteadyCurve {
    curve: CyclicCurve,
    speed: Jet,
    /// Phases of the knots [cycles].
    phases: Vec<f64>,
    /// Segments of the curve, one per knot.
    pub segments: Vec<Segment>,
}

impl SteadyCurve {
    /// The numbers of the curve at this speed.
    pub fn new(curve: &CyclicCurve, speed: Jet) -> SteadyCurve {
        let knots = 0..curve.knots.len();
        SteadyCurve {
            phases: knots.clone().map(|k| curve.knot_phase(k, speed.value)).collect(),
            segments: knots.map(|k| curve.segment(k, speed)).collect(),
            curve: curve.clone(),
            speed,
        }
    }

    /// [`CyclicCurve::at`].
    #[inline]
    pub fn at(&self, phase: Jet, speed: Jet) -> Jet {
        self.at_chosen(phase, speed, |segment| segment)
    }

    /// The angle [rad] by the polynomial of the segment that `chosen` makes of the one at this phase.
    pub(super) fn at_chosen(&self, phase: Jet, speed: Jet, chosen: impl Fn(usize) -> usize) -> Jet {
        if speed != self.speed {
            let segment = chosen(self.curve.segment_at(phase.value, speed.value));
            return self.curve.on_segment(segment, phase, speed);
        }
        let phase = wrapped(phase, self.phases[0]);
        self.segments[chosen(self.segment_of(phase.value))].at(phase)
    }

    /// The segment of a phase that is in the cycle of the first knot.
    fn segment_of(&self, phase: f64) -> usize {
        self.phases[1..].iter().take_while(|start| **start <= phase).count()
    }

    /// [`CyclicCurve::segment_at`].
    pub(super) fn segment_at(&self, phase: f64, speed: Jet) -> usize {
        if speed != self.speed {
            return self.curve.segment_at(phase, speed.value);
        }
        self.segment_of(wrapped(Jet::constant(phase), self.phases[0]).value)
    }
}
