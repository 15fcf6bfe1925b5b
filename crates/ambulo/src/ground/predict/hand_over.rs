//! Double support by a curve: the foot behind gives its load away, the foot ahead takes the rest.
//!
//!   F_behind(t) = F(t₀) exp(-(u / 0.64)^1.8)     u = (t - t₀) / (t₁ - t₀)     F_ahead = F - F_behind
//!
//! for each component of the force, t₀ the strike of the foot ahead, t₁ the off of the foot behind. The centre of pressure goes from
//! ball to tip behind and from the heel towards the ball ahead. A foot that stands alone takes the whole wrench, its centre of
//! pressure brought onto the sole.
//!
//! | code     | symbol | unit | meaning                                       |
//! | `u`      | u      | 1    | share of the double support that has passed   |
//! | `begin`  | t₀     | s    | strike of the foot ahead                      |
//! | `end`    | t₁     | s    | off of the foot behind                        |
//!
//! Curve: fitted to the mean curves of Schwartz, Rozumalski, Trost 2008 at five speeds; leave one speed out, it misses the vertical
//! force over stance by 1.6 to 2.4 % of body weight (6.3 at very slow speed).
//! Not handled: what the curve cannot know: the lever between the feet.
//! Pinned by: tests/ground_predict.rs

use super::{FootDeviation, Known};
use crate::ground::footfalls::{Footfall, Footfalls};
use crate::ground::sole::Sole;
use crate::ground::{BodyForces, upward};
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::{BodyId, Model, Side};
use crate::motion::TimeGrid;
use crate::numerics::median;
use crate::spatial::{Vec3, Wrench};

/// The name of the rule.
pub(super) const RULE: &str = "hand-over by the curve exp(-(u/0.64)^1.8)";
const CURVE_SCALE: f64 = 0.64;
const CURVE_POWER: f64 = 1.8;
/// Double support of a step where the recording shows none in full [s]: 10 % of a cycle of 1.1 s (Schwartz 2008, free speed: 19 % in
/// both double supports).
const USUAL_DOUBLE_SUPPORT_S: f64 = 0.11;
/// Standard deviations of force, in body weights: vertical and along the ground (errors of published methods from inertial sensors:
/// Karatsidis and others 2019, 9.3 vertical, 5.5 fore-aft, 2.1 lateral; the larger of the two horizontal ones for both).
const FORCE_DEVIATION_BW: [f64; 2] = [0.093, 0.055];
/// Standard deviation of the centre of pressure [m]: a guess of the size of half a foot's width.
const CENTER_DEVIATION_M: f64 = 0.03;
/// Standard deviation of the free moment [N.m]: a guess, half of its usual peak.
const FREE_MOMENT_DEVIATION_NM: f64 = 4.0;

/// What the ground does to one foot, one entry a frame.
pub(super) struct Foot {
    force: Vec<Vec3>,
    /// About the world's origin [N.m].
    moment: Vec<Vec3>,
    /// Of the ground below it, along the upward direction [m].
    height: Vec<f64>,
}

impl Foot {
    pub(super) fn on(&self, body: BodyId, up: Vec3) -> BodyForces {
        BodyForces::on_ground(body, &self.force, &self.moment, up, &self.height)
    }
}

/// Divides the total wrench between right and left foot.
pub(super) fn divide(
    model: &Model,
    trajectory: &Trajectory,
    soles: &[Sole; 2],
    footfalls: &Footfalls,
    total: &[Wrench],
    known: &Known,
) -> [Foot; 2] {
    let (grid, up) = (trajectory.grid(), upward(model));
    let rule = Rule { grid, up, footfalls, total, known, usual_s: usual_double_support(footfalls) };
    let empty = || Foot { force: Vec::new(), moment: Vec::new(), height: Vec::new() };
    let mut feet = [empty(), empty()];
    each_body_motion(model, trajectory, |frame, bodies| {
        let lines = soles.map(|sole| sole.points.map(|point| bodies[point.body.index()].pose.place(point.place)));
        for (side, (foot, load)) in feet.iter_mut().zip(rule.frame(frame, &lines, soles)).enumerate() {
            foot.force.push(load.force);
            foot.moment.push(load.moment);
            foot.height.push(rule.height(side, grid.time(frame)));
        }
    });
    feet
}

