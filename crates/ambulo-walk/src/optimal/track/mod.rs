//! The motion nearest to a recorded one whose external forces come from feet on soft ground alone.
//!
//! A recorded motion obeys the laws of mechanics only with residual forces at the root. Here its coordinates become the
//! targets of a [`Problem`]: the unknowns are splines of all coordinates over the recording, spheres under the feet of
//! the model touch the floor, and the residual forces are zero at all instants. So ground forces and joint forces
//! follow from the motion without force plates.
//!
//! In double support, motion alone gives little information about how the feet share the load: forces of a prediction
//! ([`FootGuide::force`]) can be targets, too.
//!
//! The floor is level, or a belt of constant velocity: in axes that move with the belt it is at rest, and forces are
//! the same. Pinned by: tests/optimal_track.rs

mod floor;
mod soles;
mod terms;

use super::error::OptimalWalkError;
use super::layout::Span;
use super::observer::Observer;
use super::problem::Problem;
use super::solution::{Sample, Solution};
use super::solve::Continuation;
use crate::contact::HuntCrossley;
use crate::kinematics::{Trajectory, TrajectoryError};
use crate::model::anatomy::Sole;
use crate::model::{BySide, CoordinateId, CoordinateKind, Drive, Model, Side};
use crate::motion::TimeGrid;
use crate::numerics::mean;
use crate::spatial::Vec3;
use floor::{belt, checked, floor_velocity, level, steady};
use soles::{PER_FOOT, Soles};
use terms::{Recorded, terms};

/// Stages of the solution: shoes become stiffer, friction steeper, and residual forces smaller.
pub const TRACK_STAGES: [Continuation; 6] = [
    Continuation { stiffness: 0.5, creep: 12.0, slip: 1.0, slack: 0.02, updates: 0, steps: 40, gain: 1e-3 },
    Continuation { stiffness: 1.0, creep: 5.0, slip: 1.0, slack: 0.01, updates: 0, steps: 30, gain: 1e-3 },
    Continuation { stiffness: 1.0, creep: 2.0, slip: 1.0, slack: 0.005, updates: 0, steps: 30, gain: 1e-3 },
    Continuation { stiffness: 1.0, creep: 1.0, slip: 1.0, slack: 0.002, updates: 0, steps: 30, gain: 1e-3 },
    Continuation { stiffness: 1.0, creep: 1.0, slip: 1.0, slack: 0.0005, updates: 1, steps: 20, gain: 3e-3 },
    Continuation { stiffness: 1.0, creep: 1.0, slip: 1.0, slack: 0.0001, updates: 6, steps: 20, gain: 1e-2 },
];

const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// Largest root mean square of the residual forces of a solution [body weights, body weights × leg length].
const LARGEST_RESIDUAL: f64 = 0.003;
/// A solution that leaves more than this is solved on.
const SMALL_RESIDUAL: f64 = 0.0005;
/// How often the last stage is repeated for it.
const MORE_ATTEMPTS: usize = 8;
/// Instants per knot interval.
const PER_KNOT: usize = 2;
/// Longest recording [s]: memory grows by some 20 MB per second.
const LONGEST_S: f64 = 120.0;
/// Shortest recording, in knot intervals.
const SHORTEST: usize = 8;

/// Data of a foot other than its motion.
#[derive(Debug, Clone, PartialEq)]
pub struct FootGuide {
    /// The sole.
    pub sole: Sole,
    /// Foot strike and foot off of the stances [s].
    pub stances_s: Vec<[f64; 2]>,
    /// Height of the floor in each stance [m].
    pub floors_m: Vec<f64>,
    /// Velocity of the floor in each stance [m/s].
    pub floor_velocities: Vec<Vec3>,
    /// Expected ground force in each frame [N]; empty if there is none.
    pub force: Vec<Vec3>,
    /// Expected centre of pressure in each frame [m]; not a number where there is none.
    pub center: Vec<Vec3>,
}

