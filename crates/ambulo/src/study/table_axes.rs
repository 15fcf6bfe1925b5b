//! Axes and units of a table of ground forces, recognised from the body weight.
//!
//! The mean ground force points up, because the mean horizontal acceleration of a person is nearly zero: an axis with
//! nine tenths of the mean force is the vertical. If this axis is not y, the table has other axes; the direction about
//! the vertical is the one that puts the centres of pressure under the feet. The unit of the forces follows from the
//! weight of a step ([`ForceUnit::of_steps`]), and the unit of the moments from their lever: a foot is shorter than
//! half a metre.
//!
//! Pinned by: ambulo-cli/tests/plates.rs

use crate::findings::{Code, Findings};
use crate::ground::{CENTER_OF_PRESSURE_LOAD_N, FootPaths};
use crate::motion::ForceRecording;
use crate::motion::force_plate::{ForceUnit, stepped_weight};
use crate::numerics::{Shown, median};
use crate::spatial::{Mat3, Vec3};

/// Least share of the mean force along the vertical axis: over whole steps the horizontal forces nearly cancel.
const UPRIGHT: f64 = 0.9;
/// A person is on the ground if the sum of the forces exceeds half of its largest value in this share of the time; its
/// mean is then the weight.
const ON_GROUND_SHARE: f64 = 0.7;
/// A free moment of a foot has a shorter lever than this; it is some 0.01 m [m].
const LONGEST_LEVER_M: f64 = 0.5;
/// Moments about the origin of the laboratory have a shorter lever than this [m].
const LABORATORY_M: f64 = 60.0;

/// Converts the forces of a table to world axes, newtons and newton metres. Returns whether they were in body weights,
/// from which no body mass follows.
pub(super) fn in_world(
    forces: &mut [ForceRecording],
    world_from_lab: Option<&Mat3>,
    weight_n: f64,
    paths: Option<&FootPaths>,
    findings: &mut Findings,
) -> bool {
    let other = turn_to_world(forces, world_from_lab, findings);
    let up = other.as_ref().map_or(Vec3::y(), |vertical| vertical.up);
    let is_relative = to_newtons(forces, up, weight_n, findings);
    to_newton_metres(forces, up, findings);
    if let Some(vertical) = other {
        vertical.turn_upright(forces, paths, findings);
    }
    is_relative
}

/// The vertical of a table whose y is not up.
struct Vertical {
    /// Upward direction in the table's axes.
    up: Vec3,
    /// The axis of the load, with its sign.
    axis: usize,
    sign: f64,
}

/// Rotates forces from the axes of the markers to world axes, unless they are upright already. Returns the vertical
/// axis of the table if both are wrong.
fn turn_to_world(
    forces: &mut [ForceRecording],
    world_from_lab: Option<&Mat3>,
    findings: &mut Findings,
) -> Option<Vertical> {
    let sum = sum_of_loads(forces);
    let share = |sum: Vec3| sum / sum.norm();
    let is_upright = |sum: Vec3| share(sum).y > UPRIGHT;
    let of_markers = world_from_lab.map(|world_from_lab| world_from_lab * sum);
    if is_upright(sum) && of_markers.is_some_and(|turned| !is_upright(turned)) {
        findings.report(
            Code::LoadsWorldAxes,
            "the forces of the table are not in the axes of the markers; they are taken as x forward, y up, z right",
        );
        return None;
    }
    let axis = share(sum).iamax();
    let is_other_axis =
        axis != 1 && share(sum)[axis].abs() > UPRIGHT && !of_markers.is_some_and(|t| share(t).y.abs() > UPRIGHT);
    if is_other_axis {
        let sign = sum[axis].signum();
        return Some(Vertical { up: Vec3::ith(axis, sign), axis, sign });
    }
    if let Some(world_from_lab) = world_from_lab {
        forces.iter_mut().for_each(|force| force.rotate(world_from_lab));
    }
    None
}

