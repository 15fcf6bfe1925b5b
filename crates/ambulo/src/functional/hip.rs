//! The centre of a hip from a movement.
//!
//! **Symmetrical centre of rotation** (SCoRE). The point that is fixed in both segments:
//!
//!   min over c, k of  Σ_i |R_i c + t_i - (S_i k + d_i)|²
//!
//! for the poses (R, t) of one segment and (S, d) of the other; a linear system of six equations.
//!
//! **Ball joint.** The rotation of a thigh with few markers near each other is uncertain, which draws that centre
//! towards the markers. The markers themselves are far from the hip; so the centre is refined to that of the ball joint
//! which fits them best,
//!
//!   min over c, p_k, R_i of  Σ_i Σ_k |x_ik - c - R_i p_k|²
//!
//! with the markers x in the frame of the pelvis, their places p on the thigh from its centre, and a rotation R of the
//! thigh per frame. Gauss-Newton steps for c and p; the rotations are eliminated (a block of three per frame) and found
//! again by least squares.
//!
//! **Bias.** The distances of noisy points from a centre are too long, and the pelvis turns with the noise of its own
//! markers; over a part of a sphere both move the centre. The same movement is therefore made again from the estimate,
//! with noise of the size of the residuals on the markers of pelvis and thigh, and estimated again; what it is off by
//! on average is taken off.
//!
//! | code | symbol | unit |
//! |---|---|---|
//! | `centre` | c | m |
//! | `places` | p | m |
//! | `points` | x | m |
//!
//! Sources: Ehrig, Taylor, Duda, Heller 2006, J Biomech 39:2798 (abstract opened): the centre within 3 mm by most
//! methods if the movement spans 45 degrees, within 1.2 mm by SCoRE at 20 degrees, with noise of 1 mm. Ball joint:
//! derived here.
//! Pinned by: tests/functional.rs

use super::MOST_FRAMES;
use super::segments::LegSegments;
use crate::kinematics::calibration::fit_pose;
use crate::motion::MarkerRecording;
use crate::numerics::elementary::asin;
use crate::numerics::{DenseLu, Order, Random, counted, degrees, sampled};
use crate::spatial::{Mat3, Pose, Vec3};

/// Smallest range of the thigh in the plane in which it moves least [rad]: that of Ehrig's narrowest cone.
const LEAST_RANGE: f64 = 20.0 * std::f64::consts::PI / 180.0;
/// Fewest frames and markers of the thigh.
const FEWEST_FRAMES: usize = 20;
const FEWEST_MARKERS: usize = 2;
/// Skin slides by at most 20 to 30 mm; markers further from a ball joint do not move about one [m].
const MOST_RESIDUAL: f64 = 0.030;
/// A centre with a larger standard error is not better than a regression, which is 13 mm off [m].
const MOST_ERROR: f64 = 0.013;
/// Skin slides as the joint turns, so that frames that are nearer in time have the same error [s].
const INDEPENDENT_S: f64 = 0.25;
const STEPS: usize = 30;
/// The iteration ends when the centre moves by less [m].
const SMALL: f64 = 1e-6;
/// Movements that are made again to find the bias, and the seed of their noise.
const REPEATED: usize = 4;
const SEED: u64 = 2006;
/// Damping as a share of the largest diagonal entry: places and rotations of a thigh may turn together.
const DAMPING: f64 = 1e-9;

/// Poses of two segments in one frame.
pub type Rotated = [Pose; 2];

/// The centre of a hip that a movement shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FunctionalHip {
    /// In the frame of the pelvis of the body [m].
    pub centre_m: Vec3,
    /// Root mean square distance of the markers of the thigh from the ball joint [m].
    pub residual_m: f64,
    /// Standard error of the centre [m].
    pub error_m: f64,
    /// Range of the thigh in the plane in which it moves most, and across it [rad].
    pub range_rad: [f64; 2],
}

