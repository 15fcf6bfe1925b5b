//! Marker trajectories in TRC files (Motion Analysis' "track row column", as OpenSim reads and writes it).
//!
//! ```text
//! PathFileType  4  (X/Y/Z)  walk.trc
//! DataRate  CameraRate  NumFrames  NumMarkers  Units  OrigDataRate  OrigDataStartFrame  OrigNumFrames
//! 100       100         238        2           mm     100           1                   238
//! Frame#    Time  HEEL              TOE
//!                 X1    Y1    Z1    X2    Y2    Z2
//!
//! 1         0.00  12.5  30.0  -4.1  190.2  21.3  -3.9
//! ```
//!
//! Cells are separated by tabs, so that an empty cell is a gap; a file separated by spaces is read if it has no gaps.
//! Positions are metres in memory; a gap is not-a-number in all three.
//! Positions of exactly 0 0 0, which some programs write for a gap, are kept and reported.
//! Pinned by: tests/markers.rs, tests/malformed.rs, tests/real_files.rs

mod read;
mod write;

use crate::error::{Error, Remark, quoted};
use crate::table::lines::{check_name, duplicate};

/// One recording of markers.
#[derive(Debug, Clone, PartialEq)]
pub struct Trc {
    /// Text after `(X/Y/Z)` on the first line, usually a file name.
    pub name: String,
    /// Frame rate stated in the header \[Hz\].
    pub rate_hz: f64,
    /// Unit of positions in the file; it is also used for writing.
    pub unit: LengthUnit,
    /// Number of the first frame in the recording from which this file was cut.
    pub orig_start_frame: i64,
    frames: Vec<i64>,
    times: Vec<f64>,
    markers: Vec<Marker>,
}

/// The trajectory of one marker.
#[derive(Debug, Clone, PartialEq)]
pub struct Marker {
    /// Name as in the file.
    pub name: String,
    /// Position x, y, z in the laboratory's axes, one per frame \[m\]; not-a-number in all three where the marker is
    /// missing.
    pub positions_m: Vec<[f64; 3]>,
}

/// The units of length that a TRC file may state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LengthUnit {
    /// `mm`
    Millimetre,
    /// `cm`
    Centimetre,
    /// `m`
    Metre,
}

impl LengthUnit {
    /// All units of length.
    pub const ALL: [LengthUnit; 3] = [LengthUnit::Millimetre, LengthUnit::Centimetre, LengthUnit::Metre];

    /// Keyword in the file.
    pub fn symbol(self) -> &'static str {
        match self {
            LengthUnit::Millimetre => "mm",
            LengthUnit::Centimetre => "cm",
            LengthUnit::Metre => "m",
        }
    }

    /// Number of these units in one metre.
    fn per_metre(self) -> f64 {
        match self {
            LengthUnit::Millimetre => 1000.0,
            LengthUnit::Centimetre => 100.0,
            LengthUnit::Metre => 1.0,
        }
    }

    fn metres(self, value: f64) -> f64 {
        value / self.per_metre()
    }

    /// The number that [`LengthUnit::metres`] converts to `metres`, to the same bits if there is one. Product and
    /// quotient are each rounded by half a unit in the last place, so it differs from the product by at most two such
    /// units.
    fn value_of(self, metres: f64) -> f64 {
        let nearest = metres * self.per_metre();
        let (up, down) = (nearest.next_up(), nearest.next_down());
        [nearest, up, down, up.next_up(), down.next_down()]
            .into_iter()
            .find(|&value| self.metres(value).to_bits() == metres.to_bits())
            .unwrap_or(nearest)
    }
}

impl Trc {
    /// A recording made in memory: metres, without a name, its frames numbered from 1.
    ///
    /// `times` \[s\] has one finite value per frame; markers have different names and one position per time.
    pub fn new(rate_hz: f64, times: Vec<f64>, markers: Vec<Marker>) -> Result<Trc, Error> {
        if !(rate_hz.is_finite() && rate_hz > 0.0) {
            return Err(invalid(format!("a rate of {rate_hz} Hz"), "a finite rate above zero"));
        }
        if let Some(time) = times.iter().find(|time| !time.is_finite()) {
            return Err(invalid(format!("time {time}"), "finite times"));
        }
        if times.is_empty() || markers.is_empty() {
            return Err(invalid("no frame or no marker", "at least one frame and one marker"));
        }
        markers.iter().try_for_each(|marker| check_marker(marker, times.len()))?;
        if let Some(twice) = duplicate(markers.iter().map(|marker| marker.name.as_str())) {
            return Err(invalid(format!("two markers {}", quoted(twice)), "names that differ"));
        }
        let (name, unit, orig_start_frame) = (String::new(), LengthUnit::Metre, 1);
        let frames = (1..).take(times.len()).collect();
        Ok(Trc { name, rate_hz, unit, orig_start_frame, frames, times, markers })
    }

    /// Reads a `.trc` file.
    pub fn read(bytes: &[u8]) -> Result<(Trc, Vec<Remark>), Error> {
        read::read(bytes)
    }

    /// Writes a `.trc` file that OpenSim loads, positions in [`Trc::unit`]. Gaps become empty cells.
    ///
    /// A record that was read from a file is written and read back to the same bits; positions made in memory are so in
    /// metres only.
    pub fn write(&self) -> Vec<u8> {
        write::write(self)
    }

    /// Number of each frame in the file.
    pub fn frames(&self) -> &[i64] {
        &self.frames
    }

    /// Time of each frame \[s\].
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// All markers, from left to right.
    pub fn markers(&self) -> &[Marker] {
        &self.markers
    }

    /// The marker with exactly this name.
    pub fn marker(&self, name: &str) -> Option<&Marker> {
        self.markers.iter().find(|marker| marker.name == name)
    }
}

fn check_marker(marker: &Marker, frames: usize) -> Result<(), Error> {
    check_name(&marker.name)?;
    let name = quoted(&marker.name);
    if marker.positions_m.len() != frames {
        return Err(invalid(
            format!("{} positions of {name}", marker.positions_m.len()),
            format!("{frames}, as times"),
        ));
    }
    if marker.positions_m.iter().flatten().any(|value| value.is_infinite()) {
        return Err(invalid(format!("an infinite position of {name}"), "numbers, or not-a-number for a gap"));
    }
    Ok(())
}

fn invalid(found: impl Into<String>, expected: impl Into<String>) -> Error {
    Error::Record { found: found.into(), expected: expected.into() }
}
