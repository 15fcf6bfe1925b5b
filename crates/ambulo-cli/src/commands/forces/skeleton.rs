//! A skeleton in motion (`.bvh`).

use super::{Reading, Recorded};
use crate::args::ForcesArgs;
use anyhow::{Result, bail};

pub(super) fn read(args: &ForcesArgs, _reading: &mut Reading) -> Result<Recorded> {
    bail!("{}: to come", args.input.display())
}
