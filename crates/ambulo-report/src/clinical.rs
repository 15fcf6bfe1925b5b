//! Clinical quantities of page and figures, and their conversion from the numbers in the files.
//!
//! shown = factor x number in the file; the factor depends on sign, side and body mass. Signs: docs/CONVENTIONS.md,
//! "Signs in panels"; a test reads every row of that table.

use ambulo::model::anatomy::Meaning;
use ambulo::model::{BySide, CoordinateId, Model, Movement, Side};

/// The kind of a quantity; panels of one kind form a group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ClinicalGroup {
    /// Angles [deg].
    Kinematics,
    /// Internal moments of joints [N.m/kg].
    Moments,
    /// Joint powers [W/kg]; positive if generated.
    Powers,
    /// Ground reaction forces on a foot [body weights].
    Ground,
}

impl ClinicalGroup {
    /// Ending of the names in `cycles.csv`.
    fn suffix(self) -> &'static str {
        match self {
            ClinicalGroup::Kinematics => "_angle",
            ClinicalGroup::Moments => "_moment",
            ClinicalGroup::Powers => "_power",
            ClinicalGroup::Ground => "",
        }
    }

    /// Displayed unit.
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

/// Coordinates of a model that measure clinical movements, and their signs.
#[derive(Debug, Clone)]
pub struct ClinicalNames {
    entries: Vec<Entry>,
}

#[derive(Debug, Clone)]
struct Entry {
    movement: Movement,
    side: Option<Side>,
    coordinate: String,
    /// Name without the side.
    stem: String,
    sign: f64,
}

impl ClinicalNames {
    /// Reads the names and signs of a model from its anatomy.
    #[must_use]
    pub fn of_model(model: &Model) -> ClinicalNames {
        let entry = |id: CoordinateId| {
            let Meaning { movement, side, sign } = model.anatomy().meaning(id)?;
            let coordinate = model.coordinates()[id.index()].name.clone();
            Some(Entry { movement, side, coordinate, stem: model.coordinate_stem(id), sign })
        };
        ClinicalNames { entries: model.coordinate_ids().filter_map(entry).collect() }
    }

    /// Names and signs of the built-in figures and of Gait2392.
    #[must_use]
    pub fn usual() -> ClinicalNames {
        let entries = USUAL.iter().flat_map(|(movement, stem, sign)| {
            let entry = |side: Option<Side>| Entry {
                movement: *movement,
                side,
                coordinate: side.map_or_else(|| (*stem).to_owned(), |side| format!("{stem}_{}", side.letter())),
                stem: (*stem).to_owned(),
                sign: *sign,
            };
            match is_central(*movement) {
                true => vec![entry(None)],
                false => Side::BOTH.map(|side| entry(Some(side))).to_vec(),
            }
        });
        ClinicalNames { entries: entries.collect() }
    }

    /// The usual names, for files without a model. The sign of `knee_angle` differs between models, so it is left out.
    #[must_use]
    pub fn without_model() -> ClinicalNames {
        let mut names = ClinicalNames::usual();
        names.entries.retain(|entry| entry.movement != Movement::KneeFlexion);
        names
    }

    /// The pelvis or trunk coordinate that measures a movement.
    #[must_use]
    pub fn central(&self, movement: Movement) -> Option<&str> {
        self.find(movement, Side::Right).filter(|entry| entry.side.is_none()).map(|entry| entry.coordinate.as_str())
    }

    fn find(&self, movement: Movement, side: Side) -> Option<&Entry> {
        let side = (!is_central(movement)).then_some(side);
        self.entries.iter().find(|entry| entry.movement == movement && entry.side == side)
    }
}

/// Coordinates and signs of the built-in figures.
const USUAL: [(Movement, &str, f64); 17] = [
    (Movement::PelvisForward, "pelvis_tx", 1.0),
    (Movement::PelvisUp, "pelvis_ty", 1.0),
    (Movement::PelvisRight, "pelvis_tz", 1.0),
    (Movement::PelvicTilt, "pelvis_tilt", -1.0),
    (Movement::PelvicObliquity, "pelvis_list", -1.0),
    (Movement::PelvicRotation, "pelvis_rotation", 1.0),
    (Movement::TrunkLean, "lumbar_extension", -1.0),
    (Movement::TrunkObliquity, "lumbar_bending", -1.0),
    (Movement::TrunkRotation, "lumbar_rotation", 1.0),
    (Movement::HipFlexion, "hip_flexion", 1.0),
    (Movement::HipAdduction, "hip_adduction", 1.0),
    (Movement::HipRotation, "hip_rotation", 1.0),
    (Movement::KneeFlexion, "knee_angle", -1.0),
    (Movement::KneeAdduction, "knee_adduction", 1.0),
    (Movement::KneeRotation, "knee_rotation", 1.0),
    (Movement::AnkleDorsiflexion, "ankle_angle", 1.0),
    (Movement::SubtalarInversion, "subtalar_angle", 1.0),
];

