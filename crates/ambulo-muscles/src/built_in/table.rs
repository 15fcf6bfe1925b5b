//! The table of the muscles of a leg; the header of the data file has source, licence and form.

use crate::set::ThelenCurves;
use ambulo_body::model::{Knots, SimmSpline};
use ambulo_body::spatial::Vec3;
use ambulo_body::toml_reader::{Source, Table, TomlError, Value};
use std::sync::LazyLock;

const MUSCLES: &str = include_str!("../../data/leg_muscles.toml");
const DOCUMENT: &str = "docs/MUSCLES.md";

/// A segment that carries points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Segment {
    Pelvis,
    Thigh,
    Shank,
    Foot,
    Toes,
}

impl Segment {
    pub(super) const COUNT: usize = 5;
    const WORDS: [(&'static str, Segment); Segment::COUNT] = [
        ("pelvis", Segment::Pelvis),
        ("thigh", Segment::Thigh),
        ("shank", Segment::Shank),
        ("foot", Segment::Foot),
        ("toes", Segment::Toes),
    ];
}

/// A joint on whose angle points depend.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Joint {
    Hip,
    Knee,
}

const JOINTS: [(&str, Joint); 2] = [("hip", Joint::Hip), ("knee", Joint::Knee)];

/// The body on which the points of the table were measured.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Reference {
    /// Body mass [kg].
    pub(super) mass_kg: f64,
    /// Hip to knee [m].
    pub(super) thigh_m: f64,
    /// Knee to ankle [m].
    pub(super) shank_m: f64,
    /// Ball of the right foot from the ankle, in the axes of the foot [m].
    pub(super) ball: Vec3,
    /// Angle by which the line through the markers of the iliac spines falls to the front [rad].
    pub(super) spines_rad: f64,
    /// Distance between the markers of the anterior iliac spines [m].
    pub(super) spines_m: f64,
}

/// A muscle of the right leg.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct MuscleRow {
    /// Name without side.
    pub(super) name: String,
    /// Greatest isometric force [N].
    pub(super) force_n: f64,
    /// Optimal fibre length [m].
    pub(super) fiber_m: f64,
    /// Slack length of the tendon [m].
    pub(super) tendon_m: f64,
    /// Pennation at the optimal fibre length [rad].
    pub(super) pennation_rad: f64,
    /// Points from origin to insertion.
    pub(super) points: Vec<PointRow>,
}

/// A point of a path.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PointRow {
    pub(super) segment: Segment,
    pub(super) place: PlaceRow,
}

/// Where a point is in the frame of its segment [m].
#[derive(Debug, Clone, PartialEq)]
pub(super) enum PlaceRow {
    Fixed(Vec3),
    /// Part of the path while the angle of a joint is in a range [rad].
    Conditional {
        place: Vec3,
        joint: Joint,
        range: [f64; 2],
    },
    /// x, y and z against the angle of a joint [rad].
    Moving {
        joint: Joint,
        spline: Box<[SimmSpline; 3]>,
    },
}

/// The muscles of a right leg.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LegTable {
    pub(super) reference: Reference,
    /// Parameters of the curves of all muscles.
    pub(super) curves: ThelenCurves,
    /// Greatest velocity of shortening [optimal fibre lengths a second].
    pub(super) max_contraction_velocity: f64,
    /// Greatest pennation [rad].
    pub(super) max_pennation_rad: f64,
    pub(super) muscles: Vec<MuscleRow>,
}

