//! Speed and phase as functions of time while the speed changes.
//!
//! Speed is constant between changes; each change is a quintic ramp r(u) = 10 u³ - 15 u⁴ + 6 u⁵, so V is C². Phase is the
//! integral of the cycle rate f(V):
//!
//! ```text
//! φ(t) = φ₀ + ∫ f(V(τ)) dτ,    φ' = f(V),    φ'' = f'(V) V'
//! ```
//!
//! On constant speed the integral is a product. On ramps, where f(V) = c Vᵇ is smooth, it is computed by Gauss-Legendre quadrature with 16
//! points on each half of the elapsed time. Pinned by: tests/gait_speed.rs (against Simpson's rule on 20000 panels: 1e-12 cycles).

use super::jet::Jet;
use super::stride::StrideLaw;

/// A change of speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedChange {
    /// Start [s].
    pub start_s: f64,
    /// Duration [s].
    pub duration_s: f64,
    /// Walking speed at the end [m/s].
    pub speed: f64,
}

/// A ramp of the law speed.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Ramp {
    start_s: f64,
    duration_s: f64,
    /// Dimensionless law speeds.
    from: f64,
    to: f64,
    /// Phase at start and end [cycles].
    phases: [f64; 2],
}

/// Law speed and phase as functions of time.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SpeedPlan {
    law: StrideLaw,
    /// Law speed before the first ramp.
    initial: f64,
    ramps: Vec<Ramp>,
}

/// Phase of the right foot and law speed at one instant.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Clock {
    /// Cycles of the right foot since its first foot strike.
    pub phase: Jet,
    /// Dimensionless speed at which the laws of the gait are evaluated.
    pub law_speed: Jet,
}

impl SpeedPlan {
    /// A constant law speed.
    pub(super) fn constant(law: StrideLaw, law_speed: f64) -> SpeedPlan {
        SpeedPlan { law, initial: law_speed, ramps: Vec::new() }
    }

    pub(super) fn law(&self) -> &StrideLaw {
        &self.law
    }

    /// End of the last ramp [s].
    pub(super) fn end_s(&self) -> Option<f64> {
        self.ramps.last().map(|ramp| ramp.start_s + ramp.duration_s)
    }

    /// Adds a ramp, which must not start before the end of the previous one.
    pub(super) fn add(&mut self, start_s: f64, duration_s: f64, to: f64) {
        let start = self.at(start_s);
        let from = self.ramps.last().map_or(self.initial, |ramp| ramp.to);
        let mut ramp = Ramp { start_s, duration_s, from, to, phases: [start.phase.value; 2] };
        ramp.phases[1] += ramp.turned(&self.law, duration_s);
        self.ramps.push(ramp);
    }

    /// Phase and speed at a time [s].
    pub(super) fn at(&self, time_s: f64) -> Clock {
        let begun = self.ramps.partition_point(|ramp| ramp.start_s <= time_s);
        let Some(ramp) = begun.checked_sub(1).map(|last| &self.ramps[last]) else {
            return self.steady(self.initial, 0.0, time_s);
        };
        let since = time_s - ramp.start_s;
        if since >= ramp.duration_s {
            return self.steady(ramp.to, ramp.phases[1], since - ramp.duration_s);
        }
        let law_speed = ramp.speed(since);
        let rate = self.law.cycle_rate(law_speed);
        let phase = ramp.phases[0] + ramp.turned(&self.law, since);
        Clock { phase: Jet::new(phase, rate.value, rate.rate), law_speed }
    }

    fn steady(&self, speed: f64, phase: f64, since_s: f64) -> Clock {
        let law_speed = Jet::constant(speed);
        let rate = self.law.cycle_rate(law_speed).value;
        Clock { phase: Jet::new(phase + rate * since_s, rate, 0.0), law_speed }
    }
}

impl Ramp {
    /// Law speed at a time [s] after its start.
    fn speed(&self, since_s: f64) -> Jet {
        let u = Jet::new(since_s / self.duration_s, 1.0 / self.duration_s, 0.0);
        let share = u * u * u * (u * (u * 6.0 - 15.0) + 10.0);
        share * (self.to - self.from) + self.from
    }

    /// Cycles turned until a time [s] after its start.
    fn turned(&self, law: &StrideLaw, until_s: f64) -> f64 {
        let half = 0.5 * until_s;
        let rate = |since_s: f64| law.cycle_rate(Jet::constant(self.speed(since_s).value)).value;
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
