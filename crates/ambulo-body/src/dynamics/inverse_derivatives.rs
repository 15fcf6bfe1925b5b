//! Exact derivatives of inverse dynamics by positions, rates and accelerations, for several frames side by side.
//!
//! Every joint becomes a chain of massless links with one axis each. Spatial vectors (angular part or moment first) are
//! at the origin of the world. λ is the link before link j, gravity is the acceleration a = -g of the ground, and the
//! superscript c marks sums over a link and all bodies that it carries:
//!
//!   v_j = v_λ + S_j q̇_j          Ψ̇_j = v_λ × S_j
//!   a_j = a_λ + S_j q̈_j + Ψ̇_j q̇_j    Ψ̈_j = a_λ × S_j + v_λ × Ψ̇_j
//!   f   = I a + v ×* I v           B = ½ [(v ×*) I - I (v ×) + (I v) ×̄*]
//!
//! and for i = j, or any link i that carries j,
//!
//!   ∂τ_i/∂q̈_j = S_iᵀ I_jᶜ S_j                                    ∂τ_j/∂q̈_i = the same
//!   ∂τ_i/∂q̇_j = 2 S_iᵀ (B_jᶜ S_j + I_jᶜ Ψ̇_j)                      ∂τ_j/∂q̇_i = 2 S_jᵀ (B_jᶜ S_i + I_jᶜ Ψ̇_i)
//!   ∂τ_i/∂q_j = S_iᵀ (2 B_jᶜ Ψ̇_j + I_jᶜ Ψ̈_j + S_j ×* f_jᶜ)    ∂τ_j/∂q_i = S_jᵀ (2 B_jᶜ Ψ̇_i + I_jᶜ Ψ̈_i)     (i ≠ j)
//!
//! With the momentum (n, p) of a body and its inertia (m, h = m c, J) at the origin, B depends on the angular part
//! only: B (ω, u) = (T ω, ω × p) with T = ½ (ω_b × J - J ω_b × - v × h × - h × v × - n ×).
//!
//! An axis s whose displacement follows a curve f of its coordinate has S = s f', and its rates gain the terms of a
//! changing axis:
//!
//!   Ψ̇_j = v_λ × S_j + s f'' q̇     Ψ̈_j = a_λ × S_j + v_λ × (v_λ × S_j) + 2 v_λ × s f'' q̇ + s (f'' q̈ + f‴ q̇²)
//!
//! and ∂τ_j/∂q_j also has (s f'')ᵀ f_jᶜ. These follow from the equations above by the chain rule.
//!
//! Source: S. Singh, R. P. Russell, P. M. Wensing, "Efficient analytical derivatives of rigid-body dynamics using
//! spatial vector algebra", IEEE Robotics and Automation Letters 7 (2022), arXiv 2105.05102 (equations unverified; the
//! tests compare with finite differences and an independent recursion). The form of B is ours.
//! Cost: one pass over all pairs of links of which one carries the other.
//! Not handled: ball-like joints; bushings, which are left out.
//! Pinned by: tests/inverse_derivatives.rs

use crate::kinematics::Posture;
use crate::kinematics::lanes::{Lanes, M3, V3};
use crate::kinematics::plan::{Plan, Source};
use crate::kinematics::sweep::{self, Scratch};
use crate::model::{Drive, Function, Model};
use crate::spatial::{Pose, Vec3};
use nalgebra::DMatrix;
use pulp::{Arch, Simd, WithSimd};
use std::array;

/// A joint for which derivatives are not computed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("joint `{joint}` of the model is ball-like; derivatives of inverse dynamics need joints of hinges and slides")]
pub struct CurvedJointError {
    /// Name of the joint.
    pub joint: String,
}

/// Generalised forces of one posture and their derivatives. Rows are forces, columns are coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct InverseDerivatives {
    /// τ [N.m or N].
    pub forces: Vec<f64>,
    /// ∂τ/∂q.
    pub by_position: DMatrix<f64>,
    /// ∂τ/∂q̇.
    pub by_rate: DMatrix<f64>,
    /// ∂τ/∂q̈: the mass matrix.
    pub by_acceleration: DMatrix<f64>,
}

