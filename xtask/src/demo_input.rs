//! `cargo xtask demo-input`: makes the walk of `ambulo demo` from a handful of round numbers.
//!
//! The joint angles are Fourier series of the gait cycle whose coefficients were chosen by hand to look like walking; the
//! two legs are half a cycle apart. The pelvis goes where the standing feet carry it. The ground forces are those that
//! the motion needs: the wrench that inverse dynamics finds at the free root is put under the feet, split by the lever
//! rule between the rear foot's toe and the front foot's heel, so motion and forces agree by construction. This walk is
//! an example for the program, not a measurement of anybody.

use ambulo::dynamics::{Forces, Workspace, inverse};
use ambulo::findings::Findings;
use ambulo::kinematics::{Trajectory, body_motion};
use ambulo::model::{BodyId, Model, from_osim};
use ambulo::motion::{Motion, SmoothSettings, Smoother, TimeGrid, Window, smooth};
use ambulo::spatial::Vec3;
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;
use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

/// Duration of a gait cycle [s].
const CYCLE_S: f64 = 1.1;
const RATE_HZ: f64 = 100.0;
/// Two whole cycles of each foot and a little more.
const FRAMES: usize = 291;
/// The right foot strikes at this instant [s].
const FIRST_STRIKE_S: f64 = 0.2;
/// Mean, then cosine and sine of each harmonic of the cycle that begins with the same side's foot strike [deg].
const HIP_FLEXION: &[f64] = &[15.0, 19.5, -3.5, -4.5, -1.0];
const KNEE_FLEXION: &[f64] = &[23.0, -2.0, -20.0, -14.0, 6.5, -2.0, 3.5];
const ANKLE_DORSIFLEXION: &[f64] = &[1.0, -1.0, 6.5, -0.5, -8.5, -0.5, 1.5];
const HIP_ADDUCTION: &[f64] = &[0.0, -1.0, 3.0];
const PELVIS_LIST: &[f64] = &[0.0, 0.5, -2.5];
const PELVIS_ROTATION: &[f64] = &[0.0, -4.0, 0.0];
/// The trunk leans forward a little and turns against the pelvis [deg].
const LUMBAR_ROTATION: &[f64] = &[0.0, 7.0, 0.0];
/// Lateral sway of the pelvis, towards the standing foot [m].
const SWAY: &[f64] = &[0.0, -0.005, 0.030];
/// Heel and toe in the foot [m].
const HEEL: Vec3 = Vec3::new(-0.05, -0.07, 0.0);
const TOE: Vec3 = Vec3::new(0.18, -0.07, 0.0);
/// The pelvis goes ahead of its mean and falls behind (first two harmonics of the step), and rises and falls, twice a
/// cycle [m]: an inverted pendulum
/// brakes while its foot is ahead and speeds up when the foot is behind, and is lowest in double support.
const SURGE: [f64; 2] = [0.011, 0.0012];
const BOB: f64 = 0.015;
/// Phase of the middle of double support [rad].
const DOUBLE_SUPPORT: f64 = 0.38;

/// Writes `walk.mot`, `walk_grf.mot` and `walk_grf.xml` beside `figure.osim` in `folder`.
pub(crate) fn write(folder: &Path) -> Result<(), String> {
    let say = |e: &dyn std::fmt::Display| e.to_string();
    let bytes = fs::read(folder.join("figure.osim")).map_err(|e| say(&e))?;
    let document = OsimModel::read(&bytes).map_err(|e| say(&e))?;
    let model = from_osim(&document, &mut Findings::default()).map_err(|e| say(&e))?;
    let mut walk = Walk::joint_angles(&model)?;
    walk.carry_pelvis(&model)?;
    let trajectory = walk.trajectory(&model)?;
    let forces = inverse(&mut Workspace::new(&model), &trajectory, &[]);
    let feet = split(&model, &trajectory, &forces)?;
    let motion = walk.table(&model).map_err(|e| say(&e))?;
    let ground = ground_table(&walk.grid, &feet).map_err(|e| say(&e))?;
    for (name, bytes) in [
        ("walk.mot", motion.write_storage()),
        ("walk_grf.mot", ground.write_storage()),
        ("walk_grf.xml", external_loads().write()),
    ] {
        fs::write(folder.join(name), bytes).map_err(|e| say(&e))?;
    }
    Ok(())
}

/// The walk is free of noise.
const AS_MADE: SmoothSettings =
    SmoothSettings { smoother: Smoother::Off, window: Window { from_s: None, to_s: None }, rate_hz: None };

/// Coordinates of the figure, one column each [rad or m].
struct Walk {
    grid: TimeGrid,
    columns: Vec<Vec<f64>>,
}

