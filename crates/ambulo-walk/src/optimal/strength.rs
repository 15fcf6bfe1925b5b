//! Strength of a joint as a function of angle and speed.
//!
//! The isometric moment of `strength.csv` (its header names the source) is scaled with body mass times stature, as is
//! usual in dynamometry (Anderson 2007: share of body weight times height).
//!
//! Speed multiplies it by Hill's factor. With w > 0 the speed at which the muscles shorten:
//!
//!   f(w) = (2 c₄c₅ + w (c₅ - 3c₄)) / (2 c₄c₅ + w (2c₅ - 4c₄))     f(0) = 1, f(c₄) = 3/4, f(c₅) = 1/2, never below 0
//!   f(-w) = 1 + (e - 1) w / (w + w_e)                         rising to e, with the slope of the other branch at w = 0
//!
//! | code        | symbol | unit  | meaning                                              |
//! | `at_75`     | c₄     | rad/s | speed at which 3/4 of the isometric moment remain    |
//! | `at_50`     | c₅     | rad/s | speed at which 1/2 of it remains                     |
//! | `eccentric` | e      | 1     | largest moment while the muscle is stretched         |
//!
//! Source: Anderson, Madigan, Nussbaum 2007, J Biomech 40:3105, equation and table 3 (men of 18 to 25), the table as
//! transcribed in RBDL's `Millard2016TorqueMuscle` (read). e = 1.4: Thelen 2003 (unverified). The stretching branch is
//! ours. Not handled: tendons that recoil, two-joint muscles whose length the other joint changes.
//! Pinned by: tests/feasibility.rs

use crate::model::anatomy::Movement;
use crate::numerics::elementary::hypot;

/// Isometric moments, with their source.
const TABLE: &str = include_str!("strength.csv");
/// Largest moment of muscles while they are stretched, as a share of the isometric one.
pub const ECCENTRIC: f64 = 1.4;
/// Smooths the share of the isometric moment near zero, for an optimiser: our choice.
const LEAST_SHARE: f64 = 0.2;
/// Standard gravity [m/s²].
const GRAVITY: f64 = 9.80665;
/// Mass times stature of the man of the table [kg.m].
const REFERENCE: f64 = 72.6 * 1.80;

/// Decrease of a muscle group's moment with the speed of shortening.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hill {
    /// Speed at which three quarters of the isometric moment remain [rad/s].
    pub at_75: f64,
    /// Speed at which half of it remains [rad/s].
    pub at_50: f64,
}

// Anderson 2007, table 3, men of 18 to 25.
const HIP_FLEXORS: Hill = Hill { at_75: 2.095, at_50: 4.267 };
const HIP_EXTENSORS: Hill = Hill { at_75: 1.578, at_50: 3.190 };
const KNEE_EXTENSORS: Hill = Hill { at_75: 1.517, at_50: 3.952 };
const KNEE_FLEXORS: Hill = Hill { at_75: 2.008, at_50: 5.233 };
const DORSIFLEXORS: Hill = Hill { at_75: 0.699, at_50: 1.940 };
const PLANTARFLEXORS: Hill = Hill { at_75: 0.987, at_50: 3.558 };

impl Hill {
    /// Share of the isometric moment at a speed of shortening [rad/s], which is negative while the muscles are
    /// stretched.
    #[must_use]
    pub fn factor(self, speed: f64, eccentric: f64) -> f64 {
        let product = 2.0 * self.at_75 * self.at_50;
        if speed >= 0.0 {
            let share = (product + speed * (self.at_50 - 3.0 * self.at_75))
                / (product + speed * (2.0 * self.at_50 - 4.0 * self.at_75));
            return share.max(0.0);
        }
        let gain = eccentric - 1.0;
        let half = gain * product / (self.at_50 - self.at_75);
        1.0 + gain * speed / (speed - half)
    }

