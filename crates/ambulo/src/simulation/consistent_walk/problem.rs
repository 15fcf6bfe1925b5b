//! The least-squares problem of a dynamically consistent walk: its residuals and their derivatives.
//!
//! At each instant, the posture gives depth, speed and slip of the soles, and the law of soft contact gives their forces. Inverse
//! dynamics under these forces gives the residual force of the root and the joint moments. Derivatives with respect to the 36
//! inputs of an instant (value, rate and acceleration of each curve) are finite differences; the splines map them exactly to the
//! coefficients.

use super::response::{FORE_AFT, GroundedFigure, HEIGHTS, MOMENTS, OUTPUTS, SIDE, SLIPS, TOE, VERTICAL};
use super::settings::{ConsistentWalkError, ConsistentWalkSettings};
use super::unknowns::{Input, Kind, Layout, reference};
use crate::contact::HuntCrossley;
use crate::dynamics::Workspace;
use crate::gait::machine::WalkMachine;
use crate::gait::{GroundForceLaws, Walk};
use crate::model::anthropometry::Human;
use crate::numerics::{NormalEquations, Residuals};

/// Steps of the finite differences for value, rate and acceleration.
const STEPS: [f64; 3] = [1e-7, 1e-6, 1e-3];
/// Deviation of the root's acceleration from even motion, a weak cost [m/s²].
const ROOT_ACCELERATION: f64 = 20.0;
/// Deviation of the mean forward position; it fixes where the walk begins [m].
const PLACE: f64 = 1e-3;

/// One stage of the solution. The first three are factors of the final values.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stage {
    /// Stiffness of the shoes.
    pub(super) stiffness: f64,
    /// Creep speed.
    pub(super) creep: f64,
    /// Deviation of the residual force and moment.
    pub(super) root: f64,
    pub(super) iterations: usize,
}

pub(super) struct Problem<'a> {
    settings: &'a ConsistentWalkSettings,
    layout: &'a Layout,
    workspace: Workspace,
    shoes: HuntCrossley,
    root_slack: f64,
    instants: Vec<Instant>,
    body: GroundedFigure<'a>,
    outputs: Vec<Outputs>,
}

/// Outputs of one instant, and their derivatives with respect to its columns.
#[derive(Clone)]
struct Outputs {
    values: [f64; OUTPUTS],
    slopes: Vec<[f64; OUTPUTS]>,
}

