//! Fits the sizes of all bodies and the standing posture together.
//!
//! min  Σ |m - p(q, s)|² / σ²  +  Σ_b ρ(ln s_b - ln s_parent(b))  +  Σ (ln s_right - ln s_left)² / σ_side²
//!      +  Σ (ln s_b - ln s_neighbour(b))² / σ_tied²  +  Σ (q - q₀)² / σ_q²
//!
//! | code | symbol | unit |
//! |---|---|---|
//! | `x` | q, coordinates that move a marker; u = ln s, one per body | rad, m; 1 |
//! | `MARKER` | σ, distance of a marker from its position on a model of the right size | m |
//! | `PROPORTION` | scale of ρ, size of a body relative to its parent | 1 |
//! | `SIDE` | σ_side | 1 |
//! | `TIED` | σ_tied | 1 |
//! | `POSTURE` | σ_q | rad |
//!
//! The size cannot be determined for a body without markers, nor for a body with fewer than three at the end of a limb;
//! it is tied to a neighbour: to its only child with markers (the talus is part of the foot), otherwise to its parent.
//!
//! One factor per body: its markers determine its length well and its width badly. ρ is Cauchy's, σ² ln(1 + (d/σ)²):
//! most bodies share the proportions of the model, but clear evidence of markers may change them. Offsets of markers
//! from their positions are part of the noise: a marker has three coordinates, so a normally distributed offset with σ
//! is equivalent to a distance of σ. The remaining distances are these offsets, and the markers are moved by them at
//! the end.
//!
//! Cost: two models per body and step, about 50 ms in total.
//! Not handled: several standing postures; factors that differ along the axes of one body (use measurements).
//! Pinned by: tests/scaling.rs

use super::ScalingError;
use super::standing::{at_rest, complete, with_markers_placed};
use crate::findings::Findings;
use crate::kinematics::marker_fit::rows::{MarkerRow, MarkerRows};
use crate::kinematics::marker_fit::{FitSettings, OutlierDetection, fit_markers};
use crate::model::{BodyId, Model, Side};
use crate::motion::MarkerRecording;
use crate::numerics::elementary::{exp, ln_1p};
use crate::numerics::{NormalEquations, Residuals, minimise};
use crate::spatial::Vec3;

/// Standard deviation of a marker from its position on a model of the right size [m]: palpation and skin.
const MARKER: f64 = 0.01;
/// Standard deviation of the logarithm of size between a body and its parent.
const PROPORTION: f64 = 0.15;
/// The same standard deviation between a body whose size is not determined and its neighbour.
const TIED: f64 = 0.01;
const ENOUGH: usize = 3;
/// The same standard deviation between left and right: leg lengths differ by 1 % in most persons.
const SIDE: f64 = 0.01;
/// The same standard deviation between the whole body and the model.
const WHOLE: f64 = 0.5;
/// Standard deviation of the joints from the default posture [rad, or m].
const POSTURE: f64 = 1.0;
const STEPS: usize = 100;
/// Step of the numerical derivative by the logarithm of a size: the second-order error is 1e-10.
const DIFFERENCE: f64 = 1e-5;

/// A model scaled to a person, with the positions of the person's markers.
#[derive(Debug, Clone)]
pub struct SizedModel {
    /// The model, with the markers at their positions on the person.
    pub model: Model,
    /// Scale factors of each body along its axes, in the order of the model.
    pub factors: Vec<Vec3>,
    /// The standing posture, one value per coordinate [rad or m].
    pub posture: Vec<f64>,
    /// Root mean square distance of the markers from the markers of the unscaled model [m]; `None` without a fit to a
    /// standing trial.
    pub rms_before_m: Option<f64>,
    /// The same for the scaled model, before its markers were moved [m].
    pub rms_m: Option<f64>,
}

/// Scales all bodies to a standing trial in world axes, then moves the markers to their positions on the person.
/// Without a `mass` [kg], the model keeps its mass.
///
/// # Errors
/// Markers that cannot be fitted, a mass that is not positive.
pub fn fit_size(
    model: &Model,
    standing: &MarkerRecording,
    mass: Option<f64>,
    findings: &mut Findings,
) -> Result<SizedModel, ScalingError> {
    let standing = at_rest(standing, findings);
    let fit_settings = FitSettings { outliers: OutlierDetection::Off, ..FitSettings::default() };
    let start = fit_markers(model, &standing, &fit_settings, findings)?;
    let mut problem = Problem::new(model, &standing, &start.motion.columns)?;
    let mut z = problem.start.clone();
    // Quadratic first, so that a body with few markers is not given a separate size before the others have theirs; then
    // from the posture of a model of about the right size, because a model of a wrong size may have folded an arm.
    minimise(&mut problem, &mut z, STEPS);
    let about = model.scaled(&problem.factors(&z), None)?;
    let again = fit_markers(&about, &standing, &fit_settings, &mut Findings::default())?;
    let mut other = problem.start_at(&again.motion.columns);
    other[problem.unknowns..].copy_from_slice(&z[problem.unknowns..]);
    if minimise(&mut problem, &mut other, STEPS).to < problem.cost(&z) {
        z = other;
    }
    problem.is_robust = true;
    minimise(&mut problem, &mut z, STEPS);
    let factors = problem.factors(&z);
    let scaled = model.scaled(&factors, mass)?;
    let rows = problem.rows(&z)?;
    let square: f64 = rows.residuals().iter().map(|r| r.norm_squared()).sum();
    let rms_m = (square / rows.residuals().len() as f64).sqrt();
    let posture = complete(&scaled, |i| rows.unknown_of(i).map(|u| z[u]));
    let model = with_markers_placed(&scaled, &standing, &posture, |_| true)?;
    let rms_before_m = start.rms_m.first().copied();
    Ok(SizedModel { model, factors, posture, rms_before_m, rms_m: Some(rms_m) })
}