    /// The share, which may be negative at high speeds, and its derivative by the speed [s/rad].
    fn sloped(self, speed: f64, eccentric: f64) -> [f64; 2] {
        let product = 2.0 * self.at_75 * self.at_50;
        if speed >= 0.0 {
            let [up, down] = [self.at_50 - 3.0 * self.at_75, 2.0 * self.at_50 - 4.0 * self.at_75];
            let [above, below] = [product + speed * up, product + speed * down];
            return [above / below, product * (up - down) / (below * below)];
        }
        let gain = eccentric - 1.0;
        let half = gain * product / (self.at_50 - self.at_75);
        [1.0 + gain * speed / (speed - half), -gain * half / (speed - half).powi(2)]
    }
}

/// Isometric moments of one coordinate as a function of its angle, with the effect of speed in both directions.
#[derive(Debug, Clone, PartialEq)]
pub struct StrengthCurve {
    /// Angles, rising [rad].
    pub angles: Vec<f64>,
    /// Largest positive moment at each angle, above zero [N.m].
    pub positive: Vec<f64>,
    /// Largest negative moment at each angle, as a number above zero [N.m].
    pub negative: Vec<f64>,
    /// Effect of speed on the positive and on the negative moment; `None`: as for the joint that the curve is used for.
    pub hill: Option<[Hill; 2]>,
}

impl StrengthCurve {
    /// Largest moment [N.m] at an angle [rad] and a rate [rad/s], in the direction of `sign`. Constant beyond the ends
    /// of the table.
    #[must_use]
    pub fn available(&self, angle: f64, rate: f64, sign: f64, eccentric: f64) -> f64 {
        let hill = self.hill.unwrap_or(Hill::UNKNOWN);
        let (isometric, hill) = if sign >= 0.0 { (&self.positive, hill[0]) } else { (&self.negative, hill[1]) };
        let shortening = if sign >= 0.0 { rate } else { -rate };
        crate::motion::interpolate(&self.angles, isometric, angle) * hill.factor(shortening, eccentric)
    }

    /// As [`StrengthCurve::available`], for an optimiser: it stays above zero at any speed, and comes with its
    /// derivatives by angle [N.m/rad] and rate [N.m.s/rad]. Hill's share f becomes (f + √(f² + ε²)) / 2 with ε = 0.2,
    /// at most 1 % more at f ≥ 1 and 0.1 where no moment is left.
    #[must_use]
    pub(crate) fn smooth(&self, angle: f64, rate: f64, sign: f64) -> [f64; 3] {
        let hill = self.hill.unwrap_or(Hill::UNKNOWN);
        let (isometric, hill) = if sign >= 0.0 { (&self.positive, hill[0]) } else { (&self.negative, hill[1]) };
        let ([moment, by_angle], [share, by_speed]) =
            (sloped(&self.angles, isometric, angle), hill.sloped(rate * sign.signum(), ECCENTRIC));
        let root = hypot(share, LEAST_SHARE);
        let smooth = 0.5 * (share + root);
        let by_rate = 0.5 * (1.0 + share / root) * by_speed * sign.signum();
        [moment * smooth, by_angle * smooth, moment * by_rate]
    }

    /// The curve of a share of the muscles.
    #[must_use]
    pub(crate) fn scaled(mut self, share: f64) -> StrengthCurve {
        self.positive.iter_mut().chain(&mut self.negative).for_each(|moment| *moment *= share);
        self
    }

    /// The curve for a coordinate with the opposite sign.
    #[must_use]
    pub fn reversed(&self) -> StrengthCurve {
        let turned = |values: &[f64]| values.iter().rev().copied().collect::<Vec<f64>>();
        StrengthCurve {
            angles: self.angles.iter().rev().map(|a| -a).collect(),
            positive: turned(&self.negative),
            negative: turned(&self.positive),
            hill: self.hill.map(|[positive, negative]| [negative, positive]),
        }
    }

