//! Recordings of movement in C3D files: points, analog channels, poses of segments, force platforms, events and all
//! named parameters.
//!
//! ```text
//! block 1        header: counts, frames, rate, where the rest is
//! block 2 ..     parameters: groups of named values
//! block n ..     frames: for each frame all points (x, y, z, residual and cameras), then all analog samples
//! block m ..     rotations, if there are any: for each frame the poses of all segments
//! ```
//!
//! A block has 512 bytes. Numbers are Intel's, DEC's or SGI's ([`Processor`]), integers with a scale or reals
//! ([`Storage`]). Where header, parameters and size of the file contradict each other, the size decides and a
//! [`Remark`] states both numbers. A truncated file gives a remark too, and its complete frames are read.
//!
//! Positions are kept in the file's unit and axes. A missing point is not-a-number in all three.
//!
//! ```
//! use ambulo_formats::c3d::{C3d, Event, Point};
//!
//! let mut record = C3d::new(100.0, "mm");
//! record.points.push(Point::new("HEEL", vec![[12.0, 30.5, 4.0], [f64::NAN; 3]])); // missing in the second frame
//! record.events.push(Event::new("Foot Strike", "Left", 0.01));
//! let bytes = record.write()?;
//!
//! let (read, remarks) = C3d::read(&bytes)?;
//! assert!(remarks.is_empty());
//! assert_eq!(read.frames(), 2);
//! assert_eq!(read.point("HEEL").unwrap().positions[0], [12.0, 30.5, 4.0]);
//! assert_eq!(read.parameters.text("POINT", "UNITS"), Some("mm"));
//! # Ok::<(), ambulo_formats::Error>(())
//! ```
//!
//! Source: C3D user guide, c3d.org.
//! Pinned by: tests/c3d_recordings.rs, tests/c3d_traps.rs, tests/c3d_damage.rs, tests/c3d_write.rs,
//! tests/c3d_rotations.rs

mod analog;
mod events;
mod header;
mod layout;
mod parameters;
mod platform;
mod points;
mod read;
mod rotations;
mod section;
mod section_write;
mod stated;
mod words;
mod write;

pub use analog::Channel;
pub use events::{Event, EventPlace};
pub use parameters::{Group, Parameter, Parameters, Values};
pub use platform::Platform;
pub use points::Point;
pub use rotations::Rotation;
pub use words::Processor;

use crate::error::{Error, Remark};

/// One recording.
#[derive(Debug, Clone, PartialEq)]
pub struct C3d {
    /// Encoding of the numbers in the file.
    pub encoding: Encoding,
    /// Frame rate \[Hz\].
    pub point_rate_hz: f64,
    /// Unit of positions as in the file, usually `mm`; empty if there is none.
    pub point_unit: String,
    /// Number of the first frame; the recording from which this file was cut began with frame 1, at time zero.
    pub first_frame: i64,
    /// Longest gap that was filled before the file was written [frames], from the header.
    pub longest_gap: u16,
    /// Points, in the order of the file: markers, and quantities that programs store as points (angles, forces,
    /// moments, powers).
    pub points: Vec<Point>,
    /// Analog sample rate \[Hz\]; zero if there are no channels. A whole multiple of [`C3d::point_rate_hz`].
    pub analog_rate_hz: f64,
    /// Analog channels, in the order of the file; channel number 1 of the parameters is the first.
    pub channels: Vec<Channel>,
    /// Sample rate of the poses of segments \[Hz\]; zero if there are none. A whole multiple of [`C3d::point_rate_hz`].
    pub rotation_rate_hz: f64,
    /// Poses of segments, in the order of the file.
    pub rotations: Vec<Rotation>,
    /// Events, in the order of the file: first from the parameters, then from the header.
    pub events: Vec<Event>,
    /// All parameters.
    pub parameters: Parameters,
}

/// Encoding of the numbers in a file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Encoding {
    /// Processor that wrote the numbers.
    pub processor: Processor,
    /// Integers or reals.
    pub storage: Storage,
    /// Size of one step of integer positions, and of one step of residuals, in the unit of the points; above zero.
    pub point_scale: f64,
    /// Integer samples and offsets of channels are unsigned (`ANALOG:FORMAT` is `UNSIGNED`).
    pub unsigned_analog: bool,
}

/// How positions and samples are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Storage {
    /// 16-bit integers, with a scale.
    Integer,
    /// 32-bit reals.
    Real,
}

impl Default for Encoding {
    /// Intel reals, residuals in hundredths: the usual encoding of current programs.
    fn default() -> Self {
        let (processor, storage) = (Processor::Intel, Storage::Real);
        Encoding { processor, storage, point_scale: f64::from(0.01f32), unsigned_analog: false }
    }
}

impl C3d {
    /// Reads a C3D file.
    pub fn read(bytes: &[u8]) -> Result<(C3d, Vec<Remark>), Error> {
        read::read(bytes, None)
    }