/// Costs of deviations from the recorded motion and from expected forces, and the resolution. The default values were
/// set by hand on nine recordings (docs/OPTIMAL.md).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackSettings {
    /// Deviation of a joint angle that costs 1 [rad].
    pub angle: f64,
    /// Largest change of a joint angle without additional cost [rad]: more than the errors of markers and of
    /// skeletons.
    pub most_change: f64,
    /// Angle beyond this change, or beyond the range of the joint, that costs 1 [rad].
    pub beyond: f64,
    /// Deviation of a rotation of the root that costs 1 [rad].
    pub root_angle: f64,
    /// The same for the translations of the root [m].
    pub place: f64,
    /// The same for the angular accelerations of root and hips [rad/s²].
    pub turning: f64,
    /// The same at the knee, at ankle and foot, and at trunk and arms, in units of `turning`.
    pub looser: [f64; 3],
    /// The same for the accelerations of the translations of the root [m/s²].
    pub acceleration: f64,
    /// The same for the expected ground force along x, y and z [body weights].
    pub force: [f64; 3],
    /// The same for the moment of the vertical ground force about the expected centre of pressure [body weight × m].
    pub center: f64,
    /// The same for the expected joint moments of the legs [N.m/kg].
    pub moment: f64,
    /// The same for the height of a sphere in stance [m].
    pub height: f64,
    /// Slip velocity at which friction of the shoes sets in [m/s].
    pub creep: f64,
    /// Most instants per second.
    pub rate_hz: f64,
}

impl Default for TrackSettings {
    fn default() -> TrackSettings {
        TrackSettings {
            angle: 4.0 * DEGREE,
            most_change: 15.0 * DEGREE,
            beyond: 0.5 * DEGREE,
            root_angle: 1.5 * DEGREE,
            place: 0.01,
            turning: 30.0,
            looser: [3.0, 10.0, 3.0],
            acceleration: 2.0,
            force: [0.01, 0.02, 0.006],
            center: 0.005,
            moment: 0.1,
            height: 0.007,
            creep: 0.05,
            rate_hz: 110.0,
        }
    }
}

/// Why a recording cannot be tracked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TrackError {
    /// A joint for which no derivatives are computed, or an observer that stopped the solver.
    #[error(transparent)]
    Solver(#[from] OptimalWalkError),
    /// A solution with numbers that are not finite.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
    /// A model without legs.
    #[error("the model `{model}` has no two legs with hip, knee, ankle and foot; expected both legs")]
    NoFeet {
        /// Name of the model.
        model: String,
    },
    /// A body whose root cannot move freely.
    #[error("the root of the model `{model}` does not move freely; expected six free coordinates at the root")]
    HeldRoot {
        /// Name of the model.
        model: String,
    },
    /// A spring between bodies.
    #[error(
        "the model `{model}` has the bushing `{bushing}`, which tracking does not support; expected a model without \
         bushings"
    )]
    Bushing {
        /// Name of the model.
        model: String,
        /// Name of the bushing.
        bushing: String,
    },
    /// Another vertical than y.
    #[error("the gravity of the model `{model}` does not act along -y; expected y as the upward axis")]
    NotUpright {
        /// Name of the model.
        model: String,
    },
    /// No foot on the ground.
    #[error("no foot stays on the ground in this motion; expected at least one stance")]
    NoStance,
    /// Stairs, or belts of different velocity.
    #[error(
        "the {what} of the floor differs by {found:.3} {unit} between stances; expected one level floor or belt (at \
         most {most} {unit})"
    )]
    UnevenFloor {
        /// Difference.
        what: &'static str,
        /// Difference found.
        found: f64,
        /// The most that is supported.
        most: f64,
        /// Unit of both.
        unit: &'static str,
    },
    /// A sole that is not where the foot was.
    #[error(
        "the {side} sole of the model is {:.0} mm from the floor at `{sphere}` in stance; expected {:.0} mm at most. \
         hint: check the size of the model",
        1e3 * distance_m, 80.0
    )]
    SoleOffFloor {
        /// Side of the foot.
        side: Side,
        /// The sphere under it.
        sphere: String,
        /// Distance found [m].
        distance_m: f64,
    },
    /// No motion near the recorded one was found that feet on the ground can make.
    #[error(
        "found no motion near the recorded one that feet on the ground alone can make: residual forces of {:.2} % of \
         body weight (rms, or of body weight times leg length) remain; expected {:.2} % at most",
        100.0 * share, 100.0 * LARGEST_RESIDUAL
    )]
    NotSolved {
        /// Root mean square of the residual forces [body weights, body weights × leg length].
        share: f64,
    },
    /// A recording that is too short or too long.
    #[error("the motion lasts {found_s:.2} s; expected {least_s:.2} to {most_s:.0} s")]
    Duration {
        /// Duration found [s].
        found_s: f64,
        /// The shortest that can be tracked [s].
        least_s: f64,
        /// The longest [s].
        most_s: f64,
    },
}

