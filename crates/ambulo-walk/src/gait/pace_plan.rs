//! Pace and phase as functions of time while a figure walks, begins to walk and stands still.
//!
//! Four numbers describe a pace: the law speed, the step length and the step frequency relative to the start,
//! and the share of walking, 0 in standing and 1 in walking. They are constant between changes. During a change the
//! cycle rate follows a quintic ramp of time, r(u) = 10 u³ - 15 u⁴ + 6 u⁵, and phase is its integral:
//!
//! ```text
//! φ(t) = φ₀ + ∫ f dτ,    f = w c f(V*),    V = w² l c V*√(gL)
//! ```
//!
//! with the law speed V*, the relative step length l and frequency c, and the share of walking w, which scales both
//! step length and frequency. The angles follow ramps of phase, one in each single support within the change, because
//! two feet on the ground cannot change their distance: R(φ) = Σ wₖ r((φ - aₖ)/(bₖ - aₖ)), with weights wₖ in
//! proportion to the durations bₖ - aₖ. If there is no whole single support within the change, there is one ramp from
//! its start to its end. In a halt, a single support that begins within a fifth of a cycle is left out, because the
//! figure has slowed down only little. Phase and pace are C².
//!
//! On constant pace the integral is a product. On ramps, where f is smooth, it is computed by Gauss-Legendre quadrature
//! with 16 points on each half of the elapsed time. Pinned by: tests/gait_speed.rs (against Simpson's rule on 20000
//! panels: 1e-12 cycles).

use super::jet::Jet;
use super::stride::StrideLaw;
use crate::model::Side;

/// A change of pace while walking. Values that are not given follow from the others, as in [`Pace`](super::Pace).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PaceChange {
    /// Start [s].
    pub start_s: f64,
    /// Duration [s]; `None` for two steps at the pace before the change, for four steps from standing, and to standing
    /// for as long as it takes to end with a swing (3 to 6 steps at the pace before).
    pub duration_s: Option<f64>,
    /// Walking speed at the end [m/s]; 0 to stand still.
    pub speed: Option<f64>,
    /// Step length at the end [m].
    pub step_length: Option<f64>,
    /// Step frequency at the end [steps/s].
    pub step_frequency: Option<f64>,
}

impl PaceChange {
    /// Whether the figure stands still after the change.
    #[must_use]
    pub(crate) fn is_halt(&self) -> bool {
        self.speed == Some(0.0)
    }
}

/// A pace that does not change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SteadyPace {
    /// Dimensionless law speed.
    pub(super) law_speed: f64,
    /// Step length relative to the plan's law.
    pub(super) length: f64,
    /// Step frequency relative to the plan's law.
    pub(super) cadence: f64,
    /// Whether the figure walks; otherwise it stands.
    pub(super) walks: bool,
}

/// A ramp from one pace to another.
#[derive(Debug, Clone, PartialEq)]
struct Ramp {
    start_s: f64,
    duration_s: f64,
    from: SteadyPace,
    to: SteadyPace,
    /// Phase at start and end [cycles].
    phases: [f64; 2],
    /// Start and end [cycles] of the parts in which the angles change.
    windows: Vec<[f64; 2]>,
}

/// Pace and phase as functions of time.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PacePlan {
    law: StrideLaw,
    /// Pace before the first ramp.
    initial: SteadyPace,
    /// Cycles per second at its law speed, which is needed at almost every instant.
    initial_rate: Jet,
    /// Phase at time zero [cycles].
    initial_phase: f64,
    ramps: Vec<Ramp>,
}

/// Phase of the right foot and pace at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// Cycles of the right foot since its first foot strike.
    pub phase: Jet,
    /// Dimensionless speed at which the laws of the gait are evaluated.
    pub law_speed: Jet,
    /// Step length relative to that at the start of the walk.
    pub length: Jet,
    /// Step frequency relative to that at the start of the walk.
    pub cadence: Jet,
    /// 1 in walking, 0 in upright standing; between them all angles are between the two.
    pub walking: Jet,
}

