//! Inverse dynamics: computes the force and moment in every joint from a motion and the known loads.
//!
//! The Newton-Euler equations of each body in absolute quantities, then one sweep from the leaves to the root. For body
//! i with mass centre c and joint centre J:
//!
//!   f_i = m (a - g) - Σ f_load + Σ_children f_j
//!   n_c = I α + ω × I ω - Σ (n_load + (p - c) × f_load) + Σ_children (n_j + (J_j - c) × f_j)
//!   n_i = n_c + (c - J) × f_i
//!
//! (f_i, n_i) is the wrench of the parent on body i at J. Its generalised forces are τ = Σ_axes (dθ/dq) a · n_i for
//! rotations and (dd/dq) e · f_i for translations, so that a coordinate's share of the power is τ q̇. At the root,
//! which is free, (f, n) is the residual: the disagreement between the measured loads and the motion. The bushings of a
//! model are loads that follow from the motion (model::bushing).
//!
//! | code       | symbol | unit        | meaning                                              |
//! | `force`    | f_i    | N           | of the parent on the body, world axes                |
//! | `moment`   | n_i    | N.m         | about the joint centre, world axes                   |
//! | `tau`      | τ      | N.m or N    | generalised force of a coordinate                    |
//!
//! Source: Luh, Walker, Paul 1980, "On-line computational scheme for mechanical manipulators" (unverified page), here
//! in world instead of body axes; signs of generalised forces as in OpenSim (`InverseDynamicsSolver`).
//! Cost: linear in bodies; measured by `cargo xtask bench`.
//! Pinned by: tests/independent.rs (recursive Newton-Euler in joint coordinates), tests/identities.rs,
//! tests/opensim_parity.rs

use crate::kinematics::lanes::{Lanes, M3, V3};
use crate::kinematics::plan::{Plan, PlannedBushing, Segment};
use crate::kinematics::sweep::{self, Scratch};
use crate::kinematics::{BodyMotion, Posture, Trajectory};
use crate::model::{BodyId, Model, bushing};
use crate::spatial::{Vec3, Wrench};
use pulp::{Arch, Simd, WithSimd};
use std::cell::RefCell;

/// Number of frames computed together: eight doubles fill the widest vector register in use (512 bits).
const SIDE_BY_SIDE: usize = 8;
/// The parent of joints to ground in [`Segment::parent`].
const GROUND: usize = 0;

/// Scratch memory of inverse dynamics for one model. Made once; later calls allocate nothing per frame.
#[derive(Debug, Clone)]
pub struct Workspace {
    plan: Plan,
    arch: Arch,
    one: Kernel<1>,
    many: Kernel<SIDE_BY_SIDE>,
}

/// Joint forces and body motions of one frame, borrowed from the workspace.
#[derive(Debug, Clone, Copy)]
pub struct FrameForces<'a> {
    plan: &'a Plan,
    kernel: &'a Kernel<1>,
}

/// Force and moment in a joint at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointReaction {
    /// Joint centre in the world [m]: the origin of the joint frame on the child.
    pub center: Vec3,
    /// Wrench of the parent on the child: force [N], moment about the joint centre [N.m], world axes.
    pub wrench: Wrench,
}

/// Result of inverse dynamics over a trajectory: generalised forces, powers, and the reaction wrench of every joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Forces {
    /// Generalised forces [N.m or N]: one column per coordinate, one entry per frame.
    pub generalized: Vec<Vec<f64>>,
    /// Reaction in the joint of each body: one column per body. From [`inverse_with_residual`] only the joints to
    /// ground have one, the other columns are empty.
    pub reactions: Vec<Vec<JointReaction>>,
}

/// The reactions in all joints of a motion, computed when they are read: eight frames are kept at a time, instead of 72
/// bytes per joint and frame. Made for reading frame after frame.
#[derive(Debug)]
pub struct ReactionReader<'a> {
    trajectory: &'a Trajectory,
    loads: Vec<LoadSeries>,
    /// The last computed block of eight frames, and the index of its first frame.
    block: RefCell<(Workspace, Option<usize>)>,
}

/// A known load on a body at one instant (ground reaction, device), in world axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyLoad {
    /// The loaded body.
    pub body: BodyId,
    /// Point of application, in the world [m].
    pub point: Vec3,
    /// Force [N] and moment about `point` [N.m].
    pub wrench: Wrench,
}

/// A known load on a body over the frames of a trajectory, in world axes.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadSeries {
    /// The loaded body.
    pub body: BodyId,
    /// Point of application, in the world [m], one entry per frame.
    pub points: Vec<Vec3>,
    /// Force [N] and moment about the point [N.m], one entry per frame.
    pub wrenches: Vec<Wrench>,
}

