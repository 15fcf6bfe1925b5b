//! Loads of the force plates by foot, without a model.

use super::FeetOnPlates;
use crate::ground::BodyForces;
use crate::model::{BodyId, BySide, Side};
use crate::motion::{ForceRecording, PlateRecording};
use crate::spatial::Vec3;

impl FeetOnPlates {
    /// Loads on the right and the left foot at the samples of the first plate; centres of pressure at `height_m` [m].
    /// Empty without plates.
    #[must_use]
    pub fn loads_by_foot(&self, plates: &[PlateRecording], height_m: f64) -> Vec<(Side, BodyForces)> {
        let Some(first) = plates.first() else { return Vec::new() };
        // Placeholders that only separate the feet: there is no model.
        let bodies = BySide { right: BodyId(0), left: BodyId(1) };
        let recordings = self.recordings(plates, bodies);
        let load = |(side, &body): (Side, &BodyId)| {
            let own: Vec<&ForceRecording> = recordings.iter().filter(|recording| recording.body == body).collect();
            let (force, moment) = sum(&own, first.times.len());
            (side, BodyForces::on_level_ground(body, &force, &moment, Vec3::y(), height_m))
        };
        bodies.iter().map(load).collect()
    }
}

/// Sums forces and moments about the world's origin.
fn sum(recordings: &[&ForceRecording], samples: usize) -> (Vec<Vec3>, Vec<Vec3>) {
    let (mut force, mut moment) = (vec![Vec3::zeros(); samples], vec![Vec3::zeros(); samples]);
    for recording in recordings {
        let loads = recording.force.iter().zip(&recording.point).zip(&recording.moment);
        for ((total, about), ((f, point), m)) in force.iter_mut().zip(&mut moment).zip(loads) {
            *total += f;
            *about += m + point.cross(f);
        }
    }
    (force, moment)
}
