//! Adds built-in figures to the world: every coordinate of the model becomes a coordinate of a joint.
//!
//! The root moves in the vertical plane through the figure's position: its translations forwards and up are free; its
//! rotation is driven and holds the trunk upright, as in section 4.1 of Faure, Debunne, Cani, Multon 1997. The reaction
//! of this joint keeps the figure in its plane.

use super::acting::acting;
use super::built_entry::{BuiltCoordinate, BuiltFigure, FigureWalkMode, GaitSource, WalkEntry, WalkTracking};
use super::error_chain::chain;
use super::figure::FigureEntry;
use super::model_figure::{PlacedFigure, add_spheres};
use super::planner::Planner;
use super::recorder::Recorder;
use super::sources::{InputFiles, PlannedWalk};
use super::{Place, SceneError};
use crate::consistent_walk::{ConsistentWalkSettings, make_changing_walk};
use crate::contact::HuntCrossley;
use crate::control::{FigureRecorder, Live, LiveTargets, ScheduledController};
use crate::engine::WorldError;
use crate::engine::figure_tree::FigureTree;
use crate::engine::signal::Signal;
use crate::engine::soles::{add_soles, lowest};
use crate::engine::world::{ContactLaw, Figure, JointCoordinate, JointDrive, Material, Motor, Spring, World};
use crate::findings::Findings;
use crate::gait::machine::{WalkMachine, planned};
use crate::gait::{Gait, Speed, Walk, WalkCoordinates};
use crate::kinematics::{Posture, body_motion};
use crate::model::anthropometry::Human;
use crate::model::{
    self, Coordinate, CoordinateId, CoordinateKind, Displacement, Function, JointAxis, Marker, Model, ModelError, Side,
};
use crate::spatial::{Vec3, rotation};
use crate::walking::{GaitTargets, gait_signals};

/// Grip point of a hand, as a share of the length from the wrist to the fingertips.
const GRIP: f64 = 0.5;

/// Longest scene with a walk whose pace changes [s]: it is sampled every millisecond.
const LONGEST_CHANGING_WALK_S: f64 = 900.0;

/// A motion of all coordinates, and its state at the start of the scene.
struct Motion {
    signals: Vec<Signal>,
    /// Coordinates and their rates at the start.
    start: [Vec<f64>; 2],
    /// Accelerations at the start, if the motion before it is known.
    accelerations: Option<Vec<f64>>,
    /// Targets that are computed from step to step, and the time of the gait at the start of the scene [s].
    live: Option<(Box<GaitTargets>, f64)>,
}

