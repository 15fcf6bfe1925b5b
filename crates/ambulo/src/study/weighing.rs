//! Weighs a person in motion by the ground forces.
//!
//! The upward impulse of the ground over a time T changes the momentum of the body (Newton):
//!
//! ```text
//! m (g T + v(end) - v(start)) = integral of F dt        v: upward velocity of the mass centre, from the motion [m/s]
//! ```
//!
//! The posture shows v whatever the mass is, because the segments keep their shares of it. The standard error of m is
//! the standard error of v(end) - v(start), multiplied by m / (g T). It is measured: with the best m the forces give
//! the velocity at every instant; its scatter about the velocity of the motion is the error. Times T are whole cycles
//! (strike to strike or off to off of one foot), steps from valley to valley of single supports, and any time during
//! which every loaded foot is measured. Where only single stances were measured, each foot of a symmetric gait supplies
//! half of the impulse of a stride. Pinned by: tests/weighing.rs

use super::mass::{MassEstimate, MassWitness};
use crate::analysis::BodyInMotion;
use crate::findings::Findings;
use crate::ground::footfalls::footfalls;
use crate::ground::phases::{Contact, SHORTEST_CONTACT_S, contacts_from_force};
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model, Side};
use crate::motion::{Event, EventKind, ForceRecording, TimeGrid, interpolate};
use crate::numerics::{Order, quantiles, sort_numbers};
use crate::spatial::Vec3;

/// Error of a velocity of the mass centre where the recording is too short to measure it [m/s]; it counts as much as
/// [`PRIOR_S`] of recording. Markers on soft tissue, filtered at 6 Hz, show less than this in steady walking.
const PRIOR_VELOCITY_M_S: f64 = 0.1;
const PRIOR_S: f64 = 0.5;
/// A shorter time does not determine the mass [s]: the prior error would be a twentieth of the body mass.
const SHORTEST_S: f64 = 0.3;
/// An event of the motion nearer to one of the forces is the same event [s].
const SAME_EVENT_S: f64 = 0.15;
/// Events may be outside of a measured time by this, because events of the motion end it [s].
const EDGE_S: f64 = 0.02;
/// Difference of the impulses of the two feet of a healthy walker over their mean, standard deviation, as a share.
/// Herzog, Nigg, Read, Olsson 1989, Med Sci Sports Exerc 21:110-114 found vertical forces within 4 % (unverified).
const ASYMMETRY: f64 = 0.04;
/// Standard error of the time between two foot strikes seen in the motion [s]: two frames of a usual camera at 100 Hz.
const STRIDE_ERROR_S: f64 = 0.02;

/// Ground forces and the motion of the body that they carry.
pub(super) struct Carried<'a> {
    forces: &'a [ForceRecording],
    /// The side of each force.
    sides: Vec<Option<Side>>,
    up: Vec3,
    gravity: f64,
    grid: TimeGrid,
    frame_times: Vec<f64>,
    /// Upward velocity of the mass centre [m/s].
    velocity: Vec<f64>,
    /// Times in which every foot on the ground was measured [s].
    windows: Vec<[f64; 2]>,
    /// Foot strikes and foot offs, from forces where there are some.
    events: Vec<Event>,
    /// Foot strikes and foot offs from forces alone.
    force_events: Vec<Event>,
    /// Stances that were measured from strike to off [s].
    stances: BySide<Vec<[f64; 2]>>,
    /// Times with a load on each foot [s].
    loaded: BySide<Vec<[f64; 2]>>,
}

/// The mass by the impulse of one time.
#[derive(Debug, Clone, Copy)]
struct Weighed {
    span: [f64; 2],
    kg: f64,
}