fn fourier(series: &[f64], phase: f64) -> f64 {
    let harmonics = series[1..].chunks(2).enumerate();
    series[0]
        + harmonics
            .map(|(k, c)| {
                let angle = (k + 1) as f64 * phase;
                c[0] * angle.cos() + c[1] * angle.sin()
            })
            .sum::<f64>()
}

impl Walk {
    fn joint_angles(model: &Model) -> Result<Walk, String> {
        let grid = TimeGrid { start_s: 0.0, step_s: 1.0 / RATE_HZ, frames: FRAMES };
        let columns = model.coordinates().iter().map(|c| vec![c.default_value; FRAMES]).collect();
        let mut walk = Walk { grid, columns };
        for (side, lag) in [("r", 0.0), ("l", TAU / 2.0)] {
            walk.set(model, &format!("hip_flexion_{side}"), HIP_FLEXION, lag, 1.0)?;
            walk.set(model, &format!("hip_adduction_{side}"), HIP_ADDUCTION, lag, 1.0)?;
            walk.set(model, &format!("knee_angle_{side}"), KNEE_FLEXION, lag, -1.0)?;
            walk.set(model, &format!("ankle_angle_{side}"), ANKLE_DORSIFLEXION, lag, 1.0)?;
        }
        walk.set(model, "pelvis_list", PELVIS_LIST, 0.0, 1.0)?;
        walk.set(model, "pelvis_rotation", PELVIS_ROTATION, 0.0, 1.0)?;
        walk.set(model, "lumbar_extension", &[-4.0], 0.0, 1.0)?;
        walk.set(model, "lumbar_rotation", LUMBAR_ROTATION, 0.0, 1.0)?;
        walk.set(model, "pelvis_tz", SWAY, 0.0, 1.0_f64.to_degrees())?;
        Ok(walk)
    }

    fn phase(&self, frame: usize) -> f64 {
        TAU * (self.grid.time(frame) - FIRST_STRIKE_S) / CYCLE_S
    }

    fn set(&mut self, model: &Model, name: &str, series: &[f64], lag: f64, sign: f64) -> Result<(), String> {
        let column = (0..FRAMES).map(|i| sign * fourier(series, self.phase(i) - lag).to_radians()).collect();
        *self.column(model, name)? = column;
        Ok(())
    }

    fn column(&mut self, model: &Model, name: &str) -> Result<&mut Vec<f64>, String> {
        let id = model.coordinate(name).ok_or_else(|| format!("figure.osim has no coordinate {name}"))?;
        Ok(&mut self.columns[id.index()])
    }

    /// Mean height and speed of the pelvis such that the foot of the first half of its cycle stands on the floor and
    /// does not slip, with the surge and bob of the step.
    fn carry_pelvis(&mut self, model: &Model) -> Result<(), String> {
        let trajectory = self.trajectory(model)?;
        let (mut height, mut speed) = (vec![0.0; FRAMES], vec![0.0; FRAMES]);
        let phases: Vec<f64> = (0..FRAMES).map(|i| self.phase(i)).collect();
        let [right, left] = feet(model)?;
        let ty = model.coordinate("pelvis_ty").ok_or("figure.osim has no pelvis_ty")?;
        trajectory.for_each_posture(|frame, posture| {
            let bodies = body_motion(model, posture);
            let foot = &bodies[if phases[frame].sin() >= 0.0 { right } else { left }.index()];
            let [heel, toe] = [HEEL, TOE].map(|p| foot.pose.place(p));
            let point = if heel.y < toe.y { heel } else { toe };
            height[frame] = posture.q[ty.index()] - point.y;
            speed[frame] = -foot.twist.velocity_at(point - foot.center).x;
        });
        let cycle = (CYCLE_S * RATE_HZ).round() as usize;
        let mean = |series: &[f64]| series[..cycle].iter().sum::<f64>() / cycle as f64;
        let (height, speed, grid) = (mean(&height), mean(&speed), self.grid);
        let step = |i: usize| 2.0 * (phases[i] - DOUBLE_SUPPORT);
        let forward = |i: usize| {
            speed * (grid.time(i) - FIRST_STRIKE_S) + SURGE[0] * step(i).sin() + SURGE[1] * (2.0 * step(i)).sin()
        };
        *self.column(model, "pelvis_ty")? = (0..FRAMES).map(|i| height - BOB * step(i).cos()).collect();
        *self.column(model, "pelvis_tx")? = (0..FRAMES).map(forward).collect();
        Ok(())
    }

    fn trajectory(&self, model: &Model) -> Result<Trajectory, String> {
        let motion = Motion {
            origin: "demo".into(),
            times: self.grid.times(),
            columns: self.columns.iter().cloned().map(Some).collect(),
        };
        let mut findings = Findings::default();
        let smoothed = smooth(model, &motion, AS_MADE, &mut findings);
        let smoothed = smoothed.map_err(|e| e.to_string())?;
        Trajectory::complete(model, &smoothed, &mut findings).map_err(|e| e.to_string())
    }

