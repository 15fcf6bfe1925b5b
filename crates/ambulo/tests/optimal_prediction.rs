//! Predicted walks: nothing holds the body, work becomes height and losses, and muscles, loads, slopes and devices
//! change what they should.

use ambulo::contact::HuntCrossley;
use ambulo::findings::Findings;
use ambulo::gait::{Gait, JointMomentLaws, Walk};
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::model::{Movement, Side};
use ambulo::numerics::correlation;
use ambulo::optimal::{
    Bound, Continuation, Device, ECCENTRIC, EffortCosts, Load, LoadPlace, NO_ROOT_FORCE, Observer, OptimalWalk,
    OptimalWalkError, Prediction, Quantity, STAGES, Solution, Span, StrengthCurve, Term, WalkConditions, WalkCosts,
    WalkProblem, metabolic_power,
};
use std::sync::LazyLock;

const MAN: Build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };

/// The planar figure, and its walk that follows people.
struct Start {
    human: Human,
    walk: Walk,
    problem: WalkProblem,
    unknowns: Vec<f64>,
}

fn walk_of(human: &Human) -> Walk {
    Walk::new(&Gait::named("free").unwrap(), human.dimensions.leg_length, &mut Findings::default()).unwrap()
}

fn start(span: Span) -> Start {
    let human = MAN.human().unwrap();
    let walk = walk_of(&human);
    let costs = WalkCosts { knots: 24, force: [0.02, 0.04], slip: 0.02, slip_exponent: 0.0, ..WalkCosts::default() };
    let shoes = HuntCrossley::SOFT_SHOES;
    let problem = WalkProblem::over(span, &human, &human.soles, shoes, &walk, &costs).unwrap();
    let unknowns = problem.solve(&STAGES).unwrap().unknowns().to_vec();
    Start { human, walk, problem, unknowns }
}

static MIRRORED: LazyLock<Start> = LazyLock::new(|| start(Span::MirroredHalfCycle));
static LEVEL: LazyLock<Predicted> = LazyLock::new(|| MIRRORED.predict(&WalkConditions::default()));

/// The predicted walk in three dimensions.
static SPATIAL: LazyLock<(Walk, OptimalWalk)> = LazyLock::new(|| {
    let walk = walk_of(&ambulo::model::full_body::full_body(&MAN).unwrap());
    let found = OptimalWalk::predict(&MAN, &walk, &WalkConditions::default()).unwrap();
    (walk, found)
});

struct Predicted {
    human: Human,
    solution: Solution,
    found: Prediction,
}

impl Start {
    fn predict(&self, conditions: &WalkConditions) -> Predicted {
        let human = conditions.figure(&self.human).unwrap();
        let costs = EffortCosts::default();
        let found = self.problem.predict(&human, &self.walk, &costs, conditions, &self.unknowns).unwrap();
        Predicted { human, solution: found.solution.clone(), found }
    }
}

impl Predicted {
    /// A value of all instants of a cycle.
    fn over_cycle(&self, value: impl Fn(&ambulo::optimal::Sample) -> f64) -> Vec<f64> {
        let times: Vec<f64> = (0..100).map(|k| MIRRORED.walk.cycle_s() * f64::from(k) / 100.0).collect();
        self.solution.samples(&times).unwrap().iter().map(value).collect()
    }

    /// Extension moments at a joint, over a cycle of the right leg [N.m].
    fn moments(&self, movement: Movement, side: Side) -> Vec<f64> {
        let (id, sign) = self.human.model.anatomy().coordinate(movement, Some(side)).unwrap();
        self.over_cycle(|sample| -sign * sample.forces[id.index()])
    }

    fn largest_moment(&self, movement: Movement, side: Side) -> f64 {
        self.moments(movement, side).into_iter().fold(f64::MIN, f64::max)
    }

    fn root(&self) -> f64 {
        self.solution.progress.last().unwrap().root.1
    }
}

