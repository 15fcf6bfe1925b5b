//! Loads of hips, knees and ankles, with the forces of the muscles, in body weights.
//!
//! resultant   = |f|,    compression = -f . u
//!
//! | code | symbol | unit | frame |
//! |---|---|---|---|
//! | `force` | f | N | force on the distal segment, axes of the joint's child body |
//! | `up` | u | 1 | long axis of the distal segment, up: of thigh (hip), shank (knee), and shank in the neutral \
//! posture (ankle); axes of the child body |

use super::side_curves::{Head, SideCurve, SideCurves, panel};
use crate::page::block::Block;
use crate::page::contract::{Group, Origin};
use crate::page::session::results::Results;
use ambulo::model::anatomy::LegJoint;
use ambulo::model::{BySide, Model, Side};
use ambulo::spatial::Vec3;
use ambulo_formats::table::Table;
use ambulo_results::CONTACT_REACTIONS;

/// A load of both legs over time [body weights].
pub(super) struct Load {
    /// Identifier: `knee_contact`.
    pub(super) id: &'static str,
    title: &'static str,
    directions: [&'static str; 2],
    /// The values; none for a leg without them.
    pub(super) curves: SideCurves,
}

const RESULTANTS: [(LegJoint, &str, &str); 3] = [
    (LegJoint::Hip, "hip_contact", "Hip contact force"),
    (LegJoint::Knee, "knee_contact", "Knee contact force"),
    (LegJoint::Ankle, "ankle_contact", "Ankle contact force"),
];
const COMPRESSIONS: [(LegJoint, &str, &str); 3] = [
    (LegJoint::Hip, "hip_compression", "Hip compression"),
    (LegJoint::Knee, "knee_compression", "Knee compression"),
    (LegJoint::Ankle, "ankle_compression", "Ankle compression"),
];
const CONDYLES: [(&str, &str, &str); 2] =
    [("medial", "knee_medial", "Knee compression, medial"), ("lateral", "knee_lateral", "Knee compression, lateral")];

const NOTE: &str = "Force that a joint carries: the net joint reaction and the forces of the muscles, in body weights. \
    Compression is its part along the thigh (hip) or along the shank (knee, ankle); the knee's compression is divided \
    between the condyles by the frontal moment";
const NO_MEASUREMENT: &str = "These are estimates of the model, compared with OpenSim's on the same data \
    (docs/MUSCLES.md); they are not measured loads.";

/// The grid; `None` without loads.
pub(super) fn group(results: &Results, block: &mut Block) -> Option<Group> {
    let loads = loads(results);
    let panels = loads.iter().map(|load| {
        let Load { id, title, directions, curves } = load;
        panel(results, &Head { id, title, unit: "BW", directions: *directions }, curves, block)
    });
    let panels: Vec<_> = panels.collect();
    (!panels.is_empty()).then(|| Group {
        id: "contact".to_owned(),
        title: "Joint contact loads".to_owned(),
        note: Some(format!("{NOTE}{}. {NO_MEASUREMENT}", condyles(results))),
        columns: 3,
        panels,
    })
}

/// The distance over which the frontal moment is divided.
fn condyles(results: &Results) -> String {
    let distance_m = results.summary.muscles.as_ref().and_then(|found| found.condyles_m);
    distance_m.map_or_else(String::new, |metres| format!(" over {:.0} mm", 1e3 * metres))
}

/// All loads for which the file has columns.
pub(super) fn loads(results: &Results) -> Vec<Load> {
    let Some((table, (_, model))) = results.contact.as_ref().zip(results.body.as_ref()) else { return Vec::new() };
    let weight_n = results.weight_n;
    let resultant = |(joint, id, title): (LegJoint, &'static str, &'static str)| Load {
        id,
        title,
        directions: ["", ""],
        curves: BySide::from_fn(|side| resultant(table, model, joint, side, weight_n)),
    };
    let compression = |(joint, id, title): (LegJoint, &'static str, &'static str)| Load {
        id,
        title,
        directions: ["compression", "distraction"],
        curves: BySide::from_fn(|side| compression(table, model, joint, side, weight_n)),
    };
    let condyle = |(word, id, title): (&'static str, &'static str, &'static str)| Load {
        id,
        title,
        directions: ["compression", "distraction"],
        curves: BySide::from_fn(|side| condyle(table, word, side, weight_n)),
    };
    let all = RESULTANTS.into_iter().map(resultant).chain(COMPRESSIONS.into_iter().map(compression));
    all.chain(CONDYLES.into_iter().map(condyle)).filter(|load| load.curves.values().any(Option::is_some)).collect()
}

/// Forces on the distal segment of a joint over time.
struct JointForces {
    /// In the axes of the joint's child body [N].
    forces: Vec<Vec3>,
    /// Long axis of the distal segment in these axes, up.
    up: Vec3,
}

impl JointForces {
    fn read(table: &Table, model: &Model, joint: LegJoint, side: Side) -> Option<JointForces> {
        let poses = &model.anatomy().neutral()?.poses;
        let axes = model.leg_joint(joint, side, |body| poses[body.index()].rotation)?;
        let body = &model.bodies()[axes.body.index()];
        let stem = format!("{}_on_{1}_in_{1}_f", body.joint.name, body.name);
        let [x, y, z] = ["x", "y", "z"].map(|axis| table.column(&format!("{stem}{axis}")));
        let components = x?.iter().zip(y?).zip(z?);
        Some(JointForces {
            forces: components.map(|((x, y), z)| Vec3::new(*x, *y, *z) * axes.on_distal).collect(),
            up: poses[axes.body.index()].rotation.transpose() * axes.axes[1],
        })
    }
}

fn resultant(table: &Table, model: &Model, joint: LegJoint, side: Side, weight_n: f64) -> Option<SideCurve> {
    let JointForces { forces, .. } = JointForces::read(table, model, joint, side)?;
    Some(SideCurve { values: forces.iter().map(|force| force.norm() / weight_n).collect(), origin: None })
}

fn compression(table: &Table, model: &Model, joint: LegJoint, side: Side, weight_n: f64) -> Option<SideCurve> {
    let JointForces { forces, up } = JointForces::read(table, model, joint, side)?;
    Some(SideCurve { values: forces.iter().map(|force| -force.dot(&up) / weight_n).collect(), origin: None })
}

fn condyle(table: &Table, word: &str, side: Side, weight_n: f64) -> Option<SideCurve> {
    let column = format!("knee_{}_{word}", side.letter());
    let values = table.column(&column)?.iter().map(|force| force / weight_n).collect();
    let origin = Origin { file: CONTACT_REACTIONS.to_owned(), column, factor: 1.0 / weight_n };
    Some(SideCurve { values, origin: Some(origin) })
}
