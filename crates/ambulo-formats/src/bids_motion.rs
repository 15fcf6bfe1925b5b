//! Motion of a BIDS data set: `*_motion.tsv`, whose columns `*_channels.tsv` describes.
//!
//! ```text
//! name     component  type    tracked_point  units      one row of *_channels.tsv for each column of *_motion.tsv
//! LASI_x   x          POS     LASI           mm
//! knee     n/a        JNTANG  RightKnee      deg
//! ```
//!
//! `*_motion.tsv` has no heading; `n/a` is a missing value. The frame rate is in `*_motion.json` (`SamplingFrequency`),
//! or in the column `sampling_frequency` of the channels. A channel with the type LATENCY has the time of each frame
//! [s]. Source: bids-specification.readthedocs.io, Motion (from memory, unverified), and files written by motionbids.
//! Pinned by: tests/bids_motions.rs

use crate::error::{Error, quoted};
use crate::plain_text::utf8;

/// Largest number of channels.
pub const MAX_CHANNELS: usize = 20_000;

/// The motion and the meaning of its columns.
#[derive(Debug, Clone, PartialEq)]
pub struct BidsMotion {
    /// Frame rate [Hz]; `None` if the channels do not state it.
    pub rate_hz: Option<f64>,
    /// The channels, one per column.
    pub channels: Vec<BidsChannel>,
    /// Values of each channel over time; not-a-number where they are missing.
    pub columns: Vec<Vec<f64>>,
}

/// The meaning of a column.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct BidsChannel {
    /// Name.
    pub name: String,
    /// Component: `x`, `y`, `z`, `quat_w` and others; empty for `n/a`.
    pub component: String,
    /// Type in capitals: `POS`, `JNTANG`, `ORNT`, `ACCEL`, `LATENCY` and others.
    pub kind: String,
    /// The marker, joint or segment.
    pub tracked_point: String,
    /// Unit as stated.
    pub units: String,
    /// Marked as bad.
    pub is_bad: bool,
}

/// The columns of the table of channels that are used.
const HEADINGS: [&str; 7] = ["name", "component", "type", "tracked_point", "units", "status", "sampling_frequency"];

impl BidsMotion {
    /// Reads `*_motion.tsv` and `*_channels.tsv`.
    ///
    /// # Errors
    /// Channels without name or type, rows of another length, values that are no numbers.
    pub fn read(motion: &[u8], channels: &[u8]) -> Result<BidsMotion, Error> {
        let named = |bytes, error: Error| error.or_other_content(bytes, "a motion of a BIDS data set (.tsv)");
        let (channels, rate_hz) = read_channels(channels).map_err(|error| named(channels, error))?;
        let columns = read_columns(motion, channels.len()).map_err(|error| named(motion, error))?;
        Ok(BidsMotion { rate_hz, channels, columns })
    }

    /// Number of frames.
    #[must_use]
    pub fn frames(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }
}

/// The lines of a file with their numbers, counted from 1; empty ones are left out.
fn lines(bytes: &[u8]) -> Vec<(usize, String)> {
    let bytes = utf8(bytes);
    let text = String::from_utf8_lossy(&bytes);
    let lines = text.trim_start_matches('\u{feff}').lines().enumerate();
    lines.filter(|(_, line)| !line.trim().is_empty()).map(|(k, line)| (k + 1, line.to_owned())).collect()
}

fn read_channels(bytes: &[u8]) -> Result<(Vec<BidsChannel>, Option<f64>), Error> {
    let lines = lines(bytes);
    let Some(((line, heading), rows)) = lines.split_first() else {
        return Err(Error::Empty {
            expected: "a table of channels with the columns name, component, type and tracked_point",
        });
    };
    let names: Vec<String> = heading.split('\t').map(|name| name.trim().to_lowercase()).collect();
    let places = HEADINGS.map(|heading| names.iter().position(|name| name == heading));
    let [Some(_), _, Some(_), ..] = places else {
        let expected = "columns with at least name and type, separated by tabs".to_owned();
        return Err(Error::Line { line: *line, found: quoted(heading), expected });
    };
    if rows.len() > MAX_CHANNELS {
        let found = format!("{} channels", rows.len());
        return Err(Error::Line { line: *line, found, expected: format!("at most {MAX_CHANNELS}") });
    }
    let mut rate_hz = None;
    let mut channel = |(_, row): &(usize, String)| {
        let cells: Vec<&str> = row.split('\t').map(str::trim).collect();
        let [name, component, kind, point, units, status, rate] = places.map(|place| {
            place.and_then(|place| cells.get(place)).copied().filter(|cell| *cell != "n/a").unwrap_or_default()
        });
        rate_hz = rate_hz.or_else(|| rate.parse().ok().filter(|rate: &f64| rate.is_finite() && *rate > 0.0));
        BidsChannel {
            name: name.to_owned(),
            component: component.to_lowercase(),
            kind: kind.to_uppercase(),
            tracked_point: point.to_owned(),
            units: units.to_owned(),
            is_bad: status.eq_ignore_ascii_case("bad"),
        }
    };
    Ok((rows.iter().map(&mut channel).collect(), rate_hz))
}

fn read_columns(bytes: &[u8], count: usize) -> Result<Vec<Vec<f64>>, Error> {
    let mut columns = vec![Vec::new(); count];
    for (line, row) in lines(bytes) {
        let cells: Vec<&str> = row.split('\t').collect();
        if cells.len() != count {
            let expected = format!("{count}, one for each row of the table of channels");
            return Err(Error::Line { line, found: format!("{} values", cells.len()), expected });
        }
        for (column, cell) in columns.iter_mut().zip(cells) {
            let cell = cell.trim();
            let value = if cell.is_empty() || cell == "n/a" { Ok(f64::NAN) } else { cell.parse() };
            column.push(value.map_err(|_| Error::Line {
                line,
                found: quoted(cell),
                expected: "a number or n/a; this table has no heading".to_owned(),
            })?);
        }
    }
    if columns.first().is_none_or(Vec::is_empty) {
        return Err(Error::Empty { expected: "rows of numbers, one value for each channel" });
    }
    Ok(columns)
}