    /// Reads a C3D file without those points that `wanted` refuses: programs store angles and forces as points too,
    /// often four times as many as there are markers. `wanted` gets the names of all points and the parameters, and
    /// returns one value per name; a point without one is read.
    ///
    /// A file of which no point is wanted is read as by [`C3d::read`].
    pub fn read_points(
        bytes: &[u8],
        wanted: impl Fn(&[&str], &Parameters) -> Vec<bool>,
    ) -> Result<(C3d, Vec<Remark>), Error> {
        read::read(bytes, Some(&wanted))
    }

    /// Writes a C3D file in the encoding [`C3d::encoding`]. A record that was read is written and read back without
    /// change.
    ///
    /// Reals hold 24 bits; integers a whole number of steps of their scale. Parameters that repeat other fields are
    /// written from those fields. Rejected is what the format cannot hold: records of different lengths, integers
    /// beyond 16 bits.
    pub fn write(&self) -> Result<Vec<u8>, Error> {
        write::write(self)
    }

    /// An empty recording, to be filled: Intel reals, frame 1 first, no analog channels.
    pub fn new(point_rate_hz: f64, point_unit: &str) -> C3d {
        C3d {
            encoding: Encoding::default(),
            point_rate_hz,
            point_unit: point_unit.into(),
            first_frame: 1,
            longest_gap: 0,
            points: vec![],
            analog_rate_hz: 0.0,
            channels: vec![],
            rotation_rate_hz: 0.0,
            rotations: vec![],
            events: vec![],
            parameters: Parameters::default(),
        }
    }

    /// Number of frames.
    pub fn frames(&self) -> usize {
        let of_rotations = || self.rotations.first().map_or(0, |r| r.matrices.len() / self.rotations_per_frame());
        let of_channels = |c: &Channel| c.samples.len() / self.samples_per_frame();
        let without_points = || self.channels.first().map_or_else(of_rotations, of_channels);
        self.points.first().map_or_else(without_points, |point| point.positions.len())
    }

    /// Analog samples of a channel in one frame; 1 if there are no channels.
    pub fn samples_per_frame(&self) -> usize {
        per_frame(self.analog_rate_hz / self.point_rate_hz)
    }

    /// Poses of a segment in one frame; 1 if there are no rotations.
    pub fn rotations_per_frame(&self) -> usize {
        per_frame(self.rotation_rate_hz / self.point_rate_hz)
    }

    /// Time of each frame \[s\]; frame 1 is at zero.
    pub fn times(&self) -> Vec<f64> {
        let first = self.first_frame - 1;
        (first..).take(self.frames()).map(|frame| frame as f64 / self.point_rate_hz).collect()
    }

    /// Time of each analog sample \[s\].
    pub fn analog_times(&self) -> Vec<f64> {
        let samples = self.channels.first().map_or(0, |channel| channel.samples.len());
        let first = (self.first_frame - 1) as f64 * self.samples_per_frame() as f64;
        (0..samples).map(|sample| (first + sample as f64) / self.analog_rate_hz).collect()
    }

    /// The first point with exactly this name.
    pub fn point(&self, name: &str) -> Option<&Point> {
        self.points.iter().find(|point| point.name == name)
    }

    /// The first channel with exactly this name.
    pub fn channel(&self, name: &str) -> Option<&Channel> {
        self.channels.iter().find(|channel| channel.name == name)
    }

    /// Metres per unit of the positions; `None` if the file states no unit, or one that is not a length.
    pub fn metres_per_unit(&self) -> Option<f64> {
        metres_per(&self.point_unit)
    }

    /// The force platforms, with positions and calibrations.
    pub fn platforms(&self) -> Result<Vec<Platform>, Error> {
        self.each_platform().into_iter().collect()
    }

    /// Each force platform, or why its description cannot be used: one incomplete description does not cost the others.
    pub fn each_platform(&self) -> Vec<Result<Platform, Error>> {
        platform::platforms(&self.parameters, self.channels.len())
    }

    /// Replaces the platforms that the parameters describe.
    pub fn set_platforms(&mut self, platforms: &[Platform]) {
        self.parameters.set_group(platform::group(platforms));
    }
}

/// Samples per frame for a ratio of rates.
fn per_frame(ratio: f64) -> usize {
    if ratio.is_finite() && ratio >= 1.0 { ratio.round() as usize } else { 1 }
}

/// Metres in one unit of length. Some files truncate the word: `mete`.
fn metres_per(unit: &str) -> Option<f64> {
    const INCH: f64 = 0.0254; // international inch, exact
    const FOOT: f64 = 0.3048; // international foot, exact
    let unit = unit.trim().to_ascii_lowercase();
    Some(match unit.as_str() {
        "mm" | "millimeter" | "millimeters" | "millimetre" | "millimetres" => 1e-3,
        "cm" | "centimeter" | "centimeters" | "centimetre" | "centimetres" => 1e-2,
        "dm" => 1e-1,
        "m" | "mete" | "meter" | "meters" | "metre" | "metres" => 1.0,
        "in" | "inch" | "inches" => INCH,
        "ft" | "foot" | "feet" => FOOT,
        _ => return None,
    })
}
