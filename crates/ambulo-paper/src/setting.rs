//! A setting of the paper's mode: one value for everything that the paper does not give, and its file.
//!
//! A file has a name, a description, and the tables `figure`, `gait`, `ground` and `knots`. A value that a file leaves
//! out comes from the setting `papers-results`. Files that the program writes have all values.

use super::claim::{Claim, ClaimKind};
use super::error::ReproductionError;
use super::mode::{Run, TrialSettings, paper_walk_with};
use super::open_values::{KNOTS, OpenKind, OpenValue, open_values};
use super::paper_human::TABLE_FOOT;
use super::paper_settings::PaperSettings;
use ambulo_body::contact::HuntCrossley;
use ambulo_body::numerics::Random;
use ambulo_body::numerics::elementary::{exp, ln};
use ambulo_body::toml_reader::{Source, Table, TomlError, Value};
use ambulo_walk::engine::ImpactLaw;
use ambulo_walk::gait::{Gait, Style};
use std::fmt::Write;

/// The document that describes setting files.
const DOCUMENT: &str = "docs/REPRODUCTION.md";
/// Largest number of characters in a line of a written comment.
const LINE: usize = 110;

/// The settings that come with the program, the default first: name and file.
pub const NAMED: [(&str, &str); 2] = [
    ("papers-results", include_str!("../data/settings/papers-results.toml")),
    ("schwartz-children", include_str!("../data/settings/schwartz-children.toml")),
];

/// A value for everything that the paper does not give.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// Name in results.
    pub name: String,
    /// Description.
    pub about: String,
    /// Claims of the paper that are known to hold with it; `None` if it was not judged yet.
    pub holds: Option<Vec<String>>,
    /// One number for each of [`open_values`]; a switch is 0 or 1.
    values: Vec<f64>,
}

impl Setting {
    /// The setting in which the paper's own results appear: the default of `ambulo reproduce`.
    ///
    /// # Errors
    /// None is known.
    pub fn papers_results() -> Result<Setting, TomlError> {
        Setting::read(NAMED[0].1, None)
    }

    /// A setting that comes with the program.
    ///
    /// # Errors
    /// None is known for a setting that exists.
    pub fn named(name: &str) -> Option<Result<Setting, TomlError>> {
        NAMED.iter().find(|(own, _)| *own == name).map(|(_, text)| Setting::from_toml(text))
    }

    /// A setting from a file; values that it leaves out come from [`Setting::papers_results`].
    ///
    /// # Errors
    /// An unknown key, or a value that is not allowed, with its line.
    pub fn from_toml(text: &str) -> Result<Setting, TomlError> {
        Setting::read(text, Some(&Setting::papers_results()?))
    }

    fn read(text: &str, base: Option<&Setting>) -> Result<Setting, TomlError> {
        let source = Source::new(text, DOCUMENT);
        let parsed = source.parse()?;
        let root = Table::root(&source, &parsed);
        refuse_unknown(&root)?;
        let text = |key: &str, default: &str| {
            root.get(key).map_or_else(|| Ok(default.to_owned()), |value| value.filled_text())
        };
        let mut values = Vec::new();
        for (number, open) in open_values().iter().enumerate() {
            let own = find(&root, open)?;
            let default = base.map(|base| base.values[number]);
            let meaning = format!("{} ({})", open.what, open.shown_range());
            values.push(own.or(default).ok_or_else(|| root.missing(&open.name(), &meaning))?);
        }
        let (name, about) = (text("name", "own")?, text("about", "a setting of your own")?);
        Ok(Setting { name, about, holds: read_holds(&root)?, values })
    }

