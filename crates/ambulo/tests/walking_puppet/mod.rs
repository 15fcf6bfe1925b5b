//! A puppet whose motion obeys Newton's and Euler's laws for its supports: the feet, and a hand if it has one.
//!
//! The puppet is a trunk that does not rotate and two light feet that move independently. The trunk stays at a height
//! h, so that its horizontal acceleration determines the line of action of the total force (Kajita's inverted
//! pendulum):
//!
//!   ẍ = g/h (x - p)        p = (1 - s) p_feet + s p_hand
//!
//! p_feet goes from heel to ball of the stance foot and in double support to the other one; the hand carries the share
//! s. The path of the trunk is the solution that is at rest at the beginning and at the end.

use ambulo::findings::Findings;
use ambulo::kinematics::Trajectory;
use ambulo::model::anatomy::{Sole, SolePoint};
use ambulo::model::{BySide, Model, Side};
use ambulo::motion::TimeGrid;
use ambulo::spatial::Vec3;

const GRAVITY: f64 = 9.80665;
const TRUNK_M: f64 = 1.0;
const STILL_S: f64 = 1.0;
const SWING_S: f64 = 0.4;
/// Time from swing to swing of one foot; right and left alternate [s].
const STRIDE_S: f64 = 1.1;
const STEPS: usize = 4;
const STEP_M: f64 = 1.2;
const LIFT_M: f64 = 0.08;
const BESIDE_M: f64 = 0.08;
/// First and last centre of pressure on a foot [m].
const ROLL_M: [f64; 2] = [0.0, 0.12];
const STEP_S: f64 = 0.01;

/// Share of the weight on a hand, and its position lateral to and in front of the path of the trunk [m].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hand {
    pub(crate) share: f64,
    pub(crate) forward: f64,
    pub(crate) right: f64,
}

pub(crate) const NO_HAND: Hand = Hand { share: 0.0, forward: 0.0, right: 0.0 };

/// A motion with its body.
pub(crate) struct Puppet {
    pub(crate) model: Model,
    pub(crate) soles: BySide<Option<Sole>>,
    pub(crate) trajectory: Trajectory,
}

fn model() -> Model {
    let body = |name: &str, mass: f64, inertia: f64| {
        let axes = ["rx", "ry", "rz", "tx", "ty", "tz"];
        let coordinates: String = axes.iter().map(|a| format!("<Coordinate name=\"{name}_{a}\"/>")).collect();
        format!(
            "<Body name=\"{name}\"><mass>{mass}</mass><mass_center>0 0 \
             0</mass_center><inertia_xx>{inertia}</inertia_xx>\
             <inertia_yy>{inertia}</inertia_yy><inertia_zz>{inertia}</inertia_zz><inertia_xy>0</inertia_xy>\
             <inertia_xz>0</inertia_xz><inertia_yz>0</inertia_yz><Joint><FreeJoint name=\"{name}_free\">\
             <parent_body>ground</parent_body>\
             <location_in_parent>0 0 0</location_in_parent><orientation_in_parent>0 0 0</orientation_in_parent>\
             <location>0 0 0</location><orientation>0 0 0</orientation>\
             <CoordinateSet><objects>{coordinates}</objects></CoordinateSet></FreeJoint></Joint></Body>\n"
        )
    };
    let text = format!(
        "<?xml version=\"1.0\"?>\n<OpenSimDocument Version=\"30000\">\n<Model name=\"puppet\">\n<gravity>0 -{GRAVITY} \
         0</gravity>\n\
         <BodySet><objects>\n<Body \
         name=\"ground\"><mass>0</mass></Body>\n{}{}{}</objects></BodySet>\n</Model>\n</OpenSimDocument>\n",
        body("trunk", 70.0, 1.0),
        body("calcn_r", 0.1, 0.001),
        body("calcn_l", 0.1, 0.001)
    );
    Model::from_osim(text.as_bytes(), &mut Findings::default()).unwrap()
}

fn soles(model: &Model) -> BySide<Option<Sole>> {
    BySide::from_fn(|side| {
        let body = model.body(&format!("calcn_{}", side.letter())).unwrap();
        let point = |x: f64| SolePoint { body, place: Vec3::new(x, 0.0, 0.0) };
        Some(Sole { points: [point(-0.05), point(0.12), point(0.18)], half_width: 0.045 })
    })
}

/// Start time of a swing of a foot by its number [s].
fn lifts(side: Side, swing: usize) -> f64 {
    STILL_S + STRIDE_S * (swing as f64 + if side == Side::Left { 0.5 } else { 0.0 })
}

fn end_s() -> f64 {
    lifts(Side::Left, STEPS - 1) + SWING_S + STILL_S
}

/// Position of a foot after a number of swings [m]: the last step of the right foot is half as long, so that both end
/// side by side.
fn place(side: Side, swings: usize) -> Vec3 {
    let forward = match (side, swings) {
        (Side::Right, 0) | (Side::Left, 0) => 0.0,
        (Side::Right, n) => STEP_M * (n as f64 - 0.5),
        (Side::Left, n) => STEP_M * n as f64,
    };
    Vec3::new(forward, 0.0, if side == Side::Right { BESIDE_M } else { -BESIDE_M })
}

fn swings_begun(side: Side, t: f64) -> usize {
    (0..STEPS).filter(|&k| t >= lifts(side, k)).count()
}

