//! The page: tables that read as text and as Markdown.

use super::means::{COMPONENTS, Figure, JOINTS, component, held_in_fifth, over_subjects};
use super::personal::{self, Calibrated};
use super::recording::Group;
use super::tracking::{self, Tracked};
use super::trial::Trial;
use crate::table::Table;
use ambulo::analysis::GroundAgreement;

/// A criterion for a mean over subjects.
struct Criterion {
    what: String,
    result: f64,
    /// Smallest and largest allowed value.
    allowed: [Option<f64>; 2],
    digits: usize,
}

/// The whole page.
pub(super) fn text(trials: &[Trial], calibrated: &[Calibrated]) -> String {
    let rule = trials.first().map_or("", |trial| trial.rule);
    let head = format!(
        "# Predicted compared with measured ground forces\n\n\
         Every recording with plates in the development data goes through the library as `ambulo forces --predict` takes it: \
         events and everything else from motion alone, the motion low-passed at 6 Hz (order 3, both ways), the plates at 20 Hz \
         (order 2, both ways). Rule in double support: {rule}. Failed criteria are listed as missed.\n\n\
         Per foot over its whole stances on plates (vertical above 20 N); RMSE in % of body weight, rRMSE over the mean of the two \
         ranges, Pearson's r. All but the runs took part in fitting the estimator: [GROUND_FIT.md](GROUND_FIT.md) has the figures of people \
         and laboratories left out, which are those that strangers get. Fore-aft is along the walking direction, in turns that of the pelvis in that stance. Centres of \
         pressure where the plate carries more than 5 % of body weight. Moments of a leg over the instrumented window \
         and over its whole stances. Means: feet, then trials, then subjects; a subject with several files counts once.\n"
    );
    let tracked: Vec<&Tracked> = trials.iter().filter_map(|trial| trial.tracked.as_ref()).collect();
    let sections = [
        ("Criteria", criteria(trials)),
        ("Means of each kind of trial", kinds(trials)),
        ("Share inside the 90 % band in each fifth of the stance", fifths(trials)),
        ("With a calibration on another trial of the person", personal::section(calibrated)),
        ("Forces of each foot", forces(trials)),
        ("Centres of pressure", centers(trials)),
        ("Sagittal moments: RMSE [N.m/kg], r", moments(trials)),
        ("Foot strikes and foot offs", events(trials)),
        ("Vertical peaks and flight", peaks(trials)),
        ("Error budget: each source replaced by its measured value", budget(trials)),
        ("Tracking by feet on soft ground, next to the prediction", tracking::section(&tracked)),
        ("Time of a prediction from a trajectory", times(trials)),
    ];
    sections.into_iter().fold(head, |page, (title, table)| format!("{page}\n## {title}\n\n{table}"))
}

/// A number, or a dash.
pub(super) fn number(x: f64, digits: usize) -> String {
    if x.is_finite() { format!("{x:.digits$}") } else { "-".to_owned() }
}

fn criteria(trials: &[Trial]) -> String {
    let mut table = Table::new(&["quantity", "criterion", "result", "verdict"]);
    for entry in all_criteria(trials) {
        let Criterion { what, result, allowed, digits } = entry;
        let criterion = match allowed {
            [Some(least), Some(most)] => format!("{} to {}", number(least, digits), number(most, digits)),
            [Some(least), None] => format!(">= {}", number(least, digits)),
            [None, Some(most)] => format!("<= {}", number(most, digits)),
            [None, None] => "-".to_owned(),
        };
        let met =
            result.is_finite() && allowed[0].is_none_or(|x| result >= x) && allowed[1].is_none_or(|x| result <= x);
        table.row([what, criterion, number(result, digits), if met { "met" } else { "missed" }.to_owned()]);
    }
    table.text()
}

