//! How a figure in three dimensions answers a strong push: it tries in the simulator what it may do.
//!
//! Each candidate is simulated for a time T with the feedback of the plan, in a world of the figure alone on level
//! ground, and the one with the least cost is followed,
//!
//!   J = (x - x*)ᵀ P (x - x*) at T + w_a (α² + β²) + w_f f²          or 10⁶ (2 - t/T) after a fall at t
//!
//! | code | symbol | unit | meaning |
//! |---|---|---|---|
//! | `WalkController::cost_to_go` | (x - x*)ᵀ P (x - x*) | 1 | P of the Riccati equation at this moment of the plan |
//! | `StepChange` | α, β, f | rad, rad, 1 | further adduction and flexion of the swinging hip, faster plan |
//! | `WORTH_IT` | | 1 | pushes of 100 N for 0.2 s cost 1 to 4 in walking, of 150 N 3 to 15 |
//! | `AHEAD_S` | T | s | in walking, standing and stepping |
//!
//! In walking, while the deviation costs more than 2, the change of the step under way is chosen every 0.15 s, unless
//! without another change the cost is at most 2 after the trial. In standing, once the deviation costs more than 1, the
//! figure looks ahead every 0.05 s whether it would fall. If so, it steps: it enters its steps on the spot (left foot,
//! then right foot, to standing with the feet side by side) at one of six moments before the first foot is down, or
//! their mirror image, and the change of that step is chosen. While it steps, the change is chosen again every 0.1 s,
//! and all of this if the figure would fall nevertheless. In level walking, in quiet standing, and after pushes in
//! standing that feedback alone can take, nothing changes.
//!
//! Source: foot placement after the predicted state as in Yin, Loken, van de Panne 2007 (unverified), but chosen by
//! prediction instead of a linear law. Pinned by: tests/physical_walk.rs.

use super::recovery::StepChange;
use super::standing::{Moment, Stage};
use super::walk_plan::FIRST_DOWN;

/// Cost of a deviation above which a step is planned again, and above which a figure that stands looks ahead.
const WORTH_IT: f64 = 2.0;
const WORTH_A_LOOK: f64 = 1.0;
/// Cost above which a figure that stands or steps is as good as fallen.
const LOST: f64 = 1e3;
/// Time between two choices, and times that a candidate is simulated [s].
const EVERY_S: Times = Times { walking: 0.15, standing: 0.05, stepping: 0.1 };
const AHEAD_S: Times = Times { walking: 0.9, standing: 1.5, stepping: 1.0 };
/// Cost of a fall at the end of a trial; an earlier one costs up to twice as much.
const FALL: f64 = 1e6;

/// Candidates, one after the other: adductions, phases, flexions, and differences around the best one.
const ADDUCTIONS: [f64; 6] = [-0.35, -0.2, -0.1, 0.0, 0.1, 0.2];
const FASTER: [f64; 4] = [0.0, 0.5, 1.0, 1.5];
const FLEXIONS: [f64; 4] = [-0.2, -0.1, 0.1, 0.2];
const FINER: [[f64; 2]; 4] = [[-0.05, 0.0], [0.05, 0.0], [0.0, 0.3], [0.0, -0.3]];
/// Moments at which steps out of standing may be entered, a share of the time until the first foot is down, and
/// adductions of the first step of which the best is refined.
const ENTRIES: [f64; 6] = [0.0, 0.15, 0.3, 0.45, 0.6, 0.75];
const OUTWARD: [f64; 2] = [0.0, -0.3];

/// Times by what the figure does [s].
struct Times {
    walking: f64,
    standing: f64,
    stepping: f64,
}

/// A moment of the plan to go on from, and a change of the step there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Course {
    pub(super) at: Moment,
    pub(super) change: StepChange,
}

