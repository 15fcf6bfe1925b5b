//! The rate of the clock, from mechanics and from the way in which people walk.
//!
//! **Mechanics.** In single support the ground acts on one foot. About the centre of pressure p the horizontal moments
//! of weight and inertia cancel. If the true time is shorter than the recorded one by the factor k (the recording is in
//! slow motion), accelerations are k² times as large as they seem:
//!
//!   h(M_p(weight)) + k² h(M_p(inertia)) = 0,   k² by least squares over all frames; h: horizontal part.
//!
//! With force plates p is measured and every measured frame counts. A plate whose moments or whose place is wrong does
//! the same to these moments as a wrong clock, so that the vertical force, which needs neither, must agree:
//!
//!   f - weight = k² m a
//!
//! Without force plates, p is expected on the line of the sole, from [`CENTER_PATH`] of its length to the other end of
//! this range; an error of 3 cm changes k by about a tenth, because the mass centre passes over the foot by 0.2 m.
//!
//! **People.** Lengths are relative to the length L of the leg, times to √(L/g) (Hof 1996). Step length over cadence
//! (the walk ratio) hardly depends on speed, age and size, and the swing of a leg lasts as long as that of a pendulum:
//!
//! | quantity | typical | spread between people and speeds | source |
//! |---|---|---|---|
//! | walk ratio / (L √(L/g)) | 1.30 | 10 % | 0.0063 to 0.0065 m/(steps/min) of adults, standard deviation 0.0005 to 0.0007 (Sekiya and Nagasaki 1998, unverified) |
//! | time of swing / √(L/g) | 1.35 | 6 % | 0.40 s of adults at their own speed; 0.32 of 0.98 s in children (Schwartz 2008) |
//!
//! Both change in proportion to k. A person who walks very slowly on purpose has them twice as large, with the right
//! clock, and balances over the feet all the same: mechanics decides, and people must not contradict it.
//! Pinned by: tests/study_timing.rs

use super::{NeededFrame, NeededWrenches, difference};
use crate::analysis::{Analysis, StrideQuantity, TimesAndDistances};
use crate::findings::{Code, Findings};
use crate::ground::center_of_pressure;
use crate::ground::footfalls::{Footfall, Footfalls};
use crate::kinematics::each_body_motion;
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model, Side};
use crate::numerics::median;
use crate::spatial::{Vec3, Wrench};

/// Where the centre of pressure is on the line of the sole at the beginning and at the end of single support.
const CENTER_PATH: [f64; 2] = [0.3, 0.8];
/// Typical walk ratio and time of swing, dimensionless.
const TYPICAL: [f64; 2] = [1.30, 1.35];
/// The first and the last moments of a motion are not measured [s].
const EDGE_S: f64 = 0.1;
/// Less inertia does not show its clock [m]: rms of its moment over the weight.
const LEAST_INERTIA_M: f64 = 0.03;
/// Frames of a shorter time do not show a clock [s].
const SHORTEST_S: f64 = 0.3;
/// Factor by which force plates contradict a clock: 72 walks of 8 laboratories have 0.91 to 1.09 times the median.
const BY_PLATES: f64 = 1.14;
/// Factor by which the vertical force must contradict it, too. Chosen with recordings whose clock is right: few of
/// them, fast runs on a belt, have more.
const BY_FORCE: f64 = 1.08;
/// Soft parts of the body follow the bones late and less, so that rigid segments seem this much too fast: the median.
const RIGID: f64 = 0.97;
/// Factor by which mechanics contradicts the clock of a walk without plates: 74 walks have 0.90 to 1.16.
const BY_GAIT: f64 = 1.3;
/// Factor by which the way in which people walk contradicts it at least.
const BY_PEOPLE: f64 = 1.15;
/// Beyond this factor mechanics needs no second witness.
const BY_MECHANICS: f64 = 1.45;
/// With the right clock the needed centre of pressure comes closer to the foot, to less than this share of the
/// distance.
const FALLS_TO: f64 = 0.85;

/// A clock that runs at the wrong rate.
#[derive(Debug, Clone, Copy)]
pub(in crate::study) struct Tempo {
    /// True over stated frame rate.
    factor: f64,
    /// Stated frame rate [Hz].
    stated_hz: f64,
    is_measured: bool,
}