fn all_criteria(trials: &[Trial]) -> Vec<Criterion> {
    let mean = |group, figure: Figure| over_subjects(trials, group, |trial| figure.of(&trial.agreement));
    let walking = |figure| mean(Group::Walking, figure);
    let mut list = Vec::new();
    let mut add = |what: String, result: f64, allowed, digits| list.push(Criterion { what, result, allowed, digits });
    let of_forces = [(4.5, 4.2, 0.985), (2.0, 5.8, 0.986), (1.1, 12.0, 0.92)];
    for (k, (rmse, relative, r)) in of_forces.into_iter().enumerate() {
        let name = COMPONENTS[k];
        add(format!("{name}, RMSE %BW"), walking(Figure::Force(k)), [None, Some(rmse)], 2);
        add(format!("{name}, rRMSE %"), walking(Figure::Relative(k)), [None, Some(relative)], 1);
        add(format!("{name}, r"), walking(Figure::Correlation(k)), [Some(r), None], 3);
    }
    for (k, (name, most)) in [("fore-aft", 12.0), ("lateral", 7.0)].into_iter().enumerate() {
        let what = format!("centre of pressure {name}, force-weighted RMS mm");
        add(what, walking(Figure::Center(k)), [None, Some(most)], 1);
    }
    for (joint, most) in [0.16, 0.11, 0.10].into_iter().enumerate() {
        let name = JOINTS[joint].0;
        add(format!("{name} moment, RMSE N.m/kg"), walking(Figure::Moment(joint)), [None, Some(most)], 3);
    }
    for (joint, least) in [0.93, 0.93, 0.98].into_iter().enumerate() {
        add(
            format!("{} moment, r", JOINTS[joint].0),
            walking(Figure::MomentCorrelation(joint)),
            [Some(least), None],
            3,
        );
    }
    add("events, mean absolute error ms".to_owned(), walking(Figure::Events), [None, Some(15.0)], 1);
    for (k, name) in COMPONENTS.into_iter().enumerate() {
        add(format!("{name}, samples in the 90 % band %"), walking(Figure::Band(k)), [Some(85.0), Some(95.0)], 1);
        add(format!("{name}, half-width of the band / RMSE"), walking(Figure::Width(k)), [None, Some(2.2)], 2);
    }
    add("turns: vertical, RMSE %BW".to_owned(), mean(Group::Turning, Figure::Force(0)), [None, Some(5.5)], 2);
    add("turns: lateral, r".to_owned(), mean(Group::Turning, Figure::Correlation(2)), [Some(0.95), None], 3);
    add(
        "fast walking: vertical, RMSE %BW".to_owned(),
        mean(Group::FastWalking, Figure::Force(0)),
        [None, Some(8.0)],
        2,
    );
    add("running: vertical, RMSE %BW".to_owned(), mean(Group::Running, Figure::Force(0)), [None, Some(12.0)], 2);
    add("running: vertical, rRMSE %".to_owned(), mean(Group::Running, Figure::Relative(0)), [None, Some(5.5)], 1);
    let peaks = trials.iter().filter(|trial| trial.group == Group::Running).flat_map(|trial| &trial.peaks_off);
    let worst = peaks.map(|(_, _, off)| 100.0 * off.abs()).fold(0.0, f64::max);
    add("running: vertical peak of the worst stance off by %".to_owned(), worst, [None, Some(5.0)], 1);
    let slowest = trials.iter().map(|trial| trial.microseconds).fold(0.0, f64::max);
    add("prediction, microseconds a frame, slowest recording".to_owned(), slowest, [None, Some(20.0)], 1);
    list
}

/// Every kind of trial that there is, in the order of the recordings.
fn groups(trials: &[Trial]) -> Vec<Group> {
    let mut all = Vec::new();
    for trial in trials {
        if !all.contains(&trial.group) {
            all.push(trial.group);
        }
    }
    all
}

fn kinds(trials: &[Trial]) -> String {
    let mut table = Table::new(&["kind", "component", "RMSE %BW", "rRMSE %", "r", "in band %", "band/RMSE"]);
    for group in groups(trials) {
        for (k, name) in COMPONENTS.into_iter().enumerate() {
            let mean = |figure: Figure, digits| {
                number(over_subjects(trials, group, |trial| figure.of(&trial.agreement)), digits)
            };
            table.row([
                group.word().to_owned(),
                name.to_owned(),
                mean(Figure::Force(k), 2),
                mean(Figure::Relative(k), 1),
                mean(Figure::Correlation(k), 3),
                mean(Figure::Band(k), 1),
                mean(Figure::Width(k), 2),
            ]);
        }
    }
    table.text()
}

fn fifths(trials: &[Trial]) -> String {
    let mut table = Table::new(&["kind", "component", "1st", "2nd", "3rd", "4th", "5th"]);
    for group in groups(trials) {
        for (k, name) in COMPONENTS.into_iter().enumerate() {
            let held = |fifth| number(100.0 * over_subjects(trials, group, |t| held_in_fifth(t, k, fifth)), 0);
            let [a, b, c, d, e] = [0, 1, 2, 3, 4].map(held);
            table.row([group.word().to_owned(), name.to_owned(), a, b, c, d, e]);
        }
    }
    table.text()
}

fn forces(trials: &[Trial]) -> String {
    let mut table = Table::new(&[
        "recording",
        "group",
        "foot",
        "stances",
        "component",
        "RMSE %BW",
        "rRMSE %",
        "r",
        "in band %",
        "band/RMSE",
    ]);
    for trial in trials {
        for foot in &trial.agreement.feet {
            for (k, name) in COMPONENTS.into_iter().enumerate() {
                let force = component(foot, k);
                table.row([
                    trial.label.to_owned(),
                    trial.group.word().to_owned(),
                    foot.side.letter().to_owned(),
                    foot.stances_s.len().to_string(),
                    name.to_owned(),
                    number(100.0 * force.rmse_bw, 2),
                    number(100.0 * force.rrmse, 1),
                    number(force.r, 3),
                    number(100.0 * force.band.holds, 1),
                    number(force.band.half_width_over_rmse, 2),
                ]);
            }
        }
    }
    table.text()
}

