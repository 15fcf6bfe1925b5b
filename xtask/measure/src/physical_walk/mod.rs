//! Figures that walk by their own torques: `cargo xtask physical-walk [--write]`, and stand: `cargo xtask standing
//! [--write]`, whose page is docs/measured/STANDING.md.
//!
//! One man, his plan at free speed and the gains of that plan walk for a thousand steps, are pushed, and walk on uneven
//! and on inclined ground, with another mass and other legs; then plans of other speeds and other figures. With
//! `--write` the page goes to docs/measured/PHYSICAL_WALK.md and its picture to docs/images/physical_walk.svg.

mod figure;
mod page;
mod placement;
mod spatial;
mod standing;

use crate::workspace;
use ambulo::contact::Shape;
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Speed, Walk};
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::numerics::Harmonics;
use ambulo::numerics::Random;
use ambulo::optimal::Solution;
use ambulo::simulation::consistent_walk::{ConsistentWalkSettings, make_consistent_walk};
use ambulo::simulation::control::{Balance, ControlSettings, PhysicalWalk, TorqueCurves, WalkController};
use ambulo::simulation::{Obstacle, Owner, StepSettings, Surface};
use ambulo::spatial::{Pose, Vec3, Wrench};
use cpu_time::ThreadTime;

/// The main figure, and the speed of its plan [m/s].
const MAN: Build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
const SPEED: f64 = 1.25;
/// Other speeds [m/s].
const SPEEDS: [f64; 12] = [0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8];
/// Other figures.
const BUILDS: [Build; 5] = [
    Build { table: SegmentTable::DeLevaFemale, mass: 60.0, height: 1.65, toe_joint: true },
    Build { mass: 30.0, height: 1.30, ..MAN },
    Build { mass: 120.0, height: 1.90, ..MAN },
    Build { table: SegmentTable::Faure1997, mass: 80.0, height: 1.80, toe_joint: true },
    Build { table: SegmentTable::DempsterWinter, mass: 90.0, height: 1.70, toe_joint: true },
];
/// Time at the lowest and the highest of these speeds, and time of a change from one to the other [s].
const HOLD_S: f64 = 10.0;
const RAMP_S: f64 = 20.0;
/// Forces of pushes of 75 kg [N], their duration [s], and the number of phases at which they begin.
const PUSHES: [f64; 10] = [50.0, -50.0, 100.0, -100.0, 150.0, -150.0, 200.0, -200.0, 250.0, -250.0];
const PUSH_S: f64 = 0.2;
const PHASES: usize = 10;
/// Share of the distance between two of them at which the first one lies: between those that were looked at while
/// settings were chosen.
const PHASE: f64 = 0.25;
/// Mass for which pushes are given [kg]; they grow with mass.
const PUSHED_KG: f64 = 75.0;
/// Steps that must follow a push.
const AFTER_PUSH: usize = 10;
/// Largest difference of height between tiles that are one step long [m], and the numbers of their seeds.
const TILE: f64 = 0.02;
const SEEDS: u64 = 20;
/// Height by which the plan for tiles lifts the soles further, in the middle of swing [m].
const LIFT: f64 = 0.027;

/// Delays of feedback and time constants of its torques [s].
const DELAYS_S: [[f64; 2]; 6] = [[0.01, 0.0], [0.02, 0.0], [0.04, 0.0], [0.06, 0.0], [0.02, 0.02], [0.04, 0.04]];

/// A figure with its plan.
struct Figure {
    human: Human,
    plan: Solution,
}

/// A walk without a push.
struct Walked {
    /// Steps without a fall.
    steps: usize,
    fell: bool,
    /// Mean speed [m/s].
    speed: f64,
    /// Root mean square difference of hips, knees and ankles from the plan [rad].
    apart: f64,
    /// CPU time of the simulation [s], and the time that it simulates [s].
    seconds: [f64; 2],
    /// Largest force or moment on the root [N, N.m].
    root: f64,
}

