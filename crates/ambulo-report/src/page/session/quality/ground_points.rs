//! Panels of forces, centres of pressure and free moments over time: predictions with their uncertainty, on top of what
//! plates measured, or measurements alone.

use super::{CENTER_FORWARD, group, over_time};
use crate::page::block::Block;
use crate::page::contract::{Group, Origin, PageSource, Role, Trace};
use crate::page::session::results::Results;
use crate::page::session::sides;
use ambulo::model::Side;
use ambulo_formats::table::Table;
use ambulo_results::{GROUND, GROUND_MEASURED};

/// A panel: its id, heading, unit, directions, and the name of its column.
struct Row {
    id: &'static str,
    title: &'static str,
    unit: Unit,
    directions: [&'static str; 2],
    stem: &'static str,
    axis: &'static str,
}

#[derive(Clone, Copy, PartialEq)]
enum Unit {
    BodyWeights,
    Metres,
    NewtonMetres,
}

const fn row(
    id: &'static str,
    title: &'static str,
    unit: Unit,
    directions: [&'static str; 2],
    stem: &'static str,
    axis: &'static str,
) -> Row {
    Row { id, title, unit, directions, stem, axis }
}

const ROWS: [Row; 6] = [
    row("plates_vertical", "Vertical force", Unit::BodyWeights, ["up", "down"], "ground_force_{s}_v", "y"),
    row("plates_fore_aft", "Fore-aft force", Unit::BodyWeights, ["forward", "backward"], "ground_force_{s}_v", "x"),
    row("plates_lateral", "Sideways force", Unit::BodyWeights, ["right", "left"], "ground_force_{s}_v", "z"),
    row(
        CENTER_FORWARD,
        "Centre of pressure, forward",
        Unit::Metres,
        ["forward", "backward"],
        "ground_force_{s}_p",
        "x",
    ),
    row(
        "center_of_pressure_z",
        "Centre of pressure, sideways",
        Unit::Metres,
        ["right", "left"],
        "ground_force_{s}_p",
        "z",
    ),
    row("free_moment", "Free moment", Unit::NewtonMetres, ["", ""], "ground_torque_{s}_", "y"),
];

/// Explains the drawn band and the wider band of the table of agreement.
const BAND: &str = "Band: ± 1 standard deviation of the prediction (it contains 68 % of the true values if errors are \
    normally distributed). The 90 % band of the table of agreement is wider: ± 1.645 standard deviations.";

/// The group of panels; `None` without ground forces.
pub(super) fn ground_points(results: &Results, block: &mut Block) -> Option<Group> {
    let ground = results.ground.as_ref()?;
    let panels = ROWS.iter().map(|row| {
        let mut traces = Vec::new();
        for side in Side::BOTH {
            traces.extend(trace(results, row, side, (ground, GROUND, Role::Main), block));
            let measured = results.measured.as_ref().map(|table| (table, GROUND_MEASURED, Role::Measured));
            traces.extend(measured.and_then(|file| trace(results, row, side, file, block)));
        }
        over_time([row.id, row.title, row.unit.name()], row.directions, traces)
    });
    let (title, note) = headings(results);
    Some(group("overlay", title, note, 3, panels.collect()))
}

fn headings(results: &Results) -> (&'static str, String) {
    let band = match results.deviations {
        Some(_) => BAND,
        None => "Their uncertainty is not known (no grf_sd.mot).",
    };
    match (results.source, results.measured.is_some()) {
        (_, true) => (
            "Prediction and force plates",
            format!("Predicted and measured forces. {band} Measured forces are zero while no foot is on a plate."),
        ),
        (PageSource::Predicted, false) => {
            let title = match results.deviations {
                Some(_) => "Predicted ground forces and their uncertainty",
                None => "Predicted ground forces",
            };
            (title, format!("{band} No force plates measured them."))
        }
        _ => ("Ground forces over time", "World axes: x forward, y up, z to the right.".to_owned()),
    }
}

fn trace(
    results: &Results,
    row: &Row,
    side: Side,
    (table, file, role): (&Table, &str, Role),
    block: &mut Block,
) -> Option<Trace> {
    let letter = side.letter();
    let column = format!("{}{}", row.stem.replace("{s}", letter), row.axis);
    let factor = if row.unit == Unit::BodyWeights { 1.0 / results.weight_n } else { 1.0 };
    let load = table.column(&format!("ground_force_{letter}_vy"))?;
    // An unloaded foot has zeros in the file: a valid force, but no centre of pressure.
    let has_value = |frame: usize| row.unit == Unit::BodyWeights || load[frame].abs() > 0.0;
    let shown = |values: &[f64]| {
        let shown = values.iter().enumerate().map(|(frame, x)| if has_value(frame) { factor * x } else { f64::NAN });
        shown.collect::<Vec<f64>>()
    };
    let values = shown(table.column(&column)?);
    let deviation = results.deviations.as_ref().filter(|_| role == Role::Main);
    let sd = deviation.and_then(|table| table.column(&format!("{column}_sd"))).map(shown);
    let who = if role == Role::Measured { "plates, " } else { "" };
    Some(Trace {
        name: format!("{who}{side}"),
        side: Some(sides::page(side)),
        role,
        values: block.add(&values),
        sd: sd.map(|sd| block.add(&sd)),
        predicted: if role == Role::Main { results.predicted_times(side) } else { Vec::new() },
        origin: Some(Origin { file: file.to_owned(), column, factor }),
    })
}

impl Unit {
    fn name(self) -> &'static str {
        match self {
            Unit::BodyWeights => "BW",
            Unit::Metres => "m",
            Unit::NewtonMetres => "N.m",
        }
    }
}
