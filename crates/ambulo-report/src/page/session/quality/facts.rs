//! Quality measures with their limits.

use crate::page::contract::{Judged, PageSource};
use crate::page::session::muscles;
use crate::page::session::plain_fact::{none_allowed, plain};
use crate::page::session::results::Results;
use ambulo::analysis::{LEAST_MARKER_SHARE, PredictionCheck};
use ambulo::model::Region;
use ambulo::simulation::consistent_walk::Magnitude;
use ambulo_results::{ConsistencySummary, MarkersSummary, RegionSummary, ResidualSummary, Summary, WalkSummary};

/// Residual force, root mean square [body weights]: walking data with every foot on a plate stay below it (finding
/// `residual.large`).
const RESIDUAL_BW: f64 = 0.1;
/// Root mean square of the marker distances [mm]: OpenSim recommends 20 (its guide to good practice, unverified).
const MARKERS_MM: f64 = 20.0;
/// The same of trunk and arms, which do not change the moments of the legs [mm]: beyond it their motion is not known
/// (findings `markers.trunk` and `markers.arms`).
const UPPER_BODY_MM: f64 = 40.0;

/// Checks of a prediction: name in the file, label, factor and unit as shown, digits.
const CHECKS: [(&str, &str, f64, &str, usize); 11] = [
    ("vertical_force_feet", "Mean vertical force on the feet over whole cycles", 1.0, "BW", 3),
    ("vertical_force_needed", "Mean vertical force required by the motion", 1.0, "BW", 3),
    ("fore_aft_impulse", "Mean fore-aft force minus mass times acceleration", 1.0, "BW", 3),
    ("center_of_pressure", "Distance of the required centre of pressure from the soles", 1e3, "mm", 0),
    ("forward_offset", "Required force: offset from the feet, forward", 1e3, "mm", 0),
    ("sideways_offset", "Required force: offset from the feet, sideways", 1e3, "mm", 0),
    ("friction", "Required friction coefficient", 1.0, "", 2),
    ("motion_bandwidth", "Bandwidth of the recorded motion", 1.0, "Hz", 1),
    ("held_without_feet", "Required force without a foot on the ground", 1.0, "BW", 2),
    ("pull", "Minimum required vertical force", 1.0, "BW", 2),
    ("mass", "Mass measured by force plates / mass of the model", 1.0, "", 3),
];

/// All quality measures in the summary.
pub(super) fn facts(results: &Results) -> Vec<Judged> {
    let Summary { residual: of_root, consistency, subject, prediction, walk, .. } = &results.summary;
    let mut facts = of_root.as_ref().map_or_else(Vec::new, |size| residual(results, size));
    facts.extend(consistency.as_ref().map(changed));
    facts.extend(subject.iter().flat_map(|subject| markers(&subject.markers)));
    facts.extend(prediction.iter().flat_map(|prediction| &prediction.checks).map(check));
    facts.extend(walk.iter().flat_map(of_walk));
    facts.extend(muscles::facts(results));
    facts
}

fn residual(results: &Results, size: &ResidualSummary) -> Vec<Judged> {
    // Without ground forces the residual is the force that the ground would have to supply.
    let judged = results.source != PageSource::None;
    let force = Judged {
        allowed: judged.then(|| format!("below {:.0} %BW while every loaded foot is on a plate", 100.0 * RESIDUAL_BW)),
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
        allowed: Some("at most 1 %BW after".to_owned()),
        good: Some(after <= 0.01),
        ..plain(
            "Residual reduction",
            format!("residual force {:.1} %BW before, {:.2} %BW after", 100.0 * before, 100.0 * after),
        )
    }
}

fn markers(markers: &MarkersSummary) -> Vec<Judged> {
    let shown = |rms: f64| plain("Distance of markers from the body, RMS", format!("{rms:.1} mm"));
    let judged = |rms: f64, limit_mm: f64, fact: Judged| Judged {
        allowed: Some(format!("below {limit_mm:.0} mm")),
        good: Some(rms < limit_mm),
        ..fact
    };
    // Folders of earlier versions have no regions.
    let all = markers.rms_mm.map(|rms| match markers.regions.is_empty() {
        true => judged(rms, MARKERS_MM, shown(rms)),
        false => shown(rms),
    });
    let of_region = |(region, fit): (&Region, &RegionSummary)| {
        let limit_mm = if *region == Region::Legs { MARKERS_MM } else { UPPER_BODY_MM };
        let label = format!("Distance of markers from the body: {}", region.words());
        judged(fit.rms_mm, limit_mm, plain(&label, markers.region_words(fit)))
    };
    let unsettled = none_allowed("Frames in which the marker fit did not converge", markers.frames_not_converged);
    // Folders of earlier versions do not know how many were recorded.
    let used = (markers.recorded > 0).then(|| Judged {
        allowed: Some(format!("at least {:.0} %", 100.0 * LEAST_MARKER_SHARE)),
        good: Some(markers.used as f64 >= LEAST_MARKER_SHARE * markers.recorded as f64),
        ..plain("Markers that the body follows", format!("{} of {}", markers.used, markers.recorded))
    });
    all.into_iter().chain(markers.regions.iter().map(of_region)).chain(used).chain([unsettled]).collect()
}

/// A check of a prediction; if it was not judged, the reason is shown.
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
    let in_words =
        |size: Magnitude, unit: &str| format!("{:.1} {unit} RMS, {:.1} {unit} at most", size.rms, size.largest);
    let lines = [
        Some(plain("External torque that supports the trunk", in_words(walk.trunk_torque_nm, "N.m"))),
        walk.lacking_force_n.map(|size| plain("Residual force of the planned motion", in_words(size, "N"))),
        walk.foot_slip_mm.map(|mm| plain("Slip of the stance foot", format!("{mm:.1} mm in the worst stance"))),
        Some(plain("Time without a foot on the ground", format!("{:.2} s", walk.flight_s))),
        Some(none_allowed("Time steps whose contacts did not converge", walk.unsolved_steps)),
    ];
    lines.into_iter().flatten().collect()
}
