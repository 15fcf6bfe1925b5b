//! One step of first order: impulses at velocity level, then positions.
//!
//!   1. where surfaces touch, what acts: the graph at (x, v⁻)
//!   2. v, λ from the graph                                        (dynamics::solve_graph)
//!   3. x := x + h v, rotations by exp(h ω)
//!   4. linearised displacements: M δ = Jᵀ ν, J δ = -error, with the factor of 2; then joints of trees are seated exactly
//!
//! First order in time. The multipliers λ/h are the forces: of joints, drives, contacts, friction.
//!
//! Source: Faure, Debunne, Cani, Multon 1997, section 3.1 (steps 1-3 for accelerations, velocities, linearised
//! displacements), 3.2 (drives), 3.3 (contact). Time stepping by impulses after Moreau (unverified).

use super::assemble::{Assembly, Prescribed, Span, Yielding, twist};
use super::closing::closing;
use super::forces::{Blow, StepForces};
use super::joint::{Coordinates, JointKind, MOST, drift, orthonormal, rotation};
use super::state::{RowKey, State};
use super::step::{StepSettings, StepWorkspace};
use super::touch::{ObstacleMotion, Touch};
use super::world::{Impact, Joint, World};
use crate::dynamics::{ConstraintGroup, Convergence, Law, LinkError, Six, project_displacements, solve_graph};
use crate::findings::Findings;
use crate::spatial::{Pose, Twist, Vec3};

/// Forces beyond so many times the weight of everything are taken as a sign that rows contradict each other: drives without
/// a limit give way there, and where the solver fails no force is larger.
const UNREASONABLE_WEIGHTS: f64 = 1000.0;
/// What things weigh where there is little gravity [m/s²].
const STANDARD_GRAVITY: f64 = 9.80665;
/// Rows that depart by more than this share contradict each other; less is slow convergence, as where a loop is stretched.
const CONTRADICTION: f64 = 1e-6;
/// Fastest that position projection pulls loops together or bodies apart [m/s, rad/s].
const CLOSING_SPEED: f64 = 1.0;
/// Displacements larger than so many times the largest error are cut.
const MOST_LEVERAGE: f64 = 10.0;
/// Duration of an impact in a smooth step [s]: gravity gives 1e-8 m/s in it.
const IMPACT_S: f64 = 1e-9;

/// Advances the state by `h`.
pub(super) fn impulse_step(
    world: &World,
    state: &mut State,
    h: f64,
    settings: &StepSettings,
    w: &mut StepWorkspace,
    findings: &mut Findings,
) -> Result<Convergence, LinkError> {
    w.step_s = h;
    let mut prescribed = std::mem::take(&mut w.prescribed);
    prescribed.fill(world, state.time_s + h);
    let done = prescribed_step(world, state, h, settings, &prescribed, w, findings);
    w.prescribed = prescribed;
    done
}

fn prescribed_step(
    world: &World,
    state: &mut State,
    h: f64,
    settings: &StepSettings,
    prescribed: &Prescribed,
    w: &mut StepWorkspace,
    findings: &mut Findings,
) -> Result<Convergence, LinkError> {
    obstacle_motion(world, state.time_s, h, &mut w.obstacles);
    let still_closing = closing(world, state);
    w.touch.detect(world, state, &w.obstacles, h);
    if world.impact == Impact::Sticking {
        w.touch.keep_touching(world, state);
        w.strike(world, state, settings, prescribed, findings)?;
        w.step_s = h;
    }
    w.solve(world, state, Span { h, instant: false }, settings, prescribed, findings)?;
    for (body, motion) in w.solution.motions.iter().enumerate() {
        state.twists[body] = twist(motion);
        advance(&mut state.poses[body], &state.twists[body], h);
    }
    state.time_s += h;
    w.remember(state);
    if settings.projection {
        w.project(world, state, prescribed, h);
    }
    w.seat(world, state, prescribed, settings.projection);
    if settings.projection && !still_closing {
        w.close(world, state, prescribed, settings)?;
    }
    Ok(w.solution.convergence)
}

