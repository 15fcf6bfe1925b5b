//! Forces between bodies that touch, over time.

use super::instants::Instants;
use crate::model::Side;
use crate::report::page::block::Block;
use crate::report::page::contract::{Group, Role, Trace};
use crate::report::page::folder::{Folder, PageError};
use crate::report::page::session::quality::over_time;
use crate::report::page::session::sides;
use crate::report::stage::csv_rows::Row;
use std::collections::BTreeMap;

const FILE: &str = "contacts.csv";
const HEAD: &str = "time,kind,first,second,px,py,pz,nx,ny,nz,fx,fy,fz,normal_force,friction_force";
/// More pairs than this are left out; those with the largest forces are shown.
const MOST_PAIRS: usize = 8;

/// Sums of the points of every pair of bodies; none without the file.
pub(super) fn group(
    folder: &Folder<'_>,
    instants: &Instants,
    block: &mut Block,
    missing: &mut Vec<String>,
) -> Result<Option<Group>, PageError> {
    let Some(text) = folder.text(FILE)? else { return Ok(None) };
    let mut pairs: BTreeMap<(String, String), [Vec<f64>; 2]> = BTreeMap::new();
    for row in Row::all(folder, FILE, &text, HEAD)? {
        let place = instants.place(row.numbers::<1>(0)?[0]);
        let Some(place) = place.filter(|_| row.word(1).is_ok_and(|kind| kind == "contact")) else { continue };
        let names = (row.word(2)?.to_owned(), row.word(3)?.to_owned());
        let sums = pairs.entry(names).or_insert_with(|| [(); 2].map(|()| vec![0.0; instants.count()]));
        let forces: [f64; 2] = row.numbers(13)?;
        for (sum, force) in sums.iter_mut().zip(forces) {
            sum[place] += force;
        }
    }
    let mut pairs: Vec<_> = pairs.into_iter().collect();
    let largest = |sums: &[Vec<f64>; 2]| sums[0].iter().copied().fold(0.0, f64::max);
    pairs.sort_by(|a, b| largest(&b.1).total_cmp(&largest(&a.1)));
    if pairs.len() > MOST_PAIRS {
        let all = pairs.len();
        missing.push(format!(
            "Of {all} pairs of bodies that touch, the {MOST_PAIRS} with the largest forces have curves."
        ));
        pairs.truncate(MOST_PAIRS);
    }
    let mut panel = |id: &str, title: &str, which: usize| {
        let traces = pairs.iter().map(|((first, second), sums)| Trace {
            name: format!("{second} on {first}"),
            side: Side::of_name(first).map(sides::page),
            role: Role::Main,
            values: block.add(&sums[which]),
            sd: None,
            origin: None,
        });
        over_time([id, title, "N"], ["", ""], traces.collect())
    };
    let panels = vec![panel("contact_normal", "Normal force", 0), panel("contact_friction", "Friction force", 1)];
    let note = "Sums over the points at which two bodies touch; impacts between rows are not in them.";
    Ok(Some(Group {
        id: "contacts".to_owned(),
        title: "Contacts".to_owned(),
        note: Some(note.to_owned()),
        columns: 2,
        panels,
    }))
}
