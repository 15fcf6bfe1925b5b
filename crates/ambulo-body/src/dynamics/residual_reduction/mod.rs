//! Residual reduction: the smallest change of a recorded motion, within its noise, with which it obeys Newton's laws.
//!
//! A recorded motion and the measured ground forces never agree exactly: a residual force and moment remain at the
//! root, which nothing supplies. [`reduce_residuals`] adds a cubic spline δ(t) to every free coordinate, over the whole
//! motion at once, so that values, rates and accelerations belong to one curve, and minimises
//!
//!   Σ_window |F_root(q + δ)|² / σ_F² + |M_root(q + δ)|² / σ_M²                       Newton's and Euler's laws
//!   + Σ_frames Σ_c (δ_c / σ_c)² + (δ̈_c / (σ_c ω²))²                                  noise of the motion
//!   + Σ_frames Σ_feet |Δp|² / σ_p² + |Δθ|² / σ_θ²                                   feet stay where they were recorded
//!
//! by the Gauss-Newton method. Loads keep their place in the world. The body mass and the trunk's mass centre may be
//! unknowns too: if they are wrong, a constant force or moment remains, which no motion of a walking person can
//! explain.
//!
//! | code                     | symbol   | unit        |
//! | `tolerance_rad`, `_m`    | σ_c      | rad, m      |
//! | `bandwidth_hz`           | ω / 2π   | Hz          |
//! | `tolerance_foot_m`       | σ_p      | m           |
//! | `residual_force_bw`      | σ_F / BW | -           |
//!
//! `ambulo_walk::optimal` is no substitute, although it also fits splines by least squares. There the ground force is a
//! function of posture and motion, the masses are known, the forces at the root must vanish, and joints must consist of
//! hinges and slides. Here the loads are measured, mass and trunk may be wrong, the residual keeps what noise cannot
//! explain, and models of recordings have ball-like joints too.
//!
//! Sources: least squares as in Remy and Thelen 2009, J Biomech Eng 131:031005 (unverified), there on accelerations,
//! here on splines; adjustment of the trunk's mass centre as in OpenSim's residual reduction (Delp et al. 2007, IEEE
//! Trans Biomed Eng 54:1940, unverified). The equations are derived here; see docs/CONSISTENCY.md.
//! Cost: with n coordinates, 3 n + 1 inverse dynamics and about 15 n³ multiplications per frame and iteration; linear
//! in frames. Memory: 24 n² bytes per frame (32 n² per knot above 100 frames per second).
//! Not handled: forces as unknowns; contacts that move with the feet.
//! Pinned by: tests/residual_reduction.rs, tests/residual_reduction_synthetic.rs

mod settings;

mod adjustable_body;
pub(crate) mod bordered;
mod frame;
mod problem;
mod result;
mod splines;

pub use result::{CoordinateChange, FootChange, ReducedMotion, RootResidual};
pub use settings::{
    CENTER_TOLERANCE_M, MASS_TOLERANCE, MOST_CENTER_M, MOST_MASS_SHARE, ResidualReductionError,
    ResidualReductionSettings,
};

use super::{LoadSeries, Roots, Workspace};
use crate::findings::{Code, Findings};
use crate::kinematics::Trajectory;
use crate::model::{BodyId, Model};
use crate::numerics::counted;
use crate::numerics::elementary::hypot;
use adjustable_body::AdjustableBody;
use frame::{FootPose, FrameEvaluator};
use problem::{ReductionProblem, Termination, Unknowns};
use result::rms_and_largest;
use splines::{CorrectionSplines, Instant, Region};

/// A residual above this share of body weight produces a warning.
const SMALL_RESIDUAL: f64 = 0.01;
/// A correction of the root's position above this produces a warning [m].
const LARGE_CHANGE_M: f64 = 0.030;
/// A correction of an angle above this produces a warning [rad].
const LARGE_CHANGE_RAD: f64 = 2.0 * std::f64::consts::PI / 180.0;
/// A residual above this share of body weight means that some forces were not measured.
const INCOMPLETE_LOADS: f64 = 0.5;
/// Memory limit of the band matrix [bytes].
const MOST_BYTES: f64 = 2e9;

