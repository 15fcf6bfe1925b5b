//! Settings of the filters of electromyograms.

use serde::{Deserialize, Serialize};

/// Settings of the filters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct EmgSettings {
    /// Lower and upper bound of the band-pass [Hz].
    pub band_hz: [f64; 2],
    /// Number of poles of one pass of the band-pass at each bound.
    pub band_order: usize,
    /// Cut-off of the low-pass after rectification [Hz].
    pub envelope_hz: f64,
    /// Number of poles of one pass of this low-pass: 2, so that both passes have four.
    pub envelope_order: usize,
}

impl Default for EmgSettings {
    fn default() -> Self {
        EmgSettings { band_hz: [20.0, 450.0], band_order: 4, envelope_hz: 6.0, envelope_order: 2 }
    }
}
