//! The limits of all checks, by default or from a file.

use super::verdict::Check;
use crate::optimal::{ECCENTRIC, StrengthCurve};
use crate::toml_reader::{Source, Table, TomlError, Value};

/// Limits of every check. docs/JUDGEMENT.md gives the reasons for the defaults.
#[derive(Debug, Clone, PartialEq)]
pub struct Thresholds {
    /// Shorter violations are noise [s]; two frames at 60 Hz are longer.
    pub shortest_s: f64,
    /// Checks that are skipped.
    pub skip: Vec<Check>,
    /// Body mass for the strength [kg]; `None`: the person's.
    pub mass_kg: Option<f64>,
    /// Stature for the strength [m]; `None`: the person's.
    pub height_m: Option<f64>,
    /// Share of the strength that may be used.
    pub strength_share: f64,
    /// Coordinates that have a share of the usual strength, built-in or from a table, and the share.
    pub weak: Vec<(String, f64)>,
    /// Tolerance for errors of the joint moment [N.m/kg]: body weight times 10 mm of the centre of pressure.
    pub strength_tolerance_nm_kg: f64,
    /// Largest moment of stretched muscles, in isometric moments.
    pub eccentric: f64,
    /// Strength of single coordinates, not scaled [N.m]; replaces the built-in one.
    pub tables: Vec<(String, StrengthCurve)>,
    /// Coefficient of friction between sole and ground.
    pub friction: f64,
    /// Friction is checked for feet that carry at least this [body weights].
    pub friction_load_bw: f64,
    /// Largest distance of a centre of pressure outside the sole [m].
    pub sole_margin_m: f64,
    /// Centres of pressure are checked for feet that carry at least this [body weights].
    pub sole_load_bw: f64,
    /// Longest time without a loaded foot [s].
    pub flight_s: f64,
    /// Largest speed of a loaded sole along the ground [m/s].
    pub sliding_m_s: f64,
    /// Sliding is checked for feet that carry at least this [body weights].
    pub sliding_load_bw: f64,
    /// Largest excess over a joint's range [rad].
    pub range_slack_rad: f64,
    /// Largest power generated at a coordinate [W/kg].
    pub generation_w_kg: f64,
    /// Largest power absorbed at a coordinate [W/kg].
    pub absorption_w_kg: f64,
    /// Largest residual force [body weights].
    pub support_bw: f64,
    /// Largest residual moment about the root [N.m/kg].
    pub balance_nm_kg: f64,
    /// Largest downward force of the ground that the motion may need [body weights].
    pub pull_bw: f64,
    /// Largest ratio of the acceleration of the mass centre to the one that the measured forces cause.
    pub acceleration_ratio: f64,
}

impl Default for Thresholds {
    fn default() -> Thresholds {
        Thresholds {
            shortest_s: 0.03,
            skip: Vec::new(),
            mass_kg: None,
            height_m: None,
            strength_share: 1.0,
            weak: Vec::new(),
            strength_tolerance_nm_kg: 0.1,
            eccentric: ECCENTRIC,
            tables: Vec::new(),
            friction: 0.6,
            friction_load_bw: 0.1,
            sole_margin_m: 0.03,
            sole_load_bw: 0.2,
            flight_s: 0.03,
            sliding_m_s: 0.4,
            sliding_load_bw: 0.5,
            range_slack_rad: 10_f64.to_radians(),
            generation_w_kg: 30.0,
            absorption_w_kg: 35.0,
            support_bw: 0.4,
            balance_nm_kg: 1.5,
            pull_bw: 0.3,
            acceleration_ratio: 1.5,
        }
    }
}

/// Larger moments are mistakes [N.m].
const LARGEST_MOMENT: f64 = 1e6;

