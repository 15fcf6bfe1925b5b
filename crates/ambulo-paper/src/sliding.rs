//! Claim (d): "We could not prevent the character from sliding, even with a friction coefficient as high as 1."
//!
//! There are two causes. In single support the sole slips where the horizontal force exceeds the friction limit; more
//! friction prevents this. In double support the figure, with prescribed joints and a held trunk, has two degrees of
//! freedom for the four that two resting soles would fix: where the joint curves give the feet different speeds, one
//! foot must slip with any friction.

use super::claim::{ClaimKind, Numbers, Statement, number, numbers};
use super::evidence::{Evidence, FRICTIONS, Scope};
use super::mode::Run;
use super::steady::{STEADY_CYCLES, Steady};
use ambulo_body::kinematics::each_body_motion;
use ambulo_body::model::Side;
use ambulo_body::model::anthropometry::ContactSphere;
use ambulo_body::numerics::rms;

/// Slip per step that counts as none [m].
const NO_SLIP_M: f64 = 1e-3;

pub(super) const SINGLE: Statement = Statement {
    id: "d1",
    kind: ClaimKind::Paper,
    paper: "the character slides even with a friction coefficient as high as 1",
    criterion: "the foot in single support slips more than 1 mm per step at a friction coefficient of 1",
    former: None,
    headline: "slip_on_one_foot_mm_a_step",
    scope: Scope::Brief,
    measure,
    judge: |paper, _| {
        let slip = number(paper, "slip_on_one_foot_mm_a_step");
        let stop = number(paper, "friction_that_stops_it");
        let ends = if stop.is_finite() {
            let below = FRICTIONS.iter().copied().filter(|mu| *mu < stop).fold(0.0, f64::max);
            format!("it falls below {:.0} mm at a friction between {below} and {stop}", 1e3 * NO_SLIP_M)
        } else {
            format!("it does not end at any friction up to {:.0}", FRICTIONS[FRICTIONS.len() - 1])
        };
        let note = format!(
            "it slips {slip:.1} mm and is at the \
             friction limit for {:.0} % of single support; {ends}",
            100.0 * number(paper, "share_at_limit_on_one_foot"),
        );
        (slip > 1e3 * NO_SLIP_M, note)
    },
};

pub(super) const FORCED: Statement = Statement {
    id: "d2",
    kind: ClaimKind::Ours,
    paper: "(not in the paper) sliding that no friction can prevent: in double support the feet have different speeds",
    criterion: "in the double support of the gait the lowest points of the feet move more than 1 mm per step relative \
        to each other",
    former: None,
    headline: "forced_slip_mm_a_step",
    scope: Scope::Brief,
    measure: measure_forced,
    judge: |paper, corrected| {
        let (rub, apart) = (number(paper, "forced_slip_mm_a_step"), number(paper, "feet_apart_in_height_mm"));
        let stands = number(paper, "share_on_both_feet");
        let own = if stands > 0.0 {
            format!("both feet are loaded for {:.1} % of the time", 100.0 * stands)
        } else {
            "in the steady walk the feet are never loaded at the same time, so no slip is forced: a foot slips only at \
             the friction limit"
                .to_owned()
        };
        let better = corrected.map_or(String::new(), |numbers| {
            format!(
                "; in the corrected mode {:.1} mm and {:.1} mm",
                number(numbers, "forced_slip_mm_a_step"),
                number(numbers, "feet_apart_in_height_mm")
            )
        });
        let note = format!(
            "found {rub:.1} mm, root mean square {:.2} m/s; their heights differ by {apart:.1} mm{better}; {own}",
            number(paper, "feet_apart_in_speed_m_s"),
        );
        (rub > 1e3 * NO_SLIP_M, note)
    },
};

/// Slip per step [m], and the share of time at the friction limit.
struct Slip {
    on_one_foot: f64,
    on_both: f64,
    at_limit_on_one: f64,
}

fn slip(run: &Run) -> Option<Slip> {
    let steady = Steady::of(run).ok()?;
    let (rows, step) = (steady.rows(), run.recording.grid().step_s);
    let feet = &run.recording.feet;
    let steps = 2.0 * STEADY_CYCLES as f64;
    let (mut one, mut both, mut limit, mut alone) = (0.0, 0.0, 0_usize, 0_usize);
    for row in rows {
        let slipped: f64 = feet.iter().map(|foot| foot.slip[row].abs() * step / steps).sum();
        if run.recording.stands_on_both(row) {
            both += slipped;
        } else if !run.recording.flies(row) {
            one += slipped;
            alone += 1;
            limit += usize::from(feet.iter().any(|foot| foot.at_limit[row]));
        }
    }
    Some(Slip { on_one_foot: one, on_both: both, at_limit_on_one: limit as f64 / alone.max(1) as f64 })
}

