//! The reference human: 16 segments, 37 degrees of freedom, 1000 frames, the pelvis at rest.
//!
//! | file                 | content                                                                                |
//! |----------------------|----------------------------------------------------------------------------------------|
//! | `human.osim`         | the model                                                                              |
//! | `frames.npz`         | `names`, and `q`, `qd`, `qdd` [rad, rad/s, rad/s²], a row a frame, a column a name        |
//! | `tau_pinocchio.npz`  | `tau` [N.m], the same columns; `base`: force [N], then moment [N.m] on the pelvis       |
//!
//! The root's coordinates are not among the names and stay 0, so its axes are the world's, and our generalised forces
//! of its three rotations are the moments, those of its three translations the forces.

use super::timing::{Timing, cpu_us};
use crate::workspace;
use ambulo::dynamics::{Workspace, inverse_frame, inverse_frames};
use ambulo::findings::Findings;
use ambulo::kinematics::{Posture, Trajectory};
use ambulo::model::{Model, from_osim};
use ambulo::motion::TimeGrid;
use ambulo_formats::npz::{Array, Npz};
use ambulo_formats::osim::OsimModel;
use std::fmt;
use std::fs;
use std::hint::black_box;
use std::path::PathBuf;

/// Ours and Pinocchio's torques differ by at most this [N.m or N]: torques reach 1e3, sums have some 1e2 terms, so
/// rounding leaves 1e3 * 1e2 * 1e-16 = 1e-11, with room for another order of operations.
const ALLOWED: f64 = 1e-8;
/// Time from frame to frame [s]; inverse dynamics does not depend on it.
const STEP_S: f64 = 0.01;
/// Columns of `base` that belong to the root's coordinates: moments for its rotations, then forces.
const ROOT: [(&str, usize); 6] = [
    ("root_coord_0", 3),
    ("root_coord_1", 4),
    ("root_coord_2", 5),
    ("root_coord_3", 0),
    ("root_coord_4", 1),
    ("root_coord_5", 2),
];

/// The model, its motion and what another engine makes of it.
pub(crate) struct Human {
    model: Model,
    frames: usize,
    /// q, qd, qdd, each with a row a frame and a column a coordinate of the model.
    motion: [Vec<f64>; 3],
    trajectory: Trajectory,
    /// Pinocchio's generalised forces, a row a frame and a column a coordinate of the model.
    expected: Vec<f64>,
}

/// Largest differences from the other engine [N.m or N].
pub(crate) struct Differences {
    single: f64,
    batch: f64,
}

impl fmt::Display for Differences {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "one frame {:.1e}, side by side {:.1e} N.m or N (allowed {ALLOWED:.0e})", self.single, self.batch)
    }
}

impl Human {
    /// Folder of the files, if they are there.
    pub(crate) fn find() -> Option<PathBuf> {
        let folder = workspace::data().join("reference/peers/data");
        let names = ["human.osim", "frames.npz", "tau_pinocchio.npz"];
        names.iter().all(|name| folder.join(name).is_file()).then_some(folder)
    }

    /// Reads the three files.
    pub(crate) fn read(folder: &std::path::Path) -> Result<Human, String> {
        let path = folder.join("human.osim");
        let at = |e: &dyn fmt::Display| format!("{}: {e}", path.display());
        let document = OsimModel::read(&fs::read(&path).map_err(|e| at(&e))?).map_err(|e| at(&e))?;
        let model = from_osim(&document, &mut Findings::default()).map_err(|e| at(&e))?;
        let arrays = |name: &str| {
            let bytes = fs::read(folder.join(name)).map_err(|e| format!("{name}: cannot read: {e}"))?;
            Npz::read(&bytes).map_err(|e| format!("{name}: {e}"))
        };
        let (recorded, answer) = (arrays("frames.npz")?, arrays("tau_pinocchio.npz")?);
        let names = array(&recorded, "names")?.texts().ok_or("the array `names` has no texts")?;
        let frames = array(&recorded, "q")?.shape.first().copied().unwrap_or_default();
        let place = |blocks: &[(&Array, &[(&str, usize)])]| rows(&model, frames, blocks);
        let columns: Vec<(&str, usize)> = names.iter().enumerate().map(|(i, name)| (name.as_str(), i)).collect();
        let block = |name: &str| place(&[(array(&recorded, name)?, &columns)]);
        let motion = [block("q")?, block("qd")?, block("qdd")?];
        let expected = place(&[(array(&answer, "tau")?, &columns), (array(&answer, "base")?, &ROOT)])?;
        let trajectory = trajectory(&model, frames, &motion)?;
        Ok(Human { model, frames, motion, trajectory, expected })
    }

