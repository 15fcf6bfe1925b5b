//! Stopping, standing and walking off.

use super::{BUILDS, Figure, MAN, PUSH_S, PUSHED_KG, controller, spatial, with_controller};
use crate::walk_bands::build_name;
use ambulo::model::anthropometry::Human;
use ambulo::optimal::StandingMovements;
use ambulo::simulation::StepSettings;
use ambulo::simulation::control::{ControlSettings, PhysicalWalk};
use ambulo::spatial::{Vec3, Wrench};
use ambulo::study::validation::TextTable as Table;
use cpu_time::ThreadTime;

/// Time of walking before the figure is told to stop [s], longest time until it stands, time in which it comes to rest,
/// and time of standing after it [s].
const WALKS_S: f64 = 3.0;
const STOPS_S: f64 = 6.0;
const RESTS_S: f64 = 2.0;
const STANDS_S: f64 = 3.0;
/// Steps after walking off.
const STEPS: usize = 20;
/// Forces of pushes in standing [N], of 75 kg.
const PUSHES: [f64; 4] = [50.0, -50.0, 100.0, -100.0];

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
}

/// All figures in the plane, then the man in three dimensions.
pub(super) fn measure(settings: &ControlSettings) -> Result<Vec<Stands>, String> {
    let mut all = Vec::new();
    for build in std::iter::once(&MAN).chain(&BUILDS) {
        let human = build.human().map_err(|e| e.to_string())?;
        let figure = super::figure(build, StandingMovements::speed(&human), 0.0)?;
        all.push(stands(build_name(build), &figure, settings)?);
    }
    let planar: Human = MAN.human().map_err(|e| e.to_string())?;
    let figure = spatial::figure(StandingMovements::speed(&planar), 0.0)?;
    all.push(stands(format!("{}, in three dimensions", build_name(&MAN)), &figure, settings)?);
    Ok(all)
}

fn stands(name: String, figure: &Figure, settings: &ControlSettings) -> Result<Stands, String> {
    let Figure { human, plan } = figure;
    let clock = ThreadTime::now();
    let movements = StandingMovements::find(human, plan).map_err(|e| e.to_string())?;
    let found_s = clock.elapsed().as_secs_f64();
    let own = controller(figure, settings)?;
    let clock = ThreadTime::now();
    let own =
        own.with_movements(human, plan, &movements, StepSettings::default(), settings).map_err(|e| e.to_string())?;
    let made_s = [found_s, clock.elapsed().as_secs_f64()];
    let mut walk = with_controller(figure, &own)?;
    let until = |walk: &mut PhysicalWalk, time_s: f64| walk.walk_until(time_s).map_err(|e| e.to_string());
    until(&mut walk, WALKS_S)?;
    walk.set_speed(0.0).map_err(|e| e.to_string())?;
    while !walk.controller().is_standing() && walk.fall().is_none() && walk.time_s() < WALKS_S + STOPS_S {
        walk.step().map_err(|e| e.to_string())?;
    }
    let stopped_s = walk.time_s() - WALKS_S;
    until(&mut walk, WALKS_S + stopped_s + RESTS_S)?;
    let mut survived = [false; 4];
    for (survived, force) in survived.iter_mut().zip(PUSHES) {
        *survived = survives(walk.clone(), human, force)?;
    }
    let place = |walk: &PhysicalWalk| {
        let of = |name: &str| human.model.coordinate(name).map_or(0.0, |id| walk.coordinates()[id.index()][0]);
        Vec3::new(of("pelvis_tx"), of("pelvis_ty"), of("pelvis_tz"))
    };
    let (rested, time_s) = (place(&walk), walk.time_s());
    until(&mut walk, time_s + STANDS_S)?;
    let moved = (place(&walk) - rested).norm();
    walk.set_speed(plan.speed()).map_err(|e| e.to_string())?;
    let before = walk.controller().strikes();
    while walk.controller().strikes() < before + STEPS && walk.fall().is_none() && walk.time_s() < 60.0 {
        walk.step().map_err(|e| e.to_string())?;
    }
    let steps = walk.controller().strikes() - before;
    let course = walk.fall().is_none().then_some((stopped_s, moved, steps));
    Ok(Stands { name, speed: plan.speed(), made_s, course, survived })
}

/// Whether a figure that stands is still up some seconds after a push of its trunk.
fn survives(mut walk: PhysicalWalk, human: &Human, force: f64) -> Result<bool, String> {
    let trunk = human.model.body("torso").map_or(0, |id| id.index());
    let force = Vec3::x() * (force * human.model.mass() / PUSHED_KG);
    let time_s = walk.time_s();
    walk.world_mut().bodies[trunk].load = Wrench { moment: Vec3::zeros(), force };
    walk.walk_until(time_s + PUSH_S).map_err(|e| e.to_string())?;
    walk.world_mut().bodies[trunk].load = Wrench::ZERO;
    Ok(walk.walk_until(time_s + PUSH_S + STANDS_S).map_err(|e| e.to_string())?.is_none())
}

pub(super) fn section(all: &[Stands]) -> String {
    let mut table = Table::new(&[
        "figure",
        "stops from [m/s]",
        "stands after [s]",
        &format!("moves in {STANDS_S} s [mm]"),
        &format!("of {STEPS} steps after"),
        "pushes survived in standing [N]",
        "CPU time of movements / of gains [s]",
    ]);
    for Stands { name, speed, made_s: [found_s, gains_s], course, survived } in all {
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
        "## Stopping, standing, walking off\n\nEach figure walks for {WALKS_S} s, is told to stop, stands, and is told \
         to walk. How far it moves is measured {RESTS_S} s after it stands. Pushes act for \
         {PUSH_S} s on the trunk, forward (+) or backward (-), and grow with mass; {tried} N were tried. A figure that \
         stands does not step to keep its balance.\n\n{}\n",
        table.text()
    )
}