impl<'a> Carried<'a> {
    /// `body`: the body that followed markers, which has the feet on plates; without plates the motion shows which
    /// stances the forces lack.
    pub(super) fn new(
        model: &Model,
        trajectory: &Trajectory,
        forces: &'a [ForceRecording],
        soles: &BySide<Option<Sole>>,
        body: Option<&BodyInMotion>,
    ) -> Carried<'a> {
        let (up, grid) = (model.up(), trajectory.grid());
        let mut velocity = Vec::with_capacity(grid.frames);
        each_body_motion(model, trajectory, |_, bodies| {
            let momentum =
                model.bodies().iter().zip(bodies).map(|(body, m)| body.inertia.mass() * m.twist.linear.dot(&up));
            velocity.push(momentum.sum::<f64>() / model.mass());
        });
        let contacts = BySide::from_fn(|side| contacts_of(model, forces, up, side));
        let recorded = recorded(forces, grid);
        let loaded = BySide::from_fn(|side| contacts[side].iter().map(|c| c.span(recorded[0], recorded[1])).collect());
        let whole =
            BySide::from_fn(|side| contacts[side].iter().filter_map(|c| Some([c.strike_s?, c.off_s?])).collect());
        let mut carried = Carried {
            forces,
            sides: forces.iter().map(|force| model.anatomy().body_side(force.body)).collect(),
            up,
            gravity: model.gravity().norm(),
            grid,
            frame_times: grid.times(),
            velocity,
            windows: Vec::new(),
            events: Vec::new(),
            force_events: Vec::new(),
            stances: whole,
            loaded,
        };
        match body.filter(|body| !body.on_plates.contacts.is_empty()) {
            Some(body) => {
                carried.windows = body.on_plates.windows.clone();
                carried.stances = BySide::from_fn(|side| body.on_plates.measured_stances(side));
                carried.force_events = body.measured_events();
                carried.events = with_events(carried.force_events.clone(), &body.feet.events);
            }
            None => {
                let falls = footfalls(model, trajectory, soles, &mut Findings::default());
                carried.force_events = carried.loaded_events(&contacts);
                carried.events = with_events(carried.force_events.clone(), &falls.events());
                let seen = BySide::from_fn(|side| {
                    falls.of(side).map(|fall| fall.contact().span(recorded[0], recorded[1])).collect()
                });
                carried.windows = carried.windows_by_load(recorded, &seen);
            }
        }
        carried
    }

    fn loaded_events(&self, contacts: &BySide<Vec<Contact>>) -> Vec<Event> {
        let of_contact = |side: Side, contact: &Contact| {
            let event = move |kind, time_s: Option<f64>| time_s.map(|time_s| Event { side, kind, time_s });
            [event(EventKind::Strike, contact.strike_s), event(EventKind::Off, contact.off_s)]
        };
        let all = contacts.iter().flat_map(|(side, list)| list.iter().flat_map(move |c| of_contact(side, c)));
        all.flatten().collect()
    }

    /// The recorded time without stances that were detected in the motion and have no measured force.
    fn windows_by_load(&self, recorded: [f64; 2], seen: &BySide<Vec<[f64; 2]>>) -> Vec<[f64; 2]> {
        let mut free = if recorded[1] > recorded[0] { vec![recorded] } else { Vec::new() };
        for (side, stances) in seen.iter() {
            for stance in stances {
                let carried: f64 = self.loaded[side].iter().map(|load| overlap_s(*load, *stance)).sum();
                if carried < 0.5 * (stance[1] - stance[0]) {
                    free = free.iter().flat_map(|span| without(*span, *stance)).collect();
                }
            }
        }
        free
    }

    /// Every way of weighing that this recording allows.
    pub(super) fn estimates(&self) -> Vec<MassEstimate> {
        let long = |span: &[f64; 2]| span[1] - span[0] >= SHORTEST_S;
        let windows: Vec<[f64; 2]> = self.windows.iter().map(|span| self.inside_grid(*span)).filter(long).collect();
        let velocity_error = self.velocity_error(&windows);
        let ways = [
            (MassWitness::Cycles, self.cycles(&windows)),
            (MassWitness::Valleys, self.valleys(&windows)),
            (MassWitness::Impulse, windows.clone()),
        ];
        let weighed = |(by, spans): (MassWitness, Vec<[f64; 2]>)| self.estimate(by, &spans, velocity_error);
        let mut list: Vec<MassEstimate> = ways.into_iter().filter_map(weighed).collect();
        list.extend(self.half_strides());
        list
    }

    fn inside_grid(&self, [from, to]: [f64; 2]) -> [f64; 2] {
        [from.max(self.grid.start_s), to.min(self.grid.end_s())]
    }

    /// From strike to strike and from off to off of one foot.
    fn cycles(&self, windows: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let mut spans = Vec::new();
        for side in Side::BOTH {
            for kind in [EventKind::Strike, EventKind::Off] {
                let times: Vec<f64> = times_of(&self.events, side, kind);
                spans.extend(times.windows(2).map(|pair| [pair[0], pair[1]]));
            }
        }
        spans.retain(|span| self.inside_a_window(*span, windows));
        spans
    }

    fn inside_a_window(&self, span: [f64; 2], windows: &[[f64; 2]]) -> bool {
        let fits = |window: &[f64; 2]| span[0] >= window[0] - EDGE_S && span[1] <= window[1] + EDGE_S;
        span[1] - span[0] >= SHORTEST_S && windows.iter().any(fits)
    }

    /// From valley to valley of single supports, where the mass centre is highest and its velocity passes through zero.
    fn valleys(&self, windows: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let mut valleys: Vec<f64> = Vec::new();
        for side in Side::BOTH {
            let others = &self.loaded[side.other()];
            let alone = self.loaded[side].iter().flat_map(|own| {
                others
                    .iter()
                    .fold(vec![*own], |free, other| free.iter().flat_map(|span| without(*span, *other)).collect())
            });
            valleys.extend(
                alone.filter(|span| span[1] - span[0] >= SHORTEST_CONTACT_S).filter_map(|span| self.valley(span)),
            );
        }
        sort_numbers(&mut valleys);
        let mut spans: Vec<[f64; 2]> = valleys.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        spans.retain(|span| self.inside_a_window(*span, windows));
        spans
    }

    /// The instant of the smallest upward force in the middle half of a single support [s].
    fn valley(&self, [from, to]: [f64; 2]) -> Option<f64> {
        let quarter = 0.25 * (to - from);
        let (first, last) = (from + quarter, to - quarter);
        let force = |t: &f64| self.sum_over(None, |force| upward_at(force, self.up, *t));
        let inside = self.frame_times.iter().copied().filter(|t| (first..=last).contains(t));
        inside.min_by(|a, b| force(a).total_cmp(&force(b)))
    }

    /// The mass by the impulses of some times together: m = sum of the impulses / sum of g T + change of velocity.
    fn estimate(&self, by: MassWitness, spans: &[[f64; 2]], velocity_error: f64) -> Option<MassEstimate> {
        let weighed: Vec<Weighed> = spans.iter().filter_map(|span| self.weighed(*span)).collect();
        let total_s: f64 = weighed.iter().map(|w| w.span[1] - w.span[0]).sum();
        let kg = weighed.iter().map(|w| w.kg * (w.span[1] - w.span[0])).sum::<f64>() / total_s;
        let first = weighed.iter().map(|w| w.span[0]).fold(f64::INFINITY, f64::min);
        let last = weighed.iter().map(|w| w.span[1]).fold(f64::NEG_INFINITY, f64::max);
        // Times that overlap are not independent.
        let covered_s: f64 = union_s(&weighed);
        let mean_s = total_s / weighed.len() as f64;
        let independent = (covered_s / mean_s).max(1.0);
        let by_velocity = kg * 2.0_f64.sqrt() * velocity_error / (self.gravity * mean_s);
        let squares: f64 = weighed.iter().map(|w| (w.kg - kg).powi(2)).sum();
        let scatter = (squares / (weighed.len().max(2) - 1) as f64).sqrt();
        let error_kg = by_velocity.max(scatter) / independent.sqrt();
        let is_known = kg.is_finite() && kg > 0.0 && error_kg.is_finite();
        is_known.then_some(MassEstimate { by, kg, error_kg, times: weighed.len(), time_s: Some([first, last]) })
    }

    fn weighed(&self, span: [f64; 2]) -> Option<Weighed> {
        let velocity = |t: f64| interpolate(&self.frame_times, &self.velocity, t);
        let needed = self.gravity * (span[1] - span[0]) + velocity(span[1]) - velocity(span[0]);
        let kg = self.impulse(span) / needed;
        (needed > 0.0 && kg.is_finite()).then_some(Weighed { span, kg })
    }

    /// Upward impulse of the ground [N.s].
    fn impulse(&self, span: [f64; 2]) -> f64 {
        self.sum_over(None, |force| impulse_of(force, self.up, span))
    }

    /// The sum over the forces on one side, or on both.
    fn sum_over(&self, side: Option<Side>, of: impl Fn(&ForceRecording) -> f64) -> f64 {
        let own = self.forces.iter().zip(&self.sides).filter(|(_, own)| side.is_none() || **own == side);
        own.map(|(force, _)| of(force)).sum()
    }

    /// Standard deviation of the velocity of the mass centre about that which the forces give [m/s], over these times;
    /// each time has its own initial velocity and mass.
    fn velocity_error(&self, windows: &[[f64; 2]]) -> f64 {
        let (mut squares, mut seconds) = (PRIOR_VELOCITY_M_S.powi(2) * PRIOR_S, PRIOR_S);
        for window in windows {
            let frames = (0..self.grid.frames).filter(|i| (window[0]..=window[1]).contains(&self.frame_times[*i]));
            let mut impulse = 0.0;
            let mut last = window[0];
            let points: Vec<[f64; 2]> = frames
                .map(|i| {
                    let t = self.frame_times[i];
                    impulse += self.impulse([last, t]);
                    last = t;
                    [impulse, self.velocity[i] + self.gravity * (t - window[0])]
                })
                .collect();
            squares += squared_distance_from_line(&points) * self.grid.step_s;
            seconds += points.len() as f64 * self.grid.step_s;
        }
        (squares / seconds).sqrt()
    }

    /// Half of a stride of a symmetric gait: a whole stance carries m (g T / 2), with the time T of the stride.
    fn half_strides(&self) -> Option<MassEstimate> {
        let stride_s = self.stride_s()?;
        let stances = || Side::BOTH.into_iter().flat_map(|side| self.stances[side].iter().copied());
        let is_whole = |s: &[f64; 2]| s[0] > self.grid.start_s && s[1] < self.grid.end_s();
        let spans: Vec<[f64; 2]> = stances().filter(is_whole).collect();
        let count = spans.len() as f64;
        let [left, right] = [Side::Left, Side::Right].map(|side| {
            let own = self.stances[side].iter().filter(|span| is_whole(span));
            let impulses: Vec<f64> =
                own.map(|span| self.sum_over(Some(side), |force| impulse_of(force, self.up, *span))).collect();
            (!impulses.is_empty()).then(|| impulses.iter().sum::<f64>() / impulses.len() as f64)
        });
        // Both feet together carry all of it, whatever their asymmetry is.
        let (impulse, asymmetry) = match (left, right) {
            (Some(left), Some(right)) => (0.5 * (left + right), 0.0),
            (Some(one), None) | (None, Some(one)) => (one, 0.5 * ASYMMETRY),
            (None, None) => return None,
        };
        let kg = 2.0 * impulse / (self.gravity * stride_s);
        let by_velocity = 2.0 * PRIOR_VELOCITY_M_S / (self.gravity * stride_s * count.sqrt());
        let share = (asymmetry.powi(2) + (STRIDE_ERROR_S / stride_s).powi(2) + by_velocity.powi(2)).sqrt();
        let ends = [spans.first()?[0], spans.last()?[1]];
        let times = spans.len();
        Some(MassEstimate { by: MassWitness::HalfStrides, kg, error_kg: share * kg, times, time_s: Some(ends) })
    }

    /// Median time of a stride [s]: of the forces, if they show one. Events of forces and motion together would give
    /// half strides where the forces are on the wrong feet.
    fn stride_s(&self) -> Option<f64> {
        median_stride_s(&self.force_events).or_else(|| median_stride_s(&self.events))
    }
}