/// Adds a figure to the world.
pub(super) fn add(
    world: &mut World,
    entry: &FigureEntry,
    built: &BuiltFigure,
    number: usize,
    sources: &mut InputFiles<'_, '_>,
) -> Result<(PlacedFigure, Option<Recorder>), SceneError> {
    let wrong = |e: &dyn std::error::Error| built.place.error(chain(e));
    let human = built.build.human().map_err(|e| wrong(&e))?;
    let (mut human, mut motion, controller) = match &built.walk {
        Some(walk) => walking(walk, built, human, sources)?,
        None => {
            let motion = standing(&human.model);
            (human, motion, None)
        }
    };
    human.model = placed_model(&human, entry, built).map_err(|e| wrong(&e))?;
    for coordinate in &human.model.coordinates()[motion.signals.len()..] {
        motion.signals.push(Signal::Constant(coordinate.default_value));
        motion.start[0].push(coordinate.default_value);
        motion.start[1].push(0.0);
        motion.accelerations.iter_mut().for_each(|all| all.push(0.0));
    }
    let model = &human.model;
    own_starts(built, model, &mut motion);
    let figure = world.figures.len();
    let wrong_joint = |e: WorldError| built.place.error(e.to_string());
    let tree = FigureTree::add(world, model, &format!("{}/", entry.name)).map_err(wrong_joint)?;
    let first_body = tree.first_body;
    let rest = vec![0.0; model.coordinates().len()];
    let [q, qd] = &motion.start;
    let started = tree.motions(world, Posture { q, qd, qdd: motion.accelerations.as_ref().unwrap_or(&rest) });
    for (body, started) in world.bodies[first_body..].iter_mut().zip(&started) {
        (body.pose, body.twist) = (started.pose, started.twist);
    }
    let accelerations = motion.accelerations.iter().flat_map(|_| started.iter().map(|own| own.acceleration)).collect();
    let joint_of = world.joint_of_body();
    for (id, place) in model.coordinate_ids().zip(&tree.places) {
        let acting = acting_on(built, number, model, id, &motion.signals, sources)?;
        if let Some((joint, coordinate)) = place.joint(&joint_of) {
            world.joints[joint].coordinates[coordinate] = acting;
        }
    }
    add_spheres(world, entry, number, model, first_body)?;
    let shoes = built.shoes.unwrap_or_else(|| {
        let law = ContactLaw::HuntCrossley(HuntCrossley::SOFT_SHOES);
        world.materials.push(Material { friction: HuntCrossley::SOFT_SHOES.dynamic_friction, restitution: 0.0, law });
        world.materials.len() - 1
    });
    let soles = add_soles(world, &human, first_body, shoes).map_err(|e| built.place.error(e.to_string()))?;
    controller.iter().try_for_each(|_| tree.add_solid_legs(world)).map_err(|e| built.place.error(e.to_string()))?;
    world.figures.push(Figure { model: model.clone(), coordinates: motion.signals });
    let live = motion.live.map(|(targets, start_s)| Live::Machines(LiveTargets { targets, figure, start_s }));
    let live = live.or(controller.map(|controller| Live::Controller(Box::new(controller))));
    let recorder = || FigureRecorder::new(&entry.name, &human, tree.clone(), soles, live);
    let recorder = built.walk.is_some().then(|| Recorder::Walk(Box::new(recorder())));
    let name = entry.name.clone();
    Ok((PlacedFigure { figure, first_body, name, tree: Some(tree), accelerations }, recorder))
}

/// Upright standing: every coordinate has its default value.
fn standing(model: &Model) -> Motion {
    let values: Vec<f64> = model.coordinates().iter().map(|c| c.default_value).collect();
    let rest = vec![0.0; values.len()];
    let signals = values.iter().map(|value| Signal::Constant(*value)).collect();
    Motion { signals, start: [values, rest], accelerations: None, live: None }
}

/// Figure, motion and controller of a walk; the controller of a figure without one is `None`.
fn walking(
    entry: &WalkEntry,
    built: &BuiltFigure,
    human: Human,
    sources: &mut InputFiles<'_, '_>,
) -> Result<(Human, Motion, Option<ScheduledController>), SceneError> {
    let wrong = |e: &dyn std::error::Error| entry.place.error(chain(e));
    let mut gait = gait_of(entry, sources)?;
    if let Some(control) = &built.control {
        let planner = Planner { entry, build: &built.build, gait: &gait };
        let controller = planner.controller(control, sources)?;
        // A figure that stands at the start has the slowest plan.
        let stands = controller.controller.is_standing();
        let speed = if stands { Some(controller.controller.speed()) } else { entry.speed };
        let plan = planner.plan(speed, sources)?;
        let mut motion = along_plan(plan, entry.phase);
        if stands {
            motion.start = controller.controller.start();
            motion.accelerations = None;
        }
        return Ok((plan.human.clone(), motion, Some(controller)));
    }
    gait.pace_changes.extend(&entry.changes);
    if !gait.pace_changes.is_empty() || !gait.machines.is_empty() {
        let motion = changing(entry, gait, &human, sources)?;
        return Ok((human, motion, None));
    }
    let motion = match entry.mode {
        FigureWalkMode::Curves => {
            let walk = Walk::new(&gait, human.dimensions.leg_length, sources.findings).map_err(|e| wrong(&e))?;
            along_curves(&walk, &human, entry.phase)
        }
        FigureWalkMode::Corrected | FigureWalkMode::Optimal => {
            let planner = Planner { entry, build: &built.build, gait: &gait };
            along_plan(planner.plan(entry.speed, sources)?, entry.phase)
        }
    };
    Ok((human, motion, None))
}