/// What happens at an instant where surfaces meet: velocities change, positions do not. `h` is the short time over which
/// forces other than those of the impact are negligible.
pub(super) fn impact(
    world: &World,
    state: &mut State,
    settings: &StepSettings,
    w: &mut StepWorkspace,
    findings: &mut Findings,
) -> Result<(), LinkError> {
    let prescribed = Prescribed::at(world, state.time_s + IMPACT_S);
    w.step_s = IMPACT_S;
    obstacle_motion(world, state.time_s, IMPACT_S, &mut w.obstacles);
    w.touch.detect(world, state, &w.obstacles, IMPACT_S);
    w.touch.close_gaps();
    w.solve_blow(world, state, settings, &prescribed, findings)?;
    w.take_blow(world, state);
    state.guess.clear();
    Ok(())
}

/// Poses of obstacles at the start of a step, with the mean twist over it.
pub(super) fn obstacle_motion(world: &World, time_s: f64, h: f64, motion: &mut ObstacleMotion) {
    let over_step = |obstacle: &super::world::Obstacle| {
        let (now, _) = obstacle.at(time_s);
        if obstacle.path.is_none() {
            return (now, Twist::ZERO);
        }
        let (then, _) = obstacle.at(time_s + h);
        let turn = super::joint::rotation_vector(&(then.rotation * now.rotation.transpose()));
        (now, Twist { angular: turn / h, linear: (then.translation - now.translation) / h })
    };
    motion.clear();
    motion.extend(world.obstacles.iter().map(over_step));
}

#[inline(always)]
pub(super) fn advance(pose: &mut Pose, twist: &Twist, h: f64) {
    pose.translation += twist.linear * h;
    pose.rotation = orthonormal(&(rotation(&(twist.angular * h)) * pose.rotation));
}

impl StepWorkspace {
    /// Velocities and impulses; drives that ask too much give way.
    fn solve(
        &mut self,
        world: &World,
        state: &State,
        span: Span,
        settings: &StepSettings,
        prescribed: &Prescribed,
        findings: &mut Findings,
    ) -> Result<(), LinkError> {
        let h = span.h;
        let unreasonable = match span.instant {
            // A blow has an impulse, not a force.
            true => f64::INFINITY,
            false => UNREASONABLE_WEIGHTS * world.mass() * world.gravity.norm().max(STANDARD_GRAVITY),
        };
        let mut yielding: Yielding = Vec::new();
        let mut found = std::mem::take(&mut self.found);
        found.clone_from(&self.touch.touches);
        loop {
            self.touch.touches.clone_from(&found);
            self.assembly.fill(world, state, prescribed, &yielding, span);
            let Assembly { graph, keys, .. } = &mut self.assembly;
            self.touch.add_rows(world, state, &self.obstacles, h, graph, keys);
            self.guess(state);
            solve_graph(&self.assembly.graph, &settings.solver, &mut self.solver, &mut self.solution)?;
            let more = self.overloaded(world, &yielding, unreasonable);
            if more.is_empty() {
                break;
            }
            yielding.extend(more);
        }
        self.found = found;
        if !self.solution.convergence.converged && self.solution.lambda.iter().any(|l| l.abs() > h * unreasonable) {
            self.bound(h * unreasonable);
            solve_graph(&self.assembly.graph, &settings.solver, &mut self.solver, &mut self.solution)?;
            self.read_wrenches();
        }
        self.report(world, &yielding, findings);
        Ok(())
    }

    fn solve_blow(
        &mut self,
        world: &World,
        state: &State,
        settings: &StepSettings,
        prescribed: &Prescribed,
        findings: &mut Findings,
    ) -> Result<(), LinkError> {
        self.step_s = IMPACT_S;
        self.solve(world, state, Span { h: IMPACT_S, instant: true }, settings, prescribed, findings)
    }

