//! Values of a job that a person may write as text.

use crate::model::Side;
use crate::spatial::Vec3;
use crate::study::{AddedMass, PlateUse};
use serde::Deserialize;
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// The body of a recording.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(from = "PathBuf")]
pub enum ModelChoice {
    /// The built-in body.
    BuiltIn,
    /// An OpenSim model (`.osim`).
    File(PathBuf),
}

impl ModelChoice {
    /// The word for the built-in body in place of a model file.
    pub const BUILT_IN: &'static str = "built-in";

    /// The model file, or the word for the built-in body.
    #[must_use]
    pub fn path(&self) -> &Path {
        match self {
            ModelChoice::BuiltIn => Path::new(ModelChoice::BUILT_IN),
            ModelChoice::File(path) => path,
        }
    }
}

impl From<PathBuf> for ModelChoice {
    fn from(path: PathBuf) -> ModelChoice {
        if path.as_os_str() == ModelChoice::BUILT_IN { ModelChoice::BuiltIn } else { ModelChoice::File(path) }
    }
}

/// A filter family.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Filter {
    /// Zero-phase low-pass.
    #[default]
    Butterworth,
    /// Smoothing spline.
    Spline,
}

impl Filter {
    /// The families with their names.
    pub const ALL: [(&'static str, Filter); 2] = [("butterworth", Filter::Butterworth), ("spline", Filter::Spline)];
}

/// How coordinates are fitted to markers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum MarkerFitting {
    /// Each frame separately.
    Frames,
    /// All frames together.
    Trajectory,
}

impl MarkerFitting {
    /// The methods with their names.
    pub const ALL: [(&'static str, MarkerFitting); 2] =
        [("frames", MarkerFitting::Frames), ("trajectory", MarkerFitting::Trajectory)];
}

/// A cut-off frequency, or none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cutoff(
    /// The frequency [Hz]; `None` is off.
    pub Option<f64>,
);

impl fmt::Display for Cutoff {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(hz) => write!(f, "{hz}"),
            None => f.write_str("off"),
        }
    }
}

impl FromStr for Cutoff {
    type Err = String;
    fn from_str(text: &str) -> Result<Cutoff, String> {
        if text.eq_ignore_ascii_case("off") {
            return Ok(Cutoff(None));
        }
        match text.parse::<f64>() {
            Ok(hz) if hz.is_finite() && hz > 0.0 => Ok(Cutoff(Some(hz))),
            _ => Err("expected a frequency above 0 in Hz, or `off`".into()),
        }
    }
}

/// How measured forces are filtered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ForceCutoff {
    /// As the motion.
    Same,
    /// With this cut-off frequency [Hz].
    Hz(f64),
    /// Not at all.
    Off,
}

impl fmt::Display for ForceCutoff {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ForceCutoff::Same => f.write_str("same"),
            ForceCutoff::Hz(hz) => write!(f, "{hz}"),
            ForceCutoff::Off => f.write_str("off"),
        }
    }
}

impl FromStr for ForceCutoff {
    type Err = String;
    fn from_str(text: &str) -> Result<ForceCutoff, String> {
        match (text.to_ascii_lowercase().as_str(), text.parse::<f64>()) {
            ("same", _) => Ok(ForceCutoff::Same),
            ("off", _) => Ok(ForceCutoff::Off),
            (_, Ok(hz)) if (1.0..=500.0).contains(&hz) => Ok(ForceCutoff::Hz(hz)),
            _ => Err("expected a frequency from 1 to 500 Hz, `same` (as the motion) or `off`".into()),
        }
    }
}

/// A body and the prefix of the columns that act on it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FootColumns {
    /// Name of the body.
    pub body: String,
    /// Beginning of the names of the columns.
    pub prefix: String,
}

impl fmt::Display for FootColumns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.body, self.prefix)
    }
}

impl FromStr for FootColumns {
    type Err = String;
    fn from_str(text: &str) -> Result<FootColumns, String> {
        match text.split_once(':') {
            Some((body, prefix)) if !body.is_empty() && prefix.contains("force") => {
                Ok(FootColumns { body: body.to_owned(), prefix: prefix.to_owned() })
            }
            _ => Err(
                "expected BODY:PREFIX with `force` in the prefix, such as calcn_r:ground_force_r_; the columns are \
                      PREFIX + vx vy vz and px py pz, with `torque` instead of `force` for the free moment"
                    .into(),
            ),
        }
    }
}

/// A statement about a force plate: which foot is on it, and errors of its signs and directions.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlateFoot {
    /// The plate, counted from 1.
    pub plate: usize,
    /// Statements in the order in which they are applied.
    pub(super) uses: Vec<PlateUse>,
}

impl fmt::Display for PlateFoot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = |used: &PlateUse| match used {
            PlateUse::Foot(side) => side.letter().to_owned(),
            PlateUse::Off => "off".to_owned(),
            PlateUse::Flip(axis) => format!("flip-{}", ["x", "y"][usize::from(*axis > 0)]),
            PlateUse::Turn(quarters) => format!("turn-{}", 90 * quarters),
        };
        write!(f, "{}={}", self.plate, self.uses.iter().map(word).collect::<Vec<_>>().join("+"))
    }
}