pub(super) fn gait_of(entry: &WalkEntry, sources: &mut InputFiles<'_, '_>) -> Result<Gait, SceneError> {
    let place = &entry.place;
    let wrong = |e: &dyn std::error::Error| place.error(chain(e));
    match &entry.gait {
        GaitSource::Named(name) => Gait::named(name).map_err(|e| wrong(&e)),
        GaitSource::File(path) => {
            let text = sources.text(place, path)?;
            let mut load = |file: &str, column: &str| {
                let table = sources.table(place, file).map_err(|e| e.to_string())?;
                table.angle(column, sources.findings).map_err(|e| format!("{file}: {}", chain(&e)))
            };
            Gait::from_toml_with(&text, &mut load).map_err(|e| place.error(format!("{path}: {}", chain(&e))))
        }
    }
}

/// A walk whose pace changes; times of changes count from the start of the scene.
fn changing(
    entry: &WalkEntry,
    mut gait: Gait,
    human: &Human,
    sources: &mut InputFiles<'_, '_>,
) -> Result<Motion, SceneError> {
    let wrong = |e: &dyn std::error::Error| entry.place.error(chain(e));
    if entry.duration_s > LONGEST_CHANGING_WALK_S {
        let message = format!(
            "found a scene of {} s with changes of pace; expected at most {LONGEST_CHANGING_WALK_S} s, because the \
             whole walk is computed before the scene begins",
            entry.duration_s
        );
        return Err(entry.place.error(message));
    }
    if let Some(speed) = entry.speed {
        gait.pace.speed = Some(Speed::MetersPerSecond(speed));
    }
    let (model, leg_length) = (&human.model, human.dimensions.leg_length);
    let first = Walk::new(&gait, leg_length, &mut Findings::default()).map_err(|e| wrong(&e))?;
    let start_s = if first.clock(0.0).stands() { 0.0 } else { entry.phase * first.cycle_s() };
    for change in &mut gait.pace_changes {
        change.start_s += start_s;
    }
    let duration_s = entry.duration_s;
    let walk = Walk::new(&gait, leg_length, sources.findings).map_err(|e| wrong(&e))?.with_machines_from(start_s);
    let (walk, _) = planned(walk, f64::INFINITY, duration_s, sources.findings).map_err(|e| wrong(&e))?;
    let mut live = None;
    let (signals, root) = match entry.mode {
        FigureWalkMode::Curves => {
            if gait.machines_read_simulation() {
                let targets = GaitTargets::new(&walk, model, &sources.signals).map_err(|e| wrong(&e))?;
                live = Some((Box::new(targets), start_s));
            }
            (gait_signals(&walk, model, start_s, duration_s).map_err(|e| wrong(&e))?, None)
        }
        FigureWalkMode::Corrected | FigureWalkMode::Optimal => {
            let observer = sources.observer.clone();
            let settings = ConsistentWalkSettings { observer, ..ConsistentWalkSettings::default() };
            let walk = make_changing_walk(human, &walk, &settings).map_err(|e| wrong(&e))?;
            (walk.signals(human, start_s, duration_s), Some(walk.posture(model, start_s)))
        }
    };
    let [mut q, mut qd, qdd] = [0, 1, 2].map(|d| signals.iter().map(|signal| signal.at(0.0)[d]).collect::<Vec<f64>>());
    match &root {
        Some(posture) => {
            [q, qd] = [posture[0].clone(), posture[1].clone()];
            if let Some(forward) = model.coordinate("pelvis_tx") {
                q[forward.index()] = 0.0;
            }
        }
        None => {
            let height = standing_height(human, &q, &qd, &qdd);
            set_root(model, &mut q, &mut qd, [0.0, height], [walk.speed(), 0.0]);
        }
    }
    let accelerations = root.map(|[_, _, accelerations]| accelerations);
    Ok(Motion { signals, start: [q, qd], accelerations, live })
}

