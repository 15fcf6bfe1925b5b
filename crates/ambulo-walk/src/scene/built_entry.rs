//! Built-in figures in a scene file: size, walk, arms, and drives of their joints.

use super::SceneError;
use super::coordinate::CoordinateEntry;
use super::joint_axes::MotionKind;
use super::material::MaterialEntry;
use super::tracking_costs;
use crate::control::ControlSettings;
use crate::gait::{Gait, PaceChange};
use crate::model::anthropometry::{Build, Human, SegmentTable};
use crate::model::{CoordinateId, CoordinateKind as ModelKind, Side};
use crate::toml_reader::{Place, Table, Value};

/// A figure of [`crate::model::anthropometry`]: planar, in a vertical plane through `at`, or in three dimensions
/// ([`FigureWalkMode::Optimal`]).
#[derive(Debug, Clone, PartialEq)]
pub struct BuiltFigure {
    /// Place of `build` in the file.
    pub place: Place,
    /// Table, mass, height.
    pub build: Build,
    /// The walk; `None`: it stands upright.
    pub walk: Option<WalkEntry>,
    /// Abduction of the right and the left arm.
    pub arms: [ArmEntry; 2],
    /// Material of the soles, an index in [`SceneFile::materials`](super::SceneFile::materials); `None`: soft shoes.
    pub shoes: Option<usize>,
    /// Coordinates that do not follow the walk exactly.
    pub coordinates: Vec<BuiltCoordinate>,
    /// Place and settings of its controller: the figure then walks by its own torques.
    pub control: Option<ControlEntry>,
}

/// Abduction of an arm.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ArmEntry {
    /// Angle away from the trunk [rad].
    pub abduction: f64,
    /// Stiffness [N.m/rad] and damping [N.m.s/rad] of a spring at this angle; `None`: the angle is fixed.
    pub spring: Option<[f64; 2]>,
}

/// The walk of a built-in figure.
#[derive(Debug, Clone, PartialEq)]
pub struct WalkEntry {
    /// Place in the file.
    pub place: Place,
    /// Name of a built-in gait, or the path of a gait file.
    pub gait: GaitSource,
    /// Speed instead of the gait's own [m/s].
    pub speed: Option<f64>,
    /// How the curves of the gait are used.
    pub mode: FigureWalkMode,
    /// Phase at which the scene begins, as a share of the cycle from a right foot strike.
    pub phase: f64,
    /// Changes of pace after the changes of the gait.
    pub changes: Vec<PaceChange>,
    /// Height by which soles are lifted further than usual [m].
    pub lift: f64,
    /// Duration of the scene [s].
    pub duration_s: f64,
}

/// Where a gait comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum GaitSource {
    /// A built-in gait.
    Named(String),
    /// A gait file, with its path relative to the scene.
    File(String),
}

/// How the joint curves of a gait are used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FigureWalkMode {
    /// Made dynamically consistent ([`crate::consistent_walk`]).
    Corrected,
    /// A walk in three dimensions without outside forces ([`crate::optimal::OptimalWalk`]); it needs a controller.
    Optimal,
    /// Followed unchanged.
    Curves,
}

/// A coordinate with its own drive, motor, spring or start.
#[derive(Debug, Clone, PartialEq)]
pub struct BuiltCoordinate {
    /// Line of its header.
    pub line: usize,
    /// Name of the coordinate in the figure's model.
    pub name: String,
    /// Drive, motor, spring, limits and friction.
    pub acting: CoordinateEntry,
    /// Whether value and rate at the start are given; otherwise they are taken from the walk.
    pub starts: [bool; 2],
    /// A motor that tracks the walk.
    pub follow: Option<WalkTracking>,
}

/// A motor with the moment stiffness (walk - value) + damping (walk's rate - rate), limited to `max`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WalkTracking {
    /// Stiffness [N.m/rad], zero or more.
    pub stiffness: f64,
    /// Damping [N.m.s/rad], zero or more.
    pub damping: f64,
    /// Largest moment [N.m]; infinity if not limited.
    pub max: f64,
}

