//! The person for whom a motion is checked.

use crate::model::anatomy::{Sole, Stature};
use crate::model::anthropometry::Human;
use crate::model::{BySide, Model};

/// The size and the soles of a person, which determine the limits of a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Person {
    /// Body mass [kg].
    pub mass_kg: f64,
    /// Stature [m].
    pub height_m: f64,
    /// Hip to ground, standing [m].
    pub leg_length_m: f64,
    /// The soles, if known or estimated.
    pub soles: BySide<Option<Sole>>,
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
            soles: BySide::from_fn(|side| human.sole(side)),
            estimated: false,
        }
    }

    /// Estimates the person of any model with legs: stature from thigh and shank, soles from stature and the position
    /// of the ankle.
    #[must_use]
    pub fn of_model(model: &Model) -> Person {
        let Stature { height_m, leg_length_m } = model.stature();
        Person {
            mass_kg: model.mass(),
            height_m,
            leg_length_m,
            soles: model.anatomy().soles(height_m),
            estimated: true,
        }
    }
}