/// Sets place [m] and velocity [m/s] of the root, forwards and up.
fn set_root(model: &Model, q: &mut [f64], qd: &mut [f64], place: [f64; 2], velocity: [f64; 2]) {
    for (k, name) in ["pelvis_tx", "pelvis_ty"].into_iter().enumerate() {
        if let Some(id) = model.coordinate(name) {
            (q[id.index()], qd[id.index()]) = (place[k], velocity[k]);
        }
    }
}

/// Height of the root [m] at which the lowest sole touches the ground.
fn standing_height(human: &Human, q: &[f64], qd: &[f64], qdd: &[f64]) -> f64 {
    let mut q = q.to_vec();
    if let Some(up) = human.model.coordinate("pelvis_ty") {
        q[up.index()] = 0.0;
    }
    let motions = body_motion(&human.model, Posture { q: &q, qd, qdd });
    -lowest(&human.soles, &motions)
}

/// The unchanged curves of the gait, with the lowest sole on the ground.
fn along_curves(walk: &Walk, human: &Human, phase: f64) -> Motion {
    let model = &human.model;
    let coordinates = WalkCoordinates::of(model);
    let mut machine = WalkMachine::new(walk);
    let defaults: Vec<f64> = model.coordinates().iter().map(|c| c.default_value).collect();
    let write = |t: f64, [q, qd, qdd]: &mut [Vec<f64>; 3]| {
        q.copy_from_slice(&defaults);
        coordinates.write(&machine.step(t), q, qd, qdd);
    };
    let (signals, [mut q, mut qd, qdd]) = sampled(model, walk.cycle_s(), phase, write);
    let height = standing_height(human, &q, &qd, &qdd);
    set_root(model, &mut q, &mut qd, [0.0, height], [walk.speed(), 0.0]);
    Motion { signals, start: [q, qd], accelerations: None, live: None }
}

/// A walk without outside forces.
fn along_plan(PlannedWalk { human, solution, .. }: &PlannedWalk, phase: f64) -> Motion {
    let model = &human.model;
    let write = |t: f64, posture: &mut [Vec<f64>; 3]| solution.write(t, posture);
    let (signals, [mut q, qd, qdd]) = sampled(model, solution.cycle_s(), phase, write);
    if let Some(forward) = model.coordinate("pelvis_tx") {
        q[forward.index()] = 0.0;
    }
    Motion { signals, start: [q, qd], accelerations: Some(qdd), live: None }
}

/// A periodic motion as signals that begin at a phase, with coordinates, rates and accelerations at the start. The
/// signals of the root's translations are not used, because forces move them.
fn sampled(
    model: &Model,
    cycle_s: f64,
    phase: f64,
    mut write: impl FnMut(f64, &mut [Vec<f64>; 3]),
) -> (Vec<Signal>, [Vec<f64>; 3]) {
    let count = model.coordinates().len();
    let mut posture = [0, 1, 2].map(|_| vec![0.0; count]);
    let forward = model.coordinate("pelvis_tx").map(CoordinateId::index);
    let signals = Signal::periodic(count, cycle_s, |t, row| {
        write(t + phase * cycle_s, &mut posture);
        for (k, entry) in row.iter_mut().enumerate() {
            *entry = if Some(k) == forward { [0.0; 3] } else { [0, 1, 2].map(|d| posture[d][k]) };
        }
    });
    write(phase * cycle_s, &mut posture);
    (signals, posture)
}

