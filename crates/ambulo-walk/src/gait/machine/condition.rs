//! Conditions of transitions, written in words.
//!
//! ```text
//! any  = all { "or" all }            all = one { "and" one }            one = "not" one | "(" any ")" | test
//! test = "after" NUMBER ( "s" | "steps" )                               time or steps since the state was entered
//!      | "time" COMPARISON NUMBER "s"                                   since the machines began
//!      | ( "right" | "left" ) "phase" COMPARISON NUMBER "%"             of the cycle of a foot since its strike
//!      | ( "right" | "left" ) "foot" ( "strikes" | "leaves" | "is" ( "down" | "up" ) )
//!      | "angle" NAME COMPARISON NUMBER "deg"
//!      | "signal" NAME COMPARISON NUMBER
//!      | "machine" NAME "is" ( "done" | NAME )
//!      | "standing"                                                     the figure stands still
//! ```
//!
//! COMPARISON is one of `<`, `<=`, `>`, `>=`; a NAME with spaces is written in single quotes.

use super::definition::MachineInputs;
use crate::model::Side;
use std::fmt;

/// Whether a transition is taken.
#[derive(Debug, Clone, PartialEq)]
pub enum Condition {
    /// The machine has been in its state for this time [s].
    AfterTime(f64),
    /// The figure has made this number of steps since the machine entered its state.
    AfterSteps(f64),
    /// Time since the machines began [s].
    Time(Comparison, f64),
    /// Phase of a foot since its strike, 0 to 1 [cycles].
    Phase(Side, Comparison, f64),
    /// Event or state of a foot.
    Foot(Side, FootEvent),
    /// Angle of a joint of the figure [rad]: clinical sign for a part such as `left knee`, the model's sign for a
    /// coordinate.
    Angle(String, Comparison, f64),
    /// A number from outside.
    Signal(String, Comparison, f64),
    /// A machine is in a state of this name.
    InState(String, String),
    /// A machine is in a state that is marked as done.
    Done(String),
    /// The figure stands still.
    Standing,
    /// The opposite.
    Not(Box<Condition>),
    /// All of these conditions hold.
    All(Vec<Condition>),
    /// At least one of them.
    Any(Vec<Condition>),
}

/// A comparison of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Comparison {
    /// <
    Below,
    /// <=
    AtMost,
    /// \>
    Above,
    /// \>=
    AtLeast,
}

/// Event or state of a foot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FootEvent {
    /// The foot is loaded now and was not before.
    Strikes,
    /// The foot was loaded and is not any more.
    Leaves,
    /// The foot is loaded.
    IsDown,
    /// The foot is not loaded.
    IsUp,
}

const COMPARISONS: [(&str, Comparison); 4] =
    [("<=", Comparison::AtMost), (">=", Comparison::AtLeast), ("<", Comparison::Below), (">", Comparison::Above)];

impl Comparison {
    fn holds(self, number: f64, bound: f64) -> bool {
        match self {
            Comparison::Below => number < bound,
            Comparison::AtMost => number <= bound,
            Comparison::Above => number > bound,
            Comparison::AtLeast => number >= bound,
        }
    }

    fn sign(self) -> &'static str {
        COMPARISONS.iter().find(|(_, own)| *own == self).map_or("", |(sign, _)| sign)
    }
}

/// Text that is not a condition.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("found {found}; expected {expected}")]
pub struct ConditionError {
    /// Token at this place.
    found: String,
    /// Allowed values.
    expected: &'static str,
}

const TESTS: &str =
    "`after`, `time`, `right` or `left` with `foot` or `phase`, `angle`, `signal`, `machine`, `standing`, `not` or `(`";
/// Parentheses and `not` in one another; deeper ones are typing errors.
const DEEPEST: usize = 20;

impl Condition {
    /// Reads a condition.
    ///
    /// # Errors
    /// An error that names the first word that does not fit, and what was expected there.
    pub fn parse(text: &str) -> Result<Condition, ConditionError> {
        let words = words(text)?;
        let mut reader = Reader { words: &words, next: 0 };
        let condition = reader.any(DEEPEST)?;
        match reader.peek() {
            None => Ok(condition),
            Some(_) => Err(reader.wrong("`and`, `or` or the end")),
        }
    }

    /// Whether the condition reads a value that exists only in a simulation: loads on the feet, angles, signals.
    #[must_use]
    pub(crate) fn reads_simulation(&self) -> bool {
        match self {
            Condition::Foot(..) | Condition::Angle(..) | Condition::Signal(..) => true,
            Condition::Not(inner) => inner.reads_simulation(),
            Condition::All(parts) | Condition::Any(parts) => parts.iter().any(Condition::reads_simulation),
            _ => false,
        }
    }

    /// Calls a function with this condition and each one inside it.
    pub fn visit<'c>(&'c self, to: &mut impl FnMut(&'c Condition)) {
        to(self);
        match self {
            Condition::Not(inner) => inner.visit(to),
            Condition::All(parts) | Condition::Any(parts) => parts.iter().for_each(|part| part.visit(to)),
            _ => {}
        }
    }

