//! The page: tables that read as text and as Markdown.

use super::personal::{self, Calibrated};
use super::recording::Group;
use super::refit::{self, Refitted};
use super::tracking::{self, Tracked};
use super::trial::Trial;
use ambulo::study::validation::TextTable as Table;
use ambulo::study::validation::{self, Component, DEFINITIONS, Figure, JudgedTrial, LegJoint, number, over_persons};

/// A criterion for a mean over subjects.
struct Criterion {
    what: String,
    result: f64,
    /// Smallest and largest allowed value.
    allowed: [Option<f64>; 2],
    digits: usize,
}

/// The whole page.
pub(super) fn text(trials: &[Trial], calibrated: &[Calibrated], refitted: &[Refitted]) -> String {
    let rule = trials.first().map_or("", |trial| trial.judged.rule);
    let head = format!(
        "# Predicted compared with measured ground forces\n\n\
         Every recording with plates in the development data goes through the library as `ambulo forces --predict` \
         takes it: \
         events and everything else from motion alone, the motion low-passed at 6 Hz (order 3, both ways), the plates \
         at 20 Hz \
         (order 2, both ways). Rule in double support: {rule}. Failed criteria are listed as missed. The tables are \
         those of \
         `ambulo validate`, which judges any folder of recordings.\n\n\
         {DEFINITIONS}\n\n\
         All but the runs took part in fitting the estimator: [GROUND_FIT.md](GROUND_FIT.md) has the figures of people \
         and laboratories left out, which are those that strangers get.\n"
    );
    let judged: Vec<&JudgedTrial> = trials.iter().map(|trial| &trial.judged).collect();
    let tracked: Vec<&Tracked> = trials.iter().filter_map(|trial| trial.tracked.as_ref()).collect();
    let own = |title: &str, table: String| format!("## {title}\n\n{table}");
    let sections = [
        own("Criteria", criteria(trials)),
        validation::kind_means(&judged).markdown(),
        validation::share_by_fifth(&judged).markdown(),
        validation::rmse_by_fifth(&judged).markdown(),
        validation::method_means(&judged).markdown(),
        own("With a calibration on another trial of the person", personal::section(calibrated)),
        own("Given angles whose feet slide", refit::section(refitted)),
        validation::person_means(&judged).markdown(),
        validation::each_trial(&judged).markdown(),
        validation::forces(&judged).markdown(),
        validation::centers(&judged).markdown(),
        validation::moments(&judged).markdown(),
        validation::events(&judged).markdown(),
        own("Vertical peaks and flight", peaks(trials)),
        own("Error budget: each source replaced by its measured value", budget(trials)),
        own("Tracking by feet on soft ground, next to the prediction", tracking::section(&tracked)),
        own("Time of a prediction from a trajectory", times(trials)),
    ];
    sections.into_iter().fold(head, |page, section| format!("{page}\n{section}"))
}

/// Mean over people of a figure of their trials of a group.
fn over_group(trials: &[Trial], group: Group, of: impl Fn(&Trial) -> f64) -> f64 {
    let own = trials.iter().filter(|trial| trial.judged.kind == group.word());
    over_persons(own.map(|trial| (trial.judged.person.as_str(), of(trial))))
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
    let mean = |group, figure: Figure| over_group(trials, group, |trial| figure.of(&trial.judged.agreement));
    let walking = |figure| mean(Group::Walking, figure);
    let mut list = Vec::new();
    let mut add = |what: String, result: f64, allowed, digits| list.push(Criterion { what, result, allowed, digits });
    let of_forces = [(4.5, 4.2, 0.985), (2.0, 5.8, 0.986), (1.1, 12.0, 0.92)];
    for (of, (rmse, relative, r)) in Component::ALL.into_iter().zip(of_forces) {
        let name = of.word();
        add(format!("{name}, RMSE %BW"), walking(Figure::Rmse(of)), [None, Some(rmse)], 2);
        add(format!("{name}, rRMSE %"), walking(Figure::Relative(of)), [None, Some(relative)], 1);
        add(format!("{name}, r"), walking(Figure::Correlation(of)), [Some(r), None], 3);
    }
    for (name, figure, most) in [("fore-aft", Figure::CenterAlong, 12.0), ("lateral", Figure::CenterAcross, 7.0)] {
        let what = format!("centre of pressure {name}, force-weighted RMS mm");
        add(what, walking(figure), [None, Some(most)], 1);
    }
    for (joint, most) in LegJoint::ALL.into_iter().zip([0.16, 0.11, 0.10]) {
        let what = format!("{} moment, RMSE N.m/kg", joint.word());
        add(what, walking(Figure::Moment(joint)), [None, Some(most)], 3);
    }
    for (joint, least) in LegJoint::ALL.into_iter().zip([0.93, 0.93, 0.98]) {
        let what = format!("{} moment, r", joint.word());
        add(what, walking(Figure::MomentCorrelation(joint)), [Some(least), None], 3);
    }
    add("events, mean absolute error ms".to_owned(), walking(Figure::Events), [None, Some(15.0)], 1);
    for of in Component::ALL {
        let name = of.word();
        add(format!("{name}, samples in the 90 % band %"), walking(Figure::InBand(of)), [Some(85.0), Some(95.0)], 1);
        add(format!("{name}, half-width of the band / RMSE"), walking(Figure::BandWidth(of)), [None, Some(2.2)], 2);
    }
    let vertical = Figure::Rmse(Component::Vertical);
    for (what, group, most) in
        [("turns", Group::Turning, 5.5), ("fast walking", Group::FastWalking, 8.0), ("running", Group::Running, 12.0)]
    {
        add(format!("{what}: vertical, RMSE %BW"), mean(group, vertical), [None, Some(most)], 2);
    }
    let lateral = mean(Group::Turning, Figure::Correlation(Component::Lateral));
    add("turns: lateral, r".to_owned(), lateral, [Some(0.95), None], 3);
    let relative = mean(Group::Running, Figure::Relative(Component::Vertical));
    add("running: vertical, rRMSE %".to_owned(), relative, [None, Some(5.5)], 1);
    let peaks =
        trials.iter().filter(|trial| trial.judged.kind == Group::Running.word()).flat_map(|trial| &trial.peaks_off);
    let worst = peaks.map(|(_, _, off)| 100.0 * off.abs()).fold(0.0, f64::max);
    add("running: vertical peak of the worst stance off by %".to_owned(), worst, [None, Some(5.0)], 1);
    let slowest = trials.iter().map(|trial| trial.microseconds).fold(0.0, f64::max);
    add("prediction, microseconds a frame, slowest recording".to_owned(), slowest, [None, Some(20.0)], 1);
    list
}

