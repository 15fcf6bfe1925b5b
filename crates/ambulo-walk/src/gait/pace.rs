//! Completes speed, step length and step frequency of a gait for a leg length by V = step length × frequency.
//!
//! | given | law speed | step length | frequency |
//! |---|---|---|---|
//! | nothing | free walking | preferred | preferred |
//! | speed | speed | preferred | preferred |
//! | step length, or frequency | the speed at which it is preferred | preferred | preferred |
//! | step length and frequency, style 1997 | the speed at which the step is preferred | preferred | as given |
//! | two of the three otherwise, or all | speed | as given or V / frequency | as given or V / step length |
//!
//! The factors on step length and frequency are applied to these results and scale the speed as well. The curves are
//! evaluated at the law speed; a step length that differs from the preferred one scales them ([`Walk`](super::Walk)).
//! Given and resulting numbers must be in the ranges of walking, which are wide: they exclude typing errors, and walks
//! with too many or too few time steps to compute.

use super::error::GaitError;
use super::gait_settings::{Gait, Pace, Speed, Style};
use super::jet::Jet;
use super::stride::StrideLaw;

/// The numbers that are allowed for a quantity, with the reason.
pub(super) struct Range {
    /// Quantity and unit.
    what: &'static str,
    bounds: [f64; 2],
    /// The bounds and the reason, for messages.
    pub(super) expected: &'static str,
}

/// Walking speeds [m/s].
pub(super) const SPEED: Range = Range {
    what: "speed [m/s]",
    bounds: [0.05, 5.0],
    expected: "0.05 to 5 m/s, because slower is standing and faster is running",
};
/// Step lengths [m].
pub(super) const STEP_LENGTH: Range = Range {
    what: "step length [m]",
    bounds: [0.02, 3.0],
    expected: "0.02 to 3 m, because shorter is standing and longer is a leap",
};
/// Step frequencies [steps/min].
pub(super) const CADENCE: Range = Range {
    what: "cadence [steps/min]",
    bounds: [5.0, 1000.0],
    expected: "5 to 1000 steps/min, because slower is standing and legs do not step faster",
};
/// Factors on steps; others are probably typing errors.
pub(super) const FACTOR: Range = Range { what: "factor", bounds: [0.1, 10.0], expected: "a factor from 0.1 to 10" };
/// Rounding errors that are allowed at the bounds.
const SLACK: f64 = 1e-9;

impl Range {
    pub(super) fn contains(&self, value: f64) -> bool {
        let [lowest, highest] = self.bounds;
        (lowest * (1.0 - SLACK)..=highest * (1.0 + SLACK)).contains(&value)
    }

    fn check(&self, what: &'static str, value: f64) -> Result<f64, GaitError> {
        above_zero(what, value)?;
        if self.contains(value) { Ok(value) } else { Err(number(what, value, self.expected)) }
    }

    /// A value that is given; the gait's factors scale it.
    fn given(&self, value: f64, factor: f64) -> Result<f64, GaitError> {
        self.check(self.what, value * factor).map(|_| value)
    }
}

/// Accepted leg lengths [m].
const LEG_LENGTHS: [f64; 2] = [0.25, 1.5];
/// Largest relative error of speed = step length × frequency if all three are given.
pub(super) const AGREEMENT: f64 = 1e-6;

/// The law of step length and frequency of a gait for a leg length, and the law speed.
pub(super) fn resolve(gait: &Gait, leg_length: f64) -> Result<(StrideLaw, f64), GaitError> {
    if !(LEG_LENGTHS[0]..=LEG_LENGTHS[1]).contains(&leg_length) {
        return Err(number("leg length [m]", leg_length, "0.25 m to 1.5 m"));
    }
    let exponent = gait.cadence_exponent();
    if !(0.0..1.0).contains(&exponent) {
        return Err(number("cadence exponent", exponent, "an exponent from 0 to below 1"));
    }
    let pace = &gait.pace;
    for (what, factor) in [
        ("factor on the step length", pace.length_scale),
        ("factor on the step frequency", pace.cadence_scale),
        ("factor on the step height", gait.step_height),
    ] {
        FACTOR.check(what, factor)?;
    }
    let preferred = StrideLaw { leg_length, exponent, length_scale: 1.0, cadence_scale: 1.0 };
    let (law_speed, length, cadence) = share(pace, gait.style, &preferred)?;
    let length_scale = length * pace.length_scale;
    let cadence_scale = cadence * pace.cadence_scale;
    let law = StrideLaw { length_scale, cadence_scale, ..preferred };
    check_steps(&law, law_speed)?;
    Ok((law, law_speed))
}

