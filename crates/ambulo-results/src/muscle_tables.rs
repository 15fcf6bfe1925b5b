//! Tables of muscles: `muscles.sto`, `reactions_contact.sto` and `emg.sto`.

use crate::files::OutputFile;
use crate::tables::{LazyColumn, LoadSources, column, marks, rows};
use crate::{CONTACT_REACTIONS, EMG, Keep, MUSCLES};
use ambulo::analysis::Analysis;
use ambulo::model::{Model, Side};
use ambulo::muscles::contact_loads::LegLoads;
use ambulo::muscles::emg::EmgEnvelope;
use ambulo::spatial::{Vec3, Wrench};
use ambulo::study::MuscleOutcome;
use ambulo_formats::Error;
use ambulo_formats::table::TableRows;

/// The tables of muscle forces that `keep` includes.
pub(crate) fn muscle_files<'a>(
    model: &'a Model,
    analysis: &'a Analysis,
    found: &'a MuscleOutcome,
    sources: &LoadSources,
    keep: &Keep,
) -> Vec<OutputFile<'a>> {
    let (of_muscles, of_joints) = (sources.clone(), sources.clone());
    let mut files = vec![
        OutputFile::storage_by(MUSCLES, move || muscles(model, analysis, found, &of_muscles)),
        OutputFile::storage_by(CONTACT_REACTIONS, move || contact_reactions(model, analysis, found, &of_joints)),
    ];
    if envelopes(found, analysis).next().is_some() {
        files.push(OutputFile::storage_by(EMG, move || {
            let grid = analysis.trajectory.grid();
            let of = |(name, envelope): (String, &'a EmgEnvelope)| -> LazyColumn<'a> {
                (name, Box::new(move |frame| envelope.at(grid.time(frame)).unwrap_or_default()))
            };
            rows("Electromyograms", analysis, envelopes(found, analysis).map(of))
        }));
    }
    files.retain(|file| keep.includes(&file.name));
    files
}

/// `muscles.sto`: for each muscle `<muscle>_activation` (0 to 1), `<muscle>_force` [N] and `<muscle>_length` [m], for
/// each coordinate with motors `<coordinate>_reserve` [N.m or N].
fn muscles<'a>(
    model: &'a Model,
    analysis: &'a Analysis,
    found: &'a MuscleOutcome,
    sources: &LoadSources,
) -> Result<TableRows<'a>, Error> {
    let MuscleOutcome { set, trial, .. } = found;
    let of_muscle = set.muscles.iter().zip(&trial.muscles).flat_map(|(muscle, series)| {
        let parts = [("activation", &series.activation), ("force", &series.force), ("length", &series.length)];
        parts.map(|(part, values)| column(format!("{}_{part}", muscle.name), values))
    });
    let of_motor = trial.reserves.iter().map(|motors| {
        let coordinate = &model.coordinates()[motors.coordinate.index()].name;
        column(format!("{coordinate}_reserve"), &motors.force)
    });
    rows("Muscle Forces", analysis, of_muscle.chain(of_motor).chain(marks(sources)))
}

/// `reactions_contact.sto`: load of hip, knee and ankle with the tensions of the muscles, of the parent on the child:
/// `<joint>_on_<child>_in_<child>_` in the axes of the child, `<joint>_on_<child>_in_joint_` forward, up and right in
/// the joint coordinate system, each with force `f` [N] and moment `m` [N.m]; at the knee the shares of the condyles
/// `knee_<side>_medial` and `knee_<side>_lateral` [N].
fn contact_reactions<'a>(
    model: &'a Model,
    analysis: &'a Analysis,
    found: &'a MuscleOutcome,
    sources: &LoadSources,
) -> Result<TableRows<'a>, Error> {
    let mut columns: Vec<LazyColumn<'a>> = Vec::new();
    for side in Side::BOTH {
        let Some(LegLoads { joints, knee }) = &found.loads[side] else { continue };
        for load in joints {
            let body = &model.bodies()[load.body.index()];
            let stem = format!("{}_on_{}_in_", body.joint.name, body.name);
            columns.extend(components(format!("{stem}{}_", body.name), &load.in_child));
            columns.extend(components(format!("{stem}joint_"), &load.in_joint));
        }
        columns.push(column(format!("knee_{}_medial", side.letter()), &knee.medial));
        columns.push(column(format!("knee_{}_lateral", side.letter()), &knee.lateral));
    }
    rows("Joint Contact Loads", analysis, columns.into_iter().chain(marks(sources)))
}

/// A letter for the names of columns, and what it stands for.
type Part = (&'static str, fn(&Wrench) -> Vec3);

fn components(stem: String, loads: &[Wrench]) -> impl Iterator<Item = LazyColumn<'_>> {
    let parts: [Part; 2] = [("f", |load| load.force), ("m", |load| load.moment)];
    parts.into_iter().flat_map(move |(part, pick)| {
        let stem = stem.clone();
        ["x", "y", "z"].into_iter().enumerate().map(move |(k, axis)| -> LazyColumn<'_> {
            (format!("{stem}{part}{axis}"), Box::new(move |frame| pick(&loads[frame])[k]))
        })
    })
}

/// The envelopes that hold a muscle of a known side in every frame of the motion, by the names of their columns.
fn envelopes<'a>(
    found: &'a MuscleOutcome,
    analysis: &'a Analysis,
) -> impl Iterator<Item = (String, &'a EmgEnvelope)> + use<'a> {
    let grid = analysis.trajectory.grid();
    let all = found.emg.iter().flat_map(|trial| &trial.envelopes).filter(|envelope| envelope.signal.is_muscle());
    all.filter_map(move |envelope| {
        let is_complete = (0..grid.frames).all(|frame| envelope.at(grid.time(frame)).is_some());
        let muscle = envelope.muscle.to_string().replace(' ', "_");
        envelope.side.filter(|_| is_complete).map(|side| (format!("{muscle}_{}_emg", side.letter()), envelope))
    })
}