/// Movements of pelvis and trunk.
fn is_central(movement: Movement) -> bool {
    movement <= Movement::PelvisRight || movement >= Movement::TrunkLean
}

/// A displayed quantity: its name, the meaning of its signs, and its columns in the files.
#[derive(Debug, Clone, PartialEq)]
pub struct ClinicalQuantity {
    /// Identifier, the same for every model: `hip_flexion_moment`, `knee_flexion_angle`.
    pub id: &'static str,
    /// Title: `Hip flexion`.
    pub title: &'static str,
    /// Displayed unit: `deg`, `N.m/kg`, `W/kg` or `BW`.
    pub unit: &'static str,
    /// Meaning of positive values: `extensor`.
    pub positive: &'static str,
    /// Meaning of negative values: `flexor`.
    pub negative: &'static str,
    /// Kind of the quantity.
    pub group: ClinicalGroup,
    /// Name in `cycles.csv` for the cycles of each foot: `knee_angle_moment`.
    pub columns: BySide<String>,
    /// Coordinate of each side in files over time: `knee_angle_r`; for ground forces and derived quantities their name
    /// in `cycles.csv`.
    pub coordinates: BySide<String>,
    /// Whether it belongs to pelvis or trunk: files over time then have one column for both sides.
    pub central: bool,
    /// The movement of a quantity that no coordinate has: a moment from the reaction in the joint, or an angle from the
    /// markers of its segments. Over time it is in `clinical.csv` alone.
    pub derived: Option<Movement>,
    /// +1 or -1 for each side: displayed number = sign x number in the file.
    signs: BySide<f64>,
}

impl ClinicalQuantity {
    /// The factor from the number in the file (deg, N.m, W, body weights) to the displayed one, for the panel's `side`.
    #[must_use]
    pub fn factor(&self, mass_kg: f64, side: Side) -> f64 {
        match self.group {
            ClinicalGroup::Moments | ClinicalGroup::Powers => self.signs[side] / mass_kg,
            ClinicalGroup::Kinematics | ClinicalGroup::Ground => self.signs[side],
        }
    }

    /// Column of a side in `clinical.csv`: `knee_flexion_r`, `knee_flexion_moment_r`.
    #[must_use]
    pub(crate) fn clinical_column(&self, side: Side) -> String {
        format!("{}_{}", self.id.strip_suffix("_angle").unwrap_or(self.id), side.letter())
    }

    /// Whether a name in `cycles.csv` belongs to this quantity.
    #[must_use]
    pub(crate) fn has_column(&self, name: &str) -> bool {
        self.columns.values().any(|column| column == name)
    }
}

/// The quantities in a table, in display order; `has` returns whether its column `quantity` contains a name
/// (`cycles.csv`: `knee_angle_angle`). Movements that the model lacks (varus of a hinged knee) are left out.
#[must_use]
pub fn clinical_quantities(names: &ClinicalNames, has: impl Fn(&str) -> bool) -> Vec<ClinicalQuantity> {
    ROWS.iter().filter_map(|row| row.found(names, &has)).collect()
}

/// Title, unit and meaning of the signs of a quantity that is displayed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Wording {
    pub(crate) title: &'static str,
    pub(crate) unit: &'static str,
    /// Meaning of positive and of negative values.
    pub(crate) directions: [&'static str; 2],
}

/// The wording of a quantity of [`clinical_quantities`]; `None` for other names.
pub(crate) fn wording(id: &str) -> Option<Wording> {
    let row = ROWS.iter().find(|row| row.id == id)?;
    Some(Wording { title: row.title, unit: row.group.unit(), directions: row.directions })
}

/// The title of a column of `clinical.csv` without its side (`knee_flexion`, `knee_flexion_moment`), and the meaning of
/// its positive and of its negative values; `None` for other names.
#[must_use]
pub fn clinical_wording(column: &str) -> Option<(&'static str, [&'static str; 2])> {
    let known = wording(column).or_else(|| wording(&format!("{column}_angle")))?;
    Some((known.title, known.directions))
}

/// Whether numbers of a unit (`BW`, `deg`, `N.m`, ...) change by more than rounding and filters change a constant.
/// Joints that are locked, and the sideways force of a body that moves in a plane, do not.
pub(crate) fn moves(unit: &str, values: &[f64]) -> bool {
    let least = if unit == "BW" { 1e-5 } else { 1e-3 };
    let finite = || values.iter().copied().filter(|x| x.is_finite());
    finite().fold(f64::NEG_INFINITY, f64::max) - finite().fold(f64::INFINITY, f64::min) > least
}

