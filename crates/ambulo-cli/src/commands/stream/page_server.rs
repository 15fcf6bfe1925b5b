//! Serves the live page: one HTML document and a stream of events (Server-Sent Events, HTML standard, section 9.2).
//!
//! Events go one way, from here to the browser, which connects again by itself. Only GET is answered, and only two
//! paths. A page of another site cannot read the events: `Host` must be an address or `localhost`, which a name that is
//! rebound to this computer is not, and `Origin`, where a browser sends it, must be this server.
//!
//! The stream never waits for a browser: every browser has a queue of [`QUEUE`] events; those that find it full are
//! skipped, and a browser that takes nothing for [`TIMEOUT`] is disconnected. A request must be complete within
//! [`REQUEST_TIME`], so that connections that send next to nothing do not shut browsers out.

use super::patient::Patient;
use anyhow::Result;
use std::cell::Cell;
use std::io::{BufRead, BufReader, ErrorKind, Read, Write};
use std::net::{IpAddr, SocketAddr, TcpListener, TcpStream};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Events that wait for a browser: about a second of motion.
pub const QUEUE: usize = 64;
/// Time without progress after which a browser is disconnected.
const TIMEOUT: Duration = Duration::from_secs(5);
/// Time without events after which a comment is sent, so that a closed browser is detected.
const KEEP_ALIVE: Duration = Duration::from_secs(2);
/// Longest time of a request, however slowly its bytes come.
const REQUEST_TIME: Duration = Duration::from_secs(5);
/// Pause after a connection that could not be accepted, such as without a free file descriptor.
const PAUSE: Duration = Duration::from_millis(200);
/// Largest request [bytes].
const LARGEST_REQUEST: u64 = 1 << 14;
/// Browsers at the same time.
const MOST_BROWSERS: usize = 16;
/// Longest time to send the last events at the end of a stream.
const CLOSING_TIME: Duration = Duration::from_millis(500);

/// The browsers that watch, and what each sees first.
#[derive(Default)]
struct Audience {
    queues: Vec<SyncSender<Arc<str>>>,
    first: Option<Arc<str>>,
}

/// The server; it ends with the process.
#[derive(Clone)]
pub struct PageServer {
    audience: Arc<Mutex<Audience>>,
    /// Events in queues.
    waiting: Arc<AtomicUsize>,
    address: SocketAddr,
}

impl PageServer {
    /// Serves a page from a listener.
    ///
    /// # Errors
    /// A listener without an address.
    pub fn start(listener: TcpListener, html: String) -> Result<PageServer> {
        let address = listener.local_addr()?;
        let server = PageServer { audience: Arc::default(), waiting: Arc::default(), address };
        let (html, serving) = (Arc::<str>::from(html), server.clone());
        thread::spawn(move || {
            let open = Arc::new(AtomicUsize::new(0));
            for connection in listener.incoming() {
                let Ok(connection) = connection else {
                    thread::sleep(PAUSE);
                    continue;
                };
                if open.load(Ordering::Relaxed) >= MOST_BROWSERS {
                    continue;
                }
                let (html, serving, open) = (Arc::clone(&html), serving.clone(), Arc::clone(&open));
                open.fetch_add(1, Ordering::Relaxed);
                thread::spawn(move || {
                    // A connection that breaks concerns only its browser.
                    let _ = serving.answer(&connection, &html);
                    open.fetch_sub(1, Ordering::Relaxed);
                });
            }
        });
        Ok(server)
    }

    /// Where the page is.
    #[must_use]
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// Whether a browser watches.
    #[must_use]
    pub fn is_watched(&self) -> bool {
        !self.lock().queues.is_empty()
    }

    /// Sends an event to all browsers that have room for it.
    pub fn publish(&self, kind: &str, data: &str) {
        let event = event(kind, data);
        let mut audience = self.lock();
        audience.queues.retain(|queue| match queue.try_send(Arc::clone(&event)) {
            Ok(()) => {
                self.waiting.fetch_add(1, Ordering::Relaxed);
                true
            }
            Err(TrySendError::Full(_)) => true,
            Err(TrySendError::Disconnected(_)) => false,
        });
    }

    /// Sends an event now, and first of all to every browser that comes later.
    pub fn publish_first(&self, kind: &str, data: &str) {
        self.lock().first = Some(event(kind, data));
        self.publish(kind, data);
    }

    /// Waits a moment until the events were sent.
    pub fn finish(&self) {
        let begun = Instant::now();
        while self.waiting() > 0 && begun.elapsed() < CLOSING_TIME {
            thread::sleep(Duration::from_millis(5));
        }
    }

