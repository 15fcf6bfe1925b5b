//! Orientations of sensors in OpenSim storage: tables with `DataType=Quaternion`, as OpenSense reads them.
//!
//! ```text
//! DataRate=100.000000
//! DataType=Quaternion
//! version=3
//! endheader
//! time  pelvis_imu                  femur_r_imu
//! 0.00  0.707107,0,0.707107,0       1,0,0,0             w,x,y,z: earth from sensor
//! ```
//!
//! Source: OpenSim 4.6, which wrote the tables of the tests; opensim-core, `OpenSim/Simulation/OpenSense`.
//! Pinned by: tests/orientation_tables.rs

use super::lines::{Line, Lines, duplicate, number};
use super::storage::{ENDHEADER, MAX_HEADER_LINES, read_names, split_key};
use crate::error::{Error, quoted};
use crate::plain_text::utf8;
use std::fmt::Write as _;

/// Largest difference of the length of a quaternion from 1; files have four to seventeen digits.
const QUATERNION_DEFECT: f64 = 1e-2;

/// Orientations of sensors over time.
#[derive(Debug, Clone, PartialEq)]
pub struct OrientationTable {
    /// `DataRate` [Hz], if it is stated.
    pub rate_hz: Option<f64>,
    /// Times [s], as in the file.
    pub times: Vec<f64>,
    /// Names of the sensors with their unit quaternions w, x, y, z (earth from sensor); `None` where they are not
    /// numbers.
    pub sensors: Vec<(String, Vec<Option<[f64; 4]>>)>,
    /// Line of the file of each row, counted from 1; empty for a table made in memory.
    pub lines: Vec<usize>,
}

impl OrientationTable {
    /// Whether a storage file states that its cells are quaternions.
    #[must_use]
    pub fn is_stated(bytes: &[u8]) -> bool {
        let text = utf8(bytes);
        let Ok(mut lines) = Lines::new(&text, "a header") else { return false };
        for _ in 0..MAX_HEADER_LINES {
            let Ok(Some(line)) = lines.next_line() else { return false };
            let (key, value) = split_key(&line.text);
            if key.eq_ignore_ascii_case("datatype") {
                return value.eq_ignore_ascii_case("quaternion");
            }
            if key.eq_ignore_ascii_case(ENDHEADER) {
                return false;
            }
        }
        false
    }

    /// Reads a table of quaternions.
    ///
    /// # Errors
    /// A header without `DataType=Quaternion` or without an end; rows of another length; cells that are no quaternions.
    pub fn read(bytes: &[u8]) -> Result<OrientationTable, Error> {
        let text = utf8(bytes);
        let mut lines = Lines::new(&text, "an OpenSim storage file with the header `DataType=Quaternion`")?;
        let rate_hz = read_header(&mut lines)?;
        let (_, names) = read_names(&mut lines)?;
        let sensors = names.into_iter().skip(1).map(|name| (name, Vec::new()));
        let mut table = OrientationTable { rate_hz, times: Vec::new(), sensors: sensors.collect(), lines: Vec::new() };
        while let Some(line) = lines.next_filled()? {
            table.read_row(&line)?;
        }
        Ok(table)
    }

    fn read_row(&mut self, line: &Line<'_>) -> Result<(), Error> {
        let cells: Vec<&str> = line.text.split_ascii_whitespace().collect();
        let wanted = self.sensors.len() + 1;
        if cells.len() != wanted {
            let expected = format!("{wanted}: the time and a quaternion w,x,y,z without spaces for each sensor");
            return Err(line.error(format!("{} cells", cells.len()), expected));
        }
        let time = number(cells[0]).filter(|time| time.is_finite());
        self.times.push(time.ok_or_else(|| line.error(quoted(cells[0]), "the time in seconds"))?);
        for ((name, path), cell) in self.sensors.iter_mut().zip(&cells[1..]) {
            path.push(quaternion(line, name, cell)?);
        }
        self.lines.push(line.number);
        Ok(())
    }

