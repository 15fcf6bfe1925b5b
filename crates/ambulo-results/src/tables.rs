//! Makes tables of time series with the column names of OpenSim.

use crate::GROUND;
use crate::sound::is_sound;
use ambulo::analysis::{Analysis, Event, EventKind, FootContact};
use ambulo::dynamics::JointReaction;
use ambulo::ground::stances::Stance;
use ambulo::ground::{BodyForces, CENTER_OF_PRESSURE_LOAD_N, feet};
use ambulo::kinematics::Trajectory;
use ambulo::model::{BodyId, BySide, CoordinateKind, Model, Side};
use ambulo::spatial::Vec3;
use ambulo_formats::Error;
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use ambulo_formats::table::TableRows;
use std::borrow::{Borrow, Cow};
use std::rc::Rc;
use std::sync::Arc;

pub(crate) type Column = (String, Vec<f64>);
/// For each frame the source of the load of each foot ([`ambulo::study::Outcome::load_sources`]).
pub(crate) type LoadSources = Option<Arc<BySide<Vec<f64>>>>;
/// A column whose values are computed when they are needed.
pub(crate) type LazyColumn<'a> = (String, Box<dyn Fn(usize) -> f64 + 'a>);

pub(crate) fn table(name: &str, analysis: &Analysis, columns: Vec<Column>) -> Result<TableRows<'static>, Error> {
    let columns =
        columns.into_iter().map(|(name, values)| -> LazyColumn<'static> { (name, Box::new(move |i| values[i])) });
    rows(name, analysis, columns)
}

pub(crate) fn rows<'a>(
    name: &str,
    analysis: &Analysis,
    columns: impl IntoIterator<Item = LazyColumn<'a>>,
) -> Result<TableRows<'a>, Error> {
    let grid = analysis.trajectory.grid();
    let time: LazyColumn<'a> = ("time".to_owned(), Box::new(move |i| grid.time(i)));
    let mut table = TableRows::new(name, grid.frames, std::iter::once(time).chain(columns).collect())?;
    table.in_degrees = Some(false);
    Ok(table)
}

pub(crate) fn column<'a>(name: String, values: &'a [f64]) -> LazyColumn<'a> {
    (name, Box::new(move |i| values[i]))
}

/// `kinematics.mot`: the coordinates used for the analysis, rotations in degrees.
pub(crate) fn kinematics<'a>(model: &'a Model, analysis: &'a Analysis) -> Result<TableRows<'a>, Error> {
    let is_recorded = analysis.recorded.is_none();
    let title = if is_recorded { "Coordinates" } else { "Coordinates, changed to agree with the forces" };
    coordinates(title, model, analysis, &analysis.trajectory)
}

/// The coordinates of a motion on the frames of an analysis: `kinematics_recorded.mot` has the recorded one.
pub(crate) fn coordinates<'a>(
    title: &str,
    model: &'a Model,
    analysis: &Analysis,
    trajectory: &'a Trajectory,
) -> Result<TableRows<'a>, Error> {
    let columns = model.coordinate_ids().map(|id| -> LazyColumn<'a> {
        let coordinate = &model.coordinates()[id.index()];
        let values = trajectory.values(id);
        let shown: Box<dyn Fn(usize) -> f64 + 'a> = match coordinate.kind {
            CoordinateKind::Rotation => Box::new(move |i| values[i].to_degrees()),
            CoordinateKind::Translation | CoordinateKind::Coupled => Box::new(move |i| values[i]),
        };
        (coordinate.name.clone(), shown)
    });
    let mut table = rows(title, analysis, columns)?;
    table.in_degrees = Some(true);
    Ok(table)
}

/// `foot_contact.sto`: 1 in frames in which an end of a sole touches the ground, else 0.
pub(crate) fn foot_contact(
    analysis: &Analysis,
    contact: &BySide<Vec<FootContact>>,
) -> Result<TableRows<'static>, Error> {
    let column = |side: Side, part: &str, touches: fn(&FootContact) -> bool| -> Column {
        let values = contact[side].iter().map(|contact| f64::from(u8::from(touches(contact)))).collect();
        (format!("{part}_{}_contact", side.letter()), values)
    };
    let of_side =
        |side: Side| [column(side, "heel", |contact| contact.heel), column(side, "toes", |contact| contact.toes)];
    let is_known = |side: &Side| !contact[*side].is_empty();
    table("Foot contact", analysis, Side::BOTH.into_iter().filter(is_known).flat_map(of_side).collect())
}

/// `moments.sto`: generalised forces [N.m or N]. `device`, if given, is subtracted column by column.
pub(crate) fn moments<'a>(
    model: &'a Model,
    analysis: &'a Analysis,
    device: Option<&'a [Vec<f64>]>,
    sources: &LoadSources,
) -> Result<TableRows<'a>, Error> {
    let of = |(k, name): (usize, String)| -> LazyColumn<'a> {
        let total = &analysis.forces.generalized[k];
        match device.and_then(|device| device.get(k)) {
            Some(help) => (name, Box::new(move |i| total[i] - help[i])),
            None => column(name, total),
        }
    };
    let title = if device.is_some() { "Biological Generalized Forces" } else { "Inverse Dynamics Generalized Forces" };
    rows(title, analysis, model.force_names().into_iter().enumerate().map(of).chain(marks(sources)))
}

