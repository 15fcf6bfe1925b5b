//! The man in three dimensions: the same measurements along his optimal walk, with pushes from eight sides.

use super::{
    BUILDS, Figure, LIFT, MAN, PUSH_S, SPEED, Walked, changed, changing_speed, controller, inclined, pushes_survived,
    stiffness, tiles_walked, walked, with_controller,
};
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Speed, Walk};
use ambulo::model::anthropometry::{Build, Human};
use ambulo::model::full_body::full_body;
use ambulo::optimal::{Observer, OptimalWalk, soles_with_width};
use ambulo::simulation::control::tuning::{Push, PushSettings, PushUse};
use ambulo::simulation::control::{ControlSettings, WalkController};
use ambulo::spatial::{Vec3, Wrench};
use cpu_time::ThreadTime;

/// Speeds of plans [m/s].
pub(super) const SPEEDS: [f64; 7] = [1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6];
/// Directions of pushes, forward and to the right, by name, and their force [N]; asked of them.
const DIAGONAL: f64 = std::f64::consts::FRAC_1_SQRT_2;
pub(super) const PUSHES: [(&str, [f64; 2], f64); 12] = [
    ("forward", [1.0, 0.0], 100.0),
    ("backward", [-1.0, 0.0], 100.0),
    ("forward and right", [DIAGONAL, DIAGONAL], 100.0),
    ("forward and left", [DIAGONAL, -DIAGONAL], 100.0),
    ("backward and right", [-DIAGONAL, DIAGONAL], 100.0),
    ("backward and left", [-DIAGONAL, -DIAGONAL], 100.0),
    ("right", [0.0, 1.0], 60.0),
    ("left", [0.0, -1.0], 60.0),
    ("right", [0.0, 1.0], 100.0),
    ("left", [0.0, -1.0], 100.0),
    ("forward", [1.0, 0.0], 150.0),
    ("backward", [-1.0, 0.0], 150.0),
];
/// Steps of a walk on uneven or inclined ground, and by another figure.
pub(super) const STEPS: usize = 50;

/// Measurements of the man in three dimensions.
pub(super) struct Results {
    /// CPU time of plan and gains [s].
    pub(super) made_s: [f64; 2],
    pub(super) long: Walked,
    pub(super) stiffness: Vec<(&'static str, f64)>,
    /// How many pushes were survived, in the order of [`PUSHES`].
    pub(super) pushes: Vec<usize>,
    pub(super) tiles: usize,
    /// Slope [%] and the walk.
    pub(super) slopes: Vec<(f64, Walked)>,
    pub(super) changed: Vec<(String, Walked)>,
    /// Whether he fell while his speed changed through all of [`SPEEDS`] and back; mean speed while it was lowest,
    /// highest, lowest [m/s].
    pub(super) changing: (bool, [f64; 3]),
    /// Speed of the plan [m/s], the walk, and how many pushes of 100 N forward, backward, right and left were survived.
    pub(super) speeds: Vec<(f64, Walked, usize)>,
    /// Pushes from all sides, with and without recovery steps.
    pub(super) shoved: Vec<Shoved>,
}

/// Pushes from all sides that a figure survives, by force ([`SHOVES`]).
pub(super) struct Shoved {
    /// The figure, and the speed of its plan [m/s].
    pub(super) name: String,
    pub(super) speed: f64,
    /// Number of pushes of each force.
    pub(super) pushes: usize,
    /// Survived with recovery steps, and with feedback alone.
    pub(super) survived: [[usize; 2]; 2],
}

/// Forces of the pushes from all sides of 75 kg [N].
pub(super) const SHOVES: [f64; 2] = [150.0, 200.0];
/// Speeds at which the man is pushed from all sides [m/s]; those of others grow with the root of stature.
const SHOVED_AT: [f64; 3] = [1.0, SPEED, 1.6];
/// Other figures get every third of the pushes.
const OF_OTHERS: usize = 3;

pub(super) fn measure(settings: &ControlSettings) -> Result<Results, String> {
    let clock = ThreadTime::now();
    let man = figure(SPEED, 0.0)?;
    let plan_s = clock.elapsed().as_secs_f64();
    let own = controller(&man, settings)?;
    let made_s = [plan_s, clock.elapsed().as_secs_f64() - plan_s];
    let (mut speeds, mut paces) = (Vec::new(), Vec::new());
    for speed in SPEEDS {
        let other = figure(speed, 0.0)?;
        let own = controller(&other, settings)?;
        let mut survived = 0;
        for [x, z] in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]] {
            survived += pushes_survived(&other, &own, Vec3::new(x, 0.0, z) * 100.0)?;
        }
        speeds.push((speed, walked(with_controller(&other, &own)?, &other, 100)?, survived));
        paces.push((other, own));
    }
    let pushes = PUSHES.iter().map(|(_, [x, z], force)| pushes_survived(&man, &own, Vec3::new(*x, 0.0, *z) * *force));
    let slopes = [-5.0, 5.0].into_iter().map(|slope| Ok((slope, inclined(&man, &own, slope, STEPS)?)));
    Ok(Results {
        made_s,
        long: walked(with_controller(&man, &own)?, &man, 200)?,
        stiffness: stiffness(&man, &own),
        pushes: pushes.collect::<Result<_, String>>()?,
        tiles: tiles_walked(&figure(SPEED, LIFT)?, settings, STEPS)?,
        slopes: slopes.collect::<Result<_, String>>()?,
        changed: changed(&man, &own, with_wide_soles, STEPS)?,
        changing: changing_speed(&paces, [SPEEDS[0], SPEEDS[SPEEDS.len() - 1]])?,
        speeds,
        shoved: shoved(settings)?,
    })
}

