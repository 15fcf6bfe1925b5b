//! Makes tables of time series with the column names of OpenSim.

use crate::sound::is_sound;
use ambulo::analysis::{Analysis, Event, EventKind};
use ambulo::ground::{BodyForces, CENTER_OF_PRESSURE_LOAD_N, feet};
use ambulo::model::{BodyId, CoordinateKind, Model, Side};
use ambulo::spatial::Vec3;
use ambulo_formats::Error;
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use ambulo_formats::table::Table;

pub(crate) type Column = (String, Vec<f64>);

pub(crate) fn table(name: &str, analysis: &Analysis, columns: Vec<Column>) -> Result<Table, Error> {
    let time = ("time".to_owned(), analysis.trajectory.grid().times());
    let mut table = Table::new(name, std::iter::once(time).chain(columns).collect())?;
    table.in_degrees = Some(false);
    Ok(table)
}

/// `kinematics.mot`: the coordinates used for the analysis, rotations in degrees.
pub(crate) fn kinematics(model: &Model, analysis: &Analysis) -> Result<Table, Error> {
    let columns = model.coordinate_ids().map(|id| {
        let coordinate = &model.coordinates()[id.index()];
        let values = analysis.trajectory.values(id);
        let shown = match coordinate.kind {
            CoordinateKind::Rotation => values.iter().map(|x| x.to_degrees()).collect(),
            CoordinateKind::Translation | CoordinateKind::Coupled => values.to_vec(),
        };
        (coordinate.name.clone(), shown)
    });
    let title = if analysis.adjusted { "Coordinates, changed to agree with the forces" } else { "Coordinates" };
    let mut table = table(title, analysis, columns.collect())?;
    table.in_degrees = Some(true);
    Ok(table)
}

/// `moments.sto`: generalised forces [N.m or N]. `device`, if given, is subtracted column by column.
pub(crate) fn moments(model: &Model, analysis: &Analysis, device: Option<&[Vec<f64>]>) -> Result<Table, Error> {
    let mut columns: Vec<Column> =
        model.force_names().into_iter().zip(analysis.forces.generalized.iter().cloned()).collect();
    if let Some(device) = device {
        for ((_, total), help) in columns.iter_mut().zip(device) {
            for (total, help) in total.iter_mut().zip(help) {
                *total -= help;
            }
        }
    }
    let title = if device.is_some() { "Biological Generalized Forces" } else { "Inverse Dynamics Generalized Forces" };
    table(title, analysis, columns)
}

/// `powers.sto`: power of the generalised force of each coordinate [W].
pub(crate) fn powers(model: &Model, analysis: &Analysis) -> Result<Table, Error> {
    let names = model.coordinates().iter().map(|c| format!("{}_power", c.name));
    table("Joint Powers", analysis, names.zip(analysis.forces.powers.iter().cloned()).collect())
}

/// `reactions.sto`: for each joint `<joint>_on_<child>_in_ground_` and force `f` [N], moment `m` about the joint centre
/// [N.m] and that centre `p` [m], all of the parent on the child in world axes.
pub(crate) fn reactions(model: &Model, analysis: &Analysis) -> Result<Table, Error> {
    let mut columns = Vec::new();
    for (body, series) in model.bodies().iter().zip(&analysis.forces.reactions) {
        let stem = format!("{}_on_{}_in_ground_", body.joint.name, body.name);
        push_vector(&mut columns, &format!("{stem}f"), series.iter().map(|r| r.wrench.force));
        push_vector(&mut columns, &format!("{stem}m"), series.iter().map(|r| r.wrench.moment));
        push_vector(&mut columns, &format!("{stem}p"), series.iter().map(|r| r.center));
    }
    table("Joint Reactions", analysis, columns)
}

fn body_name(model: &Model, id: BodyId) -> &str {
    &model.bodies()[id.index()].name
}

/// `grf.mot`: forces, centres of pressure and free moments of both feet; an unloaded foot has zeros.
pub(crate) fn ground(model: &Model, analysis: &Analysis) -> Result<Table, Error> {
    let columns = ground_columns(&feet(model, &analysis.ground), analysis.trajectory.grid().frames);
    table("Ground Reactions", analysis, columns)
}

