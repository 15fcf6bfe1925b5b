//! Recorded motions made to agree with the ground's forces: the smallest change within their noise that obeys Newton's laws.
//!
//! A recorded motion and the forces under its feet never agree: what is left over at the root (the residual) is a force that nothing
//! supplies. [`make_consistent`] adds a cubic spline δ(t) to every free coordinate, over the whole motion at once, so that values,
//! rates and accelerations stay those of one curve, and minimises
//!
//!   Σ_window |F_root(q + δ)|² / σ_F² + |M_root(q + δ)|² / σ_M²                       Newton's and Euler's laws
//!   + Σ_frames Σ_c (δ_c / σ_c)² + (δ̈_c / (σ_c ω²))²                                  the motion's noise
//!   + Σ_frames Σ_feet |Δp|² / σ_p² + |Δθ|² / σ_θ²                                    feet stay where they are seen
//!
//! by Gauss and Newton's method. Loads stay where they are in the world. The body's mass and the trunk's mass centre may be unknowns
//! too: a wrong mass or mass centre shows as a constant force or moment, which no motion of a walking person explains.
//!
//! | code                     | symbol   | unit        |
//! | `tolerance_rad`, `_m`    | σ_c      | rad, m      |
//! | `bandwidth_hz`           | ω / 2π   | Hz          |
//! | `tolerance_foot_m`       | σ_p      | m           |
//! | `residual_force_bw`      | σ_F / BW | -           |
//!
//! Sources: the least-squares idea of Remy and Thelen 2009, J Biomech Eng 131:031005 (unverified), there on accelerations, here on
//! splines; moving the trunk's mass centre as OpenSim's residual reduction does (Delp et al. 2007, IEEE Trans Biomed Eng 54:1940,
//! unverified). Equations derived here; docs/CONSISTENCY.md.
//! Cost: for n coordinates, a frame and iteration take 3 n + 1 inverse dynamics and about 15 n³ multiplications; linear in frames.
//! Memory: 24 n² bytes a frame (32 n² a knot where frames are more than 100 a second).
//! Not handled: forces as unknowns; contacts that move with the feet.
//! Pinned by: tests/consistency.rs

mod body;
mod bordered;
mod curves;
mod error;
mod frame;
mod problem;
mod result;
mod settings;

pub use error::ConsistencyError;
pub use result::{BodyChange, Consistent, CoordinateChange, FootChange, RootResidual};
pub use settings::{CENTER_TOLERANCE_M, ConsistencySettings, MASS_TOLERANCE, MOST_CENTER_M, MOST_MASS_SHARE};

use super::{LoadSeries, Roots, Workspace};
use crate::findings::{Code, Findings};
use crate::kinematics::Trajectory;
use crate::model::{BodyId, Model};
use body::Body;
use curves::{Curves, Instant, Region};
use frame::{Eyes, Place};
use problem::{Ending, Problem, Unknowns};
use result::rms_and_largest;

/// A residual above this share of body weight is reported.
const SMALL_RESIDUAL: f64 = 0.01;
/// A change of the root's place above this is reported [m].
const LARGE_CHANGE_M: f64 = 0.030;
/// A change of an angle above this is reported [rad].
const LARGE_CHANGE_RAD: f64 = 2.0 * std::f64::consts::PI / 180.0;
/// Forces that miss this share of body weight, or make up as much too many, were not all measured.
const INCOMPLETE_LOADS: f64 = 0.5;
/// The band matrix takes no more than this [bytes].
const MOST_BYTES: f64 = 2e9;

/// Changes a motion, within its noise, until it obeys Newton's laws under the loads.
///
/// # Errors
/// Loads that are missing or no numbers, a window that is too short, settings that make no sense.
pub fn make_consistent(
    model: &Model,
    trajectory: &Trajectory,
    loads: &[LoadSeries],
    settings: &ConsistencySettings,
    findings: &mut Findings,
) -> Result<Consistent, ConsistencyError> {
    let region = checked(model, trajectory, loads, settings)?;
    let problem = problem(model, trajectory, loads, settings, region)?;
    let (unknowns, ending) = problem.solve()?;
    let consistent = problem.result(model, &unknowns, ending)?;
    report(&consistent, findings);
    Ok(consistent)
}