/// The ground force on one foot, one entry per frame.
#[derive(Debug, Clone, PartialEq)]
pub struct TrackedFoot {
    /// Side of the foot.
    pub side: Side,
    /// Force [N].
    pub force: Vec<Vec3>,
    /// Moment about the origin of the world [N.m].
    pub moment: Vec<Vec3>,
}

/// A recorded motion changed until feet on the ground supply its external forces.
#[derive(Debug, Clone)]
pub struct TrackedMotion {
    /// The motion, on the frames of the recorded one.
    pub trajectory: Trajectory,
    /// The right and the left foot.
    pub feet: [TrackedFoot; 2],
    /// The solution, on a floor at rest at height 0.
    pub solution: Solution,
    /// Height of the floor [m].
    pub floor_m: f64,
    /// Residual forces at the root in the frames: root mean square and maximum [body weights, body weights × leg
    /// length].
    pub residual: (f64, f64),
    /// Root mean square of the changes of all rotations [rad], and of the translations of the root [m].
    pub moved: [f64; 2],
    /// Largest change of each rotation [rad], by the name of its coordinate.
    pub turned: Vec<(String, f64)>,
}

/// A recorded motion as a problem of optimal motion.
#[derive(Debug, Clone)]
pub struct TrackProblem<'a> {
    /// The problem.
    pub problem: Problem,
    /// Unknowns of the recorded motion.
    pub guess: Vec<f64>,
    recorded: &'a Trajectory,
    /// Numbers of unknowns of locked, prescribed and coupled coordinates.
    kept: Vec<usize>,
    floor_m: f64,
    /// Velocity of each coordinate due to the velocity of the floor [m/s].
    belt: Vec<f64>,
}

