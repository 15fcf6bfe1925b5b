//! What `ambulo stream` costs from end to end: `cargo xtask stream-cost [--seconds S] [--hours H]`.
//!
//! The motion is a recorded walk (`opensim-rajagopal-walk` of the data folder: 41 markers, fitted by `ambulo forces`,
//! 200 Hz), repeated forwards and backwards without a jump. The command runs as another process and waits on a TCP port
//! of this computer; frames and results are lines of JSON.
//!
//! | part      | printed                                                                                                     |
//! |-----------|-------------------------------------------------------------------------------------------------------------|
//! | paced     | frames in real time: how much later than the chosen delay each result arrives; processor time per frame     |
//! | `--hours` | so many hours of motion as fast as they are taken: resident memory every ten minutes of motion              |
//!
//! The latency of frame k is the time from sending frame k + d until its result is here, where d is the delay in
//! frames. It contains both ways through the system and the scheduling of three threads.

use crate::sweep::optimised_program;
use crate::workspace;
use std::fmt::Write as _;
use std::fs;
use std::io::{BufRead, BufReader, BufWriter, Write};
use std::net::{Shutdown, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle, sleep};
use std::time::{Duration, Instant};

const FOLDER: &str = "data/opensim-rajagopal-walk";
const MARKERS: &str = "markers_walk.trc";
const MODEL: &str = "subject_walk_scaled.osim";
const RATE_HZ: usize = 200;
/// Required of the 99th percentile of the latency, and of the processor time per frame [ms].
const REQUIRED_LATENCY_MS: f64 = 8.0;
const REQUIRED_COST_MS: f64 = 1.0;
/// Memory is printed after so many frames: ten minutes of motion.
const FRAMES_BETWEEN: usize = 600 * RATE_HZ;
/// The window is full and everything was allocated once.
const WARM_FRAMES: usize = 10 * RATE_HZ;
/// The unit of the times in `/proc/PID/stat` [s], as for `batch-cost`.
const TICK_S: f64 = 0.01;

/// Options of the command.
struct Options {
    seconds: f64,
    hours: f64,
}

/// Measures and prints.
#[expect(clippy::print_stdout, reason = "the figures are the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let options = options(words)?;
    let program = optimised_program()?;
    let walk = Walk::new(&program)?;
    println!("{} coordinates in a frame, {RATE_HZ} Hz, lines of JSON over TCP", walk.coordinates);
    println!("{}", paced(&program, &walk, (options.seconds * RATE_HZ as f64) as usize)?);
    if options.hours > 0.0 {
        println!("{}", unpaced(&program, &walk, (options.hours * 3600.0 * RATE_HZ as f64) as usize)?);
    }
    Ok(())
}

fn options(words: &[String]) -> Result<Options, String> {
    let mut options = Options { seconds: 60.0, hours: 0.0 };
    for pair in words.chunks(2) {
        let number = pair.get(1).and_then(|word| word.parse().ok()).filter(|number| (0.0..=1e5).contains(number));
        match (pair[0].as_str(), number) {
            ("--seconds", Some(seconds)) => options.seconds = seconds,
            ("--hours", Some(hours)) => options.hours = hours,
            _ => return Err(format!("found `{}`; expected --seconds S and --hours H", pair.join(" "))),
        }
    }
    Ok(options)
}

/// The recorded walk as lines of a stream.
struct Walk {
    model: PathBuf,
    coordinates: usize,
    heading: String,
    /// Values of each frame, as the text between the brackets.
    frames: Vec<String>,
}

