//! Inputs of messages and outputs of answers: standard streams, TCP and UDP.

use super::line_text::is_http;
use super::patient::{Patient, is_over};
use super::{Conversation, Setup};
use anyhow::{Context, Result, anyhow, bail};
use std::cell::Cell;
use std::io::{BufRead, BufReader, ErrorKind, Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream, UdpSocket};
use std::time::{Duration, Instant};

/// Longest line [bytes]: a frame of a thousand coordinates has 20 kB.
const LONGEST_LINE: u64 = 1 << 20;
/// Largest datagram [bytes].
const LARGEST_DATAGRAM: usize = 1 << 16;
/// Most senders of datagrams at a time; with more, the conversation that was silent longest is ended.
const MOST_SENDERS: usize = 8;

/// Takes messages from one sender until there are no more.
///
/// # Errors
/// A link that cannot be read or written, a line without end, a request of HTTP, a model that cannot be streamed. A
/// receiver that has closed its end is no error, nor is a sender that was silent for too long.
pub(super) fn serve(
    input: &mut impl BufRead,
    output: &mut impl Write,
    conversation: &mut Conversation<'_>,
    waiting: impl Fn(),
) -> Result<()> {
    conversation.greet();
    let mut message = Vec::new();
    while send(output, conversation)? {
        waiting();
        match next(input, conversation.message_bytes(), &mut message)? {
            Taken::Message if is_http(&message) && !conversation.is_valid() => bail!(
                "an HTTP request; expected frames. The connection is ended, because any page in a browser can send \
                 such a request"
            ),
            Taken::Message => conversation.receive(&message)?,
            Taken::Silence => {
                conversation.silent();
                break;
            }
            Taken::End => break,
        }
    }
    conversation.end()?;
    send(output, conversation)?;
    Ok(())
}

/// Result of reading.
enum Taken {
    Message,
    /// The time for a message was over.
    Silence,
    End,
}

/// Reads a record of this size or else a line.
fn next(input: &mut impl BufRead, bytes: Option<usize>, message: &mut Vec<u8>) -> Result<Taken> {
    message.clear();
    let longest = bytes.map_or(LONGEST_LINE, |bytes| bytes as u64);
    let mut limited = input.take(longest);
    let read = match bytes {
        Some(_) => limited.read_to_end(message),
        None => limited.read_until(b'\n', message),
    };
    match read {
        Ok(0) => Ok(Taken::End),
        Ok(read) if bytes.is_none() && read as u64 == LONGEST_LINE && message.last() != Some(&b'\n') => {
            Err(anyhow!("a line of more than 1 MB; expected a message of one line. hint: --format f32 reads records"))
        }
        Ok(_) => Ok(Taken::Message),
        Err(error) if is_gone(error.kind()) => Ok(Taken::End),
        Err(error) if is_over(error.kind()) => Ok(Taken::Silence),
        Err(error) => Err(error).context("frames cannot be read"),
    }
}

/// Sends the answers; false if the receiver has closed its end.
fn send(output: &mut impl Write, conversation: &mut Conversation<'_>) -> Result<bool> {
    let sent = output.write_all(&conversation.out).and_then(|()| output.flush());
    conversation.out.clear();
    match sent {
        Ok(()) => Ok(true),
        Err(error) if is_gone(error.kind()) || is_over(error.kind()) => Ok(false),
        Err(error) => Err(error).context("results cannot be written"),
    }
}

fn is_gone(kind: ErrorKind) -> bool {
    matches!(kind, ErrorKind::BrokenPipe | ErrorKind::ConnectionReset | ErrorKind::ConnectionAborted)
}

/// Serves one connection after the other.
///
/// # Errors
/// A port that cannot be used, a model that cannot be streamed.
pub(super) fn serve_tcp(setup: &Setup<'_>, address: SocketAddr) -> Result<()> {
    let listener = bound(address, "TCP")?;
    say_listening(setup, "TCP", listener.local_addr()?);
    loop {
        let (connection, peer) = match listener.accept() {
            Ok(accepted) => accepted,
            // The connection was closed before it was accepted.
            Err(error) if is_gone(error.kind()) => continue,
            Err(error) => return Err(error).context("connections cannot be accepted"),
        };
        setup.say(&format!("{peer} connected"));
        match serve_connection(setup, &connection) {
            Err(error) if error.chain().any(|cause| cause.is::<ambulo::ground::stream::StreamError>()) => {
                return Err(error);
            }
            Err(error) => setup.say(&format!("warning: {peer}: {error:#}")),
            Ok(()) => {}
        }
        setup.say(&format!("{peer} disconnected; waiting for the next connection"));
    }
}