impl<'a> TrackProblem<'a> {
    /// The problem of a recorded motion of a model. `moments` are expected generalised forces, one series per
    /// coordinate, one entry per frame [N.m or N]; empty if there are none.
    ///
    /// # Errors
    /// Models and floors that are not supported, recordings that are too short or too long: see [`TrackError`].
    pub fn new(
        model: &Model,
        recorded: &'a Trajectory,
        feet: &BySide<FootGuide>,
        moments: &[Vec<f64>],
        settings: &TrackSettings,
    ) -> Result<TrackProblem<'a>, TrackError> {
        checked(model)?;
        let floor_m = level(feet)?;
        let belt = belt(model, steady(feet)?);
        let grid = Instants::of(recorded.grid(), settings.rate_hz)?;
        let shoes = HuntCrossley { transition_velocity: settings.creep, ..HuntCrossley::SOFT_SHOES };
        let Soles { spheres, heights } = soles::spheres(model, recorded, feet, floor_m, &shoes)?;
        let mut problem = Problem {
            model: model.clone(),
            levels_m: vec![floor_m; spheres.len()],
            soles: spheres,
            shoes,
            span: Span::Single,
            duration_s: grid.step_s * (PER_KNOT * grid.knots) as f64,
            travel: None,
            knots: grid.knots,
            instants_per_knot: PER_KNOT,
            length_m: model.stature().leg_length_m,
            terms: Vec::new(),
            observer: Observer::default(),
        };
        let guess = problem.fitted(&postures(recorded, &grid, &belt));
        let known = Recorded { model, trajectory: recorded, instants: &grid, belt: &belt, settings };
        problem.terms = terms(&known, feet, &heights, moments);
        let width = model.coordinates().len();
        let is_driven = |k: &usize| !matches!(model.coordinates()[k % width].drive, Drive::Free);
        let kept = (0..guess.len()).filter(is_driven).collect();
        Ok(TrackProblem { problem, guess, recorded, kept, floor_m, belt })
    }

    /// Solves the problem; repeats the last stage if forces at the root remain.
    ///
    /// # Errors
    /// Joints for which no derivatives are computed; residual forces of more than 0.3 % of body weight (rms) that
    /// remain.
    pub fn solve(&self, stages: &[Continuation]) -> Result<TrackedMotion, TrackError> {
        let grid = self.recorded.grid();
        let times: Vec<f64> = (0..grid.frames).map(|k| grid.step_s * k as f64).collect();
        let last = Continuation::on(stages);
        let solution = self.problem.solve_keeping(&self.guess, stages, &self.kept)?;
        let mut solution = self.problem.balanced(solution, &[&last], &self.kept)?;
        let mut samples = solution.samples(&times).map_err(OptimalWalkError::from)?;
        for _ in 0..MORE_ATTEMPTS {
            let (left, _) = self.residual(&samples);
            if left.is_nan() || left <= SMALL_RESIDUAL {
                break;
            }
            solution = self.problem.balanced(solution, &[&last], &self.kept)?;
            samples = solution.samples(&times).map_err(OptimalWalkError::from)?;
        }
        let trajectory = self.trajectory(&samples)?;
        let feet = [(Side::Right, 0), (Side::Left, PER_FOOT)].map(|(side, first)| self.foot(&samples, side, first));
        let residual = self.residual(&samples);
        if residual.0.is_nan() || residual.0 > LARGEST_RESIDUAL {
            return Err(TrackError::NotSolved { share: residual.0 });
        }
        let (moved, turned) = (self.moved(&trajectory), self.turned(&trajectory));
        Ok(TrackedMotion { trajectory, feet, solution, floor_m: self.floor_m, residual, moved, turned })
    }

    /// The motion in the axes of the recording.
    fn trajectory(&self, samples: &[Sample]) -> Result<Trajectory, TrackError> {
        let column = |c: usize| {
            let part = |part: usize| samples.iter().map(move |sample| sample.posture[part][c]);
            let place = part(0).zip(samples).map(|(x, sample)| x + self.belt[c] * sample.time_s).collect();
            [place, part(1).map(|rate| rate + self.belt[c]).collect(), part(2).collect()]
        };
        let columns = (0..self.belt.len()).map(column).collect();
        Ok(Trajectory::new(&self.problem.model, self.recorded.grid(), columns)?)
    }

    fn foot(&self, samples: &[Sample], side: Side, first: usize) -> TrackedFoot {
        let velocity = floor_velocity(&self.problem.model, &self.belt);
        let of = |sample: &Sample| {
            let contacts = &sample.contacts[first..first + PER_FOOT];
            let force: Vec3 = contacts.iter().map(|contact| contact.force).sum();
            let place = |place: Vec3| place + velocity * sample.time_s;
            let moment: Vec3 = contacts.iter().map(|contact| place(contact.place).cross(&contact.force)).sum();
            (force, moment)
        };
        let (force, moment) = samples.iter().map(of).unzip();
        TrackedFoot { side, force, moment }
    }

    /// Residual forces at the root: root mean square and maximum.
    fn residual(&self, samples: &[Sample]) -> (f64, f64) {
        let scales = self.problem.root_scales();
        let all: Vec<f64> = samples
            .iter()
            .flat_map(|sample| scales.iter().map(|(id, scale)| (sample.forces[id.index()] / scale).abs()))
            .collect();
        let mean = all.iter().map(|x| x * x).sum::<f64>() / all.len() as f64;
        (mean.sqrt(), all.iter().fold(0.0, |a, &b| a.max(b)))
    }

    /// Largest change of each rotation.
    fn turned(&self, trajectory: &Trajectory) -> Vec<(String, f64)> {
        let model = &self.problem.model;
        let is_free = |id: &CoordinateId| {
            let coordinate = &model.coordinates()[id.index()];
            coordinate.kind == CoordinateKind::Rotation && matches!(coordinate.drive, Drive::Free)
        };
        let largest = |id: CoordinateId| {
            let pairs = trajectory.values(id).iter().zip(self.recorded.values(id));
            let change = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            (model.coordinates()[id.index()].name.clone(), change)
        };
        model.coordinate_ids().filter(is_free).map(largest).collect()
    }

    /// Root mean square of the changes of rotations and of translations.
    fn moved(&self, trajectory: &Trajectory) -> [f64; 2] {
        let model = &self.problem.model;
        [CoordinateKind::Rotation, CoordinateKind::Translation].map(|kind| {
            let mut squares = Vec::new();
            for id in model.coordinate_ids() {
                let coordinate = &model.coordinates()[id.index()];
                if coordinate.kind == kind && matches!(coordinate.drive, Drive::Free) {
                    let pairs = trajectory.values(id).iter().zip(self.recorded.values(id));
                    squares.extend(pairs.map(|(a, b)| (a - b).powi(2)));
                }
            }
            mean(&squares).sqrt()
        })
    }
}

