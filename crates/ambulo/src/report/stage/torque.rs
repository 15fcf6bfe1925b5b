//! Joint moments as they are drawn: a centre and an axis in the body that they turn.
//!
//! The axis is that of the coordinate while all angles of the joint are zero; where other rotations follow it, it turns with them by a
//! few degrees that a picture does not show.

use super::StageTorque;
use crate::model::{BodyId, CoordinateId, Displacement, JointAxis, Model, Side};
use crate::spatial::Vec3;
use ambulo_formats::table::Table;

/// Panel, name, coordinate without its side, factor of the sign; the knee's follows the direction of flexion.
const ROWS: [(&str, &str, &str, f64); 3] = [
    ("hip_flexion_moment", "hip", "hip_flexion", -1.0),
    ("knee_flexion_moment", "knee", "knee_angle", -1.0),
    ("ankle_dorsiflexion_moment", "ankle", "ankle_angle", -1.0),
];

/// The moments of hips, knees and ankles in a table with the columns of `moments.sto`; `angles` are the coordinates of the same motion.
pub(super) fn torques(model: &Model, moments: &Table, angles: &Table, mass_kg: f64) -> Vec<StageTorque> {
    let rows = ROWS.iter().flat_map(|row| Side::BOTH.map(|side| (row, side)));
    let torque = |((panel, name, coordinate, sign), side): (&(&str, &str, &str, f64), Side)| {
        let coordinate_name = format!("{coordinate}_{}", side.letter());
        let id = model.coordinate(&coordinate_name)?;
        let values = moments.column(&format!("{coordinate_name}_moment"))?;
        let (body, axis) = axis(model, id)?;
        let sign = if *name == "knee" { sign * flexion(angles.column(&coordinate_name)?) } else { *sign };
        Some(StageTorque {
            name: format!("{side} {name}"),
            side: Some(side),
            body: body.index(),
            center: model.bodies()[body.index()].joint.child_from_joint.translation,
            axis: axis * sign,
            values: values.iter().map(|moment| moment * sign / mass_kg).collect(),
            panel: (*panel).to_owned(),
        })
    };
    rows.filter_map(torque).collect()
}

/// Plus one where flexion counts positive: the direction in which the knee turns most.
fn flexion(angles: &[f64]) -> f64 {
    let largest = angles.iter().fold(0.0_f64, |most, &x| if x.abs() > most.abs() { x } else { most });
    if largest < 0.0 { -1.0 } else { 1.0 }
}

/// The body that a coordinate turns and the axis, in its frame, about which it turns when the coordinate grows.
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