    /// Writes the table as OpenSim does.
    ///
    /// # Errors
    /// Names with white space or that repeat; columns of another length than the times.
    pub fn write(&self) -> Result<Vec<u8>, Error> {
        let wrong = |found: String, expected: &str| Error::Record { found, expected: expected.to_owned() };
        if let Some((name, path)) = self.sensors.iter().find(|(_, path)| path.len() != self.times.len()) {
            let found = format!("{} orientations of `{name}` at {} times", path.len(), self.times.len());
            return Err(wrong(found, "one for each time"));
        }
        let is_odd = |name: &str| name.is_empty() || name.contains(char::is_whitespace);
        if let Some((name, _)) = self.sensors.iter().find(|(name, _)| is_odd(name)) {
            return Err(wrong(format!("a sensor {}", quoted(name)), "a name without spaces"));
        }
        if let Some(twice) = duplicate(self.sensors.iter().map(|(name, _)| name.as_str())) {
            return Err(wrong(format!("two sensors {}", quoted(twice)), "names that differ"));
        }
        let mut text = self.rate_hz.map_or_else(String::new, |rate| format!("DataRate={rate:.6}\n"));
        text += "DataType=Quaternion\nversion=3\nendheader\ntime";
        self.sensors.iter().for_each(|(name, _)| text.extend(["\t", name.as_str()]));
        text.push('\n');
        for (row, time) in self.times.iter().enumerate() {
            let _ = write!(text, "{time:?}");
            for (_, path) in &self.sensors {
                let [w, x, y, z] = path[row].unwrap_or([f64::NAN; 4]);
                let _ = write!(text, "\t{w:?},{x:?},{y:?},{z:?}");
            }
            text.push('\n');
        }
        Ok(text.into_bytes())
    }
}

/// Reads to `endheader`; returns the data rate.
fn read_header(lines: &mut Lines<'_>) -> Result<Option<f64>, Error> {
    let (mut rate_hz, mut is_quaternion) = (None, false);
    for _ in 0..MAX_HEADER_LINES {
        let Some(line) = lines.next_line()? else {
            return Err(lines.truncated(format!("a line `{ENDHEADER}` that closes the header")));
        };
        let (key, value) = split_key(&line.text);
        match key.to_ascii_lowercase().as_str() {
            ENDHEADER if is_quaternion => return Ok(rate_hz),
            ENDHEADER => return Err(line.error("a header without `DataType=Quaternion`", "this line in the header")),
            "datatype" => {
                if !value.eq_ignore_ascii_case("quaternion") {
                    return Err(line.error(format!("DataType {}", quoted(value)), "`DataType=Quaternion`"));
                }
                is_quaternion = true;
            }
            "datarate" => rate_hz = number(value).filter(|rate| rate.is_finite() && *rate > 0.0),
            _ => {}
        }
    }
    let expected = format!("a line `{ENDHEADER}` among the first {MAX_HEADER_LINES} lines");
    Err(Error::Line { line: MAX_HEADER_LINES, found: "a header without end".into(), expected })
}

/// The quaternion of a cell; `None` if its parts are not-a-number.
fn quaternion(line: &Line<'_>, sensor: &str, cell: &str) -> Result<Option<[f64; 4]>, Error> {
    let parts: Option<Vec<f64>> = cell.split(',').map(number).collect();
    let Some([w, x, y, z]) = parts.as_deref() else {
        return Err(line.error(format!("{} for `{sensor}`", quoted(cell)), "a quaternion of four numbers: w,x,y,z"));
    };
    let length = [w, x, y, z].iter().map(|part| *part * *part).sum::<f64>().sqrt();
    if length.is_nan() {
        return Ok(None);
    }
    if (length - 1.0).abs() > QUATERNION_DEFECT {
        let found = format!("{} of length {length:.3} for `{sensor}`", quoted(cell));
        let expected = "a rotation: w,x,y,z of length 1, or nan,nan,nan,nan where the sensor sent nothing";
        return Err(line.error(found, expected));
    }
    Ok(Some([w / length, x / length, y / length, z / length]))
}
