//! Curves over the gait cycle, from `cycles.csv`.

use ambulo::model::Side;
use ambulo_results::{EXPECTED, is_sound};
use ambulo_results::{Folder, ResultsError};

/// Where they stand.
pub(super) const FILE: &str = "cycles.csv";
const HEAD: &str = "quantity,side,cycle,percent,value,unit";
/// Values at 0, 1, ... 100 %.
const SAMPLES: usize = ambulo::analysis::CYCLE_SAMPLES;

/// One curve of one cycle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CycleValues {
    /// `knee_angle_moment`.
    pub(super) quantity: String,
    pub(super) side: Side,
    /// Number of the cycle of this foot, from 1.
    pub(super) number: usize,
    /// As the file has it: `deg`, `N.m`, `BW`, ...
    pub(super) unit: String,
    /// At 0, 1, ... 100 %.
    pub(super) values: Vec<f64>,
}

/// A row of the file.
struct Row<'a> {
    quantity: &'a str,
    side: Side,
    number: usize,
    percent: usize,
    value: f64,
    unit: &'a str,
}

/// All curves, in the file's order; none without the file.
pub(super) fn read(folder: &Folder<'_>) -> Result<Vec<CycleValues>, ResultsError> {
    let Some(text) = folder.text(FILE)? else { return Ok(Vec::new()) };
    curves(&text).map_err(|reason| folder.unreadable(FILE, reason))
}

fn curves(text: &str) -> Result<Vec<CycleValues>, String> {
    let mut lines = text.lines().enumerate();
    let head = lines.next().map_or("", |(_, line)| line);
    if head != HEAD {
        return Err(format!("line 1: found `{head}`; expected `{HEAD}`"));
    }
    let mut curves: Vec<CycleValues> = Vec::new();
    for (i, line) in lines {
        let row = row(line).ok_or_else(|| {
            format!("line {}: found `{line}`; expected {HEAD} with side r or l, and as value {EXPECTED}", i + 1)
        })?;
        let may_begin = row.percent == 0 && curves.last().is_none_or(is_whole);
        match curves.last_mut().filter(|curve| continues(curve, &row)) {
            Some(curve) => curve.values.push(row.value),
            None if may_begin => curves.push(begun(&row)),
            None => {
                let found = format!("line {}: found {} % of `{}`", i + 1, row.percent, row.quantity);
                return Err(format!("{found}; expected curves of {SAMPLES} rows, from 0 to 100 %"));
            }
        }
    }
    match curves.last().filter(|curve| !is_whole(curve)) {
        Some(curve) => {
            Err(format!("the last curve, `{}`, has {} rows; expected {SAMPLES}", curve.quantity, curve.values.len()))
        }
        None => Ok(curves),
    }
}

fn row(line: &str) -> Option<Row<'_>> {
    let mut cells = line.rsplitn(6, ',');
    let (unit, value, percent) = (cells.next()?, cells.next()?, cells.next()?);
    let (number, side, quantity) = (cells.next()?, cells.next()?, cells.next()?);
    let side = Side::BOTH.into_iter().find(|known| known.letter() == side)?;
    let (number, percent) = (number.parse().ok()?, percent.parse().ok()?);
    let value = value.parse().ok().filter(|value| is_sound(*value))?;
    Some(Row { quantity, side, number, percent, value, unit })
}

fn begun(row: &Row<'_>) -> CycleValues {
    CycleValues {
        quantity: row.quantity.to_owned(),
        side: row.side,
        number: row.number,
        unit: row.unit.to_owned(),
        values: vec![row.value],
    }
}

fn is_whole(curve: &CycleValues) -> bool {
    curve.values.len() == SAMPLES
}

fn continues(curve: &CycleValues, row: &Row<'_>) -> bool {
    row.percent > 0
        && row.percent == curve.values.len()
        && row.quantity == curve.quantity
        && (row.side, row.number) == (curve.side, curve.number)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(percents: impl Iterator<Item = usize>) -> String {
        let rows = percents.map(|p| format!("knee_angle_angle,l,2,{p},{},deg\n", 0.5 * p as f64));
        format!("{HEAD}\n{}", rows.collect::<String>())
    }

    #[test]
    fn a_curve_has_all_its_rows() {
        let found = curves(&file(0..101)).unwrap();
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].side, found[0].number, found[0].values[100]), (Side::Left, 2, 50.0));
    }

    #[test]
    fn what_is_no_curve_is_refused_with_its_line() {
        for (text, words) in [
            (file((0..50).chain(51..101)), "line 52: found 51 % of `knee_angle_angle`"),
            (file(0..100), "has 100 rows; expected 101"),
            (file(0..101).replace(",25,deg", ",x,deg"), "line 52: found `knee_angle_angle,l,2,50,x,deg`"),
            (file(0..101).replace(",25,deg", ",1e300,deg"), "line 52: found `knee_angle_angle,l,2,50,1e300,deg`"),
            (file(0..101).replace(",25,deg", ",NaN,deg"), "line 52: found"),
            (file(0..101).replace(",l,", ",m,"), "line 2: found"),
            ("side,value\n".to_owned(), "line 1: found `side,value`"),
        ] {
            let error = curves(&text).unwrap_err();
            assert!(error.contains(words), "{error}");
        }
    }
}
