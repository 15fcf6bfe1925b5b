//! Prints how the body and its motion were obtained from markers.

use super::print_line;
use ambulo_results::{EventAgreementSummary, MarkerErrorSummary, PlateContactSummary, SubjectSummary};
use anyhow::Result;

/// Markers listed: those with the largest errors.
const NAMED: usize = 4;

pub(super) fn print(subject: &SubjectSummary) -> Result<()> {
    print_line(&format!("  axes      {}", subject.axes))?;
    print_markers(subject)?;
    for contact in &subject.plates {
        print_line(&format!("  {:9} {}", contact.plate, on_plate(contact)))?;
    }
    if let Some([from, to]) = subject.instrumented_windows_s.first() {
        print_line(&format!("  measured  {from:.3} to {to:.3} s: every loaded foot is on a force plate"))?;
    }
    for agreement in &subject.events {
        print_line(&format!("  events    {}", events(agreement)))?;
    }
    Ok(())
}

/// Prints how far the markers are from the body.
pub(super) fn print_markers(subject: &SubjectSummary) -> Result<()> {
    print_line(&format!("  markers   {}", markers(subject)))
}

fn markers(subject: &SubjectSummary) -> String {
    let mut errors: Vec<&MarkerErrorSummary> =
        subject.markers.errors.iter().filter(|error| error.rms_mm.is_some()).collect();
    errors.sort_by(|a, b| b.rms_mm.unwrap_or(0.0).total_cmp(&a.rms_mm.unwrap_or(0.0)));
    let far: Vec<String> =
        errors.iter().take(NAMED).map(|e| format!("{} {:.0}", e.name, e.rms_mm.unwrap_or(0.0))).collect();
    let sets =
        if subject.marker_sets.is_empty() { String::new() } else { format!(" ({})", subject.marker_sets.join(", ")) };
    let rms = subject.markers.rms_mm.map_or("-".to_owned(), |mm| format!("{mm:.1} mm"));
    let recorded = subject.markers.recorded;
    let of = if recorded > errors.len() { format!(" of {recorded}") } else { String::new() };
    format!("{}{of}{sets}, {rms} rms from the body; largest {} mm", errors.len(), far.join(", "))
}

fn on_plate(contact: &PlateContactSummary) -> String {
    let PlateContactSummary { side, start_s, end_s, peak_n, quality, .. } = contact;
    format!(
        "{} {start_s:.3} to {end_s:.3} s, peak {peak_n:.0} N, {}",
        side.map_or("unknown foot", ambulo::model::Side::letter),
        quality.word()
    )
}

fn events(agreement: &EventAgreementSummary) -> String {
    let kinds = agreement.kinds.iter().map(|kind| match kind.pairs {
        0 => format!("no {} matched", kind.kind),
        pairs => {
            format!("{pairs} {}{} {:.0} ms apart", kind.kind, if pairs > 1 { "s" } else { "" }, kind.mean_absolute_ms)
        }
    });
    format!("{} compared with {}: {}", agreement.found, agreement.reference, kinds.collect::<Vec<_>>().join(", "))
}
