//! Where messages come from and answers go.

use super::{Conversation, Setup};
use anyhow::{Context, Result, anyhow};
use std::io::{BufRead, BufReader, ErrorKind, Read, Write};
use std::net::{SocketAddr, TcpListener, UdpSocket};

/// Longest line [bytes]: a frame of a thousand coordinates has 20 kB.
const LONGEST_LINE: u64 = 1 << 20;
/// Largest datagram [bytes].
const LARGEST_DATAGRAM: usize = 1 << 16;
/// Senders of datagrams at a time; of more, the one that was silent for the longest time is ended.
const MOST_SENDERS: usize = 8;

/// Takes messages from one sender until there are no more.
///
/// # Errors
/// A link that cannot be read or written, a line without end, a model that cannot be streamed. A receiver that has
/// closed its end is none.
pub(super) fn serve(
    input: &mut impl BufRead,
    output: &mut impl Write,
    conversation: &mut Conversation<'_>,
) -> Result<()> {
    conversation.greet();
    let mut message = Vec::new();
    while send(output, conversation)? && next(input, conversation.message_bytes(), &mut message)? {
        conversation.receive(&message)?;
    }
    conversation.end()?;
    send(output, conversation)?;
    Ok(())
}

/// Reads a record of this size or else a line; false at the end of the input.
fn next(input: &mut impl BufRead, bytes: Option<usize>, message: &mut Vec<u8>) -> Result<bool> {
    message.clear();
    let longest = bytes.map_or(LONGEST_LINE, |bytes| bytes as u64);
    let mut limited = input.take(longest);
    let read = match bytes {
        Some(_) => limited.read_to_end(message),
        None => limited.read_until(b'\n', message),
    };
    match read {
        Ok(0) => Ok(false),
        Ok(read) if bytes.is_none() && read as u64 == LONGEST_LINE && message.last() != Some(&b'\n') => {
            Err(anyhow!("a line of more than 1 MB; expected a message of one line. hint: --format f32 reads records"))
        }
        Ok(_) => Ok(true),
        Err(error) if is_gone(error.kind()) => Ok(false),
        Err(error) => Err(error).context("frames cannot be read"),
    }
}

/// Sends the answers; false if the receiver has closed its end.
fn send(output: &mut impl Write, conversation: &mut Conversation<'_>) -> Result<bool> {
    let sent = output.write_all(&conversation.out).and_then(|()| output.flush());
    conversation.out.clear();
    match sent {
        Ok(()) => Ok(true),
        Err(error) if is_gone(error.kind()) => Ok(false),
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
        let (connection, peer) = listener.accept().context("connections cannot be accepted")?;
        setup.say(&format!("{peer} connected"));
        // Every answer is sent at once, without waiting for more; where that cannot be chosen, answers come later.
        let _ = connection.set_nodelay(true);
        let mut conversation = Conversation::new(setup)?;
        let mut input = BufReader::new(&connection);
        match serve(&mut input, &mut &connection, &mut conversation) {
            Err(error) if error.chain().any(|cause| cause.is::<ambulo::ground::stream::StreamError>()) => {
                return Err(error);
            }
            Err(error) => setup.say(&format!("warning: {peer}: {error:#}")),
            Ok(()) => {}
        }
        setup.say(&format!("{peer} disconnected; waiting for the next connection"));
    }
}

/// Answers every datagram to its sender. Each sender has its own conversation; an empty datagram ends it.
///
/// # Errors
/// A port that cannot be used, a model that cannot be streamed.
pub(super) fn serve_udp(setup: &Setup<'_>, address: SocketAddr) -> Result<()> {
    let socket = UdpSocket::bind(address).map_err(|error| not_bound(error, "UDP", address))?;
    say_listening(setup, "UDP", socket.local_addr()?);
    let mut datagram = vec![0; LARGEST_DATAGRAM];
    // The sender of the last datagram is the last one.
    let mut senders: Vec<(SocketAddr, Conversation<'_>)> = Vec::new();
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
                if senders.len() == MOST_SENDERS {
                    let (silent, mut conversation) = senders.remove(0);
                    conversation.end()?;
                    send_datagram(&socket, silent, &mut conversation);
                }
                setup.say(&format!("frames come from {peer}"));
                let mut conversation = Conversation::new(setup)?;
                conversation.greet();
                conversation
            }
        };
        match length {
            0 => conversation.end()?,
            _ => conversation.receive(&datagram[..length])?,
        }
        send_datagram(&socket, peer, &mut conversation);
        if length > 0 {
            senders.push((peer, conversation));
        }
    }
}

/// Sends the answers in one datagram; a sender that has gone is no reason to stop.
fn send_datagram(socket: &UdpSocket, peer: SocketAddr, conversation: &mut Conversation<'_>) {
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
