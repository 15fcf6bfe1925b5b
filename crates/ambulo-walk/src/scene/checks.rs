//! Checks of a scene while it runs: the energy of scenes that nothing drives, closures that stay open, and bodies that
//! move further in a step than their own size.

use crate::engine::energy::EnergyWatch;
use crate::engine::projection::{closure_errors, closure_frames};
use crate::engine::state::WorldState;
use crate::engine::touch::may_touch;
use crate::engine::world::{Owner, Surface, World};
use crate::findings::{Code, Findings};
use crate::spatial::Vec3;

/// Speed at which loops that are open close [m/s], as in `engine::projection`.
const CLOSING_SPEED: f64 = 1.0;
/// Steps after which a loop that had the time to close must be closed.
const SPARE_STEPS: f64 = 10.0;
/// A closure that is further apart is open [m], as at the start of a scene, and [rad].
const OPEN_M: f64 = 1e-3;
const OPEN_RAD: f64 = 1e-2;

/// Checks after each step.
#[derive(Debug, Clone)]
pub(super) struct SceneChecks {
    /// Watches the energy until it has risen; `None` where it may rise.
    watch: Option<EnergyWatch>,
    has_risen: bool,
    /// Time at which the check of the energy restarts, because an event closes a loop until then [s].
    anew_at_s: Option<f64>,
    /// Time from which each closure must be closed [s]; infinite once it was reported.
    closed_from_s: Vec<f64>,
    /// Half of the smallest extent of each surface [m]; infinite for planes.
    half_sizes_m: Vec<f64>,
    /// Whether each body was reported as too fast.
    is_too_fast: Vec<bool>,
}

impl SceneChecks {
    /// The checks of a world that starts in a state.
    pub(super) fn new(world: &World, state: &WorldState) -> SceneChecks {
        SceneChecks {
            watch: EnergyWatch::new(world, state),
            has_risen: false,
            anew_at_s: None,
            closed_from_s: vec![0.0; world.closures.len()],
            half_sizes_m: world.surfaces.iter().map(|surface| surface.shape.half_size()).collect(),
            is_too_fast: vec![false; world.bodies.len()],
        }
    }

    /// An event has changed the world: its energy is watched from now on, or once the added closure had the time to
    /// close.
    pub(super) fn changed(&mut self, world: &World, state: &WorldState, added: Option<usize>, step_s: f64) {
        let apart = added.map_or(0.0, |closure| open_m(world, state, closure).max(open_rad(world, state, closure)));
        let closing_s = if apart > 0.0 { apart / CLOSING_SPEED + SPARE_STEPS * step_s } else { 0.0 };
        let closed_s = state.time_s + closing_s;
        if let Some(closure) = added {
            self.closed_from_s.resize(world.closures.len(), 0.0);
            self.closed_from_s[closure] = closed_s;
        }
        self.watch = None;
        self.anew_at_s = Some(self.anew_at_s.map_or(closed_s, |other: f64| other.max(closed_s)));
        self.watch_anew(world, state);
    }

    fn watch_anew(&mut self, world: &World, state: &WorldState) {
        if self.anew_at_s.is_some_and(|from_s| state.time_s >= from_s) {
            self.anew_at_s = None;
            self.watch = EnergyWatch::new(world, state).filter(|_| !self.has_risen);
        }
    }

    /// Checks the state after a step.
    pub(super) fn look(&mut self, world: &World, state: &WorldState, step_s: f64, findings: &mut Findings) {
        if self.watch.as_mut().is_some_and(|watch| watch.rises(world, state, findings)) {
            (self.watch, self.has_risen) = (None, true);
        }
        self.watch_anew(world, state);
        self.look_at_closures(world, state, findings);
        self.look_at_speeds(world, state, step_s, findings);
    }

    /// Reports closures that are still open at the end of a run, also those that were added late.
    pub(super) fn end(&mut self, world: &World, state: &WorldState, findings: &mut Findings) {
        self.closed_from_s.iter_mut().filter(|from_s| from_s.is_finite()).for_each(|from_s| *from_s = 0.0);
        self.look_at_closures(world, state, findings);
    }