/// Curves of people are in no cost of this walk.
/// Without normative curves, joints keep both of their limits, and slip has the cost of muscles.
#[test]
fn a_prediction_keeps_both_limits_of_a_joint_and_has_its_own_cost_of_slip() {
    let start = &*MIRRORED;
    let costs = EffortCosts { slip: 0.03, ..EffortCosts::default() };
    let next = start.problem.of_muscles(&start.human, &start.walk, &costs, &WalkConditions::default(), 0.0);
    let count = |of: &WalkProblem, bound: Bound| -> usize {
        let is_range = |term: &&Term| term.name.starts_with("range of") && term.bound == bound;
        of.problem.terms.iter().filter(is_range).count()
    };
    for bound in [Bound::AtLeast, Bound::AtMost] {
        assert!(count(&next, bound) > 0);
        assert_eq!(count(&next, bound), count(&start.problem, bound), "{bound:?}");
    }
    let slips = next.problem.terms.iter().filter(|term| matches!(term.quantity, Quantity::Slip { .. }));
    let deviations: Vec<f64> = slips.map(|term| term.deviation).collect();
    assert!(
        !deviations.is_empty() && deviations.iter().all(|deviation| (deviation - costs.slip).abs() < 1e-12),
        "{deviations:?}"
    );
}

#[test]
fn a_walk_of_lazy_muscles_is_that_of_people() {
    let (walk, found) = &*SPATIAL;
    let times: Vec<f64> = (0..100).map(|k| walk.cycle_s() * f64::from(k) / 100.0).collect();
    let people = OptimalWalk::find(&MAN, walk).unwrap().problem;
    let people = people.problem.at(&people.guess).unwrap().samples(&times).unwrap();
    let samples = found.solution.samples(&times).unwrap();
    let laws = JointMomentLaws::built_in().unwrap();
    type Part = fn(&ambulo::gait::JointMoments) -> f64;
    let joints: [(Movement, f64, f64, Part); 3] = [
        (Movement::HipFlexion, 0.9, 0.8, |m| m.hip_extension),
        (Movement::KneeFlexion, 0.9, 0.6, |m| m.knee_extension),
        (Movement::AnkleDorsiflexion, 0.9, 0.8, |m| m.plantarflexion),
    ];
    for (movement, angle, moment, part) in joints {
        let (id, sign) = found.human.model.anatomy().coordinate(movement, Some(Side::Right)).unwrap();
        let curve = |of: &[ambulo::optimal::Sample]| -> Vec<f64> {
            of.iter().map(|sample| sign * sample.posture[0][id.index()]).collect()
        };
        let angles = correlation(&curve(&samples), &curve(&people));
        let law: Vec<f64> =
            (0..100).map(|k| part(&laws.at(f64::from(k) / 100.0, walk.dimensionless_speed()))).collect();
        let own: Vec<f64> = samples.iter().map(|sample| -sign * sample.forces[id.index()]).collect();
        let moments = correlation(&own, &law);
        println!("{movement:?}: angle r {angles:.3}, moment r {moments:.3}");
        assert!(angles > angle && moments > moment, "{movement:?}: {angles} and {moments}");
    }
}

#[test]
fn work_becomes_height_and_losses() {
    for slope in [-0.06, 0.0, 0.06] {
        let conditions = WalkConditions { slope, ..WalkConditions::default() };
        let load = (slope > 0.0).then_some(Load { mass: 10.0, place: LoadPlace::Back });
        let predicted = MIRRORED.predict(&WalkConditions { load, ..conditions.clone() });
        assert!(predicted.root() < NO_ROOT_FORCE, "{slope}: {}", predicted.root());
        const STEPS: usize = 4000;
        let cycle_s = MIRRORED.walk.cycle_s();
        let dt = cycle_s / STEPS as f64;
        let times: Vec<f64> = (0..=STEPS).map(|k| dt * k as f64).collect();
        let samples = predicted.solution.samples(&times).unwrap();
        let (mut work, mut lost) = (0.0, 0.0);
        for pair in samples.windows(2) {
            work += pair[0].forces.iter().zip(&pair[0].posture[1]).map(|(force, rate)| force * rate * dt).sum::<f64>();
            for (before, after) in pair[0].contacts.iter().zip(&pair[1].contacts) {
                let slides = before.force.x * before.slip[0] + before.force.z * before.slip[1];
                let sinks = 0.5 * (before.force.y + after.force.y) * (after.height_m - before.height_m);
                lost -= slides * dt + sinks;
            }
        }
        let weight = predicted.human.model.mass() * predicted.human.model.gravity().norm();
        let height = conditions.incline().sin() * MIRRORED.walk.speed() * cycle_s;
        println!("slope {slope}: work {work:.2} J, height {:.2} J, lost {lost:.2} J", weight * height);
        let positive = weight * height.abs() + lost;
        assert!(lost > 0.0 && (work - weight * height - lost).abs() < 0.01 * positive, "{work} J");
    }
}