fn measure(evidence: &Evidence) -> Numbers {
    let mut all = Numbers::new();
    let slips: Vec<(f64, Option<Slip>)> = evidence.frictions.iter().map(|(mu, run)| (*mu, slip(run))).collect();
    if let Some(own) = slip(evidence.standard()) {
        all.extend(numbers([
            ("slip_on_one_foot_mm_a_step", 1e3 * own.on_one_foot),
            ("slip_on_both_feet_mm_a_step", 1e3 * own.on_both),
            ("share_at_limit_on_one_foot", own.at_limit_on_one),
        ]));
    }
    for (mu, slip) in &slips {
        if let Some(slip) = slip {
            all.push((format!("slip_on_one_foot_at_friction_{mu}_mm_a_step"), 1e3 * slip.on_one_foot));
        }
    }
    let stops = |(_, slip): &&(f64, Option<Slip>)| slip.as_ref().is_some_and(|s| s.on_one_foot < NO_SLIP_M);
    all.push(("friction_that_stops_it".into(), slips.iter().find(stops).map_or(f64::INFINITY, |(mu, _)| *mu)));
    all
}

fn measure_forced(evidence: &Evidence) -> Numbers {
    let run = evidence.standard();
    let Ok(steady) = Steady::of(run) else { return Numbers::new() };
    let (points, step) = (lowest_points(run), run.recording.grid().step_s);
    // Each foot strikes half a cycle after the other foot and leaves the ground at `foot_off`.
    let both = run.foot_off - 0.5;
    let (mut apart, mut speeds) = (Vec::new(), Vec::new());
    for row in steady.rows() {
        let phase = (row as f64 * step / run.cycle_s).fract();
        if phase < both || (0.5..0.5 + both).contains(&phase) {
            let [right, left] = points[row].height;
            apart.push((right - left).abs());
            speeds.push(points[row].velocity[0] - points[row].velocity[1]);
        }
    }
    let rubbed: f64 = speeds.iter().map(|speed| speed.abs() * step).sum::<f64>() / (2.0 * STEADY_CYCLES as f64);
    let largest = apart.iter().copied().fold(0.0, f64::max);
    let slipped = |friction: f64| {
        let run = evidence.frictions.iter().find(|(mu, _)| (mu - friction).abs() < 1e-9);
        run.and_then(|(_, run)| slip(run)).map_or(f64::NAN, |slip| 1e3 * slip.on_both)
    };
    numbers([
        ("share_of_gait_in_double_support", 2.0 * both),
        ("share_on_both_feet", steady.share(|row| run.recording.stands_on_both(row))),
        ("feet_apart_in_height_mm", 1e3 * largest),
        ("feet_apart_in_speed_m_s", rms(&speeds)),
        ("forced_slip_mm_a_step", 1e3 * rubbed),
        ("slip_on_both_feet_at_friction_1_mm_a_step", slipped(1.0)),
        ("slip_on_both_feet_at_friction_1000_mm_a_step", slipped(1000.0)),
    ])
}

/// The lowest point of each foot, right and left, in one row.
#[derive(Debug, Clone, Copy, Default)]
struct Lowest {
    /// Height [m].
    height: [f64; 2],
    /// Forward velocity [m/s].
    velocity: [f64; 2],
}

/// The lowest points of both feet in all rows. Differences between the feet do not depend on where the root goes.
fn lowest_points(run: &Run) -> Vec<Lowest> {
    let mut rows = Vec::with_capacity(run.recording.grid().frames);
    each_body_motion(&run.recording.model, &run.recording.trajectory, |_, motions| {
        let mut lowest = Lowest { height: [f64::INFINITY; 2], velocity: [0.0; 2] };
        for ContactSphere { side, body, center, radius, .. } in &run.soles {
            let motion = &motions[body.index()];
            let place = motion.pose.place(*center);
            let foot = usize::from(*side == Side::Left);
            if place.y - radius < lowest.height[foot] {
                let bottom = place - ambulo_body::spatial::Vec3::y() * *radius;
                lowest.height[foot] = place.y - radius;
                lowest.velocity[foot] = motion.twist.velocity_at(bottom - motion.center).x;
            }
        }
        rows.push(lowest);
    });
    rows
}