/// The largest whole number of cycles that is not above a phase; as `floor`, which is a call of a function on
/// processors without SSE 4.1.
pub(super) fn whole_cycles(phase: f64) -> f64 {
    let cut = phase as i64 as f64;
    if cut > phase { cut - 1.0 } else { cut }
}

impl Default for Clock {
    fn default() -> Clock {
        Clock::steady(Jet::ZERO, Jet::ZERO)
    }
}

impl Clock {
    /// A clock of a walk whose steps keep their length and frequency.
    #[must_use]
    pub fn steady(phase: Jet, law_speed: Jet) -> Clock {
        let one = Jet::constant(1.0);
        Clock { phase, law_speed, length: one, cadence: one, walking: one }
    }

    /// Cycles of the foot of a side; the left foot is half a cycle behind.
    #[must_use]
    pub(crate) fn phase_of(&self, side: Side) -> Jet {
        match side {
            Side::Right => self.phase,
            Side::Left => self.phase + 0.5,
        }
    }

    /// Whether the figure stands still.
    #[must_use]
    pub fn stands(&self) -> bool {
        self.walking == Jet::ZERO
    }
}

impl SteadyPace {
    /// The share of walking.
    fn walking(&self) -> f64 {
        if self.walks { 1.0 } else { 0.0 }
    }

    fn clock(&self, phase: Jet) -> Clock {
        let [law_speed, length, cadence, walking] =
            [self.law_speed, self.length, self.cadence, self.walking()].map(Jet::constant);
        Clock { phase, law_speed, length, cadence, walking }
    }
}

impl PacePlan {
    /// A constant pace.
    pub(super) fn constant(law: StrideLaw, initial: SteadyPace, initial_phase: f64) -> PacePlan {
        let initial_rate = law.cycle_rate(Jet::constant(initial.law_speed));
        PacePlan { law, initial, initial_rate, initial_phase, ramps: Vec::new() }
    }

    pub(super) fn law(&self) -> &StrideLaw {
        &self.law
    }

    /// `StrideLaw::cycle_rate`.
    pub(super) fn cycle_rate(&self, law_speed: Jet) -> Jet {
        let is_initial = law_speed == Jet::constant(self.initial.law_speed);
        if is_initial { self.initial_rate } else { self.law.cycle_rate(law_speed) }
    }

    /// Whether the pace never changes.
    pub(super) fn is_constant(&self) -> bool {
        self.ramps.is_empty()
    }

    /// End of the last ramp [s].
    pub(super) fn end_s(&self) -> Option<f64> {
        self.ramps.last().map(|ramp| ramp.start_s + ramp.duration_s)
    }

    /// Pace after the last ramp.
    pub(super) fn last(&self) -> SteadyPace {
        self.ramps.last().map_or(self.initial, |ramp| ramp.to)
    }

    /// The last ramp that has begun at a time [s], and how much of it the angles have taken, 0 to 1; `None` before the
    /// first ramp.
    pub(super) fn progress(&self, time_s: f64) -> Option<(usize, Jet)> {
        let last = self.ramps.partition_point(|ramp| ramp.start_s <= time_s).checked_sub(1)?;
        let ramp = &self.ramps[last];
        let since_s = time_s - ramp.start_s;
        if since_s >= ramp.duration_s {
            return Some((last, Jet::constant(1.0)));
        }
        Some((last, ramp.share_of_angles(ramp.phase(&self.law, since_s))))
    }

    /// Start of each ramp, its duration [s], and the paces before and after it.
    pub(super) fn ramps(&self) -> impl Iterator<Item = (f64, f64, SteadyPace, SteadyPace)> {
        self.ramps.iter().map(|ramp| (ramp.start_s, ramp.duration_s, ramp.from, ramp.to))
    }