impl Walk {
    /// Fits the markers of the recording with `ambulo forces`.
    fn new(program: &Path) -> Result<Walk, String> {
        let folder = workspace::data().join(FOLDER);
        let output = workspace::target().join("stream-cost");
        let model = folder.join(MODEL);
        let mut forces = Command::new(program);
        forces.arg("forces").arg(folder.join(MARKERS)).arg("--model").arg(&model);
        forces.args(["--rate", &RATE_HZ.to_string(), "--keep", "tables", "--quiet", "-o"]).arg(&output);
        let done = forces.stdout(Stdio::null()).status().map_err(|e| format!("ambulo: cannot start: {e}"))?;
        if !done.success() {
            return Err(format!("`ambulo forces` on {} ended with {done}", folder.join(MARKERS).display()));
        }
        let table = output.join("kinematics.mot");
        let text = fs::read_to_string(&table).map_err(|e| format!("{}: cannot be read: {e}", table.display()))?;
        let mut lines = text.lines().skip_while(|line| line.trim() != "endheader").skip(1);
        let names: Vec<&str> = lines.next().unwrap_or_default().split_whitespace().skip(1).collect();
        let values = |line: &str| line.split_whitespace().skip(1).collect::<Vec<&str>>().join(",");
        let mut frames: Vec<String> = lines.map(values).collect();
        let back: Vec<String> = frames.iter().rev().skip(1).take(frames.len().saturating_sub(2)).cloned().collect();
        frames.extend(back);
        if names.is_empty() || frames.is_empty() {
            return Err(format!("{}: expected coordinates over time", table.display()));
        }
        let heading = format!("{{\"coordinates\": [\"{}\"], \"angles\": \"deg\"}}\n", names.join("\", \""));
        Ok(Walk { model, coordinates: names.len(), heading, frames })
    }

    fn line(&self, frame: usize) -> String {
        format!("{{\"frame\": {frame}, \"q\": [{}]}}\n", self.frames[frame % self.frames.len()])
    }

    fn frames(&self, count: usize) -> impl Iterator<Item = String> {
        (0..count).map(|frame| self.line(frame))
    }
}

/// The command, waiting for frames on a port of this computer.
struct Server {
    process: Child,
    address: String,
}

impl Server {
    fn start(program: &Path, walk: &Walk) -> Result<Server, String> {
        let mut command = Command::new(program);
        command.arg("stream").arg(&walk.model).args(["--rate", &RATE_HZ.to_string(), "--input", "tcp:0"]);
        let mut process =
            command.stderr(Stdio::piped()).spawn().map_err(|e| format!("ambulo stream: cannot start: {e}"))?;
        let errors = process.stderr.take().ok_or("ambulo stream: no standard error")?;
        let mut errors = BufReader::new(errors).lines();
        let mut said = String::new();
        let address = loop {
            let Some(Ok(line)) = errors.next() else { return Err(format!("ambulo stream: no port\n{said}")) };
            match line.split_whitespace().find(|word| word.starts_with("127.0.0.1:")) {
                Some(address) => break address.to_owned(),
                None => _ = writeln!(said, "{line}"),
            }
        };
        // A full pipe would stop the command.
        thread::spawn(move || errors.for_each(drop));
        Ok(Server { process, address })
    }

    fn connect(&self) -> Result<TcpStream, String> {
        let link = TcpStream::connect(&self.address).map_err(|e| format!("{}: {e}", self.address))?;
        link.set_nodelay(true).map_err(|e| format!("{}: {e}", self.address))?;
        Ok(link)
    }

    /// Resident memory now [kB].
    fn memory_kb(&self) -> f64 {
        let status = fs::read_to_string(format!("/proc/{}/status", self.process.id())).unwrap_or_default();
        let of = |line: &str| line.strip_prefix("VmRSS:")?.trim().strip_suffix("kB")?.trim().parse().ok();
        status.lines().find_map(of).unwrap_or(f64::NAN)
    }

