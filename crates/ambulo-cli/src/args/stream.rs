//! Options of `ambulo stream`.

use super::values::{Endpoint, endpoint, local_address, milliseconds, number, zero_or_more_seconds};
use ambulo::findings::word;
use ambulo::spatial::{Mat3, Vec3};
use clap::{Args as ClapArgs, ValueEnum};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::str::FromStr;

#[derive(Debug, ClapArgs)]
#[command(after_help = "Examples (after `ambulo demo -o demo`):
  ambulo stream demo/input/figure.osim --rate 100 --describe
  ambulo stream MODEL.osim --rate 200 < frames.jsonl > forces.jsonl
  ambulo stream MODEL.osim --rate 200 --input tcp:5005 --delay 30
  ambulo stream MODEL.osim --rate 200 --input tcp:5005 --page=8080
  ambulo stream out/subject.osim --rate 100 --input tcp:5005 --markers --unit mm --axes +y,+z

Frames are coordinates of the model. Results are sent to the source of the frames: standard output, the same
connection, or the sender of the datagrams. With --format json every message is a line. The first line may name
the coordinates, then frames follow:

  {\"coordinates\": [\"pelvis_tilt\", \"pelvis_tx\"], \"angles\": \"deg\"}
  {\"frame\": 0, \"q\": [1.5, 0.02]}
  {\"frame\": 1, \"q\": [1.6, null]}

With --markers a frame has positions instead; null is a missing marker:

  {\"markers\": [\"RASI\", \"LASI\"], \"unit\": \"mm\", \"axes\": \"+y,+z\"}
  {\"frame\": 0, \"markers\": [[812.5, 101.0, 960.2], null]}

Angles are in radians unless the first line states `deg`, lengths in metres; null is a missing value. `frame`
counts the frames, or `time` is their time in seconds. Frames that are missing, repeated, late or out of order
are reported, and the stream continues. docs/STREAMING.md describes formats, delays and accuracy.")]
pub(crate) struct StreamArgs {
    /// The OpenSim model (.osim) of the coordinates.
    pub(crate) model: PathBuf,
    /// Frame rate of the motion [Hz].
    #[arg(long, value_name = "HZ", value_parser = number)]
    pub(crate) rate: f64,
    /// Delay from a frame to its forces [ms]: 0 is immediate; 70 is the most accurate without waiting for the next
    /// step.
    #[arg(long, value_name = "MS", default_value_t = 70.0, value_parser = milliseconds)]
    pub(crate) delay: f64,
    /// Source of the frames: stdin, tcp:[IP:]PORT or udp:[IP:]PORT; without an address only this computer can connect
    /// (127.0.0.1).
    #[arg(long, value_name = "SOURCE", default_value = "stdin", value_parser = endpoint)]
    pub(crate) input: Endpoint,
    /// Over TCP, end a connection that sends no complete frame, or reads no result, for so long [s], so that the next
    /// one is served; 0 waits without end.
    #[arg(long, value_name = "S", default_value_t = 30.0, value_parser = idle_seconds)]
    pub(crate) idle: f64,
    /// Frames are marker positions, to which the model is fitted; it must have these markers at their positions on the
    /// person, like subject.osim of `ambulo forces`.
    #[arg(long)]
    pub(crate) markers: bool,
    /// Unit of the markers, unless the first line states it.
    #[arg(long, value_enum, default_value_t, requires = "markers")]
    pub(crate) unit: MarkerUnit,
    /// Axes of the laboratory that point forward and up, such as +y,+z; in the model they are +x,+y.
    #[arg(long, value_name = "FORWARD,UP", default_value_t, allow_hyphen_values = true, requires = "markers")]
    pub(crate) axes: LabAxes,
    /// Form of frames and results.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: StreamFormat,
    /// Show a page with the moving figure and the curves of the last seconds in the browser, at this port (0: the
    /// system chooses one); without an address only this computer can open it.
    #[arg(long, value_name = "[IP:]PORT", num_args = 0..=1, require_equals = true, default_missing_value = "0",
        value_parser = local_address)]
    pub(crate) page: Option<SocketAddr>,
    /// Print the coordinates of a frame and the columns of a result, and stop.
    #[arg(long)]
    pub(crate) describe: bool,
    /// Print nothing but errors on standard error.
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// A time without frames: at most a day.
fn idle_seconds(text: &str) -> Result<f64, String> {
    let expected = "expected a number of seconds from 0 to 86400";
    zero_or_more_seconds(text).ok().filter(|seconds| *seconds <= 86_400.0).ok_or_else(|| expected.to_owned())
}

/// Form of frames and results.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum StreamFormat {
    /// One line of JSON each.
    #[default]
    Json,
    /// Records of one size: the number of the frame as 32-bit integer, then 32-bit numbers, all little-endian.
    F32,
}

/// Unit of positions.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, Serialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub(crate) enum MarkerUnit {
    /// Metres.
    #[default]
    M,
    /// Millimetres.
    Mm,
}

impl MarkerUnit {
    /// Its name in messages.
    pub(crate) fn word(self) -> &'static str {
        word(&self)
    }

    /// Metres in the unit.
    pub(crate) fn metres(self) -> f64 {
        match self {
            MarkerUnit::M => 1.0,
            MarkerUnit::Mm => 1e-3,
        }
    }
}

/// Axes of a laboratory that point forward and up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize)]
#[serde(try_from = "String", into = "String")]
pub(crate) struct LabAxes {
    forward: Axis,
    up: Axis,
}

/// An axis by its number, and whether its opposite direction is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Axis {
    number: usize,
    is_negative: bool,
}