/// The sum of all forces. A load against the largest one has the other sign: it is the force on a plate.
fn sum_of_loads(forces: &[ForceRecording]) -> Vec3 {
    let of = |load: &ForceRecording| -> Vec3 { load.force.iter().filter(|f| f.iter().all(|x| x.is_finite())).sum() };
    let sums: Vec<Vec3> = forces.iter().map(of).collect();
    let largest = sums.iter().copied().max_by(|a, b| a.norm().total_cmp(&b.norm())).unwrap_or_default();
    sums.iter().map(|sum| if sum.dot(&largest) < 0.0 { -sum } else { *sum }).sum()
}

/// Converts forces that give no plausible body weight in newtons. Returns whether they were in body weights.
fn to_newtons(forces: &mut [ForceRecording], up: Vec3, weight_n: f64, findings: &mut Findings) -> bool {
    let vertical = |force: &ForceRecording| force.force.iter().map(|f| f.dot(&up)).collect::<Vec<f64>>();
    let steps = forces.iter().filter_map(|force| stepped_weight(&force.times, &vertical(force)));
    let stepped = median(steps).or_else(|| standing_weight(forces, up));
    let unit = stepped.and_then(|stepped| Some((stepped, ForceUnit::of_steps(stepped, Some(weight_n))?)));
    let Some((stepped, unit)) = unit else { return false };
    let factor = unit.newtons(Some(weight_n)).unwrap_or(1.0);
    for force in forces.iter_mut() {
        force.force.iter_mut().for_each(|v| *v *= factor);
        // The moments may have stayed in N.m.
        let multiplied = ForceRecording { moment: force.moment.iter().map(|m| m * factor).collect(), ..force.clone() };
        if has_lever_of_a_foot(&multiplied, up) || !has_lever_of_a_foot(force, up) {
            force.moment = multiplied.moment;
        }
    }
    let message = format!(
        "the body weight is {} N by the forces of the table and {weight_n:.0} N by the body mass: the table is in {}; \
         it was multiplied by {factor:.0}. hint: write newtons",
        Shown((1e4 * stepped).round() / 1e4),
        unit.name()
    );
    findings.report(Code::LoadsUnitByWeight, message);
    unit == ForceUnit::BodyWeights
}

/// The mean of the sum of all forces, if the person is on the ground all the time.
fn standing_weight(forces: &[ForceRecording], up: Vec3) -> Option<f64> {
    let samples = forces.iter().map(|force| force.force.len()).min()?;
    let total: Vec<f64> = (0..samples).map(|i| forces.iter().map(|f| f.force[i].dot(&up)).sum()).collect();
    let most = total.iter().copied().fold(0.0, f64::max);
    let loaded: Vec<f64> = total.iter().copied().filter(|x| *x > 0.5 * most).collect();
    let is_standing = most > 0.0 && loaded.len() as f64 > ON_GROUND_SHARE * samples as f64;
    is_standing.then(|| loaded.iter().sum::<f64>() / loaded.len() as f64)
}

/// Divides moments by 1000 if their lever is too long for a foot and for a laboratory: they are in N.mm.
fn to_newton_metres(forces: &mut [ForceRecording], up: Vec3, findings: &mut Findings) {
    for force in forces {
        let lever_m = lever_m(force, up);
        if !has_lever_of_a_foot(force, up) {
            force.moment.iter_mut().for_each(|moment| *moment *= 1e-3);
            let message = format!(
                "the moments of the load `{}` have a lever of {lever_m:.1} m in the median, longer than a foot; they \
                 are in N.mm and were divided by 1000",
                force.name
            );
            findings.report(Code::LoadsUnitByWeight, message);
        }
    }
}

/// Whether the lever of the moments is plausible for a foot, or for moments about the origin of the laboratory.
fn has_lever_of_a_foot(force: &ForceRecording, up: Vec3) -> bool {
    let has_points = force.point.iter().any(|point| point.norm() > 0.0);
    lever_m(force, up) < if has_points { LONGEST_LEVER_M } else { LABORATORY_M }
}