    /// Velocities change, positions do not. The impulses join those of the step.
    fn take_blow(&mut self, world: &World, state: &mut State) {
        for (twist_now, motion) in state.twists.iter_mut().zip(&self.solution.motions) {
            *twist_now = twist(motion);
        }
        let StepForces { mut contacts, mut efforts, .. } = StepForces::of(world, self);
        for contact in &mut contacts {
            contact.force *= IMPACT_S;
            contact.normal_force *= IMPACT_S;
        }
        efforts.iter_mut().flatten().for_each(|effort| *effort *= IMPACT_S);
        self.blows.push(Blow { time_s: state.time_s, contacts, efforts });
        self.after_blows.clone_from(&state.twists);
    }

    /// Every point that has come into touch since the last step strikes, the one that did so first before the others, and
    /// loses all of its velocity. Points that meanwhile part, or rest already, do not strike.
    fn strike(
        &mut self,
        world: &World,
        state: &mut State,
        settings: &StepSettings,
        prescribed: &Prescribed,
        findings: &mut Findings,
    ) -> Result<(), LinkError> {
        while let Some(number) = self.touch.next_striker(world, state, &self.obstacles) {
            let touches = self.touch.touches.clone();
            self.touch.touches[number].sticks = true;
            self.solve_blow(world, state, settings, prescribed, findings)?;
            if self.pulls() {
                // Another point carries the blow: this one is not held.
                self.touch.touches.clone_from(&touches);
                self.solve_blow(world, state, settings, prescribed, findings)?;
            }
            self.take_blow(world, state);
            self.touch.touches = touches;
            self.touch.touches[number].known = true;
        }
        Ok(())
    }

    /// Whether the point that was to stick is not pushed.
    fn pulls(&self) -> bool {
        let normal = |touch: &Touch| self.solution.lambda[self.assembly.graph.groups[touch.group].rows.start];
        self.touch.touches.iter().any(|touch| touch.sticks && normal(touch) <= 0.0)
    }

    /// Keeps the impulses for the next step to guess from.
    fn remember(&self, state: &mut State) {
        let groups = || self.assembly.keys.iter().zip(&self.assembly.graph.groups);
        let impulses = |group: &ConstraintGroup| {
            let mut impulses = [0.0; 6];
            impulses[..group.rows.len()].copy_from_slice(&self.solution.lambda[group.rows.clone()]);
            impulses
        };
        if state.guess.len() == groups().count() && groups().all(|(key, _)| state.guess.contains_key(key)) {
            groups().for_each(|(key, group)| {
                state.guess.entry(*key).and_modify(|past| *past = impulses(group));
            });
            return;
        }
        state.guess.clear();
        state.guess.extend(groups().map(|(key, group)| (*key, impulses(group))));
    }

    /// Impulses of the last step as a guess; a new contact is taken to push and to stick.
    fn guess(&mut self, state: &State) {
        let lambda = &mut self.solution.lambda;
        lambda.clear();
        lambda.resize(self.assembly.graph.rows.len(), 0.0);
        for (key, group) in self.assembly.keys.iter().zip(&self.assembly.graph.groups) {
            match state.guess.get(key) {
                Some(impulses) => lambda[group.rows.clone()].copy_from_slice(&impulses[..group.rows.len()]),
                None => {
                    lambda[group.rows.start] = if matches!(key, RowKey::Contact(..)) { f64::MIN_POSITIVE } else { 0.0 }
                }
            }
        }
    }

