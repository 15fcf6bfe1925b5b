//! Muscles for drawing: the points of their paths on the bodies, and their activation.
//!
//! Points that belong to a path only in some postures are always drawn. A point that moves on its body is drawn where
//! it is in the default posture. Paths do not bend around wrap objects.

use super::StageMuscle;
use ambulo::model::{CoordinateId, Function, Model, Side};
use ambulo::muscles::set::{Muscle, MuscleSet, PointPlace};
use ambulo::spatial::Vec3;
use ambulo_formats::table::Table;

/// The muscles of a set with an activation in a table with the columns of `muscles.sto`. Muscles with a point on the
/// ground are left out.
pub(super) fn muscles(model: &Model, set: &MuscleSet, table: &Table) -> Vec<StageMuscle> {
    let drawn = |muscle: &Muscle| {
        let activation = table.column(&format!("{}_activation", muscle.name))?.to_vec();
        let points = muscle.path.points.iter();
        let points = points.map(|point| Some((point.body?.index(), place(model, &point.place))));
        let points = points.collect::<Option<Vec<_>>>()?;
        Some(StageMuscle { name: muscle.name.clone(), side: Side::of_name(&muscle.name), points, activation })
    };
    set.muscles.iter().filter_map(drawn).collect()
}

/// Place of a point on its body in the default posture [m].
fn place(model: &Model, place: &PointPlace) -> Vec3 {
    match place {
        PointPlace::Fixed(place) | PointPlace::Conditional { place, .. } => *place,
        PointPlace::Moving { frame, axes } => {
            let at = |(coordinate, function): &(Option<CoordinateId>, Function)| {
                let value = coordinate.map_or(0.0, |id| model.coordinates()[id.index()].default_value);
                function.at(value)[0]
            };
            frame.place(Vec3::new(at(&axes[0]), at(&axes[1]), at(&axes[2])))
        }
    }
}