    /// Whether it is true.
    pub(super) fn holds(&self, inputs: &MachineInputs<'_>) -> bool {
        match self {
            Condition::AfterTime(time_s) => inputs.since_s() >= time_s - HALF_A_STEP_S,
            Condition::AfterSteps(steps) => inputs.steps() >= steps - 1e-9,
            Condition::Time(comparison, time_s) => comparison.holds(inputs.sensed.time_s, *time_s),
            Condition::Phase(side, comparison, phase) => {
                let own = inputs.clock.phase_of(*side).value;
                comparison.holds(own - own.floor(), *phase)
            }
            Condition::Foot(side, event) => {
                let (now, before) = (inputs.sensed.loaded[*side], inputs.sensed.loaded_before[*side]);
                match event {
                    FootEvent::Strikes => now && !before,
                    FootEvent::Leaves => before && !now,
                    FootEvent::IsDown => now,
                    FootEvent::IsUp => !now,
                }
            }
            Condition::Angle(name, comparison, bound) => {
                inputs.angle(name).is_some_and(|angle| comparison.holds(angle, *bound))
            }
            Condition::Signal(name, comparison, bound) => {
                let signal = inputs.sensed.signals.iter().find(|(own, _)| own == name);
                signal.is_some_and(|(_, value)| comparison.holds(*value, *bound))
            }
            Condition::InState(machine, state) => inputs.state(machine) == Some(state),
            Condition::Done(machine) => inputs.is_done(machine),
            Condition::Standing => inputs.clock.stands() && inputs.clock.phase.rate <= 0.0,
            Condition::Not(inner) => !inner.holds(inputs),
            Condition::All(parts) => parts.iter().all(|part| part.holds(inputs)),
            Condition::Any(parts) => parts.iter().any(|part| part.holds(inputs)),
        }
    }
}

/// Half of the step at which machines run in a plan: times are sums of steps, with rounding errors.
const HALF_A_STEP_S: f64 = 5e-4;

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let joined = |f: &mut fmt::Formatter<'_>, parts: &[Condition], word: &str| {
            for (k, part) in parts.iter().enumerate() {
                if k > 0 {
                    write!(f, " {word} ")?;
                }
                match part {
                    Condition::All(_) | Condition::Any(_) => write!(f, "({part})")?,
                    _ => write!(f, "{part}")?,
                }
            }
            Ok(())
        };
        match self {
            Condition::AfterTime(time_s) => write!(f, "after {time_s} s"),
            Condition::AfterSteps(steps) => write!(f, "after {steps} steps"),
            Condition::Time(comparison, time_s) => write!(f, "time {} {time_s} s", comparison.sign()),
            Condition::Phase(side, comparison, phase) => {
                write!(f, "{side} phase {} {} %", comparison.sign(), 100.0 * phase)
            }
            Condition::Foot(side, event) => {
                let word = match event {
                    FootEvent::Strikes => "strikes",
                    FootEvent::Leaves => "leaves",
                    FootEvent::IsDown => "is down",
                    FootEvent::IsUp => "is up",
                };
                write!(f, "{side} foot {word}")
            }
            Condition::Angle(name, comparison, angle) => {
                write!(f, "angle '{name}' {} {} deg", comparison.sign(), angle.to_degrees())
            }
            Condition::Signal(name, comparison, value) => write!(f, "signal '{name}' {} {value}", comparison.sign()),
            Condition::InState(machine, state) => write!(f, "machine '{machine}' is '{state}'"),
            Condition::Done(machine) => write!(f, "machine '{machine}' is done"),
            Condition::Standing => f.write_str("standing"),
            Condition::Not(inner) => match **inner {
                Condition::All(_) | Condition::Any(_) => write!(f, "not ({inner})"),
                _ => write!(f, "not {inner}"),
            },
            Condition::All(parts) => joined(f, parts, "and"),
            Condition::Any(parts) => joined(f, parts, "or"),
        }
    }
}

/// A word, or a name in quotes.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Word {
    text: String,
    quoted: bool,
}

fn words(text: &str) -> Result<Vec<Word>, ConditionError> {
    let mut words = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let (word, after) = if first == '\'' {
            let inside = &rest[1..];
            let end = inside.find('\'').ok_or_else(|| ConditionError {
                found: format!("`{rest}` without a closing quote"),
                expected: "a name in single quotes",
            })?;
            (Word { text: inside[..end].to_owned(), quoted: true }, &inside[end + 1..])
        } else {
            let end = if matches!(first, '(' | ')' | '%') {
                1
            } else if matches!(first, '<' | '>') {
                1 + usize::from(rest[1..].starts_with('='))
            } else {
                let stops = |c: char| c.is_whitespace() || matches!(c, '(' | ')' | '%' | '<' | '>' | '\'');
                rest.find(stops).unwrap_or(rest.len())
            };
            (Word { text: rest[..end].to_owned(), quoted: false }, &rest[end..])
        };
        words.push(word);
        rest = after.trim_start();
    }
    Ok(words)
}

struct Reader<'w> {
    words: &'w [Word],
    next: usize,
}

