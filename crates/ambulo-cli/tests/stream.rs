//! `ambulo stream`: frames of another process in, forces out; what is lost on the way is said and survived.
//!
//! | claim                                                                        | tolerance                                    |
//! |------------------------------------------------------------------------------|----------------------------------------------|
//! | a replayed recording has the forces of `ambulo forces` on all of it           | 8 % of body weight, as docs/STREAMING.md states |
//! | lines and records, standard input, TCP and UDP have the same numbers          | exact; records of single precision 0.5 N     |
//! | lost, doubled, late and broken frames: each is named, the others have results | exact                                        |
//! | markers of a C3D from another process have the forces of the batch           | 60 N                                         |
//! | the live page gets the results; an idle browser changes none                  | exact                                        |
//! | a port in use and a wrong address are refused by name                         | exact                                        |
//! | units, clocks and encodings are named once, and read where they are certain  | exact                                        |
//! | a sender that starts again loses no frame                                     | exact                                        |
//! | a web page, a silent client and a stray datagram get nothing                  | exact                                        |

use crate::shared_data::data;
use crate::workbench::Workbench;
use ambulo::findings::Findings;
use ambulo::motion::{MarkerPath, MarkerRecording, markers_from_c3d};
use ambulo_formats::c3d::C3d;
use ambulo_formats::table::Table;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream, UdpSocket};
use std::process::{Child, Stdio};
use std::time::Duration;

/// An answer that takes longer does not come.
const HANGS: Duration = Duration::from_secs(600);

/// Frames of a replay; the walk has 2.9 s.
const FRAMES: usize = 200;
/// Frames of the shorter ones.
const FEW: usize = 30;
const STREAM: [&str; 4] = ["stream", "figure.osim", "--rate", "100"];

/// The names of the coordinates, and their values in every frame: degrees and metres.
fn walk(bench: &Workbench) -> (Vec<String>, Vec<Vec<f64>>) {
    let text = bench.text("walk.mot");
    let mut lines = text.lines().skip_while(|line| line.trim() != "endheader").skip(1);
    let names = lines.next().unwrap().split_whitespace().skip(1).map(str::to_owned).collect();
    let values = |line: &str| line.split_whitespace().skip(1).map(|cell| cell.parse().unwrap()).collect();
    (names, lines.map(values).collect())
}

fn heading(names: &[String]) -> String {
    format!("{}\n", json!({ "coordinates": names, "angles": "deg" }))
}

fn line(frame: usize, q: &[f64]) -> String {
    format!("{}\n", json!({ "frame": frame, "q": q }))
}