/// A load in N frames.
#[derive(Debug, Clone, Copy)]
struct LoadLanes<const N: usize> {
    body: usize,
    point: V3<N>,
    force: V3<N>,
    moment: V3<N>,
}

/// Scratch and results of N frames.
#[derive(Debug, Clone)]
struct Kernel<const N: usize> {
    scratch: Scratch<N>,
    loads: Vec<LoadLanes<N>>,
    force: Vec<V3<N>>,
    moment: Vec<V3<N>>,
    tau: Vec<[f64; N]>,
}

impl LoadSeries {
    /// The load at one frame.
    #[inline]
    #[must_use]
    pub fn at(&self, frame: usize) -> BodyLoad {
        BodyLoad { body: self.body, point: self.points[frame], wrench: self.wrenches[frame] }
    }
}

impl Workspace {
    /// Allocates the scratch memory for a model.
    #[must_use]
    pub fn new(model: &Model) -> Workspace {
        let plan = Plan::new(model);
        let (one, many) = (Kernel::new(&plan), Kernel::new(&plan));
        Workspace { plan, arch: Arch::new(), one, many }
    }
}

/// Inverse dynamics of one frame. The result gives generalised forces, joint reactions and body motions.
///
/// # Panics
/// If the length of a slice of `posture` differs from the number of coordinates.
pub fn inverse_frame<'w>(workspace: &'w mut Workspace, posture: Posture<'_>, loads: &[BodyLoad]) -> FrameForces<'w> {
    let Workspace { plan, arch, one: kernel, .. } = workspace;
    kernel.loads.clear();
    kernel.loads.extend(loads.iter().map(|load| LoadLanes {
        body: load.body.index(),
        point: V3::splat(load.point),
        force: V3::splat(load.wrench.force),
        moment: V3::splat(load.wrench.moment),
    }));
    kernel.scratch.load_posture(posture);
    arch.dispatch(Solve { plan, kernel: &mut *kernel });
    FrameForces { plan, kernel }
}

/// Generalised forces of all frames, without allocation: `store(coordinate, first_frame, values)` receives them in runs
/// of at most eight frames. [`inverse`] collects all results instead.
pub fn inverse_frames(
    workspace: &mut Workspace,
    trajectory: &Trajectory,
    loads: &[LoadSeries],
    mut store: impl FnMut(usize, usize, &[f64]),
) {
    let frames = trajectory.grid().frames;
    let Workspace { plan, arch, many: kernel, .. } = workspace;
    let mut first = 0;
    while first < frames {
        let count = SIDE_BY_SIDE.min(frames - first);
        kernel.solve_block(plan, *arch, trajectory, loads, first);
        for (coordinate, tau) in kernel.tau.iter().enumerate() {
            store(coordinate, first, &tau[..count]);
        }
        first += count;
    }
}

/// Inverse dynamics of a whole trajectory under the given loads, each with one entry per frame.
///
/// A frame at rest, and one in free fall, where nothing is needed:
///
/// ```
/// use ambulo_body::dynamics::{Workspace, inverse};
/// use ambulo_body::kinematics::Trajectory;
/// use ambulo_body::model::anthropometry::{Build, SegmentTable};
/// use ambulo_body::motion::TimeGrid;
///
/// let build = Build { table: SegmentTable::DeLevaMale, mass: 72.6, height: 1.80, toe_joint: false };
/// let model = build.human()?.model;
/// let vertical = model.coordinate("pelvis_ty").ok_or("no such coordinate")?.index();
/// let mut columns = vec![[vec![0.0; 2], vec![0.0; 2], vec![0.0; 2]]; model.coordinates().len()];
/// columns[vertical][2][1] = -9.80665;
/// let grid = TimeGrid { start_s: 0.0, step_s: 0.01, frames: 2 };
/// let trajectory = Trajectory::new(&model, grid, columns)?;
/// let forces = inverse(&mut Workspace::new(&model), &trajectory, &[]);
/// assert!((forces.generalized[vertical][0] - 72.6 * 9.80665).abs() < 1e-6);
/// assert!(forces.generalized[vertical][1].abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn inverse(workspace: &mut Workspace, trajectory: &Trajectory, loads: &[LoadSeries]) -> Forces {
    collect(workspace, trajectory, loads, |_| true)
}

