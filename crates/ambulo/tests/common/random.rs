//! Random numbers, models, postures, motions and loads.

use super::assembly::{Assembly, Axes, Frames, follow};
use super::{State, point_inertia};
use ambulo::dynamics::BodyLoad;
use ambulo::model::{BodyId, Displacement, Function, JointAxis, JointSpeeds, Knots, Model, SimmSpline};
use ambulo::numerics::{Smoothing, SplineDegree, SplineFitter};
use ambulo::spatial::{Inertia, Mat3, Pose, Vec3, Wrench};

/// Splitmix64: the same numbers on every machine.
pub(crate) struct Random {
    state: u64,
}

impl Random {
    pub(crate) fn new(seed: u64) -> Random {
        Random { state: seed.wrapping_mul(0x2545_F491_4F6C_DD1D) }
    }

    fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform in [low, high).
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// Uniform in ±size.
    pub(crate) fn within(&mut self, size: f64) -> f64 {
        self.between(-size, size)
    }

    /// An integer below n.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    /// True in this share of the calls.
    pub(crate) fn chance(&mut self, share: f64) -> bool {
        self.between(0.0, 1.0) < share
    }

    /// Each number in ±size.
    pub(crate) fn vector(&mut self, size: f64) -> Vec3 {
        Vec3::new(self.within(size), self.within(size), self.within(size))
    }

    pub(crate) fn list(&mut self, n: usize, size: f64) -> Vec<f64> {
        (0..n).map(|_| self.within(size)).collect()
    }

    /// A unit vector in general position.
    pub(crate) fn unit(&mut self) -> Vec3 {
        loop {
            let v = self.vector(1.0);
            if v.norm() > 0.1 {
                return v.normalize();
            }
        }
    }

    /// A unit vector along an axis, against one, or in general position.
    pub(crate) fn direction(&mut self) -> Vec3 {
        match self.below(9) {
            k @ 0..3 => Vec3::ith(k, 1.0),
            k @ 3..6 => Vec3::ith(k - 3, -1.0),
            _ => self.unit(),
        }
    }

    pub(crate) fn rotation(&mut self) -> Mat3 {
        super::turn(self.unit(), self.within(3.0))
    }

    /// The identity, a translation, or a general pose within half a metre.
    pub(crate) fn pose(&mut self) -> Pose {
        match self.below(4) {
            0 => Pose::IDENTITY,
            1 => Pose::at(self.vector(0.5)),
            _ => Pose { rotation: self.rotation(), translation: self.vector(0.5) },
        }
    }
}

/// Which functions drive the axes of custom joints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Curves {
    /// Every kind.
    Any,
    /// Only those with all derivatives, so that finite differences have their textbook error.
    Smooth,
}

/// What carries the first body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Root {
    /// Any joint to ground; other bodies may also be joined to ground.
    Any,
    /// A free joint; all others descend from it.
    Free,
}

/// What kind of random model is wanted.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Recipe {
    pub(crate) curves: Curves,
    pub(crate) root: Root,
}

impl Recipe {
    pub(crate) const ANY: Recipe = Recipe { curves: Curves::Any, root: Root::Any };
    pub(crate) const SMOOTH: Recipe = Recipe { curves: Curves::Smooth, root: Root::Any };
    pub(crate) const FREE: Recipe = Recipe { curves: Curves::Any, root: Root::Free };
}

/// Joint kinds of OpenSim.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    Weld,
    Pin,
    Slider,
    Universal,
    Gimbal,
    Planar,
    Ball,
    Free,
    Ellipsoid,
    Custom,
}

pub(crate) const KINDS: [Kind; 10] = [
    Kind::Weld,
    Kind::Pin,
    Kind::Slider,
    Kind::Universal,
    Kind::Gimbal,
    Kind::Planar,
    Kind::Ball,
    Kind::Free,
    Kind::Ellipsoid,
    Kind::Custom,
];