/// A row of the list, the same for all models.
struct Row {
    id: &'static str,
    title: &'static str,
    directions: [&'static str; 2],
    group: ClinicalGroup,
    source: Source,
}

/// Where a row's numbers come from, and their sign.
#[derive(Clone, Copy)]
enum Source {
    /// A movement: +1 if the movement is displayed as positive.
    Movement(Movement, f64),
    /// The same for a movement defined for the right side: negated for the left side.
    Own(Movement, f64),
    /// A movement of a leg that may have no coordinate, with the sign of what is displayed: the angle then comes from
    /// the segments' markers, the moment from the joint's reaction.
    Joint(Movement, f64),
    /// The same, always without the coordinate.
    Derived(Movement, f64),
    /// A ground force, with its signs on the right and the left.
    Ground(&'static str, [f64; 2]),
}

impl Row {
    fn found(&self, names: &ClinicalNames, has: impl Fn(&str) -> bool) -> Option<ClinicalQuantity> {
        let is_known = |movement| Side::BOTH.into_iter().any(|side| names.find(movement, side).is_some());
        let (movement, signs) = match self.source {
            Source::Ground(column, signs) => return self.named(column, signs, has),
            Source::Movement(movement, sign) => (movement, BySide { right: sign, left: sign }),
            Source::Own(movement, sign) => (movement, BySide { right: sign, left: -sign }),
            Source::Joint(movement, sign) if is_known(movement) => (movement, BySide { right: sign, left: sign }),
            Source::Joint(movement, sign) | Source::Derived(movement, sign) => {
                let derived = is_known(Movement::HipAdduction).then_some(movement)?;
                let found = self.named(self.id, [sign; 2], has)?;
                return Some(ClinicalQuantity { derived: Some(derived), ..found });
            }
        };
        // A missing leg gets the names of the other leg.
        let entries = BySide::from_fn(|side| names.find(movement, side).or_else(|| names.find(movement, side.other())));
        let entries = entries.both()?;
        let columns = entries.map(|entry| format!("{}{}", entry.stem, self.group.suffix()));
        if !columns.values().any(|column| has(column)) {
            return None;
        }
        let of_file = |side: Side| if self.group == ClinicalGroup::Powers { 1.0 } else { entries[side].sign };
        let signs = BySide::from_fn(|side| signs[side] * of_file(side));
        Some(self.quantity(columns, entries.map(|entry| entry.coordinate.clone()), signs))
    }

    /// A quantity that belongs to no coordinate, with the same name on both sides.
    fn named(&self, column: &str, signs: [f64; 2], has: impl Fn(&str) -> bool) -> Option<ClinicalQuantity> {
        let columns = BySide::from([column, column]).map(str::to_owned);
        has(column).then(|| self.quantity(columns.clone(), columns, signs.into()))
    }

