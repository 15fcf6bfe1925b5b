//! Whose motion it is: size, and where the soles are.

pub use crate::ground::sole::{Sole, SolePoint};
use crate::ground::sole::{Stature, at_rest};
use crate::model::anthropometry::Human;
use crate::model::{Model, Side};

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
        let Stature { height_m, leg_length_m } = Stature::of_model(model, &bodies);
        Person {
            mass_kg: model.mass(),
            height_m,
            leg_length_m,
            soles: Side::BOTH.map(|side| Sole::estimated(model, &bodies, side, height_m)),
            estimated: true,
        }
    }
}
