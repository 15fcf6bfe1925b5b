//! Frames of coordinates: the coordinate and the unit of each value.

use super::formats::{AngleUnit, Message};
use ambulo::model::{CoordinateKind, Model};
use anyhow::{Result, bail};

/// No angle and no place of a person is larger [rad or m]; glitches of a sender are.
const LARGEST: f64 = 1e4;

/// A value of a frame: its coordinate in the model, and its unit in units of the model.
#[derive(Debug, Clone, Copy)]
struct Slot {
    coordinate: usize,
    unit: f64,
}

/// The values of a frame.
pub(super) struct CoordinateFrames {
    slots: Vec<Slot>,
}

impl CoordinateFrames {
    /// All coordinates of the model, in its order and units.
    pub(super) fn new(model: &Model) -> CoordinateFrames {
        CoordinateFrames {
            slots: (0..model.coordinates().len()).map(|coordinate| Slot { coordinate, unit: 1.0 }).collect(),
        }
    }

    /// Number of values of a frame.
    pub(super) fn values(&self) -> usize {
        self.slots.len()
    }

    /// Names of the coordinates of a frame.
    pub(super) fn names(&self, model: &Model) -> Vec<String> {
        self.slots.iter().map(|slot| model.coordinates()[slot.coordinate].name.clone()).collect()
    }

    /// Sets which values a frame has, and their units. Returns the names of the other coordinates.
    ///
    /// # Errors
    /// A name that the model does not have, or a repeated name; the state then does not change.
    pub(super) fn name_values(&mut self, model: &Model, message: &Message) -> Result<Vec<String>> {
        let coordinates: Vec<usize> = match &message.coordinates {
            None => self.slots.iter().map(|slot| slot.coordinate).collect(),
            Some(names) => names.iter().map(|name| coordinate(model, name)).collect::<Result<_>>()?,
        };
        let is_twice = |(place, coordinate): (usize, &usize)| coordinates[..place].contains(coordinate);
        if let Some(place) = coordinates.iter().enumerate().find(|entry| is_twice(*entry)).map(|(place, _)| place) {
            let name = &model.coordinates()[coordinates[place]].name;
            bail!("the coordinate `{name}` is named twice; expected each name once");
        }
        let is_degrees = message.angles == Some(AngleUnit::Deg);
        let slot = |coordinate: usize| {
            let is_angle = model.coordinates()[coordinate].kind != CoordinateKind::Translation;
            Slot { coordinate, unit: if is_angle && is_degrees { 1_f64.to_radians() } else { 1.0 } }
        };
        self.slots = coordinates.into_iter().map(slot).collect();
        let is_named = |place: usize| self.slots.iter().any(|slot| slot.coordinate == place);
        let others = model.coordinates().iter().enumerate().filter(|(place, _)| !is_named(*place));
        Ok(others.map(|(_, coordinate)| coordinate.name.clone()).collect())
    }

    /// One value per coordinate of the model, not-a-number where it is missing.
    ///
    /// # Errors
    /// Another number of values, or a value that is larger than possible for a person.
    pub(super) fn in_model_order(&self, model: &Model, values: &[Option<f64>]) -> Result<Vec<f64>> {
        let expected = self.slots.len();
        if values.len() != expected {
            bail!("a frame with {} values; expected {expected}, one per coordinate", values.len());
        }
        let coordinates = model.coordinates();
        let mut q: Vec<f64> = coordinates.iter().map(|c| c.default_value).collect();
        for (slot, value) in self.slots.iter().zip(values) {
            let value = value.map_or(f64::NAN, |value| value * slot.unit);
            if value.abs() > LARGEST {
                bail!(
                    "`{}` is {value:e}; expected at most {LARGEST:e} rad or m, or null for a missing value",
                    coordinates[slot.coordinate].name
                );
            }
            q[slot.coordinate] = value;
        }
        Ok(q)
    }
}

fn coordinate(model: &Model, name: &str) -> Result<usize> {
    match model.coordinate(name) {
        Some(id) => Ok(id.index()),
        None => {
            let names: Vec<&str> = model.coordinates().iter().map(|c| c.name.as_str()).collect();
            bail!("no coordinate `{name}` in the model; expected some of {}", names.join(", "))
        }
    }
}