    /// Adds a ramp, which must not start before the end of the previous one. From standing, it begins with the law
    /// speed and steps of its end, because a standing figure shows neither. `foot_off` is the share of stance in the
    /// cycle.
    pub(super) fn add(&mut self, start_s: f64, duration_s: f64, to: SteadyPace, foot_off: f64) {
        let start = self.at(start_s);
        let last = self.last();
        let from = if last.walks { last } else { SteadyPace { walks: false, ..to } };
        let mut ramp = Ramp { start_s, duration_s, from, to, phases: [start.phase.value; 2], windows: Vec::new() };
        ramp.phases[1] += ramp.turned(&self.law, duration_s);
        ramp.windows = single_supports(ramp.phases, foot_off);
        let slowed = ramp.phases[0] + BEFORE_LAST_SWING - SLACK;
        if !to.walks && ramp.windows.iter().any(|[off, _]| *off >= slowed) {
            ramp.windows.retain(|[off, _]| *off >= slowed);
        }
        self.ramps.push(ramp);
    }

    /// Duration [s] of a halt that starts at a time [s] and has one whole single support in which the angles change, or
    /// two.
    pub(super) fn halt_s(&self, start_s: f64, foot_off: f64) -> f64 {
        let start = self.at(start_s).phase;
        let off = 0.5 * (2.0 * (start.value + BEFORE_LAST_SWING - foot_off) - SLACK).ceil() + foot_off;
        let landing = off + 1.0 - foot_off;
        // The share of walking, which the rate follows, has a mean of one half.
        2.0 * (landing + AFTER_LANDING - start.value) / start.rate
    }

    /// Phase and pace at a time [s].
    pub(super) fn at(&self, time_s: f64) -> Clock {
        // At its start, a ramp has the pace before it exactly: rounding could begin a single support.
        let begun = self.ramps.partition_point(|ramp| ramp.start_s < time_s);
        let Some(ramp) = begun.checked_sub(1).map(|last| &self.ramps[last]) else {
            return self.steady(self.initial, self.initial_phase, time_s);
        };
        let since = time_s - ramp.start_s;
        if since >= ramp.duration_s {
            return self.steady(ramp.to, ramp.phases[1], since - ramp.duration_s);
        }
        let phase = ramp.phase(&self.law, since);
        ramp.between(ramp.share_of_angles(phase), phase)
    }

    fn steady(&self, pace: SteadyPace, phase: f64, since_s: f64) -> Clock {
        let clock = pace.clock(Jet::ZERO);
        let rate = (self.cycle_rate(clock.law_speed) * clock.cadence * clock.walking).value;
        pace.clock(Jet::new(phase + rate * since_s, rate, 0.0))
    }

    /// Cycles per second of a pace, without the share of walking.
    pub(super) fn rate_in_walking(&self, pace: SteadyPace) -> f64 {
        cycle_rate(&self.law, &SteadyPace { walks: true, ..pace }.clock(Jet::ZERO)).value
    }
}

/// Cycles per second at a clock whose phase is not read.
fn cycle_rate(law: &StrideLaw, clock: &Clock) -> Jet {
    law.cycle_rate(clock.law_speed) * clock.cadence * clock.walking
}

/// The single supports within a span of phase of the right foot; the whole span if there is none.
fn single_supports([first, last]: [f64; 2], foot_off: f64) -> Vec<[f64; 2]> {
    // Every step has one, from the foot off of one side to the next strike of the same side.
    let steps = (2.0 * first).floor() as i64 - 1..=(2.0 * last).ceil() as i64;
    let supports = steps.map(|step| {
        let strike = 0.5 * step as f64;
        [strike + foot_off - 0.5, strike + 0.5]
    });
    let inside: Vec<[f64; 2]> =
        supports.filter(|[from, to]| from < to && *from >= first - SLACK && *to <= last + SLACK).collect();
    if inside.is_empty() { vec![[first, last]] } else { inside }
}