    /// Compares both forms with the other engine; an error if either differs by more than is allowed.
    pub(crate) fn check(&self) -> Result<Differences, String> {
        let n = self.model.coordinates().len();
        let mut workspace = Workspace::new(&self.model);
        let mut single = vec![0.0; self.expected.len()];
        for (frame, tau) in single.chunks_exact_mut(n).enumerate() {
            tau.copy_from_slice(inverse_frame(&mut workspace, self.posture(frame), &[]).generalized());
        }
        let mut batch = vec![0.0; self.expected.len()];
        inverse_frames(&mut workspace, &self.trajectory, &[], |coordinate, first, values| {
            for (i, value) in values.iter().enumerate() {
                batch[(first + i) * n + coordinate] = *value;
            }
        });
        let differences = Differences { single: self.difference(&single), batch: self.difference(&batch) };
        let passed = differences.single <= ALLOWED && differences.batch <= ALLOWED;
        if passed { Ok(differences) } else { Err(format!("torques differ from Pinocchio's: {differences}")) }
    }

    /// CPU time for one frame in microseconds: one frame at a time, and side by side. The first copies coordinates in
    /// and leaves the torques in the workspace, as the peers' programs do; the second stores them.
    pub(crate) fn time(&self) -> [Timing; 2] {
        let mut workspace = Workspace::new(&self.model);
        let single = cpu_us(self.frames, || {
            for frame in 0..self.frames {
                black_box(inverse_frame(&mut workspace, self.posture(frame), &[]).generalized());
            }
        });
        let mut columns = self.columns();
        let batch = cpu_us(self.frames, || self.side_by_side(&mut workspace, &mut columns));
        [single, batch]
    }

    /// Room for the torques of all frames, a column a coordinate.
    fn columns(&self) -> Vec<Vec<f64>> {
        vec![vec![0.0; self.frames]; self.model.coordinates().len()]
    }

    fn side_by_side(&self, workspace: &mut Workspace, columns: &mut [Vec<f64>]) {
        inverse_frames(workspace, &self.trajectory, &[], |coordinate, first, values| {
            columns[coordinate][first..first + values.len()].copy_from_slice(values);
        });
        black_box(columns);
    }

    fn posture(&self, frame: usize) -> Posture<'_> {
        let n = self.model.coordinates().len();
        let [q, qd, qdd] = self.motion.each_ref().map(|block| &block[frame * n..(frame + 1) * n]);
        Posture { q, qd, qdd }
    }

    /// Largest difference; not a number counts as infinite.
    fn difference(&self, ours: &[f64]) -> f64 {
        let differences = ours.iter().zip(&self.expected).map(|(a, b)| (a - b).abs());
        differences.fold(0.0, |worst, d| if d.is_nan() { f64::INFINITY } else { d.max(worst) })
    }
}

/// Rows of the model's coordinates, filled from the named columns of some arrays; the rest is 0.
fn rows(model: &Model, frames: usize, blocks: &[(&Array, &[(&str, usize)])]) -> Result<Vec<f64>, String> {
    let n = model.coordinates().len();
    let mut out = vec![0.0; frames * n];
    for (array, columns) in blocks {
        let [found, width] = array.shape[..] else { return Err(format!("shape {:?}, expected a table", array.shape)) };
        if found != frames || width != columns.len() {
            return Err(format!("{found} rows of {width} numbers, expected {frames} of {}", columns.len()));
        }
        let numbers = array.numbers().ok_or("an array of the reference human has no numbers")?;
        for (name, column) in *columns {
            let id = model.coordinate(name).ok_or_else(|| format!("the model has no coordinate `{name}`"))?;
            for frame in 0..frames {
                out[frame * n + id.index()] = numbers[frame * width + column];
            }
        }
    }
    Ok(out)
}

fn trajectory(model: &Model, frames: usize, motion: &[Vec<f64>; 3]) -> Result<Trajectory, String> {
    let n = model.coordinates().len();
    let column = |block: &[f64], c: usize| block.iter().skip(c).step_by(n).copied().collect::<Vec<f64>>();
    let columns = (0..n).map(|c| motion.each_ref().map(|block| column(block, c))).collect();
    Trajectory::new(model, TimeGrid { start_s: 0.0, step_s: STEP_S, frames }, columns).map_err(|e| e.to_string())
}

fn array<'a>(arrays: &'a Npz, name: &str) -> Result<&'a Array, String> {
    arrays.array(name).ok_or_else(|| format!("reference human: no array `{name}`"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_torque_that_is_off_or_not_a_number_is_refused() {
        let Some(folder) = Human::find() else {
            eprintln!("skipped: no data");
            return;
        };
        for wrong in [1e-6, f64::NAN] {
            let mut human = Human::read(&folder).unwrap();
            human.check().unwrap();
            human.expected[100] += wrong;
            assert!(human.check().is_err_and(|message| message.starts_with("torques differ")));
        }
    }
}
