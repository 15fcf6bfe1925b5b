//! The quantities that page and figures show, and how a file's number becomes the one that clinicians read.
//!
//! shown = factor x number of the file, with a factor of sign, side and body mass. Signs: docs/CONVENTIONS.md, "Signs in panels"; a test
//! reads every row of that table.

use ambulo::model::Side;

/// The kind of a quantity: panels of one kind stand together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ClinicalGroup {
    /// Angles [deg].
    Kinematics,
    /// Internal moments of joints [N.m/kg].
    Moments,
    /// Powers of joints [W/kg], given to the body where positive.
    Powers,
    /// Forces of the ground on a foot [body weights].
    Ground,
}

impl ClinicalGroup {
    /// What the names of `cycles.csv` end with.
    fn suffix(self) -> &'static str {
        match self {
            ClinicalGroup::Kinematics => "_angle",
            ClinicalGroup::Moments => "_moment",
            ClinicalGroup::Powers => "_power",
            ClinicalGroup::Ground => "",
        }
    }

    /// Unit of what is shown.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            ClinicalGroup::Kinematics => "deg",
            ClinicalGroup::Moments => "N.m/kg",
            ClinicalGroup::Powers => "W/kg",
            ClinicalGroup::Ground => "BW",
        }
    }
}

/// A quantity as it is shown: what it is called, what its signs mean, and where it stands in the files.
#[derive(Debug, Clone, PartialEq)]
pub struct ClinicalQuantity {
    /// A word without blanks, the same for every model: `hip_flexion_moment`, `knee_flexion_angle`.
    pub id: &'static str,
    /// `Hip flexion`.
    pub title: &'static str,
    /// `deg`, `N.m/kg`, `W/kg` or `BW`.
    pub unit: &'static str,
    /// What positive values mean: `extensor`.
    pub positive: &'static str,
    /// What negative values mean: `flexor`.
    pub negative: &'static str,
    /// Its kind.
    pub group: ClinicalGroup,
    /// Name in `cycles.csv`: `knee_angle_moment`.
    pub column: String,
    /// The coordinate without its side (`knee_angle`), as limits and tables over time know it; of ground forces their column.
    pub coordinate: &'static str,
    /// A coordinate of pelvis or trunk: files over time have one column of it, for both sides.
    pub central: bool,
    sign: Sign,
}

/// How the sign of a file's number becomes the one shown.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Sign {
    /// The same on both sides: +1 or -1.
    Both(f64),
    /// This on the right, the opposite on the left: coordinates of pelvis and trunk, which know right and left where a panel knows its
    /// own side and the other one.
    Right(f64),
    /// This times the direction of knee flexion.
    Knee(f64),
}

impl ClinicalQuantity {
    /// The number that turns the file's (deg, N.m, W, body weights) into the one shown, for the panel's `side`. `knee_flexion_sign` is
    /// that of [`knee_flexion_sign`].
    #[must_use]
    pub fn factor(&self, mass_kg: f64, side: Side, knee_flexion_sign: f64) -> f64 {
        let sign = match (self.sign, side) {
            (Sign::Both(sign), _) | (Sign::Right(sign), Side::Right) => sign,
            (Sign::Right(sign), Side::Left) => -sign,
            (Sign::Knee(sign), _) => sign * knee_flexion_sign,
        };
        match self.group {
            ClinicalGroup::Moments | ClinicalGroup::Powers => sign / mass_kg,
            ClinicalGroup::Kinematics | ClinicalGroup::Ground => sign,
        }
    }
}

/// The quantities that a table has, in the order to be shown; `has` says whether a name stands in its column `quantity`
/// (`cycles.csv`: `knee_angle_angle`). What a model cannot do (varus of a hinged knee) is not in the list.
#[must_use]
pub fn clinical_quantities(has: impl Fn(&str) -> bool) -> Vec<ClinicalQuantity> {
    ROWS.iter().filter_map(|row| row.found(&has)).collect()
}

