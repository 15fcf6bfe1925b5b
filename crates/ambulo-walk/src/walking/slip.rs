//! Slip of the feet during stance.

use super::feet::FootRecord;
use super::recording::WalkRecording;

/// A foot is in stance while it carries more than this [N].
const LOADED_N: f64 = 20.0;
/// An unloaded phase longer than this is a swing [s].
const SWING_S: f64 = 0.1;

/// Slip of the most loaded point of a sole over one stance [m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StanceSlip {
    /// Distance between the foremost and the rearmost position [m].
    pub excursion: f64,
    /// Length of the path [m].
    pub path: f64,
}

impl WalkRecording {
    /// Largest slip of all stances of both feet that begin and end after a row; `None` if no stance is complete.
    #[must_use]
    pub fn stance_slip(&self, first_row: usize) -> Option<StanceSlip> {
        worst_slip(&self.feet, self.grid().step_s, first_row)
    }
}

/// Largest slip of all stances of both feet that begin and end after a row, of rows that are `step_s` apart.
pub(crate) fn worst_slip(feet: &[FootRecord; 2], step_s: f64, first_row: usize) -> Option<StanceSlip> {
    let of_foot = |foot: &FootRecord| {
        stances((first_row..foot.force.len()).map(|row| (foot.force[row].y, foot.slip[row])), step_s)
    };
    let worse =
        |a: StanceSlip, b: StanceSlip| StanceSlip { excursion: a.excursion.max(b.excursion), path: a.path.max(b.path) };
    feet.iter().flat_map(of_foot).reduce(worse)
}

/// Slip during a stance.
#[derive(Debug, Clone, Copy, Default)]
struct FootPath {
    at: f64,
    rear: f64,
    front: f64,
    path: f64,
}

/// Slip of each complete stance, from the load [N] and the slip velocity [m/s] of each row.
pub fn stances(rows: impl Iterator<Item = (f64, f64)>, step_s: f64) -> Vec<StanceSlip> {
    let mut ended = Vec::new();
    // The first stance may have begun before the first row, so it is dropped.
    let (mut begun, mut path, mut unloaded) = (false, FootPath::default(), 0);
    for (carried, slip) in rows {
        if carried > LOADED_N {
            unloaded = 0;
            path.add(slip * step_s);
            continue;
        }
        unloaded += 1;
        if f64::from(unloaded) * step_s > SWING_S {
            if begun && path.path > 0.0 {
                ended.push(StanceSlip { excursion: path.front - path.rear, path: path.path });
            }
            (begun, path) = (true, FootPath::default());
        }
    }
    ended
}

impl FootPath {
    fn add(&mut self, step: f64) {
        self.at += step;
        self.path += step.abs();
        self.rear = self.rear.min(self.at);
        self.front = self.front.max(self.at);
    }
}