/// Computes the generalised forces without external loads and bushings, and their derivatives by positions, rates and
/// accelerations.
///
/// In the mass matrix, the diagonal entry of the height of the pelvis is the body mass:
///
/// ```
/// use ambulo_body::dynamics::inverse_derivatives;
/// use ambulo_body::kinematics::Posture;
/// use ambulo_body::model::anthropometry::{Build, SegmentTable};
/// use ambulo_body::model::full_body::full_body;
///
/// let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
/// let model = full_body(&build)?.model;
/// let still = vec![0.0; model.coordinates().len()];
/// let found = inverse_derivatives(&model, Posture { q: &still, qd: &still, qdd: &still })?;
/// let height = model.coordinate("pelvis_ty").ok_or("no such coordinate")?.index();
/// assert!((found.by_acceleration[(height, height)] - 75.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the model has a ball-like joint.
///
/// # Panics
/// If the length of a slice of `posture` differs from the number of coordinates.
pub fn inverse_derivatives(model: &Model, posture: Posture<'_>) -> Result<InverseDerivatives, CurvedJointError> {
    let mut kernel = DerivativeKernel::<1>::new(model)?;
    kernel.scratch.load_posture(posture);
    kernel.evaluate();
    let count = kernel.coordinates();
    let matrix = |of: &[Lanes<1>]| DMatrix::from_fn(count, count, |i, j| of[i * count + j].0[0]);
    Ok(InverseDerivatives {
        forces: kernel.forces.iter().map(|x| x.0[0]).collect(),
        by_position: matrix(&kernel.slopes[0]),
        by_rate: matrix(&kernel.slopes[1]),
        by_acceleration: matrix(&kernel.slopes[2]),
    })
}

/// A spatial vector at the origin of the world: a motion (angular, linear), or a force (moment, force).
#[derive(Debug, Clone, Copy)]
pub struct Spatial<const N: usize> {
    /// The angular part.
    pub angular: V3<N>,
    /// The linear part.
    pub linear: V3<N>,
}

impl<const N: usize> Spatial<N> {
    pub(crate) const ZERO: Spatial<N> = Spatial { angular: V3::ZERO, linear: V3::ZERO };

    #[inline(always)]
    fn plus(self, other: Spatial<N>) -> Spatial<N> {
        Spatial { angular: self.angular + other.angular, linear: self.linear + other.linear }
    }

    #[inline(always)]
    fn times(self, factor: Lanes<N>) -> Spatial<N> {
        Spatial { angular: self.angular * factor, linear: self.linear * factor }
    }

    /// Self × other, both motions.
    #[inline(always)]
    pub(crate) fn cross(self, other: Spatial<N>) -> Spatial<N> {
        Spatial {
            angular: self.angular.cross(other.angular),
            linear: self.angular.cross(other.linear) + self.linear.cross(other.angular),
        }
    }

    /// Self ×* force.
    #[inline(always)]
    fn cross_force(self, force: Spatial<N>) -> Spatial<N> {
        Spatial {
            angular: self.angular.cross(force.angular) + self.linear.cross(force.linear),
            linear: self.angular.cross(force.linear),
        }
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: Spatial<N>) -> Lanes<N> {
        self.angular.dot(other.angular) + self.linear.dot(other.linear)
    }
}

/// One axis of a joint that a coordinate moves.
#[derive(Debug, Clone)]
pub struct MovingLink {
    pub coordinate: usize,
    /// The link that carries this one; `None` for the first link of a root.
    pub before: Option<usize>,
    axis: usize,
    segment: usize,
    turns: bool,
    displacement: Follows,
}

/// How the displacement along an axis follows the coordinate of its link.
#[derive(Debug, Clone)]
enum Follows {
    /// With a constant slope.
    Line(f64),
    /// By a curve; if the axis belongs to a coupled coordinate, by the coupler first.
    Curve { coupler: Option<Function>, curve: Function },
}

