//! Splines through recorded columns: what a simulation follows.
//!
//! A natural quintic through every sample, short gaps bridged; no filter.

use super::gaps::{fill_gaps, spline_through};
use super::import::{coordinates_from_table, rows_with_rising_time};
use super::recording::MotionError;
use super::time_grid::TimeGrid;
use crate::findings::{Code, Findings};
use crate::model::{CoordinateId, Model};
use crate::numerics::NaturalSpline;
use ambulo_formats::table::Table;

/// A recording read from the bytes of a `.mot` or `.sto` file, not yet tied to a model.
#[derive(Debug, Clone)]
pub struct RecordedTable {
    origin: String,
    table: Table,
}

/// Why bytes give no curves.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CurveError {
    /// No table.
    #[error(transparent)]
    File(#[from] ambulo_formats::Error),
    /// A table that records no usable motion.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// A column that the table does not have.
    #[error("there is no column `{column}`; found {found}")]
    NoColumn {
        /// What was wanted.
        column: String,
        /// The columns that are there.
        found: String,
    },
}

/// Curves of a model's coordinates.
#[derive(Debug, Clone)]
pub struct CoordinateCurves {
    /// First and last instant [s].
    pub span_s: [f64; 2],
    /// One entry a coordinate of the model; `None` where the recording has none [rad or m].
    pub columns: Vec<Option<NaturalSpline>>,
}

impl RecordedTable {
    /// Reads a `.mot` or `.sto` file; `origin` is its name, for people.
    ///
    /// # Errors
    /// Bytes that are no table.
    pub fn read(bytes: &[u8], origin: &str, findings: &mut Findings) -> Result<RecordedTable, CurveError> {
        let (table, remarks) = Table::read_storage(bytes)?;
        for remark in remarks {
            findings.report(Code::FileOdd, format!("{origin}: {remark}"));
        }
        Ok(RecordedTable { origin: origin.to_owned(), table })
    }

    /// Curves of all coordinates of `model` for which `wanted` holds.
    ///
    /// # Errors
    /// Times that do not rise, no known column, long gaps, fewer samples than a quintic needs.
    pub fn coordinates(
        &self,
        model: &Model,
        wanted: impl Fn(CoordinateId) -> bool,
        findings: &mut Findings,
    ) -> Result<CoordinateCurves, CurveError> {
        let motion = coordinates_from_table(model, &self.table, &self.origin, findings)?;
        let times = even(&motion.times);
        let mut columns = Vec::with_capacity(motion.columns.len());
        for ((id, about), column) in model.coordinate_ids().zip(model.coordinates()).zip(&motion.columns) {
            columns.push(match column.as_ref().filter(|_| wanted(id)) {
                Some(values) => Some(through(&about.name, &times, values, findings)?),
                None => None,
            });
        }
        Ok(CoordinateCurves { span_s: span(&times), columns })
    }

    /// The curve of one column; `turns` says that it is an angle, which the header may have in degrees. With it the first
    /// and last instant [s].
    ///
    /// # Errors
    /// As for [`RecordedTable::coordinates`], and a column that is not there.
    pub fn column(
        &self,
        name: &str,
        turns: bool,
        findings: &mut Findings,
    ) -> Result<(NaturalSpline, [f64; 2]), CurveError> {
        let Some(values) = self.table.column(name) else {
            let found = self.table.names().join(", ");
            return Err(CurveError::NoColumn { column: name.to_owned(), found });
        };
        if turns && self.table.in_degrees.is_none() {
            let message = format!("{}: the header has no `inDegrees`; angles are read as radians", self.origin);
            findings.report(Code::MotionUnitUnstated, message);
        }
        let unit = if turns && self.table.in_degrees == Some(true) { 1.0_f64.to_radians() } else { 1.0 };
        let kept = rows_with_rising_time(&self.table, findings)?;
        let clock = self.table.times().unwrap_or_default();
        let times = even(&kept.iter().map(|&row| clock[row]).collect::<Vec<_>>());
        let values: Vec<f64> = kept.iter().map(|&row| values[row] * unit).collect();
        Ok((through(name, &times, &values, findings)?, span(&times)))
    }
}

/// Instants without the rounding of print, where the clock is even.
fn even(times: &[f64]) -> Vec<f64> {
    TimeGrid::through(times).map_or_else(|| times.to_vec(), |grid| grid.times())
}

fn span(times: &[f64]) -> [f64; 2] {
    [times.first().copied().unwrap_or(0.0), times.last().copied().unwrap_or(0.0)]
}

fn through(name: &str, times: &[f64], values: &[f64], findings: &mut Findings) -> Result<NaturalSpline, MotionError> {
    spline_through(name, times, &fill_gaps(name, times, values, findings)?)
}
