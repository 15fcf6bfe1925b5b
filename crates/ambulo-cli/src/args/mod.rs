//! What the user may type, one file a verb where it is long.

mod exchange;
mod forces;
mod report;
mod tools;
mod values;
mod walk;

pub(crate) use exchange::{ConvertArgs, EventsArgs, What};
pub(crate) use forces::{Consistency, Filter, ForcesArgs, MarkerFitting, SubjectArgs};
pub(crate) use report::{ReportArgs, ViewArgs};
pub(crate) use tools::{CompareArgs, InfoArgs, ReproduceArgs, SimulateArgs};
pub(crate) use values::{FootColumns, PlateFoot};
pub(crate) use walk::{DemoArgs, FigureArgs, GaitArgs, WalkArgs, WalkMode};

use clap::{Args as ClapArgs, Parser, Subcommand};

/// Forces behind human walking: motion in, forces out.
#[derive(Debug, Parser)]
#[command(name = "ambulo", version = env!("AMBULO_VERSION"), about)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// A recording in, joint moments, powers, reactions and ground forces out.
    Forces(Box<ForcesArgs>),
    /// A figure that walks, at any speed and in any style: the same outputs as `forces`, no file needed.
    Walk(Box<WalkArgs>),
    /// The main job without any input: a free walk and the forces behind it.
    Demo(DemoArgs),
    /// A scene file stepped through time: poses, joint efforts, contact forces, energies.
    Simulate(SimulateArgs),
    /// Every figure and claim of the 1997 paper, recomputed.
    Reproduce(ReproduceArgs),
    /// The report page of a result folder, made anew; two or three runs compared.
    Report(ReportArgs),
    /// The report page of a result folder, in the browser.
    View(ViewArgs),
    /// What a file holds.
    Info(InfoArgs),
    /// From one format to another: c3d, trc, mot, sto, csv, bvh.
    Convert(ConvertArgs),
    /// When feet meet and leave the ground: from plates, from the motion, from the file.
    Events(EventsArgs),
    /// How far two tables agree, column by column.
    Compare(CompareArgs),
}

/// How much a command says, and in which form.
#[derive(Debug, Clone, Copy, ClapArgs)]
pub(crate) struct Voice {
    /// Print JSON on standard output instead of text.
    #[arg(long)]
    pub(crate) json: bool,
    /// Print nothing but errors.
    #[arg(long, conflicts_with = "json")]
    pub(crate) quiet: bool,
}
