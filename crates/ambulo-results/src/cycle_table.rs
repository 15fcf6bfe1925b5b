//! Time-normalised curves over the gait cycle, as rows of `cycles.csv`.

use crate::sound::{EXPECTED, is_sound};
use ambulo::analysis::{Analysis, CYCLE_SAMPLES, Cycle, over_cycle_of};
use ambulo::dynamics::JointMoments;
use ambulo::ground::BodyForces;
use ambulo::model::anatomy::Movement;
use ambulo::model::{BySide, CoordinateId, CoordinateKind, Model, Side};
use ambulo::motion::TimeGrid;
use ambulo::muscles::contact_loads::LegLoads;
use ambulo::spatial::Vec3;
use ambulo_formats::number::NumberText;
use ambulo_formats::table::{guarded, unguarded};
use std::collections::BTreeSet;

/// One curve of one cycle: 101 values.
#[derive(Debug, Clone, PartialEq)]
pub struct CycleRow {
    /// The quantity, without the side: `knee_angle_moment`.
    pub quantity: String,
    /// The foot whose cycle it is.
    pub side: Side,
    /// Number of the cycle of this foot, from 1.
    pub cycle: usize,
    /// `deg`, `m`, `rad`, `N.m`, `N`, `W` or `BW`.
    pub unit: &'static str,
    /// Values at 0, 1, ... 100 %.
    pub values: Vec<f64>,
    /// Foot off [% of the cycle], if known; not written to the file.
    pub foot_off_percent: Option<f64>,
}

/// Moments of the legs that no coordinate of the model may have, with the movement that they drive. The axis of an
/// ankle's inversion seldom belongs to a coordinate, so these moments of the ankle are in all tables.
pub const JOINT_MOMENTS: [(&str, Movement); 5] = [
    ("hip_rotation_moment", Movement::HipRotation),
    ("knee_adduction_moment", Movement::KneeAdduction),
    ("knee_rotation_moment", Movement::KneeRotation),
    ("ankle_inversion_moment", Movement::SubtalarInversion),
    ("ankle_rotation_moment", Movement::FootRotation),
];

/// Angle, moment and power of every coordinate, the moments of the legs in the other planes, and the ground forces,
/// over every cycle. Coordinates of a leg are cut into the cycles of that leg; coordinates of pelvis and trunk into the
/// cycles of both.
#[must_use]
pub fn cycle_rows(model: &Model, analysis: &Analysis) -> Vec<CycleRow> {
    let moments = analysis.joint_moments(model);
    analysis.cycles.iter().flat_map(|cycle| rows_of(model, analysis, cycle, &moments)).collect()
}

/// The curves of one cycle.
pub(crate) fn rows_of(model: &Model, analysis: &Analysis, cycle: &Cycle, moments: &JointMoments<'_>) -> Vec<CycleRow> {
    let grid = analysis.trajectory.grid();
    let mut rows: Vec<CycleRow> =
        model.coordinate_ids().flat_map(|id| coordinate_rows(model, analysis, cycle, id)).collect();
    let more = joint_moment_rows(model, moments, cycle, grid);
    let names: BTreeSet<String> = rows.iter().map(|row| row.quantity.clone()).collect();
    rows.extend(more.into_iter().filter(|row| !names.contains(&row.quantity)));
    rows.extend(ground_rows(model, analysis, cycle, grid));
    rows
}

/// Moments of the leg that no coordinate has, from the reactions in its joints.
fn joint_moment_rows(model: &Model, moments: &JointMoments<'_>, cycle: &Cycle, grid: TimeGrid) -> Vec<CycleRow> {
    let found = |(name, movement): (&str, Movement)| {
        let is_of_coordinate =
            movement < Movement::AnkleDorsiflexion && model.anatomy().coordinate(movement, Some(cycle.side)).is_some();
        moments.at(movement, cycle.side, 0).filter(|_| !is_of_coordinate)?;
        let at = |frame: usize| moments.at(movement, cycle.side, frame).unwrap_or(f64::NAN);
        Some(row(name.to_owned(), "N.m", cycle, grid, at))
    };
    JOINT_MOMENTS.into_iter().filter_map(found).collect()
}