/// The point that is fixed in both segments, in the frame of each [m], and the root mean square distance of both
/// points [m]; `None` if the segments do not turn against each other about more than one axis.
#[must_use]
pub fn symmetrical_centre(frames: &[Rotated]) -> Option<([Vec3; 2], f64)> {
    let (mut matrix, mut right) = (DenseLu::default(), [0.0; 6]);
    matrix.clear(6);
    let cross: Mat3 = frames.iter().map(|[a, b]| a.rotation.transpose() * b.rotation).sum();
    let apart = |[a, b]: &Rotated| b.translation - a.translation;
    let of_a: Vec3 = frames.iter().map(|frame| frame[0].rotation.tr_mul(&apart(frame))).sum();
    let of_b: Vec3 = frames.iter().map(|frame| frame[1].rotation.tr_mul(&-apart(frame))).sum();
    for i in 0..3 {
        (matrix.row_mut(i)[i], matrix.row_mut(3 + i)[3 + i]) = (frames.len() as f64, frames.len() as f64);
        for j in 0..3 {
            matrix.row_mut(i)[3 + j] = -cross[(i, j)];
            matrix.row_mut(3 + j)[i] = -cross[(i, j)];
        }
        (right[i], right[3 + i]) = (of_a[i], of_b[i]);
    }
    if !matrix.factor() {
        return None;
    }
    matrix.solve(&mut right);
    let centres = [Vec3::new(right[0], right[1], right[2]), Vec3::new(right[3], right[4], right[5])];
    let distance = |[a, b]: &Rotated| (a.place(centres[0]) - b.place(centres[1])).norm_squared();
    let square = frames.iter().map(distance).sum::<f64>() / frames.len() as f64;
    square.is_finite().then(|| (centres, square.sqrt()))
}

/// The centre of a hip of a calibrated body.
pub(super) fn centre(leg: &LegSegments<'_>, movement: &MarkerRecording) -> Result<FunctionalHip, String> {
    let refused = |why: String| Err(format!("the movement does not show the centre of the {} hip: {why}", leg.side));
    if leg.thigh.markers.len() < FEWEST_MARKERS {
        return refused(format!("the thigh has {}; expected at least 2", counted(leg.thigh.markers.len(), "marker")));
    }
    let frames: Vec<Points> = sampled(movement.frames(), MOST_FRAMES).filter_map(|f| points(leg, f)).collect();
    if frames.len() < FEWEST_FRAMES {
        return refused(format!(
            "pelvis and thigh are visible in {}; expected at least {FEWEST_FRAMES}",
            counted(frames.len(), "frame")
        ));
    }
    let mut joint = BallJoint::of(leg, movement);
    let unknown = "the markers do not determine it";
    if joint.refine(&frames).is_none() {
        return refused(unknown.to_owned());
    }
    let residual_m = joint.residual(&frames);
    let Some((error_m, bias)) =
        joint.error(&frames, duration_s(movement)).zip(joint.bias(leg, &frames, pelvis_noise(leg, movement)))
    else {
        return refused(unknown.to_owned());
    };
    let range_rad = joint.ranges(&frames, residual_m);
    let [most, least] = range_rad.map(f64::to_degrees);
    if range_rad[1] < LEAST_RANGE {
        return refused(format!(
            "the thigh moves over {} in one plane and {least:.0} across it; expected at least {:.0} in both",
            degrees(most),
            LEAST_RANGE.to_degrees()
        ));
    }
    if residual_m > MOST_RESIDUAL || error_m > MOST_ERROR {
        return refused(format!(
            "the markers of the thigh are {:.0} mm from a ball joint, whose centre is uncertain by {:.0} mm; expected \
             at most {:.0} and {:.0} mm",
            1e3 * residual_m,
            1e3 * error_m,
            1e3 * MOST_RESIDUAL,
            1e3 * MOST_ERROR
        ));
    }
    Ok(FunctionalHip { centre_m: joint.centre - bias, residual_m, error_m, range_rad })
}