fn centers(trials: &[Trial]) -> String {
    let mut table = Table::new(&[
        "recording",
        "foot",
        "fore-aft mm",
        "fore-aft weighted",
        "lateral mm",
        "lateral weighted",
        "samples",
        "without",
    ]);
    for trial in trials {
        for foot in &trial.agreement.feet {
            let center = &foot.center_of_pressure;
            table.row([
                trial.label.to_owned(),
                foot.side.letter().to_owned(),
                number(center.fore_aft_mm, 1),
                number(center.fore_aft_weighted_mm, 1),
                number(center.lateral_mm, 1),
                number(center.lateral_weighted_mm, 1),
                center.samples.to_string(),
                center.missing.to_string(),
            ]);
        }
    }
    table.text()
}

fn moments(trials: &[Trial]) -> String {
    let mut table = Table::new(&["recording", "leg", "hip", "r", "knee", "r", "ankle", "r"]);
    for trial in trials {
        for side in ["r", "l"] {
            let of = |joint: usize| {
                let name = format!("{}_{side}_moment", JOINTS[joint].1);
                let found = trial.agreement.moments.iter().find(|m| m.quantity == name);
                found.map_or([f64::NAN; 2], |m| [m.rmse_nm_kg, m.r])
            };
            let [[hip, hip_r], [knee, knee_r], [ankle, ankle_r]] = [of(0), of(1), of(2)];
            if [hip, knee, ankle].iter().any(|x| x.is_finite()) {
                let n = |x| number(x, 3);
                let cells = [n(hip), n(hip_r), n(knee), n(knee_r), n(ankle), n(ankle_r)];
                let [a, b, c, d, e, f] = cells;
                table.row([trial.label.to_owned(), side.to_owned(), a, b, c, d, e, f]);
            }
        }
    }
    table.text()
}

fn events(trials: &[Trial]) -> String {
    let mut table = Table::new(&["recording", "kind", "pairs", "missed", "extra", "mean error ms", "bias ms"]);
    for trial in trials {
        for event in &trial.agreement.events {
            table.row([
                trial.label.to_owned(),
                event.kind.word().to_owned(),
                event.pairs.to_string(),
                event.missed.to_string(),
                event.extra.to_string(),
                number(event.mean_absolute_ms, 1),
                number(event.bias_ms, 1),
            ]);
        }
    }
    table.text()
}

fn peaks(trials: &[Trial]) -> String {
    let mut table = Table::new(&["recording", "peaks off by % (each stance)", "flight s", "by plates s", "mass from"]);
    for trial in trials {
        let peaks: Vec<String> =
            trial.peaks_off.iter().map(|(side, _, off)| format!("{side} {:+.1}", 100.0 * off)).collect();
        let [found, truth] = trial.flight_s;
        let peaks = peaks.join(" ");
        let source = trial.mass_source.to_owned();
        table.row([trial.label.to_owned(), peaks, number(found, 2), number(truth, 2), source]);
    }
    table.text()
}

fn budget(trials: &[Trial]) -> String {
    let mut table = Table::new(&[
        "known",
        "vertical %BW",
        "fore-aft %BW",
        "lateral %BW",
        "CoP fore-aft mm",
        "CoP lateral mm",
        "hip",
        "knee",
        "ankle",
    ]);
    let mut row = |name: &str, of: &dyn Fn(&Trial) -> Option<&GroundAgreement>| {
        let mean = |figure: Figure, digits| {
            let of = |trial| of(trial).map_or(f64::NAN, |agreement| figure.of(agreement));
            number(over_subjects(trials, Group::Walking, of), digits)
        };
        table.row([
            name.to_owned(),
            mean(Figure::Force(0), 2),
            mean(Figure::Force(1), 2),
            mean(Figure::Force(2), 2),
            mean(Figure::Center(0), 1),
            mean(Figure::Center(1), 1),
            mean(Figure::Moment(0), 3),
            mean(Figure::Moment(1), 3),
            mean(Figure::Moment(2), 3),
        ]);
    };
    let mut sources: Vec<&str> = Vec::new();
    for (source, _) in trials.iter().flat_map(|trial| &trial.budget) {
        if !sources.contains(source) {
            sources.push(source);
        }
    }
    for source in sources {
        row(source, &|trial| trial.budget.iter().find(|(name, _)| *name == source).map(|(_, agreement)| agreement));
    }
    format!(
        "{}\nMeans over subjects, walking, over the part of the stances in which plates measured every foot: only there can every source \
         be replaced. A known split is that of the vertical force; along the ground the rule divides. Moments in N.m/kg; centres of pressure are force-weighted.\n",
        table.text()
    )
}

fn times(trials: &[Trial]) -> String {
    let mut table = Table::new(&["recording", "frames", "microseconds a frame"]);
    for trial in trials {
        table.row([trial.label.to_owned(), trial.frames.to_string(), number(trial.microseconds, 1)]);
    }
    format!("{}\nThe best of five runs, on whatever machine wrote this page.\n", table.text())
}
