//! `ambulo stream`: forces while a motion arrives.
//!
//! One thread reads a message, computes and answers before it reads the next one, so that nothing piles up: a sender
//! that is too fast waits (TCP, pipes) or loses datagrams (UDP), which the numbers of the frames show. The live page
//! has separate threads, for which this one never waits.

pub(crate) mod clock;
mod conversation;
mod coordinates;
pub(crate) mod formats;
pub(crate) mod line_text;
mod links;
mod live_view;
mod markers;
pub(crate) mod numbering;
pub(crate) mod page_server;
mod patient;

use crate::args::{Endpoint, StreamArgs};
use crate::{Completion, files, printer};
use ambulo::analysis::feasibility::Person;
use ambulo::findings::Findings;
use ambulo::ground::stream::{Stream, StreamError, StreamSettings};
use ambulo::job;
use ambulo::model::Model;
use ambulo_report::page::live_page;
use ambulo_results::stream_columns;
use anyhow::Result;
use conversation::Conversation;
use page_server::PageServer;
use std::io::{stdin, stdout};
use std::net::SocketAddr;

/// The options and the model, the same for every connection.
struct Setup<'a> {
    args: &'a StreamArgs,
    model: Model,
    settings: StreamSettings,
    /// The live page, if there is one.
    page: Option<PageServer>,
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
    let model = job::model(&files::read(&args.model)?, &args.model, &mut findings)?;
    let settings = StreamSettings { delay_s: 1e-3 * args.delay, ..StreamSettings::at_rate(args.rate) };
    let mut setup = Setup { args, model, settings, page: None };
    for finding in findings.as_slice() {
        setup.say(&format!("{}: {}", finding.severity(), finding.message));
    }
    if args.describe {
        printer::stream_description(&Conversation::new(&setup)?.description())?;
        return Ok(Completion::Passed);
    }
    if let Some(address) = args.page {
        setup.page = Some(page(&setup, address)?);
    }
    match args.input {
        Endpoint::Stdin => {
            let mut conversation = Conversation::new(&setup)?;
            links::serve(&mut stdin().lock(), &mut stdout().lock(), &mut conversation, || ())?;
            conversation.check_used()?;
        }
        Endpoint::Tcp(address) => links::serve_tcp(&setup, address)?,
        Endpoint::Udp(address) => links::serve_udp(&setup, address)?,
    }
    Ok(Completion::Passed)
}

/// Starts the live page.
fn page(setup: &Setup<'_>, address: SocketAddr) -> Result<PageServer> {
    // A wrong rate or delay is reported before a port is opened.
    let delay_frames = setup.stream()?.delay_frames();
    let rate_hz = setup.settings.rate_hz;
    let html = live_page(&setup.model, &stream_columns(&setup.model), rate_hz, 1e3 * delay_frames as f64 / rate_hz)?;
    let server = PageServer::start(links::bound(address, "page")?, html)?;
    live_view::state(&server, "waiting", "no frames have come yet");
    setup.say(&format!("live page on http://{}/ ({})", server.address(), links::reach(server.address())));
    Ok(server)
}
