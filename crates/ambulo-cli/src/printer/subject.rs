//! Prints how the body and its motion were obtained from markers.

use super::print_line;
use ambulo_results::{EventAgreementSummary, PlateContactSummary, SubjectSummary};
use anyhow::Result;

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
    print_line(&format!("  markers   {}", markers(subject)))?;
    for (region, fit) in &subject.markers.regions {
        print_line(&format!("            {}: {}", region.words(), subject.markers.region_words(fit)))?;
    }
    Ok(())
}

fn markers(subject: &SubjectSummary) -> String {
    let (used, recorded) = (subject.markers.used, subject.markers.recorded);
    let of = if recorded > used { format!(" of {recorded}") } else { String::new() };
    let sets =
        if subject.marker_sets.is_empty() { String::new() } else { format!(" ({})", subject.marker_sets.join(", ")) };
    let rms = subject.markers.rms_mm.map_or("-".to_owned(), |mm| format!("{mm:.1} mm"));
    format!("{used}{of}{sets}, {rms} rms from the body")
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
