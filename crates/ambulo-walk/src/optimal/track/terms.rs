//! The objective of tracking: distances from the recorded motion and from expected forces.

use super::floor::floor_velocity;
use super::soles::{PER_FOOT, in_stance};
use super::{FootGuide, Instants, TrackSettings};
use crate::kinematics::Trajectory;
use crate::model::Movement::{
    AnkleDorsiflexion, FootRotation, HipAdduction, HipFlexion, HipRotation, KneeAdduction, KneeFlexion, KneeRotation,
    SubtalarInversion, ToeExtension,
};
use crate::model::{BySide, CoordinateId, CoordinateKind, Drive, Model};
use crate::optimal::objective::{Bound, Quantity, Term};

/// A recorded motion at the instants of the problem.
pub(super) struct Recorded<'a> {
    pub(super) model: &'a Model,
    pub(super) trajectory: &'a Trajectory,
    pub(super) instants: &'a Instants,
    /// Rate of each coordinate that moves the body with the floor.
    pub(super) belt: &'a [f64],
    pub(super) settings: &'a TrackSettings,
}

/// All terms. `heights` are the heights of the spheres above the floor in each frame [m], `moments` expected
/// generalised forces.
pub(super) fn terms(
    recorded: &Recorded<'_>,
    feet: &BySide<FootGuide>,
    heights: &[Vec<f64>],
    moments: &[Vec<f64>],
) -> Vec<Term> {
    let mut terms = Vec::new();
    for id in recorded.model.coordinate_ids() {
        if matches!(recorded.model.coordinates()[id.index()].drive, Drive::Free) {
            terms.extend(recorded.motion(id));
            terms.extend(recorded.limits(id));
            terms.extend(moments.get(id.index()).and_then(|moment| recorded.moment(id, moment)));
        }
    }
    for (foot, first) in feet.values().zip([0, PER_FOOT]) {
        terms.extend(recorded.force(foot, first));
        terms.extend(recorded.center(foot, first));
        terms.extend(recorded.heights(foot, first, &heights[first..first + PER_FOOT]));
    }
    terms
}

fn near(name: &str, quantity: Quantity, targets: Vec<Option<f64>>, deviation: f64) -> Term {
    Term { name: name.to_owned(), quantity, targets, deviation, bound: Bound::Near }
}

