//! Whether a contact sticks or slips, from its force and its slip.

use crate::numerics::elementary::hypot;

/// Relative distance from the surface of the cone within which friction counts as being on it.
const EDGE: f64 = 1e-10;
/// Slip speed, in units of friction times mobility, above which the direction of friction is fixed.
const RIGID: f64 = 1e12;

/// State of the friction of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Friction {
    /// Fixed at its current value.
    Given,
    /// Both components are unknown.
    Sticks,
    /// On the cone along `along`, with a compliant component perpendicular to it.
    Slips { along: [f64; 2], compliance: f64 },
}

/// State of friction: sticking inside the cone, and on it if friction would support the slip. Without friction so far,
/// it slips if the friction that this point alone would need exceeds the limit.
pub(super) fn friction_state(radius: f64, force: [f64; 2], u: [f64; 2], slipped: bool, mobility: f64) -> Friction {
    let length = hypot(force[0], force[1]);
    if radius <= 0.0 {
        return Friction::Given;
    }
    let speed = hypot(u[0], u[1]);
    if speed > RIGID * radius * mobility {
        return Friction::Given;
    }
    if length <= EDGE * radius {
        if speed <= radius * mobility {
            return Friction::Sticks;
        }
        return Friction::Slips { along: [-u[0] / speed, -u[1] / speed], compliance: speed / radius };
    }
    let power = force[0] * u[0] + force[1] * u[1];
    if power >= 0.0 || !(slipped || length >= radius * (1.0 - EDGE)) {
        return Friction::Sticks;
    }
    Friction::Slips { along: [force[0] / length, force[1] / length], compliance: -power / (length * radius) }
}