    fn quantity(&self, columns: BySide<String>, coordinates: BySide<String>, signs: BySide<f64>) -> ClinicalQuantity {
        let central = match self.source {
            Source::Movement(movement, _) | Source::Own(movement, _) => is_central(movement),
            Source::Joint(..) | Source::Derived(..) | Source::Ground(..) => false,
        };
        ClinicalQuantity {
            id: self.id,
            title: self.title,
            unit: self.group.unit(),
            positive: self.directions[0],
            negative: self.directions[1],
            group: self.group,
            columns,
            coordinates,
            central,
            derived: None,
            signs,
        }
    }
}

const fn row(
    id: &'static str,
    title: &'static str,
    directions: [&'static str; 2],
    group: ClinicalGroup,
    source: Source,
) -> Row {
    Row { id, title, directions, group, source }
}

const fn same(movement: Movement) -> Source {
    Source::Movement(movement, 1.0)
}

/// Moments are internal: muscles that oppose the movement are positive.
const fn against(movement: Movement) -> Source {
    Source::Movement(movement, -1.0)
}

/// The right side's movement, towards the panel's own side.
const fn own(movement: Movement) -> Source {
    Source::Own(movement, 1.0)
}

const KINEMATICS: ClinicalGroup = ClinicalGroup::Kinematics;
const MOMENTS: ClinicalGroup = ClinicalGroup::Moments;
const POWERS: ClinicalGroup = ClinicalGroup::Powers;
const GROUND: ClinicalGroup = ClinicalGroup::Ground;

const POWER: [&str; 2] = ["generated", "absorbed"];
const ROTATORS: [&str; 2] = ["external rotator", "internal rotator"];

/// All rows. Signs of the movements: [`Movement`]; of panels: docs/CONVENTIONS.md, "Signs in panels".
#[rustfmt::skip]
const ROWS: &[Row] = &[
    row("pelvis_tilt_angle", "Pelvic tilt", ["anterior", "posterior"], KINEMATICS, same(Movement::PelvicTilt)),
    row("pelvis_obliquity_angle", "Pelvic obliquity", ["up", "down"], KINEMATICS, own(Movement::PelvicObliquity)),
    row("pelvis_rotation_angle", "Pelvic rotation", ["forward", "backward"], KINEMATICS, own(Movement::PelvicRotation)),
    row("hip_flexion_angle", "Hip flexion", ["flexion", "extension"], KINEMATICS, same(Movement::HipFlexion)),
    row("hip_adduction_angle", "Hip adduction", ["adduction", "abduction"], KINEMATICS, same(Movement::HipAdduction)),
    row("hip_rotation_angle", "Hip rotation", ["internal", "external"], KINEMATICS, same(Movement::HipRotation)),
    row("knee_flexion_angle", "Knee flexion", ["flexion", "extension"], KINEMATICS, same(Movement::KneeFlexion)),
    row("knee_adduction_angle", "Knee adduction", ["varus", "valgus"], KINEMATICS,
        Source::Joint(Movement::KneeAdduction, 1.0)),
    row("knee_rotation_angle", "Knee rotation", ["internal", "external"], KINEMATICS,
        Source::Joint(Movement::KneeRotation, 1.0)),
    row("ankle_dorsiflexion_angle", "Ankle dorsiflexion", ["dorsiflexion", "plantarflexion"], KINEMATICS,
        same(Movement::AnkleDorsiflexion)),
    row("subtalar_angle", "Subtalar inversion", ["inversion", "eversion"], KINEMATICS,
        same(Movement::SubtalarInversion)),
    row("trunk_lean_angle", "Trunk lean, to pelvis", ["forward", "backward"], KINEMATICS, same(Movement::TrunkLean)),
    row("trunk_obliquity_angle", "Trunk obliquity, to pelvis", ["up", "down"], KINEMATICS,
        own(Movement::TrunkObliquity)),
    row("trunk_rotation_angle", "Trunk rotation, to pelvis", ["forward", "backward"], KINEMATICS,
        own(Movement::TrunkRotation)),
    row("hip_flexion_moment", "Hip flexion moment", ["extensor", "flexor"], MOMENTS, against(Movement::HipFlexion)),
    row("hip_adduction_moment", "Hip adduction moment", ["abductor", "adductor"], MOMENTS,
        against(Movement::HipAdduction)),
    row("hip_rotation_moment", "Hip rotation moment", ROTATORS, MOMENTS, Source::Joint(Movement::HipRotation, -1.0)),
    row("knee_flexion_moment", "Knee flexion moment", ["extensor", "flexor"], MOMENTS, against(Movement::KneeFlexion)),
    row("knee_adduction_moment", "Knee adduction moment", ["abductor", "adductor"], MOMENTS,
        Source::Joint(Movement::KneeAdduction, -1.0)),
    row("knee_rotation_moment", "Knee rotation moment", ROTATORS, MOMENTS, Source::Joint(Movement::KneeRotation, -1.0)),
    row("ankle_dorsiflexion_moment", "Ankle moment", ["plantarflexor", "dorsiflexor"], MOMENTS,
        against(Movement::AnkleDorsiflexion)),
    row("ankle_inversion_moment", "Ankle inversion moment", ["evertor", "invertor"], MOMENTS,
        Source::Derived(Movement::SubtalarInversion, -1.0)),
    row("ankle_rotation_moment", "Ankle rotation moment", ROTATORS, MOMENTS, Source::Derived(Movement::FootRotation,
        -1.0)),
    row("hip_flexion_power", "Hip power", POWER, POWERS, same(Movement::HipFlexion)),
    row("knee_flexion_power", "Knee power", POWER, POWERS, same(Movement::KneeFlexion)),
    row("ankle_dorsiflexion_power", "Ankle power", POWER, POWERS, same(Movement::AnkleDorsiflexion)),
    row("ground_force_vertical", "Vertical ground force", ["up", "down"], GROUND,
        Source::Ground("ground_force_vertical", [1.0, 1.0])),
    row("ground_force_fore_aft", "Fore-aft ground force", ["forward", "backward"], GROUND,
        Source::Ground("ground_force_fore_aft", [1.0, 1.0])),
    row("ground_force_lateral", "Sideways ground force", ["medial", "lateral"], GROUND,
        Source::Ground("ground_force_lateral", [-1.0, 1.0])),
];