/// `ground_force_{s}_v`, `ground_force_{s}_p` and `ground_torque_{s}_` with x, y, z, for both sides; an unloaded foot has zeros.
#[must_use]
pub fn ground_columns(feet: &[(Side, BodyForces)], frames: usize) -> Vec<(String, Vec<f64>)> {
    let mut columns = Vec::new();
    for side in Side::BOTH {
        let letter = side.letter();
        let foot = feet.iter().find(|(s, _)| *s == side).map(|(_, f)| f);
        let loaded = |frame: usize| foot.is_some_and(|f| !f.center_of_pressure[frame].x.is_nan());
        let series = |pick: &dyn Fn(&BodyForces, usize) -> Vec3| {
            let at = |i: usize| foot.filter(|_| loaded(i)).map_or(Vec3::zeros(), |f| pick(f, i));
            (0..frames).map(at).collect::<Vec<_>>()
        };
        push_vector(&mut columns, &format!("ground_force_{letter}_v"), series(&|f, i| f.force[i]));
        push_vector(&mut columns, &format!("ground_force_{letter}_p"), series(&|f, i| f.center_of_pressure[i]));
        push_vector(&mut columns, &format!("ground_torque_{letter}_"), series(&|f, i| f.free_moment[i]));
    }
    columns
}

/// `external_loads.xml`: tells OpenSim how to apply `grf.mot`.
pub(crate) fn external_loads(model: &Model, analysis: &Analysis) -> ExternalLoads {
    let force = |(side, foot): (Side, BodyForces)| {
        let prefix = format!("ground_force_{}_", side.letter());
        ExternalForce::with_prefix(&format!("{side}_ground_reaction"), body_name(model, foot.body), &prefix)
    };
    ExternalLoads {
        name: "ground_reactions".into(),
        datafile: Some("grf.mot".into()),
        forces: feet(model, &analysis.ground).into_iter().map(force).collect(),
    }
}

/// `events.csv`.
pub(crate) fn events_csv(events: &[Event]) -> String {
    let mut text = format!("{EVENTS_HEAD}\n");
    for event in events {
        text += &format!("{},{},{}\n", event.side.letter(), event.kind.word(), event.time_s);
    }
    text
}

const EVENTS_HEAD: &str = "side,event,time";

/// Reads `events.csv`; an error reports the line, what was found and what was expected.
pub(crate) fn read_events(text: &str) -> Result<Vec<Event>, String> {
    let event = |(i, line): (usize, &str)| {
        let refused = || format!("line {}: found `{line}`; expected side (r, l), event (strike, off) and time", i + 1);
        event(line).ok_or_else(refused)
    };
    text.lines().enumerate().skip(1).map(event).collect()
}

fn event(line: &str) -> Option<Event> {
    let cells: Vec<&str> = line.split(',').collect();
    let [letter, kind, time] = cells[..] else { return None };
    let side = Side::BOTH.into_iter().find(|side| side.letter() == letter)?;
    let kind = [EventKind::Strike, EventKind::Off].into_iter().find(|known| known.word() == kind)?;
    let time_s: f64 = time.parse().ok()?;
    is_sound(time_s).then_some(Event { side, kind, time_s })
}

fn push_vector(columns: &mut Vec<Column>, stem: &str, series: impl IntoIterator<Item = Vec3>) {
    let mut axes = [Vec::new(), Vec::new(), Vec::new()];
    for vector in series {
        for (axis, x) in axes.iter_mut().zip(vector.iter()) {
            axis.push(*x);
        }
    }
    columns.extend(["x", "y", "z"].iter().zip(axes).map(|(axis, values)| (format!("{stem}{axis}"), values)));
}

/// The vertical force below which a foot counts as unloaded [N], for the summary.
pub(crate) const UNLOADED_N: f64 = CENTER_OF_PRESSURE_LOAD_N;
