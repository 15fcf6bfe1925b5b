//! Panels of the joint moments of walking figures, in clinical signs, from `moments.sto`.

use super::instants::Instants;
use crate::clinical::{ClinicalNames, ClinicalQuantity, clinical_quantities};
use crate::page::block::Block;
use crate::page::contract::{Group, Origin, Panel, Role, Trace};
use crate::page::session::quality::over_time;
use crate::page::session::sides;
use ambulo::analysis::feasibility::Verdict;
use ambulo::model::Side;
use ambulo::simulation::FigureVerdict;
use ambulo_formats::table::Table;
use ambulo_results::{Folder, MOMENTS, ResultsError, SceneSummary};

/// A figure with a verdict.
pub(super) struct Figure {
    pub(super) name: String,
    pub(super) verdict: Verdict,
    pub(super) quantities: Vec<ClinicalQuantity>,
    /// Prefix of the names of its columns and panels; empty for a single figure.
    prefix: String,
    mass_kg: f64,
    table: Option<Table>,
}

/// All figures of a verdict.
pub(super) fn figures(folder: &Folder<'_>, summary: &SceneSummary) -> Result<Vec<Figure>, ResultsError> {
    let list = summary.verdict.as_ref().map_or(&[][..], |verdict| &verdict.figures);
    let table = folder.table(MOMENTS)?;
    let several = summary.world.figures > 1;
    let figure = |FigureVerdict { figure: name, verdict }: &FigureVerdict| {
        let prefix = if several { format!("{name}/") } else { String::new() };
        let mass_kg = verdict.mass_kg;
        let quantities = table.as_ref().map_or_else(Vec::new, |table| quantities(table, &prefix));
        Figure { name: name.clone(), verdict: verdict.clone(), quantities, prefix, mass_kg, table: table.clone() }
    };
    Ok(list.iter().map(figure).collect())
}

fn quantities(table: &Table, prefix: &str) -> Vec<ClinicalQuantity> {
    let stems: Vec<String> = table
        .names()
        .iter()
        .filter_map(|column| column.strip_prefix(prefix))
        .map(|column| Side::split_name(column).map_or_else(|| column.to_owned(), |(_, stem)| stem))
        .collect();
    // Built-in figures have the usual names.
    clinical_quantities(&ClinicalNames::usual(), |name| stems.iter().any(|stem| stem == name))
}

/// One group per figure; none for figures whose moments are not in the files.
pub(super) fn groups(figures: &[Figure], instants: &Instants, block: &mut Block) -> Vec<Group> {
    let grid = |figure: &Figure, block: &mut Block| Group {
        id: figure.panel("kinetics"),
        title: format!("Joint moments of {}", figure.name),
        note: Some("Internal moments per kilogram of body mass, over time.".to_owned()),
        columns: 3,
        panels: figure.quantities.iter().map(|quantity| figure.panel_of(quantity, instants, block)).collect(),
    };
    figures.iter().filter(|figure| !figure.quantities.is_empty()).map(|figure| grid(figure, block)).collect()
}

impl Figure {
    /// The id of one of its panels.
    pub(super) fn panel(&self, id: &str) -> String {
        format!("{}{id}", self.prefix.replace(|letter: char| !letter.is_ascii_alphanumeric(), "_"))
    }

    fn panel_of(&self, quantity: &ClinicalQuantity, instants: &Instants, block: &mut Block) -> Panel {
        let traces = Side::BOTH.into_iter().filter_map(|side| self.trace(quantity, side, instants, block)).collect();
        let id = self.panel(quantity.id);
        over_time([&id, quantity.title, quantity.unit], [quantity.positive, quantity.negative], traces)
    }

    fn trace(&self, quantity: &ClinicalQuantity, side: Side, instants: &Instants, block: &mut Block) -> Option<Trace> {
        let table = self.table.as_ref()?;
        let column = format!("{}{}_moment", self.prefix, quantity.coordinates[side]);
        let values = table.column(&column)?;
        let factor = quantity.factor(self.mass_kg, side);
        let rows: Vec<(f64, f64)> = table.times()?.iter().zip(values).map(|(t, x)| (*t, factor * x)).collect();
        Some(Trace {
            name: side.to_string(),
            side: Some(sides::page(side)),
            role: Role::Main,
            values: block.add(&instants.nearest(&rows)),
            sd: None,
            predicted: Vec::new(),
            origin: Some(Origin { file: MOMENTS.to_owned(), column, factor }),
        })
    }
}
