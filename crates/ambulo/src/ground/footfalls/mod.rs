//! Which foot stands when, from the motion alone: strikes, offs, the height of each floor, the speed of a belt.
//!
//! Neither a direction of walking nor a height of the floor is taken for granted, and nothing but feet is looked at. A foot is three points
//! of its sole ([`Sole`]); a foot without a sole is left out.
//!
//! 1. **Floor's velocity** (`belt`): where the velocities of the lower foot gather while the body is carried; zero below 0.03 √(g L).
//! 2. **Still** (`still`): the slowest of a foot's points goes, against the floor, slower than 0.4 V (0.03 √(g L) at least) for 0.05 s or
//!    more, while the body needs more than 0.15 of its weight from the ground. A foot that is held in the air beside one that stands is not
//!    still: the force from Newton's law passes by it.
//! 3. **Instants** (`instants`), between frames: the strike is the mean of two, the lowest point's fastest descent and its speed falling below
//!    V/2; at the off the last point's speed rises above 0.6 √(g L) (V/√(g L))^⅜.
//! 4. **Floor's height** (`floor`): the median height of the lowest point, stances within 4 cm sharing one floor.
//!
//! | symbol | meaning                                                                                   |
//! |--------|-------------------------------------------------------------------------------------------|
//! | V      | speed of the mass centre against the floor, level, mean over ± √(L/g) [m/s]               |
//! | L, g   | hip to ground [m], gravity [m/s²]: √(g L) is 3 m/s, √(L/g) 0.3 s for an adult (Hof 1996)  |
//!
//! **Errors** against plates (20 N; tests/footfalls.rs; motion low-passed at 6 Hz; found - plates, mean and mean of magnitudes, ms):
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
//! Within a recording they scatter by 2 to 8 ms; what is left differs from laboratory to laboratory. Some of it is the plates': the forces
//! of the three OpenSim recordings were low-passed before they were published (they need 20 to 30 ms from 20 to 140 N, in running 5 to 10,
//! where untouched plates need 3 to 5); the same filter on untouched forces makes strikes 20 to 28 ms early. At cut-offs of 6 to 12 Hz the
//! means are 13.7 to 14.3 ms and 9.8 to 10.0 ms; no event is off by more than 30 ms.
//!
//! V/2 and the fastest descent have no fitted number, but were chosen from some twenty signals by looking at these recordings. Factor and
//! power of the off ([`OffSpeed`]) are the best of a grid over these six people (each counts once: 10.1 ms); fitted without a person they
//! leave 2 to 30 ms for that person, 12.5 ms in the mean. An offset fitted to the others makes the error of most people larger, so
//! there is none. tests/footfalls.rs repeats both.
//!
//! Sources: Ghoussayni, Stevens, Durham, Ewins 2004 and Bruening, Ridge 2014 (thresholds of speed), O'Connor, Thorpe, O'Malley, Vaughan
//! 2007 (vertical velocity), as a review tells them ([`super::foot_motion`] names it); Hof, "Scaling gait data to body size", Gait & Posture
//! 1996 (unverified).
//!
//! Cost: 1.2 to 2 microseconds a frame, linear in frames; some 450 bytes a frame while it runs.
//! Not handled: a foot that slides while it carries is found where it is slow enough; belts of different speed under the two feet.
//! Pinned by: tests/footfalls.rs, tests/footfalls_synthetic.rs, tests/footfalls_puppet.rs

mod belt;
mod floor;
mod instants;
mod signals;
mod still;

use crate::findings::{Code, Findings};
use crate::ground::phases::Contact;
use crate::kinematics::Trajectory;
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model, Side};
use crate::motion::{Event, EventKind};
use crate::spatial::Vec3;
use belt::Belt;
pub use instants::OffSpeed;
use instants::Search;
use signals::Signals;
use std::ops::Range;

/// One stance of one foot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Footfall {
    /// Which foot.
    pub side: Side,
    /// When it meets the ground [s]; `None` if it stood when the recording began.
    pub strike_s: Option<f64>,
    /// When it leaves the ground [s]; `None` if it still stood when the recording ended.
    pub off_s: Option<f64>,
    /// Height of what it stands on, along the direction against gravity, from the world's origin [m].
    pub floor_height_m: f64,
    /// Velocity of what it stands on [m/s]: that of a treadmill's belt, exactly zero on a floor.
    pub floor_velocity: Vec3,
}

/// The stances of both feet.
#[derive(Debug, Clone, PartialEq)]
pub struct Footfalls {
    /// In order of time.
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

    /// Strikes and offs in order of time; none where the recording cuts a stance.
    #[must_use]
    pub fn events(&self) -> Vec<Event> {
        let mut out = Vec::new();
        for fall in &self.falls {
            for (kind, time) in [(EventKind::Strike, fall.strike_s), (EventKind::Off, fall.off_s)] {
                out.extend(time.map(|time_s| Event { side: fall.side, kind, time_s }));
            }
        }
        out.sort_by(|a, b| a.time_s.total_cmp(&b.time_s).then(a.side.cmp(&b.side)));
        out
    }
}

/// When the feet stand. `soles` are those of the right and the left foot; a foot without one is left out.
#[must_use]
pub fn footfalls(
    model: &Model,
    trajectory: &Trajectory,
    soles: &BySide<Option<Sole>>,
    findings: &mut Findings,
) -> Footfalls {
    footfalls_at(model, trajectory, soles, OffSpeed::default(), findings)
}

/// As [`footfalls`], with another speed at which feet have left.
#[must_use]
pub fn footfalls_at(
    model: &Model,
    trajectory: &Trajectory,
    soles: &BySide<Option<Sole>>,
    left: OffSpeed,
    findings: &mut Findings,
) -> Footfalls {
    let signals = Signals::new(model, trajectory, soles);
    let belt = Belt::new(&signals);
    let walking = still::walking_speed(&signals, &belt);
    let mut runs: Vec<_> = signals.feet.iter().map(|foot| still::still(&signals, &belt, &walking, foot)).collect();
    still::keep_loaded(&signals, &mut runs);
    let mut falls = Vec::new();
    for (foot, runs) in signals.feet.iter().zip(&runs) {
        let search = Search { signals: &signals, belt: &belt, walking: &walking, foot, left };
        let mut of_foot: Vec<Footfall> = (0..runs.len()).map(|i| footfall(&search, runs, i)).collect();
        take_turns(&mut of_foot);
        falls.extend(of_foot);
    }
    floor::share_floors(&mut falls);
    let start = |fall: &Footfall| fall.strike_s.unwrap_or(f64::NEG_INFINITY);
    falls.sort_by(|a, b| start(a).total_cmp(&start(b)).then(a.side.cmp(&b.side)));
    if falls.is_empty() {
        let why = if signals.feet.is_empty() {
            "the model has no foot with a known sole, so no stance phase was detected. hint: feet are found at the ends of legs with hip, \
             knee and ankle"
        } else {
            "no stance phase was detected: no foot rests on the ground in this motion"
        };
        findings.report(Code::FootfallsNone, why);
    }
    let speed = belt.overall.norm();
    if speed > 0.0 {
        let message = format!(
            "the floor moves at {speed:.2} m/s under the feet: speeds of feet are counted from a treadmill's belt"
        );
        findings.report(Code::FootfallsBelt, message);
    }
    Footfalls { falls, floor_velocity: belt.overall }
}

/// The stance that belongs to one of the times at which a foot is still.
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

/// Strikes and offs of a foot take turns: where a foot hardly swings, an off may be found after the strike that follows. Both are then put
/// between the two.
fn take_turns(falls: &mut [Footfall]) {
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
