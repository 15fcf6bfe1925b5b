//! The server of the live page.

use ambulo_cli::internals::{PageServer, QUEUE, is_address};
use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::thread;
use std::time::{Duration, Instant};

/// What takes longer does not come.
const HANGS: Duration = Duration::from_secs(600);

fn server() -> PageServer {
    PageServer::start(TcpListener::bind("127.0.0.1:0").unwrap(), "<p>page</p>".to_owned()).unwrap()
}

fn request(server: &PageServer, first: &str, more: &str) -> TcpStream {
    let mut link = TcpStream::connect(server.address()).unwrap();
    link.set_read_timeout(Some(HANGS)).unwrap();
    write!(link, "{first} HTTP/1.1\r\n{more}\r\n").unwrap();
    link
}

fn answered(server: &PageServer, first: &str, more: &str) -> String {
    let mut text = String::new();
    request(server, first, more).read_to_string(&mut text).unwrap();
    text
}

/// Reads until a text has come.
fn read_until(link: &mut TcpStream, text: &str) -> String {
    let mut found = Vec::new();
    let mut byte = [0];
    while !String::from_utf8_lossy(&found).contains(text) {
        assert_eq!(link.read(&mut byte).unwrap(), 1, "{}", String::from_utf8_lossy(&found));
        found.push(byte[0]);
    }
    String::from_utf8(found).unwrap()
}

#[test]
fn only_the_page_and_its_events_are_served_to_browsers_of_this_address() {
    let server = server();
    let port = server.address().port();
    let own = format!("Host: 127.0.0.1:{port}\r\n");
    assert!(answered(&server, "GET /", &own).ends_with("<p>page</p>"));
    assert!(
        answered(&server, "GET /", &format!("Host: localhost:{port}\r\nOrigin: http://localhost:{port}\r\n"))
            .starts_with("HTTP/1.1 200")
    );
    assert!(answered(&server, "GET /../etc/passwd", &own).starts_with("HTTP/1.1 404"));
    assert!(answered(&server, "POST /", &own).starts_with("HTTP/1.1 405"));
    for refused in [
        format!("Host: rebound.example:{port}\r\n"),
        format!("{own}Origin: http://other.example\r\n"),
        format!("{own}Origin: null\r\n"),
        String::new(),
    ] {
        assert!(answered(&server, "GET /events", &refused).starts_with("HTTP/1.1 403"), "{refused}");
    }
    assert!(is_address("[::1]:80") && is_address("192.168.1.7:8080") && !is_address("127.0.0.1.example:80"));
}

#[test]
fn a_browser_gets_the_first_event_and_those_that_follow() {
    let server = server();
    server.publish_first("state", "{\"state\":\"waiting\"}");
    let mut link = request(&server, "GET /events", "Host: 127.0.0.1\r\n");
    read_until(&mut link, "event: state\ndata: {\"state\":\"waiting\"}\n\n");
    assert!(server.is_watched());
    server.publish("frame", "1");
    read_until(&mut link, "event: frame\ndata: 1\n\n");
    server.finish();
    assert_eq!(server.waiting(), 0);
    drop(link);
    // The connection that has gone is noticed when something is sent.
    let begun = Instant::now();
    while server.is_watched() {
        server.publish("frame", "2");
        assert!(begun.elapsed() < HANGS, "a browser that has gone still has a queue");
        thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_browser_that_reads_nothing_never_delays_the_stream() {
    let server = server();
    let idle = request(&server, "GET /events", "Host: 127.0.0.1\r\n");
    while !server.is_watched() {
        thread::sleep(Duration::from_millis(5));
    }
    let large = "0".repeat(20_000);
    // Waiting for the browser would have no end.
    (0..2000).for_each(|_| server.publish("frame", &large));
    assert!(server.waiting() <= QUEUE + 1, "the queue is bounded");
    // 40 MB do not fit into the buffers of the connection, so the browser is disconnected after a while.
    let begun = Instant::now();
    while server.is_watched() {
        server.publish("frame", &large);
        assert!(begun.elapsed() < HANGS, "an idle browser is still connected");
        thread::sleep(Duration::from_millis(20));
    }
    drop(idle);
}

#[test]
fn a_request_that_comes_byte_by_byte_is_ended() {
    let server = server();
    let mut link = TcpStream::connect(server.address()).unwrap();
    let begun = Instant::now();
    // Each byte comes long before a time-out of single reads.
    while link.write_all(b"G").is_ok() {
        assert!(begun.elapsed() < HANGS, "the request has no end");
        thread::sleep(Duration::from_millis(300));
    }
    let own = format!("Host: {}\r\n", server.address());
    assert!(answered(&server, "GET /", &own).ends_with("<p>page</p>"));
}