    fn table(&self, model: &Model) -> Result<Table, ambulo_formats::Error> {
        let mut columns = vec![("time".to_owned(), self.grid.times())];
        for (coordinate, values) in model.coordinates().iter().zip(&self.columns) {
            let turn = coordinate.kind == ambulo::model::CoordinateKind::Rotation;
            let shown = values.iter().map(|x| rounded(if turn { x.to_degrees() } else { *x })).collect();
            columns.push((coordinate.name.clone(), shown));
        }
        let mut table = Table::new("Coordinates", columns)?;
        table.in_degrees = Some(true);
        Ok(table)
    }
}

/// Nine decimals: an error of 1e-9 m becomes 1e-4 m/s² in the second derivative at 100 Hz, 0.007 N of the whole body.
fn rounded(x: f64) -> f64 {
    (x * 1e9).round() / 1e9
}

fn feet(model: &Model) -> Result<[BodyId; 2], String> {
    match ["calcn_r", "calcn_l"].map(|name| model.body(name)) {
        [Some(right), Some(left)] => Ok([right, left]),
        _ => Err("figure.osim has no calcn_r and calcn_l".into()),
    }
}

/// Force, centre of pressure and free moment about the vertical of one foot at one instant.
#[derive(Clone, Copy)]
struct FootLoad {
    force: Vec3,
    center: Vec3,
    free_moment: f64,
}

/// The root's wrench under the feet: [right, left] for each frame.
///
/// Total centre of pressure p = (u × M₀) / F_y on the floor. The share of the front foot is where p lies between the
/// rear toe and the front heel; both centres are then shifted alike so that they balance p exactly.
fn split(model: &Model, trajectory: &Trajectory, forces: &Forces) -> Result<Vec<[FootLoad; 2]>, String> {
    let [right, left] = feet(model)?;
    let mut loads = Vec::new();
    trajectory.for_each_posture(|frame, posture| {
        let bodies = body_motion(model, posture);
        let root = forces.reactions[0][frame];
        let about_origin = root.wrench.about(root.center);
        let (force, moment) = (about_origin.force, about_origin.moment);
        let total = Vec3::y().cross(&moment) / force.y;
        let feet = [right, left].map(|id| bodies[id.index()].pose);
        let front = usize::from(feet[1].translation.x > feet[0].translation.x);
        let floor = |p: Vec3| Vec3::new(p.x, 0.0, p.z);
        let (toe, heel) = (floor(feet[1 - front].place(TOE)), floor(feet[front].place(HEEL)));
        // While the feet pass each other only one stands: the right one in the first half of its cycle.
        let standing = usize::from((TAU * (trajectory.grid().time(frame) - FIRST_STRIKE_S) / CYCLE_S).sin() < 0.0);
        let share = if heel.x > toe.x {
            ((total.x - toe.x) / (heel.x - toe.x)).clamp(0.0, 1.0)
        } else {
            f64::from(u8::from(standing == front))
        };
        let shift = total - (heel * share + toe * (1.0 - share));
        let twist = moment.y - total.cross(&force).y;
        let load = |share: f64, at: Vec3| FootLoad {
            force: force * share,
            center: if share > 0.0 { at + shift } else { Vec3::zeros() },
            free_moment: twist * share,
        };
        let mut both = [load(1.0 - share, toe); 2];
        both[front] = load(share, heel);
        loads.push(both);
    });
    Ok(loads)
}

fn ground_table(grid: &TimeGrid, feet: &[[FootLoad; 2]]) -> Result<Table, ambulo_formats::Error> {
    let mut columns = vec![("time".to_owned(), grid.times())];
    for (side, letter) in ["r", "l"].into_iter().enumerate() {
        let mut push = |name: String, pick: &dyn Fn(&FootLoad) -> f64| {
            columns.push((name, feet.iter().map(|f| rounded(pick(&f[side]))).collect()));
        };
        for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
            push(format!("ground_force_{letter}_v{axis}"), &|f| f.force[k]);
        }
        for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
            push(format!("ground_force_{letter}_p{axis}"), &|f| f.center[k]);
        }
        for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
            push(format!("ground_torque_{letter}_{axis}"), &|f| if k == 1 { f.free_moment } else { 0.0 });
        }
    }
    Table::new("Ground Reactions", columns)
}

fn external_loads() -> ExternalLoads {
    let forces = [("right", "r"), ("left", "l")].map(|(name, letter)| {
        ExternalForce::with_prefix(name, &format!("calcn_{letter}"), &format!("ground_force_{letter}_"))
    });
    ExternalLoads { name: "demo".into(), datafile: Some("walk_grf.mot".into()), forces: forces.to_vec() }
}