/// Uphill, plantarflexors and hip extensors work more; downhill, knee extensors have to hold more (Lay, Hass, Gregor
/// 2006, J Biomech 39:1621; McIntosh, Beatty, Dwan, Vickers 2006, J Biomech 39:2491; unverified).
#[test]
fn slopes_and_loads_change_moments_as_in_people() {
    let on = |slope: f64| MIRRORED.predict(&WalkConditions { slope, ..WalkConditions::default() });
    let (up, down) = (on(0.08), on(-0.08));
    let mean_power = |of: &Predicted, movement: Movement| -> f64 {
        let (id, _) = of.human.model.anatomy().coordinate(movement, Some(Side::Right)).unwrap();
        of.over_cycle(|s| s.forces[id.index()] * s.posture[1][id.index()]).iter().sum()
    };
    for movement in [Movement::HipFlexion, Movement::AnkleDorsiflexion] {
        let [below, level, above] = [&down, &*LEVEL, &up].map(|of| mean_power(of, movement));
        assert!(below < level && level < above, "{movement:?}: {below}, {level}, {above}");
    }
    let knee = |of: &Predicted| of.largest_moment(Movement::KneeFlexion, Side::Right);
    assert!(knee(&down) > knee(&LEVEL), "{} and {} N.m", knee(&down), knee(&LEVEL));

    let load = Some(Load { mass: 20.0, place: LoadPlace::Pelvis });
    let loaded = MIRRORED.predict(&WalkConditions { load, ..WalkConditions::default() });
    let ankle = |of: &Predicted| of.largest_moment(Movement::AnkleDorsiflexion, Side::Right);
    assert!(ankle(&loaded) > 1.1 * ankle(&LEVEL), "{} and {} N.m", ankle(&loaded), ankle(&LEVEL));
}

#[test]
fn springs_at_the_ankles_take_moment_from_the_muscles() {
    let device = |side: &str| Device {
        coordinate: format!("ankle_angle_{side}"),
        stiffness: 100.0,
        rest: 0.0,
        damping: 0.0,
        moments: Vec::new(),
    };
    let devices = vec![device("r"), device("l")];
    let assisted = MIRRORED.predict(&WalkConditions { devices: devices.clone(), ..WalkConditions::default() });
    let muscles = |of: &Predicted, devices: &[Device]| {
        let (id, _) = of.human.model.anatomy().coordinate(Movement::AnkleDorsiflexion, Some(Side::Right)).unwrap();
        let own = of.over_cycle(|s| {
            let spring = devices.first().map_or(0.0, |d| d.moment(0.0, s.posture[0][id.index()], 0.0));
            s.forces[id.index()] - spring
        });
        (own.iter().map(|moment| moment * moment).sum::<f64>() / own.len() as f64).sqrt()
    };
    let (with, without) = (muscles(&assisted, &devices), muscles(&LEVEL, &[]));
    println!("muscle moment {with:.1} N.m rms with springs, {without:.1} without");
    assert!(with < 0.9 * without);
    let power = metabolic_power(&assisted.solution, &MIRRORED.walk, MAN.mass, &devices).unwrap();
    assert!((2.0..15.0).contains(&power), "{power} W/kg");
    assert!(assisted.root() < NO_ROOT_FORCE);
}

#[test]
fn a_given_moment_repeats_with_the_cycle_of_its_leg() {
    let device = Device {
        coordinate: "ankle_angle_r".to_owned(),
        stiffness: 10.0,
        rest: 0.1,
        damping: 2.0,
        moments: vec![0.0, 8.0, 4.0, 0.0],
    };
    for (share, given) in [(0.0, 0.0), (0.125, 4.0), (0.25, 8.0), (0.375, 6.0), (0.875, 0.0), (1.25, 8.0), (-0.75, 8.0)]
    {
        let found = device.moment(share, 0.3, 0.5);
        assert!((found - (given - 10.0 * 0.2 - 2.0 * 0.5)).abs() < 1e-12, "{share}: {found}");
    }
}