/// A curve of the cycle; `value` is the quantity at a frame.
fn row(quantity: String, unit: &'static str, cycle: &Cycle, grid: TimeGrid, value: impl Fn(usize) -> f64) -> CycleRow {
    let duration = cycle.end_s - cycle.start_s;
    CycleRow {
        quantity,
        side: cycle.side,
        cycle: cycle.number,
        unit,
        values: over_cycle_of(grid, value, cycle),
        foot_off_percent: cycle.foot_off_s.map(|t| 100.0 * (t - cycle.start_s) / duration),
    }
}

fn coordinate_rows(model: &Model, analysis: &Analysis, cycle: &Cycle, id: CoordinateId) -> Vec<CycleRow> {
    let coordinate = &model.coordinates()[id.index()];
    let stem = model.coordinate_stem(id);
    if model.anatomy().coordinate_side(id).is_some_and(|s| s != cycle.side) {
        return Vec::new();
    }
    let grid = analysis.trajectory.grid();
    let values = analysis.trajectory.values(id);
    let (position_unit, force_unit) = match coordinate.kind {
        CoordinateKind::Rotation => ("deg", "N.m"),
        CoordinateKind::Translation => ("m", "N"),
        CoordinateKind::Coupled => ("rad", "N.m"),
    };
    let position = |i: usize| if position_unit == "deg" { values[i].to_degrees() } else { values[i] };
    let (force_values, powers) = (&analysis.forces.generalized[id.index()], analysis.powers(model));
    let what = if coordinate.kind == CoordinateKind::Translation { "position" } else { "angle" };
    let force = coordinate.kind.force_suffix();
    vec![
        row(format!("{stem}_{what}"), position_unit, cycle, grid, position),
        row(format!("{stem}_{force}"), force_unit, cycle, grid, |i| force_values[i]),
        row(format!("{stem}_power"), "W", cycle, grid, |i| powers.at(id, i)),
    ]
}

/// Vertical, fore-aft (along world x) and lateral (along world z, to the right) ground force in body weights.
fn ground_rows(model: &Model, analysis: &Analysis, cycle: &Cycle, grid: TimeGrid) -> Vec<CycleRow> {
    let up = model.up();
    let weight = analysis.mass.kg * model.gravity().norm();
    let is_own = |part: &&BodyForces| model.anatomy().body_side(part.body) == Some(cycle.side);
    let parts: Vec<&BodyForces> = analysis.ground.bodies.iter().filter(is_own).collect();
    if parts.is_empty() {
        return Vec::new();
    }
    let force = |i: usize| parts.iter().map(|part| part.force[i]).sum::<Vec3>();
    let forward = nalgebra::Vector3::x();
    [("vertical", up), ("fore_aft", forward), ("lateral", forward.cross(&up))]
        .into_iter()
        .map(|(name, axis)| row(format!("ground_force_{name}"), "BW", cycle, grid, |i| force(i).dot(&axis) / weight))
        .collect()
}

/// Loads of the joints with the tensions of the muscles: size of the force at hip, knee and ankle, and the shares of
/// the condyles along the shank, with their names in [`ambulo::study::Outcome::contact_load_stances`].
pub const CONTACT_LOADS: [(&str, &str); 5] = [
    ("hip", "hip_contact_force"),
    ("knee", "knee_contact_force"),
    ("ankle", "ankle_contact_force"),
    ("knee_medial", "knee_medial_force"),
    ("knee_lateral", "knee_lateral_force"),
];

/// These loads over a cycle [body weights]; none for a leg without them.
#[must_use]
pub fn contact_rows(
    model: &Model,
    analysis: &Analysis,
    loads: &BySide<Option<LegLoads>>,
    cycle: &Cycle,
) -> Vec<CycleRow> {
    let Some(LegLoads { joints, knee }) = &loads[cycle.side] else { return Vec::new() };
    let grid = analysis.trajectory.grid();
    let weight = analysis.mass.kg * model.gravity().norm();
    let [hip, knee_size, ankle] = joints.each_ref().map(|load| move |i: usize| load.in_child[i].force.norm());
    let values: [&dyn Fn(usize) -> f64; 5] = [&hip, &knee_size, &ankle, &|i| knee.medial[i], &|i| knee.lateral[i]];
    let of_load = |((_, name), value): ((&str, &str), &dyn Fn(usize) -> f64)| {
        row(name.to_owned(), "BW", cycle, grid, |i| value(i) / weight)
    };
    CONTACT_LOADS.into_iter().zip(values).map(of_load).collect()
}

