//! Changes since an earlier session: scores, speed, step length, and the largest changes of curves beyond the
//! error of a calibration.

use super::differences::{Change, TimeChange, time_changes};
use super::summary::{ChangeSummary, ChangesSummary};
use super::{ComparedSession, ProfileSummary, Session, Spread, profile_summary};
use ambulo::numerics::{Order, rms};
use ambulo::study::session::{Certainty, NormalCurve, least_change};

/// Curves on the first sheet.
const SHOWN: usize = 3;
/// Least change of the gait profile score that counts [deg]: Baker et al. 2012 (Gait and Posture 35:612, abstract read)
/// propose it as the minimal clinically important difference.
pub(super) const LEAST_SCORE_DEG: f64 = 1.6;
/// The same of the gait deviation index: half a standard deviation of the reference group. Ours.
const LEAST_INDEX: f64 = 5.0;
/// Times and distances on the first sheet, in this order.
const TIMES: [&str; 5] = ["speed", "cadence", "step_length", "stride_length", "stance"];

/// The answer.
pub(super) fn answer(compared: &ComparedSession, before: &Session) -> ChangesSummary {
    let all = time_changes(&compared.session, before);
    let times = TIMES.iter().flat_map(|id| all.iter().filter(move |row| row.quantity == *id && is_shown(row)));
    let of_certainty =
        |wanted: Certainty| compared.changes.iter().filter(move |change| change.found.certainty == wanted);
    let mut clear: Vec<&Change> = of_certainty(Certainty::Clear).collect();
    clear.sort_by_number(|change| -size(change, compared));
    let without = without_calibration(compared);
    let profiles = before.summary.profile.as_ref().zip(compared.session.summary.profile.as_ref());
    ChangesSummary {
        scores: profiles.map_or(Vec::new(), |(then, now)| scores(then, now, without.as_ref().unwrap_or(now))),
        score_without_calibration: without.as_ref().and_then(|profile| profile.overall),
        times: times.map(|row| of_time(row, compared)).collect(),
        largest: clear.iter().take(SHOWN).map(|change| of_curve(change, compared)).collect(),
        calibration: of_certainty(Certainty::Calibration).map(|change| of_curve(change, compared)).collect(),
        clear: [clear.len(), compared.changes.len()],
    }
}

/// Steps are shown per side, everything else of both sides.
fn is_shown(row: &TimeChange) -> bool {
    match row.quantity.as_str() {
        "step_length" | "stance" => row.side != "both",
        _ => row.side == "both",
    }
}

/// Size of a change beyond calibration, in standard deviations of the reference group or in least changes.
fn size(change: &Change, compared: &ComparedSession) -> f64 {
    let norm = compared.norm(change.quantity.id).map_or(0.0, NormalCurve::expected_score);
    rms(&change.found.beyond) / norm.max(least_change(change.quantity.id))
}

fn of_curve(change: &Change, compared: &ComparedSession) -> ChangeSummary {
    let place = change.found.place();
    let certainty = change.found.certainty;
    let at = |curve: &[f64]| curve.get(place).copied().unwrap_or(f64::NAN);
    ChangeSummary {
        quantity: change.quantity.id.to_owned(),
        unit: change.quantity.wording().unit.to_owned(),
        side: change.side.letter().to_owned(),
        before: at(&change.means[0]),
        after: at(&change.means[1]),
        two_sd: change.found.variation.as_deref().map(at),
        at_percent: Some(change.at_percent()),
        normal: compared.norm(change.quantity.id).map(|norm| norm.at_percent(change.at_percent())),
        offset: Some(change.found.offset),
        certainty: certainty.word().to_owned(),
        words: certainty.words(),
    }
}

fn of_time(row: &TimeChange, compared: &ComparedSession) -> ChangeSummary {
    let certainty = row.certainty();
    ChangeSummary {
        quantity: row.quantity.clone(),
        unit: row.unit.clone(),
        side: row.side.to_owned(),
        before: row.before[0],
        after: row.after[0],
        two_sd: row.variation(),
        normal: compared.norms.time(&row.quantity).and_then(|normal| normal.mean),
        certainty: certainty.word().to_owned(),
        words: if certainty == Certainty::SingleCycle { "not known: a single value" } else { certainty.words() },
        ..ChangeSummary::default()
    }
}

