//! Predicted walks: nothing in their objective is a curve of people.

use super::curves::{Cycle, QUANTITIES};
use super::{FREE, MAN};
use crate::normative::{Band, SPEEDS, two_laboratories};
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Speed, Walk};
use ambulo::model::anthropometry::Human;
use ambulo::model::full_body::full_body;
use ambulo::model::{Movement, Side};
use ambulo::numerics::correlation;
use ambulo::optimal::{Device, Load, LoadPlace, Observer, OptimalWalk, WalkConditions, metabolic_power};
use ambulo::study::validation::TextTable as Table;
use cpu_time::ThreadTime;

/// Speeds of the curve of cost of transport [m/s].
const TRANSPORT: [f64; 8] = [0.6, 0.8, 0.9, 1.0, 1.1, 1.3, 1.6, 2.0];
/// Cadences, as multiples of the one that people prefer.
const CADENCES: [f64; 5] = [0.86, 0.93, 1.0, 1.07, 1.14];
/// Smallest correlations of curves with people at free speed.
const LEAST: [(&str, f64); 6] = [
    ("hip flexion", 0.90),
    ("knee flexion", 0.90),
    ("ankle dorsiflexion", 0.90),
    ("hip extension moment", 0.80),
    ("knee extension moment", 0.60),
    ("plantarflexion moment", 0.80),
];

/// A predicted walk.
struct Predicted {
    found: OptimalWalk,
    cycle: Cycle,
    power: f64,
    seconds: f64,
    /// Cadence [steps/min].
    cadence: f64,
    /// Positive work of hip, knee and ankle of the right leg in a cycle [J/kg of everything that moves].
    work: [f64; 3],
}

/// Instants of a cycle at which work is summed.
const WORK_INSTANTS: usize = 400;

/// Free walking of a figure with a leg [m] at a speed; without a cadence [steps/s], that of people.
fn gait(leg_length: f64, speed: Speed, cadence: Option<f64>) -> Result<Gait, String> {
    let mut gait = Gait::named("free").map_err(|e| e.to_string())?;
    let speed = match speed {
        Speed::MetersPerSecond(speed) => speed,
        Speed::Dimensionless(speed) => speed * (9.80665 * leg_length).sqrt(),
    };
    gait.pace = gait.pace.with(Some(speed), None, cadence);
    Ok(gait)
}

fn predict(
    human: &Human,
    speed: Speed,
    cadence: Option<f64>,
    conditions: &WalkConditions,
) -> Result<Predicted, String> {
    let walk = Walk::new(
        &gait(human.dimensions.leg_length, speed, cadence)?,
        human.dimensions.leg_length,
        &mut Findings::default(),
    )
    .map_err(|e| e.to_string())?;
    let clock = ThreadTime::now();
    let (found, walk) = if conditions.free_cadence {
        OptimalWalk::predict_freely(&MAN, &walk, conditions, &Observer::default())
    } else {
        OptimalWalk::predict(&MAN, &walk, conditions).map(|found| (found, walk))
    }
    .map_err(|e| e.to_string())?;
    let seconds = clock.elapsed().as_secs_f64();
    let cycle = Cycle::of(&found.human, &walk, &found.problem, &found.solution)?;
    let power = power(&found, &walk)?;
    let (cadence, work) = (120.0 / walk.cycle_s(), work(&found, &walk)?);
    Ok(Predicted { found, cycle, power, seconds, cadence, work })
}

fn work(found: &OptimalWalk, walk: &Walk) -> Result<[f64; 3], String> {
    let step_s = walk.cycle_s() / WORK_INSTANTS as f64;
    let times: Vec<f64> = (0..WORK_INSTANTS).map(|k| step_s * k as f64).collect();
    let samples = found.solution.samples(&times).map_err(|e| e.to_string())?;
    let anatomy = found.human.model.anatomy();
    let of = |movement: Movement| {
        let Some((id, _)) = anatomy.coordinate(movement, Some(Side::Right)) else { return f64::NAN };
        let powers = samples.iter().map(|at| (at.forces[id.index()] * at.posture[1][id.index()]).max(0.0));
        powers.sum::<f64>() * step_s / found.human.model.mass()
    };
    Ok([Movement::HipFlexion, Movement::KneeFlexion, Movement::AnkleDorsiflexion].map(of))
}

fn power(found: &OptimalWalk, walk: &Walk) -> Result<f64, String> {
    metabolic_power(&found.solution, walk, MAN.mass, &found.conditions.devices).map_err(|e| e.to_string())
}

/// The section of the page.
pub(super) fn section(people: &[Vec<Band>; 5]) -> Result<String, String> {
    let human = full_body(&MAN).map_err(|e| e.to_string())?;
    Ok(format!(
        "`ambulo walk --mode predict`: metabolic power, activations of muscles and rates of moments are minimised; no \
         curve of people is a\n\
         target (docs/OPTIMAL.md). The solver starts from the walk that follows people. Weights were set by hand on \
         free walking of the main figure with\n\
         the first laboratory; then the others were looked at, and nothing was changed.\n\n{}\n{}\n{}\n{}",
        speeds(&human, people)?,
        transport(&human)?,
        cadences(&human)?,
        conditions(&human)?
    ))
}

