//! A periodic angle: knots whose time, angle, slope and curvature follow speed, quintics between them.
//!
//! On the segment between knots k and k+1, with phase φ [cycles] and dimensionless speed V*:
//!
//! ```text
//! w = p_{k+1}(V*) - p_k(V*),   u = (φ - p_k(V*)) / w,   angle = h(u; a_k, s_k w, c_k w²; a_{k+1}, s_{k+1} w, c_{k+1} w²)
//! ```
//!
//! **C² in φ and V* together.** Each segment is a smooth function of (φ, V*), w being above zero. Let D be the difference
//! of the segments on both sides of knot k. On the line φ = p_k(V*) both sides have angle a_k, slope s_k and curvature c_k,
//! so D = ∂D/∂φ = ∂²D/∂φ² = 0 there for every V*. By Taylor's theorem D = (φ - p_k(V*))³ E(φ, V*) with E smooth, and
//! every derivative of D up to the second, in φ, in V* or mixed, keeps a factor φ - p_k(V*): all vanish on the line. So
//! angle(φ(t), V*(t)) is C² in t whenever φ and V* are.
//!
//! | code | symbol | unit |
//! |---|---|---|
//! | `phase` | φ, p_k | cycles, 0 at contact of the curve's own foot |
//! | `angle` | a_k | rad |
//! | `slope` | s_k | rad/cycle |
//! | `curvature` | c_k | rad/cycle² |
//!
//! Pinned by: tests/gait_curves.rs, tests/gait_accuracy.rs.

use super::jet::Jet;
use super::quintic::{End, quintic};
use super::speed_law::SpeedLaw;

/// A knot of a curve against dimensionless speed.
#[derive(Debug, Clone, PartialEq)]
pub struct Knot {
    /// Name, such as `swing peak`.
    pub name: String,
    /// The sub-cycle that is activated here, if one is.
    pub begins: Option<String>,
    /// Time [cycles].
    pub phase: SpeedLaw,
    /// Angle [rad].
    pub angle: SpeedLaw,
    /// First derivative [rad/cycle].
    pub slope: SpeedLaw,
    /// Second derivative [rad/cycle²].
    pub curvature: SpeedLaw,
    /// Share of a change of step height that this knot takes, 0 to 1.
    pub height_share: f64,
}

impl Knot {
    /// The knot with its distance from the joint's neutral angle times a factor.
    #[must_use]
    pub fn scaled_about(&self, neutral: f64, factor: f64) -> Knot {
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
    pub(super) fn of(knots: Vec<Knot>) -> CyclicCurve {
        debug_assert!(knots.len() >= 2, "a curve needs two knots");
        CyclicCurve { knots }
    }

    /// The knots, in order.
    #[must_use]
    pub fn knots(&self) -> &[Knot] {
        &self.knots
    }

    /// The curve with each knot replaced by its image.
    #[must_use]
    pub fn mapped(&self, image: impl FnMut(&Knot) -> Knot) -> CyclicCurve {
        CyclicCurve { knots: self.knots.iter().map(image).collect() }
    }

    /// Phase of knot k [cycles], counted on over the end of the cycle: knot n is knot 0 one cycle later.
    #[must_use]
    pub fn knot_phase(&self, k: usize, speed: f64) -> f64 {
        let n = self.knots.len();
        self.knots[k % n].phase.at(speed) + (k / n) as f64
    }

    /// The phase of a cycle that begins at knot 0: `phase` less the whole cycles.
    fn wrapped(&self, phase: Jet, speed: f64) -> Jet {
        let first = self.knot_phase(0, speed);
        let whole = (phase.value - first).floor();
        let phase = phase - whole;
        // A tiny negative difference rounds up to a whole cycle.
        if phase.value - first < 1.0 { phase } else { phase - 1.0 }
    }

    /// The segment that a phase lies on; segment k begins at knot k.
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

    /// The polynomial of one segment, which is meant for phases on it.
    #[must_use]
    pub fn on_segment(&self, k: usize, phase: Jet, speed: Jet) -> Jet {
        let n = self.knots.len();
        let (from, to) = (&self.knots[k], &self.knots[(k + 1) % n]);
        let start = from.phase.jet(speed);
        let mut end = to.phase.jet(speed);
        if k + 1 == n {
            end.value += 1.0;
        }
        let width = end - start;
        let u = (self.wrapped(phase, speed.value) - start) * width.reciprocal();
        quintic(self.end(from, width, speed), self.end(to, width, speed), u)
    }

    fn end(&self, knot: &Knot, width: Jet, speed: Jet) -> End {
        End {
            value: knot.angle.jet(speed),
            slope: knot.slope.jet(speed) * width,
            curvature: knot.curvature.jet(speed) * width * width,
        }
    }
}
