//! Detects stances from the motion alone: foot strikes, foot offs, floor heights, the speed of a treadmill's belt.
//!
//! No walking direction or floor height is assumed; only feet are considered. A foot is represented by three points
//! of its sole ([`Sole`]); a foot without a sole is left out.
//!
//! 1. **Floor velocity** (`belt`): centre of the velocities of the lower foot while the body is supported; zero below
//!    0.03 √(g L).
//! 2. **Stationary feet** (`stationary`): the slowest point of a foot is slower than 0.4 V (at least 0.03 √(g L))
//!    relative to the floor for 0.05 s or more, while the vertical ground force exceeds 0.15 of body weight. A foot
//!    held still in the air next to the stance foot is excluded: the line of action of the force passes far from it.
//! 3. **Times** (`instants`), between frames: the strike is the mean of two times, the fastest descent of the lowest
//!    point and its speed falling below V/2; at the off the speed of the last point rises above 0.6 √(g L) (V/√(g
//!    L))^⅜.
//! 4. **Floor height** (`floor`): median height of the lowest point; stances within 4 cm share one floor.
//!
//! | symbol | meaning                                                                                   |
//! |--------|-------------------------------------------------------------------------------------------|
//! | V      | horizontal speed of the mass centre relative to the floor, mean over ± √(L/g) [m/s]       |
//! | L, g   | hip to ground [m], gravity [m/s²]: √(g L) is 3 m/s, √(L/g) 0.3 s for an adult (Hof 1996)  |
//!
//! **Errors** relative to force plates (20 N; tests/footfalls.rs; motion filtered at 6 Hz; detected - plates, mean and
//! mean magnitude, ms):
//!
//! | recording                  | strikes      | offs         |
//! |----------------------------|--------------|--------------|
//! | gait2392, markers          | +14.6, 14.6  | +1.7, 2.1    |
//! | gait2392, given angles     | +11.7, 11.7  | +1.5, 2.0    |
//! | rajagopal-walk             | +21.7, 21.7  | -25.3, 25.3  |
//! | rajagopal-run              | +12.7, 12.7  | +4.0, 4.6    |
//! | HC032A03, woman            | -5.3, 5.3    | -1.7, 3.3    |
//! | HC002D06, child            | -7.4, 7.4    | +11.9, 11.9  |
//! | PiG_Motion3                | -21.5, 21.5  | -2.0, 2.8    |
//! | HC032A18, woman turning    | -13.5, 13.5  | +20.1, 20.1  |
//! | HC002D25, child turning    | -15.1, 15.1  | +16.0, 16.0  |
//! | mean                       | 13.7         | 9.8          |
//!
//! Within a recording the errors scatter by 2 to 8 ms; the rest differs between laboratories, partly because of the
//! plates: the forces of the three OpenSim recordings were low-pass filtered before publication (they rise from 20 to
//! 140 N in 20 to 30 ms, in running 5 to 10, unfiltered plates in 3 to 5); the same filter on unfiltered forces makes
//! strikes 20 to 28 ms early. At cut-offs of 6 to 12 Hz the means are 13.7 to 14.3 ms and 9.8 to 10.0 ms; no error
//! exceeds 30 ms.
//!
//! V/2 and the fastest descent have no fitted parameter, but were selected from some twenty signals with these
//! recordings. Factor and power of the off ([`OffSpeed`]) are the best of a grid over these six subjects (each counts
//! once: 10.1 ms). Leave-one-out errors are 2 to 30 ms, on average 12.5 ms. An offset fitted to the others increases
//! the error of most subjects, so there is none. tests/footfalls.rs repeats both.
//!
//! Sources: Ghoussayni, Stevens, Durham, Ewins 2004 and Bruening, Ridge 2014 (thresholds of speed), O'Connor, Thorpe,
//! O'Malley, Vaughan 2007 (vertical velocity), as described in a review (cited in [`super::foot_motion`]); Hof,
//! "Scaling gait data to body size", Gait & Posture 1996 (unverified).
//!
//! Cost: 1.2 to 2 microseconds per frame, linear in frames; about 450 bytes per frame while it runs.
//! Not handled: belts of different speed under the two feet. A foot that slides under load is detected only where it is
//! slow enough. Pinned by: tests/footfalls.rs, tests/footfalls_synthetic.rs, tests/footfalls_puppet.rs

mod backwards;
mod belt;
mod floor;
mod instants;
mod signals;
mod stationary;

use crate::findings::{Code, Findings};
use crate::ground::phases::Contact;
use crate::kinematics::Trajectory;
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model, Side};
use crate::motion::{Event, EventKind};
use crate::numerics::Order;
use crate::spatial::Vec3;
pub(super) use backwards::{FRAMES, walks_backwards};
use belt::Belt;
#[doc(hidden)]
pub use instants::OffSpeed;
use instants::Search;
pub(super) use signals::{SignalFrame, Signals};
use std::ops::Range;

/// One stance of one foot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Footfall {
    /// Side of the foot.
    pub side: Side,
    /// Foot strike [s]; `None` if the foot was on the ground when the recording began.
    pub strike_s: Option<f64>,
    /// Foot off [s]; `None` if the foot was on the ground when the recording ended.
    pub off_s: Option<f64>,
    /// Height of the floor above the world's origin [m].
    pub floor_height_m: f64,
    /// Velocity of the floor [m/s]: of the belt of a treadmill, exactly zero on a floor at rest.
    pub floor_velocity: Vec3,
}