    /// Drives whose effort exceeds their limit, or reason.
    fn overloaded(&mut self, world: &World, yielding: &Yielding, unreasonable: f64) -> Yielding {
        let driven = |j: &Joint| j.coordinates.iter().any(|c| c.drive.is_some());
        if !world.joints.iter().any(driven) {
            return Vec::new();
        }
        self.read_wrenches();
        let mut more = Vec::new();
        for (number, joint) in world.joints.iter().enumerate() {
            for (k, acting) in joint.coordinates.iter().enumerate() {
                let Some(drive) = &acting.drive else { continue };
                let most = drive.max.unwrap_or(unreasonable);
                let known = || yielding.iter().any(|(j, c, _)| (*j, *c) == (number, k));
                if self.effort(joint.child, number, k).abs() > most && !known() {
                    more.push((number, k, most));
                }
            }
        }
        more
    }

    /// Confines every force.
    fn bound(&mut self, most: f64) {
        for group in &mut self.assembly.graph.groups {
            group.law = match group.law {
                Law::Bounded { least, most: upper } => Law::Bounded { least: least.max(-most), most: upper.min(most) },
                Law::Contact { friction, bound } => Law::Contact { friction, bound: bound.min(most) },
            };
        }
    }

    fn report(&self, world: &World, yielding: &Yielding, findings: &mut Findings) {
        for &(joint, coordinate, max) in yielding {
            let joint = &world.joints[joint];
            let name = joint.kind.coordinate_names()[coordinate];
            let unit = if joint.kind.turns(coordinate) { "N.m" } else { "N" };
            findings.warn(
                "drive.gave_way",
                format!(
                    "the drive of `{}` ({name}) could not keep to its motion with {max:.4} {unit} and gave way",
                    joint.name
                ),
            );
        }
        let convergence = &self.solution.convergence;
        let contradicts = convergence.residual > CONTRADICTION || convergence.residual.is_nan();
        if let (true, Some(row)) = (contradicts, convergence.worst) {
            let name = self.row_name(world, row);
            findings.warn(
                "solver.not_converged",
                format!("not all constraints could be met at once; the one that departs most is {name}"),
            );
        }
    }

    /// What a row stands for, in words.
    pub(crate) fn row_name(&self, world: &World, row: usize) -> String {
        let groups = &self.assembly.graph.groups;
        let Some(group) = groups.iter().position(|g| g.rows.contains(&row)) else { return format!("row {row}") };
        let coordinate = |joint: usize, k: usize| {
            let joint = &world.joints[joint];
            format!("`{}` ({})", joint.name, joint.kind.coordinate_names()[k])
        };
        match self.assembly.keys[group] {
            RowKey::Closure(closure) => format!("the closure `{}`", world.closures[closure].name),
            RowKey::Drive(j, k) => format!("the drive of {}", coordinate(j, k)),
            RowKey::Motor(j, k) => format!("the motor of {}", coordinate(j, k)),
            RowKey::Friction(j, k) => format!("the friction of {}", coordinate(j, k)),
            RowKey::LowerLimit(j, k) => format!("the lower limit of {}", coordinate(j, k)),
            RowKey::UpperLimit(j, k) => format!("the upper limit of {}", coordinate(j, k)),
            RowKey::Contact(a, b, _) | RowKey::SoftFriction(a, b, _) => {
                let name = |surface: usize| world.owner_name(world.surfaces[surface].owner);
                format!("the contact of `{}` with `{}`", name(a), name(b))
            }
        }
    }