/// As [`inverse`], but returns only the reactions of joints to ground, which are the residual. The other reactions take
/// more than half of the memory of [`inverse`]; [`ReactionReader`] gives them.
#[must_use]
pub fn inverse_with_residual(workspace: &mut Workspace, trajectory: &Trajectory, loads: &[LoadSeries]) -> Forces {
    collect(workspace, trajectory, loads, |segment| segment.parent == GROUND)
}

/// Reactions in the joints to ground without loads, in the order of the bodies: `visit` gets them frame after frame.
pub fn each_root_reaction(workspace: &mut Workspace, trajectory: &Trajectory, mut visit: impl FnMut(&[JointReaction])) {
    let Workspace { plan, arch, many: kernel, .. } = workspace;
    let frames = trajectory.grid().frames;
    let roots: Vec<usize> = (0..plan.segments.len()).filter(|&i| plan.segments[i].parent == GROUND).collect();
    let mut reactions = Vec::with_capacity(roots.len());
    for first in (0..frames).step_by(SIDE_BY_SIDE) {
        kernel.solve_block(plan, *arch, trajectory, &[], first);
        for lane in 0..SIDE_BY_SIDE.min(frames - first) {
            reactions.clear();
            reactions.extend(roots.iter().map(|&root| kernel.reaction(root, lane)));
            visit(&reactions);
        }
    }
}

fn collect(
    workspace: &mut Workspace,
    trajectory: &Trajectory,
    loads: &[LoadSeries],
    has_reaction: impl Fn(&Segment) -> bool,
) -> Forces {
    let Workspace { plan, arch, many: kernel, .. } = workspace;
    let frames = trajectory.grid().frames;
    let room_for = |segment: &Segment| Vec::with_capacity(if has_reaction(segment) { frames } else { 0 });
    let column = |_| Vec::with_capacity(frames);
    let mut forces = Forces {
        generalized: (0..plan.coordinates).map(column).collect(),
        reactions: plan.segments.iter().map(room_for).collect(),
    };
    for first in (0..frames).step_by(SIDE_BY_SIDE) {
        let count = SIDE_BY_SIDE.min(frames - first);
        kernel.solve_block(plan, *arch, trajectory, loads, first);
        for (column, tau) in forces.generalized.iter_mut().zip(&kernel.tau) {
            column.extend_from_slice(&tau[..count]);
        }
        for (i, column) in forces.reactions.iter_mut().enumerate().filter(|(i, _)| has_reaction(&plan.segments[*i])) {
            column.extend((0..count).map(|lane| kernel.reaction(i, lane)));
        }
    }
    forces
}

impl<'a> ReactionReader<'a> {
    /// Reads the reactions of a motion of `model` under loads, each with one entry per frame.
    #[must_use]
    pub fn new(model: &Model, trajectory: &'a Trajectory, loads: Vec<LoadSeries>) -> ReactionReader<'a> {
        ReactionReader { trajectory, loads, block: RefCell::new((Workspace::new(model), None)) }
    }

    /// Reaction in the joint of a body.
    ///
    /// # Panics
    /// If the trajectory has no such frame, or the model no such body.
    #[inline]
    #[must_use]
    pub fn at(&self, body: BodyId, frame: usize) -> JointReaction {
        self.solved(frame, |workspace, lane| workspace.many.reaction(body.index(), lane))
    }

    /// Pose, velocity and acceleration of a body.
    ///
    /// # Panics
    /// If the trajectory has no such frame, or the model no such body.
    #[inline]
    #[must_use]
    pub fn body_motion(&self, body: BodyId, frame: usize) -> BodyMotion {
        self.solved(frame, |workspace, lane| workspace.many.scratch.body_motion(&workspace.plan, body, lane))
    }

    /// Reads the block of eight frames that a frame belongs to; `read` gets the workspace and the place in the block.
    fn solved<T>(&self, frame: usize, read: impl FnOnce(&Workspace, usize) -> T) -> T {
        assert!(frame < self.trajectory.grid().frames, "frame {frame} of a shorter motion");
        let (workspace, solved) = &mut *self.block.borrow_mut();
        let first = frame - frame % SIDE_BY_SIDE;
        if *solved != Some(first) {
            let Workspace { plan, arch, many: kernel, .. } = &mut *workspace;
            kernel.solve_block(plan, *arch, self.trajectory, &self.loads, first);
            *solved = Some(first);
        }
        read(workspace, frame - first)
    }
}

/// Projects known joint wrenches on the coordinates: one generalised force per coordinate [N.m or N]. This is the last
/// step of [`inverse_frame`] alone. `wrenches` has one entry per body: of its parent on it, at its mass centre, world
/// axes.
///
/// # Panics
/// If the length of a slice of `posture` differs from the number of coordinates, or the length of `wrenches` from the
/// number of bodies.
pub fn project_wrenches<'w>(workspace: &'w mut Workspace, posture: Posture<'_>, wrenches: &[Wrench]) -> &'w [f64] {
    let Workspace { plan, one: kernel, .. } = workspace;
    assert_eq!(wrenches.len(), plan.segments.len(), "one wrench per body");
    kernel.scratch.load_posture(posture);
    sweep::forward(plan, &mut kernel.scratch);
    kernel.tau.fill([0.0; 1]);
    for (i, (segment, wrench)) in plan.segments.iter().zip(wrenches).enumerate() {
        let force = V3::splat(wrench.force);
        let moment = V3::splat(wrench.moment) + kernel.scratch.states[i + 1].to_center.cross(force);
        kernel.project(plan, segment, i, force, moment);
    }
    kernel.tau.as_flattened()
}

impl FrameForces<'_> {
    /// Generalised forces [N.m or N], one per coordinate.
    #[inline]
    #[must_use]
    pub fn generalized(&self) -> &[f64] {
        self.kernel.tau.as_flattened()
    }

