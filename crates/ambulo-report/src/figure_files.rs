//! Makes the figure files of a run.

use crate::clinical::{ClinicalNames, clinical_quantities};
use crate::clinical_file::{KNEE_ANGLES, angles_of, clinical_angle};
use crate::figures::{CycleFigures, FigureError, Mark, PredictedMotion, prediction_figure, residual_figure};
use crate::normative::dimensionless_speed;
use ambulo::analysis::feasibility::{Check, Person, Reason};
use ambulo::analysis::{Analysis, Cycle, over_cycle};
use ambulo::kinematics::ClinicalAngles;
use ambulo::model::anatomy::Movement;
use ambulo::model::{BySide, CoordinateId, Model, Side};
use ambulo::study::{Outcome, PredictedGround};
use ambulo_results::{Convention, CycleRow, JOINT_MOMENTS, OutputFile, cycle_rows};

/// `figures/quality.svg` and the figures of gait cycles, in which the reasons of a verdict are marked. Pelvis and hips
/// have the given angles, otherwise the coordinates of the model.
///
/// # Errors
/// A figure that could not be drawn.
pub fn figure_files(
    model: &Model,
    analysis: &Analysis,
    reasons: &[Reason],
    angles: Option<&ClinicalAngles>,
) -> Result<Vec<OutputFile<'static>>, FigureError> {
    Drawn { model, analysis, reasons, angles, not_measured: &[], knees: BySide::default() }.files()
}

/// Content of the figures of a run.
struct Drawn<'a> {
    model: &'a Model,
    analysis: &'a Analysis,
    reasons: &'a [Reason],
    angles: Option<&'a ClinicalAngles>,
    /// Coordinates whose curves are no results.
    not_measured: &'a [CoordinateId],
    /// Varus and internal rotation of knees from the markers of their segments [rad].
    knees: BySide<Option<[Vec<f64>; 2]>>,
}

impl Drawn<'_> {
    /// Whether a curve of a cycle is measured.
    fn is_measured(&self, row: &CycleRow) -> bool {
        let anatomy = self.model.anatomy();
        let of_joint = JOINT_MOMENTS.iter().find(|(name, _)| *name == row.quantity).map(|(_, movement)| *movement);
        let of_knee = KNEE_ANGLES.contains(&row.quantity.as_str()).then_some(Movement::KneeAdduction);
        if of_joint.or(of_knee).is_some_and(|movement| anatomy.is_any_above(self.not_measured, movement, row.side)) {
            return false;
        }
        !self.not_measured.iter().any(|id| {
            let is_of_side = anatomy.coordinate_side(*id).is_none_or(|side| side == row.side);
            let ending = row.quantity.strip_prefix(&self.model.coordinate_stem(*id));
            is_of_side && ending.is_some_and(|ending| ["_angle", "_moment", "_power"].contains(&ending))
        })
    }

    /// The angles of the knee of a cycle's leg, where no marker was lost.
    fn knee_rows(&self, cycle: &Cycle) -> Vec<CycleRow> {
        let grid = self.analysis.trajectory.grid();
        let row = |(name, angles): (&str, &Vec<f64>)| CycleRow {
            quantity: name.to_owned(),
            side: cycle.side,
            cycle: cycle.number,
            unit: "deg",
            values: over_cycle(grid, angles, cycle).into_iter().map(f64::to_degrees).collect(),
            foot_off_percent: cycle.foot_off_s.map(|t| 100.0 * (t - cycle.start_s) / (cycle.end_s - cycle.start_s)),
        };
        let rows = self.knees[cycle.side].iter().flat_map(|knee| KNEE_ANGLES.into_iter().zip(knee)).map(row);
        rows.filter(|row| row.values.iter().all(|value| value.is_finite())).collect()
    }

    fn files(&self) -> Result<Vec<OutputFile<'static>>, FigureError> {
        let Drawn { model, analysis, reasons, angles, .. } = *self;
        let mut files = Vec::new();
        let caption = caption(model, analysis);
        if let Some(svg) = residual_figure(model, analysis, &caption)? {
            files.push(OutputFile::new("figures/quality.svg", svg.into_bytes()));
        }
        let names = ClinicalNames::of_model(model);
        let mut rows = cycle_rows(model, analysis);
        rows.extend(analysis.cycles.iter().flat_map(|cycle| self.knee_rows(cycle)));
        rows.retain(|row| self.is_measured(row));
        if let Some(angles) = angles {
            replace_angles(&mut rows, angles, &names, analysis);
        }
        if !rows.is_empty() {
            let figures = CycleFigures {
                rows: &rows,
                names: &names,
                convention: if angles.is_some() { Convention::Clinical } else { Convention::Opensim },
                mass_kg: analysis.mass.kg,
                caption: &caption,
                marks: &marks(analysis, reasons),
                speed_dimensionless: speed_dimensionless(model, analysis),
            };
            files.extend(figures.files()?);
        }
        Ok(files)
    }
}

