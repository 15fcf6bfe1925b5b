//! `ambulo stream`: forces while a motion arrives.
//!
//! One thread reads a message, computes and answers before it reads the next one, so that nothing piles up: a sender that is too fast waits
//! (TCP, pipes) or loses datagrams (UDP), which the numbers of the frames show.

mod conversation;
mod formats;
mod links;
mod numbering;

use super::forces::parse_model;
use crate::args::{Endpoint, StreamArgs};
use crate::{Completion, files, printer};
use ambulo::analysis::feasibility::Person;
use ambulo::findings::Findings;
use ambulo::ground::stream::{Stream, StreamError, StreamSettings};
use ambulo::model::Model;
use anyhow::Result;
use conversation::Conversation;
use std::io::{stdin, stdout};

/// The options and the model, the same for every connection.
struct Setup<'a> {
    args: &'a StreamArgs,
    model: Model,
    settings: StreamSettings,
}

impl Setup<'_> {
    fn stream(&self) -> Result<Stream, StreamError> {
        Stream::new(self.model.clone(), Person::of_model(&self.model).soles, &self.settings)
    }

    /// Prints a line on standard error.
    fn say(&self, line: &str) {
        if !self.args.quiet {
            printer::stream_line(line);
        }
    }
}

pub(crate) fn run(args: &StreamArgs) -> Result<Completion> {
    let mut findings = Findings::default();
    let model = parse_model(&files::read(&args.model)?, &args.model, &mut findings)?;
    let settings = StreamSettings { delay_s: 1e-3 * args.delay, ..StreamSettings::at_rate(args.rate) };
    let setup = Setup { args, model, settings };
    for finding in findings.as_slice() {
        setup.say(&format!("{}: {}", finding.severity(), finding.message));
    }
    let mut conversation = Conversation::new(&setup)?;
    if args.describe {
        printer::stream_description(&conversation.description())?;
        return Ok(Completion::Passed);
    }
    match args.input {
        Endpoint::Stdin => links::serve(&mut stdin().lock(), &mut stdout().lock(), &mut conversation)?,
        Endpoint::Tcp(address) => links::serve_tcp(&setup, address)?,
        Endpoint::Udp(address) => links::serve_udp(&setup, address)?,
    }
    Ok(Completion::Passed)
}
