//! Writes `clinical.csv`: the motion and its forces in clinical signs and units, as on the report page.
//!
//! | group     | unit         | column                     |
//! |-----------|--------------|----------------------------|
//! | angles    | deg          | `knee_flexion_r`           |
//! | moments   | N.m/kg       | `knee_flexion_moment_r`    |
//! | powers    | W/kg         | `knee_flexion_power_r`     |
//! | ground    | body weights | `ground_force_vertical_r`  |
//!
//! Signs: docs/CONVENTIONS.md, "Signs in panels". In the clinical convention the angles of pelvis and hips come from
//! [`clinical_angles`]. Moments that no coordinate has come from the reactions in the joints
//! ([`ambulo::dynamics::JointMoments`]), and angles of the knee from the markers of its segments
//! ([`Outcome::knee_angles`]). All other numbers come from the files with OpenSim signs, times a constant.

use crate::clinical::{ClinicalGroup, ClinicalNames, ClinicalQuantity, clinical_quantities};
use ambulo::analysis::Analysis;
use ambulo::dynamics::JointMoments;
use ambulo::ground::feet;
use ambulo::ground::stances::StanceSource;
use ambulo::kinematics::{ClinicalAngles, clinical_angles};
use ambulo::model::anatomy::{Movement, PelvicFrame, PelvicFrameError};
use ambulo::model::{BySide, CoordinateId, Model, Side};
use ambulo::study::{ForceOrigin, Outcome, Tracking};
use ambulo_formats::table::{Table, TableRows};
use ambulo_results::{CLINICAL, Convention, ConventionSummary, JOINT_MOMENTS, OutputFile, ground_columns};
use std::collections::BTreeSet;
use std::rc::Rc;

/// The angles that differ between the conventions ([`ClinicalQuantity::id`]).
pub(crate) const PELVIS_AND_HIPS: [&str; 6] = [
    "pelvis_tilt_angle",
    "pelvis_obliquity_angle",
    "pelvis_rotation_angle",
    "hip_flexion_angle",
    "hip_adduction_angle",
    "hip_rotation_angle",
];

/// The angles that come from the markers of the segments where the knee of a body only flexes.
pub(crate) const KNEE_ANGLES: [&str; 2] = ["knee_adduction_angle", "knee_rotation_angle"];

/// `clinical.csv` of a run, and the convention of its angles.
#[must_use]
pub fn clinical_file(outcome: &Outcome, chosen: Convention) -> (OutputFile<'_>, ConventionSummary) {
    let (angles, convention) = angles_of(outcome, chosen);
    let table = move || {
        let curves = Curves::of(&outcome.body, outcome.complete(), angles.as_ref())
            .without(&outcome.not_measured)
            .with_knees(outcome.knee_angles());
        let columns = curves.columns(outcome.load_sources().as_ref());
        Ok(TableRows::of_table(&Rc::new(Table::new("Clinical curves", columns)?)))
    };
    (OutputFile::csv_by(CLINICAL, table), convention)
}

/// Angles of pelvis and hips in the clinical convention, if it is chosen and possible.
pub(crate) fn angles_of(outcome: &Outcome, chosen: Convention) -> (Option<ClinicalAngles>, ConventionSummary) {
    let opensim = |reason| (None, ConventionSummary { used: Convention::Opensim, reason });
    if chosen == Convention::Opensim {
        return opensim(None);
    }
    match pelvic_frame(outcome) {
        Ok(frame) => match clinical_angles(&outcome.body, &outcome.analysis.trajectory, &frame) {
            Some(angles) => (Some(angles), ConventionSummary { used: Convention::Clinical, reason: None }),
            None => opensim(Some("the model has no legs".to_owned())),
        },
        Err(error) => opensim(Some(error.to_string())),
    }
}

/// Clinical angles from markers on the iliac spines; built-in bodies without markers get the usual tilt.
fn pelvic_frame(outcome: &Outcome) -> Result<PelvicFrame, PelvicFrameError> {
    let of_skeleton = matches!(outcome.tracking, Some(Tracking::Skeleton { .. }));
    let is_synthetic = matches!(outcome.force_origin, ForceOrigin::Simulated { .. });
    let of_markers = PelvicFrame::of_model(&outcome.body);
    of_markers.or_else(|error| match of_skeleton || is_synthetic {
        true => PelvicFrame::of_built_in(&outcome.body),
        false => Err(error),
    })
}