fn times_of(events: &[Event], side: Side, kind: EventKind) -> Vec<f64> {
    let mut times: Vec<f64> = events.iter().filter(|e| e.side == side && e.kind == kind).map(|e| e.time_s).collect();
    sort_numbers(&mut times);
    times
}

fn median_stride_s(events: &[Event]) -> Option<f64> {
    let mut strides: Vec<f64> = Vec::new();
    for side in Side::BOTH {
        for kind in [EventKind::Strike, EventKind::Off] {
            strides.extend(times_of(events, side, kind).windows(2).map(|pair| pair[1] - pair[0]));
        }
    }
    quantiles(strides, [0.5]).map(|[stride]| stride)
}

fn contacts_of(model: &Model, forces: &[ForceRecording], up: Vec3, side: Side) -> Vec<Contact> {
    let own: Vec<&ForceRecording> =
        forces.iter().filter(|force| model.anatomy().body_side(force.body) == Some(side)).collect();
    let Some(first) = own.first() else { return Vec::new() };
    let total: Vec<f64> = first.times.iter().map(|t| own.iter().map(|f| upward_at(f, up, *t)).sum()).collect();
    contacts_from_force(&first.times, &total)
}

/// Events of the forces, and events of the motion that are not among them.
fn with_events(by_force: Vec<Event>, by_motion: &[Event]) -> Vec<Event> {
    let is_new = |event: &&Event| {
        let same = |known: &Event| {
            known.side == event.side && known.kind == event.kind && (known.time_s - event.time_s).abs() < SAME_EVENT_S
        };
        !by_force.iter().any(same)
    };
    let more: Vec<Event> = by_motion.iter().filter(is_new).copied().collect();
    by_force.into_iter().chain(more).collect()
}

