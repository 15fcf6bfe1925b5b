//! `ambulo convert` and `ambulo events`: what may be typed.

use super::Voice;
use clap::{Args as ClapArgs, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
#[command(after_help = "Examples (after `ambulo demo -o demo`):
  ambulo convert demo/input/walk.mot walk.bvh --model demo/input/figure.osim
  ambulo convert demo/moments.sto moments.csv
  ambulo convert walk.bvh walk.trc --world
  ambulo convert demo walk.glb
  ambulo convert demo results.csv

From .c3d to .trc (markers), .csv (--what markers, analog or forces), .mot or .sto (ground forces by foot, with external loads as .xml
beside it); from .trc to .c3d or .csv; from .mot or .sto to each other and to .csv, with --model to .bvh (a skeleton) and .glb (an animated glTF file); from .csv to .mot or .sto; from .bvh
to .trc (joint centres) or .csv (channels); from a folder of results to .glb (figure or scene, with ground forces as arrows), .bvh (the figure) or
.csv (time, quantity, unit, value: all results over time). What the new format cannot hold is said. Positions are metres in .csv, millimetres in .trc and
.c3d. An output that is there already is only written over with --force, the input never.")]
pub(crate) struct ConvertArgs {
    /// The file to read, or a folder of results.
    pub(crate) input: PathBuf,
    /// The file to write; its ending says the format.
    pub(crate) output: PathBuf,
    /// What of a C3D goes into a .csv [default: markers].
    #[arg(long, value_enum)]
    pub(crate) what: Option<What>,
    /// Turn markers to x forward, y up, z right (ground forces always are).
    #[arg(long)]
    pub(crate) world: bool,
    /// The body whose coordinates a .mot or .sto holds: .osim; for .bvh and .glb.
    #[arg(long, value_name = "FILE")]
    pub(crate) model: Option<PathBuf>,
    /// Write over an output that is there already.
    #[arg(long)]
    pub(crate) force: bool,
    #[command(flatten)]
    pub(crate) voice: Voice,
}

/// A part of a C3D.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum What {
    /// Paths of the markers [m].
    Markers,
    /// Analog channels, in their own units.
    Analog,
    /// Ground forces by foot, in world axes.
    Forces,
}

#[derive(Debug, ClapArgs)]
#[command(after_help = "Example (after `ambulo demo -o demo`):
  ambulo events demo/input/walk.c3d

Foot strikes and toe-offs from force plates (20 N), from the motion of the feet (the median of four published methods) and from the
file's own list, and how far they agree. Reads .c3d (all three), .trc and .bvh (motion), .mot and .sto (ground forces). Events of feet that
left a plate before the ground, or shared one, are left out.")]
pub(crate) struct EventsArgs {
    /// The recording.
    pub(crate) input: PathBuf,
    /// Also write them: .csv with side, event, time and source.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) voice: Voice,
}
