//! Outcome and cost of trials.

use serde::{Deserialize, Serialize};

/// Weight of the mean square deviation from the plan [1/rad²]: 0.1 rad cost as much as falls of one push in twenty.
const DEVIATION: f64 = 10.0;
/// Weight of the mean square of torques over their strength.
const EFFORT: f64 = 0.5;
/// Weight of the error of the speed, as a share.
const SPEED: f64 = 0.5;

/// Cost and figures of a walk and its pushes.
///
/// With the time t until a fall after the push and the required time T,
///
///   cost = mean over pushes of { 0 if it is survived, else 2 - t/T } + 10 D² + E²/2 + V/2
///
/// D is the root mean square deviation of hips, knees, ankles and the lumbar joint from the plan [rad]. E is the same
/// deviation of their torques as shares of their strength, V the mean difference between speed and planned speed, as a
/// share of the planned speed. All three come from level walking and from the pushes that were survived.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TrialOutcome {
    /// The cost; without a number if there are no gains.
    #[serde(deserialize_with = "crate::numerics::or_nan")]
    pub cost: f64,
    /// Number of pushes.
    pub pushes: usize,
    /// Number of pushes that were survived.
    pub survived: usize,
    /// D [rad].
    pub deviation: f64,
    /// E.
    pub effort: f64,
    /// V.
    pub speed_error: f64,
}

impl TrialOutcome {
    /// The outcome of settings without gains: the Riccati equation does not converge.
    #[doc(hidden)] // for tests
    pub fn without_gains(pushes: usize) -> TrialOutcome {
        TrialOutcome { cost: f64::NAN, pushes, survived: 0, deviation: 0.0, effort: 0.0, speed_error: 0.0 }
    }
}

/// Sums over trials.
#[derive(Debug, Clone, Default)]
pub struct Sums {
    pushes: usize,
    survived: usize,
    falls: f64,
    samples: f64,
    deviation: f64,
    effort: f64,
    speed_error: f64,
    speeds: f64,
}

impl Sums {
    /// Adds mean squares of deviation and effort at an instant.
    pub fn sample(&mut self, [deviation, effort]: [f64; 2]) {
        self.samples += 1.0;
        self.deviation += deviation;
        self.effort += effort;
    }

    /// Adds the speed of a trial without a fall, relative to the planned speed.
    pub fn speed(&mut self, share: f64) {
        self.speeds += 1.0;
        self.speed_error += (share - 1.0).abs();
    }

    /// Adds a push that ended in a fall after a share of the time.
    pub fn fell(&mut self, share: f64) {
        self.pushes += 1;
        self.falls += 2.0 - share.clamp(0.0, 1.0);
    }

    /// Adds a push that was survived, with its own sums.
    pub fn survived(&mut self, own: &Sums) {
        self.pushes += 1;
        self.survived += 1;
        self.samples += own.samples;
        self.deviation += own.deviation;
        self.effort += own.effort;
        self.speed_error += own.speed_error;
        self.speeds += own.speeds;
    }

    /// The outcome of the trials that were added.
    pub fn outcome(&self) -> TrialOutcome {
        let samples = self.samples.max(1.0);
        let (deviation, effort) = (self.deviation / samples, self.effort / samples);
        // Where nothing walked, nothing had the speed.
        let speed_error = if self.speeds > 0.0 { self.speed_error / self.speeds } else { 1.0 };
        let falls = self.falls / self.pushes.max(1) as f64;
        TrialOutcome {
            cost: falls + DEVIATION * deviation + EFFORT * effort + SPEED * speed_error,
            pushes: self.pushes,
            survived: self.survived,
            deviation: deviation.sqrt(),
            effort: effort.sqrt(),
            speed_error,
        }
    }
}