/// +1 if knee flexion is the positive direction of the knee's coordinate, -1 if it is the negative one: the direction in which the knee
/// turns most. Negative in the Gait2392 family, positive in Rajagopal's. `angles` are the values of the coordinate `knee_angle` (or
/// `knee_flexion`) in the file, of all cycles.
pub fn knee_flexion_sign<'a>(angles: impl IntoIterator<Item = &'a f64>) -> f64 {
    let largest = angles.into_iter().fold(0.0_f64, |m, &x| if x.abs() > m.abs() { x } else { m });
    if largest < 0.0 { -1.0 } else { 1.0 }
}

/// Whether numbers of a unit (`BW`, `deg`, `N.m`, ...) change by more than rounding and filters make of a constant: a joint that is
/// locked and the sideways force of a body that moves in a plane do not.
pub(crate) fn moves(unit: &str, values: &[f64]) -> bool {
    let least = if unit == "BW" { 1e-5 } else { 1e-3 };
    let finite = || values.iter().copied().filter(|x| x.is_finite());
    finite().fold(f64::NEG_INFINITY, f64::max) - finite().fold(f64::INFINITY, f64::min) > least
}

/// The knee's coordinate in the files.
pub const KNEE: [&str; 2] = ["knee_angle", "knee_flexion"];

/// A row of the list: the same for all models but for the coordinate.
struct Row {
    id: &'static str,
    title: &'static str,
    directions: [&'static str; 2],
    group: ClinicalGroup,
    /// Coordinates that hold it, the first that exists counts.
    coordinates: &'static [(&'static str, Sign)],
}

impl Row {
    fn found(&self, has: impl Fn(&str) -> bool) -> Option<ClinicalQuantity> {
        let column = |coordinate: &str| format!("{coordinate}{}", self.group.suffix());
        let (coordinate, sign) = self.coordinates.iter().find(|(name, _)| has(&column(name)))?;
        Some(ClinicalQuantity {
            id: self.id,
            title: self.title,
            unit: self.group.unit(),
            positive: self.directions[0],
            negative: self.directions[1],
            group: self.group,
            column: column(coordinate),
            coordinate,
            central: coordinate.starts_with("pelvis_") || coordinate.starts_with("lumbar_"),
            sign: *sign,
        })
    }
}

const SAME: Sign = Sign::Both(1.0);
const TURNED: Sign = Sign::Both(-1.0);
/// Positive towards the right in the file, towards the own side in the panel.
const OWN: Sign = Sign::Right(1.0);
const OTHER: Sign = Sign::Right(-1.0);

const KINEMATICS: ClinicalGroup = ClinicalGroup::Kinematics;
const MOMENTS: ClinicalGroup = ClinicalGroup::Moments;
const POWERS: ClinicalGroup = ClinicalGroup::Powers;
const GROUND: ClinicalGroup = ClinicalGroup::Ground;

const fn row(
    id: &'static str,
    title: &'static str,
    directions: [&'static str; 2],
    group: ClinicalGroup,
    coordinates: &'static [(&'static str, Sign)],
) -> Row {
    Row { id, title, directions, group, coordinates }
}

const POWER: [&str; 2] = ["generated", "absorbed"];

