//! Makes the files of `ambulo reproduce`, except JSON: figures with their numbers, and tables.

use super::figures::{FigureError, gait_figure, paper_figure};
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Walk};
use ambulo::simulation::walking::TorqueSeries;
use ambulo_paper::{
    Claim, Evidence, FigureSet, GAITS, PaperFigure, Sensitivity, Setting, angular_laws, assumptions, muscle_table,
    paper_figures, paper_human, quintics, torque_series,
};
use ambulo_results::OutputFile;
use std::fmt::Write;

/// All figures and tables of the walks with a setting.
///
/// # Errors
/// A figure that could not be drawn.
pub fn reproduction_files(
    claims: &[Claim],
    paper: &Evidence,
    corrected: Option<&Evidence>,
    setting: &Setting,
    sensitivities: &[Sensitivity],
) -> Result<Vec<OutputFile<'static>>, FigureError> {
    let file = |name: String, text: String| OutputFile::new(name, text.into_bytes());
    let mut files = Vec::new();
    if let Some(svg) = first_figure()? {
        files.push(file("figures/figure1.svg".into(), svg));
    }
    let of_paper = paper_figures(FigureSet::Paper, paper);
    let of_corrected = corrected.map(|evidence| paper_figures(FigureSet::Corrected, evidence)).unwrap_or_default();
    let figures: Vec<PaperFigure> = [quintics()].into_iter().chain(of_paper).chain(of_corrected).collect();
    for figure in &figures {
        files.push(file(format!("figures/{}.svg", figure.name), paper_figure(figure)?));
    }
    for figure in angular_laws().iter().chain(&figures) {
        files.push(file(format!("figures/{}.csv", figure.name), figure_csv(figure)));
    }
    let modes = || std::iter::once(("paper", paper)).chain(corrected.map(|evidence| ("corrected", evidence)));
    files.push(file("paper_muscles.csv".into(), muscles_csv(modes())));
    files.push(file("torques.csv".into(), torques_csv(modes())));
    files.push(file("torques.toml".into(), torques_toml(modes())));
    files.push(file("assumptions.csv".into(), assumptions_csv(claims, setting, sensitivities)));
    files.push(file("setting.toml".into(), setting.judged(claims).to_toml()));
    Ok(files)
}

/// Figure 1: the angular laws of the standard gait with their sub-cycles.
fn first_figure() -> Result<Option<String>, FigureError> {
    let Ok(human) = paper_human() else { return Ok(None) };
    let walk = Gait::named("standard")
        .and_then(|gait| Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()));
    walk.ok().map(|walk| gait_figure(&walk)).transpose()
}

/// Text as a CSV cell.
fn cell(text: &str) -> String {
    if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

fn figure_csv(figure: &PaperFigure) -> String {
    let mut text = String::from("panel,series,x_quantity,x,y_quantity,y\n");
    for panel in &figure.panels {
        for (number, series) in panel.series.iter().enumerate() {
            let name = if series.name.is_empty() { format!("{}", number + 1) } else { series.name.clone() };
            for [x, y] in &series.points {
                let labels = [&panel.title, &name].map(|label| cell(label)).join(",");
                let _ = writeln!(text, "{labels},{},{x:.6},{},{y:.6}", cell(panel.x_label), cell(panel.y_label));
            }
        }
    }
    text
}

fn muscles_csv<'a>(modes: impl Iterator<Item = (&'static str, &'a Evidence)>) -> String {
    let mut text = String::from("mode,gait,joint,phase,group,action,share,moment_nm_kg,power_w_kg,work_j_kg\n");
    for (mode, evidence) in modes {
        for (gait, run) in GAITS.iter().zip(&evidence.gaits) {
            for row in muscle_table(run) {
                let _ = writeln!(
                    text,
                    "{mode},{gait},{},{},{},{},{:.3},{:.4},{:.4},{:.4}",
                    row.joint,
                    row.phase,
                    row.group,
                    row.action,
                    row.share,
                    row.moment_nm_kg,
                    row.power_w_kg,
                    row.work_j_kg
                );
            }
        }
    }
    text
}

fn torques_csv<'a>(modes: impl Iterator<Item = (&'static str, &'a Evidence)>) -> String {
    let mut text = String::from("mode,gait,coordinate,cycle_s,harmonic,cosine_nm,sine_nm,r_squared\n");
    for (mode, evidence) in modes {
        for (gait, run) in GAITS.iter().zip(&evidence.gaits) {
            for series in torque_series(run) {
                let start = format!("{mode},{gait},{},{}", series.coordinate, series.cycle_s);
                let _ = writeln!(text, "{start},0,{:.6},0,{:.6}", series.mean, series.r_squared);
                for (k, (cosine, sine)) in series.cosine.iter().zip(&series.sine).enumerate() {
                    let _ = writeln!(text, "{start},{},{cosine:.6},{sine:.6},{:.6}", k + 1, series.r_squared);
                }
            }
        }
    }
    text
}

fn torques_toml<'a>(modes: impl Iterator<Item = (&'static str, &'a Evidence)>) -> String {
    let of_mode = |(mode, evidence): (&'static str, &'a Evidence)| {
        GAITS.iter().zip(&evidence.gaits).map(move |(gait, run)| (mode, *gait, torque_series(run)))
    };
    TorqueSeries::text(modes.flat_map(of_mode))
}

/// One row per claim and alternative value; a row without a claim means that no alternative was tried, or that no walk
/// was possible with it.
fn assumptions_csv(claims: &[Claim], setting: &Setting, sensitivities: &[Sensitivity]) -> String {
    let mut text = String::from("what,value,range,source,why,other,claim,headline,with_value,with_other,turns\n");
    for assumption in assumptions(setting) {
        let start = [&assumption.what, &assumption.value, &assumption.range, assumption.source, assumption.why];
        let start = start.map(cell).join(",");
        let of_it: Vec<&Sensitivity> = sensitivities.iter().filter(|s| s.what == assumption.what).collect();
        if of_it.is_empty() {
            let _ = writeln!(text, "{start},,,,,,");
        }
        for sensitivity in of_it {
            let start = format!("{start},{}", cell(&sensitivity.other));
            let turned = sensitivity.reversed(claims);
            match &sensitivity.outcome {
                Err(reason) => {
                    let _ = writeln!(text, "{start},,{},,,", cell(reason));
                }
                Ok(judgements) => judgements.iter().for_each(|judgement| {
                    let own = claims.iter().find(|claim| claim.id == judgement.id).map_or(f64::NAN, Claim::value);
                    let turns = turned.contains(&judgement.id);
                    let (id, headline, value) = (judgement.id, judgement.headline, judgement.value);
                    let _ = writeln!(text, "{start},{id},{headline},{own:.6},{value:.6},{turns}");
                }),
            }
        }
    }
    text
}
