//! Floating-point operations and bytes of a kernel, counted instruction by instruction.

use crate::workspace;
use std::collections::BTreeMap;
use std::env;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Passes of the two runs whose difference counts.
const PASSES: [usize; 2] = [1, 3];

/// What a frame needs.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Counts {
    /// Operations in double precision.
    pub(super) operations: f64,
    /// Those among them that are done on vectors.
    in_vectors: f64,
    /// Bytes between registers and memory.
    pub(super) bytes: f64,
}

impl Counts {
    /// Counts a pass of a kernel, over its frames.
    pub(super) fn of_kernel(name: &str, frames: usize) -> Result<Counts, String> {
        let program = env::current_exe().map_err(|e| format!("this program cannot be found: {e}"))?;
        let listing = output(Command::new("objdump").args(["-d", "--no-show-raw-insn"]).arg(&program), "objdump")?;
        let instructions = instructions(&listing);
        let [fewer, more] = PASSES.map(|passes| executions(&program, name, passes));
        let (fewer, more) = (fewer?, more?);
        let mut sum = Counts::default();
        for (address, count) in &more {
            let times = count - fewer.get(address).copied().unwrap_or(0.0);
            let each = instructions.get(address).copied().unwrap_or_default();
            sum.operations += times * each.operations;
            sum.in_vectors += times * each.in_vectors;
            sum.bytes += times * each.bytes;
        }
        if sum.operations <= 0.0 || sum.bytes <= 0.0 {
            return Err(format!(
                "{name}: no operation was counted; callgrind and objdump may number instructions differently"
            ));
        }
        let passes = ((PASSES[1] - PASSES[0]) * frames) as f64;
        Ok(Counts {
            operations: sum.operations / passes,
            in_vectors: sum.in_vectors / passes,
            bytes: sum.bytes / passes,
        })
    }

    pub(super) fn vector_share(&self) -> f64 {
        self.in_vectors / self.operations
    }
}

fn output(command: &mut Command, name: &str) -> Result<String, String> {
    let hint = "hint: install valgrind and binutils";
    let done = command.output().map_err(|e| format!("{name}: cannot start: {e}\n{hint}"))?;
    if !done.status.success() {
        return Err(format!("{name} ended with {}: {}", done.status, String::from_utf8_lossy(&done.stderr)));
    }
    Ok(String::from_utf8_lossy(&done.stdout).into_owned())
}

/// How often each instruction of this program is executed.
fn executions(program: &Path, kernel: &str, passes: usize) -> Result<BTreeMap<u64, f64>, String> {
    let file = workspace::root().join("target").join(format!("roofline-{kernel}-{passes}.out"));
    let mut run = Command::new("valgrind");
    run.args(["--tool=callgrind", "--dump-instr=yes", "--compress-pos=no", "--compress-strings=no"]);
    run.arg(format!("--callgrind-out-file={}", file.display()));
    run.arg(program).args(["roofline", "--kernel", kernel, "--passes", &passes.to_string()]);
    output(&mut run, "valgrind")?;
    let text = fs::read_to_string(&file).map_err(|e| format!("{}: cannot be read: {e}", file.display()))?;
    let own = program.file_name().unwrap_or_default().to_string_lossy().into_owned();
    Ok(read_executions(&text, &own))
}

/// Reads callgrind's file: `ob=` names the program or library that lines belong to, `0xADDRESS LINE COUNT` is an instruction, and the line after
/// `calls=` is the cost of the function that was called, which is counted where it is executed.
fn read_executions(text: &str, program: &str) -> BTreeMap<u64, f64> {
    let mut counts = BTreeMap::new();
    let (mut is_own, mut is_call) = (false, false);
    for line in text.lines() {
        if let Some(object) = line.strip_prefix("ob=") {
            is_own = object.ends_with(program);
        } else if line.starts_with("calls=") {
            is_call = true;
        } else if let Some(cost) = line.strip_prefix("0x") {
            let words: Vec<&str> = cost.split_whitespace().collect();
            if let ([address, _, count], true, false) = (&words[..], is_own, is_call)
                && let (Ok(address), Ok(count)) = (u64::from_str_radix(address, 16), count.parse::<f64>())
            {
                *counts.entry(address).or_insert(0.0) += count;
            }
            is_call = false;
        }
    }
    counts
}

/// The instructions of a listing of `objdump -d`, by address.
fn instructions(listing: &str) -> BTreeMap<u64, Counts> {
    let instruction = |line: &str| {
        let (address, rest) = line.trim().split_once(":\t")?;
        Some((u64::from_str_radix(address, 16).ok()?, counts_of(rest)))
    };
    listing.lines().filter_map(instruction).collect()
}

/// What one instruction does, in the notation of AT&T: `vfmadd213pd 0x10(%rsi),%ymm1,%ymm2`.
fn counts_of(instruction: &str) -> Counts {
    let (mnemonic, operands) = instruction.split_once(char::is_whitespace).unwrap_or((instruction, ""));
    let operands = operands.split('#').next().unwrap_or_default().trim();
    let name = mnemonic.strip_prefix('v').unwrap_or(mnemonic);
    let width = if operands.contains("%zmm") {
        64.0
    } else if operands.contains("%ymm") {
        32.0
    } else {
        16.0
    };
    let is_vector = name.ends_with("pd");
    let lanes = if is_vector { width / 8.0 } else { 1.0 };
    let is_double = is_vector || name.ends_with("sd");
    let per_lane = match name {
        _ if !is_double => 0.0,
        _ if ["fmadd", "fmsub", "fnmadd", "fnmsub"].iter().any(|fused| name.starts_with(fused)) => 2.0,
        _ if ["add", "sub", "mul", "div", "sqrt"].iter().any(|plain| name.starts_with(plain)) => 1.0,
        _ => 0.0,
    };
    let operations = per_lane * lanes;
    let bytes = if reaches_memory(name, operands) { size_of_operand(name, operands, width) } else { 0.0 };
    Counts { operations, in_vectors: if is_vector { operations } else { 0.0 }, bytes }
}

