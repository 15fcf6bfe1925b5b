//! Numbers that tell how far to trust the others, with what is allowed.

use crate::page::contract::{Judged, PageSource};
use crate::page::session::results::Results;
use serde_json::Value;

/// Residual force, root mean square [body weights]: walking data with every foot on a plate stay below (finding `residual.large`).
const RESIDUAL_BW: f64 = 0.1;
/// Root mean square of the distances of markers [mm]: OpenSim's users are told 20 (its guide to good practice, unverified).
const MARKERS_MM: f64 = 20.0;

/// What the checks of a prediction are called, their factor and unit as shown, and digits.
const CHECKS: [(&str, &str, f64, &str, usize); 10] = [
    ("vertical_force_feet", "Vertical force of the feet over whole cycles", 1.0, "BW", 3),
    ("vertical_force_needed", "Vertical force that the motion needs", 1.0, "BW", 3),
    ("fore_aft_impulse", "Fore-aft force beside the change of speed", 1.0, "BW", 3),
    ("center_of_pressure", "Needed centre of pressure outside of the soles", 1e3, "mm", 0),
    ("forward_offset", "Needed force ahead of the feet", 1e3, "mm", 0),
    ("sideways_offset", "Needed force beside the feet", 1e3, "mm", 0),
    ("friction", "Friction used", 1.0, "", 2),
    ("held_without_feet", "Force needed without a foot on the ground", 1.0, "BW", 2),
    ("pull", "Least vertical force needed", 1.0, "BW", 2),
    ("mass", "Mass by plates over the model's", 1.0, "", 3),
];

/// All of them that the summary has.
pub(super) fn facts(results: &Results) -> Vec<Judged> {
    let mut facts = residual(results);
    facts.extend(consistency(results));
    facts.extend(markers(results));
    facts.extend(results.list("/prediction/checks").iter().filter_map(check));
    facts.extend(walk(results));
    facts
}

/// A number that nobody judges.
pub(in crate::page::session) fn plain(label: &str, value: String) -> Judged {
    Judged { label: label.to_owned(), value, allowed: None, good: None }
}

fn residual(results: &Results) -> Vec<Judged> {
    let number = |key: &str| results.number(&format!("/residual/{key}"));
    let share = |newtons: f64| 100.0 * newtons / results.weight_n;
    // Without ground forces the residual is what the ground would have to do.
    let judged = results.source != PageSource::None;
    let force = number("force_rms_n").zip(number("force_rms_bw")).map(|(newtons, bw)| Judged {
        allowed: judged.then(|| format!("below {:.0} %BW while every foot stands on a plate", 100.0 * RESIDUAL_BW)),
        good: judged.then_some(bw < RESIDUAL_BW),
        ..plain("Residual force, RMS", format!("{newtons:.1} N ({:.1} %BW)", 100.0 * bw))
    });
    let peak = number("force_peak_n").map(|n| plain("Residual force, peak", format!("{n:.1} N ({:.1} %BW)", share(n))));
    let moment = number("moment_rms_nm")
        .zip(number("moment_peak_nm"))
        .map(|(rms, peak)| plain("Residual moment, RMS and peak", format!("{rms:.1} and {peak:.1} N.m")));
    [force, peak, moment].into_iter().flatten().collect()
}

fn consistency(results: &Results) -> Option<Judged> {
    let share = |when: &str| results.number(&format!("/consistency/residual_{when}/force_rms_bw"));
    let (before, after) = (share("before")?, share("after")?);
    Some(Judged {
        allowed: Some("at most 1 %BW left".to_owned()),
        good: Some(after <= 0.01),
        ..plain(
            "Motion changed to agree with the forces",
            format!("residual {:.1} %BW before, {:.2} %BW after", 100.0 * before, 100.0 * after),
        )
    })
}

fn markers(results: &Results) -> Vec<Judged> {
    let rms = results.number("/subject/markers/rms_mm").map(|rms| Judged {
        allowed: Some(format!("below {MARKERS_MM:.0} mm")),
        good: Some(rms < MARKERS_MM),
        ..plain("Distance of markers from the body, RMS", format!("{rms:.1} mm"))
    });
    let unsettled = results.number("/subject/markers/frames_not_converged").map(|count| Judged {
        allowed: Some("none".to_owned()),
        good: Some(count < 0.5),
        ..plain("Frames in which the fit of markers did not settle", format!("{count:.0}"))
    });
    [rms, unsettled].into_iter().flatten().collect()
}

/// A check of a prediction; what could not be judged says why.
fn check(entry: &Value) -> Option<Judged> {
    let name = entry["name"].as_str()?;
    let known = CHECKS.iter().find(|(known, ..)| *known == name);
    let (_, label, factor, unit, digits) = known.copied().unwrap_or((name, name, 1.0, entry["unit"].as_str()?, 3));
    let shown = |value: &Value| value.as_f64().map(|x| format!("{:.digits$}", factor * x));
    let with_unit = |words: String| if unit.is_empty() { words } else { format!("{words} {unit}") };
    let value = match (shown(&entry["value"]), entry["not_judged"].as_str()) {
        (Some(value), _) => with_unit(value),
        (None, Some(why)) => format!("not judged: {why}"),
        (None, None) => "not judged".to_owned(),
    };
    let allowed = match (shown(&entry["allowed"][0]), shown(&entry["allowed"][1])) {
        (Some(low), Some(high)) => Some(with_unit(format!("{low} to {high}"))),
        (Some(low), None) => Some(with_unit(format!("at least {low}"))),
        (None, Some(high)) => Some(with_unit(format!("at most {high}"))),
        (None, None) => None,
    };
    Some(Judged { label: label.to_owned(), value, allowed, good: entry["passed"].as_bool() })
}

/// How honest a synthetic walk is.
fn walk(results: &Results) -> Vec<Judged> {
    let number = |key: &str| results.number(&format!("/walk/{key}"));
    let pair = |key: &str| number(&format!("{key}/rms")).zip(number(&format!("{key}/largest")));
    let in_words = |(rms, largest): (f64, f64), unit: &str| format!("{rms:.1} {unit} RMS, {largest:.1} {unit} at most");
    let lines = [
        pair("trunk_torque_nm").map(|size| plain("Torque that holds the trunk from outside", in_words(size, "N.m"))),
        pair("lacking_force_n").map(|size| plain("Force that the planned motion lacks", in_words(size, "N"))),
        number("foot_slip_mm").map(|mm| plain("Slip of a standing foot", format!("{mm:.1} mm in the worst stance"))),
        number("flight_s").map(|s| plain("Time without a foot on the ground", format!("{s:.2} s"))),
        number("unsolved_steps").map(|steps| Judged {
            allowed: Some("none".to_owned()),
            good: Some(steps < 0.5),
            ..plain("Steps whose contacts were not solved", format!("{steps:.0}"))
        }),
    ];
    lines.into_iter().flatten().collect()
}
