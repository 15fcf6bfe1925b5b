//! Checks that a stage can be drawn: in a broken file bodies may be extremely far away or have no size.

use super::Stage;
use crate::page::ViewShape;
use ambulo::spatial::Vec3;
use ambulo_results::{EXPECTED, is_sound};

impl Stage {
    /// The first number that cannot be drawn, with what was found and expected.
    pub(crate) fn defect(&self) -> Option<String> {
        let lengths = [("the height of the floor [m]", self.floor_m), ("the weight [N]", self.weight_n)];
        let length = lengths.into_iter().find(|(_, x)| !is_sound(*x)).map(|(what, x)| refused(what, x));
        length.or_else(|| self.bodies_defect()).or_else(|| self.rest_defect())
    }

    fn bodies_defect(&self) -> Option<String> {
        self.bodies.iter().find_map(|body| {
            let paths = || std::iter::once(&body.path).chain(&body.recorded);
            let placed = paths().flat_map(|path| path.position.iter().enumerate());
            let turned = paths().flat_map(|path| path.rotation.iter().enumerate());
            let place = placed.filter_map(|(i, place)| Some((i, unsound(place)?)));
            let turn = turned.filter_map(|(i, turn)| Some((i, turn.coords.iter().copied().find(|x| !is_sound(*x))?)));
            let at = |(i, x): (usize, f64)| refused(&format!("the place of `{}` in row {}", body.name, i + 1), x);
            let first = place.chain(turn).next().map(at);
            first.or_else(|| shapes_defect(&format!("a shape of `{}`", body.name), &body.shapes))
        })
    }

    fn rest_defect(&self) -> Option<String> {
        let corner = self.plates.iter().find_map(|plate| {
            let number = plate.corners.iter().flatten().copied().find(|x| !is_sound(*x))?;
            Some(refused(&format!("a corner of `{}`", plate.name), number))
        });
        let axis = self.torques.iter().find_map(|torque| {
            let number = unsound(&torque.center).or_else(|| unsound(&torque.axis))?;
            Some(refused(&format!("the axis of `{}`", torque.name), number))
        });
        let contact = self.contacts.iter().find_map(|contact| unsound(&contact.place));
        let contact = contact.map(|number| refused("a point of a sole", number));
        let muscle = self.muscles.iter().find_map(|muscle| {
            let number = muscle.points.iter().find_map(|(_, place)| unsound(place))?;
            Some(refused(&format!("a point of the muscle `{}`", muscle.name), number))
        });
        corner.or(axis).or(contact).or(muscle).or_else(|| shapes_defect("an obstacle", &self.fixed))
    }
}

fn unsound(vector: &Vec3) -> Option<f64> {
    vector.iter().copied().find(|x| !is_sound(*x))
}

fn shapes_defect(whose: &str, shapes: &[ViewShape]) -> Option<String> {
    let number = shapes.iter().find_map(|shape| match shape {
        ViewShape::Capsule { from, to, radius } => first(from.iter().chain(to).chain([radius])),
        ViewShape::Box { center, half, turn } => first(center.iter().chain(half).chain(turn)),
        ViewShape::Mesh { points, .. } => first(points.iter().flatten()),
    });
    number.map(|number| refused(whose, number))
}

fn first<'a>(mut numbers: impl Iterator<Item = &'a f64>) -> Option<f64> {
    numbers.find(|x| !is_sound(**x)).copied()
}

fn refused(what: &str, found: f64) -> String {
    format!("{what}: found {found:?}; expected {EXPECTED}")
}
