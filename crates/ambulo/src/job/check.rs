//! Statements of one caller that contradict each other, and numbers out of range.

use super::error::{Field, JobError};
use super::{ForceFiles, Job};
use crate::motion::filter::MAX_ORDER;
use crate::study::GroundSettings;
use std::ops::RangeInclusive;

/// Longest delay between force plates and cameras that is a delay, and not another recording [s].
const LONGEST_DELAY_S: f64 = 60.0;

/// Exponents of activations for which the least sum is unique and its solution is found.
const EXPONENTS: RangeInclusive<f64> = 1.5..=10.0;
/// Distance of the contacts of the condyles of a knee, from children to the largest adults [m].
const CONDYLES_M: RangeInclusive<f64> = 0.01..=0.1;

impl Job {
    /// Rejects statements of one caller that contradict each other, before anything is read. A job that was completed
    /// by a set-up or by the files of a trial may have them.
    ///
    /// # Errors
    /// The first contradiction, or a number out of range.
    pub fn check(&self) -> Result<(), JobError> {
        let ForceFiles { table, loads, right, left } = &self.forces;
        let has_feet = right.is_some() || left.is_some();
        let is_free = self.settings.ground == GroundSettings::NoContact;
        let is_tracked = self.settings.ground == GroundSettings::Tracked;
        let is_reduced = self.settings.residual_reduction.is_some();
        let without = "of a motion without contact; expected one of both";
        let contradictions = [
            (has_feet && table.is_none(), Field::Feet, "of a table, but no table is given"),
            (has_feet && loads.is_some(), Field::Feet, "and external loads; expected one of both"),
            (is_free && table.is_some(), Field::ForceTable, without),
            (is_free && loads.is_some(), Field::Loads, without),
            (is_free && self.person.is_some(), Field::Ground, "predicted for a calibrated person; expected contact"),
            (is_free && self.settings.refit, Field::Ground, "for feet that do not slide; expected contact"),
            (is_free && is_reduced, Field::ResidualReduction, without),
            (is_tracked && is_reduced, Field::ResidualReduction, "of a tracked motion; expected one of both"),
        ];
        if let Some((_, field, what)) = contradictions.into_iter().find(|(is_found, ..)| *is_found) {
            return Err(JobError::new(&[field], format!("found {} {what}", field.name())));
        }
        self.check_numbers()
    }

    fn check_numbers(&self) -> Result<(), JobError> {
        let settings = &self.settings;
        let times = [(Field::From, settings.window.from_s), (Field::To, settings.window.to_s)];
        if let Some((field, _)) = times.into_iter().find(|(_, time)| time.is_some_and(|time| !time.is_finite())) {
            return Err(JobError::new(&[field], format!("{}: expected a number of seconds", field.name())));
        }
        if !(1..=MAX_ORDER).contains(&settings.order) {
            let what =
                format!("found the order {}; expected 1 to {MAX_ORDER}, because higher ones ring", settings.order);
            return Err(JobError::new(&[Field::Order], what));
        }
        if !(settings.longest_gap_s.is_finite() && settings.longest_gap_s >= 0.0) {
            let what = format!("found a longest gap of {} s; expected zero or more", settings.longest_gap_s);
            return Err(JobError::new(&[Field::Gap], what));
        }
        if !(-LONGEST_DELAY_S..=LONGEST_DELAY_S).contains(&settings.force_delay_s) {
            let what = format!(
                "found a force delay of {} s; expected at most {LONGEST_DELAY_S} s, late or early (negative)",
                settings.force_delay_s
            );
            return Err(JobError::new(&[Field::ForceDelay], what));
        }
        self.check_muscles()?;
        self.check_range()
    }

    fn check_muscles(&self) -> Result<(), JobError> {
        let Some(muscles) = &self.muscles else { return Ok(()) };
        let refused = |field, what: String| Err(JobError::new(&[field], what));
        if !EXPONENTS.contains(&muscles.exponent) {
            let [least, most] = [EXPONENTS.start(), EXPONENTS.end()];
            let what = format!("found the exponent {} of activations; expected {least} to {most}", muscles.exponent);
            return refused(Field::Exponent, what);
        }
        if let Some(condyles_m) = muscles.condyles_m.filter(|condyles_m| !CONDYLES_M.contains(condyles_m)) {
            let [least, most] = [CONDYLES_M.start(), CONDYLES_M.end()];
            let what = format!("found condyles {condyles_m} m apart; expected {least} to {most} m");
            return refused(Field::Condyles, what);
        }
        if let Some((name, weight)) = muscles.weights.iter().find(|(_, w)| !(w.is_finite() && **w > 0.0)) {
            return refused(
                Field::Muscles,
                format!("found the weight {weight} of `{name}`; expected a number above 0"),
            );
        }
        Ok(())
    }

    /// Rejects a time range that ends before it starts.
    pub(super) fn check_range(&self) -> Result<(), JobError> {
        if let (Some(from), Some(to)) = (self.settings.window.from_s, self.settings.window.to_s)
            && from > to
        {
            let message = format!("the start, {from} s, is after the end, {to} s; expected a start before the end");
            return Err(JobError::new(&[Field::From, Field::To], message));
        }
        Ok(())
    }
}
