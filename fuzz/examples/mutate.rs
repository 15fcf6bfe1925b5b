//! Changes files of the corpus at random and checks them, with a stable compiler: for those who have no nightly one.
//! `cargo run --release --manifest-path fuzz/Cargo.toml --no-default-features --example mutate -- SECONDS [TARGET]`
//!
//! Each target gets its share of the time. The input under way is in `fuzz/found/TARGET/last`, so that a crash leaves it behind.

use ambulo_fuzz::CHECKS;
use std::error::Error;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

/// Numbers that readers find hard.
const NUMBERS: [&str; 12] = [
    "0",
    "-1",
    "1e308",
    "-1e308",
    "1e-308",
    "NaN",
    "inf",
    "4294967296",
    "-0.0",
    "0.1e-9",
    "99999999999999999999",
    "1e9",
];

/// Slower than this is reported.
const SLOW: Duration = Duration::from_secs(10);

/// The generator of Marsaglia: xorshift with 64 bits.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % limit.max(1) as u64) as usize
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let seconds: f64 = words.first().map_or(Ok(60.0), |word| word.parse())?;
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let chosen: Vec<_> = CHECKS.into_iter().filter(|(name, _)| words.get(1).is_none_or(|word| word == name)).collect();
    for (name, check) in &chosen {
        let folder = here.join("found").join(name);
        fs::create_dir_all(&folder)?;
        let mut seeds = Vec::new();
        for entry in fs::read_dir(here.join("corpus").join(name))? {
            seeds.push(fs::read(entry?.path())?);
        }
        let mut random = Random(0x9e37_79b9_7f4a_7c15);
        let (start, mut count, mut slowest) = (Instant::now(), 0, Duration::ZERO);
        while start.elapsed().as_secs_f64() < seconds / chosen.len() as f64 {
            let bytes = mutated(&seeds[random.below(seeds.len())], &mut random);
            fs::write(folder.join("last"), &bytes)?;
            let one = Instant::now();
            check(&bytes);
            if one.elapsed() > slowest {
                slowest = one.elapsed();
            }
            if one.elapsed() > SLOW {
                fs::write(folder.join(format!("slow-{count}")), &bytes)?;
            }
            count += 1;
        }
        fs::remove_file(folder.join("last"))?;
        println!("{name}: {count} inputs, the slowest {:.3} s", slowest.as_secs_f64());
    }
    Ok(())
}

/// The bytes with one to four changes.
fn mutated(seed: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..=random.below(4) {
        if bytes.is_empty() {
            return bytes;
        }
        let at = random.below(bytes.len());
        match random.below(5) {
            0 => bytes[at] ^= 1 << random.below(8),
            1 => bytes[at] = random.below(256) as u8,
            2 => bytes.truncate(at),
            3 => {
                let piece: Vec<u8> = bytes[at..(at + random.below(40)).min(bytes.len())].to_vec();
                bytes.splice(at..at, piece);
            }
            _ => replace_number(&mut bytes, at, random),
        }
    }
    bytes
}

/// Puts a hard number in the place of the one that follows `at`.
fn replace_number(bytes: &mut Vec<u8>, at: usize, random: &mut Random) {
    let Some(first) = bytes[at..].iter().position(u8::is_ascii_digit).map(|k| at + k) else { return };
    let is_part = |byte: &&u8| byte.is_ascii_digit() || **byte == b'.';
    let last = first + bytes[first..].iter().take_while(is_part).count();
    let number = NUMBERS[random.below(NUMBERS.len())];
    bytes.splice(first..last, number.bytes());
}