/// A tree of 2 to 12 bodies; custom joints are as likely as all others together.
pub(crate) fn model(r: &mut Random, recipe: Recipe) -> Model {
    let mut assembly = Assembly::new();
    let mut bodies: Vec<BodyId> = Vec::new();
    for i in 0..2 + r.below(11) {
        let kind = match recipe.root {
            Root::Free if i == 0 => Kind::Free,
            _ if r.chance(0.4) => Kind::Custom,
            _ => KINDS[r.below(KINDS.len())],
        };
        let to_ground = i == 0 || (recipe.root == Root::Any && r.chance(0.1));
        let parent = (!to_ground).then(|| bodies[r.below(bodies.len())]);
        bodies.push(body(r, &mut assembly, kind, parent, recipe.curves));
    }
    let gravity = r.vector(10.0);
    assembly.model(gravity)
}

/// One body of each of these kinds, each on the one before.
pub(crate) fn chain_of(r: &mut Random, kinds: &[Kind], curves: Curves) -> Model {
    let mut assembly = Assembly::new();
    let mut parent = None;
    for &kind in kinds {
        parent = Some(body(r, &mut assembly, kind, parent, curves));
    }
    let gravity = r.vector(10.0);
    assembly.model(gravity)
}

fn body(r: &mut Random, assembly: &mut Assembly, kind: Kind, parent: Option<BodyId>, curves: Curves) -> BodyId {
    let axes = axes(r, assembly, kind, curves);
    let frames = Frames { parent_from_joint: r.pose(), child_from_joint: r.pose() };
    let inertia = inertia(r);
    assembly.attach(parent, frames, axes, inertia)
}

fn axes(r: &mut Random, assembly: &mut Assembly, kind: Kind, curves: Curves) -> Axes {
    let (x, y, z) = (Vec3::x(), Vec3::y(), Vec3::z());
    let mut along = |rotations: &[Vec3], translations: &[Vec3]| Axes {
        rotations: rotations.iter().map(|d| assembly.axis(*d)).collect(),
        translations: translations.iter().map(|d| assembly.axis(*d)).collect(),
        speeds: JointSpeeds::Rates,
    };
    match kind {
        Kind::Weld => Axes::weld(),
        Kind::Pin => along(&[z], &[]),
        Kind::Slider => along(&[], &[x]),
        Kind::Universal => along(&[x, y], &[]),
        Kind::Gimbal => along(&[x, y, z], &[]),
        Kind::Planar => along(&[z], &[x, y]),
        Kind::Ball => assembly.ball(&[]),
        Kind::Free => assembly.free(),
        Kind::Ellipsoid => {
            let radii = Vec3::new(r.between(0.05, 0.4), r.between(0.05, 0.4), r.between(0.05, 0.4));
            Axes { speeds: JointSpeeds::Ellipsoid(radii), ..assembly.ball(&[]) }
        }
        Kind::Custom => custom(r, assembly, curves),
    }
}

/// Up to three rotations and translations that follow one to three coordinates, or stay at zero or elsewhere.
fn custom(r: &mut Random, assembly: &mut Assembly, curves: Curves) -> Axes {
    let coordinates: Vec<_> = (0..1 + r.below(3)).map(|_| assembly.coordinate()).collect();
    let mut axes = |n: usize| -> Vec<JointAxis> {
        (0..n)
            .map(|_| {
                let direction = r.direction();
                match r.below(8) {
                    0 => JointAxis { direction, displacement: Displacement::Fixed(0.0) },
                    1 => JointAxis { direction, displacement: Displacement::Fixed(r.within(0.7)) },
                    _ => follow(direction, coordinates[r.below(coordinates.len())], function(r, curves)),
                }
            })
            .collect()
    };
    Axes { rotations: axes(3), translations: axes(3), speeds: JointSpeeds::Rates }
}

/// A function whose values for |x| <= 1 are of the order of one.
fn function(r: &mut Random, curves: Curves) -> Function {
    let kinds = if curves == Curves::Smooth { 4 } else { 9 };
    match r.below(kinds) {
        0 => Function::Linear { slope: r.within(1.5), intercept: r.within(0.3) },
        1 => Function::Polynomial((0..1 + r.below(5)).map(|_| r.within(0.4)).collect()),
        2 => Function::Sine {
            amplitude: r.within(0.6),
            omega: r.between(0.5, 2.5),
            phase: r.within(3.0),
            offset: r.within(0.3),
        },
        3 => Function::Scaled(r.within(1.5), Box::new(Function::Polynomial(r.list(3, 0.4)))),
        4 | 5 => Function::SimmSpline(SimmSpline::new(knots(r)).unwrap()),
        6 => {
            let (times, values): (Vec<f64>, Vec<f64>) =
                (0..12).map(|i| (0.2 * f64::from(i) - 1.1, r.within(0.5))).unzip();
            let fitter = SplineFitter::new(SplineDegree::Quintic, &times).unwrap();
            Function::NaturalSpline(fitter.fit(&values, Smoothing::Interpolate).unwrap())
        }
        7 => Function::Step { start: (-0.9, r.within(0.5)), end: (0.8, r.within(0.5)) },
        _ => Function::PiecewiseLinear(knots(r)),
    }
}