    /// The file of this setting, with range, source and reason of every value.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let mut text = String::from(
            "# A setting of the paper's mode: every value that the paper of 1997 does not give.\n\
             # Above each value: what it is, its plausible range, where the range is from, and why it is open.\n\n",
        );
        let _ = writeln!(text, "name = {}\nabout = {}", quoted(&self.name), quoted(&self.about));
        if let Some(holds) = &self.holds {
            let ids = holds.iter().map(|id| quoted(id)).collect::<Vec<String>>().join(", ");
            let _ = writeln!(
                text,
                "# Claims of the paper that hold with these values; a check fails if one of them does not.\nholds = \
                 [{ids}]"
            );
        }
        let mut table = "";
        for (open, value) in open_values().iter().zip(&self.values) {
            if open.table != table {
                table = open.table;
                let _ = writeln!(text, "\n[{table}]");
                text += &about_knots(open);
            }
            text += &self.line(open, *value);
        }
        text
    }

    /// The line of a value with its comment; time and angle of a knot share the line of the angle.
    fn line(&self, open: &OpenValue, value: f64) -> String {
        let shown = match open.kind {
            OpenKind::Switch(_) => (value > 0.5).to_string(),
            _ => format!("{value:?}"),
        };
        match open.of_knot {
            None => format!("{}{} = {shown}\n", comment(open), open.key),
            Some(of_knot) if of_knot == KNOT_KEYS[0] => format!("\"{}\" = {{ {of_knot} = {shown}, ", open.key),
            Some(of_knot) => format!("{of_knot} = {shown} }}\n"),
        }
    }

    /// Values drawn from their ranges; equal seeds and numbers give equal values.
    #[must_use]
    pub fn drawn(seed: u64, number: u64) -> Setting {
        let mut random = Random::new(seed, number);
        let draw = |open: &OpenValue| {
            let share = random.share();
            match open.kind {
                OpenKind::Number([least, most]) => least + share * (most - least),
                OpenKind::Positive([least, most]) => exp(ln(least) + share * (ln(most) - ln(least))),
                OpenKind::Switch(yes) => f64::from(u8::from(share < yes)),
            }
        };
        let values = open_values().iter().map(draw).collect();
        let (name, about) = (format!("drawn-{seed}-{number}"), "values drawn from their ranges".into());
        Setting { name, about, holds: None, values }
    }

    /// The claims of [`Setting::holds`] that do not hold; `None` if the setting was not judged before.
    #[must_use]
    pub fn lost(&self, claims: &[Claim]) -> Option<Vec<String>> {
        let holds = |id: &String| claims.iter().any(|claim| claim.id == *id && claim.pass);
        Some(self.holds.as_ref()?.iter().filter(|id| !holds(id)).cloned().collect())
    }

    /// The same setting with the claims of the paper that hold with it.
    #[must_use]
    pub fn judged(&self, claims: &[Claim]) -> Setting {
        let own = claims.iter().filter(|claim| claim.kind == ClaimKind::Paper && claim.pass);
        Setting { holds: Some(own.map(|claim| claim.id.to_owned()).collect()), ..self.clone() }
    }

    /// The same setting with another value at a place in the list of [`open_values`].
    #[must_use]
    pub fn with(&self, place: usize, value: f64) -> Setting {
        let mut other = self.clone();
        other.values[place] = value;
        other
    }

    /// Numbers in the order of [`open_values`]; a switch is 0 or 1.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The value of a key outside of the knots; NaN if there is no such key.
    #[must_use]
    pub fn of(&self, key: &str) -> f64 {
        let place = open_values().iter().position(|open| open.of_knot.is_none() && open.key == key);
        place.map_or(f64::NAN, |place| self.values[place])
    }

    /// A gait of the paper with these values, as [`Setting::walk`] walks it.
    #[must_use]
    pub fn gait(&self, gait: &Gait) -> Gait {
        self.applied().gait(gait)
    }

    /// Simulates a walk of the paper's mode with these values.
    ///
    /// # Errors
    /// A gait that is not possible for the figure, or a walk that cannot be simulated.
    pub fn walk(&self, trial: &TrialSettings<'_>) -> Result<Run, ReproductionError> {
        paper_walk_with(&self.applied(), trial)
    }

    fn on(&self, key: &str) -> bool {
        self.of(key) > 0.5
    }

    /// As settings of figure, gaits, signals and ground.
    #[must_use]
    pub fn applied(&self) -> PaperSettings {
        let of = |key: &str| self.of(key);
        PaperSettings {
            height: Some(of("stature_m")),
            thickness: of("cross_section_factor"),
            sole_radii: of("sole_radius_factor"),
            toe_spheres: self.on("toe_spheres"),
            toe_reach: self.on("foot_of_table_1_from_the_ankle").then_some(TABLE_FOOT),
            arm_swing: of("arm_swing_factor"),
            hip_offset: of("hip_offset_deg").to_radians(),
            style: if self.on("quintics_1997") { Style::Paper1997 } else { Style::Knots },
            standard_step: of("standard_step_m"),
            angles_of_the_step: self.on("angles_of_the_step"),
            step_height: of("step_height_factor"),
            lengths: [1.0, of("long_step_length"), of("short_step_length"), of("goose_step_length")],
            heights: [1.0, of("long_step_height"), of("short_step_height"), of("goose_step_height")],
            straight_goose: self.on("goose_with_straight_knees"),
            knots: self.knots(),
            impact: if self.on("impact_cancels_all_velocity") { ImpactLaw::Sticking } else { ImpactLaw::Coulomb },
            soft_shoes: HuntCrossley {
                stiffness: 1e6 * of("soft_shoe_stiffness_mn_m2"),
                dissipation: of("soft_shoe_dissipation_s_m"),
                ..HuntCrossley::FALISSE_2022
            },
        }
    }

    /// Time [cycles] and angle [rad] that are added to each of [`KNOTS`].
    fn knots(&self) -> [[f64; 2]; KNOTS.len()] {
        let first = self.values.len() - 2 * KNOTS.len();
        std::array::from_fn(|k| {
            let [time, angle] = [self.values[first + 2 * k], self.values[first + 2 * k + 1]];
            [0.01 * time, angle.to_radians()]
        })
    }
}

