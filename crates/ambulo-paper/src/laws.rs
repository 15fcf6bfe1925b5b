//! Claims about the kinematic model of section 2: smooth sub-cycles, speed as step length times frequency, changes of
//! speed.

use super::claim::{ClaimKind, Numbers, Statement, number, numbers};
use super::evidence::Scope;
use super::figures::REFERENCE_LEG;
use super::open_values::GAITS;
use ambulo_body::findings::Findings;
use ambulo_body::numerics::elementary::ln;
use ambulo_walk::gait::{CyclicCurve, Gait, GaitError, Jet, LegAngles, Pace, PaceChange, Speed, Style, Walk};

/// Distance from an instant at which both sides of it are compared [s].
const BESIDE_S: f64 = 1e-6;
/// A difference across this distance that is no jump, as a share of the largest acceleration. A continuous acceleration
/// changes by its rate times 2 µs: up to 1e-4 of its largest value within a sub-cycle of 0.1 s.
const NO_JUMP: f64 = 1e-3;
/// Instants at which the sign of the angular velocity is tested in each sub-cycle.
const INSTANTS: usize = 100;
/// Postures that are equal [deg].
const EQUAL_DEG: f64 = 1e-6;

type Angle = fn(&LegAngles) -> Jet;
const ANGLES: [Angle; 3] = [|leg| leg.hip, |leg| leg.knee, |leg| leg.ankle];

pub(super) const SMOOTH: Statement = Statement {
    id: "l1",
    kind: ClaimKind::ByConstruction,
    paper: "angles are C2, and the angular velocity has one sign in each sub-cycle",
    criterion: "no acceleration of hip, knee and ankle changes by more than 0.001 of its largest value within 2 µs \
        about a bound, and \
        no sub-cycle both flexes and extends, in the four gaits",
    former: None,
    headline: "largest_jump_of_acceleration_share",
    scope: Scope::Full,
    measure: |_| {
        let (mut jump, mut turns) = (0.0_f64, 0);
        for name in GAITS {
            let Ok(walk) = Gait::named(name).and_then(|gait| walk_of(&gait)) else { return Numbers::new() };
            let (largest, count) = smoothness(&walk);
            jump = jump.max(largest);
            turns += count;
        }
        numbers([("largest_jump_of_acceleration_share", jump), ("sub_cycles_that_turn", turns as f64)])
    },
    judge: |paper, _| {
        let (jump, turns) =
            (number(paper, "largest_jump_of_acceleration_share"), number(paper, "sub_cycles_that_turn"));
        let note = format!("found {jump:.1e} and {turns:.0}");
        (jump < NO_JUMP && turns < 0.5, note)
    },
};

pub(super) const SPEED_LAW: Statement = Statement {
    id: "l2",
    kind: ClaimKind::ByConstruction,
    paper: "speed is step length times step frequency, and people lengthen the step rather than raise the frequency",
    criterion: "the speed of walks at 1.0 and 1.6 m/s is this product within 1e-9, and more than half of the increase \
        comes from the \
        step length, in logarithms",
    former: None,
    headline: "share_of_step_length",
    scope: Scope::Full,
    measure: |_| {
        let [Ok(slow), Ok(fast)] = [1.0, 1.6].map(|speed| at_speed(speed, Vec::new())) else { return Numbers::new() };
        let product = |walk: &Walk| walk.step_length() * 2.0 / walk.cycle_s() / walk.speed() - 1.0;
        let share = ln(fast.step_length() / slow.step_length()) / ln(fast.speed() / slow.speed());
        numbers([
            ("share_of_step_length", share),
            ("departure_from_product", product(&slow).abs().max(product(&fast).abs())),
        ])
    },
    judge: |paper, _| {
        let (share, off) = (number(paper, "share_of_step_length"), number(paper, "departure_from_product"));
        let note = format!("found {off:.0e} and {:.0} %, as the exponent of the cadence is assumed", 100.0 * share);
        (share > 0.5 && off < 1e-9, note)
    },
};