/// The data for the columns.
pub(crate) struct Curves<'a> {
    model: &'a Model,
    analysis: &'a Analysis,
    angles: Option<&'a ClinicalAngles>,
    /// Coordinates whose angles, moments and powers are no results.
    not_measured: &'a [CoordinateId],
    /// Moments of the legs in three planes.
    moments: JointMoments<'a>,
    /// Varus and internal rotation of knees from the markers of their segments [rad].
    knees: BySide<Option<[Vec<f64>; 2]>>,
    /// Columns of `grf.mot` [N, m, N.m].
    ground: Vec<(String, Vec<f64>)>,
    /// The mass that moments, powers and ground forces are divided by [kg].
    mass_kg: f64,
}

impl<'a> Curves<'a> {
    pub(crate) fn of(model: &'a Model, analysis: &'a Analysis, angles: Option<&'a ClinicalAngles>) -> Curves<'a> {
        let frames = analysis.trajectory.grid().frames;
        let ground = match analysis.ground.bodies.is_empty() {
            true => Vec::new(),
            false => ground_columns(&feet(model, &analysis.ground), frames),
        };
        let moments = analysis.joint_moments(model);
        let (knees, mass_kg) = (BySide::default(), analysis.mass.kg);
        Curves { model, analysis, angles, not_measured: &[], moments, knees, ground, mass_kg }
    }

    /// The same with angles of knees from the markers of their segments.
    pub(crate) fn with_knees(self, knees: BySide<Option<[Vec<f64>; 2]>>) -> Curves<'a> {
        Curves { knees, ..self }
    }

    /// These curves without the quantities of coordinates that are not measured.
    pub(crate) fn without(self, not_measured: &'a [CoordinateId]) -> Curves<'a> {
        Curves { not_measured, ..self }
    }

    /// These curves per another mass [kg], such as the mass of a body shared by several trials.
    pub(crate) fn per_mass(self, mass_kg: f64) -> Curves<'a> {
        Curves { mass_kg, ..self }
    }

    /// The columns of the table. `sources` says where loads come from ([`Outcome::load_sources`]); values that depend
    /// on an unknown load are NaN.
    fn columns(&self, sources: Option<&BySide<Vec<f64>>>) -> Vec<(String, Vec<f64>)> {
        let mut columns = vec![("time".to_owned(), self.analysis.trajectory.grid().times())];
        for quantity in self.quantities() {
            let of_side = sources.filter(|_| quantity.group != ClinicalGroup::Kinematics);
            for side in Side::BOTH {
                let known = |values: Vec<f64>| known(values, of_side.map(|sources| &*sources[side]));
                let values = self.values(&quantity, side).map(known);
                columns.extend(values.map(|values| (quantity.clinical_column(side), values)));
            }
        }
        let mark = |side: Side| Some((format!("ground_source_{}", side.letter()), sources?[side].clone()));
        columns.extend(Side::BOTH.into_iter().filter_map(mark));
        columns
    }

    /// The quantities of the body.
    pub(crate) fn quantities(&self) -> Vec<ClinicalQuantity> {
        let stems = self.model.coordinate_ids().map(|id| self.model.coordinate_stem(id));
        let mut names: BTreeSet<String> =
            stems.flat_map(|stem| ["angle", "moment", "power"].map(|what| format!("{stem}_{what}"))).collect();
        names.extend(JOINT_MOMENTS.map(|(name, _)| name.to_owned()));
        if self.knees.values().any(Option::is_some) {
            names.extend(KNEE_ANGLES.map(str::to_owned));
        }
        if !self.ground.is_empty() {
            names.extend(["vertical", "fore_aft", "lateral"].map(|axis| format!("ground_force_{axis}")));
        }
        clinical_quantities(&ClinicalNames::of_model(self.model), |name| names.contains(name))
    }

    /// Whether a quantity follows from a coordinate that is not measured.
    fn is_unmeasured(&self, quantity: &ClinicalQuantity, side: Side) -> bool {
        let is_above = |movement| self.model.anatomy().is_any_above(self.not_measured, movement, side);
        if quantity.derived.is_some_and(is_above) {
            return true;
        }
        self.coordinate(quantity, side).is_some_and(|id| self.not_measured.contains(&id))
    }