/// Two to seven knots that span about ±1.
pub(crate) fn knots(r: &mut Random) -> Knots {
    let n = 2 + r.below(6);
    let step = 2.0 / n as f64;
    let x = (0..n).map(|i| -1.0 + step * (i as f64 + r.between(0.2, 0.8))).collect();
    Knots::new(x, r.list(n, 0.5)).unwrap()
}

/// Of a few point masses, so that a real body could have it; one in seven is massless, some are principal.
pub(crate) fn inertia(r: &mut Random) -> Inertia {
    if r.chance(0.15) {
        return Inertia::new(0.0, r.vector(0.2), Mat3::zeros()).unwrap();
    }
    let points: Vec<(f64, Vec3)> = (0..5).map(|_| (r.between(0.1, 4.0), r.vector(0.3))).collect();
    let mass: f64 = points.iter().map(|(m, _)| m).sum();
    let center = points.iter().map(|(m, p)| p * *m).sum::<Vec3>() / mass;
    let about: Mat3 = points.iter().map(|(m, p)| point_inertia(p - center) * *m).sum();
    let about = if r.chance(0.3) { Mat3::from_diagonal(&about.symmetric_eigenvalues()) } else { about };
    Inertia::new(mass, center, about).unwrap()
}

/// Coordinates in ±1, rates in ±3, accelerations in ±20.
pub(crate) fn state(r: &mut Random, model: &Model) -> State {
    let n = model.coordinates().len();
    State { q: r.list(n, 1.0), qd: r.list(n, 3.0), qdd: r.list(n, 20.0) }
}

/// A load on one of the bodies: up to 500 N and 50 N.m, within a metre of the origin.
pub(crate) fn load(r: &mut Random, model: &Model) -> BodyLoad {
    let body = model.body_ids().nth(r.below(model.bodies().len())).unwrap();
    load_on(r, body)
}

pub(crate) fn load_on(r: &mut Random, body: BodyId) -> BodyLoad {
    BodyLoad { body, point: r.vector(1.0), wrench: Wrench { moment: r.vector(50.0), force: r.vector(500.0) } }
}

/// None to three loads.
pub(crate) fn loads(r: &mut Random, model: &Model) -> Vec<BodyLoad> {
    (0..r.below(4)).map(|_| load(r, model)).collect()
}

/// A model with a posture and loads.
pub(crate) struct Case {
    pub(crate) model: Model,
    pub(crate) state: State,
    pub(crate) loads: Vec<BodyLoad>,
}

pub(crate) fn case(seed: u64, recipe: Recipe) -> Case {
    let mut r = Random::new(seed);
    let model = model(&mut r, recipe);
    let state = state(&mut r, &model);
    let loads = loads(&mut r, &model);
    Case { model, state, loads }
}

/// q = amplitude sin(omega t + phase) for each coordinate.
pub(crate) struct Waves {
    waves: Vec<[f64; 3]>,
}

impl Waves {
    /// Amplitudes up to 0.8, up to 3 rad/s.
    pub(crate) fn new(r: &mut Random, model: &Model) -> Waves {
        let wave = |_: &_| [r.between(0.3, 0.8), r.between(1.0, 3.0), r.within(3.0)];
        Waves { waves: model.coordinates().iter().map(wave).collect() }
    }

    /// The state at an instant [s].
    pub(crate) fn at(&self, t: f64) -> State {
        let part = |f: fn(f64, f64, f64) -> f64| {
            self.waves.iter().map(|[amplitude, omega, phase]| f(*amplitude, *omega, omega * t + phase)).collect()
        };
        State {
            q: part(|a, _, x| a * x.sin()),
            qd: part(|a, w, x| a * w * x.cos()),
            qdd: part(|a, w, x| -a * w * w * x.sin()),
        }
    }
}
