//! Whose motion it is: size, and where the soles are.

pub use crate::ground::sole::{Sole, SolePoint};
use crate::ground::sole::{at_rest, thigh_and_shank};
use crate::model::anthropometry::Human;
use crate::model::anthropometry::foot::ANKLE_HEIGHT;
use crate::model::{Model, Side};

/// Thigh and shank of a model, joint centre to joint centre, over stature: Gait2392 and Rajagopal's model as scaled to people of known
/// stature have 0.488 and 0.470, Drillis and Contini 0.491.
const THIGH_AND_SHANK: f64 = 0.48;
/// Stature of a man of 72.6 kg [m]: where a model has no legs, stature goes with the cube root of mass.
const REFERENCE: (f64, f64) = (72.6, 1.80);

/// A person: whose strength, weight and soles a motion is judged by.
#[derive(Debug, Clone, PartialEq)]
pub struct Person {
    /// Body mass [kg].
    pub mass_kg: f64,
    /// Stature [m], as known or estimated.
    pub height_m: f64,
    /// Hip to ground, standing [m].
    pub leg_length_m: f64,
    /// Right and left sole, where known or estimated.
    pub soles: [Option<Sole>; 2],
    /// Whether height and soles are estimates from a model's joints.
    pub estimated: bool,
}

impl Person {
    /// The person of a built figure.
    #[must_use]
    pub fn of_human(human: &Human) -> Person {
        let d = &human.dimensions;
        Person {
            mass_kg: human.model.mass(),
            height_m: d.height,
            leg_length_m: d.leg_length,
            soles: Side::BOTH.map(|side| Sole::of_spheres(&human.soles, side, 0.5 * d.foot_width)),
            estimated: false,
        }
    }

    /// The person of any model whose legs have coordinates of the usual names: stature from thigh and shank, soles from stature and
    /// the ankle's place.
    #[must_use]
    pub fn of_model(model: &Model) -> Person {
        let bodies = at_rest(model);
        let mass_kg = model.mass();
        let legs = thigh_and_shank(model, &bodies);
        let (height_m, leg) = if legs.is_empty() {
            let height = REFERENCE.1 * (mass_kg / REFERENCE.0).cbrt();
            (height, THIGH_AND_SHANK * height)
        } else {
            let leg = legs.iter().sum::<f64>() / legs.len() as f64;
            (leg / THIGH_AND_SHANK, leg)
        };
        Person {
            mass_kg,
            height_m,
            leg_length_m: leg + ANKLE_HEIGHT * height_m,
            soles: Side::BOTH.map(|side| Sole::estimated(model, &bodies, side, height_m)),
            estimated: true,
        }
    }
}