fn reaches_memory(name: &str, operands: &str) -> bool {
    match name {
        "push" | "pop" | "call" | "ret" => true,
        _ => operands.contains('(') && !["lea", "nop", "prefetch"].iter().any(|other| name.starts_with(other)),
    }
}

/// Bytes of the operand in memory.
fn size_of_operand(name: &str, operands: &str, width: f64) -> f64 {
    let is_of_vectors = operands.contains("%xmm") || operands.contains("%ymm") || operands.contains("%zmm");
    match name {
        "push" | "pop" | "call" | "ret" => 8.0,
        _ if is_of_vectors && (name.ends_with("sd") || name.ends_with('q') || name == "movhpd" || name == "movlpd") => {
            8.0
        }
        "movddup" | "movhps" | "movlps" => 8.0,
        _ if is_of_vectors && name.ends_with("ss") => 4.0,
        _ if is_of_vectors => width,
        _ => register_beside(operands).map_or_else(|| size_of_suffix(name), size_of_register),
    }
}

/// The register at the other end of a move or an operation; the operand in memory is as wide. `rax` for `0x8(%rbx,%rcx,8),%rax`.
fn register_beside(operands: &str) -> Option<&str> {
    let (before, rest) = operands.split_once('(')?;
    let (_, after) = rest.split_once(')')?;
    let register = [after, before].into_iter().find_map(|side| side.split_once('%'))?.1;
    Some(register.split(|c: char| !c.is_ascii_alphanumeric()).next().unwrap_or_default())
}

fn size_of_register(register: &str) -> f64 {
    let is_numbered = register.starts_with('r') && register.contains(|c: char| c.is_ascii_digit());
    match register.chars().last() {
        Some('d') if is_numbered => 4.0,
        Some('w') if is_numbered => 2.0,
        Some('b') if is_numbered => 1.0,
        _ if register.starts_with('r') => 8.0,
        _ if register.starts_with('e') => 4.0,
        Some('l' | 'h') if register.len() < 4 => 1.0,
        _ => 2.0,
    }
}

/// Without a register, the last letter of the instruction states the width: `addl $0x1,0x4(%rip)`.
fn size_of_suffix(name: &str) -> f64 {
    match name.chars().last() {
        Some('b') => 1.0,
        Some('w') => 2.0,
        Some('l') => 4.0,
        _ => 8.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Operations, those in vectors, bytes.
    fn counted(instruction: &str) -> String {
        let Counts { operations, in_vectors, bytes } = counts_of(instruction);
        format!("{operations} {in_vectors} {bytes}")
    }

    #[test]
    fn instructions_have_the_operations_of_their_lanes_and_the_bytes_of_their_operand() {
        assert_eq!(counted("mulsd  0x8(%rdi),%xmm1"), "1 0 8");
        assert_eq!(counted("addpd  %xmm2,%xmm1"), "2 2 0");
        assert_eq!(counted("vfmadd231pd 0x20(%rsi),%ymm1,%ymm2"), "8 8 32");
        assert_eq!(counted("vfnmadd213sd %xmm1,%xmm0,%xmm2"), "2 0 0");
        assert_eq!(counted("sqrtsd %xmm0,%xmm0"), "1 0 0");
        assert_eq!(counted("movsd  %xmm0,0x10(%rsp)"), "0 0 8");
        assert_eq!(counted("movupd 0x10(%rdi),%xmm3"), "0 0 16");
        assert_eq!(counted("vmovupd %zmm3,(%rdi)"), "0 0 64");
        assert_eq!(counted("lea    0x8(%rdi),%rax"), "0 0 0");
        assert_eq!(counted("mov    (%rdi),%rax"), "0 0 8");
        assert_eq!(counted("push   %rbx"), "0 0 8");
        assert_eq!(counted("addl   $0x1,0x4(%rip)        # 4010 <x>"), "0 0 4");
        assert_eq!(counted("imul   0x8(%rbx,%rcx,8),%rax"), "0 0 8");
        assert_eq!(counted("mov    %r8d,(%rdi)"), "0 0 4");
        assert_eq!(counted("cmp    %sil,0x10(%rsp)"), "0 0 1");
        assert_eq!(counted("movb   $0x0,(%r12)"), "0 0 1");
        assert_eq!(counted("call   *0x20(%rax)"), "0 0 8");
        // A comparison, a conversion and single precision are no operations of double precision.
        assert_eq!(counted("ucomisd %xmm1,%xmm0"), "0 0 0");
        assert_eq!(counted("cvtsi2sd %rax,%xmm0"), "0 0 0");
        assert_eq!(counted("mulss  %xmm1,%xmm0"), "0 0 0");
    }

    #[test]
    fn calls_and_other_libraries_are_left_out() {
        let text = "events: Ir\nob=/x/xtask-measure\nfn=main\n0x10 0 3\n0x14 5 7\ncalls=1 0x20 0\n0x18 0 100\n0x18 0 1\nob=/lib/libc.so\n0x10 0 50\n";
        let found = read_executions(text, "xtask-measure");
        assert_eq!(found, BTreeMap::from([(0x10, 3.0), (0x14, 7.0), (0x18, 1.0)]));
        let listing = instructions("\n0000 <main>:\n  10:\tmulsd  %xmm1,%xmm0\n  14:\tret\n");
        assert_eq!(listing.keys().copied().collect::<Vec<_>>(), [0x10, 0x14]);
    }
}
