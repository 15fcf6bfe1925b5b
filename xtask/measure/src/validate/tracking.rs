//! Tracking by feet on soft ground, next to the prediction and the plates.

use super::recording::Recording;
use ambulo::analysis::{ComparedAnalyses, GroundAgreement, ground_agreement, track};
use ambulo::numerics::finite_mean;
use ambulo::optimal::TrackSettings;
use ambulo::study::validation::TextTable as Table;
use ambulo::study::validation::{Figure, SUMMARY, number, summary_cells};
use ambulo::study::{Outcome, PredictedGround};
use cpu_time::ThreadTime;

/// People on whose recordings the weights of tracking were set.
const WEIGHTS_SET_ON: [&str; 6] = ["gait2392", "rajagopal-walk", "rajagopal-run", "HC032A", "HC002D", "PiG"];

/// What tracking found in a recording.
pub(super) struct Tracked {
    label: &'static str,
    group: &'static str,
    /// Whether the recording played a part in setting the weights.
    is_known: bool,
    predicted: GroundAgreement,
    pub(super) found: Result<Found, String>,
}

/// A solution.
pub(super) struct Found {
    pub(super) agreement: GroundAgreement,
    /// Processor time per second of recording [s].
    pub(super) seconds_per_s: f64,
    /// Largest residual force at the root [body weights, body weights × leg length].
    pub(super) residual: f64,
    /// Root mean square of the changes of rotations [deg] and of the root [mm].
    moved: [f64; 2],
}

impl Tracked {
    /// Tracks the motion of a prediction.
    pub(super) fn new(recording: &Recording, outcome: &Outcome, predicted: &GroundAgreement) -> Option<Tracked> {
        let PredictedGround { prediction, measured, coverage, .. } = outcome.prediction.as_ref()?;
        let (measured, coverage) = (measured.as_ref()?, coverage.as_ref()?);
        let (model, soles) = (&outcome.body, &outcome.person.soles);
        let start = ThreadTime::now();
        let found = track(model, &outcome.analysis, prediction, soles, &TrackSettings::default());
        let seconds = start.elapsed().as_secs_f64();
        let found = found.map_err(|error| error.to_string()).map(|(analysis, motion)| {
            let compared = ComparedAnalyses { model, predicted: &analysis, prediction, measured };
            let grid = analysis.trajectory.grid();
            Found {
                agreement: ground_agreement(&compared, coverage),
                seconds_per_s: seconds / (grid.end_s() - grid.start_s),
                residual: motion.residual.1,
                moved: [motion.moved[0].to_degrees(), 1e3 * motion.moved[1]],
            }
        });
        let is_known = WEIGHTS_SET_ON.contains(&recording.subject);
        Some(Tracked {
            label: recording.label,
            group: recording.group.word(),
            is_known,
            predicted: predicted.clone(),
            found,
        })
    }
}

/// Cells of a row: recording, group, whether weights were set on it, origin of the forces, and the figures.
fn row(head: [&str; 4], of: impl Fn(Figure) -> f64) -> impl Iterator<Item = String> {
    head.map(str::to_owned).into_iter().chain(summary_cells(of))
}

fn word(is_known: bool) -> &'static str {
    if is_known { "yes" } else { "no" }
}

/// The section of the page.
pub(super) fn section(all: &[&Tracked]) -> String {
    let head = ["recording", "group", "weights set on it", "forces from"].into_iter();
    let mut table = Table::new(&head.chain(SUMMARY.map(|(name, ..)| name)).collect::<Vec<_>>());
    for one in all {
        let head = |from| [one.label, one.group, word(one.is_known), from];
        table.row(row(head("prediction"), |figure| figure.of(&one.predicted)));
        let found = one.found.as_ref().ok();
        table.row(row(head("tracking"), |figure| found.map_or(f64::NAN, |found| figure.of(&found.agreement))));
    }
    for is_known in [true, false] {
        let walking = all.iter().filter(|one| one.is_known == is_known && one.group.starts_with("walking"));
        let solved: Vec<_> =
            walking.filter_map(|one| Some([&one.predicted, &one.found.as_ref().ok()?.agreement])).collect();
        for (k, from) in ["prediction", "tracking"].into_iter().enumerate() {
            let of = |figure: Figure| finite_mean(solved.iter().map(|pair| figure.of(pair[k])));
            table.row(row(["mean over recordings", "walking", word(is_known), from], of));
        }
    }
    format!(
        "{}\n{}\nTracking changes the motion until feet on soft ground supply all external forces \
         ([OPTIMAL.md](../OPTIMAL.md)); the prediction is its \
         start and one of its targets. Moments of both are compared with those of the recorded motion and the plates. \
         The table of costs names \
         the recordings that tracking cannot solve.\n",
        table.text(),
        costs(all)
    )
}

fn costs(all: &[&Tracked]) -> String {
    let mut table = Table::new(&[
        "recording",
        "CPU seconds per second of recording",
        "largest residual at the root %BW",
        "rotations changed by (rms) deg",
        "root changed by (rms) mm",
    ]);
    for one in all {
        let cells = match &one.found {
            Ok(Found { seconds_per_s, residual, moved, .. }) => {
                let figures = [(*seconds_per_s, 2), (100.0 * residual, 3), (moved[0], 2), (moved[1], 1)];
                figures.map(|(x, digits)| number(x, digits))
            }
            Err(reason) => [reason.clone(), "-".to_owned(), "-".to_owned(), "-".to_owned()],
        };
        let [a, b, c, d] = cells;
        table.row([one.label.to_owned(), a, b, c, d]);
    }
    table.text()
}
