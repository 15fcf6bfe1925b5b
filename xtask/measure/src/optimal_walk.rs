//! Walks in three dimensions, found by optimal motion, next to healthy people: `cargo xtask optimal-walk [--speed NAME]... [--set COST=VALUE]...`.

mod curves;

use crate::normative::{self, NAMES, SPEEDS};
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Speed, Walk};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::optimal::{Continuation, STAGES, WalkCosts, WalkProblem, soles_with_width};
use ambulo::reproduction::correlation;
use ambulo::simulation::consistent_walk::SOFT_SHOES;
use cpu_time::ThreadTime;
use curves::{Cycle, QUANTITIES};

const MAN: Build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };

/// Runs the command.
#[expect(clippy::print_stdout, reason = "the table is the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let mut costs = WalkCosts::default();
    let mut speeds: Vec<usize> = Vec::new();
    let mut curves = false;
    let mut stages = STAGES.to_vec();
    let mut words = words.iter();
    while let Some(word) = words.next() {
        let mut value = || words.next().ok_or_else(|| format!("{word} needs a value"));
        match word.as_str() {
            "--curves" => curves = true,
            "--speed" => {
                let name = value()?;
                speeds.push(NAMES.iter().position(|n| n == name).ok_or_else(|| format!("no speed `{name}`"))?);
            }
            "--set" => {
                let (key, number) = value()?.split_once('=').ok_or("KEY=VALUE")?;
                if key == "s" {
                    stages.truncate(5);
                    let st = stages[4];
                    for x in number.split(',') { let (a, u) = x.split_once(':').unwrap(); stages.push(Continuation { creep: 1.0, slack: a.parse().unwrap(), updates: u.parse().unwrap(), steps: 30, ..st }); }
                    continue;
                }
                set(&mut costs, key, number.parse().map_err(|e| format!("{number}: {e}"))?)?;
            }
            _ => return Err(format!("unknown option `{word}`")),
        }
    }
    if speeds.is_empty() { speeds = (0..5).collect(); }
    let legs = crate::walk_bands::child_leg::legs()?;
    let human = full_body(&MAN).map_err(|e| e.to_string())?;
    let people = curves::people(human.dimensions.leg_length, legs[0].mean())?;
    for i in speeds {
        let mut gait = Gait::named("free").map_err(|e| e.to_string())?;
        gait.pace.speed = Some(Speed::Dimensionless(SPEEDS[i]));
        let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).map_err(|e| e.to_string())?;
        let problem = WalkProblem::new(&human, &soles_with_width(&human), SOFT_SHOES, &walk, &costs).map_err(|e| e.to_string())?;
        let start = ThreadTime::now();
        let solution = problem.solve(&stages).map_err(|e| e.to_string())?;
        let seconds = start.elapsed().as_secs_f64();
        let steps: usize = solution.progress.iter().map(|p| p.steps).sum();
        let last = solution.progress.last().ok_or("no stages")?;
        let finer = solution.root_forces(10).map_err(|e| e.to_string())?;
        println!("\n{} {:.2} m/s: {seconds:.2} s, {steps} steps, cost {:.3}, root {:.1e} {:.1e}, between {:.1e} {:.1e}", NAMES[i], walk.speed(), last.cost, last.root.0, last.root.1, finer.0, finer.1);
        let start = ThreadTime::now();
        let drift = [1e-3, 5e-4, 2e-4].map(|h| solution.forward(walk.cycle_s(), h).unwrap());
        println!("drift {:?} {:.2} s", drift.map(|d| (1e3 * d.place_m, d.angle_rad.to_degrees())), start.elapsed().as_secs_f64());
        let cycle = Cycle::of(&human, &walk, &problem, &solution)?;
        for (k, quantity) in QUANTITIES.iter().enumerate() {
            let (ours, band) = (&cycle.curves[k], &people[i][k]);
            let inside = ours.iter().zip(&band.mean).zip(&band.sd).filter(|((v, m), sd)| (*v - *m).abs() <= 2.0 * *sd).count();
            let range = |c: &[f64]| c.iter().copied().fold(f64::MIN, f64::max) - c.iter().copied().fold(f64::MAX, f64::min);
            let rms = (ours.iter().zip(&band.mean).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / ours.len() as f64).sqrt();
            let second = match quantity.second { Some(name) if i == 2 => format!("second {:.3}", correlation(ours, &normative::two_laboratories(name)?[1])), _ => String::new() };
            println!("{:24} r {:.3}  inside {:3.0} %  rms {rms:.3}  range {:.2} of {:.2}  {second}", quantity.name, correlation(ours, &band.mean), 100.0 * inside as f64 / ours.len() as f64, range(ours), range(&band.mean));
            if curves {
                let show = |c: &[f64]| c.iter().step_by(2).map(|v| format!("{v:6.2}")).collect::<String>();
                println!("  ours   {}\n  people {}", show(ours), show(&band.mean));
            }
        }
        let show = |c: &[f64]| c.iter().step_by(2).map(|v| format!("{v:6.3}")).collect::<String>();
        println!("sideways         {}", show(&cycle.sideways));
        for (n, c) in &cycle.extra { println!("{n:16} {}", c.iter().step_by(2).map(|v| format!("{v:6.2}")).collect::<String>()); }
    }
    Ok(())
}

fn set(costs: &mut WalkCosts, key: &str, value: f64) -> Result<(), String> {
    match key {
        "knots" => costs.knots = value as usize,
        "per_knot" => costs.per_knot = value as usize,
        "hip" => costs.hip = value.to_radians(),
        "knee" => costs.knee = value.to_radians(),
        "ankle" => costs.ankle = value.to_radians(),
        "plane" => costs.plane = value.to_radians(),
        "acceleration" => costs.acceleration = value,
        "moment_rate" => costs.moment_rate = value,
        "moment" => costs.moment = value,
        "slip" => costs.slip = value,
        "force" => costs.force = costs.force.map(|f| f * value),
        _ => return Err(format!("no cost `{key}`")),
    }
    Ok(())
}
