//! Table of peaks and impulses of the joint contact loads over whole stances.

use crate::page::contract::{Cell, Table};
use crate::page::session::cells::{number, spread_cell, table, text};
use ambulo::analysis::symmetry_index;
use ambulo::model::BySide;
use ambulo_results::{MuscleSummary, QuantitySummary, SpreadSummary};

/// Asymmetry above this is marked [%], as in the table of both sides.
const ASYMMETRIC: f64 = 10.0;

const NOTE: &str = "Size of the force in hip, knee and ankle, and the knee's compression of each condyle, over whole \
    stances: mean ± standard deviation of the largest values in the first and in the second half of stance, and of the \
    area below the curve. Estimates of the model, not measured loads. Sides whose forces have different sources are \
    not compared.";

/// The table; `None` if no whole stance has loads.
pub(in crate::page::session) fn contact_table(muscles: Option<&MuscleSummary>) -> Option<Table> {
    let quantities = &muscles?.contact_loads;
    let columns = ["", "Unit", "Right", "Left", "Difference [%]", "Forces"].map(str::to_owned).to_vec();
    let rows: Vec<Vec<Cell>> = quantities.iter().map(row).chain(medial_share(quantities)).collect();
    (!rows.is_empty()).then(|| table(["contact_loads", "Joint contact loads", NOTE], columns, rows))
}

fn row(found: &QuantitySummary) -> Vec<Cell> {
    let [right, left] = [&found.right, &found.left].map(|side| spread_cell(side.as_ref(), 2, None));
    let difference = asymmetry(found.symmetry);
    let name = found.quantity.replace('_', " ");
    vec![text(&name), text(&found.unit), right, left, difference, text(&found.source_words())]
}

/// The share of the medial condyle in the mean impulses of both.
fn medial_share(quantities: &[QuantitySummary]) -> Option<Vec<Cell>> {
    let impulse = |name: &str| quantities.iter().find(|known| known.quantity == name);
    let (medial, lateral) = (impulse("knee_medial_impulse")?, impulse("knee_lateral_impulse")?);
    let share = |medial: &Option<SpreadSummary>, lateral: &Option<SpreadSummary>| {
        let (medial, lateral) = (medial.as_ref()?.mean, lateral.as_ref()?.mean);
        Some(100.0 * medial / (medial + lateral)).filter(|share| share.is_finite())
    };
    let shares = BySide { right: share(&medial.right, &lateral.right), left: share(&medial.left, &lateral.left) };
    let [right, left] = [shares.right, shares.left].map(|share| number(share, 0, None));
    let compared = shares.both().filter(|_| medial.symmetry.is_some());
    let difference = asymmetry(compared.and_then(|sides| symmetry_index(sides.right, sides.left)));
    let name = "knee medial share of the impulse";
    Some(vec![text(name), text("%"), right, left, difference, text(&medial.source_words())])
}

fn asymmetry(symmetry: Option<f64>) -> Cell {
    number(symmetry.map(|index| 100.0 * index), 0, Some([-ASYMMETRIC, ASYMMETRIC]))
}
