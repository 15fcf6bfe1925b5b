//! Options of `ambulo run`.

use super::Handling;
use clap::Args as ClapArgs;
use std::path::PathBuf;

#[derive(Debug, Clone, ClapArgs)]
#[command(after_help = "Example (after `ambulo demo -o demo`, with this content of request.json):
  ambulo run request.json

  {\"forces\": {\"job\": {\"recording\": \"demo/input/walk.c3d\", \"standing\": \"demo/input/standing.c3d\",
    \"size\": {\"mass_kg\": 75, \"height_m\": 1.75}}, \"output\": \"out\"}}

A request is a JSON object with the verb as its only key: forces, calibrate, validate, batch, session, walk, sweep,
demo, simulate or events. It computes the same files as the verb with the same settings as options. Files are
relative to the present folder. A field that is left out has its default; an unknown one is an error that lists
the known ones. docs/REQUESTS.md has the fields, docs/request.schema.json is their JSON schema.

Exit code: that of the verb.")]
pub(crate) struct RunArgs {
    /// The request: .json.
    pub(crate) request: PathBuf,
    /// Further options of the verb as they are typed, such as '--predict --from 0.5'; only for forces, walk, simulate
    /// and demo.
    #[arg(long, value_name = "TEXT", allow_hyphen_values = true)]
    pub(crate) options: Option<String>,
    /// Only print the command line with the same settings; only for forces, walk, simulate and demo.
    #[arg(long)]
    pub(crate) words: bool,
    #[command(flatten)]
    pub(crate) handling: Handling,
}