/// Simulates a walk of the paper's mode with the values of [`Setting::papers_results`].
///
/// # Errors
/// A gait that is not possible for the figure, or a walk that cannot be simulated.
pub fn paper_walk(trial: &TrialSettings<'_>) -> Result<Run, ReproductionError> {
    Setting::papers_results()?.walk(trial)
}

/// Letters that a file may list: claims of the paper, now or formerly, that could fail.
pub const CLAIMS: [&str; 22] = [
    "a1", "c1", "c2", "c3", "c4", "d1", "e1", "e2", "e3", "f2", "g1", "g2", "g3", "h1", "h2", "h3", "h4", "i", "j",
    "m1", "m2", "n1",
];

/// Keys in the table of a knot.
const KNOT_KEYS: [&str; 2] = ["time_percent", "angle_deg"];
/// Keys of a file.
const KEYS: [&str; 7] = ["name", "about", "holds", "figure", "gait", "ground", "knots"];
/// Joints in the table `knots`.
const JOINTS: [&str; 3] = ["hip", "knee", "ankle"];

fn refuse_unknown(root: &Table<'_>) -> Result<(), TomlError> {
    root.only(&[&KEYS])?;
    for name in ["figure", "gait", "ground"] {
        if let Some(table) = table_of(root, name)? {
            table.only(&[&keys_of(name)])?;
        }
    }
    let Some(knots) = table_of(root, "knots")? else { return Ok(()) };
    knots.only(&[&JOINTS])?;
    for joint in JOINTS {
        let Some(of_joint) = table_of(&knots, joint)? else { continue };
        let names = keys_of(&format!("knots.{joint}"));
        of_joint.only(&[&names])?;
        for name in names {
            if let Some(knot) = table_of(&of_joint, name)? {
                knot.only(&[&KNOT_KEYS])?;
            }
        }
    }
    Ok(())
}

/// The claims that hold according to a file.
fn read_holds(root: &Table<'_>) -> Result<Option<Vec<String>>, TomlError> {
    let Some(value) = root.get("holds") else { return Ok(None) };
    let known = CLAIMS.map(|id| (id, id));
    let ids = value.list("a list of claims, such as [\"c1\", \"e1\"]")?;
    ids.iter().map(|id| id.choice(&known).map(str::to_owned)).collect::<Result<_, _>>().map(Some)
}

fn table_of<'t>(outer: &Table<'t>, key: &str) -> Result<Option<Table<'t>>, TomlError> {
    outer.get(key).map(|value| value.table("a table")).transpose()
}

fn keys_of(table: &str) -> Vec<&'static str> {
    let mut keys: Vec<&str> = open_values().iter().filter(|open| open.table == table).map(|open| open.key).collect();
    keys.dedup();
    keys
}

/// The number of an open value in a file, if the file has it.
fn find(root: &Table<'_>, open: &OpenValue) -> Result<Option<f64>, TomlError> {
    let mut names = open.table.split('.').chain(open.of_knot.map(|_| open.key));
    let Some(mut table) = names.next().map(|name| table_of(root, name)).transpose()?.flatten() else {
        return Ok(None);
    };
    for name in names {
        let Some(inner) = table_of(&table, name)? else { return Ok(None) };
        table = inner;
    }
    let key = open.of_knot.unwrap_or(open.key);
    table.get(key).map(|value| number_of(&table, &value, open)).transpose()
}

fn number_of(table: &Table<'_>, value: &Value<'_>, open: &OpenValue) -> Result<f64, TomlError> {
    if let OpenKind::Switch(_) = open.kind {
        return Ok(f64::from(u8::from(table.truth_or(open.key, false)?)));
    }
    let number = value.number()?;
    if open.allows(number) { Ok(number) } else { Err(value.wrong(&open.shown_range())) }
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\"").replace(char::is_control, " "))
}

/// Description, range, source and reason of a value, as lines of comment.
fn comment(open: &OpenValue) -> String {
    let text = format!("{}: {}. Range: {}. Open because {}.", open.what, open.shown_range(), open.source, open.why);
    wrapped(&text)
}

/// The comment of a table of knots.
fn about_knots(open: &OpenValue) -> String {
    if open.of_knot.is_none() {
        return String::new();
    }
    let [time, angle] = super::open_values::KNOT_RANGE;
    let text = format!(
        "Time [% of the cycle, -{time} to {time}] and angle [deg, -{angle} to {angle}] that are added to each bound of \
         the sub-cycles. The bounds: {}. Open because {}.",
        open.source, open.why
    );
    wrapped(&text)
}

fn wrapped(text: &str) -> String {
    let (mut lines, mut line) = (String::new(), String::from("#"));
    for word in text.split(' ') {
        if line.chars().count() + 1 + word.chars().count() > LINE {
            lines += &line;
            lines.push('\n');
            line = String::from("#");
        }
        line.push(' ');
        line += word;
    }
    lines + &line + "\n"
}