/// The program, started.
fn started(bench: &Workbench, more: &[&str]) -> Child {
    let mut command = bench.command(&[&STREAM[..], more].concat());
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

/// The address that a server states it waits on; its standard error is read in the background from then on.
fn address(child: &mut Child) -> SocketAddr {
    let mut errors = BufReader::new(child.stderr.take().unwrap());
    let mut first = String::new();
    errors.read_line(&mut first).unwrap();
    std::thread::spawn(move || errors.read_to_end(&mut Vec::new()));
    assert!(first.contains("this computer only"), "{first}");
    first.split_whitespace().find_map(|word| word.parse().ok()).unwrap_or_else(|| panic!("{first}"))
}

/// Sends lines to standard input; returns the answers and standard error.
fn piped(bench: &Workbench, lines: Vec<String>) -> (Vec<Value>, String) {
    let mut child = started(bench, &[]);
    let mut input = child.stdin.take().unwrap();
    let sender = std::thread::spawn(move || lines.iter().for_each(|line| input.write_all(line.as_bytes()).unwrap()));
    let output = child.wait_with_output().unwrap();
    sender.join().unwrap();
    let errors = String::from_utf8(output.stderr).unwrap();
    let answers = answers(&output.stdout);
    let is_used = !results(&answers).is_empty();
    assert_eq!(output.status.code(), Some(if is_used { 0 } else { 2 }), "{errors}");
    (answers, errors)
}

/// The kinds of notices, in order.
fn notices(answers: &[Value]) -> Vec<&str> {
    answers.iter().filter_map(|answer| answer["notice"].as_str()).collect()
}

fn answers(bytes: &[u8]) -> Vec<Value> {
    bytes
        .split(|byte| *byte == b'\n')
        .filter(|line| !line.is_empty())
        .map(|line| serde_json::from_slice(line).unwrap())
        .collect()
}

/// Number and values of each result.
fn results(answers: &[Value]) -> Vec<(u64, Vec<f64>)> {
    let values = |answer: &Value| answer["values"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    answers
        .iter()
        .filter(|answer| answer["values"].is_array())
        .map(|a| (a["frame"].as_u64().unwrap(), values(a)))
        .collect()
}

fn replay(bench: &Workbench, frames: usize) -> Vec<String> {
    let (names, values) = walk(bench);
    let frames = values[..frames].iter().enumerate().map(|(frame, q)| line(frame, q));
    [heading(&names)].into_iter().chain(frames).collect()
}

#[test]
fn a_replayed_recording_has_the_forces_of_the_whole_one() {
    let bench = Workbench::new("stream_replay");
    let (answers, errors) = piped(&bench, replay(&bench, FRAMES));
    let results = results(&answers);
    assert!(results.iter().map(|(frame, _)| *frame).eq(0..FRAMES as u64), "every frame once, in order");
    assert!(errors.contains("200 frames in, forces of 200 frames out"), "{errors}");
    let description = &answers[0];
    assert_eq!((&description["delay_frames"], &description["rate_hz"]), (&json!(7), &json!(100.0)));
    let columns: Vec<&str> = description["columns"].as_array().unwrap().iter().map(|c| c.as_str().unwrap()).collect();
    assert!(columns.contains(&"ground_force_r_vy_sd") && columns.contains(&"ankle_angle_r_moment"), "{columns:?}");
    let run =
        bench.run(&["forces", "walk.mot", "--model", "figure.osim", "--keep", "tables", "--quiet", "-o", "whole"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let whole: Table = bench.table("whole/grf.mot");
    let weight = 9.81 * 75.0;
    for name in ["ground_force_r_vy", "ground_force_l_vy"] {
        let place = columns.iter().position(|column| *column == name).unwrap();
        let expected = whole.column(name).unwrap();
        // The first steps are known less well.
        let later = || results.iter().filter(|(frame, _)| (80..FRAMES as u64 - 7).contains(frame));
        let squares: f64 = later().map(|(frame, values)| (values[place] - expected[*frame as usize]).powi(2)).sum();
        let difference = 100.0 * (squares / later().count() as f64).sqrt() / weight;
        println!("{name}: {difference:.1} % of body weight from the whole recording");
        assert!(difference < 8.0, "{name}: {difference}");
        assert!(later().any(|(_, values)| values[place] > 0.8 * weight), "{name} carries the body");
    }
}

#[test]
fn lost_doubled_late_and_broken_frames_are_named_and_survived() {
    let bench = Workbench::new("stream_lost");
    let (names, values) = walk(&bench);
    let mut lines = vec![heading(&names)];
    for (frame, q) in values[..90].iter().enumerate() {
        match frame {
            20 | 21 => {}
            22 => lines.extend([line(22, q), line(20, &values[20]), line(22, q)]),
            30 => lines.extend(["{\"frame\": 30,\n".to_owned(), line(30, &q[1..]), line(30, q)]),
            40..70 => {}
            _ => lines.push(line(frame, q)),
        }
    }
    // The sender starts again.
    lines.extend((0..FEW).map(|frame| line(frame + 1000, &values[frame])));
    lines.extend((0..FEW).map(|frame| line(frame, &values[frame])));
    let (answers, errors) = piped(&bench, lines);
    let notices: Vec<&str> = answers.iter().filter_map(|answer| answer["notice"].as_str()).collect();
    assert_eq!(notices, ["lost", "late", "doubled", "refused", "refused", "lost", "lost", "restarted", "ended"]);
    for words in [
        "frames 20 to 21 did not arrive",
        "frame 20 came after a later one",
        "frame 22 came again",
        "18 values; expected 19",
    ] {
        assert!(errors.contains(words), "`{words}` is not in {errors}");
    }
    let frames: Vec<u64> = results(&answers).iter().map(|(frame, _)| *frame).collect();
    // While frames 20 and 21 were missing, 13 and 14 became due; from 40 on the stream ended and began again at 70.
    let expected = (0..13).chain(15..40).chain(70..90).chain(1000..1030).chain(0..30);
    assert_eq!(frames, expected.collect::<Vec<u64>>(), "{errors}");
}

#[test]
fn frames_after_a_refused_first_line_are_not_used() {
    let bench = Workbench::new("stream_naming");
    let (names, values) = walk(&bench);
    let frames = |count: usize| (0..count).map(|frame| line(frame, &values[frame])).collect::<Vec<String>>();
    let expected = results(&piped(&bench, replay(&bench, FEW)).0);
    let twice = heading(&[&names[..], &names[..1]].concat());
    for wrong in [heading(&names).replace("deg", "degree"), heading(&names).replace("hip", "hop"), twice] {
        let lines = [vec![wrong], frames(3), vec![heading(&names)], frames(FEW)].concat();
        let (answers, errors) = piped(&bench, lines);
        let notices: Vec<&str> = answers.iter().filter_map(|answer| answer["notice"].as_str()).collect();
        assert_eq!(notices, ["refused", "refused", "refused", "refused", "ended"], "{errors}");
        assert!(errors.contains("after a line with names or units that was refused"), "{errors}");
        assert_eq!(results(&answers), expected);
    }
    // A byte order mark is no part of the first line.
    let marked = [vec![format!("\u{feff}{}", heading(&names))], frames(FEW)].concat();
    assert_eq!(results(&piped(&bench, marked).0), expected);
}

#[test]
fn a_datagram_of_another_program_ends_no_sequence() {
    let bench = Workbench::new("stream_stray");
    let expected = results(&piped(&bench, replay(&bench, FEW)).0);
    let mut server = started(&bench, &["--input", "udp:0"]);
    let address = address(&mut server);
    let socket = || {
        let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
        socket.set_read_timeout(Some(HANGS)).unwrap();
        socket.connect(address).unwrap();
        socket
    };
    let (sender, stray) = (socket(), socket());
    let mut datagram = vec![0; 1 << 16];
    let mut receive = |socket: &UdpSocket| {
        let length = socket.recv(&mut datagram).unwrap();
        answers(&datagram[..length])
    };
    let mut found = Vec::new();
    for (place, line) in replay(&bench, FEW).iter().enumerate() {
        sender.send(line.as_bytes()).unwrap();
        // The description comes first, then a result for each frame but those of the delay.
        if place == 0 || place > 7 {
            found.extend(results(&receive(&sender)));
        }
        if place == FEW / 2 {
            stray.send(b"x").unwrap();
        }
    }
    sender.send(&[]).unwrap();
    found.extend(results(&receive(&sender)));
    assert_eq!(found, expected);
    // What is no message gets no answer: its sender may be another computer.
    stray.set_nonblocking(true).unwrap();
    assert!(stray.recv(&mut [0; 9]).is_err());
    server.kill().unwrap();
    server.wait().unwrap();
}

/// Replays lines to a TCP server as records or lines, and reads everything that it answers.
fn over_tcp(address: SocketAddr, bytes: Vec<u8>) -> Vec<u8> {
    let mut link = TcpStream::connect(address).unwrap();
    let mut sending = link.try_clone().unwrap();
    let sender = std::thread::spawn(move || {
        sending.write_all(&bytes).unwrap();
        sending.shutdown(std::net::Shutdown::Write).unwrap();
    });
    let mut received = Vec::new();
    link.read_to_end(&mut received).unwrap();
    sender.join().unwrap();
    received
}

#[test]
fn tcp_serves_one_connection_after_the_other_with_the_numbers_of_standard_input() {
    let bench = Workbench::new("stream_tcp");
    let lines = replay(&bench, FEW);
    let (by_pipe, _) = piped(&bench, lines.clone());
    let mut server = started(&bench, &["--input", "tcp:0"]);
    let address = address(&mut server);
    for _ in 0..2 {
        let received = over_tcp(address, lines.concat().into_bytes());
        assert_eq!(answers(&received), by_pipe);
    }
    // A connection that breaks in the middle of a line is survived.
    TcpStream::connect(address).unwrap().write_all(&lines.concat().as_bytes()[..2000]).unwrap();
    assert_eq!(answers(&over_tcp(address, lines.concat().into_bytes())), by_pipe);
    let in_use = bench.run(&[&STREAM[..], &["--input", &format!("tcp:{}", address.port())]].concat());
    in_use.refused(&["is in use by another program", "hint: choose another port"]);
    server.kill().unwrap();
    server.wait().unwrap();
}

#[test]
fn records_over_udp_have_the_numbers_of_lines() {
    let bench = Workbench::new("stream_udp");
    let (names, values) = walk(&bench);
    let model_order = bench.run(&[&STREAM[..], &["--describe"]].concat()).done();
    let description: Value = serde_json::from_str(&model_order.stdout).unwrap();
    let order: Vec<usize> = description["coordinates"]
        .as_array()
        .unwrap()
        .iter()
        .map(|name| names.iter().position(|n| n == name.as_str().unwrap()).unwrap())
        .collect();
    let count = description["columns"].as_array().unwrap().len();
    let mut server = started(&bench, &["--input", "udp:0", "--format", "f32"]);
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    socket.set_read_timeout(Some(HANGS)).unwrap();
    socket.connect(address(&mut server)).unwrap();
    let mut found: Vec<(u64, Vec<f64>)> = Vec::new();
    let mut datagram = vec![0; 1 << 16];
    let mut receive = |found: &mut Vec<(u64, Vec<f64>)>| {
        let length = socket.recv(&mut datagram).unwrap();
        for record in datagram[..length].chunks(4 * (count + 1)) {
            let words: Vec<[u8; 4]> = record.chunks(4).map(|word| word.try_into().unwrap()).collect();
            let values = words[1..].iter().map(|word| f64::from(f32::from_le_bytes(*word))).collect();
            found.push((u64::from(u32::from_le_bytes(words[0])), values));
        }
    };
    // A record that was cut is refused, and the next ones are not.
    socket.send(b"cut").unwrap();
    for (frame, q) in values[..FEW].iter().enumerate() {
        let in_si = |&place: &usize| {
            if names[place].starts_with("pelvis_t") && names[place] != "pelvis_tilt" {
                q[place]
            } else {
                q[place].to_radians()
            }
        };
        let floats = order.iter().map(in_si).flat_map(|value| (value as f32).to_le_bytes());
        let record: Vec<u8> = (frame as u32).to_le_bytes().into_iter().chain(floats).collect();
        socket.send(&record).unwrap();
        if frame >= 7 {
            receive(&mut found);
        }
    }
    socket.send(&[]).unwrap();
    receive(&mut found);
    let (by_pipe, _) = piped(&bench, replay(&bench, FEW));
    let expected = results(&by_pipe);
    assert_eq!(found.len(), expected.len());
    for ((frame, values), (number, others)) in found.iter().zip(&expected) {
        assert_eq!(frame, number);
        // The coordinates have single precision.
        let largest = values.iter().zip(others).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(largest < 0.5, "frame {frame}: {largest}");
    }
    server.kill().unwrap();
    server.wait().unwrap();
}

#[test]
fn what_cannot_be_streamed_is_refused_by_name() {
    let bench = Workbench::new("stream_refused");
    let refused =
        |words: &[&str], expected: &[&str]| bench.run(&[&["stream", "figure.osim"], words].concat()).refused(expected);
    refused(&["--rate", "5"], &["frame rate of 5 Hz", "20 to 2000 Hz"]);
    refused(&["--rate", "100", "--delay", "2000"], &["a delay of 2 s"]);
    refused(&["--rate", "100", "--input", "tcp:203.0.113.7:5005"], &["is not an address of this computer"]);
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port();
    refused(&["--rate", "100", "--input", &format!("tcp:{port}")], &["in use by another program"]);
    let wrong = bench.run(&[&STREAM[..], &["--input", "serial:3"]].concat());
    assert!(wrong.code == Some(2) && wrong.stderr.contains("udp:PORT"), "{}", wrong.stderr);
    // A stream of which nothing could be used has failed.
    let (_, errors) = piped(&bench, vec!["hello\n".to_owned(); 3]);
    assert!(errors.contains("no frame could be used") && errors.contains("3 x refused"), "{errors}");
    // Names that the model does not have are said, with those that it has.
    let (answers, _) = piped(&bench, vec!["{\"coordinates\": [\"elbow\"]}\n".to_owned()]);
    let message = answers[1]["message"].as_str().unwrap();
    assert!(message.contains("no coordinate `elbow`") && message.contains("hip_flexion_r"), "{message}");
}

/// Lines of the first seconds of the walk, each frame with its values changed, and with its number or time.
fn changed(bench: &Workbench, head: &Value, frame: impl Fn(usize, &[f64], &[String]) -> Value) -> Vec<String> {
    let (names, values) = walk(bench);
    let mut head = head.clone();
    head["coordinates"] = json!(names);
    let lines = values[..280].iter().enumerate().map(|(number, q)| frame(number, q, &names));
    [head].into_iter().chain(lines).map(|line| format!("{line}\n")).collect()
}

/// Whether a coordinate of the walk is a position.
fn is_position(name: &str) -> bool {
    ["pelvis_tx", "pelvis_ty", "pelvis_tz"].contains(&name)
}

fn scaled(q: &[f64], names: &[String], angles: f64, positions: f64) -> Vec<f64> {
    let scale = |(x, name): (&f64, &String)| x * if is_position(name) { positions } else { angles };
    q.iter().zip(names).map(scale).collect()
}

#[test]
fn units_are_checked_as_in_a_recording_and_named_once() {
    let bench = Workbench::new("stream_units");
    let degrees = json!({ "angles": "deg" });
    let numbered = |scale: [f64; 2]| {
        move |frame: usize, q: &[f64], names: &[String]| {
            json!({ "frame": frame,
        "q": scaled(q, names, scale[0], scale[1]) })
        }
    };
    let in_radians = 1_f64.to_radians();
    for (head, scale, expected) in [
        (&degrees, [1.0, 1.0], None),
        (&json!({}), [1.0, 1.0], Some("motion.degrees_as_radians")),
        (&json!({ "angles": "rad" }), [in_radians, 1.0], None),
        (&degrees, [in_radians, 1.0], Some("motion.radians_as_degrees")),
        (&degrees, [1.0, 1000.0], Some("motion.length_unit")),
    ] {
        let (answers, errors) = piped(&bench, changed(&bench, head, numbered(scale)));
        let expected: Vec<&str> = expected.into_iter().chain(["ended"]).collect();
        assert_eq!(notices(&answers), expected, "{errors}");
    }
}

#[test]
fn the_heading_of_a_turning_person_has_no_jump_of_a_whole_turn() {
    let bench = Workbench::new("stream_turns");
    let turned = |wrap: bool| {
        move |frame: usize, q: &[f64], names: &[String]| {
            let mut q = q.to_vec();
            let heading = names.iter().position(|name| name == "pelvis_rotation").unwrap();
            q[heading] += 180.0;
            q[heading] -= if wrap && q[heading] > 180.0 { 360.0 } else { 0.0 };
            json!({ "frame": frame, "q": q })
        }
    };
    let head = json!({ "angles": "deg" });
    let (whole, _) = piped(&bench, changed(&bench, &head, turned(false)));
    let (wrapped, errors) = piped(&bench, changed(&bench, &head, turned(true)));
    assert!(notices(&wrapped).contains(&"motion.unwrapped"), "{errors}");
    for ((frame, expected), (_, found)) in results(&whole).iter().zip(results(&wrapped)) {
        let apart = expected.iter().zip(&found).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 0.01, "frame {frame}: {apart}");
    }
}

#[test]
fn times_in_another_unit_are_read_and_another_rate_is_named_once() {
    let bench = Workbench::new("stream_clock");
    let head = json!({ "angles": "deg" });
    let timed = |step: f64| move |frame: usize, q: &[f64], _: &[String]| json!({ "time": step * frame as f64, "q": q });
    let (seconds, errors) = piped(&bench, changed(&bench, &head, timed(0.01)));
    assert_eq!(notices(&seconds), ["ended"], "{errors}");
    for (step, words) in [(10.0, "milliseconds"), (1e4, "microseconds"), (0.005, "200 Hz"), (0.02, "50 Hz")] {
        let (answers, errors) = piped(&bench, changed(&bench, &head, timed(step)));
        assert_eq!(notices(&answers), ["clock", "ended"], "{errors}");
        assert!(errors.contains(words), "{errors}");
        let least = if step > 1.0 { 278 } else { 130 };
        assert!(results(&answers).len() >= least, "{}", results(&answers).len());
    }
    // A loss is told from another rate once the rate is known.
    let mut lines = changed(&bench, &head, timed(0.01));
    lines.drain(3..5);
    assert_eq!(notices(&piped(&bench, lines).0), ["lost", "ended"]);
}

#[test]
fn a_sender_that_starts_again_loses_no_frame() {
    let bench = Workbench::new("stream_again");
    let again = |frame: usize, q: &[f64], _: &[String]| json!({ "frame": frame % 70, "q": q });
    let (answers, errors) = piped(&bench, changed(&bench, &json!({ "angles": "deg" }), again));
    assert_eq!(notices(&answers), ["restarted", "restarted", "restarted", "ended"], "{errors}");
    let frames: Vec<u64> = results(&answers).iter().map(|(frame, _)| *frame).collect();
    assert_eq!(frames, (0..4).flat_map(|_| 0..70).collect::<Vec<u64>>());
}

#[test]
fn utf_16_and_python_s_numbers_are_read() {
    let bench = Workbench::new("stream_encoding");
    let lines = replay(&bench, FEW);
    let expected = results(&piped(&bench, lines.clone()).0);
    for marks in [[0xff, 0xfe], [0xfe, 0xff]] {
        let wide = |unit: u16| if marks[0] == 0xff { unit.to_le_bytes() } else { unit.to_be_bytes() };
        let bytes = lines.concat().replace('\n', "\r\n");
        let bytes: Vec<u8> = marks.into_iter().chain(bytes.encode_utf16().flat_map(wide)).collect();
        let mut child = started(&bench, &[]);
        child.stdin.take().unwrap().write_all(&bytes).unwrap();
        let output = child.wait_with_output().unwrap();
        let answers = answers(&output.stdout);
        assert_eq!(notices(&answers), ["encoding", "ended"]);
        assert_eq!(results(&answers), expected);
    }
    let missing = |word: &str| {
        let (names, values) = walk(&bench);
        let with = |frame: usize| {
            let line = line(frame, &values[frame]);
            if frame == 9 { line.replacen(&values[9][0].to_string(), word, 1) } else { line }
        };
        [heading(&names)].into_iter().chain((0..FEW).map(with)).collect::<Vec<String>>()
    };
    let null = piped(&bench, missing("null")).0;
    for word in ["NaN", "nan", "-nan"] {
        assert_eq!(piped(&bench, missing(word)).0, null, "{word}");
    }
}

#[test]
fn a_web_page_cannot_feed_the_port_and_a_silent_client_is_released() {
    let bench = Workbench::new("stream_web");
    let lines = replay(&bench, FEW).concat();
    let mut server = started(&bench, &["--input", "tcp:0", "--idle", "0.5"]);
    let address = address(&mut server);
    let mut page = TcpStream::connect(address).unwrap();
    let head = format!("POST / HTTP/1.1\r\nHost: {address}\r\nContent-Length: {}\r\n\r\n", lines.len());
    page.write_all(format!("{head}{lines}").as_bytes()).unwrap();
    let mut received = Vec::new();
    // The connection may be reset, because the frames were not read.
    let _ = page.read_to_end(&mut received);
    assert!(results(&answers(&received)).is_empty());
    let mut silent = TcpStream::connect(address).unwrap();
    silent.write_all(b"{").unwrap();
    received.clear();
    silent.read_to_end(&mut received).unwrap();
    assert_eq!(notices(&answers(&received))[0], "idle");
    let used = answers(&over_tcp(address, lines.into_bytes()));
    assert_eq!(results(&used).len(), FEW);
    server.kill().unwrap();
    server.wait().unwrap();
}

/// Lines of the markers of a C3D: names and unit, then a frame each.
fn marker_lines(recording: &MarkerRecording, axes: &str) -> Vec<String> {
    let names: Vec<&str> = recording.markers.iter().map(|marker| marker.name.as_str()).collect();
    let place = |frame: usize, marker: &MarkerPath| {
        let at = marker.positions[frame] * 1000.0;
        if at.x.is_finite() { json!([at.x, at.y, at.z]) } else { Value::Null }
    };
    let line = |frame: usize| {
        let places: Vec<Value> = recording.markers.iter().map(|marker| place(frame, marker)).collect();
        format!("{}\n", json!({ "frame": frame, "markers": places }))
    };
    let heading = format!("{}\n", json!({ "markers": names, "unit": "mm", "axes": axes }));
    [heading].into_iter().chain((0..recording.frames()).map(line)).collect()
}

#[test]
fn the_markers_of_a_c3d_from_another_process_have_the_forces_of_the_batch() {
    let Some(data) = data() else { return };
    let bench = Workbench::empty("stream_markers").always_removed();
    let file = |name: &str| data.join("biomechzoo-HC032A").join(name).display().to_string();
    let (walk, standing) = (file("HC032A03.c3d"), file("HC032A01.c3d"));
    let batch =
        ["forces", &walk, "--static", &standing, "--predict", "--keep", "tables,model", "--quiet", "-o", "whole"];
    assert_eq!(bench.run(&batch).code, Some(0));
    let (c3d, _) = C3d::read(&std::fs::read(&walk).unwrap()).unwrap();
    let recording = markers_from_c3d(&c3d, &mut Findings::default()).unwrap();
    let rate = recording.rate_hz.to_string();
    let streamed = |lines: Vec<String>| {
        let mut command = bench.command(&["stream", "whole/subject.osim", "--rate", &rate, "--markers"]);
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut input = child.stdin.take().unwrap();
        let sender =
            std::thread::spawn(move || lines.iter().for_each(|line| input.write_all(line.as_bytes()).unwrap()));
        let output = child.wait_with_output().unwrap();
        sender.join().unwrap();
        let errors = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "{errors}");
        (answers(&output.stdout), errors)
    };
    let (answers, errors) = streamed(marker_lines(&recording, "+y,+z"));
    let results = results(&answers);
    assert!(results.len() + 10 > recording.frames(), "{} of {}: {errors}", results.len(), recording.frames());
    let columns: Vec<&str> = answers[0]["columns"].as_array().unwrap().iter().map(|c| c.as_str().unwrap()).collect();
    let whole: Table = bench.table("whole/grf.mot");
    let times = whole.column("time").unwrap();
    for name in ["ground_force_r_vy", "ground_force_l_vy"] {
        let place = columns.iter().position(|column| *column == name).unwrap();
        let expected = whole.column(name).unwrap();
        let (mut squares, mut count, mut largest) = (0.0, 0.0, 0.0_f64);
        for (time, force) in times.iter().zip(expected).filter(|(time, _)| **time > times[0] + 0.8) {
            let frame = ((time - recording.times[0]) * recording.rate_hz).round() as u64;
            let Some((_, values)) = results.iter().find(|(number, _)| *number == frame) else { continue };
            squares += (values[place] - force).powi(2);
            count += 1.0;
            largest = largest.max(values[place]);
        }
        let difference = f64::sqrt(squares / count);
        println!("{name}: {difference:.0} N from the batch over {count} frames, largest {largest:.0} N");
        assert!(count > 100.0 && largest > 400.0 && difference < 60.0, "{name}: {difference}");
    }
    a_frame_that_cannot_be_fitted_ends_no_stream(&recording, &streamed);
}

/// One bad frame costs itself: a frame of hidden markers, at zero or null, and one in which the whole body is
/// elsewhere.
fn a_frame_that_cannot_be_fitted_ends_no_stream(
    recording: &MarkerRecording,
    streamed: &dyn Fn(Vec<String>) -> (Vec<Value>, String),
) {
    const BAD: usize = 100;
    let spoiled = |change: &dyn Fn(&mut MarkerPath)| {
        let mut recording = recording.clone();
        recording.markers.iter_mut().for_each(change);
        streamed(marker_lines(&recording, "+y,+z"))
    };
    let known = results(&streamed(marker_lines(recording, "+y,+z")).0);
    let at_zero = spoiled(&|marker| marker.positions[BAD] *= 0.0);
    let elsewhere = spoiled(&|marker| marker.positions[BAD] *= -3.0);
    for (answers, errors) in [at_zero, elsewhere] {
        assert!(errors.contains("x unfitted"), "{errors}");
        let found = results(&answers);
        let last = |results: &[(u64, Vec<f64>)]| results.last().map(|(frame, _)| *frame);
        assert_eq!(last(&found), last(&known), "{errors}");
        assert!(found.len() + 30 > known.len(), "{} of {}: {errors}", found.len(), known.len());
        // Half a second later the forces are those of an undisturbed stream.
        let later = |results: &[(u64, Vec<f64>)]| {
            results.iter().find(|(frame, _)| *frame == BAD as u64 + 50).map(|(_, values)| values.clone()).unwrap()
        };
        let apart = later(&found).iter().zip(&later(&known)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        println!("{apart:.1} N or N.m from an undisturbed stream");
        assert!(apart < 20.0, "{apart}: {errors}");
    }
}

#[test]
fn frames_of_markers_are_checked_and_missing_markers_survived() {
    let bench = Workbench::new("stream_marker_frames");
    let refused = bench.run(&["stream", "figure.osim", "--rate", "100", "--unit", "mm"]);
    assert!(refused.code == Some(2) && refused.stderr.contains("--markers"), "{}", refused.stderr);
    let axes = bench.run(&["stream", "figure.osim", "--rate", "100", "--markers", "--axes", "+y,-y"]);
    assert!(axes.code == Some(2) && axes.stderr.contains("+y,+z"), "{}", axes.stderr);
    let (answers, _) = piped(&bench, vec!["{\"frame\": 0, \"markers\": [[0, 0, 0]]}\n".to_owned()]);
    assert!(answers[1]["message"].as_str().unwrap().contains("--markers takes markers"), "{answers:?}");
}

/// The address of the live page that the first line names.
fn page_address(child: &mut Child) -> SocketAddr {
    let mut errors = BufReader::new(child.stderr.take().unwrap());
    let mut first = String::new();
    errors.read_line(&mut first).unwrap();
    std::thread::spawn(move || errors.read_to_end(&mut Vec::new()));
    let address =
        first.split("http://").nth(1).and_then(|rest| rest.split('/').next()).unwrap_or_else(|| panic!("{first}"));
    address.parse().unwrap()
}

fn get(address: SocketAddr, path: &str) -> TcpStream {
    let mut link = TcpStream::connect(address).unwrap();
    link.set_read_timeout(Some(HANGS)).unwrap();
    write!(link, "GET {path} HTTP/1.1\r\nHost: {address}\r\n\r\n").unwrap();
    link
}

#[test]
fn the_live_page_gets_the_results_and_an_idle_browser_changes_none() {
    let bench = Workbench::new("stream_page");
    let lines = replay(&bench, FEW);
    let (without, _) = piped(&bench, lines.clone());
    let mut child = started(&bench, &["--page"]);
    let mut input = child.stdin.take().unwrap();
    let address = page_address(&mut child);
    let mut page = String::new();
    get(address, "/").read_to_string(&mut page).unwrap();
    assert!(page.starts_with("HTTP/1.1 200 OK") && page.contains("id=\"ambulo-live\""), "{}", &page[..200]);
    let _idle = get(address, "/events");
    let mut events = BufReader::new(get(address, "/events")).lines().map(Result::unwrap);
    let mut data = |kind: &str| {
        let is_kind = |line: &String| *line == format!("event: {kind}");
        events.by_ref().find(is_kind).unwrap();
        serde_json::from_str::<Value>(events.next().unwrap().strip_prefix("data: ").unwrap()).unwrap()
    };
    assert_eq!(data("state")["state"], "waiting");
    let in_use = bench.run(&[&STREAM[..], &[&format!("--page={}", address.port())]].concat());
    in_use.refused(&["page port", "is in use by another program"]);
    let sender = std::thread::spawn(move || lines.iter().for_each(|line| input.write_all(line.as_bytes()).unwrap()));
    assert_eq!(data("state")["state"], "running");
    let output = child.wait_with_output().unwrap();
    sender.join().unwrap();
    assert_eq!(answers(&output.stdout), without, "the page changes no result");
    let shown = data("frame");
    let expected = results(&without).into_iter().find(|(frame, _)| Some(*frame) == shown["frame"].as_u64()).unwrap();
    let values: Vec<f64> = shown["values"].as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect();
    assert_eq!(values, expected.1);
    assert_eq!(shown["poses"].as_array().unwrap().len() % 7, 0);
    assert_eq!(data("state")["state"], "ended");
}