impl<'a> Problem<'a> {
    pub(super) fn new(
        human: &'a Human,
        walk: &Walk,
        settings: &'a ConsistentWalkSettings,
        layout: &'a Layout,
    ) -> Result<Problem<'a>, ConsistentWalkError> {
        let body = GroundedFigure::of(human)?;
        let forces = GroundForceLaws::built_in()?;
        let count = settings.instants;
        let mut machine = WalkMachine::new(walk);
        let instants: Vec<Instant> = (0..count)
            .map(|i| Instant::new(human, &mut machine, layout, &forces, 0.5 * i as f64 / count as f64))
            .collect();
        Ok(Problem {
            settings,
            layout,
            workspace: Workspace::new(&human.model),
            shoes: settings.shoes,
            root_slack: 1.0,
            instants,
            body,
            outputs: Vec::new(),
        })
    }

    pub(super) fn enter(&mut self, stage: Stage) {
        let shoes = &self.settings.shoes;
        self.shoes = HuntCrossley {
            stiffness: shoes.stiffness * stage.stiffness,
            transition_velocity: shoes.transition_velocity * stage.creep,
            ..*shoes
        };
        self.root_slack = stage.root;
    }

    /// The first guess: no change except the height at which the soles carry the body weight.
    pub(super) fn first_guess(&mut self) -> Vec<f64> {
        let mut x = vec![0.0; self.layout.count];
        let Some(height) = self.layout.range(Kind::Height) else { return x };
        let (mut low, mut high) = (0.8 * self.body.leg_length, 1.1 * self.body.leg_length);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            x[height.clone()].fill(middle);
            let mean: f64 = (0..self.instants.len())
                .map(|i| {
                    let out = self.outputs_at(i, &x);
                    out[3 + VERTICAL] + out[3 + SIDE + VERTICAL]
                })
                .sum::<f64>()
                / self.instants.len() as f64;
            if mean > 1.0 { low = middle } else { high = middle }
        }
        x
    }

    fn outputs_at(&mut self, instant: usize, x: &[f64]) -> [f64; OUTPUTS] {
        let posture = self.posture(instant, x);
        self.body.outputs(&mut self.workspace, &self.shoes, &posture)
    }

    fn posture(&self, instant: usize, x: &[f64]) -> [Vec<f64>; 3] {
        let instant = &self.instants[instant];
        let mut posture = instant.posture.clone();
        for input in &instant.inputs {
            for (d, values) in posture.iter_mut().enumerate() {
                values[input.coordinate] += input.sum(x, d);
            }
        }
        posture
    }

    fn evaluate(&mut self, x: &[f64], with_slopes: bool) {
        let mut outputs = std::mem::take(&mut self.outputs);
        outputs.resize_with(self.instants.len(), || Outputs { values: [0.0; OUTPUTS], slopes: Vec::new() });
        for (i, out) in outputs.iter_mut().enumerate() {
            let mut posture = self.posture(i, x);
            out.values = self.body.outputs(&mut self.workspace, &self.shoes, &posture);
            if with_slopes {
                self.fill_slopes(i, &mut posture, out);
            }
        }
        self.outputs = outputs;
    }

    fn fill_slopes(&mut self, instant: usize, posture: &mut [Vec<f64>; 3], out: &mut Outputs) {
        let inputs = &self.instants[instant].inputs;
        out.slopes.clear();
        for input in inputs {
            let mut by = [[0.0; OUTPUTS]; 3];
            for (d, slopes) in by.iter_mut().enumerate() {
                let kept = posture[d][input.coordinate];
                posture[d][input.coordinate] = kept + STEPS[d];
                let moved = self.body.outputs(&mut self.workspace, &self.shoes, posture);
                posture[d][input.coordinate] = kept;
                *slopes = std::array::from_fn(|k| (moved[k] - out.values[k]) / STEPS[d]);
            }
            for k in 0..input.numbers.len() {
                out.slopes.push(std::array::from_fn(|o| (0..3).map(|d| by[d][o] * input.weights[d][k]).sum()));
            }
        }
    }

    /// Passes every residual with its columns and slopes to `row`.
    fn rows(&self, x: &[f64], row: &mut impl FnMut(f64, &[usize], &[f64])) {
        let dev = &self.settings.deviations;
        for (instant, out) in self.instants.iter().zip(&self.outputs) {
            let mut of_output = |o: usize, target: f64, deviation: f64| {
                let slopes: Vec<f64> = out.slopes.iter().map(|s| s[o] / deviation).collect();
                row((out.values[o] - target) / deviation, &instant.columns, &slopes);
            };
            for o in 0..2 {
                of_output(o, 0.0, dev.root_force * self.root_slack);
            }
            of_output(2, 0.0, dev.root_moment * self.root_slack);
            for (side, target) in instant.sides.iter().enumerate() {
                let base = 3 + SIDE * side;
                of_output(base + VERTICAL, target.force[0], dev.ground_force[0]);
                of_output(base + FORE_AFT, target.force[1], dev.ground_force[1]);
                of_output(base + TOE, 0.0, dev.toe_force);
                for k in 0..3 {
                    of_output(base + SLIPS + k, 0.0, dev.slip);
                    if target.swing[k] && out.values[base + HEIGHTS + k] < self.settings.clearance {
                        of_output(base + HEIGHTS + k, self.settings.clearance, dev.clearance);
                    }
                }
            }
            self.posture_rows(instant, x, row);
        }
        self.moment_rows(row);
        if let Some(range) = self.layout.range(Kind::Forward) {
            let numbers: Vec<usize> = range.collect();
            let share = 1.0 / (numbers.len() as f64 * PLACE);
            let mean: f64 = numbers.iter().map(|&n| x[n] * share).sum();
            row(mean, &numbers, &vec![share; numbers.len()]);
        }
    }

    /// Residuals of the distance to the curves of the gait.
    fn posture_rows(&self, instant: &Instant, x: &[f64], row: &mut impl FnMut(f64, &[usize], &[f64])) {
        let dev = &self.settings.deviations;
        let mut near = |input: &Input, d: usize, target: f64, deviation: f64| {
            let slopes = input.weights[d].map(|w| w / deviation);
            row((input.sum(x, d) - target) / deviation, &input.numbers, &slopes);
        };
        let mut legs = 0;
        for input in &instant.inputs {
            let joint = match input.kind {
                Kind::Hip => Some(0),
                Kind::Knee => Some(1),
                Kind::Ankle => Some(2),
                _ => None,
            };
            match input.kind {
                Kind::Toes => {
                    let known = instant.posture[0][input.coordinate];
                    near(input, 0, instant.sides[legs].toes - known, dev.toes);
                    near(input, 2, 0.0, 3.0 * dev.joint_acceleration);
                    legs += 1;
                }
                Kind::Forward | Kind::Height => near(input, 2, 0.0, ROOT_ACCELERATION),
                Kind::Pelvis => {
                    near(input, 0, 0.0, dev.pelvis);
                    near(input, 2, 0.0, dev.trunk_acceleration);
                }
                _ => {}
            }
            // The model's knee angle is extension.
            let known = instant.posture[0][input.coordinate];
            let extended = known + input.sum(x, 0) + self.settings.least_knee_flexion;
            if joint == Some(1) && extended > 0.0 {
                near(input, 0, -known - self.settings.least_knee_flexion, dev.knee_extension);
            }
            if let Some(joint) = joint {
                near(input, 0, 0.0, dev.joints[joint]);
                near(input, 2, 0.0, dev.joint_acceleration);
            }
        }
        self.trunk_rows(instant, x, row);
    }

    /// Residuals of the trunk's lean, which is the sum of pelvis and lumbar rotation.
    fn trunk_rows(&self, instant: &Instant, x: &[f64], row: &mut impl FnMut(f64, &[usize], &[f64])) {
        let dev = &self.settings.deviations;
        let turning: Vec<&Input> =
            instant.inputs.iter().filter(|i| matches!(i.kind, Kind::Pelvis | Kind::Lumbar)).collect();
        let numbers: Vec<usize> = turning.iter().flat_map(|i| i.numbers).collect();
        for (d, deviation) in [(0, dev.trunk), (2, dev.trunk_acceleration)] {
            let slopes: Vec<f64> = turning.iter().flat_map(|i| i.weights[d].map(|w| w / deviation)).collect();
            let lean: f64 = turning.iter().map(|i| i.sum(x, d)).sum();
            row(lean / deviation, &numbers, &slopes);
        }
    }

    /// Residuals of the rate of joint moments. After half a cycle, the sides are exchanged.
    fn moment_rows(&self, row: &mut impl FnMut(f64, &[usize], &[f64])) {
        let count = self.instants.len();
        let scale = 2.0 * count as f64 / self.settings.deviations.moment_rate;
        for i in 0..count {
            let next = (i + 1) % count;
            let (here, there) = (&self.outputs[i], &self.outputs[next]);
            let columns: Vec<usize> =
                self.instants[i].columns.iter().chain(&self.instants[next].columns).copied().collect();
            for side in 0..2 {
                let side_there = if next == 0 { 1 - side } else { side };
                for joint in 0..3 {
                    let (a, b) = (3 + SIDE * side + MOMENTS + joint, 3 + SIDE * side_there + MOMENTS + joint);
                    let slopes: Vec<f64> = here
                        .slopes
                        .iter()
                        .map(|s| -s[a] * scale)
                        .chain(there.slopes.iter().map(|s| s[b] * scale))
                        .collect();
                    row((there.values[b] - here.values[a]) * scale, &columns, &slopes);
                }
            }
        }
    }
}