/// First line.
pub const HEAD: &str = "quantity,side,cycle,percent,value,unit";
const UNITS: [&str; 7] = ["deg", "m", "rad", "N.m", "N", "W", "BW"];

/// The first line of `cycles.csv`.
pub(crate) fn head() -> String {
    format!("{HEAD}\n")
}

/// Lines of `cycles.csv`.
pub(crate) fn lines(rows: &[CycleRow]) -> String {
    let (mut text, mut number) = (String::new(), NumberText::default());
    let percents: Vec<String> = (0..CYCLE_SAMPLES).map(|percent| format!("{percent},")).collect();
    for row in rows {
        let curve = format!("{},{},{},", guarded(&row.quantity), row.side.letter(), row.cycle);
        for (percent, value) in percents.iter().zip(&row.values) {
            text.extend([curve.as_str(), percent, number.plain(*value), ",", row.unit, "\n"]);
        }
    }
    text
}

/// A line of the file.
struct Line<'a> {
    quantity: &'a str,
    side: Side,
    cycle: usize,
    percent: usize,
    value: f64,
    unit: &'static str,
}

/// Reads `cycles.csv`; an error reports the line, what was found and what was expected.
pub fn read(text: &str) -> Result<Vec<CycleRow>, String> {
    let mut lines = text.lines().enumerate();
    let head = lines.next().map_or("", |(_, line)| line);
    if head != HEAD {
        return Err(format!("line 1: found `{head}`; expected `{HEAD}`"));
    }
    let mut rows: Vec<CycleRow> = Vec::new();
    for (i, text) in lines {
        let line = line(text).ok_or_else(|| {
            let units = UNITS.join(", ");
            format!(
                "line {}: found `{text}`; expected {HEAD} with side r or l, as value {EXPECTED}, and a unit of {units}",
                i + 1
            )
        })?;
        let may_begin = line.percent == 0 && rows.last().is_none_or(is_whole);
        match rows.last_mut().filter(|row| continues(row, &line)) {
            Some(row) => row.values.push(line.value),
            None if may_begin => rows.push(begun(&line)),
            None => {
                let found = format!("line {}: found {} % of `{}`", i + 1, line.percent, line.quantity);
                return Err(format!("{found}; expected curves of {CYCLE_SAMPLES} rows, from 0 to 100 %"));
            }
        }
    }
    match rows.last().filter(|row| !is_whole(row)) {
        Some(row) => {
            let (quantity, found) = (&row.quantity, row.values.len());
            Err(format!("the last curve, `{quantity}`, has {found} rows; expected {CYCLE_SAMPLES}"))
        }
        None => Ok(rows),
    }
}

fn line(text: &str) -> Option<Line<'_>> {
    let mut cells = text.rsplitn(6, ',');
    let (unit, value, percent) = (cells.next()?, cells.next()?, cells.next()?);
    let (cycle, side, quantity) = (cells.next()?, cells.next()?, cells.next()?);
    let side = Side::BOTH.into_iter().find(|known| known.letter() == side)?;
    let unit = UNITS.into_iter().find(|known| *known == unit)?;
    let (cycle, percent) = (cycle.parse().ok()?, percent.parse().ok()?);
    let value = value.parse().ok().filter(|value| is_sound(*value))?;
    Some(Line { quantity: unguarded(quantity), side, cycle, percent, value, unit })
}

fn begun(line: &Line<'_>) -> CycleRow {
    CycleRow {
        quantity: line.quantity.to_owned(),
        side: line.side,
        cycle: line.cycle,
        unit: line.unit,
        values: vec![line.value],
        foot_off_percent: None,
    }
}

fn is_whole(row: &CycleRow) -> bool {
    row.values.len() == CYCLE_SAMPLES
}

fn continues(row: &CycleRow, line: &Line<'_>) -> bool {
    line.percent > 0
        && line.percent == row.values.len()
        && row.quantity == line.quantity
        && (row.side, row.cycle) == (line.side, line.cycle)
}
