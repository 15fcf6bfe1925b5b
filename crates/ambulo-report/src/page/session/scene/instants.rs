//! The instants shown for a scene, and how rows of tables are assigned to them.

use crate::page::contract::TimeAxis;
use crate::stage::csv_rows::Row;
use ambulo::motion::TimeGrid;
use ambulo_results::{ENERGY, Folder, JOINTS, POSES, ResultsError};

/// Files with rows at every instant, and the start of their header.
const FILES: [(&str, &str); 3] = [(ENERGY, "time,"), (JOINTS, "time,"), (POSES, "time,")];
/// Longer runs are thinned to this number of instants, as in the 3-D view.
const MOST_INSTANTS: usize = 2000;

/// Evenly spaced instants.
pub(super) struct Instants {
    grid: TimeGrid,
}

impl Instants {
    /// The instants of the 3-D view, otherwise of the first table; `None` without tables.
    pub(super) fn of(folder: &Folder<'_>, viewed: Option<TimeAxis>) -> Result<Instants, ResultsError> {
        if let Some(TimeAxis { start_s, step_s, frames }) = viewed {
            return Ok(Instants { grid: TimeGrid { start_s, step_s, frames } });
        }
        for (file, head) in FILES {
            let Some(text) = folder.text(file)? else { continue };
            let mut times: Vec<f64> = Vec::new();
            for row in Row::all(folder, file, &text, head)? {
                let [time] = row.numbers(0)?;
                if times.last().is_none_or(|last| time > *last) {
                    times.push(time);
                }
            }
            let every = times.len().div_ceil(MOST_INSTANTS).max(1);
            let kept: Vec<f64> = times.into_iter().step_by(every).collect();
            if let Some(&start_s) = kept.first() {
                let one = TimeGrid { start_s, step_s: 0.0, frames: 1 };
                return Ok(Instants { grid: TimeGrid::spanning(&kept).unwrap_or(one) });
            }
        }
        Ok(Instants { grid: TimeGrid { start_s: 0.0, step_s: 0.0, frames: 0 } })
    }

    /// The instants in the form of the page.
    pub(super) fn axis(&self) -> TimeAxis {
        TimeAxis { start_s: self.grid.start_s, step_s: self.grid.step_s, frames: self.grid.frames }
    }

    /// Number of instants.
    pub(super) fn count(&self) -> usize {
        self.grid.frames
    }

    /// The index of the instant of a row, if it is one of these.
    pub(super) fn place(&self, time_s: f64) -> Option<usize> {
        if self.grid.frames < 2 {
            return (self.grid.frames == 1).then_some(0);
        }
        let place = ((time_s - self.grid.start_s) / self.grid.step_s).round();
        let inside = place >= 0.0 && place < self.grid.frames as f64;
        inside.then_some(place as usize)
    }

    /// Values at the instants, each from the nearest row; NaN if there is none.
    pub(super) fn nearest(&self, rows: &[(f64, f64)]) -> Vec<f64> {
        let mut values = vec![f64::NAN; self.grid.frames];
        let mut distances = vec![f64::INFINITY; self.grid.frames];
        for (time, value) in rows {
            let Some(place) = self.place(*time) else { continue };
            let distance = (time - self.grid.time(place)).abs();
            if distance < distances[place] {
                (values[place], distances[place]) = (*value, distance);
            }
        }
        values
    }
}