/// Everything measured in one run.
struct Results {
    machine: String,
    /// CPU time of plan and gains [s].
    made_s: [f64; 2],
    long: Walked,
    /// Largest stiffness of each joint of the right leg and of the trunk, impedance and feedback together [N.m/rad].
    stiffness: Vec<(&'static str, f64)>,
    /// Seconds until the fall without feedback.
    without: Option<f64>,
    /// Force [N], how many of [`PHASES`] pushes were survived.
    pushes: Vec<(f64, usize)>,
    /// How many of [`SEEDS`] rows of tiles were walked for a hundred steps.
    tiles: usize,
    /// Slope [%] and the walk.
    slopes: Vec<(f64, Walked)>,
    /// What was changed, and the walk with the gains of the main figure.
    changed: Vec<(String, Walked)>,
    /// A walk whose speed changes through all of [`SPEEDS`] and back: whether it fell, and mean speed while it was
    /// slowest, fastest, slowest [m/s].
    changing: (bool, [f64; 3]),
    /// Speed of the plan [m/s], the walk, and how many of the pushes of 100 N forward and backward were survived.
    speeds: Vec<(f64, Walked, usize)>,
    others: Vec<(String, Walked, usize)>,
    /// Number of harmonics, share of the variance of hip, knee and ankle torques that they keep, the walk, and pushes
    /// as above.
    harmonics: Vec<OfHarmonics>,
    tuned: Tuned,
    /// Delay of feedback [s], the walk, and pushes as above.
    delays: Vec<([f64; 2], Walked, usize)>,
    placement: placement::Results,
    /// The same man in three dimensions.
    spatial: spatial::Results,
}

/// The same with gains that were tuned in the plane.
struct Tuned {
    /// Force [N], how many of [`PHASES`] pushes were survived.
    pushes: Vec<(f64, usize)>,
    tiles: usize,
    /// Slope [%] and the walk.
    slopes: Vec<(f64, Walked)>,
    /// How many pushes of 100 N forward and backward were survived at all of [`SPEEDS`].
    at_speeds: usize,
    /// Delay of feedback [s] and the walk.
    delays: Vec<(f64, Walked)>,
    /// How many pushes of 60 N to the right and to the left were survived in three dimensions.
    sideways: [usize; 2],
}

/// Runs the command.
#[expect(clippy::print_stdout, reason = "the page is the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let write = workspace::write_option(words)?;
    let results = measure()?;
    let page = page::text(&results);
    println!("{page}");
    if write {
        workspace::save("docs/measured/PHYSICAL_WALK.md", &page)?;
        workspace::save("docs/images/physical_walk.svg", &figure::svg(&results)?)?;
    }
    Ok(())
}

/// Runs the command for standing.
#[expect(clippy::print_stdout, reason = "the page is the command's result")]
pub(crate) fn run_standing(words: &[String]) -> Result<(), String> {
    let write = workspace::write_option(words)?;
    let page = standing::page(&standing::measure(&ControlSettings::default())?);
    println!("{page}");
    if write { workspace::save("docs/measured/STANDING.md", &page) } else { Ok(()) }
}