/// The upward force at a time [N]; zero where it was not measured.
fn upward_at(force: &ForceRecording, up: Vec3, t: f64) -> f64 {
    let Some(&first) = force.times.first() else { return 0.0 };
    let next = force.times.partition_point(|time| *time < t).max(1);
    if t < first || next >= force.times.len() {
        return 0.0;
    }
    let share = (t - force.times[next - 1]) / (force.times[next] - force.times[next - 1]);
    let [before, after] = [force.force[next - 1].dot(&up), force.force[next].dot(&up)].map(zero_if_unknown);
    before + share * (after - before)
}

fn zero_if_unknown(force_n: f64) -> f64 {
    if force_n.is_finite() { force_n } else { 0.0 }
}

/// Upward impulse of a force over a time [N.s], by the trapezium rule on the recorded samples.
fn impulse_of(force: &ForceRecording, up: Vec3, [from, to]: [f64; 2]) -> f64 {
    let first = force.times.partition_point(|time| *time <= from);
    let last = force.times.partition_point(|time| *time < to);
    let mut points = vec![(from, upward_at(force, up, from))];
    points.extend((first..last).map(|i| (force.times[i], zero_if_unknown(force.force[i].dot(&up)))));
    points.push((to, upward_at(force, up, to)));
    points.windows(2).map(|pair| 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0)).sum()
}