impl LegTable {
    /// The built-in table.
    pub(super) fn built_in() -> Result<&'static LegTable, TomlError> {
        static READ: LazyLock<Result<LegTable, TomlError>> = LazyLock::new(|| LegTable::from_toml(MUSCLES));
        READ.as_ref().map_err(Clone::clone)
    }

    fn from_toml(text: &str) -> Result<LegTable, TomlError> {
        let source = Source::new(text, DOCUMENT);
        let parsed = source.parse()?;
        let root = Table::root(&source, &parsed);
        root.only(&[&["reference", "curves", "muscle"]])?;
        let table = |key: &str| root.need(key, "a table")?.table("a table");
        let (body, curves) = (table("reference")?, table("curves")?);
        let number = |table: &Table<'_>, key: &str| table.need(key, "a number above zero")?.above_zero();
        Ok(LegTable {
            reference: Reference {
                mass_kg: number(&body, "mass_kg")?,
                thigh_m: number(&body, "thigh_m")?,
                shank_m: number(&body, "shank_m")?,
                ball: body.need("ball_m", "a place")?.vector()?,
                spines_rad: body.need("spines_rad", "an angle")?.number()?,
                spines_m: number(&body, "spines_m")?,
            },
            curves: ThelenCurves {
                tendon_strain_at_max: number(&curves, "tendon_strain_at_max")?,
                fiber_strain_at_max: number(&curves, "fiber_strain_at_max")?,
                active_shape: number(&curves, "active_shape")?,
                passive_shape: number(&curves, "passive_shape")?,
                velocity_shape: number(&curves, "velocity_shape")?,
                lengthening_force: number(&curves, "lengthening_force")?,
                straight_from: number(&curves, "straight_from")?,
            },
            max_contraction_velocity: number(&curves, "max_contraction_velocity")?,
            max_pennation_rad: number(&curves, "max_pennation_rad")?,
            muscles: root.tables("muscle")?.iter().map(muscle).collect::<Result<_, _>>()?,
        })
    }
}

fn muscle(table: &Table<'_>) -> Result<MuscleRow, TomlError> {
    table.only(&[&["name", "force_n", "fiber_m", "tendon_m", "pennation_rad", "points"]])?;
    let number = |key: &str| table.need(key, "a number")?.zero_or_more();
    let points = table.need("points", "the points of the path")?.list("a list of points")?;
    Ok(MuscleRow {
        name: table.need("name", "the name")?.filled_text()?,
        force_n: number("force_n")?,
        fiber_m: number("fiber_m")?,
        tendon_m: number("tendon_m")?,
        pennation_rad: number("pennation_rad")?,
        points: points.iter().map(point).collect::<Result<_, _>>()?,
    })
}

fn point(value: &Value<'_>) -> Result<PointRow, TomlError> {
    let table = value.table("a point")?;
    table.only(&[&["on", "at", "joint", "between", "angles", "x", "y", "z"]])?;
    let segment = table.need("on", "the segment")?.choice(&Segment::WORDS)?;
    let joint = table.get("joint").map(|value| value.choice(&JOINTS)).transpose()?;
    let at = table.get("at").map(|value| value.vector()).transpose()?;
    let place = match (joint, at) {
        (None, Some(place)) => PlaceRow::Fixed(place),
        (Some(joint), Some(place)) => {
            let range = table.need("between", "least and greatest angle")?.numbers("two angles")?;
            PlaceRow::Conditional { place, joint, range }
        }
        (Some(joint), None) => PlaceRow::Moving { joint, spline: Box::new(splines(&table)?) },
        (None, None) => return Err(table.missing("at", "the place")),
    };
    Ok(PointRow { segment, place })
}

fn splines(table: &Table<'_>) -> Result<[SimmSpline; 3], TomlError> {
    let numbers = |key: &str| -> Result<Vec<f64>, TomlError> {
        table.need(key, "a list of numbers")?.list("a list of numbers")?.iter().map(Value::number).collect()
    };
    let angles = numbers("angles")?;
    let spline = |key: &str| {
        let knots = Knots::new(angles.clone(), numbers(key)?);
        let wrong = || table.wrong(format!("`{key}` does not belong to rising angles; expected one number per angle"));
        knots.and_then(SimmSpline::new).ok_or_else(wrong)
    };
    Ok([spline("x")?, spline("y")?, spline("z")?])
}
