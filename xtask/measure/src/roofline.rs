//! What is left to gain in the three hottest kernels: `cargo xtask roofline`, and with `--write` docs/measured/ROOFLINE.md.
//!
//! The roofline of a kernel: with F floating-point operations and B bytes between registers and memory a frame, no program that does this work
//! is faster than max(F / P, B / W), with P and W what this processor reaches at most, measured here in loops that do nothing else.
//!
//! Operations and bytes are counted, not estimated: this program runs the kernel under valgrind's callgrind, which counts how often each
//! instruction is executed, and `objdump` states what the instruction is. A run with twice as many frames, minus a run with some, leaves out the
//! preparation. Additions, multiplications, divisions and roots of double precision count, each lane of a vector by itself, a fused
//! multiplication and addition as two; the bytes are those of all memory operands, so most of them come from the first cache.
//!
//! Source: Williams, Waterman, Patterson 2009, "Roofline: an insightful visual performance model for multicore architectures" (unverified).

mod counts;
mod peak;

use crate::bench::markers;
use crate::bench::timing::cpu_us;
use crate::bench::{human::Human, machine, worlds};
use crate::workspace;
use ambulo::findings::Findings;
use ambulo::kinematics::marker_fit::{FitSettings, fit_markers};
use ambulo::simulation::{StepSettings, StepWorkspace, WorldState, start, step};
use counts::Counts;
use peak::Peaks;
use std::hint::black_box;

/// Beginning of the page.
const HEAD: &str = "\
# Roofline of the hottest kernels

What one core of this machine does at most, and what the kernels do of it. Operations in double precision and bytes between registers and memory
are counted instruction by instruction (`callgrind`, `objdump`); a fused multiplication and addition is two. The bound is the longer of two times:
all operations at the largest rate of their mix of single numbers and vectors, and all bytes at that of the first cache. What is above 1 in the last
column is spent on what is neither: waiting for results, branches, addresses, and memory beyond the first cache.
";

/// The kernels, as this program is asked to run them.
const KERNELS: [&str; 3] = ["inverse-dynamics", "simulation-step", "marker-fit"];
/// Links of the chain of the simulation.
const LINKS: usize = 100;
/// Steps of one pass of the simulation.
const STEPS: usize = 500;

/// Prints the table, or runs a kernel for the counter.
#[expect(clippy::print_stdout, reason = "the table is the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        [] => {
            print!("{}", page()?);
            Ok(())
        }
        ["--write"] => workspace::save("docs/measured/ROOFLINE.md", &page()?),
        ["--kernel", name, "--passes", passes] => {
            let passes = passes.parse::<usize>().map_err(|e| format!("--passes {passes}: {e}"))?;
            let mut kernel = Kernel::named(name)?;
            (0..passes).try_for_each(|_| (kernel.pass)())
        }
        _ => Err(format!("found `{}`; expected nothing or --write", words.join(" "))),
    }
}

/// Work that is repeated.
struct Kernel {
    about: &'static str,
    /// Frames or steps of a pass.
    frames: usize,
    pass: Box<dyn FnMut() -> Result<(), String>>,
}

impl Kernel {
    fn named(name: &str) -> Result<Kernel, String> {
        match name {
            "inverse-dynamics" => inverse_dynamics(),
            "simulation-step" => simulation_step(),
            "marker-fit" => marker_fit(),
            _ => Err(format!("found the kernel `{name}`; expected one of {}", KERNELS.join(", "))),
        }
    }
}

fn inverse_dynamics() -> Result<Kernel, String> {
    let folder = Human::find().ok_or("the reference human is not there; see AMBULO_DATA in `cargo xtask help`")?;
    let (frames, mut pass) = Human::read(&folder)?.batch();
    let about = "inverse dynamics of the reference human, 37 coordinates, frames side by side; a frame";
    let pass = move || {
        pass();
        Ok(())
    };
    Ok(Kernel { about, frames, pass: Box::new(pass) })
}

fn simulation_step() -> Result<Kernel, String> {
    let world = worlds::chain(LINKS);
    let settings = StepSettings::default();
    let (mut state, mut workspace, mut findings) =
        (WorldState::new(&world), StepWorkspace::default(), Findings::default());
    start(&world, &mut state, &settings.solver, &mut findings).map_err(|e| e.to_string())?;
    let pass = move || {
        (0..STEPS).try_for_each(|_| {
            let done = step(&world, &mut state, &settings, &mut workspace, &mut findings);
            done.map(|_| ()).map_err(|e| e.to_string())
        })
    };
    Ok(Kernel { about: "simulation of a chain of 100 links; a step", frames: STEPS, pass: Box::new(pass) })
}

fn marker_fit() -> Result<Kernel, String> {
    let walk =
        markers::walk()?.ok_or("the recording of Gait2392 is not there; see AMBULO_DATA in `cargo xtask help`")?;
    let (model, markers) = walk;
    let frames = markers.times.len();
    let pass = move || {
        let fit = fit_markers(&model, &markers, &FitSettings::default(), &mut Findings::default());
        fit.map(|fit| drop(black_box(fit))).map_err(|e| e.to_string())
    };
    Ok(Kernel { about: "fit of a skeleton to the markers of Gait2392; a frame", frames, pass: Box::new(pass) })
}

fn page() -> Result<String, String> {
    let peaks = Peaks::measure();
    let mut text = format!("{HEAD}\nMachine: {}.\n\n", machine());
    text += &peaks.description();
    text += "\n| kernel | operations | in vectors | bytes | operations a byte | time | Gflop/s | GB/s | bound by operations, bytes | time / bound |\n";
    text += "|:--|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    for name in KERNELS {
        let mut kernel = Kernel::named(name)?;
        let counts = Counts::of_kernel(name, kernel.frames)?;
        let mut failure = None;
        let time = cpu_us(kernel.frames, || failure = (kernel.pass)().err().or(failure.take()));
        if let Some(message) = failure {
            return Err(message);
        }
        text += &row(kernel.about, &counts, time.fastest(), &peaks);
    }
    Ok(text)
}

/// Times in us: 1e3 operations a us are 1 Gflop/s, 1e3 bytes 1 GB/s.
fn row(about: &str, counts: &Counts, time_us: f64, peaks: &Peaks) -> String {
    let by_operations = counts.operations / (1e3 * peaks.gflops(counts.vector_share()));
    let by_bytes = counts.bytes / (1e3 * peaks.gb_s);
    format!(
        "| {about} | {:.0} | {:.0} % | {:.0} | {:.2} | {time_us:.2} us | {:.2} | {:.1} | {by_operations:.2}, {by_bytes:.2} us | {:.1} |\n",
        counts.operations,
        100.0 * counts.vector_share(),
        counts.bytes,
        counts.operations / counts.bytes,
        counts.operations / (1e3 * time_us),
        counts.bytes / (1e3 * time_us),
        time_us / by_operations.max(by_bytes)
    )
}
