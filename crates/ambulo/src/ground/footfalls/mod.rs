//! Which foot stands when, from the motion alone.

mod signals;
mod standing;

use crate::findings::Findings;
use crate::ground::phases::Contact;
use crate::ground::sole::Sole;
use crate::kinematics::Trajectory;
use crate::model::{Model, Side};
use crate::motion::{Event, EventKind};
use crate::spatial::Vec3;
use signals::foot_paths;

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
    soles: &[Option<Sole>; 2],
    findings: &mut Findings,
) -> Footfalls {
    let paths = foot_paths(model, trajectory, soles);
    let mut falls: Vec<Footfall> = paths.iter().flat_map(|path| standing::stances(path, trajectory.grid())).collect();
    let start = |fall: &Footfall| fall.strike_s.unwrap_or(f64::NEG_INFINITY);
    falls.sort_by(|a, b| start(a).total_cmp(&start(b)).then(a.side.cmp(&b.side)));
    if falls.is_empty() {
        findings.warn("footfalls.none", "no foot was seen to stand: the ground carries nobody in this motion");
    }
    let floor_velocity = standing::common_velocity(&falls);
    for fall in &mut falls {
        fall.floor_velocity = floor_velocity;
    }
    Footfalls { falls, floor_velocity }
}