impl Follows {
    /// The first three derivatives of the displacement at a coordinate.
    fn derivatives(&self, q: f64) -> [f64; 3] {
        match self {
            Follows::Line(slope) => [*slope, 0.0, 0.0],
            Follows::Curve { coupler: None, curve } => derivatives(curve, q),
            Follows::Curve { coupler: Some(coupler), curve } => {
                let [g1, g2, g3] = derivatives(coupler, q);
                let [f1, f2, f3] = derivatives(curve, coupler.at(q)[0]);
                [f1 * g1, f2 * g1 * g1 + f1 * g2, f3 * g1.powi(3) + 3.0 * f2 * g1 * g2 + f1 * g3]
            }
        }
    }
}

/// The first three derivatives of a function; the third by a difference of the second.
fn derivatives(function: &Function, x: f64) -> [f64; 3] {
    /// Step [rad or m].
    const STEP: f64 = 1e-4;
    let [_, first, second] = function.at(x);
    let third = (function.at(x + STEP)[2] - function.at(x - STEP)[2]) / (2.0 * STEP);
    [first, second, third]
}

/// Sums over a link and all bodies that it carries.
#[derive(Debug, Clone, Copy)]
struct Composite<const N: usize> {
    mass: f64,
    /// m c [kg.m].
    first_moment: V3<N>,
    /// Inertia about the origin of the world [kg.m²].
    inertia: M3<N>,
    /// T of the equations, and the linear momentum p.
    coriolis: M3<N>,
    momentum: V3<N>,
    force: Spatial<N>,
}

/// Scratch and results for N frames.
#[derive(Debug, Clone)]
pub struct DerivativeKernel<const N: usize> {
    plan: Plan,
    arch: Arch,
    /// Coordinates with their rates and accelerations, and what the sweep computes from them.
    pub scratch: Scratch<N>,
    /// The axes that coordinates move, parents first.
    pub links: Vec<MovingLink>,
    /// The last link that moves each body.
    pub link_of_body: Vec<Option<usize>>,
    /// S of the links.
    pub axes: Vec<Spatial<N>>,
    /// v of the links.
    pub velocities: Vec<Spatial<N>>,
    /// a of the links.
    accelerations: Vec<Spatial<N>>,
    /// Ψ̇ of the links.
    axis_rates: Vec<Spatial<N>>,
    /// Ψ̈ of the links.
    axis_accelerations: Vec<Spatial<N>>,
    /// s f'' of the links; zero for those that do not follow a curve.
    pub bends: Vec<Spatial<N>>,
    composites: Vec<Composite<N>>,
    /// τ of the coordinates.
    pub forces: Vec<Lanes<N>>,
    /// ∂τ/∂q, ∂τ/∂q̇, ∂τ/∂q̈, row after row.
    pub slopes: [Vec<Lanes<N>>; 3],
}

impl<const N: usize> DerivativeKernel<N> {
    /// All coordinates are independent.
    pub(crate) fn new(model: &Model) -> Result<DerivativeKernel<N>, CurvedJointError> {
        DerivativeKernel::with(model, false)
    }

    /// Coupled coordinates follow their leaders: forces and derivatives belong to the leaders. The values, rates and
    /// accelerations in `scratch` must obey the couplers.
    pub fn with_couplers(model: &Model) -> Result<DerivativeKernel<N>, CurvedJointError> {
        DerivativeKernel::with(model, true)
    }

    fn with(model: &Model, coupled: bool) -> Result<DerivativeKernel<N>, CurvedJointError> {
        let plan = Plan::new(model);
        let (links, link_of_body) = links(model, &plan, coupled)?;
        let (count, coordinates) = (links.len(), plan.coordinates);
        Ok(DerivativeKernel {
            scratch: Scratch::new(&plan),
            arch: Arch::new(),
            axes: vec![Spatial::ZERO; count],
            velocities: vec![Spatial::ZERO; count],
            accelerations: vec![Spatial::ZERO; count],
            axis_rates: vec![Spatial::ZERO; count],
            axis_accelerations: vec![Spatial::ZERO; count],
            bends: vec![Spatial::ZERO; count],
            composites: vec![Composite::ZERO; count],
            forces: vec![Lanes::ZERO; coordinates],
            slopes: array::from_fn(|_| vec![Lanes::ZERO; coordinates * coordinates]),
            plan,
            links,
            link_of_body,
        })
    }

