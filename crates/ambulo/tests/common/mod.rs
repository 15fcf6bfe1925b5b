//! Random models, postures and loads, each from a seed that the failing assertion prints.

#![allow(dead_code, reason = "the program that counts allocations uses a part")]

pub(crate) mod assembly;
pub(crate) mod graphs;
pub(crate) mod random;
pub(crate) mod worlds;

use ambulo::dynamics::{BodyLoad, LoadSeries};
use ambulo::kinematics::{Posture, Trajectory};
use ambulo::model::{Body, Model};
use ambulo::motion::TimeGrid;
use ambulo::spatial::{Mat3, Vec3};

/// Coordinates of one instant, with rates and accelerations.
#[derive(Debug, Clone)]
pub(crate) struct State {
    pub(crate) q: Vec<f64>,
    pub(crate) qd: Vec<f64>,
    pub(crate) qdd: Vec<f64>,
}

impl State {
    /// All zero.
    pub(crate) fn rest(model: &Model) -> State {
        let zeros = vec![0.0; model.coordinates().len()];
        State { q: zeros.clone(), qd: zeros.clone(), qdd: zeros }
    }

    pub(crate) fn posture(&self) -> Posture<'_> {
        Posture { q: &self.q, qd: &self.qd, qdd: &self.qdd }
    }
}

/// A trajectory whose frames are these states, in order.
pub(crate) fn trajectory(model: &Model, states: &[State]) -> Trajectory {
    let grid = TimeGrid { start_s: 0.0, step_s: 0.01, frames: states.len() };
    let column = |c: usize, part: fn(&State) -> &Vec<f64>| states.iter().map(|s| part(s)[c]).collect::<Vec<f64>>();
    let columns = (0..model.coordinates().len())
        .map(|c| [column(c, |s| &s.q), column(c, |s| &s.qd), column(c, |s| &s.qdd)])
        .collect();
    Trajectory::new(model, grid, columns).unwrap()
}

/// The loads of several frames as series; every frame loads the same bodies in the same order.
pub(crate) fn load_series(frames: &[Vec<BodyLoad>]) -> Vec<LoadSeries> {
    (0..frames[0].len())
        .map(|i| LoadSeries {
            body: frames[0][i].body,
            points: frames.iter().map(|loads| loads[i].point).collect(),
            wrenches: frames.iter().map(|loads| loads[i].wrench).collect(),
        })
        .collect()
}

/// The same model under another gravity, each body replaced by its image.
pub(crate) fn rebuilt(model: &Model, gravity: Vec3, image: impl Fn(&Body) -> Body) -> Model {
    let bodies = model.bodies().iter().map(image).collect();
    Model::new(model.name(), gravity, bodies, model.coordinates().to_vec(), Vec::new()).unwrap()
}

/// Rotation about a unit axis, by the exponential series of nalgebra's axis-angle (independent of the product's).
pub(crate) fn turn(axis: Vec3, angle: f64) -> Mat3 {
    *nalgebra::Rotation3::from_axis_angle(&nalgebra::Unit::new_normalize(axis), angle).matrix()
}

/// |d|² 1 - d dᵀ: the inertia of a unit point mass at d about the origin.
pub(crate) fn point_inertia(d: Vec3) -> Mat3 {
    Mat3::identity() * d.norm_squared() - d * d.transpose()
}

/// Largest magnitude of a list, zero for none.
pub(crate) fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().map(f64::abs).fold(0.0, f64::max)
}

/// Largest difference of two lists, which have one length.
pub(crate) fn distance(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len(), "lists of different length");
    largest(a.iter().zip(b).map(|(x, y)| x - y))
}

/// Asserts |found - expected| <= tolerance.
#[track_caller]
pub(crate) fn assert_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found} instead of {expected}, allowed {tolerance:e}");
}

/// Derivatives at `t` by the five-point stencil D(h), and a bound of their error.
///
/// D(h) misses f' by h⁴/30 f⁽⁵⁾, D(2h) by 16 times that, so |D(h) - D(2h)| is 15 times the error. Values known to
/// `noise` add 1.5 noise/h (the weights sum to 18/12).
pub(crate) fn derivatives(f: impl Fn(f64) -> Vec<f64>, t: f64, h: f64, noise: f64) -> (Vec<f64>, f64) {
    let stencil = |h: f64| -> Vec<f64> {
        let [back2, back1, on1, on2] = [-2.0, -1.0, 1.0, 2.0].map(|k| f(t + k * h));
        (0..on1.len()).map(|i| (8.0 * (on1[i] - back1[i]) - (on2[i] - back2[i])) / (12.0 * h)).collect()
    };
    let (fine, coarse) = (stencil(h), stencil(2.0 * h));
    let error = distance(&fine, &coarse) + 1.5 * noise / h;
    (fine, error)
}