struct Problem<'a> {
    model: &'a Model,
    standing: &'a MarkerRecording,
    /// Number of unknowns of the posture; the unknown sizes follow.
    unknowns: usize,
    /// The coordinate of each.
    coordinates: Vec<usize>,
    start: Vec<f64>,
    /// Whether ρ is Cauchy's; otherwise it is quadratic.
    is_robust: bool,
    /// Unknowns with a prior, and its mean (the default posture).
    posture_prior: Vec<(usize, f64)>,
    /// A body and its parent.
    proportions: Vec<(usize, usize)>,
    /// A body whose size is not determined, and its neighbour.
    ties: Vec<(usize, usize)>,
    sides: Vec<(usize, usize)>,
}

impl<'a> Problem<'a> {
    fn new(
        model: &'a Model,
        standing: &'a MarkerRecording,
        columns: &[Option<Vec<f64>>],
    ) -> Result<Problem<'a>, ScalingError> {
        let rows = MarkerRows::new(model, standing)?;
        let unknowns = rows.unknowns();
        let coordinates: Vec<usize> = (0..unknowns).map(|u| rows.coordinate(u)).collect();
        let root_moves: Vec<usize> = model
            .bodies()
            .iter()
            .filter(|b| b.joint.parent.is_none())
            .flat_map(|b| b.joint.coordinates())
            .map(|id| id.index())
            .collect();
        let posture_prior = (0..unknowns)
            .filter(|&u| !root_moves.contains(&rows.coordinate(u)))
            .map(|u| (u, model.coordinates()[rows.coordinate(u)].default_value))
            .collect();
        let neighbours = neighbours(model, standing);
        let parent_of = |id: BodyId| model.bodies()[id.index()].joint.parent;
        let is_tied = |a: BodyId, b: BodyId| neighbours[a.index()] == Some(b) || neighbours[b.index()] == Some(a);
        let numbers = |a: BodyId, b: BodyId| (unknowns + a.index(), unknowns + b.index());
        let proportion = |id: BodyId| parent_of(id).filter(|p| !is_tied(id, *p)).map(|p| numbers(id, p));
        let proportions = model.body_ids().filter_map(proportion).collect();
        let ties = model.body_ids().filter_map(|id| neighbours[id.index()].map(|n| numbers(id, n))).collect();
        let sides = pairs_of_sides(model).into_iter().map(|(a, b)| (unknowns + a, unknowns + b)).collect();
        let start = Vec::new();
        let mut problem = Problem {
            model,
            standing,
            unknowns,
            coordinates,
            start,
            is_robust: false,
            posture_prior,
            proportions,
            ties,
            sides,
        };
        problem.start = problem.start_at(columns);
        Ok(problem)
    }

    /// Initial values: the size of the model, the posture of the first frame.
    fn start_at(&self, columns: &[Option<Vec<f64>>]) -> Vec<f64> {
        let value = |c: &usize| columns[*c].as_ref().map(|c| c[0]).filter(|v| v.is_finite()).unwrap_or(0.0);
        self.coordinates.iter().map(value).chain(self.model.bodies().iter().map(|_| 0.0)).collect()
    }

    fn factors(&self, z: &[f64]) -> Vec<Vec3> {
        z[self.unknowns..].iter().map(|u| Vec3::repeat(exp(*u))).collect()
    }

    /// Residuals of the markers for these sizes and this posture.
    fn rows(&self, z: &[f64]) -> Result<MarkerRows, ScalingError> {
        let scaled = self.model.scaled(&self.factors(z), None)?;
        let mut rows = MarkerRows::new(&scaled, self.standing)?;
        rows.pose_at(&z[..self.unknowns]);
        Ok(rows)
    }

    /// Residuals and derivatives of the priors.
    fn each_prior(&self, z: &[f64], mut visit: impl FnMut(f64, &[usize], &[f64])) {
        for &(u, value) in &self.posture_prior {
            visit((z[u] - value) / POSTURE, &[u], &[1.0 / POSTURE]);
        }
        for (list, scale) in [(&self.sides, SIDE), (&self.ties, TIED)] {
            for &(a, b) in list {
                visit((z[a] - z[b]) / scale, &[a, b], &[1.0 / scale, -1.0 / scale]);
            }
        }
        for root in (0..self.model.bodies().len()).filter(|&i| self.model.bodies()[i].joint.parent.is_none()) {
            let u = self.unknowns + root;
            visit(z[u] / WHOLE, &[u], &[1.0 / WHOLE]);
        }
        for &(a, b) in &self.proportions {
            let d = (z[a] - z[b]) / PROPORTION;
            let (r, slope) = if self.is_robust { cauchy(d) } else { (d, 1.0) };
            let slope = slope / PROPORTION;
            visit(r, &[a, b], &[slope, -slope]);
        }
    }
}