/// Pushes from all sides of all figures at three speeds, the same as in the report of
/// `ambulo tune examples/pushed-from-four-sides.toml`.
fn shoved(settings: &ControlSettings) -> Result<Vec<Shoved>, String> {
    let of_seed = |seed| PushSettings { seed, force_n: 0.0, count: 24, all_around: true }.pushes(PushUse::Report);
    let third = |pushes: &[Push]| pushes.iter().step_by(OF_OTHERS).copied().collect::<Vec<Push>>();
    let all = of_seed(1);
    let (some, unseen) = (third(&all), third(&of_seed(2)));
    let man = SHOVED_AT.map(|speed| (MAN, speed, &all)).into_iter().chain([(MAN, SPEED, &unseen)]);
    let at = |speed: f64, build: &Build| speed * (build.height / MAN.height).sqrt();
    let others = BUILDS.iter().flat_map(|build| SHOVED_AT.map(|speed| (*build, at(speed, build), &some)));
    let of = |(build, speed, pushes): (Build, f64, &Vec<Push>)| {
        let figure = figure_of(&build, speed, 0.0)?;
        let with = controller(&figure, settings)?;
        let without = with.clone().without_recovery_steps();
        let count = |controller: &WalkController, force_n| survived_shoves(&figure, controller, pushes, force_n);
        let both = |controller: &WalkController| -> Result<[usize; 2], String> {
            Ok([count(controller, SHOVES[0])?, count(controller, SHOVES[1])?])
        };
        let survived = [both(&with)?, both(&without)?];
        Ok(Shoved { name: crate::walk_bands::build_name(&build), speed, pushes: pushes.len(), survived })
    };
    man.chain(others).map(of).collect()
}

/// How many pushes of a force are survived for five cycles; they begin in the second cycle. Two at a time.
fn survived_shoves(
    figure: &Figure,
    controller: &WalkController,
    pushes: &[Push],
    force_n: f64,
) -> Result<usize, String> {
    let cycle_s = figure.plan.cycle_s();
    let trunk = figure.human.model.body("torso").map_or(0, |id| id.index());
    let survives = |push: &Push| -> Result<usize, String> {
        let mut walk = with_controller(figure, controller)?;
        let start_s = cycle_s * (1.0 + push.phase);
        let force = Push { force_n, ..*push }.force(figure.human.model.mass());
        for (load, until_s) in
            [(Vec3::zeros(), start_s), (force, start_s + PUSH_S), (Vec3::zeros(), start_s + 5.0 * cycle_s)]
        {
            walk.world_mut().bodies[trunk].load = Wrench { moment: Vec3::zeros(), force: load };
            walk.walk_until(until_s).map_err(|e| e.to_string())?;
        }
        Ok(usize::from(walk.fall().is_none()))
    };
    let (first, second) = pushes.split_at(pushes.len() / 2);
    let count = |pushes: &[Push]| pushes.iter().map(survives).sum::<Result<usize, String>>();
    std::thread::scope(|scope| {
        let other = scope.spawn(|| count(first));
        let own = count(second)?;
        Ok(own + other.join().map_err(|_| "a thread of pushes ended early")??)
    })
}

/// The man at a speed [m/s], with a plan that lifts the soles further [m].
pub(super) fn figure(speed: f64, lift_m: f64) -> Result<Figure, String> {
    figure_of(&MAN, speed, lift_m)
}

pub(super) fn figure_of(build: &Build, speed: f64, lift_m: f64) -> Result<Figure, String> {
    let mut gait = Gait::named("free").map_err(|e| e.to_string())?;
    gait.pace.speed = Some(Speed::MetersPerSecond(speed));
    let planar = build.human().map_err(|e| e.to_string())?;
    let walk = Walk::new(&gait, planar.dimensions.leg_length, &mut Findings::default()).map_err(|e| e.to_string())?;
    let found = OptimalWalk::find_lifted(build, &walk, lift_m, &Observer::default()).map_err(|e| e.to_string())?;
    Ok(Figure { human: found.figure(), plan: found.solution })
}

fn with_wide_soles(build: &Build) -> Result<Human, String> {
    let human = full_body(build).map_err(|e| e.to_string())?;
    Ok(Human { soles: soles_with_width(&human), ..human })
}
