//! Every value that the paper does not give, with its range, source and reason.
//!
//! A [`Setting`](super::Setting) has a value for each of them. Times and angles of knots are added to the knots of
//! the curves in `ambulo-walk/data/gait/sub_cycles_1997.toml`, before step length and step height scale the angles.

use ambulo_walk::gait::LegJoint;
use std::sync::LazyLock;

/// Kind and range of a value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OpenKind {
    /// A number with its least and largest plausible value.
    Number([f64; 2]),
    /// A positive number whose logarithm is drawn.
    Positive([f64; 2]),
    /// Yes or no, with the share of the drawn settings in which it is yes.
    Switch(f64),
}

/// A value that the paper does not give.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenValue {
    /// Table of a setting file.
    pub table: &'static str,
    /// Key in this table; for a knot its name.
    pub key: &'static str,
    /// Key in the table of a knot.
    pub of_knot: Option<&'static str>,
    /// Quantity.
    pub what: String,
    /// Unit, if it has one.
    pub unit: &'static str,
    /// Number or switch, with the range.
    pub kind: OpenKind,
    /// Where the range is from.
    pub source: &'static str,
    /// Why the paper leaves it open and what a value means.
    pub why: &'static str,
    /// Other values whose effect on the claims is computed; a switch is reversed.
    pub tried: &'static [f64],
}

impl OpenValue {
    /// Name in tables: key, or joint, knot and quantity.
    #[must_use]
    pub fn name(&self) -> String {
        match self.of_knot {
            Some(of_knot) => format!("{}, {}: {of_knot}", self.table.trim_start_matches("knots."), self.key),
            None => self.key.to_owned(),
        }
    }

    /// Whether a number is allowed: in a plausible range, or 0 or 1 for a switch.
    #[must_use]
    pub fn allows(&self, value: f64) -> bool {
        match self.kind {
            OpenKind::Number([least, most]) | OpenKind::Positive([least, most]) => (least..=most).contains(&value),
            OpenKind::Switch(_) => [0.0, 1.0].iter().any(|of| (value - of).abs() < f64::EPSILON),
        }
    }

    /// A value in words, with its unit.
    #[must_use]
    pub fn shown(&self, value: f64) -> String {
        match self.kind {
            OpenKind::Switch(_) => if value > 0.5 { "yes" } else { "no" }.to_owned(),
            _ if self.unit.is_empty() => format!("{value}"),
            _ => format!("{value} {}", self.unit),
        }
    }

    /// The range in words.
    #[must_use]
    pub fn shown_range(&self) -> String {
        match self.kind {
            OpenKind::Switch(_) => "yes or no".to_owned(),
            OpenKind::Number([least, most]) | OpenKind::Positive([least, most]) => {
                format!("{least} to {most} {}", self.unit).trim_end().to_owned()
            }
        }
    }
}

/// All values that the paper does not give, in the order of a setting file.
#[must_use]
pub fn open_values() -> &'static [OpenValue] {
    static ALL: LazyLock<Vec<OpenValue>> = LazyLock::new(|| {
        let scalars = [("figure", &FIGURE[..]), ("gait", &ALL_GAITS), ("gait", &SINGLE_GAITS), ("ground", &GROUND)];
        scalars.iter().flat_map(|(table, rows)| rows.iter().map(|row| row.open(table))).chain(knots()).collect()
    });
    &ALL
}

/// The paper's gaits.
pub const GAITS: [&str; 4] = ["standard", "long", "short", "goose"];
/// Joint and name of every knot of the curves of style 1997.
pub const KNOTS: [(LegJoint, &str); 12] = [
    (LegJoint::Hip, "contact"),
    (LegJoint::Hip, "largest extension"),
    (LegJoint::Hip, "largest flexion"),
    (LegJoint::Knee, "stance peak"),
    (LegJoint::Knee, "stance minimum"),
    (LegJoint::Knee, "swing peak"),
    (LegJoint::Knee, "terminal minimum"),
    (LegJoint::Ankle, "contact"),
    (LegJoint::Ankle, "first plantarflexion"),
    (LegJoint::Ankle, "largest dorsiflexion"),
    (LegJoint::Ankle, "push-off peak"),
    (LegJoint::Ankle, "swing dorsiflexion"),
];
/// Largest plausible change of the time of a knot [% of the cycle] and of its angle [deg].
pub const KNOT_RANGE: [f64; 2] = [8.0, 5.0];

struct Row {
    key: &'static str,
    what: &'static str,
    unit: &'static str,
    kind: OpenKind,
    source: &'static str,
    why: &'static str,
    tried: &'static [f64],
}