    /// Number of events that wait for a browser.
    #[must_use]
    pub fn waiting(&self) -> usize {
        self.waiting.load(Ordering::Relaxed)
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Audience> {
        self.audience.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn answer(&self, mut connection: &TcpStream, html: &str) -> std::io::Result<()> {
        connection.set_write_timeout(Some(TIMEOUT))?;
        let request = Request::read(connection)?;
        match request.status() {
            200 if request.path == "/events" => {
                connection.write_all(
                    b"HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nCache-Control: no-store\r\nConnection: \
                     close\r\nX-Content-Type-Options: nosniff\r\n\r\n",
                )?;
                self.send_events(connection)
            }
            200 => respond(connection, "200 OK", "text/html; charset=utf-8", html),
            403 => respond(
                connection,
                "403 Forbidden",
                "text/plain",
                "this page is only for browsers that open its address",
            ),
            404 => respond(connection, "404 Not Found", "text/plain", "there is only /"),
            _ => respond(connection, "405 Method Not Allowed", "text/plain", "only GET is answered"),
        }
    }

    fn send_events(&self, connection: &TcpStream) -> std::io::Result<()> {
        let (sender, queue) = sync_channel(QUEUE);
        {
            let mut audience = self.lock();
            if let Some(first) = &audience.first {
                self.waiting.fetch_add(usize::from(sender.try_send(Arc::clone(first)).is_ok()), Ordering::Relaxed);
            }
            audience.queues.push(sender);
        }
        let sent = self.send_queue(connection, &queue);
        // The rest of the queue is dropped.
        self.waiting.fetch_sub(queue.try_iter().count(), Ordering::Relaxed);
        sent
    }

    fn send_queue(&self, mut connection: &TcpStream, queue: &Receiver<Arc<str>>) -> std::io::Result<()> {
        loop {
            match queue.recv_timeout(KEEP_ALIVE) {
                Ok(event) => {
                    let sent = connection.write_all(event.as_bytes());
                    self.waiting.fetch_sub(1, Ordering::Relaxed);
                    sent?;
                }
                Err(RecvTimeoutError::Timeout) => connection.write_all(b":\n\n")?,
                Err(RecvTimeoutError::Disconnected) => return Ok(()),
            }
        }
    }
}

fn event(kind: &str, data: &str) -> Arc<str> {
    format!("event: {kind}\ndata: {data}\n\n").into()
}

fn respond(mut connection: &TcpStream, status: &str, kind: &str, body: &str) -> std::io::Result<()> {
    let head = format!(
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {}\r\nCache-Control: no-store\r\nConnection: \
         close\r\nX-Content-Type-Options: nosniff\r\n\r\n",
        body.len()
    );
    connection.write_all(head.as_bytes())?;
    connection.write_all(body.as_bytes())
}

/// The first lines of a request.
#[derive(Debug, Default)]
struct Request {
    method: String,
    path: String,
    host: Option<String>,
    origin: Option<String>,
}

impl Request {
    fn read(connection: &TcpStream) -> std::io::Result<Request> {
        let begun = Cell::new(Instant::now());
        let patient = Patient::new(connection, Some(REQUEST_TIME), &begun);
        let mut lines = BufReader::new(patient.take(LARGEST_REQUEST)).lines();
        let first = lines.next().ok_or(ErrorKind::UnexpectedEof)??;
        let mut words = first.split(' ').map(str::to_owned);
        let mut request = Request {
            method: words.next().unwrap_or_default(),
            path: words.next().unwrap_or_default(),
            ..Request::default()
        };
        for line in lines {
            let line = line?;
            let Some((name, value)) = line.split_once(':') else { break };
            let value = Some(value.trim().to_owned());
            match name.to_ascii_lowercase().as_str() {
                "host" => request.host = value,
                "origin" => request.origin = value,
                _ => {}
            }
        }
        Ok(request)
    }

    fn status(&self) -> u16 {
        let is_ours = self.host.as_deref().is_some_and(is_address);
        let own = self.host.as_ref().map(|host| format!("http://{host}"));
        match self.path.as_str() {
            _ if !is_ours || self.origin.is_some() && self.origin != own => 403,
            _ if self.method != "GET" => 405,
            "/" | "/events" => 200,
            _ => 404,
        }
    }
}

/// Whether a host is an address or `localhost`, with or without a port.
#[must_use]
pub fn is_address(host: &str) -> bool {
    let is_ip = |text: &str| text.trim_start_matches('[').trim_end_matches(']').parse::<IpAddr>().is_ok();
    let name = host.rsplit_once(':').filter(|(_, port)| port.parse::<u16>().is_ok()).map_or(host, |(name, _)| name);
    name.eq_ignore_ascii_case("localhost") || is_ip(name) || is_ip(host)
}
