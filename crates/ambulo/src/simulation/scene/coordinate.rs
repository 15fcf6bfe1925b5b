//! What acts along a motion that a joint leaves: springs, limits, motors, drives.

use super::SceneError;
use super::body::BodyEntry;
use super::function::{self, Purpose, TimeFunction};
use super::joint::JointAxes;
use crate::toml_reader::{Table, Value};

/// One motion that a joint leaves. Angles [rad] and moments [N.m], or lengths [m] and forces [N].
#[derive(Debug, Clone, PartialEq)]
pub struct CoordinateEntry {
    /// Line of its header; the joint's where it has none.
    pub line: usize,
    /// Turn or slide.
    pub kind: CoordinateKind,
    /// What its value is called at the start, where the bodies stand as their positions say. Without meaning if `drive`
    /// is: then it is the drive's value at time zero.
    pub start: f64,
    /// Its rate at the start [rad/s or m/s]. Without meaning if the child's own velocity is given, or if `drive` is: then
    /// it is the drive's rate at time zero.
    pub rate: f64,
    /// A spring and damper.
    pub spring: Option<Spring>,
    /// How far it goes.
    pub limits: Option<Limits>,
    /// A proportional and derivative controller; never beside `drive`.
    pub motor: Option<MotorEntry>,
    /// A prescribed motion; its multiplier is the actuator's moment or force.
    pub drive: Option<DriveEntry>,
    /// Largest moment or force of dry friction [N.m or N].
    pub friction: f64,
}

/// Whether a coordinate turns or slides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CoordinateKind {
    /// An angle [rad].
    Rotation,
    /// A length [m].
    Translation,
}

/// Moment or force -stiffness (value - rest) - damping rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// [N.m/rad or N/m], zero or more.
    pub stiffness: f64,
    /// [N.m.s/rad or N.s/m], zero or more.
    pub damping: f64,
    /// Value without force.
    pub rest: f64,
}

/// Lower is below upper, and the start between them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Minus infinity if there is none.
    pub lower: f64,
    /// Infinity if there is none.
    pub upper: f64,
}

/// Moment or force stiffness (target - value) + damping (target's rate - rate), cut at `max`.
#[derive(Debug, Clone, PartialEq)]
pub struct MotorEntry {
    /// Where it wants to be.
    pub target: TimeFunction,
    /// [N.m/rad or N/m], zero or more.
    pub stiffness: f64,
    /// [N.m.s/rad or N.s/m], zero or more.
    pub damping: f64,
    /// Largest moment or force [N.m or N]; infinity if not limited.
    pub max: f64,
}

/// A prescribed motion.
#[derive(Debug, Clone, PartialEq)]
pub struct DriveEntry {
    /// Value over time.
    pub function: TimeFunction,
    /// Largest moment or force [N.m or N]; infinity if not limited.
    pub max: f64,
}

pub(super) const KEYS: &[&str] = &[
    "start_deg",
    "start",
    "rate_deg",
    "rate",
    "spring",
    "limits",
    "motor",
    "drive_deg",
    "drive",
    "drive_max",
    "friction",
];

impl CoordinateKind {
    /// Reads a plain value: `key_deg` or `key` for a turn, `key` for a slide.
    fn value(self, table: &Table<'_>, key: &str) -> Result<Option<f64>, SceneError> {
        if self == CoordinateKind::Rotation {
            return table.angle(key);
        }
        if let Some(value) = table.get(&format!("{key}_deg")) {
            return Err(value.wrong(&format!("`{key}` in metres")).hint("this coordinate slides, it does not turn"));
        }
        table.get(key).map(|value| value.number()).transpose()
    }

    fn purpose(self, duration_s: f64) -> Purpose {
        Purpose { duration_s, angle: self == CoordinateKind::Rotation }
    }
}

impl CoordinateEntry {
    /// All coordinates of a joint; those that the file leaves out are free.
    pub(super) fn read_all(
        joint: &Table<'_>,
        kind: JointAxes,
        child: &BodyEntry,
        duration_s: f64,
    ) -> Result<Vec<CoordinateEntry>, SceneError> {
        let kinds = kind.coordinates();
        let tables = joint.tables("coordinate")?;
        if let Some(table) = tables.get(kinds.len()) {
            let found = format!("found coordinate {}; expected at most {}", kinds.len() + 1, kinds.len());
            return Err(table.wrong(found).hint("docs/SCENES.md tells which motions each kind of joint leaves"));
        }
        let read = |(i, kind): (usize, &CoordinateKind)| match tables.get(i) {
            Some(table) => CoordinateEntry::read(table, *kind, child, duration_s),
            None => Ok(CoordinateEntry::free(joint.line, *kind)),
        };
        kinds.iter().enumerate().map(read).collect()
    }

    fn free(line: usize, kind: CoordinateKind) -> CoordinateEntry {
        let (spring, limits, motor, drive) = (None, None, None, None);
        CoordinateEntry { line, kind, start: 0.0, rate: 0.0, spring, limits, motor, drive, friction: 0.0 }
    }

    fn read(
        table: &Table<'_>,
        kind: CoordinateKind,
        child: &BodyEntry,
        duration_s: f64,
    ) -> Result<CoordinateEntry, SceneError> {
        table.only(&[KEYS])?;
        let coordinate = CoordinateEntry::read_acting(table, kind, true, duration_s)?;
        refuse_rates_twice(table, child)?;
        Ok(coordinate)
    }