/// The controller of a figure.
#[derive(Debug, Clone, PartialEq)]
pub struct ControlEntry {
    pub(super) place: Place,
    /// Settings; torque curves of a file are not read yet.
    pub settings: ControlSettings,
    /// File of torque curves.
    pub torques: Option<(Place, String)>,
}

/// Keys of a built-in figure.
pub(super) const KEYS: &[&str] =
    &["name", "build", "walk", "arms", "shoes", "coordinate", "control", "at", "rotation", "sphere"];
/// Largest additional lift of soles [m].
const MOST_LIFT_M: f64 = 0.1;
/// Largest delay and largest time constant of feedback [s]: with longer ones the figure has already fallen.
const MOST_LATE_S: f64 = 0.2;
/// Why a figure in three dimensions needs a controller.
const CONTROLLED: &str = "a controller, as in `control = {}`: a figure in three dimensions walks by its own torques";
/// Largest abduction of an arm [rad].
const MOST_ABDUCTION: f64 = std::f64::consts::FRAC_PI_2;

impl BuiltFigure {
    pub(super) fn read(
        table: &Table<'_>,
        value: &Value<'_>,
        materials: &[MaterialEntry],
        duration_s: f64,
    ) -> Result<BuiltFigure, SceneError> {
        let (build, human) = build(value)?;
        let shoes = table.get("shoes").map(|value| {
            let words: Vec<(&str, usize)> = materials.iter().enumerate().map(|(i, m)| (m.name.as_str(), i)).collect();
            value.choice(&words)
        });
        let own = |entry: &Table<'_>| BuiltCoordinate::read(entry, &human, table.get("walk").is_some(), duration_s);
        let coordinates = table.tables("coordinate")?.iter().map(own).collect::<Result<Vec<_>, _>>()?;
        refuse_repeated(&coordinates, table)?;
        let walk = table.get("walk").map(|value| WalkEntry::read(&value, duration_s)).transpose()?;
        Ok(BuiltFigure {
            place: value.place(),
            build,
            control: control(table, walk.as_ref())?,
            walk,
            arms: arms(table)?,
            shoes: shoes.transpose()?,
            coordinates,
        })
    }
}

fn build(value: &Value<'_>) -> Result<(Build, Human), SceneError> {
    let table = value.table("{ table = …, mass = …, height = … }")?;
    table.only(&[&["table", "mass", "height", "toe_joint"]])?;
    let words = SegmentTable::ALL.map(|segments| (segments.name(), segments));
    let build = Build {
        table: table.need("table", "the table of segments, such as \"de-leva-female\"")?.choice(&words)?,
        mass: table.need("mass", "the body mass [kg]")?.above_zero()?,
        height: table.need("height", "the stature [m]")?.above_zero()?,
        toe_joint: table.truth_or("toe_joint", true)?,
    };
    let human = build.human().map_err(|e| value.place().error(super::error_chain::chain(&e)))?;
    Ok((build, human))
}

/// Delay or time constant of feedback [s].
fn lateness(table: &Table<'_>, key: &str) -> Result<f64, SceneError> {
    let Some(value) = table.get(key) else { return Ok(0.0) };
    let time_s = value.zero_or_more()?;
    if time_s <= MOST_LATE_S { Ok(time_s) } else { Err(value.wrong("a time of at most 0.2 s")) }
}

/// The gains that the other keys change.
fn gains(table: &Table<'_>, is_spatial: bool) -> Result<ControlSettings, SceneError> {
    let Some(value) = table.get("gains") else { return Ok(ControlSettings::default()) };
    let is_tuned = value.choice(&[("usual", false), ("tuned", true)])?;
    if is_tuned && (is_spatial || ["delay", "activation"].iter().any(|key| table.get(key).is_some())) {
        return Err(value.wrong(
            "\"usual\" in three dimensions and with a `delay` or an `activation`: tuned gains are for planar figures \
            whose feedback acts at once",
        ));
    }
    Ok(if is_tuned { ControlSettings::tuned_in_the_plane() } else { ControlSettings::default() })
}