fn measure() -> Result<Results, String> {
    let settings = ControlSettings::default();
    let clock = ThreadTime::now();
    let man = figure(&MAN, SPEED, 0.0)?;
    let plan_s = clock.elapsed().as_secs_f64();
    let controller = controller(&man, &settings)?;
    let made_s = [plan_s, clock.elapsed().as_secs_f64() - plan_s];
    let with = |figure: &Figure| with_controller(figure, &controller);
    let (mut speeds, mut paces) = (Vec::new(), Vec::new());
    for speed in SPEEDS {
        let other = figure(&MAN, speed, 0.0)?;
        let own = self::controller(&other, &settings)?;
        let walked = walked(with_controller(&other, &own)?, &other, 100)?;
        speeds.push((speed, walked, pushed_both_ways(&other, &own)?));
        paces.push((other, own));
    }
    let mut others = Vec::new();
    for build in BUILDS {
        let other = figure(&build, SPEED * (build.height / MAN.height).sqrt(), 0.0)?;
        let own = self::controller(&other, &settings)?;
        let survived = pushed_both_ways(&other, &own)?;
        let walked = walked(with_controller(&other, &own)?, &other, 100)?;
        others.push((crate::walk_bands::build_name(&build), walked, survived));
    }
    Ok(Results {
        machine: crate::bench::machine(),
        made_s,
        long: walked(with(&man)?, &man, 1000)?,
        stiffness: stiffness(&man, &controller),
        without: fall_without_feedback(&man, &settings)?,
        pushes: PUSHES
            .iter()
            .map(|force| Ok((*force, pushes_survived(&man, &controller, Vec3::x() * *force)?)))
            .collect::<Result<_, String>>()?,
        tiles: tiles_walked(&figure(&MAN, SPEED, LIFT)?, &settings, 100)?,
        slopes: [-5.0, 5.0]
            .into_iter()
            .map(|slope| Ok((slope, inclined(&man, &controller, slope, 100)?)))
            .collect::<Result<_, String>>()?,
        changed: changed(&man, &controller, |build| build.human().map_err(|e| e.to_string()), 100)?,
        changing: changing_speed(&paces, [SPEEDS[0], SPEEDS[SPEEDS.len() - 1]])?,
        speeds,
        others,
        harmonics: with_harmonics(&man, &settings)?,
        tuned: with_tuned_gains(&man, &paces)?,
        delays: with_delays(&man, &settings)?,
        placement: placement::measure(&man, &settings)?,
        spatial: spatial::measure(&settings)?,
    })
}

/// Number of harmonics, what is kept of the torques, the walk, and the pushes that are survived.
type OfHarmonics = (usize, [f64; 3], Walked, usize);

/// Walks and pushes whose torques are the first harmonics of those of the plan.
fn with_harmonics(man: &Figure, settings: &ControlSettings) -> Result<Vec<OfHarmonics>, String> {
    let of = |count: usize| {
        let torques = TorqueCurves::Harmonics(count);
        let own = controller(man, &ControlSettings { torques, ..settings.clone() })?;
        let survived = pushed_both_ways(man, &own)?;
        Ok((count, kept(man, count)?, walked(with_controller(man, &own)?, man, 100)?, survived))
    };
    [1, 2, 3, 4, 5, 6, 8, 12].into_iter().map(of).collect()
}

fn with_tuned_gains(man: &Figure, paces: &[(Figure, WalkController)]) -> Result<Tuned, String> {
    let settings = ControlSettings::tuned_in_the_plane();
    let own = controller(man, &settings)?;
    let pushed = |force: &f64| Ok((*force, pushes_survived(man, &own, Vec3::x() * *force)?));
    let mut at_speeds = 0;
    for (figure, _) in paces {
        at_speeds += pushed_both_ways(figure, &controller(figure, &settings)?)?;
    }
    let late = |delay_s: f64| {
        let own = controller(man, &ControlSettings { delay_s, ..settings.clone() })?;
        Ok((delay_s, walked(with_controller(man, &own)?, man, 100)?))
    };
    let spatial = spatial::figure(SPEED, 0.0)?;
    let in_space = controller(&spatial, &settings)?;
    let aside = |force: f64| pushes_survived(&spatial, &in_space, Vec3::z() * force);
    Ok(Tuned {
        pushes: PUSHES.iter().chain(&[300.0, -300.0]).map(pushed).collect::<Result<_, String>>()?,
        tiles: tiles_walked(&figure(&MAN, SPEED, LIFT)?, &settings, 100)?,
        slopes: [-5.0, 5.0]
            .into_iter()
            .map(|slope| Ok((slope, inclined(man, &own, slope, 100)?)))
            .collect::<Result<_, String>>()?,
        at_speeds,
        delays: DELAYS_S[..3].iter().map(|[delay_s, _]| late(*delay_s)).collect::<Result<_, String>>()?,
        sideways: [aside(60.0)?, aside(-60.0)?],
    })
}

