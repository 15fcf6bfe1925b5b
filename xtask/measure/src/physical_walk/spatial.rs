//! The man in three dimensions: the same measurements along his optimal walk, with pushes from eight sides.

use super::{
    Figure, LIFT, MAN, SPEED, Walked, changed, changing_speed, controller, inclined, pushes_survived, stiffness,
    tiles_walked, walked, with_controller,
};
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Speed, Walk};
use ambulo::model::anthropometry::{Build, Human};
use ambulo::model::full_body::full_body;
use ambulo::optimal::{OptimalWalk, soles_with_width};
use ambulo::simulation::control::ControlSettings;
use ambulo::spatial::Vec3;
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
}

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
    })
}

/// The man at a speed [m/s], with a plan that lifts the soles further [m].
pub(super) fn figure(speed: f64, lift_m: f64) -> Result<Figure, String> {
    let mut gait = Gait::named("free").map_err(|e| e.to_string())?;
    gait.pace.speed = Some(Speed::MetersPerSecond(speed));
    let planar = MAN.human().map_err(|e| e.to_string())?;
    let walk = Walk::new(&gait, planar.dimensions.leg_length, &mut Findings::default()).map_err(|e| e.to_string())?;
    let found = OptimalWalk::find_lifted(&MAN, &walk, lift_m).map_err(|e| e.to_string())?;
    Ok(Figure { human: found.figure(), plan: found.solution })
}

fn with_wide_soles(build: &Build) -> Result<Human, String> {
    let human = full_body(build).map_err(|e| e.to_string())?;
    Ok(Human { soles: soles_with_width(&human), ..human })
}