/// Instants of the problem: every n-th frame of the recording, and a few after its end.
struct Instants {
    /// Frames from one instant to the next.
    frames: usize,
    step_s: f64,
    knots: usize,
}

impl Instants {
    fn of(grid: TimeGrid, most_hz: f64) -> Result<Instants, TrackError> {
        let frames = ((grid.rate_hz() / most_hz).ceil() as usize).max(1);
        let step_s = grid.step_s * frames as f64;
        let (found_s, least_s) = (grid.end_s() - grid.start_s, step_s * (PER_KNOT * SHORTEST) as f64);
        if !(least_s..=LONGEST_S).contains(&found_s) {
            return Err(TrackError::Duration { found_s, least_s, most_s: LONGEST_S });
        }
        let knots = (grid.frames - 1).div_ceil(frames * PER_KNOT);
        Ok(Instants { frames, step_s, knots })
    }

    fn count(&self) -> usize {
        self.knots * PER_KNOT + 1
    }

    /// The value of a frame series at each instant; `None` after its end.
    fn pick<T: Copy>(&self, series: &[T]) -> Vec<Option<T>> {
        (0..self.count()).map(|k| series.get(k * self.frames).copied()).collect()
    }
}

/// Recorded coordinates at the instants; after the end, at constant rates.
fn postures(recorded: &Trajectory, instants: &Instants, belt: &[f64]) -> Vec<Vec<f64>> {
    let grid = recorded.grid();
    let at = |k: usize| {
        let frame = (k * instants.frames).min(grid.frames - 1);
        let time_s = instants.step_s * k as f64;
        let beyond_s = time_s - grid.step_s * frame as f64;
        let value = |c: usize| {
            let [q, qd, _] = &recorded.columns()[c];
            q[frame] + qd[frame] * beyond_s - belt[c] * time_s
        };
        (0..belt.len()).map(value).collect()
    };
    (0..instants.count()).map(at).collect()
}
