//! Header and quality of a scene.

use crate::page::contract::{Fact, Judged};
use crate::page::session::header::{fact, file_name};
use crate::page::session::quality::plain;
use serde_json::Value;

/// What a scene may contain, with its plural.
const KINDS: [(&str, &str, &str); 5] = [
    ("bodies", "body", "bodies"),
    ("joints", "joint", "joints"),
    ("closures", "closure", "closures"),
    ("obstacles", "obstacle", "obstacles"),
    ("figures", "figure", "figures"),
];

/// Lines of the header.
pub(super) fn header(summary: &Value) -> Vec<Fact> {
    let number = |path: &str| summary.pointer(path).and_then(Value::as_f64);
    let words = |path: &str| summary.pointer(path).and_then(Value::as_str);
    let scene = words("/input/scene").map(file_name);
    let title = words("/title").or(scene).unwrap_or("without a title");
    let lines = [
        Some(fact("Scene", title, scene.map(|file| format!("from {file}")))),
        resumed(words("/input/resumed")),
        Some(fact("World", world(summary), number("/world/mass_kg").map(|kg| format!("{kg:.1} kg in all")))),
        number("/step_s").map(|step| {
            let integrator = words("/integrator").unwrap_or("of unknown kind");
            fact("Integrator", integrator, Some(format!("steps of {:.2} ms", 1e3 * step)))
        }),
        number("/window_s/0").zip(number("/window_s/1")).map(|(from, to)| {
            fact("Time", format!("{from:.2} to {to:.2} s"), number("/steps").map(|steps| format!("{steps:.0} steps")))
        }),
        Some(fact("Ground forces", "simulated", Some("by the contacts of the scene; no rule divides them".to_owned()))),
        Some(fact("Axes", "world: x forward, y up, z to the right", None)),
        Some(fact("Program", format!("Ambulo {}", words("/version").unwrap_or("of unknown version")), None)),
    ];
    lines.into_iter().flatten().collect()
}

fn resumed(state: Option<&str>) -> Option<Fact> {
    Some(fact("Resumed", format!("from {}", file_name(state?)), None))
}

fn world(summary: &Value) -> String {
    let counted = KINDS.iter().filter_map(|(key, one, many)| {
        let count = summary["world"][*key].as_u64().filter(|count| *count > 0)?;
        Some(format!("{count} {}", if count == 1 { one } else { many }))
    });
    let list: Vec<String> = counted.collect();
    if list.is_empty() { "empty".to_owned() } else { list.join(", ") }
}

/// How well the simulation kept to its laws.
pub(super) fn quality(summary: &Value) -> Vec<Judged> {
    let number = |path: &str| summary.pointer(path).and_then(Value::as_f64);
    let lines = [
        number("/energy/start_j").zip(number("/energy/end_j")).map(|(start, end)| {
            plain("Energy at the beginning and at the end", format!("{start:.2} J and {end:.2} J"))
        }),
        number("/joint_error_max_m").map(|m| plain("Largest gap in a joint", format!("{:.2e} mm", 1e3 * m))),
        number("/contacts/overlap_max_m").map(|m| plain("Largest overlap of bodies", format!("{:.2} mm", 1e3 * m))),
        number("/contacts/normal_force_max_n").map(|n| plain("Largest force at one point", format!("{n:.0} N"))),
        number("/contacts/impacts").map(|count| plain("Impacts between rows", format!("{count:.0}"))),
        number("/convergence/residual_max")
            .map(|r| plain("Largest residual of the solver, relative", format!("{r:.1e}"))),
        number("/convergence/not_converged").map(|steps| Judged {
            allowed: Some("none".to_owned()),
            good: Some(steps < 0.5),
            ..plain("Steps above the solver's tolerance", format!("{steps:.0}"))
        }),
    ];
    lines.into_iter().flatten().collect()
}
