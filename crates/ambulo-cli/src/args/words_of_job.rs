//! A job of all trials as the words that would state it after `--`, for records and for the command that repeats a
//! trial.

use super::forces::Outputs;
use super::words::Words;
use ambulo::analysis::Adjustable;
use ambulo::job::{Filter, Job, MarkerFitting, ModelChoice, MuscleStatements, Processing};
use ambulo::kinematics::calibration::{HipRegression, KneeAxis};
use ambulo::muscles::strength::Pennation;
use ambulo::muscles::wrap::WrapRule;
use ambulo::study::GroundSettings;
use ambulo_results::Convention;
use std::ffi::OsString;
use std::path::PathBuf;

/// The words of everything that differs from the defaults.
pub(super) fn words(job: &Job, outputs: &Outputs) -> Vec<OsString> {
    let mut words = Words(Vec::new());
    job.setups.iter().for_each(|setup| words.path("--setup", Some(setup)));
    words.path("--model", job.model.as_ref().map(ModelChoice::path).map(PathBuf::from).as_ref());
    words.path("--smpl", job.smpl.as_ref());
    words.path("--person", job.person.as_ref());
    words.value("--heading", job.sensors.heading.as_ref());
    words.value("--earth", job.sensors.earth);
    words.path("--static", job.standing.as_ref());
    words.path("--functional", job.functional.as_ref());
    words.value("--subject", job.subject.as_ref());
    words.path("--grf", job.forces.table.as_ref());
    words.path("--loads", job.forces.loads.as_ref());
    words.value("--right", job.forces.right.as_ref());
    words.value("--left", job.forces.left.as_ref());
    words.path("--marker-set", job.marker_set.as_ref());
    words.value("--markers", job.markers.as_ref());
    words.path("--device", job.device.as_ref());
    job.plates.iter().for_each(|plate| words.value("--plate", Some(plate)));
    job.added_mass.iter().for_each(|added| words.value("--add-mass", Some(added)));
    of_muscles(job.muscles.as_ref(), &mut words);
    words.path("--thresholds", job.thresholds.as_ref());
    words.value("--mass", job.size.mass_kg);
    words.value("--height", job.size.height_m);
    words.value("--trial", job.trial.as_ref());
    words.value("--figure", Some(job.segments.name()).filter(|_| job.segments != Job::SEGMENTS));
    of_settings(&job.settings, &mut words);
    words.value("--convention", Some(outputs.convention).filter(|used| *used != Convention::default()));
    words.0
}

fn of_muscles(muscles: Option<&MuscleStatements>, words: &mut Words) {
    words.flag("--muscles", muscles.is_some());
    let Some(stated) = muscles else { return };
    let defaults = MuscleStatements::default();
    words.path("--reserves", stated.reserves.as_ref());
    words.path("--emg", stated.emg.as_ref());
    let wraps = Some(stated.wraps).filter(|wraps| *wraps != defaults.wraps);
    words.value("--wraps", wraps.map(|wraps| word(&WrapRule::ALL, wraps)));
    let pennation = Some(stated.pennation).filter(|pennation| *pennation != defaults.pennation);
    words.value("--pennation", pennation.map(|pennation| word(&Pennation::ALL, pennation)));
    let exponent = Some(stated.exponent).filter(|exponent| exponent.to_bits() != defaults.exponent.to_bits());
    words.value("--exponent", exponent);
    words.value("--condyles", stated.condyles_m);
}

fn of_settings(settings: &Processing, words: &mut Words) {
    let defaults = Processing::default();
    words.flag("--predict", settings.ground == GroundSettings::Predicted);
    words.flag("--track", settings.ground == GroundSettings::Tracked);
    words.flag("--no-ground", settings.ground == GroundSettings::NoContact);
    words.flag("--refit", settings.refit);
    words.value("--fit", settings.fit.map(|fit| word(&MarkerFitting::ALL, fit)));
    words.value("--hip", Some(settings.hip).filter(|hip| *hip != defaults.hip).map(HipRegression::word));
    words.value("--knee-axis", Some(settings.knee_axis).filter(|axis| *axis != defaults.knee_axis).map(KneeAxis::word));
    let gap = Some(settings.longest_gap_s).filter(|gap| gap.to_bits() != defaults.longest_gap_s.to_bits());
    words.value("--max-gap", gap);
    words.value("--from", settings.window.from_s);
    words.value("--to", settings.window.to_s);
    words.value("--rate", settings.rate_hz);
    words.value("--filter", Some(settings.filter).filter(|f| *f != defaults.filter).map(|f| word(&Filter::ALL, f)));
    words.value("--cutoff", settings.cutoff);
    words.value("--force-cutoff", settings.force_cutoff);
    words.value("--force-delay", Some(settings.force_delay_s).filter(|delay| delay.abs() > 0.0));
    words.value("--order", Some(settings.order).filter(|order| *order != defaults.order));
    let consistent = settings.residual_reduction.map(|what| word(&Adjustable::ALL, what));
    // This option takes its value in the same word.
    words.0.extend(consistent.map(|what| format!("--consistent={what}").into()));
}

fn word<T: Copy + PartialEq>(words: &[(&'static str, T)], value: T) -> &'static str {
    words.iter().find(|(_, known)| *known == value).map_or("", |(word, _)| word)
}
