//! Coordinates of joints in a scene file: springs, limits, motors, drives.

use super::SceneError;
use super::body::BodyEntry;
use super::function::{self, Purpose, TimeFunction};
use super::joint_axes::{JointAxes, MotionKind};
use crate::engine::world::Spring;
use crate::toml_reader::{Table, Value};

/// One free motion of a joint: angles [rad] and moments [N.m], or lengths [m] and forces [N].
#[derive(Debug, Clone, PartialEq)]
pub struct CoordinateEntry {
    /// Line of its header, or of the joint's header if it has none.
    pub line: usize,
    /// Rotation or translation.
    pub kind: MotionKind,
    /// The value that belongs to the initial positions of the bodies. Not used with a `drive`, whose value at time zero
    /// it is.
    pub start: f64,
    /// Rate at the start [rad/s or m/s]. Not used if the child's velocity is given, nor with a `drive`, whose rate at
    /// time zero it is.
    pub rate: f64,
    /// A spring and damper.
    pub spring: Option<Spring>,
    /// Range of motion.
    pub limits: Option<Limits>,
    /// A proportional-derivative controller; never together with `drive`.
    pub motor: Option<MotorEntry>,
    /// A prescribed motion; its multiplier is the moment or force of the actuator.
    pub drive: Option<DriveEntry>,
    /// Largest moment or force of dry friction [N.m or N].
    pub friction: f64,
}

/// Range of a coordinate: the lower limit is below the upper one, and the start is between them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Minus infinity if there is none.
    pub lower: f64,
    /// Infinity if there is none.
    pub upper: f64,
}

/// A motor with the moment or force stiffness (target - value) + damping (target's rate - rate), limited to `max`.
#[derive(Debug, Clone, PartialEq)]
pub struct MotorEntry {
    /// Target value over time.
    pub target: TimeFunction,
    /// Stiffness [N.m/rad or N/m], zero or more.
    pub stiffness: f64,
    /// Damping [N.m.s/rad or N.s/m], zero or more.
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

impl MotionKind {
    /// Reads a value: `key_deg` or `key` for a rotation, `key` for a translation.
    fn value(self, table: &Table<'_>, key: &str) -> Result<Option<f64>, SceneError> {
        if self == MotionKind::Rotation {
            return table.angle(key);
        }
        if let Some(value) = table.get(&format!("{key}_deg")) {
            return Err(value.wrong(&format!("`{key}` in metres")).hint("this coordinate is a translation"));
        }
        table.get(key).map(|value| value.number()).transpose()
    }

    fn purpose(self, duration_s: f64) -> Purpose {
        Purpose { duration_s, angle: self == MotionKind::Rotation }
    }
}

impl CoordinateEntry {
    /// Reads all coordinates of a joint; those that are missing in the file are free.
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
            return Err(table.wrong(found).hint("docs/SCENES.md lists the free motions of each kind of joint"));
        }
        let read = |(i, kind): (usize, &MotionKind)| match tables.get(i) {
            Some(table) => CoordinateEntry::read(table, *kind, child, duration_s),
            None => Ok(CoordinateEntry::free(joint.line, *kind)),
        };
        kinds.iter().enumerate().map(read).collect()
    }

    fn free(line: usize, kind: MotionKind) -> CoordinateEntry {
        let (spring, limits, motor, drive) = (None, None, None, None);
        CoordinateEntry { line, kind, start: 0.0, rate: 0.0, spring, limits, motor, drive, friction: 0.0 }
    }

    fn read(
        table: &Table<'_>,
        kind: MotionKind,
        child: &BodyEntry,
        duration_s: f64,
    ) -> Result<CoordinateEntry, SceneError> {
        table.only(&[KEYS])?;
        let coordinate = CoordinateEntry::read_acting(table, kind, true, duration_s)?;
        refuse_rates_twice(table, child)?;
        Ok(coordinate)
    }

    /// Reads the keys of a coordinate and ignores other keys. The start must be within the limits if it is known.
    pub(super) fn read_acting(
        table: &Table<'_>,
        kind: MotionKind,
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

/// Rejects keys that could contradict a drive.
fn refuse_beside_drive(table: &Table<'_>, driven: bool) -> Result<(), SceneError> {
    let keys = ["start_deg", "start", "rate_deg", "rate", "motor"];
    match keys.iter().find_map(|key| table.get(key)).filter(|_| driven) {
        Some(value) => {
            let expected = "no such key together with a drive";
            Err(value.wrong(expected).hint("the drive determines value and rate at time zero"))
        }
        None => Ok(()),
    }
}

fn refuse_rates_twice(table: &Table<'_>, child: &BodyEntry) -> Result<(), SceneError> {
    let own = child.velocity.is_some() || child.angular_velocity.is_some();
    match ["rate_deg", "rate"].iter().find_map(|key| table.get(key)).filter(|_| own) {
        Some(value) => {
            let expected = format!("no rate, as body \"{}\" has its own velocity (line {})", child.name, child.line);
            Err(value.wrong(&expected).hint("remove one of them"))
        }
        None => Ok(()),
    }
}

fn drive(table: &Table<'_>, kind: MotionKind, duration_s: f64) -> Result<Option<DriveEntry>, SceneError> {
    let function = function::either_unit(table, "drive", kind.purpose(duration_s))?;
    let max = table.above_zero_or("drive_max", f64::INFINITY)?;
    match (function, table.get("drive_max")) {
        (None, Some(_)) => Err(table.missing("drive", "the motion that `drive_max` limits")),
        (function, _) => Ok(function.map(|function| DriveEntry { function, max })),
    }
}

fn spring(value: &Value<'_>, kind: MotionKind) -> Result<Spring, SceneError> {
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

fn limits(value: &Value<'_>, kind: MotionKind, start: f64, unchecked: bool) -> Result<Limits, SceneError> {
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
        return Err(error.hint(
            "`start_deg` (or `start`) is the value that belongs to the initial positions of the bodies; default 0",
        ));
    }
    Ok(limits)
}

fn motor(value: &Value<'_>, kind: MotionKind, duration_s: f64) -> Result<MotorEntry, SceneError> {
    let table = value.table("{ target_deg = …, stiffness = …, damping = 0 }")?;
    table.only(&[&["target_deg", "target", "stiffness", "damping", "max"]])?;
    let target = function::either_unit(&table, "target", kind.purpose(duration_s))?;
    let key = if kind == MotionKind::Rotation { "target_deg" } else { "target" };
    Ok(MotorEntry {
        target: target.ok_or_else(|| table.missing(key, "the target of the motor"))?,
        stiffness: table.need("stiffness", "the moment per radian, or the force per metre")?.zero_or_more()?,
        damping: table.zero_or_more_or("damping", 0.0)?,
        max: table.above_zero_or("max", f64::INFINITY)?,
    })
}