/// Walks and pushes with feedback that acts late.
fn with_delays(man: &Figure, settings: &ControlSettings) -> Result<Vec<([f64; 2], Walked, usize)>, String> {
    let of = |[delay_s, activation_s]: [f64; 2]| {
        let own = controller(man, &ControlSettings { delay_s, activation_s, ..settings.clone() })?;
        let survived = pushed_both_ways(man, &own)?;
        Ok(([delay_s, activation_s], walked(with_controller(man, &own)?, man, 100)?, survived))
    };
    DELAYS_S.into_iter().map(of).collect()
}

/// A figure with a plan that lifts its soles further than people do [m].
fn figure(build: &Build, speed: f64, lift: f64) -> Result<Figure, String> {
    let human = build.human().map_err(|e| e.to_string())?;
    let mut gait = Gait::named("free").map_err(|e| e.to_string())?;
    gait.pace.speed = Some(Speed::MetersPerSecond(speed));
    let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).map_err(|e| e.to_string())?;
    let mut settings = ConsistentWalkSettings::default();
    settings.costs.lift = lift;
    let walk = make_consistent_walk(&human, &walk, &settings).map_err(|e| e.to_string())?;
    Ok(Figure { human, plan: walk.solution().clone() })
}

fn controller(figure: &Figure, settings: &ControlSettings) -> Result<WalkController, String> {
    WalkController::new(&figure.human, &figure.plan, StepSettings::default(), settings).map_err(|e| e.to_string())
}

fn with_controller(figure: &Figure, controller: &WalkController) -> Result<PhysicalWalk, String> {
    PhysicalWalk::with(&figure.human, &figure.plan, StepSettings::default(), controller.clone())
        .map_err(|e| e.to_string())
}

/// Walks a number of steps.
fn walked(mut walk: PhysicalWalk, figure: &Figure, steps: usize) -> Result<Walked, String> {
    let of_legs: Vec<usize> = ["hip_flexion", "knee_angle", "ankle_angle"]
        .iter()
        .flat_map(|joint| ["r", "l"].map(|side| format!("{joint}_{side}")))
        .filter_map(|name| figure.human.model.coordinate(&name).map(|id| id.index()))
        .collect();
    let index = |name: &str| figure.human.model.coordinate(name).map(|id| id.index());
    let root = ["pelvis_tx", "pelvis_ty", "pelvis_tilt", "pelvis_tz", "pelvis_list", "pelvis_rotation"];
    let root: Vec<usize> = root.into_iter().filter_map(index).collect();
    let (mut squares, mut count, mut outside) = (0.0, 0.0, 0.0_f64);
    let clock = ThreadTime::now();
    while walk.controller().strikes() < steps && walk.fall().is_none() {
        walk.step().map_err(|e| e.to_string())?;
        let now = walk.coordinates();
        let planned = walk.controller().planned();
        squares += of_legs.iter().map(|&c| (now[c][0] - planned[0][c]).powi(2)).sum::<f64>();
        count += of_legs.len() as f64;
        outside = root.iter().fold(outside, |most, &c| most.max(walk.efforts()[c].abs()));
    }
    let seconds = [clock.elapsed().as_secs_f64(), walk.time_s()];
    Ok(Walked {
        steps: walk.controller().strikes(),
        fell: walk.fall().is_some(),
        speed: walk.coordinates()[root[0]][0] / walk.time_s(),
        apart: f64::sqrt(squares / count),
        seconds,
        root: outside,
    })
}