    /// Step 4: what has drifted goes back along M⁻¹ Jᵀ.
    fn project(&mut self, world: &World, state: &mut State, prescribed: &Prescribed, h: f64) {
        let most = CLOSING_SPEED * h;
        for (body, joint) in self.assembly.joint_of.iter().enumerate() {
            self.assembly.graph.terms.offset[body] = match joint {
                None => Six::zeros(),
                Some(number) => {
                    let joint = &world.joints[*number];
                    joint_correction(state, joint, &state.coordinates[*number], prescribed)
                }
            };
        }
        let graph = &self.assembly.graph;
        self.targets.clear();
        self.targets.resize(graph.rows.len(), 0.0);
        for (key, group) in self.assembly.keys.iter().zip(&graph.groups) {
            if let RowKey::Closure(number) = key {
                let (_, errors) = closure_errors(world, state, *number);
                for (row, error) in group.rows.clone().zip(errors) {
                    self.targets[row] = -error.clamp(-most, most);
                }
            } else if let Some((joint, k, limit)) = limit_of(world, *key) {
                let row = group.rows.start;
                let rate = graph.reading(group, row, &self.solution.motions, &self.solution.coordinates);
                self.targets[row] = (limit - state.coordinates[joint][k] - h * rate).clamp(-most, most);
            }
        }
        for touch in self.touch.touches.iter().filter(|t| t.rigid) {
            let group = &graph.groups[touch.group];
            let row = group.rows.start;
            let u = graph.reading(group, row, &self.solution.motions, &self.solution.coordinates) - touch.surface_speed;
            let gap = touch.at.gap + h * u;
            self.targets[row] = (-gap).clamp(-most, most);
        }
        self.displace(world, state);
    }

    /// Moves bodies by the displacements that carry rows to their targets.
    fn displace(&mut self, world: &World, state: &mut State) {
        let graph = &self.assembly.graph;
        project_displacements(graph, &self.targets, &mut self.solver, &mut self.displacements, &mut self.shifts);
        let offsets = &self.assembly.graph.terms.offset;
        let share = share_of_displacements(&self.targets, offsets, &self.displacements);
        for (body, (pose, displacement)) in state.poses.iter_mut().zip(&self.displacements).enumerate() {
            // Those that their joints carry are put in their seats next.
            let free = graph.links[body].freedom > 0 || self.assembly.joint_of[body].is_none();
            let straight = |number: usize| goes_straight(world.joints[number].kind);
            if free || !self.assembly.joint_of[body].is_some_and(straight) {
                advance(pose, &twist(displacement), share);
            }
        }
    }

    /// Puts every child exactly where its joint's coordinates have it (without projection, only reads the coordinates).
    pub(super) fn seat(&self, world: &World, state: &mut State, prescribed: &Prescribed, exactly: bool) {
        for &(body, _) in self.solver.outwards() {
            let Some(number) = self.assembly.joint_of[body] else { continue };
            let joint = &world.joints[number];
            let mut q = [0.0; MOST];
            if joint.follows.is_none() {
                q = self.coordinates(state, joint, number, prescribed, exactly);
                state.coordinates[number].copy_from_slice(&q[..joint.kind.freedom()]);
            }
            if !exactly {
                continue;
            }
            let parent = joint.parent.map_or(Pose::IDENTITY, |p| state.poses[p]);
            state.poses[body] = match prescribed.goal(joint) {
                Some(goal) => parent * goal,
                None => {
                    let seat = parent * joint.parent_from_joint * joint.kind.parent_from_child(&q);
                    let pose = seat * joint.child_from_joint.inverse();
                    Pose { rotation: orthonormal(&pose.rotation), ..pose }
                }
            };
        }
    }

    /// Coordinates of a joint as the poses have them; with `exactly`, driven ones where their drives take them. A drive that
    /// gave way stays where it is.
    #[inline(always)]
    fn coordinates(
        &self,
        state: &State,
        joint: &Joint,
        number: usize,
        prescribed: &Prescribed,
        exactly: bool,
    ) -> Coordinates {
        let held = |k: usize| exactly && joint.coordinates[k].drive.is_some() && !self.gave_way(number, k);
        let drives = 0..joint.kind.freedom();
        let mut q = if goes_straight(joint.kind) && drives.clone().all(held) {
            [0.0; MOST]
        } else {
            state.measured(joint, &state.coordinates[number])
        };
        for k in drives {
            let target = prescribed.value(number, k);
            if held(k) && (goes_straight(joint.kind) || (target - q[k]).abs() < 1e-3) {
                q[k] = target;
            }
        }
        q
    }

    fn gave_way(&self, joint: usize, coordinate: usize) -> bool {
        !self.assembly.keys.is_empty() && self.assembly.keys.contains(&RowKey::Drive(joint, coordinate))
    }
}

