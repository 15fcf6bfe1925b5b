//! Lists parts that the page cannot show, with the reason.

use super::curves::over_time;
use super::results::Results;
use super::size::{BodySize, NO_DOUBLE_SUPPORT, Turn};
use super::still;
use crate::clinical::{ClinicalGroup, ClinicalQuantity};
use crate::page::contract::PageSource;
use ambulo::analysis::StrideQuantity;
use ambulo::model::Side;
use ambulo::numerics::degrees;
use ambulo_results::{GROUND_SD, MOMENTS, POWERS};
use std::collections::BTreeMap;

/// Clinical angles that models often lack, with the reason.
const LACKING: [(&str, &str); 5] = [
    ("pelvis_obliquity_angle", "pelvic obliquity and rotation (the body moves in a plane)"),
    ("hip_adduction_angle", "hip adduction and rotation (the body moves in a plane)"),
    ("knee_flexion_angle", "knee flexion (no body file shows which direction is flexion)"),
    (
        "knee_adduction_angle",
        "knee varus and rotation (the knee of this model only flexes, and its segments have too \
        few markers)",
    ),
    ("foot_progression_angle", "foot progression (not computed)"),
];

/// Sentence about a long recording of which not all instants are drawn.
fn thinned(results: &Results) -> String {
    let (step, drawn) = (results.step, results.grid.frames);
    format!(
        "Not all instants: curves over time and the figure show {drawn} of them, one of {step}, because the recording \
         is long; means and peaks are those of all, which the other files of the folder contain."
    )
}

/// Shown if ground forces were left out on request.
const WITHOUT_GROUND: &str = "No ground forces: the motion was computed without them, as requested, so the joint \
    moments are those of a body in the air.";

/// One sentence for each missing part.
pub(super) fn missing(
    results: &Results,
    size: &BodySize,
    quantities: &[ClinicalQuantity],
    still: &[ClinicalQuantity],
) -> Vec<String> {
    let mut sentences = Vec::new();
    let mut add = |when: bool, sentence: String| {
        if when {
            sentences.push(sentence);
        }
    };
    add(results.step > 1, thinned(results));
    let no_ground = results.source == PageSource::None;
    add(no_ground, WITHOUT_GROUND.to_owned());
    add(!no_ground && results.ground.is_none(), "No ground forces over time: the folder has no grf.mot.".to_owned());
    add(results.moments.is_none(), format!("No joint moments over time: the folder has no {MOMENTS}."));
    add(results.powers.is_none(), format!("No joint powers over time: the folder has no {POWERS}."));
    let not_measured = &results.summary.not_measured;
    add(!not_measured.is_empty(), format!("Not measured, and therefore not shown: {}.", not_measured.join(", ")));
    for sentence in absent_columns(results, quantities) {
        add(true, sentence);
    }
    let uncertain = results.source == PageSource::Predicted && results.ground.is_some();
    add(
        uncertain && results.deviations.is_none(),
        format!("No uncertainty of the predicted forces: the folder has no {GROUND_SD}."),
    );
    add(
        !no_ground && results.events.is_empty(),
        "No foot strikes and foot offs: the folder's events.csv is missing or empty.".to_owned(),
    );
    let predicted_alone = results.source == PageSource::Predicted && results.measured.is_none();
    add(predicted_alone, "No force plates: ground forces are predicted and were not measured.".to_owned());
    for side in Side::BOTH {
        add(is_lost(results, side), leg(results, side));
    }
    let none = Side::BOTH.iter().all(|side| !has_curves(results, *side));
    add(none, "No whole gait cycle: curves are shown over time only, and there are no means.".to_owned());
    let untimed = !none && results.cycles.is_empty();
    add(
        untimed,
        "The times of the cycles are not known (no foot strikes in events.csv): curves over the cycle and \
        over time cannot be linked."
            .to_owned(),
    );
    let walking = &results.summary.times_and_distances;
    let no_lengths = !walking.quantities.is_empty() && walking.quantity(StrideQuantity::StrideLength).is_none();
    add(no_lengths, "No step lengths: the positions of the feet are not known.".to_owned());
    add(!none && size.turn.is_none() && size.walking_speed().is_none(), bands(size));
    add(size.turn.is_some(), size.turn.map(turning).unwrap_or_default());
    let angles = quantities.iter().any(|quantity| quantity.group == ClinicalGroup::Kinematics);
    let mut lacking = still::words(results, still);
    let unknown = LACKING.iter().filter(|(id, _)| angles && !quantities.iter().any(|quantity| quantity.id == *id));
    lacking.extend(unknown.map(|(_, words)| (*words).to_owned()));
    add(!lacking.is_empty(), format!("Not shown: {}.", lacking.join(", ")));
    sentences
}

/// One sentence per file that lacks columns of one side, or of both sides although the cycles have the quantity.
fn absent_columns(results: &Results, quantities: &[ClinicalQuantity]) -> Vec<String> {
    let mut absent: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for quantity in quantities {
        for side in Side::BOTH {
            let Some((file, column, None)) = over_time(results, quantity, side) else { continue };
            let whose = if quantity.central { String::new() } else { format!("{side} ") };
            let words = format!("{whose}{} ({column})", quantity.title.to_lowercase());
            let list = absent.entry(file).or_default();
            if !list.contains(&words) {
                list.push(words);
            }
        }
    }
    let sentence = |(file, words): (&str, Vec<String>)| {
        format!("Not shown over time, because {file} lacks the columns: {}.", words.join(", "))
    };
    absent.into_iter().map(sentence).collect()
}

fn has_curves(results: &Results, side: Side) -> bool {
    results.curves.iter().any(|curve| curve.side == side)
}

fn is_lost(results: &Results, side: Side) -> bool {
    !has_curves(results, side) && has_curves(results, side.other())
}

fn leg(results: &Results, side: Side) -> String {
    let why = match results.source {
        PageSource::Measured | PageSource::Mixed => {
            "no foot strike on a force plate is followed by a known strike of the same foot"
        }
        _ => "fewer than two foot strikes were detected",
    };
    format!("No whole cycle of the {side} foot: {why}. Its curves are shown over time only.")
}

fn turning(turn: Turn) -> String {
    let angle = turn.degrees.map_or_else(String::new, |angle_deg| format!(" by {}", degrees(angle_deg)));
    format!(
        "The path turns{angle}: normal ranges and bands are left out, because they apply to straight walking. Pelvic \
         rotation includes the turn, and fore-aft and sideways ground forces are along the world axes: do not compare \
         them with straight walking."
    )
}

fn bands(size: &BodySize) -> String {
    let why = match () {
        () if size.runs => NO_DOUBLE_SUPPORT,
        () if size.leg.is_none() => "the leg length is not known",
        () => "the speed is not known",
    };
    format!("No normative bands: {why}.")
}
