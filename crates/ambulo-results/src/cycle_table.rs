//! Curves over the gait cycle, as rows.

use ambulo::analysis::{Analysis, Cycle, over_cycle};
use ambulo::ground::{feet, upward};
use ambulo::model::{CoordinateId, CoordinateKind, Model, Side};
use ambulo::motion::TimeGrid;

/// One curve of one cycle: 101 values.
#[derive(Debug, Clone, PartialEq)]
pub struct CycleRow {
    /// What it is, without the side: `knee_angle_moment`.
    pub quantity: String,
    /// The foot whose cycle it is.
    pub side: Side,
    /// Number of the cycle of this foot, from 1.
    pub cycle: usize,
    /// `deg`, `m`, `rad`, `N.m`, `N`, `W` or `BW`.
    pub unit: &'static str,
    /// Values at 0, 1, ... 100 %.
    pub values: Vec<f64>,
    /// Toe-off [% of the cycle], where it was seen.
    pub toe_off_percent: Option<f64>,
}

/// Angle, moment and power of every coordinate, and the ground forces, over every cycle. A leg's coordinates follow
/// that leg's cycles; pelvis and trunk follow both.
#[must_use]
pub fn cycle_rows(model: &Model, analysis: &Analysis) -> Vec<CycleRow> {
    let grid = analysis.trajectory.grid();
    let mut rows = Vec::new();
    for cycle in &analysis.cycles {
        for id in model.coordinate_ids() {
            rows.extend(coordinate_rows(model, analysis, cycle, id));
        }
        rows.extend(ground_rows(model, analysis, cycle, grid));
    }
    rows
}

fn row(quantity: String, unit: &'static str, cycle: &Cycle, grid: TimeGrid, series: &[f64]) -> CycleRow {
    let duration = cycle.end_s - cycle.start_s;
    CycleRow {
        quantity,
        side: cycle.side,
        cycle: cycle.number,
        unit,
        values: over_cycle(grid, series, cycle),
        toe_off_percent: cycle.foot_off_s.map(|t| 100.0 * (t - cycle.start_s) / duration),
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
    let (position, position_unit, force_unit) = match coordinate.kind {
        CoordinateKind::Rotation => (values.iter().map(|x| x.to_degrees()).collect(), "deg", "N.m"),
        CoordinateKind::Translation => (values.to_vec(), "m", "N"),
        CoordinateKind::Coupled => (values.to_vec(), "rad", "N.m"),
    };
    let what = if coordinate.kind == CoordinateKind::Translation { "position" } else { "angle" };
    let force = coordinate.kind.force_suffix();
    vec![
        row(format!("{stem}_{what}"), position_unit, cycle, grid, &position),
        row(format!("{stem}_{force}"), force_unit, cycle, grid, &analysis.forces.generalized[id.index()]),
        row(format!("{stem}_power"), "W", cycle, grid, &analysis.forces.powers[id.index()]),
    ]
}

/// Vertical, fore-aft (along world x) and lateral (along world z, to the right) ground force in body weights.
fn ground_rows(model: &Model, analysis: &Analysis, cycle: &Cycle, grid: TimeGrid) -> Vec<CycleRow> {
    let up = upward(model);
    let weight = analysis.mass.kg * model.gravity().norm();
    let feet = feet(model, &analysis.ground);
    let Some((_, foot)) = feet.into_iter().find(|(side, _)| *side == cycle.side) else { return Vec::new() };
    let forward = nalgebra::Vector3::x();
    [("vertical", up), ("fore_aft", forward), ("lateral", forward.cross(&up))]
        .into_iter()
        .map(|(name, axis)| {
            let series: Vec<f64> = foot.force.iter().map(|f| f.dot(&axis) / weight).collect();
            row(format!("ground_force_{name}"), "BW", cycle, grid, &series)
        })
        .collect()
}

/// `cycles.csv`: quantity, side, cycle, percent, value, unit.
pub(crate) fn csv(rows: &[CycleRow]) -> String {
    let mut text = String::from("quantity,side,cycle,percent,value,unit\n");
    for row in rows {
        for (percent, value) in row.values.iter().enumerate() {
            let (quantity, side) = (&row.quantity, row.side.letter());
            text += &format!("{quantity},{side},{},{percent},{value},{}\n", row.cycle, row.unit);
        }
    }
    text
}
