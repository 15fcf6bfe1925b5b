//! Settings of a controller by the names that they have in scenes.

use crate::control::{ControlError, ControlSettings};
use crate::numerics::Shown;
use std::f64::consts::PI;

/// Digits of a gain that was found: trials do not resolve more.
const DIGITS: usize = 4;
/// Radians per degree, as scenes read degrees.
const DEGREE: f64 = PI / 180.0;

/// A setting of a controller that can be tuned.
#[derive(Debug, Clone, Copy)]
pub struct Gain {
    /// Key of the gain in the `control` table of a scene, or in its table `costs`.
    pub name: &'static str,
    /// Unit of the gain in scenes.
    pub unit: &'static str,
    /// Least and largest value, in this unit.
    pub bounds: [f64; 2],
    /// Value in SI per value in its unit.
    scale: f64,
    /// Whether it is a key of the table `costs`.
    is_cost: bool,
    place: fn(&mut ControlSettings) -> &mut f64,
}

/// Why gains cannot be tuned.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GainError {
    /// No gain has this name.
    #[error("found the gain `{found}`; expected one of {}", names())]
    Unknown {
        /// The name.
        found: String,
    },
    /// A gain is listed twice, or there is none.
    #[error("found {found}; expected each gain once, at least one")]
    Count {
        /// The repeated gain, or `no gain`.
        found: String,
    },
    /// A gain starts outside its bounds.
    #[error("found `{name}` = {} {unit}; expected {} to {} {unit}, between which it is tuned", Shown(*value),
        Shown(bounds[0]), Shown(bounds[1]))]
    Bounds {
        /// Name of the gain.
        name: &'static str,
        /// Value, in the gain's unit.
        value: f64,
        /// Unit of the gain.
        unit: &'static str,
        /// Bounds, in the gain's unit.
        bounds: [f64; 2],
    },
    /// A walk without a controller.
    #[error(transparent)]
    Control(#[from] ControlError),
}

fn names() -> String {
    Gain::ALL.map(|gain| format!("`{}`", gain.name)).join(", ")
}

impl Gain {
    /// All gains. Stiffness ends where a standing person's does; the others have a tenth to ten times the usual values.
    pub const ALL: [Gain; 10] = [
        Gain::own("stiffness", "N.m/rad", [20.0, 300.0], |settings| &mut settings.stiffness),
        Gain::own("damping", "s", [0.01, 1.0], |settings| &mut settings.damping_s),
        Gain::cost("angle_deg", "deg", DEGREE, [0.5, 60.0], |settings| &mut settings.costs.angle),
        Gain::cost("rate_deg", "deg/s", DEGREE, [5.0, 600.0], |settings| &mut settings.costs.rate),
        Gain::cost("pelvis_deg", "deg", DEGREE, [0.5, 60.0], |settings| &mut settings.costs.pelvis),
        Gain::cost("height", "m", 1.0, [0.005, 0.5], |settings| &mut settings.costs.height),
        Gain::cost("sideways", "m", 1.0, [0.1, 10.0], |settings| &mut settings.costs.sideways),
        Gain::cost("velocity", "m/s", 1.0, [0.05, 5.0], |settings| &mut settings.costs.velocity[0]),
        Gain::cost("velocity_up", "m/s", 1.0, [0.03, 3.0], |settings| &mut settings.costs.velocity[1]),
        Gain::cost("torque", "N.m", 1.0, [6.0, 600.0], |settings| &mut settings.costs.torque),
    ];

    const fn own(
        name: &'static str,
        unit: &'static str,
        bounds: [f64; 2],
        place: fn(&mut ControlSettings) -> &mut f64,
    ) -> Gain {
        Gain { name, unit, bounds, scale: 1.0, is_cost: false, place }
    }

    const fn cost(
        name: &'static str,
        unit: &'static str,
        scale: f64,
        bounds: [f64; 2],
        place: fn(&mut ControlSettings) -> &mut f64,
    ) -> Gain {
        Gain { name, unit, bounds, scale, is_cost: true, place }
    }

