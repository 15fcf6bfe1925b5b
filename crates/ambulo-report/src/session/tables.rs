//! The tables of a session as CSV, and `cycles.csv` read back.

use super::quantities::named;
use super::{ComparedSession, SESSION_FORMAT, Session, SessionSummary, all};
use crate::validation::{cell, shown};
use ambulo::analysis::CYCLE_SAMPLES;
use ambulo::model::Side;
use ambulo::study::session::{CycleForces, Deviation, SessionCycle, deviation, pooled};
use ambulo_formats::table::unguarded;
use ambulo_results::{EXPECTED, SpreadSummary, is_sound};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// The first columns of `cycles.csv`; the others are `percent_0` to `percent_100`.
const CYCLE_COLUMNS: [&str; 11] = [
    "trial",
    "side",
    "cycle",
    "start_s",
    "end_s",
    "foot_off_percent",
    "forces",
    "representative",
    "excluded",
    "quantity",
    "unit",
];

/// `cycles.csv`: a row per curve.
pub(super) fn cycles_csv(session: &Session) -> String {
    let found = session.representative();
    let percents: Vec<String> = (0..CYCLE_SAMPLES).map(|i| format!("percent_{i}")).collect();
    let mut text = format!("{},{}\n", CYCLE_COLUMNS.join(","), percents.join(","));
    for (k, cycle) in session.cycles.iter().enumerate() {
        let is_best = found.cycles[cycle.side] == Some(k);
        let head = format!(
            "{},{},{},{},{},{},{},{},{}",
            cell(session.name(cycle.trial)),
            cycle.side.letter(),
            cycle.number,
            cycle.span_s[0],
            cycle.span_s[1],
            cycle.foot_off_percent.map_or(String::new(), shown),
            cycle.forces.word(),
            if is_best { "yes" } else { "no" },
            cell(cycle.excluded.as_deref().unwrap_or_default()),
        );
        for quantity in all() {
            let Some(curve) = cycle.curves.get(quantity.id) else { continue };
            // Six digits after the point are a micrometre of a metre and less than any noise.
            let values: Vec<String> = curve.iter().map(|x| format!("{x:.6}")).collect();
            let _ = writeln!(text, "{head},{},{},{}", quantity.id, quantity.wording().unit, values.join(","));
        }
    }
    text
}

/// A session from the content of its `summary.json` and `cycles.csv`.
///
/// # Errors
/// Files of another kind or version, with what was found and what was expected.
pub fn session_from_files(summary: &[u8], cycles: &[u8]) -> Result<Session, String> {
    #[derive(serde::Deserialize)]
    struct Head {
        session_format: Option<u32>,
    }
    let head: Head = serde_json::from_slice(summary).map_err(|error| format!("summary.json: {error}"))?;
    match head.session_format {
        Some(SESSION_FORMAT) => {}
        Some(other) => {
            return Err(format!(
                "summary.json: found a session of layout {other}; this version of Ambulo reads layout \
                 {SESSION_FORMAT}. hint: compute that session again"
            ));
        }
        None => {
            return Err("summary.json: found the results of another command; expected those of a session".to_owned());
        }
    }
    let summary: SessionSummary = serde_json::from_slice(summary).map_err(|error| format!("summary.json: {error}"))?;
    let text = std::str::from_utf8(cycles).map_err(|_| "cycles.csv: found no UTF-8 text".to_owned())?;
    let cycles = read_cycles(text, &summary).map_err(|error| format!("cycles.csv: {error}"))?;
    Ok(Session { summary, cycles, figure: None })
}

fn read_cycles(text: &str, summary: &SessionSummary) -> Result<Vec<SessionCycle>, String> {
    let mut reader = csv::ReaderBuilder::new().from_reader(text.as_bytes());
    let head = reader.headers().map_err(|error| error.to_string())?.clone();
    let expected = CYCLE_COLUMNS.len() + CYCLE_SAMPLES;
    if head.iter().take(CYCLE_COLUMNS.len()).ne(CYCLE_COLUMNS) || head.len() != expected {
        return Err(format!("line 1: expected {} and {CYCLE_SAMPLES} columns of values", CYCLE_COLUMNS.join(",")));
    }
    let mut cycles: Vec<SessionCycle> = Vec::new();
    for (k, record) in reader.records().enumerate() {
        let record = record.map_err(|error| error.to_string())?;
        let (cycle, quantity, values) = row(&record, summary).map_err(|what| format!("line {}: {what}", k + 2))?;
        let same =
            |known: &SessionCycle| (known.trial, known.side, known.number) == (cycle.trial, cycle.side, cycle.number);
        if !cycles.last().is_some_and(same) {
            cycles.push(cycle);
        }
        if let Some(last) = cycles.last_mut() {
            last.curves.insert(quantity, values);
        }
    }
    Ok(cycles)
}