/// The model at its pose in the scene, with abducted arms and markers at the grip points of the hands.
fn placed_model(human: &Human, entry: &FigureEntry, built: &BuiltFigure) -> Result<Model, ModelError> {
    let model = &human.model;
    let mut bodies = model.bodies().to_vec();
    let mut markers = model.markers().to_vec();
    for body in bodies.iter_mut().filter(|body| body.joint.parent.is_none()) {
        body.joint.parent_from_joint = entry.pose * body.joint.parent_from_joint;
    }
    let mut coordinates = model.coordinates().to_vec();
    for ((side, arm), outwards) in Side::BOTH.into_iter().zip(built.arms).zip([-1.0, 1.0]) {
        if let Some(humerus) = model.body(&format!("humerus_{}", side.letter())) {
            let joint = &mut bodies[humerus.index()].joint;
            if arm.spring.is_some() {
                let adduction = CoordinateId(coordinates.len());
                coordinates.push(Coordinate {
                    name: adduction_name(side),
                    kind: CoordinateKind::Rotation,
                    default_value: -arm.abduction,
                    range: None,
                    clamped: false,
                    drive: model::Drive::Free,
                });
                let follows = Function::Linear { slope: 1.0, intercept: 0.0 };
                let displacement = Displacement::Follows(adduction, follows);
                joint.rotations.insert(0, JointAxis { direction: Vec3::x() * -outwards, displacement });
            } else {
                joint.parent_from_joint.rotation *= rotation(&(Vec3::x() * arm.abduction * outwards));
            }
        }
        if let Some(forearm) = model.body(&format!("forearm_{}", side.letter())) {
            let down = human.dimensions.forearm + GRIP * human.dimensions.hand;
            let location = Vec3::new(0.0, -down, 0.0);
            markers.push(Marker {
                name: format!("hand_{}", side.letter()),
                body: Some(forearm),
                location,
                fixed: false,
            });
        }
    }
    Model::new(model.name(), model.gravity(), bodies, coordinates, markers)
}

/// Applies initial values from the scene, or from drives of single coordinates.
fn own_starts(built: &BuiltFigure, model: &Model, motion: &mut Motion) {
    for own in &built.coordinates {
        let Some(id) = model.coordinate(&own.name) else { continue };
        let [q, qd] = &mut motion.start;
        if let Some(accelerations) = motion.accelerations.as_mut().filter(|_| own.starts[0] || own.starts[1]) {
            accelerations[id.index()] = 0.0;
        }
        if own.starts[0] {
            // Zero unless a rate is given.
            (q[id.index()], qd[id.index()]) = (own.acting.start, own.acting.rate);
        } else if own.starts[1] {
            qd[id.index()] = own.acting.rate;
        }
    }
}

/// Arm adduction, which is positive towards the trunk in OpenSim.
fn adduction_name(side: Side) -> String {
    format!("arm_add_{}", side.letter())
}

fn own_of<'a>(built: &'a BuiltFigure, model: &Model, id: CoordinateId) -> Option<(usize, &'a BuiltCoordinate)> {
    let name = &model.coordinates()[id.index()].name;
    built.coordinates.iter().enumerate().find(|(_, own)| own.name == *name)
}

fn acting_on(
    built: &BuiltFigure,
    number: usize,
    model: &Model,
    id: CoordinateId,
    signals: &[Signal],
    sources: &mut InputFiles<'_, '_>,
) -> Result<JointCoordinate, SceneError> {
    let signal = || signals[id.index()].clone();
    let slides = matches!(model.coordinates()[id.index()].kind, CoordinateKind::Translation);
    for (arm, side) in built.arms.iter().zip(Side::BOTH) {
        if let (Some([stiffness, damping]), true) =
            (arm.spring, model.coordinates()[id.index()].name == adduction_name(side))
        {
            let spring = Some(Spring { stiffness, damping, rest: -arm.abduction });
            return Ok(JointCoordinate { spring, ..JointCoordinate::default() });
        }
    }
    if built.control.is_some() {
        return Ok(JointCoordinate::default());
    }
    let Some((k, own)) = own_of(built, model, id) else {
        let drive = (!slides).then(|| JointDrive { signal: signal(), max: None });
        return Ok(JointCoordinate { drive, ..JointCoordinate::default() });
    };
    let place = Place { line: own.line, key: format!("figure[{number}].coordinate[{}]", k + 1) };
    let mut acting = acting(&own.acting, &place, sources)?;
    if let Some(WalkTracking { stiffness, damping, max }) = own.follow {
        acting.motor = Some(Motor { target: signal(), kp: stiffness, kd: damping, max });
    }
    Ok(acting)
}
