//! Stopping, standing, stepping and walking off.

use super::{BUILDS, Figure, MAN, PUSH_S, PUSHED_KG, controller, spatial, with_controller};
use crate::walk_bands::build_name;
use ambulo::model::anthropometry::Human;
use ambulo::optimal::StandingMovements;
use ambulo::simulation::StepSettings;
use ambulo::simulation::control::{ControlSettings, PhysicalWalk, WalkController};
use ambulo::spatial::{Vec3, Wrench};
use ambulo::study::validation::TextTable as Table;
use cpu_time::ThreadTime;

/// Time of walking before the figure is told to stop [s], longest time until it stands, time in which it comes to rest,
/// and time of standing after it [s].
const WALKS_S: f64 = 3.0;
const STOPS_S: f64 = 6.0;
const RESTS_S: f64 = 2.0;
const STANDS_S: f64 = 3.0;
/// Time after a push from any side in which the figure steps and comes to rest [s].
const STEPS_FOR_S: f64 = 6.0;
/// Steps after walking off.
const STEPS: usize = 20;
/// Forces of pushes in standing [N], of 75 kg.
const PUSHES: [f64; 4] = [50.0, -50.0, 100.0, -100.0];
/// Forces of pushes from eight sides [N], of 75 kg, and the times of standing at which they begin [s].
const FROM_ALL_SIDES: [f64; 2] = [100.0, 150.0];
const SIDES: usize = 8;
const AT_S: [f64; 2] = [0.5, RESTS_S];

/// A figure that stops, stands and walks off.
pub(super) struct Stands {
    name: String,
    /// Speed of the walk from which it stops [m/s].
    speed: f64,
    /// CPU time of both movements, and of their gains [s].
    made_s: [f64; 2],
    /// Time until it stood [s], distance that the pelvis moved in [`STANDS_S`] [m], and steps after walking off; none
    /// after a fall.
    course: Option<(f64, f64, usize)>,
    /// Whether each of [`PUSHES`] was survived.
    survived: [bool; 4],
    /// Pushes from all sides; none in the plane.
    from_all_sides: Option<FromAllSides>,
}

/// Pushes of a figure that stands, by force ([`FROM_ALL_SIDES`]).
struct FromAllSides {
    /// By force, how many of twice [`SIDES`] are survived with steps and by feedback alone.
    survived: [[usize; 2]; 2],
    /// Most and mean number of foot strikes after a push that is survived with steps, and how far the pelvis is then
    /// from where it was at most [m].
    steps: [(usize, f64, f64); 2],
    /// CPU time per push with steps [s].
    push_s: [f64; 2],
}

/// All figures in the plane, then the man in three dimensions.
pub(super) fn measure(settings: &ControlSettings) -> Result<Vec<Stands>, String> {
    let mut all = Vec::new();
    for build in std::iter::once(&MAN).chain(&BUILDS) {
        let human = build.human().map_err(|e| e.to_string())?;
        let figure = super::figure(build, StandingMovements::speed(&human), 0.0)?;
        all.push(stands(build_name(build), &figure, settings)?);
    }
    for build in [&MAN, &BUILDS[0]] {
        let planar = build.human().map_err(|e| e.to_string())?;
        let figure = spatial::figure_of(build, StandingMovements::speed(&planar), 0.0)?;
        all.push(stands(format!("{}, in three dimensions", build_name(build)), &figure, settings)?);
    }
    Ok(all)
}

fn stands(name: String, figure: &Figure, settings: &ControlSettings) -> Result<Stands, String> {
    let Figure { human, plan } = figure;
    let clock = ThreadTime::now();
    let movements = StandingMovements::find(human, plan).and_then(|found| found.with_steps(human, plan));
    let movements = movements.map_err(|e| e.to_string())?;
    let found_s = clock.elapsed().as_secs_f64();
    let own = controller(figure, settings)?;
    let clock = ThreadTime::now();
    let own =
        own.with_movements(human, plan, &movements, StepSettings::default(), settings).map_err(|e| e.to_string())?;
    let made_s = [found_s, clock.elapsed().as_secs_f64()];
    let Rested { stopped_s, soon, mut walk } = rested(figure, &own)?;
    let from_all_sides = match movements.steps {
        Some(_) => Some(from_all_sides(figure, &[soon, walk.clone()], &own)?),
        None => None,
    };
    let mut survived = [false; 4];
    for (survived, force) in survived.iter_mut().zip(PUSHES) {
        *survived = survives(walk.clone(), human, force)?;
    }
    let place = |walk: &PhysicalWalk| {
        let of = |name: &str| human.model.coordinate(name).map_or(0.0, |id| walk.coordinates()[id.index()][0]);
        Vec3::new(of("pelvis_tx"), of("pelvis_ty"), of("pelvis_tz"))
    };
    let (before, time_s) = (place(&walk), walk.time_s());
    until(&mut walk, time_s + STANDS_S)?;
    let moved = (place(&walk) - before).norm();
    walk.set_speed(plan.speed()).map_err(|e| e.to_string())?;
    let strikes = walk.controller().strikes();
    while walk.controller().strikes() < strikes + STEPS && walk.fall().is_none() && walk.time_s() < 60.0 {
        walk.step().map_err(|e| e.to_string())?;
    }
    let steps = walk.controller().strikes() - strikes;
    let course = walk.fall().is_none().then_some((stopped_s, moved, steps));
    Ok(Stands { name, speed: plan.speed(), made_s, course, survived, from_all_sides })
}