/// `powers.sto`: power of the generalised force of each coordinate [W].
pub(crate) fn powers<'a>(
    model: &'a Model,
    analysis: &'a Analysis,
    sources: &LoadSources,
) -> Result<TableRows<'a>, Error> {
    let powers = Rc::new(analysis.powers(model));
    let columns = model.coordinate_ids().map(|id| -> LazyColumn<'a> {
        let powers = Rc::clone(&powers);
        (format!("{}_power", model.coordinates()[id.index()].name), Box::new(move |i| powers.at(id, i)))
    });
    rows("Joint Powers", analysis, columns.chain(marks(sources)))
}

/// `reactions.sto`: for each joint `<joint>_on_<child>_in_ground_` and force `f` [N], moment `m` about the joint centre
/// [N.m] and that centre `p` [m], all of the parent on the child in world axes.
pub(crate) fn reactions<'a>(
    model: &'a Model,
    analysis: &'a Analysis,
    sources: &LoadSources,
) -> Result<TableRows<'a>, Error> {
    let mut columns: Vec<LazyColumn<'a>> = Vec::new();
    let axes = || ["x", "y", "z"].into_iter().enumerate();
    let reactions = Rc::new(analysis.reactions(model));
    for (id, body) in model.body_ids().zip(model.bodies()) {
        let at = |pick: fn(&JointReaction) -> Vec3, k: usize| -> Box<dyn Fn(usize) -> f64 + 'a> {
            let reactions = Rc::clone(&reactions);
            Box::new(move |i| pick(&reactions.at(id, i))[k])
        };
        let stem = format!("{}_on_{}_in_ground_", body.joint.name, body.name);
        columns.extend(axes().map(|(k, axis)| (format!("{stem}f{axis}"), at(|reaction| reaction.wrench.force, k))));
        columns.extend(axes().map(|(k, axis)| (format!("{stem}m{axis}"), at(|reaction| reaction.wrench.moment, k))));
        columns.extend(axes().map(|(k, axis)| (format!("{stem}p{axis}"), at(|reaction| reaction.center, k))));
    }
    rows("Joint Reactions", analysis, columns.into_iter().chain(marks(sources)))
}

fn body_name(model: &Model, id: BodyId) -> &str {
    &model.bodies()[id.index()].name
}

/// `grf.mot`: forces, centres of pressure and free moments of both feet; an unloaded foot has zeros.
pub(crate) fn ground(model: &Model, analysis: &Analysis, sources: &LoadSources) -> Result<TableRows<'static>, Error> {
    let columns = ground_columns(&feet(model, &analysis.ground), analysis.trajectory.grid().frames);
    let columns =
        columns.into_iter().map(|(name, values)| -> LazyColumn<'static> { (name, Box::new(move |i| values[i])) });
    rows("Ground Reactions", analysis, columns.chain(marks(sources)))
}

/// `ground_source_r` and `_l`: 0 where the load of the foot was measured or the foot is in the air, 1 where it was
/// predicted, 2 where it is unknown. No columns where nothing is marked.
pub(crate) fn marks<'a>(sources: &LoadSources) -> Vec<LazyColumn<'a>> {
    let column = |side: Side, sources: &Arc<BySide<Vec<f64>>>| -> LazyColumn<'a> {
        let sources = Arc::clone(sources);
        (format!("ground_source_{}", side.letter()), Box::new(move |i| sources[side][i]))
    };
    sources.iter().flat_map(|sources| Side::BOTH.map(|side| column(side, sources))).collect()
}

/// `ground_force_{s}_v`, `ground_force_{s}_p` and `ground_torque_{s}_` with x, y, z, for both sides; an unloaded foot
/// has zeros.
#[must_use]
pub fn ground_columns(feet: &[(Side, impl Borrow<BodyForces>)], frames: usize) -> Vec<(String, Vec<f64>)> {
    let mut columns = Vec::new();
    for side in Side::BOTH {
        let letter = side.letter();
        let foot = feet.iter().find(|(s, _)| *s == side).map(|(_, f)| f.borrow());
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

/// `external_loads.xml`: how OpenSim applies `grf.mot`.
pub(crate) fn external_loads(model: &Model, analysis: &Analysis) -> ExternalLoads {
    let force = |(side, foot): (Side, Cow<'_, BodyForces>)| {
        let prefix = format!("ground_force_{}_", side.letter());
        ExternalForce::with_prefix(&format!("{side}_ground_reaction"), body_name(model, foot.body), &prefix)
    };
    ExternalLoads {
        name: "ground_reactions".into(),
        datafile: Some(GROUND.into()),
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

/// `stances.csv`.
pub(crate) fn stances_csv(stances: &[Stance]) -> String {
    let mut text = "side,start,end,source\n".to_owned();
    for Stance { side, start_s, end_s, source } in stances {
        text += &format!("{},{start_s},{end_s},{source}\n", side.letter());
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