/// The controller of a figure, which needs a dynamically consistent walk of one pace and all joints for itself.
fn control(table: &Table<'_>, walk: Option<&WalkEntry>) -> Result<Option<ControlEntry>, SceneError> {
    let is_spatial = walk.is_some_and(|walk| walk.mode == FigureWalkMode::Optimal);
    let Some(value) = table.get("control") else {
        return if is_spatial { Err(table.missing("control", CONTROLLED)) } else { Ok(None) };
    };
    if let Some(arms) = table.get("arms").filter(|_| is_spatial) {
        return Err(arms.wrong("no such key for a walk in the mode `optimal`, which moves the arms"));
    }
    let own = value.table("{ stiffness = …, damping = … }")?;
    own.only(&[&["gains", "stiffness", "damping", "delay", "activation", "recovery_steps", "costs", "torques"]])?;
    if !walk.is_some_and(|walk| walk.mode != FigureWalkMode::Curves) {
        return Err(value
            .wrong("no such key without a `walk` in the mode `corrected` or `optimal`, which the controller follows"));
    }
    if let Some(coordinate) = table.get("coordinate") {
        return Err(coordinate.wrong("no such key together with `control`, which drives all joints"));
    }
    if let Some(steps) = own.get("recovery_steps").filter(|_| !is_spatial) {
        return Err(steps.wrong("no such key for a planar figure: recovery steps need three dimensions"));
    }
    let default = gains(&own, is_spatial)?;
    let settings = ControlSettings {
        stiffness: own.above_zero_or("stiffness", default.stiffness)?,
        damping_s: own.zero_or_more_or("damping", default.damping_s)?,
        delay_s: lateness(&own, "delay")?,
        activation_s: lateness(&own, "activation")?,
        recovery_steps: own.truth_or("recovery_steps", default.recovery_steps)?,
        costs: tracking_costs::read(&own, default.costs)?,
        ..default
    };
    let torques = own.get("torques").map(|file| Ok((file.place(), file.filled_text()?))).transpose()?;
    Ok(Some(ControlEntry { place: value.place(), settings, torques }))
}

fn arms(table: &Table<'_>) -> Result<[ArmEntry; 2], SceneError> {
    let Some(value) = table.get("arms") else { return Ok([ArmEntry::default(); 2]) };
    let table = value.table("{ right = { abduction_deg = … }, left = { abduction_deg = … } }")?;
    table.only(&[&["right", "left"]])?;
    let [right, left] = Side::BOTH.map(|side| table.get(&side.to_string()).map(|value| ArmEntry::read(&value)));
    Ok([right.transpose()?.unwrap_or_default(), left.transpose()?.unwrap_or_default()])
}

impl ArmEntry {
    fn read(value: &Value<'_>) -> Result<ArmEntry, SceneError> {
        let table = value.table("{ abduction_deg = … }")?;
        table.only(&[&["abduction_deg", "abduction", "stiffness", "damping"]])?;
        let mut arm = ArmEntry::default();
        if let Some((value, unit)) = table.either_unit("abduction")? {
            arm.abduction = value.number()? * unit;
            if !(0.0..=MOST_ABDUCTION).contains(&arm.abduction) {
                return Err(value.wrong("an angle away from the trunk, up to 90 degrees"));
            }
        }
        let damping = table.zero_or_more_or("damping", 0.0)?;
        arm.spring = table.get("stiffness").map(|value| Ok([value.zero_or_more()?, damping])).transpose()?;
        match (table.get("damping"), arm.spring) {
            (Some(value), None) => Err(value.wrong("no such key without a `stiffness`")),
            _ => Ok(arm),
        }
    }
}

