//! A job as the text that the id of its run is made from.
//!
//! The form must not change: the ids of earlier runs depend on it. Outputs and printing are left out where they
//! do not matter.

use crate::args::Outputs;
use ambulo::analysis::Adjustable;
use ambulo::job::{Job, ModelChoice};
use ambulo::kinematics::calibration::{HipRegression, KneeAxis};
use ambulo::study::{AddedMass, GroundSettings};
use std::fmt::{Debug, Formatter, Result};
use std::path::PathBuf;

/// The command with the options that matter for the results.
pub(super) fn options(job: &Job, outputs: &Outputs) -> String {
    format!("forces {:?}", Recorded { job, outputs })
}

struct Recorded<'a> {
    job: &'a Job,
    outputs: &'a Outputs,
}

impl Debug for Recorded<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let Recorded { job, outputs } = self;
        let settings = &job.settings;
        let consistent = settings.residual_reduction.map(|what| match what {
            Adjustable::Motion => format_args!("Motion"),
            Adjustable::MotionAndBody => format_args!("Body"),
        });
        let added: Vec<Added<'_>> = job.added_mass.iter().map(Added).collect();
        let mut record = f.debug_struct("ForcesArgs");
        record
            .field("input", &job.recording)
            .field("setup", &job.setups)
            .field("model", &job.model.as_ref().map(ModelChoice::path))
            .field("trial", &job.trial)
            .field("smpl", &job.smpl)
            .field("subject", &Person(job))
            .field("sensors", &Sensors(job))
            .field("grf", &job.forces.table)
            .field("loads", &job.forces.loads)
            .field("right", &job.forces.right)
            .field("left", &job.forces.left)
            .field("predict", &(settings.ground == GroundSettings::Predicted))
            .field("person", &job.person)
            .field("track", &(settings.ground == GroundSettings::Tracked))
            .field("refit", &settings.refit)
            .field("no_ground", &(settings.ground == GroundSettings::NoContact))
            .field("convention", &outputs.convention)
            .field("from", &settings.window.from_s)
            .field("to", &settings.window.to_s)
            .field("rate", &settings.rate_hz)
            .field("cutoff", &settings.cutoff)
            .field("force_cutoff", &settings.force_cutoff)
            .field("order", &settings.order)
            .field("filter", &settings.filter)
            .field("consistent", &consistent)
            .field("device", &job.device)
            .field("add_mass", &added)
            .field("thresholds", &job.thresholds)
            .field("output", &PathBuf::new())
            .field("keep", &outputs.keep)
            .field("replace", &format_args!("ReplaceArgs {{ force: false }}"))
            .field("check", &format_args!("CheckArgs {{ check: false }}"))
            .field("print", &format_args!("PrintArgs {{ json: false, quiet: false, verbose: false }}"));
        if let Some(muscles) = &job.muscles {
            record.field("muscles", muscles);
        }
        if settings.force_delay_s.abs() > 0.0 {
            record.field("force_delay", &settings.force_delay_s);
        }
        record.finish()
    }
}

struct Person<'a>(&'a Job);

impl Debug for Person<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let job = self.0;
        let mut fields = f.debug_struct("SubjectArgs");
        fields.field("still", &job.standing);
        // Left out where it is not stated, so that the identifiers of earlier runs stay.
        if let Some(subject) = &job.subject {
            fields.field("subject", subject);
        }
        fields
            .field("mass", &job.size.mass_kg)
            .field("height", &job.size.height_m)
            .field("figure", &job.segments.name())
            .field("markers", &job.markers)
            .field("marker_set", &job.marker_set)
            .field("plate", &job.plates)
            .field("fit", &job.settings.fit)
            .field("max_gap", &job.settings.longest_gap_s);
        if job.settings.hip != HipRegression::default() {
            fields.field("hip", &job.settings.hip);
        }
        if job.settings.knee_axis != KneeAxis::default() {
            fields.field("knee_axis", &job.settings.knee_axis);
        }
        if let Some(functional) = &job.functional {
            fields.field("functional", functional);
        }
        fields.finish()
    }
}

struct Sensors<'a>(&'a Job);

impl Debug for Sensors<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let sensors = &self.0.sensors;
        f.debug_struct("SensorArgs").field("heading", &sensors.heading).field("earth", &sensors.earth).finish()
    }
}

struct Added<'a>(&'a AddedMass);

impl Debug for Added<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.debug_tuple("AddedMassArg").field(self.0).finish()
    }
}