/// Speed, step length and cadence must be possible, also those that follow from the given ones.
pub(super) fn check_steps(law: &StrideLaw, law_speed: f64) -> Result<(), GaitError> {
    SPEED.check("resulting speed [m/s]", law.speed(law_speed))?;
    STEP_LENGTH.check("resulting step length [m]", law.step_length(law_speed))?;
    let cadence = 120.0 * law.cycle_rate(Jet::constant(law_speed)).value;
    CADENCE.check("resulting cadence [steps/min]", cadence).map(|_| ())
}

/// Law speed, and step length and frequency relative to the preferred ones at that speed.
fn share(pace: &Pace, style: Style, preferred: &StrideLaw) -> Result<(f64, f64, f64), GaitError> {
    let (long, quick) = (pace.length_scale, pace.cadence_scale);
    let speed = match pace.speed {
        Some(Speed::MetersPerSecond(speed)) => Some(SPEED.given(speed, long * quick)?),
        Some(Speed::Dimensionless(speed)) => Some(above_zero("dimensionless speed", speed)? * preferred.unit_speed()),
        None => None,
    };
    let step = pace.step_length.map(|length| STEP_LENGTH.given(length, long)).transpose()?;
    let frequency = pace.step_frequency.map(|rate| CADENCE.given(rate, 60.0 * quick)).transpose()?;
    let frequency_at = |law_speed: f64| 2.0 * preferred.cycle_rate(Jet::constant(law_speed)).value;
    let (step, frequency) = match (speed, step, frequency) {
        (None, None, None) => return Ok((Gait::DEFAULT_SPEED, 1.0, 1.0)),
        (Some(speed), None, None) => return Ok((preferred.law_speed(speed), 1.0, 1.0)),
        (None, Some(step), None) => return Ok((preferred.law_speed_of_step(step), 1.0, 1.0)),
        (None, None, Some(frequency)) => {
            let expected = "a number above 0 if the step frequency is given without a speed";
            let law_speed = preferred.law_speed_of_frequency(frequency);
            return Ok((law_speed.ok_or(number("cadence exponent", preferred.exponent, expected))?, 1.0, 1.0));
        }
        // In the style of the paper the angles follow the step length, not the frequency.
        (None, Some(step), Some(frequency)) if style == Style::Paper1997 => {
            let law_speed = preferred.law_speed_of_step(step);
            return Ok((law_speed, 1.0, frequency / frequency_at(law_speed)));
        }
        (None, Some(step), Some(frequency)) => (step, frequency),
        (Some(speed), Some(step), None) => (step, speed / step),
        (Some(speed), None, Some(frequency)) => (speed / frequency, frequency),
        (Some(speed), Some(step), Some(frequency)) => agreed(speed, step, frequency)?,
    };
    let law_speed = preferred.law_speed(step * frequency);
    Ok((law_speed, step / preferred.step_length(law_speed), frequency / frequency_at(law_speed)))
}

/// Step length and frequency if all three are given, which must satisfy speed = step length × frequency.
fn agreed(speed: f64, step_length: f64, step_frequency: f64) -> Result<(f64, f64), GaitError> {
    if (step_length * step_frequency - speed).abs() > AGREEMENT * speed {
        return Err(GaitError::Contradiction { speed, step_length, step_frequency });
    }
    Ok((step_length, step_frequency))
}

pub(super) fn above_zero(what: &'static str, value: f64) -> Result<f64, GaitError> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(number(what, value, "a number above zero")) }
}

pub(super) fn number(what: &'static str, found: f64, expected: &'static str) -> GaitError {
    GaitError::Number { what, found, expected }
}
