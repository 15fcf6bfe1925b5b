//! Solved walks of the built-in figures, which ship with the library.
//!
//! data/walks has the spline coefficients of solved walks of the built-in figures. A walk of the same figure, speed and
//! cadence needs no solution; a test checks that the files solve the present problem. Other walks are solved from the
//! plan with the nearest speed. Movements of a man between a slow walk and standing are here too. Made by `cargo xtask
//! walk-plans`.

use super::error::STEPS_ON_THE_SPOT;
use super::solution::Solution;
use crate::findings::Findings;
use crate::gait::{Gait, Speed, Walk};
use crate::model::anthropometry::{Build, Human, SegmentTable};
use crate::toml_reader::{Source, Table, TomlError};

/// Largest difference of speed and cycle at which a plan belongs to a walk.
const SAME: f64 = 1e-9;
/// Name of a plan in errors.
const DOCUMENT: &str = "plan of a walk";

const FILES: [(SegmentTable, &str); 12] = [
    (SegmentTable::DeLevaMale, include_str!("../../data/walks/de-leva-male-slow.toml")),
    (SegmentTable::DeLevaMale, include_str!("../../data/walks/de-leva-male-free.toml")),
    (SegmentTable::DeLevaMale, include_str!("../../data/walks/de-leva-male-fast.toml")),
    (SegmentTable::DeLevaFemale, include_str!("../../data/walks/de-leva-female-slow.toml")),
    (SegmentTable::DeLevaFemale, include_str!("../../data/walks/de-leva-female-free.toml")),
    (SegmentTable::DeLevaFemale, include_str!("../../data/walks/de-leva-female-fast.toml")),
    (SegmentTable::DempsterWinter, include_str!("../../data/walks/dempster-winter-slow.toml")),
    (SegmentTable::DempsterWinter, include_str!("../../data/walks/dempster-winter-free.toml")),
    (SegmentTable::DempsterWinter, include_str!("../../data/walks/dempster-winter-fast.toml")),
    (SegmentTable::Faure1997, include_str!("../../data/walks/faure-1997-slow.toml")),
    (SegmentTable::Faure1997, include_str!("../../data/walks/faure-1997-free.toml")),
    (SegmentTable::Faure1997, include_str!("../../data/walks/faure-1997-fast.toml")),
];

/// Movements between a walk and standing ([`StandingMovements::plans`](super::StandingMovements::plans)).
const MOVEMENTS: [(&str, &str); 3] = [
    ("stop", include_str!("../../data/walks/de-leva-male-stop.toml")),
    ("start", include_str!("../../data/walks/de-leva-male-start.toml")),
    (STEPS_ON_THE_SPOT, include_str!("../../data/walks/de-leva-male-steps.toml")),
];

/// A solved walk: spline coefficients of a figure's walk at a speed. Or a movement between that walk and standing.
#[derive(Debug, Clone, PartialEq)]
pub struct WalkPlan {
    /// The figure.
    pub build: Build,
    /// Speed V/√(gL).
    pub speed: f64,
    /// Duration of a cycle [s].
    pub cycle_s: f64,
    /// Names of the figure's coordinates.
    pub coordinates: Vec<String>,
    /// Coefficients, all coordinates of one knot after another [rad or m].
    pub coefficients: Vec<f64>,
}

impl WalkPlan {
    /// The built-in plan for this walk of a figure, if there is one.
    ///
    /// # Errors
    /// None of the built-in plans; a test reads them.
    pub fn of(build: &Build, walk: &Walk) -> Result<Option<WalkPlan>, TomlError> {
        if !walk.gait().follows_people() {
            return Ok(None);
        }
        Ok(WalkPlan::built_in(build.table)?.into_iter().find(|plan| plan.build == *build && plan.is_for(walk)))
    }