fn duration_s(movement: &MarkerRecording) -> f64 {
    movement.times.last().zip(movement.times.first()).map_or(0.0, |(last, first)| last - first)
}

/// Deviation of the markers of the pelvis along an axis from a rigid pelvis [m].
fn pelvis_noise(leg: &LegSegments<'_>, movement: &MarkerRecording) -> f64 {
    let (mut sum, mut free) = (0.0, 0);
    for frame in sampled(movement.frames(), MOST_FRAMES) {
        let Some(pose) = leg.pelvis.pose(frame, None) else { continue };
        for (place, path) in leg.pelvis.markers.iter().filter(|(_, path)| path.is_seen(frame)) {
            sum += (path.positions[frame] - pose.place(*place)).norm_squared();
            free += 3;
        }
        free -= 6;
    }
    if free > 0 { (sum / f64::from(free)).sqrt() } else { 0.0 }
}

/// The markers of a thigh in one frame [m]; `None` if not visible.
type Points = Vec<Option<Vec3>>;

/// The markers of the thigh in the frame of the pelvis [m]; `None` if it is not known, or too few are visible.
fn points(leg: &LegSegments<'_>, frame: usize) -> Option<Points> {
    let pelvis = leg.pelvis.pose(frame, None)?;
    let local = |point: Vec3| pelvis.rotation.tr_mul(&(point - pelvis.translation));
    let of_thigh = leg.thigh.markers.iter();
    let points: Vec<_> = of_thigh.map(|(_, path)| path.is_seen(frame).then(|| local(path.positions[frame]))).collect();
    (points.iter().flatten().count() >= FEWEST_MARKERS).then_some(points)
}

/// A ball joint: its centre in the frame of the pelvis, and the places of the markers from it in the frame of the
/// thigh [m].
#[derive(Clone)]
struct BallJoint {
    centre: Vec3,
    places: Vec<Vec3>,
}

impl BallJoint {
    /// By the symmetrical centre of rotation; the centre of the calibrated body if the thigh has too few markers.
    fn of(leg: &LegSegments<'_>, movement: &MarkerRecording) -> BallJoint {
        let both = |frame| Some([leg.pelvis.pose(frame, None)?, leg.thigh.pose(frame, None)?]);
        let rotated: Vec<Rotated> = sampled(movement.frames(), MOST_FRAMES).filter_map(both).collect();
        let found = (rotated.len() >= FEWEST_FRAMES).then(|| symmetrical_centre(&rotated)).flatten();
        let near = found.filter(|([centre, _], _)| (centre - leg.hip).norm() < 0.1);
        let ([centre, in_thigh], _) = near.unwrap_or(([leg.hip, Vec3::zeros()], 0.0));
        BallJoint { centre, places: leg.thigh.markers.iter().map(|(place, _)| place - in_thigh).collect() }
    }

    /// The rotation of the thigh in a frame, by least squares about the centre.
    fn rotation(&self, points: &[Option<Vec3>]) -> Option<Mat3> {
        let pairs = points.iter().zip(&self.places).filter_map(|(point, place)| Some(((*point)?, place)));
        let spread: Mat3 = pairs.map(|(point, place)| (point - self.centre) * place.transpose()).sum();
        let svd = spread.try_svd(true, true, f64::EPSILON, 200)?;
        let (u, v_t) = (svd.u?, svd.v_t?);
        let mut turn = Mat3::identity();
        let least = svd.singular_values.imin();
        turn[(least, least)] = (u * v_t).determinant().signum();
        Some(u * turn * v_t)
    }

    /// Moves centre and places to the best ones; `None` if the markers do not determine them.
    fn refine(&mut self, frames: &[Points]) -> Option<()> {
        for _ in 0..STEPS {
            let (matrix, mut step) = self.equations(frames);
            factored(matrix, step.len())?.solve(&mut step);
            self.centre += Vec3::from_column_slice(&step[..3]);
            for (place, step) in self.places.iter_mut().zip(step[3..].chunks(3)) {
                *place += Vec3::from_column_slice(step);
            }
            if Vec3::from_column_slice(&step[..3]).norm() < SMALL {
                break;
            }
        }
        self.centre.iter().all(|x| x.is_finite()).then_some(())
    }

