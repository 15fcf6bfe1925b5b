//! Splines through recorded columns, which a simulation follows.
//!
//! A natural quintic spline through every sample; short gaps are interpolated; no filter.

use super::gaps::{fill_gaps, spline_through};
use super::import::{coordinates_from_table, rows_with_rising_time, times};
use super::jumps;
use super::recording::MotionError;
use super::time_grid::TimeGrid;
use crate::findings::{Code, Findings, and_more_times};
use crate::model::{CoordinateId, Model};
use crate::numerics::NaturalSpline;
use ambulo_formats::table::Table;

/// The table of a `.mot` or `.sto` file, independent of a model.
#[derive(Debug, Clone)]
pub struct RecordedTable {
    origin: String,
    table: Table,
}

/// Why a file gives no curves.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CurveError {
    /// The file is not a table.
    #[error(transparent)]
    File(#[from] ambulo_formats::Error),
    /// The table has no usable motion.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The table does not have a column.
    #[error("there is no column `{column}`; found {found}")]
    NoColumn {
        /// Name of the column.
        column: String,
        /// The columns of the table.
        found: String,
    },
    /// An angle changes suddenly between two rows.
    #[error(
        "line {line}, column `{column}`: found a jump by {change_deg:.1} deg at {time_s:.4} s{more}; expected an angle \
         that a joint can follow. hint: correct these rows, or use the part before or after them"
    )]
    Jump {
        /// Name of the column.
        column: String,
        /// Line of the row after the jump, counted from 1.
        line: usize,
        /// Time of this row [s].
        time_s: f64,
        /// Change from the row before [deg].
        change_deg: f64,
        /// Number of further jumps, in words.
        more: String,
    },
}

/// The samples of a column.
struct Samples {
    /// Times [s].
    times: Vec<f64>,
    values: Vec<f64>,
    /// The rows of the table that they come from.
    rows: Vec<usize>,
}

impl RecordedTable {
    /// Reads a `.mot` or `.sto` file; `origin` is its name, for messages.
    ///
    /// # Errors
    /// Bytes that are not a table.
    pub fn read(bytes: &[u8], origin: &str, findings: &mut Findings) -> Result<RecordedTable, CurveError> {
        let (table, remarks) = Table::read_storage(bytes)?;
        for remark in remarks {
            findings.report(Code::FileOdd, format!("{origin}: {remark}"));
        }
        Ok(RecordedTable { origin: origin.to_owned(), table })
    }

    /// Splines of all coordinates of `model` for which `wanted` is true [rad or m], `None` if not recorded; and the
    /// first and last time [s].
    ///
    /// # Errors
    /// Times that do not increase, no known column, long gaps, fewer samples than a quintic spline needs.
    pub fn coordinates(
        &self,
        model: &Model,
        wanted: impl Fn(CoordinateId) -> bool,
        findings: &mut Findings,
    ) -> Result<(Vec<Option<NaturalSpline>>, [f64; 2]), CurveError> {
        let motion = coordinates_from_table(model, &self.table, &self.origin, findings)?;
        let times = even(&motion.times);
        let mut columns = Vec::with_capacity(motion.columns.len());
        for ((id, about), column) in model.coordinate_ids().zip(model.coordinates()).zip(&motion.columns) {
            columns.push(match column.as_ref().filter(|_| wanted(id)) {
                Some(values) => Some(through(&about.name, &times, values, findings)?),
                None => None,
            });
        }
        Ok((columns, span(&times)))
    }

    /// Spline of one column with its first and last time [s]; `turns` means that it is an angle, which may be in
    /// degrees by the header.
    ///
    /// # Errors
    /// As for [`RecordedTable::coordinates`], and a missing column.
    pub fn column(
        &self,
        name: &str,
        turns: bool,
        findings: &mut Findings,
    ) -> Result<(NaturalSpline, [f64; 2]), CurveError> {
        let Samples { times, values, .. } = self.values(name, turns, findings)?;
        Ok((through(name, &times, &values, findings)?, span(&times)))
    }

    /// Spline of an angle for a joint to follow [rad]. Whole turns are removed.
    ///
    /// # Errors
    /// Errors of [`RecordedTable::column`], and an angle that jumps.
    pub fn angle(&self, name: &str, findings: &mut Findings) -> Result<NaturalSpline, CurveError> {
        let Samples { times, mut values, rows } = self.values(name, true, findings)?;
        let turns = jumps::unwrapped(&mut values);
        if let [first, ..] = turns[..] {
            let (line, more) = (self.line(rows[first]), and_more_times(turns.len()));
            let message =
                format!("{}, line {line}: `{name}` jumps by a whole turn{more}; the turns were removed", self.origin);
            findings.report(Code::MotionUnwrapped, message);
        }
        let sudden = jumps::jumps_of_angle(&times, &values);
        if let [first, ..] = sudden[..] {
            return Err(CurveError::Jump {
                column: name.to_owned(),
                line: self.line(rows[first]),
                time_s: times[first],
                change_deg: (values[first] - values[first - 1]).to_degrees(),
                more: and_more_times(sudden.len()),
            });
        }
        Ok(through(name, &times, &values, findings)?)
    }

    /// Line of a row in the file, counted from 1.
    fn line(&self, row: usize) -> usize {
        self.table.line_of_row(row).unwrap_or(row + 1)
    }

    /// The samples of a column.
    fn values(&self, name: &str, turns: bool, findings: &mut Findings) -> Result<Samples, CurveError> {
        let Some(values) = self.table.column(name) else {
            let found = self.table.names().join(", ");
            return Err(CurveError::NoColumn { column: name.to_owned(), found });
        };
        if turns && self.table.in_degrees.is_none() {
            let message = format!("{}: the header has no `inDegrees`; angles are read as radians", self.origin);
            findings.report(Code::MotionUnitUnstated, message);
        }
        let unit = if turns && self.table.in_degrees == Some(true) { 1.0_f64.to_radians() } else { 1.0 };
        let clock = times(&self.table)?;
        let kept = rows_with_rising_time(&self.table, clock, findings)?;
        let times = even(&kept.iter().map(|&row| clock[row]).collect::<Vec<_>>());
        let values: Vec<f64> = kept.iter().map(|&row| values[row] * unit).collect();
        Ok(Samples { times, values, rows: kept })
    }
}

/// Times without rounding errors, if they are uniform.
fn even(times: &[f64]) -> Vec<f64> {
    TimeGrid::through(times).map_or_else(|| times.to_vec(), |grid| grid.times())
}

fn span(times: &[f64]) -> [f64; 2] {
    [times.first().copied().unwrap_or(0.0), times.last().copied().unwrap_or(0.0)]
}

fn through(name: &str, times: &[f64], values: &[f64], findings: &mut Findings) -> Result<NaturalSpline, MotionError> {
    spline_through(name, times, &fill_gaps(name, times, values, findings)?)
}