/// Sum of the squared distances in y from the line of least squares through points (x, y).
fn squared_distance_from_line(points: &[[f64; 2]]) -> f64 {
    let count = points.len().max(1) as f64;
    let mean = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / count;
    let (x, y) = (mean(0), mean(1));
    let sum = |a: usize, b: usize| {
        let center = [x, y];
        points.iter().map(|point| (point[a] - center[a]) * (point[b] - center[b])).sum::<f64>()
    };
    let (xx, xy, yy) = (sum(0, 0), sum(0, 1), sum(1, 1));
    if xx > 0.0 { (yy - xy * xy / xx).max(0.0) } else { yy }
}

/// The time that all forces and the motion cover [s].
fn recorded(forces: &[ForceRecording], grid: TimeGrid) -> [f64; 2] {
    let ends = forces.iter().filter_map(|force| Some([*force.times.first()?, *force.times.last()?]));
    ends.fold([grid.start_s, grid.end_s()], |[from, to], [first, last]| [from.max(first), to.min(last)])
}

fn overlap_s(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[1].min(b[1]) - a[0].max(b[0])).max(0.0)
}

fn without([from, to]: [f64; 2], removed: [f64; 2]) -> Vec<[f64; 2]> {
    let parts = [[from, to.min(removed[0])], [from.max(removed[1]), to]];
    parts.into_iter().filter(|part| part[1] > part[0]).collect()
}

/// The time that some times cover together [s].
fn union_s(weighed: &[Weighed]) -> f64 {
    let mut spans: Vec<[f64; 2]> = weighed.iter().map(|w| w.span).collect();
    spans.sort_by_number(|span| span[0]);
    let (mut covered, mut end) = (0.0, f64::NEG_INFINITY);
    for [from, to] in spans {
        covered += (to - from.max(end)).max(0.0);
        end = end.max(to);
    }
    covered
}
