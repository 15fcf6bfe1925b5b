//! Options of `ambulo stream`.

use super::values::{Endpoint, endpoint, milliseconds, number};
use clap::{Args as ClapArgs, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
#[command(after_help = "Examples (after `ambulo demo -o demo`):
  ambulo stream demo/input/figure.osim --rate 100 --describe
  ambulo stream MODEL.osim --rate 200 < frames.jsonl > forces.jsonl
  ambulo stream MODEL.osim --rate 200 --input tcp:5005 --delay 30

Frames come in as coordinates of the model, results go back to where they came from: standard output, the same connection, or the sender of the
datagrams. With --format json every message is a line. The first one may name the coordinates, the frames follow:

  {\"coordinates\": [\"pelvis_tilt\", \"pelvis_tx\"], \"angles\": \"deg\"}
  {\"frame\": 0, \"q\": [1.5, 0.02]}
  {\"frame\": 1, \"q\": [1.6, null]}

Angles are radians unless the first line says `deg`, lengths are metres; null is a missing value. `frame` counts the frames, or `time` gives their
time in seconds: from it the command sees frames that were lost, doubled, late or out of order, says so, and goes on. docs/STREAMING.md
describes both formats, the delays and the accuracy of each.")]
pub(crate) struct StreamArgs {
    /// The OpenSim model (.osim) of the coordinates.
    pub(crate) model: PathBuf,
    /// Frame rate of the motion [Hz].
    #[arg(long, value_name = "HZ", value_parser = number)]
    pub(crate) rate: f64,
    /// Time from a frame to its forces [ms]: 0 at once, 70 as accurate as it gets without waiting for the next step.
    #[arg(long, value_name = "MS", default_value_t = 70.0, value_parser = milliseconds)]
    pub(crate) delay: f64,
    /// Where frames come from: stdin, tcp:[IP:]PORT or udp:[IP:]PORT; without an address only this computer can connect (127.0.0.1).
    #[arg(long, value_name = "SOURCE", default_value = "stdin", value_parser = endpoint)]
    pub(crate) input: Endpoint,
    /// Form of frames and results.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: StreamFormat,
    /// Print the coordinates that a frame has and the columns of a result, and stop.
    #[arg(long)]
    pub(crate) describe: bool,
    /// Print nothing but errors on standard error.
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// Form of frames and results.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum StreamFormat {
    /// A line of JSON each.
    #[default]
    Json,
    /// Records of one size: the number of the frame as 32-bit integer, then 32-bit numbers, all little-endian.
    F32,
}
