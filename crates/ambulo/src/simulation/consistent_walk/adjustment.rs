//! Size of the change that made a walk dynamically consistent, and of its remaining residual forces.

use super::settings::ConsistentWalkError;
use super::unknowns::reference;
use super::walk::ConsistentWalk;
use crate::contact::HuntCrossley;
use crate::gait::machine::WalkMachine;
use crate::model::Model;
use crate::model::anthropometry::Human;

/// Number of instants per cycle that are evaluated.
const INSTANTS: usize = 200;

/// Magnitude of a quantity over a cycle.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Magnitude {
    /// Root mean square.
    pub rms: f64,
    /// Largest absolute value.
    pub largest: f64,
}

impl Magnitude {
    /// Magnitude of values about zero.
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

/// Size of the change of a walk.
#[derive(Debug, Clone, PartialEq)]
pub struct Adjustment {
    /// Name and change of angle [rad] of each changed coordinate. Only the right side is listed; the left side is the same half a
    /// cycle later.
    pub angles: Vec<(String, Magnitude)>,
    /// Change of the pelvis path relative to even forward motion at mean height: forwards and up [m].
    pub pelvis: [Magnitude; 2],
}

impl ConsistentWalk {
    /// Size of the change of the walk.
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

    /// Changed minus unchanged value of each coordinate over a cycle.
    fn differences(&self, model: &Model) -> Vec<Vec<f64>> {
        let count = model.coordinates().len();
        let mut columns = vec![Vec::with_capacity(INSTANTS); count];
        let [mut q, mut old, mut qd, mut qdd] = [0; 4].map(|_| vec![0.0; count]);
        let (mut motion, mut machine) = (self.motion(), WalkMachine::new(&self.walk));
        for instant in 0..INSTANTS {
            let time_s = self.walk.cycle_s() * instant as f64 / INSTANTS as f64;
            motion.write(time_s, &mut q, &mut qd, &mut qdd);
            reference(&mut machine, self.walk.speed(), &self.layout, time_s, &mut old, &mut qd, &mut qdd);
            for (column, (new, old)) in columns.iter_mut().zip(q.iter().zip(&old)) {
                column.push(new - old);
            }
        }
        columns
    }

    /// Residual force [N] and residual moment [N.m] of the planned motion over a cycle.
    ///
    /// # Errors
    /// If the figure lacks a coordinate.
    pub fn residual(&self, human: &Human, shoes: &HuntCrossley) -> Result<[Magnitude; 2], ConsistentWalkError> {
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
