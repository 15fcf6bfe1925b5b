//! MuJoCo as a child process that makes one step at a time: `walk_mujoco.py`, which has the protocol.

use super::figure::Dynamics;
use ambulo::simulation::Motor;
use serde_json::Value;
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// A figure in MuJoCo.
pub(super) struct MuJoCo {
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
    /// Number of coordinates.
    size: usize,
    /// Version and settings of solver and contact.
    pub(super) settings: Value,
    /// Of its figure at the start.
    pub(super) dynamics: Dynamics,
}

/// What it answers after a step.
pub(super) struct Answer {
    pub(super) time_s: f64,
    /// Value and rate of every coordinate.
    pub(super) now: Vec<[f64; 2]>,
    /// Vertical force on the right and the left foot in the step [N].
    pub(super) loads_n: [f64; 2],
}

impl MuJoCo {
    /// Starts the program in a state.
    pub(super) fn start(mut command: Command, [q, qd]: &[Vec<f64>; 2]) -> Result<MuJoCo, String> {
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child =
            command.spawn().map_err(|e| format!("{}: cannot start: {e}", command.get_program().display()))?;
        let (Some(input), Some(output)) = (child.stdin.take(), child.stdout.take()) else {
            return Err("a program without pipes".to_owned());
        };
        let (output, size) = (BufReader::new(output), q.len());
        let mut peer = MuJoCo {
            child,
            input,
            output,
            size,
            settings: Value::Null,
            dynamics: Dynamics { inertia: vec![], bias: vec![] },
        };
        peer.settings = peer.line()?;
        peer.send(q.iter().chain(qd).copied())?;
        peer.dynamics = Dynamics { inertia: peer.numbers(size * size)?, bias: peer.numbers(size)? };
        Ok(peer)
    }

    /// Makes one step with motors at the driven coordinates.
    pub(super) fn step(&mut self, motors: &[Option<Motor>]) -> Result<Answer, String> {
        let of = |part: fn(&Motor) -> f64| {
            let motor = move |c: usize| motors.get(c).and_then(Option::as_ref).map_or(0.0, part);
            (0..self.size).map(motor)
        };
        let parts = of(|m| m.kp).chain(of(|m| m.kd)).chain(of(|m| m.target.at(0.0)[0])).chain(of(|m| m.max));
        let parts: Vec<f64> = parts.collect();
        self.send(parts.into_iter())?;
        let numbers = self.numbers(2 * self.size + 3)?;
        let (values, rest) = numbers[1..].split_at(self.size);
        let (rates, loads) = rest.split_at(self.size);
        let now = values.iter().zip(rates).map(|(q, qd)| [*q, *qd]).collect();
        Ok(Answer { time_s: numbers[0], now, loads_n: [loads[0], loads[1]] })
    }

    /// Ends the walk; the time of a step, and whether all states were finite.
    pub(super) fn finish(self) -> Result<Value, String> {
        let MuJoCo { mut child, input, mut output, .. } = self;
        drop(input);
        let mut line = String::new();
        output.read_line(&mut line).map_err(|e| format!("walk_mujoco.py: {e}"))?;
        let status = child.wait().map_err(|e| format!("walk_mujoco.py: {e}"))?;
        serde_json::from_str(&line).map_err(|e| format!("walk_mujoco.py: {status}: cannot read `{}`: {e}", line.trim()))
    }

    fn send(&mut self, numbers: impl Iterator<Item = f64>) -> Result<(), String> {
        let bytes: Vec<u8> = numbers.flat_map(f64::to_le_bytes).collect();
        match self.input.write_all(&bytes).and_then(|()| self.input.flush()) {
            Ok(()) => Ok(()),
            Err(_) => Err(self.ended()),
        }
    }

    fn numbers(&mut self, count: usize) -> Result<Vec<f64>, String> {
        let mut bytes = vec![0; 8 * count];
        match self.output.read_exact(&mut bytes) {
            Ok(()) => Ok(bytes.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect()),
            Err(_) => Err(self.ended()),
        }
    }

    fn line(&mut self) -> Result<Value, String> {
        let mut line = String::new();
        match self.output.read_line(&mut line) {
            Ok(count) if count > 0 => {
                serde_json::from_str(&line).map_err(|e| format!("walk_mujoco.py: cannot read `{}`: {e}", line.trim()))
            }
            _ => Err(self.ended()),
        }
    }

    /// The message when the program has ended early; its own message is on standard error.
    fn ended(&mut self) -> String {
        let status = self.child.wait().map_or_else(|e| e.to_string(), |status| status.to_string());
        format!(
            "walk_mujoco.py ended early ({status}), see above\nhint: xtask/measure/peers/README.md says how to install \
             MuJoCo"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_that_is_not_the_expected_one_is_an_error() {
        let start = [vec![0.0], vec![0.0]];
        let mut other = crate::workspace::cargo();
        other.arg("--version");
        assert!(MuJoCo::start(other, &start).is_err_and(|message| message.contains("cannot read")));
        let missing = MuJoCo::start(Command::new("/nowhere/python"), &start);
        assert!(missing.is_err_and(|message| message.starts_with("/nowhere/python: cannot start")));
    }
}
