//! The stage of a simulated scene, from `poses.csv`, `shapes.json` and `contacts.csv`.

use super::csv_rows::Row;
use super::path::BodyPath;
use super::{ForceRole, Stage, StageBody, StageForce, contact_forces, ground_plane};
use crate::page::ViewShape;
use crate::scene_shapes::{FORMAT, ObstacleShapes, SceneShapes};
use ambulo::model::Side;
use ambulo::motion::TimeGrid;
use ambulo::spatial::Vec3;
use ambulo_results::{CONTACTS, Folder, POSES, ResultsError, SHAPES};
use nalgebra::{Quaternion, UnitQuaternion};
use std::collections::BTreeMap;

const HEAD: &str = "time,body,px,py,pz,qw,qx,qy,qz";
/// Longer runs are thinned to this number of instants, to limit the size of the page.
const MOST_INSTANTS: usize = 2000;

impl Stage {
    /// The stage of a simulated scene, or why there is none.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub(crate) fn of_scene(folder: &Folder<'_>) -> Result<Result<Stage, String>, ResultsError> {
        let (Some(poses), Some(shapes)) = (folder.text(POSES)?, folder.text(SHAPES)?) else {
            return Ok(Err(format!("There is no {POSES} with {SHAPES}, so the motion cannot be drawn in 3-D.")));
        };
        let shapes = read_shapes(folder, &shapes)?;
        let Instants { times, paths } = paths(folder, &poses)?;
        let Some(kept) = Kept::of(&times) else {
            return Ok(Err(format!("{POSES} has no rows, so the motion cannot be drawn in 3-D.")));
        };
        let bodies = bodies(folder, &shapes, paths, &kept)?;
        let mut stage = Stage {
            grid: kept.grid,
            weight_n: shapes.bodies.iter().map(|body| body.mass_kg).sum::<f64>()
                * Vec3::from(shapes.gravity_m_s2).norm(),
            fixed: fixed(&shapes.obstacles),
            bodies,
            plates: Vec::new(),
            forces: Vec::new(),
            torques: Vec::new(),
            contacts: Vec::new(),
            muscles: Vec::new(),
            floor_m: 0.0,
            missing: kept.missing,
        };
        ground_plane::lay(&mut stage, &shapes);
        if let Some(contacts) = folder.text(CONTACTS)? {
            let (forces, left) = contact_forces::read(folder, &contacts, &kept.times)?;
            stage.forces = forces;
            stage.missing.extend(left);
        }
        stage.defect().map_or(Ok(Ok(stage)), |reason| Err(folder.unreadable(SHAPES, reason)))
    }
}

fn read_shapes(folder: &Folder<'_>, text: &str) -> Result<SceneShapes, ResultsError> {
    let shapes: SceneShapes = serde_json::from_str(text).map_err(|error| folder.refused(SHAPES, &error))?;
    if shapes.format != FORMAT {
        return Err(folder.unreadable(SHAPES, format!("format is {}; expected {FORMAT}", shapes.format)));
    }
    let named = shapes.bodies.iter().map(|body| (&body.name, &body.shapes));
    let obstacles = shapes.obstacles.iter().map(|obstacle| (&obstacle.name, &obstacle.shapes));
    for (name, shape) in named.chain(obstacles).flat_map(|(name, list)| list.iter().map(move |shape| (name, shape))) {
        if let Some(reason) = defect(shape) {
            return Err(folder.unreadable(SHAPES, format!("`{name}`: {reason}")));
        }
    }
    Ok(shapes)
}

/// Describes the defect of a shape; `None` if it is valid.
fn defect(shape: &ViewShape) -> Option<String> {
    match shape {
        ViewShape::Capsule { radius, .. } if *radius <= 0.0 => {
            Some(format!("found a capsule of radius {radius} m; expected more than zero"))
        }
        ViewShape::Mesh { points, triangles } => {
            let beyond = triangles.iter().flatten().find(|corner| **corner as usize >= points.len())?;
            Some(format!("found a triangle with the corner {beyond}; the mesh has {} points, from 0 on", points.len()))
        }
        _ => None,
    }
}

