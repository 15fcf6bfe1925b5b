//! Residual reduction: changes a motion within its noise so that it agrees with the ground forces.

use super::recording::{Analysis, AnalysisSettings, Mass, MassSource};
use super::residual::residual_within;
use crate::dynamics::residual_reduction::{
    CoordinateChange, ReducedMotion, ResidualReductionError, ResidualReductionSettings, reduce_residuals,
};
use crate::dynamics::{Workspace, inverse_with_residual};
use crate::findings::{Code, Findings};
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::Model;
use crate::motion::filter::LowPass;
use crate::motion::{Smoother, TimeGrid, Window};
use crate::numerics::counted;
use serde::Deserialize;

/// The parts of a study that residual reduction may change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Adjustable {
    /// The motion only.
    Motion,
    /// The motion, the body mass and the mass centre of the trunk.
    #[serde(rename = "body")]
    MotionAndBody,
}

impl Adjustable {
    /// The choices with their names.
    pub const ALL: [(&'static str, Adjustable); 2] =
        [("motion", Adjustable::Motion), ("body", Adjustable::MotionAndBody)];
}

/// A filter mixes samples within half a period of its cut-off frequency, so the equations of motion only hold this far
/// inside the window.
const FILTER_REACH_PERIODS: f64 = 0.5;

/// Largest change of a coordinate, and largest way of the mass centre of a body: what is more is not an error of a
/// recording but another motion (ours).
const MOST_MOVED_M: f64 = 0.030;
const MOST_TURNED_RAD: f64 = 30.0 * std::f64::consts::PI / 180.0;

/// Trust in the forces where the motion would change by more, one after the other: they may be wrong by twice and by
/// five times as much, by 1 % of body weight (ours).
const LESS_TRUST: [f64; 2] = [0.5, 0.2];

/// Changes the motion of an analysis within its noise until it agrees with the ground forces, during the instrumented
/// window. Returns the analysis of the changed motion and body, and the changes; the analysis as it was where the
/// reduction does not converge or leads far away ([`refusal`]).
///
/// # Errors
/// A motion without forces, a window that is too short: see [`ResidualReductionError`].
pub(crate) fn reduce_residual(
    model: &Model,
    analysis: Analysis,
    settings: &AnalysisSettings,
    adjustable: Adjustable,
    findings: &mut Findings,
) -> Result<(Analysis, Option<ReducedMotion>), ResidualReductionError> {
    let loads = analysis.ground.loads();
    let body = adjustable == Adjustable::MotionAndBody;
    let reduction = ResidualReductionSettings {
        within: inside(analysis.trajectory.grid(), settings),
        adjust_mass: body,
        adjust_trunk_center: body,
        ..ResidualReductionSettings::default()
    };
    let reduced = |trust: f64| {
        let settings = ResidualReductionSettings {
            residual_force_bw: reduction.residual_force_bw / trust,
            residual_moment_bw_m: reduction.residual_moment_bw_m / trust,
            ..reduction
        };
        let mut found = Findings::default();
        let done = reduce_residuals(model, &analysis.trajectory, &loads, &settings, &mut found)?;
        Ok::<_, ResidualReductionError>((done, found))
    };
    let (mut done, mut found) = reduced(1.0)?;
    let refused = |done: &ReducedMotion| refusal(model, &analysis.trajectory, done);
    for trust in LESS_TRUST {
        let Some((_, why)) = refused(&done) else { break };
        (done, found) = reduced(trust)?;
        let again = format!(
            "{why}; the search was repeated with forces that may be wrong by {:.1} % of body weight instead of {:.1} %",
            100.0 * reduction.residual_force_bw / trust,
            100.0 * reduction.residual_force_bw
        );
        found.report(Code::ConsistencyForcesDoubted, again);
    }
    if let Some((code, why)) = refused(&done) {
        findings.report(
            code,
            why + "; the motion was not changed. hint: check the body mass and whether all forces were measured",
        );
        return Ok((analysis, None));
    }
    found.as_slice().iter().for_each(|finding| findings.add(finding.clone()));
    let [from, to] = done.window_s;
    let (first, frames) = analysis.trajectory.grid().inside(Window { from_s: Some(from), to_s: Some(to) });
    let forces = inverse_with_residual(&mut Workspace::new(&done.model), &done.trajectory, &loads);
    let residual = residual_within(&done.model, &forces, first..first + frames);
    let mass = match analysis.mass.source {
        MassSource::Model => Mass { kg: done.model.mass(), ..analysis.mass },
        MassSource::Plates | MassSource::Standing => analysis.mass,
    };
    let recorded = Some(analysis.trajectory);
    let trajectory = done.trajectory.clone();
    let analysis = Analysis { trajectory, recorded, forces, residual, mass, ..analysis };
    Ok((analysis, Some(done)))
}

/// Why a change is not made: the motion would be neither recorded nor consistent, or another one.
fn refusal(model: &Model, recorded: &Trajectory, done: &ReducedMotion) -> Option<(Code, String)> {
    if !done.converged {
        let iterations = counted(done.iterations, "iteration");
        return Some((Code::ConsistencyNotSettled, format!("residual reduction did not converge in {iterations}")));
    }
    let limit = |change: &CoordinateChange| match change.unit {
        "rad" => (MOST_TURNED_RAD, "degrees", 1.0_f64.to_degrees()),
        _ => (MOST_MOVED_M, "mm", 1e3),
    };
    let share = |change: &CoordinateChange| change.max / limit(change).0;
    let farthest = done.changes.iter().max_by(|a, b| share(a).total_cmp(&share(b))).filter(|most| share(most) > 1.0);
    let of_coordinate = farthest.map(|change| {
        let (most, unit, scale) = limit(change);
        (change.name.as_str(), scale * change.max, scale * most, unit)
    });
    let of_body = || {
        let (body, moved_m) = farthest_body(model, recorded, &done.trajectory)?;
        (moved_m > MOST_MOVED_M).then(|| (model.bodies()[body].name.as_str(), 1e3 * moved_m, 1e3 * MOST_MOVED_M, "mm"))
    };
    let (name, found, allowed, unit) = of_coordinate.or_else(of_body)?;
    let what = format!(
        "the motion agrees with the forces only if `{name}` moves by up to {found:.0} {unit}; {allowed:.0} {unit} are \
         allowed"
    );
    Some((Code::ConsistencyMotionKept, what))
}

/// The body whose mass centre moves farthest from one motion to the other, and how far [m].
fn farthest_body(model: &Model, from: &Trajectory, to: &Trajectory) -> Option<(usize, f64)> {
    let mut centers = Vec::new();
    each_body_motion(model, from, |_, bodies| centers.extend(bodies.iter().map(|body| body.center)));
    let (count, mut farthest) = (model.bodies().len(), vec![0.0_f64; model.bodies().len()]);
    each_body_motion(model, to, |frame, bodies| {
        for (i, (most, body)) in farthest.iter_mut().zip(bodies).enumerate() {
            *most = most.max((body.center - centers[frame * count + i]).norm());
        }
    });
    farthest.into_iter().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The instrumented window (or the whole motion if it is unknown) without its ends, where the filters mix in unmeasured
/// forces.
fn inside(grid: TimeGrid, settings: &AnalysisSettings) -> Window {
    let cutoff = |filter: LowPass| filter.cutoff_hz;
    let of_motion = match settings.smoother {
        Smoother::Butterworth(filter) => Some(cutoff(filter)),
        Smoother::Spline | Smoother::Off => None,
    };
    let lowest = of_motion.into_iter().chain(settings.force_filter.map(cutoff)).fold(f64::INFINITY, f64::min);
    let reach_s = FILTER_REACH_PERIODS / lowest;
    let whole = Window { from_s: Some(grid.start_s), to_s: Some(grid.end_s()) };
    let measured = whole.overlap(settings.instrumented.unwrap_or_default());
    Window { from_s: measured.from_s.map(|t| t + reach_s), to_s: measured.to_s.map(|t| t - reach_s) }
}