/// The residual r with r² = ln(1 + d²), and its derivative d / ((1 + d²) r).
fn cauchy(d: f64) -> (f64, f64) {
    let r = ln_1p(d * d).sqrt().copysign(d);
    (r, if r.abs() < 1e-6 { 1.0 } else { d / ((1.0 + d * d) * r) })
}

/// For bodies whose size is not determined: the neighbour that they are tied to.
fn neighbours(model: &Model, standing: &MarkerRecording) -> Vec<Option<BodyId>> {
    let markers = |id: BodyId| {
        model.markers().iter().filter(|m| m.body == Some(id) && standing.marker(&m.name).is_some()).count()
    };
    let mut below: Vec<usize> = model.body_ids().map(markers).collect();
    for id in model.body_ids().rev() {
        if let Some(parent) = model.bodies()[id.index()].joint.parent {
            below[parent.index()] += below[id.index()];
        }
    }
    let parent = |id: BodyId| model.bodies()[id.index()].joint.parent;
    let carrying =
        |id: BodyId| model.body_ids().filter(move |c| parent(*c) == Some(id)).filter(|c| below[c.index()] > 0);
    let neighbour = |id: BodyId| match (markers(id), carrying(id).count()) {
        (0, 1) => carrying(id).next(),
        (own, 0) if own < ENOUGH => parent(id),
        (0, _) => parent(id),
        _ => None,
    };
    model.body_ids().map(neighbour).collect()
}

/// Pairs of right and left bodies with the same name.
fn pairs_of_sides(model: &Model) -> Vec<(usize, usize)> {
    let right = format!("_{}", Side::Right.letter());
    let left = format!("_{}", Side::Left.letter());
    let pair = |id: BodyId| {
        let stem = model.bodies()[id.index()].name.strip_suffix(&right)?;
        Some((id.index(), model.body(&format!("{stem}{left}"))?.index()))
    };
    model.body_ids().filter_map(pair).collect()
}

impl Residuals for Problem<'_> {
    fn count(&self) -> usize {
        self.start.len()
    }

    fn cost(&mut self, z: &[f64]) -> f64 {
        let Ok(rows) = self.rows(z) else { return f64::INFINITY };
        let mut sum: f64 = rows.residuals().iter().map(|r| r.norm_squared() / (MARKER * MARKER)).sum();
        self.each_prior(z, |r, _, _| sum += r * r);
        sum
    }

    fn linearise(&mut self, z: &[f64], normal: &mut NormalEquations) -> f64 {
        let Ok(mut rows) = self.rows(z) else { return f64::INFINITY };
        let by_size = self.by_size(z);
        let mut sum = 0.0;
        let mut numbers: Vec<usize> = Vec::new();
        let mut slopes: [Vec<f64>; 3] = Default::default();
        for i in 0..rows.residuals().len() {
            let MarkerRow { residual, unknowns, derivatives } = rows.row(i);
            numbers.clear();
            numbers.extend_from_slice(unknowns);
            for (k, slopes) in slopes.iter_mut().enumerate() {
                slopes.clear();
                // The residual is p - m.
                slopes.extend(derivatives.iter().map(|d| d[k] / MARKER));
            }
            for (body, change) in by_size.iter().enumerate() {
                if change[i].norm_squared() > 0.0 {
                    numbers.push(self.unknowns + body);
                    slopes.iter_mut().enumerate().for_each(|(k, slopes)| slopes.push(change[i][k] / MARKER));
                }
            }
            for (k, slopes) in slopes.iter().enumerate() {
                normal.add(residual[k] / MARKER, &numbers, slopes);
            }
            sum += residual.norm_squared() / (MARKER * MARKER);
        }
        self.each_prior(z, |r, numbers, slopes| {
            normal.add(r, numbers, slopes);
            sum += r * r;
        });
        sum
    }
}

impl Problem<'_> {
    /// Derivative of every marker by the logarithm of the size of each body.
    fn by_size(&self, z: &[f64]) -> Vec<Vec<Vec3>> {
        let side = |body: usize, step: f64| {
            let mut other = z.to_vec();
            other[self.unknowns + body] += step;
            self.rows(&other).map(|rows| rows.residuals().to_vec()).unwrap_or_default()
        };
        let slope = |body: usize| {
            let (up, down) = (side(body, DIFFERENCE), side(body, -DIFFERENCE));
            up.iter().zip(&down).map(|(a, b)| (a - b) / (2.0 * DIFFERENCE)).collect()
        };
        (0..self.model.bodies().len()).map(slope).collect()
    }
}