fn peaks(trials: &[Trial]) -> String {
    let mut table = Table::new(&["recording", "peaks off by % (each stance)", "flight s", "by plates s", "mass from"]);
    for trial in trials {
        let peaks: Vec<String> =
            trial.peaks_off.iter().map(|(side, _, off)| format!("{side} {:+.1}", 100.0 * off)).collect();
        let [found, truth] = trial.flight_s;
        let peaks = peaks.join(" ");
        let source = trial.judged.mass.source.word().to_owned();
        table.row([trial.judged.name.clone(), peaks, number(found, 2), number(truth, 2), source]);
    }
    table.text()
}

/// Figures of the error budget, with their headings and digits.
const BUDGET: [(&str, Figure, usize); 10] = [
    ("vertical %BW", Figure::Rmse(Component::Vertical), 2),
    ("r", Figure::Correlation(Component::Vertical), 3),
    ("fore-aft %BW", Figure::Rmse(Component::ForeAft), 2),
    ("lateral %BW", Figure::Rmse(Component::Lateral), 2),
    ("r", Figure::Correlation(Component::Lateral), 3),
    ("CoP fore-aft mm", Figure::CenterAlong, 1),
    ("CoP lateral mm", Figure::CenterAcross, 1),
    ("hip", Figure::Moment(LegJoint::Hip), 3),
    ("knee", Figure::Moment(LegJoint::Knee), 3),
    ("ankle", Figure::Moment(LegJoint::Ankle), 3),
];

fn budget(trials: &[Trial]) -> String {
    let head = ["kind", "known"].into_iter().chain(BUDGET.iter().map(|(name, ..)| *name));
    let mut table = Table::new(&head.collect::<Vec<_>>());
    let mut sources: Vec<&str> = Vec::new();
    for (source, _) in trials.iter().flat_map(|trial| &trial.budget) {
        if !sources.contains(source) {
            sources.push(source);
        }
    }
    for group in [Group::Walking, Group::Turning, Group::FastWalking, Group::Running] {
        for source in &sources {
            let of =
                |trial: &Trial| trial.budget.iter().find(|(name, _)| name == source).map(|(_, found)| found.clone());
            let figures = BUDGET.map(|(_, figure, digits)| {
                let mean = over_group(trials, group, |trial| of(trial).map_or(f64::NAN, |found| figure.of(&found)));
                number(mean, digits)
            });
            table.row([group.word().to_owned(), (*source).to_owned()].into_iter().chain(figures));
        }
    }
    format!(
        "{}\nMeans over subjects, over the part of the stances in which plates measured every foot: only there can \
         every source \
         be replaced. A known split is that of the vertical force; along the ground the rule divides, which bounds the \
         forces fore-aft and lateral when everything \
         else is known. Moments in N.m/kg; centres of pressure are force-weighted.\n",
        table.text()
    )
}

fn times(trials: &[Trial]) -> String {
    let mut table = Table::new(&["recording", "frames", "microseconds a frame"]);
    for trial in trials {
        table.row([trial.judged.name.clone(), trial.frames.to_string(), number(trial.microseconds, 1)]);
    }
    format!("{}\nThe best of five runs, on whatever machine wrote this page.\n", table.text())
}
