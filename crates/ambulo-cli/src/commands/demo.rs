//! `ambulo demo`: the main job on built-in input.

use crate::Verdict;
use crate::args::DemoArgs;
use anyhow::Result;

pub(crate) fn run(_args: &DemoArgs) -> Result<Verdict> {
    anyhow::bail!("in work")
}
