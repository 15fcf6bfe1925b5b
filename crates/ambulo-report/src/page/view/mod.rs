//! The 3-D view of a session: a [`Stage`] with its numbers in the page's block.

use super::block::Block;
use super::contract::{
    PageSide, Role, Series, TimeAxis, View, ViewBody, ViewContact, ViewForce, ViewMuscle, ViewPath, ViewPathPoint,
    ViewPlate, ViewTorque,
};
use crate::stage::{
    BodyPath, ForceRole, Stage, StageBody, StageContact, StageForce, StageMuscle, StagePlate, StageTorque,
};
use ambulo::model::Side;
use ambulo::spatial::Vec3;
use ambulo_results::{Folder, ResultsError};

/// The view of a folder.
pub(super) struct Viewed {
    /// The content of the view, if there is a body.
    pub(super) view: Option<View>,
    /// The instants of all its series.
    pub(super) time: Option<TimeAxis>,
    /// Sentences on what is not shown, and why.
    pub(super) missing: Vec<String>,
}

/// The view of a folder; its numbers go into `block`.
///
/// # Errors
/// A file that cannot be read as its name suggests.
pub(super) fn view(folder: &Folder<'_>, block: &mut Block) -> Result<Viewed, ResultsError> {
    match Stage::of_folder(folder)? {
        Ok(stage) => Ok(drawn(stage, block)),
        Err(reason) => Ok(Viewed { view: None, time: None, missing: vec![reason] }),
    }
}

/// The view of a stage; its numbers go into `block`.
pub(super) fn drawn(stage: Stage, block: &mut Block) -> Viewed {
    let view = View {
        // The numbers of a body are freed when they are packed.
        bodies: stage.bodies.into_iter().map(|body| of_body(body, block)).collect(),
        fixed: stage.fixed,
        plates: stage.plates.iter().map(of_plate).collect(),
        forces: stage.forces.iter().map(|force| of_force(force, block)).collect(),
        torques: stage.torques.iter().map(|torque| of_torque(torque, block)).collect(),
        contacts: stage.contacts.iter().map(of_contact).collect(),
        muscles: (!stage.muscles.is_empty()).then(|| stage.muscles.iter().map(|one| of_muscle(one, block)).collect()),
        floor_m: stage.floor_m,
        weight_n: stage.weight_n,
    };
    let time = TimeAxis { start_s: stage.grid.start_s, step_s: stage.grid.step_s, frames: stage.grid.frames };
    Viewed { view: Some(view), time: Some(time), missing: stage.missing }
}

fn of_body(body: StageBody, block: &mut Block) -> ViewBody {
    ViewBody {
        name: body.name,
        side: page_side(body.side),
        shapes: body.shapes,
        path: of_path(&body.path, block),
        recorded: body.recorded.map(|path| of_path(&path, block)),
    }
}

fn of_path(BodyPath { position, rotation }: &BodyPath, block: &mut Block) -> ViewPath {
    ViewPath {
        position: vectors(position, block),
        // x, y, z, w is nalgebra's own order.
        rotation: [0, 1, 2, 3].map(|i| block.add(&rotation.iter().map(|q| q.coords[i]).collect::<Vec<f64>>())),
    }
}

fn of_plate(plate: &StagePlate) -> ViewPlate {
    ViewPlate { name: plate.name.clone(), corners: plate.corners }
}

fn of_force(force: &StageForce, block: &mut Block) -> ViewForce {
    ViewForce {
        name: force.name.clone(),
        side: page_side(force.side),
        role: if force.role == ForceRole::Measured { Role::Measured } else { Role::Main },
        point: vectors(&force.point, block),
        force: vectors(&force.force, block),
    }
}

fn of_torque(torque: &StageTorque, block: &mut Block) -> ViewTorque {
    ViewTorque {
        name: torque.name.clone(),
        side: page_side(torque.side),
        body: torque.body,
        center: torque.center.into(),
        axis: torque.axis.into(),
        values: block.add(&torque.values),
        panel: Some(torque.panel.clone()),
    }
}

fn of_contact(contact: &StageContact) -> ViewContact {
    ViewContact { body: contact.body, place: contact.place.into(), side: page_side(contact.side) }
}

fn of_muscle(muscle: &StageMuscle, block: &mut Block) -> ViewMuscle {
    let points = muscle.points.iter().map(|(body, place)| ViewPathPoint { body: *body, place: (*place).into() });
    ViewMuscle {
        name: muscle.name.clone(),
        side: page_side(muscle.side),
        points: points.collect(),
        activation: block.add(&muscle.activation),
    }
}

fn vectors(values: &[Vec3], block: &mut Block) -> [Series; 3] {
    [0, 1, 2].map(|axis| block.add(&values.iter().map(|v| v[axis]).collect::<Vec<f64>>()))
}

fn page_side(side: Option<Side>) -> Option<PageSide> {
    side.map(|side| match side {
        Side::Right => PageSide::R,
        Side::Left => PageSide::L,
    })
}