/// A figure after a stop: time until it stood [s], and the figure at both of [`AT_S`].
struct Rested {
    stopped_s: f64,
    soon: PhysicalWalk,
    walk: PhysicalWalk,
}

fn rested(figure: &Figure, own: &WalkController) -> Result<Rested, String> {
    let mut walk = with_controller(figure, own)?;
    until(&mut walk, WALKS_S)?;
    walk.set_speed(0.0).map_err(|e| e.to_string())?;
    while !walk.controller().is_standing() && walk.fall().is_none() && walk.time_s() < WALKS_S + STOPS_S {
        walk.step().map_err(|e| e.to_string())?;
    }
    let stopped_s = walk.time_s() - WALKS_S;
    until(&mut walk, WALKS_S + stopped_s + AT_S[0])?;
    let soon = walk.clone();
    until(&mut walk, WALKS_S + stopped_s + AT_S[1])?;
    Ok(Rested { stopped_s, soon, walk })
}

fn until(walk: &mut PhysicalWalk, time_s: f64) -> Result<(), String> {
    walk.walk_until(time_s).map(|_| ()).map_err(|e| e.to_string())
}

/// Pushes from all sides of a figure at two instants of standing, with steps and by feedback alone.
fn from_all_sides(figure: &Figure, instants: &[PhysicalWalk; 2], own: &WalkController) -> Result<FromAllSides, String> {
    let Rested { soon, walk, .. } = rested(figure, &own.clone().without_recovery_steps())?;
    let alone = [soon, walk];
    let mut all = FromAllSides { survived: [[0; 2]; 2], steps: [(0, 0.0, 0.0); 2], push_s: [0.0; 2] };
    for (k, force) in FROM_ALL_SIDES.into_iter().enumerate() {
        let survived = |instants: &[PhysicalWalk; 2]| {
            let at = instants.iter().flat_map(|walk| (0..SIDES).map(move |side| (walk, side)));
            let after = at.map(|(walk, side)| {
                let angle = std::f64::consts::TAU * side as f64 / SIDES as f64;
                let force = Vec3::new(angle.cos(), 0.0, angle.sin()) * force;
                Ok((walk, pushed(walk.clone(), &figure.human, force, STEPS_FOR_S)?))
            });
            let up = after.filter(|result| result.as_ref().is_ok_and(|(_, after)| after.fall().is_none()));
            up.collect::<Result<Vec<_>, String>>().map(|up| up.into_iter().map(outcome).collect::<Vec<_>>())
        };
        let clock = ThreadTime::now();
        let with = survived(instants)?;
        all.push_s[k] = clock.elapsed().as_secs_f64() / (2 * SIDES) as f64;
        all.survived[k] = [with.len(), survived(&alone)?.len()];
        let strikes = with.iter().map(|(strikes, _)| *strikes);
        let mean = strikes.clone().sum::<usize>() as f64 / with.len().max(1) as f64;
        all.steps[k] = (strikes.max().unwrap_or(0), mean, with.iter().map(|(_, moved)| *moved).fold(0.0, f64::max));
    }
    Ok(all)
}

/// Number of foot strikes after a push, and how far the pelvis has moved [m].
fn outcome((before, after): (&PhysicalWalk, PhysicalWalk)) -> (usize, f64) {
    let moved = after.poses()[0].translation - before.poses()[0].translation;
    (after.controller().strikes() - before.controller().strikes(), moved.x.hypot(moved.z))
}