impl Residuals for Problem<'_> {
    fn count(&self) -> usize {
        self.layout.count
    }

    fn cost(&mut self, x: &[f64]) -> f64 {
        for out in &mut self.outputs {
            out.slopes.clear();
        }
        self.evaluate(x, false);
        let mut cost = 0.0;
        self.rows(x, &mut |residual, _, _| cost += residual * residual);
        cost
    }

    fn linearise(&mut self, x: &[f64], normal: &mut NormalEquations) -> f64 {
        self.evaluate(x, true);
        let mut cost = 0.0;
        self.rows(x, &mut |residual, numbers, slopes| {
            cost += residual * residual;
            normal.add(residual, numbers, slopes);
        });
        cost
    }
}

/// The foot is in swing from this share of the cycle after foot off to this share before the next strike, at heel, ball and toes.
const SWING_MARGINS: [[f64; 2]; 3] = [[0.03, 0.025], [0.03, 0.04], [0.03, 0.04]];
/// Largest extension of the toes in the first guess [rad].
const TOES_LIMIT: f64 = 0.8;

/// One instant of the unchanged walk, with its targets.
struct Instant {
    /// Value, rate and acceleration of every coordinate.
    posture: [Vec<f64>; 3],
    /// Dependence of the coordinates on the coefficients.
    inputs: Vec<Input>,
    /// Numbers of the coefficients of all inputs, one after the other.
    columns: Vec<usize>,
    /// Targets, right and left.
    sides: [SideTarget; 2],
}

/// Targets of one side.
struct SideTarget {
    /// Vertical and fore-aft force [body weights].
    force: [f64; 2],
    /// Angle of the toes [rad].
    toes: f64,
    /// Whether heel, ball and toes must be clear of the ground.
    swing: [bool; 3],
}

impl Instant {
    fn new(human: &Human, machine: &mut WalkMachine, layout: &Layout, forces: &GroundForceLaws, phase: f64) -> Instant {
        let walk = machine.walk().clone();
        let count = human.model.coordinates().len();
        let mut posture = [vec![0.0; count], vec![0.0; count], vec![0.0; count]];
        let time_s = phase * walk.cycle_s();
        let [q, qd, qdd] = &mut posture;
        reference(machine, walk.speed(), layout, time_s, q, qd, qdd);
        let inputs = layout.inputs(phase, walk.cycle_s());
        let columns = inputs.iter().flat_map(|input| input.numbers).collect();
        let at = machine.step(time_s);
        let sides = [(&at.right, 0.0), (&at.left, 0.5)].map(|(leg, ahead)| {
            let place = (phase + ahead) % 1.0;
            let pitch = leg.hip.value - at.pelvis_tilt.value - leg.knee.value + leg.ankle.value;
            let stands = place < at.phases.foot_off;
            SideTarget {
                force: forces.at(place, walk.curve_speed(&walk.clock(time_s)).value),
                toes: if stands { (-pitch).clamp(0.0, TOES_LIMIT) } else { 0.0 },
                swing: SWING_MARGINS.map(|[after, before]| place > at.phases.foot_off + after && place < 1.0 - before),
            }
        });
        Instant { posture, inputs, columns, sides }
    }
}
