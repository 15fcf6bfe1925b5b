//! Header and quality measures of a scene.

use crate::page::contract::{Fact, Judged};
use crate::page::session::header::{fact, file_name};
use crate::page::session::plain_fact::{none_allowed, plain};
use ambulo_results::{SceneSummary, WorldSummary};

/// How far each walking figure came, and whether it fell.
pub(super) fn outcome(summary: &SceneSummary) -> Vec<String> {
    summary.walked.iter().map(|walked| format!("{} {}", walked.figure, walked.sentence())).collect()
}

/// Lines of the header.
pub(super) fn header(summary: &SceneSummary) -> Vec<Fact> {
    let scene = file_name(&summary.input.scene);
    let [from, to] = summary.window_s;
    let resumed = summary.input.resumed.as_ref();
    let walked = summary.walked.iter().map(|walked| fact(&walked.figure, walked.sentence(), None));
    let lines = [
        Some(fact("Scene", summary.title.as_deref().unwrap_or(scene), Some(format!("from {scene}")))),
        resumed.map(|state| fact("Resumed", format!("from {}", file_name(state)), None)),
        Some(fact("World", world(&summary.world), Some(format!("{:.1} kg in total", summary.world.mass_kg)))),
        Some(fact("Integrator", summary.integrator.word(), Some(format!("steps of {:.2} ms", 1e3 * summary.step_s)))),
        Some(fact("Time", format!("{from:.2} to {to:.2} s"), Some(format!("{} steps", summary.steps)))),
        Some(fact("Ground forces", "simulated", Some("from the contacts of the scene".to_owned()))),
        Some(fact("Axes", "world: x forward, y up, z to the right", None)),
        Some(fact("Program", format!("Ambulo {}", summary.version), None)),
    ];
    walked.chain(lines.into_iter().flatten()).collect()
}

fn world(world: &WorldSummary) -> String {
    let kinds = [
        (world.bodies, "body", "bodies"),
        (world.joints, "joint", "joints"),
        (world.closures, "closure", "closures"),
        (world.obstacles, "obstacle", "obstacles"),
        (world.figures, "figure", "figures"),
    ];
    let counted = kinds.into_iter().filter(|(count, ..)| *count > 0);
    let list: Vec<String> =
        counted.map(|(count, one, many)| format!("{count} {}", if count == 1 { one } else { many })).collect();
    if list.is_empty() { "empty".to_owned() } else { list.join(", ") }
}

/// How well the simulation obeyed the laws of motion.
pub(super) fn quality(summary: &SceneSummary) -> Vec<Judged> {
    let SceneSummary { energy, contacts, convergence, .. } = summary;
    let ends = format!("{:.2} J and {:.2} J", energy.start_j, energy.end_j);
    vec![
        plain("Total energy at the start and at the end", ends),
        plain("Largest gap in a joint", format!("{:.2e} mm", 1e3 * summary.joint_error_max_m)),
        plain("Largest overlap of bodies", format!("{:.2} mm", 1e3 * contacts.overlap_max_m)),
        plain("Largest force at one point", format!("{:.0} N", contacts.normal_force_max_n)),
        plain("Impacts between output instants", contacts.impacts.to_string()),
        plain("Largest residual of the solver, relative", format!("{:.1e}", convergence.residual_max)),
        none_allowed("Time steps above the solver's tolerance", convergence.not_converged),
    ]
}
