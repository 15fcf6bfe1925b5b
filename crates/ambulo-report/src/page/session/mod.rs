//! Makes the session of one result folder: the content of a page.
//!
//! `results` reads the files of a recording or walk; every other module makes one part of the page from them. `scene`
//! does the same for simulated scenes.

pub(crate) mod cells;
mod curves;
mod cycles;
pub(crate) mod extracted;
pub(crate) mod feasibility;
pub(crate) mod glance;
mod groups;
mod header;
mod knee_adduction;
mod machines;
mod missing;
mod muscles;
pub(crate) mod pace;
mod peaks;
mod plain_fact;
mod quality;
mod results;
mod scene;
mod sides;
mod size;
mod still;
mod time_distance;
pub(crate) mod words;

use super::block::Block;
use super::contract::{DataQuality, PageMachine, PageQuality, Session, Table};
use super::view::{Viewed, view};
use ambulo::study::{Quality, QualityState};
use ambulo_results::{Folder, Ground, KINEMATICS, ResultsError, RunSummary};
use extracted::Extracted;
use feasibility::Basis;
use results::{AllRows, Results};
use size::BodySize;

/// The session of a folder; its numbers go into `block`.
pub(super) fn session(folder: &Folder<'_>, block: &mut Block) -> Result<Session, ResultsError> {
    match folder.summary()? {
        RunSummary::Scene(summary) => scene::session(folder, &summary, block),
        RunSummary::Motion(summary) => {
            // The figure comes first, because its errors report all causes of a broken body.
            let motion = folder.table(KINEMATICS)?;
            let drawn = folder.every(motion.as_ref().map_or(1, results::step));
            let viewed = view(&drawn, block)?;
            let machines = machines::machines(&folder.states()?);
            let all = motion.map(|motion| AllRows::read(folder, &motion)).transpose()?;
            recording(Results::read(&drawn, *summary, all)?, viewed, machines, block)
        }
    }
}

/// The session of a recording or a synthetic walk.
fn recording(
    results: Results,
    viewed: Viewed,
    machines: Vec<PageMachine>,
    block: &mut Block,
) -> Result<Session, ResultsError> {
    let mut missing = viewed.missing;
    let quantities = groups::quantities(&results);
    let (shown, still) = still::divided(&results, &quantities);
    let size = BodySize::of(&results);
    let (verdict, basis) = (results.summary.verdict.as_ref(), Basis::of(&results));
    let mut feasibility = verdict.and_then(|verdict| feasibility::feasibility(verdict, &basis, &quantities));
    let values = extracted::extracted(&results, &shown);
    let mut groups = groups::groups(&results, &size, &shown, block);
    groups.extend(muscles::groups(&results, block));
    groups.extend(pace::group(&results, block));
    let mut quality = quality::quality(&results, &quantities, block);
    missing.extend(missing::missing(&results, &size, &quantities, &still));
    missing.extend(muscles::missing(&results));
    if let Some((why, closest)) = verdict.and_then(|verdict| feasibility::partly_judged(verdict, &basis, &quantities)) {
        missing.push(why);
        quality.tables.push(closest);
    }
    if let Some(verdict) = &mut feasibility {
        feasibility::mark(&mut [&mut groups, &mut quality.groups], &mut verdict.red);
    }
    Ok(Session {
        name: header::recording_name(&results),
        outcome: Vec::new(),
        data: results.summary.quality.as_ref().map(|quality| data_quality(quality, &results.summary.ground)),
        glance: Some(glance::glance(&results, &size, &shown)),
        header: header::header(&results, &size),
        source: results.source,
        time: results.time(),
        groups,
        machines,
        tables: tables(&results, &size, &values),
        quality,
        feasibility,
        view: viewed.view,
        missing,
        events: results.events,
        cycles: results.cycles,
    })
}

/// Times and distances, and what the curves show in numbers.
fn tables(results: &Results, size: &BodySize, values: &[Extracted]) -> Vec<Table> {
    let summary = &results.summary;
    let mut tables = vec![time_distance::table(results, size), extracted::table(values)];
    tables.extend(knee_adduction::knee_adduction(&summary.knee_adduction_moment));
    tables.extend(muscles::contact_table(summary.muscles.as_ref()));
    tables.push(extracted::symmetry(values, &summary.times_and_distances));
    tables.push(peaks::peaks(&summary.peaks));
    tables
}

/// The quality with its three strongest reasons; good data may be those of one leg only.
fn data_quality(quality: &Quality, ground: &Ground) -> DataQuality {
    let state = match quality.state {
        QualityState::Good => PageQuality::Good,
        QualityState::Doubtful => PageQuality::Doubtful,
        QualityState::Bad => PageQuality::Bad,
    };
    let one_leg = ground.unmeasured_leg().filter(|_| quality.reasons.is_empty());
    let reasons = quality.reasons.iter().take(3).map(|reason| reason.message.clone());
    DataQuality { state, reasons: reasons.chain(one_leg).collect() }
}
