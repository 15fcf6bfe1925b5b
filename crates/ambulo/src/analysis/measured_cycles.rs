//! Cycles whose stance was measured and whose end was only seen; a mass that was weighed in a standing trial.
//!
//! Two plates catch one stance of each foot: no plate sees the next strike, but markers and the file's own events do. A cycle
//! that begins with a strike on a plate is whole for that foot's leg if the foot's next strike is known from anywhere.

use super::cycles::{Cycle, cycles};
use super::events::{Event, EventKind};
use super::recording::{Analysis, Mass, MassSource, WHOLE_BODY_SHARE};
use crate::model::Side;
use crate::motion::Window;
use crate::spatial::Vec3;

/// Events of one foot and kind closer than this are one [s].
const SAME_S: f64 = 0.15;

impl Analysis {
    /// Takes these events instead of those that the forces show by themselves; `measured` are those among them that plates saw. Cycles
    /// begin with strikes that plates saw: moments of a leg that stood beside them mean little.
    pub fn take_events(&mut self, measured: &[Event], all: &[Event]) {
        let grid = self.trajectory.grid();
        let inside = |e: &&Event| (grid.start_s..=grid.end_s()).contains(&e.time_s);
        self.events = all.iter().filter(inside).copied().collect();
        self.events.sort_by(|a, b| a.time_s.total_cmp(&b.time_s).then(a.side.cmp(&b.side)));
        let was_measured = |cycle: &Cycle| {
            let strike = Event { side: cycle.side, kind: EventKind::Strike, time_s: cycle.start_s };
            measured.iter().any(|event| is_same(event, &strike))
        };
        self.cycles = cycles(&self.events, grid).into_iter().filter(was_measured).collect();
        for i in 0..self.cycles.len() {
            let side = self.cycles[i].side;
            self.cycles[i].number = self.cycles[..=i].iter().filter(|cycle| cycle.side == side).count();
        }
    }

    /// The events of the forces, and those that were seen where forces show none; then as [`Analysis::take_events`].
    pub fn add_events(&mut self, seen: &[Event]) {
        let measured = self.events.clone();
        let others = seen.iter().filter(|event| !measured.iter().any(|known| is_same(known, event)));
        let all: Vec<Event> = measured.iter().chain(others).copied().collect();
        self.take_events(&measured, &all);
    }

    /// Weighs the body over one gait cycle anywhere inside the time in which plates measured everything, where no cycle from strike to
    /// strike did: walking repeats itself, so that the mean vertical force is m g from any instant on. `up` is the upward direction,
    /// `gravity` its acceleration [m/s²].
    pub fn weigh_within(&mut self, measured: Window, up: Vec3, gravity: f64) {
        let (Some(from), Some(to)) = (measured.from_s, measured.to_s) else { return };
        let strikes = |side: Side| {
            let of_side = move |e: &&Event| e.side == side && e.kind == EventKind::Strike;
            self.events.iter().filter(of_side).map(|e| e.time_s).collect::<Vec<f64>>()
        };
        let overlapping = |pair: &[f64]| (pair[0] < to && pair[1] > from).then_some(pair[1] - pair[0]);
        let periods: Vec<f64> = Side::BOTH
            .into_iter()
            .flat_map(|s| strikes(s).windows(2).filter_map(overlapping).collect::<Vec<_>>())
            .collect();
        let period = periods.iter().sum::<f64>() / periods.len() as f64;
        let grid = self.trajectory.grid();
        let (first, frames) = grid.inside(Window { from_s: Some(from), to_s: Some(from + period) });
        let has_a_cycle = period <= to - from;
        if !has_a_cycle || frames == 0 {
            return;
        }
        let vertical = |i: usize| self.ground.bodies.iter().map(|b| b.force[i].dot(&up)).sum::<f64>();
        let mean = (first..first + frames).map(vertical).sum::<f64>() / frames as f64;
        self.take_mass(mean / gravity, MassSource::Plates);
    }

    /// Takes what plates carried in a standing trial [kg] for the body's mass, where no whole gait cycle says it better. A mass more
    /// than 5 % beside the model's is not the whole body's, or not this person's.
    pub fn weigh_standing(&mut self, standing_kg: f64) {
        self.take_mass(standing_kg, MassSource::Standing);
    }

    fn take_mass(&mut self, kg: f64, source: MassSource) {
        if self.mass.source == MassSource::Model && (kg / self.mass.kg - 1.0).abs() <= WHOLE_BODY_SHARE {
            self.mass = Mass { kg, source };
        }
    }
}

fn is_same(a: &Event, b: &Event) -> bool {
    a.side == b.side && a.kind == b.kind && (a.time_s - b.time_s).abs() < SAME_S
}
