//! Electromyograms (EMG): electrical signals of muscles, from recorded channels to envelopes, on/off and comparison.
//!
//! | step | function |
//! |---|---|
//! | channels by name from C3D, `.sto`, `.mot`, CSV | [`emg_from_c3d`], [`emg_from_table`] |
//! | band-pass, rectification, low-pass, division by the 99th percentile of the visit | [`envelopes`] |
//! | one gait cycle, and when the muscle is on | [`EmgEnvelope::cycle`], [`on_off`] |
//! | normal timing in walking | [`normal_timing`] |
//! | comparison with computed activations | [`compare`] |
//!
//! What a channel or a muscle of a model is called: [`AnatomicalMuscle`]. Arrays in, arrays out.

mod anatomical;
mod comparison;
mod cycle;
mod envelope;
mod muscle;
mod normal_timing;
mod recorded;
mod recording;
mod settings;
mod signal;
mod spellings;

pub use anatomical::AnatomicalMuscle;
pub use comparison::{EmgComparison, compare};
#[doc(hidden)]
pub use cycle::OnOffSettings;
pub use cycle::{CYCLE_SAMPLES, bursts, on_off};
pub use envelope::{EmgEnvelope, EmgTrial, envelopes};
pub use normal_timing::{NormalTiming, normal_timing};
#[doc(hidden)]
pub use recording::EmgChannel;
pub use recording::{EmgRecording, emg_from_c3d, emg_from_table};
pub use settings::EmgSettings;
pub use signal::{EmgSignal, Processing};
#[doc(hidden)]
pub use spellings::{SPELLINGS, Spelling};

use ambulo_body::motion::filter::FilterError;

/// Why EMG could not be read or processed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EmgError {
    /// A channel that was asked for is not in the recording.
    #[error("the recording has no channel `{channel}`; it has {known}\nhint: names of channels are case-sensitive")]
    NoChannel {
        /// The channel.
        channel: String,
        /// Names of the recording.
        known: String,
    },
    /// A channel was assigned to a name that is not a muscle.
    #[error(
        "`{muscle}` for channel `{channel}` is not a muscle of a known name\nhint: write the full name with its side, \
         such as `vastus medialis r`, or the name in a model, such as `vas_med_r`"
    )]
    UnknownMuscle {
        /// The channel.
        channel: String,
        /// The name given.
        muscle: String,
    },
    /// No channel has the name of a muscle.
    #[error(
        "no channel has the name of a known muscle; the recording has {found}\nhint: assign channels to muscles by name"
    )]
    NoMuscle {
        /// Names found.
        found: String,
    },
    /// The table has no column of times, or they do not increase by a constant step.
    #[error("EMG in a table needs a first column `time` with a constant step; {found}")]
    Times {
        /// What was found.
        found: String,
    },
    /// The settings contradict each other.
    #[error("EMG settings: {found}, expected {expected}")]
    Settings {
        /// What was found.
        found: String,
        /// What is allowed.
        expected: &'static str,
    },
    /// A raw signal was sampled too slowly for its band.
    #[error(
        "channel `{channel}` holds a raw signal at {rate_hz} Hz; a band up to {highest_hz} Hz needs more than {} Hz\n\
         hint: use the recording at its original rate, or lower the upper bound of the band", 2.0 * highest_hz
    )]
    RateTooLow {
        /// The channel.
        channel: String,
        /// Its rate [Hz].
        rate_hz: f64,
        /// Upper bound of the band [Hz].
        highest_hz: f64,
    },
    /// A filter refused a channel.
    #[error("channel `{channel}`: {reason}")]
    Filter {
        /// The channel.
        channel: String,
        /// Why.
        reason: FilterError,
    },
}