/// A figure that halts does not change its angles in a swing that begins within this share of a cycle: it has hardly
/// slowed down.
const BEFORE_LAST_SWING: f64 = 0.2;
/// Share of the cycle from the last landing to the end of a halt without a given duration. The cycle rate ends so
/// gently that a swing until the very end would take seconds.
const AFTER_LANDING: f64 = 0.2;
/// Single supports may begin that much before a change [cycles]: a figure that begins to walk does so at a foot off.
const SLACK: f64 = 1e-9;

/// r(u) = 10 u³ - 15 u⁴ + 6 u⁵ between 0 and 1.
fn ramp(u: Jet) -> Jet {
    if u.value <= 0.0 {
        Jet::ZERO
    } else if u.value >= 1.0 {
        Jet::constant(1.0)
    } else {
        u * u * u * (u * (u * 6.0 - 15.0) + 10.0)
    }
}

impl Ramp {
    /// The pace after a share of the change.
    fn between(&self, share: Jet, phase: Jet) -> Clock {
        let between = |of: fn(&SteadyPace) -> f64| share * (of(&self.to) - of(&self.from)) + of(&self.from);
        Clock {
            phase,
            law_speed: between(|pace| pace.law_speed),
            length: between(|pace| pace.length),
            cadence: between(|pace| pace.cadence),
            walking: between(SteadyPace::walking),
        }
    }

    /// The pace that the cycle rate follows at a time [s] after its start, with phase zero.
    fn clock(&self, since_s: f64) -> Clock {
        let share = ramp(Jet::new(since_s / self.duration_s, 1.0 / self.duration_s, 0.0));
        self.between(share, Jet::ZERO)
    }

    /// The phase at a time [s] after its start.
    fn phase(&self, law: &StrideLaw, since_s: f64) -> Jet {
        let rate = cycle_rate(law, &self.clock(since_s));
        Jet::new(self.phases[0] + self.turned(law, since_s), rate.value, rate.rate)
    }

    /// Share of the change that the angles have taken at a phase.
    fn share_of_angles(&self, phase: Jet) -> Jet {
        let total: f64 = self.windows.iter().map(|[from, to]| to - from).sum();
        let parts =
            self.windows.iter().map(|[from, to]| ramp((phase - *from) * (1.0 / (to - from))) * ((to - from) / total));
        parts.fold(Jet::ZERO, |sum, part| sum + part)
    }

    /// Cycles turned until a time [s] after its start.
    fn turned(&self, law: &StrideLaw, until_s: f64) -> f64 {
        let half = 0.5 * until_s;
        let rate = |since_s: f64| cycle_rate(law, &self.clock(since_s)).value;
        let panel = |from: f64| {
            let middle = from + 0.5 * half;
            let pairs = NODES.iter().zip(WEIGHTS);
            pairs.map(|(x, w)| w * (rate(middle - 0.5 * half * x) + rate(middle + 0.5 * half * x))).sum::<f64>()
        };
        0.5 * half * (panel(0.0) + panel(half))
    }
}

/// Positive zeros of the Legendre polynomial of degree 16, and the weights of the quadrature.
const NODES: [f64; 8] = [
    0.095_012_509_837_637_44,
    0.281_603_550_779_258_9,
    0.458_016_777_657_227_4,
    0.617_876_244_402_643_7,
    0.755_404_408_355_003,
    0.865_631_202_387_831_7,
    0.944_575_023_073_232_6,
    0.989_400_934_991_649_9,
];
const WEIGHTS: [f64; 8] = [
    0.189_450_610_455_068_5,
    0.182_603_415_044_923_6,
    0.169_156_519_395_002_54,
    0.149_595_988_816_576_73,
    0.124_628_971_255_533_87,
    0.095_158_511_682_492_78,
    0.062_253_523_938_647_89,
    0.027_152_459_411_754_095,
];
