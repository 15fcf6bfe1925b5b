//! The unknowns: periodic splines that are added to the coordinates of a walk.

use crate::gait::machine::WalkMachine;
use crate::gait::{Jet, WalkCoordinates};
use crate::model::{CoordinateId, Model};
use crate::numerics::{OVERLAP, PeriodicSplines};

/// The change of one coordinate, or of a left and right pair.
#[derive(Debug, Clone)]
pub(super) struct Curve {
    pub(super) kind: Kind,
    /// The coordinate of the right side or in the middle; the one of the left side.
    pub(super) coordinates: [Option<CoordinateId>; 2],
    splines: PeriodicSplines,
    /// Number of its first coefficient.
    pub(super) first: usize,
}

/// The quantity that a curve changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Hip,
    Knee,
    Ankle,
    Toes,
    Forward,
    Height,
    Pelvis,
    Lumbar,
}

/// Names of the coordinates; those of legs end with `_`, and a side's letter is appended.
const CURVES: [(Kind, &str); 8] = [
    (Kind::Hip, "hip_flexion_"),
    (Kind::Knee, "knee_angle_"),
    (Kind::Ankle, "ankle_angle_"),
    (Kind::Toes, "mtp_angle_"),
    (Kind::Forward, "pelvis_tx"),
    (Kind::Height, "pelvis_ty"),
    (Kind::Pelvis, "pelvis_tilt"),
    (Kind::Lumbar, "lumbar_extension"),
];

/// All curves of a model, and the numbering of their coefficients.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    pub(super) curves: Vec<Curve>,
    pub(super) count: usize,
    coordinates: WalkCoordinates,
}

/// Dependence of one coordinate on the coefficients at one instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Input {
    pub(super) kind: Kind,
    /// The coordinate's number.
    pub(super) coordinate: usize,
    /// Numbers of the coefficients.
    pub(super) numbers: [usize; OVERLAP],
    /// Contribution of each to value, rate and acceleration.
    pub(super) weights: [[f64; OVERLAP]; 3],
}

impl Layout {
    pub(super) fn new(model: &Model, splines: [usize; 2]) -> Layout {
        let mut curves = Vec::new();
        let mut count = 0;
        for (kind, name) in CURVES {
            let paired = name.ends_with('_');
            let coordinates = if paired {
                ["r", "l"].map(|side| model.coordinate(&format!("{name}{side}")))
            } else {
                [model.coordinate(name), None]
            };
            if coordinates[0].is_none() {
                continue;
            }
            let splines = PeriodicSplines::new(if paired { splines[0] } else { splines[1] });
            curves.push(Curve { kind, coordinates, splines, first: count });
            count += splines.count();
        }
        Layout { curves, count, coordinates: WalkCoordinates::of(model) }
    }

    /// Numbers of the coefficients of a curve.
    pub(super) fn range(&self, kind: Kind) -> Option<std::ops::Range<usize>> {
        let curve = self.curves.iter().find(|curve| curve.kind == kind)?;
        Some(curve.first..curve.first + curve.splines.count())
    }

    /// Dependence of every changed coordinate on the coefficients at a phase of the right foot; derivatives are by time.
    pub(super) fn inputs(&self, phase: f64, cycle_s: f64) -> Vec<Input> {
        let mut inputs = Vec::new();
        for curve in &self.curves {
            for (side, coordinate) in curve.coordinates.iter().enumerate() {
                let Some(coordinate) = coordinate else { continue };
                // Legs repeat after a cycle, half a cycle apart; shared coordinates repeat after a step.
                let paired = curve.coordinates[1].is_some();
                let (place, rate) = if paired { (phase + 0.5 * side as f64, 1.0) } else { (2.0 * phase, 2.0) };
                let at = curve.splines.at(place);
                let rate: f64 = rate / cycle_s;
                let scale = [1.0, rate, rate * rate];
                inputs.push(Input {
                    kind: curve.kind,
                    coordinate: coordinate.index(),
                    numbers: at.numbers.map(|n| n + curve.first),
                    weights: std::array::from_fn(|d| at.values[d].map(|w| w * scale[d])),
                });
            }
        }
        inputs
    }

    /// Adds the change to a posture.
    pub(super) fn add(
        &self,
        coefficients: &[f64],
        phase: f64,
        cycle_s: f64,
        q: &mut [f64],
        qd: &mut [f64],
        qdd: &mut [f64],
    ) {
        for input in self.inputs(phase, cycle_s) {
            for (d, values) in [&mut *q, &mut *qd, &mut *qdd].into_iter().enumerate() {
                values[input.coordinate] += input.sum(coefficients, d);
            }
        }
    }
}

impl Layout {
    /// The change of every changed coordinate at a phase with its time derivatives; coordinates can come more than once.
    pub(super) fn changes<'a>(
        &'a self,
        coefficients: &'a [f64],
        phase: Jet,
    ) -> impl Iterator<Item = (usize, Jet)> + 'a {
        // With cycles of one second, derivatives are by phase.
        let inputs = self.inputs(phase.value, 1.0).into_iter();
        inputs.map(move |input| (input.coordinate, phase.through([0, 1, 2].map(|d| input.sum(coefficients, d)))))
    }
}

impl Input {
    /// Sum of the coefficients' contributions to value (0), rate (1) or acceleration (2).
    pub(super) fn sum(&self, coefficients: &[f64], derivative: usize) -> f64 {
        self.numbers.iter().zip(self.weights[derivative]).map(|(&n, w)| coefficients[n] * w).sum()
    }
}

/// Coordinates of the unchanged walk: what its state machine gives, with the pelvis moving forward at constant speed [m/s].
pub(super) fn reference(
    machine: &mut WalkMachine,
    speed: f64,
    layout: &Layout,
    time_s: f64,
    q: &mut [f64],
    qd: &mut [f64],
    qdd: &mut [f64],
) {
    for values in [&mut *q, &mut *qd, &mut *qdd] {
        values.fill(0.0);
    }
    layout.coordinates.write(&machine.step(time_s), q, qd, qdd);
    if let Some(Curve { coordinates: [Some(forward), _], .. }) =
        layout.curves.iter().find(|curve| curve.kind == Kind::Forward)
    {
        q[forward.index()] = speed * time_s;
        qd[forward.index()] = speed;
    }
}
