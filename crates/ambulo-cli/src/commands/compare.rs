//! `ambulo compare`: differences of two tables, column by column.

use super::result_folder::read_checked;
use crate::args::CompareArgs;
use crate::printer::ComparedColumn;
use crate::{Completion, printer};
use ambulo::analysis::{Curve, compare};
use ambulo::job::table;
use ambulo_formats::table::Table;
use anyhow::{Context, Result, bail};

pub(crate) fn run(args: &CompareArgs) -> Result<Completion> {
    let (a, _) = table(&args.a, &read_checked(&args.a)?)?;
    let (b, _) = table(&args.b, &read_checked(&args.b)?)?;
    let columns = columns(args, &a, &b)?;
    let rows = columns.iter().map(|name| row(args, &a, &b, name)).collect::<Result<Vec<_>>>()?;
    printer::compare(&rows, args.limit, args.print)?;
    let refused = rows.iter().any(|row| row.within_limit == Some(false));
    Ok(if refused { Completion::Failed } else { Completion::Passed })
}

fn columns(args: &CompareArgs, a: &Table, b: &Table) -> Result<Vec<String>> {
    let in_both = |name: &str| a.column(name).is_some() && b.column(name).is_some();
    if let Some(missing) = args.columns.iter().find(|name| !in_both(name)) {
        let file = if a.column(missing).is_none() { &args.a } else { &args.b };
        let table = if a.column(missing).is_none() { a } else { b };
        bail!("{}: there is no column `{missing}`; expected one of {}", file.display(), table.names().join(", "));
    }
    if !args.columns.is_empty() {
        return Ok(args.columns.clone());
    }
    let time = b.names().first().map(String::as_str);
    let common: Vec<String> =
        b.names().iter().filter(|name| Some(name.as_str()) != time && in_both(name)).cloned().collect();
    if common.is_empty() {
        bail!(
            "{} and {} have no column in common; found {} and {}",
            args.a.display(),
            args.b.display(),
            a.names().join(", "),
            b.names().join(", ")
        );
    }
    Ok(common)
}

fn row(args: &CompareArgs, a: &Table, b: &Table, name: &str) -> Result<ComparedColumn> {
    let no_time = "no column `time`; expected it as the first column";
    let a_times = a.times().with_context(|| format!("{}: {no_time}", args.a.display()))?;
    let b_times = b.times().with_context(|| format!("{}: {no_time}", args.b.display()))?;
    let inside = |t: f64| args.from.is_none_or(|from| t >= from) && args.to.is_none_or(|to| t <= to);
    let kept: Vec<usize> = (0..b_times.len()).filter(|&i| inside(b_times[i])).collect();
    if kept.is_empty() {
        let (first, last) = (b_times.first().unwrap_or(&f64::NAN), b_times.last().unwrap_or(&f64::NAN));
        bail!("{}: no row between --from and --to; the table covers {first} s to {last} s", args.b.display());
    }
    let pick = |values: &[f64]| kept.iter().map(|&i| values[i]).collect::<Vec<f64>>();
    let (times, values) = (pick(b_times), pick(b.column(name).unwrap_or_default()));
    let first = Curve { times: a_times, values: a.column(name).unwrap_or_default() };
    let agreement = compare(first, Curve { times: &times, values: &values })
        .with_context(|| format!("{} and {}: column `{name}`", args.a.display(), args.b.display()))?;
    Ok(ComparedColumn::new(name, agreement, args.limit))
}