#[test]
fn a_weak_leg_does_less_than_the_other() {
    let whole = start(Span::Cycle);
    let strengths = vec![("ankle_angle_r".to_owned(), 0.3)];
    let weak = whole.predict(&WalkConditions { strengths, ..WalkConditions::default() });
    let peak = |side: Side| weak.largest_moment(Movement::AnkleDorsiflexion, side);
    println!("{:.1} N.m at the weak ankle, {:.1} at the other", peak(Side::Right), peak(Side::Left));
    assert!(peak(Side::Right) < 0.9 * peak(Side::Left));
    assert!(weak.root() < NO_ROOT_FORCE, "{}", weak.root());
    assert!(weak.found.solution.overload(0.05).is_none(), "{:?}", weak.found.solution.overload(0.05));
}

/// With half of their strength, both ankles push off with less work and the hips do more; no joint has a moment above
/// what its muscles can do at this angle and speed, by the table that the verdict uses.
#[test]
fn weak_ankles_push_less_and_hips_work_more() {
    const SHARE: f64 = 0.5;
    let (walk, level) = &*SPATIAL;
    let strengths = ["ankle_angle_r", "ankle_angle_l"].map(|name| (name.to_owned(), SHARE)).to_vec();
    let conditions = WalkConditions { strengths, ..WalkConditions::default() };
    let weak = OptimalWalk::predict(&MAN, walk, &conditions).unwrap();
    let times: Vec<f64> = (0..200).map(|k| walk.cycle_s() * f64::from(k) / 200.0).collect();
    let joint = |movement: Movement| weak.human.model.anatomy().coordinate(movement, Some(Side::Right)).unwrap();
    let work = |of: &OptimalWalk, movement: Movement| {
        let c = joint(movement).0.index();
        let samples = of.solution.samples(&times).unwrap();
        samples.iter().map(|s| (s.forces[c] * s.posture[1][c]).max(0.0)).sum::<f64>() * walk.cycle_s() / 200.0
    };
    for (movement, is_more) in [(Movement::AnkleDorsiflexion, false), (Movement::HipFlexion, true)] {
        let [with, without] = [work(&weak, movement), work(level, movement)];
        println!("{movement:?}: {with:.1} J with half the strength, {without:.1} J without");
        assert!(if is_more { with > 1.03 * without } else { with < 0.9 * without }, "{with} and {without}");
    }
    let (id, sign) = joint(Movement::AnkleDorsiflexion);
    let curve = StrengthCurve::built_in(Movement::AnkleDorsiflexion, MAN.mass, MAN.height).unwrap();
    let share = |s: &ambulo::optimal::Sample| {
        let [angle, rate, moment] = [&s.posture[0], &s.posture[1], &s.forces].map(|values| sign * values[id.index()]);
        moment.abs() / (SHARE * curve.available(angle, rate, moment, ECCENTRIC))
    };
    let most = weak.solution.samples(&times).unwrap().iter().map(share).fold(0.0, f64::max);
    println!("at most {:.0} % of the strength that is left", 100.0 * most);
    assert!((0.8..1.1).contains(&most), "{most}");
}

/// The cadence of the least cost is near that of people (109.8 steps/min at this speed), and it costs no more.
#[test]
fn a_free_cadence_is_near_that_of_people_and_costs_no_more() {
    let (walk, usual) = &*SPATIAL;
    let conditions = WalkConditions { free_cadence: true, ..WalkConditions::default() };
    let (free, own) = OptimalWalk::predict_freely(&MAN, walk, &conditions, &Observer::default()).unwrap();
    // The usual cadence gets as many steps of the solver.
    let further = [(2, 0.0002), (6, 0.00003)].map(|(updates, slack)| Continuation {
        stiffness: 1.0,
        creep: 1.0,
        slip: 1.0,
        slack,
        updates,
        steps: 30,
        gain: 1e-4,
    });
    let usual = usual.problem.problem.solve(usual.solution.unknowns(), &further).unwrap();
    let cost = |of: &Solution| of.progress.last().unwrap().cost;
    let (free, usual) = (cost(&free.solution), cost(&usual));
    let share = walk.cycle_s() / own.cycle_s();
    println!("{share:.3} of the cadence of people, cost {free:.2} instead of {usual:.2}");
    assert!((own.speed() - walk.speed()).abs() < 1e-12);
    assert!((0.95..=1.05).contains(&share) && (share - 1.0).abs() > 1e-6, "{share}");
    assert!(free < usual, "{free} and {usual}");
}

