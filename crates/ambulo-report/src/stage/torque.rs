//! Joint moments for drawing: a centre and an axis in the body on which they act.
//!
//! The axis is the axis of the coordinate while all angles of the joint are zero; where other rotations follow it, it
//! turns with them by a few degrees, which is too little to see.

use super::StageTorque;
use crate::clinical::{ClinicalGroup, ClinicalNames, ClinicalQuantity, clinical_quantities};
use ambulo::model::{BodyId, CoordinateId, Displacement, JointAxis, Model, Side};
use ambulo::spatial::Vec3;
use ambulo_formats::table::Table;

/// The leg moments shown in panels, from a table with the columns of `moments.sto`.
pub(super) fn torques(model: &Model, moments: &Table, mass_kg: f64) -> Vec<StageTorque> {
    let quantities = clinical_quantities(&ClinicalNames::of_model(model), |_| true);
    let of_legs = quantities.iter().filter(|q| q.group == ClinicalGroup::Moments && !q.central);
    let torque = |(quantity, side): (&ClinicalQuantity, Side)| {
        let coordinate = &quantity.coordinates[side];
        let id = model.coordinate(coordinate).filter(|id| model.anatomy().coordinate_side(*id) == Some(side))?;
        let values = moments.column(&format!("{coordinate}_moment"))?;
        let (body, axis) = axis(model, id)?;
        let factor = quantity.factor(mass_kg, side);
        let title = quantity.title.trim_end_matches(" moment").to_lowercase();
        Some(StageTorque {
            name: format!("{side} {title}"),
            side: Some(side),
            body: body.index(),
            center: model.bodies()[body.index()].joint.child_from_joint.translation,
            axis: axis * factor.signum(),
            values: values.iter().map(|moment| factor * moment).collect(),
            panel: quantity.id.to_owned(),
        })
    };
    of_legs.flat_map(|quantity| Side::BOTH.map(|side| (quantity, side))).filter_map(torque).collect()
}

/// The body that a coordinate rotates, and the axis in its frame about which it rotates when the coordinate increases.
fn axis(model: &Model, id: CoordinateId) -> Option<(BodyId, Vec3)> {
    let body = model.body_ids().find(|body| model.bodies()[body.index()].joint.coordinates().contains(&id))?;
    let joint = &model.bodies()[body.index()].joint;
    let at = model.coordinates()[id.index()].default_value;
    let slope = |axis: &JointAxis| match &axis.displacement {
        Displacement::Follows(leader, function) if *leader == id => function.at(at)[1],
        _ => 0.0,
    };
    let main = joint.rotations.iter().max_by(|a, b| slope(a).abs().total_cmp(&slope(b).abs()))?;
    let turned = joint.child_from_joint.rotation * main.direction * slope(main).signum();
    (slope(main).abs() > 0.0).then_some((body, turned))
}
