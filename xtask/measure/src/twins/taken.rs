//! Joint moments of a leg whose force plate was taken away, against those with the plate.
//!
//! Of the first clean recording of each person, each stance that lies wholly on one plate is computed twice: as
//! recorded, and with that plate silent, so that its forces are predicted. The difference of a moment is its root mean
//! square over the stance, per body mass [N.m/kg]; several stances of a person, and all stances, are pooled by squares.

use super::changes::silence;
use super::clean::{Files, people};
use super::spoiled::{Trial, name};
use ambulo::findings::Findings;
use ambulo::ground::stances::{Stance, StanceSource};
use ambulo::study::Outcome;
use ambulo::study::validation::TextTable;
use std::path::Path;

/// The coordinates whose moments are compared, without the side.
const JOINTS: [&str; 4] = ["ankle_angle", "knee_angle", "hip_flexion", "hip_adduction"];
/// A stance that begins or ends nearer than this to an end of the motion is cut [s].
const CUT_S: f64 = 0.02;

/// Differences of the moments in a stance [N.m/kg].
type Differences = [f64; JOINTS.len()];

/// The table with the words around it.
pub(super) fn section(data: &Path, only: &str) -> Result<String, String> {
    let mut table = TextTable::new(&["recording", "stances", "ankle", "knee", "hip flexion", "hip adduction"]);
    let mut all = Vec::new();
    let first = people(data).into_iter().filter_map(|trials| trials.into_iter().next());
    for files in first.filter(|files| name(&files.trial).contains(only)) {
        let found = differences(&files)?;
        if !found.is_empty() {
            row(&mut table, &name(&files.trial), &found);
        }
        all.extend(found);
    }
    row(&mut table, "all stances, pooled", &all);
    let worst = JOINTS.iter().enumerate().map(|(joint, _)| all.iter().map(|found| found[joint]).fold(0.0, f64::max));
    let worst = worst.map(|difference| format!("{difference:.3}"));
    table.row(["the worst stance".to_owned(), "1".to_owned()].into_iter().chain(worst));
    Ok(format!(
        "## Joint moments of a leg whose plate was taken away\n\nRoot mean square difference from the moments with the \
         plate, over the stance [N.m/kg]; the plate is silent in the copy, and the forces of\nthe foot are \
         predicted. Stances that lie wholly on one plate and inside the recording.\n\n{}",
        table.text()
    ))
}

fn row(table: &mut TextTable, name: &str, stances: &[Differences]) {
    let pooled = |joint: usize| {
        let squares: f64 = stances.iter().map(|found| found[joint].powi(2)).sum();
        format!("{:.3}", (squares / stances.len() as f64).sqrt())
    };
    table.row([name.to_owned(), stances.len().to_string()].into_iter().chain((0..JOINTS.len()).map(pooled)));
}

/// The differences of each stance on one plate.
fn differences(files: &Files) -> Result<Vec<Differences>, String> {
    let recorded = Trial::read(files, files)?.computed(&mut Findings::default())?;
    let grid = recorded.analysis.trajectory.grid();
    let is_whole = |stance: &&Stance| stance.start_s > grid.start_s + CUT_S && stance.end_s < grid.end_s() - CUT_S;
    let mut found = Vec::new();
    for stance in recorded.stances.iter().filter(is_whole) {
        let StanceSource::Plates(plates) = &stance.source else { continue };
        let [plate] = plates[..] else { continue };
        let mut trial = Trial::read(files, files)?;
        silence(&mut trial.moving, plate).ok_or("a plate without channels")?;
        let taken = trial.computed(&mut Findings::default())?;
        let middle_s = 0.5 * (stance.start_s + stance.end_s);
        let is_it = |own: &&Stance| own.side == stance.side && (own.start_s..=own.end_s).contains(&middle_s);
        if taken.stances.iter().find(is_it).is_some_and(|own| own.source == StanceSource::Predicted) {
            found.push(JOINTS.map(|joint| difference([&recorded, &taken], joint, stance)));
        }
    }
    Ok(found)
}

/// Root mean square difference of a moment of the leg in a stance [N.m/kg].
fn difference(outcomes: [&Outcome; 2], joint: &str, stance: &Stance) -> f64 {
    let grid = outcomes[0].analysis.trajectory.grid();
    let name = format!("{joint}_{}", stance.side.letter());
    let moments = outcomes.map(|outcome| {
        let id = outcome.body.coordinate(&name);
        id.map_or(&[][..], |id| &outcome.complete().forces.generalized[id.index()])
    });
    let inside = (0..grid.frames).filter(|frame| (stance.start_s..=stance.end_s).contains(&grid.time(*frame)));
    let pairs = inside.filter_map(|frame| Some(moments[0].get(frame)? - moments[1].get(frame)?));
    let (count, sum) = pairs.fold((0.0, 0.0), |(count, sum), difference| (count + 1.0, sum + difference.powi(2)));
    (sum / count).sqrt() / outcomes[0].analysis.mass.kg
}