    /// The built-in curve of a movement for a person, positive in the direction of the movement; `None` if the table
    /// has none.
    #[must_use]
    pub fn built_in(movement: Movement, mass_kg: f64, height_m: f64) -> Option<StrengthCurve> {
        let (_, coordinate, sign) = *COORDINATES.iter().find(|(of, ..)| *of == movement)?;
        let scale = mass_kg * height_m / REFERENCE;
        let rows = TABLE.lines().filter_map(row).filter(|(name, _)| *name == coordinate).map(|(_, numbers)| numbers);
        let (mut angles, mut positive, mut negative) = (Vec::new(), Vec::new(), Vec::new());
        for [angle_deg, up, down] in rows {
            angles.push(angle_deg.to_radians());
            positive.push(scale * up);
            negative.push(-scale * down);
        }
        let hill = Some(Hill::of_direction(movement, sign));
        let in_table = StrengthCurve { angles, positive, negative, hill };
        Some(if sign < 0.0 { in_table.reversed() } else { in_table })
    }

    /// The curve of any movement for a person: the built-in one, or the same isometric moments at all angles.
    pub(crate) fn of_movement(movement: Option<Movement>, mass_kg: f64, height_m: f64) -> StrengthCurve {
        let constant = || {
            let [positive, negative] = strength_of(movement).map(|share| vec![share * mass_kg * GRAVITY * height_m]);
            StrengthCurve { angles: vec![0.0], positive, negative, hill: None }
        };
        movement.and_then(|known| StrengthCurve::built_in(known, mass_kg, height_m)).unwrap_or_else(constant)
    }
}

impl Hill {
    /// Muscles that the source lacks are treated like the hip extensors.
    #[doc(hidden)]
    pub const UNKNOWN: [Hill; 2] = [HIP_EXTENSORS; 2];

    /// The muscles of the positive and of the negative moment of a coordinate that increases (`sign` above zero) or
    /// decreases during a movement.
    #[must_use]
    pub fn of_direction(movement: Movement, sign: f64) -> [Hill; 2] {
        let [agonists, antagonists] = match movement {
            Movement::HipFlexion => [HIP_FLEXORS, HIP_EXTENSORS],
            Movement::KneeFlexion => [KNEE_FLEXORS, KNEE_EXTENSORS],
            Movement::AnkleDorsiflexion => [DORSIFLEXORS, PLANTARFLEXORS],
            _ => Hill::UNKNOWN,
        };
        if sign < 0.0 { [antagonists, agonists] } else { [agonists, antagonists] }
    }
}

/// Movements of the table, their coordinates there and the signs of these: knee extension is positive in gait2392.
const COORDINATES: [(Movement, &str, f64); 4] = [
    (Movement::HipFlexion, "hip_flexion", 1.0),
    (Movement::HipAdduction, "hip_adduction", 1.0),
    (Movement::KneeFlexion, "knee_angle", -1.0),
    (Movement::AnkleDorsiflexion, "ankle_angle", 1.0),
];

/// Coordinate, angle [deg], largest positive and negative moment [N.m]; `None` for comments and the header.
fn row(line: &str) -> Option<(&str, [f64; 3])> {
    let (name, numbers) = line.split_once(',')?;
    let numbers: Vec<f64> = numbers.split(',').map(str::parse).collect::<Result<_, _>>().ok()?;
    Some((name, numbers.try_into().ok()?))
}

/// Isometric strength of movements that the table lacks, as shares of body weight times stature: our estimates.
fn strength_of(movement: Option<Movement>) -> [f64; 2] {
    match movement {
        Some(Movement::HipRotation) => [0.058; 2],
        Some(Movement::SubtalarInversion) => [0.035; 2],
        Some(Movement::ToeExtension) => [0.0175; 2],
        Some(Movement::TrunkLean | Movement::TrunkObliquity | Movement::TrunkRotation) => [0.175; 2],
        _ => [0.047; 2],
    }
}

/// Linear interpolation of a table, constant beyond its ends, and its slope.
fn sloped(x: &[f64], y: &[f64], at: f64) -> [f64; 2] {
    let next = x.partition_point(|&x| x <= at);
    if next == 0 || next == x.len() {
        return [y[next.min(x.len() - 1)], 0.0];
    }
    let slope = (y[next] - y[next - 1]) / (x[next] - x[next - 1]);
    [y[next - 1] + slope * (at - x[next - 1]), slope]
}