    /// Variance of a marker along an axis [m²].
    fn variance(&self, frames: &[Points]) -> f64 {
        let seen: usize = frames.iter().map(|points| points.iter().flatten().count()).sum();
        let unknowns = 3 * (frames.len() + 1 + self.places.len());
        self.residual(frames).powi(2) * seen as f64 / (3 * seen).saturating_sub(unknowns).max(1) as f64
    }

    /// Standard error of the centre [m].
    fn error(&self, frames: &[Points], duration_s: f64) -> Option<f64> {
        // Frames that are near in time do not add to what others show.
        let repeated = (frames.len() as f64 * INDEPENDENT_S / duration_s.max(INDEPENDENT_S)).max(1.0);
        let (matrix, right) = self.equations(frames);
        let matrix = factored(matrix, right.len())?;
        let trace: f64 = (0..3).map(|i| unit_solution(&matrix, right.len(), i)).sum();
        let error_m = (self.variance(frames) * repeated * trace).sqrt();
        error_m.is_finite().then_some(error_m)
    }

    /// What the centre is off by on average because the markers are noisy [m].
    fn bias(&self, leg: &LegSegments<'_>, frames: &[Points], pelvis_noise: f64) -> Option<Vec3> {
        let noise = [pelvis_noise, self.variance(frames).sqrt()];
        let mut random = Random::seeded(SEED);
        let mut off = Vec3::zeros();
        for _ in 0..REPEATED {
            let made: Vec<Points> =
                frames.iter().filter_map(|points| self.made_again(leg, points, noise, &mut random)).collect();
            let mut found = self.clone();
            found.refine(&made)?;
            off += (found.centre - self.centre) / REPEATED as f64;
        }
        Some(off)
    }

    /// The markers of the thigh in a frame, in the frame of a pelvis whose own markers are noisy too.
    fn made_again(
        &self,
        leg: &LegSegments<'_>,
        points: &[Option<Vec3>],
        [of_pelvis, of_thigh]: [f64; 2],
        random: &mut Random,
    ) -> Option<Points> {
        let rotation = self.rotation(points)?;
        let mut shaken =
            |point: Vec3, metres: f64| point + Vec3::new(random.normal(), random.normal(), random.normal()) * metres;
        let places: Vec<Vec3> = leg.pelvis.markers.iter().map(|(place, _)| *place).collect();
        let recorded: Vec<Vec3> = places.iter().map(|place| shaken(*place, of_pelvis)).collect();
        let pelvis = fit_pose(&places, &recorded)?;
        let local = |point: Vec3| pelvis.rotation.tr_mul(&(point - pelvis.translation));
        let made = |(point, place): (&Option<Vec3>, &Vec3)| {
            let shown = shaken(self.centre + rotation * place, of_thigh);
            point.is_some().then(|| local(shown))
        };
        Some(points.iter().zip(&self.places).map(made).collect())
    }

    /// Normal equations of the step of centre and places, row by row, with the rotations eliminated, and their right
    /// side.
    fn equations(&self, frames: &[Points]) -> (Vec<f64>, Vec<f64>) {
        let size = 3 + 3 * self.places.len();
        let (mut matrix, mut right) = (vec![0.0; size * size], vec![0.0; size]);
        for points in frames {
            if let Some(rotation) = self.rotation(points) {
                self.add_frame(points, &rotation, &mut matrix, &mut right);
            }
        }
        (matrix, right)
    }