fn speeds(human: &Human, people: &[Vec<Band>; 5]) -> Result<String, String> {
    let mut walks = Vec::new();
    for speed in SPEEDS {
        walks.push(predict(human, Speed::Dimensionless(speed), None, &WalkConditions::default())?);
    }
    let mut table = Table::new(&[
        "curve, r with people",
        "criterion, free",
        "very slow",
        "slow",
        "free",
        "fast",
        "very fast",
        "second laboratory, free",
    ]);
    for (k, quantity) in QUANTITIES.iter().enumerate() {
        let asked = LEAST.iter().find(|(name, _)| *name == quantity.name).map(|(_, least)| *least);
        let r: Vec<f64> = (0..5).map(|s| correlation(&walks[s].cycle.curves[k], &people[s][k].mean)).collect();
        let missed = if asked.is_some_and(|least| r[FREE] < least) { " **missed**" } else { "" };
        let [a, b, c, d, e] = std::array::from_fn(|s| format!("{:.3}{}", r[s], if s == FREE { missed } else { "" }));
        let second = match quantity.second {
            Some(name) => format!("{:.3}", correlation(&walks[FREE].cycle.curves[k], &two_laboratories(name)?[1])),
            None => String::new(),
        };
        let asked = asked.map_or_else(String::new, |least| format!(">= {least:.2}"));
        table.row([quantity.name.to_owned(), asked, a, b, c, d, e, second]);
    }
    let hump = |walk: &Predicted| peaks(walk).map(|value| format!("{value:.2}")).join(" / ");
    let [first, valley, second] = peaks(&walks[FREE]);
    let met = (1.0..=1.25).contains(&first) && valley < first.min(second);
    let [a, b, mut c, d, e] = std::array::from_fn(|s| hump(&walks[s]));
    if !met {
        c.push_str(" **missed**");
    }
    let criterion = "two humps, first 1.0 to 1.25".to_owned();
    table.row(["vertical force, humps and valley [BW]".to_owned(), criterion, a, b, c, d, e, String::new()]);
    let [a, b, c, d, e] = std::array::from_fn(|s| format!("{:.1}", walks[s].seconds));
    table.row(["CPU time, with the walk of people [s]".to_owned(), String::new(), a, b, c, d, e, String::new()]);
    let root = |s: usize| walks[s].found.solution.progress.last().map_or(f64::NAN, |last| last.root.1);
    let [a, b, c, d, e] = std::array::from_fn(|s| format!("{:.0e}", root(s)));
    table.row([
        "largest force at the root [BW, BW x leg]".to_owned(),
        "<= 1e-4".to_owned(),
        a,
        b,
        c,
        d,
        e,
        String::new(),
    ]);
    Ok(table.text())
}

/// Humps of the vertical force, and the valley between them [weights of everything that moves].
fn peaks(walk: &Predicted) -> [f64; 3] {
    let force = walk.cycle.curves.iter().zip(QUANTITIES).find(|(_, q)| q.name == "vertical force").map(|(c, _)| c);
    let stance: Vec<f64> = force.into_iter().flatten().copied().collect();
    let (first, last) = stance.split_at(stance.len() * 3 / 10);
    let largest = |part: &[f64]| part.iter().copied().fold(0.0, f64::max);
    let valley = stance[stance.len() / 5..stance.len() * 2 / 5].iter().copied().fold(f64::INFINITY, f64::min);
    [largest(first), valley, largest(last)]
}

fn transport(human: &Human) -> Result<String, String> {
    let mut table = Table::new(&["speed [m/s]", "predicted [J/kg/m]", "following people [J/kg/m]"]);
    let mut curve = Vec::new();
    for speed in TRANSPORT {
        let own = predict(human, Speed::MetersPerSecond(speed), None, &WalkConditions::default())?;
        let walk = Walk::new(
            &gait(human.dimensions.leg_length, Speed::MetersPerSecond(speed), None)?,
            human.dimensions.leg_length,
            &mut Findings::default(),
        )
        .map_err(|e| e.to_string())?;
        let people = OptimalWalk::find(&MAN, &walk).map_err(|e| e.to_string())?;
        let people = power(&people, &walk)? / speed;
        curve.push((speed, own.power / speed));
        table.row([format!("{speed:.1}"), format!("{:.2}", own.power / speed), format!("{people:.2}")]);
    }
    let best = curve.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1)).map_or(f64::NAN, |(speed, _)| speed);
    let missed = if (0.85..=1.3).contains(&best) { "" } else { " **missed**" };
    Ok(format!(
        "**Cost of transport**: (positive joint work / 0.25 + negative joint work / 1.2) per time + 1.4 W/kg, per \
         distance, of predicted walks and of\n\
         those that follow people. The smallest of these is at {best:.1} m/s (criterion: 0.85 to 1.3){missed}.\n\n{}",
        table.text()
    ))
}