fn checked(
    model: &Model,
    trajectory: &Trajectory,
    loads: &[LoadSeries],
    settings: &ConsistencySettings,
) -> Result<Region, ConsistencyError> {
    if let Some((name, found)) = settings.defect() {
        return Err(ConsistencyError::Setting { name, found });
    }
    if !curves::has_free_root(model) {
        return Err(ConsistencyError::HeldRoot);
    }
    if loads.is_empty() {
        return Err(ConsistencyError::NoLoads);
    }
    let grid = trajectory.grid();
    let name = |load: &LoadSeries| model.bodies()[load.body.index()].name.clone();
    for load in loads {
        let (found, expected) = (load.points.len().min(load.wrenches.len()), grid.frames);
        if found != expected {
            return Err(ConsistencyError::LoadFrames { body: name(load), found, expected });
        }
    }
    let region = Region::of(grid, settings)?;
    for load in loads {
        let is_finite = |frame: usize| {
            let at = load.at(frame);
            [at.point, at.wrench.force, at.wrench.moment].iter().all(|v| v.iter().all(|x| x.is_finite()))
        };
        if let Some(frame) = region.window.clone().find(|&frame| !is_finite(frame)) {
            return Err(ConsistencyError::LoadNotFinite { body: name(load), time_s: grid.time(frame) });
        }
    }
    Ok(region)
}

fn problem<'a>(
    model: &'a Model,
    trajectory: &'a Trajectory,
    loads: &'a [LoadSeries],
    settings: &ConsistencySettings,
    region: Region,
) -> Result<Problem<'a>, ConsistencyError> {
    let curves = Curves::new(model, trajectory.grid(), &region, settings);
    let bytes = 8.0 * curves.unknowns() as f64 * (curves.bands() + 1) as f64;
    if bytes > MOST_BYTES {
        let frames = region.frames.len();
        return Err(ConsistencyError::TooLong { frames, found_mb: 1e-6 * bytes, most_mb: 1e-6 * MOST_BYTES });
    }
    let mut feet: Vec<BodyId> = loads.iter().map(|load| load.body).collect();
    feet.sort_unstable();
    feet.dedup();
    let eyes = Eyes { roots: Roots::of(model), feet };
    let mut workspace = Workspace::new(model);
    let mut instant = Instant::zeros(model.coordinates().len());
    let mut stood: Vec<Vec<Place>> = Vec::with_capacity(region.frames.len());
    for frame in region.frames.clone() {
        instant.take(trajectory, frame);
        stood.push(eyes.see(&mut workspace, &instant, &[]).feet);
    }
    let weight = model.mass() * model.gravity().norm();
    let [force, moment] = [settings.residual_force_bw, settings.residual_moment_bw_m].map(|share| share * weight);
    let (place, turn) = (settings.tolerance_foot_m, settings.tolerance_rad);
    Ok(Problem {
        trajectory,
        loads,
        region,
        curves,
        body: Body::new(model, settings),
        eyes,
        stood,
        root_scale: [force, force, force, moment, moment, moment],
        foot_scale: [place, place, place, turn, turn, turn],
        settings: *settings,
    })
}