/// Position, velocity and acceleration of a foot.
fn foot(side: Side, t: f64) -> [Vec3; 3] {
    let begun = swings_begun(side, t);
    if begun == 0 {
        return [place(side, 0), Vec3::zeros(), Vec3::zeros()];
    }
    let way = place(side, begun) - place(side, begun - 1);
    let u = ((t - lifts(side, begun - 1)) / SWING_S).clamp(0.0, 1.0);
    let p = u * (1.0 - u);
    let slope = 1.0 - 2.0 * u;
    let (rate, twice) = (1.0 / SWING_S, 1.0 / (SWING_S * SWING_S));
    // Velocity and acceleration are zero at both ends.
    let along = [u.powi(3) * (10.0 - 15.0 * u + 6.0 * u * u), 30.0 * p * p * rate, 60.0 * p * slope * twice];
    let lift = [64.0 * p.powi(3), 192.0 * p * p * slope * rate, 384.0 * (p * slope * slope - p * p) * twice];
    [0, 1, 2].map(|k| {
        let start = if k == 0 { place(side, begun - 1) } else { Vec3::zeros() };
        start + way * along[k] + Vec3::y() * (LIFT_M * lift[k])
    })
}

/// Centre of pressure of both feet together [m].
fn pushed(t: f64) -> Vec3 {
    // The swings of the other foot, in order of time: during each, this foot rolls from heel to ball.
    let mut rolls: Vec<(f64, Vec3)> = Vec::new();
    for k in 0..STEPS {
        for side in Side::BOTH {
            let other = if side == Side::Right { Side::Left } else { Side::Right };
            let (from, to) = (lifts(side, k), lifts(side, k) + SWING_S);
            let on = place(other, swings_begun(other, from));
            rolls.push((from, on + Vec3::x() * ROLL_M[0]));
            rolls.push((to, on + Vec3::x() * ROLL_M[1]));
        }
    }
    let between = |swings: usize| {
        Side::BOTH.map(|side| place(side, swings)).iter().sum::<Vec3>() * 0.5
            + Vec3::x() * (0.5 * (ROLL_M[0] + ROLL_M[1]))
    };
    rolls.insert(0, (0.5 * STILL_S, between(0)));
    rolls.push((end_s() - 0.5 * STILL_S, between(STEPS)));
    let next = rolls.partition_point(|(time, _)| *time <= t);
    match next {
        0 => rolls[0].1,
        n if n == rolls.len() => rolls[n - 1].1,
        n => {
            let ((t0, p0), (t1, p1)) = (rolls[n - 1], rolls[n]);
            p0 + (p1 - p0) * ((t - t0) / (t1 - t0))
        }
    }
}

/// Path of the trunk for a path of the total force: (1 - h/g D²) x = p, by elimination in a band of three; at rest at
/// both ends.
fn carried(whole: &[Vec3]) -> Vec<Vec3> {
    let off = -TRUNK_M / GRAVITY / (STEP_S * STEP_S);
    let count = whole.len();
    let (mut pivots, mut right) = (vec![1.0; count], whole.to_vec());
    for i in 1..count - 1 {
        let upper = if i == 1 { 0.0 } else { off };
        pivots[i] = 1.0 - 2.0 * off - off * upper / pivots[i - 1];
        let before = right[i - 1];
        right[i] -= before * (off / pivots[i - 1]);
    }
    for i in (1..count - 1).rev() {
        let after = right[i + 1];
        right[i] = (right[i] - after * off) / pivots[i];
    }
    right
}

/// A walk of some steps.
pub(crate) fn walk(hand: Hand) -> Puppet {
    let whole_grid = TimeGrid { start_s: 0.0, step_s: STEP_S, frames: (end_s() / STEP_S) as usize };
    let feet: Vec<Vec3> = whole_grid.times().into_iter().map(pushed).collect();
    let own = carried(&feet);
    let held = |i: usize| Vec3::new(own[i].x + hand.forward, 0.0, hand.right);
    let whole: Vec<Vec3> = (0..feet.len()).map(|i| feet[i] * (1.0 - hand.share) + held(i) * hand.share).collect();
    let trunk = carried(&whole);
    let at = |i: isize| trunk[i.clamp(0, trunk.len() as isize - 1) as usize] + Vec3::y() * TRUNK_M;
    let path = |frame: usize| {
        let [a, b, c] = [-1, 0, 1].map(|k| at(frame as isize + k));
        [b, (c - a) / (2.0 * STEP_S), (a - b * 2.0 + c) / (STEP_S * STEP_S)]
    };
    // Without the rests at both ends.
    let skipped = (STILL_S / STEP_S) as usize;
    let grid = TimeGrid { start_s: STILL_S, step_s: STEP_S, frames: whole_grid.frames - 2 * skipped };
    moved(grid, |frame| {
        [path(frame + skipped), foot(Side::Right, grid.time(frame)), foot(Side::Left, grid.time(frame))]
    })
}

/// A puppet with given positions, velocities and accelerations of trunk and feet.
pub(crate) fn moved(grid: TimeGrid, of_bodies: impl Fn(usize) -> [[Vec3; 3]; 3]) -> Puppet {
    let model = model();
    let mut columns = vec![[const { Vec::new() }; 3]; model.coordinates().len()];
    for frame in 0..grid.frames {
        for (body, moved) in ["trunk", "calcn_r", "calcn_l"].iter().zip(of_bodies(frame)) {
            for (axis, name) in ["tx", "ty", "tz"].iter().enumerate() {
                let id = model.coordinate(&format!("{body}_{name}")).unwrap().index();
                for (column, value) in columns[id].iter_mut().zip(moved) {
                    column.push(value[axis]);
                }
            }
        }
    }
    for series in columns.iter_mut().flatten().filter(|series| series.is_empty()) {
        series.resize(grid.frames, 0.0);
    }
    let trajectory = Trajectory::new(&model, grid, columns).unwrap();
    Puppet { soles: soles(&model), model, trajectory }
}