    /// Gains by their names.
    ///
    /// # Errors
    /// An unknown name, one that is listed twice, none at all.
    pub fn named<S: AsRef<str>>(names: &[S]) -> Result<Vec<Gain>, GainError> {
        let mut gains: Vec<Gain> = Vec::new();
        for name in names.iter().map(AsRef::as_ref) {
            let known = Gain::ALL.into_iter().find(|gain| gain.name == name);
            let gain = known.ok_or_else(|| GainError::Unknown { found: name.to_owned() })?;
            if gains.iter().any(|earlier| earlier.name == gain.name) {
                return Err(GainError::Count { found: format!("`{name}` twice") });
            }
            gains.push(gain);
        }
        if gains.is_empty() { Err(GainError::Count { found: "no gain".to_owned() }) } else { Ok(gains) }
    }

    /// The gains that are usually tuned. The cost of torque is left out: a common factor of all costs changes nothing,
    /// so one cost is the unit of the others. A planar figure has no place sideways.
    #[must_use]
    pub fn usual(in_three_dimensions: bool) -> Vec<Gain> {
        let is_usual = |gain: &Gain| match gain.name {
            "torque" => false,
            "sideways" => in_three_dimensions,
            _ => true,
        };
        Gain::ALL.into_iter().filter(is_usual).collect()
    }

    /// Value of the gain in settings, in its unit.
    #[must_use]
    pub fn value(&self, settings: &ControlSettings) -> f64 {
        let mut settings = settings.clone();
        *(self.place)(&mut settings) / self.scale
    }

    /// Sets it to a value in its unit.
    #[doc(hidden)] // for tests
    pub fn set(&self, settings: &mut ControlSettings, value: f64) {
        *(self.place)(settings) = value * self.scale;
    }

    /// Checks that it starts within its bounds.
    #[doc(hidden)] // for tests
    pub fn check(&self, settings: &ControlSettings) -> Result<(), GainError> {
        let Gain { name, unit, bounds, .. } = *self;
        let value = self.value(settings);
        let is_inside = value >= bounds[0] && value <= bounds[1];
        if is_inside { Ok(()) } else { Err(GainError::Bounds { name, value, unit, bounds }) }
    }

    /// The shortest number that gives exactly this setting.
    fn written(&self, settings: &ControlSettings) -> f64 {
        let value = self.value(settings);
        let wanted = (value * self.scale).to_bits();
        let mut digits = (1..17).map(|digits| rounded_to(value, digits));
        digits.find(|short| (short * self.scale).to_bits() == wanted).unwrap_or(value)
    }

    /// The key `control` of a scene with these settings and the file of torque curves that the scene names. Settings
    /// that have their usual values and are not listed are left out.
    #[must_use]
    pub fn table(settings: &ControlSettings, torques: Option<&str>, listed: &[Gain]) -> String {
        let default = ControlSettings::default();
        let is_written = |gain: &Gain| {
            let is_listed = listed.iter().any(|own| own.name == gain.name);
            is_listed || gain.value(settings).to_bits() != gain.value(&default).to_bits()
        };
        let keys = |of_costs: bool| {
            let own = Gain::ALL.into_iter().filter(|gain| gain.is_cost == of_costs && is_written(gain));
            own.map(|gain| format!("{} = {}", gain.name, gain.written(settings))).collect::<Vec<_>>()
        };
        let (mut keys, costs) = (keys(false), keys(true));
        if settings.delay_s > 0.0 {
            keys.push(format!("delay = {}", settings.delay_s));
        }
        if settings.activation_s > 0.0 {
            keys.push(format!("activation = {}", settings.activation_s));
        }
        keys.extend(torques.map(|file| format!("torques = {file:?}")));
        if !costs.is_empty() {
            keys.push(format!("costs = {{ {} }}", costs.join(", ")));
        }
        if keys.is_empty() { "control = {}".to_owned() } else { format!("control = {{ {} }}", keys.join(", ")) }
    }
}

/// A value with the digits of a gain.
pub fn rounded(value: f64) -> f64 {
    rounded_to(value, DIGITS)
}

fn rounded_to(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits - 1).parse().unwrap_or(value)
}