impl Axis {
    fn direction(self) -> Vec3 {
        Vec3::ith(self.number, if self.is_negative { -1.0 } else { 1.0 })
    }
}

impl LabAxes {
    /// Rotation from laboratory to world axes: x forward, y up, z right.
    pub(crate) fn world_from_lab(self) -> Mat3 {
        let (forward, up) = (self.forward.direction(), self.up.direction());
        Mat3::from_rows(&[forward.transpose(), up.transpose(), forward.cross(&up).transpose()])
    }
}

/// World axes.
impl Default for LabAxes {
    fn default() -> LabAxes {
        LabAxes { forward: Axis { number: 0, is_negative: false }, up: Axis { number: 1, is_negative: false } }
    }
}

impl fmt::Display for LabAxes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |axis: Axis| format!("{}{}", if axis.is_negative { "-" } else { "+" }, ["x", "y", "z"][axis.number]);
        write!(f, "{},{}", name(self.forward), name(self.up))
    }
}

impl FromStr for LabAxes {
    type Err = String;
    fn from_str(text: &str) -> Result<LabAxes, String> {
        let axis = |word: &str| {
            let word = word.trim();
            let (is_negative, letter) = match word.strip_prefix('-') {
                Some(letter) => (true, letter),
                None => (false, word.strip_prefix('+').unwrap_or(word)),
            };
            let number = ["x", "y", "z"].iter().position(|known| known.eq_ignore_ascii_case(letter))?;
            Some(Axis { number, is_negative })
        };
        let (forward, up) = text.split_once(',').unwrap_or((text, ""));
        match (axis(forward), axis(up)) {
            (Some(forward), Some(up)) if forward.number != up.number => Ok(LabAxes { forward, up }),
            _ => {
                Err("expected the axes that point forward and up, two of x, y and z with their signs, such as +y,+z"
                    .into())
            }
        }
    }
}

impl TryFrom<String> for LabAxes {
    type Error = String;
    fn try_from(text: String) -> Result<LabAxes, String> {
        text.parse()
    }
}

impl From<LabAxes> for String {
    fn from(axes: LabAxes) -> String {
        axes.to_string()
    }
}