impl Reader<'_> {
    /// The next word that is not in quotes.
    fn peek(&self) -> Option<&str> {
        self.words.get(self.next).map(|word| word.text.as_str())
    }

    fn wrong(&self, expected: &'static str) -> ConditionError {
        let found = self.peek().map_or_else(|| "the end of the condition".to_owned(), |word| format!("`{word}`"));
        ConditionError { found, expected }
    }

    fn takes(&mut self, word: &str) -> bool {
        let is_next = self.words.get(self.next).is_some_and(|own| !own.quoted && own.text == word);
        self.next += usize::from(is_next);
        is_next
    }

    fn needs(&mut self, word: &'static str) -> Result<(), ConditionError> {
        if self.takes(word) { Ok(()) } else { Err(self.wrong(word)) }
    }

    /// Conditions that are joined by a word.
    fn joined(
        &mut self,
        word: &str,
        make: fn(Vec<Condition>) -> Condition,
        mut one: impl FnMut(&mut Self) -> Result<Condition, ConditionError>,
    ) -> Result<Condition, ConditionError> {
        let first = one(self)?;
        let mut parts = vec![first];
        while self.takes(word) {
            parts.push(one(self)?);
        }
        Ok(if parts.len() == 1 { parts.remove(0) } else { make(parts) })
    }

    fn any(&mut self, depth: usize) -> Result<Condition, ConditionError> {
        self.joined("or", Condition::Any, |reader| reader.joined("and", Condition::All, |reader| reader.one(depth)))
    }

    fn one(&mut self, depth: usize) -> Result<Condition, ConditionError> {
        let Some(deeper) = depth.checked_sub(1) else { return Err(self.wrong("fewer parentheses")) };
        if self.takes("not") {
            return Ok(Condition::Not(Box::new(self.one(deeper)?)));
        }
        if self.takes("(") {
            let inner = self.any(deeper)?;
            self.needs(")")?;
            return Ok(inner);
        }
        self.test()
    }

    fn test(&mut self) -> Result<Condition, ConditionError> {
        if self.takes("after") {
            let number = self.number()?;
            return match () {
                () if self.takes("s") => Ok(Condition::AfterTime(number)),
                () if self.takes("steps") || self.takes("step") => Ok(Condition::AfterSteps(number)),
                () => Err(self.wrong("`s` or `steps`")),
            };
        }
        if self.takes("time") {
            let (comparison, time_s) = (self.comparison()?, self.number()?);
            self.needs("s")?;
            return Ok(Condition::Time(comparison, time_s));
        }
        for side in Side::BOTH {
            if self.takes(&side.to_string()) {
                return self.of_side(side);
            }
        }
        if self.takes("angle") {
            let (name, comparison, angle) = (self.name()?, self.comparison()?, self.number()?);
            self.needs("deg")?;
            return Ok(Condition::Angle(name, comparison, angle.to_radians()));
        }
        if self.takes("signal") {
            return Ok(Condition::Signal(self.name()?, self.comparison()?, self.number()?));
        }
        if self.takes("standing") {
            return Ok(Condition::Standing);
        }
        if self.takes("machine") {
            let name = self.name()?;
            self.needs("is")?;
            return Ok(if self.takes("done") { Condition::Done(name) } else { Condition::InState(name, self.name()?) });
        }
        Err(self.wrong(TESTS))
    }

    fn of_side(&mut self, side: Side) -> Result<Condition, ConditionError> {
        if self.takes("phase") {
            let (comparison, percent) = (self.comparison()?, self.number()?);
            self.needs("%")?;
            return Ok(Condition::Phase(side, comparison, 0.01 * percent));
        }
        if !self.takes("foot") {
            return Err(self.wrong("`foot` or `phase`"));
        }
        let event = match () {
            () if self.takes("strikes") => FootEvent::Strikes,
            () if self.takes("leaves") => FootEvent::Leaves,
            () if self.takes("is") => match () {
                () if self.takes("down") => FootEvent::IsDown,
                () if self.takes("up") => FootEvent::IsUp,
                () => return Err(self.wrong("`down` or `up`")),
            },
            () => return Err(self.wrong("`strikes`, `leaves`, `is down` or `is up`")),
        };
        Ok(Condition::Foot(side, event))
    }

    fn comparison(&mut self) -> Result<Comparison, ConditionError> {
        let found = COMPARISONS.into_iter().find(|(sign, _)| self.takes(sign));
        found.map(|(_, comparison)| comparison).ok_or_else(|| self.wrong("`<`, `<=`, `>` or `>=`"))
    }

    fn number(&mut self) -> Result<f64, ConditionError> {
        let number = self.peek().and_then(|word| word.parse::<f64>().ok()).filter(|number| number.is_finite());
        let number = number.ok_or_else(|| self.wrong("a number"))?;
        self.next += 1;
        Ok(number)
    }

    fn name(&mut self) -> Result<String, ConditionError> {
        let name = self.peek().map(str::to_owned).filter(|name| !name.trim().is_empty());
        let name = name.ok_or_else(|| self.wrong("a name; a name with spaces needs single quotes"))?;
        self.next += 1;
        Ok(name)
    }
}
