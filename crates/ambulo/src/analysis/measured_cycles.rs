//! Cycles whose stance was measured and whose end was only seen.
//!
//! Two plates catch one stance of each foot: no plate sees the next strike, but markers and the file's own events do. A cycle
//! that begins with a strike on a plate is whole for that foot's leg if the foot's next strike is known from anywhere.

use super::cycles::{Cycle, cycles};
use super::events::{Event, EventKind};
use super::recording::Analysis;

/// Events of one foot and kind closer than this are one [s].
const SAME_S: f64 = 0.15;

impl Analysis {
    /// Adds events that forces did not show, and the cycles that begin with a strike that they did show. Without forces there are
    /// no cycles to add: moments of legs that stood on nothing mean little.
    pub fn complete_events(&mut self, seen: &[Event]) {
        let grid = self.trajectory.grid();
        let measured = self.events.clone();
        let inside = |e: &&Event| (grid.start_s..=grid.end_s()).contains(&e.time_s);
        for event in seen.iter().filter(inside) {
            if !measured.iter().any(|known| is_same(known, event)) {
                self.events.push(*event);
            }
        }
        self.events.sort_by(|a, b| a.time_s.total_cmp(&b.time_s).then(a.side.cmp(&b.side)));
        let was_measured = |cycle: &Cycle| {
            let strike = Event { side: cycle.side, kind: EventKind::Strike, time_s: cycle.start_s };
            measured.iter().any(|event| event.kind == EventKind::Strike && is_same(event, &strike))
        };
        self.cycles = cycles(&self.events, grid).into_iter().filter(was_measured).collect();
        for i in 0..self.cycles.len() {
            let side = self.cycles[i].side;
            self.cycles[i].number = self.cycles[..=i].iter().filter(|cycle| cycle.side == side).count();
        }
    }
}

fn is_same(a: &Event, b: &Event) -> bool {
    a.side == b.side && a.kind == b.kind && (a.time_s - b.time_s).abs() < SAME_S
}