/// One controller of all speeds: 10 s at the lowest one, to the highest within [`RAMP_S`], 10 s there, and back.
fn changing_speed(paces: &[(Figure, WalkController)], [slow, fast]: [f64; 2]) -> Result<(bool, [f64; 3]), String> {
    let controllers: Vec<WalkController> = paces.iter().map(|(_, own)| own.clone()).collect();
    let joined = WalkController::joined(&controllers).map_err(|e| e.to_string())?;
    let figure = &paces[0].0;
    let forward = figure.human.model.coordinate("pelvis_tx").map_or(0, |id| id.index());
    let mut walk = with_controller(figure, &joined)?;
    let (mut means, mut end_s) = ([0.0; 3], 0.0);
    for (k, (from, to)) in [(slow, fast), (fast, slow), (slow, slow)].into_iter().enumerate() {
        let (start_s, place) = (end_s, walk.coordinates()[forward][0]);
        walk.walk_until(start_s + HOLD_S).map_err(|e| e.to_string())?;
        means[k] = (walk.coordinates()[forward][0] - place) / HOLD_S;
        end_s = start_s + HOLD_S + RAMP_S;
        while k < 2 && walk.time_s() < end_s && walk.fall().is_none() {
            let share = (walk.time_s() - start_s - HOLD_S) / RAMP_S;
            walk.set_speed(from + share * (to - from)).map_err(|e| e.to_string())?;
            walk.step().map_err(|e| e.to_string())?;
        }
    }
    Ok((walk.fall().is_some(), means))
}

/// How many pushes of 100 N forward and backward are survived.
fn pushed_both_ways(figure: &Figure, controller: &WalkController) -> Result<usize, String> {
    let force = Vec3::x() * 100.0;
    Ok(pushes_survived(figure, controller, force)? + pushes_survived(figure, controller, -force)?)
}

/// How many pushes of a force at the trunk are survived for [`AFTER_PUSH`] steps, of those that begin at [`PHASES`]
/// phases of the third cycle.
fn pushes_survived(figure: &Figure, controller: &WalkController, force: Vec3) -> Result<usize, String> {
    let cycle_s = figure.plan.cycle_s();
    let trunk = figure.human.model.body("torso").map_or(0, |id| id.index());
    let force = force * figure.human.model.mass() / PUSHED_KG;
    let mut survived = 0;
    for phase in 0..PHASES {
        let mut walk = with_controller(figure, controller)?;
        let start_s = cycle_s * (2.0 + (phase as f64 + PHASE) / PHASES as f64);
        walk.walk_until(start_s).map_err(|e| e.to_string())?;
        walk.world_mut().bodies[trunk].load = Wrench { moment: Vec3::zeros(), force };
        walk.walk_until(start_s + PUSH_S).map_err(|e| e.to_string())?;
        walk.world_mut().bodies[trunk].load = Wrench::ZERO;
        let before = walk.controller().strikes();
        while walk.fall().is_none() && walk.controller().strikes() < before + AFTER_PUSH {
            walk.step().map_err(|e| e.to_string())?;
        }
        survived += usize::from(walk.fall().is_none());
    }
    Ok(survived)
}

/// How many rows of tiles of random heights are walked for some steps.
fn tiles_walked(figure: &Figure, settings: &ControlSettings, steps: usize) -> Result<usize, String> {
    let controller = &controller(figure, settings)?;
    let length = 0.5 * figure.plan.speed() * figure.plan.cycle_s();
    let mut walked = 0;
    for seed in 0..SEEDS {
        let mut walk = with_controller(figure, controller)?;
        let mut random = Random::seeded(seed);
        let mut height = 0.0;
        let ground = walk.world_mut().surfaces.iter().rposition(|surface| matches!(surface.owner, Owner::Obstacle(_)));
        let material = ground.map_or(0, |ground| walk.world_mut().surfaces[ground].material);
        // The level ground is far below; the first two tiles are level.
        walk.world_mut().obstacles[0].pose = Pose::at(Vec3::new(0.0, -5.0, 0.0));
        for tile in -2..110 {
            if tile >= 2 {
                height += TILE * (2.0 * random.share() - 1.0);
            }
            let half = Vec3::new(0.5 * length, 1.0, 2.0);
            let place = Vec3::new((f64::from(tile) + 0.5) * length, height - half.y, 0.0);
            let world = walk.world_mut();
            world.obstacles.push(Obstacle { name: format!("tile {tile}"), pose: Pose::at(place), path: None });
            world.surfaces.push(Surface {
                owner: Owner::Obstacle(world.obstacles.len() - 1),
                shape: Shape::cuboid(half).map_err(|e| e.to_string())?,
                owner_from_shape: Pose::IDENTITY,
                material,
            });
        }
        while walk.fall().is_none() && walk.controller().strikes() < steps {
            walk.step().map_err(|e| e.to_string())?;
        }
        walked += usize::from(walk.fall().is_none());
    }
    Ok(walked)
}