impl Tempo {
    /// By force plates that measure every loaded foot in `frames`.
    pub(super) fn of_plates(
        model: &Model,
        analysis: &Analysis,
        frames: &[NeededFrame],
        load_at: impl Fn(f64) -> Wrench + Copy,
    ) -> Option<Tempo> {
        let up = model.up();
        let centers = analysis.ground.bodies.iter().flat_map(|load| &load.center_of_pressure);
        let height = median(centers.map(|center| center.dot(&up)))?;
        let pair = |frame: &NeededFrame| {
            let load = load_at(frame.time_s);
            let (center, _) = center_of_pressure(load.force, load.moment, up, height);
            center.iter().all(|x| x.is_finite()).then(|| Moments::of(frame, center, up))
        };
        let moments: Vec<Moments> = frames.iter().filter_map(pair).collect();
        let fit = Fit::of(&moments)?;
        let stated_hz = analysis.trajectory.grid().rate_hz();
        let factor = fit.factor / RIGID;
        let force = VerticalForce::of(frames, load_at, up)?;
        let is_wrong = by(factor) > BY_PLATES && force.contradicts(factor);
        is_wrong.then_some(Tempo { factor, stated_hz, is_measured: true })
    }

    /// By single support and strides of a walk.
    pub(in crate::study) fn of_gait(
        model: &Model,
        soles: &BySide<Option<Sole>>,
        analysis: &Analysis,
        stances: &Footfalls,
        strides: &TimesAndDistances,
        leg_m: f64,
    ) -> Option<Tempo> {
        let by_people = factor_of_people(strides, leg_m, model.gravity().norm());
        let moments = single_support(model, soles, analysis, stances)?;
        let fit = Fit::of(&moments)?;
        let stated_hz = analysis.trajectory.grid().rate_hz();
        let agrees = |people: f64| (fit.factor > 1.0) == (people > 1.0) && by(people) > BY_PEOPLE;
        let people_agree = by(fit.factor) > BY_MECHANICS || by_people.is_some_and(agrees);
        let is_wrong = people_agree && by(fit.factor) > BY_GAIT && fit.after_m < FALLS_TO * fit.before_m;
        is_wrong.then_some(Tempo { factor: fit.factor, stated_hz, is_measured: false })
    }

    /// Factor between the stated rate and the true one, at least 1.
    pub(in crate::study) fn wrong_by(&self) -> f64 {
        by(self.factor)
    }

    /// What contradicts the clock, in a sentence.
    pub(in crate::study) fn message(&self) -> String {
        let Tempo { factor, stated_hz, is_measured } = self;
        let why = match is_measured {
            true => "balances over the measured centre of pressure",
            false => "balances over its feet, and swings its legs and takes its steps as people do,",
        };
        format!(
            "the body {why} only if its motion is {:.2} times as {}: it looks like {:.0} frames per second, not \
             {stated_hz:.0}; speeds, accelerations and forces are wrong",
            self.wrong_by(),
            if *factor > 1.0 { "fast" } else { "slow" },
            factor * stated_hz,
        )
    }

    /// Reports the clock.
    pub(in crate::study) fn report(&self, findings: &mut Findings) {
        findings.report(Code::MotionClock, self.message());
    }
}

/// A ratio as a factor above 1.
fn by(ratio: f64) -> f64 {
    ratio.max(ratio.recip())
}

/// Horizontal moments about the centre of pressure, over the weight [m].
struct Moments {
    weight: Vec3,
    inertia: Vec3,
}

impl Moments {
    fn of(frame: &NeededFrame, center: Vec3, up: Vec3) -> Moments {
        let carried_n = frame.weight.force.norm();
        let level = |wrench: Wrench| {
            let moment = wrench.about(-center).moment;
            (moment - up * moment.dot(&up)) / carried_n
        };
        Moments { weight: level(frame.weight), inertia: level(difference(frame.whole, frame.weight)) }
    }
}

/// The rate at which the measured vertical force is that of the motion: the root of the slope of a line through both,
/// by least squares along the force and along the motion. An error of either has the true rate between the two.
struct VerticalForce {
    least: f64,
    most: f64,
}

impl VerticalForce {
    /// `None` if more acceleration does not go with more force.
    fn of(frames: &[NeededFrame], load_at: impl Fn(f64) -> Wrench, up: Vec3) -> Option<VerticalForce> {
        let pair = |frame: &NeededFrame| {
            let needed = difference(frame.whole, frame.weight);
            [needed.force, load_at(frame.time_s).force - frame.weight.force].map(|force| force.dot(&up))
        };
        let pairs: Vec<[f64; 2]> = frames.iter().map(pair).collect();
        let means = [0, 1].map(|k| pairs.iter().map(|pair| pair[k]).sum::<f64>() / pairs.len() as f64);
        let sum = |a: usize, b: usize| pairs.iter().map(|p| (p[a] - means[a]) * (p[b] - means[b])).sum::<f64>();
        let product = sum(0, 1);
        let is_known = product > 0.0;
        is_known.then(|| VerticalForce { least: (product / sum(0, 0)).sqrt(), most: (sum(1, 1) / product).sqrt() })
    }