/// Lever of the moments under load, the median [m].
fn lever_m(force: &ForceRecording, up: Vec3) -> f64 {
    let lever = |(force, moment): (&Vec3, &Vec3)| {
        (force.dot(&up) > CENTER_OF_PRESSURE_LOAD_N).then(|| moment.norm() / force.norm())
    };
    median(force.force.iter().zip(&force.moment).filter_map(lever)).unwrap_or(0.0)
}

impl Vertical {
    /// Turns the forces so that y is up, and about the vertical so that the feet are under the centres of pressure.
    fn turn_upright(&self, forces: &mut [ForceRecording], paths: Option<&FootPaths>, findings: &mut Findings) {
        let turned = |(rotation, sign): &(Mat3, f64)| -> Vec<ForceRecording> {
            let mut turned = forces.to_vec();
            for force in &mut turned {
                force.rotate(rotation);
                force.force.iter_mut().chain(&mut force.moment).for_each(|v| *v *= *sign);
            }
            turned
        };
        let apart = |candidate: &(Mat3, f64)| paths.map_or(f64::INFINITY, |paths| apart_m(paths, &turned(candidate)));
        let candidates = self.candidates();
        let distances: Vec<f64> = candidates.iter().map(apart).collect();
        // Of equal ones the first: that with the usual axes.
        let best = (0..candidates.len()).min_by(|a, b| distances[*a].total_cmp(&distances[*b])).unwrap_or(0);
        let read = turned(&candidates[best]);
        forces.clone_from_slice(&read);
        let (name, minus) = (["x", "y", "z"][self.axis], if self.sign < 0.0 { "-" } else { "" });
        let under = match distances[best].is_finite() {
            true => format!(", with which the centres of pressure lie {:.0} mm from the feet", 1e3 * distances[best]),
            false => String::new(),
        };
        let (forward, reversed) = (self.forward(&candidates[best].0), candidates[best].1 < 0.0);
        let on_plate =
            if reversed { "; they are the forces of the feet on the ground, so all signs were reversed" } else { "" };
        let message = format!(
            "the forces of the table carry the body along {minus}{name}, not along y: {name} is vertical in this \
             table; it was turned to y up and {forward} forward{under}{on_plate}. hint: turn the table"
        );
        findings.report(Code::LoadsTurned, message);
    }

    /// Rotations that make the axis vertical, with the sign of the forces; the usual one, which keeps x or else turns y
    /// forward, first.
    fn candidates(&self) -> Vec<(Mat3, f64)> {
        let ups = if self.sign < 0.0 { vec![(1.0, -1.0), (-1.0, 1.0)] } else { vec![(1.0, 1.0)] };
        let others = [0, 1, 2].into_iter().filter(|axis| *axis != self.axis);
        let forwards: Vec<Vec3> = others.flat_map(|axis| [Vec3::ith(axis, 1.0), Vec3::ith(axis, -1.0)]).collect();
        let rotation = |up: Vec3, forward: Vec3| {
            Mat3::from_rows(&[forward.transpose(), up.transpose(), forward.cross(&up).transpose()])
        };
        let of_up = |(up, sign): (f64, f64)| {
            let up = Vec3::ith(self.axis, up);
            forwards.iter().map(move |forward| (rotation(up, *forward), sign)).collect::<Vec<_>>()
        };
        ups.into_iter().flat_map(of_up).collect()
    }

    /// The axis of the table that points forward.
    fn forward(&self, rotation: &Mat3) -> String {
        let forward = rotation.row(0);
        let axis = forward.iamax_full().1;
        format!("{}{}", if forward[axis] < 0.0 { "-" } else { "" }, ["x", "y", "z"][axis])
    }
}

/// Mean distance of the loads from the nearer foot [m]; infinite without a loaded step.
fn apart_m(paths: &FootPaths, forces: &[ForceRecording]) -> f64 {
    let spans = paths.spans(forces);
    let nearest: Vec<f64> =
        spans.iter().flatten().map(|span| span.distance_m.right.min(span.distance_m.left)).collect();
    if nearest.is_empty() { f64::INFINITY } else { nearest.iter().sum::<f64>() / nearest.len() as f64 }
}