impl Recorded<'_> {
    /// Value and acceleration of a coordinate.
    fn motion(&self, id: CoordinateId) -> [Term; 2] {
        let Recorded { model, trajectory, instants, belt, settings } = self;
        let turns = model.coordinates()[id.index()].kind != CoordinateKind::Translation;
        let is_root = model.bodies().iter().any(|b| b.joint.parent.is_none() && b.joint.coordinates().contains(&id));
        let [place, acceleration] = match (turns, is_root) {
            (true, true) => [settings.root_angle, settings.turning],
            (true, false) => [settings.angle, settings.turning * self.looseness(id)],
            (false, _) => [settings.place, settings.acceleration],
        };
        let carried = |k: usize| belt[id.index()] * instants.step_s * k as f64;
        let places = instants.pick(trajectory.values(id)).into_iter().enumerate();
        let places = places.map(|(k, place)| Some(place? - carried(k))).collect();
        let accelerations = instants.pick(trajectory.accelerations(id));
        [
            near("position", Quantity::Position(vec![(id, 1.0)]), places, place),
            near("acceleration", Quantity::Acceleration(vec![(id, 1.0)]), accelerations, acceleration),
        ]
    }

    /// Limits of a joint angle: its range, and [`TrackSettings::most_change`] from the recorded angle. Between them
    /// they cost nothing. Recorded angles beyond the range stay allowed.
    fn limits(&self, id: CoordinateId) -> Vec<Term> {
        let Recorded { model, trajectory, instants, settings, .. } = self;
        let coordinate = &model.coordinates()[id.index()];
        let is_root = model.bodies().iter().any(|b| b.joint.parent.is_none() && b.joint.coordinates().contains(&id));
        if coordinate.kind != CoordinateKind::Rotation || is_root {
            return Vec::new();
        }
        let [low, high] = coordinate.range.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        let angles = instants.pick(trajectory.values(id));
        let limit = |bound: Bound, of: &dyn Fn(f64) -> f64| Term {
            name: "limit".to_owned(),
            quantity: Quantity::Position(vec![(id, 1.0)]),
            targets: angles.iter().map(|angle| angle.map(of)).collect(),
            deviation: settings.beyond,
            bound,
        };
        let most = settings.most_change;
        vec![
            limit(Bound::AtLeast, &|angle| (angle - most).max(low.min(angle))),
            limit(Bound::AtMost, &|angle| (angle + most).min(high.max(angle))),
        ]
    }

    /// Factor of the deviation of the acceleration of a joint: foot strikes shake knee and foot, and filters take this
    /// from a recording; trunk and arms balance what the legs do.
    fn looseness(&self, id: CoordinateId) -> f64 {
        let [knee, foot, trunk] = self.settings.looser;
        match self.model.anatomy().meaning(id).map(|meaning| meaning.movement) {
            Some(HipFlexion | HipAdduction | HipRotation) => 1.0,
            Some(KneeFlexion | KneeAdduction | KneeRotation) => knee,
            Some(AnkleDorsiflexion | SubtalarInversion | FootRotation | ToeExtension) => foot,
            _ => trunk,
        }
    }

    /// Moment of a joint of the leg.
    fn moment(&self, id: CoordinateId, moment: &[f64]) -> Option<Term> {
        self.model.anatomy().meaning(id)?.side?;
        let deviation = self.settings.moment * self.model.mass();
        Some(near("moment", Quantity::Force(id), self.instants.pick(moment), deviation))
    }

    /// Ground force on a foot.
    fn force(&self, foot: &FootGuide, first: usize) -> Vec<Term> {
        let weight = self.model.mass() * self.model.gravity().norm();
        let along = |axis: usize| {
            let targets = self.instants.pick(&foot.force).into_iter().map(|force| Some(force?[axis])).collect();
            let quantity = Quantity::GroundForce((first..first + PER_FOOT).collect(), axis);
            near("ground force", quantity, targets, self.settings.force[axis] * weight)
        };
        (0..3).map(along).collect()
    }

    /// Centre of pressure under a foot.
    fn center(&self, foot: &FootGuide, first: usize) -> Vec<Term> {
        let weight = self.model.mass() * self.model.gravity().norm();
        let velocity = floor_velocity(self.model, self.belt);
        let centers = self.instants.pick(&foot.center);
        let along = |axis: usize| {
            let at = |k: usize| Some(centers[k]?[axis] - velocity[axis] * self.instants.step_s * k as f64);
            let points: Vec<Option<f64>> = (0..centers.len()).map(|k| at(k).filter(|x| x.is_finite())).collect();
            let targets = points.iter().map(|point| point.map(|_| 0.0)).collect();
            let points = points.into_iter().map(Option::unwrap_or_default).collect();
            let quantity = Quantity::LoadOffset { spheres: (first..first + PER_FOOT).collect(), axis, points };
            near("centre of pressure", quantity, targets, self.settings.center * weight)
        };
        [0, 2].into_iter().map(along).collect()
    }

    /// Heights of the spheres in stance: without contact, forces would not show the way back to the floor.
    fn heights(&self, foot: &FootGuide, first: usize, heights: &[Vec<f64>]) -> Vec<Term> {
        let stance = in_stance(foot, self.trajectory.grid());
        let of = |(k, heights): (usize, &Vec<f64>)| {
            let mut known = vec![f64::NAN; heights.len()];
            stance.iter().for_each(|&frame| known[frame] = heights[frame]);
            let targets = self.instants.pick(&known).into_iter().map(|height| height.filter(|h| h.is_finite()));
            near("height", Quantity::Height(first + k), targets.collect(), self.settings.height)
        };
        heights.iter().enumerate().map(of).collect()
    }
}