    /// Processor time so far [s]: fields 14 and 15 of `/proc/PID/stat` (`man proc_pid_stat`).
    fn processor_s(&self) -> f64 {
        let text = fs::read_to_string(format!("/proc/{}/stat", self.process.id())).unwrap_or_default();
        let rest = text.rsplit_once(')').map_or("", |(_, rest)| rest);
        let ticks: f64 = rest.split_whitespace().skip(11).take(2).filter_map(|field| field.parse::<f64>().ok()).sum();
        ticks * TICK_S
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// Sends lines in the background; calls back before each.
fn send(
    link: &TcpStream,
    lines: Vec<String>,
    mut before: impl FnMut(usize) + Send + 'static,
) -> Result<JoinHandle<()>, String> {
    let mut output = BufWriter::new(link.try_clone().map_err(|e| e.to_string())?);
    Ok(thread::spawn(move || {
        for (place, line) in lines.iter().enumerate() {
            before(place);
            // The reader reports a connection that has ended.
            let sent = output.write_all(line.as_bytes()).and_then(|()| output.flush());
            if sent.is_err() {
                return;
            }
        }
        let _ = output.get_ref().shutdown(Shutdown::Write);
    }))
}

/// The number of a result; `None` for descriptions and notices.
fn result_number(line: &str) -> Option<usize> {
    line.strip_prefix("{\"frame\":")?.split(',').next()?.trim().parse().ok()
}

/// The delay in the description of a stream [frames].
fn delay_of(description: &str) -> Option<usize> {
    let (_, rest) = description.split_once("\"delay_frames\":")?;
    rest.split([',', '}']).next()?.trim().parse().ok()
}

/// Frames in real time.
fn paced(program: &Path, walk: &Walk, frames: usize) -> Result<String, String> {
    let server = Server::start(program, walk)?;
    let link = server.connect()?;
    let sent = Arc::new(Mutex::new(Vec::with_capacity(frames)));
    let lines: Vec<String> = std::iter::once(walk.heading.clone()).chain(walk.frames(frames)).collect();
    let begin = Instant::now() + Duration::from_millis(200);
    let times = Arc::clone(&sent);
    let sender = send(&link, lines, move |place| {
        // The first line has the names.
        let Some(frame) = place.checked_sub(1) else { return };
        let due = begin + Duration::from_secs_f64(frame as f64 / RATE_HZ as f64);
        sleep(due.saturating_duration_since(Instant::now()));
        if let Ok(mut times) = times.lock() {
            times.push(Instant::now());
        }
    })?;
    let mut delay = None;
    let mut latencies_ms = Vec::with_capacity(frames);
    let mut results = 0;
    let mut processor_s = [0.0; 2];
    let mut memory_kb = [0.0; 2];
    for line in BufReader::new(&link).lines() {
        let line = line.map_err(|e| format!("results cannot be read: {e}"))?;
        let now = Instant::now();
        delay = delay.or_else(|| delay_of(&line));
        let (Some(frame), Some(delay)) = (result_number(&line), delay) else { continue };
        results += 1;
        let last = sent.lock().ok().and_then(|sent| sent.get(frame + delay).copied());
        latencies_ms.extend(last.map(|sent| 1e3 * (now - sent).as_secs_f64()));
        let at = if frame <= WARM_FRAMES { 0 } else { 1 };
        if frame == WARM_FRAMES || frame + delay + 1 == frames {
            (processor_s[at], memory_kb[at]) = (server.processor_s(), server.memory_kb());
        }
    }
    sender.join().map_err(|_| "the sender failed")?;
    if results != frames {
        return Err(format!("{results} results of {frames} frames"));
    }
    let counted = frames.saturating_sub(WARM_FRAMES + delay.unwrap_or(0)).max(1);
    let cost_ms = 1e3 * (processor_s[1] - processor_s[0]) / counted as f64;
    Ok(report(&mut latencies_ms, cost_ms, memory_kb))
}

fn report(latencies_ms: &mut [f64], cost_ms: f64, memory_kb: [f64; 2]) -> String {
    latencies_ms.sort_by(f64::total_cmp);
    let rank = |share: f64| latencies_ms[((latencies_ms.len() - 1) as f64 * share) as usize];
    let met = |found: f64, required: f64| if found <= required { "met" } else { "missed" };
    let mut text = format!(
        "latency beyond the delay  median {:.2} ms, 99th percentile {:.2} ms, longest {:.2} ms, {} frames in real time",
        rank(0.5),
        rank(0.99),
        rank(1.0),
        latencies_ms.len()
    );
    let _ = write!(
        text,
        "; required of the 99th percentile at most {REQUIRED_LATENCY_MS} ms: {}",
        met(rank(0.99), REQUIRED_LATENCY_MS)
    );
    let _ = write!(
        text,
        "\nprocessor time            {cost_ms:.2} ms per frame after the first {} s; required at most \
         {REQUIRED_COST_MS} ms: {}",
        WARM_FRAMES / RATE_HZ,
        met(cost_ms, REQUIRED_COST_MS)
    );
    let _ = write!(text, "\nresident memory           {:.0} kB then, {:.0} kB at the end", memory_kb[0], memory_kb[1]);
    text
}

/// Many frames as fast as they are taken.
fn unpaced(program: &Path, walk: &Walk, frames: usize) -> Result<String, String> {
    let server = Server::start(program, walk)?;
    let link = server.connect()?;
    let mut output = BufWriter::new(link.try_clone().map_err(|e| e.to_string())?);
    let (heading, repeated) = (walk.heading.clone(), walk.frames.clone());
    let sender = thread::spawn(move || {
        let sent = output.write_all(heading.as_bytes()).and_then(|()| {
            (0..frames).try_for_each(|frame| {
                writeln!(output, "{{\"frame\": {frame}, \"q\": [{}]}}", repeated[frame % repeated.len()])
            })
        });
        // The reader reports a connection that has ended.
        let _ = sent.and_then(|()| output.flush()).and_then(|()| output.get_ref().shutdown(Shutdown::Write));
    });
    let mut text = String::new();
    let (mut results, mut last) = (0, (Instant::now(), server.processor_s()));
    for line in BufReader::new(&link).lines() {
        let line = line.map_err(|e| format!("results cannot be read: {e}"))?;
        if result_number(&line).is_none() {
            continue;
        }
        results += 1;
        if results == WARM_FRAMES {
            let _ = write!(
                text,
                "resident memory           {:.0} kB after {} s of motion",
                server.memory_kb(),
                results / RATE_HZ
            );
        }
        if results % FRAMES_BETWEEN == 0 {
            let now = (Instant::now(), server.processor_s());
            let cost_ms = 1e3 * (now.1 - last.1) / FRAMES_BETWEEN as f64;
            let speed = FRAMES_BETWEEN as f64 / RATE_HZ as f64 / (now.0 - last.0).as_secs_f64();
            last = now;
            let minutes = results / (60 * RATE_HZ);
            let _ = write!(
                text,
                "\n                          {:.0} kB after {minutes} min of motion, {cost_ms:.2} ms of processor time \
                 per frame, {speed:.1} times real time",
                server.memory_kb()
            );
        }
    }
    sender.join().map_err(|_| "the sender failed")?;
    if results == frames { Ok(text) } else { Err(format!("{results} results of {frames} frames")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_told_from_descriptions_and_notices() {
        let description = "{\"model\":\"m\",\"rate_hz\":200.0,\"delay_frames\":14,\"coordinates\":[]}";
        assert_eq!((delay_of(description), result_number(description)), (Some(14), None));
        assert_eq!(result_number("{\"frame\":71,\"time\":0.355,\"values\":[1.0]}"), Some(71));
        assert_eq!(result_number("{\"notice\":\"lost\",\"frame\":20,\"message\":\"frame 20\"}"), None);
    }

    #[test]
    fn only_numbers_of_seconds_and_hours_are_options() {
        let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<String>>();
        let found = options(&words("--hours 0.5 --seconds 3")).unwrap();
        assert!((found.hours - 0.5).abs() < 1e-12 && (found.seconds - 3.0).abs() < 1e-12);
        for wrong in ["--hours", "--hours x", "--days 1", "--seconds -1"] {
            assert!(options(&words(wrong)).is_err(), "{wrong}");
        }
    }
}
