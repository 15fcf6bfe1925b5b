//! All tests of all test programs in an order that a seed decides: `cargo xtask check --shuffle SEED`.
//!
//! A test must not depend on what ran before it in its process, on what runs next to it in other processes, or on how
//! busy the machine is. So the tests of each program are shuffled and divided among processes, and as many processes
//! run at a time as there are processors, with as many threads each. Several tests share a process, because some share
//! what is expensive to compute.

use super::children::Children;
use super::lanes::{list, log_of};
use super::programs::Program;
use std::fs::{self, File};
use std::sync::{Mutex, PoisonError};

/// Tests in a process.
const TESTS: usize = 40;

/// Tests of one process.
struct Part {
    number: usize,
    program: Program,
    tests: Vec<String>,
}

/// Runs all tests. The error lists the processes that failed.
pub(super) fn run(seed: u64) -> Result<(), String> {
    let cargos = fs::read_to_string(list()).map_err(|e| format!("{}: {e}", list().display()))?;
    let parts = parts(&Program::of_list(&cargos), seed)?;
    let (count, tests) = (parts.len(), parts.iter().map(|part| part.tests.len()).sum::<usize>());
    let (queue, failures, children) = (Mutex::new(parts.into_iter()), Mutex::new(Vec::new()), Children::new());
    let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                while let Some(part) = next() {
                    let failure = part.run(seed, count, &children);
                    failures.lock().unwrap_or_else(PoisonError::into_inner).extend(failure);
                }
            });
        }
    });
    let failures = failures.into_inner().unwrap_or_else(PoisonError::into_inner);
    report(tests, count, seed, &failures)
}

#[expect(clippy::print_stdout, reason = "the number of tests is the command's result")]
fn report(tests: usize, count: usize, seed: u64, failures: &[String]) -> Result<(), String> {
    if failures.is_empty() {
        println!("{tests} tests in {count} processes passed, shuffled with the seed {seed}");
        return Ok(());
    }
    Err(format!("of {count} processes {} failed with the seed {seed}:\n{}", failures.len(), failures.join("\n")))
}

/// The tests of all programs, shuffled and divided, in shuffled order.
fn parts(programs: &[Program], seed: u64) -> Result<Vec<Part>, String> {
    let mut random = Random(seed);
    let mut parts = Vec::new();
    for program in programs {
        let mut tests = program.tests()?;
        random.shuffle(&mut tests);
        let new = |tests: &[String]| Part { number: 0, program: program.clone(), tests: tests.to_vec() };
        parts.extend(tests.chunks(TESTS).map(new));
    }
    random.shuffle(&mut parts);
    parts.iter_mut().enumerate().for_each(|(i, part)| part.number = i + 1);
    Ok(parts)
}

impl Part {
    /// Runs the tests and prints what happened. Returns what failed.
    #[expect(clippy::print_stdout, reason = "the progress of a command that takes minutes")]
    fn run(&self, seed: u64, count: usize, children: &Children) -> Option<String> {
        let path = log_of(&format!("shuffled {}", self.number));
        let done = File::create(&path).and_then(|log| self.program.run_shuffled(&self.tests, seed, children, &log));
        let output = fs::read_to_string(&path).unwrap_or_default();
        let head = format!("[{}/{count}] {}, {} tests", self.number, self.program.name, self.tests.len());
        // A name that the program does not know would be left out without an error.
        if done.is_ok_and(|done| done) && output.contains(&format!("test result: ok. {} passed;", self.tests.len())) {
            println!("{head}: ok");
            return None;
        }
        println!("{output}{head}: FAILED");
        Some(format!("{head}: {}", path.display()))
    }
}

/// Numbers that look random and are the same for the same seed (SplitMix64, Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// Every order is nearly as likely as every other (Fisher and Yates).
    fn shuffle<T>(&mut self, list: &mut [T]) {
        for i in (1..list.len()).rev() {
            let other = usize::try_from(self.next() % (i as u64 + 1)).unwrap_or(0);
            list.swap(i, other);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_gives_one_order_with_every_entry_in_it() {
        let shuffled = |seed: u64| {
            let mut list: Vec<u32> = (0..50).collect();
            Random(seed).shuffle(&mut list);
            list
        };
        assert_eq!(shuffled(7), shuffled(7));
        assert_ne!(shuffled(7), shuffled(8));
        let mut sorted = shuffled(7);
        sorted.sort_unstable();
        assert_eq!(sorted, (0..50).collect::<Vec<u32>>());
    }
}