/// Trials of a figure from its present state.
pub(super) struct Trials<'a> {
    /// What it does now.
    pub(super) present: Course,
    /// Time steps of its steps on the spot; none if it makes none.
    pub(super) steps: Option<usize>,
    /// The cost-to-go of its deviation now.
    pub(super) cost_to_go: &'a dyn Fn() -> f64,
    /// The cost-to-go after a course was followed for a time [s], or the share of the time at which it fell.
    pub(super) trial: &'a dyn Fn(Course, f64) -> Result<f64, f64>,
}

impl Trials<'_> {
    /// What the figure does from now on, if anything else than before, and the time until the next trials [s].
    pub(super) fn chosen(&self) -> (Option<Course>, f64) {
        let present = self.present;
        match (present.at.stage, self.steps) {
            (Stage::Walking, _) if (self.cost_to_go)() > WORTH_IT => {
                let before = self.cost(present, AHEAD_S.walking);
                let (_, best) =
                    if before <= WORTH_IT { (before, present) } else { self.best(present, AHEAD_S.walking, before) };
                (Some(best), EVERY_S.walking)
            }
            (Stage::Standing | Stage::Stepping(_), Some(steps)) if (self.cost_to_go)() > WORTH_A_LOOK => {
                let wait_s = if present.at.stage == Stage::Standing { EVERY_S.standing } else { EVERY_S.stepping };
                (self.of_standing(present, steps), wait_s)
            }
            _ => (None, 0.0),
        }
    }

    /// Standing on, stepping on, or other steps.
    fn of_standing(&self, present: Course, steps: usize) -> Option<Course> {
        let stands = present.at.stage == Stage::Standing;
        let (ahead_s, enough) = if stands { (AHEAD_S.standing, LOST) } else { (AHEAD_S.stepping, WORTH_IT) };
        let before = self.cost(present, ahead_s);
        if before <= enough {
            return None;
        }
        let mut best = if stands { (before, present) } else { self.best(present, ahead_s, before) };
        if best.0 > LOST {
            for is_mirrored in [false, true] {
                let enters = |share: f64| {
                    let step = (share * FIRST_DOWN * steps as f64) as usize;
                    let at = Moment { stage: Stage::Stepping(step), is_mirrored, ..present.at };
                    OUTWARD.map(|adduction| {
                        let course = Course { at, change: StepChange { adduction, ..StepChange::default() } };
                        (self.cost(course, AHEAD_S.stepping), course)
                    })
                };
                let least = ENTRIES.into_iter().flat_map(enters).min_by(|a, b| a.0.total_cmp(&b.0));
                let better = least.map(|(cost, course)| self.best(course, AHEAD_S.stepping, cost));
                best = better.into_iter().fold(best, |best, other| if other.0 < best.0 { other } else { best });
            }
        }
        Some(best.1)
    }

    /// The cost of a course.
    fn cost(&self, course: Course, ahead_s: f64) -> f64 {
        match (self.trial)(course, ahead_s) {
            Ok(after) if after.is_finite() => after + course.change.cost(),
            Ok(_) => 2.0 * FALL,
            Err(share) => FALL * (2.0 - share),
        }
    }

    /// The change of a course with the least cost: one entry after the other, then finer; `cost` is that of the course.
    fn best(&self, present: Course, ahead_s: f64, cost: f64) -> (f64, Course) {
        let mut best = (cost, present);
        let mut better = |change: StepChange| {
            let course = Course { change, ..present };
            let cost = self.cost(course, ahead_s);
            if cost < best.0 {
                best = (cost, course);
            }
            best.1.change
        };
        let mut at = present.change;
        for adduction in ADDUCTIONS {
            at = better(StepChange { adduction, ..present.change });
        }
        let coarse = at;
        for faster in FASTER {
            at = better(StepChange { faster, ..coarse });
        }
        let coarse = at;
        for flexion in FLEXIONS {
            at = better(StepChange { flexion, ..coarse });
        }
        let StepChange { adduction, flexion, faster } = at;
        for [turn, share] in FINER {
            better(StepChange { adduction: adduction + turn, flexion, faster: faster + share });
        }
        best
    }
}