    /// Number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.plan.coordinates
    }

    /// Pose of a body in one lane.
    pub fn pose(&self, body: usize, lane: usize) -> Pose {
        let state = &self.scratch.states[body + 1];
        let joint =
            Pose { rotation: state.rotation.lane(lane), translation: (state.center - state.to_center).lane(lane) };
        joint * self.plan.segments[body].joint_from_body
    }

    /// Computes forces and slopes from the coordinates in `scratch`.
    pub fn evaluate(&mut self) {
        let arch = self.arch;
        arch.dispatch(Evaluate(self));
    }

    /// As [`DerivativeKernel::evaluate`], without slopes, in less time. The forces are the same to the last bit.
    pub fn evaluate_forces(&mut self) {
        let arch = self.arch;
        arch.dispatch(EvaluateForces(self));
    }

    #[inline(always)]
    fn forward(&mut self) {
        sweep::forward(&self.plan, &mut self.scratch);
        let ground = Spatial { angular: V3::ZERO, linear: V3::splat(-self.plan.gravity) };
        for (k, link) in self.links.iter().enumerate() {
            let state = &self.scratch.states[link.segment + 1];
            let along = |factor: Lanes<N>| {
                let direction = self.scratch.axes.direction[link.axis] * factor;
                if link.turns {
                    Spatial { angular: direction, linear: (state.center - state.to_center).cross(direction) }
                } else {
                    Spatial { angular: V3::ZERO, linear: direction }
                }
            };
            let [slope, bend, bend_slope] = link.derivatives(&self.scratch.q[link.coordinate]);
            let axis = along(slope);
            let rate = Lanes(self.scratch.qd[link.coordinate]);
            let acceleration = Lanes(self.scratch.qdd[link.coordinate]);
            let (v, a) = match link.before {
                None => (Spatial::ZERO, ground),
                Some(before) => (self.velocities[before], self.accelerations[before]),
            };
            let turned = v.cross(axis);
            let (mut axis_rate, mut axis_acceleration) = (turned, a.cross(axis).plus(v.cross(turned)));
            if link.is_curved() {
                let bending = along(bend * rate);
                axis_rate = axis_rate.plus(bending);
                let changing = along(bend * acceleration + bend_slope * rate * rate);
                axis_acceleration = axis_acceleration.plus(v.cross(bending).times(Lanes::splat(2.0))).plus(changing);
                self.bends[k] = along(bend);
            }
            self.axes[k] = axis;
            self.axis_rates[k] = axis_rate;
            self.axis_accelerations[k] = axis_acceleration;
            self.velocities[k] = v.plus(axis.times(rate));
            self.accelerations[k] = a.plus(axis.times(acceleration)).plus(axis_rate.times(rate));
        }
    }

    /// Inertia, momentum and force of the bodies that each link moves directly.
    #[inline(always)]
    fn load_bodies(&mut self) {
        self.composites.fill(Composite::ZERO);
        for (body, segment) in self.plan.segments.iter().enumerate() {
            let Some(link) = self.link_of_body[body] else { continue };
            let state = &self.scratch.states[body + 1];
            let (center, mass) = (state.center, Lanes::splat(segment.mass));
            let square = center.dot(center);
            let inertia = M3(array::from_fn(|j| {
                // R I Rᵀ e_j + m (|c|² e_j - c c_j)
                let unit = V3::splat(Vec3::ith(j, 1.0));
                let about_center = state.rotation.turn(fixed(&segment.inertia, state.rotation.turn_back(unit)));
                about_center + (unit * square - center * center.0[j]) * mass
            }));
            let (v, a) = (self.velocities[link], self.accelerations[link]);
            let one = Composite::of_body(segment.mass, center * mass, inertia, v, a);
            self.composites[link].add(&one);
        }
    }

    /// The forces of [`DerivativeKernel::backward`].
    #[inline(always)]
    fn backward_forces(&mut self) {
        self.forces.fill(Lanes::ZERO);
        for j in (0..self.links.len()).rev() {
            let force = self.composites[j].force;
            self.forces[self.links[j].coordinate] += self.axes[j].dot(force);
            if let Some(before) = self.links[j].before {
                self.composites[before].force = self.composites[before].force.plus(force);
            }
        }
    }

    #[inline(always)]
    fn backward(&mut self) {
        let count = self.plan.coordinates;
        self.forces.fill(Lanes::ZERO);
        for slopes in &mut self.slopes {
            slopes.fill(Lanes::ZERO);
        }
        for j in (0..self.links.len()).rev() {
            let composite = self.composites[j];
            let (axis, rate, acceleration) = (self.axes[j], self.axis_rates[j], self.axis_accelerations[j]);
            let column = self.links[j].coordinate;
            self.forces[column] += axis.dot(composite.force);
            if self.links[j].is_curved() {
                self.slopes[0][column * count + column] += self.bends[j].dot(composite.force);
            }
            let two = Lanes::splat(2.0);
            let by_acceleration = composite.momentum_of(axis);
            let by_rate = composite.coriolis_on(axis).plus(composite.momentum_of(rate)).times(two);
            let by_position = composite
                .coriolis_on(rate)
                .times(two)
                .plus(composite.momentum_of(acceleration))
                .plus(axis.cross_force(composite.force));
            // 2 Bᵀ S, whose linear part is zero.
            let turned = (composite.coriolis.turn_back(axis.angular) + composite.momentum.cross(axis.linear)) * two;
            let mut other = Some(j);
            while let Some(i) = other {
                let (carrier, carrier_rate) = (self.axes[i], self.axis_rates[i]);
                let row = self.links[i].coordinate;
                let (above, below) = (row * count + column, column * count + row);
                let mass = carrier.dot(by_acceleration);
                self.slopes[2][above] += mass;
                self.slopes[1][above] += carrier.dot(by_rate);
                self.slopes[0][above] += carrier.dot(by_position);
                if i != j {
                    self.slopes[2][below] += mass;
                    self.slopes[1][below] += turned.dot(carrier.angular) + by_acceleration.dot(carrier_rate) * 2.0;
                    self.slopes[0][below] +=
                        turned.dot(carrier_rate.angular) + by_acceleration.dot(self.axis_accelerations[i]);
                }
                other = self.links[i].before;
            }
            if let Some(before) = self.links[j].before {
                self.composites[before].add(&composite);
            }
        }
    }
}

