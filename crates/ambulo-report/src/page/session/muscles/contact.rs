//! Loads of hips, knees and ankles, with the forces of the muscles, in body weights.
//!
//! resultant   = |f|,    compression = f . d
//!
//! | code | symbol | unit | frame |
//! |---|---|---|---|
//! | `force` | f | N | force of the parent on the child, axes of the child body |
//! | `along` | d | 1 | along the bone away from the pelvis, axes of the child body |
//!
//! The bone is the thigh at the hip, and the shank at knee and ankle; at the ankle its direction in the axes of the
//! foot is that of the model's neutral posture.

use super::side_curves::{Head, SideCurve, SideCurves, panel};
use crate::page::block::Block;
use crate::page::contract::{Group, Origin};
use crate::page::session::results::Results;
use ambulo::model::anatomy::Leg;
use ambulo::model::{BodyId, BySide, Model, Side};
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

/// A joint that carries a load.
#[derive(Clone, Copy, PartialEq, Eq)]
enum LoadedJoint {
    Hip,
    Knee,
    Ankle,
}

use LoadedJoint::{Ankle, Hip, Knee};

const RESULTANTS: [(LoadedJoint, &str, &str); 3] = [
    (Hip, "hip_contact", "Hip contact force"),
    (Knee, "knee_contact", "Knee contact force"),
    (Ankle, "ankle_contact", "Ankle contact force"),
];
const COMPRESSIONS: [(LoadedJoint, &str, &str); 3] = [
    (Hip, "hip_compression", "Hip compression"),
    (Knee, "knee_compression", "Knee compression"),
    (Ankle, "ankle_compression", "Ankle compression"),
];
const CONDYLES: [(&str, &str, &str); 2] =
    [("medial", "knee_medial", "Knee compression, medial"), ("lateral", "knee_lateral", "Knee compression, lateral")];

const NOTE: &str = "Force that a joint carries: the net joint reaction and the forces of the muscles, in body weights. \
    Compression is its part along the thigh (hip) or along the shank (knee, ankle); the knee's compression is divided \
    between the condyles by the frontal moment. These are estimates of the model that agree with OpenSim's on the same \
    data; they are not measured loads.";

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
        note: Some(NOTE.to_owned()),
        columns: 3,
        panels,
    })
}

/// All loads for which the file has columns.
pub(super) fn loads(results: &Results) -> Vec<Load> {
    let Some((table, (_, model))) = results.contact.as_ref().zip(results.body.as_ref()) else { return Vec::new() };
    let weight_n = results.weight_n;
    let resultant = |(joint, id, title): (LoadedJoint, &'static str, &'static str)| Load {
        id,
        title,
        directions: ["", ""],
        curves: BySide::from_fn(|side| resultant(table, model, joint, side, weight_n)),
    };
    let compression = |(joint, id, title): (LoadedJoint, &'static str, &'static str)| Load {
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

/// The child body of a joint.
fn child(leg: &Leg, joint: LoadedJoint) -> BodyId {
    match joint {
        Hip => leg.hip,
        Knee => leg.knee,
        Ankle => leg.ankle,
    }
}

/// Force of the parent on the child in the axes of the child [N], one per instant.
fn forces(table: &Table, model: &Model, joint: LoadedJoint, side: Side) -> Option<Vec<Vec3>> {
    let leg = model.anatomy().legs()[side].as_ref()?;
    let body = &model.bodies()[child(leg, joint).index()];
    let stem = format!("{}_on_{1}_in_{1}_f", body.joint.name, body.name);
    let [x, y, z] = ["x", "y", "z"].map(|axis| table.column(&format!("{stem}{axis}")));
    let components = x?.iter().zip(y?).zip(z?);
    Some(components.map(|((x, y), z)| Vec3::new(*x, *y, *z)).collect())
}

fn resultant(table: &Table, model: &Model, joint: LoadedJoint, side: Side, weight_n: f64) -> Option<SideCurve> {
    let values = forces(table, model, joint, side)?.iter().map(|force| force.norm() / weight_n).collect();
    Some(SideCurve { values, origin: None })
}

fn compression(table: &Table, model: &Model, joint: LoadedJoint, side: Side, weight_n: f64) -> Option<SideCurve> {
    let along = along(model, joint, side)?;
    let values = forces(table, model, joint, side)?.iter().map(|force| force.dot(&along) / weight_n).collect();
    Some(SideCurve { values, origin: None })
}

fn condyle(table: &Table, word: &str, side: Side, weight_n: f64) -> Option<SideCurve> {
    let column = format!("knee_{}_{word}", side.letter());
    let values = table.column(&column)?.iter().map(|force| force / weight_n).collect();
    let origin = Origin { file: CONTACT_REACTIONS.to_owned(), column, factor: 1.0 / weight_n };
    Some(SideCurve { values, origin: Some(origin) })
}

/// Unit vector along the bone away from the pelvis, in the axes of the joint's child body.
fn along(model: &Model, joint: LoadedJoint, side: Side) -> Option<Vec3> {
    let leg = model.anatomy().legs()[side].as_ref()?;
    let poses = &model.anatomy().neutral()?.poses;
    let center = |body: BodyId| {
        let in_body = model.bodies()[body.index()].joint.child_from_joint.translation;
        poses[body.index()].place(in_body)
    };
    let [upper, lower] = if joint == Hip { [leg.hip, leg.knee] } else { [leg.knee, leg.ankle] };
    let bone = (center(lower) - center(upper)).try_normalize(f64::MIN_POSITIVE)?;
    Some(poses[child(leg, joint).index()].rotation.transpose() * bone)
}
