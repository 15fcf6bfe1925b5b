//! Sub-cycles: the flexions and extensions in the cycle of a joint.
//!
//! Names after Philippson 1905 as Nilsson, Thorstensson, Halbertsma 1985 use them (from memory, unverified): F flexion,
//! from before foot off; E1 extension in late swing until foot strike; E2 yield under load; E3 extension in later
//! stance. The joints have these sub-cycles:
//!
//! | joint | sub-cycle | from | to |
//! |---|---|---|---|
//! | hip | E1 | largest flexion in late swing | contact |
//! | hip | E3 | contact | largest extension |
//! | hip | F | largest extension | largest flexion |
//! | knee | E1 | swing peak | terminal minimum, about contact |
//! | knee | E2 | terminal minimum | stance peak (flexion: the yield) |
//! | knee | E3 | stance peak | stance minimum |
//! | knee | F | stance minimum | swing peak |
//! | ankle | E1 | swing dorsiflexion | contact |
//! | ankle | L | contact | first plantarflexion (our name: loading) |
//! | ankle | E2 | first plantarflexion | largest dorsiflexion (the yield) |
//! | ankle | E3 | largest dorsiflexion | push-off peak |
//! | ankle | F | push-off peak | swing dorsiflexion |
//!
//! In style 1997 a sub-cycle is one quintic; in style `knots` it can contain further knots.

use super::cyclic_curve::CyclicCurve;

/// A part of a curve between the knots at its start and its end.
#[derive(Debug, Clone, PartialEq)]
pub struct SubCycle {
    /// Name.
    pub name: String,
    /// Knot at the start.
    pub from: usize,
    /// Knot at the end; knot n + k is knot k of the next cycle.
    pub to: usize,
}

impl SubCycle {
    /// The sub-cycles of a curve, in the order of their starts; the whole cycle if no knot names a sub-cycle.
    #[must_use]
    pub fn of(curve: &CyclicCurve) -> Vec<SubCycle> {
        let knots = curve.knots();
        let begin = |k: usize| knots[k].begins.clone().map(|name| (k, name));
        let begins: Vec<(usize, String)> = (0..knots.len()).filter_map(begin).collect();
        let Some((first, _)) = begins.first() else {
            return vec![SubCycle { name: "cycle".into(), from: 0, to: knots.len() }];
        };
        let ends = begins.iter().skip(1).map(|(k, _)| *k).chain([first + knots.len()]);
        begins.iter().zip(ends).map(|((from, name), to)| SubCycle { name: name.clone(), from: *from, to }).collect()
    }

    /// Whether a segment of the curve belongs to the sub-cycle.
    #[must_use]
    pub fn has_segment(&self, segment: usize, knots: usize) -> bool {
        (self.from..self.to).contains(&segment) || (self.from..self.to).contains(&(segment + knots))
    }

    /// Start and end [cycles]; the end is greater than the start.
    #[must_use]
    pub fn window(&self, curve: &CyclicCurve, speed: f64) -> [f64; 2] {
        [self.from, self.to].map(|k| curve.knot_phase(k, speed))
    }

    /// Angles at start and end [rad].
    #[must_use]
    pub fn bounds(&self, curve: &CyclicCurve, speed: f64) -> [f64; 2] {
        let knots = curve.knots();
        [self.from, self.to].map(|k| knots[k % knots.len()].angle.at(speed))
    }

    /// The segment of this sub-cycle that is evaluated where the phase is on segment `at` of a curve: this one, or the
    /// last one of the sub-cycle.
    #[must_use]
    pub fn segment(&self, at: usize, knots: usize) -> usize {
        if self.has_segment(at, knots) { at } else { (self.to - 1) % knots }
    }
}