    /// Whether the force says, too, that the clock is wrong in this direction.
    fn contradicts(&self, factor: f64) -> bool {
        let middle = (self.least * self.most).sqrt();
        match factor > 1.0 {
            true => self.least > 1.0 && middle > BY_FORCE,
            false => self.most < 1.0 && middle < BY_FORCE.recip(),
        }
    }
}

/// The rate at which moments cancel.
struct Fit {
    /// True over recorded rate.
    factor: f64,
    /// Distance of the needed from the given centre of pressure, rms [m]: as recorded, and with the fitted rate.
    before_m: f64,
    after_m: f64,
}

impl Fit {
    /// `None` where too little moves.
    fn of(moments: &[Moments]) -> Option<Fit> {
        let count = moments.len() as f64;
        let sum = |of: &dyn Fn(&Moments) -> f64| moments.iter().map(of).sum::<f64>();
        let square = sum(&|m| m.inertia.norm_squared());
        let product = sum(&|m| m.inertia.dot(&m.weight));
        let distance_m = |squared: f64| (sum(&|m| (m.weight + m.inertia * squared).norm_squared()) / count).sqrt();
        let squared = -product / square;
        let moves = (square / count).sqrt() * squared.max(1.0) > LEAST_INERTIA_M;
        let is_known = moves && squared > 0.0;
        is_known.then(|| Fit { factor: squared.sqrt(), before_m: distance_m(1.0), after_m: distance_m(squared) })
    }
}

/// Geometric mean of walk ratio and time of swing, relative to typical ones. Of the two legs the one whose swing is
/// nearer to the typical one: a stiff leg swings slowly, and the other one does not.
fn factor_of_people(strides: &TimesAndDistances, leg_m: f64, gravity: f64) -> Option<f64> {
    let leg_s = (leg_m / gravity).sqrt();
    let walk_ratio = strides.spread(StrideQuantity::WalkRatio, None)?.mean / (leg_m * leg_s);
    let swings = Side::BOTH.into_iter().filter_map(|side| strides.spread(StrideQuantity::SwingTime, Some(side)));
    let swings = swings.map(|swing| swing.mean / (leg_s * TYPICAL[1]));
    let swing = swings.min_by(|a, b| by(*a).total_cmp(&by(*b)))?;
    Some((walk_ratio / TYPICAL[0] * swing).sqrt())
}

/// Moments about the expected centre of pressure in all whole single supports.
fn single_support(
    model: &Model,
    soles: &BySide<Option<Sole>>,
    analysis: &Analysis,
    stances: &Footfalls,
) -> Option<Vec<Moments>> {
    let needed = NeededWrenches::of(model, analysis)?;
    let grid = analysis.trajectory.grid();
    let [first_s, last_s] = [grid.start_s + EDGE_S, grid.end_s() - EDGE_S];
    let supports: Vec<(&Footfall, [f64; 2])> = stances.falls.iter().filter_map(|fall| alone(fall, stances)).collect();
    let up = model.up();
    let mut moments = Vec::new();
    each_body_motion(model, &analysis.trajectory, |i, bodies| {
        let time_s = grid.time(i);
        let inside = |span: &[f64; 2]| (span[0].max(first_s)..=span[1].min(last_s)).contains(&time_s);
        let Some((fall, [from, to])) = supports.iter().find(|(_, span)| inside(span)) else { return };
        let Some(sole) = &soles[fall.side] else { return };
        let [rear, _, tip] = sole.points.map(|point| bodies[point.body.index()].pose.place(point.place));
        let share = CENTER_PATH[0] + (CENTER_PATH[1] - CENTER_PATH[0]) * (time_s - from) / (to - from);
        let center = rear + (tip - rear) * share;
        let on_floor = center + up * (fall.floor_height_m - center.dot(&up));
        moments.push(Moments::of(&needed.frames[i], on_floor, up));
    });
    (moments.len() as f64 * grid.step_s > SHORTEST_S).then_some(moments)
}

/// The time during which a foot carries the body alone, if both its ends are known [s].
fn alone<'f>(fall: &'f Footfall, stances: &Footfalls) -> Option<(&'f Footfall, [f64; 2])> {
    let (strike, off) = (fall.strike_s?, fall.off_s?);
    let others = || stances.of(fall.side.other());
    let from = others().filter_map(|other| other.off_s).filter(|t| (strike..off).contains(t)).last()?;
    let to = others().filter_map(|other| other.strike_s).find(|t| (from..=off).contains(t))?;
    (to > from).then_some((fall, [from, to]))
}