    /// Reaction in the joint of a body.
    #[inline]
    #[must_use]
    pub fn reaction(&self, body: BodyId) -> JointReaction {
        self.kernel.reaction(body.index(), 0)
    }

    /// Pose, velocity and acceleration of a body.
    #[inline]
    #[must_use]
    pub fn body_motion(&self, body: BodyId) -> BodyMotion {
        self.kernel.scratch.body_motion(self.plan, body, 0)
    }
}

impl<const N: usize> Kernel<N> {
    fn new(plan: &Plan) -> Kernel<N> {
        let bodies = plan.segments.len();
        Kernel {
            scratch: Scratch::new(plan),
            loads: Vec::new(),
            force: vec![V3::ZERO; bodies + 1],
            moment: vec![V3::ZERO; bodies + 1],
            tau: vec![[0.0; N]; plan.coordinates],
        }
    }

    /// Leaves to root: forces, moments and their projections on the coordinates.
    #[inline(always)]
    fn backward(&mut self, plan: &Plan) {
        for (i, segment) in plan.segments.iter().enumerate() {
            let (force, moment) = inertial(plan, segment, i, &self.scratch);
            (self.force[i + 1], self.moment[i + 1]) = (force, moment);
        }
        for load in &self.loads {
            let arm = load.point - self.scratch.states[load.body + 1].center;
            self.force[load.body + 1] -= load.force;
            self.moment[load.body + 1] -= load.moment + arm.cross(load.force);
        }
        for bushing in &plan.bushings {
            self.resist(bushing);
        }
        self.tau.fill([0.0; N]);
        for &i in plan.outwards.iter().rev() {
            let segment = &plan.segments[i];
            let state = &self.scratch.states[i + 1];
            let force = self.force[i + 1];
            let moment = self.moment[i + 1] + state.to_center.cross(force);
            self.moment[i + 1] = moment;
            let arm = state.to_joint;
            self.force[segment.parent] += force;
            self.moment[segment.parent] += moment + arm.cross(force);
            self.project(plan, segment, i, force, moment);
        }
    }

    /// Adds the load of a bushing to the second of its bodies, and the opposite one to the first.
    fn resist(&mut self, bushing: &PlannedBushing) {
        let (mut point, mut force, mut moment) = (V3::ZERO, V3::ZERO, V3::ZERO);
        for lane in 0..N {
            let ends = bushing.ends.each_ref().map(|end| self.scratch.states[end.state].frame(end, lane));
            let load = bushing::load(&bushing.stiffness, &bushing.damping, ends.map(|e| e.0), ends.map(|e| e.1));
            point.set_lane(lane, ends[1].0.translation);
            force.set_lane(lane, load.force);
            moment.set_lane(lane, load.moment);
        }
        let [first, second] = bushing.ends.each_ref().map(|end| end.state);
        let about_center = |state: usize| moment + (point - self.scratch.states[state].center).cross(force);
        let (on_first, on_second) = (about_center(first), about_center(second));
        self.force[first] += force;
        self.moment[first] += on_first;
        self.force[second] -= force;
        self.moment[second] -= on_second;
    }