/// Changes a motion within its noise until it obeys Newton's laws under the loads. Warns about incomplete forces, large
/// corrections and a large remaining residual.
///
/// # Errors
/// Missing or non-finite loads, a window that is too short, settings out of range: see [`ResidualReductionError`].
pub fn reduce_residuals(
    model: &Model,
    trajectory: &Trajectory,
    loads: &[LoadSeries],
    settings: &ResidualReductionSettings,
    findings: &mut Findings,
) -> Result<ReducedMotion, ResidualReductionError> {
    let region = checked(model, trajectory, loads, settings)?;
    let problem = problem(model, trajectory, loads, settings, region)?;
    let (unknowns, termination) = problem.solve()?;
    let reduced = problem.result(model, &unknowns, termination)?;
    report(&reduced, findings);
    Ok(reduced)
}

fn checked(
    model: &Model,
    trajectory: &Trajectory,
    loads: &[LoadSeries],
    settings: &ResidualReductionSettings,
) -> Result<Region, ResidualReductionError> {
    if let Some((name, found)) = settings.defect() {
        return Err(ResidualReductionError::Setting { name, found });
    }
    if !splines::has_free_root(model) {
        return Err(ResidualReductionError::HeldRoot);
    }
    if loads.is_empty() {
        return Err(ResidualReductionError::NoLoads);
    }
    let grid = trajectory.grid();
    let name = |load: &LoadSeries| model.bodies()[load.body.index()].name.clone();
    for load in loads {
        let (found, expected) = (load.points.len().min(load.wrenches.len()), grid.frames);
        if found != expected {
            return Err(ResidualReductionError::LoadFrames { body: name(load), found, expected });
        }
    }
    let region = Region::of(grid, settings)?;
    for load in loads {
        let is_finite = |frame: usize| {
            let at = load.at(frame);
            [at.point, at.wrench.force, at.wrench.moment].iter().all(|v| v.iter().all(|x| x.is_finite()))
        };
        if let Some(frame) = region.window.clone().find(|&frame| !is_finite(frame)) {
            return Err(ResidualReductionError::LoadNotFinite { body: name(load), time_s: grid.time(frame) });
        }
    }
    Ok(region)
}

fn problem<'a>(
    model: &'a Model,
    trajectory: &'a Trajectory,
    loads: &'a [LoadSeries],
    settings: &ResidualReductionSettings,
    region: Region,
) -> Result<ReductionProblem<'a>, ResidualReductionError> {
    let splines = CorrectionSplines::new(model, trajectory.grid(), &region, settings);
    let bytes = 8.0 * splines.unknowns() as f64 * (splines.bands() + 1) as f64;
    if bytes > MOST_BYTES {
        let frames = region.frames.len();
        return Err(ResidualReductionError::TooLong { frames, found_mb: 1e-6 * bytes, most_mb: 1e-6 * MOST_BYTES });
    }
    let mut feet: Vec<BodyId> = loads.iter().map(|load| load.body).collect();
    feet.sort_unstable();
    feet.dedup();
    let evaluator = FrameEvaluator { roots: Roots::of(model), feet };
    let mut workspace = Workspace::new(model);
    let mut instant = Instant::zeros(model.coordinates().len());
    let mut recorded_feet: Vec<Vec<FootPose>> = Vec::with_capacity(region.frames.len());
    for frame in region.frames.clone() {
        instant.take(trajectory, frame);
        recorded_feet.push(evaluator.evaluate(&mut workspace, &instant, &[]).1);
    }
    let weight = model.mass() * model.gravity().norm();
    let [force, moment] = [settings.residual_force_bw, settings.residual_moment_bw_m].map(|share| share * weight);
    let (place, turn) = (settings.tolerance_foot_m, settings.tolerance_rad);
    Ok(ReductionProblem {
        trajectory,
        loads,
        region,
        splines,
        body: AdjustableBody::new(model, settings),
        evaluator,
        recorded_feet,
        root_scale: [force, force, force, moment, moment, moment],
        foot_scale: [place, place, place, turn, turn, turn],
        settings: *settings,
    })
}

