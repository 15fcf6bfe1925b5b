//! What motion and forces disagree by, at the root, over time.

use super::{RESIDUAL_FORCE, RESIDUAL_MOMENT, group, over_time};
use crate::report::page::block::Block;
use crate::report::page::contract::{Group, Origin, PageSource, Role, Trace};
use crate::report::page::session::results::{MOMENTS, Results};

/// Columns of the root in `moments.sto`, as OpenSim's models and the built-in bodies call them, with what a reader calls them.
const FORCES: [(&str, &str); 3] =
    [("pelvis_tx_force", "forward"), ("pelvis_ty_force", "up"), ("pelvis_tz_force", "to the right")];
const MOMENTS_OF_ROOT: [(&str, &str); 3] =
    [("pelvis_tilt_moment", "tilt"), ("pelvis_list_moment", "list"), ("pelvis_rotation_moment", "rotation")];

/// Force in N and in per cent of body weight, and moment; `None` without moments of a root.
pub(super) fn residual(results: &Results, block: &mut Block) -> Option<Group> {
    let mut of = |columns: &[(&str, &str)], factor: f64| traces(results, columns, factor, block);
    let percent = 100.0 / results.weight_n;
    let (newtons, shares, moments) = (of(&FORCES, 1.0), of(&FORCES, percent), of(&MOMENTS_OF_ROOT, 1.0));
    if newtons.is_empty() && moments.is_empty() {
        return None;
    }
    let panels = vec![
        over_time(["residual_force_n", "Residual force", "N"], ["", ""], newtons),
        over_time([RESIDUAL_FORCE, "Residual force", "%BW"], ["", ""], shares),
        over_time([RESIDUAL_MOMENT, "Residual moment", "N.m"], ["", ""], moments),
    ];
    Some(group("residual", "Residual at the pelvis", note(results), 3, panels))
}

fn traces(results: &Results, columns: &[(&str, &str)], factor: f64, block: &mut Block) -> Vec<Trace> {
    let Some(table) = &results.moments else { return Vec::new() };
    let trace = |(column, name): &(&str, &str)| {
        let values: Vec<f64> = table.column(column)?.iter().map(|x| factor * x).collect();
        let origin = Origin { file: MOMENTS.to_owned(), column: (*column).to_owned(), factor };
        let values = block.add(&values);
        Some(Trace { name: (*name).to_owned(), side: None, role: Role::Main, values, sd: None, origin: Some(origin) })
    };
    columns.iter().filter_map(trace).collect()
}

fn note(results: &Results) -> String {
    let about =
        "Force and moment that the motion needs and nothing supplies: 0 if motion, forces and body belonged together.";
    match results.source {
        PageSource::None => {
            format!("{about} Here nothing holds the body, so that this is what the ground would have to do.")
        }
        _ => format!("{about}{}", windows(results)),
    }
}

/// In which times the residual means something.
fn windows(results: &Results) -> String {
    let spans: Vec<String> = results
        .list("/subject/instrumented_windows_s")
        .iter()
        .filter_map(|span| Some(format!("{:.2} to {:.2} s", span[0].as_f64()?, span[1].as_f64()?)))
        .collect();
    match spans.is_empty() {
        true => String::new(),
        false => format!(
            " It means something only while every foot on the ground stands on a plate that sees all of it: {}.",
            spans.join(", ")
        ),
    }
}