/// Whether a rate held over a step takes a coordinate all the way, however far: not so where turns do not commute.
fn goes_straight(kind: JointKind) -> bool {
    matches!(kind, JointKind::Weld | JointKind::Revolute | JointKind::Prismatic | JointKind::Planar)
}

/// All of the displacements, unless they are far larger than the errors that they undo: where loops are stretched, a small
/// error along them calls for a large displacement across, and the linear picture ends.
pub(super) fn share_of_displacements(targets: &[f64], offsets: &[Six], displacements: &[Six]) -> f64 {
    let slide = |six: &Six| six.fixed_rows::<3>(3).amax();
    let error = targets.iter().map(|t| t.abs()).chain(offsets.iter().map(slide)).fold(0.0, f64::max);
    let largest = displacements.iter().map(slide).fold(0.0, f64::max);
    if largest > MOST_LEVERAGE * error { MOST_LEVERAGE * error / largest } else { 1.0 }
}

/// Joint, coordinate and value of a limit.
fn limit_of(world: &World, key: RowKey) -> Option<(usize, usize, f64)> {
    let limits = |joint: usize, k: usize| world.joints[joint].coordinates[k].limits;
    match key {
        RowKey::LowerLimit(joint, k) => limits(joint, k).0.map(|limit| (joint, k, limit)),
        RowKey::UpperLimit(joint, k) => limits(joint, k).1.map(|limit| (joint, k, limit)),
        _ => None,
    }
}

/// The displacement of a child's mass centre against its parent that undoes its drift.
fn joint_correction(state: &State, joint: &Joint, last: &[f64], prescribed: &Prescribed) -> Six {
    let frames = state.frames(joint);
    let (turn, shift) = match prescribed.goal(joint) {
        None => drift(joint.kind, &frames, last),
        Some(goal) => {
            let seat = joint.parent.map_or(Pose::IDENTITY, |p| state.poses[p]) * goal * joint.child_from_joint;
            let turn = super::joint::rotation_vector(&(frames.child.rotation * seat.rotation.transpose()));
            (turn, frames.child.translation - seat.translation)
        }
    };
    let to_center = state.poses[joint.child].translation - frames.child.translation;
    let linear = -shift - turn.cross(&to_center);
    Six::new(-turn.x, -turn.y, -turn.z, linear.x, linear.y, linear.z)
}

/// Frames of a closure, and its errors along its rows [rad, m].
pub(crate) fn closure_errors(world: &World, state: &State, number: usize) -> (super::joint::Frames, Vec<f64>) {
    let closure = &world.closures[number];
    let parent = closure.second.map_or(Pose::IDENTITY, |p| state.poses[p]);
    let frames = super::joint::Frames {
        parent: parent * closure.second_from_joint,
        child: state.poses[closure.first] * closure.first_from_joint,
    };
    let (turn, shift) = drift(closure.kind, &frames, &[]);
    let (turns, slides) = closure.kind.held(&frames);
    let errors = turns.iter().map(|e| e.dot(&turn)).chain(slides.iter().map(|e| e.dot(&shift))).collect();
    (frames, errors)
}

/// Largest distance of any joint or closure from where it holds [m].
#[must_use]
pub fn largest_joint_error(world: &World, state: &State) -> f64 {
    let joints =
        world.joints.iter().zip(&state.coordinates).filter(|(j, _)| j.follows.is_none()).map(|(joint, last)| {
            let (_, shift) = drift(joint.kind, &state.frames(joint), last);
            shift.norm()
        });
    joints
        .chain((0..world.closures.len()).filter(|c| world.closures[*c].active).map(|closure| {
            let (frames, _) = closure_errors(world, state, closure);
            let (_, shift): (Vec3, Vec3) = drift(world.closures[closure].kind, &frames, &[]);
            shift.norm()
        }))
        .fold(0.0, f64::max)
}