/// The scores, if the changes that a calibration explains are taken back; `None` without such changes.
fn without_calibration(compared: &ComparedSession) -> Option<ProfileSummary> {
    let mut cycles = compared.session.cycles.clone();
    let explained = compared.changes.iter().filter(|change| change.found.certainty == Certainty::Calibration);
    let mut found = false;
    for change in explained {
        for cycle in cycles.iter_mut().filter(|cycle| cycle.side == change.side) {
            let Some(curve) = cycle.curves.get_mut(change.quantity.id) else { continue };
            curve.iter_mut().zip(&change.found.explained).for_each(|(x, part)| *x -= part);
            found = true;
        }
    }
    found.then(|| profile_summary(&cycles, &compared.norms))
}

fn scores(then: &ProfileSummary, now: &ProfileSummary, kept: &ProfileSummary) -> Vec<ChangeSummary> {
    let side = |profile: &ProfileSummary, k: usize| [profile.right, profile.left][k];
    let variation = |k: usize| two_sd(side(then, k)?, side(now, k)?);
    let of_both = || Some(0.5 * (variation(0)?.powi(2) + variation(1)?.powi(2)).sqrt());
    let gps = |side: &str, of: fn(&ProfileSummary) -> Option<f64>, two_sd: Option<f64>| {
        let [before, after, kept] = [of(then)?, of(now)?, of(kept)?];
        let limit = two_sd.map(|two_sd| two_sd.max(LEAST_SCORE_DEG));
        let certainty = score_certainty(after - before, kept - before, limit);
        Some(score("gait_profile_score", "deg", side, [before, after], (two_sd, now.expected, certainty)))
    };
    let mut rows = vec![
        gps("both", |profile| profile.overall, of_both()),
        gps("r", |profile| profile.right.map(|score| score.mean), variation(0)),
        gps("l", |profile| profile.left.map(|score| score.mean), variation(1)),
    ];
    if let (Some(then), Some(now)) = (then.deviation_index, now.deviation_index) {
        let pairs = [("both", then.overall, now.overall), ("r", then.right, now.right), ("l", then.left, now.left)];
        rows.extend(pairs.map(|(side, before, after)| {
            let (before, after) = (before?, after?);
            let certainty = score_certainty(after - before, after - before, Some(LEAST_INDEX));
            Some(score("gait_deviation_index", "", side, [before, after], (None, Some(100.0), certainty)))
        }));
    }
    rows.into_iter().flatten().collect()
}

fn score(
    quantity: &str,
    unit: &str,
    side: &str,
    [before, after]: [f64; 2],
    (two_sd, normal, certainty): (Option<f64>, Option<f64>, Certainty),
) -> ChangeSummary {
    let (quantity, unit, side) = (quantity.to_owned(), unit.to_owned(), side.to_owned());
    let words = match certainty {
        Certainty::Variation => "too small to count",
        certainty => certainty.words(),
    };
    let certainty = certainty.word().to_owned();
    ChangeSummary { quantity, unit, side, before, after, two_sd, normal, certainty, words, ..ChangeSummary::default() }
}

/// How sure the change of a score is; `kept` is the change without what a calibration explains.
fn score_certainty(change: f64, kept: f64, limit: Option<f64>) -> Certainty {
    match limit {
        None => Certainty::SingleCycle,
        Some(limit) if kept.abs() > limit => Certainty::Clear,
        Some(limit) if change.abs() > limit => Certainty::Calibration,
        Some(_) => Certainty::Variation,
    }
}

/// Two standard deviations of the difference of two means.
fn two_sd(then: Spread, now: Spread) -> Option<f64> {
    let square = |spread: Spread| Some(spread.sd?.powi(2) / spread.n as f64);
    Some(2.0 * (square(then)? + square(now)?).sqrt())
}
