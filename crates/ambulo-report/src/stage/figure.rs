//! The stage of a figure: a model with its coordinates over time, and forces.

use super::muscle;
use super::path::BodyPath;
use super::{ForceRole, Stage, StageBody, StageContact, StagePlate, arrow, floor, sole, torque, view_shapes};
use crate::page::ViewShape;
use ambulo::figure_shape::{BodySolid, FigureShape};
use ambulo::findings::Findings;
use ambulo::kinematics::{Trajectory, each_body_motion};
use ambulo::model::anatomy::SolePoint;
use ambulo::model::{BodyId, Model, Side};
use ambulo::motion::{Motion, SmoothMotion, TimeGrid, coordinates_from_table};
use ambulo::muscles::set::MuscleSet;
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;
use ambulo_results::{
    BODIES, Folder, GROUND, GROUND_MEASURED, KINEMATICS, KINEMATICS_RECORDED, MOMENTS, MUSCLES, ResultsError,
    RunSummary, SUBJECT, Summary, error_chain,
};

/// The model and its motion in a folder.
pub(crate) struct FolderMotion {
    /// The body.
    pub(crate) model: Model,
    /// `kinematics.mot`.
    pub(crate) angles: Table,
    /// The motion as a trajectory of the model; rates are zero.
    pub(crate) trajectory: Trajectory,
}

/// Model and motion of a folder, or why there is none.
pub(crate) fn folder_motion(folder: &Folder<'_>) -> Result<Result<FolderMotion, String>, ResultsError> {
    let Some(angles) = folder.table(KINEMATICS)? else {
        return Ok(Err(format!("There is no {KINEMATICS}, so no figure can be drawn.")));
    };
    let Some((_, model)) = folder.body()? else {
        return Ok(Err(format!("There is no body ({}), so no figure can be drawn.", BODIES.join(" or "))));
    };
    let trajectory = trajectory(&model, &angles).map_err(|reason| folder.unreadable(KINEMATICS, reason))?;
    Ok(Ok(FolderMotion { model, angles, trajectory }))
}

impl Stage {
    /// The stage of the figure of a result folder, or why there is none.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub(crate) fn of_figure(folder: &Folder<'_>) -> Result<Result<Stage, String>, ResultsError> {
        let FolderMotion { model, angles, trajectory } = match folder_motion(folder)? {
            Ok(motion) => motion,
            Err(reason) => return Ok(Err(reason)),
        };
        let summary = match folder.summary()? {
            RunSummary::Motion(summary) => summary,
            RunSummary::Scene(_) => return Ok(Err("No figure: the summary is that of a scene.".to_owned())),
        };
        let rows = angles.rows();
        drop(angles);
        let mut stage = Stage::of_motion(&model, &trajectory, summary.height_m);
        drop(trajectory);
        if let Some(table) = same_rows(folder, KINEMATICS_RECORDED, rows)? {
            let recorded = self::trajectory(&model, &table);
            let recorded = recorded.map_err(|reason| folder.unreadable(KINEMATICS_RECORDED, reason))?;
            for (body, path) in stage.bodies.iter_mut().zip(paths(&model, &recorded)) {
                body.recorded = Some(path);
            }
        }
        stage.plates = plates(&summary);
        for (file, role) in [(GROUND, ForceRole::Main), (GROUND_MEASURED, ForceRole::Measured)] {
            if let Some(table) = same_rows(folder, file, rows)? {
                stage.forces.extend(arrow::forces(&table, role));
            }
        }
        if let Some(moments) = same_rows(folder, MOMENTS, rows)? {
            stage.torques = torque::torques(&model, &moments, summary.mass_kg);
        }
        if let Some(activations) = same_rows(folder, MUSCLES, rows)? {
            match muscle_set(folder, &model)? {
                Ok(set) => stage.muscles = muscle::muscles(&model, &set, &activations),
                Err(reason) => stage.missing.push(reason),
            }
        }
        stage.floor_m = floor::height(&stage.plates, &stage.forces, &stage.bodies, &stage.contacts);
        stage.put_soles_on_the_floor(&model, summary.height_m);
        stage.defect().map_or(Ok(Ok(stage)), |reason| Err(folder.unreadable(KINEMATICS, reason)))
    }

    fn put_soles_on_the_floor(&mut self, model: &Model, stature_m: Option<f64>) {
        let shape = FigureShape::new(model, stature_m, sole::sunk(self));
        for (body, solids) in self.bodies.iter_mut().zip(&shape.solids) {
            body.shapes = view_shapes(solids);
        }
        self.contacts = contacts(&shape);
    }

    /// The stage of a model's motion without forces; `stature` [m] if known.
    pub(crate) fn of_motion(model: &Model, trajectory: &Trajectory, stature_m: Option<f64>) -> Stage {
        let shape = FigureShape::new(model, stature_m, [0.0; 2]);
        let contacts = contacts(&shape);
        let paths = paths(model, trajectory);
        let body = |((body, solids), path): ((BodyId, &Vec<BodySolid>), BodyPath)| {
            let described = &model.bodies()[body.index()];
            StageBody {
                name: described.name.clone(),
                parent: described.joint.parent.map(BodyId::index),
                side: model.anatomy().body_side(body),
                shapes: view_shapes(solids),
                path,
                recorded: None,
            }
        };
        let bodies: Vec<StageBody> = model.body_ids().zip(&shape.solids).zip(paths).map(body).collect();
        let floor_m = floor::height(&[], &[], &bodies, &contacts);
        Stage {
            grid: trajectory.grid(),
            bodies,
            fixed: Vec::new(),
            plates: Vec::new(),
            forces: Vec::new(),
            torques: Vec::new(),
            contacts,
            muscles: Vec::new(),
            floor_m,
            weight_n: model.mass() * model.gravity().norm(),
            missing: Vec::new(),
        }
    }
}