    /// Reads the keys of a coordinate; other keys are not looked at. Limits must hold the start if it is known.
    pub(super) fn read_acting(
        table: &Table<'_>,
        kind: CoordinateKind,
        start_is_known: bool,
        duration_s: f64,
    ) -> Result<CoordinateEntry, SceneError> {
        let drive = drive(table, kind, duration_s)?;
        refuse_beside_drive(table, drive.is_some())?;
        let start = kind.value(table, "start")?.unwrap_or(0.0);
        let unchecked = drive.is_some() || !start_is_known;
        Ok(CoordinateEntry {
            line: table.line,
            kind,
            start,
            rate: kind.value(table, "rate")?.unwrap_or(0.0),
            spring: table.get("spring").map(|value| spring(&value, kind)).transpose()?,
            limits: table.get("limits").map(|value| limits(&value, kind, start, unchecked)).transpose()?,
            motor: table.get("motor").map(|value| motor(&value, kind, duration_s)).transpose()?,
            drive,
            friction: table.zero_or_more_or("friction", 0.0)?,
        })
    }
}

/// What is said twice could contradict itself.
fn refuse_beside_drive(table: &Table<'_>, driven: bool) -> Result<(), SceneError> {
    let keys = ["start_deg", "start", "rate_deg", "rate", "motor"];
    match keys.iter().find_map(|key| table.get(key)).filter(|_| driven) {
        Some(value) => {
            let expected = "no such key beside a drive";
            Err(value.wrong(expected).hint("the drive's own value and rate at time zero hold"))
        }
        None => Ok(()),
    }
}

fn refuse_rates_twice(table: &Table<'_>, child: &BodyEntry) -> Result<(), SceneError> {
    let own = child.velocity.is_some() || child.angular_velocity.is_some();
    match ["rate_deg", "rate"].iter().find_map(|key| table.get(key)).filter(|_| own) {
        Some(value) => {
            let expected = format!("no rate, as body \"{}\" has its own velocity (line {})", child.name, child.line);
            Err(value.wrong(&expected).hint("take one of them away"))
        }
        None => Ok(()),
    }
}

fn drive(table: &Table<'_>, kind: CoordinateKind, duration_s: f64) -> Result<Option<DriveEntry>, SceneError> {
    let function = function::either_unit(table, "drive", kind.purpose(duration_s))?;
    let max = table.above_zero_or("drive_max", f64::INFINITY)?;
    match (function, table.get("drive_max")) {
        (None, Some(_)) => Err(table.missing("drive", "the motion that `drive_max` limits")),
        (function, _) => Ok(function.map(|function| DriveEntry { function, max })),
    }
}

fn spring(value: &Value<'_>, kind: CoordinateKind) -> Result<Spring, SceneError> {
    let table = value.table("{ stiffness = …, damping = 0, rest_deg = 0 }")?;
    table.only(&[&["stiffness", "damping", "rest_deg", "rest"]])?;
    if table.get("stiffness").is_none() && table.get("damping").is_none() {
        return Err(table.missing("stiffness", "a stiffness or a damping"));
    }
    Ok(Spring {
        stiffness: table.zero_or_more_or("stiffness", 0.0)?,
        damping: table.zero_or_more_or("damping", 0.0)?,
        rest: kind.value(&table, "rest")?.unwrap_or(0.0),
    })
}

fn limits(value: &Value<'_>, kind: CoordinateKind, start: f64, unchecked: bool) -> Result<Limits, SceneError> {
    let table = value.table("{ lower_deg = …, upper_deg = … }")?;
    table.only(&[&["lower_deg", "lower", "upper_deg", "upper"]])?;
    let (lower, upper) = (kind.value(&table, "lower")?, kind.value(&table, "upper")?);
    if lower.is_none() && upper.is_none() {
        return Err(value.wrong("a lower limit, an upper limit, or both"));
    }
    let limits = Limits { lower: lower.unwrap_or(f64::NEG_INFINITY), upper: upper.unwrap_or(f64::INFINITY) };
    if limits.lower >= limits.upper {
        return Err(value.wrong("a lower limit below the upper one"));
    }
    if !unchecked && !(limits.lower..=limits.upper).contains(&start) {
        let error = value.wrong("limits around the value at the start");
        return Err(
            error.hint("`start_deg` (or `start`) says what the value is called where the bodies stand; default 0")
        );
    }
    Ok(limits)
}

fn motor(value: &Value<'_>, kind: CoordinateKind, duration_s: f64) -> Result<MotorEntry, SceneError> {
    let table = value.table("{ target_deg = …, stiffness = …, damping = 0 }")?;
    table.only(&[&["target_deg", "target", "stiffness", "damping", "max"]])?;
    let target = function::either_unit(&table, "target", kind.purpose(duration_s))?;
    let key = if kind == CoordinateKind::Rotation { "target_deg" } else { "target" };
    Ok(MotorEntry {
        target: target.ok_or_else(|| table.missing(key, "where the motor wants to be"))?,
        stiffness: table
            .need("stiffness", "the moment for each radian, or the force for each metre")?
            .zero_or_more()?,
        damping: table.zero_or_more_or("damping", 0.0)?,
        max: table.above_zero_or("max", f64::INFINITY)?,
    })
}