#[test]
fn conditions_of_equal_sides_are_symmetric() {
    let strengths = |of: &[(&str, f64)]| WalkConditions {
        strengths: of.iter().map(|(name, share)| ((*name).to_owned(), *share)).collect(),
        ..WalkConditions::default()
    };
    assert!(WalkConditions::default().is_symmetric());
    assert!(strengths(&[("knee_angle_r", 0.5), ("knee_angle_l", 0.5), ("lumbar_extension", 0.8)]).is_symmetric());
    assert!(!strengths(&[("knee_angle_r", 0.5)]).is_symmetric());
    assert!(!strengths(&[("knee_angle_r", 0.5), ("knee_angle_l", 0.6)]).is_symmetric());
    let devices =
        |text: &str| WalkConditions { devices: Device::from_toml(text).unwrap(), ..WalkConditions::default() };
    let one = "[[device]]\njoint = \"ankle_angle_r\"\nstiffness = 20\n";
    assert!(!devices(one).is_symmetric());
    assert!(devices(&format!("{one}{}", one.replace("_r", "_l"))).is_symmetric());
}

#[test]
fn conditions_out_of_range_say_what_is_allowed() {
    let human = ambulo::model::full_body::full_body(&MAN).unwrap();
    let walk = walk_of(&human);
    let refused = |conditions: WalkConditions| OptimalWalk::predict(&MAN, &walk, &conditions).unwrap_err().to_string();
    let level = WalkConditions::default;
    assert!(refused(WalkConditions { slope: 1.0, ..level() }).contains("slope [%] of 100; expected -40 to 40"));
    assert!(refused(WalkConditions { slope: f64::NAN, ..level() }).contains("slope"));
    assert!(refused(WalkConditions { step_width_m: Some(2.0), ..level() }).contains("expected 0 to 0.5 m"));
    let load = Some(Load { mass: -1.0, place: LoadPlace::Back });
    assert!(refused(WalkConditions { load, ..level() }).contains("load"));
    let strengths = vec![("ankel".to_owned(), 0.5)];
    assert!(refused(WalkConditions { strengths, ..level() }).contains("`ankel`; expected one of `ankle_angle`"));
    let strengths = vec![("knee_r".to_owned(), -0.5)];
    assert!(refused(WalkConditions { strengths, ..level() }).contains("share of strength"));
    let wrong = |text: &str| Device::from_toml(text).unwrap_err().to_string();
    assert!(wrong("").contains("[[device]]"));
    assert!(wrong("[[device]]\nstiffness = 1\n").contains("joint"));
    assert!(wrong("[[device]]\njoint = \"ankle\"\nstifness = 1\n").contains("stifness"));
    assert!(wrong("[[device]]\njoint = \"ankle\"\nmoments = [1, \"a\"]\n").contains("line 3"));
    assert!(wrong("[[device]]\njoint = \"ankle\"\nrest_deg = 5\n").contains("a stiffness, a damping or moments"));
}

#[test]
fn muscles_that_are_too_weak_are_named() {
    let human = MAN.human().unwrap();
    let strengths = vec![("ankle_angle_r".to_owned(), 0.02), ("ankle_angle_l".to_owned(), 0.02)];
    let weak = MIRRORED.predict(&WalkConditions { strengths, ..WalkConditions::default() });
    let overload = weak.found.solution.overload(0.05).unwrap();
    println!("{overload:?}");
    assert!(overload.moment.abs() > 1.05 * overload.strength);
    assert!(human.model.coordinate(&overload.coordinate).is_some());
    let shown = OptimalWalkError::TooWeak { speed: 1.3, overload }.to_string();
    assert!(shown.contains("N.m at") && shown.contains("its strength"), "{shown}");
}