/// The stances of both feet.
#[derive(Debug, Clone, PartialEq)]
pub struct Footfalls {
    /// Footfalls in order of time.
    pub falls: Vec<Footfall>,
    /// Velocity of the floor over the whole recording [m/s]; exactly zero if it does not move.
    pub floor_velocity: Vec3,
}

impl Footfall {
    /// The stance as a contact.
    #[must_use]
    pub fn contact(&self) -> Contact {
        Contact { strike_s: self.strike_s, off_s: self.off_s }
    }
}

impl Footfalls {
    /// The stances of one foot, in order of time.
    pub fn of(&self, side: Side) -> impl Iterator<Item = &Footfall> {
        self.falls.iter().filter(move |fall| fall.side == side)
    }

    /// Strikes and offs in order of time, without the ends at which the recording cuts a stance.
    #[must_use]
    pub fn events(&self) -> Vec<Event> {
        let mut out = Vec::new();
        for fall in &self.falls {
            for (kind, time) in [(EventKind::Strike, fall.strike_s), (EventKind::Off, fall.off_s)] {
                out.extend(time.map(|time_s| Event { side: fall.side, kind, time_s }));
            }
        }
        out.sort_by_numbers(|event| [event.time_s, event.side.rank()]);
        out
    }
}

/// Detects the stances of both feet; a foot without a sole is left out.
#[must_use]
pub fn footfalls(
    model: &Model,
    trajectory: &Trajectory,
    soles: &BySide<Option<Sole>>,
    findings: &mut Findings,
) -> Footfalls {
    footfalls_at(model, trajectory, soles, OffSpeed::default(), findings)
}

/// As [`footfalls`], with a given threshold of speed for foot off.
#[must_use]
pub fn footfalls_at(
    model: &Model,
    trajectory: &Trajectory,
    soles: &BySide<Option<Sole>>,
    off_speed: OffSpeed,
    findings: &mut Findings,
) -> Footfalls {
    detect(&Signals::new(model, trajectory, soles), off_speed, findings)
}

/// Detects the stances from their signals.
pub(super) fn detect(signals: &Signals, off_speed: OffSpeed, findings: &mut Findings) -> Footfalls {
    let belt = Belt::new(signals);
    if !signals.is_backwards(belt.overall) {
        return detect_forwards(signals, &belt, off_speed, findings);
    }
    let back = signals.played_back();
    let ends_s = signals.grid.start_s + signals.grid.end_s();
    detect_forwards(&back, &Belt::new(&back), off_speed, findings).played_back(ends_s)
}

/// Detects the stances of a person who does not walk backwards.
fn detect_forwards(signals: &Signals, belt: &Belt, off_speed: OffSpeed, findings: &mut Findings) -> Footfalls {
    let walking = stationary::walking_speed(signals, belt);
    let mut runs: Vec<_> =
        signals.feet.iter().map(|foot| stationary::stationary(signals, belt, &walking, foot)).collect();
    stationary::keep_loaded(signals, &mut runs);
    let mut falls = Vec::new();
    for (foot, runs) in signals.feet.iter().zip(&runs) {
        let search = Search { signals, belt, walking: &walking, foot, off_speed };
        let mut of_foot: Vec<Footfall> = (0..runs.len()).map(|i| footfall(&search, runs, i)).collect();
        put_in_order(&mut of_foot);
        falls.extend(of_foot);
    }
    floor::share_floors(&mut falls);
    if falls.is_empty() {
        let why = if signals.feet.is_empty() {
            "the model has no foot with a known sole, so no stance phase was detected. hint: feet are found at the \
             ends of legs with hip, \
             knee and ankle"
        } else {
            "no stance phase was detected: no foot stays on the ground in this motion"
        };
        findings.report(Code::FootfallsNone, why);
    }
    let speed = belt.overall.norm();
    if speed > 0.0 {
        let message = format!(
            "the floor moves at {speed:.2} m/s under the feet, as on a treadmill: speeds of feet are relative to the \
             belt"
        );
        findings.report(Code::FootfallsBelt, message);
    }
    Footfalls { falls: in_order(falls), floor_velocity: belt.overall }
}

/// Footfalls in order of time.
fn in_order(mut falls: Vec<Footfall>) -> Vec<Footfall> {
    let start = |fall: &Footfall| fall.strike_s.unwrap_or(f64::NEG_INFINITY);
    falls.sort_by_numbers(|fall| [start(fall), fall.side.rank()]);
    falls
}

/// The stance of one of the times at which a foot is stationary.
fn footfall(search: &Search<'_>, runs: &[Range<usize>], number: usize) -> Footfall {
    let run = &runs[number];
    let before = number.checked_sub(1).map(|last| runs[last].end);
    Footfall {
        side: search.foot.side,
        strike_s: search.strike(run, before),
        off_s: search.off(run, runs.get(number + 1).map(|next| next.start)),
        floor_height_m: floor::height(search.signals, search.foot, run),
        floor_velocity: search.belt.velocity((run.start + run.end) / 2),
    }
}

/// Makes strikes and offs of a foot alternate: where a foot hardly swings, an off may be detected after the next
/// strike. Both are then moved to the middle between the two.
fn put_in_order(falls: &mut [Footfall]) {
    for i in 1..falls.len() {
        if let (Some(off), Some(strike)) = (falls[i - 1].off_s, falls[i].strike_s)
            && off > strike
        {
            let middle = Some(0.5 * (off + strike));
            (falls[i - 1].off_s, falls[i].strike_s) = (middle, middle);
        }
    }
    for fall in falls {
        if let (Some(strike), Some(off)) = (fall.strike_s, fall.off_s) {
            fall.off_s = Some(off.max(strike));
        }
    }
}
