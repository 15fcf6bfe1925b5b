//! How much a walk was changed to be consistent, and what it still lacks.

use super::unknowns::reference;
use super::{ConsistentWalk, ConsistentWalkError};
use crate::contact::HuntCrossley;
use crate::model::Model;
use crate::model::anthropometry::Human;

/// Instants of a cycle that are looked at.
const INSTANTS: usize = 200;

/// Root mean square and largest size of something over a cycle.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Magnitude {
    /// Root mean square.
    pub rms: f64,
    /// Largest.
    pub largest: f64,
}

impl Magnitude {
    /// Of some values, about zero.
    #[must_use]
    pub fn of(values: impl IntoIterator<Item = f64>) -> Magnitude {
        let (mut sum, mut count, mut largest) = (0.0, 0.0, 0.0_f64);
        for value in values {
            sum += value * value;
            count += 1.0;
            largest = largest.max(value.abs());
        }
        Magnitude { rms: if count > 0.0 { (sum / count).sqrt() } else { 0.0 }, largest }
    }
}

/// How much a walk was changed.
#[derive(Debug, Clone, PartialEq)]
pub struct Adjustment {
    /// Name of each changed coordinate (those of the right side: the left one's are the same half a cycle later) with the change
    /// of its angle [rad].
    pub angles: Vec<(String, Magnitude)>,
    /// The pelvis' path against even forward motion at its mean height: forwards and up [m].
    pub pelvis: [Magnitude; 2],
}

impl ConsistentWalk {
    /// How much the walk was changed.
    #[must_use]
    pub fn adjustment(&self, model: &Model) -> Adjustment {
        let differences = self.differences(model);
        let mut angles = Vec::new();
        for curve in &self.layout.curves {
            let Some(id) = curve.coordinates[0] else { continue };
            let name = &model.coordinates()[id.index()].name;
            if !name.starts_with("pelvis_t") || name == "pelvis_tilt" {
                angles.push((name.clone(), Magnitude::of(differences[id.index()].iter().copied())));
            }
        }
        let path = |name: &str| {
            let Some(id) = model.coordinate(name) else { return Magnitude::default() };
            let column = &differences[id.index()];
            let mean = column.iter().sum::<f64>() / column.len() as f64;
            Magnitude::of(column.iter().map(|x| x - mean))
        };
        Adjustment { angles, pelvis: ["pelvis_tx", "pelvis_ty"].map(path) }
    }

    /// By coordinate: changed less unchanged, over a cycle.
    fn differences(&self, model: &Model) -> Vec<Vec<f64>> {
        let count = model.coordinates().len();
        let mut columns = vec![Vec::with_capacity(INSTANTS); count];
        let [mut q, mut old, mut qd, mut qdd] = [0; 4].map(|_| vec![0.0; count]);
        for instant in 0..INSTANTS {
            let time_s = self.walk.cycle_s() * instant as f64 / INSTANTS as f64;
            self.write(time_s, &mut q, &mut qd, &mut qdd);
            reference(&self.walk, &self.layout, time_s, &mut old, &mut qd, &mut qdd);
            for (column, (new, old)) in columns.iter_mut().zip(q.iter().zip(&old)) {
                column.push(new - old);
            }
        }
        columns
    }

    /// What the plan's root lacks over a cycle: force [N] and moment [N.m].
    ///
    /// # Errors
    /// A figure that lacks a coordinate.
    pub fn lacking(&self, human: &Human, shoes: &HuntCrossley) -> Result<[Magnitude; 2], ConsistentWalkError> {
        let (mut forces, mut moments) = (Vec::new(), Vec::new());
        for instant in 0..INSTANTS {
            let time_s = self.walk.cycle_s() * instant as f64 / INSTANTS as f64;
            let [x, y, pitch] = self.planned(human, shoes, time_s)?.root;
            forces.push(x.hypot(y));
            moments.push(pitch);
        }
        Ok([Magnitude::of(forces), Magnitude::of(moments)])
    }
}