/// The muscles in the body of a run, or why there are none.
fn muscle_set(folder: &Folder<'_>, model: &Model) -> Result<Result<MuscleSet, String>, ResultsError> {
    let Some(text) = folder.text(SUBJECT)? else {
        return Ok(Err(format!("No muscles in the figure: the folder has no {SUBJECT}.")));
    };
    let document = OsimModel::read(text.as_bytes()).map_err(|error| folder.refused(SUBJECT, &error))?;
    let set = MuscleSet::of_document(&document, model, &mut Findings::default());
    Ok(set.map_err(|error| format!("No muscles in the figure: {SUBJECT}: {}.", error_chain(&error))))
}

/// Shapes of the bodies of a model, in their own axes.
pub(crate) fn figure_shapes(model: &Model) -> Vec<Vec<ViewShape>> {
    FigureShape::new(model, None, [0.0; 2]).solids.iter().map(|solids| view_shapes(solids)).collect()
}

fn contacts(shape: &FigureShape) -> Vec<StageContact> {
    let of = |(side, point): &(Side, SolePoint)| StageContact {
        body: point.body.index(),
        place: point.place,
        side: Some(*side),
    };
    shape.soles.iter().map(of).collect()
}

fn paths(model: &Model, trajectory: &Trajectory) -> Vec<BodyPath> {
    let frames = trajectory.grid().frames;
    let mut paths: Vec<BodyPath> = model.bodies().iter().map(|_| BodyPath::with_room(frames)).collect();
    each_body_motion(model, trajectory, |_, bodies| {
        for (path, motion) in paths.iter_mut().zip(bodies) {
            path.push(&motion.pose);
        }
    });
    paths
}

/// The coordinates exactly as in a file of angles; missing ones are at their default. Rates are not used.
fn trajectory(model: &Model, table: &Table) -> Result<Trajectory, String> {
    let motion =
        coordinates_from_table(model, table, KINEMATICS, &mut Findings::default()).map_err(|e| error_chain(&e))?;
    let Motion { times, columns, .. } = motion;
    let grid =
        grid(&times).ok_or("the times are not evenly spaced; expected the even steps that this program writes")?;
    let still = |values: Vec<f64>| {
        let zeros = vec![0.0; values.len()];
        [values, zeros.clone(), zeros]
    };
    let noise = vec![None; columns.len()];
    let motion = SmoothMotion { grid, columns: columns.into_iter().map(|c| c.map(still)).collect(), noise };
    Trajectory::complete(model, motion, &mut Findings::default()).map_err(|error| error_chain(&error))
}

fn grid(times: &[f64]) -> Option<TimeGrid> {
    match times[..] {
        [start_s] => Some(TimeGrid { start_s, step_s: 0.0, frames: 1 }),
        _ => TimeGrid::through(times),
    }
}

/// A table with one row per row of the motion.
fn same_rows(folder: &Folder<'_>, file: &str, rows: usize) -> Result<Option<Table>, ResultsError> {
    let Some(table) = folder.table(file)? else { return Ok(None) };
    if table.rows() == rows {
        return Ok(Some(table));
    }
    let found = format!("{} rows; expected {rows}, one for each of {KINEMATICS}", table.rows());
    Err(folder.unreadable(file, found))
}

/// `subject.plate_corners_m` of the summary.
fn plates(summary: &Summary) -> Vec<StagePlate> {
    let plates = summary.subject.as_ref().map_or(&[][..], |subject| &subject.plate_corners_m);
    plates.iter().map(|plate| StagePlate { name: plate.plate.clone(), corners: plate.corners_m }).collect()
}
