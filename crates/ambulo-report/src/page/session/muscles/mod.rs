//! Muscles, and the loads that joints carry because of them: panels, a table, and measures of quality.
//!
//! All parts are empty for a folder without `muscles.sto` and `reactions_contact.sto`.

mod activations;
mod contact;
mod contact_table;
mod muscle_groups;
mod reserves;
mod side_curves;

pub(super) use contact_table::contact_table;
pub(super) use reserves::{facts, reserve_table};

use super::results::Results;
use crate::page::block::Block;
use crate::page::contract::Group;
use ambulo_results::{CONTACT_REACTIONS, MUSCLES};

/// Grids of contact loads and of activations.
pub(super) fn groups(results: &Results, block: &mut Block) -> Vec<Group> {
    [contact::group(results, block), activations::group(results, block)].into_iter().flatten().collect()
}

/// One sentence for each part that the folder should have but cannot show.
pub(super) fn missing(results: &Results) -> Vec<String> {
    let mut sentences = Vec::new();
    if results.muscles.is_some() && results.contact.is_none() {
        sentences.push(format!("No joint contact loads: the folder has no {CONTACT_REACTIONS}."));
    }
    if results.contact.is_some() && contact::loads(results).is_empty() {
        sentences.push(format!(
            "No joint contact loads: {CONTACT_REACTIONS} has no columns of the hips, knees and ankles of the folder's \
             body."
        ));
    }
    if results.muscles.is_some() && !activations::is_shown(results) {
        sentences.push(format!(
            "No panels of muscles: {MUSCLES} has no activation of a muscle with a known name (soleus_r, vasmed_l, ...)."
        ));
    }
    sentences
}