    /// A quantity of a side over the frames, in clinical signs and units; `None` if the body lacks it, or if it is not
    /// measured.
    pub(crate) fn values(&self, quantity: &ClinicalQuantity, side: Side) -> Option<Vec<f64>> {
        if self.is_unmeasured(quantity, side) {
            return None;
        }
        let factor = quantity.factor(self.mass_kg, side);
        let scaled = |values: &[f64], factor: f64| values.iter().map(|x| factor * x).collect();
        let forces = &self.analysis.forces;
        match quantity.group {
            ClinicalGroup::Kinematics => {
                if let Some(movement) = quantity.derived {
                    let [varus, turn] = self.knees[side].as_ref()?;
                    let angle = if movement == Movement::KneeAdduction { varus } else { turn };
                    return Some(scaled(angle, factor * 1.0_f64.to_degrees()));
                }
                self.angles.and_then(|angles| clinical_angle(angles, quantity.id, side)).or_else(|| {
                    let values = self.analysis.trajectory.values(self.coordinate(quantity, side)?);
                    Some(scaled(values, factor * 1.0_f64.to_degrees()))
                })
            }
            ClinicalGroup::Moments => match quantity.derived {
                Some(movement) => Some(scaled(&self.moments.column(movement, side)?, factor)),
                None => Some(scaled(&forces.generalized[self.coordinate(quantity, side)?.index()], factor)),
            },
            ClinicalGroup::Powers => {
                Some(scaled(&self.analysis.powers(self.model).column(self.coordinate(quantity, side)?), factor))
            }
            ClinicalGroup::Ground => {
                let axis = ground_axis(&quantity.coordinates[side])?;
                let column = format!("ground_force_{}_v{axis}", side.letter());
                let (_, values) = self.ground.iter().find(|(name, _)| *name == column)?;
                Some(scaled(values, factor / (self.mass_kg * self.model.gravity().norm())))
            }
        }
    }

    /// The coordinate of a quantity on a side; `None` if the model lacks the leg.
    fn coordinate(&self, quantity: &ClinicalQuantity, side: Side) -> Option<CoordinateId> {
        let id = self.model.coordinate(&quantity.coordinates[side])?;
        let is_own = quantity.central || self.model.anatomy().coordinate_side(id) == Some(side);
        is_own.then_some(id)
    }
}

/// Values that depend on the load of a foot; NaN where the load is unknown.
fn known(mut values: Vec<f64>, sources: Option<&[f64]>) -> Vec<f64> {
    let unknown = StanceSource::Unknown.number();
    let is_unknown = |source: &f64| source.total_cmp(&unknown).is_eq();
    for (value, _) in values.iter_mut().zip(sources.unwrap_or_default()).filter(|(_, source)| is_unknown(source)) {
        *value = f64::NAN;
    }
    values
}

/// An angle of pelvis or hip in the clinical convention [deg], for the panel's side; `None` for other quantities.
pub(crate) fn clinical_angle(angles: &ClinicalAngles, quantity_id: &str, side: Side) -> Option<Vec<f64>> {
    let own = if side == Side::Right { 1.0 } else { -1.0 };
    let hip = || angles.hips[side].as_ref();
    let (values, sign) = match quantity_id {
        "pelvis_tilt_angle" => (&angles.pelvic_tilt, 1.0),
        "pelvis_obliquity_angle" => (&angles.pelvic_obliquity, own),
        "pelvis_rotation_angle" => (&angles.pelvic_rotation, own),
        "hip_flexion_angle" => (&hip()?[0], 1.0),
        "hip_adduction_angle" => (&hip()?[1], 1.0),
        "hip_rotation_angle" => (&hip()?[2], 1.0),
        _ => return None,
    };
    Some(values.iter().map(|x| sign * x.to_degrees()).collect())
}

/// The axis of a ground force in `grf.mot`, by its name in `cycles.csv`.
pub(crate) fn ground_axis(name: &str) -> Option<&'static str> {
    match name {
        "ground_force_fore_aft" => Some("x"),
        "ground_force_vertical" => Some("y"),
        "ground_force_lateral" => Some("z"),
        _ => None,
    }
}