fn cadences(human: &Human) -> Result<String, String> {
    let speed = Speed::Dimensionless(SPEEDS[FREE]);
    let walk = Walk::new(
        &gait(human.dimensions.leg_length, speed, None)?,
        human.dimensions.leg_length,
        &mut Findings::default(),
    )
    .map_err(|e| e.to_string())?;
    let preferred = 2.0 / walk.cycle_s();
    let mut table = Table::new(&["cadence / people's", "cost", "cost of transport [J/kg/m]"]);
    let mut costs = Vec::new();
    for share in CADENCES {
        let found = predict(human, speed, Some(share * preferred), &WalkConditions::default())?;
        let cost = found.found.solution.progress.last().map_or(f64::NAN, |last| last.cost);
        costs.push((share, cost));
        table.row([format!("{share:.2}"), format!("{cost:.2}"), format!("{:.2}", found.power / walk.speed())]);
    }
    let best = vertex(&costs);
    let missed = if (best - 1.0).abs() <= 0.1 { "" } else { " **missed**" };
    Ok(format!(
        "**Cadence** at free speed: the parabola through the costs has its vertex at {best:.3} of people's cadence \
         (criterion: 0.9 to 1.1){missed}.\n\n{}",
        table.text()
    ))
}

/// Vertex of the least-squares parabola through points.
fn vertex(points: &[(f64, f64)]) -> f64 {
    let middle = 1.0;
    let sum = |power: i32| points.iter().map(|(x, _)| (x - middle).powi(power)).sum::<f64>();
    let with = |power: i32| points.iter().map(|(x, y)| (x - middle).powi(power) * y).sum::<f64>();
    // The points lie symmetrically about the middle, so that odd sums vanish.
    let (n, s2, s4) = (points.len() as f64, sum(2), sum(4));
    let slope = with(1) / s2;
    let curvature = (with(2) - s2 * with(0) / n) / (s4 - s2 * s2 / n);
    middle - slope / (2.0 * curvature)
}

fn conditions(human: &Human) -> Result<String, String> {
    let level = WalkConditions::default;
    let weak = |side: &str| (format!("ankle_angle_{side}"), 0.5);
    let spring = |side: &str| Device {
        coordinate: format!("ankle_angle_{side}"),
        stiffness: 100.0,
        rest: 0.0,
        damping: 0.0,
        moments: Vec::new(),
    };
    let load = Some(Load { mass: 15.0, place: LoadPlace::Back });
    let all = [
        ("level", level()),
        ("8 % uphill", WalkConditions { slope: 0.08, ..level() }),
        ("8 % downhill", WalkConditions { slope: -0.08, ..level() }),
        ("15 kg on the back", WalkConditions { load, ..level() }),
        ("half the strength of both ankles", WalkConditions { strengths: vec![weak("r"), weak("l")], ..level() }),
        ("half the strength of the right ankle", WalkConditions { strengths: vec![weak("r")], ..level() }),
        (
            "springs of 100 N.m/rad at both ankles",
            WalkConditions { devices: vec![spring("r"), spring("l")], ..level() },
        ),
        ("level, free cadence", WalkConditions { free_cadence: true, ..level() }),
        ("8 % uphill, free cadence", WalkConditions { slope: 0.08, free_cadence: true, ..level() }),
        ("15 kg on the back, free cadence", WalkConditions { load, free_cadence: true, ..level() }),
    ];
    let moments = ["hip extension moment", "knee extension moment", "plantarflexion moment"];
    let mut table = Table::new(&[
        "condition",
        "hip [N.m/kg]",
        "knee [N.m/kg]",
        "ankle [N.m/kg]",
        "positive work [J/kg]: hip, knee, ankle",
        "first hump [BW]",
        "cadence [steps/min]",
        "metabolic power [W/kg]",
        "CPU [s]",
    ]);
    for (name, conditions) in all {
        let found = predict(human, Speed::Dimensionless(SPEEDS[FREE]), None, &conditions)?;
        let peak = |of: &str| {
            let curve = QUANTITIES.iter().position(|q| q.name == of).map(|k| &found.cycle.curves[k]);
            format!("{:.2}", curve.into_iter().flatten().copied().fold(f64::MIN, f64::max))
        };
        let [hip, knee, ankle] = moments.map(peak);
        let work = found.work.map(|work| format!("{work:.3}")).join(", ");
        let hump = format!("{:.2}", peaks(&found)[0] * found.found.human.model.mass() / MAN.mass);
        let [cadence, power] = [format!("{:.1}", found.cadence), format!("{:.2}", found.power)];
        let seconds = format!("{:.1}", found.seconds);
        table.row([name.to_owned(), hip, knee, ankle, work, hump, cadence, power, seconds]);
    }
    Ok(format!(
        "**Conditions** at free speed: largest extension moments and positive work of the right leg in a cycle, per \
         kilogram that moves; first hump\n\
         of the vertical force, in weights of the body alone; metabolic power per kilogram of the body.\n\n{}",
        table.text()
    ))
}
