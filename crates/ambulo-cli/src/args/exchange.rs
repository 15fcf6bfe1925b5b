//! Options of `ambulo convert` and `ambulo events`.

use super::{PrintArgs, ReplaceArgs};
use clap::{Args as ClapArgs, ValueEnum};
use serde::Deserialize;
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
#[command(after_help = "Examples (after `ambulo demo -o demo`):
  ambulo convert demo/input/walk.mot walk.bvh --model demo/input/figure.osim
  ambulo convert demo/moments.sto moments.csv
  ambulo convert walk.bvh walk.trc --world
  ambulo convert demo walk.glb
  ambulo convert demo results.csv
  ambulo forces demo/input/walk.bvh --mass 75 --height 1.75 -o out
  ambulo convert out mine.bvh --rig demo/input/walk.bvh

Conversions:
  .c3d         to .trc (markers), .csv (--what markers, analog or forces), .mot or .sto (ground forces per foot, with external loads in .xml)
  .trc         to .c3d or .csv
  .mot, .sto   to each other or .csv; with --model to .bvh (skeleton) or .glb (animated glTF)
  .csv         to .mot or .sto
  .bvh         to .trc (joint centres) or .csv (channels)
  folder       of results to .glb (figure or scene, ground forces as arrows), .bvh (figure, or with --rig the animator's own skeleton) or .csv (time, quantity, unit, value)

Data that the new format cannot store are reported. Positions are in metres in .csv, in millimetres in .trc and
.c3d. An existing output is only overwritten with --force, the input never. A folder with files of two runs is
refused.")]
pub(crate) struct ConvertArgs {
    /// The file to read, or a folder of results.
    pub(crate) input: PathBuf,
    /// The file to write; its extension selects the format.
    pub(crate) output: PathBuf,
    /// The part of a C3D that is written to .csv [default: markers].
    #[arg(long, value_enum)]
    pub(crate) what: Option<C3dPart>,
    /// Rotate markers to x forward, y up, z right (ground forces always are in these axes).
    #[arg(long)]
    pub(crate) world: bool,
    /// The OpenSim model (.osim) of the coordinates in a .mot or .sto; needed for .bvh and .glb.
    #[arg(long, value_name = "FILE")]
    pub(crate) model: Option<PathBuf>,
    /// The animation file (.bvh) from which the results were computed; the written .bvh has its skeleton, joint names
    /// and fingers.
    #[arg(long, value_name = "FILE")]
    pub(crate) rig: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) replace: ReplaceArgs,
    #[command(flatten)]
    pub(crate) print: PrintArgs,
}

/// A part of a C3D.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum C3dPart {
    /// Marker positions [m].
    Markers,
    /// Analog channels, in their own units.
    Analog,
    /// Ground forces per foot, in world axes.
    Forces,
}

#[derive(Debug, Clone, ClapArgs, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[command(after_help = "Example (after `ambulo demo -o demo`):
  ambulo events demo/input/walk.c3d

Lists foot strikes and foot offs from force plates (20 N), from the motion of the feet (the median of four
published methods) and from the list in the file, and compares the sources. Reads .c3d (all three), .trc, .mvnx
and .bvh (motion), .mot and .sto (ground forces). Plate events are left out if a foot was only partly on a plate
or shared it with the other foot.")]
pub(crate) struct EventsArgs {
    /// The recording.
    pub(crate) input: PathBuf,
    /// Also write the events to a .csv with side, event, time and source; an existing one is only overwritten with
    /// --force.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    #[serde(skip)]
    #[command(flatten)]
    pub(crate) replace: ReplaceArgs,
    #[serde(skip)]
    #[command(flatten)]
    pub(crate) print: PrintArgs,
}