impl MovingLink {
    pub fn is_curved(&self) -> bool {
        matches!(self.displacement, Follows::Curve { .. })
    }

    #[inline(always)]
    fn derivatives<const N: usize>(&self, q: &[f64; N]) -> [Lanes<N>; 3] {
        if let Follows::Line(slope) = self.displacement {
            return [Lanes::splat(slope), Lanes::ZERO, Lanes::ZERO];
        }
        let found = q.map(|q| self.displacement.derivatives(q));
        array::from_fn(|k| Lanes(found.map(|derivatives| derivatives[k])))
    }
}

/// The moving axes of a model, parents first, and the last axis that moves each body.
fn links(model: &Model, plan: &Plan, coupled: bool) -> Result<(Vec<MovingLink>, Vec<Option<usize>>), CurvedJointError> {
    let (mut links, mut link_of_body): (Vec<MovingLink>, Vec<Option<usize>>) = (Vec::new(), Vec::new());
    for (index, (segment, body)) in plan.segments.iter().zip(model.bodies()).enumerate() {
        if segment.spherical.is_some() || segment.arc.is_some() {
            return Err(CurvedJointError { joint: body.joint.name.clone() });
        }
        let mut last = segment.parent.checked_sub(1).and_then(|parent| link_of_body[parent]);
        let translations = segment.translations.clone().map(|axis| (axis, false));
        for (axis, turns) in translations.chain(segment.rotations.clone().map(|axis| (axis, true))) {
            let (coordinate, displacement) = match &plan.axes[axis].source {
                Source::Fixed(_) => continue,
                Source::Curve { coordinate, function } => {
                    (*coordinate, Follows::Curve { coupler: None, curve: function.clone() })
                }
                Source::Line { coordinate, slope, .. } => (*coordinate, Follows::Line(*slope)),
            };
            let (coordinate, displacement) = match &model.coordinates()[coordinate].drive {
                Drive::Coupled(leader, coupler) if coupled => (leader.index(), displacement.after(coupler)),
                _ => (coordinate, displacement),
            };
            links.push(MovingLink { coordinate, before: last, axis, segment: index, turns, displacement });
            last = Some(links.len() - 1);
        }
        link_of_body.push(last);
    }
    Ok((links, link_of_body))
}