/// Whether a figure that stands is still up some seconds after a push of its trunk.
fn survives(walk: PhysicalWalk, human: &Human, force: f64) -> Result<bool, String> {
    Ok(pushed(walk, human, Vec3::x() * force, STANDS_S)?.fall().is_none())
}

/// A figure some time [s] after a push of its trunk by a force [N] of 75 kg.
fn pushed(mut walk: PhysicalWalk, human: &Human, force: Vec3, after_s: f64) -> Result<PhysicalWalk, String> {
    let trunk = human.model.body("torso").map_or(0, |id| id.index());
    let (force, time_s) = (force * (human.model.mass() / PUSHED_KG), walk.time_s());
    walk.world_mut().bodies[trunk].load = Wrench { moment: Vec3::zeros(), force };
    until(&mut walk, time_s + PUSH_S)?;
    walk.world_mut().bodies[trunk].load = Wrench::ZERO;
    until(&mut walk, time_s + PUSH_S + after_s)?;
    Ok(walk)
}

pub(super) fn page(all: &[Stands]) -> String {
    let mut table = Table::new(&[
        "figure",
        "stops from [m/s]",
        "stands after [s]",
        &format!("moves in {STANDS_S} s [mm]"),
        &format!("of {STEPS} steps after"),
        "pushes survived in standing [N]",
        "CPU time of movements / of gains [s]",
    ]);
    for Stands { name, speed, made_s: [found_s, gains_s], course, survived, .. } in all {
        let [stopped, moved, steps] = match course {
            Some((stopped_s, moved, steps)) => {
                [format!("{stopped_s:.1}"), format!("{:.1}", 1e3 * moved), steps.to_string()]
            }
            None => ["fell".to_owned(), "".to_owned(), "".to_owned()],
        };
        let pushes: Vec<String> = PUSHES
            .iter()
            .zip(survived)
            .filter(|(_, survived)| **survived)
            .map(|(force, _)| format!("{force:+}"))
            .collect();
        let pushes = if pushes.is_empty() { "none".to_owned() } else { pushes.join(", ") };
        let time = format!("{found_s:.1} / {gains_s:.1}");
        table.row([name.clone(), format!("{speed:.2}"), stopped, moved, steps, pushes, time]);
    }
    let tried = PUSHES.map(|force| format!("{force:+}")).join(", ");
    format!(
        "# Stopping, standing, stepping, walking off\n\nMeasured by `cargo xtask standing --write` on {}. Figures \
         stand by \
         their own torques with the default controller \
         ([PHYSICAL_WALK.md](../PHYSICAL_WALK.md#recovery-steps)).\n\nEach \
         figure walks for {WALKS_S} s, is told to stop, stands, and is told \
         to walk. How far it moves is measured {RESTS_S} s after it stands. Pushes act for \
         {PUSH_S} s on the trunk, forward (+) or backward (-), and grow with mass; {tried} N were tried. In \
         the plane a figure that stands makes no step to keep its balance.\n\n{}\n{}",
        crate::bench::machine(),
        table.text(),
        section_from_all_sides(all)
    )
}

fn section_from_all_sides(all: &[Stands]) -> String {
    let mut table = Table::new(&[
        "figure",
        "push [N, of 75 kg]",
        "survived with steps",
        "by feedback alone",
        "foot strikes, mean and most",
        "moves at most [m]",
        "CPU time per push [s]",
    ]);
    for Stands { name, from_all_sides, .. } in all {
        let Some(FromAllSides { survived, steps, push_s }) = from_all_sides else { continue };
        for (k, force) in FROM_ALL_SIDES.into_iter().enumerate() {
            let [with, alone] = survived[k].map(|count| format!("{count} of {}", 2 * SIDES));
            let (most, mean, moved) = steps[k];
            let strikes = format!("{mean:.1}, {most}");
            let [moved, push_s] = [format!("{moved:.2}"), format!("{:.0}", push_s[k])];
            table.row([name.clone(), format!("{force}"), with, alone, strikes, moved, push_s]);
        }
    }
    format!(
        "## Pushes from eight sides in standing\n\nEach push acts for {PUSH_S} s on the trunk, {} s or {} s after the \
         figure stands; it is survived if the figure is up {STEPS_FOR_S} s later. \
         Feet that were off the ground for less than 0.2 s do not count as strikes. \
         The time at which the figure looks ahead, how far, and the candidates were chosen on pushes of 150 N of this \
         man. The \
         woman played no part.\n\n{}\n",
        AT_S[0],
        AT_S[1],
        table.text()
    )
}