/// Standard deviations of a foot's load while it is loaded.
pub(super) fn deviation(model: &Model, side: Side, foot: &BodyForces) -> FootDeviation {
    let (up, weight) = (upward(model), model.mass() * model.gravity().norm());
    let [vertical, horizontal] = FORCE_DEVIATION_BW.map(|share| share * weight);
    let along = |up: f64, level: f64, axis: Vec3| Vec3::repeat(level) + axis.map(f64::abs) * (up - level);
    let loaded = |i: usize| !foot.center_of_pressure[i].x.is_nan();
    let while_loaded = |value: Vec3| {
        let at = |i: usize| if loaded(i) { value } else { Vec3::zeros() };
        (0..foot.force.len()).map(at).collect::<Vec<Vec3>>()
    };
    FootDeviation {
        side,
        force: while_loaded(along(vertical, horizontal, up)),
        center: while_loaded(along(0.0, CENTER_DEVIATION_M, up)),
        free_moment: while_loaded(Vec3::repeat(FREE_MOMENT_DEVIATION_NM)).iter().map(|v| v.x).collect(),
    }
}

/// What is asked for in every frame.
struct Rule<'a> {
    grid: TimeGrid,
    up: Vec3,
    footfalls: &'a Footfalls,
    total: &'a [Wrench],
    known: &'a Known,
    usual_s: f64,
}