impl Follows {
    /// This displacement as the displacement of a coordinate that follows a coupler.
    fn after(self, coupler: &Function) -> Follows {
        let curve = match self {
            Follows::Line(slope) => Function::Linear { slope, intercept: 0.0 },
            Follows::Curve { curve, .. } => curve,
        };
        Follows::Curve { coupler: Some(coupler.clone()), curve }
    }
}

/// M v for a matrix that is the same in all lanes.
#[inline(always)]
fn fixed<const N: usize>(matrix: &crate::spatial::Mat3, v: V3<N>) -> V3<N> {
    M3::splat(matrix).turn(v)
}

impl<const N: usize> Composite<N> {
    const ZERO: Composite<N> = Composite {
        mass: 0.0,
        first_moment: V3::ZERO,
        inertia: M3([V3::ZERO; 3]),
        coriolis: M3([V3::ZERO; 3]),
        momentum: V3::ZERO,
        force: Spatial::ZERO,
    };

    #[inline(always)]
    fn of_body(mass: f64, first_moment: V3<N>, inertia: M3<N>, v: Spatial<N>, a: Spatial<N>) -> Composite<N> {
        let mut body = Composite { mass, first_moment, inertia, ..Composite::ZERO };
        let momentum = body.momentum_of(v);
        body.momentum = momentum.linear;
        body.force = body.momentum_of(a).plus(v.cross_force(momentum));
        let half = Lanes::splat(0.5);
        body.coriolis = M3(array::from_fn(|j| {
            let unit = V3::splat(Vec3::ith(j, 1.0));
            let turning = v.angular.cross(inertia.turn(unit)) - inertia.turn(v.angular.cross(unit));
            let moving = v.linear.cross(first_moment.cross(unit)) + first_moment.cross(v.linear.cross(unit));
            (turning - moving - momentum.angular.cross(unit)) * half
        }));
        body
    }

    /// I (ω, u) = (J ω + h × u, m u + ω × h).
    #[inline(always)]
    fn momentum_of(&self, v: Spatial<N>) -> Spatial<N> {
        Spatial {
            angular: self.inertia.turn(v.angular) + self.first_moment.cross(v.linear),
            linear: v.linear * Lanes::splat(self.mass) + v.angular.cross(self.first_moment),
        }
    }

    /// B (ω, u) = (T ω, ω × p).
    #[inline(always)]
    fn coriolis_on(&self, v: Spatial<N>) -> Spatial<N> {
        Spatial { angular: self.coriolis.turn(v.angular), linear: v.angular.cross(self.momentum) }
    }

    #[inline(always)]
    fn add(&mut self, other: &Composite<N>) {
        self.mass += other.mass;
        self.first_moment += other.first_moment;
        self.momentum += other.momentum;
        for j in 0..3 {
            self.inertia.0[j] += other.inertia.0[j];
            self.coriolis.0[j] += other.coriolis.0[j];
        }
        self.force = self.force.plus(other.force);
    }
}

/// The two sweeps, compiled for each generation of vector instructions and selected at run time.
struct Evaluate<'a, const N: usize>(&'a mut DerivativeKernel<N>);

impl<const N: usize> WithSimd for Evaluate<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.0.forward();
        self.0.load_bodies();
        self.0.backward();
    }
}

/// The same without slopes.
struct EvaluateForces<'a, const N: usize>(&'a mut DerivativeKernel<N>);

impl<const N: usize> WithSimd for EvaluateForces<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.0.forward();
        self.0.load_bodies();
        self.0.backward_forces();
    }
}
