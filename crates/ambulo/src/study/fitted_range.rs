//! The time in which markers are fitted, if only a part of a recording is analysed.
//!
//! Filters and the events of the feet reach beyond the range that is asked for. The slowest pole of a third-order
//! Butterworth filter of cutoff f decays with π f, to e⁻¹⁸ after 6/f; of higher orders it decays to e⁻¹⁰ or less.
//! Frames further away do not change the results beyond rounding and the tolerance of the fit, with these exceptions:
//! gaps of markers are filled by how the markers slide in all fitted frames (hundredths of a degree), stances without a
//! measured load are predicted from the fitted time (thousandths of N.m/kg), and distances of the markers from the
//! body, and what is found to be exchanged or displaced, are those of the fitted frames. The body and its mass are
//! always those of the whole recording, or of the standing trial, and a prediction without plates uses all of the
//! motion.
//!
//! Pinned by: tests/fitted_range.rs

use super::settings::{GroundSettings, Settings};
use crate::analysis::LaboratoryRecording;
use crate::ground::CENTER_OF_PRESSURE_LOAD_N;
use crate::motion::{Smoother, Window};

/// Time before and after the range that is fitted as well [periods of the cutoff].
const PERIODS: f64 = 6.0;
/// ... and at least this [s]: a stance that begins before the range.
const LEAST_S: f64 = 1.0;

/// The time to fit; all of the recording for a spline, whose smoothness depends on every frame, and for predicted
/// forces. A range that is not inside of the recording is refused later, with the times of all of it.
pub(super) fn fitted_range(settings: &Settings, recording: &LaboratoryRecording) -> Window {
    let is_predicted = match settings.ground {
        GroundSettings::MeasuredOrPredicted => {
            !recording.plates.iter().any(|plate| plate.peak_n() > CENTER_OF_PRESSURE_LOAD_N)
        }
        GroundSettings::Predicted | GroundSettings::Tracked => true,
        GroundSettings::NoContact => false,
    };
    let times = &recording.markers.times;
    let is_recorded = |time_s: Option<f64>| {
        let ends = times.first().zip(times.last());
        time_s.is_none_or(|time_s| ends.is_some_and(|(first, last)| (*first..=*last).contains(&time_s)))
    };
    if is_predicted || !is_recorded(settings.window.from_s) || !is_recorded(settings.window.to_s) {
        return Window::default();
    }
    let around_s = match settings.smoother {
        Smoother::Spline => return Window::default(),
        Smoother::Off => LEAST_S,
        Smoother::Butterworth(low_pass) => (PERIODS / low_pass.cutoff_hz).max(LEAST_S),
    };
    let Window { from_s, to_s } = settings.window;
    Window { from_s: from_s.map(|from_s| from_s - around_s), to_s: to_s.map(|to_s| to_s + around_s) }
}