impl WalkEntry {
    fn read(value: &Value<'_>, duration_s: f64) -> Result<WalkEntry, SceneError> {
        let table = value.table("{ gait = \"free\", speed = … }")?;
        table.only(&[&["gait", "speed", "mode", "phase", "changes", "lift"]])?;
        let modes = [
            ("corrected", FigureWalkMode::Corrected),
            ("optimal", FigureWalkMode::Optimal),
            ("curves", FigureWalkMode::Curves),
        ];
        let phase = table.number_or("phase", 0.0)?;
        if let Some(value) = table.get("phase").filter(|_| !(0.0..1.0).contains(&phase)) {
            return Err(value.wrong("a share of the cycle, from 0 up to but not including 1"));
        }
        let lift = table.number_or("lift", 0.0)?;
        if let Some(value) = table.get("lift").filter(|_| !(0.0..=MOST_LIFT_M).contains(&lift)) {
            return Err(value.wrong("a height from 0 to 0.1 m"));
        }
        Ok(WalkEntry {
            place: value.place(),
            lift,
            gait: table.get("gait").map_or_else(|| Ok(GaitSource::Named("free".to_owned())), |v| gait(&v))?,
            speed: table.get("speed").map(|value| value.zero_or_more()).transpose()?,
            changes: table.tables("changes")?.iter().map(PaceChange::read).collect::<Result<_, _>>()?,
            duration_s,
            mode: table.get("mode").map_or(Ok(FigureWalkMode::Corrected), |value| value.choice(&modes))?,
            phase,
        })
    }
}

fn gait(value: &Value<'_>) -> Result<GaitSource, SceneError> {
    let text = value.filled_text()?;
    if text.ends_with(".toml") {
        return Ok(GaitSource::File(text));
    }
    let known = Gait::NAMES.contains(&text.as_str());
    let expected = || format!("a path that ends with .toml, or one of {}", Gait::NAMES.join(", "));
    if known { Ok(GaitSource::Named(text)) } else { Err(value.wrong(&expected())) }
}

impl BuiltCoordinate {
    fn read(table: &Table<'_>, human: &Human, walks: bool, duration_s: f64) -> Result<BuiltCoordinate, SceneError> {
        table.only(&[&["name", "follow"], super::coordinate::KEYS])?;
        let value = table.need("name", "a coordinate of the figure")?;
        let name = value.text()?;
        let words: Vec<(&str, CoordinateId)> =
            human.model.coordinate_ids().map(|id| (human.model.coordinates()[id.index()].name.as_str(), id)).collect();
        let id = value.choice(&words)?;
        let kind = match human.model.coordinates()[id.index()].kind {
            ModelKind::Translation => MotionKind::Translation,
            _ => MotionKind::Rotation,
        };
        let given = |keys: [&str; 2]| keys.iter().any(|key| table.get(key).is_some());
        let starts = [given(["start", "start_deg"]), given(["rate", "rate_deg"])];
        let acting = CoordinateEntry::read_acting(table, kind, starts[0], duration_s)?;
        let follow = table.get("follow").map(|value| WalkTracking::read(&value)).transpose()?;
        if let (Some(value), true) = (table.get("follow"), acting.drive.is_some() || acting.motor.is_some()) {
            return Err(value.wrong("no such key together with a drive or a motor"));
        }
        if let (Some(value), false) = (table.get("follow"), walks) {
            return Err(value.wrong("no such key without a `walk` to follow"));
        }
        Ok(BuiltCoordinate { line: table.line, name: name.to_owned(), acting, starts, follow })
    }
}

impl WalkTracking {
    fn read(value: &Value<'_>) -> Result<WalkTracking, SceneError> {
        let table = value.table("{ stiffness = …, damping = 0 }")?;
        table.only(&[&["stiffness", "damping", "max"]])?;
        Ok(WalkTracking {
            stiffness: table.need("stiffness", "the moment per radian [N.m/rad]")?.zero_or_more()?,
            damping: table.zero_or_more_or("damping", 0.0)?,
            max: table.above_zero_or("max", f64::INFINITY)?,
        })
    }
}

fn refuse_repeated(coordinates: &[BuiltCoordinate], figure: &Table<'_>) -> Result<(), SceneError> {
    for (i, own) in coordinates.iter().enumerate() {
        if let Some(earlier) = coordinates[..i].iter().find(|earlier| earlier.name == own.name) {
            let place = Place { line: own.line, key: format!("{}.coordinate[{}].name", figure.place().key, i + 1) };
            let line = earlier.line;
            return Err(place.error(format!("found \"{}\" twice; the first one is in line {line}", own.name)));
        }
    }
    Ok(())
}