impl Row {
    fn open(&self, table: &'static str) -> OpenValue {
        let Row { key, what, unit, kind, source, why, tried } = *self;
        OpenValue { table, key, of_knot: None, what: what.to_owned(), unit, kind, source, why, tried }
    }
}

/// Size, density, soles and arms.
const FIGURE: [Row; 6] = [
    Row {
        key: "stature_m",
        what: "stature",
        unit: "m",
        kind: OpenKind::Number([1.65, 1.95]),
        source: "two standard deviations of the stature of European men (unverified)",
        why: "section 4.1 has a male adult of 80 kg; its centre of mass at 1.2 m would require 2.1 m",
        tried: &[1.85],
    },
    Row {
        key: "cross_section_factor",
        what: "cross-section of the cylinders relative to that at 1050 kg/m³",
        unit: "",
        kind: OpenKind::Number([0.65, 1.5]),
        source: "1600 to 700 kg/m³; 1050 kg/m³ is the approximate density of the human body",
        why: "section 4.1 has uniform cylinders and no radii",
        tried: &[1.5],
    },
    Row {
        key: "sole_radius_factor",
        what: "radii of the spheres under the feet relative to 35, 25 and 15 mm",
        unit: "",
        kind: OpenKind::Number([0.6, 1.4]),
        source: "spheres of published foot models have radii of 20 to 35 mm at this stature",
        why: "section 4.1 has a sphere-plane contact and no radius",
        tried: &[1.0],
    },
    Row {
        key: "toe_spheres",
        what: "a third sphere of each foot, under the tip of the toes",
        unit: "",
        kind: OpenKind::Switch(0.5),
        source: "both readings are possible",
        why: "the paper does not say how many spheres a foot has: heel and ball, or also the tip of the toes",
        tried: &[],
    },
    Row {
        key: "foot_of_table_1_from_the_ankle",
        what: "the foot of 8.9 % of stature in Table 1 is the distance from the ankle to the tip of the toes",
        unit: "",
        kind: OpenKind::Switch(0.5),
        source: "yes is Table 1 taken literally, 16 cm; no: a foot of 15.2 % of stature (Drillis, Contini 1966)",
        why: "16 cm are too short for a whole foot, and are right in front of the ankle",
        tried: &[],
    },
    Row {
        key: "arm_swing_factor",
        what: "swing of shoulders and elbows relative to Boulic, Magnenat-Thalmann, Thalmann 1990",
        unit: "",
        kind: OpenKind::Number([0.0, 1.5]),
        source: "from no swing to half as much again",
        why: "section 4.1 has laws for the arms that gave a natural neutral swing",
        tried: &[0.0],
    },
];

/// Curves and steps of all gaits.
const ALL_GAITS: [Row; 5] = [
    Row {
        key: "hip_offset_deg",
        what: "angle that is added to the flexion of both hips",
        unit: "deg",
        kind: OpenKind::Number([-8.0, 8.0]),
        source: "mean pelvic tilt of people who walk, and as much in the other direction",
        why: "the zero of the hip angle depends on the angle of the trunk, which the paper only calls constant",
        tried: &[-5.0, 5.0],
    },
    Row {
        key: "quintics_1997",
        what: "the paper's quintics between the extremes of the curves",
        unit: "",
        kind: OpenKind::Switch(0.75),
        source: "no: the velocities and accelerations of Schwartz, Rozumalski, Trost 2008, without changes of \
                knots",
        why: "section 2.2 describes the quintics; Nilsson's bounds may be others than the extremes",
        tried: &[],
    },
    Row {
        key: "standard_step_m",
        what: "step length of the standard gait, at two steps per second",
        unit: "m",
        kind: OpenKind::Number([0.40, 0.85]),
        source: "slow to fast walking: 0.8 to 1.7 m/s",
        why: "section 4.1 has a slow walk, section 4.2 a velocity of 1.5 m/s, and no length",
        tried: &[0.50, 0.65],
    },
    Row {
        key: "angles_of_the_step",
        what: "the curves are those of the speed of this step, instead of those of 1.5 m/s scaled to its length",
        unit: "",
        kind: OpenKind::Switch(0.5),
        source: "both readings are possible",
        why: "section 2.1 lets the angles depend on velocity, section 2.2 scales angles by step length",
        tried: &[],
    },
    Row {
        key: "step_height_factor",
        what: "step height of all gaits relative to that of the curves",
        unit: "",
        kind: OpenKind::Number([0.8, 2.0]),
        source: "a scuffing foot to twice the clearance",
        why: "section 2.2 has a parameter for step height and no number",
        tried: &[1.0],
    },
];