/// Serves a connection until it ends, or until it has neither sent nor read for the longest time.
fn serve_connection(setup: &Setup<'_>, connection: &TcpStream) -> Result<()> {
    let idle = Some(Duration::from_secs_f64(setup.args.idle)).filter(|idle| !idle.is_zero());
    // Every answer is sent at once, without waiting for more; where that cannot be chosen, answers come later.
    let _ = connection.set_nodelay(true);
    connection.set_write_timeout(idle)?;
    let begun = Cell::new(Instant::now());
    let mut input = BufReader::new(Patient::new(connection, idle, &begun));
    let mut conversation = Conversation::new(setup)?;
    serve(&mut input, &mut &*connection, &mut conversation, || begun.set(Instant::now()))
}

/// The conversations with the senders of datagrams, the one with the latest datagram last.
type Senders<'a> = Vec<(SocketAddr, Conversation<'a>)>;

/// Answers every datagram to its sender, once it has sent a valid one. Each sender has its own conversation; an empty
/// datagram ends it.
///
/// # Errors
/// A port that cannot be used, a model that cannot be streamed.
pub(super) fn serve_udp(setup: &Setup<'_>, address: SocketAddr) -> Result<()> {
    let socket = UdpSocket::bind(address).map_err(|error| not_bound(error, "UDP", address))?;
    say_listening(setup, "UDP", socket.local_addr()?);
    let mut datagram = vec![0; LARGEST_DATAGRAM];
    let mut senders = Senders::new();
    loop {
        let (length, peer) = match socket.recv_from(&mut datagram) {
            Ok(received) => received,
            // Some systems report an answer that could not be delivered when the next datagram is read.
            Err(error) if is_gone(error.kind()) => continue,
            Err(error) => return Err(error).context("datagrams cannot be read"),
        };
        let mut conversation = match senders.iter().position(|(sender, _)| *sender == peer) {
            Some(place) => senders.remove(place).1,
            None => {
                make_room(&mut senders, &socket)?;
                Conversation::new(setup)?
            }
        };
        let was_valid = conversation.is_valid();
        match length {
            0 => conversation.end()?,
            _ => conversation.receive(&datagram[..length])?,
        }
        if !was_valid && conversation.is_valid() {
            setup.say(&format!("frames come from {peer}"));
            conversation.greet_first();
        }
        send_datagram(&socket, peer, &mut conversation);
        if length > 0 {
            senders.push((peer, conversation));
        }
    }
}

/// Ends a conversation if there are too many: one without a valid message, or else the one that was silent the longest.
fn make_room(senders: &mut Senders<'_>, socket: &UdpSocket) -> Result<()> {
    if senders.len() < MOST_SENDERS {
        return Ok(());
    }
    let stray = senders.iter().position(|(_, conversation)| !conversation.is_valid());
    let (silent, mut conversation) = senders.remove(stray.unwrap_or(0));
    if conversation.is_valid() {
        conversation.end()?;
    }
    send_datagram(socket, silent, &mut conversation);
    Ok(())
}

/// Sends the answers in one datagram; a sender that has gone is no reason to stop. One that has sent nothing valid gets
/// none: its address may be another computer's.
fn send_datagram(socket: &UdpSocket, peer: SocketAddr, conversation: &mut Conversation<'_>) {
    if !conversation.is_valid() {
        conversation.out.clear();
    }
    if conversation.out.is_empty() {
        return;
    }
    let sent = socket.send_to(&conversation.out, peer);
    conversation.out.clear();
    if let Err(error) = sent {
        conversation.notice("unanswered", None, format!("an answer to {peer} could not be sent: {error}"));
        conversation.out.clear();
    }
}

/// A server on an address; `kind` is for the message.
///
/// # Errors
/// A port that cannot be used.
pub(super) fn bound(address: SocketAddr, kind: &str) -> Result<TcpListener> {
    TcpListener::bind(address).map_err(|error| not_bound(error, kind, address))
}

/// Who can connect to an address.
pub(super) fn reach(address: SocketAddr) -> &'static str {
    if address.ip().is_loopback() { "this computer only" } else { "every computer that reaches it" }
}

fn say_listening(setup: &Setup<'_>, kind: &str, address: SocketAddr) {
    setup.say(&format!("waiting for frames on {kind} {address} ({})", reach(address)));
}

fn not_bound(error: std::io::Error, kind: &str, address: SocketAddr) -> anyhow::Error {
    match error.kind() {
        ErrorKind::AddrInUse => anyhow!(
            "{kind} port {} of {} is in use by another program; expected a free port. hint: choose another port, or \
             stop the other program",
            address.port(),
            address.ip()
        ),
        ErrorKind::AddrNotAvailable => {
            anyhow!(
                "{} is not an address of this computer; expected one of its addresses, such as 127.0.0.1",
                address.ip()
            )
        }
        _ => anyhow::Error::new(error).context(format!(
            "{kind} port {} of {} cannot be used",
            address.port(),
            address.ip()
        )),
    }
}
