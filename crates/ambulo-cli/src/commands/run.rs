//! `ambulo run`: a request in JSON.

use crate::args::{RunArgs, line, with_options};
use crate::caller::Caller;
use crate::request::Request;
use crate::{Completion, execute, files, printer};
use anyhow::{Context, Result};

pub(crate) fn run(args: &RunArgs, caller: &Caller) -> Result<Completion> {
    let shown = || args.request.display().to_string();
    let request = Request::read(&files::read(&args.request)?).with_context(shown)?;
    match (&args.options, args.words) {
        (options, true) => {
            printer::line(&line(&request, options.as_deref().unwrap_or_default())?).map(|()| Completion::Passed)
        }
        (Some(options), false) => execute(with_options(&request, options, args.handling)?, caller),
        (None, false) => request.run(args.handling),
    }
}