/// All rows of `poses.csv`.
struct Instants {
    /// Instants as written in the file.
    times: Vec<String>,
    /// Position and quaternion w, x, y, z by name, one row per instant.
    paths: BTreeMap<String, Vec<[f64; 7]>>,
}

fn paths(folder: &Folder<'_>, text: &str) -> Result<Instants, ResultsError> {
    let mut instants = Instants { times: Vec::new(), paths: BTreeMap::new() };
    for row in Row::all(folder, POSES, text, HEAD)? {
        let time = row.word(0)?;
        if instants.times.last().is_none_or(|last| last != time) {
            row.numbers::<1>(0)?;
            instants.times.push(time.to_owned());
        }
        let path = instants.paths.entry(row.word(1)?.to_owned()).or_default();
        path.push(row.numbers(2)?);
        if path.len() != instants.times.len() {
            let reason = format!(
                "line {}: `{}` has {} rows at {} instants; expected one each",
                row.line,
                row.word(1)?,
                path.len(),
                instants.times.len()
            );
            return Err(folder.unreadable(POSES, reason));
        }
    }
    Ok(instants)
}

/// The instants that are drawn.
struct Kept {
    every: usize,
    times: Vec<String>,
    grid: TimeGrid,
    missing: Vec<String>,
}

impl Kept {
    fn of(times: &[String]) -> Option<Kept> {
        let every = times.len().div_ceil(MOST_INSTANTS).max(1);
        let kept: Vec<String> = times.iter().step_by(every).cloned().collect();
        let numbers: Vec<f64> = kept.iter().filter_map(|time| time.parse().ok()).collect();
        let start_s = *numbers.first()?;
        let one = TimeGrid { start_s, step_s: 0.0, frames: kept.len() };
        let grid = TimeGrid::spanning(&numbers).unwrap_or(one);
        let thinned = format!("Only one of every {every} instants is drawn in 3-D ({} in total).", times.len());
        Some(Kept { every, times: kept, grid, missing: if every > 1 { vec![thinned] } else { Vec::new() } })
    }
}

/// Bodies, and obstacles that move.
fn bodies(
    folder: &Folder<'_>,
    shapes: &SceneShapes,
    mut paths: BTreeMap<String, Vec<[f64; 7]>>,
    kept: &Kept,
) -> Result<Vec<StageBody>, ResultsError> {
    let side = |letter: Option<char>| match letter {
        Some('r') => Some(Side::Right),
        Some('l') => Some(Side::Left),
        _ => None,
    };
    let bodies = shapes.bodies.iter().map(|body| (&body.name, side(body.side), &body.shapes));
    let moving = shapes.obstacles.iter().filter(|o| o.moves).map(|o| (&o.name, None, &o.shapes));
    bodies
        .chain(moving)
        .map(|(name, side, shapes)| {
            let rows = paths.remove(name);
            let missing = || folder.unreadable(POSES, format!("`{name}` of {SHAPES} has no rows"));
            let path = path(&rows.ok_or_else(missing)?, kept);
            Ok(StageBody { name: name.clone(), parent: None, side, shapes: shapes.clone(), path, recorded: None })
        })
        .collect()
}

fn path(rows: &[[f64; 7]], kept: &Kept) -> BodyPath {
    let mut path = BodyPath::default();
    for [x, y, z, w, i, j, k] in rows.iter().step_by(kept.every) {
        let turn = UnitQuaternion::from_quaternion(Quaternion::new(*w, *i, *j, *k));
        path.push_turned(Vec3::new(*x, *y, *z), turn);
    }
    path
}

fn fixed(obstacles: &[ObstacleShapes]) -> Vec<ViewShape> {
    obstacles.iter().filter(|obstacle| !obstacle.moves).flat_map(|obstacle| obstacle.shapes.clone()).collect()
}

impl StageForce {
    /// An arrow without force at all instants.
    pub(super) fn nowhere(name: String, side: Option<Side>, instants: usize) -> StageForce {
        let gap = vec![Vec3::repeat(f64::NAN); instants];
        StageForce { name, side, role: ForceRole::Main, point: gap.clone(), force: gap }
    }
}
