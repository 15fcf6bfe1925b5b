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
//! The factors on step length and frequency are applied to these results and scale the speed as well. The curves are evaluated at the law
//! speed; a step length that differs from the preferred one scales them ([`Walk`](super::Walk)).

use super::error::GaitError;
use super::gait_settings::{Gait, Pace, Speed, Style};
use super::jet::Jet;
use super::stride::StrideLaw;

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
        above_zero(what, factor)?;
    }
    let preferred = StrideLaw { leg_length, exponent, length_scale: 1.0, cadence_scale: 1.0 };
    let (law_speed, length, cadence) = share(pace, gait.style, &preferred)?;
    let length_scale = length * pace.length_scale;
    let cadence_scale = cadence * pace.cadence_scale;
    Ok((StrideLaw { length_scale, cadence_scale, ..preferred }, law_speed))
}

/// Law speed, and step length and frequency relative to the preferred ones at that speed.
fn share(pace: &Pace, style: Style, preferred: &StrideLaw) -> Result<(f64, f64, f64), GaitError> {
    let speed = match pace.speed {
        Some(Speed::MetersPerSecond(speed)) => Some(above_zero("speed [m/s]", speed)?),
        Some(Speed::Dimensionless(speed)) => Some(above_zero("dimensionless speed", speed)? * preferred.unit_speed()),
        None => None,
    };
    let step = pace.step_length.map(|length| above_zero("step length [m]", length)).transpose()?;
    let frequency = pace.step_frequency.map(|rate| above_zero("step frequency [steps/s]", rate)).transpose()?;
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