impl Thresholds {
    /// Reads a file; missing keys keep their defaults.
    ///
    /// # Errors
    /// Text that is not TOML, unknown keys, values outside their range.
    pub fn from_toml(text: &str) -> Result<Thresholds, TomlError> {
        let source = Source::new(text, "docs/JUDGEMENT.md");
        let parsed = source.parse()?;
        let root = Table::root(&source, &parsed);
        const SECTIONS: [&str; 9] =
            ["person", "strength", "friction", "center_of_pressure", "flight", "sliding", "range", "power", "support"];
        root.only(&[&["shortest_s", "skip"], &SECTIONS])?;
        let mut t = Thresholds::default();
        read(&root, "shortest_s", [0.0, 1.0], &mut t.shortest_s)?;
        t.skip = skipped(&root)?;
        if let Some(person) = section(&root, "person", &["mass_kg", "height_m"])? {
            t.mass_kg = optional(&person, "mass_kg", [2.0, 300.0])?;
            t.height_m = optional(&person, "height_m", [0.4, 2.5])?;
        }
        if let Some(strength) = section(&root, "strength", &["share", "tolerance_nm_kg", "eccentric", "table"])? {
            read(&strength, "share", [0.0, 10.0], &mut t.strength_share)?;
            read(&strength, "tolerance_nm_kg", [0.0, 10.0], &mut t.strength_tolerance_nm_kg)?;
            read(&strength, "eccentric", [1.0, 3.0], &mut t.eccentric)?;
            t.tables = strength.tables("table")?.iter().map(strength_table).collect::<Result<_, _>>()?;
        }
        if let Some(friction) = section(&root, "friction", &["available", "least_load_bw"])? {
            read(&friction, "available", [0.0, 5.0], &mut t.friction)?;
            read(&friction, "least_load_bw", [0.0, 1.0], &mut t.friction_load_bw)?;
        }
        if let Some(sole) = section(&root, "center_of_pressure", &["margin_m", "least_load_bw"])? {
            read(&sole, "margin_m", [0.0, 1.0], &mut t.sole_margin_m)?;
            read(&sole, "least_load_bw", [0.0, 1.0], &mut t.sole_load_bw)?;
        }
        if let Some(flight) = section(&root, "flight", &["longest_s"])? {
            read(&flight, "longest_s", [0.0, 10.0], &mut t.flight_s)?;
        }
        if let Some(sliding) = section(&root, "sliding", &["speed_m_s", "least_load_bw"])? {
            read(&sliding, "speed_m_s", [0.0, 10.0], &mut t.sliding_m_s)?;
            read(&sliding, "least_load_bw", [0.0, 1.0], &mut t.sliding_load_bw)?;
        }
        if let Some(range) = section(&root, "range", &["slack_deg"])? {
            let slack_deg = optional(&range, "slack_deg", [0.0, 180.0])?;
            t.range_slack_rad = slack_deg.map_or(t.range_slack_rad, f64::to_radians);
        }
        if let Some(power) = section(&root, "power", &["generation_w_kg", "absorption_w_kg"])? {
            read(&power, "generation_w_kg", [0.0, 1000.0], &mut t.generation_w_kg)?;
            read(&power, "absorption_w_kg", [0.0, 1000.0], &mut t.absorption_w_kg)?;
        }
        if let Some(support) =
            section(&root, "support", &["force_bw", "moment_nm_kg", "pull_bw", "acceleration_ratio"])?
        {
            read(&support, "force_bw", [0.0, 100.0], &mut t.support_bw)?;
            read(&support, "moment_nm_kg", [0.0, 1000.0], &mut t.balance_nm_kg)?;
            read(&support, "pull_bw", [0.0, 100.0], &mut t.pull_bw)?;
            read(&support, "acceleration_ratio", [1.0, 100.0], &mut t.acceleration_ratio)?;
        }
        Ok(t)
    }

    /// Whether a check is made.
    #[must_use]
    pub(crate) fn judges(&self, check: Check) -> bool {
        !self.skip.contains(&check)
    }
}

/// The table under a key, if present; it may contain only the allowed keys.
fn section<'t>(root: &Table<'t>, key: &str, allowed: &[&str]) -> Result<Option<Table<'t>>, TomlError> {
    let Some(value) = root.get(key) else { return Ok(None) };
    let table = value.table(&format!("a table under the header [{key}]"))?;
    table.only(&[allowed])?;
    Ok(Some(table))
}

fn between(value: &Value<'_>, [least, most]: [f64; 2]) -> Result<f64, TomlError> {
    let expected = format!("a number from {least} to {most}");
    let number = value.finite(&expected)?;
    if (least..=most).contains(&number) { Ok(number) } else { Err(value.wrong(&expected)) }
}

fn optional(table: &Table<'_>, key: &str, range: [f64; 2]) -> Result<Option<f64>, TomlError> {
    table.get(key).map(|value| between(&value, range)).transpose()
}

/// Replaces the default if the key is present.
fn read(table: &Table<'_>, key: &str, range: [f64; 2], into: &mut f64) -> Result<(), TomlError> {
    if let Some(number) = optional(table, key, range)? {
        *into = number;
    }
    Ok(())
}

fn skipped(root: &Table<'_>) -> Result<Vec<Check>, TomlError> {
    let Some(value) = root.get("skip") else { return Ok(Vec::new()) };
    let words = Check::ALL.map(|check| (check.name(), check));
    value.list("a list of checks in quotes")?.iter().map(|entry| entry.choice(&words)).collect()
}

/// A strength table of the user, with the coordinate that it belongs to.
fn strength_table(table: &Table<'_>) -> Result<(String, StrengthCurve), TomlError> {
    table.only(&[&["coordinate", "angle_deg", "positive_nm", "negative_nm"]])?;
    let coordinate = table.need("coordinate", "a coordinate, such as \"lumbar_extension\"")?.filled_text()?;
    let angles_value = table.need("angle_deg", "a list of angles")?;
    let numbers = |value: &Value<'_>, expected: &str, range| -> Result<Vec<f64>, TomlError> {
        value.list(expected)?.iter().map(|entry| between(entry, range)).collect()
    };
    const ANGLES: &str = "a list of one or more increasing angles";
    let angles_deg = numbers(&angles_value, ANGLES, [-720.0, 720.0])?;
    if angles_deg.is_empty() || angles_deg.windows(2).any(|w| w[0] >= w[1]) {
        return Err(angles_value.wrong(ANGLES));
    }
    let moments = |key: &str| {
        let expected = format!("a list of {} moments [N.m], zero or more, one per angle", angles_deg.len());
        let value = table.need(key, &expected)?;
        let list = numbers(&value, &expected, [0.0, LARGEST_MOMENT])?;
        if list.len() == angles_deg.len() { Ok(list) } else { Err(value.wrong(&expected)) }
    };
    let (positive, negative) = (moments("positive_nm")?, moments("negative_nm")?);
    let angles = angles_deg.iter().map(|a| a.to_radians()).collect();
    Ok((coordinate, StrengthCurve { angles, positive, negative, hill: None }))
}