pub(super) const CHANGE: Statement = Statement {
    id: "l3",
    kind: ClaimKind::ByConstruction,
    paper: "if the velocity changes, all states are synchronized using the new sub-cycle parameters",
    criterion: "after a change from 1.2 to 1.6 m/s in one second, hip, knee and ankle have at every phase the angles \
        of a walk at \
        1.6 m/s within 0.000001 deg, and no acceleration jumps at either end of the change",
    former: None,
    headline: "difference_after_the_change_deg",
    scope: Scope::Full,
    measure: |_| changed().unwrap_or_default(),
    judge: |paper, _| {
        let (off, jump) =
            (number(paper, "difference_after_the_change_deg"), number(paper, "jump_of_acceleration_share"));
        let note = format!("found {off:.0e} deg, and a jump of {jump:.0e} of the largest acceleration");
        (off < EQUAL_DEG && jump < NO_JUMP, note)
    },
};

fn walk_of(gait: &Gait) -> Result<Walk, GaitError> {
    Walk::new(gait, REFERENCE_LEG, &mut Findings::default())
}

/// A walk of the paper's style at a speed [m/s], with changes on the way.
fn at_speed(speed: f64, pace_changes: Vec<PaceChange>) -> Result<Walk, GaitError> {
    let pace = Pace { speed: Some(Speed::MetersPerSecond(speed)), ..Pace::default() };
    walk_of(&Gait { pace, pace_changes, ..Gait::new("speed", Style::Paper1997) })
}

/// The largest jump of an acceleration at a bound as a share of its largest value, and the number of sub-cycles with
/// both signs.
fn smoothness(walk: &Walk) -> (f64, usize) {
    let (legs, speed) = (walk.legs(), walk.curve_speed(&walk.clock(0.0)).value);
    let curves: [&CyclicCurve; 3] = [&legs.hip, &legs.knee, &legs.ankle];
    let (mut jump, mut turns) = (0.0_f64, 0);
    for (curve, angle) in curves.into_iter().zip(ANGLES) {
        // One cycle later, so that no instant is before the start.
        let bounds: Vec<f64> = curve.knots().iter().map(|knot| (1.0 + knot.phase.at(speed)) * walk.cycle_s()).collect();
        let ends = bounds.iter().skip(1).copied().chain(bounds.first().map(|first| first + walk.cycle_s()));
        jump = jump.max(jump_at(walk, angle, &bounds));
        turns += bounds.iter().zip(ends).filter(|(from, to)| turns_within(walk, angle, **from, *to)).count();
    }
    (jump, turns)
}

fn jump_at(walk: &Walk, angle: Angle, instants: &[f64]) -> f64 {
    let at = |t: f64| angle(&walk.at(t).right).acceleration;
    let largest = (0..1000).map(|k| at(walk.cycle_s() * (1.0 + f64::from(k) / 1000.0)).abs()).fold(0.0, f64::max);
    let jumps = instants.iter().map(|t| (at(t + BESIDE_S) - at(t - BESIDE_S)).abs());
    jumps.fold(0.0, f64::max) / largest
}

/// Whether the angular velocity has both signs between two bounds, apart from rounding.
fn turns_within(walk: &Walk, angle: Angle, from_s: f64, to_s: f64) -> bool {
    let at = |k: usize| angle(&walk.at(from_s + (to_s - from_s) * k as f64 / INSTANTS as f64).right).rate;
    let rates: Vec<f64> = (1..INSTANTS).map(at).collect();
    let largest = rates.iter().fold(0.0_f64, |most, rate| most.max(rate.abs()));
    let has = |sign: f64| rates.iter().any(|rate| sign * rate > 1e-9 * largest.max(1e-9));
    has(1.0) && has(-1.0)
}

/// A change of speed between the two bounds [s].
const CHANGES_S: [f64; 2] = [2.0, 3.0];

fn changed() -> Option<Numbers> {
    let [from_s, to_s] = CHANGES_S;
    let change =
        PaceChange { start_s: from_s, duration_s: Some(to_s - from_s), speed: Some(1.6), ..PaceChange::default() };
    let walk = at_speed(1.2, vec![change]).ok()?;
    let steady = at_speed(1.6, Vec::new()).ok()?;
    let (mut off, mut jump) = (0.0_f64, 0.0_f64);
    for angle in ANGLES {
        for instant in 1..INSTANTS {
            let t = to_s + 2.0 * instant as f64 / INSTANTS as f64;
            let phase = walk.clock(t).phase.value;
            let same = angle(&steady.at(phase * steady.cycle_s()).right).value;
            off = off.max((angle(&walk.at(t).right).value - same).to_degrees().abs());
        }
        jump = jump.max(jump_at(&walk, angle, &CHANGES_S));
    }
    Some(numbers([("difference_after_the_change_deg", off), ("jump_of_acceleration_share", jump)]))
}
