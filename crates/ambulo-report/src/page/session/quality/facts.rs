//! Numbers that tell how far to trust the others, with what is allowed.

use crate::page::contract::{Judged, PageSource};
use crate::page::session::results::Results;
use ambulo::analysis::PredictionCheck;
use ambulo_results::{ConsistencySummary, MarkersSummary, ResidualSummary, Size, Summary, WalkSummary};

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
    let Summary { residual: of_root, consistency, subject, prediction, walk, .. } = &results.summary;
    let mut facts = of_root.as_ref().map_or_else(Vec::new, |size| residual(results, size));
    facts.extend(consistency.as_ref().map(changed));
    facts.extend(subject.iter().flat_map(|subject| markers(&subject.markers)));
    facts.extend(prediction.iter().flat_map(|prediction| &prediction.checks).map(check));
    facts.extend(walk.iter().flat_map(of_walk));
    facts
}

/// A number without a limit.
pub(in crate::page::session) fn plain(label: &str, value: String) -> Judged {
    Judged { label: label.to_owned(), value, allowed: None, good: None }
}

fn residual(results: &Results, size: &ResidualSummary) -> Vec<Judged> {
    // Without ground forces the residual is what the ground would have to do.
    let judged = results.source != PageSource::None;
    let force = Judged {
        allowed: judged.then(|| format!("below {:.0} %BW while every foot stands on a plate", 100.0 * RESIDUAL_BW)),
        good: judged.then_some(size.force_rms_bw < RESIDUAL_BW),
        ..plain("Residual force, RMS", format!("{:.1} N ({:.1} %BW)", size.force_rms_n, 100.0 * size.force_rms_bw))
    };
    let share = 100.0 * size.force_peak_n / results.weight_n;
    let peak = plain("Residual force, peak", format!("{:.1} N ({share:.1} %BW)", size.force_peak_n));
    let moment = format!("{:.1} and {:.1} N.m", size.moment_rms_nm, size.moment_peak_nm);
    vec![force, peak, plain("Residual moment, RMS and peak", moment)]
}

fn changed(consistency: &ConsistencySummary) -> Judged {
    let [before, after] = [&consistency.residual_before, &consistency.residual_after].map(|size| size.force_rms_bw);
    Judged {
        allowed: Some("at most 1 %BW left".to_owned()),
        good: Some(after <= 0.01),
        ..plain(
            "Motion changed to agree with the forces",
            format!("residual {:.1} %BW before, {:.2} %BW after", 100.0 * before, 100.0 * after),
        )
    }
}

fn markers(markers: &MarkersSummary) -> Vec<Judged> {
    let rms = markers.rms_mm.map(|rms| Judged {
        allowed: Some(format!("below {MARKERS_MM:.0} mm")),
        good: Some(rms < MARKERS_MM),
        ..plain("Distance of markers from the body, RMS", format!("{rms:.1} mm"))
    });
    let unsettled = none_allowed("Frames in which the fit of markers did not settle", markers.frames_not_converged);
    rms.into_iter().chain([unsettled]).collect()
}

/// A count of which none is allowed.
pub(in crate::page::session) fn none_allowed(label: &str, count: usize) -> Judged {
    Judged { allowed: Some("none".to_owned()), good: Some(count == 0), ..plain(label, count.to_string()) }
}

/// A check of a prediction; one that was not judged says why.
fn check(check: &PredictionCheck) -> Judged {
    let name = &*check.name;
    let known = CHECKS.iter().find(|(known, ..)| *known == name);
    let (_, label, factor, unit, digits) = known.copied().unwrap_or((name, name, 1.0, &check.unit, 3));
    let shown = |x: f64| format!("{:.digits$}", factor * x);
    let with_unit = |words: String| if unit.is_empty() { words } else { format!("{words} {unit}") };
    let value = match (check.value, &check.not_judged) {
        (Some(value), _) => with_unit(shown(value)),
        (None, Some(why)) => format!("not judged: {why}"),
        (None, None) => "not judged".to_owned(),
    };
    let [low, high] = check.allowed;
    let allowed = match (low.is_finite(), high.is_finite()) {
        (true, true) => Some(with_unit(format!("{} to {}", shown(low), shown(high)))),
        (true, false) => Some(with_unit(format!("at least {}", shown(low)))),
        (false, true) => Some(with_unit(format!("at most {}", shown(high)))),
        (false, false) => None,
    };
    Judged { label: label.to_owned(), value, allowed, good: check.passed }
}

/// How well a synthetic walk obeys the laws of motion.
fn of_walk(walk: &WalkSummary) -> Vec<Judged> {
    let in_words = |size: Size, unit: &str| format!("{:.1} {unit} RMS, {:.1} {unit} at most", size.rms, size.largest);
    let lines = [
        Some(plain("Torque that holds the trunk from outside", in_words(walk.trunk_torque_nm, "N.m"))),
        walk.lacking_force_n.map(|size| plain("Force that the planned motion lacks", in_words(size, "N"))),
        walk.foot_slip_mm.map(|mm| plain("Slip of a standing foot", format!("{mm:.1} mm in the worst stance"))),
        Some(plain("Time without a foot on the ground", format!("{:.2} s", walk.flight_s))),
        Some(none_allowed("Steps whose contacts were not solved", walk.unsolved_steps)),
    ];
    lines.into_iter().flatten().collect()
}