/// Why lengths of single gaits, and heights, are open.
const PERIOD: &str = "section 4.5 gives the period of this gait alone";
const HEIGHT: &str = "section 2.2 makes gaits from step length, frequency and height";

/// Lengths and heights of single gaits relative to the standard gait.
const SINGLE_GAITS: [Row; 7] = [
    Row {
        key: "short_step_length",
        what: "step length of the short steps relative to the standard gait",
        unit: "",
        kind: OpenKind::Number([0.25, 0.80]),
        source: "0.62 has the speed of the standard gait; below 0.38 accelerations (length over period squared) are \
            lower",
        why: PERIOD,
        tried: &[0.38, 0.62],
    },
    Row {
        key: "short_step_height",
        what: "step height of the short steps relative to the standard gait",
        unit: "",
        kind: OpenKind::Number([0.8, 2.0]),
        source: "short angles lift the foot less, so the same clearance needs a factor above 1",
        why: HEIGHT,
        tried: &[1.0],
    },
    Row {
        key: "long_step_length",
        what: "step length of the long steps relative to the standard gait",
        unit: "",
        kind: OpenKind::Number([1.05, 1.35]),
        source: "up to the longest steps for which joint angles stay in the measured range",
        why: PERIOD,
        tried: &[1.1],
    },
    Row {
        key: "long_step_height",
        what: "step height of the long steps relative to the standard gait",
        unit: "",
        kind: OpenKind::Number([0.8, 1.3]),
        source: "long angles lift the foot more",
        why: HEIGHT,
        tried: &[],
    },
    Row {
        key: "goose_step_length",
        what: "step length of the goose steps relative to the standard gait",
        unit: "",
        kind: OpenKind::Number([0.8, 1.2]),
        source: "about that of the standard gait",
        why: PERIOD,
        tried: &[],
    },
    Row {
        key: "goose_step_height",
        what: "step height of the goose steps relative to the standard gait",
        unit: "",
        kind: OpenKind::Number([1.2, 2.0]),
        source: "a goose step is a high step",
        why: HEIGHT,
        tried: &[1.25],
    },
    Row {
        key: "goose_with_straight_knees",
        what: "the goose steps have the straight knees of the gait `parade`, at their own period",
        unit: "",
        kind: OpenKind::Switch(0.0),
        source: "the marching step of that name",
        why: "straight knees are no step height, so this is no gait of section 2.2; it is tried and not drawn",
        tried: &[],
    },
];

/// Impacts and soft shoes.
const GROUND: [Row; 3] = [
    Row {
        key: "impact_cancels_all_velocity",
        what: "an impact cancels the whole velocity of the contact point, also along the ground",
        unit: "",
        kind: OpenKind::Switch(0.75),
        source: "section 3.3: the relative velocity at the contact point is cancelled; no: Coulomb's law limits it",
        why: "the paper describes Coulomb's law for forces and does not mention it for impacts",
        tried: &[],
    },
    Row {
        key: "soft_shoe_stiffness_mn_m2",
        what: "modulus of the soft shoes",
        unit: "MN/m²",
        kind: OpenKind::Positive([0.3, 3.0]),
        source: "about the 1 MN/m² of Falisse 2022",
        why: "section 5 mentions soft shoes as current work",
        tried: &[0.3, 3.0],
    },
    Row {
        key: "soft_shoe_dissipation_s_m",
        what: "dissipation of the soft shoes",
        unit: "s/m",
        kind: OpenKind::Positive([1.0, 4.0]),
        source: "about the 2 s/m of Falisse 2022",
        why: "section 5 mentions soft shoes as current work",
        tried: &[],
    },
];

/// Time and angle of every knot.
fn knots() -> Vec<OpenValue> {
    let tables = ["knots.hip", "knots.knee", "knots.ankle"];
    let value = |(joint, key): &(LegJoint, &'static str), of_knot, quantity, unit, most: f64| OpenValue {
        table: tables[*joint as usize],
        key,
        of_knot: Some(of_knot),
        what: format!("{} of the {}'s {key}, added to that of the curve", quantity, joint.name()),
        unit,
        kind: OpenKind::Number([-most, most]),
        source: "Schwartz, Rozumalski, Trost 2008 (children), in place of Nilsson, Thorstensson, Halbertsma 1985",
        why: "Nilsson's tables are not available, and are of other people at other speeds",
        tried: &[],
    };
    let both = |knot| {
        let [time, angle] = KNOT_RANGE;
        [value(knot, "time_percent", "time", "% of the cycle", time), value(knot, "angle_deg", "angle", "deg", angle)]
    };
    KNOTS.iter().flat_map(both).collect()
}