    /// τ of the coordinates of one joint.
    #[inline(always)]
    fn project(&mut self, plan: &Plan, segment: &Segment, index: usize, force: V3<N>, moment: V3<N>) {
        if let Some(spherical) = &segment.spherical {
            let V3(about) = sweep::spherical_moment(spherical, index, &self.scratch, force, moment);
            for (coordinate, tau) in spherical.coordinates.iter().zip(about) {
                self.tau[*coordinate] = tau.0;
            }
        } else {
            let moment = match segment.arc {
                None => moment,
                Some(length) => moment + sweep::arc_moment(length, index, &self.scratch, force),
            };
            for k in segment.rotations.clone() {
                self.add(plan, k, moment);
            }
        }
        for k in segment.translations.clone() {
            self.add(plan, k, force);
        }
    }

    #[inline(always)]
    fn add(&mut self, plan: &Plan, axis: usize, load: V3<N>) {
        if let Some(coordinate) = plan.axes[axis].source.coordinate() {
            let share = self.scratch.axes.direction[axis].dot(load) * self.scratch.axes.slope[axis];
            self.tau[coordinate] = (Lanes(self.tau[coordinate]) + share).0;
        }
    }

    #[inline]
    fn reaction(&self, body: usize, lane: usize) -> JointReaction {
        let state = &self.scratch.states[body + 1];
        JointReaction {
            center: state.center.lane(lane) - state.to_center.lane(lane),
            wrench: Wrench { moment: self.moment[body + 1].lane(lane), force: self.force[body + 1].lane(lane) },
        }
    }
}

impl Kernel<SIDE_BY_SIDE> {
    fn solve_block(&mut self, plan: &Plan, arch: Arch, trajectory: &Trajectory, loads: &[LoadSeries], first: usize) {
        self.gather_loads(loads, first);
        self.gather(trajectory, first);
        arch.dispatch(Solve { plan, kernel: self });
    }

    /// Loads the coordinates of eight frames; beyond the end the last frame is repeated.
    #[inline(always)]
    fn gather(&mut self, trajectory: &Trajectory, first: usize) {
        let Scratch { q, qd, qdd, .. } = &mut self.scratch;
        for (c, [values, rates, accelerations]) in trajectory.columns().iter().enumerate() {
            take(&mut q[c], values, first);
            take(&mut qd[c], rates, first);
            take(&mut qdd[c], accelerations, first);
        }
    }

    fn gather_loads(&mut self, loads: &[LoadSeries], first: usize) {
        self.loads.clear();
        for series in loads {
            let mut lanes = LoadLanes { body: series.body.index(), point: V3::ZERO, force: V3::ZERO, moment: V3::ZERO };
            for lane in 0..SIDE_BY_SIDE {
                let load = series.at((first + lane).min(series.points.len() - 1));
                lanes.point.set_lane(lane, load.point);
                lanes.force.set_lane(lane, load.wrench.force);
                lanes.moment.set_lane(lane, load.wrench.moment);
            }
            self.loads.push(lanes);
        }
    }
}

#[inline(always)]
fn take(lanes: &mut [f64; SIDE_BY_SIDE], series: &[f64], first: usize) {
    match series.get(first..first + SIDE_BY_SIDE) {
        Some(run) => lanes.copy_from_slice(run),
        None => {
            for (lane, x) in lanes.iter_mut().enumerate() {
                *x = series[(first + lane).min(series.len() - 1)];
            }
        }
    }
}

/// The two sweeps, compiled for each generation of vector instructions and selected at run time.
struct Solve<'a, const N: usize> {
    plan: &'a Plan,
    kernel: &'a mut Kernel<N>,
}

impl<const N: usize> WithSimd for Solve<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        sweep::forward(self.plan, &mut self.kernel.scratch);
        self.kernel.backward(self.plan);
    }
}

/// Wrench that the motion of a body requires: m (a - g), and I α + ω × I ω about the mass centre.
#[inline(always)]
fn inertial<const N: usize>(plan: &Plan, segment: &Segment, i: usize, s: &Scratch<N>) -> (V3<N>, V3<N>) {
    let state = &s.states[i + 1];
    let force = (state.a - V3::splat(plan.gravity)) * Lanes::splat(segment.mass);
    // In M's axes the inertia is constant.
    let omega = state.rotation.turn_back(state.omega);
    let alpha = state.rotation.turn_back(state.alpha);
    let moment = if segment.diagonal {
        let [x, y, z] = [segment.inertia[(0, 0)], segment.inertia[(1, 1)], segment.inertia[(2, 2)]];
        let resist = |v: V3<N>| V3([v.0[0] * x, v.0[1] * y, v.0[2] * z]);
        resist(alpha) + omega.cross(resist(omega))
    } else {
        let inertia = M3::splat(&segment.inertia);
        inertia.turn(alpha) + omega.cross(inertia.turn(omega))
    };
    (force, state.rotation.turn(moment))
}