impl ReductionProblem<'_> {
    fn result(
        &self,
        model: &Model,
        unknowns: &Unknowns,
        termination: Termination,
    ) -> Result<ReducedMotion, ResidualReductionError> {
        let Region { window, frames } = &self.region;
        let trajectory = self.splines.corrected(model, self.trajectory, frames.clone(), &unknowns.coefficients)?;
        let untouched = Unknowns {
            coefficients: vec![0.0; unknowns.coefficients.len()],
            numbers: vec![0.0; unknowns.numbers.len()],
        };
        let weight = model.mass() * model.gravity().norm();
        let changes = self.splines.coordinates.iter().map(|&c| {
            let [before, after] = [self.trajectory, &trajectory].map(|t| t.columns()[c][0].as_slice());
            CoordinateChange::of(model, c, before, after, window.clone())
        });
        let grid = self.trajectory.grid();
        let (mass_share, trunk_center_m) = self.body.change(&unknowns.numbers);
        Ok(ReducedMotion {
            residual_before: RootResidual::of(&self.root_residuals(&untouched)?, weight),
            residual_after: RootResidual::of(&self.root_residuals(unknowns)?, weight),
            changes: changes.collect(),
            feet: self.feet(model, &trajectory),
            mass_share,
            trunk: self.body.trunk().to_owned(),
            trunk_center_m,
            window_s: [grid.time(window.start), grid.time(window.end - 1)],
            iterations: termination.iterations,
            converged: termination.converged,
            model: self.body.with(&unknowns.numbers)?,
            trajectory,
        })
    }

    /// Displacement of each foot.
    fn feet(&self, model: &Model, changed: &Trajectory) -> Vec<FootChange> {
        let mut workspace = Workspace::new(model);
        let mut instant = Instant::zeros(model.coordinates().len());
        let mut away: Vec<Vec<[f64; 2]>> = vec![Vec::new(); self.evaluator.feet.len()];
        for (recorded_feet, frame) in self.recorded_feet.iter().zip(self.region.frames.clone()) {
            instant.take(changed, frame);
            let (_, places) = self.evaluator.evaluate(&mut workspace, &instant, &[]);
            for (away, (place, before)) in away.iter_mut().zip(places.iter().zip(recorded_feet)) {
                let [x, y, z, a, b, c] = place.displacement_from(before);
                away.push([hypot(hypot(x, y), z), hypot(hypot(a, b), c)]);
            }
        }
        let inside = self.region.window.start - self.region.frames.start;
        let change = |(body, away): (&BodyId, &Vec<[f64; 2]>)| FootChange {
            body: model.bodies()[body.index()].name.clone(),
            rms_m: rms_and_largest(away[inside..][..self.region.window.len()].iter().map(|a| a[0])).0,
            max_m: rms_and_largest(away.iter().map(|a| a[0])).1,
            max_rad: rms_and_largest(away.iter().map(|a| a[1])).1,
        };
        self.evaluator.feet.iter().zip(&away).map(change).collect()
    }
}

fn report(reduced: &ReducedMotion, findings: &mut Findings) {
    let after = reduced.residual_after;
    if reduced.residual_before.force_peak_bw > INCOMPLETE_LOADS {
        let message = format!(
            "the residual force before residual reduction was up to {:.0} % of body weight between {:.3} and {:.3} s: \
             a foot may have been off the force plates, and the motion was distorted to make up for it. hint: choose a \
             time window in which all ground forces are measured",
            100.0 * reduced.residual_before.force_peak_bw,
            reduced.window_s[0],
            reduced.window_s[1]
        );
        findings.report(Code::ConsistencyIncompleteForces, message);
    }
    if !reduced.obeys(SMALL_RESIDUAL) {
        let message = format!(
            "residual reduction within the tolerances leaves {:.1} % of body weight and {:.1} N.m (RMS) at the root. \
             hint: check the body mass and whether all forces were measured, or widen the tolerances",
            100.0 * after.force_rms_bw,
            after.moment_rms_nm
        );
        findings.report(Code::ConsistencyResidualLeft, message);
    }
    for (unit, limit, shown, scale) in
        [("rad", LARGE_CHANGE_RAD, "degrees", 1.0_f64.to_degrees()), ("m", LARGE_CHANGE_M, "mm", 1e3)]
    {
        let largest = reduced.changes.iter().filter(|c| c.unit == unit).max_by(|a, b| a.max.total_cmp(&b.max));
        if let Some(change) = largest.filter(|change| change.max > limit) {
            let message = format!(
                "residual reduction changed `{}` by up to {:.1} {shown}, more than the usual error of a recorded \
                 motion ({:.0} {shown}). hint: check the body mass, the model and the forces",
                change.name,
                scale * change.max,
                scale * limit
            );
            findings.report(Code::ConsistencyLargeChange, message);
        }
    }
    if !reduced.converged {
        let message = format!("residual reduction did not converge in {}", counted(reduced.iterations, "iteration"));
        findings.report(Code::ConsistencyNotSettled, message);
    }
}