/// Replaces the rows of pelvis and hips by clinical angles, with the signs of `cycles.csv`.
fn replace_angles(rows: &mut [CycleRow], angles: &ClinicalAngles, names: &ClinicalNames, analysis: &Analysis) {
    let grid = analysis.trajectory.grid();
    for quantity in clinical_quantities(names, |_| true) {
        for row in rows.iter_mut().filter(|row| row.quantity == quantity.columns[row.side]) {
            let own = |cycle: &&Cycle| (cycle.side, cycle.number) == (row.side, row.cycle);
            let Some(cycle) = analysis.cycles.iter().find(own) else { continue };
            let Some(degrees) = clinical_angle(angles, quantity.id, row.side) else { continue };
            // The factor is +1 or -1, so it also converts displayed numbers back to the numbers of the file.
            let factor = quantity.factor(analysis.mass.kg, row.side);
            row.values = over_cycle(grid, &degrees, cycle).iter().map(|x| factor * x).collect();
        }
    }
}

/// Every figure of a run, with the same angles as [`clinical_file`](crate::clinical_file).
///
/// # Errors
/// A figure that could not be drawn.
pub fn outcome_figures(outcome: &Outcome, chosen: Convention) -> Result<Vec<OutputFile<'static>>, FigureError> {
    let (angles, _) = angles_of(outcome, chosen);
    let drawn = Drawn {
        model: &outcome.body,
        analysis: outcome.complete(),
        reasons: &outcome.verdict.reasons,
        angles: angles.as_ref(),
        not_measured: &outcome.not_measured,
        knees: outcome.knee_angles(),
    };
    let mut files = drawn.files()?;
    if let Some(PredictedGround { prediction, measured, .. }) = &outcome.prediction {
        let predicted = PredictedMotion { analysis: &outcome.analysis, prediction, measured: measured.as_ref() };
        let svg = prediction_figure(&outcome.body, predicted, &caption(&outcome.body, &outcome.analysis))?;
        files.extend(svg.map(|svg| OutputFile::new("figures/prediction.svg", svg.into_bytes())));
    }
    Ok(files)
}

/// V / sqrt(g L), if the speed is known and the model has legs.
fn speed_dimensionless(model: &Model, analysis: &Analysis) -> Option<f64> {
    dimensionless_speed(analysis.speed_m_s?, model.gravity().norm(), Person::of_model(model).leg_length_m)
}

/// The caption that describes the walk: `subject01, 72.8 kg, 1.12 m/s (V* = 0.37)`.
fn caption(model: &Model, analysis: &Analysis) -> String {
    let speed = analysis.speed_m_s.map(|v| format!(", {v:.2} m/s")).unwrap_or_default();
    let scaled = speed_dimensionless(model, analysis).map(|v| format!(" (V* = {v:.2})")).unwrap_or_default();
    format!("{}, {:.1} kg{speed}{scaled}", model.name(), analysis.mass.kg)
}

/// Reasons of the verdict by gait cycle. Reasons without a side are marked in the cycles of both feet.
fn marks(analysis: &Analysis, reasons: &[Reason]) -> Vec<Mark> {
    let pairs = reasons.iter().flat_map(|reason| analysis.cycles.iter().map(move |cycle| (reason, cycle)));
    let of_side = pairs.filter(|(reason, cycle)| reason.side.is_none_or(|side| side == cycle.side));
    let mark = |(reason, cycle): (&Reason, &Cycle)| {
        let [from, to] = reason.time_s.map(|t| (t - cycle.start_s) / (cycle.end_s - cycle.start_s));
        (to >= 0.0 && from <= 1.0).then(|| Mark {
            quantity: quantity(reason),
            side: cycle.side,
            cycle: cycle.number,
            percent: [from, to].map(|share| 100.0 * share.clamp(0.0, 1.0)),
        })
    };
    of_side.filter_map(mark).collect()
}

/// The quantity of a reason in `cycles.csv`; `None` for reasons that concern feet or the whole body.
fn quantity(reason: &Reason) -> Option<String> {
    let suffix = match reason.check {
        Check::Strength | Check::Power => "",
        Check::Range => "_angle",
        _ => return None,
    };
    let stem = Side::split_name(&reason.quantity).map_or_else(|| reason.quantity.clone(), |(_, stem)| stem);
    Some(stem + suffix)
}