    fn look_at_closures(&mut self, world: &World, state: &WorldState, findings: &mut Findings) {
        self.closed_from_s.resize(world.closures.len(), 0.0);
        for (number, closure) in world.closures.iter().enumerate().filter(|(_, closure)| closure.active) {
            if state.time_s < self.closed_from_s[number] {
                continue;
            }
            let (gap, turn) = (open_m(world, state, number), open_rad(world, state, number));
            if gap <= OPEN_M && turn <= OPEN_RAD {
                continue;
            }
            self.closed_from_s[number] = f64::INFINITY;
            let apart = match gap > OPEN_M {
                true => format!("its points are {gap:.4} m apart"),
                false => format!("its axes are {:.2} deg apart", turn.to_degrees()),
            };
            let message = format!(
                "the closure `{}` is open at {:.3} s: {apart}; its forces are not those of a closed loop",
                closure.name, state.time_s
            );
            findings.report(Code::ClosureOpen, message);
        }
    }

    fn look_at_speeds(&mut self, world: &World, state: &WorldState, step_s: f64, findings: &mut Findings) {
        // An event may have added some.
        let known = self.half_sizes_m.len();
        self.half_sizes_m.extend(world.surfaces.iter().skip(known).map(|surface| surface.shape.half_size()));
        self.is_too_fast.resize(world.bodies.len(), false);
        for (number, surface) in world.surfaces.iter().enumerate() {
            let Owner::Body(body) = surface.owner else { continue };
            let way = state.twists[body].linear * step_s;
            let size_m = 2.0 * self.half_sizes_m[number];
            if way.norm() <= size_m || self.is_too_fast[body] {
                continue;
            }
            let Some(other) = in_the_way(world, state, number, way) else { continue };
            self.is_too_fast[body] = true;
            let message = format!(
                "`{}` moves {:.4} m in a step at {:.3} s, further than its own size of {size_m:.4} m, and near `{}`: \
                 it may pass through. hint: use a shorter time step",
                world.bodies[body].name,
                way.norm(),
                state.time_s,
                world.owner_name(other)
            );
            findings.report(Code::BodyTooFast, message);
        }
    }
}

/// Distance of the points of a closure along its constrained directions [m].
pub(super) fn open_m(world: &World, state: &WorldState, closure: usize) -> f64 {
    let turns = turns(world, state, closure);
    closure_errors(world, state, closure).skip(turns).map(|gap| gap * gap).sum::<f64>().sqrt()
}

/// Angle between the axes of a closure about its constrained directions [rad].
fn open_rad(world: &World, state: &WorldState, closure: usize) -> f64 {
    let turns = turns(world, state, closure);
    closure_errors(world, state, closure).take(turns).map(|turn| turn * turn).sum::<f64>().sqrt()
}

fn turns(world: &World, state: &WorldState, closure: usize) -> usize {
    world.closures[closure].kind.constrained(&closure_frames(world, state, closure)).turns().count()
}

/// A thin obstacle or another body that a surface may have passed on its last way; planes have no other side.
fn in_the_way(world: &World, state: &WorldState, number: usize, way: Vec3) -> Option<Owner> {
    let surface = &world.surfaces[number];
    let (low, high) = bounds(world, state, surface)?;
    let (low, high) = (low.inf(&(low - way)), high.sup(&(high - way)));
    let joints = world.joint_of_body();
    let parents: Vec<Option<usize>> =
        joints.iter().map(|joint| joint.and_then(|joint| world.joints[joint].parent)).collect();
    let is_near = |(other_number, other): &(usize, &Surface)| {
        other.owner != surface.owner
            && other.shape.half_size().is_finite()
            && may_touch(world, &parents, number, *other_number)
            && bounds(world, state, other)
                .is_some_and(|(from, to)| (0..3).all(|k| from[k] <= high[k] && low[k] <= to[k]))
    };
    world.surfaces.iter().enumerate().find(is_near).map(|(_, other)| other.owner)
}

/// Corners of the box around a surface [m]; `None` for a plane.
fn bounds(world: &World, state: &WorldState, surface: &Surface) -> Option<(Vec3, Vec3)> {
    let owner = match surface.owner {
        Owner::Body(body) => state.poses[body],
        Owner::Obstacle(obstacle) => world.obstacles[obstacle].at(state.time_s).0,
    };
    surface.shape.bounding(&(owner * surface.owner_from_shape))
}