/// One word about a plate.
fn plate_use(word: &str) -> Option<PlateUse> {
    Some(match word.trim().to_ascii_lowercase().as_str() {
        "r" | "right" => PlateUse::Foot(Side::Right),
        "l" | "left" => PlateUse::Foot(Side::Left),
        "off" => PlateUse::Off,
        "flip-x" => PlateUse::Flip(0),
        "flip-y" => PlateUse::Flip(1),
        "turn-90" => PlateUse::Turn(1),
        "turn-180" => PlateUse::Turn(2),
        "turn-270" => PlateUse::Turn(3),
        _ => return None,
    })
}

impl FromStr for PlateFoot {
    type Err = String;
    fn from_str(text: &str) -> Result<PlateFoot, String> {
        let expected = "expected PLATE=FOOT, such as 1=r, with plates counted from 1 and r, l or off as the foot; \
            flip-x, flip-y, turn-90, turn-180 and turn-270 correct signs and directions, also together as in \
            1=r+flip-y";
        let (plate, words) = text.split_once('=').ok_or(expected)?;
        let uses = words.split('+').map(plate_use).collect::<Option<Vec<_>>>().ok_or(expected)?;
        match plate.trim().parse() {
            Ok(plate @ 1..) => Ok(PlateFoot { plate, uses }),
            _ => Err(expected.into()),
        }
    }
}

/// The axis of a sensor that points forward.
#[derive(Debug, Clone, PartialEq)]
pub struct HeadingAxis {
    /// Name of the sensor.
    pub sensor: String,
    /// Unit vector.
    pub axis: Vec3,
}

impl HeadingAxis {
    /// The axis x, y or z, by number, or the opposite direction.
    #[must_use]
    pub fn of(sensor: &str, axis: usize, is_negative: bool) -> HeadingAxis {
        HeadingAxis { sensor: sensor.to_owned(), axis: Vec3::ith(axis, if is_negative { -1.0 } else { 1.0 }) }
    }
}

impl fmt::Display for HeadingAxis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = self.axis.iamax();
        let sign = if self.axis[number] < 0.0 { "-" } else { "" };
        write!(f, "{}:{sign}{}", self.sensor, ["x", "y", "z"][number])
    }
}

impl FromStr for HeadingAxis {
    type Err = String;
    fn from_str(text: &str) -> Result<HeadingAxis, String> {
        let expected = "expected SENSOR:AXIS with one of x, y, z, -x, -y and -z, such as pelvis_imu:-z";
        let (sensor, axis) = text.rsplit_once(':').ok_or(expected)?;
        let (is_negative, letter) = axis.trim().strip_prefix('-').map_or((false, axis.trim()), |letter| (true, letter));
        let number = ["x", "y", "z"].iter().position(|known| known.eq_ignore_ascii_case(letter)).ok_or(expected)?;
        if sensor.trim().is_empty() {
            return Err(expected.into());
        }
        Ok(HeadingAxis::of(sensor.trim(), number, is_negative))
    }
}

/// Angles about the fixed axes x, y and z [rad].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EarthTurn(
    /// Angles [rad].
    pub [f64; 3],
);

/// In degrees, as [`FromStr`] takes it.
impl fmt::Display for EarthTurn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.0.map(|angle| (1e6 * angle.to_degrees()).round() / 1e6);
        write!(f, "{x},{y},{z}")
    }
}

impl FromStr for EarthTurn {
    type Err = String;
    fn from_str(text: &str) -> Result<EarthTurn, String> {
        let angles: Option<Vec<f64>> =
            text.split(',').map(|part| part.trim().parse().ok().filter(|angle: &f64| angle.abs() <= 360.0)).collect();
        match angles.as_deref() {
            Some([x, y, z]) => Ok(EarthTurn([*x, *y, *z].map(f64::to_radians))),
            _ => Err("expected X,Y,Z: three angles in degrees from -360 to 360, such as -90,0,0".into()),
        }
    }
}

impl fmt::Display for AddedMass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let AddedMass { body, mass_kg, position_m } = self;
        let [x, y, z]: [f64; 3] = (*position_m).into();
        write!(f, "{body}:{mass_kg}:{x},{y},{z}")
    }
}

impl FromStr for AddedMass {
    type Err = String;
    fn from_str(text: &str) -> Result<AddedMass, String> {
        let expected = || "expected BODY:KG or BODY:KG:X,Y,Z, such as torso:2.5:-0.1,0.3,0".to_owned();
        let mut parts = text.split(':');
        let (body, mass) = (parts.next().unwrap_or_default(), parts.next().ok_or_else(expected)?);
        let mass_kg = mass.trim().parse().map_err(|_| expected())?;
        let position: Vec<f64> = match parts.next() {
            None => vec![0.0; 3],
            Some(position) => {
                position.split(',').map(|x| x.trim().parse()).collect::<Result<_, _>>().map_err(|_| expected())?
            }
        };
        match (position[..].try_into(), parts.next()) {
            (Ok::<[f64; 3], _>(position), None) if !body.is_empty() => {
                Ok(AddedMass { body: body.to_owned(), mass_kg, position_m: Vec3::from(position) })
            }
            _ => Err(expected()),
        }
    }
}