    fn add_frame(&self, points: &[Option<Vec3>], rotation: &Mat3, matrix: &mut [f64], right: &mut [f64]) {
        let size = right.len();
        // Slopes of the residuals against the turn of the thigh, times those against centre and places.
        let mut coupling = vec![Mat3::zeros(); size / 3];
        let mut of_turn = Mat3::zeros();
        let mut add = |row: usize, column: usize, block: &Mat3| {
            for i in 0..3 {
                for j in 0..3 {
                    matrix[(row * 3 + i) * size + column * 3 + j] += block[(i, j)];
                }
            }
        };
        for (k, point) in points.iter().enumerate().filter_map(|(k, point)| Some((k + 1, (*point)?))) {
            let arm = rotation * self.places[k - 1];
            let residual = point - self.centre - arm;
            let cross = arm.cross_matrix();
            of_turn += cross.tr_mul(&cross);
            coupling[0] -= cross;
            coupling[k] = -rotation.tr_mul(&cross);
            add(0, 0, &Mat3::identity());
            add(k, k, &Mat3::identity());
            add(0, k, rotation);
            add(k, 0, &rotation.transpose());
            let own = rotation.tr_mul(&residual);
            for i in 0..3 {
                right[i] += residual[i];
                right[3 * k + i] += own[i];
            }
        }
        // The rotation is the best one, so that its own right side is zero.
        of_turn += Mat3::identity() * (DAMPING * of_turn.trace());
        let Some(inverse) = of_turn.try_inverse() else { return };
        for (row, left) in coupling.iter().enumerate() {
            for (column, other) in coupling.iter().enumerate() {
                add(row, column, &-(left * inverse * other.transpose()));
            }
        }
    }

    /// Root mean square distance of the markers [m].
    fn residual(&self, frames: &[Points]) -> f64 {
        let (mut sum, mut count) = (0.0, 0);
        for points in frames {
            let Some(rotation) = self.rotation(points) else { continue };
            for (point, place) in points.iter().zip(&self.places).filter_map(|(point, place)| Some(((*point)?, place)))
            {
                sum += (point - self.centre - rotation * place).norm_squared();
                count += 1;
            }
        }
        (sum / f64::from(count.max(1))).sqrt()
    }

    /// Ranges of the direction of the thigh in the plane in which it moves most, and across it [rad]: those of
    /// oscillations with the same deviation, without the part that the residual explains.
    fn ranges(&self, frames: &[Points], residual_m: f64) -> [f64; 2] {
        let arm: Vec3 = self.places.iter().sum::<Vec3>() / self.places.len() as f64;
        let length = arm.norm().max(f64::MIN_POSITIVE);
        let turned = frames.iter().filter_map(|points| Some(self.rotation(points)? * arm / length));
        let directions: Vec<Vec3> = turned.collect();
        let mean = directions.iter().sum::<Vec3>() / directions.len() as f64;
        let spread: Mat3 = directions.iter().map(|d| (d - mean) * (d - mean).transpose()).sum();
        let mut values: Vec<f64> = spread.symmetric_eigenvalues().iter().map(|v| v / directions.len() as f64).collect();
        values.sort_by_number(|value| -value);
        let noise = (residual_m / length).powi(2) / self.places.len() as f64;
        [values[0], values[1]].map(|v| 2.0 * asin((2.0 * (v - noise).max(0.0)).sqrt().min(1.0)))
    }
}

fn factored(mut entries: Vec<f64>, size: usize) -> Option<DenseLu> {
    let largest = (0..size).map(|i| entries[i * size + i]).fold(0.0, f64::max);
    (0..size).for_each(|i| entries[i * size + i] += DAMPING * largest);
    let mut matrix = DenseLu::default();
    matrix.clear(size);
    entries.chunks(size).enumerate().for_each(|(row, entries)| matrix.row_mut(row).copy_from_slice(entries));
    matrix.factor().then_some(matrix)
}

/// A diagonal entry of the inverse.
fn unit_solution(matrix: &DenseLu, size: usize, i: usize) -> f64 {
    let mut unit = vec![0.0; size];
    unit[i] = 1.0;
    matrix.solve(&mut unit);
    unit[i]
}