/// All rows. Signs of the files: docs/CONVENTIONS.md, "Signs, one row for each movement".
#[rustfmt::skip]
const ROWS: &[Row] = &[
    row("pelvis_tilt_angle", "Pelvic tilt", ["anterior", "posterior"], KINEMATICS, &[("pelvis_tilt", TURNED)]),
    row("pelvis_obliquity_angle", "Pelvic obliquity", ["up", "down"], KINEMATICS, &[("pelvis_list", OTHER)]),
    row("pelvis_rotation_angle", "Pelvic rotation", ["forward", "backward"], KINEMATICS, &[("pelvis_rotation", OWN)]),
    row("hip_flexion_angle", "Hip flexion", ["flexion", "extension"], KINEMATICS, &[("hip_flexion", SAME)]),
    row("hip_adduction_angle", "Hip adduction", ["adduction", "abduction"], KINEMATICS, &[("hip_adduction", SAME), ("hip_abduction", TURNED)]),
    row("hip_rotation_angle", "Hip rotation", ["internal", "external"], KINEMATICS, &[("hip_rotation", SAME)]),
    row("knee_flexion_angle", "Knee flexion", ["flexion", "extension"], KINEMATICS, &[(KNEE[0], Sign::Knee(1.0)), (KNEE[1], Sign::Knee(1.0))]),
    row("knee_adduction_angle", "Knee adduction", ["varus", "valgus"], KINEMATICS, &[("knee_adduction", SAME)]),
    row("knee_rotation_angle", "Knee rotation", ["internal", "external"], KINEMATICS, &[("knee_rotation", SAME)]),
    row("ankle_dorsiflexion_angle", "Ankle dorsiflexion", ["dorsiflexion", "plantarflexion"], KINEMATICS, ANKLE),
    row("subtalar_angle", "Subtalar inversion", ["inversion", "eversion"], KINEMATICS, &[("subtalar_angle", SAME)]),
    row("trunk_lean_angle", "Trunk lean, to pelvis", ["forward", "backward"], KINEMATICS, &[("lumbar_extension", TURNED), ("lumbar_flexion", SAME)]),
    row("trunk_obliquity_angle", "Trunk obliquity, to pelvis", ["up", "down"], KINEMATICS, &[("lumbar_bending", OTHER)]),
    row("trunk_rotation_angle", "Trunk rotation, to pelvis", ["forward", "backward"], KINEMATICS, &[("lumbar_rotation", OWN)]),
    row("hip_flexion_moment", "Hip flexion moment", ["extensor", "flexor"], MOMENTS, &[("hip_flexion", TURNED)]),
    row("hip_adduction_moment", "Hip adduction moment", ["abductor", "adductor"], MOMENTS, &[("hip_adduction", TURNED), ("hip_abduction", SAME)]),
    row("hip_rotation_moment", "Hip rotation moment", ["external rotator", "internal rotator"], MOMENTS, &[("hip_rotation", TURNED)]),
    row("knee_flexion_moment", "Knee flexion moment", ["extensor", "flexor"], MOMENTS, &[(KNEE[0], Sign::Knee(-1.0)), (KNEE[1], Sign::Knee(-1.0))]),
    row("knee_adduction_moment", "Knee adduction moment", ["abductor", "adductor"], MOMENTS, &[("knee_adduction", TURNED)]),
    row("ankle_dorsiflexion_moment", "Ankle moment", ["plantarflexor", "dorsiflexor"], MOMENTS, &[("ankle_angle", TURNED), ("ankle_flexion", TURNED), ("ankle_dorsiflexion", TURNED)]),
    row("hip_flexion_power", "Hip power", POWER, POWERS, &[("hip_flexion", SAME)]),
    row("knee_flexion_power", "Knee power", POWER, POWERS, &[(KNEE[0], SAME), (KNEE[1], SAME)]),
    row("ankle_dorsiflexion_power", "Ankle power", POWER, POWERS, ANKLE),
    row("ground_force_vertical", "Vertical ground force", ["up", "down"], GROUND, &[("ground_force_vertical", SAME)]),
    row("ground_force_fore_aft", "Fore-aft ground force", ["forward", "backward"], GROUND, &[("ground_force_fore_aft", SAME)]),
    row("ground_force_lateral", "Sideways ground force", ["medial", "lateral"], GROUND, &[("ground_force_lateral", OTHER)]),
];

const ANKLE: &[(&str, Sign)] = &[("ankle_angle", SAME), ("ankle_flexion", SAME), ("ankle_dorsiflexion", SAME)];