impl Problem<'_> {
    fn result(&self, model: &Model, unknowns: &Unknowns, ending: Ending) -> Result<Consistent, ConsistencyError> {
        let Region { window, frames } = &self.region;
        let trajectory = self.curves.changed(model, self.trajectory, frames.clone(), &unknowns.coefficients)?;
        let untouched = Unknowns {
            coefficients: vec![0.0; unknowns.coefficients.len()],
            numbers: vec![0.0; unknowns.numbers.len()],
        };
        let weight = model.mass() * model.gravity().norm();
        let changes = self.curves.coordinates.iter().map(|&c| {
            let [before, after] = [self.trajectory, &trajectory].map(|t| t.columns()[c][0].as_slice());
            CoordinateChange::of(model, c, before, after, window.clone())
        });
        let grid = self.trajectory.grid();
        Ok(Consistent {
            residual_before: RootResidual::of(&self.lacking(&untouched)?, weight),
            residual_after: RootResidual::of(&self.lacking(unknowns)?, weight),
            changes: changes.collect(),
            feet: self.feet(model, &trajectory),
            body: self.body.change(&unknowns.numbers),
            window_s: [grid.time(window.start), grid.time(window.end - 1)],
            iterations: ending.iterations,
            converged: ending.converged,
            model: self.body.with(&unknowns.numbers)?,
            trajectory,
        })
    }

    /// How feet were moved.
    fn feet(&self, model: &Model, changed: &Trajectory) -> Vec<FootChange> {
        let mut workspace = Workspace::new(model);
        let mut instant = Instant::zeros(model.coordinates().len());
        let mut away: Vec<Vec<[f64; 2]>> = vec![Vec::new(); self.eyes.feet.len()];
        for (stood, frame) in self.stood.iter().zip(self.region.frames.clone()) {
            instant.take(changed, frame);
            let places = self.eyes.see(&mut workspace, &instant, &[]).feet;
            for (away, (place, before)) in away.iter_mut().zip(places.iter().zip(stood)) {
                let [x, y, z, a, b, c] = place.away_from(before);
                away.push([x.hypot(y).hypot(z), a.hypot(b).hypot(c)]);
            }
        }
        let inside = self.region.window.start - self.region.frames.start;
        let change = |(body, away): (&BodyId, &Vec<[f64; 2]>)| FootChange {
            body: model.bodies()[body.index()].name.clone(),
            rms_m: rms_and_largest(away[inside..][..self.region.window.len()].iter().map(|a| a[0])).0,
            max_m: rms_and_largest(away.iter().map(|a| a[0])).1,
            max_rad: rms_and_largest(away.iter().map(|a| a[1])).1,
        };
        self.eyes.feet.iter().zip(&away).map(change).collect()
    }
}

fn report(consistent: &Consistent, findings: &mut Findings) {
    let after = consistent.residual_after;
    if consistent.residual_before.force_peak_bw > INCOMPLETE_LOADS {
        let message = format!(
            "motion and forces disagreed by up to {:.0} % of body weight between {:.3} and {:.3} s: a foot may have stood where nothing measures, and the motion was bent for it. hint: choose the time in which all forces are known",
            100.0 * consistent.residual_before.force_peak_bw,
            consistent.window_s[0],
            consistent.window_s[1]
        );
        findings.report(Code::ConsistencyIncompleteForces, message);
    }
    if !consistent.obeys(SMALL_RESIDUAL) {
        let message = format!(
            "within its tolerances the motion cannot obey the forces: {:.1} % of body weight and {:.1} N.m rms are left at the root. hint: wider tolerances, another mass, or forces that were not measured",
            100.0 * after.force_rms_bw,
            after.moment_rms_nm
        );
        findings.report(Code::ConsistencyResidualLeft, message);
    }
    for (unit, limit, shown, scale) in
        [("rad", LARGE_CHANGE_RAD, "degrees", 1.0_f64.to_degrees()), ("m", LARGE_CHANGE_M, "mm", 1e3)]
    {
        let largest = consistent.changes.iter().filter(|c| c.unit == unit).max_by(|a, b| a.max.total_cmp(&b.max));
        if let Some(change) = largest.filter(|change| change.max > limit) {
            let message = format!(
                "`{}` was changed by up to {:.1} {shown} to obey the forces, more than motions are usually wrong ({:.0}): mass, body or forces may be",
                change.name,
                scale * change.max,
                scale * limit
            );
            findings.report(Code::ConsistencyLargeChange, message);
        }
    }
    if !consistent.converged {
        let message = format!("the change was not settled after {} iterations", consistent.iterations);
        findings.report(Code::ConsistencyNotSettled, message);
    }
}
