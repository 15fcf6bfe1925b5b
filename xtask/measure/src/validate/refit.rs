//! Given angles whose loaded feet slide, without and with a refit: slow random errors are added to angles that fit.

use super::recording::{self, Recording};
use ambulo::analysis::GroundAgreement;
use ambulo::findings::Findings;
use ambulo::ground::predict::PredictSettings;
use ambulo::model::{Model, Movement};
use ambulo::motion::Motion;
use ambulo::numerics::{Random, finite_mean};
use ambulo::study::validation::TextTable as Table;
use ambulo::study::validation::{Component, Figure, number};
use ambulo::study::{self, GroundSettings, Settings, Source};
use std::f64::consts::TAU;
use std::path::Path;

/// Errors of each angle of the legs and the pelvis [degrees] and of the pelvis on the floor [mm], root mean squares.
const ERRORS: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 5.0], [2.0, 10.0]];
/// Draws of the errors.
const DRAWS: u64 = 4;
/// Frequencies of the errors [Hz].
const FREQUENCIES: [f64; 6] = [0.3, 0.54, 0.78, 1.02, 1.26, 1.5];
/// The figures of the table, with their headings and digits.
const COLUMNS: [(&str, Figure, usize); 6] = [
    ("vertical %BW", Figure::Rmse(Component::Vertical), 2),
    ("fore-aft %BW", Figure::Rmse(Component::ForeAft), 2),
    ("lateral %BW", Figure::Rmse(Component::Lateral), 2),
    ("r", Figure::Correlation(Component::Lateral), 3),
    ("CoP fore-aft mm", Figure::CenterAlong, 1),
    ("CoP lateral mm", Figure::CenterAcross, 1),
];

/// A recording with errors of one size: agreement of every draw without and with a refit.
pub(super) struct Refitted {
    label: &'static str,
    errors: [f64; 2],
    agreements: Vec<[GroundAgreement; 2]>,
}

/// All given angles with errors of all sizes.
pub(super) fn refitted(data: &Path) -> Result<Vec<Refitted>, String> {
    let mut all = Vec::new();
    for recording in recording::given_angles() {
        let source = recording.read(data)?;
        for errors in ERRORS {
            let draws = if errors[0] > 0.0 { DRAWS } else { 1 };
            let pairs = (0..draws).map(|draw| pair(&recording, &source, errors, draw));
            let agreements = pairs.collect::<Result<Vec<_>, String>>()?;
            all.push(Refitted { label: recording.label, errors, agreements });
        }
    }
    Ok(all)
}

fn pair(recording: &Recording, source: &Source, errors: [f64; 2], draw: u64) -> Result<[GroundAgreement; 2], String> {
    let mut source = source.clone();
    if let study::Recording::Coordinates { model, motion } = &mut source.recording {
        add_errors(model, motion, errors, draw);
    }
    let agreement = |refit: bool| {
        let prediction = PredictSettings::default();
        let settings = Settings { ground: GroundSettings::Predicted, prediction, refit, ..Settings::default() };
        let outcome = study::run(source.clone(), &settings, &mut Findings::default()).map_err(|e| e.to_string())?;
        let found = outcome.prediction.and_then(|found| found.agreement);
        found.ok_or_else(|| format!("{}: compared with nothing", recording.label))
    };
    Ok([agreement(false)?, agreement(true)?])
}

/// Adds sums of slow waves to the angles of pelvis and legs and to the place of the pelvis on the floor.
fn add_errors(model: &Model, motion: &mut Motion, [degrees, mm]: [f64; 2], draw: u64) {
    for (number, id) in model.coordinate_ids().enumerate() {
        let size = match model.anatomy().meaning(id).map(|meaning| meaning.movement) {
            Some(Movement::PelvisForward | Movement::PelvisRight) => 1e-3 * mm,
            Some(
                Movement::PelvicTilt
                | Movement::PelvicObliquity
                | Movement::PelvicRotation
                | Movement::HipFlexion
                | Movement::HipAdduction
                | Movement::HipRotation
                | Movement::KneeFlexion
                | Movement::AnkleDorsiflexion,
            ) => degrees.to_radians(),
            _ => continue,
        };
        let random = &mut Random::new(draw, number as u64);
        // A sine has a mean square of a half.
        let scale = size * (2.0 / FREQUENCIES.len() as f64).sqrt();
        let waves = FREQUENCIES.map(|frequency| (frequency, scale * random.normal(), TAU * random.share()));
        let error = |time: f64| waves.iter().map(|(f, a, phase)| a * (TAU * f * time + phase).sin()).sum::<f64>();
        let column = motion.columns[id.index()].iter_mut().flatten();
        column.zip(&motion.times).for_each(|(value, time)| *value += error(*time));
    }
}

/// The section of the page.
pub(super) fn section(all: &[Refitted]) -> String {
    let head = ["recording", "errors of angles °", "of the place mm", "draws", "motion"].into_iter();
    let mut table = Table::new(&head.chain(COLUMNS.iter().map(|(name, ..)| *name)).collect::<Vec<_>>());
    for Refitted { label, errors: [degrees, mm], agreements } in all {
        for (k, word) in ["as given", "refitted"].into_iter().enumerate() {
            let head =
                [*label, &number(*degrees, 0), &number(*mm, 0), &agreements.len().to_string(), word].map(str::to_owned);
            let figures = COLUMNS.map(|(_, figure, digits)| {
                number(finite_mean(agreements.iter().map(|pair| figure.of(&pair[k]))), digits)
            });
            table.row(head.into_iter().chain(figures));
        }
    }
    format!(
        "{}\nAngles that another program fitted, with slow random errors (0.3 to 1.5 Hz, rms) added to pelvis, hips, \
         knees and ankles, so that loaded feet slide; \
         `ambulo forces --refit`. Means over draws and feet.\n",
        table.text()
    )
}