/// Some steps on a slope [%], uphill if positive. Gravity is inclined instead of the ground.
fn inclined(figure: &Figure, controller: &WalkController, slope: f64, steps: usize) -> Result<Walked, String> {
    let mut walk = with_controller(figure, controller)?;
    let world = walk.world_mut();
    let (sin, cos) = (slope / 100.0).atan().sin_cos();
    world.gravity = Vec3::new(-sin, -cos, 0.0) * world.gravity.norm();
    walked(walk, figure, steps)
}

/// Other masses and leg lengths with the plan and the gains of the main figure.
fn changed(
    man: &Figure,
    controller: &WalkController,
    built: impl Fn(&Build) -> Result<Human, String>,
    steps: usize,
) -> Result<Vec<(String, Walked)>, String> {
    let masses = [0.85, 1.15].map(|share| (format!("mass x {share}"), Build { mass: share * MAN.mass, ..MAN }));
    let legs =
        [0.95, 1.05].map(|share| (format!("stature and legs x {share}"), Build { height: share * MAN.height, ..MAN }));
    let of = |(name, build): (String, Build)| {
        let other = Figure { human: built(&build)?, plan: man.plan.clone() };
        Ok((name, walked(with_controller(&other, controller)?, &other, steps)?))
    };
    masses.into_iter().chain(legs).map(of).collect()
}

fn stiffness(figure: &Figure, controller: &WalkController) -> Vec<(&'static str, f64)> {
    let of =
        |name: &'static str| figure.human.model.coordinate(name).map(|id| (name, controller.largest_stiffness(id)));
    ["hip_flexion_r", "knee_angle_r", "ankle_angle_r", "mtp_angle_r", "lumbar_extension"]
        .into_iter()
        .filter_map(of)
        .collect()
}

fn fall_without_feedback(figure: &Figure, settings: &ControlSettings) -> Result<Option<f64>, String> {
    let own = controller(figure, &ControlSettings { balance: Balance::Nothing, ..settings.clone() })?;
    let fall = with_controller(figure, &own)?.walk_until(60.0).map_err(|e| e.to_string())?;
    Ok(fall.map(|fall| fall.time_s))
}

/// Share of the variance of the torques of right hip, knee and ankle that the first harmonics of the cycle keep.
fn kept(figure: &Figure, count: usize) -> Result<[f64; 3], String> {
    let cycle_s = figure.plan.cycle_s();
    let phases: Vec<f64> = (0..1000).map(|k| f64::from(k) / 1000.0).collect();
    let times: Vec<f64> = phases.iter().map(|phase| cycle_s * phase).collect();
    let samples = figure.plan.samples(&times).map_err(|e| e.to_string())?;
    Ok(["hip_flexion_r", "knee_angle_r", "ankle_angle_r"].map(|name| {
        let c = figure.human.model.coordinate(name).map_or(0, |id| id.index());
        let torques: Vec<f64> = samples.iter().map(|sample| sample.forces[c]).collect();
        Harmonics::of(&phases, &torques, count).r_squared(&phases, &torques)
    }))
}