impl Rule<'_> {
    /// Loads of right and left foot about the world's origin.
    fn frame(&self, frame: usize, lines: &[[Vec3; 3]; 2], soles: &[Sole; 2]) -> [Wrench; 2] {
        let time = self.grid.time(frame);
        let mut loads = [Wrench::ZERO; 2];
        match Side::BOTH.map(|side| self.standing(side, time)) {
            [None, None] => {}
            [Some(_), None] => loads[0] = self.alone(0, frame, &lines[0], &soles[0]),
            [None, Some(_)] => loads[1] = self.alone(1, frame, &lines[1], &soles[1]),
            [Some(right), Some(left)] => loads = self.together(frame, right, left, lines),
        }
        loads
    }

    fn standing(&self, side: Side, time: f64) -> Option<&Footfall> {
        let [first, last] = [self.grid.start_s, self.grid.end_s()];
        let stands = |fall: &&Footfall| {
            fall.strike_s.unwrap_or(first) <= time && time <= fall.off_s.unwrap_or(last) + 1e-9 * self.grid.step_s
        };
        self.footfalls.of(side).find(stands)
    }

    /// Height of the ground below a foot [m]: of the stance that is nearest in time.
    fn height(&self, side: usize, time: f64) -> f64 {
        let apart = |fall: &&Footfall| {
            let after = fall.strike_s.map_or(0.0, |strike| (strike - time).max(0.0));
            after.max(fall.off_s.map_or(0.0, |off| (time - off).max(0.0)))
        };
        let nearest = self.footfalls.of(Side::BOTH[side]).min_by(|a, b| apart(a).total_cmp(&apart(b)));
        nearest.map_or(0.0, |fall| fall.floor_height_m)
    }

    /// The whole wrench under one foot.
    fn alone(&self, foot: usize, frame: usize, line: &[Vec3; 3], sole: &Sole) -> Wrench {
        let Wrench { force, moment } = self.total[frame];
        let height = self.height(foot, self.grid.time(frame));
        let vertical = force.dot(&self.up);
        if vertical <= 0.0 {
            return Wrench::ZERO;
        }
        let found = (self.up.cross(&moment) + force * height) / vertical;
        let center =
            self.known.center_at(foot, frame).unwrap_or_else(|| self.onto(line, found, sole.half_width, height));
        let free = self.up * self.up.dot(&(moment - center.cross(&force)));
        Wrench { force, moment: center.cross(&force) + free }
    }

    /// Both feet.
    fn together(&self, frame: usize, right: &Footfall, left: &Footfall, lines: &[[Vec3; 3]; 2]) -> [Wrench; 2] {
        let force = self.total[frame].force;
        let strike = |fall: &Footfall| fall.strike_s.unwrap_or(f64::NEG_INFINITY);
        let off = |fall: &Footfall| fall.off_s.unwrap_or(f64::INFINITY);
        let right_is_behind = (strike(right), off(right)) <= (strike(left), off(left));
        let (behind, ahead) = if right_is_behind { (right, left) } else { (left, right) };
        let (back, front) = (behind.side as usize, ahead.side as usize);
        let u = self.passed(self.grid.time(frame), ahead.strike_s, behind.off_s);
        let mut loads = [Wrench::ZERO; 2];
        let given = match u {
            Some(u) => self.start_force(ahead.strike_s, force) * curve(u),
            None => force * 0.5,
        };
        loads[back].force = self.with_known_share(frame, force, given, right_is_behind);
        loads[front].force = force - loads[back].force;
        let u = u.unwrap_or(0.5);
        let [_, ball, tip] = lines[back];
        let [heel, middle, _] = lines[front];
        let places = [(back, ball + (tip - ball) * u), (front, heel + (middle - heel) * 0.5 * u)];
        for (foot, place) in places {
            let height = self.height(foot, self.grid.time(frame));
            let on_ground = place + self.up * (height - place.dot(&self.up));
            let center = self.known.center_at(foot, frame).unwrap_or(on_ground);
            loads[foot].moment = center.cross(&loads[foot].force);
        }
        loads
    }

    /// Share of a double support that has passed; `None` where neither its beginning nor its end is known.
    fn passed(&self, time: f64, begin: Option<f64>, end: Option<f64>) -> Option<f64> {
        let begin_s = begin.or(end.map(|end| end - self.usual_s))?;
        let end_s = end.unwrap_or(begin_s + self.usual_s);
        Some(((time - begin_s) / (end_s - begin_s).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0))
    }

    /// The total force when the foot ahead struck; where that was not seen, the force now.
    fn start_force(&self, strike_s: Option<f64>, now: Vec3) -> Vec3 {
        let Some(strike_s) = strike_s else { return now };
        let at = (strike_s - self.grid.start_s) / self.grid.step_s;
        let before = (at.floor().max(0.0) as usize).min(self.total.len() - 1);
        let after = (before + 1).min(self.total.len() - 1);
        let share = (at - before as f64).clamp(0.0, 1.0);
        self.total[before].force * (1.0 - share) + self.total[after].force * share
    }

    /// The force of the foot behind: nothing pulls down; its vertical part as it is known, if it is.
    fn with_known_share(&self, frame: usize, force: Vec3, given: Vec3, right_is_behind: bool) -> Vec3 {
        let whole = force.dot(&self.up);
        let share = self.known.right_share_at(frame).map(|right| if right_is_behind { right } else { 1.0 - right });
        let vertical = share.map_or(given.dot(&self.up), |share| share * whole).clamp(0.0, whole.max(0.0));
        given + self.up * (vertical - given.dot(&self.up))
    }

    /// The nearest place on a sole, at the height of the ground.
    fn onto(&self, line: &[Vec3; 3], place: Vec3, half_width: f64, height: f64) -> Vec3 {
        let level = |v: Vec3| v - self.up * v.dot(&self.up);
        let place = level(place);
        let nearest = line.windows(2).map(|ends| {
            let (from, along) = (level(ends[0]), level(ends[1] - ends[0]));
            let share = (place - from).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE);
            from + along * share.clamp(0.0, 1.0)
        });
        let nearest = nearest.min_by(|a, b| (a - place).norm().total_cmp(&(b - place).norm())).unwrap_or(place);
        let away = place - nearest;
        let kept = away * (half_width / away.norm().max(half_width).max(f64::MIN_POSITIVE));
        nearest + kept + self.up * height
    }
}

/// What is left of the load of the foot behind.
fn curve(u: f64) -> f64 {
    (-(u / CURVE_SCALE).powf(CURVE_POWER)).exp()
}

/// Median duration of the double supports that were seen in full [s].
fn usual_double_support(footfalls: &Footfalls) -> f64 {
    let begins = footfalls.falls.iter().filter_map(|fall| Some((fall.side, fall.strike_s?)));
    let seen = begins.filter_map(|(side, strike)| {
        let of_other = |fall: &&Footfall| fall.side != side && fall.strike_s.is_none_or(|before| before < strike);
        let ends = footfalls.falls.iter().filter(of_other).filter_map(|fall| fall.off_s);
        let end = ends.filter(|off| *off > strike).fold(f64::INFINITY, f64::min);
        end.is_finite().then_some(end - strike)
    });
    median(seen.collect::<Vec<f64>>()).unwrap_or(USUAL_DOUBLE_SUPPORT_S)
}