/// The cycle, the quantity and the values of a line.
fn row(record: &csv::StringRecord, summary: &SessionSummary) -> Result<(SessionCycle, String, Vec<f64>), String> {
    let at = |k: usize| record.get(k).unwrap_or_default();
    let number = |k: usize| {
        let value = at(k).parse::<f64>().ok().filter(|x| is_sound(*x));
        value.ok_or_else(|| format!("found `{}`; expected {EXPECTED}", at(k)))
    };
    let trial = unguarded(at(0));
    let wrong = |k: usize, expected: &str| format!("found `{}` as {}; expected {expected}", at(k), CYCLE_COLUMNS[k]);
    let place = summary.trials.iter().position(|known| known.trial == trial);
    let side = Side::BOTH.into_iter().find(|side| side.letter() == at(1));
    let forces = [CycleForces::Measured, CycleForces::Predicted, CycleForces::None];
    let cycle = SessionCycle {
        trial: place.ok_or_else(|| wrong(0, "a trial of summary.json"))?,
        side: side.ok_or_else(|| wrong(1, "r or l"))?,
        number: at(2).parse().map_err(|_| wrong(2, "a number from 1"))?,
        span_s: [number(3)?, number(4)?],
        foot_off_percent: if at(5).is_empty() { None } else { Some(number(5)?) },
        forces: forces
            .into_iter()
            .find(|forces| forces.word() == at(6))
            .ok_or_else(|| wrong(6, "measured, predicted or none"))?,
        excluded: Some(unguarded(at(8)).to_owned()).filter(|reason| !reason.is_empty()),
        curves: BTreeMap::new(),
    };
    let quantity = named(at(9)).ok_or_else(|| wrong(9, "a quantity of a session"))?;
    let values = (0..CYCLE_SAMPLES).map(|i| number(CYCLE_COLUMNS.len() + i)).collect::<Result<_, _>>()?;
    Ok((cycle, quantity.id.to_owned(), values))
}

/// `times_and_distances.csv`: a row per quantity and side.
pub(super) fn times_csv(compared: &ComparedSession) -> String {
    let ComparedSession { session, norms, .. } = compared;
    let mut text = String::from("quantity,unit,side,mean,sd,n,normal_mean,normal_low,normal_high,symmetry\n");
    if let Some(speed) = session.summary.speed_m_s {
        let sd = speed.sd.map_or(String::new(), shown);
        let _ = writeln!(text, "speed,m/s,both,{},{sd},{},,,,", speed.mean, speed.n);
    }
    for found in &session.summary.times_and_distances.quantities {
        let normal = norms.time(&found.quantity);
        let number = |x: Option<f64>| x.map_or(String::new(), shown);
        let range = normal.and_then(|normal| normal.range);
        let normal = [normal.and_then(|normal| normal.mean), range.map(|r| r[0]), range.map(|r| r[1])].map(number);
        for (side, spread) in [("r", &found.right), ("l", &found.left), ("both", &found.both)] {
            let Some(SpreadSummary { mean, sd, strides, .. }) = spread else { continue };
            let symmetry = if side == "both" { number(found.symmetry) } else { String::new() };
            let _ = writeln!(
                text,
                "{},{},{side},{mean},{},{strides},{},{symmetry}",
                found.quantity,
                found.unit,
                number(*sd),
                normal.join(",")
            );
        }
    }
    text
}

/// `deviations.csv`: a row per quantity and side.
pub(super) fn deviations_csv(compared: &ComparedSession) -> String {
    let mut text = String::from(
        "quantity,unit,side,forces,cycles,rms_between_cycles,rms_from_normal,expected_rms,largest,largest_sd,\
         at_percent,outside_2_sd_percent\n",
    );
    for quantity in compared.shown() {
        for side in Side::BOTH {
            let Some(found) = pooled(&compared.session.cycles, quantity.id, side) else { continue };
            let statistics = &found.statistics;
            let from_normal = compared.norm(quantity.id).and_then(|norm| deviation(&statistics.mean, norm));
            let numbers = from_normal.map_or([f64::NAN; 6], |found: Deviation| {
                [
                    found.rms,
                    found.expected_rms,
                    found.largest,
                    found.largest_sd,
                    found.at_percent,
                    100.0 * found.outside,
                ]
            });
            let _ = writeln!(
                text,
                "{},{},{},{},{},{},{}",
                quantity.id,
                quantity.wording().unit,
                side.letter(),
                found.forces.map_or("", CycleForces::word),
                statistics.count,
                statistics.spread().map_or(String::new(), shown),
                numbers.map(shown).join(",")
            );
        }
    }
    text
}

/// `trials.csv`: a row per trial.
pub(super) fn trials_csv(session: &Session) -> String {
    let mut text = String::from(
        "trial,recorded_on,activity,speed_m_s,quality,verdict,cycles_r,cycles_l,counted_r,counted_l,measured_r,\
         measured_l,\
         error,quality_reasons,excluded\n",
    );
    for trial in &session.summary.trials {
        let words = |words: &Option<String>| cell(words.as_deref().unwrap_or_default());
        let own = session.summary.excluded.iter().filter(|cycle| cycle.trial == trial.trial);
        let excluded: BTreeSet<&str> = own.map(|cycle| cycle.reason.as_str()).collect();
        let _ = writeln!(
            text,
            "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}",
            cell(&trial.trial),
            words(&trial.recorded_on),
            words(&trial.activity),
            trial.speed_m_s.map_or(String::new(), shown),
            words(&trial.quality),
            words(&trial.verdict),
            trial.cycles[0],
            trial.cycles[1],
            trial.counted[0],
            trial.counted[1],
            trial.measured[0],
            trial.measured[1],
            words(&trial.error),
            cell(&trial.quality_reasons.join("; ")),
            cell(&excluded.into_iter().collect::<Vec<_>>().join("; ")),
        );
    }
    text
}