    /// The built-in plan of a figure with the same table of segments whose dimensionless speed is nearest to the speed
    /// of a walk, and its walk; none for a gait without normative curves.
    ///
    /// # Errors
    /// None of the built-in plans; a test reads them.
    pub fn nearest(table: SegmentTable, walk: &Walk) -> Result<Option<(WalkPlan, Walk)>, TomlError> {
        if !walk.gait().follows_people() {
            return Ok(None);
        }
        let apart = |plan: &WalkPlan| (plan.speed - walk.dimensionless_speed()).abs();
        let plan = WalkPlan::built_in(table)?.into_iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));
        Ok(plan.and_then(|plan| plan.walk().map(|walk| (plan, walk))))
    }

    /// The built-in plan of a movement of a figure between a walk and standing, if there is one. Its speed and cycle
    /// are the walk's.
    pub(super) fn of_movement(movement: &str, human: &Human, walk: &Solution) -> Result<Option<WalkPlan>, TomlError> {
        let Some((_, text)) = MOVEMENTS.iter().find(|(name, _)| *name == movement) else { return Ok(None) };
        let plan = WalkPlan::from_toml(text)?;
        let is_same = |own: Walk| (own.speed() - walk.speed()).abs() < SAME;
        let is_of_walk = (plan.cycle_s - walk.cycle_s()).abs() < SAME && plan.walk().is_some_and(is_same);
        let has_joints = human.model.coordinates().iter().map(|coordinate| &coordinate.name).eq(&plan.coordinates);
        Ok(Some(plan).filter(|plan| plan.build == human.build && has_joints && is_of_walk))
    }

    /// The walk that the plan solves.
    fn walk(&self) -> Option<Walk> {
        let mut gait = Gait::named("free").ok()?;
        gait.pace.speed = Some(Speed::Dimensionless(self.speed));
        let leg_length = self.build.human().ok()?.dimensions.leg_length;
        let walk = Walk::new(&gait, leg_length, &mut Findings::default()).ok()?;
        self.is_for(&walk).then_some(walk)
    }

    fn is_for(&self, walk: &Walk) -> bool {
        (self.speed - walk.dimensionless_speed()).abs() < SAME && (self.cycle_s - walk.cycle_s()).abs() < SAME
    }

    /// The built-in plans of a figure.
    ///
    /// # Errors
    /// None of the built-in plans; a test reads them.
    pub fn built_in(table: SegmentTable) -> Result<Vec<WalkPlan>, TomlError> {
        FILES.iter().filter(|(of, _)| *of == table).map(|(_, text)| WalkPlan::from_toml(text)).collect()
    }

    /// The plan of a solved walk.
    #[must_use]
    pub fn new(build: Build, walk: &Walk, solution: &Solution) -> WalkPlan {
        WalkPlan {
            build,
            speed: walk.dimensionless_speed(),
            cycle_s: walk.cycle_s(),
            coordinates: solution
                .problem()
                .model
                .coordinates()
                .iter()
                .map(|coordinate| coordinate.name.clone())
                .collect(),
            coefficients: solution.unknowns().to_vec(),
        }
    }

    /// Reads a plan.
    ///
    /// # Errors
    /// Anything that [`WalkPlan::to_toml`] does not write, with line and key.
    pub fn from_toml(text: &str) -> Result<WalkPlan, TomlError> {
        let source = Source::new(text, DOCUMENT);
        let parsed = source.parse()?;
        let root = Table::root(&source, &parsed);
        root.only(&[&["figure", "mass", "height", "speed", "cycle_s", "coordinates", "coefficients"]])?;
        let tables = SegmentTable::ALL.map(|table| (table.name(), table));
        let build = Build {
            table: root.need("figure", "the table of segments")?.choice(&tables)?,
            mass: root.need("mass", "the body mass [kg]")?.above_zero()?,
            height: root.need("height", "the stature [m]")?.above_zero()?,
            toe_joint: true,
        };
        let names = root.need("coordinates", "names of the coordinates")?;
        let coordinates =
            names.list("a list of names")?.iter().map(|name| name.filled_text()).collect::<Result<Vec<_>, _>>()?;
        let mut coefficients = Vec::new();
        let expected = "one list of numbers per knot, with a number for each coordinate";
        for row in root.need("coefficients", "the coefficients of the splines")?.list(expected)? {
            let numbers = row.list(expected)?;
            if numbers.len() != coordinates.len() {
                return Err(row.wrong(expected));
            }
            for number in numbers {
                coefficients.push(number.number()?);
            }
        }
        Ok(WalkPlan {
            build,
            speed: root.need("speed", "the dimensionless speed")?.above_zero()?,
            cycle_s: root.need("cycle_s", "the duration of a cycle [s]")?.above_zero()?,
            coordinates,
            coefficients,
        })
    }

    /// The plan as a file.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let Build { table, mass, height, .. } = self.build;
        let names: Vec<String> = self.coordinates.iter().map(|name| format!("\"{name}\"")).collect();
        let row = |row: &[f64]| {
            let numbers: Vec<String> = row.iter().map(|number| format!("{number:.10}")).collect();
            format!("  [{}],\n", numbers.join(", "))
        };
        let rows: String = self.coefficients.chunks(names.len().max(1)).map(row).collect();
        format!(
            "# Optimal motion of a built-in figure: spline coefficients [rad or m], docs/OPTIMAL.md. Made by \
             `cargo xtask walk-plans`.\nfigure = \"{}\"\nmass = {mass}\nheight = {height}\nspeed = {}\ncycle_s \
             = {}\ncoordinates = [{}]\ncoefficients = [\n{rows}]\n",
            table.name(),
            self.speed,
            self.cycle_s,
            names.join(", ")
        )
    }
}
