//! Forces between bodies that touch, over time.

use super::instants::Instants;
use crate::page::block::Block;
use crate::page::contract::{Group, Panel, Role, Trace};
use crate::page::session::quality::over_time;
use crate::page::session::sides;
use crate::stage::csv_rows::Row;
use ambulo::model::Side;
use ambulo::numerics::Order;
use ambulo_results::{CONTACTS, Folder, ResultsError};
use std::collections::BTreeMap;

const HEAD: &str = "time,kind,first,second,px,py,pz,nx,ny,nz,fx,fy,fz,normal_force,friction_force";
/// Maximum number of panels of a kind; those with the largest forces are shown.
const MOST_PAIRS: usize = 12;

/// A body, or all bodies of a figure, and the body in contact with it.
type Pair = (String, String);

/// Sums over the contact points between a body, or a side of a figure, and another body: right, left and without side.
#[derive(Default)]
struct Sums {
    sides: [Option<[Vec<f64>; 2]>; 3],
}

/// Sums over the contact points of every pair of bodies; empty without the file.
pub(super) fn group(
    folder: &Folder<'_>,
    instants: &Instants,
    block: &mut Block,
    missing: &mut Vec<String>,
) -> Result<Option<Group>, ResultsError> {
    let Some(text) = folder.text(CONTACTS)? else { return Ok(None) };
    let mut pairs: Vec<(Pair, Sums)> = sums(folder, &text, instants)?.into_iter().collect();
    pairs.sort_by_number(|pair| -pair.1.largest());
    if pairs.len() > MOST_PAIRS {
        let all = pairs.len();
        missing.push(format!(
            "Of {all} pairs of bodies in contact, only the {MOST_PAIRS} with the largest forces are shown."
        ));
        pairs.truncate(MOST_PAIRS);
    }
    let panels = pairs.iter().enumerate().flat_map(|(i, (pair, sums))| sums.panels(i + 1, pair, block)).collect();
    let note = "Sums over all contact points of two bodies; bodies on one side of a figure are added up. Impacts \
        between output instants are not included.";
    Ok(Some(Group {
        id: "contacts".to_owned(),
        title: "Contacts".to_owned(),
        note: Some(note.to_owned()),
        columns: 2,
        panels,
    }))
}

fn sums(folder: &Folder<'_>, text: &str, instants: &Instants) -> Result<BTreeMap<Pair, Sums>, ResultsError> {
    let mut pairs: BTreeMap<Pair, Sums> = BTreeMap::new();
    for row in Row::all(folder, CONTACTS, text, HEAD)? {
        let place = instants.place(row.numbers::<1>(0)?[0]);
        let Some(place) = place.filter(|_| row.word(1).is_ok_and(|kind| kind == "contact")) else { continue };
        let (first, second) = (row.word(2)?, row.word(3)?);
        let owner = first.split_once('/').map_or(first, |(figure, _)| figure);
        let sums = pairs.entry((owner.to_owned(), second.to_owned())).or_default();
        let zeros = || [(); 2].map(|()| vec![0.0; instants.count()]);
        let of_side = sums.sides[slot(Side::of_name(first))].get_or_insert_with(zeros);
        for (sum, force) in of_side.iter_mut().zip(row.numbers::<2>(13)?) {
            sum[place] += force;
        }
    }
    Ok(pairs)
}

fn slot(side: Option<Side>) -> usize {
    match side {
        Some(Side::Right) => 0,
        Some(Side::Left) => 1,
        None => 2,
    }
}

impl Sums {
    /// Largest normal force.
    fn largest(&self) -> f64 {
        self.sides.iter().flatten().flat_map(|[normal, _]| normal).copied().fold(0.0, f64::max)
    }

    /// Normal force and friction, one trace per side.
    fn panels(&self, number: usize, (first, second): &Pair, block: &mut Block) -> [Panel; 2] {
        let mut panel = |kind: &str, words: &str, which: usize| {
            let sides = [Some(Side::Right), Some(Side::Left), None];
            let traces = sides.into_iter().filter_map(|side| {
                let sums = self.sides[slot(side)].as_ref()?;
                Some(Trace {
                    name: side.map_or_else(|| first.clone(), |side| side.to_string()),
                    side: side.map(sides::page),
                    role: Role::Main,
                    values: block.add(&sums[which]),
                    sd: None,
                    predicted: Vec::new(),
                    origin: None,
                })
            });
            let (id, title) = (format!("contact_{number}_{kind}"), format!("{words}, {second} on {first}"));
            over_time([&id, &title, "N"], ["", ""], traces.collect())
        };
        [panel("normal", "Normal force", 0), panel("friction", "Friction", 1)]
    }
}
