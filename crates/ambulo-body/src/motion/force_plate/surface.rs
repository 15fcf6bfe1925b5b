//! Surface of a plate from its corners: centre, axes and normal.

use crate::spatial::{Mat3, Vec3};

/// Largest difference of opposite edges, as a share of the longer one; on measured plates it is below 1 %.
const EDGE_MISMATCH: f64 = 0.2;
/// Largest cosine between neighbouring edges (14 degrees off a right angle).
const SKEW: f64 = 0.25;
/// Shortest edge of a plate [m].
const SHORTEST_EDGE_M: f64 = 0.05;

/// The surface of a plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Surface {
    /// Mean of the four corners [m].
    pub(super) center: Vec3,
    /// Columns are the plate's x, y, z in the laboratory.
    pub(super) lab_from_plate: Mat3,
    /// Edges along the plate's x and y [m].
    pub(super) size: [f64; 2],
}

impl Surface {
    /// Computes the surface from the corners in the order of FORCE_PLATFORM:CORNERS: (+x +y), (-x +y), (-x -y), (+x -y)
    /// of the plate's axes.
    ///
    /// The centre is the mean of all four (BTK takes the middle of the diagonal from the first to the third, ezc3d the
    /// mean of four: opensim-org/opensim-core#2860; the mean has the smaller error if each corner was measured
    /// independently).
    ///
    /// # Errors
    /// Why the corners are not a plate, in words.
    pub(super) fn through(corners: &[Vec3; 4]) -> Result<Surface, String> {
        let [c1, c2, c3, c4] = corners;
        if !corners.iter().all(|c| c.iter().all(|x| x.is_finite())) {
            return Err("a corner is not a number".to_owned());
        }
        let edges = [(c1 - c2).norm(), (c4 - c3).norm(), (c1 - c4).norm(), (c2 - c3).norm()];
        let shortest = edges.iter().copied().fold(f64::INFINITY, f64::min);
        if shortest < SHORTEST_EDGE_M {
            return Err(format!("its shortest edge is {shortest:.4} m"));
        }
        let mismatch = |a: f64, b: f64| (a - b).abs() > EDGE_MISMATCH * a.max(b);
        let (x, y) = ((c1 + c4 - c2 - c3) * 0.5, (c1 + c2 - c3 - c4) * 0.5);
        let cosine = x.normalize().dot(&y.normalize());
        let skewed = cosine.is_nan() || cosine.abs() > SKEW;
        if mismatch(edges[0], edges[1]) || mismatch(edges[2], edges[3]) || skewed {
            return Err(format!(
                "its corners do not form a rectangle (edges {:.3}, {:.3}, {:.3}, {:.3} m)",
                edges[0], edges[3], edges[1], edges[2]
            ));
        }
        let z = x.cross(&y).normalize();
        let across = x.normalize();
        let lab_from_plate = Mat3::from_columns(&[across, z.cross(&across), z]);
        Ok(Surface { center: (c1 + c2 + c3 + c4) * 0.25, lab_from_plate, size: [x.norm(), y.norm()] })
    }

    /// z of the plate in the laboratory: down for a plate in the floor with corners in the order of the format.
    pub(super) fn normal(&self) -> Vec3 {
        self.lab_from_plate.column(2).into()
    }
}
